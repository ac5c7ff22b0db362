"""Plots of sweeps: every run a line over time or over another quantity, or the ends of runs over what varies."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from symgen.base.errors import InputError, quote, suggest
from symgen.result.plots import LONGEST_LEGEND, axis_label, empty_figure, line_style_of, place_legend
from symgen.result.signals import TABLES, Signal, choose_columns
from symgen.study.ensemble.samples import PERCENTILES, is_sample

if TYPE_CHECKING:
    from symgen.study.ensemble.sweep_study import Array, Sweep

#: Panels of a figure at most.
MOST_PANELS = 12


def sweep_figure(sweep: Sweep, what: Sequence[str], over: str) -> Any:
    """Return a matplotlib figure with a panel for each quantity; see `Sweep.plot`.

    Raises
    ------
    InputError
        If a quantity was not kept.
    """
    signals = {signal.name: signal for signal in sweep.ensemble.recipe.kept}
    tables, model = {name: signal.table for name, signal in signals.items()}, sweep.ensemble.model.name
    names = [*choose_columns(tables, what, model, (*TABLES,))] if what else [*signals]
    grid, own = sweep.as_written()
    varied, times = grid.values(0, len(sweep)), sweep.ensemble.recipe.kept_times
    over = over or ("t" if len(times) > 1 else next(iter(varied)))
    if over not in ("t", *varied, *signals):
        expected = "t, what varies, or a quantity that was kept"
        raise InputError("over", expected, quote(over), suggest(over, ("t", *varied, *signals)))
    shown = [name for name in names if name != over][:MOST_PANELS]
    count = "" if len(names) <= MOST_PANELS else f", the first {MOST_PANELS} of {len(names)} quantities"
    end = f" at t = {times[-1]:g} s" if over in varied and len(times) else ""
    figure, axes = empty_figure(f"{model}, {len(sweep)} runs{end}{count}", len(shown))
    units = {"t": "s"} | own | {name: signal.unit for name, signal in signals.items() if name not in varied}
    lines = [*_lines_of_panels(sweep, over, varied, signals, units)]
    sampled = any(over in axis.values and is_sample(axis) for axis in grid.axes)
    for ax, name in zip(axes, shown, strict=False):
        place = [*signals].index(name)
        for i, (text, along, runs) in enumerate(lines):
            values = sweep.values[runs, place, -1] if over in varied else sweep.values[runs[0], place]
            drawn = line_style_of(i, len(lines)) | ({"linestyle": ""} if sampled else {})
            ax.plot(along, values, label=text, marker="." if sampled or len(along) < 2 else None, **drawn)
            if sampled:
                for share, dashes in zip(PERCENTILES, (":", "-", ":"), strict=True):
                    level = np.nanpercentile(values, share)
                    ax.axhline(level, linestyle=dashes, color=drawn["color"], linewidth=0.8, label=f"{share:g} %")
        ax.set_ylabel(axis_label(name, signals[name].unit))
        if (sampled and len(lines) == 1) or 1 < len(lines) <= LONGEST_LEGEND:
            place_legend(ax)
    if len(lines) > LONGEST_LEGEND:
        ends = f"dark: {lines[0][0]}; light: {lines[-1][0]}"
        axes[0].set_title(ends, fontsize=8, loc="left")
    axes[-1].set_xlabel(axis_label(over, units[over]))
    return figure


def _lines_of_panels(
    sweep: Sweep, over: str, varied: dict[str, Array], signals: dict[str, Signal], units: Mapping[str, str]
) -> Iterator[tuple[str, Array, Any]]:
    """Yield the lines of each panel: what tells one from the others, where its points are, and its runs."""
    with_it = next((axis.values for axis in sweep.ensemble.grid.axes if over in axis.values), {})
    others = {name: values for name, values in varied.items() if name not in with_it}
    drawn = {name for axis in sweep.ensemble.grid.axes if is_sample(axis) for name in axis.values}
    if over in drawn:  # points: other random numbers tell no groups apart
        others = {name: values for name, values in others.items() if name not in drawn}
    if over in varied:
        groups: dict[tuple[float, ...], list[int]] = {}
        for run in range(len(sweep)):
            groups.setdefault(tuple(float(values[run]) for values in others.values()), []).append(run)
        runs_of_lines = [sorted(runs, key=lambda run: float(varied[over][run])) for runs in groups.values()]
    else:
        runs_of_lines = [[run] for run in range(len(sweep))]
    for runs in runs_of_lines:
        text = ", ".join(f"{name} = {values[runs[0]]:.4g} {units[name]}".strip() for name, values in others.items())
        if over in varied:
            along = varied[over][runs]
        else:
            times = sweep.ensemble.recipe.kept_times
            along = times if over == "t" else sweep.values[runs[0], [*signals].index(over)]
        yield text, np.asarray(along), runs

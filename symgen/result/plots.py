"""Plots of a result: panels over time, with units, in colours that can be told apart by everybody."""

from __future__ import annotations

import textwrap
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from symgen.errors import InputError, nearest
from symgen.files import check_path, write_whole
from symgen.result.export import PLOTTED
from symgen.result.labelled import Labelled

if TYPE_CHECKING:
    from symgen.result.result import Result

#: Okabe and Ito's colours, told apart with every kind of colour vision; dashes tell repeats apart.
COLOURS = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#56B4E9", "#E69F00", "#000000", "#F0E442")
DASHES = ("-", "--", ":", "-.")
#: Lines of a panel at most: those that change most are drawn, all of them with a key.
LONGEST_LEGEND = 14
#: Label of the axis, lines, and whether their sizes are drawn on a logarithmic scale.
Panel = tuple[str, Labelled, bool]
#: Smaller violations are drawn here: a logarithm has no zero.
FLOOR = 1e-17


def plot(result: Result, path: Path, what: tuple[str, ...] = ("positions", "energy", "violations")) -> Path:
    """Draw panels over time into a file.

    Parameters
    ----------
    result : Result
        What to draw.
    path : Path
        A ``.png``, ``.svg`` or ``.pdf`` file.
    what : tuple of str
        Keys of `PANELS`.

    Raises
    ------
    InputError
        If the ending or a panel is not known, matplotlib is missing, or the file cannot be written.
    """
    check_path("plot", path, PLOTTED, "plot")
    for name in what:
        if name not in PANELS:
            raise InputError("plot", "the name of a panel", f"'{name}'", nearest(name, PANELS))
    return write_figure(draw(result, what), path)


def write_figure(figure: Any, path: Path) -> Path:
    """Write a matplotlib figure to a file, without a date: the same result gives the same bytes."""
    kind = path.suffix.lower().removeprefix(".")
    metadata = {"svg": {"Date": None}, "pdf": {"CreationDate": None}}.get(kind, {})
    return write_whole(path, lambda file: figure.savefig(file, format=kind, dpi=150, metadata=metadata))


def draw(result: Result, what: tuple[str, ...]) -> Any:
    """Return a matplotlib figure with one panel, or several, for each word of `what`."""
    panels = [panel for name in what for panel in PANELS[name](result)]
    status = result.status if result.status == "ok" else f"{result.status}: {result.reason}"
    return over_time(result.t, panels, f"{result.mechanism}, {result.method}, {result.integrator} ({status})")


def over_time(t: Any, panels: list[Panel], title: str) -> Any:
    """Return a matplotlib figure of panels over time."""
    from matplotlib.figure import Figure

    figure = Figure(figsize=(8.0, 0.8 + 2.4 * max(1, len(panels))), layout="constrained")
    axes = np.atleast_1d(figure.subplots(max(1, len(panels)), 1, sharex=True))
    for ax, (label, table, logarithmic) in zip(axes, panels, strict=False):
        _lines(ax, t, table, logarithmic)
        ax.set_ylabel(label)
        ax.grid(True, alpha=0.3)
    axes[-1].set_xlabel("t [s]")
    figure.suptitle("\n".join(textwrap.wrap(title, 95)), fontsize=10)
    return figure


def paths(curves: Mapping[str, Any], title: str) -> Any:
    """Return a matplotlib figure of curves in the plane of x and y, arrays of shape (k, 2 or more) [m], by name."""
    from matplotlib.figure import Figure

    figure = Figure(figsize=(7.0, 6.0), layout="constrained")
    ax = figure.subplots()
    for i, (name, curve) in enumerate(curves.items()):
        style = DASHES[i // len(COLOURS) % len(DASHES)]
        ax.plot(curve[:, 0], curve[:, 1], style, color=COLOURS[i % len(COLOURS)], linewidth=1.2, label=name)
    ax.set(xlabel="x [m]", ylabel="y [m]", aspect="equal")
    ax.grid(True, alpha=0.3)
    if 0 < len(curves) <= LONGEST_LEGEND:
        ax.legend(fontsize=7)
    figure.suptitle("\n".join(textwrap.wrap(title, 80)), fontsize=10)
    return figure


def _most_moving(table: Labelled) -> tuple[Labelled, int]:
    """Return the columns that change most, in their own order, as many as a key holds, and how many are left out."""
    left = len(table.names) - LONGEST_LEGEND
    if left <= 0 or not len(table.values):
        return table, 0
    change = np.nan_to_num(np.ptp(table.values, axis=0))
    chosen = sorted(np.argsort(-change, kind="stable")[:LONGEST_LEGEND].tolist())
    names, units = (tuple(of[i] for i in chosen) for of in (table.names, table.units))
    return Labelled(table.values[:, chosen], names, units), left


def _lines(ax: Any, t: Any, table: Labelled, logarithmic: bool) -> None:
    table, left = _most_moving(table)
    if left:
        ax.set_title(f"the {len(table.names)} that change most; {left} more are left out", fontsize=8, loc="left")
    for i, name in enumerate(table.names):
        values = table.values[:, i]
        if logarithmic:
            values = np.maximum(np.abs(values), FLOOR)
        style = DASHES[i // len(COLOURS) % len(DASHES)]
        ax.plot(t, values, style, color=COLOURS[i % len(COLOURS)], linewidth=1.2, label=name)
    if logarithmic:
        ax.set_yscale("log")
    if len(table.names) > 1:
        ax.legend(fontsize=7, ncols=1, loc="upper left", bbox_to_anchor=(1.0, 1.0), borderaxespad=0.2)
    elif table.names:
        ax.legend(fontsize=7, loc="best")


def by_unit(table: Labelled, what: str) -> list[Panel]:
    """Return one panel for each unit in a table."""
    panels = []
    for unit in dict.fromkeys(table.units):
        chosen = [i for i, u in enumerate(table.units) if u == unit]
        part = Labelled(table.values[:, chosen], tuple(table.names[i] for i in chosen), (unit,) * len(chosen))
        panels.append((f"{what} [{unit}]", part, False))
    return panels


def _positions(result: Result) -> list[Panel]:
    return [(f"{_quantity(p[0])}", p[1], p[2]) for p in by_unit(result.q, "position")]


def _quantity(label: str) -> str:
    return label.replace("position [rad]", "angle [rad]").replace("position [1]", "Euler parameter [1]")


def _energy(result: Result) -> list[Panel]:
    energy = result.energy
    balance = Labelled(energy.values[:, :3], energy.names[:3], energy.units[:3])
    error = Labelled(energy.values[:, 3:], ("error",), ("J",))
    return [("energy [J]", balance, False), ("|energy error| [J]", error, True)]


def _violations(result: Result) -> list[Panel]:
    return [("violation [m, m/s, m/s$^2$]", result.violations, True)]


#: Panels by name.
PANELS: dict[str, Callable[[Result], list[Panel]]] = {
    "positions": _positions,
    "velocities": lambda result: by_unit(result.v, "velocity"),
    "accelerations": lambda result: by_unit(result.a, "acceleration"),
    "reactions": lambda result: by_unit(result.reactions, "reaction"),
    "energy": _energy,
    "violations": _violations,
}

"""The pictures of one comparison."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from symgen.study.comparison.comparison_rows import Row
from symgen.study.comparison.comparison_study import Study
from symgen.study.report import words
from symgen.study.report.comparison_findings import line_number, methods_of_study, representative_rows, settings_text
from symgen.study.report.document import Picture, anchor_of_title
from symgen.study.report.picture import (
    COLOURS,
    DASHES,
    GREY,
    MARKERS,
    draw_picture,
    legend_below,
    line_style,
    shade_of_colour,
)

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from symgen.study.comparison.equal_error import TimeAtError

#: Smaller values are drawn here: a logarithm has no zero.
FLOOR = 1e-17
#: An integrator with fewer methods shares a picture with other such ones.
FEW = 3
#: Markers along a curve over time.
MARKS = 8


def pictures_of_study(study: Study) -> tuple[Picture, ...]:
    """Return all pictures of a study, without those that have no data."""
    shared = settings_text(study)
    levels = (
        ("position", "|Φ| [m, rad]"),
        ("velocity", "|D v − ν| [m/s, rad/s]"),
        ("acceleration", "|D v' − γ| [m/s², rad/s²]"),
    )
    distance = f"Distance to the reference over time ({shared}); grey: the error of the reference itself."
    work = "W being the work of forces without potential and of drivers"
    balance = f"Energy error |T + V − E₀ − W| over time, {work} ({shared})."
    every = [
        _front_picture(study),
        _ratios_picture(study),
        *_error_pictures(study),
        _curves_picture(study, "error", "error", "error [m]", distance),
        *(
            _curves_picture(study, x, f"{x}-violation", y, f"{x.title()} violation over time ({shared}).")
            for x, y in levels
        ),
        _curves_picture(study, "energy_error", "energy-error", "|energy error| [J]", balance),
        _energies_picture(study),
    ]
    return tuple(picture for picture in every if picture is not None)


def looks_of_labels(study: Study) -> dict[str, dict[str, Any]]:
    """Return colour, dashes and marker of each label: the colour is its method's, lighter for each further variant."""
    found, variants = dict[str, dict[str, Any]](), dict[str, int]()
    for label in methods_of_study(study):
        method = label.partition(", ")[0]
        level = variants[method] = variants.get(method, -1) + 1
        look = line_style(line_number(method))
        dashes = {} if level == 0 else {"linestyle": DASHES[level % len(DASHES)]}
        found[label] = look | {"color": shade_of_colour(str(look["color"]), level)} | dashes
    return found


def integrator_markers(study: Study) -> dict[str, str]:
    """Return a marker for each integrator, for pictures with several of them."""
    names = dict.fromkeys(row.integrator for row in study.rows)
    return {name: MARKERS[i % len(MARKERS)] for i, name in enumerate(names)}


# -- at a glance -------------------------------------------------------------------------------------------------------


def _front_picture(study: Study) -> Picture | None:
    """Return all rows as points of error and run time, with those that none surpasses."""
    if len(study.front) < FEW:
        return None
    rows = [(row, i in study.front) for i, row in enumerate(study.rows) if _is_drawable(row)]
    best = sorted((row for row, on_front in rows if on_front), key=lambda row: row.run_seconds)
    lines = list(dict.fromkeys((row.label, row.integrator) for row in best))
    colours, markers = looks_of_labels(study), integrator_markers(study)

    def draw_axes(figure: Figure) -> None:
        ax = figure.subplots()
        floor = _lowest_error(study)
        ax.plot(*_points_of_rows([x for x, _ in rows], floor), ".", color="#b8bec7", markersize=4.0, label="all rows")
        ax.plot(*_points_of_rows(best, floor), color=GREY, linewidth=0.8, drawstyle="steps-post")
        for k, (method, integrator) in enumerate(lines):
            own = [row for row in best if (row.label, row.integrator) == (method, integrator)]
            x, y = _points_of_rows(own, floor)
            label = f"{k + 1} {method}, {integrator}"
            ax.plot(x, y, markers[integrator], color=colours[method]["color"], label=label)
            for place in zip(x, y, strict=True):
                ax.annotate(str(k + 1), place, (4.0, 3.0), textcoords="offset points", fontsize=7.5)
        ax.set(xscale="log", yscale="log", xlabel="run time", ylabel="error [m]")
        _shade_floor(ax, study.estimated_error, ax.get_ylim())
        _label_durations(ax, ax.get_xlim())
        ax.set_title("Error against run time: the front")
        legend_below(figure, len(lines) + 1)

    caption = (
        "Error against run time of all rows; numbered marks lie on the front: none is both faster and more accurate."
    )
    return draw_picture(
        f"{anchor_of_title(study.mechanism)}-front", caption, f"The front of {study.mechanism}.", draw_axes
    )


def _points_of_rows(rows: Sequence[Row], floor: float) -> tuple[list[float], list[float]]:
    return [row.run_seconds for row in rows], [max(row.error or 0.0, floor) for row in rows]


def _lowest_error(study: Study) -> float:
    """Return the lowest error that is drawn: a decade below the error of the reference, where nothing is known."""
    return max(FLOOR, 0.1 * study.estimated_error) if np.isfinite(study.estimated_error) else FLOOR


def _ratios_picture(study: Study) -> Picture | None:
    """Return the ratios of run time at equal error."""
    first = study.rows[0].label if study.rows else ""
    lines: dict[tuple[str, str], list[TimeAtError]] = {}
    for time in study.at:
        if time.ratio is not None and time.method != first:
            lines.setdefault((time.method, time.integrator), []).append(time)
    if not lines:
        return None
    integrators, colours = list(dict.fromkeys(integrator for _, integrator in lines)), looks_of_labels(study)

    def draw_axes(figure: Figure) -> None:
        ax = figure.subplots()
        for k, ((method, integrator), times) in enumerate(lines.items()):
            look = colours[method] | {"linestyle": DASHES[integrators.index(integrator) % len(DASHES)]}
            middle = np.array([time.ratio for time in times], dtype=float)
            spread = [middle - [t.ratio_low for t in times], [t.ratio_high for t in times] - middle]
            beside = [time.error * (1.0 + 0.03 * (k - 0.5 * len(lines))) for time in times]  # bars stay apart
            ax.errorbar(beside, middle, spread, **look, capsize=2.0, label=f"{method}, {integrator}")
        ax.axhline(1.0, color=GREY, linewidth=0.8)
        ax.set(xscale="log", yscale="log", xlabel="error [m]", ylabel=f"run time / that of {first}")
        ax.set_title("Ratio of run time at equal error")
        legend_below(figure, len(lines))

    caption = (
        f"Run time over that of {first} with the same integrator at the same error, interpolated between settings: "
        "median and quartiles of rounds in which all runs are timed in turn."
    )
    alternative = f"Ratios of run time at equal error on {study.mechanism}."
    return draw_picture(f"{anchor_of_title(study.mechanism)}-ratio", caption, alternative, draw_axes)


# -- error against run time --------------------------------------------------------------------------------------------


def _groups_of_lines(study: Study) -> list[tuple[str, list[tuple[str, str]]]]:
    """Return (title, lines), lines being pairs of method and integrator: one picture an integrator, rare ones together.

    The usual method-integrator pairs of one integrator are told apart by the method; in the picture of the rest the
    label says both.
    """
    pairs = list(dict.fromkeys((row.label, row.integrator) for row in study.rows))
    integrators = list(dict.fromkeys(integrator for _, integrator in pairs))
    own = {name: [pair for pair in pairs if pair[1] == name] for name in integrators}
    several = len(methods_of_study(study)) >= FEW
    rare = [name for name in integrators if several and len(own[name]) < FEW]
    groups = [(name, own[name]) for name in integrators if name not in rare]
    if rare:
        rest = [pair for name in rare for pair in own[name]]
        groups.append((rest[0][1] if len(rare) == 1 else "other integrators", rest))
    return groups


def _is_drawable(row: Row) -> bool:
    return row.ended and row.error is not None and row.run_seconds > 0.0


def _error_pictures(study: Study) -> list[Picture]:
    shown = [row for row in study.rows if _is_drawable(row)]
    if not shown:
        return []
    groups = _groups_of_lines(study)
    usual = {pair for _, lines in groups for pair in lines if not _has_integrators(lines)}
    pictures, floor = [], _lowest_error(study)
    for title, lines in groups:
        # pictures of one integrator share their axes, so that they can be compared; the rest would stretch them
        together = set(lines) if _has_integrators(lines) else usual
        rows = [r for r in shown if (r.label, r.integrator) in together]
        if rows:
            limits = (
                _axis_limits([r.run_seconds for r in rows]),
                _axis_limits([max(r.error or 0.0, floor) for r in rows]),
            )
            pictures.append(_error_picture(study, title, lines, limits))
    return pictures


def _has_integrators(lines: list[tuple[str, str]]) -> bool:
    return len({integrator for _, integrator in lines}) > 1


def _axis_limits(values: Sequence[float]) -> tuple[float, float]:
    """Return limits of a logarithmic axis, the same for all pictures of a study."""
    low, high = float(np.log10(min(values))), float(np.log10(max(values)))
    margin = 0.06 * max(high - low, 1.0)
    return 10.0 ** (low - margin), 10.0 ** (high + margin)


def _error_picture(
    study: Study, title: str, lines: list[tuple[str, str]], limits: tuple[tuple[float, float], tuple[float, float]]
) -> Picture:
    mixed, colours, markers = _has_integrators(lines), looks_of_labels(study), integrator_markers(study)
    rows = [row for row in study.rows if (row.label, row.integrator) in lines]

    def draw_axes(figure: Figure) -> None:
        ax = figure.subplots()
        for method, integrator in lines:
            own = [r for r in rows if (r.label, r.integrator) == (method, integrator) and _is_drawable(r)]
            look = colours[method] | ({"marker": markers[integrator]} if mixed else {})
            label = f"{method}, {integrator}" if mixed else method
            errors = [max(r.error or 0.0, _lowest_error(study)) for r in own]
            ax.plot([r.run_seconds for r in own], errors, **look, markerfacecolor="none", label=label)
            sure = [(r.run_seconds, e) for r, e in zip(own, errors, strict=True) if not r.below_reference]
            if sure:
                ax.plot(*zip(*sure, strict=True), look["marker"], color=look["color"])
        _shade_floor(ax, study.estimated_error, limits[1])
        ax.set(xscale="log", yscale="log", xlim=limits[0], ylim=limits[1], xlabel="run time", ylabel="error [m]")
        _label_durations(ax, limits[0])
        ax.set_title(f"Error against run time: {title}")
        legend_below(figure, len(lines))

    count = sum(not row.ended for row in rows)
    missing = f" {words.as_sentence(words.plural(count, 'run') + ' failed and cannot be shown')}" if count else ""
    rare = title if not mixed else "integrators that fit few methods"
    caption = (
        f"Error against run time with {rare}, one line a method over steps or tolerances; lower left is better. "
        f"Open marks lie below the error of the reference itself (grey).{missing}"
    )
    alternative = f"Error against run time on {study.mechanism} with {title}, one line a method."
    return draw_picture(
        f"{anchor_of_title(study.mechanism)}-error-{anchor_of_title(title)}", caption, alternative, draw_axes
    )


def _label_durations(ax: Any, limits: tuple[float, float]) -> None:
    """Label a logarithmic axis with durations: decades, and parts of them where there are few."""
    from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter

    few = np.log10(limits[1] / limits[0]) < 2.0
    ax.xaxis.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0) if few else (1.0,), numticks=12))
    ax.xaxis.set_major_formatter(FuncFormatter(lambda x, _: words.seconds_in_words(float(x))))
    ax.xaxis.set_minor_formatter(NullFormatter())


def _shade_floor(ax: Any, estimated: float, limits: tuple[float, float] | None = None) -> None:
    """Shade what is below the error of the reference itself."""
    if not (np.isfinite(estimated) and estimated > 0.0):
        return
    if limits is None or estimated > limits[0]:
        ax.axhspan(FLOOR * 1e-3, estimated, color="#e8ebef", zorder=0, linewidth=0.0)


# -- over time ---------------------------------------------------------------------------------------------------------


def _curves_picture(study: Study, field: str, name: str, label: str, caption: str) -> Picture | None:
    """Return the curves of a field of traces, one a method."""
    curves = [(row.label, trace, np.abs(getattr(trace, field))) for row, trace in representative_rows(study)]
    curves = [curve for curve in curves if len(curve[2]) > 1]
    if not curves:
        return None
    title, colours = f"{name[:1].upper()}{name[1:].replace('-', ' ')} over time", looks_of_labels(study)

    def draw_axes(figure: Figure) -> None:
        ax = figure.subplots()
        for k, (method, trace, values) in enumerate(curves):
            look = colours[method]
            values = np.where(np.isfinite(values), np.maximum(values, FLOOR), np.nan)
            # marks of the curves are at different times, so that none hides another's
            every = max(1, len(values) // MARKS)
            marks = (k * every // max(1, len(curves)), every)
            ax.plot(trace.t, values, **look, markevery=marks, markerfacecolor="white", markersize=4.5, label=method)
        if name == "error":
            _shade_floor(ax, study.estimated_error)
            above = (float(np.nanmin(np.where(v > 0.0, v, np.nan))) for _, _, v in curves if np.any(v > 0.0))
            ax.set_ylim(bottom=max(FLOOR, 0.3 * min((study.estimated_error, *above))))
        ax.set(yscale="log", xlabel="t [s]", ylabel=label, xlim=(0.0, study.until))
        _widen_axis(ax)
        ax.set_title(title)
        legend_below(figure, len(curves))

    alternative = f"{title} on {study.mechanism}, one line a method."
    return draw_picture(f"{anchor_of_title(study.mechanism)}-{name}", caption, alternative, draw_axes)


def _widen_axis(ax: Any) -> None:
    """Widen a logarithmic axis so that rounding noise does not fill the picture."""
    low, high = ax.get_ylim()
    if high / low < 1e3:
        middle = float(np.sqrt(low * high))
        ax.set_ylim(middle / 31.7, middle * 31.7)


def _energies_picture(study: Study) -> Picture | None:
    pairs = [(row, t) for row, t in zip(study.rows, study.traces, strict=True) if row.ended and len(t.t) > 1]
    if not pairs:
        return None
    row, trace = min(pairs, key=lambda pair: np.inf if pair[0].error is None else pair[0].error)
    kinetic, potential = np.array(trace.kinetic), np.array(trace.potential)

    def draw_axes(figure: Figure) -> None:
        ax = figure.subplots()
        ax.plot(trace.t, kinetic, color=COLOURS[0], label="kinetic T")
        ax.plot(trace.t, potential, color=COLOURS[1], linestyle=(0, (5, 1.5)), label="potential V")
        ax.plot(trace.t, kinetic + potential, color="black", linestyle=(0, (1.2, 1.2)), label="T + V")
        ax.axhline(0.0, color=GREY, linewidth=0.6)
        ax.set(xlabel="t [s]", ylabel="energy [J]", xlim=(0.0, study.until))
        ax.set_title("Energy over time")
        legend_below(figure, 3, columns=3)

    which = "the most accurate run" if row.error is not None else "a run that ended"
    caption = (
        f"Energies of the motion in {which} ({row.label}, {row.integrator}, "
        f"{words.setting_in_words(row.step, row.rtol)})."
    )
    alternative = f"Kinetic, potential and total energy of {study.mechanism} over time."
    return draw_picture(f"{anchor_of_title(study.mechanism)}-energy", caption, alternative, draw_axes)

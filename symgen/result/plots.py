"""Plots of quantities: panels with units, in colours that can be told apart by everybody."""

from __future__ import annotations

import textwrap
from collections.abc import Iterator, Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from symgen.base.errors import fit_lines
from symgen.result.labelled import Labelled, columns_at

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.lines import Line2D

#: Okabe and Ito's colours, told apart with every kind of colour vision.
COLOURS = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#56B4E9", "#E69F00", "#000000", "#B8A900")
#: Dashes, told apart on grey paper; their number shares no divisor with that of the colours, so that 40 pairs differ.
DASHES = ("-", (0, (5, 1.5)), (0, (1.2, 1.2)), (0, (6, 1.5, 1.2, 1.5)), (0, (9, 2, 2.5, 2)))
#: Lines of a panel at most: those that change most are drawn, all of them with a key.
LONGEST_LEGEND = 14
#: Smaller violations are drawn here: a logarithm has no zero.
FLOOR = 1e-17
#: Letters of a figure in print [pt]; height of a panel over its width, of a line of the legend, and widths of its
#: handles and of a letter [inch].
LETTERS, PANEL, LINE, HANDLE, LETTER = 8.0, 0.65, 0.16, 0.5, 0.057
#: Height of a name at the end of its line, as a part of a panel, and how the artists of names are found again.
ROW, NAMED = 0.075, "name"
#: Curves that are nowhere further apart than this part of the picture are one line.
APART = 1e-6
#: Unit -> what has it.
MEANINGS = {
    **{"m": "length", "rad": "angle", "m/s": "velocity", "rad/s": "angular velocity", "m/s^2": "acceleration"},
    **{"rad/s^2": "angular acceleration", "N": "force", "N m": "moment", "W": "power", "J": "energy"},
    **{"mm": "length", "deg": "angle", "deg/s": "angular velocity", "deg/s^2": "angular acceleration"},
    **{"kN": "force", "kN m": "moment", "kW": "power"},
}


def panel_of(name: str, unit: str) -> tuple[str, str, bool]:
    """Return title and unit of the panel that a quantity belongs to, and whether its size is drawn as a logarithm."""
    if name.startswith("violation."):
        return "violation", "m, m/s, m/s^2", True
    if name == "energy.error":
        return "|energy error|", unit, True
    if unit == "m" and name.endswith((".x", ".y", ".z")):
        return "position", unit, False
    return MEANINGS.get(unit, ""), "" if unit == "1" else unit, False


def panels_of_table(table: Labelled) -> Iterator[tuple[str, str, bool, Labelled]]:
    """Yield the panels of a table: title, unit, whether sizes are drawn as logarithms, and columns."""
    places: dict[tuple[str, str, bool], list[int]] = {}
    for i, (name, unit) in enumerate(zip(table.names, table.units, strict=True)):
        places.setdefault(panel_of(name, unit), []).append(i)
    for (title, unit, logarithmic), chosen in places.items():
        yield title, unit, logarithmic, columns_at(table, chosen)


def axis_label(title: str, unit: str) -> str:
    """Return the label of an axis: ``angular velocity [rad/s]``."""
    return f"{title} [{unit.replace('^2', '$^2$')}]".strip() if unit else title


def figure_over_column(along: Labelled, table: Labelled, title: str) -> Any:
    """Return a matplotlib figure of columns over another column, a panel for each unit."""
    parts = [*panels_of_table(table)]
    figure, axes = empty_figure(title, len(parts))
    for ax, (meaning, unit, logarithmic, columns) in zip(axes, parts, strict=False):
        draw_lines(ax, along.values[:, 0], columns, logarithmic)
        ax.set_ylabel(axis_label(columns.names[0] if len(columns.names) == 1 else meaning, unit))
    axes[-1].set_xlabel(axis_label(along.names[0], along.units[0]))
    return figure


def empty_figure(title: str, count: int) -> tuple[Any, Any]:
    """Return a matplotlib figure with panels below each other."""
    from matplotlib.figure import Figure

    count = max(1, count)
    figure = Figure(figsize=(8.0, 0.9 + 2.0 * count), layout="constrained")
    axes = np.atleast_1d(figure.subplots(count, 1, sharex=True))
    for ax in axes:
        ax.grid(True, alpha=0.3)
        ax.margins(x=0.01)
    figure.suptitle("\n".join(textwrap.wrap(title, 95)), fontsize=10)
    figure.align_ylabels()
    return figure, axes


def figure_of_paths(curves: Mapping[str, Any], title: str) -> Any:
    """Return a matplotlib figure of curves in the plane of x and y, arrays of shape (k, 2 or more) [m], by name."""
    from matplotlib.figure import Figure

    figure = Figure(figsize=(8.5, 6.0), layout="constrained")
    ax = figure.subplots()
    distinct = _distinct_curves({name: curve[:, :2] for name, curve in curves.items()})
    for i, (name, curve) in enumerate(distinct.items()):
        still = np.ptp(curve, axis=0).max(initial=0.0) == 0.0  # a point that does not move
        ax.plot(curve[:, 0], curve[:, 1], label=name, marker="o" if still else None, **line_style_of(i))
    ax.set(xlabel="x [m]", ylabel="y [m]")
    ax.set_aspect("equal", adjustable="datalim")
    ax.grid(True, alpha=0.3)
    if 0 < len(distinct) <= LONGEST_LEGEND:
        place_legend(ax)
    figure.suptitle("\n".join(textwrap.wrap(title, 80)), fontsize=10)
    return figure


def fit_into(figure: Any, width: float) -> None:
    """Fit a figure into a column of a printed page, `width` wide [mm]: small letters, one legend below, no title."""
    named = dict[str, Any]()
    for ax in figure.axes:
        handles, labels = ax.get_legend_handles_labels()
        at_lines = [artist for artist in ax.get_children() if artist.get_gid() == NAMED]
        if ax.get_legend() is not None or at_lines:
            named |= dict(zip(labels, handles, strict=True))
        for artist in filter(None, (ax.get_legend(), *at_lines)):
            artist.remove()
        ax.tick_params(labelsize=LETTERS - 1)
        for text in (ax.xaxis.label, ax.yaxis.label, ax.title):
            text.set_fontsize(LETTERS)
    inches = width / 25.4
    letters = max(map(len, "\n".join(named).split("\n")), default=0)
    columns = max(1, int(inches / (HANDLE + letters * LETTER)))
    height = PANEL * inches * len(figure.axes) + LINE * -(-len(named) // columns)
    figure.set_size_inches(inches, height)
    figure.suptitle("")
    if named:
        figure.legend(named.values(), named, loc="outside lower center", ncols=columns, fontsize=LETTERS - 1)


def line_style_of(index: int, count: int = 1) -> dict[str, Any]:
    """Return colour and dashes of the line with a number; lines that are too many for a legend shade one scale."""
    if count > LONGEST_LEGEND:
        from matplotlib import colormaps

        return {"color": colormaps["viridis"](index / (count - 1)), "linewidth": 0.7}
    return {
        "color": COLOURS[index % len(COLOURS)],
        "linestyle": DASHES[index % len(DASHES)],
        "linewidth": 1.2,
    }


def _distinct_curves(curves: Mapping[str, Any]) -> dict[str, Any]:
    """Return curves without those that lie on another one, which has their names as well."""
    whole = np.concatenate([curve.ravel() for curve in curves.values()]) if curves else np.zeros(0)
    whole = whole[np.isfinite(whole)]
    room = APART * float(np.ptp(whole)) if len(whole) else 0.0
    merged: dict[str, tuple[list[str], Any]] = {}
    for name, curve in curves.items():
        same = (n for n, (_, other) in merged.items() if np.allclose(curve, other, 0.0, room, equal_nan=True))
        first = next(same, None)
        if first is None:
            merged[name] = [name], curve
        else:
            merged[first][0].append(name)
    return {"\n".join(textwrap.wrap(", ".join(names), 28)): curve for names, curve in merged.values()}


def _most_moving(table: Labelled) -> tuple[Labelled, int]:
    """Return the columns that change most, in their own order, as many as a key holds, and how many are left out."""
    first = fit_lines(len(table.names), LONGEST_LEGEND)
    left = len(table.names) - first
    if not left or not len(table.values):
        return table, 0
    change = np.nan_to_num(np.ptp(table.values, axis=0))
    chosen = sorted(np.argsort(-change, kind="stable")[:first].tolist())
    return columns_at(table, chosen), left


def draw_lines(ax: Axes, along: Any, table: Labelled, logarithmic: bool) -> None:
    """Draw the columns of a table into a panel, their sizes where it is logarithmic, with their names.

    They are drawn over an array of shape (k,), or each over its own column of one of shape (k, n).
    """
    if along.ndim == 2:
        for i, name in enumerate(table.names):
            ax.plot(along[:, i], table.values[:, i], label=name, **line_style_of(i))
        _name_lines(ax)
        return
    table, left = _most_moving(table)
    if left:
        count = len(table.names)
        ax.set_title(f"the {count} that change most; {left} more are left out", fontsize=8, loc="left")
    values = np.maximum(np.abs(table.values), FLOOR) if logarithmic else table.values
    curves = {name: values[:, i] for i, name in enumerate(table.names)}
    for i, (name, curve) in enumerate(curves.items() if logarithmic else _distinct_curves(curves).items()):
        ax.plot(along, curve, label=name, **line_style_of(i))
    if logarithmic:
        ax.set_yscale("log")
    if len(table.names) > 1:
        _name_lines(ax)


def place_legend(ax: Axes) -> None:
    """Put the legend of a panel to the right of it, where it hides nothing."""
    ax.legend(fontsize=7, ncols=1, loc="upper left", bbox_to_anchor=(1.0, 1.0), borderaxespad=0.2)


def _name_lines(ax: Any) -> None:
    """Name lines at their right ends, each with a piece of its dashes, so that grey paper tells them apart.

    Lines that end elsewhere, such as closed curves, have a legend.
    """
    from matplotlib.lines import Line2D

    lines = [line for line in ax.get_lines() if not line.get_label().startswith("_")]
    right = ax.get_xlim()[1] - 0.05 * np.ptp(ax.get_xlim())
    if not all(len(line.get_xdata()) and line.get_xdata()[-1] >= right for line in lines):
        place_legend(ax)
        return
    ends = [_height_of_end(ax, line) for line in lines]
    counts = [line.get_label().count("\n") + 1 for line in lines]
    for line, end, place in zip(lines, ends, _spread_names(ends, counts), strict=True):
        outside = {"transform": ax.transAxes, "clip_on": False, "gid": NAMED, "label": "_"}
        ax.add_artist(Line2D([1.0, 1.025], [end, place], linewidth=0.5, color=line.get_color(), **outside))
        sample = Line2D([1.025, 1.075], [place, place])
        sample.update_from(line)  # a list of dashes has no name
        ax.add_artist(sample).set(**outside)
        ax.text(1.083, place, line.get_label(), transform=ax.transAxes, va="center", fontsize=7, gid=NAMED)


def _height_of_end(ax: Axes, line: Line2D) -> float:
    """Return how high the last finite value of a line is, from 0 to 1 of its panel."""
    values = np.asarray(line.get_ydata(), dtype=float)
    finite = values[np.isfinite(values)]
    if not len(finite):
        return 0.5
    height = ax.transAxes.inverted().transform(ax.transData.transform((0.0, finite[-1])))[1]
    return min(1.0, max(0.0, float(height)))


def _spread_names(ends: Sequence[float], counts: Sequence[int]) -> list[float]:
    """Return heights of names near the ends of their lines, a name of several rows having room for them."""
    order = sorted(range(len(ends)), key=lambda i: -ends[i])
    room = [ROW * count for count in counts]
    places, free = list(ends), np.inf
    for i in order:
        places[i] = min(ends[i], free - 0.5 * room[i])
        free = places[i] - 0.5 * room[i]
    free = -0.5 * ROW
    for i in reversed(order):
        places[i] = max(places[i], free + 0.5 * room[i])
        free = places[i] + 0.5 * room[i]
    return places

"""The pictures of a stress study: the map of methods and cases, and regions of stability."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from symgen.study.report.document import Picture, anchor_of_title
from symgen.study.report.picture import GREY, draw_picture, legend_below
from symgen.study.stress.cell_outcome import OUTCOMES
from symgen.study.stress.stress_rows import LETTERS, Entry, Map, plane_lines, plane_rows

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from symgen.study.stress.stress_rows import Stress, StressRow

#: Colour of each outcome: light for what is well, told apart with every kind of colour vision; letters say the same.
COLOURS = {
    "ok": "#bfe3f5",
    "inaccurate": "#F0E442",
    "wrong branch": "#CC79A7",
    "singular": "#E69F00",
    "diverged": "#D55E00",
    "too slow": "#7f8fa6",
    "refused": "#ffffff",
    "unjudged": "#e4e4e4",
}
#: Both ends of a mark inside the cell of a picture of shares, from its middle, in cells.
MARK = np.array([[-0.15, 0.0], [0.15, 0.0]])
#: rk4 is stable up to here on the negative real axis.
RK4 = 2.785


def outcome_maps(study: Stress) -> tuple[Picture, ...]:
    """Return one map a model: a row for each pair of method and integrator, a column for each case."""
    shown = Map.of_study(study)
    return tuple(_outcome_map(shown, model) for model in dict.fromkeys(row.model for row in shown.rows))


def _outcome_map(shown: Map, model: str) -> Picture:
    rows = _rows_of_many_pairs([row for row in shown.rows if row.model == model])
    cases = list(dict.fromkeys((row.family, row.case) for row in rows))
    lines = [line for line in shown.lines if any((row.method, row.integrator) == line for row in rows)]
    column = {case: i for i, case in enumerate(cases)}
    place = {line: i for i, line in enumerate(lines)}

    def draw_axes(figure: Figure) -> None:
        ax = figure.subplots()
        field = np.full((len(lines), len(cases)), np.nan)
        for row in rows:
            at = place[row.method, row.integrator], column[row.family, row.case]
            field[at] = OUTCOMES.index(row.outcome)
            if row.outcome in LETTERS:
                ax.text(at[1], at[0], LETTERS[row.outcome], ha="center", va="center", fontsize=6.0)
            if row.false_success:
                ax.plot(at[1], at[0], "s", markersize=8.0, markerfacecolor="none", markeredgecolor="black")
        _paint_outcomes(ax, field)
        ax.set_yticks(range(len(lines)), [m if m == i else f"{m}, {i}" for m, i in lines], fontsize=7.0)
        ax.set_xticks(range(len(cases)), [case for _, case in cases], rotation=90, fontsize=6.5)
        starts = [i for i, case in enumerate(cases) if i == 0 or cases[i - 1][0] != case[0]]
        for i, end in zip(starts, [*starts[1:], len(cases)], strict=True):
            ax.axvline(i - 0.5, color=GREY, linewidth=0.8)
            ax.text(
                *((i + end - 1) / 2, -0.7, cases[i][0].replace("-", " ")),
                ha="left",
                va="bottom",
                fontsize=7.0,
                rotation=35,
                rotation_mode="anchor",
            )
        _legend_of_outcomes(figure, ax, rows)

    name = "mechanisms of their own" if model == "-" else model
    caption = (
        f"Outcomes on {name}, a row for each pair of method and integrator, a column for each case. A frame marks runs "
        "that report success although their error exceeds 1e-3 of the length. The table has families of one pair too."
    )
    alternative = f"Map of outcomes on {name} by method and case; the tables below say the same."
    return draw_picture(
        f"map-{anchor_of_title(name)}",
        caption,
        alternative,
        draw_axes,
        height=2.6 + 0.17 * len(lines),
        wide=len(cases) > 12,
    )


def _rows_of_many_pairs(rows: list[StressRow]) -> list[StressRow]:
    """Return the rows of families that are run with several pairs, whose columns are not empty but for one field."""
    pairs: dict[str, set[tuple[str, str]]] = {}
    for row in rows:
        pairs.setdefault(row.family, set()).add((row.method, row.integrator))
    return [row for row in rows if len(pairs[row.family]) > 1] or rows


def overview_picture(study: Stress) -> Picture:
    """Return the share of accurate cells for each pair of method and integrator on each model, planes left out."""
    shown = Map.of_study(study)
    models = list(dict.fromkeys(row.model for row in shown.rows))
    shares = np.full((len(shown.lines), len(models)), np.nan)
    wrong = np.zeros(shares.shape, dtype=int)
    for i, line in enumerate(shown.lines):
        for j, model in enumerate(models):
            entry = Entry(tuple(r for r in shown.entry(line).rows if r.model == model))
            shares[i, j] = 100.0 * entry.good / entry.judged if entry.judged else np.nan
            wrong[i, j] = sum(row.false_success for row in entry.rows)
    return picture_of_shares(shown.lines, models, shares, wrong)


def picture_of_shares(
    lines: Sequence[tuple[str, str]], models: Sequence[str], shares: np.ndarray[Any, Any], wrong: np.ndarray[Any, Any]
) -> Picture:
    """Return the picture of shares of accurate cells [percent], marked where cells are false successes.

    Parameters
    ----------
    lines : sequence of (str, str)
        Method and integrator of each row.
    models : sequence of str
        Of each column.
    shares, wrong : Array, shape (lines, models)
        Shares, not a number where nothing was judged; numbers of false successes.
    """

    def draw_axes(figure: Figure) -> None:
        ax = figure.subplots()
        image = ax.imshow(shares, cmap="cividis", vmin=0.0, vmax=100.0, aspect="auto", interpolation="none")
        places = np.argwhere(wrong > 0)
        # one line: a marker of its own each would be most of the file
        ends = places[:, None, ::-1] + MARK
        marks = np.concatenate([ends, np.full((len(places), 1, 2), np.nan)], axis=1).reshape(-1, 2)
        ax.plot(*marks.T, color="#D55E00", linewidth=4.0, solid_capstyle="butt", scalex=False, scaley=False)
        ax.grid(False)
        # a method's name is written once, where its integrators begin: letters are most of the file
        before = ("", *(method for method, _ in lines))
        labels = [
            integrator if method == last else method if method == integrator else f"{method}, {integrator}"
            for last, (method, integrator) in zip(before, lines, strict=False)
        ]
        ax.set_yticks(range(len(lines)), labels, fontsize=7.0)
        names = ["own" if model == "-" else model for model in models]
        ax.set_xticks(range(len(models)), names, rotation=90, fontsize=7.0)
        ax.tick_params(which="both", length=0)
        figure.colorbar(image, ax=ax, label="accurate [percent]", ticks=[0, 50, 100], fraction=0.03, pad=0.02)

    caption = (
        "Accurate cells of those judged, a row for each pair of method and integrator, a column for each model; a "
        "mark shows where runs report success although their error exceeds 1e-3 of the length; white: not run."
    )
    alternative = "Share of accurate cells by method and model; the tables below say the same for each family."
    return draw_picture("overview", caption, alternative, draw_axes, height=2.0 + 0.17 * len(lines), wide=True)


def _paint_outcomes(ax: Any, field: np.ndarray[Any, Any]) -> None:
    from matplotlib.colors import BoundaryNorm, ListedColormap

    colours = ListedColormap([COLOURS[name] for name in OUTCOMES])
    norm = BoundaryNorm(np.arange(len(OUTCOMES) + 1) - 0.5, len(OUTCOMES))
    ax.imshow(field, cmap=colours, norm=norm, aspect="auto", interpolation="nearest")
    ax.grid(False)
    ax.set_xticks(np.arange(field.shape[1] + 1) - 0.5, minor=True)
    ax.set_yticks(np.arange(field.shape[0] + 1) - 0.5, minor=True)
    ax.grid(True, which="minor", color="white", linewidth=0.7)
    ax.tick_params(which="both", length=0)


def _legend_of_outcomes(figure: Figure, ax: object, rows: Sequence[StressRow]) -> None:
    from matplotlib.patches import Patch

    names = [name for name in OUTCOMES if any(row.outcome == name for row in rows)]
    handles = [
        Patch(facecolor=COLOURS[name], edgecolor=GREY, label=f"{LETTERS[name]} {name}" if name in LETTERS else name)
        for name in names
    ]
    legend_below(figure, len(handles), columns=4, handles=handles)


# -- planes ------------------------------------------------------------------------------------------------------------


def region_pictures(study: Stress) -> tuple[Picture, ...]:
    """Return the pictures of planes: Baumgarte's gains, and step against stiffness."""
    pictures = []
    for family, labels in (
        ("alpha-beta", ("α h", "β h")),
        ("step-stiffness", ("stiffness [N/m]", "step [s]")),
    ):
        rows = plane_rows(study.rows, family)
        for model, method, integrator in plane_lines(rows):
            own = [row for row in rows if (row.model, row.method, row.integrator) == (model, method, integrator)]
            pictures.append(_region_picture(family, labels, model, method, integrator, own))
    return tuple(pictures)


def _region_picture(
    family: str, labels: tuple[str, str], model: str, method: str, integrator: str, rows: Sequence[StressRow]
) -> Picture:
    gains = family == "alpha-beta"
    scale = (rows[0].step or 1.0) if gains else 1.0
    xs, ys = (sorted({row.values[k] * scale for row in rows}) for k in (0, 1))

    def draw_axes(figure: Figure) -> None:
        ax = figure.subplots()
        field = np.full((len(ys), len(xs)), np.nan)
        for row in rows:
            i, j = ys.index(row.values[1] * scale), xs.index(row.values[0] * scale)
            field[i, j] = OUTCOMES.index(row.outcome)
            if row.outcome in LETTERS:
                ax.text(j, i, LETTERS[row.outcome], ha="center", va="center", fontsize=6.0)
        _paint_outcomes(ax, field)
        ax.invert_yaxis()
        ax.set_xticks(range(len(xs)), [f"{x:.2g}" for x in xs], rotation=90 if len(xs) > 8 else 0, fontsize=7.0)
        ax.set_yticks(range(len(ys)), [f"{y:.2g}" for y in ys], fontsize=7.0)
        ax.set(xlabel=labels[0], ylabel=labels[1], title=f"{method}, {integrator}")
        if gains:
            _draw_root_limit(ax, xs, ys)
        _legend_of_outcomes(figure, ax, rows)

    what = "Baumgarte's gains times the step" if gains else "step and stiffness"
    limit = " The line is |root| h = 2.785, where the roots are real." if gains else ""
    caption = f"Outcomes over {what} on {model}, {method} with {integrator}; runs do not watch themselves here.{limit}"
    return draw_picture(
        f"{anchor_of_title(model)}-{family}-{anchor_of_title(method)}",
        *(caption, f"Plane of outcomes over {what}, {method} with {integrator}, on {model}."),
        draw_axes,
        height=3.9,
    )


def _draw_root_limit(ax: Any, xs: Sequence[float], ys: Sequence[float]) -> None:
    """Draw the line on which the larger real root times the step is at rk4's limit; axes count grid points."""
    alphas = np.geomspace(RK4 / 2.0, RK4, 60)
    betas = np.array([np.sqrt(max(1e-300, RK4 * (2.0 * a - RK4))) for a in alphas])
    real = (betas <= alphas * (1.0 + 1e-9)) & (betas >= ys[0] / 3.0)

    def place_on_axis(values: np.ndarray[Any, Any], grid: Sequence[float]) -> np.ndarray[Any, Any]:
        step = np.log(grid[-1] / grid[0]) / max(1, len(grid) - 1)
        return np.asarray(np.log(values / grid[0]) / step)

    ax.plot(place_on_axis(alphas[real], xs), place_on_axis(betas[real], ys), color="black", linewidth=1.2)
    ax.set_xlim(-0.5, len(xs) - 0.5)
    ax.set_ylim(-0.5, len(ys) - 0.5)

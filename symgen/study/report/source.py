"""The source's ratios of computing time, second hand, for comparison with ours."""

from __future__ import annotations

from typing import TYPE_CHECKING

from symgen.study.comparison.comparison_rows import Row
from symgen.study.comparison.comparison_study import Study
from symgen.study.report import words
from symgen.study.report.comparison_findings import USUAL, line_number
from symgen.study.report.document import DocumentTable, Picture, Section
from symgen.study.report.picture import GREY, draw_picture, legend_below, line_style

if TYPE_CHECKING:
    from matplotlib.figure import Figure

#: Methods that the source times against its standard Lagrange method.
METHODS = ("baumgarte", "augmented-lagrangian", "direct-correction")
#: Ours -> the source's name of the mechanism, and its ratios in the order of `METHODS`.
RATIOS = {
    "four-bar": ("planar four-bar", (1.62, 1.82, 1.21)),
    "bricard": ("Bricard", (1.16, 1.33, 1.28)),
    "spatial-slider-crank": ("slider-crank", (1.16, 1.30, 1.39)),
    "front-suspension": ("front suspension", (1.10, 1.17, 1.25)),
}
#: The source's step [s]; its integrator is `USUAL`.
STEP = 1e-3

_TEXT = (
    "F. Marques, A. P. Souto and P. Flores (Multibody System Dynamics 39, 385-419, 2017, doi "
    "10.1007/s11044-016-9530-y) give computing times as ratios to the standard Lagrange method. Their figures are "
    "taken second hand: Carvalho 2022 (T. M. S. P. Carvalho, Multibody 3D Simulation Tool for Vehicle Development, MSc "
    "thesis, IST Lisbon, 2022, tables 3.4 and 3.5). They were measured with other, interpreted code on mechanisms "
    "whose dimensions were not available to us, so this compares magnitudes and reproduces nothing: what Baumgarte's "
    "method adds are two products of a matrix and a vector, and a ratio well above 1 measures an implementation.",
    "Both columns are for the classical Runge-Kutta method of fourth order at constant steps, 1 ms in the source.",
)


def section_beside_source(studies: list[Study]) -> Section | None:
    """Return the section, None where no mechanism of the source was compared with the methods that it times."""
    ours = {study.mechanism: _rows_beside_source(study) for study in studies if study.mechanism in RATIOS}
    if not any(ours.values()):
        return None
    rows = []
    for mechanism, measured in ours.items():
        name, ratios = RATIOS[mechanism]
        for method, theirs in zip(METHODS, ratios, strict=True):
            if (row := measured.get(method)) is not None:
                mine = words.value_with_spread(row.cost_ratio, row.cost_ratio_spread)
                step = f"{words.chosen_number(row.step or 0.0)} s"
                rows.append((name, mechanism, method, words.ratio_in_words(theirs), mine, step))
    headings = ("mechanism of the source", "ours", "method", "source", "symgen", "step")
    table = DocumentTable("Run time as a ratio to lagrange.", headings, tuple(rows), words=3)
    return Section("Compared with the source", _TEXT, tables=(table,), pictures=(_picture_beside_source(ours),))


def _rows_beside_source(study: Study) -> dict[str, Row]:
    """Return the row of each method with the integrator of the source, at the step nearest to the source's."""
    nearest: dict[str, Row] = {}
    for method in METHODS:
        rows = [r for r in study.rows if (r.label, r.integrator) == (method, USUAL) and r.cost_ratio is not None]
        if rows:
            nearest[method] = min(rows, key=lambda r: abs((r.step or 0.0) - STEP))
    return nearest


def _picture_beside_source(ours: dict[str, dict[str, Row]]) -> Picture:
    def draw_axes(figure: Figure) -> None:
        ax = figure.subplots()
        places, labels = [], []
        for i, (mechanism, measured) in enumerate(ours.items()):
            name, ratios = RATIOS[mechanism]
            places.append(-float(i))
            labels.append(name)
            for k, (method, theirs) in enumerate(zip(METHODS, ratios, strict=True)):
                y, look = -i + 0.24 * (1 - k), line_style(line_number(method))
                first = i == 0
                ax.plot(
                    *([theirs], [y], look["marker"]),
                    color=look["color"],
                    markerfacecolor="white",
                    label=f"{method}, source" if first else None,
                )
                row = measured.get(method)
                if row is not None and row.cost_ratio is not None:
                    ax.plot([theirs, row.cost_ratio], [y, y], color=look["color"], linewidth=0.7, alpha=0.5)
                    ax.errorbar(
                        *(row.cost_ratio, y),
                        xerr=row.cost_ratio_spread or 0.0,
                        fmt=look["marker"],
                        color=look["color"],
                        elinewidth=1.0,
                        capsize=2.0,
                    )
                if first:
                    ax.plot([], [], look["marker"], color=look["color"], label=f"{method}, symgen")
        ax.axvline(1.0, color=GREY, linewidth=0.8)
        ax.set_yticks(places, labels)
        ax.set_ylim(-len(ours) + 0.5, 0.5)
        ax.grid(False, axis="y")
        ax.set_xlabel("run time as a ratio to lagrange")
        ax.set_title("The source's ratios and ours")
        legend_below(figure, 2 * len(METHODS))

    caption = (
        "Open: the source, second hand (Carvalho 2022), interpreted code. Filled: this report, compiled code, with the "
        "spread of repeated runs."
    )
    alternative = "Ratios of run time to lagrange for three methods, the source's and ours."
    return draw_picture("beside-the-source", caption, alternative, draw_axes, height=1.6 + 0.5 * len(ours))

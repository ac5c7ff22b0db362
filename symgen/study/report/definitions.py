"""What the numbers of a comparison's report are, column by column."""

from __future__ import annotations

from collections.abc import Sequence

from symgen.study.comparison.comparison_study import Study
from symgen.study.report import words
from symgen.study.report.document import DocumentTable, Section
from symgen.study.yardstick import YARDSTICK

_TEXT = (
    "All numbers are of one run a row, on the mechanism's equations as they are solved: its duration, coordinates, "
    "method and integrator stand beside it. Derivation and compilation are no part of any time: code is compiled, "
    "once a method, before the first round, and later runs read it from a cache. A run that failed keeps its row."
)


def measured_section(studies: Sequence[Study]) -> Section:
    """Return the section that defines every column."""
    lengths = [f"{x.mechanism} {words.rounded_number(x.length)} m" for x in studies if x.length is not None]
    of_lengths = f" ({', '.join(lengths)})" if lengths else ""
    rows = (
        (
            "error",
            "largest distance [m] from a reference motion, over bodies, common output times and points: the centre of "
            "mass of each body and the tips of its axes at the body's own length",
        ),
        ("error / length", f"the error as a share of the mechanism's length{of_lengths}"),
        ("velocity error", "largest difference [m/s] of the velocities of these points"),
        (
            "reaction error",
            "largest difference [N] of the reaction of a joint that the motion determines; a moment counts as the "
            "force that has it at the mechanism's length",
        ),
        (
            "run time",
            "processor time of the thread that runs the integration loop, the median of rounds after a warm-up; other "
            "work of the machine changes it little",
        ),
        ("quartiles", "of that time over the rounds"),
        (
            f"× {YARDSTICK}",
            f"median of ratios to {YARDSTICK} with the same integrator and step or tolerance; each is taken within a "
            "round, in which the row and its yardstick run in turn",
        ),
        (
            "±",
            "distance from the ratio to the farther end of the interval that holds its median with 95 % (the range of "
            "the rounds where there are fewer than six)",
        ),
        ("evaluations", "of the right-hand side, those of rejected steps among them"),
        ("iterations", "of laws, corrections and implicit stages, all steps together"),
        (
            "|Φ|, |D v − ν|, |D v' − γ|",
            (
                "Euclidean norms over all rows of constraints; where some are angles, a radian counts as a metre: the "
                "deviation on an arm of 1 m; the largest of the first two over all steps and outputs, the others over "
                "the outputs"
            ),
        ),
        (
            "|Φ| / length",
            "the largest norm of Φ as a share of the mechanism's length, beside error / length",
        ),
        ("energy error", "largest |T + V − E₀ − W| [J] over all steps, W being the work of forces and drivers"),
    )
    return Section(
        "How it is measured", (_TEXT,), tables=(DocumentTable("Columns.", ("column", "meaning"), rows, words=2),)
    )

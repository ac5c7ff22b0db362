"""Step against stiffness: where the integrated system is stable, for an explicit and three implicit schemes."""

from __future__ import annotations

from dataclasses import replace

from symgen.study.stress.bench import Base, Level, shown
from symgen.study.stress.cases import Family
from symgen.study.stress.cases import stiffness as springs

PAIRS = (
    *(("direct-correction", "rk4"), ("penalty", "rk4")),
    *(("generalized-alpha", "generalized-alpha"), ("index3-augmented-lagrangian", "trapezoidal")),
)
STEPS, QUICK = (0.03, 0.1, 0.3, 1.0, 3.0, 10.0), (0.1, 1.0, 10.0)


def levels(base: Base, quick: bool) -> list[Level]:
    """Return a grid of stiffnesses and steps."""
    return [
        replace(
            spring,
            family="step-stiffness",
            label=f"{spring.label}, {shown(factor * base.step)} s",
            values=(spring.values[0], factor * base.step),
            step=factor * base.step,
            pairs=PAIRS,
            watched=False,
        )
        for spring in springs.levels(base, quick)
        for factor in (QUICK if quick else STEPS)
    ]


KIND = Family("stability over step and stiffness", ("stiffness [N/m]", "step [s]"), levels)

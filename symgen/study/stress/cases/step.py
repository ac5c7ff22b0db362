"""Constant steps from a hundredth to a hundred times the mechanism's own."""

from __future__ import annotations

from symgen.study.stress.bench import Base, Level, pick, shown
from symgen.study.stress.cases import Family

VALUES, QUICK = (1e-2, 1e-1, 1.0, 1e1, 1e2), (1.0, 1e1)


def levels(base: Base, quick: bool) -> list[Level]:
    """Return one case a step; 1e-5 s to 1e-1 s for a mechanism whose own is 1e-3 s."""
    return [
        base.level(
            "step",
            f"{shown(f * base.step)} s",
            f * base.step,
            step=f * base.step,
            constant_steps=True,
            closed=base.closed,
        )
        for f in pick(VALUES, QUICK, quick)
    ]


KIND = Family("constant step", ("step [s]",), levels)

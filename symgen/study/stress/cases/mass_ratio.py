"""Mass and inertia of the middle body, very small and very large against the others."""

from __future__ import annotations

from symgen.study.stress.bench import MASS, Base, Level, NotApplicable, pick, shown
from symgen.study.stress.cases import Family

VALUES, QUICK = (1e-9, 1e-6, 1e-3, 1e3, 1e6, 1e9), (1e-9, 1e3)


def levels(base: Base, quick: bool) -> list[Level]:
    """Return one case a factor."""
    if len(base.mechanism.bodies) < 2:
        raise NotApplicable("it has one body, so no ratio of masses")
    return [base.level("mass-ratio", f"mass x {shown(f)}", f, parameters={MASS: f}) for f in pick(VALUES, QUICK, quick)]


KIND = Family("mass of the middle body", ("factor on mass and inertia",), levels)

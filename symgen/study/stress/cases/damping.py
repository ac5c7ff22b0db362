"""A damper between the ground and the middle body, from weak to almost rigid."""

from __future__ import annotations

from symgen.study.stress.bench import DAMPING, Base, Level, pick, shown
from symgen.study.stress.cases import Family

VALUES, QUICK = (1e2, 1e4, 1e6, 1e8, 1e10), (1e2, 1e6)


def levels(base: Base, quick: bool) -> list[Level]:
    """Return one case a damping."""
    base.need_spring()
    return [base.level("damping", f"{shown(c)} N s/m", c, parameters={DAMPING: c}) for c in pick(VALUES, QUICK, quick)]


KIND = Family("damping on the middle body", ("damping [N s/m]",), levels)

"""A spring between the ground and the middle body, from soft to rigid; unloaded at the start."""

from __future__ import annotations

from symgen.study.stress.bench import STIFFNESS, Base, Level, pick, shown
from symgen.study.stress.cases import Family

VALUES, QUICK = (1e2, 1e4, 1e6, 1e8, 1e10), (1e2, 1e6)


def levels(base: Base, quick: bool) -> list[Level]:
    """Return one case a stiffness; stiffer ones last shorter, as their oscillations are faster."""
    base.need_spring()
    return [
        base.level(
            "stiffness",
            f"{shown(k)} N/m",
            k,
            parameters={STIFFNESS: k},
            until=base.nominal * min(1.0, (1e6 / k) ** 0.25),
            spring_end=base.spring_end,
        )
        for k in pick(VALUES, QUICK, quick)
    ]


KIND = Family("stiffness of a spring on the middle body", ("stiffness [N/m]",), levels)

"""A four-bar linkage with a crank of 1 m and the other links up to a million times as long."""

from __future__ import annotations

import math

from symgen.study.stress.bench import Base, Level, pick, shown
from symgen.study.stress.cases import Family
from symgen.study.stress.cases._quadrilateral import quadrilateral

VALUES, QUICK = (1.0, 1e1, 1e2, 1e4, 1e6), (1.0, 1e2)


def levels(base: Base, quick: bool) -> list[Level]:
    """Return one case a ratio; the base model plays no part."""
    return [
        Level(
            *("length-ratio", f"1 : {shown(r)}", (r,)),
            mechanism=quadrilateral(1.0, 4.0 * r, 2.5 * r, 5.0 * r, math.pi / 3.0),
            until=2.0,
            step=1e-3,
        )
        for r in pick(VALUES, QUICK, quick)
    ]


KIND = Family("ratio of link lengths", ("other lengths / crank length",), levels, own=True)

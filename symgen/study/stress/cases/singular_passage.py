"""A parallelogram that passes its flat position, exactly and by a gap that an uneven base leaves."""

from __future__ import annotations

import math

from symgen.study.stress.bench import Base, Level, pick, shown
from symgen.study.stress.cases import Family
from symgen.study.stress.cases._quadrilateral import quadrilateral

#: How much longer the base is than the coupler [m]; 0 is singular.
VALUES, QUICK = (0.0, 1e-4, 1e-3, 1e-2, 1e-1), (0.0, 1e-1)


def levels(base: Base, quick: bool) -> list[Level]:
    """Return one case a gap; the base model plays no part."""
    return [
        Level(
            *("singular-passage", f"gap {shown(gap)} m", (gap,)),
            mechanism=quadrilateral(1.0, 1.0, 1.0, 1.0 + gap, math.pi / 2.0, -1.0),
            until=4.0,
            step=1e-3,
            outputs=160,
            closed=None if gap else "parallelogram",
        )
        for gap in pick(VALUES, QUICK, quick)
    ]


KIND = Family("passage through a singular position", ("gap [m]",), levels, own=True)

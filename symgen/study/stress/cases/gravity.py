"""Gravity from none to a thousand times the usual."""

from __future__ import annotations

import math

from symgen.study.stress.bench import GRAVITY, Base, Level, pick, shown
from symgen.study.stress.cases import Family

VALUES, QUICK = (0.0, 1e1, 1e2, 1e3, 1e4), (0.0, 1e3)


def levels(base: Base, quick: bool) -> list[Level]:
    """Return one case an acceleration; the stronger, the shorter, as the motion is faster."""
    return [
        base.level(
            "gravity",
            f"{shown(g)} m/s^2",
            g,
            parameters={GRAVITY: g / base.gravity},
            until=base.nominal / math.sqrt(max(1.0, g / 10.0)),
        )
        for g in pick(VALUES, QUICK, quick)
    ]


KIND = Family("acceleration of gravity", ("gravity [m/s^2]",), levels)

"""The plane of Baumgarte's gains: where the integrated system is stable."""

from __future__ import annotations

import numpy as np

from symgen.study.stress.bench import Base, Level, shown
from symgen.study.stress.cases import Family


def levels(base: Base, quick: bool) -> list[Level]:
    """Return a grid of alpha h and beta h from 0.05 to 10 or so, with `rk4` at the mechanism's step."""
    points = 7 if quick else 15
    found = []
    for a in np.geomspace(0.05, 12.8, points):
        for b in np.geomspace(0.05, 12.8, points):
            alpha, beta = float(a) / base.step, float(b) / base.step
            found.append(
                base.level(
                    *("alpha-beta", f"alpha h = {shown(round(float(a), 3))}, beta h = {shown(round(float(b), 3))}"),
                    *(alpha, beta),
                    options={"method.alpha": alpha, "method.beta": beta},
                    pairs=(("baumgarte", "rk4"),),
                    watched=False,
                    closed=base.closed,
                )
            )
    return found


KIND = Family("stability in the plane of Baumgarte's gains", ("alpha [1/s]", "beta [1/s]"), levels)

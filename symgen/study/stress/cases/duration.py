"""Long runs: errors that grow slowly, and drift off the constraints."""

from __future__ import annotations

import math

from symgen.study.stress.bench import Base, Level, pick, shown
from symgen.study.stress.cases import Family

#: In steps of the mechanism: 10 s, 100 s and 2000 s where its own step is 1e-3 s. The longest runs with steps twice as
#: long, so that methods with constant steps stay within the budget of evaluations.
VALUES, QUICK, LONG = (1e4, 1e5, 2e6), (1e4,), 1e6


def levels(base: Base, quick: bool) -> list[Level]:
    """Return one case a duration, none longer than the motion can be predicted."""
    longest = base.mechanism.defaults.predictable_until or math.inf
    lengths = dict.fromkeys(min(n * base.step, longest) for n in pick(VALUES, QUICK, quick))
    steps = {t: base.step * (2.0 if t >= LONG * base.step else 1.0) for t in lengths}
    return [
        base.level("duration", f"{shown(t)} s", t, until=t, step=steps[t], outputs=100, closed=base.closed)
        for t in lengths
    ]


KIND = Family("duration", ("duration [s]",), levels)

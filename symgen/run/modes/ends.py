"""Why steps of a run with bounded rows have become too short: what its formulas are just after the end."""

from __future__ import annotations

import math

from symgen.compile.loopcode.exact import exact
from symgen.compile.native.annotations import Array, Integers
from symgen.run.layout import abi
from symgen.run.layout.scales import larger_number
from symgen.run.modes.bounded_rows import NO_NUMBER, SAME
from symgen.run.modes.found_rows import allow_depth
from symgen.run.modes.probing import copy_state, write_rates
from symgen.run.modes.reading import find_fault, read_rows
from symgen.run.modes.row_records import Choice

#: How long after the end formulas are looked at, over what the time resolves.
_AHEAD = 64.0


@exact(entry=True)
def find_undefined(t: float, step: float, c: Choice, y: Array, p: Array, w: Array, iw: Integers) -> int:
    """Return `NO_NUMBER`, with the row named, where one of its formulas is no number just after a state; else `SAME`.

    The state goes on along its rates: a formula may lose its meaning over time or over coordinates. It is looked at
    after twice the `step` that has failed [s], and after more than what the time resolves.
    """
    h = larger_number(2.0 * step, _AHEAD * larger_number(abi.RESOLVED_TIME * abs(t), abi.SHORTEST_STEP))
    copy_state(c, y, w, iw)
    write_rates(t, c, p)
    for i in range(y.shape[0]):
        c.y[i] += h * c.rate[i]
    allow_depth(c, math.inf)
    if read_rows(t + h, c, c.y, p, c.w) == SAME:
        return SAME
    return NO_NUMBER if find_fault(c, c.w) == NO_NUMBER else SAME

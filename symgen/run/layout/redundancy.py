"""Choice of independent rows where rows are permanently redundant: it depends on the position.

Rows that are left out have an infinite mask. Any rows that span the others are valid, but rows that span them at one
position may not at another: of two pins on one turning body, the row along the line through them is redundant.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from symgen.compile.loopcode.exact import exact
from symgen.compile.store.jit import jit
from symgen.run.layout import abi
from symgen.run.layout.records import Run, Sizes
from symgen.run.layout.scales import VANISHED, entry_of, row_weight
from symgen.run.layout.start_records import Layout

if TYPE_CHECKING:
    pass

Array = NDArray[np.float64]


#: The rows are chosen again where the smallest pivot has fallen to this fraction of its largest value since the choice.
FALLEN = 0.25
#: Relative difference below which lengths are equal: of equal rows the first are kept, as where a joint occurs twice,
#: and not those that rounding makes a bit longer.
EQUAL = 1e-9
#: Largest number of entries of a dense D whose rows are chosen again; above, those of the start stay.
LARGEST = 250_000


@exact(entry=True)
def is_off(layout: Layout, row: int, w: Array) -> bool:
    """Whether a row is off."""
    return not (layout.switches[row] < 0 or w[layout.switches[row]] != 0.0)


@exact()
def row_weight_in_force(layout: Layout, w: Array, i: int) -> float:
    """Return the factor that makes a row of Phi a length, 0 where the row is off."""
    return 0.0 if is_off(layout, i, w) else float(row_weight(layout, w, i))


@exact(entry=True)
def farthest_row(layout: Layout, width: int, count: int, least: float, weighed: int, w: Array, room: Array) -> int:
    """Choose up to `count` rows, each the one farthest from the rows chosen before it; return their number.

    Rows that are off are zero.

    Unlike an elimination in a fixed order this takes small pivots last, so that rounding is not amplified: the number
    of rows that are farther than `least` is the rank.

    Parameters
    ----------
    layout : Layout
        Of the model.
    width, count : int
        Numbers kept of a row, and the largest number of chosen rows. With `width` nv + m, the remainder of a row is
        followed by the lengths of all rows in the sum that it is.
    least : float
        Square of the sine of the angle between a row and those chosen, below which it is not chosen.
    weighed : int
        1 where rows that have vanished by the section ``row_weight`` are set to zero; 0 where it is not filled yet.
    w : Array
        Scratch; D belongs to the present position.
    room : Array, shape (m * width + m,)
        Working memory; of its last m numbers, those of chosen rows are negative.
    """
    m, n, entries = layout.m, layout.nv, layout.entries
    for i in range(m * width + m):
        room[i] = 0.0
    for k in range(layout.constants.shape[0]):
        row, column = entries[3 * k], entries[3 * k + 1]
        room[row * width + column] = entry_of(layout, w, k) * math.sqrt(w[layout.gauge + column])
    lengths = m * width
    for i in range(m):
        square = 0.0
        for j in range(n):
            square += room[i * width + j] * room[i * width + j]
        vanished = weighed != 0 and square * w[layout.row_weight + i] < VANISHED
        if vanished or is_off(layout, i, w):
            for j in range(n):
                room[i * width + j] = 0.0
            square = 0.0
        room[lengths + i] = 1.0 / square if square > 0.0 else 0.0
        if width > n:
            room[i * width + n + i] = math.sqrt(square) if square > 0.0 else 1.0
    for chosen in range(count):
        best, most = -1, -1.0
        for i in range(m):
            if room[lengths + i] >= 0.0:  # of the remaining rows
                square = 0.0
                for j in range(n):
                    square += room[i * width + j] * room[i * width + j]
                if square * room[lengths + i] > most * (1.0 + EQUAL):
                    best, most = i, square * room[lengths + i]
        if most < least:
            return chosen
        if most > 0.0:
            square = most / room[lengths + best]
            for i in range(m):
                if i != best and room[lengths + i] >= 0.0:
                    total = 0.0
                    for j in range(n):
                        total += room[i * width + j] * room[best * width + j]
                    for j in range(width):
                        room[i * width + j] -= total / square * room[best * width + j]
        room[lengths + best] = -1.0
    return count


@exact(entry=True)
def choose_rows(layout: Layout, count: int, weighed: int, w: Array, room: Array) -> int:
    """Mask all rows in force but those kept, of which the others are linear combinations with small factors.

    An error in a kept row causes one in the others, times these factors. The rows left over by `farthest_row` are
    linear combinations of all rows that vanish. The row with the largest factor in each, in turn, is left out: so no
    factor is much above 1, whatever rows `farthest_row` chose. Rows that are eliminated alone always stay: they are
    independent of each other. The choice depends on the position only, not on earlier choices.

    Parameters
    ----------
    layout, weighed, w
        As for `farthest_row`.
    count : int
        Number of kept rows, with those that are off: their mask is 0.
    room : Array, shape (m * (nv + m) + 2 * m,)
        Working memory.

    Returns
    -------
    int
        1 where other rows are kept than before.
    """
    m, n, alone, mask = layout.m, layout.nv, layout.alone, layout.mask
    width = n + m
    for i in range(m):
        count -= 1 if is_off(layout, i, w) else 0
    if farthest_row(layout, width, count, 0.0, weighed, w, room) < count:
        return 0  # D is not finite
    lengths, masked, changed = m * width, m * width + m, 0
    for i in range(m):
        room[masked + i] = 0.0
    for _ in range(m - count):
        sum_, row, most = -1, -1, -1.0
        for i in range(m):
            for k in range(m if room[lengths + i] >= 0.0 else 0):
                size = abs(room[i * width + n + k])
                more = size > most * (1.0 + EQUAL) or (k > row and size > most * (1.0 - EQUAL))
                if room[masked + k] == 0.0 and alone[k] == 0 and more:
                    sum_, row, most = i, k, size
        if row < 0:  # all remaining sums are of rows that are not finite
            return 0
        room[masked + row], room[lengths + sum_] = math.inf, -1.0
        for i in range(m):
            if room[lengths + i] >= 0.0:
                share = room[i * width + n + row] / room[sum_ * width + n + row]
                for k in range(m):
                    room[i * width + n + k] -= share * room[sum_ * width + n + k]
    for i in range(m):
        if is_off(layout, i, w):  # it is no linear combination of others
            room[masked + i] = 0.0
        changed = changed if w[mask + i] == room[masked + i] else 1
        w[mask + i] = room[masked + i]
    return changed


def room_of_choice(m: int, n: int) -> int:
    """Return the length of the working memory of `choose_rows`, 0 for a D so large that rows stay the same."""
    return m * (n + m) + 2 * m if m * n <= LARGEST else 0


@jit()
def leave_out_rest(sizes: Sizes, w: Array, k: Array, right: Array) -> None:
    """Set the residuals of redundant rows in the constraints of a stage to their multipliers, which have to be 0.

    Parameters
    ----------
    sizes : Sizes
        Of the model.
    w, k, right : Array
        Scratch, and unknowns and residuals of the stage.
    """
    first = sizes.nq + sizes.nv
    for i in range(first, sizes.unknowns - sizes.states):
        if w[sizes.mask + (i - first) % sizes.m] > 0.0:
            right[i] = k[i]


def rows_fell(run: Run) -> bool:
    """Whether rows are left out and the smallest pivot has fallen much since the choice."""
    control, gauges, pivot = run.control, run.gauges, run.w[abi.PIVOT]
    if control[abi.MASKED] == 0:
        return False
    if pivot > gauges[abi.CHOSEN]:
        gauges[abi.CHOSEN] = pivot
    if pivot >= FALLEN * gauges[abi.CHOSEN]:
        return False
    gauges[abi.CHOSEN] = 0.0
    return True


def no_rows_fell(run: Run) -> bool:
    """Return False: the replacement of `rows_fell` where rows stay the same."""
    return False

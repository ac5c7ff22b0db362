"""Whole turns of the angles in space at a start: those with which drivers, gears and threads are nearest to closed.

An angle between directions is known up to whole turns only, and positions do not say how many there were. The section
``winding`` remembers the angle; ``measure``, called after ``geometry`` at the same state, follows it from state to
now. At a start it begins on the branch of (-pi, pi] and is shifted here by whole turns.
"""

from __future__ import annotations

import math
from typing import Any

from symgen.runtime import abi, decisions
from symgen.runtime.exact import exact
from symgen.runtime.scales import row_weight
from symgen.runtime.start_records import TURNS


@exact(TURNS.signature)
def choose_turns(geometry: Any, measure: Any, layout: Any, now: Any, work: Any) -> int:
    """Shift the section ``winding`` by the whole turns with which the rows on angles are nearest to closed.

    Parameters
    ----------
    geometry, measure : emitted functions
        See `symgen.runtime.abi`.
    layout, now, work : Layout, Instant, Work
        See `symgen.runtime.start_records`; the coordinates are those described.
    """
    m, count, w, residual = layout.m, layout.windings, now.w, layout.residual
    rest, effects = work.right, work.numbers
    for i in range(count):
        w[abi.WINDING + i] = 0.0
    geometry(layout.t, now.y, now.p, w)
    finite = True
    for r in range(m):
        rest[r] = w[residual + r]
        finite = finite and math.isfinite(rest[r])
    measure(layout.t, now.y, now.p, w)  # from here on the section of the residual may hold something else
    for i in range(count):
        angle = w[abi.WINDING + i]
        w[abi.WINDING + i] = angle + math.tau
        geometry(layout.t, now.y, now.p, w)
        w[abi.WINDING + i] = angle
        for r in range(m):
            effect = w[residual + r] - rest[r]
            finite = finite and math.isfinite(effect)
            least = decisions.LEAST_EFFECT * w[abi.LENGTH] / row_weight(layout, w, r)
            effects[r * count + i] = effect if abs(effect) >= least else 0.0
    if finite:
        turns = m * count
        whole_turns(m, count, effects, rest, turns)
        for i in range(count):
            w[abi.WINDING + i] += math.tau * effects[turns + i]
    return 0


@exact()
def whole_turns(m: int, count: int, effects: Any, rest: Any, turns: int) -> None:
    """Set how many turns to add to each angle.

    Parameters
    ----------
    m, count : int
        Rows and angles.
    effects : Array, shape (m * count + 2 * count + m,)
        What one turn of each angle adds to the residual of each row, row by row; then room for the result.
    rest : Array, shape (m,)
        The residual without any; on return with them.
    turns : int
        Where the result begins in `effects`.

    Notes
    -----
    Rows are taken in turn, those first that leave a single angle to be shifted (drivers, then what gears tie to
    them), among these the ones on which a turn has the largest effect. A row that leaves several is closed by the angle
    that closes it best, and the others stay free for further rows.
    """
    free, waiting = turns + count, turns + 2 * count
    for k in range(turns, waiting + m):
        effects[k] = 0.0
    for r in range(m):
        for i in range(count):
            if effects[r * count + i] != 0.0:
                effects[free + i] = effects[waiting + r] = 1.0
    for _ in range(m):
        row, least, largest = -1, count + 1, 0.0
        for r in range(m):
            if effects[waiting + r] != 0.0:
                choices, size = 0, 0.0
                for i in range(count):
                    effect = abs(effects[r * count + i])
                    choices += 1 if effect != 0.0 and effects[free + i] != 0.0 else 0
                    size = effect if effect > size else size
                if choices < least or (choices == least and size > largest):
                    row, least, largest = r, choices, size
        if row < 0:
            return
        effects[waiting + row] = 0.0
        column, best, wanted = -1, math.inf, 0.0
        for i in range(count):
            effect = effects[row * count + i]
            if effect != 0.0 and effects[free + i] != 0.0:
                number = float(round(-rest[row] / effect))
                left = abs(rest[row] + number * effect)
                if left < best:
                    column, best, wanted = i, left, number
        if column >= 0:
            effects[turns + column] = wanted
            effects[free + column] = 0.0
            for r in range(m):
                rest[r] += wanted * effects[r * count + column]


@exact(TURNS.signature)
def choose_no_turns(geometry: Any, measure: Any, layout: Any, now: Any, work: Any) -> int:
    """Stand in for `choose_turns` where no angle counts turns, so that it is not compiled."""
    return 0

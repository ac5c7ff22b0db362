"""Parts of the start of one run: close positions, complete velocities, find redundant rows and undetermined rates.

Arguments are the records `closing`, `layout`, `now` and `work` of `symgen.run.layout.start_records`, and further rows
of joint coordinates after those of the model, if any (`symgen.run.starts.joint_starts.Further`).
"""

from __future__ import annotations

import math

from symgen.base.ir.numerics import SKIP
from symgen.compile.loopcode.bare import part
from symgen.compile.loopcode.exact import copy_numbers, exact
from symgen.compile.native.annotations import Array
from symgen.run.layout import abi
from symgen.run.layout import ensemble_abi as e
from symgen.run.layout.redundancy import choose_rows, farthest_row, is_off, row_weight_in_force
from symgen.run.layout.scales import (
    VANISHED,
    coarseness_of,
    entry_of,
    extent_of,
    free_scale,
    larger_number,
    row_weight,
    size_of_change,
    speed_of,
    square_rows,
    weigh_rows,
)
from symgen.run.layout.start_records import Closing, Instant, Layout, Work
from symgen.run.starts import decisions
from symgen.run.starts.decisions import is_dependent, is_poor
from symgen.run.starts.joint_starts import Further, fill_further
from symgen.run.starts.start_solvers import multiply


@exact()
def close_positions(closing: Closing, layout: Layout, now: Instant, work: Work, further: Further) -> bool:
    """Close positions by least changes; coordinates with scale 0 stay fixed. Return whether positions are closed.

    If so, D, nu and the angles that count turns belong to the closed positions; else Phi belongs to the last ones.
    """
    y, p, w, right, x = now.y, now.p, now.w, work.right, work.x
    best, stalled = math.inf, 0
    for _ in range(decisions.POSITION_STEPS):
        place_constraints(closing, layout, now, work, further)
        square = 0.0
        for i in range(layout.m):
            right[i] = -w[layout.residual + i]
            square += (row_weight_in_force(layout, w, i) * right[i]) ** 2
        size, length = math.sqrt(square), larger_number(w[abi.LENGTH], extent_of(layout, y))
        stalled = stalled + 1 if size > 0.5 * best else 0
        best = size if size < best else best
        if not math.isfinite(size) or stalled >= decisions.POSITION_STALLS:
            return False
        if layout.windings > 0:  # may overwrite the section of Phi
            closing.measure(layout.t, y, p, w)
        resolved = larger_number(length, coarseness_of(layout, y))
        rounding = decisions.ROUNDING * resolved * (layout.m if layout.m > 1 else 1)
        closed = larger_number(decisions.CLOSED * length, rounding)
        if size <= rounding or (stalled >= decisions.CLOSED_STALLS and size < closed):
            return True
        closing.solve(closing.spread, layout, now, work)
        longest = size_of_change(layout, w, x)
        # far from closed, a full Newton step can turn bodies by several radians
        _shift_positions(
            closing, layout, y, w, x, decisions.LONGEST_STEP / larger_number(longest, decisions.LONGEST_STEP)
        )
    place_constraints(closing, layout, now, work, further)
    return False


@exact()
def place_constraints(closing: Closing, layout: Layout, now: Instant, work: Work, further: Further) -> None:
    """Fill Phi, D and nu at a position, including the rows of held joint coordinates."""
    closing.geometry(layout.t, now.y, now.p, now.w)
    if further.held.shape[0] > 0:
        fill_further(layout, now, work, further)


@exact()
def _shift_positions(closing: Closing, layout: Layout, y: Array, w: Array, change: Array, factor: float) -> None:
    """Move the coordinates by a multiple of a change of the velocities."""
    if layout.nq == layout.nv:
        for j in range(layout.nv):
            y[j] += factor * change[j]
    else:
        for j in range(layout.nv):
            w[layout.change + j] = factor * change[j]
        closing.move(y, w)


@exact()
def complete_velocities(closing: Closing, layout: Layout, now: Instant, work: Work, velocities: Array) -> int:
    """Set the velocities: specified ones are kept, the others are the smallest that satisfy D v = nu.

    If the specified ones contradict the constraints, all but the held ones are projected in the metric of the mass
    matrix. Returns `ASSEMBLED`, `PROJECTED` or `CONTRADICTION`.
    """
    n, w, v, mass, scale = layout.nv, now.w, part(now.y, layout.nq, layout.nv), layout.mass, work.scale
    for j in range(n):
        v[j] = velocities[j] if math.isfinite(velocities[j]) else 0.0
        scale[j] = 0.0 if math.isfinite(velocities[j]) else free_scale(layout, w, j)
    if layout.m == 0:
        return int(e.ASSEMBLED)
    speed = speed_of(layout, w, v)
    for i in range(layout.m):  # of drivers
        speed = larger_number(speed, row_weight_in_force(layout, w, i) * abs(w[layout.nu + i]))
    _velocity_violation(layout, now, work)
    size = _correct_velocities(closing, layout, now, work)
    if size <= decisions.VELOCITIES_FIT * speed:
        # the rest is rounding: remove it with negligible changes of specified values and none of held ones
        for j in range(n):
            scale[j] = 0.0 if layout.unchanged[j] != 0 else free_scale(layout, w, j)
        _correct_velocities(closing, layout, now, work)
        return int(e.ASSEMBLED)
    if closing.masses.places.shape[0] > 0:
        closing.project(closing.formulas, closing.masses, layout, now, work)
        size = _velocity_violation(layout, now, work)
    else:
        heaviest = 0.0
        for j in range(n):
            heaviest = larger_number(heaviest, w[mass + j] * w[layout.gauge + j])
        for j in range(n):  # massless bodies give way first
            least = decisions.LEAST_MASS * (heaviest if heaviest > 0.0 else 1.0) / w[layout.gauge + j]
            weight = w[mass + j] if w[mass + j] > least else least
            scale[j] = 0.0 if layout.unchanged[j] != 0 else 1.0 / math.sqrt(weight)
        for _ in range(2):
            size = _correct_velocities(closing, layout, now, work)
    return int(e.PROJECTED if size <= decisions.VELOCITIES_CONTRADICT * speed else e.CONTRADICTION)


@exact()
def _velocity_violation(layout: Layout, now: Instant, work: Work) -> float:
    """Set `work.right` to nu - D v and return its length."""
    w, right, square = now.w, work.right, 0.0
    multiply(layout, w, part(now.y, layout.nq, layout.nv), right)
    for i in range(layout.m):
        right[i] = w[layout.nu + i] - right[i]
        square += (row_weight_in_force(layout, w, i) * right[i]) ** 2
    return math.sqrt(square)


@exact()
def _correct_velocities(closing: Closing, layout: Layout, now: Instant, work: Work) -> float:
    """Add the shortest change for nu - D v in `work.right`; return the norm of the remainder, which replaces it."""
    closing.solve(closing.spread, layout, now, work)
    y, x = now.y, work.x
    for j in range(layout.nv):
        y[layout.nq + j] += x[j]
    return float(_velocity_violation(layout, now, work))


@exact()
def mask_redundant(closing: Closing, layout: Layout, now: Instant, work: Work, nothing: Further) -> int:
    """Weigh rows; mask as many as depend on others at the start and at closed positions near it; return their number.

    Rows that depend on others only at the start do so at a singular position and are kept. The dependent rows may
    differ between positions, and masking the last ones in the order of elimination may leave rows that hardly differ:
    then the rows farthest from each other are kept.
    """
    m, other = layout.m, Instant(work.y, now.p, work.w)
    weigh_rows(layout, now)
    count = _mask_dependent_rows(closing, layout, now, work)
    poor = m > 0 and layout.sparse == 0 and is_poor(_active_pivot(layout, now.w))
    count = _count_dependent(layout, now.w, work) if poor else count
    alone, same = count, not poor
    for k in range(decisions.PROBES):
        for j in range(layout.nv):
            work.scale[j] = free_scale(layout, now.w, j)
        if count == 0:
            break
        # a direction along the constraints, another one each time
        _find_free_direction(closing, layout, now, work, k + 1.0)
        size = size_of_change(layout, now.w, work.direction)
        if size < decisions.STANDSTILL:
            break
        _copy_array(layout, now, other)
        for i in range(m):
            other.w[layout.mask + i] = 0.0
        _shift_positions(closing, layout, other.y, other.w, work.direction, decisions.PROBE_DISTANCE / size)
        closed = close_positions(closing, layout, other, work, nothing)
        near = _mask_dependent_rows(closing, layout, other, work)
        if closed:
            for i in range(m):
                same = same and (now.w[layout.mask + i] != 0.0 or other.w[layout.mask + i] == 0.0)
            if layout.sparse == 0 and is_poor(_active_pivot(layout, other.w)):
                near, same = _count_dependent(layout, other.w, work), False
            count = near if near < count else count
    return int(_mask_rows(closing, layout, now, other, work, count, alone, same))


@exact()
def _mask_dependent_rows(closing: Closing, layout: Layout, now: Instant, work: Work) -> int:
    """Mask the rows in force that depend on others or have vanished at a position; return their number.

    Vanished rows take no part in the elimination, where rounding divided by rounding would decide.
    """
    w, squares, count = now.w, work.right, 0
    square_rows(layout, w, squares)
    for i in range(layout.m):
        usual = row_weight(layout, w, i)
        if squares[i] * usual * usual < VANISHED and not is_off(layout, i, w):
            w[layout.mask + i] = math.inf
            count += 1
    if count > 0:
        closing.geometry(layout.t, now.y, now.p, w)
    for i in range(layout.m):
        if w[layout.mask + i] != 0.0:
            w[layout.pivot + i] = 0.0
        elif is_dependent(w[layout.pivot + i]) and not is_off(layout, i, w):
            w[layout.mask + i] = math.inf
            count += 1
    return count


@exact()
def _count_dependent(layout: Layout, w: Array, work: Work) -> int:
    """Return the number of rows in force that depend on others, where small pivots have amplified rounding."""
    count = -farthest_row(layout, layout.nv, layout.m, SKIP, 1, w, work.numbers)
    for i in range(layout.m):
        count += 0 if is_off(layout, i, w) else 1
    return int(count)


@exact()
def _mask_rows(
    closing: Closing, layout: Layout, now: Instant, other: Instant, work: Work, count: int, alone: int, same: bool
) -> int:
    """Mask `count` rows, chosen from those dependent at the start alone or from all; return their number."""
    m, mask = layout.m, layout.mask
    if count == 0:
        for i in range(m):
            now.w[mask + i] = 0.0
        return 0
    here = now.w if count == alone else other.w  # at a singular position rounding would choose
    if layout.sparse == 0 and (not same or _active_pivot(layout, here) < decisions.STAND_BADLY):
        choose_rows(layout, m - count, 1, here, work.numbers)
        for i in range(m):
            now.w[mask + i] = here[mask + i]
        closing.geometry(layout.t, now.y, now.p, now.w)
        for i in range(m):  # a row left out may come first, where its pivot does not measure the rows after it
            if now.w[mask + i] != 0.0:
                now.w[layout.pivot + i] = 0.0
        return count
    if count == alone and same:
        return count  # the same ones everywhere
    left = 0
    for i in range(m):
        if other.w[mask + i] == 0.0:
            now.w[mask + i] = 0.0
        left += 1 if now.w[mask + i] != 0.0 else 0
    return left


@exact()
def _active_pivot(layout: Layout, w: Array) -> float:
    """Return the smallest pivot of D D^T among the rows that do not depend on others."""
    smallest = 1.0
    for i in range(layout.m):
        pivot = w[layout.pivot + i]
        smallest = pivot if pivot < smallest and not is_dependent(pivot) else smallest
    return smallest


@exact()
def _find_free_direction(closing: Closing, layout: Layout, now: Instant, work: Work, seed: float) -> int:
    """Set `work.direction` to a change of velocities with nonzero scale in the null space of D.

    Returns the index of its largest component relative to the scale.
    """
    largest, most, direction = 0, 0.0, work.direction
    for j in range(layout.nv):
        direction[j] = work.scale[j] * math.cos(seed * (j + 1.0))
        work.x[j] = 0.0
    if layout.m > 0:
        multiply(layout, now.w, direction, work.right)
        closing.solve(closing.spread, layout, now, work)
    for j in range(layout.nv):
        direction[j] -= work.x[j]
        size = abs(direction[j]) / free_scale(layout, now.w, j)
        largest, most = (j, size) if size > most else (largest, most)
    return largest


@exact()
def find_undetermined(closing: Closing, layout: Layout, now: Instant, work: Work) -> int:
    """Return a velocity that has neither mass nor a row of D to determine its rate, -1 if all rates are determined.

    Accelerations are determined if M + D^T D is regular: no change of massless velocities is in the null space of D.
    """
    massless = 0
    for j in range(layout.nv):
        massless += layout.massless[j]
        work.scale[j] = free_scale(layout, now.w, j) if layout.massless[j] != 0 else 0.0
    if massless == 0:
        return -1
    largest = _find_free_direction(closing, layout, now, work, 1.0)
    left = abs(work.direction[largest]) / free_scale(layout, now.w, largest)
    return largest if left > decisions.UNHELD else -1


@exact()
def is_squeezed(layout: Layout, w: Array) -> bool:
    """Whether a row with bounds and another row act on a velocity with little mass."""
    heaviest = 0.0
    for j in range(layout.nv):
        heaviest = larger_number(heaviest, w[layout.mass + j] * w[layout.gauge + j])
    for k in range(layout.constants.shape[0]):
        row, j = layout.entries[3 * k], layout.entries[3 * k + 1]
        own = w[layout.mass + j] * w[layout.gauge + j]
        if (
            layout.switches[row] >= 0
            and own > 0.0
            and own < decisions.LIGHT * heaviest
            and entry_of(layout, w, k) != 0.0
        ):
            for other in range(layout.constants.shape[0]):
                another = layout.entries[3 * other] != row and layout.entries[3 * other + 1] == j
                if another and entry_of(layout, w, other) != 0.0:
                    return True
    return False


@exact()
def is_light(rhs: abi.Rhs, closing: Closing, layout: Layout, now: Instant, work: Work) -> bool:
    """Whether a pivot of S is suspiciously small although D D^T finds no row dependent, or forces on light ones cancel.

    `now` is not changed.
    """
    if is_squeezed(layout, now.w):
        return True
    other = Instant(work.y, now.p, work.w)
    _copy_array(layout, now, other)
    for i in range(work.counters.shape[0]):
        work.counters[i] = 0
    if rhs(layout.t, other.y, other.p, other.w, work.counters, work.direction) == 0:
        return False
    closing.geometry(layout.t, other.y, other.p, other.w)
    for i in range(layout.m):
        if other.w[layout.mask + i] == 0.0 and is_dependent(other.w[layout.pivot + i]):
            return False
    return True


@exact()
def _copy_array(layout: Layout, now: Instant, other: Instant) -> None:
    """Copy state and scratch."""
    copy_numbers(now.y, other.y, layout.ny)
    copy_numbers(now.w, other.w, now.w.shape[0])

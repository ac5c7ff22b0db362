"""The box problem: forces within bounds that leave accelerations zero, or push against them.

Forces c enter accelerations linearly, ``a = a0 - G c`` with a symmetric ``G >= 0``. Sought are ``l_i <= c_i <= b_i``
with a_i = 0 inside the bounds, a_i >= 0 where c_i = b_i, and a_i <= 0 where c_i = l_i: the minimum of
``c^T G c / 2 - a0^T c`` in the box, a linear complementarity problem with bounds. Zero is within the bounds, which may
be infinite: a force that only pushes has ``b_i = 0`` and ``l_i = -inf``. Where G is singular c is not unique, a is; and
where a0 has a part that G does not reach, as of two rates that depend on each other at a dead centre, this part drives
forces to a bound.

The method is that of active sets: among the free forces an independent set is solved for, the others stay as they are;
a force that meets its bound stays there until its acceleration has the wrong sign.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from symgen.compile.loopcode.exact import exact
from symgen.compile.native.annotations import Array, Integers, Record
from symgen.run.layout.scales import larger_number

#: Pivots below this part of the diagonal are rounding, and so are accelerations below it over those of single forces.
DEPENDENT, ROUNDING = 1e-11, 1e-13
#: Accelerations that independent forces determine are not zero above this part of what they are differences of.
INCONSISTENT = 1e-7
#: Changes of the active set for each force.
_CHANGES = 50
#: Places of a force: between its bounds, at the upper one, at the lower one.
INSIDE, UPPER, LOWER = 0, 1, -1


class Box(Record):
    """A problem of k forces, its working memory and its solution.

    Attributes
    ----------
    matrix, offset, bounds, lower : Array, shapes (k, k), (k,), (k,), (k,)
        G, a0, b and l.
    forces, left : Array, shapes (k,)
        C and a.
    place : Array of int64, shape (k,)
        `INSIDE`, `UPPER` or `LOWER`.
    factor, right, scale, order : Array, Array of int64
        Working memory; after `independent_set` the first forces of `order` are independent.
    """

    matrix: Array
    offset: Array
    bounds: Array
    lower: Array
    forces: Array
    left: Array
    factor: Array
    right: Array
    scale: Array
    place: Integers
    order: Integers


def new_box(k: int) -> Any:
    """Return memory for a problem of `k` forces."""
    sizes = k * k, k, k, k, k, k, k * k, k, k
    return Box._make((*(np.zeros(size) for size in sizes), np.zeros(k, dtype=np.int64), np.zeros(k, dtype=np.int64)))


@exact()
def set_left(k: int, box: Box) -> None:
    """Set the accelerations that the present forces leave."""
    for i in range(k):
        total = box.offset[i]
        for j in range(k):
            total -= box.matrix[i * k + j] * box.forces[j]
        box.left[i] = total


@exact()
def independent_set(k: int, count: int, box: Box) -> int:
    """Order the first `count` forces of ``order`` so that an independent set comes first; return its number.

    ``factor`` holds the lower triangle of its Cholesky factor, by places in ``order``.
    """
    matrix, factor, order, scale = box.matrix, box.factor, box.order, box.scale
    for i in range(count):
        scale[i] = matrix[order[i] * k + order[i]]
    for step in range(count):
        best, most = -1, DEPENDENT
        for i in range(step, count):
            own = matrix[order[i] * k + order[i]]
            if own > 0.0 and scale[i] > most * own:
                best, most = i, scale[i] / own
        if best < 0:
            return step
        for j in range(step):
            kept = factor[step * k + j]
            factor[step * k + j] = factor[best * k + j]
            factor[best * k + j] = kept
        swapped, pivot = order[step], scale[best]
        order[step], order[best] = order[best], swapped
        scale[best] = scale[step]
        scale[step] = pivot
        root = math.sqrt(pivot)
        factor[step * k + step] = root
        for i in range(step + 1, count):
            total = matrix[order[i] * k + order[step]]
            for j in range(step):
                total -= factor[i * k + j] * factor[step * k + j]
            factor[i * k + step] = total / root
            scale[i] -= factor[i * k + step] * factor[i * k + step]
    return count


@exact()
def solve_independent(k: int, rank: int, box: Box) -> None:
    """Replace ``right`` by the solution of the equations of the first `rank` forces of ``order``."""
    factor, right = box.factor, box.right
    for i in range(rank):
        for j in range(i):
            right[i] -= factor[i * k + j] * right[j]
        right[i] /= factor[i * k + i]
    for back in range(rank):
        i = rank - 1 - back
        for j in range(i + 1, rank):
            right[i] -= factor[j * k + i] * right[j]
        right[i] /= factor[i * k + i]


@exact()
def free_forces(k: int, box: Box) -> int:
    """Write the forces inside their bounds to ``order``; return their number."""
    count = 0
    for i in range(k):
        if box.place[i] == INSIDE:
            box.order[count] = i
            count += 1
    return count


@exact()
def move_free_forces(k: int, box: Box) -> bool:
    """Move free forces towards the minimum, up to the first bound; return whether one was met."""
    forces, bounds, lower, place, order, right = box.forces, box.bounds, box.lower, box.place, box.order, box.right
    rank = independent_set(k, free_forces(k, box), box)
    set_left(k, box)
    for i in range(rank):
        right[i] = box.left[order[i]]
    solve_independent(k, rank, box)
    part, first = 1.0, -1
    for i in range(rank):
        at = order[i]
        room = bounds[at] - forces[at] if right[i] > 0.0 else forces[at] - lower[at]
        room = larger_number(room, 0.0)
        if abs(right[i]) * part > room:
            part, first = room / abs(right[i]), i
    for i in range(rank):
        forces[order[i]] += part * right[i]
    if first < 0:
        return False
    at = order[first]
    place[at] = UPPER if right[first] > 0.0 else LOWER
    forces[at] = bounds[at] if place[at] == UPPER else lower[at]
    return True


@exact()
def magnitude_of(k: int, i: int, box: Box) -> float:
    """Return the sum of the magnitudes whose difference is acceleration number i."""
    size = abs(box.offset[i])
    for j in range(k):
        size += abs(box.matrix[i * k + j] * box.forces[j])
    return float(size)


@exact()
def move_beside_bound(k: int, box: Box) -> bool:
    """Move a free force that the independent ones determine to the first bound; return whether there was one.

    Its acceleration follows from theirs: where it is not zero, as where a rate only passes zero at a dead centre, no
    forces inside their bounds make it so. They move with it, so that theirs stay zero.
    """
    forces, place, order, right = box.forces, box.place, box.order, box.right
    count = free_forces(k, box)
    rank = independent_set(k, count, box)
    set_left(k, box)
    for d in range(rank, count):
        at = order[d]
        if abs(box.left[at]) > INCONSISTENT * magnitude_of(k, at, box):
            way = math.copysign(1.0, box.left[at])
            for i in range(rank):
                right[i] = -way * box.matrix[order[i] * k + at]
            solve_independent(k, rank, box)
            part = box.bounds[at] - forces[at] if way > 0.0 else forces[at] - box.lower[at]
            first = at
            for i in range(rank):
                j = order[i]
                room = larger_number(box.bounds[j] - forces[j] if right[i] > 0.0 else forces[j] - box.lower[j], 0.0)
                if abs(right[i]) * part > room:
                    part, first = room / abs(right[i]), j
            if part < math.inf:
                towards = way
                for i in range(rank):
                    forces[order[i]] += part * right[i]
                    towards = right[i] if order[i] == first else towards
                forces[at] += part * way
                place[first] = UPPER if towards > 0.0 else LOWER
                forces[first] = box.bounds[first] if towards > 0.0 else box.lower[first]
                return True
    return False


@exact()
def wrong_bound(k: int, box: Box) -> int:
    """Return the force at a bound whose acceleration has most of the wrong sign, -1 for none."""
    set_left(k, box)
    worst, most = -1, 0.0
    for i in range(k):
        size = magnitude_of(k, i, box)
        wrong = -box.left[i] * float(box.place[i])
        if (
            box.bounds[i] > box.lower[i]
            and box.matrix[i * k + i] > 0.0
            and wrong > ROUNDING * size
            and wrong > most * size
        ):
            worst, most = i, wrong / size
    return worst


@exact()
def is_contrary(k: int, i: int, box: Box) -> bool:
    """Whether a force that may grow without end in one direction does not keep its acceleration from being negative.

    It depends on others, which push against it as far as it goes: no forces serve.
    """
    return bool(box.place[i] == INSIDE and box.left[i] < -INCONSISTENT * magnitude_of(k, i, box))


@exact(entry=True)
def solve_box(k: int, box: Box) -> int:
    """Solve the box problem of `box`, from no force on; return 0, or 1 if that takes too many changes.

    A force whose own acceleration is zero stays zero.
    """
    for i in range(k):
        box.forces[i] = 0.0
        box.place[i] = INSIDE if box.bounds[i] > box.lower[i] and box.matrix[i * k + i] > 0.0 else UPPER
        if box.place[i] == UPPER and box.matrix[i * k + i] > 0.0:
            box.bounds[i] = box.lower[i] = 0.0
    for _ in range(_CHANGES * (k + 1)):
        if move_free_forces(k, box):
            continue
        move_free_forces(k, box)  # rounding
        if move_beside_bound(k, box):
            continue
        wrong = wrong_bound(k, box)
        if wrong < 0:
            return 0
        box.place[wrong] = INSIDE
    return 1

"""Newton's method on laws with corners: the problem of `symgen.run.laws.problem` from one beginning on.

Each law is an equation with corners: ``c = min(c + a/g, 0)`` where a row pushes, ``c = the point of the ball nearest to
c + a/g`` for a ball; g is its own mobility. Between corners the steps of Newton's method solve an active set, so
that the last one is exact. Pivots that are rounding are left out: forces that are many stay what they are.
"""

from __future__ import annotations

import math

from symgen.compile.loopcode.exact import exact
from symgen.run.laws.problem import (
    BALL,
    LOADS,
    LOWER,
    NOTHING,
    OFF,
    ON,
    PUSH,
    UPPER,
    Laws,
    acceleration_of,
    load_within,
    middle_of,
    mobility_of,
    rows_of,
    slope_of_load,
    weigh_laws,
)
from symgen.run.layout.scales import larger_number

#: Pivots below this part of the largest are rounding; those that differ by less are taken in the order of rows.
_NO_PIVOT, _LEVEL = 1e-11, 1.0 + 1e-9
#: What is missing at a solution; what rounding leaves where no step makes it less.
_SOLVED, _ROUNDED = 1e-14, 1e-11
#: Steps, and halvings of one.
_STEPS, _HALVINGS = 60, 12
_LESS = 1e-4


@exact()
def fill_push(n: int, i: int, most: float, chosen: bool, sloped: bool, laws: Laws) -> None:
    """Write what is missing where a row pushes, and slopes if asked for; set the state unless it is `chosen`."""
    own, left = laws.matrix[i * n + i], acceleration_of(n, i, laws)
    if not chosen:
        laws.state[i] = ON if laws.law[i] == PUSH and own > 0.0 and laws.forces[i] + left / own < 0.0 else OFF
    closed = laws.state[i] == ON and own > 0.0
    laws.right[i] = (left / own if closed else laws.forces[i]) * laws.root[i] / most
    for j in range(n if sloped else 0):
        if closed:
            laws.slopes[i * n + j] = -laws.matrix[i * n + j] / own
        else:
            laws.slopes[i * n + j] = 1.0 if i == j else 0.0


@exact()
def fill_ball(n: int, i: int, most: float, chosen: bool, sloped: bool, laws: Laws) -> None:
    """Write what is missing at a ball of one row, and slopes if asked for; set the state unless it is `chosen`."""
    own, left, load = laws.matrix[i * n + i], acceleration_of(n, i, laws), load_within(n, i, chosen, laws)
    bound, middle = laws.beta[i] + laws.kappa[i] * load, middle_of(i, load, laws)
    if laws.way[i] != 0.0:
        laws.state[i], middle = UPPER if laws.way[i] > 0.0 else LOWER, 0.0
    elif own <= 0.0:
        laws.state[i] = OFF
    elif not chosen:
        wants = laws.forces[i] - middle + left / own
        laws.state[i] = ON if abs(wants) <= bound else UPPER if wants > 0.0 else LOWER
    side, factor = 1.0 if laws.state[i] == UPPER else -1.0, 0.0
    if laws.components[i] > 0 and laws.way[i] == 0.0:
        factor = laws.middle[i]
    if laws.state[i] == ON:
        laws.right[i] = left / own * laws.root[i] / most
    elif laws.state[i] == OFF:
        laws.right[i] = laws.forces[i] * laws.root[i] / most
    else:
        laws.right[i] = (laws.forces[i] - middle - side * bound) * laws.root[i] / most
    for j in range(n if sloped else 0):
        if laws.state[i] == ON:
            laws.slopes[i * n + j] = -laws.matrix[i * n + j] / own
        else:
            laws.slopes[i * n + j] = 1.0 if i == j else 0.0
            if laws.state[i] != OFF:
                factors = factor + side * laws.kappa[i]
                laws.slopes[i * n + j] -= factors * slope_of_load(n, i, j, load, chosen, laws)


@exact()
def fill_disc(n: int, i: int, most: float, chosen: bool, sloped: bool, laws: Laws) -> None:
    """Write what is missing at a ball of two rows, and slopes if asked for; set the state unless it is `chosen`."""
    own, load = mobility_of(n, i, laws), load_within(n, i, chosen, laws)
    bound, length, first, second = laws.beta[i] + laws.kappa[i] * load, 1.0, laws.way[i], laws.way[i + 1]
    moves, u, v = first != 0.0 or second != 0.0, 0.0, 0.0
    if own > 0.0:
        u, v = acceleration_of(n, i, laws) / own, acceleration_of(n, i + 1, laws) / own
    if not moves:
        first, second = laws.forces[i] + u, laws.forces[i + 1] + v
        length = math.sqrt(first * first + second * second)
        if not chosen:
            laws.state[i] = (ON if length <= bound else UPPER) if own > 0.0 else OFF
        first, second = (first / length, second / length) if length > 0.0 else (0.0, 0.0)
    else:
        laws.state[i] = UPPER
    laws.state[i + 1], rests = laws.state[i], laws.state[i] == ON and own > 0.0
    size = bound if laws.state[i] == UPPER else 0.0
    turns = 0.0 if moves or size == 0.0 or length == 0.0 else size / length
    laws.right[i] = (u if rests else laws.forces[i] - size * first) * laws.root[i] / most
    laws.right[i + 1] = (v if rests else laws.forces[i + 1] - size * second) * laws.root[i] / most
    for j in range(n if sloped else 0):
        x, y = 1.0 if j == i else 0.0, 1.0 if j == i + 1 else 0.0
        along = -laws.matrix[i * n + j] / own if own > 0.0 else 0.0
        across = -laws.matrix[(i + 1) * n + j] / own if own > 0.0 else 0.0
        if rests:
            laws.slopes[i * n + j], laws.slopes[(i + 1) * n + j] = along, across
        else:
            slope = laws.kappa[i] * slope_of_load(n, i, j, load, chosen, laws) if laws.state[i] == UPPER else 0.0
            turned = turns * (first * (y + across) - second * (x + along))  # of the direction, across it
            laws.slopes[i * n + j] = x - first * slope + second * turned
            laws.slopes[(i + 1) * n + j] = y - second * slope - first * turned


@exact(entry=True)
def miss_laws(n: int, most: float, chosen: bool, sloped: bool, laws: Laws) -> float:
    """Write what is missing at each law to ``right``, and if asked for its derivatives to ``slopes``; return its size.

    Both are scaled by the roots of mobilities. With `chosen` states stay as they are, else they follow from forces.
    """
    size = 0.0
    for i in range(n):
        if laws.law[i] == PUSH or laws.law[i] == NOTHING:
            fill_push(n, i, most, chosen, sloped, laws)
        elif LOADS and laws.law[i] == BALL and rows_of(n, i, laws) == 2:
            fill_disc(n, i, most, chosen, sloped, laws)
        elif laws.law[i] == BALL:
            fill_ball(n, i, most, chosen, sloped, laws)
    for i in range(n):
        size += laws.right[i] * laws.right[i]
        for j in range(n if sloped else 0):
            laws.slopes[i * n + j] *= laws.root[i] / laws.root[j]
    return math.sqrt(size)


@exact(entry=True)
def solve_slopes(n: int, laws: Laws) -> int:
    """Replace ``right`` by the solution of the equations of ``slopes``, 0 where it is free; return their rank.

    The last ``column`` is -1 where some are free.
    """
    slopes, right, column, rank, first = laws.slopes, laws.right, laws.column, 0, 0.0
    for j in range(n):
        column[j] = j
    while rank < n:
        row, place, most = -1, -1, 0.0
        for i in range(rank, n):
            for j in range(rank, n):
                if abs(slopes[i * n + column[j]]) > _LEVEL * most:
                    row, place, most = i, j, abs(slopes[i * n + column[j]])
        first = most if rank == 0 else first
        if row < 0 or most <= _NO_PIVOT * first:
            break
        number = column[rank]
        column[rank], column[place] = column[place], number
        for j in range(n):
            value = slopes[rank * n + j]
            slopes[rank * n + j], slopes[row * n + j] = slopes[row * n + j], value
        value = right[rank]
        right[rank], right[row] = right[row], value
        for i in range(rank + 1, n):
            part = slopes[i * n + column[rank]] / slopes[rank * n + column[rank]]
            if part != 0.0:
                for j in range(rank, n):
                    slopes[i * n + column[j]] -= part * slopes[rank * n + column[j]]
                right[i] -= part * right[rank]
        rank += 1
    for back in range(rank):
        i = rank - 1 - back
        for j in range(i + 1, rank):
            right[i] -= slopes[i * n + column[j]] * right[j]
        right[i] /= slopes[i * n + column[i]]
    for j in range(n):
        laws.left[column[j]] = right[j] if j < rank else 0.0
    for j in range(n):
        right[j] = laws.left[j]
    if rank < n:
        column[n - 1] = -1
    return int(rank)


@exact()
def set_left(n: int, laws: Laws) -> None:
    """Set the accelerations that the present forces leave."""
    for i in range(n):
        laws.left[i] = acceleration_of(n, i, laws)


@exact(entry=True)
def follow_laws(n: int, chosen: bool, laws: Laws) -> bool:
    """Find forces that obey all laws from the present ones on, and what they leave; return whether they are found.

    With `chosen` the states of the rows are given.
    """
    most = weigh_laws(n, laws)
    size, found = miss_laws(n, most, chosen, True, laws), False
    for j in range(n):
        laws.column[j] = -1
    for step in range(_STEPS):
        if size <= _SOLVED:
            found = True
            break
        if step > 0:
            miss_laws(n, most, chosen, True, laws)
        solve_slopes(n, laws)
        for i in range(n):
            laws.kept[i] = laws.forces[i]
            laws.left[i] = laws.right[i] * most / laws.root[i]
        part, better, before = 1.0, False, size
        for _halving in range(_HALVINGS):
            for i in range(n):
                laws.forces[i] = laws.kept[i] - part * laws.left[i]
            size = miss_laws(n, most, chosen, False, laws)
            if size < (1.0 - _LESS * part) * before or size <= _SOLVED:
                better = True
                break
            part *= 0.5
        if not better:
            for i in range(n):
                laws.forces[i] = laws.kept[i]
            size = miss_laws(n, most, chosen, False, laws)
            break
    largest = 1.0
    for i in range(n):
        largest = larger_number(largest, abs(laws.forces[i]) * laws.root[i] / most)
    found = found or size <= _ROUNDED * largest
    set_left(n, laws)
    return found

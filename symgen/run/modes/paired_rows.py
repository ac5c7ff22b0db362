"""Friction along contacts in space, compiled: its two rows follow each other, and slide or rest together.

The number ``SIGN`` of the rows in motion is a direction, of which no component is exactly 0; ``LIMIT`` of the first one
is the velocity that leads slip out of rest, ``CONSTANT`` the one below which slip has no direction.
"""

from __future__ import annotations

import math

from symgen.base.ir.program import MODE_NUMBERS
from symgen.compile.loopcode.exact import exact
from symgen.compile.native.annotations import Array, Integers
from symgen.run.laws.problem import ON, TINY, UPPER
from symgen.run.layout import abi
from symgen.run.modes.bounded_rows import AT_BOUND, CONSTANT, LIMIT, ROUNDED, row_scale
from symgen.run.modes.found_rows import find_alike
from symgen.run.modes.row_records import Choice

#: Velocity of slip out of rest, over `speed_by_friction`; up to this many times of it, slip that goes on keeps it.
LEAD, LED = 1e-7, 1e4
#: Velocity below which slip has no direction, over that scale.
CORE = 1e-9
#: Slip that has turned goes on above this part of the mechanism's scale of speeds.
PASSED = 1e-6


@exact()
def is_second(c: Choice, i: int) -> bool:
    """Return whether a row is the second one along its contact."""
    return bool(i < c.rows.dry and c.rows.second[i] != 0)


@exact()
def is_first(c: Choice, i: int) -> bool:
    """Return whether a row is the first one of two along its contact."""
    return bool(is_second(c, i + 1))


@exact()
def first_of(c: Choice, i: int) -> int:
    """Return the first row along the contact of a row, or the row itself."""
    return int(i - 1 if is_second(c, i) else i)


@exact()
def length_at(c: Choice, numbers: Array, i: int) -> float:
    """Return the length of a vector of which a row has one component, or the size of its number."""
    j = first_of(c, i)
    if not is_first(c, j):
        return float(abs(numbers[i]))
    return math.sqrt(numbers[j] * numbers[j] + numbers[j + 1] * numbers[j + 1])


@exact()
def component_at(c: Choice, numbers: Array, i: int) -> float:
    """Return a row's component of the direction of a vector, not 0; a vector of length 0 has any direction."""
    size = length_at(c, numbers, i)
    part = numbers[i] / size if size > 0.0 else math.sqrt(0.5)
    return float(part if part != 0.0 else TINY)


@exact()
def share_found(c: Choice, w: Array, i: int) -> None:
    """Let both rows have what events have found of the first one; slip whose direction has turned goes on."""
    if is_first(c, i):
        goes_on = length_at(c, c.read.speed, i) > PASSED * row_scale(c, w, i, abi.SPEED)
        find_alike(c, i, goes_on)


@exact()
def find_direction(c: Choice, i: int) -> float:
    """Return the component of the direction of slip by the forces found: against friction, or along the motion."""
    return float(component_at(c, c.forces if length_at(c, c.forces, i) > 0.0 else c.trial, i))


@exact()
def settle_pair(a: int, i: int, still: bool, bound: float, loose: Integers, c: Choice) -> None:
    """Decide what forces leave open at the first of two rows: see `symgen.run.modes.contact_laws.settle_at_bounds`."""
    laws = c.laws
    if laws.way[a] != 0.0:
        return
    if loose[i] == 0 and still and laws.state[a] >= UPPER:
        laws.state[a] = laws.state[a + 1] = ON
    size = math.sqrt(laws.forces[a] * laws.forces[a] + laws.forces[a + 1] * laws.forces[a + 1])
    if loose[i] != 0 and laws.state[a] == ON and bound > 0.0 and size >= AT_BOUND * bound:
        laws.state[a] = laws.state[a + 1] = UPPER


@exact()
def speed_by_friction(c: Choice, i: int) -> float:
    """Return the speed that friction gives over the mechanism's length, or a radian: a state at rest has it too."""
    length = 1.0 if c.rows.angular[i] != 0 else c.w[abi.LENGTH]
    pulled = length_at(c, c.forces, i) * c.problem.matrix[i * c.rows.count + i] * length
    return float(math.sqrt(pulled) if pulled > 0.0 else row_scale(c, c.w, i, abi.SPEED))


@exact()
def write_pair(c: Choice, i: int, begins: bool) -> None:
    """Write what the first of two rows has for both: the lead of slip, and what counts as no friction at rest.

    Slip that `begins` has a lead, and slip that goes on while it is slow.
    """
    at, speed = MODE_NUMBERS * i, speed_by_friction(c, i)
    if c.best[i] == UPPER:
        slow = c.before[at + LIMIT] > 0.0 and length_at(c, c.read.speed, i) < LED * LEAD * speed
        c.after[at + CONSTANT], c.after[at + LIMIT] = CORE * speed, LEAD * speed if begins or slow else 0.0
    elif c.best[i] == ON and (c.part[i] >= 0 or c.part[i + 1] >= 0):
        size = length_at(c, c.forces, i)
        slack = 0.1 * ROUNDED * (c.problem.scale[i] + c.problem.scale[i + 1] + size)
        c.after[at + LIMIT] = slack if size > slack else 1.0

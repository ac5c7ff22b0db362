"""Probes of a state, compiled: G among rows with bounds, and accelerations and reactions without their forces.

A probe evaluates the accelerations of a state whose rows with bounds are off, without forces or with one. The problem
of the rows is written here alone.
"""

from __future__ import annotations

import math

from symgen.base.ir.program import MODE_NUMBERS
from symgen.compile.loopcode.exact import exact
from symgen.compile.native.annotations import Array, Integers
from symgen.run.effects.pushing import POISSON, REACTIONS
from symgen.run.layout import abi
from symgen.run.layout.scales import entry_of, larger_number
from symgen.run.modes.bounded_rows import (
    CONSTANT,
    DEPENDENT,
    EFFORT,
    HELD,
    LEAST_MASS,
    LIMIT,
    NOT_FINITE,
    SAME,
    SIGN,
    usual_of,
)
from symgen.run.modes.row_records import Choice


@exact(entry=True)
def find_mobility(c: Choice) -> int:
    """Set the acceleration of each coordinate by a force on it if no joints held the bodies.

    A body without inertia counts with a part of the mean one: its joints decide how far it moves.
    """
    layout = c.rows.layout
    for i in range(c.rows.count):
        c.problem.alone[i] = 0.0
    for e in range(layout.constants.shape[0]):
        i, j = c.rows.place_of[layout.entries[3 * e]], layout.entries[3 * e + 1]
        if i >= 0:
            entry = entry_of(layout, c.w, e)
            least = LEAST_MASS * c.w[abi.MEAN_MASS] / c.w[layout.gauge + j]
            c.problem.alone[i] += entry * entry / larger_number(c.w[layout.mass + j], least)
    return int(c.rows.count)


@exact()
def copy_state(c: Choice, y: Array, w: Array, iw: Integers) -> None:
    """Copy a state and its scratch, in which modes may be tried."""
    for i in range(w.shape[0]):
        c.w[i] = w[i]
    for i in range(y.shape[0]):
        c.y[i] = y[i]
    for i in range(iw.shape[0]):
        c.iw[i] = iw[i]


@exact()
def write_rates(t: float, c: Choice, p: Array) -> None:
    """Write the rates of the copied state to ``rate``."""
    if c.rows.rates(t, c.y, p, c.w, c.iw, c.rate) != 0:
        c.rows.confirm(t, c.y, p, c.w, c.iw, c.rate)


@exact()
def measure_accelerations(t: float, c: Choice, p: Array, control: Integers) -> int:
    """Write the accelerations of coordinates in the modes of the copied state to ``out``."""
    if c.w[abi.STEP_STATUS] == 0.0:  # of laws whose gains follow the step, before the first one
        c.w[abi.STEP_STATUS] = c.step[0]
    write_rates(t, c, p)
    control[abi.EVALUATIONS] += 1
    c.rows.accelerations(t, c.y, p, c.w, c.rate, c.out)
    for i in range(c.rows.count):
        if not math.isfinite(c.out[i]):
            return NOT_FINITE
    return SAME


@exact(entry=True)
def accelerate(t: float, c: Choice, y: Array, p: Array, w: Array, iw: Integers, control: Integers) -> int:
    """Write the accelerations of coordinates with all rows off and efforts of the signs of ``trial`` to ``out``.

    A coordinate whose bounds depend on a reaction, or are 0 for a time, may be ``pushed`` by a force of -1.
    """
    copy_state(c, y, w, iw)
    for i in range(c.rows.count):
        at = c.rows.first + MODE_NUMBERS * i
        c.w[at + HELD] = c.w[at + CONSTANT] = c.w[at + LIMIT] = c.w[at + EFFORT] = 0.0
        c.w[at + SIGN] = c.trial[i]
    if c.pushed[0] >= 0:
        c.w[c.rows.first + MODE_NUMBERS * c.pushed[0] + EFFORT] = 1.0
    return int(measure_accelerations(t, c, p, control))


@exact(entry=True)
def probe(t: float, c: Choice, y: Array, p: Array, w: Array, iw: Integers, control: Integers) -> int:
    """Set G among the rows at rest, and the accelerations without their forces."""
    k, n = c.rows.count, c.at_rest[0]
    for i in range(k * k):
        c.problem.matrix[i] = 0.0
    for i in range(k):
        c.trial[i] = c.signs[i]
    if accelerate(t, c, y, p, w, iw, control) != SAME:
        return NOT_FINITE
    for i in range(k):
        c.problem.offset[i] = c.out[i]
    find_mobility(c)
    for r in range(n):
        j = c.rest[r]
        force, sign = c.read.sliding[j], 1.0
        if c.rows.pushes[j] != 0 and c.problem.alone[j] > 0.0:  # accelerations as large as those that are there
            force = larger_number(abs(c.problem.offset[j]), usual_of(c, w, j)) / c.problem.alone[j]
            sign = -force
        if force > 0.0 or c.rows.varying[j] != 0:
            for i in range(k):
                c.trial[i] = c.signs[i]
            c.trial[j] = sign
            if force == 0.0 or c.read.middle[j] != 0.0:  # a bound of 0 holds what it holds at rest as soon as it rises
                force, c.trial[j], c.pushed[0] = 1.0, 0.0, j
            code = accelerate(t, c, y, p, w, iw, control)
            c.pushed[0] = -1
            if code != SAME:
                return NOT_FINITE
            for i in range(k):
                c.problem.matrix[i * k + j] = (c.problem.offset[i] - c.out[i]) / force
    symmetrise(c)
    size_forces(c, n, w)
    return SAME


@exact()
def size_forces(c: Choice, n: int, w: Array) -> None:
    """Set the forces at rest that make accelerations as large as those without them, and as usual ones."""
    for r in range(n):
        i = c.rest[r]
        own = c.problem.matrix[i * c.rows.count + i]
        c.problem.scale[i] = (abs(c.problem.offset[i]) + usual_of(c, w, i)) / own if own > 0.0 else 0.0


@exact(entry=True)
def symmetrise(c: Choice) -> int:
    """Make G symmetric among rows at rest, and 0 for rows that joints hold still, as at a dead centre."""
    k, n, matrix = c.rows.count, c.at_rest[0], c.problem.matrix
    for a in range(n):
        for b in range(a):
            i, j = c.rest[a], c.rest[b]
            mean = 0.5 * (matrix[i * k + j] + matrix[j * k + i])
            matrix[i * k + j] = matrix[j * k + i] = mean
    for a in range(n):
        i = c.rest[a]
        if matrix[i * k + i] <= DEPENDENT * c.problem.alone[i]:
            for b in range(n):
                j = c.rest[b]
                matrix[i * k + j] = matrix[j * k + i] = 0.0
    return int(n)


@exact()
def add_forces(c: Choice) -> None:
    """Add the forces at rest and their bounds to the sizes of forces."""
    for i in range(c.rows.count):
        c.problem.scale[i] += abs(c.forces[i]) + c.holds[i]


@exact()
def by_reaction(c: Choice, i: int) -> bool:
    """Return whether the bound of a row depends on the reaction of a joint."""
    return bool(REACTIONS and c.rows.pressed[i] != 0)


@exact()
def accelerate_by(
    t: float, c: Choice, j: int, force: float, y: Array, p: Array, w: Array, iw: Integers, control: Integers
) -> int:
    """Write the accelerations of coordinates with all rows off, and a force of ``-force`` at row j, if any, to ``out``.

    Dry friction without a contact has its sign; that of contacts has none.
    """
    copy_state(c, y, w, iw)
    for i in range(c.rows.count):
        at = c.rows.first + MODE_NUMBERS * i
        c.w[at + HELD] = c.w[at + CONSTANT] = c.w[at + LIMIT] = c.w[at + EFFORT] = 0.0
        c.w[at + SIGN] = (
            c.signs[i] if c.rows.pushes[i] == 0 and c.rows.partner[i] < 0 and not by_reaction(c, i) else 0.0
        )
    if j < c.rows.count:
        at = c.rows.first + MODE_NUMBERS * j
        if c.rows.pushes[j] != 0:
            c.w[at + SIGN] = -force
        else:
            c.w[at + EFFORT] = force
    return int(measure_accelerations(t, c, p, control))


@exact()
def store_columns(t: float, c: Choice, p: Array, number: int, force: float) -> None:
    """Store the accelerations of the last probe, and the reactions, without forces or by a unit of force `number`."""
    k, place = c.rows.count, 0
    for i in range(k):
        if number < 0:
            c.problem.offset[i] = c.out[i]
        else:
            c.problem.matrix[i * k + number] = (c.problem.offset[i] - c.out[i]) / force
    if REACTIONS:
        c.rows.reactions(t, c.y, p, c.w, c.rate, c.out)
        for i in range(k):
            if c.rows.pressed[i] != 0:
                for part in range(2):
                    if number < 0:
                        c.problem.apart[2 * i + part] = c.out[place + part]
                    else:
                        change = c.problem.apart[2 * i + part] - c.out[place + part]
                        c.problem.parts[(2 * i + part) * k + number] = change / force
                place += 2


@exact()
def probe_contacts(t: float, c: Choice, y: Array, p: Array, w: Array, iw: Integers, control: Integers) -> int:
    """Set G of the rows at rest and of sliding friction by loads, and accelerations without these forces."""
    k, n = c.rows.count, c.at_rest[0]
    for i in range(k * k):
        c.problem.matrix[i] = 0.0
    if accelerate_by(t, c, k, 0.0, y, p, w, iw, control) != SAME:
        return NOT_FINITE
    store_columns(t, c, p, -1, 1.0)
    find_mobility(c)
    rows = n
    for i in range(c.rows.dry):
        if (c.rows.partner[i] >= 0 or by_reaction(c, i)) and c.signs[i] != 0.0 and c.taken[i] == 0:
            c.rest[rows] = i
            rows += 1
    most = 0.0  # accelerations as large as those that are there, of all rows: a row's own may be rounding of others'
    for r in range(rows):
        i = c.rest[r]
        if c.problem.alone[i] > 0.0:
            most = larger_number(
                most, larger_number(abs(c.problem.offset[i]), usual_of(c, w, i)) / math.sqrt(c.problem.alone[i])
            )
    for r in range(rows):
        j, force = c.rest[r], 1.0
        c.problem.usual[j] = most * math.sqrt(c.problem.alone[j])
        if c.problem.usual[j] > 0.0:
            force = most / math.sqrt(c.problem.alone[j])
        if accelerate_by(t, c, j, force, y, p, w, iw, control) != SAME:
            return NOT_FINITE
        store_columns(t, c, p, j, force)
    c.at_rest[0] = rows
    symmetrise(c)
    size_forces(c, rows, w)
    return SAME


@exact()
def size_forces_of_parts(c: Choice, rows: int) -> None:
    """Set the sizes of forces on gaps, of which any row of their part has a share, and of friction, which they press.

    What presses two discs that only touch is the rounding of what presses them to a floor.
    """
    k = c.rows.count
    for r in range(rows):
        i = c.rest[r]
        own, most = c.problem.matrix[i * k + i], 0.0
        for q in range(rows):
            j = c.rest[q]
            if c.part[j] == c.part[i]:
                most = larger_number(most, c.problem.scale[j] * math.sqrt(c.problem.matrix[j * k + j]))
        c.trial[i] = most / math.sqrt(own) if own > 0.0 else 0.0
    for r in range(rows):
        i = c.rest[r]
        if c.rows.pushes[i] != 0:
            c.problem.scale[i] = c.trial[i]
        elif c.rows.partner[i] >= 0:  # the rounding of a bound is that of what presses
            c.problem.scale[i] += c.read.static[i] * c.trial[c.rows.partner[i]]


@exact()
def add_kicks(c: Choice, kicked: Array, i: int) -> None:
    """Add what impulses that follow from compression make of the rate of a row, and of what its bound depends on."""
    k = c.rows.count
    for gap in range(c.rows.dry, k):
        c.problem.offset[i] += c.problem.matrix[i * k + gap] * kicked[gap]
        if c.rows.pressed[i] != 0:
            for part in range(2):
                c.problem.apart[2 * i + part] += c.problem.parts[(2 * i + part) * k + gap] * kicked[gap]
    if c.rows.pushes[i] == 0 and c.rows.partner[i] >= 0:
        c.problem.apart[2 * i] = kicked[c.rows.partner[i]]


@exact()
def pose_impact(c: Choice, asked: Array, kicked: Array) -> None:
    """Write the problem of an impact: rates before it, of gaps less those asked for, in place of accelerations."""
    for r in range(c.at_rest[0]):
        i = c.rest[r]
        c.problem.offset[i], c.problem.usual[i] = c.read.speed[i] - (asked[i] if c.rows.pushes[i] != 0 else 0.0), 0.0
        if REACTIONS:  # without impulses joints have none
            c.problem.apart[2 * i] = c.problem.apart[2 * i + 1] = 0.0
        if POISSON:
            add_kicks(c, kicked, i)


@exact()
def forget_kicks(c: Choice) -> None:
    """Forget what bounds of friction have from compression."""
    for i in range(c.rows.dry):
        c.problem.apart[2 * i] = 0.0 if c.rows.partner[i] >= 0 else c.problem.apart[2 * i]

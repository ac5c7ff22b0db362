"""Effects of events applied to the state of a run: one function of the loop language for single runs and rows."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from symgen.compile.loopcode.bare import part
from symgen.compile.loopcode.exact import exact
from symgen.compile.native.annotations import Array, Integers, Record
from symgen.run.layout import abi
from symgen.run.layout.redundancy import is_off, room_of_choice
from symgen.run.layout.scales import fill_jacobian
from symgen.run.layout.start_records import Instant, Layout
from symgen.run.starts.impulse import Impulse, new_impulse, smallest_impulse
from symgen.run.starts.masses import add_rotors, put_entries

#: Codes: the state has changed; velocities, or values of states, contradict each other or are not finite.
APPLIED, NO_VELOCITIES, NO_VALUES = range(3)
#: Codes of joints that hold for a while (`symgen.run.modes.catching`): a catch out of place; one that makes the joint's
#: own condition false; one at which the joint keeps its condition at the limit.
NOT_IN_PLACE, CONTRADICTED, AT_ITS_LIMIT = range(40, 43)


class EffectChanges(Record):
    """What the events of a run change, in the order of the function of their formulas.

    Velocities come first, then their new values, values that are written, entries of the mass matrix of bodies, rates
    of rotors, and their inertias.

    Attributes
    ----------
    bodies, first : int
        Velocities of bodies that joints of a tree carry, and the first of these among the numbers that the emitted
        function of bodies sets; 0 where bodies have the velocities of the state.
    rotors : int
        Number of rotors.
    owners, columns : Array of int64, shape (k,)
        Event of each velocity; its number in the state, -1 where it is another one.
    writes : Array of int64, shape (2 l,)
        (event, place in the state) of each value.
    entries : Array of int64, shape (2 e,)
        (row, column) of each entry; diagonal ones only where joints carry bodies or rotors turn.
    catches : Array of int64, shape (2 events,)
        Of the catch of a joint, the place in the state of the energy that it takes, and the event at which the joint
        releases, -1 where that is for forces to say; -2 and -1 of a release; -1 twice of other events.
    """

    bodies: int
    first: int
    rotors: int
    owners: Integers
    columns: Integers
    writes: Integers
    entries: Integers
    catches: Integers


class EffectWork(Record):
    """Working memory of effects.

    Attributes
    ----------
    out, still, state, rate, scratch : Array
        Arguments of emitted functions; `state` is the state afterwards.
    motion, carried, drift : Array
        Numbers of the function of bodies; their velocities by those of the state, and at rest.
    turning, turned : Array, shapes (rotors nv,), (rotors,)
        Rates of rotors by velocities of the state, and at rest.
    energy : Array, shape (1,)
        Change of the energy [J].
    impulse : Impulse
        The problem of velocities after an impulse.
    """

    out: Array
    still: Array
    state: Array
    rate: Array
    scratch: Array
    motion: Array
    carried: Array
    drift: Array
    turning: Array
    turned: Array
    energy: Array
    impulse: Impulse


#: Layout of a model, ``geometry``, the functions of formulas and of bodies, and `EffectChanges`.
EffectModel = tuple[Layout, abi.Measure, abi.Observe, abi.Observe, EffectChanges]


def new_effect_work(layout: Layout, changes: EffectChanges, width: int, nw: int) -> Any:
    """Return working memory for the states of `width` numbers of a model whose scratch has `nw`."""
    k, n = len(changes.owners), layout.nv
    bodies, rotors = changes.bodies, changes.rotors
    out = 2 * k + (len(changes.writes) + len(changes.entries)) // 2 + 2 * rotors
    sizes = out, width, width, width, nw, changes.first + 2 * bodies, bodies * n, bodies, rotors * n, rotors, 1
    impulse = new_impulse(n, layout.m + k)
    if np.any(changes.catches != -1):  # rows are chosen anew in the same memory
        impulse = impulse._replace(rows=np.zeros(max(len(impulse.rows), room_of_choice(layout.m, n))))
    return EffectWork._make((*(np.zeros(size) for size in sizes), impulse))


@exact()
def first_entry(changes: EffectChanges) -> int:
    """Return the place of the first entry of M among the numbers of formulas."""
    return int(2 * changes.owners.shape[0] + changes.writes.shape[0] // 2)


@exact()
def first_turn(changes: EffectChanges) -> int:
    """Return the place of the first rate of a rotor among these numbers."""
    return int(first_entry(changes) + changes.entries.shape[0] // 2)


@exact()
def probe_velocities(model: EffectModel, t: float, now: Instant, chosen: Integers, work: EffectWork) -> None:
    """Write the rows of velocities that get values, and the velocities of bodies and rotors by the state's velocities.

    All are linear in v: their coefficients are differences of values at unit velocities and at rest.
    """
    layout, _, formulas, bodies, changes = model
    n, nq, m, count = layout.nv, layout.nq, layout.m, changes.owners.shape[0]
    still, out, impulse, motion = work.still, work.out, work.impulse, work.motion
    plain, k = changes.bodies == 0 and changes.rotors == 0, m
    for i in range(count):
        if chosen[changes.owners[i]] != 0:
            plain = plain and changes.columns[i] >= 0
            for j in range(n):
                impulse.rows[k * n + j] = 1.0 if j == changes.columns[i] else 0.0
            k += 1
    if plain:
        return
    for i in range(still.shape[0]):
        still[i] = now.y[i]
    for column in range(-1, n):
        for j in range(n):
            still[nq + j] = 1.0 if j == column else 0.0
        formulas(t, still, now.p, work.scratch, work.rate, out)
        if changes.bodies > 0:
            bodies(t, still, now.p, work.scratch, work.rate, motion)
        k = m
        for i in range(count):
            if chosen[changes.owners[i]] != 0:
                if column < 0:
                    impulse.room[k] = out[i]
                    impulse.values[k] -= out[i]
                else:
                    impulse.rows[k * n + column] = out[i] - impulse.room[k]
                k += 1
        for b in range(changes.bodies):
            if column < 0:
                work.drift[b] = motion[changes.first + b]
            else:
                work.carried[b * n + column] = motion[changes.first + b] - work.drift[b]
        for r in range(changes.rotors):
            if column < 0:
                work.turned[r] = out[first_turn(changes) + r]
            else:
                work.turning[r * n + column] = out[first_turn(changes) + r] - work.turned[r]


@exact()
def fill_masses(model: EffectModel, w: Array, work: EffectWork) -> None:
    """Write M, the one that accelerations have: entries of bodies, and J r^T r of a rotor of inertia J and rate r v."""
    layout, _, _, _, changes = model
    n, mass, entries, carried, turning = layout.nv, work.impulse.mass, changes.entries, work.carried, work.turning
    first = first_entry(changes)
    for j in range(n * n):
        mass[j] = 0.0
    if changes.bodies == 0 and changes.rotors == 0:
        for j in range(n):
            mass[j * n + j] = w[layout.mass + j]
    count = entries.shape[0] // 2
    if changes.bodies == 0 and count > 0:
        put_entries(n, entries, part(work.out, first, count), mass)
    else:
        for e in range(count):
            row, column, value = entries[2 * e], entries[2 * e + 1], work.out[first + e]
            for i in range(n):
                for j in range(n):
                    product = carried[row * n + i] * carried[column * n + j]
                    if row != column:
                        product += carried[column * n + i] * carried[row * n + j]
                    mass[i * n + j] += value * product
    if changes.rotors > 0:
        add_rotors(n, turning, part(work.out, first + count + changes.rotors, changes.rotors), mass)


@exact()
def energy_of_effects(model: EffectModel, v: Array, first: int, work: EffectWork) -> float:
    """Return the change of the kinetic energy."""
    layout, _, _, _, changes = model
    n, mass, after, entries = layout.nv, work.impulse.mass, work.impulse.after, changes.entries
    energy, masses = 0.0, first_entry(changes)
    for i in range(n):
        for j in range(n):
            energy += 0.5 * (after[i] - v[first + i]) * mass[i * n + j] * (after[j] + v[first + j])
    for e in range(entries.shape[0] // 2 if changes.bodies > 0 else 0):
        row, column, value = entries[2 * e], entries[2 * e + 1], work.out[masses + e]
        for j in range(n):
            change = after[j] - v[first + j]
            energy += value * change * work.carried[row * n + j] * work.drift[column]
            if row != column:
                energy += value * change * work.carried[column * n + j] * work.drift[row]
    inertias = masses + entries.shape[0] // 2 + changes.rotors
    for r in range(changes.rotors):
        for j in range(n):
            change = after[j] - v[first + j]
            energy += work.out[inertias + r] * change * work.turning[r * n + j] * work.turned[r]
    return energy


@exact()
def write_values(changes: EffectChanges, chosen: Integers, work: EffectWork) -> bool:
    """Write the values of states to the state afterwards; return whether they are finite and agree."""
    writes, first = changes.writes, 2 * changes.owners.shape[0]
    for i in range(writes.shape[0] // 2):
        if chosen[writes[2 * i]] != 0:
            if not math.isfinite(work.out[first + i]):
                return False
            for j in range(i):
                if chosen[writes[2 * j]] != 0 and writes[2 * j + 1] == writes[2 * i + 1]:
                    if work.out[first + j] != work.out[first + i]:
                        return False
            work.state[writes[2 * i + 1]] = work.out[first + i]
    return True


@exact()
def strike_velocities(model: EffectModel, t: float, now: Instant, chosen: Integers, work: EffectWork) -> bool:
    """Write the velocities after the smallest impulse to the state afterwards; return whether there are any."""
    layout, geometry, _, _, changes = model
    n, nq, m, impulse = layout.nv, layout.nq, layout.m, work.impulse
    count, rows, k, finite = changes.owners.shape[0], impulse.rows, m, True
    for i in range(count):
        if chosen[changes.owners[i]] != 0:
            impulse.values[k] = work.out[count + i]
            finite = finite and math.isfinite(work.out[count + i])
            k += 1
    if not finite:
        return False
    geometry(t, now.y, now.p, work.scratch)
    fill_jacobian(layout, work.scratch, rows)
    for i in range(m):
        impulse.values[i] = work.scratch[layout.nu + i]
        if is_off(layout, i, work.scratch):
            impulse.values[i] = 0.0
            for j in range(n):
                rows[i * n + j] = 0.0
    probe_velocities(model, t, now, chosen, work)
    fill_masses(model, work.scratch, work)
    for j in range(n):
        work.still[j] = now.y[nq + j]
    if smallest_impulse(n, k, work.still, impulse) != 0:
        return False
    for i in range(m, k):
        column, others = -1, 0
        for j in range(n):
            others += 1 if rows[i * n + j] != 0.0 else 0
            column = j if rows[i * n + j] == 1.0 else column
        if column >= 0 and others == 1:  # a velocity itself: exactly, so that one at rest is at rest
            impulse.after[column] = impulse.values[i]
    for j in range(n):
        if not math.isfinite(impulse.after[j]):
            return False
        work.state[nq + j] = impulse.after[j]
    work.energy[0] = energy_of_effects(model, now.y, nq, work)
    return True


@exact(entry=True)
def apply_effects(model: EffectModel, t: float, now: Instant, chosen: Integers, work: EffectWork) -> int:
    """Apply the effects of events at one time, which are one, to the state of a run.

    Velocities change by the smallest impulse that gives them their new values and leaves joints closed; formulas are
    evaluated before anything changes. Where effects contradict each other or joints, nothing changes.

    Parameters
    ----------
    model : tuple
        See `EffectModel`.
    t : float
        Time [s].
    now : Instant
        State, parameters and scratch; the work and the kinetic energy of the state follow its velocities.
    chosen : Array of int
        1 for each event that happens, else 0.
    work : EffectWork
        Working memory; it keeps the problem of impulses, its solution and the energy.

    Returns
    -------
    int
        `APPLIED`, or why there is no state afterwards.
    """
    layout, _, formulas, _, changes = model
    ny, struck = layout.ny, False
    for i in range(work.scratch.shape[0]):
        work.scratch[i] = now.w[i]
    for i in range(work.state.shape[0]):
        work.state[i] = now.y[i]
    work.energy[0] = 0.0
    formulas(t, now.y, now.p, work.scratch, work.rate, work.out)
    for i in range(changes.owners.shape[0]):
        struck = struck or chosen[changes.owners[i]] != 0
    if not write_values(changes, chosen, work):
        return int(NO_VALUES)
    if struck and not strike_velocities(model, t, now, chosen, work):
        return int(NO_VELOCITIES)
    for i in range(ny):
        now.y[i] = work.state[i]
    now.y[layout.nq + layout.nv] += work.energy[0]  # work of the impulses: the energy balance continues
    now.w[abi.KINETIC] += work.energy[0]
    return int(APPLIED)


@exact()
def flip_releases(changes: EffectChanges, chosen: Integers, y: Array) -> None:
    """Change the states that say whether joints that release are in force: off, and on again by a second call."""
    for i in range(changes.writes.shape[0] // 2):
        event, place = changes.writes[2 * i], changes.writes[2 * i + 1]
        if chosen[event] != 0 and changes.catches[2 * event] == -2:
            y[place] = 1.0 - y[place]


@exact(entry=True)
def apply_where_released(model: EffectModel, t: float, now: Instant, chosen: Integers, work: EffectWork) -> int:
    """Apply effects as `apply_effects` does; no impulse goes through a joint that releases at the same instant."""
    flip_releases(model[4], chosen, now.y)
    code = int(apply_effects(model, t, now, chosen, work))
    flip_releases(model[4], chosen, now.y)  # where the release is applied, it has just put them back
    return code

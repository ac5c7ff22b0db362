"""Steady motions: which coordinates turn on, together or by themselves, and where everything else stays meanwhile."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from symgen.analyses.rest.settle import Settled, settle_position
from symgen.analyses.state.reduced import tangent_system
from symgen.analyses.state.subject import Subject
from symgen.base.errors import InputError, suggest

Array = NDArray[np.float64]

#: What coordinates change by less than this part of what a row is made of is nothing.
WITHOUT = 1e-11
#: Parts of a way along which nothing changes that are rounding, and turnings at the start beside its fastest motion.
NO_PART = 1e-9


def steady_motion(subject: Subject, cyclic: Sequence[str] = ()) -> Settled:
    """Find a motion in which cyclic coordinates turn on at the speed of the start and nothing else changes.

    Planar angles are absolute: bodies carried by a turning body or by a driven joint turn too.

    Parameters
    ----------
    subject : Subject
        In joint coordinates.
    cyclic : sequence of str
        Names of these coordinates; by default those that nothing depends on, alone or together with later ones
        them, which turn along.

    Raises
    ------
    InputError
        If a name is no coordinate of the tree's joints, something depends on it, or a body on a ball joint turns at
        the start, whose turning no coordinate counts.
    AnalysisError
        If no such motion exists.
    """
    names = [q.name for q in subject.compiled.info.coordinates]
    for name in cyclic:
        if name not in names:
            expected = f"a coordinate of the joints of {subject.mechanism.name}"
            raise InputError(f"cyclic '{name}'", expected, "none of that name", suggest(name, names))
    free, units = _directions_without_effect(subject)
    with_time, ways = _sort_directions(free, units, [names.index(name) for name in cyclic])
    for name in cyclic:
        if names.index(name) not in ways:
            expected = "a coordinate that no force and no row depends on"
            raise InputError(f"cyclic '{name}'", expected, "one that changes them")
    turning = [names.index(name) for name in cyclic] or list(ways)
    motion, y, info = subject.evaluate(subject.y).by("motion", "v"), subject.y.copy(), subject.compiled.info
    v = y[subject.nq : subject.nq + subject.nv]
    along = np.array([with_time, *(ways[i] for i in turning)])
    moving = np.any((along != 0.0) @ (motion != 0.0), axis=0)
    fast = np.abs(v / subject.spans)
    for first in (first + k for _, first in info.spins for k in range(3)):
        if fast[first] > NO_PART * fast.max() and not moving[first]:
            expected = "joints whose angles or displacements turn on"
            got = f"'{info.velocities[first].name}', the turning of a body about any axis, which no coordinate counts"
            raise InputError("steady", expected, got, "give it joints with axes, such as three hinges")
    rates = with_time + (motion @ v - with_time)[turning] @ along[1:]
    v[:] = np.where(moving, np.linalg.lstsq(motion, rates, rcond=None)[0], 0.0)
    return settle_position(subject, y)


def _directions_without_effect(subject: Subject) -> tuple[Array, Array]:
    """Find ways along which nothing changes, here and elsewhere, of coordinates and of time.

    What a driver moves depends on time as its own row does, which therefore counts for nothing. Elsewhere velocities
    are as large as the fastest one of the start, or as forces could make them, in units of any length and time.

    Returns
    -------
    ways : Array, shape (k, nq + 1)
        Orthonormal in `units`.
    units : Array, shape (nq + 1,)
        A length of the mechanism or a radian of each coordinate, and a time.
    """
    rng, spans, nq, nv = np.random.default_rng(0), subject.spans, subject.nq, subject.nv
    rate = float(np.abs(subject.y[nq : nq + nv] / spans).max(initial=0.0)) or tangent_system(subject, subject.y).rate
    changes = list[Array]()
    e = subject.evaluate(subject.y)
    for k in range(3):
        y = subject.move_state(subject.y, 0.3 * k * subject.lengths * rng.standard_normal(nq))
        y[nq : nq + nv] = rate * spans * rng.standard_normal(nv)
        a = rate**2 * spans * rng.standard_normal(nv)
        lam = subject.split_freedom(subject.rows(e))[1].T @ (e.by("balance", "a") @ a)
        e = subject.evaluate(y, a, lam, subject.t + 0.3 * k / rate)
        still = e.by("positions", "t")[:, 0] == 0.0
        for group in ("motion", "balance", "accelerations", "velocities", "positions"):
            by = np.hstack([e.by(group, "q") * subject.lengths, e.by(group, "t") / rate])
            # each row by itself: a soft spring is one beside a stiff one as well
            sizes = (subject.lengths, rate * spans, rate**2 * spans, np.abs(lam))
            parts = [np.abs(e.by(group, s)) * x for s, x in zip(("q", "v", "a", "lam"), sizes, strict=True)]
            size = np.max([part.max(axis=1, initial=1e-300) for part in parts], axis=0)
            if group not in ("motion", "balance"):
                size = np.where(still, size, np.inf)
            changes.append(by / size[:, np.newaxis])
    whole = np.vstack(changes)
    _, effects, ways = np.linalg.svd(np.vstack([whole, np.zeros((nq + 1, nq + 1))]), full_matrices=False)
    # of rows that are of size 1 or less, whatever the units
    nothing = effects <= WITHOUT * max(1.0, effects.max(initial=0.0))
    return np.asarray(ways[nothing]), np.append(subject.lengths, 1.0 / rate)


def _sort_directions(free: Array, units: Array, named: Sequence[int]) -> tuple[Array, dict[int, Array]]:
    """Sort ways along which nothing changes by the one coordinate that none of the others changes.

    That is a named one where it can be, else the one nearest to the ground in the tree.

    Parameters
    ----------
    free, units : Array, shapes (k, nq + 1) and (nq + 1,)
        Independent ways, of coordinates and of time, and their units.
    named : sequence of int
        Coordinates that come first.

    Returns
    -------
    with_time : Array, shape (nq,)
        Rates of coordinates that turn along with what drivers move; 0 where there is no such way.
    ways : dict of int to Array, shape (nq,)
        Coordinate -> changes of all coordinates with it.
    """
    time, leads, rows = free.shape[1] - 1, dict[int, Array](), free
    for place in (time, *named, *(i for i in range(time) if i not in named)):
        if np.abs(rows[:, place]).max(initial=0.0) <= NO_PART:
            continue
        lead = int(np.argmax(np.abs(rows[:, place])))
        way = rows[lead] / rows[lead, place]
        rows = np.delete(rows, lead, axis=0)
        rows = rows - np.outer(rows[:, place], way)
        leads = {i: other - other[place] * way for i, other in leads.items()} | {place: way}
    ways = {i: (np.where(np.abs(way) <= NO_PART, 0.0, way) * units / units[i])[:time] for i, way in leads.items()}
    return ways.pop(time, np.zeros(time)), ways

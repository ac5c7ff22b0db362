"""Steady motions: which coordinates turn on, together or by themselves, and where everything else stays meanwhile."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from symgen.analyses.reduced import tangent
from symgen.analyses.settle import Settled, settle
from symgen.analyses.subject import Subject
from symgen.errors import InputError, nearest

Array = NDArray[np.float64]

#: What coordinates change by less than this part of what a row is made of is nothing.
WITHOUT = 1e-11
#: Parts of a way along which nothing changes that are rounding, and changes of rates by a turning, of the largest one.
NO_PART = 1e-9


def steady_motion(subject: Subject, cyclic: Sequence[str] = ()) -> Settled:
    """Return a motion in which cyclic coordinates turn on at the speed of the start and nothing else changes.

    Angles of bodies in the plane are absolute, so that what a turning body carries turns along with it, and with what a
    driver turns, which is no coordinate of the tree.

    Parameters
    ----------
    subject : Subject
        In joint coordinates.
    cyclic : sequence of str
        Names of these coordinates; by default those that nothing depends on, alone or together with others behind
        them, which turn along.

    Raises
    ------
    InputError
        If a name is no coordinate of the tree's joints, or something depends on it, or a body that no joint's angle
        belongs to spins at the start and would go on.
    AnalysisError
        If there is no such motion.
    """
    names = [q.name for q in subject.compiled.info.coordinates]
    for name in cyclic:
        if name not in names:
            expected = f"a coordinate of the joints of {subject.mechanism.name}"
            raise InputError(f"cyclic '{name}'", expected, "none of that name", nearest(name, names))
    free, units = _without_effect(subject)
    with_time, ways = _ways(free, units, [names.index(name) for name in cyclic])
    for name in cyclic:
        if names.index(name) not in ways:
            raise InputError(
                f"cyclic '{name}'", "a coordinate that no force and no row depends on", "one that changes them"
            )
    turning = [names.index(name) for name in cyclic] or list(ways)
    e = subject.evaluated(subject.y)
    motion = e.by("motion", "v")
    y = subject.y.copy()
    v = y[subject.nq : subject.nq + subject.nv]
    begun, along = v.copy(), np.array([with_time, *(ways[i] for i in turning)])
    kept = np.any((along != 0.0) @ (motion != 0.0), axis=0)
    _refuse_spins(subject, v, kept, driven=bool(np.any(e.by("positions", "t"))))
    rates = with_time + (motion @ v - with_time)[turning] @ along[1:]
    v[:] = np.where(kept, np.linalg.lstsq(motion, rates, rcond=None)[0], 0.0)
    found = settle(subject, y)
    _refuse_lost(found.subject, found.y, np.where(kept, 0.0, begun))
    return found


def _without_effect(subject: Subject) -> tuple[Array, Array]:
    """Return ways along which nothing changes, here and elsewhere, of coordinates and of time, and what they are in.

    What a driver moves depends on time as its own row does, which therefore counts for nothing.

    Returns
    -------
    ways : Array, shape (k, nq + 1)
        Orthonormal in those units.
    units : Array, shape (nq + 1,)
        A length of the mechanism or a radian of each coordinate, and a time.
    """
    rng = np.random.default_rng(0)
    scale = _own_scale(subject)
    changes = list[Array]()
    for k in range(3):
        y = subject.y.copy()
        y[: subject.nq] += 0.3 * k * subject.lengths * rng.standard_normal(subject.nq)
        y[subject.nq : subject.nq + subject.nv] = scale.speeds * rng.standard_normal(subject.nv)
        a, lam = scale.accelerations * rng.standard_normal(subject.nv), scale.loads * rng.standard_normal(subject.m)
        e = subject.evaluated(y, a, lam, subject.t + 0.3 * k * scale.time)
        still = e.by("positions", "t")[:, 0] == 0.0
        for group in ("motion", "balance", "accelerations", "velocities", "positions"):
            by = np.hstack([e.by(group, "q") * subject.lengths, e.by(group, "t") * scale.time])
            # each row by itself: a soft spring is one beside a stiff one as well
            sizes = (subject.lengths, scale.speeds, scale.accelerations, scale.loads)
            parts = [np.abs(e.by(group, s)) * x for s, x in zip(("q", "v", "a", "lam"), sizes, strict=True)]
            size = np.max([part.max(axis=1, initial=1e-300) for part in parts], axis=0)
            if group not in ("motion", "balance"):
                size = np.where(still, size, np.inf)
            changes.append(by / size[:, np.newaxis])
    whole = np.vstack(changes)
    count = whole.shape[1]
    _, felt, ways = np.linalg.svd(np.vstack([whole, np.zeros((count, count))]), full_matrices=False)
    # of rows that are of size 1 or less, whatever the units
    return np.asarray(ways[felt <= WITHOUT * max(1.0, felt.max(initial=0.0))]), np.append(subject.lengths, scale.time)


@dataclass(frozen=True)
class _Scale:
    """What is usual in a mechanism by its own forces: a time, velocities, accelerations and multipliers."""

    time: float
    speeds: Array
    accelerations: Array
    loads: Array


def _own_scale(subject: Subject) -> _Scale:
    """Return what is usual of each velocity in its own place: beside stiff springs soft ones are as much as these."""
    e, spans, y = subject.evaluated(subject.y), subject.spans, subject.y
    heavy = np.diag(e.by("balance", "a")) * spans
    carried = np.abs(e.value("balance")) + np.abs(e.by("balance", "q") @ e.by("motion", "v")) @ spans
    found = (heavy > 0.0) & (carried > 0.0)
    rates = np.abs(y[subject.nq : subject.nq + subject.nv]) / spans
    rates[found] = np.maximum(rates[found], np.sqrt(carried[found] / heavy[found]))
    opened = np.abs(e.by("positions", "t")[:, 0])
    sizes = np.abs(e.by("positions", "q") * subject.lengths).max(axis=1, initial=1e-300)
    driven = float((opened / sizes).max(initial=0.0))
    some = rates[rates > 0.0]
    slowest = driven or float(some.min(initial=np.inf))
    slowest = slowest if np.isfinite(slowest) else 1.0  # nothing moves or is pushed: no time is told from another
    rates = np.where(rates > 0.0, rates, some.max(initial=0.0) or slowest)
    forces = np.where(heavy > 0.0, heavy * rates**2, heavy.max(initial=0.0) * rates**2)
    by_row = np.abs(subject.rows(e))
    with np.errstate(divide="ignore"):
        loads = np.where(by_row > 0.0, forces / by_row, np.inf).min(axis=1, initial=np.inf)
    return _Scale(1.0 / slowest, spans * rates, spans * rates**2, np.where(np.isfinite(loads), loads, 0.0))


def _ways(free: Array, units: Array, named: Sequence[int]) -> tuple[Array, dict[int, Array]]:
    """Return ways along which nothing changes, each by the one coordinate that none of the others changes.

    That is one of those named where it can be, else the first one: the one nearest to the ground in the tree.

    Parameters
    ----------
    free, units : Array, shapes (k, nq + 1) and (nq + 1,)
        Independent ways, of coordinates and of time, and what they are in.
    named : sequence of int
        Coordinates that are asked for.

    Returns
    -------
    with_time : Array, shape (nq,)
        Rates of coordinates that turn along with what drivers move; 0 where there is no such way.
    ways : dict of int to Array, shape (nq,)
        Coordinate -> changes of all coordinates with it.
    """
    time, found, rows = free.shape[1] - 1, dict[int, Array](), free
    for place in (time, *named, *(i for i in range(time) if i not in named)):
        if np.abs(rows[:, place]).max(initial=0.0) <= NO_PART:
            continue
        lead = int(np.argmax(np.abs(rows[:, place])))
        way = rows[lead] / rows[lead, place]
        rows = np.delete(rows, lead, axis=0)
        rows = rows - np.outer(rows[:, place], way)
        found = {i: other - other[place] * way for i, other in found.items()} | {place: way}
    ways = {i: (np.where(np.abs(way) <= NO_PART, 0.0, way) * units / units[i])[:time] for i, way in found.items()}
    return ways.pop(time, np.zeros(time)), ways


def _refuse_spins(subject: Subject, v: Array, kept: NDArray[np.bool_], driven: bool) -> None:
    """Refuse a start whose only turning is that of bodies free to turn about any axis: no coordinate is its angle."""
    names = subject.compiled.info.velocities
    turns = np.array([q.unit == "rad/s" for q in names], dtype=np.bool_) & (np.abs(v) > 0.0)
    spins = [first + k for _, first in subject.compiled.info.spins for k in range(3) if turns[first + k]]
    if spins and not driven and not np.any(turns & kept):
        _refuse_spin(names[spins[0]].name)


def _refuse_lost(subject: Subject, y: Array, lost: Array) -> None:
    """Refuse to leave out a turning that would have gone on: of a body about an axis that nothing depends on.

    What swings at the start comes to rest in a steady motion. What spins about an axis along which the body may be
    turned, while nothing changes, would not.
    """
    spins = [first for _, first in subject.compiled.info.spins if np.any(lost[first : first + 3])]
    if not spins:
        return
    x = tangent(subject, y)
    free, matrix = x.free / subject.spans[:, np.newaxis], x.matrix * x.sizes / x.sizes[:, np.newaxis]
    size = np.abs(matrix).max(initial=0.0) or 1.0
    for first in spins:
        about = np.zeros((subject.nv, 3))
        about[first : first + 3] = np.eye(3)
        turned = np.linalg.lstsq(free, about, rcond=None)[0]
        changes = np.vstack([matrix[:, : x.positions] @ turned / size, about - free @ turned])
        _, felt, axes = np.linalg.svd(changes)
        spin = axes[felt <= NO_PART] @ lost[first : first + 3]
        if np.abs(spin).max(initial=0.0) > NO_PART * np.abs(lost / subject.spans).max():
            k = int(np.argmax(np.abs(lost[first : first + 3])))
            _refuse_spin(subject.compiled.info.velocities[first + k].name)


def _refuse_spin(name: str) -> None:
    expected = "joints whose angles or displacements turn on"
    got = f"'{name}', the turning of a body about any axis, which no coordinate counts"
    raise InputError("steady", expected, got, "give it joints with axes, such as three hinges")

"""How far drivers move between the times that a prescribed motion is asked for: it is followed at more times there.

A step is predicted from the state before it, so a driver that rests at both of its ends and moves between them is not
seen there. What drivers do in a whole motion is looked at beforehand, where nothing else moves.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from symgen.runtime import abi
from symgen.runtime.foreseen import foreseen
from symgen.runtime.probe import Ready

if TYPE_CHECKING:
    from symgen.analyses.prescribed import Prescribed

Array = NDArray[np.float64]

#: A driver moves by this between two times at most [rad, or the length of the mechanism].
FARTHEST = 0.25
#: Instants at which drivers are looked at first, and at most; they are enough where every second one shows all but
#: this part of the way. And instants between two times at which formulas are known to change, where these are few.
FIRST, MOST, UNSEEN, BETWEEN = 1024, 65536, 0.02, 16
#: Changes below this are none, and times nearer than this part of the motion are the same.
NOTHING, SAME = 1e-12, 1e-9
_GOLDEN = 0.5 * (5.0**0.5 - 1.0)


def with_stops(found: Prescribed, times: Array) -> tuple[Array, NDArray[np.bool_]]:
    """Return times with those between them at which drivers turn back or have gone far, and where the first ones are.

    Parameters
    ----------
    found : Prescribed
        Ready, and all driven.
    times : Array, shape (k,)
        All behind 0, or all before it, in the order in which they are met [s].

    Returns
    -------
    tuple of Array
        Times in that order, shape (n,), and whether each is one of those given.
    """
    end = float(times[-1])
    where = np.append(0.0, times) / end if end != 0.0 else np.zeros(1)  # from 0 to 1
    if not end or len(where) < 2:
        return times, np.ones(len(times), dtype=bool)
    at, way = _looked_at(found, end)
    steps = np.diff(way, axis=0)
    gone = np.append(0.0, np.cumsum(np.nan_to_num(np.abs(steps).max(axis=1, initial=0.0))))
    stops = _turns(at, steps)
    # where the asked times are dense nothing is added between them
    far = np.diff(np.interp(where, at, gone)) > FARTHEST
    passed = at[1:][np.diff(np.floor(gone / FARTHEST)) > 0.0]
    between = np.minimum(np.searchsorted(where, passed, side="right") - 1, len(far) - 1)
    stops = np.unique(np.concatenate([stops, passed[far[between]]]))
    k = np.clip(np.searchsorted(where, stops), 1, len(where) - 1)
    stops = stops[np.minimum(stops - where[k - 1], where[k] - stops) > SAME]
    together = np.concatenate([times, stops * end])
    order = np.argsort(np.abs(together), kind="stable")
    return together[order], order < len(times)


def _looked_at(found: Prescribed, end: float) -> tuple[Array, Array]:
    """Return parts of a motion, and how far each row is open there if nothing moves but drivers, as a number."""
    compiled, start = found.compiled, found.start
    geometry, w = Ready(compiled.model.geometry, abi.MEASURE), start.w.copy()
    y, knots = start.y.copy(), _known(found, end)
    scale = np.array([1.0 if row.unit == "rad" else 1.0 / w[abi.LENGTH] for row in compiled.info.rows])
    count = FIRST
    while True:
        # not equidistant, so that what is faster than the looks is seen to be
        i = np.arange(1, count)
        at = np.concatenate([[0.0], (i + 0.6 * (_GOLDEN * i % 1.0)) / (count + 0.6), knots, [1.0]])
        at.sort()
        way = np.empty((len(at), len(scale)))
        for k, part in enumerate(at):
            geometry(float(part * end), y, start.p, w)
            way[k] = compiled.section(w, "residual") * scale
        whole, seen = (np.nansum(np.abs(np.diff(x, axis=0))) for x in (way, np.concatenate([way[::2], way[-1:]])))
        if whole - seen <= UNSEEN * whole or count >= MOST:
            return at, way
        count *= 2


def _known(found: Prescribed, end: float) -> Array:
    """Return parts of a motion at which formulas are known to change, and some between, however short that is."""
    values = {q.name: float(x) for q, x in zip(found.compiled.info.parameters, found.start.p, strict=False)}
    changes = foreseen(found.mechanism).times(values, max(end, 0.0), min(end, 0.0))
    if not 0 < len(changes) <= MOST:  # more of them are looked at as anything else is
        return np.zeros(0)
    times = np.unique([0.0, *(t / end for t in changes), 1.0])
    between = min(BETWEEN, MOST // len(changes))
    k = np.arange(1, between * (len(times) - 1))
    return np.asarray(np.interp(k / between, np.arange(len(times)), times))


def _turns(at: Array, steps: Array) -> Array:
    """Return where a row turns back: the vertex of the parabola through three instants beside it."""
    found, length = list[float](), np.diff(at)
    for column in steps.T:
        moving = np.flatnonzero(np.abs(column) > NOTHING)  # not where it rests
        here = moving[1:][np.sign(column[moving[1:]]) != np.sign(column[moving[:-1]])]
        for k in here:
            before, behind = column[k - 1] / length[k - 1], column[k] / length[k]
            t = at[k]
            if before * behind < 0.0:
                a, b = 0.5 * (at[k - 1] + at[k]), 0.5 * (at[k] + at[k + 1])
                t = a + (b - a) * before / (before - behind)  # where its slope is 0
            found.append(float(t))
    return np.array(found)

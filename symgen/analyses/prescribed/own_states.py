"""States of a file's own along a prescribed motion: integrated from the start, as a run integrates them.

Along it their rates are formulas of t and of these states alone. Between the times at which the motion is computed
coordinates and velocities are cubic; their number is doubled until that changes nothing.
"""

from __future__ import annotations

import warnings
from collections.abc import Callable
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from symgen.analyses.prescribed.passing import coordinate_rates
from symgen.analyses.prescribed.prescribed import PrescribedRun
from symgen.analyses.prescribed.tracing import trace_motion
from symgen.base.errors import AnalysisError
from symgen.describe.facts.kinks import jumps_in_time
from symgen.run.breaks.in_time import InTime
from symgen.run.compiling.side import Side, compile_side
from symgen.run.layout import abi

Array = NDArray[np.float64]

#: Relative tolerance of the integration, and the part of that which counts beside a state of 0.
TOLERANCE, BESIDE_NOTHING = 1e-10, 1e-3
#: Times of the motion in each piece without kinks, first and at most: twice as many until states no longer change by
#: more than a part of their size.
FIRST, MOST, SETTLED = 64, 2**16, 1e-8
#: So far from a kink, as a part of the piece, rates on its side are those beyond it.
ASIDE = 1e-9
#: So many evaluations of rates within this part of a piece are those of states that go nowhere.
STALLED, NEARLY = 1000, 1e-12


def states_along(run: PrescribedRun, times: Array) -> tuple[Array, str]:
    """Integrate the states of the file along a motion, from the start at t = 0.

    Parameters
    ----------
    run : PrescribedRun
        Ready, and all driven.
    times : Array, shape (k,)
        Increasing times that the motion reaches [s].

    Returns
    -------
    states : Array, shape (k, n)
        States at these times.
    note : str
        How far they are off, in a sentence; empty where that is below the tolerance.

    Raises
    ------
    AnalysisError
        If they cannot be integrated.
    """
    own = run.compiled.info.own_states
    states, worst = np.tile(run.start.y[own], (len(times), 1)), 0.0
    rates = [(x.name, x.rate) for x in run.mechanism.states]
    side = compile_side(run.mechanism, run.compiled, "states", "rates of states", rates)
    behind = times > 0.0
    for here, end in ((behind, times.max(initial=0.0)), (times < 0.0, times.min(initial=0.0))):
        if here.any():
            forward = np.unique(np.abs(times[here])) * np.sign(end)
            values, apart = _integrate_one_way(run, side, forward, float(end))
            states[here], worst = values[:: 1 if end > 0.0 else -1], max(worst, apart)
    names = ", ".join(x.name for x in run.mechanism.states)
    return states, f"states along the motion ({names}) are off by about {worst:.1g} of their size" if worst else ""


def _integrate_one_way(run: PrescribedRun, side: Side, times: Array, end: float) -> tuple[Array, float]:
    """Return states at times from 0 to an end, and the part of them that they are off by; 0 below the tolerance."""
    pieces = list(pairwise([0.0, *_kink_times(run, end), end]))
    before, size = None, FIRST
    while True:
        now, z = np.empty((len(times), len(side.labels))), run.start.y[run.compiled.info.own_states].copy()
        for a, b in pieces:
            inside = (times - a) * np.sign(end) > 0.0
            inside &= (times - b) * np.sign(end) <= 0.0
            path = _path_through_states(run, a, b, size)
            now[inside], z = _integrate_piece(run, side, path, (a, b), z, times[inside])
        largest = np.abs(now).max(axis=0, initial=1e-300)
        apart = np.inf if before is None else float((np.abs(now - before) / largest).max(initial=0.0))
        if apart <= SETTLED or not {"q", "v", "winding"} & side.reads:
            return now, 0.0
        if size >= MOST:
            return now, apart
        before, size = now, 2 * size


def _kink_times(run: PrescribedRun, end: float) -> list[float]:
    """Return the times inside a motion at which inputs or formulas jump or have kinks, in the order of the motion."""
    first, last = min(0.0, end), max(0.0, end)
    formulas, times = InTime(run.mechanism, run.numbers), {t for t, _ in run.held}
    for jump in sum(jumps_in_time(run.mechanism), ()):
        times.update(formulas.crossings(jump, last, first))
    near = ASIDE * abs(end)
    kinks = list[float]()
    for t in sorted(times, key=abs):
        if first + near < t < last - near and (not kinks or abs(t - kinks[-1]) > near):
            kinks.append(t)
    return kinks


#: Time -> coordinates, velocities, and angles that count turns.
Path = Callable[[float], tuple[Array, Array, Array]]


def _path_through_states(run: PrescribedRun, begin: float, end: float, size: int) -> Path:
    """Return the motion in a piece without kinks through its states at equally distant times."""
    from scipy.interpolate import CubicHermiteSpline

    info = run.compiled.info
    inside = ASIDE * (end - begin)
    nodes = np.sort(np.linspace(begin + inside, end - inside, size + 1))
    traced = trace_motion(run, nodes)
    t, (q, v), a = traced.times, info.parts(traced.states), traced.accelerations
    if len(t) < 2:
        raise AnalysisError(f"the motion near t = {begin:.6g} s cannot be followed for the states of the file")
    slopes = np.array([coordinate_rates(info, *each) for each in zip(q, v, strict=True)])
    places, speeds = CubicHermiteSpline(t, q, slopes), CubicHermiteSpline(t, v, a)
    turned = traced.status[:, abi.N_STATUS :]

    def state_at(time: float) -> tuple[Array, Array, Array]:
        k = int(np.clip(np.searchsorted(t, time), 1, len(t) - 1))
        nearest = k if abs(t[k] - time) < abs(time - t[k - 1]) else k - 1
        return places(time), speeds(time), turned[nearest]

    return state_at


def _integrate_piece(
    run: PrescribedRun, side: Side, path: Path, ends: tuple[float, float], z: Array, times: Array
) -> tuple[Array, Array]:
    """Return states at times of a piece, and at its end."""
    from scipy.integrate import solve_ivp

    info, (begin, end) = run.compiled.info, ends
    y, w, nothing = run.start.y.copy(), run.start.w.copy(), np.zeros(info.ny)
    p = next((p for until, p in run.held if 0.5 * (begin + end) <= until), run.p)

    mark, stalled = begin, 0

    def rate_of_states(t: float, states: Array) -> Array:
        nonlocal mark, stalled
        mark, stalled = (t, 0) if abs(t - mark) > NEARLY * abs(end - begin) else (mark, stalled + 1)
        if stalled > STALLED:
            raise AnalysisError(beyond.format(t))
        q, v, turned = path(t)
        y[: info.nq], y[info.nq : info.work], y[info.own_states] = q, v, states
        w[abi.WINDING : abi.WINDING + info.windings] = turned
        return side(t, y, p, w, nothing)

    beyond = "the states of the file cannot be integrated along the motion beyond t = {:.6g} s"
    least = TOLERANCE * BESIDE_NOTHING * np.maximum(np.abs(z), 1.0)
    at = np.append(times, end) if not len(times) or times[-1] != end else times
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # what fails is said below
        done = solve_ivp(rate_of_states, ends, z, "LSODA", t_eval=at, rtol=TOLERANCE, atol=least)
    if not done.success or not np.all(np.isfinite(done.y)):
        raise AnalysisError(beyond.format(done.t[-1] if len(done.t) else begin))
    return done.y.T[: len(times)], done.y[:, -1]

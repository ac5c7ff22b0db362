"""Resets: the smallest impulse that sets velocities to new values, and rebounds below rounding."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from symgen.base.errors import InputError
from symgen.layout import abi
from symgen.layout.probe import Ready, rate_function
from symgen.loops.run_spec import Masses, Reset
from symgen.loops.search_records import COUNT, N_VALUES

if TYPE_CHECKING:
    from symgen.layout.compiled import CompiledModel, ModelInfo
    from symgen.loops.hunting import HuntingState

Array = NDArray[np.float64]

#: Singular values below this fraction of the largest one are rounding; relative residual of conditions that are met.
_ROUNDING, _MET = 1e-11, 1e-9
#: Rounding of velocities of joints, relative to the velocities of which these are differences.
_NOISE = 1e-14
_EPSILON = 2.0**-52
#: A rebound of fewer roundings than this, of the switching function or of the time, is lost: its end is accurate to a
#: thousandth of it.
_FEWEST = 1e3
#: Changes of a state for finite differences: of each coordinate, and of the time as a fraction of the run.
_RELATIVE, _AHEAD = 1e-6, 1e-9


@dataclass(frozen=True)
class Impact:
    """Effect of resets at one time on a state.

    Attributes
    ----------
    v : Array, shape (nv,)
        Velocities afterwards.
    impulses : Array
        Of each row of D, then of each velocity that was set.
    imposed : tuple of str
        These velocities.
    energy : float
        Change of the energy [J].
    """

    v: Array
    impulses: Array
    imposed: tuple[str, ...]
    energy: float


def impact_of(
    compiled: CompiledModel, resets: Sequence[Reset], masses: Masses, names: str, t: float, y: Array, p: Array, w: Array
) -> Impact:
    """Return the velocities, impulses and energy of resets of a state.

    Parameters
    ----------
    compiled : CompiledModel
        Model and method.
    resets : sequence of Reset
        Resets at the same time, which are one.
    masses : callable
        See `Masses`.
    names : str
        Owners of the resets, for errors.
    t : float
        Time [s].
    y, p, w : Array
        The state, parameters, and scratch, whose geometry is written.

    Raises
    ------
    InputError
        If the constraints, or other resets, do not allow a reset.
    """
    info = compiled.info
    Ready(compiled.model.geometry, abi.MEASURE)(t, y, p, w)
    labels, rows, values = list[str](), [compiled.jacobian(w)], [compiled.section(w, "nu").copy()]
    for reset in resets:
        own, wanted = _rows(compiled, reset, t, y, p, w)
        labels += reset.labels
        rows.append(own)
        values.append(wanted)
    v, every, right = y[info.nq : info.nq + info.nv], np.concatenate(rows), np.concatenate(values)
    carry, rest, bodies = masses(compiled, t, y, p, w)
    after, impulses, contradictory = strike(carry.T @ bodies @ carry, every, right, v)
    if contradictory or not np.all(np.isfinite(after)):
        raise _refusal(names, labels, _nearest(carry.T @ bodies @ carry, every, right, v, info.m), right[info.m :], t)
    for row, value in zip(every[info.m :], right[info.m :], strict=True):
        if np.count_nonzero(row) == 1 and row.max() == 1.0:
            after[np.argmax(row)] = value  # a velocity itself: exactly, so that one at rest is at rest
    energy = 0.5 * float((carry @ (after - v)) @ bodies @ (carry @ (after + v) + 2.0 * rest))
    return Impact(after, impulses, tuple(labels), energy)


def _rows(compiled: CompiledModel, reset: Reset, t: float, y: Array, p: Array, w: Array) -> tuple[Array, Array]:
    """Return the rows of the velocities of a reset, and the values of these rows times v+."""
    info, count, ydot = compiled.info, len(reset.labels), np.zeros(compiled.info.ny)
    rows, rest = linear_in_v(info, y, lambda still: reset.evaluate(t, still, p, w, ydot)[:count])
    return rows, reset.evaluate(t, y, p, w, ydot)[count:] - rest


def linear_in_v(info: ModelInfo, y: Array, function: Callable[[Array], Array]) -> tuple[Array, Array]:
    """Return the row of coefficients of v in a function that is linear in v, and the function's value at rest."""
    still = y.copy()
    still[info.nq : info.nq + info.nv] = 0.0
    rest = function(still).copy()
    columns = np.zeros((len(rest), info.nv))
    for j in range(info.nv):
        still[info.nq + j] = 1.0
        columns[:, j] = function(still) - rest
        still[info.nq + j] = 0.0
    return columns, rest


def _refusal(names: str, labels: Sequence[str], near: Array, values: Array, t: float) -> InputError:
    wanted, nearest = (
        ", ".join(f"{label} = {x:.6g}" for label, x in zip(labels, numbers, strict=True)) for numbers in (values, near)
    )
    expected = "velocities that the joints and each other allow"
    return InputError(names, expected, f"{wanted} at t = {t:.6g} s", f"the nearest are {nearest}")


def _nearest(mass: Array, rows: Array, values: Array, v: Array, count: int) -> Array:
    """Return the values of the last rows nearest to the wanted ones, while the first rows hold exactly.

    Parameters
    ----------
    mass, rows, values, v
        As for `strike`.
    count : int
        Number of the first rows, those of joints.
    """
    unit, scale = _alike(mass, rows)
    _, sizes, vectors = np.linalg.svd(scale[:count, np.newaxis] * rows[:count] * unit, full_matrices=True)
    free = unit[:, np.newaxis] * vectors[np.count_nonzero(sizes > _ROUNDING * sizes.max(initial=0.0)) :].T
    own, start = rows[count:], strike(mass, rows[:count], values[:count], v)[0]
    along = own @ free
    along[np.linalg.norm(scale[count:, np.newaxis] * along, axis=1) < _ROUNDING] = 0.0  # determined by joints
    return np.asarray(own @ start + along @ np.linalg.lstsq(along, values[count:] - own @ start, rcond=_ROUNDING)[0])


def _alike(mass: Array, rows: Array) -> tuple[Array, Array]:
    """Return units of velocities with equal kinetic energy, and factors that make rows in these units equally long."""
    diagonal = np.diag(mass)
    usual = float(diagonal.mean()) or 1.0
    unit = 1.0 / np.sqrt(np.where(diagonal > 0.0, diagonal, usual))
    long = np.linalg.norm(rows * unit, axis=1)
    # a row that the joints of a tree satisfy by construction is rounding: scaled, it would become a constraint
    counts = long > _ROUNDING * long.max(initial=0.0)
    return unit, np.where(counts, 1.0 / np.where(counts, long, 1.0), 0.0)


def strike(mass: Array, rows: Array, values: Array, v: Array) -> tuple[Array, Array, bool]:
    """Return the velocities after the smallest impulse along some rows C.

    An impulse i changes velocities by ``M (v+ - v-) = C^T i``. With ``C v+ = c`` this is the v+ for which the kinetic
    energy of the change, ``(v+ - v-)^T M (v+ - v-) / 2``, is smallest.

    Changes have two parts: the shortest one that satisfies the rows, and one in their null space. So M may be singular
    where the rows determine velocities without mass.

    Parameters
    ----------
    mass : Array, shape (nv, nv)
        M.
    rows, values : Array, shapes (k, nv), (k,)
        C and c.
    v : Array, shape (nv,)
        Velocities before.

    Returns
    -------
    v : Array, shape (nv,)
        Velocities afterwards.
    impulses : Array, shape (k,)
        Of each row, in the directions of the rows; of least norm where rows depend on each other.
    contradictory : bool
        Whether ``C v+ - c`` is larger than rounding.
    """
    unit, scale = _alike(mass, rows)
    scaled, target = scale[:, np.newaxis] * rows * unit, scale * (values - rows @ v)
    metric = unit[:, np.newaxis] * mass * unit
    left_vectors, sizes, vectors = np.linalg.svd(scaled, full_matrices=True)
    rank = int(np.count_nonzero(sizes > _ROUNDING * sizes.max(initial=0.0)))
    span, free = vectors[:rank], vectors[rank:].T
    back = left_vectors[:, :rank] / sizes[:rank]
    change = np.zeros(len(v))
    for _ in range(2):  # the second time corrects rounding
        change += span.T @ (back.T @ (target - scaled @ change))
        change += free @ np.linalg.lstsq(free.T @ metric @ free, -free.T @ (metric @ change), rcond=None)[0]
    after = v + unit * change
    left = rows @ after - values
    largest = float(np.max(np.abs(scale * values), initial=0.0) + np.max(np.abs(scale * (rows @ v)), initial=0.0))
    # the change of a slow body may be less than the rounding of fast ones
    noise = _NOISE * float(np.max(scale * (np.abs(rows) @ (np.abs(v) + np.abs(after))), initial=0.0))
    contradictory = bool(np.any(np.abs(scale * left) > _MET * largest + noise))
    return after, scale * (back @ (span @ (metric @ change))), contradictory


def are_lost(
    compiled: CompiledModel, function: Any, events: Sequence[tuple[int, int]], state: HuntingState, duration: float
) -> bool:
    """Return whether a switching function returns so soon after a reset that rounding decides the time.

    Right after the reset g is 0 up to rounding and leaves with the rate g'; with g'' against it, it reaches
    g'^2 / (2 g'') and returns after 2 g' / g''. The rounding of g is estimated from its change with each coordinate,
    and with the time.

    Parameters
    ----------
    compiled : CompiledModel
        Model and method.
    function : emitted function
        Switching functions, then their rates.
    events : sequence of (int, int)
        Numbers of the events that have just been reset, and their directions, 0 for both.
    state : HuntingState
        Of the run, after the resets; not changed.
    duration : float
        Of the run [s].
    """
    info, t = compiled.info, float(state.clock[abi.TIME])
    rates, happens = rate_function(compiled), Ready(function, abi.OBSERVE)
    w, iw, p = state.w.copy(), state.iw.copy(), state.p

    def at(moment: float, y: Array, rate: Array) -> tuple[Array, Array]:
        n = int(state.hunt[COUNT])
        out = np.zeros(N_VALUES * n)
        happens(moment, y, p, w, rate, out)
        return out[:n], out[n : 2 * n]

    y, rate = state.y.copy(), np.zeros_like(state.y)
    rates(t, y, p, w, iw, rate)
    g, slope = at(t, y, rate)
    rounding = np.abs(at(t + _RELATIVE * abs(t), y, rate)[0] - g)
    index, other = np.arange(info.nq), y.copy()
    # signs are the digits of the coordinates' numbers, so that few evaluations suffice and no two coordinates cancel
    for digit in range(info.nq.bit_length() + 1):
        signs = 1.0 - 2.0 * (index >> digit & 1)
        other[: info.nq] = y[: info.nq] * (1.0 + _RELATIVE * signs)
        rounding += np.abs(at(t, other, rate)[0] - g)
    rounding *= _EPSILON / _RELATIVE
    ahead = _AHEAD * duration
    y += ahead * rate
    rates(t + ahead, y, p, w, iw, rate)
    curve = (at(t + ahead, y, rate)[1] - slope) / ahead
    for k, direction in events:
        back = -np.sign(slope[k])  # the direction in which it would happen again
        if direction not in (0, back) or not slope[k] * curve[k] < 0.0 or abs(g[k]) > _FEWEST * rounding[k]:
            continue
        far, long = 0.5 * slope[k] ** 2 / abs(curve[k]), 2.0 * abs(slope[k] / curve[k])
        if far < _FEWEST * rounding[k] or long < _FEWEST * _EPSILON * abs(t):
            return True
    return False

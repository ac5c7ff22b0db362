"""Resets whose rebounds are below rounding."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from symgen.layout import abi
from symgen.layout.probe import Ready, rate_function
from symgen.loops.search_records import COUNT, N_VALUES

if TYPE_CHECKING:
    from symgen.layout.compiled import CompiledModel
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

"""What the loop over a prescribed motion works on: the model's layout, where it stands, what it writes."""

from __future__ import annotations

from typing import Any, NamedTuple

from numba import types

#: How a step, and the loop, ended.
DONE, REFUSED, UNDEFINED, SINGULAR, PASSING, CHOOSE = range(6)

#: What a clock holds: the time, the longest step to try, the sine, how fast it changes, the sign of the determinant,
#: time, sine and predicted motion of the last attempt, and the largest sine since rows were chosen that stand for all.
TIME, REACH, SINE, SLOPE, SIGN, TRIED, TRIED_SINE, FAR, BEST = range(9)
N_CLOCK = 9
#: What is counted: times that are done, steps, and whether a state was settled.
AT, TAKEN, SETTLED = range(3)
N_COUNTS = 3

_A, _K, _M, _I8, _F = types.float64[::1], types.int64[::1], types.float64[:, ::1], types.int64, types.float64


class Course(NamedTuple):
    """What the loop has to know of a model.

    Attributes
    ----------
    nq, nv, m, ny, windings : int
        Coordinates, velocities, constraint rows, length of the state, angles whose turns are counted.
    residual, change, mask, jacobian : int
        Where these sections of ``w`` begin.
    masked, rank : int
        Rows that depend on others for ever, and the rank of D where the position is not singular: as many as there are
        velocities.
    tolerance, least : float
        Of the violation of positions [m], and the shortest step [s].
    entries, constants : Array
        D's structural entries, see `symgen.runtime.model_arrays.entries_of`.
    scale : Array, shape (nv,)
        What makes numbers of changes: 1 for angles, one over the length of the mechanism for lengths.
    """

    nq: int
    nv: int
    m: int
    ny: int
    windings: int
    residual: int
    change: int
    mask: int
    jacobian: int
    masked: int
    rank: int
    tolerance: float
    least: float
    entries: Any
    constants: Any
    scale: Any


class Stand(NamedTuple):
    """Where the loop stands, and room for what it tries.

    Attributes
    ----------
    y, a, jerk : Array, shapes (ny,), (nv,), (nv,)
        State, accelerations, and how these changed in the last step over its length.
    clock, counts : Array
        See the constants of this module.
    trial, rates : Array, shape (ny,)
        The state that is tried, and its rates.
    rows : Array
        What ``observe`` writes.
    turned : Array, shape (windings,)
        Angles whose turns are counted, as they are in the accepted state.
    dense : Array
        A square D.
    """

    y: Any
    a: Any
    jerk: Any
    clock: Any
    counts: Any
    trial: Any
    rates: Any
    rows: Any
    turned: Any
    dense: Any


class Followed(NamedTuple):
    """What the loop writes: states, accelerations and status, one row a time.

    The status is that of `symgen.runtime.outcome.Motion`.
    """

    states: Any
    accelerations: Any
    status: Any


COURSE = types.NamedTuple((*(_I8,) * 11, _F, _F, _K, _A, _A), Course)
STAND = types.NamedTuple((*(_A,) * 4, _K, *(_A,) * 5), Stand)
FOLLOWED = types.NamedUniTuple(_M, 3, Followed)

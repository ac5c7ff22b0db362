"""Records of arrays and numbers: named tuples, which compiled code takes like single arguments.

Loops unpack them once, at their entry, and make their arrays bare (`symgen.compile.loopcode.bare`): each access to a
field of a record that owns its arrays costs a reference count.
"""

from __future__ import annotations

from typing import Any

from symgen.compile.native.annotations import Array, Integers, Matrix, Record, record_type
from symgen.run.layout import abi
from symgen.run.layout.start_records import Layout


class Sizes(Record):
    """Sizes of a model, and positions in its scratch array.

    Attributes
    ----------
    nq, nv, m, ny : int
        Coordinates, velocities, constraint rows, and length of the state: q, v, then auxiliary states, the work first.
    width : int
        Length of arrays that hold a state, see `symgen.compile.loopcode.vectors`.
    controlled : int
        Elements of the state under error control, over which errors are averaged: at least 1, as a mechanism that is
        welded together has none in joint coordinates.
    unknowns : int
        Of a stage in the descriptor form; 0 for other forms.
    pivots, multipliers, mask, change, gauge, row_weight, jacobian, auxiliary : int
        First index in ``w`` of: the pivots of D D^T, the multipliers, the mask of redundant rows, changes of
        velocities, the factors that make rank independent of units and rows equally long, the entries of D that vary,
        and the residuals of the rates of auxiliary states.
    states : int
        States defined by the file, after the work; their rates are the last unknowns.
    """

    nq: int
    nv: int
    m: int
    ny: int
    width: int
    controlled: int
    unknowns: int
    pivots: int
    multipliers: int
    mask: int
    change: int
    gauge: int
    row_weight: int
    jacobian: int
    auxiliary: int
    states: int


class Span(Record):
    """End, steps and tolerances of a run.

    Attributes
    ----------
    step : float
        Constant step, or first step of an adaptive run [s]; 0: chosen from the right-hand side.
    largest : float
        Bound of adaptive steps [s].
    until, end, duration : float
        End of the present part and of the whole run, and the time by which a motion at rest is judged [s].
    rtol, atol : float
        Tolerances of an adaptive run.
    relative : float
        1 where `atol` applies to numbers of order 1 (see `State.scales`), 0 where it has the units of the state.
    safety : float
        Fraction of the step that the error estimate would allow.
    most : float
        Largest number of attempts at an adaptive step.
    pause : float
        Number of accepted steps at which the loop is left.
    turn : float
        Largest change of an angle of a body or joint in a step [rad].
    """

    step: float
    largest: float
    until: float
    end: float
    duration: float
    rtol: float
    atol: float
    relative: float
    safety: float
    most: float
    pause: float
    turn: float


class State(Record):
    """State of a run; a scheme's own record holds its data beyond `memory`.

    Attributes
    ----------
    y : Array, shape (width,)
        The accepted state.
    p, w, iw : Array
        Parameters, scratch and counters of emitted functions.
    clock, gauges, control, passages : Array
        See `symgen.run.layout.abi`.
    memory : Array
        Data that the scheme keeps from step to step.
    share : Array, shape (2 width,)
        1 for elements of the state under error control, else 0; then the places that elements are measured from.
    metric, scales : Array, shape (2 width,)
        Factors that convert coordinates and velocities to lengths and speeds, and to numbers of order 1; see
        `symgen.run.layout.scales.settle_scales`; then these places.
    room : Array
        Working memory: nothing in it outlives a step. It begins with the trial state.
    """

    y: Array
    p: Array
    w: Array
    iw: Integers
    clock: Array
    gauges: Array
    control: Integers
    passages: Array
    memory: Array
    share: Array
    metric: Array
    scales: Array
    room: Array


class Run(Record):
    """A `State` opened by a loop: bare arrays, `trial` being the trial state and `room` the memory after it."""

    y: Array
    trial: Array
    p: Array
    w: Array
    iw: Integers
    clock: Array
    gauges: Array
    control: Integers
    passages: Array
    memory: Array
    share: Array
    metric: Array
    scales: Array
    room: Array


class EventRun(Run):
    """A `Run` with the data of events, see `symgen.run.loops.search_records`."""

    hunt: Array


class Outputs(Record):
    """Output times, states, and the status that ``accept`` measured, followed by angles that count turns and modes.

    Attributes
    ----------
    times : Array, shape (k,)
        Increasing [s].
    states, status : Array, shapes (k, ny), (k, N_STATUS + kept)
        Written.
    """

    times: Array
    states: Matrix
    status: Matrix


class Observed(Record):
    """Quantities evaluated at outputs after a run.

    Attributes
    ----------
    accelerations, multipliers : Array, shapes (k, nv), (k, m)
        v' and lambda.
    rows : Array, shape (k, m + 2 n)
        D v' - gamma, then value and rate of every joint coordinate.
    """

    accelerations: Matrix
    multipliers: Matrix
    rows: Matrix


class RowChunk(Record):
    """Rows of an ensemble, and their results.

    Attributes
    ----------
    selected : Array of int64
        Rows to run.
    ys, ps, ws : Array, shapes (k, ny), (k, np), (k, nw), flat
        Starts, parameters and scratch; overwritten.
    limits : Array
        Largest violations of position and velocity, largest energy error, and the pivot below which a position is near
        a singular one.
    picks : Array of int64
        (source, column) of each requested quantity.
    values : Array, shape (k, quantities, times), flat
        Result.
    summary : Array, shape (k, N_SUMMARY), flat
        Result.
    events : Array, shape (k, numbers of events), flat
        Result, see `symgen.run.layout.ensemble_abi`; empty where no events are looked for.
    ends : int
        1 where the only output is the end of a run, also at an event.
    rates, joints : int
        1 where accelerations or multipliers, and joint coordinates, are requested.
    balanced : int
        1 where the law has a balance of forces.
    layout, dense : Layout, Array
        For `symgen.run.layout.redundancy.choose_rows`; `dense`, its working memory, is empty where rows stay the same.
    """

    selected: Integers
    ys: Array
    ps: Array
    ws: Array
    limits: Array
    picks: Integers
    values: Array
    summary: Array
    events: Array
    ends: int
    rates: int
    joints: int
    balanced: int
    layout: Layout
    dense: Array


class Kept(Record):
    """Results of the present run."""

    outputs: Outputs
    observed: Observed


class ModelSystem(Record):
    """A model as schemes see it: its sizes and functions, 0 for those that the scheme does not call."""

    sizes: Sizes
    rhs: abi.Rhs
    confirm: abi.Rhs
    accept: abi.Accept
    turn: abi.Move
    residual: abi.Stage
    tangent: abi.Stage


#: Sizes of a model, and the functions called at outputs.
Observers = tuple[Sizes, abi.Rhs, abi.Rhs, abi.Accept, abi.Observe, abi.Balance]
#: What the loop over one run takes first: the parts of a `ModelSystem`, or such parts with those of a loop around it.
#: Each loop knows its own.
System = tuple[Any, ...]

#: Types of the records in compiled loops.
SIZES, SPAN, STATE, OUTPUTS = map(record_type, (Sizes, Span, State, Outputs))
KEPT_OF_RUN, CHUNK = record_type(Kept), record_type(RowChunk)

"""The loops of `symgen.run.loops.frame` on CUDA devices: the same source, instantiated for a law.

CUDA has no first-class functions, so a kernel is built for a law, with one thread for each run: `on_device` takes the
plain Python of a function and of all its callees to Numba's CUDA compiler. The source is shared, so a device takes the
steps that a processor takes.

The state, scratch and stages of a run are local memory of its thread: the hardware interleaves it so that neighbouring
threads touch neighbouring words, its addresses are constants, and it stays in the first-level cache. Starts,
parameters and outputs are global memory with the run as the fastest index.

Importing this module imports ``numba.cuda``; nothing else in symgen does.
"""

from __future__ import annotations

import math
import types as python
from dataclasses import dataclass
from types import ModuleType
from typing import Any, NamedTuple, TypeVar

from numba import config, cuda, float64, int64, types

from symgen.compile.loopcode.loop_instances import Instances, Meanings, viewing
from symgen.compile.loopcode.vectors import PLAIN
from symgen.compile.native import types as native
from symgen.compile.native.annotations import Array, Integers
from symgen.run.layout import abi
from symgen.run.layout import ensemble_abi as e
from symgen.run.layout.probe import rate_functions
from symgen.run.layout.records import SIZES, SPAN, Kept, Observed, Outputs, Run, Sizes, Span, State
from symgen.run.layout.redundancy import no_rows_fell
from symgen.run.layout.scheme_records import TABLEAU, TableauRecord
from symgen.run.loops import frame, watch
from symgen.run.loops.schemes import explicit
from symgen.run.rows import row_results, rows
from symgen.run.single import observe

_Value = TypeVar("_Value")
_A, _K, _M, _T = types.float64[::1], types.int64[::1], types.float64[:, ::1], types.float64[:, :, ::1]
#: Numbers of `passages` on a device: the present passage, and the narrowest one so far.
N_PASSAGES = 2 * abi.N_PASSAGE
_N_PASSAGE, _MAX_PASSAGES = abi.N_PASSAGE, abi.MAX_PASSAGES


class Starts(NamedTuple):
    """Starts of runs, shapes (ny, runs), (np, runs), (nw, runs); and the inputs of their observers."""

    ys: Array
    ps: Array
    ws: Array
    limits: Array
    share: Array
    metric: Array
    picks: Integers
    times: Array


class DeviceResults(NamedTuple):
    """Results of runs: outputs and observed quantities by output, column and run; other numbers by run."""

    states: Array
    status: Array
    accelerations: Array
    multipliers: Array
    rows: Array
    values: Array
    summary: Array


#: Types of a kernel's arguments; see `make_kernel`.
STARTS = types.NamedTuple(Starts(ys=_M, ps=_M, ws=_M, limits=_A, share=_A, metric=_A, picks=_K, times=_A), Starts)
RESULTS = types.NamedTuple(
    DeviceResults(states=_T, status=_T, accelerations=_T, multipliers=_T, rows=_T, values=_M, summary=_M), DeviceResults
)


def _numbas(kind: native.Kind) -> Any:
    """Return Numba's type of a number, an array or a record of these."""
    if isinstance(kind, native.RecordType):
        return types.BaseTuple.from_types(tuple(map(_numbas, kind)), kind.constructor if kind.fields else None)
    if isinstance(kind, native.ArrayType):
        return types.Array(_numbas(kind.dtype), kind.ndim, "C")
    assert isinstance(kind, native.NumberType), "kernels take no functions"
    return getattr(types, kind.name)


SIGNATURE = types.void(_numbas(TABLEAU), _numbas(SIZES), _numbas(SPAN), STARTS, RESULTS)


def is_simulated() -> bool:
    """Return whether Numba's simulator replaces a device (``NUMBA_ENABLE_CUDASIM=1``)."""
    return bool(config.ENABLE_CUDASIM)


# -- replacements on a device ------------------------------------------------------------------------------------------


@viewing
def bare_value(value: _Value) -> _Value:
    """Replace `symgen.compile.loopcode.bare.bare`: CUDA counts no references."""
    return value


@viewing
def part_on_device(array: Array, first: int, size: int) -> Array:
    """Replace `symgen.compile.loopcode.bare.part`."""
    return array[first : first + size]


def watch_passages(sizes: Sizes, run: Run, y: Array, t: float) -> int:
    """Watch as on a processor; keep only the present passage and the narrowest one."""
    code, passages = watch_states(sizes, run, y, t), run.passages
    if (
        0 < run.control[abi.PASSAGES] <= _MAX_PASSAGES
        and not passages[_N_PASSAGE + abi.PASSAGE_PIVOT] <= passages[abi.PASSAGE_PIVOT]
    ):
        for i in range(_N_PASSAGE):
            passages[_N_PASSAGE + i] = passages[i]
    return code


def watch_states(sizes: Sizes, run: Run, y: Array, t: float) -> int:
    """Replace `symgen.run.loops.watch.watch` by one with a table of one event."""
    return 0


def confirm_nothing(t: float, y: Array, p: Array, w: Array, iw: Integers, ydot: Array) -> int:
    """Replace ``confirm`` in a law whose ``rhs`` never requires it."""
    return 0


class ForgivingMath:
    """``math`` with the results of compiled code, for the simulator: nan or infinity instead of exceptions."""

    def __getattr__(self, name: str) -> Any:
        value = getattr(math, name)
        if not callable(value):
            return value

        def forgiving(*arguments: float) -> Any:
            try:
                return value(*arguments)
            except ValueError:
                return math.nan
            except OverflowError:
                return math.inf

        return forgiving


#: Meanings of names in all functions on a device, and in the frame.
_ON_DEVICE = Meanings("sweeps on a CUDA device", bare=bare_value, part=part_on_device, **PLAIN)
_FRAME = Meanings("sweeps on a CUDA device", watch=watch_passages, rows_fell=no_rows_fell)


def on_device(function: Any, **meanings: Any) -> Any:
    """Return a function of the runtime and its callees as device functions.

    Parameters
    ----------
    function : compiled or plain function
        Only its Python source is used.
    **meanings
        Further meanings of global names on the device: helpers, and sizes.
    """
    common: dict[str, Any] = {**_ON_DEVICE, **meanings}
    if is_simulated():
        common["math"] = ForgivingMath()
    return Instances(common, _compile_kernel, everything=True).of(function)


def _compile_kernel(copy: python.FunctionType, original: Any) -> Any:
    return cuda.jit(device=True, inline="always" if hasattr(original, "viewing") else "never")(copy)


# -- kernels -----------------------------------------------------------------------------------------------------------


@dataclass(frozen=True)
class Need:
    """Properties of a kernel apart from its law: sizes in numbers, and its outputs.

    Attributes
    ----------
    width, n_p, nw : int
        Lengths of the state, of the parameters and of the scratch array.
    memory, room : int
        The scheme's memory, and its working memory.
    rows : int
        Count of numbers that ``observe`` writes at an output.
    adaptive, rates, joints : bool
        Whether steps are adaptive, accelerations or multipliers are outputs, and joint coordinates are.
    """

    width: int
    n_p: int
    nw: int
    memory: int
    room: int
    rows: int
    adaptive: bool
    rates: bool
    joints: bool

    @property
    def working(self) -> int:
        """Numbers of working memory, for the scheme or for observing."""
        return max(self.width + self.room, 2 * self.width + self.rows)

    @property
    def stored(self) -> int:
        """Length of the copy of the scratch array for observing."""
        return self.nw if self.rates else 1

    @property
    def local_bytes(self) -> int:
        """Local memory of a thread [bytes]."""
        own = 6 * self.width + self.n_p + self.nw + self.stored + self.memory + self.working
        return 8 * (own + abi.N_COUNTERS + abi.N_CLOCK + abi.N_GAUGES + e.N_CONTROL + N_PASSAGES)


def make_kernel(law: ModuleType, model: ModuleType, need: Need) -> Any:
    """Return the plain Python of the kernel that runs one law, for ``cuda.jit`` or ``cuda.compile_ptx``.

    Parameters
    ----------
    law, model : module
        Emitted for CUDA.
    need : Need
        Its sizes and outputs.

    Returns
    -------
    function
        ``kernel(scheme, sizes, span, starts, results)``, of the types in `SIGNATURE`; the run is the last index of
        every array of runs, and no array is empty: an unused one has one element.
    """
    parts: dict[str, Any] = explicit.ADAPTIVE_PARTS if need.adaptive else explicit.CONSTANT_PARTS
    one_passage = on_device(watch.watch, _N_PASSAGE=0)
    watched = on_device(watch_passages, watch_states=one_passage)
    integrate = on_device(frame.integrate, **{**parts, **_FRAME, "watch": watched})
    begin_run, pick = on_device(rows.begin_run), on_device(row_results.pick_quantities)
    summarise = on_device(row_results.summarise, _MAX_PASSAGES=1)  # only the narrowest passage is kept
    observe_rates, observe_rows = on_device(observe.observe_rates), on_device(observe.observe_rows)
    nothing = on_device(confirm_nothing)
    rhs, accept, confirm = law.rhs, law.accept, getattr(law, "confirm", nothing)
    rates, observed_by = rate_functions(law)[0], model.observe if need.joints else nothing
    width, n_p, nw, n_room, n_stored = need.width, max(1, need.n_p), need.nw, need.working, need.stored
    n_counters, n_gauges, n_control, n_clock = abi.N_COUNTERS, abi.N_GAUGES, e.N_CONTROL, abi.N_CLOCK
    n_passages, n_memory, n_rows = N_PASSAGES, max(1, need.memory), need.rows
    n_metric = 2 * need.width  # a device takes sizes of arrays as they are, no expressions
    wants_rates, wants_joints, balanced = need.rates, need.joints, hasattr(law, "balance")
    observe_balance, balance = (
        on_device(observe.observe_balance),
        getattr(law, "balance", on_device(rows.balance_nothing)),
    )

    def kernel(scheme: TableauRecord, sizes: Sizes, span: Span, starts: Starts, results: DeviceResults) -> None:
        i = cuda.grid(1)
        if i >= starts.ys.shape[1]:
            return
        y, p, w = cuda.local.array(width, float64), cuda.local.array(n_p, float64), cuda.local.array(nw, float64)
        stored, room = cuda.local.array(n_stored, float64), cuda.local.array(n_room, float64)
        clock, gauges = cuda.local.array(n_clock, float64), cuda.local.array(n_gauges, float64)
        passages, memory = cuda.local.array(n_passages, float64), cuda.local.array(n_memory, float64)
        metric, scales = cuda.local.array(n_metric, float64), cuda.local.array(n_metric, float64)
        iw, control = cuda.local.array(n_counters, int64), cuda.local.array(n_control, int64)
        for j in range(width):
            y[j] = starts.ys[j, i] if j < sizes.ny else 0.0
            metric[j], scales[j] = starts.metric[j], 0.0
            metric[width + j], scales[width + j] = starts.share[width + j], starts.share[width + j]
        for j in range(starts.ps.shape[0]):
            p[j] = starts.ps[j, i]
        for j in range(nw):
            w[j] = starts.ws[j, i]
            if wants_rates:
                stored[j] = w[j]
        for j in range(n_room):
            room[j] = 0.0
        for j in range(n_memory):
            memory[j] = 0.0
        for j in range(n_passages):
            passages[j] = math.nan
        control[abi.STOP] = 0  # which `begin_run` leaves as it is
        state = State(y, p, w, iw, clock, gauges, control, passages, memory, starts.share, metric, scales, room)
        begin_run(state, starts.limits)
        k = starts.times.shape[0]
        outputs = Outputs(starts.times, results.states[:k, :, i], results.status[:k, :, i])
        code = integrate((sizes, rhs, confirm, accept, 0, 0, 0), scheme, span, state, outputs)
        if code == abi.DONE:  # a grid of steps meets the end up to rounding
            clock[abi.TIME] = span.until
        narrowest = passages[_N_PASSAGE:]
        ended = State(y, p, w, iw, clock, gauges, control, narrowest, memory, starts.share, metric, scales, room)
        summarise(code, ended, results.summary[:, i])
        count = control[abi.OUTPUTS]
        accelerations, multipliers = results.accelerations[:, : sizes.nv, i], results.multipliers[:, : sizes.m, i]
        observed = Observed(accelerations, multipliers, results.rows[:, :n_rows, i])
        if wants_rates:
            for j in range(n_counters):
                iw[j] = 0
            observe_rates((sizes, rates, confirm, accept), outputs, count, p, stored, iw, observed, room)
        if wants_joints:
            observe_rows(observed_by, sizes, outputs, count, p, w, observed, room)
        left = 0.0
        if balanced:
            law_of_rows = (sizes, rates, confirm, accept, balance)
            left = observe_balance(law_of_rows, outputs, count, control[abi.EVALUATIONS], 0, count, p, w, iw, room)
        results.summary[e.IMBALANCE, i] = left
        pick(sizes, starts.picks, Kept(outputs, observed), count, gauges[abi.ENERGY_START], results.values[:, i])

    return kernel

"""State of a run: new arrays, sizes and span for loops, and a copy to return to."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from symgen.compile.loopcode.padding import aligned, padded
from symgen.compile.native.annotations import Record
from symgen.run.layout import abi
from symgen.run.layout.model_arrays import marks_of_lengths
from symgen.run.layout.records import Outputs, Sizes, Span, State
from symgen.run.layout.scheme_records import KEPT

if TYPE_CHECKING:
    from symgen.run.layout.compiled import CompiledModel, ModelInfo
    from symgen.run.loops.integrator import Setup
    from symgen.run.loops.run_spec import RunSpec

Array = NDArray[np.float64]

#: Arrays of a state after those always copied: passages are few, and working memory is not kept.
_BEHIND = ("passages", "room")
#: Arrays of the state whose name in saved data is another one, which files have.
SAVED_AS = {"passages": "events"}


def span_of(spec: RunSpec, setup: Setup, until: float | None = None, pause: float = np.inf) -> Span:
    """Return the span of a loop, by default to the end of the run, with its steps."""
    end = spec.until if until is None else until
    duration = spec.until if spec.duration is None else spec.duration
    numbers = setup.step, spec.largest_step, end, spec.until, duration, spec.rtol, spec.atol, spec.relative
    return Span(*(float(number) for number in (*numbers, setup.safety, spec.max_attempts, pause, spec.largest_turn)))


def model_sizes(compiled: CompiledModel) -> Sizes:
    """Return the sizes of a model for loops."""
    info, sections = compiled.info, compiled.info.sections
    names = "pivot", "multipliers", "mask", "change", "gauge", "row_weight", "jacobian"
    places = (sections.get(name, (0, 0))[0] for name in names)
    lengths = (
        info.nq,
        info.nv,
        info.m,
        info.ny,
        padded(info.ny),
        max(1, info.ny - info.shadows - 1),
        compiled.law.unknowns,
    )
    auxiliary = sections.get("auxiliary", (abi.POWER, 1))[0]
    return Sizes._make((*lengths, *places, auxiliary, len(info.states)))


def share_of(sizes: Sizes, datum: Sequence[float] = ()) -> Array:
    """Return 1 for elements of a state under error control, else 0: the work is controlled separately.

    After them are the places that coordinates are measured from (`symgen.describe.facts.lengths.origin_of_sizes`).
    """
    share = np.zeros(2 * sizes.width)
    share[sizes.width : sizes.width + len(datum)] = datum
    share[: sizes.ny] = 1.0
    share[sizes.nq + sizes.nv] = 0.0
    return share


def metric_of(info: ModelInfo, sizes: Sizes) -> Array:
    """Return 1 for coordinates that are lengths, else 0; velocities: `symgen.run.layout.scales.settle_scales`."""
    metric = np.zeros(2 * sizes.width)
    metric[: sizes.nq] = marks_of_lengths(info)
    return metric


def new_outputs(info: ModelInfo, times: Array) -> Outputs:
    """Return room for the outputs of a run at some times [s]."""
    k, columns = len(times), abi.N_STATUS + info.kept
    return Outputs(np.ascontiguousarray(times, dtype=np.float64), np.empty((k, info.ny)), np.empty((k, columns)))


def new_state(compiled: CompiledModel, sizes: Sizes, memory: int, room: int, datum: Sequence[float] = ()) -> State:
    """Return the state of a run before its start.

    Parameters
    ----------
    compiled : CompiledModel
        Model and method.
    sizes : Sizes
        From `sizes_of`.
    memory, room : int
        As in `symgen.run.loops.integrator.Setup`.
    datum : sequence of float
        What coordinates are measured from; empty for the origin.
    """
    law, scales, own = compiled.law, np.zeros(2 * sizes.width), sizes.ny - compiled.info.shadows
    scales[sizes.nq + sizes.nv + 1 : own] = 1.0  # integrals of outputs have units of their own
    control, counters = np.zeros(abi.N_CONTROL, dtype=np.int64), np.zeros(abi.N_COUNTERS, dtype=np.int64)
    p = np.zeros(max(1, law.parameter_offset + len(law.parameters) + law.hoisted))
    share = share_of(sizes, datum)
    share[own : sizes.ny] = 0.0
    return State(
        *(np.zeros(sizes.width), p, np.zeros(max(1, law.nw)), counters, np.zeros(abi.N_CLOCK)),
        *(np.zeros(abi.N_GAUGES), control, np.zeros(abi.MAX_PASSAGES * abi.N_PASSAGE)),
        *(np.zeros(memory), share, metric_of(compiled.info, sizes), scales),
        np.zeros(sizes.width + room),
    )


def lengths_match(compiled: CompiledModel, memory: int, arrays: Mapping[str, NDArray[Any]]) -> bool:
    """Return whether the saved arrays of another run have the lengths of this version.

    Parameters
    ----------
    compiled : CompiledModel
        Model and method.
    memory : int
        As in `symgen.run.loops.integrator.Setup`.
    arrays : mapping of str to array
        Saved arrays by name. Data of events, and room for factors, may have any length.
    """
    own = new_state(compiled, model_sizes(compiled), memory, 0)._asdict()
    kept = {SAVED_AS.get(name, name): array for name, array in own.items() if name != "room"}
    return all(name in arrays and arrays[name].shape == array.shape for name, array in kept.items())


class Snapshot:
    """A state with contiguous arrays, and a copy of it at some time.

    Parameters
    ----------
    state : State
        Its arrays are copied; all hold numbers of eight bytes.

    Attributes
    ----------
    state : State
        The same numbers in one piece of memory.
    front : Array
        The part of this memory that is always copied.
    rows : int
        Count of numbers of the table of passages in the copy.
    first : Array or None
        The first copy of the last piece of the run, where events or pauses inside have made others since.
    """

    first: Array | None = None

    def __init__(self, state: State) -> None:
        arrays = state._asdict()
        names = [*(name for name in arrays if name not in _BEHIND), *_BEHIND]
        ends = np.cumsum([padded(len(arrays[name])) for name in names])
        block, views = aligned(int(ends[-1])), dict[str, Any]()
        for name, end in zip(names, ends, strict=True):
            first = end - padded(len(arrays[name]))
            views[name] = block[first : first + len(arrays[name])].view(arrays[name].dtype)
            views[name][:] = arrays[name]
        self.state = type(state)(**views)
        self.front = block[: ends[-len(_BEHIND) - 1]]
        self._passages = self.state.passages.copy()
        self.rows, self._memory = 0, dict[str, NDArray[Any]]()
        self._names: tuple[str, ...] | None = None

    @cached_property
    def copy(self) -> Array:
        """The copy; runs that nobody steps from Python need none."""
        return self.front.copy()

    def keep(self) -> None:
        """Keep the copy as the first one of a piece of the run."""
        if self.first is None:
            self.first = self.copy.copy()

    def take(self, scheme: Record) -> None:
        """Copy the state, and the memory in a scheme's record."""
        self.copy[:] = self.front
        self.rows = min(int(self.state.control[abi.PASSAGES]), abi.MAX_PASSAGES) * abi.N_PASSAGE
        self._passages[: self.rows] = self.state.passages[: self.rows]
        if self._names is None:
            self._names = memory_fields(scheme)
        for name in self._names:
            array, there = getattr(scheme, name), self._memory.get(name)
            if there is None or len(there) != len(array):
                self._memory[name] = array.copy()
            else:
                there[:] = array

    def put_back(self, scheme: Record) -> Any:
        """Restore the state from the copy, and return the scheme's record with its copied memory."""
        self.front[:] = self.copy
        self.state.passages[: self.rows] = self._passages[: self.rows]
        self.state.passages[self.rows :] = 0.0
        for name, array in self._memory.items():
            scheme = with_memory(scheme, name, array)
        return scheme


def memory_fields(scheme: Record) -> tuple[str, ...]:
    """Return the fields of a scheme's record that belong to the memory of a run."""
    return tuple(name for name in KEPT if hasattr(scheme, name))


def with_memory(scheme: Record, name: str, array: NDArray[Any]) -> Any:
    """Return a scheme's record with a saved array, copied into its memory if the shapes are equal."""
    there = getattr(scheme, name)
    if there.shape != array.shape:
        return scheme._replace(**{name: array.copy()})
    there[:] = array
    return scheme


def with_room(scheme: Record) -> Any:
    """Return a scheme's record with more room for the factors of the matrix that did not fit."""
    from symgen.run.loops.sparse import enlarge_pattern

    for plan, numbers in (("plan", "numbers"), ("filter_plan", "filter_numbers")):
        if hasattr(scheme, plan):
            changed = enlarge_pattern(getattr(scheme, plan), getattr(scheme, numbers))
            scheme = scheme._replace(**dict(zip((plan, numbers), changed, strict=True)))
    return scheme

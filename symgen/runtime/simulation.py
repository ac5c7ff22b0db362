"""A run as its arrays: what it keeps, how it is entered, left, saved and restored, and when other rows are chosen."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from symgen.ir.numerics import WARN
from symgen.runtime import abi
from symgen.runtime.blocks import padded
from symgen.runtime.exact import compiled_form
from symgen.runtime.model_arrays import entries_of, lengths_of

if TYPE_CHECKING:
    from symgen.runtime.assembly import Start
    from symgen.runtime.compiled import CompiledModel, ModelInfo
    from symgen.runtime.events import Events, Watched
    from symgen.runtime.integrator import Integrator, Setup
    from symgen.runtime.records import Outputs, Sizes, Span, State
    from symgen.runtime.run import RunSpec

Array = NDArray[np.float64]


class Simulation:
    """A run that can be left after any accepted step, saved, restored, and gone on with.

    Parameters
    ----------
    compiled : CompiledModel
        Model and method.
    integrator : Integrator
        The scheme and its loop.
    start : Start
        A consistent start; not changed.
    spec : RunSpec
        Steps, tolerances and limits.

    Attributes
    ----------
    state : State
        All that the run keeps, as arrays.
    events : Events or None
        What happens in it, where events are looked for.

    Notes
    -----
    Constant steps stand on a grid that begins at the start: pieces that end on it are one run, bit for bit. An end
    between two steps is reached by a shortened step, from which a new grid begins.
    """

    def __init__(self, compiled: CompiledModel, integrator: Integrator, start: Start, spec: RunSpec) -> None:
        self.compiled, self.integrator, self.spec = compiled, integrator, spec
        self.setup = integrator.setup(compiled, spec, start.w)
        self.sizes = sizes_of(compiled)
        self.scheme = self.setup.scheme
        self.events: Events | None = None
        self.state = new_state(compiled, self.sizes, self.setup.memory, self.setup.room)
        self.state.y[: len(start.y)], self.state.p[:], self.state.w[:] = start.y, start.p, start.w
        gauges = self.state.gauges
        gauges[[abi.LIMIT_PHI, abi.LIMIT_DRIFT]] = spec.max_violation, spec.velocity_limit
        gauges[[abi.LIMIT_ENERGY, abi.WARN_PIVOT]] = spec.max_energy_error, WARN
        gauges[[abi.SMALLEST_PIVOT, abi.LAST_SINE, abi.LAST_SHORT]] = 1.0
        if spec.events is not None:
            self._watch(spec.events)

    def _watch(self, watched: Watched) -> None:
        """Look for events."""
        from symgen.runtime.events import Events
        from symgen.runtime.hunting import with_events
        from symgen.runtime.searching import decide

        functions = *self.setup.functions[:-2], watched.function, decide
        self.setup = replace(self.setup, loop=with_events(self.setup.loop), functions=functions)
        self.state = self.state._replace(hunt=watched.new_hunt(self.sizes, len(self.state.w)))
        self.events = Events(self.compiled, watched, self.spec.until)

    def outputs(self, times: Array) -> Outputs:
        """Return room for outputs at `times`."""
        from symgen.runtime.records import Outputs

        k, given = len(times), np.ascontiguousarray(times, dtype=np.float64)
        kept = abi.N_STATUS + self.compiled.info.windings
        return Outputs(given, np.empty((k, self.sizes.ny)), np.empty((k, kept)))

    def enter(self, outputs: Outputs, until: float | None = None, pause: float = np.inf) -> int:
        """Go on; return how the loop ended, see `symgen.runtime.abi`.

        Parameters
        ----------
        outputs : Outputs
            From `outputs`; what is written already is left as it is.
        until : float, optional
            End [s]; that of the run unless given.
        pause : float
            The loop is left (`PAUSED`) when so many steps of the run have been accepted.

        Raises
        ------
        InputError
            If an event asks for velocities that the constraints do not allow.
        """
        span = span_of(self.spec, self.setup, until, pause)
        while True:
            code = int(self.setup.loop(*self.setup.functions, self.scheme, self.sizes, span, self.state, outputs))
            if self.events is not None:
                found = self.events.take(self.state)
                if code == abi.MET:
                    code = self.events.meet(self.state, found)
                    if code == abi.DONE:
                        continue
                elif code == abi.NOTED:
                    continue
            if code == abi.NO_ROOM:
                self.scheme = _with_room(self.scheme)
            elif code == abi.CHOOSE:
                self._choose_anew(self.state.w)  # what a scheme knows of its matrices depends on the rows
                self.scheme = self.integrator.setup(self.compiled, self.spec, self.state.w).scheme
            else:
                return code

    def warm(self, outputs: Outputs) -> None:
        """Compile everything by a run that is told to stop before its first step, so that clocks see loops alone."""
        kept = self.save()
        self.state.control[abi.STOP] = 1
        self.enter(type(outputs)(*(array[:0] for array in outputs)))
        self.restore(kept)

    def save(self) -> dict[str, NDArray[Any]]:
        """Return copies of all arrays that the run keeps, by name."""
        from symgen.runtime.records import KEPT

        found = {name: array for name, array in self.state._asdict().items() if name != "room"}
        found |= {name: getattr(self.scheme, name) for name in KEPT if hasattr(self.scheme, name)}
        return {name: array.copy() for name, array in found.items()}

    def restore(self, saved: Mapping[str, NDArray[Any]]) -> None:
        """Take up what `save` returned, for the same model, method, integrator, limits and events."""
        for name, array in saved.items():
            if hasattr(self.state, name):
                getattr(self.state, name)[:] = array
            else:
                self.scheme = self.scheme._replace(**{name: array.copy()})
        if self.events is not None:
            self.events.forget_after(float(self.state.clock[abi.TIME]))

    @cached_property
    def _choose_anew(self) -> Callable[[Array], bool]:
        return row_chooser(self.compiled)


def row_chooser(compiled: CompiledModel) -> Callable[[Array], bool]:
    """Return what chooses the rows that stand for all at the position of w and says whether they are others.

    Rows of mechanisms that are too large for it stay what they are.
    """
    from symgen.runtime.redundancy import LARGEST, choose_rows

    info = compiled.info
    if info.m * info.nv > LARGEST:
        return lambda w: False
    entries, constants = entries_of(info)
    places = tuple(info.sections[name][0] for name in ("jacobian", "gauge", "mask"))
    room, choose = np.zeros(info.m * (info.nv + 1)), compiled_form(choose_rows)

    def chosen(w: Array) -> bool:
        kept = info.m - int(np.count_nonzero(compiled.section(w, "mask")))
        return bool(choose(info.m, info.nv, kept, entries, constants, *places, w, room))

    return chosen


def span_of(spec: RunSpec, setup: Setup, until: float | None = None, pause: float = np.inf) -> Span:
    """Return how far a loop goes, to the end of the run unless given, and by which steps."""
    from symgen.runtime.records import Span

    end = spec.until if until is None else until
    numbers = setup.step, spec.largest_step, end, spec.until, spec.rtol, spec.atol, spec.relative
    return Span(*(float(number) for number in (*numbers, setup.safety, spec.max_steps, pause)))


def sizes_of(compiled: CompiledModel) -> Sizes:
    """Return what loops have to know of a model."""
    from symgen.runtime.records import Sizes

    info, sections = compiled.info, compiled.info.sections
    names = "pivot", "multipliers", "mask", "change", "gauge", "jacobian"
    pivots, multipliers, mask, change, gauge, jacobian = (sections.get(name, (0, 0))[0] for name in names)
    lengths = info.nq, info.nv, info.m, info.ny, padded(info.ny), info.nq + info.nv, compiled.law.unknowns
    return Sizes(*lengths, pivots, multipliers, mask, change, gauge, jacobian, abi.POWER)


def share_of(sizes: Sizes) -> Array:
    """Return 1 for elements of a state that take part in error control, else 0."""
    share = np.zeros(sizes.width)
    share[: sizes.nq + sizes.nv] = 1.0
    return share


def metric_of(info: ModelInfo, sizes: Sizes) -> Array:
    """Return 1 for coordinates that are lengths, else 0; see `symgen.runtime.scales.settle` for the velocities."""
    metric = np.zeros(sizes.width)
    metric[: sizes.nq] = lengths_of(info)
    return metric


def new_state(compiled: CompiledModel, sizes: Sizes, memory: int, room: int) -> State:
    """Return what a run keeps, before it has a start.

    Parameters
    ----------
    compiled : CompiledModel
        Model and method.
    sizes : Sizes
        From `sizes_of`.
    memory, room : int
        As in `symgen.runtime.integrator.Setup`.
    """
    from symgen.runtime.records import State

    law = compiled.law
    control, counters = np.zeros(abi.N_CONTROL, dtype=np.int64), np.zeros(abi.N_COUNTERS, dtype=np.int64)
    p = np.zeros(max(1, law.parameter_offset + len(law.parameters) + law.hoisted))
    return State(
        *(np.zeros(sizes.width), p, np.zeros(max(1, law.nw)), counters, np.zeros(abi.N_CLOCK)),
        *(np.zeros(abi.N_GAUGES), control, np.zeros(abi.MAX_EVENTS * abi.N_EVENT)),
        *(np.zeros(memory), share_of(sizes), metric_of(compiled.info, sizes), np.zeros(sizes.width)),
        *(np.zeros(0), np.zeros(sizes.width + room)),
    )


def _with_room(scheme: Any) -> Any:
    """Return a scheme's record with more room for the factors of the matrix that did not fit."""
    from symgen.runtime.sparse import enlarged

    for plan, numbers in (("plan", "numbers"), ("filter_plan", "filter_numbers")):
        if hasattr(scheme, plan):
            changed = enlarged(getattr(scheme, plan), getattr(scheme, numbers))
            scheme = scheme._replace(**dict(zip((plan, numbers), changed, strict=True)))
    return scheme

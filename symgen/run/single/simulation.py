"""A run as its arrays: its state, how it is entered, left, saved and restored, and when other rows are chosen."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from symgen.base.errors import InputError
from symgen.base.ir.numerics import WARN
from symgen.run.layout import abi
from symgen.run.layout.probe import rate_functions
from symgen.run.loops.frame_parts import store_after_reset
from symgen.run.loops.watch import iterations_in
from symgen.run.single.changes import Changes
from symgen.run.single.events import event_state
from symgen.run.single.new_state import (
    SAVED_AS,
    Snapshot,
    memory_fields,
    model_sizes,
    new_outputs,
    new_state,
    span_of,
    with_memory,
    with_room,
)
from symgen.run.starts.assembler import row_chooser

if TYPE_CHECKING:
    from symgen.compile.loopcode.entry import LoopEntry
    from symgen.run.layout.compiled import CompiledModel
    from symgen.run.layout.records import Outputs
    from symgen.run.loops.integrator import Integrator
    from symgen.run.loops.run_spec import RunSpec, Seam, Watched
    from symgen.run.single.events import Events, Happening
    from symgen.run.single.turn_of_run import TurnOfRun
    from symgen.run.starts.assembly import Start

Array = NDArray[np.float64]

#: Saved arrays in addition to the state of a run: the output at its end, which may differ in the last bit from the
#: state that a multistep scheme continues with.
SHOWN = ("shown_state", "shown_status")


class Simulation:
    """A run that can be left after any accepted step, saved, restored, and continued.

    Parameters
    ----------
    compiled : CompiledModel
        Model and method.
    integrator : Integrator
        The scheme and its loop.
    start : Start
        A consistent start, from `symgen.run.starts.assembly.assemble`; not changed.
    spec : RunSpec
        Steps, tolerances and limits.

    Attributes
    ----------
    compiled, integrator, start, spec
        As above.
    state : State
        The state of the run, as arrays. They are never moved: views of them stay valid.
    span : Span
        End, steps and tolerances of the run.
    direct : bool
        Whether `go_until` may take the shortest way, with the same results to the bit.
    snapshot : Snapshot
        The memory of `state`, and a copy of it from the last call of `go_until`.
    before : Array of int
        Counts at the point where the run was continued: zeros for a new run.
    events : Events or None
        Events of the run, where they are looked for.
    turn : TurnOfRun or None
        What happens at events and where inputs change, where events change the run or rows have bounds.
    changes : Changes
        Changes of parameters during the run.
    halt : InputError or None
        What has ended the run where an event or a change asked for what cannot be (`HALTED`).

    Notes
    -----
    Constant steps lie on a grid that begins at the start: pieces that end on it equal one run, bit for bit. An end
    between two steps is reached by a shortened step, at which a new grid begins.
    """

    def __init__(self, compiled: CompiledModel, integrator: Integrator, start: Start, spec: RunSpec) -> None:
        self.compiled, self.integrator, self.start, self.spec = compiled, integrator, start, spec
        self.setup = integrator.setup(compiled, spec, start.w)
        self.sizes = model_sizes(compiled)
        self.scheme, self.span = self.setup.scheme, span_of(spec, self.setup)
        self.direct = True
        self.halt: InputError | None = None
        state: Any = new_state(compiled, self.sizes, self.setup.memory, self.setup.room, start.datum)
        self.events: Events | None = None
        self.turn: TurnOfRun | None = None
        if spec.events is not None:
            state = event_state(spec.events, self.sizes, state)
            self._watch(spec.events)
        self.snapshot = Snapshot(state)
        self.state = self.snapshot.state
        self._model: tuple[Any, ...] = self.sizes, *self.setup.functions
        self._prepared: tuple[Outputs, LoopEntry] | None = None
        self._whole = self._model, self.setup.loop
        self._seams: tuple[Seam, ...] = ()
        self._counts, self._clock = self.state.control.data, self.state.clock.data
        self.state.y[: len(start.y)], self.state.p[:], self.state.w[:] = start.y, start.p, start.w
        self.state.gauges[[abi.SMALLEST_PIVOT, abi.LAST_SINE, abi.LAST_SHORT]] = 1.0
        self.state.clock[[abi.TIME, abi.ORIGIN]] = self.state.gauges[abi.LAST_TIME] = start.t
        self.before, self.iterations_before = np.zeros(abi.N_CONTROL, dtype=np.int64), 0
        self.changes = Changes(self)
        self.set_limits()
        if start.saved is not None:
            self._take_up(start.saved, start.p)
        else:
            self.divide(spec)
        self.changes.keep_first()

    def set_limits(self) -> None:
        """Set the limits of this run, also after the state of another one was restored."""
        gauges, spec = self.state.gauges, self.spec
        gauges[[abi.LIMIT_PHI, abi.LIMIT_DRIFT]] = spec.max_violation, spec.velocity_limit
        gauges[[abi.LIMIT_ENERGY, abi.WARN_PIVOT]] = spec.max_energy_error, WARN

    def _watch(self, watched: Watched) -> None:
        """Look for events."""
        from symgen.run.loops.event_loop import loop_with_events
        from symgen.run.loops.searching import search_of
        from symgen.run.single.events import Events

        rates, _ = rate_functions(self.compiled.law_module)
        search = search_of(watched.bounded is not None)
        functions = *self.setup.functions, watched.function, search, rates
        self.setup = replace(self.setup, loop=loop_with_events(self.setup.loop), functions=functions)
        self.events = Events(self.compiled, watched, self.spec.until)
        if watched.bounded is not None or watched.effects is not None:
            from symgen.run.single.turn_of_run import TurnOfRun

            self.turn = self.events.turn = TurnOfRun(self, watched)

    def outputs(self, times: Array) -> Outputs:
        """Return room for outputs at `times`."""
        return new_outputs(self.compiled.info, times)

    def _take_up(self, saved: Mapping[str, NDArray[Any]], p: Array) -> None:
        """Continue from the state of another run, with the limits, outputs and inputs of this one."""
        info = self.compiled.info
        state: Any = self.state  # an `EventState` where there are events
        # older files hold further, empty arrays
        names = {*(SAVED_AS.get(name, name) for name in state._fields), *memory_fields(self.scheme)}
        arrays = {name: array for name, array in saved.items() if name in names}
        # other events, or data of another version: their sides are determined again
        anew = self.events is not None and len(arrays.get("hunt", ())) != len(state.hunt)
        if anew:
            arrays.pop("hunt", None)
        self.restore(arrays)
        varying = {name for seam in self.spec.seams for name in seam.values}
        numbers = {q.name: float(x) for q, x in zip(info.parameters, p, strict=False) if q.name in info.inputs}
        self.changes.give_values({name: x for name, x in numbers.items() if name not in varying})
        if anew:
            state.control[abi.BEGUN] = abi.AFRESH
        self._shown = tuple(saved[name] for name in SHOWN)
        self.set_limits()
        state.control[[abi.STOP, abi.OUTPUTS]] = 0
        self.before, self.iterations_before = state.control.copy(), iterations_in(state)

    def store_first(self, outputs: Outputs) -> None:
        """Write the outputs up to the time of a continued run: the loop writes those after it."""
        tiny = 0.0 if self.spec.adaptive else abi.SAME_TIME * self.setup.step
        control, out = self.state.control, 0
        while out < len(outputs.times) and outputs.times[out] <= self.state.clock[abi.TIME] + tiny:
            outputs.states[out], outputs.status[out] = self._shown
            out += 1
        control[abi.OUTPUTS] = out

    def enter(
        self, outputs: Outputs, until: float | None = None, pause: float = np.inf, most: float | None = None
    ) -> int:
        """Continue; return the end code of the loop, see `symgen.run.layout.abi`.

        Parameters
        ----------
        outputs : Outputs
            From `outputs`; values already written are left unchanged.
        until : float, optional
            End [s]; by default the end of the run.
        pause : float
            Number of accepted steps of the run at which the loop is left (`PAUSED`).
        most : float, optional
            Limit of attempts at an adaptive step until then; by default the run's limit.

        Raises
        ------
        InputError
            If an event sets velocities that the constraints do not allow.
        """
        until, most = self.spec.until if until is None else until, self.span.most if most is None else most
        self._begin_modes()
        entry = self._prepared[1] if self._prepared is not None and self._prepared[0] is outputs else None
        while True:
            if entry is None:
                span = self.span._replace(until=float(until), pause=float(pause), most=float(most))
                arguments = self._model, self.scheme, span, self.state, outputs
                code = int(self.setup.loop(*arguments))
            else:
                if not entry.has(self.scheme, self.span):
                    entry.take(self.scheme, self.span)
                code = entry(float(until), float(pause), float(most))
            ended = self._note_end(code, until)
            if code == abi.MET:
                now, count = self._clock[abi.TIME], self._counts[abi.OUTPUTS]
                store_after_reset(outputs, count, now, self.same(now), self.state.y, self.state.w)
            if ended is not None:
                return ended

    def run(self, outputs: Outputs, stop: Callable[[], bool], steps: float) -> int:
        """Run to the end as `enter` does; call `stop` after every `steps` steps, to end as `STOPPED`."""
        while (code := self.enter(outputs, pause=self.state.control[abi.STEPS] + steps)) == abi.PAUSED:
            if stop():
                return abi.STOPPED
        return code

    def is_ahead(self, moment: float) -> bool:
        """Whether a time is far enough from the present one for a step between them."""
        return moment - self._clock[abi.TIME] > self.same(moment)

    def same(self, moment: float) -> float:
        """Return the difference up to which times near a time count as the same [s]."""
        if self.spec.adaptive:
            return abi.RESOLVED_TIME * max(abs(moment), abs(self._clock[abi.TIME]))
        return abi.SAME_TIME * self.span.step

    def divide(self, spec: RunSpec) -> None:
        """Take the seams of `spec`, with the values of all seams passed."""
        if spec.seams is not self._seams:
            self._seam_at(spec.seams)
        self.spec, now, control = spec, self._clock[abi.TIME], self.state.control
        passed = [seam for seam in spec.seams if not self.is_ahead(seam.t)]
        control[abi.PASSED] = len(passed)
        if len(passed) > 1 and passed[-2].skips:  # the run is at a jump: it goes on after it
            self.state.clock[abi.TIME] = max(now, passed[-1].t)
        self.changes.give_values({name: value for seam in passed for name, value in seam.values.items()})
        # a kink changes no number, but the history of multistep schemes ends there as well
        if passed and now - passed[-1].t <= self.same(now) and control[abi.BEGUN] == 1:
            control[abi.BEGUN] = abi.AFRESH

    def _seam_at(self, seams: tuple[Seam, ...]) -> None:
        """Select the loop from seam to seam if any seams exist."""
        self._seams, (self._model, loop) = seams, self._whole
        if seams:
            from symgen.run.loops.seams import arguments_with_table, loop_with_seams

            self._model = arguments_with_table(self.compiled, self._model, loop, self.spec.adaptive, (seams,))
            loop = loop_with_seams(loop)
        self.setup, self._prepared = replace(self.setup, loop=loop), None
        self.__dict__.pop("_entry", None)

    def go_until(self, until: float, pause: float, most: float | None = None, further: bool = False) -> int:
        """Continue as `enter` does, without outputs and by the shortest way, so that a step from Python is cheap.

        The state before is saved, see `go_back`; `further` goes on with a piece of the run that was left at a pause.
        """
        self._begin_modes()
        entry, snapshot = self._entry, self.snapshot
        if further:
            snapshot.keep()
        else:
            snapshot.first = None
        if entry is None or not self.direct:
            snapshot.take(self.scheme)
            return self.enter(self._nothing, until, pause, most)
        if not self._copied or self._counts[abi.PASSAGES] > 0:
            snapshot.take(self.scheme)
        else:
            snapshot.rows = 0
        most = self.span.most if most is None else most
        while True:
            if not entry.has(self.scheme, self.span):
                entry.take(self.scheme, self.span)
            if (code := entry(until, pause, most)) >= 0 and self.events is None:
                return code
            if (ended := self._note_end(code, until)) is not None:
                return ended
            snapshot.keep()  # the entry copies the state anew

    def go_back(self) -> None:
        """Restore the state saved when `go_until` was last called, or entered its loop after an event."""
        self.scheme = self.snapshot.put_back(self.scheme)
        if self.events is not None:
            self.events.forget_after(self._clock[abi.TIME])

    def _note_end(self, code: int, until: float) -> int | None:
        """Serve the request of a loop; return its end code, None where it has to be entered again."""
        if self.events is not None:
            state: Any = self.state  # an `EventState` where there are events
            events = self.events.take(state)
            if code == abi.MET:
                code = self._meet(events)
                return None if code == abi.DONE else code
        if code == abi.NO_ROOM:
            self.scheme = with_room(self.scheme)
        elif code == abi.CHOOSE:
            self._choose_anew(self.state.w)  # the matrices of a scheme depend on the rows
            self.scheme = self.integrator.setup(self.compiled, self.spec, self.state.w).scheme
        elif code == abi.CHANGED:
            if not self._go_on_changed():
                return abi.UNPREPARED
            return None if self.is_ahead(until) else abi.DONE
        elif code != abi.NOTED:
            if code in (abi.TINY_STEP, abi.NOT_FINITE) and self.turn is not None:
                self.turn.explain_end(code)
            return code
        return None

    def _begin_modes(self) -> None:
        """Choose modes where the run begins, or something has changed."""
        if self.turn is not None:
            self.turn.begin()

    def _meet(self, events: Sequence[tuple[int, Happening]]) -> int:
        """Serve the events at which a loop ended; return `DONE` if it may be entered again."""
        assert self.events is not None, "events were met"
        state: Any = self.state
        return self.events.meet(state, events)

    def _go_on_changed(self) -> bool:
        """Prepare parameters that have changed at a seam, and choose modes; return whether all are defined."""
        if not self.changes.are_defined():
            return False
        if self.turn is not None:
            self.turn.begin(self.spec.seams[self.state.control[abi.PASSED] - 2].strikes)
        return True

    @cached_property
    def _nothing(self) -> Outputs:
        return self.outputs(np.zeros(0))

    @cached_property
    def _entry(self) -> LoopEntry | None:
        from symgen.compile.loopcode.entry import loop_entry

        entry = loop_entry(self.setup.loop, (self._model, self.scheme, self.span, self.state, self._nothing))
        if entry is not None and self._copied:
            entry.copy_before(self.snapshot.copy, self.snapshot.front)
        return entry

    @cached_property
    def _copied(self) -> bool:
        """Whether all saved data but passages are in one block of memory."""
        return not memory_fields(self.scheme)

    def compile_all(self, outputs: Outputs) -> None:
        """Compile everything, so that only loops are timed.

        A loop that cannot be entered by its address is run with the stop flag set before its first step.
        """
        from symgen.compile.loopcode.entry import loop_entry

        arguments = self._model, self.scheme, self.span, self.state, outputs
        if (entry := loop_entry(self.setup.loop, arguments)) is not None:
            self._prepared = outputs, entry
            return
        saved = self.save()
        self.state.control[abi.STOP] = 1
        self.enter(type(outputs)(*(array[:0] for array in outputs)))
        self.restore(saved)

    def save(self) -> dict[str, NDArray[Any]]:
        """Return copies of all arrays of the run's state, by name."""
        arrays = {name: array for name, array in self.state._asdict().items() if name != "room"}
        arrays |= {name: getattr(self.scheme, name) for name in memory_fields(self.scheme)}
        return {SAVED_AS.get(name, name): array.copy() for name, array in arrays.items()}

    def restore(self, saved: Mapping[str, NDArray[Any]], spec: RunSpec | None = None) -> None:
        """Restore the result of `save`, for the same model, method, integrator, limits and events, with other seams."""
        own = {kept: name for name, kept in SAVED_AS.items()}
        for name, array in saved.items():
            if hasattr(self.state, own.get(name, name)):
                getattr(self.state, own.get(name, name))[:] = array
            else:
                self.scheme = with_memory(self.scheme, name, array)
        if self.events is not None:
            self.events.forget_after(self._clock[abi.TIME])
        self.divide(self.spec if spec is None else spec)

    @cached_property
    def _choose_anew(self) -> Callable[[Array], bool]:
        return row_chooser(self.compiled)

"""A run that goes on step by step: entered, left, saved, restored and changed from Python."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

from symgen.base import arguments
from symgen.base.errors import InputError, SimulationError
from symgen.describe.formulas.evaluate import parameter_values
from symgen.describe.parts.driven_mechanism import inputs_of_gaps
from symgen.result.stepping.controllers import Controller, Controllers
from symgen.result.stepping.saved_state import Saved, identity_of_run
from symgen.result.stepping.seams_ahead import SeamsAhead
from symgen.result.stepping.step_readings import StepReadings
from symgen.run.breaks.refused_motions import refuse_jumps
from symgen.run.layout import abi
from symgen.run.single.changes import begin_with_step
from symgen.run.single.events import EventRecord

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from symgen.result.result import Result
    from symgen.result.stepping.horizon import Horizon, Inputs
    from symgen.run.loops.run_spec import RunSpec
    from symgen.run.planning.prepare import Prepared

# looked up at every step
_TIME, _STEPS, _DONE = abi.TIME, abi.STEPS, abi.DONE


class SteppedRun(StepReadings):
    """A simulation that is advanced step by step; `Model.start` makes it.

    The division of a run into pieces does not change it: with constant steps bit for bit, as long as pieces end on the
    grid of steps. A piece that ends between two grid points ends with a shortened step, and a new grid begins there.
    Adaptive steps are shortened so that every piece ends at its time exactly.

    Parameters
    ----------
    prepared : Prepared
        The run. With constant steps and no ``step`` among its settings, each call of `step` is one step.
    begin : callable, optional
        Start -> the same run from there; see `reset`.

    Attributes
    ----------
    q, v, state : Named
        Present coordinates, velocities, and both: read-only views without copies. In joint coordinates those of the
        joints of the tree.
    states : Named
        The same of the states that the file defines.
    warnings, notes : tuple of str
        Of the start and the settings.
    """

    def __init__(self, prepared: Prepared, begin: Callable[[object], Prepared] | None = None) -> None:
        plan, mechanism = prepared.plan, prepared.mechanism
        adaptive, inputs = plan.spec.adaptive, plan.inputs.words
        free, hidden = plan.settings.step is None and not adaptive, set(mechanism.inputs).difference(inputs)
        super().__init__(prepared, free, hidden)
        self._mechanism, self._plan, self._prepare, self._adaptive = mechanism, plan, begin, adaptive
        self._changed = dict(plan.parameters)
        self._loop.span = self._loop.span._replace(end=math.inf)  # `until` is none
        self._controllers = Controllers()
        self._seams = SeamsAhead(plan, self._loop, free)
        self._input_formulas = {name: words for name, words in inputs.items() if isinstance(words, str)}
        self._inputs = {name: x for name, x in inputs.items() if not isinstance(x, str)}
        places = {q.name: i for i, q in enumerate(self._compiled.info.parameters)}
        self._varying = [places[name] for name in mechanism.inputs if name not in self._inputs]  # by formulas and data
        if free and self._seams.foreseen:  # steps have no grid
            self._loop.divide(self._seams.divide_at_seams(parameter_values(mechanism, plan.parameters)))
        self.warnings, self.notes = (*plan.all_warnings, *prepared.start.warnings), prepared.start.notes
        self._identity = identity_of_run(mechanism, plan, self._compiled)
        self._first = self.save()
        self._first_origin, self._first_spec, self._first_jumps = self._origin, self._loop.spec, self._seams.jumps
        if not self._free:
            self._advance.begin()
        self._history.note_state()

    def result(self) -> Result:
        """Return the run since the start as a result, with an output at the end of each piece.

        Pieces are calls of `step` and `run`, and times between the calls of controllers. Of more than about 4000
        outputs every second is kept, then every fourth, and so on, and always the present state.
        """
        self._ready("result")
        self._advance.begin()
        result = self._history.result(self._prepared)
        _ = result.last_state  # of now: the run goes on
        return result

    def __repr__(self) -> str:
        law, integrator = self._compiled.law.method, self._plan.integrator.name
        return f"SteppedRun({self._mechanism.name}, {law}, {integrator}, t={self.t:.6g} s)"

    # -- going on ------------------------------------------------------------------------------------------------------

    def step(self, dt: float, u: Mapping[str, float] | None = None) -> EventRecord | None:
        """Go on for a time, or to an event that ends runs.

        Parameters
        ----------
        dt : float
            Duration [s]: a multiple of a constant step goes on along its grid, anything else ends with a shortened
            step, from which a new grid begins. Without a setting ``step``, this is the step.
        u : mapping of str to float, optional
            Values to set before, as `set` does; they hold until others are set.

        Returns
        -------
        EventRecord or None
            The event of kind ``stop`` at which the run is now, before the duration is over; else None. The next
            call goes on from there.

        Raises
        ------
        InputError
            If an argument is wrong, or an event sets velocities that are impossible.
        StepError
            If a step fails; the run stays at the last accepted state.
        """
        if type(dt) is not float or not 0.0 < dt < math.inf:  # the complete check is slower
            dt = arguments.number("dt", dt, positive=True)
        if self._controllers.calling or self._advance.unsure:
            self._ready("step")
        if u is not None:
            self.set(u)
        if self._free:
            self._advance.take_steps_of(dt)
        if self._seams.foreseen and self._clock[_TIME] + dt > self._seams.horizon:
            self._look_ahead(self._clock[_TIME] + dt)
        if self._controllers.clocks or self._seams.jumps:
            return self._go(self._clock[_TIME] + dt)
        event = self._advance.to(self._clock[_TIME] + dt)
        self._history.note_state()
        return event

    def run(self, until: float) -> EventRecord | None:
        """Go on to a time, or to an event that ends runs.

        Parameters
        ----------
        until : float
            Time to reach [s]. Without a setting ``step``, steps are those of the mechanism.

        Returns
        -------
        EventRecord or None
            As `step`.

        Raises
        ------
        InputError
            If that time has passed, or an event sets velocities that are impossible.
        StepError, KeyboardInterrupt
            If a step fails, or after Ctrl-C; the run stays at the last accepted state and can go on.
        """
        until = arguments.number("until", until)
        self._ready("run")
        if until < self.t - max(self._loop.same(until), abi.RESOLVED_TIME * abs(until)):
            raise InputError("until", f"a time from {self.t:g} s on, where the run stands", f"{until:g}")
        if self._free:
            self._advance.take_steps_of(self._plan.spec.step or 0.0)
        if self._seams.foreseen and until > self._seams.horizon:
            self._look_ahead(until)
        return self._go(until)

    def horizon(self, inputs: Inputs, dt: float) -> Horizon:
        """Return the states of steps ahead of the present state with the derivatives of each; the run stays there.

        Parameters
        ----------
        inputs : array_like, shape (N, m), or mapping of str to sequence
            Values that hold in each of N steps: of all inputs, in the order of the file, or by name, where others stay.
        dt : float
            Length of each step, as `step` takes it [s].

        Returns
        -------
        Horizon
            ``x``, ``A``, ``B`` and ``C``, step by step.

        Raises
        ------
        InputError
            If an argument is wrong, or steps have no derivatives; see `derivatives`.
        StepError
            If a step fails.
        """
        from symgen.result.stepping.horizon import run_over_horizon

        self._advance.recover()
        return run_over_horizon(self, self._directions or self._make_directions(), inputs, dt)

    @property
    def is_controlled(self) -> bool:
        """Whether functions are called as the run goes on."""
        return bool(self._controllers.clocks)

    def every(self, interval: float, controller: Controller) -> None:
        """Call a function at t0 + k `interval`, k = 0, 1, 2, ..., t0 being the present time.

        The call precedes the step from that time: it comes at the beginning of a piece, not at the end of the one
        before. Runs with constant steps meet times that are no multiples of the step by shortened steps.

        Parameters
        ----------
        interval : float
            Time between two calls [s].
        controller : callable
            Takes the time of the call, one multiplication from t0, and this run. It returns values by name or None;
            they are set as by `set` and hold until the next call.
        """
        self._controllers.add(controller, self.t, interval)

    # -- changing ------------------------------------------------------------------------------------------------------

    def set(self, values: Mapping[str, float] | None = None, /, **more: float) -> None:
        """Change parameters from the present time on.

        Positions and velocities stay as they are. The energy that a change adds counts as work. Parameters of forces,
        masses and inertias may change; one that moves a joint, such as a length, is refused.

        Parameters
        ----------
        values : mapping of str to float, optional
            Values by name.
        **more
            The same as keywords.

        Raises
        ------
        InputError
            If a name or a value is wrong, a mass is not above 0, or the state does not satisfy the constraints with
            these parameters. Nothing is changed then.
        """
        changes = {**arguments.mapping("set", values, "numbers by the names of parameters"), **more}
        self._version += 1
        if changes.keys() <= self._inputs.keys():
            self._set_inputs(changes)
            return
        for name in changes:
            if name in self._input_formulas:
                raise InputError(
                    f"set: '{name}'", "an input that is a number in this run", f"'{self._input_formulas[name]}'"
                )
        changed = {**self._changed, **changes}
        parameters = parameter_values(self._mechanism, changed)
        self._advance.recover()
        loop, count = self._loop, len(parameters)
        p = self._compiled.parameter_array(parameters, self._plan.method_parameters)
        p[self._varying] = loop.state.p[self._varying]
        if not np.array_equal(p[:count], loop.state.p[:count]):
            refuse_jumps(self._plan.mechanism, changed, loop.spec.until)
            spec = self._seams.divide_at_seams(parameters)
            if self._tree is not None:
                self._tree.refuse_moves(self.t, loop.state, p[:count])
            self._advance.begin()
            loop.changes.set(p[:count])
            loop.divide(spec)
        self._changed = {name: parameters[name] for name in changed}

    def _set_inputs(self, values: Mapping[str, float]) -> None:
        """Change inputs, which needs no check of the state."""
        numbers = {
            name: value if type(value) is float and math.isfinite(value) else arguments.number(f"input '{name}'", value)
            for name, value in values.items()
        }
        of_gaps = inputs_of_gaps(self._mechanism)
        if held := sorted(numbers.keys() & of_gaps):
            raise InputError(
                f"set: '{held[0]}'", f"an input that moves no {of_gaps[held[0]]}", f"'{held[0]}', which a gap reads"
            )
        self._advance.recover()
        loop = self._loop
        if self._adaptive:
            self._advance.begin()
        if loop.changes.give_values(numbers) and self._adaptive and (code := begin_with_step(loop)) != _DONE:
            self._advance.fail(code)
        self._changed |= numbers

    # -- keeping -------------------------------------------------------------------------------------------------------

    def save(self) -> Saved:
        """Return the whole state of the run, as a value that can be pickled."""
        self._advance.recover()
        events, beats = self._loop.events, self._controllers.beats
        happened = () if events is None else tuple(events.happened)
        return Saved(self._identity, self._loop.save(), self._loop.span.step, dict(self._changed), beats, happened)

    def restore(self, saved: Saved) -> None:
        """Take up what `save` returned, here or in another run of the same model, method and integrator.

        Limits and tolerances stay those of this run. Controllers are functions and are not saved: register the same
        ones before, and they go on at their next beats.

        Raises
        ------
        InputError
            If it belongs to something else. Nothing is changed then.
        """
        arguments.instance("restore", saved, Saved, "what `save` returned")
        self._ready("restore")
        saved.check(self._identity, self._loop.save(), self._controllers.intervals)
        self._take_up(
            saved, saved.arrays, self._seams.divide_at_seams(parameter_values(self._mechanism, saved.parameters))
        )
        self._controllers.take_up(saved.clocks)
        self._history.forget_after(saved.t)

    def _take_up(self, saved: Saved, arrays: Mapping[str, NDArray[Any]], spec: RunSpec) -> None:
        """Restore all but the controllers, with other arrays and a specification for the parameters there."""
        loop = self._loop
        loop.restore(arrays, spec)
        loop.set_limits()
        loop.state.control[[abi.STOP, abi.OUTPUTS]] = 0
        if self._free:
            loop.span = loop.span._replace(step=saved.step)
        elif saved.step != loop.span.step and not self._adaptive:
            self._advance.begin_grid()
        if loop.events is not None:
            loop.events.happened = list(saved.happened)
        self._changed = dict(saved.parameters)
        self._version += 1

    def reset(self, start: Mapping[str, float] | Result | None = None) -> None:
        """Begin anew, with the parameters and inputs that the run began with; controllers begin at their first beats.

        Parameters
        ----------
        start : mapping or Result, optional
            Another start, as `Model.start` takes it; by default that of this run.

        Raises
        ------
        InputError
            If a name or a value is wrong.
        AssemblyError
            If the mechanism cannot be closed there.
        """
        self._ready("reset")
        first = self._first
        arrays, origin = (first.arrays, self._first_origin) if start is None else self._arrays_at(start)
        self._take_up(first, arrays, self._first_spec)
        self._origin, self._seams.jumps, self._seams.horizon = origin, self._first_jumps, self._first_spec.until
        self._controllers.begin_at(first.t)
        self._history.clear()
        if not self._free:
            self._advance.begin()
        self._history.note_state()

    def _arrays_at(
        self, start: Mapping[str, float] | Result
    ) -> tuple[dict[str, NDArray[Any]], Mapping[str, float] | Prepared]:
        """Return the arrays of the first state from another start, and that start, or the run prepared there."""
        if self._prepare is None:
            raise InputError("reset", "no start, for a run without its model", arguments.kind_of_value(start))
        if isinstance(start, Mapping) and (now := self._restarts.state(start)) is not None:
            arrays = self._first.arrays  # beside these, the first state depends on no start
            y = arrays["y"].copy()
            y[: len(now.y)] = now.y
            return {**arrays, "y": y, "w": now.w}, dict(start)
        prepared = self._prepare(start)
        if prepared.compiled.law.key != self._compiled.law.key:  # bodies that are light there alone
            got = f"one that is run with {prepared.compiled.law.key}"
            raise InputError("reset", f"a start that is run with {self._compiled.law.key}", got)
        return prepared.simulation().save(), prepared

    # -- inside --------------------------------------------------------------------------------------------------------

    def _look_ahead(self, until: float) -> None:
        """Find the discontinuities of formulas up to a time [s] and beyond."""
        self._seams.horizon = 2.0 * until
        self._loop.divide(self._seams.divide_at_seams(parameter_values(self._mechanism, self._changed)))

    def _ready(self, what: str) -> None:
        """Refuse a call from inside a controller, and have an accepted state."""
        if self._controllers.calling:
            raise SimulationError(f"a controller cannot call `{what}`: it is called while the run goes on")
        self._advance.recover()

    def _go(self, until: float) -> EventRecord | None:
        """Go on to a time, with the controllers called and the jumps of inputs made on the way."""
        loop, event = self._loop, None
        if self._seams.jumps and until - loop.spec.until > loop.same(until):
            where = f"a time up to the setting until = {loop.spec.until:g} s: jumps of inputs are known up to there"
            raise InputError("until", where, f"{until:g}")
        while event is None and loop.is_ahead(until):
            now = self.t
            self._advance.begin()
            self._controllers.call(self, now, 0.0 if self._adaptive else loop.same(now))
            event = self._advance.to(self._controllers.due_before(until))
            self._history.note_state()
        return event

"""A run that goes on step by step: entered, left, saved, restored and changed from Python."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from symgen import arguments
from symgen.describe.digest import digest
from symgen.describe.evaluate import parameter_values
from symgen.describe.events import in_words
from symgen.errors import InputError, SimulationError
from symgen.runtime import abi
from symgen.runtime.changes import begin_with_step
from symgen.runtime.events import EventRecord, record_of
from symgen.runtime.motions import refuse_jumps
from symgen.runtime.stops import Foreseen, foreseen, merged, stops_of
from symgen.stepping.advance import Advance, Clock, Controller
from symgen.stepping.history import History
from symgen.stepping.named import Named
from symgen.stepping.saved_state import Saved
from symgen.version import __version__

if TYPE_CHECKING:
    from symgen.result.result import Result
    from symgen.running.prepare import Prepared
    from symgen.runtime.run import RunSpec
    from symgen.vocabulary.quantities import Quantity

# looked up at every step
_TIME, _STEPS, _DONE = abi.TIME, abi.STEPS, abi.DONE


class SteppedRun:
    """A run that goes on as far as it is told; `Model.start` makes it.

    Any division into pieces is the same run: with constant steps bit for bit, as long as pieces end on the grid of
    steps. A piece that ends between two of them ends with a shortened step, and a new grid begins there. Adaptive
    steps are shortened so that every piece ends exactly where it is to.

    Parameters
    ----------
    prepared : Prepared
        The run. Where it has constant steps and its settings no ``step``, each call of `step` is one step.
    begin : callable, optional
        Start -> the same run from there; see `reset`.

    Attributes
    ----------
    q, v, state : Named
        Coordinates, velocities, and both: read-only views of what the run holds at present, without copies. In joint
        coordinates those of the joints of the tree.
    states : Named
        The same of the states of the file's own.
    warnings, notes : tuple of str
        What there is to say of the start and the settings.
    """

    def __init__(self, prepared: Prepared, begin: Callable[[object], Prepared] | None = None) -> None:
        plan, compiled, start, mechanism = prepared.plan, prepared.compiled, prepared.start, prepared.mechanism
        info = compiled.info
        self._mechanism, self._plan, self._compiled, self._prepared, self._prepare = (
            mechanism,
            plan,
            compiled,
            prepared,
            begin,
        )
        self._changed, self._adaptive = dict(plan.parameters), plan.spec.adaptive
        self._free = plan.settings.step is None and not self._adaptive
        self._loop = prepared.simulation()
        self._loop.span = self._loop.span._replace(end=math.inf)  # `until` is none
        state = self._loop.state
        self._tree = prepared.tree
        self._clock, self._control = memoryview(state.clock), memoryview(state.control)
        self._clocks, self._calling, self._advance = list[Clock](), False, Advance(self._loop)
        inputs, self._driven = plan.inputs.words, plan.inputs.driven
        self._jumps = plan.inputs.stops
        self._foreseen = foreseen(plan.mechanism, plan.events) if self._adaptive else Foreseen(mechanism)
        self._input_formulas = {name: words for name, words in inputs.items() if isinstance(words, str)}
        self._inputs = {name: x for name, x in inputs.items() if not isinstance(x, str)}
        places = {q.name: i for i, q in enumerate(info.parameters)}
        self._varying = [places[name] for name in mechanism.inputs if name not in self._inputs]  # by formulas and data
        self._hidden = set(mechanism.inputs).difference(inputs)  # parts of formulas
        both = *info.coordinates, *info.velocities
        self.q = _view(state.y, 0, info.coordinates)
        self.v = _view(state.y, info.nq, info.velocities)
        self.state = _view(state.y, 0, both)
        self.states = _view(state.y, info.work + 1, info.states)
        self.warnings, self.notes = (*plan.all_warnings, *start.warnings), start.notes
        self._first = self.save()
        if not self._free:  # else the first step says how long it is
            self._advance.begin()
        self._history, self._shown = History(self._loop), (-1.0, -1, -1)
        self._history.note()
        self._version = 0

    # -- what can be read ----------------------------------------------------------------------------------------------

    @property
    def t(self) -> float:
        """Time of the state [s]."""
        return self._clock[_TIME]

    @property
    def steps(self) -> int:
        """Steps that have been accepted."""
        return self._control[_STEPS]

    @property
    def bodies(self) -> dict[str, float]:
        """Present coordinates and velocities of bodies by name, whatever the state is made of."""
        if self._tree is None:
            return self.state.to_dict()
        state = self._loop.state
        return dict(
            zip(self._tree.names, self._tree.bodies_at(self.t, state.y, state.p, state.w).tolist(), strict=True)
        )

    @property
    def parameters(self) -> dict[str, float]:
        """Present values of all parameters."""
        numbers = zip(self._compiled.info.parameters, self._loop.state.p.tolist(), strict=False)
        return {q.name: x for q, x in numbers if q.name not in self._hidden}

    @property
    def events(self) -> tuple[EventRecord, ...]:
        """What has happened since the start, as in results; of a run that was taken back, up to where it stands."""
        events = self._loop.events
        return () if events is None else tuple(record_of(self._compiled.info, event) for event in events.happened)

    @property
    def outputs(self) -> dict[str, float]:
        """Present values of the formulas of the file's ``[outputs]`` by name, integrals among them."""
        return self._now.outputs.row(0)

    @property
    def points(self) -> dict[str, float]:
        """Present places, velocities and accelerations of named points: ``arm.tip.x``, ``.vx``, ``.ax``, ..."""
        return self._now.points.row(0)

    @property
    def elements(self) -> dict[str, float]:
        """Present forces, lengths and powers of force elements and drivers: ``spring.force``, ``motor.effort``, ..."""
        return self._now.elements.row(0)

    @property
    def reactions(self) -> dict[str, float]:
        """Present reactions of joints, as results have them: ``A.Fx`` [N], ``A.M`` [N m], ..."""
        return self._now.reactions.row(0)

    def __getitem__(self, name: str) -> float:
        """Return the present value of a column of results: ``sim["motor.effort"]``, ``sim["arm.tip.x"]``.

        Raises
        ------
        InputError
            If there is no such column.
        """
        return float(self._now[name][0])

    def result(self) -> Result:
        """Return the run since the start as a result, with an output at the end of each piece.

        Pieces are calls of `step` and `run`, and times between the calls of controllers. Of more than about 4000 every
        second is kept, then every fourth, and so on, and always the present state.
        """
        self._ready("result")
        self._advance.begin()
        result = self._history.result(self._prepared)
        _ = result.last_state  # of now: the run goes on
        return result

    @property
    def _now(self) -> Result:
        """The present state as a result, which is made once for a state."""
        key = (self.t, self.steps, self._version)
        if key != self._shown:
            self._advance.recover()
            if not self._free:
                self._advance.begin()
            self._present, self._shown = self._history.present(self._prepared), key
        return self._present

    def __repr__(self) -> str:
        law, integrator = self._compiled.law.method, self._plan.integrator.name
        return f"SteppedRun({self._mechanism.name}, {law}, {integrator}, t={self.t:.6g} s)"

    # -- going on ------------------------------------------------------------------------------------------------------

    def step(self, dt: float, u: Mapping[str, float] | None = None) -> EventRecord | None:
        """Go on for a time, or to an event that ends runs.

        Parameters
        ----------
        dt : float
            How long [s]: a multiple of a constant step goes on along its grid, anything else ends with a shortened
            step, from which a new grid begins. Where no step was asked for, this is the step.
        u : mapping of str to float, optional
            Values to be set before, as by `set`; they are held until others are set.

        Returns
        -------
        EventRecord or None
            The event of kind ``stop`` at which the run stands now, before that time was over; None where it was. The
            next call goes on from there.

        Raises
        ------
        InputError
            If an argument is wrong, or velocities that an event asks for cannot be.
        StepError
            If a step fails; the run stays at the last accepted state.
        """
        if type(dt) is not float or not 0.0 < dt < math.inf:  # the rest of it is for what seldom happens
            dt = arguments.number("dt", dt, positive=True)
        if self._calling or self._advance.unsure:
            self._ready("step")
        if u is not None:
            self.set(u)
        if self._free:
            self._advance.take_steps_of(dt)
        if self._clocks or self._jumps:
            return self._go(self._clock[_TIME] + dt)
        event = self._advance.to(self._clock[_TIME] + dt)
        self._history.note()
        return event

    def run(self, until: float) -> EventRecord | None:
        """Go on to a time, or to an event that ends runs.

        Parameters
        ----------
        until : float
            Where to [s]. Where no step was asked for, steps are those of the mechanism.

        Returns
        -------
        EventRecord or None
            As `step`.

        Raises
        ------
        InputError
            If that time has passed, or velocities that an event asks for cannot be.
        StepError, KeyboardInterrupt
            If a step fails, or after Ctrl-C; the run stays at the last accepted state and can go on.
        """
        until = arguments.number("until", until)
        self._ready("run")
        if until < self.t - max(self._loop.same(until), abi.RESOLVED_TIME * abs(until)):
            raise InputError("until", f"a time from {self.t:g} s on, where the run stands", f"{until:g}")
        if self._free:
            self._advance.take_steps_of(self._plan.spec.step or 0.0)
        return self._go(until)

    def every(self, interval: float, controller: Controller) -> None:
        """Have a function called at t0 + k `interval`, k = 0, 1, 2, ..., t0 being the present time.

        It is called before the run goes on from that time, so not at the end of a piece but at the beginning of the
        next one. Runs with constant steps meet such times by shortened steps where they are no multiples of the step.

        Parameters
        ----------
        interval : float
            Time between two calls [s].
        controller : callable
            Takes the time of the call, one multiplication from t0, and this run. What it returns, values by name or
            None, is set as by `set` and held until the next call.
        """
        interval = arguments.number("interval", interval, positive=True)
        if controller is None or arguments.function("controller", controller) is None:
            raise InputError("controller", "a function", "None")
        self._clocks.append(Clock(controller, self.t, interval))

    # -- changing ------------------------------------------------------------------------------------------------------

    def set(self, values: Mapping[str, float] | None = None, /, **more: float) -> None:
        """Change parameters from the present time on.

        Positions and velocities stay what they are. What the change adds to the energy counts as work. Numbers of
        forces, masses and inertias may change; what moves a joint away from where it is, such as another length, is
        refused.

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
            spec = self._divided(parameters)
            if self._tree is not None:
                self._tree.refuse_moves(self.t, loop.state, p[:count])
            self._advance.begin()
            loop.changes.set(p[:count])
            loop.divide(spec)
        self._changed = {name: parameters[name] for name in changed}

    def _set_inputs(self, values: Mapping[str, float]) -> None:
        """Give inputs other values, which takes no look at the state."""
        numbers = {
            name: value if type(value) is float and math.isfinite(value) else arguments.number(f"input '{name}'", value)
            for name, value in values.items()
        }
        self._advance.recover()
        loop = self._loop
        if self._adaptive:
            self._advance.begin()
        if loop.changes.give(numbers) and self._adaptive and (code := begin_with_step(loop)) != _DONE:
            self._advance.fail(code)
        self._changed |= numbers

    # -- keeping -------------------------------------------------------------------------------------------------------

    def save(self) -> Saved:
        """Return all that the run remembers, as a value that can be pickled."""
        self._advance.recover()
        clocks = tuple((c.start, c.interval, c.beat) for c in self._clocks)
        events = self._loop.events
        happened = () if events is None else tuple(events.happened)
        return Saved(self._owner, self._loop.save(), self._loop.span.step, dict(self._changed), clocks, happened)

    def restore(self, saved: Saved) -> None:
        """Go back, or on, to what `save` returned, here or by another run of the same model, method and integrator.

        Limits and tolerances stay those of this run. Controllers are functions and are not saved: register the same
        ones before, and they go on at their next beats.

        Raises
        ------
        InputError
            If it belongs to something else. Nothing is changed then.
        """
        arguments.of_kind("restore", saved, Saved, "what `save` returned")
        self._ready("restore")
        loop = self._loop
        saved.check(self._owner, loop.save(), tuple(c.interval for c in self._clocks))
        loop.restore(saved.arrays, self._divided(parameter_values(self._mechanism, saved.parameters)))
        loop.set_limits()
        loop.state.control[[abi.STOP, abi.OUTPUTS]] = 0
        if self._free:
            loop.span = loop.span._replace(step=saved.step)
        elif saved.step != loop.span.step and not self._adaptive:
            self._advance.begin_grid()
        if loop.events is not None:
            loop.events.happened = list(saved.happened)
        self._changed = dict(saved.parameters)
        for clock, (start, _, beat) in zip(self._clocks, saved.clocks, strict=True):
            clock.start, clock.beat = start, beat
        self._version += 1
        self._history.forget_after(saved.t)

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
        if start is not None:
            if self._prepare is None:
                raise InputError("reset", "no start, for a run without its model", arguments.shown(start))
            prepared = self._prepare(start)
            if prepared.compiled.law.key != self._compiled.law.key:  # bodies that are light there alone
                got = f"one that is run with {prepared.compiled.law.key}"
                raise InputError("reset", f"a start that is run with {self._compiled.law.key}", got)
            simulation = prepared.simulation()
            first, self._prepared, self._loop.start, self._tree = (
                replace(first, arrays=simulation.save()),
                prepared,
                prepared.start,
                prepared.tree,
            )
        clocks = [Clock(clock.controller, first.t, clock.interval) for clock in self._clocks]
        self._clocks.clear()
        self.restore(first)
        self._clocks.extend(clocks)
        self._history.clear()
        if not self._free:
            self._advance.begin()
        self._history.note()

    # -- inside --------------------------------------------------------------------------------------------------------

    @property
    def _owner(self) -> dict[str, str]:
        law, steps = self._compiled.law, "varying" if self._adaptive else "constant"
        return {
            "symgen": __version__,
            "mechanism": f"{self._mechanism.name} ({digest(self._mechanism)[:16]})",
            "code of shape": self._compiled.shape,
            "method": f"{law.method} ({law.key})",
            "integrator": f"{self._plan.integrator.name} with {steps} steps",
            "events": in_words(self._plan.events) or "of no kind",
        }

    def _divided(self, values: Mapping[str, float]) -> RunSpec:
        """Return the run's specification for values of parameters: inputs jump, and formulas have kinks, elsewhere."""
        spec, driven = self._loop.spec, self._driven
        if driven is not None and driven.jumps:
            self._jumps = stops_of(driven, values, spec.until)
        return replace(spec, stops=merged(self._jumps, self._foreseen.stops(values, spec.until)))

    def _ready(self, what: str) -> None:
        """Refuse a call from inside a controller, and have an accepted state."""
        if self._calling:
            raise SimulationError(f"a controller cannot call `{what}`: it is called while the run goes on")
        self._advance.recover()

    def _go(self, until: float) -> EventRecord | None:
        """Go on to a time, with the controllers called and the jumps of inputs made on the way."""
        loop, event = self._loop, None
        if self._jumps and until - loop.spec.until > loop.same(until):
            where = f"a time up to the setting until = {loop.spec.until:g} s: jumps of inputs are known up to there"
            raise InputError("until", where, f"{until:g}")
        while event is None and loop.is_ahead(until):
            self._call()
            event = self._advance.to(min((until, *(clock.due for clock in self._clocks))))
            self._history.note()
        return event

    def _call(self) -> None:
        """Call the controllers whose time has come."""
        now = self.t
        slack = 0.0 if self._adaptive else self._loop.same(now)
        self._advance.begin()
        self._calling = True
        try:
            for clock in self._clocks:
                if clock.is_due(now, slack):
                    values = clock.controller(clock.due, self)
                    if values is not None:
                        self.set(arguments.mapping("controller", values, "values by name, or None"))
                    clock.beat += 1
        finally:
            self._calling = False


def _view(y: np.ndarray, first: int, quantities: Iterable[Quantity]) -> Named:
    """Return a named view of a part of the state."""
    quantities = tuple(quantities)
    names, units = tuple(q.name for q in quantities), tuple(q.unit for q in quantities)
    return Named.of(y[first : first + len(names)], names, units)

"""Derivatives of the step that a run has just made: the same step once more, with directions beside the state.

Scheme, constraints, corrections and events are in them. What makes the step again depends on the run: explicit schemes
have directions after the state, implicit ones the equations of their stages (`symgen.run.directions.step_directions`).
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace
from functools import cached_property, partial
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from symgen.base.errors import InputError
from symgen.describe.facts.kinks import discontinuities_of
from symgen.result.sensitivities import SCHEMES
from symgen.result.stepping.horizon import Horizon
from symgen.run.compiling.side import compile_side
from symgen.run.directions.directed_model import DirectedModel, Seeds, lanes_of_few_passes
from symgen.run.directions.push_directions import refuse_law_without_directions
from symgen.run.directions.step_directions import StepsAgain
from symgen.run.directions.steps_ahead import DirectedRun, StepsAhead
from symgen.run.layout import abi
from symgen.run.layout.scheme_records import Stages
from symgen.run.planning.starts import compiled_for

if TYPE_CHECKING:
    from symgen.run.layout.compiled import CompiledModel
    from symgen.run.planning.prepare import Prepared
    from symgen.run.single.simulation import Simulation

Array = NDArray[np.float64]
WHERE = "derivatives"
#: Schemes whose steps need no history, of those that have directions; implicit ones with directions of their stages.
ONE_STEP = tuple(name for name in SCHEMES if not name.startswith("abm"))
IMPLICIT = "radau5", "sdirk", "trapezoidal"
#: Part of the state by which the step with directions may differ, as rounding makes it.
SAME = 1e-9
_NO_DOUBTS: tuple[str, ...] = ()
_TIME, _STEPS, _DONE = abi.TIME, abi.STEPS, abi.DONE  # looked up at every step


class StepDerivatives(NamedTuple):
    """How the state after a step depends on the state before and on inputs, and outputs on the state after it.

    The tuples ``states``, ``inputs`` and ``outputs`` hold the names of rows and columns.

    Attributes
    ----------
    A : Array, shape (n, n)
        Derivatives of the states after by those before. States count as independent: those that violate rows as well.
    B : Array, shape (n, m)
        By m inputs that are held during the step.
    C : Array, shape (k, n)
        Derivatives of k outputs of the file after the step by the states there.
    left_out : tuple of str
        Outputs that depend on accelerations, forces or the history.
    t, dt : float
        Where the step began, and its length [s].
    doubts : tuple of str
        Why derivatives are in doubt, where an event in the step has none or other ones on its two sides.
    """

    A: Array
    B: Array
    C: Array
    states: tuple[str, ...]
    inputs: tuple[str, ...]
    outputs: tuple[str, ...]
    left_out: tuple[str, ...]
    t: float
    dt: float
    doubts: tuple[str, ...] = ()

    def __repr__(self) -> str:
        sizes = f"{len(self.states)} states, {len(self.inputs)} inputs, {len(self.outputs)} outputs"
        return f"<StepDerivatives from t = {self.t:g} s over {self.dt:g} s: {sizes}>"


#: Makes one of these from all its fields, in half the time that its constructor takes.
_record: Callable[[tuple[Any, ...]], StepDerivatives] = partial(tuple.__new__, StepDerivatives)


class StepDirections:
    """The derivatives of the steps of a run.

    Parameters
    ----------
    prepared : Prepared
        The run.
    loop : Simulation
        Its loop.

    Raises
    ------
    InputError
        If the scheme, the shape or an event has no directions.
    """

    def __init__(self, prepared: Prepared, loop: Simulation) -> None:
        _check_names(prepared, loop)
        self._prepared, self._loop, info = prepared, loop, prepared.compiled.info
        self._places = [*range(info.work), *range(info.ny)[info.own_states]]
        self.states = tuple(q.name for q in (*info.coordinates, *info.velocities, *info.states))
        names = [q.name for q in info.parameters]
        hidden = {name for name, words in prepared.plan.inputs.words.items() if isinstance(words, str)}
        self.inputs = tuple(name for name in info.inputs if name not in hidden)
        self.input_places = [names.index(name) for name in self.inputs]
        self._n, count = len(self._places), len(self._places) + len(self.inputs)
        self._model = DirectedModel(
            _settings_for_slopes(prepared) if self.is_straight else prepared.compiled, lanes_of_few_passes(count)
        )
        y, p = (np.zeros((self._model.sizes[name], count)) for name in "yp")
        y[self._places, range(self._n)] = 1.0
        p[self.input_places, range(self._n, count)] = 1.0
        self._seeds = Seeds(y, p)
        self._clock, self._control = loop.state.clock.data, loop.state.control.data
        self._began = _columns_and_counts(self._before)
        self._ahead = dict[int, StepsAhead]()

    @cached_property
    def _before(self) -> Mapping[str, NDArray[Any]]:
        """The arrays of the state before the last piece: views that show the present one."""
        return self._views(self._loop.snapshot.copy)

    def _views(self, copy: Array) -> Mapping[str, NDArray[Any]]:
        """Return the arrays of a state in a copy of its memory."""
        snapshot, arrays = self._loop.snapshot, dict[str, NDArray[Any]]()
        begin = snapshot.front.ctypes.data
        for name, now in self._loop.state._asdict().items():
            if name in ("passages", "room"):
                continue
            first = (now.ctypes.data - begin) // 8
            arrays[name] = copy[first : first + len(now)].view(now.dtype)
        return arrays

    def last(self) -> StepDerivatives:
        """Return the derivatives of the last step.

        Raises
        ------
        InputError
            If no step was made, inputs jumped during it, or it cannot be made again.
        """
        loop, (clock, control), until = self._loop, self._began, self._clock[_TIME]
        first, doubts = loop.snapshot.first, _NO_DOUBTS
        if first is not None:
            before = self._views(first)
            clock, control = _columns_and_counts(before)
        t = clock[_TIME]
        if not until > t or control[_STEPS] >= self._control[_STEPS]:
            raise InputError(WHERE, "a step before", "none")
        if loop.spec.seams:
            self._refuse_jumps(t, until)
        outputs, left_out, taken = self.outputs
        if self.is_straight:
            a, b, c = self._straight(until, first)
        else:
            again = self._again
            again.span = loop.span
            self._compare(again.repeat_steps(self._before if first is None else before, until), again.state.y)
            after, n = again.slopes[self._places], self._n
            a, b, c = after[:, :n], after[:, n:], self._outputs_at_state()[taken, :n]
            doubts = tuple(dict.fromkeys(again.transfer.doubts))
        return _record((a, b, c, self.states, self.inputs, outputs, left_out, t, until - t, doubts))

    def _refuse_jumps(self, t: float, until: float) -> None:
        for seam in self._loop.spec.seams:
            if t < seam.t < until:
                raise InputError(WHERE, "a step during which inputs are held", "one in which they jump")

    @cached_property
    def is_straight(self) -> bool:
        """Whether one compiled call makes steps with their derivatives: explicit schemes without events do."""
        return self._loop.spec.events is None and not isinstance(self._loop.scheme, Stages)

    # -- steps with events, and of implicit schemes --------------------------------------------------------------------

    @cached_property
    def _again(self) -> StepsAgain:
        """What makes the last step again."""
        loop, ready = self._loop, self._prepared
        spec = replace(loop.spec, seams=())
        return StepsAgain(ready.compiled, ready.plan.integrator, ready.start, spec, self._seeds)

    def _compare(self, ended: bool, y: Array) -> None:
        """Refuse steps that differ from the steps of the run."""
        own = self._model.sizes["y"]
        here, now = y[:own], self._loop.state.y[:own]
        if not (ended and np.abs(here - now).max() <= SAME * max(1.0, np.abs(now).max())):
            raise InputError(WHERE, "a step that is the same once more", "another one")

    # -- explicit schemes without events -------------------------------------------------------------------------------

    @cached_property
    def _directed(self) -> DirectedRun:
        loop, ready, side = self._loop, self._prepared, self._side
        function, count = (None, 0) if side is None else (side.function, len(ready.mechanism.outputs))
        spec, integrator = replace(loop.spec, seams=()), ready.plan.integrator
        of_inputs = self.input_places
        return DirectedRun(
            self._model, integrator, ready.start, spec, self._seeds, self._places, of_inputs, function, count
        )

    @cached_property
    def _one(self) -> StepsAhead:
        return StepsAhead(self._directed, self._before, end=self._loop.state.y, same=SAME)

    @cached_property
    def _results(self) -> tuple[Array, Array, Array]:
        """Where the call leaves A, B, and C with all outputs; none where no output has derivatives."""
        one, n = self._one, self._n
        slopes, outputs = one.slopes[0], one.by_outputs[0] if self.outputs[2] else np.zeros((0, self._n))
        return slopes[:, :n], slopes[:, n : n + len(self.inputs)], outputs[:, :n]

    def _straight(self, until: float, first: Array | None) -> tuple[Array, Array, Array]:
        """Return A, B and C of the last piece, from a first copy where there is one."""
        loop = self._loop
        if loop.spec.adaptive:
            self._directed.rescale(self._before)
        code = self._one.make_steps(loop.span, until) if first is None else self._piece_from(first, until)
        if code != _DONE:
            raise InputError(WHERE, "a step that is the same once more", "another one")
        (a, b, c), (_, left_out, taken) = self._results, self.outputs
        own_c = c.copy() if taken and not left_out else c[taken] if taken else c  # what is empty never changes
        return a.copy(), b.copy() if self.inputs else b, own_c

    def _piece_from(self, first: Array, until: float) -> int:
        """Make the last piece of the step from a first copy; return the code of its end."""
        copy = self._loop.snapshot.copy
        latest, copy[:] = copy.copy(), first
        code = self._one.make_steps(self._loop.span, until)
        copy[:] = latest
        return code

    def straight_ahead(self, values: Array, dt: float) -> Horizon | None:
        """Return steps from the present state in one compiled call; None where that cannot make them.

        Parameters
        ----------
        values : Array, shape (N, m)
            Inputs that are held in each.
        dt : float
            Their length [s].
        """
        loop, steps = self._loop, len(values)
        span, now = loop.span, self._clock[_TIME]
        ends = now + dt * np.arange(steps + 1.0)
        if not self.is_straight or loop.spec.adaptive or any(now < seam.t < ends[-1] + dt for seam in loop.spec.seams):
            return None
        own, directed = self._copies, self._directed
        for name, array in own.items():
            array[:] = getattr(loop.state, name)
        if self._prepared.plan.settings.step is None and span.step != dt:  # each call is a step
            span = span._replace(step=dt)
            own["clock"][abi.ORIGIN], own["control"][abi.INDEX], own["control"][abi.BEGUN] = now, 0, abi.AFRESH
        if steps not in self._ahead:
            self._ahead = {steps: StepsAhead(directed, own, steps)}
        ahead = self._ahead[steps]
        ahead.values[:] = values
        if ahead.make_steps(span, now + dt, dt) != abi.DONE:
            return None
        n, (outputs, _, taken) = self._n, self.outputs
        a, b = ahead.slopes[:, :, :n].copy(), ahead.slopes[:, :, n : n + len(self.inputs)].copy()
        c = ahead.by_outputs[:, taken, :n]
        return Horizon(np.vstack([self.state(), ahead.states]), a, b, c, ends, self.states, self.inputs, outputs)

    def state(self) -> Array:
        """Return the present states."""
        return np.asarray(self._loop.state.y[self._places])

    @cached_property
    def _copies(self) -> dict[str, NDArray[Any]]:
        """Arrays of a state from which steps ahead begin."""
        return {name: array.copy() for name, array in self._before.items()}

    # -- outputs -------------------------------------------------------------------------------------------------------

    @cached_property
    def _side(self) -> Any:
        mechanism = self._prepared.mechanism
        formulas = [(output.name, output.value) for output in mechanism.outputs]
        return compile_side(mechanism, self._prepared.compiled, "outputs", "Outputs", formulas) if formulas else None

    @cached_property
    def outputs(self) -> tuple[tuple[str, ...], tuple[str, ...], list[int]]:
        """Names of outputs with derivatives and of others, and the places of the former."""
        names = [output.name for output in self._prepared.mechanism.outputs]
        of_forces = () if self._side is None else self._side.of_forces
        taken = [i for i in range(len(names)) if i not in of_forces]
        return tuple(names[i] for i in taken), tuple(name for i, name in enumerate(names) if i in of_forces), taken

    def _outputs_at_state(self) -> Array:
        """Return the directions of all outputs at the present state."""
        model, now, count = self._model, self._loop.state, len(self._prepared.mechanism.outputs)
        if self._side is None:
            return np.zeros((0, self._seeds.count))
        call = model.function(self._side.function, count).caller(abi.OBSERVE.signature.arguments)
        parts = list[Array]()
        for first in range(0, self._seeds.count, model.lanes):
            seeds = self._seeds.seeds_of_part(first, model.lanes)
            y, p, w = (
                model.room_with_directions(now.y, "y", seeds.y),
                model.room_with_directions(now.p, "p"),
                model.room_with_directions(now.w, "w"),
            )
            out = np.zeros(count * (1 + model.lanes))
            call(float(now.clock[abi.TIME]), y, p, w, np.zeros_like(y), out)
            parts.append(out[count:].reshape(count, model.lanes))
        return np.concatenate(parts, axis=1)


def _settings_for_slopes(prepared: Prepared) -> CompiledModel:
    """Return the code of a run with a right-hand side for derivatives, if both have the same scratch."""
    choice, own = replace(prepared.plan.choice, directed=True), prepared.compiled
    compiled = compiled_for(prepared.mechanism, choice)
    same = compiled.info.sections == own.info.sections and compiled.law.nw == own.law.nw
    return compiled if same and compiled.law.parameters == own.law.parameters else own


def _columns_and_counts(before: Mapping[str, NDArray[Any]]) -> tuple[Any, Any]:
    """Return clock and control of a state, which are read faster this way."""
    return before["clock"].data, before["control"].data


def _check_names(prepared: Prepared, loop: Simulation) -> None:
    """Refuse runs whose steps have no directions."""
    name, compiled, watched = prepared.plan.integrator.name, prepared.compiled, loop.spec.events
    if name not in ONE_STEP and type(loop.scheme) is not Stages:  # `Backward` has stages and a history
        expected = f"a scheme whose steps have derivatives ({', '.join((*ONE_STEP, *IMPLICIT))})"
        raise InputError(WHERE, expected, f"'{name}'")
    if compiled.shape != "straight":
        raise InputError(WHERE, "code of the shape 'straight'", f"shape '{compiled.shape}'")
    refuse_law_without_directions(watched, "")
    jumps = any(x.jumps for x in discontinuities_of(prepared.mechanism))
    if jumps or (watched is not None and watched.rows is not None):
        hint = "write kinks by max, min or abs, and jumps as an event, which resets a state of the file"
        raise InputError(WHERE, "a run without jumps of formulas", "formulas that jump where the state passes 0", hint)

"""Derivatives of the step that a run has just made: the same step once more, with directions beside the state.

Scheme, constraints, corrections and events are in them. What makes the step again depends on the run: explicit schemes
have directions behind the state, implicit ones the equations of their stages (`symgen.run.single.step_directions`).
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from symgen.base.errors import InputError
from symgen.describe.facts.kinks import discontinuities_of
from symgen.result.sensitivities import SCHEMES
from symgen.run.compiling.side import compile_side
from symgen.run.layout import abi
from symgen.run.layout.scheme_records import Stages
from symgen.run.single.directed_model import DirectedModel, Seeds, lanes_of
from symgen.run.single.simulation import Simulation
from symgen.run.single.step_directions import StepsAgain

if TYPE_CHECKING:
    from symgen.run.planning.prepare import Prepared
    from symgen.run.starts.assembly import Start

Array = NDArray[np.float64]
WHERE = "derivatives"
#: Schemes whose steps need no history, of those that have directions; implicit ones with directions of their stages.
ONE_STEP = tuple(name for name in SCHEMES if not name.startswith("abm"))
IMPLICIT = "radau5", "sdirk", "trapezoidal"
#: Part of the state by which the step with directions may differ, as rounding makes it.
SAME = 1e-9


@dataclass(frozen=True)
class StepDerivatives:
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
        _check(prepared, loop)
        self._prepared, self._loop, compiled = prepared, loop, prepared.compiled
        info = compiled.info
        self._places = np.array([*range(info.work), *range(info.ny)[info.own_states]])
        quantities = (*info.coordinates, *info.velocities, *info.states)
        self._states = tuple(q.name for q in quantities)
        names = [q.name for q in info.parameters]
        hidden = {name for name, words in prepared.plan.inputs.words.items() if isinstance(words, str)}
        self._inputs = tuple(name for name in info.inputs if name not in hidden)
        count = self._count = len(self._places) + len(self._inputs)
        self._model = DirectedModel(compiled, lanes_of(count))
        y, p = np.zeros((self._model.sizes["y"], count)), np.zeros((self._model.sizes["p"], count))
        y[self._places, range(len(self._places))] = 1.0
        for k, name in enumerate(self._inputs, len(self._places)):
            p[names.index(name), k] = 1.0
        self._seeds = Seeds(y, p)
        self._parts = [self._seeds.part(first, self._model.lanes) for first in range(0, count, self._model.lanes)]
        self._known = dict[int, tuple[bytes, Array, Array]]()

    @cached_property
    def _longer(self) -> Start:
        """The start of the run with room for directions."""
        model, start = self._model, self._prepared.start
        return replace(
            start, y=model.longer(start.y, "y"), p=model.longer(start.p, "p"), w=model.longer(start.w, "w"), saved=None
        )

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
        first = self._loop.snapshot.first
        before, now = self._before if first is None else self._views(first), self._loop.state
        t, until = float(before["clock"][abi.TIME]), float(now.clock[abi.TIME])
        if not until > t or before["control"][abi.STEPS] >= now.control[abi.STEPS]:
            raise InputError(WHERE, "a step before", "none")
        if any(t < seam.t < until for seam in self._loop.spec.seams):
            raise InputError(WHERE, "a step during which inputs are held", "one in which they jump")
        n, count = len(self._places), self._count
        again, doubts = self._again, tuple[str, ...]()
        if again is None:
            after = self._straight(until)
        else:
            after, doubts = self._passing(again, before, until), tuple(dict.fromkeys(again.transfer.doubts))
        outputs, left_out, c = self._outputs
        a, b = after[:, :n], after[:, n:count]
        return StepDerivatives(a, b, c(), self._states, self._inputs, outputs, left_out, t, until - t, doubts)

    # -- steps with events, and of implicit schemes --------------------------------------------------------------------

    @cached_property
    def _again(self) -> StepsAgain | None:
        """What makes steps with events, and of implicit schemes, again; None for explicit schemes without events."""
        loop, ready = self._loop, self._prepared
        if loop.spec.events is None and not isinstance(loop.scheme, Stages):
            return None
        return StepsAgain(ready.compiled, ready.plan.integrator, ready.start, replace(loop.spec, seams=()), self._seeds)

    def _passing(self, again: StepsAgain, before: Mapping[str, NDArray[Any]], until: float) -> Array:
        """Return directions of the states behind the last piece."""
        again.span = self._loop.span
        self._compare(again.made_again(before, until), again.state.y)
        return np.asarray(again.slopes[self._places])

    def _compare(self, ended: bool, y: Array) -> None:
        """Refuse steps that are others than those of the run."""
        own = self._model.sizes["y"]
        here, now = y[:own], self._loop.state.y[:own]
        if not (ended and np.abs(here - now).max() <= SAME * max(1.0, np.abs(now).max())):
            raise InputError(WHERE, "a step that is the same once more", "another one")

    # -- explicit schemes without events -------------------------------------------------------------------------------

    @cached_property
    def _simulation(self) -> Simulation:
        loop = self._loop
        return Simulation(self._model.whole, self._prepared.plan.integrator, self._longer, replace(loop.spec, seams=()))

    @cached_property
    def _into(self) -> tuple[tuple[Array, Array], ...]:
        """Pairs of arrays, each of the run with directions and from before the step."""
        state, sizes, before = self._simulation.state, self._model.sizes, self._before
        return tuple((getattr(state, name)[: sizes[name]], before[name][: sizes[name]]) for name in ("y", "w"))

    @cached_property
    def _directions(self) -> tuple[Array, Array, Array]:
        """Directions behind y and w in the run with directions, and the first ones as a matrix."""
        model, state = self._model, self._simulation.state
        y, w = model.sizes["y"], model.sizes["w"]
        return state.y[y : y * (1 + model.lanes)], state.w[w:], model.shadow(state.y, "y")

    def _straight(self, until: float) -> Array:
        """Return directions of the states behind the last piece."""
        lanes = self._model.lanes
        after = np.empty((len(self._places), lanes * len(self._parts)))
        for k in range(len(self._parts)):
            after[:, k * lanes : (k + 1) * lanes] = self._after(k, until)[self._places]
        return after

    def _after(self, k: int, until: float) -> Array:
        """Make the step with some directions; return them behind it, shape (ny, L)."""
        simulation, (y, w, slopes) = self._simulation, self._directions
        state = simulation.state
        state.p[:], w[:] = self._numbers(k, self._before["p"])
        y[:] = self._parts[k].y.ravel()
        for there, before in self._into:
            there[:] = before
        simulation.span = self._loop.span
        self._count_from(simulation)
        self._compare(simulation.go(until, math.inf) == abi.DONE, state.y)
        return slopes

    def _count_from(self, simulation: Simulation) -> None:
        """Give the run with directions the counts before the step; what its scheme keeps of past rates is made anew.

        Beginning anew leaves the next step of adaptive runs as it is.
        """
        state, before = simulation.state, self._before
        for name in ("iw", "clock", "gauges", "control"):
            getattr(state, name)[:] = before[name]
        if state.control[abi.BEGUN] != 1:
            return
        state.control[abi.BEGUN] = abi.AFRESH
        if not simulation.spec.adaptive:
            return
        long, short = len(state.y), len(before["y"])
        for name in ("share", "metric", "scales"):
            array, own = getattr(state, name), before[name]
            array[:short], array[long : long + short] = own[:short], own[short:]
        simulation.span = simulation.span._replace(step=float(before["clock"][abi.NEXT]))
        simulation.go(math.inf, float(state.control[abi.STEPS]))
        state.clock[:] = before["clock"]
        kept = [abi.REFUSED, abi.BARRED]
        state.control[kept] = before["control"][kept]

    def _numbers(self, k: int, p: Array) -> tuple[Array, Array]:
        """Return parameters with directions, and the directions of scratch that follow them, kept while they stay."""
        known = self._known.get(k)
        numbers = p.tobytes()
        if known is None or known[0] != numbers:
            model = self._model
            longer = model.parameters(p, self._parts[k].p)
            w = model.scratch(longer, self._loop.state.w)
            known = self._known[k] = numbers, longer, w[model.sizes["w"] :]
        return known[1], known[2]

    # -- outputs -------------------------------------------------------------------------------------------------------

    @cached_property
    def _outputs(self) -> tuple[tuple[str, ...], tuple[str, ...], Any]:
        """Names of outputs with derivatives, of others, and what computes them at the present state."""
        mechanism, compiled = self._prepared.mechanism, self._prepared.compiled
        formulas = [(output.name, output.value) for output in mechanism.outputs]
        if not formulas:
            return (), (), lambda: np.zeros((0, len(self._places)))
        side = compile_side(mechanism, compiled, "outputs", "Outputs", formulas)
        taken = [i for i in range(len(formulas)) if i not in side.of_forces]
        model, count = self._model, len(formulas)
        call = model.function(side.function, count).caller(abi.OBSERVE.signature.arguments)

        def slopes() -> Array:
            now, parts = self._loop.state, list[Array]()
            for seeds in self._parts:
                y, p, w = model.longer(now.y, "y", seeds.y), model.longer(now.p, "p"), model.longer(now.w, "w")
                out = np.zeros(count * (1 + model.lanes))
                call(float(now.clock[abi.TIME]), y, p, w, np.zeros_like(y), out)
                parts.append(out[count:].reshape(count, model.lanes))
            return np.concatenate(parts, axis=1)[taken, : len(self._places)]

        names = [name for name, _ in formulas]
        others = tuple(name for i, name in enumerate(names) if i not in taken)
        return tuple(names[i] for i in taken), others, slopes


def _check(prepared: Prepared, loop: Simulation) -> None:
    """Refuse runs whose steps have no directions."""
    name, compiled, watched = prepared.plan.integrator.name, prepared.compiled, loop.spec.events
    if name not in ONE_STEP and not isinstance(loop.scheme, Stages):
        expected = f"a scheme whose steps have derivatives ({', '.join((*ONE_STEP, *IMPLICIT))})"
        raise InputError(WHERE, expected, f"'{name}'")
    if compiled.shape != "straight":
        raise InputError(WHERE, "code of the shape 'straight'", f"shape '{compiled.shape}'")
    jumps = any(x.jumps for x in discontinuities_of(prepared.mechanism))
    if jumps or (watched is not None and watched.rows is not None):
        hint = "write kinks by max, min or abs, and jumps as an event, which resets a state of the file"
        raise InputError(WHERE, "a run without jumps of formulas", "formulas that jump where the state passes 0", hint)

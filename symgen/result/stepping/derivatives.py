"""Derivatives of the step that a run has just made: the same step once more, with directions beside the state.

Scheme, constraints and corrections are in them. The code with directions is made once a run; a call copies the state
from before the step and enters the loop, once for eight directions.
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
from symgen.describe.bounds.keys import nouns
from symgen.result.sensitivities import SCHEMES
from symgen.run.compiling.side import compile_side
from symgen.run.layout import abi
from symgen.run.single.directed_model import DirectedModel, Seeds, lanes_of
from symgen.run.single.simulation import Simulation

if TYPE_CHECKING:
    from symgen.run.planning.prepare import Prepared

Array = NDArray[np.float64]
WHERE = "derivatives"
#: Schemes whose steps need no history, of those that have directions.
ONE_STEP = tuple(name for name in SCHEMES if not name.startswith("abm"))
#: Part of the state by which the step with directions may differ, as rounding makes it.
SAME = 1e-9
#: Arrays of a state that the same step begins with besides y, p and w.
_COUNTS = ("iw", "clock", "gauges", "control")


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
        name, compiled = prepared.plan.integrator.name, prepared.compiled
        if name not in ONE_STEP:
            raise InputError(WHERE, f"an explicit scheme of one step ({', '.join(ONE_STEP)})", f"'{name}'")
        if compiled.shape != "straight":
            raise InputError(WHERE, "code of the shape 'straight'", f"shape '{compiled.shape}'")
        if loop.spec.events is not None:
            bounded = nouns(joined=", ")
            raise InputError(WHERE, f"a run without events, {bounded} and comparisons in formulas", "one with")
        self._prepared, self._loop, self._info = prepared, loop, compiled.info
        info = compiled.info
        self._places = np.array([*range(info.work), *range(info.ny)[info.own_states]])
        quantities = (*info.coordinates, *info.velocities, *info.states)
        self._states = tuple(q.name for q in quantities)
        names = [q.name for q in info.parameters]
        hidden = {name for name, words in prepared.plan.inputs.words.items() if isinstance(words, str)}
        self._inputs = tuple(name for name in info.inputs if name not in hidden)
        count = len(self._places) + len(self._inputs)
        self._model = DirectedModel(compiled, lanes_of(count))
        own_p, own_y = self._model.sizes["p"], self._model.sizes["y"]
        y, p = np.zeros((own_y, count)), np.zeros((own_p, count))
        y[self._places, range(len(self._places))] = 1.0
        for k, name in enumerate(self._inputs, len(self._places)):
            p[names.index(name), k] = 1.0
        seeds = Seeds(y, p)
        self._parts = [seeds.part(first, self._model.lanes) for first in range(0, count, self._model.lanes)]
        self._seeds, self._count = [part.y.ravel() for part in self._parts], count
        self._known = dict[int, tuple[bytes, Array, Array]]()

    @cached_property
    def _simulation(self) -> Simulation:
        model, start, loop = self._model, self._prepared.start, self._loop
        longer = replace(
            start, y=model.longer(start.y, "y"), p=model.longer(start.p, "p"), w=model.longer(start.w, "w"), saved=None
        )
        return Simulation(model.whole, self._prepared.plan.integrator, longer, replace(loop.spec, seams=()))

    @cached_property
    def _before(self) -> Mapping[str, NDArray[Any]]:
        """The arrays of the state before the last piece: views that show the present one."""
        snapshot, arrays = self._loop.snapshot, dict[str, NDArray[Any]]()
        begin = snapshot.front.ctypes.data
        for name in ("y", "p", "w", *_COUNTS):
            now = getattr(self._loop.state, name)
            first = (now.ctypes.data - begin) // 8
            arrays[name] = snapshot.copy[first : first + len(now)].view(now.dtype)
        return arrays

    def last(self) -> StepDerivatives:
        """Return the derivatives of the last step.

        Raises
        ------
        InputError
            If no step was made, inputs jumped during it, or it cannot be made again.
        """
        before, now = self._before, self._loop.state
        t, until = float(before["clock"][abi.TIME]), float(now.clock[abi.TIME])
        if not until > t or before["control"][abi.STEPS] >= now.control[abi.STEPS]:
            raise InputError(WHERE, "a step before", "none")
        if any(t < seam.t < until for seam in self._loop.spec.seams):
            raise InputError(WHERE, "a step during which inputs are held", "one in which they jump")
        lanes, n, count = self._model.lanes, len(self._places), self._count
        after = np.empty((n, lanes * len(self._parts)))
        for k in range(len(self._parts)):
            after[:, k * lanes : (k + 1) * lanes] = self._after(k, until)[self._places]
        outputs, left_out, c = self._outputs
        a, b = after[:, :n], after[:, n:count]
        return StepDerivatives(a, b, c(), self._states, self._inputs, outputs, left_out, t, until - t)

    @cached_property
    def _into(self) -> tuple[tuple[Array, Array], ...]:
        """Pairs of arrays, each of the run with directions and from before the step."""
        state, sizes, before = self._simulation.state, self._model.sizes, self._before
        own = ((getattr(state, name)[: sizes[name]], before[name][: sizes[name]]) for name in ("y", "w"))
        return *own, *((getattr(state, name), before[name]) for name in _COUNTS)

    @cached_property
    def _directions(self) -> tuple[Array, Array, Array]:
        """Directions behind y and w in the run with directions, and the first ones as a matrix."""
        model, state = self._model, self._simulation.state
        y, w = model.sizes["y"], model.sizes["w"]
        return state.y[y : y * (1 + model.lanes)], state.w[w:], model.shadow(state.y, "y")

    def _after(self, k: int, until: float) -> Array:
        """Make the step with some directions; return them behind it, shape (ny, L)."""
        simulation, (y, w, slopes) = self._simulation, self._directions
        state, own = simulation.state, self._model.sizes["y"]
        state.p[:], w[:] = self._numbers(k, self._before["p"])
        y[:] = self._seeds[k]
        for there, before in self._into:
            there[:] = before
        if state.control[abi.BEGUN] == 1:
            state.control[abi.BEGUN] = abi.AFRESH  # what the scheme keeps of the last rates has no directions
        simulation.span = self._loop.span
        code = simulation.go(until, math.inf)
        here, now = state.y[:own], self._loop.state.y[:own]
        same = here.tobytes() == now.tobytes() or np.abs(here - now).max() <= SAME * max(1.0, np.abs(now).max())
        if code != abi.DONE or not same:
            raise InputError(WHERE, "a step that is the same once more", "another one")
        return slopes

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

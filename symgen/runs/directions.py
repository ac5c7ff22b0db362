"""Runs with directions: derivatives of the state by numbers beside it, through the same steps.

The state is longer: behind y lie L directions of each element; directions of parameters and scratch lie behind p and
w. Emitted functions have a form with directions (`symgen.native.tangents`); loops and explicit schemes, which are
linear in the state, stay as they are. Error control leaves directions out, so a run without them takes the same steps.
"""

from __future__ import annotations

import functools
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cached_property
from types import SimpleNamespace
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from symgen.base.errors import InputError
from symgen.layout import abi
from symgen.layout import ensemble_abi as e
from symgen.layout.probe import rate_functions
from symgen.runs.run import Progress, completed
from symgen.runs.simulation import Simulation
from symgen.store.emitted import EmittedFunction, TangentFunction

if TYPE_CHECKING:
    from symgen.layout.compiled import CompiledModel
    from symgen.loops.integrator import Integrator
    from symgen.loops.run_spec import RunSpec
    from symgen.runs.outcome import Outcome
    from symgen.starts.assembly import Start

Array = NDArray[np.float64]

#: Numbers of directions that code is made for.
LANES = (2, 4, 8)
#: Most directions of a run.
MOST = 64
#: Functions of a model and of a law that have a form with directions in a run, and their types.
_MODEL = {"prepare": e.PREPARE, "masses": abi.MOVE, "geometry": abi.MEASURE}
_LAW = {"prepare": e.PREPARE, "rhs": abi.RHS, "confirm": abi.RHS, "accept": abi.ACCEPT, "rates": abi.RHS}


@dataclass(frozen=True)
class Seeds:
    """Directions at the start.

    Attributes
    ----------
    y, p : Array, shapes (ny, n), (np, n)
        Of the state and of the parameters, one column each.
    """

    y: Array
    p: Array

    @property
    def count(self) -> int:
        """Number of directions."""
        return int(self.y.shape[1])

    def part(self, first: int, lanes: int) -> Seeds:
        """Return `lanes` directions from one on, zeros where there are no more."""
        parts = [np.zeros((len(a), lanes)) for a in (self.y, self.p)]
        for room, array in zip(parts, (self.y, self.p), strict=True):
            taken = array[:, first : first + lanes]
            room[:, : taken.shape[1]] = taken
        return Seeds(*parts)


class DirectedModel:
    """A compiled model and its form with directions.

    Parameters
    ----------
    plain : CompiledModel
        The model, of straight code.
    lanes : int
        Number L of directions.

    Attributes
    ----------
    plain, lanes
        As above.
    whole : CompiledModel
        The same model with a longer state, longer parameters and a longer scratch array.
    """

    def __init__(self, plain: CompiledModel, lanes: int) -> None:
        self.plain, self.lanes = plain, lanes
        law, own = plain.law, plain.info.ny
        self.sizes = {
            "y": own,
            "ydot": own,
            "p": max(1, law.parameter_offset + len(law.parameters) + law.hoisted),
            "w": max(1, law.nw),
        }
        longer = {name: size * (1 + lanes) for name, size in self.sizes.items()}
        hoisted = longer["p"] - law.parameter_offset - len(law.parameters)
        modules = self._module(plain.model, _MODEL), self._module(plain.law_module, _LAW)
        self.whole: CompiledModel = plain.longer(own * lanes, hoisted, longer["w"], *modules)

    def _module(self, module: Any, names: dict[str, Any]) -> Any:
        functions = {name: self.function(getattr(module, name)) for name in names if hasattr(module, name)}
        return SimpleNamespace(**{**vars(module), **functions})

    def function(self, function: Any, length: int = 0) -> TangentFunction:
        """Return the form of an emitted function with directions.

        Parameters
        ----------
        function : EmittedFunction
            The function.
        length : int
            Length of its array ``out``, if it has one.

        Raises
        ------
        InputError
            Where nothing is compiled.
        """
        if not isinstance(function, EmittedFunction):
            raise InputError("sensitivities", "compiled functions", "NUMBA_DISABLE_JIT, where plain Python runs")
        return _directed(function, self.lanes, tuple(sorted((self.sizes | {"out": length}).items())))

    def longer(self, array: Array, name: str, directions: Array | None = None) -> Array:
        """Return an array with room for its directions, zeros if not given, shape (n, L)."""
        size = self.sizes[name]
        room = np.zeros(size * (1 + self.lanes))
        room[:size] = array[:size]
        if directions is not None:
            room[size:] = directions.ravel()
        return room

    def shadow(self, array: Array, name: str) -> Array:
        """Return the directions behind an array, or behind those in rows, shape (..., n, L)."""
        size = self.sizes[name]
        return array[..., size : size * (1 + self.lanes)].reshape(*array.shape[:-1], size, self.lanes)

    def parameters(self, p: Array, directions: Array) -> Array:
        """Return parameters with directions, and the numbers that follow them."""
        longer = self.longer(p, "p", directions)
        self.whole.prepare(longer)
        return longer

    def scratch(self, p: Array, w: Array) -> Array:
        """Return scratch with directions: masses follow parameters with directions."""
        longer = self.longer(w, "w")
        self.caller("masses", self.whole.model.masses)(p, longer)
        return longer

    @staticmethod
    def caller(name: str, function: TangentFunction) -> Callable[..., Any]:
        """Return a function of model or law for calls from Python."""
        return function.caller((_MODEL | _LAW)[name].signature.arguments)


@functools.lru_cache(maxsize=256)
def _directed(function: EmittedFunction, lanes: int, places: tuple[tuple[str, int], ...]) -> TangentFunction:
    """Return the form of a function with directions, the same one for all runs."""
    return TangentFunction(function, lanes, dict(places))


@dataclass(frozen=True)
class Part:
    """A run with as many directions as its code takes.

    Attributes
    ----------
    model : DirectedModel
        Its code.
    outcome : Outcome
        Outcome of the longer state.
    """

    model: DirectedModel
    outcome: Outcome

    @property
    def states(self) -> Array:
        """Directions of the state at the outputs, shape (k, ny, L)."""
        return self.model.shadow(self.outcome.states, "y")

    @property
    def end(self) -> Array:
        """Directions of the last accepted state, shape (ny, L)."""
        return self.model.shadow(self.outcome.simulation.state.y, "y")


@dataclass(frozen=True)
class Course:
    """A run with directions at its outputs.

    Attributes
    ----------
    outcome : Outcome
        As of a run without directions.
    parts : tuple of Part
        The loops, each with some of the directions.
    count : int
        Number of directions.
    """

    outcome: Outcome
    parts: tuple[Part, ...]
    count: int

    def gathered(self, of: Callable[[Part], Array]) -> Array:
        """Return the directions of all parts beside each other, along the last axis."""
        return np.concatenate([of(part) for part in self.parts], axis=-1)[..., : self.count]

    @cached_property
    def states(self) -> Array:
        """Directions of the state at the outputs, shape (k, ny, n)."""
        return self.gathered(lambda part: part.states)


def lanes_of(count: int) -> int:
    """Return the number of directions that code is made for, for a number of them."""
    return next((lanes for lanes in LANES if lanes >= count), LANES[-1])


def run_with_directions(
    compiled: CompiledModel,
    integrator: Integrator,
    start: Start,
    spec: RunSpec,
    seeds: Seeds,
    progress: Progress | None = None,
) -> Course:
    """Integrate with directions; those that one loop does not take are further runs of the same steps.

    Parameters
    ----------
    compiled, integrator, start, spec, progress
        As for `symgen.runs.run.integrate`.
    seeds : Seeds
        Directions at the start.
    """
    model, parts = DirectedModel(compiled, lanes_of(seeds.count)), list[Part]()
    for first in range(0, seeds.count, model.lanes):
        own = seeds.part(first, model.lanes)
        p = model.parameters(start.p, own.p)
        begun = replace(start, y=model.longer(start.y, "y", own.y), p=p, w=model.scratch(p, start.w))
        outcome = completed(Simulation(model.whole, integrator, begun, spec), progress)
        parts.append(Part(model, outcome))
        progress = None
        if outcome.interrupted:
            break
    return Course(_plain(parts[0], integrator, start, spec), tuple(parts), seeds.count)


def _plain(part: Part, integrator: Integrator, start: Start, spec: RunSpec) -> Outcome:
    """Return the outcome of a run with directions as one of a run without them."""
    outcome, sizes, compiled = part.outcome, part.model.sizes, part.model.plain
    simulation, longer = Simulation(compiled, integrator, start, spec), outcome.simulation
    state = longer.state._asdict()
    for name, array in simulation.state._asdict().items():
        if name in ("y", "p", "w"):
            array[: sizes[name]] = state[name][: sizes[name]]
        elif name in ("iw", "clock", "gauges", "control", "passages"):
            array[:] = state[name]
    # what a scheme keeps of past steps has another layout
    simulation.state.control[abi.BEGUN] = abi.AFRESH
    return replace(
        outcome,
        compiled=compiled,
        start=start,
        states=np.ascontiguousarray(outcome.states[:, : sizes["y"]]),
        p=simulation.state.p,
        w=simulation.state.w,
        held=tuple((t, p[: sizes["p"]]) for t, p in outcome.held),
        simulation=simulation,
    )


@dataclass(frozen=True)
class Observer:
    """Functions of the motion at outputs, with directions.

    Parameters
    ----------
    model : DirectedModel
        The code.
    times, states : Array, shapes (k,), (k, longer ny)
        Outputs and their states with directions.
    windings : Array
        Angles that count turns at the outputs.
    pieces : tuple of (float, Array)
        Parameters with directions of earlier pieces of the run, each with the last time at which it holds, then those
        of the last one.
    w : Array
        Scratch with directions.
    """

    model: DirectedModel
    times: Array
    states: Array
    windings: Array
    pieces: tuple[tuple[float, Array], ...]
    w: Array

    def _here(self, k: int) -> tuple[float, Array, Array]:
        """Return time, state and parameters of an output."""
        p = next(p for until, p in self.pieces if self.times[k] <= until)
        return float(self.times[k]), self.states[k].copy(), p

    @cached_property
    def rates(self) -> tuple[Array, Array]:
        """Rates of the state and the scratch at the outputs, with directions, shapes (k, longer ny), (k, longer nw)."""
        model, law = self.model, self.model.whole.law_module
        rates, confirm = rate_functions(law)
        accept, rates, confirm = (
            f.caller(kind.signature.arguments)
            for f, kind in ((law.accept, abi.ACCEPT), (rates, abi.RHS), (confirm, abi.RHS))
        )
        w, iw = self.w.copy(), np.zeros(abi.N_COUNTERS, dtype=np.int64)
        found, kept = np.zeros_like(self.states), np.zeros((len(self.times), len(w)))
        ydot = np.zeros(model.sizes["y"] * (1 + model.lanes))
        for k in range(len(self.times)):
            t, y, p = self._here(k)
            self._wind(w, k)
            accept(t, y, p, w, iw)
            if rates(t, y, p, w, iw, ydot) != 0:
                confirm(t, y, p, w, iw, ydot)
            found[k], kept[k] = ydot[: found.shape[1]], w
        return found, kept

    def _wind(self, w: Array, k: int) -> None:
        """Set the angles that count turns to their values at an output."""
        w[abi.WINDING : abi.WINDING + self.windings.shape[1]] = self.windings[k]

    def observed(self, function: Any, length: int) -> tuple[Array, Array]:
        """Return the values of a function of the motion and their directions, shapes (k, length), (k, length, L).

        Parameters
        ----------
        function : compiled function
            Of type `symgen.layout.abi.OBSERVE`.
        length : int
            Number of values that it writes.
        """
        call = self.model.function(function, length).caller(abi.OBSERVE.signature.arguments)
        rates, scratch = self.rates
        out, lanes = np.zeros((len(self.times), length * (1 + self.model.lanes))), self.model.lanes
        for k in range(len(self.times)):
            t, y, p = self._here(k)
            call(t, y, p, scratch[k].copy(), rates[k].copy(), out[k])
        return out[:, :length], out[:, length:].reshape(len(self.times), length, lanes)

    def violations(self) -> Array:
        """Return the largest derivative of a row of Phi at the outputs in each direction, shape (k, L)."""
        model = self.model
        info = model.plain.info
        first, _ = info.sections["residual"]
        holonomic = [first + i for i, row in enumerate(info.rows) if row.holonomic]
        found = np.zeros((len(self.times), model.lanes))
        for k in range(len(self.times)):
            t, y, p = self._here(k)
            w = self.w.copy()
            self._wind(w, k)
            model.caller("geometry", model.whole.model.geometry)(t, y, p, w)
            found[k] = np.abs(model.shadow(w, "w")[holonomic]).max(axis=0, initial=0.0)
        return found

"""Steps of explicit schemes with directions, in one call of a compiled loop (`symgen.run.loops.ahead`)."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from symgen.compile.loopcode.entry import LoopEntry, loop_entry
from symgen.run.directions.directed_model import DirectedModel, Seeds
from symgen.run.loops import ahead
from symgen.run.loops.ahead import Ahead
from symgen.run.single.simulation import Simulation

if TYPE_CHECKING:
    from symgen.run.layout.records import Span
    from symgen.run.loops.integrator import Integrator
    from symgen.run.loops.run_spec import RunSpec
    from symgen.run.starts.assembly import Start

Array = NDArray[np.float64]
Before = Mapping[str, NDArray[Any]]

_END, _LENGTH = ahead.END, ahead.LENGTH  # looked up at every step
#: Arrays of the state before, without directions.
_FROM = ("y", "p", "w", "iw", "clock", "gauges", "control")
#: Arrays of twice the length of a state.
_SCALES = ("share", "metric", "scales")


class DirectedRun:
    """A run with directions, whose loop steps ahead enter.

    Parameters
    ----------
    model : DirectedModel
        The code.
    integrator, start, spec
        As for `Simulation`, without directions and without events.
    seeds : Seeds
        Directions of the states, then of inputs.
    places, inputs : sequence of int
        Places of the states in y, and of the inputs in p.
    outputs : EmittedFunction or None
        Function of outputs.
    count : int
        Number of outputs.
    """

    def __init__(
        self,
        model: DirectedModel,
        integrator: Integrator,
        start: Start,
        spec: RunSpec,
        seeds: Seeds,
        places: Sequence[int],
        inputs: Sequence[int],
        outputs: object,
        count: int,
    ) -> None:
        y, p, w = (
            model.room_with_directions(array, name) for array, name in ((start.y, "y"), (start.p, "p"), (start.w, "w"))
        )
        self.simulation = Simulation(model.whole, integrator, replace(start, y=y, p=p, w=w, saved=None), spec)
        self.model, self.count, self.seeds = model, count, seeds
        self.observe = ahead.observe_nothing_ahead if outputs is None else model.function(outputs, count)
        self.passes = [seeds.seeds_of_part(first, model.lanes) for first in range(0, seeds.count, model.lanes)]
        self.places, self.inputs = np.array(places, dtype=np.int64), np.array(inputs, dtype=np.int64)
        self.numbers_by = np.concatenate([part.p.ravel() for part in self.passes])
        self.seeds_of_y = np.concatenate([part.y.ravel() for part in self.passes])
        self.still = np.zeros(
            sum(map(len, (self.simulation.state.y, self.simulation.state.p, self.simulation.state.w)))
        )
        self.room = np.zeros(len(self.simulation.state.y) + count * (1 + model.lanes))

    def rescale(self, before: Before) -> None:
        """Take up the scales of a run, by which adaptive steps are chosen."""
        state, short = self.simulation.state, len(before["y"])
        long = len(state.y)
        for name in _SCALES:
            array, own = getattr(state, name), before[name]
            array[:short], array[long : long + short] = own[:short], own[short:]


class StepsAhead:
    """Steps ahead of a state, with their derivatives.

    Parameters
    ----------
    run : DirectedRun
        The run with directions.
    before : mapping of str to array
        Arrays of the state before, read at each call, of a run without directions.
    steps : int
        Number of steps.
    end : Array, optional
        The state after the one step, which has to be the same; nothing is written to `before` then.
    same : float
        Part of the state by which it may differ.

    Attributes
    ----------
    states, slopes, by_outputs : Array, shapes (steps, n), (steps, n, k), (steps, outputs, k)
        Results of the last call.
    values : Array, shape (steps, inputs)
        Inputs of each step, where the end is not compared.
    """

    def __init__(
        self, run: DirectedRun, before: Before, steps: int = 1, end: Array | None = None, same: float = 0.0
    ) -> None:
        model, simulation, n = run.model, run.simulation, len(run.places)
        width = len(run.passes) * model.lanes
        self._run, self.steps = run, steps
        self.states, self.slopes = np.zeros((steps, n)), np.zeros((steps, n, width))
        self.by_outputs = np.zeros((steps, run.count, width))
        self.values = np.zeros((0 if end is not None else steps, len(run.inputs)))
        head = [steps, len(run.passes), model.lanes, run.count, simulation.spec.adaptive, end is not None]
        own = {name: before[name][: model.sizes.get(name)] for name in _FROM}
        numbers = np.array([0.0, 0.0, same])
        self._numbers: Any = memoryview(numbers.data)  # written faster than the array is
        self._record = Ahead(
            head=np.array(head, dtype=np.int64),
            numbers=numbers,
            **own,
            end=np.zeros(0) if end is None else end[: model.sizes["y"]],
            places=run.places,
            inputs=run.inputs,
            values=self.values.ravel(),
            seeds=run.seeds_of_y,
            numbers_by=run.numbers_by,
            states=self.states.ravel(),
            slopes=self.slopes.ravel(),
            by_outputs=self.by_outputs.ravel(),
            still=run.still,
            room=run.room,
        )
        self._entry = self._make_step()

    def _make_step(self) -> LoopEntry:
        simulation, whole, directed = self._run.simulation, self._run.model.whole, self._run
        functions = simulation.setup.loop, whole.model.prepare, whole.law_module.prepare, directed.observe
        model = (simulation._model, self._record, *functions)
        arguments = model, simulation.scheme, simulation.span, simulation.state, simulation.outputs(np.zeros(0))
        entry = loop_entry(ahead.loop_ahead_of(simulation.setup.loop), arguments)
        assert entry is not None, "directions are compiled"
        return entry

    def make_steps(self, span: Span, end: float, length: float = 0.0) -> int:
        """Make the steps; return the code of their end.

        Parameters
        ----------
        span : Span
            Steps and tolerances of the run.
        end, length : float
            End of the first step, and the length of further ones [s].
        """
        entry, scheme, numbers = self._entry, self._run.simulation.scheme, self._numbers
        numbers[_END], numbers[_LENGTH] = end, length
        if not entry.has(scheme, span):
            entry.take(scheme, span)
        return entry(end, math.inf, math.inf)

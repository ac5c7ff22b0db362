"""Runs with directions: derivatives of the state by numbers beside it, through the same steps.

The arrays are longer: ``y`` is followed by L directions of each of its elements, and so are the parameters ``p`` and
the scratch ``w``. Emitted functions have a form with directions (`symgen.compile.native.tangents`); loops and explicit
schemes, which are linear in the state, stay as they are. Error control ignores directions, so a run without them takes
the same steps.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from symgen.run.directions.directed_model import DirectedModel, Seeds, lanes_for_directions
from symgen.run.directions.direction_errors import (
    StepErrors,
    begin_estimates,
    errors_so_far,
    step_errors,
    with_error_estimates,
)
from symgen.run.directions.moments import Moments
from symgen.run.directions.passages import PassingSimulation, RunPassage
from symgen.run.directions.reset_directions import events_at_start
from symgen.run.directions.transfer import Transfer
from symgen.run.layout import abi
from symgen.run.single.run import Progress, complete_run
from symgen.run.single.simulation import Simulation

if TYPE_CHECKING:
    from symgen.run.layout.compiled import CompiledModel
    from symgen.run.loops.integrator import Integrator
    from symgen.run.loops.run_spec import RunSpec
    from symgen.run.single.outcome import Outcome
    from symgen.run.starts.assembly import Start

Array = NDArray[np.float64]


@dataclass(frozen=True)
class DirectedPart:
    """A run with as many directions as its code takes.

    Attributes
    ----------
    model : DirectedModel
        Its code.
    outcome : Outcome
        Outcome of the longer state.
    doubts : sequence of str
        Why directions after events are in doubt.
    modes : sequence of (float, Array)
        Directions of the numbers of modes, each with the last time at which they hold.
    """

    model: DirectedModel
    outcome: Outcome
    doubts: Sequence[str] = ()
    modes: Sequence[tuple[float, Array]] = ()

    @property
    def states(self) -> Array:
        """Directions of the state at the outputs, shape (k, ny, L)."""
        return self.model.directions_after(self.outcome.states, "y")

    @property
    def end(self) -> Array:
        """Directions of the last accepted state, shape (ny, L)."""
        return self.model.directions_after(self.outcome.simulation.state.y, "y")


@dataclass(frozen=True)
class DirectedCourse:
    """A run with directions at its outputs.

    Attributes
    ----------
    outcome : Outcome
        As of a run without directions.
    parts : tuple of DirectedPart
        The loops, each with some of the directions.
    count : int
        Number of directions.
    """

    outcome: Outcome
    parts: tuple[DirectedPart, ...]
    count: int

    @property
    def doubts(self) -> tuple[str, ...]:
        """Why directions after events are in doubt."""
        return tuple(doubt for part in self.parts for doubt in part.doubts)

    def directions_side_by_side(self, of: Callable[[DirectedPart], Array]) -> Array:
        """Return the directions of all parts beside each other, along the last axis."""
        return np.concatenate([of(part) for part in self.parts], axis=-1)[..., : self.count]

    @cached_property
    def states(self) -> Array:
        """Directions of the state at the outputs, shape (k, ny, n)."""
        return self.directions_side_by_side(lambda part: part.states)

    @cached_property
    def errors(self) -> StepErrors | None:
        """Errors of directions in steps; None for constant steps, which have no estimate."""
        return step_errors([part.outcome.simulation for part in self.parts], self.count)


class DirectedSimulation(PassingSimulation):
    """A run with directions, which go through its passages.

    Parameters
    ----------
    model : DirectedModel
        The code.
    integrator, start, spec
        As for `Simulation`, of the longer state.
    seeds : Array, shape (np, L)
        Directions of the parameters.

    Attributes
    ----------
    transfer : Transfer
        Takes directions through passages.
    modes : list of (float, Array)
        Directions of the numbers of modes before each passage, with its time.
    """

    def __init__(self, model: DirectedModel, integrator: Any, start: Start, spec: RunSpec, seeds: Array) -> None:
        super().__init__(model.whole, integrator, start, spec)
        self.directed = model
        columns = np.hstack([seeds, np.zeros((len(seeds), 1))])
        self.transfer = Transfer(Moments(model.plain, columns), spec)
        self.modes = list[tuple[float, Array]]()
        self._errors, self._begins = np.zeros(0), False

    @property
    def plain(self) -> CompiledModel:
        """The model without directions."""
        return self.directed.plain

    @property
    def place(self) -> slice:
        """Place of the numbers of modes in the scratch array."""
        return self.transfer.moments.place_of_modes()

    def _shorten_step(self) -> None:
        super()._shorten_step()
        if self._slips is None or not self.spec.adaptive:
            return
        began, self._begins = self._begins, self._slips.begins(self._slips.moments.plain(self._present_moment()))
        if len(self._errors) and (began or self._begins):
            errors_so_far(self)[:] = self._errors  # what steps leave across slip decays as soon as it moves
        elif self.span.largest < self._longest or not len(self._errors):
            self._errors = errors_so_far(self).copy()

    def note_passed(self, passage: RunPassage) -> None:
        """Take the directions through a passage."""
        if self._slips is not None and len(self._errors) and self._slips.ended(passage.before, passage.after):
            errors_so_far(self)[:] = self._errors  # what the last step has left across slip goes
        model, state = self.directed, self.state
        y, w = (model.directions_after(x, name) for x, name in ((passage.before.y, "y"), (passage.before.w, "w")))
        place = self.place
        after, modes = self.transfer.transfer_through(passage, y, w[place])
        model.directions_after(state.y, "y")[:] = after
        model.directions_after(state.w, "w")[place] = modes
        self.modes.append((passage.before.t, w[place].copy()))


def run_with_directions(
    compiled: CompiledModel,
    integrator: Integrator,
    start: Start,
    spec: RunSpec,
    seeds: Seeds,
    progress: Progress | None = None,
) -> DirectedCourse:
    """Integrate with directions; those that one loop does not take are further runs of the same steps.

    Parameters
    ----------
    compiled, integrator, start, spec, progress
        As for `symgen.run.single.run.integrate`.
    seeds : Seeds
        Directions at the start.
    """
    model, parts = DirectedModel(compiled, lanes_for_directions(seeds.count)), list[DirectedPart]()
    for first in range(0, seeds.count, model.lanes):
        own = seeds.seeds_of_part(first, model.lanes)
        p = model.parameters(start.p, own.p)
        initial = replace(start, y=model.room_with_directions(start.y, "y", own.y), p=p, w=model.scratch(p, start.w))
        doubts = events_at_start(spec, model, initial)
        scheme = with_error_estimates(integrator, spec, model.lanes)
        simulation = DirectedSimulation(model, scheme, initial, spec, own.p)
        begin_estimates(simulation, model.sizes["y"])
        outcome = complete_run(simulation, progress)
        modes = *simulation.modes, (np.inf, model.directions_after(simulation.state.w, "w")[simulation.place].copy())
        parts.append(DirectedPart(model, outcome, (*doubts, *simulation.transfer.doubts), modes))
        progress = None
        if outcome.interrupted:
            break
    return DirectedCourse(_plain_outcome(parts[0], integrator, start, spec), tuple(parts), seeds.count)


def _plain_outcome(part: DirectedPart, integrator: Integrator, start: Start, spec: RunSpec) -> Outcome:
    """Return the outcome of a run with directions as one of a run without them."""
    outcome, sizes, compiled = part.outcome, part.model.sizes, part.model.plain
    simulation, longer = Simulation(compiled, integrator, start, spec), outcome.simulation
    state = longer.state._asdict()
    for name, array in simulation.state._asdict().items():
        if name in ("y", "p", "w"):
            array[: sizes[name]] = state[name][: sizes[name]]
        elif name in ("iw", "clock", "gauges", "control", "passages"):
            array[:] = state[name]
    # a scheme's memory of past steps has another layout
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

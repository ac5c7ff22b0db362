"""Quantities of a run with directions, at its outputs: directions of states, rates and functions of bodies."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Protocol

import numpy as np
from numpy.typing import NDArray

from symgen.base.ir.program import MODE_NUMBERS
from symgen.describe.parts.event_sections import STOP
from symgen.result.step_errors import rounding_sizes
from symgen.run.directions.directed_model import DirectedModel
from symgen.run.directions.directed_observer import Observer
from symgen.run.directions.directions import DirectedCourse, DirectedPart
from symgen.run.layout import abi
from symgen.run.modes.bounded_rows import CONSTANT, HELD, SIGN
from symgen.run.planning.prepare import Prepared

if TYPE_CHECKING:
    from symgen.run.layout.compiled import CompiledModel
    from symgen.run.planning.named_directions import RunDirection
    from symgen.run.single.outcome import Outcome

Array = NDArray[np.float64]


class SeedsOfParameters(Protocol):
    """Directions by name, with directions of parameters."""

    @property
    def directions(self) -> tuple[RunDirection, ...]:
        """The directions."""

    def parameters(self, compiled: CompiledModel) -> Array:
        """Return the directions of the array of parameters of a model, shape (np, n)."""


@dataclass(frozen=True)
class Evaluated:
    """Evaluates quantities of a run with directions.

    Parameters
    ----------
    run : Prepared
        The run.
    start : SeedsOfParameters
        Its directions.
    course : Course
        What its loops left.
    """

    run: Prepared
    start: SeedsOfParameters
    course: DirectedCourse

    @cached_property
    def observers(self) -> tuple[Observer, ...]:
        """The motion of bodies with directions, one for each loop."""
        parts = self.course.parts
        if self.run.tree is None:
            return tuple(self._motion_of_part(part) for part in parts)
        return tuple(self._motion_of_carried(part, k * part.model.lanes) for k, part in enumerate(parts))

    def _motion_of_part(self, part: DirectedPart) -> Observer:
        outcome, info = part.outcome, part.model.plain.info
        windings = outcome.status_columns[:, abi.N_STATUS : abi.N_STATUS + info.kept]
        pieces = (*outcome.held, (np.inf, outcome.p))
        return Observer(part.model, outcome.times, outcome.states, windings, pieces, outcome.w, part.modes)

    def _motion_of_carried(self, part: DirectedPart, first: int) -> Observer:
        """Return the motion of bodies that joints carry."""
        tree = self.run.tree
        assert tree is not None, "the state is that of joints"
        info, own, lanes = tree.bodies.info, part.model.plain.info, part.model.lanes
        values, slopes = self._motion_of_part(part).observe_directions(
            tree.compiled.model.bodies, info.nq + 2 * info.nv
        )
        model, k = DirectedModel(tree.bodies, lanes), len(values)
        states, directions = np.zeros((k, info.ny)), np.zeros((k, info.ny, lanes))
        states[:, : info.work], directions[:, : info.work] = values[:, : info.work], slopes[:, : info.work]
        states[:, : info.nq] *= tree.signs
        directions[:, : info.nq] *= tree.signs[:, np.newaxis]
        behind = part.model.sizes["y"]
        states[:, info.work :] = part.outcome.states[:, own.work : behind]
        directions[:, info.work :] = part.states[:, own.work :]
        carried = self._motion
        seeds = self._parameters[:, first : first + lanes]
        room = np.zeros((len(seeds), lanes))
        room[:, : seeds.shape[1]] = seeds
        pieces = tuple((t, model.parameters(p, room)) for t, p in (*carried.held, (np.inf, carried.p)))
        longer = np.concatenate([states, directions.reshape(k, -1)], axis=1)
        windings = carried.status_columns[:, abi.N_STATUS : abi.N_STATUS + info.kept]
        w = model.scratch(pieces[-1][1], carried.w)
        return Observer(model, part.outcome.times, longer, windings, pieces, w, part.modes)

    @cached_property
    def _motion(self) -> Outcome:
        """The outcome as the motion of bodies that joints carry."""
        assert self.run.tree is not None, "the state is that of joints"
        return self.run.tree.carry_outcome(self.course.outcome)

    @cached_property
    def _parameters(self) -> Array:
        """Directions of the parameters of bodies that joints carry, shape (np, n)."""
        assert self.run.tree is not None, "the state is that of joints"
        return self.start.parameters(self.run.tree.bodies)

    def directions_side_by_side(self, of: Callable[[Observer], Array]) -> Array:
        """Return directions of all loops beside each other, along the last axis."""
        return np.concatenate([of(x) for x in self.observers], axis=-1)[..., : self.course.count]

    def states(self) -> Array:
        """Return the directions of the states of bodies at the outputs, shape (k, ny, n)."""
        return self.directions_side_by_side(lambda x: x.model.directions_after(x.states, "y"))

    def rates(self) -> Array:
        """Return the directions of the rates of these states."""
        return self.directions_side_by_side(lambda x: x.model.directions_after(x.rates[0], "y"))

    def function(self, function: object, length: int) -> Array:
        """Return the directions of a function of the motion of bodies, shape (k, length, n)."""
        return self.directions_side_by_side(lambda x: x.observe_directions(function, length)[1])

    def energies(self) -> Array:
        """Return the directions of kinetic and potential energy, shape (k, n, 2)."""
        return np.moveaxis(self.directions_side_by_side(lambda x: x.observe_energies()), 1, 2)

    def directions_of_end(self) -> Array | None:
        """Return the directions of the time at which an event ended the run, shape (n,); None where none did."""
        watched, outcome = self.run.spec.events, self.course.outcome
        stops = [x.name for x in outcome.happened if x.action == STOP and x.t == outcome.end]
        if watched is None or not stops or outcome.code != abi.DONE:
            return None
        count, at = len(watched.names) + len(watched.switches), watched.names.index(stops[0])
        parts = list[Array]()
        for part in self.course.parts:
            state, info = part.outcome.simulation.state, part.model.whole.info
            windings = state.w[np.newaxis, abi.WINDING : abi.WINDING + info.kept]
            here = np.array([outcome.end]), state.y[np.newaxis, : info.ny], windings
            observer = Observer(part.model, *here, ((np.inf, state.p),), state.w)
            values, slopes = observer.observe_directions(watched.function, 3 * count)
            # at an event that grazes, its time has no derivative
            with np.errstate(divide="ignore", invalid="ignore"):
                parts.append(-slopes[0, at] / values[0, count + at])
        return np.concatenate(parts)[: self.course.count]

    def resting_together(self) -> tuple[str, ...]:
        """Return the rows with two bounds that share forces at rest at some output, which joints do not determine."""
        watched = self.run.spec.events
        rows = None if watched is None else watched.bounded
        if rows is None or not len(self.course.outcome.times):
            return ()
        info = self.course.parts[0].model.plain.info
        first = abi.N_STATUS + info.windings
        modes = self.course.outcome.status_columns[:, first : first + MODE_NUMBERS * len(info.switchable)]
        lines = modes.reshape(len(modes), len(info.switchable), MODE_NUMBERS)
        own = lines[:, [info.switchable.index(row) for row in info.bounded[: rows.dry]]]
        rests = (own[:, :, HELD] != 0.0) | ((own[:, :, CONSTANT] != 0.0) & (own[:, :, SIGN] == 0.0))
        carried = (rests & (own[:, :, HELD] == 0.0)).any(axis=1)
        return tuple(name for name, x in zip(rows.names, rests[carried].any(axis=0), strict=False) if x)

    def distance_from_constraints(self) -> Array:
        """Return by how much directions leave the constraints, over their size, shape (n,); rounding is left out."""
        parts = [(part.model, self._motion_of_part(part)) for part in self.course.parts]
        gaps, first, least = list[Array](), 0, rounding_sizes(self)[:, 0]
        for model, observer in parts:
            sizes = np.abs(model.directions_after(observer.states, "y")[:, : model.plain.info.nq]).max(
                axis=(0, 1), initial=0.0
            )
            largest = observer.violations_of_directions().max(axis=0, initial=0.0)
            own = np.zeros_like(largest)
            own[: len(least) - first] = least[first : first + model.lanes]
            gaps.append(np.where(largest > own, largest / np.where(sizes > 0.0, sizes, 1.0), 0.0))
            first += model.lanes
        return np.concatenate(gaps)[: self.course.count]

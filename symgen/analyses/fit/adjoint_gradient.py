"""One number at the end of a run with its derivatives by the adjoint: one run and one way back, for any number of them.

The number is differentiated by the last state with the directions of results, and the way back ends in adjoints of the
start, the parameters and the scratch. These times the directions of the start are the derivatives.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from symgen.base.errors import AnalysisError
from symgen.compile.store.stats import CPU_CLOCK
from symgen.result.build import build_result
from symgen.result.evaluated import Evaluated
from symgen.result.sensitivities import Sensitivities, doubt_of_motion, place_of_column, prepare_for_directions
from symgen.run.directions.adjoint import Adjoint, run_for_adjoint
from symgen.run.directions.directed_model import DirectedModel, Seeds, lanes_for_directions
from symgen.run.directions.directions import DirectedCourse, DirectedPart, run_with_directions
from symgen.run.directions.kept_stages import Uncovered
from symgen.run.layout import abi
from symgen.run.planning.moving_breaks import with_moving_kinks
from symgen.run.planning.named_directions import RunDirection, named_directions
from symgen.run.planning.start_directions import StartDirections

if TYPE_CHECKING:
    from symgen.base.settings import Settings
    from symgen.describe.mechanism import Mechanism
    from symgen.result.result import Result
    from symgen.run.layout.compiled import CompiledModel
    from symgen.run.planning.prepare import Prepared

Array = NDArray[np.float64]

#: Plain runs that an adjoint costs, and a run with L directions beyond one: `docs/tables/sensitivities.md`.
COST, COST_OF_DIRECTION = 3.0, 0.25
#: Most operations of a right-hand side whose adjoint is compiled without being wanted: more take ten seconds.
LARGEST = 5000
#: Directions of the run that examines whether steps are short enough.
MIXES = 4


def is_cheaper(count: int) -> bool:
    """Whether the adjoint costs less than forward directions for a number of derivatives."""
    lanes = lanes_for_directions(count)
    return -(-count // lanes) * (1.0 + COST_OF_DIRECTION * lanes) > COST


@dataclass(frozen=True)
class EndDirections:
    """Directions of the end of a run: of named numbers with the state as it is, then of each element of the state.

    Parameters
    ----------
    start : StartDirections
        Directions of the start.
    compiled : CompiledModel
        Code in the coordinates of the state.
    """

    start: StartDirections
    compiled: CompiledModel

    @property
    def directions(self) -> tuple[RunDirection, ...]:
        """Names."""
        states = (RunDirection(f"state {i}", "", "state", str(i)) for i in range(self.compiled.info.ny))
        return *self.start.directions, *states

    def parameters(self, compiled: CompiledModel) -> Array:
        """Return the directions of the array of parameters of a model."""
        own = self.start.parameters(compiled)
        return np.hstack([own, np.zeros((len(own), self.compiled.info.ny))])

    def course_of_run(self, adjoint: Adjoint) -> DirectedCourse:
        """Return the end of a run with these directions."""
        outcome, ny, n = adjoint.outcome, self.compiled.info.ny, self.start.count
        seeds = Seeds(np.hstack([np.zeros((ny, n)), np.eye(ny)]), self.parameters(self.compiled))
        model, parts = DirectedModel(self.compiled, lanes_for_directions(n + ny)), list[DirectedPart]()
        for first in range(0, seeds.count, model.lanes):
            own = seeds.seeds_of_part(first, model.lanes)
            p = model.parameters(outcome.p, own.p)
            state = model.room_with_directions(outcome.states[-1], "y", own.y)
            parts.append(
                DirectedPart(model, replace(outcome, states=state[np.newaxis], p=p, w=model.scratch(p, outcome.w)))
            )
        return DirectedCourse(outcome, tuple(parts), seeds.count)


@dataclass(frozen=True)
class Mixed:
    """Few directions that have a part of each named number.

    Parameters
    ----------
    start : StartDirections
        Directions of the start.
    factors : Array, shape (n, k)
        Of the numbers in each direction.
    """

    start: StartDirections
    factors: Array

    @property
    def directions(self) -> tuple[RunDirection, ...]:
        """Their names: of the numbers that have a part."""
        names = np.array([d.name for d in self.start.directions])
        several = (names[part != 0.0].tolist() for part in self.factors.T)
        return tuple(RunDirection(x[0] if len(x) == 1 else f"{x[0]} to {x[-1]}", "", "state", x[0]) for x in several)

    def parameters(self, compiled: CompiledModel) -> Array:
        """Return the directions of the array of parameters of a model."""
        return self.start.parameters(compiled) @ self.factors


def doubt_of_course(run: Prepared, start: StartDirections, seeds: Seeds) -> str | None:
    """Return why derivatives by the adjoint are in doubt, by a run with directions; None where they are not.

    An adjoint goes back through steps that the state alone chose. Whether these are short enough for derivatives is
    seen forward, by the embedded estimates of few mixes of all directions; constant steps have none. Whether events are
    together for these numbers only is seen forward as well.
    """
    if not run.spec.adaptive and run.spec.events is None:
        return None
    p, n = run.start.p, seeds.count
    sizes = np.abs(seeds.p[p != 0.0] / p[p != 0.0, np.newaxis]).max(axis=0, initial=0.0)
    sizes = np.maximum(sizes, np.abs(seeds.y).max(axis=0, initial=0.0))
    factors, number = np.zeros((n, min(n, MIXES))), np.arange(n)
    factors[number, number * factors.shape[1] // n] = (1.0 - 2.0 * (number % 2)) / np.where(sizes > 0.0, sizes, 1.0)
    mixed = Seeds(seeds.y @ factors, seeds.p @ factors)
    course = run_with_directions(run.compiled, run.plan.integrator, run.start, run.spec, mixed)
    if course.doubts:
        return course.doubts[0]
    return Sensitivities(Evaluated(run, Mixed(start, factors), course), course.outcome).doubt_of_steps(run.spec)


@dataclass(frozen=True)
class AdjointGradient:
    """A number at the end of a run, and its derivatives.

    Attributes
    ----------
    value : float
        The number.
    unit : str
        Its unit.
    slopes : Array
        Derivatives, in the order of the names.
    memory : int
        Bytes of the stages of all steps.
    seconds : float
        Time of the run that keeps its stages, and of the way back [s].
    directions : tuple of RunDirection
        What it is differentiated by.
    run, result : Prepared, Result
        The run before and after it was made.
    """

    value: float
    unit: str
    slopes: Array
    memory: int
    seconds: float
    directions: tuple[RunDirection, ...]
    run: Prepared
    result: Result


def adjoint_gradient(
    where: str,
    mechanism: Mechanism,
    settings: Settings,
    column: str,
    keys: Mapping[str, str],
    quick: bool,
    pages: list[Array],
    checked: bool,
) -> AdjointGradient:
    """Return a column of results at the end of a run with its derivatives.

    Parameters
    ----------
    where : str
        Name of the method, for messages.
    mechanism, settings : Mechanism, Settings
        The model and how it runs: its last output is its end.
    column : str
        The column.
    keys : mapping of str to str
        What it is differentiated by, as typed, each with its name in the mechanism.
    quick : bool
        Whether code that takes long to compile is refused.
    pages : list of Array
        Memory of an earlier run of the same model, empty for the first one.
    checked : bool
        Whether a run with a direction examines the steps.

    Raises
    ------
    Uncovered
        If the run has no adjoint.
    """
    run, notes = prepare_for_directions(mechanism, settings)
    start = StartDirections(run, named_directions(run, keys))
    run = with_moving_kinks(run, start)
    if quick and run.compiled.law.operations.get("rhs", 0) > LARGEST:
        raise Uncovered("adjoint", f"at most {LARGEST} operations, as more take long to compile", "more")
    adjoint = run_for_adjoint(run.compiled, run.plan.integrator, run.start, run.spec, pages=pages)
    result = build_result(run, adjoint.outcome)
    if result.outcome.code != abi.DONE:
        raise AnalysisError(f"{where}: the run does not reach its end: {result.reason}")
    table, place, unit = place_of_column(result, column)
    ends = EndDirections(start, run.compiled)
    own = Sensitivities(Evaluated(run, ends, ends.course_of_run(adjoint)), result.outcome)
    by, n = own.table(table)[-1, place], start.count
    began = CPU_CLOCK()
    seeds = start.seeds()
    back, doubts = adjoint.derivatives_by_start(by[n:], seeds)
    slopes = by[:n] + back
    seconds = adjoint.outcome.cpu_seconds + CPU_CLOCK() - began
    if not np.all(np.isfinite(slopes)):
        raise Uncovered("adjoint", "slopes that are finite", "a formula without one in the part that is not taken")
    result = replace(result, notes=(*result.notes, *notes, *start.notes))
    doubt = doubt_of_motion(result) or (doubt_of_course(run, start, seeds) if checked or doubts else None)
    if result.status == "ok" and doubt:
        result = replace(result, status="unverified", reason=doubt)
    value = float(getattr(result, table).values[-1, place])
    return AdjointGradient(value, unit, slopes, adjoint.run.bytes_kept, seconds, start.directions, run, result)

"""The consistent start of a run in the coordinates of bodies."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from functools import cached_property, partial
from typing import TYPE_CHECKING

import numpy as np

from symgen.describe.bounds.by_reaction import pressed_rows
from symgen.describe.facts.balance import balance_rows
from symgen.describe.facts.lengths import origin_of_sizes
from symgen.describe.facts.sides import sided_joints, wrong_sides
from symgen.describe.formulas.evaluate import evaluate_formula, parameter_values, scalar_values
from symgen.describe.formulas.start import described_start, displacements_of_bodies
from symgen.describe.parts.holding_joints import refuse_other_start
from symgen.describe.parts.holds import read_holds
from symgen.run.compiling.mass_formulas import masses_of_starts
from symgen.run.compiling.pipeline import compile_model
from symgen.run.compiling.side import add_integrals
from symgen.run.layout import abi
from symgen.run.layout import ensemble_abi as e
from symgen.run.layout.model_arrays import marks_of_lengths
from symgen.run.layout.start_records import Instant
from symgen.run.starts.assembler import Assembly
from symgen.run.starts.assembly import Start, closed_start, closed_state, described_state
from symgen.run.starts.held import Held
from symgen.run.starts.kept import KeptStart
from symgen.run.starts.start_words import UndeterminedError, half_turn, opposite_sentence

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from symgen.describe.formulas.start import Scalars
    from symgen.describe.mechanism import Hold, Mechanism
    from symgen.run.compiling.method_choice import MethodChoice
    from symgen.run.layout.compiled import CompiledModel, ModelInfo
    from symgen.run.planning.plan import Plan
from symgen.run.planning.held_numbers import Indices, held_quantities, indices_of


def start_in_bodies(
    mechanism: Mechanism,
    compiled: CompiledModel,
    parameters: Mapping[str, float] | None = None,
    method_parameters: Mapping[str, float] | None = None,
    strict: bool = False,
    held: Held | Sequence[Hold] | None = None,
    ask_light: bool = False,
    near: NDArray[np.float64] | None = None,
) -> Start:
    """Return the consistent start of a run.

    Parameters
    ----------
    mechanism : Mechanism
        The description.
    compiled : CompiledModel
        Its compiled form for a method.
    parameters, method_parameters : mapping, optional
        Values of parameters that differ from the described ones, and from the method's defaults.
    strict, ask_light
        See `symgen.run.starts.assembly.assemble`.
    held : Held or sequence of Hold, optional
        Quantities that are held while all others move; by default those of the description.
    near : array, optional
        Coordinates that the mechanism is closed from; those that are described by default.

    Raises
    ------
    AssemblyError
        If the mechanism cannot be closed, or a joint closes the wrong way round.
    InputError
        If the start is refused; see `symgen.run.starts.assembly.assemble`.
    """
    described = DescribedStart(mechanism, compiled, parameters, method_parameters, strict, ask_light)
    return described.start(read_holds(mechanism) if held is None else held, near)


#: Values of what a start holds -> the start; None where it has to be reported on.
Again = Callable[[Sequence[float]], "Instant | None"]


class DescribedStart:
    """A mechanism with parameters, as it is described: starts differ in what they hold.

    Parameters
    ----------
    mechanism, compiled, parameters, method_parameters, strict, ask_light
        As for `start_in_bodies`.
    """

    def __init__(
        self,
        mechanism: Mechanism,
        compiled: CompiledModel,
        parameters: Mapping[str, float] | None = None,
        method_parameters: Mapping[str, float] | None = None,
        strict: bool = False,
        ask_light: bool = False,
    ) -> None:
        self.mechanism, self.compiled, self._options = mechanism, compiled, method_parameters or {}
        self._strict, self._ask_light = strict, ask_light
        self._kept = dict[tuple[tuple[int, ...], ...], KeptStart]()
        self.take_values(parameter_values(mechanism, parameters))

    def take_values(self, values: Mapping[str, float]) -> None:
        """Take other values of all parameters; code and memory of starts stay.

        Parameters
        ----------
        values : mapping of str to float
            All of them, those of formulas too.

        Raises
        ------
        InputError
            If a formula of the start has no value.
        """
        self._numbers = numbers = scalar_values(values)
        q, self._v = described_start(self.mechanism, numbers)
        self._q, self._velocities = np.array(q), np.array([np.nan if x is None else x for x in self._v])
        self._p = self.compiled.parameter_array(values, self._options)
        self._datum = origin_of_sizes(self.mechanism, numbers)
        for kept in self._kept.values():
            kept.take_parameters(self._p, self._datum)

    def start(self, holds: Held | Sequence[Hold], near: NDArray[np.float64] | None = None) -> Start:
        """Return a consistent start.

        Parameters
        ----------
        holds : Held or sequence of Hold
            Quantities that are held while all others move.
        near : array, optional
            Coordinates that the mechanism is closed from; those that are described by default.

        Raises
        ------
        AssemblyError, InputError
            As `start_in_bodies`.
        """
        mechanism, compiled, numbers = self.mechanism, self.compiled, self._numbers
        states = states_at_start(mechanism, numbers, () if isinstance(holds, Held) else holds)
        q = np.array(self._q if near is None else near, dtype=np.float64)
        held = holds if isinstance(holds, Held) else held_quantities(compiled.info, holds, numbers, self._v)
        assembly, reported = self._assembly(held), partial(displacements_of_bodies, mechanism, numbers)
        try:
            start = closed_start(assembly, held, assembly.close, q, self._v, self._p.copy(), reported, states)
        except UndeterminedError as error:
            if rows := balance_rows(mechanism, error.body):
                raise error.with_hint(f'springs alone hold it by a joint of type = "rows" with {rows}') from None
            raise
        if lines := _opposite_sides(mechanism, compiled.info, start.y):
            start = replace(start, warnings=(*start.warnings, *lines))
        return start

    def state(self, holds: Sequence[Hold]) -> tuple[Instant, bool]:
        """Return a start without reports, with the bits of `start`, and whether bodies are too light for the solver.

        Code and memory are kept for more starts that hold the same quantities.

        Raises
        ------
        AssemblyError, InputError
            As `start_in_bodies`.
        """
        mechanism, compiled, p = self.mechanism, self.compiled, self._p.copy()
        held = held_quantities(compiled.info, holds, self._numbers, self._v, self._indices)
        kept = self._kept_start(held)
        states = states_at_start(mechanism, self._numbers, holds)
        close, velocities = partial(kept.close, held), self._velocities.copy()
        y, w, summary = closed_state(compiled, held, close, self._q, velocities, p, states)
        _opposite_sides(mechanism, compiled.info, y)
        return Instant(y, p, w), bool(summary[e.LIGHT])

    def again(self, holds: Sequence[Hold], names: Sequence[str]) -> Again | None:
        """Return the function of starts that differ from one in the values of some held quantities.

        Parameters
        ----------
        holds : sequence of Hold
            Quantities that are held while all others move.
        names : sequence of str
            Those among them whose values are arguments.

        Returns
        -------
        function or None
            Values -> a start with the bits of `state`, in memory that the next call overwrites, or None where `state`
            has more to report. No function where a value is no coordinate or velocity.
        """
        mechanism, info, indices = self.mechanism, self.compiled.info, self._indices
        held = held_quantities(info, holds, self._numbers, self._v, indices)
        kept, velocities = self._kept_start(held), self._velocities.copy()
        velocities[list(held.velocities)] = list(held.velocities.values())
        numbers = np.array([*velocities, *held.targets])
        order = [*held.coordinates, *(("value", k) for k in held.joints), *(("rate", k) for k in held.rates)]
        places = list[int]()
        for name in names:
            of = name.removesuffix(".rate")
            if name in indices.velocities:
                places.append(indices.velocities[name])
            elif name in indices.coordinates:
                places.append(info.nv + order.index(indices.coordinates[name]))
            elif of in indices.joints:
                places.append(info.nv + order.index(("value" if of == name else "rate", indices.joints[of])))
            else:
                return None
        described = described_state(info, self._q, states_at_start(mechanism, self._numbers, holds))
        sides, v, targets = sided_joints(mechanism), numbers[: info.nv], numbers[info.nv :]

        def closed(values: Sequence[float]) -> Instant | None:
            numbers[places] = values
            now, summary = kept.enter(described, v, targets)
            if summary[e.START] != e.ASSEMBLED or summary[e.LIGHT] or any(side.cosine(now.y) < 0.0 for side in sides):
                return None
            return now

        return closed

    def _kept_start(self, held: Held) -> KeptStart:
        if (kept := self._kept.get(held.pattern)) is None:
            kept = self._kept[held.pattern] = KeptStart(self._assembly(held), self._p.copy())
        return kept

    @cached_property
    def _indices(self) -> Indices:
        return indices_of(self.compiled.info)

    def _assembly(self, held: Held) -> Assembly:
        masses = masses_of_starts(self.mechanism, self.compiled, bool(held.velocities or held.rates))
        return Assembly(self.compiled, held, self._strict, self._ask_light, datum=self._datum, masses=masses)


def states_at_start(mechanism: Mechanism, numbers: Scalars, holds: Sequence[Hold]) -> list[float]:
    """Return the values of the states of a file where a run begins: from `holds`, else as described."""
    refuse_other_start(mechanism, holds)
    held = {hold.name: hold.value for hold in holds}
    starts = [(x.name, held.get(x.name) or x.start) for x in mechanism.states]
    return [numbers.value(start, f"{mechanism.name}: states.{name}.start") for name, start in starts]


def _opposite_sides(mechanism: Mechanism, info: ModelInfo, y: NDArray[np.float64]) -> list[str]:
    """Return warnings where axes point opposite ways; refuse a start that holds a body the wrong way round."""
    lines = list[str]()
    for joint, held in wrong_sides(mechanism, y.tolist()):
        if held:
            raise half_turn(info, joint).with_coordinates(y.tolist())
        lines.append(opposite_sentence(joint))
    return lines


def compiled_for(mechanism: Mechanism, choice: MethodChoice) -> CompiledModel:
    """Return the compiled model of a run: with integrals after the work, where outputs have some."""
    return add_integrals(mechanism, compile_model(mechanism, choice))


#: Mechanism, method -> its compiled model, as `compiled_for` returns it.
Code = Callable[["Mechanism", "MethodChoice"], "CompiledModel"]


def begin_start(
    plan: Plan, near: NDArray[np.float64] | None = None, code: Code = compiled_for
) -> tuple[CompiledModel, Start]:
    """Compile a plan for the coordinates of bodies and close the mechanism.

    Where light bodies spoil the elimination of v' and the plan leaves the choice, the same law is solved with
    M + W D^T D instead, and a note says so.

    Parameters
    ----------
    plan : Plan
        The run.
    near : array, optional
        Coordinates that the mechanism is closed from.
    code : callable
        Returns the code of a mechanism for a method.
    """
    settings = plan.parameters, plan.method_parameters, plan.settings.strict

    def close_start(compiled: CompiledModel, ask_light: bool) -> Start:
        return start_in_bodies(plan.mechanism, compiled, *settings, plan.holds, ask_light, near)

    usual = code(plan.mechanism, plan.choice)
    compiled, start = close_with_light_bodies(plan, usual, close_start, code)
    if compiled is usual:
        return compiled, start
    note = "light bodies make D M^-1 D^T nearly singular: accelerations are solved with M + W D^T D"
    return compiled, replace(start, notes=(*start.notes, note))


def close_with_light_bodies(
    plan: Plan,
    compiled: CompiledModel,
    close: Callable[[CompiledModel, bool], Start],
    code: Code = compiled_for,
) -> tuple[CompiledModel, Start]:
    """Return a start with its code: the same law solved with M + W D^T D where light bodies require it.

    Parameters
    ----------
    plan : Plan
        The run; it says whether the choice is free.
    compiled : CompiledModel
        Its code.
    close : callable
        (code, whether light bodies are looked for) -> start.
    code : callable
        Returns the code of a mechanism for a method.
    """
    # laws of reactions need multipliers at once, which the other solver finds by iteration
    start = close(compiled, plan.solver_is_free and not pressed_rows(plan.mechanism))
    if not start.light:
        return compiled, start
    compiled = code(plan.mechanism, plan.choice.with_options(solver="augmented"))
    return compiled, close(compiled, False)


def open_start(plan: Plan) -> tuple[CompiledModel, Start]:
    """Compile a plan for the coordinates of bodies and take the mechanism as it is described, open.

    Parameters
    ----------
    plan : Plan
        The run.
    """
    mechanism, compiled = plan.mechanism, compiled_for(plan.mechanism, plan.choice)
    info, values = compiled.info, parameter_values(mechanism, plan.parameters)
    numbers = scalar_values(values)
    q, v = described_start(mechanism, numbers)
    y, w = np.zeros(info.ny), compiled.scratch()
    y[: info.nq] = q
    y[info.own_states] = states_at_start(mechanism, numbers, plan.holds or ())
    for i, value in held_quantities(info, plan.holds or read_holds(mechanism), numbers, v).coordinates.items():
        y[i] = value
    # the largest distance from the datum, or of a point in its body
    places = [x for body in mechanism.bodies for _, point in body.points for x in point]
    places += [x for _, marker in mechanism.seats for x in marker.point]
    sizes, datum = [abs(evaluate_formula(x, values, "points")) for x in places], origin_of_sizes(mechanism, numbers)
    w[abi.LENGTH] = (
        max(float((np.abs(y[: info.nq] - datum) * marks_of_lengths(info)).max(initial=0.0)), *sizes, 0.0) or 1.0
    )
    p = compiled.parameter_array(values, plan.method_parameters)
    compiled.prepare(p)
    return compiled, Start(y, p, w, 0, (), ())

"""From a mechanism and a plan to what a loop begins with: the compiled model and its consistent start."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import partial
from typing import TYPE_CHECKING, Any

import numpy as np

from symgen import __version__
from symgen.compiling.integrals import with_integrals
from symgen.compiling.pipeline import compile_model
from symgen.describe.evaluate import parameter_values, scalars
from symgen.describe.events import in_words
from symgen.describe.holds import ORIENTATION, holds_of
from symgen.describe.inputs import Driven, driven
from symgen.describe.moved import moved
from symgen.describe.sides import wrong_sides
from symgen.describe.start import described_start
from symgen.errors import InputError
from symgen.integrators._tableau import Tableau
from symgen.ir.program import FORMAT
from symgen.lower.windings import winding_order
from symgen.runtime.assembly import Start, assemble
from symgen.runtime.held import Held
from symgen.runtime.model_arrays import velocity_of
from symgen.runtime.new_state import is_as_kept
from symgen.runtime.pieces import Piece, pieces_of
from symgen.runtime.start_words import half_turn, opposite

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from symgen.compiling.pipeline import MethodChoice
    from symgen.describe.mechanism import Hold, Mechanism
    from symgen.describe.numbers import Scalars
    from symgen.plan import Plan
    from symgen.runtime.compiled import CompiledModel, ModelInfo
    from symgen.runtime.last_state import LastState
    from symgen.settings import Settings


@dataclass(frozen=True)
class Given:
    """A mechanism and settings with what a run gives inputs in them.

    Attributes
    ----------
    mechanism : Mechanism
        With formulas and data in the place of inputs.
    settings : Settings
        Its parameters hold what inputs are at the start.
    pieces : tuple of Piece
        Of the run, none where nothing jumps.
    told : mapping of str to str or float
        Every input in words, or its number.
    driven : Driven or None
        What inputs are, where a run gives them something.
    """

    mechanism: Mechanism
    settings: Settings
    pieces: tuple[Piece, ...]
    told: Mapping[str, str | float]
    driven: Driven | None = None


def give_inputs(mechanism: Mechanism, settings: Settings, behind: float = 0.0) -> Given:
    """Return a mechanism and settings with inputs put in their places; `behind` is that of `pieces_of`.

    Raises
    ------
    InputError
        If what is given makes no sense, see `symgen.describe.inputs.driven`, or an input is given twice.
    """
    for name in settings.inputs:
        if name in settings.parameters:
            raise InputError(f"input '{name}'", "one way of giving it a value", "two: a parameter is set by that name")
    set_by_name = {name: settings.parameters[name] for name in mechanism.inputs if name in settings.parameters}
    if not settings.inputs:
        values = parameter_values(mechanism, settings.parameters) if mechanism.inputs else {}
        return Given(mechanism, settings, (), {name: values[name] for name in mechanism.inputs})
    found = driven(mechanism, {**set_by_name, **settings.inputs})
    parameters = {**settings.parameters, **found.numbers}
    until = mechanism.defaults.until if settings.until is None else settings.until
    values = parameter_values(found.mechanism, parameters)
    pieces = pieces_of(found, values, until, behind=behind)
    parameters |= pieces[0].values if pieces else {}
    told = {name: x if isinstance(x, str) else values[name] for name, x in found.told.items()}  # defaults follow others
    return Given(found.mechanism, replace(settings, parameters=parameters, inputs={}), pieces, told, found)


def start_of(
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
        See `symgen.runtime.assembly.assemble`.
    held : Held or sequence of Hold, optional
        What is kept while everything else moves; what the description holds by default.
    near : array, optional
        Coordinates that the mechanism is closed from; those that are described by default.

    Raises
    ------
    AssemblyError
        If the mechanism cannot be closed, or a joint closes the wrong way round.
    InputError
        If the start is refused; see `symgen.runtime.assembly.assemble`.
    """
    values = parameter_values(mechanism, parameters)
    numbers = scalars(values)
    q, v = described_start(mechanism, numbers)
    if near is not None:
        q = [float(x) for x in near]
    if not isinstance(held, Held):
        held = held_of(compiled.info, holds_of(mechanism) if held is None else held, numbers, v)
    p = compiled.parameter_array(values, method_parameters or {})
    told = partial(moved, mechanism, numbers)
    return _sided(mechanism, compiled.info, assemble(compiled, np.array(q), v, p, strict, held, ask_light, told))


def _sided(mechanism: Mechanism, info: ModelInfo, start: Start) -> Start:
    """Return a start with warnings where axes point opposite ways; refuse one that holds a body the wrong way round."""
    lines = list[str]()
    for joint, held in wrong_sides(mechanism, start.y.tolist()):
        if held:
            raise half_turn(info, joint).stopped_at(start.y.tolist())
        lines.append(opposite(joint))
    return replace(start, warnings=(*start.warnings, *lines)) if lines else start


def held_of(info: ModelInfo, holds: Sequence[Hold], numbers: Scalars, v: Sequence[float | None]) -> Held:
    """Return what is held by index.

    Parameters
    ----------
    info : ModelInfo
        The model.
    holds : sequence of Hold
        From `symgen.describe.holds.holds_of`.
    numbers : Scalars
        What formulas stand for.
    v : sequence of float or None
        Given velocities.
    """
    coordinates = {quantity.name: i for i, quantity in enumerate(info.coordinates)}
    velocities = {quantity.name: j for j, quantity in enumerate(info.velocities)}
    joints = {quantity.name: k for k, quantity in enumerate(info.joint_coordinates)}
    spins = {f"{info.coordinates[first].name.partition('.')[0]}.{ORIENTATION}": at for first, at in info.spins}
    values, speeds, places, rates = dict[int, float](), dict[int, float](), dict[int, float](), dict[int, float]()
    fixed = list[int]()
    for hold in holds:
        name, value = hold.name, None if hold.value is None else numbers.value(hold.value, f"start '{hold.name}'")
        if name in coordinates and value is None:
            fixed.append(velocity_of(coordinates[name], info))
        elif name in coordinates:
            values[coordinates[name]] = float(value or 0.0)
        elif name in velocities:
            given = v[velocities[name]] if value is None else value
            speeds[velocities[name]] = float(given or 0.0)
        elif name in spins:
            fixed += range(spins[name], spins[name] + 3)
        else:
            of, rate = name.removesuffix(".rate"), name.endswith(".rate")
            (rates if rate else places)[joints[of]] = float(value or 0.0)
    return Held(values, speeds, tuple(fixed), places, rates)


def compiled_for(mechanism: Mechanism, choice: MethodChoice) -> CompiledModel:
    """Return the compiled model of a run: with integrals behind the work, where outputs have some."""
    return with_integrals(mechanism, compile_model(mechanism, choice))


def ready(
    mechanism: Mechanism,
    plan: Plan,
    parameters: Mapping[str, float] | None = None,
    strict: bool = False,
    near: NDArray[np.float64] | None = None,
) -> tuple[CompiledModel, Start]:
    """Return the compiled model and the consistent start of a plan, closed from coordinates `near` by if given.

    Where light bodies spoil the elimination of v' and the plan leaves the choice, the same law is solved with
    M + W D^T D instead, and a note says so.
    """
    if plan.last is not None:
        return _going_on(mechanism, plan, plan.last, parameters, strict)
    compiled = compiled_for(mechanism, plan.choice)
    method, free = plan.method_parameters, plan.solver_is_free
    start = start_of(mechanism, compiled, parameters, method, strict, plan.holds, free, near)
    if not start.light:
        return compiled, start
    compiled = compiled_for(mechanism, plan.choice.given(solver="augmented"))
    start = start_of(mechanism, compiled, parameters, method, strict, plan.holds, False, near)
    note = "light bodies make D M^-1 D^T nearly singular: accelerations are solved with M + W D^T D"
    return compiled, replace(start, notes=(*start.notes, note))


def made_of(compiled: CompiledModel, plan: Plan, parameters: Mapping[str, float]) -> dict[str, Any]:
    """Return what shapes a run, as JSON has it: two runs of the same making can take up each other's arrays.

    Parameters
    ----------
    compiled : CompiledModel
        Model and method.
    plan : Plan
        How it is run.
    parameters : mapping
        Values of all parameters; those of inputs are of no account.
    """
    law, spec = compiled.law, plan.spec
    own = {name: float(plan.method_parameters.get(name, default)) for name, default in law.parameters}
    return {
        "method": law.method,
        "options": {key: str(value) for key, value in law.options.items()},
        "method parameters": own,
        "integrator": plan.tableau.name,
        "integrator parameters": {key: float(value) for key, value in spec.integrator_parameters.items()},
        "adaptive": spec.adaptive,
        "step": spec.step,
        "rtol": spec.rtol if spec.adaptive else None,
        "atol": spec.atol if spec.adaptive else None,
        "parameters": {key: float(x) for key, x in parameters.items() if key not in compiled.info.inputs},
        "events": in_words(plan.events) or None,
        "shape": compiled.shape,
        "coordinates": plan.coordinates,
        "symgen": f"{__version__}, format {FORMAT}",
    }


def _going_on(
    mechanism: Mechanism, plan: Plan, last: LastState, parameters: Mapping[str, float] | None, strict: bool
) -> tuple[CompiledModel, Start]:
    """Return the compiled model and the start of a run that goes on from the last state of another.

    All that the other run kept is taken up where this one is of the same making; where it looks for other events, all
    but what was known of these. Else its time, coordinates, velocities and work are the start of another one.
    """
    values, choice = parameter_values(mechanism, parameters), choice_of(plan, last)
    compiled = compiled_for(mechanism, choice)
    info, other = compiled.info, last.other_than(made_of(compiled, plan, values))
    if plan.coordinates == "joint":  # see `symgen.tree_run`: what joints kept is not taken up here
        other = other or ["the tree is another one"]
    elif (start := taken_up(compiled, plan, last, values, made_of(compiled, plan, values))) is not None:
        return compiled, start
    other = other or ["another version of symgen kept what it knows otherwise"]
    q = np.array([last.q[c.name] for c in info.coordinates])
    v = [last.v[c.name] for c in info.velocities]
    p = compiled.parameter_array(values, plan.method_parameters)
    windings = _turned(mechanism, compiled, last)
    start = assemble(compiled, q, v, p, strict, None, plan.solver_is_free, None, (last.t, windings))
    if start.light:
        compiled = compiled_for(mechanism, choice.given(solver="augmented"))
        p = compiled.parameter_array(values, plan.method_parameters)
        start = assemble(compiled, q, v, p, strict, None, False, None, (last.t, windings))
    note = f"{whence(last)} with its coordinates and velocities alone: {'; '.join(other)}"
    note += "; integrals of outputs begin at 0" if info.integrals else ""
    return compiled, replace(start, notes=(note, *start.notes), work=last.work)


def _turned(mechanism: Mechanism, compiled: CompiledModel, last: LastState) -> tuple[float, ...]:
    """Return the angles that count turns in the order of a model, as another run left them; empty where it did not."""
    before = winding_order(mechanism, str((last.made or {}).get("shape", compiled.shape)))
    left = dict(zip(before, last.windings, strict=False))
    here = winding_order(mechanism, compiled.shape)
    return tuple(left[m] for m in here) if len(last.windings) == len(before) == len(here) else ()


def choice_of(plan: Plan, last: LastState) -> MethodChoice:
    """Return the method of a run that goes on from another one: light bodies had that one take another solver."""
    if plan.solver_is_free and (last.made or {}).get("options", {}).get("solver") == "augmented":
        return plan.choice.given(solver="augmented")
    return plan.choice


def whence(last: LastState) -> str:
    """Return the words for where a run goes on from."""
    return f"goes on from t = {last.t:.6g} s of another run"


def taken_up(
    compiled: CompiledModel, plan: Plan, last: LastState, values: Mapping[str, float], made: Mapping[str, Any]
) -> Start | None:
    """Return the start of a run that takes up what another one kept, None where it is of another making.

    Parameters
    ----------
    compiled, plan : CompiledModel, Plan
        Model and method, and how it is run.
    last : LastState
        Of the other run.
    values : mapping
        Of all parameters.
    made : mapping
        From `made_of`.
    """
    if last.arrays is None or last.other_than({key: x for key, x in made.items() if key != "events"}):
        return None
    memory = plan.tableau.setup(compiled, plan.spec, compiled.scratch()).memory
    if not is_as_kept(compiled, memory, last.arrays):
        return None
    other = last.other_than(made)
    y, p, w = (last.arrays[name] for name in ("y", "p", "w"))
    arrays = {name: array for name, array in last.arrays.items() if name != "hunt" or not other}
    told = f" with all that it kept but its events: {'; '.join(other)}" if other else ""
    info = compiled.info
    own = compiled.parameter_array(values, plan.method_parameters)[: len(values)]  # others are inputs alone
    kept = (y[: info.ny].copy(), np.concatenate([own, p[len(values) :]]), w.copy(), last.rank, compiled.redundant(w))
    return Start(*kept, (whence(last) + told,), t=last.t, work=last.work_before, saved=arrays)


def watching(
    mechanism: Mechanism, plan: Plan, compiled: CompiledModel, parameters: Mapping[str, float] | None = None
) -> Plan:
    """Return a plan whose run looks for its events, which are compiled for the model."""
    if not plan.events:
        return plan
    from symgen.compiling.events import compile_events

    watched = compile_events(mechanism, compiled, plan.events, parameter_values(mechanism, parameters))
    return replace(plan, spec=replace(plan.spec, events=watched))


def stopping(mechanism: Mechanism, plan: Plan, compiled: CompiledModel) -> Plan:
    """Return a plan whose run ends steps at kinks over the state, and passes no two switches in a step."""
    if not plan.spec.adaptive:
        return plan
    from symgen.compiling.knots import with_looks

    return replace(plan, spec=with_looks(mechanism, compiled, plan.spec, isinstance(plan.tableau, Tableau)))

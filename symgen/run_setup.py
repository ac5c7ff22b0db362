"""From a mechanism and a plan to what a loop begins with: the compiled model and its consistent start."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from functools import partial
from typing import TYPE_CHECKING

import numpy as np

from symgen.compiling.pipeline import compile_model
from symgen.describe.evaluate import parameter_values, scalars
from symgen.describe.holds import ORIENTATION, holds_of
from symgen.describe.moved import moved
from symgen.describe.start import described_start
from symgen.runtime.assembly import Start, assemble
from symgen.runtime.held import Held
from symgen.runtime.model_arrays import velocity_of

if TYPE_CHECKING:
    from collections.abc import Sequence

    from symgen.describe.mechanism import Hold, Mechanism
    from symgen.describe.numbers import Scalars
    from symgen.plan import Plan
    from symgen.runtime.compiled import CompiledModel, ModelInfo


def start_of(
    mechanism: Mechanism,
    compiled: CompiledModel,
    parameters: Mapping[str, float] | None = None,
    method_parameters: Mapping[str, float] | None = None,
    strict: bool = False,
    held: Held | Sequence[Hold] | None = None,
    ask_light: bool = False,
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
        What is kept while everything else moves; what the description holds unless given.

    Raises
    ------
    AssemblyError
        If the mechanism cannot be closed.
    InputError
        If the start is refused; see `symgen.runtime.assembly.assemble`.
    """
    values = parameter_values(mechanism, parameters)
    numbers = scalars(values)
    q, v = described_start(mechanism, numbers)
    if not isinstance(held, Held):
        held = held_of(compiled.info, holds_of(mechanism) if held is None else held, numbers, v)
    p = compiled.parameter_array(values, method_parameters or {})
    told = partial(moved, mechanism, numbers)
    return assemble(compiled, np.array(q), v, p, strict, held, ask_light, told)


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


def ready(
    mechanism: Mechanism, plan: Plan, parameters: Mapping[str, float] | None = None, strict: bool = False
) -> tuple[CompiledModel, Start]:
    """Return the compiled model and the consistent start of a plan.

    Where light bodies spoil the elimination of v' and the plan leaves the choice, the same law is solved with
    M + W D^T D instead, and a note says so.
    """
    compiled = compile_model(mechanism, plan.choice)
    start = start_of(mechanism, compiled, parameters, plan.method_parameters, strict, plan.holds, plan.solver_is_free)
    if not start.light:
        return compiled, start
    choice = replace(plan.choice, options={**plan.choice.options, "solver": "augmented"})
    compiled = compile_model(mechanism, choice)
    start = start_of(mechanism, compiled, parameters, plan.method_parameters, strict, plan.holds)
    note = "light bodies make D M^-1 D^T nearly singular: accelerations are solved with M + W D^T D"
    return compiled, replace(start, notes=(*start.notes, note))

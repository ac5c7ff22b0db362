"""From a mechanism and a plan to what a loop begins with: the compiled model and its consistent start."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from symgen.compiling.pipeline import compile_model
from symgen.describe.evaluate import parameter_values, scalars
from symgen.describe.inputs import driven
from symgen.describe.start import described_start
from symgen.runtime.assembly import Held, Start, assemble
from symgen.runtime.pieces import Piece, pieces_of

if TYPE_CHECKING:
    from symgen.describe.mechanism import Mechanism
    from symgen.plan import Plan
    from symgen.runtime.compiled import CompiledModel
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
    """

    mechanism: Mechanism
    settings: Settings
    pieces: tuple[Piece, ...]
    told: Mapping[str, str | float]


def give_inputs(mechanism: Mechanism, settings: Settings) -> Given:
    """Return a mechanism and settings with inputs put in their places.

    Raises
    ------
    InputError
        If what is given makes no sense, see `symgen.describe.inputs.driven`.
    """
    set_by_name = {name: settings.parameters[name] for name in mechanism.inputs if name in settings.parameters}
    if not settings.inputs:
        values = parameter_values(mechanism, settings.parameters) if mechanism.inputs else {}
        return Given(mechanism, settings, (), {name: values[name] for name in mechanism.inputs})
    found = driven(mechanism, {**set_by_name, **settings.inputs})
    parameters = {**settings.parameters, **found.numbers}
    until = mechanism.defaults.until if settings.until is None else settings.until
    pieces = pieces_of(found, parameter_values(found.mechanism, parameters), until)
    parameters |= pieces[0].values if pieces else {}
    return Given(found.mechanism, replace(settings, parameters=parameters, inputs={}), pieces, found.told)


def start_of(
    mechanism: Mechanism,
    compiled: CompiledModel,
    parameters: Mapping[str, float] | None = None,
    method_parameters: Mapping[str, float] | None = None,
    strict: bool = False,
    held: Held | None = None,
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
    strict, held, ask_light
        See `symgen.runtime.assembly.assemble`.

    Raises
    ------
    AssemblyError
        If the mechanism cannot be closed.
    InputError
        If the start is refused; see `symgen.runtime.assembly.assemble`.
    """
    values = parameter_values(mechanism, parameters)
    q, v = described_start(mechanism, scalars(values))
    p = compiled.parameter_array(values, method_parameters or {})
    return assemble(compiled, np.array(q), v, p, strict, held, ask_light)


def ready(
    mechanism: Mechanism, plan: Plan, parameters: Mapping[str, float] | None = None, strict: bool = False
) -> tuple[CompiledModel, Start]:
    """Return the compiled model and the consistent start of a plan.

    Where light bodies spoil the elimination of v' and the plan leaves the choice, the same law is solved with
    M + W D^T D instead, and a note says so.
    """
    compiled = compile_model(mechanism, plan.choice)
    start = start_of(mechanism, compiled, parameters, plan.method_parameters, strict, ask_light=plan.solver_is_free)
    if not start.light:
        return compiled, start
    choice = replace(plan.choice, options={**plan.choice.options, "solver": "augmented"})
    compiled = compile_model(mechanism, choice)
    start = start_of(mechanism, compiled, parameters, plan.method_parameters, strict)
    note = "light bodies make D M^-1 D^T nearly singular: accelerations are solved with M + W D^T D"
    return compiled, replace(start, notes=(*start.notes, note))

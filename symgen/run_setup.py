"""From a mechanism and a plan to what a loop begins with: the compiled model and its consistent start."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from symgen.compiling.events import compile_events
from symgen.compiling.pipeline import compile_model
from symgen.describe.evaluate import parameter_values, scalars
from symgen.describe.start import described_start
from symgen.runtime.assembly import Held, Start, assemble

if TYPE_CHECKING:
    from symgen.describe.mechanism import Mechanism
    from symgen.plan import Plan
    from symgen.runtime.compiled import CompiledModel


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


def watching(
    mechanism: Mechanism, plan: Plan, compiled: CompiledModel, parameters: Mapping[str, float] | None = None
) -> Plan:
    """Return a plan whose run looks for its events, which are compiled for the model."""
    if not plan.events:
        return plan
    watched = compile_events(mechanism, compiled, plan.events, parameter_values(mechanism, parameters))
    return replace(plan, spec=replace(plan.spec, events=watched))

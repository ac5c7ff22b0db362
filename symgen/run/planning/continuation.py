"""Runs that go on from the last state of another one."""

from __future__ import annotations

from dataclasses import replace
from functools import partial
from typing import TYPE_CHECKING, Any

import numpy as np

from symgen.base.ir.program import FORMAT
from symgen.base.version import __version__
from symgen.base.vocabulary.expressions import Number
from symgen.derive.lower.windings import winding_order
from symgen.describe.facts.lengths import origin_of_sizes
from symgen.describe.formulas.evaluate import parameter_values, scalar_values
from symgen.describe.mechanism import Hold
from symgen.describe.parts.event_sections import events_in_words
from symgen.run.compiling.mass_formulas import masses_of_starts
from symgen.run.planning.starts import close_with_light_bodies, compiled_for, states_at_start
from symgen.run.single.new_state import lengths_match
from symgen.run.starts.assembly import Start, assemble

if TYPE_CHECKING:
    from symgen.describe.mechanism import Mechanism
    from symgen.run.compiling.method_choice import MethodChoice
    from symgen.run.layout.compiled import CompiledModel
    from symgen.run.loops.run_spec import RunSpec
    from symgen.run.planning.plan import Plan
    from symgen.run.single.last_state import LastState


def settings_as_json(compiled: CompiledModel, plan: Plan, spec: RunSpec) -> dict[str, Any]:
    """Return the settings of a run, as JSON has them: two runs of the same making can take up each other's arrays.

    Parameters
    ----------
    compiled : CompiledModel
        Model and method.
    plan : Plan
        The run; its inputs are of no account.
    spec : RunSpec
        Its steps and tolerances.
    """
    law = compiled.law
    own = {name: float(plan.method_parameters.get(name, default)) for name, default in law.parameters}
    values = parameter_values(plan.mechanism, plan.parameters)
    making = {
        "method": law.method,
        "options": {key: str(value) for key, value in law.options.items()},
        "method parameters": own,
        "integrator": plan.integrator.name,
        "integrator parameters": {key: float(value) for key, value in spec.integrator_parameters.items()},
        "adaptive": spec.adaptive,
        "step": spec.step,
        "rtol": spec.rtol if spec.adaptive else None,
        "atol": spec.atol if spec.adaptive else None,
        "parameters": {key: float(x) for key, x in values.items() if key not in compiled.info.inputs},
        "events": events_in_words(plan.events) or None,
        "shape": compiled.shape,
        "coordinates": plan.coordinates,
        "symgen": f"{__version__}, format {FORMAT}",
    }
    return making | {"tree": compiled.info.digest[:12]} if plan.coordinates == "joint" else making


def continue_run(plan: Plan, last: LastState) -> tuple[CompiledModel, Start]:
    """Compile a plan for the coordinates of bodies, and begin where another run ended.

    All that the other run kept is taken up where this one is of the same making; where it looks for other events, all
    but what that run knew of its events. Else time, coordinates, velocities and work are the start of this run.
    """
    compiled, joint = compiled_for(plan.mechanism, choice_after(plan, last)), plan.coordinates == "joint"
    # arrays of a run in joint coordinates are taken up by `symgen.run.planning.tree`
    if not joint and (start := take_up_state(compiled, plan, last)) is not None:
        return compiled, start
    other = last.other_than({key: x for key, x in settings_as_json(compiled, plan, plan.spec).items() if key != "tree"})
    other = other or ["the tree is another one" if joint else "another version of symgen kept what it knows otherwise"]
    compiled, start = close_with_light_bodies(plan, compiled, partial(_from_coordinates, plan, last))
    note = f"{_origin_of_state(last)} with its coordinates and velocities alone: {'; '.join(other)}"
    note += "; integrals of outputs begin at 0" if compiled.info.integrals else ""
    return compiled, replace(start, notes=(note, *start.notes), work=last.work)


def _from_coordinates(plan: Plan, last: LastState, compiled: CompiledModel, ask_light: bool) -> Start:
    """Return the consistent start with time, coordinates and velocities of another run."""
    info, values = compiled.info, parameter_values(plan.mechanism, plan.parameters)
    q = np.array([last.q[c.name] for c in info.coordinates])
    v = [last.v[c.name] for c in info.velocities]
    p = compiled.parameter_array(values, plan.method_parameters)
    datum = origin_of_sizes(plan.mechanism, scalar_values(values))
    whence = last.t, _windings(plan.mechanism, compiled, last)
    masses = masses_of_starts(plan.mechanism, compiled, True)
    start = assemble(compiled, q, v, p, plan.settings.strict, None, ask_light, None, whence, datum, masses)
    states = last.states_in({state.name: state.unit for state in plan.mechanism.states})
    holds = [Hold(name, Number(x)) for name, x in states.items()]
    start.y[info.own_states] = states_at_start(plan.mechanism, scalar_values(values), holds)
    return start


def _windings(mechanism: Mechanism, compiled: CompiledModel, last: LastState) -> tuple[float, ...]:
    """Return the angles that count turns in the order of a model, as another run left them; empty where unknown."""
    before = winding_order(mechanism, str((last.made or {}).get("shape", compiled.shape)))
    left = dict(zip(before, last.windings, strict=False))
    here = winding_order(mechanism, compiled.shape)
    return tuple(left[m] for m in here) if len(last.windings) == len(before) == len(here) else ()


def choice_after(plan: Plan, last: LastState) -> MethodChoice:
    """Return the method of a run that goes on from another one, with the solver that light bodies chose there."""
    if plan.solver_is_free and (last.made or {}).get("options", {}).get("solver") == "augmented":
        return plan.choice.with_options(solver="augmented")
    return plan.choice


def _origin_of_state(last: LastState) -> str:
    return f"goes on from t = {last.t:.6g} s of another run"


def take_up_state(compiled: CompiledModel, plan: Plan, last: LastState) -> Start | None:
    """Return the start of a run that takes up what another one kept, None where that is of another making.

    Parameters
    ----------
    compiled, plan : CompiledModel, Plan
        Code and plan of the run.
    last : LastState
        Of the other run.
    """
    making = settings_as_json(compiled, plan, plan.spec)
    if last.arrays is None or last.other_than({key: x for key, x in making.items() if key != "events"}):
        return None
    memory = plan.integrator.setup(compiled, plan.spec, compiled.scratch()).memory
    if not lengths_match(compiled, memory, last.arrays):
        return None
    other = last.other_than(making)
    y, p, w = (last.arrays[name] for name in ("y", "p", "w"))
    arrays = {name: array for name, array in last.arrays.items() if name != "hunt" or not other}
    words = f" with all that it kept but its events: {'; '.join(other)}" if other else ""
    info, values = compiled.info, parameter_values(plan.mechanism, plan.parameters)
    own = compiled.parameter_array(values, plan.method_parameters)[: len(values)]  # others are inputs alone
    state = (y[: info.ny].copy(), np.concatenate([own, p[len(values) :]]), w.copy(), last.rank, compiled.redundant(w))
    return Start(*state, (_origin_of_state(last) + words,), t=last.t, work=last.work_before, saved=arrays)

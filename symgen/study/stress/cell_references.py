"""References of the cases: closed forms, independent equations, or two formulations that agree.

Planar mechanisms have compiled independent equations, spatial ones two routes through compiled code, as have those
with beam elements, rows with bounds or events that change the state.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from symgen.base.errors import AssemblyError, InputError, SimulationError
from symgen.base.settings import Settings
from symgen.describe.facts.digest import digest
from symgen.describe.files.load import load_mechanism
from symgen.describe.formulas.evaluate import parameter_values
from symgen.describe.mechanism import Mechanism
from symgen.describe.parts.holding_joints import refuse_holding
from symgen.describe.parts.passing_ropes import refuse_rope_sheaves
from symgen.result.points import Points
from symgen.run.breaks.refused_motions import refuse_jumps
from symgen.run.compiling.pipeline import straight_alone
from symgen.run.layout import abi
from symgen.run.layout.compiled import CompiledModel
from symgen.run.layout.probe import Ready
from symgen.run.planning.plan import Purpose
from symgen.run.planning.prepare import prepare
from symgen.run.starts.assembly import Start
from symgen.study.references.closed_forms import Closed, closed_form, harmonic_motion, parallel_cranks, uniform_motion
from symgen.study.references.reference import scaled_values
from symgen.study.references.routes import derivable_part, fastest_decay, motion_by_two_routes, parts_without_derivation
from symgen.study.stress.bench import FREE_LENGTH, Level
from symgen.study.stress.cell_outcome import ACCURATE, TRUSTED
from symgen.study.stress.own_mechanisms import OSCILLATOR_RATE

Array = NDArray[np.float64]
Fields = dict[str, Any]

#: A start counts as consistent up to this |Phi| and |D v - nu| by the independent equations, times length and speed.
CONSISTENT = 1e-8
#: Estimated error, over the mechanism's size, with which long integrations do not begin: a fiftieth of a trusted one.
ENOUGH = TRUSTED * ACCURATE / 50.0


def reference_of_cell(level: Level, quick: bool = False) -> Fields:
    """Return the motion at the outputs, or the reason why there is none; a quick study looks for a shorter time."""
    try:
        refuse_jumps(level.mechanism, level.parameters, level.until)
        refuse_holding("stress", level.mechanism)  # starts are judged with all joints
        refuse_rope_sheaves("stress", level.mechanism)
        return _moved_start(level, quick)
    except (AssemblyError, InputError, SimulationError) as error:
        return {"unusable": str(error)}


def _moved_start(level: Level, quick: bool) -> Fields:
    mechanism, parameters = level.mechanism, parameter_values(level.mechanism, level.parameters)
    shape = "straight" if straight_alone(mechanism) else "looped"
    settings = Settings("lagrange", "rk4", level.step, until=level.until, shape=shape, parameters=parameters)
    run = prepare(mechanism, settings, Purpose.STATE)
    compiled, start = run.compiled, run.start
    q, v = (part.copy() for part in compiled.info.parts(start.y))
    if level.spring_end is not None:
        column, fixed = int(level.spring_end[0]), level.spring_end[1:]
        parameters[FREE_LENGTH] = math.dist(q[column : column + len(fixed)], fixed)
    equations = emitted_geometry(level, parameters, compiled, start)
    derived = level.mechanism.space == "planar" and not parts_without_derivation(mechanism)
    points = Points.of_mechanism(level.mechanism, parameters)
    length = points.size(q[None, :])
    phi, d, nu = equations.evaluate(0.0, q, v)[:3]
    speed = max(1.0, float(np.abs(v).max(initial=0.0)))
    if not (np.linalg.norm(phi) <= CONSISTENT * max(1.0, length) and np.linalg.norm(d @ v - nu) <= CONSISTENT * speed):
        raise SimulationError("the start does not satisfy the independent equations")
    times = np.array(times_of_cell(level))
    closed = _closed_form_motion(level, parameters, q, times)
    falling = fastest_decay(mechanism, compiled, start)
    if closed is None:
        try:
            if derived:
                from symgen.study.references.motion import motion_with_estimate  # which imports Numba

                reference = motion_with_estimate(equations, q, v, times)
            else:
                reference = motion_by_two_routes(mechanism, parameters, times, falling, enough=ENOUGH, quick=quick)
        except SimulationError as error:  # over its budget, or at a singular position
            if not derived:
                raise
            try:
                reference = motion_by_two_routes(mechanism, parameters, times, falling, enough=ENOUGH, quick=quick)
            except SimulationError as other:
                raise SimulationError(f"{error}; {other}") from None
        closed = reference.how, reference.estimated_error, reference.q, reference.v
    how, estimated, moved, _ = closed
    return {
        "unusable": None,
        "how": how,
        "estimated_error": float(estimated),
        "q": moved.tolist(),
        "decay": falling,
        "sines": _sines_of_angles(equations, times, moved).tolist(),
        "length": min(points.scale_of_errors(moved, small=1.0), level.length or math.inf),
        "parameters": {
            name: value for name, value in parameters.items() if name in {**level.parameters, FREE_LENGTH: 0}
        },
    }


def cells_without_reference(motion: Mapping[str, Any]) -> str | None:
    """Return the reason why a reference is unusable, None if it is usable."""
    if motion["unusable"] is not None:
        return str(motion["unusable"])
    if motion["estimated_error"] > TRUSTED * ACCURATE * motion["length"]:
        return f"the two reference runs differ by {motion['estimated_error']:.2g} m"
    return None


def times_of_cell(level: Level) -> list[float]:
    """Return the output times of a case [s]."""
    return [level.until * k / level.outputs for k in range(level.outputs + 1)]


def emitted_geometry(level: Level, parameters: Mapping[str, float], compiled: CompiledModel, start: Start) -> Any:
    """Return what has Phi, D and nu of a case: its independent equations, or in space its emitted functions."""
    mechanism = derivable_part(level.of_reference)
    if mechanism.space == "planar" and not mechanism.has_modal_bodies:
        return equations_of_cell(mechanism, parameters, interpreted=mechanism is not level.of_reference)
    if mechanism is not level.of_reference:  # rows that are off are in neither
        own = prepare(mechanism, Settings("lagrange", "rk4", level.step, parameters=parameters), Purpose.STATE)
        compiled, start = own.compiled, own.start
    return EmittedGeometry(compiled, start)


def equations_of_cell(mechanism: Mechanism, parameters: Mapping[str, float], interpreted: bool = False) -> Any:
    """Return the independent equations of a case, once a process for all cases with the same equations.

    They are compiled unless nothing but their geometry is asked for: no reference integrates what they lack.
    """
    from symgen.study.references.motion import CompiledEquations, InterpretedEquations

    key = digest(mechanism)
    if key not in _COMPILED:
        _COMPILED[key] = (InterpretedEquations if interpreted else CompiledEquations)(mechanism, parameters)
    equations = _COMPILED[key]
    equations.mechanism = mechanism
    equations.set_parameters(parameters)
    return equations


_COMPILED: dict[str, Any] = {}


def _closed_form_motion(level: Level, parameters: Mapping[str, float], q: Array, times: Array) -> Closed | None:
    if level.accelerations is not None:
        return uniform_motion(level.accelerations, q, times)
    if level.closed is None:
        return None
    if level.closed == "parallelogram":
        return parallel_cranks(("vertical0", "coupler0", "vertical1"), times)
    if level.closed == "oscillator":
        return harmonic_motion(OSCILLATOR_RATE, q, times)
    base = load_mechanism(level.closed)
    formula = closed_form(base)
    assert formula is not None, "levels name only what has a closed form"
    return formula(base, {p.name: parameters[p.name] for p in base.parameters}, q, times)


def _sines_of_angles(equations: Any, times: Array, q: Array) -> Array:
    """Return the smallest singular value of independent rows, scaled to length 1, as a share of the largest."""
    if equations.m == 0:
        return np.ones(len(times))
    values, rank = [], 0
    for t, at in zip(times, q, strict=True):
        d = equations.evaluate(float(t), at, np.zeros(equations.n))[1]
        singular = scaled_values(d)
        rank = rank or int(np.sum(singular > 1e-6))
        values.append(float(singular[rank - 1]) if rank else 1.0)
    largest = max(values)
    return np.array(values) / largest if largest > 0.0 else np.ones(len(times))


class EmittedGeometry:
    """Numerical Phi, D and nu of a compiled model.

    Parameters
    ----------
    compiled, start : CompiledModel, Start
        Model and method, and a start with the parameters prepared.
    """

    def __init__(self, compiled: CompiledModel, start: Start) -> None:
        self.compiled, self.start = compiled, start
        self.m, self.n = compiled.info.m, compiled.info.nv

    def evaluate(self, t: float, q: Array, v: Array) -> tuple[Array, Array, Array]:
        """Return Phi, D and nu at a state."""
        w, y = self.start.w.copy(), np.concatenate([q, v, [0.0]])
        Ready(self.compiled.model.geometry, abi.MEASURE)(t, y, self.start.p, w)
        section = self.compiled.section
        return section(w, "residual").copy(), self.compiled.jacobian(w), section(w, "nu").copy()

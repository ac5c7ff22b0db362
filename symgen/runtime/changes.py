"""A run from outside: its first state accepted without a step, and parameters that change while it goes on."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from symgen.errors import InputError
from symgen.runtime import abi
from symgen.runtime import ensemble_abi as e
from symgen.runtime.probe import Ready

if TYPE_CHECKING:
    from symgen.runtime.compiled import CompiledModel
    from symgen.runtime.simulation import Simulation

Array = NDArray[np.float64]

#: What `watch` finds out at every accepted state: it has been found out already where a run begins anew.
_WATCHED = [abi.EVENTS, abi.IN_ZONE, abi.LAST_RANK, abi.MASKED, abi.OUTPUTS]


def begin(simulation: Simulation) -> int:
    """Accept the first state and prepare the scheme, without a step; return `DONE` or why the state is refused."""
    control = simulation.state.control
    control[abi.STOP] = 1
    try:
        code = simulation.go(simulation.spec.until, np.inf)
    finally:
        control[abi.STOP] = 0
    return abi.DONE if code == abi.STOPPED else code


def begin_anew(simulation: Simulation) -> int:
    """Have the scheme forget what it knows of rates: what they depend on is about to change, or has just changed.

    The state is accepted once more. What a run has found out so far stays: its balance of energy, largest violations,
    passages, and the step that an adaptive one would try next.
    """
    state, span, place = simulation.state, simulation.span, simulation.compiled.info.work
    gauges, watched, work = state.gauges.copy(), state.control[_WATCHED], float(state.y[place])
    if state.control[abi.STEPS] > 0 and simulation.spec.adaptive:
        simulation.span = span._replace(step=float(state.clock[abi.NEXT]))
    state.control[abi.BEGUN] = 0
    state.y[place] = 0.0  # the balance begins with none
    try:
        code = begin(simulation)
    finally:
        simulation.span = span
    state.y[place] = work
    state.gauges[:], state.control[_WATCHED] = gauges, watched
    state.clock[abi.ALLOWED] = 0.0
    return code


def set_parameters(simulation: Simulation, p: Array) -> None:
    """Go on with other parameters from the present state.

    What the change adds to the energy counts as work done on the mechanism. Masses may change as well; positions and
    velocities stay what they are, so whatever moves the constraints away from them is refused.

    Parameters
    ----------
    simulation : Simulation
        Begun.
    p : Array
        Parameters, not yet prepared.

    Raises
    ------
    InputError
        If a number is not finite, a mass is not positive, or the present state violates the constraints by more than
        the run tolerates. Nothing is changed then.
    """
    state, compiled, spec = simulation.state, simulation.compiled, simulation.spec
    t, place = float(state.clock[abi.TIME]), compiled.info.work
    before = _measured(compiled, t, state.y, state.p, state.w.copy())
    with np.errstate(all="ignore"):
        try:
            for module in (compiled.model, compiled.law_module):
                Ready(module.prepare, e.PREPARE)(p)
            after = _measured(compiled, t, state.y, p, state.w.copy())
        except (ArithmeticError, ValueError):  # where nothing is compiled
            p[:], after = np.nan, before
    _check_masses(compiled, after)
    used = np.concatenate([p, after[[abi.PHI, abi.DRIFT, abi.KINETIC, abi.POTENTIAL]]])
    if not np.all(np.isfinite(used)):
        raise InputError("set", "parameters for which the equations are defined", "numbers that are not finite")
    metric, nq = state.metric, compiled.info.nq
    length = max(float(after[abi.LENGTH]), float(np.abs(state.y * metric)[:nq].max(initial=0.0)))
    for name, size, most in (
        ("position", after[abi.PHI_MEASURE], spec.max_violation * length),
        ("velocity", after[abi.DRIFT_MEASURE], spec.velocity_limit * float(state.w[abi.SPEED])),
    ):
        if size > most:
            raise InputError(
                "set",
                f"parameters that leave the {name} of every joint as it is",
                f"a violation of {size:.3g} (at most {most:.3g})",
                "start anew for another geometry",
            )
    kept = simulation.save()
    state.p[:] = p
    _refresh_masses(compiled, state.p, state.w)
    state.y[place] += sum(float(after[i] - before[i]) for i in (abi.KINETIC, abi.POTENTIAL))
    code = begin_anew(simulation)
    if code != abi.DONE:
        simulation.restore(kept)
        raise InputError("set", "parameters with which the run can go on", abi.REASONS[code])


def _measured(compiled: CompiledModel, t: float, y: Array, p: Array, w: Array) -> Array:
    """Return `w` with what ``geometry`` and ``measure`` say of a state; it is overwritten."""
    _refresh_masses(compiled, p, w)
    Ready(compiled.model.geometry, abi.MEASURE)(t, y, p, w)
    compiled.measure(t, y, p, w)
    return w


def _refresh_masses(compiled: CompiledModel, p: Array, w: Array) -> None:
    """Have the masses in the scratch that belong to parameters, and their mean."""
    Ready(compiled.model.masses, abi.MOVE)(p, w)
    mass = compiled.section(w, "mass")
    w[abi.MEAN_MASS] = np.mean(mass * compiled.section(w, "gauge")) if len(mass) else 0.0


def _check_masses(compiled: CompiledModel, w: Array) -> None:
    """Refuse masses that are not positive, those excepted that are described as 0."""
    info, mass = compiled.info, compiled.section(w, "mass")
    for j in range(info.nv):
        if j not in info.massless and not mass[j] > 0.0:
            body = info.velocities[j].name.partition(".")[0]
            raise InputError("set", f"a mass and an inertia of {body} above 0", f"{mass[j]:g}")

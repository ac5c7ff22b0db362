"""Automatic choice of method and integrator from facts of the model, each with its reason."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from symgen.base.errors import plural
from symgen.base.ir.program import COUNTERS
from symgen.base.vocabulary.expressions import ZERO
from symgen.base.vocabulary.measures import GROUND
from symgen.derive.methods import METHODS
from symgen.describe.facts.kinks import discontinuities_of
from symgen.describe.formulas.evaluate import evaluate_formula
from symgen.run.compiling.choices import choose_shape
from symgen.run.compiling.linearised import GROWTH, compile_growth
from symgen.run.compiling.method_choice import choose_method
from symgen.run.integrators import INTEGRATORS
from symgen.run.layout import abi
from symgen.run.layout.probe import rate_function
from symgen.run.layout.right_hand_side import rates_at_nodes

if TYPE_CHECKING:
    from symgen.base.settings import Settings
    from symgen.describe.mechanism import Mechanism
    from symgen.run.layout.compiled import CompiledModel
    from symgen.run.planning.prepare import Prepared
    from symgen.run.single.outcome import Outcome
    from symgen.run.starts.assembly import Start

Array = NDArray[np.float64]

#: Setting of an automatic choice.
AUTO = "auto"
#: Integrator of motions that are not stiff, and that of smooth ones whose right-hand side is evaluated in vectors.
EXPLICIT, TOGETHER = "dop853", "picard"
#: Explicit integrator of constant steps where none is named: of studies, lanes and devices.
CONSTANT = "rk4"
#: Steps of a trial, and the part of them whose iteration converges slowly where the motion is stiff.
TRIAL, SLOW = 100, 0.5
#: A mechanism counts as stiff where stability asks for this many times the steps that following its motion does.
STIFF_RATIO = 20.0
#: Runs of fewer steps are short, whatever bounds these.
LONG = 1000
#: Steps of an adaptive run of high order over the time in which its state changes by its own size.
_STEPS_A_CHANGE = 8.0
#: A structure counts as fast where stability asks for this many times the steps that following its motion does: an
#: explicit scheme of high order is cheap and exact for those between.
_FAST = 1000.0
#: Where the region of stability of `EXPLICIT` ends on the imaginary axis, about.
_IMAGINARY = 5.0
#: Method and integrator of structures that vibrate fast.
STRUCTURAL = "generalized-alpha"
#: Above this many unknowns of a stage nobody asks for eigenvalues: they would take longer than a run.
LARGEST_LINEARISED = 400


@dataclass(frozen=True)
class Facts:
    """Facts on which the choice is based.

    Attributes
    ----------
    rows, rank : int
        Constraint rows and their rank at the start.
    coordinates : int
        Size of q.
    massless : bool
        Whether a body has no mass.
    fastest_decay : float
        Largest negative real part of the eigenvalues of the linearised motion at the start [1/s]; 0 where no force
        depends on velocities and no joint is a condition on them.
    slowest_change : float
        Rate at which the state changes by its own size [1/s].
    together : bool
        Whether the right-hand side can be evaluated at all nodes of a step at once, and no formula compares the state.
    slow : float
        Part of the steps of a trial whose iteration converges slowly.
    vibration : float
        Bound of the angular frequencies of beam elements [1/s]; 0 where there are none, or something damps them.
    """

    rows: int
    rank: int
    coordinates: int
    massless: bool
    fastest_decay: float
    slowest_change: float
    together: bool
    slow: float = 0.0
    vibration: float = 0.0

    @property
    def vibrates(self) -> bool:
        """Whether following the vibrations of beams would take explicit schemes far more steps than the motion."""
        return self.vibration / _IMAGINARY > _FAST * self.slowest_change * _STEPS_A_CHANGE

    @property
    def stiffness(self) -> float:
        """Steps that stability asks of an explicit scheme over those that following the motion takes."""
        return self.fastest_decay / 3.0 / max(self.slowest_change * _STEPS_A_CHANGE, 1e-300)


def linearise_start(mechanism: Mechanism, compiled: CompiledModel, start: Start) -> Array:
    """Return the Jacobian of (q', v') with respect to (q, v) at the start, from derivatives on the graph.

    Parameters
    ----------
    mechanism : Mechanism
        The mechanism.
    compiled : CompiledModel
        Its compiled form; any method will do.
    start : Start
        Where to linearise.

    Returns
    -------
    matrix : Array, shape (nq + nv + states, nq + nv + states)
        All zero where nothing can decay: no force depends on velocities, and no joint is a condition on them.
    """
    nq, nv, states = compiled.info.nq, compiled.info.nv, len(compiled.info.states)
    result, form = np.zeros((nq + nv + states, nq + nv + states)), compile_growth(mechanism, compiled)
    if form is None:
        return result
    w = start.w.copy()
    lam, independent = compiled.section(w, "multipliers"), compiled.section(w, "mask") == 0.0
    lam[:] = 0.0
    still = form.at(start.t, start.y, np.zeros(nv), start.p, w)
    rows = still.by("accelerations", "a")[independent]
    matrix = np.block([[still.by("balance", "a"), rows.T], [rows, np.zeros((len(rows), len(rows)))]])

    def solve_modes(balance: Array, accelerations: Array) -> Array:
        right = -np.concatenate([balance, accelerations[independent]])
        return np.asarray(np.linalg.lstsq(matrix, right, rcond=1e-14)[0], dtype=np.float64)

    if not np.all(np.isfinite(still.out)):
        return np.full_like(result, np.nan)
    solution = solve_modes(still.value("balance"), still.value("accelerations"))
    lam[independent] = solution[nv:]
    e = form.at(start.t, start.y, solution[:nv], start.p, w)
    if not np.all(np.isfinite(e.out)):
        return np.full_like(result, np.nan)
    by_state = [np.hstack([e.by(group, space) for space in "qvz"]) for group in GROWTH]
    result[:nq] = by_state[0]
    result[nq : nq + nv] = solve_modes(by_state[1], by_state[2])[:nv]
    result[nq + nv :] = by_state[3]
    return result


def trial_settings(mechanism: Mechanism, settings: Settings) -> Settings:
    """Return settings in which ``auto`` is replaced: the method for good, the integrator until the start is known.

    Parameters
    ----------
    mechanism : Mechanism
        The description.
    settings : Settings
        With ``auto``.
    """
    method, integrator, options = settings.method, settings.integrator, dict(settings.options)
    if method == AUTO:
        method = "direct-correction" if any(joint.rows for joint in mechanism.joints) else "lagrange"
        if method == "direct-correction" and not mechanism.has_massless:
            options.setdefault("method.weight", "mass")
    if integrator == AUTO:
        explicit = set(METHODS.get(method, "method").forms) & set(INTEGRATORS.get(EXPLICIT).forms)
        integrator = EXPLICIT if explicit else METHODS.get(method).default_integrator
    return replace(settings, method=method, integrator=integrator, options=options)


def usual_integrator(mechanism: Mechanism, method: str, coordinates: str, shape: str, evaluations: float) -> str:
    """Return the integrator of a run where neither the run nor the description names one.

    It is the method's own, but `EXPLICIT` in place of `TOGETHER` where nodes would be evaluated one after another, in
    looped code, and where steps end at what the state passes.

    Parameters
    ----------
    mechanism : Mechanism
        The description.
    method, coordinates, shape : str
        As in the settings.
    evaluations : float
        About how many a run takes, by which the shape of its code is chosen.
    """
    own = METHODS.get(method, "method").default_integrator
    if own != TOGETHER:
        return own
    if shape == "auto" and coordinates != "joint":
        shape = choose_shape(mechanism, choose_method(method), shape, evaluations).name
    return EXPLICIT if shape == "looped" or discontinuities_of(mechanism) else TOGETHER


def facts_of_plan(mechanism: Mechanism, compiled: CompiledModel, start: Start, until: float) -> Facts:
    """Return the facts of a mechanism at its start.

    Parameters
    ----------
    mechanism : Mechanism
        The description.
    compiled, start : CompiledModel, Start
        Its code for any method, and the start, in coordinates of bodies.
    until : float
        End of the run [s].
    """
    info = compiled.info
    small = 2 * info.nq + info.m <= LARGEST_LINEARISED
    jacobian = linearise_start(mechanism, compiled, start) if small else np.zeros((1, 1))
    # off the constraints the equations without feedback have drift modes only; along them they have the mechanism's own
    eigenvalues = np.linalg.eigvals(jacobian) if np.all(np.isfinite(jacobian)) else np.zeros(1)
    rate = np.zeros_like(start.y)
    iw = np.zeros(len(COUNTERS), dtype=np.int64)
    rate_function(compiled)(start.t, start.y.copy(), start.p, start.w.copy(), iw, rate)
    # speeds and accelerations of points, over the mechanism's length
    levers = 1.0 / (float(start.w[abi.LENGTH]) * np.sqrt(compiled.section(start.w, "gauge")))
    speed = float(np.abs(info.parts(start.y)[1] * levers).max(initial=0.0))
    acceleration = float(np.abs(info.parts(rate)[1] * levers).max(initial=0.0))
    change = max(speed, np.sqrt(acceleration), 1.0 / until)
    return Facts(
        rows=compiled.in_force(start.w),
        rank=start.rank,
        coordinates=info.nq,
        massless=bool(info.massless),
        fastest_decay=float(max(0.0, -eigenvalues.real.min(initial=0.0))),
        slowest_change=float(change),
        together=bool(rates_at_nodes(compiled)[1]) and not discontinuities_of(mechanism),
        vibration=_vibration(mechanism, start.p),
    )


def _vibration(mechanism: Mechanism, p: Array) -> float:
    """Return a bound of the angular frequencies of undamped beam elements with the masses of their ends [1/s]."""
    values = dict(zip((q.name for q in mechanism.parameters), p.tolist(), strict=False))
    light = dict[str, tuple[float, float]]()
    largest = 0.0
    for force in mechanism.forces:
        for flexure in force.flexures:
            times = flexure.damping if isinstance(flexure.damping, tuple) else (flexure.damping,)
            if ZERO not in times:
                return 0.0
            for body in (mechanism.body(name) for name in force.bodies if name not in light and name != GROUND):
                turns = body.inertia if isinstance(body.inertia, tuple) else (body.inertia,)
                sizes = [evaluate_formula(e, values, body.name) for e in (body.mass, *turns[:3]) if e is not None]
                light[body.name] = 1.0 / max(sizes[0], 1e-300), 1.0 / max(min(sizes[1:]), 1e-300)
            h = evaluate_formula(flexure.length, values, force.name)
            soft = [evaluate_formula(e, values, force.name) for e in flexure.compliances]
            by_mass, by_inertia = (sum(light[b][i] for b in force.bodies if b != GROUND) for i in range(2))
            across = soft[1 : 2 if len(soft) == 3 else 3]
            sheared = max(
                1.0 / (h * s + h**3 * b / 12.0) for s, b in zip(across, soft[: -len(across) - 1 : -1], strict=True)
            )
            twisted = max(1.0 / (h * s) for s in soft[(2 if len(soft) == 3 else 3) :])
            squares = by_mass / (h * soft[0]), by_mass * sheared, by_inertia * (twisted + 0.25 * h * h * sheared)
            largest = max(largest, *squares)
    return float(np.sqrt(2.0 * largest))


def slow_steps(run: Prepared) -> float:
    """Return the part of the first steps of a run by `TOGETHER` whose iteration converges slowly."""
    simulation = run.simulation()
    simulation.enter(simulation.outputs(np.zeros(0)), pause=TRIAL)
    steps, slow = simulation.state.control[[abi.STEPS, abi.POINTS]]
    return float(slow) / max(float(steps), 0.5 * TRIAL)


def rate_of_motion(run: Prepared) -> float | None:
    """Return rms(v') / rms(v) over the outputs of a run [1/s], None where nothing moves.

    Angular velocities count as speeds, in the metric of the mechanism's lengths, so that units do not matter.
    """
    outcome = run.of_bodies(run.integrate())
    weights = outcome.compiled.section(outcome.w, "gauge")
    _, v = outcome.compiled.info.parts(outcome.states)
    speeds, changes = (float(np.sum(np.square(x) / weights)) for x in (v, outcome.accelerations))
    rate = np.sqrt(changes / speeds) if speeds > 0.0 else np.inf
    return float(rate) if np.isfinite(rate) and rate > 0.0 else None


def constant_integrator(method: str, where: str = "method") -> str:
    """Return the integrator that studies take a method with: `CONSTANT`, or its own where it solves another form."""
    chosen = METHODS.get(method, where)
    return CONSTANT if set(INTEGRATORS.get(CONSTANT).forms) & set(chosen.forms) else chosen.default_integrator


def stiff_by_steps(run: Prepared, outcome: Outcome) -> tuple[str, ...]:
    """Return a sentence about a run whose many steps stability bounded, not the motion; none where nothing shows that.

    The iteration of `TOGETHER` shows it by itself. Of other explicit schemes the eigenvalues at the start do.
    """
    integrator, implicit = run.plan.integrator, set(INTEGRATORS.get("radau5").forms)
    if outcome.steps < LONG or not run.spec.adaptive or "ode" not in integrator.forms:
        return ()
    if not implicit & set(run.plan.choice.method.forms):
        return ()
    if integrator.name == TOGETHER:
        slow = outcome.counters["slow_steps"]
        if slow < SLOW * outcome.steps:
            return ()
        why = f"the iteration of {TOGETHER} converged slowly in {slow} of {plural(outcome.steps, 'step')}"
    else:
        facts = facts_of_plan(run.plan.mechanism, *run.assembled.of_bodies, run.spec.until)
        if facts.stiffness <= STIFF_RATIO:
            return ()
        why = f"the fastest decay at the start, {facts.fastest_decay:.3g} 1/s, bounded the steps of {integrator.name}"
    return (f"{why}: the motion is stiff, radau5 takes longer steps",)


def automatic_choice(facts: Facts, method: str, integrator: str | None) -> tuple[str, str | None, tuple[str, ...]]:
    """Return method, integrator and the reasons, for whichever of the two is ``auto``.

    The rules come from measured rows (see ``docs/methods.md``): `direct-correction` in the metric of M carried runs
    through singular positions with the smallest errors and costs little more than `lagrange`; `radau5` is for decay
    that is much faster than the motion.
    """
    reasons: list[str] = []
    if (method, integrator) == (AUTO, AUTO) and facts.vibrates and not facts.massless:
        reasons.append(
            f"method and integrator {STRUCTURAL} with its own steps: beam elements vibrate with up to "
            f"{facts.vibration:.3g} rad/s undamped, far faster than the motion"
        )
        return STRUCTURAL, STRUCTURAL, tuple(reasons)
    if method == AUTO:
        method = "direct-correction"
        if facts.rows == 0:
            method = "lagrange"
            reasons.append("method lagrange: there are no constraints to keep")
        elif facts.massless:
            reasons.append("method direct-correction with the identity as weight: a body has no mass")
        else:
            reasons.append(
                "method direct-correction with weight=mass: constraints hold to rounding, and passages near singular "
                "positions are met with the smallest errors"
            )
        if facts.rank < facts.rows:
            reasons.append(
                f"{facts.rows - facts.rank} of {facts.rows} rows depend on others: they are skipped, "
                "accelerations stay unique"
            )
    if integrator == AUTO:
        integrator, reason = _integrator(facts, method)
        reasons.append(reason)
    return method, integrator, tuple(reasons)


def _integrator(facts: Facts, method: str) -> tuple[str, str]:
    """Return the integrator that suits the facts among those that fit a method, and why."""
    chosen, unknowns = METHODS.get(method), 2 * facts.coordinates + facts.rows
    forms = set(chosen.forms)
    if not forms & set(INTEGRATORS.get(EXPLICIT).forms):
        name = chosen.default_integrator
        return name, f"integrator {name}: it solves the form of {method} ({', '.join(chosen.forms)})"
    if unknowns > LARGEST_LINEARISED and facts.stiffness <= STIFF_RATIO:
        return EXPLICIT, (
            f"integrator dop853: with {unknowns} unknowns a stage, stiffness was not tested; if it is, ask for radau5"
        )
    if facts.stiffness <= STIFF_RATIO and facts.slow <= SLOW:
        name = TOGETHER if facts.together and forms & set(INTEGRATORS.get(TOGETHER).forms) else EXPLICIT
        return name, f"integrator {name}: the fastest decay, {facts.fastest_decay:.3g} 1/s, needs no implicit scheme"
    if not forms & set(INTEGRATORS.get("radau5").forms):
        return EXPLICIT, f"integrator dop853: stiff, but {method} has no form for implicit integrators"
    if facts.slow > SLOW:
        return "radau5", f"integrator radau5: the iteration of {TOGETHER} converges slowly, as of stiff motions"
    return "radau5", (
        f"integrator radau5: the fastest decay, {facts.fastest_decay:.3g} 1/s, would ask explicit schemes for "
        f"{facts.stiffness:.3g} times the steps that the motion needs"
    )

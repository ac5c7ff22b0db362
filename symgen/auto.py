"""Automatic choice of method and integrator from facts of the model, each with its reason, and a check of the result.

Who leaves the choice to the program has not looked at tolerances either. So a run with anything chosen is repeated with
finer steps until two runs agree; where they do not, the result says so and is not ok.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from symgen.integrators import INTEGRATORS
from symgen.ir.program import COUNTERS
from symgen.methods import METHODS
from symgen.runtime import abi
from symgen.runtime.probe import call_rhs
from symgen.runtime.run import integrate

if TYPE_CHECKING:
    from symgen.api import Model
    from symgen.model import CompiledModel
    from symgen.plan import Plan, Settings
    from symgen.runtime.assembly import Start
    from symgen.runtime.run import Outcome

#: What asks for an automatic choice.
AUTO = "auto"
#: A mechanism counts as stiff where stability asks for this many times the steps that following its motion does.
STIFF_RATIO = 20.0
#: Steps of an adaptive run of high order over the time in which its state changes by its own size.
_STEPS_A_CHANGE = 8.0
#: Above this many unknowns of a stage nobody asks for eigenvalues: they would take longer than a run.
LARGEST_LINEARISED = 400
#: Runs agree when no point of a body differs by more than this [m], and by this share of the largest body's length.
AGREEMENT, AGREEMENT_SHARE = 2.5e-4, 1e-3
#: Finer runs have this share of the tolerances, where they differ by far the square of it, or this share of the step.
FINER, FINER_STEP = 0.1, 0.5
#: Tolerances are not made smaller than this.
SMALLEST_RTOL = 1e-13


@dataclass(frozen=True)
class Facts:
    """What the choice looks at.

    Attributes
    ----------
    rows, rank : int
        Constraint rows and their rank at the start.
    coordinates : int
        Size of q.
    massless : bool
        Whether a body has no mass.
    fastest_decay, fastest_oscillation : float
        Largest negative real part and imaginary part of the eigenvalues of the linearised motion at the start [1/s].
    slowest_change : float
        Rate at which the state changes by its own size [1/s].
    """

    rows: int
    rank: int
    coordinates: int
    massless: bool
    fastest_decay: float
    fastest_oscillation: float
    slowest_change: float

    @property
    def stiffness(self) -> float:
        """Steps that stability asks of an explicit scheme over those that following the motion takes."""
        return self.fastest_decay / 3.0 / max(self.slowest_change * _STEPS_A_CHANGE, 1e-300)


def linearised(compiled: CompiledModel, start: Start) -> NDArray[np.float64]:
    """Return the Jacobian of (q', v') with respect to (q, v) at the start, by central differences: an estimate only.

    Parameters
    ----------
    compiled : CompiledModel
        A method whose rates are those of the state.
    start : Start
        Where to linearise.
    """
    width = len(start.y) - 1
    result = np.zeros((width, width))
    iw = np.zeros(len(COUNTERS), dtype=np.int64)
    for j in range(width):
        step = 1e-6 * max(1.0, abs(float(start.y[j])))
        sides = []
        for sign in (1.0, -1.0):
            y, rate = start.y.copy(), np.zeros_like(start.y)
            y[j] += sign * step
            call_rhs(compiled.law_module.rhs, 0.0, y, start.p, start.w.copy(), iw, rate)
            sides.append(rate[:width])
        result[:, j] = (sides[0] - sides[1]) / (2.0 * step)
    return result


def gather(model: Model, parameters: Mapping[str, float], shape: str = "auto") -> Facts:
    """Return the facts of a model with given parameters; `shape` is that of the code that tells them."""
    from symgen.plan import Settings, make_plan

    plan = make_plan(model, Settings(method="lagrange", integrator="dop853", shape=shape))
    compiled, start = model.ready(plan, parameters)
    nq, width = compiled.info.nq, len(start.y) - 1
    small = 2 * nq + compiled.info.m <= LARGEST_LINEARISED
    jacobian = linearised(compiled, start) if small else np.zeros((1, 1))
    # off the constraints the equations without feedback have drift modes only; along them they have the mechanism's own
    eigenvalues = np.linalg.eigvals(jacobian) if np.all(np.isfinite(jacobian)) else np.zeros(1)
    rate = np.zeros_like(start.y)
    iw = np.zeros(len(COUNTERS), dtype=np.int64)
    call_rhs(compiled.law_module.rhs, 0.0, start.y.copy(), start.p, start.w.copy(), iw, rate)
    speed = max(1e-12, float(np.abs(start.y[nq:width]).max(initial=0.0)))
    acceleration = float(np.abs(rate[nq:width]).max(initial=0.0))
    change = max(speed, np.sqrt(acceleration), 1.0 / plan.spec.until)
    return Facts(
        rows=compiled.info.m,
        rank=start.rank,
        coordinates=nq,
        massless=bool(compiled.info.massless),
        fastest_decay=float(max(0.0, -eigenvalues.real.min(initial=0.0))),
        fastest_oscillation=float(np.abs(eigenvalues.imag).max(initial=0.0)),
        slowest_change=float(change),
    )


def decide(facts: Facts, method: str, integrator: str | None) -> tuple[str, str | None, tuple[str, ...]]:
    """Return method, integrator and the reasons, for whichever of the two is ``auto``.

    The rules come from measured rows (see ``docs/methods.md``): `direct-correction` in the metric of M carried runs
    through singular positions with the smallest errors and costs little more than `lagrange`; `radau5` is for decay
    that is much faster than the motion.
    """
    reasons: list[str] = []
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
    if not forms & set(INTEGRATORS.get("dop853").forms):
        name = chosen.default_integrator
        return name, f"integrator {name}: it solves the form of {method} ({', '.join(chosen.forms)})"
    if unknowns > LARGEST_LINEARISED and facts.stiffness <= STIFF_RATIO:
        return "dop853", (
            f"integrator dop853: with {unknowns} unknowns a stage nobody looked whether the motion is stiff; "
            "if it is, ask for radau5"
        )
    if facts.stiffness <= STIFF_RATIO:
        asks = f"the fastest decay, {facts.fastest_decay:.3g} 1/s, asks for no implicit scheme"
        return "dop853", f"integrator dop853: {asks}"
    if not forms & set(INTEGRATORS.get("radau5").forms):
        return "dop853", f"integrator dop853: stiff, but {method} has no form for implicit integrators"
    return "radau5", (
        f"integrator radau5: the fastest decay, {facts.fastest_decay:.3g} 1/s, would ask explicit schemes for "
        f"{facts.stiffness:.3g} times the steps that the motion needs"
    )


def resolve(model: Model, settings: Settings) -> tuple[Settings, tuple[str, ...]]:
    """Return settings without ``auto``, and the reasons of each choice.

    Parameters
    ----------
    model : Model
        The model.
    settings : Settings
        As asked for.
    """
    if AUTO not in (settings.method, settings.integrator):
        return settings, ()
    facts = gather(model, settings.parameters, settings.shape)
    method, integrator, reasons = decide(facts, settings.method, settings.integrator)
    options = dict(settings.options)
    if settings.method == AUTO and method == "direct-correction" and not facts.massless:
        options.setdefault("method.weight", "mass")
    return replace(settings, method=method, integrator=integrator, options=options), reasons


# -- the check ---------------------------------------------------------------------------------------------------------


@dataclass(frozen=True)
class Settled:
    """A run that was repeated with finer steps.

    Attributes
    ----------
    plan, outcome : Plan, Outcome
        The finest run and what it was.
    doubt : str or None
        Why the motion is not known well enough; None where two runs agree.
    note : str or None
        What was done, one sentence.
    evaluations : int
        Of all runs together.
    """

    plan: Plan
    outcome: Outcome
    doubt: str | None
    note: str | None
    evaluations: int


def settle(model: Model, asked: Settings, plan: Plan, compiled: CompiledModel, outcome: Outcome) -> Settled:
    """Repeat a run with finer steps until two runs agree.

    Tolerances that were not asked for are made smaller until they do; a tolerance or step that was asked for is kept,
    and its run is compared with one finer run.

    Parameters
    ----------
    model : Model
        What was run.
    asked : Settings
        As asked for, with ``auto``.
    plan, compiled, outcome : Plan, CompiledModel, Outcome
        The run.

    Returns
    -------
    Settled
        The run as it is where it did not come to its end.
    """
    from symgen.study.points import Points

    total = outcome.evaluations
    if outcome.code != abi.DONE:
        return Settled(plan, outcome, None, None, total)
    points = Points.of(model.mechanism, model.parameters(asked.parameters))
    longest = max((length for _, length in points.bodies), default=0.0)
    limit = min(AGREEMENT, AGREEMENT_SHARE * longest) if longest > 0.0 else AGREEMENT
    free = plan.spec.adaptive and asked.rtol is None and asked.atol is None
    share, apart = FINER, 0.0
    nq = compiled.info.nq
    while True:
        finer = _finer(plan, share)
        name = _steps_of(finer)
        if free and apart > 0.0 and finer.spec.rtol < SMALLEST_RTOL:
            return Settled(plan, outcome, f"two runs still differ by {apart:.2g} m at {_steps_of(plan)}", None, total)
        second = integrate(compiled, plan.tableau, outcome.start, finer.spec)
        total += second.evaluations
        if second.interrupted:
            note = "the check with finer steps was interrupted"
            return Settled(plan, replace(outcome, interrupted=True), note, None, total)
        if second.code != abi.DONE:
            what = second.reason if second.code != abi.STOPPED else "it takes too many evaluations"
            return Settled(plan, outcome, f"a check with {name} did not come to its end: {what}", None, total)
        with np.errstate(all="ignore"):
            apart = points.distance(outcome.states[:, :nq], second.states[:, :nq])
        if apart <= limit:
            kept, result = (finer, second) if free else (plan, outcome)
            return Settled(kept, result, None, f"checked: a run with {name} agrees within {apart:.2g} m", total)
        if not free:
            return Settled(plan, outcome, f"a run with {name} differs by {apart:.2g} m", None, total)
        # errors fall about as tolerances do: far from agreement, the next but one is tried
        share = FINER**2 if apart > limit / FINER else FINER
        plan, outcome = finer, second


def _finer(plan: Plan, share: float) -> Plan:
    spec = plan.spec
    if spec.adaptive:
        return replace(plan, spec=replace(spec, rtol=spec.rtol * share, atol=spec.atol * share))
    assert spec.step is not None, "a constant step is given"
    return replace(plan, spec=replace(spec, step=spec.step * FINER_STEP))


def _steps_of(plan: Plan) -> str:
    return f"rtol = {plan.spec.rtol:g}" if plan.spec.adaptive else f"step = {plan.spec.step:g} s"

"""Cost limits of the cells of a stress study, by a mechanism's size and never by a clock.

Budgets hold for small mechanisms, and fall as mechanisms grow: with the coordinates for explicit schemes, with the
third power of a stage's unknowns for implicit ones. That exceeds the cost of sparse Newton matrices, and keeps studies
of large mechanisms short.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from symgen.derive.lower.looped.looped_law import is_loopable
from symgen.derive.methods._base import EXPLICIT_FORMS
from symgen.run.compiling.choices import straight_seconds
from symgen.run.compiling.method_choice import choose_method
from symgen.run.integrators import INTEGRATORS
from symgen.run.planning.automatic import AUTO, constant_integrator

if TYPE_CHECKING:
    from symgen.describe.mechanism import Mechanism
    from symgen.run.planning.plan import Plan

#: Evaluations that a run of a small mechanism may take: of right-hand sides at constant and at adaptive steps, and of
#: residuals of implicit stages, which come with Newton's matrices.
BUDGET, ADAPTIVE_BUDGET, IMPLICIT_BUDGET = 5_000_000, 2_500_000, 100_000
#: The same of explicit runs of a quick study, at constant and at adaptive steps: ten times what its longest needs.
QUICK_BUDGET = 500_000
#: Rows with bounds choose their modes and strike: an evaluation of theirs costs about so many; a quick study counts
#: fewer, as its budget is near what some runs need.
BOUNDED, QUICK_BOUNDED = 20, 5
#: A quick study ends a run of constant explicit steps with rows with bounds after so many times the evaluations that it
#: takes without changes of modes: those that follow a motion need up to twice as many.
EVENTFUL = 5.0
#: A search for a limit takes some ten runs, each by explicit steps within this part of the budget of a run alone.
SEARCHED = 2
#: A run that stopped itself goes on without its watch for so many times its evaluations, and for so many at least.
FURTHER, LEAST_FURTHER = 100, 100_000
#: A quick study goes on for so many where the pace so far would take this many times the budget to the end.
QUICK_FURTHER, SLOW_PACE = 20_000, 10.0
#: Coordinates, and unknowns of an implicit stage, up to which a mechanism is small.
SMALL, SMALL_STAGE = 15, 30
#: Powers of the coordinates and of a stage's unknowns with which explicit and implicit budgets of a quick study fall:
#: with those of a whole one its time would go into runs of large mechanisms that come to no end. Explicit budgets keep
#: this part, a little more than the longest run needs.
QUICK_FALL, QUICK_IMPLICIT_FALL, QUICK_LEAST = 1.5, 4.0, 0.12
#: No budget of implicit stages is below this: some hundred steps, fewer in a quick study.
LEAST_IMPLICIT, QUICK_LEAST_IMPLICIT = 1_500, 500
#: Mechanisms of more coordinates get no implicit reference: SciPy's Newton matrices are dense.
LARGEST_IMPLICIT_REFERENCE = 40
#: In space, code of dense matrices takes the times of this many coordinates longer than sparse code to compile.
DENSE = 25
#: An explicit adaptive run is not begun where the decay at the start asks for so many times its budget.
HOPELESS = 1.5


def explicit_budget(mechanism: Mechanism, most: int = BUDGET, quick: bool = False) -> int:
    """Return the evaluation limit of a sparse right-hand side, `most` for a small mechanism."""
    share = min(1.0, SMALL / mechanism.body_coordinates)
    return int(most * (max(share**QUICK_FALL, QUICK_LEAST) if quick else share))


def implicit_budget(mechanism: Mechanism, most: int = IMPLICIT_BUDGET, quick: bool = False) -> int:
    """Return the limit of residuals of implicit stages, `most` for a small mechanism."""
    speeds = sum(len(body.speeds) for body in mechanism.bodies)
    unknowns = 2 * speeds + sum(len(joint.rows) for joint in mechanism.joints)
    least, fall = (QUICK_LEAST_IMPLICIT, QUICK_IMPLICIT_FALL) if quick else (LEAST_IMPLICIT, 3.0)
    return max(least, int(most * min(1.0, (SMALL_STAGE / unknowns) ** fall)))


def explicit_limits(quick: bool) -> tuple[int, int]:
    """Return the evaluation limits of a small mechanism at constant and at adaptive steps."""
    return (QUICK_BUDGET, QUICK_BUDGET) if quick else (BUDGET, ADAPTIVE_BUDGET)


def evaluation_budget(plan: Plan, mechanism: Mechanism, searched: bool = False, quick: bool = False) -> int:
    """Return the evaluation limit of a run, or of one of the many of a search; less in a quick study."""
    if is_implicit(plan):
        return implicit_budget(mechanism, quick=quick)
    most = explicit_limits(quick)[plan.spec.adaptive] // (SEARCHED if searched else 1)
    if not mechanism.bounded:
        return explicit_budget(mechanism, most, quick)
    budget = explicit_budget(mechanism, most // (QUICK_BOUNDED if quick else BOUNDED), quick)
    if quick and not plan.spec.adaptive and "ode" in plan.integrator.forms:
        return min(budget, int(EVENTFUL * least_evaluations(plan, 0.0)))
    return budget


def smallest_step(plan: Plan, budget: int) -> float:
    """Return the smallest constant step of a run within a budget [s]."""
    return least_evaluations(plan, 0.0) * (plan.spec.step or 0.0) / budget


def further_budget(budget: int, used: int, quick: bool = False, done: float = 1.0) -> int:
    """Return the evaluation limit, without its watch, of a run that stopped itself after `used`.

    Off the constraints steps may become tiny, and iterated methods need many iterations. `done` is the part of its time
    that the run has taken: a quick study does not wait for runs that come to no end.
    """
    if quick and used > SLOW_PACE * budget * done:
        return min(budget, QUICK_FURTHER)
    return min(budget, max(LEAST_FURTHER, FURTHER * used))


def is_implicit(plan: Plan) -> bool:
    """Whether a run solves for implicit stages."""
    return plan.choice.implicit and "index-1" in plan.integrator.forms


def least_evaluations(plan: Plan, decay: float) -> float:
    """Return a lower bound of a run's evaluations.

    Parameters
    ----------
    plan : Plan
        The run.
    decay : float
        Fastest decay at the start [1/s].

    Returns
    -------
    float
        With constant steps one evaluation a stage; for an explicit adaptive run the number that stability requires at
        the start, over `HOPELESS`, as the decay may fall later; else 0.
    """
    stages, spec = float(plan.integrator.stages), plan.spec
    if not spec.adaptive:
        return 0.0 if spec.step is None else spec.until / spec.step * stages
    if is_implicit(plan):
        return 0.0
    return decay * spec.until / plan.integrator.real_boundary * stages / HOPELESS


# -- compilation -------------------------------------------------------------------------------------------------------


def needs_straight(method: str, integrator: str) -> bool:
    """Whether a pair has no looped shape, so that it is compiled for each mechanism anew."""
    if method == AUTO:
        return False  # its choice depends on the case
    choice = choose_method(method, {}, not EXPLICIT_FORMS & set(INTEGRATORS.get(integrator).forms))
    return not is_loopable(choice.method, choice.options, choice.implicit)


def pairs_left_out(
    mechanisms: Sequence[Mechanism], pairs: Sequence[tuple[str, str]], seconds: float, straight: bool = False
) -> list[tuple[str, str, str, str]]:
    """Return mechanism, method, integrator and reason of the pairs that do not fit into a time of compilation.

    Parameters
    ----------
    mechanisms : sequence of Mechanism
        Mechanisms made of a base model with equations of their own, the base first.
    pairs : sequence of (str, str)
        Methods with their integrators.
    seconds : float
        Expected seconds of compilation that pairs without a looped shape may take together [s]. They are taken in the
        order of `mechanisms` and `pairs`, those with a method's own integrator first.
    straight : bool
        Whether all pairs have straight code, but the one that chooses for itself.
    """
    runs = [pair for pair in dict.fromkeys(pairs) if needs_straight(*pair) or (straight and pair[0] != AUTO)]
    runs.sort(key=lambda pair: constant_integrator(pair[0]) != pair[1])
    pairs_out, compiled, spent = [], set[tuple[str, str, bool]](), 0.0
    for mechanism in mechanisms:
        dense = max(1.0, mechanism.body_coordinates / DENSE) if mechanism.space == "spatial" else 1.0
        each = dense * straight_seconds(mechanism)
        for method, integrator in runs:
            # explicit integrators share the code of a method
            code = mechanism.name, method, bool(EXPLICIT_FORMS & set(INTEGRATORS.get(integrator).forms))
            if code not in compiled and spent + each <= seconds:
                spent += each
                compiled.add(code)
            if code not in compiled:
                why = f"its code does not fit into the {seconds:g} s of compilation"
                pairs_out.append((mechanism.name, method, integrator, why))
    return pairs_out

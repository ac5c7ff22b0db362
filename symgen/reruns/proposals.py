"""What to ask for after a run that failed: words of the command line, each tried before it is told."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import replace
from typing import TYPE_CHECKING, Any

from symgen.errors import SymgenError
from symgen.integrators import INTEGRATORS
from symgen.methods import METHODS
from symgen.result.judge import judge_alone
from symgen.result.run_data import OK
from symgen.running.prepare import make_plan, prepare
from symgen.runtime import abi
from symgen.settings import Settings, flag

if TYPE_CHECKING:
    from symgen.describe.mechanism import Mechanism
    from symgen.running.plan import Plan
    from symgen.runtime.outcome import Outcome

#: A trial may take so many operations, about a second of the processor; what would take more is not tried.
BUDGET = 2.5e9
#: By which constant steps are divided.
_FINER = (10.0, 100.0)
#: By which limits of violations are widened at most.
_WIDER = 100.0

Change = dict[str, Any]


def proposals(mechanism: Mechanism, settings: Settings, outcome: Outcome) -> tuple[str, ...]:
    """Return what makes a run that failed end as ok, in words to be added to its command; empty if nothing was found.

    Changes are tried one by one over the whole run, cheap ones first, until one works.

    Parameters
    ----------
    mechanism : Mechanism
        What was run.
    settings : Settings
        As asked for.
    outcome : Outcome
        What the loop gave.
    """
    chosen = settings.method not in METHODS.names or settings.integrator not in (None, *INTEGRATORS.names)
    if outcome.code in (abi.DONE, abi.STOPPED) or chosen:  # automatically
        return ()
    for change in _changes(make_plan(mechanism, settings), settings, outcome):
        asked = replace(settings, **change)
        try:
            if _works(mechanism, asked):
                return (" ".join(f"{flag(name)} {value}" for name, value in change.items()),)
        except SymgenError:  # a pair that does not fit, a start that is not found
            continue
    return ()


def _changes(plan: Plan, settings: Settings, outcome: Outcome) -> Iterator[Change]:
    """Yield what may help, what is nearest to what was asked for first."""
    off = outcome.code in (abi.POSITION, abi.VELOCITY)
    corrected = outcome.compiled.law.position_correction
    held: Change = {"method": "direct-correction"}
    if off and not corrected:
        yield held
    if not plan.spec.adaptive and plan.spec.step is not None:
        for finer in _FINER:
            yield {"step": _plain(plan.spec.step / finer)}
    elif off:
        yield {"rtol": _plain(plan.spec.rtol / _FINER[-1])}
    if "integrator.adaptive" not in settings.options:
        for name in ("dop853", "radau5"):
            if name != plan.integrator.name and set(INTEGRATORS.get(name).forms) & set(plan.choice.method.forms):
                yield {"integrator": name}
                if off and not corrected:
                    yield held | {"integrator": name}
    if plan.choice.method.name != "direct-correction":
        yield held | {"integrator": "dop853"}
    if plan.spec.adaptive:  # where a law has jumps, error estimates do not get across
        yield {"integrator": "rk4", "step": _plain(1e-4 * plan.spec.until)}
    if off:
        measure, scale = (
            (abi.PHI_MEASURE, abi.LENGTH) if outcome.code == abi.POSITION else (abi.DRIFT_MEASURE, abi.SPEED)
        )
        found = float(outcome.w[measure] / outcome.w[scale])
        if math.isfinite(found) and found < _WIDER * settings.max_violation:
            yield {"max_violation": _plain(_WIDER * settings.max_violation)}


def _plain(value: float) -> float:
    """Return a number with one digit."""
    return float(f"{value:.0e}")


def _works(mechanism: Mechanism, settings: Settings) -> bool:
    run = prepare(mechanism, settings)
    law, spec, integrator = run.compiled.law, run.spec, run.plan.integrator
    operations = max(1, sum(law.operations.get(name, 0) for name in ("rhs", "accept", "residual", "tangent")))
    most = BUDGET / operations
    duration = spec.until - run.start.t
    if not spec.adaptive and spec.step is not None and duration / spec.step * integrator.stages > most:
        return False
    outcome = run.with_spec(times=spec.times[-1:], max_evaluations=int(most)).integrate()
    if outcome.interrupted:
        raise KeyboardInterrupt
    return outcome.evaluations <= most and judge_alone(outcome, law.position_correction).status == OK

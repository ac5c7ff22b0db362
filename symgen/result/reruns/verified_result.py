"""One simulation: a run, where it can be judged a second one that estimates its error, and their result."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING

from symgen.compile.store.stats import seconds_in_cache
from symgen.result.build import build_result
from symgen.result.judge import is_long, reason_without_check
from symgen.result.reruns.verification import verify_first_part, verify_run
from symgen.run.planning.prepare import prepare
from symgen.run.single.timing import time_runs

if TYPE_CHECKING:
    from symgen.base.settings import Settings
    from symgen.describe.mechanism import Mechanism
    from symgen.result.result import Result


def run_and_verify(
    mechanism: Mechanism, settings: Settings, progress: Callable[[float], None] | None, by: Sequence[str]
) -> Result:
    """Return the result of a run.

    Parameters
    ----------
    mechanism, settings : Mechanism, Settings
        What runs, and how.
    progress : callable or None
        Called with the time reached.
    by : sequence of str
        Numbers that the motion is differentiated by, as `symgen.api.Model.simulate` takes them.
    """
    before = seconds_in_cache()
    if by:
        from symgen.describe.facts.lifted import lift_numbers
        from symgen.result.sensitivities import Differentiated

        own = lift_numbers("sensitivities", mechanism, by)
        directed = Differentiated(own.mechanism, settings, own.keys)
        run, integrate = directed.run, directed.integrate
    else:
        run = prepare(mechanism, settings)
        integrate = run.integrate
    runs = time_runs(lambda: integrate(progress), settings.repeat)
    outcome, verification = runs.outcome, None
    if reason_without_check(run, outcome) is None:
        free = bool(run.plan.notes) and settings.rtol is None and settings.atol is None and not by
        run, outcome, verification = verify_run(run, outcome, free)
        if settings.verify and run.plan.mechanism.beams:
            from symgen.result.reruns.discretisation import discretisation_error_sentence

            words = discretisation_error_sentence(run, outcome, settings)
            note = "; ".join(x for x in (verification.note, words) if x)
            verification = replace(verification, note=note or None)
    elif is_long(run, outcome):
        verification = verify_first_part(run, outcome)
    # assembly calls emitted functions too: compiling them belongs to the run
    outcome = replace(outcome, compile_seconds=seconds_in_cache() - before)
    result = build_result(run, outcome, runs.spread or 0.0, verification)
    return directed.result(result) if by else result

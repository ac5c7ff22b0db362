"""The verdict on a run, first in its report: what was asked, what came, where and when."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from symgen.analyses.reached_limits import ReachedLimit, reached_limits
from symgen.base.errors import enumeration, fit_lines, plural
from symgen.study.report.dead_points import sentence_on_passages
from symgen.study.report.document import TableCell
from symgen.study.report.key_numbers import ROOM, KeyNumber, key_numbers
from symgen.study.report.words import engineering_number, rounded_number

if TYPE_CHECKING:
    from symgen.describe.mechanism import Mechanism
    from symgen.result.result import Result

#: Limits that a verdict names at most.
MOST_NAMED = 4


class JudgedRun(NamedTuple):
    """A run with what a report says of it first.

    Attributes
    ----------
    result : Result
        The run.
    limits : tuple of ReachedLimit
        Of the file, as the run reaches them.
    numbers : tuple of KeyNumber
        Of the first screen; a failed run has none.
    verdict : TableCell
        One sentence with its mood.
    """

    result: Result
    limits: tuple[ReachedLimit, ...]
    numbers: tuple[KeyNumber, ...]
    verdict: TableCell


def judge_run(mechanism: Mechanism, result: Result) -> JudgedRun:
    """Return a run with its limits, its first numbers and the verdict on it."""
    limits = tuple(reached_limits(mechanism, result)) if len(result.t) else ()
    numbers = key_numbers(mechanism, result) if len(result.t) and result.status != "failed" else ()
    return JudgedRun(result, limits, numbers, verdict_on_run(result, limits, numbers))


def verdict_on_run(result: Result, limits: Sequence[ReachedLimit], numbers: Sequence[KeyNumber] = ()) -> TableCell:
    """Return one sentence: a failure, then a passage of a singular position, limits that are exceeded, and doubts.

    It is good where nothing is said of the run but what it reaches, and doubtful where it has a warning.

    Parameters
    ----------
    result : Result
        The run.
    limits : sequence of ReachedLimit
        Of the file.
    numbers : sequence of KeyNumber, optional
        Of the first screen: the way to a dead centre is said as well.
    """
    if result.status == "failed":
        return TableCell(f"Failed{_end_of_run(result)}: {result.reason}.", "bad")
    broken = [each for each in limits if not each.is_met]
    if result.rank_events:
        exceeded = f" {_sentence_on_broken_limits(broken, len(limits))}" if broken else ""
        return TableCell(f"{sentence_on_passages(result)}.{exceeded}", "bad")
    if broken:
        doubts = "" if result.status == "ok" else f" The run is not verified: {result.reason}."
        return TableCell(f"{_sentence_on_broken_limits(broken, len(limits))}{doubts}", "bad")
    if result.status != "ok":
        return TableCell(f"Not verified: {result.reason}.", "bad")
    kept = f" and keeps {plural(len(limits), 'limit')} of the file" if limits else ""
    reached = f" reaches {result.t[-1]:g} s" if len(result.t) else " ends"
    room = "".join(f", {each.value} from a dead centre" for each in numbers if each.what == ROOM)
    doubts = f" Warning: {'; '.join(result.warnings)}." if result.warnings else ""
    text = f"The run{reached}{kept}{room}{_trust_in_run(result)}.{doubts}"
    return TableCell(text, "doubtful" if doubts else "good")


def _end_of_run(result: Result) -> str:
    """Return when a run ended, where its reason does not say so."""
    return "" if " at t = " in (result.reason or "") or not len(result.t) else f" at t = {result.t[-1]:.6g} s"


def _sentence_on_broken_limits(broken: Sequence[ReachedLimit], count: int) -> str:
    first = fit_lines(len(broken), MOST_NAMED)
    named = [_broken_limit(each) for each in broken[:first]]
    named += [f"{len(broken) - first} more"] if len(broken) > first else []
    verb = "is" if len(broken) == 1 else "are"
    return f"{len(broken)} of {plural(count, 'limit')} {verb} exceeded: {enumeration(named)}."


def _broken_limit(each: ReachedLimit) -> str:
    reached, limit = engineering_number(each.reached, each.unit), engineering_number(each.limit, each.unit)
    when = "" if each.t is None else f", at t = {each.t:.4g} s"
    return f"{each.name} ({reached} for {'at most' if each.side == 'largest' else 'at least'} {limit}{when})"


def _trust_in_run(result: Result) -> str:
    """Return how far a motion and its energies can be trusted."""
    estimate, drift = result.error_estimate, result.energy_drift_max
    parts = [] if estimate is None else [f"its error is {rounded_number(estimate)} m by a second run"]
    parts += [f"its energy is in balance to {engineering_number(drift, 'J')}"] if np.isfinite(drift) else []
    return f"; {enumeration(parts)}" if parts else ""

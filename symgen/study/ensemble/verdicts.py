"""Status of each run of an ensemble by the rules of single runs, and the reasons of failures."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from numpy.typing import NDArray

from symgen.base.ir.numerics import WARN
from symgen.result.judge import DRIFT_DOUBT, JUMP_DOUBT, LEFT_DOUBT, judge_alone, judge_balance
from symgen.result.result import FAILED, OK
from symgen.run.effects.applying import NO_VALUES
from symgen.run.layout import abi
from symgen.run.layout import ensemble_abi as e
from symgen.run.modes.refusals import HOLDING_SENTENCES, names_in, refusal, refusal_of_catch
from symgen.run.single.contact_notes import sentence_on_motions
from symgen.run.single.events import accumulation_sentence, undefined_sentence
from symgen.run.single.outcome import Ended, RankEvent
from symgen.run.single.run import end_reason
from symgen.run.starts.start_words import start_refusal

if TYPE_CHECKING:
    from symgen.base.vocabulary.infos import LawInfo
    from symgen.run.layout.compiled import ModelInfo
    from symgen.run.loops.run_spec import BoundedNames, RunSpec

Array = NDArray[np.float64]


class EventNames(NamedTuple):
    """Names of what ends runs.

    Attributes
    ----------
    events : sequence of str
        Events that were looked for.
    bounded : BoundedNames or None
        Rows with bounds.
    tree : bool
        Whether runs are in joint coordinates, whose rows are others.
    further : sequence of str
        Events of rows with bounds, which come after the others.
    """

    events: Sequence[str]
    bounded: BoundedNames | None = None
    tree: bool = False
    further: Sequence[str] = ()


#: Status of a run that has not been done.
NOT_RUN = "not run"
#: What is said of velocities that could not be what they were given as.
_PROJECTED = "given velocities contradicted the constraints and were projected; `strict` lets such runs fail"


def summary_column(summary: Array, name: str) -> Array:
    """Return one number of every run, shape (n,)."""
    return np.asarray(summary[..., e.SUMMARY.index(name)])


def judge_runs(
    summary: Array, done: NDArray[np.bool_], info: ModelInfo, law: LawInfo, spec: RunSpec, events: EventNames
) -> tuple[NDArray[np.str_], NDArray[np.object_]]:
    """Return status and reason of every run.

    Parameters
    ----------
    summary : Array, shape (n, N_SUMMARY + width)
        See `symgen.run.layout.ensemble_abi`.
    done : Array of bool, shape (n,)
        Which runs have been done.
    info, law : ModelInfo, LawInfo
        The model and its law.
    spec : RunSpec
        How.
    events : EventNames
        Those that were looked for.

    Returns
    -------
    status : Array of str
        ``ok``, ``unverified``, ``failed`` or ``not run``.
    reason : Array of object
        Sentences; empty where the status is ok.
    """
    status = np.full(len(summary), OK, dtype="<U10")
    reason = np.full(len(summary), "", dtype=object)
    status[~done] = NOT_RUN
    passed = (summary_column(summary, "rank_event_count") > 0.0) | (summary_column(summary, "smallest_pivot") < WARN)
    doubtful = (summary_column(summary, "start") != e.ASSEMBLED) | (summary_column(summary, "code") != abi.DONE)
    uncorrected = np.bool_(not law.position_correction)
    doubtful |= (
        law.energy_correction
        | _near(summary, "energy_jump", JUMP_DOUBT)
        | (passed & (uncorrected | _near(summary, "energy_drift_max", DRIFT_DOUBT)))
    )
    doubtful |= ~(summary_column(summary, "imbalance") <= LEFT_DOUBT)
    for i in np.flatnonzero(done & doubtful):
        row = summary[i]
        if summary_column(row, "start") != e.ASSEMBLED:
            status[i], reason[i] = FAILED, str(start_refusal(row, info))
            continue
        if (why := _reason_of_events(row, events, info)) is not None:
            status[i], reason[i] = FAILED, why
            continue
        verdict = judge_alone(_reason_of_end(row, spec), law)
        if verdict.status != FAILED:
            verdict = judge_balance(verdict, float(summary_column(row, "imbalance")), law)
        status[i], reason[i] = verdict.status, verdict.reason or ""
    return status, reason


def warnings_of_runs(
    summary: Array, done: NDArray[np.bool_], law: LawInfo, spec: RunSpec
) -> dict[int, tuple[str, ...]]:
    """Return the verdicts on runs by what their loops saw, by run.

    Parameters
    ----------
    summary, done, law, spec
        As for `judge_runs`.
    """
    odd = (summary_column(summary, "rank_event_count") > 0.0) | (summary_column(summary, "smallest_pivot") < WARN)
    odd |= summary_column(summary, "light_evaluations") > 0.0
    ready, projected = (
        done & (summary_column(summary, "start") == e.ASSEMBLED),
        summary_column(summary, "start_velocities") == 1.0,
    )
    warnings: dict[int, tuple[str, ...]] = {int(i): (_PROJECTED,) for i in np.flatnonzero(ready & projected)}
    for i in np.flatnonzero(ready & odd).tolist():
        warnings[i] = (*warnings.get(i, ()), *judge_alone(_reason_of_end(summary[i], spec), law).warnings)
    unsought = summary[:, e.N_SUMMARY + e.UNSOUGHT :][:, :1]  # nothing where no events are looked for
    for i in np.flatnonzero(ready & (unsought > 0.0).any(axis=1)).tolist():
        warnings[i] = (*warnings.get(i, ()), *sentence_on_motions(int(unsought[i, 0])))
    return warnings


def _reason_of_events(row: Array, looked: EventNames, info: ModelInfo) -> str | None:
    """Return why an event, modes, or an input ended a run as failed, None where none did."""
    events = looked.events
    code, time, further = int(summary_column(row, "code")), float(summary_column(row, "end")), row[e.N_SUMMARY :]
    if code == abi.GATHERED:
        return accumulation_sentence(names_in(float(further[e.GATHERING]), events), float(further[e.ACCUMULATION]))
    if code == abi.UNDEFINED:
        watched, k = (*events, *looked.further), further[e.IMPOSSIBLE_EVENT] if len(further) else np.nan
        if k < len(watched):
            return undefined_sentence(watched[int(k)], time)
        return f"{abi.REASONS[code]} at t = {time:.6g} s"
    if code == e.NO_MODES and looked.bounded is not None:
        failure, which, first, second = (float(x) for x in further[e.FAILURE : e.SECOND_NUMBER + 1])
        rows = [] if looked.tree else [row.name for row in info.rows]
        return str(refusal(looked.bounded, rows, int(failure), which, first, second, time))
    if code != e.IMPOSSIBLE:
        return None
    if not len(further) or np.isnan(further[e.IMPOSSIBLE_EVENT]):
        return f"inputs: expected values for which every formula is finite, got others at t = {time:.6g} s"
    name = events[int(further[e.IMPOSSIBLE_EVENT])]
    if (failure := float(further[e.FAILURE])) in HOLDING_SENTENCES:
        return str(refusal_of_catch(int(failure), name, float(further[e.FIRST_NUMBER]), time))
    values = further[e.FAILURE] == NO_VALUES
    expected = "one finite value of each state" if values else "velocities that the joints and each other allow"
    return f"event '{name}': reset: expected {expected}, got others at t = {time:.6g} s"


def _near(summary: Array, error: str, doubt: float) -> NDArray[np.bool_]:
    """Return which runs are to be judged one by one, as an error comes near a part of the energy in motion."""
    return np.asarray(summary_column(summary, error) > 0.5 * doubt * summary_column(summary, "energy_scale"))


def _reason_of_end(row: Array, spec: RunSpec) -> Ended:
    numbers = {name: float(row[k]) for k, name in enumerate(e.SUMMARY)}
    code, scale = int(numbers["code"]), numbers["energy_scale"]
    names = ("position_violation", "velocity_violation", "length_scale", "speed_scale")
    attempts = int(numbers["steps"] + numbers["rejected"])
    events: tuple[RankEvent, ...] = ()
    if numbers["rank_event_count"] > 0.0:
        events = (RankEvent(numbers["narrowest_time"], np.nan, 0, numbers["narrowest_pivot"]),)
    return Ended(
        code=code,
        reason=end_reason(code, numbers["end"], tuple(numbers[name] for name in names), scale, attempts, spec),
        smallest_pivot=numbers["smallest_pivot"],
        rank_events=events,
        rank_event_count=int(numbers["rank_event_count"]),
        energy_drift_max=numbers["energy_drift_max"],
        energy_jump=numbers["energy_jump"],
        energy_scale=scale,
        counters={"light": int(numbers["light_evaluations"])},
    )

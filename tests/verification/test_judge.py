"""The judge itself: runs that are right pass, runs that are not do not, whatever they say."""

import dataclasses
import tomllib
from pathlib import Path

import numpy as np
import pytest

from benchmarks.mechanisms.draw import draw
from benchmarks.mechanisms.toml import text
from benchmarks.verification.judge import judge
from benchmarks.verification.reference import Contradiction, Reference, groups, prepared
from benchmarks.verification.runs import Configuration, Outcome
from benchmarks.verification.workers import answers

CONFIGURATION = Configuration("direct-correction", "rk4", "straight")


@pytest.fixture(scope="module")
def reference() -> Reference:
    return prepared(draw(5, 2, spatial=True).raw, until=0.2, steps=100)


def outcome(reference: Reference, status: str = "ok") -> Outcome:
    """A run that is the reference's own motion."""
    system, motion = reference.system, reference.motion
    joints = {joint.name: k for k, joint in enumerate(system.joints)}
    labels = ("Fx", "Fy", "Fz", "Mx", "My", "Mz")
    return Outcome(
        status,
        "",
        reference.times,
        {name: np.array(getattr(motion, name)) for name in ("q", "v", "lam", "reactions")},
        {
            "q": tuple(system.names_q),
            "v": tuple(system.names_v),
            "lam": tuple(system.rows),
            "reactions": tuple(f"{joint}.{label}" for joint in joints for label in labels),
        },
        np.array(motion.energies) + np.array([0.0, 7.0, 0.0]),
    )


@pytest.mark.slow
def test_the_reference_itself_is_right(reference: Reference) -> None:
    verdict = judge(reference, CONFIGURATION, outcome(reference))
    assert verdict.honest and verdict.right and set(verdict.errors) == set(groups(reference.system, reference.motion))


@pytest.mark.slow_cases("1.01-q", "1.01-v")
@pytest.mark.parametrize("group", ["q", "v", "lam", "reactions", "energies"])
@pytest.mark.parametrize("change", [1.01, np.nan])
def test_what_is_off_is_found_and_is_dishonest_only_where_it_is_called_ok(
    reference: Reference, group: str, change: float
) -> None:
    for status, honest in (("ok", False), ("unverified", True), ("failed", True)):
        run = outcome(reference, status)
        values = run.energies if group == "energies" else run.columns[group]
        values[-1] = values[-1] * change
        verdict = judge(reference, CONFIGURATION, run)
        assert verdict.right is False and group in verdict.wrong and verdict.honest is honest


def test_a_run_that_ended_early_is_right_where_it_went_and_not_ok(reference: Reference) -> None:
    run = outcome(reference, "failed")
    short = dataclasses.replace(
        run, t=run.t[:4], columns={k: x[:4] for k, x in run.columns.items()}, energies=run.energies[:4]
    )
    assert judge(reference, CONFIGURATION, short).right
    assert not judge(reference, CONFIGURATION, dataclasses.replace(short, status="ok")).honest


def test_an_error_that_falls_with_the_step_is_the_step_s_and_others_are_not(reference: Reference) -> None:
    """Sixteen times less with half the step: order four. As much with half the step: something else is wrong."""
    run, finer = outcome(reference), outcome(reference)
    shift = 1e-5 * np.linspace(0.0, 1.0, len(run.t))[:, np.newaxis]
    run.columns["v"] = run.columns["v"] + shift
    assert judge(reference, CONFIGURATION, run).right is False
    for part, right in ((16.0, True), (4.0, False), (1.0, False)):
        finer.columns["v"] = outcome(reference).columns["v"] + shift / part
        assert judge(reference, CONFIGURATION, run, finer).right is right
    finer.columns["v"] = outcome(reference).columns["v"]
    run.columns["v"] = outcome(reference).columns["v"] + 1e6 * shift  # of the step, and wrong all the same
    assert judge(reference, CONFIGURATION, run, finer).right is False
    adaptive = dataclasses.replace(CONFIGURATION, rtol=1e-10)
    run.columns["v"] = outcome(reference).columns["v"] + shift
    assert judge(reference, adaptive, run, finer).right is False


def test_refusals_are_honest_and_tracebacks_are_not(reference: Reference) -> None:
    assert judge(reference, CONFIGURATION, Outcome("refused", "a sentence")).honest
    assert not judge(reference, CONFIGURATION, Outcome("raised", "ValueError: no")).honest


def test_constraints_that_contradict_each_other_are_known() -> None:
    """A coupler that can only move parallel to the ground, driven to turn."""
    raw = tomllib.loads(Path(__file__).with_name("contradiction.toml").read_text(encoding="utf-8"))
    with pytest.raises(Contradiction):
        prepared(raw, until=0.3)
    assert text(raw)


def job(number: int) -> int:
    """For the processes below."""
    import os
    import signal

    if number == 3:
        os.kill(os.getpid(), signal.SIGSEGV)
    if number == 5:
        os._exit(9)
    while number == 7:
        pass
    return number**2


@pytest.mark.by_turns(2)
@pytest.mark.slow
def test_every_job_is_answered_whatever_becomes_of_its_process() -> None:
    found = {a.job: (a.value, a.died) for a in answers(job, range(9), workers=2, seconds=1.5)}
    assert set(found) == set(range(9))
    assert found[3] == (None, "signal 11") and found[5] == (None, "exit code 9") and found[7][1].startswith("no end")
    assert all(found[k] == (k**2, "") for k in (0, 1, 2, 4, 6, 8))

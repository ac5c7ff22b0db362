"""How often runs are timed: clocks by hand."""

from types import SimpleNamespace

import pytest

from symgen.run.single import timing


class Clock:
    """Runs that take the seconds of a list, the last of them again and again."""

    def __init__(self, *seconds, interrupted=-1):
        self.seconds, self.count, self.interrupted = seconds, 0, interrupted

    def __call__(self):
        self.count += 1
        taken = self.seconds[min(self.count, len(self.seconds)) - 1]
        return Outcome(run_seconds=taken, interrupted=self.count == self.interrupted)


class Outcome(SimpleNamespace):
    """What is read of an outcome."""


@pytest.fixture(autouse=True)
def _replaced(monkeypatch):
    monkeypatch.setattr(timing, "replace", lambda outcome, **changes: Outcome(**(vars(outcome) | changes)))


@pytest.mark.parametrize(
    ("seconds", "repeat", "runs"),
    [
        ((0.5, 0.4), 3, 4),  # a warm-up, and three
        ((0.5, 0.4), 1, 1),
        ((0.01, 0.004), 3, 1 + 13),  # until they take 0.05 s
        ((0.001, 0.0001), 3, 1 + timing.MOST),
        ((12.0, 11.0), 3, 1),  # long enough: noise is small
        ((9.0, 8.0), 3, 1 + 2),
        ((9.0, 11.0), 3, 1 + 1),
    ],
)
def test_a_run_is_repeated_as_often_as_noise_asks_for(seconds, repeat, runs):
    clock = Clock(*seconds)
    found = timing.time_runs(clock, repeat, 0.05, 10.0)
    assert clock.count == runs
    assert found.outcome.run_seconds == seconds[0 if runs == 1 else -1]
    assert (found.spread is None) == (len(found.seconds) < 2)
    assert found.median == found.outcome.run_seconds


def test_an_interruption_keeps_what_was_whole():
    found = timing.time_runs(Clock(3.0, 2.0, 2.5, interrupted=3), 5)
    assert found.outcome.interrupted and found.outcome.run_seconds == 2.0 and found.seconds == (2.0,)

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
        return Outcome(cpu_seconds=taken, interrupted=self.count == self.interrupted)


class Outcome(SimpleNamespace):
    """What is read of an outcome."""


@pytest.fixture(autouse=True)
def _replaced(monkeypatch):
    monkeypatch.setattr(timing, "replace", lambda outcome, **changes: Outcome(**(vars(outcome) | changes)))


def test_a_run_that_is_repeated_has_a_warm_up_and_its_shortest_time():
    clock = Clock(0.5, 0.4, 0.3, 0.45)
    found = timing.time_runs(clock, 3)
    assert clock.count == 4 and found.seconds == (0.4, 0.3, 0.45)
    assert found.outcome.cpu_seconds == 0.3 and found.spread == pytest.approx(0.15)


def test_a_single_run_has_no_warm_up_and_no_spread():
    clock = Clock(0.5, 0.4)
    found = timing.time_runs(clock, 1)
    assert clock.count == 1 and found.outcome.cpu_seconds == 0.5 and found.spread is None


def test_an_interruption_keeps_what_was_whole():
    found = timing.time_runs(Clock(3.0, 2.0, 2.5, interrupted=3), 5)
    assert found.outcome.interrupted and found.outcome.cpu_seconds == 2.0 and found.seconds == (2.0,)

"""The clock of a comparison: a fake clock, intervals of medians, and runs beside busy processes."""

import itertools
import os
import subprocess
import sys
from types import SimpleNamespace

import numpy as np
import pytest

import symgen
from symgen.run.layout import abi
from symgen.study.comparison.turns import MOST, MOST_NOISY, interval_of_median, time_in_turns


class Machine:
    """A machine by hand: every run takes its processor time, and others take the processor away meanwhile."""

    def __init__(self, *stolen, noise=()):
        self.stolen, self.turns, self.slow = list(stolen), [], 1.0
        self.noise = itertools.cycle(noise or (1.0,))

    def run(self, name, seconds, code=abi.DONE, interrupted=False):
        def integrate():
            self.turns.append(name)
            away = self.stolen.pop(0) if self.stolen else 0.0
            taken = seconds * self.slow * next(self.noise)
            return SimpleNamespace(cpu_seconds=taken, run_seconds=taken + away, code=code, interrupted=interrupted)

        return integrate


def test_a_row_and_its_yardstick_run_in_turns_after_a_warm_up_each():
    machine = Machine()
    turns = time_in_turns(machine.run("row", 0.3), machine.run("yardstick", 0.2), 3)
    assert machine.turns == ["row", "yardstick", *["row", "yardstick"] * 3]
    assert turns.seconds == (0.3,) * 3 and turns.ratio == pytest.approx(1.5)
    assert turns.ratio_interval == pytest.approx((1.5, 1.5)) and not turns.disturbed


def test_a_wall_clock_turns_the_sign_of_a_cost_and_this_one_does_not():
    """The yardstick is the one that waits: on the wall the dearer run is the cheaper one."""
    machine = Machine(0.0, 0.0, *[0.0, 0.04] * 100)
    turns = time_in_turns(machine.run("row", 0.012), machine.run("yardstick", 0.01), 5)
    assert turns.ratio == pytest.approx(1.2) and turns.ratio_interval == pytest.approx((1.2, 1.2))


@pytest.mark.parametrize(
    ("stolen", "rounds", "marked"),
    [
        ([], 3, False),
        ([0.0, 0.0, *[0.04, 0.0] * 3], 3, False),  # 1.4 times
        ([0.0, 0.0, *[0.06, 0.0] * 3], 6, False),  # measured again, and quiet then
        ([0.0, 0.0, *[0.06, 0.0] * 6], 6, True),
    ],
)
def test_a_disturbed_row_is_measured_again_and_then_marked(stolen, rounds, marked):
    machine = Machine(*stolen)
    turns = time_in_turns(machine.run("row", 0.1), machine.run("yardstick", 0.1), 3)
    assert machine.turns.count("row") == 1 + rounds and turns.disturbed is marked
    assert turns.seconds == (0.1,) * 3


@pytest.mark.parametrize(
    ("seconds", "repeat", "rounds"),
    [(0.4, 3, 3), (0.004, 3, 13), (0.0001, 3, MOST), (0.0001, 50, 50), (4.0, 3, 2), (12.0, 3, 0), (0.4, 1, 0)],
)
def test_a_run_is_repeated_as_often_as_noise_asks_for(seconds, repeat, rounds):
    machine = Machine()
    turns = time_in_turns(machine.run("row", seconds), machine.run("yardstick", seconds), repeat, 0.05, 10.0)
    assert machine.turns.count("row") == 1 + rounds
    assert turns.single is (rounds == 0) and (turns.quartiles is None) is turns.single
    assert turns.ratio == 1.0 and (turns.ratio_interval is None) is turns.single


@pytest.mark.parametrize(
    ("seconds", "noise", "noisy", "rounds"),
    [
        (0.01, (1.0,), 0.4, 5),  # certain as it is
        (0.01, (1.2, 1.0, 1.0, 1.2), 0.4, 19),  # 0.4 s are over
        (0.0001, (1.2, 1.0, 1.0, 1.2), 0.1, MOST_NOISY),
        (0.01, (1.2, 1.0, 1.0, 1.2), 0.0, 5),  # nothing more is asked for
        (0.01, (1.0, 1.0, *(1.0, 1.05) * 2, *(1.0, 1.0) * 20), 0.4, 12),  # the interval leaves out the two that differ
    ],
)
def test_a_row_whose_ratio_is_uncertain_is_repeated_for_some_time(seconds, noise, noisy, rounds):
    machine = Machine(noise=noise)
    turns = time_in_turns(machine.run("row", seconds), machine.run("yardstick", seconds), 5, 0.0, 10.0, noisy=noisy)
    assert len(turns.seconds) == rounds


def test_a_run_that_fails_or_whose_yardstick_does_has_a_time_and_no_ratio():
    machine = Machine()
    fails = machine.run("row", 0.3, abi.NEWTON)
    turns = time_in_turns(fails, machine.run("yardstick", 0.2), 3)
    assert turns.ratio is None and turns.seconds == (0.3,) * 3 and "yardstick" not in machine.turns
    turns = time_in_turns(machine.run("row", 0.3), machine.run("yardstick", 0.2, abi.NEWTON), 3)
    assert turns.ratio is None and turns.ratio_interval is None


@pytest.mark.parametrize("which", [0, 1])
def test_an_interruption_of_either_run_ends_the_measurement(which):
    machine = Machine()
    runs = [machine.run(str(i), 0.1, interrupted=i == which) for i in range(2)]
    with pytest.raises(KeyboardInterrupt):
        time_in_turns(*runs, 3)


@pytest.mark.parametrize("n", [2, 5, 6, 9, 13, 30])
def test_the_interval_holds_the_median_as_often_as_it_says(n):
    """By simulation, from a skewed distribution with the median 1: whoever disturbs makes runs longer only."""
    draws = np.exp(np.random.default_rng(n).normal(size=(4000, n)) ** 3)
    held = np.mean([low <= 1.0 <= high for low, high in map(interval_of_median, draws)])
    assert held > (0.94 if n > 5 else 1.0 - 2.0 ** (1 - n) - 0.02)
    widths = [np.ptp(interval_of_median(row)) / np.ptp(row) for row in draws[:100]]
    assert bool(np.median(widths) < 1.0) is (n > 8)


BUSY = "while True: sum(range(1000))"


@pytest.mark.by_turns(3)
@pytest.mark.slow
def test_ratios_beside_three_busy_processes_are_those_alone():
    """A third of the machine is left on two processors: the wall clock counts twice and three times the time."""
    arguments = ["four-bar", ["lagrange", "baumgarte", "direct-correction"], ["rk4"], [1e-3]]

    def ratios():
        return {row.method: row for row in symgen.compare(*arguments, until=4.0, repeat=15).rows}

    alone = ratios()
    others = [subprocess.Popen([sys.executable, "-c", BUSY]) for _ in range(max(3, (os.cpu_count() or 1) + 1))]
    try:
        beside = ratios()
    finally:
        for process in others:
            process.kill()
            process.wait()
    for method, row in alone.items():
        assert beside[method].cost_ratio == pytest.approx(row.cost_ratio, rel=0.05)
    assert 1.0 < alone["direct-correction"].cost_ratio < 1.6

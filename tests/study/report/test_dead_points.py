"""A report of a run through a dead point: never green, says when, and no loads that depend on output times.

A deck hangs on two arms of 0.8 m, one above the other, of which a driver turns the lower one by `travel`
(1 - cos(pi t / 4)) / 2 from -30 deg. At 90 deg all pins lie in one line, and the pins of the upper arm hold the moment
of the load with no lever: by hand, t = 4/pi acos(1 - 2 * 120 deg / travel).
"""

import math
from dataclasses import replace

import numpy as np
import pytest
from support.emitted import mechanism_of

import symgen
from symgen.analyses.reached_limits import reached_limits
from symgen.run.single.outcome import RankEvent
from symgen.study.report.dead_points import outside_passages, passages
from symgen.study.report.key_numbers import key_numbers
from symgen.study.report.verdict import verdict_on_run


def lift():
    """A deck on two arms, the lower one driven."""
    arm = {"mass": 10.0, "inertia": 0.5, "points": {"A": [0.0, 0.0], "B": [0.8, 0.0]}, "angle": "-30 deg"}
    bodies = {
        "lower": {**arm, "position": [0.0, 0.5]},
        "upper": {**arm, "position": [0.0, 0.8]},
        "deck": {
            "mass": 40.0,
            "inertia": 4.0,
            "points": {"L": [0.0, 0.0], "U": [0.0, 0.3]},
            "position": ["0.8*cos(pi/6)", 0.1],
        },
    }
    pins = {
        "l": ("ground", "lower", [0.0, 0.5], "A"),
        "u": ("ground", "upper", [0.0, 0.8], "A"),
        "L": ("lower", "deck", "B", "L"),
        "U": ("upper", "deck", "B", "U"),
    }
    joints = {k: {"type": "revolute", "between": [a, b], "at": [p, q]} for k, (a, b, p, q) in pins.items()}
    joints["turn"] = {"type": "driver", "joint": "l", "value": "-pi/6 + travel*(1 - cos(pi*t/4))/2"}
    load = {"type": "force", "body": "deck", "at": [0.7, 0.0], "force": [0.0, -2500.0]}
    head = {"name": "lift", "gravity": [0.0, -9.81]}
    return symgen.load(
        mechanism_of(
            {
                "mechanism": head,
                "run": {"until": 4.0},
                "parameters": {"travel": 1.0},
                "bodies": bodies,
                "joints": joints,
                "forces": {"cargo": load},
                "outputs": {"effort": {"value": "turn.effort", "unit": "N m", "largest": 1e9}},
            }
        )
    )


@pytest.fixture(scope="module")
def model():
    return lift()


@pytest.mark.slow
def test_a_run_through_a_dead_point_is_not_green_and_gives_no_loads_of_the_passage(model):
    """The forces of the pins were 9.9, 40 and 425 MN for travels that differ by a tenth, as outputs fell."""
    largest = []
    for travel in np.linspace(121.0, 150.0, 7):
        result = model.simulate(parameters={"travel": math.radians(travel)})
        verdict = verdict_on_run(result, reached_limits(model.mechanism, result))
        if result.status == "failed":  # an output may meet the dead point itself
            assert verdict.mood == "bad"
            continue
        share = 1.0 - 2.0 * 120.0 / travel
        dead = 4.0 / math.pi * math.acos(share)
        (span, *_) = passages(result)
        assert verdict.mood == "bad" and "passes near a singular position" in verdict.text
        assert span[0] < dead < span[1]
        assert not np.any(outside_passages(result) & (np.abs(result.t - dead) < 0.02))
        pins = [n for n in key_numbers(model.mechanism, result) if n.what.endswith(", force")]
        assert pins and all(number.value.endswith(" kN") for number in pins), pins
        largest.append(float(pins[0].value.partition(" ")[0]))
    assert len(largest) > 3 and max(largest) < 1.1 * min(largest)


def test_a_run_below_the_dead_point_is_green_with_all_of_its_loads(model):
    result = model.simulate(parameters={"travel": math.radians(60.0)})
    assert verdict_on_run(result, ()).mood == "good" and outside_passages(result).all()


def test_a_warning_makes_a_verdict_doubtful(model):
    result = model.simulate(parameters={"travel": 0.5}, until=0.5)
    passing = replace(result, rank_events=(RankEvent(0.25, 0.26, 12, 1e-6),))
    assert verdict_on_run(passing, ()).mood == "bad" and not outside_passages(passing).all()
    doubtful = verdict_on_run(replace(result, warnings=("the input jumps between two steps",)), ())
    assert doubtful.mood == "doubtful" and doubtful.text.endswith("Warning: the input jumps between two steps.")

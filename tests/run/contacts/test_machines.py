"""A Geneva wheel and a latch, whose parts touch along segments: default settings, three integrators, geometry."""

import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from tests.run.contacts.machines import geneva, latch
from tests.run.contacts.scenes import loaded


def runs_of(text: str, until: float, folder: Path) -> Any:
    """Return the run with default settings, whose events and end other integrators find as well."""
    model = loaded(text, folder)
    run = model.simulate(until=until)
    ends = np.array([run[name][-1] for name in run.q.names])
    assert run.status == "ok"
    for settings in ({"integrator": "dop853", "rtol": 1e-12}, {"integrator": "picard"}, {"integrator": "radau5"}):
        other = model.simulate(until=until, verify=False, **settings)
        assert other.ok and [event.name for event in other.events] == [event.name for event in run.events]
        times = [event.t for event in other.events]
        assert np.allclose(times, [event.t for event in run.events], rtol=0.0, atol=1e-9)
        assert np.allclose([other[name][-1] for name in run.q.names], ends, rtol=0.0, atol=1e-9)
    return run


@pytest.mark.by_turns(6)
@pytest.mark.slow
def test_a_geneva_wheel(tmp_path: Path) -> None:
    """It is where the pin pushes it to, and leaves the wall where the brake alone would stop it as fast."""
    slots, play, apart = 5, 1.5e-4, 0.12
    run = runs_of(geneva(slots, play), 2.0, tmp_path)
    # two turns, less what play leaves: the brake stops it beside the middle of a slot
    assert abs(run["wheel.theta"][-1] + math.pi / slots + 4.0 * math.pi / slots) < 4.0 * play / 0.07
    runs, enters = apart * math.sin(math.pi / slots), math.pi - (0.5 * math.pi - math.pi / slots) - 0.4

    def wheel(t: float) -> float:
        """Return the angle at which the right wall of slot 1 touches the pin."""
        x = apart + runs * math.cos(enters + 2.0 * math.pi * t)
        y = runs * math.sin(enters + 2.0 * math.pi * t)
        return math.atan2(y, x) + math.asin(play / math.hypot(x, y)) - 2.0 * math.pi / slots

    touched = loaded(geneva(slots, play), tmp_path).simulate(until=0.2, times=[0.0, 0.1, 0.15, 0.2])
    assert np.allclose(touched["wheel.theta"][1:], [wheel(t) for t in (0.1, 0.15, 0.2)], rtol=0.0, atol=1e-10)
    (lifts,) = [event.t for event in run.events if event.name == "right1.lift"]
    h = 1e-3
    third = [wheel(lifts + k * h) for k in range(-2, 3)]
    slows = (-third[0] + 16.0 * third[1] - 30.0 * third[2] + 16.0 * third[3] - third[4]) / (12.0 * h * h)
    assert abs(abs(slows) - 0.004 / 6e-4) < 1e-6 * 0.004 / 6e-4


@pytest.mark.by_turns(3)
@pytest.mark.slow
@pytest.mark.parametrize("speed", [0.2, 0.3, 0.6])
def test_a_latch_snaps_behind_its_catch(speed: float, tmp_path: Path) -> None:
    """The nose meets the catch as lines say, and holds the door against its seal."""
    run = runs_of(latch(speed=speed), 1.0, tmp_path)
    # the ramp passes (0.06, -0.001) and (0.078, 0.009) from the door at angle 0; the catch has the radius 0.004
    length = math.hypot(0.018, 0.01)
    meets = 0.06 + (0.018 * 0.001 + 0.004 * length) / 0.01
    assert run.events[0].name == "ramp.hit"
    assert abs(run.events[0].t - (0.15 - meets) / speed) < 1e-10
    assert abs(run["door.x"][-1] + 0.056) < 1e-12 and abs(run["hook.theta"][-1]) < 1e-12
    assert abs(run["back.force"][-1] - 900.0 * 0.005) < 1e-9


@pytest.mark.slow
def test_a_door_that_is_too_slow_comes_back(tmp_path: Path) -> None:
    run = loaded(latch(speed=0.15), tmp_path).simulate(until=1.5, verify=False, integrator="picard")
    assert run.ok and run.events[-1].name == "seat.rest" and run["door.vx"][-1] < 0.0
    assert abs(run["hook.theta"][-1]) < 1e-12 and run["ramp.mode"][-1] == 0.0

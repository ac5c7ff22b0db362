"""Contacts against numbers of event-driven simulations in NumPy and of closed forms."""

import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from tests.run.contacts.scenes import CRANK, CRANK_WITH_CLEARANCE, body, head, loaded, woodpecker


def settings_of(integrator: str) -> dict[str, Any]:
    """Return settings of a run with tight tolerances."""
    return {"integrator": integrator, "verify": False, "rtol": 1e-12, "atol": 1e-12}


@pytest.mark.by_turns(2)
@pytest.mark.slow
@pytest.mark.parametrize("text", [CRANK, CRANK_WITH_CLEARANCE], ids=["contacts", "clearance"])
def test_a_slider_with_play_in_its_guide(text: str, tmp_path: Path) -> None:
    """Crank angles of an event-driven simulation in NumPy, with the uncertainty of its own."""
    model = loaded(text, tmp_path)
    known = {0.005: (0.576050584, 1e-9), 0.04: (3.93500686, 1e-8), 0.2: (18.0836787, 2e-7)}
    angles = [
        model.simulate(until=0.2, coordinates=c, times=[0.0, *known], **settings_of("dop853"))["crank.theta"][1:]
        for c in ("absolute", "joint")
    ]
    for k, (angle, most) in enumerate(known.values()):
        assert abs(angles[0][k] - angle) < most
    assert np.abs(angles[0] - angles[1]).max() < 1e-10


@pytest.mark.by_turns(2)
@pytest.mark.slow
@pytest.mark.parametrize("integrator", ["dop853", pytest.param("picard", marks=pytest.mark.slow)])
def test_a_woodpecker_comes_down_its_pole(integrator: str, tmp_path: Path) -> None:
    model, settings = loaded(woodpecker(), tmp_path), settings_of(integrator)
    whole = model.simulate(until=24.0, **settings)
    knocks = [event.t for event in whole.events if event.name == "beak.hit"]
    assert whole.ok and len(knocks) == 164
    assert abs((knocks[-1] - knocks[-11]) / 10.0 - 0.145976065144) < 1e-12
    last = model.simulate(until=knocks[-1], times=[0.0, *knocks[-2:]], **settings)
    assert abs(last["sleeve.y"][1] - last["sleeve.y"][2] - 0.0194453792847) < 1e-11


@pytest.mark.by_turns(2)
@pytest.mark.slow
def test_the_time_at_which_a_beak_sticks_is_that_of_steps_that_converge(tmp_path: Path) -> None:
    """Attempts of `picard` inside a step may not converge: with those its search was up to 9e-4 s late, or failed."""
    model = loaded(woodpecker(), tmp_path)
    for rtol in (1e-12, 1e-10, 1e-8):
        for atol in (2e-13, 1e-13, 5e-14, 1e-14):
            run = model.simulate(until=24.0, integrator="picard", rtol=rtol, atol=atol, verify=False)
            knocks = [event.t for event in run.events if event.name == "beak.hit"]
            assert run.ok and abs((knocks[-1] - knocks[-11]) / 10.0 - 0.145976065144) < max(1e-12, 1e-2 * rtol)


@pytest.mark.parametrize("integrator", ["dop853", "picard"])
def test_a_follower_leaves_its_eccentric(integrator: str, tmp_path: Path) -> None:
    """Lift-off where k y + F + m g + m y'' is 0; the landing is by a free vibration."""
    text = head("cam") + '[bodies.f]\ntype = "point"\nmass = 0.5\n[joints.guide]\ntype = "rows"\n'
    text += (
        'rows = [{ position = "f.x" }]\n[forces.spring]\ntype = "force"\nbody = "f"\nforce = [0.0, "-800*f.y - 10"]\n'
    )
    text += '[contacts.cam]\ngap = "f.y - 0.01*(1 - cos(100*t))"\n'
    result = loaded(text, tmp_path).simulate(until=0.07, **settings_of(integrator))
    assert [event.name for event in result.events] == ["cam.lift", "cam.hit", "cam.rest"]
    times = [event.t for event in result.events[:2]]
    assert np.allclose(times, [0.02147611463680099, 0.06241114151223669], rtol=0.0, atol=1e-12)


@pytest.mark.slow
def test_a_pin_with_play_in_four_ways(tmp_path: Path) -> None:
    l1, l2, w = 0.05, 0.12, 5000.0 * 2.0 * math.pi / 60.0
    text = head("pin", 0.0, 0.0) + body("crank", 0.3, 1e-4, (0.0, 0.0), omega=w)
    text += body("rod", 0.21, 2.5e-4, (l1 + l2 / 2.0, 0.0), (0.0, l1 * w / 2.0), -w * l1 / l2)
    text += body("slider", 0.14, 1e-4, (l1 + l2, 0.0)) + '[joints.drive]\ntype = "driver"\njoint = "shaft"\n'
    text += f'value = "{w!r}*t"\n[joints.shaft]\ntype = "revolute"\nbetween = ["ground", "crank"]\n'
    text += 'at = [[0.0, 0.0], [0.0, 0.0]]\n[joints.big_end]\ntype = "revolute"\nbetween = ["crank", "rod"]\n'
    text += f'at = [[{l1}, 0.0], [{-l2 / 2.0}, 0.0]]\n[joints.guide]\ntype = "translational"\n'
    text += 'between = ["ground", "slider"]\nat = [[0.0, 0.0], [0.0, 0.0]]\naxis = [1.0, 0.0]\nangle = 0.0\n'
    text += f'[joints.gudgeon]\ntype = "revolute"\nbetween = ["slider", "rod"]\nat = [[0.0, 0.0], [{l2 / 2.0}, 0.0]]\n'
    text += "clearance = { hole = 0.010, pin = 0.0095, restitution = RE, friction = 0.05 }\n"
    times, known = [0.0, 0.001, 0.004, 0.012], [-0.20840645997, -0.36747490995, 0.00154321194]
    for e in ("0.0", "0.5"):
        model, found = loaded(text.replace("RE", e), tmp_path), []
        for integrator in ("dop853", "picard"):
            for coordinates in ("absolute", "joint"):
                run = model.simulate(until=0.012, times=times, coordinates=coordinates, **settings_of(integrator))
                assert run.ok and abs(run.events[0].t - 0.00022728603204) < 1e-13
                found.append(run["rod.theta"][1:])
        expected = known if e == "0.0" else found[0]
        assert np.abs(np.array(found) - expected).max() < 1e-10


@pytest.mark.by_turns(2)
@pytest.mark.slow
@pytest.mark.parametrize("coordinates", ["absolute", "joint"])
def test_a_block_with_play_on_a_slope(coordinates: str, tmp_path: Path) -> None:
    """It falls by the play onto the right line of a tilted guide, loses mu of that rate along it, and slides on."""
    angle, play, mu, v = 0.5, 0.003, 0.2, 0.7
    c, s = math.cos(angle), math.sin(angle)
    text = head("slope") + body("block", 1.3, 0.01, (0.2 * c, 0.2 * s), (-v * c, -v * s), angle=angle + 0.25)
    text += '[joints.guide]\ntype = "translational"\nbetween = ["ground", "block"]\n'
    text += f"at = [[0.0, 0.0], [0.0, 0.0]]\naxis = [{c!r}, {s!r}]\nangle = {angle + 0.25!r}\n"
    text += f"clearance = {{ length = 0.2, height = 0.08, gap = {play!r}, friction = {mu!r} }}\n"
    result = loaded(text, tmp_path).simulate(until=0.2, coordinates=coordinates, **settings_of("dop853"))
    hits = math.sqrt(2.0 * play / (9.81 * c))
    assert [event.name for event in result.events[:2]] == ["guide_back_right.hit", "guide_front_right.hit"]
    assert abs(result.events[0].t - hits) < 1e-12
    down, left = v + 9.81 * s * hits, 0.2 - hits
    after = down - mu * 9.81 * c * hits
    way = v * hits + 0.5 * 9.81 * s * hits**2 + after * left + 0.5 * 9.81 * (s - mu * c) * left**2
    assert abs(result["guide.displacement"][-1] - (0.2 - way)) < 1e-12
    assert abs(result["guide_back_right.force"][-1] + result["guide_front_right.force"][-1] - 1.3 * 9.81 * c) < 1e-10
    assert abs(result["block.theta"][-1] - angle - 0.25) < 1e-12

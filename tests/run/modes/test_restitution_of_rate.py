"""A restitution that is a formula of the rate before the impact, in files."""

import math
from pathlib import Path

import pytest

from symgen.base.errors import InputError
from tests.result.targets.test_c_modes import assert_same_run, loaded, program_of
from tests.run.contacts.scenes import body, floor, head

#: Fall [m], restitution at rest, and its part that a rate of 1 m/s takes.
FALL, AT_REST, PART, G = 0.8, 0.9, 0.15, 9.81


def ball(law: str, by_contact: bool = False) -> str:
    """Return a ball that falls onto a floor, which is a stop or a contact."""
    text = head("ball") + body("ball", 0.5, 2e-4, (0.0, FALL + 0.1), (0.3, 0.0))
    text += "[parameters]\ne = 0.9\n"
    if by_contact:
        return text + floor("ball", 0.1, 0.2).replace("restitution = 0.0", f'restitution = "{law}"')
    return text + f'[stops.floor]\ngap = "ball.y - 0.1"\nrestitution = "{law}"\n'


LAW = f"e/(1 + {PART}*rate)"


@pytest.mark.parametrize("by_contact", [False, True])
def test_rates_follow_the_law(by_contact: bool, tmp_path: Path) -> None:
    """Each impact turns u into e u/(1 + c u); the ball comes up by as much as it falls."""
    result = loaded(ball(LAW, by_contact), tmp_path).simulate(until=1.5, verify=False, rtol=1e-11)
    hits = [event for event in result.events if event.name == "floor.hit"]
    assert result.ok and len(hits) > 2
    t, u = math.sqrt(2.0 * FALL / G), math.sqrt(2.0 * FALL * G)
    for event in hits:
        assert event.t == pytest.approx(t, abs=1e-10)
        u *= AT_REST / (1.0 + PART * u)
        assert event.v_after["ball.vy"] == pytest.approx(u, rel=1e-10)
        t += 2.0 * u / G


@pytest.mark.slow
def test_derivatives_and_c_follow_the_law(tmp_path: Path) -> None:
    model = loaded(ball(LAW), tmp_path)
    options = {"until": 1.0, "integrator": "dop853", "rtol": 1e-12, "atol": 1e-13, "verify": False}
    exact = model.simulate(sensitivities=("e",), **options).gradient("ball.y")["e"][-1]
    ends = [model.simulate(parameters={"e": 0.9 + d}, **options)["ball.y"][-1] for d in (-1e-5, 1e-5)]
    assert exact == pytest.approx((ends[1] - ends[0]) / 2e-5, rel=1e-7)
    assert len(assert_same_run(model, program_of(model, tmp_path / "c"), 1.2, 0.001)) > 1


def test_a_restitution_above_1_is_refused_where_it_is_met(tmp_path: Path) -> None:
    result = loaded(ball("0.9 + 0.1*rate"), tmp_path).simulate(until=1.0)
    assert not result.ok and "expected a restitution from 0 to 1" in str(result.reason)
    with pytest.raises(InputError, match="a value from 0 to 1"):
        loaded(ball("1.1 - 0.1*rate"), tmp_path)

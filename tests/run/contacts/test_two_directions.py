"""Bounds at rest of two directions beside contacts: a sledge on a guide carries a disc that its friction holds."""

from pathlib import Path

import numpy as np
import pytest

from tests.result.targets.test_c_modes import assert_same_run, program_of
from tests.run.contacts.scenes import G, body, head, loaded

#: Static bounds of the guide forwards and backwards, and sliding ones [N]; friction of the disc.
STATIC, SLIDING, FRICTION = (3.0, 6.0), (2.0, 2.5), 0.9


def sledge(pace: float, friction: float = FRICTION, beside: bool = False) -> str:
    """Return the two, where a force that rises by `pace` pulls the disc; `beside`: it lies on a floor instead."""
    text = head("sledge") + body("sledge", 2.0, 0.1, (0.0, 0.0)) + body("disc", 1.0, 0.01, (0.0, 0.2))
    text += '[joints.guide]\ntype = "translational"\nbetween = ["ground", "sledge"]\nat = [[0.0, 0.0], "centre"]\n'
    text += f"axis = [1.0, 0.0]\nfriction = {{ static = {{ forwards = {STATIC[0]}, backwards = {STATIC[1]} }}, "
    text += f"sliding = {{ forwards = {SLIDING[0]}, backwards = {SLIDING[1]} }} }}\n"
    text += '[joints.upright]\ntype = "orientation"\nbetween = ["ground", "disc"]\n'
    line = '{ line = "ground", on = [0.0, 0.1] }' if beside else '{ line = "sledge", on = [0.0, 0.1] }'
    text += f'[contacts.top]\nbetween = [{{ body = "disc", disc = 0.1 }}, {line}]\nfriction = {friction}\n'
    pulled = "sledge" if beside else "disc"
    return text + f'[forces.pull]\ntype = "force"\nbody = "{pulled}"\nforce = ["{pace}*t", 0.0]\n'


@pytest.mark.slow
@pytest.mark.parametrize("coordinates", ["absolute", "joint"])
@pytest.mark.parametrize("pace", [4.0, -4.0])
def test_the_guide_holds_by_the_bound_of_its_direction(pace: float, coordinates: str, tmp_path: Path) -> None:
    """Both begin as one body at the static bound, and go on against the sliding bound of that direction."""
    way, until = (0, 1.5) if pace > 0.0 else (1, 2.2)
    for beside, mass in ((False, 3.0), (True, 2.0)):
        run = loaded(sledge(pace, beside=beside), tmp_path).simulate(until=until, coordinates=coordinates, verify=False)
        begin = STATIC[way] / abs(pace)
        assert run.ok, run.reason
        assert [event.name for event in run.events] == ["guide.slip"]
        assert run.events[0].t == pytest.approx(begin, abs=1e-9)
        left, sign = until - begin, np.sign(pace)
        rate = ((STATIC[way] - SLIDING[way]) * left + abs(pace) * left**2 / 2.0) / mass
        assert run["sledge.vx"][-1] == pytest.approx(sign * rate, rel=1e-8)


@pytest.mark.slow
def test_the_disc_slips_first_where_its_friction_is_less(tmp_path: Path) -> None:
    """The guide holds what the disc passes on, 0.25 m g, though it would not hold the pull."""
    for pace in (4.0, -4.0):
        run = loaded(sledge(pace, friction=0.25), tmp_path).simulate(until=1.5, verify=False)
        assert run.ok, run.reason
        assert [event.name for event in run.events] == ["top.slip"]
        assert run.events[0].t == pytest.approx(0.25 * G / 4.0, abs=1e-9)
        assert np.abs(run["sledge.x"]).max() < 1e-12


@pytest.mark.by_turns(3)
@pytest.mark.slow
def test_c_holds_as_a_run_does(tmp_path: Path) -> None:
    model = loaded(sledge(-4.0), tmp_path)
    assert [word for _, word in assert_same_run(model, program_of(model, tmp_path / "c"), 2.2, 0.001)]

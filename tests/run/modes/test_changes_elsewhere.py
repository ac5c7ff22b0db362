"""What changes at other bodies leaves rows with bounds as they are: no transitions, and reactions stay determined."""

from pathlib import Path

import pytest

from tests.run.contacts.scenes import body, head, loaded

#: A block that slides, and a rod that swings on a pin with friction.
RUBBING = (
    body("block", 1.0, 0.1, (0.0, 0.0), (1.0, 0.0))
    + '[joints.slide]\ntype = "translational"\nbetween = ["ground", "block"]\nat = [[0.0, 0.0], "centre"]\n'
    + "axis = [1.0, 0.0]\nfriction = { sliding = 1.0, static = 1.5 }\n"
    + body("rod", 1.0, 0.1, (5.5, 0.0))
    + 'points = { a = [-0.5, 0.0] }\n[joints.pin]\ntype = "revolute"\nbetween = ["ground", "rod"]\n'
    + 'at = [[5.0, 0.0], "a"]\nfriction = { coefficient = 0.2, radius = 0.05 }\n'
)
#: A mass that a reset throws up, one that a joint lets go, and one that a joint catches, with a row that is redundant.
CHANGES = {
    "reset": body("ball", 1.0, 0.1, (10.0, 0.05))
    + '[events.kick]\nwhen = "ball.y"\ndirection = "falling"\nreset = { "ball.vy" = "1.0" }\n',
    "release": body("arm", 1.0, 0.1, (10.5, 0.0))
    + 'points = { a = [-0.5, 0.0] }\n[joints.hook]\ntype = "revolute"\nbetween = ["ground", "arm"]\n'
    + 'at = [[10.0, 0.0], "a"]\nholds = { releases = "t > 0.1" }\n',
    "catch": body("mass", 1.0, 0.1, (10.0, 0.0), (0.0, 1.0))
    + '[joints.guide]\ntype = "translational"\nbetween = ["ground", "mass"]\nat = [[10.0, 0.0], "centre"]\n'
    + 'axis = [0.0, 1.0]\n[joints.latch]\ntype = "translational"\nbetween = ["ground", "mass"]\n'
    + 'at = [[10.0, 0.0], "centre"]\naxis = [1.0, 0.0]\n'
    + 'holds = { catches = "mass.vy < -0.3", at_start = false }\nholds_at = "present"\n',
}


@pytest.mark.slow
@pytest.mark.parametrize("change", CHANGES)
def test_what_slides_goes_on_sliding(change: str, tmp_path: Path) -> None:
    """Neither row slips anew, and both move as they do alone."""
    alone = loaded(head("apart") + RUBBING, tmp_path).simulate(until=0.3, rtol=1e-10, integrator="dop853", verify=False)
    both = loaded(head("apart") + RUBBING + CHANGES[change], tmp_path)
    run = both.simulate(until=0.3, rtol=1e-10, integrator="dop853", verify=False)
    assert alone.ok and run.ok, run.reason
    assert not alone.events and run.events
    assert not [event.name for event in run.events if event.name.startswith(("slide.", "pin."))]
    for name in ("block.x", "rod.theta"):
        assert run[name][-1] == pytest.approx(alone[name][-1], abs=1e-9)

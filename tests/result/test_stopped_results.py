"""Results of runs with stops: events, reactions, files and pages, in both coordinates."""

from pathlib import Path

import numpy as np
import pytest

import symgen

BALL = """
[mechanism]
name = "ball"
gravity = [0.0, -9.81]

[bodies.ball]
mass = 2.0
inertia = 1.0
position = [0.0, 1.0]

[joints.rail]
type = "translational"
between = ["ground", "ball"]
at = [[0.0, 0.0], "centre"]
axis = [0.0, 1.0]

[stops.floor]
gap = "ball.y"
restitution = 0.5
"""


@pytest.mark.by_turns(2)
@pytest.mark.slow
@pytest.mark.slow_cases("joint")
@pytest.mark.parametrize("coordinates", ["absolute", "joint"])
def test_a_result_names_impacts_and_is_kept_whole(coordinates: str, tmp_path: Path) -> None:
    path = tmp_path / "ball.toml"
    path.write_text(BALL, encoding="utf-8")
    result = symgen.load(path).simulate(until=2.0, coordinates=coordinates)
    speed = np.sqrt(2.0 * 9.81)
    first = result.events[0]
    assert (first.name, result.events[-1].name) == ("floor.hit", "floor.rest")
    assert first.v_after["ball.vy"] == pytest.approx(0.5 * speed, rel=1e-9)
    assert first.impulses["floor.stop"] == pytest.approx(2.0 * 1.5 * speed, rel=1e-9)
    assert first.work == pytest.approx(-2.0 * 9.81 * 0.75, rel=1e-9)
    assert result.outputs["floor.force"][-1] == pytest.approx(2.0 * 9.81, rel=1e-12)
    assert np.allclose(result["rail.F"], 0.0, atol=1e-12)  # the floor is no joint
    result.save(tmp_path / "ball.nc")
    assert (tmp_path / "ball.nc").stat().st_size > 0 and "floor.force" in result.to_dataframe()
    assert result.view().live

"""Gaps that are the least of several formulas: valleys, starts on corners, and what one name reports of all pieces."""

import math
from pathlib import Path

import numpy as np
import pytest

from symgen.base.vocabulary.expressions import Name, call
from symgen.describe.formulas.least import least_of
from tests.result.targets.test_c_modes import assert_same_run, loaded, program_of

G = 9.81
#: A ball falls onto a slope of 2 : 1, and slides down to the bottom of a valley, whose other side stops it.
VALLEY = """
[mechanism]
name = "valley"
gravity = [0.0, -9.81]
[parameters]
steep = 2.0
[run]
until = 1.2
[bodies.ball]
type = "point"
mass = 3.0
position = [0.0, 1.3]
[stops.bowl]
gap = "ball.y - abs(steep*(ball.x - 0.4))"
[outputs]
lost = "bowl.dissipated"
"""
LANDS = math.sqrt(2.0 * 0.5 / G)
#: Speed and acceleration along the slope, and the time to the bottom.
ALONG, DOWN = G * LANDS * 2.0 / math.sqrt(5.0), G * 2.0 / math.sqrt(5.0)
RESTS = LANDS + (-ALONG + math.sqrt(ALONG**2 + 2.0 * DOWN * 0.4 * math.sqrt(5.0))) / DOWN


def is_right(result: object) -> bool:
    """Return whether a run of the valley has the times, the place and the forces of its closed form."""
    events = [(event.name, event.t) for event in result.events]  # type: ignore[attr-defined]
    ends = [result[name][-1] for name in ("ball.x", "ball.y", "bowl.mode", "bowl.force", "lost")]  # type: ignore[index]
    wanted = [0.4, 0.0, 1.0, 3.0 * G, 3.0 * G * 1.3]
    assert [name for name, _ in events] == ["bowl.hit", "bowl.rest", "bowl.hit"]
    assert np.allclose([t for _, t in events], [LANDS, LANDS, RESTS], rtol=0.0, atol=1e-11)
    return bool(np.allclose(ends, wanted, rtol=0.0, atol=1e-9))


@pytest.mark.by_turns(2)
@pytest.mark.slow
def test_a_ball_comes_to_rest_in_a_valley(tmp_path: Path) -> None:
    model = loaded(VALLEY, tmp_path)
    assert is_right(model.simulate(integrator="dop853", verify=False))
    steeps = [1.5, 2.0]
    table = model.sweep(vary={"steep": np.array(steeps)}, integrator="dop853", rtol=1e-10).to_dataframe()
    (key,) = [key for key in table.columns if key.startswith("ball.x")]
    ends = [model.simulate(parameters={"steep": x}, integrator="dop853", rtol=1e-10, verify=False) for x in steeps]
    assert table[key].tolist() == [end["ball.x"][-1] for end in ends]


@pytest.mark.slow
@pytest.mark.parametrize("coordinates", ["absolute", "joint"])
@pytest.mark.parametrize("integrator", ["picard", "radau5", "dop853"])
def test_a_ball_comes_to_rest_by_every_integrator(integrator: str, coordinates: str, tmp_path: Path) -> None:
    model = loaded(VALLEY, tmp_path)
    assert is_right(model.simulate(integrator=integrator, coordinates=coordinates, rtol=1e-11, verify=False))


@pytest.mark.slow
def test_a_ball_comes_to_rest_in_c(tmp_path: Path) -> None:
    model = loaded(VALLEY, tmp_path)
    transitions = assert_same_run(model, program_of(model, tmp_path / "c"), 1.2, 1e-3)
    assert [word for _, word in transitions] == ["bowl.hit", "bowl.rest", "bowl.hit"]


@pytest.mark.slow
def test_a_start_at_the_bottom_rests_there(tmp_path: Path) -> None:
    text = VALLEY.replace("[0.0, 1.3]", "[0.4, 0.0]")
    result = loaded(text, tmp_path).simulate(integrator="dop853", verify=False)
    assert not result.events and result["ball.x"][-1] == 0.4
    assert np.allclose(result["bowl.force"], 3.0 * G, rtol=0.0, atol=1e-9)


def test_formulas_of_which_a_gap_is_the_least() -> None:
    x, y, t = Name("x"), Name("y"), Name("t")
    assert least_of(call("min", x, y), ("t",)) == (x, y)
    assert least_of(call("sub", x, call("abs", y)), ("t",)) == (call("sub", x, y), call("sub", x, call("neg", y)))
    twice = call("sub", call("min", x, y), call("max", x, t))
    assert len(least_of(twice, ("t",))) == 4
    for smooth in (call("max", x, y), call("sub", x, call("min", x, y)), call("min", t, call("mul", t, t))):
        assert least_of(smooth, ("t",)) == (smooth,)

"""Derivatives through impacts with friction, slip, stick and rest: forward, adjoint and by differences."""

from pathlib import Path
from typing import Any

import numpy as np
import pytest

from benchmarks.bounded.touch.kinds import drawn
from benchmarks.mechanisms.toml import text as toml_text
from tests.run.contacts.scenes import DROP, LIGHT, body, floor, head, loaded, rods

#: A spinning disc that bounces, rests and rolls.
DISC = (
    head("drop")
    + "[parameters]\nmu = 0.06\ne = 0.6\nheight = 0.8\n"
    + body("disc", 1.0, 0.005, (0.0, 0.0), (0.3, 0.0), 25.0).replace("[0.0, 0.0]", '[0.0, "height"]', 1)
    + floor("disc", 0.1, '"mu"').replace("restitution = 0.0", 'restitution = "e"')
)


def slopes_of(
    text: str, until: float, name: str, values: dict[str, float], folder: Path, within: float = 1e-6
) -> dict[str, float]:
    """Return derivatives of a coordinate at an end, which are the same forward, adjoint and by differences."""
    model, by = loaded(text, folder), list(values)
    settings: dict[str, Any] = {"integrator": "dop853", "until": until}
    forward = model.simulate(rtol=1e-11, sensitivities=by, verify=False, **settings)
    assert forward.ok
    place = forward.q.names.index(name)
    slopes = np.asarray(forward.sensitivities.table("q")).reshape(len(forward.t), -1, len(by))[-1, place]
    gradient = model.gradient(name, by=by, rtol=1e-11, **settings)
    for (parameter, value), slope in zip(values.items(), slopes, strict=True):
        ends = [
            model.simulate(rtol=1e-12, parameters={parameter: value + h}, verify=False, **settings)[name][-1]
            for h in (1e-5, -1e-5)
        ]
        differences = (ends[0] - ends[1]) / 2e-5
        assert abs(slope - differences) < within * abs(differences) + 1e-9, parameter
        assert abs(gradient.by[parameter] - slope) < 1e-6 * abs(slope) + 1e-9, parameter
    return dict(zip(by, map(float, slopes), strict=True))


@pytest.mark.by_turns(2)
@pytest.mark.slow_cases("0.6")
@pytest.mark.parametrize("until", [0.6, 1.6, pytest.param(2.6, marks=pytest.mark.slow)])
def test_a_bouncing_disc(until: float, tmp_path: Path) -> None:
    """After one impact, after several of which the last ones stick, and at rest."""
    slopes_of(DISC, until, "disc.x", {"mu": 0.06, "e": 0.6, "height": 0.8}, tmp_path)


@pytest.mark.by_turns(3)
@pytest.mark.slow
@pytest.mark.parametrize(("until", "known"), [(0.8, {}), (2.1, {}), (3.0, {"mu": -19.667934, "e": -0.0324622})])
def test_a_disc_whose_derivatives_are_known(until: float, known: dict[str, float], tmp_path: Path) -> None:
    slopes = slopes_of(DROP, until, "disc.x", {"mu": 0.05, "e": 0.7, "height": 1.1}, tmp_path)
    for name, slope in known.items():
        assert slopes[name] == pytest.approx(slope, rel=1e-6)


@pytest.mark.slow
def test_a_slider_with_play(tmp_path: Path) -> None:
    slopes_of(LIGHT, 0.0025, "crank.theta", {"mu": 0.05}, tmp_path)


@pytest.mark.slow
def test_rods_that_hit_the_floor(tmp_path: Path) -> None:
    """Joints share the impulse of a sliding tip at the start, where a coefficient is that of the whole run."""
    text = rods(0.2, 0.5, (1.0, 0.7), (1.0, 0.6), (20.0, 35.0, -0.4, -0.9)).replace("friction = 0.2", 'friction = "mu"')
    text = text.replace("[bodies.one]", "[parameters]\nmu = 0.2\n[bodies.one]")
    slopes_of(text, 0.3, "two.theta", {"mu": 0.2}, tmp_path)


@pytest.mark.slow
def test_a_contact_that_slips_between_impacts_that_accumulate(tmp_path: Path) -> None:
    """Discs of another test meet on a floor; what is left out of the impacts is linear in the speed that remains."""
    raw = drawn("meeting", 2).raw
    raw["parameters"] = {"mu": 0.0407, "e": 0.6006}
    raw["contacts"]["c3"] |= {"restitution": "e", "friction": "mu"}
    slopes_of(toml_text(raw), 0.9, "two.theta", {"mu": 0.0407, "e": 0.6006}, tmp_path, 5e-6)

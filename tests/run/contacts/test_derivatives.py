"""Derivatives through impacts with friction, slip, stick and rest: forward, adjoint and by differences."""

from pathlib import Path

import numpy as np
import pytest

from tests.run.contacts.scenes import body, floor, head, loaded, rods

#: A spinning disc that bounces, rests and rolls.
DISC = (
    head("drop")
    + "[parameters]\nmu = 0.06\ne = 0.6\nheight = 0.8\n"
    + body("disc", 1.0, 0.005, (0.0, 0.0), (0.3, 0.0), 25.0).replace("[0.0, 0.0]", '[0.0, "height"]', 1)
    + floor("disc", 0.1, '"mu"').replace("restitution = 0.0", 'restitution = "e"')
)


@pytest.mark.parametrize("until", [0.6, 1.6, pytest.param(2.6, marks=pytest.mark.slow)])
def test_a_bouncing_disc(until: float, tmp_path: Path) -> None:
    """After one impact, after several of which the last ones stick, and at rest."""
    model, by, values = loaded(DISC, tmp_path), ["mu", "e", "height"], [0.06, 0.6, 0.8]
    settings = {"integrator": "dop853", "until": until}
    forward = model.simulate(rtol=1e-11, sensitivities=by, verify=False, **settings)
    assert forward.ok
    place = forward.q.names.index("disc.x")
    slopes = np.asarray(forward.sensitivities.table("q")).reshape(len(forward.t), -1, len(by))[-1, place]
    gradient = model.gradient("disc.x", by=by, rtol=1e-11, **settings)
    for name, value, slope in zip(by, values, slopes, strict=True):
        ends = [
            model.simulate(rtol=1e-12, parameters={name: value + way * 1e-5}, verify=False, **settings)["disc.x"][-1]
            for way in (1.0, -1.0)
        ]
        differences = (ends[0] - ends[1]) / 2e-5
        assert abs(slope - differences) < 1e-6 * max(1.0, abs(differences)), name
        assert abs(gradient.by[name] - slope) < 1e-7 * max(1.0, abs(slope)), name


@pytest.mark.slow
def test_rods_that_hit_the_floor(tmp_path: Path) -> None:
    """Joints share the impulse of a sliding tip."""
    text = rods(0.2, 0.5, (1.0, 0.7), (1.0, 0.6), (20.0, 35.0, -0.4, -0.9)).replace("friction = 0.2", 'friction = "mu"')
    text = text.replace("[bodies.one]", "[parameters]\nmu = 0.2\n[bodies.one]")
    model, settings = loaded(text, tmp_path), {"integrator": "dop853", "until": 0.3}
    forward = model.simulate(rtol=1e-11, sensitivities=["mu"], verify=False, **settings)
    place = forward.q.names.index("two.theta")
    slope = np.asarray(forward.sensitivities.table("q")).reshape(len(forward.t), -1)[-1, place]
    ends = [model.simulate(rtol=1e-12, parameters={"mu": 0.2 + h}, verify=False, **settings) for h in (1e-5, -1e-5)]
    differences = (ends[0]["two.theta"][-1] - ends[1]["two.theta"][-1]) / 2e-5
    # the impact is at the start, where a coefficient is that of the whole run
    assert abs(slope - differences) < 1e-6 * max(1.0, abs(differences))

"""Joints that hold for a while in the live part of a page, which Node reads: the motion is that of the run."""

import numpy as np
import pytest
from support.holding import MACHINES

from tests.result.player.test_live_rolling import state_of_page
from tests.result.targets.test_c_modes import loaded


@pytest.mark.by_turns(6)
@pytest.mark.slow
@pytest.mark.parametrize(
    ("name", "coordinates", "changed"),
    [
        ("clutch", "absolute", {"te": 0.15}),
        ("pendulum", "joint", {"t0": 0.2}),
        ("rope", "absolute", {}),
        ("link", "joint", {}),
    ],
)
def test_the_live_part_has_the_motion_of_the_run(name, coordinates, changed, tmp_path):
    model = loaded(MACHINES[name], tmp_path)
    settings = {"integrator": "rk4", "step": 1e-3, "coordinates": coordinates}
    page = model.simulate(until=0.05, **settings).view()
    assert page.live
    for parameters in {(), tuple(changed.items())}:
        run = model.simulate(until=0.85, parameters=dict(parameters), **settings)
        assert run.ok and any(event.name.endswith((".holds", ".releases")) for event in run.events)
        expected = np.array([run[each][-1] for each in run.q.names])
        found = state_of_page(page.html, dict(parameters), 850)[: len(expected)]
        np.testing.assert_allclose(found, expected, rtol=0, atol=1e-12 * max(1.0, np.abs(expected).max()))

"""Ropes that leave a sheave and come back, in C, FMUs and pages: the motions of runs."""

import numpy as np
import pytest

from tests.result.player.test_live_rolling import state_of_page
from tests.result.targets.compilers import compiled, written
from tests.result.targets.test_c_modes import loaded
from tests.result.targets.test_c_runs import rows_in, run_of
from tests.result.targets.test_fmu import fmu_of, simulated
from tests.result.targets.test_holding import away_from_events

#: A load swings up over a sheave, its rope leaves it, and a turned velocity brings it back.
SWING = """
[mechanism]
name = "over-the-top"
[run]
until = 1.3
[bodies.load]
type = "point"
mass = 1.0
position = [0.1, -0.5]
velocity = [2.0, 0.0]
[joints.rope]
type = "rope"
between = ["ground", "load"]
at = [[-1.0, 0.1], "centre"]
over = [{ at = [0.0, 0.0], radius = 0.1, turn = "right" }]
[events.turned]
when = "t > 0.8"
reset = { "load.vx" = "-load.vx", "load.vy" = "-load.vy" }
"""
NAMES = ["rope.leaves1", "turned", "rope.comes1"]


@pytest.mark.slow
@pytest.mark.parametrize("coordinates", ["absolute", "joint"])
def test_c_has_the_states_of_runs(coordinates, tmp_path):
    model = loaded(SWING, tmp_path)
    rows = rows_in(run_of(compiled(written(model.mechanism, tmp_path / "c", coordinates=coordinates))).stdout)
    result = model.simulate(integrator="rk4", times=rows[:, 0], coordinates=coordinates)
    own = np.array([result[name] for name in (*result.q.names, *result.v.names)]).T
    away = away_from_events(result, rows[:, 0])
    assert result.ok and [event.name for event in result.events] == NAMES and np.sum(away) > 500
    np.testing.assert_allclose(rows[away, 1 : own.shape[1] + 1], own[away], rtol=0, atol=1e-12)


@pytest.mark.slow
def test_fmus_have_the_states_of_runs(tmp_path):
    """Co-simulation to rounding; in model exchange the importer's integrator has its own errors."""
    model = loaded(SWING, tmp_path)
    fmu = fmu_of(model, tmp_path / "swing.fmu")
    for kind, most in (("CoSimulation", 1e-12), ("ModelExchange", 1e-3)):
        rows = simulated(fmu, kind, 1.3, step=0.01, outputs=["load.x", "load.y"])
        result = model.simulate(integrator="rk4", step=1e-3, times=rows["time"])
        away = away_from_events(result, rows["time"])
        for column in ("load.x", "load.y"):
            np.testing.assert_allclose(rows[column][away], result[column][away], rtol=0, atol=most)


@pytest.mark.slow
def test_the_live_part_of_a_page_has_the_motion_of_the_run(tmp_path):
    model, settings = loaded(SWING, tmp_path), {"integrator": "rk4", "step": 1e-3}
    page = model.simulate(until=0.05, **settings).view()
    assert page.live
    run = model.simulate(until=1.3, **settings)
    expected = np.array([run[each][-1] for each in run.q.names])
    found = state_of_page(page.html, {}, 1300)[: len(expected)]
    np.testing.assert_allclose(found, expected, rtol=0, atol=1e-12)

"""Joints that hold for a while in C and FMUs: the states, events and reasons of runs."""

import numpy as np
import pytest
from support.holding import MACHINES

from tests.result.targets.compilers import compiled, written
from tests.result.targets.test_c_modes import loaded
from tests.result.targets.test_c_runs import rows_in, run_of
from tests.result.targets.test_fmu import fmu_of, simulated


def away_from_events(result, times):
    """Return the times that are not those of events, where a state before or after them may be meant."""
    return np.all([np.abs(times - event.t) > 1e-9 for event in result.events], axis=0)


@pytest.mark.by_turns(6)
@pytest.mark.slow
@pytest.mark.parametrize(
    ("name", "coordinates"),
    [
        ("clutch", "absolute"),
        ("rope", "absolute"),
        ("link", "joint"),
        ("pendulum", "joint"),
        ("docking", "absolute"),
        ("docking", "joint"),
    ],
)
def test_c_has_the_states_of_runs(name, coordinates, tmp_path):
    model = loaded(MACHINES[name], tmp_path)
    rows = rows_in(run_of(compiled(written(model.mechanism, tmp_path / "c", coordinates=coordinates))).stdout)
    result = model.simulate(integrator="rk4", times=rows[:, 0], coordinates=coordinates)
    own = np.array([result[name] for name in (*result.q.names, *result.v.names)]).T
    away = away_from_events(result, rows[:, 0])
    assert result.ok and np.sum(away) > 500
    np.testing.assert_allclose(rows[away, 1 : own.shape[1] + 1], own[away], rtol=0, atol=1e-12)


@pytest.mark.by_turns(2)
@pytest.mark.slow
def test_c_says_why_a_joint_cannot_hold(tmp_path):
    model = loaded(MACHINES["clutch"].replace('holds_at = "present"\n', ""), tmp_path)
    ran = run_of(compiled(written(model.mechanism, tmp_path / "c", integrator="dop853")))
    result = model.simulate(integrator="dop853")
    assert result.status == "failed" and "in its place" in result.reason
    assert ran.returncode == 1 and ran.stderr == f"{result.reason}\n"


@pytest.mark.by_turns(2)
@pytest.mark.slow
def test_an_fmu_has_the_states_of_runs(tmp_path):
    model = loaded(MACHINES["clutch"], tmp_path)
    fmu = fmu_of(model, tmp_path / "clutch.fmu")
    rows = simulated(fmu, "CoSimulation", 1.0, step=0.01, outputs=["a.omega", "teeth.mode"])
    result = model.simulate(integrator="rk4", step=1e-3, times=rows["time"])
    for column in ("a.omega", "teeth.mode"):
        away = away_from_events(result, rows["time"])
        np.testing.assert_allclose(rows[column][away], result[column][away], rtol=0, atol=1e-12)
    with pytest.raises(Exception, match="ModelExchange"):
        simulated(fmu, "ModelExchange", 1.0)

"""FMUs of bodies without inertia or mass, whose accelerations come by an iteration, against runs."""

import numpy as np
import pytest
from fmpy import simulate_fmu
from fmpy.validation import validate_fmu

import symgen
from symgen.result.targets import TARGETS, Request
from tests.result.targets.kinds_of_code import mechanism_of

NAMES = ["cart.x", "cart.vx", "pole.theta", "pole.omega"]


@pytest.fixture(scope="module", params=["light body", "massless body"])
def kind(request):
    return request.param


@pytest.fixture(scope="module", params=[(2, "absolute"), (3, "absolute"), (3, "joint")], ids=str)
def made(request, kind, tmp_path_factory):
    """The FMU and its mechanism."""
    fmi, coordinates = request.param
    mechanism, path = mechanism_of(kind), tmp_path_factory.mktemp("light") / "cart.fmu"
    TARGETS.get("fmu").write(Request(mechanism, path, fmi=fmi, coordinates=coordinates))
    return path, mechanism


@pytest.mark.by_turns(4)
@pytest.mark.slow
@pytest.mark.parametrize(
    ("simulated", "run"),
    [
        ({"fmi_type": "CoSimulation"}, {"integrator": "rk4", "step": 1e-3}),
        (
            {"fmi_type": "ModelExchange", "solver": "CVode", "relative_tolerance": 1e-13},
            {"integrator": "dop853", "rtol": 1e-12, "max_step": 0.01},  # between steps it is less accurate
        ),
    ],
    ids=["co-simulation", "model exchange"],
)
def test_motion_is_that_of_a_run(simulated, run, made):
    path, mechanism = made
    assert validate_fmu(str(path)) == []
    rows = simulate_fmu(str(path), stop_time=0.4, output_interval=0.04, output=NAMES, record_events=False, **simulated)
    own = symgen.simulate(mechanism, until=0.4, output_step=0.04, verify=False, **run)
    assert own.status == "ok" and np.ptp(own["pole.theta"]) > 0.1
    for name in NAMES:
        np.testing.assert_allclose(rows[name], own[name], rtol=0, atol=1e-9)

"""Code whose state is that of joints has the encoders of a robot: angles, rates and torques by the names of results."""

import subprocess

import numpy as np
import pytest
from fmpy import read_model_description, simulate_fmu
from numpy.testing import assert_allclose
from support.emitted import mechanism_of

import symgen
from symgen.result.targets import TARGETS, Request
from tests.result.targets.compilers import compiled, written

JOINTS = ("hip", "knee")


@pytest.fixture(scope="module")
def leg():
    """Two links in space, driven by a torque that holds the weight of neither."""
    bodies = {
        "thigh": {"mass": 2.0, "inertia": [0.02, 0.02, 0.004], "position": [0.0, 0.0, -0.2]},
        "shank": {"mass": 1.0, "inertia": [0.01, 0.01, 0.002], "position": [0.0, 0.0, -0.6]},
    }
    ends = {"hip": ("ground", "thigh", [0.0, 0.0, 0.0]), "knee": ("thigh", "shank", [0.0, 0.0, -0.2])}
    joints = {
        name: {"type": "revolute", "between": [a, b], "at": [at, [0.0, 0.0, 0.2]], "axis": [0.0, 1.0, 0.0]}
        for name, (a, b, at) in ends.items()
    }
    forces = {f"m{name}": {"type": "torque", "joint": name, "torque": f"{k + 1.0}*u - 0.2*{name}.angle.rate"}
              for k, name in enumerate(JOINTS)}  # fmt: skip
    return symgen.load(
        mechanism_of(
            {
                "mechanism": {"name": "leg", "space": "spatial", "gravity": [0.0, 0.0, -9.81]},
                "run": {"until": 0.5},
                "inputs": {"u": {"default": 1.5, "unit": "N m"}},
                "bodies": bodies,
                "joints": joints,
                "forces": forces,
            }
        )
    )


NAMES = [f"{joint}.{what}" for joint in JOINTS for what in ("angle", "angle.rate")] + ["mhip.torque", "mknee.torque"]


@pytest.fixture(scope="module")
def run(leg):
    return leg.simulate(until=0.5, coordinates="joint", integrator="dop853", rtol=1e-11, atol=1e-12, output_step=0.05)


@pytest.mark.slow
@pytest.mark.parametrize("fmi", [2, 3])
@pytest.mark.parametrize("kind", ["CoSimulation", "ModelExchange"])
def test_fmus_have_angles_rates_and_torques_as_outputs(leg, run, tmp_path, fmi, kind):
    path = tmp_path / "leg.fmu"
    TARGETS.get("fmu").write(Request(leg.mechanism, path, fmi=fmi, coordinates="joint"))
    variables = {v.name: v for v in read_model_description(str(path)).modelVariables}
    assert {variables[name].causality for name in NAMES} == {"output"}
    assert [variables[name].unit for name in NAMES[:2]] == ["rad", "rad/s"] and variables["mhip.torque"].unit == "N m"
    states = [name for name in variables if name.startswith("state.")]
    assert states == [f"state.{joint}.angle{rate}" for rate in ("", ".rate") for joint in JOINTS]
    keys = {"solver": "CVode", "relative_tolerance": 1e-9} if kind == "ModelExchange" else {}
    rows = simulate_fmu(str(path), fmi_type=kind, stop_time=0.5, output_interval=0.05, output=NAMES, **keys)
    for name in NAMES:
        scale = np.abs(run[name]).max()
        assert_allclose(rows[name], run[name], atol=1e-6 * scale, err_msg=name)


@pytest.mark.slow
def test_the_program_in_c_prints_them(leg, run, tmp_path):
    program = compiled(written(leg.mechanism, tmp_path / "c", coordinates="joint"))
    done = subprocess.run([program, "0.5", "1e-3"], capture_output=True, text=True, check=True)
    head, *rows = done.stdout.splitlines()
    columns = dict(zip(head.split(","), np.array([row.split(",") for row in rows], dtype=float).T, strict=True))
    for name in NAMES:
        assert_allclose(columns[name][-1], run[name][-1], rtol=1e-7, atol=1e-9)
    header = (tmp_path / "c" / "leg.h").read_text()
    assert "The state y begins with hip.angle, knee.angle, hip.angle.rate, knee.angle.rate." in header

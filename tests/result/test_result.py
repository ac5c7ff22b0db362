"""What a result holds, checked against mechanics rather than against the code that made it."""

import json
from dataclasses import replace

import numpy as np
import pytest

import symgen
from symgen.base.errors import InputError
from symgen.result.signals import signals_of_run


@pytest.fixture(scope="module")
def four_bar():
    return symgen.simulate("four-bar", integrator="rk4", until=0.5, output_step=0.05)


@pytest.fixture(scope="module")
def model(tmp_path_factory):
    """A crank on a driven pin, and a rod between them with a damper: work of both signs."""
    path = tmp_path_factory.mktemp("model") / "damped.toml"
    path.write_text(
        """
[mechanism]
name = "damped"
gravity = [0.0, -9.81]
[bodies.rod]
mass = 2.0
inertia = 0.3
points = { top = [-0.5, 0.0] }
position = [0.5, 0.0]
angular_velocity = 1.0
[joints.pin]
type = "revolute"
between = ["ground", "rod"]
at = [[0.2, 0.1], "top"]
[forces.friction]
type = "torsional-spring-damper"
between = ["ground", "rod"]
damping = 0.7
"""
    )
    return symgen.load(path)


# -- tables ------------------------------------------------------------------------------------------------------------


def test_tables_have_one_row_an_output(four_bar):
    k = len(four_bar.t)
    assert k == 11
    assert four_bar.t[-1] == 0.5
    for name, table in four_bar.tables().items():
        assert table.values.shape == (k, len(table.names)), name
        assert np.all(np.isfinite(table.values)), name


def test_columns_are_found_by_name(four_bar):
    assert four_bar["t"] is four_bar.t
    assert np.array_equal(four_bar["crank.theta"], four_bar.q.values[:, 2])
    assert np.array_equal(four_bar["coupler.omega"], four_bar.v.values[:, 5])
    assert np.array_equal(four_bar["rocker.alpha"], four_bar.a.values[:, 8])
    assert np.array_equal(four_bar["B.Fx"], four_bar.reactions["B.Fx"])
    with pytest.raises(InputError, match=r"did you mean 'crank\.theta'"):
        four_bar["crank.thet"]


def test_joint_coordinates_are_angles_between_bodies(four_bar):
    joints = four_bar.joint_coordinates
    assert np.allclose(joints["B.angle"], four_bar["coupler.theta"] - four_bar["crank.theta"], atol=1e-14)
    assert np.allclose(joints["B.angle.rate"], four_bar["coupler.omega"] - four_bar["crank.omega"], atol=1e-14)
    assert joints.unit("B.angle.rate") == "rad/s"


def test_accelerations_are_rates_of_velocities():
    result = symgen.simulate("four-bar", until=0.1, output_step=0.001)
    slope = np.gradient(result["coupler.vx"], result.t)
    assert np.allclose(slope[2:-2], result["coupler.ax"][2:-2], rtol=1e-4, atol=1e-4)


# -- reactions ---------------------------------------------------------------------------------------------------------


def test_reactions_balance_each_body(four_bar):
    """m a = weight + reactions, I alpha = moments about the centre of mass, signs by Newton's third law."""
    r = four_bar.reactions
    mass, inertia = 2.0, 2.0 * 2.0**2 / 12
    theta = four_bar["crank.theta"]
    # A is reported on the ground, B on the crank
    fx, fy = -r["A.Fx"] + r["B.Fx"], -r["A.Fy"] + r["B.Fy"]
    assert np.allclose(mass * four_bar["crank.ax"], fx, atol=1e-9)
    assert np.allclose(mass * four_bar["crank.ay"], fy - mass * 9.81, atol=1e-9)
    arm = np.column_stack([-np.cos(theta), -np.sin(theta)])  # from the centre of mass to A
    moment = arm[:, 0] * (-r["A.Fy"] - r["B.Fy"]) - arm[:, 1] * (-r["A.Fx"] - r["B.Fx"])  # B is opposite to A
    assert np.allclose(inertia * four_bar["crank.alpha"], moment, atol=1e-9)


def test_a_pin_carries_no_moment(four_bar):
    r = four_bar.reactions
    # moments of forces of 1e2 N about points 10 m away, taken apart and put together again
    for joint in "ABCD":
        assert np.abs(r[f"{joint}.M"]).max() < 1e-11 * np.abs(r[f"{joint}.Fy"]).max()


def test_reactions_in_axes_of_bodies_and_their_magnitudes(four_bar):
    r, own, size = four_bar.reactions, four_bar.body_reactions, four_bar.magnitudes
    theta = four_bar["crank.theta"]
    assert np.allclose(own["B.Fx"], np.cos(theta) * r["B.Fx"] + np.sin(theta) * r["B.Fy"], rtol=1e-13, atol=1e-12)
    assert np.allclose(own["B.Fy"], np.cos(theta) * r["B.Fy"] - np.sin(theta) * r["B.Fx"], rtol=1e-13, atol=1e-12)
    assert np.array_equal(own["D"], r["D"])  # on the ground
    assert np.allclose(size["C.F"], np.hypot(r["C.Fx"], r["C.Fy"]), rtol=1e-15)
    assert size.names == ("A.F", "B.F", "C.F", "D.F") and set(size.units) == {"N"}


def test_the_shape_and_units_of_a_reaction(four_bar):
    r = four_bar.reactions
    assert four_bar.reaction("D").shape == (len(four_bar.t), 3)
    assert r.unit("D.M") == "N m" and r.unit("D.Fx") == "N"


def test_a_point_mass_has_no_moment():
    result = symgen.simulate("pendulum", until=0.2, output_step=0.1)
    assert set(result.reactions.names) == {"link.Fx", "link.Fy", "link.M"}  # on the ground
    assert np.allclose(result.reactions["link.M"], 0.0, atol=1e-9)
    tension = np.hypot(result.reactions["link.Fx"], result.reactions["link.Fy"])
    # released from the horizontal: T = 3 m g sin(angle below the horizontal)
    assert np.allclose(tension, 3 * 9.81 * -result["bob.y"], atol=1e-6)


# -- energy ------------------------------------------------------------------------------------------------------------


def test_energy_of_a_conservative_mechanism(four_bar):
    e = four_bar.energy
    assert np.allclose(e["error"], e["kinetic"] + e["potential"] - e["kinetic"][0] - e["potential"][0], atol=1e-12)
    assert np.allclose(e["work"], 0.0)
    assert np.abs(e["error"]).max() <= four_bar.energy_drift_max < 1e-8


def test_work_of_a_damper_is_what_the_energy_loses(model):
    result = model.simulate(until=2.0, integrator="rk4", step=1e-3)
    rate = 0.7 * result["rod.omega"] ** 2
    lost = np.concatenate([[0.0], np.cumsum(0.5 * (rate[1:] + rate[:-1]) * np.diff(result.t))])
    assert np.allclose(result.work, -lost, atol=1e-5)
    assert np.abs(result.energy_error).max() < 1e-9


def test_work_of_a_driver_balances():
    result = symgen.simulate("driven-four-bar", until=1.0)
    assert np.abs(result.work).max() > 1.0
    assert result.energy_drift_max < 1e-5 * np.abs(result.work).max()


def test_the_energy_at_the_start_needs_no_output_there(four_bar):
    late = symgen.simulate("four-bar", integrator="rk4", until=0.5, times=[0.25, 0.5])
    assert np.allclose(late.energy_error, four_bar.energy_error[[5, 10]], atol=1e-12)


# -- the start ---------------------------------------------------------------------------------------------------------


def test_a_start_that_was_changed_is_noted(model):
    result = model.simulate(until=0.01)
    assert any("the shortest changes close" in note for note in result.notes)
    with pytest.raises(InputError, match="`strict`"):
        model.simulate(until=0.01, strict=True)


# -- JSON --------------------------------------------------------------------------------------------------------------


def test_json_is_the_contract(four_bar):
    found = four_bar.to_json()
    assert json.loads(json.dumps(found, allow_nan=False)) == found
    assert set(found["seconds"]) == {"derive", "emit", "compile", "run"}
    assert found["rank"] == {"rows": 8, "rank": 8, "identical_rows_dropped": 0}
    assert found["step"] == 1e-3 and found["rtol"] is None and found["atol"] is None
    assert found["final"]["t"] == 0.5
    assert list(found["final"]["q"])[:3] == ["crank.x", "crank.y", "crank.theta"]
    assert list(found["final"]["v"])[:3] == ["crank.vx", "crank.vy", "crank.omega"]
    assert found["final"]["lam"] == pytest.approx(four_bar.lam.row(), abs=1e-9)
    assert found["parameters"] == {"crank_mass": 2.0, "coupler_mass": 8.0, "rocker_mass": 5.0}


def test_json_of_an_adaptive_run_has_tolerances_instead_of_a_step():
    found = symgen.simulate("pendulum", integrator="dopri5", rtol=1e-7, until=0.5).to_json()
    assert found["step"] is None and found["rtol"] == 1e-7 and found["atol"] == 1e-10
    assert found["rejected"] >= 0


def test_json_has_no_nan(four_bar):
    broken = replace(four_bar, energy_drift_max=float("nan"), position_violation_max=float("inf"))
    found = broken.to_json()
    assert found["energy_drift_max"] is None and found["position_violation_max"] is None
    json.dumps(found, allow_nan=False)


def test_notebooks_get_an_escaped_table(four_bar):
    text = replace(four_bar, reason="a < b", status="failed")._repr_html_()
    assert "a &lt; b" in text and text.startswith("<table>")


# -- settings ----------------------------------------------------------------------------------------------------------


def test_repeated_runs_report_the_shortest():
    result = symgen.simulate("pendulum", until=0.1, repeat=3)
    assert result.seconds.run > 0.0 and result.seconds.run_spread >= 0.0


@pytest.mark.parametrize("name", ["four-bar", "scissor-lift", "spherical-double-pendulum", "pendulum"])
def test_columns_are_known_before_a_run(name):
    model = symgen.load(name)
    result = model.simulate(until=0.01, step=1e-2, integrator="rk4")
    tables = signals_of_run(model.mechanism, result.outcome.compiled.info)
    assert [s.name for table in tables.values() for s in table] == list(result.whole().names)
    assert tuple(s.unit for table in tables.values() for s in table) == result.whole().units
    assert {table: tuple(s.key for s in signals) for table, signals in tables.items()} == {
        name: table.names for name, table in result.tables().items()
    }

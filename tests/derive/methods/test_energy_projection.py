"""Velocities scaled to the energy: exact balance, what drivers prescribe kept, and no judgement by energy."""

import numpy as np
import pytest
from support.checks import close
from support.laws_at import LawAt, described

import symgen
from symgen.api import Model, load
from symgen.base.errors import InputError
from symgen.describe.files.validate import validate

METHOD = "energy-projection"


def swing_on_a_cart():
    """A rod on a cart that a driver moves: nu is not 0, and one degree of freedom is left."""
    rod = {"mass": 1.0, "inertia": "1/12", "points": {"A": [-0.5, 0.0]}, "position": [0.5, 0.0]}
    bodies = {"cart": {"mass": 3.0, "inertia": 1.0}, "rod": rod}
    joints = {
        "rail": {"type": "driver", "body": "cart", "coordinate": "x", "value": "0.2*sin(5*t)"},
        "height": {"type": "driver", "body": "cart", "coordinate": "y", "value": 0.0},
        "level": {"type": "driver", "body": "cart", "coordinate": "theta", "value": 0.0},
    }
    joints["pin"] = {"type": "revolute", "between": ["cart", "rod"], "at": ["centre", "A"]}
    return {"mechanism": {"name": "swing", "gravity": [0.0, -9.81]}, "bodies": bodies, "joints": joints}


@pytest.mark.parametrize("raw", [described("four-bar"), swing_on_a_cart()], ids=["released", "driven"])
def test_the_balance_holds_and_what_is_prescribed_stays(raw):
    one, t = LawAt(raw, METHOD), 0.0
    rng = np.random.default_rng(1)
    q, v = one.accepted(one.q, one.v + 0.3 * rng.standard_normal(one.nv))  # its energy is the balance from now on
    balance = one.status("kinetic") + one.status("potential")
    same = one.accepted(q, v)
    close(same[1], v, "a state that is exact keeps its velocities", 1e-13)
    off = v + 0.05 * rng.standard_normal(one.nv)
    closed, after = one.accepted(q, off, t)
    e = one.equations(closed, after)
    assert np.abs(e.drift).max() < 1e-13 * np.abs(after).max() * 10.0
    kinetic = 0.5 * after @ e.mass @ after
    assert kinetic + one.status("potential") == pytest.approx(balance, abs=1e-12 * abs(balance) + 1e-12)
    half = np.linalg.solve(e.mass, e.d.T) @ np.linalg.inv(e.schur())
    prescribed = half @ e.nu
    free = off - half @ (e.d @ off - e.nu) - prescribed  # of the least change in the metric of M
    assert prescribed @ e.mass @ free == pytest.approx(0.0, abs=1e-12)
    square = (balance - one.status("potential") - 0.5 * prescribed @ e.mass @ prescribed) / (0.5 * free @ e.mass @ free)
    close(after, prescribed + np.sqrt(square) * free, "v", 1e-12)
    assert (np.abs(prescribed).max() > 0.1) == ("rail" in raw["joints"])


def test_velocities_stay_where_no_factor_gives_the_energy():
    one = LawAt(described("four-bar"), METHOD)
    q, v = one.accepted(one.q, np.zeros(one.nv))
    np.testing.assert_array_equal(v, 0.0)
    moved = one.equations(q, v)
    free = np.linalg.svd(moved.d)[2][-1]
    for speed in (1e-3, 3.0):  # at rest in the balance: every energy of motion is beyond a quarter of itself
        close(one.accepted(q, speed * free)[1], speed * free, "v", 1e-12)


@pytest.mark.slow_cases("{'shape': 'looped'}")
@pytest.mark.parametrize("keys", [{}, {"shape": "looped"}, {"coordinates": "joint"}], ids=str)
def test_the_energy_of_a_run(keys):
    model = load("four-bar")
    result = model.simulate(method=METHOD, integrator="rk4", step=4e-3, until=2.0, **keys)
    usual = model.simulate(
        method="direct-correction", options={"method.weight": "mass"}, integrator="rk4", step=4e-3, until=2.0, **keys
    )
    assert result.energy_drift_max < 1e-11 < 1e-7 < usual.energy_drift_max
    assert result.position_violation_max < 1e-11 and result.velocity_violation_max < 1e-13


def test_the_work_of_drivers_is_part_of_the_balance():
    result = Model(validate(swing_on_a_cart(), "test")).simulate(method=METHOD, integrator="rk4", step=2e-3, until=1.0)
    assert np.abs(np.asarray(result.work)).max() > 0.1 and result.energy_drift_max < 1e-11


def gain(raw, until):
    """Error of the motion without scaling over that with it."""
    model, times = Model(validate(raw, "test")), np.linspace(0.0, until, 11)
    exact = model.simulate(integrator="dop853", rtol=1e-12, atol=1e-13, until=until, times=times)
    errors = []
    for method, options in ((METHOD, {}), ("direct-correction", {"method.weight": "mass"})):
        run = model.simulate(method=method, options=options, integrator="rk4", step=1e-2, until=until, times=times)
        errors.append(np.abs(np.asarray(run.q) - np.asarray(exact.q)).max())
    return errors[1] / errors[0]


@pytest.mark.slow
def test_energy_fixes_the_motion_of_one_degree_of_freedom_only():
    """The four-bar, and the same with its last pin open."""
    raw = described("four-bar")
    opened = raw | {"joints": {name: joint for name, joint in raw["joints"].items() if name != "D"}}
    assert gain(raw, 10.0) > 50.0 and 0.5 < gain(opened, 2.0) < 2.0


def test_such_runs_are_not_judged_by_their_energy():
    model = load("four-bar")
    result = model.simulate(method=METHOD, integrator="rk4", step=1e-3, until=1.0, max_energy_error=1e-30)
    assert result.status == "unverified" and "velocities are scaled to the energy" in result.reason
    assert model.simulate(method=METHOD, integrator="rk4", step=1e-3, until=1.0, verify=True).status == "ok"
    rows = symgen.sweep(model, {"coupler_mass": [7.0, 8.0, 9.0]}, method=METHOD, integrator="rk4", step=1e-3, until=0.2)
    assert set(rows.status) == {"unverified"}


def test_the_balance_goes_on_after_parameters_change():
    """Twice the mass of the coupler adds to the energy; velocities follow the new balance, not the old one."""
    ends = []
    for method, options in ((METHOD, {}), ("direct-correction", {"method.weight": "mass"})):
        run = load("four-bar").start(method=method, options=options, integrator="rk4", step=1e-3)
        run.run(0.5)
        run.set({"coupler_mass": 16.0})
        run.run(1.0)
        ends.append(list(run.bodies.values()))
    np.testing.assert_allclose(ends[0], ends[1], rtol=0.0, atol=1e-6)


def test_what_it_refuses(cli):
    raw = described("four-bar")
    light = {"coupler": raw["bodies"]["coupler"] | {"mass": 0.0, "inertia": 0.0}}
    with pytest.raises(InputError, match="massless bodies"):
        Model(validate(raw | {"bodies": raw["bodies"] | light}, "test")).simulate(method=METHOD, until=0.01)
    code, _, said = cli("run", "driven-four-bar", "--method", METHOD, "--coordinates", "joint")
    assert code == 2 and "expected coordinates in which no driver prescribes one of the state" in said
    with pytest.raises(InputError, match="scales velocities to the energy"):
        symgen.sweep(
            load("four-bar"),
            {"coupler_mass": [7.0, 8.0]},
            method=METHOD,
            integrator="rk4",
            step=1e-3,
            until=0.1,
            target="lanes",
        )

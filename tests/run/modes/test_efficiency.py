"""Losses of gears, racks and screws: efficiencies at the ends, self-locking at its angle, and where the power goes."""

import math

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from support.emitted import mechanism_of

import symgen
from symgen.base.errors import InputError
from tests.result.targets.test_c_modes import assert_same_run, program_of
from tests.result.targets.test_fmu import fmu_of, simulated

#: Moments of inertia [kg m^2] and pitch radii [m] of two wheels.
INERTIAS, RADII = (0.3, 0.5), (0.1, 0.2)


def wheels(efficiency, driving, load, rate=0.0):
    """Two wheels under torques; those on the second one count against its turn."""
    builder = symgen.MechanismBuilder("wheels").parameter("load", load, unit="N m")
    for i, name in enumerate("ab"):
        at, omega = (0.3 * i, 0.0), (rate, -rate * RADII[0] / RADII[1])[i]
        builder.body(name, mass=1.0, inertia=INERTIAS[i], position=at, angular_velocity=omega)
        builder.joint(f"axle_{name}", "revolute", between=("ground", name), at=(at, "centre"))
    builder.joint("mesh", "gear", between=("a", "b"), radii=RADII, efficiency=efficiency)
    builder.force("motor", "torque", body="a", torque=driving).force("brake", "torque", body="b", torque="load")
    builder.output("supplied", "integral(motor.power + brake.power)", unit="J")
    return symgen.load(builder.output("heat", "mesh.dissipated", unit="J").build())


def tooth_forces(result, driving, load):
    """Forces on the teeth of both wheels, from what the wheels do."""
    late = len(result.t) // 2
    rise = (result["a.omega"][-1] - result["a.omega"][late]) / (result.t[-1] - result.t[late])
    return (driving - INERTIAS[0] * rise) / RADII[0], (INERTIAS[1] * rise * RADII[0] / RADII[1] + load) / RADII[1]


@pytest.mark.by_turns(6)
@pytest.mark.slow
@pytest.mark.parametrize(
    ("efficiency", "forwards", "backwards"),
    [
        ([0.8, 0.6], 0.8, 0.6),
        ([0.99, 0.5], 0.99, 0.5),
        ([0.3, 0.9], 0.3, 0.9),
        (0.9, 0.9, 2.0 - 1.0 / 0.9),
        ([0.4, -0.5], 0.4, -0.5),
    ],
)
def test_efficiencies_are_those_at_the_ends(efficiency, forwards, backwards):
    """The first wheel drives, forwards and in reverse; then the second one does, and in a worm both have to."""
    for way in (1.0, -1.0):
        driven = wheels(efficiency, way, 0.3 * way, way).simulate(until=0.02, rtol=1e-11)
        first, second = tooth_forces(driven, way, 0.3 * way)
        assert second / first == pytest.approx(forwards, abs=1e-9)
        driving = wheels(efficiency, 0.0, way, -way).simulate(until=0.02, rtol=1e-11)
        first, second = tooth_forces(driving, 0.0, way)
        assert first / second == pytest.approx(backwards, abs=1e-9)
        assert (driven["mesh.mode"] == way).all() and (driving["mesh.mode"] == -way).all()


@pytest.mark.slow
@pytest.mark.parametrize("efficiency", [[0.8, 0.6], 0.4])
def test_all_power_is_motion_or_heat(efficiency):
    """Through sticking and reversals what the torques supply is found again; heat never turns back."""
    result = wheels(efficiency, "3*sin(9*t)", 0.2).simulate(until=2.0, rtol=1e-11)
    assert result.ok
    assert {event.name for event in result.events} & {"mesh.stick", "mesh.reverse"}
    kinetic = 0.5 * (INERTIAS[0] * result["a.omega"] ** 2 + INERTIAS[1] * result["b.omega"] ** 2)
    np.testing.assert_allclose(kinetic + result["heat"], result["supplied"], atol=1e-9)
    assert np.diff(result["heat"]).min() > -1e-12
    assert result["heat"][-1] > 0.1


@pytest.mark.slow
@pytest.mark.parametrize("coordinates", ["absolute", "joint"])
def test_an_efficiency_may_depend_on_the_speed(coordinates):
    """As a table of losses over speed has it: beside the one equation of motion, integrated by SciPy."""
    model = wheels("0.9 - 0.4*exp(-rate/0.2)", "1 + 0.5*sin(9*t)", 0.3, 1.0)
    result = model.simulate(until=2.0, rtol=1e-11, coordinates=coordinates)

    def rise(t, rate):
        part = 0.9 - 0.4 * math.exp(-RADII[0] * rate[0] / 0.2)  # of the power that the first wheel has on its teeth
        driving, load = (1.0 + 0.5 * math.sin(9.0 * t)) / RADII[0], 0.3 / RADII[1]
        ratio = RADII[0] / RADII[1]
        return [(part * driving - load) / (INERTIAS[1] * ratio / RADII[1] + part * INERTIAS[0] / RADII[0])]

    expected = solve_ivp(rise, (0.0, 2.0), [1.0], method="DOP853", rtol=1e-12, atol=1e-13)
    assert result.ok and result["a.omega"][-1] == pytest.approx(expected.y[0, -1], abs=1e-9)


@pytest.mark.slow
def test_heat_and_motion_balance_to_rounding():
    """With constant torques all is linear in time: work, motion and heat are known to the last digits."""
    result = wheels([0.8, 0.6], 1.0, 0.3, 1.0).simulate(until=1.0, rtol=1e-12)
    kinetic = 0.5 * (INERTIAS[0] * result["a.omega"] ** 2 + INERTIAS[1] * result["b.omega"] ** 2)
    work = 1.0 * (result["a.theta"] - result["a.theta"][0]) + 0.3 * (result["b.theta"] - result["b.theta"][0])
    np.testing.assert_allclose(kinetic + result["heat"] - kinetic[0] - work, 0.0, atol=1e-12)
    ratio, radius = RADII[0] / RADII[1], RADII[0]
    rise = (0.8 * 1.0 / radius - 0.3 / RADII[1]) / (INERTIAS[1] * ratio / RADII[1] + 0.8 * INERTIAS[0] / radius)
    np.testing.assert_allclose(result["a.omega"], 1.0 + rise * result.t, rtol=1e-12)


# -- a worm ------------------------------------------------------------------------------------------------------------

FRICTION = math.atan(0.1)


def hoist(torque=0.0, **keys):
    """A load on a drum that a worm of lead angle `lead` turns; friction in the thread has the angle atan(0.1)."""
    builder = symgen.MechanismBuilder("hoist", space="spatial", gravity=(0.0, 0.0, -9.81), **keys)
    builder.parameter("lead", 0.05).parameter("rho", FRICTION).parameter("ratio", "tan(lead)*0.02/0.1")
    builder.body("worm", mass=1.0, inertia=(1e-3, 1e-4, 1e-4), position=(0.0, 0.3, 0.0))
    builder.body("drum", mass=5.0, inertia=(0.05, 0.02, 0.02), position=(0.0, 0.0, 0.0))
    builder.joint("shaft", "revolute", between=("ground", "worm"), at=((0.0, 0.3, 0.0), "centre"), axis=(1, 0, 0))
    builder.joint("axle", "revolute", between=("ground", "drum"), at=((0.0, 0.0, 0.0), "centre"), axis=(0, 1, 0))
    efficiency = ["tan(lead)/tan(lead + rho)", "tan(lead - rho)/tan(lead)"]
    # theta_worm = theta_drum / ratio
    builder.joint(
        "worm_gear", "gear", joints=("shaft", "axle"), ratio="1/ratio", mesh="internal", efficiency=efficiency
    )
    builder.force("motor", "torque", joint="shaft", torque=torque)
    builder.force("load", "torque", joint="axle", torque=-30.0)
    return symgen.load(builder.output("heat", "worm_gear.dissipated", unit="J").build())


def rise(lead, torque, way):
    """Angular acceleration of the drum: the worm turns 1/ratio times as fast; `way` is that of the motion."""
    ratio = math.tan(lead) * 0.02 / 0.1
    # with N along the thread, the tangential force is N tan(lead + rho) where the load goes up, N tan(lead - rho) down
    slope = math.tan(lead + way * FRICTION) / math.tan(lead) * ratio
    # torque - 1e-3 alpha/ratio = slope M, M - 30 = 0.02 alpha
    return (torque - 30.0 * slope) / (1e-3 / ratio + 0.02 * slope)


@pytest.mark.by_turns(2)
@pytest.mark.slow
def test_a_worm_lifts_and_lowers_and_holds_below_its_angle():
    for lead, torque, way in (
        (0.05, 2.0, 1.0),
        (0.05, 0.0, 0.0),
        (0.05, -0.5, -1.0),
        (0.2, 5.0, 1.0),
        (0.2, 0.0, -1.0),
    ):
        for coordinates in ("absolute", "joint"):
            result = hoist(torque).simulate(
                parameters={"lead": lead}, until=0.1, rtol=1e-10, coordinates=coordinates, method="direct-correction"
            )
            assert result.ok, result.reason
            assert (result["worm_gear.mode"] == way).all()
            expected = rise(lead, torque, way) if way else 0.0
            assert result["drum.wy"][-1] == pytest.approx(0.1 * expected, rel=1e-8, abs=1e-12)


@pytest.mark.by_turns(2)
@pytest.mark.slow
def test_a_sweep_of_efficiencies_locks_at_the_angle_of_the_formula():
    leads = np.linspace(0.02, 0.32, 301)
    sweep = symgen.sweep(hoist().mechanism, {"lead": leads}, until=0.05, rtol=1e-9, output=None)
    assert set(sweep.status) == {"ok"}
    end = np.asarray(sweep["drum.wy"]).reshape(301)
    locked = leads <= FRICTION
    assert 50 < locked.sum() < 250
    np.testing.assert_allclose(end[locked], 0.0, atol=1e-12)
    np.testing.assert_allclose(end[~locked], [0.05 * rise(x, 0.0, -1.0) for x in leads[~locked]], rtol=1e-6)


# -- screws and racks --------------------------------------------------------------------------------------------------


def jack(torque, efficiency=0.4):
    """A screw that lifts its nut of 20 kg by 10 mm a radian."""
    builder = symgen.MechanismBuilder("jack", space="spatial", gravity=(0.0, 0.0, -9.81))
    builder.body("spindle", mass=2.0, inertia=(0.01, 0.01, 0.01), position=(0.0, 0.0, 0.0))
    builder.body("nut", mass=20.0, inertia=(0.1, 0.1, 0.1), position=(0.0, 0.0, 0.2))
    builder.joint("bearing", "revolute", between=("ground", "spindle"), at=((0, 0, 0), "centre"), axis=(0, 0, 1))
    builder.joint("key", "perpendicular", between=("ground", "nut"), axes=((0, 1, 0), (1, 0, 0)))
    builder.joint(
        *("thread", "screw"),
        between=("spindle", "nut"),
        at=("centre", "centre"),
        axis=(0, 0, 1),
        pitch=-0.02 * math.pi,
        offset=0.2,
        efficiency=efficiency,
    )
    return symgen.load(builder.force("motor", "torque", joint="bearing", torque=torque).build())


@pytest.mark.by_turns(6)
@pytest.mark.slow
@pytest.mark.parametrize(
    "settings", [{}, {"coordinates": "joint"}, {"shape": "looped"}, {"integrator": "radau5"}], ids=str
)
def test_a_lead_screw_lifts_and_holds(settings):
    """The motor has to bring what the load takes and the thread loses: F = f T/0.01 forwards."""
    result = jack(10.0).simulate(until=0.1, rtol=1e-10, **settings)
    lift = (0.4 * 10.0 / 0.01 - 20.0 * 9.81) / (20.0 + 0.4 * 0.01 / 0.01**2)
    np.testing.assert_allclose(result["nut.z"] - 0.2, 0.5 * lift * result.t**2, atol=1e-9)
    rest = jack(0.0).simulate(until=0.1, **settings)
    assert rest.ok and (rest["thread.mode"] == 0.0).all()
    np.testing.assert_allclose(rest["nut.z"], 0.2, atol=1e-12)


@pytest.mark.slow
def test_a_rack_is_driven_and_drives():
    builder = symgen.MechanismBuilder("rack", space="spatial").parameter("push", 0.0)
    builder.body("pinion", mass=1.0, inertia=(0.01, 0.01, 0.02), position=(0.0, 0.0, 0.0))
    builder.body("bar", mass=3.0, inertia=(0.1, 0.1, 0.1), position=(0.0, 0.05, 0.0))
    builder.joint("axle", "revolute", between=("ground", "pinion"), at=((0, 0, 0), "centre"), axis=(0, 0, 1))
    builder.joint("guide", "translational", between=("ground", "bar"), at=((0, 0.05, 0), "centre"), axis=(1, 0, 0))
    builder.joint("teeth", "rack-and-pinion", pinion="axle", rack="guide", radius=-0.05, efficiency=[0.9, 0.7])
    builder.force("motor", "torque", joint="axle", torque="1.0 - push/50")
    builder.force("pull", "force", body="bar", force=("push", 0.0, 0.0))
    model = symgen.load(builder.build())
    driven = model.simulate(until=0.1, rtol=1e-10)
    forwards = -0.9 * 1.0 / 0.05 / (3.0 + 0.9 * 0.02 / 0.05**2)
    assert driven["bar.vx"][-1] == pytest.approx(0.1 * forwards, rel=1e-9)
    driving = model.simulate(parameters={"push": 50.0}, until=0.1, rtol=1e-10)
    assert driving["bar.vx"][-1] == pytest.approx(0.1 * 50.0 / (3.0 + 0.02 / 0.05**2 / 0.7), rel=1e-9)


# -- other places ------------------------------------------------------------------------------------------------------

MACHINE = """
[mechanism]
name = "pair"
[parameters]
forwards = 0.8
[bodies.a]
mass = 1.0
inertia = 0.3
[bodies.b]
mass = 1.0
inertia = 0.5
position = [0.3, 0.0]
[joints.axle_a]
type = "revolute"
between = ["ground", "a"]
at = [[0.0, 0.0], "centre"]
[joints.axle_b]
type = "revolute"
between = ["ground", "b"]
at = [[0.3, 0.0], "centre"]
[joints.mesh]
type = "gear"
between = ["a", "b"]
radii = [0.1, 0.2]
efficiency = ["forwards", 0.6]
[forces.motor]
type = "torque"
body = "a"
torque = "3*sin(9*t)"
[forces.brake]
type = "torque"
body = "b"
torque = 0.2
[run]
until = 1.0
step = 1e-3
"""


@pytest.mark.by_turns(2)
@pytest.mark.slow
def test_a_pair_in_c_and_as_a_unit(tmp_path):
    (tmp_path / "pair.toml").write_text(MACHINE)
    model = symgen.load(tmp_path / "pair.toml")
    transitions = assert_same_run(model, program_of(model, tmp_path / "c"), 1.0, 1e-3)
    assert {word for _, word in transitions} >= {"mesh.stick", "mesh.slip"}
    run = model.simulate(method="direct-correction", integrator="rk4", step=1e-3, until=1.0)
    unit = simulated(fmu_of(model, tmp_path / "pair.fmu"), "CoSimulation", 1.0)
    assert unit["a.theta"][-1] == pytest.approx(run["a.theta"][-1], abs=1e-9)


@pytest.mark.slow
def test_derivatives_by_an_efficiency(tmp_path):
    (tmp_path / "pair.toml").write_text(MACHINE)
    model = symgen.load(tmp_path / "pair.toml")
    result = model.simulate(until=0.3, rtol=1e-11, sensitivities=("forwards",))
    ends = [
        model.simulate(until=0.3, rtol=1e-12, parameters={"forwards": 0.8 + h})["a.omega"][-1] for h in (1e-4, -1e-4)
    ]
    assert result.gradient("a.omega")["forwards"][-1] == pytest.approx((ends[0] - ends[1]) / 2e-4, rel=1e-6)


@pytest.mark.parametrize(
    ("joint", "efficiency", "sentence"),
    [
        ("axle_a", 0.9, "axis, reference, got the unknown key 'efficiency'"),
        ("mesh", 0.0, "mesh.efficiency: expected a value above 0 and at most 1, got 0.0"),
        ("mesh", 1.2, "mesh.efficiency: expected a value above 0 and at most 1, got 1.2"),
        ("mesh", [1.0, 0.5], "mesh.efficiency[0]: expected a value above 0 and below 1, got 1.0"),
        (
            "mesh",
            [0.5, 1.0],
            "mesh.efficiency[1]: expected a value below 1, of 0 or less where the load does not drive, got 1.0",
        ),
        (
            "mesh",
            [0.5],
            "a formula of parameters and the motion, or two of parameters, [forwards, backwards], got [0.5]",
        ),
        (
            "mesh",
            "high",
            "mesh.efficiency: expected a number or an expression of t, rate, parameters and body coordinates, got the "
            "unknown name 'high'",
        ),
    ],
)
def test_what_is_wrong_is_named(joint, efficiency, sentence):
    joints = {
        "axle_a": {"type": "revolute", "between": ["ground", "a"], "at": [[0.0, 0.0], "centre"]},
        "mesh": {"type": "gear", "between": ["a", "b"], "radii": [0.1, 0.2]},
    }
    joints[joint]["efficiency"] = efficiency
    bodies = {name: {"mass": 1.0, "inertia": 1.0} for name in "ab"}
    with pytest.raises(InputError) as error:
        mechanism_of({"mechanism": {"name": "x"}, "bodies": bodies, "joints": joints})
    assert sentence in str(error.value)


@pytest.mark.slow
def test_a_heavy_load_behind_a_gear_that_locks_jams_by_name():
    """In a worm whose load has most of the inertia, no deceleration is large enough: the run says so."""
    builder = wheels([0.4, -0.5], 0.0, 1.0, 1.0)
    heavy = mechanism_of(
        {
            "mechanism": {"name": "heavy"},
            "bodies": {
                "a": {"mass": 1.0, "inertia": 1e-3, "angular_velocity": 1.0},
                "b": {"mass": 1.0, "inertia": 5.0, "position": [0.3, 0.0], "angular_velocity": -0.5},
            },
            "joints": {
                "axle_a": {"type": "revolute", "between": ["ground", "a"], "at": [[0.0, 0.0], "centre"]},
                "axle_b": {"type": "revolute", "between": ["ground", "b"], "at": [[0.3, 0.0], "centre"]},
                "mesh": {"type": "gear", "between": ["a", "b"], "radii": [0.1, 0.2], "efficiency": [0.4, -0.5]},
            },
        }
    )
    assert builder.simulate(until=0.01).ok
    with pytest.raises(InputError, match="friction of mesh: expected friction that brings about less than all"):
        symgen.load(heavy).simulate(until=0.1)

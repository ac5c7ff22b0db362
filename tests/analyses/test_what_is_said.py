"""What analyses say is so, or they refuse: closed forms, and what a run of the same mechanism has."""

import copy
import pickle

import numpy as np
import pytest

import symgen
from analyses import rods
from symgen.base.errors import AnalysisError, InputError
from symgen.base.settings import Settings
from symgen.describe import catalogue


def column(frame="body", bodies=None, joints=None, forces=None):
    """Two rods of 1 m, masses at their ends, springs of 1 N m/rad in the pins, and a load that follows the last one."""
    rod = {"inertia": 1e-9, "points": {"foot": [-1.0, 0.0], "top": [0.0, 0.0]}}
    own = {"lower": {**rod, "mass": 2.0, "position": [1.0, 0.0]}, "upper": {**rod, "mass": 1.0, "position": [2.0, 0.0]}}
    pins = {"A": rods.pin("ground", "lower", rods.GROUND2, "foot"), "B": rods.pin("lower", "upper", "top", "foot")}
    springs = {
        name: {"type": "torsional-spring-damper", "between": list(between), "stiffness": 1.0}
        for name, between in (("first", ("ground", "lower")), ("second", ("lower", "upper")))
    }
    thrust = {"type": "force", "body": "upper", "at": "top", "frame": frame, "force": ["-load", 0.0]}
    return rods.model(
        own | (bodies or {}),
        pins | (joints or {}),
        gravity=[0.0, 0.0],
        parameters={"load": 1.0},
        forces={**springs, "thrust": thrust, **(forces or {})},
    )


@pytest.mark.parametrize("values", [[-2.0, 0.0, 1.0], [-2.0, -1.0, 0.0, 1.0], [-2.0, -0.5, 1.0]])
def test_a_value_of_a_locus_may_be_the_one_that_is_passed(values):
    """m s^2 + c s + k: both eigenvalues pass i sqrt(k/m) where c = 0, whether or not 0 is among the values."""
    (crossing,) = rods.mass_spring_damper().locus(("c", values)).crossings
    assert crossing.value == pytest.approx(0.0, abs=1e-9)
    assert crossing.eigenvalue == pytest.approx(50j)
    assert not crossing.rising


def followed(load):
    """Eigenvalues [1/s] of Ziegler's column, masses 2 and 1 kg, by its two equations in small angles a and b.

    3 a'' + b'' + (2 - P) a + (P - 1) b = 0, a'' + b'' - a + b = 0.
    """
    mass, stiffness = np.array([[3.0, 1.0], [1.0, 1.0]]), np.array([[2.0 - load, load - 1.0], [-1.0, 1.0]])
    squares = np.linalg.eigvals(np.linalg.solve(mass, stiffness)).astype(complex)
    return np.concatenate([np.sqrt(-squares), -np.sqrt(-squares)])


@pytest.mark.slow_cases("looped")
@pytest.mark.parametrize("shape", ["straight", "looped"])
def test_a_column_that_flutters_is_unstable(shape):
    """Its reduced stiffness has no real squares: one of each four roots grows, though all real parts are positive."""
    model = column()
    for load in (1.0, 3.0):
        found = model.equilibrium(parameters={"load": load}, shape=shape)
        grows = followed(load).real.max() > 1e-6
        assert grows == (load == 3.0)
        assert found.stability == ("unstable" if grows else "stable")
        assert min(found.omega_squared) > 0.0
    assert np.sort_complex(model.modes(parameters={"load": 3.0}).eigenvalues) == pytest.approx(
        np.sort_complex(followed(3.0)), rel=1e-6
    )


def test_lowest_modes_are_those_of_a_potential():
    with pytest.raises(InputError, match="forces that have a potential"):
        column().modes(count=1)
    with pytest.raises(InputError, match="coordinates of bodies"):
        column().modes(count=1, coordinates="joint")
    alone = column("ground").modes(parameters={"load": 0.1}, count=1)
    # the load on the ground's axis has a potential: K = [[2 - P, -1], [-1, 1 - P]]
    mass, stiffness = np.array([[3.0, 1.0], [1.0, 1.0]]), np.array([[1.9, -1.0], [-1.0, 0.9]])
    squares = np.sort(np.linalg.eigvals(np.linalg.solve(mass, stiffness)).real)
    assert alone.omega_squared == pytest.approx(squares[:1], rel=1e-6)


@pytest.mark.slow
@pytest.mark.parametrize("gravity", [9.81, 0.0])
def test_sparse_equilibria_of_what_only_springs_hold(gravity):
    bodies = {n: {"type": "point", "mass": 1.0, "position": [0.0, y]} for n, y in (("first", -1.0), ("second", -2.0))}
    spring = {"type": "spring-damper", "stiffness": 100.0, "free_length": 1.0}
    forces = {
        "upper": {**spring, "between": ["ground", "first"], "at": [rods.GROUND2, "centre"]},
        "lower": {**spring, "between": ["first", "second"], "at": ["centre", "centre"]},
    }
    found = rods.model(bodies, {}, gravity=[0.0, -gravity], forces=forces).equilibrium(shape="looped")
    assert found.q["first.y"] == pytest.approx(-1.0 - 2.0 * gravity / 100.0, rel=1e-9)
    assert found.q["second.y"] == pytest.approx(-2.0 - 3.0 * gravity / 100.0, rel=1e-9)


@pytest.mark.slow
def test_a_run_that_an_event_ends_before_is_no_place():
    model = rods.mass_spring_damper(events={"out": {"when": "body.x > 0.31", "action": "stop"}})
    start = {"body.x": 0.3, "body.vx": 1.0}
    with pytest.raises(AnalysisError, match="is over at t = "):
        model.linearise(at=2.0, instantaneous=True, start=start)
    assert model.linearise(at=0.001, instantaneous=True, start=start).t == 0.001


@pytest.mark.parametrize(("until", "output_step"), [(1.0, 0.3), (1.0, 3.0), (1.2, 0.3)])
def test_kinematics_has_the_output_times_of_a_run(until, output_step):
    raw = copy.deepcopy(catalogue.raw("driven-four-bar"))
    raw["run"] = {"until": until, "output_step": output_step, "step": 0.01}
    model = rods.of_raw(raw)
    assert np.array_equal(model.kinematics().t, model.simulate().t)


@pytest.mark.parametrize("duplicate", [lambda r: pickle.loads(pickle.dumps(r)), copy.deepcopy], ids=["pickle", "copy"])
def test_prescribed_motions_travel(duplicate):
    model = symgen.load("driven-four-bar")
    for found in (model.kinematics([0.0, 0.1], transmission="C"), model.inverse(times=[0.0, 0.1])):
        again = duplicate(found)
        assert again.to_json() == found.to_json()
        for name, table in found.tables().items():
            np.testing.assert_array_equal(again.tables()[name].values, table.values)
        with pytest.raises(InputError, match="it has its tables only"):
            _ = again.forces


def test_single_settings_that_count_for_nothing_are_refused():
    model, driven = rods.mass_spring_damper(), symgen.load("driven-four-bar")
    for call, told in (
        (lambda: driven.kinematics(until=1.0), "kinematics: until: expected one of parameters, inputs, start"),
        (lambda: driven.inverse(times=[0.0], method="baumgarte"), "inverse: method: "),
        (lambda: model.equilibrium(rtol=1e-3), "equilibrium: rtol: "),
        (lambda: model.modes(until=1.0), "modes: until: "),
        (lambda: model.modes(max_attempts=10), "modes: max_attempts: "),
    ):
        with pytest.raises(InputError, match=told):
            call()
    assert model.equilibrium(Settings(rtol=1e-3)).stability == "stable"
    with pytest.raises(AnalysisError, match=r"the run to t = .* failed"):
        model.linearise(at=0.1, max_attempts=1, start={"body.vx": 1.0})


def orbit():
    bodies = {"arm": {"mass": 1.0, "inertia": 0.5}, "bob": {"mass": 1.0, "inertia": 1e-9, "position": [1.0, 0.0]}}
    slide = rods.pin("arm", "bob", "centre", "centre", "translational", axis=[1.0, 0.0])
    pull = {"type": "force", "body": "bob", "frame": "body", "force": ["-pull*slide.displacement**power", 0.0]}
    return rods.model(
        bodies,
        {"turn": rods.pin("ground", "arm", rods.GROUND2, "centre"), "slide": slide},
        gravity=[0.0, 0.0],
        parameters={"pull": 4.0, "power": 0.0},
        forces={"inward": pull},
    )


@pytest.mark.slow_cases("0.0-indifferent")
@pytest.mark.parametrize(("power", "stability"), [(0.0, "indifferent"), (-4.0, "unstable"), (1.5, "indifferent")])
def test_a_steady_motion_whose_speed_may_change_is_stable_or_not_with_its_momentum(power, stability):
    """Bob of 1 kg on an arm of I = 0.5 kg m^2 under F = 4 r^n N, on its circle of 1 m at 2 rad/s.

    At constant speed K = 4 n - 4; with L = (I + r^2) w kept K = 4 n - 4 + 4 w^2 / (I + 1), which decides. The speed may
    be another one for good: indifferent at best.
    """
    model = orbit()
    asked = {"start": {"arm.omega": 2.0}, "parameters": {"power": power}}
    found = model.steady(**asked)
    square = 4.0 * power - 4.0 + 16.0 / 1.5
    assert (square < 0.0) == (stability == "unstable")
    assert found.stability == stability
    assert np.abs(model.modes(at="steady", **asked).eigenvalues).max() == pytest.approx(abs(square) ** 0.5, rel=1e-6)


@pytest.mark.slow
def test_efforts_of_a_branch_tell_which_it_is():
    """Of other actuators than the drivers the notes of the motion were lost."""
    model = symgen.load("driven-four-bar")
    for actuators in ((), ("D",)):
        notes = model.inverse(times=[0.0, 0.1], actuators=actuators, start={"rocker.theta": -1.5}).notes
        assert sum("ways to close it are known" in note for note in notes) == 1


def pushed(**sections):
    rod = {"mass": 1.0, "inertia": 0.1, "points": {"pin": [-0.5, 0.0]}, "position": [0.5, 0.0]}
    drive = {"type": "torque", "body": "rod", "torque": "push*(1.0 + rod.theta)"}
    joints = {"A": rods.pin("ground", "rod", rods.GROUND2, "pin")}
    return rods.model({"rod": rod}, joints, inputs={"push": 0.0}, forces={"drive": drive}, **sections)


@pytest.mark.parametrize("coordinates", ["absolute", "joint"])
@pytest.mark.parametrize(("interpolation", "at", "push"), [("hold", 0.8, 5.0), ("hold", 0.2, 1.0), ("cubic", 0.8, 3.4)])
def test_a_linear_system_at_a_time_has_what_inputs_are_then(coordinates, interpolation, at, push):
    """Inputs that jump were those of the start, and smooth data had to go on to twice the time."""
    times = [0.0, 0.5, 1.0] if interpolation == "hold" else [0.0, 0.25, 0.5, 1.0]
    values = [1.0, 5.0, 0.0] if interpolation == "hold" else [1.0 + 3.0 * t for t in times]
    data = {"push": {"t": times, "u": values, "interpolation": interpolation}}
    model = pushed()
    found = model.linearise(at=at, instantaneous=True, inputs=data, coordinates=coordinates, states=["A.angle"])
    theta = found.about["A.angle"]
    # (I + m l^2 / 4) theta'' = push (1 + theta) - m g l / 2 cos(theta)
    assert found.A[1, 0] == pytest.approx((push + 9.81 * 0.5 * np.sin(theta)) / 0.35, rel=1e-9)


def test_analyses_take_the_end_of_any_run_as_their_start():
    """A run up to the end of the file was refused, as none could go on from there to the same end."""
    model = pushed(run={"until": 0.5})
    result = model.simulate()
    assert result.t[-1] == 0.5
    for shape in ("straight", "looped"):
        assert abs(np.cos(model.equilibrium(start=result, shape=shape).q["rod.theta"])) < 1e-9


def test_what_a_locus_varies_is_said_once():
    """An input that was given as well had its value at all places."""
    model = pushed()
    found = model.locus(("push", [0.0, 1.0]))
    assert abs(found.branches[1, 0] - found.branches[0, 0]) > 0.1
    for call, told in (
        (lambda: model.locus(("push", [0.0, 1.0]), inputs={"push": 5.0}), "one way of giving it a value"),
        (lambda: found.plot(5), "a path"),
        (lambda: model.equilibria(("rod.theta", 5.0)), "two values or more"),
        (lambda: model.equilibria(("rod.theta", None)), "two values or more"),
    ):
        with pytest.raises(InputError, match=told):
            call()

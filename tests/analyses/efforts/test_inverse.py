"""Efforts of prescribed and recorded motions against reference values, energy, virtual power, and forward runs."""

import json
import math

import numpy as np
import pytest

import symgen
from analyses import rods
from analyses.linkages import four_bar
from analyses.rods import of_raw as model
from symgen.base.errors import InputError
from symgen.cli import main

CRANK = "start + 2*pi*t"


@pytest.fixture(scope="module")
def linkage():
    """The four-bar of the reference: rods of 1, 3, 3 m and kg between pins 4 m apart, C above."""
    return model(four_bar((4.0, 1.0, 3.0, 3.0), math.pi / 3.0, CRANK, (1.0, 3.0, 3.0)))


@pytest.fixture(scope="module")
def pendulum():
    """A cart on a rail that an input pushes, with a rod on it that a damped spring holds."""
    bodies = {
        "cart": {"mass": 2.0, "inertia": 0.1},
        "rod": {"mass": 1.0, "inertia": 1.0 / 12.0, "points": {"top": [0.0, 0.5]}, "position": [0.0, -0.5]},
    }
    joints = {
        "rail": rods.pin("ground", "cart", rods.GROUND2, "centre", "prismatic", axis=[1.0, 0.0]),
        "pin": rods.pin("cart", "rod", "centre", "top"),
    }
    forces = {
        "pushed": {"type": "force", "body": "cart", "force": ["3*push - 0.2*cart.vx", 0.0]},
        "held": {"type": "torque", "body": "rod", "reaction": "cart", "torque": "-2*angle - 0.3*rate"},
    }
    return rods.model(bodies, joints, inputs={"push": {"default": 0.0, "unit": "N"}}, forces=forces)


# -- drivers -----------------------------------------------------------------------------------------------------------


@pytest.mark.slow
def test_torques_of_the_reference_four_bar(linkage):
    """Minimal coordinates in 30 digits, computed twice independently; the motor turns the crank from the ground."""
    found = linkage.inverse(times=[0.0, 0.25, 0.5])
    exact = np.array([59.97606377405662, -78.51449364663133, 5.415190647650141])
    assert np.abs(found.efforts["motor"] / exact - 1.0).max() < 1e-12
    assert found.efforts.units == ("N m",) and found.ok


def test_power_is_the_change_of_energy(linkage):
    nodes, weights = np.polynomial.legendre.leggauss(40)
    end = 0.4
    times = np.concatenate([[0.0], 0.5 * end * (nodes + 1.0), [end]])
    found = linkage.inverse(times=times)
    energy = linkage.kinematics(times).energy["total"]
    done = 0.5 * end * weights @ found.power["motor"][1:-1]
    assert abs(done - (energy[-1] - energy[0])) < 1e-12 * np.abs(energy).max()
    assert np.abs(found.rates["motor"] - 2.0 * math.pi).max() < 1e-13


def test_another_joint_exerts_the_same_power(linkage):
    times = np.linspace(0.0, 1.0, 21)
    motor = linkage.inverse(times=times)
    other = linkage.inverse(times=times, actuators=["D"])
    rocker = linkage.kinematics(times)["rocker.omega"]
    assert np.abs(other.rates["D"] - rocker).max() < 1e-12
    scale = np.abs(motor.power["motor"]).max()
    assert np.abs(other.efforts["D"] * rocker - motor.power["motor"]).max() < 1e-11 * scale
    assert other.missing.max() < 1e-9 and not other.notes


@pytest.mark.parametrize("weights", [{}, {"A": 1.0, "D": 3.0}])
def test_efforts_that_are_not_unique_are_the_smallest(linkage, weights):
    """Virtual power: A.effort omega_A + D.effort omega_D is what one motor needs, and sum (w effort)^2 is least."""
    times = np.linspace(0.0, 1.0, 21)
    needed = linkage.inverse(times=times).power["motor"]
    found = linkage.inverse(times=times, actuators=["A", "D"], weights=weights)
    a, d = (found.rates[name] / weights.get(name, 1.0) ** 2 for name in ("A", "D"))
    total = found.rates["A"] * a + found.rates["D"] * d
    for name, direction in (("A", a), ("D", d)):
        exact = needed * direction / total
        assert np.abs(found.efforts[name] - exact).max() < 1e-11 * np.abs(needed).max()
    how = "weighted as asked" if weights else "torques over the mechanism's length"
    assert found.notes == (f"2 actuators move 1 degree of freedom: efforts are those of minimum norm, {how}",)


@pytest.mark.slow
def test_reactions_with_another_actuator_balance_the_rods(linkage):
    """Newton for each rod: reactions and weight give its mass times the acceleration of its centre."""
    times = np.linspace(0.0, 0.9, 7)
    for actuators in ([], ["D"], ["A", "C"]):
        found = linkage.inverse(times=times, actuators=actuators)
        moved = linkage.kinematics(times)
        # reactions on the first bodies: ground, crank, coupler, ground
        on = {
            "crank": (("A", -1.0), ("B", 1.0)),
            "coupler": (("B", -1.0), ("C", 1.0)),
            "rocker": (("C", -1.0), ("D", -1.0)),
        }
        for (body, joints), mass in zip(on.items(), (1.0, 3.0, 3.0), strict=True):
            for axis, weight in (("x", 0.0), ("y", -9.81 * mass)):
                total = sum(sign * found.reactions[f"{joint}.F{axis}"] for joint, sign in joints) + weight
                assert np.abs(total - mass * moved[f"{body}.a{axis}"]).max() < 1e-9


# -- recorded runs -----------------------------------------------------------------------------------------------------


@pytest.mark.slow
def test_andrews_gives_its_torque_back():
    andrews = symgen.load("andrews")
    run = andrews.simulate(until=0.03, output_step=1e-3)
    found = andrews.inverse(run, actuators=["drive"])
    assert np.abs(found.efforts["drive"] / 0.033 - 1.0).max() < 1e-10
    assert np.abs(found.rates["drive"] - run["K1.omega"]).max() < 1e-10 * np.abs(run["K1.omega"]).max()
    for name in ("F.Fx", "A5.Fy"):
        assert np.abs(found.reactions[name] - run.reactions[name]).max() < 1e-10 * np.abs(run.reactions.values).max()


@pytest.mark.slow
def test_the_platform_gives_the_efforts_of_its_legs_back():
    platform = symgen.load("stewart-platform")
    run = platform.simulate(until=0.3, step=1e-3, output_step=0.05, shape="looped")
    found = platform.inverse(run, shape="looped")
    followed = platform.inverse(times=run.t, shape="looped")
    for i in range(1, 7):
        efforts = run[f"drive{i}.effort"]
        for other in (found, followed):
            assert np.abs(other.efforts[f"drive{i}"] - efforts).max() < 1e-10 * np.abs(efforts).max()


@pytest.mark.slow
def test_a_rotor_in_space_gives_its_torque_back():
    """On a pin across its axes of inertia, from more than a turn away: the torque is one of t and of its angle."""
    body = {"mass": 2.0, "inertia": [0.1, 0.2, 0.3], "centre_of_mass": [0.1, 0.0, 0.2]}
    joints = {"pin": rods.pin("ground", "rotor", rods.GROUND3, rods.GROUND3, axis=[0.0, 0.6, 0.8])}
    torque = {"type": "torque", "joint": "pin", "torque": "20*cos(t) - 0.5*angle - 0.1*rate"}
    rotor = rods.model({"rotor": body}, joints, "spatial", forces={"turned": torque})
    run = rotor.simulate(until=1.5, step=1e-3, output_step=0.1)
    assert np.abs(run["pin.angle"]).max() > 2.0 * math.pi
    exact = 20.0 * np.cos(run.t) - 0.5 * run["pin.angle"] - 0.1 * run["pin.angle.rate"]
    for actuator in ("turned", "pin"):
        found = rotor.inverse(run, actuators=[actuator])
        expected = exact if actuator == "turned" else 0.0
        assert np.abs(found.efforts[actuator] - expected).max() < 1e-10 * np.abs(exact).max()
        assert np.abs(found.rates[actuator] - run["pin.angle.rate"]).max() < 1e-10
        assert np.abs(found.reactions["pin.Fz"] - run.reactions["pin.Fz"]).max() < 1e-9


@pytest.mark.slow
def test_inputs_forces_and_joints_of_a_recorded_run(pendulum, tmp_path):
    pushed = "4*sin(3*t)"
    run = pendulum.simulate(until=1.0, step=1e-3, output_step=0.05, inputs={"push": pushed})
    exact = 4.0 * np.sin(3.0 * run.t)
    held = -2.0 * run["pin.angle"] - 0.3 * run["pin.angle.rate"]
    found = pendulum.inverse(run, actuators=["push", "held"])
    assert np.abs(found.efforts["push"] - exact).max() < 1e-11
    assert np.abs(found.efforts["held"] - held).max() < 1e-11
    assert found.efforts.units == ("N", "N m") and found.power.names == ("held",)
    # what joints exert then, with the forces there beside it
    found = pendulum.inverse(run, actuators=["rail", "pin"], inputs={"push": 0.0})
    assert np.abs(found.efforts["rail"] - 3.0 * exact).max() < 1e-11
    assert np.abs(found.efforts["pin"]).max() < 1e-11
    # from files
    for name in ("run.nc", "run.csv"):
        run.save(tmp_path / name)
        again = pendulum.inverse(tmp_path / name, actuators=["push", "held"])
        assert np.abs(again.efforts["push"] - exact).max() < 1e-11


@pytest.mark.slow
def test_a_motion_of_kinematics_comes_back_from_a_file(linkage, tmp_path, capsys):
    times = np.linspace(0.0, 0.5, 6)
    path = linkage.kinematics(times).save(tmp_path / "motion.csv")
    motor = linkage.inverse(times=times).efforts["motor"]
    again = linkage.inverse(path)
    assert np.abs(again.efforts["motor"] - motor).max() < 1e-10 * np.abs(motor).max()
    driven = symgen.load("driven-four-bar")
    run = driven.simulate(until=0.2, step=1e-3, output_step=0.1, parameters={"crank_speed": 3.0})
    run.save(tmp_path / "run.nc")
    assert main(["inverse", "driven-four-bar", "--from", str(tmp_path / "run.nc"), "--json"]) == 0
    found = json.loads(capsys.readouterr().out)
    assert found["parameters"]["crank_speed"] == 3.0
    assert np.allclose(found["efforts"]["motor"], run["motor.effort"], rtol=1e-10, atol=1e-9)


@pytest.mark.slow
def test_a_motion_that_the_actuators_cannot_give_is_said(pendulum):
    run = pendulum.simulate(until=0.5, step=1e-3, output_step=0.1, inputs={"push": "4*sin(3*t)"})
    found = pendulum.inverse(run, actuators=["held"], inputs={"push": 0.0})
    assert len(found.notes) == 1 and found.notes[0].startswith(
        "these actuators alone do not give the motion: at t = 0.5 s"
    )
    assert found.missing.max() > 0.1


@pytest.mark.slow
def test_data_of_a_recorded_motion_are_asked_for_again(pendulum):
    """Not taken for a formula, and not for the default: with the same data the spring is what it was."""
    t = np.linspace(0.0, 0.5, 6)
    data = {"t": t, "u": 3.0 * np.sin(4.0 * t), "interpolation": "cubic"}
    run = pendulum.simulate(until=0.5, step=1e-3, output_step=0.1, inputs={"push": data})
    with pytest.raises(InputError, match=r"input 'push': expected the data .* once more, .* got 6 samples \(cubic\)$"):
        pendulum.inverse(run, actuators=["held"])
    found = pendulum.inverse(run, actuators=["push"])
    assert np.abs(found.efforts["push"] - data["u"]).max() < 1e-9
    again = pendulum.inverse(run, actuators=["held"], inputs={"push": data})
    assert np.abs(again.efforts["held"] - run["held.torque"]).max() < 1e-9


@pytest.mark.by_turns(2)
@pytest.mark.slow
@pytest.mark.parametrize("push", ["4*abs(t - 0.23)", {"t": [0.0, 0.23, 0.5], "u": [0.92, 0.0, 1.08]}])
def test_inputs_with_kinks_are_what_they_are_at_each_time(pendulum, push):
    """Two straight lines, as a formula and as data; the same with a step is refused."""
    data = {**push, "interpolation": "linear"} if isinstance(push, dict) else push
    run = pendulum.simulate(until=0.5, rtol=1e-10, output_step=0.1, inputs={"push": data})
    found = pendulum.inverse(run, actuators=["held"], inputs={"push": data})
    assert np.abs(found.efforts["held"] - run["held.torque"]).max() < 1e-9
    assert np.abs(pendulum.inverse(run, actuators=["push"]).efforts["push"] - 4.0 * np.abs(run.t - 0.23)).max() < 1e-9
    stepped = {**push, "interpolation": "hold"} if isinstance(push, dict) else "1 if t > 0.23 else 0"
    with pytest.raises(InputError, match="inputs without jumps"):
        pendulum.inverse(run, actuators=["held"], inputs={"push": stepped})


@pytest.mark.slow_cases("times0", "times1")
@pytest.mark.parametrize("times", [[-0.5, -0.3], [0.1, 0.4], [0.7]])
def test_inputs_that_jump_beside_a_motion_are_what_they_are_in_it(times):
    """A cart of 2 kg with 0.4 m/s^2 by a driver: held at what was given from 0 on, and refused for jumps elsewhere."""
    joints = {
        "rail": rods.pin("ground", "cart", rods.GROUND2, "centre", "prismatic", axis=[1.0, 0.0]),
        "drive": {"type": "driver", "joint": "rail", "value": "0.2*t**2"},
    }
    pushed = {"type": "force", "body": "cart", "force": ["push", 0.0]}
    body = {"mass": 2.0, "inertia": 0.1}
    cart = rods.model({"cart": body}, joints, gravity=[0.0, 0.0], inputs={"push": 0.0}, forces={"pushed": pushed})

    def push(t):
        return 1.0 if t < -0.2 else 5.0 if t < 0.5 else 7.0

    steps = {"t": [-1.0, -0.2, 0.5], "u": [1.0, 5.0, 7.0], "interpolation": "hold"}
    for given in ("1 if t < -0.2 else (5 if t < 0.5 else 7)", steps):
        found = cart.inverse(times=times, actuators=["rail"], inputs={"push": given})
        assert np.abs(found.efforts["rail"] - [0.8 - push(t) for t in times]).max() < 1e-12
        with pytest.raises(InputError, match="inputs without jumps"):
            cart.inverse(times=[-0.6, *times, 0.8], actuators=["rail"], inputs={"push": given})
    before = cart.kinematics([-0.5, -0.1])
    late = {"t": [0.0, 0.4, 0.7, 1.0], "u": [0.0, 1.0, 0.5, 0.0], "interpolation": "cubic"}
    with pytest.raises(InputError, match=r"data from -0\.5 to"):
        cart.inverse(before, actuators=["rail"], inputs={"push": late})


@pytest.mark.slow
def test_a_motion_of_some_drivers_is_taken_from_a_run(linkage):
    """A double pendulum whose first rod is driven: the motor's torque is what the run reports."""
    raw = four_bar((4.0, 1.0, 3.0, 3.0), math.pi / 3.0, CRANK, (1.0, 3.0, 3.0))
    raw["joints"].pop("D")
    open_chain = model(raw)
    with pytest.raises(InputError, match=r"a driver for every freedom, got none for .*, "):
        open_chain.inverse(times=[0.0])
    run = open_chain.simulate(until=0.2, step=1e-4, output_step=0.02)
    found = open_chain.inverse(run)
    assert np.abs(found.efforts["motor"] - run["motor.effort"]).max() < 1e-10 * np.abs(run["motor.effort"]).max()


def test_an_effort_is_weighed_by_the_name_that_it_is_asked_for_by():
    """A force along one axis has one effort, which is asked for with its axis or without."""
    lift = {"type": "force", "body": "block", "at": [0.0, 0.0], "force": [0.0, 2.0]}
    joints = {
        "rail": rods.pin("ground", "block", rods.GROUND2, rods.GROUND2, "translational", axis=[0.0, 1.0]),
        "motor": {"type": "driver", "joint": "rail", "value": "t**2"},
    }
    raised = rods.model({"block": {"mass": 1.0, "inertia": 1.0}}, joints, forces={"left": lift, "right": lift})
    for names in (("left.y", "right.y"), ("left", "right"), ("left.y", "right")):
        found = raised.inverse(times=[0.0], actuators=names, weights={names[0]: 2.0})
        assert found.efforts.names == names
        np.testing.assert_allclose(found.efforts.values[0], [11.81 / 5.0, 11.81 * 4.0 / 5.0], rtol=1e-12)
    with pytest.raises(InputError, match="each name once"):
        raised.inverse(times=[0.0], actuators=["left", "left.y"])


# -- words -------------------------------------------------------------------------------------------------------------


def test_bad_arguments_are_refused(linkage, pendulum):
    run = pendulum.simulate(until=0.01, step=1e-3)
    cases = [
        (lambda: pendulum.inverse(run), "names of what exerts the motion, got none"),
        (lambda: pendulum.inverse(run, actuators=["pins"]), "did you mean 'pin'"),
        (lambda: pendulum.inverse(run, actuators=["pin", "pin"]), "each name once"),
        (lambda: linkage.inverse(times=[0.0], actuators=["motor", "A"]), "'motor' and 'A', which are one"),
        (lambda: linkage.inverse(times=[0.0], actuators=["A", "A.angle"]), r"'A' and 'A\.angle', which are one"),
        (lambda: pendulum.inverse(run, actuators=["pin.x"]), "a coordinate of pin"),
        (lambda: pendulum.inverse(run, actuators=["pin"], weights={"rail": 1.0}), "weights"),
        (lambda: pendulum.inverse(run, actuators=["pin"], times=[0.0]), "times of the motion"),
        (lambda: linkage.inverse(run), "no column 'crank.x'"),
        (lambda: linkage.inverse(3), "a result of a run"),
        (lambda: linkage.inverse("nowhere.nc"), "which is none"),
    ]
    for call, match in cases:
        with pytest.raises(InputError, match=match):
            call()


@pytest.mark.slow
def test_the_command(tmp_path, capsys):
    words = ["inverse", "driven-four-bar", "--times", "lin(0,1,5)", "--json"]
    assert main([*words, "--save", str(tmp_path / "i.csv"), "--plot", str(tmp_path / "i.svg")]) == 0
    found = json.loads(capsys.readouterr().out)
    assert found["t"] == [0.0, 0.25, 0.5, 0.75, 1.0] and set(found["efforts"]) == {"motor"}
    assert found["units"] == {"motor": "N m"} and found["not_unique"] == [] and found["notes"] == []
    assert set(found["summary"]["motor"]) == {"unit", "max", "at", "rms", "peak_power", "energy"}
    assert found["summary"]["motor"]["max"] == max(map(abs, found["efforts"]["motor"]))
    header = (tmp_path / "i.csv").read_text().splitlines()[0]
    assert header.startswith("t [s],motor.effort [N m],motor.power [W],motor.rate [rad/s]")
    assert main(["inverse", "driven-four-bar", "--actuators", "A,D", "--weight", "D=2"]) == 0
    assert "minimum norm, weighted as asked" in capsys.readouterr().err


@pytest.mark.slow
def test_too_few_times_for_integrals_are_said(linkage, capsys):
    """Where it is said the energy is off by tenths, and elsewhere by no more than a hundredth of the work exchanged."""
    fine = linkage.inverse(times=np.linspace(0.0, 0.9, 2001))
    exchanged = np.trapezoid(np.abs(fine.power["motor"]), fine.t)

    def off(found):
        return abs(found.summary()["motor"]["energy"] - fine.summary()["motor"]["energy"]) / exchanged

    few, many = (linkage.inverse(times=np.linspace(0.0, 0.9, n)) for n in (5, 101))
    assert "integrals are over 5 times, and every second of these" in few.too_few() and off(few) > 0.05
    assert many.too_few() == "" and off(many) < 0.01
    assert linkage.inverse(times=[0.3]).too_few() == ""
    assert main(["inverse", "driven-four-bar", "--times", "lin(0,1,5)"]) == 0
    assert few.too_few()[:30] in capsys.readouterr().err
    assert main(["inverse", "driven-four-bar", "--times", "lin(0,1,101)"]) == 0
    assert "integrals" not in capsys.readouterr().err


@pytest.mark.slow
def test_a_driver_that_repeats_another_exerts_nothing_beside_it(tmp_path):
    """M = I theta'' + m g x; runs' elements, files, sweeps, kinematics and inverse dynamics gave a KeyError."""
    rod = {"mass": 2.0, "inertia": 0.3, "position": [0.5, 0.0], "angle": 0.2, "angular_velocity": 0.7}
    joints = {
        "pin": rods.pin("ground", "rod", rods.GROUND2, [-0.5, 0.0]),
        "motor": {"type": "driver", "joint": "pin", "coordinate": "angle", "value": "0.2 + 0.7*t + 0.5*t**2"},
    }
    joints["twin"] = dict(joints["motor"])
    model = rods.model({"rod": rod}, joints)
    times = np.array([0.0, 0.1, 0.2])
    needed = 0.3 + 2.0 * 0.25 + 2.0 * rods.GRAVITY * 0.5 * np.cos(0.2 + 0.7 * times + 0.5 * times**2)
    asked = {"until": 0.2, "step": 0.01, "times": times}
    run, moved, inverse = model.simulate(**asked), model.kinematics(times), model.inverse(times=times)
    for found in (run.elements, moved.elements):
        np.testing.assert_allclose(found["motor.effort"], needed, rtol=1e-6)
        np.testing.assert_allclose(found["motor.power"], needed * (0.7 + times), rtol=1e-6)
        assert not found["twin.effort"].any() and not found["twin.power"].any()
    for found in (moved, inverse):
        np.testing.assert_allclose(found.efforts["motor"], needed, rtol=1e-9)
        assert found.efforts.units == ("N m", "N m") and not found.efforts["twin"].any()
        assert found.non_unique_reactions == ("motor", "twin")
    swept = symgen.sweep(model, {"rod.omega": [0.7]}, **asked, quantities=["elements"])
    np.testing.assert_allclose(swept["motor.effort"][0], needed, rtol=1e-6)
    assert not swept["twin.power"].any() and run.save(tmp_path / "run.csv").exists()


def test_a_turn_gives_back_what_it_takes():
    """Without losses the energy over a turn is 0: what is left of the sum is no value."""
    whole = symgen.load("driven-four-bar").inverse(times=np.linspace(0.0, 1.0, 361))
    assert whole.summary()["motor"]["energy"] == 0.0
    part = symgen.load("driven-four-bar").inverse(times=np.linspace(0.0, 0.3, 181))
    assert part.summary()["motor"]["energy"] == pytest.approx(np.trapezoid(part.power["motor"], part.t))

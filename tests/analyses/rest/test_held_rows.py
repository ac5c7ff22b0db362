"""States that friction holds at rest, in analyses at the start: as in a run, which stays there for ever."""

import math
import tomllib

import numpy as np
import pytest
from numpy.testing import assert_allclose

import symgen
from symgen.base.errors import InputError, SymgenError
from symgen.describe.files.validate import validate

STIFFNESS, INERTIA = 40.0, 0.2


def worm(efficiency, load=2.0):
    """A wheel under a load on a worm, with a disc on a spring on the wheel, which swings if the wheel stands."""
    builder = symgen.MechanismBuilder("worm").parameter("load", load, unit="N m")
    for i, (name, inertia) in enumerate((("m", 0.3), ("w", 0.5), ("disc", INERTIA))):
        builder.body(name, mass=1.0, inertia=inertia, position=(0.3 * min(i, 1), 0.0))
        builder.joint(f"axle_{name}", "revolute", between=("ground", name), at=((0.3 * min(i, 1), 0.0), "centre"))
    builder.joint("mesh", "gear", between=("m", "w"), radii=(0.1, 0.2), efficiency=efficiency)
    builder.force("weight", "torque", body="w", torque="load")
    builder.force("spring", "torsional-spring-damper", between=("w", "disc"), stiffness=STIFFNESS)
    return symgen.load(builder.build())


@pytest.mark.slow
@pytest.mark.parametrize("coordinates", ["absolute", "joint"])
def test_a_self_locking_worm_is_at_rest_in_analyses_as_in_a_run(coordinates):
    """'m.omega' changed at a rate of 9.6 there, as losses were left out; the run stays at rest."""
    model = worm([0.4, -0.5])
    run = model.simulate(until=0.5, coordinates=coordinates)
    assert run.status == "ok" and np.abs(run["w.theta"]).max() < 1e-12
    for analysis in (model.linearise, model.modes):
        found = analysis(at="start", coordinates=coordinates)
        values = found.eigenvalues() if callable(found.eigenvalues) else found.eigenvalues
        assert_allclose(sorted(values.imag), np.array([-1.0, 1.0]) * math.sqrt(STIFFNESS / INERTIA), rtol=1e-9)
        assert any("at rest, held as rows: mesh" in note for note in found.notes), found.notes


def test_a_worm_that_gives_way_is_not_at_rest():
    """With an efficiency of 0.6 backwards the load drives."""
    model = worm([0.8, 0.6])
    assert np.abs(model.simulate(until=0.1)["w.theta"]).max() > 1e-3
    with pytest.raises(InputError, match="expected a state of rest"):
        model.linearise(at="start")


def test_friction_of_a_joint_holds_a_pendulum_up_to_its_bound():
    """m g l cos(angle) = 1 * 9.81 * 0.5 * cos(0.3) = 4.686 N m: held by 4.7, and not by 4.6."""
    for bound, rests in ((4.7, True), (4.6, False)):
        builder = symgen.MechanismBuilder("rod", gravity=(0.0, -9.81))
        builder.body("rod", mass=1.0, inertia=0.1, position=(0.5 * math.cos(0.3), 0.5 * math.sin(0.3)), angle=0.3)
        friction = {"sliding": 0.9 * bound, "static": bound}
        builder.joint("pin", "revolute", between=("ground", "rod"), at=((0.0, 0.0), (-0.5, 0.0)), friction=friction)
        model = symgen.load(builder.build())
        assert bool(np.abs(model.simulate(until=0.2)["rod.omega"]).max() < 1e-9) == rests
        if rests:
            assert model.modes(at="start").degrees_of_freedom == 0
        else:
            with pytest.raises(InputError, match="expected a state of rest"):
                model.modes(at="start")


def swinging(builder, on):
    """Add a disc on a spring on a body, which swings at `FREQUENCY` where the body stands."""
    builder.body("disc", mass=1.0, inertia=INERTIA, position=(5.0, 0.0))
    builder.joint("axle_disc", "revolute", between=("ground", "disc"), at=((5.0, 0.0), "centre"))
    builder.force("spring", "torsional-spring-damper", between=(on, "disc"), stiffness=STIFFNESS)
    return symgen.load(builder.build())


def assert_held(model, rests, named, coordinates="absolute"):
    """It rests in a run as in analyses, in which only the disc swings; or it moves in both."""
    run = model.simulate(until=0.05, coordinates=coordinates)
    moved = max(np.abs(run[f"{body}.{x}"] - run[f"{body}.{x}"][0]).max() for body in ("arm",) for x in ("x", "theta"))
    assert bool(moved < 1e-9) == rests
    if not rests:
        with pytest.raises(SymgenError, match=r"expected a state of rest|start with it open"):
            model.modes(at="start", coordinates=coordinates)
        return
    found = model.modes(at="start", coordinates=coordinates)
    assert_allclose(sorted(found.eigenvalues.imag), np.array([-1.0, 1.0]) * math.sqrt(STIFFNESS / INERTIA), rtol=1e-9)
    assert any(f"at rest, held as rows: {named}" in note for note in found.notes), found.notes


@pytest.mark.parametrize(("factor", "rests"), [(1.02, True), (0.98, False)])
def test_a_pin_holds_an_arm_by_its_own_reaction(factor, rests):
    """Its weight goes through the pin: the arm rests where its centre is above the circle of friction."""
    away = 0.04
    builder = symgen.MechanismBuilder("arm", gravity=(0.0, -9.81))
    place = away, 0.3
    builder.body("arm", mass=2.0, inertia=0.1, position=place)
    friction = {"coefficient": 0.5, "radius": 2.0 * away * factor}
    pin = builder.joint("pin", "revolute", between=("ground", "arm"), at=((0.0, 0.0), (-away, -0.3)), friction=friction)
    assert_held(swinging(pin, "arm"), rests, "pin")


@pytest.mark.parametrize(("pull", "rests"), [(3.9, True), (4.1, False), (-1.9, True), (-2.1, False)])
def test_bounds_of_two_directions_hold_by_the_one_that_is_pulled_against(pull, rests):
    builder = symgen.MechanismBuilder("block").body("arm", mass=2.0, inertia=0.1)
    friction = {"sliding": {"forwards": 3.0, "backwards": 1.0}, "static": {"forwards": 4.0, "backwards": 2.0}}
    at, axis = ((0.0, 0.0), "centre"), (1.0, 0.0)
    builder.joint("rail", "translational", between=("ground", "arm"), at=at, axis=axis, friction=friction)
    builder.force("pull", "force", body="arm", force=(pull, 0.0))
    assert_held(swinging(builder, "arm"), rests, "rail")


@pytest.mark.parametrize(("torque", "rests"), [(1.98, True), (2.02, False)])
def test_two_shafts_hold_together_what_neither_would_hold(torque, rests):
    """1 N m on the arm's own shaft and 0.5 N m on one that turns twice as fast."""
    builder = symgen.MechanismBuilder("shafts")
    for name, x, bound in (("arm", 0.0, 1.0), ("fast", 0.3, 0.5)):
        builder.body(name, mass=1.0, inertia=0.1, position=(x, 0.0))
        at, friction = ((x, 0.0), "centre"), {"sliding": bound}
        builder.joint(f"axle_{name}", "revolute", between=("ground", name), at=at, friction=friction)
    builder.joint("mesh", "gear", between=("arm", "fast"), radii=(0.2, 0.1))
    builder.force("load", "torque", body="arm", torque=torque)
    assert_held(swinging(builder, "arm"), rests, "axle_arm, axle_fast")


@pytest.mark.parametrize(("torque", "rests"), [(0.45, True), (0.55, False)])
def test_friction_holds_an_arm_on_a_stop_that_does_not_push(torque, rests):
    """An arm on its stop is lifted up to the friction of its pin."""
    builder = symgen.MechanismBuilder("lever")
    builder.body("arm", mass=1.0, inertia=0.1)
    friction, stop = {"sliding": 0.5}, {"lower": 0.0}
    at = (0.0, 0.0), "centre"
    builder.joint("pin", "revolute", between=("ground", "arm"), at=at, friction=friction, stop=stop)
    builder.force("load", "torque", body="arm", torque=torque)
    assert_held(swinging(builder, "arm"), rests, "pin")


@pytest.mark.parametrize(("pull", "rests"), [(11.5, True), (12.5, False)])
def test_a_contact_and_a_clamp_hold_a_plank_together(pull, rests):
    """Its feet carry 20 N with a coefficient of 0.5, and a clamp has 2 N of its own: 12 N in all."""
    text = f"""
[mechanism]
name = "plank"
gravity = [0.0, -10.0]
[bodies.arm]
mass = 2.0
inertia = 0.1
position = [0.0, 0.1]
[bodies.shoe]
mass = 0.5
inertia = 0.1
position = [3.0, 0.0]
[contacts.left]
between = [{{ body = "arm", at = [-0.3, -0.1] }}, {{ line = "ground" }}]
friction = 0.5
[contacts.right]
between = [{{ body = "arm", at = [0.3, -0.1] }}, {{ line = "ground" }}]
friction = 0.5
[joints.clamp]
type = "translational"
between = ["ground", "shoe"]
at = [[3.0, 0.0], "centre"]
axis = [1.0, 0.0]
friction = {{ sliding = 2.0 }}
[joints.rod]
type = "distance"
between = ["shoe", "arm"]
at = ["centre", [0.0, -0.1]]
length = 3.0
[forces.pull]
type = "force"
body = "shoe"
force = [{pull}, 0.0]
"""
    model = symgen.load(validate(tomllib.loads(text), "plank.toml"))
    assert bool(np.abs(model.simulate(until=0.05)["arm.vx"]).max() < 1e-9) == rests
    if rests:
        assert model.modes(at="start").degrees_of_freedom == 0
    else:
        with pytest.raises(SymgenError, match=r"expected a state of rest|slides there"):
            model.modes(at="start")

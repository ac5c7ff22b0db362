"""Sensitivities to numbers of a file, by their paths: against closed forms and the same numbers as parameters."""

import math
import pickle

import numpy as np
import pytest

import symgen
from symgen import InputError
from symgen.api import Model
from symgen.describe.facts.digest import digest
from symgen.describe.facts.lifted import lift_numbers
from symgen.describe.files.origins import origin_of
from tests.run.directions.lengths import FOUR_BAR, ROD, ROD_BY, ROD_STATE, model

TIGHT = {"rtol": 1e-13, "atol": 1e-13, "integrator": "dop853"}
NUMBERS = ("bodies.rod.inertia", "bodies.rod.points.pin[0]", "mechanism.gravity[1]", "bodies.rod.mass")


@pytest.fixture(scope="module")
def rod(tmp_path_factory):
    """The rod on a pin with its numbers written out."""
    text = ROD
    for formula, value in (
        ('"length**2/12"', 1.0 / 12.0),
        ('"-length/2"', -0.5),
        ('"-g"', -9.81),
        ('"length/2*sin(angle)"', 0.5 * math.sin(1.0)),
        ('"-length/2*cos(angle)"', -0.5 * math.cos(1.0)),
        ('"angle - pi/2"', 1.0 - math.pi / 2.0),
    ):
        text = text.replace(formula, repr(value))
    return model(tmp_path_factory.mktemp("rod"), text)


def by_length(by):
    """Return the derivative by the length, on which inertia and pin depend."""
    return by["bodies.rod.inertia"] / 6.0 - by["bodies.rod.points.pin[0]"] / 2.0


@pytest.mark.parametrize("coordinates", ["absolute", "joint"])
def test_the_rod_on_a_pin(rod, coordinates):
    run = rod.simulate(until=3.0, times=[3.0], sensitivities=NUMBERS, coordinates=coordinates, **TIGHT)
    assert run.v.row()["rod.omega"] == pytest.approx(ROD_STATE[1], rel=1e-11)
    for place, quantity in enumerate(("rod.theta", "rod.omega")):
        by = run.gradient(quantity).row()
        assert by_length(by) == pytest.approx(ROD_BY["length"][place], rel=1e-10)
        assert -by["mechanism.gravity[1]"] == pytest.approx(ROD_BY["g"][place], rel=1e-11)
        # the motion depends on the inertia over the mass
        assert by["bodies.rod.mass"] == pytest.approx(-by["bodies.rod.inertia"] / 12.0, rel=1e-9)
    assert run.gradient("rod.theta").units == ("rad/(kg m^2)", "rad/m", "rad/(m/s^2)", "rad/kg")


@pytest.mark.slow
def test_a_number_is_the_parameter_in_its_place(tmp_path):
    text = FOUR_BAR.replace('mass = "m2"', "mass = 8.0").replace('at = [["d", 0.0], "D"]', 'at = [[10.0, 0.0], "D"]')
    settings = {"until": 0.5, "times": [0.5], "integrator": "rk4", "step": 1e-2}
    one = model(tmp_path, text).simulate(sensitivities=("bodies.coupler.mass", "joints.D.at[0][0]"), **settings)
    text = text.replace("mass = 8.0", 'mass = "own"').replace("g = {", "own = 8.0\ng = {")
    other = model(tmp_path, text.replace("[[10.0, 0.0]", '[["d", 0.0]')).simulate(
        sensitivities=("own", "d"), **settings
    )
    for quantity in ("crank.theta", "rocker.omega", "coupler.ax"):
        assert [*one.gradient(quantity).row().values()] == pytest.approx(
            [*other.gradient(quantity).row().values()], rel=1e-11
        )


def test_only_numbers_that_are_named_become_parameters(rod):
    nothing = lift_numbers("here", rod.mechanism, ("rod.omega",))
    assert nothing.mechanism is rod.mechanism
    before = digest(rod.mechanism)
    own = lift_numbers("here", rod.mechanism, ("bodies.rod.mass",))
    assert [p.name for p in own.mechanism.parameters if p.name not in rod.parameters()] == ["bodies_rod_mass"]
    assert digest(rod.mechanism) == before != digest(own.mechanism)
    assert {**own.keys} == {"bodies.rod.mass": "bodies_rod_mass"}


def test_units_of_numbers_of_joints_and_forces(tmp_path):
    spring = """
[forces.spring]
type = "torsional-spring-damper"
between = ["ground", "rod"]
stiffness = 2.0
damping = 0.1
free_angle = 0.2
[forces.rope]
type = "spring-damper"
between = ["ground", "rod"]
at = [[2.0, 0.0], "pin"]
stiffness = 3.0
"""
    units = {
        "forces.spring.stiffness": "N m/rad",
        "forces.spring.damping": "N m s/rad",
        "forces.spring.free_angle": "rad",
        "forces.rope.stiffness": "N/m",
        "forces.rope.at[0][0]": "m",
        "joints.pin.at[0][1]": "m",
        "bodies.rod.mass": "kg",
        "mechanism.gravity[0]": "m/s^2",
    }
    run = model(tmp_path, ROD + spring).simulate(until=0.1, sensitivities=tuple(units), integrator="rk4", step=0.05)
    assert dict(zip(run.sensitivities.names, run.sensitivities.units, strict=True)) == units


def test_numbers_of_tables_that_a_description_has_twice():
    # both couplers of this module have the same list, and a parameter is in the place of one number
    model, path = symgen.load("n-four-bar:2"), "bodies.coupler1.points.B[0]"
    own = lift_numbers("here", model.mechanism, (path,))
    bodies = origin_of(own.mechanism).raw["bodies"]
    points = [bodies[name]["points"]["B"][0] for name in ("coupler0", "vertical1", "coupler1")]
    assert points == [0.5, 0.5, "bodies_coupler1_points_B_0"]
    assert origin_of(model.mechanism).raw["bodies"]["coupler1"]["points"]["B"][0] == 0.5


@pytest.mark.slow
def test_quantities_at_the_end_and_fits(rod):
    found = rod.gradient("rod.omega", by=NUMBERS, until=3.0, **TIGHT)
    assert by_length(found.by) == pytest.approx(ROD_BY["length"][1], rel=1e-10)
    swing = rod.objective("rod.theta", by={"bodies.rod.points.pin[0]": (-1.0, None)}, until=1.0)
    assert swing.x0.tolist() == [-0.5]
    again = Model(swing.mechanism).simulate(swing.settings_at([-0.6]))
    assert again["rod.theta"][-1] == pytest.approx(swing([-0.6])[0], abs=1e-7)

    t = np.linspace(0.1, 2.0, 20)
    data = {"t": t, "rod.theta": rod.simulate(times=t, **TIGHT)["rod.theta"]}
    heavier = Model(lift_numbers("here", rod.mechanism, ("bodies.rod.inertia",)).mechanism)
    fit = heavier.identify(data, free=("bodies_rod_inertia",), parameters={"bodies_rod_inertia": 0.1})
    assert fit.parameters["bodies_rod_inertia"] == pytest.approx(1.0 / 12.0, rel=1e-7)
    same = rod.identify(data, free=("bodies.rod.inertia",))
    assert same.parameters == pytest.approx({"bodies.rod.inertia": 1.0 / 12.0}, rel=1e-9)


@pytest.mark.parametrize(
    ("names", "expected"),
    [
        ("bodies.rod.maas", "the path of a number in .*, got 'bodies.rod.maas'; did you mean 'bodies.rod.mass'"),
        ("bodies.rod.points.pin[2]", r"did you mean 'bodies.rod.points.pin\[[01]\]'"),
        ("bodies.rod.hold", "which is 'angle'; take the parameters in it"),
        ("bodies.rod.points.pin[99999999999999999999]", "got 'bodies.rod.points.pin"),
        (("bodies.rod.mass", "bodies.rod.mass"), "each number once, got 'bodies.rod.mass' twice"),
        ("joints.pin.at[0][0]['", "the path of a number"),
    ],
)
def test_other_paths_are_refused(rod, names, expected):
    with pytest.raises(InputError, match=expected):
        rod.simulate(until=0.1, sensitivities=names)


def test_whole_numbers_and_zero_are_refused(tmp_path):
    text = ROD.replace("[joints.pin]", "[bodies.light]\nmass = 0.0\ninertia = 0.0\n[joints.pin]")
    with pytest.raises(InputError, match=r"got 'bodies.light.mass', whose place takes a value above 0"):
        model(tmp_path, text).simulate(sensitivities="bodies.light.mass")
    with pytest.raises(InputError, match=r"got 'beams\.rod\.elements', whose place takes a number of elements"):
        symgen.simulate("cantilever", sensitivities="beams.rod.elements")


@pytest.mark.slow
def test_axes(tmp_path):
    text = """
[mechanism]
name = "chute"
gravity = [0.0, -9.81]
[bodies.block]
mass = 1.0
inertia = 1.0
[joints.chute]
type = "translational"
between = ["ground", "block"]
at = [[0.0, 0.0], [0.0, 0.0]]
axis = [4.0, -3.0]
"""
    run = model(tmp_path, text).simulate(until=1.0, sensitivities=("joints.chute.axis[0]", "joints.chute.axis[1]"))
    # x = g t^2/2 sin(a) cos(a), where tan(a) = -axis[1]/axis[0]
    x, y = 4.0, -3.0
    by = [-9.81 / 2.0 * (y / 25.0 - 2.0 * x * x * y / 625.0), -9.81 / 2.0 * (x / 25.0 - 2.0 * x * y * y / 625.0)]
    assert [*run.gradient("block.x").row().values()] == pytest.approx(by, rel=1e-8)
    with pytest.raises(InputError, match="expected a direction, got a vector of length 0"):
        model(tmp_path, text.replace("[4.0, -3.0]", "[0.0, 0.0]")).simulate(sensitivities="joints.chute.axis[0]")


def test_files_that_are_not_at_hand_are_refused(rod):
    with pytest.raises(InputError, match=r"not at hand, got 'bodies\.rod\.mass'; load the file again"):
        Model(pickle.loads(pickle.dumps(rod.mechanism))).simulate(sensitivities="bodies.rod.mass")

"""Where the origin lies, and how long a mechanism is, decides nothing."""

import tomllib

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.special import ellipj
from support.emitted import mechanism_of

import symgen
from run.layout.test_scales import in_units, of_catalogue
from symgen.base.errors import AssemblyError
from symgen.derive.methods import METHODS
from symgen.describe.facts.lengths import origin_of_sizes
from symgen.describe.formulas.evaluate import parameter_values, scalar_values
from symgen.run.integrators import INTEGRATORS
from symgen.run.layout import abi
from symgen.run.starts.start_words import StartChange, _from_to

#: sin(pi) in double precision: a place that is 0 but for rounding.
NEARLY_ZERO = 1.2246467991473532e-16
MECHANISMS = ["pendulum", "four-bar", "slider-crank", "spherical-double-pendulum", "heavy-top", "spatial-slider-crank"]
GRAVITY = 9.81


def planar(**body):
    return symgen.MechanismBuilder("q", gravity=(0.0, -GRAVITY)).body("m", type="point", mass=1.0, **body)


def pendulum(start):
    """Return a pendulum of 1 m that starts level with its pivot at (1, 0)."""
    rod = {"between": ("ground", "m"), "at": ((1.0, 0.0), "centre"), "length": 1.0}
    return planar(position=(0.0, start)).joint("rod", "distance", **rod).build()


def wire(start):
    """Return a bead on a wire that the file describes by a formula."""
    return planar(position=(start, 0.0)).joint("wire", "rows", rows=[{"position": "m.y - m.x**2 + 0.5*m.x"}]).build()


def slot(start, through):
    """Return a bead in a straight slot through a point, inclined by 45 degrees."""
    ends = {"between": ("m", "ground"), "at": ("centre", through), "axis": (1.0, 1.0)}
    return planar(position=(start, start)).joint("slot", "pin-in-slot", **ends).build()


def swung(t):
    """Return where a pendulum of 1 m is that was released level with its pivot at (1, 0)."""
    _, cn, dn, _ = ellipj(np.sqrt(GRAVITY) * t, 0.5)
    angle = 2.0 * np.arcsin(np.sqrt(0.5) * cn / dn)
    return [1.0 - np.sin(angle), -np.cos(angle)]


def slid(t):
    """Return where a bead on the wire is, from its equation of motion in x."""

    def rate(_, z):
        x, speed = z
        slope = 2.0 * x - 0.5
        return [speed, -slope * (2.0 * speed * speed + GRAVITY) / (1.0 + slope * slope)]

    x = solve_ivp(rate, (0.0, t), [0.0, 0.0], rtol=1e-12, atol=1e-13).y[0, -1]
    return [x, x * x - 0.5 * x]


CASES = {
    "at sin(pi)": (lambda: pendulum(NEARLY_ZERO), lambda: swung(1.0)),
    "1 nm below": (lambda: pendulum(-1e-9), lambda: swung(1.0)),
    "on a wire": (lambda: wire(NEARLY_ZERO), lambda: slid(1.0)),
    "in a slot": (lambda: slot(NEARLY_ZERO, (5.0, 5.0)), lambda: [-GRAVITY / 4.0] * 2),
    "at its slot's point": (lambda: slot(NEARLY_ZERO, (0.0, 0.0)), lambda: [-GRAVITY / 4.0] * 2),
}


@pytest.mark.by_turns(4)
@pytest.mark.fast("half-explicit-joint", "symplectic-euler-joint", "trapezoidal-joint")
@pytest.mark.parametrize("coordinates", ["absolute", "joint"])
@pytest.mark.parametrize("integrator", list(INTEGRATORS))
def test_point_masses_that_start_near_the_origin(integrator, coordinates):
    """The largest coordinate at the start, 1e-16 m, was taken for the length of the mechanism: the runs failed."""
    forms = set(INTEGRATORS.get(integrator, "integrator").forms)
    method = next(m for m in ("direct-correction", *METHODS) if forms & set(METHODS.get(m, "method").forms))
    order = 1 if "euler" in integrator else 2
    for name, (mechanism, expected) in CASES.items():
        if coordinates == "joint" and name == "on a wire":
            continue  # a formula ties no body to another: there is no joint coordinate
        model = symgen.load(mechanism())
        result = model.simulate(until=1.0, method=method, integrator=integrator, coordinates=coordinates, verify=False)
        assert result.status == "ok", (name, result.reason)
        # the default step of 1 ms, with a generous constant of a motion in 1 s
        np.testing.assert_allclose(np.asarray(result.q)[-1], expected(), atol=20.0 * 1e-3**order, err_msg=name)


def test_analyses_near_the_origin():
    rod = {"between": ("ground", "bob"), "at": (("length", 0.0), "centre"), "length": "length"}
    place = ("length + length*cos(angle)", "length*sin(angle)")
    builder = symgen.MechanismBuilder("q", gravity=(0.0, -GRAVITY)).parameter("length", 1.0).parameter("angle", "pi")
    builder.body("bob", type="point", mass=1.0, position=place).joint("rod", "distance", **rod)
    model = symgen.load(builder.build())
    at_rest = model.equilibrium()
    assert at_rest.stability == "stable"
    np.testing.assert_allclose([at_rest.q["bob.x"], at_rest.q["bob.y"]], [1.0, -1.0], atol=1e-9)
    np.testing.assert_allclose(np.sort(model.modes().eigenvalues.imag), [-np.sqrt(GRAVITY), np.sqrt(GRAVITY)])
    swept = model.sweep(vary={"angle": [3.0, np.pi]}, until=1.0)
    assert list(swept.status) == ["ok", "ok"]


def shifted(text, by):
    """Return a file's content with everything that has a place moved."""
    raw = tomllib.loads(text)

    def moved(point):
        return [f"({x}) + {float(d)!r}" for x, d in zip(point, by, strict=False)]

    for body in raw["bodies"].values():
        body["position"] = moved(body.get("position", [0.0] * len(by)))
    for joint in raw["joints"].values():
        for i, name in enumerate(joint.get("between", ())):
            if name == "ground" and "at" in joint:
                joint["at"][i] = moved(joint["at"][i])
    return raw


def length_of(result):
    return float(result.outcome.w[abi.LENGTH])


def check_like(here, there):
    """Two runs decide alike: by their status, their rank, and the number of their steps."""
    assert here.status == there.status == "ok", (here.reason, there.reason)
    assert here.rank.rank == there.rank.rank
    assert abs(there.steps - here.steps) <= 0.1 * here.steps


@pytest.mark.by_turns(3)
@pytest.mark.slow
@pytest.mark.parametrize("name", MECHANISMS)
def test_shifted_mechanisms(name):
    """Positions are measured from a place of the mechanism: no step depends on where the origin lies.

    1e6 lengths away double precision resolves 1e-10 of a length, the default absolute tolerance: decisions stay, the
    number of steps may not. Rounding of positions changes it by some per cent, the largest coordinate as a scale by
    far more.
    """
    text = of_catalogue(name)
    spatial = tomllib.loads(text)["mechanism"].get("space") == "spatial"
    along = np.array([0.6, -0.48, 0.64] if spatial else [0.6, -0.8])
    here = symgen.load(mechanism_of(tomllib.loads(text))).simulate(verify=False, integrator="dop853")
    for factor in (1.0, 1e3, 1e6):
        by = factor * length_of(here) * along
        there = symgen.load(mechanism_of(shifted(text, by))).simulate(verify=False, integrator="dop853")
        assert length_of(there) == pytest.approx(length_of(here), rel=1e-15 + 1e-15 * factor)
        if factor < 1e6:
            check_like(here, there)
        assert (there.status, there.rank.rank) == ("ok", here.rank.rank), there.reason


@pytest.mark.by_turns(4)
@pytest.mark.fast("pendulum-9.313225746154785e-10", "slider-crank-9.313225746154785e-10", "heavy-top-1073741824.0")
@pytest.mark.parametrize("length", [2.0**-30, 2.0**30])
@pytest.mark.parametrize("name", MECHANISMS)
def test_very_small_and_very_long_mechanisms(tmp_path, name, length):
    """D D^T adds 1 and the square of a length: bodies of 2e8 m ended with numbers that are not finite."""
    weighed = {"method.weight": "mass"}
    here = in_units(tmp_path, of_catalogue(name), 1.0).simulate(verify=False, integrator="dop853", options=weighed)
    there = in_units(tmp_path, of_catalogue(name), length).simulate(verify=False, integrator="dop853")
    check_like(here, there)
    # 2^30 changes no digit, but formulas of a file round it
    assert abs(there.steps - here.steps) <= 0.01 * here.steps
    assert length_of(there) == pytest.approx(length * length_of(here))
    corrected = any("in the metric of the masses" in note for note in there.notes)
    assert corrected == (name != "pendulum")  # which is a point mass


def test_a_bar_of_1e9_metres():
    """Its period is that of small bars, times the root of the length."""
    arm = {"mass": 1.0, "inertia": "length**2/12", "points": {"o": ("-length/2", 0.0)}, "position": ("length/2", 0.0)}
    pin = {"between": ("ground", "arm"), "at": ((0.0, 0.0), "o")}
    angles = []
    for length in (1.0, 1e9):
        builder = symgen.MechanismBuilder("q", gravity=(0.0, -GRAVITY)).parameter("length", length)
        result = symgen.load(builder.body("arm", **arm).joint("pin", "revolute", **pin).build()).simulate(
            until=float(np.sqrt(length)), verify=False
        )
        assert result.status == "ok", result.reason
        angles.append(np.asarray(result.q)[-1, 2])
    # a bar of length 1 is a pendulum of 2/3: released level, sin(a / 2) = sin(45 degrees) cd
    _, cn, dn, _ = ellipj(np.sqrt(GRAVITY / (2.0 / 3.0)), 0.5)
    expected = 2.0 * np.arcsin(np.sqrt(0.5) * cn / dn) - np.pi / 2.0
    np.testing.assert_allclose(angles, expected, atol=1e-6)


@pytest.mark.parametrize(
    ("name", "place"),
    [("four-bar", (0.0, 0.0)), ("shaper", (0.0, 0.2)), ("spatial-slider-crank", (0.0, 0.1, 0.12))],
)
def test_what_coordinates_are_measured_from(name, place):
    """The first point of the ground that a joint has."""
    mechanism = symgen.load(name).mechanism
    datum = origin_of_sizes(mechanism, scalar_values(parameter_values(mechanism)))
    first = mechanism.bodies[0]
    assert datum[: len(first.coordinates)] == [*place, *[0.0] * (len(first.coordinates) - len(place))]


def test_euler_parameters_have_no_unit():
    """Notes on moved bodies printed them with a unit "1"."""
    moved = StartChange("top.e0", "1", 1.0, 0.5), StartChange("top.x", "m", 1.0, 0.5)
    assert [_from_to(change) for change in moved] == ["1 to 0.5", "1 to 0.5 m"]


@pytest.mark.parametrize("guided", [False, True])
def test_a_start_beyond_all_numbers_is_no_open_joint(guided):
    raw = {
        "mechanism": {"name": "far"},
        "bodies": {"a": {"mass": 1.0, "inertia": 0.1}},
        "joints": {"p": {"type": "place", "between": ["ground", "a"], "at": [[0, 0], "centre"]}},
    }
    if guided:
        guide = {"type": "translational", "between": ["ground", "a"], "at": [[0, 0], "centre"], "axis": [1, 0]}
        raw["joints"]["guide"] = guide
    sentence = r"closing does not reach p\.x = 1e\+308 m, which the start holds, though all joints are closed"
    with pytest.raises(AssemblyError, match=sentence):
        symgen.simulate(mechanism_of(raw), until=0.1, start={"p.x": 1e308})
    found = symgen.simulate(mechanism_of(raw), until=0.1, start={"p.x": 3.0})
    assert found.q["a.x"][0] == pytest.approx(3.0, abs=1e-12)

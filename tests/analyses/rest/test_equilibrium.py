"""Equilibria: closed forms and minimal coordinates, stability, redundant rows, what is refused."""

import math

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.optimize import minimize
from support.emitted import mechanism_of

import symgen
from analyses import rods
from analyses.linkages import four_bar, meeting
from symgen.base.errors import AnalysisError, InputError

#: The reference's four-bar: angles of the crank and squares of frequencies, by minimal coordinates with 30 digits.
STABLE, UNSTABLE = (4.358800068629289, 22.57021890188508), (1.216140211569189, -14.27973070577865)
#: Ten links of 2 m in all on pins 1 m apart: horizontal force [N], lowest joint [m], first angle [rad].
CATENARY = (2.251170075733, -0.8043709982912, -1.321141266113)
#: Starts of the links, none of which ends at the pin.
STARTS = {
    "straight": lambda i: 0.0,
    "down": lambda i: -1.0,
    "two arms": lambda i: -0.9 if i < 5 else 0.7,
    "slope": lambda i: -0.3 + 0.1 * i,
    "zigzag": lambda i: 1.2 * (-1) ** i,
    "roof": lambda i: 1.0 if i < 5 else -1.0,
}


@pytest.mark.by_turns(4)
@pytest.mark.fast(
    "absolute-revolute",
    "absolute-slot and rail",
    "absolute-twice",
    "absolute-ball",
    "absolute-distances in space",
    "joint-massless",
)
@pytest.mark.parametrize("kind", rods.KINDS)
@pytest.mark.parametrize("coordinates", ["absolute", "joint"])
def test_a_rod_hangs(kind, coordinates):
    found = rods.hanging(kind).equilibrium(coordinates=coordinates)
    swinging = [x for x in found.omega_squared if abs(x) > 1e-6]
    assert_allclose(swinging, 14.715, rtol=1e-13)
    assert len(swinging) == (2 if kind in ("ball", "distances in space") else 1)
    # a rod on a ball turns about itself as it likes
    assert found.stability == ("indifferent" if kind in ("ball", "distances in space") else "stable")
    height = "rod.y" if "rod.y" in found.q and "rod.z" not in found.q else "rod.z"
    assert_allclose(found.q[height], -0.5, rtol=1e-12)
    assert found.residual < 1e-12
    assert found.not_unique == (("pin", "again") if kind == "twice" else ())


def test_a_rod_on_its_head_is_an_equilibrium_too():
    found = rods.hanging("revolute").equilibrium(start={"rod.theta": math.pi / 2 - 0.05})
    assert found.stability == "unstable"
    assert_allclose(found.omega_squared, [-14.715], rtol=1e-13)
    assert_allclose(found.q["rod.theta"], math.pi / 2, rtol=1e-14)
    assert_allclose([found.multipliers["pin.x"], abs(found.multipliers["pin.y"])], [0.0, 19.62], atol=1e-12)


@pytest.mark.slow_cases("joint-False", "joint-True", "absolute-True")
@pytest.mark.parametrize("doubled", [False, True])
@pytest.mark.parametrize("coordinates", ["absolute", "joint"])
def test_both_equilibria_of_a_four_bar(doubled, coordinates):
    values = np.linspace(0.0, 2 * math.pi, 13)
    first, second = rods.four_bar(doubled).equilibria(("crank.theta", values), coordinates=coordinates)
    for found, (angle, square), word in ((first, UNSTABLE, "unstable"), (second, STABLE, "stable")):
        assert_allclose(found.q["crank.theta"], angle, rtol=1e-12)
        assert_allclose(found.omega_squared, [square], rtol=1e-12)
        assert found.stability == word
        assert found.not_unique == (("D", "D2", "link") if doubled else ())


@pytest.mark.by_turns(4)
@pytest.mark.slow
@pytest.mark.parametrize("start", STARTS)
@pytest.mark.parametrize("coordinates", ["absolute", "joint"])
def test_links_hang_as_a_catenary(start, coordinates):
    found = rods.catenary(STARTS[start]).equilibrium(coordinates=coordinates)
    ends = [found.q[f"l{i}.y"] - 0.1 * math.sin(found.q[f"l{i}.theta"]) for i in range(10)]
    got = abs(found.multipliers["j0.x"]), min(ends), found.q["l0.theta"]
    assert_allclose(got, CATENARY, rtol=1e-11)
    assert found.iterations <= 30 and found.stability == "stable"


@pytest.mark.slow
def test_the_catenary_has_the_least_energy():
    """The same with angles alone, by SciPy: heights of the middles under two conditions."""

    def height(a):
        y = np.concatenate([[0.0], np.cumsum(0.2 * np.sin(a))])
        return np.sum(0.5 * (y[1:] + y[:-1]))

    ends = [
        {"type": "eq", "fun": lambda a: np.sum(0.2 * np.cos(a)) - 1.0},
        {"type": "eq", "fun": lambda a: np.sum(0.2 * np.sin(a))},
    ]
    least = minimize(height, np.linspace(-1.2, 1.2, 10), constraints=ends, method="SLSQP", tol=1e-14).x
    found = rods.catenary(STARTS["two arms"]).equilibrium()
    assert_allclose([found.q[f"l{i}.theta"] for i in range(10)], least, atol=1e-6)  # what SLSQP reaches


@pytest.mark.by_turns(3)
@pytest.mark.slow
@pytest.mark.parametrize("shape", ["straight", "looped"])
@pytest.mark.parametrize("unit", [1.0, 1e-3])
def test_redundant_joints_share_a_load_as_in_a_run(unit, shape):
    """A beam on two welds and a pin, its rows of different lengths, in metres and in millimetres."""
    at = {name: [unit * x, unit * y] for name, x, y in (("A", -1.5, 0.2), ("B", 1.0, -0.4), ("C", 0.3, 0.7))}
    beam = {"mass": 2.0, "inertia": 0.3 * unit**2, "points": at}
    kinds = {"A": "rigid", "B": "rigid", "C": "revolute"}
    held = rods.model({"beam": beam}, {n: rods.pin("ground", "beam", at[n], n, kinds[n]) for n in at})
    rest, run = held.equilibrium(shape=shape), held.simulate(until=1e-3)
    assert rest.not_unique == run.non_unique_reactions == ("A", "B", "C")
    assert_allclose(list(rest.multipliers.values()), [run.lam[n][0] for n in rest.multipliers], rtol=1e-9)


def test_parameters_and_drivers_are_held():
    spring = rods.mass_spring_damper()
    assert_allclose(spring.equilibrium(inputs={"push": 400.0}).q["body.x"], 0.3 + 400 / 4000, rtol=1e-13)
    assert_allclose(spring.equilibrium(parameters={"k": 100.0}).omega_squared, [100 / 1.6], rtol=1e-13)


@pytest.mark.slow_cases("scan3-values that the coordinate can have")
@pytest.mark.parametrize(
    ("scan", "says"),
    [
        (("crank.thet", [0.0, 1.0]), "did you mean 'crank.theta'"),
        (("crank.theta", [0.0]), "two values or more"),
        ("crank.theta", "a pair of a name and its values"),
        (("crank.x", [7.0, 9.0]), "values that the coordinate can have"),
    ],
)
def test_bad_scans_are_refused(scan, says):
    with pytest.raises(InputError, match=says):
        rods.four_bar().equilibria(scan)


@pytest.mark.parametrize(
    ("values", "angles"),
    [(np.linspace(0.1, math.pi, 5), [math.pi]), (np.linspace(-math.pi, math.pi, 5), [-math.pi, 0.0])],
)
def test_a_scan_finds_what_rests_at_its_ends(values, angles):
    """A rod on its head: at the number beside pi a force of 1e-16 N m is left, of either sign."""
    rod = {"mass": 1.0, "inertia": 0.1, "points": {"top": [0.0, 0.5]}, "position": [0.0, -0.5]}
    model = rods.model({"rod": rod}, {"pin": rods.pin("ground", "rod", rods.GROUND2, "top")})
    found = model.equilibria(("rod.theta", values))
    assert_allclose([x.q["rod.theta"] for x in found], angles, atol=1e-12)
    assert [x.stability for x in found] == ["unstable" if a else "stable" for a in angles]


def test_a_scan_finds_what_is_between():
    """A point that two springs push out of the middle, from near there: Newton's method led down, out of the range."""
    spring = {"type": "spring-damper", "stiffness": 10.0, "free_length": 1.2}
    forces = {
        f"s{i}": {**spring, "between": ["ground", "mass"], "at": [[x, 0.0], "centre"]} for i, x in ((1, -1), (2, 1))
    }
    model = rods.model(
        {"mass": {"type": "point", "mass": 2.0, "position": [0.0, 0.02]}}, {}, gravity=[0.0, 0.0], forces=forces
    )
    (found,) = model.equilibria(("mass.y", [-0.5, 0.6]))
    assert abs(found.q["mass.y"]) < 1e-12 and found.stability == "unstable"
    assert_allclose(found.omega_squared, [2 * 10 * (1 - 1.2) / 2, 10.0], rtol=1e-12)


@pytest.mark.parametrize("coordinates", ["absolute", "joint"])
@pytest.mark.parametrize(("size", "start"), [(1.0, 1e-6), (1.0, 0.5), (1e-8, 5e-9)], ids=["no start", "far", "tiny"])
def test_a_scan_is_as_long_as_its_values(size, start, coordinates):
    """A point between two springs that push it out, of twice the length that they have there: 3**0.5 to either side."""
    spring = {"type": "spring-damper", "between": ["ground", "mass"], "stiffness": 100.0, "free_length": 2.0 * size}
    raw = {
        "mechanism": {"name": "pushed"},
        "bodies": {"mass": {"type": "point", "mass": 1.0, "position": [start, 0.0]}},
        "forces": {name: {**spring, "at": [[0.0, y * size], "centre"]} for name, y in (("low", -1.0), ("high", 1.0))},
    }
    found = symgen.load(mechanism_of(raw)).equilibria(
        ("mass.x", size * np.linspace(-2.5, 2.5, 11)), coordinates=coordinates
    )
    assert_allclose([e.q["mass.x"] / size for e in found], [-(3.0**0.5), 0.0, 3.0**0.5], rtol=0.0, atol=1e-9)
    assert [e.stability for e in found] == ["stable", "unstable", "stable"]


def test_a_scan_goes_over_angles_that_do_not_close():
    """A crank that cannot lie between 2.87 and 3.42 rad: what holds it beside these has other signs on either side."""
    links, values = (4.0, 2.0, 3.0, 2.95), [1.0, 1.8, 2.8, 3.45, 4.2, 5.2]
    model = symgen.load(mechanism_of(four_bar(links, math.pi / 3.0, None)))
    found = [x.q["crank.theta"] for x in model.equilibria(("crank.theta", values))]

    def height(angle, above):
        b = 2.0 * np.array([math.cos(angle), math.sin(angle)])
        c = meeting(b, 3.0, np.array([4.0, 0.0]), 2.95, above)
        return float(b[1] + c[1])  # twice the sum of the middles' heights, each with the same mass

    def slope(angle, above):
        return (height(angle + 1e-5, above) - height(angle - 1e-5, above)) / 2e-5

    assert len([x for x in found if x < 2.0]) == len([x for x in found if x > 4.2]) == 1
    assert all(min(abs(slope(x, True)), abs(slope(x, False))) < 1e-6 for x in found)


@pytest.mark.slow
def test_no_equilibrium_is_said():
    with pytest.raises(AnalysisError, match=r"no equilibrium was found with crank\.theta from 2 to 3"):
        rods.four_bar().equilibria(("crank.theta", [2.0, 2.5, 3.0]))
    with pytest.raises(AnalysisError, match="no equilibrium was found from this start"):
        rods.model({"free": {"type": "point", "mass": 1.0, "position": [0.0, 0.0]}}, {}).equilibrium()


def test_level_rods_fall_at_once():
    """Where they begin, nothing restores them along the way that they fall: no step of Newton's method moves them."""
    found = symgen.load("spherical-double-pendulum").equilibrium()
    assert found.iterations <= 12 and found.stability == "indifferent"  # both turn about themselves as they like
    assert_allclose([found.q["upper.z"], found.q["lower.z"]], [-0.5, -1.5], rtol=1e-12)
    a = np.array([[8.0, 3.0], [3.0, 2.0]]) / 6.0  # two rods of 1 m and equal mass: angles from the vertical
    squares = np.sort(np.linalg.eigvals(np.linalg.solve(a, rods.GRAVITY * np.diag([1.5, 0.5]))).real)
    assert_allclose(found.omega_squared[2:], np.repeat(squares, 2), rtol=1e-2)  # rods have some thickness


@pytest.mark.slow
def test_a_motor_that_never_rests_has_no_equilibrium():
    """At rest it exerts 8 N m wherever its crank stands, and nothing holds against it."""
    with pytest.raises(AnalysisError, match="no equilibrium was found from this start"):
        symgen.load("wiper").equilibrium()
    with pytest.raises(AnalysisError, match=r"no equilibrium was found with crank\.theta"):
        symgen.load("wiper").equilibria(("crank.theta", np.linspace(0.0, 6.28, 9)))


@pytest.mark.parametrize("shape", ["straight", "looped"])
def test_a_flat_parallelogram_sinks(shape):
    """Where all its links are in one line rows depend on each other, there alone."""

    def link(length, x):
        ends = {"A": [-0.5 * length, 0.0], "B": [0.5 * length, 0.0]}
        return {"mass": 2.0 * length, "inertia": length**3 / 6.0, "points": ends, "position": [x, 0.0]}

    bodies = {"crank": link(1.0, 0.5), "coupler": link(2.0, 2.0), "rocker": link(1.0, 2.5)}
    ends = {"A": ("ground", "crank", [0.0, 0.0], "A"), "B": ("crank", "coupler", "B", "A")}
    ends |= {"C": ("coupler", "rocker", "B", "B"), "D": ("ground", "rocker", [2.0, 0.0], "A")}
    found = rods.model(bodies, {name: rods.pin(*at) for name, at in ends.items()}).equilibrium(shape=shape)
    assert found.stability == "stable"
    assert found.residual < 1e-9
    # as a parallelogram (2 + 4) kg m g over 16/3 kg m^2; folded through itself, which begins there as well, 21/16 g
    assert min(abs(found.omega_squared[0] / rods.GRAVITY - square) for square in (18.0 / 16.0, 21.0 / 16.0)) < 1e-9

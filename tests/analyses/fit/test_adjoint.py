"""Gradients by the adjoint: against models without symgen, forward directions, and what is refused."""

import numpy as np
import pytest
from run.directions.lengths import BY_NAME, FOUR_BAR, G_BY, ROD, ROD_BY, SLIDER_CRANK, model
from support.rotation import of_turn

import symgen
from symgen import InputError
from symgen.base.errors import AnalysisError
from symgen.derive.methods import METHODS
from symgen.run.directions import kept_stages

TIGHT = {"rtol": 1e-13, "atol": 1e-13, "integrator": "dop853"}
#: Methods with an adjoint, and those whose iterations have none.
COVERED = (
    *("adaptive-baumgarte", "baumgarte", "braun-goldfarb", "compliant-constraints", "controllable-velocity-projection"),
    *("direct-correction", "invariant-stabilization", "lagrange", "penalty", "post-stabilization"),
    *("stiffness-scaled-penalty", "udwadia-kalaba", "velocity-projection"),
)


@pytest.fixture(scope="module")
def four_bar(tmp_path_factory):
    return model(tmp_path_factory.mktemp("lengths"), FOUR_BAR)


def largest_difference(model, quantity, by, **settings):
    """Return how far the adjoint and forward directions are apart."""
    one, other = (model.gradient(quantity, by=by, way=way, **settings) for way in ("adjoint", "forward"))
    assert (one.way, other.way) == ("adjoint", "forward")
    assert one.units == other.units
    assert one.value == pytest.approx(other.value, rel=1e-11)
    return max(abs(one.by[name] - other.by[name]) / abs(other.by[name]) for name in by)


@pytest.mark.by_turns(6)
@pytest.mark.slow
@pytest.mark.parametrize("method", ["lagrange", "direct-correction"])
@pytest.mark.parametrize("coordinates", ["absolute", "joint"])
def test_lengths_masses_and_gravity_of_the_four_bar(four_bar, method, coordinates):
    settings = {"until": 2.0, "method": method, "coordinates": coordinates, **TIGHT}
    for place, quantity in enumerate(("crank.theta", "crank.omega")):
        found = four_bar.gradient(quantity, by=tuple(BY_NAME), way="adjoint", **settings)
        assert found.by == pytest.approx({name: by[place] for name, by in BY_NAME.items()}, rel=1e-11)
        assert found.way == "adjoint"
        assert found.result.ok
        assert found.memory > 1000


@pytest.mark.by_turns(3)
@pytest.mark.slow
@pytest.mark.parametrize("quantity", ["rod.theta", "length**2/3*rod.omega**2", "rod.alpha"])
def test_the_rod_on_a_pin(tmp_path, quantity):
    rod = model(tmp_path, ROD)
    if quantity == "rod.theta":
        found = rod.gradient(quantity, by=tuple(ROD_BY), way="adjoint", until=3.0, **TIGHT)
        assert found.by == pytest.approx({name: by[0] for name, by in ROD_BY.items()}, rel=1e-11)

    assert largest_difference(rod, quantity, (*ROD_BY, "rod.omega"), until=1.0, **TIGHT) < 1e-11


@pytest.mark.slow
def test_the_integral_of_idas(tmp_path):
    energy = model(tmp_path, SLIDER_CRANK).gradient("G", by=("k", "c"), way="adjoint", rtol=1e-12, atol=1e-12)
    assert energy.by == pytest.approx(G_BY, rel=1e-11)


@pytest.mark.by_turns(3)
@pytest.mark.slow
@pytest.mark.parametrize("method", ["lagrange", "direct-correction"])
@pytest.mark.parametrize(
    ("integrator", "options"),
    [
        ("rk4", {"step": 5e-2}),  # with rounds of corrections
        ("heun", {"step": 1e-2}),
        ("dop853", {"step": 0.1, "options": {"integrator.adaptive": "false"}}),
        ("dopri5", {"rtol": 1e-8, "atol": 1e-8}),
    ],
)
def test_schemes(four_bar, method, integrator, options):
    by, settings = ("a", "d", "m2", "crank.omega"), {"until": 1.0, "max_violation": 1.0, "max_energy_error": 1.0}
    quantity = "rocker.C.x*coupler.omega"
    assert (
        largest_difference(four_bar, quantity, by, method=method, integrator=integrator, **options, **settings) < 1e-11
    )


@pytest.mark.by_turns(6)
@pytest.mark.slow
@pytest.mark.parametrize("method", ["lagrange", "direct-correction"])
@pytest.mark.parametrize("coordinates", ["absolute", "joint"])
def test_motion_in_space(method, coordinates):
    disc, by = symgen.load("rolling-disc"), ("radius", "lean", "mechanism.gravity[2]")
    settings = {"until": 0.5, "method": method, "coordinates": coordinates, "integrator": "dop853"}
    assert largest_difference(disc, "disc.x", by, **settings) < 1e-11


@pytest.mark.slow
def test_runs_that_are_kept_in_parts(four_bar, monkeypatch):
    settings = {"until": 2.0, "method": "direct-correction", "integrator": "rk4", "step": 1e-2, "way": "adjoint"}
    whole = four_bar.gradient("crank.theta", by=("a", "m2"), **settings)
    monkeypatch.setattr(kept_stages, "_PIECE", 1 << 11)
    parts = four_bar.gradient("crank.theta", by=("a", "m2"), **settings)
    assert parts.by == whole.by
    assert parts.memory > whole.memory  # the last step before each part stands in front of it
    monkeypatch.setattr(kept_stages, "MOST_KEPT", 1 << 13)
    with pytest.raises(AnalysisError, match="take larger tolerances or steps"):
        four_bar.gradient("crank.theta", by=("a", "m2"), **settings)


@pytest.mark.slow
def test_whichever_costs_less_is_taken(four_bar):
    settings = {"until": 0.2, "integrator": "rk4", "step": 1e-2}
    assert four_bar.gradient("crank.theta", by=tuple(BY_NAME), **settings).way == "forward"
    many = four_bar.gradient("crank.theta", by=(*BY_NAME, "crank.omega"), **settings)
    assert many.way == "adjoint"
    other = four_bar.gradient("crank.theta", by=(*BY_NAME, "crank.omega"), method="null-space", **settings)
    assert other.way == "forward"
    assert other.by == pytest.approx(many.by, rel=1e-4, abs=1e-6)


@pytest.mark.parametrize(
    ("settings", "expected"),
    [
        ({"integrator": "abm4"}, "an explicit Runge-Kutta scheme, got 'abm4'; take dop853"),
        ({"method": "null-space"}, "got accelerations of the method null-space .* forward directions take all methods"),
        ({"method": "energy-projection"}, "got corrections of the method energy-projection"),
        ({"method": "coordinate-partitioning"}, "got accelerations of the method coordinate-partitioning"),
        ({"shape": "looped"}, "code of the shape 'straight'"),
        ({"way": "backward"}, "way: expected"),
    ],
)
def test_what_has_no_adjoint_is_refused(four_bar, settings, expected):
    usual = {"way": "adjoint", "integrator": "rk4", "step": 1e-2, "until": 0.1}
    with pytest.raises(InputError, match=expected):
        four_bar.gradient("crank.theta", by=("a", "b"), **usual | settings)


#: Rods in space on springs that wind up by some turns: angles of 7 hinges go on beyond pi.
WOUND = """
[mechanism]
name = "wound"
space = "spatial"
gravity = [0.0, 0.0, 0.0]

[parameters]
k = 0.5
"""
HINGED = """
[bodies.rod{i}]
mass = 1.0
inertia = [0.1, 0.1, 0.1]
position = [0.0, 0.0, {i}.0]
angular_velocity = [0.0, 0.0, {speed}]

[joints.hinge{i}]
type = "revolute"
between = ["ground", "rod{i}"]
at = [[0.0, 0.0, {i}.0], [0.0, 0.0, 0.0]]
axis = [0.0, 0.0, 1.0]

[forces.spring{i}]
type = "torsional-spring-damper"
joint = "hinge{i}"
stiffness = "k"
"""


@pytest.mark.by_turns(5)
@pytest.mark.slow
def test_many_angles_that_count_turns(tmp_path):
    """Each angle is w/r sin(r t) with r^2 = k/J; 300 values of k, against the derivative in closed form."""
    speeds = np.linspace(8.0, 20.0, 7)
    text = WOUND + "".join(HINGED.format(i=i, speed=speed) for i, speed in enumerate(speeds))
    wound_up = " + ".join(f"{i + 1}*hinge{i}.angle" for i in range(7))
    (tmp_path / "wound.toml").write_text(text)
    wound, t, factor = symgen.load(tmp_path / "wound.toml"), 1.5, np.arange(1.0, 8.0) @ speeds
    most = 0.0
    for k in of_turn(np.linspace(0.05, 2.0, 300), 6):
        gradient = wound.gradient(
            wound_up, by=("k",), way="adjoint", until=t, integrator="dop853", rtol=1e-11, parameters={"k": k}
        )
        rate = np.sqrt(k / 0.1)
        slope = (t * np.cos(rate * t) - np.sin(rate * t) / rate) / rate / (2.0 * rate * 0.1)
        assert gradient.value == pytest.approx(factor * np.sin(rate * t) / rate, abs=1e-7)
        assert gradient.by["k"] == pytest.approx(factor * slope, abs=1e-6)
        most = max(most, speeds.max() / rate)
    assert most > 2.0 * np.pi


@pytest.mark.by_turns(4)
@pytest.mark.slow
@pytest.mark.parametrize("coordinates", ["absolute", "joint"])
def test_a_loop_of_six_hinges(coordinates):
    settings = {"until": 0.5, "integrator": "rk4", "step": 5e-3, "coordinates": coordinates}
    by = ("bodies.rod1.mass", "bodies.rod2.mass", "bodies.rod4.mass")
    assert largest_difference(symgen.load("bricard"), "rod2.y", by, **settings) < 1e-12


@pytest.mark.slow
@pytest.mark.parametrize(
    "method", of_turn((n for n in METHODS.names if {"ode", "one-step"} & set(METHODS.get(n, "method").forms)), 9)
)
def test_every_method(method):
    four_bar, by = symgen.load("four-bar"), ("crank_mass", "rocker_mass", "crank.theta")
    limits = {"max_violation": 1.0, "max_energy_error": 1e3}
    settings = {"method": method, "integrator": "rk4", "step": 1e-2, "until": 0.5, **limits}
    if method not in COVERED:
        with pytest.raises(InputError, match="forward directions take all methods"):
            four_bar.gradient("rocker.theta", by=by, way="adjoint", **settings)
        return
    # penalties multiply the rounding of what they hold back
    bound = 1e-7 if method == "penalty" else 1e-11
    assert largest_difference(four_bar, "rocker.theta", by, **settings) < bound


WHEEL = """
[mechanism]
name = "wound-wheel"
space = "spatial"
gravity = [0.0, 0.0, -9.81]
[parameters]
k = { value = 2.0, unit = "N m/rad" }
[bodies.wheel]
mass = 1.0
inertia = [0.02, 0.03, 0.05]
centre_of_mass = [0.1, 0.0, 0.0]
[joints.axle]
type = "revolute"
between = ["ground", "wheel"]
at = [[0.0, 0.0, 0.0], [0.0, 0.0, 0.0]]
axis = [0.0, 1.0, 0.0]
[forces.spring]
type = "torsional-spring-damper"
joint = "axle"
stiffness = "k"
damping = 0.01
free_angle = 12.0
"""


@pytest.mark.by_turns(3)
@pytest.mark.slow
@pytest.mark.parametrize("coordinates", ["absolute", "joint"])
@pytest.mark.parametrize("method", ["lagrange", "direct-correction"])
def test_angles_that_count_turns(tmp_path, method, coordinates):
    wheel, settings = model(tmp_path, WHEEL), {"until": 1.5, "method": method, "coordinates": coordinates, **TIGHT}
    by = ("k", "bodies.wheel.mass", "forces.spring.free_angle", "forces.spring.damping")
    assert largest_difference(wheel, "wheel.wy", by, **settings) < 1e-11
    assert wheel.simulate(verify=False, **settings)["axle.angle"].max() > 12.0


@pytest.mark.slow
def test_objectives(four_bar):
    settings = {"until": 0.5, "method": "lagrange", "integrator": "rk4", "step": 1e-2, "start": {"crank.omega": 0.3}}
    by = (*BY_NAME, "crank.omega", "bodies.coupler.angle")
    one, other = (four_bar.objective("rocker.theta**2", by=by, way=way, **settings) for way in ("auto", "forward"))
    assert (one.first.way, other.first.way) == ("adjoint", "forward")
    assert one.x0.tolist() == other.x0.tolist()
    at = one.x0 * 1.01
    values, slopes = zip(one(at), other(at), strict=True)
    assert values[0] == pytest.approx(values[1], rel=1e-12)
    assert slopes[0] == pytest.approx(slopes[1], rel=1e-11)
    at[by.index("a")] = 100.0
    assert one(at)[0] == float("inf")

"""Runs in joint coordinates: the same motions, reactions and energies as in the coordinates of bodies."""

import math

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from support.checks import assert_same_motion
from support.emitted import mechanism_of

import symgen
from symgen.base.errors import InputError
from symgen.derive.methods import METHODS
from symgen.describe.catalogue import raw
from symgen.run.compiling.choices import choose_coordinates, mechanism_on_tree
from symgen.run.compiling.method_choice import choose_method
from symgen.run.compiling.pipeline import compile_model
from symgen.run.integrators import INTEGRATORS

#: Two runs at this tolerance differ by at most what their errors add up to over the span, a thousand tolerances.
TIGHT = {"integrator": "dop853", "rtol": 1e-11, "atol": 1e-13}
MOTION, REACTION = 1e-8, 1e-6

#: Model -> time [s]. A loop, a loop in space with a redundant row, drivers, nonholonomic rows, springs, welds, trees.
SPANS = {
    **{"four-bar": 0.5, "bricard": 0.5, "driven-four-bar": 0.3, "rolling-disc": 0.5, "flyball-governor": 0.05},
    **{"scissor-lift": 0.3, "spherical-double-pendulum": 0.5, "spatial-slider-crank": 0.2, "pendulum": 0.5},
    **{"stewart-platform": 0.1, "front-suspension": 0.1, "heavy-top": 0.1, "cart-pole": 0.5, "wiper": 0.2},
}
QUICK = ("four-bar", "bricard", "driven-four-bar", "rolling-disc", "scissor-lift", "spherical-double-pendulum")


def both(name, until, method="direct-correction", **settings):
    model = symgen.load(name)
    settings = {"method": method, "until": until, "output_step": until / 4, **settings}
    return model.simulate(**settings), model.simulate(coordinates="joint", **settings)


def check_same(bodies, joints, motion=MOTION):
    assert bodies.status == joints.status == "ok", (bodies.reason, joints.reason)
    assert bodies.coordinates == "absolute" and joints.coordinates == "joint"
    for table in ("q", "v", "joint_coordinates"):
        a, b = getattr(bodies, table), getattr(joints, table)
        assert a.names == b.names and a.units == b.units
        size = max(1.0, float(np.abs(a.values).max(initial=0.0)))
        np.testing.assert_allclose(b.values, a.values, rtol=0.0, atol=motion * size, err_msg=table)
    a, b = bodies.reactions, joints.reactions
    size = max(1.0, float(np.abs(a.values).max(initial=0.0)))
    np.testing.assert_allclose(b.values, a.values, rtol=0.0, atol=100.0 * motion * size, err_msg="reactions")
    total, scale = joints.kinetic + joints.potential - joints.work, float(joints.outcome.energy_scale)
    np.testing.assert_allclose(total, bodies.kinetic[0] + bodies.potential[0], rtol=0.0, atol=100.0 * motion * scale)
    assert joints.rank == bodies.rank


@pytest.mark.by_turns(3)
@pytest.mark.fast("four-bar", "rolling-disc", "spherical-double-pendulum")
@pytest.mark.parametrize(
    "name", [name if name in QUICK else pytest.param(name, marks=pytest.mark.slow) for name in SPANS]
)
def test_motions_of_the_catalogue(name):
    check_same(*both(name, SPANS[name], **TIGHT))


def pairs(methods, integrators):
    for name in methods:
        method = METHODS.get(name, "")
        for integrator in integrators:
            if set(method.forms) & set(INTEGRATORS.get(integrator, "").forms):
                yield name, integrator


SAMPLED = (
    ("augmented-hamiltonian", "rk4"),
    ("coordinate-partitioning", "rk4"),
    ("null-space", "rk4"),
    ("ggl", "radau5"),
)


#: Every method with an explicit scheme and an implicit one, where it has such forms; every integrator with one method,
#: but Euler's two, whose runs fail at this step in coordinates of bodies.
OTHERS = [name for name in INTEGRATORS.names if name not in ("euler", "symplectic-euler")]
ALL = {*pairs(METHODS.names, ("rk4", "radau5")), *pairs(("lagrange", "generalized-alpha"), OTHERS)}


@pytest.mark.slow_cases("four-bar-null-space-rk4", "four-bar-coordinate-partitioning-rk4")
@pytest.mark.by_turns(6)
@pytest.mark.parametrize(
    ("name", "method", "integrator"),
    [
        *(("four-bar", *pair) for pair in SAMPLED),  # the mass matrix changes
        *(pytest.param("four-bar", *pair, marks=pytest.mark.slow) for pair in sorted(ALL - {*SAMPLED})),
        *(
            pytest.param("spatial-slider-crank", *pair, marks=pytest.mark.slow)
            for pair in sorted(pairs(METHODS.names, ("rk4",)))
        ),
    ],
)
def test_methods_and_integrators(name, method, integrator):
    adaptive = INTEGRATORS.get(integrator, "").adaptive
    steps = {"rtol": 1e-9, "atol": 1e-11} if adaptive else {"step": 1e-3}
    if method == "energy-projection":  # its energy says nothing of its error
        steps["verify"] = True
    if method == "braun-goldfarb":  # of first order in what it leaves of violations
        steps["max_violation"] = 1e-4
    bodies, joints = both(name, 0.25, method, integrator=integrator, **steps)
    # penalties give by 1e-7, and schemes of second order are off by as much at this step
    check_same(bodies, joints, 2e-5)


def test_what_the_state_is():
    model = symgen.load("cart-pole")
    result = model.simulate(until=0.01, coordinates="joint")
    assert result.state == ("rail.displacement", "pole.theta", "rail.displacement.rate", "pole.omega")
    assert model.simulate(until=0.01).state[:3] == ("cart.x", "cart.y", "cart.theta")
    assert model.simulate(until=0.01, coordinates="auto", shape="straight").coordinates == "joint"
    assert model.simulate(until=0.01, coordinates="auto", shape="looped").coordinates == "absolute"


@pytest.mark.slow_cases("andrews", "jansen-leg")
@pytest.mark.parametrize(
    "name", ["four-bar", "andrews", "jansen-leg", "wiper", "heavy-top", "pendulum", "free-rigid-body", "rolling-disc"]
)
def test_auto_takes_the_coordinates_with_fewer_operations(name):
    """`auto` counts velocities and rows, without code; the operations of emitted code agree with it."""
    mechanism = symgen.load(name).mechanism
    choice = choose_method("direct-correction", {"weight": "mass"})
    of_bodies, of_joints = (
        compile_model(each, choice).law.operations["rhs"] for each in (mechanism, mechanism_on_tree(mechanism))
    )
    taken = choose_coordinates(mechanism, "auto", "straight").name
    assert taken == ("joint" if of_joints < of_bodies else "absolute")


def test_which_joint_is_cut():
    """The one with the fewest operations, unless the file says which; the motion is the same."""
    described = raw("slider-crank")
    settings = {"until": 0.05, "coordinates": "joint", **TIGHT}
    found = [symgen.load(mechanism_of(described)).simulate(**settings)]
    for joint in ("Q", "P"):
        joints = {name: {**table, "cut": name == joint} for name, table in described["joints"].items()}
        found.append(symgen.load(mechanism_of({**described, "joints": joints})).simulate(**settings))
    chosen, slide, turn = (result.state[: len(result.state) // 2] for result in found)
    assert chosen == ("crank.theta", "rod.theta", "slider.theta")
    assert slide == ("crank.theta", "guide.displacement", "rod.theta")
    assert set(turn) == {"crank.theta", "guide.displacement", "rod.theta"}
    for other in found[1:]:
        np.testing.assert_allclose(other.q.values, found[0].q.values, rtol=0.0, atol=MOTION)


def test_a_tree_needs_no_method():
    """Without loops all methods are one ordinary differential equation."""
    model = symgen.load("spherical-double-pendulum")
    names = ("lagrange", "direct-correction", "baumgarte", "velocity-projection")
    found = [model.simulate(method=n, until=0.2, integrator="rk4", step=1e-3, coordinates="joint") for n in names]
    for other in found[1:]:
        assert_same_motion(other.q.values, found[0].q.values)


@pytest.mark.slow
def test_rows_of_a_loop_that_vanish():
    """Where all bars of the flat four-bar are in line, rows of its loop vanish as a whole: no run is ok unwarned."""
    settings = {"until": 1.4, "integrator": "rk4", "step": 1e-3, "output_step": 0.2}
    bodies, joints = both("n-four-bar:2", method="direct-correction", **settings)
    assert bodies.rank_event_count == joints.rank_event_count > 0
    np.testing.assert_allclose(joints.q.values, bodies.q.values, rtol=0.0, atol=1e-5)
    assert any("singular position" in warning for warning in joints.warnings)
    plain = symgen.load("n-four-bar:2").simulate(method="lagrange", coordinates="joint", **settings)
    assert plain.status == "unverified"


def test_events_outputs_and_inputs():
    """A motor that an input drives, stopped at an angle: what is integrated and noted is that of the bodies."""
    model = symgen.load("four-bar")
    settings = {"until": 2.0, "stop_when": "crank.theta < 0.9", "output_step": 0.1, **TIGHT}
    bodies, joints = model.simulate(**settings), model.simulate(coordinates="joint", **settings)
    assert bodies.end == pytest.approx(joints.end, abs=1e-9) and bodies.end < 2.0
    ((a,), (b,)) = bodies.events, joints.events
    assert a.q.keys() == b.q.keys() and b.q["crank.theta"] == pytest.approx(0.9, abs=1e-9)


def test_refusals():
    model = symgen.load("four-bar")
    with pytest.raises(InputError, match="loops, lanes and CUDA have no joint coordinates"):
        model.simulate(coordinates="joint", shape="looped")
    with pytest.raises(InputError, match="absolute, joint, auto"):
        model.simulate(coordinates="relative")


@pytest.mark.parametrize("integrator", ["dop853", "picard", "abm", "radau5"])
def test_what_is_welded_to_the_ground_stays_there(integrator):
    """No coordinate is left that an error could be estimated of, but for the work."""
    welded = {
        "mechanism": {"name": "welded", "gravity": [0.0, -9.81]},
        "bodies": {"a": {"mass": 1.0, "inertia": 1.0, "points": {"P": [0.5, 0.0]}, "position": [0.5, 0.0]}},
        "joints": {"w": {"type": "rigid", "between": ["ground", "a"], "at": [[1.0, 0.0], "P"]}},
    }
    result = symgen.load(mechanism_of(welded)).simulate(
        method="lagrange", integrator=integrator, coordinates="joint", until=0.1, output_step=0.05
    )
    assert (result.status, result.reason) == ("ok", None)
    np.testing.assert_array_equal(result["a.x"], 0.5)
    np.testing.assert_array_equal(result["a.vy"], 0.0)


PARALLELOGRAM = """
[mechanism]
name = "parallelogram-through-flat-positions"
gravity = [0.0, -9.81]
[bodies]
c1 = { mass = 1.0, inertia = 0.0833, position = [0.25, 0.4330127018922193], angle = 1.0471975511965976, angular_velocity = 8.0, points = { a = [-0.5, 0.0], b = [0.5, 0.0] } }
c2 = { mass = 1.0, inertia = 0.0833, position = [2.25, 0.4330127018922193], angle = 1.0471975511965976, points = { a = [-0.5, 0.0], b = [0.5, 0.0] } }
k = { mass = 2.0, inertia = 0.6667, position = [1.5, 0.8660254037844386], points = { a = [-1.0, 0.0], b = [1.0, 0.0] } }
[joints]
A = { type = "revolute", between = ["ground", "c1"], at = [[0.0, 0.0], "a"] }
B = { type = "revolute", between = ["c1", "k"], at = ["b", "a"] }
C = { type = "revolute", between = ["k", "c2"], at = ["b", "b"] }
E = { type = "revolute", between = ["ground", "c2"], at = [[2.0, 0.0], "a"] }
"""  # noqa: E501


@pytest.mark.by_turns(3)
@pytest.mark.fast("abm-absolute")
@pytest.mark.parametrize("coordinates", ["joint", "absolute"])
@pytest.mark.parametrize("integrator", ["dop853", "picard", "radau5", "abm"])
def test_parallel_cranks_stay_parallel_through_flat_positions_at_all_tolerances(integrator, coordinates, tmp_path):
    """Six flat positions in 2 s, against one equation in one angle: both cranks and the rod turn as one.

    (2 (I + m/4) + M) theta'' = -g (m + M) cos(theta); where the way branches the other branch is 0.9 rad off by then.
    """
    inertia = 2.0 * (0.0833 + 0.25) + 2.0
    law = solve_ivp(
        lambda t, y: (y[1], -9.81 * 3.0 * math.cos(y[0]) / inertia), (0.0, 2.0), (math.pi / 3.0, 8.0), rtol=1e-11
    )
    path = tmp_path / "parallelogram.toml"
    path.write_text(PARALLELOGRAM)
    model = symgen.load(path)
    for rtol in (1e-6, 1e-8, 5.6e-9, 1e-9, 5.6e-10, 1e-10, 3.2e-11):
        found = model.simulate(
            method="direct-correction", integrator=integrator, coordinates=coordinates, rtol=rtol, atol=rtol / 100.0,
            until=2.0, times=(2.0,),
        )  # fmt: skip
        assert found.status == "ok", (rtol, found.reason)
        for crank in ("c1.theta", "c2.theta"):
            assert found[crank][-1] == pytest.approx(law.y[0, -1], abs=1e-2), (rtol, crank)


def test_every_run_of_a_description_takes_the_same_tree():
    """Its digest and numbers are computed once then, which a warm call would otherwise pay for."""
    mechanism = symgen.load("four-bar").mechanism
    tree = mechanism_on_tree(mechanism)
    assert mechanism_on_tree(mechanism) is tree and tree.topology is not None

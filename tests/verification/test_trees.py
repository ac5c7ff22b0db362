"""Joint coordinates of random mechanisms: positions, velocities and accelerations of bodies, against plain formulas.

`benchmarks.plain` has every joint and force once more, in coordinates of bodies, and shares no code with symgen.
"""

from pathlib import Path

import numpy as np
import pytest
from support.rotation import of_turn

from benchmarks.mechanisms.draw import draw
from benchmarks.plain.start import choose_turns
from benchmarks.plain.system import read
from symgen.api import load
from symgen.base.settings import Settings
from symgen.compile.store.loaded_modules import plain_function
from symgen.describe.mechanism import Mechanism
from symgen.describe.parts.topology import spanning_tree
from symgen.run.planning.plan import Purpose
from symgen.run.planning.prepare import prepare
from verification.running import model_of, of_bodies

SEED = 12
#: Which of the seed's mechanisms are compared, planar and spatial; 10 is driven against what a joint holds.
PLANE, SPACE = range(8), (*range(10), *range(11, 26))
#: A state of a tree is that of bodies to rounding: products along chains of a few bodies of size 1.
EXACT = 1e-12
#: Smallest singular values of what `draw` takes are 0.06, and S has their squares; rows that depend on others do so to
#: the digits of the file.
ACCELERATIONS, REDUNDANT = 1e-9, 1e-5


def drawn(index: int, spatial: bool, folder: Path) -> tuple[dict, Mechanism]:
    raw = draw(SEED, index, spatial).raw
    return raw, model_of(raw, folder).mechanism


def compare(index: int, spatial: bool, folder: Path) -> None:
    compare_with_plain(*drawn(index, spatial, folder))


def compare_with_plain(raw: dict, mechanism: Mechanism) -> None:
    run = prepare(mechanism, Settings(method="lagrange", coordinates="joint"), Purpose.STATE).tree
    info, start = run.bodies.info, run.body_start.y
    q, v, a = np.split(of_bodies(run), [info.nq, info.nq + info.nv])
    np.testing.assert_allclose(q, start[: info.nq], rtol=0.0, atol=EXACT * 10.0)
    np.testing.assert_allclose(v, start[info.nq : info.nq + info.nv], rtol=EXACT, atol=EXACT * 10.0)
    system = read(raw)
    choose_turns(system, 0.0, q)
    state = system.at(0.0, q, v)
    system.follow(state)
    state = system.at(0.0, q, v)
    constraints, (forces, _, _) = system.constraints(state), system.loads(state)
    rank = system.rank(constraints.d)
    expected, _ = system.accelerations(constraints, forces, rank)
    size = max(1.0, float(np.abs(expected).max()))
    bound = ACCELERATIONS if rank == len(constraints.d) else REDUNDANT
    np.testing.assert_allclose(a, expected, rtol=0.0, atol=bound * size)


@pytest.mark.by_turns(3)
@pytest.mark.slow_cases("0", "2", "5", "6", "3")
@pytest.mark.parametrize("index", PLANE)
def test_random_trees_in_the_plane(index, tmp_path):
    compare(index, False, tmp_path)


@pytest.mark.slow_cases("2", "3", "4")
@pytest.mark.parametrize(
    "index", [*SPACE[2:5], *(pytest.param(i, marks=pytest.mark.slow) for i in of_turn((*SPACE[:2], *SPACE[5:]), 9))]
)
def test_random_trees_in_space(index, tmp_path):
    compare(index, True, tmp_path)


@pytest.mark.slow
def test_what_was_compared(tmp_path):
    """Most joints that can stand in a tree did, from the first body to the second and the other way round."""
    found = set()
    for spatial, indices in ((False, PLANE), (True, SPACE)):
        for index in indices:
            _, mechanism = drawn(index, spatial, tmp_path)
            for link in spanning_tree(mechanism).links:
                if link.joint:
                    found.add((spatial, mechanism.joint_named(link.joint).kind, link.forward))
    both = {(False, "revolute"), (True, "revolute"), (True, "spherical"), (True, "universal"), (True, "cylindrical")}
    both |= {(True, "translational"), (True, "screw")}
    assert found >= {(*kind, forward) for kind in both for forward in (True, False)}
    assert found >= {(False, "rigid", True), (True, "planar", True)}


@pytest.mark.parametrize("forward", [True, False])
def test_slides_and_welds_in_the_plane(forward, tmp_path):
    """A slide on a turning arm, welded to a plate with a point mass pinned to it."""

    def order(*ends):
        return list(ends if forward else ends[::-1])

    c, s = np.cos(0.4), np.sin(0.4)
    rod, plate = np.array([0.9 * c, 0.9 * s]), np.array([1.1 * c, 1.1 * s])
    turned = np.array([[np.cos(0.9), -np.sin(0.9)], [np.sin(0.9), np.cos(0.9)]])
    raw = {
        "mechanism": {"name": "slide", "space": "planar", "gravity": [0.3, -9.81]},
        "bodies": {
            "arm": {"mass": 1.2, "inertia": 0.2, "centre_of_mass": [0.3, 0.05], "angle": 0.4, "angular_velocity": 1.1},
            "rod": {
                **{"mass": 0.7, "inertia": 0.05, "centre_of_mass": [0.1, -0.02], "angle": 0.4},
                **{"position": rod.tolist()},
            },
            "plate": {"mass": 0.5, "inertia": 0.03, "angle": 0.9, "position": plate.tolist()},
            "bob": {"type": "point", "mass": 0.4, "position": (plate + turned @ [0.2, 0.1]).tolist()},
        },
        "joints": {
            "pin": {"type": "revolute", "between": order("ground", "arm"), "at": [[0.0, 0.0], [0.0, 0.0]]},
            "slide": {
                **{"type": "translational", "between": order("arm", "rod"), "axis": [1.0, 0.0]},
                **{"at": [[0.0, 0.0], [0.0, 0.0]]},
            },
            "weld": {
                **{"type": "rigid", "between": order("rod", "plate"), "at": order([0.2, 0.0], [0.0, 0.0])},
                "angle": 0.5 if forward else -0.5,
            },
            "knot": {"type": "revolute", "between": order("plate", "bob"), "at": order([0.2, 0.1], [0.0, 0.0])},
        },
        "forces": {
            "spring": {
                **{"type": "spring-damper", "between": ["ground", "rod"], "at": [[0.0, 0.3], [0.0, 0.0]]},
                **{"stiffness": 40.0, "damping": 2.0, "free_length": 0.5},
            }
        },
    }
    mechanism = model_of(raw, tmp_path).mechanism
    assert not spanning_tree(mechanism).cut
    assert {link.forward for link in spanning_tree(mechanism).links} == {forward}
    compare_with_plain(raw, mechanism)


@pytest.mark.slow
@pytest.mark.slow_cases("False")
@pytest.mark.parametrize("forward", [True, False])
def test_welds_in_space(forward, tmp_path):
    """Two bodies welded to each other on a hinge, with another hinge and a point mass behind them."""

    def order(*ends):
        return list(ends if forward else ends[::-1])

    raw = {
        "mechanism": {"name": "weld", "space": "spatial", "gravity": [0.5, -1.0, -9.0]},
        "bodies": {
            "a": {"mass": 1.5, "inertia": [0.2, 0.3, 0.4], "centre_of_mass": [0.1, 0.2, 0.0]},
            "b": {"mass": 0.8, "inertia": [0.1, 0.2, 0.15], "position": [0.5, 0.2, 0.1]},
            "c": {"mass": 0.6, "inertia": [0.05, 0.06, 0.07], "position": [0.5, 0.9, 0.1]},
            "bob": {"type": "point", "mass": 0.3, "position": [0.8, 0.9, 0.1]},
        },
        "joints": {
            "hinge": {
                **{"type": "revolute", "between": order("ground", "a"), "at": [[0.0, 0.0, 0.0], [0.0, 0.0, 0.0]]},
                "axis": [0.0, 0.0, 1.0],
            },
            "glue": {"type": "rigid", "between": order("a", "b"), "at": order([0.5, 0.2, 0.1], [0.0, 0.0, 0.0])},
            "knee": {
                **{"type": "revolute", "between": order("b", "c"), "at": order([0.0, 0.7, 0.0], [0.0, 0.0, 0.0])},
                "axis": [0.6, 0.0, 0.8],
            },
            "ball": {"type": "spherical", "between": order("c", "bob"), "at": order([0.3, 0.0, 0.0], [0.0, 0.0, 0.0])},
        },
    }
    raw["bodies"]["a"]["angular_velocity"] = [0.0, 0.0, 1.3]
    mechanism = model_of(raw, tmp_path).mechanism
    assert not spanning_tree(mechanism).cut
    compare_with_plain(raw, mechanism)


@pytest.mark.slow_cases("andrews")
@pytest.mark.parametrize("name", ["four-bar", "andrews", "spatial-slider-crank"])
def test_the_metric_of_bodies_is_their_identity_pulled_back(name):
    """The correction is the shortest change of the velocities of bodies: W = B^T B, B column by column."""
    mechanism = load(name).mechanism
    settings = Settings(method="direct-correction", coordinates="joint", options={"method.weight": "body"})
    run = prepare(mechanism, settings).tree
    info, compiled, start = run.bodies.info, run.compiled, run.start
    own, y, p, w = compiled.info, start.y.copy(), start.p.copy(), start.w.copy()

    def speeds(v: np.ndarray) -> np.ndarray:
        state, out = y.copy(), np.zeros(info.nq + 2 * info.nv)
        state[own.nq : own.nq + own.nv] = v
        plain_function(compiled.model.bodies)(0.0, state, p, w.copy(), np.zeros(own.ny), out)
        return out[info.nq : info.nq + info.nv]

    still = speeds(np.zeros(own.nv))
    b = np.array([speeds(unit) - still for unit in np.eye(own.nv)]).T
    plain_function(compiled.law_module.geometry)(0.0, y, p, w)
    d, residual = compiled.jacobian(w), np.cos(np.arange(own.m) + 0.3)
    compiled.section(w, "residual")[:] = residual
    plain_function(compiled.law_module.spread)(p, w)
    inverse = np.linalg.inv(b.T @ b)
    expected = -inverse @ d.T @ np.linalg.solve(d @ inverse @ d.T, residual)
    found = compiled.section(w, "change")
    # both invert D W^-1 D^T, whose condition is some 1e4 here
    np.testing.assert_allclose(found, expected, rtol=0.0, atol=1e-9 * float(np.abs(expected).max()))
    unweighed = -np.linalg.pinv(d) @ residual
    assert np.abs(unweighed - expected).max() > 1e-6 * np.abs(expected).max(), "the metric matters here"

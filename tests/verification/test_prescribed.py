"""Drivers of joints of a tree: their coordinates leave the state, and bodies move as where each driver has a row.

The judge is the mechanism in coordinates of bodies, whose rows, multipliers and work know nothing of trees.
"""

import numpy as np
import pytest

from symgen.base.settings import Settings
from symgen.run.compiling.choices import mechanism_on_tree
from symgen.run.planning.plan import Purpose
from symgen.run.planning.prepare import prepare
from verification.running import model_of, of_bodies, rates

#: Starts are closed to 1e-13 or so; accelerations and powers of such mechanisms follow them to some digits less.
CLOSED, MOVED = 1e-10, 1e-8


def driver(joint: str, value: str, coordinate: str = "") -> dict:
    return {"type": "driver", "joint": joint, "value": value} | ({"coordinate": coordinate} if coordinate else {})


def planar(flip: bool) -> dict:
    """Arms, slides and a plate: driven against each other, against the ground, and not at all."""

    def order(*ends):
        return list(ends[::-1] if flip else ends)

    def body(mass: float, **more: object) -> dict:
        return {"mass": mass, "inertia": 0.1 * mass, "centre_of_mass": [0.1 * mass, 0.05], **more}

    def pin(a: str, b: str, at: list[float]) -> dict:
        return {"type": "revolute", "between": order(a, b), "at": order(at, [0.0, 0.0])}

    return {
        "mechanism": {"name": "driven", "space": "planar", "gravity": [0.4, -9.81]},
        "bodies": {
            "arm": body(1.2, angle=0.3, angular_velocity=0.8),
            "fore": body(0.9, angle=0.8, position=[0.5, 0.2]),
            "hand": body(0.4, angle=1.0, position=[0.8, 0.6]),
            "rod": body(0.6, angle=0.8, position=[0.9, 0.5]),
            "tip": {"type": "point", "mass": 0.3, "position": [1.2, 0.7]},
            "wheel": body(0.7, angle=-0.4, position=[0.3, -0.2], angular_velocity=1.5),
            "flag": body(0.5, angle=0.2, position=[0.6, -0.3], angular_velocity=-0.4),
            "tail": body(0.5, angle=0.9, position=[0.7, 0.1], angular_velocity=0.3),
        },
        "joints": {
            "shoulder": pin("ground", "arm", [0.0, 0.0]),
            "elbow": pin("arm", "fore", [0.5, 0.1]),
            "wrist": pin("fore", "hand", [0.4, 0.0]),
            "slide": {
                **{"type": "translational", "between": order("fore", "rod"), "axis": [1.0, 0.0]},
                "at": [[0.0, 0.0], [0.0, 0.0]],
            },
            "knot": pin("rod", "tip", [0.3, 0.1]),
            "hub": pin("arm", "wheel", [0.2, -0.3]),
            "pole": pin("wheel", "flag", [0.3, 0.0]),
            "end": pin("hand", "tail", [0.2, 0.1]),
            "elbow_motor": driver("elbow", "0.5 + 0.7*t + 0.3*t**2"),
            "wrist_motor": driver("wrist", "0.2 - 0.4*t + 0.2*sin(3*t)"),
            "piston": driver("slide", "0.4 + 0.5*t - 0.6*t**2"),
            "wheel_motor": {
                "type": "driver",
                "body": "wheel",
                "coordinate": "theta",
                "value": "-0.4 + 1.5*t + 0.9*t**2",
            },
        },
        "forces": {
            "spring": {
                **{"type": "spring-damper", "between": ["ground", "tip"], "at": [[0.0, 0.9], [0.0, 0.0]]},
                **{"stiffness": 30.0, "damping": 1.5, "free_length": 0.4},
            },
            "friction": {"type": "torsional-spring-damper", "between": ["arm", "fore"], "damping": 0.7},
        },
    }


def spatial(flip: bool) -> dict:
    """A chain with a hinge, a cross, a screw, a cylinder, a slide and a ball; motors on most of their coordinates."""

    def order(*ends):
        return list(ends[::-1] if flip else ends)

    def body(k: int, at: list[float], **more: object) -> dict:
        inertia = [0.1 + 0.01 * k, 0.12, 0.14, 0.01, -0.02, 0.015]
        return {
            "mass": 0.5 + 0.1 * k,
            "inertia": inertia,
            "centre_of_mass": [0.1, 0.02 * k, -0.1],
            "position": at,
            **more,
        }

    def joint(kind: str, a: str, b: str, at: list[float], **more: object) -> dict:
        return {"type": kind, "between": order(a, b), "at": order(at, [0.0, 0.0, 0.0]), **more}

    return {
        "mechanism": {"name": "driven3", "space": "spatial", "gravity": [0.4, 1.0, -9.81]},
        "bodies": {
            "base": body(0, [0.0, 0.0, 0.0], angular_velocity=[0.0, 0.0, 0.6]),
            "link": body(1, [0.3, 0.0, 0.1]),
            "yoke": body(2, [0.3, 0.4, 0.1]),
            "nut": body(3, [0.5, 0.4, 0.3]),
            "bush": body(4, [0.2, -0.3, 0.2]),
            "sled": body(5, [0.2, -0.6, 0.2]),
            "ball": body(6, [0.5, 0.7, 0.3], angular_velocity=[0.3, -0.5, 0.2]),
        },
        "joints": {
            "turn": joint("revolute", "ground", "base", [0.0, 0.0, 0.0], axis=[0.0, 0.0, 1.0]),
            "hinge": joint("revolute", "base", "link", [0.3, 0.0, 0.1], axis=[0.6, 0.0, 0.8]),
            "cross": joint("universal", "link", "yoke", [0.0, 0.4, 0.0], axes=order([1.0, 0.0, 0.0], [0.0, 0.0, 1.0])),
            "thread": joint("screw", "yoke", "nut", [0.2, 0.0, 0.2], axis=[0.0, 0.6, 0.8], pitch=0.3),
            "sleeve": joint("cylindrical", "base", "bush", [0.2, -0.3, 0.2], axis=[0.0, 1.0, 0.0]),
            "rail": joint("translational", "bush", "sled", [0.0, -0.3, 0.0], axis=[1.0, 0.0, 0.0]),
            "socket": joint("spherical", "nut", "ball", [0.0, 0.3, 0.0]),
            "hinge_motor": driver("hinge", "0.9*t + 0.4*t**2"),
            "cross_motor": driver("cross", "-0.5*t + 0.3*t**2", "angle2"),
            "thread_motor": driver("thread", "0.7*t - 0.2*t**2", "angle"),
            "sleeve_motor": driver("sleeve", "0.3*t + 0.5*t**2", "displacement"),
            "rail_motor": driver("rail", "-0.4*t + 0.6*t**2"),
        },
        "forces": {
            "spring": {
                **{"type": "spring-damper", "between": ["ground", "ball"], "at": [[0.0, 0.0, 1.0], [0.0, 0.1, 0.0]]},
                **{"stiffness": 20.0, "damping": 1.0, "free_length": 0.4},
            },
        },
    }


@pytest.mark.by_turns(6)
@pytest.mark.slow_cases("planar-True", "planar-False")
@pytest.mark.parametrize("flip", [False, True])
@pytest.mark.parametrize("make", [planar, pytest.param(spatial, marks=pytest.mark.slow)])
def test_driven_trees_move_as_bodies_with_rows_do(make, flip, tmp_path):
    model = model_of(make(flip), tmp_path)
    drivers = [joint.name for joint in model.mechanism.joints if joint.kind == "driver"]
    run = prepare(model.mechanism, Settings(method="lagrange", coordinates="joint"), Purpose.STATE).tree
    if not flip:
        assert [x.driver for x in run.topology.prescribed] == drivers
    assert len(run.topology.prescribed) >= 3
    info, own = run.bodies.info, run.compiled.info
    in_tree, in_bodies, found = rates(run.compiled, run.start), rates(run.bodies, run.body_start), of_bodies(run)
    n = info.nq + info.nv
    np.testing.assert_allclose(found[:n], run.body_start.y[:n], rtol=CLOSED, atol=CLOSED)
    expected = in_bodies[info.nq : n]
    np.testing.assert_allclose(found[n:], expected, rtol=0.0, atol=MOVED * float(np.abs(expected).max()))
    assert in_tree[own.work] == pytest.approx(in_bodies[info.work], rel=MOVED)
    assert abs(in_tree[own.work]) > 1.0, "the motors do work"


@pytest.mark.by_turns(8)
@pytest.mark.parametrize(
    "method",
    [
        *(pytest.param(m, marks=pytest.mark.slow) for m in ("augmented-hamiltonian", "null-space", "udwadia-kalaba")),
        pytest.param("direct-correction", marks=pytest.mark.slow),
    ],
)
def test_work_of_motors_balances_the_energy(method, tmp_path):
    model = model_of(spatial(False), tmp_path)
    result = model.simulate(method=method, coordinates="joint", until=0.2, step=1e-3, max_energy_error=1e-6)
    assert result.status == "ok"
    other = model.simulate(method="direct-correction", coordinates="absolute", until=0.2, step=1e-3)
    # RK4 at this step is off by some 1e-10 in both
    np.testing.assert_allclose(np.asarray(result.q)[-1], np.asarray(other.q)[-1], atol=1e-7)


def test_a_state_keeps_one_coordinate(tmp_path):
    """Where motors drive everything, the last one keeps its row."""
    raw = planar(False)
    keep = {"shoulder", "elbow", "elbow_motor"}
    raw["bodies"] = {name: raw["bodies"][name] for name in ("arm", "fore")}
    raw["joints"] = {name: joint for name, joint in raw["joints"].items() if name in keep}
    raw["joints"]["shoulder_motor"] = driver("shoulder", "0.3 + 0.8*t")
    del raw["forces"]["spring"]
    carried = mechanism_on_tree(model_of(raw, tmp_path).mechanism)
    assert carried.topology is not None
    assert [x.driver for x in carried.topology.prescribed] == ["elbow_motor"]
    assert carried.topology.cut == ("shoulder_motor",)


@pytest.mark.slow
def test_a_second_driver_of_a_coordinate_keeps_its_row(tmp_path):
    raw = planar(False)
    raw["joints"]["again"] = driver("elbow", "0.5 + 0.7*t + 0.3*t**2")
    model = model_of(raw, tmp_path)
    carried = mechanism_on_tree(model.mechanism)
    assert carried.topology is not None
    assert "again" in carried.topology.cut
    result = model.simulate(method="direct-correction", coordinates="joint", until=0.05, step=1e-3)
    assert result.status == "ok"

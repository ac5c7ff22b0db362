"""Each spatial joint lets through the motion it is named for, holds everything else, and pushes as it says it does."""

import math

import numpy as np
import pytest
from support.checks import close
from support.emitted import mechanism_of
from support.graph_values import node_values, state_inputs
from support.space import rotation, skew, triad, unit

from symgen.derive.formulate.formulate import formulate
from symgen.describe.formulas.evaluate import scalar_values
from symgen.describe.formulas.start import euler_parameters_of_matrix


def turn(axis, angle):
    """Rotation matrix by Rodrigues' formula."""
    k = skew(unit(axis))
    return np.eye(3) + math.sin(angle) * k + (1.0 - math.cos(angle)) * k @ k


X, Y, Z = np.eye(3)
#: kind -> (key of the axis, rows, motion of the second body's joint frame against the first's from two numbers, in the
#: joint's axes of which z is the axis: rotation, shift; and the coordinates these numbers are).
MOTIONS = {
    "spherical": (None, 3, lambda a, s: (turn([0.3, -0.8, 0.5], a) @ turn(X, s), np.zeros(3), {})),
    "revolute": ("axis", 5, lambda a, s: (turn(Z, a), np.zeros(3), {"angle": a})),
    "cylindrical": ("axis", 4, lambda a, s: (turn(Z, a), s * Z, {"angle": a, "displacement": s})),
    "translational": ("axis", 5, lambda a, s: (np.eye(3), s * Z, {"displacement": s})),
    "rigid": ("axis", 6, lambda a, s: (np.eye(3), np.zeros(3), {})),
    "planar": ("normal", 3, lambda a, s: (turn(Z, a), s * X - 0.4 * s * Y, {"angle": a})),
    "screw": (
        "axis",
        5,
        lambda a, s: (turn(Z, a), 0.2 * a / math.tau * Z, {"angle": a, "displacement": 0.2 * a / math.tau}),
    ),
    "universal": ("axes", 4, lambda a, s: (turn(Z, a) @ turn(X, s), np.zeros(3), {"angle1": a, "angle2": s})),
    "constant-velocity": ("axis", 4, lambda a, s: (turn([math.cos(a), math.sin(a), 0.0], s), np.zeros(3), {})),
}
SETTINGS = [(0.7, 0.4), (-2.5, 1.2), (1.9, -0.8)]


class Pair:
    """Two bodies in the position in which a joint is made, and in those that its motion leads to."""

    def __init__(self, kind, seed, reference=False):
        rng = np.random.default_rng(seed)
        self.kind, (key, self.rows, self.motion) = kind, MOTIONS[kind]
        self.at = rng.uniform(-1.0, 1.0, (2, 3)).round(3)
        self.place, self.turned = rng.uniform(-1.0, 1.0, 3), rotation(unit(rng.normal(size=4)))
        axis, across = rng.uniform(-1.0, 1.0, (2, 3)).round(3)
        self.frames = triad(axis, across), rotation(unit(rng.normal(size=4)))  # of the joint in either body
        keys = {"type": kind, "between": ["a", "b"], "at": self.at.tolist()}
        if key == "axes":
            keys[key] = [axis.tolist(), self.frames[1][:, 0].tolist()]
        elif reference and key:
            keys |= {key: [f[:, 2].tolist() for f in self.frames], "reference": [f[:, 0].tolist() for f in self.frames]}
        elif key:
            keys[key] = axis.tolist()
        keys |= {"pitch": 0.2} if kind == "screw" else {}
        q = self.state(0.0, 0.0)[0]
        bodies = {
            name: {
                "mass": 1.0,
                "inertia": [1.0, 1.0, 1.0],
                "position": part[:3],
                "orientation": {"quaternion": part[3:]},
            }
            for name, part in (("a", q[:7]), ("b", q[7:]))
        }
        head = {"mechanism": {"name": "pair", "space": "spatial"}, "bodies": bodies, "joints": {"J": keys}}
        self.equations = formulate(mechanism_of(head))

    def state(self, a, s):
        """(q, coordinates) with the joint at a and s."""
        turned, shift, coordinates = self.motion(a, s)
        matrix = self.turned @ self.frames[0] @ turned @ self.frames[1].T
        place = self.place + self.turned @ (self.at[0] + self.frames[0] @ shift) - matrix @ self.at[1]
        poses = [
            [*p, *euler_parameters_of_matrix(tuple(map(tuple, m)), scalar_values({}))]
            for p, m in ((self.place, self.turned), (place, matrix))
        ]
        return [float(x) for pose in poses for x in pose], coordinates

    def values(self, q):
        """(Phi, D, coordinates) of the graph."""
        e, g = self.equations, self.equations.graph
        inputs = state_inputs(0.0, q, [0.0] * 12) | {("winding", i): 0.0 for i in range(len(e.windings))}
        d = np.zeros((e.m, 12))
        for i, row in enumerate(e.rows):
            d[i, [j for j, _ in row.entries]] = node_values(g, [n for _, n in row.entries], inputs)
        labels = [c.name.removeprefix("J.") for c in e.joint_coordinates]
        found = dict(zip(labels, node_values(g, [c.value for c in e.joint_coordinates], inputs), strict=True))
        return np.array(node_values(g, [r.phi for r in e.rows], inputs)), d, found


@pytest.mark.parametrize("reference", [False, True], ids=["as-they-start", "by-reference"])
@pytest.mark.parametrize("kind", MOTIONS)
def test_motion_of_a_joint(kind, reference):
    pair = Pair(kind, len(kind), reference)
    for a, s in [(0.0, 0.0), *SETTINGS]:
        q, expected = pair.state(a, s)
        phi, d, found = pair.values(q)
        close(phi, np.zeros(pair.rows), f"{kind} at {a}, {s}", 1e-13)
        assert np.linalg.matrix_rank(d, tol=1e-6) == pair.rows, "no row repeats another one"
        for label, value in expected.items():
            assert found[label] == pytest.approx(value, abs=1e-12), label
        if kind == "planar":
            assert math.hypot(found["displacement1"], found["displacement2"]) == pytest.approx(
                s * math.hypot(1, 0.4) * np.sign(s)
            )
    far, _ = pair.state(0.3, 0.2)
    far[9] += 0.05  # the second body is moved and turned out of the joint
    far[11] += 0.05
    assert np.abs(pair.values(far)[0]).max() > 1e-3


@pytest.mark.parametrize("kind", ["spherical", "revolute", "cylindrical", "translational", "rigid", "planar"])
def test_force_on_the_first_body(kind):
    """A multiplier of 1: force along a direction through the second body's point, or torque about one."""
    pair = Pair(kind, 7 + len(kind), reference=True)
    q, _ = pair.state(0.7, 0.4)
    _, d, _ = pair.values(q)
    u = pair.turned @ pair.frames[0]
    matrix_b = rotation(np.array(q[10:14]))
    point = np.array(q[7:10]) + matrix_b @ pair.at[1]
    forces = {"x": X, "y": Y, "z": Z, "across1": u[:, 0], "across2": u[:, 1], "normal": u[:, 2]}
    torques = {"first": u[:, 0], "second": u[:, 1], "angle": u[:, 2]}
    for row, name in zip(d, [r.name.removeprefix("J.") for r in pair.equations.rows], strict=True):
        force, torque = -row[:3], pair.turned @ -row[3:6] - np.cross(point - pair.place, -row[:3])
        close(force, forces.get(name, np.zeros(3)), f"force of {name}", 1e-12)
        close(torque, torques.get(name, np.zeros(3)), f"torque of {name}", 1e-12)


def test_shafts_of_a_constant_velocity_joint_turn_alike():
    """D v = 0 with both shafts in fixed bearings: the same speed about either shaft, bent by any angle."""
    pair = Pair("constant-velocity", 3)
    for bend in (0.0, 0.5, 1.4):
        q, _ = pair.state(0.9, bend)
        _, d, _ = pair.values(q)
        shafts = pair.frames[0][:, 2], pair.frames[1][:, 2]
        twist = d[3]
        assert twist[3:6] @ shafts[0] == pytest.approx(-twist[9:12] @ shafts[1], abs=1e-12)
        assert abs(twist[3:6] @ shafts[0]) > 0.1

"""Random mechanisms that close: joints put where bodies stand, then the bodies described a little off that.

The parameter ``shake`` says how far off they are described, ``turning`` scales the velocities that are given; both vary
from start to start without another mechanism.
"""

from typing import Any

import numpy as np

PARAMETERS = {"shake": 0.02, "turning": 1.0}


def rotation(vector):
    """The matrix of a rotation vector, by Rodrigues' formula."""
    angle = float(np.linalg.norm(vector))
    x, y, z = vector / angle
    k = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
    return np.eye(3) + np.sin(angle) * k + (1.0 - np.cos(angle)) * k @ k


def shaken(value, by):
    return f"{float(value)!r} + {float(by)!r}*shake"


class Pose:
    """Where a body stands when the mechanism is closed."""

    def __init__(self, rng, space):
        self.place = rng.uniform(-1.0, 1.0, 3 if space == "spatial" else 2)
        self.vector = rng.uniform(-1.5, 1.5, 3)
        self.angle = float(rng.uniform(-3.0, 3.0))
        c, s = np.cos(self.angle), np.sin(self.angle)
        self.turned = rotation(self.vector) if space == "spatial" else np.array([[c, -s], [s, c]])

    def point(self, place):
        """A place in the frame of the body."""
        return (self.turned.T @ (place - self.place)).tolist()

    def along(self, direction):
        return (self.turned.T @ direction).tolist()


def make(seed: int, space: str = "planar", redundant: bool = False, held_velocity: bool = False) -> dict[str, Any]:
    """Return a description: a tree of bodies with loops closed by bars, at least one degree of freedom left.

    Parameters
    ----------
    seed : int
        Of the random numbers.
    space : {"planar", "spatial"}
        In space with joints whose angles count turns, a driver, a gear and a torsional spring.
    redundant : bool
        Whether a joint is doubled by another one that asks for the same.
    held_velocity : bool
        Whether velocities are given that contradict the joints.
    """
    rng = np.random.default_rng(seed)
    count = int(rng.integers(2, 4))
    poses = [Pose(rng, space) for _ in range(count)]
    dimension = 3 if space == "spatial" else 2
    bodies, joints = {}, {}
    for i, pose in enumerate(poses):
        keys: dict[str, Any] = {"mass": float(rng.uniform(0.5, 2.0))}
        keys["position"] = [shaken(x, rng.uniform(-1.0, 1.0)) for x in pose.place]
        if space == "spatial":
            keys["inertia"] = rng.uniform(0.2, 0.3, 3).tolist()
            vector = [shaken(x, rng.uniform(-1.0, 1.0)) for x in pose.vector]
            keys["orientation"] = {"rotation_vector": vector}
        else:
            keys["inertia"], keys["angle"] = float(rng.uniform(0.1, 0.5)), shaken(pose.angle, rng.uniform(-1.0, 1.0))
        if i == 0 or held_velocity:
            turning = [f"{x!r}*turning" for x in rng.uniform(-1.0, 1.0, 3).tolist()]
            keys["angular_velocity"] = turning if space == "spatial" else turning[0]
        bodies[f"b{i}"] = keys
    ground = Pose(rng, space)
    ground.place, ground.turned = np.zeros(dimension), np.eye(dimension)
    frames = {"ground": ground, **{f"b{i}": pose for i, pose in enumerate(poses)}}

    def joint(name: str, kind: str, a: str, b: str) -> None:
        at = rng.uniform(-1.0, 1.0, dimension)
        joints[name] = {"type": kind, "between": [a, b], "at": [frames[f].point(at) for f in (a, b)]}
        if kind in ("cylindrical", "revolute", "screw", "translational") and space == "spatial":
            axis, across = np.linalg.qr(rng.normal(size=(3, 3)))[0][:2]
            joints[name]["axis"] = [frames[f].along(axis) for f in (a, b)]
            joints[name]["reference"] = [frames[f].along(across) for f in (a, b)]
            if kind == "screw":
                joints[name]["pitch"] = 0.3
        elif kind == "translational":
            direction = rng.normal(size=2)
            joints[name]["axis"] = frames[a].along(direction)
            joints[name]["angle"] = frames[b].angle if a == "ground" else frames[b].angle - frames[a].angle

    def bar(name: str, a: str, b: str) -> None:
        ends = rng.uniform(-1.0, 1.0, (2, dimension))
        at = [frames[f].point(end) for f, end in zip((a, b), ends, strict=True)]
        joints[name] = {
            "type": "distance",
            "between": [a, b],
            "at": at,
            "length": float(np.linalg.norm(ends[0] - ends[1])),
        }

    kinds = ["revolute", "cylindrical", "screw", "spherical"] if space == "spatial" else ["revolute", "translational"]
    for i in range(count):
        first = "ground" if i == 0 else ["ground", *bodies][int(rng.integers(0, i + 1))]
        joint(f"j{i}", "revolute" if i == 0 else kinds[int(rng.integers(len(kinds)))], first, f"b{i}")
    if count > 2 or space == "spatial":
        bar("bar", "ground", f"b{count - 1}")
    if redundant:
        place = np.array(joints["j0"]["at"][0])
        if space == "spatial":  # another point of the axis about which the first body turns stays where it is as well
            place = place + 0.3 * np.array(joints["j0"]["axis"][0])
            joints["again"] = {**joints["j0"], "type": "spherical", "at": [place.tolist(), poses[0].point(place)]}
            del joints["again"]["axis"], joints["again"]["reference"]
        else:  # a bar that cannot stretch, as one of its ends is what the body turns about
            far = place + rng.uniform(-1.0, 1.0, 2)
            ends = {"between": ["ground", "b0"], "at": [place.tolist(), poses[0].point(far)]}
            joints["again"] = {"type": "distance", **ends, "length": float(np.linalg.norm(far - place))}
    description = {
        "mechanism": {"name": f"closed-{space}-{seed}", "space": space},
        "parameters": PARAMETERS,
        "bodies": bodies,
        "joints": joints,
    }
    if space == "spatial":
        description["forces"] = {"spring": {"type": "torsional-spring-damper", "joint": "j0", "stiffness": 3.0}}
    return description

"""Trees of joints of the sizes of Pinocchio's samples, written here: an arm, a free body with limbs, balls.

An arm of six hinges and a free body with two legs, two arms, a torso and a neck (34 velocities), each with limbs of any
shape and with rods as the samples have, and a tree of balls and hinges.
"""

from __future__ import annotations

import tempfile
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from benchmarks.mechanisms.toml import text
from symgen.api import load
from symgen.describe.mechanism import Mechanism

Array = NDArray[np.float64]

GRAVITY = 9.81
AXES = {"x": (1.0, 0.0, 0.0), "y": (0.0, 1.0, 0.0), "z": (0.0, 0.0, 1.0)}


@dataclass(frozen=True)
class Limb:
    """A body and the joint that carries it.

    Attributes
    ----------
    name, parent : str
        The body, and what carries it, ``""`` for the ground.
    joint : str
        ``x``, ``y``, ``z`` for a hinge about that axis, ``ball``, ``free``.
    at : tuple of float
        The joint in the frame of what carries it [m]; all frames are parallel where angles are 0.
    mass : float
        [kg]
    centre : tuple of float
        [m]
    inertia : tuple of float
        About the centre of mass: xx, yy, zz, xy, xz, yz [kg m^2].
    """

    name: str
    parent: str
    joint: str
    at: tuple[float, float, float]
    mass: float
    centre: tuple[float, float, float]
    inertia: tuple[float, ...]


def limb_of(name: str, parent: str, joint: str, at: tuple[float, float, float], index: int) -> Limb:
    """Return a limb with masses and inertias of no symmetry, the same ones at every call."""
    rng = np.random.default_rng(1000 + index)
    mass = round(0.5 + 3.0 * rng.random(), 6)
    centre = (0.0, 0.0, 0.0) if joint == "free" else tuple(np.round(0.2 * rng.standard_normal(3), 6))
    root = rng.standard_normal((3, 3))
    spread = root @ root.T / 3.0 + np.eye(3)  # second moments of mass, so that no axis has more than the other two
    shape = 0.01 * mass * (np.trace(spread) * np.eye(3) - spread)
    own = tuple(round(float(shape[i, j]), 9) for i, j in ((0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2)))
    return Limb(name, parent, joint, at, mass, (float(centre[0]), float(centre[1]), float(centre[2])), own)


def arm() -> list[Limb]:
    """Return an arm of six hinges."""
    chain, parent = list[Limb](), ""
    places = ((0.0, 0.0, 0.3), (0.0, 0.0, 0.1), (0.4, 0.0, 0.0), (0.3, 0.0, 0.0), (0.1, 0.0, 0.0), (0.1, 0.0, 0.0))
    for k, (axis, at) in enumerate(zip("zyyxyx", places, strict=True)):
        chain.append(limb_of(f"link{k}", parent, axis, at, k))
        parent = f"link{k}"
    return chain


def humanoid() -> list[Limb]:
    """Return a free body with 28 hinges: 34 velocities."""
    limbs = [limb_of("pelvis", "", "free", (0.0, 0.0, 0.0), 20)]

    def chain(stem: str, root: str, at: tuple[float, float, float], axes: str, step: tuple[float, float, float]) -> str:
        parent = root
        for k, axis in enumerate(axes):
            place = at if k == 0 else (step if k in (3, 4) else (0.0, 0.0, 0.0))
            limbs.append(limb_of(f"{stem}{k}", parent, axis, place, 20 + len(limbs)))
            parent = f"{stem}{k}"
        return parent

    for side, y in (("left", 0.1), ("right", -0.1)):
        chain(f"{side}leg", "pelvis", (0.0, y, -0.1), "zxyyyx", (0.0, 0.0, -0.4))
    chest = chain("chest", "pelvis", (0.0, 0.0, 0.3), "zy", (0.0, 0.0, 0.0))
    for side, y in (("left", 0.2), ("right", -0.2)):
        chain(f"{side}arm", chest, (0.0, y, 0.3), "yxzyzy", (0.0, 0.0, -0.3))
    chain("head", chest, (0.0, 0.0, 0.4), "zy", (0.0, 0.0, 0.0))
    return limbs


def balls() -> list[Limb]:
    """Return a tree of balls and hinges on a free body."""
    return [
        limb_of("base", "", "free", (0.0, 0.0, 0.0), 60),
        limb_of("upper", "base", "ball", (0.2, 0.1, -0.3), 61),
        limb_of("lower", "upper", "y", (0.0, 0.0, -0.5), 62),
        limb_of("foot", "lower", "ball", (0.1, 0.0, -0.4), 63),
        limb_of("mast", "base", "x", (-0.1, 0.0, 0.4), 64),
        limb_of("bob", "mast", "ball", (0.0, 0.0, 0.5), 65),
    ]


def plain(limbs: list[Limb]) -> list[Limb]:
    """Return limbs that are rods along their own z, as those of Pinocchio's samples are."""
    return [replace(x, centre=(0.0, 0.0, x.centre[2]), inertia=(*x.inertia[:3], 0.0, 0.0, 0.0)) for x in limbs]


TREES = {
    **{"arm": arm(), "arm of rods": plain(arm()), "humanoid": humanoid(), "humanoid of rods": plain(humanoid())},
    "balls": balls(),
}


def mechanism(name: str, limbs: list[Limb]) -> Mechanism:
    """Return a tree as symgen reads it from a file."""
    placed: dict[str, Array] = {"": np.zeros(3)}
    bodies, joints = dict[str, Any](), dict[str, Any]()
    for limb in limbs:
        placed[limb.name] = placed[limb.parent] + limb.at
        bodies[limb.name] = {
            **{"mass": limb.mass, "inertia": list(limb.inertia), "centre_of_mass": list(limb.centre)},
            "position": placed[limb.name].tolist(),
        }
        if limb.joint != "free":
            kind = {"type": "spherical"} if limb.joint == "ball" else {"type": "revolute", "axis": AXES[limb.joint]}
            ends = {"between": [limb.parent or "ground", limb.name], "at": [list(limb.at), [0.0, 0.0, 0.0]]}
            joints[f"j_{limb.name}"] = {**kind, **ends}
    raw = {"mechanism": {"name": name, "space": "spatial", "gravity": [0.0, 0.0, -GRAVITY]}, "bodies": bodies}
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / f"{name}.toml"
        path.write_text(text({**raw, "joints": joints}), encoding="utf-8")
        return load(path).mechanism

"""Planar chains of pins in mechanism files, as the simulation takes them."""

from __future__ import annotations

import math
import tomllib
from pathlib import Path

import numpy as np

from benchmarks.bounded.draw import Drawn
from benchmarks.bounded.rows import Bounded, joint
from benchmarks.bounded.tree import Link, Tree

#: Chains that were hard, and until when they are run [s].
HARD = {
    "chain-stop-and-slip": 4.0,
    "chain-three-of-both": 4.0,
    "chain-stop-and-brake": 4.0,
    "chain-slip-at-a-stop": 2.0,
    "chain-two-stops": 3.5,
}
FOLDER = Path(__file__).parent / "files"


def chain(path: Path) -> Drawn:
    """Return the chain of a file: body k hangs by joint k on point ``z`` of the one before, by its own point ``a``."""
    raw = tomllib.loads(path.read_text(encoding="utf-8"))
    links, rows, u, v = list[Link](), list[Bounded](), list[float](), list[float]()
    angle = rate = 0.0
    joints, before = list(raw["joints"].items()), np.zeros(3)
    for k, (body, (name, table)) in enumerate(zip(raw["bodies"].values(), joints, strict=True)):
        behind, inertia = np.array([*body["points"]["a"], 0.0]), np.diag([0.0, 0.0, body["inertia"]])
        links.append(Link(k - 1, False, np.array([0.0, 0.0, 1.0]), np.eye(3), before, behind, body["mass"], inertia))
        spin = body.get("angular_velocity", 0.0)
        u.append(body["angle"] - angle)
        v.append(spin - rate)
        angle, rate, before = body["angle"], spin, np.array([*body["points"]["z"], 0.0])
        friction, stop = table.get("friction", {}), table.get("stop", {})
        if friction or stop:
            sliding = friction.get("sliding", 0.0)
            bounds = stop.get("lower", -math.inf), stop.get("upper", math.inf), stop.get("restitution", 0.0)
            rows.append(Bounded(name, joint(k), sliding, friction.get("static", sliding), 0.0, *bounds))
    gravity = np.array([*raw["mechanism"]["gravity"], 0.0])
    numbers = {name: k for k, name in enumerate(raw["bodies"])}
    return Drawn(raw, Tree(links, [], gravity), tuple(rows), np.array(u), np.array(v), numbers, frozenset())


def hard(name: str) -> Drawn:
    """Return one of the hard chains."""
    return chain(FOLDER / f"{name}.toml")

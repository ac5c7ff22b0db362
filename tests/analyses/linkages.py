"""Four-bar linkages with a driven crank, as raw descriptions, and what elementary geometry says of them."""

import math
from typing import Any

import numpy as np


def four_bar(
    links: tuple[float, float, float, float],
    start: float,
    drive: str | None,
    masses: tuple[float, float, float] = (1.0, 1.0, 1.0),
    above: bool = True,
) -> dict[str, Any]:
    """Return a four-bar: crank, coupler and rocker are uniform rods between pins A, B, C, D, with A at the origin.

    `links` are the lengths of ground, crank, coupler and rocker; `above` says on which side of the line from B to D the
    pin C begins.
    """
    ground, crank, coupler, rocker = links
    b = crank * np.array([math.cos(start), math.sin(start)])
    c = meeting(b, coupler, np.array([ground, 0.0]), rocker, above)
    ends = {"crank": (np.zeros(2), b), "coupler": (b, c), "rocker": (np.array([ground, 0.0]), c)}
    bodies = {}
    for (name, (near, far)), mass in zip(ends.items(), masses, strict=True):
        length = float(np.linalg.norm(far - near))
        bodies[name] = {
            "mass": mass,
            "inertia": mass * length**2 / 12.0,
            "points": {"near": [-length / 2.0, 0.0], "far": [length / 2.0, 0.0]},
            "position": [float(x) for x in (near + far) / 2.0],
            "angle": math.atan2(*(far - near)[::-1]),
        }
    joints = {
        "A": {"type": "revolute", "between": ["ground", "crank"], "at": [[0.0, 0.0], "near"]},
        "B": {"type": "revolute", "between": ["crank", "coupler"], "at": ["far", "near"]},
        "C": {"type": "revolute", "between": ["coupler", "rocker"], "at": ["far", "far"]},
        "D": {"type": "revolute", "between": ["ground", "rocker"], "at": [[ground, 0.0], "near"]},
    }
    if drive is not None:
        joints["motor"] = {"type": "driver", "joint": "A", "value": drive}
    return {
        "mechanism": {"name": "linkage", "gravity": [0.0, -9.81]},
        "parameters": {"start": start},
        "bodies": bodies,
        "joints": joints,
    }


def meeting(a: Any, ra: float, b: Any, rb: float, left: bool = True) -> Any:
    """Return where two circles meet, on the left of the way from a to b or on its right; shapes (..., 2)."""
    a, b = np.asarray(a, dtype=float), np.asarray(b, dtype=float)
    way = b - a
    d = np.linalg.norm(way, axis=-1)[..., np.newaxis]
    along = (d**2 + ra**2 - rb**2) / (2.0 * d)
    aside = np.sqrt(ra**2 - along**2) * (1.0 if left else -1.0)
    normal = np.stack([-way[..., 1], way[..., 0]], axis=-1)
    return a + (along * way + aside * normal) / d

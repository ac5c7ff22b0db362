"""A sled beside random mechanisms with dry friction: it rubs by its reaction, so that modes are chosen for such a file.

It slides, comes to rest and moves nothing else: what the simulation knows of the mechanism stays true. Stops, ropes and
bodies without inertia are left out, which friction by reactions does not go with.
"""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np

from benchmarks.bounded.draw import GRAVITY, KINDS, Drawn, drawn
from benchmarks.bounded.rows import Bounded

#: Of the sled: friction over its reaction, and the time after which it rests [s].
COEFFICIENT, RESTS = 0.3, 0.6


def sledded(kind: str, seed: int) -> Drawn:
    """Return a random mechanism with friction alone in most of its joints, and a sled beside it."""
    mechanism = drawn(kind, seed)
    rng = np.random.default_rng([len(KINDS) + 2, KINDS.index(kind), seed])
    rows, joints = list[Bounded](), dict[str, dict[str, Any]]()
    known = {row.name: row for row in mechanism.rows}
    for name, table in mechanism.raw["joints"].items():
        joints[name] = {key: value for key, value in table.items() if key != "stop"}
        for full in [row for row in known if row.partition(".")[0] == name]:
            row = known[full]
            if not row.rubs:  # a joint that had a stop alone rubs
                sliding = float(f"{rng.uniform(0.2, 6.0):.4g}")
                static = float(f"{sliding * rng.uniform(1.0, 1.4):.6g}")
                numbers = {"sliding": sliding, "static": static}
                row, label = replace(row, sliding=sliding, static=static), full.partition(".")[2]
                if label:
                    joints[name]["friction"] = {**joints[name].get("friction", {}), label: numbers}
                else:
                    joints[name]["friction"] = numbers
            rows.append(replace(row, lower=-np.inf, upper=np.inf, restitution=0.0))
    spatial = "space" in mechanism.raw["mechanism"]
    zeros = [0.0, 0.0, 0.0] if spatial else [0.0, 0.0]
    along = [1.0, *zeros[1:]]
    speed = COEFFICIENT * GRAVITY * RESTS
    bodies = {name: dict(table) for name, table in mechanism.raw["bodies"].items()}
    bodies["sled"] = {"mass": 1.0, "inertia": [1.0, 1.0, 1.0] if spatial else 1.0, "velocity": [speed, *zeros[1:]]}
    bodies["sled"]["position"] = zeros
    rail = {"type": "translational", "between": ["ground", "sled"], "at": [zeros, zeros], "axis": along}
    joints["rail"] = {**rail, "friction": {"coefficient": COEFFICIENT}}
    raw = {**mechanism.raw, "bodies": bodies, "joints": joints}
    raw.pop("stops", None)
    features = {"sled", "friction", *(mechanism.features & {"push", "cylinder", "closing pin", "closing rod", "light"})}
    return replace(mechanism, raw=raw, rows=tuple(rows), features=frozenset(features))

"""Map from rows of bodies to rows of a tree, by names: coordinates, velocities, turns, gauges."""

from __future__ import annotations

from collections.abc import Iterable

import msgspec
import numpy as np
from numpy.typing import NDArray

from symgen.derive.lower.windings import winding_order
from symgen.describe.mechanism import Mechanism
from symgen.describe.parts.topology import state_names
from symgen.run.layout import abi
from symgen.run.layout.compiled import CompiledModel, ModelInfo
from symgen.run.starts.tree_start import Carrying


def carried_motion(
    mechanism: Mechanism, carried: Mechanism, bodies: CompiledModel, compiled: CompiledModel
) -> Carrying:
    """Return the map from rows of bodies to rows of a tree."""
    assert carried.topology is not None, "it was put on a tree"
    info, own = bodies.info, compiled.info
    places = {x.name: (0, i) for i, x in enumerate((*info.coordinates, *info.velocities))}
    for k, x in enumerate(info.joint_coordinates):
        places |= {x.name: (1, info.m + 2 * k), f"{x.name}.rate": (1, info.m + 2 * k + 1)}
    names, speeds = state_names(carried, carried.topology)
    turned = {m: abi.WINDING + i for i, m in enumerate(winding_order(mechanism, bodies.shape))}
    gauge = info.sections["gauge"][0]

    def integer_array(numbers: Iterable[int]) -> NDArray[np.int64]:
        return np.array(list(numbers), dtype=np.int64)

    return Carrying(
        *(own.work, max(info.observed, info.nq + 2 * info.nv)),
        places=integer_array(x for name, _ in (*names, *speeds) for x in places[name]),
        windings=integer_array(turned[m] for m in winding_order(carried, "straight")),
        gauges=integer_array(-1 if j is None else gauge + j for j in _levers_of_bodies(carried, info)),
        spins=integer_array(first for first, _ in info.spins),
    )


def _levers_of_bodies(carried: Mechanism, info: ModelInfo) -> list[int | None]:
    """Return the velocity that gives each velocity of a tree its length, None for those that are no angles."""
    assert carried.topology is not None, "it has a tree"
    levers = list[int | None]()
    for link in carried.topology.links:
        alone = msgspec.structs.replace(carried.topology, links=(link,))
        own = [j for j, x in enumerate(info.velocities) if x.name.startswith(f"{link.body}.") and x.unit == "rad/s"]
        levers += [own[0] if unit == "rad/s" else None for _, unit in state_names(carried, alone)[1]]
    return levers

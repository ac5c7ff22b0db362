"""An open chain in space: rods on a ball joint and hinges whose axes alternate."""

from __future__ import annotations

import math
from typing import Any

from symgen.base.vocabulary.rotations import EulerParameters, Matrix, composed_rotation, rotate, rotation_matrix_of
from symgen.describe.catalogue import Sized

#: Angle of every hinge at the start [rad]: the chain is curled, so that nothing stays in a plane.
BEND = 0.3


def chain_table(size: int) -> dict[str, Any]:
    """Return the description with `size` rods.

    Square rods of 1 m, 1 kg and 0.1 m, x of each frame along the rod. The first hangs on a ball joint, so that the
    angular momentum about the vertical stays; each further one on a hinge about y or z of the rod before, in turn. The
    chain starts at rest, the first rod horizontal. Two rods or more are chaotic: with four, runs at a tolerance of
    1e-11 part by 1e-7 m in 6 s and by 1 m in 10 s.
    """
    rod = {
        "mass": 1.0,
        "inertia": ["0.02/12", "1.01/12", "1.01/12"],
        "points": {"A": [-0.5, 0.0, 0.0], "B": [0.5, 0.0, 0.0]},
        "velocity": [0.0, 0.0, 0.0],
        "angular_velocity": [0.0, 0.0, 0.0],
    }
    bodies: dict[str, Any] = {}
    joints: dict[str, Any] = {}
    turned: EulerParameters = (1.0, 0.0, 0.0, 0.0)
    end = (0.0, 0.0, 0.0)
    for i in range(size):
        axis = 1 + i % 2
        if i:
            turned = composed_rotation(turned, _half_turn(axis))
        frame: Matrix = rotation_matrix_of(turned)
        middle, tip = rotate(frame, (0.5, 0.0, 0.0)), rotate(frame, (1.0, 0.0, 0.0))
        bodies[f"rod{i + 1}"] = rod | {
            "position": [a + b for a, b in zip(end, middle, strict=True)],
            "orientation": {"quaternion": list(turned)},
        }
        end = (end[0] + tip[0], end[1] + tip[1], end[2] + tip[2])
        if i == 0:
            joints["J1"] = {"type": "spherical", "between": ["ground", "rod1"], "at": [[0.0, 0.0, 0.0], "A"]}
        else:
            joints[f"J{i + 1}"] = {
                "type": "revolute",
                "between": [f"rod{i}", f"rod{i + 1}"],
                "at": ["B", "A"],
                "axis": [float(k == axis) for k in range(3)],
            }
    settings = {"until": 5.0, "step": 1e-3, "output_step": 0.05}
    return {
        "mechanism": {
            "name": f"chain-{size}",
            "title": f"open chain of {size} rod{'s' if size > 1 else ''} on a ball joint and alternating hinges",
            "source": "data chosen for symgen",
            "space": "spatial",
            "gravity": [0.0, 0.0, -9.81],
        },
        "run": settings | ({"predictable_until": 6.0} if size > 1 else {}),
        "bodies": bodies,
        "joints": joints,
    }


def _half_turn(axis: int) -> EulerParameters:
    """Return the turn by `BEND` about y (1) or z (2)."""
    c, s = math.cos(BEND / 2.0), math.sin(BEND / 2.0)
    return (c, 0.0, s, 0.0) if axis == 1 else (c, 0.0, 0.0, s)


KIND = Sized(chain_table, default=4, largest=1000)

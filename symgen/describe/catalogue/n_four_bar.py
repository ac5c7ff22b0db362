"""The N-four-bar of the IFToMM benchmark library (A02): N parallelograms in a row, singular when they are collinear."""

from __future__ import annotations

import math
from typing import Any

from symgen.describe.catalogue import Sized


def four_bars_table(size: int) -> dict[str, Any]:
    """Return the description with `size` windows: size + 1 links on the ground, size couplers on top.

    All links are uniform rods, 1 m and 1 kg. The frame of a vertical link has its x axis along the link, upwards at the
    start; that of a coupler along the coupler. The pin B0 at (0, 1) starts with 1 m/s to the right.
    """
    rod = {"mass": 1.0, "inertia": "1/12", "points": {"A": [-0.5, 0.0], "B": [0.5, 0.0]}}
    bodies: dict[str, Any] = {}
    joints: dict[str, Any] = {}
    for i in range(size + 1):
        bodies[f"vertical{i}"] = rod | {
            "position": [float(i), 0.5],
            "angle": math.pi / 2,
            "velocity": [0.5, 0.0],
            "angular_velocity": -1.0,
        }
        joints[f"A{i}"] = {"type": "revolute", "between": ["ground", f"vertical{i}"], "at": [[float(i), 0.0], "A"]}
        if i < size:
            bodies[f"coupler{i}"] = rod | {
                "position": [i + 0.5, 1.0],
                "angle": 0.0,
                "velocity": [1.0, 0.0],
                "angular_velocity": 0.0,
            }
            joints[f"B{i}"] = {"type": "revolute", "between": [f"vertical{i}", f"coupler{i}"], "at": ["B", "A"]}
        if i > 0:
            joints[f"C{i}"] = {"type": "revolute", "between": [f"coupler{i - 1}", f"vertical{i}"], "at": ["B", "B"]}
    return {
        "mechanism": {
            "name": f"n-four-bar-{size}",
            "title": f"{size} four-bar window{'s' if size > 1 else ''} in a row, singular when collinear",
            "source": "IFToMM benchmark library, problem A02; 10 s there for two windows, 20 s for forty",
            "gravity": [0.0, -9.81],
        },
        "run": {"until": 10.0, "step": 1e-3, "output_step": 0.05},
        "bodies": bodies,
        "joints": joints,
    }


KIND = Sized(four_bars_table, default=2, largest=5000)

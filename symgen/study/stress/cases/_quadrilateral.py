"""A four-bar linkage whose lengths are parameters."""

from __future__ import annotations

import math
from functools import lru_cache

from symgen.describe.builder import MechanismBuilder
from symgen.describe.mechanism import Mechanism

NAMES = ("crank_length", "coupler_length", "rocker_length", "base_length")


@lru_cache(maxsize=64)
def quadrilateral(
    crank: float, coupler: float, rocker: float, base: float, angle: float, spin: float | None = None
) -> Mechanism:
    """Return the linkage with each rod uniform and of 1 kg, closed with the joint of coupler and rocker above.

    Parameters
    ----------
    crank, coupler, rocker, base : float
        Lengths [m]; they are parameters, so all these mechanisms have the same equations.
    angle : float
        Of the crank at the start [rad].
    spin : float, optional
        Of the crank at the start [rad/s].
    """
    bx, by = crank * math.cos(angle), crank * math.sin(angle)
    dx, dy = base - bx, -by
    d = math.hypot(dx, dy)
    along = (d * d + coupler * coupler - rocker * rocker) / (2.0 * d)
    across = math.sqrt(max(0.0, coupler * coupler - along * along))
    cx, cy = bx + (along * dx - across * dy) / d, by + (along * dy + across * dx) / d
    builder = MechanismBuilder("quadrilateral", gravity=(0.0, -9.81)).run(until=5.0, step=1e-3)
    for name, value in zip(NAMES, (crank, coupler, rocker, base), strict=True):
        builder.parameter(name, value, unit="m")
    ends = {
        "crank": ((0.0, 0.0), (bx, by), "A", "B"),
        "coupler": ((bx, by), (cx, cy), "B", "C"),
        "rocker": ((base, 0.0), (cx, cy), "D", "C"),
    }
    for name, (start, end, first, second) in ends.items():
        length = f"{name}_length"
        builder.body(
            name,
            mass=1.0,
            inertia=f"{length}**2/12",
            points={first: (f"-{length}/2", 0.0), second: (f"{length}/2", 0.0)},
            position=((start[0] + end[0]) / 2.0, (start[1] + end[1]) / 2.0),
            angle=math.atan2(end[1] - start[1], end[0] - start[0]),
            **({"angular_velocity": spin or 0.0} if name == "crank" else {}),
        )
    builder.joint("A", "revolute", between=("ground", "crank"), at=((0.0, 0.0), "A"))
    builder.joint("B", "revolute", between=("crank", "coupler"), at=("B", "B"))
    builder.joint("C", "revolute", between=("coupler", "rocker"), at=("C", "C"))
    builder.joint("D", "revolute", between=("ground", "rocker"), at=(("base_length", 0.0), "D"))
    return builder.build()

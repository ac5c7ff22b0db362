"""Reactions of an overconstrained beam: shared like the stiffness of its bars, beside those of minimum norm.

A beam hangs on three parallel bars, of which two determine its motion. Bars that give a little under a load
share it like ``k_i (u + x_i phi)``, u and phi from the balance of forces and moments: a closed form.

    python -m benchmarks.shared_loads
"""

from __future__ import annotations

import sys
from collections.abc import Iterator
from functools import partial

import numpy as np
from numpy.typing import NDArray

from benchmarks.page_tables import PageTable, list_of, print_tables
from symgen.api import Model, load
from symgen.describe import MechanismBuilder

Array = NDArray[np.float64]

LENGTH, MASS, GRAVITY = 2.0, 3.0, 9.81
PLACES = np.array([-1.0, 0.0, 1.0])
#: Stiffness of the bars [N/m].
CASES = ((1e6, 1e6, 1e6), (1e6, 2e6, 1e6), (1e6, 2e6, 5e6), (1e6, 1e6, 1e8))
METHODS = ("stiffness-scaled-penalty", "direct-correction", "udwadia-kalaba")


def beam(stiffness: tuple[float, ...], angle: float = 0.3) -> Model:
    """Return the beam, at rest with its bars turned from the vertical by an angle [rad]."""
    builder = MechanismBuilder("three-bars", gravity=(0.0, -GRAVITY))
    at = (LENGTH * np.sin(angle), -LENGTH * np.cos(angle))
    points = {f"P{i}": (float(x), 0.0) for i, x in enumerate(PLACES)}
    builder.body("beam", mass=MASS, inertia=0.5, position=at, points=points)
    for i, (k, x) in enumerate(zip(stiffness, PLACES, strict=True)):
        keys = {"between": ["ground", "beam"], "at": [(float(x), 0.0), f"P{i}"], "length": LENGTH, "stiffness": k}
        builder.joint(f"bar{i}", "distance", **keys)
    return load(builder.build())


def shares(stiffness: tuple[float, ...], load_: float) -> Array:
    """Return the tensions of bars [N] that together carry a load at the middle, from their elasticity."""
    k = np.array(stiffness)
    balance = np.array([[k.sum(), k @ PLACES], [k @ PLACES, k @ PLACES**2]])
    u, phi = np.linalg.solve(balance, [load_, 0.0])
    return np.asarray(k * (u + phi * PLACES))


def tensions(stiffness: tuple[float, ...], method: str, angle: float = 0.3, until: float = 1.0) -> tuple[Array, Array]:
    """Return the tensions at the start and at the end of a run, and the position of the beam there."""
    result = beam(stiffness, angle).simulate(method=method, until=until, times=[0.0, until])
    if not result.ok:
        raise RuntimeError(f"{method}: {result.reason}")
    return np.asarray(result.lam), np.asarray(result.q)[-1]


def table() -> PageTable:
    """Return the tensions at the start of the motion."""

    def cells(stiffness: tuple[float, ...]) -> Iterator[str]:
        exact = shares(stiffness, MASS * GRAVITY * float(np.cos(0.3)))
        for row in (exact, *(tensions(stiffness, method)[0][0] for method in METHODS)):
            yield ", ".join(f"{x:.4f}" for x in row)

    rows = tuple(
        ((", ".join(f"{k:.0e}".replace("e+0", "e") for k in case),), partial(list_of, cells, case)) for case in CASES
    )
    headings = ("stiffness of the bars [N/m]", "bars that give, closed form", *(f"`{method}`" for method in METHODS))
    return PageTable("shared_loads", "docs/tables/redundant-constraints.md", headings, rows)


if __name__ == "__main__":
    sys.exit(print_tables({"shared_loads": table()}, sys.argv[1:]))

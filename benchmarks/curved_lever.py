"""Make the file of the catalogue's curved lever: a steel arc that rises, of 1 by 1 by 10 quadratic cubes.

python -m benchmarks.curved_lever
"""

from __future__ import annotations

from pathlib import Path

import numpy as np
from numpy.typing import NDArray

import symgen
from benchmarks.finite_elements import Mesh, bend_to_arc, solid
from symgen.describe.reduction.reduction import Reduced

FILE = Path(symgen.__file__).parent / "describe" / "catalogue" / "machines" / "curved-lever.npz"
#: Length, height and width of the lever, the radius of its arc [m], and how far it rises [1/m].
LENGTH, HEIGHT, WIDTH, RADIUS, RISE = 0.4, 0.03, 0.02, 0.3, 0.6
COUNTS = (10, 1, 1)


def mesh() -> Mesh:
    """Return the finite elements."""
    shape = bend_to_arc(RADIUS, RISE)
    return solid((LENGTH, HEIGHT, WIDTH), COUNTS, young=2.1e11, poisson=0.3, density=7850.0, shape=shape)


def stresses(lever: Mesh) -> NDArray[np.float64]:
    """Return the stresses along the lever at the four edges of its first section behind the root, as rows."""
    middle = lever.x[lever.cells[1]].reshape(3, 9, 3).mean(axis=1)
    along = middle[2] - middle[0]
    return np.array([lever.stress(1, (-1.0, y, z), along) for y in (-1.0, 1.0) for z in (-1.0, 1.0)])


def reduced() -> Reduced:
    """Return the lever as a modal body."""
    lever = mesh()
    return symgen.reduced(
        lever.x, lever.mass, lever.stiffness, lever.ends, inner=1, rows={"sigma": (stresses(lever), "Pa")}
    )


if __name__ == "__main__":
    reduced().save(FILE)
    print(FILE.stat().st_size)

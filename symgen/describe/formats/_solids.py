"""Mass and inertia of solids of constant density, centred at the origin of their frame, and of several together."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass

from symgen.base.vocabulary.rotations import scalar_product
from symgen.describe.formats._poses import ORIGIN, Matrix, Vector, scaled_vector, vector_sum


@dataclass(frozen=True)
class SolidMass:
    """A solid: its mass [kg], centre of mass [m], and inertia about it [kg m^2]."""

    mass: float
    centre: Vector
    inertia: Matrix

    def with_density(self, factor: float) -> SolidMass:
        """Return the solid with another density."""
        a, b, c = (scaled_vector(factor, row) for row in self.inertia)
        return SolidMass(factor * self.mass, self.centre, (a, b, c))


def sum_of_solids(solids: Iterable[SolidMass]) -> SolidMass:
    """Return solids as one, by Steiner."""
    solids = list(solids)
    mass, centre = math.fsum(solid.mass for solid in solids), ORIGIN
    if mass > 0.0:
        for solid in solids:
            centre = vector_sum(centre, scaled_vector(solid.mass / mass, solid.centre))
    inertia = [[0.0] * 3 for _ in range(3)]
    for solid in solids:
        arm = vector_sum(solid.centre, scaled_vector(-1.0, centre))
        for i in range(3):
            for j in range(3):
                far = scalar_product(arm, arm) * (i == j) - arm[i] * arm[j]
                inertia[i][j] += solid.inertia[i][j] + solid.mass * far
    (a, b, c), (d, e, f), (g, h, k) = inertia
    return SolidMass(mass, centre, ((a, b, c), (d, e, f), (g, h, k)))


def _solid_of_moments(mass: float, x: float, y: float, z: float) -> SolidMass:
    return SolidMass(mass, ORIGIN, ((x, 0.0, 0.0), (0.0, y, 0.0), (0.0, 0.0, z)))


def solid_box(size: Vector) -> SolidMass:
    """Return a box of density 1."""
    a, b, c = size
    m = a * b * c
    return _solid_of_moments(m, m * (b * b + c * c) / 12.0, m * (a * a + c * c) / 12.0, m * (a * a + b * b) / 12.0)


def solid_ellipsoid(radii: Vector) -> SolidMass:
    """Return an ellipsoid of density 1."""
    a, b, c = radii
    m = 4.0 / 3.0 * math.pi * a * b * c
    return _solid_of_moments(m, m * (b * b + c * c) / 5.0, m * (a * a + c * c) / 5.0, m * (a * a + b * b) / 5.0)


def solid_cylinder(radius: float, length: float) -> SolidMass:
    """Return a cylinder of density 1, along z."""
    m = math.pi * radius**2 * length
    across = m * (3.0 * radius**2 + length**2) / 12.0
    return _solid_of_moments(m, across, across, m * radius**2 / 2.0)


def solid_capsule(radius: float, length: float) -> SolidMass:
    """Return a cylinder of density 1 along z with hemispheres at its ends."""
    middle, m = solid_cylinder(radius, length), 4.0 / 3.0 * math.pi * radius**3
    across = middle.inertia[0][0] + m * (0.4 * radius**2 + length**2 / 4.0 + 3.0 * length * radius / 8.0)
    return _solid_of_moments(middle.mass + m, across, across, middle.inertia[2][2] + 0.4 * m * radius**2)

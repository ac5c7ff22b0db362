"""Point on plane: a point of one body stays in a plane of the other."""

from __future__ import annotations

from typing import ClassVar

from symgen.describe.fields import Axis
from symgen.describe.mechanism import Joint
from symgen.describe.scope import Scope
from symgen.describe.triads import make_triad
from symgen.joints._paired import Paired
from symgen.vocabulary.measures import Component, Holonomic


class PointOnPlane(Paired, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """A point of the first body that glides in a plane fixed in the second; in space only.

    Parameters
    ----------
    between : pair of body names
        The body with the point, which may be a point mass, and the body with the plane.
    at : pair of points
        The point, and a point of the plane.
    normal : direction
        Normal of the plane in the frame of the second body; its length does not matter.

    Notes
    -----
    One row [m]. Multiplier ``NAME.normal`` [N]: force on the first body along the normal. Reports
    ``NAME.displacement1`` and ``.displacement2``, of the point in the plane along two directions across the normal [m].
    """

    SPACES: ClassVar[tuple[str, ...]] = ("spatial",)

    normal: Axis

    def build(self, scope: Scope) -> Joint:
        """Resolve to the distance from the plane."""
        bodies, (point, plane) = self.ends(scope, turns=(False, True))
        triad = make_triad(scope, bodies[1], self.normal, keys=("normal", ""))
        rows = (Holonomic("normal", Component(point, plane, triad.axis)),)
        slides = tuple(
            (f"displacement{k}", Component(plane, point, x)) for k, x in ((1, triad.first), (2, triad.second))
        )
        return Joint(scope.name, scope.kind, bodies, rows, slides)


KIND = PointOnPlane

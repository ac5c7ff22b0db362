"""Point on plane: a point of one body stays in a plane of the other."""

from __future__ import annotations

from typing import ClassVar

from symgen.base.vocabulary.measures import Component, Holonomic
from symgen.describe.joints._paired import Paired
from symgen.describe.mechanism import Joint
from symgen.describe.parts.fields import Axis
from symgen.describe.parts.scope import Scope
from symgen.describe.parts.triads import make_triad


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

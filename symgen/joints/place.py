"""Place: where a point of one body is in the frame of another, as coordinates that a start may prescribe."""

from __future__ import annotations

from typing import ClassVar

from symgen.describe.mechanism import Joint
from symgen.describe.scope import Scope
from symgen.joints._paired import Paired
from symgen.vocabulary.measures import Component, axes


class PointPlace(Paired, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """The coordinates of a point of the second body in the first body's frame, which hold nothing.

    With ``start = { x = 0.3, y = 0.2 }``, or ``--start NAME.x=0.3``, the mechanism begins with the point there. Forces,
    couplings and rows may read the coordinates and their rates.

    Parameters
    ----------
    between : pair of body names
        The body whose frame it is, and the body with the point.
    at : pair of points
        The origin, a point of the first body, and the point.

    Notes
    -----
    No rows. Reports ``NAME.x``, ``NAME.y``, in space ``NAME.z`` [m].
    """

    SPACES: ClassVar[tuple[str, ...]] = ("planar", "spatial")

    def build(self, scope: Scope) -> Joint:
        """Resolve to the components of the vector between the points."""
        bodies, ends = self.ends(scope, turns=(False, False))
        along = zip("xyz", axes(bodies[0], scope.dimension), strict=False)
        return Joint(
            scope.name, scope.kind, bodies, (), tuple((label, Component(*ends, axis)) for label, axis in along)
        )


KIND = PointPlace

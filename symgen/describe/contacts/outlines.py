"""Outlines of surfaces, by which pictures show contacts."""

from __future__ import annotations

import msgspec

from symgen.base.vocabulary.expressions import ZERO, Expr
from symgen.base.vocabulary.measures import Direction, Marker


class Outline(msgspec.Struct, frozen=True):
    """A surface: a disc about a point, a point, a hole, a line through a point, or a segment between two.

    Parameters
    ----------
    points : tuple of Marker
        Of its body: one, or the ends of a segment.
    radius : Expr
        Of a disc, below 0 of a hole.
    normal : Direction or None
        Of a line.
    """

    points: tuple[Marker, ...]
    radius: Expr = ZERO
    normal: Direction | None = None

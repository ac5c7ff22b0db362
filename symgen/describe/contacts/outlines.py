"""Outlines of surfaces, by which pictures show contacts."""

from __future__ import annotations

import msgspec

from symgen.base.vocabulary.expressions import ZERO, Expr
from symgen.base.vocabulary.measures import Direction, Marker


class Outline(msgspec.Struct, frozen=True):
    """A surface: a disc about a point, a point, a hole, a line through a point, or a line along several.

    Parameters
    ----------
    points : tuple of Marker
        Of its body: one, the ends of a segment, or points along an outline.
    radius : Expr
        Of a disc, below 0 of a hole.
    normal : Direction or None
        Of a line.
    words : str
        What else is known of an outline of a file: name, pieces, length, corners.
    """

    points: tuple[Marker, ...]
    radius: Expr = ZERO
    normal: Direction | None = None
    words: str = ""

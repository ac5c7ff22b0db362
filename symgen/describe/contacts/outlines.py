"""Outlines of surfaces, by which pictures show contacts."""

from __future__ import annotations

import msgspec

from symgen.base.vocabulary.expressions import ZERO, Expr
from symgen.base.vocabulary.measures import Direction, Marker


class Outline(msgspec.Struct, frozen=True):
    """A surface: a disc about a point, a point, a hole, a line through a point, or a line along several.

    In space discs without an axis are spheres, and lines are planes.

    Parameters
    ----------
    points : tuple of Marker
        Of its body: one, the ends of a segment, or points along an outline.
    radius : Expr
        Of a disc, below 0 of a hole.
    normal : Direction or None
        Of a line.
    about : Direction or None
        Of a rim or a capsule in space.
    edges : tuple of Expr
        Of a capsule the length between the centres of its ends, of a box its edges [m].
    words : str
        What else is known of an outline of a file: name, pieces, length, corners.
    """

    points: tuple[Marker, ...]
    radius: Expr = ZERO
    normal: Direction | None = None
    about: Direction | None = None
    edges: tuple[Expr, ...] = ()
    words: str = ""


class LineInPieces(Outline, frozen=True):
    """The line along an outline of a file.

    Parameters
    ----------
    starts : tuple of int
        Numbers of the points at which its pieces begin.
    """

    starts: tuple[int, ...] = ()

"""Spanning trees of mechanisms: bodies in an order in which each follows what carries it, by joints."""

from __future__ import annotations

import msgspec

from symgen.base.vocabulary.expressions import ZERO, Expr
from symgen.base.vocabulary.measures import GROUND, Direction, Marker


class Articulation(msgspec.Struct, frozen=True):
    """Relative motion of the bodies of a joint that can be part of a tree.

    The second body's marker is the first body's, moved along `slides`, which are directions of the first body; the
    second body's frame is the first body's, turned as `turn` says.

    Parameters
    ----------
    a, b : Marker
        A point of the first and of the second body.
    turn : {"fixed", "axis", "cross", "ball"}
        `fixed`: no rotation. `axis`: one angle; in the plane the second body's, in space about the third direction.
        `cross`: two angles, about the third direction of the first frame, then of the second. `ball`: any rotation.
    slides : tuple of Direction
        Directions of free displacements.
    of_a, of_b : tuple of Direction
        In space, frames of three directions that coincide where the angle is 0; of a cross, its axes and first
        directions.
    angle : Expr
        In the plane, where nothing turns: angle of the second body relative to the first [rad].
    screw : tuple of Expr
        Displacement along the axis per radian, and at angle 0, where it depends on the angle.
    """

    a: Marker
    b: Marker
    turn: str = "fixed"
    slides: tuple[Direction, ...] = ()
    of_a: tuple[Direction, ...] = ()
    of_b: tuple[Direction, ...] = ()
    angle: Expr = ZERO
    screw: tuple[Expr, ...] = ()


class Link(msgspec.Struct, frozen=True):
    """Attachment of a body in the tree: by a joint to another body, or free without a joint.

    `forward`: whether the joint's first body carries the other.
    """

    body: str
    joint: str = ""
    parent: str = GROUND
    forward: bool = True
    articulation: Articulation | None = None


class Prescribed(msgspec.Struct, frozen=True):
    """A coordinate of a tree that a driver prescribes as a function of time, so that it is none of the state.

    Parameters
    ----------
    driver : str
        Name of the driver, which then has no row.
    body : str
        The body whose link has the coordinate.
    label : str
        Of the joint's coordinate, or ``"theta"`` for the angle of a planar body itself.
    value : Expr
        The driver's value, a formula of t and parameters [m or rad].
    sign : float
        1, or -1 where the driver prescribes the opposite of the coordinate.
    """

    driver: str
    body: str
    label: str
    value: Expr
    sign: float = 1.0


class Topology(msgspec.Struct, frozen=True):
    """A spanning tree of a mechanism: bodies in an order in which each follows what carries it."""

    links: tuple[Link, ...]
    cut: tuple[str, ...] = ()
    prescribed: tuple[Prescribed, ...] = ()

"""A sphere or a point over a plane."""

from __future__ import annotations

from symgen.base.vocabulary.measures import Component, Direction, RollingSpeed
from symgen.describe.contacts.outlines import Outline
from symgen.describe.contacts.surfaces import Disc, Touch
from symgen.describe.contacts.surfaces_in_space import PairInSpace, Plane
from symgen.describe.parts.scope import Scope


def read_sphere_over_plane(scope: Scope, key: str, sphere: Disc, plane: Plane) -> Touch:
    """Return the height of the centre over the plane, which is the radius where they touch.

    Raises
    ------
    InputError
        If the sphere is hollow.
    """
    if sphere.size < 0.0:
        raise scope.error(key, "a sphere or a point over a plane", f"a hollow sphere of {-sphere.size!r} m")
    return touch_of_plane(sphere, plane, sphere.outline)


def touch_of_plane(sphere: Disc, plane: Plane, drawn: Outline) -> Touch:
    """Return the height of a centre over a plane, which is the radius where they touch."""
    height, (one, other) = Component(plane.on, sphere.centre, plane.normal), plane.across
    slips = (slip_on_plane(sphere, plane, one), slip_on_plane(sphere, plane, other))
    return Touch(height, sphere.radius, height, None, (drawn, plane.outline), slips=slips)


def slip_on_plane(sphere: Disc, plane: Plane, along: Direction) -> RollingSpeed:
    """Return the velocity of the point of a sphere that touches, along a direction of the plane."""
    return RollingSpeed(sphere.centre, along, plane.normal, sphere.radius)


KIND = PairInSpace(("sphere", "plane"), read_sphere_over_plane)

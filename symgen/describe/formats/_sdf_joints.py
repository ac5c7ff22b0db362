"""Joints of SDF that take more than a kind: what an axis says, threads, gearboxes and two axes in a row."""

from __future__ import annotations

import math
import xml.etree.ElementTree as ET
from collections.abc import Iterable, Iterator
from dataclasses import dataclass

from symgen.base.errors import InputError, quote
from symgen.describe.formats._poses import Vector, matrix_vector, scalar_product, unit_vector
from symgen.describe.formats._robot import GROUND, Connection, CoupledCoordinate
from symgen.describe.formats._xml import read_inner_number

#: Types that are no connection alone: two axes with a part without mass between, and wheels of two other joints.
TWO_AXES, GEARBOX = "revolute2", "gearbox"
#: The axis of a joint that names none.
UP: Vector = (0.0, 0.0, 1.0)
#: Cosine of axes that are one.
_IN_LINE = 1.0 - 1e-9


def read_axis(connection: Connection, axis: ET.Element | None, where: str, sort: str) -> None:
    """Set damper, spring, friction and limits of a joint from one of its axes."""
    if axis is None:
        return
    dynamics, limit = axis.find("dynamics"), axis.find("limit")
    connection.damping = read_inner_number(where, dynamics, "damping")
    connection.friction = read_inner_number(where, dynamics, "friction")
    connection.stiffness = read_inner_number(where, dynamics, "spring_stiffness")
    connection.rest = read_inner_number(where, dynamics, "spring_reference")
    lower, upper = (read_inner_number(where, limit, key, side) for key, side in (("lower", -1e16), ("upper", 1e16)))
    if sort != "continuous" and lower < upper:
        connection.lower = lower if lower > -1e15 else None
        connection.upper = upper if upper < 1e15 else None


def screw_pitch(element: ET.Element, where: str) -> float:
    """Return the displacement along a thread in a turn [m], positive of a right-handed one.

    The older key has rad/m of a left-handed thread; the newer one counts where both are there.

    Raises
    ------
    InputError
        If a thread of the older key has no pitch.
    """
    if element.find("screw_thread_pitch") is not None or element.find("thread_pitch") is None:
        return read_inner_number(where, element, "screw_thread_pitch", 1.0)
    turns = read_inner_number(where, element, "thread_pitch", 1.0)
    if turns == 0.0:
        raise InputError(f"{where}, thread_pitch", "a number of rad/m other than 0", "0")
    return -2.0 * math.pi / turns


@dataclass(frozen=True)
class Gearbox:
    """Two links whose angles against a third one are in a ratio.

    Attributes
    ----------
    name, where : str
        The joint, and its place for messages.
    carrier : str
        The link that both turn against.
    ends : (str, str)
        The links.
    axes : (Vector, Vector)
        Directions of their angles in the ground frame where the motion starts.
    ratio : float
        The second angle is minus this times the first.
    """

    name: str
    where: str
    carrier: str
    ends: tuple[str, str]
    axes: tuple[Vector, Vector]
    ratio: float


def gearbox_coupling(gear: Gearbox, connections: Iterable[Connection]) -> CoupledCoordinate:
    """Return the coupling of the two joints that hold the wheels of a gearbox on its carrier.

    Raises
    ------
    InputError
        If no joint that turns about the axis connects a wheel with the carrier.
    """
    connections = list(connections)
    below = {c.child: c.parent for c in connections if c.kind == "fixed"}
    carrier = _carrying_link(gear.carrier, below)
    found = list[tuple[Connection, float]]()
    for end, axis in zip(gear.ends, gear.axes, strict=True):
        turning = next(_joints_that_turn(connections, below, carrier, _carrying_link(end, below), axis), None)
        if turning is None:
            expected = f"revolute joints of both links with {quote(gear.carrier)} about the axes of the gearbox"
            raise InputError(gear.where, expected, f"none of {quote(end)}")
        found.append(turning)
    (first, way), (second, other) = found
    return CoupledCoordinate(f"{gear.name}_mesh", second.name, first.name, (0.0, -gear.ratio * way * other))


def _carrying_link(link: str, below: dict[str, str]) -> str:
    """Return the link whose body a link belongs to, by fixed joints."""
    while link in below and link != GROUND:
        link = below[link]
    return link


def _joints_that_turn(
    connections: Iterable[Connection], below: dict[str, str], carrier: str, link: str, axis: Vector
) -> Iterator[tuple[Connection, float]]:
    """Yield joints that turn a link against a carrier about an axis, with 1, or -1 where their angle counts back."""
    for c in connections:
        ends = _carrying_link(c.parent, below), _carrying_link(c.child, below)
        cosine = scalar_product(unit_vector(matrix_vector(c.at.rotation, c.axis)), unit_vector(axis))
        if c.kind == "revolute" and set(ends) == {carrier, link} and abs(cosine) > _IN_LINE:
            yield c, math.copysign(1.0, cosine) * (1.0 if ends[0] == carrier else -1.0)

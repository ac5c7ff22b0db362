"""Joints of SDF that take more than a kind: what an axis says, threads, gearboxes and two axes in a row."""

from __future__ import annotations

import math
import xml.etree.ElementTree as ET
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass

from symgen.base.errors import InputError, quote, suggest
from symgen.base.vocabulary.rotations import scalar_product
from symgen.describe.formats._poses import Pose, Vector, matrix_transpose, matrix_vector, unit_vector
from symgen.describe.formats._robot import GROUND, Connection, CoupledCoordinate, Kind, RobotLink
from symgen.describe.formats._xml import pose_of_text, read_inner_flag, read_inner_number, read_inner_text, read_triple

#: Types that are no connection alone: two axes with a part without mass between, and wheels of two other joints.
TWO_AXES, GEARBOX = "revolute2", "gearbox"
#: Types of one connection -> what it is in symgen.
KINDS: dict[str, Kind] = {
    "fixed": "fixed",
    "revolute": "revolute",
    "continuous": "revolute",
    "prismatic": "translational",
    "ball": "spherical",
    "universal": "universal",
    "screw": "screw",
}
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


def joint_between_links(element: ET.Element, name: str, where: str, links: Mapping[str, RobotLink]) -> Connection:
    """Return a joint between links that have their places already: one that closes a loop.

    Its pose is in the frame of the child, or of the link that ``relative_to`` names.

    Raises
    ------
    InputError
        If it has another type, an end that is no link, or a frame that is none of a link.
    """
    sort = element.get("type", "")
    if sort not in KINDS:
        raise InputError(f"{where}, type", f"one of {', '.join(KINDS)}", quote(sort), suggest(sort, KINDS))
    ends = [read_inner_text(element, tag) for tag in ("parent", "child")]
    pose = element.find("pose")
    frame = ends[1] if pose is None else pose.get("relative_to", "") or ends[1]
    for end in (*ends, frame):
        if end not in links and end != "world":
            raise InputError(where, "the name of a link", quote(end), suggest(end, links))
    first, second = (_axis_of_joint(element, tag, where) for tag in ("axis", "axis2"))
    if sort == "universal" and (first is None or second is None):
        raise InputError(where, "two axes of a universal joint", "less")
    outer = links[frame].place if frame in links else Pose()
    at = outer @ (Pose() if pose is None else pose_of_text(f"{where}, pose", pose))
    kind: Kind = "rigid" if sort == "fixed" else KINDS[sort]
    parent, child = (end if end in links else GROUND for end in ends)
    joint = Connection(name, kind, parent, child, at, axis=first or UP, second=second, closes=True)
    if (axis := element.find("axis")) is not None and _is_along_model(axis):
        joint.axis = matrix_vector(matrix_transpose(at.rotation), joint.axis)
    if sort == "screw":
        joint.pitch = screw_pitch(element, where)
    if kind in ("revolute", "translational", "screw"):
        read_axis(joint, element.find("axis"), where, sort)
    return joint


def _axis_of_joint(element: ET.Element, tag: str, where: str) -> Vector | None:
    """Return the direction of an axis as it is written."""
    axis = element.find(tag)
    if axis is None:
        return None
    direction = read_triple(f"{where}, {tag}", read_inner_text(axis, "xyz") or "0 0 1")
    if not any(direction):
        raise InputError(f"{where}, {tag}", "an axis other than 0 0 0", "0 0 0")
    xyz = axis.find("xyz")
    if (frame := "" if xyz is None else xyz.get("expressed_in", "")) not in ("", "__model__"):
        raise InputError(f"{where}, {tag}", "an axis in the frame of the joint or of the model", quote(frame))
    return direction


def _is_along_model(axis: ET.Element) -> bool:
    """Whether an axis is written along the model's frame, which is the ground's where motions start."""
    xyz = axis.find("xyz")
    return read_inner_flag(axis, "use_parent_model_frame") or (xyz is not None and bool(xyz.get("expressed_in")))


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

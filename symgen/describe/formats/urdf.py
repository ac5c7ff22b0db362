"""URDF: the Unified Robot Description Format of ROS, with three dialects of closed loops."""

from __future__ import annotations

import xml.etree.ElementTree as ET
from collections.abc import Iterator
from pathlib import Path
from typing import ClassVar

from symgen.base.errors import InputError, quote, suggest
from symgen.base.vocabulary.rotations import scalar_product
from symgen.describe.formats._poses import Pose, axis_rotation, scaled_vector
from symgen.describe.formats._reader import RobotReader, tensor_of_entries
from symgen.describe.formats._robot import (
    GROUND,
    Connection,
    CoupledCoordinate,
    Kind,
    LeftOut,
    Robot,
    RobotLink,
    inputs_for_joints,
    rotate_inertia,
    set_follower_starts,
)
from symgen.describe.formats._sdf_joints import joint_between_links
from symgen.describe.formats._xml import frame_of_origin, read_colour, read_decimal, read_inner_number, read_triple

_KINDS: dict[str, Kind] = {
    "fixed": "fixed",
    "floating": "floating",
    "revolute": "revolute",
    "continuous": "revolute",
    "prismatic": "translational",
    "planar": "planar",
    "spherical": "spherical",
    "ball": "spherical",
}
#: Elements beside links and joints, which say nothing about the motion of the mechanism.
_SILENT = {
    "gazebo": "settings of another program",
    "transmission": "every joint has an input of its own, the effort after any mechanicalReduction",
    "sensor": "outputs are written by the user",
    "ros2_control": "settings of another program",
}


class Urdf:
    """Reads links, joints, limits, `mimic`, `dynamics`, and loops: ``loop_joint``, ``loop``, joints of ``gazebo``."""

    SUFFIXES: ClassVar[tuple[str, ...]] = (".urdf", ".xml")
    ROOT: ClassVar[str] = "robot"

    @staticmethod
    def read(path: Path, floating: bool) -> Robot:
        """Return the robot of a file; its root is the ground, or moves freely where `floating` says so."""
        return _Reader(path, floating).robot()


class _Reader(RobotReader):
    ROOT, MESH = "robot", "filename"

    def __init__(self, path: Path, floating: bool) -> None:
        super().__init__(path)
        self.floating = floating
        self.colours = {
            m.get("name", ""): _colour_text(f"{self.source}: material", m.find("color"))
            for m in self.tree.findall("material")
        }

    def text(self, element: ET.Element, key: str) -> str:
        """Return an attribute."""
        return element.get(key, "")

    def frame(self, where: str, element: ET.Element) -> Pose:
        """Return the frame of an origin."""
        return frame_of_origin(f"{where}, {element.tag} origin", element.find("origin"))

    def colour(self, where: str, look: ET.Element) -> str:
        """Return a colour of the look's own, or of a material of the file."""
        if (material := look.find("material")) is None:
            return ""
        own = _colour_text(f"{where}, material", material.find("color"))
        return own or self.colours.get(material.get("name", ""), "")

    def surface(self, where: str, link: ET.Element, collision: ET.Element) -> tuple[float, float]:
        """Return what Bullet's ``contact`` of the link says, or Gazebo's element on it."""
        name, restitution = self.name(link), 0.0
        friction = next(
            (
                read_inner_number(where, e, "mu1", 1.0)
                for e in self.tree.iterfind("gazebo")
                if e.get("reference") == name and e.find("mu1") is not None
            ),
            1.0,
        )
        for element in link.iterfind("contact/*"):
            if element.tag == "lateral_friction":
                friction = read_decimal(where, element.attrib, "value", 1.0)
            elif element.tag == "restitution":
                restitution = read_decimal(where, element.attrib, "value")
        return friction, restitution

    def robot(self) -> Robot:
        links = {}
        for element in self.tree.findall("link"):
            link = self._read_link(element)
            if link.name in links:
                raise InputError(f"{self.source}: link", "a name used once", f"{quote(link.name)} twice")
            links[link.name] = link
        if not links:
            raise InputError(self.source, "a robot with links", "none")
        joints = [(e, self._read_joint(e, links)) for e in self.tree.findall("joint")]
        names = [c.name for _, c in joints]
        if twice := next((name for name in names if names.count(name) > 1), None):
            raise InputError(f"{self.source}: joint", "a name used once", f"{quote(twice)} twice")
        followers = [f for e, c in joints if (f := self._read_mimic(e, c, names)) is not None]
        set_follower_starts(followers, {c.name: c for _, c in joints})
        roots = self._place_links(links, joints)
        connections = [c for _, c in joints]
        for root in roots:
            if not self.floating:
                connections.insert(0, Connection(f"base of {root}", "fixed", GROUND, root))
        closing = [*self._read_loop_joints(links), *self._read_joints_of_gazebo(links, names)]
        self._list_left_out(joints)
        return Robot(
            self.tree.get("name", "robot"),
            links,
            connections + closing,
            followers,
            inputs_for_joints(connections, followers),
            left_out=self.left_out,
            folder=self.folder,
            touching=self.count_touching(links.values()),
        )

    # -- links -------------------------------------------------------------------------------------------------------

    def _read_link(self, element: ET.Element) -> RobotLink:
        name = self.name(element)
        where = f"{self.source}: link {quote(name)}"
        link = RobotLink(name)
        if (inertial := element.find("inertial")) is not None:
            frame = frame_of_origin(f"{where}, inertial origin", inertial.find("origin"))
            mass, inertia = inertial.find("mass"), inertial.find("inertia")
            link.mass = 0.0 if mass is None else read_decimal(f"{where}, mass", mass.attrib, "value")
            if link.mass < 0.0:
                raise InputError(f"{where}, mass", "a mass of 0 or above", repr(link.mass))
            link.centre = frame.origin
            if inertia is not None:
                own = tensor_of_entries(lambda key: read_decimal(f"{where}, inertia", inertia.attrib, key))
                link.inertia = rotate_inertia(own, frame.rotation)
        link.shapes, link.touching = self.read_looks(where, element), self.read_touching(where, element)
        return link

    # -- joints ------------------------------------------------------------------------------------------------------

    def _read_joint(self, element: ET.Element, links: dict[str, RobotLink]) -> Connection:
        name = self.name(element)
        where = f"{self.source}: joint {quote(name)}"
        sort = element.get("type", "")
        if sort not in _KINDS:
            raise InputError(f"{where}, type", "a type of joint", quote(sort), suggest(sort, _KINDS))
        kind = _KINDS[sort]
        parent, child = (self._read_joint_end(where, element.find(tag), tag, links) for tag in ("parent", "child"))
        connection = Connection(name, kind, parent, child)
        connection.at = frame_of_origin(f"{where}, origin", element.find("origin"))  # in the parent so far
        if (axis := element.find("axis")) is not None:
            connection.axis = read_triple(f"{where}, axis", axis.get("xyz", "1 0 0"))
        else:
            connection.axis = (1.0, 0.0, 0.0)
        if kind in ("revolute", "translational", "planar") and not any(connection.axis):
            raise InputError(f"{where}, axis", "an axis other than 0 0 0", "0 0 0")
        if (dynamics := element.find("dynamics")) is not None:
            connection.damping = read_decimal(f"{where}, dynamics", dynamics.attrib, "damping")
            connection.friction = read_decimal(f"{where}, dynamics", dynamics.attrib, "friction")
        if (limit := element.find("limit")) is not None and sort in ("revolute", "prismatic"):
            lower, upper = (read_decimal(f"{where}, limit", limit.attrib, key) for key in ("lower", "upper"))
            if lower < upper:
                connection.lower, connection.upper = lower, upper
                connection.value = min(max(0.0, lower), upper)
        return connection

    def _read_joint_end(self, where: str, element: ET.Element | None, tag: str, links: dict[str, RobotLink]) -> str:
        name = "" if element is None else element.get("link", "")
        if name not in links:
            raise InputError(f"{where}, {tag}", "the name of a link", quote(name), suggest(name, links))
        return name

    def _place_links(self, links: dict[str, RobotLink], joints: list[tuple[ET.Element, Connection]]) -> list[str]:
        """Set the places of links and joints in the ground frame; return the roots."""
        above = dict[str, Connection]()
        for _, c in joints:
            if c.child in above:
                hint = "a loop is closed by <loop_joint> or <loop>"
                raise InputError(f"{self.source}: joint {quote(c.name)}", "a link with one parent", c.child, hint)
            above[c.child] = c
        by_parent = dict[str, list[Connection]]()
        for c in above.values():
            by_parent.setdefault(c.parent, []).append(c)
        roots = [name for name in links if name not in above]
        placed, waiting = set(roots), list(roots)
        while waiting:
            parent = waiting.pop()
            for c in by_parent.get(parent, ()):
                c.at = links[parent].place @ c.at
                motion = Pose()
                if c.kind == "revolute" and c.value:
                    motion = Pose(rotation=axis_rotation(c.axis, c.value))
                elif c.kind == "translational" and c.value:
                    size = scalar_product(c.axis, c.axis) ** 0.5
                    motion = Pose(scaled_vector(c.value / size, c.axis))
                links[c.child].place = c.at @ motion
                c.at = links[c.child].place  # the axis is the same before and after the motion
                placed.add(c.child)
                waiting.append(c.child)
        if len(placed) < len(links):
            lost = next(name for name in links if name not in placed)
            raise InputError(f"{self.source}: link {quote(lost)}", "links that form trees", "a ring of joints")
        return roots

    def _read_mimic(self, element: ET.Element, c: Connection, names: list[str]) -> CoupledCoordinate | None:
        mimic = element.find("mimic")
        if mimic is None or c.kind not in ("revolute", "translational"):
            return None
        where = f"{self.source}: joint {quote(c.name)}, mimic"
        leader = mimic.get("joint", "")
        if leader not in names:
            raise InputError(where, "the name of a joint", quote(leader), suggest(leader, names))
        polynomial = read_decimal(where, mimic.attrib, "offset"), read_decimal(where, mimic.attrib, "multiplier", 1.0)
        return CoupledCoordinate(f"{c.name}_mimic", c.name, leader, polynomial)

    # -- loops -------------------------------------------------------------------------------------------------------

    def _read_loop_joints(self, links: dict[str, RobotLink]) -> list[Connection]:
        """Return the joints of ``loop_joint`` (two links with places) and ``loop`` (predecessor and successor)."""
        for element in self.tree.findall("coupling"):
            where = f"{self.source}: coupling {quote(self.name(element))}"
            raise InputError(where, "joints that follow others by <mimic>", "<coupling>", "write the ratio as a mimic")
        closing = list[Connection]()
        for tag, first, second in (("loop_joint", "link1", "link2"), ("loop", "predecessor", "successor")):
            for element in self.tree.findall(tag):
                name = self.name(element)
                where = f"{self.source}: {tag} {quote(name)}"
                sort = element.get("type", "")
                kind = "rigid" if sort == "fixed" else _KINDS.get(sort)
                if kind is None:
                    raise InputError(f"{where}, type", "a type of joint", quote(sort), suggest(sort, _KINDS))
                ends = [element.find(key) for key in (first, second)]
                a, b = (
                    self._read_joint_end(where, end, key, links) for end, key in zip(ends, (first, second), strict=True)
                )
                frames = [links[x].place @ self._read_loop_frame(where, e) for x, e in zip((a, b), ends, strict=True)]
                connection = Connection(name, kind, a, b, frames[0], frames[1], closes=True)
                if (axis := element.find("axis")) is not None:
                    connection.axis = read_triple(f"{where}, axis", axis.get("xyz", "0 0 1"))
                closing.append(connection)
        return closing

    def _read_joints_of_gazebo(self, links: dict[str, RobotLink], taken: list[str]) -> Iterator[Connection]:
        """Yield the joints of SDF that ``<gazebo>`` elements add; others are listed, as the motion lacks them."""
        for element in self.tree.iterfind("gazebo/joint"):
            name = self.name(element)
            try:
                connection = joint_between_links(element, name, f"{self.source}: gazebo joint {quote(name)}", links)
                if name in taken:
                    raise InputError(f"{self.source}: gazebo joint", "a name used once", f"{quote(name)} twice")
            except InputError as error:
                why = f"it is not read: expected {error.expected}, got {error.got}"
                self.left_out.append(LeftOut("a joint of <gazebo>", name, why, True))
                continue
            taken.append(name)
            yield connection

    @staticmethod
    def _read_loop_frame(where: str, end: ET.Element | None) -> Pose:
        origin = None if end is None else end.find("origin")
        return frame_of_origin(where, end if origin is None else origin)

    # -- the rest ----------------------------------------------------------------------------------------------------

    def _list_left_out(self, joints: list[tuple[ET.Element, Connection]]) -> None:
        counts = dict[str, int]()
        for element in self.tree:
            counts[element.tag] = counts.get(element.tag, 0) + 1
        limits = [x for e, _ in joints if (x := e.find("limit")) is not None]
        self.leave_out(sum(1 for x in limits if x.get("effort") or x.get("velocity")))
        for tag, why in _SILENT.items():
            if counts.pop(tag, 0):
                self.left_out.append(LeftOut(f"<{tag}>", "the file", why, False))
        for tag in ("link", "joint", "loop_joint", "loop", "material"):
            counts.pop(tag, None)
        for tag, count in counts.items():
            self.left_out.append(LeftOut(f"<{tag}>", f"{count} in the file", "it is no element of URDF", False))


def _colour_text(where: str, element: ET.Element | None) -> str:
    """Return a colour as ``#rrggbb``; empty without one."""
    if element is None:
        return ""
    return read_colour(where, element.get("rgba", ""))


KIND = Urdf

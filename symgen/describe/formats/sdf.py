"""SDF: the format of Gazebo, with poses in chains of frames and loops that need no dialect."""

from __future__ import annotations

import xml.etree.ElementTree as ET
from collections.abc import Iterator
from pathlib import Path
from typing import ClassVar

from symgen.base.errors import InputError, quote, suggest
from symgen.describe.formats._poses import Pose, Vector, matrix_transpose, matrix_vector
from symgen.describe.formats._reader import RobotReader, tensor_of_entries
from symgen.describe.formats._robot import (
    GROUND,
    Connection,
    CoupledCoordinate,
    LeftOut,
    Robot,
    RobotLink,
    inputs_for_joints,
    rotate_inertia,
)
from symgen.describe.formats._sdf_frames import MODEL, WORLD, PlacedFrame, SdfFrames
from symgen.describe.formats._sdf_joints import (
    GEARBOX,
    KINDS,
    TWO_AXES,
    UP,
    Gearbox,
    gearbox_coupling,
    read_axis,
    screw_pitch,
)
from symgen.describe.formats._solids import (
    SolidMass,
    solid_box,
    solid_capsule,
    solid_cylinder,
    solid_ellipsoid,
    sum_of_solids,
)
from symgen.describe.formats._xml import (
    read_colour,
    read_inner_flag,
    read_inner_number,
    read_inner_text,
    read_positive,
    read_sizes,
    read_triple,
)

#: Density of collisions without one [kg/m^3].
_DENSITY = 1000.0
#: Elements of models and links that are left out, with the reason.
_SILENT = {
    "plugin": "code of another program",
    "sensor": "outputs are written by the user",
    "light": "pictures have their own",
    "gripper": "contacts are left out",
}


class Sdf:
    """Reads models, nested ones too: links, joints, gears, frames, inertia from shapes, limits, `dynamics`, `mimic`."""

    SUFFIXES: ClassVar[tuple[str, ...]] = (".sdf", ".world")
    ROOT: ClassVar[str] = "sdf"

    @staticmethod
    def read(path: Path, floating: bool) -> Robot:
        """Return the robot of a file; what no joint holds is free, as in Gazebo, so `floating` changes nothing."""
        return _Reader(path).robot()


class _Reader(RobotReader):
    """The robot of a file; names have their models before them, ``arm::hand``."""

    ROOT, MESH, RESERVED = "sdf", "uri", "::"

    def __init__(self, path: Path) -> None:
        super().__init__(path)
        self.version = self._version_numbers(self.tree.get("version", ""))
        self.links = dict[str, RobotLink]()
        self.frames = SdfFrames(self.source, self.links)
        self.elements = list[tuple[str, ET.Element]]()  # joints, each with the prefix of its model
        self.static = list[str]()

    def text(self, element: ET.Element, key: str) -> str:
        """Return the text of an inner element."""
        return read_inner_text(element, key)

    def frame(self, where: str, element: ET.Element) -> Pose:
        """Return the pose of a look."""
        return self.frames.pose(element)

    def colour(self, where: str, look: ET.Element) -> str:
        """Return the colour of a material."""
        for key in ("diffuse", "ambient"):
            if text := read_inner_text(look, f"material/{key}"):
                return read_colour(f"{where}, {key}", " ".join([*text.split()[:3], "1"]))
        return ""

    def surface(self, where: str, link: ET.Element, collision: ET.Element) -> tuple[float, float]:
        """Return the coefficients of a collision's ``surface``."""
        ratio = read_inner_number(where, collision, "surface/bounce/restitution_coefficient")
        return read_inner_number(where, collision, "surface/friction/ode/mu", 1.0), ratio

    def robot(self) -> Robot:
        worlds = self.tree.findall("world")
        if len(worlds) > 1:
            raise InputError(self.source, "one world", f"{len(worlds)} of them")
        outer = worlds[0] if worlds else self.tree
        models = outer.findall("model")
        if not models:
            raise InputError(self.source, "a file with a model", "none")
        for element in self.tree.iter("include"):
            hint = "insert the file: gz sdf -p FILE"
            raise InputError(f"{self.source}: include", "one file", quote(read_inner_text(element, "uri")), hint)
        for model in models:
            own = self.name(model)
            prefix = "" if len(models) == 1 else f"{own}::"
            self._read_model(model, prefix, WORLD, self.frames.pose(model, "", WORLD), False)
        for name, link in self.links.items():
            link.place = self.frames.place(name)
        connections, followers, gears = list[Connection](), list[CoupledCoordinate](), list[Gearbox]()
        for prefix, element in self.elements:
            if element.get("type", "") == GEARBOX:
                gears.append(self._read_gearbox(element, prefix))
            else:
                connections += self._read_joint(element, prefix)
        names = [c.name for c in connections]
        for prefix, element in self.elements:
            followers += self._read_mimic(element, prefix, names)
        connections = self._fixed_joints_from_ground(connections)
        followers += [gearbox_coupling(gear, connections) for gear in gears]
        self._list_left_out()
        gravity = read_inner_text(outer, "gravity")
        return Robot(
            self.name(models[0]),
            self.links,
            connections,
            followers,
            inputs_for_joints(connections, followers),
            read_triple(f"{self.source}: gravity", gravity) if gravity else (0.0, 0.0, -9.8),
            self.left_out,
            self.folder,
            touching=self.count_touching(self.links.values()),
        )

    # -- frames ------------------------------------------------------------------------------------------------------

    def _read_model(self, model: ET.Element, prefix: str, base: str, pose: Pose, static: bool) -> None:
        """Note the frames of a model, its links and joints, and the models in it."""
        where = f"{self.source}: model {quote(self.name(model))}"
        if model.get("placement_frame"):
            raise InputError(where, "a model placed by its own frame", "a placement_frame", "write its pose instead")
        own, static = f"{prefix}{MODEL}", static or read_inner_flag(model, "static")
        links = [prefix + self.name(link) for link in model.findall("link")]
        inner = [(nested, f"{prefix}{self.name(nested)}") for nested in model.findall("model")]
        canonical = model.get("canonical_link", "")
        attached = prefix + canonical if canonical else next(iter(links), "")
        if not attached and inner:
            attached = f"{inner[0][1]}::{MODEL}"
        self.frames.add_frame(own, PlacedFrame(base, pose, attached), where)
        for link in model.findall("link"):
            name = prefix + self.name(link)
            self.frames.add_element(link, name, prefix, own, name, where)
            self.links[name] = self._read_link(link, name)
            self.static += [name] * static
        for frame in model.findall("frame"):
            to = frame.get("attached_to", "")
            to = prefix + to if to else own
            self.frames.add_element(frame, prefix + self.name(frame), prefix, to, to, where)
        for joint in model.findall("joint"):
            child = read_inner_text(joint, "child")
            to = WORLD if child == WORLD else prefix + child
            self.frames.add_element(joint, prefix + self.name(joint), prefix, to, to, where)
            self.elements.append((prefix, joint))
        for nested, name in inner:
            self._read_model(
                nested, f"{name}::", self.frames.base_of_pose(nested, prefix, own), self.frames.pose(nested), static
            )

    # -- links -------------------------------------------------------------------------------------------------------

    def _read_link(self, element: ET.Element, name: str) -> RobotLink:
        where = f"{self.source}: link {quote(name)}"
        link, inertial = RobotLink(name), element.find("inertial")
        if inertial is not None and inertial.get("auto", "false") in ("true", "1"):
            solid = self._inertia_of_shapes(element, inertial, where)
        else:  # what a file leaves out is 1 there
            at = Pose() if inertial is None else self.frames.pose(inertial)
            mass = read_inner_number(where, inertial, "mass", 1.0)
            inertia = None if inertial is None else inertial.find("inertia")
            own = tensor_of_entries(
                lambda key: read_inner_number(where, inertia, key, 1.0 if key[1] == key[2] else 0.0)
            )
            solid = SolidMass(mass, at.origin, rotate_inertia(own, at.rotation))
        if solid.mass < 0.0:
            raise InputError(f"{where}, mass", "a mass of 0 or above", repr(solid.mass))
        link.mass, link.centre, link.inertia = solid.mass, solid.centre, solid.inertia
        link.shapes, link.touching = self.read_looks(where, element), self.read_touching(where, element)
        if read_inner_text(element, "gravity") in ("false", "0"):
            self.left_out.append(LeftOut("a link without gravity", name, "gravity acts on all bodies", True))
        return link

    def _inertia_of_shapes(self, element: ET.Element, inertial: ET.Element, where: str) -> SolidMass:
        """Return the inertia of the shapes of all collisions."""
        usual, solids = read_inner_number(where, inertial, "density", _DENSITY), list[SolidMass]()
        for collision in element.findall("collision"):
            at = f"{where}, collision {quote(collision.get('name', ''))}"
            density = read_inner_number(at, collision, "density", usual)
            solid, pose = self._solid_of_collision(collision, at), self.frames.pose(collision)
            tensor = rotate_inertia(solid.inertia, pose.rotation)
            solids.append(SolidMass(solid.mass, pose.point_in_outer_frame(solid.centre), tensor).with_density(density))
        if not solids:
            raise InputError(f"{where}, inertial auto", "a link with collisions", "none")
        whole = sum_of_solids(solids)
        mass = read_inner_number(where, inertial, "mass", whole.mass)
        return whole.with_density(mass / whole.mass)

    def _solid_of_collision(self, collision: ET.Element, where: str) -> SolidMass:
        """Return the solid of a collision, of density 1."""
        for part in collision.iterfind("geometry/*"):
            at = f"{where}, {part.tag}"
            if part.tag == "box":
                return solid_box(read_sizes(at, read_inner_text(part, "size")))
            if part.tag == "ellipsoid":
                return solid_ellipsoid(read_sizes(at, read_inner_text(part, "radii")))
            if part.tag in ("sphere", "cylinder", "capsule"):
                radius = read_positive(at, part, "radius")
                if part.tag == "sphere":
                    return solid_ellipsoid((radius,) * 3)
                length = read_positive(at, part, "length")
                return (solid_cylinder if part.tag == "cylinder" else solid_capsule)(radius, length)
            solids = "box, sphere, cylinder, capsule or ellipsoid"
            raise InputError(f"{where}, inertial auto", solids, quote(part.tag), "write mass and inertia")
        raise InputError(where, "a collision with a shape", "none")

    # -- joints ------------------------------------------------------------------------------------------------------

    def _read_joint(self, element: ET.Element, prefix: str) -> list[Connection]:
        """Return the connection of a joint; of two axes one after the other two, with a link without mass between."""
        name = prefix + self.name(element)
        where = f"{self.source}: joint {quote(name)}"
        sort = element.get("type", "")
        if sort not in (known := (*KINDS, TWO_AXES, GEARBOX)):
            raise InputError(f"{where}, type", f"one of {', '.join(known)}", quote(sort), suggest(sort, known))
        parent, child = self._read_joint_ends(element, prefix, where)
        axes = [self._read_axis(element, tag, name, prefix, where) for tag in ("axis", "axis2")]
        if sort in (TWO_AXES, "universal") and None in axes:
            raise InputError(where, f"two axes of a {sort} joint", "less")
        at = self.frames.place(name)
        if sort == TWO_AXES:
            between = RobotLink(f"{name}_between", at)
            self.links[between.name] = between
            pair = [
                Connection(f"{name}_{i}", "revolute", *ends, at, axis=axis or UP)
                for i, ends, axis in zip((1, 2), ((parent, between.name), (between.name, child)), axes, strict=True)
            ]
            for connection, tag in zip(pair, ("axis", "axis2"), strict=True):
                read_axis(connection, element.find(tag), where, "revolute")
            return pair
        connection = Connection(name, KINDS[sort], parent, child, at, axis=axes[0] or UP, second=axes[1])
        if sort == "screw":
            connection.pitch = screw_pitch(element, where)
        if connection.kind in ("revolute", "translational", "screw"):
            read_axis(connection, element.find("axis"), where, sort)
        return [connection]

    def _read_joint_ends(self, element: ET.Element, prefix: str, where: str) -> tuple[str, str]:
        """Return the links of a joint."""
        parent, child = (
            self.frames.link_of(WORLD if text == WORLD else prefix + text, f"{where}, {tag}")
            for tag, text in ((tag, read_inner_text(element, tag)) for tag in ("parent", "child"))
        )
        return parent, child

    def _read_gearbox(self, element: ET.Element, prefix: str) -> Gearbox:
        """Return a gearbox: two links that turn against a third one, about axes in the ground frame."""
        name = prefix + self.name(element)
        where, place = f"{self.source}: joint {quote(name)}", self.frames.place(name)
        axes = [self._read_axis(element, tag, name, prefix, where) for tag in ("axis", "axis2")]
        turned = [matrix_vector(place.rotation, axis) for axis in axes if axis is not None]
        if len(turned) < 2:
            raise InputError(where, "two axes of a gearbox", "less")
        reference = read_inner_text(element, "gearbox_reference_body")
        if not reference:
            raise InputError(where, "the element gearbox_reference_body", "none")
        carrier = self.frames.link_of(WORLD if reference == WORLD else prefix + reference, f"{where}, reference body")
        ratio = read_inner_number(where, element, "gearbox_ratio", 1.0)
        return Gearbox(
            name, where, carrier, self._read_joint_ends(element, prefix, where), (turned[0], turned[1]), ratio
        )

    def _read_axis(self, element: ET.Element, tag: str, name: str, prefix: str, where: str) -> Vector | None:
        """Return an axis in the frame of the joint."""
        axis = element.find(tag)
        if axis is None:
            return None
        xyz, where = axis.find("xyz"), f"{where}, {tag}"
        direction = read_triple(where, (xyz.text or "" if xyz is not None else "") or "0 0 1")
        if not any(direction):
            raise InputError(where, "an axis other than 0 0 0", "0 0 0")
        frame = "" if xyz is None else xyz.get("expressed_in", "")
        if read_inner_flag(axis, "use_parent_model_frame") or self.version < (1, 5):
            frame = frame or MODEL
        if not frame:
            return direction
        own = self.frames.place(self.frames.resolve_name(prefix + frame, f"{where}, expressed_in"))
        return matrix_vector(matrix_transpose(self.frames.place(name).rotation), matrix_vector(own.rotation, direction))

    def _read_mimic(self, element: ET.Element, prefix: str, names: list[str]) -> Iterator[CoupledCoordinate]:
        mimic = element.find("axis/mimic")
        if mimic is None or KINDS.get(element.get("type", "")) not in ("revolute", "translational"):
            return
        name = prefix + self.name(element)
        where = f"{self.source}: joint {quote(name)}, mimic"
        leader = prefix + mimic.get("joint", "")
        if leader not in names or leader == name:
            raise InputError(where, "the name of another joint", quote(leader), suggest(leader, names))
        ratio, offset, zero = (read_inner_number(where, mimic, key) for key in ("multiplier", "offset", "reference"))
        yield CoupledCoordinate(f"{name}_mimic", name, leader, (offset - ratio * zero, ratio))

    def _fixed_joints_from_ground(self, connections: list[Connection]) -> list[Connection]:
        """Return the joints, fixed ones away from the ground: each link has one that holds it; others close a ring."""
        beside = dict[str, list[Connection]]()
        fixed = [c for c in connections if c.kind == "fixed"]
        fixed += [Connection(f"{name} stays", "fixed", GROUND, name) for name in self.static]
        for c in fixed:
            for end in (c.parent, c.child):
                beside.setdefault(end, []).append(c)
        held, names = list[Connection](), set[str]()
        for root in (GROUND, *self.links):
            waiting = [] if root in names else [root]
            names.add(root)
            while waiting:
                link = waiting.pop()
                for c in beside.get(link, ()):
                    other = c.child if c.parent == link else c.parent
                    if other not in names:
                        names.add(other)
                        waiting.append(other)
                        held.append(Connection(c.name, "fixed", link, other))
        return [*held, *(c for c in connections if c.kind != "fixed")]

    # -- the rest ----------------------------------------------------------------------------------------------------

    def _version_numbers(self, text: str) -> tuple[int, ...]:
        parts = text.split(".")
        if not all(part.isdecimal() for part in parts) or len(parts) != 2:
            raise InputError(f"{self.source}: sdf, version", "a version such as 1.9", quote(text))
        return tuple(map(int, parts))

    def _list_left_out(self) -> None:
        limits = self.tree.iter("limit")
        self.leave_out(sum(1 for x in limits if read_inner_text(x, "effort") or read_inner_text(x, "velocity")))
        for tag, why in _SILENT.items():
            if count := sum(1 for _ in self.tree.iter(tag)):
                self.left_out.append(LeftOut(f"<{tag}>", f"{count} in the file", why, tag == "plugin"))


KIND = Sdf

"""From a robot to the nested tables of a mechanism file."""

from __future__ import annotations

import math
import os
import re
from pathlib import Path
from typing import Any

from symgen.base.errors import InputError
from symgen.base.escapes import printable
from symgen.base.vocabulary.rotations import scalar_product
from symgen.describe.formats._drives import ROUNDING, Drives, names_with_count, tidy_numbers
from symgen.describe.formats._ground_contacts import ground_contacts
from symgen.describe.formats._names import DescriptionNames
from symgen.describe.formats._poses import (
    Matrix,
    Pose,
    Vector,
    axis_rotation,
    matrix_transpose,
    matrix_vector,
    perpendicular_direction,
    quaternion_of_rotation,
    scaled_vector,
    unit_vector,
    vector_sum,
)
from symgen.describe.formats._robot import (
    GROUND,
    Connection,
    CoupledCoordinate,
    LeftOut,
    Robot,
    RobotLink,
    rotate_inertia,
)
from symgen.describe.formats._solids import SolidMass, sum_of_solids
from symgen.describe.formulas.identifiers import LONGEST
from symgen.describe.parts.bodies import MOST


def describe_robot(
    robot: Robot, source: str, stops: bool = False, contacts: bool = False
) -> tuple[dict[str, Any], tuple[LeftOut, ...], Path]:
    """Return the tables of a mechanism file, what they leave out, and the folder that meshes are named from.

    Links that fixed joints hold together are one body, with points of the names of the others. A link without mass
    at the end of a chain belongs to the body that carries it.

    Parameters
    ----------
    robot : Robot
        What a file describes.
    source : str
        The file, for the key ``source``.
    stops : bool
        Whether limits of joints become stops.
    contacts : bool
        Whether shapes of collision touch the ground.
    """
    description = _Description(robot, stops, contacts)
    return *description.all_tables(source), description.folder


class _Description:
    """Bodies, joints and forces of a robot."""

    def __init__(self, robot: Robot, stops: bool, contacts: bool) -> None:
        self.robot, self.names, self.stops, self.contacts = robot, DescriptionNames(), stops, contacts
        self.left_out = list(robot.left_out)
        self.carriers = self._bodies_of_links()
        self.joints = {c.name: c for c in robot.connections if c.kind not in ("fixed", "floating")}
        self._drop_massless_ends()
        self.drives = Drives(robot, self.names, self.joints, self.carriers, self.left_out)
        folder = robot.folder.resolve()
        files = [shape["file"] for link in robot.links.values() for shape in link.shapes if "file" in shape]
        self.folder = Path(os.path.commonpath([folder, *files]))

    # -- bodies ------------------------------------------------------------------------------------------------------

    def _bodies_of_links(self) -> dict[str, str]:
        """Return link -> the link whose body it belongs to, by fixed joints."""
        below = {c.child: c.parent for c in self.robot.connections if c.kind == "fixed"}
        carriers = dict[str, str]()
        for name in self.robot.links:
            top, steps = name, 0
            while top in below:
                top, steps = below[top], steps + 1
                if steps > len(below):
                    raise InputError("joints", "fixed joints that form a tree", f"a ring of them through '{name}'")
            carriers[name] = top
        return {GROUND: GROUND} | carriers

    def _drop_massless_ends(self) -> None:
        """Join links without mass at ends of chains to what carries them, as nothing determines their motion."""
        while True:
            bodies = self._links_of_bodies()
            ends = dict[str, list[Connection]]()
            for c in self.joints.values():
                for link in {self.carriers[c.parent], self.carriers[c.child]}:
                    ends.setdefault(link, []).append(c)
            empty = {
                name
                for name, members in bodies.items()
                if name != GROUND and all(link.mass == 0.0 and not any(map(any, link.inertia)) for link in members)
            }
            loose = [(name, ends.get(name, [])) for name in empty if len(ends.get(name, [])) < 2]
            if not loose:
                return
            for name, connections in loose:
                carrier = name
                for c in connections:
                    other = {self.carriers[c.parent], self.carriers[c.child]} - {name}
                    carrier = next(iter(other))
                    del self.joints[c.name]
                    self.left_out.append(LeftOut("a joint", c.name, "it moves a link without mass", False))
                if carrier == name:
                    carrier = GROUND
                for link, top in self.carriers.items():
                    if top == name:
                        self.carriers[link] = carrier

    def _links_of_bodies(self) -> dict[str, list[RobotLink]]:
        """Return body -> its links, itself first."""
        members: dict[str, list[RobotLink]] = {}
        for name, link in self.robot.links.items():
            top = self.carriers[name]
            members.setdefault(top, [])
            members[top].insert(0 if name == top else len(members[top]), link)
        return members

    def _mass_of_body(self, body: str) -> float:
        return math.fsum(
            self.robot.links[link].mass for link, top in self.carriers.items() if top == body and link != GROUND
        )

    def place_of_body(self, body: str) -> Pose:
        """Return the frame of a body in the ground frame."""
        return Pose() if body == GROUND else self.robot.links[body].place

    def _body_table(self, name: str, members: list[RobotLink]) -> dict[str, Any]:
        place, back = self.place_of_body(name), self.place_of_body(name).inverse()
        frames = [back @ link.place for link in members]
        whole = sum_of_solids(
            SolidMass(link.mass, frame.point_in_outer_frame(link.centre), rotate_inertia(link.inertia, frame.rotation))
            for frame, link in zip(frames, members, strict=True)
        )
        table: dict[str, Any] = {"mass": float(f"{whole.mass:.15g}"), "inertia": _tensor_entries(whole.inertia)}
        if any(whole.centre):
            table["centre_of_mass"] = tidy_numbers(whole.centre)
        points = dict[str, Any]()
        for link, frame in zip(members, frames, strict=True):
            if link.name != name:
                points[self.names.name_for("point", link.name)] = tidy_numbers(frame.origin)
            for point, at in link.points.items():
                points[self.names.name_for("point", point)] = tidy_numbers(frame.point_in_outer_frame(at))
        if points:
            table["points"] = points
        table["position"] = tidy_numbers(place.origin)
        if (e := quaternion_of_rotation(place.rotation)) != (1.0, 0.0, 0.0, 0.0):
            table["orientation"] = {"quaternion": tidy_numbers(e)}
        return table | self._shape_table(name, members, frames)

    def _shape_table(self, name: str, members: list[RobotLink], frames: list[Pose]) -> dict[str, Any]:
        """Return the key ``shape`` of links in the frame of their body, or of the ground."""
        shapes = [
            x for link, frame in zip(members, frames, strict=True) for x in _shapes_of_link(link, frame, self.folder)
        ]
        if len(shapes) > MOST:
            self.left_out.append(LeftOut("looks", f"{len(shapes) - MOST} of {name}", f"a body has {MOST}", False))
        return {"shape": shapes[:MOST]} if shapes else {}

    # -- joints ------------------------------------------------------------------------------------------------------

    def _joint_tables(self, c: Connection) -> dict[str, Any]:
        ends = [self.carriers[c.parent], self.carriers[c.child]]
        if ends[0] == ends[1]:
            raise InputError(f"joint '{c.name}'", "a joint between two bodies", "two links of one body")
        frames = (c.at, c.at if c.other is None else c.other)
        inner = [self.place_of_body(end).inverse() @ frame for end, frame in zip(ends, frames, strict=True)]
        table: dict[str, Any] = {
            "type": c.kind,
            "between": [self.drives.body_name(c.parent), self.drives.body_name(c.child)],
            "at": [tidy_numbers(frame.origin) for frame in inner],
        }
        if c.kind in ("revolute", "translational", "cylindrical", "planar", "rigid", "screw"):
            axis = unit_vector(c.axis)
            table["axis"] = [tidy_numbers(matrix_vector(frame.rotation, axis)) for frame in inner]
            first = perpendicular_direction(axis)
            second = first
            if c.kind in ("revolute", "cylindrical") and c.value:  # the angle at the start is `value`
                second = matrix_vector(axis_rotation(axis, c.value), first)
            pair = [matrix_vector(inner[0].rotation, first), matrix_vector(inner[1].rotation, second)]
            table["reference"] = [tidy_numbers(x) for x in pair]
        if c.kind == "universal":
            directions = c.axis, c.second or c.axis
            table["axes"] = [
                tidy_numbers(matrix_vector(f.rotation, unit_vector(x))) for f, x in zip(inner, directions, strict=True)
            ]
        if c.kind == "translational" and c.value:
            table["at"][0] = tidy_numbers(
                vector_sum(
                    inner[0].origin, matrix_vector(inner[0].rotation, scaled_vector(-c.value, unit_vector(c.axis)))
                )
            )
        light = c.kind == "translational" and any(end != GROUND and self._mass_of_body(end) == 0.0 for end in ends)
        if c.rotor and light:
            self.left_out.append(LeftOut("armature", c.name, "it slides a link without mass", True))
        elif c.rotor and c.kind in ("revolute", "translational"):
            table["rotor_inertia"] = c.rotor
        elif c.rotor:
            self.left_out.append(LeftOut("armature", c.name, f"a {c.kind} joint has no rotor", True))
        if self.stops and c.kind in ("revolute", "translational"):
            limits = {key: x for key, x in (("lower", c.lower), ("upper", c.upper)) if x is not None}
            table |= {"stop": limits} if limits else {}
        if c.kind == "screw":
            table["pitch"] = c.pitch
        if c.closes:
            table["cut"] = True
        if c.friction and c.kind != "screw":
            table["friction"] = {"sliding": c.friction}
        elif c.friction:
            self.left_out.append(LeftOut("friction", c.name, "a screw joint has several coordinates", True))
        return table

    def _note_limits(self) -> None:
        limited = [c.name for c in self.joints.values() if c.lower is not None or c.upper is not None]
        if self.stops:
            limited = [name for name in limited if self.joints[name].kind not in ("revolute", "translational")]
        if limited:
            why = "joints move beyond their ranges" + ("" if self.stops else "; --stops keeps them in")
            self.left_out.append(LeftOut("limits", names_with_count(limited), why, True))

    # -- couplings ----------------------------------------------------------------------------------------------------

    def _follower_table(self, f: CoupledCoordinate) -> dict[str, Any]:
        terms, polynomial = {self.names.name_for("joint", f.joint): 1.0}, list(f.polynomial)
        if f.of is None or not any(polynomial[1:]):
            return {"type": "coupling", "terms": terms, "value": polynomial[0]}
        if len(polynomial) == 2:
            straight = terms | {self.names.name_for("joint", f.of): -polynomial[1]}
            return {"type": "coupling", "terms": straight} | ({"value": polynomial[0]} if polynomial[0] else {})
        return {"type": "coupling", "terms": terms, "of": self.names.name_for("joint", f.of), "polynomial": polynomial}

    # -- contacts ----------------------------------------------------------------------------------------------------

    def _contact_tables(self) -> dict[str, Any]:
        """Return the contacts with the ground, if they are asked for, and list what is left out of all."""
        touching = self.robot.touching
        if not self.contacts:
            if touching:
                why = "bodies pass through each other; --contacts ground keeps them above the ground"
                self.left_out.append(LeftOut("contacts", touching, why, True))
            return {}
        tables, lost = ground_contacts(self.robot, self.names, self.carriers, self.place_of_body)
        self.left_out += lost
        if len({self.carriers[name] for name, link in self.robot.links.items() if link.touching} - {GROUND}) > 1:
            self.left_out.append(LeftOut("contacts between bodies", touching, "they touch the ground alone", True))
        return tables

    # -- everything --------------------------------------------------------------------------------------------------

    def all_tables(self, source: str) -> tuple[dict[str, Any], tuple[LeftOut, ...]]:
        robot = self.robot
        name = re.sub(r"[^a-z0-9]+", "-", robot.name.lower()).strip("-")[:LONGEST].strip("-")
        raw: dict[str, Any] = {
            "mechanism": {
                "name": name if name[:1].isalpha() else f"robot-{name}".strip("-"),
                "source": printable(source),
                "space": "spatial",
                "gravity": list(robot.gravity),
            }
        }
        standing = (members := self._links_of_bodies()).pop(GROUND, [])
        raw["mechanism"] |= self._shape_table("ground", standing, [link.place for link in standing])
        raw["bodies"] = {
            self.names.name_for("link", top): self._body_table(top, links) for top, links in members.items()
        }
        if not raw["bodies"]:
            raise InputError(source, "a robot with a link that moves", "none", "--floating leaves the base free")
        joints = {self.names.name_for("joint", c.name): self._joint_tables(c) for c in self.joints.values()}
        for f in robot.followers:
            if f.joint in self.joints and (f.of is None or f.of in self.joints):
                joints[self.names.name_for("follower", f.name)] = self._follower_table(f)
        touching = self._contact_tables()
        self._note_limits()
        forces, inputs, states = self.drives.force_tables()
        stops = self.drives.stop_tables() if self.stops else {}
        if self.drives.limited and not self.stops:
            limited = names_with_count([r.name for r in self.drives.limited])
            why = "their lengths go beyond their ranges; --stops keeps them in"
            self.left_out.append(LeftOut("limits of tendons", limited, why, True))
        parts = ("inputs", inputs), ("states", states), ("joints", joints), ("forces", forces)
        raw |= {key: x for key, x in (*parts, ("stops", stops), ("contacts", touching)) if x}
        return raw, tuple(self.left_out)


def _tensor_entries(m: Matrix) -> Any:
    """Return the entries of a tensor: three where products are rounding, else six."""
    entries = [m[0][0], m[1][1], m[2][2], m[0][1], m[0][2], m[1][2]]
    least = ROUNDING * max(map(abs, entries))
    return tidy_numbers(entries if any(abs(x) > least for x in entries[3:]) else entries[:3])


def _shapes_of_link(link: RobotLink, frame: Pose, folder: Path) -> list[dict[str, Any]]:
    """Return looks of a link in the frame of its body; meshes are named from a folder."""
    shapes = list[dict[str, Any]]()
    for shape in link.shapes:
        if (
            min(shape.get("size", (1.0,)), default=0.0) <= 0.0
            or min(shape.get(k, 1.0) for k in ("radius", "length")) <= 0
        ):
            continue
        own: Pose = frame @ shape["frame"]
        colour = {"colour": shape["colour"]} if "colour" in shape else {}
        at = {"at": tidy_numbers(own.origin)}
        if shape["type"] == "sphere":
            shapes.append({"type": "sphere", "radius": shape["radius"]} | at | colour)
        elif shape["type"] == "cylinder":
            axis = tidy_numbers(matrix_transpose(own.rotation)[2])
            sizes = {"radius": shape["radius"], "length": shape["length"], "axis": axis}
            shapes.append({"type": "cylinder"} | sizes | at | colour)
        elif shape["type"] == "mesh":
            turn = {"orientation": {"quaternion": tidy_numbers(quaternion_of_rotation(own.rotation))}}
            file = shape["file"].relative_to(folder).as_posix()
            shapes.append({"type": "mesh", "file": file, "scale": tidy_numbers(shape["scale"])} | at | turn | colour)
        else:
            shapes.append(_box_shape(shape["size"], own) | colour)
    return shapes


def _box_shape(size: Vector, own: Pose) -> dict[str, Any]:
    """Return a box: by its size where its edges are along the body's axes, else by its edges."""
    rows: Matrix = own.rotation
    if all(min(abs(abs(x) - 1.0), abs(x)) < 1e-6 for row in rows for x in row):
        sizes = [scalar_product(map(abs, row), size) for row in rows]
        return {"type": "box", "size": tidy_numbers(sizes), "at": tidy_numbers(own.origin)}
    x, y, z = (s / 2.0 for s in size)
    path = "--- +-- ++- -+- --- --+ +-+ +-- +-+ +++ ++- +++ -++ -+- -++ --+"
    corners = [tuple(s * (1.0 if c == "+" else -1.0) for s, c in zip((x, y, z), w, strict=True)) for w in path.split()]
    return {"type": "polyline", "points": [tidy_numbers(own.point_in_outer_frame((a, b, c))) for a, b, c in corners]}

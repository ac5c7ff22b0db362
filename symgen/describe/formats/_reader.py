"""What readers of URDF and SDF share: names, inertia, looks of links, and what is left out."""

from __future__ import annotations

import xml.etree.ElementTree as ET
from abc import ABC, abstractmethod
from collections.abc import Callable, Iterable, Mapping
from pathlib import Path
from typing import Any, ClassVar

from symgen.base.errors import InputError, quote
from symgen.describe.formats._poses import Matrix, Pose, matrix_product, rotation_to
from symgen.describe.formats._robot import LeftOut, RobotLink, TouchingShape
from symgen.describe.formats._xml import read_decimals, read_tree, read_triple
from symgen.describe.parts.mesh_files import MeshFiles


class RobotReader(ABC):
    """A file of links with looks and joints; URDF has its numbers in attributes, SDF in elements.

    Parameters
    ----------
    path : Path
        The file.
    """

    #: The outermost element, and where a mesh has its file.
    ROOT: ClassVar[str]
    MESH: ClassVar[str]
    #: Text that names may not hold.
    RESERVED: ClassVar[str] = ""

    def __init__(self, path: Path) -> None:
        self.source, self.folder, self.meshes = path.name, path.parent, MeshFiles(path.parent)
        self.tree, self.left_out = read_tree(path, self.ROOT), list[LeftOut]()

    @abstractmethod
    def text(self, element: ET.Element, key: str) -> str:
        """Return the text of a key of an element; empty without it."""

    @abstractmethod
    def frame(self, where: str, element: ET.Element) -> Pose:
        """Return the place of an element in what holds it."""

    @abstractmethod
    def colour(self, where: str, look: ET.Element) -> str:
        """Return the colour of a look as ``#rrggbb``; empty without one."""

    @abstractmethod
    def surface(self, where: str, link: ET.Element, collision: ET.Element) -> tuple[float, float]:
        """Return the coefficients of friction and restitution of a shape of collision."""

    # -- links -------------------------------------------------------------------------------------------------------

    def name(self, element: ET.Element) -> str:
        """Return the name of an element."""
        name = element.get("name", "")
        if not name.strip() or (self.RESERVED and self.RESERVED in name):
            beside = f" without '{self.RESERVED}'" if self.RESERVED else ""
            got = quote(name) if name.strip() else "none"
            raise InputError(f"{self.source}: {element.tag}", f"an element with a name{beside}", got)
        return name

    def read_looks(self, where: str, link: ET.Element) -> list[dict[str, Any]]:
        """Return the looks of a link; where none can be drawn, shapes of contact show where the link is."""
        visuals = link.findall("visual")
        shapes = [x for look in visuals for x in self._read_shape(where, look)]
        if visuals and not shapes:
            shapes = [x for look in link.findall("collision") for x in self._read_shape(where, look)]
        return shapes

    def _read_shape(self, where: str, look: ET.Element) -> list[dict[str, Any]]:
        colour = self.colour(where, look)
        rest = {"frame": self.frame(where, look)} | ({"colour": colour} if colour else {})
        for part in look.iterfind("geometry/*"):
            shape = self._shape_of_geometry(f"{where}, {part.tag}", part)
            if shape is not None:
                return [rest | shape] if shape else []
        return []

    def _shape_of_geometry(self, where: str, part: ET.Element) -> dict[str, Any] | None:
        """Return the shape of a geometry: empty for a mesh that cannot be drawn, None for another element."""
        if part.tag == "box":
            return {"type": "box", "size": read_triple(where, self.text(part, "size"))}
        if part.tag == "sphere":
            return {"type": "sphere", "radius": self._read_length(where, part, "radius")}
        if part.tag in ("cylinder", "capsule"):
            return {"type": "cylinder"} | {key: self._read_length(where, part, key) for key in ("radius", "length")}
        if part.tag != "mesh":
            return None
        if part.find("submesh") is not None:
            self.meshes.count_lost_mesh("whole files are drawn, no parts of them")
            return {}
        scale = read_triple(where, self.text(part, "scale") or "1 1 1")
        file = self.meshes.path(self.text(part, self.MESH))
        return {} if file is None else {"type": "mesh", "file": file, "scale": scale}

    def _read_length(self, where: str, part: ET.Element, key: str) -> float:
        return read_decimals(f"{where}, {key}", self.text(part, key) or "0", 1)[0]

    def read_touching(self, where: str, link: ET.Element) -> list[TouchingShape]:
        """Return the shapes of collision of a link."""
        shapes = list[TouchingShape]()
        for collision in link.findall("collision"):
            part = next((x for x in collision.iterfind("geometry/*") if x.tag != "empty"), None)
            if part is not None:
                at, frame = f"{where}, {part.tag}", self.frame(where, collision)
                friction, restitution = self.surface(f"{where}, collision", link, collision)
                if part.tag == "plane":
                    normal = read_triple(at, self.text(part, "normal") or "0 0 1")
                    frame = Pose(frame.origin, matrix_product(frame.rotation, rotation_to(normal)))
                shapes.append(TouchingShape(part.tag, frame, self._sizes(at, part), friction, restitution))
        return shapes

    def _sizes(self, where: str, part: ET.Element) -> tuple[float, ...]:
        if part.tag == "box":
            return read_triple(where, self.text(part, "size"))
        keys = {"sphere": ("radius",), "capsule": ("radius", "length"), "cylinder": ("radius", "length")}
        return tuple(self._read_length(where, part, key) for key in keys.get(part.tag, ()))

    def count_touching(self, links: Iterable[RobotLink]) -> str:
        """Return how many links have shapes of collision, in words, or nothing."""
        count = sum(1 for link in links if link.touching)
        return f"{count} links" if count else ""

    # -- the rest ----------------------------------------------------------------------------------------------------

    def leave_out(self, limited: int) -> None:
        """List meshes, and limits of effort and speed of a number of joints."""
        for why, count in self.meshes.reasons_of_lost():
            self.left_out.append(LeftOut("meshes", f"{count} in pictures", why, False))
        if limited:
            what = "limits of effort and speed"
            self.left_out.append(LeftOut(what, f"{limited} joints", "inputs take any value", False))


def tensor_of_entries(entry: Callable[[str], float]) -> Matrix:
    """Return a tensor of inertia from its entries ``ixx`` to ``iyz``."""
    a: Mapping[str, float] = {key: entry(f"i{key}") for key in ("xx", "yy", "zz", "xy", "xz", "yz")}
    return (a["xx"], a["xy"], a["xz"]), (a["xy"], a["yy"], a["yz"]), (a["xz"], a["yz"], a["zz"])

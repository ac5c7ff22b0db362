"""What readers of URDF and SDF share: names, inertia, looks of links, and what is left out."""

from __future__ import annotations

import xml.etree.ElementTree as ET
from abc import ABC, abstractmethod
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any, ClassVar

from symgen.base.errors import InputError, quote
from symgen.describe.formats._poses import Matrix, Pose
from symgen.describe.formats._robot import LeftOut
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

    # -- the rest ----------------------------------------------------------------------------------------------------

    def leave_out(self, touching: int, limited: int) -> None:
        """List contacts, meshes, and limits of effort and speed.

        Parameters
        ----------
        touching, limited : int
            Numbers of links with shapes of contact, and of joints with such limits.
        """
        if touching:
            self.left_out.append(LeftOut("contacts", f"{touching} links", "bodies pass through each other", True))
        for why, count in self.meshes.reasons_of_lost():
            self.left_out.append(LeftOut("meshes", f"{count} in pictures", why, False))
        if limited:
            what = "limits of effort and speed"
            self.left_out.append(LeftOut(what, f"{limited} joints", "inputs take any value", False))


def tensor_of_entries(entry: Callable[[str], float]) -> Matrix:
    """Return a tensor of inertia from its entries ``ixx`` to ``iyz``."""
    a: Mapping[str, float] = {key: entry(f"i{key}") for key in ("xx", "yy", "zz", "xy", "xz", "yz")}
    return (a["xx"], a["xy"], a["xz"]), (a["xy"], a["yy"], a["yz"]), (a["xz"], a["yz"], a["zz"])

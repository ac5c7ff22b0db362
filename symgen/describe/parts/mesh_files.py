"""Files of meshes that shapes name: in the folder of the mechanism file or below it, nowhere else.

Other programs' files may name them from the root of their package, which is then the folder.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from pathlib import Path, PurePosixPath
from typing import Any

#: Ends of the names of files that can be drawn.
SUFFIXES = (".stl", ".obj")
#: Why a mesh is not drawn.
_ELSEWHERE = "they are not in the folder or the package of the file"
_UNREADABLE = "only STL and OBJ files are drawn"
#: The name in the file of a package, and bytes of it that are read.
_NAME, _LARGEST_PACKAGE = re.compile(rb"<package\b.*?<name>\s*([^<\s]+)\s*</name>", re.DOTALL), 100_000


def is_inner_path(name: str) -> bool:
    """Return whether a text is the relative path of a mesh in or below a folder, by itself alone."""
    path = PurePosixPath(name)
    plain = name.isprintable() and not set(name) & set('\\:"') and not path.is_absolute() and ".." not in path.parts
    return plain and path.suffix.lower() in SUFFIXES


def mesh_file(folder: str | Path, name: str) -> Path | None:
    """Return the path of a file in or below a folder, links followed; None where there is none."""
    if not is_inner_path(name):
        return None
    try:
        outer = Path(folder).resolve()
        path = (outer / name).resolve()
        return path if path.is_relative_to(outer) and path.is_file() else None
    except (OSError, RuntimeError, ValueError):  # a name too long, or links in a circle
        return None


class MeshFiles:
    """Meshes that a robot's file names, by their paths; those that cannot be drawn are counted.

    A mesh is in the folder of the file or below it, or in the package that the file belongs to: the nearest folder
    above it that has the name of the package, or whose ``package.xml`` has it.

    Parameters
    ----------
    folder : Path
        Of the file.
    """

    def __init__(self, folder: Path) -> None:
        self.folder, self._lost = folder.resolve(), dict[str, int]()

    def path(self, uri: str) -> Path | None:
        """Return the path of a mesh; None where it cannot be drawn."""
        for scheme in ("package://", "model://"):
            if uri.startswith(scheme):
                name, _, rest = uri.removeprefix(scheme).lstrip("/").partition("/")
                root = self._package_root(name) or self.folder
                return self.inner_path(root, root, rest)
        return self.inner_path(self._package_root() or self.folder, self.folder, uri)

    def inner_path(self, root: Path, folder: Path, name: str) -> Path | None:
        """Return the path of a mesh that is named from a folder and is in or below `root`, links followed."""
        try:
            path = (folder / name).resolve()
            here = path.is_relative_to(root) and path.is_file()
        except (OSError, RuntimeError, ValueError):  # a name too long, or links in a circle
            here = False
        if here and is_inner_path(path.relative_to(path.anchor).as_posix()):
            return path
        self.count_lost_mesh(_ELSEWHERE if PurePosixPath(name).suffix.lower() in SUFFIXES else _UNREADABLE)
        return None

    def count_lost_mesh(self, why: str) -> None:
        """Count a mesh that is not drawn."""
        self._lost[why] = self._lost.get(why, 0) + 1

    def reasons_of_lost(self) -> list[tuple[str, int]]:
        """Return the reasons why meshes are not drawn, and how many there are of each."""
        return list(self._lost.items())

    def _package_root(self, name: str = "") -> Path | None:
        """Return the root of the package of a name, or of the nearest one, that the file is in."""
        for folder in (self.folder, *self.folder.parents[:-1]):
            if (name and folder.name == name) or _describes_package(folder / "package.xml", name):
                return folder
        return None


def _describes_package(path: Path, name: str) -> bool:
    """Return whether a file describes a package, of this name where there is one."""
    try:
        with path.open("rb") as file:
            content = file.read(_LARGEST_PACKAGE)
    except (OSError, ValueError):
        return False
    match = _NAME.search(content)
    return match is not None and name in ("", match[1].decode("utf-8", "replace"))


def with_mesh_folder(raw: Mapping[str, Any], source: Path, target: Path) -> tuple[dict[str, Any], int]:
    """Return a description whose meshes are named from another folder, and how many are not in that one.

    Parameters
    ----------
    raw : mapping
        The description, its shapes lists of tables.
    source, target : Path
        The folder that meshes are named from, and the other one.
    """
    tables, lost = dict[str, Any](), 0
    for name, body in {**raw["bodies"], "": raw["mechanism"]}.items():
        shapes = list[Mapping[str, Any]]()
        for shape in body.get("shape", ()):
            if shape["type"] != "mesh":
                shapes.append(shape)
                continue
            path, folder = (source / shape["file"]).resolve(), target.resolve()
            file = path.relative_to(folder).as_posix() if path.is_relative_to(folder) else ""
            if is_inner_path(file):
                shapes.append({**shape, "file": file})
            else:
                lost += 1
        rest = {key: value for key, value in body.items() if key != "shape"}
        tables[name] = rest | ({"shape": shapes} if shapes else {})
    head = tables.pop("")
    return {**raw, "mechanism": head, "bodies": tables}, lost

"""Files of meshes that shapes name: in the folder of the mechanism file or below it, nowhere else."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path, PurePosixPath
from typing import Any

#: Ends of the names of files that can be drawn.
SUFFIXES = (".stl", ".obj")


def is_inner(name: str) -> bool:
    """Return whether a text is the relative path of a mesh in or below a folder, by itself alone."""
    path = PurePosixPath(name)
    plain = name.isprintable() and not set(name) & set('\\:"') and not path.is_absolute() and ".." not in path.parts
    return plain and path.suffix.lower() in SUFFIXES


def mesh_file(folder: str | Path, name: str) -> Path | None:
    """Return the path of a file in or below a folder, links followed; None where there is none."""
    if not is_inner(name):
        return None
    try:
        outer = Path(folder).resolve()
        path = (outer / name).resolve()
        return path if path.is_relative_to(outer) and path.is_file() else None
    except (OSError, RuntimeError, ValueError):  # a name too long, or links in a circle
        return None


def mesh_name(folder: Path, uri: str) -> str | None:
    """Return the name of the mesh of a robot's file, relative to that file's folder; None where it is not in it.

    A package is the folder itself.
    """
    for scheme in ("package://", "model://"):
        if uri.startswith(scheme):
            uri = uri.removeprefix(scheme).partition("/")[2]
    name = str(PurePosixPath(uri))
    return None if mesh_file(folder, name) is None else name


def moved(raw: Mapping[str, Any], source: Path, target: Path) -> tuple[dict[str, Any], int]:
    """Return a description whose meshes are named from another folder, and how many are not in that one.

    Parameters
    ----------
    raw : mapping
        The description, its shapes lists of tables.
    source, target : Path
        The folder that meshes are named from, and the other one.
    """
    bodies, lost = dict[str, Any](), 0
    for name, body in raw["bodies"].items():
        shapes = list[Mapping[str, Any]]()
        for shape in body.get("shape", ()):
            if shape["type"] != "mesh":
                shapes.append(shape)
                continue
            path, folder = (source / shape["file"]).resolve(), target.resolve()
            file = path.relative_to(folder).as_posix() if path.is_relative_to(folder) else ""
            if is_inner(file):
                shapes.append({**shape, "file": file})
            else:
                lost += 1
        rest = {key: value for key, value in body.items() if key != "shape"}
        bodies[name] = rest | ({"shape": shapes} if shapes else {})
    return {**raw, "bodies": bodies}, lost

"""Files beside an MJCF file: those that MuJoCo may open, and meshes as shapes of bodies."""

from __future__ import annotations

import xml.etree.ElementTree as ET
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from symgen.base.errors import InputError, quote
from symgen.describe.formats._poses import (
    UNIT,
    Pose,
    matrix_transpose,
    matrix_vector,
    rotation_from_quaternion,
    scaled_vector,
)
from symgen.describe.formats._xml import read_tree
from symgen.describe.parts.mesh_files import MeshFiles

#: Files that a file may include, one in another.
_MOST_INCLUDES = 100
#: Elements that name files, and the settings that name the folder of those.
_FOLDERS = {
    "mesh": ("meshdir", "assetdir"),
    "hfield": ("meshdir", "assetdir"),
    "skin": ("meshdir", "assetdir"),
    "flexcomp": ("meshdir", "assetdir"),
    "texture": ("texturedir", "assetdir"),
}
#: Largest difference of factors of a scale that are the same.
_SAME = 1e-12


def check_files(path: Path, tree: ET.Element) -> None:
    """Refuse files elsewhere, and files that include themselves, before MuJoCo opens any."""
    trees, folder = list(_elements_with_includes(path, tree)), path.resolve().parent
    settings = dict[str, list[str]]()
    for setting in (x for element in trees for part in ("compiler", "option") for x in element.iter(part)):
        for key, value in setting.items():
            settings.setdefault(key, []).append(value)
        for key in ("meshdir", "texturedir", "assetdir"):
            _check_inner(f"{path.name}: {setting.tag}, {key}", folder, setting.get(key, ""), path.name)
    bare = "true" in settings.get("strippath", ())
    for element in (x for one in trees for x in one.iter() if x.tag in _FOLDERS):
        inner = [x for key in _FOLDERS[element.tag] for x in settings.get(key, ())] or [""]
        for key, name in element.items():
            if key.startswith("file"):
                for outer in inner:
                    at = str(Path(outer, Path(name).name if bare else name))
                    _check_inner(f"{path.name}: {element.tag}, {key}", folder, at, path.name)


def _check_inner(where: str, folder: Path, name: str, source: str) -> None:
    try:
        here = (folder / name).resolve().is_relative_to(folder.parent)
    except (OSError, RuntimeError, ValueError):
        here = False
    if not here:
        raise InputError(where, f"a place beside or in the folder of {source}", quote(name))


def _elements_with_includes(path: Path, tree: ET.Element) -> Iterator[ET.Element]:
    """Yield the outermost elements of a file and of those that it includes."""
    folder, waiting, count = path.resolve().parent, [(path.resolve(), tree)], 0
    while waiting:
        file, element = waiting.pop()
        yield element
        for include in (x for x in element.iter() if x.tag == "include" or (x.tag == "model" and "file" in x.attrib)):
            count += 1
            name = include.get("file", "")
            inner = (folder / name).resolve()
            if not inner.is_relative_to(folder):
                raise InputError(f"{path.name}: {include.tag}", f"a file in the folder of {path.name}", quote(name))
            if inner == file or count > _MOST_INCLUDES:
                got = f"{quote(name)} in itself" if inner == file else "more"
                raise InputError(f"{path.name}: {include.tag}", f"at most {_MOST_INCLUDES} files, none in itself", got)
            waiting.append((inner, read_tree(inner)))


class MjcfMeshes(MeshFiles):
    """Meshes of a compiled model, which places them along their own axes of inertia, as files along the file's axes.

    Parameters
    ----------
    spec, model : MjSpec, MjModel
        The file, and what MuJoCo makes of it.
    folder : Path
        Of the file.
    """

    def __init__(self, spec: Any, model: Any, folder: Path) -> None:
        super().__init__(folder)
        self._model, self._meshes = model, {mesh.id: mesh for mesh in spec.meshes}

    def shape(self, k: int, place: Pose) -> dict[str, Any] | None:
        """Return the shape of a geom of the mesh `k` at a place; None where it cannot be drawn."""
        model, mesh, start = self._model, self._meshes[k], int(self._model.mesh_pathadr[k])
        if start < 0:
            self.count_lost_mesh("they are made without files")
            return None
        name = bytes(model.paths)[start:].partition(b"\0")[0].decode("utf-8", "replace")
        if (file := self.inner_path(self.folder.parent, self.folder, name)) is None:
            return None
        # a point x of the file is at scale * (R^T (x - r)), with `refpos` and `refquat`, before MuJoCo places it
        x, y, z = (float(s) for s in mesh.scale)
        back = matrix_transpose(rotation_from_quaternion(mesh.refquat.tolist()))
        if back != UNIT and max(x, y, z) - min(x, y, z) > _SAME:
            self.count_lost_mesh("they are turned, then scaled by several factors")
            return None
        a, b, c = matrix_vector(back, scaled_vector(-1.0, tuple(mesh.refpos.tolist())))
        own = Pose(tuple(model.mesh_pos[k].tolist()), rotation_from_quaternion(model.mesh_quat[k].tolist()))
        inner = Pose((x * a, y * b, z * c), back)
        return {"type": "mesh", "file": file, "scale": (x, y, z), "frame": place @ own.inverse() @ inner}

"""Meshes of shapes: triangles of STL and OBJ files, few enough to be drawn."""

from __future__ import annotations

import re
from functools import lru_cache
from itertools import pairwise
from pathlib import Path

import numpy as np

from symgen.base.errors import InputError, quote
from symgen.base.files import system_message
from symgen.base.vocabulary.measures import Marker
from symgen.base.vocabulary.rotations import rotation_matrix_of
from symgen.describe.drawing.pen import PlacedMechanism
from symgen.describe.drawing.scene import Array
from symgen.describe.mechanism import Shape
from symgen.describe.parts.mesh_files import mesh_file

#: Bounds: bytes of a file, size of a coordinate, triangles of a body.
LARGEST, FARTHEST, MOST_TRIANGLES = 20_000_000, 1e9, 2000
#: Cells along the longest edge of a mesh that is simplified, at first.
_CELLS = 64
_VERTEX = re.compile(rb"\bvertex\s+(\S+)\s+(\S+)\s+(\S+)")


def mesh_faces(numbers: PlacedMechanism, body: str, shape: Shape) -> Array:
    """Return the triangles of a shape from the centre of mass of its body, shape (k, 3, 3).

    Raises
    ------
    InputError
        If the file is not there or no mesh.
    """
    where = f"bodies.{body}.shape, file {quote(shape.file)}"
    path = mesh_file(shape.folder, shape.file) if shape.folder else None
    if path is None:
        raise InputError(where, "a file in the folder of the mechanism file", "none there")
    beside = sum(1 for name, other in numbers.mechanism.shapes if name == body and other.kind == "mesh")
    try:
        status = path.stat()
        if status.st_size > LARGEST:
            raise InputError(where, f"a file of at most {LARGEST} bytes", f"{status.st_size}")
        corners = _read_triangles(path, status.st_mtime_ns, status.st_size, MOST_TRIANGLES // beside, where)
    except OSError as error:
        raise InputError(where, "a file that can be read", system_message(error)) from None
    scale = numbers.vector(shape.scale) if shape.scale else np.ones(3)
    placed = (corners * scale) @ np.array(rotation_matrix_of(shape.turn)).T + numbers.place(Marker(body, shape.at)).at
    return np.asarray(placed[:, ::-1] if np.prod(scale) < 0.0 else placed)  # a mirror turns faces inside out


@lru_cache(maxsize=256)
def _read_triangles(path: Path, changed: int, size: int, most: int, where: str) -> Array:
    """Return the triangles of a file that last `changed` at a time, simplified to at most `most`."""
    with path.open("rb") as file:
        content = file.read(LARGEST + 1)
    corners = _read_obj(content, where) if path.suffix.lower() == ".obj" else _read_stl(content, where)
    if not len(corners):
        raise InputError(where, "a mesh with triangles", "none")
    if not np.all(np.abs(corners) <= FARTHEST):  # which nan is not either
        raise InputError(where, f"finite coordinates of at most {FARTHEST:g}", "another number")
    return simplify_triangles(corners, most)


def _read_stl(content: bytes, where: str) -> Array:
    """Return the triangles of an STL file: binary where its length says so, else text if it begins as text."""
    count = int.from_bytes(content[80:84], "little")
    size = 84 + 50 * count
    if content[:5] == b"solid" and size != len(content):
        vertices = _VERTEX.findall(content)
        if b"endsolid" not in content or len(vertices) % 3:
            raise InputError(where, "an STL file", "one that breaks off")
        return _read_vertices(vertices, where).reshape(-1, 3, 3)
    if len(content) < max(size, 84):
        got = f"{len(content)} bytes" if len(content) < 84 else f"{len(content)} bytes for {count} triangles"
        raise InputError(where, "an STL file", f"one that breaks off: {got}")
    layout = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("rest", "<u2")])
    return np.frombuffer(content, layout, count, 84)["corners"].astype(np.float64)


def _read_obj(content: bytes, where: str) -> Array:
    """Return the triangles of an OBJ file; faces with more corners are fans."""
    vertices, faces = list[tuple[bytes, ...]](), list[tuple[int, int, int]]()
    for line in content.splitlines():
        words = line.split()
        if words[:1] == [b"v"]:
            vertices.append(tuple(words[1:4]))
        elif words[:1] == [b"f"]:
            try:
                corners = [int(word.partition(b"/")[0]) for word in words[1:]]
            except ValueError:
                raise InputError(where, "faces by numbers of vertices", "another word") from None
            # negative numbers count back from the last vertex so far
            corners = [k - 1 if k > 0 else len(vertices) + k for k in corners]
            if len(corners) < 3 or not all(0 <= k < len(vertices) for k in corners):
                raise InputError(where, "faces of three or more vertices above them", "another face")
            faces += [(corners[0], a, b) for a, b in pairwise(corners[1:])]
    points = _read_vertices(vertices, where)
    return points[np.array(faces, dtype=np.intp).reshape(-1, 3)] if len(points) else np.zeros((0, 3, 3))


def _read_vertices(vertices: list[tuple[bytes, ...]], where: str) -> Array:
    try:
        return np.array([[float(x) for x in vertex] for vertex in vertices], dtype=np.float64).reshape(-1, 3)
    except ValueError:
        raise InputError(where, "vertices of three numbers", "another text") from None


def simplify_triangles(corners: Array, most: int) -> Array:
    """Return at most `most` triangles: vertices in one cell of a grid become their mean.

    Parameters
    ----------
    corners : Array, shape (k, 3, 3)
        Triangles.
    most : int
        How many may stay.
    """
    if len(corners) <= most:
        return corners
    points = corners.reshape(-1, 3)
    low, span = points.min(axis=0), float(np.ptp(points, axis=0).max()) or 1.0
    cells = _CELLS
    while True:
        keys = np.floor((points - low) / span * cells * (1.0 - 1e-9)).astype(np.int64)
        _, cell = np.unique((keys[:, 0] * (cells + 1) + keys[:, 1]) * (cells + 1) + keys[:, 2], return_inverse=True)
        cell = cell.reshape(-1, 3)
        a, b, c = cell.T
        faces = cell[(a != b) & (b != c) & (c != a)]
        # one of each triangle; sides that face each other are two
        first = np.argmin(faces, axis=1)[:, None]
        faces = np.unique(np.take_along_axis(faces, (first + np.arange(3)) % 3, axis=1), axis=0)
        if len(faces) <= most:
            break
        cells = int(0.8 * cells)
    flat = cell.ravel()
    counts = np.bincount(flat)
    means = np.stack([np.bincount(flat, points[:, k]) / counts for k in range(3)], axis=1)
    return np.asarray(means[faces])

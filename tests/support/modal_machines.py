"""Descriptions with modal bodies, whose files are reduced from our own finite elements and kept beside them."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

import symgen
from benchmarks.finite_elements import Mesh, bar_frame, bend_to_arc, solid
from symgen.describe.reduction.reduction import Reduced

Array = NDArray[np.float64]


def arc(young: float = 2e9) -> Mesh:
    """A curved and twisted bar in space, a metre long."""
    return solid((1.0, 0.06, 0.04), (8, 1, 1), young=young, shape=bend_to_arc(0.5, 0.15))


def bow() -> Mesh:
    """A curved bar in the plane, a metre long."""
    return solid((1.0, 0.06), (12, 2), thick=0.02, shape=bend_to_arc(0.5))


def straight(length: float = 1.0, height: float = 0.02, young: float = 2e9, count: int = 20, **material: float) -> Mesh:
    """A straight bar in the plane."""
    keys = {"poisson": 0.0, "thick": 0.02} | material
    return solid((length, height), (count, 1), young=young, **keys)  # type: ignore[arg-type]  # numbers


def slender(
    length: float = 1.0, count: int = 20, young: float = 2e9, height: float = 0.02, width: float = 0.02
) -> Mesh:
    """A straight bar in the plane of Euler's and Bernoulli's elements, whose nodes turn."""
    places = np.column_stack([np.linspace(0.0, length, count + 1), np.zeros(count + 1)])
    return bar_frame(places, young, width * height, width * height**3 / 12.0, 1000.0)


def reduce_to(path: Path, mesh: Mesh, inner: int, ends: bool = True, **keys: Any) -> Reduced:
    """Write the file of a mesh with its ends as interfaces, and return what was reduced."""
    body = symgen.reduced(mesh.x, mesh.mass, mesh.stiffness, mesh.ends if ends else None, inner, **keys)
    body.save(path)
    return body


def machine(
    folder: Path, text: str, space: str = "planar", gravity: str = "", name: str = "bent", **run: float
) -> symgen.Model:
    """Return the model of a file written into a folder, where the files of its bodies are."""
    weight = f"gravity = {gravity}\n" if gravity else ""
    settings = "".join(f"{key} = {value!r}\n" for key, value in ({"until": 0.1, "output_step": 0.01} | run).items())
    head = f'[mechanism]\nname = "{name}"\nspace = "{space}"\n{weight}\n[run]\n{settings}\n'
    (folder / f"{name}.toml").write_text(head + text, encoding="utf-8")
    return symgen.load(folder / f"{name}.toml")


def motion_of(result: symgen.Result, model: symgen.Model, body: str) -> tuple[Array, Array]:
    """Return q and v of a body at all outputs."""
    own = model.mechanism.body(body)
    parts = (own.coordinates, own.speeds)
    q, v = (np.column_stack([result[f"{body}.{name}"] for name in names]) for names in parts)
    return q, v


def fixed(names: Mapping[str, float]) -> dict[str, float]:
    """Return a start by names."""
    return dict(names)

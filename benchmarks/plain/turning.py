"""Rotations in space: matrices, Euler parameters, and the ways a file may write an orientation."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from benchmarks.plain.document import Document
from benchmarks.plain.moving import Array, crossed, skew


def rotation(e: Array) -> Array:
    """Return the matrix of Euler parameters of any length above 0."""
    e = e / np.sqrt(e @ e)
    k = skew(e[1:])
    rotation: Array = np.eye(3) + 2.0 * (e[0] * k + k @ k)
    return rotation


def turned(vector: Array) -> Array:
    """Return the matrix of a rotation vector (Rodrigues)."""
    size = float(np.linalg.norm(vector))
    if size == 0.0:
        return np.eye(3)
    k = skew(vector / size)
    rotation: Array = np.eye(3) + np.sin(size) * k + (1.0 - np.cos(size)) * (k @ k)
    return rotation


def euler_parameters(r: Array) -> Array:
    """Return Euler parameters of a rotation matrix: the eigenvector of a symmetric matrix (Bar-Itzhack 2000)."""
    k = np.array(
        [
            [r[0, 0] + r[1, 1] + r[2, 2], r[2, 1] - r[1, 2], r[0, 2] - r[2, 0], r[1, 0] - r[0, 1]],
            [r[2, 1] - r[1, 2], r[0, 0] - r[1, 1] - r[2, 2], r[0, 1] + r[1, 0], r[0, 2] + r[2, 0]],
            [r[0, 2] - r[2, 0], r[0, 1] + r[1, 0], r[1, 1] - r[0, 0] - r[2, 2], r[1, 2] + r[2, 1]],
            [r[1, 0] - r[0, 1], r[0, 2] + r[2, 0], r[1, 2] + r[2, 1], r[2, 2] - r[0, 0] - r[1, 1]],
        ]
    )
    _, vectors = np.linalg.eigh(k)
    e: Array = vectors[:, -1]
    return e if e[0] >= 0.0 else -e


def rates(e: Array, omega: Array) -> Array:
    """Return e' for an angular velocity in body axes."""
    return 0.5 * np.concatenate([[-e[1:] @ omega], e[0] * omega + crossed(e[1:], omega)])


def orientation(document: Document, table: Mapping[str, Any] | None) -> Array:
    """Return the rotation matrix that an orientation table stands for."""
    if table is None:
        return np.eye(3)
    if "quaternion" in table:
        return rotation(document.array(table["quaternion"]))
    if "rotation_vector" in table:
        return turned(document.array(table["rotation_vector"]))
    if "euler_angles" in table:
        r = np.eye(3)
        for axis, angle in zip(table["convention"], document.array(table["euler_angles"]), strict=True):
            r = r @ turned(angle * np.eye(3)["xyz".index(axis)])
        return r
    if "x_axis" in table:
        x = document.array(table["x_axis"])
    else:
        x = document.array(table["end"]) - document.array(table["start"])
    x = x / np.linalg.norm(x)
    y = document.array(table["y_axis"])
    y = y - (x @ y) * x
    y = y / np.linalg.norm(y)
    return np.column_stack([x, y, crossed(x, y)])


def inertia(document: Document, table: Mapping[str, Any], mass: float, centre: Array) -> Array:
    """Return the tensor about the centre of mass in body axes, from all ways a file may write it."""
    entries = document.array(table["inertia"])
    if entries.shape == (3, 3):
        tensor = entries
    else:
        xx, yy, zz, xy, xz, yz = entries if len(entries) == 6 else (*entries, 0.0, 0.0, 0.0)
        tensor = np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])
    if "inertia_axes" in table:
        a = orientation(document, table["inertia_axes"])
        tensor = a @ tensor @ a.T
    if "inertia_at" in table:
        at = table["inertia_at"]
        if at == "centre":
            point = centre
        else:
            point = document.array(table["points"][at] if isinstance(at, str) else at)
        d = point - centre
        tensor = tensor - mass * ((d @ d) * np.eye(3) - np.outer(d, d))
    inertia: Array = tensor
    return inertia

"""Shapes of collision of a compiled model of MuJoCo."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property
from typing import Any

from symgen.describe.formats._poses import Pose, Vector, rotation_from_quaternion
from symgen.describe.formats._robot import TouchingShape


@dataclass(frozen=True)
class MjcfContacts:
    """Geoms that may touch the ground, with the friction that MuJoCo takes of a geom and the first plane.

    Attributes
    ----------
    mujoco, model
        The package, and a compiled model.
    disabled : bool
        Whether the file has no contacts.
    """

    mujoco: Any
    model: Any
    disabled: bool

    @cached_property
    def _sorts(self) -> dict[int, str]:
        kinds = ("plane", "sphere", "capsule", "cylinder", "box", "ellipsoid", "mesh", "hfield")
        return {int(getattr(self.mujoco.mjtGeom, f"mjGEOM_{kind.upper()}")): kind for kind in kinds}

    @cached_property
    def _geoms(self) -> list[int]:
        model, geoms = self.model, [] if self.disabled else range(self.model.ngeom)
        return [k for k in geoms if model.geom_contype[k] or model.geom_conaffinity[k]]

    @cached_property
    def _plane(self) -> int | None:
        """The first plane of the ground."""
        ground = (k for k in self._geoms if not self.model.geom_bodyid[k] and self._sort(k) == "plane")
        return next(ground, None)

    def count(self) -> str:
        """Return how many geoms may touch, in words, or nothing: one alone touches nothing."""
        return f"{len(self._geoms)} geoms" if len(self._geoms) > 1 else ""

    def of_ground(self) -> list[TouchingShape]:
        """Return the shapes of the ground; the friction of its first plane counts in its pairs."""
        ground = [k for k in self._geoms if not self.model.geom_bodyid[k]]
        return [TouchingShape(self._sort(k), self._frame(k), self._sizes(k), math.inf) for k in ground]

    def shapes(self, body: int) -> list[TouchingShape]:
        """Return the shapes of a body."""
        own = [k for k in self._geoms if self.model.geom_bodyid[k] == body and self._meets_plane(k)]
        return [TouchingShape(self._sort(k), self._frame(k), self._sizes(k), self._friction(k)) for k in own]

    def _sort(self, k: int) -> str:
        return self._sorts.get(int(self.model.geom_type[k]), "shape")

    def _frame(self, k: int) -> Pose:
        x, y, z = map(float, self.model.geom_pos[k])
        return Pose((x, y, z), rotation_from_quaternion(self.model.geom_quat[k].tolist()))

    def _sizes(self, k: int) -> tuple[float, ...]:
        a, b, c = map(float, self.model.geom_size[k])
        sizes: dict[str, tuple[float, ...]] = {"sphere": (a,), "capsule": (a, 2.0 * b), "cylinder": (a, 2.0 * b)}
        box: Vector = (2.0 * a, 2.0 * b, 2.0 * c)
        return box if self._sort(k) == "box" else sizes.get(self._sort(k), ())

    def _meets_plane(self, k: int) -> bool:
        types, affinities, plane = self.model.geom_contype, self.model.geom_conaffinity, self._plane
        return plane is None or bool(types[k] & affinities[plane] or types[plane] & affinities[k])

    def _friction(self, k: int) -> float:
        """Return the friction of a geom beside the plane: of the higher priority, else the larger one."""
        model, both = self.model, [k] if self._plane is None else [k, self._plane]
        top = max(int(model.geom_priority[i]) for i in both)
        both = [i for i in both if model.geom_priority[i] == top]
        rubs = max(int(model.geom_condim[i]) for i in both) > 1
        return max(float(model.geom_friction[i][0]) for i in both) if rubs else 0.0

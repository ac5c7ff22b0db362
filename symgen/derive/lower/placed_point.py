"""A point of a body with the body's axes, as nodes: where it is and how it moves."""

from __future__ import annotations

from collections.abc import Sequence

from symgen.base.vocabulary.measures import GROUND, Marker
from symgen.derive.formulate.measure_nodes import ModelNodes
from symgen.describe.mechanism import Vec


class PlacedPoint:
    """Position, axes and motion of a point of a body, in the ground's axes."""

    def __init__(self, model: ModelNodes, body: str, point: Vec) -> None:
        self.model, g = model, model.graph
        self.graph, self.spatial = g, model.spatial
        self.dimension = d = 3 if model.spatial else 2
        own = model.local(Marker(body, point))
        slots = model.frame_inputs(body)
        at, self.omega = slots[:d], slots[-3:] if self.spatial else slots[-1:]
        still = body == GROUND or model.mechanism.body(body).is_point
        if self.spatial:
            axes = [slots[3:6], slots[6:9], slots[9:12]]
            moved = slots[12:15]
        else:
            axes = [[slots[2], g.neg(slots[3])], [slots[3], slots[2]]]
            moved = slots[4:6]
        if still:
            axes = [[g.one if i == j else g.zero for j in range(d)] for i in range(d)]
            self.omega = [g.zero] * len(self.omega)
        self.axes = axes
        arm = [g.dot(row, own) for row in axes]
        self.at = [g.add(x, a) for x, a in zip(at, arm, strict=True)]
        self.moved = [g.add(x, s) for x, s in zip(moved, self._velocity_of_arm(own, arm), strict=True)]

    def _velocity_of_arm(self, own: Sequence[int], arm: Sequence[int]) -> list[int]:
        g = self.graph
        if self.spatial:
            x, y, z = own
            p, q, r = self.omega
            local = [g.sub(g.mul(q, z), g.mul(r, y)), g.sub(g.mul(r, x), g.mul(p, z)), g.sub(g.mul(p, y), g.mul(q, x))]
            return [g.dot(row, local) for row in self.axes]
        (w,) = self.omega
        return [g.neg(g.mul(w, arm[1])), g.mul(w, arm[0])]

    def homogeneous_matrix(self) -> list[int]:
        """Return the homogeneous matrix, row by row."""
        g = self.graph
        rows = [[*row, x] for row, x in zip(self.axes, self.at, strict=True)]
        return [n for row in rows for n in row] + [g.zero] * self.dimension + [g.one]

    def velocity(self, local: bool) -> list[int]:
        """Return velocity and angular velocity."""
        g = self.graph
        if local:
            along = [g.dot(column, self.moved) for column in zip(*self.axes, strict=True)]
            return [*along, *self.omega]
        turning = [g.dot(row, self.omega) for row in self.axes] if self.spatial else self.omega
        return [*self.moved, *turning]

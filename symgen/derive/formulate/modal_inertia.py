"""Inertia of modal bodies: it grows with the coordinates of modes, and turns are coupled with these.

The field of a body is X + psi_i m_i about its centre of mass, in body axes. Modes have neither momentum nor angular
momentum about it, so that the translation stands apart, and

    T = m v.v / 2 + w.J w / 2 + w.s_i m_i' + m m'.m' / 2,  dJ/dm_i = growth_i + 2 second_ij m_j,  s_i = cross_ji m_j

with Lagrange's equations in the velocities w of body axes. In the plane a tensor has one entry, and the axis of turns
is fixed: the same formulas with one component.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from symgen.base.ir.graph import Graph
from symgen.derive.formulate.equations import MassBlock
from symgen.derive.formulate.vector_algebra import Vectors
from symgen.describe.mechanism import AnyBody, SpatialBody
from symgen.describe.modal_body import Matrix, Modal

if TYPE_CHECKING:
    from symgen.derive.formulate.measure_nodes import ModelNodes

#: Nodes of a matrix, row by row.
_Entries = list[list[int]]


def add_modal_inertia(model: ModelNodes, body: AnyBody, blocks: list[MassBlock], forces: list[int]) -> int:
    """Add the inertia of turns and modes of a modal body to M, and its forces to f; return their kinetic energy."""
    assert body.modal is not None
    return _TurnsAndModes(model, body, body.modal).add(blocks, forces)


class _TurnsAndModes:
    """Nodes of a modal body besides its translation.

    Attributes
    ----------
    first : int
        Index of the first velocity of its turn; those of modes follow.
    m, rates, omega : list of int
        Coordinates of modes, their velocities, and the angular velocity in body axes.
    """

    def __init__(self, model: ModelNodes, body: AnyBody, modal: Modal) -> None:
        self.g, self.modal, count = model.graph, modal, len(modal.stiffness)
        self.turning = 3 if model.spatial else 1
        self.first = model.first[body.name] + len(model.mechanism.gravity)
        self.m, self.rates = model.modes(body.name)
        self.omega = list(model.velocities[self.first : self.first + self.turning])
        self.count, self.mass = count, model.expression(body.mass)
        if isinstance(body, SpatialBody):
            xx, yy, zz, xy, xz, yz = (model.expression(e) for e in body.inertia or ())
            self.rest = [[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]]
        else:
            assert body.inertia is not None
            self.rest = [[model.expression(body.inertia)]]

    def add(self, blocks: list[MassBlock], forces: list[int]) -> int:
        """Add to M and f; return the kinetic energy."""
        g, n, k, half = self.g, self.turning, self.count, self.g.constant(0.5)
        slopes = [self._slope(i) for i in range(k)]
        inertia = self._inertia(slopes)
        swept = [self._cross_with(i, self.m) for i in range(k)]
        carried = [g.sum_of(g.mul(swept[i][a], self.rates[i]) for i in range(k)) for a in range(n)]
        own = _times(g, inertia, self.omega)
        momentum = [g.add(a, b) for a, b in zip(own, carried, strict=True)]
        moment = _times(g, self._combined(zip(self.rates, slopes, strict=True)), self.omega)
        if n == 3:
            v = Vectors(g)
            moment = list(v.add(v.cross(v.triple(self.omega), v.triple(momentum)), v.triple(moment)))
        for a in range(n):
            forces[self.first + a] = g.sub(forces[self.first + a], moment[a])
        for i in range(k):  # centrifugal, and half of Coriolis' on both sides of Lagrange's equation
            outwards = g.mul(half, g.dot(_times(g, slopes[i], self.omega), self.omega))
            aside = g.mul(g.constant(2.0), g.dot(self.omega, self._cross_with(i, self.rates)))
            place = self.first + n + i
            forces[place] = g.add(forces[place], g.sub(outwards, aside))
        lines = [[*inertia[a], *(swept[i][a] for i in range(k))] for a in range(n)]
        lines += [[*swept[i], *(self.mass if i == j else g.zero for j in range(k))] for i in range(k)]
        blocks.append(MassBlock(tuple(range(self.first, self.first + n + k)), tuple(map(tuple, lines))))
        doubled = g.add(g.dot(self.omega, own), g.mul(self.mass, g.dot(self.rates, self.rates)))
        return g.add(g.mul(half, doubled), g.dot(self.omega, carried))

    def _slope(self, i: int) -> _Entries:
        """Return dJ/dm_i."""
        g, modal = self.g, self.modal
        doubled = ((g.mul(g.constant(2.0), self.m[j]), modal.second[i][j]) for j in range(self.count))
        return self._combined(
            [(g.one, self._constants(modal.growth[i])), *((f, self._constants(x)) for f, x in doubled)]
        )

    def _inertia(self, slopes: list[_Entries]) -> _Entries:
        """Return J, a polynomial of second order in m: J_0 + (growth_i + dJ/dm_i) m_i / 2."""
        g, half = self.g, self.g.constant(0.5)
        parts: list[tuple[int, _Entries]] = [(g.one, self.rest)]
        for i, slope in enumerate(slopes):
            both = self._combined([(g.one, self._constants(self.modal.growth[i])), (g.one, slope)])
            parts.append((g.mul(half, self.m[i]), both))
        return self._combined(parts)

    def _cross_with(self, i: int, factors: list[int]) -> list[int]:
        """Return the integral of (psi_j factor_j) x psi_i dm."""
        g, cross = self.g, self.modal.cross
        return [
            g.sum_of(g.mul(f, g.constant(cross[j][i][a])) for j, f in enumerate(factors)) for a in range(self.turning)
        ]

    def _constants(self, matrix: Matrix) -> _Entries:
        return [[self.g.constant(x) for x in row] for row in matrix]

    def _combined(self, parts: object) -> _Entries:
        """Return a sum of symmetric matrices with factors; entries below the diagonal are those above it."""
        g, n, given = self.g, self.turning, list(parts)  # type: ignore[call-overload]
        entries = [[g.zero] * n for _ in range(n)]
        for a in range(n):
            for b in range(a, n):
                entries[a][b] = entries[b][a] = g.sum_of(g.mul(factor, matrix[a][b]) for factor, matrix in given)
        return entries


def _times(g: Graph, matrix: _Entries, vector: list[int]) -> list[int]:
    return [g.dot(row, vector) for row in matrix]

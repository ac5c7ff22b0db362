"""Collocation at nine Lobatto points, with Picard iteration at all nodes at once in vectors."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from typing import TYPE_CHECKING, Any, ClassVar

import numpy as np
from numpy.polynomial import legendre
from numpy.typing import NDArray

from symgen.compile.loopcode.padding import padded
from symgen.compile.native.types import NODES
from symgen.run.integrators.dop853 import KIND as DOP853
from symgen.run.loops.integrator import Array, IntegratorParameter, Setup, law_functions

if TYPE_CHECKING:
    from symgen.run.layout.compiled import CompiledModel, ModelInfo
    from symgen.run.loops.run_spec import RunSpec


def lobatto(n: int) -> tuple[Array, Array]:
    """Return the n + 1 points and weights of Lobatto's quadrature on (-1, 1).

    Points are the ends and the zeros of P_n', weights 2 / (n (n + 1) P_n(x)^2).
    """
    inner = np.sort(legendre.Legendre.basis(n).deriv().roots().real)  # all are; from NumPy 2.5 on the type is complex
    slope, bend = legendre.Legendre.basis(n).deriv(), legendre.Legendre.basis(n).deriv(2)
    for _ in range(2):
        inner = inner - slope(inner) / bend(inner)
    x = np.concatenate([[-1.0], inner, [1.0]])
    x = 0.5 * (x - x[::-1])
    return x, 2.0 / (n * (n + 1) * legendre.Legendre.basis(n)(x) ** 2)


def legendre_integrals(terms: int, x: Array) -> tuple[Array, Array]:
    """Return integrals and second integrals from 0 to (1 + x) / 2 of shifted Legendre polynomials, one per row."""
    values = legendre.legvander(x, terms + 1).T
    k = np.arange(1, terms + 1)[:, np.newaxis]
    once = np.vstack([0.5 * (values[:1] + values[1:2]), (values[2:] - values[:-2]) / (4 * k + 2)])
    twice = np.vstack([0.5 * once[:1] ** 2, (once[2:] - once[:-2]) / (4 * k[:-1] + 2)])
    return once[:terms], twice[:terms]


@dataclass(frozen=True)
class Coefficients:
    """Coefficients of the scheme, named as in `symgen.run.layout.scheme_records.Nodes`."""

    table: Array
    middle: Array
    share: Array
    legendre: Array
    dense: Array


@lru_cache(maxsize=1)
def coefficients() -> Coefficients:
    """Return the coefficients of the scheme."""
    points, weights = lobatto(NODES)
    count = len(points)
    # Legendre coefficients of the polynomial through the rates: sums by the quadrature, which is exact but for the last
    norms = 2.0 / (2.0 * np.arange(count) + 1.0)
    norms[-1] = 2.0 / NODES
    through = legendre.legvander(points, NODES).T * weights / norms[:, np.newaxis]
    between = np.cos(np.pi * (np.arange(NODES, 0, -1) - 0.5) / NODES)
    every = np.concatenate([points[1:], between, points[:1]])
    through_all = np.linalg.inv(legendre.legvander(every, len(every) - 1))
    # the polynomial of degree 16 has no integral over a whole step, and is far below the last node
    dense = np.concatenate(
        [legendre.legvander(between, NODES).ravel("F"), through_all[:-1, NODES : 2 * NODES].T.ravel()]
    )

    def collocation(x: Array) -> Array:
        once, twice = legendre_integrals(count, x)
        return np.concatenate([(through.T @ once).ravel(), (through.T @ twice).ravel(), 0.5 * (1.0 + x)])

    table = np.zeros((count, 2 * NODES))
    table[:, :count] = through.T
    return Coefficients(collocation(points[1:]), collocation(between), 0.5 * weights[1:], table.ravel(), dense)


def rates_of(info: ModelInfo) -> NDArray[np.int64]:
    """Return the unknown rates, and the coordinates whose rates are among them (`symgen.compile.loopcode.nodes`)."""
    turning = {q + k for q, _ in info.spins for k in range(4)}
    spins = {v + k for _, v in info.spins for k in range(3)}
    coordinates = [i for i in range(info.nq) if i not in turning]
    velocities = [info.nq + j for j in range(info.nv) if j not in spins]
    of_velocity = dict(zip(velocities, coordinates, strict=True))
    rows = [i for i in range(info.ny) if i not in set(coordinates)]
    return np.array([len(rows), *rows, *(of_velocity.get(i, -1) for i in rows)], dtype=np.int64)


@dataclass(frozen=True)
class Picard:
    """The collocation scheme.

    Parameters
    ----------
    name, reference : str
        Name as typed, and the source.
    order : int
        Order of the state at the end of a step; rates inside a step have order 9.
    real_boundary : float
        Limit of steps on the negative real axis: Picard's iteration converges within the evaluations of a step.
    """

    row_targets: ClassVar[tuple[str, ...]] = ("cpu",)

    name: str
    order: int
    reference: str
    real_boundary: float
    forms: tuple[str, ...] = ("ode",)
    parameters: tuple[IntegratorParameter, ...] = ()
    adaptive: bool = True

    @property
    def stages(self) -> int:
        """Evaluations of a step: five at a time at all nodes."""
        return 5

    def loop(self, adaptive: bool) -> Any:
        """Return the loop for constant or adaptive steps."""
        from symgen.run.loops.schemes import picard

        return picard.adaptive if adaptive else picard.constant

    def setup(self, compiled: CompiledModel, spec: RunSpec, w: Array) -> Setup:
        """Return the arguments of the loop."""
        from symgen.run.layout.right_hand_side import rates_at_nodes
        from symgen.run.layout.scheme_records import Nodes
        from symgen.run.loops.schemes import picard_memory

        info, c = compiled.info, coefficients()
        derive, vector = rates_at_nodes(compiled)
        degree = int(min(max(1.0 - np.log10(spec.rtol), 4.0), NODES)) if spec.adaptive else NODES
        arrays = c.table, c.middle, c.share, c.legendre, c.dense
        scheme = Nodes(derive, vector, rates_of(info), *arrays, degree, DOP853.record(True))
        width = padded(info.ny)
        memory, room = picard_memory.memory(width), picard_memory.picard_room(width, info.kept)
        return Setup(self.loop(spec.adaptive), law_functions(compiled), scheme, spec.step or 0.0, memory, room)


KIND = Picard(
    name="picard",
    order=16,
    reference="van der Houwen, Sommeijer, J. Comput. Appl. Math. 29 (1990) 111-127, doi 10.1016/0377-0427(90)90200-J",
    real_boundary=1.1,
)

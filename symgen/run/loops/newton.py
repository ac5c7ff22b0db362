"""Plans of Newton matrices: their pattern, an order of low fill, and their entries from the output of ``tangent``.

A plan is made once a run from the pattern in the law's metadata; `symgen.run.loops.sparse` uses it.
"""

from __future__ import annotations

import heapq
from collections.abc import Sequence
from dataclasses import dataclass, field
from functools import lru_cache
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from symgen.run.loops import sparse

if TYPE_CHECKING:
    from symgen.run.layout.compiled import CompiledModel

Array = NDArray[np.float64]
Indices = NDArray[np.int64]


@dataclass(frozen=True)
class Pattern:
    """Places in the matrix of the numbers that ``tangent`` writes.

    Parameters
    ----------
    nq, nv, m, unknowns : int
        Sizes.
    rows, columns : Array of int64
        Equation and unknown of each number; columns from `unknowns` on belong to q and v. Numbers of the
        same place are summed.
    spins : Array of int64
        First indices in v of the angular velocities of bodies in space.
    masked : Array of int64
        Constraint rows that are left out as redundant.
    states : int
        Count of the file's own states: their rates are the last unknowns, and they are the last columns of the state.
    """

    nq: int
    nv: int
    m: int
    unknowns: int
    rows: Indices
    columns: Indices
    spins: Indices
    masked: Indices
    states: int = 0

    @classmethod
    def of(cls, compiled: CompiledModel, w: Array) -> Pattern:
        """Return the pattern of a compiled law; `w` holds the mask of redundant rows."""
        info, law = compiled.info, compiled.law
        places = np.asarray(law.tangent, dtype=np.int64).reshape(-1, 2)
        spins = np.array([j for _, j in info.spins], dtype=np.int64)
        masked = np.flatnonzero(compiled.section(w, "mask") > 0.0).astype(np.int64)
        rows, columns = (np.ascontiguousarray(places[:, i]) for i in (0, 1))
        return cls(info.nq, info.nv, info.m, law.unknowns, rows, columns, spins, masked, len(info.states))

    @property
    def size(self) -> int:
        """Length of the output of ``tangent``."""
        return len(self.rows)

    @property
    def width(self) -> int:
        """Length of q and v."""
        return self.nq + self.nv

    @property
    def dynamic(self) -> NDArray[np.bool_]:
        """Mask of the numbers in equations of motion."""
        return (self.rows >= self.nq) & (self.rows < self.width)

    @property
    def left_out(self) -> Indices:
        """Equations of redundant rows in a stage."""
        groups = (self.unknowns - self.states - self.width) // self.m if self.m else 0
        firsts = self.width + self.m * np.arange(groups, dtype=np.int64)
        return np.asarray((firsts[:, None] + self.masked).ravel(), dtype=np.int64)


@dataclass(frozen=True)
class Terms:
    """Terms of a matrix: entry (`rows`, `columns`) gets coefficient `factors` times source `sources`."""

    rows: Indices
    columns: Indices
    factors: Indices
    sources: Indices

    @classmethod
    def joined(cls, parts: Sequence[tuple[Indices, Indices, int, Indices]]) -> Terms:
        """Return terms from (rows, columns, one coefficient, sources)."""
        whole = [np.full(len(rows), factor, dtype=np.int64) for rows, _, factor, _ in parts]
        rows, columns, sources = (np.concatenate([p[i] for p in parts]).astype(np.int64) for i in (0, 1, 3))
        return cls(rows, columns, np.concatenate(whole), sources)


@dataclass
class Products:
    """Sources that are sums of products of others, and triples of sources of rotation vectors."""

    targets: list[int] = field(default_factory=list)
    left: list[int] = field(default_factory=list)
    right: list[int] = field(default_factory=list)
    triples: list[int] = field(default_factory=list)
    count: int = 0

    def add(self, target: int, left: int, right: int) -> None:
        """Add a product to a source."""
        self.targets.append(target)
        self.left.append(left)
        self.right.append(right)


def stage_plan(pattern: Pattern, a: Array, one: int) -> tuple[Indices, Array]:
    """Return the plan of stages solved together, matrix ``delta_ij dF/dk + h a_ij dF/dy``.

    Sources are the stages' numbers one after the other; coefficients are 1, then h a row by row.

    Parameters
    ----------
    pattern : Pattern
        Pattern of one stage.
    a : Array, shape (s, s)
        The tableau.
    one : int
        Index of the source that is 1.
    """
    n, s = pattern.unknowns, len(a)
    by_k, by_y = np.flatnonzero(pattern.columns < n), np.flatnonzero(pattern.columns >= n)
    parts = []
    for i in range(s):
        first = i * pattern.size
        parts.append((i * n + pattern.rows[by_k], i * n + pattern.columns[by_k], 0, first + by_k))
        for j in np.flatnonzero(a[i]):
            columns = j * n + pattern.columns[by_y] - n
            parts.append((i * n + pattern.rows[by_y], columns, 1 + s * i + int(j), first + by_y))
    left_out = (n * np.arange(s)[:, None] + pattern.left_out).ravel()
    return newton_plan(n, s, Terms.joined(parts), left_out, one, motion=(pattern.nq, pattern.width, pattern.m))


def alpha_plan(pattern: Pattern) -> tuple[Indices, Array, int]:
    """Return the plan of ``dF/dv' + h gamma dF/dv + h^2 beta dF/dq N T`` for the unknowns v' and lambda.

    The coefficients are 1, the factors of v and of q, and minus the factor of q (for products with ``-N``). The third
    value is the number of sources; the last one is 1.
    """
    nq = pattern.nq
    parts, products = _along_motion(pattern, pattern.rows >= nq)
    one, left_out = pattern.size + products.count, pattern.nv + pattern.masked
    motion = (0, pattern.nv, pattern.m)
    return *newton_plan(pattern.unknowns - nq, 1, Terms.joined(parts), left_out, one, products, motion), one + 1


def projection_plan(pattern: Pattern) -> tuple[Indices, Array, int]:
    """Return the plan of ``W = M + h/2 C + h^2/4 (K + a D^T D)``; each part has a coefficient.

    As in `alpha_plan`, minus the coefficient of K follows it; D^T D has the fifth. Rates of states follow rates
    of velocities.
    """
    nv, m, tail = pattern.nv, pattern.m, pattern.unknowns - pattern.states
    by_multiplier = (pattern.columns >= pattern.width) & (pattern.columns < tail)

    def join_patterns(place: Indices) -> Indices:
        return np.where(place < nv, place, place - m)

    parts, products = _along_motion(pattern, (pattern.dynamic | (pattern.rows >= tail)) & ~by_multiplier)
    parts = [(join_patterns(rows), join_patterns(columns), factor, sources) for rows, columns, factor, sources in parts]
    row, velocity, source = constraint_forces(pattern)
    by_row: dict[int, list[tuple[int, int]]] = {}
    for c, j, e in zip(row.tolist(), velocity.tolist(), source.tolist(), strict=True):
        by_row.setdefault(c, []).append((j, e))
    place: dict[tuple[int, int], int] = {}
    first = pattern.size + products.count
    for entries in by_row.values():
        for i, a in entries:
            for j, b in entries:
                products.add(first + place.setdefault((i, j), len(place)), a, b)
    pairs = np.array(list(place), dtype=np.int64).reshape(-1, 2)
    parts.append((pairs[:, 0], pairs[:, 1], 4, first + np.arange(len(place))))
    one, nothing = first + len(place), np.zeros(0, dtype=np.int64)
    return *newton_plan(nv + pattern.states, 1, Terms.joined(parts), nothing, one, products), one + 1


def acceleration_plan(pattern: Pattern) -> tuple[Indices, Array, int]:
    """Return the plan of ``[M D^T; E 0]`` for the unknowns v' and lambda, E being D at another state.

    Sources are the numbers of one state, then those of the other, then 1; the third value is their number.
    """
    masses = np.flatnonzero(pattern.dynamic & (pattern.columns < pattern.width))
    row, velocity, source = constraint_forces(pattern)
    nq, nv, one = pattern.nq, pattern.nv, 2 * pattern.size
    parts = [
        (pattern.rows[masses] - nq, pattern.columns[masses] - nq, 0, masses),
        (velocity, nv + row, 0, source),
        (nv + row, velocity, 0, pattern.size + source),
    ]
    motion = (0, nv, pattern.m)
    plan, numbers = newton_plan(nv + pattern.m, 1, Terms.joined(parts), nv + pattern.masked, one, motion=motion)
    return plan, numbers, one + 1


def constraint_forces(pattern: Pattern) -> tuple[Indices, Indices, Indices]:
    """Return row, velocity and source of the entries of D^T in the equations of motion."""
    width = pattern.width
    sources = np.flatnonzero(pattern.dynamic & (pattern.columns >= width) & (pattern.columns < width + pattern.m))
    return pattern.columns[sources] - width, pattern.rows[sources] - pattern.nq, sources


def _along_motion(
    pattern: Pattern, chosen: NDArray[np.bool_]
) -> tuple[list[tuple[Indices, Indices, int, Indices]], Products]:
    """Return the terms of derivatives by v and states, by changes of position and by unknowns from v' on.

    Rows have the `chosen` numbers, the first of which belongs to the first velocity. The kinematic map is read
    from the Jacobian itself, whose first rows belong to ``q' - N v``.
    """
    n, nq, nv = pattern.unknowns, pattern.nq, pattern.nv
    by_v = np.flatnonzero(chosen & (pattern.columns >= n + nq))
    by_q = np.flatnonzero(chosen & (pattern.columns >= n) & (pattern.columns < n + nq))
    by_k = np.flatnonzero(chosen & (pattern.columns >= nq) & (pattern.columns < n))
    by_rate = pattern.rows[by_v] - nq, pattern.columns[by_v] - n - nq, 1, by_v
    unknown = pattern.rows[by_k] - nq, pattern.columns[by_k] - nq, 0, by_k
    if nq == nv:
        return [by_rate, (pattern.rows[by_q] - nq, pattern.columns[by_q] - n, 2, by_q), unknown], Products()
    map_entries: dict[int, list[tuple[int, int]]] = {}
    for e in np.flatnonzero((pattern.rows < nq) & (pattern.columns >= n + nq)).tolist():
        map_entries.setdefault(int(pattern.rows[e]), []).append((int(pattern.columns[e]) - n - nq, e))
    place: dict[tuple[int, int], int] = {}
    products = Products()
    for e in by_q.tolist():
        for j, other in map_entries.get(int(pattern.columns[e]) - n, ()):
            products.add(pattern.size + place.setdefault((int(pattern.rows[e]), j), len(place)), e, other)
    starts = {int(j) + i: int(j) for j in pattern.spins for i in range(3)}
    for r, j in dict.fromkeys((r, starts[j]) for r, j in list(place) if j in starts):
        products.triples += [pattern.size + place.setdefault((r, j + i), len(place)) for i in range(3)] + [j]
    pairs = np.array(list(place), dtype=np.int64).reshape(-1, 2)
    turned = pairs[:, 0] - nq, pairs[:, 1], 3, pattern.size + np.arange(len(place))
    products.count = len(place)
    return [by_rate, turned, unknown], products


def newton_plan(
    n: int,
    stages: int,
    terms: Terms,
    left_out: Indices,
    one: int,
    products: Products | None = None,
    motion: tuple[int, int, int] = (0, 0, 0),
) -> tuple[Indices, Array]:
    """Return a plan and its numbers.

    Parameters
    ----------
    n, stages : int
        Unknowns of a stage, and stages in the matrix, one after the other.
    terms : Terms
        Terms of the matrix.
    left_out : Array of int64
        Equations replaced by *unknown = 0*.
    one : int
        Index of the source that is 1.
    products : Products, optional
        Sources computed first.
    motion : (int, int, int)
        Begin and end of the equations of motion and their accelerations in a stage, and number of multipliers that
        follow.

    Notes
    -----
    Redundant rows depend on the others only where the constraints hold: elsewhere such a row is independent by the size
    of the violation, so a threshold on pivots would accept it as regular, with multipliers of any size.
    """
    size, sums = n * stages, products or Products()
    independent = ~np.isin(terms.rows, left_out)
    nothing = np.zeros(len(left_out), dtype=np.int64)
    rows, columns = (np.concatenate([x[independent], left_out]) for x in (terms.rows, terms.columns))
    factors, sources = (
        np.concatenate([terms.factors[independent], nothing]),
        np.concatenate([terms.sources[independent], one + nothing]),
    )
    within, fill = _order_of_pattern(n, *((x % n).astype(np.int64).tobytes() for x in (rows, columns)))
    order = (np.array(within, dtype=np.int64)[:, None] + n * np.arange(stages)).ravel()
    position = np.empty(size, dtype=np.int64)
    position[order] = np.arange(size)
    entries, slots = np.unique(position[columns] * size + rows, return_inverse=True)
    begins = np.searchsorted(entries, size * np.arange(size + 1))
    first, end, multipliers = motion
    column, place = entries // size, order % n
    own = np.where((place >= end) & (place < end + multipliers), sparse.MULTIPLIER, sparse.OTHER)
    place = place[column]
    masses = np.flatnonzero((order[column] == entries % size) & (place >= first) & (place < end))
    own[column[masses]] = masses
    room = 2 * stages * stages * (fill + n)
    plan: list[tuple[int, Indices | Array | list[int]]] = [
        *((sparse.COLUMNS, begins), (sparse.ROWS, entries % size), (sparse.PLACES, np.zeros(len(entries)))),
        *((sparse.ORDER, order), (sparse.SLOTS, slots), (sparse.FACTORS, factors), (sparse.SOURCES, sources)),
        *((sparse.TARGETS, sums.targets), (sparse.LEFT, sums.left), (sparse.RIGHT, sums.right)),
        *((sparse.TRIPLES, sums.triples), (sparse.OWN, own)),
        *((sparse.WORK, np.zeros(9 * size)), (sparse.POOL, np.zeros(room))),
    ]
    head = np.zeros(sparse.N_HEAD, dtype=np.int64)
    head[[sparse.SIZE, sparse.ENTRIES, sparse.TERMS]] = size, len(entries), len(sources)
    head[[sparse.PRODUCTS, sparse.TURNS, sparse.ROOM]] = len(sums.targets), len(sums.triples) // 4, room
    at = sparse.N_HEAD
    for where, part in plan:
        head[where] = at
        at += len(part)
    whole = np.concatenate([head, *(np.asarray(part, dtype=np.int64) for _, part in plan)])
    return whole, np.zeros(len(entries) + 5 * size + room)


@lru_cache(maxsize=64)
def _order_of_pattern(n: int, rows: bytes, columns: bytes) -> tuple[list[int], int]:
    """Return `elimination_order`, which runs with the same pattern share: a search takes longer than a short run."""
    return elimination_order(n, *(np.frombuffer(places, dtype=np.int64) for places in (rows, columns)))


def elimination_order(n: int, rows: Indices, columns: Indices) -> tuple[list[int], int]:
    """Return an order of low fill, and the off-diagonal entries of L and U if all pivots are on the diagonal.

    Markowitz's rule (Management Science 3, 1957) on the diagonal: next is the unknown whose elimination can touch the
    fewest entries, ties by index. An unknown without diagonal entry, such as a multiplier, has to wait for all unknowns
    with diagonal entries that share two entries with it: its pivot is then from D M^-1 D^T, and not from a part of it
    that may be 0 in some positions.

    Parameters
    ----------
    n : int
        Unknowns.
    rows, columns : Array of int64
        Places of entries.
    """
    beside: list[set[int]] = [set() for _ in range(n)]  # other unknowns of each equation
    below: list[set[int]] = [set() for _ in range(n)]  # other equations of each unknown
    diagonal = [False] * n
    for i, j in set(zip(rows.tolist(), columns.tolist(), strict=True)):
        if i == j:
            diagonal[i] = True
        else:
            beside[i].add(j)
            below[j].add(i)
    waits_for = [0 if diagonal[i] else sum(diagonal[j] for j in beside[i] & below[i]) for i in range(n)]
    waiting = [[i for i in beside[j] & below[j] if diagonal[j] and not diagonal[i]] for j in range(n)]

    def rank_of_pattern(i: int) -> tuple[bool, int, int]:
        return waits_for[i] > 0, len(beside[i]) * len(below[i]), i

    queue = [rank_of_pattern(i) for i in range(n)]
    heapq.heapify(queue)
    done = [False] * n
    order: list[int] = []
    fill = 0
    while queue:
        entry = heapq.heappop(queue)
        pivot = entry[2]
        if done[pivot] or entry != rank_of_pattern(pivot):
            continue  # the entry is out of date
        done[pivot] = True
        order.append(pivot)
        unknowns, equations = beside[pivot], below[pivot]
        fill += len(unknowns) + len(equations)
        for i in equations:
            beside[i] |= unknowns
            beside[i] -= {pivot, i}
        for j in unknowns:
            below[j] |= equations
            below[j] -= {pivot, j}
        for i in waiting[pivot]:
            waits_for[i] -= 1
        for i in equations | unknowns:
            heapq.heappush(queue, rank_of_pattern(i))
    return order, fill

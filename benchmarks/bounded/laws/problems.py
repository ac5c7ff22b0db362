"""Drawn problems of rows with bounds, and all of their motions by trying what every row may do, in NumPy and SciPy."""

from __future__ import annotations

import itertools
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import root

from symgen.compile.loopcode.exact import plain_form
from symgen.run.laws.problem import BALL, PUSH, SECOND, begin_row, new_laws

Array = NDArray[np.float64]

#: What is missing at a motion, over the sizes of what it is made of.
TOLERANCE = 1e-7


@dataclass
class Row:
    """A row: it pushes, or has a bound ``beta + kappa |load|``.

    The load is the force of a row that pushes (`presser`), or a reaction ``apart - parts c``. `way` is the sign of a
    force in motion. A ball of two rows is `flat`: the row that follows it is its second one.
    """

    pushes: bool = False
    beta: float = 0.0
    kappa: float = 0.0
    presser: int = -1
    way: float = 0.0
    flat: bool = False
    apart: Array = field(default_factory=lambda: np.zeros(0))
    parts: Array = field(default_factory=lambda: np.zeros((0, 0)))


@dataclass
class Problem:
    """Accelerations ``offset - matrix c``, and the rows."""

    matrix: Array
    offset: Array
    rows: list[Row]

    def bound(self, i: int, c: Array) -> float:
        """Return the bound of a row."""
        row = self.rows[i]
        if row.presser >= 0:
            return row.beta + row.kappa * max(-float(c[row.presser]), 0.0)
        return row.beta + row.kappa * float(np.linalg.norm(row.apart - row.parts @ c)) if row.apart.size else row.beta

    def miss(self, c: Array) -> float:
        """Return what is missing at the laws, by the sizes that it is a difference of."""
        a, root_of = self.offset - self.matrix @ c, np.sqrt(np.diag(self.matrix))
        size = np.max(np.abs(self.offset) / root_of) + np.max(np.abs(c) * root_of)
        for i, row in enumerate(self.rows):
            if row.flat:
                root_of[i : i + 2] = np.sqrt(np.mean(root_of[i : i + 2] ** 2))  # one scale in a plane
        a, force, worst = a / root_of / size, c * root_of / size, 0.0
        for i, row in enumerate(self.rows):
            bound = self.bound(i, c) * root_of[i] / size
            if i > 0 and self.rows[i - 1].flat:
                continue
            if row.flat:
                worst = max(worst, _miss_in_plane(a[i : i + 2], force[i : i + 2], bound))
            elif row.pushes:
                worst = max(worst, force[i], -a[i], min(-force[i], a[i]))
            elif row.way:
                worst = max(worst, abs(force[i] - row.way * bound))
            else:
                worst = max(worst, abs(force[i]) - bound, min(bound - force[i], a[i]), min(bound + force[i], -a[i]))
        return float(worst)


def _miss_in_plane(a: Array, force: Array, bound: float) -> float:
    """Return what is missing at a ball of two rows: within the bound, and at it along the acceleration."""
    motion, size = float(np.hypot(*a)), float(np.hypot(*force))
    if motion <= TOLERANCE:
        return size - bound
    return max(abs(size - bound), float(np.hypot(*(force - bound * a / motion)))) if motion > 0.0 else size - bound


def draw(numbers: np.random.Generator, kinds: str, redundant: bool = False) -> Problem:
    """Return rows by letters.

    p pushes, d is dry friction, c a contact, s one in space; e, j and b are by reactions of 1, 2 and 3 components.
    """
    rows = list[Row]()
    for kind in kinds:
        if kind in "pcs":
            rows.append(Row(pushes=True))
        if kind == "c":
            rows.append(Row(kappa=float(numbers.uniform(0.05, 0.8)), presser=len(rows) - 1))
        elif kind == "s":
            mu = float(numbers.uniform(0.05, 0.8))
            rows += [Row(kappa=mu, presser=len(rows) - 1, flat=True), Row()]
        elif kind == "d":
            rows.append(Row(beta=float(2.0 * abs(numbers.normal()))))
        elif kind in "ejb":
            apart = 2.0 * numbers.normal(size=" ejb".index(kind))
            rows.append(Row(kappa=float(numbers.uniform(0.02, 0.3)), apart=apart))
    k = len(rows)
    n = max(1, k - 1 - int(numbers.integers(2))) if redundant else k + 2
    entries, masses = numbers.normal(size=(k, n)), np.exp(numbers.normal(size=n))
    offset = entries @ (3.0 * numbers.normal(size=n) / masses)
    for i, row in enumerate(rows):
        if row.pushes and numbers.random() < 0.8 and not redundant:
            offset[i] = -abs(offset[i])
        in_plane = row.flat or (i > 0 and rows[i - 1].flat)
        if not row.pushes and not in_plane and numbers.random() < 0.3:
            row.way = float(numbers.choice([-1.0, 1.0]))
        row.parts = 0.3 / np.sqrt(n) * numbers.normal(size=(row.apart.size, n)) / masses @ entries.T
    return Problem(entries / masses @ entries.T, offset, rows)


def filled(problem: Problem, kept: Any = None) -> Any:
    """Return the problem as the program has it."""
    k = len(problem.rows)
    laws = new_laws(k) if kept is None else kept
    laws.matrix[: k * k], laws.offset[:k] = problem.matrix.ravel(), problem.offset
    for i, row in enumerate(problem.rows):
        plain_form(begin_row)(k, i, laws)
        laws.law[i] = PUSH if row.pushes else SECOND if i > 0 and problem.rows[i - 1].flat else BALL
        laws.way[i], laws.beta[i], laws.kappa[i], laws.presser[i] = row.way, row.beta, row.kappa, row.presser
        laws.components[i] = row.apart.size
        for part in range(row.apart.size):
            laws.apart[3 * i + part] = row.apart[part]
            laws.parts[(3 * i + part) * k : (3 * i + part + 1) * k] = row.parts[part]
    return laws


def motions(problem: Problem) -> list[Array]:
    """Return the accelerations of all motions: equations without corners for each combination, then a check."""
    k, found = len(problem.rows), list[Array]()
    choices = ["01" if row.pushes else "m" if row.way else "0+-" for row in problem.rows]
    curved = any(row.apart.size for row in problem.rows)
    for combination in itertools.product(*choices):

        def missing(c: Array, does: tuple[str, ...] = combination) -> Array:
            a = (problem.offset - problem.matrix @ c) / np.diag(problem.matrix)
            out = np.zeros(k)
            for i, (row, what) in enumerate(zip(problem.rows, does, strict=True)):
                side = row.way if what == "m" else {"+": 1.0, "-": -1.0}.get(what, 0.0)
                load = -c[row.presser] if row.presser >= 0 else 0.0
                load = np.linalg.norm(row.apart - row.parts @ c) if row.apart.size else load
                bound = row.beta + row.kappa * load
                out[i] = a[i] if what == "0" else c[i] if what == "1" else c[i] - side * bound
            return out

        if curved:
            c = root(missing, np.zeros(k), tol=1e-13).x
        else:
            start = missing(np.zeros(k))
            columns = np.array([missing(unit) - start for unit in np.eye(k)]).T
            c = np.linalg.lstsq(columns, -start, rcond=1e-10)[0]
        a = problem.offset - problem.matrix @ c
        if problem.miss(c) < TOLERANCE and not any(
            np.allclose(a, b, rtol=0.0, atol=1e-5 * np.abs(problem.offset).max()) for b in found
        ):
            found.append(a)
    return found

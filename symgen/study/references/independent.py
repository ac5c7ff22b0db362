"""The equations of a planar mechanism by another route than the pipeline's, for references.

Positions of points are written out in the coordinates, and SymPy differentiates the whole constraints with respect to
them; nothing of `formulate`, `lower` or the emitted code is used but the translation of a file's formulas. Numbers come
from `sympy.lambdify`, accelerations from a dense least-squares solution in which dependent rows do no harm.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

import numpy as np
import sympy as sp
from numpy.typing import NDArray

from symgen.describe.evaluate import evaluate
from symgen.describe.mechanism import Body, Mechanism
from symgen.formulate.translate import to_sympy
from symgen.study.references.curves import curves
from symgen.vocabulary.expressions import ZERO, Expr, Reading, names, readings
from symgen.vocabulary.measures import (
    GROUND,
    Angle,
    Component,
    Direction,
    Distance,
    Driven,
    Effort,
    Exerted,
    Holonomic,
    Integral,
    LinkStretch,
    Marker,
    Measure,
    Nonholonomic,
    PointSpeed,
    Speed,
    Sum,
)

Array = NDArray[np.float64]

#: Singular values of D M^(-1/2) below this fraction of the largest belong to dependent rows.
CUTOFF = 1e-9


class IndependentEquations:
    """Phi, D, nu, gamma, f and M of a mechanism as numbers.

    Parameters
    ----------
    mechanism : Mechanism
        A validated planar mechanism.
    parameters : mapping
        Values of all its parameters; they become numbers in the formulas.
    """

    def __init__(self, mechanism: Mechanism, parameters: Mapping[str, float]) -> None:
        self.mechanism = mechanism
        self.parameters = parameters
        self.t = sp.Symbol("t", real=True)
        self.first: dict[str, int] = {}
        self.known: dict[str, Any] = {"t": self.t} | self._parameter_symbols()
        self.q, self.v = list[Any](), list[Any]()
        self._declare()
        self.n = len(self.q)
        self._weigh()
        rows = self._rows()
        self.m = len(rows)
        self._entries = [(i, j) for i, row in enumerate(rows) for j in row[1]]
        self._row_index = np.array([i for i, _ in self._entries], dtype=int)
        self._column_index = np.array([j for _, j in self._entries], dtype=int)
        outputs = [
            *(row[0] for row in rows),
            *(row[1][j] for i, row in enumerate(rows) for j in row[1]),
            *(row[2] for row in rows),
            *(row[3] for row in rows),
            *self._forces(),
        ]
        self._function = self._compile(outputs)

    def _weigh(self) -> None:
        """Set M, and its inverse root by which projections are shortest; massless bodies count there as usual ones."""
        self.mass = self._masses()
        heavy = self.mass[self.mass > 0.0]
        self.usual = float(heavy.mean()) if len(heavy) else 1.0
        self.root = 1.0 / np.sqrt(np.where(self.mass > 0.0, self.mass, self.usual))

    def _declare(self) -> None:
        """Make the symbols of coordinates and their rates, and what formulas call them."""
        for body in self.mechanism.bodies:
            self.first[body.name] = len(self.q)
            for coordinate, speed in zip(body.coordinates, body.speeds, strict=True):
                self.q.append(sp.Symbol(f"q{len(self.q)}", real=True))
                self.v.append(sp.Symbol(f"v{len(self.v)}", real=True))
                self.known[f"{body.name}.{coordinate}"] = self.q[-1]
                self.known[f"{body.name}.{speed}"] = self.v[-1]

    # -- numbers -------------------------------------------------------------------------------------------------------

    def state(self, q: Array, v: Array) -> Array:
        """Return what is integrated, for coordinates and velocities as results have them."""
        return np.concatenate([q, v])

    def evaluate(self, t: float, q: Array, v: Array) -> tuple[Array, Array, Array, Array, Array]:
        """Return Phi, D, nu, gamma and f at a state; nonholonomic rows have Phi 0."""
        flat = np.array(self._function(t, q.tolist(), v.tolist()), dtype=float)
        m, k = self.m, len(self._entries)
        d = np.zeros((m, self.n))
        d[self._row_index, self._column_index] = flat[m : m + k]
        return flat[:m], d, flat[m + k : 2 * m + k], flat[2 * m + k : 3 * m + k], flat[3 * m + k :]

    def rate(self, t: float, y: Array) -> Array:
        """Return (v, v'): of all v' with ``D v' = gamma`` the one nearest to M^-1 f in the metric of M (Gauss).

        With massless bodies, for which there is no M^-1 f, v' and multipliers are the solution of M v' + D^T l = f and
        D v' = gamma, the shortest where rows depend.
        """
        q, v = y[: self.n], y[self.n :]
        _, d, _, gamma, f = self.evaluate(t, q, v)
        if not np.all(self.mass > 0.0):
            rows = self.usual * d
            system = np.block([[np.diag(self.mass), rows.T], [rows, np.zeros((self.m, self.m))]])
            found = np.linalg.lstsq(system, np.concatenate([f, self.usual * gamma]), rcond=CUTOFF)[0]
            return np.concatenate([v, found[: self.n]])
        free = self.root * f
        scaled = d * self.root
        change = np.linalg.lstsq(scaled, gamma - scaled @ free, rcond=CUTOFF)[0]
        return np.concatenate([v, self.root * (free + change)])

    def project(self, t: float, y: Array, mass_weighted: bool = True) -> Array:
        """Return the nearest state that satisfies the constraints, positions first."""
        root = self.root if mass_weighted else np.ones(self.n)
        q, v = y[: self.n].copy(), y[self.n :].copy()
        for _ in range(4):
            phi, d, nu, _, _ = self.evaluate(t, q, v)
            q -= root * np.linalg.lstsq(d * root, phi, rcond=CUTOFF)[0]
            if np.linalg.norm(phi) < 1e-15 * max(1.0, float(np.abs(q).max())):
                break
        _, d, nu, _, _ = self.evaluate(t, q, v)
        v -= root * np.linalg.lstsq(d * root, d @ v - nu, rcond=CUTOFF)[0]
        return np.concatenate([q, v])

    def _compile(self, outputs: list[Any]) -> Callable[..., Any]:
        tables: dict[str, Callable[[float], float]] = {}
        for table in self.mechanism.tables:
            tables |= curves(table)
        function: Callable[..., Any] = sp.lambdify(
            [self.t, self.q, self.v], outputs, modules=[tables, "math"], cse=True
        )
        return function

    # -- formulas ------------------------------------------------------------------------------------------------------

    def _parameter_symbols(self) -> dict[str, Any]:
        """Return what stands for each parameter in the formulas: its value."""
        return {name: sp.Float(x) for name, x in self.parameters.items()}

    def _weight(self, i: int, mass: Expr, gravity: Expr) -> Any:
        """Return the component of a body's weight that belongs to velocity `i`."""
        return sp.Float(self.mass[i] * evaluate(gravity, self.parameters, "gravity"))

    def _expression(self, e: Expr, **placeholders: Any) -> Any:
        seen = {r.name: self._reading(r) for r in readings(e)}
        return to_sympy(e, {**self.known, **seen, **placeholders})

    def _reading(self, r: Reading) -> Any:
        """Return a measure's value, or its rate."""
        assert not isinstance(r.source, Speed | Exerted | Driven | Integral), "functions of state read measures"
        value = self._measure(r.source)
        return self._along(value) if r.order else value

    def _masses(self) -> Array:
        values = []
        for body in self.mechanism.bodies:
            mass = evaluate(body.mass, self.parameters, body.name)
            values += [mass, mass]
            if isinstance(body, Body) and body.inertia is not None:
                values.append(evaluate(body.inertia, self.parameters, body.name))
        return np.array(values)

    def _turned(self, body: str, x: Any, y: Any) -> tuple[Any, Any]:
        """Return a vector of the body frame in the ground frame."""
        if body == GROUND or self.mechanism.body(body).is_point:
            return x, y
        theta = self.q[self.first[body] + 2]
        c, s = sp.cos(theta), sp.sin(theta)
        return c * x - s * y, s * x + c * y

    def _position(self, marker: Marker) -> tuple[Any, Any]:
        x, y = (self._expression(e) for e in marker.point)
        if marker.body == GROUND:
            return x, y
        cx, cy = (self._expression(e) for e in self.mechanism.body(marker.body).centre_of_mass)
        dx, dy = self._turned(marker.body, x - cx, y - cy)
        i = self.first[marker.body]
        return self.q[i] + dx, self.q[i + 1] + dy

    def _direction(self, direction: Direction) -> tuple[Any, Any]:
        x, y = (self._expression(e) for e in direction.vector)
        return self._turned(direction.body, x, y)

    def _measure(self, m: Measure) -> Any:
        if isinstance(m, Angle):
            a, b = (sp.S.Zero if body == GROUND else self.q[self.first[body] + 2] for body in (m.a, m.b))
            return b - a
        if isinstance(m, Component | Distance | LinkStretch):
            (ax, ay), (bx, by) = self._position(m.a), self._position(m.b)
            dx, dy = bx - ax, by - ay
            if isinstance(m, Component):
                ex, ey = self._direction(m.along)
                return ex * dx + ey * dy
            if isinstance(m, Distance):
                return sp.sqrt(dx**2 + dy**2)
            length = self._expression(m.length)
            return (dx**2 + dy**2 - length**2) / (2 * length)
        assert isinstance(m, Sum), "measures of space are not derived here"
        return sum((self._expression(k) * self._measure(part) for k, part in m.terms), sp.S.Zero)

    def _gradient(self, s: Any) -> dict[int, Any]:
        free = s.free_symbols
        found = {i: sp.diff(s, symbol) for i, symbol in enumerate(self.q) if symbol in free}
        return {i: e for i, e in found.items() if e != 0}

    def _along(self, e: Any) -> Any:
        """Return the derivative of a function of q along the motion."""
        return sum((d * self.v[i] for i, d in self._gradient(e).items()), sp.S.Zero)

    def _rows(self) -> list[tuple[Any, dict[int, Any], Any, Any]]:
        return [self._row(row) for joint in self.mechanism.joints for row in joint.rows]

    def _row(self, row: Holonomic | Nonholonomic) -> tuple[Any, dict[int, Any], Any, Any]:
        """Return phi, the entries of D, nu and gamma."""
        value = self._expression(row.value)
        slope = sp.diff(value, self.t)
        if isinstance(row, Holonomic):
            s = self._measure(row.measure)
            gradient = self._gradient(s)
            bias = self._along_row(gradient)
            return s - value, gradient, slope, sp.diff(slope, self.t) - bias
        assert isinstance(row.speed, PointSpeed), "speeds of space are not derived here"
        (px, py), (ex, ey) = self._position(row.speed.at), self._direction(row.speed.along)
        gx, gy = self._gradient(px), self._gradient(py)
        entries = {i: ex * gx.get(i, 0) + ey * gy.get(i, 0) for i in sorted({*gx, *gy})}
        return sp.S.Zero, entries, value, slope - self._along_row(entries)

    def _along_row(self, entries: Mapping[int, Any]) -> Any:
        return sum((self._along(e) * self.v[i] for i, e in entries.items()), sp.S.Zero)

    def _forces(self) -> list[Any]:
        total = [sp.S.Zero] * self.n
        for body in self.mechanism.bodies:
            for i, gravity in enumerate(self.mechanism.gravity, self.first[body.name]):
                total[i] += self._weight(i, body.mass, gravity)
        for force in self.mechanism.forces:
            for effort in force.efforts:
                for i, e in self._effort(effort).items():
                    total[i] += e
        return total

    def _effort(self, effort: Effort) -> dict[int, Any]:
        assert not isinstance(effort.measure, PointSpeed), "forces along velocities stand in space only"
        value = self._measure(effort.measure)
        gradient = self._gradient(value)
        rate = sum((e * self.v[i] for i, e in gradient.items()), sp.S.Zero)
        total = self._expression(effort.magnitude, s=value, rate=rate)
        if effort.potential != ZERO and "s" in set(names(effort.potential)):
            s = sp.Symbol("s", real=True)
            total -= sp.diff(self._expression(effort.potential, s=s), s).subs(s, value)
        return {i: e * total for i, e in gradient.items()}

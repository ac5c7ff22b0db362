"""The equations of a spatial mechanism by another route than the pipeline's, for references.

Euler parameters are coordinates like any others here: the velocities are their rates, there is no angular velocity in
the equations, and |e| = 1 is a constraint row beside the joints'. SymPy differentiates the whole constraints with
respect to the coordinates, with the rotation matrix in its inhomogeneous form 1 - 2 (e2^2 + e3^2), and derives the
inertia terms from the kinetic energy as Lagrange's equations say. The mass matrix of the four rates, which is singular
along e, is completed there; with |e| = 1 among the rows Gauss's principle gives the same accelerations. Nothing of
`formulate`, `lower` or the emitted code is used but the translation of a file's formulas.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from typing import Any

import numpy as np
import sympy as sp
from numpy.typing import NDArray

from symgen.describe.evaluate import evaluate
from symgen.describe.mechanism import Mechanism, SpatialBody
from symgen.study.references.curves import curves
from symgen.study.references.independent import CUTOFF, IndependentEquations
from symgen.vocabulary.expressions import ZERO, names
from symgen.vocabulary.measures import (
    GROUND,
    Bearing,
    BladeSpeed,
    Component,
    Direction,
    Distance,
    Dot,
    Effort,
    Holonomic,
    LinkStretch,
    Marker,
    Measure,
    Nonholonomic,
    PointSpeed,
    RimHeight,
    Speed,
    Spin,
    Sum,
    Turn,
)

Array = NDArray[np.float64]


def independent_equations(mechanism: Mechanism, parameters: Mapping[str, float]) -> IndependentEquations:
    """Return the independent equations of a planar or spatial mechanism."""
    kind = SpatialEquations if mechanism.space == "spatial" else IndependentEquations
    return kind(mechanism, parameters)


class SpatialEquations(IndependentEquations):
    """Phi, D, nu, gamma and f of a spatial mechanism as numbers, in coordinates and their rates."""

    def _weigh(self) -> None:
        super()._weigh()
        self._first_e = np.array([i for i, _ in self.spins], dtype=int)
        self._tensors = np.array([tensor for _, tensor in self.spins]).reshape(-1, 3, 3)
        straight = np.ones(self.n, dtype=bool)
        for i in self._first_e:
            straight[i : i + 4] = False
        self._straight = np.flatnonzero(straight)

    def _declare(self) -> None:
        #: For each body that turns: where its Euler parameters begin, and its inertia tensor.
        self.spins: list[tuple[int, Array]] = []
        self._angles: list[Any] = []
        self._whole_turns: list[Any] = []
        self._seen: list[float] = []
        self.rank: int | None = None
        for body in self.mechanism.bodies:
            assert isinstance(body, SpatialBody), "a mechanism is planar or spatial as a whole"
            i = self.first[body.name] = len(self.q)
            for coordinate in body.coordinates:
                self.q.append(sp.Symbol(f"q{len(self.q)}", real=True))
                self.v.append(sp.Symbol(f"v{len(self.v)}", real=True))
                self.known[f"{body.name}.{coordinate}"] = self.q[-1]
            rates = self.v[i : i + 3]
            if not body.is_point:
                rates = [*rates, *_angular_velocity(self.q[i + 3 : i + 7], self.v[i + 3 : i + 7])]
            self.known |= {f"{body.name}.{s}": rate for s, rate in zip(body.speeds, rates, strict=True)}

    # -- numbers -------------------------------------------------------------------------------------------------------

    def state(self, q: Array, v: Array) -> Array:
        """Return coordinates and their rates, shape (2 n,), for velocities as results have them."""
        rates, at = np.zeros(self.n), 0
        for body in self.mechanism.bodies:
            i = self.first[body.name]
            rates[i : i + 3] = v[at : at + 3]
            if len(body.speeds) == 6:
                rates[i + 3 : i + 7] = 0.5 * _turning(q[i + 3 : i + 7]).T @ v[at + 3 : at + 6]
            at += len(body.speeds)
        return np.concatenate([q, rates])

    def velocities(self, y: Array) -> Array:
        """Return the velocities as results have them: angular velocity in body axes."""
        found = list[Array]()
        for body in self.mechanism.bodies:
            i = self.first[body.name]
            found.append(y[self.n + i : self.n + i + 3])
            if len(body.speeds) == 6:
                found.append(2.0 * _turning(y[i + 3 : i + 7]) @ y[self.n + i + 3 : self.n + i + 7])
        return np.concatenate(found)

    def project(self, t: float, y: Array, mass_weighted: bool = True) -> Array:
        """Return a state nearby that satisfies the constraints; counts the rows that are independent there."""
        y = super().project(t, y, mass_weighted)
        d = self.evaluate(t, y[: self.n], y[self.n :])[1] * self.root
        values = np.linalg.svd(d, compute_uv=False)
        self.rank = max(self.rank or 0, int(np.sum(values > CUTOFF * values[0])))
        return y

    def rate(self, t: float, y: Array) -> Array:
        """Return (q', q''), accelerations by Gauss's principle.

        The stages of a step leave the constraints, where redundant rows are no longer dependent: so many directions
        count as there were at the last projection, not those above some threshold.
        """
        n = self.n
        q, v = y[:n], y[n:]
        _, d, _, gamma, f = self.evaluate(t, q, v)
        if not self.regular:
            return np.concatenate([v, self._with_multipliers(q, d, gamma, f)])
        root = self._root(q)
        free = root.T @ f
        scaled = d @ root
        missing = gamma - scaled @ free
        if self.rank == self.m:
            basis, r = np.linalg.qr(scaled.T)
            change = basis @ np.linalg.solve(r.T, missing)
        else:
            u, values, w = np.linalg.svd(scaled, full_matrices=False)
            rank = self.rank if self.rank is not None else int(np.sum(values > CUTOFF * values[0]))
            change = w[:rank].T @ ((u[:, :rank].T @ missing) / values[:rank])
        return np.concatenate([v, root @ (free + change)])

    def _root(self, q: Array) -> Array:
        """Return R with M^-1 = R R^T, the mass matrix of the rates completed along e."""
        root = np.zeros((self.n, self.n))
        root[self._straight, self._straight] = self.root[self._straight]
        for i, block in zip(self._first_e, np.linalg.inv(np.linalg.cholesky(self._inertia(q))), strict=True):
            root[i : i + 4, i : i + 4] = block.T
        return root

    def _with_multipliers(self, q: Array, d: Array, gamma: Array, f: Array) -> Array:
        """Return q'' of M q'' + D^T l = f and D q'' = gamma, D by its independent rows: M may have no inverse."""
        mass = np.diag(self.mass)
        for i, block in zip(self._first_e, self._inertia(q), strict=True):
            mass[i : i + 4, i : i + 4] = block
        u, values, w = np.linalg.svd(d, full_matrices=False)
        rank = self.rank if self.rank is not None else int(np.sum(values > CUTOFF * values[0]))
        rows = self.usual * w[:rank]
        system = np.block([[mass, rows.T], [rows, np.zeros((rank, rank))]])
        asked = self.usual * (u[:, :rank].T @ gamma) / values[:rank]
        found: Array = np.linalg.solve(system, np.concatenate([f, asked]))[: self.n]
        return found

    def _inertia(self, q: Array) -> Array:
        """Return the mass matrices of the rates of Euler parameters, completed along e; shape (bodies, 4, 4)."""
        e = q[self._first_e[:, None] + np.arange(4)]
        turning = np.array([_turning(row) for row in e]).reshape(-1, 3, 4)
        along = np.trace(self._tensors, axis1=1, axis2=2)[:, None, None] * e[:, :, None] * e[:, None, :]
        found: Array = 4.0 * np.swapaxes(turning, 1, 2) @ self._tensors @ turning + along
        return found

    def _compile(self, outputs: list[Any]) -> Callable[..., Any]:
        tables: dict[str, Callable[[float], float]] = {}
        for table in self.mechanism.tables:
            tables |= curves(table)
        inputs = [self.t, self.q, self.v, self._whole_turns]
        function = sp.lambdify(inputs, [*outputs, *self._angles], modules=[tables, "math"], cse=True)
        count = len(self._angles)
        if count == 0:
            return lambda t, q, v: function(t, q, v, [])
        asking = [
            (row, k, float(sp.diff(phi, turn)))
            for row, phi in enumerate(outputs[: self.m])
            for k, turn in enumerate(self._whole_turns)
            if turn in phi.free_symbols
        ]

        def begun(t: float, q: list[float], v: list[float]) -> list[float]:
            """Return the whole turns of a start: those that rows ask for, one angle by each row, and none otherwise."""
            turns, used = [0.0] * count, set[int]()
            for row, k, factor in asking:
                if row not in used and turns[k] == 0.0:
                    turns[k] = -float(round(function(t, q, v, turns)[row] / factor))
                    used.add(row)
            return turns

        def counted(t: float, q: list[float], v: list[float]) -> Any:
            """Evaluate with each angle on the branch nearest to its last value; a run begins at t = 0."""
            raw = function(t, q, v, [0.0] * count)[-count:]
            if t == 0.0:
                turns = begun(t, q, v)
            else:
                before = self._seen or [0.0] * count
                turns = [math.floor((last - angle) / math.tau + 0.5) for last, angle in zip(before, raw, strict=True)]
            self._seen = [angle + math.tau * turn for angle, turn in zip(raw, turns, strict=True)]
            return function(t, q, v, turns)[:-count]

        return counted

    # -- inertia -------------------------------------------------------------------------------------------------------

    def _masses(self) -> Array:
        """Return the masses, and for Euler parameters a moment of inertia: the metric of projections."""
        values, self.regular = list[float](), True
        for body in self.mechanism.bodies:
            mass = evaluate(body.mass, self.parameters, body.name)
            values += [mass] * 3
            if isinstance(body, SpatialBody) and body.inertia is not None:
                xx, yy, zz, xy, xz, yz = (evaluate(e, self.parameters, body.name) for e in body.inertia)
                tensor = np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])
                self.spins.append((len(values), tensor))
                values += [4.0 * max(xx, yy, zz)] * 4
                principal = np.linalg.eigvalsh(tensor)
                mass = mass if principal[0] > CUTOFF * principal[-1] else 0.0
            self.regular = self.regular and mass > 0.0
        return np.array(values)

    def _forces(self) -> list[Any]:
        total = super()._forces()
        for i, tensor in self.spins:
            e, rates = self.q[i : i + 4], self.v[i : i + 4]
            omega = sp.Matrix(_angular_velocity(e, rates))
            kinetic = (omega.T * sp.Matrix(tensor.tolist()) * omega)[0] / 2
            for k in range(4):
                momentum = sp.diff(kinetic, rates[k])
                along = sum((sp.diff(momentum, e[j]) * rates[j] for j in range(4)), sp.S.Zero)
                total[i + k] += sp.diff(kinetic, e[k]) - along
        return total

    def _effort(self, effort: Effort) -> dict[int, Any]:
        if not isinstance(effort.measure, Spin | PointSpeed):
            return super()._effort(effort)
        assert effort.potential == ZERO or "s" not in set(names(effort.potential)), "velocities have no value"
        rate = self._spin(effort.measure) if isinstance(effort.measure, Spin) else self._speed(effort.measure)
        total = self._expression(effort.magnitude, s=sp.S.Zero, rate=rate)
        return {i: e * total for i, e in self._by_rates(rate).items()}

    # -- geometry ------------------------------------------------------------------------------------------------------

    def _rows(self) -> list[tuple[Any, dict[int, Any], Any, Any]]:
        """Return the joints' rows, and one for the length of each body's Euler parameters."""
        lengths = []
        for i, _ in self.spins:
            e, rates = self.q[i : i + 4], self.v[i : i + 4]
            phi = (sum((x**2 for x in e), sp.S.Zero) - 1) / 2
            lengths.append((phi, {i + k: e[k] for k in range(4)}, sp.S.Zero, -sum((x**2 for x in rates), sp.S.Zero)))
        return super()._rows() + lengths

    def _row(self, row: Holonomic | Nonholonomic) -> tuple[Any, dict[int, Any], Any, Any]:
        if isinstance(row, Holonomic):
            return super()._row(row)
        value = self._expression(row.value)
        speed = self._speed(row.speed)
        bias = sum((sp.diff(speed, x) * v for x, v in zip(self.q, self.v, strict=True)), sp.S.Zero)
        return sp.S.Zero, self._by_rates(speed), value, sp.diff(value, self.t) - bias

    def _by_rates(self, speed: Any) -> dict[int, Any]:
        """Return the coefficients of the rates in something linear in them."""
        free = speed.free_symbols
        found = {i: sp.diff(speed, v) for i, v in enumerate(self.v) if v in free}
        return {i: e for i, e in found.items() if e != 0}

    def _turned3(self, body: str, vector: sp.Matrix) -> sp.Matrix:
        """Return a vector of the body frame in the ground frame."""
        if body == GROUND or self.mechanism.body(body).is_point:
            return vector
        i = self.first[body] + 3
        a, b, c, d = self.q[i : i + 4]
        matrix = sp.Matrix(
            [
                [1 - 2 * (c**2 + d**2), 2 * (b * c - a * d), 2 * (b * d + a * c)],
                [2 * (b * c + a * d), 1 - 2 * (b**2 + d**2), 2 * (c * d - a * b)],
                [2 * (b * d - a * c), 2 * (c * d + a * b), 1 - 2 * (b**2 + c**2)],
            ]
        )
        return matrix * vector

    def _place(self, marker: Marker) -> sp.Matrix:
        point = sp.Matrix([self._expression(e) for e in marker.point])
        if marker.body == GROUND:
            return point
        centre = sp.Matrix([self._expression(e) for e in self.mechanism.body(marker.body).centre_of_mass])
        i = self.first[marker.body]
        return sp.Matrix(self.q[i : i + 3]) + self._turned3(marker.body, point - centre)

    def _pointing(self, direction: Direction) -> sp.Matrix:
        return self._turned3(direction.body, sp.Matrix([self._expression(e) for e in direction.vector]))

    def _measure(self, m: Measure) -> Any:
        if isinstance(m, Component | Distance | LinkStretch):
            away = self._place(m.b) - self._place(m.a)
            if isinstance(m, Component):
                return self._pointing(m.along).dot(away)
            if isinstance(m, Distance):
                return sp.sqrt(away.dot(away))
            length = self._expression(m.length)
            return (away.dot(away) - length**2) / (2 * length)
        if isinstance(m, Dot):
            return self._pointing(m.u).dot(self._pointing(m.v))
        if isinstance(m, Turn):
            return self._angle(self._pointing(m.pointer), m.zero, m.quarter)
        if isinstance(m, Bearing):
            return self._angle(self._place(m.b) - self._place(m.a), m.zero, m.quarter)
        if isinstance(m, RimHeight):
            normal, axis = self._pointing(m.normal), self._pointing(m.axis)
            height = normal.dot(self._place(m.centre) - self._place(m.plane))
            return height - self._expression(m.radius) * sp.sqrt(1 - normal.dot(axis) ** 2)
        assert isinstance(m, Sum), f"no such measure in space: {type(m).__name__}"
        return sum((self._expression(k) * self._measure(part) for k, part in m.terms), sp.S.Zero)

    def _angle(self, pointer: sp.Matrix, zero: Direction, quarter: Direction) -> Any:
        """Return an angle about the axis zero x quarter, plus the whole turns that are counted beside it."""
        angle = sp.atan2(pointer.dot(self._pointing(quarter)), pointer.dot(self._pointing(zero)))
        if angle not in self._angles:
            self._angles.append(angle)
            self._whole_turns.append(sp.Symbol(f"n{len(self._angles)}", real=True))
        return angle + 2 * sp.pi.evalf(17) * self._whole_turns[self._angles.index(angle)]

    # -- speeds --------------------------------------------------------------------------------------------------------

    def _omega(self, body: str) -> sp.Matrix:
        """Return the angular velocity in ground axes."""
        if body == GROUND or self.mechanism.body(body).is_point:
            return sp.zeros(3, 1)
        i = self.first[body] + 3
        return self._turned3(body, sp.Matrix(_angular_velocity(self.q[i : i + 4], self.v[i : i + 4])))

    def _spin(self, m: Spin) -> Any:
        return self._pointing(m.along).dot(self._omega(m.b) - self._omega(m.a))

    def _velocity(self, marker: Marker) -> sp.Matrix:
        return sp.Matrix([self._along(x) for x in self._place(marker)])

    def _speed(self, speed: Speed) -> Any:
        if isinstance(speed, PointSpeed):
            return self._pointing(speed.along).dot(self._velocity(speed.at))
        if isinstance(speed, BladeSpeed):
            across = self._pointing(speed.normal).cross(self._pointing(speed.blade))
            return self._velocity(speed.at).dot(across) / sp.sqrt(across.dot(across))
        along, down = self._pointing(speed.along), -self._pointing(speed.normal)
        if speed.axis is not None:  # a thin disc touches with its lowest point
            axis = self._pointing(speed.axis)
            down = down - axis.dot(down) * axis
            down = down / sp.sqrt(down.dot(down))
        arm = self._expression(speed.radius) * down
        return along.dot(self._velocity(speed.centre) + self._omega(speed.centre.body).cross(arm))


def _angular_velocity(e: list[Any], rates: list[Any]) -> list[Any]:
    """Return omega = 2 L(e) e' in body axes."""
    a, b, c, d = e
    p, q, r, s = rates
    return [
        2 * (-b * p + a * q + d * r - c * s),
        2 * (-c * p - d * q + a * r + b * s),
        2 * (-d * p + c * q - b * r + a * s),
    ]


def _turning(e: Array) -> Array:
    """Return L(e), shape (3, 4), with omega = 2 L e' in body axes."""
    a, b, c, d = e
    return np.array([[-b, a, d, -c], [-c, -d, a, b], [-d, c, -b, a]])

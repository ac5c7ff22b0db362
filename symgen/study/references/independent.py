"""Numerical evaluation of the independently derived equations of a mechanism, for references.

The formulas are those of `symgen.study.references.sympy_formulas`, their numbers come from `sympy.lambdify`, and
accelerations from a dense solution in which dependent rows do no harm. In space the mass matrix of the rates of Euler
parameters, which is singular along e, is completed there; with |e| = 1 among the rows Gauss's principle gives the same
accelerations.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING, Any

import numpy as np
import sympy as sp
from numpy.typing import NDArray

from symgen.base.errors import InputError
from symgen.describe.bounds.bounded_modes import rows_by_family
from symgen.describe.formulas.evaluate import evaluate_formula
from symgen.describe.formulas.results_read import reads_results
from symgen.describe.mechanism import Body, Mechanism
from symgen.describe.parts.holding_joints import refuse_holding
from symgen.describe.parts.passing_ropes import refuse_rope_sheaves
from symgen.study.references.differences import difference_jacobian
from symgen.study.references.sympy_formulas import TENSOR, ReferenceFormulas

if TYPE_CHECKING:
    from symgen.describe.table_functions import Table

Array = NDArray[np.float64]

#: Singular values of D M^(-1/2) below this fraction of the largest belong to dependent rows.
CUTOFF = 1e-9
#: A joint with more than this in a combination of rows that moves nothing has no unique reaction.
SHARE = 1e-8


class IndependentEquations:
    """Numerical Phi, D, nu, gamma, f and M of a mechanism, in coordinates and their rates.

    A state of these equations is the coordinates, their rates, and the states that the file defines.

    Parameters
    ----------
    mechanism : Mechanism
        A validated mechanism.
    parameters : mapping
        Values of all its parameters; they become numbers in the formulas.
    """

    def __init__(self, mechanism: Mechanism, parameters: Mapping[str, float]) -> None:
        for family in rows_by_family(mechanism):
            expected = "a mechanism that is derived a second time, for references"
            raise InputError(
                mechanism.name, expected, f"one with {family.noun}", "symgen run --verify estimates errors"
            )
        refuse_holding(f"{mechanism.name}: a second derivation", mechanism)
        refuse_rope_sheaves(mechanism.name, mechanism)
        if any(reads_results(x.rate) for x in mechanism.states):
            expected = "a mechanism that is derived a second time, for references"
            got = "one whose states read accelerations or forces"
            raise InputError(mechanism.name, expected, got, "symgen run --verify estimates errors")
        self.mechanism = mechanism
        self.parameters = parameters
        self.rank: int | None = None
        formulas = ReferenceFormulas(mechanism, self._parameter_symbols())
        self.n, self.first = len(formulas.q), formulas.first
        self._set_masses()
        rows = formulas.rows()
        self.m = len(rows)
        self._entries = [(i, j) for i, row in enumerate(rows) for j in row[1]]
        self._row_index = np.array([i for i, _ in self._entries], dtype=int)
        self._column_index = np.array([j for _, j in self._entries], dtype=int)
        outputs = [
            *(row[0] for row in rows),
            *(row[1][j] for i, row in enumerate(rows) for j in row[1]),
            *(row[2] for row in rows),
            *(row[3] for row in rows),
            *formulas.forces(),
            *formulas.state_rates(),
        ]
        turning = formulas.rotor_masses()
        self._rotor_index = np.array(sorted(turning), dtype=int).reshape(-1, 2).T
        outputs += [turning[key] for key in sorted(turning)]
        # the second slope of a kink is zero but at the kink itself
        outputs = [sp.sympify(e).replace(sp.DiracDelta, lambda *_: sp.S.Zero) for e in outputs]
        self._function = self._compile(formulas, outputs)

    def _set_masses(self) -> None:
        """Set M, and its inverse root as the metric of projections; there massless bodies count as usual ones."""
        mass, tensors, self.regular = list[float](), list[Array](), True
        self._first_e = list[int]()  # where the Euler parameters of each body that turns in space begin
        for body in self.mechanism.bodies:
            own = [evaluate_formula(body.mass, self.parameters, body.name)]
            mass += own * len(body.position)
            if isinstance(body, Body):
                own += [] if body.inertia is None else [evaluate_formula(body.inertia, self.parameters, body.name)]
                mass += own[1:]
            elif body.inertia is not None:
                entries = np.array([evaluate_formula(e, self.parameters, body.name) for e in body.inertia])
                tensors.append(entries[np.array(TENSOR)])
                self._first_e.append(len(mass))
                mass += [4.0 * float(entries[:3].max())] * 4
                principal = np.linalg.eigvalsh(tensors[-1])
                own.append(float(principal[0] - CUTOFF * principal[-1]))
            self.regular = self.regular and min(own) > 0.0
        self.mass, self._tensors = np.array(mass), np.array(tensors).reshape(-1, 3, 3)
        heavy = self.mass[self.mass > 0.0]
        self.usual = float(heavy.mean()) if len(heavy) else 1.0
        self.root = 1.0 / np.sqrt(np.where(self.mass > 0.0, self.mass, self.usual))

    # -- states --------------------------------------------------------------------------------------------------------

    @property
    def starts(self) -> Array:
        """Where the states of the file begin."""
        states = self.mechanism.states
        return np.array([evaluate_formula(x.start, self.parameters, x.name) for x in states], dtype=np.float64)

    def state(self, q: Array, v: Array, z: Array | None = None) -> Array:
        """Return a state for velocities as in results; states of the file are `z`, by default where they begin."""
        rates = list[Array]()
        for body in self.mechanism.bodies:
            speeds, v = np.split(v, [len(body.speeds)])
            if len(speeds) == 6:
                e = q[self.first[body.name] + 3 :][:4]
                speeds = np.concatenate([speeds[:3], 0.5 * _rate_matrix(e).T @ speeds[3:]])
            rates.append(speeds)
        return np.concatenate([q, *rates, self.starts if z is None else z])

    def velocities(self, y: Array) -> Array:
        """Return the velocities as in results: angular velocity in body axes."""
        speeds = list[Array]()
        for body in self.mechanism.bodies:
            i, size = self.first[body.name], len(body.coordinates)
            rates = y[self.n + i : self.n + i + size]
            if size == 7:
                rates = np.concatenate([rates[:3], 2.0 * _rate_matrix(y[i + 3 : i + 7]) @ rates[3:]])
            speeds.append(rates)
        return np.concatenate(speeds)

    def evaluate(self, t: float, q: Array, v: Array) -> tuple[Array, Array, Array, Array, Array]:
        """Return Phi, D, nu, gamma and f at a state; nonholonomic rows have Phi 0.

        States of the file may follow `v`; else they are 0.
        """
        return self._split_numbers(self._numbers(t, q, v))

    def _numbers(self, t: float, q: Array, v: Array) -> Array:
        """Return the numbers that `evaluate` parts, then the rates of states and the masses of rotors."""
        rest = np.zeros(self.n + len(self.mechanism.states) - len(v))
        return np.array(self._function(t, q.tolist(), [*v.tolist(), *rest.tolist()]), dtype=float)

    def _split_numbers(self, flat: Array) -> tuple[Array, Array, Array, Array, Array]:
        m, k = self.m, len(self._entries)
        d = np.zeros((m, self.n))
        d[self._row_index, self._column_index] = flat[m : m + k]
        first = 3 * m + k
        return flat[:m], d, flat[m + k : 2 * m + k], flat[2 * m + k : first], flat[first : first + self.n]

    def _rates_and_rotor_masses(self, flat: Array) -> tuple[Array, Array]:
        """Return the rates of states, and the masses of rotors in the order of their places."""
        first = 3 * self.m + len(self._entries) + self.n
        count = len(self.mechanism.states)
        return flat[first : first + count], flat[first + count :]

    def nearest_state(self, t: float, y: Array, mass_weighted: bool = True) -> Array:
        """Return the nearest state that satisfies the constraints, positions first; counts the independent rows."""
        root = self.root if mass_weighted else np.ones(self.n)
        q, v, z = y[: self.n].copy(), y[self.n : 2 * self.n].copy(), y[2 * self.n :]
        for _ in range(4):
            phi, d, nu, _, _ = self.evaluate(t, q, v)
            q -= root * np.linalg.lstsq(d * root, phi, rcond=CUTOFF)[0]
            if np.linalg.norm(phi) < 1e-15 * max(1.0, float(np.abs(q).max())):
                break
        _, d, nu, _, _ = self.evaluate(t, q, v)
        v -= root * np.linalg.lstsq(d * root, d @ v - nu, rcond=CUTOFF)[0]
        values = np.linalg.svd(d * self.root, compute_uv=False)
        self.rank = max(self.rank or 0, int(np.sum(values > CUTOFF * values.max(initial=0.0))))
        return np.concatenate([q, v, z])

    def rate(self, t: float, y: Array) -> Array:
        """Return (q', q'', z'): of all q'' with ``D q'' = gamma`` the one nearest to M^-1 f in the metric of M (Gauss).

        Within a step redundant rows become independent: the rank of the last projection is used. With massless bodies,
        which have no M^-1 f, q'' and multipliers are the solution of M q'' + D^T l = f and D q'' = gamma.
        """
        n = self.n
        q, v = y[:n], y[n : 2 * n]
        flat = self._numbers(t, q, y[n:])
        _, d, _, gamma, f = self._split_numbers(flat)
        own, turning = self._rates_and_rotor_masses(flat)
        if not self.regular:
            return np.concatenate([v, self._accelerations_by_multipliers(self._mass(q, turning), d, gamma, f), own])
        root = self._inverse_mass_root(q, turning)
        free = root.T @ f
        scaled = d @ root
        missing = gamma - scaled @ free
        if self.rank == self.m:
            basis, r = np.linalg.qr(scaled.T)
            change = basis @ np.linalg.solve(r.T, missing)
        else:
            u, values, w = self._independent_rows(scaled)
            change = w.T @ ((u.T @ missing) / values)
        return np.concatenate([v, root @ (free + change), own])

    def slopes(self, t: float, y: Array) -> Array:
        """Return the Jacobian of the rates by central differences, a row and a column for each part of a state."""
        return difference_jacobian(self.rate, t, y)

    @property
    def row_names(self) -> tuple[str, ...]:
        """Names of the rows of joints, which precede rows of Euler parameters, as in results."""
        return tuple(f"{joint.name}.{row.label}" for joint in self.mechanism.joints for row in joint.rows)

    def multipliers(self, t: float, y: Array) -> Array:
        """Return the multipliers of ``M q'' + D^T l = f``, of minimum norm where rows are dependent."""
        n = self.n
        flat = self._numbers(t, y[:n], y[n:])
        _, d, _, _, f = self._split_numbers(flat)
        forces = f - self._mass(y[:n], self._rates_and_rotor_masses(flat)[1]) @ self.rate(t, y)[n : 2 * n]
        return np.asarray(np.linalg.lstsq(d.T, forces, rcond=CUTOFF)[0], dtype=np.float64)

    def undetermined_joints(self, y: Array) -> tuple[str, ...]:
        """Return the joints that take part in forces which move nothing: their reactions are not determined."""
        d = self.evaluate(0.0, y[: self.n], y[self.n :])[1]
        left, values, _ = np.linalg.svd(d, full_matrices=True)
        idle = left[:, int(np.sum(values > CUTOFF * values.max(initial=0.0))) :]
        joints = [joint.name for joint in self.mechanism.joints for _ in joint.rows]
        loose = {name for name, share in zip(joints, np.linalg.norm(idle, axis=1), strict=False) if share > SHARE}
        return tuple(joint.name for joint in self.mechanism.joints if joint.name in loose)

    def _independent_rows(self, d: Array) -> tuple[Array, Array, Array]:
        """Return the singular values of the independent rows of a matrix, with their vectors."""
        u, values, w = np.linalg.svd(d, full_matrices=False)
        rank = self.rank if self.rank is not None else int(np.sum(values > CUTOFF * values.max(initial=0.0)))
        return u[:, :rank], values[:rank], w[:rank]

    def _inverse_mass_root(self, q: Array, turning: Array) -> Array:
        """Return R with M^-1 = R R^T, the mass matrix of the rates completed along e; `turning`: masses of rotors."""
        if len(turning):
            lower = np.linalg.cholesky(self._mass(q, turning))
            return np.asarray(np.linalg.inv(lower).T)
        root = np.diag(self.root)
        if not self._first_e:
            return root
        for i, block in zip(self._first_e, np.linalg.inv(np.linalg.cholesky(self._inertia(q))), strict=True):
            root[i : i + 4, i : i + 4] = block.T
        return root

    def _accelerations_by_multipliers(self, mass: Array, d: Array, gamma: Array, f: Array) -> Array:
        """Return q'' of M q'' + D^T l = f and D q'' = gamma, D by its independent rows: M may have no inverse."""
        u, values, w = self._independent_rows(d)
        rows = self.usual * w
        system = np.block([[mass, rows.T], [rows, np.zeros((len(values), len(values)))]])
        right = self.usual * (u.T @ gamma) / values
        accelerations: Array = np.linalg.solve(system, np.concatenate([f, right]))[: self.n]
        return accelerations

    def _mass(self, q: Array, turning: Array) -> Array:
        """Return the mass matrix of the rates, completed along e, with the masses of rotors."""
        mass = np.diag(self.mass)
        for i, block in zip(self._first_e, self._inertia(q), strict=True):
            mass[i : i + 4, i : i + 4] = block
        mass[tuple(self._rotor_index)] += turning
        return mass

    def _inertia(self, q: Array) -> Array:
        """Return the mass matrices of the rates of Euler parameters, completed along e; shape (bodies, 4, 4)."""
        e = q[np.array(self._first_e, dtype=int)[:, None] + np.arange(4)]
        turning = np.array([_rate_matrix(row) for row in e]).reshape(-1, 3, 4)
        along = np.trace(self._tensors, axis1=1, axis2=2)[:, None, None] * e[:, :, None] * e[:, None, :]
        inertia: Array = 4.0 * np.swapaxes(turning, 1, 2) @ self._tensors @ turning + along
        return inertia

    # -- from formulas to numbers --------------------------------------------------------------------------------------

    def _parameter_symbols(self) -> dict[str, Any]:
        """Return the value of each parameter in the formulas."""
        return {name: sp.Float(x) for name, x in self.parameters.items()}

    def _compile(self, formulas: ReferenceFormulas, outputs: list[Any]) -> Callable[..., Any]:
        tables: dict[str, Callable[[float], float]] = {}
        for table in self.mechanism.tables:
            tables |= table_curves(table)
        inputs = [formulas.t, formulas.q, [*formulas.v, *formulas.z], formulas.turns]
        function = sp.lambdify(inputs, [*outputs, *formulas.angles], modules=[tables, "math"], cse=True)
        count = len(formulas.angles)
        if count == 0:
            return lambda t, q, v: function(t, q, v, [])
        asking = [
            (row, k, float(sp.diff(phi, turn)))
            for row, phi in enumerate(outputs[: self.m])
            for k, turn in enumerate(formulas.turns)
            if turn in phi.free_symbols
        ]
        before = [0.0] * count

        def begin_turns(t: float, q: list[float], v: list[float]) -> list[float]:
            """Return the whole turns of a start: those that rows require, one angle by each row, and none otherwise."""
            turns, used = [0.0] * count, set[int]()
            for row, k, factor in asking:
                if row not in used and turns[k] == 0.0:
                    turns[k] = -float(round(function(t, q, v, turns)[row] / factor))
                    used.add(row)
            return turns

        def evaluate_with_turns(t: float, q: list[float], v: list[float]) -> Any:
            """Evaluate with each angle on the branch nearest to its last value; a run begins at t = 0."""
            raw = function(t, q, v, [0.0] * count)[-count:]
            turns = [math.floor((last - angle) / math.tau + 0.5) for last, angle in zip(before, raw, strict=True)]
            if t == 0.0:
                turns = begin_turns(t, q, v)
            before[:] = [angle + math.tau * turn for angle, turn in zip(raw, turns, strict=True)]
            return function(t, q, v, turns)[:-count]

        return evaluate_with_turns


def _rate_matrix(e: Array) -> Array:
    """Return L(e), shape (3, 4), with omega = 2 L e' in body axes."""
    a, b, c, d = e
    return np.array([[-b, a, d, -c], [-c, -d, a, b], [-d, c, -b, a]])


def table_curves(table: Table) -> dict[str, Callable[[float], Any]]:
    """Return a table's function and its derivatives by the names that SymPy prints.

    They are plain Python, which Numba can compile.
    """
    x, y = np.asarray(table.x, dtype=float), np.asarray(table.y, dtype=float)
    functions = (
        _linear_curve(x, y)
        if table.interpolation == "linear"
        else _smooth_curve(x, y, table.interpolation, table.periodic)
    )
    return {f"{name}_{table.name}": function for name, function in functions.items()}


def _linear_curve(x: Any, y: Any) -> dict[str, Callable[[float], Any]]:
    def linear_value(at: float) -> Any:
        return np.interp(at, x, y)

    def linear_slope(at: float) -> Any:
        if at <= x[0] or at >= x[-1]:
            return 0.0
        i = np.searchsorted(x, at, side="right")
        return (y[i] - y[i - 1]) / (x[i] - x[i - 1])

    return {"table": linear_value, "slope": linear_slope}


def _smooth_curve(x: Any, y: Any, interpolation: str, periodic: bool) -> dict[str, Callable[[float], Any]]:
    from scipy.interpolate import CubicSpline, PchipInterpolator

    n, period = len(x), x[-1] - x[0] if periodic else np.inf
    spline: Any
    if interpolation == "cubic":
        spline = CubicSpline(x, y, bc_type="periodic" if periodic else "not-a-knot")
    elif periodic:  # the pieces in the middle of three periods
        ends = np.concatenate([x[:-1] - period, x, x[1:] + period])
        spline = PchipInterpolator(ends, np.concatenate([y[:-1], y, y[1:]]))
    else:
        spline = PchipInterpolator(x, y)
    slopes, c = spline(x, 1), np.ascontiguousarray(spline.c[:, n - 1 : 2 * n - 2] if len(spline.x) > n else spline.c)

    def smooth_value(at: float) -> Any:
        at = x[0] + (at - x[0]) % period if period < np.inf else at
        if at < x[0]:
            return y[0] + slopes[0] * (at - x[0])
        if at > x[-1]:
            return y[-1] + slopes[-1] * (at - x[-1])
        i = min(np.searchsorted(x, at, side="right") - 1, n - 2)
        u = at - x[i]
        return ((c[0, i] * u + c[1, i]) * u + c[2, i]) * u + c[3, i]

    def linear_slope(at: float) -> Any:
        at = x[0] + (at - x[0]) % period if period < np.inf else at
        if at < x[0] or at > x[-1]:
            return slopes[0] if at < x[0] else slopes[-1]
        i = min(np.searchsorted(x, at, side="right") - 1, n - 2)
        u = at - x[i]
        return (3.0 * c[0, i] * u + 2.0 * c[1, i]) * u + c[2, i]

    def second_derivative(at: float) -> Any:
        at = x[0] + (at - x[0]) % period if period < np.inf else at
        if at < x[0] or at > x[-1]:
            return 0.0
        i = min(np.searchsorted(x, at, side="right") - 1, n - 2)
        return 6.0 * c[0, i] * (at - x[i]) + 2.0 * c[1, i]

    return {"table": smooth_value, "slope": linear_slope, "second": second_derivative}

"""Digits of accelerations and multipliers, and evaluations behind `confirm`, over the whole catalogue.

    python -m benchmarks.digits [MODEL ...] [--states 1000]

The emitted right-hand side of `direct-correction` in doubles, as compiled, beside the same equations in extended
precision: M v' + D^T lambda = f, D v' = gamma from the emitted descriptor form, solved by a dense inverse whose errors
are refined away. First at random states that satisfy the constraints, then at every evaluation of a run with `rk4`.
Errors are relative to the largest acceleration of a state, with its joints or without them, or multiplier. Beside them
stands what a dense solution in doubles loses, and the largest ratio of an error to what the condition of a state
explains: rounding times the condition of the matrix (Skeel's), or the dense solution's error, as f and gamma lose
digits, too.
"""

from __future__ import annotations

import argparse
from collections.abc import Iterator
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray
from rich.table import Table

import symgen
from benchmarks.extended import as_plain
from benchmarks.show import show
from symgen import Settings
from symgen.base.ir.numerics import SKIP
from symgen.base.ir.program import COUNTERS
from symgen.describe.catalogue import all_names
from symgen.run.compiling.choices import mechanism_on_tree
from symgen.run.compiling.method_choice import choose_method
from symgen.run.compiling.pipeline import compile_model
from symgen.run.layout import abi
from symgen.run.layout.probe import Ready, rate_functions
from symgen.run.planning.prepare import prepare

Array = NDArray[Any]
EPSILON = float(np.finfo(float).eps)
#: Errors that are looked at.
SMALL = 1e-12
#: Disturbances of coordinates [m, rad], one after the other.
DISTURBANCES = 1.0, 0.25, 0.0625
#: A reference whose last refinement is larger says nothing: the matrix is singular to rounding.
REFINED = 1e-17
#: A run is compared at every evaluation up to this many, else at some, which are spread over it.
COMPARED = 2000
_REFINEMENTS = 12
_SUSPECTS, _FAILURES = COUNTERS.index("suspects"), COUNTERS.index("failures")


class Digits(NamedTuple):
    """Relative errors of accelerations and multipliers at a state.

    Attributes
    ----------
    law, dense, condition : Array
        Errors of the emitted law and of the dense solution in doubles; condition of the matrix.
    """

    law: Array
    dense: Array
    condition: Array

    @property
    def ratio(self) -> float:
        """Largest ratio of an error to what the condition explains."""
        return float(np.max(self.law / np.maximum(np.maximum(EPSILON * self.condition, self.dense), EPSILON)))


class Equations:
    """A mechanism's equations in extended precision, and its emitted right-hand side.

    Parameters
    ----------
    name : str
        An entry of the catalogue.
    coordinates : {"absolute", "joint"}
        Its coordinates.
    """

    def __init__(self, name: str, coordinates: str) -> None:
        mechanism = symgen.load(name).mechanism
        settings = Settings(method="direct-correction", integrator="rk4", coordinates=coordinates)
        run = prepare(mechanism, settings)
        self.compiled, self.start = run.compiled, run.start
        self.until, self.step = run.plan.spec.until, run.plan.spec.step or mechanism.defaults.step
        law, self.info = self.compiled.law_module, self.compiled.info
        self.rates, self.confirm = (Ready(function, abi.RHS) for function in rate_functions(law))
        self.accept = Ready(law.accept, abi.ACCEPT)
        described = mechanism_on_tree(mechanism) if coordinates == "joint" else mechanism
        self.form = form = compile_model(described, choose_method("lagrange", {}, True))
        self.residual, self.tangent = as_plain(form.law_module.residual), as_plain(form.law_module.tangent)
        self.p = form.parameter_array({x.name: run.start.p[i] for i, x in enumerate(self.info.parameters)}, {})
        self.long_p = [np.longdouble(x) for x in self.p]
        for module in (form.model, form.law_module):
            as_plain(module.prepare)(self.long_p)
        form.prepare(self.p)
        self.w = form.scratch()
        for section in ("mask", "winding", "modes"):
            if section in form.info.sections:
                form.section(self.w, section)[:] = self.compiled.section(run.start.w, section)

    def state(self, y: Array) -> tuple[Array, Array, Array]:
        """Return copies of a state, of the start's scratch array, and new counters."""
        return y.copy(), self.start.w.copy(), np.zeros(len(COUNTERS), dtype=np.int64)

    def law(self, t: float, y: Array, w: Array, iw: Array) -> tuple[Array, bool, Array]:
        """Return rates with multipliers behind them, whether they were confirmed, and the rows left out."""
        rate, suspects = np.zeros(self.info.ny), iw[_SUSPECTS]
        out = self.compiled.section(w, "mask") != 0.0
        confirmed = self.rates(t, y, self.start.p, w, iw, rate) != 0
        if confirmed:
            self.confirm(t, y, self.start.p, w, iw, rate)
            if iw[_SUSPECTS] > suspects:
                out = out | (self.compiled.section(w, "pivot") < SKIP)
        return np.concatenate([rate, self.compiled.section(w, "multipliers")]), confirmed, out

    def _rest(self, t: float, y: Array, unknowns: Array, out: Array, kind: Any) -> Array:
        """Return M v' + D^T lambda - f and D v' - gamma; multipliers of rows left `out` are 0."""
        info = self.info
        rest = [kind(0)] * (info.nq + info.nv + info.m + len(info.states) + 1)
        k = [kind(0)] * info.nq + [kind(x) for x in unknowns] + [kind(0)] * len(info.states)
        w = [kind(x) for x in self.w]
        self.residual(t, [kind(x) for x in y], k, self.p if kind is float else self.long_p, w, rest)
        found = np.array(rest[info.nq : info.nq + info.nv + info.m], dtype=kind)
        found[info.nv :] = np.where(out, unknowns[info.nv :], found[info.nv :])
        return found

    def _matrix(self, t: float, y: Array, out: Array) -> Array:
        nq, nv, n = self.info.nq, self.info.nv, self.info.nv + self.info.m
        numbers = [0.0] * len(self.form.law.tangent)
        self.tangent(t, y.tolist(), [0.0] * (nq + n + len(self.info.states)), self.p, self.w.tolist(), numbers)
        matrix = np.zeros((n, n))
        for x, (i, j) in zip(numbers, self.form.law.tangent, strict=True):
            if nq <= i < nq + n and nq <= j < nq + n:
                matrix[i - nq, j - nq] = x
        if self.form.law.level == "explicit":  # its rows of D are those of D^T
            matrix[nv:, :nv] = matrix[:nv, nv:].T
        for i in (nv + np.flatnonzero(out)).tolist():
            matrix[i], matrix[:, i] = 0.0, 0.0
            matrix[i, i] = 1.0
        return matrix

    def digits(self, t: float, y: Array, found: Array, out: Array) -> Digits | None:
        """Return the errors at a state of accelerations and multipliers `found`; None without a reference."""
        nv, matrix = self.info.nv, self._matrix(t, y, out)
        n = len(matrix)
        found = np.concatenate([found[self.info.nq : self.info.nq + nv], found[self.info.ny :]])
        try:
            inverse = np.linalg.inv(matrix)
        except np.linalg.LinAlgError:
            return None
        right = -self._rest(t, y, np.zeros(n), out, float)
        dense = np.linalg.solve(matrix, right)
        x = dense.astype(np.longdouble)
        for _ in range(_REFINEMENTS):
            change = inverse @ self._rest(t, y, x, out, np.longdouble).astype(float)
            x = x - change
            if np.abs(change).max() <= REFINED * np.abs(x).max():
                break
        else:
            return None
        size = np.abs(x.astype(float))
        terms = np.abs(inverse) @ (np.abs(matrix) @ size + np.abs(right))
        parts = [part for part in (slice(0, nv), slice(nv, n)) if part.stop > part.start]
        masses = matrix.diagonal()[:nv]
        alone = np.divide(np.abs(right[:nv]), masses, out=np.zeros(nv), where=masses > 0.0)
        scales = [float(max(size[part].max(), 0.0 if part.start else alone.max())) or 1.0 for part in parts]

        def largest(values: Array) -> Array:
            return np.array([float(values[part].max()) / scale for part, scale in zip(parts, scales, strict=True)])

        return Digits(largest(np.abs(found - x)), largest(np.abs(dense - x)), largest(terms))

    def random(self, count: int, seed: int = 1) -> Iterator[tuple[float, Array]]:
        """Yield times and random states that satisfy the constraints: disturbed and closed, velocities any."""
        info, rng = self.info, np.random.default_rng(seed)
        n, found = info.nq + info.nv, 0
        for k in range(20 * count):
            t = float(rng.uniform(0.0, 1.0))
            y, w, iw = self.state(self.start.y[: info.ny])
            y[: info.nq] += DISTURBANCES[k % 3] * rng.uniform(-1.0, 1.0, info.nq)
            y[info.nq : n] = rng.normal(size=info.nv)
            for i, _ in info.spins:
                y[i : i + 4] /= np.linalg.norm(y[i : i + 4])
            failed = self.accept(t, y, self.start.p, w, iw) & 1 or iw[_FAILURES]
            if not failed and np.isfinite(y).all():
                found += 1
                yield t, y
            if found == count:
                return

    def run(self) -> Iterator[tuple[float, Array, Array, bool, Array]]:
        """Yield time, state, and what `law` returns for every evaluation of a run with `rk4` and the entry's step."""
        (y, w, iw), h = self.state(self.start.y[: self.info.ny]), self.step
        for k in range(round(self.until / h)):
            rates = list[Array]()
            for part in (0.0, 0.5, 0.5, 1.0):
                t, stage = (k + part) * h, y + part * h * rates[-1] if rates else y.copy()
                found, confirmed, out = self.law(t, stage, w, iw)
                yield t, stage, found, confirmed, out
                rates.append(found[: self.info.ny])
            y = y + h / 6.0 * (rates[0] + 2.0 * rates[1] + 2.0 * rates[2] + rates[3])
            if not np.isfinite(y).all() or self.accept((k + 1) * h, y, self.start.p, w, iw) & 1:
                return


class Summary(NamedTuple):
    """Digits of many states, and the evaluations behind `confirm`."""

    digits: list[Digits]
    singular: int
    evaluations: int
    confirmed: int


def at_random(equations: Equations, count: int) -> Summary:
    """Return the digits at random states."""
    digits, singular, confirmed = list[Digits](), 0, 0
    for t, y in equations.random(count):
        _, w, iw = equations.state(y)
        found, behind, out = equations.law(t, y, w, iw)
        one = equations.digits(t, y, found, out)
        confirmed += behind
        if one is None:
            singular += 1
        else:
            digits.append(one)
    return Summary(digits, singular, len(digits) + singular, confirmed)


def along_run(equations: Equations, compared: int = COMPARED) -> Summary:
    """Return the digits along a run."""
    digits, singular, evaluations, confirmed = list[Digits](), 0, 0, 0
    spread = max(1, 4 * round(equations.until / equations.step) // compared)
    for t, y, found, behind, out in equations.run():
        evaluations, confirmed = evaluations + 1, confirmed + behind
        if evaluations % spread and not behind:
            continue
        one = equations.digits(t, y, found, out)
        if one is None:
            singular += 1
        else:
            digits.append(one)
    return Summary(digits, singular, evaluations, confirmed)


def cells(summary: Summary) -> list[str]:
    """Return the cells of a row behind the names."""
    digits = summary.digits
    if not digits:
        return ["0"]
    groups = range(len(digits[0].law))
    above = [one for one in digits if max(one.law) > SMALL]
    return [
        str(len(digits)),
        str(summary.singular),
        ", ".join(f"{max(one.law[g] for one in digits):.1e}" for g in groups),
        ", ".join(f"{max(one.dense[g] for one in digits):.1e}" for g in groups),
        f"{max(one.ratio for one in digits):.3g}",
        f"{len(above)}" + (f" ({max(one.ratio for one in above):.3g})" if above else ""),
        f"{summary.confirmed} of {summary.evaluations} ({100.0 * summary.confirmed / summary.evaluations:.2g} %)",
    ]


def main() -> None:
    """Print the tables."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("models", nargs="*", default=list(all_names()))
    parser.add_argument("--states", type=int, default=1000)
    options = parser.parse_args()
    heads = ("states", "singular", "error of v', lambda", "dense, doubles", "ratio", "> 1e-12 (ratio)", "confirmed")
    tables = [Table("", "coordinates", *heads, title=x) for x in ("Random states", "Along runs with `rk4`")]
    np.seterr(all="ignore")
    for name in options.models:
        for coordinates in ("absolute", "joint"):
            equations = Equations(name, coordinates)
            for table, summary in zip(
                tables, (at_random(equations, options.states), along_run(equations)), strict=True
            ):
                table.add_row(name, coordinates, *cells(summary))
    for table in tables:
        show(table)


if __name__ == "__main__":
    main()

"""Hard cases: redundant constraints, singular positions, light bodies and a massless one, by every method.

- A parallel four-bar with a second coupler: one of ten rows depends on the others, for ever. Error against its reduced
  equation, a pendulum's.
- The N-four-bar through its collinear positions, at many step sizes: which methods reach the end on the regular branch,
  and what those say that do not.
- The four-bar with a coupler whose mass is multiplied by 1e-3 to 1e-12: error against an integration on the null space
  of D, by independently derived equations.

    python -m benchmarks.robustness [redundant] [singular] [light]
"""

from __future__ import annotations

import sys
from collections import Counter
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray
from rich.table import Table
from scipy.integrate import solve_ivp

from benchmarks.motions import fine_integrator, motion, positions, run, second_order
from benchmarks.show import show
from symgen.api import Model, load
from symgen.base.errors import InputError
from symgen.derive.methods import METHODS
from symgen.describe import MechanismBuilder
from symgen.result.points import Points
from symgen.result.result import Result
from symgen.run.planning.automatic import constant_integrator

Array = NDArray[np.float64]

GRAVITY, LENGTH, BASE = 9.81, 1.0, 2.0
START = -np.pi / 3
#: A run whose error exceeds this [m] is on a wrong branch or has failed.
WRONG = 1e-2
FACTORS = (1.0, 1e-3, 1e-6, 1e-9, 1e-12)


# -- redundant ---------------------------------------------------------------------------------------------------------


def parallel_four_bar() -> Model:
    """Return two cranks of length 1 under pins 2 m apart, with couplers at their ends and at their middles."""
    c, s = LENGTH * np.cos(START), LENGTH * np.sin(START)
    builder = MechanismBuilder("parallel-four-bar", gravity=(0.0, -GRAVITY)).run(until=2.0, step=1e-3)
    for name, x in (("crank", 0.0), ("rocker", BASE)):
        builder.body(
            name,
            mass=1.0,
            inertia=LENGTH**2 / 12,
            points={"pin": (-LENGTH / 2, 0.0), "tip": (LENGTH / 2, 0.0)},
            position=(x + c / 2, s / 2),
            angle=START,
        )
        builder.joint(f"{name}_pin", "revolute", between=("ground", name), at=((x, 0.0), "pin"))
    for name, at, share, mass in (("coupler", "tip", 1.0, 2.0), ("second", "centre", 0.5, 1.5)):
        builder.body(
            name,
            mass=mass,
            inertia=mass * BASE**2 / 12,
            points={"left": (-BASE / 2, 0.0), "right": (BASE / 2, 0.0)},
            position=(BASE / 2 + share * c, share * s),
        )
        builder.joint(f"{name}_left", "revolute", between=("crank", name), at=(at, "left"))
        builder.joint(f"{name}_right", "revolute", between=("rocker", name), at=(at, "right"))
    return Model(builder.build())


def parallel_motion(times: Array) -> Array:
    """Return q of `parallel_four_bar` from its equation in one coordinate."""
    inertia = 2 * LENGTH**2 / 3 + 2.0 * LENGTH**2 + 1.5 * LENGTH**2 / 4
    moment = 2 * LENGTH / 2 + 2.0 * LENGTH + 1.5 * LENGTH / 2

    def rate(_: float, y: Array) -> list[float]:
        return [float(y[1]), -GRAVITY * moment / inertia * float(np.cos(y[0]))]

    solution = solve_ivp(rate, (0.0, times[-1]), [START, 0.0], "DOP853", times, rtol=3e-14, atol=1e-14, max_step=0.01)
    theta = np.asarray(solution.y[0])
    c, s, zero = LENGTH * np.cos(theta), LENGTH * np.sin(theta), np.zeros(len(times))
    columns = [c / 2, s / 2, theta, BASE + c / 2, s / 2, theta]
    columns += [BASE / 2 + c, s, zero, BASE / 2 + c / 2, s / 2, zero]
    return np.column_stack(columns)


# -- one row of a table ------------------------------------------------------------------------------------------------


@dataclass(frozen=True)
class Row:
    """What a method made of a case; `error` is infinite where there was no run."""

    method: str
    status: str
    error: float
    result: Result | None
    reason: str


def attempt(model: Model, method: str, step: float, exact: Array, times: Array, **keys: dict[str, float]) -> Row:
    """Run a method with its finest integrator and compare with the exact motion."""
    try:
        q, result = motion(model, method, step / 4 if second_order(method) else step, times, keys.get("parameters"))
    except InputError as refusal:
        return Row(method, "refused", np.inf, None, str(refusal))
    points = Points.of_mechanism(model.mechanism, model.parameters(keys.get("parameters")))
    k = len(q)
    error = points.largest_distance(q, exact[:k]) if k and np.all(np.isfinite(q)) else np.inf
    return Row(method, result.status, error, result, result.reason or "; ".join(result.warnings))


def redundant(methods: tuple[str, ...] = ()) -> list[Row]:
    """Return a row for every method on the parallel four-bar."""
    model, times = parallel_four_bar(), np.linspace(0.0, 2.0, 21)
    exact = parallel_motion(times)
    return [attempt(model, m, 1e-3, exact, times) for m in methods or METHODS.names]


def light(factor: float, methods: tuple[str, ...] = ()) -> list[Row]:
    """Return a row for every method on the four-bar whose coupler weighs `factor` times as much."""
    model, times = load("four-bar"), np.linspace(0.0, 2.0, 21)
    changed = {"coupler_mass": 8.0 * factor}
    exact = null_space_motion(factor, times)
    return [attempt(model, m, 1e-3, exact, times, parameters=changed) for m in methods or METHODS.names]


def null_space_motion(factor: float, times: Array) -> Array:
    """Return q of the four-bar with a light coupler, by R^T M R z' = R^T (f - M b) on the null space of D.

    M is never inverted, so light bodies do no harm; R is one column here, b the least-squares solution of D b = gamma.
    """
    from symgen.study.references.independent import IndependentEquations

    model = load("four-bar")
    values = model.parameters({"coupler_mass": 8.0 * factor})
    equations = IndependentEquations(model.mechanism, values)
    mass, n = equations.mass, equations.n

    def rate(t: float, y: Array) -> Array:
        _, d, _, gamma, f = equations.evaluate(t, y[:n], y[n:])
        right = np.linalg.svd(d)[2][-1]
        particular = np.linalg.lstsq(d, gamma, rcond=None)[0]
        z = right @ (f - mass * particular) / (right @ (mass * right))
        return np.concatenate([y[n:], particular + z * right])

    q, _ = model.initial_state(values)
    y = equations.nearest_state(0.0, np.concatenate([q, np.zeros(n)]), mass_weighted=False)
    states = [y[:n]]
    for a, b in pairwise(times):
        y = solve_ivp(rate, (a, b), y, "DOP853", rtol=3e-13, atol=1e-13).y[:, -1]
        y = equations.nearest_state(float(b), y, mass_weighted=False)
        states.append(y[:n])
    return np.array(states)


# -- singular ----------------------------------------------------------------------------------------------------------


@dataclass(frozen=True)
class Passages:
    """Runs of one method through the singular positions, one for each step size."""

    method: str
    windows: int
    errors: tuple[float, ...]
    statuses: tuple[str, ...]
    warned: tuple[bool, ...]

    @property
    def silently_wrong(self) -> int:
        """Count of runs on a wrong branch that ended `ok`."""
        return sum(e > WRONG and s == "ok" for e, s in zip(self.errors, self.statuses, strict=True))


def passages(method: str, windows: int, steps: Array, until: float = 10.0) -> Passages:
    """Run the N-four-bar with a method at several steps with `rk4`, or with its own integrator."""
    from symgen.study.references.closed_forms import n_four_bar

    model, times = load(f"n-four-bar:{windows}"), np.linspace(0.0, until, 101)
    exact = n_four_bar(model.mechanism, model.parameters(), np.zeros(0), times)[2]
    points = Points.of_mechanism(model.mechanism, model.parameters())
    integrator = constant_integrator(method)
    errors, statuses, warned = [], [], []
    for step in steps:
        result = run(model, method, integrator, float(step), times)
        q = positions(result)
        errors.append(points.largest_distance(q, exact[: len(q)]) if np.all(np.isfinite(q)) else np.inf)
        statuses.append(result.status)
        warned.append(bool(result.warnings))
    return Passages(method, windows, tuple(errors), tuple(statuses), tuple(warned))


# -- tables ------------------------------------------------------------------------------------------------------------


def rows_table(title: str, rows: list[Row]) -> Table:
    """Return rows as a table."""
    table = Table(title=title)
    for heading in ("method", "integrator", "status", "error [m]", "rank", "events", "said"):
        table.add_column(heading, justify="right" if heading == "error [m]" else "left")
    for r in rows:
        rank = "" if r.result is None else f"{r.result.rank.rank} of {r.result.rank.rows}"
        events = "" if r.result is None else str(r.result.rank_event_count)
        table.add_row(r.method, fine_integrator(r.method), r.status, f"{r.error:.1e}", rank, events, r.reason[:70])
    return table


def singular_table(windows: tuple[int, ...] = (1, 2), count: int = 10) -> Table:
    """Return the passages of every method as a table."""
    table = Table(title=f"N-four-bar, 10 s, {count} steps in [0.95, 1.05]e-3 s, rk4 or the method's own integrator")
    for heading in ("N", "method", "median [m]", "worst [m]", f"> {WRONG:g} m", "statuses", "wrong but ok"):
        table.add_column(heading)
    for n in windows:
        for method in METHODS.names:
            p = passages(method, n, np.linspace(0.95e-3, 1.05e-3, count))
            statuses = ", ".join(f"{k} {s}" for s, k in sorted(Counter(p.statuses).items()))
            wrong = str(sum(e > WRONG for e in p.errors))
            numbers = f"{np.median(p.errors):.1e}", f"{max(p.errors):.1e}"
            table.add_row(str(n), method, *numbers, wrong, statuses, str(p.silently_wrong))
    table.caption = "errors of failed runs are those up to where they stopped"
    return table


def main(arguments: list[str]) -> int:
    """Print the tables asked for, all of them unless told."""
    wanted = arguments or ["redundant", "singular", "light"]
    if "redundant" in wanted:
        show(rows_table("parallel four-bar with a second coupler, 2 s, against its reduced equation", redundant()))
    if "light" in wanted:
        for factor in FACTORS:
            show(rows_table(f"four-bar, coupler mass x {factor:g}, 2 s, against the null space", light(factor)))
    if "singular" in wanted:
        show(singular_table())
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))

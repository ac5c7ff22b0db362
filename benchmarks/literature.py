"""Claims of the literature on constraint stabilisation, measured: one table each.

    python -m benchmarks.literature [gains] [law] [adaptive] [energy] [violation] [projection] [classes] [closing]

`gains`: errors of `baumgarte` with gains from the step, alpha = beta = g / h, against g, by schemes of order 1 to 8;
`law`: rates of motions, and the gain of least violation in units of them, with the slopes on both sides;
`adaptive`: errors of `adaptive-baumgarte` against its largest gain; `energy`: errors with and without scaling
velocities to the energy, on one and on three degrees of freedom; `violation`: violations beside errors of the motion;
`projection`: the energy that velocity projections take beside the energy error of the integrator; `classes`: run times
of methods that are the same in exact arithmetic, in turns; `closing`: violations, energy and run times of formulations
at one step, in turns.
"""

from __future__ import annotations

import statistics
import sys
from collections.abc import Iterator, Mapping
from functools import cache, partial

import numpy as np
from numpy.typing import NDArray

from benchmarks.coordinates import span
from benchmarks.page_tables import KEPT, ROUNDING, PageTable, list_of, number, print_tables, step_size
from symgen.api import Model, load
from symgen.base.ir.program import COUNTERS, STATUS
from symgen.base.settings import Settings
from symgen.describe import MechanismBuilder
from symgen.result.result import FAILED, Result
from symgen.run.integrators import INTEGRATORS
from symgen.run.planning.prepare import first_rate
from symgen.study.stress.findings import fitted_slope

Array = NDArray[np.float64]
Options = Mapping[str, str | float]

#: Runs are measured, not judged.
UNWATCHED = {"max_violation": 1e3, "max_energy_error": 1e3}
SCHEMES = {"euler": 1e-4, "heun": 1e-3, "rk4": 2e-3, "dopri5": 8e-3, "dop853": 3.125e-2}
MASS: Options = {"method.weight": "mass"}
PAGES = "docs/tables/"
#: An order is shown where the smallest error is above this: below, errors are those of the reference and of rounding.
RESOLVED = 5e-12
#: Methods that solve one and the same equations: name of the class at its first line, label, method, options.
CLASSES: tuple[tuple[str, str, str, Options], ...] = (
    ("law of `lagrange`", "`lagrange`, elimination", "lagrange", {}),
    ("", "`udwadia-kalaba`", "udwadia-kalaba", {}),
    ("", "`lagrange`, `solver=augmented`", "lagrange", {"method.solver": "augmented"}),
    ("", "`lagrange`, `solver=dense`", "lagrange", {"method.solver": "dense"}),
    ("penalty", "`penalty`", "penalty", {}),
    ("", "`compliant-constraints`", "compliant-constraints", {}),
    *(
        ("stabilised multipliers", "`baumgarte`, gains 10", "baumgarte", {"method.alpha": 10.0, "method.beta": 10.0}),
        ("", "`augmented-lagrangian`", "augmented-lagrangian", {}),
        ("mass-orthogonal", "`direct-correction`, mass", "direct-correction", MASS),
    ),
    ("", "`mass-orthogonal-projection`", "mass-orthogonal-projection", {}),
    ("stabilised invariants", "`invariant-stabilization`", "invariant-stabilization", {}),
    ("", "`braun-goldfarb`", "braun-goldfarb", {}),
)
#: Mechanisms whose gain of least violation is looked for.
LAW = ("four-bar", "slider-crank", "andrews", "bricard", "spatial-slider-crank")
#: Methods by integrator, beside one another at one step.
CLOSING = {
    "rk4": (
        *("lagrange", "udwadia-kalaba", "baumgarte", "velocity-projection", "direct-correction"),
        *("mass-orthogonal-projection", "post-stabilization", "augmented-hamiltonian", "null-space"),
        *("augmented-lagrangian", "index1-augmented-lagrangian", "coordinate-partitioning"),
    ),
    "trapezoidal": ("index3-augmented-lagrangian",),
    "generalized-alpha": ("generalized-alpha",),
    "radau5": ("ggl",),
}


def opened_four_bar() -> Model:
    """Return the four-bar of the catalogue without its last pin: three degrees of freedom."""
    raw = MechanismBuilder("open-four-bar", gravity=(0.0, -9.81))
    places = {
        "crank": (2.0, (0.5, 0.8660254037844386), 1.0471975511965976),
        "coupler": (8.0, (4.706229663272004, 3.236664273905892), 0.38564124740737094),
        "rocker": (5.0, (9.206229663272005, 2.3706388701214536), 1.8938968124057762),
    }
    for name, (length, position, angle) in places.items():
        points = {"A": (-length / 2, 0.0), "B": (length / 2, 0.0)}
        raw.body(name, mass=length, inertia=length**3 / 12, position=position, angle=angle, points=points)
    raw.joint("A", "revolute", between=("ground", "crank"), at=((0.0, 0.0), "A"))
    raw.joint("B", "revolute", between=("crank", "coupler"), at=("B", "A"))
    raw.joint("C", "revolute", between=("coupler", "rocker"), at=("B", "B"))
    return Model(raw.build())


def run(
    model: Model, method: str, step: float, until: float, options: Options, integrator: str = "rk4", repeat: int = 1
) -> Result:
    """Return a run with constant steps."""
    constant: Options = {"integrator.adaptive": "false"} if INTEGRATORS.get(integrator).adaptive else {}
    times = np.linspace(0.0, until, 9).tolist()
    return model.simulate(
        method=method,
        integrator=integrator,
        step=step,
        until=until,
        times=times,
        repeat=repeat,
        options={**options, **constant},
        **UNWATCHED,  # type: ignore[arg-type]  # numbers
    )


@cache
def exact(name: str, until: float) -> Array:
    """Return q of a fine run."""
    times = np.linspace(0.0, until, 9).tolist()
    model = opened_four_bar() if name == "open" else load(name)
    return np.asarray(model.simulate(integrator="dop853", rtol=1e-12, atol=1e-13, until=until, times=times).q)


def error(result: Result, name: str, until: float) -> float:
    """Return the largest error of q; infinite where the run broke off."""
    q = np.asarray(result.q)
    return float(np.abs(q - exact(name, until)).max()) if len(q) == 9 else np.inf


def gains() -> PageTable:
    """Return errors and orders of `baumgarte` with alpha = beta = g / h."""
    values = (0.0, 1e-3, 1e-2, 1e-1, 0.5, 1.0)

    def cells(name: str, first: float) -> Iterator[str]:
        for g in values:
            errors = []
            for step in (first, first / 2, first / 4):
                options = {"method.alpha": g / step, "method.beta": g / step} if g else {}
                one = run(load("four-bar"), "baumgarte" if g else "lagrange", step, 2.0, options, name)
                errors.append(error(one, "four-bar", 2.0))
            order = f"{np.log2(errors[1] / errors[2]):.1f}" if errors[2] > RESOLVED else "rounding"
            yield f"{number(errors[0])} ({order})"

    rows = [
        ((f"`{name}`", str(INTEGRATORS.get(name).order), step_size(first)), partial(list_of, cells, name, first))
        for name, first in SCHEMES.items()
    ]
    headings = ("scheme", "order", "h [s]", "none", *(f"g = {g:g}" for g in values[1:]))
    return PageTable("literature gains", PAGES + "gains.md", headings, tuple(rows))


def law() -> PageTable:
    """Return rates of motions, and gains of least violation over these rates with the slopes below and above."""

    def cells(name: str) -> Iterator[str]:
        model, points = load(name), list[tuple[float, float]]()
        step, end = 2.0 * model.mechanism.defaults.step, span(model)
        rate = first_rate(model.mechanism, Settings(until=end))[0] or 0.0
        for gain in np.geomspace(0.01, 31.6, 15).tolist():
            one = run(model, "baumgarte", step, end, {"method.alpha": gain * rate, "method.beta": gain * rate})
            if one.status != FAILED:
                points.append((gain, one.position_violation_max))
        gain, least = min(points, key=lambda point: point[1])
        below, above = ([(x, y) for x, y in points if side * x >= side * gain * 2.0**side] for side in (-1.0, 1.0))
        yield from (f"{rate:.0f}" if rate > 100.0 else f"{rate:.2g}", f"{gain:.2g}", number(least))
        yield from ("" if (own := fitted_slope(part)) is None else f"{own:.1f}" for part in (below, above))

    rows = tuple(((f"`{name}`",), partial(list_of, cells, name)) for name in LAW)
    headings = ("mechanism", "rate r [1/s]", "best gain / r", r"\|Phi\| there [m]", "slope below", "above")
    return PageTable("literature law", PAGES + "gains.md", headings, rows)


def adaptive() -> PageTable:
    """Return errors of `adaptive-baumgarte` by its largest gain, and of what it is compared with."""

    def cells(method: str, options: Options) -> Iterator[str]:
        runs = [run(load("four-bar"), method, step, 2.0, options) for step in (8e-3, 4e-3, 2e-3)]
        yield from (number(error(one, "four-bar", 2.0)) for one in runs)
        yield number(runs[0].velocity_violation_max)

    kinds: list[tuple[str, str, Options]] = [("none (`lagrange`)", "lagrange", {})]
    for g in (1, 2, 5, 10, 20, 50):
        kinds.append((f"`gain` = {g:g}", "adaptive-baumgarte", {"method.gain": g}))
    kinds.append(("`a` / h", "adaptive-baumgarte", {"method.gain": 1e9}))
    kinds += [(f"`{rule}`", "adaptive-baumgarte", {"method.rule": rule}) for rule in ("taylor", "pole-placed")]
    rows = tuple(((label,), partial(list_of, cells, method, options)) for label, method, options in kinds)
    headings = ("gains", "8 ms", "4 ms", "2 ms", r"largest \|D v - nu\| at 8 ms [m/s]")
    return PageTable("literature adaptive", "docs/tables/adaptive-gains.md", headings, rows)


def energy() -> PageTable:
    """Return errors with and without scaling to the energy."""

    def cells(name: str, until: float) -> Iterator[str]:
        model = opened_four_bar() if name == "open" else load(name)
        kinds: tuple[tuple[str, Options], ...] = (("direct-correction", MASS), ("energy-projection", {}))
        both = [run(model, method, 1e-2, until, options) for method, options in kinds]
        errors = [error(one, name, until) for one in both]
        for e, one in zip(errors, both, strict=True):
            yield from (number(e), number(one.energy_drift_max))
        yield f"{errors[0] / errors[1]:.2g}"

    cases = [("four-bar", "closed, 1 degree", until) for until in (2.0, 10.0, 40.0)]
    cases += [("open", "open, 3 degrees", until) for until in (2.0, 5.0)]
    rows = tuple(((label, f"{until:g}"), partial(list_of, cells, name, until)) for name, label, until in cases)
    errors = ("`direct-correction`, mass", "its energy error [J]", "`energy-projection`", "its energy error [J]")
    return PageTable("literature energy", PAGES + "energy.md", ("mechanism", "end [s]", *errors, "gain"), rows)


def violation() -> PageTable:
    """Return violations and errors of corrections."""

    def cells(method: str, options: Options) -> Iterator[str]:
        one = run(load("four-bar"), method, 2e-3, 40.0, options)
        numbers = (one.position_violation_max, one.velocity_violation_max, error(one, "four-bar", 40.0))
        yield from map(number, numbers)

    kinds: tuple[tuple[str, Options], ...] = (
        *(("lagrange", {}), ("baumgarte", {}), ("velocity-projection", {}), ("velocity-projection", MASS)),
        *(("dependent-correction", {}), ("direct-correction", {}), ("direct-correction", MASS)),
        *(("direct-correction", {"method.when": "stage"}), ("post-stabilization", {})),
        *(("coordinate-partitioning", {}), ("braun-goldfarb", {})),
    )
    labels = {"": "", "mass": ", mass", "stage": ", `when=stage`"}
    rows = tuple(
        ((f"`{method}`{labels[''.join(map(str, options.values()))]}",), partial(list_of, cells, method, options))
        for method, options in kinds
    )
    headings = ("method", r"\|Phi\| [m]", r"\|D v - nu\| [m/s]", "error [m, rad]")
    return PageTable("literature violation", PAGES + "violations.md", headings, rows)


def energy_taken(step: float, until: float, order: int) -> tuple[float, float]:
    """Return the energy that velocity projections in the metric of M take, in all, and the energy error at the end [J].

    Steps of the classical scheme, or of Heun's, are made here, so that T is seen before and after each projection.
    """
    model = load("four-bar")
    compiled = model.compile("velocity-projection", {"weight": "mass"})
    start, law = model.assemble(compiled), compiled.law_module
    info, y, w, rate = compiled.info, start.y.copy(), start.w, np.zeros_like(start.y)
    compiled.model.masses(start.p, w)
    masses, counters = compiled.section(w, "mass").copy(), np.zeros(len(COUNTERS), dtype=np.int64)
    speeds = slice(info.nq, info.nq + info.nv)
    law.accept(0.0, y, start.p, w, counters)
    first, taken = w[STATUS.index("kinetic")] + w[STATUS.index("potential")], 0.0
    stages = ((0.0, 1 / 6), (0.5, 1 / 3), (0.5, 1 / 3), (1.0, 1 / 6)) if order == 4 else ((0.0, 0.5), (1.0, 0.5))
    for k in range(round(until / step)):
        change, last = np.zeros_like(y), np.zeros_like(y)
        for node, weight in stages:
            law.rhs((k + node) * step, y + node * step * last, start.p, w, counters, rate)
            last = rate.copy()
            change += weight * last
        y += step * change
        before = 0.5 * float(masses @ y[speeds] ** 2)
        law.accept((k + 1) * step, y, start.p, w, counters)
        taken += before - 0.5 * float(masses @ y[speeds] ** 2)
    return taken, float(w[STATUS.index("kinetic")] + w[STATUS.index("potential")] - first)


def projection() -> PageTable:
    """Return the energy that velocity projections take, beside the energy error of the run."""

    def cells(order: int, step: float) -> Iterator[str]:
        taken, lost = energy_taken(step, 10.0, order)
        yield from (number(abs(taken)), number(lost))
        yield "rounding" if abs(taken) < ROUNDING else number(taken / abs(lost))

    cases = ((4, 1e-2), (4, 5e-3), (2, 5e-3), (2, 2e-3))
    rows = tuple(((str(order), step_size(step)), partial(list_of, cells, order, step)) for order, step in cases)
    headings = ("order", "step [s]", "taken by all projections [J]", "energy error at the end [J]", "share")
    return PageTable("literature projection", PAGES + "energy.md", headings, rows)


def classes(times: bool = False, turns: int = 9) -> PageTable:
    """Return run times and errors by class of methods that are one in exact arithmetic, times in turns."""

    def cells(method: str, options: Options) -> Iterator[str]:
        model = load("four-bar")
        one = run(model, method, 1e-3, 10.0, options)
        yield relative_time(model, method, options, turns if times else 0)
        yield number(error(one, "four-bar", 10.0))

    rows = tuple(((label, name), partial(list_of, cells, method, options)) for label, name, method, options in CLASSES)
    return PageTable(
        "literature classes",
        PAGES + "closed-joints.md",
        ("class", "method", "time", "error [m, rad]"),
        rows,
        (2,),
        integrators=("rk4",),
    )


def closing(times: bool = False, turns: int = 9) -> PageTable:
    """Return violations, energy errors and run times of formulations at one step, times in turns."""

    def cells(method: str, integrator: str) -> Iterator[str]:
        model = load("four-bar")
        one = run(model, method, 1e-3, 10.0, {}, integrator)
        yield from map(number, (one.position_violation_max, one.velocity_violation_max, one.energy_drift_max))
        yield relative_time(model, method, {}, turns if times else 0, integrator)

    rows = tuple(
        ((f"`{method}`",), partial(list_of, cells, method, integrator))
        for integrator, methods in CLOSING.items()
        for method in methods
    )
    headings = ("method", r"\|Phi\| [m]", r"\|D v - nu\| [m/s]", "energy [J]", "time")
    page = PAGES + "closed-joints.md"
    return PageTable("literature closing", page, headings, rows, (4,), integrators=tuple(CLOSING))


def relative_time(model: Model, method: str, options: Options, turns: int, integrator: str = "rk4") -> str:
    """Return the processor time of a run over that of `lagrange`, median of some turns."""
    ratios = []
    for _ in range(turns):
        base, own = (
            run(model, name, 1e-3, 10.0, chosen, scheme, repeat=3).outcome.cpu_seconds
            for name, chosen, scheme in (("lagrange", {}, "rk4"), (method, options, integrator))
        )
        ratios.append(own / base)
    return f"{statistics.median(ratios):.2f}" if ratios else KEPT


def tables(times: bool = False) -> dict[str, PageTable]:
    """Return all tables by name; run times are measured only if asked for."""
    measured = (gains(), law(), adaptive(), energy(), violation(), projection(), classes(times), closing(times))
    return {table.command.split()[-1]: table for table in measured}


if __name__ == "__main__":
    sys.exit(print_tables(tables(times=True), sys.argv[1:]))

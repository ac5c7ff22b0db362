"""What the literature on constraint stabilisation says, measured: each table one claim.

    python -m benchmarks.literature [gains] [adaptive] [energy] [violation] [projection] [classes]

`gains`: errors of `baumgarte` with gains from the step, alpha = beta = g / h, against g, by schemes of order 1 to 8;
`adaptive`: errors of `adaptive-baumgarte` against its largest gain; `energy`: what scaling velocities to the energy
gains on one and on three degrees of freedom; `violation`: violations beside errors of the motion; `projection`: what a
velocity projection takes of the energy beside what the integrator loses; `classes`: run times of methods that are the
same in exact arithmetic, in turns.
"""

from __future__ import annotations

import statistics
import sys
from collections.abc import Callable, Mapping, Sequence
from functools import cache

import numpy as np
from numpy.typing import NDArray
from rich.markup import escape
from rich.table import Table

from benchmarks.show import show
from symgen.api import Model, load
from symgen.describe import MechanismBuilder
from symgen.integrators import INTEGRATORS
from symgen.ir.program import COUNTERS, STATUS
from symgen.result.result import Result

Array = NDArray[np.float64]
Options = Mapping[str, str | float]

#: Runs are measured, not judged.
UNWATCHED = {"max_violation": 1e3, "max_energy_error": 1e3}
SCHEMES = {"euler": 1e-4, "heun": 1e-3, "rk4": 2e-3, "dopri5": 8e-3, "dop853": 3.125e-2}
MASS: Options = {"method.weight": "mass"}
#: Methods that solve one and the same equations: name of the class, method, options.
CLASSES: tuple[tuple[str, str, Options], ...] = (
    *(("law of lagrange", "lagrange", {"method.solver": s}) for s in ("elimination", "augmented", "dense")),
    ("law of lagrange", "udwadia-kalaba", {}),
    ("penalty", "penalty", {}),
    ("penalty", "compliant-constraints", {}),
    ("stabilised multipliers", "baumgarte", {"method.alpha": 10.0, "method.beta": 10.0}),
    ("stabilised multipliers", "augmented-lagrangian", {}),
    ("mass-orthogonal", "direct-correction", MASS),
    ("mass-orthogonal", "mass-orthogonal-projection", {}),
    ("stabilised invariants", "invariant-stabilization", {}),
    ("stabilised invariants", "braun-goldfarb", {}),
)


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
    found = model.simulate(integrator="dop853", rtol=1e-12, atol=1e-13, until=until, times=times)
    return np.asarray(found.q)


def error(found: Result, name: str, until: float) -> float:
    """Return the largest error of q; infinite where the run broke off."""
    q = np.asarray(found.q)
    return float(np.abs(q - exact(name, until)).max()) if len(q) == 9 else np.inf


def table(title: str, headings: Sequence[str], words: int = 1) -> Table:
    """Return an empty table whose first columns hold words."""
    result = Table(title=escape(title))
    for i, heading in enumerate(headings):
        result.add_column(escape(heading), justify="left" if i < words else "right")
    return result


def gains() -> Table:
    """Return errors and orders of `baumgarte` with alpha = beta = g / h."""
    values = (0.0, 1e-3, 1e-2, 1e-1, 0.5, 1.0)
    title = "four-bar, 2 s: error [m, rad] at the longest of three steps, and order between the others"
    result = table(title, ("scheme", "order", "step [s]", "none", *(f"g = {g:g}" for g in values[1:])))
    for name, first in SCHEMES.items():
        cells = []
        for g in values:
            errors = []
            for step in (first, first / 2, first / 4):
                options = {"method.alpha": g / step, "method.beta": g / step} if g else {}
                found = run(load("four-bar"), "baumgarte" if g else "lagrange", step, 2.0, options, name)
                errors.append(error(found, "four-bar", 2.0))
            cells.append(f"{errors[0]:.1e} ({np.log2(errors[1] / errors[2]):.1f})")
        result.add_row(name, str(INTEGRATORS.get(name).order), f"{first:g}", *cells)
    return result


def adaptive() -> Table:
    """Return errors of `adaptive-baumgarte` by its largest gain, and of what it is compared with."""
    result = table(
        "four-bar, rk4, 2 s: error [m, rad]; largest |D v - nu| [m/s] at 8 ms",
        ("method", "8 ms", "4 ms", "2 ms", "|D v - nu|"),
    )
    rows: list[tuple[str, str, Options]] = [("lagrange", "lagrange", {})]
    rows += [(f"gain {g:g}", "adaptive-baumgarte", {"method.gain": g}) for g in (1, 2, 5, 10, 20, 50, 1e9)]
    rows += [(rule, "adaptive-baumgarte", {"method.rule": rule}) for rule in ("taylor", "pole-placed")]
    for label, method, options in rows:
        found = [run(load("four-bar"), method, step, 2.0, options) for step in (8e-3, 4e-3, 2e-3)]
        cells = [f"{error(f, 'four-bar', 2.0):.1e}" for f in found]
        result.add_row(label, *cells, f"{found[0].velocity_violation_max:.1e}")
    return result


def energy() -> Table:
    """Return errors with and without scaling to the energy."""
    result = table(
        "rk4 at 10 ms: error [m, rad], largest energy error [J]",
        ("mechanism", "end [s]", "projected", "energy [J]", "scaled", "energy [J]", "gain"),
    )
    for name, label in (("four-bar", "closed, 1 degree"), ("open", "open, 3 degrees")):
        model = opened_four_bar() if name == "open" else load(name)
        for until in (2.0, 10.0, 40.0) if name == "four-bar" else (2.0, 5.0):
            both = [
                run(model, method, 1e-2, until, options)
                for method, options in (("direct-correction", MASS), ("energy-projection", {}))
            ]
            errors = [error(found, name, until) for found in both]
            cells = [f"{x:.1e}" for e, f in zip(errors, both, strict=True) for x in (e, f.energy_drift_max)]
            result.add_row(label, f"{until:g}", *cells, f"{errors[0] / errors[1]:.1f}")
    return result


def violation() -> Table:
    """Return violations and errors of corrections."""
    result = table(
        "four-bar, rk4 at 2 ms, 40 s: largest violations beside the error of the motion",
        ("method", "|Phi| [m]", "|D v - nu| [m/s]", "error [m, rad]"),
    )
    rows: tuple[tuple[str, Options], ...] = (
        *(("lagrange", {}), ("baumgarte", {}), ("velocity-projection", {}), ("velocity-projection", MASS)),
        *(("post-stabilization", {}), ("direct-correction", {}), ("direct-correction", MASS)),
        *(("dependent-correction", {}), ("coordinate-partitioning", {}), ("braun-goldfarb", {})),
    )
    for method, options in rows:
        found = run(load("four-bar"), method, 2e-3, 40.0, options)
        numbers = (found.position_violation_max, found.velocity_violation_max, error(found, "four-bar", 40.0))
        result.add_row(method + (", mass" if options else ""), *(f"{x:.1e}" for x in numbers))
    return result


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


def projection() -> Table:
    """Return what velocity projections take of the energy, beside the energy error of the run."""
    result = table(
        "four-bar, 10 s: energy that projections take in all, and energy error at the end [J]",
        ("order", "step [s]", "taken", "energy error", "share"),
    )
    for order, step in ((4, 1e-2), (4, 5e-3), (4, 2e-3), (2, 5e-3), (2, 2e-3)):
        taken, lost = energy_taken(step, 10.0, order)
        result.add_row(str(order), f"{step:g}", *(f"{x:.1e}" for x in (taken, lost, taken / abs(lost))))
    return result


def classes(turns: int = 9) -> Table:
    """Return run times and errors by class of methods that are one in exact arithmetic, times in turns."""
    title = "four-bar, rk4 at 1 ms, 10 s: run time over that of lagrange beside it, median (smallest to largest)"
    result = table(title, ("class", "method", "time", "error [m, rad]"), 2)
    model = load("four-bar")
    for label, method, options in CLASSES:
        ratios, found = list[float](), run(model, method, 1e-3, 10.0, options)
        for _ in range(turns):
            base = run(model, "lagrange", 1e-3, 10.0, {}, repeat=9).seconds.run
            ratios.append(run(model, method, 1e-3, 10.0, options, repeat=9).seconds.run / base)
        time = f"{statistics.median(ratios):.2f} ({min(ratios):.2f} to {max(ratios):.2f})"
        words = " ".join(str(x) for x in options.values() if isinstance(x, str))
        result.add_row(label, f"{method} {words}".strip(), time, f"{error(found, 'four-bar', 10.0):.1e}")
    return result


TABLES: dict[str, Callable[[], Table]] = {
    **{"gains": gains, "adaptive": adaptive, "energy": energy},
    **{"violation": violation, "projection": projection, "classes": classes},
}


def main(arguments: list[str]) -> int:
    """Print the tables asked for, or all."""
    for name in arguments or TABLES:
        show(TABLES[name]())
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))

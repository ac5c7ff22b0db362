"""Long runs: how the energy error and the violation of the constraints grow between a tenth of a run and its end.

python -m benchmarks.long
"""

from __future__ import annotations

import sys
from collections.abc import Iterator, Mapping
from functools import partial

import numpy as np

from benchmarks.page_tables import ROUNDING, PageTable, Row, list_of, number, print_tables
from symgen.api import load

#: Mechanism, end [s] and constant step [s]: some 500 swings, and some 100 turns.
MOTIONS = (("pendulum", 1000.0, 5e-3), ("four-bar", 400.0, 4e-3))
#: Label, method, integrator and options.
FORMULATIONS: tuple[tuple[str, str, str, Mapping[str, str | float]], ...] = (
    ("`lagrange`", "lagrange", "rk4", {}),
    ("`baumgarte`", "baumgarte", "rk4", {}),
    ("`velocity-projection`", "velocity-projection", "rk4", {}),
    ("`direct-correction`", "direct-correction", "rk4", {}),
    ("`direct-correction`, mass", "direct-correction", "rk4", {"method.weight": "mass"}),
    ("`coordinate-partitioning`", "coordinate-partitioning", "rk4", {}),
    ("`energy-projection`", "energy-projection", "rk4", {}),
    ("`half-explicit`", "half-explicit", "half-explicit", {}),
    ("`half-explicit`, `phem56`", "half-explicit", "phem56", {"integrator.adaptive": "false"}),
    ("`index3-augmented-lagrangian`", "index3-augmented-lagrangian", "trapezoidal", {}),
    ("`generalized-alpha`", "generalized-alpha", "generalized-alpha", {}),
    ("`rattle`", "rattle", "rattle", {}),
    ("`discrete-gradient`", "discrete-gradient", "discrete-gradient", {}),
    ("`symmetric-projection`", "symmetric-projection", "gauss", {}),
    ("`symmetric-projection`, `share=0`", "symmetric-projection", "gauss", {"method.share": 0.0}),
)


def growth(
    name: str, until: float, step: float, method: str, integrator: str, options: Mapping[str, str | float]
) -> Iterator[str]:
    """Yield the largest energy error in a tenth of the run and in all of it, and its exponent; then the violation."""
    result = load(name).simulate(
        method=method,
        integrator=integrator,
        step=step,
        until=until,
        options=options,
        times=np.linspace(0.0, until, 2001).tolist(),
        verify=False,
        max_violation=1e9,
        max_energy_error=1e9,
    )
    if len(result.t) < 2001:
        yield from (result.status, "", "", "")
        return
    largest = np.maximum.accumulate(np.abs(np.asarray(result.energy_error)))
    first, last = float(largest[200]), float(largest[-1])
    exponent = f"{np.log10(last / first):.1f}" if last > ROUNDING else "rounding"
    yield from (number(first), number(last), exponent, number(result.position_violation_max))


def table() -> PageTable:
    """Return the table of all formulations on both mechanisms."""
    rows = list[Row]()
    for name, until, step in MOTIONS:
        for label, method, integrator, options in FORMULATIONS:
            rows.append(((name, label), partial(list_of, growth, name, until, step, method, integrator, options)))
    ends = "energy error until T/10 [J]", "until T [J]", "exponent", r"largest \|Phi\| [m]"
    return PageTable("long", "docs/tables/long-runs.md", ("mechanism", "formulation", *ends), tuple(rows))


if __name__ == "__main__":
    sys.exit(print_tables({"long": table()}, sys.argv[1:]))

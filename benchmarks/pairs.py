"""The pairs of method and integrator that fit together, from the forms both declare, as a page of docs/tables.

python -m benchmarks.pairs > docs/tables/pairs.md
"""

from __future__ import annotations

import sys

from symgen.derive.methods import METHODS
from symgen.run.integrators import INTEGRATORS

INTRODUCTION = """# Pairs of method and integrator

Written by `python -m benchmarks.pairs` from the forms that methods give and [integrators](../integrators.md) solve.
Methods in one line take the same integrators; the default is **bold**. Anything else is refused with a sentence that
names those that fit.
"""


def forms_in_common(method: str, integrator: str) -> tuple[str, ...]:
    """Return the problem forms that the method gives and the integrator solves."""
    solved = INTEGRATORS.get(integrator).forms
    return tuple(form for form in METHODS.get(method).forms if form in solved)


def allowed_pairs() -> list[tuple[str, str]]:
    """Return every (method, integrator) that fits, in the order of the tables."""
    return [(m, i) for m in METHODS.names for i in integrators() if forms_in_common(m, i)]


def integrators() -> list[str]:
    """Return the integrators, explicit ones first, by order."""
    return sorted(INTEGRATORS.names, key=lambda n: ("ode" not in INTEGRATORS.get(n).forms, INTEGRATORS.get(n).order, n))


def page() -> str:
    """Return the whole page."""
    columns = integrators()
    groups: dict[tuple[tuple[str, ...], str, tuple[str, ...]], list[str]] = {}
    for name in METHODS.names:
        method = METHODS.get(name)
        fitting = tuple(c for c in columns if forms_in_common(name, c))
        groups.setdefault((method.forms, method.default_integrator, fitting), []).append(name)
    lines = [INTRODUCTION, "| methods | forms | integrators |", "| --- | --- | --- |"]
    for (forms, default, fitting), names in groups.items():
        marks = ", ".join(f"**`{c}`**" if c == default else f"`{c}`" for c in fitting)
        lines.append(f"| {', '.join(f'`{name}`' for name in names)} | {', '.join(forms)} | {marks} |")
    lines.append(f"\n{len(allowed_pairs())} of {len(METHODS.names) * len(columns)} pairs fit.\n")
    return "\n".join(lines)


if __name__ == "__main__":
    sys.stdout.write(page())

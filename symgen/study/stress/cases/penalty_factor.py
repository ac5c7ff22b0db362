"""The penalty of the methods that have one, far below and far above what suits a mechanism."""

from __future__ import annotations

from symgen.methods import METHODS
from symgen.study.stress.bench import Base, Level, pick, shown
from symgen.study.stress.cases import Family

VALUES, QUICK = (1e2, 1e4, 1e6, 1e8, 1e10, 1e12), (1e4, 1e8, 1e12)


def levels(base: Base, quick: bool) -> list[Level]:
    """Return one case a factor."""
    methods = tuple(name for name, method in METHODS.items() if any(p.name == "penalty" for p in method.parameters))
    return [
        base.level(
            *("penalty-factor", f"a = {shown(a)}", a),
            options={"method.penalty": a},
            methods=methods,
            closed=base.closed,
        )
        for a in pick(VALUES, QUICK, quick)
    ]


KIND = Family("penalty factor", ("penalty [kg or kg/s^2]",), levels)

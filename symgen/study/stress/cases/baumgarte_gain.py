"""Baumgarte's gains from none to far beyond the stability limit of the step."""

from __future__ import annotations

from symgen.study.stress.bench import Base, Level, pick, shown
from symgen.study.stress.cases import Family

#: alpha h = beta h, h being the mechanism's step.
VALUES, QUICK = (1e-3, 1e-2, 1e-1, 1.0, 2.5, 3.0, 1e1), (1e-2, 3.0)


def levels(base: Base, quick: bool) -> list[Level]:
    """Return one case a gain; both roots are -alpha."""
    return [
        base.level(
            *("baumgarte-gain", f"alpha h = {shown(x)}", x / base.step),
            options={"method.alpha": x / base.step, "method.beta": x / base.step},
            methods=("baumgarte",),
            closed=base.closed,
        )
        for x in pick(VALUES, QUICK, quick)
    ]


KIND = Family("Baumgarte's gains", ("alpha = beta [1/s]",), levels)

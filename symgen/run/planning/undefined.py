"""Which formula of a mechanism is undefined where a run ends."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from symgen.describe.facts.kinks import formulas_with_domain
from symgen.describe.formulas.formula_text import to_text
from symgen.run.compiling.side import compile_side
from symgen.run.layout import abi

if TYPE_CHECKING:
    from symgen.describe.mechanism import Force, Joint, Mechanism
    from symgen.run.single.outcome import Outcome

#: How a run ends that a formula without a value may end.
_ENDS = (abi.TINY_STEP, abi.NOT_FINITE)
#: Times after the end at which formulas are evaluated, as parts of that time: an adaptive run ends before it. Formulas
#: of the state are also evaluated an interval of outputs later, as a straight line to the end misses it by curvature.
_AFTER = (0.0, 1e-12, 1e-9, 1e-6)


def undefined_at_end(mechanism: Mechanism, outcome: Outcome) -> str:
    """Name the roots, quotients and logarithms in joints and forces that are undefined where a run fails.

    Parameters
    ----------
    mechanism : Mechanism
        With the inputs of the run in their places.
    outcome : Outcome
        In the coordinates of bodies.

    Returns
    -------
    str
        Such as ``"sqrt(0.5 - t) of force 'motor' is undefined"``; empty where nothing is, or the run ended otherwise.
    """
    if outcome.code not in _ENDS or not len(outcome.states):
        return ""
    parts: list[tuple[str, Joint | Force]] = [
        *(("joint", x) for x in mechanism.joints),
        *(("force", x) for x in mechanism.forces),
    ]
    limited = [(f"{kind} '{part.name}'", *pair) for kind, part in parts for pair in formulas_with_domain(part)]
    if not limited:
        return ""
    # a whole formula with a value does not use its undefined parts
    formulas = [pair for label, whole, e in limited for pair in ((label, whole), (f"{to_text(e)} of {label}", e))]
    side = compile_side(mechanism, outcome.compiled, "undefined", "Formulas with limits", formulas)
    y, before = outcome.states[-1], outcome.states[-2:][0]
    elapsed = outcome.times[-1] - outcome.times[-2:][0]
    slope = (y - before) / elapsed if elapsed > 0.0 else np.zeros_like(y)
    for t in (*(outcome.end * (1.0 + after) for after in _AFTER), outcome.end + elapsed):
        there = y + (t - outcome.times[-1]) * slope
        with np.errstate(all="ignore"):
            nan = np.isnan(side(t, there, outcome.p.copy(), outcome.w.copy(), np.zeros_like(y)))
        if names := list(dict.fromkeys(formulas[i][0] for i in range(1, len(nan), 2) if nan[i - 1] and nan[i])):
            return f"{', '.join(names)} {'is' if len(names) == 1 else 'are'} undefined"
    return ""

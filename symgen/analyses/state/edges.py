"""Formulas of joints, forces and outputs with a kink or a jump at a state: their derivatives are one-sided.

Formulas that compare something are evaluated beside the state. Where one has a derivative, what is left of differences
beyond straight lines falls with the square of the step; at a kink it falls with the step, at a jump not at all.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from symgen.describe.facts.kinks import switching_formulas
from symgen.run.compiling.side import compile_side

if TYPE_CHECKING:
    from symgen.analyses.state.sparse_statics import Sparse
    from symgen.analyses.state.subject import Subject
    from symgen.describe.mechanism import Force, Joint, Output

Array = NDArray[np.float64]

#: Steps from the state, as parts of the mechanism's length [m], of 1 rad, of as much in a second, or of an input's 1.
STEPS = (1e-5, 1e-7)
#: What is left of a straight line falls by this or more from one step to the next where there is a derivative, and so
#: does the difference across the state where there is no jump. What is below this part of a formula is rounding.
BENT, JUMPING, GRAIN = 1 / 200, 1 / 20, 1e-12


def sentence_on_edges(
    subject: Subject | Sparse, y: Array, a: Array | None = None, outputs: Sequence[str] = ()
) -> tuple[str, ...]:
    """Name formulas that have no derivative at a state in one sentence, in none where all have one.

    Parameters
    ----------
    subject : Subject or Sparse
        The mechanism.
    y : Array
        The state.
    a : Array, optional
        v' there, 0 by default; outputs may read it.
    outputs : sequence of str
        Outputs that count beside joints and forces.
    """
    mechanism, inputs = subject.mechanism, subject.inputs
    parts: list[tuple[str, Joint | Force | Output]] = [("joint", x) for x in mechanism.joints]
    parts += [("force", x) for x in mechanism.forces]
    parts += [("output", x) for x in mechanism.outputs if x.name in outputs]
    formulas = [(f"{kind} '{part.name}'", e) for kind, part in parts for e in switching_formulas(part)]
    if not formulas:
        return ()
    side = compile_side(mechanism, subject.compiled, "edges", "Formulas that compare something", formulas)
    info, motion = subject.compiled.info, subject.motion(y)
    nq, nv, names = info.nq, info.nv, [q.name for q in info.parameters]
    # no two change by the same part of their spans, so that their differences change as well
    along = np.split(np.linspace(1.0, 0.5, 3 * nv + len(inputs)), [nv, 2 * nv, 3 * nv])

    def values_beside(step: float) -> Array:
        there, p, rates = subject.move_state(y, motion @ (step * along[0])), subject.p.copy(), np.zeros_like(y)
        there[nq : nq + nv] += step * subject.spans * along[1]
        rates[nq : nq + nv] = step * subject.spans * along[2] + (0.0 if a is None else a)
        p[[names.index(name) for name in inputs]] += step * along[3]
        return side(subject.t, there, p, subject.w.copy(), rates)

    here, far, near = values_beside(0.0), *((values_beside(step), values_beside(-step)) for step in STEPS)
    rounding = GRAIN * (np.abs(here) + np.abs(far[0] - here) / STEPS[0])
    left, across = ([np.abs(x + sign * z - (1.0 + sign) * here) for x, z in (far, near)] for sign in (1.0, -1.0))
    counts = (left[1] > np.maximum(BENT * left[0], rounding)) | (across[1] > np.maximum(JUMPING * across[0], rounding))
    named = dict.fromkeys(label for (label, _), there in zip(formulas, counts, strict=True) if there)
    what = "formulas with a kink or a jump at this state count with the derivative of one side"
    return (f"{what}: {', '.join(named)}",) if named else ()

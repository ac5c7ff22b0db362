"""Where forces have no derivative: kinks, jumps, and roots that rise without bound, at the state that is looked at.

Derivatives are those of one side of a kink there, 0 at a jump, and 0 or a huge number at the end of a root: right for
what touches or rests on one side, and not for all that a mechanism does near the state. Differences tell: what is left
of them beyond the derivative falls with the step for a smooth force, and does not otherwise.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from symgen.analyses.subject import Subject
from symgen.compiling.linearised import Evaluated

Array = NDArray[np.float64]

#: Two steps along a direction, as parts of the mechanism's length [m], of 1 rad, or of as much in a second.
STEPS = (1e-4, 1e-6)
#: What is left, over the step, grows from the larger to the smaller one by their ratio to the power 1 - p where a force
#: goes with the power p: hundredfold at a jump, tenfold at a square root, not at a kink; a tenth is left of p = 1.5.
KINK, ROOT, JUMP = 0.5, 2.0, 50.0
#: Slopes above that are those of roots at 0 (`symgen.vocabulary.functions.steepest`).
STEEP = 1e80
#: What is left that is below this part of a force, and of what its slopes say of 1 m or 1 rad, is rounding.
ROUNDED = 1e-11


def edges(subject: Subject, y: Array) -> tuple[str, ...]:
    """Return sentences about forces that have no derivative at a state.

    Parameters
    ----------
    subject : Subject
        The mechanism.
    y : Array
        The state.

    Returns
    -------
    tuple of str
        One for positions and one for velocities, each with the coordinate that most is left along.
    """
    base = subject.evaluated(y)
    slopes = {"positions": base.by("balance", "q") @ base.by("motion", "v"), "velocities": base.by("balance", "v")}
    told = (_told(subject, y, base, what, slope) for what, slope in slopes.items())
    return tuple(sentence for sentence in told if sentence)


def _told(subject: Subject, y: Array, base: Evaluated, what: str, slope: Array) -> str:
    """Return what is to be said where positions or velocities change, nothing where forces are smooth."""
    limit = ROUNDED * (np.abs(base.value("balance")).max(initial=0.0) + np.abs(slope) @ subject.spans)
    for side in (1.0, -1.0):
        far, near = (_left(subject, y, base, what, slope, side * step) for step in STEPS)
        counts = (near * STEPS[1] > limit) & (near > KINK * far)
        if not np.any(counts):
            continue
        k = int(np.argmax(np.where(counts, near / np.maximum(far, 1e-300), 0.0)))
        name, growth = subject.compiled.info.velocities[k].name, near[k] / max(far[k], 1e-300)
        steep = np.abs(slope[k]).max(initial=0.0) > STEEP
        if growth > ROOT or steep:
            how = "jumps" if growth > JUMP and not steep else "rises without bound"
            said = f"{how} with {what}, which its derivative does not tell"
        else:
            said = f"has a kink where {what} change, and counts with its slope on one side"
        return f"at this state the force along {name} {said}"
    return ""


def _left(subject: Subject, y: Array, base: Evaluated, what: str, slope: Array, step: float) -> Array:
    """Return what is left of a difference of forces beyond their derivative, over the step."""
    # no two coordinates by the same amount, so that distances between them change as well
    change = step * subject.spans * np.linspace(1.0, 0.5, subject.nv)
    if what == "positions":
        there = subject.moved(y, base.by("motion", "v") @ change)
    else:
        there = y.copy()
        there[subject.nq : subject.nq + subject.nv] += change
    rest = subject.evaluated(there).value("balance") - base.value("balance") - slope @ change
    return np.asarray(np.abs(rest) / abs(step))

"""Where forces have no derivative: kinks, jumps, and roots that rise without bound, at the state that is looked at.

Derivatives are those of one side of a kink there, 0 at a jump, and 0 or a huge number at the end of a root: right for
what touches or rests on one side, and not for all that a mechanism does near the state. Differences tell: what is left
of them beyond the derivative falls with the step for a smooth force, and does not otherwise.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from symgen.analyses.subject import Subject

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


def edges(subject: Subject, y: Array, t: float | None = None) -> tuple[str, ...]:
    """Return sentences about forces that have no derivative at a state.

    Parameters
    ----------
    subject : Subject
        The mechanism.
    y : Array
        The state.
    t : float, optional
        Time [s]; that of the start by default.

    Returns
    -------
    tuple of str
        One for positions and one for velocities, each with the coordinate that most is left along.
    """
    base = subject.evaluated(y, t=t)
    motion, force, spans = base.by("motion", "v"), base.value("balance"), subject.spans
    found = list[str]()
    for what, slope in (("positions", base.by("balance", "q") @ motion), ("velocities", base.by("balance", "v"))):
        limit = ROUNDED * (np.abs(force).max(initial=0.0) + np.abs(slope) @ spans)
        for side in (1.0, -1.0):
            left = []
            for step in STEPS:
                # no two coordinates by the same amount, so that distances between them change as well
                change = side * step * spans * np.linspace(1.0, 0.5, len(spans))
                there = y.copy()
                if what == "velocities":
                    there[subject.nq : subject.nq + subject.nv] += change
                else:
                    there = subject.moved(y, motion @ change)
                rest = subject.evaluated(there, t=t).value("balance") - force - slope @ change
                left.append(np.abs(rest) / step)
            far, near = left
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
            found.append(f"at this state the force along {name} {said}")
            break
    return tuple(found)

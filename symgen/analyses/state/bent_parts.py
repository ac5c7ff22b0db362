"""Parts that bend at the state of an analysis: whether they keep the limits of their laws."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from symgen.result.part_limits import MotionOfBodies, doubt_on_parts, limits_of_parts

if TYPE_CHECKING:
    from collections.abc import Mapping

    from symgen.analyses.state.subject import Subject
    from symgen.describe.mechanism import Mechanism

Array = NDArray[np.float64]


def sentence_on_parts(subject: Subject, y: Array, a: Array | None = None) -> tuple[str, ...]:
    """Return a sentence on the part that a state bends farthest beyond its limit; none where all keep theirs.

    Parameters
    ----------
    subject : Subject
        The mechanism.
    y : Array
        The state.
    a : Array, optional
        v' there, 0 by default.
    """
    mechanism = subject.mechanism
    if not limits_of_parts(mechanism):
        return ()
    values = {q.name: float(x) for q, x in zip(subject.compiled.info.parameters, subject.p, strict=False)}
    rates = np.zeros(subject.nv) if a is None else a
    if subject.coordinates == "absolute":
        q, v = y[: subject.nq], y[subject.nq : subject.nq + subject.nv]
    else:
        functions, numbers = subject.form.functions, subject.evaluate(y, rates).value("functions")
        q = np.array([numbers[functions[f"{b.name}.{c}"][0]] for b in mechanism.bodies for c in b.coordinates])
        speeds = [functions[f"{b.name}.{s}"] for b in mechanism.bodies for s in b.speeds]
        v = np.array([numbers[at] for at, _ in speeds])
        rates = np.array([numbers[at + 1] if orders > 1 else 0.0 for at, orders in speeds])
    return sentence_on_motion(mechanism, values, MotionOfBodies(q[None], v[None], rates[None]))


def sentence_on_motion(
    mechanism: Mechanism, parameters: Mapping[str, float], motion: MotionOfBodies
) -> tuple[str, ...]:
    """Return the same of a motion of bodies, with values of parameters."""
    doubt = doubt_on_parts(mechanism, parameters, motion)
    return () if doubt is None else (f"beyond the limits of its parts: {doubt}",)

"""Limits of parts that a motion may exceed: how far beam elements and modal bodies may bend for their laws to hold.

They are judged wherever a state is computed: at the outputs of runs and of rows of sweeps, and at the states of
analyses. A limit is a measure of states over the largest that it may be, and the sentence on what exceeds it.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    from symgen.describe.mechanism import Mechanism
    from symgen.run.single.outcome import Motion

Array = NDArray[np.float64]


#: What is said of parts that bend where nothing judges them.
UNJUDGED = "how far parts bend is judged by runs, sweeps and analyses of symgen, and not here"


class MotionOfBodies(NamedTuple):
    """Coordinates, velocities and accelerations of bodies at some times; arrays have one row a time."""

    q: Array
    v: Array
    a: Array


class PartLimit(NamedTuple):
    """A limit of a part.

    Attributes
    ----------
    measure : callable
        Takes values of parameters and a motion of bodies; returns the measure over its limit at each time.
    sentence : callable
        Takes the largest of these; returns the sentence on it.
    """

    measure: Callable[[Mapping[str, float], MotionOfBodies], Array]
    sentence: Callable[[float], str]


def limits_of_parts(mechanism: Mechanism) -> tuple[PartLimit, ...]:
    """Return the limits of all parts of a mechanism that bend, in an order that does not change; none without such."""
    limits = list[PartLimit]()
    if any(force.flexures for force in mechanism.forces):
        from symgen.result.bending import limits_of_elements

        limits += limits_of_elements(mechanism)
    if mechanism.has_modal_bodies:
        from symgen.result.modal_limits import limits_of_modes

        limits += limits_of_modes(mechanism)
    return tuple(limits)


def remarks_without_limits(mechanism: Mechanism) -> tuple[str, ...]:
    """Return the remarks on a model for what judges no limits: emitted code, environments, motions in a page."""
    return (*mechanism.remarks, *((UNJUDGED,) if limits_of_parts(mechanism) else ()))


def largest_excess(
    limits: tuple[PartLimit, ...], parameters: Mapping[str, float], motion: MotionOfBodies
) -> tuple[int, float]:
    """Return the number of the limit that a motion exceeds most, and by which factor; below 1 it keeps all."""
    factors = [float(np.nanmax(limit.measure(parameters, motion), initial=0.0)) for limit in limits]
    worst = int(np.argmax(factors)) if factors else 0
    return worst, factors[worst] if factors else 0.0


def doubt_on_parts(mechanism: Mechanism, parameters: Mapping[str, float], motion: MotionOfBodies) -> str | None:
    """Return the sentence on the part that a motion bends farthest beyond its limit; None where all keep theirs."""
    limits = limits_of_parts(mechanism)
    worst, factor = largest_excess(limits, parameters, motion)
    return limits[worst].sentence(factor) if factor > 1.0 else None


def doubt_on_outputs(mechanism: Mechanism, parameters: Mapping[str, float], motion: Motion) -> str | None:
    """Return the same of the outputs of a run, in coordinates of bodies."""
    if not limits_of_parts(mechanism):
        return None
    q, v = motion.compiled.info.parts(motion.states)
    # v' at all outputs is worth its time where a law of parts reads it
    a = motion.accelerations if mechanism.has_modal_bodies else np.zeros_like(v)
    return doubt_on_parts(mechanism, parameters, MotionOfBodies(q, v, a))

"""Forces of efforts along measures, as nodes of a model's graph."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from symgen.base.vocabulary.expressions import ZERO
from symgen.base.vocabulary.measures import (
    Effort,
)
from symgen.derive.formulate.measure_nodes import ModelNodes
from symgen.derive.formulate.of_time import slope_and_potential


@dataclass(frozen=True)
class Exertion:
    """An effort in a model, as nodes.

    Attributes
    ----------
    row : mapping of int to int
        Velocity index -> entry of J, with s' = J v.
    rate : int
        s'.
    total : int
        -dU/ds + F.
    power : int
        F s', the power of the part without potential.
    energy : int
        U.
    """

    row: Mapping[int, int]
    rate: int
    total: int
    power: int
    energy: int


def exertion_of_effort(model: ModelNodes, effort: Effort) -> Exertion:
    """Return the force of an effort."""
    g, measure = model.graph, model.measure_or_velocity(effort.measure)
    rate = measure.rate(g, model.velocities)
    zero = g.zero
    conservative, energy = (
        (zero, zero) if effort.potential == ZERO else slope_and_potential(model, effort.potential, measure.value)
    )
    magnitude = model.expression(effort.magnitude, s=measure.value, rate=rate)
    total = g.add(conservative, magnitude)
    # what drifts changes the potential, and the force moves no body by it
    power = g.sub(g.mul(magnitude, measure.velocity_part(g, model.velocities)), g.mul(conservative, measure.drift))
    return Exertion(measure.row, rate, total, power, energy)

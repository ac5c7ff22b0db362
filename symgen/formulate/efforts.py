"""What efforts exert along their measures: a potential's slope and a magnitude."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from symgen.formulate.measures import ModelNodes
from symgen.formulate.of_time import potential_of
from symgen.vocabulary.expressions import ZERO
from symgen.vocabulary.measures import Effort


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
    magnitude : int
        F, the part without potential.
    energy : int
        U.
    """

    row: Mapping[int, int]
    rate: int
    total: int
    magnitude: int
    energy: int


def exertion(model: ModelNodes, effort: Effort) -> Exertion:
    """Return what an effort exerts."""
    measure = model.motion(effort.measure)
    rate = measure.rate(model.graph, model.velocities)
    zero = model.graph.zero
    conservative, energy = (
        (zero, zero) if effort.potential == ZERO else potential_of(model, effort.potential, measure.value)
    )
    magnitude = model.expression(effort.magnitude, s=measure.value, rate=rate)
    return Exertion(measure.row, rate, model.graph.add(conservative, magnitude), magnitude, energy)

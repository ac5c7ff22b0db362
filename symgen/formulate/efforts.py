"""What efforts exert along their measures: a potential's slope and a magnitude."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import sympy as sp

from symgen.formulate.measures import Model
from symgen.formulate.of_time import as_symbols, translated
from symgen.formulate.translate import to_sympy
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


def exertion(model: Model, effort: Effort) -> Exertion:
    """Return what an effort exerts."""
    measure = model.motion(effort.measure)
    rate = measure.rate(model.graph, model.velocities)
    conservative, energy = _conservative(model, effort, measure.value)
    magnitude = model.expression(effort.magnitude, s=measure.value, rate=rate)
    return Exertion(measure.row, rate, model.graph.add(conservative, magnitude), magnitude, energy)


def _conservative(model: Model, effort: Effort, s: int) -> tuple[int, int]:
    """Return -dU/ds and U of an effort's potential."""
    if effort.potential == ZERO:
        return model.graph.zero, model.graph.zero
    symbols = as_symbols(effort.potential, "s")
    potential = to_sympy(effort.potential, symbols)
    force, energy = translated(model, symbols, [-sp.diff(potential, symbols["s"]), potential], s=s)
    return force, energy

"""What efforts exert along their measures: a potential's slope and a magnitude."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import sympy as sp

from symgen.formulate.measures import Model
from symgen.formulate.translate import Translator, to_sympy
from symgen.vocabulary.expressions import ZERO, Expr, names
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


def as_symbols(e: Expr, *placeholders: str) -> dict[str, Any]:
    """Return a symbol for each name of a formula and each placeholder."""
    return {n: sp.Symbol(f"x{i}", real=True) for i, n in enumerate(dict.fromkeys([*placeholders, *names(e)]))}


def translated(model: Model, symbols: dict[str, Any], expressions: list[Any], **nodes: int) -> list[int]:
    """Return the nodes of SymPy expressions over symbols of names; placeholders stand for `nodes`."""
    known = {symbol: nodes[n] if n in nodes else model.names[n] for n, symbol in symbols.items()}
    return Translator(model.graph, known).all(expressions)

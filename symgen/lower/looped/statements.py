"""Statements of looped functions as data: loops over whole vectors, and calls of generic code."""

from __future__ import annotations

from dataclasses import dataclass

from symgen.ir.graph import Graph
from symgen.lower.record import Part

#: Spaces of a graph's inputs that are no sections of ``w``: parts of the state and its rates, and numbers.
VELOCITIES, RATES, WORK = "v", "rates.v", "rates.work"
LOCAL, PARAMETER, STATE = "local", "parameter", "status"


@dataclass(frozen=True)
class Loop:
    """``target[j] = node`` for all elements j of vectors of a size, and for one target after the other."""

    size: str
    outputs: tuple[tuple[str, int], ...]


@dataclass(frozen=True)
class Total:
    """``local = sum of node`` over all elements of vectors of a size; where `driven`, only if some row is driven."""

    local: int
    size: str
    node: int
    driven: bool


@dataclass(frozen=True)
class Number:
    """``place = node``: a local number, one of the status, or the rate of the work."""

    place: tuple[str, int]
    node: int


@dataclass(frozen=True)
class Call:
    """A call of generic code: arguments are names of arrays, sections and constants."""

    function: str
    arguments: tuple[str, ...]
    result: str = ""


Statement = Loop | Total | Number | Call


@dataclass(frozen=True)
class LoopedFunction:
    """A function of a law: statements over the nodes of a graph.

    Parameters
    ----------
    part : Part
        What is laid out.
    graph : Graph
        Its inputs are the general element of sections, and numbers.
    statements : tuple of Statement
        In their order.
    sections : dict
        Sections of ``w`` that are read or written, with their sizes.
    vectors : int
        Scratch vectors x0, x1, ....
    flagged : bool
        Whether the function returns if a pivot was suspicious.
    """

    part: Part
    graph: Graph
    statements: tuple[Statement, ...]
    sections: dict[str, str]
    vectors: int
    flagged: bool

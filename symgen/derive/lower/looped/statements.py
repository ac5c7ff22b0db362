"""Statements of looped functions as data: loops over whole vectors, and calls of generic code."""

from __future__ import annotations

from dataclasses import dataclass

from symgen.base.ir.graph import Graph
from symgen.derive.lower.recorded_law import Part

#: Spaces of a graph's inputs other than sections of ``w``: parts of the state and its rates, and numbers.
VELOCITIES, RATES, WORK = "v", "rates.v", "rates.work"
LOCAL, PARAMETER, STATE = "local", "parameter", "status"
#: Local numbers that hold sums.
SUM = "sum"


@dataclass(frozen=True)
class Assignment:
    """Values of numbers or, in a loop over all elements j of vectors of a size, of their general element.

    Parameters
    ----------
    outputs : tuple of (str, int, int)
        Space, index and node of each, in order; `SUM` takes the sum over all elements.
    size : {"", "nq", "nv", "m"}
        Of the loop; empty without a loop.
    driven : bool
        Whether the loop is skipped where no row is driven.
    """

    outputs: tuple[tuple[str, int, int], ...]
    size: str = ""
    driven: bool = False


@dataclass(frozen=True)
class KernelCall:
    """A call of generic code: arguments are names of arrays, sections and constants."""

    function: str
    arguments: tuple[str, ...]
    result: str = ""


Statement = Assignment | KernelCall


@dataclass(frozen=True)
class LoopedFunction:
    """A function of a law: statements over the nodes of a graph.

    Parameters
    ----------
    part : Part
        The part of the law.
    graph : Graph
        Its inputs are the general element of sections, and numbers.
    statements : tuple of Statement
        Statements in order.
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

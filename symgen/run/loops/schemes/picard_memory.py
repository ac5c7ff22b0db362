"""Memory of Picard's iteration: numbers that a run keeps between steps, and the working memory of a step."""

from __future__ import annotations

from symgen.compile.loopcode.nodes import TERMS
from symgen.compile.native.types import NODES
from symgen.run.layout import abi

#: Memory, before rates at the start of a step and Legendre coefficients of those of the last: the last step [s], 0 at
#: a start; 1 where nodes are evaluated one by one; 1 where the rates at the start of the step have to be evaluated.
STEP, SINGLE, STALE = range(3)
#: In working memory: the next step over this one; the buffer with the rates of the step; 1 where outputs need more of
#: them; 1 where nodes were evaluated one by one; 1 where the iteration has not converged; 1 where convergence bounds
#: the step, not the motion. A step across a singular position has `ACROSS` for the last but one.
RATIO, BUFFER, COARSE, ALONE, ADRIFT, SLOW = range(6)
ACROSS = 2.0
#: First indices of its parts: times of nodes, squares of coefficients, places of eight outputs, integrals and second
#: integrals of polynomials up to them, and arrays of the width of a state.
TIMES, SQUARES, PARTS_OF_STEP, ONCE = NODES, 2 * NODES, 4 * NODES, 5 * NODES
TWICE = ONCE + TERMS * NODES
WIDE = TWICE + TERMS * NODES
#: Of these, in widths: weights, a state, its rate, coefficients, states at nodes, two buffers of rates, a third, and
#: coefficients from all three.
WEIGHED, STATE, RATE, COEFFICIENTS, STATES, BUFFERS = 0, 1, 2, 3, 3 + 2 * NODES, 3 + 3 * NODES
MORE = BUFFERS + 2 * NODES
REFINED = MORE + NODES
ENDS = REFINED + TERMS


def memory(width: int) -> int:
    """Return the length of the memory of a run."""
    return NODES + width + 2 * NODES * width


def picard_room(width: int, windings: int) -> int:
    """Return the working memory of a step after the trial state; `windings` angles count turns."""
    return WIDE + ENDS * width + abi.N_STATUS + windings

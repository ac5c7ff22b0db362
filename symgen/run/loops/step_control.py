"""The next step after an accepted or a refused one, by its error estimate; some schemes replace these functions."""

from __future__ import annotations

import math

from symgen.run.layout import abi
from symgen.run.layout.records import Run, Span

#: Smallest factor of a step after a refused attempt; smallest and largest one after an accepted one; error estimate
#: that counts as 0.
SHRINK, SHRINK_ACCEPTED, GROW, FLOOR = 0.2, 0.2, 10.0, 1e-10


def shrunk_step(span: Span, run: Run, error: float) -> float:
    """Return the next step over a refused one, by its error over the tolerance."""
    return float(max(SHRINK, span.safety * error ** (-1.0 / run.control[abi.ORDER]))) if math.isfinite(error) else 0.1


def grown_step(span: Span, run: Run, h: float, error: float) -> float:
    """Return the next step over an accepted one of `h` seconds, by its error over the tolerance."""
    clock = run.clock
    allowed = max(error, FLOOR) ** (-1.0 / run.control[abi.ORDER])
    grow = span.safety * allowed
    if clock[abi.ALLOWED] > 0.0:  # errors are expected to change as in the last step (Gustafsson 1994)
        grow *= min(1.0, h / clock[abi.STEP] * allowed / clock[abi.ALLOWED])
    clock[abi.ALLOWED] = allowed
    return float(min(GROW, max(SHRINK_ACCEPTED, grow)))


def part_of_step(span: Span, until: float, step: float) -> Span:
    """Return a span that ends at a time [s], with another first step, or constant steps of another length [s]."""
    return Span(
        *(step, span.largest, until, span.end, span.duration, span.rtol, span.atol, span.relative),
        *(span.safety, span.most, span.pause, span.turn),
    )

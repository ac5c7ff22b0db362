"""Passages of a run near singular positions, where the forces of joints have no bound."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from symgen.base.errors import fit_lines

if TYPE_CHECKING:
    from symgen.result.result import Result

#: Passages that a sentence names at most.
MOST_NAMED = 4
#: A position is near a singular one where the smallest pivot is below this part of its largest in the run: links are
#: some six degrees from one line there.
NEAR = 0.01


def passages(result: Result) -> list[tuple[float, float]]:
    """Return when a run passes singular positions, begin and end [s], in the order of time.

    About each the span goes as far as the smallest pivot is below `NEAR` of its largest value: there, forces of joints
    depend on how near an output is.
    """
    near = result.smallest_pivot < NEAR * np.nanmax(result.smallest_pivot, initial=0.0)
    spans = list[tuple[float, float]]()
    for event in result.rank_events:
        begin, end = event.t_in, event.t_out if np.isfinite(event.t_out) else event.t_in
        first, last = int(np.searchsorted(result.t, begin)), int(np.searchsorted(result.t, end, "right")) - 1
        while first > 0 and near[first - 1]:
            first -= 1
        while last < len(result.t) - 1 and near[last + 1]:
            last += 1
        if first < len(result.t):
            begin = min(begin, float(result.t[first]))
        end = max(end, float(result.t[last])) if last >= 0 else end
        if spans and begin <= spans[-1][1]:
            begin, end = spans[-1][0], max(end, spans.pop()[1])
        spans.append((begin, end))
    return spans


def sentence_on_passages(result: Result) -> str:
    """Return what is said of a run that passes singular positions, without a full stop."""
    times = [f"{event.t_in:.4g}" for event in result.rank_events]
    first = fit_lines(len(times), MOST_NAMED)
    when = ", ".join(times[:first]) + (f" and {len(times) - first} times more" if len(times) > first else "")
    which = "a singular position" if len(times) == 1 else "singular positions"
    return f"The run passes near {which} at {when} s, where the forces of joints have no bound"


def outside_passages(result: Result) -> NDArray[np.bool_]:
    """Return which outputs of a run are not near a singular position that it passes."""
    outside = np.ones(len(result.t), dtype=np.bool_)
    for begin, end in passages(result):
        outside &= (result.t < begin) | (result.t > end)
    return outside

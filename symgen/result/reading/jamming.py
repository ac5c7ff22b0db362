"""Jamming numbers of efforts by reactions at the start of a run."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from symgen.base.ir.program import COUNTERS, JAMMING
from symgen.run.layout.probe import rate_function

if TYPE_CHECKING:
    from symgen.run.planning.prepare import Prepared


def jamming_numbers(run: Prepared) -> dict[str, float]:
    """Return the part of each reaction that its own effort brings about at the start, as if all joints moved.

    Parameters
    ----------
    run : Prepared
        A run at its start.

    Returns
    -------
    dict of str to float
        By the names of rows whose bounds depend on a reaction; empty without any. Those of contacts have a sign
        (`symgen.result.reading.contact_facts`).
    """
    compiled, start = run.compiled, run.start
    if JAMMING not in compiled.info.sections or any(row.signed for row in run.mechanism.bounded):
        return {}
    w = start.w.copy()
    places = [compiled.info.switchable.index(row) for row in compiled.info.bounded]
    compiled.modes(w)[places] = 0.0, 0.0, 1.0, 0.0, 0.0
    counters = np.zeros(len(COUNTERS), dtype=np.int64)
    rate_function(compiled)(start.t, start.y.copy(), start.p, w, counters, np.zeros_like(start.y))
    numbers = np.sqrt(compiled.section(w, JAMMING)).tolist()
    return dict(zip((row.name for row in run.mechanism.bounded if row.pressed), numbers, strict=True))

"""Rows of a sweep whose drivers lock: a row leaves too few numbers of its end, so that a run by itself says where."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from symgen.analyses.search.free_numbers import put_numbers
from symgen.base.errors import SymgenError
from symgen.result.build import build_result
from symgen.run.layout.ensemble_abi import ASSEMBLED
from symgen.run.planning.dead_centre import DEAD_CENTRE, DRIVER, ENDS
from symgen.run.planning.prepare import prepare
from symgen.study.ensemble.verdicts import summary_column

if TYPE_CHECKING:
    from symgen.study.ensemble.ensemble import Ensemble

Array = NDArray[np.float64]


def dead_centres_of_rows(ensemble: Ensemble, summary: Array) -> Iterator[tuple[int, str]]:
    """Yield the rows that end at a dead centre, with the sentence of a run by itself.

    Parameters
    ----------
    ensemble : Ensemble
        The rows.
    summary : Array, shape (runs, columns)
        What they have left.
    """
    mechanism, spec = ensemble.model.mechanism, ensemble.recipe.spec
    if all(joint.kind != DRIVER for joint in mechanism.joints):
        return
    ended = np.isin(summary_column(summary, "code"), ENDS) & (summary_column(summary, "start") == ASSEMBLED)
    common = replace(ensemble.plan.settings, until=spec.until, times=(0.0, spec.until), output_step=None, verify=False)
    columns = ensemble.grid.values(0, len(ensemble))
    for row in np.flatnonzero(ended).tolist():
        numbers = {name: float(column[row]) for name, column in columns.items()}
        try:
            run = prepare(mechanism, put_numbers(mechanism, common, numbers))
            reason = build_result(run, run.integrate()).reason or ""
        except SymgenError:
            continue
        if reason.startswith(DEAD_CENTRE):
            yield row, reason

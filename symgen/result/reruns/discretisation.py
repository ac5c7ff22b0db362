"""The error of the number of beam elements, estimated by a second run with twice as many."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from symgen.base.errors import SymgenError
from symgen.run.layout import abi

if TYPE_CHECKING:
    from symgen.base.settings import Settings
    from symgen.run.planning.prepare import Prepared
    from symgen.run.single.outcome import Outcome

#: Errors of order 4 fall to a sixteenth, so that two runs differ by fifteen of the finer one's.
_FIFTEEN = 15.0


def discretisation_error_sentence(run: Prepared, outcome: Outcome, settings: Settings) -> str | None:
    """Return a sentence about the error of the number of beam elements; None where there are no beams.

    Parameters
    ----------
    run, outcome : Prepared, Outcome
        A run, and what its loop gave.
    settings : Settings
        Settings of the run.
    """
    mechanism = run.plan.mechanism
    if not mechanism.beams or outcome.code != abi.DONE:
        return None
    from symgen.describe.facts.finer_beams import refine_beams
    from symgen.run.planning.prepare import prepare

    chosen = run.plan.settings
    settings = replace(settings, method=chosen.method, integrator=run.plan.integrator.name, options=chosen.options)
    settings = replace(settings, rtol=run.spec.rtol, atol=chosen.atol, times=tuple(outcome.times.tolist()))
    try:
        finer, names = refine_beams(mechanism)
        second = prepare(finer, settings)
        other = second.integrate()
    except SymgenError as error:
        return f"a check with twice the beam elements was not possible: {error}"
    if other.code != abi.DONE:
        return f"a check with twice the beam elements did not come to its end: {other.reason}"
    columns = [f"{body.name}.{c}" for body in finer.bodies for c in body.coordinates]
    a, b, apart = run.positions(outcome), second.positions(other), 0.0
    same, first = min(len(a), len(b)), 0
    for body in mechanism.bodies:
        places = [columns.index(f"{names[body.name]}.{axis}") for axis in body.coordinates if axis in ("x", "y", "z")]
        here = a[:same, first : first + len(places)]
        apart = max(apart, float(np.linalg.norm(here - b[:same, places], axis=1).max(initial=0.0)))
        first += len(body.coordinates)
    return (
        f"with twice the beam elements positions differ by {apart:.2g} m: the error of the number of elements is about "
        f"{apart * (1.0 + 1.0 / _FIFTEEN):.2g} m, with twice as many {apart / _FIFTEEN:.2g} m"
    )

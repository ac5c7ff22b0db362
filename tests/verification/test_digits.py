"""Digits of emitted right-hand sides: accelerations and multipliers beside dense equations in extended precision."""

import numpy as np
import pytest

from benchmarks.digits import SMALL, Equations, along_run, at_random

#: Loops by determinants and by pivots, a redundant row, hinges in space, springs of a beam, a driver that moves little.
ENTRIES = (
    *("four-bar", "n-four-bar:2", "andrews", "jansen-leg", "spatial-slider-crank", "bricard", "front-suspension"),
    *("cantilever", "scissor-lift", "dry-four-bar", "rolling-disc"),
)
#: Of an error over what the condition of a state explains, where the error is above `SMALL`.
MOST = 1000.0


@pytest.mark.by_turns(4)
@pytest.mark.slow
@pytest.mark.parametrize("coordinates", ["absolute", "joint"])
@pytest.mark.parametrize("name", ENTRIES)
def test_accelerations_and_multipliers_have_the_digits_that_the_condition_allows(name, coordinates):
    summary = at_random(Equations(name, coordinates), 100)
    assert len(summary.digits) >= 90
    for one in summary.digits:
        assert max(one.law) <= SMALL or one.ratio <= MOST
    assert np.median([max(one.law) for one in summary.digits]) <= 1e-10


@pytest.mark.by_turns(2)
@pytest.mark.slow
@pytest.mark.parametrize("coordinates", ["absolute", "joint"])
def test_few_evaluations_of_a_run_are_confirmed(coordinates):
    """Only near the positions in which both windows are flat."""
    summary = along_run(Equations("n-four-bar:2", coordinates), 200)
    assert 0 < summary.confirmed <= 0.01 * summary.evaluations
    assert all(max(one.law) <= SMALL or one.ratio <= MOST for one in summary.digits)

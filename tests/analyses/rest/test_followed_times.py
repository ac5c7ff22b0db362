"""Times at which a prescribed motion is followed between its outputs."""

import numpy as np
import pytest

from symgen.analyses.prescribed.tracing import FOLLOWED, SAME, refine_times


@pytest.mark.parametrize("sign", [1.0, -1.0])
@pytest.mark.parametrize("seed", range(5))
def test_no_two_times_are_far_apart_and_none_is_there_twice(seed, sign):
    dice = np.random.default_rng(seed)
    grid = np.arange(1, FOLLOWED) / FOLLOWED  # some outputs are times that would be added
    outputs = sign * np.sort(np.concatenate([dice.uniform(0.0, 3.0, 9), 3.0 * dice.choice(grid, 5, False), [3.0]]))
    times, are_outputs = refine_times(outputs)
    np.testing.assert_array_equal(times[are_outputs], outputs)
    gaps = np.diff(np.abs(np.append(0.0, times))) / 3.0
    assert gaps.min() > SAME
    assert gaps.max() < 2.0 / FOLLOWED


def test_times_that_lie_close_stay_alone():
    outputs = np.linspace(0.0, 1.0, 2 * FOLLOWED)[1:]
    times, are_outputs = refine_times(outputs)
    assert are_outputs.all()
    np.testing.assert_array_equal(times, outputs)
    assert refine_times(np.zeros(2))[1].all()

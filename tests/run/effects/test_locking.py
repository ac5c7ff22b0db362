"""What would jump farthest where drivers lock."""

import numpy as np
import pytest

from symgen.run.effects.locking import MOST_NAMED, name_jumps


@pytest.mark.parametrize(
    ("jumps", "expected"),
    [
        ([0.2, 1.0, 0.4, 0.9, 0.5], [1, 3, 4]),
        ([0.2, 1.0, 0.3], [1, -1, -1]),
        ([0.5, 0.5], [0, 1, -1]),
        ([0.0, 0.0], [-1, -1, -1]),
    ],
)
def test_the_farthest_jumps_are_named_by_falling_size(jumps, expected):
    named = np.zeros(MOST_NAMED, dtype=np.int64)
    name_jumps.plain(np.array(jumps), len(jumps), named)
    assert list(named) == expected

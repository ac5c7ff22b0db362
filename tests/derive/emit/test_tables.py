"""Emitted tables of straight lines: value and slope of the piece that an argument lies in, found by halving."""

import math
from itertools import pairwise

import numpy as np
import pytest

from symgen.derive.emit.emit import table_codes
from symgen.describe.mechanism import Table


class Counted(list[float]):
    """Points that count how often they are looked at."""

    looks = 0

    def __getitem__(self, place):
        self.looks += 1
        return super().__getitem__(place)


def emitted(x, y):
    """The functions of a table `f` as plain Python, and what they read its points from."""
    (code,) = table_codes([Table("f", tuple(x), tuple(y)).interpolated])
    namespace = {"np": np, "njit": lambda *_, **__: lambda function: function}
    exec(code.text, namespace)
    namespace["points_f"] = points = Counted(x)
    return namespace["table_f"], namespace["slope_f"], points


@pytest.mark.parametrize("count", [2, 3, 4, 7, 64, 1000])
def test_slopes_and_values_at_points_and_between_them(count):
    rng = np.random.default_rng(count)
    x, y = (np.cumsum(rng.integers(1, 9, count)) / 8.0).tolist(), rng.standard_normal(count).tolist()
    value, slope, points = emitted(x, y)
    pieces = [(b[1] - a[1]) / (b[0] - a[0]) for a, b in pairwise(zip(x, y, strict=True))]
    most = math.ceil(math.log2(count)) + 4
    for k, piece in enumerate(pieces):
        inside = 0.5 * (x[k] + x[k + 1])
        last = math.nextafter(x[k + 1], 0.0)
        # a point belongs to the piece behind it; the first and the last one lie beyond the ends
        for at in (inside, last, math.nextafter(x[k], math.inf), *([x[k]] if k else [])):
            points.looks = 0
            assert slope(at) == piece
            assert points.looks <= most
        assert value(inside) == pytest.approx(0.5 * (y[k] + y[k + 1]), abs=1e-13)
        assert value(x[k]) == y[k]
    assert [slope(at) for at in (x[0], x[-1], x[0] - 1.0, x[-1] + 1.0, -math.inf, math.inf)] == [0.0] * 6

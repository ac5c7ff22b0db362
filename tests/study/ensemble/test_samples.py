"""Random samples: percentiles, shares of variance, points instead of lines."""

import numpy as np
import pytest

import symgen
from symgen.study.ensemble.axes import Axis, Grid
from symgen.study.ensemble.samples import contributions, has_samples, is_sample


def test_shares_of_a_straight_line_are_squares_of_slope_and_spread():
    random = np.random.default_rng(1)
    x, y = random.normal(0.0, 2.0, 20_000), random.normal(5.0, 1.0, 20_000)
    shares = contributions({"x": x, "y": y, "still": np.ones(20_000)}, 3.0 * x - 8.0 * y + 1.0)
    assert shares["x"] == pytest.approx(36.0 / 100.0, abs=0.02) and shares["y"] == pytest.approx(0.64, abs=0.02)
    assert sum(shares.values()) == pytest.approx(1.0, abs=1e-12) and shares["still"] == 0.0


def test_what_straight_lines_leave_is_missing():
    x = np.random.default_rng(2).uniform(-1.0, 1.0, 5000)
    assert contributions({"x": x}, x**2)["x"] == pytest.approx(0.0, abs=0.01)
    with_gaps = np.where(np.arange(5000) % 3 == 0, np.nan, 2.0 * x)
    assert contributions({"x": x}, with_gaps)["x"] == pytest.approx(1.0, abs=1e-12)
    with pytest.raises(symgen.InputError, match=r"expected at least 3 runs with the quantity, got 2"):
        contributions({"x": x[:2]}, x[:2])


def test_an_axis_that_goes_up_and_down_is_a_sample():
    numbers = np.random.default_rng(3).uniform(size=12)
    up, drawn = Axis("a", {"a": np.sort(numbers)}), Axis("b", {"b": numbers})
    assert not is_sample(up) and is_sample(drawn) and not is_sample(Axis("c", {"c": np.array([1.0, 3.0, 2.0])}))
    assert has_samples(Grid((up, drawn))) and not has_samples(Grid((up,)))


def test_a_tolerance_study_is_drawn_as_points_with_percentiles():
    pytest.importorskip("matplotlib")
    masses = {"crank_mass": "uniform(1, 3, 40, 1)", "rocker_mass": "uniform(4, 6, 40, 2)"}
    study = symgen.sweep("four-bar", runs=masses, quantities=["max(A.F)"], until=0.1, output_step=0.01)
    shares = study.contributions("max(A.F)")
    assert shares["crank_mass"] > 0.5 and 0.9 < sum(shares.values()) <= 1.0
    figure = study.plot(over="crank_mass").figure
    points, *levels = figure.axes[0].lines
    assert points.get_linestyle() == "None" and len(points.get_xdata()) == 40
    values = study["max(A.F)"].ravel()
    assert [line.get_ydata()[0] for line in levels] == pytest.approx(np.percentile(values, [5, 50, 95]))

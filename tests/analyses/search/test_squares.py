"""Means over even times, and least squares, beside closed forms."""

import math

import numpy as np
import pytest

from symgen.analyses.search.sampled_motions import Sampled, mean_weights
from symgen.analyses.search.squares import determine, least_squares_within


@pytest.mark.parametrize("count", [1, 2, 3, 73, 74, 145, 146, 721, 1441])
def test_weights_of_a_mean_are_positive_even_about_the_middle_and_add_up_to_one(count):
    weights = mean_weights(count)
    assert weights.sum() == pytest.approx(1.0, rel=1e-14)
    assert np.all(weights > 0.0)
    assert weights == pytest.approx(weights[::-1], rel=1e-14)


def test_means_over_many_times_are_exact_for_polynomials_and_all_are_for_periods():
    for degree in range(8):
        assert mean_weights(1441) @ np.linspace(0.0, 1.0, 1441) ** degree == pytest.approx(
            1.0 / (degree + 1), rel=1e-14
        )
    for count in (73, 1441):
        turn = np.linspace(0.0, 2.0 * np.pi, count)
        for harmonic in range(1, 13):
            assert mean_weights(count) @ np.cos(harmonic * turn + 0.3) ** 2 == pytest.approx(0.5, rel=1e-13)


@pytest.mark.parametrize("end", np.linspace(0.3, 5.0, 11))
def test_the_mean_square_of_a_wave_and_its_slopes_are_those_of_the_integral(end):
    # y = sin(a t), mean of y^2 = 1/2 - sin(2 a T)/(4 a T), with its derivative by a
    a, t = 1.7, np.linspace(0.0, end, 1441)
    sampled = Sampled(t, np.sin(a * t)[:, None], (t * np.cos(a * t))[:, None, None], np.arange(1441))
    size, slope = sampled.mean_square(0)
    angle = 2.0 * a * end
    square = 0.5 - 0.5 * math.sin(angle) / angle
    assert size == pytest.approx(math.sqrt(square), rel=1e-13)
    expected = -0.5 * (math.cos(angle) / angle - math.sin(angle) / angle**2) * 2.0 * end
    assert slope[0] == pytest.approx(0.5 * expected / math.sqrt(square), rel=1e-11)


def test_the_least_squares_of_a_line_have_the_errors_of_textbooks():
    t = np.linspace(0.0, 1.0, 40)
    noise = 0.01 * np.random.default_rng(5).standard_normal(40)
    columns = np.stack([np.ones(40), t], axis=1)
    open_ends = np.full(2, np.inf)
    found = least_squares_within(
        lambda x: (columns @ x - (2.0 + 3.0 * t + noise), columns), np.array([1.0, 1.0]), -open_ends, open_ends
    )
    known = determine(found, np.abs(found.x), ("at 0", "slope"))
    expected, covariance = np.polyfit(t, 2.0 + 3.0 * t + noise, 1, cov=True)
    assert found.is_still and found.x == pytest.approx(expected[::-1], rel=1e-9)
    assert known.errors == pytest.approx(np.sqrt(np.diag(covariance))[::-1], rel=1e-6)
    assert known.correlations[0, 1] == pytest.approx(covariance[0, 1] / np.sqrt(np.prod(np.diag(covariance))), rel=1e-6)
    assert not known.null


def test_numbers_that_only_a_product_determines_have_a_sentence_and_no_errors():
    t = np.linspace(1.0, 2.0, 20)

    def rows(x):
        return x[0] * x[1] * t - 6.0 * t, np.stack([x[1] * t, x[0] * t], axis=1)

    found = least_squares_within(rows, np.array([1.0, 1.0]), np.zeros(2), np.full(2, 10.0))
    known = determine(found, np.abs(found.x), ("a", "b"))
    assert found.x.prod() == pytest.approx(6.0)
    assert known.null == ("a by z and b by z^(-1) can be multiplied together, for any number z",)
    assert np.isnan(known.errors).all()

"""Coverage of intervals: the record has all fits, and `identify` gives the values and intervals of some of them."""

import numpy as np
import pytest

from benchmarks.identification import (
    BATCH,
    CASES,
    FITS,
    RECORD,
    batches,
    corrections,
    covered,
    fitted,
    interval,
    jobs,
    standard_errors,
    subject,
)


def test_the_record_has_every_fit_and_its_coverages_are_those_of_95_percent():
    assert {(line["case"], line["batch"]) for line in RECORD.lines()} == {*jobs()}
    for name, case in CASES.items():
        assert len(batches(name)) == FITS // BATCH
        for line in batches(name):
            assert {len(line[key]) for key in ("inside", "bias", "square", "errors")} == {len(case.true)}
            assert all(0 <= hits <= BATCH for hits in line["inside"])
            assert all(3 < runs < 60 for runs in (*line["runs"], *line["differences"]))
        for k in range(len(case.true)):
            hits, count = covered(name, k)
            assert count == FITS
            assert 0.94 - 2.0 * (0.94 * 0.06 / FITS) ** 0.5 <= hits / count <= 0.96 + 2.0 * (0.96 * 0.04 / FITS) ** 0.5


def test_the_interval_of_a_share():
    # Newcombe, Stat. Med. 17 (1998) 857-872, has Wilson's of 81 of 263 and of 15 of 148
    assert interval(81, 263) == pytest.approx((0.2553, 0.3662), abs=5e-5)
    assert interval(15, 148) == pytest.approx((0.0624, 0.1605), abs=5e-5)


def test_corrections_and_standard_errors_are_those_of_a_line():
    x = np.linspace(0.0, 1.0, 11)
    slopes, residuals = np.stack([np.ones(11), x], axis=1), 0.3 - 2.0 * x + 0.1 * np.cos(9.0 * x)
    line, covariance = np.polyfit(x, residuals, 1, cov=True)
    np.testing.assert_allclose(corrections(residuals[None], slopes[None])[0], -line[::-1], rtol=1e-10)
    left = residuals - np.polyval(line, x)
    found = standard_errors(left[None], slopes[None])[0]
    np.testing.assert_allclose(found, np.sqrt(np.diag(covariance))[::-1], rtol=1e-10)


@pytest.mark.by_turns(6)
@pytest.mark.slow
@pytest.mark.parametrize("name", CASES)
def test_identify_has_the_values_and_intervals_of_seven_fits(name):
    own, count = subject(name), 7
    found = fitted(own, range(count))
    for k in range(count):
        fit = own.fit(k)
        assert not fit.notes and fit.result.ok
        errors = found.errors[k]
        assert np.abs(np.array([*fit.parameters.values()]) - found.x[k]).max() < 1e-3 * errors.min()
        np.testing.assert_allclose([*fit.errors.values()], errors, rtol=1e-4)
        ends = np.stack([found.x[k] - found.half[k], found.x[k] + found.half[k]], axis=1)
        assert np.abs(np.array([*fit.intervals.values()]) - ends).max() < 1e-3 * errors.min()

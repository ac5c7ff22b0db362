"""Statistics over random mechanisms: the same seed gives the same cases, and cells are quantiles of ratios."""

import pytest

from benchmarks.statistics import Measured, cases, line


def test_cells_are_quantiles_of_ratios_to_lagrange():
    base = Measured(1e-4, 1e-3, 1e-6, 1.0)
    others = [Measured(1e-4 / r, 1e-3 / r, 1e-8, 1.5) for r in (0.5, 1.0, 2.0, 4.0, 8.0)]
    count, low, middle, high, better, worse, mean, reactions, violations, seconds = line(
        [(base, other) for other in others]
    )
    assert (count, middle, better, worse, mean) == ("5", "2", "60 %", "20 %", "2")
    assert (reactions, violations, seconds) == ("2", "100", "1.5")
    assert (float(low), float(high)) == pytest.approx((0.7, 6.4))


def test_a_case_measures_a_method_against_its_reference():
    case = next(cases(3, 2026, 1.0))
    again = next(cases(3, 2026, 1.0))
    assert again.step == case.step and (again.distances.reference.q == case.distances.reference.q).all()
    coarse = case.run("direct-correction", "rk4")
    fine = case.run("direct-correction:weight=mass", "dop853")
    assert 0.0 < fine.error < 0.1 * coarse.error
    assert coarse.violation < 1e-9 and case.run("no-such-method", "rk4") is None

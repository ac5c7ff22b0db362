"""Findings follow from rows made by hand, whose message is known."""

import pytest

from study.report.made import row, study
from symgen.base.errors import enumeration
from symgen.study.report import words
from symgen.study.report.comparison_findings import costs_of_methods, findings_of_rows, observed_order


def one(found, begin):
    """Return the one sentence that begins so."""
    matching = [text for text in found if text.lower().startswith(begin)]
    assert len(matching) == 1, found
    return matching[0]


def test_every_sentence_is_one():
    for text in findings_of_rows(study()):
        assert text[0].isupper() or text[0].isdigit()
        assert text.endswith(".") and "None" not in text and "nan" not in text


@pytest.mark.parametrize(
    ("duration", "told"),
    [(0.9996, "1 s"), (0.9994, "999 ms"), (9.996e-4, "1 ms"), (9.994e-4, "999 µs"), (3.4, "3.4 s")],
)
def test_durations_are_told_in_the_unit_that_they_round_to(duration, told):
    assert words.seconds_in_words(duration) == told


def test_the_reference_and_the_rows_below_it():
    text = one(findings_of_rows(study()), "errors are distances")
    assert "a formula at 3×10⁻¹⁴" in text and "off by about 10⁻¹² m" in text
    assert "1 row lies below that (marked *), beyond what the reference resolves" in text
    assert "Note: they part" in one(findings_of_rows(study(note="they part")), "errors are distances")


def test_cheapest_runs_by_error():
    text = one(findings_of_rows(study()), "cheapest runs")
    assert (
        "below 0.001 m, lagrange with rk4 at step 0.001 s (1 ms; the next method, baumgarte, takes 1.10 times" in text
    )
    assert "below 10⁻⁹ m, direct-correction with rk4 at step 0.0005 s (2.4 ms)" in text


def test_failures_and_successes_that_were_none():
    found = findings_of_rows(study())
    assert one(found, "of 8 runs") == "Of 8 runs 7 ended ok, 1 failed."
    assert "baumgarte with rk4 at step 0.0005 s: the state is no longer finite at t = 0.3 s" in one(
        found, "1 run failed"
    )
    text = one(found, "2 runs ended ok although")
    assert "penalty (2); the worst is penalty with rk4 at step 0.001 s, 0.5 m" in text
    good = [r for r in study().rows if r.method != "penalty"]
    assert one(findings_of_rows(study(good)), "no run that ended ok is off by more than 0.001 m")


def test_failures_for_one_reason_are_told_together():
    rows = [
        row("lagrange", h, None, 1e-3, status="failed", reason=f"the state is no longer finite at t = {h} s")
        for h in (1e-3, 2e-3)
    ]
    text = one(findings_of_rows(study(rows)), "2 runs failed for one reason")
    assert "lagrange (2); e.g. lagrange with rk4 at step 0.001 s: the state is no longer finite at t = 0.001 s" in text


def test_violations_by_method():
    text = one(findings_of_rows(study()), "largest position violation")
    assert "below 10⁻¹¹ with baumgarte, direct-correction and penalty; 3×10⁻⁸ m with lagrange" in text.replace(
        "3.0", "3"
    )


def test_costs_are_medians_over_equal_settings():
    found = {method: (middle, low, high, n) for method, middle, low, high, n in costs_of_methods(study())}
    assert "lagrange" not in found
    assert found["direct-correction"] == pytest.approx((1.25, 1.2, 1.3, 2))
    assert found["baumgarte"] == pytest.approx((1.1, 1.1, 1.1, 1))  # the failed run has no ratio
    assert "baumgarte 1.10, penalty 1.20 and direct-correction 1.25" in one(
        findings_of_rows(study()), "run time as a multiple"
    )


def test_order_of_convergence():
    rows = [row("lagrange", h, 3.0 * h**4, 1.0) for h in (8e-3, 4e-3, 2e-3)]
    assert observed_order(rows, 0.0) == pytest.approx(4.0)
    assert observed_order([*rows, row("lagrange", 1e-3, 1e-12, 1.0)], 1e-12) == pytest.approx(
        4.0
    )  # at the reference's own error
    # where rounding has made errors grow again with smaller steps, they say nothing of the order
    rounding = [row("lagrange", 1e-3, 1e-13, 1.0), row("lagrange", 5e-4, 3e-13, 1.0)]
    assert observed_order([*rows, *rounding], 0.0) == pytest.approx(observed_order([*rows, rounding[0]], 0.0))
    assert observed_order(rounding, 0.0) is None
    assert observed_order(rows[:1], 0.0) is None
    assert (
        "with rk4 the error falls with the power 4.0 of the step"
        in one(findings_of_rows(study(rows)), "with rk4").lower()
    )


def test_the_spread_of_ratios_is_stated():
    text = one(findings_of_rows(study()), "made again")
    assert "10 % in the median row and 10 % in the worst" in text


def test_an_empty_study_says_little():
    found = findings_of_rows(study([], traces=(), interrupted=True))
    assert "rows are missing" in one(found, "of 0 runs")


def test_words():
    assert [words.rounded_number(x) for x in (0.0, 0.25, 1234.0, 3.14e-7, 1e-7, -2.5e-5, None, float("nan"))] == [
        *("0", "0.25", "1200", "3.1×10⁻⁷", "10⁻⁷", "−2.5×10⁻⁵", "–", "not finite"),
    ]
    assert [words.chosen_number(x) for x in (0.001, 5e-5, 1e-8, 0.004)] == ["0.001", "5×10⁻⁵", "10⁻⁸", "0.004"]
    assert [words.seconds_in_words(x) for x in (2.0, 1.27e-3, 8.5e-5)] == ["2 s", "1.27 ms", "85 µs"]
    assert [words.percent_in_words(x) for x in (0.004, 0.05, 0.1, 5.8)] == ["0.4 %", "5.0 %", "10 %", "580 %"]
    assert enumeration(["a", "b", "c"]) == "a, b and c" and enumeration([]) == ""
    assert words.readable_number("|Phi| > 1e-06 at 0.5 s") == "|Φ| > 10⁻⁶ at 0.5 s"

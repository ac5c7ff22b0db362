"""Comparisons of derivatives of motions, against differences of references that share no code with the runs."""

import numpy as np
import pytest
from click.testing import CliRunner

import symgen
from symgen.base.errors import InputError
from symgen.cli.compare import command
from symgen.study.comparison.gradients import difference_slopes
from symgen.study.journal import Journal
from symgen.study.report.kinds.comparison_report import comparison_report

RUNS = {
    "methods": ["lagrange", "direct-correction", "ggl"],
    "integrators": ["rk4", "radau5"],
    "steps": [8e-3, 4e-3],
    "rtols": [1e-6],
    "until": 0.4,
    "repeat": 1,
    "gradient": ["crank_mass", "rocker_mass"],
}


@pytest.fixture(scope="module")
def journal(tmp_path_factory):
    return tmp_path_factory.mktemp("journal") / "rows.journal"


@pytest.fixture(scope="module")
def study(journal):
    with Journal(journal) as records:
        return symgen.compare("four-bar", journal=records, **RUNS)


@pytest.mark.by_turns(2)
@pytest.mark.slow
@pytest.mark.parametrize("method", ["lagrange", "direct-correction"])
def test_errors_of_derivatives_fall_at_the_order_of_the_scheme(study, method):
    coarse, fine = (row.gradient_error for row in study.rows if (row.method, row.integrator) == (method, "rk4"))
    assert 1e-10 < fine < coarse < 1e-5
    assert np.log2(coarse / fine) == pytest.approx(4.0, abs=0.6)
    assert all(row.gradient_seconds > 0.0 for row in study.rows if row.integrator == "rk4")


@pytest.mark.slow
def test_schemes_without_derivatives_have_rows_without_them(study):
    implicit = [row for row in study.rows if row.integrator == "radau5"]
    assert implicit
    assert all(row.error is not None and row.gradient_error is None is row.gradient_seconds for row in implicit)
    assert all(row.adjoint_error is None is row.adjoint_seconds for row in implicit)


@pytest.mark.slow
def test_adjoint_and_differences_beside(study):
    explicit = [row for row in study.rows if row.gradient_error is not None]
    for row in explicit:
        # with constant steps all three have the error of the scheme, which the best differences cancel in part
        assert 0.0 < row.adjoint_error <= 1.001 * row.gradient_error
        assert 1e-12 < row.differences_error < 1.05 * row.gradient_error + 1e-9
        assert row.adjoint_seconds > 0.0
        assert row.differences_seconds > 0.0
    # an implicit scheme has differences alone
    assert all(1e-12 < row.differences_error < 1e-2 for row in study.rows if row.integrator == "radau5" and row.error)


@pytest.mark.slow
def test_journals_tables_and_reports(study, journal):
    with Journal(journal) as records:
        again = symgen.compare("four-bar", journal=records, **RUNS)
    assert again.rows == study.rows
    tables = [table for part in comparison_report([study], "", [], {}).sections[0].parts for table in part.tables]
    table = next(table for table in tables if table.caption.startswith("Derivatives by parameters"))
    assert len(table.rows) == len(study.rows)


@pytest.mark.slow
def test_the_command_shows_them():
    options = ["--methods", "lagrange", "--integrators", "rk4", "--steps", "8e-3", "--until", "0.4", "--repeat", "1"]
    shown = CliRunner().invoke(command, ["four-bar", *options, "--gradient", "crank_mass"], standalone_mode=False)
    assert "error of derivatives" in shown.output
    assert "differences, least error" in shown.output
    shown = CliRunner().invoke(command, ["four-bar", *options], standalone_mode=False)
    assert "error of derivatives" not in shown.output


def test_differences_of_fourth_order():
    assert difference_slopes({k: np.array([(1.0 + 0.1 * k) ** 4]) for k in (-2, -1, 1, 2)}, 0.1) == pytest.approx([4.0])


@pytest.mark.parametrize(
    ("model", "names", "expected"),
    [
        ("four-bar", ["crank_mas"], "gradient: expected parameters of four-bar, got 'crank_mas'; .*crank_mass"),
        ("four-bar", ["crank.omega"], "expected parameters of four-bar, got 'crank.omega'"),
        ("four-bar", [3], "gradient: expected"),
    ],
)
def test_other_names_are_refused(model, names, expected):
    with pytest.raises(InputError, match=expected):
        symgen.compare(model, gradient=names, until=0.1)

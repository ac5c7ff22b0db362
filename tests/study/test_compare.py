import csv
import json

import numpy as np
import pytest

import symgen
import symgen.methods
from symgen.errors import InputError
from symgen.study import compare as module

ROW_KEYS = {
    *("method", "integrator", "step", "rtol", "status", "reason", "error", "run_seconds", "run_seconds_spread"),
    *("evaluations", "position_violation_max", "velocity_violation_max", "energy_drift_max", "below_reference"),
    "warnings",
}


@pytest.fixture(scope="module")
def study():
    return symgen.compare(
        "four-bar", ["baumgarte", "direct-correction", "lagrange"], ["rk4", "dop853"], [8e-3, 4e-3], until=1.0, repeat=1
    )


def test_rows_come_in_order(study):
    found = [(r.method, r.integrator, r.step or r.rtol) for r in study.rows]
    one = [("rk4", 8e-3), ("rk4", 4e-3), ("dop853", 1e-6), ("dop853", 1e-8), ("dop853", 1e-10)]
    assert found == [(m, *rest) for m in ("baumgarte", "direct-correction", "lagrange") for rest in one]
    assert not study.interrupted and not study.failed


def test_json_is_the_contract(study):
    found = study.to_json()
    assert json.loads(json.dumps(found, allow_nan=False)) == json.loads(json.dumps(found))
    assert set(found) == {"mechanism", "until", "reference", "rows"}
    assert set(found["reference"]) == {"how", "estimated_error"}
    for row in found["rows"]:
        assert set(row) == ROW_KEYS
        assert (row["step"] is None) != (row["rtol"] is None)


def test_errors_shrink_with_the_fourth_power_of_the_step(study):
    for method in ("baumgarte", "direct-correction", "lagrange"):
        coarse, fine = (r.error for r in study.rows if r.method == method and r.integrator == "rk4")
        assert 3.5 < np.log2(coarse / fine) < 5.0


def test_errors_follow_the_tolerance(study):
    for method in ("baumgarte", "direct-correction", "lagrange"):
        errors = [r.error for r in study.rows if r.method == method and r.rtol]
        assert errors[0] > errors[1] > errors[2] > 0.0
        assert errors[2] < 1e-7


def test_a_failed_run_stays_a_row():
    study = symgen.compare("n-four-bar:1", ["lagrange", "direct-correction"], ["rk4"], [1e-3], until=4.0, repeat=1)
    wrong, right = study.rows
    assert wrong.status == "failed" and wrong.error is None and " at t = " in wrong.reason
    assert right.status == "ok" and right.error < 1e-7 and right.warnings
    assert not study.failed
    assert symgen.compare("n-four-bar:1", ["lagrange"], ["rk4"], [1e-3], until=4.0, repeat=1).failed


def test_rows_below_the_reference_are_marked(monkeypatch):
    from dataclasses import replace

    real = module.reference
    monkeypatch.setattr(module, "reference", lambda *a, **k: replace(real(*a, **k), estimated_error=1e-3))
    study = symgen.compare("pendulum", ["lagrange"], ["rk4"], [1e-2], until=0.5, repeat=1)
    assert study.rows[0].below_reference


def test_options_go_to_those_they_are_meant_for():
    study = symgen.compare(
        "pendulum", ["lagrange", "baumgarte"], ["rk4"], [1e-3], until=0.5, repeat=1, options={"baumgarte.alpha": 20.0}
    )
    assert [r.status for r in study.rows] == ["ok", "ok"]


@pytest.mark.parametrize(
    ("arguments", "sentence"),
    [
        ({"methods": ["lagrang"]}, "did you mean 'lagrange'?"),
        ({"integrators": ["rk"]}, "expected an integrator, got 'rk'"),
        ({"steps": [-1.0]}, "step: expected a number above 0"),
        ({"until": float("nan")}, "until: expected a finite number above 0, got nan"),
        ({"repeat": 0}, "repeat: expected a whole number from 1 to 1000, got 0"),
        ({"options": {"lagrange.alpha": 1.0}}, "option lagrange.alpha"),
    ],
)
def test_what_is_wrong_is_refused_before_anything_runs(arguments, sentence, monkeypatch):
    def never(*_, **__):
        raise AssertionError("something was run")

    monkeypatch.setattr(module, "repeated", never)
    monkeypatch.setattr(module, "reference", never)
    with pytest.raises(InputError) as caught:
        symgen.compare("four-bar", **arguments)
    assert sentence in str(caught.value)


def test_an_interrupted_study_keeps_its_rows(monkeypatch):
    real, calls = module.repeated, []

    def sometimes(*arguments):
        calls.append(1)
        if len(calls) == 3:
            raise KeyboardInterrupt
        return real(*arguments)

    monkeypatch.setattr(module, "repeated", sometimes)
    study = symgen.compare("pendulum", ["lagrange"], ["rk4"], [4e-2, 2e-2, 1e-2, 5e-3], until=0.5, repeat=1)
    assert study.interrupted and len(study.rows) == 2
    assert study.to_json()["reference"]["how"] == "Jacobi's elliptic functions"


def test_progress_counts_rows():
    seen = []
    symgen.compare(
        "pendulum", ["lagrange"], ["rk4"], [2e-2, 1e-2], until=0.2, repeat=1, progress=lambda *a: seen.append(a)
    )
    assert seen[0] == ("reference", 0.0, 3.0)
    assert seen[-2:] == [("lagrange, rk4", 1.0, 3.0), ("lagrange, rk4", 2.0, 3.0)]


def test_rows_as_a_file_and_as_a_frame(study, tmp_path):
    with study.save(tmp_path / "rows.csv").open(newline="") as file:
        rows = list(csv.DictReader(file))
    assert len(rows) == len(study.rows)
    assert rows[0]["mechanism"] == "four-bar" and float(rows[0]["error"]) == study.rows[0].error
    assert rows[0]["rtol"] == ""
    assert list(study.to_dataframe()["error"]) == [r.error for r in study.rows]
    with pytest.raises(InputError, match=r"a file ending in \.csv"):
        study.save(tmp_path / "rows.txt")


@pytest.mark.slow
@pytest.mark.parametrize("name", ["pendulum", "four-bar", "slider-crank", "andrews", "driven-four-bar", "n-four-bar:2"])
def test_the_whole_catalogue_can_be_compared(name):
    study = symgen.compare(name, ["direct-correction"], repeat=1)
    best = min(row.error for row in study.rows if row.error is not None)
    assert best < 1e-6
    assert study.estimated_error < 1e-8


def test_pairs_that_do_not_suit_are_left_out():
    study = symgen.compare("four-bar", ["lagrange", "ggl"], ["rk4", "radau5"], [1e-2], [1e-6], until=0.2, repeat=1)
    assert [(r.method, r.integrator) for r in study.rows] == [
        ("lagrange", "rk4"),
        ("lagrange", "radau5"),
        ("ggl", "radau5"),
    ]
    with pytest.raises(InputError, match=r"one that solves a form of ggl \(index-2\)"):
        symgen.compare("four-bar", ["ggl"], ["rk4"], until=0.2)


def test_a_method_gets_its_own_integrator_where_the_usual_ones_do_not_suit():
    study = symgen.compare("four-bar", ["generalized-alpha"], steps=[1e-2], until=0.1, repeat=1)
    assert [r.integrator for r in study.rows] == ["generalized-alpha"]


def test_without_methods_the_six_of_the_source_are_compared():
    assert module._named((), module.DEFAULT_METHODS, ()) == module.DEFAULT_METHODS
    assert len(module._named(("all",), (), symgen.methods.METHODS.names)) == len(symgen.methods.METHODS.names) > 15

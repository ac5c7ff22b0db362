"""Comparisons: rows, their errors and costs, journals, and what is refused."""

import csv
import json
from dataclasses import replace

import numpy as np
import pytest
from support.emitted import mechanism_of
from support.runs import interrupt

import symgen
import symgen.derive.methods
from symgen.base.errors import InputError, SimulationError
from symgen.cli._comparison_tables import show_study
from symgen.study.comparison import combinations
from symgen.study.comparison import compare_models as whole
from symgen.study.comparison import model_comparison as module
from symgen.study.comparison.combinations import Combinations
from symgen.study.journal import Journal
from symgen.study.report.kinds.comparison_report import comparison_report

ROW_KEYS = {
    *("method", "integrator", "step", "rtol", "status", "reason", "error", "run_seconds", "run_seconds_spread"),
    *("evaluations", "position_violation_max", "velocity_violation_max", "energy_drift_max", "below_reference"),
    *("coordinates", "variant", "beyond_limits", "relative_error", "velocity_error", "reaction_error"),
    *("law", "transitions", "impacts", "dissipated", "creep", "gradient_error", "gradient_seconds"),
    *("adjoint_error", "adjoint_seconds", "differences_error", "differences_seconds"),
    *("warnings", "iterations", "run_seconds_median", "wall_seconds", "disturbed", "relative_violation"),
    *("run_seconds_low", "run_seconds_high", "cost_ratio_low", "cost_ratio_high", "cost_ratio", "cost_ratio_spread"),
    *(f"{level}_violation_{kind}" for level in ("position", "velocity") for kind in ("rms", "final")),
    *(f"acceleration_violation_{kind}" for kind in ("max", "rms", "final")),
}


@pytest.fixture(scope="module")
def study():
    return symgen.compare(
        "four-bar", ["baumgarte", "direct-correction", "lagrange"], ["rk4", "dop853"], [8e-3, 4e-3], until=1.0, repeat=1
    )


@pytest.mark.slow
def test_rows_come_in_order(study):
    found = [(r.method, r.integrator, r.step or r.rtol) for r in study.rows]
    one = [("rk4", 8e-3), ("rk4", 4e-3), ("dop853", 1e-6), ("dop853", 1e-8), ("dop853", 1e-10)]
    assert found == [(m, *rest) for m in ("baumgarte", "direct-correction", "lagrange") for rest in one]
    assert not study.interrupted and not study.failed


@pytest.mark.slow
def test_json_is_the_contract(study):
    found = study.to_json()
    assert json.loads(json.dumps(found, allow_nan=False)) == json.loads(json.dumps(found))
    assert set(found) == {"mechanism", "digest", "until", "reference", "interrupted", "rows", "at"}
    assert set(found["reference"]) == {"how", "estimated_error", "note", "length", "speed", "reaction"}
    for row in found["rows"]:
        assert set(row) == ROW_KEYS | {"on_front"}
        assert (row["step"] is None) != (row["rtol"] is None)


@pytest.mark.slow
def test_errors_shrink_with_the_fourth_power_of_the_step_and_follow_the_tolerance(study):
    for method in ("baumgarte", "direct-correction", "lagrange"):
        coarse, fine = (r.error for r in study.rows if r.method == method and r.integrator == "rk4")
        assert 3.5 < np.log2(coarse / fine) < 5.0
        errors = [r.error for r in study.rows if r.method == method and r.rtol]
        assert errors[0] > errors[1] > errors[2] > 0.0 and errors[2] < 1e-7


@pytest.mark.slow
def test_a_failed_run_stays_a_row():
    """Constraints drift without correction: on the way past a singular position rounding would decide how far."""
    study = symgen.compare("four-bar", ["lagrange", "direct-correction"], ["rk4"], [2e-2], until=3.0, repeat=1)
    wrong, right = study.rows
    assert wrong.status == "failed" and " at t = " in wrong.reason
    assert right.status == "ok" and max(right.error, wrong.error) < 1e-3
    assert not study.failed


@pytest.mark.by_turns(4)
@pytest.mark.slow
def test_a_run_that_exceeds_its_limits_is_measured_to_its_end(capsys):
    """The standard method at the settings of the source: one that stopped would leave all rows without a ratio."""
    arguments = ["slider-crank", ["lagrange", "direct-correction"], ["rk4"], [1e-3]]
    study = symgen.compare(*arguments, until=5.0, repeat=1)
    beyond, right = study.rows
    assert beyond.status == "failed" and beyond.reason.startswith("the position violation |Phi| exceeds max_violation")
    assert beyond.beyond_limits and beyond.ended and not right.beyond_limits
    free = symgen.compare(*arguments, until=5.0, repeat=1, max_violation=1.0).rows[0]
    assert free.status == "ok" and not free.beyond_limits and free.cost_ratio == beyond.cost_ratio == 1.0
    measures = ("error", "position_violation_max", "velocity_violation_rms", "energy_drift_max", "evaluations")
    assert [getattr(beyond, name) for name in measures] == [getattr(free, name) for name in measures]
    assert right.cost_ratio > 0.0 and right.cost_ratio_spread is None
    assert len(study.traces[0].t) == len(study.traces[1].t)
    show_study(study)
    text = " ".join(capsys.readouterr().out.split())
    assert "failed +" in text and "+ exceeded a limit of a run" in text and beyond.reason in text
    notes = [note for table in comparison_report([study]).sections[0].parts[-1].tables for note in table.notes]
    assert any(note.startswith("+ exceeded a limit of a run") for note in notes)


@pytest.mark.slow
def test_a_run_that_fails_without_limits_too_has_no_error():
    """A step beyond the stability of the correction: the numbers grow until they are none."""
    study = symgen.compare("four-bar", ["baumgarte:alpha=500:beta=500"], ["rk4"], [2e-2], until=3.0, repeat=1)
    row = study.rows[0]
    assert row.status == "failed" and row.error is None and not row.beyond_limits and study.failed


def test_rows_below_the_reference_are_marked(monkeypatch):
    real = module.reference_motion
    monkeypatch.setattr(module, "reference_motion", lambda *a, **k: replace(real(*a, **k), estimated_error=1e-3))
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
        ({"steps": [-1.0]}, "step: expected a finite number above 0"),
        ({"until": float("nan")}, "until: expected a finite number above 0, got nan"),
        ({"repeat": 0}, "repeat: expected a whole number from 1 to 1000, got 0"),
        ({"options": {"lagrange.alpha": 1.0}}, "option lagrange.alpha"),
    ],
)
def test_what_is_wrong_is_refused_before_anything_runs(arguments, sentence, monkeypatch):
    def never(*_, **__):
        raise AssertionError("something was run")

    monkeypatch.setattr(module, "time_in_turns", never)
    monkeypatch.setattr(module, "reference_motion", never)
    with pytest.raises(InputError) as caught:
        symgen.compare("four-bar", **arguments)
    assert sentence in str(caught.value)


def test_an_integrator_told_to_keep_its_steps_runs_at_those_asked_for():
    """Else each tolerance gave the same run with the mechanism's own step, and the steps counted for nothing."""
    changes = {"options": {"integrator.adaptive": "False"}, "until": 0.2, "output_step": 0.04, "repeat": 1}
    study = symgen.compare("pendulum", ["lagrange"], ["dopri5"], [0.04, 0.02], **changes)
    assert [(row.step, row.rtol) for row in study.rows] == [(0.04, None), (0.02, None)]
    assert study.rows[0].error > 10.0 * study.rows[1].error > 0.0


@pytest.mark.slow
def test_rows_warn_of_what_single_runs_warn_of():
    study = symgen.compare("pendulum", ["baumgarte", "lagrange"], ["euler"], [0.5, 0.1], until=1.0, repeat=1)
    for row in study.rows:
        single = symgen.simulate("pendulum", method=row.method, integrator="euler", step=row.step, until=1.0)
        assert row.warnings == single.warnings
    told = [row for row in study.rows if any("exceeds 0.4 s" in text for text in row.warnings)]
    assert [(row.method, row.step) for row in told] == [("baumgarte", 0.5)] and not study.common_warnings
    table = comparison_report([study]).sections[0].parts[-1].tables[0]
    assert [note for note in table.notes if "exceeds 0.4 s" in note and note.startswith("baumgarte, euler, step 0.5 s")]


@pytest.mark.slow
def test_what_the_start_warns_of_is_in_every_row_and_said_once(capsys):
    rod = {"mass": 1.0, "inertia": 0.1, "position": [1.5, 0.0], "points": {"end": [-0.5, 0.0]}}
    pin = {"type": "revolute", "between": ["ground", "rod"], "at": [[0.0, 0.0], "end"]}
    model = symgen.load(mechanism_of({"mechanism": {"name": "swing"}, "bodies": {"rod": rod}, "joints": {"pin": pin}}))
    study = symgen.compare(model, ["lagrange", "baumgarte"], ["rk4"], [1e-2], until=0.1, repeat=1)
    said = model.simulate(method="lagrange", step=1e-2, until=0.1).warnings
    assert len(said) == 1 and study.common_warnings == said
    show_study(study)
    text = " ".join(capsys.readouterr().out.split())
    assert text.count(" ".join(said[0].split())) == 1 and "every run: " in text


def test_an_interrupted_study_keeps_its_rows(monkeypatch):
    interrupt(monkeypatch, module, "time_in_turns", 3)
    study = symgen.compare("pendulum", ["direct-correction"], ["rk4"], [4e-2, 2e-2, 1e-2, 5e-3], until=0.5, repeat=1)
    assert study.interrupted and len(study.rows) == 2
    assert study.to_json()["reference"]["how"] == "Jacobi's elliptic functions"


def test_progress_counts_rows_and_compilation(tmp_path):
    """A pair of method and integrator is compiled once, before its first row; rows of a journal need no code."""

    def reached(methods):
        seen = []
        arguments = {"until": 0.2, "repeat": 1, "progress": lambda *a: seen.append(a)}
        with Journal(tmp_path / "rows.journal") as journal:
            symgen.compare("pendulum", methods, ["rk4", "euler"], [2e-2, 1e-2], **arguments, journal=journal)
        return seen

    share, first = module.PREPARATION, reached(["lagrange"])
    total = 5.0 + 2.0 * share
    assert first == [
        ("reference", 0.0, total),
        ("compiling lagrange, rk4", 1.0, total),
        *(("lagrange, rk4", 1.0 + share + i, total) for i in (0.0, 1.0)),
        ("compiling lagrange, euler", 3.0 + share, total),
        *(("lagrange, euler", 3.0 + 2.0 * share + i, total) for i in (0.0, 1.0)),
    ]
    again = reached(["lagrange", "baumgarte"])
    assert again[0] == ("compiling baumgarte, rk4", 5.0, 9.0 + 2.0 * share)
    assert again[-1] == ("baumgarte, euler", 8.0 + 2.0 * share, 9.0 + 2.0 * share)


@pytest.mark.by_turns(2)
@pytest.mark.slow
def test_rows_as_a_file_and_as_a_frame(study, tmp_path):
    with study.save(tmp_path / "rows.csv").open(newline="") as file:
        rows = list(csv.DictReader(file))
    assert len(rows) == len(study.rows)
    assert rows[0]["mechanism"] == "four-bar" and float(rows[0]["error"]) == study.rows[0].error
    assert rows[0]["rtol"] == ""
    assert list(study.to_dataframe()["error"]) == [r.error for r in study.rows]
    with pytest.raises(InputError, match=r"a file ending in \.csv"):
        study.save(tmp_path / "rows.txt")
    assert "<html" in study.save(tmp_path / "report.html").read_text(encoding="utf-8")
    assert study.save(tmp_path / "report.md").read_text(encoding="utf-8").startswith("# ")
    assert len(study.plot(over="evaluations").figure.axes) == 1


@pytest.mark.by_turns(4)
@pytest.mark.slow
@pytest.mark.parametrize("name", ["pendulum", "four-bar", "slider-crank", "andrews", "driven-four-bar", "n-four-bar:2"])
def test_the_whole_catalogue_can_be_compared(name):
    study = symgen.compare(name, ["direct-correction"], repeat=1)
    best = min(row.error for row in study.rows if row.error is not None)
    assert best < 1e-6
    assert study.estimated_error < 1e-8


@pytest.mark.slow
def test_pairs_that_do_not_suit_are_left_out():
    study = symgen.compare("four-bar", ["lagrange", "ggl"], ["rk4", "radau5"], [1e-2], [1e-6], until=0.2, repeat=1)
    assert [(r.method, r.integrator) for r in study.rows] == [
        ("lagrange", "rk4"),
        ("lagrange", "radau5"),
        ("ggl", "radau5"),
    ]
    with pytest.raises(InputError, match=r"one that solves a form of ggl \(index-2\)"):
        symgen.compare("four-bar", ["ggl"], ["rk4"], until=0.2)
    own = symgen.compare("four-bar", ["generalized-alpha"], steps=[1e-2], until=0.1, repeat=1)
    assert [r.integrator for r in own.rows] == ["generalized-alpha"]


@pytest.mark.slow
def test_methods_of_all_that_no_integrator_suits_are_left_out(cli):
    code, out, err = cli(
        "compare", "pendulum", "--methods", "all", "--integrators", "rattle", "--until", "0.01", "--json"
    )
    assert code == 0 and {row["method"] for row in json.loads(out)["rows"]} == {"rattle"}
    (line,) = (line for line in err.splitlines() if "solve no form of" in line)
    assert "lagrange" in line and "rattle" not in line and line.startswith("symgen: left out, ")
    with pytest.raises(InputError, match=r"one that solves a form of ggl \(index-2\)"):
        symgen.compare("pendulum", ["all", "ggl"], ["rk4"], until=0.01)


def test_without_methods_the_six_of_the_source_are_compared():
    assert combinations._select_names((), combinations.DEFAULT_METHODS, ()) == combinations.DEFAULT_METHODS
    assert (
        len(combinations._select_names(("all",), (), symgen.derive.methods.METHODS.names))
        == len(symgen.derive.methods.METHODS.names)
        > 15
    )


@pytest.mark.slow
def test_violations_at_three_levels_are_those_of_the_run(study):
    """The same run by `simulate` with the same outputs."""
    row = next(r for r in study.rows if (r.method, r.integrator, r.step) == ("baumgarte", "rk4", 8e-3))
    result = symgen.load("four-bar").simulate(
        method="baumgarte", integrator="rk4", step=8e-3, until=1.0, output_step=0.01
    )
    for level in ("position", "velocity", "acceleration"):
        values = result.violations[level]
        assert getattr(row, f"{level}_violation_rms") == pytest.approx(np.sqrt(np.mean(values**2)), rel=1e-9)
        assert getattr(row, f"{level}_violation_final") == values[-1]
        assert getattr(row, f"{level}_violation_max") >= values.max()
    assert row.evaluations == result.evaluations and row.iterations == result.iterations


def test_cost_ratios_are_to_lagrange_with_the_same_setting(study):
    for row in study.rows:
        assert row.cost_ratio == 1.0 if row.method == "lagrange" else 0.2 < row.cost_ratio < 5.0
    alone = symgen.compare("pendulum", ["baumgarte"], ["rk4"], [1e-2], until=0.2, repeat=1)
    assert alone.rows[0].cost_ratio is None


@pytest.mark.slow
def test_a_ratio_lies_in_its_interval_and_the_spread_covers_it():
    base, other = symgen.compare("pendulum", ["lagrange", "baumgarte"], ["rk4"], [1e-2], until=1.0, repeat=7).rows
    assert (base.cost_ratio, base.cost_ratio_spread) == (1.0, None)
    low, ratio, high = other.cost_ratio_low, other.cost_ratio, other.cost_ratio_high
    assert 0.0 < low <= ratio <= high and other.cost_ratio_spread == max(high - ratio, ratio - low)
    assert 0.0 < other.run_seconds_low <= other.run_seconds <= other.run_seconds_high


@pytest.mark.slow
def test_two_runs_give_the_same_errors_to_the_last_digit(study):
    again = symgen.compare("four-bar", ["baumgarte", "lagrange"], ["rk4"], [8e-3, 4e-3], until=1.0, repeat=1)
    for one in again.rows:
        first = next(r for r in study.rows if (r.method, *r.setting) == (one.method, *one.setting))
        clock = {name for name in ROW_KEYS if name.startswith(("run_seconds", "cost_ratio"))}
        clock |= {"wall_seconds", "disturbed"}
        assert all(getattr(one, name) == getattr(first, name) for name in ROW_KEYS - clock)


def test_curves_go_with_their_rows(study):
    for row, trace in zip(study.rows, study.traces, strict=True):
        assert trace.t[0] == 0.0 and trace.t[-1] == 1.0
        assert max(trace.error) == pytest.approx(row.error, rel=1e-4)
        assert max(trace.position) <= row.position_violation_max * 1.0001
        # nothing but gravity acts, so the balance holds without work
        total = np.array(trace.kinetic) + np.array(trace.potential)
        assert np.abs(total - total[0]).max() < 0.1
        assert len({len(curve) for curve in vars(trace).values()}) == 1


def test_a_journal_gives_rows_back_and_computes_only_what_is_missing(tmp_path, monkeypatch):
    arguments = {"methods": ["lagrange", "direct-correction"], "integrators": ["rk4"], "steps": [2e-2, 1e-2]}
    path = tmp_path / "rows.journal"
    real, calls = module.time_in_turns, []
    with Journal(path) as journal:
        first = symgen.compare("pendulum", **arguments, until=0.5, repeat=1, journal=journal)
    monkeypatch.setattr(module, "time_in_turns", lambda *a: calls.append(1) or real(*a))
    monkeypatch.setattr(module, "reference_motion", None)  # it is in the journal as well
    arguments["steps"] = [2e-2, 1e-2, 5e-3]
    with Journal(path) as journal:
        second = symgen.compare("pendulum", **arguments, until=0.5, repeat=1, journal=journal)
    assert len(calls) == 2
    kept = [row for row in second.rows if row.step != 5e-3]
    assert [(r.error, r.run_seconds) for r in kept] == [(r.error, r.run_seconds) for r in first.rows]
    assert second.how == first.how and second.estimated_error == first.estimated_error
    assert [t for t, r in zip(second.traces, second.rows, strict=True) if r.step != 5e-3] == list(first.traces)


def test_a_journal_tells_shapes_apart():
    """Run times are those of the shape that was asked for."""
    journal, arguments = Journal(), {"methods": ["lagrange"], "integrators": ["rk4"], "steps": [1e-2]}
    for shape in ("straight", "looped", "straight"):
        symgen.compare("pendulum", **arguments, until=0.05, repeat=1, journal=journal, shape=shape)
    assert len(journal) == 3  # a row each, and the reference


@pytest.mark.parametrize(
    ("name", "start"), [("pendulum", {"bob.vy": -2.0}), ("n-four-bar:1", {"vertical0.omega": -2.0})]
)
def test_errors_are_to_the_motion_from_the_start_that_is_asked_for(name, start):
    """Formulas know the start of the catalogue alone: distances to it were of the size of the mechanism."""
    asked = {"methods": ["direct-correction"], "integrators": ["dop853"], "rtols": [1e-10]}
    found = symgen.compare(name, **asked, until=0.3, repeat=1, start=start)
    assert found.rows[0].error < 1e-7
    assert "independently derived" in found.how
    times = np.linspace(0.0, 0.3, 4)
    mechanism, settings = symgen.load(name).mechanism, symgen.Settings(start=start)
    assert module.compute_cell_ahead(module.ReferenceTask(mechanism, settings, times))["how"] == found.how


@pytest.mark.slow
def test_failed_rows_come_back_from_a_journal_as_they_were(tmp_path):
    arguments = ["four-bar", ["lagrange"], ["rk4"], [2e-2]]
    studies = []
    for _ in range(2):
        with Journal(tmp_path / "rows.journal") as journal:
            studies.append(symgen.compare(*arguments, until=3.0, repeat=1, journal=journal))
    assert repr(studies[0]) == repr(studies[1])
    assert studies[0].rows[0].status == "failed"


def test_without_a_reference_rows_stay_and_the_study_says_why(monkeypatch):
    def none(*_, **__):
        raise SimulationError("no way through")

    monkeypatch.setattr(module, "reference_motion", none)
    study = symgen.compare("pendulum", ["lagrange"], ["rk4"], [1e-2], until=0.5, repeat=1)
    assert study.how == "none" and "no way through" in study.note
    assert study.rows[0].status == "ok" and study.rows[0].error is None and study.rows[0].run_seconds > 0.0
    assert study.to_json()["reference"]["estimated_error"] is None


def test_several_models_are_checked_before_anything_runs(monkeypatch):
    monkeypatch.setattr(module, "time_in_turns", None)
    with pytest.raises(InputError, match="did you mean 'four-bar'"):
        whole.compare_all(["pendulum", "four-bra"], symgen.Settings(until=0.1), Combinations())


@pytest.mark.by_turns(2)
@pytest.mark.slow
def test_preparation_on_several_processes_changes_no_row(study, monkeypatch, tmp_path):
    """Everything goes to processes of its own, the first task too; the cache is a new one, so that they have work."""
    monkeypatch.setenv("SYMGEN_CACHE_DIR", str(tmp_path / "cache"))
    monkeypatch.setattr(whole, "PATIENCE", 0.0)
    seen = []
    again = symgen.compare(
        *("four-bar", ["baumgarte", "lagrange"], ["rk4"], [8e-3, 4e-3], (), 1.0, 1),
        progress=lambda *a: seen.append(a),
        jobs=2,
    )
    wanted = [r for r in study.rows if r.integrator == "rk4" and r.method != "direct-correction"]
    assert [(r.method, r.step, r.error) for r in again.rows] == [(r.method, r.step, r.error) for r in wanted]
    assert again.how == study.how and again.estimated_error == study.estimated_error
    assert any(what == "preparing: 1 of 3" for what, _, _ in seen)
    shares = [reached / total for _, reached, total in seen]
    assert shares == sorted(shares) and shares[-1] < 1.0


@pytest.mark.slow
def test_beams_are_compared_with_two_formulations_that_agree():
    """Errors of rk4 fall by sixteen with half the step; Radau's run, which shares no scheme with either, is on it."""
    beam = {"start": [0.0, 0.0], "end": [1.0, 0.0], "elements": 3, "clamp": "ground", "damping": 1e-4}
    beam |= {"axial": 1e3, "bending": 20.0, "mass": 1.0, "rotary": 1e-2}
    description = {"mechanism": {"name": "beam", "gravity": [0.0, -9.81]}, "beams": {"rod": beam}}
    found = symgen.compare(
        mechanism_of(description), ["lagrange"], ["rk4", "radau5"], [2e-3, 1e-3], [1e-9], until=0.5, repeat=1
    )
    assert found.how.startswith("direct-correction with dop853") and found.estimated_error <= 1e-10
    assert [row.status for row in found.rows] == ["ok"] * 3
    coarse, fine, radau = (row.error for row in found.rows)
    assert 12.0 < coarse / fine < 20.0 and radau <= 1e-7

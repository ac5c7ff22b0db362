"""``symgen stress`` in-process: what it prints where, its files, and its exit codes."""

import csv
import json

import pytest

from symgen.study.stress import study as module
from symgen.study.stress.stress_rows import Stress, StressRow

FEW = ("stress", "pendulum", "--cases", "gravity", "--methods", "lagrange,auto", "--quick", "--jobs", "1")


@pytest.mark.slow
def test_tables_json_csv_and_reports(cli, tmp_path):
    journal = tmp_path / "journal.jsonl"
    code, out, err = cli(*FEW, "--resume", journal)
    assert code == 0 and all(" of " in line for line in err.splitlines())  # nothing but progress
    assert "4 cells" in out and "auto reports success with an error above 0.001 of the length in no cell of 2." in out
    kept = journal.read_bytes()
    files = ("--csv", tmp_path / "cells.csv", "-o", tmp_path / "stress.html")
    code, out, err = cli(*FEW, "--journal", journal, "--json", *files)
    assert code == 0 and journal.read_bytes() == kept
    found = json.loads(out)
    assert found["cells"] == 4 and found["outcomes"]["ok"] == 4 and found["false_successes"] == []
    with (tmp_path / "cells.csv").open(newline="") as handle:
        assert len(list(csv.DictReader(handle))) == 4
    page = (tmp_path / "stress.html").read_text()
    # the sketch of the mechanism, and the map
    assert "Map of methods and cases" in page and page.count("data:image/svg+xml") == 2
    assert "symgen stress pendulum --cases gravity --methods lagrange,auto --quick --output stress.html" in page
    assert "--resume" not in page and str(tmp_path) not in page
    code, _, _ = cli(*FEW, "--resume", journal, "-o", tmp_path / "stress.md")
    assert code == 0 and list((tmp_path / "stress-files").glob("map-pendulum.*"))


def wrong(method):
    return StressRow(
        *("four-bar", "gravity", "1 m/s^2", (1.0,), method, "rk4", 1e-3, 1.0, "inaccurate", 0.5, 0.1, 1e-9, "ok", None),
        *(4000, 1e-12, 1e-12, 0.0, "", "", True),
    )


@pytest.mark.parametrize(("method", "code"), [("auto", 1), ("lagrange", 0)])
def test_a_false_success_of_auto_is_a_failure(cli, monkeypatch, method, code):
    study = Stress(("four-bar",), (wrong(method),), (), (), ())
    monkeypatch.setattr(module, "stress", lambda *a, **k: study)
    found, _, err = cli("stress", "--jobs", "1")
    assert found == code
    assert ("auto reports success with an error above 1e-3 of the length in 1 cell" in err) == bool(code)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("further", "says"),
    [
        ((), "with --resume FILE they would have been stored"),
        (("--resume", "cells"), "the same command continues after them"),
    ],
)
def test_an_interrupted_study_shows_what_is_done(cli, monkeypatch, tmp_path, further, says):
    study = Stress(("four-bar",), (wrong("lagrange"),), (), (), (), interrupted=True)
    monkeypatch.setattr(module, "stress", lambda *a, **k: study)
    monkeypatch.chdir(tmp_path)
    code, out, err = cli("stress", "--json", "-o", tmp_path / "stress.html", *further)
    assert code == 130 and json.loads(out)["interrupted"]
    assert f"interrupted; the cells that were done are shown; {says}" in err
    assert "This study was interrupted" in (tmp_path / "stress.html").read_text()


def test_the_whole_catalogue_and_a_time_of_compilation(cli, monkeypatch):
    from symgen.describe import catalogue

    asked = []

    def study(*arguments, **limits):
        asked.append(arguments)
        return Stress(arguments[0], (), (), (), ())

    monkeypatch.setattr(module, "stress", study)
    code, _, _ = cli("stress", "four-bar", "n-four-bar:3", "--catalogue", "--compilation", "36", "--jobs", "1")
    assert code == 0 and set(asked[0][0]) == {*catalogue.names(), "n-four-bar:3"} and asked[0][-1] == 36.0
    assert len(asked[0][0]) == len(catalogue.names()) + 1, "four-bar is run once"
    code, out, err = cli("stress", "--compilation", "0")
    assert code == 2 and out == "" and "--compilation" in err and len(asked) == 1

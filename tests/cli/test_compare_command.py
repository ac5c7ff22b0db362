"""``symgen compare`` as a command: reports, journals, interruption and what is wrong."""

import json
import os
import re
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest
from support.runs import interrupt

from symgen.api import load
from symgen.base.errors import SimulationError
from symgen.study.comparison import compare_models as whole
from symgen.study.comparison import model_comparison as module
from symgen.study.journal import Journal

SMALL = ("--methods", "lagrange,direct-correction", "--integrators", "rk4", "--steps", "0.02,0.01", "--until", "0.5")
#: Rows that exceed no limit, so that each is timed once.
WITHIN = ("--methods", "velocity-projection,direct-correction", *SMALL[2:])


@pytest.mark.by_turns(4)
@pytest.mark.slow
@pytest.mark.parametrize("ending", ["html", pytest.param("md", marks=pytest.mark.slow)])
def test_a_report_is_written_beside_the_table(cli, tmp_path, ending):
    path = tmp_path / f"report.{ending}"
    code, out, err = cli("compare", "pendulum", *SMALL, "--repeat", "2", "-o", path, "--csv", tmp_path / "rows.csv")
    assert code == 0 and "error [m]" in out and "time / lagrange" in out
    assert err == f"symgen: wrote {path}\n"
    text = path.read_text(encoding="utf-8")
    assert "Error against run time: pendulum" in text and "Jacobi" in text
    # the command that makes it again, without the folders of this machine
    steps = "--steps 0.02,0.01 --until 0.5"
    command = f"symgen compare pendulum --methods lagrange,direct-correction --integrators rk4 {steps} --repeat 2"
    assert f"{command} --output report.{ending} --csv rows.csv" in text
    assert str(tmp_path) not in text
    assert len((tmp_path / "rows.csv").read_text().splitlines()) == 5


@pytest.mark.slow
def test_json_stays_alone_on_standard_output(cli, tmp_path):
    arguments = (*SMALL[:4], "--steps", "0.01", "--until", "0.5", "--repeat", "1")
    code, out, _ = cli("compare", "pendulum", *arguments, "-o", tmp_path / "report.html", "--json")
    found = json.loads(out)
    assert code == 0 and len(found["rows"]) == 2
    assert all(row["cost_ratio"] is not None and row["acceleration_violation_rms"] >= 0.0 for row in found["rows"])
    assert all(row["run_seconds_spread"] is None and row["cost_ratio_spread"] is None for row in found["rows"])


@pytest.mark.by_turns(2)
@pytest.mark.slow
def test_one_run_has_no_spread(cli, tmp_path):
    report = tmp_path / "report.html"
    for repeat, single in (("1", True), ("2", False)):
        code, out, _ = cli("compare", "pendulum", *SMALL, "--repeat", repeat, "-o", report)
        assert code == 0 and ("one run: no spread" in out) is single
        text = report.read_text(encoding="utf-8")
        assert ("one run: no spread" in text) is single and bool(re.search(r"\d ± \d", text)) is not single


def test_a_file_that_is_no_journal_is_refused_and_left_alone(cli, tmp_path):
    path = tmp_path / "notes.txt"
    path.write_text("my notes\n")
    code, _, err = cli("compare", "pendulum", *SMALL, "--resume", path)
    assert code == 2 and "expected a journal of symgen" in err
    assert path.read_text() == "my notes\n"


@pytest.mark.by_turns(2)
@pytest.mark.slow
def test_an_interrupted_study_writes_the_report_of_what_is_done(cli, tmp_path, monkeypatch):
    calls = interrupt(monkeypatch, module, "time_in_turns", 3)
    report, journal = tmp_path / "report.html", tmp_path / "rows.journal"
    arguments = ("compare", "pendulum", *WITHIN, "--repeat", "1", "-o", report, "--json", "--journal", journal)
    code, out, err = cli(*arguments)
    assert code == 130 and "symgen: interrupted; the rows that were done are shown" in err
    assert len(json.loads(out)["rows"]) == 2 and json.loads(out)["interrupted"] is True
    assert "This study was interrupted: rows are missing." in report.read_text()
    code, out, _ = cli(*arguments)
    assert code == 0 and len(json.loads(out)["rows"]) == 4 and len(calls) == 5
    assert "interrupted" not in report.read_text()


def test_rows_of_an_earlier_study_are_shown_where_preparing_is_interrupted(cli, tmp_path, monkeypatch):
    arguments = ("compare", "pendulum", *WITHIN, "--repeat", "1", "--json", "--resume", tmp_path / "rows.journal")

    def never(*_):
        return {}, True

    interrupt(monkeypatch, module, "time_in_turns", 3)
    first = json.loads(cli(*arguments, "--jobs", "1")[1])
    monkeypatch.setattr(whole, "run_cells", never)
    code, out, err = cli(*arguments, "--jobs", "2")
    assert code == 130 and "the rows that were done are shown" in err
    assert json.loads(out)["rows"] == first["rows"] and len(first["rows"]) == 2
    assert json.loads(out)["reference"] == first["reference"]


SCRIPT = """\
import signal, sys, time
from symgen.cli import main
signal.signal(signal.SIGINT, signal.default_int_handler)  # a shell's background jobs inherit it ignored
from symgen.study.comparison import model_comparison
real = model_comparison.time_in_turns
def slow(*arguments):
    found = real(*arguments)
    time.sleep(0.3)
    return found
model_comparison.time_in_turns = slow
sys.exit(main(sys.argv[1:]))
"""


def rows_of(path: Path) -> int:
    """Return how many cells a journal holds, a torn line not counted."""
    return max(0, path.read_bytes().count(b"\n") - 1) if path.exists() else 0


@pytest.mark.by_turns(2)
@pytest.mark.slow
@pytest.mark.parametrize("how", [pytest.param(signal.SIGKILL, marks=pytest.mark.slow), signal.SIGINT])
def test_killed_or_interrupted_and_resumed_no_row_is_lost_or_computed_twice(tmp_path, cli, how):
    journal = tmp_path / "rows.journal"
    arguments = ["compare", "pendulum", *SMALL, "--repeat", "1", "--journal", str(journal), "--json"]
    process = subprocess.Popen(
        [sys.executable, "-c", SCRIPT, *arguments], stdout=subprocess.PIPE, stderr=subprocess.PIPE, env=dict(os.environ)
    )
    deadline = time.monotonic() + 600
    while rows_of(journal) < 3 and process.poll() is None and time.monotonic() < deadline:  # the reference and two rows
        time.sleep(0.02)
    process.send_signal(how)
    _, err = process.communicate(timeout=600)
    assert process.returncode == (130 if how == signal.SIGINT else -signal.SIGKILL), err.decode()
    done = rows_of(journal)
    assert 3 <= done < 5
    with Journal(journal) as kept:
        before = {key: kept.get(key) for key in kept}
    code, out, _ = cli(*arguments)
    assert code == 0 and len(json.loads(out)["rows"]) == 4
    with Journal(journal) as kept:  # a second entry of a key would have been refused
        assert len(kept) == 5
        assert {key: kept.get(key) for key in before} == before
    assert rows_of(journal) == 5


@pytest.mark.slow
def test_why_there_is_no_reference_is_kept_for_those_who_go_on(cli, tmp_path, monkeypatch):
    def none(*arguments):
        raise SimulationError("nothing is near enough")

    monkeypatch.setattr(module, "reference_motion", none)
    report, journal = tmp_path / "report.html", tmp_path / "rows.journal"
    arguments = ("compare", "pendulum", *SMALL, "--repeat", "1", "--jobs", "1", "--json", "--journal", journal)
    arguments = (*arguments, "-o", report, "--start", "bob.vy=0.5")
    words = "there is no reference, so errors are unknown: nothing is near enough"
    for _ in range(2):
        code, out, err = cli(*arguments)
        assert code == 1 and words in err and json.loads(out)["reference"]["note"] == words
        assert "Start changed" in report.read_text() and "bob.vy = 0.5" in report.read_text()
        monkeypatch.setattr(module, "time_in_turns", none)  # nothing is run again


def test_the_sketch_at_the_head_of_a_report_is_where_runs_begin():
    from symgen.cli._report import sketches_at_start

    model, start = load("pendulum"), {"bob.x": 0.0, "bob.y": -1.0}
    assert sketches_at_start([model], {}, start) == {"pendulum": model.draw(start=start).svg}
    assert model.draw(start=start).svg != model.draw().svg

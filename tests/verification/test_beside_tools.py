"""Tables beside other tools: the fastest run within an error, from a record of runs that no other one beats."""

import json
from random import Random

from benchmarks import beside_tools
from benchmarks.beside_tools import KEPT, MECHANISMS, claims, closed_claims, fastest, front, tables


def row(setting, seconds, error):
    return {"setting": setting, "seconds": seconds, "error": error, "version": "1"}


def test_a_front_has_what_no_other_run_beats():
    rows = [row("a", 2.0, 1e-6), row("b", 1.0, 1e-3), row("c", 3.0, 1e-5), row("d", None, None), row("e", 4.0, 1e-9)]
    assert [run.setting for run in front(rows)] == ["b", "a", "e"]


def test_cells_are_least_times_within_the_error_and_what_was_not_measured_stays(tmp_path, monkeypatch):
    monkeypatch.setattr("benchmarks.records.FOLDER", tmp_path)
    short, long = tables()
    assert all(set(row[1:]) == {KEPT} for row in short.measured()) and not list(claims())
    assert not list(closed_claims())
    runs = {
        ("four-bar", "symgen"): [
            ("joint lagrange, dop853 1e-07", 2e-4, 5e-7),
            ("joint lagrange, picard 1e-09", 4e-4, 1e-10),
        ],
        ("four-bar", "casadi"): [("RK4 through gcc", 5e-4, 8e-7)],
        ("four-bar", "exudyn"): [("generalised-alpha", 1e-3, 1e-4)],
        ("four-bar-peers", "symgen"): [("joint lagrange, picard 1e-10", 1e-4, 1e-10), ("dop853", 3e-4, 1e-11)],
        ("four-bar-peers", "heyoka"): [("1e-11", 6e-4, 1e-12)],
    }
    lines = [{"mechanism": name, "tool": tool, "version": "1", "runs": r} for (name, tool), r in runs.items()]
    (tmp_path / "beside_tools.jsonl").write_text("\n".join(map(json.dumps, lines)), encoding="utf-8")
    assert short.measured()[0] == ["`four-bar`", "0.2 ms", "0.5 ms (2.5)", "not reached", KEPT]
    assert long.measured()[1][2:4] == [KEPT, "0.5 ms (2.5; `RK4 through gcc`)"]
    assert fastest("four-bar", "symgen", 1e-9).setting == "joint lagrange, picard 1e-09"
    assert list(claims()) == ["needs 0.100 ms for a four-bar, heyoka 0.600 ms."]
    monkeypatch.setattr(beside_tools, "rows", lambda model, only: iter([row(only, 1.0, 7e-10)]))
    stored = {"mechanism": "four-bar", "tool": "symgen", "runs": [("dop853", 1.0, 1.2e-9)]}
    assert [pair.agree for pair in beside_tools.again(stored, Random(1))] == [False]


def test_sentences_have_widths_and_times_with_closed_joints(tmp_path, monkeypatch):
    monkeypatch.setattr("benchmarks.records.FOLDER", tmp_path)
    runs = [["direct-correction, dop853 1e-06", 1e-4, 2e-6], ["direct-correction, dop853 1e-07", 2.5e-4, 2e-7]]
    lines = [{"mechanism": name, "tool": "symgen", "width": 8, "closed": runs, "runs": runs} for name in MECHANISMS]
    (tmp_path / "beside_tools.jsonl").write_text("\n".join(map(json.dumps, lines)), encoding="utf-8")
    assert list(closed_claims()) == [
        "symgen's vectors have 8 numbers, with AVX2 4",
        "With `direct-correction`, joints closed to rounding, symgen takes 0.25, 0.25, 0.25 and 0.25 ms",
    ]

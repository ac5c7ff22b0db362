"""Run times at equal errors: cells are ratios of a study, and a file of rows gives the table again."""

import json
import sys

from benchmarks import equal_error


def line(ratio):
    """Return the line of a study in which every method but coordinate partitioning has this ratio to `lagrange`."""
    at = []
    for error in equal_error.ERRORS:
        for method in equal_error.METHODS:
            own = {"lagrange": 1.0, "coordinate-partitioning": None}.get(method, ratio)
            quartiles = {"ratio_low": own and 0.9 * own, "ratio_high": own and 1.1 * own}
            label = equal_error.label(method)
            at.append({"error": 4.0 * error, "method": label, "seconds": 2e-3, "ratio": own, **quartiles})
    return {"mechanism": "four-bar", "integrator": "rk4", "at": at}


def test_a_file_of_rows_gives_the_table(tmp_path, monkeypatch, capsys):
    rows = tmp_path / "rows.jsonl"
    rows.write_text(json.dumps(line(0.5)) + "\n", encoding="utf-8")
    monkeypatch.setattr(sys, "argv", ["equal_error", "--seconds", "0", "-o", str(rows)])
    equal_error.main()
    table = capsys.readouterr().out.splitlines()
    assert len(table) == 2 + len(equal_error.ERRORS)
    cells = [cell.strip() for cell in table[2].split("|")[1:-1]]
    assert cells[:4] == ["`four-bar`", "`rk4`", "1e-06", "2"]
    assert cells[4:] == ["0.50 (0.45-0.55)" if m != "coordinate-partitioning" else "" for m in equal_error.METHODS[1:]]


def test_a_study_has_a_time_of_every_method_at_both_errors(monkeypatch):
    monkeypatch.setitem(equal_error.MECHANISMS, "four-bar", (4.0, 2.0, 1.6e-2))
    monkeypatch.setattr(equal_error, "METHODS", ("lagrange", "direct-correction:weight=mass"))
    measured = equal_error.examine(("four-bar", "rk4"))
    assert len(measured["at"]) == 4 and all(time["ratio"] > 0.0 for time in measured["at"])
    rows = list(equal_error.rows([measured]))
    assert len(rows) == 2 and all(row[-1].count("-") == 1 for row in rows)

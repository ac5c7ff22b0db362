"""The tables of the pages on stiff and extreme cases and on findings, from studies in JSON."""

import json

from report.made import stress_row

from benchmarks import comparison_tables
from benchmarks.stress_tables import main, studied
from symgen.study.stress.stress_rows import Stress


def row(model, method, outcome, error):
    return stress_row(model, method, outcome, error, family="gravity", case="1 m/s^2")


def test_several_studies_are_one_and_what_stands_in_each_counts_once(tmp_path, capsys):
    common = row("-", "lagrange", "ok", 1e-9)
    studies = {
        "pendulum": (common, row("pendulum", "lagrange", "inaccurate", 0.5), row("pendulum", "auto", "ok", 1e-9)),
        "four-bar": (common, row("four-bar", "lagrange", "ok", 1e-9)),
    }
    for name, rows in studies.items():
        study = Stress((name,), rows, (), (), ())
        (tmp_path / f"{name}.json").write_text(json.dumps(study.to_json()), encoding="utf-8")
    paths = [tmp_path / f"{name}.json" for name in studies]
    found = studied(paths)
    assert found.models == ("pendulum", "four-bar") and set(found.rows) == {
        r for rows in studies.values() for r in rows
    }
    assert [r.method for r in found.false_successes] == ["lagrange"]
    picture = tmp_path / "shares.svg"
    main([*map(str, paths), "--picture", str(picture)])
    said = capsys.readouterr().out
    assert "| all | 4 | 3 | 1 |" in said and "| gravity | 3 of 4 |" in said and "1 false successes of 3" in said
    assert "| `lagrange` | 2 of 3; 1 inaccurate |" in said
    assert picture.read_bytes().startswith(b"<?xml") or b"<svg" in picture.read_bytes()


def test_methods_are_ranked_by_the_fastest_run_within_an_error(tmp_path, capsys):
    def run(method, seconds, error, status="ok", step=1e-3):
        return {
            **{"method": method, "integrator": "rk4", "step": step, "rtol": None},
            **{"run_seconds": seconds, "error": error, "status": status},
        }

    rows = [run("lagrange", 2.0, 1e-9), run("lagrange", 1.0, 1e-7), run("baumgarte", 3.0, 1e-9)]
    rows += [run("penalty", 0.5, 1e-2, step=4e-3), run("ggl", 0.1, None, "failed")]
    path = tmp_path / "all.json"
    path.write_text(json.dumps({"studies": [{"mechanism": "pendulum", "rows": rows}]}), encoding="utf-8")
    comparison_tables.main([str(path)])
    said = capsys.readouterr().out
    assert "| `pendulum` | 5 | 4 | 0 | 1 | 1 `rk4` with 0.004 |" in said
    _, _, middle, fine = said.split("| within ")
    assert "| `lagrange` | 1 |" in middle and "| `baumgarte` | 3 |" in middle and "| `penalty` | - |" in middle
    assert "| `baumgarte` | 1.5 |" in fine

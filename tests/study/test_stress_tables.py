"""The tables of the page on stiff and extreme cases, from studies in JSON."""

import json

from report.made import stress_row

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

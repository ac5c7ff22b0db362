"""Commands in joint coordinates: what is shown, kept and refused."""

import json

import pytest

QUICK = ("--methods", "lagrange", "--integrators", "rk4", "--steps", "0.01", "--until", "0.1", "--repeat", "1")


def facts(cli, *words):
    code, out, err = cli(*words, "--json")
    assert code == 0, err
    return json.loads(out)


def test_a_run_says_what_its_state_is(cli):
    joint = facts(cli, "run", "cart-pole", "--until", "0.05", "--coordinates", "joint")
    plain = facts(cli, "run", "cart-pole", "--until", "0.05")
    assert joint["coordinates"] == "joint" and plain["coordinates"] == "absolute"
    assert joint["state"][:3] == ["rail.displacement", "pole.theta", "rail.displacement.rate"]
    assert set(plain["state"]) == {*plain["final"]["q"], *plain["final"]["v"]}
    assert joint["final"]["q"].keys() == plain["final"]["q"].keys()
    for name, value in plain["final"]["q"].items():
        assert joint["final"]["q"][name] == pytest.approx(value, abs=1e-8)  # two runs of rk4 at 1e-3 s
    code, out, _ = cli("run", "cart-pole", "--until", "0.05", "--coordinates", "auto", "--shape", "straight")
    assert code == 0 and "coordinates" in out and "joint, 4 numbers of the state" in out


def test_inspect_shows_the_tree(cli):
    found = facts(cli, "inspect", "four-bar", "--coordinates", "joint", "--method", "lagrange")
    assert found["topology"] == {"tree": ["A", "D", "B"], "cut": ["C"], "merged": [], "prescribed": []}
    assert [q["name"] for q in found["coordinates"]] == ["crank.theta", "rocker.theta", "coupler.theta"]
    assert [row["name"] for row in found["rows"]] == ["C.x", "C.y"] and found["degrees_of_freedom"] == 1
    assert found["state"]["coordinates"] == "joint"
    absolute = facts(cli, "inspect", "four-bar", "--method", "lagrange")
    counts = [f["method"]["functions"]["rhs"]["after"] for f in (found, absolute)]
    assert counts[0] <= 125 < counts[1] <= 178
    assert "topology" not in absolute
    code, out, _ = cli("inspect", "four-bar", "--coordinates", "joint")
    assert code == 0 and "coupler on crank by B" in out and "loops are closed by C" in out


@pytest.mark.slow
def test_a_comparison_of_both(cli, tmp_path):
    journal = tmp_path / "rows.journal"
    words = ("compare", "four-bar", *QUICK, "--coordinates", "absolute,joint", "--resume", journal)
    first = facts(cli, *words)
    assert [row["coordinates"] for row in first["rows"]] == ["absolute", "joint"]
    assert all(row["status"] == "ok" and row["error"] < 1e-6 for row in first["rows"])
    assert first["rows"][0]["cost_ratio"] == 1.0 and first["rows"][1]["cost_ratio"] > 0.0
    assert facts(cli, *words)["rows"] == first["rows"]
    report = tmp_path / "both.html"
    code, out, _ = cli("compare", "four-bar", *QUICK, "--coordinates", "absolute,joint", "-o", report)
    assert code == 0 and "lagrange, joint" in out
    text = report.read_text(encoding="utf-8")
    assert "lagrange, joint" in text and "--coordinates absolute,joint" in text


def test_code_for_a_tree(cli, tmp_path):
    code, _, _ = cli("generate", "four-bar", "--coordinates", "joint", "--method", "direct-correction", "-o", tmp_path)
    assert code == 0
    model = (tmp_path / "model.py").read_text(encoding="utf-8")
    assert "3 coordinates, 3 velocities, 2 constraint rows" in model and "def bodies(" in model
    about = json.loads((tmp_path / "model.json").read_text(encoding="utf-8"))
    assert about["methods"]["direct_correction"]["options"]["weight"] == "mass"

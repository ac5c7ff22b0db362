"""`compare`, `inspect` and `generate` on spatial entries."""

import ast
import json

import pytest

import symgen
from symgen.cli import main


def test_inspect(capsys):
    assert main(["inspect", "rolling-disc", "--json"]) == 0
    found = json.loads(capsys.readouterr().out)
    assert (len(found["velocities"]), len(found["rows"]), found["rank"], found["degrees_of_freedom"]) == (6, 3, 3, 3)
    assert not any("gyroscopic" in str(line) for line in found["left_out"])


@pytest.mark.by_turns(2)
@pytest.mark.slow
@pytest.mark.parametrize("name", ["chain:3", pytest.param("front-suspension", marks=pytest.mark.slow)])
def test_generate(name, capsys, tmp_path):
    assert main(["generate", name, "--method", "direct-correction", "--output", str(tmp_path / "out")]) == 0
    files = sorted(file for file in (tmp_path / "out").rglob("*.py") if file.name != "simulate.py")
    assert {"model.py", "direct_correction.py"} == {file.name for file in files}
    for file in files:
        imported = {
            name.name
            for node in ast.walk(ast.parse(file.read_text()))
            if isinstance(node, ast.Import)
            for name in node.names
        }
        assert imported <= {"math", "numba", "numpy"}


@pytest.mark.slow
def test_compare():
    methods = ["lagrange", "direct-correction"]
    study = symgen.compare("spherical-double-pendulum", methods, ["rk4"], [4e-3, 2e-3], until=0.5, repeat=1)
    assert "independently derived" in study.how and study.estimated_error < 1e-12
    for method in methods:
        coarse, fine = (row for row in study.rows if row.method == method)
        assert coarse.status == fine.status == "ok"
        assert 12.0 < coarse.error / fine.error < 20.0, "of fourth order"


@pytest.mark.by_turns(2)
@pytest.mark.slow
def test_compare_with_a_reduced_model():
    study = symgen.compare("flyball-governor", ["direct-correction"], ["rk4"], [2e-4], until=0.1, repeat=1)
    (row,) = study.rows
    assert "Radau" in study.how and row.error < 1e-9

"""Shapes on the command line: asked for, chosen, shown, written out, refused."""

import ast
import json

import pytest

from symgen.api import load
from symgen.base.errors import InputError
from symgen.study.ensemble.parameter_sweep import sweep


def test_a_run_says_its_shape(cli):
    ends = {}
    for shape in ("straight", "looped"):
        code, out, _ = cli("run", "slider-crank", "--integrator", "rk4", "--until", "0.02", "--shape", shape, "--json")
        found = json.loads(out)
        assert code == 0
        assert found["shape"] == shape
        ends[shape] = found["final"]["q"]
    assert ends["looped"] == pytest.approx(ends["straight"], abs=1e-12)


def test_wrong_shapes_are_refused_in_a_sentence(cli):
    code, out, err = cli("run", "four-bar", "--shape", "lopped")
    assert (code, out) == (2, "")
    assert err.count("\n") == 1 and "one of auto, straight, looped" in err
    code, out, err = cli("run", "four-bar", "--shape", "looped", "--method", "null-space")
    assert (code, out) == (2, "")
    assert err.count("\n") == 1 and "tangent space is dense" in err


def test_inspect_says_which_shape_and_why(cli):
    code, out, _ = cli("inspect", "four-bar", "--shape", "looped", "--json")
    shape = json.loads(out)["shape"]
    assert code == 0
    assert (shape["shape"], shape["reason"]) == ("looped", "it was set")
    assert sorted(shape["kernels"].values()) == [2, 2, 3]  # pins on the ground, pins between links, links
    code, out, _ = cli("inspect", "four-bar")
    assert code == 0
    assert "\nshape: " in out and "9 coordinates, about 2e+04 evaluations" in out


def test_generated_loops_stand_alone(cli, tmp_path):
    folder = tmp_path / "out"
    code, out, err = cli("generate", "four-bar", "--shape", "looped", "--method", "lagrange", "-o", folder)
    assert (code, err) == (0, "")
    stems = {p.stem for p in folder.glob("*.py")}
    assert stems == {"machine", "model", "lagrange", "body_body", "joint_revolute", "joint_revolute_2"}
    assert len(out.splitlines()) == len(stems) + 2
    for path in folder.glob("*.py"):
        for node in ast.walk(ast.parse(path.read_text())):
            if isinstance(node, ast.Import):
                assert {alias.name for alias in node.names} <= {"math", "numpy"}
            elif isinstance(node, ast.ImportFrom) and node.module not in stems:
                assert (node.module or "").split(".")[0] == "numba"
    tables = json.loads((folder / "model.json").read_text())["methods"]["lagrange"]["tables"]
    assert tables["numbers"][:3] == [9, 9, 8]
    assert {name.partition(".")[0] for name in tables["functions"]} <= stems
    first = {p.name: p.read_bytes() for p in folder.iterdir()}
    assert cli("generate", "four-bar", "--shape", "looped", "--method", "lagrange", "-o", folder)[0] == 0
    assert {p.name: p.read_bytes() for p in folder.iterdir()} == first


def test_generating_leaves_out_only_methods_that_have_no_loops(cli, tmp_path):
    arguments = ("--shape", "looped", "--option", "direct-correction.weight=body", "-o", tmp_path / "out")
    assert cli("generate", "pendulum", "--all", *arguments)[0] == 0
    methods = json.loads((tmp_path / "out" / "model.json").read_text())["methods"]
    assert {"direct_correction", "penalty", "ggl"} < set(methods) and "null_space" not in methods
    assert methods["direct_correction"]["options"]["weight"] == "identity"


def test_ensembles_have_straight_code():
    with pytest.raises(InputError, match="straight code for an ensemble"):
        sweep(load("four-bar"), {"crank_mass": [1.0, 2.0]}, shape="looped")

"""Every example runs, and every kind of joint, force, method and integrator is tried by some test."""

import json
import re
from pathlib import Path

import pytest
from support.processes import COMMAND, python

from symgen.forces import FORCES
from symgen.integrators import INTEGRATORS
from symgen.joints import JOINTS
from symgen.methods import METHODS
from symgen.registry import Registry

ROOT = Path(__file__).resolve().parents[2]
EXAMPLES = sorted((ROOT / "examples").iterdir())


def run(script: str, *words: str | Path, cwd: Path) -> str:
    """Run a script, or a command, that must succeed; return its standard output."""
    done = python(script, *words, cwd=cwd)
    assert done.returncode == 0, done.stderr
    return done.stdout


def test_there_is_nothing_but_files_and_scripts() -> None:
    assert {path.suffix for path in EXAMPLES if path.is_file()} == {".toml", ".py"}


@pytest.mark.parametrize("path", [p for p in EXAMPLES if p.suffix == ".toml"], ids=lambda p: p.name)
def test_a_file_runs_as_it_is(path: Path, tmp_path: Path) -> None:
    result = json.loads(run(COMMAND, "run", path, "--until", "0.5", "--json", cwd=tmp_path))
    assert result["status"] == "ok", result["reason"]
    assert result["position_violation_max"] < 1e-10
    assert result["final"]["t"] == 0.5


@pytest.mark.parametrize("path", [p for p in EXAMPLES if p.suffix == ".py"], ids=lambda p: p.name)
def test_a_script_runs_and_writes_a_file_that_runs(path: Path, tmp_path: Path) -> None:
    text = run(path.read_text(encoding="utf-8"), cwd=tmp_path)
    assert "[mechanism]" in text
    (tmp_path / "written.toml").write_text(text, encoding="utf-8")
    result = json.loads(run(COMMAND, "run", "written.toml", "--until", "0.2", "--json", cwd=tmp_path))
    assert result["status"] == "ok", result["reason"]


SOURCES = {
    path: path.read_text(encoding="utf-8")
    for path in sorted((ROOT / "tests").rglob("*.py"))
    if ROOT / "tests" / "project" not in path.parents
}


@pytest.mark.parametrize("registry", [JOINTS, FORCES, METHODS, INTEGRATORS], ids=lambda r: r.what)
def test_every_kind_is_tried_by_a_test(registry: Registry[object]) -> None:
    """By its name, or by a test over the whole registry."""
    variable = {JOINTS: "JOINTS", FORCES: "FORCES", METHODS: "METHODS", INTEGRATORS: "INTEGRATORS"}[registry]
    over_all = any(re.search(rf"\b{variable}\.(names|items\(\))", text) for text in SOURCES.values())
    for kind in registry.names:
        pattern = re.compile(rf"""["'`]{re.escape(kind)}["'`]""")
        by_name = [p for p, text in SOURCES.items() if pattern.search(text)]
        assert by_name or over_all, f"{registry.what} '{kind}' is tried by no test"

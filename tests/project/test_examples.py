"""Every example runs and prints what is right; every kind of joint, force, method and integrator is tried by a test."""

import json
import math
import os
import re
from pathlib import Path

import pytest
from support import notebooks
from support.processes import COMMAND, python

from symgen.base.registry import Registry
from symgen.derive.methods import METHODS
from symgen.describe.forces import FORCES
from symgen.describe.joints import JOINTS
from symgen.run.integrators import INTEGRATORS

ROOT = Path(__file__).resolve().parents[2]
EXAMPLES = sorted(path for path in (ROOT / "examples").iterdir() if path.is_file())
NOTEBOOKS = [path for path in EXAMPLES if path.suffix == ".ipynb"]
NUMBER = r"(-?[\d.]+(?:e[-+]\d+)?)"
#: What a script prints: pattern -> the number by another route, and how near it has to be; and the files it writes.
PRINTED: dict[str, tuple[dict[str, tuple[float, float]], tuple[str, ...]]] = {
    "first_run.py": ({rf"violation: largest {NUMBER}": (0.0, 1e-9)}, ("first-run.pdf", "first-run.csv")),
    "sources_study.py": (
        {rf"direct-correction +0.005 s  ok: error {NUMBER}": (0.0, 1e-6)},
        ("study.html", "study.csv", "study.pdf"),
    ),
    "equations_in_sympy.py": ({rf"{NUMBER} of 2 checks by SymPy hold": (2.0, 0.0)}, ()),
    "emitted_code_under_scipy.py": ({rf"SciPy .* {NUMBER} rad": (13.8049676, 1e-5)}, ("emitted/lagrange.py",)),
    "controller.py": ({rf"gust to {NUMBER} rad": (0.0, 1e-3), rf"back at {NUMBER} m": (0.0, 1e-3)}, ()),
    # gains of the catalogue's file, which were computed before symgen linearised anything
    "lqr.py": ({rf"gains \[{NUMBER}": (-3.1623, 1e-4), rf"pole at {NUMBER}": (0.0, 1e-4)}, ()),
    "swing_up.py": ({rf"at a height of {NUMBER} of": (1.0, 1e-2), rf"length, at {NUMBER} rad/s": (0.0, 0.1)}, ()),
    "sweep.py": ({rf"at most {NUMBER} m from": (0.0, 1e-3)}, ("heights.csv",)),
    "optimisation.py": ({rf"stiffness {NUMBER} N/m": (4.0 * 9.81 * 0.6 / (0.2 * 0.3), 0.5)}, ()),
    # dead centres: crank and coupler in line span 8 + 2 and 8 - 2 m; ground 10 m, rocker 5 m
    "motor_sizing.py": (
        {rf"swings by {NUMBER} degrees": (math.degrees(math.acos(0.25) - math.acos(0.89)), 0.06)},
        ("motor.pdf",),
    ),
    "modes.py": ({rf"{NUMBER} degree of freedom": (3 * 3 - 4 * 2, 0.0)}, ()),
    "page.py": ({}, ("motion.html", "equations.html", "four-bar.svg")),
    "own_method.py": ({rf"velocity-feedback: .* by {NUMBER} m/s": (0.0, 1e-7)}, ()),
    "own_joint.py": ({rf"fallen {NUMBER} m": (9.81 / 3.0 * 0.5**2 / 2.0, 1e-9)}, ()),
    "hanging_chain.py": ({rf"8 bodies, {NUMBER} constraint rows": (2.0 * 9, 0.0)}, ()),
}


def run(script: str, *words: str | Path, cwd: Path) -> str:
    """Run a script, or a command, that must succeed; return its standard output."""
    done = python(script, *words, cwd=cwd)
    assert done.returncode == 0, done.stderr
    return done.stdout


def test_every_example_is_in_its_table_and_is_run() -> None:
    table = (ROOT / "examples" / "README.md").read_text(encoding="utf-8")
    names = {path.name for path in EXAMPLES} - {"README.md"}
    assert {path.suffix for path in EXAMPLES} == {".toml", ".py", ".ipynb", ".md"}
    assert set(re.findall(r"\]\(([\w.-]+)\)", table)) == names
    assert set(PRINTED) == {name for name in names if name.endswith(".py")}


@pytest.mark.parametrize("path", [p for p in EXAMPLES if p.suffix == ".toml"], ids=lambda p: p.name)
def test_a_file_runs_as_it_is(path: Path, tmp_path: Path) -> None:
    result = json.loads(run(COMMAND, "run", path, "--until", "0.5", "--json", cwd=tmp_path))
    assert result["status"] == "ok", result["reason"]
    assert result["position_violation_max"] < 1e-10
    assert result["final"]["t"] == 0.5


@pytest.mark.slow_cases("sources_study.py", "emitted_code_under_scipy.py")
@pytest.mark.parametrize("name", PRINTED)
def test_a_script_prints_what_is_right_and_writes_its_files(name: str, tmp_path: Path) -> None:
    expected, written = PRINTED[name]
    text = run((ROOT / "examples" / name).read_text(encoding="utf-8"), cwd=tmp_path)
    for pattern, (value, tolerance) in expected.items():
        found = re.search(pattern, text)
        assert found, f"'{pattern}' is not in\n{text}"
        assert abs(float(found[1]) - value) <= tolerance, text
    for file in written:
        assert (tmp_path / file).stat().st_size > 100


def test_the_file_that_a_script_prints_runs(tmp_path: Path) -> None:
    text = run((ROOT / "examples" / "hanging_chain.py").read_text(encoding="utf-8"), cwd=tmp_path)
    (tmp_path / "written.toml").write_text(text, encoding="utf-8")
    result = json.loads(run(COMMAND, "run", "written.toml", "--until", "0.2", "--json", cwd=tmp_path))
    assert result["status"] == "ok", result["reason"]


@pytest.mark.fast("equations_to_code.ipynb")
@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda p: p.name)
def test_a_notebook_shows_what_is_kept_in_it(path: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Checks are assertions in its cells. With SYMGEN_UPDATE_NOTEBOOKS=1 what its cells show is kept anew."""
    monkeypatch.chdir(tmp_path)
    if os.environ.get("SYMGEN_UPDATE_NOTEBOOKS"):
        notebooks.store(path)
    cells = [cell for cell in json.loads(path.read_text(encoding="utf-8"))["cells"] if cell["cell_type"] == "code"]
    texts = ["".join(cell["source"]) for cell in cells]
    assert "assert" in "\n".join(texts) and path.stat().st_size < 1_000_000
    for cell, text, found in zip(cells, texts, notebooks.outputs(texts), strict=True):
        assert notebooks.kinds(cell["outputs"]) == notebooks.kinds(found), text
    kept = [kind for cell in cells for kind in notebooks.kinds(cell["outputs"])]
    assert "<iframe" in "".join(o["data"].get("text/html", "") for c in cells for o in c["outputs"] if "data" in o)
    assert "text/html" in kept and len(kept) >= len(cells)


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

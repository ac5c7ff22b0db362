"""Text of a file is never executed, and never takes the process down: defects A1 to A3; see `emit/test_text.py`."""

import ast
from pathlib import Path

import pytest
from support.processes import python

from verification.running import DEFECTS, measured
from verification.running import symgen as command


def code_of(module: ast.Module) -> str:
    """A module without its docstrings, and without the texts of its comments: what is executed."""
    for node in ast.walk(module):
        if isinstance(node, ast.Module | ast.FunctionDef | ast.ClassDef) and ast.get_docstring(node) is not None:
            node.body = node.body[1:] or [ast.Pass()]
    return ast.dump(module)


@pytest.mark.by_turns(2)
@pytest.mark.slow
@pytest.mark.parametrize("name", ["inject_unit", "emitted_not_python"])
def test_units_stay_text(name: str, tmp_path: Path) -> None:
    for words in (["check"], ["generate", "--output", tmp_path / "out"], ["run", "--until", "0.01", "--step", "1e-3"]):
        said = command([words[0], DEFECTS / f"{name}.toml", *words[1:]], tmp_path, NUMBA_DISABLE_JIT="1")
        assert said.code == 2 and said.sentence and "unit" in said.err, said.err
    assert not list(tmp_path.rglob("EXECUTED*"))
    for module in (tmp_path / "out").rglob("*.py"):
        assert "os.system" not in code_of(ast.parse(module.read_text(encoding="utf-8")))


def test_a_full_disk_is_said(tmp_path: Path) -> None:
    """Saving stops in the middle of the file; the process stays alive and leaves nothing behind."""
    script = """
import resource, signal, sys
import symgen
result = symgen.load("pendulum").simulate(until=20.0, step=1e-3)
signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
resource.setrlimit(resource.RLIMIT_FSIZE, (48_000, resource.RLIM_INFINITY))
try:
    result.save("full.nc")
except symgen.SymgenError as error:
    print("said:", error)
"""
    done = python(script, cwd=tmp_path)
    assert done.returncode == 0, (done.returncode, done.stderr)
    assert done.stdout.startswith("said:") and done.stdout.count("\n") == 1
    assert not list(tmp_path.iterdir())


@pytest.mark.slow
@pytest.mark.parametrize("dotted", ["a" + ".a" * 20_000 + " = 1", "[" + "a." * 20_000 + "a]"])
def test_dotted_names_cost_what_their_length_says(dotted: str, tmp_path: Path) -> None:
    """40 kB took 1.6 GB and 6 s; depth is told before anything is built."""
    file = tmp_path / "dotted.toml"
    file.write_text(f'[mechanism]\nname = "dotted"\n{dotted}\n', encoding="utf-8")
    said = measured(["check", file], tmp_path)
    assert said.code == 2 and said.sentence, said.err
    assert "parts joined by dots" in said.err
    assert said.memory < 300e6

"""`--resume` after a kill, and after a change of the code: in processes, on the folder or journal that they share."""

import json
import shutil

import pytest

import symgen
from symgen.study.ensemble.table import DONE
from tests.processes.programs import PROGRAMS, ROOT, Program, chunks, command_of, shell

SWEEP = 'symgen sweep four-bar --vary "crank_mass=lin(1,3,40)" --integrator rk4 --step 1e-3 --until 1 -o folder'
COMPARED = (
    "compare four-bar --methods lagrange,baumgarte,direct-correction --integrators rk4 --steps 2e-3,1e-3,1e-4,1e-5 "
    "--until 2 --resume rows"
)


@pytest.mark.by_turns(3)
@pytest.mark.slow
def test_a_comparison_goes_on_where_it_was_killed(tmp_path):
    journal = tmp_path / "rows"

    def keys():
        lines = journal.read_text().splitlines()[1:] if journal.exists() else []
        return [json.loads(line)["key"] for line in lines if line.endswith("}")]

    with Program([PROGRAMS / "symgen", *COMPARED.split()], tmp_path / "killed.txt") as killed:
        killed.wait_for(lambda: len(keys()) >= 3)
        killed.kill()
    before = keys()
    out, _ = shell(f"symgen {COMPARED} --json", tmp_path)
    assert [row["status"] for row in json.loads(out)["rows"]] == ["ok"] * 12
    after = keys()
    assert after[: len(before)] == before and len(after) == len({*after}) == 13  # the reference as well


@pytest.mark.by_turns(3)
@pytest.mark.slow
def test_a_sweep_goes_on_where_it_was_killed(tmp_path):
    command = command_of("sweeps.md", 'symgen sweep four-bar --vary "crank_mass=lin(1,3,50)" --until 0.5 -o folder')
    command = command.replace("lin(1,3,50)", "lin(1,3,20000)").replace("--until 0.5", "--until 5")
    folder = tmp_path / "folder"
    words = ["bash", "-c", f"exec {command}"]

    with Program(words, tmp_path / "killed.txt") as killed:
        killed.wait_for(lambda: len(chunks(folder)) >= 3)
        killed.kill()
    before = chunks(folder)
    out, _ = shell(f"{command} --resume --json", tmp_path)
    assert json.loads(out)["status"]["ok"] == 20000
    after = chunks(folder)
    assert len(before) < len(after) == len({*after}) and after[: len(before)] == before


@pytest.mark.by_turns(2)
@pytest.mark.slow
def test_a_sweep_of_other_code_is_refused_and_left(tmp_path):
    """One character of a room that no loop imports by itself, in a copy of the package."""
    package = tmp_path / "library" / "symgen"
    shutil.copytree(symgen.__path__[0], package, ignore=shutil.ignore_patterns("__pycache__"))
    if not (package / "templates").exists():
        shutil.copytree(ROOT / "templates", package.parent / "templates")
    copied = SWEEP.replace("symgen sweep", "python -m symgen sweep")
    more = {"PYTHONPATH": str(package.parent)}
    shell(copied, tmp_path, **more)
    done = (tmp_path / "folder" / DONE).read_text()
    shell(f"{copied} --resume", tmp_path, **more)
    file = package / "run" / "starts" / "impulse.py"
    file.write_text(file.read_text() + "\n")
    _, said = shell(f"{copied} --resume", tmp_path, code=2, **more)
    assert said.count("\n") == 1 and "one by another version of symgen" in said
    assert (tmp_path / "folder" / DONE).read_text() == done

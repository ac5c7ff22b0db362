"""Small samples of what `benchmarks` verifies at length, and the pages that describe it."""

import json
import re
import subprocess
from pathlib import Path

import pytest
from support.processes import python
from support.rotation import of_turn

ROOT = Path(__file__).resolve().parents[2]


def run(module: str, *words: str) -> subprocess.CompletedProcess[str]:
    script = f"import runpy; runpy.run_module({module!r}, run_name='__main__', alter_sys=True)"
    return python(script, *words, cwd=ROOT, path=[ROOT])


def lines(path: Path) -> list[dict]:
    return [json.loads(line) for line in path.read_text(encoding="utf-8").splitlines()]


def verified(output: Path, *words: str) -> list[dict]:
    done = run("benchmarks.verify", "--output", str(output), "--jobs", "1", *words)
    assert done.returncode == 0, done.stdout[-3000:] + done.stderr[-1000:]
    return [line for line in lines(output) if "runs" in line]


@pytest.mark.by_turns(2)
@pytest.mark.slow
@pytest.mark.parametrize("shape", ["straight", "joint"])
def test_a_few_random_mechanisms(shape: str, tmp_path: Path) -> None:
    """Emitted code is run as Python here, so that nothing has to be compiled."""
    words = ("--interpreted", "--shapes", shape, "--mechanisms", "2", "--seed", "21", "--space", "planar")
    moving = [line for line in verified(tmp_path / "verify.jsonl", *words) if "contradiction" not in line]
    assert moving and all(run["right"] and run["status"] == "ok" for line in moving for run in line["runs"])
    again = run("benchmarks.verify", "--output", str(tmp_path / "verify.jsonl"), "--jobs", "1", *words)
    assert again.returncode == 0 and ": lagrange" not in again.stderr, "what is there is not run again"


@pytest.mark.by_turns(3)
@pytest.mark.slow
@pytest.mark.parametrize(("space", "count"), [("planar", 4), ("spatial", 2)])
def test_random_mechanisms_in_all_shapes(space: str, count: int, tmp_path: Path) -> None:
    words = ("--shapes", "straight,looped,auto", "--mechanisms", str(count), "--seed", "22", "--space", space)
    for first in of_turn((0, count), 2):
        assert len(verified(tmp_path / f"{first}.jsonl", *words, "--first", str(first))) >= count // 2


@pytest.mark.by_turns(2)
@pytest.mark.slow
def test_many_random_mechanisms(tmp_path: Path) -> None:
    words = ("--interpreted", "--shapes", "straight,joint", "--mechanisms", "5", "--seed", "23")
    for first in of_turn(("0", "5", "10"), 3):
        assert len(verified(tmp_path / f"{first}.jsonl", *words, "--first", first)) > 1


@pytest.mark.by_turns(3)
@pytest.mark.slow
def test_random_mechanisms_by_every_method(tmp_path: Path) -> None:
    """Looped code where a method has it: compiled once for all mechanisms."""
    words = ("--shapes", "looped", "--methods", "--mechanisms", "1", "--seed", "24")
    for first in of_turn(("0", "1"), 2):
        assert verified(tmp_path / f"{first}.jsonl", *words, "--first", first)


def fuzzed(output: Path, *words: str) -> None:
    done = run("benchmarks.fuzz", "--jobs", "1", "--output", str(output), *words)
    assert done.returncode == 0, done.stdout[-3000:] + done.stderr[-1000:]
    assert "exit codes" in done.stdout and not lines(output)


def test_a_hundred_broken_files(tmp_path: Path) -> None:
    fuzzed(tmp_path / "fuzz.jsonl", "--files", "100", "--seed", "21", "--whole", "0.1")


@pytest.mark.by_turns(3)
@pytest.mark.slow
def test_thousands_of_broken_files(tmp_path: Path) -> None:
    fuzzed(tmp_path / "fuzz.jsonl", "--files", "1000", "--seed", "22", "--whole", "0.2")


@pytest.mark.by_turns(2)
@pytest.mark.slow
def test_a_few_flipped_bits(tmp_path: Path) -> None:
    done = run("benchmarks.flips", "--flips", "20", "--seed", "21", "--output", str(tmp_path / "flips.jsonl"))
    assert done.returncode == 0, done.stdout[-3000:] + done.stderr[-1000:]
    assert len(lines(tmp_path / "flips.jsonl")) == 20


def in_units(output: Path, *words: str) -> None:
    done = run("benchmarks.units", "--output", str(output), *words)
    assert done.returncode == 0, done.stdout[-3000:] + done.stderr[-1000:]
    assert all(not line["first"] for line in lines(output))


@pytest.mark.by_turns(2)
@pytest.mark.slow
def test_a_few_mechanisms_in_other_units(tmp_path: Path) -> None:
    in_units(tmp_path / "units.jsonl", "--entries", "pendulum", "--mechanisms", "1", "--seed", "21")


@pytest.mark.by_turns(3)
@pytest.mark.slow
def test_mechanisms_in_other_units_compiled(tmp_path: Path) -> None:
    in_units(tmp_path / "units.jsonl", "--mechanisms", "4", "--seed", "22", "--compiled")


def test_commands_of_the_page_are_there() -> None:
    """Options that the page names are options of its commands."""
    page = (ROOT / "docs" / "development" / "verification.md").read_text(encoding="utf-8")
    commands = re.findall(r"^python -m (benchmarks\.[\w.]+)(.*?)(?:  #.*)?$", page, re.MULTILINE)
    bounded = ("bounded", "bounded.machines", "bounded.methods", "bounded.margins")
    assert {name for name, _ in commands} == {f"benchmarks.{n}" for n in ("verify", "fuzz", "flips", "units", *bounded)}
    for name, rest in commands:
        helped = run(name, "--help")
        assert helped.returncode == 0
        for option in re.findall(r"--[a-z-]+", rest):
            assert option in helped.stdout, (name, option)

"""C by a compiler and an FMU in FMPy, by the commands of `docs/howto/c-and-fmu.md`, against a run in a process."""

import csv
import json
import sys
import zipfile

import pytest

from tests.processes.programs import block_of, command_of, files_of, shell

PAGE = "howto/c-and-fmu.md"
RUN = "symgen run four-bar --method direct-correction --integrator rk4 --shape straight --no-verify --json"


def final(words, folder):
    """Return the last state of a run."""
    out, _ = shell(f"{RUN} {words}", folder)
    return json.loads(out)["final"]


@pytest.mark.slow
def test_c_by_the_compiler_of_the_page(tmp_path):
    shell(command_of(PAGE, "symgen generate four-bar --target c"), tmp_path)
    _, said = shell(command_of(PAGE, "cc -std=c99 -O2 four-bar-c"), tmp_path)
    assert said == ""
    with (tmp_path / "motion.csv").open() as file:
        rows = list(csv.DictReader(file))
    own = final("", tmp_path)
    last = {name.split(" ")[0]: float(value) for name, value in rows[-1].items()}
    assert last["t"] == pytest.approx(own["t"], abs=1e-12) and own["t"] == 10.0
    for name in ("crank.theta", "rocker.omega"):
        assert last[name] == pytest.approx(value_of(own, name), abs=1e-9)


def value_of(found, name):
    """Return a quantity of the last state."""
    for part in ("q", "v"):
        if name in found[part]:
            return found[part][name]
    raise AssertionError(f"{name} is not in {found}")


@pytest.mark.slow
def test_an_fmu_in_fmpy_as_the_page_has_it(tmp_path):
    (tmp_path / "simulated.py").write_text(block_of(PAGE, "rows = simulate_fmu("))
    out, _ = shell(f"{sys.executable} simulated.py", tmp_path)
    own = final("--set crank_mass=2.5 --until 1", tmp_path)
    assert float(out) == pytest.approx(value_of(own, "crank.theta"), abs=1e-9)


@pytest.mark.slow
def test_an_fmu_by_the_command_and_its_library_by_the_compiler_of_the_page(tmp_path):
    shell(command_of(PAGE, "symgen generate four-bar --target fmu --output four-bar.fmu"), tmp_path)
    with zipfile.ZipFile(tmp_path / "four-bar.fmu") as archive:
        archive.extractall(tmp_path / "unpacked")
    (library,) = (tmp_path / "unpacked" / "binaries" / "linux64").iterdir()
    library.unlink()
    _, said = shell(command_of(PAGE, "cc -std=c99 -O2 -shared"), tmp_path / "unpacked")
    assert said == "" and library.is_file()
    script = (
        "import os\nfrom fmpy import simulate_fmu\n"
        "rows = simulate_fmu(os.path.abspath('unpacked'), stop_time=1.0, output=['crank.theta'])\n"
        "print(rows['crank.theta'][-1])\n"
    )
    (tmp_path / "simulated.py").write_text(script)
    out, _ = shell(f"{sys.executable} simulated.py", tmp_path)
    assert float(out) == pytest.approx(value_of(final("--until 1", tmp_path), "crank.theta"), abs=1e-9)


@pytest.mark.slow
def test_a_program_of_the_page_resets_as_an_event_of_a_run_does(tmp_path):
    """The door is held by friction, is knocked and slides; where it is knocked hard, it strikes both its stops."""
    files_of(PAGE, tmp_path, "door.toml", "knock.c")
    shell(command_of(PAGE, "symgen generate door.toml"), tmp_path)
    _, said = shell(command_of(PAGE, "cc -std=c99 -O2 -Wall -Wextra -Idoor-c"), tmp_path)
    assert said == ""
    for strength in (-6.0, -0.8, 0.0, 0.5, 1.5, 2.0, 9.0):
        out, _ = shell(f"./knock {strength}", tmp_path)
        t, theta, omega = map(float, out.split())
        values = f"--set knock_at=0.5 --set strength={strength}"
        own = json.loads(shell(f"symgen run door.toml --integrator rk4 --no-verify --json {values}", tmp_path)[0])
        assert own["status"] == "ok"
        assert t == pytest.approx(own["final"]["t"], abs=1e-12)
        assert theta == pytest.approx(own["final"]["q"]["leaf.theta"], abs=1e-9)
        assert omega == pytest.approx(own["final"]["v"]["leaf.omega"], abs=1e-9)
        assert (theta == 0.0) == (strength == 0.0)


@pytest.mark.slow
def test_a_mechanism_has_the_same_bytes_in_each_process(tmp_path):
    for seed in ("1", "2"):
        shell(f"symgen generate toggle-press --target c --output {seed}", tmp_path, PYTHONHASHSEED=seed)
    first, second = ((tmp_path / seed / "toggle_press.c").read_bytes() for seed in ("1", "2"))
    assert first == second

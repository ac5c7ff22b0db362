"""What would need more memory or disk than there is, is refused in a sentence before anything is allocated."""

import json
import re
import subprocess
import sys
from pathlib import Path

import msgspec
import pytest

from symgen.api import load
from symgen.base import memory
from symgen.base.errors import InputError
from symgen.describe.run_defaults import Defaults

#: Runs commands in a process whose address space is bounded, and says of each how it ended, what it said, and how much
#: of the memory the process has taken at most until then.
SCRIPT = """\
import contextlib, io, json, re, resource, sys
import numba, numpy, symgen.api, symgen.study.stress.study
import symgen.study.ensemble.parameter_sweep, symgen.study.comparison.compare_models
from symgen.cli import main
limit = 6_000_000_000
resource.setrlimit(resource.RLIMIT_AS, (limit, limit))
ended = []
for words in json.loads(sys.argv[1]):
    with contextlib.redirect_stderr(io.StringIO()) as said, contextlib.redirect_stdout(io.StringIO()):
        code = main(words)
    # ru_maxrss would count what the process that started this one had taken
    taken = int(re.search(r"VmHWM:\\s*(\\d+)", open("/proc/self/status").read())[1])
    ended.append((code, said.getvalue(), taken))
print(json.dumps(ended))
"""
REQUESTS = {
    "sweep pendulum --vary bob.vy=lin(0,1,1000000000) --until 0.02": (
        r"--vary bob.vy: expected lin\(first, last, count\) with no more than 80% of the free memory, \S+ GB, got "
        r"1e\+09 values, about 24 GB"
    ),
    "sweep pendulum --vary bob.vy=uniform(0,1,1e9,7) --until 0.02": r"1e\+09 values",
    "sweep pendulum --vary bob.vy=log(1,2,1e9) --until 0.02": r"1e\+09 values",
    "sweep pendulum --vary bob.vy=lin(0,1,30000) --vary bob.vx=lin(0,1,30000) --until 0.02": (
        r"sweep: expected no more than 80% of the free memory, \S+ GB, got 9e\+08 runs, about 360 GB"
    ),
    "sweep pendulum --vary bob.vy=lin(0,1,20000) --until 1 --output-step 1e-5 --quantity q": (
        r"got 20000 runs, each with 2 quantities at 100001 times, about 32 GB"
    ),
    "run n-four-bar:1000 --until 0.01 --output-step 1e-9": (
        r"--output-step: expected no more than 80% of the free memory, \S+ GB, got 1e\+07 outputs, about \S+ GB"
    ),
    "run n-four-bar:1000 --until 0.01 --output-step 1e-9 --json": r"1e\+07 outputs",
    "run n-four-bar:1000 --step 1e-6 --until 1 --output-step 1e-6": r"1e\+06 outputs",
    "run andrews --output-step 1e-8 --until 0.03 --save a.nc": (
        r"--save: expected no more than 80% of the free memory, \S+ GB, got 3e\+06 outputs of andrews"
    ),
    "compare four-bar --until 1 --output-step 1e-7": "--output-step: expected no more",
}


@pytest.fixture(scope="module")
def ended(tmp_path_factory):
    """Exit code, message and memory of each command, and what they left behind."""
    folder = tmp_path_factory.mktemp("asked")
    words = json.dumps([words.split() for words in REQUESTS])
    found = subprocess.run(
        [sys.executable, "-c", SCRIPT, words], capture_output=True, text=True, cwd=folder, timeout=600, check=False
    )
    assert found.returncode == 0, found.stderr
    assert list(folder.iterdir()) == []
    return dict(zip(REQUESTS, json.loads(found.stdout), strict=True))


@pytest.mark.slow_cases(
    "sweep pendulum --vary bob.vy=lin(0,1,1000000000) --until 0.02",
    "sweep pendulum --vary bob.vy=uniform(0,1,1e9,7) --until 0.02",
)
@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="bounds the address space")
@pytest.mark.parametrize("words", REQUESTS)
def test_one_sentence_before_anything_is_allocated(ended, words):
    code, said, kilobytes = ended[words]
    assert code == 2, said
    assert said.startswith("symgen: ") and said.count("\n") == 1
    assert re.search(REQUESTS[words], said), said
    assert kilobytes < 600_000


def test_a_disk_that_is_too_small(tmp_path, monkeypatch):
    import symgen

    monkeypatch.setattr(memory.shutil, "disk_usage", lambda path: memory.shutil._ntuple_diskusage(9, 8, 1000))
    with pytest.raises(
        InputError, match=r"folder '.*': expected no more than the disk has, 1e-06 GB, got 9 runs, each"
    ):
        symgen.sweep("pendulum", {"bob.vy": "lin(0, 1, 9)"}, until=0.01, output=tmp_path / "rows")
    assert list(tmp_path.iterdir()) == []


def test_requests(monkeypatch):
    monkeypatch.setattr(memory, "available_bytes", lambda: 1e9)
    memory.require_memory("x", "little", 7.9e8)
    with pytest.raises(
        InputError, match=r"^x: expected no more than 80% of the free memory, 0.8 GB, got much, about 2 GB$"
    ):
        memory.require_memory("x", "much", 2e9)
    monkeypatch.setattr(memory, "available_bytes", lambda: None)
    memory.require_memory("x", "anything", 1e30)


def groups(root: Path, name: str, limit: str, used: int, files: int, old: bool) -> None:
    names = memory._OLD if old else ("memory.max", "memory.current")
    folder = root / name
    folder.mkdir(parents=True, exist_ok=True)
    (folder / names[0]).write_text(f"{limit}\n")
    (folder / names[1]).write_text(f"{used}\n")
    (folder / "memory.stat").write_text(f"anon 1\n{'total_inactive_file' if old else 'inactive_file'} {files}\n")


@pytest.mark.parametrize("old", [False, True])
def test_groups_of_a_container_count(tmp_path, monkeypatch, old):
    root = tmp_path / "cgroup"
    line = "4:memory:/user/run\n" if old else "0::/user/run\n"
    base = root / "memory" if old else root
    groups(base, "user/run", "max" if not old else str(2**62), 0, 0, old)
    groups(base, "user", "5000", 3000, 500, old)
    monkeypatch.setattr(memory, "_GROUPS", root)
    real = Path.read_text
    monkeypatch.setattr(Path, "read_text", lambda p, *a: line if str(p) == "/proc/self/cgroup" else real(p, *a))
    assert min(memory._free_memory_of_control_groups()) == 2500.0
    groups(base, "", "1000", 900, 0, old)  # a container sees its own group as the root
    assert min(memory._free_memory_of_control_groups()) == 100.0


def test_this_machine_says_something():
    found = memory.available_bytes()
    assert found is None or 1e6 < found < 1e15


def test_constant_steps_have_an_output_each_whoever_names_the_integrator(monkeypatch):
    from symgen.base.settings import Settings
    from symgen.run.planning.outputs import check_saving

    mechanism = msgspec.structs.replace(load("four-bar").mechanism, defaults=Defaults(until=10.0, step=1e-3))
    monkeypatch.setattr(memory, "available_bytes", lambda: 1e9)
    check_saving(mechanism, Settings())
    constant = msgspec.structs.replace(mechanism, defaults=Defaults(10.0, 1e-5, integrator="rk4"))
    for described, settings in (
        (mechanism, Settings(step=1e-5, integrator="rk4")),
        (mechanism, Settings(method="generalized-alpha", step=1e-5)),
        (constant, Settings()),
    ):
        with pytest.raises(InputError, match=r"1e\+06 outputs of four-bar"):
            check_saving(described, settings)
    check_saving(mechanism, Settings(step=1e-5))
    check_saving(constant, Settings(integrator="dop853"))

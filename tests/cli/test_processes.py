"""What only a process of its own shows: imports, signals, pipes and terminals."""

import json
import os
import pty
import select
import signal
import subprocess
import sys
import time

import pytest
from support.processes import symgen

HEAVY = ("numpy", "scipy", "sympy", "numba", "llvmlite", "jinja2", "rich", "pandas", "xarray", "matplotlib", "msgspec")

SCRIPT = """\
import json, sys
from symgen.cli import main
code = main(sys.argv[1:])
print(json.dumps({{"code": code, "modules": [m for m in {heavy!r} if m in sys.modules]}}), file=sys.stderr)
"""


def imported(*arguments):
    """Run a command in a process; return its exit code, output and which heavy modules it imported."""
    found = subprocess.run(
        [sys.executable, "-c", SCRIPT.format(heavy=HEAVY), *arguments],
        capture_output=True,
        text=True,
        timeout=600,
        check=True,
    )
    facts = json.loads(found.stderr.splitlines()[-1])
    return facts["code"], found.stdout, set(facts["modules"])


@pytest.mark.parametrize("words", ["--help", "--version", "run --help", "compare --help", "inspect --help", "rnu"])
def test_help_imports_nothing_heavy(words):
    _, _, modules = imported(*words.split())
    assert modules == set()


THREADS = """\
import os, sys

class Finder:
    def find_spec(self, name, *rest):
        if name == "numpy":
            print(os.environ.get("OPENBLAS_NUM_THREADS"), file=sys.stderr)

sys.meta_path.insert(0, Finder())
from symgen.cli import main
main(["stress", "five-bar"])
print(os.environ.get("OPENBLAS_NUM_THREADS"), file=sys.stderr)
"""


@pytest.mark.slow
def test_a_study_in_one_process_computes_with_one_thread():
    """Small matrices of two threads took ten times the processor time on busy cores."""
    command, plain = [sys.executable, "-c", THREADS], {k: v for k, v in os.environ.items() if "NUM_THREADS" not in k}
    found = subprocess.run(command, capture_output=True, text=True, timeout=600, check=True, env=plain)
    lines = found.stderr.splitlines()
    assert (lines[0], lines[-1]) == ("1", "None"), found.stderr


@pytest.mark.slow
def test_running_a_generated_model_imports_no_heavy_library():
    arguments = ("run", "four-bar", "--until", "0.05", "--json")
    assert symgen(arguments).returncode == 0  # now it is in the cache
    code, out, modules = imported(*arguments)
    assert code == 0 and json.loads(out)["status"] == "ok"
    assert modules == {"numpy", "llvmlite", "msgspec"}


# -- interruption ------------------------------------------------------------------------------------------------------


def interrupt(arguments, ready, tmp_path):
    """Start a command, interrupt it when `ready` returns; give exit code and both outputs."""
    out, err = tmp_path / "out.txt", tmp_path / "err.txt"
    with out.open("w") as o, err.open("w") as e:
        # in the background of some shells SIGINT is ignored, and that is inherited
        process = subprocess.Popen(
            [sys.executable, "-c", "from symgen.cli import main; raise SystemExit(main())", *map(str, arguments)],
            stdout=o,
            stderr=e,
            preexec_fn=lambda: signal.signal(signal.SIGINT, signal.default_int_handler),
        )
        try:
            ready(process)
            process.send_signal(signal.SIGINT)
            process.wait(timeout=600)
        finally:
            process.kill()
    return process.returncode, out.read_text(), err.read_text()


def integrating(process):
    """Wait until the process has a second busy thread: the loop."""
    deadline = time.monotonic() + 600
    while time.monotonic() < deadline and process.poll() is None:
        names = []
        for task in os.listdir(f"/proc/{process.pid}/task"):
            try:
                with open(f"/proc/{process.pid}/task/{task}/stat") as file:
                    names.append(int(file.read().rsplit(")", 1)[1].split()[11]))
            except (OSError, IndexError):
                continue
        main = names[0] if names else 0
        if any(ticks > 30 for ticks in names[1:]) and main:
            return
        time.sleep(0.05)


@pytest.mark.slow
@pytest.mark.skipif(not os.path.isdir("/proc/self/task"), reason="needs /proc")
def test_an_interrupted_run_writes_what_it_has(tmp_path):
    assert symgen(["run", "pendulum", "--integrator", "rk4", "--until", "0.1", "--json"]).returncode == 0
    saved = tmp_path / "run.csv"
    arguments = (
        "run",
        "pendulum",
        "--integrator",
        "rk4",
        "--until",
        "1e5",
        "--output-step",
        "10",
        "--json",
        "--save",
        saved,
    )
    code, out, err = interrupt(arguments, integrating, tmp_path)
    assert code == 130
    found = json.loads(out)
    assert found["status"] == "failed" and found["reason"] == "interrupted"
    assert 0.0 < found["final"]["t"] < 1e5
    assert err.splitlines()[-1] == f"symgen: interrupted; outputs up to t = {found['final']['t']:g} s were kept"
    lines = saved.read_text().splitlines()
    assert float(lines[-1].split(",")[0]) == found["final"]["t"]


@pytest.mark.slow
@pytest.mark.skipif(not os.path.isdir("/proc/self/task"), reason="needs /proc")
def test_an_interrupted_study_prints_its_rows(tmp_path):
    words = ("--methods", "lagrange", "--integrators", "rk4", "--steps", "1e-2,1e-7", "--until", "50")
    code, out, err = interrupt(("compare", "pendulum", *words, "--json"), integrating, tmp_path)
    assert code == 130
    assert err.splitlines()[-1] == (
        "symgen: interrupted; the rows that were done are shown; with --resume FILE they would have been stored"
    )
    assert [row["step"] for row in json.loads(out)["rows"]] == [1e-2]


# -- pipes and terminals -----------------------------------------------------------------------------------------------


@pytest.mark.slow
def test_a_closed_pipe_is_no_error():
    command = f"{sys.executable} -c 'from symgen.cli import main; raise SystemExit(main())' inspect n-four-bar:8"
    found = subprocess.run(["bash", "-c", f"{command} | head -1"], capture_output=True, text=True, timeout=600)
    assert found.stderr == "" and "n-four-bar-8" in found.stdout


def shown_on_a_terminal(*arguments: str, before: str = "", **environment: str) -> tuple[int, str, bytes]:
    """Return the code, standard output and what a command draws on standard error, which is a terminal."""
    leader, follower = pty.openpty()
    process = subprocess.Popen(
        [sys.executable, "-c", f"{before}from symgen.cli import main; raise SystemExit(main())", *arguments],
        stdout=subprocess.PIPE,
        stderr=follower,
        text=True,
        env={**os.environ, "TERM": "xterm", "COLUMNS": "100", **environment},
    )
    os.close(follower)
    shown = b""
    while True:
        ready, _, _ = select.select([leader], [], [], 600)
        try:
            part = os.read(leader, 65536) if ready else b""
        except OSError:
            part = b""
        if not part:
            break
        shown += part
    out, _ = process.communicate(timeout=600)
    os.close(leader)
    return process.returncode, out, shown


@pytest.mark.slow
def test_a_long_run_shows_progress_on_a_terminal_only():
    """Standard error is a terminal, standard output a pipe: the bar is drawn, and JSON stays alone."""
    times = ("--until", "20000", "--output-step", "100")
    code, out, shown = shown_on_a_terminal("run", "pendulum", "--integrator", "rk4", *times, "--json")
    assert code == 0 and json.loads(out)["status"] == "ok"
    assert b"pendulum, direct-correction" in shown and b"%" in shown


@pytest.mark.slow
def test_a_first_run_says_that_it_compiles_before_anything_is_reached(tmp_path):
    """With an empty cache nothing is reached for seconds; what is done is drawn meanwhile, and goes away."""
    soon = "import symgen.cli._progress as p; p.PATIENCE = 0.05; "
    cache = str(tmp_path / "cache")
    words = ("run", "four-bar", "--until", "0.1", "--json")
    code, out, shown = shown_on_a_terminal(*words, before=soon, SYMGEN_CACHE_DIR=cache)
    assert code == 0 and json.loads(out)["status"] == "ok"
    assert b"four-bar, direct-correction: deriving and compiling" in shown
    assert shown.rstrip().endswith(b"\x1b[2K")  # the line is erased


@pytest.mark.slow
def test_the_interpreter_runs_the_command_line():
    done = subprocess.run([sys.executable, "-m", "symgen", "list", "--jsno"], capture_output=True, text=True)
    assert (done.returncode, done.stdout) == (2, "")
    assert "--json" in done.stderr
    listed = subprocess.run([sys.executable, "-m", "symgen", "list", "--json"], capture_output=True, text=True)
    assert listed.returncode == 0 and "four-bar" in listed.stdout

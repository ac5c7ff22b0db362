"""A disk that is full when a file is written: one sentence, exit code 2, and nothing is lost or left behind.

The disk is played by the system's limit for the size of files, beyond which writing fails as on a full disk.
"""

import json
import os
import subprocess
import sys

import pytest
from support.processes import python

pytest.importorskip("resource")

#: Does the work once without the limit (what is generated and compiled goes into the cache), then under it.
SCRIPT = """\
import json, resource, signal, sys
from symgen.cli import main
first, second, limit = json.loads(sys.argv[1])
assert first is None or main(first) == 0, "without a limit it works"
signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
resource.setrlimit(resource.RLIMIT_FSIZE, (limit, limit))
print("=====", file=sys.stderr, flush=True)
raise SystemExit(main(second))
"""
RUN = ("run", "four-bar", "--until", "1", "--json")
COMPARE = ("compare", "pendulum", "--methods", "lagrange", "--integrators", "rk4", "--steps", "0.01,0.005")
COMPARE += ("--until", "0.2", "--repeat", "1", "--jobs", "1", "--json")
SWEEP = ("sweep", "pendulum", "--vary", "bob.vy=lin(0,1,300)", "--until", "0.02", "--jobs", "1", "--json")
#: Command, option of the file, its name, and the largest file that the disk takes.
CASES = {
    "netcdf": (RUN, "--save", "a.nc", 20_000),
    "csv": (RUN, "--save", "a.csv", 20_000),
    "parquet": (RUN, "--save", "a.parquet", 20_000),
    "png": (RUN, "--plot", "a.png", 2_000),
    "svg": (RUN, "--plot", "a.svg", 2_000),
    "pdf": (RUN, "--plot", "a.pdf", 2_000),
    "rows": (COMPARE, "--csv", "rows.csv", 200),
    "page": (COMPARE, "-o", "page.html", 2_000),
    "markdown": (COMPARE, "-o", "page.md", 2_000),
    "sweep": (SWEEP, "-o", "sweep.nc", 100_000),
    "modules": (("generate", "four-bar", "--method", "lagrange"), "-o", "modules", 5_000),
    "template": (("new", "crane"), "-o", "crane.toml", 100),
}

#: What was in the file before; without the word of symgen's own files no command would write over a module.
OLD = "Emitted by symgen: what was there"

#: Files that are written as others are, and the longest.
LONGER = ("netcdf", "parquet", "page", "svg", "pdf", "markdown", "sweep")


def full(folder, command, option, name, limit):
    """Return exit code and what is said under the limit."""
    warm = None if command[0] == "new" else [*command, *(() if option == "--plot" else (option, f"warm-{name}"))]
    second = [*command, option, name]
    found = python(SCRIPT, json.dumps([warm, second, limit]), cwd=folder)
    return found.returncode, found.stdout, found.stderr.partition("=====\n")[2]


@pytest.mark.by_turns(3)
@pytest.mark.parametrize(
    ("command", "option", "name", "limit"),
    [pytest.param(*case, id=name, marks=pytest.mark.slow if name in LONGER else ()) for name, case in CASES.items()],
)
def test_one_sentence_and_nothing_lost(tmp_path, command, option, name, limit):
    old = tmp_path / name
    if command[0] == "generate":
        old.mkdir()
        old = old / "model.py"
    if command[0] != "new":
        old.write_text(OLD)
    code, out, err = full(tmp_path, command, option, name, limit)
    assert code == 2, err
    said = [line for line in err.splitlines() if line.startswith("symgen: ")]
    assert len(said) == len(err.splitlines()) == 1, err
    assert "a file that can be written, got File too large" in said[0] and name.partition(".")[0] in said[0]
    if command[0] == "new":
        assert not old.exists()
    else:
        assert old.read_text() == OLD
    if command[0] in ("run", "compare"):
        assert json.loads(out.splitlines()[-1])  # the result itself was given
    left = {p.name for p in tmp_path.rglob("*") if "warm-" not in str(p.relative_to(tmp_path))}
    expected = {name, "model.py"} if command[0] == "generate" else set() if command[0] == "new" else {name}
    if command[0] == "sweep":  # the runs are kept, and --resume writes them
        expected |= {"sweep.nc.parts", "sweep.json", "values.npy", "summary.npy", "done.txt", "lock"}
    assert left == expected


@pytest.mark.fast("list --json", "schema")
@pytest.mark.skipif(not os.path.exists("/dev/full"), reason="needs /dev/full")
@pytest.mark.parametrize("words", ["list --json", "schema", "check pendulum", "list"])
def test_standard_output_that_is_full(words):
    with open("/dev/full", "w") as target:
        found = subprocess.run(
            [sys.executable, "-c", "from symgen.cli import main; raise SystemExit(main())", *words.split()],
            stdout=target,
            stderr=subprocess.PIPE,
            text=True,
            timeout=600,
        )
    assert found.returncode == 1
    assert found.stderr == "symgen: standard output cannot be written (No space left on device)\n"

"""Rough edges for programs and terminals: defects D19 and D20."""

import os
import re
import signal
import subprocess
import sys
import time
import zipfile
from pathlib import Path

import pytest
from support.processes import python

import symgen
from benchmarks.mechanisms.toml import text
from verification.running import symgen as command

POINT = {"mechanism": {"name": "point"}, "bodies": {"b": {"type": "point", "mass": 1.0}}}


# -- D19: the cache ----------------------------------------------------------------------------------------------------

RUN = ["run", "pendulum", "--until", "0.01", "--step", "1e-3", "--json"]


def test_where_no_file_can_be_written_one_sentence_says_so(tmp_path: Path) -> None:
    """No file may grow beyond a few bytes, as on full disks: under the cache, and where temporary folders are.

    `tests/compile/store` lets the cache's own folder fail alone, and sees the temporary one take its place.
    """
    script = f"""
import resource, signal, sys
signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
resource.setrlimit(resource.RLIMIT_FSIZE, (2_000, 2_000))
from symgen.cli import main
sys.exit(main({RUN!r}))
"""
    done = python(script, cwd=tmp_path, env={**os.environ, "SYMGEN_CACHE_DIR": str(tmp_path / "cache")})
    assert done.returncode == 1
    lines = done.stderr.strip().splitlines()
    assert len(lines) == 1 and "cannot be written" in lines[0] and "SYMGEN_CACHE_DIR" in lines[0], done.stderr[-500:]


# -- D20: terminals, signals, archives ---------------------------------------------------------------------------------


def test_an_unknown_type_is_quoted_short_and_harmless(tmp_path: Path) -> None:
    file = tmp_path / "type.toml"
    for kind in ("x" * 100_000, "a\nb", "\x1b[31m", "\x9b31m", "\u202e"):
        made = {**POINT, "joints": {"j": {"type": kind}}}
        file.write_text(text(made), encoding="utf-8")
        said = command(["check", file], tmp_path)
        assert said.code == 2 and said.sentence, said.err[:300]
        assert said.err.rstrip("\n").isprintable()


def test_a_title_reaches_terminals_and_pages_as_text(tmp_path: Path) -> None:
    title = "\x1b]0;owned\x07 <b>bold</b> | [link](x) \u202e"
    made = {**POINT, "mechanism": {"name": "titled", "title": title}, "run": {"until": 0.01, "step": 1e-3}}
    file = tmp_path / "titled.toml"
    file.write_text(text(made), encoding="utf-8")
    for words in (["check", file], ["inspect", file], ["run", file]):
        said = command(words, tmp_path)
        assert said.code == 0, said.err
        assert not set(said.out + said.err) & {"\x1b", "\x07", "\u202e"}
    words = ["compare", file, *"--methods lagrange --integrators rk4 --until 0.01 -o".split(), tmp_path / "r.md"]
    said = command(words, tmp_path)
    assert said.code == 0, said.err
    page = (tmp_path / "r.md").read_text(encoding="utf-8")
    assert not re.search(r"(?<!\\)<b>", page) and not set(page) & {"\x1b", "\x07", "\u202e"}


@pytest.mark.by_turns(2)
@pytest.mark.slow
def test_a_terminated_run_keeps_what_it_has(tmp_path: Path) -> None:
    """SIGTERM ends a run as Ctrl-C does: outputs until then are saved."""
    constant = ["run", "four-bar", "--integrator", "rk4", "--step", "1e-4"]
    words = [*constant, "--until", "100000", "--output-step", "1", "--save", "kept.nc"]
    command([*constant, "--until", "0.01"], tmp_path)  # compiled beforehand
    script = "import sys; from symgen.cli import main; print('ready', flush=True); sys.exit(main(sys.argv[1:]))"
    for pause in (3.0, 12.0, 96.0):  # a busy machine may not have begun to run after the first
        process = subprocess.Popen(
            [sys.executable, "-c", script, *words], cwd=tmp_path, stdout=subprocess.PIPE, text=True
        )
        assert process.stdout is not None and process.stdout.readline() == "ready\n"
        time.sleep(pause)
        process.send_signal(signal.SIGTERM)
        process.communicate()
        assert process.returncode in (130, 143)
        if (tmp_path / "kept.nc").exists():
            return
    raise AssertionError("outputs were not saved")


@pytest.mark.slow
def test_a_run_in_a_thread_of_asyncio_ends_when_it_is_told_to(tmp_path: Path) -> None:
    """Ctrl-C reaches the main thread alone; what is called with the progress ends a run in another one by raising."""
    script = """
import asyncio, threading, symgen
ended = threading.Event()
def watch(time):
    if ended.is_set():
        raise KeyboardInterrupt
model = symgen.load("four-bar")
model.simulate(integrator="rk4", until=0.01, step=1e-4)
async def main():
    print("ready", flush=True)
    try:
        await asyncio.to_thread(
            model.simulate, integrator="rk4", until=1e7, step=1e-4, output_step=1e4, progress=watch
        )
    finally:
        ended.set()
asyncio.run(main())
"""
    process = subprocess.Popen(
        [sys.executable, "-c", script], cwd=tmp_path, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
    )
    assert process.stdout is not None and process.stdout.readline() == "ready\n"
    time.sleep(2.0)
    process.send_signal(signal.SIGINT)
    try:
        process.communicate(timeout=120)
    finally:
        process.kill()
        process.communicate()
    assert process.returncode != 0


@pytest.mark.slow
def test_the_catalogue_is_found_in_an_archive(tmp_path: Path) -> None:
    package = Path(symgen.__file__).parent
    archive = tmp_path / "symgen.zip"
    with zipfile.ZipFile(archive, "w") as file:
        for path in sorted(package.rglob("*")):
            if path.is_file() and "__pycache__" not in path.parts:
                file.write(path, Path("symgen") / path.relative_to(package))
    script = "import symgen; print(symgen.load('four-bar').name, symgen.load('n-four-bar:2').name, symgen.__file__)"
    done = subprocess.run(
        [sys.executable, "-c", script],
        capture_output=True,
        text=True,
        cwd=tmp_path,
        env={**os.environ, "PYTHONPATH": str(archive)},
        check=False,
    )
    assert done.returncode == 0, done.stderr[-500:]
    assert "symgen.zip" in done.stdout and "four-bar" in done.stdout

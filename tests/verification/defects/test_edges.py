"""Rough edges for programs and terminals: defects D18 to D20."""

from __future__ import annotations

import copy
import os
import pickle
import re
import signal
import subprocess
import sys
import time
import zipfile
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from support.processes import python

import symgen
from benchmarks.mechanisms.toml import text
from verification.running import symgen as command

POINT = {"mechanism": {"name": "point"}, "bodies": {"b": {"type": "point", "mass": 1.0}}}


@pytest.fixture(scope="module")
def result():
    return symgen.load("pendulum").simulate(until=0.05, step=1e-3)


# -- D18: programs -----------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("duplicate", [lambda r: pickle.loads(pickle.dumps(r)), copy.deepcopy], ids=["pickle", "copy"])
def test_results_travel(result, duplicate: Callable) -> None:
    again = duplicate(result)
    assert again.to_json() == result.to_json()
    for name, table in result.tables().items():
        np.testing.assert_array_equal(np.asarray(again.tables()[name]), np.asarray(table))


@pytest.mark.parametrize("duplicate", [lambda r: pickle.loads(pickle.dumps(r)), copy.deepcopy], ids=["pickle", "copy"])
def test_compiled_models_travel(duplicate: Callable) -> None:
    model = symgen.load("pendulum")
    compiled = duplicate(model.compile("lagrange"))
    start = model.assemble(compiled)
    np.testing.assert_array_equal(start.y, model.assemble(model.compile("lagrange")).y)


def simulate(**settings):
    return lambda: symgen.load("pendulum").simulate(**{"until": 0.01, "step": 1e-3, **settings})


MISUSES: dict[str, Callable[[], object]] = {
    "options a list": simulate(options=["method.alpha"]),
    "options a text": simulate(options="method.alpha=1"),
    "option of no method": simulate(options={"alpha.beta": 1}),
    "option that is no number": simulate(method="baumgarte", options={"method.alpha": "fast"}),
    "option None": simulate(method="baumgarte", options={"method.alpha": None}),
    "method a number": simulate(method=3),
    "method None": simulate(method=None),
    "integrator a number": simulate(integrator=4.5),
    "integrator a class": simulate(integrator=dict),
    "shape a number": simulate(shape=1),
    "until a text": simulate(until="long"),
    "until None of a list": simulate(until=[1.0]),
    "until nan": simulate(until=float("nan")),
    "step a text": simulate(step="1e-3"),
    "step beyond the end": simulate(step=1.0),
    "step a complex": simulate(step=1j),
    "rtol a text": simulate(rtol="tight"),
    "times a text": simulate(times="0 1"),
    "times a number": simulate(times=1.0),
    "times falling": simulate(times=[1.0, 0.0]),
    "times nested": simulate(times=[[0.0, 1.0]]),
    "times None inside": simulate(times=[0.0, None]),
    "parameters a list": simulate(parameters=[1.0]),
    "parameter callable": lambda: symgen.load("four-bar").simulate(until=0.01, parameters={"crank_mass": lambda: 2.0}),
    "parameter a text": lambda: symgen.load("four-bar").simulate(until=0.01, parameters={"crank_mass": "2"}),
    "parameter None": lambda: symgen.load("four-bar").simulate(until=0.01, parameters={"crank_mass": None}),
    "parameter a list": lambda: symgen.load("four-bar").simulate(until=0.01, parameters={"crank_mass": [2.0]}),
    "parameter of a number": lambda: symgen.load("four-bar").simulate(until=0.01, parameters={3: 2.0}),
    "repeat a text": simulate(repeat="often"),
    "repeat 0": simulate(repeat=0),
    "unknown setting": simulate(speed=3),
    "max_violation a text": simulate(max_violation="small"),
    "model a number": lambda: symgen.load(3),
    "model None": lambda: symgen.load(None),
    "model a folder": lambda: symgen.load(Path("/")),
    "compile a number": lambda: symgen.load("pendulum").compile(3),
    "compile options a text": lambda: symgen.load("pendulum").compile("direct-correction", "weight=mass"),
}


@pytest.mark.parametrize("misuse", MISUSES.values(), ids=MISUSES)
def test_misuse_from_python_gets_one_sentence(misuse: Callable[[], object]) -> None:
    with pytest.raises(symgen.InputError) as error:
        misuse()
    assert "\n" not in str(error.value) and "expected" in str(error.value)


@pytest.mark.parametrize(
    "asked",
    [lambda r: r["nothing"], lambda r: r.q[-1], lambda r: r.q[None], lambda r: r.reaction("nobody"), lambda r: r[3]],
)
def test_asking_a_result_for_what_it_has_not_gets_one_sentence(result, asked: Callable) -> None:
    with pytest.raises(symgen.InputError) as error:
        asked(result)
    assert "\n" not in str(error.value)


# -- D19: the cache ----------------------------------------------------------------------------------------------------

RUN = ["run", "pendulum", "--until", "0.01", "--step", "1e-3", "--json"]


def filled(cache: Path, folder: Path) -> str:
    said = command(RUN, folder, SYMGEN_CACHE_DIR=str(cache))
    assert said.code == 0, said.err
    return final(said.out)


def final(out: str) -> str:
    import json

    return json.dumps(json.loads(out)["final"])


def entries(cache: Path) -> list[Path]:
    return sorted(p for p in cache.rglob("*") if p.is_file() and p.stat().st_size > 0 and p.parent != cache)


SLOW = pytest.mark.slow


@pytest.mark.parametrize(
    "kind", ["fifo", *(pytest.param(k, marks=SLOW) for k in ("folder", "link to itself", "unreadable"))]
)
def test_something_else_in_place_of_an_entry_is_a_miss(kind: str, tmp_path: Path) -> None:
    cache = tmp_path / "cache"
    expected = filled(cache, tmp_path)
    for path in entries(cache):
        path.unlink()
        if kind == "fifo":
            os.mkfifo(path)
        elif kind == "folder":
            path.mkdir()
        elif kind == "link to itself":
            path.symlink_to(path.name)
        else:
            path.write_bytes(b"")
            path.chmod(0)
    assert filled(cache, tmp_path) == expected


@pytest.mark.slow
def test_a_file_in_place_of_a_folder_of_the_cache_is_no_obstacle(tmp_path: Path) -> None:
    cache = tmp_path / "cache"
    expected = filled(cache, tmp_path)
    for folder in [p for p in cache.iterdir() if p.is_dir()]:
        folder.rename(tmp_path / f"old-{folder.name}")
        folder.write_text("in the way", encoding="utf-8")
    assert filled(cache, tmp_path) == expected


def test_where_no_file_can_be_written_one_sentence_says_so(tmp_path: Path) -> None:
    """No file may grow beyond a few bytes, as on full disks: under the cache, and where temporary folders are.

    `tests/store` lets the cache's own folder fail alone, and sees the temporary one take its place.
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
    words = [
        "compare",
        file,
        "--methods",
        "lagrange",
        "--integrators",
        "rk4",
        "--until",
        "0.01",
        "-o",
        tmp_path / "r.md",
    ]
    said = command(words, tmp_path)
    assert said.code == 0, said.err
    page = (tmp_path / "r.md").read_text(encoding="utf-8")
    assert not re.search(r"(?<!\\)<b>", page) and not set(page) & {"\x1b", "\x07", "\u202e"}


def test_a_terminated_run_keeps_what_it_has(tmp_path: Path) -> None:
    """SIGTERM ends a run as Ctrl-C does: outputs until then are saved."""
    words = ["run", "four-bar", "--until", "100000", "--step", "1e-4", "--output-step", "1", "--save", "kept.nc"]
    command(["run", "four-bar", "--until", "0.01", "--step", "1e-4"], tmp_path)  # compiled beforehand
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


def test_a_run_in_a_thread_of_asyncio_ends_when_it_is_told_to(tmp_path: Path) -> None:
    """Ctrl-C reaches the main thread alone; what is called with the progress ends a run in another one by raising."""
    script = """
import asyncio, threading, symgen
ended = threading.Event()
def watch(time):
    if ended.is_set():
        raise KeyboardInterrupt
model = symgen.load("four-bar")
model.simulate(until=0.01, step=1e-4)
async def main():
    print("ready", flush=True)
    try:
        await asyncio.to_thread(model.simulate, until=1e7, step=1e-4, output_step=1e4, progress=watch)
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


def test_a_step_beyond_the_end_is_refused_everywhere(tmp_path: Path) -> None:
    said = command(["run", "pendulum", "--until", "0.1", "--step", "1"], tmp_path)
    assert said.code == 2 and said.sentence, (said.code, said.err)

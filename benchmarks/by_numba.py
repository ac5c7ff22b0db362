"""Runs, looped code and sweeps by Numba beside those by symgen's own compiler, over the catalogue.

    python -m benchmarks.by_numba                              table of its page, from the record
    python -m benchmarks.by_numba MODEL ... [--only run|looped|sweep]
    python -m benchmarks.records by_numba [--seconds S]        measures what the record lacks

Each compiler has a process with ``SYMGEN_COMPILER=numba`` or without it and an empty cache: processor time to the
result, and the largest difference of states over their largest value. A run is the first tenth of a scene with the
settings of ``symgen run``. Where states differ by more than 1e-9, symgen's own compiler repeats it with parameters that
have other last digits, or without any with its fastest speed at the start: what amplifies rounding answers that as
well. The record has a run of every scene: in processes that have run others before, as the loops of all scenes are the
same, and a few in processes of their own, where ``again`` is a second one with the same cache.
"""

from __future__ import annotations

import argparse
import json
import os
import random
import signal
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from functools import partial
from statistics import median
from typing import Any, NamedTuple

import numpy as np
from rich.table import Table

from benchmarks.page_tables import PageTable, list_of, number, print_tables, two_digits
from benchmarks.records import Line, Pair, Record
from benchmarks.show import show
from symgen.describe.catalogue import all_names, names

PAGE = "docs/tables/numba.md"
#: Processor time of a process at most [s].
PATIENCE = 600.0
#: Largest difference of states over their largest value that is rounding, amplified by the motion.
ROUNDING = 1e-9
#: Larger ones are rounding as well if they are at most so many times that of a run with moved parameters.
AS_MOVED = 3.0
#: By how much the parameters of that run, or its fastest speed at the start, are moved, over their values.
MOVED = 2e-15
#: Scenes that have processes of their own as well, where Numba compiles the loops anew.
ALONE = ("andrews", "pendulum")
#: Processor time by Numba that the test of a day may take [s].
SHORT = 45.0
#: What a process computes, by kind; `run` has the settings of the scene, the others few constant steps.
KINDS = ("run", "looped", "sweep")
MEASURED = """
import contextlib, json, os, resource, sys, tempfile, time
resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
folder = contextlib.nullcontext(sys.argv[3]) if sys.argv[3:] else tempfile.TemporaryDirectory()
os.environ["SYMGEN_CACHE_DIR"] = folder.__enter__()
from symgen.api import load

def computed(name, kind):
    model = load(name)
    if kind in ("run", "moved"):
        by = float(sys.argv[2]) if kind == "moved" else 0.0
        parameters = {name: (1.0 + by) * value for name, value in model.parameters().items() if by and value}
        until, start = 0.1 * model.mechanism.defaults.until, {}
        if by and not parameters:
            speeds = model.simulate(until=until).v
            fastest = abs(speeds.values[0]).argmax()
            start = {speeds.names[fastest]: (1.0 + by) * speeds.values[0, fastest]}
        result = model.simulate(until=until, parameters=parameters, start=start)
        return [result.q.values.tolist(), result.v.values.tolist()], result.status
    step = model.mechanism.defaults.step or 1e-3
    settings = {"method": "direct-correction", "integrator": "rk4", "step": step, "until": 50 * step}
    settings["max_violation"] = 1.0
    if kind == "looped":
        result = model.simulate(**settings, times=[25 * step, 50 * step], shape="looped", verify=False)
        return [result.q.values.tolist(), result.v.values.tolist()], result.status
    number = next(iter(model.mechanism.parameters)).name
    value = model.parameters()[number]
    study = model.sweep({number: [value, 1.01 * value, 1.02 * value]}, **settings)
    table = study.to_dataframe().select_dtypes("number")
    return [table.drop(columns=[c for c in table if "seconds" in c]).to_numpy().tolist()], "ok"

print(json.dumps(time.process_time()), flush=True)
for line in sys.stdin:
    began = time.process_time()
    resource.setrlimit(resource.RLIMIT_CPU, (int(began) + int(sys.argv[1]), resource.RLIM_INFINITY))
    try:
        states, status = computed(*line.split())
    except Exception as error:
        states, status = None, f"{type(error).__name__}: {error}".splitlines()[0][:100]
    print(json.dumps([time.process_time() - began, states, status, "numba" in sys.modules]), flush=True)
folder.__exit__(None, None, None)
"""


class Computed(NamedTuple):
    """A process: its processor time [s], states by kind, status, and what it said where it has none."""

    seconds: float
    states: list[Any] | None
    status: str


class Job(NamedTuple):
    """A scene of the catalogue."""

    model: str


class Compiler:
    """A process that computes by one compiler, from an empty cache unless it is given one."""

    def __init__(self, name: str, *cache: str) -> None:
        self.name = name
        self.process = subprocess.Popen(
            [sys.executable, "-c", MEASURED, str(int(PATIENCE)), str(MOVED), *cache],
            env={**os.environ, "SYMGEN_COMPILER": name},
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.DEVNULL,
            text=True,
        )
        #: Processor time of the imports [s].
        self.start = float(self._answer() or 0.0)

    def _answer(self) -> Any:
        assert self.process.stdout is not None
        line = self.process.stdout.readline()
        return json.loads(line) if line else None

    def computed(self, name: str, kind: str) -> Computed:
        """Return processor time, states and status of a scene in this process."""
        if self.process.poll() is None and self.process.stdin is not None:
            self.process.stdin.write(f"{name} {kind}\n")
            self.process.stdin.flush()
            answer = self._answer()
            if answer is not None:
                assert answer[3] == (self.name == "numba"), "the compiler that was asked for"
                return Computed(*answer[:3])
        code = -self.process.wait()
        return Computed(PATIENCE, None, "too slow") if code == signal.SIGXCPU else Computed(0.0, None, f"signal {code}")

    def __enter__(self) -> Compiler:
        return self

    def __exit__(self, *of_error: object) -> None:
        self.process.communicate()


#: Processes that the scenes of a record share, by compiler.
LASTING = dict[str, Compiler]()


def lasting(name: str) -> Compiler:
    """Return the process of a compiler that all scenes of a record share, a new one where a scene has ended it."""
    if name not in LASTING or LASTING[name].process.poll() is not None:
        LASTING[name] = Compiler(name)
    return LASTING[name]


def alone(name: str, compiler: str, cache: str) -> float:
    """Return the processor time of a scene in a process of its own, imports among it [s]."""
    with Compiler(compiler, cache) as own:
        return own.start + own.computed(name, "run").seconds


def difference(one: list[Any], other: list[Any]) -> float:
    """Return the largest difference of positions or velocities over their largest value; infinite if not numbers."""
    worst = 0.0 if len(one) == len(other) else float("inf")
    for a, b in zip(map(np.array, one), map(np.array, other), strict=False):
        if a.shape != b.shape or not (np.isfinite(a).all() and np.isfinite(b).all()):
            return float("inf")
        worst = max(worst, float(np.max(np.abs(a - b)) / (np.max(np.abs(a)) or 1.0)))
    return worst


def apart(name: str, kind: str, one: Compiler, other: Compiler) -> dict[str, Any]:
    """Return processor times by both compilers [s], and the difference of states or what one of them said.

    A run whose states differ by more than `ROUNDING` has that of a run with moved parameters as well.
    """
    own, judge = one.computed(name, kind), other.computed(name, kind)
    found: dict[str, Any] = {"own": own.seconds, "numba": judge.seconds}
    if own.states is None or judge.states is None or own.status != judge.status:
        return found | {"says": own.status if own.status == judge.status else f"{own.status}; Numba: {judge.status}"}
    found |= {"status": own.status, "difference": difference(own.states, judge.states)}
    if kind == "run" and found["difference"] > ROUNDING:
        moved = one.computed(name, "moved")
        answered = difference(own.states, moved.states or [])
        found |= {"moved": answered} if np.isfinite(answered) else {}
    return found


def jobs() -> Iterator[Job]:
    """Yield all scenes, those studied with every method first."""
    yield from map(Job, dict.fromkeys((*names(), *all_names())))


def examine(job: Job) -> dict[str, Any]:
    """Return the processor times of the run of a scene by both compilers, and the difference of their states."""
    found = apart(job.model, "run", lasting(""), lasting("numba"))
    if job.model in ALONE:
        with tempfile.TemporaryDirectory() as one, tempfile.TemporaryDirectory() as other:
            times = [alone(job.model, name, folder) for name, folder in (("", one), ("", one), ("numba", other))]
        found["alone"] = times
    return found


def again(stored: Line, dice: random.Random) -> Iterator[Pair]:
    """Yield how a scene ended beside its end now."""
    with Compiler("") as one, Compiler("numba") as other:
        yield Pair(stored["model"], end_of(stored), end_of(apart(stored["model"], "run", one, other)))


def near(line: Line) -> bool:
    """Whether states of both compilers differ by rounding."""
    return line.get("difference") is not None and line["difference"] <= max(ROUNDING, AS_MOVED * line.get("moved", 0.0))


def end_of(line: Line) -> str:
    """Return how a scene ended, in words."""
    return str(line.get("died") or line.get("says") or (line["status"] if near(line) else "states differ"))


def page_table() -> PageTable:
    """Return processor times and differences by scene, from the record."""
    lines = {line["model"]: line for line in RECORD.lines()}

    def cells(model: str) -> Iterator[str]:
        line = lines[model]
        yield number(line["difference"]) if line.get("difference") is not None else end_of(line)
        yield from (two_digits(line[name]) if name in line else "" for name in ("own", "numba"))
        yield from map(two_digits, line.get("alone", ()))
        yield from [""] * (3 - len(line.get("alone", ())))

    rows = tuple(((f"`{job.model}`",), partial(list_of, cells, job.model)) for job in jobs() if job.model in lines)
    headings = ("scene", "difference", "own [s]", "Numba [s]", "own, alone", "again", "Numba, alone")
    return PageTable("by_numba", PAGE, headings, rows, stored=True, claims=claims)


def claims() -> Iterator[str]:
    """Yield what the page says of all scenes."""
    lines = RECORD.lines()
    largest = number(max((line["difference"] for line in lines if near(line)), default=0.0))
    yield f"{sum(map(near, lines))} of {len(lines)} scenes agree to rounding, the largest difference being {largest}."
    for line in lines:
        if near(line) and "moved" in line:
            far, moved = number(line["difference"]), number(line["moved"])
            yield f"`{line['model']}` amplifies rounding: {far} by compilers, {moved} by parameters moved by {MOVED:g}."
    ended = [line for line in lines if "difference" in line]
    if ended:
        own, other = (median(line[name] for line in ended) for name in ("own", "numba"))
        yield f"Medians, one scene after another: {own:.2g} s by the own compiler, {other:.2g} s by Numba."
    left = sum(1 for _ in jobs()) - len(lines)
    if left:
        yield f"Scenes not measured: {left}."


def main(arguments: list[str]) -> int:
    """Print the table of the record, or that of scenes measured now."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.by_numba")
    parser.add_argument("models", nargs="*")
    parser.add_argument("--only", choices=KINDS)
    given = parser.parse_args(arguments)
    if not given.models:
        return print_tables({"": page_table()}, [""])
    table = Table("model", "what", "own [s]", "Numba [s]", "difference")
    for name in given.models:
        for kind in (given.only,) if given.only else KINDS:
            with Compiler("") as one, Compiler("numba") as other:
                found = apart(name, kind, one, other)
            end = f"{found['difference']:.0e}" if "difference" in found else found["says"]
            table.add_row(name, kind, f"{found['own']:.1f}", f"{found['numba']:.1f}", end)
            print(f"{name}, {kind}: {end}", file=sys.stderr, flush=True)
    show(table)
    return 0


def is_short(stored: Line) -> bool:
    """Whether Numba takes seconds: the test of a day draws from these."""
    return float(stored.get("numba", PATIENCE)) <= SHORT


RECORD = Record("by_numba", jobs, examine, again, 2.0 * PATIENCE, share=0.01, daily=is_short)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))

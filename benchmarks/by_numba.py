"""Runs, looped code and sweeps by Numba beside those by symgen's own compiler, over the catalogue.

    python -m benchmarks.by_numba                       table of its page, from the record
    python -m benchmarks.by_numba MODEL ... [--only run|looped|sweep]
    python -m benchmarks.records by_numba --workers N   measures what the record lacks: about 25 s a scene

Each is a process of its own with ``SYMGEN_COMPILER=numba`` or without it, from an empty cache: processor time to the
result, and the largest difference of states over their largest value. The record has a run of every scene.
"""

from __future__ import annotations

import argparse
import json
import os
import random
import resource
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from functools import partial
from statistics import median
from typing import Any, NamedTuple

import numpy as np
from rich.table import Table

from benchmarks.page_tables import PageTable, list_of, number, print_tables
from benchmarks.records import Line, Pair, Record
from benchmarks.show import show
from symgen.describe.catalogue import all_names, names

PAGE = "docs/measured/numba.md"
#: Processor time of a scene at most [s].
PATIENCE = 600.0
#: Largest difference of states over their largest value that is rounding.
ROUNDING = 1e-9

#: What a process computes, by kind: short runs at constant steps, so that rounding does not choose steps.
KINDS = ("run", "looped", "sweep")
MEASURED = """
import json, sys
import numpy as np
from symgen.api import load
name, kind = sys.argv[1:]
model = load(name)
step = model.mechanism.defaults.step or 1e-3
settings = {"method": "direct-correction", "integrator": "rk4", "step": step, "until": 50 * step, "max_violation": 1.0}
if kind == "sweep":
    number = next(iter(model.mechanism.parameters)).name
    value = model.parameters()[number]
    study = model.sweep({number: [value, 1.01 * value, 1.02 * value]}, **settings)
    table = study.to_dataframe().select_dtypes("number")
    states = table.drop(columns=[c for c in table if "seconds" in c]).to_numpy().tolist()
else:
    shape = {"run": "straight", "looped": "looped"}[kind]
    result = model.simulate(**settings, times=[25 * step, 50 * step], shape=shape, verify=False)
    states = np.hstack([result.q.values, result.v.values]).tolist()
print(json.dumps({"states": states, "numba": "numba" in sys.modules}))
"""


def computed(name: str, kind: str, compiler: str) -> tuple[float, Any, str]:
    """Return processor time of a process [s], its states, and what it said where it has none."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    with tempfile.TemporaryDirectory() as cache:
        environment = {**os.environ, "SYMGEN_CACHE_DIR": cache, "SYMGEN_COMPILER": compiler}
        words = [sys.executable, "-c", MEASURED, name, kind]
        done = subprocess.run(words, env=environment, capture_output=True, text=True, check=False)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    seconds = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    if done.returncode != 0:
        return seconds, None, done.stderr.strip().splitlines()[-1][:100]
    found = json.loads(done.stdout.splitlines()[-1])
    assert found["numba"] == (compiler == "numba"), "the compiler that was asked for"
    return seconds, np.array(found["states"], dtype=float), ""


class Job(NamedTuple):
    """A scene of the catalogue."""

    model: str


def jobs() -> Iterator[Job]:
    """Yield all scenes, studied ones first."""
    yield from map(Job, dict.fromkeys((*names(), *all_names())))


def apart(name: str, kind: str) -> dict[str, Any]:
    """Return processor times by both compilers [s] and the difference, or what one of them said."""
    own, states, why = computed(name, kind, "")
    if states is None:
        return {"own": own, "says": why}
    other, again, why = computed(name, kind, "numba")
    if again is None:
        return {"own": own, "numba": other, "says": why}
    difference = float(np.nanmax(np.abs(states - again)) / np.nanmax(np.abs(states)))
    return {"own": own, "numba": other, "difference": difference}


def examine(job: Job) -> dict[str, Any]:
    """Return what both compilers take for a run of a scene, and how far they are apart."""
    return apart(job.model, "run")


def again(stored: Line, dice: random.Random) -> Iterator[Pair]:
    """Yield whether states of a scene are still within rounding, or what was said."""
    found = apart(stored["model"], "run")
    yield Pair(stored["model"], says_of(stored), says_of(found))


def says_of(line: Line) -> str:
    """Return how a scene ended, in words."""
    near = "within rounding" if line.get("difference", 1.0) <= ROUNDING else "apart"
    return str(line.get("died") or line.get("says") or near)


def page_table() -> PageTable:
    """Return seconds and differences by scene, from the record."""
    lines = {line["model"]: line for line in RECORD.lines()}

    def cells(model: str) -> Iterator[str]:
        line = lines[model]
        yield from (f"{line[name]:.1f}" if name in line else "" for name in ("own", "numba"))
        yield number(line["difference"]) if "difference" in line else says_of(line)

    rows = tuple(((f"`{job.model}`",), partial(list_of, cells, job.model)) for job in jobs() if job.model in lines)
    headings = ("scene", "own compiler [s]", "Numba [s]", "difference")
    return PageTable("by_numba", PAGE, headings, rows, stored=True, claims=claims)


def claims() -> Iterator[str]:
    """Yield what the page says of all scenes."""
    lines = RECORD.lines()
    ended = [line for line in lines if "difference" in line]
    near = sum(says_of(line) == "within rounding" for line in ended)
    yield f"{near} of {len(lines)} scenes agree to {ROUNDING:.0e}".replace("e-0", "e-") + "."
    if ended:
        times = [median(line[name] for line in ended) for name in ("own", "numba")]
        yield f"Median to the first result: {times[0]:.1f} s by the own compiler, {times[1]:.0f} s by Numba."
    left = [f"`{job.model}`" for job in jobs() if job.model not in {line["model"] for line in lines}]
    if left:
        yield f"Not measured: {', '.join(left)}."


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
            found = apart(name, kind)
            difference = f"{found['difference']:.0e}" if "difference" in found else found["says"]
            table.add_row(name, kind, f"{found['own']:.1f}", f"{found.get('numba', 0.0):.1f}", difference)
            print(f"{name}, {kind}: {difference}", file=sys.stderr, flush=True)
    show(table)
    return 0


RECORD = Record("by_numba", jobs, examine, again, PATIENCE, share=0.01)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))

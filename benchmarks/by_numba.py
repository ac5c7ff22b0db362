"""Runs, looped code and sweeps by Numba beside those by symgen's own compiler, over the catalogue.

    python -m benchmarks.by_numba [MODEL ...] [--only run|looped|sweep]

Each is a process of its own with ``SYMGEN_COMPILER=numba`` or without it, from an empty cache: processor time to the
result, and the largest difference of states over their largest value.
"""

from __future__ import annotations

import argparse
import json
import os
import resource
import subprocess
import sys
import tempfile
from typing import Any

import numpy as np
from rich.table import Table

from benchmarks.show import show
from symgen.describe.catalogue import names

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


def main(arguments: list[str]) -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.by_numba")
    parser.add_argument("models", nargs="*")
    parser.add_argument("--only", choices=KINDS)
    given = parser.parse_args(arguments)
    table = Table("model", "what", "own [s]", "Numba [s]", "difference")
    worst = 0.0
    for name in given.models or names():
        for kind in (given.only,) if given.only else KINDS:
            own, states, why = computed(name, kind, "")
            other, again, says = computed(name, kind, "numba") if states is not None else (0.0, None, why)
            if states is None or again is None:
                table.add_row(name, kind, f"{own:.1f}", f"{other:.1f}", says)
                continue
            difference = float(np.nanmax(np.abs(states - again)) / np.nanmax(np.abs(states)))
            worst = max(worst, difference)
            print(f"{name}, {kind}: {difference:.0e}", file=sys.stderr, flush=True)
            table.add_row(name, kind, f"{own:.1f}", f"{other:.1f}", f"{difference:.0e}")
    show(table)
    print(f"largest difference: {worst:.1e}")


if __name__ == "__main__":
    main(sys.argv[1:])

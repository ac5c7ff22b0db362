"""Runs of two checkouts in turns: processor times of the same runs, their ratio, and whether states have the same bits.

    python -m benchmarks.checkouts OTHER [MODEL ...] [--integrator rk4] [--method NAME] [--coordinates joint]
                                [--shape looped]
    python -m benchmarks.checkouts OTHER [MODEL ...] --operations [--method NAME] [--coordinates joint]

Each measurement is a process of its own, which imports symgen from its checkout; the smallest time of some runs counts,
and of several rounds in turns the least ratio of this checkout to the other, as other work only adds to either. With
--operations nothing runs: the emitted functions say how many operations a right-hand side takes, and what follows an
accepted step with one round of its correction.
"""

from __future__ import annotations

import argparse
import json
import os
import subprocess
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
from rich.table import Table

from benchmarks.show import show

ROOT = Path(__file__).resolve().parents[1]
MODELS = (
    *("four-bar", "slider-crank", "andrews", "n-four-bar:10", "spatial-slider-crank", "bricard", "front-suspension"),
    *("jansen-leg", "stewart-platform", "free-rigid-body", "chain:10", "driven-four-bar"),
)
#: Constant steps [s] of mechanisms that move faster than most.
STEPS = {"andrews": 1e-5, "front-suspension": 1e-4}
COUNT, REPEATS, ROUNDS = 1000, 30, 3
#: What a process measures: the least processor time of a run [s], and the bits of its states.
MEASURED = """
import hashlib, json, sys
from symgen.api import load
name, method, integrator, coordinates, shape, step, count, repeats = *sys.argv[1:6], *map(float, sys.argv[6:])
options = {"step": step} if integrator == "rk4" else {"rtol": 1e-9}
options |= {"method": method, "integrator": integrator, "coordinates": coordinates, "shape": shape}
settings = {"until": step * count, "output_step": step * count, **options}
model = load(name)
runs = [model.simulate(**settings, verify=False, max_violation=1.0) for _ in range(int(repeats))]
states = b"".join(getattr(runs[0], table).values.tobytes() for table in ("q", "v"))
digest = hashlib.sha256(states).hexdigest()
print(json.dumps([min(run.outcome.cpu_seconds for run in runs), digest, runs[0].status]))
"""

#: What a process counts: operations of a right-hand side and of `accept`, each with the functions that it calls once.
COUNTED = r"""
import json, re, sys, tempfile
from pathlib import Path
from symgen.api import load
name, method, coordinates = sys.argv[1:]
own, calls = {}, {}
with tempfile.TemporaryDirectory() as folder:
    load(name).generate(folder, [method], coordinates=coordinates)
    for module in ("model", method.replace("-", "_")):
        text = Path(folder, module + ".py").read_text(encoding="utf-8")
        for function, body in re.findall(r"^def (\w+)\(.*?\):\n(.*?)(?=^\S|\Z)", text, re.M | re.S):
            says = re.search(r": (\d+) operations", body)
            own[function] = int(says[1]) if says else 0
            calls[function] = re.findall(r"^(?! *#).*?\b(\w+)\(", body, re.M)
def total(function):
    return own.get(function, 0) + sum(map(total, calls.get(function, ())))
print(json.dumps([total("rhs"), total("accept")]))
"""


def counted(checkout: Path, name: str, method: str, coordinates: str) -> tuple[int, int]:
    """Return the operations of a right-hand side, and those after an accepted step, of a checkout's emitted code."""
    rhs, accept = answer(checkout, COUNTED, name, method, coordinates)
    return rhs, accept


def answer(checkout: Path, script: str, *words: str) -> Any:
    """Return the last line of a script's output as JSON; its process imports symgen from a checkout."""
    command = [sys.executable, "-c", script, *words]
    environment = {**os.environ, "PYTHONPATH": str(checkout)}
    done = subprocess.run(command, env=environment, cwd=checkout, capture_output=True, text=True, check=True)
    return json.loads(done.stdout.splitlines()[-1])


def measure(checkout: Path, name: str, *how: str) -> tuple[float, str, str]:
    """Return processor time [s], digest of the states and status of a run in a checkout.

    Parameters
    ----------
    checkout : Path
        Its folder.
    name : str
        Mechanism of the catalogue.
    *how : str
        Method, integrator, coordinates and shape of the code.
    """
    seconds, digest, status = answer(checkout, MEASURED, name, *how, *map(str, (STEPS.get(name, 1e-3), COUNT, REPEATS)))
    return seconds, digest, status


def operations(other: Path, models: Sequence[str], method: str, coordinates: str) -> Table:
    """Return the table of operations in both checkouts."""
    table = Table("model", "rhs, other", "this", "accept, other", "this")
    for name in models:
        pairs = zip(*(counted(checkout, name, method, coordinates) for checkout in (other, ROOT)), strict=True)
        table.add_row(name, *(str(number) for pair in pairs for number in pair))
    return table


def main(arguments: list[str]) -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.checkouts")
    parser.add_argument("other", type=Path)
    parser.add_argument("models", nargs="*")
    parser.add_argument("--integrator", default="rk4", choices=("rk4", "dop853"))
    parser.add_argument("--method", default="direct-correction")
    parser.add_argument("--coordinates", default="auto")
    parser.add_argument("--shape", default="auto", choices=("auto", "straight", "looped"))
    parser.add_argument("--operations", action="store_true")
    given = parser.parse_args(arguments)
    if given.operations:
        show(operations(given.other.resolve(), given.models or MODELS, given.method, given.coordinates))
        return
    how = given.method, given.integrator, given.coordinates, given.shape
    table = Table("model", "other [ms]", "this [ms]", "ratio", "bits")
    ratios = list[float]()
    for name in given.models or MODELS:
        rounds = [[measure(checkout, name, *how) for checkout in (given.other.resolve(), ROOT)] for _ in range(ROUNDS)]
        before, after = (min(pair[i][0] for pair in rounds) for i in (0, 1))
        ratios.append(after / before)
        same = "same" if len({one[1] for pair in rounds for one in pair}) == 1 else "differ"
        table.add_row(name, f"{1e3 * before:.3f}", f"{1e3 * after:.3f}", f"{after / before:.3f}", same)
    show(table)
    print(f"geometric mean of the ratios: {np.exp(np.mean(np.log(ratios))):.3f}")


if __name__ == "__main__":
    main(sys.argv[1:])

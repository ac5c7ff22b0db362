"""Compile time of straight code by its operations: right-hand sides of chains of hinges, 1000 to 20,000 operations.

    python -m benchmarks.compile_time

Prints processor time from the emitted text of a right-hand side to machine code, the slope of its logarithm, and what
blocks cost: time of an evaluation of code in blocks over that of the same code as one, where both compile.
"""

from __future__ import annotations

import json
import os
import subprocess
import sys
import tempfile
import time
from statistics import median
from typing import Any

import numpy as np

from benchmarks.against_gcc import _repeat_emitted
from benchmarks.trees import Limb, limb_of, mechanism
from symgen.api import Model
from symgen.compile.native import machine
from symgen.run.compiling.choices import count_rhs_operations, mechanism_on_tree
from symgen.run.compiling.method_choice import choose_method
from symgen.run.compiling.pipeline import compile_model
from symgen.run.layout import abi
from symgen.run.layout import ensemble_abi as e
from symgen.run.layout.probe import Ready

LINKS = (8, 10, 14, 20, 28, 40, 66)
REPEATS, TURNS = 3, 15


def chain(links: int) -> list[Limb]:
    """Return a tree with a branch at every third link, so that operations grow about as fast as links."""
    limbs = list[Limb]()
    for k in range(links):
        parent = "" if k == 0 else f"link{k - 1 if k % 3 else max(0, k // 2 - 1)}"
        limbs.append(limb_of(f"link{k}", parent, "zyx"[k % 3], (0.3, 0.0, 0.1), 100 + k))
    return limbs


def measured(links: int, longest: int, turns: int) -> tuple[int, float, list[float]]:
    """Return operations, seconds of the processor, and seconds of an evaluation, of a process with an empty cache."""
    with tempfile.TemporaryDirectory() as folder:
        command = [sys.executable, "-m", "benchmarks.compile_time", "--one", str(links), str(longest), str(turns)]
        environment = {**os.environ, "SYMGEN_CACHE_DIR": folder}
        output = subprocess.run(command, check=True, capture_output=True, text=True, env=environment).stdout
    answer = json.loads(output)
    return answer["operations"], answer["compile"], answer["evaluation"]


def one(links: int, longest: int, turns: int) -> None:
    """Print what `measured` returns."""
    machine.LARGEST_BLOCK = longest or machine.LARGEST_BLOCK
    carried = mechanism_on_tree(mechanism(f"chain-{links}", chain(links)))
    model = compile_model(carried, choose_method("lagrange"))
    p = model.parameter_array(Model(carried).parameters(), {})
    y = np.linspace(0.1, 0.9, model.info.ny)
    arrays = [y, p, model.scratch(), np.zeros(abi.N_COUNTERS, dtype=np.int64), np.zeros(model.info.ny)]
    Ready(model.model.prepare, e.PREPARE)(p)  # what every process loads once
    repeat: Any = _repeat_emitted
    began = time.process_time()
    Ready(model.law_module.rhs, abi.RHS)(0.0, *arrays)
    seconds, count, seconds_of_parts = time.process_time() - began, count_rhs_operations(carried), list[float]()
    calls = max(200, int(4e6 / count))
    for _ in range(turns):
        start = time.perf_counter()
        repeat(model.law_module.rhs, *arrays, calls)
        seconds_of_parts.append((time.perf_counter() - start) / calls)
    print(json.dumps({"operations": count, "compile": seconds, "evaluation": seconds_of_parts}))


def main() -> None:
    """Print a line a chain."""
    if sys.argv[1:2] == ["--one"]:
        one(*(int(x) for x in sys.argv[2:]))
        return
    sizes, times = list[int](), list[float]()
    for links in LINKS:
        shipped = [measured(links, 0, 1) for _ in range(REPEATS)]
        sizes.append(shipped[0][0])
        times.append(min(x[1] for x in shipped))
        blocks, whole = ([measured(links, longest, TURNS) for _ in range(REPEATS)] for longest in (1, 10**9))
        ratios = [min(a[2]) / min(b[2]) for a, b in zip(blocks, whole, strict=True)]
        print(
            f"{sizes[-1]:6d} operations: {times[-1]:.3f} s as shipped, {min(x[1] for x in whole):.3f} s as one block; "
            f"in blocks / as one {median(ratios):.3f} ({min(ratios):.3f} to {max(ratios):.3f})"
        )
    slope = float(np.polyfit(np.log(sizes), np.log(times), 1)[0])
    print(f"slope of log(compile time) by log(operations): {slope:.2f}")


if __name__ == "__main__":
    main()

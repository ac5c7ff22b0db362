"""One right-hand-side evaluation: the emitted module against the same equations as C, compiled with gcc.

Both sides get the same straight-line program, the same calling convention (a call through a pointer for each
evaluation) and the same liberty, contraction to fused multiply-add. The two are timed in turns, several times.

    python -m benchmarks.against_gcc [MODEL ...]
"""

from __future__ import annotations

import ctypes
import re
import shutil
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path
from typing import Any

import numpy as np
from rich.console import Console
from rich.table import Table

from symgen.api import load
from symgen.compiling.pipeline import choose_method
from symgen.emit.printer import ElementAccess, Printer
from symgen.formulate.formulate import formulate
from symgen.ir.program import Block, ModelLayout
from symgen.lower.law import lower_law
from symgen.lower.model import lower_model
from symgen.native import types
from symgen.runtime import abi
from symgen.store.jit import jit

FLAGS = ("-O3", "-march=native", "-ffp-contract=fast", "-fno-math-errno", "-shared", "-fPIC")
REPEATS = 15

_A, _I = types.float64[::1], types.int64[::1]


@jit(types.float64(abi.RHS, _A, _A, _A, _I, _A, types.int64))
def _repeat_emitted(rhs: Any, y: Any, p: Any, w: Any, iw: Any, ydot: Any, count: int) -> float:
    for _ in range(count):
        rhs(0.0, y, p, w, iw, ydot)
        y[0] += 1e-300 * ydot[0]
    return float(ydot[0])


def c_function(block: Block, layout: ModelLayout) -> str:
    """Return `block` as a C function with a loop beside it that calls it through a pointer."""
    lines = Printer(block, ElementAccess(layout, {})).lines()
    body = [f"    const __auto_type {_c(line)};" for line in (*lines.inputs, *lines.terms)]
    body += [f"    {_c(line)};" for line in lines.outputs]
    return "\n".join(
        [
            "#include <math.h>",
            "long evaluate(double t, const double *y, const double *p, double *w, long *iw, double *ydot)",
            "{",
            *body,
            f"    return {_c(lines.flag or '0')};",
            "}",
            "typedef long (*rhs_t)(double, const double *, const double *, double *, long *, double *);",
            "double repeat(rhs_t volatile given, double *y, double *p, double *w, long *iw, double *ydot, long n)",
            "{",
            "    rhs_t rhs = given;",
            "    for (long k = 0; k < n; k++) { rhs(0.0, y, p, w, iw, ydot); y[0] += 1e-300*ydot[0]; }",
            "    return ydot[0];",
            "}",
        ]
    )


def _c(line: str) -> str:
    if " if " in line or "**" in line or "table_" in line:
        raise ValueError(f"this benchmark's models have no such term: {line}")
    return re.sub(r"math\.", "", line.split("  #")[0]).replace("abs(", "fabs(")


def compare(model: str) -> tuple[float, float, list[float]]:
    """Return nanoseconds of the emitted module and of gcc, and the ratio of each round."""
    mechanism = load(model)
    choice = choose_method("lagrange")
    compiled = mechanism.compile("lagrange")
    start = mechanism.assemble(compiled)
    equations = formulate(mechanism.mechanism)
    program = lower_model(equations, "")
    law = lower_law(equations, program, choice.method, choice.options)
    block = next(b for b in law.blocks if b.name == "rhs")
    y, p, w = start.y.copy(), start.p.copy(), start.w.copy()
    iw, ydot = np.zeros(abi.N_COUNTERS, dtype=np.int64), np.zeros_like(y)
    with tempfile.TemporaryDirectory() as folder:
        source, library = Path(folder) / "rhs.c", Path(folder) / "rhs.so"
        source.write_text(c_function(block, law.layout), encoding="utf-8")
        subprocess.run(["gcc", *FLAGS, str(source), "-o", str(library), "-lm"], check=True)
        c = ctypes.CDLL(str(library))
        c.repeat.restype = ctypes.c_double
        pointers = [ctypes.c_void_p(a.ctypes.data) for a in (y, p, w, iw, ydot)]
        entry = ctypes.cast(c.evaluate, ctypes.c_void_p)
        _repeat_emitted(compiled.law_module.rhs, y, p, w, iw, ydot, 10)
        first = ydot.copy()
        c.repeat(entry, *pointers, ctypes.c_long(10))
        if not np.allclose(first, ydot, rtol=1e-9, atol=1e-9 * float(np.abs(first).max())):
            raise AssertionError(f"{model}: the two sides disagree")
        count = max(1000, int(2e7 / max(block.operations, 1) / 3))
        ours, theirs = [], []
        for _ in range(REPEATS):
            began = time.perf_counter()
            _repeat_emitted(compiled.law_module.rhs, y, p, w, iw, ydot, count)
            middle = time.perf_counter()
            c.repeat(entry, *pointers, ctypes.c_long(count))
            theirs.append((time.perf_counter() - middle) / count * 1e9)
            ours.append((middle - began) / count * 1e9)
    return min(ours), min(theirs), [a / b for a, b in zip(ours, theirs, strict=True)]


def main(models: list[str]) -> None:
    """Print the table."""
    if shutil.which("gcc") is None:
        print("no gcc on this machine: nothing to compare with")
        return
    table = Table(title="one right-hand side, emitted code against gcc -O3 -march=native")
    for column in ("model", "emitted [ns]", "gcc [ns]", "ratio of the best", "median ratio", "spread of the ratio"):
        table.add_column(column, justify="left" if column == "model" else "right")
    for model in models or ["four-bar", "slider-crank", "andrews", "n-four-bar:10"]:
        ours, theirs, ratios = compare(model)
        spread = f"{min(ratios):.2f} .. {max(ratios):.2f}"
        median = f"{statistics.median(ratios):.2f}"
        table.add_row(model, f"{ours:.1f}", f"{theirs:.1f}", f"{ours / theirs:.2f}", median, spread)
    Console().print(table)


if __name__ == "__main__":
    main(sys.argv[1:])

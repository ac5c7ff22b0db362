"""One right-hand-side evaluation: the emitted module against the same equations as C, compiled with gcc.

The C is that of `symgen generate --target c`, called through a pointer for each evaluation as the emitted function is.
The two are timed in turns, several times.

    python -m benchmarks.against_gcc [MODEL ...]
"""

from __future__ import annotations

import ctypes
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
from symgen.compile.native import types
from symgen.compile.native.c99 import c_functions
from symgen.compile.store.jit import jit
from symgen.run.compiling.checked import check_kernels
from symgen.run.layout import abi

#: As the README of the C target has it, and with the liberty that emitted code has.
FLAGS = {
    "-O2": ("-std=c99", "-O2", "-shared", "-fPIC"),
    "-O3 for this machine": ("-O3", "-march=native", "-ffp-contract=fast", "-fno-math-errno", "-shared", "-fPIC"),
}
REPEATS = 15

_A, _I = types.float64[::1], types.int64[::1]


@jit(types.float64(abi.RHS, _A, _A, _A, _I, _A, types.int64))
def _repeat_emitted(rhs: Any, y: Any, p: Any, w: Any, iw: Any, ydot: Any, count: int) -> float:
    for _ in range(count):
        rhs(0.0, y, p, w, iw, ydot)
        y[0] += 1e-300 * ydot[0]
    return float(ydot[0])


def source_of(function: Any) -> str:
    """Return a right-hand side as `symgen generate --target c` prints it, with a loop that calls it by its address."""
    return f"""#include <math.h>
typedef double real;
#define M(function) function
#define SMALL(x) x
#define LARGE(x) x
{c_functions({"rhs": function})}
typedef int (*rhs_t)(double, const double *, const double *, double *, int *, double *);
rhs_t volatile entry = (rhs_t)rhs;
double repeat(double *y, double *p, double *w, int *iw, double *ydot, long n)
{{
    rhs_t evaluate = entry;
    for (long k = 0; k < n; k++) {{ evaluate(0.0, y, p, w, iw, ydot); y[0] += 1e-300*ydot[0]; }}
    return ydot[0];
}}
"""


def compare(model: str, flags: tuple[str, ...]) -> tuple[float, float, list[float]]:
    """Return nanoseconds of the emitted module and of gcc with some flags, and the ratio of each round."""
    mechanism = load(model)
    compiled = mechanism.compile("lagrange")
    start = mechanism.assemble(compiled)
    function = check_kernels(compiled, ("rhs",))["rhs"]
    y, p, w = start.y.copy(), start.p.copy(), start.w.copy()
    iw, ydot = np.zeros(abi.N_COUNTERS, dtype=np.int64), np.zeros_like(y)
    with tempfile.TemporaryDirectory() as folder:
        source, library = Path(folder) / "rhs.c", Path(folder) / "rhs.so"
        source.write_text(source_of(function), encoding="utf-8")
        subprocess.run(["gcc", *flags, str(source), "-o", str(library), "-lm"], check=True)
        c = ctypes.CDLL(str(library))
        c.repeat.restype = ctypes.c_double
        counters = iw.astype(np.int32)
        pointers = [ctypes.c_void_p(a.ctypes.data) for a in (y, p, w, counters, ydot)]
        _repeat_emitted(compiled.law_module.rhs, y, p, w, iw, ydot, 10)
        first = ydot.copy()
        c.repeat(*pointers, ctypes.c_long(10))
        if not np.allclose(first, ydot, rtol=1e-9, atol=1e-9 * float(np.abs(first).max())):
            raise AssertionError(f"{model}: the two sides disagree")
        count = max(1000, int(2e7 / max(compiled.law.operations["rhs"], 1) / 3))
        ours, theirs = [], []
        for _ in range(REPEATS):
            began = time.perf_counter()
            _repeat_emitted(compiled.law_module.rhs, y, p, w, iw, ydot, count)
            middle = time.perf_counter()
            c.repeat(*pointers, ctypes.c_long(count))
            theirs.append((time.perf_counter() - middle) / count * 1e9)
            ours.append((middle - began) / count * 1e9)
    return min(ours), min(theirs), [b / a for a, b in zip(ours, theirs, strict=True)]


def main(models: list[str]) -> None:
    """Print the table."""
    if shutil.which("gcc") is None:
        print("no gcc on this machine: nothing to compare with")
        return
    for title, flags in FLAGS.items():
        table = Table(title=f"one right-hand side, emitted code against gcc {title}")
        for column in ("model", "emitted [ns]", "gcc [ns]", "gcc over emitted", "median ratio", "spread of the ratio"):
            table.add_column(column, justify="left" if column == "model" else "right")
        for model in models or ["four-bar", "slider-crank", "andrews", "bricard"]:
            ours, theirs, ratios = compare(model, flags)
            spread = f"{min(ratios):.2f} .. {max(ratios):.2f}"
            median = f"{statistics.median(ratios):.2f}"
            table.add_row(model, f"{ours:.1f}", f"{theirs:.1f}", f"{theirs / ours:.2f}", median, spread)
        Console().print(table)


if __name__ == "__main__":
    main(sys.argv[1:])

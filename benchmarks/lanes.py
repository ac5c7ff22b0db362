"""Several runs in the lanes of vector instructions: emitted functions for lanes beside those for single runs.

    python -m benchmarks.lanes [MODEL ...]

`benchmarks.sweeps` measures whole sweeps of four-bars in the same two ways.
"""

from __future__ import annotations

import statistics
import sys
import time
from collections.abc import Callable
from functools import partial
from typing import Any

import numpy as np
from rich.table import Table

from benchmarks.show import show
from symgen.api import load
from symgen.base.ir.program import LANES, lane_bases
from symgen.compile.loopcode.bare import bare
from symgen.compile.loopcode.padding import aligned
from symgen.compile.native import types
from symgen.compile.native.machine import vector_width
from symgen.compile.store.jit import jit
from symgen.run.compiling.method_choice import choose_method
from symgen.run.compiling.pipeline import compile_model
from symgen.run.layout import abi
from symgen.run.rows.lanes import LANE_FUNCTION

METHOD = "direct-correction"
REPEATS, COUNT = 30, 5000
_F8, _A, _I = types.float64, types.float64[::1], types.int64[::1]


@jit(types.int64(LANE_FUNCTION, _A, types.int64))
def many_lanes(function: Any, z: Any, count: int) -> int:
    """Call a function for lanes."""
    z = bare(z)
    for _ in range(count):
        function(0.0, z)
    return 0


@jit(types.int64(abi.RHS, _A, _A, _A, _I, _A, types.int64))
def many_rates(function: Any, y: Any, p: Any, w: Any, iw: Any, ydot: Any, count: int) -> int:
    """Call a right-hand side of one run."""
    y, p, w, iw, ydot = bare(y), bare(p), bare(w), bare(iw), bare(ydot)
    for _ in range(count):
        function(0.0, y, p, w, iw, ydot)
    return 0


@jit(types.int64(abi.ACCEPT, _A, _A, _A, _I, types.int64))
def many_accepts(function: Any, y: Any, p: Any, w: Any, iw: Any, count: int) -> int:
    """Call a correction of one run."""
    y, p, w, iw = bare(y), bare(p), bare(w), bare(iw)
    for _ in range(count):
        function(0.0, y, p, w, iw)
    return 0


def seconds(call: Callable[[], object], runs: int) -> tuple[float, float]:
    """Return least and median seconds of one call for one run."""
    call()
    times = []
    for _ in range(REPEATS):
        began = time.perf_counter()
        call()
        times.append((time.perf_counter() - began) / COUNT / runs)
    return min(times), statistics.median(times)


def measure(name: str, table: Table) -> None:
    """Add the rows of one model."""
    model = load(name)
    single, start = model.compile(METHOD), model.assemble(model.compile(METHOD))
    lanes = compile_model(model.mechanism, choose_method(METHOD), target="lanes")
    y, p, w = start.y.copy(), start.p, start.w.copy()
    iw, ydot = np.zeros(abi.N_COUNTERS, dtype=np.int64), np.zeros_like(y)
    bases = lane_bases(len(y), len(p), len(w))
    z = aligned(LANES * bases["numbers"])
    for array, values in (("y", y), ("p", p), ("w", w)):
        z[LANES * bases[array] :][: LANES * len(values)] = np.repeat(values, LANES)
    law, law_of_lanes = single.law_module, lanes.law_module
    for what, one, many in (
        ("rhs", partial(many_rates, law.rhs, y, p, w, iw, ydot, COUNT), law_of_lanes.rhs),
        ("accept", partial(many_accepts, law.accept, y, p, w, iw, COUNT), law_of_lanes.accept),
    ):
        least, median = seconds(one, 1)
        fast, usual = seconds(partial(many_lanes, many, z, COUNT), LANES)
        times = (least, median, fast, usual)
        table.add_row(name, what, *(f"{1e9 * x:.1f}" for x in times), f"{least / fast:.1f}")


def main(names: list[str]) -> None:
    """Measure and print."""
    title = f"{METHOD}, one function of one run, in ns; {LANES} lanes, vectors of {vector_width()} numbers"
    table = Table(title=title)
    for heading in ("mechanism", "function", "alone", "median", "in lanes", "median", "times as fast"):
        table.add_column(heading, justify="left" if heading in ("mechanism", "function") else "right")
    for name in names or ["four-bar", "slider-crank", "andrews", "bricard"]:
        measure(name, table)
    show(table)


if __name__ == "__main__":
    main(sys.argv[1:])

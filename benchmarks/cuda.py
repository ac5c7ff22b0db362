"""Sweeps on a CUDA device: what its compiler makes of the kernels, and runs per second beside all cores.

    python -m benchmarks.cuda [RUNS] [UNTIL]

The first table needs NVIDIA's compiler library (it comes with ``pip install 'symgen[cuda]'``) and no device; the second
one needs a device. What is missing is said, and its table left out. Seconds of runs begin with the starts closed on the
processor and end with the results back in its memory; compilation is left out.
"""

from __future__ import annotations

import importlib.util
import math
import re
import shutil
import subprocess
import sys
import tempfile
import time
from pathlib import Path
from types import SimpleNamespace
from typing import Any
from unittest.mock import patch

import numpy as np
from rich.table import Table

import symgen
from benchmarks.show import show
from symgen.base.memory import processor_count
from symgen.base.settings import Settings
from symgen.study.ensemble.device_runs import DeviceRuns, can_compile_kernels, is_device_usable
from symgen.study.ensemble.kernel import kernel_of_recipe
from symgen.study.ensemble.sweep_plan import make_ensemble

#: Compute capability that is compiled for where there is no device: that of an A100.
CAPABILITY = (8, 0)
#: What is compiled: model, a name that varies, method, integrator.
COMPILED = (
    ("pendulum", "bob_mass", "lagrange", "rk4"),
    ("four-bar", "crank_mass", "lagrange", "rk4"),
    ("four-bar", "crank_mass", "baumgarte", "dopri5"),
    ("four-bar", "crank_mass", "direct-correction", "rk4"),
    ("four-bar", "crank_mass", "direct-correction", "dopri5"),
    ("four-bar", "crank_mass", "coordinate-partitioning", "rk4"),
    ("four-bar", "crank_mass", "augmented-lagrangian", "rk4"),
    ("andrews", "K1.omega", "direct-correction", "rk4"),
    ("spatial-slider-crank", "crank.wx", "direct-correction", "rk4"),
    ("bricard", "rod1.wx", "direct-correction", "rk4"),
)
#: What is run: model, parameter, from and to, settings; the defaults are those of `symgen sweep`.
RUN: tuple[tuple[str, str, float, float, dict[str, Any]], ...] = (
    ("four-bar", "crank_mass", 1.0, 3.0, {"method": "lagrange"}),
    ("four-bar", "crank_mass", 1.0, 3.0, {"method": "direct-correction"}),
    ("four-bar", "crank_mass", 1.0, 3.0, {"method": "baumgarte"}),
    ("four-bar", "crank_mass", 1.0, 3.0, {"method": "direct-correction", "integrator": "dopri5"}),
    ("andrews", "K1.omega", -1.0, 1.0, {"method": "direct-correction", "step": 1e-5}),
    ("spatial-slider-crank", "crank.wx", 5.0, 7.0, {"method": "direct-correction"}),
)


def device_of(model: str, name: str, settings: Settings) -> DeviceRuns:
    """Return the kernel that would run a model, not compiled."""
    loaded = symgen.load(model)
    value = loaded.parameters({}).get(name, 1.0)
    kernel = kernel_of_recipe(
        make_ensemble(loaded, settings, {name: [value]}, {}, None, "cuda").recipe
    ).first_model.runs
    assert isinstance(kernel, DeviceRuns), "the target is cuda"
    return kernel


def assembler() -> str | None:
    """Return the path of NVIDIA's assembler, which says how many registers a kernel takes."""
    package = importlib.util.find_spec("nvidia")
    places = [] if package is None else list(package.submodule_search_locations or [])
    for place in places:
        for path in sorted(Path(place).glob("*/bin/ptxas")):
            return str(path)
    return shutil.which("ptxas")


def assemble(ptx: str, ptxas: str) -> dict[str, str]:
    """Return what the assembler says of the kernel: registers, stack, and bytes spilled and loaded again."""
    with tempfile.TemporaryDirectory() as folder:
        source = Path(folder) / "kernel.ptx"
        source.write_text(ptx, encoding="utf-8")
        command = [ptxas, "-v", f"-arch=sm_{CAPABILITY[0]}{CAPABILITY[1]}", str(source), "-o", str(source) + ".cubin"]
        messages = subprocess.run(command, capture_output=True, text=True, check=True).stderr
    # the kernel's own line comes before those of the functions that it calls
    spilled = re.search(r"(\d+) bytes stack frame, (\d+) bytes spill stores, (\d+) bytes spill loads", messages)
    registers = re.search(r"Used (\d+) registers", messages)
    assert spilled is not None and registers is not None, messages
    return {"registers": registers[1], "stack": spilled[1], "spilled": f"{spilled[2]} + {spilled[3]}"}


def compile_all() -> None:
    """Compile kernels as for a device, and print what came of it."""
    from numba import cuda
    from numba.cuda import dispatcher

    from symgen.run.rows.device import SIGNATURE, make_kernel

    ptxas = assembler()
    arch = ".".join(str(n) for n in CAPABILITY)
    table = Table(title=f"kernels as compiled for compute capability {arch}, the end of each run kept")
    headings = ("model", "method", "integrator", "operations of rhs", "local [B]", "PTX [kB]", "f64 arithmetic")
    for heading in (*headings, "f32, fast", "compiled in [s]", "registers", "stack [B]", "spilled [B]"):
        table.add_column(heading, justify="right" if len(table.columns) > 2 else "left")
    for model, name, method, integrator in COMPILED:
        settings = Settings(method=method, integrator=integrator, until=0.1, step=1e-3, times=(0.1,))
        runs = device_of(model, name, settings)
        kernel = make_kernel(runs.compiled.law_module, runs.compiled.model, runs.need)
        began = time.perf_counter()
        # device functions are compiled for the device at hand, which has no other part in it
        with patch.object(dispatcher, "get_current_device", lambda: SimpleNamespace(compute_capability=CAPABILITY)):
            ptx = str(cuda.compile_ptx(kernel, SIGNATURE, cc=CAPABILITY)[0])
        seconds = time.perf_counter() - began
        usage = assemble(ptx, ptxas) if ptxas is not None else {}
        table.add_row(
            *(model, method, integrator, str(operations(runs)), str(runs.need.local_bytes), f"{len(ptx) / 1e3:.0f}"),
            str(len(re.findall(r"\b(?:add|sub|mul|fma|div|rcp|sqrt)(?:\.rn)?\.f64", ptx))),
            str(len(re.findall(r"\.f32|\.approx|\.ftz", ptx))),
            *(f"{seconds:.1f}", usage.get("registers", "-"), usage.get("stack", "-"), usage.get("spilled", "-")),
        )
    show(table)
    if ptxas is None:
        print("no ptxas found: registers are not known")


def operations(runs: DeviceRuns) -> int:
    """Return the operations of a right-hand side, an iteration counted once."""
    names = ("rhs", "accelerate", "begin", "iterate", "finish")
    return sum(runs.compiled.law.operations.get(name, 0) for name in names)


def run_all(runs: int, until: float) -> None:
    """Run ensembles on the device and on all cores, and print runs per second of both."""
    from numba import cuda

    name = cuda.get_current_device().name
    name = name.decode() if isinstance(name, bytes) else str(name)
    table = Table(title=f"{runs} runs of {until:g} s: {name} beside {processor_count()} cores")
    for heading in ("model", "method", "integrator", "cores [runs/s]", "device [runs/s]", "ratio", "compiled in [s]"):
        table.add_column(heading, justify="right" if len(table.columns) > 2 else "left")
    for heading in ("statuses differ", "largest difference"):
        table.add_column(heading, justify="right")
    for model, varied, first, last, changes in RUN:
        loaded = symgen.load(model)
        settings = Settings(until=until, times=(until,), **changes)
        vary = {varied: np.linspace(first, last, runs)}
        figures = {}
        seconds = math.nan
        for target in ("cpu", "cuda"):
            began = time.perf_counter()
            symgen.sweep(loaded, {varied: [first]}, settings=settings, target=target)
            seconds = time.perf_counter() - began
            figures[target] = min(
                (symgen.sweep(loaded, vary, settings=settings, target=target) for _ in range(3)),
                key=lambda sweep: sweep.seconds,
            )
        cpu, device = figures["cpu"], figures["cuda"]
        both = np.isfinite(cpu.values) & np.isfinite(device.values)
        largest = np.abs(cpu.values - device.values)[both].max(initial=0.0)
        integrator = device.ensemble.plan.integrator.name
        table.add_row(
            *(model, device.ensemble.compiled.law.method, integrator),
            *(f"{runs / cpu.seconds:.4g}", f"{runs / device.seconds:.4g}", f"{cpu.seconds / device.seconds:.2f}"),
            *(f"{seconds:.1f}", str(int(np.sum(cpu.status != device.status))), f"{largest:.2g}"),
        )
    show(table)


def main(words: list[str]) -> None:
    """Measure what this machine allows, and print."""
    runs = int(words[0]) if words else 200_000
    until = float(words[1]) if len(words) > 1 else 0.1
    if can_compile_kernels():
        compile_all()
    else:
        print("no compiler for devices: no kernel is compiled (pip install 'symgen[cuda]' brings it)")
    if is_device_usable():
        run_all(runs, until)
    else:
        print("no CUDA device: nothing is run")


if __name__ == "__main__":
    main(sys.argv[1:])

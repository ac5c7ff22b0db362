"""Implicit integrators on growing mechanisms: compilation, one step, and the size of the factors of the Newton matrix.

Every line is a process of its own; those of a pair share a cache, in which smaller mechanisms leave what looped code
shares. Seconds are those of the processor, as the wall's depend on what else the machine does. Constants of
`symgen.run.compiling.choices` come from these figures.
"""

from __future__ import annotations

import argparse
import json
import os
import subprocess
import sys
import tempfile
import time
from dataclasses import replace
from typing import Any

import numpy as np

#: Method, integrator and options of each line.
PAIRS: dict[str, tuple[str, str, dict[str, str | float]]] = {
    "radau5": ("direct-correction", "radau5", {"integrator.adaptive": "false"}),
    "ggl": ("ggl", "radau5", {"integrator.adaptive": "false"}),
    "generalized-alpha": ("generalized-alpha", "generalized-alpha", {}),
}
#: Straight code of larger mechanisms takes many minutes to compile.
LARGEST_STRAIGHT = 10
STEP = 1e-3


def factors(model: str, pair: str, shape: str = "looped") -> dict[str, int]:
    """Return unknowns, entries, entries of L and U, and skipped pivots of a Newton matrix at the start.

    Parameters
    ----------
    model, pair : str
        Catalogue name, and one of `PAIRS`.
    shape : str
        Of the code.
    """
    from symgen.api import load
    from symgen.run.compiling.method_choice import choose_method
    from symgen.run.compiling.pipeline import compile_model
    from symgen.run.integrators import INTEGRATORS
    from symgen.run.layout import abi
    from symgen.run.loops import sparse
    from symgen.run.loops.newton import Pattern, alpha_plan, stage_plan

    method, integrator, _ = PAIRS[pair]
    loaded = load(model)
    compiled = compile_model(loaded.mechanism, replace(choose_method(method, None, True), shape=shape))
    start = loaded.assemble(compiled)
    pattern, law, w = Pattern.of(compiled, start.w), compiled.law_module, start.w.copy()
    rate, iw = np.zeros_like(start.y), np.zeros(abi.N_COUNTERS, dtype=np.int64)
    law.rhs(0.0, start.y, start.p, w, iw, rate)
    k = np.zeros(pattern.unknowns)
    k[: pattern.width] = rate[: pattern.width]
    k[pattern.width : pattern.width + pattern.m] = compiled.section(w, "multipliers")
    slopes = np.zeros(pattern.size)
    law.tangent(0.0, start.y, k, start.p, w, slopes)
    if pair == "generalized-alpha":
        plan, numbers, size = alpha_plan(pattern)
        sources = np.zeros(size)
        sources[: pattern.size], sources[-1] = slopes, 1.0
        sparse.multiply_sources(plan, sources)
        coefficients = np.array([1.0, 0.5 * STEP, 0.25 * STEP**2, -0.25 * STEP**2])
    else:
        a = np.asarray(INTEGRATORS.get(integrator).a)  # type: ignore[attr-defined]  # an implicit tableau
        plan, numbers = stage_plan(pattern, a, len(a) * pattern.size)
        sources = np.append(np.tile(slopes, len(a)), 1.0)
        coefficients = np.append(1.0, STEP * a.ravel())
    while (skipped := sparse.prepare_pattern(plan, sources, coefficients, numbers)) < 0:
        plan, numbers = sparse.enlarge_pattern(plan, numbers)
    size, work, entries = (int(plan[where]) for where in (sparse.SIZE, sparse.WORK, sparse.ENTRIES))
    upper, end = (plan[work + where * size :][:size] for where in (sparse._UPPER, sparse._END))
    stored = int(np.sum(end - upper))  # entries of L and U beside the diagonal
    return {"unknowns": size, "entries": entries, "stored": stored, "skipped": skipped}


def measure(model: str, pair: str, shape: str) -> dict[str, Any]:
    """Run a model some steps; called in a process of its own."""
    from symgen.api import load

    method, integrator, options = PAIRS[pair]
    keys: dict[str, Any] = {"method": method, "integrator": integrator, "options": options, "step": STEP}
    began = time.process_time()
    loaded = load(model)
    loaded.simulate(shape=shape, until=STEP, **keys)
    ready = time.process_time()

    def seconds(steps: int) -> float:
        begin = time.process_time()
        assert loaded.simulate(shape=shape, until=steps * STEP, **keys).status == "ok"
        return time.process_time() - begin

    figures = factors(model, pair, shape)
    count = min(600, max(50, 200_000 // figures["unknowns"]))  # the first singular passage comes later
    few, many = (min(seconds(steps) for _ in range(5)) for steps in (10, 10 + count))
    return {"compile": ready - began, "step": (many - few) / count, **figures}


def process(cache: str, *arguments: str) -> dict[str, Any]:
    """Measure in a process of its own."""
    command = [sys.executable, "-m", "benchmarks.newton", "--one", *arguments]
    done = subprocess.run(
        command, env=os.environ | {"SYMGEN_CACHE_DIR": cache}, capture_output=True, text=True, check=True
    )
    figures: dict[str, Any] = json.loads(done.stdout)
    return figures


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--one", nargs=3, metavar=("MODEL", "PAIR", "SHAPE"))
    parser.add_argument("--sizes", default="1,10,100,400")
    parser.add_argument("--models", default="n-four-bar")
    options = parser.parse_args()
    if options.one:
        print(json.dumps(measure(*options.one)))
        return
    print("| model | run | shape | unknowns | entries | L and U | compile [s] | step [ms] | [us] an unknown |")
    print("| --- | --- | --- | --- | --- | --- | --- | --- | --- |")
    for name in options.models.split(","):
        for pair in PAIRS:
            with tempfile.TemporaryDirectory() as cache:
                for size in (int(n) for n in options.sizes.split(",")):
                    for shape in ("looped", "straight"):
                        if shape == "straight" and size > LARGEST_STRAIGHT:
                            continue
                        figures = process(cache, f"{name}:{size}", pair, shape)
                        each = 1e6 * figures["step"] / figures["unknowns"]
                        cells = [f"`{name}:{size}`", f"`{pair}`", shape]
                        cells += [str(figures[key]) for key in ("unknowns", "entries", "stored")]
                        cells += [f"{figures['compile']:.2f}", f"{1e3 * figures['step']:.3g}", f"{each:.3g}"]
                        print("| " + " | ".join(cells) + " |", flush=True)


if __name__ == "__main__":
    main()

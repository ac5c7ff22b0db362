"""Straight and looped code of growing mechanisms: derivation, compilation, an evaluation, memory; all in one run.

Every line is a process of its own with a cache of its own. ``cold`` finds nothing in it; ``shared`` finds what runs of
other mechanisms have left. ``--pieces`` compiles mechanisms one after the other on one cache, each with kernels that
those before it have not, beside straight code of the same. Seconds are those of the processor, as the wall's depend on
what else the machine does.
The constants of `symgen.run.compiling.choices` come from these figures.
"""

from __future__ import annotations

import argparse
import json
import os
import resource
import subprocess
import sys
import tempfile
import time
from dataclasses import replace
from typing import Any

import numpy as np

from symgen.compile.native import types
from symgen.compile.store.jit import jit
from symgen.run.layout import abi

#: Straight code of larger mechanisms takes many minutes to compile.
LARGEST_STRAIGHT = 40
SIZES = (1, 10, 40, 100, 400, 1000)
#: Mechanisms of ``--pieces``, each with kernels that those before it have not.
PIECES = ("four-bar", "slider-crank", "andrews", "scissor-lift", "n-four-bar:40", "bricard", "stewart-platform")
_F8, _A, _I8 = types.float64, types.float64[::1], types.int64


@jit(_I8(abi.RHS, _F8, _A, _A, _A, types.int64[::1], _A, _I8))
def many(rhs: Any, t: float, y: Any, p: Any, w: Any, iw: Any, rate: Any, count: int) -> int:
    """Call a right-hand side often."""
    for _ in range(count):
        rhs(t, y, p, w, iw, rate)
    return 0


def measure(model: str, shape: str, method: str) -> dict[str, Any]:
    """Compile a model and evaluate it often; called in a process of its own."""
    from symgen.api import load

    began = time.process_time()
    loaded = load(model)
    read = time.process_time()
    compiled = loaded.compile(method, shape=shape)
    generated = time.process_time()
    start = loaded.assemble(compiled)
    y, p, w = start.y.copy(), start.p, start.w.copy()
    rate, iw = np.zeros_like(y), np.zeros(abi.N_COUNTERS, dtype=np.int64)
    many(compiled.law_module.rhs, 0.0, y, p, w, iw, rate, 1)
    compiled.law_module.accept(0.0, y, p, w, iw)
    ready = time.process_time()
    nq = compiled.info.nq
    count, best = max(2, int(4e4 / nq)), np.inf
    for _ in range(200):
        begin = time.perf_counter()
        many(compiled.law_module.rhs, 0.0, y, p, w, iw, rate, count)
        best = min(best, (time.perf_counter() - begin) / count)
    return {
        **{"coordinates": nq, "rows": compiled.info.m, "read": read - began, "generate": generated - read},
        **{"compile": ready - generated, "evaluation": best, "megabytes": 8e-6 * len(w)},
        "peak": resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024.0,
    }


def compile_pieces(model: str, method: str, form: str, shape: str) -> dict[str, Any]:
    """Compile a model and say what it took; called in a process of its own."""
    from symgen.api import load
    from symgen.run.compiling.method_choice import choose_method

    loaded = load(model)
    choice = replace(choose_method(method, implicit=form == "implicit"), shape=shape)
    began = time.process_time()
    compiled = loaded.compiled(choice)
    for name in ("rhs", "accept", "residual", "tangent"):
        getattr(compiled.law_module, name, None)
    loaded.assemble(compiled)
    taken = time.process_time() - began
    return {"coordinates": loaded.mechanism.body_coordinates, "seconds": taken}


def print_pieces(method: str) -> None:
    """Print what models take in both shapes, one after the other on one cache.

    The first model in the plane and the first in space compile loops of the runtime for their starts besides.
    """
    print("| model | form | coordinates | straight | looped | again |\n" + "| --- " * 6 + "|")
    for form in ("ode", "implicit"):
        with tempfile.TemporaryDirectory() as shared:
            for model in PIECES:
                first, again, straight = (
                    process(shared, "--piece", model, method, form, shape) for shape in ("looped", "looped", "straight")
                )
                seconds = " | ".join(f"{r['seconds']:.2f}" for r in (straight, first, again))
                print(f"| {model} | {form} | {first['coordinates']} | {seconds} |", flush=True)


def process(cache: str, *arguments: str) -> dict[str, Any]:
    """Measure in a process of its own."""
    command = [sys.executable, "-m", "benchmarks.shapes", *arguments]
    done = subprocess.run(
        command, env=os.environ | {"SYMGEN_CACHE_DIR": cache}, capture_output=True, text=True, check=True
    )
    figures: dict[str, Any] = json.loads(done.stdout)
    return figures


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--one", nargs=3, metavar=("MODEL", "SHAPE", "METHOD"), help="measure one line, as JSON")
    parser.add_argument("--piece", nargs=4, metavar=("MODEL", "METHOD", "FORM", "SHAPE"), help="the same, of a piece")
    parser.add_argument("--pieces", action="store_true", help="what the pieces of looped code take")
    parser.add_argument("--model", default="n-four-bar", help="sized model")
    parser.add_argument("--sizes", default=",".join(map(str, SIZES)))
    parser.add_argument("--method", default="lagrange")
    arguments = parser.parse_args()
    if arguments.one:
        json.dump(measure(*arguments.one), sys.stdout)
        return
    if arguments.piece:
        json.dump(compile_pieces(*arguments.piece), sys.stdout)
        return
    if arguments.pieces:
        print_pieces(arguments.method)
        return
    columns = "model shape cache coordinates rows read generate compile evaluation[us] ns/coordinate w[MB] peak[MB]"
    print("| " + " | ".join(columns.split()) + " |")
    print("| --- " * 12 + "|")
    with tempfile.TemporaryDirectory() as shared:
        for size in (int(n) for n in arguments.sizes.split(",")):
            model = f"{arguments.model}:{size}"
            kinds = [
                ("looped", "cold"),
                ("looped", "shared"),
                *([("straight", "cold")] if size <= LARGEST_STRAIGHT else []),
            ]
            for shape, cache in kinds:
                with tempfile.TemporaryDirectory() as own:
                    r = process(own if cache == "cold" else shared, "--one", model, shape, arguments.method)
                each = 1e9 * r["evaluation"] / r["coordinates"]
                times = " | ".join(f"{r[k]:.2f}" for k in ("read", "generate", "compile"))
                print(
                    f"| {model} | {shape} | {cache} | {r['coordinates']} | {r['rows']} | {times} | "
                    f"{1e6 * r['evaluation']:.3g} | {each:.3g} | {r['megabytes']:.2g} | {r['peak']:.0f} |",
                    flush=True,
                )


if __name__ == "__main__":
    main()

"""What a loop adds to the right-hand sides that it evaluates: run time over (evaluations x one right-hand side).

A right-hand side, ``accept`` (which corrects and measures a state) and the run are timed in turns, several times; the
smallest time of each counts. All times in nanoseconds: of one right-hand side, one ``accept``, one evaluation in a run;
what is left of a step after its right-hand sides and its ``accept`` is the loop's own. A right-hand side is timed
twice: at one state again and again, where a processor works on several at once, and each at a state that the one before
has to be done for, as in every run: a bare Euler step, whose sum it contains (``waiting``).

    python -m benchmarks.loop_cost [MODEL ...]
"""

from __future__ import annotations

import sys
import time
from collections.abc import Callable
from typing import Any

import numpy as np
from rich.console import Console
from rich.table import Table

from benchmarks.against_gcc import _repeat_emitted
from symgen.api import load
from symgen.compile.native import types
from symgen.compile.store.jit import jit
from symgen.run.layout import abi

MODELS = ("four-bar", "andrews", "bricard")
INTEGRATORS = ("rk4", "dop853")
#: Spans [s] and steps [s], by model and integrator: runs of about a millisecond, which a busy machine lets pass whole.
SPANS = {
    **{("four-bar", "rk4"): 2.0, ("four-bar", "dop853"): 20.0, ("andrews", "rk4"): 0.01, ("andrews", "dop853"): 0.03},
    **{("bricard", "rk4"): 0.5, ("bricard", "dop853"): 5.0},
}
STEPS = {"andrews": 1e-5}
RTOL = 1e-10
REPEATS = 200

_A, _I = types.float64[::1], types.int64[::1]


@jit(types.int64(abi.ACCEPT, _A, _A, _A, _I, types.int64))
def _repeat_accept(accept: Any, y: Any, p: Any, w: Any, iw: Any, count: int) -> int:
    bits = 0
    for _ in range(count):
        bits |= accept(0.0, y, p, w, iw)
    return bits


@jit(types.int64(abi.RHS, _A, _A, _A, _A, _I, _A, types.int64))
def _repeat_waiting(rhs: Any, start: Any, y: Any, p: Any, w: Any, iw: Any, ydot: Any, count: int) -> int:
    bits = 0
    for _ in range(count):
        bits |= rhs(0.0, y, p, w, iw, ydot)
        for i in range(start.shape[0]):
            y[i] = start[i] + 1e-300 * ydot[i]
    return bits


def fastest(call: Callable[[], object], count: int = 1) -> float:
    """Return the nanoseconds of one of `count` repetitions in a call, the smallest of several calls."""
    best = np.inf
    for _ in range(REPEATS):
        began = time.perf_counter()
        call()
        best = min(best, time.perf_counter() - began)
    return best / count * 1e9


def cost(name: str, integrator: str, method: str) -> dict[str, float]:
    """Return nanoseconds of a right-hand side, an ``accept`` and an evaluation in a run, and what follows from them."""
    model = load(name)
    compiled = model.compile(method)
    start = model.assemble(compiled)
    y, p, w = start.y.copy(), start.p.copy(), start.w.copy()
    iw, ydot = np.zeros(abi.N_COUNTERS, dtype=np.int64), np.zeros_like(y)
    until = SPANS.get((name, integrator), 1.0)
    how: dict[str, Any] = {"rtol": RTOL} if integrator == "dop853" else {"step": STEPS.get(name, 1e-3)}
    last = model.simulate(method=method, integrator=integrator, until=until, output_step=until, repeat=REPEATS, **how)
    outcome = last.outcome
    count = 2000
    law = compiled.law_module
    rhs = fastest(lambda: _repeat_emitted(law.rhs, y, p, w, iw, ydot, count), count)
    moved = y.copy()
    waiting = fastest(lambda: _repeat_waiting(law.rhs, y, moved, p, w, iw, ydot, count), count)
    accept = fastest(lambda: _repeat_accept(law.accept, y, p, w, iw, count), count)
    run = last.seconds.run * 1e9
    return {
        "steps": outcome.steps,
        "rejected": outcome.rejected,
        "evaluations": outcome.evaluations,
        "rhs": rhs,
        "waiting": waiting,
        "accept": accept,
        "evaluation": run / outcome.evaluations,
        "ratio": run / (outcome.evaluations * rhs),
        "to waiting": run / (outcome.evaluations * waiting),
        "left": (run - outcome.evaluations * rhs - outcome.steps * accept) / (outcome.steps + outcome.rejected),
    }


def main(models: list[str]) -> None:
    """Print the table."""
    table = Table()
    for title in ("model", "integrator", "method"):
        table.add_column(title, no_wrap=True)
    for title in ("steps", "rejected", "rhs", "waiting", "accept", "evaluation", "ratio", "to waiting", "left"):
        table.add_column(title, justify="right")
    for name in models or MODELS:
        for integrator in INTEGRATORS:
            for method in ("lagrange", "direct-correction"):
                c = cost(name, integrator, method)
                numbers = [f"{c['steps']:.0f}", f"{c['rejected']:.0f}", f"{c['rhs']:.1f}"]
                numbers += [f"{c['waiting']:.1f}", f"{c['accept']:.0f}"]
                numbers += [f"{c['evaluation']:.1f}", f"{c['ratio']:.2f}", f"{c['to waiting']:.2f}", f"{c['left']:.0f}"]
                table.add_row(name, integrator, method, *numbers)
    Console(width=150).print(table)


if __name__ == "__main__":
    main(sys.argv[1:])

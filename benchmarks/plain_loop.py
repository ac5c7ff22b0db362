"""The loop of runs beside a plain one by Numba over the same emitted functions, in turns by processor time.

    python -m benchmarks.plain_loop [MODEL ...]

The plain loop has the stages of `rk4`, ``confirm`` where a pivot is doubtful, and ``accept``; it watches nothing, keeps
no outputs, and does not end where a run fails. Both have the same states at the end, to rounding.
"""

from __future__ import annotations

import importlib
import statistics
import sys
import tempfile
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray
from rich.table import Table

from benchmarks.show import show
from symgen.api import load

MODELS = ("four-bar", "slider-crank", "bricard", "spatial-slider-crank")
STEP, COUNT, ROUNDS = 1e-3, 10_000, 15
METHOD = "direct-correction"


def plain_loop(folder: Path) -> Callable[[], tuple[float, NDArray[np.float64]]]:
    """Return a function that runs the plain loop over a generated package: processor time [s], state at the end."""
    from numba import njit

    for name in ("model", METHOD.replace("-", "_"), "simulate"):
        sys.modules.pop(name, None)
    sys.path.insert(0, str(folder))
    try:
        system: Any = importlib.import_module("simulate").System()
    finally:
        sys.path.remove(str(folder))
    rhs, confirm, accept, size = system.law.rhs, system.law.confirm, system.law.accept, len(system.y)

    @njit(error_model="numpy")  # type: ignore[untyped-decorator]  # Numba has no types
    def go(y: Any, p: Any, w: Any, iw: Any, h: float, count: int) -> None:
        rates, stage = np.zeros((4, size)), np.zeros(size)
        for _ in range(count):
            for s in range(4):
                ahead = 0.0 if s == 0 else h if s == 3 else 0.5 * h
                for i in range(size):
                    stage[i] = y[i] + ahead * rates[max(s - 1, 0), i]
                if rhs(0.0, stage, p, w, iw, rates[s]) != 0:
                    confirm(0.0, stage, p, w, iw, rates[s])
            for i in range(size):
                y[i] += h / 6.0 * (rates[0, i] + 2.0 * rates[1, i] + 2.0 * rates[2, i] + rates[3, i])
            accept(0.0, y, p, w, iw)

    def run() -> tuple[float, NDArray[np.float64]]:
        y, w, iw = system.y.copy(), system.w.copy(), system.iw.copy()
        began = time.thread_time()
        go(y, system.p, w, iw, STEP, COUNT)
        return time.thread_time() - began, y

    run()
    return run


def row(name: str) -> list[str]:
    """Return the cells of a mechanism."""
    model, until = load(name), STEP * COUNT
    settings: dict[str, Any] = {"method": METHOD, "integrator": "rk4", "step": STEP, "until": until}
    settings |= {"times": [until], "verify": False, "max_violation": 1.0}
    with tempfile.TemporaryDirectory() as folder:
        model.generate(folder, [METHOD])
        plain = plain_loop(Path(folder))
        pairs, far = list[tuple[float, float]](), 0.0
        for _ in range(ROUNDS):
            seconds, y = plain()
            result = model.simulate(**settings)
            pairs.append((seconds, result.outcome.cpu_seconds))
            far = float(np.abs(result.q.values[-1] - y[: result.q.values.shape[1]]).max())
    numba, own = (min(pair[i] for pair in pairs) for i in (0, 1))
    ratio = statistics.median(b / a for a, b in pairs)
    return [name, f"{1e3 * numba:.2f}", f"{1e3 * own:.2f}", f"{ratio:.2f}", f"{far:.0e}"]


def main(names: tuple[str, ...]) -> None:
    """Print the table."""
    table = Table("model", "plain loop [ms]", "run [ms]", "ratio", "difference", title=f"{COUNT:,} steps of rk4")
    for name in names:
        table.add_row(*row(name))
    show(table)


if __name__ == "__main__":
    main(tuple(sys.argv[1:]) or MODELS)

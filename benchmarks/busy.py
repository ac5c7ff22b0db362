"""Ratios of run times as `symgen compare` takes them, alone and beside busy processes, in turns.

    python -m benchmarks.busy [MODEL ...] [--busy N] [--times K] [--pinned] [--few]

Methods of the source with `rk4`, each timed beside `lagrange` K times alone and K times beside N processes that
compute without end. A row has the median of all ratios alone and its change beside them; `within` counts the
intervals of 95 % that hold that median, alone and beside. With `--pinned` all measurements have one
processor, with `--few` noisy rows have no further rounds.
"""

from __future__ import annotations

import argparse
import os
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from statistics import median
from typing import Any, NamedTuple

from rich.table import Table

from benchmarks.show import show
from symgen.api import load
from symgen.base.settings import Settings
from symgen.run.planning.prepare import prepare
from symgen.study.comparison.combinations import DEFAULT_METHODS
from symgen.study.comparison.model_comparison import AT_LEAST, AT_MOST, NOISY, REPEAT
from symgen.study.comparison.turns import Turns, time_in_turns
from symgen.study.unlimited_runs import without_limits
from symgen.study.yardstick import YARDSTICK

MODELS = ("four-bar", "slider-crank", "andrews")
#: What a busy process computes: numbers, and a walk through more memory than a cache of the second level has.
BUSY = "import array\nx = array.array('d', bytes(1 << 23))\nwhile True: sum(x[::8])"


class Ratios(NamedTuple):
    """Times of a method on a mechanism beside the yardstick, alone and beside busy processes; all have ratios."""

    alone: list[Turns]
    beside: list[Turns]

    @property
    def middle(self) -> float:
        """Median of all ratios alone."""
        return median(x for turns in self.alone for x in turns.ratios)

    @property
    def shifts(self) -> list[float]:
        """Ratios beside busy processes over `middle`, less one."""
        return [(turns.ratio or 0.0) / self.middle - 1.0 for turns in self.beside]

    @property
    def load(self) -> float:
        """Median of the wall clock over processor time beside busy processes."""
        return median(turns.load for turns in self.beside)

    def held(self, measured: list[Turns]) -> int:
        """Return how many intervals hold `middle`."""
        ends = [turns.ratio_interval or (0.0, 0.0) for turns in measured]
        return sum(low <= self.middle <= high for low, high in ends)


@contextmanager
def busy(count: int) -> Iterator[None]:
    """Let processes compute without end."""
    others = [subprocess.Popen([sys.executable, "-c", BUSY]) for _ in range(count)]
    try:
        yield
    finally:
        for process in others:
            process.kill()
            process.wait()


def measure(model: str, count: int, times: int, further: bool = True) -> dict[str, Ratios]:
    """Return the ratios of the methods but `lagrange` on a mechanism."""
    mechanism = load(model).mechanism
    defaults = mechanism.defaults
    end = min(defaults.until, defaults.predictable_until or defaults.until)
    common: dict[str, Any] = {"integrator": "rk4", "step": defaults.step, "until": end, "shape": "straight"}
    runs = {name: without_limits(prepare(mechanism, Settings(method=name, **common))) for name in DEFAULT_METHODS}
    found = {name: Ratios([], []) for name in DEFAULT_METHODS if name != YARDSTICK}
    for _ in range(times):
        for others in (0, count):
            with busy(others):
                for name, ratios in found.items():
                    both = runs[name].integrate, runs[YARDSTICK].integrate
                    turns = time_in_turns(*both, REPEAT, AT_LEAST, AT_MOST, noisy=NOISY if further else 0.0)
                    (ratios.beside if others else ratios.alone).append(turns)
    return {name: ratios for name, ratios in found.items() if all(x.ratios for x in (*ratios.alone, *ratios.beside))}


def main(arguments: list[str]) -> int:
    """Print the table."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.busy")
    parser.add_argument("models", nargs="*")
    parser.add_argument("--busy", type=int, default=3, help="busy processes")
    parser.add_argument("--times", type=int, default=4, help="measurements of each row, alone and beside")
    parser.add_argument("--pinned", action="store_true", help="measure on one processor")
    parser.add_argument("--few", action="store_true", help="no further rounds of noisy rows")
    given = parser.parse_args(arguments)
    if given.pinned:
        os.sched_setaffinity(0, [min(os.sched_getaffinity(0))])
    table = Table(
        "mechanism", "method", "alone", "beside [%]", "largest [%]", "within alone", "within", "wall over cpu"
    )
    largest, held, count = 0.0, [0, 0], 0
    for model in given.models or MODELS:
        for method, ratios in measure(model, given.busy, given.times, not given.few).items():
            shifts = sorted(ratios.shifts, key=abs)
            own, others = ratios.held(ratios.alone), ratios.held(ratios.beside)
            cells = [f"{ratios.middle:.3f}", f"{100 * median(shifts):+.1f}", f"{100 * shifts[-1]:+.1f}"]
            table.add_row(
                model, method, *cells, f"{own} of {given.times}", f"{others} of {given.times}", f"{ratios.load:.1f}"
            )
            largest, count = max(largest, abs(shifts[-1])), count + given.times
            held = [held[0] + own, held[1] + others]
    show(table)
    print(
        f"largest change {100 * largest:.1f} %; of {count} intervals {held[0]} hold the ratio alone, {held[1]} beside"
    )
    print(f"load of the machine: {os.getloadavg()[0]:.1f}")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))

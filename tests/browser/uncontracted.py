"""Rates of emitted functions without contraction: a process whose machine code is for a processor that fuses nothing.

Its sines are those of the C library:

    NUMBA_CPU_NAME=generic SYMGEN_COMPILER=libm python -m tests.browser.uncontracted

reads a line of JSON for each mechanism, its name, coordinates and a file of states, and answers with a line when two
files stand beside it: rates at the states, and at the same with every coordinate off by its last bit.
"""

import json
import os
import subprocess
import sys
from pathlib import Path
from types import TracebackType
from typing import Any, Self

import numpy as np

from symgen.api import load
from symgen.base.settings import Settings
from symgen.run.planning.plan import Purpose
from symgen.run.planning.prepare import prepare

Array = np.ndarray[Any, np.dtype[np.float64]]


def prepared(name: str, coordinates: str) -> tuple[Any, Any, Array]:
    """Return a compiled model of the catalogue, its start, and the coordinates of its bodies there."""
    mechanism = load(name).mechanism
    run = prepare(mechanism, Settings(coordinates=coordinates, shape="straight"), Purpose.STATE)
    bodies, start = run.assembled.of_bodies
    return run.compiled, run.start, start.y[: bodies.info.nq]


def rates(compiled: Any, start: Any, states: Array) -> Array:
    """Return what the right-hand side says of each state."""
    found, w = np.zeros((len(states), compiled.info.ny)), start.w.copy()
    for y, ydot in zip(states, found, strict=True):
        w[:] = start.w
        compiled.law_module.rhs(0.1, y.copy(), start.p, w, np.zeros(16, dtype=np.int64), ydot)
    return found


class Uncontracted:
    """The process."""

    def __enter__(self) -> Self:
        self.process = subprocess.Popen(
            [sys.executable, "-m", "tests.browser.uncontracted"],
            env=os.environ | {"NUMBA_CPU_NAME": "generic", "SYMGEN_COMPILER": "libm"},
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            text=True,
        )
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.process.communicate()

    def rates(self, name: str, coordinates: str, states: Array, folder: Path) -> tuple[Array, Array]:
        """Return the rates of states, and those of states that are off by the last bit of every coordinate."""
        path = folder / "states.npy"
        np.save(path, states)
        assert self.process.stdin and self.process.stdout
        self.process.stdin.write(json.dumps([name, coordinates, str(path)]) + "\n")
        self.process.stdin.flush()
        assert self.process.stdout.readline() == "done\n"
        return np.load(folder / "rates.npy"), np.load(folder / "nearby.npy")


def main() -> None:
    """Answer until nobody asks any more."""
    for line in sys.stdin:
        name, coordinates, path = json.loads(line)
        compiled, start, _ = prepared(name, coordinates)
        states, nq = np.load(path), compiled.info.nq
        np.save(Path(path).with_name("rates.npy"), rates(compiled, start, states))
        states[:, :nq] = np.nextafter(states[:, :nq], np.inf)
        np.save(Path(path).with_name("nearby.npy"), rates(compiled, start, states))
        print("done", flush=True)


if __name__ == "__main__":
    main()

"""States of a stepped run at the ends of its pieces, in bounded memory, and the result made of them."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from symgen.result.build import build_result
from symgen.run.layout import abi
from symgen.run.layout.probe import Ready
from symgen.run.single.run import outcome_of

if TYPE_CHECKING:
    from symgen.result.result import Result
    from symgen.run.planning.prepare import Prepared
    from symgen.run.single.simulation import Simulation

Array = NDArray[np.float64]

#: States that are kept at most, and bytes of them; a run with more keeps every second, every fourth, ...
MOST, BYTES = 4096, 32e6


class History:
    """States of a run that goes on, each as it was at the end of a piece.

    Parameters
    ----------
    loop : Simulation
        The run.
    """

    def __init__(self, loop: Simulation) -> None:
        self._loop, self._front = loop, loop.snapshot.front
        rows = int(min(MOST, max(64, BYTES / self._front.nbytes)))
        self._block = np.empty((rows, len(self._front)))
        self.clear()

    def clear(self) -> None:
        """Forget everything."""
        self._count, self._stride, self._passed = 0, 1, 0

    def note_state(self) -> None:
        """Keep the present state."""
        self._passed += 1
        if self._passed < self._stride:
            return
        self._passed = 0
        if self._count == len(self._block):
            self._count = (self._count + 1) // 2
            self._block[: self._count] = self._block[::2]
            self._stride *= 2
        self._block[self._count] = self._front
        self._count += 1

    def forget_after(self, time: float) -> None:
        """Forget states after a time, when a run was taken back [s]."""
        times = self._column("clock")[: self._count, abi.TIME]
        self._count = int(np.searchsorted(times, time, side="right"))

    def result(self, run: Prepared) -> Result:
        """Return the states that are kept, and the present one, as a result."""
        rows = self._block[: self._count]
        if not len(rows) or rows[-1, self._place_of_time("clock") + abi.TIME] < self._loop.state.clock[abi.TIME]:
            rows = np.vstack([rows, self._front])
        return self._result(run, rows)

    def present(self, run: Prepared) -> Result:
        """Return the present state as a result with one output."""
        return self._result(run, self._front[np.newaxis].copy())

    def _result(self, run: Prepared, rows: Array) -> Result:
        loop, info = self._loop, self._loop.compiled.info
        t, y, p, w = (self._column(name, rows) for name in ("clock", "y", "p", "w"))
        times, end = t[:, abi.TIME].copy(), float(self._loop.state.clock[abi.TIME])
        changes = np.flatnonzero((p[1:] != p[:-1]).any(axis=1))
        held = tuple((float(times[k]), p[k].copy()) for k in changes)
        status = np.hstack([w[:, : abi.N_STATUS], w[:, abi.WINDING : abi.WINDING + info.kept]])
        if loop.state.control[abi.BEGUN] == 0 or times[0] == loop.start.t:  # before a step nothing is measured
            status[0] = self._measure_states(times[0], y[0], p[0], w[0])
        outcome = outcome_of(loop, loop.outputs(np.zeros(0)), abi.DONE)
        fields: dict[str, Any] = {"p": loop.state.p.copy(), "w": loop.state.w.copy(), "held": held, "end": end}
        states = y[:, : info.ny].copy()
        outcome = replace(outcome, times=times, states=states, status_columns=status, **fields)
        run = replace(run, spec=replace(loop.spec, until=end, step=run.spec.step or loop.span.step, times=times))
        return build_result(run, outcome)

    def _measure_states(self, t: float, y: Array, p: Array, w: Array) -> Array:
        """Return the status and the angles that count turns at a state."""
        info, model, scratch = self._loop.compiled.info, self._loop.compiled.model, w.copy()
        for function in (model.geometry, model.measure):
            Ready(function, abi.MEASURE)(float(t), y.copy(), p.copy(), scratch)
        return np.append(scratch[: abi.N_STATUS], scratch[abi.WINDING : abi.WINDING + info.kept])

    def _place_of_time(self, name: str) -> int:
        array: Array = getattr(self._loop.state, name)
        return (array.ctypes.data - self._front.ctypes.data) // self._front.itemsize

    def _column(self, name: str, rows: Array | None = None) -> Array:
        """Return an array of the state in each row."""
        first = self._place_of_time(name)
        array: Array = getattr(self._loop.state, name)
        return (self._block if rows is None else rows)[:, first : first + len(array)]

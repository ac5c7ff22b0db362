"""A start that is closed again and again from other held values, with its code and memory kept between the calls."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from symgen.layout import ensemble_abi as e
from symgen.layout.start_records import Instant, StartConditions
from symgen.loopcode.entry import ArgumentBlock
from symgen.loopcode.exact import compiled_form
from symgen.starts.assembler import ALONE, one_row
from symgen.starts.starting import close_rows

if TYPE_CHECKING:
    from symgen.starts.assembler import Assembly
    from symgen.starts.held import Held

Array = NDArray[np.float64]


class KeptStart:
    """The compiled start of a model with the arrays that it works on; the bits are those of `Assembly.close`.

    Parameters
    ----------
    assembly : Assembly
        The start; its held quantities may have other values at every call.
    p : Array
        Parameters, not yet prepared: the same at every call.
    """

    def __init__(self, assembly: Assembly, p: Array) -> None:
        self.assembly, held, info = assembly, assembly.held, assembly.compiled.info
        joints, work = assembly.memory()
        self._now = one_row(np.zeros(info.ny), p.copy(), assembly.compiled.scratch())
        self._summary = np.zeros((1, e.N_SUMMARY))
        velocities, targets = np.zeros((1, info.nv)), np.zeros((1, len(held.targets)))
        self._conditions = StartConditions(velocities, targets, self._summary)
        flat, _, _ = assembly.prepare(self._now, ALONE[0], len(work.right))
        self._prepared = Instant(*(array.copy() for array in flat))
        *functions, observe = (compiled_form(function) for function in assembly.own)
        close, conditions = compiled_form(close_rows), StartConditions(*(array.ravel() for array in self._conditions))
        arguments = ((assembly.layout, *functions), observe, joints), flat, conditions, work, *ALONE
        block = ArgumentBlock.of(close, getattr(close, "signature", None), arguments)
        self._close = partial(close, *arguments) if block is None else block.enter

    def close(self, held: Held, y: Array, v: Array, p: Array) -> tuple[Array, Array]:
        """Make one state consistent in place, as `Assembly.close` does; `p` becomes the prepared parameters."""
        now, conditions = self._now, self._conditions
        now.y[0], now.p[0], now.w[0] = y, self._prepared.p, self._prepared.w
        conditions.velocities[0], conditions.targets[0] = v, held.targets
        conditions.velocities[0, list(held.velocities)] = list(held.velocities.values())
        self._summary[:] = 0.0
        self.assembly.close_prepared(self._close, now, conditions, 1)
        y[:], p[:] = now.y[0], now.p[0]
        return now.w[0].copy(), self._summary[0].copy()

"""Starts that are made again and again from other values, with their code and memory kept between the calls."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import partial
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from symgen.compile.loopcode.entry import ArgumentBlock
from symgen.compile.loopcode.exact import compiled_form
from symgen.run.layout import ensemble_abi as e
from symgen.run.layout.start_records import Instant, StartConditions
from symgen.run.starts.assembler import ALONE, as_one_row
from symgen.run.starts.starting import close_alone, close_rows
from symgen.run.starts.tree_start import settle_tree_row

if TYPE_CHECKING:
    from symgen.run.starts.assembler import Assembly
    from symgen.run.starts.held import Held
    from symgen.run.starts.tree_start import Carried

Array = NDArray[np.float64]

#: Calls after which optimised code is worth it: it takes seconds to be made and saves microseconds a call.
MANY = 200_000


class KeptStart:
    """The compiled start of a model with the arrays that it works on; it gives the bits of `Assembly.close`.

    Parameters
    ----------
    assembly : Assembly
        The start; its held quantities may have other values at every call.
    p : Array
        Parameters, not yet prepared: the same at every call, unless others are taken.
    """

    def __init__(self, assembly: Assembly, p: Array) -> None:
        self.assembly, held, info = assembly, assembly.held, assembly.compiled.info
        joints, work = assembly.memory()
        self._now = as_one_row(np.zeros(info.ny), p.copy(), assembly.compiled.scratch())
        self._summary = np.zeros((1, e.N_SUMMARY))
        velocities, targets = np.zeros((1, info.nv)), np.zeros((1, len(held.targets)))
        self._conditions = StartConditions(velocities, targets, self._summary)
        flat, _, _ = assembly.prepare(self._now, ALONE[0], len(work.right))
        self._flat = flat
        self._prepared = Instant(*(array.copy() for array in flat))
        *functions, observe = (compiled_form(function) for function in assembly.own)
        conditions = StartConditions(*(array.ravel() for array in self._conditions))
        self._arguments = (
            ((assembly.layout, assembly.table, *functions), observe, joints),
            flat,
            conditions,
            work,
            *ALONE,
        )
        self._close, self._calls = _bind_functions(close_alone, self._arguments), 0

    def take_parameters(self, p: Array, datum: Sequence[float]) -> None:
        """Take other parameters, not yet prepared, and what coordinates are measured from with them."""
        self._now.p[0] = p
        self.assembly.prepare(self._now, ALONE[0], self.assembly.layout.m)
        self._prepared = Instant(*(array.copy() for array in self._flat))
        self.assembly.layout.datum[:] = datum if len(datum) else 0.0

    def close(self, held: Held, y: Array, v: Array, p: Array) -> tuple[Array, Array]:
        """Make one state consistent in place, as `Assembly.close` does; `p` becomes the prepared parameters."""
        velocities = v.copy()
        velocities[list(held.velocities)] = list(held.velocities.values())
        now, summary = self.enter(y, velocities, held.targets)
        y[:], p[:] = now.y, now.p
        return now.w.copy(), summary.copy()

    def enter(self, y: Array, velocities: Array, targets: Array | Sequence[float]) -> tuple[Instant, Array]:
        """Close a described state; return start and summary, in memory that the next call overwrites."""
        self._calls += 1
        if self._calls == MANY:
            self._close = _bind_functions(close_rows, self._arguments)
        now, conditions, summary = self._now, self._conditions, self._summary
        now.y[0], now.p[0], now.w[0] = y, self._prepared.p, self._prepared.w
        conditions.velocities[0], conditions.targets[0] = velocities, targets
        summary[:] = 0.0
        if isinstance(self._close, partial):
            self.assembly.close_prepared(self._close, now, conditions, 1)
        else:
            self._close()
            if self.assembly.strict or summary[0, e.START] != e.ASSEMBLED:
                self.assembly.judge(now.w, summary)
        return self._flat, summary[0]


class KeptTree:
    """The map of starts of bodies to a tree with the arrays that it works on; it gives the bits of `Carried.settle`.

    Parameters
    ----------
    carried : Carried
        The map.
    of_bodies, p : Instant, Array
        A start of bodies, whose parameters hold for all starts, and parameters of the tree, not yet prepared.
    """

    def __init__(self, carried: Carried, of_bodies: Instant, p: Array) -> None:
        assembly, room = carried.assembly, carried.room(of_bodies)
        now = as_one_row(np.zeros(assembly.compiled.info.ny), p.copy(), assembly.compiled.scratch())
        self._now, _, _ = assembly.prepare(now, ALONE[0], assembly.layout.m)
        self._of_bodies, self._w = Instant(*(array.copy() for array in of_bodies)), self._now.w.copy()
        self._alike = np.zeros(len(carried.carrying.spins))
        functions = (compiled_form(function) for function in assembly.own[:-1])
        tree = (assembly.layout, assembly.table, *functions), *carried.ends, carried.carrying
        arguments = tree, self._of_bodies, self._now, assembly.memory()[1], room, self._alike
        self._settle = _bind_functions(settle_tree_row, arguments)

    def settle(self, y: Array, w: Array) -> tuple[Array, Array, Array]:
        """Return state and scratch of the tree for a start of bodies, and the products of Euler parameters."""
        now = self._now
        self._of_bodies.y[:], self._of_bodies.w[:] = y, w
        now.y[:], now.w[:] = 0.0, self._w
        with np.errstate(all="ignore"):
            self._settle()
        return now.y.copy(), now.w.copy(), self._alike


def _bind_functions(function: object, arguments: tuple[Any, ...]) -> Callable[[], int]:
    """Return a function of `exact` with its arguments, entered by its address where it is compiled."""
    code = compiled_form(function)
    block = ArgumentBlock.of(code, getattr(code, "signature", None), arguments)
    return partial(code, *arguments) if block is None else block.enter

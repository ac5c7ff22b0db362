"""The search for events on functions of time alone, as loops drive it: by plain Python, and side by side by others."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import numpy as np

from compile.native import printed
from symgen.compile.loopcode.loop_instances import Instances
from symgen.run.layout import abi
from symgen.run.loops import event_loop, search_records, searching
from symgen.run.loops.frame_parts import FAIL, HOLD, LOOK, MEET, NOTHING, SEEK, TAKE, TRY

ARGUMENTS = abi.DECIDE.signature.arguments
#: `decide` and its callees as plain Python, whose operations are not contracted.
plain: Any = Instances({}, lambda copy, original: copy, everything=True).copy(searching.decide.py_func)
#: Functions of time with their rates and actions: notes, one within a step, one that ends the run, one that restarts.
Function = Callable[[float], tuple[float, float]]
FUNCTIONS: tuple[tuple[Function, int], ...] = (
    (lambda t: (math.sin(3.0 * t + 0.2), 3.0 * math.cos(3.0 * t + 0.2)), search_records.NOTE),
    (lambda t: (0.99 - math.sin(7.0 * t), -7.0 * math.cos(7.0 * t)), search_records.NOTE),
    (lambda t: ((t - 0.7) * (t - 2.3), 2.0 * t - 3.0), search_records.LEAVE),
    (lambda t: (math.cos(5.0 * t), -5.0 * math.sin(5.0 * t)), search_records.ANEW),
)


def search(decide: Callable[..., int], steps: int = 80) -> list[float]:
    """Times of the events that `decide` locates in a few seconds, with steps of different lengths."""
    n, width = len(FUNCTIONS), 8
    notes = event_loop.notes_at(n, width, 1)
    hunt = np.zeros(notes + (search_records.NOTES + 2 * n) * (2 + width))
    hunt[search_records.COUNT] = n
    columns = hunt[search_records.N_HEAD :][: search_records.N_COLUMNS * n].reshape(-1, n)
    columns[search_records.ACTION] = [action for _, action in FUNCTIONS]
    w, iw, y = np.zeros(1), np.zeros(abi.N_COUNTERS, dtype=np.int64), np.zeros(width)
    out = search_records.N_HEAD + search_records.N_COLUMNS * n

    def task(t: float, h: float, doing: int) -> int:
        hunt[out : out + 2 * n] = np.ravel(np.array([function(t) for function, _ in FUNCTIONS]).T)
        return int(decide(hunt, n, notes, t, h, doing, width, y, w, iw))

    t, times = 0.0, []
    task(t, 0.0, LOOK)
    for i in range(steps):
        doing, h = NOTHING, 0.05 + 0.03 * (i % 5)
        searching.remember.py_func(hunt, n, t, width, y, 1, w, iw)
        while (doing := task(t + h, h, doing)) in (SEEK, TAKE):
            h = float(hunt[TRY])
        assert doing not in (FAIL, HOLD)
        t += h
        times += [time for time, _, _ in event_loop.taken_notes(hunt, width, 1)]
        if doing == MEET:
            task(t, 0.0, LOOK)
    return times


def compared(other: Callable[..., None]) -> list[float]:
    """The same times; `other` has copies of the arguments of each call, the result and the arrays afterwards."""

    def both(*arguments: Any) -> int:
        before = printed.copied(arguments)
        result = plain(*arguments)
        other(before, result, printed.arrays(arguments))
        return int(result)

    return search(both)

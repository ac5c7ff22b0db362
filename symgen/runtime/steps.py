"""Pieces of the loops: storing outputs, combining stages, weighing errors."""

from __future__ import annotations

import math
from typing import Any

from symgen.runtime import abi
from symgen.store.jit import jit

_N_STATUS = abi.RANK + 1
_WINDING = abi.WINDING


@jit()
def store(k: int, y: Any, w: Any, states: Any, status: Any) -> None:
    """Write output `k`: the state and what ``accept`` measured."""
    for i in range(y.shape[0]):
        states[k, i] = y[i]
    for i in range(_N_STATUS):
        status[k, i] = w[i]
    for i in range(_N_STATUS, status.shape[1]):  # angles with their turns counted
        status[k, i] = w[_WINDING - _N_STATUS + i]


@jit()
def combine(n: int, h: float, first: int, last: int, column: Any, value: Any, y: Any, stages: Any, out: Any) -> None:
    """Set out = y + h sum of value times stage, over the entries from `first` to `last` of a packed tableau."""
    k = first
    if k == last:
        for i in range(n):
            out[i] = y[i]
        return
    # several stages in one pass over the state: the passes, not the arithmetic, are what this costs
    if (last - k) % 4 == 1:
        f0, o0 = h * value[k], column[k] * n
        for i in range(n):
            out[i] = y[i] + f0 * stages[o0 + i]
        k += 1
    elif (last - k) % 4 == 2:
        f0, o0, f1, o1 = h * value[k], column[k] * n, h * value[k + 1], column[k + 1] * n
        for i in range(n):
            out[i] = y[i] + (f0 * stages[o0 + i] + f1 * stages[o1 + i])
        k += 2
    elif (last - k) % 4 == 3:
        f0, o0, f1, o1 = h * value[k], column[k] * n, h * value[k + 1], column[k + 1] * n
        f2, o2 = h * value[k + 2], column[k + 2] * n
        for i in range(n):
            out[i] = y[i] + (f0 * stages[o0 + i] + f1 * stages[o1 + i] + f2 * stages[o2 + i])
        k += 3
    else:
        f0, o0, f1, o1 = h * value[k], column[k] * n, h * value[k + 1], column[k + 1] * n
        f2, o2, f3, o3 = h * value[k + 2], column[k + 2] * n, h * value[k + 3], column[k + 3] * n
        for i in range(n):
            out[i] = y[i] + ((f0 * stages[o0 + i] + f1 * stages[o1 + i]) + (f2 * stages[o2 + i] + f3 * stages[o3 + i]))
        k += 4
    while k < last:
        f0, o0, f1, o1 = h * value[k], column[k] * n, h * value[k + 1], column[k + 1] * n
        f2, o2, f3, o3 = h * value[k + 2], column[k + 2] * n, h * value[k + 3], column[k + 3] * n
        for i in range(n):
            out[i] += (f0 * stages[o0 + i] + f1 * stages[o1 + i]) + (f2 * stages[o2 + i] + f3 * stages[o3 + i])
        k += 4


@jit()
def error_norm(
    n: int,
    size: int,
    h: float,
    weights: Any,
    count: int,
    width: int,
    stages: Any,
    y: Any,
    new: Any,
    rtol: float,
    atol: float,
    sums: Any,
) -> float:
    """Weighted root mean square of h times the error weights; two estimates are combined as Hairer does.

    `sums` is working memory for 2 n numbers.
    """
    for i in range(n):
        sums[i] = 0.0
        sums[n + i] = 0.0
    for s in range(width):
        # stages without weight, which most have one or the other of, cost nothing
        a, b = weights[s], weights[width + s] if count == 2 else 0.0
        if a != 0.0 or b != 0.0:
            for i in range(n):
                sums[i] += a * stages[s * size + i]
                sums[n + i] += b * stages[s * size + i]
    first = second = 0.0
    for i in range(n):
        scale = 1.0 / (atol + rtol * max(abs(y[i]), abs(new[i])))
        first += (sums[i] * scale) ** 2
        second += (sums[n + i] * scale) ** 2
    if count == 1:
        return abs(h) * math.sqrt(first / n)
    if first == 0.0:
        return 0.0
    return abs(h) * first / math.sqrt((first + 0.01 * second) * n)

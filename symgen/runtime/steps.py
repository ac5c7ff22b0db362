"""Pieces of the loops: storing outputs, combining stages, weighing errors."""

from __future__ import annotations

import math
from typing import Any

from symgen.runtime import abi
from symgen.store.jit import jit

_N_STATUS = abi.RANK + 1


@jit()
def store(k: int, y: Any, w: Any, states: Any, status: Any) -> None:
    """Write output `k`: the state and what ``accept`` measured."""
    for i in range(y.shape[0]):
        states[k, i] = y[i]
    for i in range(_N_STATUS):
        status[k, i] = w[i]


@jit()
def combine(n: int, h: float, first: int, last: int, column: Any, value: Any, y: Any, stages: Any, out: Any) -> None:
    """Set out = y + h sum of value times stage, over the entries from `first` to `last` of a packed tableau."""
    k = first
    if k == last:
        for i in range(n):
            out[i] = y[i]
        return
    if (last - first) % 2 == 1:
        f0 = h * value[k]
        o0 = column[k] * n
        for i in range(n):
            out[i] = y[i] + f0 * stages[o0 + i]
        k += 1
    else:
        f0 = h * value[k]
        o0 = column[k] * n
        f1 = h * value[k + 1]
        o1 = column[k + 1] * n
        for i in range(n):
            out[i] = y[i] + (f0 * stages[o0 + i] + f1 * stages[o1 + i])
        k += 2
    while k < last:
        f0 = h * value[k]
        o0 = column[k] * n
        f1 = h * value[k + 1]
        o1 = column[k + 1] * n
        for i in range(n):
            out[i] += f0 * stages[o0 + i] + f1 * stages[o1 + i]
        k += 2


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
) -> float:
    """Weighted root mean square of h times the error weights; two estimates are combined as Hairer does."""
    first = second = 0.0
    for i in range(n):
        scale = atol + rtol * max(abs(y[i]), abs(new[i]))
        a = b = 0.0
        for s in range(width):
            a += weights[s] * stages[s * size + i]
            if count == 2:
                b += weights[width + s] * stages[s * size + i]
        first += (a / scale) ** 2
        second += (b / scale) ** 2
    if count == 1:
        return abs(h) * math.sqrt(first / n)
    if first == 0.0:
        return 0.0
    return abs(h) * first / math.sqrt((first + 0.01 * second) * n)

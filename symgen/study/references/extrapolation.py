"""Compiled rates of independent equations, and their integration by Gragg's extrapolated midpoint rule."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np

from symgen.compile.native.annotations import Array, Integers
from symgen.study.references.least_squares import compiled, minimum_norm

#: Steps below this share of the time to the next output count as collapsed.
COLLAPSE = 1e-7
#: Columns of the extrapolation: order 2 x 8.
COLUMNS = 8


@compiled  # type: ignore[untyped-decorator]  # Numba is untyped
def _gauss_accelerations(d: Array, gamma: Array, f: Array, mass: Array, acceleration: Array) -> None:
    """Set `acceleration` to the v' of D v' = gamma that is nearest to M^-1 f in the metric of M."""
    m, n = d.shape
    root, free = np.empty(n), np.empty(n)
    for j in range(n):
        root[j] = 1.0 / math.sqrt(mass[j])
        free[j] = root[j] * f[j]
    if m > 0:
        scaled = np.zeros((m, n))
        missing = np.zeros(m)
        finite = True
        for i in range(m):
            missing[i] = gamma[i]
            for j in range(n):
                scaled[i, j] = d[i, j] * root[j]
                missing[i] -= scaled[i, j] * free[j]
            finite = finite and math.isfinite(missing[i])
        change = np.empty(n)
        if finite:
            minimum_norm(scaled, missing, change)
        for j in range(n):
            free[j] += change[j] if finite else math.nan
    for j in range(n):
        acceleration[j] = root[j] * free[j]


@compiled  # type: ignore[untyped-decorator]  # Numba is untyped
def _accelerations_by_multipliers(d: Array, gamma: Array, f: Array, mass: Array, acceleration: Array) -> None:
    """Set `acceleration` to the v' of M v' + D^T l = f and D v' = gamma."""
    m, n = d.shape
    heavy, usual = 0, 0.0
    for j in range(n):
        heavy, usual = heavy + int(mass[j, j] > 0.0), usual + mass[j, j]
    usual = usual / heavy if heavy > 0 else 1.0
    system, right, solution = np.zeros((n + m, n + m)), np.zeros(n + m), np.empty(n + m)
    finite = True
    for j in range(n):
        right[j] = f[j]
        finite = finite and math.isfinite(f[j])
        for i in range(n):
            system[i, j] = mass[i, j]
            finite = finite and math.isfinite(mass[i, j])
    for i in range(m):
        right[n + i] = usual * gamma[i]
        finite = finite and math.isfinite(right[n + i])
        for j in range(n):
            system[j, n + i] = system[n + i, j] = usual * d[i, j]
            finite = finite and math.isfinite(system[j, n + i])
    if finite:
        minimum_norm(system, right, solution)
    for j in range(n):
        acceleration[j] = solution[j] if finite else math.nan


@compiled  # type: ignore[untyped-decorator]  # Numba is untyped
def compute_rate(
    function: Callable[..., None],
    index: Integers,
    m: int,
    n: int,
    mass: Array,
    p: Array,
    t: float,
    y: Array,
    rate: Array,
) -> None:
    """Set ``rate`` to (v, v', z').

    v' is by least squares in the metric of M, or with multipliers where M has no inverse or is not diagonal. `index`
    holds the number of entries of D, then their rows and columns, then those of the masses of rotors.
    """
    k, own = index[0], y.shape[0] - 2 * n
    rotors = (index.shape[0] - 1 - 2 * k) // 2
    first = 3 * m + k + n
    out = np.zeros(first + own + rotors)
    function(t, y[:n], y[n:], p, out)
    d, gamma, f = np.zeros((m, n)), out[2 * m + k : 3 * m + k], out[3 * m + k : first]
    for e in range(k):
        d[index[1 + e], index[1 + k + e]] = out[m + e]
    heavy = rotors == 0
    for j in range(n):
        rate[j] = y[n + j]
        heavy = heavy and mass[j] > 0.0
    if heavy:
        _gauss_accelerations(d, gamma, f, mass, rate[n : 2 * n])
    else:
        masses = np.zeros((n, n))
        for j in range(n):
            masses[j, j] = mass[j]
        for e in range(rotors):
            masses[index[1 + 2 * k + e], index[1 + 2 * k + rotors + e]] += out[first + own + e]
        _accelerations_by_multipliers(d, gamma, f, masses, rate[n : 2 * n])
    for i in range(own):
        rate[2 * n + i] = out[first + i]


@compiled  # type: ignore[untyped-decorator]  # Numba is untyped
def integrate_by_extrapolation(
    function: Callable[..., None],
    index: Integers,
    m: int,
    n: int,
    mass: Array,
    p: Array,
    t: float,
    y: Array,
    until: float,
    rtol: float,
    scale: Array,
    state: Array,
    budget: int,
    used: Integers,
) -> int:
    """Integrate y to ``until``; return 0, 1 (budget used up) or 2 (the step collapses)."""
    size = y.shape[0]
    first, rate, before, now = np.zeros(size), np.zeros(size), np.zeros(size), np.zeros(size)
    table = np.zeros((COLUMNS, size))
    step = state[0] if state[0] > 0.0 else 1e-3 * (until - t)
    smallest = max(1e-16 * max(until, abs(t)), COLLAPSE * (until - t))
    while t < until:
        last = step >= until - t
        h = until - t if last else step
        compute_rate(function, index, m, n, mass, p, t, y, first)
        used[0] += 1
        for row in range(COLUMNS):
            count = 2 * (row + 1)
            small = h / count
            for e in range(size):
                before[e], now[e] = y[e], y[e] + small * first[e]
            for i in range(1, count):
                compute_rate(function, index, m, n, mass, p, t + i * small, now, rate)
                for e in range(size):
                    now[e], before[e] = before[e] + 2.0 * small * rate[e], now[e]
            compute_rate(function, index, m, n, mass, p, t + h, now, rate)
            used[0] += count
            for e in range(size):
                # smoothing keeps the expansion in even powers of the small step
                value = 0.5 * (now[e] + before[e] + small * rate[e])
                for column in range(row):  # Neville's scheme: table[j] is T[row - 1, j] and becomes T[row, j]
                    share = count / (2.0 * (row - column))
                    better = value + (value - table[column, e]) / (share * share - 1.0)
                    table[column, e] = value
                    value = better
                table[row, e] = value
        error = 0.0
        for i in range(size):
            weight = rtol * max(scale[i], abs(y[i]))
            error = max(error, abs(table[COLUMNS - 1, i] - table[COLUMNS - 2, i]) / weight)
        factor = 0.1
        if math.isfinite(error):
            factor = 4.0 if error == 0.0 else min(4.0, max(0.2, 0.85 * error ** (-1.0 / (2.0 * COLUMNS - 1.0))))
            if error <= 1.0:
                for e in range(size):
                    y[e] = table[COLUMNS - 1, e]
                t = until if last else t + h
        if not last or factor < 1.0:
            step = h * factor
        if used[0] > budget:
            return 1
        if step < smallest:
            return 2
    state[0] = step
    return 0

"""Reference motions in extended precision: Gauss' collocation of order 16 with constant steps, in 64 bits of mantissa.

The emitted right-hand side is evaluated as Python by NumPy, at all stages of a step at once; a reference is one that
half the step agrees with. It shares the formulas of symgen and nothing of its compiler, its loops or its schemes.
"""

from __future__ import annotations

from types import FunctionType
from typing import Any

import numpy as np
from numpy.typing import NDArray

from symgen.run.planning.prepare import Prepared

Array = NDArray[Any]
_STAGES = 8
_MOST = 60


def gauss() -> tuple[Array, Array, Array]:
    """Return nodes, matrix and weights of Gauss' collocation on (0, 1) in extended precision."""
    x = np.polynomial.legendre.leggauss(_STAGES)[0].astype(np.longdouble)
    for _ in range(3):  # Newton's iteration for the zeros of the Legendre polynomial
        values = _legendre(x)
        slope = _STAGES * (values[_STAGES - 1] - x * values[_STAGES]) / (1 - x * x)
        x = x - values[_STAGES] / slope
    values = _legendre(x)
    weights = 2 * (1 - x * x) / (_STAGES * values[_STAGES - 1]) ** 2
    k = np.arange(_STAGES, dtype=np.longdouble)[:, np.newaxis]
    through = (2 * k + 1) / 2 * weights * values[:_STAGES]  # Legendre coefficients of the polynomial through stages
    integrals = np.vstack([values[:1] + values[1:2], (values[2:] - values[: _STAGES - 1]) / (2 * k[1:] + 1)])
    return (1 + x) / 2, integrals.T @ through / 2, weights / 2


def _legendre(x: Array) -> Array:
    """Return Legendre polynomials up to the degree of the number of stages, one a row."""
    rows = [np.ones_like(x), x]
    for k in range(2, _STAGES + 1):
        rows.append(((2 * k - 1) * x * rows[-1] - (k - 1) * rows[-2]) / k)
    return np.array(rows)


def as_numpy(function: Any, *calls: str) -> Any:
    """Return an emitted function of straight code as Python on arrays, with those of its module that it calls."""
    plain = function.py_func
    own = {name: as_numpy(plain.__globals__[name]) for name in calls if name in plain.__globals__}
    space = {**plain.__globals__, **own, "math": np, "int": lambda x: 0}
    space |= {"min": np.minimum, "max": np.maximum, "abs": np.abs}
    return FunctionType(plain.__code__, space)


def as_plain(function: Any) -> Any:
    """Return an emitted function of straight code as Python on numbers of NumPy, with those that it calls."""
    plain = function.py_func
    space = plain.__globals__
    own = {name: as_plain(space[name]) for name in plain.__code__.co_names if hasattr(space.get(name), "py_func")}
    return FunctionType(plain.__code__, {**space, **own, "math": np})


def motion(run: Prepared, steps: int) -> Array:
    """Return q and v at the end of a run, after so many constant steps."""
    info, start, rhs = run.compiled.info, run.start, as_numpy(run.compiled.law_module.rhs, "law_rhs", "integrands")
    n = info.nq + info.nv
    c, a, b = gauss()
    h = np.longdouble(run.plan.spec.until) / steps
    y = start.y[: info.ny].astype(np.longdouble)
    p, w = start.p.astype(np.longdouble), list(start.w.astype(np.longdouble))
    rates: Array = np.zeros((info.ny, _STAGES), dtype=np.longdouble)
    for k in range(steps):
        times = (k + c) * h
        for _ in range(_MOST):
            states, written = y[:, np.newaxis] + h * (rates @ a.T), [np.zeros(_STAGES)] * info.ny
            rhs(times, list(states), p, list(w), None, written)
            following = np.array([np.broadcast_to(x, _STAGES) for x in written], dtype=np.longdouble)
            change = np.abs(following - rates)[:n].max() * h
            rates = following
            if change <= 1e-18 * max(1.0, float(np.abs(y[:n]).max())):
                break
        y = y + h * (rates @ b)
    return y[:n]


def reference(run: Prepared, steps: int) -> tuple[Array, float]:
    """Return q and v at the end of a run, and what twice as many steps change."""
    coarse, fine = motion(run, steps), motion(run, 2 * steps)
    return fine, float(np.abs(fine - coarse).max())

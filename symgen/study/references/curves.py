"""Tables of a mechanism as functions for independently derived equations, by NumPy and SciPy."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from symgen.describe.tables import Table


def curves(table: Table) -> dict[str, Callable[[float], Any]]:
    """Return a table's function and its derivatives by the names that SymPy prints for them.

    They are plain Python that Numba compiles as well.
    """
    x, y = np.asarray(table.x, dtype=float), np.asarray(table.y, dtype=float)
    found = _lines(x, y) if table.interpolation == "linear" else _pieces(x, y, table.interpolation, table.periodic)
    return {f"{name}_{table.name}": function for name, function in found.items()}


def _lines(x: Any, y: Any) -> dict[str, Callable[[float], Any]]:
    def value(at: float) -> Any:
        return np.interp(at, x, y)

    def slope(at: float) -> Any:
        if at <= x[0] or at >= x[-1]:
            return 0.0
        i = np.searchsorted(x, at, side="right")
        return (y[i] - y[i - 1]) / (x[i] - x[i - 1])

    return {"table": value, "slope": slope}


def _pieces(x: Any, y: Any, interpolation: str, periodic: bool) -> dict[str, Callable[[float], Any]]:
    from scipy.interpolate import CubicSpline, PchipInterpolator

    n, period = len(x), x[-1] - x[0] if periodic else np.inf
    spline: Any
    if interpolation == "cubic":
        spline = CubicSpline(x, y, bc_type="periodic" if periodic else "not-a-knot")
    elif periodic:  # the pieces in the middle of three periods
        ends = np.concatenate([x[:-1] - period, x, x[1:] + period])
        spline = PchipInterpolator(ends, np.concatenate([y[:-1], y, y[1:]]))
    else:
        spline = PchipInterpolator(x, y)
    slopes, c = spline(x, 1), np.ascontiguousarray(spline.c[:, n - 1 : 2 * n - 2] if len(spline.x) > n else spline.c)

    def table(at: float) -> Any:
        at = x[0] + (at - x[0]) % period if period < np.inf else at
        if at < x[0]:
            return y[0] + slopes[0] * (at - x[0])
        if at > x[-1]:
            return y[-1] + slopes[-1] * (at - x[-1])
        i = min(np.searchsorted(x, at, side="right") - 1, n - 2)
        u = at - x[i]
        return ((c[0, i] * u + c[1, i]) * u + c[2, i]) * u + c[3, i]

    def slope(at: float) -> Any:
        at = x[0] + (at - x[0]) % period if period < np.inf else at
        if at < x[0] or at > x[-1]:
            return slopes[0] if at < x[0] else slopes[-1]
        i = min(np.searchsorted(x, at, side="right") - 1, n - 2)
        u = at - x[i]
        return (3.0 * c[0, i] * u + 2.0 * c[1, i]) * u + c[2, i]

    def second(at: float) -> Any:
        at = x[0] + (at - x[0]) % period if period < np.inf else at
        if at < x[0] or at > x[-1]:
            return 0.0
        i = min(np.searchsorted(x, at, side="right") - 1, n - 2)
        return 6.0 * c[0, i] * (at - x[i]) + 2.0 * c[1, i]

    return {"table": table, "slope": slope, "second": second}

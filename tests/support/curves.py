"""Tables of descriptions as functions, by NumPy and SciPy."""

from collections.abc import Callable, Sequence

import numpy as np
from scipy.interpolate import CubicSpline, PchipInterpolator


def curve(
    x: Sequence[float], y: Sequence[float], interpolation: str = "linear", periodic: bool = False, order: int = 0
) -> Callable[[float], float]:
    """Return a table's function, or its derivative of an order."""
    x, y = np.array(x, dtype=float), np.array(y, dtype=float)
    if interpolation == "linear":
        if order == 0:
            return lambda at: float(np.interp(at, x, y))
        rises = np.concatenate([[0.0], np.diff(y) / np.diff(x), [0.0]])
        return lambda at: float(rises[np.searchsorted(x, at, side="right")]) if order == 1 else 0.0
    period = x[-1] - x[0]
    if interpolation == "cubic":
        spline = CubicSpline(x, y, bc_type="periodic" if periodic else "not-a-knot")
    elif periodic:
        spline = PchipInterpolator([*(x[:-1] - period), *x, *(x[1:] + period)], [*y[:-1], *y, *y[1:]])
    else:
        spline = PchipInterpolator(x, y)

    def value(at: float) -> float:
        at = x[0] + (at - x[0]) % period if periodic else at
        inside = min(max(at, x[0]), x[-1])
        beyond = at - inside
        if beyond == 0.0:
            return float(spline(inside, order))
        straight = spline(inside) + spline(inside, 1) * beyond, spline(inside, 1), 0.0, 0.0
        return float(straight[order])

    return value

"""Shortest changes: directions of the smallest solution of linear equations, some of whose unknowns have values."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from symgen.base.errors import InputError

if TYPE_CHECKING:
    from symgen.run.planning.named_directions import RunDirection

Array = NDArray[np.float64]

#: Part of the largest direction that a row may be violated by at the closed start: rounding of the solution.
_ROUNDING = 1e-8
#: Part of the largest violation from which a row is named: rounding must not choose among equal rows.
_NEARLY_LARGEST = 1.0 - 1e-6
#: Part of the largest singular value below which a direction is none.
NONE = 1e-10


def shortest_slope(
    rows: Array, slopes: Array, x: Array, free: list[int], scales: Array, loads: Array, rates: bool
) -> Array:
    """Return how the shortest solution x of rows turns with these, scaled; what they determine is not read.

    Parameters
    ----------
    rows, slopes : Array, shapes (k, nv), (k, nv, n)
        The rows and their directions.
    x : Array, shape (nv,)
        The solution.
    free : list of int
        Its unknowns.
    scales : Array, shape (nv,)
        Scales of the unknowns.
    loads : Array, shape (nv, n)
        Directions of the metric times x.
    rates : bool
        Whether rates of joints are among the rows, whose directions are not known.
    """
    result, own = np.zeros(slopes.shape[1:]), scales[free]
    a = rows[:, free] * own
    if not np.any(x[free]) or np.linalg.matrix_rank(a, tol=NONE * np.linalg.norm(a)) == len(free):
        return result
    if rates:
        expected = "a start whose velocities follow from what it holds"
        raise InputError("sensitivities", expected, "one that leaves some to the smallest ones")
    pulls = np.linalg.pinv(a, rcond=NONE).T @ (x[free] / own)
    result[free] = own[:, np.newaxis] * (np.einsum("ijk,i->jk", slopes[:, free], pulls) - loads[free])
    return result


def shortest_solution(
    rows: Array,
    right: Array,
    fixed: dict[int, Array],
    names: Sequence[str],
    more: Array,
    scales: Array,
    directions: Sequence[RunDirection],
) -> Array:
    """Return the shortest solution of linear equations in which some unknowns have values, shape (nv, n).

    Parameters
    ----------
    rows, right : Array, shapes (k, nv), (k, n)
        The equations.
    fixed : dict of int to Array
        Unknowns with values.
    names : sequence of str
        Names of the equations.
    more : Array, shape (nv, n)
        Scaled change, of which the part that the equations leave free is added.
    scales : Array, shape (nv,)
        Scales of the unknowns.
    directions : sequence of RunDirection
        The n directions, for messages.

    Raises
    ------
    InputError
        If the equations cannot be met.
    """
    result = np.zeros((rows.shape[1], len(directions)))
    for j, target in fixed.items():
        result[j] = target
    free = [j for j in range(rows.shape[1]) if j not in fixed]
    own = scales[free]
    scaled, rest = rows[:, free] * own, right - rows @ result
    inverse = np.linalg.pinv(scaled, rcond=NONE)
    solution = inverse @ rest
    left = np.abs(rest - scaled @ solution)
    sizes = np.maximum(np.abs(rest).max(initial=0.0, axis=0), np.abs(right).max(initial=0.0, axis=0))
    wrong = left > _ROUNDING * np.maximum(sizes, 1e-300)
    if np.any(wrong):
        missed = np.where(wrong, left / np.maximum(sizes, 1e-300), 0.0)
        i, k = np.argwhere(missed >= _NEARLY_LARGEST * missed.max())[0]
        raise InputError(
            f"sensitivities '{directions[k].name}'",
            "a number in whose direction the mechanism stays closed",
            f"one by which the row {names[i]} cannot be met",
            "rows that depend on others, or held quantities, leave no room for it",
        )
    solution += more[free] - inverse @ (scaled @ more[free])
    result[free] = own[:, np.newaxis] * solution
    return result

"""Prices of limits: by how much an aim would fall for a limit that is moved, from the active rows at an answer."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from symgen.analyses.search.measured_data import ColumnAim
from symgen.analyses.search.sampled_motions import Aim, Limit, Sampled, local_minima

Array = NDArray[np.float64]

#: Rooms below this part of a limit's size, or of an aim, are active.
ACTIVE = 1e-4
#: Numbers as near as this to a bound, in parts of their range, are at it.
AT_BOUND = 1e-6
#: Prices are known where active rows balance the aim's slopes to this part of them.
BALANCED = 0.05


def prices_of_limits(aim: Aim | ColumnAim, limits: Sequence[Limit], u: Array, fine: Sampled) -> list[float | None]:
    """Return what a unit of each limit costs of the aim: 0 where it is not active, None where nothing tells.

    Parameters
    ----------
    aim, limits
        The aim and the limits.
    u : Array, shape (n,)
        The answer, in parts of the ranges.
    fine : Sampled
        Its motion.
    """
    from scipy.optimize import nnls

    n, times, columns, owners = len(u), len(fine.times), list[Array](), list[int]()
    goal = np.zeros(n)
    if isinstance(aim, Aim) and aim.is_bounded:
        y, dy = aim.signed(fine)
        rest = (y.max() - y) / max(abs(y.max()), 1e-300)
        peaks = [np.append(dy[k], 1.0) for k in local_minima(rest, times) if rest[k] <= ACTIVE]
    else:
        goal, peaks = -aim.number(fine)[1], []
    columns += peaks
    owners += [-1] * len(peaks)
    for i, limit in enumerate(limits):
        rooms, slopes = limit.rooms(fine)
        for k in local_minima(rooms, times):
            if rooms[k] <= ACTIVE:
                columns.append(np.append(-slopes[k], 0.0))
                owners.append(i)
    for i in range(n):
        for side, end in ((-1.0, 0.0), (1.0, 1.0)):
            if abs(u[i] - end) <= AT_BOUND:
                columns.append(np.append(side * np.eye(n)[i], 0.0))
                owners.append(-1)
    if not any(owner >= 0 for owner in owners):
        return [0.0] * len(limits)
    size = float(np.abs(np.array(peaks)[:, :n]).max(initial=0.0)) if peaks else float(np.abs(goal).max(initial=0.0))
    weight = size or 1.0
    matrix = np.array(columns).T
    right = np.append(goal, weight if peaks else 0.0)
    matrix[n] *= weight
    try:
        amounts, left = nnls(matrix, right)
    except RuntimeError:  # too many steps
        return [None if i in owners else 0.0 for i in range(len(limits))]
    if left > BALANCED * weight * np.sqrt(n):
        return [None if i in owners else 0.0 for i in range(len(limits))]
    totals = np.zeros(len(limits))
    for owner, amount in zip(owners, amounts, strict=True):
        if owner >= 0:
            totals[owner] += amount
    return [float(total / limit.size) for total, limit in zip(totals, limits, strict=True)]

"""Whether forces obey their laws, by signs and bounds alone: a check that knows nothing of how they are found."""

from __future__ import annotations

import math

from symgen.compile.loopcode.exact import exact
from symgen.run.laws.problem import BALL, PUSH, Laws, bound_of, load_of, middle_of, rows_of, size_of_offset
from symgen.run.layout.scales import larger_number

#: What may be missing, over the sizes that it is a difference of; what rounding leaves, over those of all rows.
_TOLERANCE, _ROUNDED = 1e-8, 1e-13


@exact()
def size_of_terms(n: int, i: int, laws: Laws) -> float:
    """Return the sum of the sizes whose difference is the acceleration of a row."""
    size = size_of_offset(i, laws)
    for j in range(n):
        size += abs(laws.matrix[i * n + j] * laws.forces[j])
    return float(size)


@exact()
def ball_is_obeyed(n: int, i: int, tiny: float, little: float, laws: Laws) -> bool:
    """Whether a ball obeys its law; accelerations below `tiny` and forces below `little` are rounding."""
    second, bound = rows_of(n, i, laws) == 2, bound_of(n, i, laws)
    c, a = laws.forces[i], laws.left[i]
    if laws.way[i] == 0.0:
        c -= middle_of(i, load_of(n, i, laws), laws)
    d, b = (laws.forces[i + 1], laws.left[i + 1]) if second else (0.0, 0.0)
    if laws.way[i] != 0.0 or (second and laws.way[i + 1] != 0.0):
        other = laws.way[i + 1] if second else 0.0
        return bool(abs(c - bound * laws.way[i]) <= little and abs(d - bound * other) <= little)
    force, motion = math.sqrt(c * c + d * d), math.sqrt(a * a + b * b)
    if force > bound + little:
        return False
    if motion <= tiny:
        return True
    turned, along = abs(c * b - d * a), c * a + d * b  # it moves: the force is at its bound, along the acceleration
    return bool(force >= bound - little and turned <= little * motion + tiny * force and along >= -tiny * force)


@exact(entry=True)
def obeys(n: int, laws: Laws) -> bool:
    """Whether the forces are finite and obey all laws; ``left`` is what they leave."""
    most = 0.0
    for i in range(n):
        if not math.isfinite(laws.forces[i]):
            return False
        root = math.sqrt(laws.matrix[i * n + i]) if laws.matrix[i * n + i] > 0.0 else 0.0
        most = larger_number(most, abs(laws.forces[i]) * root)
    for i in range(n):
        own, total = laws.matrix[i * n + i], laws.offset[i]
        for j in range(n):
            total -= laws.matrix[i * n + j] * laws.forces[j]
        laws.left[i] = total
        most = larger_number(most, abs(laws.offset[i]) / math.sqrt(own) if own > 0.0 else 0.0)
    for i in range(n):
        own, tiny = laws.matrix[i * n + i], _TOLERANCE * size_of_terms(n, i, laws)
        tiny += _ROUNDED * most * math.sqrt(own) if own > 0.0 else 0.0
        little = _TOLERANCE * (most / math.sqrt(own) if own > 0.0 else abs(laws.forces[i]))
        if laws.law[i] == PUSH and own > 0.0:
            force, left = laws.forces[i], laws.left[i]
            if force > little or left < -tiny or (force < -little and left > tiny):
                return False
        elif laws.law[i] == BALL and own > 0.0 and not ball_is_obeyed(n, i, tiny, little, laws):
            return False
    return True

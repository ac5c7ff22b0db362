"""Lengths of arrays of states: loops work on vectors of `BLOCK` numbers (`symgen.compile.loopcode.vectors`)."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

#: Numbers of a vector.
BLOCK = 8


def padded(size: int) -> int:
    """Return the length of an array of `size` numbers whose last block is filled up."""
    return -(-size // BLOCK) * BLOCK


def aligned(size: int) -> NDArray[np.float64]:
    """Return zeros aligned to a cache line: vectors that cross lines take twice the time."""
    room = np.zeros(size + BLOCK)
    first = -(room.ctypes.data // 8) % BLOCK
    return room[first : first + size]

"""How long arrays of states are: loops work on vectors of `BLOCK` numbers (`symgen.runtime.vectors`)."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

#: Numbers of a vector.
BLOCK = 8


def padded(size: int) -> int:
    """Return the numbers that an array of `size` takes with those that fill its last block."""
    return -(-size // BLOCK) * BLOCK


def aligned(size: int) -> NDArray[np.float64]:
    """Return zeros that begin where a line of the cache does: vectors that cross lines take twice the time."""
    room = np.zeros(size + BLOCK)
    first = -(room.ctypes.data // 8) % BLOCK
    return room[first : first + size]

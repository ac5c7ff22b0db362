"""How long arrays of states are: loops work on vectors of `BLOCK` numbers (`symgen.runtime.vectors`)."""

from __future__ import annotations

#: Numbers of a vector.
BLOCK = 8


def padded(size: int) -> int:
    """Return the numbers that an array of `size` takes with those that fill its last block."""
    return -(-size // BLOCK) * BLOCK

"""The order in which loops follow from velocities that stay free."""

from __future__ import annotations

from collections.abc import Iterable

from symgen.base.ir.program import FixedVelocities

#: The two rows of a joint, and the velocities left over in them.
Pair = tuple[tuple[int, int], tuple[int, ...]]


def loop_order(pairs: Iterable[Pair], free: Iterable[int]) -> tuple[FixedVelocities, ...]:
    """Return the loops that follow from free velocities, each as soon as it has two others that do not."""
    waiting, before, loops = list(pairs), {*free}, list[FixedVelocities]()
    while True:
        ready = next(((p, two) for p in waiting if len(two := tuple(c for c in p[1] if c not in before)) == 2), None)
        if ready is None:
            return tuple(loops)
        (rows, _), columns = ready
        waiting.remove(ready[0])
        before |= {*columns}
        loops.append(FixedVelocities(columns, rows))

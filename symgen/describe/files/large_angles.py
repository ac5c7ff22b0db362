"""Angles of a file that are many turns, where degrees were meant."""

from __future__ import annotations

import math
from collections.abc import Iterator

from symgen.describe.files.origins import origin_of
from symgen.describe.mechanism import Mechanism

_SECTIONS = ("bodies", "joints")


def warnings_on_angles(mechanism: Mechanism) -> Iterator[str]:
    """Yield a sentence for each angle of a body or a joint that is a plain number above one turn.

    Parameters
    ----------
    mechanism : Mechanism
        A mechanism whose description is known; of another one nothing is said.
    """
    origin = origin_of(mechanism)
    if origin is None:
        return
    for section in _SECTIONS:
        for name, table in origin.raw.get(section, {}).items():
            angle = table.get("angle")
            if isinstance(angle, int | float) and not isinstance(angle, bool) and abs(angle) > 2.0 * math.pi:
                turns = abs(angle) / (2.0 * math.pi)
                yield (
                    f"{section}.{name}.angle: {angle:g} rad are {turns:.3g} turns; "
                    f'an angle in degrees is written "{angle:g} deg"'
                )

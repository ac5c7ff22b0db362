"""Angles of a file that are many turns, where degrees were meant."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from typing import Any

from symgen.describe.mechanism import Mechanism

_SECTIONS = ("bodies", "joints")


def warnings_on_angles(_: Mechanism, raw: Mapping[str, Any]) -> Iterator[str]:
    """Yield a sentence for each angle of a body or a joint that is a plain number above one turn.

    Parameters
    ----------
    raw : mapping
        The description of a mechanism.
    """
    for section in _SECTIONS:
        for name, table in raw.get(section, {}).items():
            angle = table.get("angle")
            if isinstance(angle, int | float) and not isinstance(angle, bool) and abs(angle) > 2.0 * math.pi:
                turns = abs(angle) / (2.0 * math.pi)
                yield (
                    f"{section}.{name}.angle: {angle:g} rad are {turns:.3g} turns; "
                    f'an angle in degrees is written "{angle:g} deg"'
                )

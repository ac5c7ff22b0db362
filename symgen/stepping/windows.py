"""Parts of the time of a run without an end, in each of which kinks and jumps of formulas are known beforehand."""

from __future__ import annotations

import math
from collections.abc import Mapping

from symgen.runtime.foreseen import Foreseen
from symgen.runtime.pieces import Piece

#: Windows are longer than asked for by this part: a kink at a round time, as the `until` of a mechanism, is inside one.
_LONGER = 1e-3 / math.pi


class Windows:
    """Equal windows of the time, and the one that a run is in; one without an end where nothing is known.

    Parameters
    ----------
    known : Foreseen
        What formulas pass.
    length : float
        How long a window is, about [s].
    now : float
        Where the run stands [s].
    """

    def __init__(self, known: Foreseen, length: float, now: float) -> None:
        self.known, self.length = known, length * (1.0 + _LONGER)
        self.first, self.end = 0.0, self.length if known else math.inf
        self.follow(now, 0.0)

    def follow(self, now: float, slack: float) -> bool:
        """Take the window in which a run at `now` goes on, `slack` being no time [s]; return if it is another."""
        if not self.known or self.first - slack <= now < self.end - slack:
            return False
        count = math.floor((now + slack) / self.length)
        self.first, self.end = count * self.length, (count + 1) * self.length
        return True

    def pieces(self, values: Mapping[str, float]) -> tuple[Piece, ...]:
        """Return the pieces of the window with these values of all parameters."""
        return self.known.pieces(values, self.end, self.first)

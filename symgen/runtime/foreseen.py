"""Times at which formulas of a run have kinks or jump, as far as they are known before it begins.

An error estimate sees a kink or a jump where stages of a step lie on both sides of it, and one between two stages, as a
push that is shorter than a step, not at all. What is known beforehand needs no estimate: adaptive runs go in pieces
from one such time to the next.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from itertools import pairwise
from typing import Any

from symgen.describe.inputs import Jump
from symgen.describe.kinks import kinks_of, sides_of
from symgen.describe.mechanism import Mechanism
from symgen.describe.remembered import remembered
from symgen.errors import InputError
from symgen.runtime.in_time import InTime, line_of
from symgen.runtime.pieces import SAME, Piece
from symgen.vocabulary.expressions import names

#: Kinks of tables, and times at which comparisons change, that a run stops at, at most: with more of them none, as each
#: costs a step.
MOST_KINKS = 2000
#: So far beside a jump, as a part of the run, a step ends and another begins.
_BESIDE = 1e-12


@dataclass(frozen=True)
class Foreseen:
    """What formulas of a mechanism pass at times that are known beforehand; false where that is nothing.

    The times depend on parameters: what was worked out last for some of them is remembered.

    Attributes
    ----------
    mechanism : Mechanism
        Whose tables they may read.
    kinks, sides : tuple of Jump
        From `kinks_of` and `sides_of` of `symgen.describe.kinks`.
    known : dict
        What `pieces` returned last, by what it depends on.
    """

    mechanism: Mechanism
    kinks: tuple[Jump, ...] = ()
    sides: tuple[Jump, ...] = ()
    known: dict[tuple[float, ...], tuple[Piece, ...]] = field(default_factory=dict, repr=False, compare=False)

    def __bool__(self) -> bool:
        """Whether there is anything."""
        return bool(self.kinks or self.sides)

    @cached_property
    def reads(self) -> frozenset[str]:
        """What the times depend on: names of parameters, and t."""
        return frozenset(name for jump in (*self.kinks, *self.sides) for name in names(jump.argument))

    def pieces(self, values: Mapping[str, float], until: float, first: float = 0.0) -> tuple[Piece, ...]:
        """Return the pieces of a motion from `first` to `until`, in which no number changes; none where it is whole.

        Parameters
        ----------
        values : mapping of str to float
            Of all parameters.
        until, first : float
            End of the motion, and its begin [s].
        """
        if not self:
            return ()
        key = (until, first, *(values[name] for name in sorted(self.reads & values.keys())))
        found = self.known.get(key)  # runs that are compared, or of a sweep, often differ in nothing of that
        if found is None:
            found = self._looked_for(values, until, first)
            self.known.clear()
            self.known[key] = found
        return found

    def closest(self, values: Mapping[str, float], until: float) -> tuple[float, float] | None:
        """Return the two times inside a run [s] that are closest to each other, points of tables left aside.

        Parameters
        ----------
        values, until
            As for `pieces`.
        """
        jumps = [*self.sides, *(kink for kink in self.kinks if kink.levels == (0.0,))]
        times = times_between(jumps, self.mechanism, values, until)
        return min(pairwise(times), key=lambda pair: pair[1] - pair[0], default=None)

    def _looked_for(self, values: Mapping[str, float], until: float, first: float) -> tuple[Piece, ...]:
        times = set(times_between(self.kinks, self.mechanism, values, until, first))
        # a short piece around each: no stage of those beside it is at the very time, which belongs to one side
        for t in times_between(self.sides, self.mechanism, values, until, first):
            times |= {beside for way in (-1.0, 1.0) if first < (beside := t + way * _BESIDE * until) < until}
        return tuple(Piece(t, {}) for t in (first, *sorted(times))) if times else ()


def foreseen(mechanism: Mechanism) -> Foreseen:
    """Return what is known beforehand of the formulas of joints, forces and integrals of a mechanism."""
    return Foreseen(mechanism, *_passed(mechanism))


@remembered
def _passed(mechanism: Mechanism) -> tuple[tuple[Jump, ...], tuple[Jump, ...], dict[Any, Any]]:
    return kinks_of(mechanism), sides_of(mechanism), {}


def times_between(
    jumps: Sequence[Jump], mechanism: Mechanism, values: Mapping[str, float], until: float, first: float = 0.0
) -> tuple[float, ...]:
    """Return the times inside a run at which formulas pass levels.

    Parameters
    ----------
    jumps : sequence of Jump
        From `symgen.describe.kinks`. What passes levels more often than can be told apart is left out, and what repeats
        its levels unless it is a straight line in t.
    mechanism : Mechanism
        Whose tables they may read.
    values : mapping of str to float
        Of all parameters.
    until, first : float
        End and begin of the run [s].

    Returns
    -------
    tuple of float
        In order [s]; empty where they are more than `MOST_KINKS`.
    """
    formulas, found, apart = InTime(mechanism, values), set[float](), SAME * until
    for jump in jumps:
        if jump.period > 0.0:
            line = line_of(jump, values)
            if line is None or not math.isfinite(sum(line)):
                continue
            jump = _unrolled(jump, *sorted(line[0] + line[1] * t for t in (first, until)))
        try:
            found.update(formulas.crossings(jump, until, first, MOST_KINKS))
        except InputError:
            continue
    times = list[float]()
    for t in sorted(found):
        if t - (times[-1] if times else first) > apart and until - t > apart:
            times.append(t)
    return tuple(times) if len(times) <= MOST_KINKS else ()


def _unrolled(jump: Jump, low: float, high: float) -> Jump:
    """Return a jump with all the levels between two values that repeat themselves, none where they are too many."""
    first, last = (math.floor((x - jump.levels[0]) / jump.period) for x in (low, high))
    own = jump.levels[:-1]  # the last point is the first one of the next period
    if (last - first + 1) * len(own) > MOST_KINKS + 2 * len(jump.levels):
        return replace(jump, levels=())
    return replace(jump, levels=tuple(x + k * jump.period for k in range(first, last + 1) for x in own))

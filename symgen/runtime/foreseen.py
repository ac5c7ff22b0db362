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
from typing import Any, NamedTuple

from symgen.describe.evaluate import parameter_values
from symgen.describe.inputs import Jump
from symgen.describe.kinks import kinks_of, sides_of
from symgen.describe.mechanism import Event, Mechanism
from symgen.describe.remembered import remembered
from symgen.errors import InputError
from symgen.runtime.in_time import MOST_PIECES, InTime, line_of
from symgen.runtime.pieces import SAME, Piece
from symgen.vocabulary.expressions import names

#: So far beside a jump, as a part of the run, a step ends and another begins.
_BESIDE = 1e-12


class _Found(NamedTuple):
    """The pieces of a motion, and whether they end at all that formulas pass."""

    pieces: tuple[Piece, ...] = ()
    all: bool = True


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
        What was found last, by what it depends on.
    whole : dict
        Whether that was all, of everything that was looked for.
    """

    mechanism: Mechanism
    kinks: tuple[Jump, ...] = ()
    sides: tuple[Jump, ...] = ()
    known: dict[tuple[float, ...], _Found] = field(default_factory=dict, repr=False, compare=False)
    whole: dict[tuple[float, ...], bool] = field(default_factory=dict, repr=False, compare=False)

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
        return self._found(values, until, first).pieces

    def are_all(self, values: Mapping[str, float], until: float) -> bool:
        """Return whether `pieces` end at all that formulas pass; with too many times they end at none.

        Parameters
        ----------
        values, until
            As for `pieces`.
        """
        key = self._key(values, until, 0.0)
        return self.whole[key] if key in self.whole else self._found(values, until, 0.0).all

    def _key(self, values: Mapping[str, float], until: float, first: float) -> tuple[float, ...]:
        return until, first, *(values[name] for name in sorted(self.reads & values.keys()))

    def _found(self, values: Mapping[str, float], until: float, first: float) -> _Found:
        if not self:
            return _Found()
        key = self._key(values, until, first)
        found = self.known.get(key)
        if found is None:  # runs that are compared, or of a sweep, often differ in nothing of that
            found = self._looked_for(values, until, first)
            self.known.clear()  # threads of a sweep do so, too
            self.known[key] = found
            if first == 0.0:  # runs without end ask for one window after the other
                self.whole[key] = found.all
        return found

    def missed(self, values: Mapping[str, float], until: float, step: float | None) -> list[str]:
        """Return what steps of a run may not see, in words: constant ones what is shorter than one.

        Parameters
        ----------
        values, until
            As for `pieces`.
        step : float or None
            The constant step [s]; none where steps are adaptive.
        """
        if not self.are_all(values, until):
            often = "formulas change, or pass points of tables, more often than can be told apart"
            return [f"{often}: steps do not end there, and may miss what is short"]
        if step is None:
            return []
        near = self.closest(values, until)
        if near is None or near[1] - near[0] >= step:
            return []
        what = f"formulas change at t = {near[0]:.9g} and {near[1]:.9g} s, within one step of {step:g} s"
        return [f"{what}: constant steps may miss what lies between; adaptive ones do not"]

    def closest(self, values: Mapping[str, float], until: float) -> tuple[float, float] | None:
        """Return the two times inside a run [s] that are closest to each other, points of tables left aside.

        Parameters
        ----------
        values, until
            As for `pieces`.
        """
        jumps = [*self.sides, *(kink for kink in self.kinks if kink.levels == (0.0,))]
        times, _ = times_between(jumps, self.mechanism, values, until)
        return min(pairwise(times), key=_length, default=None)

    def times(self, values: Mapping[str, float], until: float, first: float) -> tuple[float, ...]:
        """Return all times inside a motion at which formulas pass something [s].

        Parameters
        ----------
        values, until, first
            As for `pieces`.
        """
        return times_between((*self.kinks, *self.sides), self.mechanism, values, until, first)[0]

    def _looked_for(self, values: Mapping[str, float], until: float, first: float) -> _Found:
        kinks, all_kinks = times_between(self.kinks, self.mechanism, values, until, first)
        sides, all_sides = times_between(self.sides, self.mechanism, values, until, first)
        times = set(kinks)
        # a short piece around each: no stage of those beside it is at the very time, which belongs to one side
        for t in sides:
            times |= {beside for way in (-1.0, 1.0) if first < (beside := t + way * _BESIDE * until) < until}
        begins = sorted(times)
        pieces = tuple(Piece(t, {}) for t in (first, *begins)) if begins else ()
        return _Found(pieces, all_kinks and all_sides)


def _length(pair: tuple[float, float]) -> float:
    return pair[1] - pair[0]


def foreseen(mechanism: Mechanism, events: Sequence[Event] = ()) -> Foreseen:
    """Return what is known beforehand of the formulas of joints, forces and integrals of a mechanism, and of events.

    An event that is a straight line in t is found wherever steps end; another one may come and go within a step.
    """
    if not events:
        return Foreseen(mechanism, *_passed(mechanism))
    timely = {p.name for p in mechanism.parameters if not p.input} | {"t"}
    values = parameter_values(mechanism)
    happening = (
        jump
        for jump in (Jump(event.when) for event in events)
        if "t" in (read := {*names(jump.argument)}) and read <= timely and line_of(jump, values) is None
    )
    sides = *sides_of(mechanism, events), *happening
    return Foreseen(mechanism, kinks_of(mechanism, events), sides)


@remembered
def _passed(mechanism: Mechanism) -> tuple[tuple[Jump, ...], tuple[Jump, ...], dict[Any, Any]]:
    return kinks_of(mechanism), sides_of(mechanism), {}


def times_between(
    jumps: Sequence[Jump], mechanism: Mechanism, values: Mapping[str, float], until: float, first: float = 0.0
) -> tuple[tuple[float, ...], bool]:
    """Return the times inside a run at which formulas pass levels, and whether these are all.

    Parameters
    ----------
    jumps : sequence of Jump
        From `symgen.describe.kinks`. What passes levels more often than can be told apart is left out.
    mechanism : Mechanism
        Whose tables they may read.
    values : mapping of str to float
        Of all parameters.
    until, first : float
        End and begin of the run [s].

    Returns
    -------
    tuple of float
        In order [s]; empty where they are more than `MOST_PIECES`.
    bool
        Whether nothing was left out.
    """
    formulas, found, apart, whole = InTime(mechanism, values), set[float](), SAME * until, True
    for jump in jumps:
        try:
            found.update(formulas.crossings(_unrolled(jump, formulas, until, first), until, first))
        except InputError:
            whole = False
    times = list[float]()
    for t in sorted(found):
        if t - (times[-1] if times else first) > apart and until - t > apart:
            times.append(t)
    return (tuple(times), whole) if len(times) <= MOST_PIECES else ((), False)


def _unrolled(jump: Jump, formulas: InTime, until: float, first: float) -> Jump:
    """Return a jump with all the levels that repeat themselves where its argument is in a run.

    Raises
    ------
    InputError
        If they are too many.
    """
    if jump.period == 0.0:
        return jump
    low, high = formulas.range(jump, until, first)
    turns = [(x - jump.levels[0]) / jump.period for x in (low, high)]
    own = jump.levels[:-1]  # the last point is the first one of the next period
    if not (turns[1] - turns[0] + 1.0) * len(own) <= MOST_PIECES:
        raise InputError("formulas", f"at most {MOST_PIECES} points of a table", "more periods of it")
    count = range(math.floor(turns[0]), math.floor(turns[1]) + 1)
    return replace(jump, levels=tuple(x + k * jump.period for k in count for x in own))

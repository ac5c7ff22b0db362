"""Pieces of a run: times known beforehand at which an input jumps or has a kink, and what holds between them.

A run ends a step at each of these times and sets the numbers of the next piece before it goes on, so that no step and
no stage of one sees two sides of a jump.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from itertools import pairwise

from symgen.describe.inputs import Driven
from symgen.errors import InputError
from symgen.runtime.in_time import MOST_PIECES, InTime

#: Jumps closer than this part of the run are one.
SAME = 1e-14


@dataclass(frozen=True)
class Piece:
    """A part of a run.

    Attributes
    ----------
    begin : float
        Where it begins [s].
    values : mapping of str to float
        Inputs that are others than in the piece before; in the first one all that vary.
    """

    begin: float
    values: Mapping[str, float]


def pieces_of(
    driven: Driven, values: Mapping[str, float], until: float, first: float = 0.0, behind: float = 0.0
) -> tuple[Piece, ...]:
    """Return the pieces of a motion from `first` to `until`, none where nothing jumps.

    Parameters
    ----------
    driven : Driven
        What inputs are.
    values : mapping of str to float
        Of all parameters.
    until, first : float
        End of the run, and its begin [s].
    behind : float
        So far behind the end, as a part of it, jumps are looked for as well: data need not reach there.

    Raises
    ------
    InputError
        If there are too many, or smooth data end before the run does.
    """
    formulas = InTime(driven.mechanism, values)
    for name, data in driven.curves.items():
        if data.t[0] > first or data.t[-1] < until:
            got = f"those from {data.t[0]:g} to {data.t[-1]:g} s"
            raise InputError(f"input '{name}'", f"data from {first:g} to {until:g} s, as curves end where they do", got)

    until *= 1.0 + behind
    found = {t for data in driven.samples.values() for t in data.t}
    for jump in driven.jumps:
        found.update(formulas.crossings(jump, until, first))
    times = [first]
    for t in sorted(found):
        if t - times[-1] > SAME * until and until - t > SAME * until:
            times.append(t)
    if len(times) > MOST_PIECES:
        raise InputError("inputs", f"at most {MOST_PIECES} jumps", f"{len(times) - 1}")
    switches = [jump for jump in driven.jumps if jump.switch]
    if not (switches or driven.samples or len(times) > 1):
        return ()
    result, before = list[Piece](), dict[str, float]()
    for begin, end in pairwise([*times, until]):
        middle = 0.5 * (begin + end)
        now = {name: data.at(middle) for name, data in driven.samples.items()}
        now |= {jump.switch: 0.0 if math.isnan(x := formulas.at(jump.value, middle)) else x for jump in switches}
        result.append(Piece(begin, {name: x for name, x in now.items() if before.get(name) != x}))
        before = now
    return tuple(result)


def merged(pieces: tuple[Piece, ...], kinks: tuple[Piece, ...]) -> tuple[Piece, ...]:
    """Return pieces of a run that end where others of it do, too, those in which numbers change first named."""
    if not (pieces and kinks):
        return pieces or kinks
    found, apart = list[Piece](), SAME * kinks[-1].begin
    for piece in sorted([*pieces, *kinks], key=lambda piece: piece.begin):
        if found and piece.begin - found[-1].begin <= apart:  # one of the two changes no number
            found[-1] = Piece(found[-1].begin, {**found[-1].values, **piece.values})
        else:
            found.append(piece)
    return tuple(found)

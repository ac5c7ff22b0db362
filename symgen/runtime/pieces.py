"""Pieces of a run: times known beforehand at which an input jumps or has a kink, and what holds between them.

A run ends a step at each of these times and sets the numbers of the next piece before it goes on, so that no step and
no stage of one sees two sides of a jump.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from itertools import pairwise

from symgen.describe.evaluate import evaluate
from symgen.describe.inputs import Driven, Jump
from symgen.describe.mechanism import Mechanism
from symgen.errors import InputError
from symgen.vocabulary.expressions import Call, Expr, Name, Number, names

#: Pieces of a run at most.
MOST_PIECES = 100_000
#: Kinks of tables that a run stops at, at most: with more of them none, as each costs a step.
MOST_KINKS = 2000
#: Instants at which a formula is looked at first, and at most, until it changes sides as often as the time before.
_FIRST, _MOST = 2048, 65536
#: Jumps closer than this part of the run are one.
_SAME = 1e-14
_GOLDEN = 0.5 * (math.sqrt(5.0) - 1.0)


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
    at = values_at(driven.mechanism, values)
    for name, data in driven.curves.items():
        if data.t[0] > first or data.t[-1] < until:
            got = f"those from {data.t[0]:g} to {data.t[-1]:g} s"
            raise InputError(f"input '{name}'", f"data from {first:g} to {until:g} s, as curves end where they do", got)

    until *= 1.0 + behind
    found = {t for data in driven.samples.values() for t in data.t}
    for jump in driven.jumps:
        found.update(crossings(partial(at, jump.argument), line_of(jump, values), jump.levels, until, first))
    times = [first]
    for t in sorted(found):
        if t - times[-1] > _SAME * until and until - t > _SAME * until:
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
        now |= {jump.switch: 0.0 if math.isnan(x := at(jump.value, middle)) else x for jump in switches}
        result.append(Piece(begin, {name: x for name, x in now.items() if before.get(name) != x}))
        before = now
    return tuple(result)


def values_at(mechanism: Mechanism, values: Mapping[str, float]) -> Callable[[Expr, float], float]:
    """Return what gives a formula of parameters and t at a time [s]; not a number where it is undefined.

    Parameters
    ----------
    mechanism : Mechanism
        Whose tables it may read.
    values : mapping of str to float
        Of the parameters.
    """
    tables = {table.name: table for table in mechanism.tables}

    def at(e: Expr, t: float) -> float:
        try:
            return evaluate(e, {**values, "t": t}, tables=tables)
        except InputError:  # no comparison with it holds
            return math.nan

    return at


def kinks_between(jumps: Sequence[Jump], values: Mapping[str, float], until: float) -> tuple[float, ...]:
    """Return the times inside a run at which arguments that are straight lines in t pass points of tables.

    Parameters
    ----------
    jumps : sequence of Jump
        From `symgen.describe.kinks.kinks_of`.
    values : mapping of str to float
        Of all parameters.
    until : float
        End of the run [s].

    Returns
    -------
    tuple of float
        In order [s]; empty where they are more than `MOST_KINKS`.
    """
    found, apart = set[float](), _SAME * until
    for jump in jumps:
        line = line_of(jump, values)
        if line is None or not math.isfinite(sum(line)) or line[1] == 0.0:
            continue
        levels: Sequence[float] = jump.levels
        if jump.period > 0.0:  # the last point is the first one of the next period
            ends = sorted((line[0], line[0] + line[1] * until))
            turns = [math.floor((x - levels[0]) / jump.period) for x in ends]
            if (turns[1] - turns[0] + 1) * (len(levels) - 1) > MOST_KINKS + 2 * len(levels):
                return ()
            levels = [x + k * jump.period for k in range(turns[0], turns[1] + 1) for x in levels[:-1]]
        found.update(crossings(lambda t: t, line, levels, until))
    times = list[float]()
    for t in sorted(found):
        if t - (times[-1] if times else 0.0) > apart and until - t > apart:
            times.append(t)
    return tuple(times) if len(times) <= MOST_KINKS else ()


def sides_between(
    sides: Sequence[Jump], mechanism: Mechanism, values: Mapping[str, float], until: float
) -> tuple[float, ...]:
    """Return the times [s] inside a run at which what formulas compare passes from one side to the other, in order.

    As `kinks_between`, of what `symgen.describe.kinks.sides_of` found in a mechanism, whose tables it may read. Empty
    where they are more than `MOST_KINKS`, or more than can be told apart.
    """
    at, found = values_at(mechanism, values), set[float]()
    for jump in sides:
        try:
            found.update(
                crossings(partial(at, jump.argument), line_of(jump, values), jump.levels, until, most=MOST_KINKS)
            )
        except InputError:
            return ()
    times = sorted(t for t in found if 0.0 < t < until)
    return tuple(times) if len(times) <= MOST_KINKS else ()


def pieces_at(times: Sequence[float]) -> tuple[Piece, ...]:
    """Return the pieces of a run between times at which nothing but a rate has a kink, none where there is none."""
    return tuple(Piece(t, {}) for t in (0.0, *times)) if times else ()


def merged(pieces: tuple[Piece, ...], kinks: tuple[Piece, ...]) -> tuple[Piece, ...]:
    """Return pieces of a run that end where others of it do, too, those in which numbers change first named."""
    if not (pieces and kinks):
        return pieces or kinks
    found, apart = list[Piece](), _SAME * kinks[-1].begin
    for piece in sorted([*pieces, *kinks], key=lambda piece: piece.begin):
        if found and piece.begin - found[-1].begin <= apart:  # one of the two changes no number
            found[-1] = Piece(found[-1].begin, {**found[-1].values, **piece.values})
        else:
            found.append(piece)
    return tuple(found)


def crossings(
    function: Callable[[float], float],
    line: tuple[float, float] | None,
    levels: Sequence[float],
    until: float,
    first: float = 0.0,
    most: int = MOST_PIECES,
) -> list[float]:
    """Return the times from `first` to `until` at which a function passes one of some levels.

    Parameters
    ----------
    function : callable
        Of the time [s].
    line : tuple of float or None
        Its value at 0 and its slope where it is a straight line.
    levels : sequence of float
        What it passes.
    until, first : float
        End and begin [s].
    most : int
        Times at most, where they are looked for.

    Raises
    ------
    InputError
        If it passes them more often, or too often to tell one time from the next.
    """
    if line is not None:
        value, slope = line
        return [t for level in levels if slope and first <= (t := (level - value) / slope) <= until]
    found, count, span = list[float](), _FIRST, until - first
    while True:
        # not equidistant, so that what is faster than the looks is seen to be: doubling finds more then
        times = [first + span * (i + 0.6 * (_GOLDEN * i % 1.0)) / count for i in range(count)] + [until]
        samples, before = [function(t) for t in times], len(found)
        if sum((a > level) != (b > level) for level in levels for a, b in pairwise(samples)) > most:
            raise InputError("inputs", f"at most {most} jumps", "a formula that changes sides more often")
        found = [t for level in levels for t in _passed(function, times, samples, level)]
        if count > _FIRST and len(found) == before:
            return found
        if count >= _MOST:
            got = "a formula that changes sides more often than can be told apart"
            raise InputError("inputs", f"at most {MOST_PIECES} jumps", got)
        count *= 2


def _passed(
    function: Callable[[float], float], times: Sequence[float], samples: Sequence[float], level: float
) -> list[float]:
    """Return where a function passes a level between instants at which it is known."""
    found = []
    for i in range(len(times) - 1):
        a, b = samples[i] - level, samples[i + 1] - level
        if (a > 0.0) != (b > 0.0):
            found.append(_bisected(function, times[i], times[i + 1], level))
            continue
        before, side = samples[i - 1] - level, a > 0.0
        if 0 < i and (before > 0.0) == side and abs(a) <= min(abs(before), abs(b)):
            # nearest to the level among its neighbours: it may pass it twice there
            low, high = times[i - 1], times[i + 1]
            t = _lowest(function, 1.0 if side else -1.0, low, high)
            if (function(t) - level > 0.0) != side:
                found += [_bisected(function, low, t, level), _bisected(function, t, high, level)]
    return found


def _bisected(function: Callable[[float], float], low: float, high: float, level: float) -> float:
    """Return the first number at which a function is on the side that it is on at `high`."""
    side = function(high) - level > 0.0
    while low < (middle := 0.5 * (low + high)) < high:
        if (function(middle) - level > 0.0) == side:
            high = middle
        else:
            low = middle
    return high


def _lowest(function: Callable[[float], float], sign: float, low: float, high: float) -> float:
    """Return where a function, times a sign, is smallest, by golden sections."""
    for _ in range(60):
        a, b = high - _GOLDEN * (high - low), low + _GOLDEN * (high - low)
        if sign * function(a) < sign * function(b):
            high = b
        else:
            low = a
    return 0.5 * (low + high)


def line_of(jump: Jump, values: Mapping[str, float]) -> tuple[float, float] | None:
    """Return value at 0 and slope of a jump's argument where that is a straight line in t."""

    def line(e: Expr) -> tuple[float, float] | None:
        if isinstance(e, Name) and e.name == "t":
            return 0.0, 1.0
        if isinstance(e, Number | Name) or "t" not in set(names(e)):
            try:
                return evaluate(e, values), 0.0
            except InputError:
                return None
        assert isinstance(e, Call), "a tree has three kinds of nodes"
        parts = [line(a) for a in e.arguments]
        if any(part is None for part in parts):
            return None
        (a, m), (b, n) = (parts[0] or (0.0, 0.0)), ((parts[1] if len(parts) > 1 else None) or (0.0, 0.0))
        if e.function in ("add", "sub", "neg"):
            sign = {"add": 1.0, "sub": -1.0, "neg": -1.0}[e.function]
            return (sign * a, sign * m) if e.function == "neg" else (a + sign * b, m + sign * n)
        if e.function == "mul" and 0.0 in (m, n):
            return a * b, a * n + b * m
        return (a / b, m / b) if e.function == "div" and n == 0.0 and b != 0.0 else None

    return line(jump.argument)

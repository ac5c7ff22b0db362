"""The search for events inside a step: which shorter step to try next, by values and rates of switching functions.

An event is a switching function g(t, q, v) that changes its sign in the direction asked for. `decide` is told g and its
rate g' at the end of a step, whole or shorter, and says what to do next; it is called by address, so that no loop is
compiled with a copy of it.

Which side of an event a run is on is kept as such, not taken from g: a state that lies on the event itself, up to
rounding, is on the side that it came from, and after a change of velocities on the side that it goes to.

What is kept is one array, in this order: numbers of the step (`HEAD`), columns with one number for each event
(`COLUMNS`), what the emitted function writes (values, then rates), a state and its rate, ``w`` and ``iw`` at the
beginning of the step and at the state that is looked at, and notes: time, number of the event, state.
"""

from __future__ import annotations

import math
from typing import Any

from symgen.runtime import abi
from symgen.runtime.frame import CROWD, MEET, NOTHING, SEEK, TAKE, TRY
from symgen.store.jit import jit

#: Numbers of a step: the step to try (`TRY`, which the frame reads), what is being done, how many events there are, 1
#: where rates need v', the bracket that is looked at, the whole step, what time resolves, attempts at extrema, rounds
#: in a bracket, its width three rounds ago, events found in the step, notes, and notes that found no room.
HEAD = (
    *("try", "doing", "count", "needs_rates", "low", "high", "whole", "resolution"),
    *("probes", "rounds", "width", "found", "noted", "lost"),
)
#: What is known of each event: direction asked for (0: any), 1 where it ends the loop, side at the beginning of the
#: step, 1 where it has just happened, 1 where g is on the other side by rounding alone, side at the lower end of the
#: bracket; g and g' at the beginning and at the end of the step and of the bracket.
COLUMNS = (
    *("direction", "leaves", "side", "fired", "grazing", "local"),
    *("g_start", "d_start", "g_end", "d_end", "g_low", "d_low", "g_high", "d_high"),
)
N_HEAD, N_COLUMNS = len(HEAD), len(COLUMNS)
(
    _FIRST,
    DOING,
    COUNT,
    NEEDS_RATES,
    LOW,
    HIGH,
    WHOLE,
    RESOLUTION,
    PROBES,
    ROUNDS,
    WIDTH,
    FOUND,
    NOTED,
    LOST,
) = range(N_HEAD)
(
    DIRECTION,
    LEAVES,
    SIDE,
    FIRED,
    GRAZING,
    LOCAL,
    G_START,
    D_START,
    G_END,
    D_END,
    G_LOW,
    D_LOW,
    G_HIGH,
    D_HIGH,
) = range(N_COLUMNS)
assert _FIRST == TRY, "the frame reads it there"
_NOTHING, _SEEK, _TAKE, _MEET, _CROWD = NOTHING, SEEK, TAKE, MEET, CROWD
#: What is being done: looking for events, taking the whole step, taking a step that ends in an event.
_LOOKING, _WHOLE_STEP, _TO_EVENT = range(3)
#: Notes that there is room for; a loop is left where half of it is taken.
NOTES = 256
#: Times closer than this part of the time are the same.
_RESOLVED = 4e-16
#: Attempts at extrema, rounds in a bracket and events in a single step, at most.
_MOST_PROBES, _MOST_ROUNDS, _MOST_FOUND = 12, 200, 100
#: An extremum of g below this part of its ends is rounding.
_ROUNDING = 1e-14


# -- the cubic through values and slopes at both ends of (0, 1) --------------------------------------------------------


@jit()
def cubic(g0: float, d0: float, g1: float, d1: float, x: float) -> float:
    """Return the value at x of the cubic with values g0, g1 and slopes d0, d1 at 0 and 1."""
    rise = g1 - g0
    return g0 + x * (d0 + x * (3.0 * rise - 2.0 * d0 - d1 + x * (d0 + d1 - 2.0 * rise)))


@jit()
def extremum(g0: float, d0: float, g1: float, d1: float, which: int) -> float:
    """Return where the cubic has its first or second extremum inside (0, 1), 2 where it has none."""
    rise = g1 - g0
    c, b, a = d0, 3.0 * rise - 2.0 * d0 - d1, 3.0 * (d0 + d1 - 2.0 * rise)  # a x^2 + 2 b x + c
    square = b * b - a * c
    if not square > 0.0:
        return 2.0
    q = -(b + math.copysign(math.sqrt(square), b))
    first = c / q if q != 0.0 else 2.0
    second = q / a if a != 0.0 else 2.0
    first = first if 0.0 < first < 1.0 else 2.0
    second = second if 0.0 < second < 1.0 else 2.0
    return min(first, second) if which == 0 else max(first, second)


@jit()
def side_of(g: float, before: float) -> float:
    """Return the side that g is on, 1 or -1; that of before where g is 0 or no number."""
    return 1.0 if g > 0.0 else -1.0 if g < 0.0 else before


@jit()
def asked(direction: float, before: float, after: float) -> bool:
    """Return whether a change of sides is one that is asked for."""
    return before != after and (direction == 0.0 or direction == after)


@jit()
def first_root(g0: float, d0: float, g1: float, d1: float, side: float) -> float:
    """Return where the cubic first leaves a side, g1 being on the other one; 0 where it has left it already."""
    low, below = 0.0, side * g0 >= 0.0
    for k in range(3):
        high = 1.0 if k == 2 else extremum(g0, d0, g1, d1, k)
        if high > 1.0:
            continue
        above = k == 2 or not side * cubic(g0, d0, g1, d1, high) >= 0.0
        if below and above:
            for _ in range(60):
                middle = 0.5 * (low + high)
                if side * cubic(g0, d0, g1, d1, middle) >= 0.0:
                    low = middle
                else:
                    high = middle
            return 0.5 * (low + high)
        low, below = high, not above
    return 0.0


@jit()
def hidden(g0: float, d0: float, g1: float, d1: float, side: float, direction: float) -> float:
    """Return an extremum that is first on the other side, where this hides a change that is asked for; else 2."""
    first, found, before = 2.0, False, side
    least = _ROUNDING * (abs(g0) + abs(g1))
    for k in range(3):
        x = 1.0 if k == 2 else extremum(g0, d0, g1, d1, k)
        if x > 1.0:
            continue
        g = g1 if k == 2 else cubic(g0, d0, g1, d1, x)
        after = side_of(g, before) if abs(g) > least else before
        if after != before:
            found = found or asked(direction, before, after)
            first = x if first > 1.0 and k < 2 else first
        before = after
    return first if found else 2.0


# -- the search --------------------------------------------------------------------------------------------------------


@jit()
def candidate(hunt: Any, n: int) -> float:
    """Return where to look next for the first change of sides in a bracket."""
    at = N_HEAD
    low, high, rounds = hunt[LOW], hunt[HIGH], int(hunt[ROUNDS])
    width = high - low
    if rounds % 3 == 0:
        slow = rounds > 0 and width > 0.25 * hunt[WIDTH]
        hunt[WIDTH] = width
        if slow:
            return float(0.5 * (low + high))
    x = 1.0
    for k in range(n):
        side, g1 = hunt[at + LOCAL * n + k], hunt[at + G_HIGH * n + k]
        if asked(hunt[at + DIRECTION * n + k], side, side_of(g1, side)):
            d0, d1 = width * hunt[at + D_LOW * n + k], width * hunt[at + D_HIGH * n + k]
            root = first_root(hunt[at + G_LOW * n + k], d0, g1, d1, side) if math.isfinite(d0 + d1) else 0.5
            x = min(x, root)
    x = low + x * width
    # a little beyond the root, seen from the nearer end, so that the bracket has it between two near ends
    ahead = x - low < high - x
    distance = x - low if ahead else high - x
    beyond = distance * min(0.1, math.sqrt(distance / hunt[WHOLE])) if rounds > 0 else 0.0
    x += beyond if ahead else -beyond
    least = 0.5 * hunt[RESOLUTION]
    return float(min(max(x, low + least), high - least))


@jit()
def move_on(hunt: Any, n: int) -> None:
    """Look at the rest of the step, behind the bracket."""
    at = N_HEAD
    for k in range(n):
        hunt[at + LOCAL * n + k] = side_of(hunt[at + G_HIGH * n + k], hunt[at + LOCAL * n + k])
        hunt[at + G_LOW * n + k] = hunt[at + G_HIGH * n + k]
        hunt[at + D_LOW * n + k] = hunt[at + D_HIGH * n + k]
        hunt[at + G_HIGH * n + k] = hunt[at + G_END * n + k]
        hunt[at + D_HIGH * n + k] = hunt[at + D_END * n + k]
    hunt[LOW], hunt[HIGH], hunt[ROUNDS] = hunt[HIGH], hunt[WHOLE], 0.0


@jit()
def note(hunt: Any, n: int, notes: int, t: float, width: int, y: Any) -> None:
    """Note the time and the state of all events that happen at the end of the bracket."""
    at = N_HEAD
    for k in range(n):
        side = hunt[at + LOCAL * n + k]
        if asked(hunt[at + DIRECTION * n + k], side, side_of(hunt[at + G_HIGH * n + k], side)):
            i = int(hunt[NOTED])
            if i < NOTES:
                to = notes + i * (2 + width)
                hunt[to], hunt[to + 1] = t, float(k)
                for j in range(width):
                    hunt[to + 2 + j] = y[j]
                hunt[NOTED] += 1.0
            else:
                hunt[LOST] += 1.0


@jit()
def settle(hunt: Any, n: int, ends: bool) -> None:
    """Have the end of the step, or of the bracket, as the beginning of the next step."""
    at = N_HEAD
    g, d = (G_END, D_END) if ends else (G_HIGH, D_HIGH)
    for k in range(n):
        local, side = hunt[at + LOCAL * n + k], side_of(hunt[at + g * n + k], hunt[at + LOCAL * n + k])
        leaves = not ends and asked(hunt[at + DIRECTION * n + k], local, side)
        hunt[at + FIRED * n + k] = 1.0 if leaves else 0.0
        hunt[at + GRAZING * n + k] *= 1.0 if side * hunt[N_HEAD + N_COLUMNS * n + k] < 0.0 else 0.0
        hunt[at + SIDE * n + k] = side
        hunt[at + G_START * n + k] = hunt[at + g * n + k]
        hunt[at + D_START * n + k] = hunt[at + d * n + k]


@jit()
def crossed(hunt: Any, n: int, column: int, leaving: bool) -> bool:
    """Return whether an event happens between the lower end of the bracket and where a column has g."""
    at = N_HEAD
    for k in range(n):
        side = hunt[at + LOCAL * n + k]
        if asked(hunt[at + DIRECTION * n + k], side, side_of(hunt[at + column * n + k], side)):
            if not leaving or hunt[at + LEAVES * n + k] != 0.0:
                return True
    return False


@jit()
def take_in(hunt: Any, n: int, h: float, following: float, hunting: int) -> None:
    """Take the values at the state that was tried, which stand behind the columns, into the bracket."""
    at, out = N_HEAD, N_HEAD + N_COLUMNS * n
    for k in range(n):
        before = abs(hunt[at + G_START * n + k])
        near = h * abs(hunt[at + D_START * n + k]) < 4.0 * before and abs(hunt[out + k]) < 8.0 * before
        if near and hunt[at + GRAZING * n + k] != 0.0:
            hunt[out + k] = hunt[at + SIDE * n + k] * before  # has not come away from the event yet
    if hunting == _NOTHING:
        hunt[DOING], hunt[LOW], hunt[HIGH], hunt[WHOLE] = _LOOKING, 0.0, h, h
        hunt[PROBES] = hunt[ROUNDS] = hunt[FOUND] = 0.0
        hunt[RESOLUTION] = _RESOLVED * max(abs(following - h), abs(following))
        for k in range(n):
            hunt[at + LOCAL * n + k] = hunt[at + SIDE * n + k]
            hunt[at + G_LOW * n + k] = hunt[at + G_START * n + k]
            hunt[at + D_LOW * n + k] = hunt[at + D_START * n + k]
            hunt[at + G_HIGH * n + k] = hunt[at + G_END * n + k] = hunt[out + k]
            hunt[at + D_HIGH * n + k] = hunt[at + D_END * n + k] = hunt[out + n + k]
        return
    inside = h == hunt[HIGH]
    for k in range(n):
        side = hunt[at + LOCAL * n + k]
        inside = inside or asked(hunt[at + DIRECTION * n + k], side, side_of(hunt[out + k], side))
    g, d = (G_HIGH, D_HIGH) if inside else (G_LOW, D_LOW)
    for k in range(n):
        if not inside:
            hunt[at + LOCAL * n + k] = side_of(hunt[out + k], hunt[at + LOCAL * n + k])
        hunt[at + g * n + k] = hunt[out + k]
        hunt[at + d * n + k] = hunt[out + n + k]
    hunt[HIGH if inside else LOW] = h


@jit(abi.DECIDE.signature)
def decide(hunt: Any, n: int, notes: int, following: float, h: float, hunting: int, width: int, y: Any) -> int:
    """Take in what was found at a state and return what to do next, one of `NOTHING`, `SEEK`, `TAKE`, `MEET`, `CROWD`.

    Parameters
    ----------
    hunt : Array
        What is kept of events.
    n, notes : int
        How many events there are, and where notes begin.
    following, h : float
        End and length of the step that was tried [s].
    hunting : int
        What the step was tried for.
    width, y : int, Array
        The state at its end.
    """
    at = N_HEAD
    if hunting == _TAKE and hunt[DOING] == _WHOLE_STEP:
        settle(hunt, n, True)
        return _CROWD if 2 * hunt[NOTED] >= NOTES else _NOTHING
    take_in(hunt, n, h, following, hunting)
    if hunting == _TAKE:
        note(hunt, n, notes, following, width, y)
        settle(hunt, n, False)
        return _MEET
    while True:
        low, high = hunt[LOW], hunt[HIGH]
        if crossed(hunt, n, G_HIGH, False):
            if high - low > hunt[RESOLUTION] and hunt[ROUNDS] < _MOST_ROUNDS:
                hunt[TRY] = candidate(hunt, n)
                hunt[ROUNDS] += 1.0
                return _SEEK
            if crossed(hunt, n, G_HIGH, True):
                hunt[DOING], hunt[TRY] = _TO_EVENT, high
                return _TAKE
            if h != high:
                hunt[TRY] = high
                return _SEEK
            note(hunt, n, notes, following, width, y)
            hunt[FOUND] += 1.0
            if hunt[FOUND] >= _MOST_FOUND:
                hunt[HIGH] = hunt[WHOLE]
                for k in range(n):
                    hunt[at + G_HIGH * n + k] = hunt[at + G_END * n + k]
            hunt[PROBES] = 0.0
            move_on(hunt, n)
            if hunt[LOW] >= hunt[WHOLE]:
                break
            continue
        x = 2.0
        if hunt[PROBES] < _MOST_PROBES and high - low > 8.0 * hunt[RESOLUTION]:
            for k in range(n):
                g0, g1 = hunt[at + G_LOW * n + k], hunt[at + G_HIGH * n + k]
                d0, d1 = (high - low) * hunt[at + D_LOW * n + k], (high - low) * hunt[at + D_HIGH * n + k]
                if math.isfinite(d0 + d1):
                    x = min(x, hidden(g0, d0, g1, d1, hunt[at + LOCAL * n + k], hunt[at + DIRECTION * n + k]))
        if x < 1.0:
            hunt[PROBES] += 1.0
            hunt[ROUNDS] = 0.0
            hunt[TRY] = low + x * (high - low)
            return _SEEK
        if high >= hunt[WHOLE]:
            break
        move_on(hunt, n)
    if hunting == _NOTHING:
        settle(hunt, n, True)
        return _NOTHING
    hunt[DOING], hunt[TRY] = _WHOLE_STEP, hunt[WHOLE]
    return _TAKE

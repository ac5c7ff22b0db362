"""Where events lie inside a step: found by shorter steps from the same state, so with every scheme alike.

An event is a switching function g(t, q, v) that changes its sign in the direction asked for. After each good attempt
the loop (`symgen.runtime.frame`) evaluates g and its rate g' at the end of the step. Where a sign has changed, or the
cubic through g and g' at both ends has an extremum of the other sign between them, shorter steps from the same state
close in on the first change, until time resolves no more; the state at an event is that of such a step. Before each of
them emitted functions have what they remembered at the beginning of the step, so where an event is only noted, the
whole step is taken afterwards as if nothing had been.

Which side of an event a run is on is kept as such, not taken from g: a state that lies on the event itself, up to
rounding, is on the side that it came from, and after a change of velocities on the side that it goes to.

What is kept stands in ``run.hunt``, in this order: numbers of the step (`HEAD`), columns with one number for each
event (`COLUMNS`), what the emitted function writes (values, then rates), a state and its rate, ``w`` and ``iw`` at the
beginning of the step and at the state that is looked at, and notes: time, number of the event, state.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from numba import types
from numpy.typing import NDArray

from symgen.runtime import abi, frame
from symgen.runtime.bare import part
from symgen.runtime.frame import CROWD, MEET, NOTHING, SEEK, TAKE, TRY, evaluate
from symgen.runtime.instances import called
from symgen.runtime.instances import loop as compiled_loop
from symgen.runtime.records import OUTPUTS, SIZES, SPAN, STATE
from symgen.runtime.vectors import copied
from symgen.store.jit import jit

if TYPE_CHECKING:
    from symgen.runtime.records import Sizes

Array = NDArray[np.float64]

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
    _TRY,
    _DOING,
    _COUNT,
    _NEEDS_RATES,
    _LOW,
    _HIGH,
    _WHOLE,
    _RESOLUTION,
    _PROBES,
    _ROUNDS,
    _WIDTH,
    _FOUND,
    _NOTED,
    _LOST,
) = range(N_HEAD)
(
    _DIRECTION,
    _LEAVES,
    _SIDE,
    _FIRED,
    _GRAZING,
    _LOCAL,
    _G_START,
    _D_START,
    _G_END,
    _D_END,
    _G_LOW,
    _D_LOW,
    _G_HIGH,
    _D_HIGH,
) = range(N_COLUMNS)
assert HEAD[TRY] == "try"
_NOTHING, _SEEK, _TAKE, _MEET, _CROWD = NOTHING, SEEK, TAKE, MEET, CROWD
_EVALUATIONS, _TIME = abi.EVALUATIONS, abi.TIME
#: What is being done: looking for events, taking the whole step, taking a step that ends in an event.
_LOOKING, _WHOLE_STEP, _TO_EVENT = range(3)
#: Notes that there is room for; a loop is left where half of it is taken.
NOTES = 256
_NOTES = NOTES
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
    low, high, rounds = hunt[_LOW], hunt[_HIGH], int(hunt[_ROUNDS])
    width = high - low
    if rounds % 3 == 0:
        slow = rounds > 0 and width > 0.25 * hunt[_WIDTH]
        hunt[_WIDTH] = width
        if slow:
            return float(0.5 * (low + high))
    x = 1.0
    for k in range(n):
        side, g1 = hunt[at + _LOCAL * n + k], hunt[at + _G_HIGH * n + k]
        if asked(hunt[at + _DIRECTION * n + k], side, side_of(g1, side)):
            d0, d1 = width * hunt[at + _D_LOW * n + k], width * hunt[at + _D_HIGH * n + k]
            root = first_root(hunt[at + _G_LOW * n + k], d0, g1, d1, side) if math.isfinite(d0 + d1) else 0.5
            x = min(x, root)
    x = low + x * width
    # a little beyond the root, seen from the nearer end, so that the bracket has it between two near ends
    ahead = x - low < high - x
    distance = x - low if ahead else high - x
    beyond = distance * min(0.1, math.sqrt(distance / hunt[_WHOLE])) if rounds > 0 else 0.0
    x += beyond if ahead else -beyond
    least = 0.5 * hunt[_RESOLUTION]
    return float(min(max(x, low + least), high - least))


@jit()
def move_on(hunt: Any, n: int) -> None:
    """Look at the rest of the step, behind the bracket."""
    at = N_HEAD
    for k in range(n):
        hunt[at + _LOCAL * n + k] = side_of(hunt[at + _G_HIGH * n + k], hunt[at + _LOCAL * n + k])
        hunt[at + _G_LOW * n + k] = hunt[at + _G_HIGH * n + k]
        hunt[at + _D_LOW * n + k] = hunt[at + _D_HIGH * n + k]
        hunt[at + _G_HIGH * n + k] = hunt[at + _G_END * n + k]
        hunt[at + _D_HIGH * n + k] = hunt[at + _D_END * n + k]
    hunt[_LOW], hunt[_HIGH], hunt[_ROUNDS] = hunt[_HIGH], hunt[_WHOLE], 0.0


@jit()
def note(hunt: Any, n: int, notes: int, t: float, width: int, y: Any) -> None:
    """Note the time and the state of all events that happen at the end of the bracket."""
    at = N_HEAD
    for k in range(n):
        side = hunt[at + _LOCAL * n + k]
        if asked(hunt[at + _DIRECTION * n + k], side, side_of(hunt[at + _G_HIGH * n + k], side)):
            i = int(hunt[_NOTED])
            if i < _NOTES:
                to = notes + i * (2 + width)
                hunt[to], hunt[to + 1] = t, float(k)
                for j in range(width):
                    hunt[to + 2 + j] = y[j]
                hunt[_NOTED] += 1.0
            else:
                hunt[_LOST] += 1.0


@jit()
def settle(hunt: Any, n: int, ends: bool) -> None:
    """Have the end of the step, or of the bracket, as the beginning of the next step."""
    at = N_HEAD
    g, d = (_G_END, _D_END) if ends else (_G_HIGH, _D_HIGH)
    for k in range(n):
        local, side = hunt[at + _LOCAL * n + k], side_of(hunt[at + g * n + k], hunt[at + _LOCAL * n + k])
        leaves = not ends and asked(hunt[at + _DIRECTION * n + k], local, side)
        hunt[at + _FIRED * n + k] = 1.0 if leaves else 0.0
        hunt[at + _GRAZING * n + k] *= 1.0 if side * hunt[N_HEAD + N_COLUMNS * n + k] < 0.0 else 0.0
        hunt[at + _SIDE * n + k] = side
        hunt[at + _G_START * n + k] = hunt[at + g * n + k]
        hunt[at + _D_START * n + k] = hunt[at + d * n + k]


@jit()
def crossed(hunt: Any, n: int, column: int, leaving: bool) -> bool:
    """Return whether an event happens between the lower end of the bracket and where a column has g."""
    at = N_HEAD
    for k in range(n):
        side = hunt[at + _LOCAL * n + k]
        if asked(hunt[at + _DIRECTION * n + k], side, side_of(hunt[at + column * n + k], side)):
            if not leaving or hunt[at + _LEAVES * n + k] != 0.0:
                return True
    return False


@jit()
def take_in(hunt: Any, n: int, h: float, following: float, hunting: int) -> None:
    """Take the values at the state that was tried, which stand behind the columns, into the bracket."""
    at, out = N_HEAD, N_HEAD + N_COLUMNS * n
    for k in range(n):
        before = abs(hunt[at + _G_START * n + k])
        near = h * abs(hunt[at + _D_START * n + k]) < 4.0 * before and abs(hunt[out + k]) < 8.0 * before
        if near and hunt[at + _GRAZING * n + k] != 0.0:
            hunt[out + k] = hunt[at + _SIDE * n + k] * before  # has not come away from the event yet
    if hunting == _NOTHING:
        hunt[_DOING], hunt[_LOW], hunt[_HIGH], hunt[_WHOLE] = _LOOKING, 0.0, h, h
        hunt[_PROBES] = hunt[_ROUNDS] = hunt[_FOUND] = 0.0
        hunt[_RESOLUTION] = _RESOLVED * max(abs(following - h), abs(following))
        for k in range(n):
            hunt[at + _LOCAL * n + k] = hunt[at + _SIDE * n + k]
            hunt[at + _G_LOW * n + k] = hunt[at + _G_START * n + k]
            hunt[at + _D_LOW * n + k] = hunt[at + _D_START * n + k]
            hunt[at + _G_HIGH * n + k] = hunt[at + _G_END * n + k] = hunt[out + k]
            hunt[at + _D_HIGH * n + k] = hunt[at + _D_END * n + k] = hunt[out + n + k]
        return
    inside = h == hunt[_HIGH]
    for k in range(n):
        side = hunt[at + _LOCAL * n + k]
        inside = inside or asked(hunt[at + _DIRECTION * n + k], side, side_of(hunt[out + k], side))
    g, d = (_G_HIGH, _D_HIGH) if inside else (_G_LOW, _D_LOW)
    for k in range(n):
        if not inside:
            hunt[at + _LOCAL * n + k] = side_of(hunt[out + k], hunt[at + _LOCAL * n + k])
        hunt[at + g * n + k] = hunt[out + k]
        hunt[at + d * n + k] = hunt[out + n + k]
    hunt[_HIGH if inside else _LOW] = h


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
    if hunting == _TAKE and hunt[_DOING] == _WHOLE_STEP:
        settle(hunt, n, True)
        return _CROWD if 2 * hunt[_NOTED] >= _NOTES else _NOTHING
    take_in(hunt, n, h, following, hunting)
    if hunting == _TAKE:
        note(hunt, n, notes, following, width, y)
        settle(hunt, n, False)
        return _MEET
    while True:
        low, high = hunt[_LOW], hunt[_HIGH]
        if crossed(hunt, n, _G_HIGH, False):
            if high - low > hunt[_RESOLUTION] and hunt[_ROUNDS] < _MOST_ROUNDS:
                hunt[_TRY] = candidate(hunt, n)
                hunt[_ROUNDS] += 1.0
                return _SEEK
            if crossed(hunt, n, _G_HIGH, True):
                hunt[_DOING], hunt[_TRY] = _TO_EVENT, high
                return _TAKE
            if h != high:
                hunt[_TRY] = high
                return _SEEK
            note(hunt, n, notes, following, width, y)
            hunt[_FOUND] += 1.0
            if hunt[_FOUND] >= _MOST_FOUND:
                hunt[_HIGH] = hunt[_WHOLE]
                for k in range(n):
                    hunt[at + _G_HIGH * n + k] = hunt[at + _G_END * n + k]
            hunt[_PROBES] = 0.0
            move_on(hunt, n)
            if hunt[_LOW] >= hunt[_WHOLE]:
                break
            continue
        x = 2.0
        if hunt[_PROBES] < _MOST_PROBES and high - low > 8.0 * hunt[_RESOLUTION]:
            for k in range(n):
                g0, g1 = hunt[at + _G_LOW * n + k], hunt[at + _G_HIGH * n + k]
                d0, d1 = (high - low) * hunt[at + _D_LOW * n + k], (high - low) * hunt[at + _D_HIGH * n + k]
                if math.isfinite(d0 + d1):
                    x = min(x, hidden(g0, d0, g1, d1, hunt[at + _LOCAL * n + k], hunt[at + _DIRECTION * n + k]))
        if x < 1.0:
            hunt[_PROBES] += 1.0
            hunt[_ROUNDS] = 0.0
            hunt[_TRY] = low + x * (high - low)
            return _SEEK
        if high >= hunt[_WHOLE]:
            break
        move_on(hunt, n)
    if hunting == _NOTHING:
        settle(hunt, n, True)
        return _NOTHING
    hunt[_DOING], hunt[_TRY] = _WHOLE_STEP, hunt[_WHOLE]
    return _TAKE


# -- what the frame calls ----------------------------------------------------------------------------------------------


@called
def evaluate_events(system: Any, run: Any, t: float, y: Any) -> None:
    """Evaluate switching functions and their rates at a state; emitted functions remember nothing of it."""
    width, nw, ni, hunt = system.sizes.width, run.w.shape[0], run.iw.shape[0], run.hunt
    n = int(hunt[_COUNT])
    at = N_HEAD + N_COLUMNS * n
    out, state, rate = part(hunt, at, 2 * n), part(hunt, at + 2 * n, width), part(hunt, at + 2 * n + width, width)
    if hunt[_NEEDS_RATES] != 0.0:
        kept = at + 2 * n + 2 * width + nw + ni
        for i in range(nw):
            hunt[kept + i] = run.w[i]
        for i in range(ni):
            hunt[kept + nw + i] = run.iw[i]
        copied(width, y, state)
        evaluate(system, run, t, state, rate)  # which may close coordinates that depend on others
        run.control[_EVALUATIONS] += 1
        system.happens(t, y, run.p, run.w, rate, out)
        for i in range(nw):
            run.w[i] = hunt[kept + i]
        for i in range(ni):
            run.iw[i] = int(hunt[kept + nw + i])
    else:
        system.happens(t, y, run.p, run.w, rate, out)


def happened(system: Any, run: Any, t: float, following: float, h: float, hunting: int) -> int:
    """Look for events in a step whose end is good enough; return what to do next, see `decide`."""
    width = system.sizes.width
    evaluate_events(system, run, following, run.trial)
    n = int(run.hunt[_COUNT])
    notes = notes_at(n, width, run.w.shape[0], run.iw.shape[0])
    return int(system.decide(run.hunt, n, notes, following, h, hunting, width, run.trial))


@called
def look(system: Any, run: Any) -> None:
    """See on which side of each event a run begins, or goes on after its velocities or parameters were changed."""
    hunt = run.hunt
    n, at = int(hunt[_COUNT]), N_HEAD
    evaluate_events(system, run, run.clock[_TIME], run.y)
    out = at + N_COLUMNS * n
    for k in range(n):
        g, rate = hunt[out + k], hunt[out + n + k]
        if hunt[at + _SIDE * n + k] == 0.0:  # not known yet: the run begins
            hunt[at + _SIDE * n + k] = side_of(g, side_of(rate, -1.0))
        elif hunt[at + _FIRED * n + k] != 0.0:
            # the state lies on the event up to rounding, so the rate says where it goes to; at rest it may happen again
            hunt[at + _SIDE * n + k] = side_of(rate, -hunt[at + _SIDE * n + k])
            hunt[at + _GRAZING * n + k] = 1.0 if hunt[at + _SIDE * n + k] * g < 0.0 and rate != 0.0 else 0.0
        elif not asked(hunt[at + _DIRECTION * n + k], hunt[at + _SIDE * n + k], side_of(g, hunt[at + _SIDE * n + k])):
            hunt[at + _SIDE * n + k] = side_of(g, hunt[at + _SIDE * n + k])  # what velocities jump to is no event
        hunt[at + _G_START * n + k], hunt[at + _D_START * n + k] = g, rate


def remember(run: Any) -> None:
    """Keep what emitted functions remember at the beginning of a step."""
    nw, ni, n = run.w.shape[0], run.iw.shape[0], int(run.hunt[_COUNT])
    at = N_HEAD + (N_COLUMNS + 2) * n + 2 * run.trial.shape[0]
    for i in range(nw):
        run.hunt[at + i] = run.w[i]
    for i in range(ni):
        run.hunt[at + nw + i] = run.iw[i]


def recall(run: Any) -> None:
    """Have again what `remember` kept."""
    nw, ni, n = run.w.shape[0], run.iw.shape[0], int(run.hunt[_COUNT])
    at = N_HEAD + (N_COLUMNS + 2) * n + 2 * run.trial.shape[0]
    for i in range(nw):
        run.w[i] = run.hunt[at + i]
    for i in range(ni):
        run.iw[i] = int(run.hunt[at + nw + i])


@jit()
def notes_at(n: int, width: int, nw: int, ni: int) -> int:
    """Return where notes begin."""
    return N_HEAD + (N_COLUMNS + 2) * n + 2 * width + 2 * (nw + ni)


_MEANINGS: dict[str, Any] = {
    **{"EVENTS": True, "happened": happened, "look": look, "remember": remember, "recall": recall},
}
_loops: dict[Any, Any] = {}


def with_events(loop: Any) -> Any:
    """Return the loop that looks for events and is otherwise the same; made when it is first asked for.

    Parameters
    ----------
    loop : compiled loop
        From `symgen.runtime.frame.loop`.
    """
    if loop is None:  # an integrator whose loop depends on the model
        return None
    if loop not in _loops:
        (module, name, scheme, *functions), meanings = frame.RECIPES[loop]
        taken = {"rhs", "confirm", "accept", "happens", "decide", *functions}
        kinds = (kind if called in taken else types.int64 for called, kind in frame.FUNCTIONS.items())
        signature = types.int64(*kinds, scheme, SIZES, SPAN, STATE, OUTPUTS)
        own = f"{module.rpartition('.')[2]}_{name}"
        _loops[loop] = compiled_loop(__name__, own, frame.integrate, signature, **{**meanings, **_MEANINGS})
    return _loops[loop]


def __getattr__(name: str) -> Any:
    """Return the loop that `with_events` makes of one of the built-in schemes: another process asks for it by name."""
    from importlib import import_module
    from importlib.util import find_spec

    scheme, _, own = name.partition("_")
    if own and find_spec(f"symgen.runtime.schemes.{scheme}") is not None:
        loop = getattr(import_module(f"symgen.runtime.schemes.{scheme}"), own, None)
        if loop in frame.RECIPES:
            return with_events(loop)
    raise AttributeError(f"module '{__name__}' has no attribute '{name}'")


# -- from Python -------------------------------------------------------------------------------------------------------


def new_hunt(sizes: Sizes, nw: int, directions: Sequence[int], leaves: Sequence[bool], needs_rates: bool) -> Array:
    """Return what a run keeps of events before it has begun.

    Parameters
    ----------
    sizes : Sizes
        Of the model.
    nw : int
        Length of ``w``.
    directions : sequence of int
        1, -1 or 0: in which direction each event happens, 0 for both.
    leaves : sequence of bool
        Whether the loop is left where an event happens.
    needs_rates : bool
        Whether the switching functions or their rates depend on v'.
    """
    n = len(directions)
    if n == 0:
        return np.zeros(0)
    size = notes_at(n, sizes.width, nw, abi.N_COUNTERS) + NOTES * (2 + sizes.width)
    hunt = np.zeros(size)
    hunt[_COUNT], hunt[_NEEDS_RATES] = n, needs_rates
    hunt[N_HEAD + _DIRECTION * n : N_HEAD + (_DIRECTION + 1) * n] = directions
    hunt[N_HEAD + _LEAVES * n : N_HEAD + (_LEAVES + 1) * n] = leaves
    return hunt


def column(hunt: Array, name: str) -> Array:
    """Return a view of what is known of each event."""
    n = int(hunt[_COUNT])
    first = N_HEAD + COLUMNS.index(name) * n
    return hunt[first : first + n]


def taken_notes(hunt: Array, width: int, nw: int) -> list[tuple[float, int, Array]]:
    """Return time, number and state of the events noted so far, and make room for more."""
    first = notes_at(int(hunt[_COUNT]), width, nw, abi.N_COUNTERS)
    count, size = int(hunt[_NOTED]), 2 + width
    rows = hunt[first : first + count * size].reshape(count, size).copy()
    hunt[_NOTED] = 0.0
    return [(float(row[0]), int(row[1]), row[2:]) for row in rows]

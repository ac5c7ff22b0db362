"""The search for events inside a step: the next shorter step to try, by values and rates of switching functions.

An event is a switching function g(t, q, v) that changes its sign in its direction. `decide` takes g and its rate g' at
the end of a step, whole or shorter, and returns what to do next; it is called by address, so that no loop is compiled
with a copy of it.

The sign of an event function is stored, as rounding may flip it at the event: a state on the event itself is on the
side that it came from, and after a change of velocities on the side that it moves to.

All data are one array, see `symgen.run.loops.search_records`. Comparisons of the state in formulas are sought like
events; a step ends where one is passed, and the scheme restarts.
"""

from __future__ import annotations

from types import FunctionType
from typing import Any

from symgen.compile.loopcode.loop_instances import Instances
from symgen.compile.store.emitted import plain
from symgen.run.layout import abi
from symgen.run.loops.bracket import action_of_passages, move_bracket, note_events, settle_bracket, take_values
from symgen.run.loops.frame_parts import (
    CROWD,
    DIVIDE,
    DOUBT,
    FAIL,
    HOLD,
    LOOK,
    LOW,
    MEET,
    NOTHING,
    RESTART,
    SEEK,
    TAKE,
    TRY,
)
from symgen.run.loops.inside import concealed, divides, learn_slopes
from symgen.run.loops.search_records import (
    ACCEPTED,
    ACTION,
    AIM,
    ANEW,
    ASLEEP,
    BEFORE,
    BEGINNING,
    BLUR,
    CORNERS,
    D_END,
    D_START,
    DIRECTION,
    DOING,
    FIRED,
    G_END,
    G_HIGH,
    G_START,
    GIVE_BACK,
    GRAZING,
    HIGH,
    INSIDE,
    KEEP,
    LEAVE,
    MARGIN,
    MARGINS,
    MEASURE,
    N_COLUMNS,
    N_HEAD,
    N_STATES,
    N_VALUES,
    NOTE,
    NOTED,
    NOTES,
    PACE,
    PASSED,
    POINTS,
    PROBES,
    PROBING,
    REACH,
    ROUNDS,
    SIDE,
    SINCE,
    SIZE,
    TO_EVENT,
    UNCERTAIN,
    WHOLE,
    WHOLE_STEP,
)
from symgen.run.loops.switching import candidate, is_at_end, is_corner, is_sought, passes_corner, side_of
from symgen.run.loops.table_points import SHORT_OF, aim, arrive, ends_near, is_before, switch_values

A = Any
_COUNTERS = abi.N_COUNTERS
#: Changes of g by a reset below this fraction of its size in the step before are rounding.
_SAME = 1e-6
#: Margins below the negative of this part of their size contradict their mode.
_DEEP = 1e-4
#: Number of switches within this fraction of the time that stall a motion.
_CROWDED, _HEAP = 50.0, 1e-7
#: The proposed step of constant ones is infinite.
_ENDLESS = 1e300
#: Largest number of rounds in a bracket.
_MOST_ROUNDS = 200


@plain
def away(hunt: A, n: int, k: int, g: float) -> int:
    """Return 1 where the change of velocities at an event has taken its own g away from zero, else 0."""
    at = N_HEAD
    before, size = hunt[at + G_START * n + k], hunt[at + SIZE * n + k]
    return 1 if abs(g - before) > max(_SAME * size, 16.0 * abs(before)) else 0


@plain
def put_to_sleep(hunt: A, n: int, k: int) -> int:
    """Begin with the margin of a bounded row: its mode makes it positive, whatever rounding makes of its value.

    A value that is rounding, or what a method leaves of a closed row, decides nothing: the margin sleeps, lifted by as
    much, until it has left rounding, so that its first derivative that is more decides.
    """
    at, out = N_HEAD, N_HEAD + N_COLUMNS * n
    g, size = hunt[out + k], hunt[at + MEASURE * n + k]
    rounding = UNCERTAIN * size
    asleep, grazing, rises = rounding if g <= rounding else 0.0, 0.0, hunt[out + n + k] > hunt[at + PACE * n + k]
    if g < -0.5 * rounding:
        # lifted by twice as much where it rises, each flight of a low bounce would end as deep again
        asleep = (1.0 if rises else 2.0) * -g if -g <= _DEEP * size else 0.0
    elif rises:  # its rate decides
        asleep, grazing = 0.0, 1.0 if g < 0.0 else 0.0
    hunt[at + SIDE * n + k], hunt[at + GRAZING * n + k], hunt[at + ASLEEP * n + k] = 1.0, grazing, asleep
    hunt[at + G_START * n + k], hunt[at + D_START * n + k] = g + asleep, hunt[out + n + k]
    return 0


@plain
def look(hunt: A, n: int) -> int:
    """Set the side of each event on which a run begins, or continues after a change of velocities or parameters."""
    at, out = N_HEAD, N_HEAD + N_COLUMNS * n
    for k in range(n):
        g, rate, side = hunt[out + k], hunt[out + n + k], hunt[at + SIDE * n + k]
        if hunt[at + POINTS * n + k] > 0.0:
            arrive(hunt, n, k, 0.0)
            continue
        if CORNERS and is_corner(hunt, n, k) == 1:  # a row that comes into force passes none
            hunt[at + SIDE * n + k], hunt[at + GRAZING * n + k] = side_of(g, side_of(rate, 1.0)), 0.0
            hunt[at + G_START * n + k], hunt[at + D_START * n + k] = g, rate
            continue
        if hunt[at + MARGIN * n + k] != 0.0:
            put_to_sleep(hunt, n, k)
            continue
        if side == 0.0:  # the run begins; an event at rest on zero is on no side until it leaves it
            at_rest = -1.0 if hunt[at + ACTION * n + k] == float(ANEW) else 0.0
            hunt[at + SIDE * n + k] = side_of(g, side_of(rate, at_rest))
        elif hunt[at + FIRED * n + k] != 0.0 and away(hunt, n, k, g) == 0:
            # the state lies on the event up to rounding, so the rate decides the side; at rest it may happen again
            side = side_of(rate, -side)
            hunt[at + SIDE * n + k] = side
            hunt[at + GRAZING * n + k] = 1.0 if side * g < 0.0 and rate != 0.0 else 0.0
        elif hunt[at + FIRED * n + k] != 0.0 or is_sought(hunt[at + DIRECTION * n + k], side, side_of(g, side)) == 0:
            hunt[at + SIDE * n + k] = side_of(g, side)  # a jump of velocities is no event
            hunt[at + GRAZING * n + k] = 0.0
        hunt[at + G_START * n + k], hunt[at + D_START * n + k] = g, rate
    return 0


@plain
def is_undefined(hunt: A, n: int) -> int:
    """Return 1 where a switching function is nan at the trial state, else 0."""
    for k in range(n):
        g = hunt[N_HEAD + N_COLUMNS * n + k]
        if not g == g and hunt[N_HEAD + ACTION * n + k] < float(ANEW):
            return 1
    return 0


@plain
def keep(hunt: A, first: int, nw: int, w: A, iw: A) -> int:
    """Save the memory of emitted functions."""
    for i in range(nw):
        hunt[first + i] = w[i]
    for i in range(_COUNTERS):
        hunt[first + nw + i] = iw[i]
    return 0


@plain
def remember(hunt: A, n: int, t: float, width: int, y: A, nw: int, w: A, iw: A) -> int:
    """Save the memory of emitted functions at the beginning of a step; notes of a refused attempt are dropped.

    Time and state are saved where rows that may jump are examined.
    """
    hunt[NOTED] = hunt[ACCEPTED]
    at = int(hunt[BEGINNING])
    if at != 0:
        hunt[at] = t
        for j in range(width):
            hunt[at + 1 + j] = y[j]
    return int(keep(hunt, N_HEAD + (N_COLUMNS + N_VALUES) * n + N_STATES * width, nw, w, iw))


@plain
def give_back(hunt: A, first: int, nw: int, w: A, iw: A) -> int:
    """Restore the memory of emitted functions."""
    for i in range(nw):
        w[i] = hunt[first + i]
    for i in range(_COUNTERS):
        iw[i] = int(hunt[first + nw + i])
    return 0


@plain
def ended(hunt: A, n: int, notes: int, following: float, width: int, y: A) -> int:
    """Return the action at the end of a step that ends at a passage."""
    action = action_of_passages(hunt, n, G_HIGH, NOTE)
    note_events(hunt, n, notes, following, width, y)
    if CORNERS and passes_corner(hunt, n) == 1:
        if following - hunt[SINCE] > _HEAP * following:
            hunt[SINCE], hunt[PASSED] = following, 0.0
        hunt[PASSED] += 1.0
        if hunt[PASSED] > _CROWDED:  # to and fro, as in a valley in which two pieces push
            settle_bracket(hunt, n, 0)
            return HOLD
    if action >= ANEW:
        if following - hunt[SINCE] > _HEAP * following:
            hunt[SINCE], hunt[PASSED] = following, 0.0
        hunt[PASSED] += 1.0
    settle_bracket(hunt, n, 0)
    if action >= ANEW and hunt[PASSED] > _CROWDED:
        return HOLD
    return MEET if action != ANEW or hunt[NOTED] > NOTES else RESTART


@plain
def end_before(hunt: A, n: int, h: float) -> int:
    """Make a step of h, which ends before a switch, the whole step."""
    out = N_HEAD + N_COLUMNS * n
    for k in range(n):
        hunt[N_HEAD + G_END * n + k], hunt[N_HEAD + D_END * n + k] = hunt[out + k], hunt[out + n + k]
    hunt[WHOLE] = h
    return 0


@plain
def decide(hunt: A, n: int, notes: int, following: float, h: float, search: int, width: int, y: A, w: A, iw: A) -> int:
    """Take the values at a state and return what to do next, one of `NOTHING` to `FAIL`.

    All work on the data of events is done here, so that it is compiled once and separately.

    Parameters
    ----------
    hunt : Array
        Data of events.
    n, notes : int
        Number of functions, and first index of notes.
    following, h : float
        End and length of the trial step [s].
    search : int
        Purpose of the trial step; or another task: `LOOK`, `RECALL` at the beginning of a step, `KEEP`
        at an examined state and `GIVE_BACK`, `AIM` before a step of `h`.
    width, y : int, Array
        The state at its end.
    w, iw : Array
        Memory of emitted functions.
    """
    if search <= LOOK:
        if is_undefined(hunt, n) == 1:
            return NOTHING if search == DOUBT else FAIL
        switch_values(hunt, n, h, search)
    if search >= LOOK:
        if search == LOOK:
            return int(look(hunt, n))
        if search == AIM:
            return int(aim(hunt, n, h))
        first = N_HEAD + (N_COLUMNS + N_VALUES) * n + N_STATES * width
        size = (notes - first) // 2
        first += size if search == KEEP or search == GIVE_BACK else 0
        if search == KEEP:
            return int(keep(hunt, first, size - _COUNTERS, w, iw))
        return int(give_back(hunt, first, size - _COUNTERS, w, iw))
    if search == TAKE and hunt[DOING] != TO_EVENT:
        if hunt[DOING] == BEFORE:
            end_before(hunt, n, h)
        settle_bracket(hunt, n, 1)
        return CROWD if 2 * hunt[NOTED] >= NOTES else NOTHING
    take_values(hunt, n, h, following, search)
    if search == NOTHING and hunt[INSIDE] > 0.0 and hunt[REACH] < _ENDLESS and divides(hunt, n, h) == 1:
        return DIVIDE
    if MARGINS and search == NOTHING and hunt[INSIDE] > 0.0:
        learn_slopes(hunt, n, h)
    if search == TAKE:
        return int(ended(hunt, n, notes, following, width, y))
    if (
        search == DOUBT
        and action_of_passages(hunt, n, G_HIGH, NOTE) < ANEW
        and not (CORNERS and passes_corner(hunt, n) == 1)
    ):
        return NOTHING
    while True:
        high = hunt[HIGH]
        there = concealed(hunt, n)
        if action_of_passages(hunt, n, G_HIGH, NOTE) >= NOTE:
            near = 1 if h == high and there >= high and ends_near(hunt, n) == 1 else 0
            if near == 0 and is_before(hunt, n) == 1:
                hunt[DOING], hunt[TRY] = BEFORE, SHORT_OF * hunt[LOW]
                return TAKE
            enclosed = 1 if high - hunt[LOW] <= hunt[BLUR] or hunt[ROUNDS] >= _MOST_ROUNDS else near
            if CORNERS and passes_corner(hunt, n) == 1:
                near = 0
            elif enclosed == 0 and hunt[ROUNDS] > 0.0 and h == high and there >= high:
                enclosed = is_at_end(hunt, n)
            if enclosed == 0:
                hunt[TRY] = candidate(hunt, n)
                if there < hunt[TRY]:  # another event may come first, and be over by then
                    hunt[PROBES] += 1.0
                    hunt[TRY], hunt[PROBING] = there, 1.0
                hunt[ROUNDS] += 1.0
                return SEEK
            # where notes have to be taken to make room for others, the step ends here as well
            if action_of_passages(hunt, n, G_HIGH, LEAVE) >= LEAVE or hunt[NOTED] > NOTES:
                if search == NOTHING and near == 1:
                    return int(ended(hunt, n, notes, following, width, y))
                hunt[DOING], hunt[TRY] = TO_EVENT, high
                if CORNERS and hunt[LOW] > 0.0 and passes_corner(hunt, n) == 1:
                    hunt[TRY] = hunt[LOW]
                return TAKE
            if h != high:
                hunt[TRY] = high
                return SEEK
            note_events(hunt, n, notes, following, width, y)
            hunt[PROBES] = 0.0
            move_bracket(hunt, n)
            if hunt[LOW] >= hunt[WHOLE]:
                break
            continue
        if there < high:
            hunt[PROBES] += 1.0
            hunt[ROUNDS] = 0.0
            hunt[TRY], hunt[PROBING] = there, 1.0
            return SEEK
        if high >= hunt[WHOLE]:
            break
        move_bracket(hunt, n)
    if search == NOTHING:
        settle_bracket(hunt, n, 1)
        return NOTHING
    hunt[DOING], hunt[TRY] = WHOLE_STEP, hunt[WHOLE]
    return TAKE


def deciding(notes: int, margins: bool, corners: bool) -> A:
    """Return `decide` for a caller that takes notes after each step.

    Parameters
    ----------
    notes : int
        Room for notes, less than `NOTES`.
    margins, corners : bool
        Whether rows have bounds, and whether gaps have corners.
    """
    return _instance({"NOTES": notes, **_meanings(margins, corners)}, "decide")


def _meanings(margins: bool, corners: bool) -> dict[str, Any]:
    return ({"MARGINS": True} if margins else {}) | ({"CORNERS": True} if corners else {})


def _instance(meanings: dict[str, Any], name: str) -> A:
    """Return `decide` with other meanings of names."""

    def compiled(copy: FunctionType, original: object) -> A:
        copy.__name__ = copy.__qualname__ = name if original is decide else f"{copy.__name__}{name[len('decide') :]}"
        return plain(copy)

    return Instances(meanings, compiled).of(decide)


#: The same where rows have bounds. It looks for corners of gaps in any case: what a function means is a number, and of
#: two codes the one for corners would be compiled once more after a file without them.
decide_on_margins = _instance(_meanings(margins=True, corners=True), "decide_on_margins")


def search_of(margins: bool) -> A:
    """Return `decide` of runs with bounded rows, or without."""
    return decide_on_margins if margins else decide

"""The bracket of the search for events: the part of a step in which functions change their sides."""

from __future__ import annotations

from typing import Any

from symgen.compile.store.emitted import plain
from symgen.run.layout import abi
from symgen.run.loops.frame_parts import DOUBT, LOW, NOTHING
from symgen.run.loops.inner_points import slope_between, slopes_of_forces
from symgen.run.loops.search_records import (
    ACCEPTED,
    ACTION,
    ANEW,
    BLUR,
    D_END,
    D_HIGH,
    D_LOW,
    D_START,
    DIRECTION,
    DOING,
    FIRED,
    G_END,
    G_HIGH,
    G_LOW,
    G_START,
    GRAZING,
    HIGH,
    INSIDE,
    LEAVE,
    LOCAL,
    LOOKING,
    N_COLUMNS,
    N_HEAD,
    NOTED,
    POINTS,
    PROBES,
    PROBING,
    RESOLUTION,
    ROUNDS,
    SIDE,
    SIZE,
    WHOLE,
)
from symgen.run.loops.switching import is_sought, passes, side_of, taken_for, wake
from symgen.run.loops.table_points import arrive, bend

A = Any
_RESOLVED = abi.RESOLVED_TIME


@plain
def move_bracket(hunt: A, n: int) -> int:
    """Move the bracket to the rest of the step."""
    at = N_HEAD
    for k in range(n):
        hunt[at + LOCAL * n + k] = side_of(hunt[at + G_HIGH * n + k], hunt[at + LOCAL * n + k])
        hunt[at + G_LOW * n + k] = hunt[at + G_HIGH * n + k]
        hunt[at + D_LOW * n + k] = hunt[at + D_HIGH * n + k]
        hunt[at + G_HIGH * n + k] = hunt[at + G_END * n + k]
        hunt[at + D_HIGH * n + k] = hunt[at + D_END * n + k]
    hunt[LOW], hunt[HIGH], hunt[ROUNDS], hunt[BLUR] = hunt[HIGH], hunt[WHOLE], 0.0, hunt[RESOLUTION]
    return 0


@plain
def note_events(hunt: A, n: int, notes: int, t: float, width: int, y: A) -> int:
    """Note the time and the state of all events that happen at the end of the bracket."""
    at = N_HEAD
    for k in range(n):
        if hunt[at + ACTION * n + k] != float(ANEW) and passes(hunt, n, k, G_HIGH) == 1:
            to = notes + int(hunt[NOTED]) * (2 + width)
            hunt[to], hunt[to + 1] = t, float(k)
            for j in range(width):
                hunt[to + 2 + j] = y[j]
            hunt[NOTED] += 1.0
    return 0


@plain
def settle_bracket(hunt: A, n: int, ends: int) -> int:
    """Make the end of the step, or of the bracket where `ends` is 0, the beginning of the next step."""
    at = N_HEAD
    g, d = G_END if ends == 1 else G_HIGH, D_END if ends == 1 else D_HIGH
    for k in range(n):
        local, side = hunt[at + LOCAL * n + k], side_of(hunt[at + g * n + k], hunt[at + LOCAL * n + k])
        fired = is_sought(hunt[at + DIRECTION * n + k], local, side)
        hunt[at + FIRED * n + k] = 1.0 if ends == 0 and fired == 1 else 0.0
        hunt[at + GRAZING * n + k] *= 1.0 if side * hunt[N_HEAD + N_COLUMNS * n + k] < 0.0 else 0.0
        hunt[at + SIDE * n + k] = side
        hunt[at + SIZE * n + k] = max(abs(hunt[at + G_START * n + k]), abs(hunt[at + G_END * n + k]))
        bend(hunt, n, k, hunt[at + g * n + k], hunt[at + d * n + k], hunt[WHOLE] if ends == 1 else hunt[HIGH])
        hunt[at + G_START * n + k] = hunt[at + g * n + k]
        hunt[at + D_START * n + k] = hunt[at + d * n + k]
        if hunt[at + POINTS * n + k] > 0.0:
            arrive(hunt, n, k, hunt[WHOLE] if ends == 1 else hunt[HIGH])
        wake(hunt, n, k)
    hunt[ACCEPTED] = hunt[NOTED]
    return 0


@plain
def action_of_passages(hunt: A, n: int, column: int, least: int) -> int:
    """Return the highest action, at least `least`, of passages from the bracket's beginning to a column; -1: none."""
    at, highest = N_HEAD, -1
    for k in range(n):
        if passes(hunt, n, k, column) == 1:
            action = int(hunt[at + ACTION * n + k])
            if action == LEAVE:
                return LEAVE
            highest = max(highest, action)
    return highest if highest >= least else -1


@plain
def take_values(hunt: A, n: int, h: float, following: float, search: int) -> int:
    """Copy the values at the trial state, which follow the columns, into the bracket."""
    at, out = N_HEAD, N_HEAD + N_COLUMNS * n
    if search == NOTHING or search == DOUBT:
        hunt[DOING], hunt[LOW], hunt[HIGH], hunt[WHOLE] = LOOKING, 0.0, h, h
        hunt[PROBES] = hunt[ROUNDS] = hunt[PROBING] = 0.0
        hunt[RESOLUTION] = _RESOLVED * max(abs(following - h), abs(following))
        hunt[BLUR] = hunt[RESOLUTION]
        for k in range(n):
            hunt[at + LOCAL * n + k] = hunt[at + SIDE * n + k]
            hunt[at + G_LOW * n + k] = hunt[at + G_START * n + k]
            hunt[at + D_LOW * n + k] = hunt[at + D_START * n + k]
            value = taken_for(hunt, n, k, h)
            hunt[at + G_HIGH * n + k], hunt[at + G_END * n + k] = value, value
            hunt[at + D_HIGH * n + k], hunt[at + D_END * n + k] = hunt[out + n + k], hunt[out + n + k]
        if hunt[INSIDE] > 0.0:
            slopes_of_forces(hunt, n)
        return 0
    # the bracket ends where a function may have dipped, so that the search examines the motion before that point too
    inside = 1 if h == hunt[HIGH] or hunt[PROBING] != 0.0 else 0
    hunt[PROBING] = 0.0
    for k in range(n):
        side = hunt[at + LOCAL * n + k]
        inside = max(inside, is_sought(hunt[at + DIRECTION * n + k], side, side_of(taken_for(hunt, n, k, h), side)))
    g, d = G_HIGH if inside == 1 else G_LOW, D_HIGH if inside == 1 else D_LOW
    for k in range(n):
        if inside == 0:
            hunt[at + LOCAL * n + k] = side_of(taken_for(hunt, n, k, h), hunt[at + LOCAL * n + k])
        hunt[at + g * n + k] = taken_for(hunt, n, k, h)
        hunt[at + d * n + k] = slope_between(hunt, n, k, h, hunt[out + n + k])
    hunt[HIGH if inside == 1 else LOW] = h
    return 0

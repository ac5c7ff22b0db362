"""Records of loops that look for events; those of other loops (`symgen.runtime.records`) carry nothing of it."""

from __future__ import annotations

from typing import Any, NamedTuple

from numba import types

from symgen.runtime.records import STATE


class HuntingState(NamedTuple):
    """A `State` with `hunt`, what a run keeps of its events (`symgen.runtime.searching`)."""

    y: Any
    p: Any
    w: Any
    iw: Any
    clock: Any
    gauges: Any
    control: Any
    events: Any
    memory: Any
    share: Any
    metric: Any
    scales: Any
    room: Any
    hunt: Any


class HuntingRun(NamedTuple):
    """A `Run` with what is kept of events."""

    y: Any
    trial: Any
    p: Any
    w: Any
    iw: Any
    clock: Any
    gauges: Any
    control: Any
    events: Any
    memory: Any
    share: Any
    metric: Any
    scales: Any
    room: Any
    hunt: Any


class HuntingScheme(NamedTuple):
    """A scheme's record with the functions of events: switching functions with their rates, and what decides."""

    scheme: Any
    happens: Any
    decide: Any


class HuntingSystem(NamedTuple):
    """A `System` with the functions of events."""

    sizes: Any
    rhs: Any
    confirm: Any
    accept: Any
    turn: Any
    residual: Any
    tangent: Any
    happens: Any
    decide: Any


#: How compiled loops see what a run keeps.
HUNTING_STATE = types.NamedTuple((*STATE.types, STATE.types[0]), HuntingState)

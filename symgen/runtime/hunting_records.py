"""Records of loops that look for events; those of other loops (`symgen.runtime.records`) carry nothing of it."""

from __future__ import annotations

from typing import Any, NamedTuple

from numba import types

from symgen.runtime.records import STATE, Run, State, System, record

#: A `State` with `hunt`, what a run keeps of its events (`symgen.runtime.searching`).
HuntingState = record("HuntingState", *State._fields, "hunt", module=__name__)
#: A `Run` with what is kept of events.
HuntingRun = record("HuntingRun", *Run._fields, "hunt", module=__name__)
#: A `System` with the functions of events.
HuntingSystem = record("HuntingSystem", *System._fields, "happens", "decide", module=__name__)


class HuntingScheme(NamedTuple):
    """A scheme's record with the functions of events: switching functions with their rates, and what decides."""

    scheme: Any
    happens: Any
    decide: Any


#: How compiled loops see what a run keeps.
HUNTING_STATE = types.NamedTuple((*STATE.types, STATE.types[0]), HuntingState)

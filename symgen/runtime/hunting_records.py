"""Records of loops that look for events; those of other loops (`symgen.runtime.records`) carry nothing of it."""

from __future__ import annotations

from collections import namedtuple
from typing import Any, NamedTuple

from numba import types

from symgen.runtime.records import STATE, Run, State, System


def _more(name: str, of: Any, *fields: str) -> Any:
    """Return a record with the fields of another one and further ones, flat, so that loops read both alike."""
    return namedtuple(name, (*of._fields, *fields), module=__name__)


#: A `State` with `hunt`, what a run keeps of its events (`symgen.runtime.searching`).
HuntingState = _more("HuntingState", State, "hunt")
#: A `Run` with what is kept of events.
HuntingRun = _more("HuntingRun", Run, "hunt")
#: A `System` with the functions of events.
HuntingSystem = _more("HuntingSystem", System, "happens", "decide")


class HuntingScheme(NamedTuple):
    """A scheme's record with the functions of events: switching functions with their rates, and what decides."""

    scheme: Any
    happens: Any
    decide: Any


#: How compiled loops see what a run keeps.
HUNTING_STATE = types.NamedTuple((*STATE.types, STATE.types[0]), HuntingState)

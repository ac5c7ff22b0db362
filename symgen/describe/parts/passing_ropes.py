"""Ropes that leave their sheaves and come back, points that pass from piece to piece of a curve: states and events.

A rope over sheaves has a state for each, ``NAME.onK``, 1 while the rope is on the sheave, else 0; K counts the entries
of ``over``. An event takes the rope off where its arc has come to 0, ``NAME.leavesK``, another one puts it on where its
straight part touches again, ``NAME.comesK``. Length and direction of the rope go on there, so nothing jumps but
accelerations. All else that runs have for states and events they have for these.

A point that slides along a curve of pieces has one state, ``NAME.passed``, the stations that it has passed since the
start, forwards less backwards; no formula of the motion reads it. Its events ``NAME.passesK`` and ``NAME.returnsK`` are
just beyond stations, where accelerations jump: steps end there, and derivatives go through them. One that rests at a
station, up to rounding, has none.
"""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from typing import Any

import msgspec

from symgen.base.errors import InputError
from symgen.base.vocabulary.expressions import ON_SHEAVE, ONE, ZERO, Expr, Name, Number, call
from symgen.describe.formulas.evaluate import evaluate_formula
from symgen.describe.mechanism import AnyBody, Mechanism, ModeEvent, StateVariable
from symgen.describe.parts.driven_mechanism import put_formulas
from symgen.describe.parts.event_sections import RESET

#: Last words of the names of states and events, before the number of the sheave.
ON, LEAVES, COMES = "on", "leaves", "comes"
PASSED, PASSES, RETURNS = "passed", "passes", "returns"
_EVENTS = re.compile(rf"\.(?:{LEAVES}|{COMES}|{PASSES}|{RETURNS})[1-9][0-9]*$")
#: How far beyond a station its event is, in pieces.
BEYOND = 1e-7


class RopeSheave(msgspec.Struct, frozen=True):
    """A sheave that a rope may leave.

    Parameters
    ----------
    rope : str
        The joint.
    sheave : int
        Number of the sheave in `over`, from 1.
    first : Expr
        A formula of parameters, 1 where the rope is on the sheave at the start, else 0.
    arc : Expr
        The angle that the rope turns by on the sheave, or would turn by [rad]; below 0 it passes by.
    """

    rope: str
    sheave: int
    first: Expr
    arc: Expr


class CurveSlider(msgspec.Struct, frozen=True):
    """What a point that slides along a curve adds to a mechanism.

    Parameters
    ----------
    joint : str
        The joint.
    body : AnyBody
        The body without mass whose place is the way along the curve.
    stations : int
        Stations between the ends.
    passed : Expr
        The way in pieces.
    """

    joint: str
    body: AnyBody
    stations: int
    passed: Expr


def with_sliders(mechanism: Mechanism, sliders: Sequence[CurveSlider]) -> Mechanism:
    """Return a mechanism with the states and events of points that slide along curves."""
    states, events = list[StateVariable](), list[ModeEvent]()
    for x in sliders:
        state = Name(f"{x.joint}.{PASSED}")
        states.append(StateVariable(state.name, ZERO, ZERO))
        for k in range(1, x.stations + 1):
            for word, way, step in ((PASSES, "rising", 1.0), (RETURNS, "falling", -1.0)):
                when, value = call("sub", x.passed, Number(k + step * BEYOND)), call("add", state, Number(step))
                reset = ((state, value),)
                events.append(ModeEvent(f"{x.joint}.{word}{k}", when, way, RESET, reset, f"{x.joint} {word} {k}", word))
    if not sliders:
        return mechanism
    together = {"states": (*mechanism.states, *states), "events": (*mechanism.events, *events)}
    return msgspec.structs.replace(mechanism, **together)


def name_of_state(rope: str, sheave: int) -> str:
    """Return the name of the state that is 1 while a rope is on a sheave."""
    return f"{rope}.{ON}{sheave}"


def with_rope_sheaves(mechanism: Mechanism, sheaves: Sequence[RopeSheave]) -> Mechanism:
    """Return a mechanism with the states and events of ropes that may leave their sheaves."""
    states, events = list[StateVariable](), list[ModeEvent]()
    for x in sheaves:
        state = Name(name_of_state(x.rope, x.sheave))
        states.append(StateVariable(state.name, x.first, ZERO))
        off = call("sub", ONE, state)  # functions of what cannot happen are -1
        leaves = call("sub", call("neg", call("mul", state, x.arc)), off)
        comes = call("sub", call("mul", off, x.arc), state)
        for word, when, value in ((LEAVES, leaves, ZERO), (COMES, comes, ONE)):
            name, text = f"{x.rope}.{word}{x.sheave}", f"{x.rope} {word} sheave {x.sheave}"
            events.append(ModeEvent(name, when, "rising", RESET, ((state, value),), text, word))
    if not sheaves:
        return mechanism
    together = {"states": (*mechanism.states, *states), "events": (*mechanism.events, *events)}
    return msgspec.structs.replace(mechanism, **together)


def has_rope_sheaves(mechanism: Mechanism) -> bool:
    """Whether ropes may leave sheaves, or points slide along curves."""
    return any(ON_SHEAVE.search(x.name) for x in mechanism.states)


def without_rope_sheaves(
    mechanism: Mechanism, values: Mapping[str, float], states: Mapping[str, float] | None = None
) -> Mechanism:
    """Return a mechanism whose ropes stay on the sheaves that they are on in one state, and off the others.

    Parameters
    ----------
    mechanism : Mechanism
        The description.
    values : mapping of str to float
        Values of all parameters.
    states : mapping of str to float, optional
        States of the file's own by name; those of the start by default.
    """
    own = [x for x in mechanism.states if ON_SHEAVE.search(x.name)]
    if not own:
        return mechanism
    known = states or {}
    on = {x.name: Number(known.get(x.name, evaluate_formula(x.start, values, mechanism.name))) for x in own}
    changed: dict[str, Any] = {
        part: put_formulas(getattr(mechanism, part), on) for part in ("joints", "forces", "outputs")
    }
    changed["states"] = tuple(x for x in mechanism.states if x.name not in on)
    changed["events"] = tuple(x for x in mechanism.events if not _EVENTS.search(x.name))
    return msgspec.structs.replace(mechanism, **changed)


def refuse_rope_sheaves(where: str, mechanism: Mechanism) -> None:
    """Refuse ropes over sheaves where a second derivation tells references.

    Raises
    ------
    InputError
        If there are any.
    """
    if has_rope_sheaves(mechanism):
        expected = "a mechanism that is derived a second time, for references"
        got = "one whose ropes may leave sheaves, or whose points slide along beams"
        raise InputError(where, expected, got, "symgen run --verify estimates errors")

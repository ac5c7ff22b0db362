"""Joints whose rows are in force for a while: what a run has of them.

A joint that holds for a while has states of the file's own: ``NAME.changed``, which is 1 after an odd number of
changes, ``NAME.dissipated``, the energy that its catches have taken [J], and for a joint that holds present positions
``NAME.LABEL.at``, where each row holds. Its events change them: ``NAME.releases`` takes the rows out of force and lets
velocities go on; ``NAME.holds`` brings them into force by the smallest impulse that gives their rates those of the
joint. All else that runs have for states and events they have for these: targets, sweeps and derivatives.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, Literal

import msgspec

from symgen.base.errors import InputError
from symgen.base.vocabulary.expressions import (
    ONE,
    ZERO,
    Call,
    Expr,
    Name,
    Reading,
    call,
    names_in_expression,
)
from symgen.base.vocabulary.measures import GROUND, Angle, Holonomic
from symgen.describe.coordinate_names import is_speed
from symgen.describe.formulas.evaluate import evaluate_formula
from symgen.describe.formulas.formula_numbers import Symbols, formula_of
from symgen.describe.formulas.start import described_start
from symgen.describe.mechanism import Hold, Holding, Joint, Mechanism, ModeEvent, Output, StateVariable
from symgen.describe.parts.driven_mechanism import replace_names
from symgen.describe.parts.event_sections import RESET
from symgen.describe.parts.held_places import at_place_of_states, measure_beyond_value, name_of_place, places_of
from symgen.describe.parts.holding_keys import HOLDS, ReadHolding
from symgen.describe.parts.passing_ropes import has_rope_sheaves, without_rope_sheaves

#: Last words of the names of events, states and the mode.
CATCHES, RELEASES, CHANGED, DISSIPATED, MODE = "holds", "releases", "changed", "dissipated", "mode"


def _value_at_start(mechanism: Mechanism, read: ReadHolding) -> Expr:
    """Return the formula that is 1 where the rows are in force at the start, 0 where they are not.

    Raises
    ------
    InputError
        If no formula of parameters says whether they are.
    """
    if isinstance(read.first, bool):
        return ONE if read.first else ZERO
    q, v = described_start(mechanism, Symbols())
    names = [f"{body.name}.{name}" for body in mechanism.bodies for name in body.coordinates]
    speeds = [f"{body.name}.{name}" for body in mechanism.bodies for name in body.speeds]
    known: dict[str, Expr] = {"t": ZERO, **{p.name: Name(p.name) for p in mechanism.parameters if not p.input}}
    known |= {name: formula_of(x) for name, x in zip(names, q, strict=True)}
    known |= {name: formula_of(x) for name, x in zip(speeds, v, strict=True) if x is not None}

    def unknown(name: str) -> InputError:
        hint = "holds = { during = ..., at_start = true }"
        return InputError(read.where, "the key at_start beside a condition that is no formula of t and of bodies' "
                          "described coordinates and velocities", f"'{name}'", hint)  # fmt: skip

    def angle_of(body: str) -> Expr:
        return ZERO if body == GROUND else known[f"{body}.theta"]

    def at_start(e: Expr) -> Expr:
        if isinstance(e, Reading):
            source = e.source
            if isinstance(source, Angle) and e.order == 0:
                return call("sub", angle_of(source.b), angle_of(source.a))
            raise unknown(e.name)
        if isinstance(e, Call):
            return Call(e.function, tuple(map(at_start, e.arguments)))
        return e

    def put(name: Name) -> Expr:
        if name.name not in known:
            raise unknown(name.name)
        return known[name.name]

    return call("where", call("gt", replace_names(at_start(read.first), put), ZERO), ONE, ZERO)


def _described_of(mechanism: Mechanism, first: Expr | bool) -> Literal["", "positions", "velocities"]:
    """Return what a condition at the start reads of the described motion."""
    if isinstance(first, bool):
        return ""
    moving = set(names_in_expression(first)).difference(("t",), (p.name for p in mechanism.parameters))
    return "velocities" if any(map(_is_rate, moving)) else "positions" if moving else ""


def _is_rate(name: str) -> bool:
    """Whether a name means a velocity or a rate."""
    return name.endswith(".rate") or is_speed(name)


def refuse_other_start(mechanism: Mechanism, holds: Sequence[Hold]) -> None:
    """Refuse a start that is not the described one where that decides which rows are in force.

    Parameters
    ----------
    mechanism : Mechanism
        The mechanism.
    holds : sequence of Hold
        What the start holds; a state of a joint that says whether it holds decides instead.

    Raises
    ------
    InputError
        With the joint.
    """
    if not mechanism.holding:  # asked for each row of a sweep
        return
    names = {hold.name for hold in holds if hold.value is not None}
    others = sorted(names.difference(state.name for state in mechanism.states))
    for each in mechanism.holding:
        moved = others if each.described == "velocities" else [name for name in others if not _is_rate(name)]
        if each.described and moved and f"{each.joint}.{CHANGED}" not in names:
            expected = "the key at_start, as the start is not that of the bodies' tables"
            hint = "holds = { during = ..., at_start = true }"
            raise InputError(f"{mechanism.name}: joints.{each.joint}.{HOLDS}", expected, f"start of {moved[0]}", hint)


def mode_of(holding: Holding) -> Expr:
    """Return the formula that is 1 where the rows of a joint are in force, else 0."""
    return call("abs", call("sub", holding.first, Name(f"{holding.joint}.{CHANGED}")))


def with_holding(mechanism: Mechanism, read: Sequence[ReadHolding]) -> Mechanism:
    """Return a mechanism with the states, events and outputs of joints that hold for a while.

    Raises
    ------
    InputError
        If the start says of no joint whether it holds, or a name is taken.
    """
    if not read:
        return mechanism
    states, events, outputs, holding = list[StateVariable](), list[ModeEvent](), list[Output](), list[Holding]()
    for each in read:
        first, described = _value_at_start(mechanism, each), _described_of(mechanism, each.first)
        own = Holding(each.joint, first, each.catches, each.releases, each.present, described)
        joint, holding = mechanism.joint_named(each.joint), [*holding, own]
        states += [
            StateVariable(f"{own.joint}.{CHANGED}", ZERO, ZERO),
            StateVariable(f"{own.joint}.{DISSIPATED}", ZERO, ZERO, "J"),
        ]
        places = [row for row in joint.rows if own.present and isinstance(row, Holonomic)]
        states += [StateVariable(name_of_place(own.joint, row.label), ZERO, ZERO, row.unit) for row in places]
        events += _events_of(own, joint)
        outputs.append(Output(f"{own.joint}.{MODE}", mode_of(own)))
    names = tuple(x.joint for x in holding)
    return msgspec.structs.replace(
        mechanism,
        states=(*mechanism.states, *states),
        events=(*mechanism.events, *events),
        outputs=(*mechanism.outputs, *outputs),
        switchable=names,
        cuts=tuple(dict.fromkeys((*mechanism.cuts, *names))),
        holding=tuple(holding),
    )


def has_modes_of_joints(mechanism: Mechanism) -> bool:
    """Whether joints hold for a while, or ropes may leave sheaves."""
    return bool(mechanism.holding) or has_rope_sheaves(mechanism)


def in_modes(mechanism: Mechanism, values: Mapping[str, float], states: Mapping[str, float] | None = None) -> Mechanism:
    """Return a mechanism whose joints hold for good, or not at all, and whose ropes stay where they are in one state.

    Parameters
    ----------
    mechanism : Mechanism
        The description.
    values : mapping of str to float
        Values of all parameters.
    states : mapping of str to float, optional
        States of the file's own by name; those of the start by default.
    """
    mechanism = without_rope_sheaves(mechanism, values, states)
    if not mechanism.holding:
        return mechanism
    where, joints, own = mechanism.name, list[Joint](), set[str]()
    off = {
        x.joint
        for x in mechanism.holding
        if evaluate_formula(mode_of(x), {**_at_start(x), **values, **(states or {})}, where) < 0.5
    }
    for x in mechanism.holding:
        own |= {f"{x.joint}.{CHANGED}", f"{x.joint}.{DISSIPATED}", f"{x.joint}.{MODE}", *places_of(mechanism, x)}
        own |= {f"{x.joint}.{CATCHES}", f"{x.joint}.{RELEASES}"}
    for joint in mechanism.joints:
        joints.append(
            msgspec.structs.replace(joint, kind="place", rows=())
            if joint.name in off
            else at_place_of_states(joint, states)
        )
    changed: dict[str, Any] = {
        part: tuple(x for x in getattr(mechanism, part) if x.name not in own)
        for part in ("states", "events", "outputs")
    }
    return msgspec.structs.replace(mechanism, **changed, joints=tuple(joints), switchable=(), holding=())


def _at_start(holding: Holding) -> dict[str, float]:
    return {f"{holding.joint}.{CHANGED}": 0.0}


def refuse_holding(where: str, mechanism: Mechanism) -> None:
    """Refuse joints that hold for a while where motions are taken in one mode.

    Raises
    ------
    InputError
        If there are any.
    """
    if names := ", ".join(x.joint for x in mechanism.holding):
        raise InputError(where, "joints that hold for good", f"'holds' of {names}", "runs and sweeps have it")


def _events_of(holding: Holding, joint: Joint) -> list[ModeEvent]:
    """Return the events of a joint: that at which it catches comes before that at which it releases.

    Where the joint cannot do what an event is for, its switching function is 1: it sleeps, and a condition that is true
    as it awakes has not become true.
    """
    mode, changed, events = mode_of(holding), Name(f"{joint.name}.{CHANGED}"), list[ModeEvent]()
    other, flip = call("sub", ONE, mode), (changed, call("sub", ONE, changed))
    if holding.catches is not None:
        reset, places = list[tuple[Expr, Expr]](), list[tuple[Expr, Expr]]()
        for row in joint.rows:
            assert isinstance(row, Holonomic), "rows of joints that hold for a while are of positions"
            measure, name = measure_beyond_value(row, joint.name), f"{joint.name}.{row.label}"
            reset.append((Reading(f"{name}.rate", measure, 1), ZERO))
            if holding.present:
                value = call("sub", Reading(name, row.measure), row.value)
                places.append((Name(name_of_place(joint.name, row.label)), value))
        when = call("add", call("mul", other, holding.catches), mode)
        events.append(_event(joint, CATCHES, when, (*reset, flip, *places)))
    if holding.releases is not None:
        when = call("add", call("mul", mode, holding.releases), other)
        events.append(_event(joint, RELEASES, when, (flip,)))
    return events


def _event(joint: Joint, word: str, when: Expr, reset: tuple[tuple[Expr, Expr], ...]) -> ModeEvent:
    return ModeEvent(f"{joint.name}.{word}", when, "rising", RESET, reset, f"{joint.name} {word}", word)


def formulas_of_holding(read: Sequence[ReadHolding]) -> list[Expr]:
    """Return the conditions of joints."""
    return [e for x in read for e in (x.catches, x.releases) if e is not None]

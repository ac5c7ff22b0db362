"""Events of a mechanism or a run: conditions as switching functions, and the actions they trigger."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any, Literal

import msgspec

from symgen.base.errors import InputError, quote
from symgen.base.vocabulary.expressions import Call, Expr, Name, Number, call, names_in_expression
from symgen.describe.formulas.formula_text import to_text
from symgen.describe.formulas.identifiers import check_identifier
from symgen.describe.mechanism import Event, Mechanism
from symgen.describe.parts.context import Context
from symgen.describe.parts.driven_mechanism import put_formulas
from symgen.describe.parts.fields import Condition, NewValues, read_table, value_in_words
from symgen.describe.parts.scope import Scope

RISING, FALLING, ANY = "rising", "falling", "any"
RECORD, STOP, RESET = "record", "stop", "reset"
#: Effects on a motion of actions other than recording, in words.
DOES = {STOP: "ends runs", RESET: "changes the state"}
_LOGIC = frozenset(("lt", "le", "gt", "ge", "and", "or", "not"))


class EventSection(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """A condition that is watched during a run, and what is done when it becomes true.

    Parameters
    ----------
    when : str
        A condition such as ``"ball.y < 0.1"``, which may be put together by ``and``, ``or`` and ``not``: the event
        happens when it becomes true. Or an expression: it happens where this passes through zero.
    direction : str
        ``"rising"``, ``"falling"`` or ``"any"``: through zero upwards, downwards, or both, which is so for an
        expression by default. A condition rises when it becomes true, which is meant by default.
    action : str
        ``"record"``: time and state are noted; ``"stop"``: the run ends there; ``"reset"``: velocities, or states of
        the file's own, change. Recorded by default.
    reset : table
        New velocities and states as expressions of the state before, such as ``{ "ball.vy" = "-0.7*ball.vy" }`` or
        ``{ charge = "0.5*charge" }``. All other velocities change as an impulse in these and in the joints makes them.
    """

    when: Condition
    direction: Literal["rising", "falling", "any"] | None = None
    action: Literal["record", "stop", "reset"] | None = None
    reset: NewValues | None = None


def read_event(scope: Scope, name: str, raw: object) -> Event:
    """Return the event that a table describes.

    Parameters
    ----------
    scope : Scope
        The table's place.
    name : str
        Name of the event.
    raw : object
        The table.

    Raises
    ------
    InputError
        With the key that is wrong.
    """
    section = read_table(EventSection, raw, scope.where(""))
    if section.action == RESET and section.reset is None:
        raise scope.error("reset", 'new velocities or states, such as { "ball.vy" = "-0.7*ball.vy" }', "no such key")
    if section.reset is not None and section.action not in (None, RESET):
        raise scope.error("action", "'reset', as new values are given", f"'{section.action}'")
    action = section.action or (RECORD if section.reset is None else RESET)
    reset = tuple(_read_reset(scope, key, value) for key, value in (section.reset or {}).items())
    if action == RESET and not reset:
        raise scope.error("reset", "at least one new value", "an empty table")
    when, condition = switching_function(scope, "when", section.when)
    direction = section.direction or (RISING if condition else ANY)
    return Event(name, when, direction, action, reset, " ".join(section.when.split()))


def watched_event(mechanism: Mechanism, settings: str, when: str, action: str) -> Event:
    """Return an event requested in addition to the mechanism's own, named after its condition.

    Parameters
    ----------
    mechanism : Mechanism
        The mechanism.
    settings : str
        The setting with the condition, for messages.
    when : str
        The condition.
    action : {"record", "stop"}
        Action of the event.
    """
    switching, condition = switching_function(Scope(Context.of_mechanism(mechanism), settings), "", when)
    text = " ".join(when.split())
    return put_formulas(
        Event(text, switching, RISING if condition else ANY, action, (), text), dict(mechanism.input_formulas)
    )


def read_events(mechanism: Mechanism, tables: Mapping[str, Any]) -> tuple[Event, ...]:
    """Return events from Python tables by name, with the keys of a file."""
    result = []
    for name, table in tables.items():
        check_identifier(name, f"{mechanism.name}: events", "event")
        if any(name == event.name for event in mechanism.events):
            where = f"{mechanism.name}: events.{name}"
            raise InputError(where, "a name that no event of the mechanism has", f"'{name}' again")
        event = read_event(Scope(Context.of_mechanism(mechanism), f"events.{name}", name), name, table)
        result.append(put_formulas(event, dict(mechanism.input_formulas)))
    return tuple(result)


def events_in_words(events: Iterable[Event]) -> str:
    """Return events in words, which differ where the events differ."""
    return "; ".join(
        f"{e.name} ({', '.join([e.action, *(f'{to_text(v)} = {to_text(x)}' for v, x in e.reset)])}) "
        f"where {to_text(e.when)} passes 0, {e.direction}"
        for e in events
    )


def switching_function(scope: Scope, key: str, text: str, results: bool = False) -> tuple[Expr, bool]:
    """Return a function above 0 where the condition holds, and whether the text is a condition.

    With `results` it may read accelerations and forces.
    """
    if results:
        expression = scope.of_motion(key, text, integrals=False, conditions=True)
    else:
        expression = scope.of_state(key, text, conditions=True)
    changing = ("t", *scope.context.inputs, *scope.context.state_names)
    if not any(name in changing or "." in name for name in names_in_expression(expression)):
        raise scope.error(key, "a condition that time or motion changes", quote(text))
    condition = isinstance(expression, Call) and expression.function in _LOGIC
    return (_positive_where_true(expression), True) if condition else (expression, False)


def _positive_where_true(condition: Expr) -> Expr:
    """Return an expression above 0 where a condition holds: b - a for ``a < b``, and for ``and`` the smaller one."""
    if not isinstance(condition, Call):
        raise AssertionError("a condition in a tree is never a literal")
    a = condition.arguments
    if condition.function in ("lt", "le"):
        return _simplified_difference(a[1], a[0])
    if condition.function in ("gt", "ge"):
        return _simplified_difference(a[0], a[1])
    if condition.function == "not":
        return call("neg", _positive_where_true(a[0]))
    return call("both" if condition.function == "and" else "either", *(_positive_where_true(e) for e in a))


def _simplified_difference(a: Expr, b: Expr) -> Expr:
    zero = Number(0.0)
    return a if b == zero else call("neg", b) if a == zero else call("sub", a, b)


def _read_reset(scope: Scope, key: str, value: float | str) -> tuple[Expr, Expr]:
    """Return a named velocity, or state of the file's own, and its new value."""
    where = f"reset.{quote(key)[1:-1]}"
    quantity = scope.of_state(where, key)
    word = quantity.name if isinstance(quantity, Name) else ""
    body, _, speed = word.rpartition(".")
    is_velocity = body in scope.context.bodies and speed in scope.context.bodies[body].speeds
    if not is_velocity and word not in scope.context.state_names:
        raise scope.error(where, "the name of a velocity, such as ball.vy, or of a state", value_in_words(key))
    return quantity, scope.of_state(where, value)

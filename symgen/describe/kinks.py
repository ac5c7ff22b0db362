"""Where formulas of joints and forces have kinks: at times known beforehand, or where the state passes points."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from typing import Any

import msgspec

from symgen.describe.inputs import MOST_KNOTS, Jump, compared, replaced
from symgen.describe.mechanism import Event, Mechanism
from symgen.describe.outputs import integrated
from symgen.describe.tables import Table
from symgen.vocabulary.expressions import BENT, Call, Expr, Reading, names, readings, table_of
from symgen.vocabulary.measures import Effort

#: What is written where a formula has a kink, and what where it may jump.
_WORDS = (*(name.encode() for name in BENT), b"table:")
_SIDES = ("lt", "le", "gt", "ge", "sign")
#: What compares something with zero, or two values with each other, and what is written there.
_COMPARED = (*_SIDES, *BENT)
_CHANGING = [name.encode() for name in _COMPARED]
_PASSING = [*_CHANGING, b"table:"]


def kinks_of(mechanism: Mechanism, events: Sequence[Event] = ()) -> tuple[Jump, ...]:
    """Return where formulas of joints, forces, integrals and events have kinks in time, as jumps without a switch.

    `abs`, `min` and `max` have them where two values are equal, and tables at their points, whatever their pieces are:
    of a cubic one the third derivative jumps. Arguments are formulas of t and parameters; those of state pass such
    points at times that nobody knows before.
    """
    tables = {table.name: table for table in mechanism.tables}

    def kink(e: Call) -> Jump | None:
        if e.function in BENT:
            return Jump(compared(e))
        if (table := tables.get(table_of(e.function) or "")) is not None and len(table.x) <= MOST_KNOTS:
            return Jump(e.arguments[0], table.x, period=table.x[-1] - table.x[0] if table.periodic else 0.0)
        return None

    return _in_time(mechanism, events, _WORDS, kink)


def sides_of(mechanism: Mechanism, events: Sequence[Event] = ()) -> tuple[Jump, ...]:
    """Return what these formulas compare in time: where it is passed they may jump, without a switch."""

    def side(e: Call) -> Jump | None:
        return Jump(compared(e)) if e.function in _SIDES else None

    return _in_time(mechanism, events, [name.encode() for name in _SIDES], side)


def _in_time(
    mechanism: Mechanism, events: Sequence[Event], words: Iterable[bytes], jump_of: Callable[[Call], Jump | None]
) -> tuple[Jump, ...]:
    """Return the jumps of what a run integrates or watches whose arguments are formulas of t and parameters, each once.

    Words are what is written where there is one: most mechanisms have none, and walking through large ones takes a
    while.
    """
    formulas = *integrated(mechanism), tuple(e.when for e in events)
    text = msgspec.msgpack.encode(formulas)
    if not any(word in text for word in words):
        return ()
    timely = {p.name for p in mechanism.parameters if not p.input} | {"t"}
    found = dict[Jump, None]()
    for e, _ in _calls(*formulas):
        jump = jump_of(e)
        if jump is not None and "t" in (used := set(names(jump.argument))) and used <= timely:
            found[jump] = None
    return tuple(found)


@dataclass(frozen=True)
class Discontinuity:
    """Where formulas of joints, forces and integrals jump or have kinks as the state passes something.

    Attributes
    ----------
    argument : Expr
        A formula of a run.
    table : Table or None
        The table whose points it passes; None where it is compared with zero.
    jumps : bool
        Whether a formula may jump there, and not only have a kink.
    """

    argument: Expr
    table: Table | None = None
    jumps: bool = False


def discontinuities_of(mechanism: Mechanism) -> tuple[Discontinuity, ...]:
    """Return where formulas jump or have kinks as the state passes something, each argument once a table.

    Comparisons and `sign` jump; `abs`, `min`, `max` and tables at their points have kinks. An integrand acts on
    nothing, so that a dip of it between two evaluations is seen by no other error. What forces call ``s`` and ``rate``
    is read of their measures.
    """
    tables = {table.name: table for table in mechanism.tables if len(table.x) <= MOST_KNOTS}

    def passing(e: Call) -> Expr | None:
        if e.function in _COMPARED:
            return compared(e)
        return e.arguments[0] if (table_of(e.function) or "") in tables else None

    found = dict[tuple[Expr, Table | None], bool]()
    for e, argument in _over_state(mechanism, _PASSING, passing):
        key = argument, tables.get(table_of(e.function) or "")
        found[key] = found.get(key, False) or e.function in _SIDES
    return tuple(Discontinuity(*key, jumps) for key, jumps in found.items())


def compares_state(mechanism: Mechanism) -> bool:
    """Return whether formulas of joints, forces or integrals compare something that depends on the state."""
    return any(_over_state(mechanism, _CHANGING, _compared))


def jumps_over_state(mechanism: Mechanism) -> bool:
    """Return whether such formulas may jump where the state passes something, and not only have kinks there."""
    return any(e.function in _SIDES for e, _ in _over_state(mechanism, _CHANGING, _compared))


def changes_of(formula: Expr) -> tuple[Jump, ...]:
    """Return what a formula of the time compares with zero and what depends on t, each once, without a switch."""
    text = msgspec.msgpack.encode(formula)
    if not any(word in text for word in _CHANGING):
        return ()
    found = (e for e, _ in _calls(formula) if e.function in _COMPARED and "t" in set(names(e)))
    return tuple(dict.fromkeys(Jump(compared(e)) for e in found))


def changing(part: Any) -> Iterator[Expr]:
    """Yield whole formulas in a part of a mechanism that compare something or read a table, as formulas of a run."""
    waiting: list[tuple[Any, Effort | None]] = [(part, None)]
    while waiting:
        value, effort = waiting.pop()
        if isinstance(value, Call):
            if any(e.function in _COMPARED or table_of(e.function) for e, _ in _calls(value)):
                yield value if effort is None else _of_a_run(value, effort)
        else:
            waiting += _inside(value, effort)


def _compared(e: Call) -> Expr | None:
    return compared(e) if e.function in _COMPARED else None


def _over_state(
    mechanism: Mechanism, words: Iterable[bytes], argument_of: Callable[[Call], Expr | None]
) -> Iterator[tuple[Call, Expr]]:
    """Yield functions of joints, forces and integrals with what they take, where that depends on the state."""
    formulas = integrated(mechanism)
    text = msgspec.msgpack.encode(formulas)
    if not any(word in text for word in words):
        return
    plain = {p.name for p in mechanism.parameters} | {"t"}
    for e, effort in _calls(*formulas):
        taken = argument_of(e)
        if taken is None:
            continue
        argument = taken if effort is None else _of_a_run(taken, effort)
        if _is_of_state(argument, plain):
            yield e, argument


def _is_of_state(argument: Expr, plain: set[str]) -> bool:
    """Return whether a formula reads more than the time and parameters."""
    return any(readings(argument)) or not set(names(argument)) <= plain


def _of_a_run(e: Expr, effort: Effort) -> Expr:
    """Return a formula of an effort with what it calls its measure and that one's rate as readings."""
    own = {name: Reading(name, effort.measure, order) for order, name in enumerate(("s", "rate"))}
    return replaced(e, lambda name: own.get(name.name, name))


def _calls(*parts: Any) -> Iterator[tuple[Call, Effort | None]]:
    """Yield every function that is called in the formulas of parts of a mechanism, and in which effort it is."""
    waiting: list[tuple[Any, Effort | None]] = [(part, None) for part in parts]
    while waiting:  # in a loop: large mechanisms have tens of thousands of nodes
        value, effort = waiting.pop()
        if isinstance(value, Call):
            yield value, effort
            waiting += [(argument, effort) for argument in value.arguments]
        else:
            waiting += _inside(value, effort)


def _inside(value: Any, effort: Effort | None) -> list[tuple[Any, Effort | None]]:
    """Return what stands in a part of a mechanism, and in which effort."""
    if isinstance(value, tuple):
        return [(item, effort) for item in value]
    if isinstance(value, msgspec.Struct):
        own = value if isinstance(value, Effort) else effort
        return [(getattr(value, field), own) for field in value.__struct_fields__]
    return []

"""Where formulas of joints and forces have kinks: at times known beforehand, or where the state passes points."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any

import msgspec

from symgen.describe.inputs import MOST_KNOTS, Jump, compared, replaced
from symgen.describe.mechanism import Event, Mechanism
from symgen.describe.outputs import integrated
from symgen.describe.tables import Table
from symgen.vocabulary.expressions import BENT, Call, Expr, Reading, names, readings, table_of
from symgen.vocabulary.measures import Effort

#: What may jump, and what compares something with zero, or two values with each other.
_SIDES = ("lt", "le", "gt", "ge", "sign")
_COMPARED = (*_SIDES, *BENT)


def known_in_time(mechanism: Mechanism, events: Sequence[Event] = ()) -> tuple[tuple[Jump, ...], tuple[Jump, ...]]:
    """Return where formulas of joints, forces, integrals and events have kinks in time, and what they compare there.

    Jumps have no switch. `abs`, `min` and `max` have kinks where two values are equal, and tables at their points,
    whatever their pieces are: of a cubic one the third derivative jumps. Where comparisons and `sign` are passed,
    formulas may jump. Arguments are formulas of t and parameters; those of state pass at times unknown before.
    """
    formulas = *integrated(mechanism), tuple(e.when for e in events)
    tables = {table.name: table for table in mechanism.tables if len(table.x) <= MOST_KNOTS}
    timely = {p.name for p in mechanism.parameters if not p.input} | {"t"}
    kinks, sides = dict[Jump, None](), dict[Jump, None]()
    for e, _ in _calls(*formulas) if _may_pass(formulas) else ():
        if e.function in _COMPARED:
            jump = Jump(compared(e))
        elif (table := tables.get(table_of(e.function) or "")) is not None:
            jump = Jump(e.arguments[0], table.x, period=table.x[-1] - table.x[0] if table.periodic else 0.0)
        else:
            continue
        if "t" in (used := set(names(jump.argument))) and used <= timely:
            (sides if e.function in _SIDES else kinks)[jump] = None
    return tuple(kinks), tuple(sides)


def _may_pass(part: Any) -> bool:
    """Return whether comparisons or tables are written in a part of a mechanism: most have none, and a walk is long."""
    text = msgspec.msgpack.encode(part)
    return any(name.encode() in text for name in (*_COMPARED, "table:"))


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
    formulas = integrated(mechanism)
    tables = {table.name: table for table in mechanism.tables if len(table.x) <= MOST_KNOTS}
    plain = {p.name for p in mechanism.parameters} | {"t"}
    found = dict[tuple[Expr, Table | None], bool]()
    for e, effort in _calls(*formulas) if _may_pass(formulas) else ():
        table = tables.get(table_of(e.function) or "")
        if e.function not in _COMPARED and table is None:
            continue
        argument = compared(e) if table is None else e.arguments[0]
        argument = argument if effort is None else _of_a_run(argument, effort)
        if any(readings(argument)) or not set(names(argument)) <= plain:
            found[argument, table] = found.get((argument, table), False) or e.function in _SIDES
    return tuple(Discontinuity(*key, jumps) for key, jumps in found.items())


def compares_state(mechanism: Mechanism) -> bool:
    """Return whether formulas of joints, forces or integrals compare something that depends on the state."""
    return any(x.table is None for x in discontinuities_of(mechanism))


def changes_of(formula: Expr) -> tuple[Jump, ...]:
    """Return what a formula of the time compares with zero and what depends on t, each once, without a switch."""
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

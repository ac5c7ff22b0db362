"""Formulas of the time in which something short may lie, at a time that nothing tells before a run.

A polynomial of t and one sine are seen by error estimates. Comparisons, kinks and points of tables are met at times
that are worked out beforehand. Anything else, such as a bell ``exp(-((t - 3)/w)**2)``, may rest for long.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from typing import Any

import msgspec

from symgen.describe.inputs import MOST_KNOTS, Jump
from symgen.describe.mechanism import Event, Mechanism
from symgen.describe.outputs import integrated
from symgen.describe.remembered import remembered
from symgen.vocabulary.expressions import BENT, Call, Expr, Name, Number, names, table_of

#: Steps for which something may lie hidden are no longer than a run over this.
PARTS = 1000
#: How formulas of the time are written where they are kept.
_TIME = msgspec.msgpack.encode(Name("t"))
#: Powers beyond this one are as sharp as pulses.
_LOW = 16
#: Functions that are polynomials where their arguments are, but for jumps and kinks.
_PLAIN = frozenset(("add", "sub", "neg", "mul", "where", "and", "or", "not", *BENT))
_SIDES = frozenset(("lt", "le", "gt", "ge", "sign"))


def longest_step(
    mechanism: Mechanism, length: float, events: Sequence[Event] = (), jumps: Sequence[Jump] = ()
) -> tuple[float, str]:
    """Return the longest step that sees what formulas of the time do [s], and why it is that by default.

    Parameters
    ----------
    mechanism : Mechanism
        Whose own largest step counts before all else.
    length : float
        Of the run [s].
    events, jumps : sequence of Event, sequence of Jump
        Conditions of the run, and of its inputs.

    Returns
    -------
    float
        Infinity where any step does.
    str
        A sentence; empty where there is nothing to say.
    """
    if mechanism.defaults.max_step is not None:
        return mechanism.defaults.max_step, ""
    further = {"inputs": tuple(jump.argument for jump in jumps), "events": tuple(event.when for event in events)}
    groups = *_groups(mechanism), *(group for group, part in further.items() if _may_hide(part, mechanism))
    if not groups:
        return math.inf, ""
    longest = length / PARTS
    return longest, (
        f"formulas of t in {' and '.join(groups)} may pass something short: adaptive steps are at most {longest:.3g} s,"
        f" a thousandth of the run; what is shorter needs --max-step"
    )


@remembered
def _groups(mechanism: Mechanism) -> tuple[str, ...]:
    """Return which formulas that a run integrates may hide something short."""
    parts = zip(("drivers", "forces", "integrals"), integrated(mechanism), strict=True)
    return tuple(group for group, part in parts if _may_hide(part, mechanism))


def _may_hide(part: Any, mechanism: Mechanism) -> bool:
    """Return whether a part of a mechanism has a formula of t and parameters that may hide something short."""
    if _TIME not in msgspec.msgpack.encode(part):
        return False
    timely = {p.name for p in mechanism.parameters if not p.input} | {"t"}
    tables = frozenset(table.name for table in mechanism.tables if len(table.x) <= MOST_KNOTS)
    return any(_form(e, tables) is None for e in _in_time(part, timely))


def _in_time(part: Any, timely: set[str]) -> Iterator[Call]:
    """Yield the largest formulas of t and parameters in a part of a mechanism."""
    waiting = [part]
    while waiting:  # in a loop: large mechanisms have tens of thousands of nodes
        value = waiting.pop()
        if isinstance(value, Call):
            used = set(names(value))
            if used <= timely:
                if "t" in used:
                    yield value
            else:
                waiting += value.arguments
        elif isinstance(value, tuple):
            waiting += value
        elif isinstance(value, msgspec.Struct):
            waiting += [getattr(value, field) for field in value.__struct_fields__]


def _form(e: Expr, tables: frozenset[str]) -> tuple[float, frozenset[Expr]] | None:
    """Return the power of a polynomial of t and one sine, and what that sine is of; None for any other formula."""
    if not isinstance(e, Call):
        return float(isinstance(e, Name) and e.name == "t"), frozenset()
    forms = [form for a in e.arguments if (form := _form(a, tables)) is not None]
    if len(forms) < len(e.arguments):
        return None
    powers = [power for power, _ in forms]
    function, power, waves = e.function, max(powers), frozenset[Expr]().union(*(waves for _, waves in forms))
    if power == 0.0 or function in _SIDES:  # constant, between known times at least
        return 0.0, frozenset()
    if function in ("sin", "cos"):
        return (1.0, frozenset(e.arguments)) if power == 1.0 and not waves else None
    if function == "mul":
        power = sum(powers)
    elif function == "pow" and isinstance(n := e.arguments[1], Number) and n.value in range(_LOW + 1):
        power *= n.value
    elif table_of(function) in tables:
        power *= 3.0
    elif function not in _PLAIN and not (function == "div" and powers[1] == 0.0):
        return None
    return (power, waves) if power <= _LOW and len(waves) <= 1 else None

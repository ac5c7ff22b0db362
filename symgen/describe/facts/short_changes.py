"""Formulas of the time that may hide short changes: no time says where these lie, so that adaptive steps are bounded.

Hidden are changes of formulas that are no polynomials with one sine.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

import msgspec

from symgen.base.vocabulary.expressions import (
    BENT,
    JUMPING,
    Call,
    Expr,
    Name,
    Number,
    names_in_expression,
    table_of,
)
from symgen.describe.facts.kinks import (
    ENCODED_TIME,
    bound_formulas,
    calls_with_efforts,
    names_of_time,
    tables_with_halts,
)
from symgen.describe.formulas.results_read import integrands_of_run
from symgen.describe.mechanism import Event, Mechanism
from symgen.describe.parts.driven_mechanism import Jump
from symgen.describe.remembered import compute_once

#: Steps for which something may lie hidden are no longer than a run over this.
PARTS = 1000
#: Powers beyond this one are as sharp as pulses.
_LOW = 16
#: Functions that are polynomials where their arguments are, except at jumps and kinks.
_PLAIN = frozenset(("add", "sub", "neg", "mul", "where", "and", "or", "not", *BENT))


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
        Infinity where no bound is needed.
    str
        A sentence, or empty.
    """
    if mechanism.defaults.max_step is not None:
        return mechanism.defaults.max_step, ""
    further = {"inputs": tuple(jump.argument for jump in jumps), "events": tuple(event.when for event in events)}
    groups = (
        *_groups_of_integrands(mechanism),
        *(group for group, part in further.items() if _may_hide_changes(part, mechanism)),
    )
    if not groups:
        return math.inf, ""
    longest = length / PARTS
    return longest, (
        f"formulas of t in {' and '.join(groups)} may have short features: adaptive steps are at most {longest:.3g} s,"
        f" a thousandth of the run; what is shorter needs a smaller `max_step`"
    )


@compute_once
def _groups_of_integrands(mechanism: Mechanism) -> tuple[str, ...]:
    """Return the groups of integrated formulas that may hide short changes."""
    formulas = *integrands_of_run(mechanism), bound_formulas(mechanism)
    parts = zip(("drivers", "forces", "integrals", "bounds"), formulas, strict=True)
    return tuple(group for group, part in parts if _may_hide_changes(part, mechanism))


def _may_hide_changes(part: object, mechanism: Mechanism) -> bool:
    """Return whether a part of a mechanism has a formula of t and parameters that may hide short changes."""
    if ENCODED_TIME not in msgspec.msgpack.encode(part):
        return False
    timely, tables = names_of_time(mechanism), frozenset(tables_with_halts(mechanism))
    largest = calls_with_efforts(part, enters=lambda e: not set(names_in_expression(e)) <= timely)
    return any(
        "t" in (used := set(names_in_expression(e))) and used <= timely and _power_and_sine(e, tables) is None
        for e, _ in largest
    )


def _power_and_sine(e: Expr, tables: frozenset[str]) -> tuple[float, frozenset[Expr]] | None:
    """Return the power of a polynomial of t and one sine, and the sine's argument; None for any other formula."""
    if not isinstance(e, Call):
        return float(isinstance(e, Name) and e.name == "t"), frozenset()
    forms = [form for a in e.arguments if (form := _power_and_sine(a, tables)) is not None]
    if len(forms) < len(e.arguments):
        return None
    powers = [power for power, _ in forms]
    function, power, waves = e.function, max(powers), frozenset[Expr]().union(*(waves for _, waves in forms))
    if power == 0.0 or function in JUMPING:  # constant, between known times at least
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

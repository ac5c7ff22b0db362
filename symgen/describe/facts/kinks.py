"""Kinks in formulas of joints and forces, at times that are computed before a run, or where the state passes points."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from typing import Any

import msgspec

from symgen.base.vocabulary.elementary_functions import ELEMENTARY
from symgen.base.vocabulary.expressions import (
    BENT,
    JUMPING,
    ZERO,
    Call,
    Expr,
    Name,
    Number,
    Reading,
    call,
    difference,
    names_in_expression,
    readings_in,
    sum_of_terms,
    table_of,
)
from symgen.base.vocabulary.measures import Chain, Effort, FormulaMeasure, FormulaSpeed, Holonomic, OnChain
from symgen.describe.bounds.bounded_modes import one_sided_rows, two_sided_rows
from symgen.describe.formulas.results_read import integrands_of_run
from symgen.describe.mechanism import Event, Mechanism
from symgen.describe.parts.driven_mechanism import MOST_KNOTS, Jump, compared_with_zero, replace_names
from symgen.describe.remembered import compute_once
from symgen.describe.table_functions import Table

#: Functions that compare a value with zero, or two values with each other.
_COMPARED = (*JUMPING, *BENT)
#: Inverses of functions, and the function that is 0 where they have kinks or jump.
_INVERSE = {("acos", "cos"): "sin", ("asin", "sin"): "cos", ("atan", "tan"): "cos"}
#: How these are written where a formula is encoded: with their lengths, as other words contain `le` too.
_COMPARED_TEXTS = tuple(map(msgspec.msgpack.encode, (*_COMPARED, "on-chain")))
#: The derivative of a table that jumps at its points.
KINKS = {"linear": 1, "pchip": 2, "cubic": 3}
#: Encoded forms of formulas of the time.
ENCODED_TIME = msgspec.msgpack.encode(Name("t"))


def jumps_in_time(mechanism: Mechanism, events: Sequence[Event] = ()) -> tuple[tuple[Jump, ...], tuple[Jump, ...]]:
    """Return the kinks in time of formulas of joints, forces, integrals and events, and their comparisons.

    Jumps have no switch. `abs`, `min` and `max` have kinks where two values are equal, and tables at their points,
    whatever their pieces are: of a cubic one the third derivative jumps. Where comparisons and `sign` are passed,
    formulas may jump. Arguments are formulas of t and parameters; those of state pass at times unknown before.
    """
    return _kinks_in_formulas(
        mechanism, (*integrands_of_run(mechanism), bound_formulas(mechanism), tuple(e.when for e in events))
    )


def jumps_of_gaps(mechanism: Mechanism) -> tuple[Jump, ...]:
    """Return the jumps and kinks in time of the gaps of one-sided rows, whose rates jump there."""
    return sum(_kinks_in_formulas(mechanism, (one_sided_rows(mechanism),)), ())


def _kinks_in_formulas(mechanism: Mechanism, formulas: tuple[Any, ...]) -> tuple[tuple[Jump, ...], tuple[Jump, ...]]:
    """Return the kinks in time of formulas, and their comparisons."""
    tables, timely = tables_with_halts(mechanism), names_of_time(mechanism)
    kinks, sides = dict[Jump, None](), dict[Jump, None]()
    for e, _ in calls_with_efforts(*formulas) if _may_switch(formulas) else ():
        if e.function in _COMPARED:
            jump = Jump(compared_with_zero(e))
        elif (table := tables.get(table_of(e.function) or "")) is not None:
            period = table.x[-1] - table.x[0] if table.periodic else 0.0
            jump = Jump(e.arguments[0], table.x, period=period, derivative=KINKS.get(table.interpolation, 0))
        else:
            continue
        if "t" in (used := set(names_in_expression(jump.argument))) and used <= timely:
            (sides if e.function in JUMPING else kinks)[jump] = None
    return tuple(kinks), tuple(sides)


def bound_formulas(mechanism: Mechanism) -> tuple[Any, ...]:
    """Return the formulas of the bounds of rows with two: their efforts in motion, and their bounds at rest."""
    rows = two_sided_rows(mechanism)
    by_reaction = (Effort("bound", row.measure, row.coefficient) for row in rows if row.pressed)
    return (*((row.effort, row.numbers) for row in rows), *by_reaction)


def changes_in_time(mechanism: Mechanism) -> bool:
    """Return whether anything but the motion changes over time: a formula of t, or a state of the file's own."""
    return bool(mechanism.states) or ENCODED_TIME in msgspec.msgpack.encode(
        (integrands_of_run(mechanism), bound_formulas(mechanism))
    )


def tables_with_halts(mechanism: Mechanism) -> dict[str, Table]:
    """Return the tables at whose points runs halt; shape functions of curves have events there."""
    return {x.name: x for x in mechanism.tables if len(x.x) <= MOST_KNOTS and not x.slopes}


def names_of_time(mechanism: Mechanism) -> set[str]:
    """Return the names in formulas of time alone."""
    return {p.name for p in mechanism.parameters if not p.input} | {"t"}


def _may_switch(part: object) -> bool:
    """Return whether comparisons or tables are written in a part of a mechanism: most have none, and a walk is long."""
    text = msgspec.msgpack.encode(part)
    return b"table:" in text or any(name in text for name in _COMPARED_TEXTS)


@dataclass(frozen=True)
class Discontinuity:
    """A jump or kink of formulas of joints, forces and integrals at a value of the state.

    Attributes
    ----------
    argument : Expr
        A formula of a run.
    table : Table or None
        The table whose points it passes; None where it is compared with zero.
    jumps : bool
        Whether a formula may jump there, and not only have a kink.
    holds : bool
        Whether it is in the formula of a row.
    """

    argument: Expr
    table: Table | None = None
    jumps: bool = False
    holds: bool = False


@compute_once
def discontinuities_of(mechanism: Mechanism) -> tuple[Discontinuity, ...]:
    """Return jumps and kinks of formulas that depend on the state, each argument once for each table.

    Comparisons and `sign` jump; `abs`, `min`, `max` and tables at their points have kinks. An integrand acts on
    nothing, so that no other error shows a dip of it between two evaluations, nor of the gap of an open stop. ``s`` and
    ``rate`` of forces are readings of their measures.
    """
    formulas = *integrands_of_run(mechanism), bound_formulas(mechanism)
    gaps = tuple(row.place for row in one_sided_rows(mechanism))
    tables, plain = tables_with_halts(mechanism), {p.name for p in mechanism.parameters} | {"t"}
    own = {
        _effort_formula_of_run(Name("rate"), row.effort) for row in two_sided_rows(mechanism)
    }  # modes change where these are 0
    measures = tuple(row.measure for row in two_sided_rows(mechanism) if row.in_contact)
    pieces = {e for e, _ in calls_with_efforts(measures)} if _may_switch(measures) else set[Call]()
    jumping = dict[tuple[Expr, Table | None], bool]()
    found = list(calls_with_efforts(*formulas)) if _may_switch(formulas) else []
    acting = len(found)
    found += calls_with_efforts(gaps) if _may_switch(gaps) else ()
    for i, (e, effort) in enumerate(found):
        table = tables.get(table_of(e.function) or "")
        if e.function not in _COMPARED and table is None:
            continue
        argument = compared_with_zero(e) if table is None else e.arguments[0]
        argument = argument if effort is None else _effort_formula_of_run(argument, effort)
        if argument in own:
            continue
        if any(readings_in(argument)) or not set(names_in_expression(argument)) <= plain:
            jumps = i < acting and e.function in JUMPING and e not in pieces  # gap and slip of a contact do not jump
            jumping[argument, table] = jumping.get((argument, table), False) or jumps
    held = dict.fromkeys((e, None) for row in rows_with_kinks(mechanism) for e in row.switches)
    for key in held:
        jumping.setdefault(key, False)
    return tuple(Discontinuity(*key, jumps, key in held) for key, jumps in jumping.items())


def compares_state(mechanism: Mechanism) -> bool:
    """Return whether formulas of joints, forces or integrals compare something that depends on the state."""
    return any(x.table is None for x in discontinuities_of(mechanism))


def kink_expressions(formula: Expr) -> tuple[Expr, ...]:
    """Return expressions that are 0 wherever a formula jumps or has a kink, tables aside, each once."""
    return tuple(dict.fromkeys(x for e, _ in calls_with_efforts(formula) for x in _zero_at_kinks(e)))


def _zero_at_kinks(e: Call) -> tuple[Expr, ...]:
    """Return the expressions that are 0 where a call jumps or has a kink.

    Of `atan2` these are both arguments, as its cut lies where y is 0. An inverse of a function that is not monotonic
    has kinks: the root of a square is an absolute value.
    """
    if e.function in _COMPARED:
        return (compared_with_zero(e),)
    if e.function == "atan2":
        return e.arguments
    inner = e.arguments[0]
    if not isinstance(inner, Call):
        return ()
    if e.function == "sqrt" or (e.function == "pow" and not _is_whole_number(e.arguments[1])):
        squared = inner.function == "pow" and isinstance(n := inner.arguments[1], Number) and n.value % 2.0 == 0.0
        return inner.arguments[:1] if squared or (inner.function == "mul" and len({*inner.arguments}) == 1) else ()
    turning = _INVERSE.get((e.function, inner.function))
    return () if turning is None else (Call(turning, inner.arguments),)


def _is_whole_number(e: Expr) -> bool:
    return isinstance(e, Number) and e.value.is_integer()


@dataclass(frozen=True)
class ChangingRow:
    """A row of a joint that compares something, or reads `atan2`: it may jump or have kinks.

    Attributes
    ----------
    name, key : str
        ``JOINT.LABEL``, and the key of its formula in a file.
    unit : str
        Of the row.
    formula : Expr
        What is held at 0.
    motion : Expr
        The terms of the formula that depend on time alone.
    switches : tuple of Expr
        Expressions that are 0 where the other terms may jump or have a kink.
    is_speed : bool
        Whether the row holds a velocity, whose rate may jump.
    """

    name: str
    key: str
    unit: str
    formula: Expr
    motion: Expr
    switches: tuple[Expr, ...]
    is_speed: bool


@compute_once
def rows_with_kinks(mechanism: Mechanism) -> tuple[ChangingRow, ...]:
    """Return the rows of joints whose formulas may jump or have kinks."""
    result, timely = list[ChangingRow](), {p.name for p in mechanism.parameters} | {"t"}
    for joint in mechanism.joints:
        for i, row in enumerate(joint.rows):
            measure = row.measure if isinstance(row, Holonomic) else row.speed
            if not (kink_expressions(row.value) or any(True for _ in _switching_calls(measure))):
                continue
            own = isinstance(measure, FormulaMeasure | FormulaSpeed)
            held = measure.of if isinstance(measure, FormulaMeasure | FormulaSpeed) else Reading(row.label, measure)
            motion, rest = _split_by_time(held, timely)
            switches = tuple(dict.fromkeys(x for e, _ in calls_with_efforts(rest) for x in _zero_at_kinks(e)))
            moves = tuple(
                x for x in switches if any(readings_in(x)) or not set(names_in_expression(x)) <= timely - {"t"}
            )
            key = "value" if not own else f"rows[{i}].{'position' if isinstance(row, Holonomic) else 'velocity'}"
            result.append(
                ChangingRow(
                    f"{joint.name}.{row.label}",
                    f"joints.{joint.name}.{key}",
                    row.unit,
                    difference(held, row.value),
                    sum_of_terms(motion, row.value),
                    moves,
                    not isinstance(row, Holonomic),
                )
            )
    return tuple(result)


def _switching_calls(part: object) -> Iterator[Call]:
    """Yield the calls in a part of a mechanism that may jump or have kinks."""
    return (e for e, _ in calls_with_efforts(part) if _zero_at_kinks(e))


def _split_by_time(e: Expr, timely: set[str], sign: float = 1.0) -> tuple[Expr, Expr]:
    """Return the sums of the terms of a formula, times a sign, that depend on time alone, and of all others."""
    if not any(readings_in(e)) and set(names_in_expression(e)) <= timely:
        return (e if sign > 0.0 else call("neg", e)), ZERO
    if isinstance(e, Call) and e.function in ("add", "sub", "neg"):
        signs = (-sign,) if e.function == "neg" else (sign, sign if e.function == "add" else -sign)
        parts = [_split_by_time(a, timely, x) for a, x in zip(e.arguments, signs, strict=True)]
        return sum_of_terms(*(motion for motion, _ in parts)), sum_of_terms(*(rest for _, rest in parts))
    return ZERO, e if sign > 0.0 else call("neg", e)


def switching_formulas(part: object) -> Iterator[Expr]:
    """Yield whole formulas in a part of a mechanism that compare something or read a table, as formulas of a run."""
    for formula, effort in calls_with_efforts(part, enters=lambda e: False):
        if any(e.function in _COMPARED or table_of(e.function) for e, _ in calls_with_efforts(formula)):
            yield formula if effort is None else _effort_formula_of_run(formula, effort)


def formulas_with_domain(part: object) -> Iterator[tuple[Expr, Expr]]:
    """Yield formulas in a part of a mechanism, each with a call in it that is no number everywhere, as of a run."""
    for whole, effort in calls_with_efforts(part, enters=lambda e: False):
        for e, _ in calls_with_efforts(whole):
            if e.function in ("div", "pow") or (e.function in ELEMENTARY and not ELEMENTARY[e.function].everywhere):
                yield (
                    (whole, e)
                    if effort is None
                    else (_effort_formula_of_run(whole, effort), _effort_formula_of_run(e, effort))
                )


def _effort_formula_of_run(e: Expr, effort: Effort) -> Expr:
    """Return a formula of an effort with its ``s`` and ``rate`` as readings of the measure."""
    own = {name: Reading(name, effort.measure, order) for order, name in enumerate(("s", "rate"))}
    return replace_names(e, lambda name: own.get(name.name, name))


def calls_with_efforts(
    *parts: object, enters: Callable[[Call], bool] = lambda e: True
) -> Iterator[tuple[Call, Effort | None]]:
    """Yield the calls of functions in the formulas of parts of a mechanism, and in which effort each is.

    Calls inside a call follow where `enters` is true for it.
    """
    waiting: list[tuple[Any, Effort | None]] = [(part, None) for part in parts]
    while waiting:  # in a loop: large mechanisms have tens of thousands of nodes
        value, effort = waiting.pop()
        if isinstance(value, Call):
            yield value, effort
            value = value.arguments if enters(value) else ()
        if isinstance(value, tuple):
            waiting += [(item, effort) for item in value]
        elif isinstance(value, Chain):  # whose pieces are chosen by conditions of no formula
            yield Call("abs", (Reading("junction", OnChain(value, "junction")),)), effort
        elif isinstance(value, msgspec.Struct):
            own = value if isinstance(value, Effort) else effort
            waiting += [(getattr(value, field), own) for field in value.__struct_fields__]

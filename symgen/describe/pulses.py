"""Formulas of the time that may rest for long and then pass a pulse or a step, however narrow, though they are smooth.

What a formula is made of says so: a bell by `exp` of a parabola, `tanh` of a line, a high power of a sine, a quotient
whose denominator nearly vanishes. Straight lines, polynomials and sines of these hide nothing.
"""

from __future__ import annotations

from collections.abc import Iterator
from enum import IntEnum
from typing import Any

import msgspec

from symgen.describe.mechanism import Mechanism
from symgen.describe.outputs import integrated
from symgen.vocabulary.expressions import Call, Expr, Name, Number, names, table_of

#: How formulas of the time are written where they are kept.
_TIME = msgspec.msgpack.encode(Name("t"))
#: Powers up to this one count as polynomials.
_LOW = 16
#: Functions that are as even as their arguments, but for jumps and kinks, which are found otherwise; and those that
#: grow or fade with straight lines.
_EVEN = frozenset(("add", "sub", "neg", "sin", "cos", "sqrt", "log", "asinh", "where", "and", "or", "not"))
_EVEN |= {"abs", "sign", "min", "max", "lt", "le", "gt", "ge"}
_EXPONENTIAL = frozenset(("exp", "sinh", "cosh"))


class _Kind(IntEnum):
    """What a formula may do in time."""

    CONSTANT = 0
    LINE = 1
    EVEN = 2
    GROWING = 3
    SHARP = 4


def pulses_of(mechanism: Mechanism) -> tuple[Expr, ...]:
    """Return the parts of formulas of joints, forces and integrals that may hide a pulse in time, each once.

    They are formulas of t and parameters; of nested ones each is named, as one may be small beside the other.
    """
    timely = {p.name for p in mechanism.parameters if not p.input} | {"t"}
    formulas = integrated(mechanism)
    if _TIME not in msgspec.msgpack.encode(formulas):
        return ()
    parts = (part for parts in formulas for part in parts if _TIME in msgspec.msgpack.encode(part))
    return tuple(dict.fromkeys(e for part in parts for formula in _in_time(part, timely) for e in sharp_in(formula)))


def sharp_in(formula: Expr) -> tuple[Expr, ...]:
    """Return the parts of a formula of t and parameters that may hide a pulse, each once."""
    found = dict[Expr, None]()
    _kind(formula, found)
    return tuple(found)


def _in_time(part: Any, timely: set[str]) -> Iterator[Call]:
    """Yield the largest formulas of t and parameters in a part of a mechanism."""
    waiting = [part]
    while waiting:
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


def _kind(e: Expr, found: dict[Expr, None]) -> tuple[_Kind, float]:
    """Return what a formula of t and parameters may do, and its power of that, having noted the sharp ones in it."""
    if not isinstance(e, Call):
        return (_Kind.LINE, 1.0) if isinstance(e, Name) and e.name == "t" else (_Kind.CONSTANT, 0.0)
    kinds, powers = zip(*(_kind(a, found) for a in e.arguments), strict=True)
    function, kind, power = e.function, max(kinds), max(powers)
    if kind is _Kind.CONSTANT or function in ("add", "sub", "neg"):
        return kind, power
    if function in ("mul", "div") and _Kind.CONSTANT in kinds[function == "div" :]:  # by a number
        return kind, power
    if function in _EXPONENTIAL and kind is _Kind.LINE:
        return _Kind.GROWING, power
    even = function in _EVEN or table_of(function)
    if function == "mul" and (kind < _Kind.SHARP or min(kinds) < _Kind.GROWING):
        even, power = True, sum(powers)
    if function == "pow" and isinstance(n := e.arguments[1], Number) and n.value in range(_LOW + 1):
        even, power = True, n.value * power
    if even and power <= _LOW:
        return max(kind, _Kind.EVEN), power
    found[e] = None
    return _Kind.SHARP, power

"""The keys ``holds`` and ``holds_at`` of joints: what a table says of when their rows are in force."""

from __future__ import annotations

from typing import Any

import msgspec

from symgen.base.vocabulary.expressions import (
    Expr,
    call,
)
from symgen.base.vocabulary.measures import Holonomic
from symgen.describe.formulas.results_read import reads_results
from symgen.describe.mechanism import Joint
from symgen.describe.parts.event_sections import switching_function
from symgen.describe.parts.fields import Condition, Flag, Holds, HoldsAt, read_table, read_value
from symgen.describe.parts.scope import Scope

#: Keys of joints, and what `holds_at` may be.
HOLDS, HOLDS_AT, DESCRIBED, PRESENT = "holds", "holds_at", "described", "present"


class HoldsSection(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """When the rows of a joint are in force.

    Parameters
    ----------
    during : str
        A condition: the rows are in force while it is true. In place of the two others.
    catches, releases : str
        Conditions of t, parameters and the state, of forces too in `releases`: the joint catches, or releases, when one
        becomes true. Without `catches` it never catches again, without `releases` it never lets go.
    at_start : bool
        Whether the rows are in force at the start; by default the value of the condition with positions as described.
    """

    during: Condition | None = None
    catches: Condition | None = None
    releases: Condition | None = None
    at_start: Flag | None = None


class ReadHolding(msgspec.Struct, frozen=True):
    """What the keys of a joint say; `first` is a switching function at the start, which described positions decide."""

    joint: str
    where: str
    first: Expr | bool
    catches: Expr | None
    releases: Expr | None
    present: bool


def read_holding(scope: Scope, joint: Joint, raw: dict[str, Any]) -> ReadHolding | None:
    """Return when the rows of a joint are in force, from its table; None where they always are.

    Raises
    ------
    InputError
        With the key that is wrong.
    """
    if HOLDS not in raw:
        if HOLDS_AT in raw:
            raise scope.error(HOLDS_AT, "the key holds beside it", "no such key")
        return None
    if not joint.rows or not all(type(row) is Holonomic for row in joint.rows):
        got = f"a {joint.kind} joint" + (", which has rows of velocities or none" if joint.kind != "driver" else "")
        raise scope.error(HOLDS, "a joint that holds positions", got)
    at = read_value(HoldsAt, raw.get(HOLDS_AT, DESCRIBED), scope.where(HOLDS_AT))
    value = read_value(Holds, raw[HOLDS], scope.where(HOLDS))
    table = {"during": value} if isinstance(value, str) else value
    section = read_table(HoldsSection, table, scope.where(HOLDS))
    key = HOLDS if isinstance(value, str) else f"{HOLDS}.during"
    if section.during is not None:
        if section.catches is not None or section.releases is not None:
            raise scope.error(HOLDS, "the condition during, or catches and releases", "both")
        during = _condition(scope, key, section.during, True)
        catches = None if reads_results(during) else during
        releases: Expr | None = call("neg", during)
        first: Expr | bool = True if catches is None else during
    else:
        if section.catches is None and section.releases is None:
            raise scope.error(HOLDS, "a condition: during, catches or releases", "none")
        catches = None if section.catches is None else _condition(scope, f"{HOLDS}.catches", section.catches, False)
        releases = None if section.releases is None else _condition(scope, f"{HOLDS}.releases", section.releases, True)
        first = True if catches is None else catches
    if section.at_start is not None:
        first = section.at_start
    return ReadHolding(joint.name, scope.where(HOLDS), first, catches, releases, at == PRESENT)


def _condition(scope: Scope, key: str, text: str, results: bool) -> Expr:
    """Return a function above 0 where a condition holds; with `results` it may read forces."""
    function, is_condition = switching_function(scope, key, text, results)
    if not is_condition:
        raise scope.error(key, "a condition such as 't < 0.3'", repr(text))
    return function

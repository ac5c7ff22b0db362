"""Bounds that formulas give: of t, parameters, inputs and state, and of a rate."""

from __future__ import annotations

from collections.abc import Sequence

from symgen.base.vocabulary.expressions import ZERO, Call, Expr, call, names_in_expression, readings_in, table_of
from symgen.describe.parts.scope import Scope


def is_constant(scope: Scope, formula: Expr) -> bool:
    """Return whether a formula depends on parameters alone."""
    return (
        not (any(readings_in(formula)) or _reads_table(formula))
        and set(names_in_expression(formula)) <= scope.context.values.keys()
    )


def _reads_table(formula: Expr) -> bool:
    """Return whether a table is called in a formula."""
    if not isinstance(formula, Call):
        return False
    return table_of(formula.function) is not None or any(map(_reads_table, formula.arguments))


def read_bound(scope: Scope, key: str, value: float | str, words: Sequence[str] = ()) -> Expr:
    """Return a bound. A formula of parameters must be at least 0; of any other formula, a negative value counts as 0.

    Parameters
    ----------
    scope : Scope
        The place of the joint.
    key : str
        The key.
    value : float or str
        Its number or formula.
    words : sequence of str
        Words of its own that the formula may have.

    Raises
    ------
    InputError
        With the key, where it is wrong.
    """
    formula = scope.of_state(key, value, {word: word for word in words})
    if not is_constant(scope, formula):
        return call("max", formula, ZERO)
    if (size := scope.value(formula, key)) < 0.0:
        raise scope.error(key, "a value of at least 0", repr(size))
    return formula

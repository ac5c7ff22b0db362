"""Trees of formulas: logic and choices of literals folded away, and how deep a tree is."""

from __future__ import annotations

from symgen.base.vocabulary.expressions import Call, Expr, Number, call, literal_of


def fold_choice(condition: Expr, yes: Expr, no: Expr) -> Expr:
    """Return the choice, already made where the condition is a literal."""
    if isinstance(condition, Number):
        return yes if condition.value else no
    return call("where", condition, yes, no)


def fold_logic(function: str, operands: tuple[Expr, ...]) -> Expr:
    """Return and, or, not with literal operands folded away: a condition in a tree is never a literal."""
    if function == "not":
        return call("not", operands[0])
    left, right = operands
    absorbing = 0.0 if function == "and" else 1.0
    for literal, other in ((left, right), (right, left)):
        if isinstance(literal, Number):
            return literal_of(absorbing) if bool(literal.value) == bool(absorbing) else other
    return call(function, left, right)


def depth_of_tree(expression: Expr) -> int:
    """Return how deep calls are nested in a tree."""
    deepest, stack = 0, [(expression, 1)]
    while stack:
        node, depth = stack.pop()
        deepest = max(deepest, depth)
        if isinstance(node, Call):
            stack.extend((argument, depth + 1) for argument in node.arguments)
    return deepest

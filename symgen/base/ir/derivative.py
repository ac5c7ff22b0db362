"""Exact partial derivatives on the graph: every operation's own rule, applied in evaluation order.

The Jacobians of the implicit integrators (stiffness, damping and what constraints and multipliers add to them) are
derivatives of blocks that SymPy has derived, taken here operation by operation: no differences, and nothing is
expanded. Before any solve each output depends on the coordinates of a few bodies, so derivatives are kept sparse.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence

from symgen.base.ir.graph import Graph
from symgen.base.ir.program import derived_table
from symgen.base.vocabulary.elementary_functions import ELEMENTARY, nonzero_divisor

Key = tuple[str, int]


def jacobian(graph: Graph, outputs: Sequence[int], inputs: Iterable[Key]) -> list[dict[Key, int]]:
    """Return the partial derivatives of `outputs`, one mapping from input to node for each.

    Parameters
    ----------
    graph : Graph
        Holds the outputs; the derivatives are built in it.
    outputs : sequence of int
        Nodes.
    inputs : iterable of (space, index)
        Variables of differentiation; structurally zero derivatives are absent.

    Notes
    -----
    At a kink of ``abs``, ``min``, ``max`` or ``sign`` the derivative is one-sided; the slope of straight
    lines is the slope below the argument. Where a root, a power, ``asin`` or ``acos`` rises without bound it
    is a large number, which vanishes where its arguments do not change.
    """
    variables = set(inputs)
    derivative: dict[int, Mapping[Key, int]] = {}
    for node in graph.required_nodes(outputs):
        op, args, payload = graph.nodes[node]
        if op == "const":
            derivative[node] = {}
        elif op == "input":
            derivative[node] = {payload: graph.one} if payload in variables else {}
        else:
            derivative[node] = _apply_chain_rule(graph, node, op, args, str(payload), [derivative[a] for a in args])
    return [dict(derivative[o]) for o in outputs]


def _apply_chain_rule(
    g: Graph, node: int, op: str, args: tuple[int, ...], payload: str, parts: list[Mapping[Key, int]]
) -> Mapping[Key, int]:
    if not any(parts):
        return {}
    if op in ("where", "min", "max"):
        return _differentiate_choice(g, op, args, parts)
    result: dict[Key, int] = {}
    for factor, part in zip(_partial_derivatives(g, node, op, args, payload), parts, strict=True):
        if factor == g.zero:
            continue
        for key, inner in part.items():
            term = g.mul(factor, inner)
            result[key] = g.add(result[key], term) if key in result else term
    return {key: n for key, n in result.items() if n != g.zero}


def _differentiate_choice(
    g: Graph, op: str, args: tuple[int, ...], parts: list[Mapping[Key, int]]
) -> Mapping[Key, int]:
    """Return the derivatives of the chosen value of a choice, as the others may not exist there."""
    if op == "where":
        condition, first, second = args[0], parts[1], parts[2]
    else:
        condition = g.call("le" if op == "min" else "ge", args[0], args[1])
        first, second = parts
    keys = dict.fromkeys((*first, *second))
    return {key: g.call("where", condition, first.get(key, g.zero), second.get(key, g.zero)) for key in keys}


def _partial_derivatives(g: Graph, node: int, op: str, args: tuple[int, ...], payload: str) -> tuple[int, ...]:
    """Return the derivative of one operation with respect to each of its arguments."""
    one, zero = g.one, g.zero
    a = args[0]
    b = args[1] if len(args) > 1 else zero
    if op == "add":
        return one, one
    if op == "sub":
        return one, g.constant(-1.0)
    if op == "neg":
        return (g.constant(-1.0),)
    if op == "mul":
        return b, a
    if op == "div":
        return g.div(one, b), g.neg(g.div(node, b))
    if op == "pow":
        return _power_derivatives(g, node, a, b)
    if op == "atan2":
        square = nonzero_divisor(g, g.add(g.mul(a, a), g.mul(b, b)), 1e-200)
        return g.div(b, square), g.neg(g.div(a, square))
    if op == "table":
        derived = derived_table(payload)
        return (zero if derived is None else g.call(f"table:{derived}", a),)
    if op == "abs":
        return (g.call("sign", a),)
    if op in ELEMENTARY:
        return (ELEMENTARY[op].slope(g, a, node),)
    return (zero,) * len(args)  # comparisons, logic, sign and step are piecewise constant


def _power_derivatives(g: Graph, node: int, a: int, b: int) -> tuple[int, int]:
    """Return the derivatives of a power; at 0 raised to less than 1 they rise without bound."""
    one, exponent = g.one, g.value(b)
    if exponent is not None:
        if 0.0 < exponent < 1.0:
            return g.div(b, nonzero_divisor(g, g.power(a, g.constant(1.0 - exponent)))), g.zero
        return g.mul(b, g.power(a, g.sub(b, one))), g.zero
    base = nonzero_divisor(g, a)
    return g.mul(b, g.power(base, g.sub(b, one))), g.mul(node, g.call("log", base))

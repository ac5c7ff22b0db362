"""A small interpreter of the expression graph: what a node is worth, without printing or compiling anything."""

import math
import operator
from collections.abc import Callable, Mapping, Sequence

_OPERATIONS: dict[str, Callable] = {
    "add": operator.add,
    "sub": operator.sub,
    "mul": operator.mul,
    "neg": operator.neg,
    "pow": operator.pow,
    "abs": abs,
    "min": min,
    "max": max,
    "lt": operator.lt,
    "le": operator.le,
    "gt": operator.gt,
    "ge": operator.ge,
    "and": lambda a, b: bool(a) and bool(b),
    "or": lambda a, b: bool(a) or bool(b),
    "not": operator.not_,
    "step": lambda a, b: float(a > b),
    "sign": lambda a: float((a > 0) - (a < 0)),
    "where": lambda c, a, b: a if c else b,
    "defined": lambda a: a == a,
    "div": lambda a, b: a / b if b else math.copysign(math.inf, a),
}


def node_values(
    graph, outputs: Sequence[int], inputs: Mapping[tuple[str, int], float], tables: Sequence[tuple] = ()
) -> list[float]:
    """Values of nodes for values of the inputs; `tables` as in the equations."""
    known = {f"{'~' if t.pieces else ''}{t.name}": t for t in tables}
    value: dict[int, float] = {}
    for node in graph.required_nodes(outputs):
        op, args, payload = graph.nodes[node]
        numbers = [value[a] for a in args]
        if op == "const":
            value[node] = payload
        elif op == "input":
            value[node] = float(inputs[payload])
        elif op == "table":
            value[node] = known[payload.rstrip("'")].value(numbers[0], payload.count("'"))
        else:
            value[node] = (_OPERATIONS[op] if op in _OPERATIONS else getattr(math, op))(*numbers)
    return [float(value[n]) for n in outputs]


def state_inputs(t, q, v, parameters=()) -> dict[tuple[str, int], float]:
    """Inputs of equations: time, coordinates, velocities and parameters."""
    result = {("t", 0): t}
    for space, numbers in (("q", q), ("v", v), ("p", parameters)):
        result |= {(space, i): x for i, x in enumerate(numbers)}
    return result

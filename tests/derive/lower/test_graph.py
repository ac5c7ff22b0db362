"""The expression graph: what it simplifies keeps its value, and what is printed is what was built."""

import math

from hypothesis import given
from hypothesis import strategies as st
from support.checks import RANDOM
from support.graph_values import node_values

from symgen.base.ir.graph import Graph
from symgen.base.ir.program import Block, ModelLayout, OutputSlot
from symgen.derive.emit.printer import ElementAccess, Printer

X = (0.7, -1.3, 2.1)
BINARY = ("add", "sub", "mul", "div")
UNARY = ("neg", "sin", "abs", "sign", "tanh")


@st.composite
def programs(draw):
    """A random sequence of operations: (operation, arguments by number or literals)."""
    steps, available = [], len(X)
    for _ in range(draw(st.integers(1, 25))):
        kind = draw(st.sampled_from((*BINARY, *BINARY, *UNARY, "pow", "choose", "min")))
        number = st.sampled_from([0.0, 1.0, -1.0, 2.0, -0.5, 3.25])
        argument = st.one_of(st.integers(0, available - 1), st.integers(0, available - 1), number)
        steps.append((kind, [draw(argument) for _ in range(3)], draw(st.sampled_from([0.5, 1.0, 2.0, 2.5, 3.0, -1.0]))))
        available += 1
    return steps


def run(steps):
    """Build a program in a graph and compute it in plain numbers at once; unsafe operations are left out."""
    graph = Graph()
    nodes, values = [graph.input("q", i) for i in range(len(X))], list(X)
    for kind, arguments, exponent in steps:
        picked = [(graph.constant(a), a) if isinstance(a, float) else (nodes[a], values[a]) for a in arguments]
        (na, a), (nb, b), (nc, c) = picked
        if kind == "div" and abs(b) < 1e-3:
            kind = "add"
        if kind == "pow":
            node, value = (
                graph.power(graph.add(graph.call("abs", na), graph.one), graph.constant(exponent)),
                (abs(a) + 1) ** exponent,
            )
        elif kind == "choose":
            node, value = graph.call("where", graph.call("lt", na, nb), nc, na), c if a < b else a
        elif kind == "min":
            node, value = graph.call("min", na, nb), min(a, b)
        elif kind in UNARY:
            node = graph.neg(na) if kind == "neg" else graph.call(kind, na)
            plain = {"neg": -a, "abs": abs(a), "sign": float((a > 0) - (a < 0))}
            value = plain[kind] if kind in plain else getattr(math, kind)(a)
        else:
            node = getattr(graph, kind)(na, nb)
            value = {"add": a + b, "sub": a - b, "mul": a * b, "div": a / b if b else 0.0}[kind]
        if abs(value) > 1e6:
            continue
        nodes.append(node)
        values.append(value)
    return graph, nodes, values


def tolerance(values):
    return 1e-11 * max(1.0, *map(abs, values)) ** 2


@RANDOM
@given(steps=programs())
def test_simplification_keeps_values(steps):
    graph, nodes, values = run(steps)
    found = node_values(graph, nodes, {("q", i): x for i, x in enumerate(X)})
    for a, b in zip(found, values, strict=True):
        assert abs(a - b) <= tolerance(values)


@RANDOM
@given(steps=programs())
def test_printed_code_is_what_was_built(steps):
    graph, nodes, _ = run(steps)
    layout = ModelLayout(nq=len(X), nv=0, m=0, parameters=0, sections={"result": (0, len(nodes))})
    block = Block("f", "test", graph, tuple((OutputSlot("result", i), n) for i, n in enumerate(nodes)), ("y", "w"))
    lines = Printer(block, ElementAccess(layout, {})).lines()
    w = [0.0] * len(nodes)
    exec("\n".join([*lines.inputs, *lines.terms, *lines.outputs]), {"math": math, "y": list(X), "w": w})
    expected = node_values(graph, nodes, {("q", i): x for i, x in enumerate(X)})
    for a, b in zip(w, expected, strict=True):
        assert abs(a - b) <= 1e-12 * max(1.0, abs(b)), "\n".join(lines.terms + lines.outputs)


@RANDOM
@given(steps=programs())
def test_nothing_trivial_is_left(steps):
    """No product with a literal 0, 1 or -1, no sum with 0, no double negation, no operation on two literals."""
    graph, nodes, _ = run(steps)
    for node in graph.required_nodes(nodes):
        op, args, _ = graph.nodes[node]
        literals = [graph.value(a) for a in args]
        if op == "mul":
            assert not {0.0, 1.0, -1.0} & set(literals)
        if op in ("add", "sub"):
            assert 0.0 not in literals
        if op in ("add", "sub", "mul", "div"):
            assert None in literals
        if op == "neg":
            assert graph.nodes[args[0]].op not in ("neg", "const")


@RANDOM
@given(steps=programs())
def test_the_same_operation_is_stored_once(steps):
    graph, nodes, _ = run(steps)
    assert len(set(graph.nodes)) == len(graph.nodes)
    copied = graph.copy()
    again = [copied.apply(op, args, payload) for op, args, payload in map(graph.nodes.__getitem__, nodes) if args]
    assert again == [n for n in nodes if graph.nodes[n].args]
    assert graph.count_operations(nodes) <= graph.count_tree_operations(nodes)

"""Derivatives on the graph against differences with 80 digits, on random graphs that hold every operation."""

import mpmath
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from support.checks import RANDOM

from symgen.base.ir.derivative import jacobian
from symgen.base.ir.graph import FUNCTIONS, Graph

INPUTS = [("q", 0), ("q", 1), ("v", 0), ("k", 0)]
TABLE = ((-2.0, -0.5, 0.3, 2.0), (0.4, -1.0, 0.7, 2.5))
#: What every node is wrapped in where an operation is defined on a part of the numbers only.
ROOM = {
    **dict.fromkeys(("sqrt", "log"), "positive"),
    **dict.fromkeys(("asin", "acos", "atanh"), "within"),
    **dict.fromkeys(("exp", "tan", "sinh", "cosh", "tanh", "atan", "asinh"), "bounded"),
    **{"acosh": "above 1"},
}
UNARY = ("neg", "abs", *"sqrt exp log sin cos tan asin acos atan sinh cosh tanh asinh acosh atanh".split())
BINARY = ("add", "sub", "mul", "div", "atan2", "min", "max", "where", "power", "sign", "step", "table")
EXPONENTS = (2.0, 3.0, -1.0, 0.5, 1.5, -2.5, 0.3, None)


def _table(x):
    (xs, ys) = TABLE
    i = max(1, min(len(xs) - 1, int(np.searchsorted(xs, float(x)))))
    if x <= xs[0] or x >= xs[-1]:
        return mpmath.mpf(ys[0] if x <= xs[0] else ys[-1])
    return ys[i - 1] + (x - xs[i - 1]) * mpmath.mpf(ys[i] - ys[i - 1]) / (mpmath.mpf(xs[i]) - xs[i - 1])


def _table_slope(x):
    h = mpmath.mpf(10) ** -30
    return (_table(x + h) - _table(x - h)) / (2 * h)


_EXACT = {
    "add": lambda a, b: a + b,
    "sub": lambda a, b: a - b,
    "mul": lambda a, b: a * b,
    "div": lambda a, b: a / b,
    "neg": lambda a: -a,
    "pow": lambda a, b: a**b,
    "abs": abs,
    "min": min,
    "max": max,
    "lt": lambda a, b: a < b,
    "le": lambda a, b: a <= b,
    "gt": lambda a, b: a > b,
    "ge": lambda a, b: a >= b,
    "step": lambda a, b: mpmath.mpf(1 if a > b else 0),
    "sign": lambda a: mpmath.sign(a),
    "and": lambda a, b: a and b,
    "where": lambda c, a, b: a if c else b,
}


def exact(graph, outputs, values):
    """Values of nodes with the working precision of mpmath."""
    known = {}
    for node in graph.required_nodes(outputs):
        op, args, payload = graph.nodes[node]
        numbers = [known[a] for a in args]
        if op == "const":
            known[node] = mpmath.mpf(payload)
        elif op == "input":
            known[node] = values[payload]
        elif op == "table":
            known[node] = (_table_slope if payload.endswith("'") else _table)(numbers[0])
        else:
            known[node] = (_EXACT[op] if op in _EXACT else getattr(mpmath, op))(*numbers)
    return [known[n] for n in outputs]


def apply(g, op, a, b, exponent):
    """One operation on two nodes, arguments brought into its domain."""
    square = g.add(g.one, g.mul(a, a))
    room = ROOM.get(op)
    if room is not None:
        bounded = g.call("sin", a)
        within, above = g.mul(g.constant(0.7), bounded), g.add(g.one, square)
        a = {"positive": square, "within": within, "bounded": bounded, "above 1": above}[room]
    if op == "div":
        return g.div(b, square)
    if op == "power":
        return g.power(square, g.call("sin", b) if exponent is None else g.constant(exponent))
    if op == "where":
        return g.call("where", g.call("lt", a, b), g.mul(a, b), g.sub(b, a))
    if op == "sign":
        return g.mul(g.call("sign", a), b)
    if op == "step":
        return g.mul(g.call("step", a, b), b)
    if op == "table":
        return g.call("table:curve", g.mul(g.constant(2.0), g.call("sin", a)))
    if op in ("add", "sub", "mul"):
        return getattr(g, op)(a, b)
    return g.neg(a) if op == "neg" else g.call(op, *((a, b) if op in BINARY else (a,)))


@st.composite
def graphs(draw):
    """A graph on a few inputs and constants, and its last nodes."""
    g = Graph()
    nodes = [g.input(*key) for key in INPUTS] + [g.constant(c) for c in (0.7, -1.3)]
    for _ in range(draw(st.integers(2, 14))):
        op = draw(st.sampled_from(UNARY + BINARY))
        pick = st.integers(0, len(nodes) - 1)
        nodes.append(apply(g, op, nodes[draw(pick)], nodes[draw(pick)], draw(st.sampled_from(EXPONENTS))))
    return g, nodes[-3:]


def check(g, outputs, point):
    """All partial derivatives at a point; a structurally absent one is 0."""
    with mpmath.workdps(80):
        h = mpmath.mpf(10) ** -30
        values = {key: mpmath.mpf(x) for key, x in zip(INPUTS, point, strict=True)}
        found = jacobian(g, outputs, INPUTS)
        for key in INPUTS:
            ahead = exact(g, outputs, values | {key: values[key] + h})
            behind = exact(g, outputs, values | {key: values[key] - h})
            for output, derivatives, a, b in zip(outputs, found, ahead, behind, strict=True):
                difference = (a - b) / (2 * h)
                value = exact(g, [derivatives[key]], values)[0] if key in derivatives else 0
                # constants of the graph are folded in double precision
                assert abs(value - difference) <= 1e-12 * (1 + abs(difference)), f"{g.nodes[output]} by {key}"


@RANDOM
@given(made=graphs(), data=st.data())
def test_random_graphs(made, data):
    seed = data.draw(st.integers(0, 10**6))
    check(*made, np.random.default_rng(seed).uniform(-1.5, 1.5, len(INPUTS)))


@pytest.mark.parametrize(
    ("op", "exponent"),
    [(op, e) for op in UNARY + BINARY for e in (EXPONENTS if op == "power" else (None,))],
)
def test_every_operation(op, exponent):
    g = Graph()
    q0, q1, v0, k0 = (g.input(*key) for key in INPUTS)
    output = apply(g, op, g.add(q0, g.mul(v0, v0)), g.sub(g.mul(q1, k0), v0), exponent)
    for seed in range(3):
        check(g, [output], np.random.default_rng(seed).uniform(-1.5, 1.5, len(INPUTS)))


def test_no_operation_is_left_out():
    """A function that is added to the graph needs a rule, and a place here."""
    constant = {"lt", "le", "gt", "ge", "and", "or", "not", "floor", "defined"}
    assert constant | set(UNARY) | set(BINARY) >= FUNCTIONS


def test_absent_and_wanted():
    """Only what was asked for, and nothing that is structurally zero."""
    g = Graph()
    a, b = g.input("q", 0), g.input("q", 1)
    first, second = jacobian(g, [g.mul(a, a), g.sub(g.add(a, b), b)], [("q", 0)])
    assert set(first) == {("q", 0)}
    assert set(second) == {("q", 0)} and second["q", 0] == g.one
    assert jacobian(g, [g.constant(2.0)], INPUTS) == [{}]


#: What rises without bound where its argument is 0, times something that vanishes there: functions of r = |x| or of x
#: whose derivatives by x and y are 0 at the origin, as differences show.
FLAT = {
    "x |x|^1/2": lambda g, x, y: g.mul(x, g.call("sqrt", g.call("abs", x))),
    "x r": lambda g, x, y: g.mul(x, g.call("sqrt", g.add(g.mul(x, x), g.mul(y, y)))),
    "max(0, x)^3/2": lambda g, x, y: g.power(g.call("max", g.zero, x), g.constant(1.5)),
    "x |x|^0.3": lambda g, x, y: g.mul(x, g.power(g.call("abs", x), g.constant(0.3))),
    "x |x|^k": lambda g, x, y: g.mul(x, g.power(g.call("abs", x), g.input("k", 0))),
    "max(0, x)^(1 + k)": lambda g, x, y: g.power(g.call("max", g.zero, x), g.add(g.one, g.input("k", 0))),
    "r^2 atan2(y, x)": lambda g, x, y: g.mul(g.add(g.mul(x, x), g.mul(y, y)), g.call("atan2", y, x)),
    "x acos(1 - x^2)": lambda g, x, y: g.mul(x, g.call("acos", g.sub(g.one, g.mul(x, x)))),
    "x acosh(1 + x^2)": lambda g, x, y: g.mul(x, g.call("acosh", g.add(g.one, g.mul(x, x)))),
}


@pytest.mark.parametrize("name", FLAT)
def test_what_is_flat_at_the_end_of_a_root_s_range(name):
    """A product of 0 and infinity was no number: what is pressed together where nothing touches, drag at rest."""
    g = Graph()
    x, y = g.input("q", 0), g.input("q", 1)
    output = FLAT[name](g, x, y)
    keys = [("q", 0), ("q", 1), ("k", 0)]
    (found,) = jacobian(g, [output], keys)
    with mpmath.workdps(40):
        for number in (0, mpmath.mpf(10) ** -30):
            values = {("q", 0): mpmath.mpf(number), ("q", 1): mpmath.mpf(0), ("k", 0): mpmath.mpf("0.3")}
            for node in found.values():
                assert abs(exact(g, [node], values)[0]) < 1e-6
    again = jacobian(g, list(found.values()), keys[:2])  # and their derivatives are numbers
    assert all(mpmath.isfinite(exact(g, [node], values)[0]) for one in again for node in one.values())

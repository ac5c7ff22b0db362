"""Normal forms: like terms together, sin^2 + cos^2 = 1, and never a longer text."""

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st
from support.checks import RANDOM, close
from support.graph_values import node_values

from symgen.base.ir.graph import PARAMETER, Graph
from symgen.base.ir.polynomial import NormalForms


def test_squares_of_sine_and_cosine_are_one():
    g = Graph()
    a, mass, length = g.input("q", 0), g.input("p", 0), g.input("p", 1)
    sine, cosine = (g.mul(length, g.call(name, a)) for name in ("sin", "cos"))
    node = g.add(g.mul(mass, g.mul(sine, sine)), g.mul(mass, g.mul(cosine, cosine)))
    assert NormalForms(g).simpler(node) == g.mul(mass, g.mul(length, length)), "a number that depends on no state"


def test_terms_that_cancel_vanish():
    g = Graph()
    x, y, s = g.input("v", 0), g.input("v", 1), g.call("sin", g.input("q", 0))
    node = g.sub(g.mul(g.mul(x, s), y), g.mul(x, g.mul(s, y)))
    assert NormalForms(g).simpler(node) == g.zero


def test_a_number_and_its_reciprocal_cancel():
    """A spring's force k (l - l0) along a direction d / l, with l by sines."""
    g = Graph()
    s, k, l0 = g.call("sin", g.input("q", 0)), g.input("p", 0), g.input("p", 1)
    length = g.call("sqrt", g.add(g.one, s))
    inverse = g.div(g.one, length)
    node = g.mul(s, g.mul(inverse, g.mul(k, g.sub(length, l0))))
    assert NormalForms(g).simpler(g.mul(length, g.mul(s, inverse))) == s
    assert of_state(g, NormalForms(g).simpler(node)) == of_state(g, node) - 1
    (value,) = node_values(g, [NormalForms(g).simpler(node)], {("q", 0): 0.5, ("p", 0): 3.0, ("p", 1): 0.7})
    assert value == pytest.approx(math.sin(0.5) * 3.0 * (1.0 - 0.7 / math.sqrt(1.0 + math.sin(0.5))), rel=1e-15)


def test_forces_of_two_velocities_share_coefficient_and_sines():
    """Each is p v^2 sin(a - b): a difference of two products, times p, and two products more for each velocity."""
    g, forms = Graph(), []
    (s, c), (t, d) = ((g.call("sin", g.input("q", i)), g.call("cos", g.input("q", i))) for i in range(2))
    for i in range(2):
        square = g.mul(g.input("v", i), g.input("v", i))
        force = g.sub(g.mul(g.mul(square, s), d), g.mul(g.mul(square, c), t))
        forms.append(NormalForms(g).simpler(g.mul(g.input("p", 0), force)))
    kinds = [g.nodes[n].op for n in g.required_nodes(forms)]
    assert kinds.count("mul") == 2 + 1 + 2 * 2 and kinds.count("sub") == 1


def test_positive_terms_stand_first():
    g = Graph()
    s, c, v = g.call("sin", g.input("q", 0)), g.call("cos", g.input("q", 0)), g.input("v", 0)
    node = g.add(g.neg(g.mul(s, v)), g.mul(c, g.add(g.mul(v, v), g.sub(s, s))))
    result = NormalForms(g).simpler(node)
    assert "neg" not in {g.nodes[n].op for n in g.required_nodes([result])}


def test_differences_of_positions_stay_whole():
    """A gap of 1e-9 between two coordinates of 1, times 1e9, keeps its digits."""
    g = Graph()
    gap = g.sub(g.input("q", 0), g.input("q", 1))
    stiffness, s = g.input("p", 0), g.call("sin", g.input("q", 2))
    node = g.mul(stiffness, g.mul(gap, g.add(s, g.mul(s, s))))
    result = NormalForms(g).simpler(node)
    values = {("q", 0): 1.0 + 2.0**-30, ("q", 1): 1.0, ("q", 2): 1.0, ("p", 0): 2.0**30}
    expected = math.sin(1.0) + math.sin(1.0) ** 2
    assert node_values(g, [result], values)[0] == pytest.approx(expected, rel=1e-15)


def of_state(g, node):
    """Operations at every evaluation: what depends on parameters alone is computed once, and sines stay."""
    kinds = [g.nodes[n].op for n in g.required_nodes([node]) if g.depends[n] not in (0, PARAMETER)]
    return sum(kind not in ("input", "sin", "cos") for kind in kinds)


@RANDOM
@given(seed=st.randoms(use_true_random=False))
def test_values_stay_and_operations_do_not_grow(seed):
    g = Graph()
    nodes = [g.input("v", i) for i in range(2)] + [g.input("p", 0), g.constant(2.0)]
    nodes += [g.call(name, g.input("q", i)) for name in ("sin", "cos") for i in range(2)]
    for _ in range(12):
        kind = seed.choice(("add", "sub", "mul", "mul"))
        nodes.append(getattr(g, kind)(seed.choice(nodes), seed.choice(nodes)))
    values = {(space, i): seed.uniform(-2.0, 2.0) for space in "vq" for i in range(2)} | {("p", 0): 0.7}
    forms = NormalForms(g)
    result = forms.simpler(nodes[-1])
    scale = 1.0 + max(map(abs, node_values(g, nodes, values)))
    close(node_values(g, [result], values), node_values(g, nodes[-1:], values), "value", 1e-11 * scale**2)
    assert of_state(g, result) <= of_state(g, nodes[-1])

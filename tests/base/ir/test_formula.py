"""What is undefined in a formula stays undefined, whatever is done with it, in compiled code of every shape."""

import math
import operator
from functools import cache
from typing import Any

import numba
import numpy as np
import pytest
import sympy as sp
from support.emitted import Emitted, mechanism_of

from symgen.api import load
from symgen.base.errors import InputError
from symgen.base.ir.graph import Graph
from symgen.base.ir.program import Block, ModelLayout, OutputSlot
from symgen.base.vocabulary.expressions import Expr, Name, Number
from symgen.derive.emit.printer import ElementAccess, Printer
from symgen.derive.formulate.translate import Translator, to_sympy
from symgen.describe.formulas.formula_nodes import Formulas
from symgen.describe.formulas.parser import FormulaNames, parse

#: Formulas of a and b, in which the root is undefined where a is below 0.
FORMULAS = (
    *(
        "max(1, sqrt(a))",
        "min(1, sqrt(a))",
        "max(sqrt(a), b)",
        "min(b, sqrt(a), 3)",
        "sign(sqrt(a))",
        "sign(log(a) + b)",
    ),
    *(
        "1 if sqrt(a) > 0.1 else 2",
        "1 if sqrt(a) <= 0.1 else 2",
        "1 if 0.1 >= sqrt(a) else 2",
        "1 if sqrt(a) < b else 2",
    ),
    *("1 if not sqrt(a) > 0.1 else 2", "1 if not (not asin(a) > 0.1) else 2"),
    *("1 if b > 0 and sqrt(a) > 1 else 2", "1 if sqrt(a) > 1 and b > 0 else 2", "1 if a > 0 and sqrt(a) > 1 else 2"),
    *("1 if b > 0 or sqrt(a) > 1 else 2", "1 if sqrt(a) > 1 or b > 0 else 2", "1 if a <= 0 or sqrt(a) > 1 else 2"),
    *("1 if not (b > 0 and not sqrt(a) > 1) or log(b) > 0 else 2", "1 if sqrt(a) > 1 and log(b) > 0 else 2"),
    *("1 if 0 < sqrt(a) < 1 else 2", "1 if log(a) < sqrt(b) or log(b) < 2 else 2"),
    *(
        "sqrt(a) if a > 0 else b",
        "b if a > 0 else sqrt(-a)",
        "max(0, sqrt(a) if a > 0 else 1)",
        "b if b > 0 else asin(a)",
    ),
    *("piecewise(a > 1, 1, sqrt(a) > 0.1, 2, 3)", "piecewise(sqrt(a) > 1, 1, b > 0, 2, 3)"),
    *(
        "max(1, a/b)",
        "max(1, a**b)",
        "min(a, b)",
        "max(sqrt(a*a + b**2), 1)",
        "max(1, 1/(1 + a**2))",
        "sign(a) + max(a, b, 0)",
    ),
    *("max(1, acosh(a))", "sign(atanh(a))", "min(asinh(a), b)", "1 if acosh(b) > 1 else atanh(a/4)"),
    *("max(1, 1 if sqrt(a) > 1 else 2)", "max(max(1, sqrt(a)), 5) + min(b, 1)", "abs(max(1, log(b)))"),
)
STATES = [(a, b) for a in (-2.0, -0.5, 0.005, 0.5, 3.0) for b in (-1.5, 0.0, 0.05, 2.0)]
_COMPARE = {"lt": operator.lt, "le": operator.le, "gt": operator.gt, "ge": operator.ge}
_PLAIN = {
    **{"add": np.add, "sub": np.subtract, "mul": np.multiply, "neg": np.negative, "abs": np.abs, "div": np.divide},
    **{"asinh": np.arcsinh, "acosh": np.arccosh, "atanh": np.arctanh},
    **{"sqrt": np.sqrt, "log": np.log, "asin": np.arcsin, "pow": np.power, "min": min, "max": max, "sign": np.sign},
}


def tree(text: str) -> Expr:
    return parse(text, FormulaNames("a formula", {"a": "a", "b": "b"}), "test")


def meant(e: Expr, values: dict[str, float]) -> Any:
    """What a formula means: a number, true or false; None where it is undefined."""
    if isinstance(e, Number):
        return e.value
    if isinstance(e, Name):
        return values[e.name]
    if e.function == "where":
        condition = meant(e.arguments[0], values)
        return None if condition is None else meant(e.arguments[1 if condition else 2], values)
    found = [meant(x, values) for x in e.arguments]
    if e.function in ("and", "or"):
        decides = e.function == "or"
        return decides if decides in found else None if None in found else not decides
    if None in found:
        return None
    if e.function == "not":
        return not found[0]
    if e.function in _COMPARE:
        return _COMPARE[e.function](*found)
    with np.errstate(all="ignore"):  # infinity is a number here, as it is for a processor
        value = _PLAIN[e.function](*map(np.float64, found))
    return None if np.isnan(value) else value


def compiled(graph: Graph, nodes: list[int]) -> Any:
    """The printed code of nodes as emitted functions are compiled."""
    layout = ModelLayout(2, 0, 0, 0, {"result": (0, len(nodes))})
    block = Block("f", "test", graph, tuple((OutputSlot("result", i), n) for i, n in enumerate(nodes)), ("y", "w"))
    lines = Printer(block, ElementAccess(layout, {})).lines()
    body = "\n    ".join([*lines.inputs, *lines.terms, *lines.outputs])
    namespace: dict[str, Any] = {"math": math}
    exec(f"def f(y, w):\n    {body}\n", namespace)
    return numba.njit(error_model="numpy", fastmath={"contract"})(namespace["f"])


def node_of(graph: Graph, text: str, names: dict[str, int]) -> int:
    """The node of a formula, by the way of a mechanism's formulas; a and b are placeholders."""
    return Formulas(load("pendulum").mechanism, graph).expression(tree(text), **names)


@cache
def routes() -> dict[str, Any]:
    """All formulas, built at once and by way of SymPy, where derivatives are wanted."""
    found = {}
    for route in ("formula", "SymPy"):
        graph = Graph()
        names = {"a": graph.input("q", 0), "b": graph.input("q", 1)}
        if route == "formula":
            nodes = [node_of(graph, text, names) for text in FORMULAS]
        else:
            symbols = {name: sp.Symbol(name, real=True) for name in names}
            translator = Translator(graph, {symbols[name]: node for name, node in names.items()})
            nodes = [translator.translate(to_sympy(tree(text), symbols)) for text in FORMULAS]
        found[route] = compiled(graph, nodes)
    return found


@pytest.mark.by_turns(8)
@pytest.mark.fast("0.5-0.05-SymPy", "3.0-0.0-formula")
@pytest.mark.parametrize("route", ["formula", "SymPy"])
@pytest.mark.parametrize("a, b", STATES)
def test_compiled_formulas_are_undefined_where_they_say_nothing(route, a, b):
    w = np.zeros(len(FORMULAS))
    routes()[route](np.array([a, b]), w)
    for text, found in zip(FORMULAS, w, strict=True):
        expected = meant(tree(text), {"a": a, "b": b})
        if expected is None:
            assert np.isnan(found), text
        else:
            assert found == pytest.approx(expected, rel=1e-14), text


def test_no_operation_is_added_where_nothing_can_be_undefined():
    defined = (
        "min(a, b)",
        "sign(a) + max(a, b, 0)",
        "max(sqrt(a*a + b**2), 1)",
        "max(1, 1/(1 + a**2))",
        "sign(tanh(a))",
    )
    defined += ("1 if a > 0 and not b < 1 else 2", "max(1, exp(a))", "sqrt(a) if a > 0 else b", "min(1, log(1 + a*a))")
    for text in (*FORMULAS, *defined):
        graph = Graph()
        node = node_of(graph, text, {"a": graph.input("q", 0), "b": graph.input("q", 1)})
        added = any(graph.nodes[n].op == "defined" for n in graph.required_nodes([node]))
        assert not added or text not in defined, text


def test_a_formula_that_is_undefined_everywhere_is_refused():
    x = sp.Symbol("x", real=True)
    with pytest.raises(InputError, match="one that is defined somewhere, got one that is zoo after simplification"):
        Translator(Graph(), {}).translate(
            to_sympy(parse("1/(x - x)", FormulaNames("a formula", {"x": "x"}), "test"), {"x": x})
        )


def test_derivatives_are_undefined_where_formulas_are():
    graph = Graph()
    x = sp.Symbol("x", real=True)
    translator = Translator(graph, {x: graph.input("q", 0)})
    trees = [
        parse(text, FormulaNames("a formula", {"x": "x"}), "test") for text in ("max(0, log(x))", "min(sqrt(x), 2)")
    ]
    slopes = [translator.translate(sp.diff(to_sympy(e, {"x": x}), x)) for e in trees]
    function, w = compiled(graph, slopes), np.zeros(2)
    function(np.array([-1.0, 0.0]), w)
    assert np.isnan(w).all()
    function(np.array([4.0, 0.0]), w)
    assert w.tolist() == [0.25, 0.0]


def pushed(force: str) -> dict[str, Any]:
    return {
        "mechanism": {"name": "n", "gravity": [0.0, -9.81]},
        "run": {"until": 1.0, "step": 1e-3, "output_step": 0.01},
        "bodies": {"bob": {"type": "point", "mass": 1.0, "position": [1, 0]}},
        "forces": {"f": {"type": "force", "body": "bob", "force": [force, "0"]}},
    }


@pytest.mark.parametrize("force", ["max(1, sqrt(0.5 - t))", "1 if sqrt(0.5 - t) > 0.1 else 2"])
@pytest.mark.parametrize("shape", ["straight", "looped"])
def test_runs_fail_where_a_force_becomes_undefined(force, shape):
    result = load(mechanism_of(pushed(force))).simulate(shape=shape)
    assert (result.status, result.t[-1]) == ("failed", pytest.approx(0.5, abs=1.1e-2))  # the last output
    assert "sqrt(0.5 - t) of force 'f' is undefined" in str(result.reason)


def test_a_guard_is_no_failure():
    """A condition that asks first whether the other one has a meaning."""
    force = "sqrt(0.5 - t) if t < 0.5 and sqrt(0.5 - t) > 0.1 else 0"
    found = Emitted(mechanism_of(pushed(force)), compiled=True)
    p = found.parameters({})
    for t, expected in ((0.1, math.sqrt(0.4)), (0.499, 0.0), (0.7, 0.0)):
        assert found.at(t, [1.0, 0.0], [0.0, 0.0], p).acceleration[0] == expected

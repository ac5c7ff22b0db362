"""What is in the language of emitted functions, with which types, and what is outside."""

import ast
import math

import numpy as np
import pytest

from symgen.compile.native.language import (
    ArrayElement,
    Assign,
    Choice,
    Constant,
    For,
    FunctionCall,
    If,
    Return,
    ScalarOperation,
    Store,
    Variable,
)
from symgen.compile.native.read import Foreign, read_function

A, F, N = ("float", True), ("float", False), ("int", False)


class Source:
    """A function with its syntax tree, as readers want it."""

    def __init__(self, text: str, names: dict[str, object], inlined: bool = False) -> None:
        self._tree, self.inlined = ast.parse(text).body[0], inlined
        space = {"math": math, **names}
        exec(text, space)
        self.__name__ = self._tree.name
        self.py_func = space[self.__name__]

    def tree(self) -> ast.FunctionDef | None:
        """Return the syntax tree."""
        return self._tree


def function(text: str, **names: object) -> Source:
    """Return a function that was not read yet."""
    return Source(text, names)


def of(text: str, *kinds: tuple[str, bool], **names: object):
    """Read a function."""
    return read_function(function(text, **names), kinds)


def body_of(line: str, **names: object):
    """Read a function of one line before its return."""
    return of(f"def f(y, w):\n    {line}\n    return 0\n", A, A, **names).body[0]


def test_a_straight_function():
    f = of('def rhs(t, y, w):\n    """Rates."""\n    q = y[2]\n    w[3] = q*2 + t\n    return 0\n', F, A, A)
    assert [(p.name, p.type, p.array) for p in f.parameters] == [
        ("t", "float", False),
        ("y", "float", True),
        ("w", "float", True),
    ]
    assert f.returned == "int" and f.variables == {"q": "float"} and f.fixed == {"q"}
    read_, write, end = f.body
    assert read_ == Assign("q", ArrayElement("float", "y", Constant("int", 2)))
    product = ScalarOperation("float", "mul", (Variable("float", "q"), Constant("float", 2.0)))
    assert write == Store("w", Constant("int", 3), ScalarOperation("float", "add", (product, Variable("float", "t"))))
    assert end == Return(Constant("int", 0))


@pytest.mark.parametrize(
    ("expression", "kind"),
    [
        ("1", "int"),
        ("1.0", "float"),
        ("-2", "int"),
        ("3 // 2", "int"),
        ("3 / 2", "float"),
        ("7 % 3", "int"),
        ("1 + 2.0", "float"),
        ("y[0] > 1", "bool"),
        ("not y[0]", "bool"),
        ("(y[0] > 1) & (y[1] < 2)", "bool"),
        ("y[0] > 1 or y[1] < 2", "bool"),
        ("1.0*(y[0] > y[1])", "float"),
        ("(y[0] > 0.0) - 1*(y[0] < 0.0)", "int"),
        ("math.floor(y[0])", "int"),
        ("math.sin(1)", "float"),
        ("math.inf", "float"),
        ("abs(-3)", "int"),
        ("abs(y[0])", "float"),
        ("min(1, y[0])", "float"),
        ("max(1, 2)", "int"),
        ("int(y[0])", "int"),
        ("float(3)", "float"),
        ("1 if y[0] > 0 else 0.5", "float"),
        ("y[0]**2", "float"),
        ("y[0]**y[1]", "float"),
        ("N + 1", "int"),
        ("X[2]", "float"),
    ],
)
def test_types_are_those_that_numba_infers(expression, kind):
    assignment = body_of(f"a = {expression}", N=3, X=np.array([1.0, 2.0, 3.0]))
    assert isinstance(assignment, Assign) and assignment.value.type == kind


def test_constants_of_the_module_and_tables():
    f = of("def f(y):\n    return X[N] + H\n", A, N=1, H=0.5, X=np.array([1.0, 2.0]))
    assert f.tables == {"X": (1.0, 2.0)} and f.returned == "float"
    assert f.body == (
        Return(
            ScalarOperation("float", "add", (ArrayElement("float", "X", Constant("int", 1)), Constant("float", 0.5)))
        ),
    )


def test_values_are_worked_out_before_the_first_is_stored():
    f = of("def f(y):\n    y[0], y[1] = y[1], y[0]\n    return 0\n", A)
    first, second, *stores, _ = f.body
    assert isinstance(first, Assign) and isinstance(second, Assign)
    assert [s.value.name for s in stores] == [first.name, second.name]


def test_variables_of_loops_and_branches_are_not_fixed():
    text = """def f(y, n):
    total = 0.0
    for i in range(n):
        total += y[i]
        if total > 1.0:
            last = i
            break
    n += 1
    return n
"""
    f = of(text, A, N)
    assert f.variables == {"total": "float", "i": "int", "last": "int", "n": "int"} and not f.fixed
    loop = f.body[1]
    assert isinstance(loop, For) and (loop.start, loop.step) == (Constant("int", 0), 1)
    assert isinstance(loop.body[1], If)


def test_calls_of_functions_of_the_same_kind():
    table = function("def table(x):\n    return 2.0*x\n")
    measure = function("def measure(w, i):\n    w[i] = table(w[0])\n    return 0\n", table=table)
    f = of("def f(w):\n    measure(w, 3)\n    return measure(w, 4)\n", A, measure=measure)
    assert [g.name for g in f.called] == ["measure"] and f.called[0].source is measure
    (assignment,) = [s for s in f.called[0].body if isinstance(s, Store)]
    assert isinstance(assignment.value, FunctionCall) and assignment.value.type == "float"
    assert isinstance(body_of("a = 1.0 if y[0] > 2 else y[1]"), Assign)
    assert isinstance(body_of("a = 1.0 if y[0] > 2 else y[1]").value, Choice)


@pytest.mark.parametrize(
    ("line", "why"),
    [
        ("a = [1.0]", "an expression 'List'"),
        ("a = y", "the name 'y'"),
        ("a = y[-1]", "an index"),
        ("a = y[0.5]", "an index"),
        ("a = y[0:1]", "an expression 'Slice'"),
        ("a = unknown", "the name 'unknown'"),
        ("a = b; b = 1", "the name 'b'"),
        ("a = 1; a = 2.0", "variable 'a' has two types"),
        ("y = 1.0", "variable 'y' has two types"),
        ("a = 1 < y[0] < 2", "a comparison"),
        ("a = y[0] and y[1]", "'and' or 'or' of numbers"),
        ("a = 1 if y[0] > 0 else True", "a choice between a boolean and a number"),
        ("a = y[0]**-1", "a power"),
        ("a = 2**3", "a power"),
        ("a = y[0] % 2.0", "a division with rest"),
        ("a = 7 // N", "a division with rest"),
        ("a = math.gamma(y[0])", "the function 'math.gamma'"),
        ("a = math.sin(y[0], y[1])", "the function 'math.sin'"),
        ("a = len(t)", "the length of something else than an argument"),
        ("a = sum(y)", "the name 'y'"),
        ("a = print(1)", "the function 'print'"),
        ("a = other(1)", "a call of 'other'"),
        ("a = abs(x=1)", "arguments by name"),
        ("a = y[0] << 2", "an operation"),
        ("a = ~1", "an operation"),
        ("a = -(y[0] > 1)", "an operation"),
        ("a = 'text'", "a value of type 'str'"),
        ("a = None", "a value of type 'NoneType'"),
        ("a = 10**30", "a power"),
        ("a = 99999999999999999999", "a value of type 'int'"),
        ("a = Z[0]", "an element of something else than an array of floats"),
        ("a = w.size", "an attribute"),
        ("a: float = 1.0", "a statement 'AnnAssign'"),
        ("y[0], y[1] = 1.0, 2.0, 3.0", "an assignment of unequal lengths"),
        ("X[0] = 1.0", "an element of a constant"),
        ("y.size = 1", "a target of an assignment"),
        ("del y", "a statement 'Delete'"),
        ("y[0]", "a statement 'Expr'"),
        ("return", "a return without value"),
        ("return y[0] > 1", "paths that return nothing, or different types"),
        ("return 1.0", "paths that return nothing, or different types"),
    ],
)
def test_whatever_else_is_outside(line, why):
    with pytest.raises(Foreign) as told:
        of(f"def f(y, w):\n    {line}\n    return 0\n", A, A, N=-2, X=np.zeros(3), Z=np.zeros(2, int))
    assert str(told.value).startswith(why)


@pytest.mark.parametrize(
    ("text", "why"),
    [
        ("def f(y, n=1):\n    return 0\n", "arguments other than plain ones"),
        ("def f(*y):\n    return 0\n", "arguments other than plain ones"),
        ("def f(y):\n    y[0] = 1.0\n", "paths that return nothing"),
        ("def f(y):\n    while y[0] > 1.0:\n        return 0\n", "paths that return nothing"),
        ("def f(y):\n    return f(y)\n", "the function 'f' calls itself"),
        ("def f(y):\n    for i in y:\n        pass\n    return 0\n", "a loop over something else than a range"),
        ("def f(y):\n    for i in range(3, 0, y):\n        pass\n    return 0\n", "the name 'y'"),
        ("def f(y):\n    for i in range(0, 3, N):\n        pass\n    return 0\n", "a range whose step is no constant"),
        (
            "def f(y):\n    for i in range(3):\n        pass\n    else:\n        pass\n    return 0\n",
            "a statement 'For'",
        ),
        ("def f(y):\n    for i in range(2.0):\n        pass\n    return 0\n", "a range"),
    ],
)
def test_functions_that_are_outside(text, why):
    f = function(text, N=0)
    f.py_func.__globals__["f"] = f
    with pytest.raises(Foreign) as told:
        read_function(f, (A,) * f.py_func.__code__.co_argcount)
    assert str(told.value).startswith(why)


def test_a_function_whose_source_is_gone_is_outside():
    gone = function("def f(y):\n    return 0\n")
    gone._tree = None
    with pytest.raises(Foreign, match="'f', whose definition is not at"):
        read_function(gone, (A,))

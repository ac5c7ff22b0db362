"""Every operation that a printer of blocks can print, in random combinations, compiled both ways."""

import itertools
import math
from contextlib import suppress

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from symgen.base.ir.graph import FUNCTIONS, Graph
from symgen.base.ir.program import Block, ModelLayout, OutputSlot
from symgen.compile.store.loaded_modules import load_module
from symgen.derive.emit.printer import ElementAccess, Printer

from .twofold import arguments_of, differences, load_twice, uncontracted, written

INPUTS, OUTPUTS = 12, 8
UNARY = ("neg", *"sqrt exp log sin cos tan asin acos atan sinh cosh tanh asinh acosh atanh abs floor sign".split())
BINARY = tuple("add sub mul div pow atan2 min max step".split())
COMPARISONS = tuple("lt le gt ge".split())
TABLES = ("table:bump", "table:~hump", "table:~hump''")
ALL = (*UNARY, *BINARY, *COMPARISONS, "and", "or", "not", "defined", "where", *TABLES)
#: Smooth pieces that repeat themselves, what they curve by, and straight lines.
HUMP = '''
def table_hump(x):
    """Cubic pieces."""
    at = x - 2.5 * math.floor((x - 0.5) / 2.5)
    low = 0
    high = 4
    while high - low > 1:
        middle = (low + high) // 2
        if at < HUMP_X[middle]:
            high = middle
        else:
            low = middle
    u = at - HUMP_X[low]
    low = 4 * low
    return HUMP_Y[low] + u * (HUMP_Y[low + 1] + u * (HUMP_Y[low + 2] + u * HUMP_Y[low + 3]))
'''
SECOND = '''
def second_hump(x):
    """Second derivative."""
    low = 1 if x > 1.25 else 0
    u = x - HUMP_X[low]
    return 2.0 * HUMP_Y[4 * low + 2] + u * (6.0 * HUMP_Y[4 * low + 3])
'''
TABLE = '''
def table_bump(x):
    """Linear interpolation."""
    if x <= 0.0:
        return 1.0
    if x >= 3.0:
        return -2.0
    low = 0
    high = 3
    while high - low > 1:
        middle = (low + high) // 2
        if x < BUMP_X[middle]:
            high = middle
        else:
            low = middle
    part = (x - BUMP_X[low]) / (BUMP_X[high] - BUMP_X[low])
    return BUMP_Y[low] + part * (BUMP_Y[high] - BUMP_Y[low])
'''
HEAD = """import math

import numpy as np
from numba import njit

BUMP_X = np.array([0.0, 0.5, 1.25, 3.0])
BUMP_Y = np.array([1.0, 4.0, -0.5, -2.0])
HUMP_X = np.array([0.5, 0.5, 1.25, 3.0])
HUMP_Y = np.array([1.0, 0.5, 0.0, 0.0, 1.0, 0.5, -2.0, 0.7, 0.3, -1.0, 2.0, -0.6, 1.0, 0.5, 0.0, 0.0])

"""
_counter = itertools.count()


def printed(graph: Graph, outputs: list[int], flag: int | None) -> str:
    """Return nodes as an emitted function."""
    block = Block(
        "f", "test", graph, tuple((OutputSlot("out", i), n) for i, n in enumerate(outputs)), ("y", "out"), flag
    )
    layout = ModelLayout(nq=INPUTS, nv=0, m=0, parameters=0, sections={})
    lines = Printer(block, ElementAccess(layout, {})).lines()
    body = [*lines.inputs, *lines.terms, *lines.outputs, f"return {f'int({lines.flag})' if lines.flag else 0}"]
    return "def f(y, out):\n" + "".join(f"    {line}\n" for line in body)


def judged(tmp_path, *functions: str) -> list[str]:
    folder = tmp_path / f"operations{next(_counter)}"
    direct, plain = load_twice(written(folder, TABLE, HUMP, SECOND, *functions, head=HEAD))
    with uncontracted():
        return differences(direct.f, plain.f, arguments_of(direct.f), 64, rounds=8)


def test_the_list_of_operations_is_complete():
    arithmetic = {"add", "sub", "mul", "div", "pow", "neg"}
    assert {name.partition(":")[0] for name in ALL} == FUNCTIONS | arithmetic | {"table"}


@st.composite
def programs(draw):
    """Draw a graph, its outputs and its flag."""
    graph = Graph()
    numbers = [graph.input("q", i) for i in range(INPUTS)]
    numbers += [graph.constant(draw(st.sampled_from((0.5, 2.0, -3.0, 1e-3, math.pi, 1.0, 7.0)))) for _ in range(3)]
    truths = [graph.call("gt", numbers[0], numbers[1])]
    names = draw(st.lists(st.sampled_from(ALL), min_size=10, max_size=40))

    def some(nodes: list[int]) -> int:
        return nodes[draw(st.integers(0, len(nodes) - 1))]

    for name in names:
        if name in COMPARISONS:
            truths.append(graph.call(name, some(numbers), some(numbers)))
        elif name in ("and", "or"):
            truths.append(graph.call(name, some(truths), some(truths)))
        elif name == "defined":
            truths.append(graph.call(name, some(numbers)))
        elif name == "not":
            truths.append(graph.call(name, some(truths)))
        elif name == "where":
            numbers.append(graph.call(name, some(truths), some(numbers), some(numbers)))
        else:
            count = 1 if name in UNARY or name in TABLES else 2
            arguments = tuple(some(numbers) for _ in range(count))
            if name == "floor":  # beyond integers each compiler has numbers of its own
                small = graph.call("lt", graph.call("abs", arguments[0]), graph.constant(1e15))
                arguments = (graph.call("where", small, arguments[0], graph.constant(0.5)),)
            base, exponent = graph.value(arguments[0]), graph.value(arguments[-1])
            if name == "pow" and base is not None and exponent is not None and base < 0.0 and exponent % 1.0:
                continue  # complex in Python; formulas of files with such a power are refused
            with suppress(OverflowError):  # of constants, which is told whoever wrote them
                numbers.append(graph.apply(name, arguments) if ":" not in name else graph.call(name, *arguments))
    return graph, [some(numbers[-20:]) for _ in range(OUTPUTS)], some(truths) if draw(st.booleans()) else None


@pytest.mark.slow
@given(program=programs())
@settings(max_examples=8, deadline=None, suppress_health_check=list(HealthCheck), derandomize=True, database=None)
def test_random_programs(tmp_path_factory, program):
    assert judged(tmp_path_factory.mktemp("programs"), printed(*program)) == []


@pytest.mark.by_turns(2)
@pytest.mark.slow
@given(program=programs())
@settings(max_examples=20, deadline=None, suppress_health_check=list(HealthCheck), database=None)
def test_more_random_programs(tmp_path_factory, program):
    assert judged(tmp_path_factory.mktemp("programs"), printed(*program)) == []


@pytest.mark.slow
def test_powers_of_rounded_numbers_are_those_of_floats(tmp_path):
    """Powers of integers would overflow, and raise where 0 has a negative one: what raises ends the process."""
    graph = Graph()
    a, b = (graph.input("q", i) for i in range(2))
    whole, other = graph.call("floor", a), graph.neg(graph.call("floor", b))
    both = graph.call("where", graph.call("lt", a, b), graph.add(whole, other), graph.call("min", whole, other))
    outputs = [graph.apply("pow", pair) for pair in ((a, whole), (whole, b), (whole, other), (b, both), (both, a))]
    text = printed(graph, outputs, None)
    assert judged(tmp_path, text) == []
    function = load_module(written(tmp_path / "powers", text)).f
    for values in ((2.5, 3.25), (0.0, 1.5), (0.5, -0.5), (-1.5, 2.0), (0.0, 0.0), (1e10, 5.5)):
        y, out = np.zeros(INPUTS), np.zeros(OUTPUTS)
        y[:2] = values
        function(y, out)
        n, m = np.floor(y[0]), -np.floor(y[1])
        k = n + m if y[0] < y[1] else min(n, m)
        with np.errstate(all="ignore"):
            expected = np.power([y[0], n, n, y[1], k], [n, y[1], m, k, y[0]])
        np.testing.assert_allclose(out[: len(expected)], expected, rtol=1e-14)


@pytest.mark.slow
def test_each_operation_alone(tmp_path):
    graph, outputs = Graph(), []
    a, b, c = (graph.input("q", i) for i in range(3))
    truth = graph.call("lt", a, b)
    for name in ALL:
        if name in (*COMPARISONS, "and", "or", "not"):
            arguments = (a, b) if name in COMPARISONS else (truth, graph.call("ge", b, c))[: 1 if name == "not" else 2]
            outputs.append(graph.call("where", graph.call(name, *arguments), c, graph.neg(a)))
        elif name == "where":
            outputs.append(graph.call(name, truth, graph.mul(a, b), c))
        else:
            arguments = (a,) if name in UNARY or ":" in name else (a, b)
            outputs.append(graph.apply(name, arguments) if ":" not in name else graph.call(name, *arguments))
    assert judged(tmp_path, printed(graph, outputs, truth)) == []


@pytest.mark.slow
def test_sums_of_products(tmp_path):
    """A product that several sums want may go into any of them where something is contracted, which is not here."""
    products = " + ".join(f"y[{2 * i}]*y[{2 * i + 1}]" for i in range(6))
    text = f"""
def f(y, out):
    a = y[0]*y[1]
    b = y[2]*y[3]
    out[0] = a + b
    out[1] = a - b
    out[2] = b - a
    out[3] = -a*y[4] - b
    out[4] = {products}
    out[5] = 2.0*(y[0]*y[1]) + 2.0*(y[2]*y[3])
    out[6] = (y[0] + y[1])*(y[2] - y[3]) - y[4]*(y[5]*y[6])
    out[7] = y[3]*y[2] + y[1]*y[0]
    out[8] = 1.0/(y[0]*y[1] + y[2])
    out[9] = y[4]**2 + y[5]**3 - y[6]**5*y[7]**0
    return 0
"""
    assert judged(tmp_path, text) == []


@pytest.mark.slow
def test_loops_and_branches(tmp_path):
    text = """
def f(y, out):
    total, largest, place = 0.0, -1.0, -1
    for i in range(10):
        if y[i] > largest:
            largest, place = y[i], i
        elif not y[i] <= 0.0:
            continue
        total += y[i]*y[i + 1]
        if total > 1e9 or place == 7 and i != 3:
            break
    k = 9
    while k > 2 and y[k] < 0.5:
        k -= 2
        out[k + 1], out[k] = out[k], out[k + 1]
    for r in range(5, -1, -2):
        for c in range(r):
            out[r] += y[c] if c % 2 == 0 else -y[r]
    bits = 1
    if largest > 1.0:
        bits |= 2
    out[11] = total / (1 + place) + float(bits) - 1.0*(largest > total) + math.copysign(2.0, y[0])
    out[12] = max(total, y[1], y[2]) + min(3, y[3])
    out[13] = math.sqrt(abs(y[5])) if bits & 2 == 2 else math.inf
    return bits * 10 + int(y[1] > y[2]) + abs(place - 5) + place // 3
"""
    assert judged(tmp_path, text) == []

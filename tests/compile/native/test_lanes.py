"""Functions over lanes made from their source: all of them are in the language, and they do what Python does."""

from __future__ import annotations

import re
from types import FunctionType

import numpy as np
import pytest
from support import golden

from symgen.base.ir.program import LANES
from symgen.compile.native.language import ArrayLength, Assign, Return
from symgen.compile.native.llvm import is_copied, llvm_module
from symgen.compile.native.machine import optimise_module
from symgen.compile.native.read import Foreign, read_function
from symgen.compile.store.emitted import EmittedFunction
from symgen.compile.store.loaded_modules import load_module

from .test_read import A, F, Source
from .twofold import ARRAY, NUMBER, apart, for_avx512, own_functions

LAWS = ("lagrange_lanes", "baumgarte_lanes", "direct_correction_lanes")


@pytest.fixture(scope="module")
def emitted(tmp_path_factory):
    """A folder with the modules of a mechanism in lanes."""
    modules = {stem: text for stem, text in golden.emitted("four-bar", False).items() if stem.endswith("_lanes")}
    return golden.written(modules, tmp_path_factory.mktemp("four_bar"))


def arguments(function) -> list[str]:
    code = getattr(function, "py_func", function).__code__
    return list(code.co_varnames[: code.co_argcount])


@pytest.mark.by_turns(3)
@pytest.mark.slow
@pytest.mark.parametrize("stem", LAWS)
def test_functions_over_lanes_do_what_python_does(stem, emitted):
    """One by one, from numbers of one size, by the interpreter and by vectors of the processor."""
    law, rng = load_module(emitted / f"{stem}.py"), np.random.default_rng(5)
    corrected = hasattr(law, "spread")
    for name in own_functions(law) if corrected else ("rhs", "accept"):
        function = getattr(law, name)
        before = rng.uniform(0.5, 1.5, law.NUMBERS * LANES)
        compiled = after(function, before)
        if not (corrected and name == "accept"):  # from such a state the correction ends where rounding says
            python = interpreted(function)
            expected = np.array(after(python, before.tolist()))
            # A lane that happens to stand near a singular state amplifies rounding: its bound is what it makes
            # of a disturbance a thousand times as large.
            disturbed = before * (1 + 1e-13 * rng.uniform(-1, 1, len(before)))
            change = np.abs(after(python, disturbed.tolist()) - expected).reshape(-1, LANES).max(axis=0)
            assert np.median(change) < 1e-9
            bound = 1e-11 * (1 + np.abs(expected)).reshape(-1, LANES) + change
            error = np.abs(compiled - expected).reshape(-1, LANES)
            assert np.all(error <= bound), (name, np.argwhere(error > bound), error.max())


def after(function, numbers):
    """The numbers in lanes after one call of the function."""
    z = numbers.copy()
    function(*({"t": 0.3, "z": z, "lanes": LANES}[x] for x in arguments(function)))
    return z


def interpreted(function, spaces=None):
    """A function over lanes, and all that it calls, as Python."""
    spaces, own = {} if spaces is None else spaces, function.py_func.__globals__
    if id(own) not in spaces:
        space = spaces[id(own)] = dict(own)
        space |= {k: interpreted(v, spaces) for k, v in own.items() if isinstance(v, EmittedFunction)}
    return FunctionType(function.py_func.__code__, spaces[id(own)])


@pytest.mark.slow
def test_what_is_no_call_is_copied(emitted):
    law = load_module(emitted / "direct_correction_lanes.py")
    f = law.accept.read((NUMBER, ARRAY))
    assert not f.inlined and not is_copied(f)
    blocks = {x.name: x for x in f.called}
    assert {"geometry", "measure", "spread"} <= {*blocks} and all(is_copied(x) for x in blocks.values())
    waiting, below = [blocks["geometry"]], {}
    while waiting:
        below |= {x.name: x for x in waiting[-1].called}
        waiting += waiting.pop().called
    assert all(below[name].inlined for name in ("sine", "cosine"))


@pytest.mark.slow
def test_loops_over_lanes_become_vectors(emitted):
    """Of all sums and products half at least: the others are what is left over where lanes do not fill vectors."""
    law = load_module(emitted / "lagrange_lanes.py")
    f = law.rhs.read((NUMBER, ARRAY))
    text = str(optimise_module(llvm_module(f, lambda x: x.name, lambda x: False)))
    found = re.findall(r"= f(?:add|sub|mul|div)\b[^<\n]*?(<\d+ x double>|double)", text)
    assert sum(x != "double" for x in found) >= len(found) / 2 > 50
    assert not re.search(r'call i32 @"?(sine|cosine|turned)', text)


@pytest.mark.slow
def test_functions_over_lanes_have_the_widest_registers(emitted):
    f = load_module(emitted / "lagrange_lanes.py").rhs.read((NUMBER, ARRAY))
    with for_avx512() as target:
        text = target.emit_assembly(optimise_module(llvm_module(f, lambda x: x.name, lambda x: False)))
    assert len(re.findall(r"v(?:mul|add|sub|fm)\w+pd\b.*zmm", text)) > 50


#: A function that returns two numbers, and is no call.
PAIR = "def pair(x, a):\n    n = x*a\n    n = n + 1.0\n    return n - x, n\n"


def of(line: str, text: str = PAIR):
    pair = Source(text, {"other": 3.0}, inlined=True)
    return read_function(Source(f"def f(x, z):\n    {line}\n    return 0\n", {"pair": pair}), (F, A))


def test_several_values_of_a_function_that_is_no_call():
    """Its statements stand in its place, under names of their own: `n` of the caller is another one."""
    f = of("n = 7.0; x, n = pair(x + n, 2.0); z[0] = n")
    assert {"n", "x", "pair.x", "pair.a", "pair.n"} <= {*f.variables} and {*f.variables.values()} == {"float"}
    assert not f.called and all(isinstance(s, Assign) for s in f.body[:-2])


@pytest.mark.parametrize(
    ("line", "text"),
    [
        ("a, b = pair(x)", PAIR),
        ("a, b, c = pair(x, x)", PAIR),
        ("c = a, b = pair(x, x)", PAIR),
        ("a, b = pair(x, a=x)", PAIR),
        ("a, b = pair(x, x)", PAIR.replace("x*a", "x*other")),
        ("a, b = pair(x, x)", PAIR.replace("n - x, n", "n")),
        ("a, b = pair(x, x)", PAIR.replace("    n = x*a\n", "    if x > a:\n        n = x\n")),
        ("a, b = f(x, z)", PAIR),
        ("a = len(x)", PAIR),
        ("a = len(z, z)", PAIR),
        ("a = len(b)", PAIR),
    ],
)
def test_what_is_outside(line, text):
    with pytest.raises(Foreign):
        of(line, text)


def test_lengths_of_arguments():
    f = of("n = len(z) // 3")
    assert f.body[0].value.arguments[0] == ArrayLength("z") and isinstance(f.body[1], Return)


@pytest.mark.by_turns(2)
@pytest.mark.slow
@pytest.mark.parametrize(("model", "method"), [("pendulum", "direct-correction"), ("heavy-top", "lagrange")])
def test_lanes_are_those_of_numba(model, method):
    assert apart(model, method, "--lanes") == ""

"""Long straight functions in blocks: what they compute, what moves, and what stays where it is."""

import re
from collections import Counter

import numpy as np
import pytest

from symgen.compile.native import blocks, llvm, machine
from symgen.compile.store import emitted
from symgen.compile.store.loaded_modules import load_module

from .twofold import arguments_of, differences, load_twice, uncontracted, written

SYMBOL = "_ZN6symgen1fE"


@pytest.fixture(autouse=True)
def cache(tmp_path, monkeypatch):
    """A cache of its own for each test, since what is patched here is no part of an entry's key."""
    monkeypatch.setenv("SYMGEN_CACHE_DIR", str(tmp_path / "cache"))


def long_function(terms: int, seed: int = 0) -> str:
    """Return a straight function as an elimination gives it: products of what was computed lately, summed up."""
    rng = np.random.default_rng(seed)
    lines = [f"q{i} = y[{i}]" for i in range(30)]
    names = [f"q{i}" for i in range(30)]
    for i in range(terms):
        a, b, c, d = (names[-1 - int(k)] for k in rng.integers(0, min(len(names), 40), 4))
        e = f"q{rng.integers(30)}"
        form = ("{a}*{b} + {c}*{d}", "{a} - {b}*{e}", "0.5*{a} + 0.25*{b}", "{a}*{e}", "{a}/(2.0 + {b}*{b})")[i % 5]
        lines.append(f"s{i} = {form.format(a=a, b=b, c=c, d=d, e=e)}")
        names.append(f"s{i}")
    lines += [f"out[{i}] = s{terms - 1 - 3 * i}*q{i % 30} + s{terms - 2 - 3 * i}" for i in range(terms // 8)]
    return "def f(y, out):\n" + "".join(f"    {line}\n" for line in [*lines, "return 0"])


def optimised(folder, text: str) -> tuple[str, str]:
    """Return the text of a function behind the optimiser, and its symbol."""
    direct = load_module(written(folder, text)).f
    function = direct.read(arguments_of(direct))
    symbol = emitted._symbol(function)
    return str(machine.optimise_module(llvm.llvm_module(function, emitted._symbol, lambda called: True))), symbol


def block_lengths(text: str) -> list[int]:
    """Return how many instructions each block of the first function has."""
    body = text[text.index("define ") :].partition("\n}")[0].splitlines()[1:]
    lengths, count = [], 0
    for line in body:
        if line.startswith("  "):
            count += 1
        if re.match(r"[\w.]+:", line):
            lengths.append(count)
            count = 0
    return [*lengths[1:], count]


@pytest.mark.by_turns(4)
@pytest.mark.slow
@pytest.mark.parametrize("terms", [600, 1500])
def test_the_same_numbers_as_in_one_block(tmp_path, monkeypatch, terms):
    text = long_function(terms, terms)
    monkeypatch.setattr(machine, "LARGEST_BLOCK", 300)
    monkeypatch.setattr(blocks, "LENGTH", 200)
    called = []
    split = blocks.split_into_blocks
    monkeypatch.setattr(blocks, "split_into_blocks", lambda *a: called.append(split(*a)) or called[-1])
    direct, plain = load_twice(written(tmp_path / f"long{terms}", text))
    with uncontracted():
        assert differences(direct.f, plain.f, arguments_of(direct.f), terms, rounds=3) == []
    assert called and called[0] is not None and called[0].count("callbr") >= terms // 250


def test_short_functions_and_those_with_branches_stay_as_they_are(tmp_path):
    text, symbol = optimised(tmp_path / "short", long_function(100))
    assert blocks.split_into_blocks(text, symbol, 10_000) is None
    assert blocks.split_into_blocks(text, "_ZN6symgen5otherE", 10) is None
    branches = "def f(y, out):\n    if y[0] > 1.0:\n        out[0] = y[1]\n    out[1] = y[2]\n    return 0\n"
    text, symbol = optimised(tmp_path / "branches", branches)
    assert blocks.split_into_blocks(text, symbol, 1) is None


def test_blocks_are_about_as_long_as_asked_for_and_read_what_they_want(tmp_path, monkeypatch):
    monkeypatch.setattr(blocks, "LENGTH", 250)
    text, symbol = optimised(tmp_path / "blocks", long_function(2000))
    divided = blocks.split_into_blocks(text, symbol, 100)
    lengths = block_lengths(divided)
    assert len(lengths) > 8 and max(lengths) < 250 + 60 + 2 * 30  # a line with what it waits for, and all reads at once
    loads = re.findall(r"%(\.b\d+\.\S+) = load", divided)
    assert len(loads) == len(set(loads)) > 30, "inputs are read again in the blocks that want them"
    stores = divided.index("  store double")
    assert " = load " not in divided[stores : divided.index("\n}", stores)], "what was written might be what is read"


def test_a_block_may_end_where_the_function_does(tmp_path, monkeypatch):
    text, symbol = optimised(tmp_path / "ends", long_function(40))
    for length in range(10, 120):
        monkeypatch.setattr(blocks, "LENGTH", length)
        divided = blocks.split_into_blocks(text, symbol, 10)
        machine.llvm.parse_assembly(divided)


def test_a_product_stands_in_the_block_of_the_sum_that_wants_it(tmp_path, monkeypatch):
    monkeypatch.setattr(blocks, "LENGTH", 120)
    text, symbol = optimised(tmp_path / "products", long_function(1500, 3))
    divided = blocks.split_into_blocks(text, symbol, 100)
    names = re.compile(r"%[-\w.$]+")
    times = Counter(names.findall(divided))
    for block in re.split(r"\n(?=\.block)", divided.partition("\n}")[0]):
        defined = {line.split(" = ")[0].strip() for line in block.splitlines() if " = " in line}
        products = {line.split(" = ")[0].strip() for line in block.splitlines() if " = fmul" in line}
        used = [name for line in block.splitlines() for name in names.findall(line.partition(" = ")[2] or line)]
        alone = {p for p in products if times[p] == 2}
        assert alone <= set(used) and alone <= defined


def test_code_in_blocks_does_what_python_does(tmp_path, monkeypatch):
    monkeypatch.setattr(machine, "LARGEST_BLOCK", 100)
    function = load_module(written(tmp_path / "run", long_function(900, 7))).f
    out, expected = np.zeros((2, 900))
    assert function(np.linspace(0.1, 2.0, 900), out) == 0
    function.py_func(np.linspace(0.1, 2.0, 900), expected)
    np.testing.assert_allclose(out, expected, rtol=1e-9)

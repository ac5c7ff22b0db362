"""Emitted modules loaded twice: with functions compiled by symgen's own route, and with functions of Numba."""

import builtins
import os
import subprocess
import sys
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from types import ModuleType
from typing import Any
from unittest import mock

import llvmlite.binding as llvm
import numpy as np
from numba.core.dispatcher import Dispatcher

from symgen.compile.native import machine, types
from symgen.compile.native.compiler import COMPILER
from symgen.compile.store import emitted
from symgen.compile.store.emitted import EmittedFunction
from symgen.compile.store.loaded_modules import load_module

ARRAY, WHOLE, NUMBER = types.float64[::1], types.int64[::1], types.float64
TESTS = Path(__file__).parents[2]
#: Types of arguments by their names in emitted modules.
BY_NAME = {"t": NUMBER, "x": NUMBER, "iw": WHOLE, **dict.fromkeys(("y", "p", "w", "ydot", "out", "k", "r", "j"), ARRAY)}
#: Of functions that have one of these, the others are integers too, but for ``w``.
INTEGERS = dict.fromkeys(("step", "column", "section", "k"), types.int64)
#: What two right translations may differ by, of the largest number beside: nothing is contracted in either.
ROUNDING = 1e-12
#: Makes both compilers make code for a processor without fused multiply-add, if it is set when they start.
GENERIC = {"NUMBA_CPU_NAME": "generic"}

HEAD = "import math\n\nimport numpy as np\nfrom numba import njit\n\n"
#: Emitted functions may be contracted as well; Numba, which compiles for this processor, would choose other products.
DECORATOR = '@njit(error_model="numpy")\n'


def written(folder: Path, *functions: str, head: str = HEAD, name: str = "model") -> Path:
    """Write a module of decorated functions; return its path."""
    folder.mkdir(parents=True, exist_ok=True)
    path = folder / f"{name}.py"
    path.write_text(head + "\n\n".join(DECORATOR + text.strip("\n") + "\n" for text in functions), encoding="utf-8")
    return path


def by(compiler: str) -> Any:
    """Return a context in which a way of `symgen.compile.native.compiler` is used."""
    return mock.patch.dict(os.environ, {COMPILER: compiler})


@contextmanager
def for_avx512() -> Iterator[Any]:
    """See to it that texts are optimised inside for a processor with vectors of eight numbers; yield its compiler."""
    llvm.initialize_all_targets()
    llvm.initialize_all_asmprinters()
    triple, processor = "x86_64-unknown-linux-gnu", "icelake-server"
    target = llvm.Target.from_triple(triple).create_target_machine(cpu=processor, opt=3)
    with (
        mock.patch.object(machine, "_host_processor", lambda: (triple, processor, "")),
        mock.patch.object(machine, "_best_machine", lambda: target),
    ):
        yield target


@contextmanager
def uncontracted() -> Iterator[None]:
    """See to it that machine code made inside is for a processor without fused multiply-add."""
    known = machine._host_processor, machine.processor_features, machine._best_machine
    for each in known:
        each.cache_clear()
    with mock.patch.dict(os.environ, GENERIC):
        yield
    for each in known:
        each.cache_clear()


def load_twice(path: Path) -> tuple[ModuleType, ModuleType]:
    """Return a module with functions compiled here, and one with functions compiled by Numba."""
    direct = load_module(path)
    with mock.patch.object(emitted, "import_library", builtins.__import__):
        return direct, load_module(path, f"by_numba.{path.parent.name.replace('.', '_')}.{path.stem}")


def arguments_of(function: Any) -> tuple[types.Kind, ...]:
    """Return the types of a function's arguments, told by their names."""
    code = function.py_func.__code__
    names = code.co_varnames[: code.co_argcount]
    known = BY_NAME | (INTEGERS if {"step", "column", "section"} & set(names) else {})
    return tuple(known[name] for name in names)


def own_functions(module: ModuleType) -> list[str]:
    """Return the names of the functions that a module defines."""
    found = ((name, getattr(value, "py_func", None)) for name, value in vars(module).items())
    return [name for name, function in found if function is not None and function.__module__ == module.__name__]


def states(rng: np.random.Generator, size: int) -> Iterator[np.ndarray]:
    """Give numbers of many kinds: small and large, zeros of both signs, whole ones, infinities and NaN among others."""
    for spoil in range(8):
        numbers = rng.standard_normal(size) * 10.0 ** rng.integers(-3, 3)
        some = rng.random(size)
        if spoil == 1:
            numbers[some < 0.2] = 0.0
        elif spoil == 2:
            numbers[some < 0.3] = -0.0
        elif spoil == 3:
            numbers[some < 0.02] = np.nan
        elif spoil == 4:
            numbers[some < 0.02] = np.inf
        elif spoil == 5:
            numbers[some < 0.02] = -np.inf
        elif spoil == 6:
            numbers = np.round(rng.standard_normal(size))
        elif spoil == 7:
            numbers *= 10.0 ** rng.integers(-160, 160, size)
        yield numbers


def same(one: Any, other: Any) -> bool:
    """Whether numbers are the same to rounding: NaN where the other is NaN, and infinite where it is infinite.

    The magnitude that rounding is a share of is that of the largest finite number: what cancels was as large.
    """
    one, other = np.atleast_1d(np.asarray(one, float)), np.atleast_1d(np.asarray(other, float))
    finite = np.isfinite(one)
    if not np.array_equal(one[~finite], other[~finite], equal_nan=True) or not np.isfinite(other[finite]).all():
        return False
    scale = np.abs([one[finite], other[finite]]).max(initial=0.0)
    with np.errstate(over="ignore"):
        return bool(np.all(np.abs(one[finite] - other[finite]) <= ROUNDING * scale))


def differences(
    direct: Any, plain: Any, arguments: Sequence[types.Kind], size: int, rounds: int = 2, compiler: str = "libm"
) -> list[str]:
    """Call a function compiled here and the same compiled by Numba; say where they differ.

    Parameters
    ----------
    direct, plain : function
        The two.
    arguments : sequence
        Types of the arguments.
    size : int
        Length of arrays of floats.
    rounds : int
        How often all kinds of numbers are tried.
    compiler : str
        The word for the compiler; sines are the C library's by default, as Numba's are.
    """
    assert isinstance(direct, EmittedFunction) and isinstance(plain, Dispatcher), "one of each compiler"
    rng = np.random.default_rng(size)
    with by(compiler):
        one = direct.caller(tuple(arguments))
    found: list[str] = []
    for round_ in range(rounds):
        for number in states(rng, size):
            values: list[Any] = []
            for kind in arguments:
                if kind == ARRAY:
                    values.append(np.roll(number, int(rng.integers(size))).copy())
                elif kind == WHOLE:
                    values.append(rng.integers(0, 3, 16))
                else:
                    values.append(float(number[0]) if kind == NUMBER else round_)
            mine, yours = ([v.copy() if isinstance(v, np.ndarray) else v for v in values] for _ in range(2))
            answers = one(*mine), plain(*yours)
            pairs = [answers, *zip(mine, yours, strict=True)]
            found += [f"{direct.__name__}: argument {i - 1}" for i, (a, b) in enumerate(pairs) if not same(a, b)]
    return found


def apart(*words: str) -> str:
    """Return what `compile.native.judge` says in a process where nothing can be contracted."""
    return process("compile.native.judge", *words, **GENERIC).stdout.strip()


def process(module: str, *words: str, **environment: str) -> subprocess.CompletedProcess[str]:
    """Run a module of the tests with these variables in its environment."""
    path = os.pathsep.join(filter(None, (str(TESTS), str(TESTS.parent), os.environ.get("PYTHONPATH"))))
    command = [sys.executable, "-m", module, *words]
    given = {**os.environ, "PYTHONPATH": path, **environment}
    done = subprocess.run(command, cwd=TESTS, env=given, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr[-3000:]
    return done

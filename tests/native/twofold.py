"""Emitted modules loaded twice: with functions made from their source, and with functions compiled by Numba."""

from __future__ import annotations

import ctypes
import os
import subprocess
import sys
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from types import ModuleType
from typing import Any
from unittest import mock

import numpy as np
from numba import types

from symgen.native.library import Library
from symgen.store.emitted import COMPILER
from symgen.store.modules import load_module

ARRAY, WHOLE, NUMBER = types.float64[::1], types.int64[::1], types.float64
TESTS = Path(__file__).parents[1]
#: Types of arguments by their names in emitted modules.
BY_NAME = {"t": NUMBER, "x": NUMBER, "iw": WHOLE, **dict.fromkeys(("y", "p", "w", "ydot", "out", "k", "r", "j"), ARRAY)}
#: Of functions that have one of these, the others are integers too, but for ``w``.
INTEGERS = dict.fromkeys(("step", "column", "section", "k"), types.int64)

HEAD = "import math\n\nimport numpy as np\nfrom numba import njit\n\n"
DECORATOR = '@njit(error_model="numpy", fastmath={"contract"})\n'


def written(folder: Path, *functions: str, head: str = HEAD, name: str = "model") -> Path:
    """Write a module of decorated functions; return its path."""
    folder.mkdir(parents=True, exist_ok=True)
    path = folder / f"{name}.py"
    path.write_text(head + "\n\n".join(DECORATOR + text.strip("\n") + "\n" for text in functions), encoding="utf-8")
    return path


@contextmanager
def by_numba() -> Iterator[None]:
    """See to it that modules loaded inside are compiled by Numba."""
    with mock.patch.dict(os.environ, {COMPILER: "numba"}):
        yield


def load_twice(path: Path) -> tuple[ModuleType, ModuleType]:
    """Return a module with functions made from their source, and one with functions compiled by Numba.

    Sines are the C library's in both; those that are taken together are judged by `test_sines`.
    """
    with mock.patch.dict(os.environ, {COMPILER: "libm"}):
        direct = load_module(path)
    with by_numba():
        return direct, load_module(path, f"by_numba.{path.parent.name.replace('.', '_')}.{path.stem}")


def arguments_of(function: Any) -> tuple[Any, ...]:
    """Return the types of a function's arguments, told by their names."""
    code = function.py_func.__code__
    names = code.co_varnames[: code.co_argcount]
    known = BY_NAME | (INTEGERS if {"step", "column", "section"} & set(names) else {})
    return tuple(known[name] for name in names)


def own_functions(module: ModuleType) -> list[str]:
    """Return the names of the functions that a module defines."""
    found = ((name, getattr(value, "py_func", None)) for name, value in vars(module).items())
    return [name for name, function in found if function is not None and function.__module__ == module.__name__]


def machine_code(function: Any, arguments: tuple[Any, ...]) -> tuple[Any, bool]:
    """Return a function as ctypes calls it, in Numba's convention, and whether it was made from its source."""
    function.compile(arguments)
    result = function.overloads[arguments]
    address = result.library.get_pointer_to_function(result.fndesc.llvm_func_name)
    returned = ctypes.c_double if result.signature.return_type == NUMBER else ctypes.c_int64
    prototype: list[Any] = [ctypes.c_void_p, ctypes.c_void_p]
    for kind in arguments:
        if isinstance(kind, types.Array):
            prototype += [ctypes.c_void_p] * 2 + [ctypes.c_int64] * 2 + [ctypes.c_void_p] + [ctypes.c_int64] * 2
        else:
            prototype.append(ctypes.c_double if kind == NUMBER else ctypes.c_int64)
    entry = ctypes.CFUNCTYPE(ctypes.c_int32, *prototype)(address)

    def call(*values: Any) -> Any:
        passed: list[Any] = []
        for value in values:
            if isinstance(value, np.ndarray):
                passed += [None, None, value.size, 8, value.ctypes.data, value.size, 8]
            else:
                passed.append(value)
        answer = returned()
        assert entry(ctypes.addressof(answer), None, *passed) == 0
        return answer.value

    return call, isinstance(result.library, Library)


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
            numbers = np.round(numbers)
        elif spoil == 7:
            numbers *= 10.0 ** rng.integers(-160, 160, size)
        yield numbers


def same(one: Any, other: Any) -> bool:
    """Whether numbers are the same to the last bit; a NaN is any other NaN, whose sign nothing rests on."""
    one, other = np.asarray(one, float), np.asarray(other, float)
    nan = np.isnan(one)
    return bool(np.array_equal(nan, np.isnan(other)) and one[~nan].tobytes() == other[~nan].tobytes())


def differences(direct: Any, plain: Any, arguments: Sequence[Any], size: int, rounds: int = 2) -> list[str]:
    """Call a function made from its source and the same compiled by Numba; say where they differ.

    Parameters
    ----------
    direct, plain : Dispatcher
        The two.
    arguments : sequence
        Numba's types of the arguments.
    size : int
        Length of arrays of floats.
    rounds : int
        How often all kinds of numbers are tried.
    """
    rng = np.random.default_rng(size)
    one, from_source = machine_code(direct, tuple(arguments))
    other, again = machine_code(plain, tuple(arguments))
    found = [] if from_source and not again else [f"{direct.__name__} was not made from its source"]
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
            answers = one(*mine), other(*yours)
            pairs = [answers, *zip(mine, yours, strict=True)]
            found += [f"{direct.__name__}: argument {i - 1}" for i, (a, b) in enumerate(pairs) if not same(a, b)]
    return found


def apart(*words: str) -> str:
    """Return what `native.judge` says in a process where nothing can be contracted; see `test_judge`."""
    return process("native.judge", *words).stdout.strip()


def process(module: str, *words: str, **environment: str) -> subprocess.CompletedProcess[str]:
    """Run a module of the tests where nothing can be contracted, with these variables in its environment."""
    path = os.pathsep.join(filter(None, (str(TESTS), os.environ.get("PYTHONPATH"))))
    given = {**os.environ, "NUMBA_CPU_NAME": "generic", "PYTHONPATH": path, **environment}
    command = [sys.executable, "-m", module, *words]
    done = subprocess.run(command, cwd=TESTS, env=given, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr[-3000:]
    return done

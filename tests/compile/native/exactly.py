"""Emitted functions in 50 digits: the same statements and literals, on numbers of mpmath."""

import functools
import math
from types import FunctionType
from typing import Any
from unittest import mock

import mpmath
import numpy as np

from symgen.compile.store.emitted import EmittedFunction

DIGITS = 50


class _Functions:
    """The functions of `math` that emitted code calls."""

    inf, pi, nan = mpmath.mpf("inf"), mpmath.mpf(math.pi), mpmath.mpf("nan")
    fabs = staticmethod(abs)
    isfinite = staticmethod(mpmath.isfinite)
    floor, ceil = (staticmethod(lambda x, f=f: int(f(x))) for f in (mpmath.floor, mpmath.ceil))

    @staticmethod
    def copysign(a: Any, b: Any) -> Any:
        return abs(a) if b >= 0 else -abs(a)

    @staticmethod
    def pow(a: Any, b: Any) -> Any:
        return mpmath.mpf(a) ** b

    def __getattr__(self, name: str) -> Any:
        return getattr(mpmath, name)


_divided = mpmath.mpf.__truediv__


def _quotient(a: Any, b: Any) -> Any:
    """Return a quotient; by zero as in NumPy."""
    if b == 0:
        return mpmath.mpf("nan") if a == 0 else mpmath.sign(a) * mpmath.inf
    return _divided(a, b)


@functools.cache
def exactly(function: EmittedFunction) -> FunctionType:
    """Return an emitted function, and all that it calls, on numbers of mpmath."""
    own = dict[str, Any]()
    for name, value in function.py_func.__globals__.items():
        if isinstance(value, EmittedFunction):
            own[name] = functools.partial(lambda f, *values: exactly(f)(*values), value)
        else:
            own[name] = _Functions() if value is math else value
    return FunctionType(function.py_func.__code__, own, function.__name__)


def numbers(array: np.ndarray) -> list[Any]:
    """Return an array as a list of exact numbers; whole numbers stay what they are."""
    return [int(x) for x in array] if array.dtype.kind == "i" else [mpmath.mpf(float(x)) for x in array]


def derivative(
    function: EmittedFunction, arguments: tuple[Any, ...], change: dict[int, np.ndarray]
) -> list[np.ndarray]:
    """Return derivatives of all arrays of a function after its call, by central differences in 50 digits.

    Parameters
    ----------
    arguments : tuple
        Numbers and arrays.
    change : dict of int to array
        Rates of arrays of floats, by position among the arguments.
    """
    with mpmath.workdps(DIGITS), mock.patch.object(mpmath.mpf, "__truediv__", _quotient):
        h, ends = mpmath.mpf(10) ** -20, []
        for sign in (1, -1):
            taken = [numbers(a) if isinstance(a, np.ndarray) else mpmath.mpf(a) for a in arguments]
            for place, rate in change.items():
                taken[place] = [x + sign * h * mpmath.mpf(float(d)) for x, d in zip(taken[place], rate, strict=True)]
            exactly(function)(*taken)
            ends.append(taken)
        return [
            np.array([float((x - y) / (2 * h)) for x, y in zip(*pair, strict=True)])
            if isinstance(pair[0], list)
            else None
            for pair in zip(*ends, strict=True)
        ]

"""Numbers with their first and second derivative with respect to one variable."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

NAN = math.nan


@dataclass(frozen=True, slots=True)
class Series:
    """A value with its first and second derivative."""

    value: float
    first: float = 0.0
    second: float = 0.0

    def through(self, f: float, slope: float, bend: float) -> Series:
        """Return a function of this number, from the function's value and derivatives there."""
        return Series(f, slope * self.first, slope * self.second + bend * self.first**2)

    def __add__(self, other: Number) -> Series:
        o = lift(other)
        return Series(self.value + o.value, self.first + o.first, self.second + o.second)

    def __sub__(self, other: Number) -> Series:
        return self + (-lift(other))

    def __rsub__(self, other: Number) -> Series:
        return lift(other) - self

    def __neg__(self) -> Series:
        return Series(-self.value, -self.first, -self.second)

    def __mul__(self, other: Number) -> Series:
        o = lift(other)
        return Series(
            self.value * o.value,
            self.first * o.value + self.value * o.first,
            self.second * o.value + 2.0 * self.first * o.first + self.value * o.second,
        )

    def __truediv__(self, other: Number) -> Series:
        o = lift(other)
        x = divided(1.0, o.value)
        return self * o.through(x, -x * x, 2.0 * x**3)

    def __rtruediv__(self, other: Number) -> Series:
        return lift(other) / self

    __radd__ = __add__
    __rmul__ = __mul__


Number = float | Series


def lift(x: Number) -> Series:
    """Return a number as a series; a plain one is a constant."""
    return x if isinstance(x, Series) else Series(float(x))


def plain(x: Number) -> float:
    """Return the value of a number."""
    return x.value if isinstance(x, Series) else x


def divided(a: float, b: float) -> float:
    """Return a / b as floating-point arithmetic has it: nothing is raised."""
    if b != 0.0:
        return a / b
    return NAN if a == 0.0 or math.isnan(a) else math.copysign(math.inf, a) * math.copysign(1.0, b)


def quiet(f: Callable[..., float], *arguments: float) -> float:
    """Return a function's value, nan where it has none and infinity where it is too large."""
    try:
        result = f(*arguments)
    except ValueError:
        return NAN
    except OverflowError:
        return math.inf
    return NAN if isinstance(result, complex) else result


def power(a: Number, b: Number) -> Number:
    """Return a to the power b."""
    if not isinstance(a, Series) and not isinstance(b, Series):
        return divided(1.0, 0.0) if a == 0.0 and b < 0.0 else quiet(lambda x, y: x**y, a, b)
    base, exponent = lift(a), lift(b)
    if exponent.first == exponent.second == 0.0:
        n, x = exponent.value, base.value

        def term(factor: float, k: float) -> float:
            return 0.0 if factor == 0.0 else factor * plain(power(x, k))

        return base.through(plain(power(x, n)), term(n, n - 1.0), term(n * (n - 1.0), n - 2.0))
    return called("exp", [exponent * called("log", [base])])


def _sign(x: float) -> float:
    return NAN if math.isnan(x) else float(x > 0) - float(x < 0)


def _tanh(x: float) -> tuple[float, float, float]:
    t = math.tanh(x)
    return t, 1.0 - t * t, -2.0 * t * (1.0 - t * t)


def _of_sqrt(x: float) -> tuple[float, float, float]:
    r = quiet(math.sqrt, x)
    return r, divided(0.5, r), divided(-0.25, r * x)


def _of_log(x: float) -> tuple[float, float, float]:
    return (-math.inf if x == 0.0 else quiet(math.log, x)), divided(1.0, x), divided(-1.0, x * x)


def _of_tan(x: float) -> tuple[float, float, float]:
    t = math.tan(x)
    return t, 1.0 + t * t, 2.0 * t * (1.0 + t * t)


def _of_asin(x: float) -> tuple[float, float, float]:
    s = divided(1.0, quiet(math.sqrt, 1.0 - x * x))
    return quiet(math.asin, x), s, x * s**3


def _of_acos(x: float) -> tuple[float, float, float]:
    value, slope, bend = _of_asin(x)
    return math.pi / 2 - value if not math.isnan(value) else value, -slope, -bend


def _of_asinh(x: float) -> tuple[float, float, float]:
    s = 1.0 / math.hypot(1.0, x)
    return math.asinh(x), s, -x * s**3


def _of_acosh(x: float) -> tuple[float, float, float]:
    s = divided(1.0, quiet(math.sqrt, x - 1.0) * quiet(math.sqrt, x + 1.0))
    return quiet(math.acosh, x), s, -x * s**3


def _of_atanh(x: float) -> tuple[float, float, float]:
    s = divided(1.0, (1.0 - x) * (1.0 + x))
    return quiet(math.atanh, x), s, 2.0 * x * s * s


#: Name of a function -> its value and first two derivatives at a number.
UNARY: dict[str, Callable[[float], tuple[float, float, float]]] = {
    "sqrt": _of_sqrt,
    "exp": lambda x: (quiet(math.exp, x),) * 3,
    "log": _of_log,
    "sin": lambda x: (quiet(math.sin, x), quiet(math.cos, x), -quiet(math.sin, x)),
    "cos": lambda x: (quiet(math.cos, x), -quiet(math.sin, x), -quiet(math.cos, x)),
    "tan": _of_tan,
    "asin": _of_asin,
    "acos": _of_acos,
    "atan": lambda x: (math.atan(x), 1.0 / (1.0 + x * x), -2.0 * x / (1.0 + x * x) ** 2),
    "sinh": lambda x: (quiet(math.sinh, x), quiet(math.cosh, x), quiet(math.sinh, x)),
    "cosh": lambda x: (quiet(math.cosh, x), quiet(math.sinh, x), quiet(math.cosh, x)),
    "tanh": _tanh,
    **{"asinh": _of_asinh, "acosh": _of_acosh, "atanh": _of_atanh},
    "abs": lambda x: (abs(x), _sign(x), 0.0),
    "sign": lambda x: (_sign(x), 0.0, 0.0),
}


def called(name: str, arguments: list[Number]) -> Number:
    """Return the value of a function of formulas, with derivatives where an argument has them."""
    if name in UNARY:
        x = arguments[0]
        result = UNARY[name](plain(x))
        return x.through(*result) if isinstance(x, Series) else result[0]
    if name == "atan2":
        return _atan2(arguments[0], arguments[1])
    # nan goes through: a comparison with it is never true
    best = arguments[0]
    for x in arguments[1:]:
        a, b = plain(x), plain(best)
        if math.isnan(b):
            return best
        if math.isnan(a) or (a < b if name == "min" else a > b):
            best = x
    return best


def _atan2(y: Number, x: Number) -> Number:
    if not isinstance(y, Series) and not isinstance(x, Series):
        return math.atan2(y, x)
    a, b = lift(y), lift(x)
    square = a * a + b * b
    rate = divided(b.value * a.first - a.value * b.first, square.value)
    bend = divided(b.value * a.second - a.value * b.second - rate * square.first, square.value)
    return Series(math.atan2(a.value, b.value), rate, bend)

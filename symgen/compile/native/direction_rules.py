"""Rules of directions: each operation on floats with the directions of its result, for all that print them.

Rules for elementary functions are the slopes in `symgen.base.vocabulary.elementary_functions`. At a kink of ``abs``,
``min`` or ``max`` the directions belong to the branch taken.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable
from typing import Any, Generic, TypeVar

from symgen.base.vocabulary.elementary_functions import ELEMENTARY, nonzero_divisor
from symgen.compile.native import language as lang
from symgen.compile.native.read_values import Foreign

V = TypeVar("V")


class DirectionRules(ABC, Generic[V]):
    """Prints operations with directions, which are None where they are 0.

    Subclasses say what a number is: a name in a text for LLVM, or an expression.
    """

    @property
    @abstractmethod
    def numbers(self) -> Any:
        """Operations on numbers, under the names that slopes of elementary functions use on a graph."""

    @abstractmethod
    def print_dual(self, e: lang.Expression) -> tuple[V, V | None]:
        """Print the instructions of a float and return it with its directions."""

    @abstractmethod
    def print_plain(self, e: lang.ScalarOperation) -> V:
        """Print an operation without directions."""

    @abstractmethod
    def print_whole_power(self, base: V, exponent: int) -> V:
        """Print a power with a whole exponent."""

    @abstractmethod
    def print_sines(self, angle: lang.Expression, value: V) -> tuple[V, V]:
        """Print sine and cosine of an angle."""

    @abstractmethod
    def add_printed(self, a: V, b: V) -> V:
        """Print the sum of directions."""

    @abstractmethod
    def subtract_printed(self, a: V | None, b: V) -> V:
        """Print the difference of directions, or the opposite of some."""

    @abstractmethod
    def scale_printed(self, directions: V, factor: V) -> V:
        """Print the product of directions and a number."""

    @abstractmethod
    def differentiate_extreme(self, name: str, a: V, b: V, da: V | None, db: V | None) -> tuple[V, V | None]:
        """Print the least or greatest of two values; as in Python, the first where they do not compare."""

    def differentiate_operation(self, e: lang.ScalarOperation) -> tuple[V, V | None]:
        """Print an operation by its rule."""
        name, g = e.name.removeprefix("math."), self.numbers
        if any(a.type != "float" for a in e.arguments):
            return self.power(e) if name == "pow" else (self.print_plain(e), None)
        if name in ("sin", "cos"):
            return self.differentiate_sine(name, e.arguments[0])
        (a, da), *others = [self.print_dual(argument) for argument in e.arguments]
        b, db = others[0] if others else (a, None)
        if name in ("add", "sub", "mul", "div", "neg"):
            return self.differentiate_arithmetic(name, a, b, da, db)
        if name in ("min", "max"):
            return self.differentiate_extreme(name, a, b, da, db)
        if name in ("abs", "fabs"):
            return g.call("fabs", a), self.scale_directions(da, lambda: g.call("copysign", g.one, a))
        if name == "copysign":
            return g.call(name, a, b), self.scale_directions(da, lambda: g.call(name, g.one, g.mul(a, b)))
        if name == "atan2":
            square = nonzero_divisor(g, g.add(g.mul(a, a), g.mul(b, b)), 1e-200)
            one, other = (
                self.scale_directions(da, lambda: g.div(b, square)),
                self.scale_directions(db, lambda: g.div(a, square)),
            )
            return g.call(name, a, b), self.subtract_directions(one, other)
        if name == "pow":
            return self.differentiate_power(e, (a, da), (b, db))
        if name not in ELEMENTARY:
            raise Foreign(f"directions of the function '{name}'")
        slope: Any = ELEMENTARY[name].slope
        result = g.call(name, a)
        return result, self.scale_directions(da, lambda: slope(g, a, result))

    def differentiate_arithmetic(self, name: str, a: V, b: V, da: V | None, db: V | None) -> tuple[V, V | None]:
        """Print a sum, a product or a quotient."""
        g = self.numbers
        if name == "add":
            return g.add(a, b), self.add_directions(da, db)
        if name == "sub":
            return g.sub(a, b), self.subtract_directions(da, db)
        if name == "mul":
            return g.mul(a, b), self.add_directions(
                self.scale_directions(da, lambda: b), self.scale_directions(db, lambda: a)
            )
        if name == "neg":
            return g.neg(a), self.subtract_directions(None, da)
        quotient = g.div(a, b)
        inner = self.subtract_directions(da, self.scale_directions(db, lambda: quotient))
        return quotient, self.scale_directions(inner, lambda: g.div(g.one, b))

    def power(self, e: lang.ScalarOperation) -> tuple[V, V | None]:
        """Print a power with a whole exponent."""
        exponent = e.arguments[1]
        assert isinstance(exponent, lang.Constant), "a power with a literal exponent"
        n, (base, directions), g = int(exponent.value), self.print_dual(e.arguments[0]), self.numbers
        if n == 0:
            return g.one, None
        lower = self.print_whole_power(base, n - 1)
        return g.mul(lower, base), self.scale_directions(directions, lambda: g.mul(g.constant(float(n)), lower))

    def differentiate_power(
        self, e: lang.ScalarOperation, base: tuple[V, V | None], exponent: tuple[V, V | None]
    ) -> tuple[V, V | None]:
        """Print a power with any exponent; at 0 raised to less than 1 its slope rises without bound."""
        g, (a, da), (b, db), constant = self.numbers, base, exponent, e.arguments[1]
        value = g.call("pow", a, b)
        if isinstance(constant, lang.Constant) and 0.0 < constant.value < 1.0:
            rest = g.constant(1.0 - constant.value)
            return value, self.scale_directions(da, lambda: g.div(b, nonzero_divisor(g, g.call("pow", a, rest))))
        positive = a if isinstance(constant, lang.Constant) else nonzero_divisor(g, a)
        one = self.scale_directions(da, lambda: g.mul(b, g.call("pow", positive, g.sub(b, g.one))))
        return value, self.add_directions(one, self.scale_directions(db, lambda: g.mul(value, g.call("log", positive))))

    def differentiate_sine(self, name: str, angle: lang.Expression) -> tuple[V, V | None]:
        """Print a sine or cosine; the other one is its slope."""
        a, da = self.print_dual(angle)
        sine, cosine = self.print_sines(angle, a)
        if name == "sin":
            return sine, self.scale_directions(da, lambda: cosine)
        return cosine, self.scale_directions(da, lambda: self.numbers.neg(sine))

    # -- directions

    def add_directions(self, a: V | None, b: V | None) -> V | None:
        """Print the sum of directions."""
        if a is None or b is None:
            return b if a is None else a
        return self.add_printed(a, b)

    def subtract_directions(self, a: V | None, b: V | None) -> V | None:
        """Print the difference of directions."""
        return a if b is None else self.subtract_printed(a, b)

    def scale_directions(self, directions: V | None, factor: Callable[[], V]) -> V | None:
        """Print the product of directions and a number, which is only printed where directions exist."""
        return None if directions is None else self.scale_printed(directions, factor())

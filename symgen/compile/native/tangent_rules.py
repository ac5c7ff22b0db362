"""Rules of directions in text for LLVM: each operation on floats with the directions of its result.

Rules for elementary functions are the slopes in `symgen.base.vocabulary.elementary_functions`. At a kink of ``abs``,
``min`` or ``max`` the directions belong to the branch taken.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable
from typing import Any

from symgen.base.vocabulary.elementary_functions import ELEMENTARY
from symgen.compile.native import language as lang
from symgen.compile.native import sines
from symgen.compile.native.llvm import LlvmPrinter
from symgen.compile.native.llvm_values import float_literal
from symgen.compile.native.printed_numbers import PrintedNumbers, nonzero_divisor_text
from symgen.compile.native.read_values import Foreign

#: A float and its directions, None where these are 0.
Dual = tuple[str, str | None]


class TangentRules(LlvmPrinter, ABC):
    """Prints operations with directions.

    Attributes
    ----------
    lanes, kind : int, str
        Number of directions, and the type of their vector.
    printed : dict
        Values of the present block.
    """

    lanes: int
    kind: str
    printed: dict[tuple[str, ...], str]

    @abstractmethod
    def print_dual(self, e: lang.Expression) -> Dual:
        """Print the instructions of a float and return it with its directions."""

    def differentiate_operation(self, e: lang.ScalarOperation) -> Dual:
        """Print an operation by its rule."""
        name, g = e.name.removeprefix("math."), PrintedNumbers(self)
        if any(a.type != "float" for a in e.arguments):
            return self.power(e) if name == "pow" else (super().value(e), None)
        if name in ("sin", "cos"):
            return self.differentiate_sine(name, e.arguments[0])
        (a, da), *others = [self.print_dual(argument) for argument in e.arguments]
        b, db = others[0] if others else ("", None)
        if name in ("add", "sub", "mul", "div", "neg"):
            return self.differentiate_arithmetic(name, a, b, da, db)
        if name in ("min", "max"):
            return self.differentiate_extreme(name, a, b, da, db)
        if name in ("abs", "fabs"):
            return g.call("fabs", a), self.scale_directions(da, lambda: g.call("copysign", g.one, a))
        if name == "copysign":
            return g.call(name, a, b), self.scale_directions(da, lambda: g.call(name, g.one, g.mul(a, b)))
        if name == "atan2":
            square = nonzero_divisor_text(g, g.add(g.mul(a, a), g.mul(b, b)), 1e-200)
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
        return result, self.scale_directions(da, lambda: str(slope(g, a, result)))

    def differentiate_arithmetic(self, name: str, a: str, b: str, da: str | None, db: str | None) -> Dual:
        """Print a sum, a product or a quotient."""
        g = PrintedNumbers(self)
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

    def differentiate_extreme(self, name: str, a: str, b: str, da: str | None, db: str | None) -> Dual:
        """Print the least or greatest of two values; as in Python, the first where they do not compare."""
        sign = "olt" if name == "min" else "ogt"
        test = self.print_instruction(f"fcmp{self.flag} {sign} double {b}, {a}")
        value = self.print_instruction(f"select i1 {test}, double {b}, double {a}")
        if da is None and db is None:
            return value, None
        return value, self.print_instruction(
            f"select i1 {test}, {self.kind} {full_directions(db)}, {self.kind} {full_directions(da)}"
        )

    def power(self, e: lang.ScalarOperation) -> Dual:
        """Print a power with a whole exponent."""
        exponent = e.arguments[1]
        assert isinstance(exponent, lang.Constant), "a power with a literal exponent"
        n, (base, directions) = int(exponent.value), self.print_dual(e.arguments[0])
        if n == 0:
            return float_literal(1.0), None
        g, lower = PrintedNumbers(self), self.print_whole_power(base, n - 1)
        return g.mul(lower, base), self.scale_directions(directions, lambda: g.mul(float_literal(float(n)), lower))

    def differentiate_power(self, e: lang.ScalarOperation, base: Dual, exponent: Dual) -> Dual:
        """Print a power with any exponent; at 0 raised to less than 1 its slope rises without bound."""
        g, (a, da), (b, db), constant = PrintedNumbers(self), base, exponent, e.arguments[1]
        value = g.call("pow", a, b)
        if isinstance(constant, lang.Constant) and 0.0 < constant.value < 1.0:
            rest = float_literal(1.0 - constant.value)
            return value, self.scale_directions(da, lambda: g.div(b, nonzero_divisor_text(g, g.call("pow", a, rest))))
        positive = a if isinstance(constant, lang.Constant) else nonzero_divisor_text(g, a)
        one = self.scale_directions(da, lambda: g.mul(b, g.call("pow", positive, g.sub(b, g.one))))
        return value, self.add_directions(one, self.scale_directions(db, lambda: g.mul(value, g.call("log", positive))))

    def differentiate_sine(self, name: str, angle: lang.Expression) -> Dual:
        """Print a sine or cosine; the other one is its slope."""
        g, (a, da) = PrintedNumbers(self), self.print_dual(angle)
        values = [self.sines.get((f"math.{own}", angle)) if sines.is_simple(angle) else None for own in ("sin", "cos")]
        sine, cosine = (v or g.call(own, a) for v, own in zip(values, ("sin", "cos"), strict=True))
        if name == "sin":
            return sine, self.scale_directions(da, lambda: cosine)
        return cosine, self.scale_directions(da, lambda: g.neg(sine))

    # -- directions

    def add_directions(self, a: str | None, b: str | None) -> str | None:
        """Print the sum of two vectors of directions."""
        if a is None or b is None:
            return b if a is None else a
        return self.print_instruction(f"fadd{self.flag} {self.kind} {a}, {b}")

    def subtract_directions(self, a: str | None, b: str | None) -> str | None:
        """Print the difference of two vectors of directions."""
        if b is None:
            return a
        return self.print_instruction(f"fneg {self.kind} {b}" if a is None else f"fsub{self.flag} {self.kind} {a}, {b}")

    def scale_directions(self, directions: str | None, factor: Callable[[], str]) -> str | None:
        """Print the product of directions and a number, which is only printed where directions exist."""
        if directions is None:
            return None
        return self.print_instruction(f"fmul{self.flag} {self.kind} {directions}, {self.spread_number(factor())}")

    def spread_number(self, number: str) -> str:
        """Return a vector of equal numbers."""
        if not number.startswith("%"):
            return f"<{', '.join([f'double {number}'] * self.lanes)}>"
        if ("spread", number) not in self.printed:
            one = self.print_instruction(f"insertelement {self.kind} poison, double {number}, i32 0")
            vector = f"shufflevector {self.kind} {one}, {self.kind} poison, <{self.lanes} x i32> zeroinitializer"
            self.printed["spread", number] = self.print_instruction(vector)
        return self.printed["spread", number]


def full_directions(directions: str | None) -> str:
    """Return directions, zeros where there are none."""
    return "zeroinitializer" if directions is None else directions

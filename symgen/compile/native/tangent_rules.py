"""Rules of directions in text for LLVM: a float has a vector of directions beside it."""

from __future__ import annotations

from abc import ABC

from symgen.compile.native import language as lang
from symgen.compile.native import sines
from symgen.compile.native.direction_rules import DirectionRules
from symgen.compile.native.llvm import LlvmPrinter
from symgen.compile.native.printed_numbers import PrintedNumbers

#: A float and its directions, None where these are 0.
Dual = tuple[str, str | None]


class TangentRules(LlvmPrinter, DirectionRules[str], ABC):
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

    @property
    def numbers(self) -> PrintedNumbers:
        """Operations on numbers."""
        return PrintedNumbers(self)

    def print_plain(self, e: lang.ScalarOperation) -> str:
        """Print an operation without directions."""
        return LlvmPrinter.value(self, e)

    def print_sines(self, angle: lang.Expression, value: str) -> tuple[str, str]:
        """Print sine and cosine of an angle, which may have been taken together with others."""
        g = PrintedNumbers(self)
        taken = [self.sines.get((f"math.{own}", angle)) if sines.is_simple(angle) else None for own in ("sin", "cos")]
        sine, cosine = (v or g.call(own, value) for v, own in zip(taken, ("sin", "cos"), strict=True))
        return sine, cosine

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

    def add_printed(self, a: str, b: str) -> str:
        """Print the sum of two vectors of directions."""
        return self.print_instruction(f"fadd{self.flag} {self.kind} {a}, {b}")

    def subtract_printed(self, a: str | None, b: str) -> str:
        """Print the difference of two vectors of directions, or the opposite of one."""
        return self.print_instruction(f"fneg {self.kind} {b}" if a is None else f"fsub{self.flag} {self.kind} {a}, {b}")

    def scale_printed(self, directions: str, factor: str) -> str:
        """Print the product of directions and a number."""
        return self.print_instruction(f"fmul{self.flag} {self.kind} {directions}, {self.spread_number(factor)}")

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

"""Operations on numbers as text for LLVM, under the names that slopes of elementary functions use on a graph."""

from __future__ import annotations

from typing import TYPE_CHECKING

from symgen.compile.native.llvm_values import float_literal

if TYPE_CHECKING:
    from symgen.compile.native.tangent_rules import TangentRules


class PrintedNumbers:
    """Prints operations on numbers, under the names that slopes of elementary functions use on a graph."""

    one = float_literal(1.0)

    def __init__(self, printer: TangentRules) -> None:
        self.printer = printer

    def constant(self, value: float) -> str:
        """Return a number."""
        return float_literal(value)

    def add(self, a: str, b: str) -> str:
        """Print a sum."""
        return self._print_operation("fadd", a, b)

    def sub(self, a: str, b: str) -> str:
        """Print a difference."""
        return self._print_operation("fsub", a, b)

    def mul(self, a: str, b: str) -> str:
        """Print a product."""
        return self._print_operation("fmul", a, b)

    def div(self, a: str, b: str) -> str:
        """Print a quotient."""
        return self._print_operation("fdiv", a, b)

    def neg(self, a: str) -> str:
        """Print the opposite."""
        return self._print_operation("fsub", float_literal(-0.0), a)

    def call(self, name: str, *values: str) -> str:
        """Print a function; once in a block."""
        key = (name, *values)
        if key not in self.printer.printed:
            self.printer.printed[key] = self.printer.function_of_math(name, list(values))
        return self.printer.printed[key]

    def _print_operation(self, name: str, a: str, b: str) -> str:
        return self.printer.print_instruction(f"{name}{self.printer.flag} double {a}, {b}")

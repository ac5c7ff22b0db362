"""Values of formulas on whole vectors: each represents an operation, which a tape records in order.

A method computes nothing while it writes its law. Code for one mechanism replays the tape element by element
(`symgen.derive.lower.scalar`), code for all mechanisms converts it to loops
(`symgen.derive.lower.looped.law_loops`).
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass, field
from typing import TypeVar, overload

_Value = TypeVar("_Value", bound="Value")


@dataclass(frozen=True)
class FormulaStep:
    """One step of a formula.

    Parameters
    ----------
    kind : str
        Arithmetic (``add``, ``dot``, ...) or an operation of `System` (``minv``, ``solve``, ...).
    operands : tuple of int
        Indices of earlier operations.
    payload : tuple of str or float
        Names of sections and parameters, literals.
    size : {"", "nq", "nv", "m"}
        Length of the result; empty unless it is a vector.
    """

    kind: str
    operands: tuple[int, ...] = ()
    payload: tuple[str | float, ...] = ()
    size: str = ""


#: Kinds of operations whose first operand is their value by a factor of D W D^T.
ALTERNATIVES = frozenset(("constrained", "stored_constrained"))


@dataclass(eq=False)
class Tape:
    """Distinct operations in the order of their first use.

    Attributes
    ----------
    stored : list of (str, Value)
        Sections of ``w`` and the values that they keep between the functions of a law.
    """

    operations: list[FormulaStep] = field(default_factory=list)
    stored: list[tuple[str, Value]] = field(default_factory=list)
    _index: dict[FormulaStep, int] = field(default_factory=dict)

    def add(self, operation: FormulaStep) -> int:
        """Return the index of an operation, appended if it is new."""
        index = self._index.setdefault(operation, len(self.operations))
        if index == len(self.operations):
            self.operations.append(operation)
        return index

    def constant(self, value: float) -> Scalar:
        """Return a literal."""
        return Scalar(self, self.add(FormulaStep("constant", payload=(float(value),))))

    def named(self, cls: type[_Value], kind: str, *names: str, size: str = "") -> _Value:
        """Return the value of a named quantity."""
        return cls(self, self.add(FormulaStep(kind, (), names, size)))

    def stored_value(self, cls: type[_Value], kind: str, section: str, x: Value, size: str = "") -> _Value:
        """Return a stored value, read from a section."""
        stored = cls(self, self.add(FormulaStep(kind, (x.index,), (section,), size)))
        self.stored.append((section, stored))
        return stored


def needed_operations(ends: Iterable[int], operands: Callable[[int], tuple[int, ...]]) -> list[int]:
    """Return the indices of all operations that `ends` depend on through their `operands`, in their order."""
    indices: set[int] = set()
    waiting = list(ends)
    while waiting:
        index = waiting.pop()
        if index not in indices:
            indices.add(index)
            waiting += operands(index)
    return sorted(indices)


@dataclass(frozen=True, eq=False)
class Value:
    """The result of an operation."""

    tape: Tape
    index: int

    def apply(self, cls: type[_Value], kind: str, *operands: Value, size: str = "") -> _Value:
        """Return the result of an operation on values."""
        return cls(self.tape, self.tape.add(FormulaStep(kind, tuple(v.index for v in operands), (), size)))


class Vector(Value):
    """A vector with elementwise arithmetic."""

    @property
    def size(self) -> str:
        """Name of its length: ``nq``, ``nv`` or ``m``."""
        return self.tape.operations[self.index].size

    def __add__(self, other: Vector) -> Vector:
        return self.apply(Vector, "add", self, other, size=self.size)

    def __sub__(self, other: Vector) -> Vector:
        return self.apply(Vector, "sub", self, other, size=self.size)

    def __neg__(self) -> Vector:
        return self.apply(Vector, "neg", self, size=self.size)

    def times(self, other: Vector) -> Vector:
        """Return the elementwise product."""
        return self.apply(Vector, "mul", self, other, size=self.size)

    def dot(self, other: Vector) -> Scalar:
        """Return the inner product."""
        return self.apply(Scalar, "dot", self, other)


class Scalar(Value):
    """A number with arithmetic, so that a method's formula reads like the textbook's."""

    def __add__(self, other: Scalar) -> Scalar:
        return self.apply(Scalar, "add", self, other)

    def __sub__(self, other: Scalar) -> Scalar:
        return self.apply(Scalar, "sub", self, other)

    def __neg__(self) -> Scalar:
        return self.apply(Scalar, "neg", self)

    def __truediv__(self, other: Scalar) -> Scalar:
        return self.apply(Scalar, "div", self, other)

    @overload
    def __mul__(self, other: Scalar) -> Scalar: ...
    @overload
    def __mul__(self, other: Vector) -> Vector: ...
    def __mul__(self, other: Scalar | Vector) -> Scalar | Vector:
        if isinstance(other, Vector):
            return self.apply(Vector, "mul", self, other, size=other.size)
        return self.apply(Scalar, "mul", self, other)

    def __rmul__(self, factor: float) -> Scalar:
        return self.tape.constant(factor) * self

    def __pow__(self, exponent: int) -> Scalar:
        return self.apply(Scalar, "pow", self, self.tape.constant(exponent))

    def root(self) -> Scalar:
        """Return the square root."""
        return self.apply(Scalar, "sqrt", self)

    def smaller(self, other: Scalar) -> Scalar:
        """Return the smaller of two scalars."""
        return self.apply(Scalar, "min", self, other)


class Matrix(Value):
    """A matrix used in products only: D by rows, or a root of M^-1."""

    def __matmul__(self, x: Vector) -> Vector:
        return self.apply(Vector, "product", self, x, size="m")

    def transposed(self, y: Vector) -> Vector:
        """Return the transpose times a vector."""
        return self.apply(Vector, "transposed", self, y, size="nv")

    def times_transposed(self, other: Matrix) -> Matrix:
        """Return this matrix times the transpose of another one."""
        return self.apply(Matrix, "times_transposed", self, other)


class Factor(Value):
    """A factorisation L D L^T of a symmetric matrix."""

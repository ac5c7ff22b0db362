"""Vectors, scalars and the constraint matrix as formulas on whole vectors: what the looped shape prints as loops.

The arithmetic is that of `symgen.lower.vectors`, so that a method's formula serves both shapes. Nothing is computed
element by element here: a formula is a tree of products with D and M, solutions, and elementwise expressions.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import overload

#: Index of elementwise expressions.
INDEX = "j"


@dataclass(frozen=True, eq=False)
class Operation:
    """A vector that is computed as a whole.

    Parameters
    ----------
    kind : str
        ``rows`` (D x), ``columns`` (D^T x), ``mass`` (M x), ``inverse_mass`` (M^-1 x), ``solve``.
    operand : Vector
        x, or the right-hand side.
    size : {"nv", "m"}
        Length of the result.
    factor : Factor, optional
        Of a solution.
    """

    kind: str
    operand: Vector
    size: str
    factor: Factor | None = None


@dataclass(frozen=True, eq=False)
class Vector:
    """An elementwise expression: `parts` are joined where it is printed.

    Each part is text, an `Operation` whose element stands there, or an inner product. A zero vector has no parts; an
    atom needs no parentheses.
    """

    size: str
    parts: tuple[Part, ...]
    atom: bool = False

    @property
    def is_zero(self) -> bool:
        """Whether all elements are structurally zero."""
        return not self.parts

    def _wrapped(self) -> tuple[Part, ...]:
        return self.parts if self.atom else ("(", *self.parts, ")")

    def __add__(self, other: Vector) -> Vector:
        if self.is_zero or other.is_zero:
            return other if self.is_zero else self
        return Vector(self.size, (*self.parts, " + ", *other._wrapped()))

    def __sub__(self, other: Vector) -> Vector:
        if other.is_zero:
            return self
        if self.is_zero:
            return Vector(self.size, ("-", *other._wrapped()))
        return Vector(self.size, (*self.parts, " - ", *other._wrapped()))

    def times(self, other: Vector) -> Vector:
        """Return the elementwise product."""
        if self.is_zero or other.is_zero:
            return Vector(self.size, ())
        return Vector(self.size, (*self._wrapped(), " * ", *other._wrapped()))

    def scaled(self, factor: Scalar) -> Vector:
        """Return the vector times a scalar."""
        if self.is_zero:
            return self
        return Vector(self.size, (*factor.wrapped(), " * ", *self._wrapped()))

    def dot(self, other: Vector) -> Scalar:
        """Return the inner product."""
        if self.is_zero or other.is_zero:
            return Scalar(("0.0",))
        return Scalar((Inner(self, other),))


@dataclass(frozen=True, eq=False)
class Inner:
    """An inner product, computed by a loop before the expression that it stands in."""

    a: Vector
    b: Vector


@dataclass(frozen=True, eq=False)
class Scalar:
    """A scalar expression: text and inner products."""

    parts: tuple[Part, ...]

    def wrapped(self) -> tuple[Part, ...]:
        """Return the parts as a factor."""
        return ("(", *self.parts, ")")

    def __add__(self, other: Scalar) -> Scalar:
        return Scalar((*self.parts, " + ", "(", *other.parts, ")"))

    def __sub__(self, other: Scalar) -> Scalar:
        return Scalar((*self.parts, " - ", "(", *other.parts, ")"))

    @overload
    def __mul__(self, other: Scalar) -> Scalar: ...
    @overload
    def __mul__(self, other: Vector) -> Vector: ...
    def __mul__(self, other: Scalar | Vector) -> Scalar | Vector:
        if isinstance(other, Vector):
            return other.scaled(self)
        return Scalar(("(", *self.parts, ") * (", *other.parts, ")"))

    def __rmul__(self, factor: float) -> Scalar:
        return Scalar((f"{float(factor)!r} * (", *self.parts, ")"))

    def __pow__(self, exponent: int) -> Scalar:
        return Scalar(("(", *self.parts, f") ** {exponent}"))

    def smaller(self, other: Scalar) -> Scalar:
        """Return the smaller of two scalars."""
        return Scalar(("min(", *self.parts, ", ", *other.parts, ")"))


@dataclass(frozen=True, eq=False)
class Root:
    """The inverse root L^-T of M = L L^T, which stands beside its own transposed wherever it is used."""

    def transposed(self, x: Vector) -> Vector:
        """Return L^-T x for an x = L^-1 z, which is M^-1 z: x carries z."""
        return x if x.is_zero else Vector("nv", (Operation("inverse_mass", x, "nv"),), True)


@dataclass(frozen=True, eq=False)
class Matrix:
    """The constraint matrix D, or D L^-T where it is `weighted`; then only products with its transposed are formed."""

    weighted: bool = False

    def __matmul__(self, x: Vector) -> Vector:
        assert not self.weighted, "a weighted matrix stands beside its transposed"
        return Vector("m", (Operation("rows", x, "m"),) if x.parts else (), True)

    def transposed(self, y: Vector) -> Vector:
        """Return D^T y; of a weighted matrix what `Root.transposed` wants."""
        return Vector("nv", (Operation("columns", y, "nv"),) if y.parts else (), True)

    def times_transposed(self, root: Root) -> Matrix:
        """Return D times L^-T."""
        return Matrix(True)


@dataclass(frozen=True, eq=False)
class Factor:
    """A factorisation L D L^T.

    Parameters
    ----------
    kind : {"schur", "augmented"}
        Of D M^-1 D^T, or of M + D^T a D.
    lower : str
        Section that holds it, reciprocal pivots on the diagonal.
    penalties : Vector, optional
        a, by rows.
    stored : bool
        Whether it was made before the block that reads it.
    """

    kind: str
    lower: str
    penalties: Vector | None = None
    stored: bool = False


Part = str | Operation | Inner

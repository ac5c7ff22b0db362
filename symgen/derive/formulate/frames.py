"""Frames of bodies in the plane and in space, and the derivation rule of the project.

The entries c, s of a planar body's rotation matrix are symbols with a known derivative, A' = A [[0, -w], [w, 0]], so
that derivatives along the motion contain no sin and cos of an angle and stay small.

In space A' = A skew(omega), angular velocity in body axes. A vector fixed in a body, r = A p, has the derivatives
A (omega x p) and, for constant omega, A (omega x (omega x p)). Kernels are derived over the ground components of such
vectors, so that the products in brackets, common to all components, are computed once. The entries of A are symbols;
the model inserts the homogeneous form in Euler parameters (diagonal e0^2 + e1^2 - e2^2 - e3^2, ...), for which the
rule is exact for any length of them.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import Any

import sympy as sp

#: Input slots of a frame in a kernel, in this order.
FRAME_SLOTS = ("x", "y", "c", "s", "vx", "vy", "w")


class FrameSymbols:
    """Symbols of one body's frame in the plane: centre of mass, rotation entries and velocities.

    Parameters
    ----------
    prefix : str
        Distinguishes the frames of one kernel.
    kind : {"ground", "point", "rigid"}
        Ground does not move; a point mass does not rotate. Kinds of space end in 3.
    """

    dimension, first_velocity = 2, 4
    slots: tuple[str, ...] = FRAME_SLOTS

    def __init__(self, prefix: str, kind: str) -> None:
        self.prefix, self.moves, self.turns = prefix, not kind.startswith("ground"), kind.startswith("rigid")
        #: Symbol of a vector's component -> its definition, in the order of computation; empty in the plane.
        self.definitions: dict[Any, Any] = {}

    def symbol(self, slot: str) -> Any:
        """Return the SymPy symbol of a slot."""
        return sp.Symbol(f"{self.prefix}_{slot}", real=True)

    @property
    def velocities(self) -> tuple[Any, ...]:
        """Velocity symbols, the factors of the columns of a row."""
        names = self.slots[self.first_velocity :]
        count = len(names) if self.turns else self.dimension if self.moves else 0
        return tuple(self.symbol(n) for n in names[:count])

    def rates(self) -> Mapping[Any, Any]:
        """Return the derivative of each position-level symbol along the motion."""
        rule: dict[Any, Any] = {}
        if self.moves:
            rule[self.symbol("x")], rule[self.symbol("y")] = self.symbol("vx"), self.symbol("vy")
        if self.turns:
            c, s, w = self.symbol("c"), self.symbol("s"), self.symbol("w")
            rule[c], rule[s] = -s * w, c * w
        return rule

    def column_entries(self, rate: object) -> list[Any]:
        """Return the coefficients of the frame's velocities in a rate."""
        return [sp.diff(rate, v) for v in self.velocities]

    def rotate(self, vector: tuple[Any, ...]) -> tuple[Any, ...]:
        """Return A times a vector given in the frame."""
        if not self.turns:
            return vector
        c, s = self.symbol("c"), self.symbol("s")
        return c * vector[0] - s * vector[1], s * vector[0] + c * vector[1]

    def locate(self, point: tuple[Any, ...]) -> tuple[Any, ...]:
        """Return the position of a point given relative to the centre of mass (ground: to the origin)."""
        if not self.moves:
            return point
        x, y = self.symbol("x"), self.symbol("y")
        if not self.turns:
            return x, y
        dx, dy = self.rotate(point)
        return x + dx, y + dy


#: Input slots of a spatial frame in a kernel: centre of mass, A row by row, velocities.
SPATIAL_SLOTS = (
    *("x", "y", "z"),
    *(f"a{i}{j}" for i in range(3) for j in range(3)),
    *("vx", "vy", "vz", "wx", "wy", "wz"),
)

Triple = tuple[Any, Any, Any]


def cross_product(a: Sequence[Any], b: Sequence[Any]) -> Triple:
    """Return a x b."""
    return a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]


class SpatialFrame(FrameSymbols):
    """Symbols of one body's frame in space, and the vectors fixed in it that a kernel uses; as `FrameSymbols`."""

    dimension, first_velocity = 3, 12
    slots = SPATIAL_SLOTS

    def __init__(self, prefix: str, kind: str) -> None:
        super().__init__(prefix, kind)
        self._rates: dict[Any, Any] = {}
        self._columns: dict[Any, tuple[Any, ...]] = {}
        self._vectors: dict[tuple[str, tuple[Any, ...]], Triple] = {}

    @property
    def omega(self) -> Triple:
        """Angular velocity in body axes."""
        if not self.turns:
            return sp.S.Zero, sp.S.Zero, sp.S.Zero
        return self.symbol("wx"), self.symbol("wy"), self.symbol("wz")

    def rates(self) -> Mapping[Any, Any]:
        """Return the derivative of each moving symbol along the motion, velocities constant."""
        return self._rates

    def column_entries(self, rate: object) -> list[Any]:
        """Return the coefficients of the frame's velocities in an expression of rates."""
        parts: dict[Any, Any] = {s: sp.diff(rate, s) for s in self._columns}
        count = len(self.velocities)
        return [
            sp.Add(*(part * self._columns[s][j] for s, part in parts.items() if part != 0))
            + sp.diff(rate, self.velocities[j])
            for j in range(count)
        ]

    # -- vectors -----------------------------------------------------------------------------------------------------

    def to_ground(self, local: Sequence[Any]) -> Triple:
        """Return A times a vector in body axes."""
        if not self.turns:
            return local[0], local[1], local[2]
        a = [[self.symbol(f"a{i}{j}") for j in range(3)] for i in range(3)]
        x, y, z = (sum(a[i][j] * local[j] for j in range(3)) for i in range(3))
        return x, y, z

    def locate(self, point: Sequence[Any]) -> Triple:
        """Return the position of a point given relative to the centre of mass (ground: to the origin)."""
        if not self.moves:
            return point[0], point[1], point[2]
        return self._rotated_symbols("r", tuple(point))

    def rotate(self, vector: Sequence[Any]) -> Triple:
        """Return A times a vector given in the frame."""
        if not self.turns:
            return vector[0], vector[1], vector[2]
        return self._rotated_symbols("e", tuple(vector))

    def spin(self) -> Triple:
        """Return the angular velocity in ground axes, whose derivative for constant omega is zero."""
        if not self.turns:
            return sp.S.Zero, sp.S.Zero, sp.S.Zero
        if ("w", ()) not in self._vectors:
            units = [[sp.Integer(int(i == j)) for j in range(3)] for i in range(3)]
            columns = [self.to_ground(unit) for unit in units]
            symbols = self._symbols_defined_as("w", self.to_ground(self.omega))
            for i, s in enumerate(symbols):
                self._rates[s] = sp.S.Zero
                self._columns[s] = (sp.S.Zero,) * 3 + tuple(column[i] for column in columns)
            self._vectors["w", ()] = symbols
        return self._vectors["w", ()]

    def _rotated_symbols(self, what: str, local: tuple[Any, ...]) -> Triple:
        """Return symbols of A p, plus the centre of mass for a point, and register their derivatives."""
        symbols = self._vectors.get((what, local))
        if symbols is not None:
            return symbols
        zero = sp.S.Zero
        origin = [self.symbol(s) for s in "xyz"] if what == "r" else [zero] * 3
        speed = [self.symbol(f"v{s}") for s in "xyz"] if what == "r" else [zero] * 3
        name = f"{what}{len(self._vectors)}"
        turned = local if self.turns else (zero, zero, zero)
        first = self._symbols_in_frame(f"{name}p", cross_product(self.omega, turned))
        second = self._symbols_in_frame(f"{name}q", cross_product(self.omega, first))
        at, rate, bias = (self.to_ground(v) for v in (turned, first, second))
        value = self._symbols_defined_as(name, tuple(o + a for o, a in zip(origin, at, strict=True)))
        rates = self._symbols_defined_as(f"{name}d", tuple(v + a for v, a in zip(speed, rate, strict=True)))
        seconds = self._symbols_defined_as(f"{name}dd", bias)
        units = [[sp.Integer(int(i == j)) for j in range(3)] for i in range(3)]
        turning = [self.to_ground(cross_product(unit, turned)) for unit in units] if self.turns else []
        for i in range(3):
            self._rates[value[i]], self._rates[rates[i]] = rates[i], seconds[i]
            shift = tuple(sp.Integer(int(what == "r" and i == j)) for j in range(3))
            self._columns[rates[i]] = shift + tuple(column[i] for column in turning)
        self._vectors[what, local] = value
        return value

    def _symbols_in_frame(self, name: str, vector: Triple) -> Triple:
        """Introduce symbols for the components of a vector in body axes, so that they are computed once."""
        return self._symbols_defined_as(name, vector) if self.turns else vector

    def _symbols_defined_as(self, name: str, definition: Sequence[Any]) -> Triple:
        x, y, z = (sp.Symbol(f"{self.prefix}_{name}_{i}", real=True) for i in range(3))
        self.definitions.update(zip((x, y, z), definition, strict=True))
        return x, y, z


def frame_of_kind(prefix: str, kind: str) -> FrameSymbols:
    """Return a frame of a kind; kinds of space end in 3."""
    return SpatialFrame(prefix, kind) if kind.endswith("3") else FrameSymbols(prefix, kind)


def derivative_along_motion(expression: object, frames: Iterable[FrameSymbols]) -> Any:
    """Return the time derivative of `expression` along the motion of `frames`, velocities constant."""
    total = sp.S.Zero
    for frame in frames:
        for symbol, rate in frame.rates().items():
            partial = sp.diff(expression, symbol)
            if partial != 0:
                total += partial * rate
    return total

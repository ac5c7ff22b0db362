"""Planar frames and the derivation rule of the project.

The entries c, s of a body's rotation matrix are symbols with a known derivative, A' = A [[0, -w], [w, 0]], so that an
expression is differentiated along the motion without ever forming sin and cos of an angle, and stays small.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import Any, ClassVar

import sympy as sp

from symgen.formulate.spatial import SpatialFrame

#: Input slots of a frame in a kernel, in this order.
FRAME_SLOTS = ("x", "y", "c", "s", "vx", "vy", "w")


@dataclass(frozen=True)
class Frame:
    """Symbols of one body's frame: centre of mass, rotation entries and velocities.

    Parameters
    ----------
    prefix : str
        Distinguishes the frames of one kernel.
    kind : {"ground", "point", "rigid"}
        Ground does not move; a point mass has no rotation.
    """

    prefix: str
    kind: str

    dimension: ClassVar[int] = 2
    slots: ClassVar[tuple[str, ...]] = FRAME_SLOTS
    #: Named vectors of a frame; the plane needs none.
    definitions: ClassVar[Mapping[Any, Any]] = {}

    def symbol(self, slot: str) -> Any:
        """Return the SymPy symbol of a slot."""
        return sp.Symbol(f"{self.prefix}_{slot}", real=True)

    @property
    def moves(self) -> bool:
        """Whether the frame has coordinates."""
        return self.kind != "ground"

    @property
    def turns(self) -> bool:
        """Whether the frame has an angle."""
        return self.kind == "rigid"

    @property
    def velocities(self) -> tuple[Any, ...]:
        """Velocity symbols, those that multiply the columns of the row."""
        names = ("vx", "vy", "w") if self.turns else ("vx", "vy") if self.moves else ()
        return tuple(self.symbol(n) for n in names)

    def rates(self) -> Mapping[Any, Any]:
        """Return the derivative of each position-level symbol along the motion."""
        rule: dict[Any, Any] = {}
        if self.moves:
            rule[self.symbol("x")], rule[self.symbol("y")] = self.symbol("vx"), self.symbol("vy")
        if self.turns:
            c, s, w = self.symbol("c"), self.symbol("s"), self.symbol("w")
            rule[c], rule[s] = -s * w, c * w
        return rule

    def column_entries(self, rate: Any) -> list[Any]:
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
        if self.kind == "ground":
            return point
        x, y = self.symbol("x"), self.symbol("y")
        if self.kind == "point":
            return x, y
        dx, dy = self.rotate(point)
        return x + dx, y + dy


AnyFrame = Frame | SpatialFrame


def frame(prefix: str, kind: str) -> AnyFrame:
    """Return a frame of a kind; kinds of space end in 3."""
    return SpatialFrame(prefix, kind) if kind.endswith("3") else Frame(prefix, kind)


def along_motion(expression: Any, frames: Iterable[AnyFrame]) -> Any:
    """Return the time derivative of `expression` along the motion of `frames`, velocities held constant."""
    total = sp.S.Zero
    for frame in frames:
        for symbol, rate in frame.rates().items():
            partial = sp.diff(expression, symbol)
            if partial != 0:
                total += partial * rate
    return total

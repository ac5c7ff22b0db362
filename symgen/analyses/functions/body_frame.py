"""Frames on bodies: pose, velocity and Jacobian as compiled functions of the state."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from symgen.describe.formulas.formula_text import to_text

if TYPE_CHECKING:
    from symgen.analyses.functions.array_function import ArrayFunction
    from symgen.analyses.functions.model_functions import Functions
    from symgen.describe.mechanism import Vec

Array = NDArray[np.float64]


class Frame:
    """A frame that moves with a body: where it is, how it moves, and what velocities do to it.

    Vectors have their linear part first, then the angular one: six numbers in space, three in the plane. Components are
    along the axes of the ground; those of `local` are along the frame's own.

    Attributes
    ----------
    name : str
        Its name, such as ``arm.tip``.
    """

    def __init__(self, functions: Functions, name: str, body: str, point: Vec, axes: str = "world") -> None:
        self.functions, self.name, self._body, self._point, self._axes = functions, name, body, point, axes

    def __repr__(self) -> str:
        return f"<Frame {self.name} of {self.functions.mechanism.name}, {self._axes} axes>"

    @property
    def local(self) -> Frame:
        """The same frame with components along its own axes."""
        return Frame(self.functions, self.name, self._body, self._point, "local")

    @property
    def pose(self) -> ArrayFunction:
        """The homogeneous matrix of (q): axes as columns, then the position [m]; 4 x 4, in the plane 3 x 3."""
        return self._frame_function("pose", ("q",))

    @property
    def velocity(self) -> ArrayFunction:
        """Velocity and angular velocity of (q, v) [m/s, rad/s]."""
        return self._frame_function("velocity", ("q", "v"))

    @property
    def jacobian(self) -> ArrayFunction:
        """``J(q)`` of velocity = J v, shape (6 or 3, nv); what drivers add is no part of it."""
        return self._frame_function("jacobian", ("q",))

    @property
    def jacobian_rate(self) -> ArrayFunction:
        """``J' v`` of (q, v): the rate of `velocity`, of its components, where v' is 0 [m/s^2, rad/s^2]."""
        return self._frame_function("jacobian_rate", ("q", "v"))

    def reduced_jacobian(self, q: object, independent: Sequence[str] = (), p: object = None) -> Array:
        """Return J over independent velocities, with loops closed; see `Functions.reduction`."""
        along = self.functions.reduction(q, independent, p)[1]
        own = self.jacobian(q) if p is None else self.jacobian(q, p)
        return np.asarray(own @ along)

    def _frame_function(self, what: str, vectors: tuple[str, ...]) -> ArrayFunction:
        axes = "world" if what == "pose" else self._axes
        return self.functions.function(
            *(what, f"{what} of {self.name}", vectors),
            lambda f: f.frame(self._body, self._point, what, axes),
            (self._body, *map(to_text, self._point), axes),
        )

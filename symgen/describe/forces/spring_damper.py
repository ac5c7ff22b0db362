"""Spring, damper and actuator along the line between two points, or along the displacement of a joint."""

from __future__ import annotations

from typing import ClassVar

import msgspec

from symgen.base.vocabulary.expressions import ZERO, Name, call
from symgen.base.vocabulary.measures import Distance, Effort, HalfSquare
from symgen.describe.forces._parts import effort_of_spring_and_damper, spring_potential
from symgen.describe.mechanism import Force
from symgen.describe.parts.fields import BodyPair, PointPair, Potential, Scalar, StateFunction, Text
from symgen.describe.parts.scope import Scope


class SpringDamper(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """A spring, a damper and an actuator along the line through two points, or along the displacement of a joint.

    Parameters
    ----------
    between : pair of body names
        The two bodies.
    at : pair of points
        The ends, a point of each body; singular where they meet, unless there is nothing but a spring of free length 0.
    joint : joint name
        In place of `between` and `at`: the joint whose displacement is the length, which may be negative.
    coordinate : str
        Which displacement of the joint, where it has several.
    stiffness, damping : scalar
        [N/m] and [N s/m]; 0 by default.
    free_length : scalar
        Length of the unloaded spring [m]; 0 by default.
    actuator : function of state
        Force that pushes the ends apart [N]; may use ``length`` [m] and ``rate`` [m/s] besides t, parameters and body
        coordinates.
    potential : expression
        Further potential energy [J] as an expression of ``length`` and parameters, for a nonlinear spring.

    Notes
    -----
    The force that pushes the ends apart is -k (length - free_length) - c rate - dU/d length + actuator; the spring and
    the potential count as conservative.
    """

    SPACES: ClassVar[tuple[str, ...]] = ("planar", "spatial")

    between: BodyPair | None = None
    at: PointPair | None = None
    joint: Text | None = None
    coordinate: Text | None = None
    stiffness: Scalar = 0.0
    damping: Scalar = 0.0
    free_length: Scalar = 0.0
    actuator: StateFunction = 0.0
    potential: Potential = 0.0

    def build(self, scope: Scope) -> Force:
        """Resolve to an effort along the distance of the points, or along the displacement."""
        if self.joint is not None:
            scope.only("joint", between=self.between, at=self.at, joint=self.joint)
            joint, _, displacement = scope.joint_coordinate(self.joint, self.coordinate, unit="m")
            effort = effort_of_spring_and_damper(scope, self, "force", displacement, "length", self.free_length)
            return Force(scope.name, scope.kind, joint.bodies, (effort,))
        scope.only("between", between=self.between, joint=self.joint, coordinate=self.coordinate)
        if self.at is None:
            raise scope.error("at", "the ends, a point of each body", "no such key")
        a, b = scope.pair("between", self.between or ("", ""))
        ends = scope.marker("at", a, self.at[0]), scope.marker("at", b, self.at[1])
        effort = effort_of_spring_and_damper(scope, self, "force", Distance(*ends), "length", self.free_length)
        stiffness = scope.constant("stiffness", self.stiffness)
        if effort.magnitude == ZERO and effort.potential == spring_potential(stiffness):
            # k s^2 / 2 is k times half the square, which has derivatives where the ends meet
            effort = Effort("force", HalfSquare(*ends), potential=call("mul", stiffness, Name("s")))
        return Force(scope.name, scope.kind, (a, b), (effort,))


KIND = SpringDamper

"""Torsional spring, damper and actuator between two bodies, or along the angle of a joint."""

from __future__ import annotations

import math
from typing import ClassVar

import msgspec

from symgen.base.vocabulary.expressions import ONE, ZERO, Expr, Name, call, literal_of
from symgen.base.vocabulary.measures import Angle, Dot, Effort, Measure, Spin, Sum, axes
from symgen.describe.forces._parts import damper_force, effort_of_spring_and_damper
from symgen.describe.mechanism import Force, Joint
from symgen.describe.parts.fields import BodyPair, Potential, Scalar, StateFunction, Text, value_in_words
from symgen.describe.parts.scope import Scope
from symgen.describe.parts.triads import make_triads


class TorsionalSpringDamper(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """A spring, a damper and an actuator along the angle of the second body relative to the first, turns counted.

    Parameters
    ----------
    between : pair of body names
        In the plane: the two bodies; the torque acts on the second, its opposite on the first.
    joint : joint name
        In space: the joint whose angle it is; of a spherical joint, the angle of its whole turn from the orientation in
        which its bodies are described, about whatever axis, with `stiffness` and `damping` alone.
    coordinate : str
        In space: which angle of the joint, where it has several.
    stiffness, damping : scalar
        [N m/rad] and [N m s/rad]; 0 by default.
    free_angle : scalar
        Angle of the unloaded spring [rad]; 0 by default.
    actuator : function of state
        Further torque on the second body [N m]; may use ``angle`` [rad] and ``rate`` [rad/s] besides t, parameters and
        body coordinates.
    potential : expression
        Further potential energy [J] as an expression of ``angle`` and parameters, for a nonlinear spring.

    Notes
    -----
    The torque on the second body is -k (angle - free_angle) - c rate - dU/d angle + actuator; the spring and the
    potential count as conservative. In a spherical joint the damping opposes the relative angular velocity, and the
    stiffness has the potential k angle^2 / 2, which is singular half a turn away.
    """

    SPACES: ClassVar[tuple[str, ...]] = ("planar", "spatial")

    between: BodyPair | None = None
    joint: Text | None = None
    coordinate: Text | None = None
    stiffness: Scalar = 0.0
    damping: Scalar = 0.0
    free_angle: Scalar = 0.0
    actuator: StateFunction = 0.0
    potential: Potential = 0.0

    def build(self, scope: Scope) -> Force:
        """Resolve to an effort along the angle between the bodies, in a spherical joint to efforts of a ball."""
        if scope.spatial and self.joint is not None and scope.joint("joint", self.joint).kind == "spherical":
            return self._efforts_of_spherical_joint(scope, scope.joint("joint", self.joint))
        bodies, angle = self._relative_angle(scope)
        effort = effort_of_spring_and_damper(scope, self, "torque", angle, "angle", self.free_angle)
        return Force(scope.name, scope.kind, bodies, (effort,))

    def _efforts_of_spherical_joint(self, scope: Scope, joint: Joint) -> Force:
        """Return dampers along three components of the angular velocity, and a spring along the cosine of the turn."""
        scope.only("joint", between=self.between, joint=self.joint, coordinate=self.coordinate)
        for key in ("free_angle", "actuator", "potential"):
            if getattr(self, key) != 0.0:
                raise scope.error(key, "no such key for a spherical joint", value_in_words(getattr(self, key)))
        a, b = (scope.body("joint", body, turns=True) for body in joint.bodies)
        stiffness, damping = scope.constant("stiffness", self.stiffness), scope.constant("damping", self.damping)
        efforts = list[Effort]()
        if damping != ZERO:
            efforts += [Effort("", Spin(a, b, along), damper_force(damping)) for along in axes(a, 3)]
        if stiffness != ZERO:
            u, v = ((t.first, t.second, t.axis) for t in make_triads(scope, (a, b), (0.0, 0.0, 1.0), fixed=True))
            trace = Sum(tuple((ONE, Dot(*pair)) for pair in zip(u, v, strict=True)))
            half = call("div", stiffness, literal_of(2.0))
            efforts.append(Effort("", trace, potential=call("mul", half, _squared_turn(Name("s")))))
        return Force(scope.name, scope.kind, (a, b), tuple(efforts))

    def _relative_angle(self, scope: Scope) -> tuple[tuple[str, ...], Measure]:
        if scope.spatial:
            scope.only("joint", between=self.between, joint=self.joint)
            joint, _, angle = scope.joint_coordinate(self.joint or "", self.coordinate, unit="rad")
            return joint.bodies, angle
        scope.only("between", between=self.between, joint=self.joint, coordinate=self.coordinate)
        a, b = scope.pair("between", self.between or ("", ""), turns=(True, True))
        return (a, b), Angle(a, b)


#: Below this 1 - cos(angle) the square of the angle is a series, whose terms are then less than 1e-17 after these many.
_SMALL, _TERMS = 0.02, 9


def _squared_turn(trace: Expr) -> Expr:
    """Return the square of the angle of a rotation from the trace of its matrix, 1 + 2 cos(angle).

    With x = 1 - cos(angle) it is the sum of 2^(n+1) n!^2 / (n^2 (2n)!) x^n, the square of the series of the arc sine.
    """
    x = call("div", call("sub", literal_of(3.0), trace), literal_of(2.0))
    series: Expr = ZERO
    for n in range(_TERMS, 0, -1):
        coefficient = literal_of(2.0 ** (n + 1) * math.factorial(n) ** 2 / (n**2 * math.factorial(2 * n)))
        series = call("mul", x, coefficient if series == ZERO else call("add", coefficient, series))
    cosine = call("min", call("sub", ONE, x), literal_of(1.0 - _SMALL / 2.0))
    return call("where", call("lt", x, literal_of(_SMALL)), series, call("pow", call("acos", cosine), literal_of(2.0)))


KIND = TorsionalSpringDamper

"""Torsional spring, damper and actuator between two bodies, or along the angle of a joint."""

from __future__ import annotations

from typing import ClassVar

import msgspec

from symgen.describe.fields import BodyPair, Potential, Scalar, StateFunction, Text
from symgen.describe.mechanism import Force
from symgen.describe.scope import Scope
from symgen.forces._parts import sprung
from symgen.vocabulary.measures import Angle, Measure


class TorsionalSpringDamper(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """A spring, a damper and an actuator along the angle of the second body less that of the first, turns counted.

    Parameters
    ----------
    between : pair of body names
        In the plane: the two bodies; the torque acts on the second, its opposite on the first.
    joint : joint name
        In space: the joint whose angle it is.
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
    potential count as conservative.
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
        """Resolve to an effort along the angle between the bodies."""
        bodies, angle = self._angle(scope)
        effort = sprung(scope, self, "torque", angle, "angle", self.free_angle)
        return Force(scope.name, scope.kind, bodies, (effort,))

    def _angle(self, scope: Scope) -> tuple[tuple[str, ...], Measure]:
        if scope.spatial:
            scope.only("joint", between=self.between, joint=self.joint)
            joint, _, angle = scope.joint_coordinate(self.joint or "", self.coordinate, unit="rad")
            return joint.bodies, angle
        scope.only("between", between=self.between, joint=self.joint, coordinate=self.coordinate)
        a, b = scope.pair("between", self.between or ("", ""), turns=(True, True))
        return (a, b), Angle(a, b)


KIND = TorsionalSpringDamper

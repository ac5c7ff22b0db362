"""Torque on a body, between two, or along the angle of a joint."""

from __future__ import annotations

from typing import ClassVar, Literal

import msgspec

from symgen.base.vocabulary.expressions import ZERO
from symgen.base.vocabulary.measures import GROUND, Angle, Effort, Measure, Spin, axes
from symgen.describe.mechanism import Force
from symgen.describe.parts.fields import BodyName, Potential, StateTorque, Text, value_in_words
from symgen.describe.parts.scope import Scope


class Torque(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """A torque on `body` and its opposite on `reaction`, or in space along the angle of a joint.

    Parameters
    ----------
    body : body name
        The body that is turned.
    reaction : body name
        The body that receives the opposite; the ground by default.
    torque : function of state, or in space vector of them
        In the plane positive counter-clockwise on `body` [N m]; may use ``angle`` (of `body` relative to `reaction`
        [rad]) and its rate ``rate`` [rad/s] besides t, parameters and body coordinates. In space three components, or
        with `joint` one function, which may use ``angle`` and ``rate`` of the joint.
    frame : str
        In space: axes of the components, ``"ground"`` by default, or ``"body"``: axes of `body`.
    joint : joint name
        In space, in place of `body`: the torque turns the joint's second body forward, and the first one backward.
    coordinate : str
        Which angle of the joint, where it has several.
    potential : expression
        Potential energy [J] as an expression of ``angle`` and parameters, whose torque -dU/d angle is added and counts
        as conservative; in space with `joint` only.
    """

    SPACES: ClassVar[tuple[str, ...]] = ("planar", "spatial")

    body: BodyName | None = None
    reaction: BodyName | None = None
    torque: StateTorque | None = None
    frame: Literal["ground", "body"] | None = None
    joint: Text | None = None
    coordinate: Text | None = None
    potential: Potential | None = None

    def build(self, scope: Scope) -> Force:
        """Resolve to an effort along the angle, or to efforts along components of the relative angular velocity."""
        if not scope.spatial:
            scope.only("body", body=self.body, frame=self.frame, joint=self.joint, coordinate=self.coordinate)
        elif (self.body is None) == (self.joint is None):
            raise scope.error("", "either the key body or the key joint", "neither" if self.body is None else "both")
        if self.joint is not None:
            for key in ("reaction", "frame"):
                if getattr(self, key) is not None:
                    raise scope.error(key, "no such key together with joint", value_in_words(getattr(self, key)))
            joint, _, angle = scope.joint_coordinate(self.joint, self.coordinate, unit="rad")
            return Force(scope.name, scope.kind, joint.bodies, (self._effort_along_angle(scope, angle),))
        body = scope.body("body", self.body or "", turns=True, ground=False)
        reaction = scope.body("reaction", self.reaction or GROUND, turns=True)
        if body == reaction:
            raise scope.error("reaction", "another body than 'body'", f"'{body}' twice")
        if scope.spatial:
            return Force(
                scope.name, scope.kind, (body, reaction), self._efforts_along_components(scope, body, reaction)
            )
        return Force(
            scope.name, scope.kind, (body, reaction), (self._effort_along_angle(scope, Angle(reaction, body)),)
        )

    def _effort_along_angle(self, scope: Scope, angle: Measure) -> Effort:
        """Return the effort along an angle."""
        torque = 0.0 if self.torque is None else self.torque
        if isinstance(torque, tuple):
            raise scope.error("torque", "one number or expression", value_in_words(torque))
        return Effort(
            "torque",
            angle,
            magnitude=scope.of_state("torque", torque, {"angle": "s", "rate": "rate"}),
            potential=scope.potential("potential", self.potential or 0.0, {"angle": "s"}),
        )

    def _efforts_along_components(self, scope: Scope, body: str, reaction: str) -> tuple[Effort, ...]:
        """Return efforts along three components of the angular velocity against the other body."""
        for key in ("coordinate", "potential"):
            if getattr(self, key) is not None:
                raise scope.error(key, "no such key without joint", value_in_words(getattr(self, key)))
        if not isinstance(self.torque, tuple) or len(self.torque) != 3:
            got = "no such key" if self.torque is None else value_in_words(self.torque)
            raise scope.error("torque", "three numbers or expressions [x, y, z]", got)
        efforts = []
        directions = axes(body if self.frame == "body" else GROUND, 3)
        for label, component, direction in zip("xyz", self.torque, directions, strict=True):
            magnitude = scope.of_state("torque", component)
            if magnitude != ZERO:
                efforts.append(Effort(label, Spin(reaction, body, direction), magnitude=magnitude))
        return tuple(efforts)


KIND = Torque

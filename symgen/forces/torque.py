"""Torque on a body, or between two."""

from __future__ import annotations

import msgspec

from symgen.describe.fields import BodyName, Potential, StateFunction
from symgen.describe.mechanism import Force
from symgen.describe.scope import Scope
from symgen.vocabulary.measures import GROUND, Angle, Effort


class Torque(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """A torque on `body` and its opposite on `reaction`.

    Parameters
    ----------
    body : body name
        The body that is turned.
    reaction : body name
        The body that receives the opposite; the ground unless given.
    torque : function of state
        Positive counter-clockwise on `body` [N m]; may use ``angle`` (of `body` less that of `reaction` [rad]) and its
        rate ``rate`` [rad/s] besides t, parameters and body coordinates.
    potential : expression
        Potential energy [J] as an expression of ``angle`` and parameters, whose torque -dU/d angle is added and counts
        as conservative.
    """

    body: BodyName
    reaction: BodyName = GROUND
    torque: StateFunction = 0.0
    potential: Potential = 0.0

    def build(self, scope: Scope) -> Force:
        """Resolve to an effort along the angle between the bodies."""
        body = scope.body("body", self.body, turns=True, ground=False)
        reaction = scope.body("reaction", self.reaction, turns=True)
        if body == reaction:
            raise scope.error("reaction", "another body than 'body'", f"'{body}' twice")
        effort = Effort(
            "torque",
            Angle(reaction, body),
            magnitude=scope.of_state("torque", self.torque, {"angle": "s", "rate": "rate"}),
            potential=scope.potential("potential", self.potential, {"angle": "s"}),
        )
        return Force(name=scope.name, kind=scope.kind, bodies=(body, reaction), efforts=(effort,))


KIND = Torque

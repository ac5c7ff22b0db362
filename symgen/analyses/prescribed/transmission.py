"""Transmission angles: how well a link drives the next one, by the angle at the joint between them.

At a pin the angle lies between the lines from it to the next joint of either body; where the next joint is a slider,
its body's line is the normal of the slide. At 90 degrees all of the force along the driving link moves the driven one,
at 0 and 180 degrees none of it.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from symgen.base.errors import InputError, quote, suggest
from symgen.base.vocabulary.measures import GROUND, Component
from symgen.describe.formulas.evaluate import evaluate_formula
from symgen.result.labelled import Labelled

if TYPE_CHECKING:
    from symgen.describe.mechanism import Joint, Mechanism

Array = NDArray[np.float64]

PIN, SLIDER = "revolute", "translational"
WHERE = "transmission"


def transmission_angles(
    mechanism: Mechanism, q: Labelled, parameters: Mapping[str, float], names: tuple[str, ...]
) -> Labelled:
    """Return the transmission angles of joints, from 0 to pi.

    Parameters
    ----------
    mechanism : Mechanism
        In the plane.
    q : Labelled
        Coordinates of all bodies, a row for each time.
    parameters : mapping
        Values of all parameters.
    names : tuple of str
        Pins between two moving bodies. Where a body has several further joints, the one that is meant follows in
        brackets: ``"C(B, D)"`` is the angle at C between the lines to B and to D.

    Raises
    ------
    InputError
        If a name is no such pin, or it is not clear which further joint of a body is meant.
    """
    if names and mechanism.space != "planar":
        raise InputError(WHERE, "a mechanism in the plane", "one in space")
    columns = [_Angle(mechanism, q, parameters, name).values() for name in names]
    stacked = np.column_stack(columns) if columns else np.zeros((len(q.values), 0))
    return Labelled(stacked, names, ("rad",) * len(names))


class _Angle:
    def __init__(self, mechanism: Mechanism, q: Labelled, parameters: Mapping[str, float], name: str) -> None:
        self.mechanism, self.states, self.parameters, self.name = mechanism, q.values, parameters, name
        self.places = {name: i for i, name in enumerate(q.names)}
        pin, bracket, rest = name.partition("(")
        self.pin = self._find_joint(pin.strip())
        if self.pin.kind != PIN or GROUND in self.pin.bodies:
            raise InputError(WHERE, "a pin between two moving bodies", quote(self.pin.name))
        self.neighbours = [part.strip() for part in rest.rstrip().removesuffix(")").split(",")] if bracket else []
        if bracket and (len(self.neighbours) != 2 or not all(self.neighbours) or not rest.rstrip().endswith(")")):
            raise InputError(WHERE, "a pin with the further joints of its bodies, such as C(B, D)", quote(name))

    def values(self) -> Array:
        """Return the angle at all times."""
        lines = [
            self._direction_of_link(*each) for each in zip(self.pin.bodies, self.neighbours or ("", ""), strict=True)
        ]
        (ax, ay), (bx, by) = (line.T for line in lines)
        return np.asarray(np.arctan2(np.abs(ax * by - ay * bx), ax * bx + ay * by))

    def _find_joint(self, name: str) -> Joint:
        joints = {joint.name: joint for joint in self.mechanism.joints}
        if name not in joints:
            raise InputError(WHERE, f"a joint of {self.mechanism.name}", quote(name), suggest(name, joints))
        return joints[name]

    def _direction_of_link(self, body: str, neighbour: str) -> Array:
        """Return the direction from the pin to the next joint of a body in the ground frame, shape (k, 2)."""
        kinds = (PIN, SLIDER)
        others = [j for j in self.mechanism.joints if body in j.bodies and j is not self.pin and j.kind in kinds]
        if neighbour:
            others = [self._find_joint(neighbour)]
            if body not in others[0].bodies or others[0].kind not in kinds:
                raise InputError(WHERE, f"a pin or slider of {body}", quote(neighbour))
        if len(others) != 1:
            names = ", ".join(j.name for j in others) or "none"
            hint = f"such as {self.pin.name}({others[0].name}, ...)" if others else ""
            raise InputError(f"{WHERE} '{self.name}'", f"one further joint of {body}, or which one", names, hint)
        other = others[0]
        if other.kind == SLIDER:
            return self._normal_of_slide(other)
        return self._positions_of_pin(other) - self._positions_of_pin(self.pin)

    def _normal_of_slide(self, slider: Joint) -> Array:
        """Return the normal of a slide, shape (k, 2): its axis is fixed in the first body."""
        ((_, displacement),) = slider.coordinates
        assert isinstance(displacement, Component), "a displacement is a component"
        x, y = (evaluate_formula(e, self.parameters, slider.name) for e in displacement.along.vector)
        return self._turn_to_ground(displacement.along.body, np.array([-y, x]))

    def _positions_of_pin(self, joint: Joint) -> Array:
        """Return the positions of a pin, shape (k, 2)."""
        marker = dict(self.mechanism.seats)[joint.name]
        local = np.array([evaluate_formula(e, self.parameters, joint.name) for e in marker.point])
        if marker.body == GROUND:
            return np.broadcast_to(local, (len(self.states), 2))
        centre = [
            evaluate_formula(e, self.parameters, joint.name) for e in self.mechanism.body(marker.body).centre_of_mass
        ]
        origin = self.states[:, [self.places[f"{marker.body}.x"], self.places[f"{marker.body}.y"]]]
        return origin + self._turn_to_ground(marker.body, local - np.array(centre))

    def _turn_to_ground(self, body: str, local: Array) -> Array:
        if f"{body}.theta" not in self.places:  # the ground, or a point mass
            return np.broadcast_to(local, (len(self.states), 2))
        theta = self.states[:, self.places[f"{body}.theta"]]
        c, s = np.cos(theta), np.sin(theta)
        return np.column_stack([c * local[0] - s * local[1], s * local[0] + c * local[1]])

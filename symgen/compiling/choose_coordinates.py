"""Which coordinates the state of a run has: those of bodies, or those of the joints of a tree.

Joint coordinates have fewer unknowns and rows; both are counted without deriving anything. They exist as straight code
only, so where loops are better the coordinates are those of bodies.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

from symgen.describe.topology import spanning_tree, state_names
from symgen.errors import InputError

if TYPE_CHECKING:
    from symgen.compiling.pipeline import MethodChoice
    from symgen.describe.mechanism import Mechanism


class Taken(NamedTuple):
    """The coordinates, or the shape of code, that are taken, and one sentence that says why."""

    name: str
    reason: str


def weighed(choice: MethodChoice, massless: bool) -> MethodChoice:
    """Return a method with corrections in the metric of the masses, where it leaves the choice.

    The identity in the angles and displacements of joints depends on which joints carry, that of the masses does not.
    With massless bodies, whose M has no inverse, it is the identity in the velocities of bodies.
    """
    if "weight" not in choice.options:
        return choice
    return choice.given(weight="body" if massless else "mass")


def choose_coordinates(mechanism: Mechanism, asked: str, shape: str) -> Taken:
    """Decide the coordinates of a run, ``absolute`` or ``joint``.

    Parameters
    ----------
    mechanism : Mechanism
        What is run.
    asked : str
        One of `symgen.settings.COORDINATES`.
    shape : str
        The shape of code that was asked for, or that bodies' own coordinates would have.

    Raises
    ------
    InputError
        If joint coordinates and looped code are asked for together.
    """
    if asked == "absolute":
        return Taken("absolute", "it was asked for")
    if asked == "joint":
        if shape == "looped":
            expected = "absolute ones for code that is not straight: loops, lanes and CUDA have no joint coordinates"
            raise InputError("coordinates", expected, "joint")
        return Taken("joint", "it was asked for")
    if shape == "looped":
        return Taken("absolute", "loops, lanes and CUDA have no joint coordinates")
    topology = spanning_tree(mechanism)
    own = sum(len(body.speeds) for body in mechanism.bodies)
    rows = sum(len(joint.rows) for joint in mechanism.joints)
    inside = {*(link.joint for link in topology.links), *(x.driver for x in topology.prescribed)}
    tree = len(state_names(mechanism, topology)[1])
    left = sum(len(joint.rows) for joint in mechanism.joints if joint.name not in inside)
    counts = f"{tree} velocities and {left} rows in joint coordinates, {own} and {rows} in absolute ones"
    if tree + left < own + rows:
        return Taken("joint", counts)
    return Taken("absolute", counts)

"""A robot of another program: links with places in the ground frame, connections between them, actuators."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any, Literal

from symgen.describe.formats._poses import ORIGIN, Matrix, Pose, Vector, matrix_product, matrix_transpose

#: The ground among links: a name that no link has.
GROUND = ""

Kind = Literal[
    "fixed",
    "floating",
    "revolute",
    "translational",
    "spherical",
    "cylindrical",
    "planar",
    "rigid",
    "universal",
    "screw",
]


@dataclass(frozen=True)
class LeftOut:
    """Something that a file says and the description does not.

    Attributes
    ----------
    what : str
        In a few words, such as ``"contacts"``.
    where : str
        The element, or how many there are.
    why : str
        Why it is left out.
    moves : bool
        Whether the motion depends on it.
    """

    what: str
    where: str
    why: str
    moves: bool

    def __str__(self) -> str:
        return f"{self.what} ({self.where}): {self.why}"


@dataclass(frozen=True)
class TouchingShape:
    """A shape of collision.

    Attributes
    ----------
    sort : str
        Word of the shape.
    frame : Pose
        In the link; lengths are along its third axis, which is the normal of a plane.
    sizes : tuple of float
        Radius of a sphere, radius and length of a cylinder or capsule, edges of a box [m].
    friction, restitution : float
        Coefficients; of two shapes the smaller friction counts, and the larger restitution. A file that has no
        friction means 1, as Gazebo and MuJoCo do.
    """

    sort: str
    frame: Pose
    sizes: tuple[float, ...] = ()
    friction: float = 1.0
    restitution: float = 0.0

    def moved(self, outer: Pose) -> TouchingShape:
        """Return the shape in the frame that holds its own."""
        return replace(self, frame=outer @ self.frame)


@dataclass
class RobotLink:
    """A part of a robot.

    Attributes
    ----------
    name : str
        As in the file.
    place : Pose
        In the ground frame where the motion starts.
    mass : float
        [kg].
    centre : Vector
        Centre of mass in the frame of the link [m].
    inertia : Matrix
        About the centre of mass, along the axes of the link [kg m^2].
    points, shapes
        Named points of the link [m], and looks as a body has them, with a frame, and paths of meshes as files.
    touching : list of TouchingShape
        Shapes of collision.
    """

    name: str
    place: Pose = field(default_factory=Pose)
    mass: float = 0.0
    centre: Vector = ORIGIN
    inertia: Matrix = ((0.0, 0.0, 0.0), (0.0, 0.0, 0.0), (0.0, 0.0, 0.0))
    points: dict[str, Vector] = field(default_factory=dict)
    shapes: list[dict[str, Any]] = field(default_factory=list)
    touching: list[TouchingShape] = field(default_factory=list)


@dataclass
class Connection:
    """A joint between two links.

    Attributes
    ----------
    name, kind
        As in the file, and what it is in symgen.
    parent, child : str
        The links; `GROUND` is one.
    at : Pose
        The frame of the joint in the ground frame where the motion starts.
    other : Pose or None
        Where the child has it, if the loop that it closes is open there.
    axis, second : Vector, Vector or None
        In that frame; the second axis of a universal joint.
    value : float
        Coordinate where the motion starts [rad or m].
    damping, stiffness, rest : float
        Of a damper and a spring along the coordinate, and its value where the spring is unloaded.
    friction : float
        Bound of dry friction [N or N m].
    rotor : float
        Moment of inertia of a rotor that turns with the joint, or mass that slides with it.
    lower, upper : float or None
        Limits of the coordinate.
    pitch : float
        Of a screw, displacement along the axis a turn [m].
    closes : bool
        Whether it closes a loop of a file that has a tree of its own, beside which it carries nothing.
    """

    name: str
    kind: Kind
    parent: str
    child: str
    at: Pose = field(default_factory=Pose)
    other: Pose | None = None
    axis: Vector = (0.0, 0.0, 1.0)
    second: Vector | None = None
    value: float = 0.0
    damping: float = 0.0
    stiffness: float = 0.0
    rest: float = 0.0
    friction: float = 0.0
    rotor: float = 0.0
    lower: float | None = None
    upper: float | None = None
    pitch: float = 0.0
    closes: bool = False


@dataclass(frozen=True)
class CoupledCoordinate:
    """A coordinate that is a polynomial of another one, or the constant alone where there is none."""

    name: str
    joint: str
    of: str | None
    polynomial: tuple[float, ...]


@dataclass(frozen=True)
class RobotActuator:
    """An effort along joints: weights of joints, and a formula of ``INPUT`` and of coordinates of joints.

    With gain 0 it has no input, as a spring between joints.

    Attributes
    ----------
    name : str
        Of the input.
    weights : dict of str to float
        Joint -> effort over the formula's value.
    gain, offset : float
        The formula is gain u + offset + along sum(weight coordinate) + against sum(weight rate).
    along, against : float
        Factors of the weighted coordinates and of their rates.
    bounds, limits : (float, float) or None
        Of the input u, and of the formula's value.
    unit : str
        Of the input; empty where a file does not say.
    gain_along, gain_against : float
        What a weighted coordinate, and its rate, add to the gain.
    lag : {"", "filter", "integrator"}
        What stands between the input and u: nothing, a first-order lag of the input, or its integral.
    time : float
        Time constant of a filter [s].
    reach : (float, float) or None
        Between which an integral stays.
    slack : (float, float) or None
        Sums of weighted coordinates between which `along` gives nothing, below and above which it counts from there.
    """

    name: str
    weights: dict[str, float]
    gain: float = 1.0
    offset: float = 0.0
    along: float = 0.0
    against: float = 0.0
    bounds: tuple[float, float] | None = None
    limits: tuple[float, float] | None = None
    unit: str = ""
    slack: tuple[float, float] | None = None
    gain_along: float = 0.0
    gain_against: float = 0.0
    lag: str = ""
    time: float = 0.0
    reach: tuple[float, float] | None = None

    @property
    def driven(self) -> bool:
        """Whether it has an input."""
        return any((self.gain, self.gain_along, self.gain_against))


@dataclass(frozen=True)
class RobotSpan:
    """A straight part of a cord, whose length counts as a coordinate, between the links and points of its ends."""

    name: str
    ends: tuple[tuple[str, str], tuple[str, str]]


@dataclass(frozen=True)
class RobotRange:
    """Limits of a weighted sum of coordinates."""

    name: str
    weights: dict[str, float]
    lower: float
    upper: float


@dataclass
class Robot:
    """What a file describes; `folder` is the folder that it is in, `standing` and `touching_ground` are of the ground.

    `touching` says what may touch, as in '3 links'; empty if nothing does.
    """

    name: str
    links: dict[str, RobotLink]
    connections: list[Connection]
    followers: list[CoupledCoordinate] = field(default_factory=list)
    actuators: list[RobotActuator] = field(default_factory=list)
    gravity: Vector = (0.0, 0.0, -9.81)
    left_out: list[LeftOut] = field(default_factory=list)
    folder: Path = Path()
    spans: list[RobotSpan] = field(default_factory=list)
    ranges: list[RobotRange] = field(default_factory=list)
    standing: dict[str, Vector] = field(default_factory=dict)
    touching_ground: list[TouchingShape] = field(default_factory=list)
    touching: str = ""


#: What drives a joint: its name and unit.
_EFFORTS: dict[str, tuple[str, str]] = {"revolute": ("torque", "N m"), "translational": ("force", "N")}


def set_follower_starts(followers: list[CoupledCoordinate], connections: Mapping[str, Connection]) -> None:
    """Set the values at the start of joints that follow others, whose own values stay; rings are left as they are."""
    waiting = {f.joint: f for f in followers if f.of is not None}
    while ready := [f for f in waiting.values() if f.of not in waiting]:
        for f in ready:
            leader = connections[str(f.of)].value
            connections[f.joint].value = math.fsum(c * leader**k for k, c in enumerate(f.polynomial))
            del waiting[f.joint]


def inputs_for_joints(connections: list[Connection], followers: list[CoupledCoordinate]) -> list[RobotActuator]:
    """Return an input for each joint that turns or slides and follows no other."""
    led = {f.joint for f in followers}
    return [
        RobotActuator(f"{c.name}_{_EFFORTS[c.kind][0]}", {c.name: 1.0}, unit=_EFFORTS[c.kind][1])
        for c in connections
        if c.kind in _EFFORTS and c.name not in led
    ]


def rotate_inertia(inertia: Matrix, rotation: Matrix) -> Matrix:
    """Return a tensor along the outer axes of a rotation."""
    return matrix_product(matrix_product(rotation, inertia), matrix_transpose(rotation))

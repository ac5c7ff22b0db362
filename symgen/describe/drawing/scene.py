"""The scene: marks of a mechanism, fixed to its bodies, for drawing in any positions."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from symgen.base.vocabulary.rotations import rotation_matrix_of

Array = NDArray[np.float64]
#: Components of a point of a body, from its centre of mass along its axes, of the ground in its frame [m].
Point = tuple[float, float, float]
#: Index of the body that does not move.
GROUNDED = -1

INK, GREY, PAPER, RED = "#20262e", "#6b7480", "#ffffff", "#d00000"
#: Joints whose two points are one point.
PINS = ("revolute", "spherical", "universal", "constant-velocity", "rigid")
#: Okabe and Ito's colours that stand out on white, told apart with every kind of colour vision.
COLOURS = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#56B4E9", "#E69F00")


@dataclass(frozen=True)
class Look:
    """Colours and width of a mark; an empty colour is none.

    Attributes
    ----------
    ink, fill : str
        ``#rrggbb`` of lines and areas.
    width : float
        Of lines, 1 being thin.
    opacity : float
        Of the area.
    dashed : bool
        Whether lines are.
    """

    ink: str = INK
    fill: str = ""
    width: float = 1.0
    opacity: float = 1.0
    dashed: bool = False


@dataclass(frozen=True)
class Line:
    """A polyline or polygon of a body.

    Attributes
    ----------
    body : int
        Number of its frame, here and below: first those of the bodies, then those that are carried; negative: the
        ground's.
    points : tuple of Point
        In that frame [m].
    closed : bool
        Whether the last point is joined to the first, and the area filled.
    guide : bool
        Whether it only shows where something slides: as long as a motion needs, it says nothing of a mechanism's size.
    in_pieces : bool
        Whether it is an outline, of which the piece in touch is lit.
    """

    body: int
    points: tuple[Point, ...]
    look: Look
    closed: bool = False
    guide: bool = False
    in_pieces: bool = False


@dataclass(frozen=True)
class DrawnCircle:
    """A circle that faces the viewer: a pin, a ball.

    Attributes
    ----------
    at, radius : Point, float
        Centre and size [m].
    mass : bool
        Whether it is quartered, as centres of mass are drawn.
    """

    body: int
    at: Point
    radius: float
    look: Look
    mass: bool = False


@dataclass(frozen=True)
class Tube:
    """A round bar of a body.

    Attributes
    ----------
    a, b : Point
        Its ends [m].
    radius : float
        Half its width [m].
    """

    body: int
    a: Point
    b: Point
    radius: float
    look: Look


@dataclass(frozen=True)
class Solid:
    """A solid of a body by its faces, each seen counter-clockwise from outside; one that is not convex hides itself."""

    body: int
    faces: tuple[tuple[Point, ...], ...]
    look: Look
    convex: bool = True


@dataclass(frozen=True)
class Stretch:
    """A mark from a point of one body to a point of another, of variable length.

    `kind` is one of ``spring``, ``damper``, ``spring-damper``, ``actuator``, ``rod`` and ``gap``.
    """

    kind: str
    body: int
    at: Point
    other: int
    to: Point
    size: float
    look: Look


Mark = Line | DrawnCircle | Tube | Solid | Stretch


@dataclass(frozen=True)
class Side:
    """A piece of a surface of a contact: points along it, of a disc its centre and radius.

    `whole` of what is lit as a whole where the contact is closed, otherwise the piece in touch is.
    """

    body: int
    points: tuple[Point, ...]
    radius: float = 0.0
    whole: bool = True


@dataclass(frozen=True)
class Item:
    """All marks of one body, joint or force.

    Attributes
    ----------
    role : {"ground", "body", "contact", "joint", "force", "fault"}
        What it is.
    name, kind : str
        Of the file.
    marks : tuple of Mark
        In the order in which they are drawn.
    ends : tuple of (int, Point)
        Of a joint: the points of its bodies that it holds together, if any.
    label : Point, optional
        Place of the name of a body, as a point of the body.
    sides : tuple of tuples of Side
        Of a contact with an outline, the pieces of both surfaces.
    """

    role: str
    name: str
    kind: str
    marks: tuple[Mark, ...]
    ends: tuple[tuple[int, Point], ...] = ()
    label: tuple[int, Point] | None = None
    sides: tuple[tuple[Side, ...], ...] = ()


@dataclass(frozen=True)
class Bent:
    """What modes of a body move: an interface, or a point of its outline.

    Attributes
    ----------
    host : int
        Number of the frame of the body.
    first : int
        Index of the first coordinate of its modes in q.
    place : Point
        From its centre of mass, without deformation [m].
    shape, turn : tuple of Point
        Of each mode: displacement, and turn, which has its z component alone in the plane.
    """

    host: int
    first: int
    place: Point
    shape: tuple[Point, ...]
    turn: tuple[Point, ...]


@dataclass(frozen=True)
class BodyFrame:
    """Coordinates of a body in q: index `first`, and their number, 2 or 3 in the plane, 3 or 7 in space.

    What modes move has none of its own, and is `bent`.
    """

    name: str
    first: int
    size: int
    bent: Bent | None = None


@dataclass(frozen=True)
class CarriedFrame:
    """A frame that moves with a point of one body and turns with another, or keeps the directions of the ground.

    Attributes
    ----------
    body, at : int, Point
        Number of the body that carries it, and its origin on that body [m].
    turned : int
        Number of the body whose directions it has; negative: those of the ground.
    """

    body: int
    at: Point
    turned: int


@dataclass(frozen=True, repr=False)
class Scene:
    """The drawn parts of a mechanism.

    Attributes
    ----------
    name, title : str
        Of the mechanism.
    items : tuple of Item
        Ground, bodies, joints, forces.
    spatial : bool
        Whether it is seen from aside.
    up : Point
        The direction against gravity, the y axis in the plane and the z axis in space where there is none.
    unit : float
        Size of a joint's symbol [m].
    frames : tuple of BodyFrame
        Of the bodies.
    carried : tuple of CarriedFrame
        Further frames, numbered on from those of the bodies.
    """

    name: str
    title: str
    items: tuple[Item, ...]
    spatial: bool
    up: Point
    unit: float
    frames: tuple[BodyFrame, ...]
    carried: tuple[CarriedFrame, ...] = ()

    def poses(self, q: Sequence[float] | Array) -> Poses:
        """Return the poses of all frames for coordinates, shape (nq,)."""
        return Poses(self.frames, q, self.spatial, self.carried)

    @property
    def pins(self) -> tuple[Item, ...]:
        """Joints that hold two points together."""
        return tuple(i for i in self.items if i.role == "joint" and i.kind in PINS and len(i.ends) == 2)

    def gaps(self, q: Sequence[float] | Array) -> Array:
        """Return the distances between the points of all `pins` [m]."""
        poses, pins, places = self.poses(q), self.pins, []
        for side in (0, 1):
            bodies, points = [item.ends[side][0] for item in pins], [item.ends[side][1] for item in pins]
            turned = np.einsum("nij,nj->ni", poses.turns[bodies], np.reshape(points, (-1, 3)))
            places.append(poses.centres[bodies] + turned)
        return np.asarray(np.linalg.norm(places[1] - places[0], axis=1))

    def __repr__(self) -> str:
        return f"<Scene of {self.name}: {len(self.items)} items>"


class Poses:
    """Rotations and origins of frames: bodies first, carried frames next, the ground last.

    Parameters
    ----------
    frames : sequence of BodyFrame
        Of the bodies.
    q : Array, shape (nq,)
        Coordinates.
    spatial : bool
        Whether the mechanism is.
    carried : sequence of CarriedFrame
        Frames other than those of the bodies.
    """

    def __init__(
        self,
        frames: Sequence[BodyFrame],
        q: Sequence[float] | Array,
        spatial: bool,
        carried: Sequence[CarriedFrame] = (),
    ) -> None:
        n, self._spatial = len(frames) + len(carried) + 1, spatial
        self.turns = np.tile(np.eye(3), (n, 1, 1))
        self.centres = np.zeros((n, 3))
        if not spatial:
            self._place_planar_bodies(frames, np.asarray(q, dtype=np.float64))
        for i, frame in enumerate(frames):
            if frame.bent is not None:  # its body comes before it
                self._place_bent(i, frame.bent, np.asarray(q, dtype=np.float64))
                continue
            if not spatial:
                continue
            own = [float(x) for x in q[frame.first : frame.first + frame.size]]
            self.centres[i] = own[:3]
            if frame.size == 7:
                e = np.array(own[3:]) / np.linalg.norm(own[3:])
                self.turns[i] = rotation_matrix_of((e[0], e[1], e[2], e[3]))
        for i, own_frame in enumerate(carried, len(frames)):
            self.centres[i] = self.to_ground(own_frame.body, [own_frame.at])[0]
            self.turns[i] = self.turns[own_frame.turned]

    def _place_planar_bodies(self, frames: Sequence[BodyFrame], q: Array) -> None:
        """Place all bodies in the plane that no modes move, at once: a guide asks for many positions."""
        own = [(i, f.first, f.size) for i, f in enumerate(frames) if f.bent is None]
        if not own:
            return
        at, first, size = np.array(own).T
        self.centres[at, 0], self.centres[at, 1] = q[first], q[first + 1]
        turning, angle = at[size == 3], first[size == 3] + 2
        c, s = np.cos(q[angle]), np.sin(q[angle])
        self.turns[turning, 0, 0], self.turns[turning, 0, 1] = c, -s
        self.turns[turning, 1, 0], self.turns[turning, 1, 1] = s, c

    def _place_bent(self, i: int, bent: Bent, q: Array) -> None:
        """Place what modes of a body move; its turn is the rotation of the Euler parameters (1, p)."""
        m = q[bent.first : bent.first + len(bent.shape)]
        p = 0.5 * (m @ np.array(bent.turn).reshape(-1, 3))
        if not self._spatial:
            p = np.tan(p)  # of half the angle: in the plane the angle is exact
        size = np.sqrt(1.0 + p @ p)
        turn = rotation_matrix_of((1.0 / size, p[0] / size, p[1] / size, p[2] / size))
        at = np.array(bent.place) + m @ np.array(bent.shape).reshape(-1, 3)
        self.centres[i] = self.to_ground(bent.host, [at])[0]
        self.turns[i] = self.turns[bent.host] @ np.array(turn)

    def to_ground(self, body: int, points: Sequence[Sequence[float]] | Array) -> Array:
        """Return points of a body in the ground frame, shape (k, 3)."""
        return np.asarray(self.centres[body] + np.asarray(points, dtype=np.float64) @ self.turns[body].T)

    def to_body(self, body: int, points: Array) -> Array:
        """Return points of the ground frame as points of a body, shape (k, 3)."""
        return np.asarray((np.asarray(points) - self.centres[body]) @ self.turns[body])


def axis_against_gravity(gravity: Sequence[float], spatial: bool) -> Point:
    """Return the axis that points most against gravity."""
    if not any(gravity):
        return (0.0, 0.0, 1.0) if spatial else (0.0, 1.0, 0.0)
    k = int(np.argmax(np.abs(gravity)))
    up = [0.0, 0.0, 0.0]
    up[k] = -float(np.sign(gravity[k]))
    return (up[0], up[1], up[2]) if spatial else (0.0, 1.0, 0.0)

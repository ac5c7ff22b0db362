"""The described mechanism: the frozen value that enters the pipeline. No SymPy, no NumPy."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Literal, TypeVar

import msgspec

from symgen.base.arguments import kind_of_value
from symgen.base.errors import InputError, suggest
from symgen.base.units import Unit, known_unit
from symgen.base.vocabulary.expressions import ZERO, Expr
from symgen.base.vocabulary.measures import Direction, Effort, Flexure, Marker, Measure, Row
from symgen.base.vocabulary.rotations import IDENTITY, Orientation
from symgen.describe.bounded import BoundedRow
from symgen.describe.modal_body import COORDINATE, SPEED, CarriedInterface, Modal
from symgen.describe.run_defaults import Defaults
from symgen.describe.spanning_tree import Topology
from symgen.describe.table_functions import Table

T = TypeVar("T")

#: Components of a vector: two in the plane, three in space.
Vec = tuple[Expr, ...]


class Parameter(msgspec.Struct, frozen=True, omit_defaults=True):
    """A named number that stays adjustable at run time (``p`` of the emitted functions).

    One with a `formula` follows the parameters in it, unless it is set to a number itself; `value` is its value
    with their defaults, in SI units as `unit` is. An `input` is a number that comes from outside: it may change during
    a run, so only functions of the state have it.
    """

    name: str
    value: float
    # kernels are identified by the text of their elements, which stays unchanged for mere numbers
    unit: str = msgspec.field(default_factory=str)  # written even where it is empty
    note: str = msgspec.field(default_factory=str)
    formula: Expr | None = None
    input: bool = False
    shown: str = ""  # unit in which the file gives it and people read it, where that is not `unit`

    @property
    def own_unit(self) -> Unit:
        """The unit of the file."""
        return known_unit(self.shown or self.unit)

    def as_written(self, value: float) -> tuple[float, str]:
        """Return a value of it, in SI units, as a number in the unit of the file, and this unit."""
        return (self.own_unit.from_si(value), self.shown) if self.shown else (value, self.unit)


class Body(msgspec.Struct, frozen=True):
    """A planar rigid body or point mass, a modal body, or an interface that a modal body carries.

    All points are relative to the body frame's origin; `position` is where that origin starts (approximately: assembly
    closes the mechanism) and `angle` how far the body frame is turned from the ground frame.
    """

    name: str
    mass: Expr
    inertia: Expr | None = None  # about the centre of mass [kg m^2]; None for a point mass, which has no angle
    centre_of_mass: Vec = (ZERO, ZERO)
    points: tuple[tuple[str, Vec], ...] = ()
    position: Vec = (ZERO, ZERO)
    angle: Expr = ZERO
    velocity: tuple[Expr | None, ...] = (None, None)  # of the centre of mass; None: completed by assembly
    angular_velocity: Expr | None = None
    modal: Modal | None = None
    carried: CarriedInterface | None = None

    @property
    def is_point(self) -> bool:
        """Whether the body is a point mass: coordinates x and y only."""
        return self.inertia is None

    @property
    def coordinates(self) -> tuple[str, ...]:
        """Names of the coordinates, without the body's."""
        return _names_of_body(self, ("x", "y"), ("theta",), COORDINATE)

    @property
    def speeds(self) -> tuple[str, ...]:
        """Names of the velocities, without the body's."""
        return _names_of_body(self, ("vx", "vy"), ("omega",), SPEED)

    @property
    def massless(self) -> bool:
        """Whether mass or inertia is the number 0."""
        return self.carried is None and ZERO in (self.mass, self.inertia)

    @property
    def weightless(self) -> bool:
        """Whether mass and inertia, if any, are the number 0."""
        return {self.mass, self.inertia} <= {ZERO, None}


class SpatialBody(msgspec.Struct, frozen=True):
    """A spatial rigid body or point mass, a modal body, or an interface that a modal body carries.

    As for a planar `Body`; `inertia` holds the entries (xx, yy, zz, xy, xz, yz) of the tensor about the centre of mass
    along the axes of the body frame, None for a point mass, which has no orientation. `angular_velocity` is given in
    body axes.
    """

    name: str
    mass: Expr
    inertia: tuple[Expr, Expr, Expr, Expr, Expr, Expr] | None = None
    centre_of_mass: Vec = (ZERO, ZERO, ZERO)
    points: tuple[tuple[str, Vec], ...] = ()
    position: Vec = (ZERO, ZERO, ZERO)
    orientation: Orientation = IDENTITY
    velocity: tuple[Expr | None, ...] = (None, None, None)
    angular_velocity: tuple[Expr | None, ...] = (None, None, None)
    modal: Modal | None = None
    carried: CarriedInterface | None = None

    @property
    def is_point(self) -> bool:
        """Whether the body is a point mass: coordinates x, y and z only."""
        return self.inertia is None

    @property
    def coordinates(self) -> tuple[str, ...]:
        """Names of the coordinates, without the body's."""
        return _names_of_body(self, ("x", "y", "z"), ("e0", "e1", "e2", "e3"), COORDINATE)

    @property
    def speeds(self) -> tuple[str, ...]:
        """Names of the velocities, without the body's."""
        return _names_of_body(self, ("vx", "vy", "vz"), ("wx", "wy", "wz"), SPEED)

    @property
    def massless(self) -> bool:
        """Whether a mass or moment of inertia is the number 0."""
        return self.carried is None and ZERO in (self.mass, *(self.inertia or ())[:3])

    @property
    def weightless(self) -> bool:
        """Whether mass and all moments of inertia are the number 0."""
        return {self.mass, *(self.inertia or ())[:3]} == {ZERO}


AnyBody = Body | SpatialBody


def _names_of_body(body: AnyBody, moving: tuple[str, ...], turning: tuple[str, ...], mode: str) -> tuple[str, ...]:
    """Return the names of coordinates or velocities of a body; an interface, which its body carries, has none."""
    if body.carried is not None:
        return ()
    own = moving if body.is_point else moving + turning
    return own if body.modal is None else own + body.modal.names(mode)


class Shape(msgspec.Struct, frozen=True):
    """Shape of a body in pictures, in its own frame.

    `kind` is ``polyline``, ``box``, ``cylinder``, ``sphere`` or ``mesh``; `sizes` holds the edges of a box, the radius
    of a sphere, radius and length of a cylinder [m]. A mesh is a `file` below `folder`, that of the mechanism file,
    stretched by `scale` along its axes, then turned by the Euler parameters `turn`.
    """

    kind: str
    points: tuple[Vec, ...] = ()
    closed: bool = False
    at: Vec = ()
    sizes: tuple[Expr, ...] = ()
    axis: Vec = ()
    colour: str = ""
    file: str = ""
    folder: str = ""
    scale: Vec = ()
    turn: tuple[float, float, float, float] = (1.0, 0.0, 0.0, 0.0)


class Joint(msgspec.Struct, frozen=True):
    """A joint, driver or nonholonomic condition of any kind, resolved to rows on measures.

    The first body of `bodies` is the one on which reactions are reported; `coordinates` are the measures that results
    report, e.g. ``("angle", Angle(a, b))``.
    """

    name: str
    kind: str
    bodies: tuple[str, ...]
    rows: tuple[Row, ...]
    coordinates: tuple[tuple[str, Measure], ...] = ()

    @staticmethod
    def unit(label: str) -> str:
        """Return the unit of a coordinate: labels of angles begin with ``angle``, all others are lengths."""
        return "rad" if label.startswith("angle") else "m"


class Rotor(msgspec.Struct, frozen=True):
    """A rotor that turns with the coordinate of a joint: its energy is half of `inertia` times the square of that rate.

    The coordinate is an angle, or the displacement of a slide, for which `inertia` is a mass.
    In space `axes` are those of the two bodies that the joint holds parallel, if it does.
    """

    joint: str
    angle: Measure
    inertia: Expr
    axes: tuple[Direction, ...] = ()


class Force(msgspec.Struct, frozen=True, omit_defaults=True, repr_omit_defaults=True):
    """A force element of any kind, resolved to efforts along measures and to beam elements."""

    name: str
    kind: str
    bodies: tuple[str, ...]
    efforts: tuple[Effort, ...]
    flexures: tuple[Flexure, ...] = ()  # without any, texts stay unchanged


class StateVariable(msgspec.Struct, frozen=True):
    """A state of the file's own, x' = `rate`, a formula of t, parameters, inputs, the motion and all such states."""

    name: str
    start: Expr
    rate: Expr
    unit: str = ""


class Output(msgspec.Struct, frozen=True):
    """A formula that results report; it may read quantities of outputs (`symgen.describe.formulas.readings`)."""

    name: str
    value: Expr
    unit: str = ""


class OperatingLimit(msgspec.Struct, frozen=True):
    """What an output or a parameter may be at least and at most, in the unit of its values; reports compare."""

    name: str
    smallest: Expr | None = None
    largest: Expr | None = None


class Hold(msgspec.Struct, frozen=True):
    """A quantity that a start keeps while assembly moves all others.

    `name` is a coordinate or velocity of a body (``crank.theta``, ``rod.vx``), the orientation of a body in space
    (``rod.orientation``), or a joint coordinate or its rate (``motor.angle``, ``motor.angle.rate``).
    """

    name: str
    value: Expr | None = None  # None: as the body is described


def with_largest_step(mechanism: Mechanism, max_step: float | None) -> Mechanism:
    """Return a mechanism with another largest step of adaptive runs [s]; itself where that is None."""
    if max_step is None:
        return mechanism
    return msgspec.structs.replace(mechanism, defaults=msgspec.structs.replace(mechanism.defaults, max_step=max_step))


class Event(msgspec.Struct, frozen=True):
    """A condition that is watched during a run.

    `when` is a switching function: the event happens where it passes through zero, upwards (``rising``), downwards
    (``falling``) or both (``any``); `text` is the condition as written. `reset` holds velocities and their new values.
    """

    name: str
    when: Expr
    direction: str
    action: str
    reset: tuple[tuple[Expr, Expr], ...] = ()
    text: str = ""


class ModeEvent(Event, frozen=True):
    """An event of a row with bounds, at which modes are chosen anew.

    `word` says what happens to the row, and `row` is its number among the rows with bounds of a mechanism.
    """

    word: str = ""
    row: int = -1


class Holding(msgspec.Struct, frozen=True):
    """A joint whose rows are in force for a while.

    Where a run begins they are in force if `first`, a formula of parameters, is 1, and off if it is 0. They come into
    force where `catches` becomes larger than 0, and are off again where `releases` does; None where they never do. A
    joint that holds `present` positions keeps those of the catch. Where `first` is the value of a condition on the
    described positions, `described` is "positions", and "velocities" where it reads these too.
    """

    joint: str
    first: Expr
    catches: Expr | None = None
    releases: Expr | None = None
    present: bool = False
    described: Literal["", "positions", "velocities"] = ""


class Mechanism(msgspec.Struct, frozen=True, weakref=True):
    """A validated mechanism, all of it planar or all of it spatial.

    Bodies, joints and forces keep the order of the file, which is the order of coordinates and multipliers.
    """

    name: str
    title: str
    space: str
    gravity: Vec
    parameters: tuple[Parameter, ...]
    tables: tuple[Table, ...]
    bodies: tuple[Body, ...] | tuple[SpatialBody, ...]
    joints: tuple[Joint, ...]
    forces: tuple[Force, ...]
    defaults: Defaults = Defaults()
    outputs: tuple[Output, ...] = ()
    seats: tuple[tuple[str, Marker], ...] = ()  # joint -> its point ``at`` on its first body, where it has one
    holds: tuple[Hold, ...] = ()
    events: tuple[Event, ...] = ()
    cuts: tuple[str, ...] = ()  # joints that carry nothing where the state is that of a tree
    shapes: tuple[tuple[str, Shape], ...] = ()  # body -> its shape, several entries for several shapes
    topology: Topology | None = None  # where joint coordinates are the state; joints of the tree have no rows then
    input_formulas: tuple[tuple[str, Expr], ...] = ()  # input -> the formula that replaces it in a run
    states: tuple[StateVariable, ...] = ()
    rotors: tuple[Rotor, ...] = ()
    beams: bytes = b""  # the description as JSON if it has beams, to change their number of elements
    switchable: tuple[str, ...] = ()  # joints whose rows may be off in a part of a run
    bounded: tuple[BoundedRow, ...] = ()  # their rows follow those of joints; one-sided ones are last
    limits: tuple[OperatingLimit, ...] = ()  # of outputs and parameters: nothing is computed with them
    author: str = ""  # as is the title, for people
    revision: str = ""
    holding: tuple[Holding, ...] = ()  # those of `switchable` whose states and events say where they are in force
    restitution_law: str = "newton"  # or "poisson", of impacts at one-sided rows
    remarks: tuple[str, ...] = ()  # what a reader of any result has to know; `symgen.describe.files.remarks`

    def __repr__(self) -> str:
        counted = (
            ([body for body in self.bodies if body.carried is None], "body", "bodies"),
            (self.joints, "joint", "joints"),
            (self.forces, "force", "forces"),
            (self.parameters, "parameter", "parameters"),
        )
        counts = ", ".join(f"{len(each)} {one if len(each) == 1 else more}" for each, one, more in counted)
        return f"<Mechanism {self.name}, {self.space}: {counts}>"

    @property
    def inputs(self) -> tuple[str, ...]:
        """Names of the inputs, which follow the other parameters."""
        return tuple(p.name for p in self.parameters if p.input)

    @property
    def has_modes(self) -> bool:
        """Whether rows may be off in a part of a run."""
        return bool(self.switchable or self.bounded)

    @property
    def has_massless(self) -> bool:
        """Whether a body has no mass, so that M cannot be inverted."""
        return any(body.massless for body in self.bodies)

    @property
    def has_modal_bodies(self) -> bool:
        """Whether a body has modes."""
        return any(body.modal is not None for body in self.bodies)

    @property
    def body_coordinates(self) -> int:
        """Number of coordinates of all bodies together."""
        return sum(len(body.coordinates) for body in self.bodies)

    def body(self, name: str) -> AnyBody:
        """Return the body called `name`.

        Raises
        ------
        InputError
            If the name is unknown; the message has the nearest one.
        """
        return self._find_by_name("body", {body.name: body for body in self.bodies}, name)

    def joint_named(self, name: str) -> Joint:
        """Return the joint called `name`; raises as `body` does."""
        return self._find_by_name("joint", {joint.name: joint for joint in self.joints}, name)

    def _find_by_name(self, kind: str, items: Mapping[str, T], name: str) -> T:
        if name not in items:
            raise InputError(kind, f"a {kind} of {self.name}", kind_of_value(name), suggest(str(name), items))
        return items[name]

"""The tables of a mechanism file, except joints and forces, whose kinds describe themselves."""

from __future__ import annotations

from typing import Any, Literal

import msgspec

from symgen.describe.parts.fields import (
    Duration,
    Flag,
    Held,
    Numbers,
    OutputFunction,
    Point,
    Points,
    Scalar,
    StateFunction,
    Tensor,
    Text,
    Vector,
)


class MechanismSection(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """The name of the mechanism and its space.

    Parameters
    ----------
    name : str
        Lower-case words joined by dashes.
    title, source : str
        One line for people; where the data come from.
    author, revision : str
        Who is responsible for the file, and its revision, for reports.
    space : str
        ``"planar"`` or ``"spatial"``.
    gravity : vector
        Gravitational acceleration in the ground frame [m/s^2]; none by default.
    restitution_law : str
        What a restitution is a ratio of at impacts: ``"newton"`` of rates, ``"poisson"`` of impulses.
    remarks : list of str
        What a reader of any result has to know, such as what an import left out; every result repeats it.
    shape : table, or list of tables
        A look of the ground in pictures, as bodies have; none by default.
    """

    name: Text
    title: Text = ""
    source: Text = ""
    author: Text = ""
    revision: Text = ""
    remarks: tuple[Text, ...] = ()
    space: Literal["planar", "spatial"] = "planar"
    gravity: Vector | None = None
    restitution_law: Literal["newton", "poisson"] = "newton"
    shape: ShapeSection | tuple[ShapeSection, ...] | None = None


class RunSection(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """What a run uses where nothing else is asked for; numbers are in seconds, texts have their unit, as ``"4 min"``.

    Parameters
    ----------
    integrator : str
        The integrator, or auto; absent: that of the method.
    until, step, output_step : float
        End, step size and distance between outputs. A step is the first one of an adaptive run; constant steps without
        one are a millisecond, or a hundredth of a shorter end.
    max_step : float
        Largest step of adaptive integrators.
    predictable_until : float
        How long a chaotic motion can be predicted; absent where it is not chaotic.
    verify : bool
        Whether a second, finer run estimates the error; absent: where it takes little time.
    """

    integrator: Text | None = None
    until: Duration = 10.0
    step: Duration | None = None
    output_step: Duration | None = None
    max_step: Duration | None = None
    predictable_until: Duration | None = None
    verify: bool | None = None


class ParameterSection(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """A number that stays adjustable at run time, given as ``name = 2.0`` or with its unit as a table.

    Parameters
    ----------
    value : float or str
        The default; a formula of other parameters is worked out anew where these are changed.
    unit : str
        Unit of a number, such as ``"mm"``; SI by default. In formulas every name stands for its value in SI units.
    note : str
        For people.
    smallest, largest : scalar
        Limits with which reports compare the value: numbers in `unit` or with their own, or formulas of parameters.
    """

    value: Scalar
    unit: Text = ""
    note: Text = ""
    smallest: Scalar | None = None
    largest: Scalar | None = None


class InputSection(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """A number from outside, such as a motor's torque, given as ``name = 0.0`` or with its unit as a table.

    Parameters
    ----------
    default : float or str
        What it is where a run is given nothing else; a formula may use parameters.
    unit : str
        Unit of the number, and of what a run is given as text or in a file; SI by default.
    note : str
        For people.
    """

    default: Scalar
    unit: Text = ""
    note: Text = ""


class StateSection(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """A state of your own, such as a current or a pressure, which every formula of the state may read by its name.

    Parameters
    ----------
    rate : state function
        Its rate of change, a formula of t, parameters, inputs, the motion and all states [its unit a second].
    start : scalar
        Its value where a run begins; 0 by default.
    unit : str
        Its SI unit, for people.
    """

    rate: StateFunction
    start: Scalar = 0.0
    unit: Text = ""


class TableSection(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """A function of one argument by interpolation; called as ``NAME(x)``.

    Parameters
    ----------
    x, y : list of float
        Points, `x` increasing.
    interpolation : str
        ``"linear"``: straight lines, constant beyond the ends. ``"cubic"``: a spline with two continuous derivatives.
        ``"pchip"``: cubic pieces with one, which stay between the values of the points. The last two go on in straight
        lines beyond the ends; motions of drivers may use ``"cubic"``.
    periodic : bool
        Whether a smooth one repeats itself, its last value being its first.
    """

    x: Numbers
    y: Numbers
    interpolation: Literal["linear", "cubic", "pchip"] = "linear"
    periodic: Flag = False


class RayTable(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """A ray, of a lidar for one, whose distance from the nearest shape an output reports; in the plane.

    Parameters
    ----------
    body : str
        Its body, or ``"ground"``.
    at : point
        Where it begins; the origin of the body by default.
    direction : vector
        Where it leads, in the frame of its body.
    reach : scalar
        The distance that it reports where it meets nothing nearer [m].
    shapes : list of tables
        What it may meet: discs, segments, lines and outlines, as of contacts.
    """

    body: str
    at: Point = (0.0, 0.0)
    direction: Vector
    reach: Scalar
    shapes: tuple[dict[str, Any], ...]


class OutputSection(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """A formula that results report, given as ``name = "arm.tip.x"`` or with its unit as a table.

    Parameters
    ----------
    value : function of the motion
        An expression of t, parameters, body coordinates, points, joint coordinates, forces and accelerations.
    ray : table
        In its place, a ray.
    unit : str
        Unit of the number that the formula gives.
    smallest, largest : scalar
        Limits with which reports compare it: numbers in `unit` or with their own, or formulas of parameters.
    """

    value: OutputFunction | None = None
    ray: RayTable | None = None
    unit: Text = ""
    smallest: Scalar | None = None
    largest: Scalar | None = None


class ShapeSection(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """What a body looks like in pictures, in its own frame; nothing else depends on it.

    Parameters
    ----------
    type : str
        ``"polyline"``, ``"box"``, ``"cylinder"``, ``"sphere"`` or ``"mesh"``.
    points : list of vectors
        Of a polyline [m].
    closed : bool
        Whether a polyline is an area.
    at : point
        Middle of a box, cylinder or sphere, origin of a mesh; the centre of mass by default.
    size : vector
        Edges of a box along the body's axes [m].
    radius : scalar
        Of a cylinder or sphere [m].
    length : scalar
        Of a cylinder in space [m]; in the plane it is seen from its end.
    axis : vector
        Direction of a cylinder in space; z by default.
    file : str
        STL or OBJ file of a mesh in space, in or below the folder of the mechanism file.
    scale : vector
        Factors of a mesh along its axes; 1 by default.
    orientation : table
        How a mesh is turned in the body's frame, in numbers; not at all by default.
    colour : str
        ``"#rrggbb"``; one of its own for each body by default.
    """

    type: Literal["polyline", "box", "cylinder", "sphere", "mesh"]
    points: tuple[Vector, ...] | None = None
    closed: Flag = False
    at: Point = "centre"
    size: Vector | None = None
    radius: Scalar | None = None
    length: Scalar | None = None
    axis: Vector | None = None
    file: Text = ""
    scale: Vector | None = None
    orientation: OrientationSection | None = None
    colour: Text = ""


class AnyBodySection(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """A rigid body or point mass.

    Parameters
    ----------
    type : str
        ``"rigid"`` or ``"point"``; a point mass has no inertia and no points, and does not turn.
    mass : scalar
        [kg], above 0.
    centre_of_mass : vector
        In the body's frame [m]; its origin by default.
    points : table
        Named points in the body's frame [m].
    position : vector
        Where the origin of the body's frame starts [m]; approximately, as assembly closes the mechanism.
    velocity : vector
        Of the centre of mass at the start, in ground axes [m/s]; completed by assembly by default.
    hold : bool, str or list of str
        Which of the described ``"position"`` (of the centre of mass), ``"angle"`` (in space the orientation) and
        ``"velocity"`` (both of them) assembly keeps while it moves everything else; all that are given where it is
        true.
    shape : table, or list of tables
        What the body looks like in pictures; bars and plates through its points by default.
    """

    type: Literal["rigid", "point"] = "rigid"
    mass: Scalar
    centre_of_mass: Vector | None = None
    points: Points | None = None
    position: Vector | None = None
    velocity: Vector | None = None
    hold: Held = False
    shape: ShapeSection | tuple[ShapeSection, ...] | None = None


class BodySection(AnyBodySection, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """A planar rigid body or point mass.

    Parameters
    ----------
    inertia : scalar
        About the centre of mass [kg m^2], above 0.
    angle : scalar
        How far the body's frame is turned at the start [rad].
    angular_velocity : scalar
        At the start [rad/s]; completed by assembly by default.
    """

    inertia: Scalar | None = None
    angle: Scalar | None = None
    angular_velocity: Scalar | None = None


class OrientationSection(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """How a body's frame is turned at the start, in one of five ways.

    Parameters
    ----------
    quaternion : list of 4
        Euler parameters e0, e1, e2, e3; their length does not matter.
    rotation_vector : vector
        Axis times angle [rad].
    euler_angles : vector
        Three angles [rad] about the axes that `convention` names, each as the turns before have left it.
    convention : str
        Such as ``"zxz"`` or ``"zyx"``; for `euler_angles`.
    x_axis, y_axis : vector
        The frame's x axis in the ground frame, and a vector on the side of its y axis.
    start, end : vector
        Two points in the ground frame that the x axis leads from and to, with `y_axis`.
    """

    quaternion: Tensor | None = None
    rotation_vector: Vector | None = None
    euler_angles: Vector | None = None
    convention: Text | None = None
    x_axis: Vector | None = None
    y_axis: Vector | None = None
    start: Vector | None = None
    end: Vector | None = None


class SpatialBodySection(AnyBodySection, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """A spatial rigid body or point mass.

    Parameters
    ----------
    inertia : list of 3 or 6, or three rows
        Tensor [kg m^2] as ``[Ixx, Iyy, Izz]``, with products ``[..., Ixy, Ixz, Iyz]`` or as a matrix; the products are
        entries of the tensor, Ixy = - integral of x y dm.
    inertia_at : point
        The point that `inertia` refers to; the centre of mass by default.
    inertia_axes : table
        How the axes of `inertia` are turned against the body's frame, in numbers; not at all by default.
    orientation : table
        How the body's frame is turned at the start; not at all by default.
    angular_velocity : vector
        At the start, in body axes [rad/s]; completed by assembly by default.
    """

    inertia: Tensor | None = None
    inertia_at: Point | None = None
    inertia_axes: OrientationSection | None = None
    orientation: OrientationSection | None = None
    angular_velocity: Vector | None = None

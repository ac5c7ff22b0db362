"""Tables of outlines in files."""

from __future__ import annotations

import msgspec

from symgen.describe.parts.fields import BodyName, CurveFunction, Flag, OutlinePoints, Pair, Scalar, Text, Vector


class PolygonTable(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """A regular polygon.

    Parameters
    ----------
    sides : int
        Number of its sides.
    radius : scalar
        Distance of its corners from the centre [m].
    """

    sides: int
    radius: Scalar


class GearTable(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """A spur gear with involute teeth, the middle of one of which is on the first axis.

    Parameters
    ----------
    module : scalar
        Diameter of the pitch circle over the number of teeth [m].
    teeth : int
        Number of teeth.
    pressure_angle : float
        Angle of the flanks on the pitch circle [rad]; 20 degrees by default.
    addendum, dedendum : float
        Height and depth of teeth beyond and within the pitch circle, over the module.
    thinner : float
        What a tooth lacks of half of the pitch, on the pitch circle and over the module: play.
    tolerance : float
        Largest distance of the arcs from the involute over the module; two gears touch by the involute itself.
    """

    module: Scalar
    teeth: int
    pressure_angle: float = 0.3490658503988659
    addendum: float = 1.0
    dedendum: float = 1.25
    thinner: float = 0.0
    tolerance: float = 1e-4


class PointTable(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """A point of an outline, and the piece that leads to it: an arc by its radius or its bulge, otherwise a segment.

    Parameters
    ----------
    to : vector
        The point [m].
    radius : scalar
        Radius of the arc [m], above 0 where it bulges towards the free side.
    large : bool
        Whether the arc is the larger one of two with the radius.
    bulge : scalar
        Tangent of a quarter of the arc's angle, as in DXF files: above 0 where it turns to the left.
    fillet : scalar
        Radius of a fillet at the point [m].
    """

    to: Vector
    radius: Scalar | None = None
    large: Flag = False
    bulge: Scalar | None = None
    fillet: Scalar | None = None


class OutlineSection(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """An outline of a body or of the ground, which discs, lines and outlines of other bodies meet.

    The free side of a closed one is outside, that of an open one on the left of the way along its points.

    Parameters
    ----------
    body : str
        Its body, or ``"ground"``.
    points : list of points or tables
        Corners ``[x, y]``, or ``{ to = [x, y], radius = R }`` and ``{ to = [x, y], bulge = B }`` at the end of an arc.
    closed : bool
        Whether the last point is joined to the first one.
    inside : bool
        Whether the free side of a closed one is inside, as of a slot.
    polygon : table
        In place of points, ``{ sides = N, radius = R }``.
    gear_profile : table
        In place of points, a spur gear, ``{ module = M, teeth = N }``.
    box : two scalars
        In place of points, width and height [m].
    file : str
        In place of points, a drawing of one chain in any order: a DXF file, or an SVG file with one path, in or below
        the folder of the mechanism file. An open chain goes the way of its first part.
    path : str
        In place of points, path data of SVG. In them and in SVG files y is turned upwards.
    radius : formula
        In place of points, the distance of a closed curve from `at` [m] by its direction ``phi`` [rad], from 0 to 2 pi:
        a formula of it, numbers and smooth tables.
    unit : scalar
        Length of a unit of the drawing [m]; of a DXF file its own unit by default.
    tolerance : scalar
        Largest distance of arcs from other curves [m]; 1e-5 of the size of all by default.
    layer : str
        Layer of a DXF file on which the outline is; all by default.
    at : vector
        Centre of a polygon, a box, a gear or a radius, origin of a drawing; the origin by default [m].
    angle : scalar
        How far it is turned [rad]; a corner of a polygon is on the first axis otherwise.
    fillet : scalar
        Radius of fillets at all corners [m].
    """

    body: BodyName
    points: OutlinePoints | None = None
    closed: Flag = False
    inside: Flag = False
    polygon: PolygonTable | None = None
    gear_profile: GearTable | None = None
    box: Pair | None = None
    file: Text | None = None
    path: Text | None = None
    radius: CurveFunction | None = None
    unit: Scalar | None = None
    tolerance: Scalar | None = None
    layer: Text | None = None
    at: Vector | None = None
    angle: Scalar | None = None
    fillet: Scalar | None = None

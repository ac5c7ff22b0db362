"""Bodies of a mechanism file and their shapes in pictures: sections in, frozen bodies and shapes out."""

from __future__ import annotations

import re
from collections.abc import Mapping
from typing import TYPE_CHECKING

from symgen.base.errors import quote, suggest
from symgen.base.vocabulary.expressions import ONE, ZERO, Expr, call, literal_of, product, sum_of_terms
from symgen.base.vocabulary.measures import GROUND
from symgen.base.vocabulary.rotations import CONVENTIONS, IDENTITY, Matrix, Orientation, rotation_matrix_of
from symgen.describe.formulas.identifiers import check_identifier
from symgen.describe.formulas.start import Scalars, euler_parameters
from symgen.describe.mechanism import Body, Shape, SpatialBody, Vec
from symgen.describe.parts.fields import read_table, value_in_words
from symgen.describe.parts.mesh_files import SUFFIXES, is_inner_path
from symgen.describe.parts.scope import CENTRE, ORIGIN
from symgen.describe.parts.sections import BodySection, OrientationSection, ShapeSection, SpatialBodySection

if TYPE_CHECKING:
    from symgen.describe.parts.scope import Scope


Tensor = tuple[Expr, Expr, Expr, Expr, Expr, Expr]


def is_modal(table: object) -> bool:
    """Whether the table of a body describes a modal one, which `symgen.describe.modal` reads."""
    return isinstance(table, Mapping) and table.get("type") == "modal"


def planar_body(scope: Scope, raw: object) -> Body:
    """Return the planar body that a table describes."""
    section = read_table(BodySection, _without_shape(raw), scope.where(""))
    _check_type(scope, section, ("inertia", "angle", "angular_velocity", "points", "centre_of_mass"))
    position, centre, velocity, points = _read_common_keys(scope, section)
    return Body(
        name=scope.name,
        mass=scope.constant("mass", section.mass, positive=True, or_zero=True),
        inertia=None
        if section.inertia is None
        else scope.constant("inertia", section.inertia, positive=True, or_zero=True),
        centre_of_mass=centre,
        points=points,
        position=position,
        angle=ZERO if section.angle is None else scope.constant("angle", section.angle),
        velocity=velocity,
        angular_velocity=scope.optional("angular_velocity", section.angular_velocity),
    )


def spatial_body(scope: Scope, raw: object) -> SpatialBody:
    """Return the spatial body that a table describes."""
    section = read_table(SpatialBodySection, _without_shape(raw), scope.where(""))
    keys = ("inertia", "inertia_at", "inertia_axes", "orientation", "angular_velocity", "points", "centre_of_mass")
    _check_type(scope, section, keys)
    position, centre, velocity, points = _read_common_keys(scope, section)
    mass = scope.constant("mass", section.mass, positive=True, or_zero=True)
    return SpatialBody(
        name=scope.name,
        mass=mass,
        inertia=None if section.inertia is None else _read_inertia(scope, section, mass, centre, dict(points)),
        centre_of_mass=centre,
        points=points,
        position=position,
        orientation=read_orientation(scope, "orientation", section.orientation),
        velocity=velocity,
        angular_velocity=optional_vector(scope, "angular_velocity", section.angular_velocity),
    )


def _without_shape(raw: object) -> object:
    """Return the table of a body without its shapes, which `symgen.describe.parts.bodies` reads."""
    return {key: value for key, value in raw.items() if key != "shape"} if isinstance(raw, Mapping) else raw


def _check_type(scope: Scope, section: BodySection | SpatialBodySection, keys: tuple[str, ...]) -> None:
    if section.type == "point":
        for key in keys:
            if getattr(section, key) is not None:
                raise scope.error(key, "no such key, as a point mass has none", value_in_words(getattr(section, key)))
    elif section.inertia is None:
        hint = 'a body without one is written type = "point"'
        raise scope.error("inertia", "the inertia about the centre of mass", "no such key", hint)


_Common = tuple[Vec, Vec, tuple[Expr | None, ...], tuple[tuple[str, Vec], ...]]


def _read_common_keys(scope: Scope, section: BodySection | SpatialBodySection) -> _Common:
    """Return position, centre of mass, velocity and points."""
    nothing = (0.0,) * scope.dimension
    points = []
    for point, coordinates in (section.points or {}).items():
        check_identifier(point, scope.where("points"), "point")
        if point == CENTRE:
            raise scope.error("points", "another name", f"'{CENTRE}', which is the centre of mass")
        points.append((point, scope.vector(f"points.{point}", coordinates)))
    return (
        scope.vector("position", nothing if section.position is None else section.position),
        scope.vector("centre_of_mass", nothing if section.centre_of_mass is None else section.centre_of_mass),
        optional_vector(scope, "velocity", section.velocity),
        tuple(points),
    )


def optional_vector(scope: Scope, key: str, vector: tuple[float | str, ...] | None) -> tuple[Expr | None, ...]:
    """Return a vector, or a None for each component where there is none."""
    return (None,) * scope.dimension if vector is None else scope.vector(key, vector)


# -- orientation and inertia in space --------------------------------------------------------------------------------


def read_orientation(scope: Scope, key: str, section: OrientationSection | None) -> Orientation:
    """Return the orientation of a table; without one a frame is not turned."""
    if section is None:
        return IDENTITY
    ways = ("quaternion", "rotation_vector", "euler_angles", "x_axis", "start")
    written = [way for way in ways if getattr(section, way) is not None]
    if len(written) != 1:
        got = "none" if not written else " and ".join(written)
        raise scope.error(key, f"one of the keys {', '.join(ways)}", got)
    way = written[0]
    needs = {"euler_angles": ("convention",), "x_axis": ("y_axis",), "start": ("end", "y_axis")}.get(way, ())
    for other in ("convention", "y_axis", "end"):
        if (getattr(section, other) is None) == (other in needs):
            got = "no such key" if other in needs else value_in_words(getattr(section, other))
            raise scope.error(f"{key}.{other}", "a value" if other in needs else f"no such key beside {way}", got)
    if way == "quaternion":
        four = section.quaternion or ()
        if len(four) != 4 or any(isinstance(e, tuple) for e in four):
            raise scope.error(f"{key}.quaternion", "four numbers [e0, e1, e2, e3]", value_in_words(four))
        values = tuple(scope.constant(f"{key}.quaternion", e) for e in four if not isinstance(e, tuple))
    else:
        parts = [(way, getattr(section, way)), *((n, getattr(section, n)) for n in needs if n != "convention")]
        values = tuple(e for name, part in parts for e in scope.vector(f"{key}.{name}", part))
    convention = section.convention or ""
    if way == "euler_angles" and convention not in CONVENTIONS:
        got = quote(convention)
        raise scope.error(f"{key}.convention", "three axes such as 'zxz'", got, suggest(convention, CONVENTIONS))
    kind = {"x_axis": "axes", "start": "line"}.get(way, way.replace("_", "-"))
    orientation = Orientation(kind, values, convention)
    # says at once, and not at the first run, if it stands for nothing
    euler_parameters(orientation, Scalars(lambda e, _: scope.value(e, key)), scope.where(key))
    return orientation


def _read_inertia(scope: Scope, section: SpatialBodySection, mass: Expr, centre: Vec, points: dict[str, Vec]) -> Tensor:
    """Return the tensor about the centre of mass in body axes."""
    tensor = _tensor_entries(scope, section.inertia or ())
    if section.inertia_axes is not None:
        tensor = rotate_tensor(
            tensor, rotation_matrix_of(_numeric_orientation(scope, "inertia_axes", section.inertia_axes))
        )
    if section.inertia_at is not None:
        ends = zip(_read_point(scope, section.inertia_at, points, centre), centre, strict=True)
        tensor = shift_tensor(tensor, mass, tuple(call("sub", x, y) for x, y in ends))
    for name, entry in zip(("Ixx", "Iyy", "Izz"), tensor, strict=False):
        value = scope.value(entry, "inertia")
        if not value > 0 and entry != ZERO:
            raise scope.error("inertia", f"{name} about the centre of mass above 0", repr(value))
    _check_definite(scope, tensor)
    return tensor


def _check_definite(scope: Scope, tensor: Tensor) -> None:
    xx, yy, zz, xy, xz, yz = (scope.value(e, "inertia") for e in tensor)
    second = xx * yy - xy * xy
    third = xx * (yy * zz - yz * yz) - xy * (xy * zz - yz * xz) + xz * (xy * yz - yy * xz)
    if any(e != 0.0 for e in (xy, xz, yz)) and not (xx > 0.0 and second > 0.0 and third > 0.0):
        raise scope.error("inertia", "a positive definite tensor about the centre of mass", "one that is not")


def _tensor_entries(scope: Scope, entries: tuple[float | str | tuple[float | str, ...], ...]) -> Tensor:
    rows = [e for e in entries if isinstance(e, tuple)]
    flat = [scope.constant("inertia", e) for e in entries if not isinstance(e, tuple)]
    if not rows and len(flat) == 3:
        return flat[0], flat[1], flat[2], ZERO, ZERO, ZERO
    if not rows and len(flat) == 6:
        return flat[0], flat[1], flat[2], flat[3], flat[4], flat[5]
    if len(rows) == 3 and not flat and all(len(row) == 3 for row in rows):
        m = scope.symmetric("inertia", rows)
        return m[0][0], m[1][1], m[2][2], m[0][1], m[0][2], m[1][2]
    expected = "[Ixx, Iyy, Izz], [Ixx, Iyy, Izz, Ixy, Ixz, Iyz] or three rows of three"
    raise scope.error("inertia", expected, value_in_words(entries))


def _read_point(scope: Scope, point: str | tuple[float | str, ...], points: dict[str, Vec], centre: Vec) -> Vec:
    if not isinstance(point, str):
        return scope.vector("inertia_at", point)
    if point == ORIGIN and point not in points:
        return (ZERO,) * scope.dimension
    if point != CENTRE and point not in points:
        hint = suggest(point, [*points, CENTRE, ORIGIN])
        raise scope.error("inertia_at", "the name of a point", f"{quote(point)}, which is none", hint)
    return centre if point == CENTRE else points[point]


def _numeric_orientation(
    scope: Scope, key: str, section: OrientationSection | None
) -> tuple[float, float, float, float]:
    """Return the Euler parameters of an orientation that is given in numbers."""
    axes = read_orientation(scope, key, section)
    if not axes.is_numeric:
        raise scope.error(key, "numbers, no expressions of parameters", "an expression")
    return euler_parameters(axes, Scalars(lambda x, _: scope.value(x, key)), scope.where(key))


def rotate_tensor(tensor: Tensor, a: Matrix) -> Tensor:
    """Return A I A^T."""
    xx, yy, zz, xy, xz, yz = tensor
    rows = ((xx, xy, xz), (xy, yy, yz), (xz, yz, zz))

    def tensor_entry(i: int, j: int) -> Expr:
        pairs = [(k, n) for k in range(3) for n in range(3) if a[i][k] * a[j][n] != 0.0]
        return sum_of_terms(*(product(literal_of(a[i][k] * a[j][n]), rows[k][n]) for k, n in pairs))

    return (
        tensor_entry(0, 0),
        tensor_entry(1, 1),
        tensor_entry(2, 2),
        tensor_entry(0, 1),
        tensor_entry(0, 2),
        tensor_entry(1, 2),
    )


def shift_tensor(tensor: Tensor, mass: Expr, d: Vec) -> Tensor:
    """Return the tensor about the centre of mass, given about a point at distance d from it (Huygens, Steiner)."""

    def tensor_entry(i: int, j: int) -> Expr:
        if i == j:
            return product(mass, sum_of_terms(*(product(d[k], d[k]) for k in range(3) if k != i)))
        return call("neg", product(mass, d[i], d[j]))

    pairs = ((0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2))
    changes = [tensor_entry(i, j) for i, j in pairs]
    a, b, c, e, f, g = (
        value if change in (ZERO, literal_of(-0.0)) else call("sub", value, change)
        for value, change in zip(tensor, changes, strict=True)
    )
    return a, b, c, e, f, g


#: Type of a shape -> its required and its optional keys, besides `type` and `colour`.
KEYS: dict[str, tuple[tuple[str, ...], tuple[str, ...]]] = {
    "polyline": (("points",), ("closed",)),
    "box": (("size",), ("at",)),
    "cylinder": (("radius",), ("at", "length", "axis")),
    "sphere": (("radius",), ("at",)),
    "mesh": (("file",), ("at", "scale", "orientation")),
}
#: Maximum number of shapes of a body, and of points of a polyline.
MOST, MOST_POINTS = 100, 2000

_COLOUR = re.compile(r"#[0-9a-fA-F]{6}")


def read_shapes(scope: Scope, raw: object) -> tuple[Shape, ...]:
    """Return the shapes of a scope's body, from the key ``shape`` of its table: one or a list."""
    shapes = raw.get("shape", ()) if isinstance(raw, Mapping) else ()
    several = isinstance(shapes, list | tuple)
    tables = shapes if several else (shapes,)
    if len(tables) > MOST:
        raise scope.error("shape", f"at most {MOST} shapes", str(len(tables)))
    return tuple(_read_shape(scope, table, f"shape[{i}]" if several else "shape") for i, table in enumerate(tables))


def _middle_of_shape(scope: Scope, key: str, at: str | tuple[float | str, ...]) -> Vec:
    """Return the middle of a shape: of the ground, which has no centre of mass, by default its origin."""
    if scope.name == GROUND and at == CENTRE:
        return (ZERO,) * scope.dimension
    return scope.marker(key, scope.name, at).point


def _read_shape(scope: Scope, raw: object, key: str) -> Shape:
    section = read_table(ShapeSection, raw, scope.where(key))
    necessary, possible = KEYS[section.type]
    keys = set(raw) - {"type", "colour"} if isinstance(raw, Mapping) else set()
    if not scope.spatial and section.type == "cylinder":
        possible = ("at",)
    if scope.spatial and section.type == "cylinder":
        necessary, possible = (*necessary, "length"), ("at", "axis")
    for name in necessary:
        if name not in keys:
            raise scope.error(f"{key}.{name}", f"a value, as a {section.type} needs it", "no such key")
    for name in sorted(keys - {*necessary, *possible}):
        raise scope.error(
            f"{key}.{name}", f"no such key for a {section.type} here", value_in_words(getattr(section, name))
        )
    if section.colour and not _COLOUR.fullmatch(section.colour):
        raise scope.error(f"{key}.colour", "a colour such as '#3a7bd5'", quote(section.colour))
    if section.type == "mesh":
        if not scope.spatial:
            raise scope.error(f"{key}.type", "another shape, as meshes are drawn in space", quote(section.type))
        if not is_inner_path(section.file):
            expected = f"a relative path of a {' or '.join(SUFFIXES)} file below the folder of the mechanism file"
            raise scope.error(f"{key}.file", expected, quote(section.file))
    points = section.points or ()
    if section.type == "polyline" and not 2 <= len(points) <= MOST_POINTS:
        raise scope.error(f"{key}.points", f"2 to {MOST_POINTS} points", str(len(points)))
    sizes = section.size or ()
    if section.size is not None and len(sizes) != scope.dimension:
        raise scope.error(f"{key}.size", f"{scope.dimension} lengths", value_in_words(section.size))
    numbers = [*(("size", e) for e in sizes), ("radius", section.radius), ("length", section.length)]
    up = (ZERO,) * (scope.dimension - 1) + (ONE,)
    return Shape(
        section.type,
        points=tuple(scope.vector(f"{key}.points", point) for point in points),
        closed=section.closed,
        at=_middle_of_shape(scope, f"{key}.at", section.at),
        sizes=tuple(scope.constant(f"{key}.{name}", e, positive=True) for name, e in numbers if e is not None),
        axis=up if section.axis is None else scope.direction(f"{key}.axis", scope.name, section.axis).vector,
        colour=section.colour.lower(),
        file=section.file,
        folder=getattr(scope.context.source, "folder", "") if section.file else "",
        scale=() if section.scale is None else scope.vector(f"{key}.scale", section.scale),
        turn=_numeric_orientation(scope, f"{key}.orientation", section.orientation),
    )

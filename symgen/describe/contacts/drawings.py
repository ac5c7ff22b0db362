"""Outlines from curves: DXF and SVG files, path data of SVG, and radii by their direction."""

from __future__ import annotations

import math
import xml.etree.ElementTree as ET
from collections.abc import Iterator, Sequence
from itertools import pairwise
from pathlib import Path
from typing import TYPE_CHECKING

from symgen.base.errors import quote
from symgen.base.files import file_beside, need_library, system_message
from symgen.describe.contacts.arcs_along import Bulged, NotSmooth, Stretch, arcs_along, bulged
from symgen.describe.contacts.drawn_curves import BadDrawing, ellipse, read_path
from symgen.describe.contacts.outline_sections import OutlineSection
from symgen.describe.contacts.polar_curves import polar_curve
from symgen.describe.parts.fields import value_in_words
from symgen.describe.parts.scope import Scope

if TYPE_CHECKING:
    from ezdxf.entities import DXFGraphic
    from ezdxf.math import BSpline, Vec3

#: Largest file [bytes], and most entities of a chain.
_LARGEST, _MOST = 20_000_000, 2000
#: Metres of the units that DXF files name, by their number in `$INSUNITS`.
_UNITS = {1: 0.0254, 2: 0.3048, 4: 1e-3, 5: 1e-2, 6: 1.0, 13: 1e-6, 14: 0.1}
#: Keys that give a curve.
DRAWN = ("file", "path", "radius")
#: Over the size of a drawing: the tolerance of arcs by default, and the gap between two ends that are one.
_TOLERANCE, _JOINED = 1e-5, 1e-6
#: What is written beside a drawing.
_BESIDE = frozenset({"TEXT", "MTEXT", "DIMENSION", "POINT", "LEADER", "MULTILEADER", "VIEWPORT", "HATCH"})


def read_drawing(scope: Scope, section: OutlineSection) -> tuple[list[Bulged], bool, str]:
    """Return the points of an outline by curves with the bulges before them, whether it is closed, and words on it.

    Raises
    ------
    InputError
        With the key that is wrong.
    """
    key = next(key for key in DRAWN if getattr(section, key) is not None)
    try:
        stretches, closed, unit, name = _of_section(scope, section)
        if not stretches or len(stretches) > _MOST:
            raise BadDrawing(f"a chain of 1 to {_MOST} parts", f"{len(stretches)} parts")
        points = [x.at(i / 8.0)[0] for x in stretches for i in range(9)]
        width, height = (max(x) - min(x) for x in ([p.real for p in points], [p.imag for p in points]))
        tolerance = _TOLERANCE * max(width, height)
        if section.tolerance is not None:
            tolerance = scope.value(scope.constant("tolerance", section.tolerance, positive=True), "tolerance") / unit
        chain = arcs_along(stretches, closed, tolerance)
    except BadDrawing as error:
        raise scope.error(key, error.expected, error.got) from None
    except NotSmooth:
        raise scope.error(
            "tolerance", "curves that arcs come near to", "one with a cusp, or too small a number"
        ) from None
    if closed:
        chain[-1] = stretches[0].start, chain[-1][1]
    words = f"from {name}, unit {unit:.6g} m, curves by arcs within {tolerance * unit:.3g} m"
    return [(unit * point, bulge) for point, bulge in [(stretches[0].start, 0.0), *chain]], closed, words


def _of_section(scope: Scope, section: OutlineSection) -> tuple[list[Stretch], bool, float, str]:
    """Return the stretches of a drawing, its y axis upwards, whether they are closed, the unit [m] and the name."""
    unit = None if section.unit is None else scope.value(scope.constant("unit", section.unit, positive=True), "unit")
    name = "path data" if section.file is None else section.file
    if section.radius is not None:
        return list(polar_curve(scope, section.radius)), True, 1.0, "radius"
    if section.file is not None and name.lower().endswith(".dxf"):
        stretches, closed, known = _of_dxf(scope, name, section.layer)
        unit = known if unit is None else unit
    else:
        if section.layer is not None:
            raise scope.error("layer", "no such key without a DXF file", quote(section.layer))
        data = (section.path or "") if section.file is None else _path_of_svg(_content(scope, name), name)
        stretches, closed = read_path(data)
        stretches = [x.placed(1.0, True) for x in stretches]
    if unit is None:
        raise scope.error("unit", "the length of a unit of the drawing [m], such as 0.001", "none")
    return stretches, closed, unit, name


def _file_of(scope: Scope, name: str) -> str:
    folder = getattr(scope.context.source, "folder", "")
    return file_beside(scope.where("file"), folder, name, (".dxf", ".svg"), "the path of a .dxf or .svg file")


def _content(scope: Scope, name: str) -> bytes:
    """Return what a file holds."""
    path = Path(_file_of(scope, name))
    try:
        if path.stat().st_size > _LARGEST:
            raise scope.error("file", f"a file of at most {_LARGEST} bytes", f"{path.stat().st_size} bytes")
        return path.read_bytes()
    except OSError as error:
        raise scope.error("file", "a file that can be read", f"{quote(name)} ({system_message(error)})") from None


def _path_of_svg(content: bytes, name: str) -> str:
    """Return the data of the only path of an SVG file."""
    if b"<!ENTITY" in content:
        raise BadDrawing("an SVG file without entities", f"{quote(name)}, which declares some")
    try:
        root = ET.fromstring(content)
    except (ET.ParseError, ValueError, LookupError) as error:  # or an encoding that is none
        raise BadDrawing("an SVG file", f"{quote(name)} ({error})") from None
    paths, found = list[tuple[str, bool]](), [(root, False)]
    while found:
        element, moved = found.pop()
        kind, moved = str(element.tag).rpartition("}")[2], moved or "transform" in element.attrib
        if kind == "path":
            paths.append((element.get("d", ""), moved))
        if kind not in ("defs", "clipPath", "marker", "pattern", "symbol"):
            found += [(each, moved) for each in element]
    if len(paths) != 1:
        raise BadDrawing("an SVG file with one path", f"{quote(name)} with {len(paths)}")
    if paths[0][1]:
        raise BadDrawing("a path without a transform", f"one in {quote(name)}")
    return paths[0][0]


# -- DXF ---------------------------------------------------------------------------------------------------------------


def _of_dxf(scope: Scope, name: str, layer: str | None) -> tuple[list[Stretch], bool, float | None]:
    """Return the chain of a DXF file, whether it is closed, and its unit [m] where it has one."""
    path = _file_of(scope, name)
    need_library(scope.where("file"), "ezdxf", extra="drawing")
    import ezdxf

    try:
        drawing = ezdxf.readfile(path)
    except OSError as error:  # which is also that of another format
        raise BadDrawing("a DXF file", f"{quote(name)} ({error.strerror or 'of another format'})") from None
    except (ezdxf.DXFError, ValueError, KeyError, UnicodeError) as error:
        raise BadDrawing("a DXF file", f"{quote(name)} ({' '.join(str(error).split()) or 'damaged'})") from None
    entities = [x for x in drawing.modelspace() if x.dxftype() not in _BESIDE]
    if layer is not None:
        layers = sorted({x.dxf.layer for x in entities})
        entities = [x for x in entities if x.dxf.layer == layer]
        if not entities:
            raise scope.error("layer", f"a layer of {quote(name)}, {' or '.join(map(quote, layers))}", quote(layer))
    if len(entities) > _MOST:
        raise BadDrawing(f"a chain of 1 to {_MOST} parts", f"{len(entities)} parts")
    parts = [list(_stretches_of(entity)) for entity in entities]
    stretches, closed = _joined([part for part in parts if part])
    return stretches, closed, _UNITS.get(drawing.header.get("$INSUNITS", 0))


def _stretches_of(entity: DXFGraphic) -> Iterator[Stretch]:
    """Yield the stretches of an entity, which lies in the plane of x and y."""
    kind, dxf = entity.dxftype(), entity.dxf
    mirrored = dxf.hasattr("extrusion") and dxf.extrusion.z < 0.0
    if dxf.hasattr("extrusion") and abs(abs(dxf.extrusion.z) - 1.0) > 1e-9:
        raise BadDrawing("a drawing in the plane of x and y", f"{_article(kind)} outside it")

    def seen(stretches: Iterator[Stretch]) -> Iterator[Stretch]:
        """Yield stretches of an entity whose own first axis is the negative one where it is seen from below."""
        for each in stretches:
            yield each.placed(-1.0, True) if mirrored else each

    if kind == "LINE":
        yield from _chain([(_planar(p), 0.0) for p in (dxf.start, dxf.end)], False)
    elif kind in ("ARC", "CIRCLE"):
        begin, end = (0.0, 360.0) if kind == "CIRCLE" else (dxf.start_angle, dxf.end_angle)
        turn = (end - begin) % 360.0 or 360.0
        first = math.radians(begin)
        yield from seen(ellipse(_planar(dxf.center), dxf.radius, 1.0, first, first + math.radians(turn)))
    elif kind == "ELLIPSE":
        end = dxf.start_param + ((dxf.end_param - dxf.start_param) % (2.0 * math.pi) or 2.0 * math.pi)
        ratio = -dxf.ratio if mirrored else dxf.ratio
        yield from ellipse(_planar(dxf.center), _planar(dxf.major_axis), ratio, dxf.start_param, end)
    elif kind == "LWPOLYLINE":
        points = [(complex(x, y), bulge) for x, y, bulge in entity.get_points("xyb")]
        yield from seen(_chain(points, bool(entity.closed)))
    elif kind == "POLYLINE" and entity.is_2d_polyline:
        points = [(_planar(v.dxf.location), v.dxf.get("bulge", 0.0)) for v in entity.vertices]
        yield from seen(_chain(points, bool(entity.is_closed)))
    elif kind == "SPLINE":
        yield from _of_spline(entity.construction_tool())
    else:
        expected = "LINE, ARC, CIRCLE, ELLIPSE, LWPOLYLINE, POLYLINE in the plane and SPLINE"
        raise BadDrawing(expected, f"{_article(kind)}, which a layer of its own would leave out")


def _planar(point: Vec3) -> complex:
    return complex(point.x, point.y)


def _article(kind: str) -> str:
    return f"{'an' if kind[0] in 'AEIOU' else 'a'} {kind}"


def _chain(points: Sequence[tuple[complex, float]], closed: bool) -> Iterator[Stretch]:
    """Yield segments and arcs between points with the bulges behind them."""
    following = [*points[1:], points[0]] if closed and points else points[1:]
    for (start, bulge), (end, _) in zip(points, following, strict=False):
        if start != end:
            yield bulged(start, end, bulge)


def _of_spline(curve: BSpline) -> Iterator[Stretch]:
    """Yield the parts of a spline between its knots."""
    knots = sorted(set(curve.knots()))
    knots = [x for x in knots if 0.0 <= x <= curve.max_t]

    def between(a: float, b: float) -> Stretch:
        near = 1e-9 * (b - a)

        def at(x: float) -> tuple[complex, complex]:
            t = a + x * (b - a)
            along = _planar(curve.derivative(min(max(t, a + near), b - near), 1)[1])
            if along == 0.0:
                raise BadDrawing("splines with a direction everywhere", "one with a cusp")
            return _planar(curve.point(t)), along / abs(along)

        return Stretch(at)

    for a, b in pairwise(knots):
        yield between(a, b)


def _joined(parts: list[list[Stretch]]) -> tuple[list[Stretch], bool]:
    """Return the one chain of parts in any order, in the direction of the first one, and whether it is closed."""
    if not parts:
        raise BadDrawing("a chain of lines, arcs and curves", "a drawing without one")
    ends = [point for part in parts for point in (part[0].start, part[-1].end)]
    near = _JOINED * max(abs(a - ends[0]) for part in parts for x in part for a in (x.at(0.5)[0], x.end, x.start))
    chain, rest = list(parts[0]), parts[1:]
    while rest:
        for i, part in enumerate(rest):
            begins, finishes = part[0].start, part[-1].end
            turned = [x.back for x in reversed(part)]
            if abs(begins - chain[-1].end) <= near or abs(finishes - chain[-1].end) <= near:
                chain += part if abs(begins - chain[-1].end) <= near else turned
            elif abs(finishes - chain[0].start) <= near or abs(begins - chain[0].start) <= near:
                chain = [*(part if abs(finishes - chain[0].start) <= near else turned), *chain]
            else:
                continue
            del rest[i]
            break
        else:
            point = rest[0][0].start
            got = f"parts that do not meet, one of which begins at {point.real:.6g}, {point.imag:.6g}"
            raise BadDrawing("one chain", got)
    return chain, abs(chain[0].start - chain[-1].end) <= near


def drawing_given(section: OutlineSection, scope: Scope) -> bool:
    """Return whether an outline is a drawing, and refuse keys that only drawings have."""
    given = [key for key in DRAWN if getattr(section, key) is not None]
    wrong = () if {"file", "path"} & {*given} else ("unit", "layer") if given else ("unit", "tolerance", "layer")
    for key in wrong:
        if getattr(section, key) is not None:
            beside = " or ".join(DRAWN if key == "tolerance" else DRAWN[:2])
            raise scope.error(key, f"no such key without {beside}", value_in_words(getattr(section, key)))
    return bool(given)

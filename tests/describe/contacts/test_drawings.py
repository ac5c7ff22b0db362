"""Outlines from DXF and SVG: beside the same chains by points, beside closed forms, and what is wrong in a sentence."""

import math
from pathlib import Path
from typing import Any

import pytest

from symgen.base.errors import InputError
from symgen.describe.contacts.chains import BodyOutline
from symgen.describe.contacts.outline_tables import read_outline
from symgen.describe.files.origins import Source
from symgen.describe.parts.context import Context
from symgen.describe.parts.scope import Scope


def outline_of(table: dict[str, Any], folder: Path | None = None) -> BodyOutline:
    """Return an outline of the ground."""
    source = Source.of_file(folder / "machine.toml") if folder else "test"
    context = Context(source, {}, {}, {}, lambda name, where: pytest.fail(name))
    return read_outline(Scope(context, "outlines.cam", "cam"), {"body": "ground", **table})


def numbers_of(outline: BodyOutline) -> list[tuple[complex, complex, float]]:
    """Return start, end and curvature of each piece."""
    value = Scope(Context("test", {}, {}, {}, lambda name, where: pytest.fail(name)), "test").value

    def place(pair: Any) -> complex:
        return complex(*(value(e, "test") for e in pair))

    return [(place(x.start), place(x.end), value(x.curvature, "test")) for x in outline.pieces]


def assert_equal(one: BodyOutline, other: BodyOutline) -> None:
    """Assert that two closed outlines have the same pieces, wherever they begin."""
    rows, others = numbers_of(one), numbers_of(other)
    assert len(rows) == len(others) and one.closed == other.closed
    for start, end, k in rows:
        nearest = min(others, key=lambda row: abs(row[0] - start) + abs(row[1] - end))
        assert abs(nearest[0] - start) + abs(nearest[1] - end) < 1e-12
        assert nearest[2] == pytest.approx(k, rel=1e-9, abs=1e-9)


#: A plate of 0.1 m by 0.05 m with a round end, counterclockwise.
PLATE = {"points": [[0, 0], [0.1, 0], {"to": [0.1, 0.05], "bulge": 1.0}, [0, 0.05]], "closed": True}


@pytest.mark.parametrize(
    "data",
    [
        "M0 0H100A25 25 0 0 0 100-50H0Z",
        "m 0,0 l 100,0 a25 25 30 1 0 0,-50 l-100 0 z",
        "M 0 -50 V 0 L 1e2 0 A 25 25 0 01100-50 Z".replace("01100", "00100"),
    ],
)
def test_path_data_is_the_chain_by_points(data: str) -> None:
    """The y axis of SVG goes down."""
    assert_equal(outline_of({"path": data, "unit": 0.001}), outline_of(PLATE))


def test_a_path_of_a_file_is_that_of_its_text(tmp_path: Path) -> None:
    text = '<svg xmlns="http://www.w3.org/2000/svg"><g><path d="M0 0H100A25 25 0 0 0 100-50H0Z"/></g></svg>'
    (tmp_path / "plate.svg").write_text(text, encoding="utf-8")
    assert_equal(outline_of({"file": "plate.svg", "unit": "1 mm"}, tmp_path), outline_of(PLATE))


def worst_distance(outline: BodyOutline, distance: Any) -> float:
    """Return the largest distance of 20 points of each piece from a curve."""
    worst = 0.0
    for start, end, k in numbers_of(outline):
        way = end - start
        half = math.asin(0.5 * k * abs(way))
        for i in range(20):
            part = (2.0 * i / 20.0 - 1.0) * half
            offset = (math.cos(part) - math.cos(half)) / k if k else 0.0
            along = 0.5 + (math.sin(part) / (2.0 * math.sin(half)) if k else i / 20.0 - 0.5)
            worst = max(worst, abs(distance(start + way * along + 1j * way / abs(way) * offset)))
    return worst


@pytest.mark.parametrize("tolerance", [1e-4, 1e-5, 1e-6, 1e-7])
def test_an_ellipse_is_within_the_tolerance(tolerance: float) -> None:
    """The value of an ellipse over its gradient is the distance, to first order of it."""
    outline = outline_of(
        {"path": "M-100 0a100 50 0 0 0 200 0a100 50 0 0 0-200 0z", "unit": 1e-3, "tolerance": tolerance}
    )

    def distance(point: complex) -> float:
        x, y = point.real / 0.1, point.imag / 0.05
        return 0.5 * (x * x + y * y - 1.0) / math.hypot(x / 0.1, y / 0.05)

    worst = worst_distance(outline, distance)
    assert 0.01 * tolerance < worst < 1.05 * tolerance
    assert f"within {tolerance:.3g} m" in outline.source


def test_curves_of_path_data_are_parabolas() -> None:
    """A quadratic curve, its cubic form and its reflection lie on y = x (1 - x) and y = (1 - x) (2 - x) below."""
    third = 1.0 / 3.0
    for data in ("M0 0Q.5-.5 1 0", f"M0 0C{third},{-third} {2 * third} {-third} 1 0", "m0 0q.5-.5 1 0"):
        outline = outline_of({"path": data, "unit": 1.0, "tolerance": 1e-6})
        assert worst_distance(outline, lambda p: 0.7 * (p.imag - p.real * (1.0 - p.real))) < 1e-6
    for data in ("M0 0Q.5-.5 1 0T2 0", f"M0 0C{third},{-third} {2 * third} {-third} 1 0S{5 * third} {third} 2 0"):
        outline = outline_of({"path": data, "unit": 1.0, "tolerance": 1e-6})

        def height(p: complex) -> float:
            x = p.real
            return 0.7 * (p.imag - (x * (1.0 - x) if x < 1.0 else (1.0 - x) * (2.0 - x)))

        assert worst_distance(outline, height) < 1e-6


def test_rounded_numbers_make_no_corner() -> None:
    """Where a line meets an arc by numbers of three digits, the chain has no hollow corner."""
    from symgen.describe.contacts.chains import hollow_corners

    outline = outline_of({"path": "M0 0L8.66 -5A10 10 0 0 1 12.682 -6.203L20 -6.9", "unit": 1e-3, "tolerance": 1e-5})
    value = Scope(Context("test", {}, {}, {}, lambda name, where: pytest.fail(name)), "test").value
    directions = [
        (complex(*(value(e, "") for e in x.first)), complex(*(value(e, "") for e in x.last))) for x in outline.pieces
    ]
    assert len(directions) >= 3
    assert len(hollow_corners(outline, lambda e: value(e, ""))) <= 1


def drawn(path: Path, draw: Any, unit: int = 4) -> None:
    """Write a DXF file."""
    import ezdxf

    document = ezdxf.new("R2010")
    document.header["$INSUNITS"] = unit
    draw(document.modelspace())
    document.saveas(path)


def as_parts(space: Any) -> None:
    space.add_line((100, 50), (0, 50))
    space.add_line((0, 0), (100, 0))
    space.add_arc((100, 25), 25, -90, 90)
    space.add_line((0, 0), (0, 50))
    space.add_text("plate")


def as_polyline(space: Any) -> None:
    space.add_lwpolyline([(0, 0, 0), (100, 0, 1), (100, 50, 0), (0, 50, 0)], format="xyb", close=True)


def as_old_polyline(space: Any) -> None:
    space.add_polyline2d([(0, 0, 0), (100, 0, 1), (100, 50, 0), (0, 50, 0)], format="xyb", close=True)


def as_seen_from_below(space: Any) -> None:
    points = [(0, 0, 0), (-100, 0, -1), (-100, 50, 0), (0, 50, 0)]
    space.add_lwpolyline(points, format="xyb", close=True, dxfattribs={"extrusion": (0, 0, -1)})


def as_layer(space: Any) -> None:
    as_polyline(space)
    space.add_circle((0, 0), 3, dxfattribs={"layer": "holes"})


@pytest.mark.slow
@pytest.mark.parametrize("draw", [as_parts, as_polyline, as_old_polyline, as_seen_from_below, as_layer])
def test_a_dxf_file_is_the_chain_by_points(draw: Any, tmp_path: Path) -> None:
    drawn(tmp_path / "plate.dxf", draw)
    layer = {"layer": "0"} if draw is as_layer else {}
    outline = outline_of({"file": "plate.dxf", **layer}, tmp_path)
    assert_equal(outline, outline_of(PLATE))
    assert "unit 0.001 m" in outline.source


@pytest.mark.slow
def test_curves_of_dxf_files_are_within_the_tolerance(tmp_path: Path) -> None:
    """An ellipse, a circle, and a spline of degree 2 on a parabola."""

    def distance(point: complex) -> float:
        x, y = point.real / 0.1, point.imag / 0.05
        return 0.5 * (x * x + y * y - 1.0) / math.hypot(x / 0.1, y / 0.05)

    table = {"file": "curve.dxf", "tolerance": 1e-6}
    drawn(tmp_path / "curve.dxf", lambda space: space.add_ellipse((0, 0), (100, 0), 0.5))
    assert worst_distance(outline_of(table, tmp_path), distance) < 1.05e-6
    drawn(tmp_path / "curve.dxf", lambda space: space.add_circle((0, 0), 20))
    assert worst_distance(outline_of(table, tmp_path), lambda p: abs(p) - 0.02) < 1e-15
    points = [(0, 0), (0.5, 0.5), (1, 0)]
    drawn(tmp_path / "curve.dxf", lambda space: space.add_open_spline(points, degree=2), unit=6)
    assert worst_distance(outline_of(table, tmp_path), lambda p: 0.7 * (p.imag - p.real * (1.0 - p.real))) < 1e-6


@pytest.mark.parametrize(
    ("table", "sentence"),
    [
        ({"path": "M0 0L1 0"}, "the length of a unit of the drawing [m], such as 0.001, got none"),
        ({"path": "L0 0", "unit": 1}, "which begins with M, got the letter 'L'"),
        ({"path": "M0 0B1 2", "unit": 1}, "the letters MLHVCSQTAZ, which begins with M, got the letter 'B'"),
        ({"path": "M0 0L1", "unit": 1}, "2 numbers after 'L' of path data, got 'the end'"),
        ({"path": "M0 0L1 x", "unit": 1}, "2 numbers after 'L' of path data, got 'x'"),
        ({"path": "M0 0L1 0M2 0L3 0", "unit": 1}, "path data of one chain, got a second one, from its letter 'M' on"),
        ({"path": "M0 0", "unit": 1}, "none that draws anything"),
        ({"path": "M0 0C0 0 0 0 0 0", "unit": 1}, "all at one place"),
        ({"path": "M0 0L1 0", "unit": 1, "layer": "a"}, "no such key without a DXF file, got 'a'"),
        ({"box": [1, 1], "unit": 1}, "no such key without file or path, got 1"),
        ({"file": "none.svg", "unit": 1}, "'none.svg', which is none; did you mean 'one.svg'"),
        ({"file": "../one.svg", "unit": 1}, "in the folder of the mechanism file or below it, got '../one.svg'"),
        ({"file": "cam.pdf", "unit": 1}, "the path of a .dxf or .svg file"),
        ({"file": "one.svg", "unit": 1}, "an SVG file with one path, got 'one.svg' with 2"),
        ({"file": "moved.svg", "unit": 1}, "a path without a transform, got one in 'moved.svg'"),
        ({"file": "torn.svg", "unit": 1}, "an SVG file, got 'torn.svg'"),
        ({"path": "M0 0L1 1L1 0L0 1Z", "unit": 1}, "pieces 1 and 3 that cross"),
    ],
)
def test_what_is_wrong_in_one_sentence(table: dict[str, Any], sentence: str, tmp_path: Path) -> None:
    (tmp_path / "one.svg").write_text('<svg><path d="M0 0L1 0"/><path d="M0 0L1 0"/></svg>', encoding="utf-8")
    (tmp_path / "moved.svg").write_text('<svg><g transform="scale(2)"><path d="M0 0L1 0"/></g></svg>', encoding="utf-8")
    (tmp_path / "torn.svg").write_text("<svg><path", encoding="utf-8")
    with pytest.raises(InputError) as caught:
        outline_of(table, tmp_path)
    assert sentence in str(caught.value) and "outlines.cam" in str(caught.value)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("draw", "sentence"),
    [
        (lambda space: None, "a chain of lines, arcs and curves, got a drawing without one"),
        (lambda space: (space.add_line((0, 0), (1, 0)), space.add_line((2, 0), (3, 0))), "one of which begins at 2, 0"),
        (lambda space: space.add_blockref("part", (0, 0)), "got an INSERT"),
    ],
)
def test_what_is_wrong_in_a_dxf_file(draw: Any, sentence: str, tmp_path: Path) -> None:
    drawn(tmp_path / "bad.dxf", draw)
    with pytest.raises(InputError) as caught:
        outline_of({"file": "bad.dxf"}, tmp_path)
    assert sentence in str(caught.value)
    (tmp_path / "bad.dxf").write_text("no drawing", encoding="utf-8")
    with pytest.raises(InputError, match=r"a DXF file, got 'bad.dxf'"):
        outline_of({"file": "bad.dxf"}, tmp_path)


def test_without_the_library_the_extra_is_named(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "cam.dxf").write_text("", encoding="utf-8")
    monkeypatch.setattr("symgen.base.files.find_spec", lambda name: None)
    with pytest.raises(InputError, match=r"the library ezdxf, got none.*symgen\[drawing\]"):
        outline_of({"file": "cam.dxf"}, tmp_path)

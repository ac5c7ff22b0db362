"""Outlines: their chains beside closed forms, and one sentence for each thing that is wrong."""

import math
from typing import Any

import pytest

from symgen.base.errors import InputError
from symgen.base.vocabulary.expressions import Expr, Number
from symgen.base.vocabulary.measures import Chain, OnChain, nested_parts
from symgen.describe.edits.renaming import rename_in_text
from symgen.describe.files.validate import validate

#: A cam of a base circle of 30 mm and a nose of 10 mm at 40 mm, and where its flanks begin and end.
BASE, NOSE = [0.015, 0.015 * math.sqrt(3.0)], [0.045, 0.005 * math.sqrt(3.0)]
CAM = [
    [-0.03, 0.0],
    {"to": BASE, "radius": 0.03},
    NOSE,
    {"to": [NOSE[0], -NOSE[1]], "radius": 0.01},
    [BASE[0], -BASE[1]],
    {"to": [-0.03, 0.0], "radius": 0.03},
]


def described(outline: dict[str, Any], radius: float | str = 0.01, **parameters: float) -> Any:
    """Return a mechanism of a disc beside an outline of the ground."""
    return {
        "mechanism": {"name": "beside"},
        "parameters": parameters,
        "bodies": {"disc": {"mass": 1.0, "inertia": 1.0, "position": [0.0, 1.0]}},
        "outlines": {"cam": {"body": "ground", **outline}},
        "contacts": {"touch": {"between": [{"body": "disc", "disc": radius}, {"outline": "cam"}], "friction": 0.1}},
    }


def chains_of(raw: Any) -> list[Chain]:
    """Return the chains of a description, one for each gap."""
    rows = [row for row in validate(raw, "test").bounded if row.one_sided]
    found = [next(part for part in nested_parts(row.measure) if isinstance(part, OnChain)) for row in rows]
    return [each.chain for each in found]


def number(e: Expr) -> float:
    """Return a number."""
    assert isinstance(e, Number)
    return e.value


def ends_of(chain: Chain) -> list[tuple[tuple[complex, complex], tuple[complex, complex]]]:
    """Return place and direction at the start and the end of each piece, as complex numbers."""
    result = []
    for piece in chain.pieces:
        place, along = (complex(*map(number, pair)) for pair in (piece.start, piece.along))
        k, length = number(piece.curvature), number(piece.length)
        turn = complex(math.cos(k * length), -math.sin(k * length))
        way = along * (length if k == 0.0 else (turn - 1.0) / (-1j * k))
        result.append(((place, along), (place + way, along * turn)))
    return result


@pytest.mark.parametrize("reverse", [False, True])
@pytest.mark.parametrize(
    ("outline", "length"),
    [
        ({"points": CAM, "closed": True}, 2.0 * (math.pi * (0.03 * 2.0 + 0.01) / 3.0 + 0.02 * math.sqrt(3.0))),
        ({"box": [0.2, 0.1]}, 0.6),
        ({"polygon": {"sides": 7, "radius": 0.1}}, 1.4 * math.sin(math.pi / 7.0)),
        ({"box": [0.2, 0.1], "fillet": 0.02}, 0.6 - 8.0 * 0.02 + 2.0 * math.pi * 0.02),
        ({"points": [[0.0, 0.0], [0.1, 0.0], [0.1, 0.1]], "closed": True}, 0.1 * (2.0 + math.sqrt(2.0))),
        ({"points": [[0.0, 0.0], {"to": [0.2, 0.0], "bulge": 0.5}], "closed": True}, 0.2 + math.atan(0.5) * 0.5),
        ({"points": [[0.1, 0.0], {"to": [0.0, 0.1], "radius": 0.1, "large": True}], "closed": True}, None),
    ],
)
def test_a_convex_chain_is_smooth_and_longer_by_a_circle(
    outline: dict[str, Any], length: float | None, reverse: bool
) -> None:
    """Each piece begins where the one before it ends, in its direction; the disc's centre goes 2 pi r farther."""
    if reverse and any(isinstance(point, dict) for point in outline.get("points", [])):
        outline = {**outline, "points": mirrored(outline["points"])}
    (chain,) = chains_of(described(outline))
    ends = ends_of(chain)
    assert chain.closed and not chain.hollow and len(ends) % 2 == 0
    for (_, (place, along)), ((start, direction), _) in zip(ends, ends[1:] + ends[:1], strict=True):
        assert abs(place - start) < 1e-14 and abs(along - direction) < 1e-12
    whole = sum(number(piece.length) for piece in chain.pieces)
    turned = sum(number(piece.length) * number(piece.curvature) for piece in chain.pieces)
    assert turned == pytest.approx(2.0 * math.pi, rel=1e-12)
    if length is not None:
        assert whole == pytest.approx(length + 0.02 * math.pi, rel=1e-12)


def mirrored(points: list[Any]) -> list[Any]:
    """Return points mirrored at the first axis, so that the way along them goes round the other way."""
    result = []
    for point in points:
        x, y = point["to"] if isinstance(point, dict) else point
        bulge = {"bulge": -point["bulge"]} if isinstance(point, dict) and "bulge" in point else {}
        result.append({**point, "to": [x, -y], **bulge} if isinstance(point, dict) else [x, -y])
    return result


def test_concave_corners_cut_a_chain() -> None:
    teeth = [[-1.0, 0.0], [0.0, 0.0], [0.2, 0.3], [0.4, 0.0], [0.6, 0.3], [0.8, 0.0]]
    chains = chains_of(described({"points": teeth}))
    assert [len(chain.pieces) for chain in chains] == [3, 6, 6]  # a turn of 113 degrees has two pieces
    assert not any(chain.closed for chain in chains)
    star = [[math.cos(x) * r, math.sin(x) * r] for i in range(10) for x, r in [(i * math.pi / 5.0, 1.0 - i % 2 * 0.5)]]
    assert len(chains_of(described({"points": star, "closed": True}))) == 5
    rounded = chains_of(described({"points": star, "closed": True, "fillet": 0.05}))
    assert len(rounded) == 1 and rounded[0].hollow and rounded[0].closed


@pytest.mark.parametrize(
    ("outline", "radius", "sentence"),
    [
        ({"points": [[0, 0], [1, 1], [1, 0], [0, 1]]}, 0.1, "pieces 1 and 3 that cross"),
        ({"points": [[0, 0], [1, 0], [1, 0], [2, 0]]}, 0.1, "points 2 and 3 at one place"),
        ({"points": [[0, 0], [0, 0]]}, 0.1, "points 1 and 2 at one place"),
        (
            {"points": [[0, 0], [1, 0]], "closed": True, "box": [1, 1]},
            0.1,
            "one of points, polygon, box, gear_profile, file, path and radius, got points",
        ),
        ({}, 0.1, "one of points, polygon, box, gear_profile, file, path and radius, got none of them"),
        ({"polygon": {"sides": 2, "radius": 1.0}}, 0.1, "a number of at least 3, got 2"),
        ({"box": [0.2, 0.1], "fillet": 0.06}, 0.1, "fillets that leave room for each other"),
        ({"points": [[0, 0], {"to": [1, 0], "radius": 0.4}]}, 0.1, "at least half of the distance"),
        ({"points": [[0, 0], {"to": [1, 0], "radius": 1, "bulge": 1}]}, 0.1, "radius or bulge, got both"),
        ({"points": [[0, 1], [0, 0], [1, 0]], "fillet": 0.1}, 0.2, "radii above that of the disc, 0.2 m, got piece 2"),
        ({"points": [[0, 0], [1, 0]], "inside": True}, 0.1, "the key closed beside it"),
        ({"box": [0.2, 0.1]}, -0.1, "a hole of 0.1 m"),
        ({"box": [0.2, 0.1], "body": "disc"}, 0.1, "two different bodies, got 'disc' twice"),
        ({"box": [0.2, 0.1], "fillets": 0.1}, 0.1, "did you mean 'fillet'"),
        ({"points": [[0, 0], {"to": [1, 0], "fillet": 0.1}, {"to": [1, -1], "radius": 2}]}, 0.1, "an arc beside it"),
    ],
)
def test_what_is_wrong_in_one_sentence(outline: dict[str, Any], radius: float, sentence: str) -> None:
    with pytest.raises(InputError) as caught:
        validate(described(outline, radius), "test")
    assert sentence in str(caught.value)
    assert "outlines.cam" in str(caught.value) or "contacts.touch" in str(caught.value)


@pytest.mark.parametrize(
    ("outline", "other", "sentence"),
    [
        (
            {"points": [[0, 0], {"to": [1, 0], "bulge": -0.2}], "closed": True},
            {"line": "ground"},
            "whose two ends no line meets at once, got those of 'cam'",
        ),
        (
            {"points": [[0, 0], {"to": [1, 0], "bulge": -0.2}], "closed": True},
            {"outline": "floor"},
            "whose circle of 1.3 m",
        ),
        ({"box": [1, 1]}, {"outline": "floors"}, "did you mean 'floor'"),
        ({"box": [1, 1]}, {"line": "disc"}, "two different bodies, got 'disc' twice"),
        (
            {"box": [1, 1]},
            {"body": "ground", "segment": [[0, 0], [1, 0]]},
            "a disc, a line or an outline beside an outline, got a segment",
        ),
    ],
)
def test_what_an_outline_may_not_stand_on(outline: dict[str, Any], other: dict[str, Any], sentence: str) -> None:
    raw = described({**outline, "body": "disc"})
    raw["outlines"]["floor"] = {"body": "ground", "points": [[-1, 0], [1, 0]]}
    raw["contacts"]["touch"]["between"] = [{"outline": "cam"}, other]
    with pytest.raises(InputError) as caught:
        validate(raw, "test")
    assert sentence in str(caught.value) and "contacts.touch" in str(caught.value)


@pytest.mark.parametrize(
    ("outline", "feet"),
    [
        ({"box": [0.2, 0.1]}, [0.0] * 4),
        ({"box": [0.2, 0.1], "fillet": 0.02}, [0.02] * 4),
        ({"points": CAM, "closed": True}, [0.03, 0.01]),  # the base circle is two arcs
        ({"points": [[0, 0], [1, 0], [0.5, 0.2], [0.5, 1]], "closed": True}, [0.0] * 3),
        ({"points": [[-1, 0], [0, 0.5], [1, 0]]}, [0.0] * 3),
    ],
)
def test_an_outline_stands_on_its_convex_corners_and_arcs(outline: dict[str, Any], feet: list[float]) -> None:
    raw = described({**outline, "body": "disc"})
    raw["contacts"]["touch"]["between"] = [{"outline": "cam"}, {"line": "ground"}]
    gaps = [row for row in validate(raw, "test").bounded if row.one_sided]
    assert sorted(number(row.value) for row in gaps) == pytest.approx(sorted(feet))


def test_an_unknown_outline_has_a_hint() -> None:
    raw = described({"box": [0.2, 0.1]})
    raw["contacts"]["touch"]["between"][1] = {"outline": "cams"}
    with pytest.raises(InputError, match=r"the unknown outline 'cams'.*did you mean 'cam'"):
        validate(raw, "test")


def test_an_outline_is_renamed_where_it_is_used() -> None:
    text = '[mechanism]\nname = "m"\n[bodies.disc]\nmass = 1.0\ninertia = 1.0\nposition = [0.0, 1.0]\n'
    text += '[outlines.cam]\nbody = "ground"\nbox = [1.0, 1.0]\n[contacts.c]\n'
    text += 'between = [{ body = "disc", disc = 0.1 }, { outline = "cam" }]\n'
    changed = rename_in_text(text, "outlines.cam", "curve", "test")
    assert "[outlines.curve]" in changed and 'outline = "curve"' in changed

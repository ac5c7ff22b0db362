"""The moving picture of the player's page shows the linkage as it moves now, and its rods stay together."""

import re
from itertools import pairwise

import numpy as np

from benchmarks import moving_picture
from benchmarks.kept_pictures import PICTURES

KEPT = (PICTURES / f"{moving_picture.NAME}.svg").read_text(encoding="utf-8")
NUMBER = re.compile(r"-?\d+(?:\.\d+)?")
STEP = re.compile(r"translate\(([-\d.]+)px,([-\d.]+)px\)rotate\(([-\d.]+)deg\)")


def places(body: str) -> np.ndarray:
    """Return x, y [px] and angle [deg] of a body, from the text of the picture."""
    found = re.search(rf"@keyframes {body}\{{(.*)\}}\n", KEPT)
    assert found is not None
    return np.array(STEP.findall(found[1]), dtype=float)


def end(body: str, sign: int) -> np.ndarray:
    """Return where an end of a rod goes [px]."""
    x, y, angle = places(body).T
    half = sign * moving_picture.SCALE * moving_picture.LENGTHS[body]
    return np.column_stack([x + half * np.cos(np.radians(angle)), y + half * np.sin(np.radians(angle))])


def test_it_is_drawn_as_it_is_kept() -> None:
    """Numbers are tenths: another machine's rounding moves some by one of these."""
    drawn = moving_picture.draw()
    assert NUMBER.sub("0", drawn) == NUMBER.sub("0", KEPT), "run python -m benchmarks.moving_picture"
    numbers = [np.array([float(x) for x in NUMBER.findall(text)]) for text in (drawn, KEPT)]
    np.testing.assert_allclose(*numbers, rtol=0.0, atol=0.25)


def test_rods_stay_together_and_the_turn_is_whole() -> None:
    np.testing.assert_allclose(end("crank", 1), end("coupler", -1), atol=0.5)
    np.testing.assert_allclose(end("coupler", 1), end("rocker", 1), atol=0.5)
    pivot = np.array(moving_picture.ORIGIN)
    np.testing.assert_allclose(end("crank", -1), np.tile(pivot, (len(places("crank")), 1)), atol=0.5)
    for body in moving_picture.LENGTHS:
        first, last = places(body)[[0, -1]]
        np.testing.assert_allclose(first[:2], last[:2], atol=0.15)
        assert abs(last[2] - first[2]) % 360.0 in (0.0, 360.0)
    angles = places("crank")[:, 2]
    assert all(after < before for before, after in pairwise(angles))  # on the screen y points down


def test_readers_who_want_no_motion_have_none() -> None:
    assert "prefers-reduced-motion" in KEPT and "<script" not in KEPT and len(KEPT) < 15_000

"""Linkages for three positions and for a path that are drawn in ``symgen edit``: joints, places and motion."""

import tomllib
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest

from tests.browser.chromium import Chromium
from tests.browser.editor_page import Page
from tests.browser.test_edit_sketches import EMPTY, column

pytestmark = pytest.mark.browser

POSITIONS = np.array([[0.0, 0.0], [0.4, 0.2], [0.8, 0.2]])
AHEAD = np.array([[0.2, 0.0], [0.2, 0.1], [0.2, 0.2]])
JOINTS = ["driver", *["revolute"] * 4]


@pytest.fixture(params=[1280, 390])
def page(request: pytest.FixtureRequest, chromium: Chromium, tmp_path: Path) -> Iterator[Page]:
    file = tmp_path / "mine.toml"
    file.write_text(EMPTY)
    with Page.of(chromium, file) as opened:
        opened.open(request.param, 900)
        opened.until("window.symgen.editor.checked()")
        yield opened


def stroke(page: Page, *places: tuple[float, float]) -> None:
    """Draw from the first place to the others, the button held."""
    first, *others = (page.place(*place) for place in places)
    page.mouse("mousePressed", *first)
    for place in others:
        page.mouse("mouseMoved", *place)
    page.mouse("mouseReleased", *others[-1])


def offers(page: Page) -> list[str]:
    page.until("document.querySelectorAll('#answers button').length > 1")
    found: list[str] = page.run("[...document.querySelectorAll('#answers button')].map((b) => b.textContent)")
    return found[1:]


def take(page: Page, number: int) -> None:
    """Take an offered linkage, and wait until it moves."""
    before = page.text("text")
    page.run(f"document.querySelectorAll('#answers button')[{number}].click()")
    page.until(f"document.getElementById('text').value !== {before!r}")
    page.rested()
    assert page.text("facts").endswith("status ok"), (page.text("facts"), page.text("told"))


def tip_of_coupler(page: Page) -> np.ndarray:
    """Return where the origin of the coupler's frame is over time, from its centre of mass and its angle."""
    own = tomllib.loads(page.text("text"))["bodies"]["coupler"]["centre_of_mass"]
    x, y, angle = (column(page, f"coupler.{name}") for name in ("x", "y", "theta"))
    c, s = np.cos(angle), np.sin(angle)
    return np.column_stack([x - c * own[0] + s * own[1], y - s * own[0] - c * own[1]])


def passes_through_positions(page: Page) -> float:
    """Return how far the coupler is from the positions when it has their angles, on its way in the first second."""
    angles, tips = column(page, "coupler.theta"), tip_of_coupler(page)
    wanted = np.arctan2(AHEAD[:, 1], AHEAD[:, 0])
    first, last = sorted((angles[0], angles[-1]))
    assert [first, last] == pytest.approx(sorted(wanted[[0, 2]]), abs=1e-6)
    order = slice(None, None, 1 if angles[-1] > angles[0] else -1)
    reached = [np.interp(wanted, angles[order], each[order]) for each in tips.T]
    return float(np.abs(np.column_stack(reached) - POSITIONS).max())


def centre_of_circle(places: np.ndarray) -> np.ndarray:
    """Return the centre of the circle through three places."""
    ways = places[1:] - places[0]
    return places[0] + np.linalg.solve(2.0 * ways, (ways**2).sum(axis=1))


def test_three_positions_by_the_mouse_give_linkages_that_pass_them(page: Page) -> None:
    page.press("[data-tool=positions]")
    for place, ahead in zip(POSITIONS, AHEAD, strict=True):
        stroke(page, tuple(place), tuple(place + ahead))
    words = offers(page)
    angles = [int(each.split("transmission ")[1].split()[0]) for each in words]
    assert angles == sorted(angles, reverse=True) and min(angles) >= 30, words
    page.picture("positions")
    take(page, 1)
    first = page.text("text")
    take(page, 2)
    text = page.text("text")
    raw = tomllib.loads(text)
    assert sorted(joint["type"] for joint in raw["joints"].values()) == JOINTS  # the first one has gone again
    assert page.text("freedoms").startswith("0 degrees")
    assert passes_through_positions(page) < 1e-4
    turned = np.arctan2(AHEAD[:, 1], AHEAD[:, 0])
    for letter, pivot in (("A", "pivot"), ("B", "rocker_pivot")):
        own = np.array(raw["bodies"]["coupler"]["points"][letter])
        c, s = np.cos(turned), np.sin(turned)
        places = POSITIONS + np.column_stack([c * own[0] - s * own[1], s * own[0] + c * own[1]])
        assert centre_of_circle(places) == pytest.approx(raw["joints"][pivot]["at"][0], abs=1e-7)
    page.press("#undo")
    page.rested()
    assert page.text("text") == first
    page.press("#undo")
    page.until("window.symgen.editor.checked()")
    assert page.text("text") == EMPTY
    assert page.said() == []


@pytest.mark.parametrize("page", [1280], indirect=True)
def test_a_path_drawn_by_hand_gives_linkages_that_come_near_it(page: Page) -> None:
    along = np.linspace(0.0, 0.8, 25)
    drawn = np.column_stack([along, 0.3 * np.sin(2.0 * along)])
    page.press("[data-tool=path]")
    stroke(page, *map(tuple, drawn))
    words = offers(page)
    missed = [float(each.split("off by ")[1].split()[0]) for each in words]
    assert missed == sorted(missed) and missed[0] < 0.02, words
    page.run("document.querySelectorAll('#answers button')[1].focus()")
    page.picture("path")
    take(page, 1)
    assert sorted(joint["type"] for joint in tomllib.loads(page.text("text"))["joints"].values()) == JOINTS
    tips = tip_of_coupler(page)
    away = np.linalg.norm(tips[:, None] - drawn[None, ::3], axis=2).min(axis=0)
    assert away.max() < 2.0 * missed[0] + 0.01  # hands are rounded to half a pixel
    assert page.said() == []


@pytest.mark.parametrize("page", [1280], indirect=True)
def test_three_positions_are_typed_by_keys_alone(page: Page) -> None:
    page.run("document.querySelector('[data-tool=positions]').focus()")
    page.key("Enter")
    lengths, angles = np.hypot(*AHEAD.T), np.degrees(np.arctan2(AHEAD[:, 1], AHEAD[:, 0]))
    for place, length, angle in zip(POSITIONS, lengths, angles, strict=True):
        for words in (f"{place[0]}, {place[1]}", f"{length:.12g} < {angle:.12g}"):
            page.run("document.getElementById('where').focus()")
            page.chromium.call("Input.insertText", text=words)
            page.key("Enter")
    offers(page)
    before = page.text("text")
    page.run("document.querySelectorAll('#answers button')[1].focus()")
    page.key("Enter")
    page.until(f"document.getElementById('text').value !== {before!r}")
    page.rested()
    assert passes_through_positions(page) < 1e-4
    assert page.said() == []


@pytest.mark.parametrize("page", [1280], indirect=True)
def test_a_task_that_cannot_be_is_said(page: Page) -> None:
    page.press("[data-tool=path]")
    for place in ((0.0, 0.0), (0.2, 0.1), (0.2, 0.1)):
        page.click(*page.place(*place))
    page.until("document.getElementById('status').textContent.includes('3 to 20 points')")
    assert page.text("text") == EMPTY
    assert page.said() == []

"""The view of ``symgen edit`` is the user's: rails, zooms by hand, huge bodies and points close to each other."""

import tomllib
from collections.abc import Iterator
from pathlib import Path

import pytest

from tests.browser.chromium import Chromium
from tests.browser.editor_page import Page
from tests.browser.test_edit_sketches import EMPTY, Hand

pytestmark = pytest.mark.browser


@pytest.fixture
def hand(chromium: Chromium, tmp_path: Path) -> Iterator[Hand]:
    file = tmp_path / "mine.toml"
    file.write_text(EMPTY.replace("until = 1.0", "until = 10.0"))
    with Page.of(chromium, file) as page:
        page.open(1280, 900)
        page.until("window.symgen.editor.checked()")
        yield Hand(page)


def scale(page: Page) -> float:
    """Return pixels a metre."""
    return float(page.place(1.0, 0.0)[0] - page.place(0.0, 0.0)[0])


def wheel(page: Page, by: int) -> None:
    """Turn the wheel over the middle of the picture; down looks from farther away."""
    x, y = page.run(
        "(({ x, y, width, height }) => [x + width / 2, y + height / 2])"
        "(document.getElementById('picture').getBoundingClientRect())"
    )
    before = scale(page)
    page.chromium.call("Input.dispatchMouseEvent", type="mouseWheel", x=x, y=y, deltaX=0, deltaY=by)
    page.until(f"Math.abs(window.symgen.editor.place(1, 0)[0] - window.symgen.editor.place(0, 0)[0] - {before}) > 1")


@pytest.mark.parametrize("rail", ["slot", "slide"])
def test_a_rail_as_long_as_a_fall_leaves_the_view_and_two_clicks_pin_to_the_ground(hand: Hand, rail: str) -> None:
    """A garage door, its rail first: nothing holds it yet, so it falls 490 m along its rail in the ten seconds."""
    page = hand.page
    hand.bar((0.0, 0.0), (0.0, 2.0))
    hand.use("point", "bodies.bar1.points.A", (0.0, 1.0))
    hand.bar((0.5, 1.0), (0.0, 1.0))
    page.rested()
    before = scale(page)
    hand.drag(rail, "bodies.bar1.points.A", (0, -60))
    page.rested()
    hand.choose("pin")
    assert scale(page) > before / 4.0
    text = page.text("text")
    for _ in range(2):
        page.click(*page.place(0.5, 1.0))
    hand.changed(text)
    pinned = tomllib.loads(page.text("text"))["joints"][page.text("status").removeprefix("added joints.")]
    assert (pinned["type"], sorted(pinned["between"])) == ("revolute", ["bar2", "ground"])
    assert pinned["at"][pinned["between"].index("ground")] == [0.5, 1.0]
    page.rested()
    page.picture(f"door-{rail}")
    assert page.said() == []


def test_the_wheel_zooms_over_a_ringed_point_too(hand: Hand) -> None:
    page = hand.page
    hand.bar((0.0, 0.0), (1.0, 0.0))
    page.rested()
    hand.choose("pin")
    before, (x, y) = scale(page), page.where("bodies.bar1.points.A")
    page.chromium.call("Input.dispatchMouseEvent", type="mouseWheel", x=x, y=y, deltaX=0, deltaY=300)
    page.until(f"window.symgen.editor.place(1, 0)[0] - window.symgen.editor.place(0, 0)[0] < 0.9 * {before}")


def test_a_zoom_by_hand_stays_until_fit_is_pressed(hand: Hand) -> None:
    page = hand.page
    hand.choose("bar")
    wheel(page, 600)
    chosen = scale(page)
    for tool, places in (("plate", ((0.0, 0.0), (3.0, 0.0), (0.0, 2.0))), ("bar", ((3.0, 0.0), (4.0, 9.0)))):
        hand.use(tool, *places)
        page.rested()
        assert scale(page) == pytest.approx(chosen)
    page.press("#undo")
    page.press("[data-tool=move]")
    page.rested()
    assert scale(page) == pytest.approx(chosen)
    page.press("#fit")
    page.until(f"Math.abs(window.symgen.editor.place(1, 0)[0] - window.symgen.editor.place(0, 0)[0] - {chosen}) > 1")


def test_after_an_undo_of_something_huge_what_is_left_is_seen(hand: Hand) -> None:
    page = hand.page
    hand.bar((0.0, 0.0), (1.0, 0.0))
    page.rested()
    before = scale(page)
    hand.bar((0.0, 0.0), (1e9, 0.0))
    page.rested()
    assert scale(page) < 1e-3
    page.press("#undo")
    page.until("window.symgen.editor.checked()")
    page.rested()
    assert scale(page) > before / 4.0


def test_a_click_that_hits_two_points_asks_which(hand: Hand) -> None:
    page = hand.page
    hand.bar((0.0, 0.0), (1.0, 0.0))
    apart = round(4.0 / scale(page), 3)  # pixels
    hand.bar((0.0, 1.0), (apart, 0.0))
    page.rested()
    hand.choose("pin")
    text = page.text("text")
    for _ in range(2):
        page.click(*page.place(0.5 * apart, 0.0))
        page.until("!document.getElementById('which').hidden")
        names = page.run("[...document.querySelectorAll('#which button')].map((b) => b.textContent)")
        assert {name.split(",")[0] for name in names} == {"bar1 points A", "bar2 points B"}
        page.press(f"#which button:nth-of-type({1 + next(i for i, name in enumerate(names) if 'bar2' in name)})")
        page.until("document.getElementById('which').hidden")
    hand.changed(text)
    (pinned,) = tomllib.loads(page.text("text"))["joints"].values()
    assert sorted(pinned["between"]) == ["bar2", "ground"]


def test_what_is_added_has_its_own_name_and_an_error_shows_nothing_of_another_text(hand: Hand) -> None:
    page = hand.page
    hand.bar((0.0, 0.0), (1.0, 0.0))
    hand.ground("bodies.bar1.points.A")
    for kind, words in (("stop", "a stop to"), ("friction", "friction to")):
        hand.use(kind, "joints.pin1")
        assert page.text("status") == f"added {words} joints.pin1"
    page.rested()
    assert "ok" in page.text("facts") and "1 degree of freedom" in page.text("freedoms")
    page.type(0, "wrong\n")
    page.until("!document.getElementById('errors').hidden")
    assert page.text("facts") == page.text("freedoms") == ""
    assert page.text("told").startswith("the picture is pale")
    assert page.run("document.getElementById('picture').classList.contains('stale')")
    assert page.run("document.getElementById('plots').style.visibility") == "hidden"
    page.run("(document.activeElement.blur(), document.getElementById('undo').click())")
    page.rested()
    assert "ok" in page.text("facts") and "1 degree of freedom" in page.text("freedoms")


def test_the_template_goes_with_its_rod(chromium: Chromium, tmp_path: Path) -> None:
    """Its title and its parameters are about the rod: a machine drawn in its place has neither."""
    from symgen.describe.edits.template import new_file_text

    file = tmp_path / "mine.toml"
    file.write_text(new_file_text("mine"))
    with Page.of(chromium, file) as page:
        page.open(1280, 900)
        page.rested()
        at = page.text("text").index("[bodies.rod]") + 3
        page.run(f"document.getElementById('text').setSelectionRange({at}, {at})")
        page.press("#remove")
        page.until("document.getElementById('status').textContent === 'took out bodies.rod'")
        raw = tomllib.loads(page.text("text"))
        assert "title" not in raw["mechanism"] and raw["parameters"] == {} and raw["run"]["until"] == 10.0
        page.rested()  # nothing is drawn, and nothing is wrong
        assert page.run("document.getElementById('errors').hidden") and "no body yet" in page.text("told")
        assert page.text("facts") == "" and page.run("document.querySelectorAll('.handle').length") == 0
        page.picture("nothing-drawn")
        hand = Hand(page)
        hand.bar((0.0, 0.0), (1.0, 0.0))
        page.rested()
        assert "rod" not in page.text("live")
        assert page.run("document.querySelector('header h1').textContent") == "mine"

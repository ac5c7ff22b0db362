"""``symgen edit`` in a real browser: typed, dragged, drawn, undone, saved; ``make browser`` runs these."""

import shutil
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from symgen.api import load
from symgen.describe import catalogue
from tests.browser.chromium import Chromium
from tests.browser.editor_page import Page
from tests.cli.test_edit_server import chain_of_bars

pytestmark = pytest.mark.browser


@pytest.fixture
def file(tmp_path: Path) -> Path:
    own = catalogue.file_of_entry("four-bar")
    assert own is not None
    return Path(shutil.copy(own, tmp_path / "bar.toml"))


@pytest.fixture
def page(chromium: Chromium, file: Path) -> Iterator[Page]:
    with Page.of(chromium, file) as opened:
        yield opened


def comments(text: str) -> list[str]:
    return [line for line in text.split("\n") if line.startswith("#")]


def test_a_four_bar_from_a_typed_error_to_a_saved_change(page: Page, file: Path) -> None:
    before = file.read_bytes()
    page.open()
    page.rested()
    page.picture("opened")
    text = page.text("text")
    assert text.encode() == before and page.said() == []
    count = page.run("window.symgen.t.length")
    assert count > 100 and page.run("window.symgen.editor.handles().length") == 4

    # an error: its sentence at its line, while it is typed
    at = text.index('"crank_mass"') + len('"crank_mass')
    line = text.count("\n", 0, at) + 1
    page.type(at, "x")
    page.until("!document.getElementById('errors').hidden")
    (error,) = page.run("[...document.querySelectorAll('#errors button')].map((e) => e.textContent)")
    assert error.startswith(f"{line}: bodies.crank.mass: expected a number or an expression of parameters")
    assert "did you mean 'crank_mass'?" in error
    assert page.run("[...document.querySelectorAll('.cm-lineNumbers .bad')].map((e) => e.textContent)") == [str(line)]
    assert page.run("document.getElementById('picture').classList.contains('stale')")
    page.picture("error")

    # mended
    page.type(at, "", erased=1)
    page.until("document.getElementById('errors').hidden")
    page.rested()
    assert page.text("text") == text

    # a pivot is dragged: its number, the loop closed, another motion
    old = page.run("window.symgen.q[0]")
    page.drag("joints.D", 20, 0)
    page.rested()
    moved = page.text("text")
    changed = [(a, b) for a, b in zip(text.split("\n"), moved.split("\n"), strict=True) if a != b]
    assert len(changed) == 1 and changed[0][0] == 'at = [[10.0, 0.0], "D"]'
    x = float(changed[0][1].split("[[")[1].split(",")[0])
    assert 10.3 < x < 12.0
    new = page.run("window.symgen.q[0]")
    described = moved.replace("bar.toml", "")
    (file.parent / "same.toml").write_text(described)
    start = load(file.parent / "same.toml").simulate(until=0.01).q.values[0]
    assert new == pytest.approx(start, abs=1e-5) and abs(new[5] - old[5]) > 1e-3
    page.picture("dragged")

    # a bar from the pin C to a free place, and a pin of its end to the ground
    page.press("[data-tool=bar]")
    cx, cy = page.where("joints.C")
    page.click(cx, cy)
    page.click(cx + 60, cy + 90)
    page.until("document.getElementById('text').value.includes('[bodies.bar1]')")
    page.rested()
    page.press("[data-tool=pin]")
    end = page.where("bodies.bar1.points.B")
    page.click(*end)
    page.click(*end)
    page.until("document.getElementById('text').value.includes('[joints.pin2]')")
    page.rested()
    page.press("[data-tool=move]")
    page.picture("added")
    built = page.text("text")
    assert 'between = ["coupler", "bar1"]' in built and 'between = ["ground", "bar1"]' in built
    assert [line for line in moved.split("\n") if line not in built.split("\n")] == []

    # undone: pin, bar, drag
    for expected in (None, moved, text):
        page.key("z", 2)
        if expected is not None:
            assert page.text("text") == expected
    page.key("Z", 2 + 8)
    assert page.text("text") == moved
    page.rested()

    # saved, and loaded again
    assert file.read_bytes() == before
    page.key("s", 2)
    page.until("document.getElementById('status').textContent.startsWith('saved')")
    assert file.read_text(encoding="utf-8") == moved
    page.open()
    page.rested()
    assert page.text("text") == moved and comments(moved) == comments(text)
    assert page.said() == []


def test_the_picture_stays_under_a_hand_that_adds_while_the_live_part_arrives(page: Page) -> None:
    page.open()
    page.rested()
    page.drag("joints.D", 40, 0)
    page.rested()
    page.press("[data-tool=bar]")
    place = page.where("joints.C")
    page.until("window.symgen.editor.times().lived === window.symgen.editor.version()")
    assert page.where("joints.C") == place
    page.click(*place)
    page.click(place[0] + 60, place[1] + 90)
    page.until("document.getElementById('text').value.includes('[bodies.bar1]')")
    assert page.said() == []


def test_a_pin_of_two_bodies_follows_the_hand_and_every_step_is_drawn(page: Page) -> None:
    page.open()
    page.rested()
    page.press("#snap")
    text, frames = page.text("text"), page.run("window.symgen.editor.times().frames")
    place = "(({ x, y }) => [x, y])(window.symgen.editor.handles().find((h) => h.name === 'joints.B'))"
    x, y = page.where("joints.B")
    page.mouse("mousePressed", x, y)
    for k in range(1, 7):
        page.mouse("mouseMoved", x + 4 * k, y - 3 * k)
        page.until(f"window.symgen.editor.times().frames >= {frames + k}")
    assert page.where("joints.B") == pytest.approx((x + 24, y - 18), abs=4)
    held = page.run(place)
    page.mouse("mouseReleased", x + 24, y - 18)
    page.rested()
    assert page.run(place) == pytest.approx(held, abs=1e-3)  # where the hand left it, in metres
    changed = [a for a, b in zip(text.split("\n"), page.text("text").split("\n"), strict=True) if a != b]
    assert [line.split(" = ")[0] for line in changed] == ["points", "points"]
    page.key("z", 2)
    assert page.text("text") == text and page.said() == []


def test_keys_alone_move_a_point_complete_a_word_and_rename(page: Page) -> None:
    page.open()
    page.rested()
    page.run("[...document.querySelectorAll('.handle')].find((e) => e.title === 'joints.D').focus()")
    before = page.text("text")
    page.chromium.call("Input.dispatchKeyEvent", type="rawKeyDown", key="ArrowRight", windowsVirtualKeyCode=39)
    page.rested()
    moved = page.text("text")
    assert moved != before and '[[10.0, 0.0], "D"]' not in moved

    at = moved.index("angular_velocity")
    page.type(at, "\n")
    page.type(at, "cen")
    page.until("Boolean(document.querySelector('.cm-tooltip-autocomplete [aria-selected]'))")
    assert page.run("document.querySelector('.cm-tooltip-autocomplete [aria-selected]').textContent").startswith(
        "centre_of_mass"
    )
    assert "In the body's frame" in page.text("about")
    page.picture("completion")
    page.key("Tab")
    page.chromium.call("Input.insertText", text=" = [0.0, 0.0]")
    page.until("document.getElementById('errors').hidden")
    page.rested()
    assert "\ncentre_of_mass = [0.0, 0.0]\n" in page.text("text")

    page.key("F2")
    page.chromium.call("Input.insertText", text="arm")
    page.key("Enter")
    page.until("document.getElementById('text').value.includes('[bodies.arm]')")
    page.rested()
    renamed = page.text("text")
    assert 'between = ["arm", "coupler"]' in renamed and '"crank"' not in renamed
    page.run("document.getElementById('text').focus()")
    page.press("#remove")
    page.until("!document.getElementById('text').value.includes('[bodies.arm]')")
    assert page.run("document.getElementById('status').textContent") == "took out bodies.arm"
    page.key("z", 2)
    assert page.text("text") == renamed
    assert page.said() == []


def test_a_slider_writes_its_number_back(page: Page) -> None:
    page.open()
    page.until("window.symgen.editor.times().lived === window.symgen.editor.version()")
    assert page.run("window.symgen.live && !document.getElementById('live').inert")
    page.run(
        "(() => { const f = document.querySelector('#live input[type=number]'); f.value = 3.5;"
        " f.dispatchEvent(new Event('change', { bubbles: true })); })()"
    )
    page.until("document.getElementById('text').value.includes('crank_mass = { value = 3.5, unit')")
    page.rested()
    assert page.said() == []


def test_the_server_moves_what_has_no_code_in_the_page_and_sliders_write_into_the_text(page: Page, file: Path) -> None:
    """A state that reads an acceleration has no looped code, and straight code of 22 bodies is too long for a page."""
    file.write_text(chain_of_bars(22) + '\n[states.filtered]\nrate = "b0.alpha - filtered"\n')
    page.open()
    page.rested()
    page.until("document.querySelectorAll('#live input').length === 2 && !document.getElementById('live').inert")
    text, frames = page.text("text"), page.run("window.symgen.editor.times().frames")
    slider = "document.querySelector('#live input[type=range]')"
    for k in range(1, 4):  # a hand that moves it, then lets go
        given = f"s.value = {200 + 50 * k}; s.dispatchEvent(new Event('input', {{ bubbles: true }}))"
        page.run(f"(s => {{ {given}; }})({slider})")
        page.until(f"window.symgen.editor.times().frames >= {frames + k}")
    page.run(f"{slider}.dispatchEvent(new Event('change', {{ bubbles: true }}))")
    page.rested()
    value = float(page.text("text").split("\nm = ")[1].split("\n")[0])
    assert value == pytest.approx(4.0 ** (0.5 + 0.25), rel=1e-3)
    assert page.run("document.querySelector('#live input[type=number]').valueAsNumber") == value
    page.key("z", 2)
    assert page.text("text") == text and page.said() == []


def test_a_file_that_changed_on_the_disk_asks(page: Page, file: Path) -> None:
    page.open()
    page.rested()
    file.write_text(file.read_text() + "# theirs\n")
    page.type(0, "# ours\n")
    page.key("s", 2)
    page.until("document.getElementById('ask').open")
    page.picture("asks")
    assert "bar.toml has changed on the disk" in page.text("question")
    page.press("#back")
    assert file.read_text().endswith("# theirs\n")
    page.key("s", 2)
    page.until("document.getElementById('ask').open")
    page.rested()  # what the motion says stands where the file's own word comes
    page.press("#overwrite")
    page.until("document.getElementById('status').textContent.startsWith('saved')")
    assert file.read_text().startswith("# ours\n") and not file.read_text().endswith("# theirs\n")


HOSTILE = """\
[mechanism]
name = "bar"
title = "</script><script>window.hurt = 1</script><img src=x onerror='window.hurt = 1'>"
source = "<svg onload='window.hurt = 1'>"
gravity = [0.0, -9.81]
[run]
until = 0.1
[parameters]
m = { value = 1.0, unit = "kg", note = "</script><b onclick=1>*/ ${window.hurt = 1} `" }
[bodies.rod]
mass = "m"
inertia = 0.1
points = { A = [0.0, 0.5] }
[joints.pin]
type = "revolute"
between = ["ground", "rod"]
at = [[0.0, 0.0], "A"]
"""


def test_markup_in_a_file_stays_text(page: Page, file: Path) -> None:
    file.write_text(HOSTILE)
    page.open()
    page.until("window.symgen.editor.times().lived === window.symgen.editor.version()")
    assert page.run("document.querySelector('header h1').textContent").startswith("</script><script>")
    for name in ("'<img src=x onerror=alert(1)>'", '"</pre><script>window.hurt = 1</script>"'):
        page.type(HOSTILE.index("[bodies.rod]"), f"[bodies.{name}]\n")
        page.until("!document.getElementById('errors').hidden")
    for text in ('unit = "</u><script>window.hurt=1</script>"', 'unit = "<img src=x onerror=window.hurt=1>"'):
        page.type(HOSTILE.index('unit = "kg"'), text + ", ")
        page.until("!document.getElementById('errors').hidden")
    page.chromium.frame()
    assert page.run("window.hurt === undefined")
    assert page.run("document.querySelectorAll('#pane img, #pane script, header img, #note img').length") == 0
    assert page.said() == []


def test_narrow_and_dark_pages_have_names_for_all_controls(page: Page) -> None:
    for width, height in ((1280, 800), (390, 800)):
        page.open(width, height)
        page.rested()
        assert page.run("document.documentElement.scrollWidth <= window.innerWidth")
        if page.run("document.documentElement.dataset.theme") == "light":
            page.press("#theme")
        page.picture(f"dark-{width}")
        nameless: Any = page.run(
            "[...document.querySelectorAll('button, input, select, textarea, [role=slider], [role=toolbar]')]"
            ".filter((e) => !(e.getAttribute('aria-label') || e.getAttribute('aria-labelledby') || e.textContent.trim()"
            " || (e.labels && [...e.labels].some((l) => l.textContent.trim())))).map((e) => e.outerHTML)"
        )
        assert nameless == []
        assert page.said() == []


def test_places_are_those_of_the_next_picture(page: Page, file: Path) -> None:
    """A tool that makes room and keeps the picture as it is moves no place until then: a click would miss its point."""
    file.write_text('[mechanism]\nname = "mine"\n\n[run]\nuntil = 1.0\n')
    page.open()
    page.until("window.symgen.editor.checked()")
    for ends in (((-0.6, -0.4), (-0.5, -0.1)), ((-0.5, -0.1), (-0.35, 0.0)), ((-0.35, 0.0), (-0.3, 0.1))):
        before = page.text("text")
        page.press("[data-tool=bar]")
        for end in ends:
            page.click(*page.place(*end))
        page.until(f"document.getElementById('text').value.length > {len(before)}")
        page.rested()
        chosen = "document.querySelector('[data-tool=bar]').click(), window.symgen.editor.place(0, 0)"
        at = page.run(f"({chosen})")
        page.chromium.frame()
        assert page.run("window.symgen.editor.place(0, 0)") == at


def test_a_driven_four_bar_from_an_empty_file_by_the_mouse_alone(page: Page, file: Path) -> None:
    file.write_text('# mine\n[mechanism]\nname = "mine"\n\n[run]\nuntil = 1.0\n')
    page.open()
    page.until("window.symgen.editor.checked()")
    clicks = 0

    def click(x: float, y: float) -> None:
        nonlocal clicks
        clicks += 1
        page.click(x, y)

    def use(tool: str, *places: str | tuple[float, float]) -> None:
        nonlocal clicks
        clicks += 1
        page.press(f"[data-tool={tool}]")
        before = page.text("text")
        for place in places:
            click(*(page.where(place) if isinstance(place, str) else page.place(*place)))
        page.until(f"document.getElementById('text').value.length > {len(before)}")
        page.rested()

    use("bar", (-0.6, -0.4), (-0.5, -0.1))
    use("bar", "bodies.bar1.points.B", (0.3, 0.5))
    use("bar", "bodies.bar2.points.B", (0.5, -0.4))
    use("pin", "bodies.bar1.points.A", "bodies.bar1.points.A")
    use("pin", "bodies.bar3.points.B", "bodies.bar3.points.B")
    use("motor", "joints.pin3")
    text = page.text("text")
    assert text.count("[bodies.") == 3 and text.count('"revolute"') == 4
    assert clicks == 17 and text.startswith("# mine\n[mechanism]")
    assert '"driver"' in page.text("text")
    column = page.run("window.symgen.names.indexOf('bar1.theta')")
    angle = page.run(f"(({{ q, t }}) => [q[0][{column}], q.at(-1)[{column}], t.at(-1)])(window.symgen)")
    assert angle[2] == 1.0 and angle[1] - angle[0] == pytest.approx(2.0, abs=1e-5)
    assert "at = [[-0.6, -0.4]" in text and "at = [[0.5, -0.4]" in text
    page.picture("from-nothing")
    assert page.said() == []


def test_the_grid_has_steps_of_1_2_and_5_and_says_where_the_hand_is(page: Page, file: Path) -> None:
    file.write_text('[mechanism]\nname = "mine"\n\n[run]\nuntil = 1.0\n')
    page.open()
    page.until("window.symgen.editor.checked()")
    for k in range(40):
        scale = 3e-3 * 1.5**k
        step, fine = page.run(f"window.symgen.editor.grid({scale})")
        digits = f"{step:.6e}".split("e")[0].rstrip("0").rstrip(".")
        assert digits in ("1", "2", "5") and 40 * (1 - 1e-6) <= step * scale < 100.001
        assert round(step / fine) == (4 if digits == "2" else 5)
    page.press("[data-tool=bar]")
    page.chromium.frame()
    for at in ((-0.5, 0.0), (-0.1, 0.3)):
        page.mouse("mouseMoved", *page.place(*at))
        page.chromium.frame()
        if at[1] == 0.0:
            page.click(*page.place(*at))
    assert page.text("pointer") == "x -0.1, y 0.3 m; 0.5 m at 36.87 deg"
    page.picture("rubber")
    page.key("Escape")
    assert "[bodies." not in page.text("text") and page.said() == []


def test_lengths_are_typed_and_keys_alone_slide_a_point(page: Page, file: Path) -> None:
    file.write_text('[mechanism]\nname = "mine"\n\n[run]\nuntil = 1.0\n')
    page.open()
    page.until("window.symgen.editor.checked()")
    page.press("[data-tool=bar]")
    for typed in ("0.1, 0.2", "0.5 < 90"):
        page.run("document.getElementById('where').focus()")
        page.chromium.call("Input.insertText", text=typed)
        page.key("Enter")
    page.until("document.getElementById('text').value.includes('[bodies.bar1]')")
    page.rested()
    assert "points = { A = [0.0, 0.0], B = [0.0, 0.5] }\nposition = [0.1, 0.2]" in page.text("text")
    page.press("[data-tool=slide]")
    page.run("[...document.querySelectorAll('.handle')].find((e) => e.title === 'bodies.bar1.points.B').focus()")
    page.chromium.call("Input.dispatchKeyEvent", type="rawKeyDown", key="ArrowUp", windowsVirtualKeyCode=38)
    page.until("document.getElementById('text').value.includes('[joints.slide1]')")
    page.rested()
    assert 'at = [[0.1, 0.7], "B"]\naxis = [0.0, 1.0]' in page.text("text")
    assert page.text("freedoms") == "1 degree of freedom" and page.said() == []


def test_a_mechanism_in_space_is_edited_by_its_text(page: Page, file: Path) -> None:
    own = catalogue.file_of_entry("heavy-top")
    assert own is not None
    file.write_text(own.read_text(encoding="utf-8"))
    page.open()
    page.rested()
    assert page.run("!document.getElementById('solid').hidden && window.symgen.editor.handles().length === 0")
    page.picture("space")
    assert page.said() == []


@pytest.mark.parametrize("file", ["four-bar"], indirect=True)
def test_words_are_replaced_and_one_undo_brings_them_back(page: Page) -> None:
    page.open()
    page.rested()
    before = page.text("text")
    assert before.count("crank_mass") > 1
    page.run("document.getElementById('text').focus()")
    page.key("f", 2)
    for field, words in (("search", "crank_mass"), ("replace", "heavy")):
        page.run(f"document.querySelector('.cm-search [name={field}]').select()")
        page.chromium.call("Input.insertText", text=words)
        page.key("Tab")
    page.press(".cm-search [name=replaceAll]")
    assert page.text("text") == before.replace("crank_mass", "heavy")
    page.rested()
    page.press("#undo")
    page.rested()
    assert page.text("text") == before
    page.run("document.querySelector('.cm-search [name=search]').focus()")
    page.key("Escape")
    page.until("!document.querySelector('.cm-search')")
    assert page.said() == []


@pytest.mark.parametrize("file", ["four-bar"], indirect=True)
def test_escape_closes_completions_and_letters_are_no_keys_of_the_player(page: Page) -> None:
    page.open()
    page.rested()
    at = page.text("text").index("angular_velocity")
    page.type(at, "\n")
    page.type(at, "cen")
    page.until("Boolean(document.querySelector('.cm-tooltip-autocomplete'))")
    page.key("Escape")
    page.until("!document.querySelector('.cm-tooltip-autocomplete')")
    theme = page.run("document.documentElement.dataset.theme")
    page.key("d")  # the player's key for another theme
    assert page.run("document.documentElement.dataset.theme") == theme
    assert page.said() == []

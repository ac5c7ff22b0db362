"""Controls of a page in a browser: number fields, sliders that keep the mechanism closed, a still layout, themes."""

import json
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from PIL import Image

from symgen.api import Model, load
from symgen.base.errors import AssemblyError, InputError
from symgen.describe.files.validate import validate
from tests.browser.chromium import Chromium

pytestmark = pytest.mark.browser

#: Where everything beside the text that changes is on the page.
PLACES = """['#stage', '#controls', '#timeline', '#live', '#live .list', '.slider', '#closes', '#plots'].map((s) => {
  const r = document.querySelector(s).getBoundingClientRect(); return [s, r.top, r.left, r.width, r.height]; })"""
CLOSES = "document.getElementById('closes').textContent"


@pytest.fixture(scope="module")
def wiper(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return load("wiper").simulate(until=1.0).view().save(tmp_path_factory.mktemp("pages") / "wiper.html")


@pytest.fixture
def opened(wiper: Path, chromium: Chromium) -> Iterator[Chromium]:
    chromium.open(wiper)
    chromium.run("document.querySelectorAll('details').forEach((d) => { d.open = true; })")
    chromium.frame()
    yield chromium
    assert chromium.said == []


def field(name: str, kind: str = "number") -> str:
    return f"document.querySelector('input[type={kind}][data-name=\"{name}\"]')"


def typed(chromium: Chromium, name: str, text: str) -> None:
    script = (
        f"(() => {{ const i = {field(name)}; i.value = {json.dumps(text)}; i.dispatchEvent(new Event('change')); }})()"
    )
    chromium.run(script)
    chromium.frame()


def settled(chromium: Chromium) -> None:
    """Wait until the page has worked out its motion."""
    for _ in range(600):
        chromium.frame()
        if not chromium.run("document.getElementById('plots').classList.contains('waiting')"):
            return
    raise AssertionError("the motion is not worked out")


def test_a_number_that_is_typed_sets_the_parameter_and_moves_its_slider(opened: Chromium) -> None:
    before = float(opened.run(f"{field('arm_mass', 'range')}.value"))
    typed(opened, "arm_mass", "0.55")
    assert opened.run(f"{field('arm_mass')}.value") == "0.55" and opened.run(CLOSES) == ""
    assert float(opened.run(f"{field('arm_mass', 'range')}.value")) > before
    assert opened.run("document.getElementById('play').classList.contains('playing')")
    # and a slider that is moved writes its number, which the motion has
    opened.run(
        f"(() => {{ const i = {field('friction', 'range')}; i.value = 300; i.dispatchEvent(new Event('input')); }})()"
    )
    assert float(opened.run(f"{field('friction')}.value")) == pytest.approx(4.0, rel=1e-3)  # 2 times the root of 4
    opened.run("document.querySelector('#live button').click()")
    assert opened.run(f"[{field('arm_mass')}.value, {field('friction')}.value]") == ["0.4", "2"]


def test_nothing_moves_while_a_mechanism_does_not_close(opened: Chromium) -> None:
    """Neither for the message, nor while the motion is worked out, nor when it is."""
    opened.run("window.symgen.limits()")
    places = opened.run(PLACES)
    typed(opened, "crank_length", "0.6")
    assert opened.run(CLOSES).startswith("The mechanism does not close with crank_length = 0.6. It does from 0.0")
    assert opened.run(f"{field('crank_length')}.getAttribute('aria-invalid')") == "true"
    assert not opened.run("document.getElementById('play').classList.contains('playing')")
    assert opened.run("document.getElementById('picture').classList.contains('stale')")
    assert opened.run(PLACES) == places
    typed(opened, "crank_length", "0.04")
    assert opened.run(CLOSES) == "" and opened.run(PLACES) == places
    assert opened.run(f"{field('crank_length')}.getAttribute('aria-invalid')") == "false"
    settled(opened)
    assert opened.run(PLACES) == places


def test_sliders_go_where_the_mechanism_closes(opened: Chromium) -> None:
    """By the command's own search for a start: it finds one at both ends, and none 3 % behind an end that is nearer."""
    limits: dict[str, list[float]] = opened.run("window.symgen.limits()")
    model = load("wiper")
    values, nearer = model.parameters(), 0

    def closes(name: str, x: float) -> bool:
        try:
            model.draw({name: x})
        except (AssemblyError, InputError):
            return False
        return "cannot be assembled" not in model.draw({name: x}).caption

    for name in ("crank_length", "link_length", "rocker_length", "pivot_x"):
        full = sorted((0.25 * values[name], 4.0 * values[name]))
        for end, bound, factor in zip(limits[name], full, (1.0 / 1.03, 1.03), strict=True):
            assert full[0] <= end <= full[1] and closes(name, end)
            if end != bound:
                nearer += 1
                assert not closes(name, end * factor)
        for place in (0, 400):
            moved = f"i.value = {place}; i.dispatchEvent(new Event('input'));"
            opened.run(f"(() => {{ const i = {field(name, 'range')}; {moved} }})()")
            assert opened.run(CLOSES) == ""
        opened.run("document.querySelector('#live button').click()")
        opened.run("window.symgen.limits()")
    assert nearer >= 4


def test_many_parameters_are_folded(chromium: Chromium, tmp_path: Path) -> None:
    """Of Jansen's leg 4 of 27 are seen at first; lengths and what follows from them by formulas are below."""
    chromium.open(load("jansen-leg").simulate(until=0.1).view().save(tmp_path / "leg.html"))
    assert (
        chromium.run("[...document.querySelectorAll('#live .slider')].filter((s) => s.checkVisibility()).length") == 4
    )
    summaries = chromium.run("[...document.querySelectorAll('#live summary')].map((s) => s.textContent)")
    assert [s.partition(":")[0] for s in summaries] == ["15 in m", "8 from others"]
    assert chromium.run("document.getElementById('trace').value") == "free"
    assert chromium.said == []


def test_dark_as_the_system_is_and_by_the_button(wiper: Path, chromium: Chromium, tmp_path: Path) -> None:
    light, dark = (255, 255, 255), (20, 24, 30)

    def prefer(scheme: str) -> None:
        features: Any = [{"name": "prefers-color-scheme", "value": scheme}]
        chromium.call("Emulation.setEmulatedMedia", features=features)

    def papers() -> set[Any]:
        """Return the colours of the page's own paper and of that of its picture."""
        chromium.frame()
        x, y = chromium.run(
            "(({ left, top }) => [left + 4, top + 4])(document.querySelector('#view').getBoundingClientRect())"
        )
        with Image.open(chromium.picture(tmp_path / "page.png")) as picture:
            return {picture.convert("RGB").getpixel(at) for at in ((2, 2), (int(x), int(y)))}

    press = "document.getElementById('theme').click()"
    try:
        for scheme, own, other in (("dark", dark, light), ("light", light, dark)):
            prefer(scheme)
            chromium.open(wiper)
            assert papers() == {own}
            chromium.run(press)
            assert papers() == {other}
        prefer("dark")
        chromium.run(press)
        prefer("light")
        prefer("dark")
        assert papers() == {light}  # which was chosen
    finally:
        prefer("light")
    assert chromium.said == []


#: A script that notes what canvases write: text, width, place, alignment, and whether it stands upright.
WRITTEN = """(() => {
  const given = CanvasRenderingContext2D.prototype.fillText;
  window.written = [];
  CanvasRenderingContext2D.prototype.fillText = function (text, x, ...rest) {
    window.written.push([text, this.measureText(text).width, x, this.textAlign, this.getTransform().b !== 0]);
    return given.call(this, text, x, ...rest);
  };
})();"""


def test_numbers_and_titles_of_plots_have_room(chromium: Chromium, tmp_path: Path) -> None:
    names = [f"a_body_whose_name_is_as_long_as_names_of_robots_are_{i}" for i in range(3)]
    bodies = {name: {"mass": 1.0, "inertia": 1.0, "velocity": [-1.7e-10, 0.0]} for name in names}
    raw = {"mechanism": {"name": "slow", "gravity": [0.0, 0.0]}, "bodies": bodies}
    path = Model(validate(raw, "slow")).simulate(until=1.0).view().save(tmp_path / "slow.html")
    chromium.open(path, scripts=(WRITTEN,))
    chromium.frame()
    written = chromium.run("window.written")
    numbers = [(width, x) for _, width, x, align, turned in written if align == "right" and not turned]
    titles = [(text, width) for text, width, _, _, turned in written if turned]
    assert len(numbers) > 2 and titles
    assert min(x - width for width, x in numbers) > 16.0  # beside the title
    height = chromium.run("document.querySelector('#plots canvas').getBoundingClientRect().height")
    assert max(width for _, width in titles) < height
    assert any("e-1" in text for text, *_ in written)


def test_a_phone_cuts_neither_names_nor_units_nor_lists(wiper: Path, chromium: Chromium) -> None:
    chromium.open(wiper, width=390, height=844)
    chromium.frame()
    cut = """[...document.querySelectorAll('.slider span')].filter((s) =>
      s.offsetParent && s.scrollWidth > s.clientWidth)"""
    assert chromium.run(f"{cut}.map((s) => s.textContent)") == []
    beyond = """[...document.querySelectorAll('select')].filter((s) =>
      s.getBoundingClientRect().right > s.closest('section').getBoundingClientRect().right)"""
    assert chromium.run(f"{beyond}.map((s) => s.id)") == []
    assert chromium.run("document.documentElement.scrollWidth") == 390

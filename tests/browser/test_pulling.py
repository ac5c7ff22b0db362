"""A hand that pulls bodies of a page by a spring while the motion plays."""

import json
import math
import shutil
import time
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from support.emitted import mechanism_of

from symgen.api import Model, load
from symgen.describe import catalogue
from symgen.describe.catalogue import raw
from tests.browser.chromium import PATIENCE, Chromium
from tests.browser.editor_page import Page

pytestmark = pytest.mark.browser

#: Mechanism -> coordinates, the body that is pulled, a point of it, where to, stiffness and damping.
PULLED = {
    "pendulum": ("absolute", "bob", [0.0, 0.0], [0.3, -0.2], 40.0, 3.0),
    "four-bar": ("absolute", "coupler", [0.7, 0.4], [2.0, 3.0], 60.0, 8.0),
    "cart-pole": ("joint", "pole", [0.0, 0.3], [0.5, 1.0], 4.0, 0.5),
    "spherical-double-pendulum": ("absolute", "upper", [0.0, 0.1, -0.3], [0.5, 0.2, 0.4], 30.0, 2.0),
}


def with_spring(name: str, body: str, at: list[float], to: list[float], k: float, c: float) -> Model:
    """Return a mechanism with the spring of the hand as a force in its file."""
    file = raw(name)
    spring = {
        **{"type": "bushing", "between": ["ground", body], "at": [to, at], "frame": "ground"},
        **{"stiffness": [k] * len(at) + [0.0] * (1 if len(at) == 2 else 3)},
        **{"damping": [c] * len(at) + [0.0] * (1 if len(at) == 2 else 3)},
    }
    return Model(mechanism_of({**file, "forces": {**file.get("forces", {}), "hand": spring}}))


@pytest.mark.by_turns(3)
@pytest.mark.slow
@pytest.mark.parametrize("name", PULLED)
def test_a_pulled_body_moves_as_with_the_spring_in_its_file(name: str, chromium: Chromium, tmp_path: Path) -> None:
    coordinates, body, at, to, k, c = PULLED[name]
    chromium.open(load(name).simulate(until=1.0, coordinates=coordinates).view().save(tmp_path / "page.html"))
    hand = json.dumps([{"t": 0, "hand": {"name": body, "at": at, "to": to, "k": k, "c": c}}])
    step = chromium.run("symgen.step")
    found = np.array(chromium.run(f"symgen.run({{}}, 1.0, {step}, {hand})"))
    free = np.array(chromium.run(f"symgen.run({{}}, 1.0, {step})"))
    run = with_spring(name, body, at, to, k, c).simulate(
        until=1.0, integrator="rk4", step=step, coordinates=coordinates, output_step=1.0
    )
    names = chromium.run("symgen.state")
    tables = run.whole()
    columns = {n: tables[n] for n in names if n in tables.names}
    places = [i for i, n in enumerate(names) if n in columns]
    assert len(places) >= 2
    expected = np.array([columns[names[i]][-1] for i in places])
    assert np.abs(found[places] - expected).max() < 1e-9 * max(1.0, np.abs(expected).max())
    assert np.abs(free[places] - expected).max() > 0.01
    assert chromium.said == []


def mouse(chromium: Chromium, kind: str, x: float, y: float) -> None:
    held = {"button": "left", "clickCount": 1, "buttons": int(kind != "mouseReleased")}
    chromium.call("Input.dispatchMouseEvent", type=kind, x=x, y=y, **held)


def until(chromium: Chromium, words: str) -> Any:
    ends = time.monotonic() + PATIENCE
    while not (found := chromium.run(words)):
        assert time.monotonic() < ends, f"never: {words}; {chromium.said}"
        time.sleep(0.02)
    return found


def place(chromium: Chromium, point: list[float]) -> tuple[float, float]:
    box = chromium.run("(({ left, top }) => [left, top])(document.getElementById('view').getBoundingClientRect())")
    x, y = chromium.run(f"symgen.place({json.dumps(point)})")
    return box[0] + x, box[1] + y


def place_at_rest(chromium: Chromium) -> list[float]:
    """Where the held point comes to rest: between frames it is drawn on a chord while it moves."""
    ends, at, moved = time.monotonic() + PATIENCE, chromium.run("symgen.hand.at"), math.inf
    while moved > 1e-6:
        assert time.monotonic() < ends, f"never at rest: {at}; {chromium.said}"
        for _ in range(20):
            chromium.frame()
        before, at = at, chromium.run("symgen.hand.at")
        moved = math.dist(at, before)
    return list(at)


def test_a_drag_while_it_plays_pulls_the_body_to_the_pointer(chromium: Chromium, tmp_path: Path) -> None:
    chromium.open(load("pendulum").simulate(until=2.0).view().save(tmp_path / "page.html"))
    recorded = chromium.run("symgen.q.at(-1)")
    chromium.run("symgen.frame(0.3)")
    q = chromium.run("symgen.q")
    x, y = place(chromium, q[round(0.3 * (len(q) - 1))])
    goal = place(chromium, [0.5, 0.6])
    # nothing is pulled while the motion stands still
    mouse(chromium, "mousePressed", x, y)
    mouse(chromium, "mouseMoved", x + 9, y)
    mouse(chromium, "mouseReleased", x, y)
    assert chromium.run("symgen.hands") == []
    chromium.run("document.getElementById('fit').click()")
    chromium.run(
        "document.getElementById('speed').value = '0.01';"
        "document.getElementById('speed').dispatchEvent(new Event('change'))"
    )
    chromium.run("document.getElementById('play').click()")
    mouse(chromium, "mousePressed", x, y)
    mouse(chromium, "mouseMoved", *goal)
    hand, held = until(chromium, "symgen.hand && [symgen.hand, symgen.now('bob')]")
    assert hand["name"] == "bob" and hand["k"] > 0.0 and hand["force"] > 0.0
    assert hand["to"] == pytest.approx([0.5, 0.6], abs=0.01)
    chromium.run(
        "document.getElementById('speed').value = '1';"
        "document.getElementById('speed').dispatchEvent(new Event('change'))"
    )
    # the bob stays on its circle and comes to rest where spring and weight are in balance; what is held lies beside it,
    # by as much as the bob moved between the time at which the pointer was aimed and the press
    at = place_at_rest(chromium)
    bob = chromium.run("symgen.now('bob')")
    assert math.hypot(*bob) == pytest.approx(1.0, abs=1e-6)
    assert bob[1] > 0.0  # above the pin
    assert math.dist(at, [*bob, 0.0]) == pytest.approx(math.dist(hand["at"], [*held, 0.0]), abs=1e-5)
    words = chromium.run("document.getElementById('hint').textContent")
    assert words.startswith("spring of ") and "N/m" in words
    mouse(chromium, "mouseReleased", *goal)
    until(chromium, "symgen.hand === null")
    until(chromium, "symgen.groups().length > 0")  # worked out to its end
    assert chromium.run("symgen.hands.at(-1).hand") is None
    assert chromium.run("symgen.q.at(-1)") == recorded  # the recording stays
    assert chromium.said == []


def test_a_body_that_its_drivers_hold_is_not_pulled(chromium: Chromium, tmp_path: Path) -> None:
    chromium.open(load("driven-four-bar").simulate(until=2.0).view().save(tmp_path / "page.html"))
    q = chromium.run("symgen.q[0]")
    chromium.run("document.getElementById('speed').value = '0.01';")
    chromium.run(
        "document.getElementById('speed').dispatchEvent(new Event('change'));document.getElementById('play').click()"
    )
    x, y = place(chromium, [q[0], q[1]])
    mouse(chromium, "mousePressed", x, y)
    mouse(chromium, "mouseMoved", x + 40, y + 20)
    until(
        chromium,
        "document.getElementById('hint').textContent === 'crank moves as its drivers say: no hand pulls it away'",
    )
    mouse(chromium, "mouseReleased", x + 40, y + 20)
    assert chromium.run("symgen.hand") is None and chromium.said == []


def test_arrow_keys_and_fingers_pull_in_the_editor(chromium: Chromium, tmp_path: Path) -> None:
    own = catalogue.file_of_entry("four-bar")
    assert own is not None
    with Page.of(chromium, Path(shutil.copy(own, tmp_path / "bar.toml"))) as page:
        page.open(1280, 900)
        page.until("window.symgen.editor.times().lived === window.symgen.editor.version()")
        text = page.text("text")
        page.press("#play")
        page.run("document.getElementById('view').focus()")
        page.key("b")
        assert page.text("status").startswith("bodies.crank is selected")
        page.key("b")
        down = {"type": "rawKeyDown", "key": "ArrowUp", "windowsVirtualKeyCode": 38}
        chromium.call("Input.dispatchKeyEvent", **down)
        hand = until(chromium, "symgen.hand")
        assert hand["name"] == "coupler"
        chromium.call("Input.dispatchKeyEvent", **down)
        farther = until(chromium, f"symgen.hand.to[1] > {hand['to'][1]} + 1e-3 && symgen.hand")
        assert farther["to"][0] == pytest.approx(hand["to"][0], abs=1e-9)
        page.picture("pulled")
        chromium.call("Input.dispatchKeyEvent", **{**down, "type": "keyUp"})
        until(chromium, "symgen.hand === null && symgen.hands.at(-1).hand === null")

        finger = until(chromium, "symgen.now('coupler')")
        x, y = page.place(*finger)
        chromium.call("Input.dispatchTouchEvent", type="touchStart", touchPoints=[{"x": x, "y": y}])
        chromium.call("Input.dispatchTouchEvent", type="touchMove", touchPoints=[{"x": x + 60, "y": y - 60}])
        assert until(chromium, "symgen.hand")["force"] > 0.0
        chromium.call("Input.dispatchTouchEvent", type="touchEnd", touchPoints=[])
        until(chromium, "symgen.hand === null")
        assert page.text("text") == text and page.said() == []

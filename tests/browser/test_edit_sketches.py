"""Fourteen mechanisms drawn in ``symgen edit`` from an empty file, by the mouse and typed places, then by keys alone.

Each closes as it was drawn: joints are measured here by the numbers of the text, and ``symgen check`` has no note.
"""

import json
import subprocess
import sys
import tomllib
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from tests.browser.chromium import Chromium
from tests.browser.editor_page import Page

pytestmark = pytest.mark.browser

EMPTY = '[mechanism]\nname = "mine"\ngravity = [0.0, -9.81]\n\n[run]\nuntil = 1.0\n'
Place = str | tuple[float, float]


@dataclass
class Hand:
    """A hand that draws: each press of a button, each click and each piece of typed text is an action."""

    page: Page
    keys: bool = False
    actions: int = 0
    tool: str = "move"
    places: list[tuple[float, float]] = field(default_factory=list)

    def use(self, tool: str, *places: Place) -> None:
        """Use a tool at places: points by name, or coordinates in metres, which are typed."""
        self.choose(tool)
        before = self.page.text("text")
        for place in places:
            self.actions += 1
            if not isinstance(place, str):
                self.page.run("document.getElementById('where').focus()")
                self.page.chromium.call("Input.insertText", text=f"{place[0]}, {place[1]}")
                self.page.key("Enter")
            elif self.keys:
                self.focus(place)
                self.page.key("Enter")
            else:
                self.page.click(*self.page.where(place))
        self.changed(before)

    def choose(self, tool: str) -> None:
        if tool == self.tool:
            return
        self.actions += 1
        self.tool = tool
        if self.keys:
            self.page.run(f"document.querySelector('[data-tool={tool}]').focus()")
            self.page.key("Enter")
        else:
            self.page.press(f"[data-tool={tool}]")

    def focus(self, name: str) -> None:
        """Give the focus to a ringed point, as the tabulator does."""
        self.page.run(
            "(all => all.filter((e) => e.title === " + json.dumps(name) + ").at(-1).focus())"
            "([...document.querySelectorAll('.handle')])"
        )

    def drag(self, tool: str, point: str, to: str | tuple[int, int]) -> None:
        """Use a tool by a drag from a point to another one, or so many pixels far; by keys, as they do that."""
        self.choose(tool)
        self.actions += 1
        before = self.page.text("text")
        if self.keys:
            self.focus(point)
            self.page.key("Enter" if isinstance(to, str) else "ArrowDown", 8)
            if isinstance(to, str):
                self.focus(to)
                self.page.key("Enter")
        else:
            x, y = self.page.where(point)
            end = self.page.where(to) if isinstance(to, str) else (x + to[0], y + to[1])
            self.page.drag(point, end[0] - x, end[1] - y)
        self.changed(before)

    def changed(self, before: str) -> None:
        self.page.until(f"document.getElementById('text').value !== {json.dumps(before)}")
        self.settle()

    def bar(self, *places: Place) -> None:
        self.use("bar", *places)

    def pin(self, first: Place, second: Place) -> None:
        self.use("pin", first, second)

    def ground(self, point: str) -> None:
        """Pin a point to the ground."""
        self.use("pin", point, point)

    def write(self, text: str, behind: str = "") -> None:
        """Type lines behind the first line that has some words, or at the end."""
        now = self.page.text("text")
        assert behind in now, now
        at = now.index("\n", now.index(behind)) + 1 if behind else len(now)
        self.page.type(at, text)
        self.actions += 1
        self.settle()

    def settle(self) -> None:
        """Wait until the text has been checked, and has no error."""
        self.page.until("window.symgen.editor.checked()")
        said = self.page.text("errors") + self.page.text("status")
        assert self.page.run("document.getElementById('errors').hidden"), said


def pendulum(hand: Hand) -> None:
    hand.bar((0.0, 0.0), (1.0, 0.0))
    hand.ground("bodies.bar1.points.A")


def four_bar(hand: Hand) -> None:
    hand.bar((0.0, 0.0), (0.1, 0.3))
    hand.bar("bodies.bar1.points.B", (0.9, 0.8))
    hand.bar("bodies.bar2.points.B", (1.0, 0.0))
    hand.ground("bodies.bar1.points.A")
    hand.ground("bodies.bar3.points.B")
    hand.use("motor", "joints.pin3")


def slider_crank(hand: Hand) -> None:
    hand.bar((0.0, 0.0), (0.2, 0.2))
    hand.bar("bodies.bar1.points.B", (1.0, 0.0))
    hand.bar("bodies.bar2.points.B", (1.1, 0.0))
    hand.ground("bodies.bar1.points.A")
    hand.use("slide", "joints.pin2")
    hand.use("motor", "joints.pin3")


def press(hand: Hand) -> None:
    hand.bar((0.0, 1.0), (0.2, 0.5))
    hand.bar("bodies.bar1.points.B", (0.0, 0.0))
    hand.bar("bodies.bar2.points.B", (0.0, -0.3))
    hand.ground("bodies.bar1.points.A")
    hand.drag("slide", "bodies.bar3.points.B", (0, 60))
    hand.write("stop = { lower = -0.05, upper = 0.5, restitution = 0.2 }\n", behind="axis = [0.0, -1.0]")


def wiper(hand: Hand) -> None:
    hand.bar((0.0, 0.0), (0.1, 0.3))
    hand.bar("bodies.bar1.points.B", (0.9, 0.8))
    hand.use("plate", "bodies.bar2.points.B", (1.0, 0.0), (1.2, 1.8))
    hand.ground("bodies.bar1.points.A")
    hand.ground("bodies.plate1.points.B")
    hand.use("motor", "joints.pin3")


def scissor_lift(hand: Hand) -> None:
    hand.bar((0.0, 0.0), (1.0, 0.6))
    hand.bar((1.0, 0.0), (0.0, 0.6))
    hand.use("point", "bodies.bar1.points.A", (0.5, 0.3))
    hand.use("point", "bodies.bar2.points.A", (0.5, 0.3))
    hand.pin("bodies.bar1.points.C", "bodies.bar1.points.C")
    hand.ground("bodies.bar1.points.A")
    hand.bar("bodies.bar2.points.A", (1.1, 0.0))
    hand.use("slide", "bodies.bar3.points.B")
    hand.use("spring", "bodies.bar1.points.B", "bodies.bar2.points.B")


def watt(hand: Hand) -> None:
    hand.bar((-1.0, 0.1), (0.0, 0.2))
    hand.bar("bodies.bar1.points.B", (0.1, -0.2))
    hand.bar("bodies.bar2.points.B", (1.1, -0.1))
    hand.ground("bodies.bar1.points.A")
    hand.ground("bodies.bar3.points.B")
    hand.use("load", "joints.pin1")


def bucket(hand: Hand) -> None:
    hand.use("plate", (0.0, 0.0), (0.4, 0.1), (0.3, -0.5))
    hand.bar("bodies.plate1.points.B", (0.2, 0.6))
    hand.bar("bodies.bar1.points.B", (-0.4, 0.4))
    hand.ground("bodies.plate1.points.A")
    hand.ground("bodies.bar2.points.B")
    hand.use("spring", "joints.pin2", (-0.9, 1.0))
    hand.use("load", "bodies.plate1.points.C")


def cart_pole(hand: Hand) -> None:
    hand.bar((-0.2, 0.0), (0.2, 0.0))
    hand.use("slide", "bodies.bar1.points.A")
    hand.bar("bodies.bar1.points.B", (0.25, 1.0))


def gears(hand: Hand) -> None:
    hand.bar((0.0, 0.0), (0.0, 0.2))
    hand.bar((1.0, 0.0), (1.0, 0.3))
    hand.ground("bodies.bar1.points.A")
    hand.ground("bodies.bar2.points.A")
    hand.use("gear", "joints.pin1", "joints.pin2")
    hand.use("friction", "joints.pin2")
    hand.use("motor", "joints.pin1")


def scotch_yoke(hand: Hand) -> None:
    hand.bar((0.0, 0.0), (0.2, 0.1))
    hand.bar((0.2, 0.6), (0.8, 0.6))
    hand.ground("bodies.bar1.points.A")
    hand.use("slide", "bodies.bar2.points.B")
    hand.drag("slot", "bodies.bar1.points.B", "bodies.bar2.points.A")
    hand.use("stop", "bodies.bar2.points.B")


def quick_return(hand: Hand) -> None:
    hand.bar((0.0, 0.4), (0.3, 0.4))
    hand.bar((0.0, 0.0), (0.6, 0.8))
    hand.ground("bodies.bar1.points.A")
    hand.ground("bodies.bar2.points.A")
    hand.drag("slot", "bodies.bar1.points.B", "bodies.bar2.points.B")
    hand.use("motor", "joints.pin1")


def jack(hand: Hand) -> None:
    hand.bar((0.0, 0.0), (0.8, 0.3))
    hand.use("copy", "bodies.bar1.points.A", (0.0, 0.4))
    hand.bar("bodies.bar1.points.B", "bodies.bar2.points.B")
    hand.ground("bodies.bar1.points.A")
    hand.ground("bodies.bar2.points.A")
    hand.use("cylinder", "joints.pin3", "joints.pin2")
    hand.use("rod", "joints.pin1", (0.3, -0.5))


BELT = """\
[joints.wheels]
type = "coupling"
terms = { pin1 = 1.0, pin2 = -2.0 }
"""


def belt(hand: Hand) -> None:
    hand.bar((-0.1, 0.0), (0.1, 0.0))
    hand.bar((0.9, 0.0), (1.1, 0.0))
    hand.write('[joints.pin1]\ntype = "revolute"\nbetween = ["ground", "bar1"]\nat = [[0.0, 0.0], "centre"]\n')
    hand.write('[joints.pin2]\ntype = "revolute"\nbetween = ["ground", "bar2"]\nat = [[1.0, 0.0], "centre"]\n')
    hand.write(BELT)
    hand.write('[forces.drive]\ntype = "torque"\nbody = "bar1"\ntorque = 0.1\n')


@pytest.fixture
def page(chromium: Chromium, tmp_path: Path) -> Iterator[Page]:
    file = tmp_path / "mine.toml"
    file.write_text(EMPTY)
    with Page.of(chromium, file) as opened:
        opened.open()
        opened.until("window.symgen.editor.checked()")
        yield opened


def widest_gap(text: str) -> float:
    """Return by how much joints of a drawn file are open at most [m]: bodies stand there without an angle."""
    raw = tomllib.loads(text)

    def place(body: str, point: Any) -> Any:
        if body == "ground":
            return np.array(point)
        own = raw["bodies"][body]
        where = own.get("centre_of_mass", [0.0, 0.0]) if point == "centre" else own["points"][point]
        return np.array(own["position"]) + where

    gaps = list[float]()
    for joint in raw["joints"].values():
        if joint["type"] in ("revolute", "translational", "pin-in-slot"):
            a, b = (place(*end) for end in zip(joint["between"], joint["at"], strict=True))
            x, y = joint.get("axis", [0.0, 0.0])
            gaps.append(abs((b - a) @ [-y, x]) if "axis" in joint else float(np.hypot(*(b - a))))
            assert "angle" not in joint
    return max(gaps)


def checked(page: Page, text: str) -> tuple[str, str]:
    """Return what ``symgen check`` says of a text, in a process of its own, and what it warns of."""
    file = page.editor.document.path.with_name("drawn.toml")
    file.write_text(text)
    asked = [sys.executable, "-m", "symgen", "check", str(file)]
    done = subprocess.run(asked, capture_output=True, text=True, check=False)
    return done.stdout, done.stderr


def column(page: Page, name: str) -> Any:
    return np.array(page.run(f"window.symgen.column({json.dumps(name)}).values"))


@pytest.mark.by_turns(3)
@pytest.mark.fast("pendulum-6-1-1-keys", "four_bar-14-3-0-mouse")
@pytest.mark.parametrize("keys", [False, True], ids=["mouse", "keys"])
@pytest.mark.parametrize(
    ("draw", "actions", "bodies", "freedoms"),
    [
        (pendulum, 6, 1, 1),
        (four_bar, 14, 3, 0),
        (slider_crank, 14, 3, 0),
        (press, 13, 3, 1),
        (wiper, 16, 3, 0),
        (scissor_lift, 23, 3, 1),
        (watt, 14, 3, 1),
        (bucket, 19, 3, 1),
        (cart_pole, 8, 2, 2),
        (belt, 9, 2, 1),
        (gears, 17, 2, 0),
        (scotch_yoke, 14, 2, 1),
        (quick_return, 14, 2, 0),
        (jack, 20, 3, 0),
    ],
)
def test_a_mechanism_from_an_empty_file(
    draw: Callable[[Hand], None], actions: int, bodies: int, freedoms: int, keys: bool, page: Page
) -> None:
    hand = Hand(page, keys)
    draw(hand)
    page.rested()
    page.picture(draw.__name__)
    text = page.text("text")
    assert page.run("document.getElementById('errors').hidden"), page.text("errors")
    facts = page.text("facts").split(" · remark ")[0]  # on what "centre" means, where a hand writes it
    assert facts.endswith("status ok"), (page.text("facts"), page.text("status"), text)
    assert page.text("freedoms").split(";")[0] == f"{freedoms} degree{'s' if freedoms != 1 else ''} of freedom"
    assert ".mode" not in page.text("key")  # what is plotted first is a motion
    assert text.count("[bodies.") == bodies and text.startswith(EMPTY)
    assert hand.actions == actions
    assert widest_gap(text) < 1e-15
    said, warned = checked(page, text)
    assert ": valid, and it closes\n" in said
    assert all('"centre" is the centre of mass' in line for line in warned.splitlines()), warned
    gap = np.max(column(page, "violation.position"))
    assert gap < -6.0 and page.said() == []  # a power of ten

"""Machines drawn in ``symgen edit`` by the mouse alone, on a desk and on a telephone: joints, places and motion."""

import tomllib
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from tests.browser.chromium import Chromium
from tests.browser.editor_page import Page
from tests.browser.test_edit_sketches import EMPTY, Hand, Place, column

pytestmark = pytest.mark.browser

G = 9.81


class Mouse(Hand):
    """A hand that clicks at places of the grid, and at ringed points."""

    def use(self, tool: str, *places: Place) -> None:
        if self.page.run("document.querySelectorAll('.handle').length"):
            self.page.rested()
        self.choose(tool)
        before = self.page.text("text")
        for place in places:
            self.actions += 1
            self.page.click(*(self.page.where(place) if isinstance(place, str) else self.page.place(*place)))
        self.changed(before)


def cart(hand: Mouse) -> None:
    """A wheel on a slope of 3 to 4."""
    hand.use("wheel", (0.0, 0.4), (0.5, 0.4))
    hand.use("roll", "bodies.wheel1.points.A", (0.3, 0.0))


def ball(hand: Mouse) -> None:
    """A disc above the ground."""
    hand.use("wheel", (0.0, 0.4), (0.2, 0.4))
    hand.use("touch", "bodies.wheel1.points.A", (0.0, 0.0))


def rack_lift(hand: Mouse) -> None:
    """A pinion at the ground beside a rack that a slide guides upwards."""
    hand.use("wheel", (0.0, 0.0), (0.2, 0.0))
    hand.ground("bodies.wheel1.points.A")
    hand.use("bar", (0.2, 0.3), (0.2, 0.8))
    hand.drag("slide", "bodies.bar1.points.A", (0, -30))
    hand.use("rack", "joints.pin1", "bodies.bar1.points.A")
    hand.use("motor", "joints.pin1")


def hoist(hand: Mouse) -> None:
    """Two cages on a rope over a sheave, in guides; a driver lowers one of them."""
    hand.use("bar", (-0.1, -0.5), (-0.1, -0.2))
    hand.drag("slide", "bodies.bar1.points.A", (0, 60))
    hand.use("bar", (0.1, -0.5), (0.1, -0.2))
    hand.drag("slide", "bodies.bar2.points.A", (0, 60))
    hand.use("rope", "bodies.bar1.points.B", (0.0, 0.3), (0.0, 0.4), "bodies.bar2.points.B")
    hand.use("motor", "bodies.bar2.points.A")


def cam(hand: Mouse) -> None:
    """A disc that turns about a point of its rim, below a follower with a flat face."""
    hand.use("wheel", (0.0, 0.2), (0.0, 0.0))
    hand.ground("bodies.wheel1.points.B")
    hand.use("bar", (0.0, 0.4), (0.0, 0.7))
    hand.drag("slide", "bodies.bar1.points.B", (0, -40))
    hand.use("touch", "bodies.wheel1.points.A", "bodies.bar1.points.A")
    hand.use("motor", "joints.pin1")


def five_bar(hand: Mouse) -> None:
    """Two cranks on wheels that mesh, and two rods that meet."""
    hand.use("bar", (-0.3, 0.0), (-0.3, 0.2))
    hand.use("bar", (0.3, 0.0), (0.3, 0.2))
    hand.ground("bodies.bar1.points.A")
    hand.ground("bodies.bar2.points.A")
    hand.use("gear", "joints.pin1", "joints.pin2")
    hand.use("bar", "bodies.bar1.points.B", (0.0, 0.7))
    hand.use("bar", "bodies.bar3.points.B", "bodies.bar2.points.B")
    hand.use("motor", "joints.pin1")


def toggle_clamp(hand: Mouse) -> None:
    """A handle pushes a knee straight, which presses an arm on its spring."""
    hand.use("plate", (-0.4, 0.0), (-0.2, 0.2), (-0.5, 0.6))
    hand.use("bar", "bodies.plate1.points.B", (0.2, 0.3))
    hand.use("plate", "bodies.bar1.points.B", (0.2, 0.0), (0.6, 0.2))
    hand.ground("bodies.plate1.points.A")
    hand.ground("bodies.plate2.points.B")
    hand.use("spring", "bodies.plate2.points.C", (0.6, -0.4))
    hand.use("load", "bodies.plate1.points.C")


def door(hand: Mouse) -> None:
    """A garage door, its rails first: a slot above, and a slide of an arm on a spring."""
    hand.use("bar", (0.0, -0.5), (0.0, 0.5))
    hand.drag("slot", "bodies.bar1.points.B", (80, 0))
    hand.use("bar", (-0.4, 0.0), (0.0, 0.0))
    hand.use("spring", "bodies.bar2.points.A", "bodies.bar1.points.A")
    hand.ground("bodies.bar2.points.A")


def bogie(hand: Mouse) -> None:
    """Two wheels on the ground that carry a bar, and a motor in one of them."""
    for x in (-0.4, 0.4):
        hand.use("wheel", (x, 0.2), (x, 0.4))
    hand.use("roll", "bodies.wheel1.points.A", (-0.4, 0.0))
    hand.use("roll", "bodies.wheel2.points.A", (0.4, 0.0))
    hand.use("bar", "bodies.wheel1.points.A", "bodies.wheel2.points.A")
    hand.use("motor", "joints.pin1")


def lever_on_a_cam(hand: Mouse) -> None:
    """A disc that turns about a point of its rim lifts a lever that lies on it."""
    hand.use("wheel", (0.2, 0.0), (0.2, -0.2))
    hand.use("bar", (-0.6, 0.2), (0.6, 0.2))
    hand.use("point", "bodies.bar1.points.A", (0.2, 0.2))
    hand.ground("bodies.bar1.points.A")
    hand.ground("bodies.wheel1.points.B")
    hand.use("touch", "bodies.wheel1.points.A", "bodies.bar1.points.C")
    hand.use("motor", "joints.pin2")


def rack_drive(hand: Mouse) -> None:
    """A rack that a driver pushes turns a pinion above it."""
    hand.use("wheel", (0.0, 0.2), (0.2, 0.2))
    hand.ground("bodies.wheel1.points.A")
    hand.use("bar", (0.4, 0.0), (0.8, 0.0))
    hand.use("slide", "bodies.bar1.points.A")
    hand.use("rack", "joints.pin1", "bodies.bar1.points.A")
    hand.use("motor", "bodies.bar1.points.A")


def locomotive(hand: Mouse) -> None:
    """A wheel on the ground, a rod at its rim, and the other end of the rod in a slot of the ground."""
    hand.use("wheel", (0.0, 0.2), (0.2, 0.2))
    hand.use("roll", "bodies.wheel1.points.A", (0.0, 0.0))
    hand.use("bar", "bodies.wheel1.points.B", (0.8, 0.2))
    hand.use("slot", "bodies.bar1.points.B")


@dataclass(frozen=True)
class Machine:
    """What a drawing gives: types of its joints and contacts, freedoms, and a residual of its motion that is 0."""

    draw: Callable[[Mouse], None]
    joints: tuple[str, ...]
    freedoms: int
    motion: Callable[[Callable[[str], Any]], Any]


TIMES = np.linspace(0.0, 1.0, 1001)
MACHINES = [
    # a uniform disc takes two thirds of the weight along the slope
    Machine(cart, ("rolling",), 1, lambda c: c("wheel1.x") + (1.0 / 3.0) * G * 0.6 * 0.8 * TIMES**2),
    Machine(ball, ("touch",), 3, lambda c: np.minimum(c("wheel1.y") - 0.2, 0.0)),
    Machine(rack_lift, ("coupling", "driver", "revolute", "translational"), 0, lambda c: c("bar1.vy") - 0.2 * 2.0),
    Machine(hoist, ("driver", "rope", *("translational",) * 2), 0, lambda c: c("bar1.vy") - 0.1),
    Machine(
        *(cam, ("driver", "revolute", "touch", "translational"), 1),
        lambda c: np.minimum(c("bar1.y") - c("wheel1.y") - 0.2, 0.0),
    ),
    Machine(
        *(five_bar, ("driver", "gear", *("revolute",) * 5), 0),
        lambda c: c("bar1.omega") + c("bar2.omega"),
    ),
    Machine(
        *(bogie, ("driver", "revolute", "revolute", "rolling", "rolling"), 0),
        lambda c: np.abs(c("bar1.vx")) - 0.2 * 2.0,
    ),
    Machine(
        *(lever_on_a_cam, ("driver", "revolute", "revolute", "touch"), 1),
        lambda c: np.minimum(
            (c("bar1.y") - c("wheel1.y")) * np.cos(c("bar1.theta"))
            - (c("bar1.x") - c("wheel1.x")) * np.sin(c("bar1.theta"))
            - 0.2,
            0.0,
        ),
    ),
    Machine(
        *(rack_drive, ("coupling", "driver", "revolute", "translational"), 0),
        lambda c: c("wheel1.omega") - 0.1 / 0.2,
    ),
    Machine(locomotive, ("pin-in-slot", "revolute", "rolling"), 1, lambda c: 10.0 ** c("energy.error")),
    Machine(toggle_clamp, ("revolute",) * 4, 1, lambda c: 10.0 ** c("energy.error")),
    Machine(door, ("pin-in-slot", "revolute"), 3, lambda c: 10.0 ** c("energy.error")),
]


@pytest.fixture(params=[1280, 390])
def page(request: pytest.FixtureRequest, chromium: Chromium, tmp_path: Path) -> Iterator[Page]:
    file = tmp_path / "mine.toml"
    file.write_text(EMPTY)
    with Page.of(chromium, file) as opened:
        opened.open(request.param, 900)
        opened.until("window.symgen.editor.checked()")
        yield opened


@pytest.mark.by_turns(3)
@pytest.mark.parametrize("machine", MACHINES, ids=lambda machine: machine.draw.__name__)
def test_a_machine_by_the_mouse_alone(machine: Machine, page: Page) -> None:
    hand = Mouse(page)
    machine.draw(hand)
    page.rested()
    page.picture(machine.draw.__name__)
    raw = tomllib.loads(page.text("text"))
    kinds = [joint["type"] for joint in raw.get("joints", {}).values()] + ["touch"] * len(raw.get("contacts", {}))
    assert tuple(sorted(kinds)) == machine.joints
    assert page.text("freedoms").split(" ")[0] == str(machine.freedoms)
    assert page.text("facts").endswith("status ok"), (page.text("facts"), page.text("told"))
    left = machine.motion(lambda name: column(page, name))
    assert np.max(np.abs(left)) < 1e-5, (np.max(np.abs(left)), page.text("text"))
    assert page.said() == []

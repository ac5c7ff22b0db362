"""Machines drawn in ``symgen edit`` by the mouse alone, on a desk and on a telephone: joints, places and motion."""

import itertools
import json
import tomllib
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from scipy.integrate import cumulative_simpson

from tests.browser.chromium import Chromium
from tests.browser.editor_page import Page
from tests.browser.test_edit_sketches import EMPTY, Hand, Place, column
from tests.browser.test_edit_view import scale, wheel

pytestmark = pytest.mark.browser

G = 9.81
Array = np.ndarray[Any, np.dtype[np.float64]]


class Mouse(Hand):
    """A hand that clicks at places of the grid, and at ringed points; by keys it types them."""

    #: Whether the view was chosen by hand, so that nothing moves when a motion arrives.
    zoomed = False

    def use(self, tool: str, *places: Place) -> None:
        if not self.zoomed and self.page.run("document.querySelectorAll('.handle').length"):
            self.page.rested()
        self.places += [place for place in places if not isinstance(place, str) and tool in BODIES]
        if self.keys:
            super().use(tool, *places)
            return
        self.choose(tool)
        before = self.page.text("text")
        for place in places:
            self.actions += 1
            self.page.click(*(self.page.where(place) if isinstance(place, str) else self.page.place(*place)))
        self.changed(before)


#: Tools whose places are points of bodies.
BODIES = ("bar", "plate", "wheel", "point")


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
    """A garage door, its rail first: its top in a slot, its middle on an arm, a spring that carries it."""
    hand.use("bar", (0.4, -0.3), (-0.4, 0.3))
    hand.use("slot", "bodies.bar1.points.B")
    hand.use("point", "bodies.bar1.points.A", (0.0, 0.0))
    hand.use("bar", (-0.4, -0.2), "bodies.bar1.points.C")
    hand.ground("bodies.bar2.points.A")
    hand.use("spring", "bodies.bar1.points.A", (0.4, 0.4))


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


def scotch_yoke(hand: Mouse) -> None:
    """A crank whose pin moves up and down in a yoke, which a slide guides."""
    hand.use("bar", (0.0, 0.0), (0.2, 0.1))
    hand.use("bar", (0.2, 0.6), (0.8, 0.6))
    hand.ground("bodies.bar1.points.A")
    hand.use("slide", "bodies.bar2.points.B")
    hand.drag("slot", "bodies.bar1.points.B", "bodies.bar2.points.A")
    hand.use("motor", "joints.pin1")


def roller_on_a_cam(hand: Mouse) -> None:
    """A disc that turns about a point of its rim lifts a roller at the foot of a push rod."""
    hand.use("wheel", (0.0, 0.2), (0.0, 0.0))
    hand.ground("bodies.wheel1.points.B")
    hand.use("bar", (0.0, 0.5), (0.0, 0.9))
    hand.use("wheel", "bodies.bar1.points.A", (0.1, 0.5))
    hand.drag("slide", "bodies.bar1.points.B", (0, -40))
    hand.use("touch", "bodies.wheel1.points.A", "joints.pin2")
    hand.use("motor", "joints.pin1")


class Motion:
    """What the page shows of a machine over a second, beside the numbers of its text."""

    def __init__(self, page: Page) -> None:
        self.page, self.raw = page, tomllib.loads(page.text("text"))
        first = json.dumps(f"{next(iter(self.raw['bodies']))}.x")
        self.t: Array = np.array(page.run(f"window.symgen.column({first}).t"))

    def __call__(self, name: str) -> Array:
        found: Array = column(self.page, name)
        return found

    @cached_property
    def _numbers(self) -> dict[str, float]:
        return {name: entry["value"] for name, entry in self.raw.get("parameters", {}).items()}

    def number(self, written: str | float) -> float:
        """Return a number of the text, which may be a formula of parameters."""
        return float(eval(str(written), {"__builtins__": {}}, self._numbers))

    def places(self) -> Array:
        """Return where points of bodies are in the text: none of them is turned."""
        found = list[Array]()
        for body in self.raw["bodies"].values():
            assert "angle" not in body
            for point in body["points"].values():
                found.append(np.array(body["position"]) + [self.number(x) for x in point])
        return np.array(found)

    def point(self, body: str, name: str) -> tuple[Array, Array]:
        """Return where a point of a body goes [m], and its velocity [m/s]."""
        own = self.raw["bodies"][body]
        dx, dy = (
            self.number(x) - c for x, c in zip(own["points"][name], own.get("centre_of_mass", (0.0, 0.0)), strict=True)
        )
        c, s, omega = np.cos(self(f"{body}.theta")), np.sin(self(f"{body}.theta")), self(f"{body}.omega")
        arm = np.array([c * dx - s * dy, s * dx + c * dy])
        centre, rate = (np.array([self(f"{body}.{a}"), self(f"{body}.{b}")]) for a, b in (("x", "y"), ("vx", "vy")))
        return centre + arm, rate + omega * np.array([-arm[1], arm[0]])

    def energy(self) -> Array:
        """Return energy and what dampers took, beside the first and in parts of what comes and goes."""
        t = self.t
        kinetic, other, power = np.zeros(len(t)), np.zeros(len(t)), np.zeros(len(t))
        for name, body in self.raw["bodies"].items():
            vx, vy, y, mass = self(f"{name}.vx"), self(f"{name}.vy"), self(f"{name}.y"), self.number(body["mass"])
            assert np.abs(np.gradient(y, t, edge_order=2) - vy).max() < 1e-2 * max(1.0, np.abs(vy).max())
            kinetic += 0.5 * mass * (vx**2 + vy**2) + 0.5 * self.number(body["inertia"]) * self(f"{name}.omega") ** 2
            other += mass * G * y
        for force in self.raw.get("forces", {}).values():
            if force["type"] == "force":
                other -= force["force"][1] * self.point(force["body"], force["at"])[0][1]
                continue
            (a, va), (b, vb) = (
                self.point(body, at) if body != "ground" else (np.array(at)[:, None], np.zeros((2, 1)))
                for body, at in zip(force["between"], force["at"], strict=True)
            )
            length = np.hypot(*(b - a))
            other += 0.5 * force["stiffness"] * (length - force["free_length"]) ** 2
            power += force["damping"] * (((b - a) * (vb - va)).sum(axis=0) / length) ** 2
        total = kinetic + other + cumulative_simpson(power, x=t, initial=0.0)
        return (total - total[0]) / (kinetic.max() + np.ptp(other))


@dataclass(frozen=True)
class Machine:
    """What a drawing gives: types of its joints and contacts, freedoms, and residuals of its motion, which are 0."""

    draw: Callable[[Mouse], None]
    joints: tuple[str, ...]
    freedoms: int
    motion: Callable[[Motion], list[Array]]
    conserves: bool = False


def bounce(m: Motion) -> list[Array]:
    """A fall of 0.2 m, and a first flight with a fifth of the speed."""
    y, falls = m("wheel1.y") - 0.2, np.sqrt(0.4 / G)
    after, speed = m.t - falls, 0.2 * G * falls
    flight = np.where(after < 0.0, 0.2 - 0.5 * G * m.t**2, speed * after - 0.5 * G * after**2)
    return [np.where(after < 2.0 * speed / G, y - flight, np.minimum(y, 0.0))]


def distance(one: Array, other: Array) -> Array:
    found: Array = np.hypot(*(one - other))
    return found


def closure_of_door(m: Motion) -> list[Array]:
    top, middle = m.point("bar1", "B")[0], m.point("bar1", "C")[0]
    return [top[1] - 0.3, distance(middle, np.array([[-0.4], [-0.2]])) - np.hypot(0.4, 0.2)]


def knee(m: Motion) -> list[Array]:
    ends = m.point("plate1", "B")[0], m.point("plate2", "A")[0]
    pivots = m.point("plate1", "A")[0] - [[-0.4], [0.0]], m.point("plate2", "B")[0] - [[0.2], [0.0]]
    return [distance(*ends) - np.hypot(0.4, 0.1), *pivots]


def height_on_disc(m: Motion, body: str, reach: float) -> Array:
    """Return how far a foot is above a disc of 0.2 m about a pin at its rim, which stood upright."""
    turned = 0.5 * np.pi + 2.0 * m.t
    x, y = 0.2 * np.cos(turned), 0.2 * np.sin(turned)
    return m.point(body, "A")[0][1] - y - (np.sqrt(reach**2 - x**2) if reach else 0.2)


def lever(m: Motion) -> Array:
    """Return how far a disc of 0.2 m is from a lever above it."""
    along = m.point("bar1", "B")[0] - m.point("bar1", "A")[0]
    to = m.point("wheel1", "A")[0] - m.point("bar1", "A")[0]
    return -(along[0] * to[1] - along[1] * to[0]) / 1.2 - 0.2


def yoke(m: Motion) -> list[Array]:
    """The yoke goes as the crank's pin does along x."""
    radius, begins = np.hypot(0.2, 0.1), np.arctan2(0.1, 0.2)
    angle = begins + 2.0 * m.t
    return [m("bar2.x") - 0.3 - radius * np.cos(angle), m("bar2.vx") + 2.0 * radius * np.sin(angle), m("bar2.y") - 0.6]


MACHINES = [
    # a uniform disc takes two thirds of the weight along the slope
    Machine(cart, ("rolling",), 1, lambda m: [m("wheel1.x") + (1.0 / 3.0) * G * 0.6 * 0.8 * m.t**2]),
    Machine(ball, ("touch",), 3, bounce),
    Machine(
        *(rack_lift, ("coupling", "driver", "revolute", "translational"), 0),
        lambda m: [m("bar1.vy") - 0.2 * 2.0, m("wheel1.omega") - 2.0],
    ),
    Machine(
        *(hoist, ("driver", "rope", *("translational",) * 2), 0), lambda m: [m("bar1.vy") - 0.1, m("bar2.vy") + 0.1]
    ),
    Machine(*(cam, ("driver", "revolute", "touch", "translational"), 1), lambda m: [height_on_disc(m, "bar1", 0.0)]),
    Machine(
        *(roller_on_a_cam, ("driver", "revolute", "revolute", "touch", "translational"), 2),
        lambda m: [height_on_disc(m, "wheel2", 0.3)],
    ),
    Machine(
        *(five_bar, ("driver", "gear", *("revolute",) * 5), 0),
        lambda m: [
            m("bar1.omega") + m("bar2.omega"),
            distance(m.point("bar1", "B")[0], m.point("bar4", "A")[0]) - np.hypot(0.3, 0.5),
            distance(m.point("bar2", "B")[0], m.point("bar3", "B")[0]) - np.hypot(0.3, 0.5),
        ],
    ),
    Machine(
        *(bogie, ("driver", "revolute", "revolute", "rolling", "rolling"), 0),
        lambda m: [np.abs(m(f"{body}.vx")) - 0.2 * 2.0 for body in ("wheel1", "wheel2", "bar1")],
    ),
    Machine(*(lever_on_a_cam, ("driver", "revolute", "revolute", "touch"), 1), lambda m: [lever(m)]),
    Machine(
        *(rack_drive, ("coupling", "driver", "revolute", "translational"), 0),
        lambda m: [m("wheel1.omega") - 0.1 / 0.2, m("bar1.vx") - 0.1],
    ),
    Machine(
        *(locomotive, ("pin-in-slot", "revolute", "rolling"), 1),
        lambda m: [m("wheel1.x") + 0.2 * m("wheel1.theta"), m.point("bar1", "B")[0][1] - 0.2],
        conserves=True,
    ),
    Machine(toggle_clamp, ("revolute",) * 4, 1, knee, conserves=True),
    Machine(door, ("pin-in-slot", "revolute", "revolute"), 1, closure_of_door, conserves=True),
    Machine(scotch_yoke, ("driver", "pin-in-slot", "revolute", "translational"), 0, yoke),
]


@pytest.fixture
def width(request: pytest.FixtureRequest) -> int:
    return int(getattr(request, "param", 1280))


@pytest.fixture
def page(width: int, chromium: Chromium, tmp_path: Path) -> Iterator[Page]:
    file = tmp_path / "mine.toml"
    file.write_text(EMPTY)
    with Page.of(chromium, file) as opened:
        opened.open(width, 900)
        opened.until("window.symgen.editor.checked()")
        yield opened


def is_as_drawn(machine: Machine, hand: Mouse) -> None:
    """Compare a drawn machine with what was meant: joints, places, freedoms, motion."""
    page = hand.page
    page.rested()
    page.picture(machine.draw.__name__)
    motion = Motion(page)
    raw = motion.raw
    kinds = [joint["type"] for joint in raw.get("joints", {}).values()] + ["touch"] * len(raw.get("contacts", {}))
    assert tuple(sorted(kinds)) == machine.joints
    drawn = motion.places()
    for place in hand.places:
        assert np.abs(drawn - place).max(axis=1).min() < 1e-12, (place, page.text("text"))
    assert page.text("freedoms").split(" ")[0] == str(machine.freedoms)
    assert page.text("facts").endswith("status ok"), (page.text("facts"), page.text("told"))
    for left in machine.motion(motion):
        assert np.abs(left).max() < 1e-5, (np.abs(left).max(), page.text("text"))
    if machine.conserves:
        assert np.abs(motion.energy()).max() < 1e-2, (np.abs(motion.energy()).max(), page.text("text"))
    assert page.said() == []


@pytest.mark.by_turns(3)
@pytest.mark.parametrize("width", [1280, 390], indirect=True)
@pytest.mark.parametrize("machine", MACHINES, ids=lambda machine: machine.draw.__name__)
def test_a_machine_by_the_mouse_alone(machine: Machine, page: Page) -> None:
    hand = Mouse(page)
    machine.draw(hand)
    is_as_drawn(machine, hand)


@pytest.mark.parametrize("machine", [hoist, roller_on_a_cam], ids=lambda draw: draw.__name__)
def test_a_machine_by_keys_alone(machine: Callable[[Mouse], None], page: Page) -> None:
    hand = Mouse(page, keys=True)
    machine(hand)
    is_as_drawn(next(each for each in MACHINES if each.draw is machine), hand)


#: How far cranks stand apart, and their rows [m].
APART, LEVEL = 0.2, 0.4


def test_a_hundred_and_one_bodies_by_the_mouse_alone(chromium: Chromium, tmp_path: Path) -> None:
    """Cranks of one length that rods couple turn as the first one does, which a motor drives."""
    file = tmp_path / "mine.toml"
    file.write_text(EMPTY.replace("until = 1.0", "until = 0.5"))
    with Page.of(chromium, file) as page:
        page.open(1280, 900)
        page.until("window.symgen.editor.checked()")
        hand = Mouse(page)
        hand.use("bar", (0.0, 0.0), (0.0, 0.2))
        page.rested()
        while scale(page) > 170.0:
            wheel(page, 300)
        page.rested()
        hand.zoomed = True
        pivots = [
            (round(APART * i, 9), round(LEVEL * j, 9)) for j in (0, -1, 1) for i in (*range(9), *range(-1, -9, -1))
        ]
        for k, (x, y) in enumerate(pivots, 1):
            if k > 1:
                hand.use("bar", (x, y), (x, round(y + 0.2, 9)))
            hand.ground(f"bodies.bar{k}.points.A")
        for one, other in itertools.pairwise(pivots):
            hand.use("bar", *((x, round(y + 0.2, 9)) for x, y in (one, other)))
        hand.use("motor", "joints.pin1")
        page.rested()
        page.picture("hundred")
        motion = Motion(page)
        assert len(motion.raw["bodies"]) == 101 and page.text("freedoms").split(" ")[0] == "0"
        drawn = motion.places()
        assert all(np.abs(drawn - place).max(axis=1).min() < 1e-12 for place in hand.places)
        assert page.text("facts").endswith("status ok"), (page.text("facts"), page.text("told"))
        for k in range(1, len(pivots) + 1):
            assert np.abs(motion(f"bar{k}.omega") - 2.0).max() < 1e-5
        assert np.abs(motion(f"bar{len(pivots) + 1}.omega")).max() < 1e-5  # a rod
        assert page.said() == []

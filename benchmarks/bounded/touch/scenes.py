"""Random scenes of one to four contacts: their files, and the same as the simulation takes them."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from benchmarks.bounded.touch.bodies import GROUND, Array, Contact, Pin, Rail, Scene, Spring, Surface, Touching

Pair = tuple[float, float]


@dataclass
class Drawn:
    """A scene: a file's tables, what the simulation takes, and the start.

    Attributes
    ----------
    raw : dict
        Tables of the file.
    scene : Scene
        Of the simulation.
    q, v : Array
        Start.
    """

    raw: dict[str, Any]
    scene: Scene
    q: Array
    v: Array


@dataclass
class Draft:
    """A scene that is being drawn."""

    random: np.random.Generator
    gravity: Pair = (0.0, -9.81)
    longest: float = 4e-3
    names: list[str] = field(default_factory=list)
    masses: list[float] = field(default_factory=list)
    q: list[float] = field(default_factory=list)
    v: list[float] = field(default_factory=list)
    raw: dict[str, Any] = field(default_factory=lambda: {"bodies": {}, "joints": {}, "forces": {}, "contacts": {}})
    joints: list[Pin | Rail] = field(default_factory=list)
    springs: list[Spring] = field(default_factory=list)
    contacts: list[Touching] = field(default_factory=list)

    def one(self, low: float, high: float) -> float:
        """Return a random number, rounded so that files are short."""
        return round(float(self.random.uniform(low, high)), 4)

    def sign(self) -> float:
        """Return -1 or 1."""
        return float(self.random.choice([-1.0, 1.0]))

    def body(self, name: str, mass: float, inertia: float, place: Pair, **start: Any) -> int:
        """Add a body; return its number."""
        velocity, omega, angle = start.get("velocity", (0.0, 0.0)), start.get("omega", 0.0), start.get("angle", 0.0)
        self.names.append(name)
        self.masses += [mass, mass, inertia]
        self.q += [*place, angle]
        self.v += [*velocity, omega]
        self.raw["bodies"][name] = {
            "mass": mass,
            "inertia": inertia,
            "position": list(place),
            "angle": angle,
            "velocity": list(velocity),
            "angular_velocity": omega,
        }
        return len(self.names) - 1

    def name(self, body: int) -> str:
        """Return the name of a body."""
        return "ground" if body == GROUND else self.names[body]

    def pin(self, one: int, other: int, at: Pair, on: Pair) -> None:
        """Add a pin."""
        self.joints.append(Pin(one, other, at, on))
        between = [self.name(one), self.name(other)]
        table = {"type": "revolute", "between": between, "at": [list(at), list(on)]}
        self.raw["joints"][f"pin{len(self.joints)}"] = table

    def rail(self, body: int, axis: Pair) -> None:
        """Add a rail through the place of a body."""
        on = self.q[3 * body], self.q[3 * body + 1]
        self.joints.append(Rail(body, on, axis))
        self.raw["joints"][f"rail{len(self.joints)}"] = {
            "type": "translational",
            "between": ["ground", self.name(body)],
            "at": [list(on), [0.0, 0.0]],
            "axis": list(axis),
            "angle": 0.0,
        }

    def spring(self, body: int, to: Pair, stiffness: Pair, damping: Pair) -> None:
        """Add a spring."""
        self.springs.append(Spring(body, to, stiffness, damping))
        name, parts = self.name(body), []
        for axis, x in enumerate("xy"):
            parts.append(f"-{stiffness[axis]!r}*({name}.{x} - {to[axis]!r}) - {damping[axis]!r}*{name}.v{x}")
        self.raw["forces"][f"spring{len(self.springs)}"] = {"type": "force", "body": name, "force": parts}

    def touch(self, disc: Surface, other: Surface, smooth: bool = False, e: float | None = None) -> None:
        """Add a contact with random coefficients."""
        mu = 0.0 if smooth else self.one(0.02, 0.5)
        static = round(mu * float(self.random.choice([1.0, 1.0, 1.3])), 6)
        e = float(self.random.choice([0.0, self.one(0.2, 0.7)])) if e is None else e
        self.contacts.append(Contact(disc, other, mu, static, e))
        tables: list[dict[str, Any]] = [{"body": self.name(disc.body), "at": list(disc.at), "disc": disc.radius}]
        if other.radius is None:
            line = {"line": self.name(other.body), "on": list(other.at), "normal": list(other.normal)}
            tables.append(line)
        else:
            tables.append({"body": self.name(other.body), "at": list(other.at), "disc": other.radius})
        table: dict[str, Any] = {"between": tables, "restitution": e}
        if mu:
            table["friction"] = mu if static == mu else {"sliding": mu, "static": static}
        self.raw["contacts"][f"c{len(self.contacts)}"] = table

    def drawn(self, name: str) -> Drawn:
        """Return the scene."""
        raw = {"mechanism": {"name": name, "gravity": list(self.gravity)}, **self.raw}
        scene = Scene(np.array(self.masses), self.gravity, self.joints, self.springs, self.contacts, self.longest)
        return Drawn(raw, scene, np.array(self.q), np.array(self.v))


FLOOR = Surface(GROUND)


def _tilted(draft: Draft, most: float) -> None:
    angle = draft.one(-most, most)
    draft.gravity = (round(9.81 * math.sin(angle), 6), round(-9.81 * math.cos(angle), 6))


def _disc(draft: Draft, name: str, x: float, height: float, speed: float, spin: float) -> tuple[int, float]:
    r, mass = draft.one(0.05, 0.15), draft.one(0.5, 2.0)
    omega, rate = draft.one(-spin, spin), (draft.one(-speed, speed), 0.0)
    inertia = round(draft.one(0.4, 0.9) * mass * r * r, 7)
    return draft.body(name, mass, inertia, (x, r + height), velocity=rate, omega=omega), r


def corner(draft: Draft) -> None:
    """Draw a spinning disc over a floor beside a wall."""
    _tilted(draft, 0.3)
    disc, r = _disc(draft, "disc", 0.0, draft.one(0.0, 0.3), 2.0, 30.0)
    draft.touch(Surface(disc, radius=r), FLOOR)
    way = draft.sign()
    draft.touch(Surface(disc, radius=r), Surface(GROUND, (-way * (r + draft.one(0.05, 0.4)), 0.0), None, (way, 0.0)))


def hole(draft: Draft) -> None:
    """Draw a disc in a hole."""
    r, size, angle = draft.one(0.05, 0.12), draft.one(0.3, 0.6), draft.one(-1.2, 1.2)
    gap, mass = draft.one(0.0, 0.1), draft.one(0.5, 2.0)
    way = size - r - gap
    place, rate = (way * math.sin(angle), -way * math.cos(angle)), draft.one(-1.0, 1.0)
    velocity = rate * math.cos(angle), rate * math.sin(angle)
    disc = draft.body("disc", mass, 0.5 * mass * r * r, place, velocity=velocity, omega=draft.one(-20.0, 20.0))
    draft.touch(Surface(disc, radius=r), Surface(GROUND, radius=-size))


def block(draft: Draft) -> None:
    """Draw a block with two feet over a slope."""
    _tilted(draft, 0.3)
    b, h, mass = draft.one(0.1, 0.3), draft.one(0.1, 0.3), draft.one(0.5, 2.0)
    angle = draft.one(-0.5, 0.5)
    low = h * math.cos(angle) + b * abs(math.sin(angle))
    inertia = round(mass * (b * b + h * h) / 3.0, 6)
    place = 0.0, low + draft.one(0.001, 0.1)
    body = draft.body(
        "block", mass, inertia, place, velocity=(draft.one(-1.0, 1.0), 0.0), omega=draft.one(-2.0, 2.0), angle=angle
    )
    e = draft.one(0.0, 0.3)
    for side in (-b, b):
        draft.touch(Surface(body, (side, -h), 0.0), FLOOR, e=e)


def meeting(draft: Draft) -> None:
    """Draw two discs on a floor that meet."""
    _tilted(draft, 0.1)
    one, r = _disc(draft, "one", 0.0, 0.0, 0.5, 10.0)
    other, s = _disc(draft, "two", round(r + 0.15 + draft.one(0.05, 0.3), 4), draft.one(0.0, 0.1), 0.5, 10.0)
    draft.v[0], draft.v[3] = abs(draft.v[0]) + 0.5, -abs(draft.v[3])
    for name, k in (("one", 0), ("two", 3)):
        draft.raw["bodies"][name]["velocity"] = [draft.v[k], 0.0]
    draft.touch(Surface(one, radius=r), FLOOR)
    draft.touch(Surface(other, radius=s), FLOOR)
    draft.touch(Surface(other, radius=s), Surface(one, radius=r))


def _rod(draft: Draft, name: str, top: Pair, angle: float, omega: float, rate: Pair = (0.0, 0.0)) -> tuple[int, float]:
    """Add a rod that hangs from a point; `angle` from the vertical."""
    length, mass = draft.one(0.3, 0.6), draft.one(0.5, 2.0)
    half = 0.5 * length
    place = top[0] + half * math.sin(angle), top[1] - half * math.cos(angle)
    velocity = rate[0] + half * math.cos(angle) * omega, rate[1] + half * math.sin(angle) * omega
    inertia = round(mass * length * length / 12.0, 6)
    return draft.body(name, mass, inertia, place, velocity=velocity, omega=omega, angle=angle), length


def hanging(draft: Draft) -> None:
    """Draw a pendulum that strikes a disc on a floor."""
    top = 0.0, 0.7
    rod, length = _rod(draft, "rod", top, draft.one(-1.4, -0.6), draft.one(-1.0, 2.0))
    draft.pin(GROUND, rod, top, (0.0, 0.5 * length))
    disc, r = _disc(draft, "disc", draft.one(0.05, 0.2), 0.0, 0.1, 2.0)
    bob = draft.one(0.03, 0.06)
    draft.q[3 * disc] = x = round(0.06 + bob + r, 4)
    draft.raw["bodies"]["disc"]["position"][0] = x
    draft.touch(Surface(disc, radius=r), FLOOR)
    draft.touch(Surface(disc, radius=r), Surface(rod, (0.0, -0.5 * length), bob))


def chain(draft: Draft) -> None:
    """Draw two rods that hang from a pin; the tip strikes a floor and a wall."""
    a, w = draft.one(-1.2, 1.2), draft.one(-2.0, 2.0)
    one, length = _rod(draft, "one", (0.0, 0.0), a, w)
    joint = length * math.sin(a), -length * math.cos(a)
    rate = length * math.cos(a) * w, length * math.sin(a) * w
    b = draft.one(-1.5, 1.5)
    two, other = _rod(draft, "two", joint, b, draft.one(-2.0, 2.0), rate)
    draft.pin(GROUND, one, (0.0, 0.0), (0.0, 0.5 * length))
    draft.pin(one, two, (0.0, -0.5 * length), (0.0, 0.5 * other))
    tip = joint[0] + other * math.sin(b), joint[1] - other * math.cos(b)
    tip_at = 0.0, -0.5 * other
    low = round(min(tip[1] - draft.one(0.02, 0.1), -0.55 * (length + other)), 4)
    draft.touch(Surface(two, tip_at, 0.0), Surface(GROUND, (0.0, low)))
    way = draft.sign()
    x = round(tip[0] - way * draft.one(0.2, 0.4), 4)
    draft.touch(Surface(two, tip_at, 0.0), Surface(GROUND, (x, 0.0), None, (way, 0.0)))


def platform(draft: Draft) -> None:
    """Draw a disc that falls on a platform on springs, over a floor."""
    mass, thick = draft.one(1.0, 3.0), 0.05
    plate = draft.body("plate", mass, 0.1, (0.0, draft.one(0.2, 0.4)), velocity=(0.0, draft.one(-1.0, 0.5)))
    draft.rail(plate, (0.0, 1.0))
    draft.spring(plate, (0.0, draft.one(0.2, 0.5)), (0.0, draft.one(50.0, 400.0)), (0.0, draft.one(0.0, 5.0)))
    disc, r = _disc(draft, "disc", 0.0, draft.q[1] + thick + draft.one(0.02, 0.3), 1.0, 20.0)
    draft.touch(Surface(disc, radius=r), Surface(plate, (0.0, thick)))
    draft.touch(Surface(plate, (0.0, -thick), 0.0), FLOOR, smooth=True)


def play(draft: Draft) -> None:
    """Draw a rod that hangs on a pin with play, beside a wall."""
    angle, hole, pin = draft.one(-1.2, 1.2), draft.one(0.02, 0.03), draft.one(0.01, 0.015)
    rod, length = _rod(draft, "rod", (0.0, 0.0), angle, draft.one(-2.0, 2.0))
    draft.touch(Surface(GROUND, radius=pin), Surface(rod, (0.0, 0.5 * length), -hole))
    draft.raw["contacts"]["c1"]["between"].reverse()
    way = 1.0 if math.sin(angle) > -0.1 else -1.0
    x = round(length * math.sin(angle) - way * draft.one(0.1, 0.3), 4)
    draft.touch(Surface(rod, (0.0, -0.5 * length), 0.0), Surface(GROUND, (x, 0.0), None, (way, 0.0)))


def guide(draft: Draft) -> None:
    """Draw a block with play between two lines, on springs."""
    draft.gravity = (0.0, draft.one(-4.0, 4.0))
    a, b, gap, mass = draft.one(0.08, 0.2), draft.one(0.03, 0.08), draft.one(0.001, 0.004), draft.one(0.5, 2.0)
    inertia = round(mass * (a * a + b * b) / 3.0, 6)
    angle = draft.one(-0.3, 0.3) * gap / a
    body = draft.body(
        "block", mass, inertia, (0.0, 0.0), velocity=(draft.one(-0.5, 0.5), draft.one(-0.05, 0.05)), angle=angle
    )
    to = draft.one(-0.2, 0.2), draft.one(-0.002, 0.002)
    draft.spring(body, to, (draft.one(20.0, 100.0), draft.one(0.0, 100.0)), (draft.one(0.0, 1.0), 0.0))
    e = draft.one(0.0, 0.4)
    for y, way in ((-1.0, 1.0), (1.0, -1.0)):
        for x in (-a, a):
            draft.touch(Surface(body, (x, y * b), 0.0), Surface(GROUND, (0.0, y * (b + gap)), None, (0.0, way)), e=e)


def cart(draft: Draft) -> None:
    """Draw a cart on a spring that drags a rod over a floor and strikes a disc."""
    cart = draft.body("cart", draft.one(1.0, 3.0), 0.1, (0.0, 0.25), velocity=(draft.one(-0.5, 1.5), 0.0))
    draft.rail(cart, (1.0, 0.0))
    draft.spring(cart, (draft.one(-0.1, 0.4), 0.25), (draft.one(20.0, 150.0), 0.0), (draft.one(0.0, 3.0), 0.0))
    length, mass = draft.one(0.4, 0.7), draft.one(0.3, 1.0)
    lean = -math.acos(0.25 / length)
    place = 0.5 * length * math.sin(lean), 0.25 - 0.5 * length * math.cos(lean)
    inertia = round(mass * length * length / 12.0, 6)
    rod = draft.body("rod", mass, inertia, place, velocity=(draft.v[0], 0.0), angle=lean)
    draft.pin(cart, rod, (0.0, 0.0), (0.0, 0.5 * length))
    disc, r = _disc(draft, "disc", draft.one(0.35, 0.5), 0.0, 0.2, 5.0)
    draft.touch(Surface(rod, (0.0, -0.5 * length), 0.0), FLOOR)
    draft.touch(Surface(disc, radius=r), FLOOR)
    draft.touch(Surface(disc, radius=r), Surface(cart, (0.12, 0.0), None, (1.0, 0.0)))


KINDS: dict[str, Callable[[Draft], None]] = {
    draw.__name__: draw for draw in (corner, hole, block, meeting, hanging, chain, platform, play, guide, cart)
}

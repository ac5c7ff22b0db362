"""Machines of one parameter each: the text of the file, and the same as the simulation takes it."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from benchmarks.bounded.rubbing.bodies import Gap, Gear, Joint, Machine, Rub, pin_that_rubs, turn_between
from benchmarks.bounded.touch.bodies import GROUND, Array, Complex, Contact, Pin, Rail, Surface

Pair = tuple[float, float]
G = 9.81


@dataclass(frozen=True)
class Case:
    """A machine at one value of its parameter.

    Attributes
    ----------
    text : str
        The file, whose parameter is ``value``.
    machine : Machine
        As the simulation takes it.
    q, v : Array
        Start.
    until : float
        End [s].
    places : tuple of str
        Quantities that are compared, in the order of coordinates.
    """

    text: str
    machine: Machine
    q: Array
    v: Array
    until: float
    places: tuple[str, ...]


@dataclass
class Draft:
    """A machine that is being written, in both forms."""

    name: str
    value: float
    until: float
    gravity: float = -G
    names: list[str] = field(default_factory=list)
    masses: list[float] = field(default_factory=list)
    q: list[float] = field(default_factory=list)
    v: list[float] = field(default_factory=list)
    joints: list[Joint] = field(default_factory=list)
    gaps: list[Gap] = field(default_factory=list)
    rubs: list[Rub] = field(default_factory=list)
    blocks: list[str] = field(default_factory=list)

    def body(self, mass: float, inertia: float, place: Pair, omega: float = 0.0, velocity: Pair = (0.0, 0.0)) -> int:
        """Add a body at angle 0, named by its letter; return its number."""
        self.names.append("abcdefgh"[len(self.names)])
        self.masses += [mass, mass, inertia]
        self.q += [*place, 0.0]
        self.v += [*velocity, omega]
        self.blocks.append(
            f"[bodies.{self.names[-1]}]\nmass = {mass!r}\ninertia = {inertia!r}\nposition = {list(place)}\n"
            f"velocity = {list(velocity)}\nangular_velocity = {omega!r}\n"
        )
        return len(self.names) - 1

    def named(self, body: int) -> str:
        """Return the name of a body."""
        return "ground" if body == GROUND else self.names[body]

    def local(self, body: int, place: Pair) -> Pair:
        """Return a place of the start in the frame of a body."""
        return place if body == GROUND else (place[0] - self.q[3 * body], place[1] - self.q[3 * body + 1])

    def pin(self, one: int, other: int, place: Pair, radius: float = 0.0, coefficient: float = 0.0) -> None:
        """Add a pin, which rubs where it has a radius, by the coefficient that the file calls ``value``."""
        at, on = self.local(one, place), self.local(other, place)
        self.joints.append(Pin(one, other, at, on))
        block = f'[joints.pin{len(self.joints)}]\ntype = "revolute"\nbetween = ["{self.named(one)}", '
        block += f'"{self.named(other)}"]\nat = [{list(at)}, {list(on)}]\n'
        if radius > 0.0:
            self.rubs.append(pin_that_rubs(one, other, len(self.joints) - 1, radius * coefficient))
            block += f'friction = {{ coefficient = "value", radius = {radius!r} }}\n'
        self.blocks.append(block)

    def rail(self, body: int, axis: Pair) -> None:
        """Add a rail through the place of a body, which does not turn."""
        on = self.q[3 * body], self.q[3 * body + 1]
        self.joints.append(Rail(body, on, axis))
        self.blocks.append(
            f'[joints.rail{len(self.joints)}]\ntype = "translational"\nbetween = ["ground", "{self.named(body)}"]\n'
            f"at = [{list(on)}, [0.0, 0.0]]\naxis = {list(axis)}\nangle = 0.0\n"
        )

    def stop(self, gap: str, look: Callable[[Complex], tuple[Any, Complex]], restitution: float) -> None:
        """Add a gap as a formula and as a function."""
        self.gaps.append(Gap(look, restitution))
        self.blocks.append(f'[stops.stop{len(self.gaps)}]\ngap = "{gap}"\nrestitution = {restitution!r}\n')

    def torque(self, body: int, formula: str) -> None:
        """Add a torque to the file; the simulation has its own function of all forces."""
        name = f"torque{sum('[forces.' in block for block in self.blocks)}"
        self.blocks.append(f'[forces.{name}]\ntype = "torque"\nbody = "{self.named(body)}"\ntorque = "{formula}"\n')

    def push(self, body: int, x: str, y: str) -> None:
        """Add a force at the place of a body to the file."""
        name = f"push{sum('[forces.' in block for block in self.blocks)}"
        self.blocks.append(f'[forces.{name}]\ntype = "force"\nbody = "{self.named(body)}"\nforce = ["{x}", "{y}"]\n')

    def case(self, loads: Callable[[float, Array, Array, Array], None]) -> Case:
        """Return both forms; `loads` adds forces to those of weight."""
        masses = np.array(self.masses)

        def force(t: float, q: Array, v: Array) -> Array:
            found = np.zeros(len(q))
            found[1::3] = self.gravity * masses[1::3]
            loads(t, q, v, found)
            return found

        head = f'[mechanism]\nname = "{self.name}"\ngravity = [0.0, {self.gravity!r}]\n[run]\nuntil = {self.until!r}\n'
        head += f"[parameters]\nvalue = {self.value!r}\n"
        places = tuple(f"{name}.{x}" for name in self.names for x in ("x", "y", "theta"))
        machine = Machine(masses, self.joints, self.gaps, self.rubs, force)
        return Case(head + "".join(self.blocks), machine, np.array(self.q), np.array(self.v), self.until, places)


def _row(q: Complex, **parts: Any) -> Complex:
    """Return a row by the numbers of coordinates."""
    row = 0.0 * q
    for name, part in parts.items():
        row[int(name[1:])] = part
    return row


def gripper(value: float) -> Case:
    """Return a slide that closes a jaw by a link; its sprung finger bounces on the workpiece.

    Four pins rub, unless the coefficient is 0.
    """
    draft, radius = Draft("gripper", value, 0.25), 0.01 if value > 0.0 else 0.0
    slide = draft.body(0.3, 0.01, (0.0, 0.0))
    link = draft.body(0.1, 1e-4, (0.03, 0.04))
    jaw = draft.body(0.4, 2e-3, (0.18, 0.09))
    finger = draft.body(0.15, 2e-4, (0.34, 0.10))
    draft.rail(slide, (1.0, 0.0))
    draft.pin(slide, link, (0.0, 0.0), radius, value)
    draft.pin(link, jaw, (0.06, 0.08), radius, value)
    draft.pin(GROUND, jaw, (0.12, 0.06), radius, value)
    draft.pin(jaw, finger, (0.3, 0.12), radius, value)
    (x, y), k = draft.local(finger, (0.36, 0.06)), 3 * finger

    def tip(q: Complex) -> tuple[Any, Complex]:
        s, c = np.sin(q[k + 2]), np.cos(q[k + 2])
        return q[k + 1] + s * x + c * y - 0.05, _row(q, **{f"_{k + 1}": 1.0, f"_{k + 2}": c * x - s * y})

    draft.stop(f"d.y + sin(d.theta)*({x!r}) + cos(d.theta)*({y!r}) - 0.05", tip, 0.3)
    draft.stop("0.03 - a.x", lambda q: (0.03 - q[0], _row(q, _0=-1.0)), 0.3)
    draft.push(slide, "12.0", "0.0")
    draft.torque(finger, "-4.0*(d.theta - c.theta) - 0.004*(d.omega - c.omega)")
    draft.torque(jaw, "4.0*(d.theta - c.theta) + 0.004*(d.omega - c.omega)")

    def loads(t: float, q: Array, v: Array, force: Array) -> None:
        bend = 4.0 * (q[11] - q[8]) + 0.004 * (v[11] - v[8])
        force[0] += 12.0
        force[11] -= bend
        force[8] += bend

    return draft.case(loads)


def brake(value: float) -> Case:
    """Return a lever that falls onto an eccentric drum, which it brakes until all rest. Both pins rub."""
    draft = Draft("brake", value, 0.6)
    drum = draft.body(2.0, 0.01, (0.0, 0.0), omega=20.0)
    lever = draft.body(0.5, 0.01, (0.02, 0.14))
    draft.pin(GROUND, drum, (0.0, 0.0), 0.01, value)
    draft.pin(GROUND, lever, (-0.2, 0.14), 0.02, value)
    pad = draft.local(lever, (0.0, 0.111))
    contact = Contact(Surface(lever, pad, 0.01), Surface(drum, (0.005, 0.0), 0.1))
    draft.gaps.append(Gap(lambda q: (contact.look(q)[0], contact.rows(q)[0]), 0.1))
    draft.rubs.append(Rub(lambda q: contact.rows(q)[1], gap=0, sliding=(0.0, 0.3), static=(0.0, 0.3)))
    draft.blocks.append(
        f'[contacts.pad]\nbetween = [{{ body = "b", at = {list(pad)}, disc = 0.01 }}, '
        '{ body = "a", at = [0.005, 0.0], disc = 0.1 }]\nfriction = 0.3\nrestitution = 0.1\n'
    )
    draft.torque(lever, "-3.0")

    def loads(t: float, q: Array, v: Array, force: Array) -> None:
        force[5] -= 3.0

    return draft.case(loads)


def ratchet(value: float) -> Case:
    """Return a motor that turns a wheel of rounded teeth by a gear of efficiency 0.9; a pawl rides, jumps and lands."""
    draft = Draft("ratchet", value, 0.5)
    motor = draft.body(1.0, 0.01, (0.0, 0.0))
    wheel = draft.body(1.0, 0.05, (1.0, 0.0))
    pawl = draft.body(0.05, 0.01, (2.0, 0.1))
    draft.pin(GROUND, motor, (0.0, 0.0))
    draft.pin(GROUND, wheel, (1.0, 0.0))
    draft.rail(pawl, (0.0, 1.0))
    draft.joints.append(Gear(motor, wheel, 2.0))
    lost = 1.0 / 0.9 - 1.0
    draft.rubs.append(Rub(turn_between(motor, GROUND), joint=3, sliding=(0.0, lost), static=(0.0, lost)))
    draft.blocks.append('[joints.mesh]\ntype = "gear"\nbetween = ["a", "b"]\nratio = 2.0\nefficiency = 0.9\n')

    def rides(q: Complex) -> tuple[Any, Complex]:
        turn = q[5]
        tooth = 0.1 + 0.01 * np.sin(8.0 * turn) + 0.003 * np.sin(16.0 * turn)
        slope = 0.08 * np.cos(8.0 * turn) + 0.048 * np.cos(16.0 * turn)
        return q[7] - tooth, _row(q, _7=1.0, _5=-slope)

    draft.stop("c.y - 0.1 - 0.01*sin(8*b.theta) - 0.003*sin(16*b.theta)", rides, 0.1)
    draft.torque(motor, "value")
    draft.push(pawl, "0.0", "-60.0*(c.y - 0.04)")

    def loads(t: float, q: Array, v: Array, force: Array) -> None:
        force[2] += value
        force[7] -= 60.0 * (q[7] - 0.04)

    return draft.case(loads)


def toggle(value: float) -> Case:
    """Return a clamp whose handle goes through the dead point onto its stop, and stays there. Three pins rub."""
    draft = Draft("toggle", value, 0.3)
    start = 0.5
    corner = 0.1 * math.cos(start), 0.1 * math.sin(start)
    end = corner[0] + math.sqrt(0.3**2 - corner[1] ** 2), 0.0
    crank = draft.body(0.3, 5e-4, (0.5 * corner[0], 0.5 * corner[1]))
    rod = draft.body(0.2, 2e-3, (0.5 * (corner[0] + end[0]), 0.5 * corner[1]))
    head = draft.body(0.5, 0.01, end)
    draft.pin(GROUND, crank, (0.0, 0.0), 0.01, value)
    draft.pin(crank, rod, corner, 0.01, value)
    draft.pin(rod, head, end, 0.01, value)
    draft.rail(head, (1.0, 0.0))
    draft.stop(f"a.theta + {start + 0.06!r}", lambda q: (q[2] + start + 0.06, _row(q, _2=1.0)), 0.25)
    draft.torque(crank, "-1.5")
    draft.push(head, "-2000.0*(c.x - 0.392)", "0.0")

    def loads(t: float, q: Array, v: Array, force: Array) -> None:
        force[2] -= 1.5
        force[6] -= 2000.0 * (q[6] - 0.392)

    return draft.case(loads)


def blocks(value: float) -> Case:
    """Return two blocks on each other, of which the upper one is held where the lower one turns round on its floor."""
    draft = Draft("blocks", value, 0.25, gravity=0.0)
    draft.body(1.0, 0.1, (0.0, 0.0), velocity=(0.6, 0.0))
    draft.body(1.0, 0.1, (0.0, 0.2), velocity=(0.6, 0.0))
    for body, height in ((0, 0.0), (1, 0.2)):
        draft.joints.append(Rail(body, (0.0, height), (1.0, 0.0)))
    for name, between, height, static, sliding in (
        ("floor", '"ground", "a"', 0.0, '"value"', 2.0),
        ("top", '"a", "b"', 0.2, "2.5", 1.5),
    ):
        draft.blocks.append(
            f'[joints.{name}]\ntype = "translational"\nbetween = [{between}]\nat = [[0.0, {height}], "centre"]\n'
            f"axis = [1.0, 0.0]\nfriction = {{ static = {static}, sliding = {sliding} }}\n"
        )
    draft.rubs.append(Rub(lambda q: _row(q, _0=1.0), sliding=(2.0, 0.0), static=(value, 0.0)))
    draft.rubs.append(Rub(lambda q: _row(q, _0=-1.0, _3=1.0), sliding=(1.5, 0.0), static=(2.5, 0.0)))
    draft.push(0, "-100.0*a.x", "0.0")
    draft.push(1, "-5.9", "0.0")

    def loads(t: float, q: Array, v: Array, force: Array) -> None:
        force[0] -= 100.0 * q[0]
        force[3] -= 5.9

    return draft.case(loads)


#: Machine -> how it is made at a value, and the range of values.
MACHINES: Mapping[str, tuple[Callable[[float], Case], Pair]] = {
    "gripper": (gripper, (0.05, 0.5)),
    "brake": (brake, (0.02, 0.5)),
    "ratchet": (ratchet, (0.6, 1.0)),
    "toggle": (toggle, (0.05, 0.5)),
    "blocks": (blocks, (2.0, 6.0)),
}

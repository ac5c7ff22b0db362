"""Files of scenes with contacts, for tests; references are closed forms and simulations in NumPy of other modules."""

from __future__ import annotations

import math
from pathlib import Path

import symgen

G = 9.81


def head(name: str, gx: float = 0.0, gy: float = -G) -> str:
    """Return the head of a file."""
    return f'[mechanism]\nname = "{name}"\ngravity = [{gx!r}, {gy!r}]\n'


def body(
    name: str,
    mass: float,
    inertia: float,
    place: tuple[float, float],
    velocity: tuple[float, float] = (0.0, 0.0),
    omega: float = 0.0,
    angle: float = 0.0,
) -> str:
    """Return the table of a body."""
    return (
        f"[bodies.{name}]\nmass = {mass!r}\ninertia = {inertia!r}\nposition = {list(place)!r}\nangle = {angle!r}\n"
        f"velocity = {list(velocity)!r}\nangular_velocity = {omega!r}\n"
    )


def floor(of: str, radius: float, friction: object, restitution: float = 0.0, name: str = "floor") -> str:
    """Return the contact of a disc with a floor; friction is what a file has."""
    shapes = f'[{{ body = "{of}", disc = {radius!r} }}, {{ line = "ground" }}]'
    return f"[contacts.{name}]\nbetween = {shapes}\nfriction = {friction}\nrestitution = {restitution!r}\n"


def rocking_block(b: float, h: float, angle: float) -> str:
    """Return a block of the half sides b and h that is tilted about its right corner, at rest."""
    size, own = math.hypot(b, h), math.atan2(b, h)
    place = b - size * math.sin(own - angle), size * math.cos(own - angle)
    text = head("rock") + body("block", 1.0, (b * b + h * h) / 3.0, place, angle=-angle)
    for name, side in (("left", -1.0), ("right", 1.0)):
        shapes = f'[{{ body = "block", at = [{side * b!r}, {-h!r}] }}, {{ line = "ground" }}]'
        text += f"[contacts.{name}]\nbetween = {shapes}\nfriction = 1.0\n"
    return text


def rods(
    mu: float, e: float, lengths: tuple[float, float], masses: tuple[float, float], data: tuple[float, ...]
) -> str:
    """Return two rods that hang from a pin, whose tip hits the floor; data: angles from the vertical, and rates."""
    (l1, l2), (m1, m2), (a1, a2, u1, u2) = lengths, masses, data
    a1, a2 = math.radians(a1), math.radians(a2)
    pin = l1 * math.sin(a1), -l1 * math.cos(a1)
    second = pin[0] + l2 / 2.0 * math.sin(a2), pin[1] - l2 / 2.0 * math.cos(a2)
    level = pin[1] - l2 * math.cos(a2)
    v1 = l1 / 2.0 * math.cos(a1) * u1, l1 / 2.0 * math.sin(a1) * u1
    v2 = 2.0 * v1[0] + l2 / 2.0 * math.cos(a2) * u2, 2.0 * v1[1] + l2 / 2.0 * math.sin(a2) * u2
    text = head("rods") + body("one", m1, m1 * l1**2 / 12.0, (pin[0] / 2.0, pin[1] / 2.0), v1, u1, a1)
    text += body("two", m2, m2 * l2**2 / 12.0, second, v2, u2, a2)
    text += f'[joints.top]\ntype = "revolute"\nbetween = ["ground", "one"]\nat = [[0.0, 0.0], [0.0, {l1 / 2.0!r}]]\n'
    text += f'[joints.middle]\ntype = "revolute"\nbetween = ["one", "two"]\nat = [[0.0, {-l1 / 2.0!r}], '
    text += f'[0.0, {l2 / 2.0!r}]]\n[contacts.tip]\nbetween = [{{ body = "two", at = [0.0, {-l2 / 2.0!r}] }}, '
    return text + f'{{ line = "ground", on = [0.0, {level!r}] }}]\nfriction = {mu!r}\nrestitution = {e!r}\n'


def loaded(text: str, folder: Path) -> symgen.Model:
    """Return the model of a file with some text."""
    path = folder / "scene.toml"
    path.write_text(text)
    return symgen.load(path)

"""Files of scenes with contacts, for tests; references are closed forms and simulations in NumPy of other modules."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

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
    mu: float,
    e: float,
    lengths: tuple[float, float],
    masses: tuple[float, float],
    data: tuple[float, ...],
    h: float = 0.0,
) -> str:
    """Return two rods that hang from a pin, whose tip is h above a floor; data: angles from the vertical, and rates."""
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
    return text + f'{{ line = "ground", on = [0.0, {level - h!r}] }}]\nfriction = {mu!r}\nrestitution = {e!r}\n'


def woodpecker() -> str:
    """Return Glocker's woodpecker toy of 1995: a sleeve on a pole, and a bird on a spring."""
    sleeve, bird = -6e-4 / 5.8e-3, -0.2788
    place = 0.0, 0.01 * sleeve + 0.015 * bird
    text = (
        head("wood") + "[parameters]\nmu = 0.3\n" + body("sleeve", 3e-4, 5e-9, (0.0, 0.0), (0.0, -0.3411), 0.0, sleeve)
    )
    text += body("bird", 4.5e-3, 7e-7, place, (0.0, -0.3411 - 0.015 * 7.4583), -7.4583, bird)
    text += '[joints.pole]\ntype = "rows"\nrows = [{ position = "sleeve.x" }, { position = "bird.x" }, '
    text += '{ position = "bird.y - sleeve.y - 0.01*sleeve.theta - 0.015*bird.theta" }]\n'
    for one, other in (("sleeve", "bird"), ("bird", "sleeve")):
        text += (
            f'[forces.on_{one}]\ntype = "torque"\nbody = "{one}"\ntorque = "-0.0056*({one}.theta - {other}.theta)"\n'
        )
    gaps = {
        "beak": ("0.0024 - 0.02*bird.theta", "sleeve.y + 0.01*sleeve.theta - 0.0051*bird.theta", 0.5),
        "low": ("0.0006 + 0.0058*sleeve.theta", "sleeve.y + 0.0031*sleeve.theta", 0.0),
        "up": ("0.0006 - 0.0058*sleeve.theta", "sleeve.y + 0.0031*sleeve.theta", 0.0),
    }
    for name, (gap, slip, e) in gaps.items():
        text += f'[contacts.{name}]\ngap = "{gap}"\nslip = "{slip}"\nfriction = "mu"\nrestitution = {e}\n'
    return text


def slider_crank(
    lengths: tuple[float, float], block: tuple[float, float, float], inertias: Any, rates: tuple[float, float], law: Any
) -> str:
    """Return a slider-crank whose slider has play in its guide: four corners and two lines.

    `block` has half of its length and height, and the play; `inertias` masses and inertias; `law` mu and e.
    """
    (l1, l2), (a, b, c), (masses, turning), (mu, e) = lengths, block, inertias, law
    text = head("guide") + f"[parameters]\nmu = {mu!r}\n"
    places = l1 / 2.0, l1 + l2 / 2.0, l1 + l2
    speeds = l1 / 2.0 * rates[0], l1 * rates[0] + l2 / 2.0 * rates[1], l1 * rates[0] + l2 * rates[1]
    for i, name in enumerate(("crank", "rod", "slider")):
        text += body(name, masses[i], turning[i], (places[i], 0.0), (0.0, speeds[i]), (*rates, 0.0)[i])
    pins = (
        ("ground", "crank", 0.0, -l1 / 2.0),
        ("crank", "rod", l1 / 2.0, -l2 / 2.0),
        ("rod", "slider", l2 / 2.0, 0.0),
    )
    for one, other, x, z in pins:
        text += (
            f'[joints.at_{one}]\ntype = "revolute"\nbetween = ["{one}", "{other}"]\nat = [[{x!r}, 0.0], [{z!r}, 0.0]]\n'
        )
    for k, (x, y) in enumerate(((-1.0, 1.0), (1.0, 1.0), (-1.0, -1.0), (1.0, -1.0)), 1):
        line = f'{{ line = "ground", on = [0.0, {y * (b + c)!r}], normal = [0.0, {-y!r}] }}'
        text += f'[contacts.k{k}]\nbetween = [{{ body = "slider", at = [{x * a!r}, {y * b!r}] }}, {line}]\n'
        text += f'friction = "mu"\nrestitution = {e!r}\n'
    return text


def loaded(text: str, folder: Path) -> symgen.Model:
    """Return the model of a file with some text."""
    path = folder / "scene.toml"
    path.write_text(text)
    return symgen.load(path)


#: A spinning disc that bounces until it rests, and rolls.
DROP = (
    head("drop")
    + "[parameters]\nmu = 0.05\ne = 0.7\nheight = 1.1\n"
    + body("disc", 2.0, 0.01, (0.0, 1.1), omega=30.0).replace("1.1]", '"height"]')
    + floor("disc", 0.1, '"mu"').replace("restitution = 0.0", 'restitution = "e"')
)


def place_of_disc(mu: float, e: float, until: float) -> tuple[float, float]:
    """Return place and rate along the floor of the disc of `DROP`, in a closed form of its impacts."""
    m, inertia, r = 2.0, 0.01, 0.1
    t, x, v, slip, fall = math.sqrt(2.0 / G), 0.0, 0.0, 3.0, math.sqrt(2.0 * G)
    yields = 1.0 / m + r * r / inertia
    while fall > 1e-13:
        push = min(slip / yields, mu * m * (1.0 + e) * fall)
        v, slip, fall = v - push / m, slip - push * yields, e * fall
        x += v * 2.0 * fall / G
        t += 2.0 * fall / G
    slides = min(slip / (mu * m * G * yields), until - t)
    return x + v * (until - t) - mu * G * slides * (until - t - 0.5 * slides), v - mu * G * slides


#: The benchmark's slider-crank whose slider begins without a rate, and one with lighter parts.
CRANK = slider_crank(
    (0.153, 0.306), (0.05, 0.025, 0.001), ((0.038, 0.038, 0.076), (7.4e-5, 5.9e-4, 2.7e-6)), (150.0, -75.0), (0.01, 0.4)
)
LIGHT = slider_crank(
    (0.12, 0.25), (0.04, 0.02, 0.0012), ((0.03, 0.05, 0.06), (4e-5, 2.6e-4, 3e-5)), (140.0, -66.0), (0.05, 0.3)
)

#: The same slider as a joint with play.
CRANK_WITH_CLEARANCE = (
    CRANK[: CRANK.index("[contacts.k1]")]
    + """[joints.guide]
type = "translational"
between = ["ground", "slider"]
at = [[0.0, 0.0], [0.0, 0.0]]
axis = [1.0, 0.0]
clearance = { length = 0.1, height = 0.05, gap = 0.001, restitution = 0.4, friction = "mu" }
"""
)

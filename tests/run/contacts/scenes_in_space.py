"""Files of scenes in space with contacts, for tests."""

from __future__ import annotations

from typing import Any

from tests.run.contacts.scenes import G


def head(gravity: Any = (0.0, 0.0, -G)) -> str:
    """Return the head of a file."""
    return f'[mechanism]\nname = "touch"\nspace = "spatial"\ngravity = {listed(gravity)}\n'


def listed(vector: Any) -> str:
    """Return a vector as a file has it."""
    return repr([float(x) for x in vector])


def body(
    name: str, place: Any, velocity: Any = (0.0, 0.0, 0.0), mass: float = 1.0, inertia: Any = (0.004,) * 3, **more: Any
) -> str:
    """Return the table of a body; `turn` and `omega` are a rotation vector and an angular velocity."""
    text = f"[bodies.{name}]\nmass = {float(mass)!r}\ninertia = {listed(inertia)}\nposition = {listed(place)}\n"
    text += f"velocity = {listed(velocity)}\nangular_velocity = {listed(more.get('omega', (0.0,) * 3))}\n"
    return text + f"orientation = {{ rotation_vector = {listed(more.get('turn', (0.0,) * 3))} }}\n"


def contact(
    one: str, other: str, restitution: object = 0.0, name: str = "touch", friction: object | None = None
) -> str:
    """Return a contact of two shapes."""
    text = f"[contacts.{name}]\nbetween = [{{ {one} }}, {{ {other} }}]\nrestitution = {restitution}\n"
    return text if friction is None else f"{text}friction = {friction}\n"


def ball_of(
    radius: float, place: Any, velocity: Any = (0.0, 0.0, 0.0), mass: float = 1.0, name: str = "ball", **more: Any
) -> str:
    """Return the table of a solid sphere."""
    return body(name, place, velocity, mass, (0.4 * mass * radius**2,) * 3, **more)


#: A ball that is thrown on a floor with spin, bounces, slips and rolls.
SKITTLE = (
    head()
    + ball_of(0.2, (0.0, 0.0, 0.3), (2.0, 0.7, 0.0), 1.3, omega=(5.0, 9.0, 30.0))
    + contact('body = "ball", sphere = 0.2', 'plane = "ground"', 0.4, friction=0.21)
)
#: A ball that falls on a floor with spin, rolls and comes to rest.
SPUN = (
    head()
    + ball_of(0.2, (0.0, 0.0, 0.25), (0.5, 0.25, 0.0), 1.3, omega=(-1.25, 2.5, 2.0))
    + contact('body = "ball", sphere = 0.2', 'plane = "ground"', friction=0.3)
    + "rolling = 0.02\ntorsion = 0.01\n"
)
#: A box that falls on a floor that gravity is not across, with a ball on its body that another one falls on.
DIE = (
    head((1.0, 0.0, -G))
    + "[parameters]\ne = 0.4\nsize = 0.4\n"
    + body("die", (0.0, 0.0, 0.4), (0.3, 0.0, 0.0), 1.0, (0.03, 0.04, 0.05), turn=(0.2, 0.3, 0.1))
    + body("ball", (0.0, 0.05, 0.9), (0.2, 0.0, 0.0))
    + contact('body = "die", box = [0.2, 0.3, "size"]', 'plane = "ground"', '"e"')
    + contact('body = "die", sphere = 0.1', 'body = "ball", sphere = 0.1', 0.5, "on_it")
)

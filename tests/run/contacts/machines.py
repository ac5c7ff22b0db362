"""Machines whose parts touch along segments: a Geneva wheel, and a latch."""

from __future__ import annotations

import math

from tests.run.contacts.scenes import body, head


def geneva(slots: int = 5, play: float = 1.5e-4, mu: float = 0.08, e: float = 0.2) -> str:
    """Return a wheel with slots that a pin turns on once a second; a brake holds it in between.

    The pin enters and leaves along a slot: the radius at which it runs is that of the centres times sin(pi / slots).
    """
    apart, pin = 0.12, 0.004
    runs, wide = apart * math.sin(math.pi / slots), apart * math.cos(math.pi / slots)
    enters = math.pi - (0.5 * math.pi - math.pi / slots) - 0.4
    text = head("geneva", 0.0, 0.0) + body("wheel", 0.4, 6e-4, (0.0, 0.0), angle=-math.pi / slots)
    text += body("crank", 0.2, 2e-4, (apart, 0.0), omega=2.0 * math.pi, angle=enters)
    text += '[joints.hub]\ntype = "revolute"\nbetween = ["ground", "wheel"]\nat = [[0.0, 0.0], [0.0, 0.0]]\n'
    text += "friction = { sliding = 0.004 }\n"
    text += f'[joints.shaft]\ntype = "revolute"\nbetween = ["ground", "crank"]\nat = [[{apart}, 0.0], [0.0, 0.0]]\n'
    text += f'[joints.motor]\ntype = "driver"\njoint = "shaft"\nvalue = "{enters!r} + 2*pi*t"\n'
    for i in range(slots):
        c, s = math.cos(2.0 * math.pi * i / slots), math.sin(2.0 * math.pi * i / slots)
        for name, side in (("left", pin + play), ("right", -pin - play)):
            ends = [[c * r - s * side, s * r + c * side] for r in (apart - runs - 1.5 * pin, wide)]
            text += f'[contacts.{name}{i}]\nbetween = [{{ body = "crank", at = [{runs!r}, 0.0], disc = {pin} }}, '
            text += f'{{ body = "wheel", segment = {ends!r} }}]\nfriction = {mu!r}\nrestitution = {e!r}\n'
    return text


def latch(mu: float = 0.15, e: float = 0.1, speed: float = 0.3) -> str:
    """Return a door with a hook on a spring, whose nose rides over a catch, and which a seal pushes back.

    The nose is a ramp and a back that share a corner; the hook rests on a stop of the door at angle 0.
    """
    text = head("latch", 0.0, 0.0) + body("door", 1.5, 1e-2, (-0.15, 0.0), (speed, 0.0))
    text += body("hook", 0.08, 8e-5, (-0.13, 0.005), (speed, 0.0))
    text += '[joints.rail]\ntype = "translational"\nbetween = ["ground", "door"]\nat = [[0.0, 0.0], [0.0, 0.0]]\n'
    text += 'axis = [1.0, 0.0]\nangle = 0.0\n[joints.pivot]\ntype = "revolute"\nbetween = ["door", "hook"]\n'
    text += "at = [[0.0, 0.005], [-0.02, 0.0]]\n"
    text += '[forces.spring]\ntype = "torque"\nbody = "hook"\ntorque = "-0.1 - 0.6*hook.theta - 4e-4*hook.omega"\n'
    text += '[forces.seal]\ntype = "force"\nbody = "door"\n'
    text += 'force = ["(-900*(door.x + 0.061) - 20*door.vx)*(1.0 if door.x > -0.061 else 0.0)", 0.0]\n'
    text += f'[stops.seat]\ngap = "hook.theta"\nrestitution = {e!r}\n'
    corner = [0.04, -0.006]
    for name, end in (("ramp", [0.058, 0.004]), ("back", [0.04, 0.0])):
        text += f'[contacts.{name}]\nbetween = [{{ body = "ground", disc = 0.004 }}, '
        text += f'{{ body = "hook", segment = [{corner!r}, {end!r}] }}]\nfriction = {mu!r}\nrestitution = {e!r}\n'
    return text

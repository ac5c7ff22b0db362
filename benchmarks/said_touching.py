"""Examples of other systems whose parts touch at edges and along cables, by formulas: forces of penalty laws."""

from __future__ import annotations

import itertools
from collections.abc import Callable, Sequence
from math import cos, pi, sin, sqrt
from typing import Any

Table = dict[str, Any]
Three = tuple[str, str, str]
#: Speed below which friction falls [m/s].
SLOW = 1e-3


def _cross(a: Three, b: Three) -> Three:
    one, two, three = (f"(({a[i]})*({b[j]}) - ({a[j]})*({b[i]}))" for i, j in ((1, 2), (2, 0), (0, 1)))
    return one, two, three


def _each(law: Callable[[int], str]) -> Three:
    """Return what a law makes of each axis."""
    return law(0), law(1), law(2)


def _spin(body: str) -> Three:
    """Return the angular velocity of a body in ground axes."""
    return _each(lambda i: f"({' + '.join(f'{body}.w{a}*{body}.e{a}.' + 'xyz'[i] for a in 'xyz')})")


def _contact(
    name: str, one: str, two: str, away: Three, radius: float, stiffness: float, growth: float, friction: float
) -> Table:
    """Return force elements between a sphere and the ground, or a second sphere, by formulas.

    The push is stiffness times depth (1 + growth * rate of depth); `away` leads from the nearest point of the ground or
    from the centre of the second sphere, to the centre of the first.
    """
    far = f"sqrt({' + '.join(f'({a})**2' for a in away)})"
    n = _each(lambda i: f"(({away[i]})/{far})")
    other = [f" - {two}.v{c}" if two else "" for c in "xyz"]
    rate = f"({' + '.join(f'({one}.v{c}{other[i]})*{n[i]}' for i, c in enumerate('xyz'))})"
    depth = f"({(2.0 if two else 1.0) * radius!r} - {far})"
    push = f"(max(0, {stiffness!r}*{depth}*(1 - {growth!r}*{rate})) if {depth} > 0 else 0)"
    spin = _spin(one)
    if two:
        first, second = spin, _spin(two)
        spin = _each(lambda i: f"({first[i]} + {second[i]})")
    own = _cross(spin, n)
    slip = [f"({one}.v{c}{other[i]} - {radius!r}*{own[i]} - {rate}*{n[i]})" for i, c in enumerate("xyz")]
    speed = f"sqrt({' + '.join(f'{s}**2' for s in slip)} + {SLOW**2!r})"
    rub = _each(lambda i: f"(-{friction!r}*{push}*{slip[i]}/{speed})")
    whole = [f"{push}*{n[i]} + {rub[i]}" for i in range(3)]
    found: Table = {f"{name}_push": {"type": "force", "body": one, "force": whole}}
    if two:
        found[f"{name}_back"] = {"type": "force", "body": two, "force": [f"-({x})" for x in whole]}
    for body in filter(None, (one, two)):
        # the friction on the second sphere and its lever are both opposite, so that couples are equal
        scale = f"(-{radius * friction!r}*{push}/{speed})"
        turn = [f"-{scale}*{x}" for x in _cross(n, (slip[0], slip[1], slip[2]))]
        found[f"{name}_turn_{body}"] = {"type": "torque", "body": body, "torque": turn}
    return found


def _clamped(x: str, low: float, high: float) -> str:
    return f"min(max({x}, {low!r}), {high!r})"


def on_quad(ball: str, radius: float, low: float, high: float, *law: float) -> Table:
    """Return the contact of a sphere with a square of the ground, its edges and corners."""
    x, y = f"{ball}.x", f"{ball}.y"
    away = f"{x} - {_clamped(x, low, high)}", f"{y} - {_clamped(y, low, high)}", f"{ball}.z"
    return _contact(f"{ball}_ground", ball, "", away, radius, *law)


def ball_on_ball(one: str, two: str, radius: float, *law: float) -> Table:
    """Return the contact of two spheres of one radius."""
    away = f"{one}.x - {two}.x", f"{one}.y - {two}.y", f"{one}.z - {two}.z"
    return _contact(f"{one}_{two}", one, two, away, radius, *law)


def _scene(gravity: float, bodies: Table, forces: Table) -> Table:
    head = {"name": "said", "space": "spatial", "gravity": [0.0, 0.0, -gravity]}
    return {"mechanism": head, "bodies": bodies, "forces": forces}


def _ball(mass: float, radius: float, at: Sequence[float], velocity: Sequence[float], spin: float = 0.0) -> Table:
    moving = {"velocity": list(velocity), "angular_velocity": [spin, 0.0, 0.0]}
    return {"mass": mass, "inertia": [0.4 * mass * radius**2] * 3, "position": list(at)} | moving


def balls_on_a_table() -> Table:
    """Return six spheres that fall on a square, roll outwards and over its edges."""
    bodies, forces = Table(), Table()
    for k in range(6):
        x, y = sin(k * pi / 3), cos(k * pi / 3)
        bodies[f"b{k}"] = _ball(1.6, 0.1, [0.2 * x + 0.2, 0.2 * y + 0.2, 0.11], [1.2 * x, 1.2 * y, 0.0])
        # a restitution of one half at the speed of a fall through a centimetre
        forces |= on_quad(f"b{k}", 0.1, -0.25, 0.5, 1e5, 3.2, 0.2)
    return _scene(10.0, bodies, forces)


def balls_that_meet(cue: bool) -> Table:
    """Return seven spheres on a square that part, or of which one strikes six that touch."""
    bodies, forces = Table(), Table()
    places = [(j, i) for j in range(4) for i in range(max(1, j))]
    for k, (j, i) in enumerate(places):
        at = [(i - 0.5 * (j - 1)) * 0.2, -0.4 + 0.1 * j * sqrt(3.0), 0.1]
        velocity, mass, spin = [2.0 * cos(k * pi / 3), 2.0 * sin(k * pi / 3), 0.0], 0.2, 0.0
        if cue:
            velocity, mass, spin = ([0.1, 2.0, 0.0], 0.4, -20.0) if k == 0 else ([0.0] * 3, 0.2, 0.0)
            at = [at[0] - 0.1, at[1] - 0.1, 0.1] if k == 0 else at
        bodies[f"b{k}"] = _ball(mass, 0.1, at, velocity, spin)
        forces |= on_quad(f"b{k}", 0.1, -1.0, 1.0, 2e4, 0.25, 0.2)
        for other in range(k):
            forces |= ball_on_ball(f"b{other}", f"b{k}", 0.1, 2e4, 0.25, 0.2)
    return _scene(9.81, bodies, forces)


def cable_over_circles(elements: int, axial: float, load: float, second: tuple[float, float]) -> Table:
    """Return a clamped cable that falls on two circles: chords between its nodes touch them, as elastic stops."""
    rod = {"start": [0.0, 0.0], "end": [2.0, 0.0], "elements": elements, "clamp": ["ground", ""]}
    rod |= {"axial": axial, "bending": 0.01725, "mass": 7.8e-3, "rotary": 6.5e-10, "load": [0.0, -load * 7.8e-3]}
    names = [*(f"rod.{k}" for k in range(1, elements)), "rod.end"]
    stops, (far, wide) = Table(), second
    for c, (x, y, radius) in enumerate(((far, -0.5, wide), (0.5, -0.15, 0.1))):
        for k, (one, two) in enumerate(itertools.pairwise(names)):
            along = f"({two}.x - {one}.x)", f"({two}.y - {one}.y)"
            from_one = f"({x!r} - {one}.x)", f"({y!r} - {one}.y)"
            share = f"({from_one[0]}*{along[0]} + {from_one[1]}*{along[1]})/({along[0]}**2 + {along[1]}**2)"
            share = f"min(max({share}, 0), 1)"
            apart = [f"({from_one[i]} - {share}*{along[i]})**2" for i in (0, 1)]
            stops[f"s{c}_{k}"] = {"gap": f"sqrt({apart[0]} + {apart[1]}) - {radius!r}", "stiffness": 1e3}
    return {"mechanism": {"name": "said"}, "beams": {"rod": rod}, "stops": stops}

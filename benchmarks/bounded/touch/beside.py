"""Random scenes in which impacts accumulate beside contacts that slide or stick meanwhile, and beside joints."""

from __future__ import annotations

import math
from collections.abc import Callable

from benchmarks.bounded.touch.bodies import GROUND, Surface
from benchmarks.bounded.touch.scenes import FLOOR, Draft


def _falling(draft: Draft, x: float, over: float) -> Surface:
    """Add a disc that falls from over a place; return its surface."""
    r, mass = draft.one(0.04, 0.1), draft.one(0.3, 2.0)
    velocity, spin = (draft.one(-0.5, 0.5), draft.one(-0.2, 0.0)), draft.one(-20.0, 20.0)
    inertia = round(draft.one(0.4, 0.9) * mass * r * r, 7)
    place = x, over + r + draft.one(0.005, 0.05)
    return Surface(draft.body("disc", mass, inertia, place, velocity=velocity, omega=spin), radius=r)


def wedge(draft: Draft) -> None:
    """Draw a disc that falls on a wedge, which slides on a floor on two feet."""
    half, mass, slope = draft.one(0.4, 0.8), draft.one(0.5, 3.0), draft.one(-0.3, 0.3)
    body = draft.body("wedge", mass, 0.2 * mass, (0.0, 0.1), velocity=(draft.one(-0.5, 0.5), 0.0))
    normal = -math.sin(slope), math.cos(slope)
    disc = _falling(draft, draft.one(-0.1, 0.1), 0.24)
    draft.touch(disc, Surface(body, (0.0, 0.1), None, normal), e=draft.one(0.2, 0.6))
    for side in (-half, half):
        draft.touch(Surface(body, (side, -0.1), 0.0), FLOOR, e=0.0)


def sled(draft: Draft) -> None:
    """Draw a disc that falls on a sled on a rail and springs, and strikes a buffer of the sled."""
    angle = draft.one(-0.3, 0.3)
    body = draft.body("sled", draft.one(0.5, 3.0), 0.1, (0.0, 0.1))
    draft.rail(body, (math.cos(angle), math.sin(angle)))
    draft.spring(body, (draft.one(-0.2, 0.2), 0.1), (draft.one(20.0, 100.0), 0.0), (draft.one(0.0, 2.0), 0.0))
    disc = _falling(draft, 0.0, 0.15)
    draft.touch(disc, Surface(body, (0.0, 0.05)), e=draft.one(0.1, 0.6))
    way = draft.sign()
    wall = -way * draft.one(0.12, 0.2), 0.0
    draft.touch(disc, Surface(body, wall, None, (way, 0.0)), e=draft.one(0.1, 0.6))


def ring(draft: Draft) -> None:
    """Draw a disc that falls in a ring, which rolls or skids on a floor."""
    size, mass = draft.one(0.3, 0.5), draft.one(0.5, 2.0)
    rate, spin = draft.one(-0.3, 0.3), draft.one(-3.0, 3.0)
    body = draft.body("ring", mass, round(mass * size * size, 7), (0.0, size), velocity=(rate, 0.0), omega=spin)
    disc = _falling(draft, draft.one(-0.1, 0.1), 0.05)
    draft.touch(disc, Surface(body, radius=-(size - 0.02)), e=draft.one(0.1, 0.6))
    draft.touch(Surface(body, radius=size), FLOOR, e=0.0)


def seesaw(draft: Draft) -> None:
    """Draw a disc that falls on a beam on a pin, one end of which lies on a stop."""
    half, mass = draft.one(0.4, 0.7), draft.one(0.5, 2.0)
    beam = draft.body("beam", mass, round(mass * half * half / 3.0, 6), (0.0, 0.3))
    pin = draft.one(-0.2, 0.2)
    draft.pin(GROUND, beam, (pin, 0.3), (pin, 0.0))
    side = -1.0 if pin > 0.0 else 1.0  # the heavy side
    disc = _falling(draft, pin + side * draft.one(0.05, 0.3), 0.32)
    draft.touch(disc, Surface(beam, (0.0, 0.02)), e=draft.one(0.1, 0.6))
    draft.touch(Surface(beam, (side * half, 0.0), 0.0), Surface(GROUND, (0.0, 0.3)), smooth=True, e=draft.one(0.0, 0.5))


def stack(draft: Draft) -> None:
    """Draw a disc that falls into the corner between a floor and a disc that rolls there."""
    r, mass = draft.one(0.1, 0.2), draft.one(0.5, 3.0)
    rate, spin = (draft.one(-0.2, 0.2), 0.0), draft.one(-3.0, 3.0)
    big = draft.body("big", mass, round(0.5 * mass * r * r, 7), (0.0, r), velocity=rate, omega=spin)
    disc = _falling(draft, draft.sign() * (r + draft.one(0.105, 0.15)), draft.one(0.02, 0.1))
    draft.touch(Surface(big, radius=r), FLOOR, e=0.0)
    draft.touch(disc, FLOOR, e=draft.one(0.1, 0.6))
    draft.touch(disc, Surface(big, radius=r), e=draft.one(0.1, 0.6))


BESIDE: dict[str, Callable[[Draft], None]] = {draw.__name__: draw for draw in (wedge, sled, ring, seesaw, stack)}

"""Joints of the plane, put where the bodies' poses satisfy them."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np

from benchmarks.mechanisms.draft import GROUND, Draft
from benchmarks.plain.moving import Array


def left(vector: Array) -> Array:
    """Return a vector turned left by 90 degrees."""
    return np.array([-vector[1], vector[0]])


def angle(draft: Draft, body: str) -> float:
    """Return the angle at which a body starts."""
    return 0.0 if body == GROUND else float(draft.raw["bodies"][body].get("angle", 0.0))


def revolute(draft: Draft, a: str, b: str) -> bool:
    """Put a pin somewhere near."""
    if a != GROUND and b != GROUND and not (draft.poses[a].rigid or draft.poses[b].rigid):
        return False
    at = draft.near(a, b)
    draft.joint("revolute", between=[a, b], at=[draft.local(a, at), draft.local(b, at)])
    return True


def rigid(draft: Draft, a: str, b: str) -> bool:
    """Weld two bodies as they stand."""
    at = draft.near(a, b)
    turn = angle(draft, b) - angle(draft, a)
    draft.joint("rigid", between=[a, b], at=[draft.local(a, at), draft.local(b, at)], angle=turn)
    return True


def translational(draft: Draft, a: str, b: str) -> bool:
    """Put a slide along some line."""
    at, along = draft.near(a, b), draft.direction()
    other = at + draft.number(-0.8, 0.8) * along
    draft.joint(
        draft.rng.choice(["translational", "prismatic"]),
        between=[a, b],
        at=[draft.local(a, at), draft.local(b, other)],
        axis=[draft.number(0.5, 2.0) * x for x in draft.inward(a, along)],
        angle=angle(draft, b) - angle(draft, a),
    )
    return True


def distance(draft: Draft, a: str, b: str) -> bool:
    """Put a rod between two points that are apart."""
    at = draft.some_point(a), draft.some_point(b)
    length = float(np.linalg.norm(draft.where(a, at[0]) - draft.where(b, at[1])))
    if length < 0.3:
        return False
    draft.joint("distance", between=[a, b], at=list(at), length=draft.scalar(length))
    return True


def pin_in_slot(draft: Draft, a: str, b: str) -> bool:
    """Put a slot of the second body through a point of the first."""
    pin, along = draft.some_point(a), draft.direction()
    slot = draft.where(a, pin) + draft.number(-0.6, 0.6) * along
    kind = draft.rng.choice(["pin-in-slot", "inline"])
    draft.joint(kind, between=[a, b], at=[pin, draft.local(b, slot)], axis=draft.inward(b, along))
    return True


def orientation(draft: Draft, a: str, b: str) -> bool:
    """Keep the angle between two bodies."""
    draft.joint("orientation", between=[a, b], angle=angle(draft, b) - angle(draft, a))
    return True


def rolling(draft: Draft, a: str, b: str) -> bool:
    """Put a line of the second body under a disc of the first."""
    if a == GROUND:
        a, b = b, a
    radius, along = draft.positive(0.1, 0.6), draft.direction()
    centre = draft.some_point(a) if draft.chance(0.5) else "centre"
    middle = draft.where(a, centre)
    on = middle - radius * left(along) + draft.number(-0.5, 0.5) * along
    travelled = float(along @ (middle - on))
    keys = {"centre": centre} if centre != "centre" else {}
    draft.joint(
        "rolling",
        between=[a, b],
        radius=radius,
        axis=draft.inward(b, along),
        on=draft.local(b, on),
        offset=travelled + radius * (angle(draft, a) - angle(draft, b)),
        **keys,
    )
    return True


def gear(draft: Draft, a: str, b: str) -> bool:
    """Gear two wheels that have their axes already; the carrier is the ground or another body."""
    if GROUND in (a, b):
        return False
    carrier = draft.pick(rigid=True, other=(a, b)) if draft.chance(0.4) else None
    carrier = carrier or GROUND
    r_a, r_b = draft.positive(0.2, 1.5), draft.positive(0.2, 1.5)
    mesh = draft.rng.choice(["external", "internal"])
    keys = {"radii": [r_a, r_b]} if draft.chance(0.6) else {"ratio": r_b}
    weight = r_a if "radii" in keys else 1.0
    sign = -1.0 if mesh == "internal" else 1.0
    turn_a, turn_b = angle(draft, a) - angle(draft, carrier), angle(draft, b) - angle(draft, carrier)
    more = {} if carrier == GROUND else {"carrier": carrier}
    draft.joint("gear", between=[a, b], mesh=mesh, offset=weight * turn_a + sign * r_b * turn_b, **keys, **more)
    return True


def knife_edge(draft: Draft, a: str, b: str) -> bool:
    """Give a body a blade."""
    body = a if a != GROUND else b
    draft.joint("knife-edge", body=body, axis=draft.inward(body, draft.direction()), at=draft.some_point(body))
    return True


#: Kind -> what draws it, whether its bodies must be rigid, and how often it is drawn.
KINDS: dict[str, tuple[Callable[[Draft, str, str], bool], tuple[bool, bool], float]] = {
    "revolute": (revolute, (False, False), 6.0),
    "translational": (translational, (True, True), 2.0),
    "distance": (distance, (False, False), 2.0),
    "pin-in-slot": (pin_in_slot, (False, True), 2.0),
    "rolling": (rolling, (True, True), 1.0),
    "rigid": (rigid, (True, True), 0.5),
    "gear": (gear, (True, True), 1.0),
    "knife-edge": (knife_edge, (True, True), 0.5),
    "orientation": (orientation, (True, True), 0.5),
    "place": (Draft.place, (False, False), 0.3),
    "rows": (Draft.rows, (False, False), 1.0),
    "coupling": (Draft.coupling, (False, False), 1.0),
}
#: Kinds that alone hold a body on another one.
TREE = ("revolute", "translational", "distance", "pin-in-slot", "rigid")


def parallelogram(draft: Draft) -> None:
    """Draw equal cranks with couplers, one more than is needed: rows that depend on others for ever."""
    base, reach, angle_ = draft.positive(0.8, 2.0), draft.positive(0.5, 1.2), draft.number(0.3, 1.2)
    along = np.array([math.cos(angle_), math.sin(angle_)])
    cranks = []
    for x in (0.0, base):
        crank = draft.body(rigid=True)
        at = np.array([x, 0.0])
        _placed(draft, crank, at, angle_)
        draft.joint("revolute", between=[GROUND, crank], at=[at.tolist(), [0.0, 0.0]])
        cranks.append(crank)
    for share in (1.0, draft.number(0.3, 0.7)):
        coupler = draft.body(rigid=True)
        _placed(draft, coupler, share * reach * along, 0.0)
        draft.joint("revolute", between=[cranks[0], coupler], at=[[share * reach, 0.0], [0.0, 0.0]])
        draft.joint("revolute", between=[cranks[1], coupler], at=[[share * reach, 0.0], [base, 0.0]])
    draft.features |= {"redundant", "parallelogram"}


def _placed(draft: Draft, body: str, origin: Array, angle_: float) -> None:
    """Stand a body at a place, turned by an angle."""
    table, pose = draft.raw["bodies"][body], draft.poses[body]
    table["position"], table["angle"] = [float(x) for x in origin], angle_
    pose.origin = origin
    pose.matrix = np.array([[math.cos(angle_), -math.sin(angle_)], [math.sin(angle_), math.cos(angle_)]])


def four_bar(draft: Draft) -> None:
    """Draw a four-bar whose crank can turn round, or one that cannot."""
    crank, coupler, rocker = (draft.body(rigid=True) for _ in range(3))
    a = draft.positive(0.2, 0.6)
    points = np.array(
        [[0.0, 0.0], [0.0, 0.0], [draft.number(0.8, 1.4), draft.number(0.6, 1.2)], [draft.number(1.0, 1.8), 0.0]]
    )
    turn = draft.number(-3.0, 3.0)
    points[1] = [a * math.cos(turn), a * math.sin(turn)]
    for body, start, end in ((crank, 0, 1), (coupler, 1, 2), (rocker, 3, 2)):
        line = points[end] - points[start]
        _placed(draft, body, points[start], float(math.atan2(line[1], line[0])))
        draft.raw["bodies"][body]["points"] = {"P": [0.0, 0.0], "Q": [float(np.linalg.norm(line)), 0.0]}
    draft.joint("revolute", between=[GROUND, crank], at=[[0.0, 0.0], "P"])
    draft.joint("revolute", between=[crank, coupler], at=["Q", "P"])
    draft.joint("revolute", between=[coupler, rocker], at=["Q", "Q"])
    draft.joint("revolute", between=[GROUND, rocker], at=[points[3].tolist(), "P"])
    draft.features.add("four-bar")


SPECIAL = (parallelogram, four_bar)

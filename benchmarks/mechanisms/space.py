"""Joints in space, put where the bodies' poses satisfy them."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import numpy as np

from benchmarks.mechanisms.draft import GROUND, Draft
from benchmarks.plain.moving import Array
from benchmarks.plain.start import choose_turns
from benchmarks.plain.system import read
from benchmarks.plain.turning import turned


def axes(draft: Draft, a: str, b: str, along: Array) -> Any:
    """Return an axis as a file may write it: in the first body, or in both."""
    if draft.chance(0.5):
        return draft.inward(a, draft.number(0.5, 2.0) * along)
    return [draft.inward(a, along), draft.inward(b, draft.number(0.5, 2.0) * along)]


def references(draft: Draft, a: str, b: str, along: Array, equal: bool) -> dict[str, Any]:
    """Return sometimes directions across an axis: the same one of both bodies, or any."""
    if not draft.chance(0.4):
        return {}
    first = draft.across(along)
    second = first + draft.number(-1.0, 1.0) * along if equal else draft.across(along)
    return {"reference": [draft.inward(a, first), draft.inward(b, second)]}


def ends(draft: Draft, a: str, b: str, shift: Array | None = None) -> list[Any]:
    """Return one place as a point of each body, the second moved by a shift."""
    at = draft.near(a, b)
    return [draft.local(a, at), draft.local(b, at if shift is None else at + shift)]


def spherical(draft: Draft, a: str, b: str) -> bool:
    """Put a ball somewhere near."""
    if a != GROUND and b != GROUND and not (draft.poses[a].rigid or draft.poses[b].rigid):
        return False
    draft.joint("spherical", between=[a, b], at=ends(draft, a, b))
    return True


def revolute(draft: Draft, a: str, b: str) -> bool:
    """Put a pin with an axis."""
    along = draft.direction()
    more = references(draft, a, b, along, equal=False)
    draft.joint("revolute", between=[a, b], at=ends(draft, a, b), axis=axes(draft, a, b, along), **more)
    return True


def slide(kind: str, equal: bool) -> Callable[[Draft, str, str], bool]:
    """Return what draws a joint along a line."""

    def draw(draft: Draft, a: str, b: str) -> bool:
        along = draft.direction()
        more = references(draft, a, b, along, equal)
        at = ends(draft, a, b, draft.number(-0.8, 0.8) * along)
        draft.joint(kind, between=[a, b], at=at, axis=axes(draft, a, b, along), **more)
        return True

    return draw


def measured(draft: Draft, joint: str, label: str) -> float:
    """Return a coordinate of a joint as the bodies stand, an angle with some whole turns."""
    kinds = {n: t for n, t in draft.raw["joints"].items() if t["type"] != "driver"}
    system = read({**draft.raw, "joints": kinds, "forces": {}})
    q = np.concatenate([body.start for body in system.bodies.values()])
    choose_turns(system, 0.0, q)
    axis = next(j for j in system.joints if j.name == joint)
    return float(axis.coordinates[label](system.at(0.0, q, np.zeros(system.nv))).value)


def turns(draft: Draft) -> float:
    """Return a few whole turns, mostly none [rad]."""
    if not draft.chance(0.25):
        return 0.0
    draft.features.add("turns")
    return 2.0 * math.pi * draft.rng.randint(-5, 5)


def screw(draft: Draft, a: str, b: str) -> bool:
    """Put a nut on a thread."""
    slide("cylindrical", equal=False)(draft, a, b)
    name = next(reversed(draft.raw["joints"]))
    table = draft.raw["joints"][name]
    pitch = draft.positive(0.05, 0.6) * draft.rng.choice([1.0, -1.0])
    along, about = measured(draft, name, "displacement"), measured(draft, name, "angle") + turns(draft)
    table |= {"type": "screw", "pitch": pitch, "offset": along - pitch * about / (2.0 * math.pi)}
    draft.features.add("screw")
    return True


def universal(draft: Draft, a: str, b: str) -> bool:
    """Put a cross whose axes are perpendicular."""
    one = draft.direction()
    other = np.cross(one, draft.across(one))
    other /= np.linalg.norm(other)
    draft.joint("universal", between=[a, b], at=ends(draft, a, b), axes=[draft.inward(a, one), draft.inward(b, other)])
    return True


def constant_velocity(draft: Draft, a: str, b: str) -> bool:
    """Put shafts that lean against each other about an axis across them."""
    shaft = draft.direction()
    lean = np.cross(shaft, draft.across(shaft))
    turn = turned(draft.number(0.0, 1.2) * lean / np.linalg.norm(lean))
    first = draft.across(shaft)
    draft.joint(
        "constant-velocity",
        between=[a, b],
        at=ends(draft, a, b),
        axis=[draft.inward(a, shaft), draft.inward(b, turn @ shaft)],
        reference=[draft.inward(a, first), draft.inward(b, turn @ first)],
    )
    return True


def planar(draft: Draft, a: str, b: str) -> bool:
    """Lay a plane of one body on a plane of the other."""
    normal = draft.direction()
    shift = np.cross(normal, draft.direction()) * draft.number(0.2, 0.8)
    more = references(draft, a, b, normal, equal=False)
    draft.joint("planar", between=[a, b], at=ends(draft, a, b, shift), normal=axes(draft, a, b, normal), **more)
    return True


def perpendicular(draft: Draft, a: str, b: str) -> bool:
    """Keep two axes perpendicular."""
    one = draft.direction()
    other = np.cross(one, draft.across(one))
    draft.joint("perpendicular", between=[a, b], axes=[draft.inward(a, one), draft.inward(b, other)])
    return True


def parallel_axes(draft: Draft, a: str, b: str) -> bool:
    """Keep two axes parallel."""
    along = draft.direction()
    more = references(draft, a, b, along, equal=False)
    draft.joint("parallel-axes", between=[a, b], axis=axes(draft, a, b, along), **more)
    return True


def orientation(draft: Draft, a: str, b: str) -> bool:
    """Keep two bodies from turning against each other."""
    draft.joint("orientation", between=[a, b], **_frames(draft, a, b))
    return True


def rigid(draft: Draft, a: str, b: str) -> bool:
    """Weld two bodies as they stand."""
    draft.joint("rigid", between=[a, b], at=ends(draft, a, b), **_frames(draft, a, b))
    return True


def _frames(draft: Draft, a: str, b: str) -> dict[str, Any]:
    """Return sometimes directions of both bodies that coincide as they stand."""
    more: dict[str, Any] = {}
    if draft.chance(0.5):
        along, first = draft.direction(), None
        first = draft.across(along)
        more = {
            "axis": [draft.inward(a, along), draft.inward(b, along)],
            "reference": [draft.inward(a, first), draft.inward(b, first)],
        }
    return more


def distance(draft: Draft, a: str, b: str) -> bool:
    """Put a rod between two points that are apart."""
    at = draft.some_point(a), draft.some_point(b)
    length = float(np.linalg.norm(draft.where(a, at[0]) - draft.where(b, at[1])))
    if length < 0.3:
        return False
    draft.joint("distance", between=[a, b], at=list(at), length=draft.scalar(length))
    return True


def revolute_spherical(draft: Draft, a: str, b: str) -> bool:
    """Put a link across a pin of the first body, with its ball in the second."""
    axis = draft.direction()
    ball = draft.some_point(b)
    across = np.cross(axis, draft.across(axis))
    length = draft.positive(0.3, 1.2)
    pin = draft.where(b, ball) - length * across / np.linalg.norm(across)
    more = {"reference": draft.inward(a, draft.across(axis))} if draft.chance(0.4) else {}
    draft.joint(
        "revolute-spherical",
        between=[a, b],
        at=[draft.local(a, pin), ball],
        axis=draft.inward(a, axis),
        length=length,
        **more,
    )
    return True


def pin_in_slot(draft: Draft, a: str, b: str) -> bool:
    """Put a line of the second body through a point of the first."""
    pin, along = draft.some_point(a), draft.direction()
    slot = draft.where(a, pin) + draft.number(-0.6, 0.6) * along
    kind = draft.rng.choice(["pin-in-slot", "point-on-line", "inline"])
    draft.joint(kind, between=[a, b], at=[pin, draft.local(b, slot)], axis=draft.inward(b, along))
    return True


def point_on_plane(draft: Draft, a: str, b: str) -> bool:
    """Put a plane of the second body through a point of the first."""
    point, normal = draft.some_point(a), draft.direction()
    on = draft.where(a, point) + np.cross(normal, draft.direction()) * draft.number(0.2, 0.8)
    kind = draft.rng.choice(["point-on-plane", "in-plane"])
    draft.joint(kind, between=[a, b], at=[point, draft.local(b, on)], normal=draft.inward(b, normal))
    return True


def _plane(draft: Draft, height: float, middle: Array, normal: Array) -> dict[str, Any]:
    on = middle - height * normal + np.cross(normal, draft.direction()) * draft.number(0.0, 0.5)
    more = {"reference": draft.across(normal).tolist()} if draft.chance(0.3) else {}
    return {"normal": (draft.number(0.5, 2.0) * normal).tolist(), "on": on.tolist(), **more}


def contact(kind: str) -> Callable[[Draft, str, str], bool]:
    """Return what draws a body that touches a plane of the ground."""

    def draw(draft: Draft, a: str, b: str) -> bool:
        body = a if a != GROUND else b
        if any(t.get("body") == body for t in draft.raw["joints"].values()):
            return False
        point = "centre" if draft.chance(0.5) else draft.some_point(body)
        middle, normal, axis = draft.where(body, point), draft.direction(), draft.direction()
        lean = float(normal @ axis)
        if kind != "rolling-sphere" and abs(lean) > 0.85:
            return False
        radius = draft.positive(0.15, 0.7)
        keys: dict[str, Any] = {"body": body}
        if kind == "knife-edge":
            keys |= {"at": point, "axis": draft.inward(body, axis), **_plane(draft, 0.0, middle, normal)}
            keys.pop("reference", None)
        elif kind == "rolling-sphere":
            keys |= {"centre": point, "radius": radius, **_plane(draft, radius, middle, normal)}
        else:
            high = radius * math.sqrt(1.0 - lean * lean)
            keys |= {"centre": point, "radius": radius, "axis": draft.inward(body, axis)}
            keys |= _plane(draft, high, middle, normal)
        draft.joint(kind, **keys)
        return True

    return draw


def _coordinates(draft: Draft, unit: str) -> list[tuple[str, str]]:
    reported = {
        "revolute": ("angle",),
        "cylindrical": ("displacement", "angle"),
        "planar": ("displacement1", "displacement2", "angle"),
        "screw": ("displacement", "angle"),
        "translational": ("displacement",),
        "universal": ("angle1", "angle2"),
    }
    return [
        (name, label)
        for name, table in draft.raw["joints"].items()
        for label in reported.get(table["type"], ())
        if label.startswith(unit)
    ]


def gear(draft: Draft, a: str, b: str) -> bool:
    """Gear the angles of two joints."""
    angles = _coordinates(draft, "angle")
    if len({name for name, _ in angles}) < 2:
        return False
    one, other = draft.rng.sample(angles, 2)
    if one[0] == other[0]:
        return False
    r_a, r_b = draft.positive(0.2, 1.2), draft.positive(0.2, 1.2)
    mesh = draft.rng.choice(["external", "internal"])
    sign = -1.0 if mesh == "internal" else 1.0
    offset = r_a * (measured(draft, *one) + turns(draft)) + sign * r_b * measured(draft, *other)
    joints, labels = [one[0], other[0]], [one[1], other[1]]
    draft.joint("gear", joints=joints, coordinates=labels, radii=[r_a, r_b], mesh=mesh, offset=offset)
    return True


def rack_and_pinion(draft: Draft, a: str, b: str) -> bool:
    """Tie a displacement of a joint to an angle of another."""
    about, along = _coordinates(draft, "angle"), _coordinates(draft, "disp")
    if not about or not along:
        return False
    pinion, rack = draft.rng.choice(about), draft.rng.choice(along)
    if pinion[0] == rack[0]:
        return False
    radius = draft.positive(0.1, 0.8) * draft.rng.choice([1.0, -1.0])
    offset = measured(draft, *rack) - radius * (measured(draft, *pinion) + turns(draft))
    labels = [pinion[1], rack[1]]
    draft.joint("rack-and-pinion", pinion=pinion[0], rack=rack[0], coordinates=labels, radius=radius, offset=offset)
    return True


#: Kind -> what draws it, whether its bodies must be rigid, and how often it is drawn.
KINDS: dict[str, tuple[Callable[[Draft, str, str], bool], tuple[bool, bool], float]] = {
    "spherical": (spherical, (False, False), 3.0),
    "revolute": (revolute, (True, True), 4.0),
    "translational": (slide("translational", True), (True, True), 1.5),
    "cylindrical": (slide("cylindrical", False), (True, True), 1.5),
    "screw": (screw, (True, True), 1.5),
    "universal": (universal, (True, True), 1.5),
    "constant-velocity": (constant_velocity, (True, True), 1.5),
    "planar": (planar, (True, True), 1.0),
    "rigid": (rigid, (True, True), 0.4),
    "distance": (distance, (False, False), 1.5),
    "revolute-spherical": (revolute_spherical, (True, False), 1.0),
    "pin-in-slot": (pin_in_slot, (False, True), 1.0),
    "point-on-plane": (point_on_plane, (False, True), 1.0),
    "rolling-disc": (contact("rolling-disc"), (True, True), 0.7),
    "rolling-sphere": (contact("rolling-sphere"), (True, True), 0.7),
    "knife-edge": (contact("knife-edge"), (True, True), 0.5),
    "gear": (gear, (True, True), 1.0),
    "rack-and-pinion": (rack_and_pinion, (True, True), 1.0),
    "orientation": (orientation, (True, True), 0.5),
    "parallel-axes": (parallel_axes, (True, True), 0.7),
    "perpendicular": (perpendicular, (True, True), 0.7),
    "place": (Draft.place, (False, False), 0.3),
    "rows": (Draft.rows, (False, False), 1.0),
    "coupling": (Draft.coupling, (False, False), 1.0),
}
#: Kinds that alone hold a body on another one.
TREE = (
    "spherical revolute translational cylindrical screw universal constant-velocity planar rigid distance "
    "revolute-spherical pin-in-slot point-on-plane"
).split()


def planar_loop(draft: Draft) -> None:
    """Draw a four-bar of revolute joints with parallel axes: three of its rows depend on the others for ever."""
    normal = draft.direction()
    u = np.cross(normal, draft.across(normal))
    u /= np.linalg.norm(u)
    w = np.cross(normal, u)
    corners = [0.0 * u, 0.5 * w + 0.1 * u, 1.1 * u + 0.9 * w, 1.4 * u]
    corners = [c + draft.number(-0.1, 0.1) * u + draft.number(-0.1, 0.1) * w for c in corners]
    bodies = [GROUND, *(draft.body(rigid=True) for _ in range(3))]
    for k, corner in enumerate(corners):
        a, b = bodies[k], bodies[(k + 1) % 4]
        axis = [draft.inward(a, normal), draft.inward(b, normal)]
        draft.joint("revolute", between=[a, b], at=[draft.local(a, corner), draft.local(b, corner)], axis=axis)
    draft.features |= {"redundant", "planar-loop"}


def rack_drive(draft: Draft) -> None:
    """Draw a wheel on a pin, a rack on a slide, and what ties one to the other."""
    wheel, rack = draft.body(rigid=True), draft.body(rigid=True)
    revolute(draft, GROUND, wheel)
    slide("translational", True)(draft, draft.rng.choice([GROUND, wheel]), rack)
    rack_and_pinion(draft, wheel, rack)


SPECIAL = (planar_loop, rack_drive)

"""Forces, drivers and formulas of random mechanisms."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from benchmarks.mechanisms.draft import GROUND, VALUES, Draft
from benchmarks.plain.start import choose_turns
from benchmarks.plain.system import read

#: Formulas of time and state: {a} and {b} are numbers, B a body, TAB a table. Smooth ones first.
SMOOTH = (
    "{a}",
    "{a}*sin({b}*t)",
    "{a}*cos({b}*t + 0.3) - {b}",
    "-{A}*B.vx",
    "-{A}*B.x + {a}",
    "{a}*tanh(B.vy)",
    "{a}*exp(-t)*B.y",
    "{a}/(1 + B.x**2)",
    "-{A}*B.vx*sqrt(1 + B.vx**2 + B.vy**2)",
    "{a}*atan2(B.y, 2 + B.x**2)",
    "{a}*sin(B.x)*cos(B.y) + {b}*t**2",
    "{a} if 1 < 2 else {b}",
)
KINKED = (
    "piecewise(t < 0.31, {a}, {b})",
    "max(0, {a}*B.y)",
    "min({a}, {b}*B.vx)",
    "-{A}*abs(B.vx)*B.vx",
    "{a}*TAB(B.x)",
    "{a} if B.y > 0.1 and not t > 0.5 else {b}",
    "TAB(t) + {b}*TAB(B.y)",
)
PLANE = ("{a}*cos(B.theta)", "-{A}*B.omega", "{a}*sin(B.theta) - {A}*B.omega", "{a}*B.omega*B.vx")
SPACE = ("-{A}*B.wx", "{a}*B.e0*B.e3", "{a}*B.wy*B.wz - {A}*B.vz", "{a}*B.z")
OF_ANGLE = ("{a}*cos(angle)", "-{A}*rate", "{a}*sin(angle) - {A}*rate + {b}*t", "-{A}*tanh(rate/0.5)")
OF_LENGTH = ("{a}*sin({b}*t)", "-{A}*rate*length", "{a}*exp(-length)", "{a}*cos(length) - {A}*rate")
POTENTIALS = ("{a}*cos({s})", "{A}*{s}**2/2", "{A}*({s} - {b})**4/4", "{A}*exp(0.3*{s})", "{A}*log(1 + {s}**2)")
#: Functions of time with two derivatives, and their value at 0.
OF_TIME = (
    ("{a}*t", 0.0),
    ("{a}*sin({b}*t)", 0.0),
    ("{a}*t + 0.2*sin(3*t)", 0.0),
    ("{a}*t**2", 0.0),
    ("{a}*(1 - cos({b}*t))", 0.0),
    ("{a}*tanh(2*t)", 0.0),
    ("{a}*t*exp(-t)", 0.0),
)


def filled(draft: Draft, text: str, size: float, **words: str) -> str | float:
    """Return a formula with numbers, a body and a table for its places."""
    a, b = draft.number(-size, size, 3), draft.number(-3.0, 3.0, 3)
    text = text.format(a=f"({a})", A=abs(a) or 1.0, b=f"({b})", **words)
    if "B." in text:
        turns = any(f"B.{label}" in text for label in ("theta", "omega", "wx", "wy", "wz", "e0"))
        bodies = [n for n, pose in draft.poses.items() if pose.rigid or not turns]
        if not bodies:
            return a
        text = text.replace("B.", f"{draft.rng.choice(bodies)}.")
    while "TAB" in text:
        text = text.replace("TAB", _table(draft), 1)
    return text


def _table(draft: Draft) -> str:
    tables: list[str] = list(draft.raw["tables"])
    if tables and draft.chance(0.5):
        return draft.rng.choice(tables)
    name = draft.name("tab", VALUES)
    x = sorted({draft.number(-2.0, 2.0, 2) for _ in range(draft.rng.randint(2, 6))})
    if len(x) < 2:
        x = [-1.0, 1.0]
    draft.raw["tables"][name] = {"x": x, "y": [draft.number(-1.0, 1.0, 2) for _ in x]}
    draft.features.add("table")
    return name


def of_state(draft: Draft, size: float, own: tuple[str, ...] = ()) -> str | float:
    """Return a formula of time and state."""
    kinked = draft.chance(0.2)
    pool = [*(KINKED if kinked else SMOOTH), *(() if kinked else SPACE if draft.spatial else PLANE)]
    text = draft.rng.choice([*pool, *own, *own] if not kinked else pool)
    if kinked:
        draft.features.add("kink")
    draft.features.add("formula")
    return filled(draft, text, size)


def potential(draft: Draft, word: str, size: float) -> str | float:
    """Return a potential of an element's own coordinate."""
    draft.features.add("potential")
    return filled(draft, draft.rng.choice(POTENTIALS), size, s=word)


def spring(draft: Draft) -> bool:
    """Put a spring, a damper or an actuator between two points that are apart."""
    a = draft.pick()
    b = draft.pick(other=(a,)) if a else None
    if a is None or b is None:
        return False
    at = draft.some_point(a), draft.some_point(b)
    length = float(np.linalg.norm(draft.where(a, at[0]) - draft.where(b, at[1])))
    if length < 0.4:
        return False
    keys: dict[str, Any] = {}
    if draft.chance(0.8):
        keys |= {"stiffness": draft.scalar(draft.positive(1.0, 300.0)), "free_length": draft.number(0.0, length)}
    if draft.chance(0.6) or not keys:
        keys["damping"] = draft.scalar(draft.positive(0.05, 10.0))
    if draft.chance(0.25):
        keys["actuator"] = of_state(draft, 5.0, OF_LENGTH)
    if draft.chance(0.2):
        keys["potential"] = potential(draft, "length", 3.0)
    draft.force("spring-damper", between=[a, b], at=list(at), **keys)
    return True


def _angles(draft: Draft) -> list[tuple[str, str]]:
    reported = {"revolute": ["angle"], "cylindrical": ["angle"], "screw": ["angle"], "planar": ["angle"]}
    reported |= {"universal": ["angle1", "angle2"], "revolute-spherical": ["angle"]}
    joints = draft.raw["joints"].items()
    return [(name, label) for name, table in joints for label in reported.get(table["type"], ())]


def _about(draft: Draft) -> dict[str, Any] | None:
    """Return the keys that say which angle a torsional spring works on."""
    if draft.spatial:
        angles = _angles(draft)
        if not angles:
            return None
        joint, label = draft.rng.choice(angles)
        return {"joint": joint, **({"coordinate": label} if label != "angle" else {})}
    a = draft.pick(rigid=True)
    b = draft.pick(rigid=True, other=(a,)) if a else None
    return None if b is None else {"between": [a, b]}


def torsion(draft: Draft) -> bool:
    """Put a torsional spring."""
    about = _about(draft)
    if about is None:
        return False
    keys: dict[str, Any] = {}
    if draft.chance(0.8):
        keys |= {"stiffness": draft.scalar(draft.positive(0.1, 30.0)), "free_angle": draft.number(-1.0, 1.0)}
    if draft.chance(0.5) or not keys:
        keys["damping"] = draft.scalar(draft.positive(0.02, 2.0))
    if draft.chance(0.25):
        keys["actuator"] = of_state(draft, 2.0, OF_ANGLE)
    if draft.chance(0.2):
        keys["potential"] = potential(draft, "angle", 1.0)
    draft.force("torsional-spring-damper", **about, **keys)
    return True


def torque(draft: Draft) -> bool:
    """Put a torque on a body, between two, or on the angle of a joint."""
    if draft.spatial and draft.chance(0.4):
        about = _about(draft)
        if about is None:
            return False
        keys = {"potential": potential(draft, "angle", 1.0)} if draft.chance(0.2) else {}
        draft.force("torque", torque=of_state(draft, 2.0, OF_ANGLE), **about, **keys)
        return True
    body = draft.pick(rigid=True, ground=False)
    if body is None:
        return False
    keys = {}
    reaction = draft.pick(rigid=True, other=(body,))
    if draft.chance(0.5) and reaction is not None:
        keys["reaction"] = reaction
    if draft.spatial:
        if draft.chance(0.5):
            keys["frame"] = draft.rng.choice(["ground", "body"])
        draft.force("torque", body=body, torque=[of_state(draft, 1.5) for _ in range(3)], **keys)
        return True
    if draft.chance(0.2):
        keys["potential"] = potential(draft, "angle", 1.0)
    draft.force("torque", body=body, torque=of_state(draft, 2.0, OF_ANGLE), **keys)
    return True


def force(draft: Draft) -> bool:
    """Put a force at a point of a body."""
    body = draft.pick(ground=False)
    if body is None:
        return False
    at = draft.some_point(body)
    keys: dict[str, Any] = {} if at == "centre" else {"at": at}
    if draft.chance(0.25):
        words = "xyz"[: draft.dimension]
        draft.force("force", body=body, potential=[potential(draft, word, 3.0) for word in words], **keys)
        return True
    if draft.chance(0.3) and draft.poses[body].rigid:
        keys["frame"] = draft.rng.choice(["ground", "body"])
    draft.force("force", body=body, force=[of_state(draft, 5.0) for _ in range(draft.dimension)], **keys)
    return True


def bushing(draft: Draft) -> bool:
    """Put a bushing between two bodies in space."""
    a = draft.pick(rigid=True)
    b = draft.pick(rigid=True, other=(a,)) if a else None
    if not draft.spatial or b is None or a is None:
        return False
    at = draft.near(a, b)
    keys: dict[str, Any] = {"at": [draft.local(a, at), draft.local(b, at)]}
    for key, size in (("stiffness", 40.0), ("damping", 2.0)):
        if draft.chance(0.6):
            keys[key] = [draft.positive(0.1 * size, size) for _ in range(6)]
        else:
            root = np.array([[draft.rng.gauss(0.0, 1.0) for _ in range(6)] for _ in range(6)])
            matrix = size / 12.0 * (root @ root.T)
            keys[key] = (0.5 * (matrix + matrix.T)).tolist()
    draft.force("bushing", between=[a, b], **keys)
    return True


KINDS = {spring: 4.0, torsion: 2.0, torque: 2.0, force: 2.5, bushing: 1.0}


def drive(draft: Draft) -> bool:
    """Drive a coordinate of a joint or a body, from where it is at the start."""
    choices: list[dict[str, Any]] = []
    labels = "xyz"[: draft.dimension] if draft.spatial else "xy"
    for name, pose in draft.poses.items():
        choices += [{"body": name, "coordinate": label} for label in labels]
        if pose.rigid and draft.chance(0.5):
            choices.append({"body": name, "coordinate": labels[0], "point": draft.some_point(name)})
        if pose.rigid and not draft.spatial:
            choices += [{"body": name, "coordinate": "theta"}] * 2
    reported = {"revolute": ["angle"], "translational": ["displacement"], "prismatic": ["displacement"]}
    reported |= {"pin-in-slot": ["displacement"], "cylindrical": ["displacement", "angle"]}
    reported |= {"universal": ["angle1", "angle2"], "planar": ["displacement1", "angle"]}
    for name, table in draft.raw["joints"].items():
        rigid = all(b == GROUND or draft.poses[b].rigid for b in table.get("between", ()))
        if table["type"] == "revolute" and not rigid:
            continue
        for label in reported.get(table["type"], ()):
            choices += [{"joint": name, "coordinate": label}] * 2
    if not choices:
        return False
    keys = draft.rng.choice(choices)
    name = draft.joint("driver", **keys, value=0.0)
    table = draft.raw["joints"][name]
    system = read({**draft.raw, "forces": {}})
    q = np.concatenate([body.start for body in system.bodies.values()])
    choose_turns(system, 0.0, q)
    row = next(j for j in system.joints if j.name == name).rows[0]
    now = float(row.of(system.at(0.0, q, np.zeros(system.nv))).value)
    text, at_zero = draft.rng.choice(OF_TIME)
    extra = 0.0
    if draft.spatial and str(keys["coordinate"]).startswith("angle") and draft.chance(0.3):
        extra = 2.0 * math.pi * draft.rng.randint(-6, 6)
        draft.features.add("turns")
    table["value"] = f"({now - at_zero + extra!r}) + {filled(draft, text, 2.0)}"
    return True

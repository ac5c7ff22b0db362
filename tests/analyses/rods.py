"""Mechanisms whose equilibria and frequencies are known in closed form, as raw descriptions."""

import math
import tomllib

from support.emitted import mechanism_of

import symgen
from analyses import linkages

GRAVITY = 9.81


def of_raw(raw):
    return symgen.load(mechanism_of(raw))


def of_text(text):
    return of_raw(tomllib.loads(text))


def model(bodies, joints, space="planar", **sections):
    """A model of a raw description, hanging in gravity."""
    down = [0.0, -GRAVITY] if space == "planar" else [0.0, 0.0, -GRAVITY]
    head = {"name": "rods", "space": space, "gravity": sections.pop("gravity", down)}
    return of_raw({"mechanism": head, "bodies": bodies, "joints": joints, **sections})


def pin(first, second, a, b, kind="revolute", **more):
    return {"type": kind, "between": [first, second], "at": [a, b], **more}


ROD = {"mass": 2.0, "inertia": "2.0/12", "points": {"A": [-0.5, 0.0], "B": [0.5, 0.0]}}
ROD3 = {"mass": 2.0, "inertia": ["1e-4", "2.0/12", "2.0/12"], "points": {"A": [-0.5, 0.0, 0.0]}}
GROUND2, GROUND3 = [0.0, 0.0], [0.0, 0.0, 0.0]


def hanging(kind):
    """A rod of 1 m on a pin at the origin, jointed in one of many ways; not quite at rest at the start."""
    rod = {**ROD, "position": [0.1, -0.45], "angle": -1.3}
    down = {"x_axis": [0.1, 0.0, -1.0], "y_axis": [0.0, 1.0, 0.0]}
    rod3 = {**ROD3, "position": [0.05, 0.0, -0.5], "orientation": down}
    if kind == "revolute":
        return model({"rod": rod}, {"pin": pin("ground", "rod", GROUND2, "A")})
    if kind == "distance":
        far = [[-1.0, 0.0], [0.6, 0.8]]
        return model(
            {"rod": rod}, {f"d{i}": pin("ground", "rod", p, "A", "distance", length=1.0) for i, p in enumerate(far)}
        )
    if kind == "slot and rail":
        slot = {"type": "pin-in-slot", "between": ["rod", "ground"], "at": ["A", GROUND2]}
        return model({"rod": rod}, {"slot": {**slot, "axis": [0.0, 1.0]}, "rail": {**slot, "axis": [1.0, 0.0]}})
    if kind == "massless":
        bracket = {"mass": 0.0, "inertia": 0.0, "points": {"P": [0.0, 0.2]}, "position": [0.0, -0.2]}
        joints = {
            "pin": pin("ground", "bracket", GROUND2, "P"),
            "weld": pin("bracket", "rod", "P", "A", "rigid", angle="-pi/2"),
        }
        return model({"bracket": bracket, "rod": rod}, joints)
    if kind == "twice":
        joints = {name: pin("ground", "rod", GROUND2, "A") for name in ("pin", "again")}
        return model({"rod": rod}, joints)
    if kind == "revolute in space":
        return model({"rod": rod3}, {"pin": pin("ground", "rod", GROUND3, "A", axis=[0.0, 1.0, 0.0])}, "spatial")
    if kind == "ball":
        return model({"rod": rod3}, {"pin": pin("ground", "rod", GROUND3, "A", "spherical")}, "spatial")
    assert kind == "distances in space"
    far = [[-1.0, 0.0, 0.0], [0.6, 0.8, 0.0], [0.0, -0.6, 0.8]]
    joints = {f"d{i}": pin("ground", "rod", p, "A", "distance", length=1.0) for i, p in enumerate(far)}
    return model({"rod": rod3}, joints, "spatial")


KINDS = (
    *("revolute", "distance", "slot and rail", "massless", "twice"),
    *("revolute in space", "ball", "distances in space"),
)


def chain(n):
    """Point masses of 1 kg on massless links of 1 m, hanging."""
    bodies = {f"m{i}": {"type": "point", "mass": 1.0, "position": [0.0, -1.0 - i]} for i in range(n)}
    joints = {}
    for i in range(n):
        before = ("ground", GROUND2) if i == 0 else (f"m{i - 1}", "centre")
        joints[f"l{i}"] = pin(before[0], f"m{i}", before[1], "centre", "distance", length=1.0)
    return model(bodies, joints)


def catenary(angle, n=10, span=1.0):
    """Uniform links, 2 m and 2 kg in all, laid out one behind the other at `angle(i)`: the last end is off its pin."""
    half, bodies, joints, x, y = 1.0 / n, {}, {}, 0.0, 0.0
    for i in range(n):
        a = float(angle(i))
        place = [x + half * math.cos(a), y + half * math.sin(a)]
        ends = {"A": [-half, 0.0], "B": [half, 0.0]}
        inertia = 2 * half * (2 * half) ** 2 / 12
        bodies[f"l{i}"] = {"mass": 2 * half, "inertia": inertia, "points": ends, "position": place, "angle": a}
        x, y = x + 2 * half * math.cos(a), y + 2 * half * math.sin(a)
        joints[f"j{i}"] = pin(*(("ground", f"l{i}", GROUND2) if i == 0 else (f"l{i - 1}", f"l{i}", "B")), "A")
    joints["end"] = pin("ground", f"l{n - 1}", [span, 0.0], "B")
    return model(bodies, joints)


def four_bar(doubled=False):
    """Rods of 1, 3 and 3 m and kg on ground pins 4 m apart; the pin of coupler and rocker stays above the ground."""
    raw = linkages.four_bar((4.0, 1.0, 3.0, 3.0), math.pi / 3, None, (1.0, 3.0, 3.0))
    if doubled:  # the same place, written so that no row is one of the other joint's
        raw["joints"]["D2"] = pin("rocker", "ground", "near", [4.0, 0.0])
        raw["joints"]["link"] = pin("ground", "rocker", [4.0, 2.0], "near", "distance", length=2.0)
    return model(raw["bodies"], raw["joints"])


def mass_spring_damper(**sections):
    """A body on a rail with a spring and a damper to the ground, and a force as input."""
    body = {"mass": 1.6, "inertia": 0.1, "position": [0.5, 0.0], "points": {"P": [0.0, 0.0]}}
    rail = pin("ground", "body", GROUND2, "centre", "translational", axis=[1.0, 0.0])
    spring = {"type": "spring-damper", "between": ["ground", "body"], "at": [[-1.0, 0.0], "P"], "free_length": 1.3}
    push = {"type": "force", "body": "body", "force": ["push", 0.0]}
    return model(
        {"body": body},
        {"rail": rail},
        gravity=[0.0, 0.0],
        parameters={"k": 4000.0, "c": 8.0},
        inputs={"push": 0.0},
        forces={"spring": {**spring, "stiffness": "k", "damping": "c"}, "push": push},
        outputs={"where": "body.x", "pull": "spring.force", "both": "2*body.vx + push"},
        **sections,
    )

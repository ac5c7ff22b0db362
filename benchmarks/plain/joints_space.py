"""Joints in space: rows and coordinates, from docs/file-format."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

import numpy as np

from benchmarks.plain.bodies import GROUND, Marker, State
from benchmarks.plain.elements import Joint, Measure, Parts, Row, Triad, Turn, across, made
from benchmarks.plain.joints_plane import (
    component,
    coupling,
    distance,
    driver,
    less,
    part,
    place,
    rows,
    stretch,
    weights,
)
from benchmarks.plain.moving import Moving, angle, cross, crossed, direction, dot, root, skew

Table = Mapping[str, Any]
Rows = list[Row]


def product(u: Marker, v: Marker) -> Measure:
    """Return u . v of two directions."""
    return lambda s: dot(s.along(u), s.along(v))


def negative(measure: Measure) -> Measure:
    """Return the opposite of a measure."""
    return lambda s: -measure(s)


def turn(zero: Marker, quarter: Marker, pointer: Marker) -> Turn:
    """Return the angle of a direction from another one towards a third."""
    return Turn(
        lambda s, near: angle(dot(s.along(pointer), s.along(quarter)), dot(s.along(pointer), s.along(zero)), near)
    )


def coincident(name: str, a: Marker, b: Marker) -> Rows:
    """Hold two points together."""
    return [Row(f"{name}.{label}", part(a, b, i)) for i, label in enumerate("xyz")]


def parallel(name: str, a: Triad, b: Triad) -> Rows:
    """Hold two axes parallel: torques about the first body's directions across its axis."""
    return [
        Row(f"{name}.first", negative(product(a.second, b.axis))),
        Row(f"{name}.second", product(a.first, b.axis)),
    ]


def on_axis(name: str, a: Marker, b: Marker, triad: Triad) -> Rows:
    """Hold point b on the axis through point a."""
    return [
        Row(f"{name}.across1", component(a, b, triad.first)),
        Row(f"{name}.across2", component(a, b, triad.second)),
    ]


def turned(a: Triad, b: Triad) -> Turn:
    """Return the angle of the second body about the axis."""
    return turn(a.first, a.second, b.first)


def spherical(parts: Parts, name: str, table: Table) -> Joint:
    """Hold two points together: a ball and its socket."""
    a, b = table["between"]
    return Joint(name, (a, b), coincident(name, *parts.ends(table)))


def revolute(parts: Parts, name: str, table: Table) -> Joint:
    """Hold two points together and two axes parallel."""
    a, b = table["between"]
    of_a, of_b = parts.triads(a, b, table["axis"], table.get("reference"))
    rows = coincident(name, *parts.ends(table)) + parallel(name, of_a, of_b)
    return Joint(name, (a, b), rows, {"angle": turned(of_a, of_b)})


def rigid(parts: Parts, name: str, table: Table) -> Joint:
    """Hold two frames together."""
    a, b = table["between"]
    of_a, of_b = parts.triads(a, b, table.get("axis", [0.0, 0.0, 1.0]), table.get("reference"))
    held = Row(f"{name}.angle", product(of_a.second, of_b.first))
    return Joint(name, (a, b), [*coincident(name, *parts.ends(table)), *parallel(name, of_a, of_b), held])


def translational(parts: Parts, name: str, table: Table) -> Joint:
    """Let a body slide along an axis without turning."""
    a, b = table["between"]
    of_a, of_b = parts.triads(a, b, table["axis"], table.get("reference"))
    ends = parts.ends(table)
    held = Row(f"{name}.angle", product(of_a.second, of_b.first))
    rows = [*on_axis(name, *ends, of_a), *parallel(name, of_a, of_b), held]
    return Joint(name, (a, b), rows, {"displacement": component(*ends, of_a.axis)})


def cylindrical(parts: Parts, name: str, table: Table) -> Joint:
    """Let a shaft slide and turn in a sleeve."""
    a, b = table["between"]
    of_a, of_b = parts.triads(a, b, table["axis"], table.get("reference"))
    ends = parts.ends(table)
    coordinates: dict[str, Measure] = {"displacement": component(*ends, of_a.axis), "angle": turned(of_a, of_b)}
    return Joint(name, (a, b), on_axis(name, *ends, of_a) + parallel(name, of_a, of_b), coordinates)


def screw(parts: Parts, name: str, table: Table) -> Joint:
    """Let a nut slide on a shaft as its thread turns it."""
    joint = cylindrical(parts, name, table)
    pitch, offset = parts.document.number(table["pitch"]), parts.document.number(table.get("offset", 0.0))
    along, about = joint.coordinates["displacement"], joint.coordinates["angle"]

    def of(s: State) -> Moving:
        return (along(s) - about(s).times(pitch / (2.0 * np.pi))).plus(-offset)

    return Joint(name, joint.bodies, [*joint.rows, Row(f"{name}.screw", of)], joint.coordinates)


def universal(parts: Parts, name: str, table: Table) -> Joint:
    """Hold two points together and two axes perpendicular: a cross."""
    a, b = table["between"]
    axis_a, axis_b = (parts.unit(axis) for axis in table["axes"])
    if "reference" in table:
        first_a, first_b = (
            across(parts.unit(x), axis) for x, axis in zip(table["reference"], (axis_a, axis_b), strict=True)
        )
    else:
        carry = parts.described.matrix(b).T @ parts.described.matrix(a)
        first_a, first_b = across(carry.T @ axis_b, axis_a), across(carry @ axis_a, axis_b)
    of_a, of_b = made(a, first_a, axis_a), made(b, first_b, axis_b)
    rows = [*coincident(name, *parts.ends(table)), Row(f"{name}.cross", product(of_a.axis, of_b.axis))]
    coordinates: dict[str, Measure] = {
        "angle1": turn(of_a.first, of_a.second, of_b.axis),
        "angle2": _Backward(turn(of_b.first, of_b.second, of_a.axis)),
    }

    def crossing(s: State) -> float:
        return float(np.linalg.norm(crossed(s.along(of_a.axis).value, s.along(of_b.axis).value)))

    return Joint(name, (a, b), rows, coordinates, [crossing])


class _Backward:
    """The opposite of an angle that is known up to whole turns."""

    def __init__(self, angle: Turn) -> None:
        self.angle = angle

    def __call__(self, state: State) -> Moving:
        return -self.angle(state)


def constant_velocity(parts: Parts, name: str, table: Table) -> Joint:
    """Let shafts lean but not twist: half the difference of two products vanishes."""
    a, b = table["between"]
    of_a, of_b = parts.triads(a, b, table["axis"], table.get("reference"))
    up, down = product(of_a.second, of_b.first), product(of_a.first, of_b.second)
    rows = [*coincident(name, *parts.ends(table)), Row(f"{name}.twist", lambda s: (up(s) - down(s)).times(0.5))]

    def leaning(s: State) -> float:
        return 0.5 * (1.0 + float(s.along(of_a.axis).value @ s.along(of_b.axis).value))

    return Joint(name, (a, b), rows, {}, [leaning])


def planar(parts: Parts, name: str, table: Table) -> Joint:
    """Lay a plane on another one."""
    a, b = table["between"]
    of_a, of_b = parts.triads(a, b, table["normal"], table.get("reference"))
    ends = parts.ends(table)
    rows = [Row(f"{name}.normal", component(*ends, of_a.axis)), *parallel(name, of_a, of_b)]
    coordinates: dict[str, Measure] = {
        "displacement1": component(*ends, of_a.first),
        "displacement2": component(*ends, of_a.second),
        "angle": turned(of_a, of_b),
    }
    return Joint(name, (a, b), rows, coordinates)


def revolute_spherical(parts: Parts, name: str, table: Table) -> Joint:
    """Hold a ball on a link across a pin's axis."""
    a, b = table["between"]
    pin, ball = parts.ends(table)
    of_a, length = parts.triad(a, table["axis"], table.get("reference")), parts.document.number(table["length"])
    rows = [
        Row(f"{name}.along", component(pin, ball, of_a.axis)),
        Row(f"{name}.distance", stretch(pin, ball, length)),
    ]
    across1, across2 = component(pin, ball, of_a.first), component(pin, ball, of_a.second)
    return Joint(name, (a, b), rows, {"angle": Turn(lambda s, near: angle(across2(s), across1(s), near))})


def pin_in_slot(parts: Parts, name: str, table: Table) -> Joint:
    """Hold a point of the first body on a line of the second."""
    a, b = table["between"]
    pin, slot = parts.ends(table)
    triad = parts.triad(b, table["axis"])
    return Joint(name, (a, b), on_axis(name, pin, slot, triad), {"displacement": component(slot, pin, triad.axis)})


def point_on_plane(parts: Parts, name: str, table: Table) -> Joint:
    """Hold a point of the first body in a plane of the second."""
    a, b = table["between"]
    point, plane = parts.ends(table)
    triad = parts.triad(b, table["normal"])
    coordinates = {
        "displacement1": component(plane, point, triad.first),
        "displacement2": component(plane, point, triad.second),
    }
    return Joint(name, (a, b), [Row(f"{name}.normal", component(point, plane, triad.axis))], coordinates)


def coordinate(parts: Parts, joint: str, label: str | None, unit: str = "") -> Measure:
    """Return a coordinate of a joint: the only one of its unit where no label is given."""
    coordinates = parts.joint(joint).coordinates
    if label is None:
        label = next(name for name in coordinates if unit == "" or name.startswith({"rad": "angle", "m": "disp"}[unit]))
    return coordinates[label]


def gear(parts: Parts, name: str, table: Table) -> Joint:
    """Hold r_a angle_a + r_b angle_b at the offset."""
    r_a, r_b = weights(parts, table)
    offset = parts.document.number(table.get("offset", 0.0))
    labels, unit = table.get("coordinates", (None, None)), "rad" if "radii" in table else ""
    a, b = (coordinate(parts, j, label, unit) for j, label in zip(table["joints"], labels, strict=True))
    bodies = [body for joint in table["joints"] for body in parts.joint(joint).bodies]

    def of(s: State) -> Moving:
        return (a(s).times(r_a) + b(s).times(r_b)).plus(-offset)

    return Joint(name, tuple(dict.fromkeys(bodies)), [Row(f"{name}.mesh", of)])


def rack_and_pinion(parts: Parts, name: str, table: Table) -> Joint:
    """Hold a displacement at radius angle + offset."""
    labels = table.get("coordinates", (None, None))
    about = coordinate(parts, table["pinion"], labels[0], "rad")
    along = coordinate(parts, table["rack"], labels[1], "m")
    radius, offset = parts.document.number(table["radius"]), parts.document.number(table.get("offset", 0.0))
    bodies = [body for joint in (table["rack"], table["pinion"]) for body in parts.joint(joint).bodies]

    def of(s: State) -> Moving:
        return (along(s) - about(s).times(radius)).plus(-offset)

    return Joint(name, tuple(dict.fromkeys(bodies)), [Row(f"{name}.mesh", of)])


# -- contact with a plane of the ground --------------------------------------------------------------------------------


def material_speed(body: str, centre: Marker, arm: Measure, along: Marker) -> Measure:
    """Return the velocity along a direction of the ground of the body's material point at centre + arm."""

    def of(s: State) -> Moving:
        c, omega, r, e = s.point(centre), s.spin(body), arm(s), s.along(along).value
        gradient = c.gradient - skew(r.value) @ omega.gradient
        rate = c.rate + crossed(omega.rate, r.value)
        curve = c.curve + crossed(omega.rate, r.rate)
        return Moving(np.zeros(()), e @ gradient, e @ rate, e @ curve)

    return of


def _contact(parts: Parts, name: str, table: Table, arm: Measure, height: Measure, margins: list[Any]) -> Joint:
    body = table["body"]
    centre = parts.marker(body, table.get("centre", "centre"))
    plane = parts.triad(GROUND, table["normal"], table.get("reference"))
    rows = [Row(f"{name}.normal", negative(height))]
    for label, along in (("slip1", plane.first), ("slip2", plane.second)):
        backward = Marker(GROUND, -along.at)
        rows.append(Row(f"{name}.{label}", material_speed(body, centre, arm, backward), holonomic=False))
    return Joint(name, (body,), rows, {}, margins)


def rolling_disc(parts: Parts, name: str, table: Table) -> Joint:
    """Roll a thin disc on a plane of the ground."""
    body, radius = table["body"], parts.document.number(table["radius"])
    centre, on = parts.marker(body, table.get("centre", "centre")), parts.marker(GROUND, table.get("on", [0, 0, 0]))
    normal, axis = Marker(GROUND, parts.unit(table["normal"])), Marker(body, parts.unit(table["axis"]))
    up, lean = component(on, centre, normal), product(normal, axis)

    def steep(s: State) -> Moving:
        n = lean(s)
        return root(dot_square(n))

    def dot_square(n: Moving) -> Moving:
        x = float(n.value)
        return n.through(1.0 - x * x, -2.0 * x, -2.0)

    def arm(s: State) -> Moving:
        down = s.along(axis).scaled(lean(s)) - s.along(normal)
        return direction(down).times(radius)

    def height(s: State) -> Moving:
        return up(s) - steep(s).times(radius)

    return _contact(parts, name, table, arm, height, [lambda s: float(steep(s).value)])


def rolling_sphere(parts: Parts, name: str, table: Table) -> Joint:
    """Roll a sphere on a plane of the ground."""
    body, radius = table["body"], parts.document.number(table["radius"])
    centre, on = parts.marker(body, table.get("centre", "centre")), parts.marker(GROUND, table.get("on", [0, 0, 0]))
    normal = Marker(GROUND, parts.unit(table["normal"]))
    down = Marker(GROUND, -radius * normal.at)
    height = less(component(on, centre, normal), radius)
    return _contact(parts, name, table, lambda s: s.along(down), height, [])


def knife_edge(parts: Parts, name: str, table: Table) -> Joint:
    """Stand a blade on a plane of the ground: its point stays there and has no velocity to the right of the blade."""
    body = table["body"]
    point, on = parts.marker(body, table.get("at", "centre")), parts.marker(GROUND, table.get("on", [0, 0, 0]))
    normal, back = Marker(GROUND, parts.unit(table["normal"])), Marker(body, -parts.unit(table["axis"]))

    def sideways(s: State) -> Moving:
        p, right = s.point(point), direction(cross(s.along(normal), s.along(back)))
        return Moving(
            np.zeros(()),
            right.value @ p.gradient,
            right.value @ p.rate,
            right.rate @ p.rate + right.value @ p.curve,
        )

    def flat(s: State) -> float:
        return float(np.linalg.norm(crossed(s.along(normal).value, s.along(back).value)))

    rows = [
        Row(f"{name}.normal", component(point, on, normal)),
        Row(f"{name}.side", sideways, holonomic=False),
    ]
    return Joint(name, (body,), rows, {}, [flat])


def orientation(parts: Parts, name: str, table: Table) -> Joint:
    """Hold the directions of two bodies together."""
    a, b = table["between"]
    of_a, of_b = parts.triads(a, b, table.get("axis", [0.0, 0.0, 1.0]), table.get("reference"))
    return Joint(name, (a, b), [*parallel(name, of_a, of_b), Row(f"{name}.angle", product(of_a.second, of_b.first))])


def parallel_axes(parts: Parts, name: str, table: Table) -> Joint:
    """Hold two axes parallel."""
    a, b = table["between"]
    of_a, of_b = parts.triads(a, b, table["axis"], table.get("reference"))
    return Joint(name, (a, b), parallel(name, of_a, of_b), {"angle": turned(of_a, of_b)})


def perpendicular(parts: Parts, name: str, table: Table) -> Joint:
    """Hold two axes perpendicular."""
    a, b = table["between"]
    u, v = (Marker(body, parts.unit(axis)) for body, axis in zip((a, b), table["axes"], strict=True))
    return Joint(name, (a, b), [Row(f"{name}.cross", product(u, v))])


KINDS: dict[str, Callable[[Parts, str, Table], Joint]] = {
    "spherical": spherical,
    "revolute": revolute,
    "rigid": rigid,
    "translational": translational,
    "prismatic": translational,
    "cylindrical": cylindrical,
    "screw": screw,
    "universal": universal,
    "constant-velocity": constant_velocity,
    "planar": planar,
    "distance": distance,
    "revolute-spherical": revolute_spherical,
    "pin-in-slot": pin_in_slot,
    "point-on-line": pin_in_slot,
    "point-on-plane": point_on_plane,
    "gear": gear,
    "rack-and-pinion": rack_and_pinion,
    "driver": driver,
    "rolling-disc": rolling_disc,
    "rolling-sphere": rolling_sphere,
    "knife-edge": knife_edge,
    "orientation": orientation,
    "parallel-axes": parallel_axes,
    "perpendicular": perpendicular,
    "place": place,
    "coupling": coupling,
    "rows": rows,
    "inline": pin_in_slot,
    "in-plane": point_on_plane,
}

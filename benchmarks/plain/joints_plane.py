"""Joints in the plane: rows and coordinates, from docs/file-format."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from math import perm
from typing import Any

import numpy as np

from benchmarks.plain.bodies import GROUND, Marker, State
from benchmarks.plain.elements import Joint, Measure, Parts, Row
from benchmarks.plain.formulas import Tree, value
from benchmarks.plain.moving import Array, Moving, constant, dot
from benchmarks.plain.series import Series, lift

Table = Mapping[str, Any]


def left(vector: Array) -> Array:
    """Return a vector of the plane turned left by 90 degrees."""
    return np.array([-vector[1], vector[0]])


def part(a: Marker, b: Marker, i: int) -> Measure:
    """Return a component in ground axes of the vector from a to b."""
    return lambda s: s.between(a, b).part(i)


def component(a: Marker, b: Marker, along: Marker) -> Measure:
    """Return the component along a direction of the vector from a to b."""
    return lambda s: dot(s.along(along), s.between(a, b))


def angle(a: str, b: str) -> Measure:
    """Return the angle of body b less that of body a."""
    return lambda s: s.angle(b) - s.angle(a)


def less(measure: Measure, constant: float) -> Measure:
    """Return a measure less a constant."""
    return lambda s: measure(s).plus(-constant)


def stretch(a: Marker, b: Marker, length: float) -> Measure:
    """Return (d^2 - L^2) / (2 L) of the distance d of two points."""

    def of(s: State) -> Moving:
        d = s.between(a, b)
        return dot(d, d).plus(-(length**2)).times(0.5 / length)

    return of


def revolute(parts: Parts, name: str, table: Table) -> Joint:
    """Hold two points together."""
    a, b = table["between"]
    ends = parts.ends(table)
    rows = [Row(f"{name}.{label}", part(*ends, i)) for i, label in enumerate("xy")]
    turns = all(body == GROUND or parts.bodies[body].rigid for body in (a, b))
    return Joint(name, (a, b), rows, {"angle": angle(a, b)} if turns else {})


def rigid(parts: Parts, name: str, table: Table) -> Joint:
    """Hold two points together and the angle where it is given."""
    a, b = table["between"]
    pins = revolute(parts, name, table)
    turn = Row(f"{name}.angle", less(angle(a, b), parts.document.number(table.get("angle", 0.0))))
    return Joint(name, (a, b), [*pins.rows, turn])


def translational(parts: Parts, name: str, table: Table) -> Joint:
    """Hold a point of the second body on a line of the first, and the angle."""
    a, b = table["between"]
    ends, along = parts.ends(table), parts.unit(table["axis"])
    rows = [
        Row(f"{name}.normal", component(*ends, Marker(a, left(along)))),
        Row(f"{name}.angle", less(angle(a, b), parts.document.number(table.get("angle", 0.0)))),
    ]
    return Joint(name, (a, b), rows, {"displacement": component(*ends, Marker(a, along))})


def distance(parts: Parts, name: str, table: Table) -> Joint:
    """Hold two points apart."""
    a, b = table["between"]
    length = parts.document.number(table["length"])
    return Joint(name, (a, b), [Row(f"{name}.distance", stretch(*parts.ends(table), length))])


def pin_in_slot(parts: Parts, name: str, table: Table) -> Joint:
    """Hold a point of the first body on a line of the second."""
    a, b = table["between"]
    (pin, slot), along = parts.ends(table), parts.unit(table["axis"])
    coordinates = {"displacement": component(slot, pin, Marker(b, along))}
    if a == GROUND or parts.bodies[a].rigid:
        coordinates["angle"] = angle(a, b)
    return Joint(name, (a, b), [Row(f"{name}.normal", component(pin, slot, Marker(b, left(along))))], coordinates)


def weights(parts: Parts, table: Table) -> tuple[float, float]:
    """Return what the two coordinates of a gear are multiplied by."""
    if "radii" in table:
        a, b = (parts.document.number(r) for r in table["radii"])
    else:
        a, b = 1.0, parts.document.number(table["ratio"])
    return a, -b if table.get("mesh", "external") == "internal" else b


def gear(parts: Parts, name: str, table: Table) -> Joint:
    """Hold r_a (theta_c - theta_a) + r_b (theta_c - theta_b) at -offset: every row runs from the first body on."""
    (a, b), carrier = table["between"], table.get("carrier", GROUND)
    r_a, r_b = weights(parts, table)
    offset = parts.document.number(table.get("offset", 0.0))

    def of(s: State) -> Moving:
        return (angle(a, carrier)(s).times(r_a) + angle(b, carrier)(s).times(r_b)).plus(offset)

    return Joint(name, (a, b) if carrier == GROUND else (a, b, carrier), [Row(f"{name}.mesh", of)])


def rolling(parts: Parts, name: str, table: Table) -> Joint:
    """Roll a disc on a line: rows run from the disc to the line."""
    disc, base = table["between"]
    centre, line = parts.marker(disc, table.get("centre", "centre")), parts.marker(base, table["on"])
    along, radius = parts.unit(table["axis"]), parts.document.number(table["radius"])
    offset = parts.document.number(table.get("offset", 0.0))
    way, turn = component(centre, line, Marker(base, along)), angle(disc, base)

    def roll(s: State) -> Moving:
        return (way(s) + turn(s).times(radius)).plus(offset)

    rows = [
        Row(f"{name}.normal", less(component(centre, line, Marker(base, left(along))), -radius)),
        Row(f"{name}.roll", roll),
    ]
    return Joint(name, (disc, base), rows, {"displacement": component(line, centre, Marker(base, along))})


def knife_edge(parts: Parts, name: str, table: Table) -> Joint:
    """Forbid a point's velocity across a direction of the body: to the right, so that the force on the body is left."""
    body = table["body"]
    point, right = parts.marker(body, table.get("at", "centre")), Marker(body, -left(parts.unit(table["axis"])))
    return Joint(name, (body,), [Row(f"{name}.normal", speed(point, right), holonomic=False)])


def speed(point: Marker, along: Marker) -> Measure:
    """Return the velocity of a point along a direction of its body, as the rate of nothing."""

    def of(s: State) -> Moving:
        p, e = s.point(point), s.along(along)
        rate = e.value @ p.rate
        return Moving(np.zeros(()), e.value @ p.gradient, rate, e.rate @ p.rate + e.value @ p.curve)

    return of


def driver(parts: Parts, name: str, table: Table) -> Joint:
    """Make a coordinate of a joint, or of a point of a body, follow a function of time."""
    tree = parts.document.formula(table["value"])
    if "joint" in table:
        joint = parts.joint(table["joint"])
        label = table.get("coordinate") or next(iter(joint.coordinates))
        measure, bodies = joint.coordinates[label], joint.bodies
    else:
        body, label = table["body"], table["coordinate"]
        bodies = (GROUND, body)
        if label == "theta":
            measure = angle(GROUND, body)
        else:
            origin = Marker(GROUND, np.zeros(parts.document.dimension))
            measure = part(origin, parts.marker(body, table.get("point", "centre")), "xyz".index(label))

    return Joint(name, bodies, [Row(f"{name}.driver", less_of_time(parts, measure, tree))])


def less_of_time(parts: Parts, measure: Measure, tree: Tree) -> Measure:
    """Return a measure less a function of time."""

    def of(s: State) -> Moving:
        wanted = lift(value(tree, {**parts.document.parameters, "t": Series(s.t, 1.0)}))
        moved = measure(s) - constant(wanted.value, s.nv)
        moved.rate = moved.rate - wanted.first
        moved.curve = moved.curve - wanted.second
        return moved

    return of


def orientation(parts: Parts, name: str, table: Table) -> Joint:
    """Hold the angle alone."""
    a, b = table["between"]
    return Joint(
        name, (a, b), [Row(f"{name}.angle", less(angle(a, b), parts.document.number(table.get("angle", 0.0))))]
    )


def place(parts: Parts, name: str, table: Table) -> Joint:
    """Report where a point of the second body is in the first one's frame."""
    a, b = table["between"]
    ends, axes = parts.ends(table), np.eye(parts.document.dimension)
    return Joint(name, (a, b), [], {n: component(*ends, Marker(a, e)) for n, e in zip("xyz", axes, strict=False)})


def coupling(parts: Parts, name: str, table: Table) -> Joint:
    """Tie coordinates of joints to a function of time and a polynomial of another coordinate."""
    number, bodies = parts.document.number, list[str]()

    def coordinate(text: str) -> Measure:
        joint = parts.joint(text.partition(".")[0])
        bodies.extend(joint.bodies)
        return joint.coordinates[text.partition(".")[2]]

    terms = [(number(factor), coordinate(text)) for text, factor in table["terms"].items()]
    powers = [number(c) for c in table.get("polynomial", [])]
    argument = coordinate(table["of"]) if powers else None

    def of(s: State) -> Moving:
        total = constant(0.0, s.nv)
        for factor, measure in terms:
            total = total + measure(s).times(factor)
        if argument is not None:
            x, series = argument(s), list(enumerate(powers))
            f, slope, bend = (
                sum(c * perm(k, n) * float(x.value) ** (k - n) for k, c in series if k >= n) for n in range(3)
            )
            total = total - x.through(f, slope, bend)
        return total

    tree = parts.document.formula(table.get("value", 0.0))
    row = Row(f"{name}.coupling", less_of_time(parts, of, tree))
    return Joint(name, tuple(dict.fromkeys(bodies)), [row])


def rows(parts: Parts, name: str, table: Table) -> Joint:
    """Hold formulas of positions at 0: sums, differences and products of numbers and coordinates of bodies."""
    bodies = list[str]()

    def read(tree: Tree) -> Measure:
        kind, *inner = tree
        if kind == "number":
            return lambda s: constant(inner[0], s.nv)
        if kind == "name":
            body, label = inner[0].split(".")
            bodies.append(body)
            centre = np.zeros(parts.document.dimension)
            return part(Marker(GROUND, centre), Marker(body, centre), "xyz".index(label))
        a, *others = (read(x) for x in inner)
        if kind == "minus":
            return lambda s: -a(s)
        (b,) = others
        joined: Callable[[Moving, Moving], Moving] = {"+": Moving.__add__, "-": Moving.__sub__, "*": Moving.scaled}[
            kind
        ]
        return lambda s: joined(a(s), b(s))

    held = [
        Row(f"{name}.row{i}", read(parts.document.formula(row["position"]))) for i, row in enumerate(table["rows"], 1)
    ]
    return Joint(name, tuple(dict.fromkeys(bodies)), held)


def rope(parts: Parts, name: str, table: Table) -> Joint:
    """Keep the distance of two points, or hold them by a force where the rope stretches; there are no sheaves here."""
    ends = parts.ends(table)
    if "over" in table or "length" not in table:
        raise ValueError("ropes over sheaves, and of the length at the start, have closed forms in tests")
    length = parts.document.number(table["length"])

    def way(s: State) -> Moving:
        square = dot(s.between(*ends), s.between(*ends))
        root = float(np.sqrt(square.value))
        return square.through(root, 0.5 / root, -0.25 / root**3).plus(-length)

    rows = [] if "stiffness" in table else [Row(f"{name}.tension", way)]
    return Joint(name, tuple(table["between"]), rows)


KINDS: dict[str, Callable[[Parts, str, Table], Joint]] = {
    "revolute": revolute,
    "rigid": rigid,
    "translational": translational,
    "prismatic": translational,
    "distance": distance,
    "pin-in-slot": pin_in_slot,
    "gear": gear,
    "rolling": rolling,
    "knife-edge": knife_edge,
    "driver": driver,
    "orientation": orientation,
    "place": place,
    "coupling": coupling,
    "rows": rows,
    "rope": rope,
    "inline": pin_in_slot,
}

"""Forces: generalised forces and potential energies, from docs/file-format."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

import numpy as np

from benchmarks.plain.bodies import GROUND, Marker, State
from benchmarks.plain.elements import Load, Measure, Parts
from benchmarks.plain.formulas import Tree, value
from benchmarks.plain.joints_plane import angle, part
from benchmarks.plain.joints_space import coordinate
from benchmarks.plain.moving import Array, Moving, dot, length
from benchmarks.plain.series import Number, Series, lift, plain

Table = Mapping[str, Any]
Force = Callable[[State], Load]


def names(parts: Parts, s: State, **own: Number) -> dict[str, Number]:
    """Return what the names in a formula of time and state stand for."""
    names: dict[str, Number] = {**parts.document.parameters, "t": s.t, **own}
    for body in parts.bodies.values():
        names |= dict(zip(body.coordinates, s.q[body.first_q :].tolist(), strict=False))
        names |= dict(zip(body.speeds, s.v[body.first_v :].tolist(), strict=False))
    return names


def of_state(parts: Parts, tree: Tree, s: State, **own: Number) -> float:
    """Return the value of a formula of time and state."""
    return plain(value(tree, names(parts, s, **own), parts.document.tables))


def potential(parts: Parts, tree: Tree, word: str, at: float) -> Series:
    """Return a potential with its derivative with respect to its own coordinate."""
    return lift(value(tree, {**parts.document.parameters, word: Series(at, 1.0)}))


def along(parts: Parts, measure: Measure, table: Table, word: str, magnitude: str) -> Force:
    """Return a spring, a damper, a potential and an effort along a measure."""
    number, formula = parts.document.number, parts.document.formula
    k, c = number(table.get("stiffness", 0.0)), number(table.get("damping", 0.0))
    free = number(table.get(f"free_{word}", 0.0))
    effort, energy = formula(table.get(magnitude, 0.0)), formula(table.get("potential", 0.0))

    def load(s: State) -> Load:
        x = measure(s)
        at, rate = float(x.value), float(x.rate)
        own = potential(parts, energy, word, at)
        own_words = {word: at, "rate": rate}
        pushed = of_state(parts, effort, s, **own_words) - c * rate
        return Load(
            -(k * (at - free) + own.first) * x.gradient,
            pushed * x.gradient,
            0.5 * k * (at - free) ** 2 + own.value,
        )

    return load


def spring_damper(parts: Parts, name: str, table: Table) -> Force:
    """Along the line between two points."""
    a, b = parts.ends(table)
    return along(parts, lambda s: length(s.between(a, b)), table, "length", "actuator")


def torsional(parts: Parts, name: str, table: Table) -> Force:
    """Along the angle between two bodies, in space along that of a joint."""
    if parts.document.spatial:
        measure = coordinate(parts, table["joint"], table.get("coordinate"), "rad")
    else:
        measure = angle(*table["between"])
    return along(parts, measure, table, "angle", "actuator")


def torque(parts: Parts, name: str, table: Table) -> Force:
    """Turn a body and turn another one back, or work along the angle of a joint."""
    if "joint" in table:
        measure = coordinate(parts, table["joint"], table.get("coordinate"), "rad")
        return along(parts, measure, table, "angle", "torque")
    body, reaction = table["body"], table.get("reaction", GROUND)
    if not parts.document.spatial:
        return along(parts, angle(reaction, body), table, "angle", "torque")
    trees = [parts.document.formula(x) for x in table["torque"]]
    turns = table.get("frame", "ground") == "body"

    def load(s: State) -> Load:
        vector = np.array([of_state(parts, tree, s) for tree in trees])
        if turns:
            vector = s.matrix(body) @ vector
        work = s.spin(body).gradient - s.spin(reaction).gradient
        return Load(np.zeros(s.nv), vector @ work, 0.0)

    return load


def force(parts: Parts, name: str, table: Table) -> Force:
    """Push a point of a body, by components or by a potential of the point's coordinates."""
    body, d = table["body"], parts.document.dimension
    point = parts.marker(body, table.get("at", "centre"))
    if "potential" in table:
        trees = [parts.document.formula(x) for x in table["potential"]]
        origin = Marker(GROUND, np.zeros(d))

        def conservative(s: State) -> Load:
            total, energy = np.zeros(s.nv), 0.0
            for i, tree in enumerate(trees):
                x = part(origin, point, i)(s)
                own = potential(parts, tree, "xyz"[i], float(x.value))
                total, energy = total - own.first * x.gradient, energy + own.value
            return Load(total, np.zeros(s.nv), energy)

        return conservative
    trees = [parts.document.formula(x) for x in table["force"]]
    turns = table.get("frame", "ground") == "body"

    def load(s: State) -> Load:
        vector = np.array([of_state(parts, tree, s) for tree in trees])
        if turns:
            vector = s.matrix(body) @ vector
        return Load(np.zeros(s.nv), vector @ s.point(point).gradient, 0.0)

    return load


def bushing(parts: Parts, name: str, table: Table) -> Force:
    """Six springs and dampers between two frames."""
    a, b = table["between"]
    of_a, of_b = parts.triads(a, b, table.get("axis", [0.0, 0.0, 1.0]), table.get("reference"))
    ends = parts.ends(table)
    k, c = (_matrix(parts, table.get(key)) for key in ("stiffness", "damping"))
    u, v = list(of_a), list(of_b)

    def displacements(s: State) -> list[Moving]:
        slid = [dot(s.along(axis), s.between(*ends)) for axis in u]
        lean = [[dot(s.along(x), s.along(y)) for y in v] for x in u]
        # half the vector of R - R^T of the matrix R with the entries u_i . v_j
        twisted = [(lean[2][1] - lean[1][2]), (lean[0][2] - lean[2][0]), (lean[1][0] - lean[0][1])]
        return slid + [x.times(0.5) for x in twisted]

    def load(s: State) -> Load:
        places = displacements(s)
        x, rate = np.array([m.value for m in places]), np.array([m.rate for m in places])
        gradient = np.stack([m.gradient for m in places])
        return Load(-(k @ x) @ gradient, -(c @ rate) @ gradient, float(0.5 * x @ k @ x))

    return load


def _matrix(parts: Parts, value: Any) -> Array:
    if value is None:
        return np.zeros((6, 6))
    matrix = parts.document.array(value)
    return np.diag(matrix) if matrix.ndim == 1 else matrix


KINDS: dict[str, Callable[[Parts, str, Table], Force]] = {
    "force": force,
    "torque": torque,
    "spring-damper": spring_damper,
    "torsional-spring-damper": torsional,
    "bushing": bushing,
}

"""The equations of a mechanism as SymPy's expressions, by another route than the pipeline's, for references.

Positions of points are written out in the coordinates, and SymPy differentiates the whole constraints with respect to
them; nothing of `formulate`, `lower` or the emitted code is used but the translation of a file's formulas. In space
Euler parameters are coordinates like any others: the velocities are their rates, there is no angular velocity in the
equations, |e| = 1 is a constraint row beside the joints', the rotation matrix has its inhomogeneous form
1 - 2 (e2^2 + e3^2), and the inertia terms come from the kinetic energy as Lagrange's equations say.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import sympy as sp

from symgen.base.vocabulary.expressions import ZERO, Expr, Reading, names_in_expression, readings_in
from symgen.base.vocabulary.measures import (
    GROUND,
    Angle,
    Bearing,
    BladeSpeed,
    Carrying,
    Component,
    Direction,
    Distance,
    Dot,
    Driven,
    Effort,
    Exerted,
    Flexed,
    FormulaMeasure,
    FormulaSpeed,
    HalfSquare,
    Holonomic,
    Integral,
    LinkStretch,
    Marker,
    Measure,
    Nonholonomic,
    PointSpeed,
    RimHeight,
    Speed,
    SphereSlip,
    Spin,
    Sum,
    Turn,
)
from symgen.derive.formulate.translate import to_sympy
from symgen.describe.mechanism import Mechanism, SpatialBody

#: Phi, the entries of D by column, nu and gamma of a row.
Row = tuple[Any, dict[int, Any], Any, Any]
#: Entries of an inertia tensor, in the order of the file: xx, yy, zz, xy, xz, yz.
TENSOR = ((0, 3, 4), (3, 1, 5), (4, 5, 2))


class ReferenceFormulas:
    """Rows and forces of a mechanism.

    Parameters
    ----------
    mechanism : Mechanism
        A validated mechanism.
    parameters : mapping
        Number or symbol of each parameter.

    Attributes
    ----------
    t, q, v, z
        Symbols of the time, the coordinates and their rates, and the states that the file defines.
    first : dict
        Index of the first coordinate of each body.
    angles, turns : list
        Angles that count whole turns, and the symbols of these.
    """

    def __init__(self, mechanism: Mechanism, parameters: Mapping[str, Any]) -> None:
        self.mechanism = mechanism
        self.t = sp.Symbol("t", real=True)
        self.q, self.v = list[Any](), list[Any]()
        self.first: dict[str, int] = {}
        self.angles, self.turns = list[Any](), list[Any]()
        self._symbols: dict[str, Any] = {"t": self.t, **parameters}
        for body in mechanism.bodies:
            i = self.first[body.name] = len(self.q)
            for name in body.coordinates:
                self.q.append(sp.Symbol(f"q{len(self.q)}", real=True))
                self.v.append(sp.Symbol(f"v{len(self.v)}", real=True))
                self._symbols[f"{body.name}.{name}"] = self.q[-1]
            rates = self.v[i:]
            if _turns_in_space(body):
                rates = [*rates[:3], *angular_velocity(self.q[i + 3 :], rates[3:])]
            self._symbols |= {f"{body.name}.{name}": rate for name, rate in zip(body.speeds, rates, strict=True)}
        self.z = [sp.Symbol(f"z{i}", real=True) for i in range(len(mechanism.states))]
        self._symbols |= {state.name: z for state, z in zip(mechanism.states, self.z, strict=True)}

    def rows(self) -> list[Row]:
        """Return the rows of joints, and one for the length of each body's Euler parameters."""
        rows = [self._row_expressions(row) for joint in self.mechanism.joints for row in joint.rows]
        for body in self.mechanism.bodies:
            if _turns_in_space(body):
                i = self.first[body.name] + 3
                e, rates = self.q[i : i + 4], self.v[i : i + 4]
                phi = (sum((x**2 for x in e), sp.S.Zero) - 1) / 2
                gamma = -sum((x**2 for x in rates), sp.S.Zero)
                rows.append((phi, {i + k: e[k] for k in range(4)}, sp.S.Zero, gamma))
        return rows

    def forces(self) -> list[Any]:
        """Return the generalised forces by coordinate, with the inertia terms free of accelerations."""
        total = [sp.S.Zero] * len(self.q)
        for body in self.mechanism.bodies:
            i = self.first[body.name]
            for k, gravity in enumerate(self.mechanism.gravity):
                total[i + k] += self._to_expression(body.mass) * self._to_expression(gravity)
            if isinstance(body, SpatialBody) and body.inertia is not None:
                entries = [self._to_expression(e) for e in body.inertia]
                tensor = sp.Matrix([[entries[k] for k in line] for line in TENSOR])
                for k, term in enumerate(_gyroscopic_terms(tensor, self.q[i + 3 : i + 7], self.v[i + 3 : i + 7])):
                    total[i + 3 + k] += term
        for force in self.mechanism.forces:
            for effort in force.efforts:
                for i, e in self._force_of_effort(effort).items():
                    total[i] += e
        for kinetic in self._rotor_energies():
            for i, (q, v) in enumerate(zip(self.q, self.v, strict=True)):
                total[i] += sp.diff(kinetic, q) - self._derivative_along_motion(sp.diff(kinetic, v))
        return total

    def state_rates(self) -> list[Any]:
        """Return the rates of the states that the file defines."""
        return [self._to_expression(state.rate) for state in self.mechanism.states]

    def rotor_masses(self) -> dict[tuple[int, int], Any]:
        """Return what rotors add to the mass matrix, by row and column: second derivatives of their energies."""
        masses = dict[tuple[int, int], Any]()
        for kinetic in self._rotor_energies():
            for i, momentum in self._derivatives_by_rates(kinetic).items():
                for j, mass in self._derivatives_by_rates(momentum).items():
                    masses[i, j] = masses.get((i, j), sp.S.Zero) + mass
        return masses

    def _rotor_energies(self) -> list[Any]:
        """Return the kinetic energy of each rotor."""
        rotors = self.mechanism.rotors
        return [
            self._to_expression(x.inertia) * self._derivative_along_motion(self._measure_expression(x.angle)) ** 2 / 2
            for x in rotors
        ]

    def _to_expression(self, e: Expr, **placeholders: object) -> Any:
        measured = {r.name: self._reading_expression(r) for r in readings_in(e)}
        return to_sympy(e, {**self._symbols, **measured, **placeholders})

    def _reading_expression(self, r: Reading) -> Any:
        """Return a measure's value, or its rate."""
        assert not isinstance(r.source, Exerted | Driven | Carrying | Integral | Flexed), (
            "functions of state read motions"
        )
        if isinstance(r.source, Speed):
            return self._speed_expression(r.source)
        value = self._measure_expression(r.source)
        return self._derivative_along_motion(value) if r.order else value

    def _force_of_effort(self, effort: Effort) -> dict[int, Any]:
        measure = effort.measure
        reads = effort.potential != ZERO and "s" in set(names_in_expression(effort.potential))
        if isinstance(measure, Spin | Speed):
            assert not reads, "velocities have no value"
            rate = self._relative_spin(measure) if isinstance(measure, Spin) else self._speed_expression(measure)
            total = self._to_expression(effort.magnitude, s=sp.S.Zero, rate=rate)
            return {i: e * total for i, e in self._derivatives_by_rates(rate).items()}
        value = self._measure_expression(measure)
        total = self._to_expression(effort.magnitude, s=value, rate=self._derivative_along_motion(value))
        if reads:
            s = sp.Symbol("s", real=True)
            total -= sp.diff(self._to_expression(effort.potential, s=s), s).subs(s, value)
        return {i: e * total for i, e in self._gradient_entries(value).items()}

    # -- rows ----------------------------------------------------------------------------------------------------------

    def _gradient_entries(self, s: Any) -> dict[int, Any]:
        free = s.free_symbols
        entries = {i: sp.diff(s, symbol) for i, symbol in enumerate(self.q) if symbol in free}
        return {i: e for i, e in entries.items() if e != 0}

    def _derivatives_by_rates(self, speed: Any) -> dict[int, Any]:
        """Return the derivatives of an expression by the rates: the coefficients where it is linear in them."""
        free = speed.free_symbols
        entries = {i: sp.diff(speed, v) for i, v in enumerate(self.v) if v in free}
        return {i: e for i, e in entries.items() if e != 0}

    def _derivative_along_motion(self, e: object) -> Any:
        """Return the derivative of a function of q along the motion."""
        return sum((d * self.v[i] for i, d in self._gradient_entries(e).items()), sp.S.Zero)

    def _row_expressions(self, row: Holonomic | Nonholonomic) -> Row:
        value = self._to_expression(row.value)
        slope = sp.diff(value, self.t)
        if isinstance(row, Holonomic):
            s = self._measure_expression(row.measure)
            gradient = self._gradient_entries(s)
            bias = sum((self._derivative_along_motion(e) * self.v[i] for i, e in gradient.items()), sp.S.Zero)
            slope = slope - sp.diff(s, self.t)
            return s - value, gradient, slope, sp.diff(slope, self.t) + 2 * self._derivative_along_motion(slope) - bias
        speed = self._speed_expression(row.speed)
        at_rest = speed.subs(dict.fromkeys(self.v, sp.S.Zero))
        gamma = slope - sp.diff(speed, self.t) - self._derivative_along_motion(speed)
        return sp.S.Zero, self._derivatives_by_rates(speed), value - at_rest, gamma

    # -- positions -----------------------------------------------------------------------------------------------------

    def _turn_to_ground(self, body: str, vector: sp.Matrix) -> sp.Matrix:
        """Return a vector of the body frame in the ground frame."""
        if body == GROUND or self.mechanism.body(body).is_point:
            return vector
        i = self.first[body]
        if len(vector) == 2:
            c, s = sp.cos(self.q[i + 2]), sp.sin(self.q[i + 2])
            return sp.Matrix([[c, -s], [s, c]]) * vector
        a, b, c, d = self.q[i + 3 : i + 7]
        matrix = sp.Matrix(
            [
                [1 - 2 * (c**2 + d**2), 2 * (b * c - a * d), 2 * (b * d + a * c)],
                [2 * (b * c + a * d), 1 - 2 * (b**2 + d**2), 2 * (c * d - a * b)],
                [2 * (b * d - a * c), 2 * (c * d + a * b), 1 - 2 * (b**2 + c**2)],
            ]
        )
        return matrix * vector

    def _vector_expressions(self, components: tuple[Expr, ...]) -> sp.Matrix:
        return sp.Matrix([self._to_expression(e) for e in components])

    def _place_of_marker(self, marker: Marker) -> sp.Matrix:
        point = self._vector_expressions(marker.point)
        if marker.body == GROUND:
            return point
        centre, i = self._vector_expressions(self.mechanism.body(marker.body).centre_of_mass), self.first[marker.body]
        return sp.Matrix(self.q[i : i + len(point)]) + self._turn_to_ground(marker.body, point - centre)

    def _direction_in_ground(self, direction: Direction) -> sp.Matrix:
        return self._turn_to_ground(direction.body, self._vector_expressions(direction.vector))

    def _measure_expression(self, m: Measure) -> Any:
        if isinstance(m, FormulaMeasure):
            return self._to_expression(m.of)
        if isinstance(m, Angle):
            a, b = (sp.S.Zero if body == GROUND else self.q[self.first[body] + 2] for body in (m.a, m.b))
            return b - a
        if isinstance(m, Component | Distance | HalfSquare | LinkStretch):
            away = self._place_of_marker(m.b) - self._place_of_marker(m.a)
            if isinstance(m, Component):
                return self._direction_in_ground(m.along).dot(away)
            if isinstance(m, Distance):
                return sp.sqrt(away.dot(away))
            if isinstance(m, HalfSquare):
                return away.dot(away) / 2
            length = self._to_expression(m.length)
            return (away.dot(away) - length**2) / (2 * length)
        if isinstance(m, Dot):
            return self._direction_in_ground(m.u).dot(self._direction_in_ground(m.v))
        if isinstance(m, Turn):
            return self._angle_expression(self._direction_in_ground(m.pointer), m.zero, m.quarter)
        if isinstance(m, Bearing):
            return self._angle_expression(self._place_of_marker(m.b) - self._place_of_marker(m.a), m.zero, m.quarter)
        if isinstance(m, RimHeight):
            normal, axis = self._direction_in_ground(m.normal), self._direction_in_ground(m.axis)
            height = normal.dot(self._place_of_marker(m.centre) - self._place_of_marker(m.plane))
            return height - self._to_expression(m.radius) * sp.sqrt(1 - normal.dot(axis) ** 2)
        assert isinstance(m, Sum), f"no such measure: {type(m).__name__}"
        return sum((self._to_expression(k) * self._measure_expression(part) for k, part in m.terms), sp.S.Zero)

    def _angle_expression(self, pointer: sp.Matrix, zero: Direction, quarter: Direction) -> Any:
        """Return an angle about the axis zero x quarter, plus the whole turns that are counted beside it."""
        angle = sp.atan2(pointer.dot(self._direction_in_ground(quarter)), pointer.dot(self._direction_in_ground(zero)))
        if angle not in self.angles:
            self.angles.append(angle)
            self.turns.append(sp.Symbol(f"n{len(self.angles)}", real=True))
        return angle + 2 * sp.pi.evalf(17) * self.turns[self.angles.index(angle)]

    # -- speeds --------------------------------------------------------------------------------------------------------

    def _omega_of_body(self, body: str) -> sp.Matrix:
        """Return the angular velocity in ground axes."""
        if body == GROUND or self.mechanism.body(body).is_point:
            return sp.zeros(3, 1)
        i = self.first[body] + 3
        return self._turn_to_ground(body, sp.Matrix(angular_velocity(self.q[i : i + 4], self.v[i : i + 4])))

    def _relative_spin(self, m: Spin) -> Any:
        return self._direction_in_ground(m.along).dot(self._omega_of_body(m.b) - self._omega_of_body(m.a))

    def _velocity_of_marker(self, marker: Marker) -> sp.Matrix:
        return sp.Matrix([self._derivative_along_motion(x) for x in self._place_of_marker(marker)])

    def _slip_of_spheres(self, slip: SphereSlip) -> Any:
        """Return the velocity of one sphere along another: of both points that touch, along a turned direction."""
        away = self._place_of_marker(slip.b) - self._place_of_marker(slip.a)
        normal = self._to_expression(slip.side) * away / sp.sqrt(away.dot(away))
        zero, along = self._direction_in_ground(slip.zero), self._direction_in_ground(slip.along)
        tangent = along - along.dot(normal) / (1 + zero.dot(normal)) * (zero + normal)
        touching = sp.zeros(3, 1)
        for marker, radius, sign in ((slip.b, slip.radii[1], -1), (slip.a, slip.radii[0], 1)):
            arm = sign * self._to_expression(radius) * normal
            velocity = self._velocity_of_marker(marker) + self._omega_of_body(marker.body).cross(arm)
            touching -= sign * velocity
        return tangent.dot(touching)

    def _speed_expression(self, speed: Speed) -> Any:
        if isinstance(speed, FormulaSpeed):
            return self._to_expression(speed.of)
        if isinstance(speed, PointSpeed):
            return self._direction_in_ground(speed.along).dot(self._velocity_of_marker(speed.at))
        if isinstance(speed, BladeSpeed):
            across = self._direction_in_ground(speed.normal).cross(self._direction_in_ground(speed.blade))
            return self._velocity_of_marker(speed.at).dot(across) / sp.sqrt(across.dot(across))
        if isinstance(speed, SphereSlip):
            return self._slip_of_spheres(speed)
        along, down = self._direction_in_ground(speed.along), -self._direction_in_ground(speed.normal)
        if speed.axis is not None:  # a thin disc touches with its lowest point
            axis = self._direction_in_ground(speed.axis)
            down = down - axis.dot(down) * axis
            down = down / sp.sqrt(down.dot(down))
        arm, plane = self._to_expression(speed.radius) * down, speed.normal.body
        velocity = self._velocity_of_marker(speed.centre) + self._omega_of_body(speed.centre.body).cross(arm)
        if plane != GROUND:  # the point of the plane's body that touches
            origin = Marker(plane, self.mechanism.body(plane).centre_of_mass)
            away = self._place_of_marker(speed.centre) + arm - self._place_of_marker(origin)
            velocity -= self._velocity_of_marker(origin) + self._omega_of_body(plane).cross(away)
        return along.dot(velocity)


def _turns_in_space(body: object) -> bool:
    return isinstance(body, SpatialBody) and not body.is_point


def angular_velocity(e: list[Any], rates: list[Any]) -> list[Any]:
    """Return omega = 2 L(e) e' in body axes."""
    a, b, c, d = e
    p, q, r, s = rates
    return [
        2 * (-b * p + a * q + d * r - c * s),
        2 * (-c * p - d * q + a * r + b * s),
        2 * (-d * p + c * q - b * r + a * s),
    ]


def _gyroscopic_terms(tensor: sp.Matrix, e: list[Any], rates: list[Any]) -> list[Any]:
    """Return dT/de - (d/dt dT/de' without e'') of the rotational energy T."""
    omega = sp.Matrix(angular_velocity(e, rates))
    kinetic = (omega.T * tensor * omega)[0] / 2
    terms = []
    for k in range(4):
        momentum = sp.diff(kinetic, rates[k])
        along = sum((sp.diff(momentum, e[j]) * rates[j] for j in range(4)), sp.S.Zero)
        terms.append(sp.diff(kinetic, e[k]) - along)
    return terms

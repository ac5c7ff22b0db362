"""Quantities that formulas read by dotted names: of points of bodies, joints, forces and drivers.

| written | is | where |
| --- | --- | --- |
| ``arm.tip.x``, ``.y``, in space ``.z`` | a point's coordinate in the ground frame [m] | everywhere |
| ``arm.tip.vx``, ``.vy``, ``.vz`` | its velocity [m/s] | everywhere |
| ``arm.tip.ax``, ``.ay``, ``.az`` | its acceleration [m/s^2] | outputs |
| ``arm.tip.theta``, ``.omega`` | in the plane, angle of an interface of a modal body and its rate | everywhere |
| ``arm.sigma`` | a row of the file of a modal body, such as a stress | everywhere |
| ``arm.ex.x`` ..., ``arm.ez.z`` | in space, component of an axis of a body's frame in the ground frame | everywhere |
| ``arm.ex.vx`` ..., ``arm.ez.vz`` | its rate [1/s] | everywhere |
| ``motor.angle``, ``slide.displacement``, ... | a coordinate that a joint reports, or a driver drives | everywhere |
| ``motor.angle.rate``, ``motor.rate`` | its rate; the short form where there is one coordinate | everywhere |
| ``motor.effort``, ``motor.power`` | what a driver exerts along its coordinate | outputs |
| ``pin.F``, ``pin.Fx``, ``.Fy``, ``.Fz`` | a joint's reaction on its first body: size, components | outputs |
| ``rod.tension``, ``rod.F``, ``rod.Fx`` ... | of `distance` joints: its pull, and its force as of pins | outputs |
| ``rope.tension`` | of ropes that keep their length | outputs |
| ``spring.length``, ``.angle``, ``.rate`` | of a force along one measure | outputs, events |
| ``rod.e3.strain``, ``.shear``, ``.curvature`` | of a beam element in its middle | outputs, events |
| ``rod.e3.N``, ``.Q``, ``.M`` | force and moment of the section there | outputs, events |
| ``spring.force``, ``.torque``, ``.Fx`` ..., ``.power`` | what a force exerts | outputs |
| ``pin.dissipated``, ``pin.lower.dissipated`` | energy that a row with bounds takes | outputs |
| ``belt.driven`` | energy that the drive of a surface gives, but for impacts | outputs |
| ``pin.dissipated.rate``, ``belt.driven.rate`` | the power of that | outputs |

Rates of states read what is for outputs but integrals: no force can read a rate, so that no circle closes.

`symgen.describe.formulas.reported_columns` makes columns of results from the same table.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING

from symgen.base.vocabulary.expressions import (
    ZERO,
    Call,
    Expr,
    Name,
    Reading,
    call,
    literal_of,
    moving_quantities,
    readings_in,
    sum_of_terms,
)
from symgen.base.vocabulary.measures import (
    GROUND,
    Angle,
    AnyAngle,
    Component,
    Direction,
    Distance,
    Dot,
    Driven,
    Effort,
    Exerted,
    Flexed,
    Flexure,
    FormulaMeasure,
    HalfSquare,
    Holonomic,
    Integral,
    Marker,
    Source,
    Spin,
    Sum,
    axes,
)
from symgen.describe.coordinate_names import ACCELERATIONS
from symgen.describe.formulas.reaction_readings import REACTION, Table, readings_of_reaction
from symgen.describe.mechanism import AnyBody, Force, Joint
from symgen.describe.modal_body import COORDINATE, Modal, ModalRow, names_of_modes

if TYPE_CHECKING:
    from symgen.describe.parts.context import Context


#: Prefixes of a point's coordinates, by the order of the derivative, and their units.
ORDERS = {"": "m", "v": "m/s", "a": "m/s^2"}
#: Largest order in functions of state, and in outputs, where v' and efforts are available.
STATE, OUTPUT = 1, 2

#: Ending of the name of a rate.
RATE = ".rate"
#: Axes of a body's frame in space.
AXES = ("ex", "ey", "ez")
#: Components of the strain of a beam element, and of force and moment, in the plane and in space.
PLANE = ("strain", "shear", "curvature"), ("N", "Q", "M")
SPACE = (
    ("strain", "shear_y", "shear_z", "twist", "curvature_y", "curvature_z"),
    ("N", "Qy", "Qz", "T", "My", "Mz"),
)


def readings_of_point(name: str, marker: Marker, dimension: int, order: int) -> Table:
    """Return a point's coordinates and their derivatives up to an order; `name` is the point's with its body's."""
    origin, table = Marker(GROUND, (ZERO,) * dimension), Table()
    for derivative, (letter, unit) in enumerate(list(ORDERS.items())[: order + 1]):
        for axis, direction in zip("xyz", axes(GROUND, dimension), strict=False):
            label = f"{letter}{axis}"
            table[label] = Reading(f"{name}.{label}", Component(origin, marker, direction), derivative), unit
    return table


def readings_of_interface(body: AnyBody, dimension: int, order: int) -> Table:
    """Return the coordinates of the origin of an interface, and in the plane its angle, with their derivatives."""
    table = readings_of_point(body.name, Marker(body.name, (ZERO,) * dimension), dimension, order)
    if dimension == 2:
        angle = Angle(GROUND, body.name)
        table["theta"] = Reading(f"{body.name}.theta", angle), "rad"
        table["omega"] = Reading(f"{body.name}.omega", angle, 1), "rad/s"
        if order == OUTPUT:
            table["alpha"] = Reading(f"{body.name}.alpha", angle, 2), "rad/s^2"
    return table


def row_formula(body: str, row: ModalRow) -> Expr:
    """Return a row of the file of a modal body as a formula of the coordinates of its modes."""
    names = names_of_modes(COORDINATE, len(row.factors))
    terms = (call("mul", literal_of(x), Name(f"{body}.{m}")) for x, m in zip(row.factors, names, strict=True))
    return sum_of_terms(*terms)


def readings_of_rows(body: str, modal: Modal) -> Table:
    """Return the rows of the file of a modal body."""
    return {row.label: (row_formula(body, row), row.unit) for row in modal.rows}


def readings_of_axis(name: str, axis: Direction) -> Table:
    """Return the components of an axis of a body in the ground frame, and their rates; `name` is the axis' own."""
    table = Table()
    for letter, direction in zip("xyz", axes(GROUND, 3), strict=True):
        table[letter] = Reading(f"{name}.{letter}", Dot(direction, axis)), ""
        table[f"v{letter}"] = Reading(f"{name}.v{letter}", Dot(direction, axis), 1), "1/s"
    return table


def readings_of_joint(joint: Joint, order: int) -> Table:
    """Return the coordinates of a joint with their rates; of a driver, its driven coordinate and its effort."""
    row = joint.rows[0] if joint.kind == "driver" else None
    coordinates = joint.coordinates
    if isinstance(row, Holonomic) and not coordinates:
        coordinates = (("angle" if row.unit == "rad" else "displacement", row.measure),)
    table = Table()
    for label, measure in coordinates:
        unit = joint.unit(label)
        table |= _value_and_rate(joint.name, label, measure, unit)
        if len(coordinates) == 1:
            table["rate"] = Reading(f"{joint.name}.rate", measure, 1), f"{unit}/s"
    if order == OUTPUT and row is None:
        table |= readings_of_reaction(joint)
    if isinstance(row, Holonomic) and order == OUTPUT:
        driven = Driven(f"{joint.name}.{row.label}", row.measure)
        table["effort"] = Reading(f"{joint.name}.effort", driven), "N m" if row.unit == "rad" else "N"
        table["power"] = Reading(f"{joint.name}.power", Driven(driven.row, driven.measure, power=True)), "W"
    return table


def readings_of_force(force: Force, order: int) -> Table:
    """Return the measure of a force along one measure, and at outputs its effort."""
    table, name = Table(), force.name
    efforts = tuple(map(_effort_along_length, force.efforts))
    single = efforts[0] if len(efforts) == 1 else None
    word = "" if single is None else _name_of_measure(single.measure)
    if single is not None and word:
        unit = "m" if word == "length" else "rad"
        table[word] = Reading(f"{name}.{word}", single.measure), unit
        table["rate"] = Reading(f"{name}.rate", single.measure, 1), f"{unit}/s"
    for flexure in force.flexures:
        table |= _readings_of_flexure(name, flexure)
    if order == OUTPUT and (efforts or force.flexures):
        components: dict[str, list[Effort]] = {}
        for effort in efforts:
            for component in _names_of_components(effort, word):
                components.setdefault(component, []).append(effort)
        for component, parts in components.items():
            unit = "N m" if is_turning(parts[0].measure) else "N"
            table[component] = Reading(f"{name}.{component}", Exerted(tuple(parts))), unit
        table["power"] = Reading(f"{name}.power", Exerted(efforts, True, force.flexures)), "W"
    return table


def _readings_of_flexure(name: str, flexure: Flexure) -> Table:
    """Return the strain in the middle of a beam element, and the force and moment of the section there."""
    strains, stresses = PLANE if len(flexure.compliances) == 3 else SPACE
    bends = len(strains) // 2
    table = Table()
    for stress, labels, units in ((False, strains, ("", "1/m")), (True, stresses, ("N", "N m"))):
        for i, label in enumerate(labels):
            unit = units[i > bends] if len(labels) == 3 else units[i >= bends]
            table[label] = Reading(f"{name}.{label}", Flexed(flexure, i, stress)), unit
    return table


def _value_and_rate(owner: str, label: str, measure: Source, unit: str) -> Table:
    name = f"{owner}.{label}"
    return {label: (Reading(name, measure), unit), f"{label}.rate": (Reading(f"{name}.rate", measure, 1), f"{unit}/s")}


def _effort_along_length(effort: Effort) -> Effort:
    """Return an effort along half the square of a length, U = k s, as one along the length, U = k s^2 / 2."""
    if not isinstance(effort.measure, HalfSquare) or not isinstance(effort.potential, Call):
        return effort
    half, stiffness = Reading("half", effort.measure), effort.potential.arguments[0]
    length = FormulaMeasure(call("sqrt", call("mul", literal_of(2.0), half)))
    squared = call("pow", Name("s"), literal_of(2.0))
    return Effort(effort.label, length, potential=call("mul", call("div", stiffness, literal_of(2.0)), squared))


def _name_of_measure(measure: Source) -> str:
    """Return the name of the measure of a force, empty where it has none."""
    return (
        "length" if isinstance(measure, Distance | FormulaMeasure) else "angle" if isinstance(measure, AnyAngle) else ""
    )


def _names_of_components(effort: Effort, extent: str) -> list[str]:
    """Return names of the total of an effort: force or torque along a measure, or components along axes."""
    if not effort.label:
        return []
    if extent:
        return ["force" if extent == "length" else "torque"]
    kind = "M" if is_turning(effort.measure) else "F"
    axes_ = re.findall(r"(turn_)?([xyz])(?![a-z])", effort.label)
    return [("M" if turn else kind) + axis for turn, axis in axes_] or [effort.label]


def is_turning(measure: Source) -> bool:
    """Whether the effort along a measure is a torque."""
    if isinstance(measure, Sum):
        return is_turning(measure.terms[0][1])
    if isinstance(measure, FormulaMeasure):
        return all(is_turning(r.source) for r in readings_in(measure.of))
    return isinstance(measure, AnyAngle | Spin | Dot)


def is_angle(of: Expr) -> bool:
    """Whether all moving quantities in a formula are angles and axes."""
    turning = (
        is_turning(e.source) if isinstance(e, Reading) else e.name.rpartition(".")[2][0] in ("t", "o", "w")
        for e in moving_quantities(of)
    )
    return all(turning)


class Readings:
    """The dotted names of a mechanism, looked up one by one: a file may have thousands of bodies.

    Parameters
    ----------
    context : Context
        Facts about the mechanism.
    order : int
        `STATE`, or `OUTPUT` where v' and efforts are available.
    """

    def __init__(self, context: Context, order: int = STATE) -> None:
        self._context, self._order = context, order
        self._dimension = 3 if context.space == "spatial" else 2

    @property
    def _losses(self) -> Mapping[str, Expr]:
        return self._context.losses if self._order == OUTPUT else {}

    def names_of_owners(self) -> Iterator[str]:
        """Yield the names of all bodies, joints, forces and rows with bounds that have readings."""
        yield from self._context.bodies
        yield from self._context.joint_names
        yield from self._context.forces
        yield from (name.partition(".")[0] for name in self._losses)

    def has_force(self, name: str) -> bool:
        """Return whether a force has this name."""
        return name in self._context.forces

    def speeds_of(self, owner: str) -> tuple[str, ...]:
        """Return the velocities of a body; none of what is no body."""
        body = self._context.bodies.get(owner)
        return () if body is None else body.speeds

    def accelerations_of(self, owner: str) -> tuple[str, ...]:
        """Return the accelerations of a body; none of what is no body."""
        return tuple(ACCELERATIONS[speed] for speed in self.speeds_of(owner))

    def names_of(self, owner: str, where: str) -> tuple[str, ...]:
        """Return the readings of a body, joint or force besides a body's own coordinates."""
        if owner in self._context.bodies:
            own = self._body_readings(self._context.bodies[owner])
            points = self._context.points[owner]
            return (*own, *(f"{p}.{label}" for p in points for label in self._point_readings(owner, p)))
        lost = (name.partition(".") for loss in self._losses for name in (loss, loss + RATE))
        return (*self._element_readings(owner, where), *(label for head, _, label in lost if head == owner))

    def find_meaning(self, path: tuple[str, ...], where: str) -> Expr | None:
        """Return the meaning of a dotted name, None where it has none.

        Parameters
        ----------
        path : tuple of str
            The name, cut at its dots; the first part is an owner.
        where : str
            File and key, for messages about joints that are resolved on the way.
        """
        entry = self.meaning_with_unit(path, where)
        return None if entry is None else entry[0]

    def meaning_with_unit(self, path: tuple[str, ...], where: str) -> tuple[Expr, str] | None:
        """Return the meaning of a dotted name, see `find_meaning`, with its unit."""
        owner, *words = path
        if (name := ".".join(path)) in self._losses:
            return self._losses[name], "J"
        if name.endswith(RATE) and name.removesuffix(RATE) in self._losses:
            return integrand_of(self._losses[name.removesuffix(RATE)]), "W"
        if owner not in self._context.bodies:
            return self._element_readings(owner, where).get(".".join(words))
        if len(words) == 1 and (meaning := self._body_readings(self._context.bodies[owner]).get(words[0])) is not None:
            return meaning
        if len(words) == 2 and words[0] in self._context.points[owner]:
            return self._point_readings(owner, words[0]).get(words[1])
        if len(words) == 2 and words[0] in AXES and self._dimension == 3 and not self._context.bodies[owner].is_point:
            axis = axes(owner, 3)[AXES.index(words[0])]
            return readings_of_axis(f"{owner}.{words[0]}", axis).get(words[1])
        return None

    def _point_readings(self, body: str, point: str) -> Table:
        marker = Marker(body, self._context.points[body][point])
        return readings_of_point(f"{body}.{point}", marker, self._dimension, self._order)

    def _body_readings(self, body: AnyBody) -> Table:
        """Return what a modal body or an interface has besides coordinates."""
        if body.carried is not None:
            return readings_of_interface(body, self._dimension, self._order)
        return {} if body.modal is None else readings_of_rows(body.name, body.modal)

    def rows_called(self, owner: str, name: str) -> tuple[Expr, ...]:
        """Return all rows of one name that the file of a modal body has."""
        body = self._context.bodies.get(owner)
        rows = () if body is None or body.modal is None else body.modal.rows
        return tuple(row_formula(owner, row) for row in rows if row.name == name)

    def _element_readings(self, owner: str, where: str) -> Table:
        table = Table()
        if owner in self._context.joint_names:
            joint = self._context.joint(owner, where)
            table = readings_of_joint(joint, self._order)
            if any(name.startswith(f"{owner}.") for name in self._losses) and any(
                joint.unit(label) == "m" for label, _ in joint.coordinates
            ):
                # what a row with bounds exerts along the joint is a part of the reaction that its rows do not have
                table = {label: entry for label, entry in table.items() if label not in REACTION}
        # a joint that gives way has a force of its own name
        force = self._context.forces.get(owner)
        return table if force is None else table | readings_of_force(force, self._order)


def integrand_of(loss: Expr) -> Expr:
    """Return the rate of a sum of integrals: the sum of what they integrate."""
    if isinstance(loss, Reading) and isinstance(loss.source, Integral):
        return loss.source.of
    assert isinstance(loss, Call), "a loss is an integral or a sum of them"
    return call(loss.function, *map(integrand_of, loss.arguments))

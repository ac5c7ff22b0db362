"""Symbols of springs, dampers, forces and torques."""

from __future__ import annotations

from contextlib import suppress

import numpy as np

from symgen.base.errors import InputError
from symgen.base.vocabulary.expressions import ZERO, Number, names_in_expression
from symgen.base.vocabulary.measures import (
    Angle,
    Component,
    Distance,
    Effort,
    HalfSquare,
    PointSpeed,
    Spin,
    Sum,
    Turn,
    nested_parts,
)
from symgen.describe.drawing.joint_parts import DRIVE, pivot_and_axis
from symgen.describe.drawing.pen import PLAIN, BodyPoint, Pen, directions_across_axis
from symgen.describe.drawing.scene import GROUNDED, INK, Array, BodyFrame, Item, Line, Look, Mark, Poses
from symgen.describe.mechanism import Force
from symgen.describe.parts.kinds import FORCES

PUSH = Look("#a0522d", "", 1.8)
COIL = Look(INK, "", 1.2)
BENT = Look("#2f5d8a", "", 2.4)


def force_item(pen: Pen, force: Force) -> Item:
    """Return the symbol of a force element; one without points is drawn at its bodies."""
    numbers = pen.numbers
    stretched = [m for m in nested_parts(force.efforts) if isinstance(m, Distance | HalfSquare)]
    turned = [m for m in nested_parts(force.efforts) if isinstance(m, Angle | Turn | Spin)]
    marks: list[Mark]
    if force.flexures:
        marks = _beam_curve(pen, force)
    elif stretched:
        a, b = numbers.place(stretched[0].a), numbers.place(stretched[0].b)
        marks = [pen.stretch(_kind_of_element(pen, force), a, b, COIL), pen.dot(a, 0.2), pen.dot(b, 0.2)]
    elif force.kind == "bushing":
        marks = [pen.dot(place, 0.9, Look(INK, "#9aa7b5", 1.0, 0.4)) for place in numbers.markers(force)[:1]]
    elif force.kind not in FORCES:  # of a row with bounds, whose joint is drawn
        marks = []
    elif turned and force.kind in ("torsional-spring-damper", "torque"):
        marks = _torque_symbol(pen, force)
    else:
        marks = _force_arrow(pen, force)
    return Item("force", force.name, force.kind, tuple(marks))


def _beam_curve(pen: Pen, force: Force) -> list[Mark]:
    """Return the polygon of the cubic curve through the ends of beam elements: along their axes, and between."""
    numbers, marks = pen.numbers, list[Mark]()
    for flexure in force.flexures:
        first = next(m for m in nested_parts(flexure.measures) if isinstance(m, Sum))
        along = [m for _, m in first.terms if isinstance(m, Component)]
        ends = numbers.place(along[0].a), numbers.place(along[0].b)
        third, inner = numbers.number(flexure.length) / 3.0, list[BodyPoint]()
        for place, component, sign in zip(ends, along, (1.0, -1.0), strict=True):
            x, y, z = np.array(place.at) + sign * third * numbers.vector(component.along.vector)
            inner.append(BodyPoint(place.body, (float(x), float(y), float(z))))
            marks.append(Line(place.body, (place.at, inner[-1].at), BENT))
        marks.append(pen.stretch("rod", inner[0], inner[1], BENT))
    return marks


def _kind_of_element(pen: Pen, force: Force) -> str:
    numbers, effort = pen.numbers, force.efforts[0]
    state = {"s": 1.0, "rate": 0.0}
    spring = damper = actuator = False
    with suppress(InputError):
        spring = numbers.value_of_formula(effort.potential, {**state, "s": 1.234}) != numbers.value_of_formula(
            effort.potential, {**state, "s": 2.345}
        )
    if isinstance(effort.magnitude, Number):
        actuator = effort.magnitude != ZERO
    else:
        damper = "rate" in set(names_in_expression(effort.magnitude))
        with suppress(InputError):
            still, moving = (numbers.value_of_formula(effort.magnitude, {**state, "rate": r}) for r in (0.0, 1.0))
            damper, actuator = still != moving, still != 0.0
    if spring or damper:
        return "spring-damper" if spring and damper else "spring" if spring else "damper"
    return "actuator" if actuator else "spring"


def _torque_symbol(pen: Pen, force: Force) -> list[Mark]:
    """Return an arrow about the axis of a torque, or a spiral about the axis of a torsional spring."""
    numbers = pen.numbers
    joints = [j for j in numbers.mechanism.joints if set(j.bodies) == set(force.bodies) and numbers.markers(j.rows)]
    body = next((b for b in force.bodies if b in numbers.index and b != "ground"), force.bodies[0])
    at, axis = BodyPoint(numbers.index[body], (0.0, 0.0, 0.0)), np.array([0.0, 0.0, 1.0])
    if joints:
        at, axis = pivot_and_axis(numbers, joints[0], force.efforts)
    frame = at.body
    if any(isinstance(m, Spin) for _, m in _component_efforts(force)):
        axis, turned = _effort_direction(pen, force)
        frame = pen.add_carried_frame(at, turned)
    if force.kind == "torque":
        return pen.turning_arrow(frame, numbers.in_ground_frame(at), axis, 1.6, DRIVE)
    first, second = directions_across_axis(axis)
    turn = np.linspace(0.0, 5.0 * np.pi, 60)[:, None]
    reach = pen.unit * np.linspace(0.3, 1.5, 60)[:, None]
    return [pen.line(frame, numbers.in_ground_frame(at) + reach * (np.cos(turn) * first + np.sin(turn) * second), COIL)]


def _force_arrow(pen: Pen, force: Force) -> list[Mark]:
    """Return an arrow with its tip where the force acts, along its present value or else along its components."""
    numbers = pen.numbers
    pushed = [
        m.b if isinstance(m, Component) else m.at for _, m in _component_efforts(force) if not isinstance(m, Spin)
    ]
    if not pushed:
        return [pen.dot(place, 0.35, PLAIN) for place in numbers.markers(force)]
    at = numbers.place(pushed[-1])
    way, turned = _effort_direction(pen, force)
    tip = numbers.in_ground_frame(at)
    return pen.arrow(pen.add_carried_frame(at, turned), np.array([tip - 4.0 * pen.unit * way, tip]), PUSH)


def _component_efforts(force: Force) -> list[tuple[Effort, Component | PointSpeed | Spin]]:
    """Return the efforts of a force or torque set by components, each with its measure."""
    return [
        (e, m) for e in force.efforts for m in nested_parts(e.measure) if isinstance(m, Component | PointSpeed | Spin)
    ]


def _effort_direction(pen: Pen, force: Force) -> tuple[Array, int]:
    """Return the direction of a force or torque in the ground frame, and the body that it turns with."""
    numbers, (turned, own) = pen.numbers, _carrier_of_force(pen, force)
    total, sizes = np.zeros(3), []
    for effort, measure in _component_efforts(force):
        size = 1.0
        with suppress(InputError):
            size = numbers.value_of_formula(effort.magnitude, {"s": 0.0, "rate": 0.0})
        sizes.append(size)
        total += (size if size else 1e-9) * numbers.direction(measure.along)
    if turned != GROUNDED and not any(sizes) and own.any():  # along its components in the axes of the body
        total = numbers.now.turns[turned] @ np.where(np.abs(own) > 1e-9 * np.abs(own).max(), 1.0, 0.0)
    length = float(np.linalg.norm(total))
    return (total / length if length else np.array([1.0, 0.0, 0.0])), turned


def _carrier_of_force(pen: Pen, force: Force) -> tuple[int, Array]:
    """Return the number of the body that a force turns with (else of the ground), and the force in its axes.

    Formulas decide: in the plane a force that turns with its body has components along the axes of the ground too.
    """
    numbers = pen.numbers
    body = numbers.index[force.bodies[0]]
    named = {numbers.index[m.along.body] for _, m in _component_efforts(force)}
    fallback = body if named == {body} else GROUNDED
    with suppress(InputError):
        (first, of_first), (second, of_second) = _direction_in_two_poses(pen, force, body)
        if _are_parallel(first, second):
            return GROUNDED, first
        if _are_parallel(of_first.T @ first, of_second.T @ second):
            return body, of_first.T @ first
    return fallback, np.zeros(3)


def _direction_in_two_poses(pen: Pen, force: Force, body: int) -> list[tuple[Array, Array]]:
    """Return a force with its body in two orientations, and these, all else being the same and nothing 0."""
    numbers, probes = pen.numbers, []
    state = {**numbers.values, **numbers.state, "s": 0.0, "rate": 0.0}
    state |= dict.fromkeys(
        (name for effort in force.efforts for name in names_in_expression(effort.magnitude) if name not in state), 0.0
    )
    state = {name: x or 0.31 + 0.017 * k for k, (name, x) in enumerate(state.items())}
    frame = numbers.frames[body]
    for angle in (0.4, 1.3):
        if numbers.spatial:
            turn = np.array([np.cos(0.5 * angle), *np.sin(0.5 * angle) * np.array([0.48, -0.6, 0.64])])
            changed = dict(zip((f"{frame.name}.e{k}" for k in range(4)), turn.tolist(), strict=True))
        else:
            turn, changed = np.array([angle]), {f"{frame.name}.theta": angle}
        q = np.concatenate([np.zeros(3 if numbers.spatial else 2), turn])
        turns = Poses([BodyFrame(frame.name, 0, len(q))], q, numbers.spatial).turns[0]
        total = np.zeros(3)
        for effort, measure in _component_efforts(force):
            own = numbers.vector(measure.along.vector)
            along = turns @ own if numbers.index[measure.along.body] == body else numbers.direction(measure.along)
            total += numbers.value_of_formula(effort.magnitude, state | changed) * along
        probes.append((total, turns))
    return probes


def _are_parallel(a: Array, b: Array) -> bool:
    """Whether two directions lie along one line."""
    size = float(np.linalg.norm(a) * np.linalg.norm(b))
    return size > 0.0 and float(np.linalg.norm(np.cross(a, b))) <= 1e-9 * size

"""Symbols of springs, dampers, forces and torques."""

from __future__ import annotations

from contextlib import suppress

import numpy as np

from symgen.describe.mechanism import Force
from symgen.drawing.joint_parts import DRIVE, axis_of, ends_of
from symgen.drawing.markers import Place, parts
from symgen.drawing.pen import PLAIN, Pen, across
from symgen.drawing.scene import GROUNDED, INK, Item, Look, Mark
from symgen.errors import InputError
from symgen.vocabulary.expressions import ZERO, Expr, Number, names
from symgen.vocabulary.measures import Angle, Component, Distance, PointSpeed, Spin, Turn

PUSH = Look("#a0522d", "", 1.8)
COIL = Look(INK, "", 1.2)


def force_item(pen: Pen, force: Force) -> Item:
    """Return what is drawn of a force element; what it does not say where it acts is drawn at its bodies."""
    numbers = pen.numbers
    stretched = [m for m in parts(force.efforts) if isinstance(m, Distance)]
    turned = [m for m in parts(force.efforts) if isinstance(m, Angle | Turn | Spin)]
    marks: list[Mark]
    if stretched:
        a, b = numbers.place(stretched[0].a), numbers.place(stretched[0].b)
        marks = [pen.stretch(_kind(pen, force), a, b, COIL), pen.dot(a, 0.2), pen.dot(b, 0.2)]
    elif force.kind == "bushing":
        marks = [pen.dot(place, 0.9, Look(INK, "#9aa7b5", 1.0, 0.4)) for place in numbers.markers(force)[:1]]
    elif turned and force.kind in ("torsional-spring-damper", "torque"):
        marks = _turning(pen, force)
    else:
        marks = _pushes(pen, force)
    return Item("force", force.name, force.kind, tuple(marks))


def _zero(pen: Pen, expression: Expr) -> bool:
    """Whether a constant is 0 with the parameters of the run; formulas of the state are not."""
    if expression == ZERO:
        return True
    with suppress(InputError):
        return pen.numbers.number(expression) == 0.0
    return False


def _kind(pen: Pen, force: Force) -> str:
    numbers, effort = pen.numbers, force.efforts[0]
    state = {"s": 1.0, "rate": 0.0}
    spring = damper = actuator = False
    with suppress(InputError):
        spring = numbers.at(effort.potential, {**state, "s": 1.234}) != numbers.at(
            effort.potential, {**state, "s": 2.345}
        )
    if isinstance(effort.magnitude, Number):
        actuator = effort.magnitude != ZERO
    else:
        damper = "rate" in set(names(effort.magnitude))
        with suppress(InputError):
            still, moving = (numbers.at(effort.magnitude, {**state, "rate": r}) for r in (0.0, 1.0))
            damper, actuator = still != moving, still != 0.0
    if spring or damper:
        return "spring-damper" if spring and damper else "spring" if spring else "damper"
    return "actuator" if actuator else "spring"


def _turning(pen: Pen, force: Force) -> list[Mark]:
    numbers = pen.numbers
    joints = [j for j in numbers.mechanism.joints if set(j.bodies) == set(force.bodies) and numbers.markers(j.rows)]
    body = next((b for b in force.bodies if b in numbers.index and b != "ground"), force.bodies[0])
    at = ends_of(numbers, joints[0])[0] if joints else Place(numbers.index[body], (0.0, 0.0, 0.0))
    axis = axis_of(numbers, joints[0]) if joints else np.array([0.0, 0.0, 1.0])
    if force.kind == "torque":
        return pen.turning(at.body, numbers.out(at), axis, 1.6, DRIVE)
    first, second = across(axis)
    turn = np.linspace(0.0, 5.0 * np.pi, 60)[:, None]
    reach = pen.unit * np.linspace(0.3, 1.5, 60)[:, None]
    return [pen.line(at.body, numbers.out(at) + reach * (np.cos(turn) * first + np.sin(turn) * second), COIL)]


def _pushes(pen: Pen, force: Force) -> list[Mark]:
    """Return an arrow with its tip where the force acts, along what it is now or else along its components."""
    numbers, total, at = pen.numbers, np.zeros(3), None
    body = 0
    for effort in force.efforts:
        for measure in (m for m in parts(effort.measure) if isinstance(m, Component | PointSpeed)):
            at = numbers.place(measure.b if isinstance(measure, Component) else measure.at)
            body = at.body
            size = 1.0
            with suppress(InputError):
                size = numbers.at(effort.magnitude, {"s": 0.0, "rate": 0.0})
            total += (size if size else 1e-9) * numbers.direction(measure.along)
    if at is None:
        return [pen.dot(place, 0.35, PLAIN) for place in numbers.markers(force)]
    length = float(np.linalg.norm(total))
    way = total / length if length else np.array([1.0, 0.0, 0.0])
    tip = numbers.out(at)
    return pen.arrow(body if body != GROUNDED else 0, np.array([tip - 4.0 * pen.unit * way, tip]), PUSH)

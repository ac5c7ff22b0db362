"""The balance of springs at a massless point, as rows of a mechanism file."""

from __future__ import annotations

from typing import TYPE_CHECKING

from symgen.base.vocabulary.expressions import ZERO, Call, Expr, Name, call, literal_of
from symgen.base.vocabulary.measures import GROUND, Distance, HalfSquare, Marker
from symgen.describe.forces._parts import spring_potential
from symgen.describe.formulas.formula_text import to_text

if TYPE_CHECKING:
    from symgen.describe.mechanism import Force, Mechanism

_AXES = "xyz"


def balance_rows(mechanism: Mechanism, body: str) -> str:
    """Return the rows of a joint that keep the springs at a massless point in balance, as a line of a file.

    Where their forces are in balance the multipliers of these rows are 0, so the point moves as one without mass does.

    Parameters
    ----------
    mechanism : Mechanism
        The mechanism.
    body : str
        The point.

    Returns
    -------
    str
        Empty where the body is none, where something other than springs acts on it, or where an end has no name.
    """
    own = next(b for b in mechanism.bodies if b.name == body)
    forces = [force for force in mechanism.forces if body in force.bodies]
    if own.inertia is not None or not forces:
        return ""
    axes = _AXES[: len(mechanism.gravity)]
    terms = [_spring_terms(mechanism, body, force, axes) for force in forces]
    if not all(terms):
        return ""
    rows = ", ".join(f'{{ position = "{" + ".join(each)}" }}' for each in zip(*terms, strict=True))
    return f"rows = [{rows}]"


def _spring_terms(mechanism: Mechanism, body: str, force: Force, axes: str) -> list[str]:
    """Return the forces of a spring on a point along each axis, with the sign of its pull; none for other forces."""
    if len(force.efforts) != 1 or force.flexures:
        return []
    (effort,) = force.efforts
    if effort.magnitude != ZERO or not isinstance(effort.measure, Distance | HalfSquare):
        return []
    ends = effort.measure.a, effort.measure.b
    other = ends[0] if ends[1].body == body else ends[1]
    places = [_place(mechanism, other, k) for k in range(len(axes))]
    if not all(places) or ends[0].body == ends[1].body:
        return []
    gaps = [f"{body}.{x}" if p == "0" else f"({body}.{x} - {p})" for x, p in zip(axes, places, strict=True)]
    match effort.potential:
        case Call("mul", (stiffness, Name("s"))) if isinstance(effort.measure, HalfSquare):
            return [f"{_factor(stiffness)}*{gap}" for gap in gaps]
        case Call("mul", (half, Call("pow", (Call("sub", (Name("s"), free)), _)))):
            stiffness = half.arguments[0] if isinstance(half, Call) else call("mul", half, literal_of(2.0))
            if effort.potential == spring_potential(stiffness, free):
                length = f"sqrt({' + '.join(f'{gap}**2' for gap in gaps)})"
                return [f"{_factor(stiffness)}*(1 - {_factor(free)}/{length})*{gap}" for gap in gaps]
    return []


def _factor(expression: Expr) -> str:
    """Return an expression as a factor."""
    return to_text(call("mul", expression, Name("_"))).removesuffix("*_")


def _place(mechanism: Mechanism, end: Marker, axis: int) -> str:
    """Return a coordinate of an end, empty where it has no name."""
    if end.body == GROUND:
        text = to_text(end.point[axis])
        return "0" if end.point[axis] == ZERO else f"({text})" if text.startswith("-") else text
    body = next(b for b in mechanism.bodies if b.name == end.body)
    if body.inertia is None:
        return f"{body.name}.{_AXES[axis]}"
    names = [name for name, point in body.points if point == end.point]
    return f"{body.name}.{names[0]}.{_AXES[axis]}" if names else ""

"""Rows of joints in words and by vectors of bodies, where the derived row is a polynomial in Euler parameters."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING

from symgen.base.vocabulary.expressions import ONE, ZERO, Call, Expr, Name, Number, Reading
from symgen.base.vocabulary.measures import (
    GROUND,
    Angle,
    Bearing,
    BladeSpeed,
    Component,
    Direction,
    Distance,
    Dot,
    FormulaMeasure,
    FormulaSpeed,
    HalfSquare,
    Holonomic,
    Lap,
    LinkStretch,
    Marker,
    Measure,
    OnChain,
    PieceNumber,
    PointSpeed,
    RimHeight,
    RollingSpeed,
    Row,
    Speed,
    SphereSlip,
    Spin,
    Sum,
    Turn,
    Wrapped,
    nested_parts,
)
from symgen.describe.formulas.formula_text import to_text

if TYPE_CHECKING:
    from symgen.describe.mechanism import Mechanism

_AXES = "xyz"


@dataclass(frozen=True)
class RowWords:
    """A row for people.

    Attributes
    ----------
    words : str
        What it holds, in a line.
    vectors : str
        The same as an equation: ``r(P)`` is the place of a point, ``v(P)`` its velocity, ``e_x(B)`` an axis of a body,
        ``u(B [...])`` another unit vector of it, ``theta(B)`` its angle, ``omega(B)`` its angular velocity. Empty for a
        formula of the file.
    """

    words: str
    vectors: str


def row_words(mechanism: Mechanism) -> dict[str, RowWords]:
    """Return what each row holds, by the row's name; rows with bounds are in force at times."""
    writer = _Writer(mechanism)
    texts = {f"{joint.name}.{row.label}": writer.describe_row(row) for joint in mechanism.joints for row in joint.rows}
    for bounded in mechanism.bounded:
        if bounded.one_sided:
            held = writer.describe_row(bounded.held)
        elif bounded.paired:
            slip = writer.describe_row(bounded.held)
            texts[bounded.row] = RowWords(f"while it sticks, {slip.words}", slip.vectors)
            continue
        else:
            held = RowWords(writer.noun_of_measure(bounded.measure), "")
        texts[bounded.row] = RowWords(bounded.family.held.format(held.words), held.vectors)
    return texts


class _Writer:
    """Names of the points and directions of a mechanism, and sentences made of them."""

    def __init__(self, mechanism: Mechanism) -> None:
        self._points: Mapping[tuple[str, tuple[Expr, ...]], str] = {
            (body.name, place): point
            for body in mechanism.bodies
            for point, place in (*body.points, ("centre", body.centre_of_mass))
        }

    def describe_row(self, row: Row) -> RowWords:
        """Return a row."""
        if isinstance(row, Holonomic):
            return self.describe_holonomic(row)
        sentence, left = self._describe_speed(row.speed)
        end = "" if row.value == ZERO else f", but for {to_text(row.value)}"
        return RowWords(sentence + end, f"{left} = {_number_text(row.value)}" if left else "")

    def describe_holonomic(self, row: Holonomic) -> RowWords:
        """Return a row on a measure."""
        value, free = _number_text(row.value), row.value == ZERO
        measure = _without_sign(row.measure) if free else row.measure
        match measure:
            case LinkStretch(a, b, length):
                sentence = (
                    f"{self.name_of_point(a)} and {self.name_of_point(b)} keep the distance {_number_text(length)}"
                )
                return RowWords(sentence, f"|{self._vector_between(a, b)}| = {_number_text(length)}")
            case Component(a, b, along) if free:
                sentence = f"{self.name_of_point(a)} and {self.name_of_point(b)} coincide {_phrase_in_direction(along)}"
            case Angle(a, b) if free and GROUND not in (a, b):
                sentence = f"{a} and {b} do not turn against each other"
            case Angle(a, b) if free:
                sentence = f"{b if a == GROUND else a} does not turn"
            case RimHeight() if free:
                sentence = f"the rim of {measure.centre.body} touches the plane"
            case Dot(u, v) if free:
                sentence = f"{_direction_in_sentence(u)} stays perpendicular to {_direction_in_sentence(v)}"
            case _:
                moves = any(isinstance(x, Name) and x.name == "t" for x in nested_parts(row.value))
                sentence = f"{self.noun_of_measure(measure)} {'follows' if moves else 'is'} {value}"
        left = self.vector_formula(measure)
        return RowWords(sentence, f"{left} = {value}" if left else "")

    def noun_of_measure(self, measure: Measure | FormulaSpeed) -> str:
        """Return what a measure is."""
        match measure:
            case Component(a, b, along):
                return (
                    f"the distance from {self.name_of_point(a)} to {self.name_of_point(b)} "
                    f"{_phrase_in_direction(along)}"
                )
            case Distance(a, b) | LinkStretch(a, b):
                return f"the distance of {self.name_of_point(a)} and {self.name_of_point(b)}"
            case HalfSquare(a, b):
                return f"half the square of the distance of {self.name_of_point(a)} and {self.name_of_point(b)}"
            case Angle(a, b):
                return f"the angle of {b}" if a == GROUND else f"the angle of {b} against {a}"
            case Turn(zero, _, pointer):
                return f"the angle of {pointer.body} against {zero.body}"
            case Bearing(a, b):
                return f"the direction from {self.name_of_point(a)} to {self.name_of_point(b)}"
            case Dot(u, v):
                return f"the cosine between {_direction_in_sentence(u)} and {_direction_in_sentence(v)}"
            case Spin(a, b, along):
                return f"the turn of {b} against {a} about {_direction_in_sentence(along)}"
            case RimHeight():
                return f"the height of the rim of {measure.centre.body} over the plane"
            case FormulaSpeed(of=Reading(source=Spin() as turned)):  # of a contact that resists turning
                return self.noun_of_measure(turned)
            case FormulaMeasure(of=Reading(source=OnChain(quantity="gap") as beside)):
                return f"the gap to an outline of {beside.chain.origin.body}"
            case FormulaSpeed(of=Call("sub", (Reading(source=way), _))) if isinstance(way, Measure):  # of a contact
                return f"{self.noun_of_measure(way)} less the way of the surface"
            case FormulaMeasure() | FormulaSpeed():
                return "a formula of the file"
            case OnChain() | Lap() | PieceNumber():
                return f"a quantity beside an outline of {measure.chain.origin.body}"
            case Wrapped():
                return f"{self.noun_of_measure(measure.of)}, but for whole periods"
            case _:
                terms = [
                    self.noun_of_measure(term)
                    if factor == ONE
                    else f"{_number_text(factor)} times {self.noun_of_measure(term)}"
                    for factor, term in measure.terms
                ]
                return " plus ".join(terms)

    def vector_formula(self, measure: Measure) -> str:
        """Return a measure by vectors; empty for formulas of the file and for angles about an axis."""
        match measure:
            case Component(a, b, along):
                return f"{_direction_in_formula(along)} . ({self._vector_between(a, b)})"
            case Distance(a, b) | LinkStretch(a, b):
                return f"|{self._vector_between(a, b)}|"
            case Angle(a, b):
                angles = [f"theta({body})" for body in (b, a) if body != GROUND]
                return " - ".join(angles) if b != GROUND else f"-{angles[0]}"
            case Dot(u, v):
                return f"{_direction_in_formula(u)} . {_direction_in_formula(v)}"
            case RimHeight(plane, normal, centre, axis, radius):
                n = _direction_in_formula(normal)
                height = f"{n} . ({self._vector_between(plane, centre)})"
                return f"{height} - {_number_text(radius)} sqrt(1 - ({n} . {_direction_in_formula(axis)})^2)"
            case _:
                return ""

    def _describe_speed(self, speed: Speed) -> tuple[str, str]:
        """Return the sentence of a velocity that is 0, and the velocity by vectors."""
        match speed:
            case PointSpeed(at, along):
                sentence = f"{self.name_of_point(at)} does not move {_phrase_in_direction(along)}"
                return sentence, f"{_direction_in_formula(along)} . v({self.name_of_point(at)})"
            case RollingSpeed(centre, along, normal, radius, axis):
                n, turn = _direction_in_formula(normal), f"{_number_text(radius)} omega({centre.body})"
                lever = (
                    n
                    if axis is None
                    else f"({n} - ({n} . {_direction_in_formula(axis)}) {_direction_in_formula(axis)})"
                )
                below = "" if axis is None else f" / sqrt(1 - ({n} . {_direction_in_formula(axis)})^2)"
                sentence = f"where {centre.body} touches the plane it does not slip {_phrase_in_direction(along)}"
                return (
                    sentence,
                    f"{_direction_in_formula(along)} . (v({self.name_of_point(centre)}) - {turn} x {lever}{below})",
                )
            case SphereSlip(a, b):
                return f"where {b.body} touches {a.body} it does not slip", ""
            case BladeSpeed(at, normal, blade):
                sentence = f"{self.name_of_point(at)} does not move across the blade {_direction_in_sentence(blade)}"
                return (
                    sentence,
                    f"v({self.name_of_point(at)}) . ({_direction_in_formula(normal)} x {_direction_in_formula(blade)})",
                )
            case FormulaSpeed(of=Call("sub", (Reading(source=slip), _))) if isinstance(slip, Speed):  # of a contact
                return f"{self._describe_speed(slip)[0]}, but as the surface moves", ""
            case FormulaSpeed(of=Reading(source=Spin())):
                return f"{self.noun_of_measure(speed)} does not change", ""
            case FormulaSpeed():
                return "a formula of the file, linear in velocities, is 0", ""

    def name_of_point(self, marker: Marker) -> str:
        """Return how a point is called: by its name, or by its coordinates in its body."""
        name = self._points.get((marker.body, marker.point))
        return f"{marker.body} {_tuple_text(marker.point)}" if name is None else f"{marker.body}.{name}"

    def _vector_between(self, a: Marker, b: Marker) -> str:
        return f"r({self.name_of_point(b)}) - r({self.name_of_point(a)})"


def _without_sign(measure: Measure) -> Measure:
    """Return a measure that is 0 where another one is: that one without its sign."""
    match measure:
        case Sum(((Number(value=factor), term),)) if abs(factor) == 1.0:
            return term
        case _:
            return measure


def _sign_and_axis(direction: Direction) -> tuple[str, str] | None:
    """Return the sign and the letter of an axis of a frame, if a direction is one."""
    places = [i for i, e in enumerate(direction.vector) if not (isinstance(e, Number) and e.value == 0)]
    if len(places) != 1:
        return None
    entry = direction.vector[places[0]]
    if not isinstance(entry, Number) or abs(entry.value) != 1:
        return None
    return "-" if entry.value < 0 else "", _AXES[places[0]]


def _direction_in_formula(direction: Direction) -> str:
    """Return a direction in a formula."""
    axis = _sign_and_axis(direction)
    if axis is None:
        return f"u({direction.body} {_tuple_text(direction.vector)})"
    text = f"{axis[0]}e_{axis[1]}({direction.body})"
    return f"({text})" if axis[0] else text


def _direction_in_sentence(direction: Direction) -> str:
    """Return a direction in a sentence."""
    axis = _sign_and_axis(direction)
    return (
        f"{_tuple_text(direction.vector)} of {direction.body}" if axis is None else f"e_{axis[1]} of {direction.body}"
    )


def _phrase_in_direction(direction: Direction) -> str:
    axis = _sign_and_axis(direction)
    return (
        f"in {axis[1]}"
        if axis is not None and direction.body == GROUND
        else f"along {_direction_in_sentence(direction)}"
    )


def _tuple_text(entries: tuple[Expr, ...]) -> str:
    return f"[{', '.join(map(_number_text, entries))}]"


def _number_text(expression: Expr) -> str:
    """Return an expression; numbers with six digits."""
    return f"{expression.value + 0.0:.6g}" if isinstance(expression, Number) else to_text(expression)

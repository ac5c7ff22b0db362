"""Rows: constraints written as formulas of positions or velocities."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Any, ClassVar

import msgspec

from symgen.describe.fields import BodyNames, Rows, StateFunction, Text, read
from symgen.describe.formula_text import to_text
from symgen.describe.mechanism import Joint, is_speed
from symgen.describe.names import check_identifier
from symgen.describe.readings import is_turning
from symgen.describe.scope import Scope
from symgen.errors import quoted
from symgen.vocabulary.expressions import Call, Expr, Name, Reading, moving
from symgen.vocabulary.measures import (
    GROUND,
    Direction,
    FormulaMeasure,
    FormulaSpeed,
    Holonomic,
    Marker,
    Nonholonomic,
    Row,
)

#: Units of a row's value, without those of time.
UNITS = ("m", "rad")


class RowKeys(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """The keys of one row."""

    position: StateFunction | None = None
    velocity: StateFunction | None = None
    label: Text = ""
    unit: Text = ""


class FormulaRows(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """Constraints of your own: formulas that are held at 0.

    Parameters
    ----------
    rows : list of tables
        Each ``{ position = "EXPRESSION" }`` of t, parameters, smooth tables, coordinates of bodies, points and axes of
        them and coordinates of joints, or ``{ velocity = "EXPRESSION" }`` of the rates of these as well, in which it is
        linear; also ``label``, ``row1``, ``row2``, ... by default, and ``unit``, ``"m"`` or ``"rad"``, of a velocity
        ``"m/s"`` or ``"rad/s"``: that of lengths by default, unless the formula has only angles and axes.
    between : list of body names
        The bodies that are tied, in the order that results have them: the reaction is that on the first one. Those that
        the rows read by default, in the order in which they do.

    Notes
    -----
    One row each. Multiplier ``NAME.LABEL`` [N for lengths, N m for angles]: generalised forces are -lambda times the
    derivatives of the formula by the velocities.
    """

    SPACES: ClassVar[tuple[str, ...]] = ("planar", "spatial")

    rows: Rows
    between: BodyNames | None = None

    def build(self, scope: Scope) -> Joint:
        """Resolve to formulas as measures and velocities."""
        rows = tuple(self._row(scope, i, raw) for i, raw in enumerate(self.rows))
        labels = [row.label for row in rows]
        for label in labels:
            if labels.count(label) > 1:
                raise scope.error("rows", "labels used once", f"'{label}' {labels.count(label)} times")
        read_bodies = list(dict.fromkeys(b for row in rows for b in _bodies(row) if b != GROUND))
        bodies = read_bodies if self.between is None else [scope.body("between", name) for name in self.between]
        for body in read_bodies:
            if body not in bodies:
                raise scope.error("between", f"all bodies of the rows, {', '.join(read_bodies)}", f"none of '{body}'")
        return Joint(scope.name, scope.kind, tuple(dict.fromkeys(bodies)), rows)

    def _row(self, scope: Scope, i: int, raw: object) -> Row:
        key = f"rows[{i}]"
        keys = read(RowKeys, raw, scope.where(key))
        if (keys.position is None) == (keys.velocity is None):
            got = "neither" if keys.position is None else "both"
            raise scope.error(key, "either the key position or the key velocity", got)
        label = check_identifier(keys.label or f"row{i + 1}", scope.where(f"{key}.label"), "row")
        per_second = "" if keys.velocity is None else "/s"
        units = [f"{unit}{per_second}" for unit in UNITS]
        if keys.unit and keys.unit not in units:
            raise scope.error(f"{key}.unit", " or ".join(f"'{unit}'" for unit in units), quoted(keys.unit))
        if keys.position is not None:
            of = scope.of_row(f"{key}.position", keys.position, speeds=False)
            return Holonomic(label, FormulaMeasure(of), unit=keys.unit or units[_is_angle(of)])
        of = scope.of_row(f"{key}.velocity", keys.velocity or 0.0, speeds=True)
        term = _nonlinear(of)
        if term is not None or not _degree(of):
            got = "a formula without velocities" if term is None else f"the term {quoted(to_text(term))}"
            raise scope.error(f"{key}.velocity", "a formula that is linear in velocities", got)
        return Nonholonomic(label, FormulaSpeed(of), unit=keys.unit or units[_is_angle(of)])


def _is_rate(e: Name | Reading) -> bool:
    return e.order > 0 if isinstance(e, Reading) else is_speed(e.name)


def _is_angle(of: Expr) -> bool:
    """Whether all that moves in a formula are angles and axes."""
    turning = (
        is_turning(e.source) if isinstance(e, Reading) else e.name.rpartition(".")[2][0] in ("t", "o", "w")
        for e in moving(of)
    )
    return all(turning)


def _degree(e: Expr) -> float:
    """Return the degree of a formula in velocities, infinite where it is no polynomial of them."""
    if isinstance(e, Name | Reading):
        return float(e in moving(e) and _is_rate(e))
    if not isinstance(e, Call):
        return 0.0
    degrees = [_degree(a) for a in e.arguments]
    if e.function in ("add", "sub", "neg"):
        return max(degrees)
    if e.function == "mul":
        return sum(degrees)
    if e.function in ("div", "where"):
        fixed, free = (degrees[1:], degrees[:1]) if e.function == "div" else (degrees[:1], degrees[1:])
        return math.inf if any(fixed) else max(free)
    return math.inf if any(degrees) else 0.0


def _nonlinear(e: Expr) -> Expr | None:
    """Return the smallest part of a formula that is not linear in velocities, None where all of it is."""
    if _degree(e) <= 1.0 or not isinstance(e, Call):
        return None
    return next((part for a in e.arguments if (part := _nonlinear(a)) is not None), e)


def _bodies(value: Any) -> Iterator[str]:
    """Yield the bodies that a part of the vocabulary names."""
    if isinstance(value, Name):
        if "." in value.name:
            yield value.name.partition(".")[0]
    elif isinstance(value, Marker | Direction):
        yield value.body
    elif isinstance(value, tuple):
        for item in value:
            yield from _bodies(item)
    elif isinstance(value, msgspec.Struct):
        for field in value.__struct_fields__:
            part = getattr(value, field)
            if isinstance(part, str):
                if field in ("a", "b"):
                    yield part
            else:
                yield from _bodies(part)


KIND = FormulaRows

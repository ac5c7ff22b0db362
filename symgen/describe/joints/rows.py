"""Rows: constraints written as formulas of positions or velocities."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import ClassVar

import msgspec

from symgen.base.errors import quote
from symgen.base.vocabulary.expressions import Call, Expr, Name, Reading, moving_quantities
from symgen.base.vocabulary.measures import (
    GROUND,
    Angle,
    Direction,
    FormulaMeasure,
    FormulaSpeed,
    Holonomic,
    Marker,
    Nonholonomic,
    Row,
    Spin,
    nested_parts,
)
from symgen.describe.coordinate_names import is_speed
from symgen.describe.formulas.formula_text import to_text
from symgen.describe.formulas.identifiers import check_identifier
from symgen.describe.formulas.readings import is_angle
from symgen.describe.mechanism import Joint
from symgen.describe.parts.fields import BodyNames, Rows, StateFunction, Text, read_table
from symgen.describe.parts.scope import Scope

#: Units of a row's value, without those of time.
UNITS = ("m", "rad")
#: Functions -> the arguments in which they are linear, from one up to another.
_LINEAR = {"add": (0, 2), "sub": (0, 2), "neg": (0, 1), "div": (0, 1), "where": (1, 3)}


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
        rows = tuple(self._read_row(scope, i, raw) for i, raw in enumerate(self.rows))
        labels = [row.label for row in rows]
        for label in labels:
            if labels.count(label) > 1:
                raise scope.error("rows", "labels used once", f"'{label}' {labels.count(label)} times")
        read_bodies = tied_bodies(*rows)
        bodies = read_bodies if self.between is None else tuple(scope.body("between", name) for name in self.between)
        for body in read_bodies:
            if body not in bodies:
                raise scope.error("between", f"all bodies of the rows, {', '.join(read_bodies)}", f"none of '{body}'")
        return Joint(scope.name, scope.kind, tuple(dict.fromkeys(bodies)), rows)

    def _read_row(self, scope: Scope, i: int, raw: object) -> Row:
        key = f"rows[{i}]"
        keys = read_table(RowKeys, raw, scope.where(key))
        if (keys.position is None) == (keys.velocity is None):
            got = "neither" if keys.position is None else "both"
            raise scope.error(key, "either the key position or the key velocity", got)
        label = check_identifier(keys.label or f"row{i + 1}", scope.where(f"{key}.label"), "row")
        per_second = "" if keys.velocity is None else "/s"
        units = [f"{unit}{per_second}" for unit in UNITS]
        if keys.unit and keys.unit not in units:
            raise scope.error(f"{key}.unit", " or ".join(f"'{unit}'" for unit in units), quote(keys.unit))
        if keys.position is not None:
            of = scope.of_row(f"{key}.position", keys.position, speeds=False)
            return Holonomic(label, FormulaMeasure(of), unit=keys.unit or units[is_angle(of)])
        of = scope.of_row(f"{key}.velocity", keys.velocity or 0.0, speeds=True)
        term = _nonlinear_part(of)
        if term is not None or not _degree_in_velocities(of):
            got = "a formula without velocities" if term is None else f"the term {quote(to_text(term))}"
            raise scope.error(f"{key}.velocity", "a formula that is linear in velocities", got)
        return Nonholonomic(label, FormulaSpeed(of), unit=keys.unit or units[is_angle(of)])


def _is_rate(e: Name | Reading) -> bool:
    return e.order > 0 if isinstance(e, Reading) else is_speed(e.name)


def _degree_in_velocities(e: Expr) -> float:
    """Return the degree of a formula in velocities, infinite if it is not a polynomial in them."""
    if isinstance(e, Name | Reading):
        return float(e in moving_quantities(e) and _is_rate(e))
    if not isinstance(e, Call):
        return 0.0
    degrees = [_degree_in_velocities(a) for a in e.arguments]
    if e.function == "mul":
        return sum(degrees)
    first, last = _LINEAR.get(e.function, (0, 0))
    free, fixed = degrees[first:last], degrees[:first] + degrees[last:]
    return math.inf if any(fixed) else max(free, default=0.0)


def _nonlinear_part(e: Expr) -> Expr | None:
    """Return the smallest part of a formula that is not linear in velocities, None where all of it is."""
    if _degree_in_velocities(e) <= 1.0 or not isinstance(e, Call):
        return None
    return next((part for a in e.arguments if (part := _nonlinear_part(a)) is not None), e)


def tied_bodies(*rows: Row) -> tuple[str, ...]:
    """Return the bodies that rows read, in the order in which they do."""
    return tuple(dict.fromkeys(b for row in rows for b in _bodies_of_row(row) if b != GROUND))


def _bodies_of_row(row: Row) -> Iterator[str]:
    """Yield the bodies that a row reads."""
    for part in nested_parts(row):
        if isinstance(part, Name) and "." in part.name:
            yield part.name.rpartition(".")[0]
        elif isinstance(part, Marker | Direction):
            yield part.body
        elif isinstance(part, Angle | Spin):
            yield from (part.a, part.b)


KIND = FormulaRows

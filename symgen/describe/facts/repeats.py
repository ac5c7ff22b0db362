"""Rows that repeat another one for all q: detected from their measures, in both shapes by this module."""

from __future__ import annotations

from typing import Any

import msgspec

from symgen.base.vocabulary.expressions import Call, Name, Number
from symgen.base.vocabulary.measures import (
    GROUND,
    Angle,
    Component,
    Direction,
    Dot,
    FormulaMeasure,
    FormulaSpeed,
    Marker,
    RimHeight,
    Sum,
)
from symgen.describe.formulas.formula_nodes import Formulas
from symgen.describe.mechanism import Joint, Mechanism
from symgen.describe.remembered import compute_once


def without_repeats(mechanism: Mechanism) -> tuple[Mechanism, tuple[tuple[str, str], ...]]:
    """Return a mechanism without the rows that repeat an earlier one, and the names of each pair.

    Two rows are alike where they hold the same measure at the same value, formulas compared after simplification: a
    point at ``1*p`` is the point at ``p``. A row that may be off is like no other one.

    Parameters
    ----------
    mechanism : Mechanism
        A validated mechanism.
    """
    repeats = _find_repeats(mechanism)
    if not repeats:
        return mechanism, ()
    joints: list[Joint] = []
    for k, joint in enumerate(mechanism.joints):
        rows = tuple(row for i, row in enumerate(joint.rows) if (k, i) not in repeats)
        joints.append(joint if len(rows) == len(joint.rows) else msgspec.structs.replace(joint, rows=rows))
    return msgspec.structs.replace(mechanism, joints=tuple(joints)), tuple(repeats.values())


@compute_once
def _find_repeats(mechanism: Mechanism) -> dict[tuple[int, int], tuple[str, str]]:
    """Return the rows that repeat an earlier one, by joint and place in it: their names and the earlier rows'."""
    contents = _Contents(mechanism)
    names: dict[object, str] = {}
    repeats: dict[tuple[int, int], tuple[str, str]] = {}
    for k, joint in enumerate(mechanism.joints):
        for i, row in enumerate(() if joint.name in mechanism.switchable else joint.rows):
            name, content = (
                f"{joint.name}.{row.label}",
                contents.content_of(msgspec.structs.replace(row, label="", unit="")),
            )
            if content in names:
                repeats[k, i] = name, names[content]
            else:
                names[content] = name
    return repeats


class _Contents:
    """Values of the vocabulary with formulas as nodes, markers relative to centres of mass and sums put together."""

    def __init__(self, mechanism: Mechanism) -> None:
        self.formulas = Formulas(mechanism)

    def content_of(self, value: object) -> Any:
        """Return something hashable that is equal for equal content."""
        if isinstance(value, FormulaMeasure | FormulaSpeed):
            return value  # which readings are equal is a question of their measures: rank decides
        if isinstance(value, Number | Name | Call):
            return self.formulas.expression(value)
        if isinstance(value, Marker):
            return value.body, *self.formulas.local(value)
        if isinstance(value, Component | RimHeight):
            return self.height_along(value)
        if isinstance(value, Direction):
            return value.body, *self.formulas.direction(value)
        if isinstance(value, Dot):
            return frozenset((self.content_of(value.u), self.content_of(value.v)))
        if isinstance(value, Sum | Angle):
            return self.terms_of_sum(value)
        if isinstance(value, msgspec.Struct):
            return type(value).__name__, *(self.content_of(getattr(value, f)) for f in value.__struct_fields__)
        return tuple(self.content_of(item) for item in value) if isinstance(value, tuple) else value

    def height_along(self, value: Component | RimHeight) -> Any:
        """Return a component along a direction, of markers on its own ground only the height along it."""
        along = value.along if isinstance(value, Component) else value.normal
        fields = []
        for name in value.__struct_fields__:
            part = getattr(value, name)
            if isinstance(part, Marker) and part.body == along.body == GROUND:
                fields.append((GROUND, self.formulas.graph.dot(self.content_of(along)[1:], self.content_of(part)[1:])))
            else:
                fields.append(self.content_of(part))
        return type(value).__name__, *fields

    def terms_of_sum(self, value: Sum | Angle) -> Any:
        """Return the terms of a sum: terms of its parts and angles of bodies together."""
        g = self.formulas.graph
        terms: dict[Any, int] = {}

        def add_term(measure: object, factor: int) -> None:
            if isinstance(measure, Sum):
                for coefficient, part in measure.terms:
                    add_term(part, g.mul(factor, self.formulas.expression(coefficient)))
                return
            if isinstance(measure, Angle):
                for body, own in ((measure.b, factor), (measure.a, g.neg(factor))):
                    if body != GROUND:
                        terms[body] = g.add(terms.get(body, g.zero), own)
                return
            content = self.content_of(measure)
            terms[content] = g.add(terms.get(content, g.zero), factor)

        add_term(value, g.one)
        nonzero = {content: factor for content, factor in terms.items() if factor != g.zero}
        if list(nonzero.values()) == [g.one] and not isinstance(next(iter(nonzero)), str):
            return next(iter(nonzero))
        return frozenset(nonzero.items())

"""Columns that results have besides coordinates, from readings of points, force elements, drivers and outputs."""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

from symgen.base.vocabulary.expressions import Expr, Name, Reading
from symgen.base.vocabulary.measures import Marker
from symgen.describe.formulas.reaction_readings import Table
from symgen.describe.formulas.readings import (
    OUTPUT,
    readings_of_force,
    readings_of_interface,
    readings_of_joint,
    readings_of_point,
    readings_of_rows,
)
from symgen.describe.mechanism import Mechanism


class Column(NamedTuple):
    """A reported quantity: its name, unit and formula."""

    name: str
    unit: str
    formula: Expr


def columns_of_points(mechanism: Mechanism) -> tuple[Column, ...]:
    """Return coordinates, velocities and accelerations of named points and interfaces: ``arm.tip.x``, ``.vx``, ...."""
    dimension = len(mechanism.gravity)
    tables = (
        table
        for body in mechanism.bodies
        for table in (
            *(readings_of_interface(x, dimension, OUTPUT) for x in (body,) if x.carried is not None),
            *(readings_of_point(f"{body.name}.{p}", Marker(body.name, at), dimension, OUTPUT) for p, at in body.points),
        )
    )
    return tuple(column for table in tables for column in _columns_of_table(table))


def columns_of_elements(mechanism: Mechanism) -> tuple[Column, ...]:
    """Return measures, forces and power of force elements and drivers: ``spring.length``, ``.force``, ``.power``."""
    drivers = (
        column
        for j in mechanism.joints
        if j.kind == "driver"
        for column in _columns_of_driver(readings_of_joint(j, OUTPUT))
    )
    return (*columns_of_force_elements(mechanism), *drivers)


def columns_of_force_elements(mechanism: Mechanism) -> tuple[Column, ...]:
    """Return measures, forces and power of force elements."""
    return tuple(column for force in mechanism.forces for column in _columns_of_table(readings_of_force(force, OUTPUT)))


def columns_of_outputs(mechanism: Mechanism) -> tuple[Column, ...]:
    """Return the states of the file's own, the rows of modal bodies, and the formulas of ``[outputs]``."""
    states = (Column(x.name, x.unit, Name(x.name)) for x in mechanism.states)
    rows = (
        Column(f"{body.name}.{label}", unit, formula)
        for body in mechanism.bodies
        if body.modal is not None
        for label, (formula, unit) in readings_of_rows(body.name, body.modal).items()
    )
    return (*states, *rows, *(Column(o.name, o.unit, o.value) for o in mechanism.outputs))


def _columns_of_table(table: Table) -> Iterator[Column]:
    return (Column(each.name, unit, each) for each, unit in table.values() if isinstance(each, Reading))


def _columns_of_driver(table: Table) -> Iterator[Column]:
    """Yield the columns of a driver: its only coordinate's rate has its short name."""
    return _columns_of_table({label: entry for label, entry in table.items() if not label.endswith(".rate")})


#: Table of a result -> its columns.
TABLES = {"points": columns_of_points, "elements": columns_of_elements, "outputs": columns_of_outputs}

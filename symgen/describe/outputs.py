"""What results report beside the state: points, forces and drivers, and the formulas of ``[outputs]``."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any, NamedTuple

from symgen.describe.mechanism import Mechanism
from symgen.describe.readings import OUTPUT, Table, of_force, of_joint, of_point
from symgen.vocabulary.expressions import Expr, readings
from symgen.vocabulary.measures import Integral, Marker


class Column(NamedTuple):
    """A reported quantity: its name, unit and formula."""

    name: str
    unit: str
    formula: Expr


def points(mechanism: Mechanism) -> tuple[Column, ...]:
    """Return coordinates, velocities and accelerations of all named points: ``arm.tip.x``, ``.vx``, ``.ax``."""
    dimension = len(mechanism.gravity)
    return tuple(
        column
        for body in mechanism.bodies
        for point, place in body.points
        for column in _columns(of_point(f"{body.name}.{point}", Marker(body.name, place), dimension, OUTPUT))
    )


def elements(mechanism: Mechanism) -> tuple[Column, ...]:
    """Return measures, forces and power of force elements and drivers: ``spring.length``, ``.force``, ``.power``."""
    forces = (column for force in mechanism.forces for column in _columns(of_force(force, OUTPUT)))
    drivers = (column for j in mechanism.joints if j.kind == "driver" for column in _driver(of_joint(j, OUTPUT)))
    return (*forces, *drivers)


def outputs(mechanism: Mechanism) -> tuple[Column, ...]:
    """Return the formulas of ``[outputs]``."""
    return tuple(Column(o.name, o.unit, o.value) for o in mechanism.outputs)


def integrals(mechanism: Mechanism) -> dict[Integral, int]:
    """Return the integrals that outputs ask for, numbered in their order, each once."""
    found = (r.source for output in mechanism.outputs for r in readings(output.value))
    return {source: i for i, source in enumerate(dict.fromkeys(s for s in found if isinstance(s, Integral)))}


def integrated(mechanism: Mechanism) -> tuple[Any, ...]:
    """Return what a run integrates: joints, forces, and the formulas of integrals."""
    return mechanism.joints, mechanism.forces, tuple(integral.of for integral in integrals(mechanism))


def _columns(table: Table) -> Iterator[Column]:
    return (Column(reading.name, unit, reading) for reading, unit in table.values())


def _driver(table: Table) -> Iterator[Column]:
    """Yield the columns of a driver: its only coordinate's rate has its short name."""
    return _columns({label: entry for label, entry in table.items() if not label.endswith(".rate")})


#: Table of a result -> its columns.
TABLES = {"points": points, "elements": elements, "outputs": outputs}

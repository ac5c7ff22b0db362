"""Directions of a run by name: parameters, values of the start, numbers of the method."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

from symgen.base.errors import InputError, quote
from symgen.describe.formulas.evaluate import hint_on_number
from symgen.describe.parts.holds import joint_quantity_names

if TYPE_CHECKING:
    from symgen.run.planning.prepare import Prepared


@dataclass(frozen=True)
class RunDirection:
    """A number that a run is differentiated by.

    Attributes
    ----------
    name : str
        Name as typed.
    unit : str
        Its unit.
    kind : {"parameter", "start", "method"}
        A parameter of the mechanism, a value that the start holds, or a parameter of the method.
    key : str
        Name of the parameter or of the quantity.
    """

    name: str
    unit: str
    kind: str
    key: str


def named_directions(run: Prepared, names: Mapping[str, str]) -> tuple[RunDirection, ...]:
    """Return the directions called `names`.

    Parameters
    ----------
    run : Prepared
        The run.
    names : mapping of str to str
        Parameters, inputs, coordinates and velocities of the start, parameters of the method: names as typed, each with
        its name in the mechanism, which differs for numbers of the file (`symgen.describe.facts.lifted`).

    Raises
    ------
    InputError
        If a name is unknown, means a number that varies during the run, or comes twice.
    """
    directions = list[RunDirection]()
    for name, key in names.items():
        direction = replace(_named(run, key), name=name)
        if any((direction.kind, direction.key) == (other.kind, other.key) for other in directions):
            raise InputError("sensitivities", "each number once", quote(name) + " twice")
        directions.append(direction)
    return tuple(directions)


def _named(run: Prepared, name: str) -> RunDirection:
    mechanism, (compiled, _) = run.plan.mechanism, run.assembled.of_bodies
    info, where = compiled.info, "sensitivities"
    parameters = {q.name: q.unit for q in info.parameters}
    varying = {input for seam in run.plan.seams for input in seam.values}
    if name in varying:
        raise InputError(where, "numbers that stay the same during the run", f"the input {quote(name)}, which varies")
    if name in parameters:
        return RunDirection(name, parameters[name], "parameter", name)
    quantities = {q.name: q.unit for q in (*info.coordinates, *info.velocities)}
    joints = {q.name: q.unit for q in info.joint_coordinates}
    joints |= {f"{name}.rate": f"{unit}/s" for name, unit in joints.items()}
    states = {x.name: x.unit for x in mechanism.states}
    own = joint_quantity_names(mechanism).get(name, name)
    euler = {info.coordinates[first + k].name for first, _ in info.spins for k in range(4)}
    for table in (quantities, joints, states):
        if own in table and own not in euler:
            return RunDirection(name, table[own], "start", own)
    laws = {key: "" for key, _ in compiled.law.parameters}
    if (key := name.removeprefix("method.")) in laws and key != name:
        return RunDirection(name, laws[key], "method", key)
    candidates = (*parameters, *(q for q in quantities if q not in euler), *joints, *states)
    candidates += tuple(f"method.{key}" for key in laws)
    expected = f"parameters or values of the start of {mechanism.name}"
    raise InputError(where, expected, quote(name), hint_on_number(mechanism, name, candidates))

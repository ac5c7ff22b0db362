"""Columns of a result by the names that data frames give them, from whatever tables have them."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from symgen.arguments import words
from symgen.describe.columns import PREFIX
from symgen.describe.outputs import TABLES as MEASURED
from symgen.errors import InputError, nearest
from symgen.result.acting import reaction_names
from symgen.result.contract import finite
from symgen.result.labelled import Labelled
from symgen.result.run_data import ENERGIES, TABLES, VIOLATIONS, accelerations_of

if TYPE_CHECKING:
    from symgen.describe.mechanism import Mechanism
    from symgen.result.run_data import RunData
    from symgen.runtime.compiled import ModelInfo


def select(result: RunData, names: Sequence[str]) -> Labelled:
    """Return columns called `names`, in this order.

    Parameters
    ----------
    result, names : RunData, sequence of str
        Of a run; of columns of a data frame, such as ``crank.theta``, ``lam.A.x``, ``spring.force`` or ``reach``, of a
        group, such as ``crank``, ``spring`` or ``energy``, or of a table, such as ``q`` or ``outputs``.

    Raises
    ------
    InputError
        If there is no such name; says the nearest one.
    """
    chosen = choose(_columns(result), names, result.mechanism)
    tables: dict[str, Labelled] = {table: getattr(result, table) for table in dict.fromkeys(chosen.values())}
    own = {column: (tables[table], column.removeprefix(PREFIX[table])) for column, table in chosen.items()}
    values = [table[name] for table, name in own.values()]
    stacked = np.column_stack(values) if values else np.zeros((len(result.t), 0))
    return Labelled(stacked, tuple(own), tuple(table.unit(name) for table, name in own.values()))


def choose(columns: Mapping[str, str], names: Sequence[str], mechanism: str) -> dict[str, str]:
    """Return the columns that names mean, with their tables.

    Parameters
    ----------
    columns : mapping of str to str
        All columns, with their tables.
    names : sequence of str
        See `select`.
    mechanism : str
        Its name, for the message.

    Raises
    ------
    InputError
        If there is no such name; says the nearest one.
    """
    chosen: dict[str, str] = {}
    for name in words("quantities", names):
        found = _named(columns, name)
        if not found:
            groups = {column.partition(".")[0] for column in columns}
            known = [*columns, *groups, *TABLES] if len(columns) <= 60 or "." in name else [*groups, *TABLES]
            expected = f"a quantity of {mechanism}"
            raise InputError(f"quantity '{name}'", expected, "none of that name", nearest(name, known))
        chosen |= found
    return chosen


def columns_of(mechanism: Mechanism, info: ModelInfo) -> dict[str, str]:
    """Return the names of all columns that any result of a model has, with their tables: known before a run.

    Parameters
    ----------
    mechanism : Mechanism
        What is run.
    info : ModelInfo
        Of its compiled model.
    """
    velocities = [velocity.name for velocity in info.velocities]
    parts, lengths = reaction_names(mechanism, info)
    names: dict[str, Iterable[str]] = {
        "q": [coordinate.name for coordinate in info.coordinates],
        "v": velocities,
        "a": accelerations_of(velocities),
        "lam": [row.name for row in info.rows],
        **{"reactions": parts, "body_reactions": parts, "magnitudes": lengths},
        "joint_coordinates": [name for q in info.joint_coordinates for name in (q.name, f"{q.name}.rate")],
        **{table: [column.name for column in columns(mechanism)] for table, columns in MEASURED.items()},
        **{"energy": ENERGIES, "violations": VIOLATIONS},
    }
    return {PREFIX[table] + name: table for table in TABLES for name in names[table]}


def extremes(table: Labelled) -> dict[str, dict[str, Any]]:
    """Return unit, last, smallest and largest value of each column, None where there is none."""
    found: dict[str, dict[str, Any]] = {}
    for i, (name, unit) in enumerate(zip(table.names, table.units, strict=True)):
        values = table.values[:, i]
        numbers = (values[-1], values.min(), values.max()) if len(values) else (math.nan,) * 3
        found[name] = {"unit": unit, **dict(zip(("final", "min", "max"), map(float, numbers), strict=True))}
    return {name: finite(entry) for name, entry in found.items()}


def _columns(result: RunData) -> dict[str, str]:
    """Return the names of all columns with their tables; nothing is generated for it."""
    found: dict[str, str] = {}
    for table in TABLES:
        found |= {PREFIX[table] + name: table for name in result.columns(table)}
    return found


def _named(columns: Mapping[str, str], name: str) -> dict[str, str]:
    """Return what a name means: a column, all columns of a body, element or prefix, or all of a table."""
    if name in columns:
        return {name: columns[name]}
    if name in TABLES:
        return {column: table for column, table in columns.items() if table == name}
    return {column: table for column, table in columns.items() if column.startswith(f"{name}.")}

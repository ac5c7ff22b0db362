"""Names of the columns of any run of a model, and what they come to."""

from __future__ import annotations

import math
from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

from symgen.describe.columns import PREFIX
from symgen.describe.readings import TABLES as MEASURED
from symgen.result.contract import finite
from symgen.result.labelled import Labelled
from symgen.result.reactions import reaction_names
from symgen.result.result import ENERGIES, TABLES, VIOLATIONS, accelerations_of

if TYPE_CHECKING:
    from symgen.describe.mechanism import Mechanism
    from symgen.runtime.compiled import ModelInfo


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
    parts, lengths = reaction_names({joint.name: joint.bodies[0] for joint in mechanism.joints}, info)
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
    entries: dict[str, dict[str, Any]] = {}
    for i, (name, unit) in enumerate(zip(table.names, table.units, strict=True)):
        values = table.values[:, i]
        numbers = (values[-1], values.min(), values.max()) if len(values) else (math.nan,) * 3
        entries[name] = {"unit": unit, **dict(zip(("final", "min", "max"), map(float, numbers), strict=True))}
    return {name: finite(entry) for name, entry in entries.items()}

"""Which quantities an ensemble keeps, and what its parts are called in data sets and tables.

Names are those of results and data frames. What a mechanism names gives way to what all have: a parameter may be called
``steps``, an output ``end``, and each run has numbers of these names besides.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

from symgen.describe.columns import PREFIX
from symgen.describe.mechanism import ACCELERATIONS
from symgen.errors import InputError, nearest
from symgen.result.reactions import multiplier_unit
from symgen.runtime import abi
from symgen.runtime import ensemble_abi as e

if TYPE_CHECKING:
    from symgen.ensemble.axes import Axis
    from symgen.runtime.compiled import ModelInfo


@dataclass(frozen=True)
class RowQuantity:
    """A named scalar over time: its unit, and the column of the outputs that it is."""

    name: str
    unit: str
    source: int
    column: int


def own_quantities(info: ModelInfo) -> tuple[RowQuantity, ...]:
    """Return all quantities that runs of a model can keep, those of bodies first."""
    quantities = [RowQuantity(q.name, q.unit, e.STATE, i) for i, q in enumerate(info.coordinates)]
    quantities += [RowQuantity(v.name, v.unit, e.STATE, info.nq + i) for i, v in enumerate(info.velocities)]
    for i, v in enumerate(info.velocities):
        body, _, component = v.name.rpartition(".")
        quantities.append(RowQuantity(f"{body}.{ACCELERATIONS[component]}", f"{v.unit}^2", e.ACCELERATION, i))
    for i, c in enumerate(info.joint_coordinates):
        name = PREFIX["joint_coordinates"] + c.name
        quantities.append(RowQuantity(name, c.unit, e.JOINT, 2 * i))
        quantities.append(RowQuantity(f"{name}.rate", f"{c.unit}/s", e.JOINT, 2 * i + 1))
    for i, row in enumerate(info.rows):
        quantities.append(RowQuantity(PREFIX["lam"] + row.name, multiplier_unit(row.unit), e.MULTIPLIER, i))
    quantities += [
        RowQuantity("energy.kinetic", "J", e.STATUS, abi.KINETIC),
        RowQuantity("energy.potential", "J", e.STATUS, abi.POTENTIAL),
        RowQuantity("energy.work", "J", e.STATE, info.work),
        RowQuantity("energy.total", "J", e.ENERGY, 0),
        RowQuantity("energy.error", "J", e.ENERGY_ERROR, 0),
        RowQuantity("violation.position", "m", e.STATUS, abi.PHI),
        RowQuantity("violation.velocity", "m/s", e.STATUS, abi.DRIFT),
        RowQuantity("smallest_pivot", "1", e.STATUS, abi.PIVOT),
    ]
    return tuple(quantities)


def choose_quantities(
    info: ModelInfo, names: Sequence[str] | None, measurable: Callable[[], Mapping[str, Sequence[RowQuantity]]]
) -> tuple[RowQuantity, ...]:
    """Return the quantities called `names`; coordinates and velocities where None are named.

    Parameters
    ----------
    info : ModelInfo
        The model.
    names : sequence of str or None
        ``crank.theta``; ``crank``, all coordinates and velocities of a body; ``q``, ``v``, ``energy``, ``violation``,
        ``joint``, ``lam``, all of a table; and names, tables and what names begin with of `measurable`.
    measurable : callable
        Returns what no loop leaves, by table (`symgen.ensemble.measures.measurable`); not called unless a name needs
        it.

    Raises
    ------
    InputError
        If there is none of a name; with the nearest one.
    """
    quantities = {q.name: q for q in own_quantities(info)}
    states = [q for q in quantities.values() if q.source == e.STATE and q.column < info.work]
    groups: dict[str, list[RowQuantity]] = {
        "q": [q for q in states if q.column < info.nq],
        "v": [q for q in states if q.column >= info.nq],
    }
    for q in quantities.values():
        table, dot, _ = q.name.partition(".")
        if dot and (q in states or table in ("energy", "violation", "joint", "lam")):
            groups.setdefault(table, []).append(q)
    requested = ("q", "v") if names is None else names
    if any(name not in quantities and name not in groups for name in requested):
        own = set(groups)
        for table, q in ((table, q) for table, further in measurable().items() for q in further):
            quantities.setdefault(q.name, q)
            parts = q.name.split(".")  # each name, its table, and all that names begin with, up to a dot
            for head in sorted({table, *(".".join(parts[:i]) for i in range(1, len(parts)))} - own):
                groups.setdefault(head, []).append(q)
    chosen: dict[str, RowQuantity] = {}
    for name in requested:
        if name in quantities:
            chosen[name] = quantities[name]
        elif name in groups:
            chosen.update({q.name: q for q in groups[name]})
        else:
            all_of_them = len(quantities) <= 60 or "." in name
            hint = nearest(name, [*groups, *(other for other in quantities if all_of_them or "." not in other)])
            raise InputError(f"quantity '{name}'", f"a quantity of {info.name}", "none of that name", hint)
    return tuple(chosen.values())


#: Numbers of every run that data sets hold: name -> (unit, whether it is a whole number).
NUMBERS: Mapping[str, tuple[str, bool]] = {
    "end": ("s", False),
    "steps": ("1", True),
    "rejected": ("1", True),
    "evaluations": ("1", True),
    "iterations": ("1", True),
    "position_violation_max": ("m", False),
    "velocity_violation_max": ("m/s", False),
    "energy_drift_max": ("J", False),
    "energy_jump": ("J", False),
    "energy_scale": ("J", False),
    "smallest_pivot": ("1", False),
    "rank_event_count": ("1", True),
    "start_moved": ("m or rad", False),
    "start_velocities": ("1", True),
    "redundant_rows": ("1", True),
    "light": ("1", True),
}
#: What numbers are called that have the name of a quantity.
_NUMBER = {"smallest_pivot": "smallest_pivot_min"}
_TAKEN = {"run", "time", "status", "reason", "warnings", *NUMBERS, *_NUMBER.values()}


def of_number(name: str) -> str:
    """Return the name of one of `NUMBERS`."""
    return _NUMBER.get(name, name)


def of_quantities(names: Sequence[str], axes: Iterable[Axis]) -> tuple[str, ...]:
    """Return the names of quantities: an output may have a name that is taken, or that of what varies."""
    taken = _TAKEN.difference(_NUMBER).union(of_varied(name, axis) for axis in axes for name in axis.values)
    labels = list[str]()
    for name in names:
        label = name
        while label in taken or (label != name and label in names):
            label = f"output.{label}"
        labels.append(label)
    return tuple(labels)


def of_varied(name: str, axis: Axis) -> str:
    """Return the label of a name that varies: that of its dimension, or where names vary together one like it."""
    label = axis.dimension if not axis.together else f"{name}(0)" if "." in name else name
    return f"parameter.{label}" if label in _TAKEN else label


def of_dimension(axis: Axis) -> str:
    """Return the name of a dimension."""
    return axis.dimension if axis.together else of_varied(next(iter(axis.values)), axis)


def event_columns(names: Sequence[str]) -> dict[str, tuple[int, str]]:
    """Return the numbers that each run leaves of events: name -> (column behind those of every ensemble, unit)."""
    first = e.N_SUMMARY + e.HEAD_OF_EVENTS
    return {
        f"event.{name}.{what}": (first + e.OF_EVENT * i + k, unit)
        for i, name in enumerate(names)
        for k, (what, unit) in enumerate(e.EVENT_COLUMNS)
    }

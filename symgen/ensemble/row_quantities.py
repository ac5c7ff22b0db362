"""Which quantities an ensemble keeps, by the names that results and data frames give them."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

from symgen.describe.columns import PREFIX
from symgen.describe.mechanism import ACCELERATIONS
from symgen.errors import InputError, nearest
from symgen.result.reactions import multiplier_unit
from symgen.runtime import abi
from symgen.runtime import ensemble_abi as e

if TYPE_CHECKING:
    from symgen.runtime.compiled import ModelInfo


@dataclass(frozen=True)
class RowQuantity:
    """A named scalar over time: its unit, and the column of the outputs that it is."""

    name: str
    unit: str
    source: int
    column: int


def known_quantities(info: ModelInfo) -> tuple[RowQuantity, ...]:
    """Return all quantities that runs of a model can keep, those of bodies first."""
    found = [RowQuantity(q.name, q.unit, e.STATE, i) for i, q in enumerate(info.coordinates)]
    found += [RowQuantity(v.name, v.unit, e.STATE, info.nq + i) for i, v in enumerate(info.velocities)]
    for i, v in enumerate(info.velocities):
        body, _, component = v.name.rpartition(".")
        found.append(RowQuantity(f"{body}.{ACCELERATIONS[component]}", f"{v.unit}^2", e.ACCELERATION, i))
    for i, c in enumerate(info.joint_coordinates):
        name = PREFIX["joint_coordinates"] + c.name
        found.append(RowQuantity(name, c.unit, e.JOINT, 2 * i))
        found.append(RowQuantity(f"{name}.rate", f"{c.unit}/s", e.JOINT, 2 * i + 1))
    for i, row in enumerate(info.rows):
        found.append(RowQuantity(PREFIX["lam"] + row.name, multiplier_unit(row.unit), e.MULTIPLIER, i))
    found += [
        RowQuantity("energy.kinetic", "J", e.STATUS, abi.KINETIC),
        RowQuantity("energy.potential", "J", e.STATUS, abi.POTENTIAL),
        RowQuantity("energy.work", "J", e.STATE, info.work),
        RowQuantity("energy.total", "J", e.ENERGY, 0),
        RowQuantity("energy.error", "J", e.ENERGY_ERROR, 0),
        RowQuantity("violation.position", "m", e.STATUS, abi.PHI),
        RowQuantity("violation.velocity", "m/s", e.STATUS, abi.DRIFT),
        RowQuantity("smallest_pivot", "1", e.STATUS, abi.PIVOT),
    ]
    return tuple(found)


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
        If a name is not known; says the nearest one.
    """
    known = {q.name: q for q in known_quantities(info)}
    states = [q for q in known.values() if q.source == e.STATE and q.column < info.work]
    groups: dict[str, list[RowQuantity]] = {
        "q": [q for q in states if q.column < info.nq],
        "v": [q for q in states if q.column >= info.nq],
    }
    for q in known.values():
        table, dot, _ = q.name.partition(".")
        if dot and (q in states or table in ("energy", "violation", "joint", "lam")):
            groups.setdefault(table, []).append(q)
    asked = ("q", "v") if names is None else names
    if any(name not in known and name not in groups for name in asked):
        _add(measurable(), known, groups)
    chosen: dict[str, RowQuantity] = {}
    for name in asked:
        if name in known:
            chosen[name] = known[name]
        elif name in groups:
            chosen.update({q.name: q for q in groups[name]})
        else:
            all_of_them = len(known) <= 60 or "." in name
            hint = nearest(name, [*groups, *(other for other in known if all_of_them or "." not in other)])
            raise InputError(f"quantity '{name}'", f"a quantity of {info.name}", "none of that name", hint)
    return tuple(chosen.values())


def _add(
    measurable: Mapping[str, Sequence[RowQuantity]], known: dict[str, RowQuantity], groups: dict[str, list[RowQuantity]]
) -> None:
    """Add what no loop leaves: each name, its table, and all that names begin with, up to a dot."""
    own = set(groups)
    for table, quantities in measurable.items():
        for q in quantities:
            known.setdefault(q.name, q)
            parts = q.name.split(".")
            heads = {".".join(parts[:i]) for i in range(1, len(parts))}
            for head in sorted({table, *heads} - own):
                groups.setdefault(head, []).append(q)

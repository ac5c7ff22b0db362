"""Which quantities an ensemble keeps, and what its parts are called in data sets and tables.

Names agree with results and data frames. Quantities of every run take precedence over equal names in the file: a
parameter may be called ``steps``, an output ``end``, and each run has numbers of these names besides.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import TYPE_CHECKING

from symgen.result.signals import TABLES, UNSWEPT, Signal, choose_columns, signals_of_run
from symgen.run.layout import abi
from symgen.run.layout import ensemble_abi as e

if TYPE_CHECKING:
    from symgen.describe.mechanism import Mechanism
    from symgen.run.layout.compiled import ModelInfo
    from symgen.study.ensemble.axes import Axis


#: How near an output is to a singular position: of the table of quantities, what results have as an attribute.
PIVOT = Signal("smallest_pivot", "smallest_pivot", "1", e.STATUS, abi.PIVOT)


def choose_quantities(mechanism: Mechanism, info: ModelInfo, names: Sequence[str] | None) -> tuple[Signal, ...]:
    """Return the quantities called `names`, as `symgen.result.motion_tables.Tables.select` takes them.

    Parameters
    ----------
    mechanism : Mechanism
        The mechanism of the runs.
    info : ModelInfo
        Its model.
    names : sequence of str or None
        None: coordinates and velocities.

    Raises
    ------
    InputError
        If there is none of a name; with the nearest one.
    """
    signals = (*(s for table in signals_of_run(mechanism, info).values() for s in table if s.source != UNSWEPT), PIVOT)
    by_name = {s.name: s for s in signals}
    tables = {name: s.table for name, s in by_name.items()}
    chosen = choose_columns(tables, ("q", "v") if names is None else names, info.name, (*TABLES,))
    return tuple(by_name[name] for name in chosen)


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


def check_number_name(name: str) -> str:
    """Return the name of one of `NUMBERS`."""
    return _NUMBER.get(name, name)


def dataset_names(names: Sequence[str], axes: Iterable[Axis]) -> tuple[str, ...]:
    """Return the names of quantities; an output may bear a name in use, or the name of what varies."""
    reserved_names = _TAKEN.difference(_NUMBER).union(
        label_of_varied(name, axis) for axis in axes for name in axis.values
    )
    labels = list[str]()
    for name in names:
        label = name
        while label in reserved_names or (label != name and label in names):
            label = f"output.{label}"
        labels.append(label)
    return tuple(labels)


def label_of_varied(name: str, axis: Axis) -> str:
    """Return the label of a name that varies: its dimension's, or where names vary together one like it."""
    label = axis.dimension if not axis.together else f"{name}(0)" if "." in name else name
    return f"parameter.{label}" if label in _TAKEN else label


def dimension_name(axis: Axis) -> str:
    """Return the name of a dimension."""
    return axis.dimension if axis.together else label_of_varied(next(iter(axis.values)), axis)


def event_columns(names: Sequence[str]) -> dict[str, tuple[int, str]]:
    """Return the numbers that each run leaves of events: name -> (column after the common ones, unit)."""
    first = e.N_SUMMARY + e.HEAD_OF_EVENTS
    return {
        f"event.{name}.{what}": (first + e.OF_EVENT * i + k, unit)
        for i, name in enumerate(names)
        for k, (what, unit) in enumerate(e.EVENT_COLUMNS)
    }

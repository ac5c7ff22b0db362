"""The table of quantities: what runs report over time, with names, units, and what each is computed from.

Results, sweeps, files, plots, pages and the option ``--quantity`` read their names here.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

from symgen.base.arguments import words
from symgen.base.errors import InputError, enumeration, quote, suggest
from symgen.base.vocabulary.measures import GROUND
from symgen.describe.coordinate_names import ACCELERATIONS
from symgen.describe.facts.carriers import bodies_of_reactions
from symgen.describe.formulas.formula_slips import meant_coordinate
from symgen.describe.formulas.reported_columns import TABLES as FORMULAS
from symgen.describe.parts.columns import column_name
from symgen.result.labelled import Array, Labelled
from symgen.run.layout import abi
from symgen.run.layout import ensemble_abi as e

if TYPE_CHECKING:
    from symgen.describe.mechanism import Mechanism
    from symgen.run.layout.compiled import ModelInfo

#: Quantities at most that a hint offers for one name.
MOST_OFFERED = 3
#: Table -> the dimension of its columns in data sets: tables of the state and of what follows from it, of forces, and
#: of the file's own quantities.
TABLES: Mapping[str, str] = {
    "q": "coordinate",
    "v": "velocity",
    "a": "acceleration",
    "lam": "multiplier",
    "reactions": "reaction",
    "body_reactions": "body_reaction",
    "magnitudes": "magnitude",
    "joint_coordinates": "joint_coordinate",
    "points": "point_coordinate",
    "elements": "element_quantity",
    "outputs": "output",
    "energy": "kind_of_energy",
    "violations": "level",
}
#: Source of columns that no loop of a sweep writes.
UNSWEPT = -1


@dataclass(frozen=True)
class Signal:
    """A scalar over time.

    Attributes
    ----------
    table : str
        The table of a result that it is a column of.
    key : str
        Its name in that table.
    unit : str
        Unit.
    source, column : int
        Its source, as in `symgen.run.layout.ensemble_abi`, and its place there.
    """

    table: str
    key: str
    unit: str
    source: int
    column: int

    @property
    def name(self) -> str:
        """Its name where all tables meet."""
        return column_name(self.table, self.key)


#: Tables by their names, and columns of one table: keys with units.
SignalTables = dict[str, tuple[Signal, ...]]
_Columns = Iterable[tuple[str, str]]


def signals_of_run(mechanism: Mechanism, info: ModelInfo) -> SignalTables:
    """Return all tables of a run.

    Parameters
    ----------
    mechanism : Mechanism
        The mechanism.
    info : ModelInfo
        Of its compiled model.
    """
    joints = [c for q in info.joint_coordinates for c in ((q.name, q.unit), (f"{q.name}.rate", f"{q.unit}/s"))]
    tables = {
        "q": _signals_of_table("q", ((q.name, q.unit) for q in info.coordinates), e.STATE),
        "v": _signals_of_table("v", ((v.name, v.unit) for v in info.velocities), e.STATE, info.nq),
        "a": _signals_of_table(
            "a", ((acceleration_name(v.name), f"{v.unit}^2") for v in info.velocities), e.ACCELERATION
        ),
        "joint_coordinates": _signals_of_table("joint_coordinates", joints, e.JOINT),
        **signals_of_forces(info, bodies_of_reactions(mechanism)),
        **signals_of_formulas(mechanism),
        "energy": (
            Signal("energy", "kinetic", "J", e.STATUS, abi.KINETIC),
            Signal("energy", "potential", "J", e.STATUS, abi.POTENTIAL),
            Signal("energy", "work", "J", e.STATE, info.work),
            Signal("energy", "total", "J", e.ENERGY, 0),
            Signal("energy", "error", "J", e.ENERGY_ERROR, 0),
        ),
        "violations": (
            Signal("violations", "position", "m", e.STATUS, abi.PHI),
            Signal("violations", "velocity", "m/s", e.STATUS, abi.DRIFT),
            Signal("violations", "acceleration", "m/s^2", UNSWEPT, 0),
        ),
    }
    return {table: tables[table] for table in TABLES}


def signals_of_forces(info: ModelInfo, bodies: Mapping[str, str]) -> SignalTables:
    """Return the tables of multipliers and reactions.

    A point mass, unlike the ground, takes no moment.

    Parameters
    ----------
    info : ModelInfo
        The model.
    bodies : mapping of str to str
        Joint -> its first body.
    """
    spatial = any(velocity.name.endswith(".vz") for velocity in info.velocities)
    sizes = Counter(velocity.name.rpartition(".")[0] for velocity in info.velocities)
    axes, moments = "xyz" if spatial else "xy", "xyz" if spatial else ("",)
    parts, lengths = list[tuple[str, str]](), list[tuple[str, str]]()
    for joint, body in bodies.items():
        turns = body == GROUND or sizes[body] > len(axes)
        parts += [(f"{joint}.F{axis}", "N") for axis in axes]
        parts += [(f"{joint}.M{axis}", "N m") for axis in moments if turns]
        lengths.append((f"{joint}.F", "N"))
        lengths += [(f"{joint}.T", "N m")] if turns and spatial else []
    return {
        "lam": _signals_of_table("lam", ((row.name, multiplier_unit(row.unit)) for row in info.rows), e.MULTIPLIER),
        "reactions": _signals_of_table("reactions", parts, e.REACTION),
        "body_reactions": _signals_of_table("body_reactions", parts, e.BODY_REACTION),
        "magnitudes": _signals_of_table("magnitudes", lengths, e.MAGNITUDE),
    }


def signals_of_formulas(mechanism: Mechanism) -> SignalTables:
    """Return the tables of points, force elements with drivers, and the file's own outputs."""
    return {
        table: _signals_of_table(table, ((c.name, c.unit) for c in columns(mechanism)), e.SIDE)
        for table, columns in FORMULAS.items()
    }


def _signals_of_table(table: str, columns: _Columns, source: int, first: int = 0) -> tuple[Signal, ...]:
    return tuple(Signal(table, key, unit, source, first + i) for i, (key, unit) in enumerate(columns))


def acceleration_name(velocity: str) -> str:
    """Return the name of the acceleration for the name of a velocity."""
    body, _, component = velocity.rpartition(".")
    return f"{body}.{ACCELERATIONS[component]}"


def acceleration_table(values: Array, velocities: Labelled) -> Labelled:
    """Return accelerations as a table, by the columns of the velocities."""
    units = tuple(f"{unit}^2" for unit in velocities.units)
    return Labelled(values, tuple(map(acceleration_name, velocities.names)), units)


def multiplier_unit(row_unit: str) -> str:
    """Return the unit of a multiplier whose row is measured in `row_unit`: lambda times the row is work or power."""
    return {"m": "N", "m/s": "N", "rad": "N m", "rad/s": "N m"}.get(row_unit, f"J/({row_unit})")


def fill_table(values: Array, signals: Sequence[Signal]) -> Labelled:
    """Return `values` as the table with these columns."""
    return Labelled(values, tuple(s.key for s in signals), tuple(s.unit for s in signals))


def check_single(name: str, columns: Iterable[str]) -> None:
    """Refuse to draw over what is several columns."""
    several = [*columns]
    if len(several) != 1:
        raise InputError("over", "one column", f"{quote(name)}, which is {len(several)}", ", ".join(several[:6]))


def _hint_on_owner(name: str, columns: Iterable[str]) -> str:
    """Return the hint on a quantity whose owner is left out, or that a textbook calls otherwise; else nothing."""
    if name.lower() in ("time", "seconds"):
        return "the time is 't', which stands beside all others"
    parts = [column.split(".") for column in columns]
    whole = dict.fromkeys(".".join(part[:i]) for part in parts for i in range(2, len(part) + 1))
    owned = [each for each in whole if each.endswith(f".{name}")][:MOST_OFFERED]
    if owned:
        return f"did you mean {enumeration([quote(each) for each in owned], 'or')}?"
    owner, _, last = name.rpartition(".")
    own = [each.removeprefix(f"{owner}.") for each in whole if each.startswith(f"{owner}.")]
    near = suggest(last, own).replace("did you mean '", f"did you mean '{owner}.").replace("known:", f"{owner} has")
    return meant_coordinate(owner, last, own) or near if own else ""


def choose_columns(
    columns: Mapping[str, str], names: Sequence[str], mechanism: str, tables: Sequence[str] = ()
) -> dict[str, str]:
    """Return the columns that names mean, with their tables.

    Parameters
    ----------
    columns : mapping of str to str
        All columns, with their tables.
    names : sequence of str
        Columns, all columns of a body, a joint, a force or another head (``crank``, ``multiplier``), or tables.
    mechanism : str
        Its name, for the message.
    tables : sequence of str
        Tables that may be named although they have no columns.

    Raises
    ------
    InputError
        If there is no such name; says the nearest one.
    """
    chosen, groups = dict[str, str](), dict.fromkeys((*columns.values(), *tables))
    for name in words("quantities", names):
        if name in columns:
            matches = {name: columns[name]}
        elif name in groups:
            matches = {column: table for column, table in columns.items() if table == name}
        else:
            matches = {column: table for column, table in columns.items() if column.startswith(f"{name}.")}
        if not matches and name not in tables:
            groups |= dict.fromkeys(column.partition(".")[0] for column in columns)
            candidates = [*columns, *groups] if len(columns) <= 60 or "." in name else [*groups]
            hint = _hint_on_owner(name, columns) or suggest(name, candidates)
            raise InputError(f"quantity {quote(name)}", f"a quantity of {mechanism}", "none of that name", hint)
        chosen |= matches
    return chosen

"""Messages on a start: changed coordinates, probable mistakes, and reasons for a failure."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from symgen.base.errors import AssemblyError, InputError, fit_lines
from symgen.run.layout import abi
from symgen.run.layout import ensemble_abi as e
from symgen.run.layout.model_arrays import joints_of_rows
from symgen.run.layout.probe import Ready
from symgen.run.starts import decisions
from symgen.run.starts.held import Held

if TYPE_CHECKING:
    from symgen.run.layout.compiled import CompiledModel, ModelInfo

Array = NDArray[np.float64]


#: Largest number of changed coordinates listed one by one.
_LISTED = 6
#: Advice where nothing is free.
OTHER_WAYS = (
    "where drivers leave nothing free, the analysis kinematics finds other ways to close it from another `start`, and "
    "all coordinates of one of them can be held"
)


@dataclass(frozen=True)
class StartChange:
    """A coordinate or set velocity changed to make a start consistent: as described, and at the start."""

    name: str
    unit: str
    before: float
    after: float


def changes_of(info: ModelInfo, described: Array, y: Array, scales: Array) -> tuple[StartChange, ...]:
    """Return the noticeable differences from the description, whose free velocities are nan."""
    quantities = (*info.coordinates, *info.velocities)
    return tuple(
        StartChange(quantities[i].name, quantities[i].unit, float(described[i]), float(y[i]))
        for i in np.flatnonzero(np.abs(y[: len(scales)] - described) > decisions.MOVED * scales)
    )


def warnings_of(
    changes: Sequence[StartChange], info: ModelInfo, length: float, moved: Iterable[tuple[str, float, str]] = ()
) -> tuple[str, ...]:
    """Return a sentence if closing moved bodies by a large part of the mechanism, or turned them far.

    Parameters
    ----------
    changes : sequence of StartChange
        Of the coordinates.
    info : ModelInfo
        The model.
    length : float
        The mechanism's [m].
    moved : iterable of (str, float, str)
        Further points and angles of bodies: name, change, and its unit.
    """
    names = {quantity.name for quantity in info.coordinates}
    limits = {"m": decisions.FAR * length, "rad": decisions.FAR_TURNED, "1": 0.5 * decisions.FAR_TURNED}
    far = [c for c in changes if c.name in names and abs(c.after - c.before) > limits[c.unit]]
    moves, bodies = ([_list_changes(far)] if far else []), {c.name.rpartition(".")[0] for c in far}
    for name, size, unit in moved:  # of each body the coordinates, or else the first of its points
        if size > limits[unit] and name.partition(".")[0] not in bodies:
            bodies.add(name.partition(".")[0])
            moves.append(f"{name} by {size:.6g} {unit}")
    if not moves:
        return ()
    return (f"closing the initial positions moved bodies far from where they are described: {'; '.join(moves)}",)


def notes_of(held: Held, summary: Array, changes: Sequence[StartChange], info: ModelInfo) -> tuple[str, ...]:
    """Return the changes, one sentence each; held coordinates have another sentence."""
    notes = list[str]()
    names = {quantity.name for quantity in info.coordinates}
    positions = [change for change in changes if change.name in names]
    if held.coordinates or held.joints:
        own = {info.coordinates[i].name for i in held.coordinates}
        follow = _list_changes([change for change in positions if change.name not in own])
        notes.append(f"the start holds {held.positions(info)}" + (f"; {follow}" if follow else ""))
    elif positions:
        notes.append(
            f"described positions leave joints open, which the shortest changes close: {_list_changes(positions)}"
        )
    if summary[e.START_VELOCITIES]:
        speeds = (change for change in changes if change.name not in names)
        largest = max(speeds, key=lambda change: abs(change.after - change.before), default=None)
        what = "" if largest is None else f"; {largest.name} changed from {_from_to(largest)}"
        notes.append(
            f"initial velocities contradicted the constraints and were projected in the metric of the mass matrix{what}"
        )
    return tuple(notes)


def opposite_sentence(joint: str) -> str:
    """Return the sentence about a joint whose axes are one line, but not one direction."""
    return f"the axes of joint '{joint}' point opposite ways at the start: they are taken for one line"


def _list_changes(changes: Sequence[StartChange]) -> str:
    """Return the first changes one by one, and the number of others."""
    first = fit_lines(len(changes), _LISTED)
    words = "; ".join(f"{c.name} from {_from_to(c)}" for c in changes[:first])
    return words + (f"; and {len(changes) - first} more" if len(changes) > first else "")


def _from_to(change: StartChange) -> str:
    """Return both values with enough digits to distinguish them."""
    for digits in range(6, 18):
        before, after = f"{change.before:.{digits}g}", f"{change.after:.{digits}g}"
        if before != after:
            break
    return f"{before} to {after} {change.unit}".removesuffix(" 1")  # Euler parameters are numbers


class UndeterminedError(InputError):
    """Nothing determines the acceleration of a massless body, which is the attribute `body`."""

    body = ""

    @classmethod
    def of(cls, body: str, name: str) -> UndeterminedError:
        """Return the error for a body that is free to move in a velocity."""
        got = f"a massless body that is free to move in {name}: nothing determines its acceleration"
        error = cls(f"body '{body}'", "a mass, or joints that hold it", got)
        error.body = body
        return error

    def with_hint(self, hint: str) -> UndeterminedError:
        """Return the error with a remedy."""
        return type(self)(self.where, self.expected, self.got, hint)


def start_refusal(summary: Array, info: ModelInfo, held: Held | None = None) -> AssemblyError | InputError:
    """Return the error of a run without a start.

    Parameters
    ----------
    summary : Array, shape (N_SUMMARY,)
        Summary of the start; see `symgen.run.layout.ensemble_abi`.
    info : ModelInfo
        The model.
    held : Held, optional
        Held coordinates.
    """
    code, where, size = int(summary[e.START]), int(summary[e.START_WHERE]), float(summary[e.START_SIZE])
    if code == e.UNDEFINED:
        return InputError("parameters or start", "values for which every formula is finite", "others")
    if code == e.NO_MASS:
        body = info.velocities[where].name.rpartition(".")[0]
        return InputError(f"parameters: mass or inertia of {body}", "a value above 0", f"{size:g}")
    if code == e.UNDETERMINED:
        body, _, name = info.velocities[where].name.rpartition(".")
        return UndeterminedError.of(body, name)
    if code == e.OPEN and size == 0.0 and held:
        return AssemblyError(
            f"{info.name}: closing does not reach {held.positions(info)}, which the start holds, though all joints are "
            "closed; choose a value that bodies can reach from where they are described"
        )
    if code == e.OPEN:
        return _stays_open(info, held or Held(), joints_of_rows(info)[where], size)
    if code == e.CONTRADICTION:
        speeds = held.speeds(info) if held else ""
        beside = f" together with {speeds}, which the start holds" if speeds else ""
        return AssemblyError(
            f"{info.name}: no velocities satisfy the constraints{beside}; drivers or conditions contradict each other"
        )
    if code == e.HALF_TURN:
        return half_turn(info, joints_of_rows(info)[where])
    if code == e.TURNED_OVER:
        return turned_over_error(info, where)
    reason = "given velocities contradicted by the constraints"
    if code == e.MOVED:
        reason = f"positions that closing moves by up to {float(summary[e.START_MOVED]):.3g}"
    return InputError("initial state", "a consistent start (`strict`)", reason)


def _stays_open(info: ModelInfo, held: Held, joint: str, size: float) -> AssemblyError:
    """Return the error where a joint stays open by a size, in the units of its rows."""
    units = " or ".join(dict.fromkeys(row.unit for row in info.rows if row.joint == joint))
    described = held.described_words(info)
    holds = [words for words in (held.positions(info), f"{described} as described" if described else "") if words]
    what = f" with {' and '.join(holds)} held" if holds else ""
    # joints and drivers may leave nothing free, so that a coordinate has one of a few values
    ways = f"; {OTHER_WAYS}" if holds and info.m >= info.nv else ""
    return AssemblyError(
        f"{info.name}: the mechanism cannot be assembled from this start{what}: joint '{joint}' stays open by "
        f"{size:.3g} {units}; check its points, the positions of the bodies it joins, and whether the links are long "
        f"enough to meet at all{ways}",
        (joint,),
    )


def half_turn(info: ModelInfo, joint: str) -> AssemblyError:
    """Return the error where a joint holds a body the wrong way round."""
    return AssemblyError(
        f"{info.name}: joint '{joint}' closes half a turn from where its directions coincide, as that is "
        "nearer to the described start; describe how the bodies that it joins are turned",
        (joint,),
    )


def turned_over_error(info: ModelInfo, spin: int) -> AssemblyError:
    """Return the error where joint coordinates turn over a body, one of those in `info.spins`."""
    body = info.coordinates[info.spins[spin][0]].name.rpartition(".")[0]
    return AssemblyError(
        f"{info.name}: in joint coordinates '{body}' would start turned over, as directions of a joint that "
        "shall coincide point opposite ways there; describe how bodies are turned at the start, give one of "
        "the directions the opposite sign, or use absolute coordinates"
    )


def without_derivative(compiled: CompiledModel, q: Array, p: Array) -> AssemblyError | None:
    """Return the error on a joint without derivative at the described start, None for others; p is prepared."""
    info = compiled.info
    y, w = np.zeros(info.ny), compiled.scratch()
    y[: info.nq] = q
    if not np.all(np.isfinite(p)):
        return None
    with np.errstate(all="ignore"):
        try:
            Ready(compiled.model.masses, abi.MOVE)(p, w)
            Ready(compiled.model.geometry, abi.MEASURE)(0.0, y, p, w)
        except (ArithmeticError, ValueError):  # where nothing is compiled
            return None
    lengths = np.abs(compiled.jacobian(w)).sum(axis=1)
    open_rows = ~(np.abs(compiled.section(w, "residual")) <= decisions.MOVED)
    for row in np.flatnonzero(~np.isfinite(lengths) | (open_rows & (lengths == 0.0))):
        return AssemblyError(
            f"{info.name}: joint '{info.rows[row].joint}' cannot be closed from this start: its row "
            f"{info.rows[row].name} has no derivative there, as where points meet that it keeps apart or a disc lies "
            "flat on its plane; describe another start",
            (info.rows[row].joint,),
        )
    return None

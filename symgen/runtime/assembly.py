"""Consistent starts: positions closed by shortest changes, velocities completed by least squares.

`Assembly` says what the one start (`symgen.runtime.starting`) has to know of a compiled model; `assemble` makes the
start of a single run, `Assembly.close` those of the rows of a sweep.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from symgen.errors import AssemblyError, InputError
from symgen.ir.numerics import SKIP
from symgen.runtime import abi, decisions
from symgen.runtime import ensemble_abi as e
from symgen.runtime.exact import compiled_form, plain_form
from symgen.runtime.least_norm import dense_change, sparse_change
from symgen.runtime.manifold import stay
from symgen.runtime.probe import Ready
from symgen.runtime.start_records import Asked, Instant, Layout, new_work
from symgen.runtime.starting import close_row, close_rows, follow_nothing, prepare_rows
from symgen.runtime.turning import choose_no_turns, choose_turns

if TYPE_CHECKING:
    from symgen.model import CompiledModel, ModelInfo

Array = NDArray[np.float64]
Integers = NDArray[np.int64]

_START, _MOVED, _VELOCITIES = (e.SUMMARY.index("start" + end) for end in ("", "_moved", "_velocities"))
_WHERE, _SIZE, _LIGHT = e.SUMMARY.index("start_where"), e.SUMMARY.index("start_size"), e.SUMMARY.index("light")

#: Changed coordinates that a note tells one by one.
_TOLD = 6


@dataclass(frozen=True)
class Change:
    """A coordinate or given velocity that was changed to make a start consistent.

    Attributes
    ----------
    name, unit : str
        What it is.
    before, after : float
        As described, and at the start.
    """

    name: str
    unit: str
    before: float
    after: float


@dataclass(frozen=True)
class Held:
    """What a start keeps at values of its own while everything else gives way.

    Attributes
    ----------
    coordinates : mapping of int to float
        Values by index in q, Euler parameters excepted. They are reached in small steps from the described start.
    velocities : mapping of int to float
        Values by index in v. They are not projected where they contradict other given ones.
    """

    coordinates: Mapping[int, float] = field(default_factory=dict)
    velocities: Mapping[int, float] = field(default_factory=dict)


@dataclass(frozen=True)
class Start:
    """A consistent start.

    Attributes
    ----------
    y : Array, shape (ny,)
        State q, v and work 0.
    p, w : Array
        Parameters and scratch, prepared: scales and the mask of redundant rows are set.
    rank : int
        Rank of D at the start.
    redundant_rows : tuple of str
        Rows that depend on others at the start and near it.
    notes : tuple of str
        What was changed to make the start consistent, one sentence each.
    changes : tuple of Change
        The same as data, positions before velocities.
    light : bool
        Whether a pivot of S is suspiciously small although D D^T finds no row dependent; False where nobody asked.
    warnings : tuple of str
        What was changed by so much that another motion may have been meant.
    """

    y: Array
    p: Array
    w: Array
    rank: int
    redundant_rows: tuple[str, ...]
    notes: tuple[str, ...]
    changes: tuple[Change, ...] = ()
    light: bool = False
    warnings: tuple[str, ...] = ()


@dataclass(frozen=True)
class Assembly:
    """The one start of a compiled model.

    Attributes
    ----------
    compiled : CompiledModel
        Model and method.
    layout : Layout
        See `symgen.runtime.start_records`.
    strict : bool
        Whether a start that has to be changed is refused.
    """

    compiled: CompiledModel
    layout: Layout
    strict: bool

    @classmethod
    def of(
        cls,
        compiled: CompiledModel,
        held: Sequence[int] = (),
        kept: Sequence[int] = (),
        strict: bool = False,
        ask_light: bool = False,
    ) -> Assembly:
        """Return the start of a model.

        Parameters
        ----------
        compiled : CompiledModel
            Model and method.
        held, kept : sequence of int
            Coordinates and velocities that are held.
        strict, ask_light : bool
            Whether a start that has to be changed is refused; whether it shall be said if bodies are too light for the
            law's solver.
        """
        info, joints = compiled.info, joints_of(compiled.info)
        sparse = compiled.sparse and info.m * info.nv > decisions.LARGEST_DENSE
        numbers = (
            *(0.0, info.nq, info.nv, info.m, info.windings),
            *(int(sparse), int(ask_light and hasattr(compiled.law_module, "confirm"))),
            *(info.sections[name][0] for name in Layout._fields[7:16]),
        )
        arrays = (
            *entries_of(info),
            np.isin(np.arange(info.nv), info.massless).astype(np.int64),
            np.isin(np.arange(info.nv), kept).astype(np.int64),
            np.array([(i, velocity_of(i, info)) for i in held], dtype=np.int64).ravel(),
            np.array([(joints.index(row.joint), row.unit != "rad") for row in info.rows], dtype=np.int64).ravel(),
            np.array(_spins(info), dtype=np.int64),
            lengths_of(info),
        )
        layout = Layout._make((*numbers, *arrays))
        return cls(compiled, layout, strict)

    def close_all(self, now: Instant, asked: Asked, selected: Integers, control: Integers) -> int:
        """Make the selected rows consistent, in compiled code.

        Parameters
        ----------
        now, asked : Instant, Asked
            Of all rows, one row of a matrix for each: described coordinates, and parameters not yet prepared.
        selected, control : Array of int
            Rows to work on; what the watching thread shares.

        Returns
        -------
        int
            Rows that were worked on.
        """
        (ys, ps, ws), model, law = (array.ravel() for array in now), self.compiled.model, self.compiled.law_module
        scratch = self.compiled.scratch()
        compiled_form(prepare_rows)(model.prepare, law.prepare, model.masses, scratch, ps, ws, len(now.y), selected)
        geometry, measure, move, _, *others = self._functions
        flat = Asked(*(array.ravel() for array in asked))
        work, start = new_work(self.layout, now.w.shape[1]), compiled_form(close_rows)
        functions = (compiled_form(f) for f in (geometry, measure, move, *others))
        described = now.y.copy() if self.strict else now.y
        done = int(start(*functions, self.layout, Instant(ys, ps, ws), flat, work, selected, control))
        self._judge(now.w, asked.summary, described)
        return done

    def close_one(self, now: Instant, asked: Asked) -> int:
        """Make one start consistent, in place; return `symgen.runtime.ensemble_abi.ASSEMBLED` or why there is none."""
        model, law, functions = self.compiled.model, self.compiled.law_module, self._functions
        described = now.y.copy()
        with np.errstate(all="ignore"):  # undefined numbers are nan or infinite in compiled code, without a warning
            try:
                for module in (model, law):
                    Ready(module.prepare, e.PREPARE)(now.p)
                Ready(model.masses, abi.MOVE)(now.p, now.w)
            except (ArithmeticError, ValueError):  # and errors where nothing is compiled
                now.p[:] = np.nan
            m, n, form = self.layout.m, self.layout.nv, compiled_form
            if not self.layout.sparse and m * n * min(m, n) <= decisions.LARGEST_INTERPRETED:
                geometry, measure, move, spread, solve, turns, rhs = (plain_form(f) for f in functions)
                measures = Ready(geometry, abi.MEASURE), Ready(measure, abi.MEASURE)
                functions = (*measures, Ready(move, abi.MOVE), spread, solve, turns, Ready(rhs, abi.RHS))
                form = plain_form
            work = new_work(self.layout, len(now.w))
            try:
                form(close_row)(*(form(f) for f in functions), self.layout, now, asked, work)
            except (ArithmeticError, ValueError):
                asked.summary[_START] = e.UNDEFINED
        self._judge(now.w[np.newaxis], asked.summary[np.newaxis], described[np.newaxis])
        return int(asked.summary[_START])

    def _judge(self, ws: Array, summaries: Array, described: Array) -> None:
        """Name the joint that stays open most; refuse starts that were changed, where that is asked for."""
        info = self.compiled.info
        for r in np.flatnonzero(summaries[:, _START] == e.OPEN):
            joints, residual = joints_of(info), np.nan_to_num(self.compiled.section(ws[r], "residual"), nan=np.inf)
            squares = np.bincount([joints.index(row.joint) for row in info.rows], residual**2)
            summaries[r, _WHERE], summaries[r, _SIZE] = np.argmax(squares), np.sqrt(squares.max())
        if self.strict:
            good = summaries[:, _START] == e.ASSEMBLED
            moved = good & (summaries[:, _MOVED] > 0.0) & (not len(self.layout.held))
            summaries[good & (summaries[:, _VELOCITIES] == 1.0), _START] = e.PROJECTED
            summaries[moved, _START] = e.MOVED

    @property
    def _functions(self) -> tuple[Any, ...]:
        """What `close_row` takes: geometry, measure, move, spread, solve, turns, rhs."""
        model, law, layout = self.compiled.model, self.compiled.law_module, self.layout
        return (
            model.geometry,
            model.measure if layout.windings else follow_nothing,
            model.move if layout.nq != layout.nv else stay,
            model.spread if layout.sparse else stay,
            sparse_change if layout.sparse else dense_change,
            choose_turns if layout.windings else choose_no_turns,
            law.rhs,
        )


def state_scales(compiled: CompiledModel, w: Array, until: float) -> Array:
    """Return what coordinates and velocities are compared with: the scales that a run settles at its beginning.

    Parameters
    ----------
    compiled : CompiledModel
        Model and method.
    w : Array
        Scratch that a start has left.
    until : float
        End of the run [s].

    Returns
    -------
    Array, shape (nq + nv,)
        The mechanism's length for lengths, 1 for angles and numbers, its speed, and that over a body's length.
    """
    length = float(w[abi.LENGTH])
    speed = max(float(w[abi.SPEED]), length / until)
    positions = np.where(lengths_of(compiled.info) == 1.0, length, 1.0)
    return np.concatenate([positions, speed * np.sqrt(compiled.section(w, "gauge"))])


def entries_of(info: ModelInfo) -> tuple[Integers, Array]:
    """Return (row, column, slot or -1) of D's structural entries, flat, and their values where they have no slot."""
    places = [(row, column, -1 if slot is None else slot) for row, column, _, slot in info.jacobian]
    constants = [constant or 0.0 for _, _, constant, _ in info.jacobian]
    return np.array(places, dtype=np.int64).ravel(), np.array(constants, dtype=np.float64)


def lengths_of(info: ModelInfo) -> Array:
    """Return 1 for coordinates that are lengths, else 0."""
    return np.array([quantity.unit == "m" for quantity in info.coordinates], dtype=np.float64)


def _spins(info: ModelInfo) -> list[int]:
    """Return the body's first angular velocity for each angular velocity, -1 for others."""
    found = [j if quantity.unit == "rad/s" else -1 for j, quantity in enumerate(info.velocities)]
    for _, first in info.spins:
        found[first : first + 3] = [first] * 3
    return found


def joints_of(info: ModelInfo) -> list[str]:
    """Return the joints that have rows, in their order."""
    return list(dict.fromkeys(row.joint for row in info.rows))


def velocity_of(coordinate: int, info: ModelInfo) -> int:
    """Return the velocity that changes a coordinate which is none of the Euler parameters."""
    return coordinate - sum(1 for first, _ in info.spins if first < coordinate)


def assemble(
    compiled: CompiledModel,
    q: Array,
    v: Sequence[float | None],
    p: Array,
    strict: bool = False,
    held: Held | None = None,
    ask_light: bool = False,
) -> Start:
    """Return the consistent start of a single run.

    Positions: ``dv = -D^+ Phi``, ``q <- q + N dv`` with the Moore-Penrose inverse until ``|Phi|`` is at rounding.
    Velocities: the given ones are kept and the others are the smallest that satisfy ``D v = nu``; where the given ones
    contradict the constraints, all are projected in the metric of the mass matrix.

    Parameters
    ----------
    compiled : CompiledModel
        Model and method.
    q : Array, shape (nq,)
        Approximate coordinates.
    v : sequence of float or None, length nv
        Given velocities; None where they are to be completed.
    p : Array
        Parameters, not yet prepared.
    strict : bool
        Refuse a start that is not consistent instead of changing it.
    held : Held, optional
        Coordinates and velocities that have values of their own.
    ask_light : bool
        Whether the start shall say if bodies are too light for the law's solver.

    Raises
    ------
    AssemblyError
        If the mechanism stays open, or a row has no derivative at the described start; says at which joint.
    InputError
        If `strict` and the start had to be changed; if a mass is not positive, a formula is not finite, or nothing
        determines the accelerations of a massless body.
    """
    info, fixed = compiled.info, held or Held()
    assembly = Assembly.of(compiled, tuple(fixed.coordinates), tuple(fixed.velocities), strict, ask_light)
    described = np.array([np.nan if x is None else x for x in v], dtype=np.float64)
    described[list(fixed.velocities)] = list(fixed.velocities.values())
    y, w = np.zeros(info.ny), compiled.scratch()
    y[: info.nq] = q
    targets = np.array(list(fixed.coordinates.values()), dtype=np.float64)
    asked = Asked(described, targets, np.zeros(e.N_SUMMARY))
    if assembly.close_one(Instant(y, p, w), asked) != e.ASSEMBLED:
        raise _without_derivative(compiled, q, p) or refusal(asked.summary, info)
    changes = _changes(info, np.concatenate([q, described]), y, state_scales(compiled, w, math.inf))
    moved = None if fixed.coordinates else asked.summary[_MOVED]
    return Start(
        *(y, p, w, int(np.sum(compiled.section(w, "pivot") >= SKIP))),
        redundant_rows=tuple(info.rows[i].name for i in np.flatnonzero(compiled.section(w, "mask"))),
        notes=_notes(moved, asked.summary, changes, info),
        changes=changes,
        light=bool(asked.summary[_LIGHT]),
        warnings=() if moved is None else _warnings(changes, info, float(w[abi.LENGTH])),
    )


def _without_derivative(compiled: CompiledModel, q: Array, p: Array) -> AssemblyError | None:
    """Return which joint has no derivative at the described start, where that is why there is none; p is prepared."""
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
            "flat on its plane; describe another start"
        )
    return None


def _changes(info: ModelInfo, described: Array, y: Array, scales: Array) -> tuple[Change, ...]:
    """Return what differs noticeably from what was described; velocities that were not given are nan there."""
    quantities = (*info.coordinates, *info.velocities)
    return tuple(
        Change(quantities[i].name, quantities[i].unit, float(described[i]), float(y[i]))
        for i in np.flatnonzero(np.abs(y[: len(scales)] - described) > decisions.MOVED * scales)
    )


def _warnings(changes: Sequence[Change], info: ModelInfo, length: float) -> tuple[str, ...]:
    """Return a sentence where closing moved a body by a large part of the mechanism, or turned it far."""
    names = {quantity.name for quantity in info.coordinates}
    limits = {"m": decisions.FAR * length, "rad": decisions.FAR_TURNED, "1": 0.5 * decisions.FAR_TURNED}
    far = [c for c in changes if c.name in names and abs(c.after - c.before) > limits[c.unit]]
    if not far:
        return ()
    told = "; ".join(f"{c.name} from {c.before:.6g} to {c.after:.6g} {c.unit}" for c in far[:_TOLD])
    more = f"; and {len(far) - _TOLD} more" if len(far) > _TOLD else ""
    return (f"closing the initial positions moved bodies far from where they are described: {told}{more}",)


def _notes(moved: float | None, summary: Array, changes: Sequence[Change], info: ModelInfo) -> tuple[str, ...]:
    """Return what was changed, one sentence each."""
    notes = list[str]()
    names = {quantity.name for quantity in info.coordinates}
    positions = [change for change in changes if change.name in names]
    if moved is not None and positions:
        told = "; ".join(
            f"{change.name} from {change.before:.6g} to {change.after:.6g} {change.unit}"
            for change in positions[:_TOLD]
        )
        more = f"; and {len(positions) - _TOLD} more" if len(positions) > _TOLD else ""
        notes.append(f"initial positions were closed by the shortest changes: {told}{more}")
    if summary[_VELOCITIES]:
        largest = max(
            (change for change in changes if change.name not in names),
            key=lambda change: abs(change.after - change.before),
            default=None,
        )
        what = (
            ""
            if largest is None
            else (f"; {largest.name} changed from {largest.before:.6g} to {largest.after:.6g} {largest.unit}")
        )
        notes.append(
            f"initial velocities contradicted the constraints and were projected in the metric of the mass matrix{what}"
        )
    return tuple(notes)


def refusal(summary: Array, info: ModelInfo) -> AssemblyError | InputError:
    """Return why a run has no start.

    Parameters
    ----------
    summary : Array, shape (N_SUMMARY,)
        What the start left; see `symgen.runtime.ensemble_abi`.
    info : ModelInfo
        The model.
    """
    code, where, size = int(summary[_START]), int(summary[_WHERE]), float(summary[_SIZE])
    if code == e.UNDEFINED:
        return InputError("parameters or start", "values for which every formula is finite", "others")
    if code == e.NO_MASS:
        body = info.velocities[where].name.split(".")[0]
        return InputError(f"parameters: mass or inertia of {body}", "a value above 0", f"{size:g}")
    if code == e.UNDETERMINED:
        body, _, name = info.velocities[where].name.partition(".")
        return InputError(
            f"body '{body}'",
            "a mass, or joints that hold it",
            f"a massless body that is free to move in {name}: nothing determines its acceleration",
        )
    if code == e.OPEN:
        joint = joints_of(info)[where]
        return AssemblyError(
            f"{info.name}: the mechanism cannot be assembled from this start: joint '{joint}' stays open by "
            f"{size:.3g} m or rad; check its points and the positions of the bodies it joins"
        )
    if code == e.CONTRADICTION:
        return AssemblyError(
            f"{info.name}: no velocities satisfy the constraints; drivers or conditions contradict each other"
        )
    found = "given velocities contradicted by the constraints"
    if code == e.MOVED:
        found = f"positions that closing moves by up to {float(summary[_MOVED]):.3g}"
    return InputError("initial state", "a consistent start (--strict)", found)

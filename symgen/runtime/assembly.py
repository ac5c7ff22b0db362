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

from symgen.ir.numerics import SKIP
from symgen.runtime import abi, decisions
from symgen.runtime import ensemble_abi as e
from symgen.runtime.exact import compiled_form, plain_form
from symgen.runtime.least_norm import dense_change, sparse_change
from symgen.runtime.manifold import stay
from symgen.runtime.model_arrays import entries_of, joints_of, lengths_of, spins_of, velocity_of
from symgen.runtime.probe import Ready
from symgen.runtime.start_records import Asked, Instant, Layout, new_work
from symgen.runtime.start_words import Change, changes_of, notes_of, refusal, warnings_of, without_derivative
from symgen.runtime.starting import close_row, close_rows, follow_nothing, prepare_rows
from symgen.runtime.turning import choose_no_turns, choose_turns

if TYPE_CHECKING:
    from symgen.runtime.compiled import CompiledModel

Array = NDArray[np.float64]
Integers = NDArray[np.int64]

_START, _MOVED, _VELOCITIES = (e.SUMMARY.index("start" + end) for end in ("", "_moved", "_velocities"))
_WHERE, _SIZE, _LIGHT = e.SUMMARY.index("start_where"), e.SUMMARY.index("start_size"), e.SUMMARY.index("light")


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
            np.array(spins_of(info), dtype=np.int64),
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
        raise without_derivative(compiled, q, p) or refusal(asked.summary, info)
    changes = changes_of(info, np.concatenate([q, described]), y, state_scales(compiled, w, math.inf))
    moved = None if fixed.coordinates else asked.summary[_MOVED]
    return Start(
        *(y, p, w, int(np.sum(compiled.section(w, "pivot") >= SKIP))),
        redundant_rows=tuple(info.rows[i].name for i in np.flatnonzero(compiled.section(w, "mask"))),
        notes=notes_of(moved, asked.summary, changes, info),
        changes=changes,
        light=bool(asked.summary[_LIGHT]),
        warnings=() if moved is None else warnings_of(changes, info, float(w[abi.LENGTH])),
    )

"""Data of a compiled model for the common start (`symgen.run.starts.starting`), and calls of it."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from contextvars import ContextVar
from dataclasses import dataclass, field, replace
from functools import cached_property, partial
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from symgen.base.ir.program import MODE_NUMBERS
from symgen.compile.loopcode.exact import compiled_form, plain_form
from symgen.compile.store.loaded_modules import plain_function_with_callees
from symgen.run.layout import abi
from symgen.run.layout import ensemble_abi as e
from symgen.run.layout.manifold import turn_nothing
from symgen.run.layout.model_arrays import (
    entries_of,
    joints_of_rows,
    marks_of_lengths,
    spins_of_bodies,
    velocity_of_coordinate,
)
from symgen.run.layout.probe import Ready
from symgen.run.layout.redundancy import choose_rows, room_of_choice
from symgen.run.layout.start_records import Closing, Instant, Layout, MassTable, StartConditions, Work, new_work
from symgen.run.starts import decisions
from symgen.run.starts import start_solvers as solvers
from symgen.run.starts.closing import is_light
from symgen.run.starts.held import Held
from symgen.run.starts.joint_starts import Joints, joints_held
from symgen.run.starts.masses import Masses, project_nothing, project_velocities, room_of_masses
from symgen.run.starts.starting import (
    close_alone,
    close_rows,
    follow_nothing,
    observe_nothing,
    prepare_rows,
    set_no_rates,
)

if TYPE_CHECKING:
    from symgen.run.layout.compiled import CompiledModel, ModelInfo

Array = NDArray[np.float64]
Integers = NDArray[np.int64]
#: Compiled or plain Python, see `symgen.compile.loopcode.exact`.
Form = Callable[[Any], Any]
#: Row and control of a single start, which is never stopped.
ALONE = np.zeros(1, dtype=np.int64), np.zeros(e.N_CONTROL, dtype=np.int64)
#: Whether single starts are compiled whatever their size.
_MANY = ContextVar("many_starts", default=False)


@contextmanager
def close_many_starts() -> Iterator[None]:
    """Close single starts by compiled code, with the same bits: where many are closed, loading it pays."""
    before = _MANY.set(True)
    try:
        yield
    finally:
        _MANY.reset(before)


#: Whether starts are closed by sparse algebra from fewer entries of D on.
_DRAWN = ContextVar("drawn_starts", default=False)


@contextmanager
def close_for_drawing() -> Iterator[None]:
    """Close starts by sparse algebra as soon as it is faster: what is drawn may differ from a run in its last bits."""
    before = _DRAWN.set(True)
    try:
        yield
    finally:
        _DRAWN.reset(before)


def _is_closed_sparsely(compiled: CompiledModel) -> bool:
    entries = compiled.info.m * compiled.info.nv
    return compiled.sparse and entries > (decisions.LARGEST_DRAWN if _DRAWN.get() else decisions.LARGEST_DENSE)


def layout_of_starts(compiled: CompiledModel) -> Layout:
    """Return the layout of a model for starts at time 0 with nothing held and no branch set."""
    info, joints = compiled.info, {name: k for k, name in enumerate(joints_of_rows(compiled.info))}
    numbers = (
        *(0.0, info.nq, info.nv, info.ny, info.m, info.windings),
        *(int(_is_closed_sparsely(compiled)), 0),
        *(info.sections[name][0] for name in Layout._fields[8:17]),
    )
    arrays = (
        *entries_of(info),
        *(_mark_rows(those, info.nv) for those in (info.massless, (), ())),
        np.zeros(0, dtype=np.int64),
        np.array([(joints[row.joint], row.unit != "rad") for row in info.rows], dtype=np.int64).ravel(),
        _mark_rows(info.alone, info.m),
        _switches(info),
        np.array(spins_of_bodies(info), dtype=np.int64),
        marks_of_lengths(info),
        np.zeros(info.nq),
        np.full(info.windings, np.nan),
    )
    return Layout._make((*numbers, *arrays))


def _switches(info: ModelInfo) -> Integers:
    """Return the places in w of `held` of rows that may be off, -1 for others."""
    places = np.full(info.m, -1, dtype=np.int64)
    for k, row in enumerate(info.switchable):
        places[row] = info.sections["modes"][0] + MODE_NUMBERS * k
    return places


def _mark_rows(those: Sequence[int], count: int) -> Integers:
    """Return 1 for each number below `count` that is one of `those`, else 0."""
    return np.isin(np.arange(count), those).astype(np.int64)


def row_chooser(compiled: CompiledModel) -> Callable[[Array], bool]:
    """Return the function that chooses independent rows at the position of w and returns whether they changed.

    Rows of too large mechanisms stay the same.
    """
    info, layout = compiled.info, layout_of_starts(compiled)
    room, choose = np.zeros(room_of_choice(info.m, info.nv)), compiled_form(choose_rows)
    if not len(room):
        return lambda w: False

    def choose_rows_of(w: Array) -> bool:
        return bool(choose(layout, info.m - int(np.count_nonzero(compiled.section(w, "mask"))), 1, w, room))

    return choose_rows_of


def as_one_row(y: Array, p: Array, w: Array) -> Instant:
    """Return the arrays of one start as matrices of one row."""
    return Instant(y[np.newaxis], p[np.newaxis], w[np.newaxis])


@dataclass(frozen=True)
class Assembly:
    """The start of a compiled model.

    Attributes
    ----------
    compiled : CompiledModel
        Model and method.
    held : Held
        Held quantities; with many starts, their values are in the conditions of each.
    strict : bool
        Whether a start that would be changed is refused.
    ask_light : bool
        Whether to report bodies that are too light for the law's solver.
    t : float
        Time of the start [s].
    branches : sequence of float
        Angles that count turns; empty if their turns are chosen.
    datum : sequence of float
        What coordinates are measured from (`symgen.describe.facts.lengths.origin_of_sizes`); empty for the origin.
    masses : Masses, optional
        What is off the diagonal of M, in whose metric velocities that contradict each other are projected.
    """

    compiled: CompiledModel
    held: Held = field(default_factory=Held)
    strict: bool = False
    ask_light: bool = False
    t: float = 0.0
    branches: Sequence[float] = ()
    datum: Sequence[float] = ()
    masses: Masses | None = None

    @cached_property
    def layout(self) -> Layout:
        """The layout of the model with the settings of this start."""
        info, held, layout = self.compiled.info, self.held, layout_of_starts(self.compiled)
        return layout._replace(
            t=self.t,
            # where all rows close loops or fix velocities, S is formed in doubtful positions alone
            ask_light=int(
                self.ask_light and hasattr(self.compiled.law_module, "confirm") and not self.compiled.closes_all
            ),
            unchanged=_mark_rows(tuple(held.velocities), info.nv),
            fixed=_mark_rows(held.fixed, info.nv),
            held=np.array([(i, velocity_of_coordinate(i, info)) for i in held.coordinates], dtype=np.int64).ravel(),
            datum=np.array(self.datum, dtype=np.float64) if len(self.datum) else layout.datum,
            branches=np.array(self.branches, dtype=np.float64) if len(self.branches) else layout.branches,
        )

    def memory(self) -> tuple[Joints, Work]:
        """Return the held joint coordinates and working memory; each thread has its own."""
        compiled, held, scratch = self.compiled, self.held, self.compiled.scratch()
        joints = joints_held(compiled.info, self.layout, list(held.joints), list(held.rates), scratch)
        largest = max(joints.values, joints.rates, key=lambda layout: layout.m)
        return joints, new_work(largest, len(scratch), *(room_of_masses(largest, self.masses) if self.masses else ()))

    def close(self, y: Array, v: Array, p: Array) -> tuple[Array, Array]:
        """Make one state consistent in place, with held quantities at their values; return scratch and summary.

        Parameters
        ----------
        y : Array, shape (ny,)
            Described coordinates.
        v : Array, shape (nv,)
            Specified velocities, nan for the others.
        p : Array
            Parameters.
        """
        if self.layout.ask_light and self.compiled.shape == "straight":
            w, summary = replace(self, ask_light=False).close(y, v, p)
            summary[e.LIGHT] = float(summary[e.START] == e.ASSEMBLED and self._is_light(Instant(y, p, w)))
            return w, summary
        held, velocities = self.held, v.copy()
        velocities[list(held.velocities)] = list(held.velocities.values())
        targets = np.array(held.targets, dtype=np.float64)
        now = as_one_row(y, p, self.compiled.scratch())
        conditions = StartConditions(*as_one_row(velocities, targets, np.zeros(e.N_SUMMARY)))
        self.close_all(now, conditions, *ALONE)
        return now.w[0], conditions.summary[0]

    def _is_light(self, now: Instant) -> bool:
        """Whether bodies are too light for the law's solver at a start, by one evaluation in plain Python.

        Runs in joint coordinates do not need the code of bodies, which takes long to compile.
        """
        law, model, (_, work) = self.compiled.law_module, self.compiled.model, self.memory()
        plain = plain_function_with_callees(law.rhs), plain_function_with_callees(model.geometry)
        machine = Ready(law.rhs, abi.RHS), Ready(model.geometry, abi.MEASURE)
        judge = plain_form(is_light)
        nothing: list[Any] = [None] * 7  # it calls ``geometry`` alone
        with np.errstate(all="ignore"):
            try:
                return bool(judge(plain[0], Closing(plain[1], *nothing), self.layout, now, work))
            except (ArithmeticError, ValueError):  # undefined numbers are errors where nothing is compiled
                return bool(judge(machine[0], Closing(machine[1], *nothing), self.layout, now, work))

    def close_all(self, now: Instant, conditions: StartConditions, selected: Integers, control: Integers) -> int:
        """Make the selected rows consistent.

        Parameters
        ----------
        now, conditions : Instant, StartConditions
            Matrices with one row for each start: described coordinates, and parameters not yet prepared.
        selected, control : Array of int
            Rows to close; integers shared with the watching thread.

        Returns
        -------
        int
            Number of rows done.
        """
        joints, work = self.memory()
        flat, (*functions, observe), form = self.prepare(now, selected, len(work.right))
        model, all_conditions = (
            ((self.layout, self.table, *functions), observe, joints),
            (array.ravel() for array in conditions),
        )
        close = form(close_rows if len(now.y) > 1 else close_alone)
        arguments = model, flat, StartConditions(*all_conditions), work, selected, control
        return self.close_prepared(partial(close, *arguments), now, conditions, len(selected))

    def close_prepared(self, close: Callable[[], int], now: Instant, conditions: StartConditions, count: int) -> int:
        """Close `count` rows, which are prepared, and judge them; return the number of rows done."""
        done = count
        with np.errstate(all="ignore"):  # undefined numbers are nan or infinite in compiled code, without a warning
            try:
                done = int(close())
            except (ArithmeticError, ValueError):  # of one row, where nothing is compiled
                conditions.summary[:, e.START] = e.UNDEFINED
        self.judge(now.w, conditions.summary)
        return done

    def prepare(self, now: Instant, selected: Integers, m: int) -> tuple[Instant, tuple[Any, ...], Form]:
        """Fill parameters, masses and the rest of the scratch of the selected rows; nan where undefined.

        Returns
        -------
        flat : Instant
            The same arrays, their rows one after another.
        functions : tuple
            The functions of `own`.
        form : callable
            Form of functions: plain Python for one small start (`m`: most rows of D), else compiled.
        """
        flat, model, law = Instant(*(array.ravel() for array in now)), self.compiled.model, self.compiled.law_module
        if len(now.y) == 1:
            flat.w[:] = self.compiled.scratch()
            try:
                with np.errstate(all="ignore"):
                    self.compiled.prepare(flat.p)
                    Ready(model.masses, abi.MOVE)(flat.p, flat.w)
            except (ArithmeticError, ValueError):  # errors where nothing is compiled
                flat.p[:] = np.nan
        else:
            functions = model.prepare, law.prepare, model.masses
            compiled_form(prepare_rows)(*functions, self.compiled.scratch(), flat.p, flat.w, len(now.y), selected)
        n = self.layout.nv
        large = self.layout.sparse or m * n * min(m, n) > decisions.LARGEST_INTERPRETED
        if len(now.y) > 1 or large or _MANY.get():
            return flat, tuple(compiled_form(f) for f in self.own), compiled_form
        kinds = abi.MEASURE, abi.MEASURE, abi.MOVE, None, None, abi.OBSERVE, None, None, abi.RHS, abi.OBSERVE
        plain = zip(map(plain_form, self.own), kinds, strict=True)
        return flat, tuple(f if kind is None else Ready(f, kind) for f, kind in plain), plain_form

    def judge(self, ws: Array, summaries: Array) -> None:
        """Record the joint with the largest gap; refuse changed starts if `strict`."""
        info = self.compiled.info
        for r in np.flatnonzero(summaries[:, e.START] == e.OPEN):
            joints, residual = joints_of_rows(info), np.nan_to_num(self.compiled.section(ws[r], "residual"), nan=np.inf)
            open_by = {name: list[float]() for name in joints}
            for row, x in zip(info.rows, residual.tolist(), strict=True):
                open_by[row.joint].append(x)
            sizes = [math.hypot(*values) for values in open_by.values()] or [0.0]  # squares may overflow
            summaries[r, e.START_WHERE], summaries[r, e.START_SIZE] = np.argmax(sizes), max(sizes)
        if self.strict:
            good = summaries[:, e.START] == e.ASSEMBLED
            moved = good & (summaries[:, e.START_MOVED] > 0.0) & (not len(self.layout.held))
            summaries[good & (summaries[:, e.START_VELOCITIES] == 1.0), e.START] = e.PROJECTED
            summaries[moved, e.START] = e.MOVED

    @property
    def table(self) -> MassTable:
        """What formulas give of M."""
        if self.masses is None:
            return MassTable(0, np.zeros(0, dtype=np.int64))
        return MassTable(self.masses.rotors, np.array(self.masses.entries, dtype=np.int64).ravel())

    @property
    def own(self) -> tuple[Any, ...]:
        """Functions for `close_row`, in the order of its model, and ``observe``."""
        model, law, layout = self.compiled.model, self.compiled.law_module, self.layout
        held = bool(self.held.joints or self.held.rates)
        return (
            model.geometry,
            model.measure if layout.windings else follow_nothing,
            model.move if layout.nq != layout.nv else turn_nothing,
            model.spread if layout.sparse else turn_nothing,
            (solvers.iterated_change if held else solvers.sparse_change) if layout.sparse else solvers.dense_change,
            self.masses.formulas if self.masses else observe_nothing,
            project_velocities if self.masses else project_nothing,
            solvers.choose_turns if layout.windings else solvers.choose_no_turns,
            law.rhs if layout.ask_light else set_no_rates,
            model.observe if held else observe_nothing,
        )

"""Runs of an ensemble that a loop over many runs cannot take: each is a single run, by the loops of single runs.

Impacts of stops are computed in Python between two parts of a run. Such runs are done one after the other, in the same
threads, chunks and folders; ensembles that need none of it know nothing of this module.
"""

from __future__ import annotations

import threading
from collections.abc import Callable
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from symgen.base.errors import InputError
from symgen.compiling.events import compile_events, effects_of
from symgen.describe.events import RESET
from symgen.describe.friction import MODE
from symgen.effects.effects import Effects
from symgen.ensemble.measures import MeasuredOutputs
from symgen.layout import abi
from symgen.layout import ensemble_abi as e
from symgen.loops.event_loop import undefined_event
from symgen.rows.rows import summarise
from symgen.running.tree import TreeRun, begin_on_tree
from symgen.runs.run import outcome_of
from symgen.runs.simulation import Simulation
from symgen.starts.assembly import Start

if TYPE_CHECKING:
    from symgen.describe.mechanism import Mechanism
    from symgen.ensemble.chunks import Results, Rows
    from symgen.ensemble.measures import Measures
    from symgen.ensemble.recipe import EventPlan, Recipe
    from symgen.layout.compiled import CompiledModel
    from symgen.layout.start_records import Instant
    from symgen.loops.integrator import Integrator
    from symgen.loops.run_spec import Watched
    from symgen.runs.outcome import Outcome
    from symgen.starts.tree_start import Carried

Array = NDArray[np.float64]
Integers = NDArray[np.int64]

#: Steps between two looks at whether somebody wants it to stop.
_STEPS = 1e5


@dataclass
class SingleRuns:
    """Runs rows of a compiled model one by one.

    Attributes
    ----------
    recipe : Recipe
        Data that the runs share.
    compiled : CompiledModel
        In the bodies' own coordinates, which starts are closed in.
    measures : Measures or None
        Code for quantities that no loop computes.
    tree : (Mechanism, Carried) or None
        The mechanism with its tree, and starts of bodies as those of the tree, where runs are in joint coordinates.
    """

    recipe: Recipe
    watch: EventPlan
    compiled: CompiledModel
    integrator: Integrator
    measures: Measures | None
    tree: tuple[Mechanism, Carried] | None = None
    _lock: threading.Lock = field(default_factory=threading.Lock)
    _warm: bool = False

    @property
    def _run_of(self) -> tuple[Mechanism, CompiledModel]:
        if self.tree is None:
            return self.watch.mechanism, self.compiled
        return self.tree[0], self.tree[1].assembly.compiled

    def _events_of(self, mechanism: Mechanism, compiled: CompiledModel) -> Watched | None:
        spec = self.recipe.spec
        return compile_events(mechanism, compiled, self.watch.events, spec.rtol if spec.adaptive else None)

    @cached_property
    def _watched(self) -> Watched | None:
        return self._events_of(*self._run_of)

    @cached_property
    def _of_bodies(self) -> Effects | None:
        """What events change as bodies have it, where the tree of joints is run."""
        return effects_of(self.watch.mechanism, self.compiled, self.watch.events)

    def run(self, rows: Rows, starts: Instant, selected: Integers, out: Results, control: Integers) -> bool:
        """Run selected rows from consistent starts; return whether all are done.

        Parameters
        ----------
        rows : Rows
            Data by which the runs differ.
        starts : Instant
            States, parameters and scratch of all rows.
        selected, control : Array of int
            Rows to work on; what the watching thread shares.
        out : Results
            Written.
        """
        for r in selected:
            if control[abi.STOP] != 0:
                return False
            began = self._begun(int(r), rows, starts)
            if isinstance(began, TreeRun) and began.over >= 0:
                out.summary[r, [e.START, e.START_WHERE]] = e.TURNED_OVER, began.over
                continue
            if not self._run(int(r), rows, began, out, control):
                return False
            control[e.RUNS_DONE] += 1
        return True

    def _begun(self, r: int, rows: Rows, starts: Instant) -> Start | TreeRun:
        y, p, w = (array[r].copy() for array in starts)
        start = Start(y, p, w, self.compiled.rank(w), self.compiled.redundant(w), (), datum=self.recipe.datum)
        if self.tree is None:
            return start
        method = {**self.recipe.method_parameters, **rows.method_of(r)}
        return begin_on_tree(
            *(self.watch.mechanism, *self.tree, start, method, self.watch.events),
            effects=lambda: self._of_bodies,
        )

    def _run(self, r: int, rows: Rows, began: Start | TreeRun, out: Results, control: Integers) -> bool:
        tree = began if isinstance(began, TreeRun) else None
        start, compiled = (began.start, began.compiled) if isinstance(began, TreeRun) else (began, self.compiled)
        spec = replace(self.recipe.spec, stops=rows.stops_of(r), events=self._watched)
        simulation = Simulation(compiled, self.integrator, start, spec)
        outputs = simulation.outputs(spec.times)
        with self._lock:
            if not self._warm:
                simulation.warm(outputs)
                self._warm = True
        try:
            code = simulation.run(outputs, lambda: bool(control[abi.STOP]), _STEPS)
        except InputError:  # a reset that cannot be
            code = e.IMPOSSIBLE
        if code == abi.STOPPED:
            return False
        outcome = outcome_of(simulation, outputs, abi.NOT_FINITE if code == e.IMPOSSIBLE else code)
        done = e.IMPOSSIBLE if code == e.IMPOSSIBLE else outcome.code
        if done == abi.DONE and code != abi.MET:  # a grid of steps meets the end up to rounding
            simulation.state.clock[abi.TIME] = spec.until
        summarise(done, simulation.state, out.summary[r])
        note_events(out.events[r], outcome, code)
        count = int(simulation.state.control[abi.OUTPUTS])
        shown = outcome if tree is None else tree.carried(outcome)
        late = self.watch.ends and len(shown.times) > count  # an event has ended it
        instants = slice(-1, None) if late else slice(count)
        columns = self._columns(shown, out.summary[r, e.REDUNDANT_ROWS] == 0.0)
        size = columns[:, instants].shape[1]
        out.values[r, :, :size] = columns[:, instants]
        if self.measures is not None and size:
            out.behind[r, :, :size] = self._behind(self.measures, shown, columns)[:, instants]
        return True

    def _columns(self, outcome: Outcome, unique: bool) -> Array:
        """Return the state of a run at its outputs, as loops leave it, shape (columns, outputs).

        Parameters
        ----------
        outcome : Outcome
            The run.
        unique : bool
            Whether no rows depend on others, whose multipliers would be any.
        """
        kinetic, potential = outcome.status_columns[:, abi.KINETIC], outcome.status_columns[:, abi.POTENTIAL]
        work = outcome.states[:, self.compiled.info.work]
        columns: dict[int, Callable[[], Array]] = {
            e.STATE: lambda: outcome.states,
            e.STATUS: lambda: outcome.status_columns,
            e.ENERGY: lambda: (kinetic + potential)[:, np.newaxis],
            e.ENERGY_ERROR: lambda: (kinetic + potential - outcome.energy_start - work)[:, np.newaxis],
            e.ACCELERATION: lambda: outcome.accelerations,
            e.MULTIPLIER: lambda: outcome.multipliers if unique else np.full_like(outcome.multipliers, np.nan),
            e.JOINT: lambda: outcome.joint_coordinates,
        }
        tables = {source: columns[source]() for source in self.recipe.sources}
        columns_of_run = [tables[q.source][:, q.column] for q in self.recipe.columns]
        return np.array(columns_of_run).reshape(len(columns_of_run), len(outcome.times))

    def _behind(self, measures: Measures, outcome: Outcome, columns: Array) -> Array:
        """Return the quantities computed after loops, shape (quantities, outputs), with the parameters of each part."""
        quantities, one, spec = self.recipe.behind, np.zeros(1, dtype=np.int64), self.recipe.spec
        values = np.empty((len(quantities), len(outcome.times)))
        for first, last, p in outcome.parameters:
            part = np.ascontiguousarray(columns[np.newaxis, :, first:last])
            outputs = MeasuredOutputs(outcome.times[np.newaxis, first:last], (), spec.adaptive, spec.step or 0.0)
            part_of_run = outputs, one, part, p[np.newaxis], outcome.w[np.newaxis].copy()
            values[:, first:last] = measures.work_out(self.compiled, quantities, *part_of_run)[0]
        return values


def note_events(row: Array, outcome: Outcome, code: int) -> None:
    """Write the events of a run into its numbers (`symgen.layout.ensemble_abi`)."""
    watch = outcome.simulation.events
    if watch is None or not len(row):  # of modes alone, which are counted nowhere
        return
    numbers = {name: i for i, name in enumerate(watch.watched.names)}
    row[:] = np.nan
    row[e.HEAD_OF_EVENTS :: e.OF_EVENT] = 0.0
    for event in outcome.happened:
        if event.action == MODE:
            continue
        at = e.HEAD_OF_EVENTS + e.OF_EVENT * numbers[event.name]
        row[at] += 1.0
        row[at + 1] = event.t if np.isnan(row[at + 1]) else row[at + 1]
        row[at + 2] = event.t
    if outcome.accumulation is not None:
        row[e.ACCUMULATION] = outcome.accumulation
        row[e.GATHERING] = sum(2.0 ** numbers[name] for name in watch.recent)
    # a reset that was made has velocities behind it
    refused = [x for x in outcome.happened if x.t == outcome.end and x.action == RESET and x.impact is None]
    if code == e.IMPOSSIBLE and refused:
        row[e.IMPOSSIBLE_EVENT] = numbers[refused[-1].name]
    elif code == abi.UNDEFINED:
        row[e.IMPOSSIBLE_EVENT] = undefined_event(outcome.simulation.state)

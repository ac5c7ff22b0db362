"""The compiled side of an ensemble: closes and runs the rows of a chunk, here or on another machine."""

from __future__ import annotations

import threading
from dataclasses import dataclass, field
from functools import cached_property
from typing import TYPE_CHECKING, Protocol

import numpy as np
from numpy.typing import NDArray

from symgen.run.compiling.events import compile_events
from symgen.run.compiling.mass_formulas import masses_of_starts
from symgen.run.integrators import INTEGRATORS
from symgen.run.layout import abi
from symgen.run.layout import ensemble_abi as e
from symgen.run.layout.compiled import CompiledModel
from symgen.run.layout.model_arrays import joints_of_rows
from symgen.run.layout.start_records import Instant, StartConditions
from symgen.run.loops.integrator import Integrator
from symgen.run.planning.tree import places_of_turns
from symgen.run.planning.tree_starts import map_to_tree
from symgen.run.single.new_state import span_of
from symgen.run.starts.assembler import Assembly
from symgen.study.ensemble.chunks import Chunk, Results, Rows
from symgen.study.ensemble.device_runs import DeviceRuns, kernel_sizes
from symgen.study.ensemble.loop_runs import PLAIN, BodyObserver, LoopRuns, TreeRuns, motion_picks
from symgen.study.ensemble.measured_quantities import MeasuredOutputs
from symgen.study.ensemble.recipe import Code, Recipe
from symgen.study.ensemble.verdicts import summary_column

if TYPE_CHECKING:
    from symgen.run.layout.compiled import ModelInfo
    from symgen.study.ensemble.measured_quantities import Measures

Array = NDArray[np.float64]
Integers = NDArray[np.int64]


class Runs(Protocol):
    """A kernel for rows from consistent starts: a loop, one over rows of a tree, or a device."""

    def run(self, rows: Rows, starts: Instant, selected: Integers, out: Results, control: Integers) -> bool:
        """Run selected rows; return whether all are done."""


@dataclass(frozen=True)
class _Prepared:
    """A compiled model of bodies with its start, the parameters that all rows share, and its runner."""

    compiled: CompiledModel
    assembly: Assembly
    p: Array
    runs: Runs
    measures: Measures | None


@dataclass
class RowKernel:
    """Runs the chunks of one recipe; threads may share it."""

    recipe: Recipe
    _lock: threading.Lock = field(default_factory=threading.Lock)
    _spare: _Prepared | None = None
    _warm: bool = False

    @cached_property
    def first_model(self) -> _Prepared:
        """The model as it is run first."""
        return self._prepare_code(self.recipe.first)

    def model_for_light_bodies(self) -> _Prepared | None:
        """Return the model with the solver for light bodies, loaded when the first such run is met."""
        with self._lock:
            if self._spare is None and self.recipe.spare is not None:
                self._spare = self._prepare_code(self.recipe.spare)
            return self._spare

    def compile_all(self) -> None:
        """Compile or load all that runs need, by no runs at all."""
        with self._lock:
            if self._warm:
                return
            info, held = self.first_model.compiled.info, self.recipe.held
            targets = sum(map(len, (held.coordinates, held.joints, held.rates)))
            sizes = len(info.parameters), info.nq, info.nv, targets, len(info.states)
            parameters, q, v, values, states = (np.zeros((0, size)) for size in sizes)
            self.run(Rows(parameters, q, v, values, states), new_control())
            if isinstance(self.first_model.runs, DeviceRuns):
                self.first_model.runs.compile()
            self._warm = True

    def run(self, rows: Rows, control: Integers) -> Chunk:
        """Close and run the rows of a chunk.

        Parameters
        ----------
        rows : Rows
            Data by which the runs differ.
        control : Array of int
            From `new_control`: raising its flag `symgen.run.layout.abi.STOP` from another thread stops the run that is
            being worked on; `symgen.run.layout.ensemble_abi.RUNS_DONE` counts finished ones.
        """
        recipe, k, n_times = self.recipe, len(rows), len(self.recipe.spec.times)
        values, behind = (np.full((k, len(q), n_times), np.nan) for q in (recipe.columns, recipe.behind))
        out = Results(values, np.zeros((k, e.N_SUMMARY)), np.zeros((k, recipe.of_events)), behind)
        everything = np.arange(k, dtype=np.int64)
        complete = self._run_with(self.first_model, rows, everything, out, control)
        light = np.flatnonzero((out.summary[:, e.LIGHT] == 1.0) & (out.summary[:, e.START] == e.ASSEMBLED))
        if complete and len(light) and (spare := self.model_for_light_bodies()) is not None:
            out.summary[light] = 0.0
            complete = self._run_with(spare, rows, light.astype(np.int64), out, control)
            out.summary[light, e.LIGHT] = 1.0
        left, judged = recipe.in_order(values, behind), np.zeros((k, 0))
        if recipe.judged is not None:
            count = len(recipe.shown)
            left, columns = left[:, :count], left[:, count:]
            judged = recipe.judged.judge_rows(rows.parameters, columns)
        if recipe.over is not None:
            done = (out.summary[:, e.START] == e.ASSEMBLED) & (out.summary[:, e.CODE] == abi.DONE)
            left = recipe.over.evaluate_runs(left, recipe.times, done)
        return Chunk(left, np.hstack([out.summary, out.events, judged]), complete)

    def _described_rows(self, model: _Prepared, rows: Rows) -> Instant:
        """Return rows as they are described."""
        info, k, room = model.compiled.info, len(rows), max(len(rows), 1)
        now = Instant(
            np.zeros((room, info.ny)), np.tile(model.p, (room, 1)), np.empty((room, max(1, model.compiled.law.nw)))
        )
        now.p[:k, : len(info.parameters)], now.y[:k, : info.nq] = rows.parameters, rows.q
        now.y[:k, info.own_states] = rows.states
        rows.put_method_parameters(model.compiled.law, now.p)
        return now

    def _run_with(self, model: _Prepared, rows: Rows, selected: Integers, out: Results, control: Integers) -> bool:
        """Close and run selected rows with one compiled model; those with light bodies only where there is no other."""
        info, recipe, now = model.compiled.info, self.recipe, self._described_rows(model, rows)
        conditions = StartConditions(rows.v, rows.targets, out.summary)
        if model.assembly.close_all(now, conditions, selected, control) < len(selected):
            return False
        self._look_at_sides(info, now.y, selected, out.summary)
        ready = out.summary[selected, e.START] == e.ASSEMBLED
        if model is self.first_model and recipe.spare is not None:
            ready &= out.summary[selected, e.LIGHT] == 0.0
        selected = selected[ready]
        if not model.runs.run(rows, now, selected, out, control):
            return False
        redundant = selected[out.summary[selected, e.REDUNDANT_ROWS] > 0.0]
        for i in (i for i, q in enumerate(recipe.columns) if q.source == e.MULTIPLIER):  # they are not unique then
            out.values[redundant, i] = np.nan
        if model.measures is not None:
            left = recipe.behind, self._outputs_of_rows(rows, out.summary), selected, out.values, now.p, now.w
            out.behind[selected] = model.measures.evaluate_quantities(model.compiled, *left)
        return True

    def _outputs_of_rows(self, rows: Rows, summary: Array) -> MeasuredOutputs:
        """Return the outputs of rows, after they have run: the only one may be at an event that has ended a run."""
        recipe, spec = self.recipe, self.recipe.spec
        times = recipe.times[np.newaxis]
        if recipe.watch is not None and recipe.watch.ends:
            early = summary_column(summary, "outputs") == 0.0
            times = np.where(early, summary_column(summary, "end"), times.T).T.copy()
        return MeasuredOutputs(times, rows.seams, spec.adaptive, spec.step or 0.0)

    def _look_at_sides(self, info: ModelInfo, ys: Array, selected: Integers, summary: Array) -> None:
        """Refuse starts in which joints hold bodies the wrong way round, as single runs do."""
        if not self.recipe.sides:
            return
        closed = selected[summary[selected, e.START] == e.ASSEMBLED]
        q, joints = ys[closed, : info.nq].T, joints_of_rows(info)
        for side in reversed(self.recipe.sides):  # the first one is told
            rows = closed[side.cosine(q) < 0.0]
            summary[rows, e.START], summary[rows, e.START_WHERE] = e.HALF_TURN, joints.index(side.joint)

    def _prepare_code(self, code: Code) -> _Prepared:
        compiled, recipe = code.module.load(), self.recipe
        p = self._parameter_array(compiled)
        weighed = recipe.weighed
        masses = (
            None
            if weighed is None
            else masses_of_starts(weighed, compiled, bool(recipe.held.velocities or recipe.held.rates))
        )
        light = recipe.spare is not None
        assembly = Assembly(compiled, recipe.held, recipe.strict, light, datum=recipe.datum, masses=masses)
        return _Prepared(compiled, assembly, p, self._function_of_runs(code, compiled), code.measures)

    def _parameter_array(self, compiled: CompiledModel) -> Array:
        return compiled.parameter_array({q.name: 0.0 for q in compiled.info.parameters}, self.recipe.method_parameters)

    def _function_of_runs(self, code: Code, compiled: CompiledModel) -> Runs:
        """Return the function that runs rows from starts of bodies."""
        recipe, watch, spec = self.recipe, self.recipe.watch, self.recipe.spec
        integrator: Integrator = INTEGRATORS.get(recipe.integrator)
        other, tree = (None if module is None else module.load() for module in (code.other, code.tree))
        own, on_tree = tree or compiled, None
        if watch is not None and recipe.tree is not None:
            on_tree = recipe.tree, map_to_tree(watch.mechanism, recipe.tree, compiled, own)
        setup = integrator.setup(own, spec, own.scratch())
        if other is not None and recipe.target == "cuda":
            need, span = kernel_sizes(other, setup, spec.adaptive, recipe.sources), span_of(spec, setup)
            return DeviceRuns(other, need, setup.scheme, span, recipe.limits, recipe.times, recipe.picks, recipe.datum)
        watched, rtol = None, spec.rtol if spec.adaptive else None
        if watch is not None:
            watched = compile_events(recipe.tree or watch.mechanism, own, watch.events, rtol)
        if on_tree is None:
            return LoopRuns(recipe, compiled, integrator, setup, recipe.picks, watched, other)
        assert watch is not None and recipe.tree is not None, "runs on a tree have both"
        info, plain = compiled.info, recipe.sources <= PLAIN and recipe.measures is None and recipe.judged is None
        turns = places_of_turns(watch.mechanism, recipe.tree, compiled.shape)
        picks = motion = motion_picks(info, own.info, turns)
        if plain:
            picks = [motion[q.column] if q.source == e.STATE else (q.source, q.column) for q in recipe.quantities]
        flat = np.array(picks, dtype=np.int64).ravel()
        loop = LoopRuns(recipe, own, integrator, setup, flat, watched, width=info.nq + 2 * info.nv)
        observer = None
        if not plain:
            first = info.ny + abi.N_STATUS
            turned = {first + i: sign for i, (_, _, sign) in enumerate(turns)}
            observer = BodyObserver(LoopRuns(recipe, compiled, integrator, setup, recipe.picks), turned)
        return TreeRuns(on_tree[1], self._parameter_array(own), loop, observer)


def new_control() -> Integers:
    """Return the integers that a chunk shares with its watching thread."""
    return np.zeros(e.N_CONTROL, dtype=np.int64)


_kernels: dict[str, RowKernel] = {}
_kernels_lock = threading.Lock()


def kernel_of_recipe(recipe: Recipe) -> RowKernel:
    """Return the kernel of a recipe, the same one as long as it is among the last few."""
    with _kernels_lock:
        kernel = _kernels.get(recipe.digest)
        if kernel is None:
            while len(_kernels) >= 4:
                del _kernels[next(iter(_kernels))]
            kernel = _kernels[recipe.digest] = RowKernel(recipe)
    return kernel

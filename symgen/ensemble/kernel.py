"""The compiled side of an ensemble: closes and runs the rows of a chunk, here or on another machine."""

from __future__ import annotations

import threading
from dataclasses import dataclass, field
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from symgen.compiling.events import compile_events
from symgen.ensemble.chunks import Chunk, Results
from symgen.ensemble.lanes import run_in_lanes
from symgen.ensemble.recipe import Code, Recipe
from symgen.errors import InputError
from symgen.integrators import INTEGRATORS
from symgen.runtime import abi
from symgen.runtime import ensemble_abi as e
from symgen.runtime.assembler import Assembly
from symgen.runtime.compiled import CompiledModel
from symgen.runtime.held import Held
from symgen.runtime.integrator import Integrator, Setup
from symgen.runtime.model_arrays import joints_of
from symgen.runtime.new_state import new_outputs, new_state, sizes_of, span_of
from symgen.runtime.probe import rates_of
from symgen.runtime.run import RunSpec
from symgen.runtime.start_records import Asked, Instant

if TYPE_CHECKING:
    from symgen.describe.mechanism import Mechanism
    from symgen.ensemble.device import DeviceRuns
    from symgen.ensemble.measures import Measures
    from symgen.ensemble.singly import SingleRuns
    from symgen.ensemble.starts import Rows
    from symgen.ensemble.tree_rows import TreeRows
    from symgen.runtime.compiled import ModelInfo
    from symgen.runtime.events import Watched
    from symgen.runtime.records import Kept

Array = NDArray[np.float64]
Integers = NDArray[np.int64]


@dataclass
class _Prepared:
    """A compiled model with the arrays that describe it to the loops, and what else there is of its law."""

    compiled: CompiledModel
    assembly: Assembly
    p: Array
    setup: Setup
    measures: Measures | None = None
    device: DeviceRuns | None = None
    lanes: CompiledModel | None = None
    single: SingleRuns | None = None
    tree: TreeRows | None = None
    on_tree: _Prepared | None = None
    picks: Integers | None = None
    width: int | None = None
    watched: Watched | None = None


@dataclass
class Kernel:
    """Runs the chunks of one recipe; threads may share it."""

    recipe: Recipe
    _lock: threading.Lock = field(default_factory=threading.Lock)
    _spare: _Prepared | None = None
    _warm: bool = False

    @cached_property
    def integrator(self) -> Integrator:
        """The scheme.

        Raises
        ------
        InputError
            If there is no loop over many runs for it.
        """
        return integrator_of_rows(self.recipe.integrator, self.recipe.spec)

    @cached_property
    def first(self) -> _Prepared:
        """The model as it is run first."""
        return self._prepare(self.recipe.first)

    def spare(self) -> _Prepared | None:
        """Return the model with the solver for light bodies, loaded when the first such run is met."""
        with self._lock:
            if self._spare is None and self.recipe.spare is not None:
                self._spare = self._prepare(self.recipe.spare)
            return self._spare

    def warm(self) -> None:
        """Compile or load all that runs need, by no runs at all."""
        from symgen.ensemble.starts import Rows

        with self._lock:
            if self._warm:
                return
            info = self.first.compiled.info
            sizes = len(info.parameters), info.nq, info.nv, len(self.recipe.held) + len(self.recipe.joints)
            parameters, q, v, targets = (np.zeros((0, size)) for size in sizes)
            self.run(Rows(parameters, q, v, targets), new_control())
            if self.first.device is not None:
                self.first.device.compile()
            self._warm = True

    def run(self, rows: Rows, control: Integers) -> Chunk:
        """Close and run the rows of a chunk.

        Parameters
        ----------
        rows : Rows
            What distinguishes the runs.
        control : Array of int
            From `new_control`: raising its flag `symgen.runtime.abi.STOP` from another thread stops the run that is
            being worked on; `symgen.runtime.ensemble_abi.RUNS_DONE` counts finished ones.
        """
        recipe, k, n_times = self.recipe, len(rows), len(self.recipe.spec.times)
        values, behind = (np.full((k, len(q), n_times), np.nan) for q in (recipe.columns, recipe.behind))
        out = Results(values, np.zeros((k, e.N_SUMMARY)), np.zeros((k, recipe.further)), behind)
        everything = np.arange(k, dtype=np.int64)
        complete = self._run_with(self.first, rows, everything, out, control)
        light = np.flatnonzero((out.summary[:, e.LIGHT] == 1.0) & (out.summary[:, e.START] == e.ASSEMBLED))
        if complete and len(light) and (spare := self.spare()) is not None:
            out.summary[light] = 0.0
            complete = self._run_with(spare, rows, light.astype(np.int64), out, control)
            out.summary[light, e.LIGHT] = 1.0
        return Chunk(recipe.in_order(values, behind), np.hstack([out.summary, out.events]), complete)

    def _described(self, model: _Prepared, rows: Rows) -> Instant:
        """Return rows as they are described."""
        info, k, room = model.compiled.info, len(rows), max(len(rows), 1)
        now = Instant(
            np.zeros((room, info.ny)), np.tile(model.p, (room, 1)), np.empty((room, max(1, model.compiled.law.nw)))
        )
        now.p[:k, : len(info.parameters)], now.y[:k, : info.nq] = rows.parameters, rows.q
        return now

    def _run_with(self, model: _Prepared, rows: Rows, selected: Integers, out: Results, control: Integers) -> bool:
        """Close and run selected rows with one compiled model; those with light bodies only where there is no other."""
        info, recipe, now = model.compiled.info, self.recipe, self._described(model, rows)
        asked = Asked(rows.v, rows.targets, out.summary)
        if model.assembly.close_all(now, asked, selected, control) < len(selected):
            return False
        self._look_at_sides(info, now.y, selected, out.summary)
        ready = out.summary[selected, e.START] == e.ASSEMBLED
        if model is self.first and recipe.spare is not None:
            ready &= out.summary[selected, e.LIGHT] == 0.0
        selected = selected[ready]
        if model.tree is not None and model.on_tree is not None:
            starts, apart, alike = model.tree.settle(now, selected, control)
            plain, selected = model.tree.upright(selected[apart], alike, out.summary), selected[~apart]
            if not self._advance(model.on_tree, rows, starts, plain, out, control):
                return False
            model.tree.turn(recipe.quantities, plain, alike, out.values)
        if model.single is not None:
            return model.single.run(rows, now, selected, out, control)
        if not self._advance(model, rows, now, selected, out, control):
            return False
        redundant = selected[out.summary[selected, e.REDUNDANT_ROWS] > 0.0]
        for i in (i for i, q in enumerate(recipe.columns) if q.source == e.MULTIPLIER):  # they are not unique then
            out.values[redundant, i] = np.nan
        if model.measures is not None:
            given = recipe.behind, recipe.times, selected, out.values, now.p, now.w
            out.behind[selected] = model.measures.work_out(model.compiled, *given)
        return True

    def _look_at_sides(self, info: ModelInfo, ys: Array, selected: Integers, summary: Array) -> None:
        """Refuse starts in which joints hold bodies the wrong way round, as single runs do."""
        if not self.recipe.sides:
            return
        closed = selected[summary[selected, e.START] == e.ASSEMBLED]
        q, joints = ys[closed, : info.nq].T, joints_of(info)
        for side in reversed(self.recipe.sides):  # the first one is told
            rows = closed[side.cosine(q) < 0.0]
            summary[rows, e.START], summary[rows, e.START_WHERE] = e.HALF_TURN, joints.index(side.joint)

    def _advance(
        self, model: _Prepared, rows: Rows, now: Instant, selected: Integers, out: Results, control: Integers
    ) -> bool:
        """Run selected rows from their starts, parameters and scratch; return whether all are done."""
        from symgen.runtime.records import Chunk as ChunkRecord
        from symgen.runtime.redundancy import room_of_choice
        from symgen.runtime.rows import observe_nothing

        info, law, recipe, summary = model.compiled.info, model.compiled.law_module, self.recipe, out.summary
        if model.device is not None:
            return model.device.run(*now, selected, out.values, summary, control) == len(selected)
        picked = recipe.picks if model.picks is None else model.picks
        sources = {*picked[::2].tolist()}
        observes = e.JOINT in sources
        observe = model.compiled.model.observe if model.width is None else model.compiled.model.bodies
        rates, seen = rates_of(law), observe if observes else observe_nothing
        sizes, span, kept = sizes_of(model.compiled), span_of(recipe.spec, model.setup), self._kept(info, model.width)
        needs = {e.ACCELERATION, e.MULTIPLIER} | ({e.JOINT} if model.width is None else set())
        ends = int(recipe.watch is not None and recipe.watch.ends)
        wants = ends, int(bool(sources & needs)), int(observes)
        picks = picked, out.values.reshape(-1), summary.reshape(-1), out.events.reshape(-1)
        redundant = np.any(summary[selected, e.REDUNDANT_ROWS] > 0.0)
        dense = np.zeros(room_of_choice(info.m, info.nv) if redundant else 0)
        flat, places = (x.ravel() for x in now), (model.compiled.layout, dense)
        chunk = ChunkRecord._make((selected, *flat, recipe.limits, *picks, *wants, *places))
        room = max(model.setup.room, 2 * info.ny + kept.observed.rows.shape[1])
        state = new_state(model.compiled, sizes, model.setup.memory, room)._replace(control=control)
        if model.lanes is not None:
            observed = sizes, *rates, law.accept, seen
            if run_in_lanes(model.lanes, observed, model.setup.scheme, span, chunk, state, kept) < len(selected):
                return False
            chunk = chunk._replace(selected=selected[summary[selected, e.CODE] == abi.LEFT])
        loop, system = self.integrator.rows(recipe.spec.adaptive), (sizes, *model.setup.functions)
        if model.watched is not None:
            from symgen.runtime.searching import decide

            system = *system, model.watched.function, decide, rates[0]
            state = model.watched.hunting_state(sizes, state)
            if out.events.shape[1]:
                out.events[selected] = np.nan
                out.events[selected, e.HEAD_OF_EVENTS :: e.OF_EVENT] = 0.0
        if model.watched is not None or recipe.stops:
            from symgen.runtime.rows import variant

            inner = self.integrator.loop(recipe.spec.adaptive)
            loop = variant(loop, model.watched is not None, recipe.stops)
        if recipe.stops:
            from symgen.runtime.hunting import with_events
            from symgen.runtime.stopping import with_table

            inner = inner if model.watched is None else with_events(inner)
            system = with_table(model.compiled, system, inner, recipe.spec.adaptive, rows.stops or ((),))
        done = loop((system, (sizes, *rates, law.accept, seen)), model.setup.scheme, span, chunk, state, kept)
        return bool(done == len(chunk.selected))

    def _kept(self, info: ModelInfo, width: int | None) -> Kept:
        """Return room for the outputs of one run, and for what is observed at them."""
        from symgen.runtime.records import Kept, Observed

        times = self.recipe.times
        k, rows = len(times), info.observed if width is None else width
        observed = Observed(np.zeros((k, info.nv)), np.zeros((k, info.m)), np.zeros((k, rows)))
        return Kept(new_outputs(info, times), observed)

    def _prepare(self, code: Code) -> _Prepared:
        compiled, recipe = code.module.load(), self.recipe
        other, info = None if code.other is None else code.other.load(), compiled.info
        defaults = {q.name: 0.0 for q in info.parameters}
        p = compiled.parameter_array(defaults, recipe.method_parameters)
        setup = self.integrator.setup(compiled, recipe.spec, compiled.scratch())
        joints = ({k: 0.0 for k, rate in recipe.joints if rate == of} for of in (0, 1))
        held = Held(dict.fromkeys(recipe.held, 0.0), dict.fromkeys(recipe.kept, 0.0), recipe.fixed, *joints)
        carried = None if recipe.tree is None or code.tree is None else (recipe.tree.mechanism, code.tree.load())
        prepared = _Prepared(
            compiled=compiled,
            assembly=Assembly(compiled, held, recipe.strict, recipe.spare is not None),
            p=p,
            setup=setup,
            measures=code.measures,
            device=self._device_runs(other, setup) if other is not None and recipe.target == "cuda" else None,
            lanes=other if recipe.target == "lanes" else None,
        )
        watch = recipe.watch
        if watch is not None and watch.alone:
            from symgen.ensemble.singly import SingleRuns

            prepared.single = SingleRuns(recipe, watch, compiled, self.integrator, carried)
        elif watch is not None:
            prepared.watched = self._watched(watch.mechanism, compiled)
        if watch is not None and recipe.tree is not None and carried is not None and recipe.tree.plain:
            from symgen.ensemble.tree_rows import TreeRows

            values = carried[1].parameter_array(defaults, recipe.method_parameters)
            prepared.tree = TreeRows.of(watch.mechanism, carried[0], compiled, carried[1], values)
            prepared.on_tree = _Prepared(
                compiled=carried[1],
                assembly=Assembly(carried[1]),
                p=values,
                setup=self.integrator.setup(carried[1], recipe.spec, carried[1].scratch()),
                picks=prepared.tree.picks(recipe.quantities),
                width=prepared.tree.width,
                watched=self._watched(*carried),
            )
        return prepared

    def _watched(self, mechanism: Mechanism, compiled: CompiledModel) -> Watched | None:
        """Return the switching functions of rows, None where there are none."""
        watch, spec = self.recipe.watch, self.recipe.spec
        assert watch is not None, "rows look for something"
        return compile_events(mechanism, compiled, watch.events, {}, spec.rtol if spec.adaptive else None)

    def _device_runs(self, compiled: CompiledModel, setup: Setup) -> DeviceRuns:
        from symgen.ensemble.device import DeviceRuns, need_of

        recipe = self.recipe
        need = need_of(compiled, setup, recipe.spec.adaptive, recipe.sources)
        return DeviceRuns(
            compiled, need, setup.scheme, span_of(recipe.spec, setup), recipe.limits, recipe.times, recipe.picks
        )


def integrator_of_rows(name: str, spec: RunSpec) -> Integrator:
    """Return an integrator that has a loop over many runs.

    Raises
    ------
    InputError
        If it has none; says which have one.
    """
    chosen: Integrator = INTEGRATORS.get(name, "--integrator")
    if chosen.rows(spec.adaptive) is None:
        with_loop = [other for other, kind in INTEGRATORS.items() if kind.rows(False) is not None]
        raise InputError(
            f"integrator '{name}'",
            "one with a loop over many runs",
            "one without",
            f"{', '.join(with_loop)} have one",
        )
    return chosen


def new_control() -> Integers:
    """Return the integers that a chunk shares with whoever watches it."""
    return np.zeros(e.N_CONTROL, dtype=np.int64)


_kernels: dict[str, Kernel] = {}
_kernels_lock = threading.Lock()


def kernel_of(recipe: Recipe) -> Kernel:
    """Return the kernel of a recipe, the same one as long as it is among the last few."""
    with _kernels_lock:
        found = _kernels.get(recipe.digest)
        if found is None:
            while len(_kernels) >= 4:
                del _kernels[next(iter(_kernels))]
            found = _kernels[recipe.digest] = Kernel(recipe)
    return found

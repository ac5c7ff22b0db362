"""Rows of an ensemble run by one compiled loop: of bodies, in vector lanes, or in joint coordinates."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from symgen.base.ir.program import LANES, lane_bases
from symgen.compile.loopcode.padding import aligned
from symgen.run.layout import abi
from symgen.run.layout import ensemble_abi as e
from symgen.run.layout.probe import rate_functions
from symgen.run.layout.records import Kept, Observed, RowChunk
from symgen.run.layout.redundancy import room_of_choice
from symgen.run.layout.start_records import Instant
from symgen.run.loops.afresh import begin_afresh
from symgen.run.loops.event_loop import loop_with_events
from symgen.run.loops.seams import arguments_with_table, preparing_functions, seams_of_loop
from symgen.run.loops.searching import search_of
from symgen.run.rows.row_observers import observe_rows_between_seams, observe_rows_left
from symgen.run.rows.rows import balance_nothing, observe_nothing_of_coordinates, over_rows
from symgen.run.single.events import event_state
from symgen.run.single.new_state import model_sizes, new_outputs, new_state, span_of
from symgen.run.single.turn_memory import effects_of_runs, modes_of_runs
from symgen.run.starts.assembler import layout_of_starts
from symgen.run.starts.tree_start import TURNED_OVER, Carried

if TYPE_CHECKING:
    from symgen.run.layout.compiled import CompiledModel, ModelInfo
    from symgen.run.layout.records import Span, State
    from symgen.run.loops.integrator import Integrator, Setup
    from symgen.run.loops.run_spec import Watched
    from symgen.study.ensemble.chunks import Results, Rows
    from symgen.study.ensemble.recipe import Recipe

Array = NDArray[np.float64]
Integers = NDArray[np.int64]

#: What loops leave of a motion in joint coordinates; further quantities are those of bodies (`BodyObserver`).
PLAIN = {e.STATE, e.STATUS, e.ENERGY, e.ENERGY_ERROR}


@dataclass(frozen=True)
class LoopRuns:
    """Runs rows of a compiled model from their starts.

    Attributes
    ----------
    recipe : Recipe
        Data that the runs share.
    compiled : CompiledModel
        Code of the runs.
    integrator, setup : Integrator, Setup
        The scheme, and what its loop takes.
    picks : Array of int
        (source, column) of each column that is kept, flat.
    watched : Watched or None
        Switching functions.
    lanes : CompiledModel or None
        The same law for vector lanes.
    width : int or None
        Numbers by which a tree tells the motion of bodies at outputs; None where bodies are run.
    """

    recipe: Recipe
    compiled: CompiledModel
    integrator: Integrator
    setup: Setup
    picks: Integers
    watched: Watched | None = None
    lanes: CompiledModel | None = None
    width: int | None = None

    def run(self, rows: Rows, starts: Instant, selected: Integers, out: Results, control: Integers) -> bool:
        """Run selected rows; return whether all are done.

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
        recipe, setup, summary = self.recipe, self.setup, out.summary
        compiled, adaptive = self.compiled, recipe.spec.adaptive
        observers, span, chunk, state, series = self._arguments(starts, selected, out, control)
        sizes, rates = observers[:2]
        if self.lanes is not None:
            if self._run_in_lanes(self.lanes, observers, span, chunk, state, series) < len(selected):
                return False
            chunk = chunk._replace(selected=selected[summary[selected, e.CODE] == abi.LEFT])
        system, inner = (sizes, *setup.functions), self.integrator.loop(adaptive)
        if self.watched is not None:
            search = search_of(self.watched.bounded is not None)
            system, inner = (*system, self.watched.function, search, rates), loop_with_events(inner)
            state = event_state(self.watched, sizes, state)
            if out.events.shape[1]:
                out.events[selected] = np.nan
                out.events[selected, e.HEAD_OF_EVENTS :: e.OF_EVENT] = 0.0
        further: tuple[Any, ...] = ()
        effects = self.watched is not None and self.watched.effects is not None
        modes = self.watched is not None and self.watched.bounded is not None
        if self.watched is not None and self.watched.bounded is not None:
            rows_and_events = self.watched, self.watched.bounded, span
            further = (modes_of_runs(compiled, *rows_and_events, sizes.width, len(state.w)),)
        elif self.watched is not None and effects:
            further = (effects_of_runs(compiled, self.watched, recipe.spec.until, sizes.width, len(state.w)),)
        examined = self.watched is not None and self.watched.rows is not None
        loop = over_rows(
            self.integrator.loop(adaptive),
            self.watched is not None,
            recipe.seams,
            effects,
            examined,
            modes,
            () if self.watched is None else self.watched.turning,
        )
        if recipe.seams:
            system = arguments_with_table(compiled, system, inner, adaptive, rows.seams or ((),), alone=False)
        done = loop((system, observers, *further), setup.scheme, span, chunk, state, series)
        while control[e.EXAMINATION] == e.WAITS:
            self._examine_last_step(state)
            chunk = chunk._replace(selected=chunk.selected[done:])
            done = loop((system, observers, *further), setup.scheme, span, chunk, state, series)
        return bool(done == len(chunk.selected))

    def observe(
        self, rows: Rows, starts: Instant, selected: Integers, left: Array, out: Results, control: Integers
    ) -> bool:
        """Write quantities of selected rows by the motion that another loop has left; return whether all are done.

        Parameters
        ----------
        rows, starts, selected, out, control
            As for `run`; `out` has the summaries of the runs.
        left : Array, shape (rows, ny + status, times)
            See `symgen.run.rows.row_observers.observe_left`.
        """
        recipe = self.recipe
        observers, span, chunk, state, series = self._arguments(starts, selected, out, control)
        if not recipe.seams:
            return bool(observe_rows_left((0, observers), span, chunk, state, series, left) == len(selected))
        seams = seams_of_loop(self.compiled, recipe.spec.adaptive, rows.seams or ((),))
        model = (0, seams, 0, *preparing_functions(self.compiled)), observers
        return bool(observe_rows_between_seams(model, span, chunk, state, series, left) == len(selected))

    def _arguments(
        self, starts: Instant, selected: Integers, out: Results, control: Integers
    ) -> tuple[tuple[Any, ...], Span, RowChunk, State, Kept]:
        """Return sizes and functions of the model, steps, rows, state and outputs, as loops over rows take them."""
        recipe, compiled, setup = self.recipe, self.compiled, self.setup
        info, model, law = compiled.info, compiled.model, compiled.law_module
        rates, sizes, span, series = (
            rate_functions(law),
            model_sizes(compiled),
            span_of(recipe.spec, setup),
            self._room_for_outputs(),
        )
        sources = {*self.picks[::2].tolist()}
        needs = {e.ACCELERATION, e.MULTIPLIER} | ({e.JOINT} if self.width is None else set())
        observe = model.observe if self.width is None else model.bodies
        observe = observe if e.JOINT in sources else observe_nothing_of_coordinates
        wants = (
            int(recipe.watch is not None and recipe.watch.ends),
            int(bool(sources & needs)),
            int(e.JOINT in sources),
            int(hasattr(law, "balance")),
        )
        masked = bool(np.any(compiled.section(starts.w.T, "mask")[:, selected]))
        places = layout_of_starts(compiled), np.zeros(room_of_choice(info.m, info.nv) if masked else 0)
        results = out.values.reshape(-1), out.summary.reshape(-1), out.events.reshape(-1)
        arrays = (selected, *(x.ravel() for x in starts), recipe.limits, self.picks, *results)
        chunk = RowChunk._make((*arrays, *wants, *places))
        room = max(setup.room, 2 * info.ny + series.observed.rows.shape[1])
        datum = recipe.datum if self.width is None else ()  # joint coordinates have no origin
        state = new_state(compiled, sizes, setup.memory, room, datum)._replace(control=control)
        balance = getattr(law, "balance", balance_nothing)
        return (sizes, *rates, law.accept, observe, balance), span, chunk, state, series

    def _examine_last_step(self, state: Any) -> None:
        """Examine the constraints that may jump in the last step of a run, as a single run does."""
        assert self.watched is not None and self.watched.rows is not None, "a run waits for it"
        jumps = bool(self.watched.rows.sentence(self.compiled, state))
        if not jumps and self.watched.adaptive:
            begin_afresh(state)
        state.control[e.EXAMINATION] = e.JUMPS if jumps else e.HOLDS

    def _room_for_outputs(self) -> Kept:
        """Return room for the outputs of one run, and for what is observed at them."""
        times, info = self.recipe.times, self.compiled.info
        k, rows = len(times), info.observed if self.width is None else self.width
        observed = Observed(np.zeros((k, info.nv)), np.zeros((k, info.m)), np.zeros((k, rows)))
        return Kept(new_outputs(info, times), observed)

    def _run_in_lanes(
        self,
        lanes: CompiledModel,
        observers: tuple[Any, ...],
        span: Span,
        chunk: RowChunk,
        state: State,
        series: Kept,
    ) -> int:
        """Run selected rows several at once; those that single runs have to do get the code `LEFT` in the summary.

        Parameters
        ----------
        lanes : CompiledModel
            Modules emitted for lanes.
        observers : tuple
            The sizes of the model, and what single runs call at outputs: rates and their confirmation, ``accept``,
            ``observe``.
        span, chunk, state, series
            As for `symgen.run.rows.rows.run_rows`.

        Returns
        -------
        int
            Number of rows that were worked on.
        """
        from symgen.run.rows.lanes import lane_runs, room_of_lanes

        info, law, scheme, (sizes, *others) = lanes.info, lanes.law_module, self.setup.scheme, observers
        lengths = len(state.p), len(state.w), info.kept, len(series.outputs.times)
        state = state._replace(room=aligned(room_of_lanes(info.ny, scheme.stages, *lengths)))
        wide = sizes._replace(width=LANES * lane_bases(info.ny, 0, 0)["ydot"])
        return int(lane_runs((wide, law.rhs, law.accept, *others), scheme, span, chunk, state, series))


@dataclass(frozen=True)
class BodyObserver:
    """Observes the motion of bodies that a loop over a tree of joints leaves.

    Attributes
    ----------
    loop : LoopRuns
        Of the bodies, whose law gives the quantities.
    turned : dict of int to float
        Sign of each column of the motion that has one.
    """

    loop: LoopRuns
    turned: Mapping[int, float]


def motion_picks(info: ModelInfo, own: ModelInfo, turns: Sequence[tuple[bool, int, float]]) -> list[tuple[int, int]]:
    """Return the columns of a tree's loop that are the motion of bodies: their states, and their status.

    Parameters
    ----------
    info, own : ModelInfo
        Of the bodies, and of the tree.
    turns : sequence of (bool, int, float)
        From `symgen.run.planning.tree.places_of_turns`.
    """
    picks = [(e.JOINT, i - own.m) for i in range(info.work)]
    picks += [(e.STATE, i) for i in range(own.work, own.ny)]
    picks += [(e.STATUS, i) for i in range(abi.N_STATUS)]
    picks += [(e.STATE, i) if is_coordinate else (e.STATUS, abi.N_STATUS + i) for is_coordinate, i, _ in turns]
    return picks + [(e.STATUS, abi.N_STATUS + i) for i in range(own.windings, own.kept)]


@dataclass(frozen=True)
class TreeRuns:
    """Runs rows in joint coordinates from starts of bodies.

    Attributes
    ----------
    carried : Carried
        Starts of bodies mapped to the tree.
    p : Array
        Parameters of the tree that all rows share.
    loop : LoopRuns
        Of the tree.
    observer : BodyObserver or None
        Computes the quantities; None where the tree's loop leaves all of them.
    """

    carried: Carried
    p: Array
    loop: LoopRuns
    observer: BodyObserver | None = None

    def run(self, rows: Rows, starts: Instant, selected: Integers, out: Results, control: Integers) -> bool:
        """Run selected rows from consistent starts; parameters as for `LoopRuns.run`."""
        info, own, runs = self.carried.bodies.info, self.loop.compiled.info, len(starts.y)
        scratch = np.zeros((runs, len(self.loop.compiled.scratch())))
        now, count = Instant(np.zeros((runs, own.ny)), np.tile(self.p, (runs, 1)), scratch), len(info.parameters)
        now.p[:, :count] = starts.p[:, :count]
        now.y[:, own.work :] = starts.y[:, info.work :]  # work and the file's own states, which no joint maps
        rows.put_method_parameters(self.loop.compiled.law, now.p)
        alike = self.carried.settle(starts, now, selected, control)
        over = np.abs(alike[selected]) < TURNED_OVER
        for k in reversed(range(over.shape[1])):  # the first one stays
            out.summary[selected[over[:, k]], [[e.START], [e.START_WHERE]]] = [[e.TURNED_OVER], [k]]
        selected = selected[~over.any(axis=1)]
        if self.observer is None:
            done = self.loop.run(rows, now, selected, out, control)
            columns = {q.column: i for i, q in enumerate(self.loop.recipe.quantities) if q.source == e.STATE}
            self._continue_signs(selected, alike, columns, out.values)
            return done
        left = np.full((runs, len(self.loop.picks) // 2, len(self.loop.recipe.times)), np.nan)
        if not self.loop.run(rows, now, selected, replace(out, values=left), control):
            return False
        self._continue_signs(selected, alike, {i: i for i in range(info.nq)}, left)
        for column, sign in self.observer.turned.items():
            left[:, column] *= sign
        starts.w[selected, abi.STEP_STATUS] = now.w[selected, abi.STEP_STATUS]
        return self.observer.loop.observe(rows, starts, selected, left, out, control)

    def _continue_signs(self, selected: Integers, alike: Array, at: Mapping[int, int], values: Array) -> None:
        """Have Euler parameters, which have two signs, go on from the start's; `at` has the columns of coordinates."""
        for (first, _), products in zip(self.carried.bodies.info.spins, alike.T, strict=True):
            columns = [at[k] for k in range(first, first + 4) if k in at]
            values[np.ix_(selected[products[selected] < 0.0], columns)] *= -1.0

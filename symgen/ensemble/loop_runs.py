"""Rows of an ensemble run by one compiled loop, on a processor, in its vector lanes where asked for."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from symgen.ensemble.lanes import run_in_lanes
from symgen.runtime import abi
from symgen.runtime import ensemble_abi as e
from symgen.runtime.hunting import with_events
from symgen.runtime.new_state import new_outputs, new_state, sizes_of, span_of
from symgen.runtime.probe import rates_of
from symgen.runtime.records import Kept, Observed, RowChunk
from symgen.runtime.redundancy import room_of_choice
from symgen.runtime.rows import observe_nothing, variant
from symgen.runtime.searching import decide
from symgen.runtime.stopping import with_table

if TYPE_CHECKING:
    from symgen.ensemble.chunks import Results
    from symgen.ensemble.recipe import Recipe
    from symgen.ensemble.row_starts import Rows
    from symgen.runtime.compiled import CompiledModel
    from symgen.runtime.events import Watched
    from symgen.runtime.integrator import Integrator, Setup
    from symgen.runtime.start_records import Instant

Integers = NDArray[np.int64]


@dataclass(frozen=True)
class LoopRuns:
    """Runs rows of a compiled model from their starts.

    Attributes
    ----------
    recipe : Recipe
        What the runs share.
    compiled : CompiledModel
        What is run.
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
            What distinguishes the runs.
        starts : Instant
            States, parameters and scratch of all rows.
        selected, control : Array of int
            Rows to work on; what the watching thread shares.
        out : Results
            Written.
        """
        recipe, compiled, setup, summary = self.recipe, self.compiled, self.setup, out.summary
        info, model, law, adaptive = compiled.info, compiled.model, compiled.law_module, recipe.spec.adaptive
        rates, sizes, span, kept = rates_of(law), sizes_of(compiled), span_of(recipe.spec, setup), self._kept()
        sources = {*self.picks[::2].tolist()}
        needs = {e.ACCELERATION, e.MULTIPLIER} | ({e.JOINT} if self.width is None else set())
        observe = model.observe if self.width is None else model.bodies
        observe = observe if e.JOINT in sources else observe_nothing
        wants = (
            int(recipe.watch is not None and recipe.watch.ends),
            int(bool(sources & needs)),
            int(e.JOINT in sources),
        )
        masked = bool(np.any(compiled.section(starts.w.T, "mask")[:, selected]))
        places = compiled.layout, np.zeros(room_of_choice(info.m, info.nv) if masked else 0)
        results = out.values.reshape(-1), summary.reshape(-1), out.events.reshape(-1)
        arrays = (selected, *(x.ravel() for x in starts), recipe.limits, self.picks, *results)
        chunk = RowChunk._make((*arrays, *wants, *places))
        room = max(setup.room, 2 * info.ny + kept.observed.rows.shape[1])
        state = new_state(compiled, sizes, setup.memory, room)._replace(control=control)
        observers = sizes, *rates, law.accept, observe
        if self.lanes is not None:
            if run_in_lanes(self.lanes, observers, setup.scheme, span, chunk, state, kept) < len(selected):
                return False
            chunk = chunk._replace(selected=selected[summary[selected, e.CODE] == abi.LEFT])
        system, inner = (sizes, *setup.functions), self.integrator.loop(adaptive)
        if self.watched is not None:
            system, inner = (*system, self.watched.function, decide, rates[0]), with_events(inner)
            state = self.watched.hunting_state(sizes, state)
            if out.events.shape[1]:
                out.events[selected] = np.nan
                out.events[selected, e.HEAD_OF_EVENTS :: e.OF_EVENT] = 0.0
        loop = variant(self.integrator.rows(adaptive), self.watched is not None, recipe.stops)
        if recipe.stops:
            system = with_table(compiled, system, inner, adaptive, rows.stops or ((),))
        done = loop((system, observers), setup.scheme, span, chunk, state, kept)
        return bool(done == len(chunk.selected))

    def _kept(self) -> Kept:
        """Return room for the outputs of one run, and for what is observed at them."""
        times, info = self.recipe.times, self.compiled.info
        k, rows = len(times), info.observed if self.width is None else self.width
        observed = Observed(np.zeros((k, info.nv)), np.zeros((k, info.m)), np.zeros((k, rows)))
        return Kept(new_outputs(info, times), observed)

"""Functions of starts and events bound to one compiled model, for printers of other languages."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Collection, Hashable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np

from symgen.compile.loopcode.exact import compiled_form
from symgen.compile.native import language as lang
from symgen.compile.native.binding import BoundFunctions, Meaning, bind_functions
from symgen.describe.parts.event_sections import RECORD, STOP
from symgen.run.compiling.checked import checked_function
from symgen.run.compiling.events import DIRECTIONS, effects_of_events
from symgen.run.compiling.side import compile_side
from symgen.run.effects.applying import apply_effects
from symgen.run.effects.effects import Effects
from symgen.run.effects.locking import find_lock, new_lock_work
from symgen.run.effects.stepping import find_rates, new_step_work, take_step, take_steps
from symgen.run.layout import abi
from symgen.run.layout.ensemble_abi import N_SUMMARY
from symgen.run.layout.start_records import Instant, StartConditions
from symgen.run.printed import partition
from symgen.run.printed.exchanged_directions import direct_rates
from symgen.run.printed.exchanged_steps import exchange_steps
from symgen.run.printed.partition_tables import PartitionTables, new_partition
from symgen.run.starts.assembler import layout_of_starts
from symgen.run.starts.starting import begin_row, close_row, observe_nothing

if TYPE_CHECKING:
    from symgen.describe.mechanism import Mechanism
    from symgen.run.compiling.printed_run import PrintedRun
    from symgen.run.layout.compiled import CompiledModel
    from symgen.run.starts.assembler import Assembly
from symgen.run.compiling.printed_meanings import identity_of_meaning, meanings_of_names, source_of_piece

#: Names of the switching functions of events, of the formulas of their effects, and of those of M at starts.
SWITCHING, CHANGED, WEIGHED = "formulas_of_events", "formulas_of_effects", "formulas_of_masses"


@dataclass(frozen=True)
class PrintedEvents:
    """The events of a mechanism, for printed steps.

    Attributes
    ----------
    directions, ends : sequence of int
        Of each event, as in `symgen.run.effects.stepping.StepModel`; 1 for each event that ends runs, else 0. Empty
        where all events are only recorded.
    switching : emitted function, optional
        Switching functions of all events.
    effects : Effects, optional
        What events change.
    """

    directions: Sequence[int] = ()
    ends: Sequence[int] = ()
    switching: Any = None
    effects: Effects | None = None

    @classmethod
    def of(cls, mechanism: Mechanism, compiled: CompiledModel) -> PrintedEvents:
        """Return the events of a mechanism."""
        events = mechanism.events
        if not events:
            return cls()
        conditions = [(event.name, event.when) for event in events]
        switching = compile_side(mechanism, compiled, "events", "Switching functions", conditions).function
        effects = effects_of_events(mechanism, compiled, events)
        if all(event.action == RECORD for event in events):
            return cls((), (), switching, effects)
        directions = [2 if event.action == RECORD else DIRECTIONS[event.direction] for event in events]
        return cls(directions, [int(event.action == STOP) for event in events], switching, effects)

    def steps(self, compiled: CompiledModel) -> tuple[tuple[Any, ...], tuple[Any, ...]]:
        """Return a `symgen.run.effects.stepping.RUN_MODEL`; an instant, counters, memory of steps and of effects."""
        law, scratch, ny = compiled.law_module, compiled.scratch(), compiled.info.ny
        effects = self.effects or Effects(compiled, (), {}, observe_nothing, ())
        directions, ends = (np.array(x, dtype=np.int64) for x in (self.directions, self.ends))
        functions = law.rhs, getattr(law, "confirm", law.rhs), law.accept, self.switching or observe_nothing
        now = Instant(np.zeros(ny), compiled.parameter_array(defaultdict(float), {}), scratch)
        work, impact = new_step_work(ny, len(scratch), len(directions)), effects.memory(ny, len(scratch))
        model = (effects.model[0], *functions, directions), effects.model, ends
        return model, (now, np.zeros(abi.N_COUNTERS, dtype=np.int64), work, impact)

    @property
    def functions(self) -> dict[str, lang.Function]:
        """Emitted functions by their names in the text."""
        sides = {SWITCHING: self.switching, CHANGED: self.effects.formulas if self.effects else None}
        return {name: checked_function(f, abi.OBSERVE) for name, f in sides.items() if f is not None}


#: Arrays that are no part of a record; states and rates are passed.
_ALONE = {"y": "", "rate": "", "state": "", "p": "p", "w": "w", "iw": "iw", "chosen": "chosen"}
_ALONE_IN_EXCHANGE = {"values": "", "happened": "exchange_happened"}


def _room_of_steps(name: str) -> str | None:
    """Return the name of an array of steps or effects in the memory; see `Naming`."""
    owner, _, own = name.partition(".")
    if owner == "work":
        return own if own == "chosen" else f"step_{own}"
    if owner == "impact":
        return f"effect_{own.replace('.', '_')}"
    return own.replace("y", "") if owner == "now" else _ALONE.get(name)


def _room_of_exchange(name: str) -> str | None:
    """Return the name of an array of states or events of an importer in the memory; see `Naming`."""
    owner, _, own = name.partition(".")
    if owner == "part":
        return f"partition_{own}"
    if owner == "now":
        return own
    return _ALONE_IN_EXCHANGE[name] if name in _ALONE_IN_EXCHANGE else _room_of_steps(name)


def _room_of_directions(name: str) -> str | None:
    """Return the name of an array with directions in the memory; see `Naming`."""
    owner, _, own = name.partition(".")
    return f"partition_{own}" if owner == "part" else None if own else f"directed_{owner}"


def _partition_model(compiled: CompiledModel, tables: PartitionTables) -> tuple[Any, ...]:
    """Return a `symgen.run.printed.partition_tables.PartitionModel`."""
    return layout_of_starts(compiled), compiled_form(compiled.model.geometry), tables


def _room_of_lock(name: str) -> str | None:
    """Return the name of an array of `find_lock` in the memory; see `Naming`."""
    owner, _, own = name.partition(".")
    return own.replace("y", "") if owner == "now" else f"lock_{own}" if owner == "work" else None


@dataclass(frozen=True)
class Printed:
    """Functions of the runtime for one compiled model in another language.

    Attributes
    ----------
    emitted : dict of str to Function
        Emitted functions by their names in the text; those that starts need further are added.
    entries : dict
        Functions of the runtime by their names in the text, with the meanings of their parameters.
    """

    emitted: dict[str, lang.Function]
    entries: dict[str, tuple[lang.Function, dict[str, Meaning]]] = field(default_factory=dict)

    @property
    def key(self) -> Hashable:
        """Identity of all functions and meanings, from which any text of them follows."""
        emitted = tuple((name, function.key) for name, function in self.emitted.items())
        entries = (
            (name, function.key, tuple((parameter, identity_of_meaning(x)) for parameter, x in meanings.items()))
            for name, (function, meanings) in self.entries.items()
        )
        return emitted, tuple(entries)

    def bind_functions(self) -> BoundFunctions:
        """Return the functions bound to the model."""
        return bind_functions(self.entries, frozenset(f.key for f in self.emitted.values()))

    def add_steps(self, compiled: CompiledModel, events: PrintedEvents, names: Collection[str]) -> None:
        """Add functions of `symgen.run.effects.stepping`, and the effects of events.

        They are ``find_rates(t, y, rate)``, ``take_step(t, h, y)`` and ``take_steps(until, h, y)``, and where events
        change the state ``apply_effects(t, y)`` for the events in ``chosen``.

        Parameters
        ----------
        compiled : CompiledModel
            Model and method.
        events : PrintedEvents
            The events.
        names : collection of str
            Names of those functions that are added.
        """
        emitted, (model, (now, iw, work, impact)) = self._of_steps(compiled, events), events.steps(compiled)
        (steps, of_effects, _), rate = model, np.zeros(compiled.info.ny)
        arguments: dict[str, tuple[Any, tuple[Any, ...]]] = {
            "find_rates": (find_rates, (steps, None, rate, now.p, now.w, iw, rate)),
            "take_step": (take_step, (steps, None, None, now, iw, work)),
            "take_steps": (take_steps, (model, None, None, now, iw, work, impact)),
            "apply_effects": (apply_effects, (of_effects, None, now, work.chosen, impact)),
        }
        for name in names:
            function, values = arguments[name]
            own = function is apply_effects  # whose memory has another name elsewhere
            room = (lambda name: _room_of_steps(name.replace("work.", "impact."))) if own else _room_of_steps
            self.entries[name] = source_of_piece(function), meanings_of_names(function, values, emitted, room)

    def _of_steps(self, compiled: CompiledModel, events: PrintedEvents) -> dict[int, lang.Function]:
        """Return the emitted functions of steps by their identity."""
        law, effects = compiled.law_module, events.effects
        confirm = getattr(law, "confirm", law.rhs)
        emitted = {id(law.rhs): self.emitted["rhs"], id(law.accept): self.emitted["accept"]}
        emitted[id(confirm)] = self.emitted["rhs" if confirm is law.rhs else "confirm"]
        emitted[id(compiled_form(compiled.model.geometry))] = self.emitted["geometry"]
        if events.switching is not None:
            emitted[id(events.switching)] = self.emitted[SWITCHING]
        if effects is not None:
            emitted[id(compiled_form(effects.formulas))] = self.emitted[CHANGED]
        if effects is not None and effects.bodies:
            emitted[id(compiled_form(compiled.model.bodies))] = self.emitted["bodies"]
        return emitted

    def add_partition(self, compiled: CompiledModel, tables: PartitionTables) -> None:
        """Add functions of `symgen.run.printed.partition`: the states of model exchange.

        They are ``choose_states(t, y)``, ``choose_left(t, y)`` where rows have bounds, ``complete_state(t, y)``,
        ``quality_of_choice(t, y)``, ``read_states(y, values)`` and ``write_states(values, y)``.

        Parameters
        ----------
        compiled : CompiledModel
            Model and method.
        tables : PartitionTables
            What is partitioned.
        """
        model = _partition_model(compiled, tables)
        part, y, w = new_partition(model[0], tables), np.zeros(compiled.info.ny), compiled.scratch()
        p, emitted = np.zeros(1), {id(model[1]): self.emitted["geometry"]}
        state = model, None, y, p, w, part
        arguments: dict[Any, tuple[Any, ...]] = {
            **dict.fromkeys((partition.choose_states, partition.complete_state, partition.quality_of_choice), state),
            **dict.fromkeys((partition.choose_left,) if tables.moded else (), state),
            **dict.fromkeys((partition.read_states, partition.write_states), (model, y, part, y)),
        }
        for function, values in arguments.items():
            entry = source_of_piece(function), meanings_of_names(function, values, emitted, _room_of_exchange)
            self.entries[compiled_form(function).py_func.__name__] = entry

    def add_exchanged_steps(self, compiled: CompiledModel, events: PrintedEvents, tables: PartitionTables) -> None:
        """Add ``exchange_run(doing, t)`` of a mechanism without modes; see `symgen.run.printed.exchanged_steps`.

        Parameters
        ----------
        compiled, tables
            As for `add_partition`.
        events : PrintedEvents
            The events.
        """
        (steps, effects, ends), (now, iw, work, impact) = events.steps(compiled)
        emitted = self._of_steps(compiled, events)
        model = _partition_model(compiled, tables), steps, effects, ends
        memory = now, iw, np.zeros(len(ends), dtype=np.int64), work, impact, new_partition(steps[0], tables)
        meanings = meanings_of_names(exchange_steps, (model, None, None, *memory), emitted, _room_of_exchange)
        self.entries["exchange_run"] = source_of_piece(exchange_steps), meanings

    def add_directions(
        self, compiled: CompiledModel, tables: PartitionTables, directed: Mapping[str, lang.Function]
    ) -> None:
        """Add ``direct_rates(t)``, the directions of what an importer's states decide.

        Parameters
        ----------
        compiled, tables
            As for `add_partition`.
        directed : mapping of str to Function
            Emitted functions with directions, by the names of those without.
        """
        layout, emitted = layout_of_starts(compiled), {id(function): function for function in directed.values()}
        confirm = directed.get("confirm", directed["rhs"])
        names = "prepare_model", "prepare_law", "masses", "geometry", "rhs"
        ny, p, w = compiled.info.ny, compiled.parameter_array(defaultdict(float), {}), compiled.scratch()
        model = layout, tables, *(directed[name] for name in names), confirm, ny, len(w)
        sizes = (2 * ny, 2 * len(p), 2 * len(w) + 1)
        counters, part = np.zeros(abi.N_COUNTERS, dtype=np.int64), new_partition(layout, tables)
        arguments = model, None, *map(np.zeros, sizes), counters, np.zeros(2 * ny), part
        meanings = meanings_of_names(direct_rates, arguments, emitted, _room_of_directions)
        self.entries["direct_rates"] = source_of_piece(direct_rates), meanings

    def add_run(self, run: PrintedRun) -> None:
        """Add ``start_run()`` and ``advance_run(through, h, until)`` of a run with modes."""
        self.entries.update(run.entries(self.emitted))

    def add_exchange(self, run: PrintedRun) -> None:
        """Add ``indicate_run(t, y, values)`` and ``exchange_run(doing, t)`` of a run whose steps an importer makes."""
        self.entries.update(run.exchange_entries(self.emitted))

    def add_reset(self, run: PrintedRun) -> None:
        """Add ``reset_run(event, t, y)``, the effects of one event in a run, see `symgen.run.printed.kept_reset`."""
        self.entries.update(run.reset_entries(self.emitted))

    def add_foresight(self, run: PrintedRun) -> None:
        """Add ``foresee_run(is_start, t)``, which finds the jumps of a run, see `symgen.run.printed.foreseen_run`."""
        self.entries.update(run.foresight_entries(self.emitted))

    def add_lock(self, compiled: CompiledModel, drivers: Collection[str], redundant: int) -> None:
        """Add ``find_lock(t, y)``, see `symgen.run.effects.locking`, for these joints and this number of rows."""
        layout, geometry = layout_of_starts(compiled), compiled.model.geometry
        driven = np.array([int(row.joint in drivers) for row in compiled.info.rows], dtype=np.int64)
        now = Instant(np.zeros(compiled.info.ny), np.zeros(1), compiled.scratch())
        arguments = (layout, geometry, driven, redundant), None, now, new_lock_work(layout)
        emitted = {id(geometry): self.emitted["geometry"]}
        self.entries["find_lock"] = (
            source_of_piece(find_lock),
            meanings_of_names(find_lock, arguments, emitted, _room_of_lock),
        )

    def add_start(self, assembly: Assembly) -> None:
        """Add ``begin_row(state)`` and ``close_row()``, which make the start consistent; see `starting.py`.

        Parameters
        ----------
        assembly : Assembly
            The start, in which no joint coordinates are held.
        """
        joints, work = assembly.memory()
        *own, observe = map(compiled_form, assembly.own)
        compiled, functions = assembly.compiled, dict[int, lang.Function]()
        for name, kind, function in zip(_NAMES, _KINDS, own, strict=True):
            if kind is not None and getattr(compiled.model, name, None) is function:
                if name not in self.emitted:
                    self.emitted[name] = checked_function(function, kind)
                functions[id(function)] = self.emitted[name]
        functions[id(own[-1])] = self.emitted["rhs"]
        if assembly.masses is not None:
            self.emitted[WEIGHED] = checked_function(assembly.masses.formulas, abi.OBSERVE)
            functions[id(compiled_form(assembly.masses.formulas))] = self.emitted[WEIGHED]
        scratch = compiled.printed_scratch()
        now = Instant(np.zeros(compiled.info.ny), compiled.parameter_array(defaultdict(float), {}), scratch)
        conditions = StartConditions(np.zeros(assembly.layout.nv), np.zeros(0), np.zeros(N_SUMMARY))

        def room(name: str) -> str | None:
            owner, _, own = name.partition(".")
            if owner == "now":
                return own
            return f"start_{own}" if owner in ("work", "conditions") else _ALONE.get(name)

        model = (assembly.layout, assembly.table, *own), observe, joints
        meanings = meanings_of_names(close_row, (model, now, conditions, work), functions, room)
        self.entries["close_row"] = source_of_piece(close_row), meanings
        places, counters = np.flatnonzero(scratch), np.zeros(abi.N_COUNTERS, dtype=np.int64)
        described = assembly.layout, places, scratch[places]
        meanings = meanings_of_names(begin_row, (described, now.y, now, counters, conditions), {}, room)
        self.entries["begin_row"] = source_of_piece(begin_row), meanings


#: Functions that a start calls, by their names in models, and their types.
_NAMES = ("geometry", "measure", "move", "spread", "solve", "formulas", "project", "turns", "rhs")
_KINDS = (abi.MEASURE, abi.MEASURE, abi.MOVE, abi.MOVE, None, None, None, None, None)

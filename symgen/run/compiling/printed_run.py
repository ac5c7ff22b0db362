"""A run bound to one compiled model, for printers of other languages: its loop, events and modes."""

from __future__ import annotations

import functools
from collections import defaultdict
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from symgen.base.ir.numerics import WARN
from symgen.compile.native import language as lang
from symgen.compile.native.binding import Meaning
from symgen.compile.native.loops import read_loop
from symgen.compile.native.pieces import Piece
from symgen.compile.store.jit import RuntimeFunction
from symgen.describe.bounds.bounded_modes import MODE
from symgen.describe.parts.event_sections import STOP
from symgen.run.compiling.checked import checked_function
from symgen.run.compiling.foresight import Passages
from symgen.run.compiling.printed_meanings import meanings_of_names
from symgen.run.layout import abi
from symgen.run.layout import ensemble_abi as e
from symgen.run.layout.probe import rate_functions
from symgen.run.layout.records import RowChunk, Span
from symgen.run.layout.redundancy import room_of_choice
from symgen.run.loops.event_loop import notes_at
from symgen.run.loops.schemes import readable
from symgen.run.loops.seams import preparing_functions, seams_of_loop
from symgen.run.loops.search_records import COUNT
from symgen.run.loops.searching import deciding
from symgen.run.printed.exchanged_run import RESTS, Exchange, exchanged_run
from symgen.run.printed.foreseen_run import foreseen_run
from symgen.run.printed.kept_loops import KeptLoops, Traits, kept_loops
from symgen.run.printed.kept_reset import kept_reset
from symgen.run.printed.kept_run import KeptOutput, Visible
from symgen.run.rows.rows import balance_nothing, observe_nothing_of_coordinates
from symgen.run.single.events import event_state
from symgen.run.single.new_state import model_sizes, new_state, span_of
from symgen.run.single.turn_memory import effects_of_runs, modes_of_runs
from symgen.run.starts.assembler import layout_of_starts

if TYPE_CHECKING:
    from symgen.run.layout.compiled import CompiledModel
    from symgen.run.loops.integrator import Integrator
    from symgen.run.loops.run_spec import BoundedRows, RunSpec, Seam, Watched

#: Names of emitted functions of a run in the text, by the places where a run has them.
SWITCHING, ROWS, ACCELERATIONS, REACTIONS, CHANGED, PASSAGES = (
    "formulas_of_events",
    "formulas_of_rows",
    "formulas_of_accelerations",
    "formulas_of_reactions",
    "formulas_of_effects",
    "formulas_of_passages",
)
#: Room for notes of events in a step, beside twice those of all events.
_NOTES = 8
#: Name of the search for events inside a step, the same for all models.
FINDER = "find_events"
#: Arrays that never change: of records with these names, and fields of others, by the name of the record.
_TABLES = frozenset(("layout", "rows", "changes", "scheme"))
_CONSTANT = {
    "strikes": frozenset(("events", "losses")),
    "effects": frozenset(("resets", "stops")),
    "2": frozenset(("choosing", "breaks", "reverses", "jams", "leaves", "resets", "stops")),
    "visible": frozenset(("ends",)),
    "foresight": frozenset(("slots", "straight", "kinds", "first", "levels", "periods")),
    "seams": frozenset(("head", "changes", "places", "values")),
}
#: Arguments of a run, and arrays that callers pass beside them.
_ARGUMENTS = "seams", "model", "scheme", "span", "chunk", "state", "outputs", "visible", "exchange", "foresight"
_PASSED = frozenset(("y", "values"))
#: Beginnings of the names of arrays in the memory; the state, parameters and scratch of the model have their own.
_OWN = {"visible.y": "y", "visible.clock": "run_shown", "state.p": "p", "state.w": "w", "state.iw": "iw"}
_OWN |= {"exchange.times": "run_times"}


@functools.cache
def _plain_function(piece: Piece) -> Any:
    """Return a function in LLVM's language as one of the language of loops."""
    return RuntimeFunction(piece.plain, inlined=False)


@dataclass(frozen=True)
class PrintedRun:
    """A run for printers.

    Attributes
    ----------
    compiled : CompiledModel
        Model and method.
    integrator : Integrator
        The scheme.
    spec : RunSpec
        Steps and limits.
    watched : Watched or None
        Switching functions of events and modes.
    datum : sequence of float
        What coordinates are measured from.
    seams : tuple of Seam
        Times at which formulas jump or have kinks.
    passages : Passages, optional
        What a run finds these times with, where they depend on parameters or lie after its end.
    """

    compiled: CompiledModel
    integrator: Integrator
    spec: RunSpec
    watched: Watched | None
    datum: Sequence[float] = ()
    seams: tuple[Seam, ...] = ()
    passages: Passages | None = None

    @cached_property
    def functions(self) -> dict[str, lang.Function]:
        """Emitted functions that a run has besides a law and its model, by their names in the text."""
        functions = {name: checked_function(f, abi.OBSERVE) for name, f in self._sides.items() if f is not None}
        if self.watched is not None:
            functions[FINDER] = checked_function(self._decide, abi.DECIDE)
        law = self.compiled.law_module
        if hasattr(law, "rates"):
            functions["rates"] = checked_function(law.rates, abi.RHS)
        return functions

    @property
    def _sides(self) -> dict[str, Any]:
        """Emitted functions of events and rows, None where there are none, by their names in the text."""
        watched, rows = self.watched, self._rows
        effects = None if watched is None else watched.effects
        return {
            SWITCHING: None if watched is None else watched.function,
            ROWS: None if rows is None else rows.state.function,
            ACCELERATIONS: None if rows is None else rows.accelerations.function,
            REACTIONS: None if rows is None or rows.reactions is None else rows.reactions.function,
            CHANGED: None if effects is None else effects.formulas,
            PASSAGES: None if self.passages is None else self.passages.lines.function,
        }

    def emitted_functions(self, named: Mapping[str, lang.Function]) -> dict[int, lang.Function]:
        """Return emitted functions by their identity; `named` has all that the text has, by name."""
        law, model = self.compiled.law_module, self.compiled.model
        places = {
            **dict.fromkeys(("prepareModel", "prepare_model"), model.prepare),  # C uses the latter name
            **dict.fromkeys(("prepareLaw", "prepare_law"), law.prepare),
            **{"rhs": law.rhs, "accept": law.accept, "confirm": getattr(law, "confirm", None)},
            **{"geometry": model.geometry, "bodies": getattr(model, "bodies", None)},
            **{"rates": getattr(law, "rates", None), FINDER: self._decide},
            **self._sides,
        }
        return {id(f): named[name] for name, f in places.items() if f is not None and name in named}

    def entries(self, named: Mapping[str, lang.Function]) -> dict[str, tuple[lang.Function, dict[str, Meaning]]]:
        """Return ``start_run()`` and ``advance_run(through, h, until)`` with the meanings of their parameters.

        Parameters
        ----------
        named : mapping of str to Function
            Emitted functions by their names in the text, those of `functions` among them.
        """
        emitted, (model, scheme, span, chunk, state, outputs, visible, _) = (
            self.emitted_functions(named),
            self._arguments,
        )
        start, advance, _ = self._loops
        limits = np.array([self.spec.max_violation, self.spec.velocity_limit, self.spec.max_energy_error, WARN])
        functions = {
            "start_run": (start, (model, limits, chunk, state, visible)),
            "advance_run": (advance, (None, model, scheme, span, chunk, state, outputs, visible)),
        }
        return self._functions_with_meanings(functions, emitted)

    def exchange_entries(
        self, named: Mapping[str, lang.Function]
    ) -> dict[str, tuple[lang.Function, dict[str, Meaning]]]:
        """Return ``indicate_run(t, y, values)``, ``exchange_run(doing, t)``; see `symgen.run.printed.exchanged_run`."""
        emitted, (model, _, span, chunk, state, _, visible, exchange) = self.emitted_functions(named), self._arguments
        indicate, serve = exchanged_run(*self._recipe)
        y, values = visible.y.copy(), np.zeros(int(state.hunt[COUNT]))
        span = span._replace(step=self.spec.step, until=np.inf)
        functions = {
            "indicate_run": (indicate, (None, y, model, state, values)),
            "exchange_run": (serve, (None, None, model, span, chunk, state, visible, exchange)),
        }
        return self._functions_with_meanings(functions, emitted)

    def reset_entries(self, named: Mapping[str, lang.Function]) -> dict[str, tuple[lang.Function, dict[str, Meaning]]]:
        """Return ``reset_run(event, t, y)``; see `symgen.run.printed.kept_reset`."""
        model, _, _, _, state, _, visible, _ = self._arguments
        functions = {"reset_run": (kept_reset(*self._recipe), (None, None, visible.y.copy(), model, state))}
        return self._functions_with_meanings(functions, self.emitted_functions(named))

    def foresight_entries(
        self, named: Mapping[str, lang.Function]
    ) -> dict[str, tuple[lang.Function, dict[str, Meaning]]]:
        """Return ``foresee_run(is_start, t)``; see `symgen.run.printed.foreseen_run`."""
        state, function = self._arguments[4], foreseen_run(self.watched is not None)
        functions = {"foresee_run": (function, (None, None, self._foresight, self._seams, state))}
        return self._functions_with_meanings(functions, self.emitted_functions(named))

    def _functions_with_meanings(
        self, functions: Mapping[str, tuple[Any, tuple[Any, ...]]], emitted: dict[int, lang.Function]
    ) -> dict[str, tuple[lang.Function, dict[str, Meaning]]]:
        """Return functions by name with the meanings of their parameters, for the arguments beside them."""
        entries = dict[str, tuple[lang.Function, dict[str, Meaning]]]()
        steps = self._loops.steps
        if steps is not None:
            emitted = emitted | {id(steps): read_loop(steps, steps.signature.arguments, _plain_function, apart=True)}
        for name, (function, arguments) in functions.items():
            source = read_loop(function, function.signature.arguments, _plain_function, apart=True)
            entries[name] = source, meanings_of_names(function, arguments, emitted, self._name_of_array)
        return entries

    @cached_property
    def memory(self) -> dict[str, NDArray[Any]]:
        """The arrays of the memory as they are before a run, by name."""
        return {name: array for name, array in self._named.values() if name}

    # -- arguments

    @property
    def _recipe(self) -> tuple[Any, Traits]:
        watched = self.watched
        changes, turning = (False, ()) if watched is None else (watched.effects is not None, watched.turning)
        traits = Traits(watched is not None, changes, self._rows is not None, self._has_seams, turning)
        return readable.adaptive if self.spec.adaptive else self.integrator.loop(False), traits

    @property
    def _loops(self) -> KeptLoops:
        return kept_loops(*self._recipe)

    @cached_property
    def _decide(self) -> Any:
        return deciding(_NOTES, self._rows is not None, self.watched is not None and bool(self.watched.corners))

    def _search_record(self, watched: Watched, hunt: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return the data of events with room for few notes, as all are taken before the next step."""
        width = self.compiled.info.ny
        if watched.switches or watched.corners:  # whose points follow the notes
            return hunt
        first = notes_at(len(watched.names), width, len(self.compiled.scratch()))
        return hunt[: first + (_NOTES + 2 * len(watched.names)) * (2 + width)].copy()

    @property
    def _rows(self) -> BoundedRows | None:
        return None if self.watched is None else self.watched.bounded

    @property
    def _has_seams(self) -> bool:
        return bool(self.seams) or self.passages is not None

    @cached_property
    def _seams(self) -> Any:
        if self.passages is not None:
            return self.passages.seams(self.compiled, self.spec.adaptive)
        return seams_of_loop(self.compiled, self.spec.adaptive, (self.seams,)) if self.seams else ()

    @cached_property
    def _foresight(self) -> Any:
        return () if self.passages is None else self.passages.foresight(self.spec, self._arguments[6].clock)

    @cached_property
    def _arguments(self) -> tuple[Any, ...]:
        """Arguments of `advance_run` after its first one, then `Exchange`; a step and its end are None: passed."""
        compiled, info, watched = self.compiled, self.compiled.info, self.watched
        setup, sizes = self.integrator.setup(compiled, self.spec, compiled.scratch()), model_sizes(compiled)
        sizes, span, memory = sizes._replace(width=info.ny), span_of(self.spec, setup), setup.memory
        if self.spec.adaptive:
            lengths = len(compiled.parameter_array(defaultdict(float), {})), len(compiled.scratch())
            memory = readable.memory_of(info.ny, setup.scheme, *lengths)
        state: Any = new_state(compiled, sizes, memory, setup.room, self.datum)
        state = state._replace(passages=np.zeros(abi.N_PASSAGE))
        rates = rate_functions(compiled.law_module)
        model: tuple[Any, ...] = (sizes, *setup.functions)
        if watched is not None:
            # corrections of stops with smooth gaps are examined in runs by themselves
            examined = watched if watched.corners else replace(watched, turns=())
            state = event_state(examined, sizes, state)
            state = state._replace(hunt=self._search_record(watched, state.hunt))
            model = *model, watched.function, self._decide, rates[0]
        if self._has_seams:
            model = model, self._seams, self._loops.steps, *preparing_functions(compiled)
        observers = sizes, *rates, compiled.law_module.accept, observe_nothing_of_coordinates, balance_nothing
        integers, nothing = np.zeros(0, dtype=np.int64), np.zeros(0)
        actions = () if watched is None else watched.actions
        own = sum(action != MODE for action in actions)  # a row keeps no events of modes, which end no run
        events = np.zeros(e.HEAD_OF_EVENTS + e.OF_EVENT * own)
        arrays = integers, nothing, np.zeros(len(state.p)), nothing, nothing, integers, nothing, nothing, events
        room = np.zeros(room_of_choice(info.m, info.nv))
        chunk = RowChunk(*arrays, 0, 0, 0, 0, layout_of_starts(compiled), room)
        outputs = KeptOutput(np.zeros(1), np.zeros(info.ny), np.zeros(abi.N_STATUS + info.kept))
        ends = np.array([action == STOP for action in actions[:own]], dtype=np.int64)
        clock = np.array([0.0, self.spec.until][: 1 + self.spec.adaptive])
        visible = Visible(np.zeros(info.ny), clock, np.zeros(4, dtype=np.int64), ends)
        numbers = Span(**{**span._asdict(), "until": None, "step": None, "end": np.inf})
        of_model = model, observers, *self._further_arguments(span, len(state.w))
        return (
            of_model,
            setup.scheme,
            numbers,
            chunk,
            state,
            outputs,
            visible,
            Exchange(np.zeros(RESTS + (0 if self._rows is None else len(self._rows.names)))),
        )

    def _further_arguments(self, span: Span, nw: int) -> tuple[Any, ...]:
        """Return what follows the functions of a model: rows with bounds, or effects of events."""
        compiled, watched, rows, width = self.compiled, self.watched, self._rows, self.compiled.info.ny
        if watched is not None and rows is not None:
            return (modes_of_runs(compiled, watched, rows, span, width, nw),)
        if watched is not None and watched.effects is not None:
            return (effects_of_runs(compiled, watched, span.end, width, nw),)
        return ()

    # -- names

    @cached_property
    def _named(self) -> dict[int, tuple[str, NDArray[Any]]]:
        """Name and array by its identity; constant ones have no name."""
        named = dict[int, tuple[str, NDArray[Any]]]()
        for name, argument in self._all_arguments:
            for path, array in _arrays_of_record(name, argument):
                named.setdefault(id(array), ("" if self._is_constant(path) else _name_of(path), array))
        return named

    @property
    def _all_arguments(self) -> list[tuple[str, Any]]:
        return list(zip(_ARGUMENTS, (self._seams, *self._arguments, self._foresight), strict=True))

    def _is_constant(self, path: str) -> bool:
        """Whether an array never changes."""
        *owners, field = path.split(".")
        if owners == ["seams"] and self.passages is None:
            return True
        return not _TABLES.isdisjoint(owners) or field in _CONSTANT.get(owners[-1], ())

    @cached_property
    def _by_path(self) -> dict[str, str]:
        pairs = [pair for name, value in self._all_arguments for pair in _arrays_of_record(name, value)]
        return {path: self._named[id(array)][0] for path, array in pairs}

    def _name_of_array(self, name: str) -> str | None:
        """Return the name of an array in the memory; see `symgen.run.compiling.printed_meanings.Naming`."""
        return "" if name in _PASSED else self._by_path.get(name) or None


def _arrays_of_record(name: str, value: object) -> Iterator[tuple[str, NDArray[Any]]]:
    """Yield the paths and arrays of records."""
    if isinstance(value, np.ndarray):
        yield name, value
    elif isinstance(value, tuple):
        fields = getattr(value, "_fields", range(len(value)))
        for field, item in zip(fields, value, strict=True):
            yield from _arrays_of_record(f"{name}.{field}", item)


def _name_of(path: str) -> str:
    """Return the name of an array in the memory."""
    owner, _, rest = path.partition(".")
    if path in _OWN:
        return _OWN[path]
    if owner in ("seams", "foresight"):
        return f"seam_{rest}"
    if owner != "model":
        return f"run_{rest.replace('.', '_')}"
    head, *fields = rest.removeprefix("2.").split(".")
    return "_".join(fields if head == "choice" and len(fields) > 1 else (head, *fields))  # its records have own names

"""The functions around the loop of a scheme that keep a run between calls, by what the run has.

What they do is written in `symgen.run.printed.kept_run`; here, names of those functions get their meanings.
"""

from __future__ import annotations

from typing import Any, NamedTuple

from symgen.compile.loopcode.loop_instances import Meanings, compiled_loop
from symgen.compile.native import types
from symgen.compile.store.jit import RuntimeFunction
from symgen.run.layout import abi
from symgen.run.layout import ensemble_abi as e
from symgen.run.layout.records import CHUNK, SPAN, STATE
from symgen.run.loops import frame
from symgen.run.loops.event_loop import EVENT_STATE, MEANINGS
from symgen.run.loops.seams import SEAMS, between_seams
from symgen.run.modes import turn
from symgen.run.modes.turn_meanings import meanings_of_turn
from symgen.run.printed import kept_run
from symgen.run.rows import row_events, rows
from symgen.run.rows.rows import OBSERVERS

_loops: dict[Any, KeptLoops] = {}
_KEPT = Meanings("printed runs", store_output=kept_run.show_state, _MAX_PASSAGES=1, integrate=frame.integrate)
_OF_ROWS = Meanings(
    "printed runs with bounded rows", assume_step=kept_run.assume_first_step, let_go=kept_run.let_rows_go
)
_OF_ROWS_BETWEEN_SEAMS = Meanings(
    "printed runs with bounded rows and seams",
    begin_at_seams=row_events.begin_row_between_seams,
    take_change=row_events.choose_after_change,
)
_UNBOUNDED = Meanings("printed runs with events and without bounded rows", MARGINS=False)
_SEAMED = Meanings(
    "printed runs with seams",
    return_before_seams=kept_run.forget_later_seams,
    system_of_steps=kept_run.system_between_seams,
    integrate=between_seams,
)


class Traits(NamedTuple):
    """What the runs of a model have.

    Attributes
    ----------
    events, effects, modes, seams : bool
        Switching functions; events that change a run, or gaps that strike; rows with bounds; formulas that jump or have
        kinks over time.
    turning : tuple of str
        What of rows with bounds has its own meanings, see `symgen.run.loops.run_spec.Watched`.
    """

    events: bool
    effects: bool
    modes: bool
    seams: bool
    turning: tuple[str, ...] = ()

    @property
    def words(self) -> tuple[str, ...]:
        """The names of what they have."""
        has = [name for name, own in self._asdict().items() if own is True]
        return (*has, *self.turning)

    @property
    def meanings(self) -> dict[str, Any]:
        """Meanings of names in `symgen.run.printed.kept_run` and in the frame."""
        meanings: dict[str, Any] = dict(_KEPT)
        if self.events:
            meanings |= MEANINGS | rows.EVENTS | ({} if self.modes else _UNBOUNDED)
        if self.modes:
            meanings |= rows.MODES | _OF_ROWS | meanings_of_turn(self.effects, self.turning)
            meanings |= _OF_ROWS_BETWEEN_SEAMS if self.seams else {}
        elif self.effects:
            meanings |= rows.EFFECTS | meanings_of_turn(False, self.turning)
        return meanings | (_SEAMED if self.seams else {})

    @property
    def state(self) -> types.RecordType:
        """Type of the state of a run."""
        return EVENT_STATE if self.events else STATE

    @property
    def further(self) -> tuple[types.RecordType, ...]:
        """Types of what follows the functions of a model."""
        return (turn.FURTHER["modes" if self.modes else "effects"],) if self.modes or self.effects else ()


class KeptLoops(NamedTuple):
    """Compiled functions of runs that are kept between calls.

    Attributes
    ----------
    start, advance : compiled functions
        `start_run` and `advance_run`.
    steps : compiled loop or None
        The loop between two seams, where a run has any: `advance` calls it by its address.
    """

    start: Any
    advance: Any
    steps: Any


def kept_loops(loop: RuntimeFunction, traits: Traits) -> KeptLoops:
    """Return the functions around the loop of a scheme, made at the first use.

    Parameters
    ----------
    loop : compiled loop
        From `symgen.run.loops.frame.loop`; one with adaptive steps is from `symgen.run.loops.schemes.readable`.
    traits : Traits
        What the run has.
    """
    key = loop, traits
    if key not in _loops:
        name, meanings, steps, model = recipe_of(loop, traits)
        scheme, state = frame.RECIPES[loop][0][2], traits.state
        kinds = CHUNK, state, kept_run.KEPT_OUTPUT, kept_run.VISIBLE
        start = types.int64(model, types.float64[::1], CHUNK, state, kept_run.VISIBLE)
        advance = types.int64(types.int64, model, scheme, SPAN, *kinds)
        _loops[key] = KeptLoops(
            compiled_loop(kept_run.__name__, f"{name}_start", kept_run.start_run, start, **meanings),
            compiled_loop(kept_run.__name__, f"{name}_advance", kept_run.advance_run, advance, **meanings),
            steps,
        )
    return _loops[key]


def recipe_of(loop: RuntimeFunction, traits: Traits) -> tuple[str, dict[str, Any], Any, types.Kind]:
    """Return a name of functions around the loop of a scheme, meanings of names, the loop between seams and the model.

    Parameters as for `kept_loops`.
    """
    (module, own, scheme, *functions), parts = frame.RECIPES[loop]
    meanings = {**parts, **traits.meanings}
    system = types.RecordType((*frame.kinds_of(functions), *((abi.OBSERVE, abi.DECIDE, abi.RHS) * traits.events)))
    steps, name = None, f"{module.rpartition('.')[2]}_{own}"
    if traits.seams:
        signature = types.int64(system, scheme, SPAN, traits.state, kept_run.KEPT_OUTPUT)
        steps = compiled_loop(kept_run.__name__, f"{name}_steps", frame.integrate, signature, **meanings)
        system = types.RecordType((system, SEAMS, types.FunctionType(signature), e.PREPARE, e.PREPARE))
    name += "".join(f"_{trait}" for trait in traits.words)
    return name, meanings, steps, types.RecordType((system, OBSERVERS, *traits.further))

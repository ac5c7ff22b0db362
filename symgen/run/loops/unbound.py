"""Functions that are bound late: what names of loops and of turns mean where nothing else is bound to them.

Each does nothing, or returns a value that means nothing. Schemes, the search for events, modes and targets bind other
functions to these names, see `symgen.compile.loopcode.loop_instances`; ``docs/development/late-names.md`` says who
means each when. Of the parts of a scheme,

| name | takes | does |
| --- | --- | --- |
| `prepare` | system, scheme, span, run | initial data of the scheme |
| `attempt` | system, scheme, span, run, t, following, h, between | sets ``run.trial``, at `following`, from ``run.y`` |
| `renew` | system, scheme, span, run, t, changed | updates the scheme's memory after the state at `t` was accepted |
| `shrunk_step`, `grown_step` | span, run, [h,] error | ratio of the next step to a refused or accepted one |
| `interpolate` | system, scheme, span, run, outputs, t, following, h | outputs inside a step, from its ends |
| `inside` | system, scheme, run, t, following, h, i, y | a state inside a good attempt |
| `locate_event` | system, scheme, run, following, h, search | tests whether an event lies inside an acceptable step |
| `prepare_search` | system, run, doing | other work of `symgen.run.loops.event_loop`: `LOOK`, `REMEMBER`, `RECALL` |
| `step_to_point` | system, run, h | the step to try: `h`, or one that ends where a point of a table is passed |
| `is_astray` | span, run, adaptive | whether an accepted state was corrected by more than its error explains |

`attempt` returns its error estimate over the tolerance, 0 without an estimate, and changes no data of the run: it may
be repeated with a shorter step. All data for the next step are in the arrays of `symgen.run.layout.records.State`, so a
loop can be left and entered again, in another process too.
"""

from __future__ import annotations

import math
from typing import TypeVar

from symgen.compile.loopcode.loop_instances import viewing
from symgen.compile.native.annotations import Array, Record
from symgen.run.layout import abi
from symgen.run.layout.records import ModelSystem, Outputs, RowChunk, Run, Span, State, System
from symgen.run.loops.frame_parts import DIVERGED, NOTHING

Effects = TypeVar("Effects", bound=Record)
#: `SAME` of turns and `QUIET` of exchanged runs, which later rooms name.
UNCHANGED = 0


# -- parts of the frame, which schemes and the search for events replace -----------------------------------------------


def prepare(system: ModelSystem, scheme: Record, span: Span, run: Run) -> None:
    """Do nothing: a scheme without memory needs nothing at the start.

    ``docs/development/late-names.md`` says who means it when.
    """


def attempt(
    system: ModelSystem, scheme: Record, span: Span, run: Run, t: float, following: float, h: float, between: bool
) -> float:
    """Return `DIVERGED`: each scheme has its own step.

    ``docs/development/late-names.md`` says who means it when.
    """
    return DIVERGED


def renew(system: ModelSystem, scheme: Record, span: Span, run: Run, t: float, changed: bool) -> None:
    """Do nothing: a scheme without memory keeps nothing of a step.

    ``docs/development/late-names.md`` says who means it when.
    """


def refuse(run: Run) -> None:
    """Do nothing: the memory of a scheme is valid for another attempt as well.

    ``docs/development/late-names.md`` says who means it when.
    """


def interpolate(
    system: ModelSystem, scheme: Record, span: Span, run: Run, outputs: Outputs, t: float, following: float, h: float
) -> None:
    """Do nothing: a scheme without dense output ends a step at each output.

    ``docs/development/late-names.md`` says who means it when.
    """


def inside(
    system: ModelSystem, scheme: Record, run: Run, t: float, following: float, h: float, i: int, y: Array
) -> float:
    """Set `y` to the state at inner point i of a good attempt, before its correction; return its part of the step.

    0 where the scheme has none: then states are those of a cubic through both ends and their rates.

    ``docs/development/late-names.md`` says who means it when.
    """
    return 0.0


def locate_event(system: ModelSystem, scheme: Record, run: Run, following: float, h: float, search: int) -> int:
    """Return `NOTHING`: a run without events finds none between a good attempt and its acceptance.

    ``docs/development/late-names.md`` says who means it when.
    """
    return NOTHING


def prepare_search(system: ModelSystem, run: Run, doing: int) -> int:
    """Return `NOTHING`: a run without events has no sides to find (`LOOK`), and nothing to `REMEMBER` and `RECALL`.

    ``docs/development/late-names.md`` says who means it when.
    """
    return NOTHING


def step_to_point(system: ModelSystem, run: Run, h: float) -> float:
    """Return the step to try in place of one of `h` seconds, proposed by the error estimate.

    ``docs/development/late-names.md`` says who means it when.
    """
    return h


def is_astray(span: Span, run: Run, adaptive: bool) -> bool:
    """Return False: only runs with events are examined.

    ``docs/development/late-names.md`` says who means it when.
    """
    return False


# -- effects of events, which single runs read -------------------------------------------------------------------------


def keep_before(kept: Record, y: Array) -> None:
    """Do nothing: nobody reads the effects of this run.

    ``docs/development/late-names.md`` says who means it when.
    """


def keep_after(kept: Record, now: Record, first: int, work: Record) -> None:
    """Do nothing: nobody reads the effects of this run.

    ``docs/development/late-names.md`` says who means it when.
    """


# -- the turn of events ------------------------------------------------------------------------------------------------


def lay_gaps(t: float, modes: Record, state: State) -> int:
    """Return 0: a run without gaps has none that is closed at a start.

    ``docs/development/late-names.md`` says who means it when.
    """
    return 0


def meet_impacts(t: float, modes: Record, state: State) -> int:
    """Return `SAME`: a run without gaps has no impacts.

    ``docs/development/late-names.md`` says who means it when.
    """
    return UNCHANGED


def gather_impacts(t: float, modes: Record, state: State) -> int:
    """Return `SAME`: a run without gaps has no impacts that accumulate.

    ``docs/development/late-names.md`` says who means it when.
    """
    return UNCHANGED


# -- rows of sweeps ----------------------------------------------------------------------------------------------------


def forget_run(model: System, state: State) -> None:
    """Do nothing: a run without switching functions has no data of them.

    ``docs/development/late-names.md`` says who means it when.
    """


def begin_choice(model: System, span: Span, state: State) -> int:
    """Return `DONE`: a run without bounded rows has no modes to choose.

    ``docs/development/late-names.md`` says who means it when.
    """
    return int(abi.DONE)


def take_change(model: System, span: Span, state: State) -> int:
    """Return the end code of a run whose parameters its loop cannot prepare.

    ``docs/development/late-names.md`` says who means it when.
    """
    return int(abi.UNPREPARED)


def take_notes(code: int, r: int, model: System, chunk: RowChunk, state: State) -> int:
    """Return the end code of a run without events.

    ``docs/development/late-names.md`` says who means it when.
    """
    return code


def resume_code(state: State) -> int:
    """Return the end code with which a run that was left for an examination goes on, `DONE` for a new run.

    ``docs/development/late-names.md`` says who means it when.
    """
    return int(abi.DONE)


def waits_for_caller(code: int, model: System, chunk: RowChunk, state: State) -> bool:
    """Return whether a run has to be left for an examination: none without rows that may jump.

    ``docs/development/late-names.md`` says who means it when.
    """
    return False


def store_after(code: int, span: Span, state: State, outputs: Outputs) -> None:
    """Do nothing: outputs of a run without events hold its state.

    ``docs/development/late-names.md`` says who means it when.
    """


def take_row(system: System, r: int) -> None:
    """Do nothing: no row has seams.

    ``docs/development/late-names.md`` says who means it when.
    """


def integrate(*arguments: object) -> int:
    """Mark the place of the loop over one run: it is never called.

    ``docs/development/late-names.md`` says who means it when.
    """
    raise NotImplementedError


def hold(system: System | int, span: Span, chunk: RowChunk, r: int, state: State, times: Array, k: int) -> None:
    """Do nothing: the same parameters hold at all outputs of a run without seams.

    ``docs/development/late-names.md`` says who means it when.
    """


def keep_ends(model: System, count: int, row: Array) -> None:
    """Do nothing: events end no run but by their time.

    ``docs/development/late-names.md`` says who means it when.
    """


# -- printed runs ------------------------------------------------------------------------------------------------------


def assume_step(model: System, span: Span) -> None:
    """Do nothing: no modes depend on the step that is assumed before the first one.

    ``docs/development/late-names.md`` says who means it when.
    """


def let_go(model: System, state: State) -> None:
    """Do nothing: a run without rows with bounds has none in force.

    ``docs/development/late-names.md`` says who means it when.
    """


def return_before_seams(system: System, state: State) -> None:
    """Do nothing: a run without seams has passed none.

    ``docs/development/late-names.md`` says who means it when.
    """


@viewing
def system_of_steps(system: System) -> System:
    """Return the first argument of the loop over steps.

    ``docs/development/late-names.md`` says who means it when.
    """
    return system


def read_step(system: System, scheme: Record, state: State, outputs: Record) -> int:
    """Return 0: nothing can be read of a constant step.

    ``docs/development/late-names.md`` says who means it when.
    """
    return 0


@viewing
def effects_alone(further: Effects) -> Effects:
    """Return the effects of events in a run without rows with bounds.

    ``docs/development/late-names.md`` says who means it when.
    """
    return further


def leave_alone(further: Record, w: Array) -> None:
    """Do nothing: a run without rows with bounds has no modes.

    ``docs/development/late-names.md`` says who means it when.
    """


def forget_rests(modes: Record, times: Array, is_begun: bool) -> None:
    """Do nothing: no gap of a run without gaps comes to rest.

    ``docs/development/late-names.md`` says who means it when.
    """


def rest_lost_gaps(t: float, modes: Record, state: State) -> int:
    """Return `SAME`: a run without gaps has no flights.

    ``docs/development/late-names.md`` says who means it when.
    """
    return UNCHANGED


def note_rests(t: float, modes: Record, times: Array) -> None:
    """Do nothing: no gap of a run without gaps comes to rest.

    ``docs/development/late-names.md`` says who means it when.
    """


def next_rest(t: float, modes: Record, times: Array) -> float:
    """Return infinity: no gap of a run without gaps comes to rest.

    ``docs/development/late-names.md`` says who means it when.
    """
    return math.inf


def next_time(model: System, state: State) -> float:
    """Return infinity: formulas of a run without seams neither jump nor have kinks over time.

    ``docs/development/late-names.md`` says who means it when.
    """
    return math.inf


def pass_seams(model: System, span: Span, state: State) -> int:
    """Return `QUIET`: a run without seams passes none.

    ``docs/development/late-names.md`` says who means it when.
    """
    return UNCHANGED


def formula_at(f: Record, state: Record, j: int, t: float) -> float:
    """Return nan: each search for times of jumps has formulas of its own.

    ``docs/development/late-names.md`` says who means it when.
    """
    return math.nan

"""Explicit Runge-Kutta runs with adaptive steps whose last step can be read when it is over.

Programs that ask for one output after the other have several in one step. The scheme's own memory is
followed by what reading needs: the state before the step, its stages, its end, parameters and the scratch of emitted
functions. These are copies: the run may have changed its modes or inputs since, and reading must not change the run.
"""

from __future__ import annotations

from symgen.compile.loopcode.bare import part
from symgen.compile.loopcode.loop_instances import called
from symgen.compile.loopcode.vectors import copied
from symgen.compile.native.annotations import Array
from symgen.run.layout import abi
from symgen.run.layout.records import ModelSystem, Outputs, Run, Span, State, System
from symgen.run.layout.scheme_records import TABLEAU, TableauRecord
from symgen.run.loops.frame import loop
from symgen.run.loops.frame_parts import correct as correct_plainly
from symgen.run.loops.frame_parts import store_output
from symgen.run.loops.schemes.explicit import ADAPTIVE_PARTS, complete_stages, read_stages
from symgen.run.loops.schemes.explicit import attempt as try_step
from symgen.run.loops.schemes.explicit import prepare as begin_scheme
from symgen.run.loops.schemes.explicit import renew as set_first_stage
from symgen.run.loops.unbound import interpolate as write_nothing

#: Head of the last step: its beginning and end, equal where there is none to read, its length [s], and 1 once all its
#: stages are known. The state before it, its end before a correction, stages, parameters and scratch follow.
BEGIN, END, LENGTH, COMPLETE, HEAD = range(5)


def memory_of(width: int, scheme: TableauRecord, parameters: int, scratch: int) -> int:
    """Return the count of numbers that a run keeps: the memory of the scheme, and its last step."""
    return int(HEAD + 2 * (1 + len(scheme.nodes)) * width + parameters + scratch)


def forget_step(width: int, scheme: TableauRecord, memory: Array) -> None:
    """Forget the last step: the run goes on from another state."""
    head = scheme.nodes.shape[0] * width
    memory[head + END] = memory[head + BEGIN]


def keep_step(width: int, scheme: TableauRecord, run: Run, t: float) -> None:
    """Keep an accepted step that ends at a time [s]."""
    memory, stages = run.memory, scheme.nodes.shape[0] * width
    n_p, nw, at = run.p.shape[0], run.w.shape[0], stages + HEAD + width
    memory[stages + END], memory[stages + COMPLETE] = t, 0.0
    copied(width, run.room, part(memory, at, width))
    copied(stages, memory, part(memory, at + width, stages))
    copied(n_p, run.p, part(memory, at + width + stages, n_p))
    copied(nw, run.w, part(memory, at + width + stages + n_p, nw))


def attempt(
    system: ModelSystem,
    scheme: TableauRecord,
    span: Span,
    run: Run,
    t: float,
    following: float,
    h: float,
    between: bool,
) -> float:
    """Try a step, and keep where it begins: nothing of the step before is read any more."""
    width, memory = system.sizes.width, run.memory
    head = scheme.nodes.shape[0] * width
    memory[head + BEGIN] = memory[head + END] = t
    memory[head + LENGTH] = h
    copied(width, run.y, part(memory, head + HEAD, width))
    return float(try_step(system, scheme, span, run, t, following, h, between))


def renew(system: ModelSystem, scheme: TableauRecord, span: Span, run: Run, t: float, changed: bool) -> None:
    """Keep an accepted step, and set the first stage of the next one."""
    keep_step(system.sizes.width, scheme, run, t)
    set_first_stage(system, scheme, span, run, t, changed)


def prepare(system: ModelSystem, scheme: TableauRecord, span: Span, run: Run) -> None:
    """Set the first stage, and keep the step before it where it has ended at a kink of rates."""
    if run.control[abi.BEGUN] == 1:
        keep_step(system.sizes.width, scheme, run, run.clock[abi.TIME])
    begin_scheme(system, scheme, span, run)


@called
def read_within_step(model: System, scheme: TableauRecord, state: State, outputs: Outputs) -> int:
    """Write the first output where it lies inside the last step; return 1, or 0 where it does not."""
    system = ModelSystem(*model)
    sizes, memory, n = system.sizes, state.memory, scheme.nodes.shape[0]
    width, t = sizes.width, outputs.times[0]
    stages, lanes = n * width, scheme.dense.shape[0] // scheme.degree
    at, n_p, nw = stages + HEAD + width, state.p.shape[0], state.w.shape[0]
    begin, end, h = memory[stages + BEGIN], memory[stages + END], memory[stages + LENGTH]
    if not (begin < t and t < end):
        return 0
    trial, new = part(state.room, 0, width), part(state.room, width, width)
    tables, of_step = part(state.room, 4 * width, 2 * lanes), part(memory, at + width, stages)
    p, w = part(memory, at + width + stages, n_p), part(memory, at + width + stages + n_p, nw)
    before, known = part(memory, stages + HEAD, width), state.control[abi.KNOWN]
    shared = state.iw, state.clock, state.gauges, state.control, state.passages
    run = Run(before, trial, p, w, *shared, of_step, state.share, state.metric, state.scales, state.room)
    if memory[stages + COMPLETE] == 0.0:
        state.control[abi.KNOWN] = scheme.ends
        copied(width, part(memory, at, width), new)
        complete_stages(system, scheme, run, of_step, new, begin, end, h)
        state.control[abi.KNOWN], memory[stages + COMPLETE] = known, 1.0
    read_stages(width, scheme, (t - begin) / h, h, before, of_step, tables, new)
    correct_plainly(system, run, t, new, True)
    store_output(sizes, w, outputs, 0, new)
    return 1


adaptive = loop(
    __name__,
    "adaptive",
    TABLEAU,
    **ADAPTIVE_PARTS
    | {
        "prepare": prepare,
        "attempt": attempt,
        "renew": renew,
        "interpolate": write_nothing,
        "read_step": read_within_step,
    },
)

"""Records of rows with bounds for compiled functions: what is constant in a run, read and probed."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from symgen.base.ir.program import MODE_NUMBERS
from symgen.compile.loopcode.exact import compiled_form
from symgen.compile.native.annotations import Array, Integers, Record
from symgen.run.laws.problem import Laws, new_laws
from symgen.run.layout import abi
from symgen.run.layout.records import Span
from symgen.run.layout.redundancy import LARGEST, room_of_choice
from symgen.run.layout.start_records import Layout
from symgen.run.modes.box import Box, new_box
from symgen.run.starts.assembler import layout_of_starts
from symgen.run.starts.starting import observe_nothing

if TYPE_CHECKING:
    from symgen.run.layout.compiled import CompiledModel
    from symgen.run.loops.run_spec import BoundedRows

#: Gaps below this part of the mechanism's length are closed.
TOUCHING = 1e-9
#: What `Rows.pushes` has of rows that are further pieces of the gap of the row before them.
FURTHER_PIECE = 2
#: Assumed step until an adaptive run has chosen one, as a part of the run.
FIRST = 1e-3


class Rows(Record):
    """The k rows with bounds of a run, two-sided ones first: what is constant. No function writes it.

    Attributes
    ----------
    layout : Layout
        Layout of the model.
    rates, confirm, geometry, states, accelerations : function
        Emitted functions: rates of v with multipliers, and their confirmation; ``geometry``; values, rates and bounds
        of the rows; their accelerations.
    reactions : function
        Components of the reactions that bounds depend on, two each.
    first, count, dry : int
        Place in w of the first number of the rows, the number of rows, and the number of rows with two bounds.
    changes : int
        1 where anything but the motion and inputs changes over time.
    angular : Array of int64, shape (k,)
        1 where the measure of a row is an angle.
    place_of : Array of int64, shape (m,)
        For each constraint row its number among the rows with bounds, -1 for others.
    pushes : Array of int64, shape (k,)
        1 for one-sided rows, which come last, or `FURTHER_PIECE`, else 0.
    pressed, varying : Array of int64, shapes (k,)
        1 for coordinates whose bounds depend on reactions; 1 for coordinates whose bounds are formulas of more than
        parameters.
    shifted : int
        1 where coordinates have bounds at rest with another middle than those in motion.
    partner, gaps : Array of int64, shapes (k,)
        Of each row the other one of its contact, -1 for others; 1 for gaps of contacts.
    second, turning : Array of int64, shapes (k,)
        1 for the second one of two rows along a contact; 1 for rows against turning, of which impacts have no impulse.
    """

    layout: Layout
    rates: abi.Rhs
    confirm: abi.Rhs
    geometry: abi.Measure
    states: abi.Observe
    accelerations: abi.Observe
    reactions: abi.Observe
    first: int
    count: int
    dry: int
    changes: int
    angular: Integers
    place_of: Integers
    pushes: Integers
    pressed: Integers
    varying: Integers
    shifted: int
    partner: Integers
    gaps: Integers
    second: Integers
    turning: Integers


class Reading(Record):
    """What is read of the rows at a state; `symgen.run.modes.reading` writes it.

    Attributes
    ----------
    value, speed, static, sliding, restitution, middle : Array, shapes (k,)
        Coordinates and gaps, their rates, bounds at rest and in motion, restitutions, and the middles of bounds at
        rest less those of bounds in motion. Bounds by reactions are over these.
    starting : Array of int64, shape (k,)
        1 for coordinates at rest with a sign that have just broken loose; others with a sign come to rest.
    """

    value: Array
    speed: Array
    static: Array
    sliding: Array
    restitution: Array
    middle: Array
    starting: Integers


class Problem(Record):
    """The problem of the rows at a state, or at an impact; `symgen.run.modes.probing` writes it.

    Attributes
    ----------
    matrix : Array, shape (k k,)
        G.
    offset, alone : Array, shapes (k,)
        Accelerations without forces at rest, at an impact rates without impulses; accelerations by a force if no joints
        held the bodies.
    usual : Array, shape (k,)
        Accelerations that are usual there, whose rounding the others have; 0 at an impact.
    scale : Array, shape (k,)
        Sizes of forces that rounding of a force at rest is relative to.
    apart, parts : Array, shapes (2 k,), (2 k, k)
        Reactions without efforts by reactions, and by their forces.
    """

    matrix: Array
    offset: Array
    alone: Array
    usual: Array
    scale: Array
    apart: Array
    parts: Array


class Placing(Record):
    """Gaps that a start puts to 0; `symgen.run.modes.placing` writes them. Empty without gaps, and in large mechanisms.

    Attributes
    ----------
    moved : Array, shape (k,)
        Gaps that a start has put to 0, before that; else 0.
    matrix, right, change, space, order : Array, Array of int64
        Working memory.
    """

    moved: Array
    matrix: Array
    right: Array
    change: Array
    space: Array
    order: Integers


class Found(Record):
    """What events have found of the rows; `symgen.run.modes.found_rows` writes it.

    Attributes
    ----------
    begins : Array of int64, shape (1,)
        1 where a run begins, or its inputs have changed; 0 at events.
    broken, stopped, left : Array of int64, shapes (k,)
        1 for coordinates that have just broken loose; for coordinates whose rate has just become zero; for one-sided
        rows whose force has just become zero.
    let_go, place : Array, shapes (k,)
        Time at which each coordinate has broken loose [s], and the coordinate there.
    depth : Array, shape (1,)
        Largest depth of an open gap below zero, over the mechanism's length.
    """

    begins: Integers
    broken: Integers
    stopped: Integers
    left: Integers
    let_go: Array
    place: Array
    depth: Array


class Choice(Record):
    """The k rows with bounds of a run, and working memory of choices of modes.

    Attributes
    ----------
    rows, read, found, problem, placing : Rows, Reading, Found, Problem, Placing
        What is constant, read, found by events and probed, and gaps put to 0.
    holds : Array, shape (k,)
        Bounds at rest as forces.
    unsought : Array of int64, shape (1,)
        Most rows that depend on each other, of which other motions than the one found were not sought in a run.
    box : Box
        The box problem of the rows at rest.
    laws : Laws
        The problem of all rows that depend on each other.
    pushed, at_rest : Array of int64, shapes (1,)
        Coordinate that a probe pushes, -1 for none; number of rows at rest.
    rest, loose, taken : Array of int64, shapes (k,)
        Rows at rest, in their order; 1 for loose rows; 1 for rows put into force.
    passing : Array of int64, shape (k,)
        1 for coordinates whose rate only passes zero, as no force within bounds holds them.
    shut : Array of int64, shape (k,)
        1 for closed gaps, whatever is left of them, as rows are off after a reset or an impact.
    named : Array of int64, shape (k + 1,)
        Rows whose forces are not determined, then -1; or the first row of another fault.
    step : Array, shape (1,)
        Step that laws assume before the first one [s].
    before, after : Array, shapes (MODE_NUMBERS k,)
        Modes.
    signs, trial : Array, shapes (k,)
        Signs of rates; the signs that a probe assumes, and other working memory.
    forces : Array, shape (k,)
        Forces at rest.
    rest_of : Array, shape (k k,)
        Remainder of G.
    jam : Array, shape (1,)
        Part of a reaction that its own effort brings about.
    sizes, factors : Array, shapes (k,)
        Sizes of reactions; what rows in force carry of a unit of force of each row that one of them carries.
    y, w, rate, out, iw : Array, Array of int64
        Arguments of emitted functions.
    room : Array
        Working memory of the choice of independent rows.
    mode, best, other, part, option : Array of int64, shapes (k,)
        Working memory: modes of the latest impact, of the motion found and of a second one, parts of G or carriers, and
        rows that are let go.
    flying : Array of int64, shape (k,)
        1 for gaps of contacts between two impacts, however low they fly.
    """

    rows: Rows
    read: Reading
    found: Found
    problem: Problem
    placing: Placing
    box: Box
    laws: Laws
    pushed: Integers
    at_rest: Integers
    rest: Integers
    loose: Integers
    taken: Integers
    passing: Integers
    shut: Integers
    named: Integers
    step: Array
    before: Array
    after: Array
    signs: Array
    trial: Array
    forces: Array
    rest_of: Array
    jam: Array
    sizes: Array
    factors: Array
    y: Array
    w: Array
    rate: Array
    out: Array
    room: Array
    iw: Integers
    mode: Integers
    best: Integers
    other: Integers
    part: Integers
    option: Integers
    flying: Integers
    holds: Array
    unsought: Integers


def new_choice(compiled: CompiledModel, rows: BoundedRows, rates: tuple[Any, Any], width: int, nw: int) -> Choice:
    """Return the rows with bounds of a run for the functions here.

    Parameters
    ----------
    compiled : CompiledModel
        Model and method.
    rows : BoundedRows
        Rows whose forces have bounds.
    rates : tuple of function
        Rates of v and multipliers, and their confirmation.
    width, nw : int
        Lengths of the state and of the scratch array.
    """
    info, k = compiled.info, len(rows.names)
    first = info.sections["modes"][0] + MODE_NUMBERS * info.switchable.index(info.bounded[0])
    places = np.full(info.m, -1, dtype=np.int64)
    places[list(info.bounded)] = np.arange(k)

    def flags(size: int = k) -> Integers:
        return np.zeros(size, dtype=np.int64)

    def marks(these: tuple[int, ...]) -> Integers:
        return np.isin(np.arange(k), these).astype(np.int64)

    numbers = np.zeros
    small = k > rows.dry and info.m * info.nv <= LARGEST
    m, n = (info.m, info.nv) if small else (0, 0)
    return Choice(
        rows=Rows(
            layout=layout_of_starts(compiled),
            rates=compiled_form(rates[0]),
            confirm=compiled_form(rates[1]),
            geometry=compiled_form(compiled.model.geometry),
            states=compiled_form(rows.state.function),
            accelerations=compiled_form(rows.accelerations.function),
            reactions=compiled_form(observe_nothing if rows.reactions is None else rows.reactions.function),
            first=first,
            count=k,
            dry=rows.dry,
            changes=int(rows.changes),
            angular=np.array([info.rows[i].unit == "rad" for i in info.bounded], dtype=np.int64),
            place_of=places,
            pushes=(np.arange(k) >= rows.dry).astype(np.int64) + (FURTHER_PIECE - 1) * marks(rows.pieces),
            pressed=marks(rows.pressed),
            varying=marks(rows.varying),
            shifted=int(len(rows.shifted) > 0),
            partner=np.array(rows.partners, dtype=np.int64) if rows.partners else np.full(k, -1),
            gaps=marks(rows.contacts),
            second=marks(rows.seconds),
            turning=marks(rows.turning),
        ),
        read=Reading(
            value=numbers(k),
            speed=numbers(k),
            static=numbers(k),
            sliding=numbers(k),
            restitution=numbers(k),
            middle=numbers(k),
            starting=flags(),
        ),
        found=Found(
            begins=flags(1),
            broken=flags(),
            stopped=flags(),
            left=flags(),
            let_go=np.full(k, np.nan),
            place=numbers(k),
            depth=np.full(1, TOUCHING),
        ),
        problem=Problem(
            matrix=numbers(k * k),
            offset=numbers(k),
            alone=numbers(k),
            usual=numbers(k),
            scale=numbers(k),
            apart=numbers(2 * k),
            parts=numbers(2 * k * k),
        ),
        placing=Placing(
            moved=numbers(k),
            matrix=numbers(m * n),
            right=numbers(m),
            change=numbers(n),
            space=numbers(m * min(m, n) + m + n if m else 0),
            order=flags(m),
        ),
        box=new_box(k),
        laws=new_laws(k),
        pushed=np.full(1, -1),
        at_rest=flags(1),
        rest=flags(),
        loose=flags(),
        taken=flags(),
        passing=flags(),
        shut=flags(),
        named=flags(k + 1),
        step=numbers(1),
        before=numbers(MODE_NUMBERS * k),
        after=numbers(MODE_NUMBERS * k),
        signs=numbers(k),
        trial=numbers(k),
        forces=numbers(k),
        rest_of=numbers(k * k),
        jam=numbers(1),
        sizes=numbers(k),
        factors=numbers(k),
        y=numbers(width),
        w=numbers(nw),
        rate=numbers(width),
        out=numbers(max(rows.values, 1)),
        room=numbers(room_of_choice(info.m, info.nv)),
        iw=flags(abi.N_COUNTERS),
        mode=flags(),
        best=flags(),
        other=flags(),
        part=flags(),
        option=flags(),
        flying=flags(),
        holds=numbers(k),
        unsought=flags(1),
    )


def first_step(span: Span) -> float:
    """Return the step that laws assume before the first one [s]."""
    return float(span.step if span.step > 0.0 else FIRST * span.duration)

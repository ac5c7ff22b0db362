"""Rows with bounds for compiled functions: their record with working memory, constants and scales."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from symgen.base.ir.program import MODE_NUMBERS
from symgen.compile.loopcode.exact import compiled_form, exact
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


#: Rates below this part of the largest speed are zero; accelerations below it over those of single forces are.
STILL, NO_ACCELERATION = 1e-10, 1e-10
#: Gaps below this part of the mechanism's length are closed.
TOUCHING = 1e-9
#: A coordinate that has moved by less than this part of the mechanism's length has just broken loose.
UNMOVED = 1e-9
#: A change of parameters or inputs closes a gap that it leaves penetrated by more than this part of the mechanism's
#: length.
DEEP = 1e-6
#: A formula for a bound in motion may be this part above that for the bound at rest, by rounding; a bound that falls
#: may be below an effort that several rows share by this part of forces.
ROUNDED = 1e-9
#: A force above this part of its bound is at its bound, where the row has broken loose.
AT_BOUND = 1.0 - 1e-9
#: Rows at rest of which less than this part is independent are determined by others; factors below it are rounding.
DEPENDENT, NO_FACTOR = 1e-11, 1e-9
#: A body counts with at least this part of the mean mass of a velocity where mobilities are compared: one without
#: inertia moves by what the joints connect it with.
LEAST_MASS = 1e-4
#: Assumed step until an adaptive run has chosen one, as a part of the run.
FIRST = 1e-3
#: Places of the numbers of a row.
HELD, CONSTANT, SIGN, LIMIT, EFFORT = range(5)
#: Constant of a row that is off and at rest with an effort of its own, of a one-sided row 0. Where another row carries
#: it, the constant is the number of that row, counted from 1.
AT_REST = -1.0
#: Codes: the same modes; others; accelerations that are not finite; no forces found; forces that are not determined;
#: bounds, gaps or restitutions that are undefined or out of range.
SAME, OTHERS, NOT_FINITE, NO_FORCES, NOT_DETERMINED, OUT_OF_RANGE = range(6)
#: Codes where bounds depend on reactions: efforts that bring about all of their reaction; reactions that redundant
#: rows leave undetermined; bounds and reactions that never agree; a force shared at rest beside what changes.
JAMMED, REDUNDANT, DISAGREED, SHARED = range(6, 10)
#: Codes of impacts: one that the joints do not allow, one whose impulses are not found.
NOT_APPLIED, NO_IMPULSES = 10, 11
#: What is out of range: a gap, a restitution, a bound in motion that is 0 beside one at rest, other bounds.
NEGATIVE_GAP, NO_RESTITUTION, NO_BOUND_IN_MOTION, NO_BOUNDS = range(12, 16)
#: Code of an impact at a gap whose rate joints and drivers determine: nothing can change it.
IMMOVABLE = 16
#: What `Choice.pushes` has of rows that are further pieces of the gap of the row before them.
FURTHER_PIECE = 2
#: Both pieces of a gap push at a corner.
TWO_PIECES = 17
#: Codes of contacts: no modes with forces within bounds; several with different motions; an impact that adds energy.
NO_CONTACT_MODES, SEVERAL_MODES, GAINED = range(24, 27)
#: Rows whose bounds depend on reactions have several motions.
SEVERAL_BY_REACTION = 27
#: A formula of a row is no number at the end of a run, or just after it.
NO_NUMBER = 18
#: Gaps leave what lies between them no way to move: of opposed ones that meet, none opens.
CONTRARY = 19


class Choice(Record):
    """The k rows with bounds of a run, two-sided ones first, and working memory.

    Attributes
    ----------
    layout : Layout
        Layout of the model.
    rates, confirm, geometry, states, accelerations : function
        Emitted functions: rates of v with multipliers, and their confirmation; ``geometry``; values, rates and bounds
        of the rows; their accelerations.
    reactions : function
        Components of the reactions that bounds depend on, two each.
    box : Box
        The box problem of the rows at rest.
    laws : Laws
        The problem of all rows that depend on each other.
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
    starting : Array of int64, shape (k,)
        1 for coordinates at rest with a sign that have just broken loose; others with a sign come to rest.
    begins : Array of int64, shape (1,)
        1 where a run begins, or its inputs have changed; 0 at events.
    let_go, place : Array, shapes (k,)
        Time at which each coordinate has broken loose [s], and the coordinate there.
    pushed, at_rest : Array of int64, shapes (1,)
        Coordinate that a probe pushes, -1 for none; number of rows at rest.
    broken, stopped, left : Array of int64, shapes (k,)
        1 for coordinates that have just broken loose; for coordinates whose rate has just become zero; for one-sided
        rows whose force has just become zero.
    rest, loose, taken : Array of int64, shapes (k,)
        Rows at rest, in their order; 1 for loose rows; 1 for rows put into force.
    passing : Array of int64, shape (k,)
        1 for coordinates whose rate only passes zero, as no force within bounds holds them.
    shut : Array of int64, shape (k,)
        1 for closed gaps, whatever is left of them, as rows are off after a reset or an impact.
    named : Array of int64, shape (k + 1,)
        Rows whose forces are not determined, then -1; or the first row of another fault.
    pressed, varying : Array of int64, shapes (k,)
        1 for coordinates whose bounds depend on reactions; 1 for coordinates whose bounds are formulas of more than
        parameters.
    shifted : int
        1 where coordinates have bounds at rest with another middle than those in motion.
    step : Array, shape (1,)
        Step that laws assume before the first one [s].
    value, speed, static, sliding, restitution, middle : Array, shapes (k,)
        Coordinates and gaps, their rates, bounds at rest and in motion, restitutions, and the middles of bounds at
        rest less those of bounds in motion.
    before, after : Array, shapes (MODE_NUMBERS k,)
        Modes.
    signs, trial : Array, shapes (k,)
        Signs of rates, and the signs that a probe assumes.
    offset, alone : Array, shapes (k,)
        Accelerations without forces at rest; accelerations by a force if no joints held the bodies.
    forces, scale : Array, shapes (k,)
        Forces at rest; sizes of forces that rounding of a force at rest is relative to.
    matrix, rest_of : Array, shapes (k k,)
        G, and its remainder.
    depth : Array, shape (1,)
        Largest depth of an open gap below zero, over the mechanism's length.
    jam : Array, shape (1,)
        Part of a reaction that its own effort brings about.
    apart, parts : Array, shapes (2 k,), (2 k, k)
        Reactions without efforts by reactions, and by their forces.
    sizes, bounds : Array, shapes (k,), (2 k,)
        Sizes of reactions; bounds at rest, then in motion, over these.
    y, w, rate, out, iw : Array, Array of int64
        Arguments of emitted functions.
    room : Array
        Working memory of the choice of independent rows.
    partner, gaps : Array of int64, shapes (k,)
        Of each row the other one of its contact, -1 for others; 1 for gaps of contacts.
    mode, best, other, carrier, part, option : Array of int64, shapes (k,)
        Working memory of contacts: modes of a combination, of the first that is right and of a second one, rows that
        carry others, parts of G, and the combination.
    flying : Array of int64, shape (k,)
        1 for gaps of contacts between two impacts, however low they fly.
    moved : Array, shape (k,)
        Gaps that a start has put to 0, before that; else 0.
    rows, right, shift, space, order : Array, Array of int64
        Working memory of `symgen.run.modes.placing`; empty without gaps, and for large mechanisms.
    """

    layout: Layout
    rates: abi.Rhs
    confirm: abi.Rhs
    geometry: abi.Measure
    states: abi.Observe
    accelerations: abi.Observe
    reactions: abi.Observe
    box: Box
    laws: Laws
    first: int
    count: int
    dry: int
    changes: int
    angular: Integers
    place_of: Integers
    pushes: Integers
    starting: Integers
    begins: Integers
    let_go: Array
    place: Array
    pushed: Integers
    at_rest: Integers
    broken: Integers
    stopped: Integers
    left: Integers
    rest: Integers
    loose: Integers
    taken: Integers
    passing: Integers
    shut: Integers
    named: Integers
    pressed: Integers
    varying: Integers
    shifted: int
    step: Array
    value: Array
    speed: Array
    static: Array
    sliding: Array
    restitution: Array
    middle: Array
    before: Array
    after: Array
    signs: Array
    trial: Array
    offset: Array
    alone: Array
    forces: Array
    scale: Array
    matrix: Array
    rest_of: Array
    depth: Array
    jam: Array
    apart: Array
    parts: Array
    sizes: Array
    bounds: Array
    y: Array
    w: Array
    rate: Array
    out: Array
    room: Array
    iw: Integers
    partner: Integers
    gaps: Integers
    mode: Integers
    best: Integers
    other: Integers
    carrier: Integers
    part: Integers
    option: Integers
    flying: Integers
    moved: Array
    rows: Array
    right: Array
    shift: Array
    space: Array
    order: Integers


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
        layout=layout_of_starts(compiled),
        rates=compiled_form(rates[0]),
        confirm=compiled_form(rates[1]),
        geometry=compiled_form(compiled.model.geometry),
        states=compiled_form(rows.state.function),
        accelerations=compiled_form(rows.accelerations.function),
        reactions=compiled_form(observe_nothing if rows.reactions is None else rows.reactions.function),
        box=new_box(k),
        laws=new_laws(k),
        first=first,
        count=k,
        dry=rows.dry,
        changes=int(rows.changes),
        angular=np.array([info.rows[i].unit == "rad" for i in info.bounded], dtype=np.int64),
        place_of=places,
        pushes=(np.arange(k) >= rows.dry).astype(np.int64) + (FURTHER_PIECE - 1) * marks(rows.pieces),
        starting=flags(),
        begins=flags(1),
        let_go=np.full(k, np.nan),
        place=numbers(k),
        pushed=np.full(1, -1),
        at_rest=flags(1),
        broken=flags(),
        stopped=flags(),
        left=flags(),
        rest=flags(),
        loose=flags(),
        taken=flags(),
        passing=flags(),
        shut=flags(),
        named=flags(k + 1),
        pressed=marks(rows.pressed),
        varying=marks(rows.varying),
        shifted=int(len(rows.shifted) > 0),
        step=numbers(1),
        value=numbers(k),
        speed=numbers(k),
        static=numbers(k),
        sliding=numbers(k),
        restitution=numbers(k),
        middle=numbers(k),
        before=numbers(MODE_NUMBERS * k),
        after=numbers(MODE_NUMBERS * k),
        signs=numbers(k),
        trial=numbers(k),
        offset=numbers(k),
        alone=numbers(k),
        forces=numbers(k),
        scale=numbers(k),
        matrix=numbers(k * k),
        rest_of=numbers(k * k),
        depth=np.full(1, TOUCHING),
        jam=numbers(1),
        apart=numbers(2 * k),
        parts=numbers(2 * k * k),
        sizes=numbers(k),
        bounds=numbers(2 * k),
        y=numbers(width),
        w=numbers(nw),
        rate=numbers(width),
        out=numbers(max(rows.values, 1)),
        room=numbers(room_of_choice(info.m, info.nv)),
        iw=flags(abi.N_COUNTERS),
        partner=np.array(rows.partners, dtype=np.int64) if rows.partners else np.full(k, -1),
        gaps=marks(rows.contacts),
        mode=flags(),
        best=flags(),
        other=flags(),
        carrier=flags(),
        part=flags(),
        option=flags(),
        flying=flags(),
        moved=numbers(k),
        rows=numbers(m * n),
        right=numbers(m),
        shift=numbers(n),
        space=numbers(m * min(m, n) + m + n if m else 0),
        order=flags(m),
    )


def first_step(span: Span) -> float:
    """Return the step that laws assume before the first one [s]."""
    return float(span.step if span.step > 0.0 else FIRST * span.duration)


@exact()
def row_scale(c: Choice, w: Array, i: int, place: int) -> float:
    """Return the mechanism's scale of speeds or of lengths in the unit of a row."""
    return float(w[place] / w[abi.LENGTH] if c.angular[i] != 0 else w[place])


@exact()
def usual_of(c: Choice, w: Array, i: int) -> float:
    """Return the mechanism's scale of accelerations in the unit of a row."""
    return float(row_scale(c, w, i, abi.SPEED) * (w[abi.SPEED] / w[abi.LENGTH]))


@exact()
def is_held(c: Choice, w: Array, i: int) -> bool:
    """Return whether a row is in force, or others carry its force: it is at rest or closed by its mode."""
    at = c.first + MODE_NUMBERS * i
    return bool(w[at + HELD] != 0.0 or (w[at + SIGN] == 0.0 and w[at + CONSTANT] != 0.0))


@exact()
def is_kept_shut(c: Choice, w: Array, i: int) -> bool:
    """Return whether a gap is closed by its mode, or was before a reset or an impact, whatever its gap is."""
    return bool(is_held(c, w, i) or c.shut[i] != 0)


@exact()
def open_rows(c: Choice, w: Array) -> None:
    """Take all rows out of force."""
    for i in range(MODE_NUMBERS * c.count):
        w[c.first + i] = 0.0


@exact(entry=True)
def switch_off(c: Choice, w: Array) -> int:
    """Take all rows out of force before a reset or an impact, and keep which gaps are closed; return their number."""
    closed = 0
    for i in range(c.count):
        c.shut[i] = 1 if c.pushes[i] != 0 and is_kept_shut(c, w, i) else 0
        closed += c.shut[i]
    open_rows(c, w)
    return int(closed)


@exact()
def is_shut(c: Choice, w: Array, i: int) -> bool:
    """Return whether a gap is closed: by its mode, or as it is 0 within the resolution of positions."""
    return bool(is_kept_shut(c, w, i) or c.value[i] <= TOUCHING * row_scale(c, w, i, abi.LENGTH))


@exact()
def sign_of_number(x: float) -> float:
    """Return the sign of a number."""
    return 1.0 if x > 0.0 else (-1.0 if x < 0.0 else 0.0)

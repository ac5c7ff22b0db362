"""Rows with bounds for compiled functions: their record with working memory, constants and scales."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from symgen.base.ir.program import MODE_NUMBERS
from symgen.compile.loopcode.exact import compiled_form, exact
from symgen.compile.native import types
from symgen.run.layout import abi
from symgen.run.layout.redundancy import room_of_choice
from symgen.run.layout.start_records import LAYOUT, record_type
from symgen.run.modes.box import BOX, new_box
from symgen.run.starts.assembler import layout_of
from symgen.run.starts.starting import observe_nothing

if TYPE_CHECKING:
    from symgen.run.layout.compiled import CompiledModel
    from symgen.run.loops.run_spec import BoundedRows

_F8, _A, _K, _N = types.float64, types.float64[::1], types.int64[::1], types.int64

#: Rates below this part of the largest speed are zero; accelerations below it over those of single forces are.
STILL, NO_ACCELERATION = 1e-10, 1e-10
#: Gaps below this part of the mechanism's length are closed.
TOUCHING = 1e-9
#: A gap that a change of parameters or inputs leaves is closed from this part of the mechanism's length behind it on.
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

#: The rows with bounds of a run, k of them, and working memory; those with two bounds first.
#: - reactions: Components of the reactions that bounds depend on, two each.
#: - first, count, dry: Place in w of their first number, their number, and that of rows with two bounds.
#: - changes: 1 where anything but the motion and inputs changes over time.
#: - pushed, at_rest (shapes (1,)): A coordinate pushed by a probe, -1 for none; number of rows at rest.
#: - step (shape (1,)): Step that laws assume before the first one [s].
#: - angular (shape (k,)): 1 where the measure of a row is an angle.
#: - place_of (shape (m,)): Number among these of each row, -1 for others.
#: - pushes (shape (k,)): 1 for one-sided rows, which stand last, else 0.
#: - broken, stopped, left (shapes (k,)): 1 for coordinates that have just broken loose, or whose rate has just become
#:   zero; for one-sided rows whose force has.
#: - rest, loose, taken (shapes (k,)): Rows at rest, in their order; 1 for loose rows; for rows put into force.
#: - passing (shape (k,)): 1 for coordinates whose rate only passes zero, as no force within bounds holds them.
#: - shut (shape (k,)): 1 for closed gaps, whatever is left of their gaps, as rows are off behind a reset or
#:   an impact.
#: - named (shape (k + 1,)): Rows whose forces are not determined, then -1; or the first row of another fault.
#: - pressed, varying (shapes (k,)): 1 for coordinates whose bounds depend on reactions; for those whose bounds are
#:   formulas of more than parameters.
#: - value ... restitution (shapes (k,)): Coordinates and gaps, rates, bounds, restitutions.
#: - before, after (shape (MODE_NUMBERS k,)): Modes.
#: - signs, trial, offset, alone, forces (shapes (k,)): Signs of rates; those of a probe; accelerations without forces
#:   at rest; by a force if no joints held the bodies; forces at rest.
#: - scale (shape (k,)): Sizes of forces that rounding of a force at rest is relative to.
#: - depth (shape (1,)): Largest depth behind an open gap, over the mechanism's length.
#: - matrix, rest_of (shapes (k k,)): G, and what is left of it.
#: - jam (shape (1,)): Part of a reaction that its own effort brings about.
#: - apart, parts (shapes (2 k,), (2 k, k)): Reactions without efforts by reactions, and by their forces.
#: - sizes, bounds (shapes (k,), (2 k,)): Sizes of reactions; bounds at rest, then in motion, over these.
#: - y, w, rate, out, iw: Of emitted functions.
#: - room: Of the choice of independent rows.
CHOICE = record_type(
    "Choice",
    __name__,
    ("layout", LAYOUT),
    ("rates confirm", abi.RHS),
    ("geometry", abi.MEASURE),
    ("states accelerations reactions", abi.OBSERVE),
    ("box", BOX),
    ("first count dry changes", _N),
    ("angular place_of pushes pushed at_rest broken stopped left rest loose taken passing shut", _K),
    ("named pressed varying", _K),
    ("step value speed static sliding restitution before after signs trial offset alone forces scale matrix", _A),
    ("rest_of depth jam apart parts sizes bounds y w rate out room", _A),
    ("iw", _K),
)
Choice: Any = CHOICE.constructor


def new_choice(compiled: CompiledModel, rows: BoundedRows, rates: tuple[Any, Any], width: int, nw: int) -> Any:
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
    reactions = observe_nothing if rows.reactions is None else rows.reactions.function
    functions = (*rates, compiled.model.geometry, rows.state.function, rows.accelerations.function, reactions)
    flags = (np.zeros(k, dtype=np.int64) for _ in range(8))
    numbers = (np.zeros(size * k) for size in (1, 1, 1, 1, 1, MODE_NUMBERS, MODE_NUMBERS, 1, 1, 1, 1, 1, 1, k, k))
    states = 2 * k + 2 * rows.dry + (k - rows.dry)
    return Choice._make(
        (
            *(layout_of(compiled), *(compiled_form(f) for f in functions), new_box(k), first, k, rows.dry),
            int(rows.changes),
            *(np.array([info.rows[i].unit == "rad" for i in info.bounded], dtype=np.int64), places),
            (np.arange(k) >= rows.dry).astype(np.int64),
            *(np.full(1, -1), np.zeros(1, dtype=np.int64), *flags, np.zeros(k + 1, dtype=np.int64)),
            *(np.isin(np.arange(k), these).astype(np.int64) for these in (rows.pressed, rows.varying)),
            *(
                np.zeros(1),
                *numbers,
                np.full(1, TOUCHING),
                *(np.zeros(size) for size in (1, 2 * k, 2 * k * k, k, 2 * k)),
            ),
            *(np.zeros(size) for size in (width, nw, width, max(states, 1), room_of_choice(info.m, info.nv))),
            np.zeros(abi.N_COUNTERS, dtype=np.int64),
        )
    )


def first_step(span: Any) -> float:
    """Return the step that laws assume before the first one [s]."""
    return float(span.step if span.step > 0.0 else FIRST * span.duration)


@exact()
def row_scale(c: Any, w: Any, i: int, place: int) -> float:
    """Return the mechanism's scale of speeds or of lengths in the unit of a row."""
    return float(w[place] / w[abi.LENGTH] if c.angular[i] != 0 else w[place])


@exact()
def usual_of(c: Any, w: Any, i: int) -> float:
    """Return the mechanism's scale of accelerations in the unit of a row."""
    return float(row_scale(c, w, i, abi.SPEED) * (w[abi.SPEED] / w[abi.LENGTH]))


@exact()
def is_held(c: Any, w: Any, i: int) -> bool:
    """Return whether a row is in force, or others carry its force: it is at rest or closed by its mode."""
    at = c.first + MODE_NUMBERS * i
    return bool(w[at + HELD] != 0.0 or (w[at + SIGN] == 0.0 and w[at + CONSTANT] != 0.0))


@exact()
def stays_shut(c: Any, w: Any, i: int) -> bool:
    """Return whether a gap is closed by its mode, or was before a reset or an impact, whatever its gap is."""
    return bool(is_held(c, w, i) or c.shut[i] != 0)


@exact()
def open_rows(c: Any, w: Any) -> None:
    """Take all rows out of force."""
    for i in range(MODE_NUMBERS * c.count):
        w[c.first + i] = 0.0


@exact(_N(CHOICE, _A))
def put_off(c: Any, w: Any) -> int:
    """Take all rows out of force before a reset or an impact, and keep which gaps are closed; return their number."""
    closed = 0
    for i in range(c.count):
        c.shut[i] = 1 if c.pushes[i] != 0 and stays_shut(c, w, i) else 0
        closed += c.shut[i]
    open_rows(c, w)
    return int(closed)


@exact()
def is_shut(c: Any, w: Any, i: int) -> bool:
    """Return whether a gap is closed: by its mode, or as it is 0 within the resolution of positions."""
    return bool(stays_shut(c, w, i) or c.value[i] <= TOUCHING * row_scale(c, w, i, abi.LENGTH))


@exact()
def sign_of(x: float) -> float:
    """Return the sign of a number."""
    return 1.0 if x > 0.0 else (-1.0 if x < 0.0 else 0.0)

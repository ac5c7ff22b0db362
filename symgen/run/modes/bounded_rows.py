"""Rows with bounds for compiled functions: codes, constants and scales."""

from __future__ import annotations

from symgen.base.ir.program import MODE_NUMBERS
from symgen.compile.loopcode.exact import exact
from symgen.compile.native.annotations import Array
from symgen.run.layout import abi
from symgen.run.modes.row_records import TOUCHING, Choice

#: Rates below this part of the largest speed are zero; accelerations below it over those of single forces are.
STILL, NO_ACCELERATION = 1e-10, 1e-10
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
#: Places of the numbers of a row.
HELD, CONSTANT, SIGN, LIMIT, EFFORT = range(5)
#: Constant of a row that is off and at rest with an effort of its own, of a one-sided row 0. Where another row carries
#: it, the constant is the number of that row, counted from 1.
AT_REST = -1.0
#: Codes: the same modes; others; accelerations that are not finite; no forces found; bounds, gaps or restitutions that
#: are undefined or out of range.
SAME, OTHERS, NOT_FINITE, NO_FORCES = range(4)
OUT_OF_RANGE = 5
#: Codes where bounds depend on reactions: efforts that bring about all of their reaction; reactions that redundant
#: rows leave undetermined; bounds and reactions that never agree.
JAMMED, REDUNDANT, DISAGREED = range(6, 9)
#: Code of an impact that the joints do not allow.
NOT_APPLIED = 10
#: What is out of range: a gap, a restitution, a bound in motion that is 0 beside one at rest, other bounds.
NEGATIVE_GAP, NO_RESTITUTION, NO_BOUND_IN_MOTION, NO_BOUNDS = range(12, 16)
#: Code of an impact at a gap whose rate joints and drivers determine: nothing can change it.
IMMOVABLE = 16
#: Both pieces of a gap push at a corner.
TWO_PIECES = 17
#: Codes of contacts: no modes with forces within bounds; several with different motions; an impact that adds energy.
NO_CONTACT_MODES, SEVERAL_MODES, GAINED = range(24, 27)
#: Rows whose bounds depend on reactions have several motions; no forces are found, though no contact jams alone.
SEVERAL_BY_REACTION, NOTHING_FOUND = 27, 28
#: A formula of a row is no number at the end of a run, or just after it.
NO_NUMBER = 18
#: Gaps leave what lies between them no way to move: of opposed ones that meet, none opens.
CONTRARY = 19


@exact()
def row_scale(c: Choice, w: Array, i: int, place: int) -> float:
    """Return the mechanism's scale of speeds or of lengths in the unit of a row."""
    return float(w[place] / w[abi.LENGTH] if c.rows.angular[i] != 0 else w[place])


@exact()
def usual_of(c: Choice, w: Array, i: int) -> float:
    """Return the mechanism's scale of accelerations in the unit of a row."""
    return float(row_scale(c, w, i, abi.SPEED) * (w[abi.SPEED] / w[abi.LENGTH]))


@exact()
def is_held(c: Choice, w: Array, i: int) -> bool:
    """Return whether a row is in force, or others carry its force: it is at rest or closed by its mode."""
    at = c.rows.first + MODE_NUMBERS * i
    return bool(w[at + HELD] != 0.0 or (w[at + SIGN] == 0.0 and w[at + CONSTANT] != 0.0))


@exact()
def is_kept_shut(c: Choice, w: Array, i: int) -> bool:
    """Return whether a gap is closed by its mode, or was before a reset or an impact, whatever its gap is."""
    return bool(is_held(c, w, i) or c.shut[i] != 0)


@exact()
def open_rows(c: Choice, w: Array) -> None:
    """Take all rows out of force."""
    for i in range(MODE_NUMBERS * c.rows.count):
        w[c.rows.first + i] = 0.0


@exact(entry=True)
def switch_off(c: Choice, w: Array) -> int:
    """Take all rows out of force before a reset or an impact, and keep which gaps are closed; return their number."""
    closed = 0
    for i in range(c.rows.count):
        c.shut[i] = 1 if c.rows.pushes[i] != 0 and is_kept_shut(c, w, i) else 0
        closed += c.shut[i]
    open_rows(c, w)
    return int(closed)


@exact()
def is_shut(c: Choice, w: Array, i: int) -> bool:
    """Return whether a gap is closed: by its mode, or as it is 0 within the resolution of positions."""
    return bool(is_kept_shut(c, w, i) or c.read.value[i] <= TOUCHING * row_scale(c, w, i, abi.LENGTH))


@exact()
def sign_of_number(x: float) -> float:
    """Return the sign of a number."""
    return 1.0 if x > 0.0 else (-1.0 if x < 0.0 else 0.0)

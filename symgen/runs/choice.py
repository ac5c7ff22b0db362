"""The choice of modes at one state, compiled: rows at rest, their forces, and which of them are put into force.

One function of the loop language for single runs and rows of sweeps, so that both have the same bits. See
`symgen.runs.transitions`.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np

from symgen.ir.numerics import SKIP
from symgen.ir.program import MODE_NUMBERS
from symgen.layout import abi
from symgen.layout.redundancy import choose_rows, farthest, is_off, room_of_choice
from symgen.layout.scales import entry_of, larger
from symgen.layout.start_records import LAYOUT, record_type
from symgen.loopcode.exact import compiled_form, exact
from symgen.native import types
from symgen.runs.box import BOX, INSIDE, independent_set, new_box, solve_box, solve_independent
from symgen.starts.assembler import layout_of

if TYPE_CHECKING:
    from symgen.layout.compiled import CompiledModel
    from symgen.loops.run_spec import BoundedRows

_F8, _A, _K, _N = types.float64, types.float64[::1], types.int64[::1], types.int64

#: Rates below this part of the largest speed are zero; accelerations below it over those of single forces are.
STILL, NO_ACCELERATION = 1e-10, 1e-10
#: Gaps below this part of the mechanism's length are closed.
TOUCHING = 1e-9
#: A force above this part of its bound is at its bound, where the row has broken loose.
AT_BOUND = 1.0 - 1e-9
#: Rows at rest of which less than this part is independent are determined by others; factors below it are rounding.
DEPENDENT, NO_FACTOR = 1e-11, 1e-9
#: Assumed step until an adaptive run has chosen one, as a part of the run.
FIRST = 1e-3
#: Places of the numbers of a row.
HELD, CONSTANT, SIGN, LIMIT = range(4)
#: Codes: the same modes; others; accelerations that are not finite; no forces found; forces that are not determined;
#: bounds, gaps or restitutions that are undefined or out of range.
SAME, OTHERS, NOT_FINITE, NO_FORCES, NOT_DETERMINED, OUT_OF_RANGE = range(6)

#: The rows with bounds of a run, k of them, and working memory; friction first, then stops.
#: - first, count, dry: Place in w of their first number, their number, and that of friction.
#: - pushed, at_rest (shapes (1,)): A coordinate pushed by a probe, -1 for none; number of rows at rest.
#: - step (shape (1,)): Step that laws assume before the first one [s].
#: - angular (shape (k,)): 1 where the measure of a row is an angle.
#: - place_of (shape (m,)): Number among these of each row, -1 for others.
#: - broken, stopped, left (shapes (k,)): 1 for coordinates that have just broken loose, or whose rate has just become
#:   zero; for stops whose force has.
#: - rest, loose, taken (shapes (k,)): Rows at rest, in their order; 1 for loose rows; for rows put into force.
#: - named (shape (k + 1,)): Rows whose forces are not determined, then -1.
#: - value ... restitution (shapes (k,)): Coordinates and gaps, rates, bounds, restitutions.
#: - before, after (shape (MODE_NUMBERS k,)): Modes.
#: - signs, trial, offset, alone, forces (shapes (k,)): Signs of rates; those of a probe; accelerations without forces
#:   at rest; by a force if no joints held the bodies; forces at rest.
#: - matrix, rest_of (shapes (k k,)): G, and what is left of it.
#: - y, w, rate, out, iw: Of emitted functions.
#: - room: Of the choice of independent rows.
CHOICE = record_type(
    "Choice",
    __name__,
    ("layout", LAYOUT),
    ("rates confirm", abi.RHS),
    ("geometry", abi.MEASURE),
    ("states accelerations", abi.OBSERVE),
    ("box", BOX),
    ("first count dry", _N),
    ("angular place_of pushed at_rest broken stopped left rest loose taken named", _K),
    ("step value speed static sliding restitution before after signs trial offset alone forces matrix rest_of", _A),
    ("y w rate out room", _A),
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
    functions = (*rates, compiled.model.geometry, rows.state.function, rows.accelerations.function)
    flags = (np.zeros(k, dtype=np.int64) for _ in range(6))
    numbers = (np.zeros(size * k) for size in (1, 1, 1, 1, 1, MODE_NUMBERS, MODE_NUMBERS, 1, 1, 1, 1, 1, k, k))
    states = 2 * k + 2 * rows.dry + (k - rows.dry)
    return Choice._make(
        (
            *(layout_of(compiled), *(compiled_form(f) for f in functions), new_box(k), first, k, rows.dry),
            *(np.array([info.rows[i].unit == "rad" for i in info.bounded], dtype=np.int64), places),
            *(np.full(1, -1), np.zeros(1, dtype=np.int64), *flags, np.zeros(k + 1, dtype=np.int64)),
            *(np.zeros(1), *numbers),
            *(np.zeros(size) for size in (width, nw, width, max(states, 1), room_of_choice(info.m, info.nv))),
            np.zeros(abi.N_COUNTERS, dtype=np.int64),
        )
    )


def first_step(span: Any) -> float:
    """Return the step that laws assume before the first one [s]."""
    return float(span.step if span.step > 0.0 else FIRST * span.duration)


@exact()
def scale_of(c: Any, w: Any, i: int, place: int) -> float:
    """Return the mechanism's scale of speeds or of lengths in the unit of a row."""
    return float(w[place] / w[abi.LENGTH] if c.angular[i] != 0 else w[place])


@exact()
def usual_of(c: Any, w: Any, i: int) -> float:
    """Return the mechanism's scale of accelerations in the unit of a row."""
    return float(scale_of(c, w, i, abi.SPEED) * (w[abi.SPEED] / w[abi.LENGTH]))


@exact()
def sign_of(x: float) -> float:
    """Return the sign of a number."""
    return 1.0 if x > 0.0 else (-1.0 if x < 0.0 else 0.0)


@exact(_N(_F8, CHOICE, _A, _A, _A))
def read_rows(t: float, c: Any, y: Any, p: Any, w: Any) -> int:
    """Read coordinates, rates and bounds at a state; return `SAME`, or `OUT_OF_RANGE`."""
    k, dry, out = c.count, c.dry, c.out
    c.states(t, y, p, w, c.rate, out)
    valid = True
    for i in range(k):
        c.value[i], c.speed[i] = out[i], out[k + i]
        c.static[i] = c.sliding[i] = c.restitution[i] = 0.0
        valid = valid and math.isfinite(out[i]) and math.isfinite(out[k + i])
        if i < dry:
            static, sliding = out[2 * k + i], out[2 * k + dry + i]
            c.static[i], c.sliding[i] = static, sliding
            valid = valid and math.isfinite(static) and sliding >= 0.0 and static >= sliding
            valid = valid and not (sliding == 0.0 and static > 0.0)
        else:
            restitution = out[2 * k + dry + i]
            c.restitution[i] = restitution
            valid = valid and restitution >= 0.0 and restitution <= 1.0
            valid = valid and out[i] >= -TOUCHING * scale_of(c, w, i, abi.LENGTH)
    return SAME if valid else OUT_OF_RANGE


@exact(_N(CHOICE))
def find_mobility(c: Any) -> int:
    """Set the acceleration of each coordinate by a force on it if no joints held the bodies."""
    layout = c.layout
    for i in range(c.count):
        c.alone[i] = 0.0
    for e in range(layout.constants.shape[0]):
        i, mass = c.place_of[layout.entries[3 * e]], c.w[layout.mass + layout.entries[3 * e + 1]]
        if i >= 0 and mass > 0.0:
            entry = entry_of(layout, c.w, e)
            c.alone[i] += entry * entry / mass
    return int(c.count)


@exact(_N(_F8, CHOICE, _A, _A, _A, _K, _K))
def accelerate(t: float, c: Any, y: Any, p: Any, w: Any, iw: Any, control: Any) -> int:
    """Write the accelerations of coordinates with all rows off and efforts of the signs of ``trial`` to ``out``.

    A coordinate whose bounds depend on a reaction may be ``pushed`` by a force of -1.
    """
    for i in range(w.shape[0]):
        c.w[i] = w[i]
    for i in range(y.shape[0]):
        c.y[i] = y[i]
    for i in range(iw.shape[0]):
        c.iw[i] = iw[i]
    for i in range(c.count):
        at = c.first + MODE_NUMBERS * i
        c.w[at + HELD] = c.w[at + CONSTANT] = c.w[at + LIMIT] = 0.0
        c.w[at + SIGN] = c.trial[i]
    if c.pushed[0] >= 0:
        c.w[c.first + MODE_NUMBERS * c.pushed[0] + LIMIT] = 1.0
    if c.w[abi.STEP_STATUS] == 0.0:  # of laws whose gains follow the step, before the first one
        c.w[abi.STEP_STATUS] = c.step[0]
    if c.rates(t, c.y, p, c.w, c.iw, c.rate) != 0:
        c.confirm(t, c.y, p, c.w, c.iw, c.rate)
    control[abi.EVALUATIONS] += 1
    c.accelerations(t, c.y, p, c.w, c.rate, c.out)
    for i in range(c.count):
        if not math.isfinite(c.out[i]):
            return NOT_FINITE
    return SAME


@exact(_N(_F8, CHOICE, _A, _A, _A, _K, _K))
def probe(t: float, c: Any, y: Any, p: Any, w: Any, iw: Any, control: Any) -> int:
    """Set G among the rows at rest, and the accelerations without their forces."""
    k, n = c.count, c.at_rest[0]
    for i in range(k * k):
        c.matrix[i] = 0.0
    for i in range(k):
        c.trial[i] = c.signs[i]
    if accelerate(t, c, y, p, w, iw, control) != SAME:
        return NOT_FINITE
    for i in range(k):
        c.offset[i] = c.out[i]
    find_mobility(c)
    for r in range(n):
        j = c.rest[r]
        force, sign = c.sliding[j], 1.0
        if j >= c.dry and c.alone[j] > 0.0:  # accelerations as large as those that are there
            force = larger(abs(c.offset[j]), usual_of(c, w, j)) / c.alone[j]
            sign = -force
        if force > 0.0:
            for i in range(k):
                c.trial[i] = c.signs[i]
            c.trial[j] = sign
            if accelerate(t, c, y, p, w, iw, control) != SAME:
                return NOT_FINITE
            for i in range(k):
                c.matrix[i * k + j] = (c.offset[i] - c.out[i]) / force
    symmetrise(c)
    return SAME


@exact(_N(CHOICE))
def symmetrise(c: Any) -> int:
    """Make G symmetric among rows at rest, and 0 for rows that joints hold still, as at a dead centre."""
    k, n, matrix = c.count, c.at_rest[0], c.matrix
    for a in range(n):
        for b in range(a):
            i, j = c.rest[a], c.rest[b]
            mean = 0.5 * (matrix[i * k + j] + matrix[j * k + i])
            matrix[i * k + j] = matrix[j * k + i] = mean
    for a in range(n):
        i = c.rest[a]
        if matrix[i * k + i] <= DEPENDENT * c.alone[i]:
            for b in range(n):
                j = c.rest[b]
                matrix[i * k + j] = matrix[j * k + i] = 0.0
    return int(n)


@exact(_N(CHOICE, _A))
def find_rest(c: Any, w: Any) -> int:
    """Set the rows at rest, which of them are loose, and the signs of all others; return the number at rest."""
    n = 0
    for i in range(c.count):
        c.signs[i] = 0.0
        for number in range(MODE_NUMBERS):
            c.before[MODE_NUMBERS * i + number] = w[c.first + MODE_NUMBERS * i + number]
            c.after[MODE_NUMBERS * i + number] = 0.0
        c.forces[i] = 0.0
        c.taken[i] = 0
    for i in range(c.count):
        at, stop = MODE_NUMBERS * i, i >= c.dry
        still = abs(c.speed[i]) <= STILL * scale_of(c, w, i, abi.SPEED) or c.broken[i] + c.stopped[i] != 0
        still = still and not (stop and c.value[i] > TOUCHING * scale_of(c, w, i, abi.LENGTH))
        loose = (still and c.before[at + SIGN] != 0.0) or c.broken[i] != 0
        loose = (loose and c.stopped[i] == 0) or c.left[i] != 0
        owner = int(c.before[at + CONSTANT])
        if c.before[at + HELD] == 0.0 and c.before[at + SIGN] == 0.0 and c.before[at + LIMIT] != 0.0 and owner >= 0:
            loose = loose or (c.broken[owner] != 0 and c.before[MODE_NUMBERS * owner + HELD] != 0.0)
        c.loose[i] = 1 if loose else 0
        c.signs[i] = 0.0 if still or stop else sign_of(c.speed[i])
        if still:
            c.rest[n] = i
            n += 1
    c.at_rest[0] = n
    return n


@exact()
def moves_at(c: Any, n: int, r: int) -> bool:
    """Whether the acceleration of the row at place `r` among those at rest is more than rounding."""
    box, size = c.box, abs(c.box.offset[r])
    for j in range(n):
        size += abs(box.matrix[r * n + j]) * abs(box.forces[j])
    return bool(box.place[r] != INSIDE and abs(box.left[r]) > NO_ACCELERATION * size)


@exact()
def solve_rest(c: Any, n: int, w: Any) -> int:
    """Find the forces at rest, and the signs of rows that they do not hold; return `SAME` or `NO_FORCES`."""
    k, box = c.count, c.box
    for r in range(n):
        i = c.rest[r]
        box.offset[r] = c.offset[i]
        c.taken[i] = 1 if i < c.dry and c.loose[i] == 0 else 0  # its static bound holds
        for s in range(n):
            box.matrix[r * n + s] = c.matrix[i * k + c.rest[s]]
    while True:
        for r in range(n):
            i = c.rest[r]
            bound = c.static[i] if c.taken[i] != 0 else c.sliding[i]
            stop = i >= c.dry
            box.bounds[r] = 0.0 if stop else bound
            box.lower[r] = -bound if not stop else (0.0 if c.loose[i] != 0 else -math.inf)
        if solve_box(n, box) != 0:
            return NO_FORCES
        again = False
        for r in range(n):
            i = c.rest[r]
            if moves_at(c, n, r):
                if i < c.dry and c.taken[i] != 0 and c.static[i] > c.sliding[i]:
                    c.taken[i], again = 0, True
                if i >= c.dry and c.loose[i] != 0 and box.left[r] < -NO_ACCELERATION * usual_of(c, w, i):
                    c.loose[i], again = 0, True
        if not again:
            break
    for r in range(n):
        i = c.rest[r]
        bound, force, moves = c.static[i] if c.taken[i] != 0 else c.sliding[i], box.forces[r], moves_at(c, n, r)
        if i >= c.dry:
            moves = moves and box.left[r] > 0.0
        elif c.loose[i] != 0 and abs(force) >= AT_BOUND * bound and bound > 0.0:
            moves = True
        c.forces[i] = force
        c.signs[i] = 0.0
        if moves:
            c.signs[i] = sign_of(box.left[r] if force == 0.0 or i >= c.dry else force)
        c.taken[i] = 0
    return SAME


@exact()
def independence(c: Any, i: int) -> float:
    """Return the part of a row at rest that rows put into force do not determine."""
    return float(c.rest_of[i * c.count + i] / c.alone[i]) if c.alone[i] > 0.0 else 0.0


@exact()
def take_rows(c: Any, n: int, pushing: bool, w: Any) -> None:
    """Put the most independent rows at rest into force, one after the other; `pushing`: only stops that push."""
    k, left = c.count, c.rest_of
    while True:
        best, most = -1, DEPENDENT
        for r in range(n):
            i = c.rest[r]
            free = c.taken[i] == 0 and c.signs[i] == 0.0 and not (i >= c.dry and c.loose[i] != 0)
            if pushing:
                least = NO_ACCELERATION * usual_of(c, w, i)
                free = free and i >= c.dry and -c.forces[i] * c.matrix[i * k + i] > least
            if free and independence(c, i) > most:
                best, most = i, independence(c, i)
        if best < 0:
            break
        c.taken[best] = 1
        pivot = left[best * k + best]
        for i in range(k):
            c.trial[i], c.offset[i] = left[i * k + best], left[best * k + i]
        for i in range(k):
            for j in range(k):
                left[i * k + j] -= c.trial[i] * c.offset[j] / pivot


@exact(_N(CHOICE, _A))
def hold_rows(c: Any, w: Any) -> int:
    """Put independent rows among those at rest into force; set their constants and largest efforts.

    Stops that push come first: a coordinate that they keep at rest does not slide. Returns `SAME`, or
    `NOT_DETERMINED`.
    """
    k, n, after = c.count, c.at_rest[0], c.after
    for i in range(k * k):
        c.rest_of[i] = c.matrix[i]
    kept = 0
    for r in range(n):
        i = c.rest[r]
        if c.matrix[i * k + i] > DEPENDENT * c.alone[i] or c.signs[i] == 0.0:
            c.rest[kept] = i
            kept += 1
    take_rows(c, kept, True, w)
    for r in range(kept):
        i = c.rest[r]
        if i < c.dry and independence(c, i) <= DEPENDENT:
            c.signs[i] = 0.0
    take_rows(c, kept, False, w)
    count = 0
    for i in range(k):
        at = MODE_NUMBERS * i
        if c.taken[i] != 0:
            c.box.order[count] = i
            count += 1
            after[at + HELD] = 1.0
            after[at + CONSTANT] = c.before[at + CONSTANT] if c.before[at + HELD] != 0.0 else c.value[i]
            after[at + LIMIT] = 0.0 if i >= c.dry else c.static[i]
    for r in range(kept):
        i = c.rest[r]
        other = c.taken[i] == 0 and c.signs[i] == 0.0 and c.matrix[i * k + i] > DEPENDENT * c.alone[i]
        if other and not (i >= c.dry and independence(c, i) > DEPENDENT):
            if share_force(c, i, count) != SAME:
                return NOT_DETERMINED
    for i in range(k):
        after[MODE_NUMBERS * i + SIGN] = 0.0 if i >= c.dry else c.signs[i]
    return SAME


@exact()
def share_force(c: Any, i: int, count: int) -> int:
    """Give the effort of a row that rows in force determine to the one that carries it."""
    k, box, after = c.count, c.box, c.after
    a = 0
    for j in range(k):
        if c.taken[j] != 0:
            box.offset[a] = c.matrix[j * k + i]
            b = 0
            for other in range(k):
                if c.taken[other] != 0:
                    box.matrix[a * count + b] = c.matrix[j * k + other]
                    b += 1
            a += 1
    for j in range(count):
        box.order[j] = j
    rank, most = independent_set(count, count, box), 0.0
    for j in range(rank):
        box.right[j] = box.offset[box.order[j]]
    solve_independent(count, rank, box)
    for j in range(count):
        box.left[j] = 0.0
    for j in range(rank):
        box.left[box.order[j]] = box.right[j]
        most = larger(most, abs(box.right[j]))
    owners, stops, owner, a, factor = 0, 0, -1, 0, 0.0
    c.named[0] = i
    for j in range(k):
        if c.taken[j] != 0:
            if abs(box.left[a]) > NO_FACTOR * most:
                owners += 1
                stops += 1 if j >= c.dry else 0
                owner, factor = j, abs(box.left[a])
                c.named[owners] = j
            a += 1
    at = MODE_NUMBERS * i
    if i >= c.dry or stops == owners:
        after[at + CONSTANT], after[at + LIMIT] = -1.0, 1.0
        return SAME
    if owners != 1:
        for j in range(owners + 1, k + 1):
            c.named[j] = -1
        return NOT_DETERMINED
    after[at + CONSTANT], after[at + LIMIT] = float(owner), factor * c.static[i]
    after[MODE_NUMBERS * owner + LIMIT] += factor * c.static[i]
    return SAME


@exact(_N(CHOICE, _A))
def write_modes(c: Any, w: Any) -> int:
    """Write the chosen modes; return `OTHERS` where they differ from those before, else `SAME`."""
    code = SAME
    for i in range(MODE_NUMBERS * c.count):
        if w[c.first + i] != c.after[i]:
            code = OTHERS
        w[c.first + i] = c.after[i]
    return code


@exact(_N(_F8, CHOICE, _A, _A, _A, _K, _K))
def choose_modes(t: float, c: Any, y: Any, p: Any, w: Any, iw: Any, control: Any) -> int:
    """Choose the modes of a state whose rows have been read; return `SAME`, `OTHERS`, or why there are none."""
    n = find_rest(c, w)
    if n > 0:
        if probe(t, c, y, p, w, iw, control) != SAME:
            return NOT_FINITE
        if solve_rest(c, n, w) != SAME:
            return NO_FORCES
    if hold_rows(c, w) != SAME:
        return NOT_DETERMINED
    return int(write_modes(c, w))


@exact(_N(_F8, CHOICE, _A, _A, _A))
def follow_modes(t: float, c: Any, y: Any, p: Any, w: Any) -> int:
    """Evaluate the geometry in new modes, and choose which redundant rows are left out; return 1 where others are.

    Rows of too large mechanisms stay the same.
    """
    layout, m = c.layout, c.layout.m
    c.geometry(t, y, p, w)
    if c.room.shape[0] == 0:
        return 0
    off, changed = 0, 0
    for i in range(m):
        off += 1 if is_off(layout, i, w) else 0
    redundant = m - off - farthest(layout, layout.nv, m, SKIP, 1, w, c.room)
    for i in range(m):
        c.w[i] = w[layout.mask + i]
        w[layout.mask + i] = 0.0
    if redundant > 0:
        choose_rows(layout, m - redundant, 1, w, c.room)
    for i in range(m):
        changed = changed if c.w[i] == w[layout.mask + i] else 1
    if changed != 0:
        c.geometry(t, y, p, w)
    return int(changed)


def begin_afresh(state: Any) -> None:
    """Have the scheme begin anew, and passages of singular positions be looked for anew: there are other rows."""
    gauges, w = state.gauges, state.w
    sine, short = math.sqrt(max(w[abi.PIVOT], 0.0)), math.sqrt(max(w[abi.SHORTEST_ROW], 0.0))
    gauges[abi.LAST_SINE], gauges[abi.LARGEST_SINE], gauges[abi.LAST_SHORT] = sine, sine, short
    gauges[abi.FALL], gauges[abi.SHORT_FALL], gauges[abi.CHOSEN] = 0.0, 0.0, 0.0
    if state.control[abi.BEGUN] != 0:
        state.control[abi.BEGUN] = abi.AFRESH
    state.control[abi.KNOWN], state.control[abi.POINTS], state.control[abi.REFUSED] = 0, 0, 0
    state.clock[abi.ALLOWED] = 0.0


_STATE = (_A, _A, _A)
#: Types of the functions on the arrays of a run.
KINDS = {
    **dict.fromkeys(("read_rows", "follow_modes"), types.FunctionType(_N(_F8, CHOICE, *_STATE))),
    **dict.fromkeys(("accelerate", "probe", "choose_modes"), types.FunctionType(_N(_F8, CHOICE, *_STATE, _K, _K))),
}

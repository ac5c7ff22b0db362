"""Checks of each accepted state: measures, limits and passages near singular positions."""

from __future__ import annotations

import math

from symgen.base.ir.numerics import SKIP
from symgen.compile.loopcode.vectors import finite, largest
from symgen.compile.native.annotations import Array, Integers
from symgen.run.layout import abi
from symgen.run.layout.records import Run, Sizes, Span, State
from symgen.run.layout.scales import LEAST_SPEED

_N_PASSAGE, _MAX_PASSAGES = abi.N_PASSAGE, abi.MAX_PASSAGES

#: Least number of attempts over which progress is judged: as many as all before them.
_WINDOW = 10_000
#: The same near a singular position, which a motion passes in some tens of attempts, or where its drivers lock.
_NEAR = 200
#: A row on an angle has lost its gradient below this fraction of it.
VANISHING = 1e-2
#: An error of the energy below this fraction of kinetic and potential energy is no failure.
NEGLIGIBLE = 1e-9
#: A passage lasts while the root of the smallest pivot is below this fraction of its largest value. The energy lost or
#: gained over it shows the error of steps that are too long, or of joints that give.
PASSAGE = 0.2
#: Displacements below this fraction of the mechanism's length are 0: motions that agree may differ by so much.
NO_WAY = 1e-4


def store_rank(m: int, mask: int, pivots: int, w: Array, control: Integers) -> None:
    """Take the rank of D D^T as that before the next state, by the indices of mask and pivots in ``w``."""
    rank = masked = 0
    for i in range(m):
        if w[mask + i] > 0.0:
            masked += 1
        elif w[pivots + i] >= SKIP:
            rank += 1
    control[abi.LAST_RANK], control[abi.MASKED] = rank, masked


def remember_rank(sizes: Sizes, run: Run | State) -> None:
    """Take the rank of D D^T at the start as that before the first state."""
    store_rank(sizes.m, sizes.mask, sizes.pivots, run.w, run.control)


def iterations_in(state: State) -> int:
    """Return the number of iterations of laws, corrections and implicit stages since the start of a state."""
    return int(state.iw[abi.ITERATIONS] + state.iw[abi.LAW_ITERATIONS] + state.control[abi.NEWTON_ITERATIONS])


def begin_watch(run: Run) -> None:
    """Take the energies of the first accepted state as the beginning of the balance."""
    run.gauges[abi.ENERGY_START] = run.w[abi.KINETIC] + run.w[abi.POTENTIAL]
    run.gauges[abi.POTENTIAL_START] = run.w[abi.POTENTIAL]


def keep_maxima(sizes: Sizes, run: Run, y: Array) -> float:
    """Update the largest violations and energy error from the status of the state `y`; return the energy error."""
    w, gauges = run.w, run.gauges
    if w[abi.PHI] > gauges[abi.MAX_PHI]:
        gauges[abi.MAX_PHI] = w[abi.PHI]
    if w[abi.DRIFT] > gauges[abi.MAX_DRIFT]:
        gauges[abi.MAX_DRIFT] = w[abi.DRIFT]
    error = w[abi.KINETIC] + w[abi.POTENTIAL] - gauges[abi.ENERGY_START] - y[sizes.nq + sizes.nv]
    if abs(error) > gauges[abi.MAX_ENERGY]:
        gauges[abi.MAX_ENERGY] = abs(error)
    return float(error)


def allowed_step(h: float, gauges: Array) -> float:
    """Return the allowed step: near a singular position at most half the distance to it.

    Inside the zone that counts as near the step is free again, so a passage costs about as many further steps as
    halvings from the last regular step to the zone.
    """
    sine, fall = gauges[abi.LAST_SINE], gauges[abi.FALL]
    if fall > 0.0 and sine * sine >= gauges[abi.WARN_PIVOT] and h * fall > 0.5 * sine:
        h = 0.5 * sine / fall
    short, fall = gauges[abi.LAST_SHORT], gauges[abi.SHORT_FALL]
    if fall > 0.0 and h * fall > 0.5 * short:
        h = 0.5 * short / fall
    return h


def meets_singularity(run: Run) -> bool:
    """Return whether a step ends practically on a singular position, where rounding would decide the branch."""
    return bool(run.w[abi.PIVOT] < SKIP <= run.gauges[abi.LAST_SINE] ** 2)


def is_stuck(span: Span, run: Run, t: float) -> bool:
    """Return whether an adaptive run has taken, or at its present rate would take, too many attempts.

    The rate is taken over a window of attempts as long as all before it, so that no single passage with many attempts
    decides.
    """
    attempts, mark = run.control[abi.STEPS] + run.control[abi.REJECTED], run.control[abi.MARKED]
    if attempts - mark < (_NEAR if run.control[abi.IN_ZONE] == 1 else max(_WINDOW, mark)):
        return bool(attempts >= span.most)
    rate = (t - run.clock[abi.MARK]) / (attempts - mark)
    if mark > 0 and span.until - t > rate * (span.most - attempts):
        return True
    run.clock[abi.MARK], run.control[abi.MARKED] = t, attempts
    return False


def force_of_step(sizes: Sizes, run: Run, y: Array, before: float) -> float:
    """Return the force in a step [N]: its change of potential energy or work over the largest displacement of a body.

    What the balance lost in the step is no force: a switch at which velocities change takes no time and no way.

    Parameters
    ----------
    sizes, run, y
        As for `watch`; `run` has the state before as well.
    before : float
        Potential energy less work in the state before [J].
    """
    way = 0.0
    for i in range(sizes.nq):
        way = max(way, abs(y[i] - run.y[i]) * run.metric[i])
    after = sizes.nq + sizes.nv
    change = max(abs(run.w[abi.POTENTIAL] - y[after] - before), abs(y[after] - run.y[after]))
    return change / way if way > 0.0 else 0.0


def watch(sizes: Sizes, run: Run, y: Array, t: float) -> int:
    """Check an accepted state; return the end code of the loop, or `DONE` to continue.

    Parameters
    ----------
    sizes : Sizes
        Of the model.
    run : Run
        Its scratch holds the status from ``accept``; the speed scale follows the largest speed so far.
    y : Array
        The state.
    t : float
        Its time [s].
    """
    w, gauges, control, passages = run.w, run.gauges, run.control, run.passages
    run.clock[abi.TIME] = t
    moving, after = sizes.nq, sizes.nq + sizes.nv
    work = y[after]
    # the scale of corrections stays that of the start
    length = max(w[abi.LENGTH], largest(sizes.width, y, run.metric, 0, moving))
    fastest = largest(sizes.width, y, run.metric, moving, after)
    speed = w[abi.SPEED] = max(w[abi.SPEED], fastest)
    error = keep_maxima(sizes, run, y)
    scale = max(w[abi.KINETIC], abs(w[abi.POTENTIAL] - gauges[abi.POTENTIAL_START]), abs(work))
    if scale > gauges[abi.ENERGY_SCALE]:
        gauges[abi.ENERGY_SCALE] = scale
    before = gauges[abi.LAST_POTENTIAL]
    gauges[abi.LAST_POTENTIAL] = w[abi.POTENTIAL] - work

    pivot, rank = w[abi.PIVOT], int(w[abi.RANK])
    if pivot < gauges[abi.SMALLEST_PIVOT]:
        gauges[abi.SMALLEST_PIVOT] = pivot
    # the root of a pivot is the sine of an angle: it falls to 0 and rises again in a straight line, so a step that
    # would have met 0 has passed a singular position even if both its ends are far from it
    sine = math.sqrt(max(pivot, 0.0))
    elapsed = t - gauges[abi.LAST_TIME]
    met = gauges[abi.FALL] > 0.0 and gauges[abi.LAST_SINE] - gauges[abi.FALL] * elapsed < math.sqrt(
        gauges[abi.WARN_PIVOT]
    )
    near = pivot < gauges[abi.WARN_PIVOT] or met
    entered = gauges[abi.LAST_TIME] if met and pivot >= gauges[abi.WARN_PIVOT] else t
    gauges[abi.LARGEST_SINE] = max(gauges[abi.LARGEST_SINE], sine)
    small = PASSAGE * gauges[abi.LARGEST_SINE]
    if sine > small and not met:
        if gauges[abi.LAST_SINE] <= small or control[abi.IN_ZONE] == 1:
            gauges[abi.MAX_ENERGY_JUMP] = max(gauges[abi.MAX_ENERGY_JUMP], abs(error - gauges[abi.ENERGY_ENTRY]))
        gauges[abi.ENERGY_ENTRY] = error
    gauges[abi.FALL] = (gauges[abi.LAST_SINE] - sine) / elapsed if elapsed > 0.0 else 0.0
    # so does the length of a gradient that vanishes; after it the row is undefined
    short, fell = math.sqrt(max(w[abi.SHORTEST_ROW], 0.0)), gauges[abi.SHORT_FALL]
    vanished = short < VANISHING or (fell > 0.0 and gauges[abi.LAST_SHORT] - fell * elapsed < VANISHING)
    gauges[abi.SHORT_FALL] = (gauges[abi.LAST_SHORT] - short) / elapsed if elapsed > 0.0 else 0.0
    gauges[abi.LAST_TIME], gauges[abi.LAST_SINE], gauges[abi.LAST_SHORT] = t, sine, short
    if near or control[abi.IN_ZONE] == 1 or rank != control[abi.LAST_RANK]:
        k = control[abi.PASSAGES] - 1
        if control[abi.IN_ZONE] == 0:
            k += 1
            control[abi.PASSAGES] += 1
            if k < _MAX_PASSAGES:
                passages[k * _N_PASSAGE + abi.PASSAGE_IN] = entered
                passages[k * _N_PASSAGE + abi.PASSAGE_PIVOT] = pivot
                passages[k * _N_PASSAGE + abi.PASSAGE_RANK] = rank
        if 0 <= k < _MAX_PASSAGES:
            passages[k * _N_PASSAGE + abi.PASSAGE_OUT] = t
            passages[k * _N_PASSAGE + abi.PASSAGE_PIVOT] = min(pivot, passages[k * _N_PASSAGE + abi.PASSAGE_PIVOT])
            passages[k * _N_PASSAGE + abi.PASSAGE_RANK] = min(rank, passages[k * _N_PASSAGE + abi.PASSAGE_RANK])
        control[abi.IN_ZONE] = 1 if near else 0
        control[abi.LAST_RANK] = rank

    if not (math.isfinite(w[abi.PHI] + w[abi.DRIFT] + error) and finite(sizes.width, y)):
        return abi.NOT_FINITE
    if vanished:
        return abi.VANISHED
    if w[abi.PHI_MEASURE] > gauges[abi.LIMIT_PHI] * length:
        return abi.POSITION
    if w[abi.DRIFT_MEASURE] > gauges[abi.LIMIT_DRIFT] * speed:
        return abi.VELOCITY
    # energies are no more exact than the rounding of their terms
    limit, rounding = gauges[abi.LIMIT_ENERGY], NEGLIGIBLE * (w[abi.KINETIC] + abs(w[abi.POTENTIAL]))
    excess, way = abs(error) - rounding, NO_WAY * length
    # where nothing moves, rounding alone does work
    if fastest > LEAST_SPEED * speed and excess > limit * max(gauges[abi.ENERGY_SCALE], way * gauges[abi.FORCE]):
        # large works cancel where a body is at rest: the energy in motion is at least that over the least displacement
        gauges[abi.FORCE] = max(gauges[abi.FORCE], force_of_step(sizes, run, y, before))
        if excess > limit * max(gauges[abi.ENERGY_SCALE], way * gauges[abi.FORCE]):
            return abi.ENERGY
    return abi.DONE

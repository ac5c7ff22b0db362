"""The search for an equilibrium: Newton's method with a line search on f(q, 0) = D^T lambda, Phi(q) = 0."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from symgen.analyses.algebra import split, symmetric
from symgen.analyses.subject import Subject
from symgen.errors import AnalysisError

Array = NDArray[np.float64]

#: Steps at most, and halvings of one.
MOST_STEPS, MOST_HALVINGS = 60, 12
#: Times that a search is begun, the steps that a mechanism sinks before it is begun again, and how long these are.
ATTEMPTS, SINKING, REACH = 4, 12, 0.3
#: A step of Newton's method up to this, in lengths of the mechanism and radians, is near what it leads to.
NEAR = 0.15
#: A step as short as this balances nothing.
BLIND = 1e-9
#: Parts of the largest singular value of Newton's matrix that count as zero, and that may be what is not balanced yet.
RANK, FLAT = 1e-13, 1e-9
#: A shape whose stiffness is below this part of the largest one hardly restores anything.
LOOSE = 1e-6
#: Lengths of the mechanism by which a step downhill may open it.
OPENED = 0.05
#: Forces and violations below this fraction of what they are compared with count as zero; below this one they are
#: rounding, and no step makes them less.
TOLERANCE, EXACT = 1e-10, 1e-16


@dataclass(frozen=True)
class Balance:
    """The static problem at one position, over changes in lengths of the mechanism and radians: forces are work.

    So it is the same one in micrometres, where moments are nothing beside forces as numbers.

    Attributes
    ----------
    force : Array, shape (nv,)
        -f, and M v' where velocities are kept: what multipliers have to balance.
    rows : Array, shape (k, nv)
        D without rows that depend on others, then rows that hold coordinates.
    open : Array, shape (k,)
        By how much each of them is violated, in lengths of the mechanism or radians.
    stiffness : Array, shape (nv, nv)
        Derivative of the balance along changes of position, that of D^T lambda among it.
    motion : Array, shape (nq, nv)
        N.
    """

    force: Array
    rows: Array
    open: Array
    stiffness: Array
    motion: Array

    @property
    def scale(self) -> float:
        """The largest stiffness."""
        return float(np.abs(self.stiffness).max(initial=0.0)) or 1.0


def balance(subject: Subject, y: Array, lam: Array, held: Sequence[tuple[str, float]] = ()) -> Balance:
    """Return the static problem; `lam` holds multipliers of all rows, then of what is held [N, N m]."""
    m, kept = subject.m, ~subject.redundant
    e = subject.evaluated(y, lam=lam[:m])
    motion = e.by("motion", "v")
    d = e.by("velocities", "v")
    stiffness = e.by("balance", "q") @ motion
    rows, gaps = [d[kept]], [e.value("positions")[kept]]
    for name, value in held:
        space, at = subject.position(name)
        if space == "q":
            row, now = motion[at], float(y[at])
        else:
            row, now = e.by("functions", "q")[at] @ motion, float(e.value("functions")[at])
        rows.append(row[None, :])
        gaps.append(np.array([now - value]))
    spans, units = subject.spans, _units(subject, held)[np.append(kept, np.ones(len(held), dtype=np.bool_))]
    return Balance(
        spans * (e.value("balance") - d.T @ lam[:m]),
        np.vstack(rows) * spans / units[:, np.newaxis],
        np.concatenate(gaps) / units,
        spans[:, np.newaxis] * stiffness * spans,
        motion * spans,
    )


def _units(subject: Subject, held: Sequence[tuple[str, float]]) -> Array:
    """Return what counts as 1 of each row, and of each coordinate that is held: a length of the mechanism or 1 rad."""
    info, units = subject.compiled.info, list[str]()
    for name, _ in held:
        space, at = subject.position(name)
        units.append(info.coordinates[at].unit if space == "q" else subject.form.units[name])
    return np.append(subject.gaps, [subject.length if unit == "m" else 1.0 for unit in units])


@dataclass(frozen=True)
class Settled:
    """A position where all forces balance.

    Attributes
    ----------
    subject : Subject
        The mechanism, with angles that count turns as they were followed there.
    y : Array
        The state.
    lam : Array
        Multipliers of all rows, then of what is held.
    steps : int
        Steps taken.
    """

    subject: Subject
    y: Array
    lam: Array
    steps: int


def settle(subject: Subject, y: Array, held: Sequence[tuple[str, float]] = ()) -> Settled:
    """Return a position where all forces balance.

    Where that gets nowhere it is tried again behind some steps downhill, whatever becomes of the balance; then Newton's
    method alone, from both.

    Parameters
    ----------
    subject : Subject
        The mechanism.
    y : Array
        A state; its velocities are kept.
    held : sequence of (str, float)
        Coordinates that are held at a value by a force of their own, whose multiplier stands last.

    Raises
    ------
    AnalysisError
        If none is found.
    """
    lower: tuple[Subject, Array] | None = None
    for attempt in range(ATTEMPTS):
        sinking, again = attempt < 2, attempt % 2 == 1
        if again and lower is None:
            lower = _sunk(subject, y, held)
        begun, place = (subject, y) if lower is None or not again else lower
        try:
            found = _search(begun, place, held, sinking)
        except AnalysisError:
            if attempt == ATTEMPTS - 1:
                raise
        else:
            return replace(found, steps=found.steps + SINKING * again)
    raise AssertionError("the last attempt returns or raises")


def _sunk(subject: Subject, y: Array, held: Sequence[tuple[str, float]]) -> tuple[Subject, Array]:
    """Return where a few bounded steps downhill lead that also close what is open."""
    lam = np.zeros(subject.m + len(held))
    for _ in range(SINKING):
        now = balance(subject, y, lam, held)
        change, multipliers = _downhill(now)
        lam = _all_rows(subject, multipliers, held)
        longest = (np.abs(now.motion @ change) / subject.lengths).max(initial=0.0)
        y = subject.moved(y, now.motion @ (min(1.0, REACH / max(longest, 1e-300)) * change))
        subject = subject.wound(y)
    return subject, y


def _all_rows(subject: Subject, work: Array, held: Sequence[tuple[str, float]]) -> Array:
    """Return multipliers of all rows from the work of those that are kept; what is held stands last."""
    kept = np.flatnonzero(~subject.redundant)
    whole = np.zeros(subject.m + len(held))
    whole[kept] = work[: len(kept)]
    whole[subject.m :] = work[len(kept) :]
    return np.asarray(whole / _units(subject, held))


def _search(subject: Subject, y: Array, held: Sequence[tuple[str, float]], sinking: bool) -> Settled:
    now = balance(subject, y, np.zeros(subject.m + len(held)), held)
    lam = np.asarray(np.linalg.lstsq(now.rows.T, -now.force, rcond=1e-12)[0], dtype=np.float64)
    now = balance(subject, y, _all_rows(subject, lam, held), held)
    left, step, error, size, before = np.inf, 0, np.inf, np.zeros(subject.nv), (y, lam)
    for step in range(MOST_STEPS):
        # and where joints and forces carry nothing, what each would change by over a thousandth of the mechanism
        stiff = 1e-3 * np.abs(now.stiffness).sum(axis=1)
        size = np.maximum(size, np.maximum(np.abs(now.force).max(initial=1e-300), stiff))
        error = _error(now, lam, size)
        good = error < TOLERANCE
        if good and (error >= 0.5 * left or error <= EXACT):
            # a step that balances no more may lead anywhere
            y, lam = before if error >= left else (y, lam)
            return Settled(subject, y, _all_rows(subject, lam, held), step)
        left, before = error if good else np.inf, (y, lam)
        found = _stepped(subject, y, lam, now, held, size, good, sinking)
        if found is None and good:
            return Settled(subject, y, _all_rows(subject, lam, held), step)
        if found is None:
            break
        y, lam, now = found
        subject = subject.wound(y)
    raise AnalysisError(
        f"no equilibrium was found from this start: after {step} steps {error:.3g} of the forces is not balanced; "
        "another start may lead to one"
    )


def _stepped(
    subject: Subject,
    y: Array,
    lam: Array,
    now: Balance,
    held: Sequence[tuple[str, float]],
    size: Array,
    good: bool,
    sinking: bool,
) -> tuple[Array, Array, Balance] | None:
    """Return what a step leads to: as long a one as makes forces, or the next step of Newton's method, smaller.

    Where forces are `good` only whole steps of Newton's method are tried, for the last digits.
    """
    if good:
        return _refined(subject, y, lam, now, held, size)
    matrix = _inverse(now)
    if matrix is None:
        return None
    error, natural = _error(now, lam, size), np.linalg.norm(_correction(now, lam, matrix))
    far, steps = _steps(subject, now, lam, matrix)
    if not sinking:
        far, steps = False, sorted(steps, key=lambda step: step is not steps[far])
    for way, (change, multipliers) in enumerate(steps):
        longest = (np.abs(now.motion @ change) / subject.lengths).max(initial=0.0)
        part = min(1.0, 1.0 / longest) if longest > 0.0 else 1.0
        for _ in range(MOST_HALVINGS):
            tried = subject.moved(y, now.motion @ (part * change))
            new = lam + part * (multipliers - lam)
            then = balance(subject, tried, _all_rows(subject, new, held), held)
            if _error(then, new, size) < error * (1.0 - 1e-3 * part):
                return tried, new, then
            if np.linalg.norm(_correction(then, new, matrix)) < natural * (1.0 - 0.25 * part):
                return tried, new, then
            if far and way == 0 and _sinks(change, now, then, multipliers):
                return tried, new, then
            part *= 0.5
    return None


def _refined(
    subject: Subject, y: Array, lam: Array, now: Balance, held: Sequence[tuple[str, float]], size: Array
) -> tuple[Array, Array, Balance] | None:
    """Return what the better one of two whole steps leads to: with all stiffnesses, or without the smallest ones.

    Along a way on which nothing changes the stiffness is what forces are not yet balanced by, and a step anything.
    """
    best, least = None, _error(now, lam, size) * (1.0 - 1e-3)
    for rank in (RANK, FLAT):
        matrix = _inverse(now, rank)
        if matrix is None:
            return None
        change, new = _newton(now, lam, matrix)
        tried = subject.moved(y, now.motion @ change)
        then = balance(subject, tried, _all_rows(subject, new, held), held)
        error = _error(then, new, size)
        if error < least:
            best, least = (tried, new, then), error
    return best


def _error(now: Balance, lam: Array, size: Array) -> float:
    with np.errstate(over="ignore"):  # far away forces may be so large that their squares are not finite
        unbalanced = np.linalg.norm((now.force + now.rows.T @ lam) / size)
    return float(np.hypot(unbalanced, np.linalg.norm(now.open)))


def _sinks(change: Array, now: Balance, then: Balance, multipliers: Array) -> bool:
    """Whether a step downhill has not gone far beyond the lowest point of its way, and opens little."""
    before = float(change @ (now.force + now.rows.T @ multipliers))
    after = float(change @ (then.force + then.rows.T @ multipliers))
    opened = np.linalg.norm(then.open) <= max(OPENED, float(np.linalg.norm(now.open)))
    return bool(before < 0.0 and after <= 0.5 * abs(before) and opened)


def _steps(subject: Subject, now: Balance, lam: Array, matrix: Array) -> tuple[bool, list[tuple[Array, Array]]]:
    """Return whether the equilibrium is far, Newton's step and one downhill, that first which is to be tried first.

    Newton's method finds equilibria of any kind. That is what is wanted near one; from further away it is left to
    chance which, so that the mechanism sinks.
    """
    newton, downhill = _newton(now, lam, matrix), _downhill(now)
    longest = float((np.abs(now.motion @ newton[0]) / subject.lengths).max(initial=0.0))
    # forces that no step would balance: where the stiffness vanishes along them, as that of a level pendulum does
    blind = longest < BLIND and np.linalg.norm(now.force + now.rows.T @ newton[1]) > TOLERANCE * np.linalg.norm(
        now.force
    )
    far = bool(longest >= NEAR or blind)
    return far, [downhill, newton] if far else [newton, downhill]


def _inverse(now: Balance, rank: float = RANK) -> Array | None:
    """Return the pseudo-inverse of Newton's matrix, forces over the largest stiffness; None where it is not finite."""
    k, scale = len(now.open), now.scale
    matrix = np.block([[now.stiffness / scale, now.rows.T], [now.rows, np.zeros((k, k))]])
    return np.linalg.pinv(matrix, rcond=rank) if np.all(np.isfinite(matrix)) else None


def _correction(now: Balance, lam: Array, matrix: Array) -> Array:
    """Return what a matrix of Newton's makes of what is not balanced: a measure that does not know units of forces."""
    right = np.concatenate([(now.force + now.rows.T @ lam) / now.scale, now.open])
    found: Array = matrix @ right if np.all(np.isfinite(right)) else np.full(len(right), np.inf)
    return found


def _newton(now: Balance, lam: Array, matrix: Array) -> tuple[Array, Array]:
    """Return the step of Newton's method, the shortest one where the matrix is singular, and the new multipliers."""
    n = len(now.force)
    found = -_correction(now, lam, matrix)
    return found[:n], lam + found[n:] * now.scale


def _downhill(now: Balance) -> tuple[Array, Array]:
    """Return a step that lowers the energy also where the stiffness is negative: its modes count by their size.

    What is pulled while nothing restores it falls by a length of the mechanism or a radian: what its own stiffness, or
    one above rounding beside a stiff spring, would make of it tells its weight in some unit, and no distance.
    """
    basis, inverse, _ = split(now.rows)
    closing = -inverse @ now.open
    values, vectors = np.linalg.eigh(symmetric(basis.T @ now.stiffness @ basis))
    slope = vectors.T @ basis.T @ (now.force + now.stiffness @ closing)
    own, least = np.abs(values), LOOSE * np.abs(values).max(initial=0.0)
    falls = np.abs(slope) * np.abs(basis @ vectors).max(axis=0, initial=0.0)
    pulled = (own <= least) & (np.abs(slope) > TOLERANCE * np.linalg.norm(now.force))
    sizes = np.where(pulled, np.minimum(least or np.inf, np.maximum(own, falls)), np.maximum(own, least))
    sizes[sizes == 0.0] = 1.0
    change = closing - basis @ (vectors @ (slope / sizes))
    multipliers = -inverse.T @ (now.force + now.stiffness @ change)
    return change, multipliers

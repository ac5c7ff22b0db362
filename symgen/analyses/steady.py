"""Motions that stay what they are: at rest, or steady in what is looked at.

A linear system with constant matrices exists about a state where what is looked at, the states, does not change, and
where the rates of the states depend on nothing else. Turning wheels, a heading, a distance travelled may change
meanwhile: they are cyclic. Both is asked at the state and again a little later on the motion.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from symgen.analyses.algebra import ROUNDED, split
from symgen.analyses.reduced import StateQuantity, StateTangent, quantities_of, tangent
from symgen.analyses.subject import RATE, Subject
from symgen.errors import AnalysisError, InputError
from symgen.ir.program import COUNTERS
from symgen.runtime.probe import rate_function

Array = NDArray[np.float64]

#: Rates below this fraction of the motion's own count as none.
STILL = 1e-7
#: How far one quantity may follow from others, as a fraction of it.
CLOSED = 1e-8
#: Rates that change by less than this part of the largest change of any are compared with that part of it: a wheel by
#: itself has none but rounding.
LEAST_CHANGE = 1e-6
#: The same later on, where the motion was followed by steps: their error is in it.
LATER = 1e-4
#: Radians, or lengths of the mechanism, between the instants at which is asked again.
APART = 0.7
#: A motion is followed for so many radians of its fastest eigenvalue at most.
FARTHEST = 1e4


def at_rest(subject: Subject, x: StateTangent) -> bool:
    """Whether nothing moves at a state, nor begins to, nor is driven.

    What moves is compared with what the forces on it could do in its own place: what joints carry there and what
    springs would exert a length of the mechanism, or a radian, away.
    """
    e, spans = x.base, subject.spans
    if any(np.any(e.by(group, "t")) for group in ("balance", "velocities", "positions")):
        return False
    carried = np.abs(subject.rows(e)).T @ np.abs(x.lam) + np.abs(e.by("balance", "q") @ e.by("motion", "v")) @ spans
    heavy = np.diag(e.by("balance", "a")) * spans
    found = heavy > 0.0  # what has no mass follows
    quick = carried[found] / heavy[found]
    limit = STILL * quick + ROUNDED * quick.max(initial=0.0)
    v, a = np.abs(x.speeds / spans)[found], np.abs(x.a / spans)[found]
    return bool(np.all(a <= limit) and np.all(v**2 <= STILL * limit))


def pace(x: StateTangent) -> float:
    """Return by how many lengths of the mechanism, or radians, a motion goes on in a second, or would from rest."""
    v, a = (np.abs(z / x.subject.spans).max(initial=0.0) for z in (x.speeds, x.a))
    return float(max(v, np.sqrt(a)))


def extents(x: StateTangent, quantities: Sequence[StateQuantity]) -> Array:
    """Return by how much quantities change where everything moves by a length, or a radian, or as fast as it does."""
    going = np.repeat([1.0, pace(x)], [x.positions, x.velocities])
    found = np.array([np.abs(q.changes[: x.size] * going).max(initial=0.0) for q in quantities])
    return np.where(found > 0.0, found, 1.0)


def still(x: StateTangent, quantity: StateQuantity) -> bool:
    """Whether a quantity does not change in a motion."""
    return bool(abs(quantity.rate) <= STILL * pace(x) * extents(x, [quantity])[0])


def rates_of(subject: Subject, name: str) -> str | None:
    """Return what the rate of a coordinate is called, None where it has no name or the quantity is a velocity."""
    info = subject.compiled.info
    names = [q.name for q in info.coordinates]
    if name in names:
        velocity = _velocity_of(subject, names.index(name))
        if velocity is not None:
            return velocity
    if name in subject.form.functions and subject.form.functions[name][1] == 3:
        return name + RATE
    return None


def _velocity_of(subject: Subject, at: int) -> str | None:
    """Return the velocity that a coordinate's rate is, None where it is a combination of several."""
    entries, _, columns = subject.form.entries("motion", "v")
    rows = subject.form.pattern[entries, 0] - subject.form.places["motion"][0]
    found = columns[rows == at]
    spinning = any(first <= at < first + 4 for first, _ in subject.compiled.info.spins)
    return subject.compiled.info.velocities[int(found[0])].name if len(found) == 1 and not spinning else None


def with_rates(subject: Subject, names: Sequence[str]) -> tuple[str, ...]:
    """Return states with the rates of coordinates among them that are not named themselves behind them.

    Raises
    ------
    InputError
        If a name means nothing.
    """
    known = quantities_of(subject)
    own = {q.name for q in subject.compiled.info.coordinates}
    # those of bodies have names of their own where a tree carries these; Euler parameters have none
    speeds = {
        f"{b.name}.{c}": f"{b.name}.{s}"
        for b in subject.mechanism.bodies
        for c, s in zip(b.coordinates[:3], b.speeds, strict=False)
    }
    found = list(dict.fromkeys(names))
    for name in tuple(found):
        if name in own or (name in subject.form.functions and subject.form.functions[name][1] == 3):
            rate = rates_of(subject, name)
            other = name + RATE
            if rate is None:
                expected = "a state whose rate has a name: a coordinate of a body or joint, or an output"
                raise InputError(f"state '{name}'", expected, "one of several that turn a body together")
            if rate not in found and speeds.get(name) not in found and not (other in found and other in known):
                found.append(other if other in known and name not in own else rate)
    return tuple(found)


def chosen(subject: Subject, x: StateTangent) -> tuple[str, ...]:
    """Return names of states that determine all others, coordinates before velocities."""
    info = subject.compiled.info
    turning = {first + k for first, _ in info.spins for k in range(4)}
    candidates: dict[str, float] = {}
    for i, q in enumerate(info.coordinates):
        candidates[q.name] = 0.2 if i in turning else 1.0 / subject.length if q.unit == "m" else 1.0
    joints = {name: unit for name, unit in subject.form.units.items() if subject.form.functions[name][1] == 3}
    for name, unit in joints.items():
        if name not in {o.name for o in subject.mechanism.outputs}:
            candidates[name] = 0.9 / subject.length if unit == "m" else 0.9
    positions = _independent(x, candidates, x.positions, slice(0, x.positions))
    rates = [rates_of(subject, name) for name in positions]
    if x.positions == x.velocities and None not in rates:
        return (*positions, *(r for r in rates if r is not None))
    known = {v.name: 1.0 / subject.length if v.unit == "m/s" else 1.0 for v in info.velocities}
    known |= {name + RATE: weight for name, weight in candidates.items() if name in joints}
    return (*positions, *_independent(x, known, x.velocities, slice(x.positions, x.size)))


def _independent(x: StateTangent, weights: dict[str, float], count: int, columns: slice) -> list[str]:
    from scipy import linalg

    if not count:
        return []
    names = list(weights)
    rows = np.array([x.quantity(name).changes[columns] * weights[name] for name in names])
    order = linalg.qr(rows.T, mode="r", pivoting=True)[1]
    return [names[i] for i in sorted(order[:count])]


def system(x: StateTangent, names: Sequence[str]) -> tuple[Array, Array, Array, Array]:
    """Return A and B of named states, what of their rates depends on something else, and that something's size.

    Returns
    -------
    a, b : Array
        x' = A x + B u.
    rest : Array, shape (n, size)
        What of the states' rates does not follow from the states.
    sizes : Array, shape (n,)
        What it is compared with.
    """
    found, n, sizes = [x.quantity(name) for name in names], x.size, x.sizes_of(names)[:, np.newaxis]
    width = n + len(x.inputs)
    states = np.array([q.changes for q in found]).reshape(len(found), width) / sizes
    rates = np.array([q.rate_changes for q in found]).reshape(len(found), width) / sizes
    alike = x.sizes  # of s and u, as `sizes` of states: digits are lost by neither
    a = np.linalg.lstsq((states[:, :n] * alike).T, (rates[:, :n] * alike).T, rcond=1e-11)[0].T
    rest = (rates[:, :n] - a @ states[:, :n]) * alike
    size = max(np.abs(rates[:, :n] * alike).max(initial=1e-300), LEAST_CHANGE * np.abs(x.matrix).max(initial=0.0))
    b = sizes * (rates[:, n:] - a @ states[:, n:])
    return sizes * a / sizes.T, b, rest, np.full(len(a), size)


def found_states(subject: Subject, x: StateTangent, soon: StateTangent) -> tuple[str, ...]:
    """Return the named quantities that do not change and whose rates follow from each other: the steady ones.

    What is at an end of its swing does not change at the state either, so that it is looked at `soon` as well.
    """
    turning = {q.name for i, q in enumerate(subject.compiled.info.coordinates) if _of_spin(subject, i)}
    names = [n for n in quantities_of(subject) if n not in turning]
    names = [n for n in names if still(x, x.quantity(n)) and still(soon, soon.quantity(n))]
    while names:
        _, _, rest, sizes = system(x, names)
        follows = np.abs(rest).max(axis=1, initial=0.0) <= CLOSED * sizes
        kept = [name for name, one in zip(names, follows, strict=True) if one]
        if kept == names:
            break
        names = kept
    independent = list[str]()
    basis = np.zeros((0, x.size))
    for name in names:
        row = x.quantity(name).changes[: x.size] * x.sizes / x.sizes_of([name])
        left = row - basis.T @ (basis @ row)
        size = float(np.linalg.norm(row))
        if size > 1e-12 and float(np.linalg.norm(left)) > 1e-7 * size:
            basis = np.vstack([basis, left / np.linalg.norm(left)])
            independent.append(name)
    return tuple(independent)


def _of_spin(subject: Subject, at: int) -> bool:
    return any(first <= at < first + 4 for first, _ in subject.compiled.info.spins)


def check_steady(
    subject: Subject, x: StateTangent, names: Sequence[str], where: str, soon: StateTangent | None = None
) -> None:
    """Refuse a motion in which states change, or depend on what is no state.

    `soon` is what is `after` the state, where that is known.

    Raises
    ------
    InputError
        If it is not steady; says which state changes, or what is missing among the states.
    """
    resting = at_rest(subject, x)
    if not resting:
        _check_still(x, names, where)
    a, _, rest, sizes = system(x, names)
    worst = np.abs(rest).max(axis=1, initial=0.0) / sizes
    if worst.max(initial=0.0) > CLOSED:
        name = names[int(worst.argmax())]
        others = [n for n in quantities_of(subject) if n not in names]
        gains = {n: _explains(x, rest[int(worst.argmax())], n) for n in others}
        also = max(gains, key=lambda n: gains[n]) if gains else ""
        raise InputError(
            where,
            "states whose rates follow from them",
            f"'{name}', whose rate depends on others",
            f"'{also}' is one of them",
        )
    if resting:
        return
    then, found = x, [x.quantity(name) for name in names]
    large = extents(x, found)
    alike = large / large[:, np.newaxis]
    for k in range(2):
        then = soon if k == 0 and soon is not None else after(subject, then)
        t, b = then.t, system(then, names)[0]
        if not np.abs((b - a) * alike).max(initial=0.0) <= LATER * (pace(x) + np.abs(a * alike).max(initial=0.0)):
            expected = "a steady motion, about which everything that is looked at stays as it is"
            raise InputError(where, expected, f"one whose linear system is another at t = {t:.4g} s")
        for before, size in zip(found, large, strict=True):
            if not abs(then.quantity(before.name).value - before.value) <= LATER * (size + abs(before.value)):
                raise InputError(where, "a steady motion", f"one in which '{before.name}' changes until t = {t:.4g} s")


def _explains(x: StateTangent, row: Array, name: str) -> float:
    own = x.quantity(name).changes[: x.size] * x.sizes
    size = np.linalg.norm(own)
    return float(abs(own @ row) / size) if size > 0.0 else 0.0


def _check_still(x: StateTangent, names: Sequence[str], where: str) -> None:
    moving = [q for name in names if not still(x, q := x.quantity(name))]
    if moving:
        worst = moving[int(np.argmax(np.abs([q.rate for q in moving]) / extents(x, moving)))]
        expected = "a state of rest, or of a motion in which no state changes"
        hint = "ask for an equilibrium, or name the states that stay as they are"
        raise InputError(where, expected, f"one where '{worst.name}' changes at a rate of {worst.rate:.4g}", hint)


def after(subject: Subject, x: StateTangent) -> StateTangent:
    """Return how everything changes a little later on the motion: followed by steps, and projected behind them."""
    from scipy.integrate import solve_ivp

    nq, nv, y = subject.nq, subject.nv, x.y
    kept = ~subject.redundant
    rates, w = rate_function(subject.compiled), subject.w.copy()
    iw, whole = np.zeros(len(COUNTERS), dtype=np.int64), np.zeros_like(y)

    def slope(t: float, z: Array) -> Array:
        rates(float(t), _filled(y, z), subject.p, w, iw, whole)
        return whole[: nq + nv].copy()

    fastest = np.abs(np.linalg.eigvals(x.matrix)).max(initial=0.0)
    speed = max(pace(x), APART * fastest / FARTHEST)
    end = x.t + APART / speed
    large: Any = np.append(subject.lengths, speed * subject.spans)  # SciPy's types do not know arrays of tolerances
    run = solve_ivp(slope, (x.t, end), y[: nq + nv], "Radau", rtol=1e-8, atol=1e-10 * large)
    if not run.success:
        raise AnalysisError(f"the motion cannot be followed beyond t = {run.t[-1]:.4g} s: {run.message}")
    z = run.y[:, -1]
    y = subject.moved(_filled(y, z), np.zeros(nq))
    for _ in range(4):
        e = subject.evaluated(y, t=end)
        inverse = split(subject.rows(e) * kept[:, None])[1]
        y = subject.moved(y, -e.by("motion", "v") @ (inverse @ (e.value("positions") * kept)))
    e = subject.evaluated(y, t=end)
    y[nq : nq + nv] -= split(subject.rows(e) * kept[:, None])[1] @ (e.value("velocities") * kept)
    return tangent(subject, y, end)


def _filled(y: Array, z: Array) -> Array:
    found = y.copy()
    found[: len(z)] = z
    return found

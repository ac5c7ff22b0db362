"""Motions at rest or steady in their states, and the choice of these states.

A linear system with constant matrices exists about a state where the states do not change, and where their rates
depend on nothing else. Turning wheels, a heading, a distance travelled may change meanwhile: they are cyclic. Both is
checked at the state and again a little later on the motion.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from symgen.analyses.rest.settle import TOLERANCE
from symgen.analyses.state.algebra import ROUNDED, null_space_split, numerical_rank
from symgen.analyses.state.reduced import StateQuantity, StateTangent, places_of_quantities, tangent_system
from symgen.analyses.state.subject import RATE, Subject
from symgen.base.errors import AnalysisError, InputError
from symgen.base.ir.program import COUNTERS
from symgen.run.layout.model_arrays import velocity_of_coordinate
from symgen.run.layout.probe import rate_function

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
#: Radians, or lengths of the mechanism, between the instants of the checks.
APART = 0.7
#: A motion is followed for so many radians of its fastest eigenvalue at most, and by so many evaluations.
FARTHEST, MOST_EVALUATIONS = 1e4, 20_000


def at_rest(subject: Subject, x: StateTangent) -> bool:
    """Whether nothing moves at a state, nor begins to, nor is driven.

    What moves is compared with what the forces on it could do in its own place: what joints carry there, what springs
    would exert a length of the mechanism, or a radian, away, and the rounding of what acts. Forces that depend on time
    count as they are at the instant.
    """
    e, spans = x.base, subject.spans
    if any(np.any(e.by(group, "t")) for group in ("velocities", "positions")):
        return False
    rows = subject.rows(e)
    carried = np.abs(rows).T @ np.abs(x.lam) + np.abs(e.by("balance", "q") @ e.by("motion", "v")) @ spans
    heavy = np.diag(e.by("balance", "a")) * spans
    rates = np.abs(e.value("states"))
    if np.any(rates > STILL * np.abs(e.by("states", "z")) @ subject.extents(x.y)):
        return False
    massive = heavy > 0.0  # what has no mass follows
    quick = carried[massive] / heavy[massive]
    # at a singular position, forces along directions that rows leave free balance only to the accuracy of a search
    rounding = TOLERANCE if subject.lost_rank(rows) > 0 else ROUNDED
    limit = STILL * quick + rounding * quick.max(initial=0.0) + ROUNDED * subject.acting(e)[massive] / heavy[massive]
    v, a = np.abs(x.speeds / spans)[massive], np.abs(x.a / spans)[massive]
    return bool(np.all(a <= limit) and np.all(v**2 <= STILL * limit))


def pace_of_motion(x: StateTangent) -> float:
    """Return by how many lengths of the mechanism, or radians, a motion goes on in a second, or would from rest."""
    v, a = (np.abs(z / x.subject.spans).max(initial=0.0) for z in (x.speeds, x.a))
    return float(max(v, np.sqrt(a)))


def extents_of_quantities(x: StateTangent, quantities: Sequence[StateQuantity]) -> Array:
    """Return by how much quantities change where everything moves by a length, or a radian, or as fast as it does."""
    going = np.append(np.repeat([1.0, pace_of_motion(x)], [x.positions, x.velocities]), x.subject.extents(x.y))
    sizes = np.array([np.abs(q.changes[: x.size] * going).max(initial=0.0) for q in quantities])
    return np.where(sizes > 0.0, sizes, 1.0)


def is_steady(x: StateTangent, name: str) -> bool:
    """Whether a quantity does not change in a motion."""
    quantity = x.quantity(name)
    return bool(abs(quantity.rate) <= STILL * pace_of_motion(x) * extents_of_quantities(x, [quantity])[0])


def named_states(
    subject: Subject, x: StateTangent, states: Sequence[str], instantaneous: bool, where: str
) -> tuple[str, ...]:
    """Return the names of the states of a linear system, which are checked to make one.

    Parameters
    ----------
    subject, x : Subject, StateTangent
        The mechanism and its changes near the state.
    states : sequence of str
        Requested states; by default independent quantities that determine all others at rest, and in a motion those
        that stay as they are.
    instantaneous : bool
        Whether a motion that is not steady has the system of the instant.
    where : str
        What the states are for, in messages.

    Raises
    ------
    InputError
        If a name is not valid, or the motion is not steady.
    """
    if not x.size and not states:
        return ()
    resting, soon = at_rest(subject, x), None
    if states:
        requested = tuple(dict.fromkeys(states))
        # a determining set needs no more rates, also with Euler parameters, whose rates have no names
        names = requested if _rank_of_states(x, requested) == x.size else _add_rates(subject, states)
        if _rank_of_states(x, names) < len(names):
            raise InputError("states", "states that do not depend on each other", ", ".join(names))
    elif resting or instantaneous:
        names = _determining_states(subject, x)
    else:
        soon = _follow_briefly(subject, x)
        names = _steady_quantities(subject, x, soon)
        speeds = x.changes_of_quantities(names)[:, x.positions : x.positions + x.velocities]
        if numerical_rank(speeds) < x.velocities:  # some of them changes
            _check_steady(subject, x, _determining_states(subject, x), where)
            expected = "a steady motion, or states that are named"
            raise InputError(where, expected, "one in which not all velocities stay as they are")
    if not instantaneous:
        _check_steady(subject, x, names, where, soon)
    return names


def _rank_of_states(x: StateTangent, names: Sequence[str]) -> int:
    """Return the number of independent states among some."""
    rows = x.changes_of_quantities(names)[:, : x.size] * x.sizes / x.sizes_of_quantities(names)[:, np.newaxis]
    return numerical_rank(rows, 1e-9 * np.abs(rows).max(initial=1e-300))


def _name_of_rate(subject: Subject, name: str) -> str | None:
    """Return the name of the rate of a coordinate, None where it has no name or the quantity is a velocity."""
    info = subject.compiled.info
    names = [q.name for q in info.coordinates]
    if name in names and names.index(name) not in subject.spun:
        return info.velocities[velocity_of_coordinate(names.index(name), info)].name
    return name + RATE if _of_second_order(subject, name) else None


def _of_second_order(subject: Subject, name: str) -> bool:
    """Whether a quantity is one of positions, so that its rate is a state as well."""
    states = {x.name for x in subject.mechanism.states}
    return name not in states and subject.form.functions.get(name, (0, 0))[1] == 3


def _add_rates(subject: Subject, names: Sequence[str]) -> tuple[str, ...]:
    """Return states, then the rates of those coordinates among them whose rates are not named.

    Raises
    ------
    InputError
        If a name is not valid.
    """
    quantities = places_of_quantities(subject)
    own = {q.name for q in subject.compiled.info.coordinates}
    # those of bodies have names of their own where a tree carries these; Euler parameters have none
    speeds = {
        f"{b.name}.{c}": f"{b.name}.{s}"
        for b in subject.mechanism.bodies
        for c, s in zip(b.coordinates[:3], b.speeds, strict=False)
    }
    states = list(dict.fromkeys(names))
    for name in tuple(states):
        if name in own or _of_second_order(subject, name):
            rate, other = _name_of_rate(subject, name), name + RATE
            if rate is None:
                expected = "a state whose rate has a name: a coordinate of a body or joint, or an output"
                raise InputError(f"state '{name}'", expected, "one of several that turn a body together")
            if rate not in states and speeds.get(name) not in states and not (other in states and other in quantities):
                states.append(other if other in quantities and name not in own else rate)
    return tuple(states)


def _determining_states(subject: Subject, x: StateTangent) -> tuple[str, ...]:
    """Return names of states that determine all others, coordinates before velocities."""
    info, functions = subject.compiled.info, subject.form.functions
    weights: dict[str, float] = {}
    for i, q in enumerate(info.coordinates):
        weights[q.name] = 0.2 if i in subject.spun else 1.0 / subject.length if q.unit == "m" else 1.0
    joints = {name: unit for name, unit in subject.form.units.items() if functions[name][1] == 3}
    states = tuple(x.name for x in subject.mechanism.states)
    outputs = {*(o.name for o in subject.mechanism.outputs), *states}
    weights |= {n: 0.9 / subject.length if unit == "m" else 0.9 for n, unit in joints.items() if n not in outputs}
    positions = _independent_states(x, weights, x.positions, slice(0, x.positions))
    rates = [_name_of_rate(subject, name) for name in positions]
    if x.positions == x.velocities and None not in rates:
        return (*positions, *(r for r in rates if r is not None), *states)
    speeds = {v.name: 1.0 / subject.length if v.unit == "m/s" else 1.0 for v in info.velocities}
    speeds |= {name + RATE: weight for name, weight in weights.items() if name in joints}
    columns = slice(x.positions, x.positions + x.velocities)
    return (*positions, *_independent_states(x, speeds, x.velocities, columns), *states)


def _independent_states(x: StateTangent, weights: dict[str, float], count: int, columns: slice) -> list[str]:
    from scipy import linalg

    if not count:
        return []
    names = list(weights)
    rows = x.changes_of_quantities(names)[:, columns] * np.array(list(weights.values()))[:, np.newaxis]
    order = linalg.qr(rows.T, mode="r", pivoting=True)[1]
    return [names[i] for i in sorted(order[:count])]


def system_of_states(x: StateTangent, names: Sequence[str]) -> tuple[Array, Array, Array, float]:
    """Return A and B of named states, what of their rates depends on something else, and that something's size.

    Returns
    -------
    a, b : Array
        x' = A x + B u.
    rest : Array, shape (n, size)
        What of the states' rates does not follow from the states.
    size : float
        Scale of `rest`.
    """
    n, sizes = x.size, x.sizes_of_quantities(names)[:, np.newaxis]
    states, rates = x.changes_of_quantities(names) / sizes, x.changes_of_quantities(names, rates=True) / sizes
    alike = x.sizes  # of s and u, as `sizes` of states: digits are lost by neither
    a = np.linalg.lstsq((states[:, :n] * alike).T, (rates[:, :n] * alike).T, rcond=1e-11)[0].T
    rest = (rates[:, :n] - a @ states[:, :n]) * alike
    size = max(np.abs(rates[:, :n] * alike).max(initial=1e-300), LEAST_CHANGE * np.abs(x.matrix).max(initial=0.0))
    b = sizes * (rates[:, n:] - a @ states[:, n:])
    return sizes * a / sizes.T, b, rest, size


def _steady_quantities(subject: Subject, x: StateTangent, soon: StateTangent) -> tuple[str, ...]:
    """Return the named quantities that do not change and whose rates follow from each other: the steady ones.

    What is at an end of its swing does not change at the state either, so that `soon` counts as well.
    """
    turning = {q.name for i, q in enumerate(subject.compiled.info.coordinates) if i in subject.spun}
    names = [n for n in places_of_quantities(subject) if n not in turning and is_steady(x, n) and is_steady(soon, n)]
    while names:
        _, _, rest, size = system_of_states(x, names)
        follows = np.abs(rest).max(axis=1, initial=0.0) <= CLOSED * size
        if follows.all():
            break
        names = [name for name, one in zip(names, follows, strict=True) if one]
    independent, basis = list[str](), np.zeros((0, x.size))
    for name in names:
        row = x.quantity(name).changes[: x.size] * x.sizes / x.sizes_of_quantities([name])
        left = row - basis.T @ (basis @ row)
        size = float(np.linalg.norm(row))
        if size > 1e-12 and float(np.linalg.norm(left)) > 1e-7 * size:
            basis = np.vstack([basis, left / np.linalg.norm(left)])
            independent.append(name)
    return tuple(independent)


def _check_steady(
    subject: Subject, x: StateTangent, names: Sequence[str], where: str, soon: StateTangent | None = None
) -> None:
    """Refuse a motion in which states change, or depend on what is no state; `soon` is it a little later.

    Raises
    ------
    InputError
        If it is not steady, with the state that changes, or with what is missing among the states.
    """
    resting, quantities = at_rest(subject, x), [x.quantity(name) for name in names]
    large = extents_of_quantities(x, quantities)
    rates = np.abs([q.rate for q in quantities]) / large
    if not resting and rates.max(initial=0.0) > STILL * pace_of_motion(x):
        worst = quantities[int(rates.argmax())]
        expected = "a state of rest, or of a motion in which no state changes"
        hint = "ask for an equilibrium, or name the states that stay as they are"
        raise InputError(where, expected, f"one where '{worst.name}' changes at a rate of {worst.rate:.4g}", hint)
    a, _, rest, size = system_of_states(x, names)
    rests = np.abs(rest).max(axis=1, initial=0.0)
    if rests.max(initial=0.0) > CLOSED * size:
        row = rest[int(rests.argmax())]

        def share_of_quantity(name: str) -> float:
            own = x.quantity(name).changes[: x.size] * x.sizes
            return float(abs(own @ row) / (np.linalg.norm(own) or 1.0))

        also = max(
            (name for name in places_of_quantities(subject) if name not in names), key=share_of_quantity, default=""
        )
        got = f"'{names[int(rests.argmax())]}', whose rate depends on others"
        raise InputError(where, "states whose rates follow from them", got, f"'{also}' is one of them")
    then, alike = x, large / large[:, np.newaxis]
    for k in range(0 if resting else 2):
        then = soon if k == 0 and soon is not None else _follow_briefly(subject, then)
        t, b = then.t, system_of_states(then, names)[0]
        if not np.abs((b - a) * alike).max(initial=0.0) <= LATER * (
            pace_of_motion(x) + np.abs(a * alike).max(initial=0.0)
        ):
            expected = "a steady motion, along which no state changes"
            raise InputError(where, expected, f"one whose linear system differs at t = {t:.4g} s")
        for before, extent in zip(quantities, large, strict=True):
            if not abs(then.quantity(before.name).value - before.value) <= LATER * (extent + abs(before.value)):
                raise InputError(where, "a steady motion", f"one in which '{before.name}' changes until t = {t:.4g} s")


def _follow_briefly(subject: Subject, x: StateTangent) -> StateTangent:
    """Follow the motion for a few steps, project the state after each, and return how everything changes there."""
    from scipy.integrate import solve_ivp

    nq, size, y, w = subject.nq, subject.nq + subject.nv, x.y.copy(), subject.w.copy()
    own = subject.compiled.info.own_states
    followed = [*range(size), *range(own.start, own.stop)]
    active, left = ~subject.redundant, MOST_EVALUATIONS
    rates, iw, whole = rate_function(subject.compiled), np.zeros(len(COUNTERS), dtype=np.int64), np.zeros_like(y)

    def slope_of_states(t: float, z: Array) -> Array:
        nonlocal left
        left -= 1
        if left < 0:
            raise AnalysisError(
                f"whether the motion is steady is not known at t = {t:.4g} s, after {MOST_EVALUATIONS} evaluations; "
                "ask for the system of the instant (instantaneous)"
            )
        y[followed] = z
        rates(float(t), y, subject.p, w, iw, whole)
        return np.asarray(whole[followed])

    fastest = np.abs(np.linalg.eigvals(x.matrix)).max(initial=0.0)
    speed = max(pace_of_motion(x), APART * fastest / FARTHEST)
    end = x.t + APART / speed
    large: Any = np.concatenate(
        [subject.lengths, speed * subject.spans, subject.extents(x.y)]
    )  # SciPy's types lack arrays of tolerances
    run = solve_ivp(slope_of_states, (x.t, end), x.y[followed], "Radau", rtol=1e-8, atol=1e-10 * large)
    if not run.success:
        raise AnalysisError(f"the motion cannot be followed beyond t = {run.t[-1]:.4g} s: {run.message}")
    y[followed] = run.y[:, -1]
    y = subject.move_state(y, np.zeros(nq))
    for _ in range(4):
        e = subject.evaluate(y, t=end)
        inverse = null_space_split(subject.rows(e) * active[:, None])[1]
        y = subject.move_state(y, -e.by("motion", "v") @ (inverse @ (e.value("positions") * active)))
    e = subject.evaluate(y, t=end)
    y[nq:size] -= null_space_split(subject.rows(e) * active[:, None])[1] @ (e.value("velocities") * active)
    return tangent_system(subject, y, end)

"""Starts: whole turns of angles, positions closed by shortest Newton steps, velocities completed."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from benchmarks.plain.moving import Array
from benchmarks.plain.system import CUTOFF, System, scaled


@dataclass(frozen=True)
class Start:
    """A state that satisfies the constraints.

    Attributes
    ----------
    q, v : Array
        Coordinates and velocities.
    moved : float
        The largest change of a coordinate that closing took.
    determined : bool
        Whether the file alone says q and v: positions closed as described, velocities fixed by the given ones.
    """

    q: Array
    v: Array
    moved: float
    determined: bool


class CannotClose(Exception):
    """Positions or velocities that satisfy the constraints were not found."""


def choose_turns(system: System, t: float, q: Array) -> None:
    """Set the angles in space to the whole turns with which rows are nearest to closed.

    Rows that leave one angle open come first, among them those on which a turn does most; a row that leaves several is
    closed by the one that closes it best.
    """
    system.turns = {}
    system.follow(system.at(t, q, np.zeros(system.nv)))
    angles = list(system.turns)

    def residual() -> Array:
        return system.constraints(system.at(t, q, np.zeros(system.nv))).phi

    rest = residual()
    effects = np.zeros((len(rest), len(angles)))
    for k, turn in enumerate(angles):
        system.turns[turn] += 2.0 * np.pi
        effects[:, k] = residual() - rest
        system.turns[turn] -= 2.0 * np.pi
    effects[np.abs(effects) < 1e-9] = 0.0
    free, open_rows = set(range(len(angles))), {i for i in range(len(rest)) if effects[i].any()}
    while open_rows:
        row = min(open_rows, key=lambda i: (sum(effects[i, k] != 0.0 for k in free), -np.abs(effects[i]).max(), i))
        open_rows.remove(row)
        best = min(
            (k for k in free if effects[row, k] != 0.0),
            key=lambda k: abs(rest[row] + np.round(-rest[row] / effects[row, k]) * effects[row, k]),
            default=None,
        )
        if best is None:
            continue
        free.remove(best)
        count = np.round(-rest[row] / effects[row, best])
        rest = rest + count * effects[:, best]
        system.turns[angles[best]] += 2.0 * np.pi * count


def levers(system: System, t: float, q: Array) -> tuple[Array, float]:
    """Return by what velocities are divided to be speeds of points, inverted, and the mechanism's length.

    Angles are compared with lengths by the length of a body: twice how its angles move the rows in metres of the joint
    that holds it farthest from its centre of mass, at least a hundredth of the longest body's. Translations have 1.
    """
    d = system.constraints(system.at(t, q, np.zeros(system.nv))).d
    angular = np.zeros(system.nv, dtype=bool)
    first_row, lengths = 0, {name: 0.0 for name in system.bodies}
    places = list[float]()
    for body in system.bodies.values():
        dimension = 3 if system.document.spatial else 2
        angular[body.first_v + dimension : body.first_v + len(body.speeds)] = True
        places.append(float(np.abs(q[body.first_q : body.first_q + dimension]).max()))
    for joint in system.joints:
        rows = d[first_row : first_row + len(joint.rows)]
        rows = rows[rows[:, ~angular].any(axis=1)]
        for name, body in system.bodies.items():
            own = np.arange(body.first_v, body.first_v + len(body.speeds))
            lengths[name] = max(lengths[name], 2.0 * float(np.linalg.norm(rows[:, own[angular[own]]])))
        first_row += len(joint.rows)
    extent = max(places, default=0.0)
    longest = max(lengths.values(), default=0.0) or extent or 1.0
    result = np.ones(system.nv)
    for name, body in system.bodies.items():
        own = np.arange(body.first_v, body.first_v + len(body.speeds))
        result[own[angular[own]]] = 1.0 / max(lengths[name] or longest, 1e-2 * longest)
    return result, max(longest, extent)


def closed(system: System, t: float, q: Array, iterations: int = 60) -> Array:
    """Return closed positions near q, by Newton steps that are shortest where angles count by the lengths of bodies.

    No step is longer than 1 rad, or than the mechanism.

    Raises
    ------
    CannotClose
        If the residual does not fall to rounding.
    """
    q, rest = q.copy(), np.zeros(system.nv)
    floor = 2e-14 * max(1.0, float(np.abs(q).max())) * max(1, len(system.rows))
    best, stalled = np.inf, 0
    scale, length = levers(system, t, q)
    for _ in range(iterations):
        state = system.at(t, q, rest)
        c = system.constraints(state)
        size = float(np.linalg.norm(c.phi))
        if not np.isfinite(size) or stalled > 10:
            break
        stalled, best = (stalled + 1 if size > 0.5 * best else 0), min(best, size)
        if size == 0.0 or (size <= floor and stalled):
            return q
        step = scale * np.linalg.lstsq(c.d * scale, -c.phi, rcond=1e-7)[0] if len(c.d) else rest
        system.follow(state)
        sizes = np.where(scale == 1.0, np.abs(step) / length, np.abs(step))
        q = system.moved(q, step / max(1.0, float(sizes.max(initial=0.0))))
    raise CannotClose(f"positions stay open by {best:.3g}")


def projected(system: System, t: float, q: Array, v: Array, rank: int) -> tuple[Array, Array]:
    """Return the state after two shortest steps back to the constraints, in positions and in velocities."""
    for _ in range(2):
        c = system.constraints(system.at(t, q, v))
        if not len(c.d):
            return q, v
        q = system.moved(q, -_pinv(c.d, rank) @ c.phi)
    c = system.constraints(system.at(t, q, v))
    return q, v - _pinv(c.d, rank) @ (c.d @ v - c.nu)


def _pinv(d: Array, rank: int) -> Array:
    rows, lengths = scaled(d)
    u, sizes, vt = np.linalg.svd(rows, full_matrices=False)
    return np.asarray(vt[:rank].T @ ((u[:, :rank].T / lengths) / sizes[:rank, np.newaxis]))


def start(system: System, t: float = 0.0) -> Start:
    """Return the start that a file describes.

    Raises
    ------
    CannotClose
        If there is none near it.
    """
    described = np.concatenate([body.start for body in system.bodies.values()])
    velocities = [x for body in system.bodies.values() for x in body.velocities]
    choose_turns(system, t, described)
    q = closed(system, t, described)
    system.follow(system.at(t, q, np.zeros(system.nv)))
    c = system.constraints(system.at(t, q, np.zeros(system.nv)))
    fixed = np.array([x is not None for x in velocities], dtype=bool)
    v = np.array([0.0 if x is None else x for x in velocities])
    unique = bool(fixed.all()) or not (v.any() or c.nu.any())
    if len(c.d):
        free, scale = c.d[:, ~fixed], levers(system, t, described)[0][~fixed]
        v[~fixed] += scale * np.linalg.lstsq(free * scale, c.nu - c.d @ v, rcond=1e-7)[0]
        unique = unique or system.rank(free) == int((~fixed).sum())
        largest = max(1.0, float(np.abs(v).max()))
        if np.linalg.norm(c.d @ v - c.nu) > 1e-9 * largest:  # contradicted: projected in the metric of the masses
            unique = False
            weight = np.linalg.inv(system.mass + 1e-12 * np.eye(system.nv) * np.diag(system.mass).max())
            v = v + weight @ c.d.T @ np.linalg.lstsq(c.d @ weight @ c.d.T, c.nu - c.d @ v, rcond=CUTOFF**2)[0]
            if np.linalg.norm(c.d @ v - c.nu) > 1e-8 * largest:
                raise CannotClose("no velocities satisfy the constraints")
    moved = float(np.abs(q - described).max(initial=0.0))
    return Start(q, v, moved, unique and moved < 1e-9)

"""Consistent starts: positions closed by minimum-norm Newton, velocities completed by least squares."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from symgen.errors import AssemblyError, InputError
from symgen.runtime.abi import N_COUNTERS
from symgen.runtime.large import SparseRows, is_large, minimum_norm_step, tangent_direction
from symgen.runtime.probe import call_measure, call_rhs
from symgen.runtime.turns import choose_turns, follow_angles
from symgen.store.modules import interpreted

if TYPE_CHECKING:
    from symgen.model import CompiledModel

Array = NDArray[np.float64]

#: A pivot of D D^T (rows scaled) below this belongs to a dependent row; as in the emitted code.
SKIP = 1e-12
#: Singular values of D with scaled rows below this count as zero when the start is judged: the root of SKIP.
RANK_CUTOFF = 1e-6
_ITERATIONS = 60


@dataclass(frozen=True)
class Start:
    """A consistent start.

    Attributes
    ----------
    y : Array, shape (ny,)
        State q, v and work 0.
    p, w : Array
        Parameters and scratch, prepared: scales and the mask of redundant rows are set.
    rank : int
        Rank of D at the start.
    redundant_rows : tuple of str
        Rows that depend on others at the start.
    notes : tuple of str
        What was changed to make the start consistent, one sentence each.
    """

    y: Array
    p: Array
    w: Array
    rank: int
    redundant_rows: tuple[str, ...]
    notes: tuple[str, ...]


def assemble(
    compiled: CompiledModel, q: Array, v: Sequence[float | None], p: Array, t0: float = 0.0, strict: bool = False
) -> Start:
    """Close the mechanism from an approximate start.

    Positions: ``dv = -D^+ Phi``, ``q <- q + N dv`` with the Moore-Penrose inverse until ``|Phi|`` is at rounding.
    Velocities: the given ones are kept and the others are the smallest that satisfy ``D v = nu``; where the given ones
    contradict the constraints, all are projected in the metric of the mass matrix.

    Parameters
    ----------
    compiled : CompiledModel
        Model and method.
    q : Array, shape (nq,)
        Approximate coordinates.
    v : sequence of float or None, length nv
        Given velocities; None where they are to be completed.
    p : Array
        Parameters, not yet prepared.
    t0 : float
        Time of the start [s].
    strict : bool
        Refuse a start that is not consistent instead of projecting it.

    Raises
    ------
    AssemblyError
        If the mechanism stays open; says at which joint and by how much.
    InputError
        If `strict` and the start had to be changed.
    """
    info = compiled.info
    w = compiled.scratch()
    not_finite = "parameters", "values for which every formula is finite", "one that divides by 0 or overflows"
    try:
        # interpreted functions warn or raise where compiled ones give inf or nan
        with np.errstate(all="ignore"):
            for function in (compiled.model.prepare, compiled.law_module.prepare):
                interpreted(function)(p)
            interpreted(compiled.model.masses)(p, w)
    except (ArithmeticError, ValueError):
        raise InputError(*not_finite) from None
    masses = compiled.section(w, "mass").copy()
    masses[list(info.massless)] = 1.0  # described as massless; a mass that became 0 is another matter
    if not np.all(masses > 0.0):
        name = info.velocities[int(np.argmin(masses))].name.split(".")[0]
        raise InputError(f"parameters: mass or inertia of {name}", "a value above 0", f"{float(masses.min()):g}")
    if not np.all(np.isfinite(p)):
        raise InputError(*not_finite)
    y = np.zeros(info.ny)
    y[: info.nq] = q
    notes: list[str] = []

    choose_turns(compiled, t0, y, p, w)
    moved = _close(compiled, t0, y, p, w)
    if moved > 1e-9 * max(1.0, float(np.abs(q).max(initial=0.0))):
        notes.append(f"initial positions were closed by minimum-norm Newton, moving a coordinate by up to {moved:.3g}")
    large = is_large(compiled)
    d = None if large else compiled.jacobian(w)
    changed = _complete_velocities(compiled, y, v, d, p, w)
    if changed:
        notes.append(changed)
    if notes and strict:
        raise InputError("initial state", "a consistent start (--strict)", f"{notes[0]}")

    lasting = _lasting(compiled, t0, y, p, w)
    compiled.section(w, "mask")[lasting] = np.inf
    redundant = tuple(info.rows[i].name for i in np.flatnonzero(lasting))
    status = compiled.section(w, "status")
    status[6] = max(1.0, float(np.abs(y[: info.nq]).max(initial=0.0)))
    status[7] = max(1.0, float(np.abs(y[info.nq : -1]).max(initial=0.0)))
    rank = int(np.sum(compiled.section(w, "pivot") >= SKIP)) if d is None else _rank(d)
    return Start(y, p, w, rank, redundant, tuple(notes))


def _lasting(compiled: CompiledModel, t0: float, y: Array, p: Array, w: Array) -> NDArray[np.bool_]:
    """Return which rows depend on others at the start and at closed positions near it: not only at a singular one."""
    nq = compiled.info.nq
    lasting = np.asarray(compiled.section(w, "pivot") < SKIP)
    if not lasting.any():
        return lasting
    large, free = is_large(compiled), np.zeros((0, 0))
    if not large:
        _, sizes, rows = np.linalg.svd(_scaled(compiled.jacobian(w)))
        free = rows[int(np.sum(sizes > RANK_CUTOFF)) :]
    for k in range(3 if large or len(free) else 0):
        if large:
            direction = tangent_direction(compiled, p, w.copy(), k)
        else:
            direction = np.cos((k + 1.0) * np.arange(1, len(free) + 1)) @ free
        probe, probed = y.copy(), w.copy()
        size = 0.03 * max(1.0, float(np.abs(y[:nq]).max()))
        compiled.move(probe, size * direction / np.abs(direction).max(), probed)
        follow_angles(compiled, t0, probe, p, probed)
        try:
            _close(compiled, t0, probe, p, probed)
        except AssemblyError:
            continue
        lasting = lasting & (compiled.section(probed, "pivot") < SKIP)
    return lasting


def _scaled(d: Array) -> Array:
    norms = np.linalg.norm(d, axis=1, keepdims=True)
    return np.asarray(d / np.where(norms > 0.0, norms, 1.0))


def _rank(d: Array) -> int:
    if d.size == 0:
        return 0
    return int(np.sum(np.linalg.svd(_scaled(d), compute_uv=False) > RANK_CUTOFF))


def _close(compiled: CompiledModel, t0: float, y: Array, p: Array, w: Array) -> float:
    """Close positions in place; return by how much a coordinate moved."""
    info = compiled.info
    first = y[: info.nq].copy()
    phi = compiled.section(w, "residual")
    best, stalled = np.inf, 0
    for _ in range(_ITERATIONS):
        call_measure(compiled.model.geometry, t0, y, p, w)
        size = float(np.linalg.norm(phi))
        if not np.isfinite(size):
            break
        floor = 1e-15 * max(1.0, float(np.abs(y).max())) * max(1, info.m)
        stalled = stalled + 1 if size > 0.5 * best else 0
        best = min(best, size)
        if size <= floor or (stalled >= 3 and size < 1e-9 * max(1.0, float(np.abs(y).max()))):
            return float(np.abs(y[: info.nq] - first).max(initial=0.0))
        if stalled >= 15:
            break
        step = _newton_step(compiled, p, w, phi)
        # far from closed, a full Newton step can turn bodies by several radians
        compiled.move(y, step * min(1.0, 1.0 / max(float(np.abs(step).max(initial=0.0)), 1e-300)), w)
        follow_angles(compiled, t0, y, p, w)
    open_by: dict[str, float] = {}
    for row, residual in zip(info.rows, phi, strict=True):
        open_by[row.joint] = float(np.hypot(open_by.get(row.joint, 0.0), residual))
    worst = max(open_by, key=lambda joint: open_by[joint] if np.isfinite(open_by[joint]) else np.inf)
    raise AssemblyError(stays_open(info.name, worst, open_by[worst]))


def stays_open(mechanism: str, joint: str, size: float) -> str:
    """Return the sentence for positions that cannot be closed."""
    return (
        f"{mechanism}: the mechanism cannot be assembled from this start: joint '{joint}' stays open by "
        f"{size:.3g} m or rad; check its points and the positions of the bodies it joins"
    )


def no_velocities(mechanism: str) -> str:
    """Return the sentence for velocities that cannot be completed."""
    return f"{mechanism}: no velocities satisfy the constraints; drivers or conditions contradict each other"


def _newton_step(compiled: CompiledModel, p: Array, w: Array, phi: Array) -> Array:
    """Return -D^+ Phi."""
    if is_large(compiled):
        return minimum_norm_step(compiled, p, w, phi)
    return np.asarray(np.linalg.lstsq(compiled.jacobian(w), -phi, rcond=RANK_CUTOFF)[0])


def _complete_velocities(
    compiled: CompiledModel, y: Array, v: Sequence[float | None], d: Array | None, p: Array, w: Array
) -> str:
    """Set the velocities in place; return a sentence if given ones had to be changed."""
    info = compiled.info
    velocity = y[info.nq : info.nq + info.nv]
    given = np.array([x is not None for x in v], dtype=bool)
    velocity[:] = [0.0 if x is None else x for x in v]
    nu = compiled.section(w, "nu")
    if info.m == 0:
        return ""
    sparse = SparseRows(compiled, w) if d is None else None

    def rest() -> Array:
        if sparse is not None:
            return np.asarray(nu - sparse.times(velocity))
        assert d is not None, "either form of D is there"
        return np.asarray(nu - d @ velocity)

    def smallest(residual: Array, scale: Array) -> Array:
        """Return the change with D change = residual whose change / scale is smallest."""
        if sparse is not None:
            return sparse.least_norm(residual, scale)
        used = scale > 0.0
        change = np.zeros(info.nv)
        assert d is not None, "either form of D is there"
        change[used] = scale[used] * np.linalg.lstsq(d[:, used] * scale[used], residual, rcond=RANK_CUTOFF)[0]
        return change

    residual = rest()
    scale = max(1.0, float(np.abs(velocity).max()))
    if not given.all():
        velocity += smallest(residual, np.where(given, 0.0, 1.0))
        residual = rest()
    if np.linalg.norm(residual) <= 1e-9 * scale:
        # what is left is rounding: take it out without touching the given values noticeably
        if sparse is None:
            velocity += smallest(residual, np.ones(info.nv))
        else:
            velocity += minimum_norm_step(compiled, p, w, -residual)
        return ""
    before = velocity.copy()
    for _ in range(2):
        # massless bodies give way first
        masses = compiled.section(w, "mass")
        velocity += smallest(rest(), 1.0 / np.sqrt(np.maximum(masses, 1e-12 * masses.max())))
    if np.linalg.norm(rest()) > 1e-8 * scale:
        raise AssemblyError(no_velocities(info.name))
    k = int(np.argmax(np.abs(velocity - before)))
    name = info.velocities[k]
    return (
        f"initial velocities contradicted the constraints and were projected in the metric of the mass matrix; "
        f"{name.name} changed from {before[k]:.6g} to {velocity[k]:.6g} {name.unit}"
    )


def has_light_bodies(compiled: CompiledModel, start: Start) -> bool:
    """Whether a pivot of S is suspiciously small at the start although D D^T finds no row dependent.

    Parameters
    ----------
    compiled : CompiledModel
        A method that eliminates v'.
    start : Start
        Its consistent start; not changed.
    """
    if not hasattr(compiled.law_module, "confirm"):
        return False
    y, w, iw = start.y.copy(), start.w.copy(), np.zeros(N_COUNTERS, dtype=np.int64)
    if call_rhs(compiled.law_module.rhs, 0.0, y, start.p, w, iw, np.zeros_like(y)) == 0:
        return False
    call_measure(compiled.model.geometry, 0.0, y, start.p, w)
    return bool(np.all(compiled.section(w, "pivot")[compiled.section(w, "mask") == 0.0] >= SKIP))

"""The consistent start of a single run: positions closed by shortest changes, velocities completed by least squares.

`symgen.run.starts.assembler` calls the start that sweeps share; this module adds the reports of single runs.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from symgen.base.errors import AssemblyError
from symgen.run.layout import abi
from symgen.run.layout import ensemble_abi as e
from symgen.run.layout.model_arrays import marks_of_lengths
from symgen.run.starts import decisions
from symgen.run.starts.assembler import Assembly
from symgen.run.starts.held import Held
from symgen.run.starts.joint_starts import joint_values
from symgen.run.starts.start_words import (
    StartChange,
    changes_of,
    notes_of,
    start_refusal,
    warnings_of,
    without_derivative,
)

if TYPE_CHECKING:
    from symgen.run.layout.compiled import CompiledModel, ModelInfo
    from symgen.run.starts.masses import Masses

Array = NDArray[np.float64]
#: Reported coordinates, from described and closed ones: names, differences, and units.
Moved = Callable[[Array, Array], Iterable[tuple[str, float, str]]]
#: `Assembly.close`, or the same with memory that is kept.
Closing = Callable[[Array, Array, Array], tuple[Array, Array]]


@dataclass(frozen=True, repr=False)
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
        Rows that depend on others at the start and near it.
    notes : tuple of str
        Changes that made the start consistent, one sentence each.
    changes : tuple of StartChange
        The same as data, positions before velocities.
    light : bool
        Whether a pivot of S is suspiciously small although D D^T finds no row dependent; False where unexamined.
    warnings : tuple of str
        Changes so large that another motion may have been meant.
    t : float
        Time at which the run begins [s].
    work : float
        Work done before the run [J], not included in `y`.
    saved : mapping of str to Array, optional
        Saved arrays of another run that this run continues.
    datum : tuple of float
        What coordinates are measured from (`symgen.describe.facts.lengths.origin_of_sizes`); empty for the origin.
    """

    y: Array
    p: Array
    w: Array
    rank: int
    redundant_rows: tuple[str, ...]
    notes: tuple[str, ...]
    changes: tuple[StartChange, ...] = ()
    light: bool = False
    warnings: tuple[str, ...] = ()
    t: float = 0.0
    work: float = 0.0
    saved: Mapping[str, NDArray[Any]] | None = None
    datum: tuple[float, ...] = ()

    def __repr__(self) -> str:
        warnings = f", {len(self.warnings)} warnings" if self.warnings else ""
        return f"<Start at {self.t:g} s: {len(self.y)} numbers of the state, rank {self.rank}{warnings}>"


def state_scales(compiled: CompiledModel, w: Array, until: float) -> Array:
    """Return the scales of coordinates and velocities that a run sets at its beginning.

    Parameters
    ----------
    compiled, w : CompiledModel, Array
        Model and method, and the scratch after a start.
    until : float
        End of the run [s].

    Returns
    -------
    Array, shape (nq + nv,)
        The mechanism's length for lengths, 1 for angles and numbers, its speed, and that over a body's length.
    """
    length = float(w[abi.LENGTH])
    speed = max(float(w[abi.SPEED]), length / until)
    positions = np.where(marks_of_lengths(compiled.info) == 1.0, length, 1.0)
    return np.concatenate([positions, speed * np.sqrt(compiled.section(w, "gauge"))])


def assemble(
    compiled: CompiledModel,
    q: Array,
    v: Sequence[float | None],
    p: Array,
    strict: bool = False,
    held: Held | None = None,
    ask_light: bool = False,
    moved: Moved | None = None,
    instant: tuple[float, Sequence[float]] = (0.0, ()),
    datum: Sequence[float] = (),
    masses: Masses | None = None,
) -> Start:
    """Return the consistent start of a single run.

    Positions: ``dv = -D^+ Phi``, ``q <- q + N dv`` with the Moore-Penrose inverse until ``|Phi|`` is at rounding.
    Velocities: the specified ones are kept and the others are the smallest that satisfy ``D v = nu``; if the specified
    ones contradict the constraints, all are projected in the metric of the mass matrix.

    Parameters
    ----------
    compiled : CompiledModel
        Model and method.
    q : Array, shape (nq,)
        Approximate coordinates.
    v : sequence of float or None, length nv
        Specified velocities; None for those to be completed.
    p : Array
        Parameters, not yet prepared.
    strict : bool
        Refuse a start that is not consistent instead of changing it.
    held : Held, optional
        Coordinates and velocities held at set values.
    ask_light : bool
        Whether to report bodies that are too light for the law's solver.
    moved : callable, optional
        Reported coordinates, from described and closed ones: names, differences, and units.
    instant : tuple of float and sequence of float, optional
        Time of the start [s], and the angles that count turns if their branches are set.
    datum : sequence of float, optional
        What coordinates are measured from (`symgen.describe.facts.lengths.origin_of_sizes`).
    masses : Masses, optional
        What is off the diagonal of M.

    Raises
    ------
    AssemblyError
        If the mechanism stays open, or a row has no derivative at the described start; names the joint.
    InputError
        If `strict` and the start had to be changed; if a mass is not positive, a formula is not finite, or nothing
        determines the accelerations of a massless body.
    """
    assembly = Assembly(compiled, held or Held(), strict, ask_light, *instant, datum, masses)
    return closed_start(assembly, assembly.held, assembly.close, q, v, p, moved)


def closed_start(
    assembly: Assembly,
    held: Held,
    close: Closing,
    q: Array,
    v: Sequence[float | None],
    p: Array,
    moved: Moved | None = None,
    states: Sequence[float] = (),
) -> Start:
    """Close a start, and return it with its reports.

    Parameters
    ----------
    assembly : Assembly
        The start.
    held : Held
        Quantities held: those of `assembly` with their present values.
    close : Closing
        Closes a state in place.
    q, v, p, moved
        As for `assemble`.
    states : sequence of float
        States of the file, which rows may read; 0 unless given.

    Raises
    ------
    AssemblyError, InputError
        As `assemble`.
    """
    compiled = assembly.compiled
    info, velocities = compiled.info, np.array([np.nan if x is None else x for x in v], dtype=np.float64)
    y, w, summary = closed_state(compiled, held, close, q, velocities, p, states)
    velocities[list(held.velocities)] = list(held.velocities.values())
    changes = changes_of(info, np.concatenate([q, velocities]), y, state_scales(compiled, w, math.inf))
    return Start(
        *(y, p, w, compiled.rank(w), compiled.redundant(w)),
        notes=notes_of(held, summary, changes, info),
        changes=changes,
        light=bool(summary[e.LIGHT]),
        warnings=far_moved_warning(assembly, held, q, y, p, w, changes, moved),
        t=assembly.t,
        datum=tuple(assembly.datum),
    )


def closed_state(
    compiled: CompiledModel,
    held: Held,
    close: Closing,
    q: Array,
    velocities: Array,
    p: Array,
    states: Sequence[float] = (),
) -> tuple[Array, Array, Array]:
    """Close a start without reports; return its state, scratch and summary.

    Parameters
    ----------
    compiled : CompiledModel
        Model and method.
    held, close, q, p, states
        As for `closed_start`.
    velocities : Array, shape (nv,)
        Specified velocities, nan for the others.

    Raises
    ------
    AssemblyError, InputError
        As `assemble`.
    """
    info, y = compiled.info, described_state(compiled.info, q, states)
    w, summary = close(y, velocities, p)
    if summary[e.START] != e.ASSEMBLED:
        error = without_derivative(compiled, q, p) or start_refusal(summary, info, held)
        reached = y[: info.nq] if np.all(np.isfinite(y[: info.nq])) else q
        raise error.with_coordinates(reached.tolist()) if isinstance(error, AssemblyError) else error
    return y, w, summary


def far_moved_warning(
    start: Assembly,
    held: Held,
    q: Array,
    y: Array,
    p: Array,
    w: Array,
    changes: Sequence[StartChange],
    moved: Moved | None = None,
) -> tuple[str, ...]:
    """Return a warning if closing moved bodies far, unless a held quantity is far from its described value.

    Parameters
    ----------
    start : Assembly
        The start that closed them.
    held : Held
        Quantities held, with their values.
    q, y : Array
        Coordinates as described, and the consistent state.
    p, w : Array
        Parameters, and the scratch after closing.
    changes : sequence of StartChange
        Changed coordinates and velocities.
    moved : callable, optional
        As for `assemble`.
    """
    info, length = start.compiled.info, float(w[abi.LENGTH])
    if not changes:
        return ()
    values = joint_values(start.compiled, start.t, described_state(info, q), p, w.copy()) if held.joints else q
    distances = [(info.coordinates[i].unit, x - q[i]) for i, x in held.coordinates.items()]
    distances += [(info.joint_coordinates[k].unit, x - values[2 * k]) for k, x in held.joints.items()]
    limits = {"m": decisions.FAR * length, "rad": decisions.FAR_TURNED}
    if any(not abs(distance) <= limits[unit] for unit, distance in distances):
        return ()  # other positions have to follow
    return warnings_of(changes, info, length, moved(q, y[: info.nq]) if moved else ())


def described_state(info: ModelInfo, q: Array, states: Sequence[float] = ()) -> Array:
    """Return a state at rest with these coordinates and states of the file."""
    y = np.concatenate([q, np.zeros(info.ny - info.nq)])
    if len(states):
        y[info.own_states] = states
    return y

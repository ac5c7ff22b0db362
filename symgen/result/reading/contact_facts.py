"""Closed contacts at the start of a run: which depend on each other, whose forces are not unique, and what may jam.

The mobilities G of gaps (N) and of slips (T) are what unit forces accelerate through all joints. A sliding contact has
a finite force where its jamming number ``G_NN - s mu G_NT`` is above 0, with s = 1 forwards and -1 backwards.
"""

from __future__ import annotations

import contextlib
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from symgen.compile.loopcode.exact import compiled_form
from symgen.describe.bounds.bounded_modes import mode_events
from symgen.describe.bounds.contact_rows import ContactGap
from symgen.run.compiling.events import bounded_rows, effects_of_events
from symgen.run.effects.applying import apply_effects
from symgen.run.layout import abi
from symgen.run.layout.start_records import Instant
from symgen.run.modes.bounded_rows import DEPENDENT
from symgen.run.modes.contact_parts import COUPLED
from symgen.run.modes.row_records import TOUCHING

if TYPE_CHECKING:
    from symgen.run.planning.prepare import Prepared

Array = NDArray[np.float64]


def contact_facts(run: Prepared) -> dict[str, dict[str, Any]]:
    """Return by the names of contacts whether they are closed at the start, and of those that are more.

    Returns
    -------
    dict of str to dict
        ``closed``; of closed ones ``part``, the contacts that depend on each other, ``unique`` of their forces, and
        ``jamming``, the jamming numbers for s = 1 and -1 [1/kg], where one row acts along the gap; two have a
        number for each direction.
    """
    gaps = [row for row in run.mechanism.bounded if isinstance(row, ContactGap)]
    if not gaps:
        return {}
    compiled, start = run.compiled, run.start
    bounded = bounded_rows(run.mechanism, compiled)
    assert bounded is not None, "contacts are rows with bounds"
    numbers = bounded.state(start.t, start.y, start.p, start.w.copy(), np.zeros_like(start.y))
    k, dry = len(bounded.names), bounded.dry
    places = {row.row: i for i, row in enumerate(run.mechanism.bounded)}
    closed = [g for g in gaps if numbers[places[g.row]] <= TOUCHING * (start.w[abi.LENGTH] or 1.0)]
    facts: dict[str, dict[str, Any]] = {gap.name: {"closed": gap in closed} for gap in gaps}
    if not closed:
        return facts
    bounds = [0.0 if g.tangent is None else float(numbers[2 * k + dry + places[g.tangent.row]]) for g in closed]
    rows, owners = (
        _rows_of(run, closed),
        [i for i, g in enumerate(closed) for _ in range(_rows_of_contact(g))],
    )
    for i, gap in enumerate(closed):
        at = owners.index(i)
        own: dict[str, Any] = {"jamming": None}
        if gap.tangent is not None and not gap.tangent.paired:
            own["jamming"] = [float(rows[at, at] - s * bounds[i] * rows[at, at + 1]) for s in (1.0, -1.0)]
        facts[gap.name] |= own
    for part in _parts_of(rows, owners):
        lines = [j for j, i in enumerate(owners) if i in part and (bounds[i] > 0.0 or j == owners.index(i))]
        values = np.linalg.eigvalsh(rows[np.ix_(lines, lines)])
        unique = bool(values[0] > DEPENDENT * values[-1])
        for i in part:
            facts[closed[i].name] |= {"part": [closed[j].name for j in part], "unique": unique}
    return facts


def _rows_of_contact(gap: ContactGap) -> int:
    return 1 if gap.tangent is None else 1 + len(gap.tangent.rows)


def _rows_of(run: Prepared, closed: list[ContactGap]) -> Array:
    """Return G of the gaps of contacts, each followed by its slip."""
    compiled, start = run.compiled, run.start
    effects = effects_of_events(run.mechanism, compiled, events := mode_events(run.mechanism))
    assert effects is not None, "contacts have impacts"
    names = [event.name for event in events]
    chosen = effects.chosen([names.index(f"{gap.name}.hit") for gap in closed])
    work, info = effects.memory(len(start.y), len(start.w)), compiled.info
    with contextlib.suppress(ArithmeticError, ValueError), np.errstate(all="ignore"):
        # for rows and masses of the problem of an impact
        compiled_form(apply_effects)(
            effects.model, start.t, Instant(start.y.copy(), start.p, start.w.copy()), chosen, work
        )
    n, m, count = info.nv, info.m, sum(map(_rows_of_contact, closed))
    rows, mass = work.impulse.rows[: (m + count) * n].reshape(-1, n), work.impulse.mass.reshape(n, n)
    joints = rows[[i for i in range(m) if i not in info.bounded]]
    own = rows[m:]
    moved = np.linalg.solve(mass, np.concatenate([joints, own]).T)
    held, free = moved[:, : len(joints)], moved[:, len(joints) :]
    taken = np.linalg.pinv(joints @ held, rcond=DEPENDENT) @ (joints @ free) if len(joints) else joints @ free
    return np.asarray(own @ (free - held @ taken))


def _parts_of(rows: Array, owners: list[int]) -> list[list[int]]:
    """Return the connected parts of contacts."""
    count = max(owners) + 1
    size = np.sqrt(np.abs(np.outer(np.diag(rows), np.diag(rows))))
    tied = np.eye(count, dtype=bool)
    for a, b in np.argwhere(np.abs(rows) > COUPLED * size):
        tied[owners[a], owners[b]] = True
    part_of = np.arange(count)
    for _ in range(count):  # each takes the least number of those that it is tied to
        part_of = np.where(tied, part_of, count).min(axis=1)
    return [np.flatnonzero(part_of == part).tolist() for part in np.unique(part_of)]

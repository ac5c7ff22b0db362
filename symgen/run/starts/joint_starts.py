"""Joint coordinates held by starts: rows of Phi and D after the model's rows.

A joint coordinate is no coordinate of the state: holding it is another constraint at the start. The emitted ``observe``
gives its value and its rate, and as rates are linear in the velocities, also its row of D.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from symgen.compile.loopcode.exact import copy_numbers, exact
from symgen.compile.native.annotations import Integers, Record
from symgen.run.layout import abi
from symgen.run.layout.probe import Ready
from symgen.run.layout.start_records import Instant, Layout, Work

if TYPE_CHECKING:
    from symgen.run.layout.compiled import CompiledModel, ModelInfo

Array = NDArray[np.float64]


def joint_values(compiled: CompiledModel, t: float, y: Array, p: Array, w: Array) -> Array:
    """Return value and rate of every joint coordinate, alternating, shape (2 n,).

    Parameters
    ----------
    compiled : CompiledModel
        The model.
    t, y, p, w
        Arguments of emitted functions; the section of angles that count turns fixes their turns.
    """
    info = compiled.info
    out = np.zeros(info.observed)
    Ready(compiled.model.observe, abi.OBSERVE)(t, y, p, w, np.zeros_like(y), out)
    return out[info.m :]


class Joints(Record):
    """The joint coordinates held by starts of a model.

    Attributes
    ----------
    values, rates : Layout
        Layouts of the model with further rows of held joint coordinates, and of held rates.
    held : Array of int64
        The joint coordinates with rows of `values`, then the ones with rows of `rates`.
    goals, origins : Array
        Intermediate goals of the rows; their values at the described positions.
    w, out : Array
        Scratch with room for the further rows; output of ``observe``.
    """

    values: Layout
    rates: Layout
    held: Integers
    goals: Array
    origins: Array
    w: Array
    out: Array


class Further(NamedTuple):
    """Rows after a model's own: ``observe``, joint coordinates, their goals, and sections of the model's rows."""

    observe: Any
    held: Any
    goals: Any
    out: Any
    residual: Any
    nu: Any


def joints_held(info: ModelInfo, base: Layout, values: Sequence[int], rates: Sequence[int], scratch: Array) -> Joints:
    """Return the joint coordinates held by starts of a model.

    Parameters
    ----------
    info, base : ModelInfo, Layout
        The model, and its layout.
    values, rates : sequence of int
        Joint coordinates with held value, and with held rate.
    scratch : Array, shape (nw,)
        Scratch of the model; looped code reads its tables at the end.
    """
    count, most = len(values) + len(rates), max(len(values), len(rates))
    held, room = np.array([*values, *rates], dtype=np.int64), 2 * (base.m + most) + most * base.nv
    w = np.concatenate([scratch, np.zeros(room), scratch[-1:]]) if count else np.zeros(0)
    of_values, of_rates = (_with_rows(info, base, chosen, len(scratch)) for chosen in (values, rates))
    return Joints(
        of_values, of_rates, held, np.zeros(count), np.zeros(count), w, np.zeros(info.observed if count else 0)
    )


def _with_rows(info: ModelInfo, base: Layout, chosen: Sequence[int], nw: int) -> Layout:
    """Return a layout with rows of joint coordinates; Phi, nu and these rows of D are after the model's scratch."""
    if not chosen:
        return base
    m, n, k = base.m, base.nv, len(chosen)
    at = nw + 2 * (m + k)
    places = [(m + i, j, at + i * n + j - base.jacobian) for i in range(k) for j in range(n)]
    kinds = [(-1, int(info.joint_coordinates[c].unit != "rad")) for c in chosen]
    return base._replace(
        m=m + k,
        residual=nw,
        nu=nw + m + k,
        entries=np.concatenate([base.entries, np.array(places, dtype=np.int64).ravel()]),
        constants=np.concatenate([base.constants, np.zeros(k * n)]),
        rows=np.concatenate([base.rows, np.array(kinds, dtype=np.int64).ravel()]),
        alone=np.concatenate([base.alone, np.zeros(k, dtype=np.int64)]),
        switches=np.concatenate([base.switches, np.full(k, -1)]),
    )


@exact()
def fill_further(layout: Layout, now: Instant, work: Work, further: Further) -> None:
    """Fill Phi, D and nu of all rows; the model's are already in its part of the scratch.

    `work.y`, `work.w` and `work.direction` are overwritten.
    """
    y, w, out, held, other, rate = now.y, now.w, further.out, further.held, work.y, work.direction
    nq, n, k, at = layout.nq, layout.nv, held.shape[0], layout.nu + layout.m
    m = layout.m - k
    for i in range(layout.ny):
        other[i], rate[i] = y[i], 0.0
    copy_numbers(w, work.w, layout.residual)  # ``observe`` writes to it
    for j in range(n):
        other[nq + j] = 0.0
    further.observe(layout.t, other, now.p, work.w, rate, out)
    for i in range(m):
        w[layout.residual + i], w[layout.nu + i] = w[further.residual + i], w[further.nu + i]
    for i in range(k):
        place = m + 2 * held[i]
        w[layout.residual + m + i] = out[place] - further.goals[i]
        w[layout.nu + m + i] = further.goals[i]
        for j in range(n):
            w[at + i * n + j] = -out[place + 1]
    for j in range(n):
        other[nq + j] = 1.0
        further.observe(layout.t, other, now.p, work.w, rate, out)
        other[nq + j] = 0.0
        for i in range(k):
            w[at + i * n + j] += out[m + 2 * held[i] + 1]

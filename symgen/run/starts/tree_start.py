"""The start of a run in joint coordinates from a consistent one of bodies: its state, scales, and redundant rows.

Whole rows of loops may vanish there, permanently (two hinges on one axis) or at a dead centre.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from symgen.compile.loopcode.bare import bare, part
from symgen.compile.loopcode.exact import exact, plain_form
from symgen.compile.native.annotations import Record
from symgen.run.layout import abi
from symgen.run.layout.compiled import CompiledModel
from symgen.run.layout.probe import Ready
from symgen.run.layout.scales import mean_mass
from symgen.run.layout.start_records import Closing, Instant, StartModel, Work
from symgen.run.starts.assembler import Assembly
from symgen.run.starts.closing import mask_redundant
from symgen.run.starts.joint_starts import Further

Array = NDArray[np.float64]
Integers = NDArray[np.int64]

#: Orientations are more than 120 degrees apart where the product of their Euler parameters is below this.
TURNED_OVER = 0.5


class Carrying(Record):
    """Indices in rows of bodies and of a tree.

    Attributes
    ----------
    work, outs : int
        Elements of a tree's state before the work; numbers that ``observe`` writes.
    places : Array of int64, shape (2 work,)
        For each of these elements: 0 and its index in the state of bodies, or 1 and its index in the output of
        ``observe``.
    windings, gauges, spins : Array of int64
        Indices of angles that count turns, and of squares of lengths, in the scratch of bodies; -1 where that
        is 1. First indices of Euler parameters in the coordinates of bodies.
    """

    work: int
    outs: int
    places: Integers
    windings: Integers
    gauges: Integers
    spins: Integers


#: A tree with the ``observe`` of bodies, the function that maps its motion to bodies, and the indices.
Tree = tuple[StartModel, abi.Observe, abi.Observe, Carrying]


@exact(entry=True, once=True)
def settle_tree_row(tree: Tree, of_bodies: Instant, now: Instant, work: Work, room: Array, alike: Array) -> int:
    """Map a start of bodies to the tree; return the number of redundant rows of its loops.

    Parameters
    ----------
    tree : tuple
        As `Tree`.
    of_bodies, now : Instant
        The start of bodies, and the tree's, whose parameters and masses are prepared and whose state is set.
    work : Work
        Working memory of the tree's start.
    room : Array
        Working memory: a state of bodies, the output of ``observe``, and scratch.
    alike : Array, shape (spins,)
        Set to the products of Euler parameters of closed bodies with the tree's: constraint rows leave the sense of
        an axis open; a tree fixes it.
    """
    (layout, masses, geometry, measure, move, spread, solve, formulas, project, _, _), observe, carry, carrying = tree
    (y, p, w), (y_t, p_t, w_t) = of_bodies, now
    ny, nw = y.shape[0], w.shape[0]
    rate, out, scratch = part(room, 0, ny), part(room, ny, carrying.outs), part(room, ny + carrying.outs, nw)
    for i in range(nw):
        scratch[i] = w[i]
    for i in range(ny):
        rate[i] = 0.0
    observe(layout.t, y, p, scratch, rate, out)
    for k in range(carrying.work):
        at = carrying.places[2 * k + 1]
        y_t[k] = y[at] if carrying.places[2 * k] == 0 else out[at]
    for i in range(carrying.windings.shape[0]):
        w_t[abi.WINDING + i] = w[carrying.windings[i]]
    w_t[abi.LENGTH], w_t[abi.SPEED] = w[abi.LENGTH], w[abi.SPEED]
    for j in range(layout.nv):
        w_t[layout.gauge + j] = 1.0 if carrying.gauges[j] < 0 else w[carrying.gauges[j]]
    w_t[abi.MEAN_MASS] = mean_mass(layout, w_t)
    closing = Closing(geometry, measure, move, spread, solve, masses, formulas, project)
    nothing = Further(observe, part(work.order, 0, 0), out, out, layout.residual, layout.nu)
    geometry(layout.t, y_t, p_t, w_t)
    dependent = mask_redundant(closing, layout, now, work, nothing)
    count = carrying.spins.shape[0]
    if count > 0:
        for i in range(w_t.shape[0]):
            work.w[i] = w_t[i]
        carry(layout.t, y_t, p_t, work.w, work.direction, out)
    for i in range(count):
        first, product = carrying.spins[i], 0.0
        for k in range(first, first + 4):
            product += out[k] * y[k]
        alike[i] = product
    return int(dependent)


@exact(entry=True)
def settle_rows(
    tree: Tree,
    of_bodies: Instant,
    of_tree: Instant,
    work: Work,
    room: Array,
    alike: Array,
    selected: Integers,
    control: Integers,
) -> int:
    """Map the starts of many rows, one after the other, to the tree; return the number of processed rows.

    Parameters
    ----------
    tree, of_bodies, of_tree, work, room, alike
        As for `settle_tree_row`.
    selected, control : Array of int
        Rows to work on; memory shared with the watching thread.
    """
    (
        (layout, masses, geometry, measure, move, spread, solve, formulas, project, turns, rhs),
        observe,
        carry,
        carrying,
    ) = tree
    layout, carrying, work = bare(layout), bare(carrying), bare(work)
    tree = (
        (layout, masses, geometry, measure, move, spread, solve, formulas, project, turns, rhs),
        observe,
        carry,
        carrying,
    )
    (ys, ps, ws), (yt, pt, wt) = bare(of_bodies), bare(of_tree)
    runs, count = yt.shape[0] // layout.ny, carrying.spins.shape[0]
    ny, n_p, nw = ys.shape[0] // runs, ps.shape[0] // runs, ws.shape[0] // runs
    np_t, nw_t = pt.shape[0] // runs, wt.shape[0] // runs
    for s in range(selected.shape[0]):
        if control[abi.STOP] != 0:
            return int(s)
        r = selected[s]
        here = Instant(part(ys, r * ny, ny), part(ps, r * n_p, n_p), part(ws, r * nw, nw))
        now = Instant(part(yt, r * layout.ny, layout.ny), part(pt, r * np_t, np_t), part(wt, r * nw_t, nw_t))
        settle_tree_row(tree, here, now, work, room, part(alike, r * count, count))
    return int(selected.shape[0])


@dataclass(frozen=True)
class Carried:
    """Mapping of a start of bodies to a tree.

    Attributes
    ----------
    bodies : CompiledModel
        In the bodies' own coordinates.
    assembly : Assembly
        Of the tree.
    carrying : Carrying
        Indices in rows of bodies and of the tree.
    """

    bodies: CompiledModel
    assembly: Assembly
    carrying: Carrying

    def settle(self, of_bodies: Instant, now: Instant, selected: Integers, control: Integers) -> Array:
        """Map the starts of the selected rows; return the products of Euler parameters, shape (rows, spins).

        Parameters
        ----------
        of_bodies, now : Instant
            Of all rows, one row of a matrix for each: the starts of bodies, and those of the tree, which are written.
        selected, control : Array of int
            Rows to work on; memory shared with the watching thread.
        """
        assembly, alike = self.assembly, np.zeros((len(now.y), len(self.carrying.spins)))
        flat, functions, form = assembly.prepare(now, selected, assembly.layout.m)
        ends = self.ends
        if form is plain_form:
            ends = Ready(ends[0], abi.OBSERVE), Ready(ends[1], abi.OBSERVE)
        tree = (assembly.layout, assembly.table, *functions[:-1]), *ends, self.carrying
        room = self.room(Instant(*(array[0] for array in of_bodies)))
        starts = Instant(*(array.ravel() for array in of_bodies)), flat
        with np.errstate(all="ignore"):
            form(settle_rows)(tree, *starts, assembly.memory()[1], room, alike.reshape(-1), selected, control)
        return alike

    @property
    def ends(self) -> tuple[Any, Any]:
        """The emitted ``observe`` of bodies, and the tree's function that maps its motion to bodies."""
        return self.bodies.model.observe, self.assembly.compiled.model.bodies

    def room(self, of_bodies: Instant) -> Array:
        """Return working memory for a start of bodies."""
        return np.zeros(len(of_bodies.y) + self.carrying.outs + len(of_bodies.w))

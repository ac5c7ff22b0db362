"""Directions of modes: how the numbers of rows with bounds depend on all numbers, after a passage that chose them anew.

A row that is held keeps the value at which it came to rest, and its bound; a row in force may carry bounds of others,
which rest with it. Where a row comes to rest for these numbers only, derivatives on both sides differ: a doubt.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from symgen.describe.bounds.bounded_modes import HIT
from symgen.run.directions.free_directions import Free, constraint_directions
from symgen.run.directions.moments import Directions, Moment, Moments, modes_of_moment
from symgen.run.layout import abi
from symgen.run.modes.bounded_rows import CONSTANT, EFFORT, HELD, LIMIT, SIGN, STILL

if TYPE_CHECKING:
    from symgen.run.directions.passages import RunPassage
    from symgen.run.layout.compiled import CompiledModel
    from symgen.run.loops.run_spec import BoundedRows, Watched

Array = NDArray[np.float64]

#: Derivatives of a rate at rest below this part of the largest of a velocity are rounding.
_STAYS = 1e-6


def name_of_switch(watched: Watched | None, passage: RunPassage) -> str:
    """Return the names of the events of a passage, for people."""
    assert watched is not None, "the run has events"
    return " and ".join(f"'{watched.names[k]}'" for k in passage.numbers)


@dataclass
class ModeDirections:
    """Finds the directions of modes.

    Parameters
    ----------
    moments : Moments
        The code; its last direction is the motion.
    watched : Watched or None
        Switching functions of the run.
    consistent : bool
        Whether directions satisfy the constraints; else they are all directions there are.
    doubts : list of str
        Is told what is in doubt.
    """

    moments: Moments
    watched: Watched | None
    consistent: bool
    doubts: list[str]

    @property
    def compiled(self) -> CompiledModel:
        """The model."""
        return self.moments.compiled

    def directions_of_modes(
        self, passage: RunPassage, before: Moment, after: Moment, by: Directions, free: Free
    ) -> Array:
        """Return the directions of the numbers of modes after a passage.

        Parameters
        ----------
        passage : RunPassage
            The passage.
        before, after : Moment
            States before and after it.
        by : Directions
            Directions after its effects, the motion as the last one.
        free : Free
            Directions that constraints leave.
        """
        rows = None if self.watched is None else self.watched.bounded
        kept = by.modes[:, :-1]
        if rows is None:
            return kept
        info, place, k = self.compiled.info, self.moments.place_of_modes(), len(rows.names)
        own = [info.switchable.index(row) for row in info.bounded]
        old, new = (modes_of_moment(self.compiled, x.w[place])[own] for x in (before, after))
        slopes = modes_of_moment(self.compiled, kept.copy())
        held = new[:, HELD] != 0.0
        was = (old[:, HELD] != 0.0) & (new[:, CONSTANT] == old[:, CONSTANT])
        if passage.starts:
            was[:] = False
        if not (np.any(held) or np.any(new[:, SIGN] != 0.0)):
            slopes[own] = 0.0
            return slopes.reshape(kept.shape)
        values, directions = self.moments.evaluate_moment(rows.state.function, rows.values, after, by)
        directions = directions[:, :-1]
        for i in range(k):
            line = slopes[own[i]]
            constant = line[CONSTANT].copy() if held[i] and was[i] else directions[i] * held[i]
            line[:] = 0.0
            line[CONSTANT] = constant
            tied = rows.partners and rows.partners[i] >= 0
            if held[i] and i < rows.dry and i not in rows.pressed and i not in rows.varying and not tied:
                line[LIMIT] = directions[2 * k + i]
        self._share_of_row(rows, own, new, slopes, values, directions, after, by)
        rests = (held & ~was) | ((new[:, CONSTANT] != 0.0) & (new[:, SIGN] == 0.0) & (old[:, CONSTANT] == 0.0))
        if passage.effects:  # a rate that an impact leaves at zero is that of a row at rest, which may slide from there
            scale = np.array([1.0 / after.w[abi.LENGTH] if info.rows[i].unit == "rad" else 1.0 for i in info.bounded])
            speeds = np.abs(values[k : 2 * k])
            for i in rows.seconds:
                speeds[i - 1 : i + 1] = np.hypot(*speeds[i - 1 : i + 1])
            rests |= (new[:, SIGN] != 0.0) & (speeds <= STILL * after.w[abi.SPEED] * scale)
        self._check_rest(passage, rows.names, rests, directions, after, by, free)
        return slopes.reshape(kept.shape)

    def _check_rest(
        self,
        passage: RunPassage,
        names: tuple[str, ...],
        rests: NDArray[np.bool_],
        directions: Array,
        after: Moment,
        by: Directions,
        free: Free,
    ) -> None:
        """Doubt directions in which a row moves that has come to rest here, or a gap that is closed at the start."""
        k, w, info = len(names), after.w, self.compiled.info
        watched = self.watched
        if watched is not None and len(passage.numbers) == 1 and watched.words[passage.numbers[0]] != HIT:
            # the event itself says that its row rests
            own = name_of_switch(watched, passage)[1:-1].rpartition(".")[0]
            rests = rests & np.array([name != own for name in names])
        rows, which = directions[k : 2 * k][rests], np.array(names)[rests]
        if passage.starts and watched is not None and watched.bounded is not None:
            pushes = rests & (np.arange(k) >= watched.bounded.dry)
            rows = np.concatenate([rows, directions[:k][pushes]])
            which = np.concatenate([which, np.array(names)[pushes]])
        if not len(rows):
            return
        if self.consistent:
            sizes = np.abs(by.y[: info.work, :-1]).max(axis=0, initial=0.0)
            sizes = np.maximum(sizes, np.abs(by.t[:-1]) * w[abi.SPEED] * max(1.0, w[abi.SPEED] / w[abi.LENGTH]))
            moving = (np.abs(rows) > _STAYS * np.maximum(sizes, STILL) * max(1.0, 1.0 / w[abi.LENGTH])).any(axis=1)
        else:
            moving = np.array([free.has_free_motion(x[np.newaxis], x[np.newaxis]) for x in rows])
        if np.any(moving):
            found = " and ".join(dict.fromkeys(which[moving].tolist()))
            rest = "rests at the start" if passage.starts else f"comes to rest at t = {after.t:.6g} s"
            self.doubts.append(f"{found} {rest} for these numbers only: derivatives on both sides differ")

    def _share_of_row(
        self,
        rows: BoundedRows,
        own: list[int],
        new: Array,
        slopes: Array,
        values: Array,
        directions: Array,
        after: Moment,
        by: Directions,
    ) -> None:
        """Add the directions of bounds that a row in force carries for others, which rest with it."""
        k, info = len(rows.names), self.compiled.info
        carried = [
            (i, int(new[i, CONSTANT]) - 1)
            for i in range(rows.dry)
            if new[i, HELD] == 0.0 and new[i, SIGN] == 0.0 and new[i, CONSTANT] > 0.0
        ]
        if np.any(new[:, EFFORT] != 0.0):
            shared = " and ".join(name for name, x in zip(rows.names, new[:, EFFORT], strict=True) if x != 0.0)
            self.doubts.append(
                f"from t = {after.t:.6g} s on {shared} share forces at rest, whose derivatives are not followed"
            )
        if not carried:
            return
        d, by_d, *_ = constraint_directions(self.moments, after, by)
        force = [i for i in range(info.m) if i not in info.bounded]
        force += [info.bounded[j] for j in range(k) if new[j, HELD] != 0.0]
        base, by_base = d[force], by_d[force]
        for i, owner in carried:
            row = info.bounded[i]
            parts = np.linalg.lstsq(base.T, d[row], rcond=1e-11)[0]
            rest = by_d[row] - np.einsum("rjk,r->jk", by_base, parts)
            change = np.linalg.lstsq(base.T, rest, rcond=1e-11)[0]
            at = force.index(info.bounded[owner])
            factor, slope = abs(parts[at]), np.sign(parts[at]) * change[at]
            if i in rows.varying:  # margins read the bound itself, times this factor
                slopes[own[i], LIMIT] = slope
            elif rows.partners and rows.partners[i] >= 0:  # the factor of a contact has a sign
                slopes[own[i], LIMIT] = change[at]
            else:
                slopes[own[owner], LIMIT] += factor * directions[2 * k + i] + slope * values[2 * k + i]

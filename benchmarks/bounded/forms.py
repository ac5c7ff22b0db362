"""One state of a mechanism with bounded coordinates: accelerations in given modes, and the choice of modes."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from benchmarks.bounded.modes import NoForces, holding_margin, impulses, resting_forces
from benchmarks.bounded.rows import Bounded
from benchmarks.bounded.tree import Array, Tree

#: Rates and gaps that count as zero.
AT_REST, TOUCHING = 1e-10, 1e-12
#: Accelerations that count as zero, of the size of those that are there.
UNMOVED = 1e-9
#: How far ahead it is looked where an acceleration is zero and its force at a bound [s].
AHEAD = (1e-6, 1e-4)
LOWER, UPPER = -1, 1
NO_PIECES: Mapping[int, int] = {}


@dataclass(frozen=True)
class Modes:
    """What each coordinate does.

    Attributes
    ----------
    held : tuple of bool
        Whether it is at rest for now.
    signs : tuple of int
        Of the rate against which friction acts, 0 without friction or where it is held.
    sides : tuple of int
        `LOWER` or `UPPER` where a stop is closed, else 0.
    at : tuple of float
        Where it is held.
    """

    held: tuple[bool, ...]
    signs: tuple[int, ...]
    sides: tuple[int, ...]
    at: tuple[float, ...]

    @property
    def resting(self) -> list[int]:
        """Numbers of the coordinates that are held."""
        return [i for i, held in enumerate(self.held) if held]


class Forms:
    """The equations at one state.

    Parameters
    ----------
    tree : Tree
        The mechanism.
    rows : sequence of Bounded
        Its coordinates with bounds.
    t, u, v : float, Array, Array
        The state.
    pieces : mapping of int to int
        Pieces that hold, by the numbers of rows with corners; of others the largest.
    """

    def __init__(
        self, tree: Tree, rows: Sequence[Bounded], t: float, u: Array, v: Array, pieces: Mapping[int, int] = NO_PIECES
    ) -> None:
        self.tree, self.rows, self.t, self.u, self.v, self.pieces = tree, rows, t, u, v, pieces
        self.state = tree.at(t, u, v)
        measured = [row.of(self.state) for row in rows]
        self.others = dict[int, float]()  # by how much the piece that holds is above another one
        for i, row in enumerate(rows):
            if row.pieces:
                every = [piece(self.state) for piece in row.pieces]
                values = [float(m.value) for m in every]
                held = pieces.get(i, int(np.argmax(values)))
                measured[i] = every[held]
                self.others[i] = values[held] - max(x for k, x in enumerate(values) if k != held)
        self.values = np.array([float(m.value) for m in measured])
        self.slopes = np.array([m.slopes for m in measured]).reshape(len(rows), tree.n)
        self.bias = np.array([float(m.bias) for m in measured])
        self.drift = np.array([m.drift for m in measured])
        self.rates = self.slopes @ v + self.drift

    @cached_property
    def closed(self) -> tuple[Array, Array, Array]:
        """See `Tree.closed`."""
        return self.tree.closed(self.state)

    @cached_property
    def dynamics(self) -> tuple[Array, Array]:
        """M and f, viscous friction among the forces."""
        mass, force = self.tree.dynamics(self.state)
        for i, row in enumerate(self.rows):
            if row.viscous:
                force = force - row.viscous * self.rates[i] * self.slopes[i]
        return mass, force

    # -- motion in given modes -----------------------------------------------------------------------------------------

    def rubbed(self, signs: Sequence[int]) -> Array:
        """Return the forces with those of sliding friction."""
        force = self.dynamics[1]
        for i, sign in enumerate(signs):
            if sign:
                force = force - sign * self.rows[i].sliding * self.slopes[i]
        return force

    def accelerations(self, modes: Modes) -> tuple[Array, Array]:
        """Return accelerations, and the forces along coordinates that are held."""
        mass, force = self.dynamics[0], self.rubbed(modes.signs)
        _, closing, bias = self.closed
        held = modes.resting
        rows = np.vstack([closing, self.slopes[held]])
        free = np.asarray(np.linalg.solve(mass, force), dtype=np.float64)
        if not len(rows):
            return free, np.zeros(0)
        spread = np.linalg.solve(mass, rows.T)
        right = rows @ free + np.concatenate([bias, self.bias[held]])
        square = rows @ spread
        scale = 1.0 / np.sqrt(np.diag(square))
        square, right = square * np.outer(scale, scale), right * scale
        if self.independent(held):
            multipliers: Array = scale * np.linalg.solve(square, right)
        else:
            multipliers = scale * np.linalg.lstsq(square, right, rcond=1e-10)[0]
        return free - spread @ multipliers, -multipliers[len(closing) :]

    def independent(self, held: Sequence[int]) -> bool:
        """Whether coordinates that are held do not follow from each other."""
        if not self.tree.closures or len(held) < 2:
            return bool(len(held) <= self.free.shape[1])
        return bool(np.linalg.matrix_rank(self.slopes[list(held)] @ self.free, tol=1e-9) == len(held))

    def force_bounds(self, modes: Modes) -> tuple[Array, Array]:
        """Return the bounds of the forces along coordinates that are held."""
        held = modes.resting
        return self.bounds(held, [self.rows[i].static for i in held], [modes.sides[i] for i in held])

    @staticmethod
    def bounds(which: Sequence[int], dry: Sequence[float], sides: Sequence[int]) -> tuple[Array, Array]:
        """Return bounds of one force each of friction and of a closed stop."""
        lower = np.array([-math.inf if side == UPPER else -b for b, side in zip(dry, sides, strict=True)])
        upper = np.array([math.inf if side == LOWER else b for b, side in zip(dry, sides, strict=True)])
        return lower, upper

    def margins(self, modes: Modes) -> Array:
        """Return for each coordinate by how much the force that holds it is within its bounds; infinite for others."""
        margins = np.full(len(self.rows), math.inf)
        held = modes.resting
        if not held:
            return margins
        force = self.accelerations(modes)[1]
        lower, upper = self.force_bounds(modes)
        if self.independent(held):
            margins[held] = np.minimum(force - lower, upper - force)
            return margins
        along = (self.slopes[held] @ self.free).T
        basis, sizes, _ = np.linalg.svd(along)
        matrix = basis[:, : int((sizes > 1e-9 * sizes[0]).sum())].T @ along
        margins[held] = holding_margin(matrix, matrix @ force, (lower, upper))
        return margins

    # -- independent coordinates ---------------------------------------------------------------------------------------

    @cached_property
    def free(self) -> Array:
        """Directions that closed loops leave, as columns."""
        n = self.tree.n
        closing = self.closed[1]
        if not len(closing):
            return np.eye(n)
        basis: Array = np.linalg.svd(closing)[2][len(closing) :].T
        return basis

    @cached_property
    def narrowest(self) -> float:
        """The smallest singular value of the closures; infinite without any."""
        closing = self.closed[1]
        return float(np.linalg.svd(closing, compute_uv=False)[-1]) if len(closing) else math.inf

    def box(
        self, rest: Sequence[int], signs: Sequence[int], sides: Sequence[int], loose: set[int]
    ) -> tuple[Array, Array, Array, set[int]]:
        """Return accelerations at rest, how near their forces are to a bound, all accelerations, and what slips.

        What its static bound does not hold has the bound of sliding, and is looked at again.
        """
        mass, force = self.dynamics[0], self.rubbed(signs)
        _, closing, bias = self.closed
        particular = np.linalg.pinv(closing) @ -bias if len(closing) else np.zeros(self.tree.n)
        basis = self.free
        reduced = basis.T @ mass @ basis
        free = np.asarray(np.linalg.solve(reduced, basis.T @ (force - mass @ particular)), dtype=np.float64)
        slopes = self.slopes[list(rest)] @ basis
        more = self.bias[list(rest)] + self.slopes[list(rest)] @ particular
        slips = set(loose)
        while True:
            dry = [self.rows[i].sliding if i in slips else self.rows[i].static for i in rest]
            lower, upper = self.bounds(rest, dry, [sides[i] for i in rest])
            forces: Array = resting_forces(reduced, free, slopes, more, (lower, upper))
            z = free + np.linalg.solve(reduced, slopes.T @ forces)
            found = slopes @ z + more
            size = max(1.0, float(np.abs(slopes @ free).max(initial=0.0)))
            found[np.abs(found) < UNMOVED * size] = 0.0
            over = {
                i
                for i, a in zip(rest, found, strict=True)
                if a and i not in slips and self.rows[i].static > self.rows[i].sliding
            }
            if not over:
                break
            slips |= over
        near = np.minimum(np.abs(forces - lower), np.abs(upper - forces))
        return found, near, basis @ z + particular, slips

    # -- choices -------------------------------------------------------------------------------------------------------

    def touched(self) -> list[int]:
        """Return for each coordinate which of its stops it touches, 0 for none."""
        sides = []
        for value, row in zip(self.values, self.rows, strict=True):
            low, high = value - row.lower <= TOUCHING, row.upper - value <= TOUCHING
            sides.append(LOWER if low else UPPER if high else 0)
        return sides

    def choose(self, broken: set[int]) -> Modes:
        """Return the modes behind an event; the hold of what is `broken` has just been lost."""
        sides = self.touched()
        k = len(self.rows)
        rest = [i for i in range(k) if abs(self.rates[i]) <= AT_REST and (self.rows[i].rubs or sides[i])]
        signs = [int(np.sign(self.rates[i])) if self.rows[i].rubs and i not in rest else 0 for i in range(k)]
        moving = self._moving(rest, signs, sides, broken) if rest else {}
        for i, rate in moving.items():
            signs[i] = int(np.sign(rate)) if self.rows[i].rubs else 0
        held = [i in rest and i not in moving for i in range(k)]
        closed = [side if hold else 0 for side, hold in zip(sides, held, strict=True)]
        places = [
            (row.lower if side == LOWER else row.upper if side == UPPER else value)
            for row, side, value in zip(self.rows, closed, self.values, strict=True)
        ]
        return Modes(tuple(held), tuple(signs), tuple(closed), tuple(places))

    def _moving(
        self, rest: Sequence[int], signs: Sequence[int], sides: Sequence[int], broken: set[int]
    ) -> dict[int, float]:
        """Return coordinates at rest that begin to move, with accelerations of the sign in which they do."""
        found, near, accelerations, slips = self.box(rest, signs, sides, broken)
        moving = {i: float(a) for i, a in zip(rest, found, strict=True) if a}
        dependent = not self.independent(rest)
        undecided = {
            i
            for i, a, gap in zip(rest, found, near, strict=True)
            if not a and (gap <= 1e-9 * max(1.0, self.rows[i].static) or i in broken or dependent)
        }
        for h in AHEAD:
            if not undecided:
                break
            v = self.v + h * accelerations
            u = self.u + h * self.v + 0.5 * h * h * accelerations
            later = Forms(self.tree, self.rows, self.t + h, u, v, self.pieces)
            ahead = later.box(rest, signs, sides, slips)[0]
            largest = float(np.abs(ahead).max(initial=0.0))
            for i, a in zip(rest, ahead, strict=True):
                if i in undecided and abs(a) > 1e-4 * largest:
                    moving[i] = float(a)
                    undecided.discard(i)
        return moving

    def struck(self, careful: set[int]) -> Array | None:
        """Return the velocities behind an impact, None where nothing strikes; `careful` ones do not rebound."""
        sides = self.touched()
        touching = [i for i, side in enumerate(sides) if side]
        rates = np.array([-sides[i] * self.rates[i] for i in touching])  # of gaps
        if not (rates < -AT_REST).any():
            return None
        slopes = np.array([-sides[i] * self.slopes[i] for i in touching])
        basis = self.free
        reduced = basis.T @ self.dynamics[0] @ basis
        along = slopes @ basis
        spread = np.linalg.solve(reduced, along.T)
        restitutions = np.array([0.0 if i in careful else self.rows[i].restitution for i in touching])
        push = impulses(along @ spread, rates, restitutions)
        behind: Array = self.v + basis @ (spread @ push)
        return behind


__all__ = ["Forms", "Modes", "NoForces"]

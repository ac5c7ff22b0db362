"""Transitions where bounds of friction depend on reactions of joints.

Reactions at rest depend on the forces at rest, and their bounds on the reactions: both are found in turns, until they
agree. Friction that alone brings about all of its reaction is jammed, and ends the run by name.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from symgen.base.errors import InputError
from symgen.describe.friction import JAM
from symgen.layout import abi
from symgen.loopcode.exact import compiled_form
from symgen.runs import choice
from symgen.runs.bounded_rows import AT_BOUND, DEPENDENT, HELD, LIMIT, NO_ACCELERATION, OTHERS, SAME
from symgen.runs.box import INSIDE, new_box
from symgen.runs.events import Happening
from symgen.runs.holding import hold_rows
from symgen.runs.transitions import Array, Flags, Integers, Transitions, find_forces

#: Bounds by reactions agree within this part of them, after so many solutions at most.
_AGREED, _AGREEMENTS = 1e-14, 2000


class PressedTransitions(Transitions):
    """The modes of a run in which friction depends on reactions; there are no stops."""

    def meet(self, happened: Sequence[Happening]) -> None:
        """Choose modes at the events at which a loop ended; a jam ends the run.

        Parameters
        ----------
        happened : sequence of Happening
            Events at the present time.
        """
        names = [event.name for event in happened]
        for i, name in enumerate(self.rows.names):
            if f"{name}.{JAM}" in names:
                self._refuse_jam(i, 1.0)
        super().meet(happened)

    def choose(
        self, broken: Sequence[int] = (), stopped: Sequence[int] = (), left: Sequence[int] = ()
    ) -> list[tuple[int, str]]:
        """Choose the modes of the present state, as in `Transitions`; redundant rows determine no reactions."""
        self._refuse_redundant(self.simulation.state.w)
        return super().choose(broken, stopped, left)

    def _chosen(self) -> bool:
        """Choose modes at a state whose rows have been read; return whether they are others."""
        c, w = self._choice, self.simulation.state.w
        rest = c.rest[: compiled_form(choice.find_rest)(c, w)].copy()
        static, sliding = c.static.copy(), c.sliding.copy()
        self._solve(rest, c.signs, c.static, c.sliding, c.loose != 0)
        if compiled_form(hold_rows)(c, w) != SAME:
            self._refuse_undetermined()
        self._follow_reactions(rest.tolist(), c.after.reshape(len(c.signs), -1))
        c.static[:], c.sliding[:] = static, sliding
        return bool(compiled_form(choice.write_modes)(c, w) == OTHERS)

    def _solve(self, rest: Integers, signs: Array, static: Array, sliding: Array, loose: Flags) -> None:
        """Set the signs of rows at rest, G among all rows, and the forces at rest.

        Bounds by reactions follow the forces, which follow the bounds, until both agree; `static` and `sliding` of
        these coordinates become bounds.
        """
        c, k, size, pressed = self._choice, len(rest), len(signs), list(self.rows.pressed)
        matrix, forces = c.matrix.reshape(size, size), c.forces
        matrix[:], forces[:] = 0.0, 0.0
        moving = [i for i in pressed if signs[i] != 0.0]
        plain = np.where(np.isin(np.arange(size), pressed), 0.0, signs)
        offset, alone = self._accelerations(plain), self._reactions()
        compiled_form(choice.find_mobility)(c)
        parts = np.zeros((*alone.shape, size))
        for j in (*rest, *moving):
            if sliding[j] > 0.0:
                probe, force = plain.copy(), 1.0 if j in pressed else sliding[j]
                probe[j] = 0.0 if j in pressed else 1.0
                matrix[:, j] = (offset - self._accelerations(probe, j if j in pressed else -1)) / force
                parts[:, :, j] = (alone - self._reactions()) / force
        for i in pressed:
            self._refuse_jam(i, float((sliding if i in moving else static)[i] * np.linalg.norm(parts[i, :, i])))
        if k == 0:
            return
        compiled_form(choice.symmetrise)(c)
        among = matrix[np.ix_(rest, rest)]
        coefficients, box = np.where(loose, sliding, static)[rest], new_box(k)
        size_of = np.ones(size)
        size_of[pressed] = np.where(signs[pressed] == 0.0, np.inf, np.linalg.norm(alone[pressed], axis=1))
        box.matrix[:] = among.ravel()
        for _ in range(_AGREEMENTS):
            forces[moving] = signs[moving] * sliding[moving] * size_of[moving]
            bounds = np.where(coefficients > 0.0, coefficients, 0.0)
            np.multiply(bounds, size_of[rest], out=bounds, where=bounds > 0.0)
            box.bounds[:], box.lower[:] = bounds, -bounds
            box.offset[:] = offset[rest] - matrix[rest][:, moving] @ forces[moving]
            find_forces(k, box)
            forces[rest] = box.forces
            before = size_of.copy()
            size_of[pressed] = np.linalg.norm(alone[pressed] - parts[pressed] @ forces, axis=1)
            if (np.abs(size_of - before) > _AGREED * size_of).any():
                continue
            sizes = np.abs(box.offset) + np.abs(among) @ np.abs(box.forces)
            moves = (box.place != INSIDE) & (np.abs(box.left) > NO_ACCELERATION * sizes)
            over = moves & (coefficients > sliding[rest])
            if not over.any():
                break
            coefficients = np.where(over, sliding[rest], coefficients)
        else:
            names = ", ".join(self.rows.names[i] for i in pressed)
            raise InputError("friction", "bounds and reactions that agree", f"others at {names} after many changes")
        moves |= loose[rest] & (np.abs(box.forces) >= AT_BOUND * bounds) & (bounds > 0.0)
        direction = np.sign(np.where(box.forces == 0.0, box.left, box.forces))
        static[pressed], sliding[pressed] = static[pressed] * size_of[pressed], sliding[pressed] * size_of[pressed]
        signs[rest] = np.where(moves, direction, 0.0)

    def _follow_reactions(self, rest: Sequence[int], after: Array) -> None:
        """Have largest efforts follow the reaction, unless rows share a force."""
        taken = [i for i in rest if after[i, HELD] != 0.0]
        sharing = [i for i in rest if after[i, HELD] == 0.0 and after[i, LIMIT] != 0.0]
        pressed = set(rest) & set(self.rows.pressed)
        if sharing and pressed and (self.rows.changes or self._moves(taken)):
            names = ", ".join(self.rows.names[i] for i in rest)
            expected = "friction by reactions whose forces at rest are determined, or that rests for good"
            raise InputError("friction", expected, f"{names} at rest at one time, beside what changes")
        after[[i for i in pressed if i in sharing or not sharing], LIMIT] = 0.0

    def _refuse_redundant(self, w: Array) -> None:
        """Refuse rows that depend on others: reactions are not determined."""
        info, mask = self.simulation.compiled.info, self.simulation.compiled.section(w, "mask")
        rows = [info.rows[i].name for i in range(info.m) if mask[i] != 0.0 and i not in info.bounded]
        if rows:
            names = ", ".join(self.rows.names[i] for i in self.rows.pressed)
            expected = "rows that determine all reactions, where friction depends on one"
            raise InputError(f"friction of {names}", expected, f"{', '.join(rows)}, which other rows determine")

    def _refuse_jam(self, i: int, number: float) -> None:
        """Refuse friction that alone brings about all of its reaction: accelerations are none, or not unique."""
        if not number < 1.0:
            now, name = float(self.simulation.state.clock[abi.TIME]), self.rows.names[i]
            expected = "friction that brings about less than all of its own reaction (a jamming number below 1)"
            raise InputError(f"friction of {name}", expected, f"{number:.12g} at t = {now:.9g} s")

    def _moves(self, taken: Sequence[int]) -> bool:
        """Return whether the mechanism can move with the rows of some coordinates at rest in force."""
        compiled, w = self.simulation.compiled, self._choice.w
        info = compiled.info
        rows = [i for i in range(info.m) if i not in info.bounded] + [info.bounded[i] for i in taken]
        mass = compiled.section(w, "mass")
        weights = np.divide(1.0, np.sqrt(mass), out=np.ones_like(mass), where=mass > 0.0)
        return bool(np.linalg.matrix_rank(compiled.jacobian(w)[rows] * weights, DEPENDENT) < info.nv)

    def _reactions(self) -> Array:
        """Return the components of reactions after `_accelerations`, of all coordinates."""
        rows, state, c = self.rows, self.simulation.state, self._choice
        result = np.zeros((len(rows.names), 2))
        if rows.reactions is not None:
            now = float(state.clock[abi.TIME])
            forces = rows.reactions(now, c.y, state.p, c.w, c.rate)
            result[list(rows.pressed)] = forces.reshape(-1, 2)
        return result

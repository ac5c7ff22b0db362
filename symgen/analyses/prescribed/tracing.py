"""A prescribed motion through any times: followed by compiled code, and carried over singular positions."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from symgen.analyses.prescribed.passing import Curve, Passage, coordinate_rates, curve_through
from symgen.analyses.prescribed.prescribed import PrescribedRun
from symgen.compile.loopcode.exact import compiled_form
from symgen.run.layout import abi
from symgen.run.layout.manifold import turn_nothing
from symgen.run.layout.model_arrays import entries_of, marks_of_lengths, velocity_of_coordinate
from symgen.run.layout.probe import Ready
from symgen.run.loops import following as f
from symgen.run.planning.dead_centre import free_and_held, jacobian_at
from symgen.run.starts import decisions
from symgen.run.starts.assembler import row_chooser

if TYPE_CHECKING:
    from collections.abc import Callable

Array = NDArray[np.float64]

#: Near a singular position states are computed at so many times on either side, where the sine is a multiple of this.
NODES, SPACING = 3, 0.05
#: Sines below this are near a singular position; attempts to go over it, each with nearer times.
NEAR, ATTEMPTS = 0.01, 4
#: The state extrapolated over a singular position has to be corrected by less than this part of the sine.
CONTINUED = 0.1
#: A motion is followed at so many times, where the requested ones are farther apart: drivers may go and return there.
FOLLOWED = 200
#: Times nearer than this part of a motion are equal.
SAME = 1e-9
#: Times that compiled code goes through at once.
PIECE = 500_000
#: The shortest step, as a part of the motion's time.
LEAST = 1e-13
#: The shortest one of a motion that ends at singular positions.
SHORT = 1e-6
#: A row that opens by more than this in the shortest step jumps [rad, or the length of the mechanism].
JUMP = 1e-6


class Traced(NamedTuple):
    """A motion that was followed; arrays have one row a time, up to where it ended."""

    times: Array
    states: Array
    accelerations: Array
    status: Array
    passages: tuple[Passage, ...]
    ended: str
    steps: int


def trace_motion(run: PrescribedRun, times: Array, crosses: bool = True) -> Traced:
    """Follow a motion through increasing times, those before 0 backwards.

    Parameters
    ----------
    run : PrescribedRun
        Ready, and all driven.
    times : Array, shape (k,)
        Increasing [s].
    crosses : bool
        Whether it goes over singular positions; else it ends there, as derivatives do.
    """
    first = int(np.searchsorted(times, 0.0))
    if not first:
        return Tracer(run, times, crosses).run()
    back = Tracer(run, times[:first][::-1], crosses).run()
    # copies, as compiled code takes contiguous rows
    rows = (array[::-1].copy() for array in back[:4])
    before = Traced._make((*rows, back.passages[::-1], back.ended, back.steps))
    if first == len(times):
        return before
    after = Tracer(run, times[first:], crosses).run()
    rows = (np.concatenate(arrays) for arrays in zip(before[:4], after[:4], strict=True))
    ended = "; ".join(part.ended for part in (before, after) if part.ended)
    return Traced._make((*rows, before.passages + after.passages, ended, before.steps + after.steps))


def refine_times(times: Array) -> tuple[Array, NDArray[np.bool_]]:
    """Return times with others wherever they are far apart, and which of them are those given.

    Parameters
    ----------
    times : Array, shape (k,)
        All after 0, or all before it, in the order in which they are met [s].
    """
    end = float(times[-1])
    if end == 0.0:
        return times, np.ones(len(times), dtype=bool)
    own = np.append(0.0, times / end)
    more = np.arange(1, FOLLOWED) / FOLLOWED
    k = np.clip(np.searchsorted(own, more), 1, len(own) - 1)
    apart = np.minimum(more - own[k - 1], own[k] - more)
    more = more[(apart > SAME) & (own[k] - own[k - 1] > 1.0 / FOLLOWED + SAME)]
    together = np.concatenate([times, more * end])
    order = np.argsort(np.abs(together), kind="stable")
    return together[order], order < len(times)


@dataclass
class Tracer:
    """The loop over times that all lie on one side of 0, with the singular positions on the way.

    Parameters
    ----------
    motion : PrescribedRun
        Ready, and all driven.
    times : Array, shape (k,)
        In the order in which they are met [s].
    crosses : bool
        Whether it goes over singular positions.
    """

    motion: PrescribedRun
    times: Array
    crosses: bool = True
    passages: list[Passage] = field(default_factory=list)

    def __post_init__(self) -> None:
        compiled, start = self.motion.compiled, self.motion.start
        info, model = compiled.info, compiled.model
        self.compiled, self.info, self.p, self.w = compiled, info, start.p, start.w.copy()
        self.span = max(float(np.abs(self.times).max()), 1e-9)
        self.times, self.requested = refine_times(self.times)
        sections = (info.sections[name][0] for name in ("residual", "change", "mask", "jacobian"))
        length = float(self.w[abi.LENGTH])
        numbers = (info.nq, info.nv, info.m, info.ny, info.windings, *sections, len(start.redundant_rows), info.nv)
        scale = np.array([1.0 if v.unit == "rad/s" else 1.0 / length for v in info.velocities])
        self.spun = {i for first, _ in info.spins for i in range(first, first + 4)}
        self.sizes = [
            1.0 / length if i in self.spun else scale[velocity_of_coordinate(i, info)] for i in range(info.nq)
        ]
        coarse = float(
            np.abs(start.y[: info.nq] * marks_of_lengths(info)).max(initial=0.0)
        )  # what positions can resolve
        tolerance = decisions.ROUNDING * max(length, coarse) * max(info.m, 1)
        least = LEAST if self.crosses else SHORT
        self.course = f.Course._make((*numbers, tolerance, least * self.span, *entries_of(info), scale))
        move = model.move if info.nq != info.nv else compiled_form(turn_nothing)
        self.functions = model.geometry, model.measure, move, model.spread, model.observe
        self.control = np.zeros(abi.N_CONTROL, dtype=np.int64)
        rows = info.observed
        self.stand = f.Stand(
            *(start.y.copy(), np.zeros(info.nv), np.zeros(info.nv), np.zeros(f.N_CLOCK)),
            *(np.zeros(f.N_COUNTS, dtype=np.int64), np.zeros(info.ny), np.zeros(info.ny), np.zeros(rows)),
            *(self.w[abi.WINDING : abi.WINDING + info.windings].copy(), np.zeros(info.nv**2)),
        )
        self.stand.clock[f.REACH] = self.span
        self.sign = -1.0 if self.times[-1] < 0.0 else 1.0
        self._choose: Callable[[Array], bool] | None = row_chooser(compiled) if start.redundant_rows else None

    @property
    def clock(self) -> Array:
        """Time, sine and the like, see `symgen.run.loops.following`."""
        clock: Array = self.stand.clock
        return clock

    # -- the loop ------------------------------------------------------------------------------------------------------

    def run(self) -> Traced:
        """Follow the motion through all times, or to its end."""
        info, k = self.info, len(self.times)
        rows = f.Followed(np.empty((k, info.ny)), np.empty((k, info.nv)), np.empty((k, abi.N_STATUS + info.windings)))
        ended = ""
        while True:
            # in pieces, between which the process can be interrupted
            done = min(int(self.stand.counts[f.AT]) + PIECE, k)
            code = self.enter_loop(self.times[:done], rows)
            if code == f.DONE:
                if done == k:
                    break
                continue
            if self._choose_rows_anew():
                continue
            if code == f.CHOOSE:  # the same ones
                self.clock[f.BEST] = self.clock[f.SINE]
                continue
            crossed = self._cross_singularity(code, rows) if code in (f.SINGULAR, f.PASSING) else False
            if not crossed and not self._shorten_step(code):
                ended = self._reason_of_end(code)
                break
        if not ended and self.clock[f.SINE] < NEAR and np.isfinite(self.clock[f.SLOPE]):
            self._cross_singularity(f.DONE, rows)  # the last states are near a singular position
        n = int(self.stand.counts[f.AT])
        taken = int(self.stand.counts[f.TAKEN])
        here: Any = slice(n) if self.requested.all() else np.flatnonzero(self.requested[:n])
        moved = self.times[here], rows.states[here], rows.accelerations[here]
        return Traced(*moved, rows.status[here], (*self.passages,), ended, taken)

    def enter_loop(self, times: Array, rows: Any) -> int:
        """Enter the compiled loop."""
        here = np.ascontiguousarray(times)
        model = self.course, *self.functions
        return int(f.follow_motion(model, here, self.p, self.w, self.stand, rows, self.control))

    def _shorten_step(self, code: int) -> bool:
        """Take shorter steps from here on; return whether they are long enough to be taken."""
        if code in (f.REFUSED, f.UNDEFINED):
            return False
        self.clock[f.REACH] = 0.5 * abs(self.clock[f.TRIED] - self.clock[f.TIME])
        return bool(self.clock[f.REACH] >= self.course.least)

    def _choose_rows_anew(self) -> bool:
        """Choose the rows that represent all at the present position; return whether they are others."""
        if self._choose is None:
            return False
        Ready(self.functions[0], abi.MEASURE)(self.clock[f.TIME], self.stand.y, self.p, self.w)
        if not self._choose(self.w):
            return False
        self.stand.counts[f.SETTLED], self.clock[f.REACH] = 0, self.span
        return True

    # -- states near a singular position -------------------------------------------------------------------------------

    def _copy_stand(self) -> tuple[Array, ...]:
        return tuple(array.copy() for array in self.stand)

    def _restore_stand(self, copies: tuple[Array, ...]) -> None:
        for array, before in zip(self.stand, copies, strict=True):
            array[:] = before

    def _go_to(self, t: float) -> bool:
        """Go to a time beside the present one, forward or backward; return whether that went well."""
        if t == self.clock[f.TIME]:
            return True
        nothing = f.Followed(np.empty((1, self.info.ny)), np.empty((1, self.info.nv)), self._status_row())
        at, self.stand.counts[f.AT] = int(self.stand.counts[f.AT]), 0
        self.clock[f.REACH] = self.span
        while (code := self.enter_loop(np.array([t]), nothing)) == f.CHOOSE:
            self.clock[f.BEST] = self.clock[f.SINE]  # rows stay those that they are
        self.stand.counts[f.AT] = at
        return code == f.DONE

    def _status_row(self) -> Array:
        return np.empty((1, abi.N_STATUS + self.info.windings))

    def _cross_singularity(self, code: int, rows: object) -> bool:
        """Go over a singular position ahead, on the branch that continues the motion; return whether there is one."""
        if not self.crosses:
            return False
        before, clock = self._copy_stand(), self.clock.copy()
        elapsed = abs(clock[f.TRIED] - clock[f.TIME])
        if code == f.PASSING:
            slope = (clock[f.SINE] + clock[f.TRIED_SINE]) / elapsed
        else:
            slope = clock[f.SINE] / elapsed if code == f.SINGULAR else clock[f.SLOPE]
        if not (slope > 0.0 and np.isfinite(slope)):
            return False
        middle = clock[f.TIME] + self.sign * clock[f.SINE] / slope
        for attempt in range(ATTEMPTS):
            width = max(SPACING / slope / 2.0**attempt, abs(middle - clock[f.TIME]))
            if self._go_over_singularity(middle, width, rows):
                return True
            self._restore_stand(before)
        return False

    def _go_over_singularity(self, middle: float, width: float, rows: object) -> bool:
        """Go over a singular position near `middle` from states before it to states after it, `width` apart [s]."""
        nodes = list[tuple[Array, ...]]()
        for k in range(1, NODES + 1):
            if not self._go_to(middle - self.sign * k * width):
                return False
            nodes.append(self._state_of_loop())
        guess = curve_through(self.info, nodes)
        t = middle + self.sign * width
        y, a, _ = guess(np.array([t]))
        self.stand.y[:], self.stand.a[:], self.stand.jerk[:] = y[0], a[0], 0.0
        self.clock[f.TIME], self.stand.counts[f.SETTLED] = t, 0
        nothing = f.Followed(np.empty((0, self.info.ny)), np.empty((0, self.info.nv)), self._status_row()[:0])
        if self.enter_loop(np.zeros(0), nothing) != f.DONE:
            return False
        far = np.abs(self.stand.y - y[0])[: self.info.nq] * self.sizes
        if not far.max() <= CONTINUED * self.clock[f.SINE]:
            return False
        behind = self._copy_stand()
        for k in range(1, NODES + 1):
            if not self._go_to(middle + self.sign * k * width):
                return False
            nodes.append(self._state_of_loop())
        nodes.sort(key=lambda node: float(node[0][0]))
        curve = curve_through(self.info, nodes)
        self._restore_stand(behind)
        t = self._find_sign_change(curve, middle, width)
        self.passages.append(self._make_passage(t, "passed", curve))
        self._write_outputs(curve, middle - self.sign * width, middle + self.sign * width, rows)
        self.clock[f.REACH] = self.span
        return True

    def _state_of_loop(self) -> tuple[Array, ...]:
        """Return time, q, q', v, v', angles that count turns, and the sine, where the loop is."""
        nq, nv, s = self.info.nq, self.info.nv, self.stand
        q, v = s.y[:nq].copy(), s.y[nq : nq + nv].copy()
        now = np.array([self.clock[f.TIME]]), q, coordinate_rates(self.info, q, v), v, s.a.copy(), s.turned.copy()
        return (*now, np.array([self.clock[f.SINE]]))

    def _write_outputs(self, curve: Curve, first: float, last: float, rows: Any) -> None:
        """Write the outputs between two times from a curve, and go on after them."""
        here = np.flatnonzero((self.sign * (self.times - first) > 0.0) & (self.sign * (self.times - last) < 0.0))
        geometry, measure = (Ready(function, abi.MEASURE) for function in self.functions[:2])
        if len(here):
            states, rates, turned = curve(self.times[here])
            rows.states[here], rows.accelerations[here] = states, rates
            w, count = self.w.copy(), self.info.windings
            for k, y, turns in zip(here, states, turned, strict=True):
                w[abi.WINDING : abi.WINDING + count] = turns
                geometry(float(self.times[k]), y, self.p, w)
                measure(float(self.times[k]), y, self.p, w)
                rows.status[k] = np.append(w[: abi.N_STATUS], w[abi.WINDING : abi.WINDING + count])
        self.stand.counts[f.AT] = int(np.count_nonzero(self.sign * (self.times - last) < 0.0))

    def _find_sign_change(self, curve: Curve, middle: float, width: float) -> float:
        """Return where the determinant of D changes its sign, near `middle`."""
        from scipy.optimize import bisect

        def sign_of_determinant(t: float) -> float:
            y, _, _ = curve(np.array([t]))
            d = jacobian_at(self.compiled, t, y[0], self.p, self.w)
            return float(np.linalg.slogdet(d[self.compiled.section(self.w, "mask") == 0.0])[0])

        if sign_of_determinant(middle - width) == sign_of_determinant(middle + width):
            return middle
        return float(bisect(sign_of_determinant, middle - width, middle + width, xtol=1e-300, maxiter=60, disp=False))

    # -- words ---------------------------------------------------------------------------------------------------------

    def _make_passage(self, t: float, kind: str, curve: Curve | None) -> Passage:
        """Return a singular position: of the curve there, or where the loop is."""
        y = self.stand.y if curve is None else curve(np.array([t]))[0][0]
        free, drivers = free_and_held(self.motion.mechanism, self.compiled, t, y, self.p, self.w)
        return Passage(float(t), kind, free, drivers)

    def _reason_of_end(self, code: int) -> str:
        """Return the reason why the motion ends, in a sentence."""
        t, sine, slope, least = self.clock[f.TIME], self.clock[f.SINE], self.clock[f.SLOPE], self.course.least
        if code == f.UNDEFINED:
            return f"a formula is not finite after t = {t:.9g} s"
        if sine < SPACING:
            rest = 0.5 * sine / slope if slope > 0.0 and np.isfinite(slope) else 0.0  # its square falls to 0
            passage = self._make_passage(t + self.sign * rest, "dead centre", None)
            self.passages.append(passage)
            return passage.words
        # rows that are open a moment later although nothing has moved; the last attempt was nearer
        w = self.w.copy()
        Ready(self.functions[0], abi.MEASURE)(float(t) + self.sign * 2.0 * least, self.stand.y.copy(), self.p, w)
        sizes = np.array([float(w[abi.LENGTH]) if row.unit == "m" else 1.0 for row in self.info.rows])
        jumps = np.flatnonzero(np.abs(self.compiled.section(w, "residual")) > JUMP * sizes)
        if len(jumps):
            who = ", ".join(dict.fromkeys(f"'{self.info.rows[i].joint}'" for i in jumps))
            long = f"or goes too far in {least:.3g} s, the shortest step of so long a motion"
            return f"the value of {who} jumps at t = {t:.9g} s, {long}"
        return f"no position near the last one closes the mechanism after t = {t:.9g} s"

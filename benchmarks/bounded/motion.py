"""Motions from event to event: DOP853 of SciPy, all roots of what ends a mode, and the rules of what follows."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray
from scipy.integrate import DOP853
from scipy.optimize import brentq, minimize_scalar

from benchmarks.bounded.forms import AT_REST, LOWER, UPPER, Forms, Modes, NoForces
from benchmarks.bounded.rows import Bounded
from benchmarks.bounded.tree import Array, Tree

#: Values of functions at each step, and steps before the first of these in which what has just begun is looked at.
SAMPLES, EARLY = 10, 14
LONGEST = 0.04
#: A function that begins at zero counts once it is above this; it must not fall to minus a thousand times this before.
ARMED = 1e-14
#: So many impacts of a coordinate within this time, with this rate, are at rest.
CROWD, SOON, SLOW = 4, 1e-3, 1e-5
MOST_EVENTS = 3000

#: Booleans.
Flags = NDArray[np.bool_]


class Unusable(Exception):
    """The simulation cannot say how a mechanism moves."""


@dataclass(frozen=True)
class Event:
    """What happened to a coordinate: ``hit``, ``rest``, ``break``."""

    t: float
    name: str
    kind: str


@dataclass
class Motion:
    """A motion at its output times.

    Attributes
    ----------
    t, u, v : lists
        Times, coordinates and rates.
    events : list of Event
        In their order.
    narrowest : float
        The smallest singular value of the closures on the way.
    """

    t: list[float] = field(default_factory=list)
    u: list[Array] = field(default_factory=list)
    v: list[Array] = field(default_factory=list)
    events: list[Event] = field(default_factory=list)
    narrowest: float = math.inf


@dataclass(frozen=True, eq=False)
class _Watched:
    """A function that ends a mode where it falls to zero."""

    row: int
    kind: str
    modes: Modes

    def of(self, forms: Forms) -> float:
        """Return its value."""
        i = self.row
        if self.kind == "corner":
            return forms.others[i]
        if self.kind == "break":
            return float(forms.margins(self.modes)[i])
        if self.kind == "rest":
            return float(self.modes.signs[i] * forms.rates[i])
        value, row = float(forms.values[i]), forms.rows[i]
        return value - row.lower if self.kind == "lower.hit" else row.upper - value


class Simulation:
    """A mechanism with bounded coordinates, ready to move."""

    def __init__(self, tree: Tree, rows: Sequence[Bounded], rtol: float = 1e-12, atol: float = 1e-13) -> None:
        self.tree, self.rows, self.rtol, self.atol = tree, tuple(rows), rtol, atol
        self.pieces = dict[int, int]()  # those that hold closed rows with corners

    def forms(self, t: float, y: Array) -> Forms:
        """Return the equations at a state."""
        n = self.tree.n
        return Forms(self.tree, self.rows, t, y[:n], y[n:], self.pieces)

    def run(self, u: Array, v: Array, times: Sequence[float]) -> Motion:
        """Return the motion from a start that satisfies all closures, at rising times from 0.

        Raises
        ------
        Unusable
            If there are too many events, or no modes.
        """
        motion = Motion()
        try:
            return self._run(motion, np.concatenate([u, v]), list(times))
        except (NoForces, np.linalg.LinAlgError) as error:
            raise Unusable(str(error)) from error

    def _run(self, motion: Motion, y: Array, times: list[float]) -> Motion:
        t = 0.0
        modes, y = self._begin(t, y, set(), set(), motion)
        while True:
            t, y, happened = self._segment(motion, t, y, modes, times)
            if not happened:
                return motion
            if len(motion.events) > MOST_EVENTS:
                raise Unusable(f"{len(motion.events)} events by {t:.6g} s")
            for watched in happened:
                motion.events.append(Event(t, self.rows[watched.row].name, watched.kind))
            hits = {w.row: LOWER if w.kind == "lower.hit" else UPPER for w in happened if w.kind.endswith("hit")}
            resting = {w.row for w in happened if w.kind == "rest"}
            y = self._placed(t, y, modes, hits, resting)
            corners = [w.row for w in happened if w.kind == "corner"]
            for i in corners:
                self.pieces[i] = 1 - self.pieces[i]
            broken = {w.row for w in happened if w.kind == "break"}
            if broken and not self.forms(t, y).independent(modes.resting):
                broken = set(modes.resting)
            modes, y = self._begin(t, y, broken, set(hits), motion)

    def _begin(self, t: float, y: Array, broken: set[int], hits: set[int], motion: Motion) -> tuple[Modes, Array]:
        """Return modes and state behind an event."""
        forms = self.forms(t, y)
        struck = False
        for _ in range(50):
            behind = forms.struck({i for i in hits if self._crowded(motion, i, t, forms)})
            if behind is None:
                break
            struck, y = True, np.concatenate([y[: self.tree.n], behind])
            forms = self.forms(t, y)
        else:
            raise Unusable(f"impacts do not end at {t:.6g} s")
        for i in self.pieces:
            if struck and forms.others[i] < 1e-9:
                self._refuse_two_pieces(t, y, i)
        modes = forms.choose(set() if struck else broken)
        self._keep_pieces(t, y, modes)
        return modes, self._projected(t, y, modes, {}, set())

    def _keep_pieces(self, t: float, y: Array, modes: Modes) -> None:
        """Keep the pieces of closed rows until a corner, and let those of open ones go."""
        values = {
            i: [float(piece(self.forms(t, y).state).value) for piece in row.pieces]
            for i, row in enumerate(self.rows)
            if row.pieces and modes.held[i]
        }
        self.pieces = {i: self.pieces.get(i, int(np.argmax(x))) for i, x in values.items()}

    def _refuse_two_pieces(self, t: float, y: Array, i: int) -> None:
        """Raise where an impact at a corner sends the motion back over it."""
        forms, row = self.forms(t, y), self.rows[i]
        rates = [float(m.slopes @ forms.v) + m.drift for m in (piece(forms.state) for piece in row.pieces)]
        if rates[self.pieces[i]] < rates[1 - self.pieces[i]] - 1e-12:
            raise Unusable(f"two pieces push at {t:.6g} s")

    def _crowded(self, motion: Motion, row: int, t: float, forms: Forms) -> bool:
        name = self.rows[row].name
        recent = sum(1 for e in motion.events if e.name == name and e.kind.endswith("hit") and t - e.t < SOON)
        return recent >= CROWD and abs(forms.rates[row]) < SLOW

    # -- projections ---------------------------------------------------------------------------------------------------

    def _placed(self, t: float, y: Array, modes: Modes, hits: dict[int, int], resting: set[int]) -> Array:
        """Return the state at an event, on all that it meets."""
        y = self._projected(t, y, modes, hits, set())
        for _ in range(len(self.rows)):
            forms = self.forms(t, y)
            more = {i for i, row in enumerate(self.rows) if row.rubs and abs(forms.rates[i]) < 1e-9}
            if more <= resting:
                break
            resting = resting | more
        return self._projected(t, y, modes, hits, resting)

    def _projected(self, t: float, y: Array, modes: Modes, hits: dict[int, int], resting: set[int]) -> Array:
        """Return a state that closes loops, holds what is held, lies on the stops hit, and has no rates at rest."""
        n = self.tree.n
        held = modes.resting
        if not (self.tree.closures or held or hits or resting):
            return y
        u, v = y[:n].copy(), y[n:].copy()
        at = {i: modes.at[i] for i in held}
        at |= {i: self.rows[i].lower if side == LOWER else self.rows[i].upper for i, side in hits.items()}
        which = sorted(at)
        for _ in range(4):
            forms = Forms(self.tree, self.rows, t, u, v, self.pieces)
            gaps = np.concatenate([forms.closed[0], forms.values[which] - [at[i] for i in which]])
            slopes = np.vstack([forms.closed[1], forms.slopes[which]])
            if not len(gaps) or float(np.abs(gaps).max()) == 0.0:
                break
            u = u - np.linalg.pinv(slopes, rcond=1e-9) @ gaps
        forms = Forms(self.tree, self.rows, t, u, v, self.pieces)
        still = sorted(set(held) | resting)
        slopes = np.vstack([forms.closed[1], forms.slopes[still]])
        if len(slopes):
            drift = np.concatenate([np.zeros(len(forms.closed[1])), forms.drift[still]])
            inverse = np.linalg.pinv(slopes, rcond=1e-9)
            for _ in range(2):
                v = v - inverse @ (slopes @ v + drift)
        return np.concatenate([u, v])

    # -- between events ------------------------------------------------------------------------------------------------

    def _watch(self, modes: Modes) -> list[_Watched]:
        functions = []
        for i, row in enumerate(self.rows):
            if modes.held[i]:
                if row.rubs or modes.sides[i]:
                    functions.append(_Watched(i, "break", modes))
                if row.pieces:
                    functions.append(_Watched(i, "corner", modes))
                continue
            if modes.signs[i]:
                functions.append(_Watched(i, "rest", modes))
            if row.lower > -math.inf:
                functions.append(_Watched(i, "lower.hit", modes))
            if row.upper < math.inf:
                functions.append(_Watched(i, "upper.hit", modes))
        return functions

    def _segment(
        self, motion: Motion, t: float, y: Array, modes: Modes, times: list[float]
    ) -> tuple[float, Array, list[_Watched]]:
        """Return time and state at the next event, with what happened; at the end nothing."""
        n, end = self.tree.n, times[-1]

        def rate(t: float, y: Array) -> Array:
            return np.concatenate([y[n:], self.forms(t, y).accelerations(modes)[0]])

        functions = self._watch(modes)
        start = self.forms(t, y)
        motion.narrowest = min(motion.narrowest, start.narrowest)
        begun = np.array([w.of(start) for w in functions])
        armed = begun > 1e-9
        while len(motion.t) < len(times) and times[len(motion.t)] <= t:
            self._keep(motion, times[len(motion.t)], y)
        if t >= end:
            return t, y, []
        solver, first = DOP853(rate, t, y, end, rtol=self.rtol, atol=self.atol, max_step=LONGEST), True
        while solver.status == "running":
            before = solver.t
            message = solver.step()
            if message:
                raise Unusable(f"{message} at {solver.t:.6g} s")
            dense = solver.dense_output()
            found = self._first(functions, armed, dense, before, solver.t, first)
            until = found[0] if found else solver.t
            while len(motion.t) < len(times) and times[len(motion.t)] <= until:
                self._keep(motion, times[len(motion.t)], dense(times[len(motion.t)]))
            if found:
                return found[0], dense(found[0]), found[1]
            if modes.resting or self.tree.closures:
                solver.y = self._projected(solver.t, solver.y, modes, {}, set())
                solver.f = rate(solver.t, solver.y)
                motion.narrowest = min(motion.narrowest, self.forms(solver.t, solver.y).narrowest)
            first = False
        return solver.t, solver.y, []

    def _keep(self, motion: Motion, t: float, y: Array) -> None:
        motion.t.append(t)
        motion.u.append(y[: self.tree.n].copy())
        motion.v.append(y[self.tree.n :].copy())

    def _first(
        self,
        functions: list[_Watched],
        armed: Flags,
        dense: Callable[[float], Array],
        start: float,
        end: float,
        fresh: bool,
    ) -> tuple[float, list[_Watched]] | None:
        """Return the first root in a step with the functions that have it."""
        if not functions:
            return None
        samples = np.linspace(start, end, SAMPLES + 1)
        if fresh:
            early = start + (samples[1] - start) * 0.5 ** np.arange(EARLY, 0, -1)
            samples = np.concatenate([samples[:1], early[early > start], samples[1:]])
        forms = [self.forms(s, dense(s)) for s in samples]
        roots: list[tuple[float, _Watched]] = []
        for k, watched in enumerate(functions):
            values = [watched.of(f) for f in forms]
            at = self._root(watched, armed, k, list(samples), values, dense)
            if at is not None:
                roots.append((at, watched))
        if not roots:
            return None
        first = min(at for at, _ in roots)
        return first, [w for at, w in roots if at - first <= 1e-12 * max(1.0, first)]

    def _root(
        self,
        watched: _Watched,
        armed: Flags,
        k: int,
        samples: list[float],
        values: list[float],
        dense: Callable[[float], Array],
    ) -> float | None:
        def value(t: float) -> float:
            return watched.of(self.forms(t, dense(t)))

        for j in range(1, len(samples)):
            low, high = values[j - 1], values[j]
            if not armed[k]:
                if high > ARMED:
                    armed[k] = True
                elif high < -1e5 * ARMED:
                    name = self.rows[watched.row].name
                    raise Unusable(f"{watched.kind} of {name} begins below zero at {samples[0]:.9g} s: {high:.3g}")
                continue
            if low > 0.0 >= high:
                return float(brentq(value, samples[j - 1], samples[j], xtol=1e-15, rtol=1e-14))
            if j >= 2 and values[j - 2] > values[j - 1] < high and high > 0.0:
                dip = self._dip(value, samples[j - 2 : j + 1], values[j - 2 : j + 1])
                if dip is not None:
                    return dip
        return None

    @staticmethod
    def _dip(value: Callable[[float], float], samples: list[float], values: list[float]) -> float | None:
        """Return the first root of a function that dips below zero between two samples."""
        a, b, c = samples
        p = np.polyfit([a - b, 0.0, c - b], values, 2)
        if p[0] <= 0.0 or p[2] - p[1] ** 2 / (4.0 * p[0]) > 0.3 * values[1]:
            return None
        found = minimize_scalar(value, bounds=(a, c), method="bounded", options={"xatol": 1e-9 * (c - a) + 1e-13})
        if found.fun >= 0.0:
            return None
        return float(brentq(value, a, float(found.x), xtol=1e-15, rtol=1e-14))


__all__ = ["AT_REST", "Event", "Motion", "Simulation", "Unusable"]

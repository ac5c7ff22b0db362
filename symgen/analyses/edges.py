"""Where forces and outputs have no derivative: kinks, jumps, and roots that rise without bound, at a state.

Derivatives are those of one side of a kink there, 0 at a jump, and 0 or a huge number at the end of a root: right for
what touches or rests on one side, and not for all that a mechanism does near the state. Differences tell: what is left
of them beyond the derivative falls with the step for a smooth function, and does not otherwise, however short the step.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from symgen.analyses.reduced import Tangent
from symgen.analyses.subject import Subject
from symgen.compiling.linearised import Evaluated

if TYPE_CHECKING:
    from symgen.analyses.sparse import Sparse

Array = NDArray[np.float64]

#: Steps along a direction, as parts of the mechanism's length [m], of 1 rad, or of as much in a second.
STEPS = (1e-4, 1e-6, 1e-8)
#: What is left, over the step, grows from a larger to the next smaller one by their ratio to the power 1 - p where a
#: function goes with the power p: hundredfold at a jump, tenfold at a square root, not at a kink; a tenth is left of
#: p = 1.5.
KINK, ROOT, JUMP = 0.5, 2.0, 50.0
#: Slopes above that are those of roots at 0 (`symgen.vocabulary.functions.steepest`).
STEEP = 1e80
#: What is left that is below this part of a force, and of what its slopes say of 1 m or 1 rad, is rounding; what is to
#: be left with the shortest step is seen where it is as many times that.
ROUNDED, SEEN = 1e-11, 10.0


@dataclass(frozen=True)
class Way:
    """A way from a state on which functions are looked at.

    Attributes
    ----------
    what : str
        What changes on it, in the plural or quoted.
    several : bool
        Whether that is a plural.
    values : callable
        A part of the way -> the values there, shape (n,).
    base, slope : Array, shape (n,)
        The values at the state, and their derivatives along the way.
    sizes : Array, shape (n,)
        What differences of them are compared with.
    steep : Array of bool, shape (n,)
        Whether a derivative is one without bound.
    """

    what: str
    several: bool
    values: Callable[[float], Array]
    base: Array
    slope: Array
    sizes: Array
    steep: NDArray[np.bool_]

    def edge(self) -> tuple[int, str] | None:
        """Return which of the functions has most of an edge there, and what is to be said of it; None without any."""
        changes = "change" if self.several else "changes"
        for side in (1.0, -1.0):
            far, near, nearest = (np.abs(self._left(side * step)) / step for step in STEPS)
            counts = (near * STEPS[1] > self.sizes) & (near > KINK * far)
            # a root whose end is a little beside the state is one from afar only
            unseen = near * STEPS[2] <= SEEN * self.sizes
            counts &= unseen | (nearest > KINK * near)
            if not np.any(counts):
                continue
            k = int(np.argmax(np.where(counts, near / np.maximum(far, 1e-300), 0.0)))
            growth = near[k] / max(far[k], 1e-300)
            if growth > ROOT or self.steep[k]:
                how = "jumps" if growth > JUMP and not self.steep[k] else "rises without bound"
                return k, f"{how} with {self.what}, which its derivative does not tell"
            return k, f"has a kink where {self.what} {changes}, and counts with its slope on one side"
        return None

    def _left(self, step: float) -> Array:
        """Return what is left of a difference beyond the derivative."""
        return np.asarray(self.values(step) - self.base - self.slope * step)


def edges(subject: Subject, y: Array) -> tuple[str, ...]:
    """Return sentences about forces that have no derivative at a state.

    Parameters
    ----------
    subject : Subject
        The mechanism.
    y : Array
        The state.

    Returns
    -------
    tuple of str
        One for positions, one for velocities and one for each input, each with the coordinate that most is left along.
    """
    names = [v.name for v in subject.compiled.info.velocities]
    return _of_forces(names, _ways(subject, y))


def edges_of_large(sparse: Sparse, y: Array, lam: Array) -> tuple[str, ...]:
    """Return the same of a large mechanism at rest, whose joints carry multipliers."""
    nq, nv, base = sparse.pattern.nq, sparse.pattern.nv, sparse.forces(y, lam)[0]
    motion, _, _, stiffness, damping = sparse.matrices(y, lam)
    spans = np.ones(nv)  # as forces and matrices are over lengths of the mechanism and radians

    def positions(step: float) -> Array:
        return sparse.forces(sparse.moved(y, motion @ (step * _unlike(spans))), lam)[0]

    def velocities(step: float) -> Array:
        there = y.copy()
        there[nq : nq + nv] += step * sparse.spans * _unlike(spans)
        return sparse.forces(there, lam)[0]

    ways = (
        _way("positions", positions, base, stiffness, spans),
        _way("velocities", velocities, base, damping, spans),
    )
    return _of_forces([v.name for v in sparse.compiled.info.velocities], ways)


def edges_of_outputs(x: Tangent, names: Sequence[str]) -> tuple[str, ...]:
    """Return sentences about outputs that have no derivative at a state, for those of some names.

    They may read accelerations and what joints carry: everything moves as forces let it, to first order.
    """
    places, n = [x.subject.form.functions[name][0] for name in names], x.size
    if not places:
        return ()
    found = [x.function(place) for place in places]
    base, slopes = np.array([value for value, _ in found]), np.array([row for _, row in found])
    groups = {"positions": np.arange(x.positions), "velocities": np.arange(x.positions, n)}
    told = list[str]()
    for what, columns in groups.items():
        if not len(columns):
            continue
        along = np.zeros(slopes.shape[1])
        along[columns] = _unlike(np.ones(len(columns)))
        moved = np.abs(x.q @ along) if what == "positions" else np.abs(x.v @ along) / x.subject.spans
        along /= moved.max(initial=0.0) / (x.subject.length if what == "positions" else 1.0) or 1.0
        told += _of_outputs(names, _along_tangent(x, places, what, True, along, base, slopes))
    for k, name in enumerate(x.subject.inputs):
        along = np.zeros(slopes.shape[1])
        along[n + k] = 1.0
        told += _of_outputs(names, _along_tangent(x, places, f"'{name}'", False, along, base, slopes))
    return tuple(told)


def _of_forces(names: Sequence[str], ways: Sequence[Way] | Iterator[Way]) -> tuple[str, ...]:
    found = [edge for way in ways if (edge := way.edge())]
    return tuple(f"at this state the force along {names[k]} {said}" for k, said in found)


def _of_outputs(names: Sequence[str], way: Way) -> list[str]:
    edge = way.edge()
    return [f"at this state the output '{names[edge[0]]}' {edge[1]}"] if edge else []


def _ways(subject: Subject, y: Array) -> Iterator[Way]:
    """Yield positions, velocities and inputs of a state with the forces there."""
    e = subject.evaluated(y)
    base, motion, spans = e.value("balance"), e.by("motion", "v"), subject.spans

    def positions(step: float) -> Array:
        return subject.evaluated(subject.moved(y, motion @ (step * _unlike(spans)))).value("balance")

    def velocities(step: float) -> Array:
        there = y.copy()
        there[subject.nq : subject.nq + subject.nv] += step * _unlike(spans)
        return subject.evaluated(there).value("balance")

    yield _way("positions", positions, base, e.by("balance", "q") @ motion, spans)
    yield _way("velocities", velocities, base, e.by("balance", "v"), spans)
    for name in subject.inputs:
        place = _place(subject, name)
        yield _of_input(subject, y, e, name, place)


def _of_input(subject: Subject, y: Array, e: Evaluated, name: str, place: int) -> Way:
    def values(step: float) -> Array:
        return _given(subject, place, step).evaluated(y).value("balance")

    slope = e.by("balance", "p")[:, [place]]
    return replace(_way(f"'{name}'", values, e.value("balance"), slope, np.ones(1)), several=False)


def _way(what: str, values: Callable[[float], Array], base: Array, slope: Any, spans: Array) -> Way:
    """Return a way on which forces are looked at, each beside the largest of them."""
    sizes = ROUNDED * (np.abs(base).max(initial=0.0) + abs(slope) @ spans)
    steep = np.asarray(abs(slope) @ np.ones(slope.shape[1])) > STEEP
    return Way(what, True, values, base, np.asarray(slope @ _unlike(spans)), np.asarray(sizes), steep)


def _along_tangent(
    x: Tangent, places: Sequence[int], what: str, several: bool, along: Array, base: Array, slopes: Array
) -> Way:
    """Return a way on which outputs are looked at, each by itself."""
    subject, nq, nv = x.subject, x.subject.nq, x.subject.nv

    def values(step: float) -> Array:
        part, there = step * along, subject.moved(x.y, x.q @ (step * along))
        there[nq : nq + nv] += x.v @ part
        moved = subject
        for place, change in zip(x.inputs, part[x.size :], strict=True):
            moved = _given(moved, place, float(change)) if change else moved
        return moved.evaluated(there, x.a + x.rates @ part, x.lam + x.multipliers @ part, x.t).value("functions")[
            list(places)
        ]

    sizes = ROUNDED * (np.abs(base) + np.abs(slopes) @ np.abs(along))
    steep = np.abs(slopes).max(axis=1) > STEEP
    return Way(what, several, values, base, slopes @ along, sizes, steep)


def _unlike(spans: Array) -> Array:
    """Return changes of which no two are the same part of their spans, so that their distances change."""
    return np.asarray(spans * np.linspace(1.0, 0.5, len(spans)))


def _place(subject: Subject, name: str) -> int:
    return [p.name for p in subject.compiled.info.parameters].index(name)


def _given(subject: Subject, place: int, change: float) -> Subject:
    """Return the same with another value of an input."""
    p = subject.p.copy()
    p[place] += change
    subject.compiled.prepare(p)
    return replace(subject, p=p)

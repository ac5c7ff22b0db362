"""Whether the steps of a run, which its state alone chooses, are short enough for its directions as well."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    from symgen.result.evaluated import Evaluated

Array = NDArray[np.float64]

#: Estimated error of directions in a step over their size, in tolerances of the state (the larger of both), above which
#: a run is unverified. In the catalogue and random mechanisms estimates are below, unless derivatives are off by more
#: than 100 tolerances; near equilibria, where they are off by more than 1000, one of them is above.
DOUBTFUL = 300.0
#: A direction below this part of the values of a state over that of its number is rounding; the least such number, as a
#: part of 1, since a number near 0 is no measure of its own changes.
_ROUNDING, _LEAST = 1e-12, 1e-9


def errors_of_steps(evaluated: Evaluated) -> tuple[Array, Array] | None:
    """Return the largest estimated error of each direction in a step, over its size, and the end of that step [s].

    Sizes are the largest in the whole run, of bodies as well where these are carried by joints. Those of velocities are
    at least the rate at which coordinates pass through their size in the run: what stays at rest has no size but
    rounding. None where steps have no estimate.
    """
    course, run = evaluated.course, evaluated.run
    if (errors := course.errors) is None:
        return None
    info, duration, bodies = run.compiled.info, run.spec.until - run.start.t, evaluated.states()
    own = info if run.tree is None else run.tree.bodies.info
    sizes = np.maximum(errors.sizes, _largest_error(np.abs(bodies).max(axis=0, initial=0.0), own.nq, own.work))
    sizes[:, 1] = np.maximum(sizes[:, 1], sizes[:, 0] / duration)
    with np.errstate(invalid="ignore", divide="ignore"):
        parts = np.where((errors.errors > 0.0) & ~(sizes <= rounding_sizes(evaluated)), errors.errors / sizes, 0.0)
    parts[np.isnan(parts)] = np.inf
    worst = parts.argmax(axis=1)
    return parts.max(axis=1), errors.times[np.arange(len(worst)), worst]


def rounding_sizes(evaluated: Evaluated) -> Array:
    """Return the size up to which coordinates, velocities and auxiliary states of directions are rounding, (n, 3)."""
    run, info = evaluated.run, evaluated.run.compiled.info
    values = np.abs(np.vstack([run.start.y, evaluated.course.outcome.states])).max(axis=0)
    natural = _largest_error(values[:, np.newaxis], info.nq, info.work)
    natural[:, 1] = np.maximum(natural[:, 1], natural[:, 0] / (run.spec.until - run.start.t))
    slopes, p = evaluated.start.parameters(run.compiled), run.start.p
    share = np.abs(slopes[p != 0.0] / p[p != 0.0, np.newaxis]).max(axis=0, initial=0.0)
    return np.asarray(_ROUNDING * np.minimum(share, 1.0 / _LEAST)[:, np.newaxis] * natural)


def _largest_error(values: Array, nq: int, work: int) -> Array:
    """Return the largest of coordinates, velocities and auxiliary states without the work, shape (n, 3)."""
    parts = values[:nq], values[nq:work], values[work + 1 :]
    return np.stack([part.max(axis=0, initial=0.0) for part in parts], axis=1)

"""Floors with corners below random mechanisms: edges, at which ground falls away, and feet of ramps."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from benchmarks.bounded.draw import KINDS, Drawn, drawn
from benchmarks.bounded.rows import Bounded, Measure
from benchmarks.bounded.tree import Moving, Point, State

#: Least height over the ground at a start [m].
CLEAR = 0.01


def over_slope(point: Point, level: float, slope: float, foot: float) -> Measure:
    """Return the height of a point in the plane over ``level + slope (x - foot)``."""
    direction = np.array([-slope, 1.0, 0.0])

    def of(state: State) -> Moving:
        d = state.point(point)
        value = direction @ d.value - level + slope * foot
        return Moving(np.asarray(value), direction @ d.slopes, np.asarray(direction @ d.bias))

    return of


def cornered(kind: str, seed: int) -> Drawn:
    """Return a random mechanism in the plane over a floor with a corner, in place of its rope or floor."""
    mechanism = drawn(kind, seed)
    rng = np.random.default_rng([len(KINDS) + 1, KINDS.index(kind), seed])
    state = mechanism.tree.at(0.0, mechanism.u, mechanism.v)
    name, k = list(mechanism.bodies.items())[-1]
    centre, place = Point(k, np.zeros(3)), state.places[k]
    level = round(float(place[1]) - float(rng.uniform(0.01, 0.15)), 4)
    foot = round(float(place[0]) + float(rng.uniform(-0.15, 0.15)), 4)
    slope = round(float(rng.choice([-1.0, 1.0]) * rng.uniform(0.2, 1.5)), 4)
    e = float(rng.choice([0.0, 0.0, 0.3, 0.7]))
    edge = bool(rng.random() < 0.5)
    ramp = slope * (float(place[0]) - foot)
    above = float(place[1]) - level - (min(0.0, ramp) if edge else max(0.0, ramp))
    if above < CLEAR:  # the start lies over the ground
        level = round(level - (CLEAR - above), 4)
    flat, tilted = over_slope(centre, level, 0.0, 0.0), over_slope(centre, level, slope, foot)
    rows = [row for row in mechanism.rows if row.name not in ("rope", "floor")]
    raised = f"{name}.y - ({level!r})", f"{slope!r}*({name}.x - ({foot!r}))"
    # the least of two heights is over both pieces, the largest over one of them
    gap = f"{raised[0]} - {'min' if edge else 'max'}(0.0, {raised[1]})"
    if edge:
        rows.append(Bounded("hill", flat, lower=0.0, restitution=e, pieces=(flat, tilted)))
    else:
        rows += [Bounded("hill", piece, lower=0.0, restitution=e) for piece in (flat, tilted)]
    raw = {**mechanism.raw, "stops": {"hill": {"gap": gap, "restitution": e}}}
    features = (mechanism.features - {"rope", "floor", "winch", "rising floor"}) | {"edge" if edge else "valley"}
    return replace(mechanism, raw=raw, rows=tuple(rows), features=frozenset(features))

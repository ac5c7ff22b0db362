"""The way of a rope: straight parts between ends and eyelets, and arcs on sheaves whose neighbours are in their planes.

A sheave sees its neighbours in its own plane, where the rope leaves along the tangent; what moves out of the plane
counts in the length of the straight part. In the plane all sheaves share the directions of the ground.

A rope leaves a sheave whose arc has come to 0, and passes by until its straight part touches again. So a sheave has a
state of the mechanism, 1 while the rope is on it, else 0; parts of the way are weighed by these states, and events of
the arc change them (`symgen.describe.parts.passing_ropes`).
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterator, Sequence
from typing import NamedTuple

from symgen.base.vocabulary.expressions import (
    ONE,
    ZERO,
    Expr,
    Name,
    Number,
    Reading,
    call,
    difference,
    product,
    sum_of_terms,
)
from symgen.base.vocabulary.measures import GROUND, Bearing, Component, Direction, axes
from symgen.describe.formulas.evaluate import scalar_values
from symgen.describe.joints._beside_sheaves import neighbours, sheaves_at_start, start_formula
from symgen.describe.joints._stops_of_rope import (
    Placed,
    Stop,
    across,
    between,
    check_neighbours,
    placed_stop,
    product_of_vectors,
)
from symgen.describe.parts.passing_ropes import RopeSheave, name_of_state
from symgen.describe.parts.scope import Scope


class Way(NamedTuple):
    """The way of a rope: its length as a formula and at the start [m], and the sheaves that it may leave."""

    length: Expr
    start: float
    sheaves: tuple[RopeSheave, ...]


class _Leaving(NamedTuple):
    """Direction of a straight part in the plane of a sheave: formula and start, which are `beyond` it by an angle."""

    direction: Expr
    angle: float
    beyond: float


def way_of_rope(scope: Scope, stops: list[Stop]) -> Way:
    """Return the way over some stops.

    Raises
    ------
    InputError
        With the sheave whose neighbours are not in its plane, or with two stops that overlap.
    """
    numbers = scalar_values(scope.context.values)
    placed = [placed_stop(scope, numbers, stop) for stop in stops]
    for a, b in itertools.pairwise(placed):
        check_neighbours(scope, a, b)
    on = sheaves_at_start(numbers, placed)
    weights = [Name(name_of_state(scope.name, i)) if stop.is_sheave else ONE for i, stop in enumerate(stops)]
    kept = [i for i, wraps in enumerate(on) if wraps]
    parts = [
        _straight(f"rope{_label(i, k)}.", placed[i], placed[k], product(weights[i], weights[k], passing))
        for i, k, passing in _pairs(weights)
    ]
    length = sum(_length_of_straight(placed[i], placed[k]) for i, k in itertools.pairwise(kept))
    sheaves = list[RopeSheave]()
    for j, stop in enumerate(stops):
        if stop.is_sheave:
            turn, arc = _turn(placed, weights, on, j)
            parts.append(product(weights[j], stop.radius, turn))
            length += arc if on[j] else 0.0
            around = turn if placed[j].radius > 0.0 else call("neg", turn)
            sheaves.append(RopeSheave(scope.name, j, start_formula(scope, placed, on, j), around))
    return Way(sum_of_terms(*parts), length, tuple(sheaves))


def _pairs(weights: Sequence[Expr]) -> Iterator[tuple[int, int, Expr]]:
    """Yield stops that may follow each other, with the formula that is 1 where the rope passes by all between."""
    for i in range(len(weights)):
        passing: Expr = ONE
        for k in range(i + 1, len(weights)):
            yield i, k, passing
            if weights[k] == ONE:
                break
            passing = product(passing, call("sub", ONE, weights[k]))


def _label(i: int, k: int) -> str:
    """Return the number of a straight part: of the stop before it, and of the one after it if others are passed."""
    return f"{i}" if k == i + 1 else f"{i}to{k}"


def _turn(placed: Sequence[Placed], weights: Sequence[Expr], on: Sequence[bool], j: int) -> tuple[Expr, float]:
    """Return the angle that the rope turns by on a sheave, to the left: formula and length of the arc at the start."""
    here, come, go = placed[j], list[tuple[int, Expr, _Leaving]](), list[tuple[int, Expr, _Leaving]]()
    for i, k, passing in _pairs(weights):
        if k == j:
            weight = product(weights[i], passing)
            come.append((i, weight, _leaving(_label(i, k), here, placed[i], here, weight)))
        elif i == j:
            weight = product(weights[k], passing)
            go.append((k, weight, _leaving(_label(i, k), here, here, placed[k], weight)))
    way, turned = math.copysign(1.0, here.radius), dict[tuple[int, int], float]()
    for (i, _, a), (k, _, b) in itertools.product(come, go):
        turned[i, k] = b.angle - a.angle - a.beyond
    first = way * turned[neighbours(on, j)]
    start = first - math.tau * math.floor(first / math.tau) - (0.0 if on[j] else math.tau)
    constants = list[tuple[Expr, float]]()
    for (i, w, a), (k, u, _) in itertools.product(come, go):
        whole = round((way * turned[i, k] - start) / math.tau)  # turns beyond the arc: near where the way is
        constants.append((product(w, u), a.beyond + way * whole * math.tau))
    terms = [sum_of_terms(*(product(w, x.direction) for _, w, x in part)) for part in (go, come)]
    turn = difference(*terms)
    if len({value for _, value in constants}) == 1:
        more: Expr = Number(constants[0][1])
    else:
        more = sum_of_terms(*(product(w, Number(value)) for w, value in constants))
    return turn if more == ZERO else call("sub", turn, more), abs(here.radius) * start


def _length_of_straight(a: Placed, b: Placed) -> float:
    """Return the length of a straight part at the start."""
    _, side = across(a, a, b)
    return math.sqrt(max(math.dist(a.place, b.place) ** 2 - side**2, 0.0))


def _straight(name: str, a: Placed, b: Placed, weight: Expr) -> Expr:
    """Return the length of a straight part where its weight is 1, else 0.

    Centres are apart by l u + (r_b - r_a) n with n across u. Where the rope runs otherwise, l may be undefined.
    """
    square = _square(_components(name, a, b, axes(GROUND, len(a.stop.centre.point))))
    shift, _ = across(a, a, b)
    square = square if shift == ZERO else call("sub", square, product(shift, shift))
    if weight == ONE:
        return call("sqrt", square)
    return product(weight, call("sqrt", call("add", product(weight, square), call("sub", ONE, weight))))


def _leaving(label: str, here: Placed, a: Placed, b: Placed, weight: Expr) -> _Leaving:
    """Return the direction of a straight part from `a` to `b`, as one of them sees it; any where its weight is 0."""
    shift, side = across(here, a, b)
    name, start, end, beyond = f"rope{label}.", a, b, 0.0
    if here.stop.triad is None:
        x, y = axes(GROUND, 2)
    else:  # bearings in space start at the sheave: the rope runs against the one to where it comes from
        x, y = here.stop.triad.first, here.stop.triad.second
        name += "to." if here is a else "from."
        start, end, beyond = (a, b, 0.0) if here is a else (b, a, math.pi)
    direction: Expr = Reading(f"{name}angle", Bearing(start.stop.centre, end.stop.centre, x, y))
    if shift != ZERO:
        apart = call("sqrt", _square(_components(name, start, end, (x, y))))
        direction = call("sub", direction, call("asin", product(weight, call("div", shift, apart))))
    to = between(start, end)
    along = [product_of_vectors(to, e) for e in here.triad[:2]]
    sine = max(-1.0, min(side / math.hypot(*along), 1.0))  # stops that do not follow each other may overlap
    return _Leaving(direction, math.atan2(along[1], along[0]) - math.asin(sine), beyond)


def _components(name: str, a: Placed, b: Placed, directions: Sequence[Direction]) -> list[Expr]:
    """Return the components of the vector between two centres."""
    return [
        Reading(f"{name}{k}", Component(a.stop.centre, b.stop.centre, e))
        for k, e in zip("xyz", directions, strict=False)
    ]


def _square(components: list[Expr]) -> Expr:
    return sum_of_terms(*(call("mul", e, e) for e in components))

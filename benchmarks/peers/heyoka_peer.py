"""heyoka: Taylor series of high order, compiled by LLVM, of the equations in body angles.

heyoka derives and reduces nothing: the equations are put together here as expressions. Places are sums of arms turned
by one body angle each, so the mass matrix and the loop closures are written down directly; the mass matrix and the
matrix of the multipliers are factorised in straight-line code (L D L^T) and heyoka finds the common subexpressions.
Outputs are values of the step's own Taylor polynomial.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

import heyoka as hy
import numpy as np

from . import reference
from .measure import Measured, Row, best_of, row
from .models import GROUND, Array, Model, Point

NAME = "heyoka"
VERSION = str(hy.__version__)
TOLERANCES = tuple(10.0 ** (-k) for k in range(4, 19))
#: Code written out is 2 to 3 times as fast as heyoka's compact one and compiled for as long as the mechanism is large.
WRITTEN_OUT = 7
Matrix = list[list[Any]]
#: A place as arms: body -> local vector that this body's angle turns; the ground's is constant.
Place = dict[int, Point]


def rows(model: Model) -> Iterator[Row]:
    """Measure every tolerance.

    Parameters
    ----------
    model : Model
        The mechanism.

    Yields
    ------
    Row
        One result per setting.
    """
    truth = reference.angles(model)
    equations = right_hand_side(model)
    for tolerance in TOLERANCES:
        yield row(
            NAME,
            VERSION,
            f"Taylor {tolerance:.0e}",
            model.name,
            lambda tolerance=tolerance: _taylor(model, equations, tolerance, truth),
        )


def places(model: Model) -> list[Place]:
    """Give the centres of mass as sums of turned arms.

    Parameters
    ----------
    model : Model
        The mechanism.

    Returns
    -------
    list of dict
        One place a body.
    """
    centres: dict[int, Place] = {}
    for joint in model.tree()[0]:
        centres[joint.b] = _add(_world(centres, joint.a, joint.point_a), {joint.b: joint.point_b}, -1.0)
    return [centres[i] for i in range(len(model.bodies))]


def _world(centres: dict[int, Place] | Sequence[Place], body: int, point: Point) -> Place:
    return {GROUND: point} if body == GROUND else _add(centres[body], {body: point}, 1.0)


def _add(a: Place, b: Place, factor: float) -> Place:
    result = dict(a)
    for body, (x, y) in b.items():
        u, v = result.get(body, (0.0, 0.0))
        result[body] = (u + factor * x, v + factor * y)
    return {body: arm for body, arm in result.items() if arm != (0.0, 0.0)}


def right_hand_side(model: Model) -> list[tuple[Any, Any]]:
    """Put the equations of motion together.

    Parameters
    ----------
    model : Model
        The mechanism.

    Returns
    -------
    list of (variable, expression)
        As heyoka takes them: body angles, then rates.
    """
    count = len(model.bodies)
    q = [hy.make_vars(f"q{i}") for i in range(count)]
    v = [hy.make_vars(f"v{i}") for i in range(count)]
    cos, sin = [hy.cos(x) for x in q], [hy.sin(x) for x in q]

    def slope(body: int, arm: Point) -> tuple[Any, Any]:
        """Return the derivative of a turned arm by its angle."""
        x, y = arm
        return -(sin[body] * x) - cos[body] * y, cos[body] * x - sin[body] * y

    def bent(body: int, arm: Point) -> tuple[Any, Any]:
        """Return what the motion adds to the acceleration of a turned arm, without v'."""
        x, y = arm
        square = v[body] * v[body]
        return -(square * (cos[body] * x - sin[body] * y)), -(square * (sin[body] * x + cos[body] * y))

    centres = places(model)
    mass: Matrix = [[0.0] * count for _ in range(count)]
    force: list[Any] = [model.torques.get(i, 0.0) for i in range(count)]
    # sums of constants over the bodies first: what two angles share is one product of rotations
    pairs: dict[tuple[int, int], tuple[float, float]] = {}
    weights: dict[int, tuple[float, float]] = {}
    for body, place in zip(model.bodies, centres, strict=True):
        for k, (a, b) in place.items():
            if k == GROUND:
                continue
            u, w = weights.get(k, (0.0, 0.0))
            weights[k] = (u + body.mass * a, w + body.mass * b)
            for j, (c, d) in place.items():
                if j != GROUND:
                    x, y = pairs.get((k, j), (0.0, 0.0))
                    pairs[k, j] = (x + body.mass * (a * c + b * d), y + body.mass * (a * d - b * c))
    for k, body in enumerate(model.bodies):
        mass[k][k] = body.inertia + pairs.get((k, k), (0.0, 0.0))[0]
    for (k, j), (dot, cross) in pairs.items():
        if k == j:
            continue
        # R(qk) arm . R(qj) arm, and its derivative by qj: the apparent force of the rate of j on k
        c = cos[k] * cos[j] + sin[k] * sin[j]
        s = sin[j] * cos[k] - cos[j] * sin[k]
        if k > j:
            mass[k][j] = mass[j][k] = dot * c - cross * s
        force[k] = force[k] + v[j] * v[j] * (dot * s + cross * c)
    for k, arm in weights.items():
        force[k] = force[k] - model.gravity * slope(k, arm)[1] if model.gravity else force[k]
    for spring in model.springs:
        place = _add(_world(centres, spring.body, spring.point), {GROUND: spring.anchor}, -1.0)
        gap = [place.get(GROUND, (0.0, 0.0))[i] for i in (0, 1)]
        for k, (x, y) in place.items():
            if k != GROUND:
                gap = [gap[0] + cos[k] * x - sin[k] * y, gap[1] + sin[k] * x + cos[k] * y]
        length = hy.sqrt(gap[0] * gap[0] + gap[1] * gap[1])
        pull = -spring.stiffness * (length - spring.length) / length
        for k, arm in place.items():
            if k != GROUND:
                d = slope(k, arm)
                force[k] = force[k] + pull * (d[0] * gap[0] + d[1] * gap[1])
    constraints: Matrix = []
    target: list[Any] = []
    for joint in model.tree()[1]:
        gap_ = _add(_world(centres, joint.a, joint.point_a), _world(centres, joint.b, joint.point_b), -1.0)
        for axis in (0, 1):
            moving = {k: arm for k, arm in gap_.items() if k != GROUND}
            constraints.append([slope(k, moving[k])[axis] if k in moving else 0.0 for k in range(count)])
            target.append(-sum(bent(k, arm)[axis] for k, arm in moving.items()))
    factor = _factorise(mass)
    free = _solve(factor, force)
    spread = [_solve(factor, line) for line in constraints]
    schur = [[_dot(line, column) for column in spread] for line in constraints]
    rest = [_dot(line, free) - t for line, t in zip(constraints, target, strict=True)]
    multipliers = _solve(_factorise(schur), rest)
    rates = [
        free[k] - sum((column[k] * m for column, m in zip(spread, multipliers, strict=True)), 0.0) for k in range(count)
    ]
    return [*zip(q, v, strict=True), *zip(v, rates, strict=True)]


def _zero(x: Any) -> bool:
    return isinstance(x, float) and x == 0.0


def _times(a: Any, b: Any) -> Any:
    return 0.0 if _zero(a) or _zero(b) else a * b


def _dot(a: Sequence[Any], b: Sequence[Any]) -> Any:
    terms = [x for x in map(_times, a, b) if not _zero(x)]
    return sum(terms[1:], terms[0]) if terms else 0.0


def _factorise(matrix: Matrix) -> tuple[Matrix, list[Any]]:
    """Return L and D of a symmetric matrix, structural zeros kept."""
    size = len(matrix)
    lower: Matrix = [[0.0] * size for _ in range(size)]
    diagonal: list[Any] = []
    for j in range(size):
        pivot = matrix[j][j]
        for k in range(j):
            part = _times(_times(lower[j][k], lower[j][k]), diagonal[k])
            pivot = pivot if _zero(part) else pivot - part
        diagonal.append(pivot)
        for i in range(j + 1, size):
            entry = matrix[i][j]
            for k in range(j):
                part = _times(_times(lower[i][k], lower[j][k]), diagonal[k])
                entry = entry if _zero(part) else entry - part
            lower[i][j] = 0.0 if _zero(entry) else entry / pivot
    return lower, diagonal


def _solve(factor: tuple[Matrix, list[Any]], right: Sequence[Any]) -> list[Any]:
    lower, diagonal = factor
    x = list(right)
    for i in range(len(x)):
        for k in range(i):
            part = _times(lower[i][k], x[k])
            x[i] = x[i] if _zero(part) else x[i] - part
    x = [0.0 if _zero(e) else e / d for e, d in zip(x, diagonal, strict=True)]
    for i in reversed(range(len(x))):
        for k in range(i + 1, len(x)):
            part = _times(lower[k][i], x[k])
            x[i] = x[i] if _zero(part) else x[i] - part
    return x


def _taylor(model: Model, equations: list[tuple[Any, Any]], tolerance: float, truth: Array) -> Measured:
    """Run once for the error, then time; compilation does not count."""
    compact = len(model.bodies) > WRITTEN_OUT
    start = [b.angle for b in model.bodies] + [b.rate for b in model.bodies]
    integrator = hy.taylor_adaptive(equations, start, tol=tolerance, compact_mode=compact)
    grid, first = reference.sample_times(model), np.array(start)

    def loop() -> Any:
        integrator.time = 0.0
        integrator.state[:] = first
        return integrator.propagate_grid(grid)

    motion = loop()
    values = np.asarray(motion[-1])
    error = reference.largest_error(values[:, : len(model.bodies)], truth)
    if not np.isfinite(error):
        return 0.0, 0.0, 0.0, error
    return *best_of(loop), error

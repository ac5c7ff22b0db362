"""The index-3 augmented Lagrangian method with projections: trapezoidal rule in positions.

With ``v1 = 2/h d - v0`` and ``a1 = 4/h^2 d - 4/h v0 - a0``, d = q1 - q0 or in space the displacements and rotation
vectors of the bodies over the step, the equations of motion at the end of the step are solved for q1 with the leading
matrix ``W = M + h/2 C + h^2/4 (a D^T D + K)``, the multipliers being raised by a Phi in every iteration, in rows
without Phi by ``h/2 a (D v - nu)``, whose part of W is the same as v1 changes by 2/h times the change of q1. Then
velocities and accelerations are projected with the same matrix, ``W v = (W - h^2/4 a D^T D) v* + h^2/4 a D^T nu``,
iterated, since one pass leaves a residual. States of the file are unknowns beside the positions: the change of z is
``2/h`` times its unknown's change, as for v1; W treats both in the same way. Other auxiliary states follow by the
trapezoidal rule.

a of a row is the parameter times the mean mass and the row's weight: the matrix is conditioned alike at any size and
mass of a mechanism. The memory of a run holds the rates of the state and the multipliers.
"""

from __future__ import annotations

import math

from symgen.compile.loopcode.bare import part
from symgen.compile.loopcode.loop_instances import called
from symgen.compile.native.annotations import Array, Integers
from symgen.run.layout import abi
from symgen.run.layout.manifold import advance_coordinates
from symgen.run.layout.records import ModelSystem, Run, Span
from symgen.run.layout.scheme_records import PROJECTION, Projection
from symgen.run.loops import sparse
from symgen.run.loops.frame import loop
from symgen.run.loops.frame_parts import DIVERGED, TOO_LARGE, evaluate
from symgen.run.loops.sparse import multiply_sources, solve, turn_rows

_MOST_ITERATIONS = 100
#: h^2/4 a is at least this many times the largest mass: below, the iterations of short steps would not converge.
_LEAST_PENALTY = 1e3


@called
def factorise_trial(
    system: ModelSystem, scheme: Projection, run: Run, t: float, h: float, penalty: float, k: Array, shift: Array
) -> bool:
    """Factorise W at the trial state; return whether its factors had room."""
    quarter, factors = 0.25 * h * h, part(run.room, 0, 5)
    system.tangent(t, run.trial, k, run.p, run.w, scheme.slopes)
    for e in range(0, scheme.pulls.shape[0], 3):  # a of each row is `penalty` times its weight
        scheme.slopes[scheme.pulls[e + 2]] *= math.sqrt(run.w[system.sizes.row_weight + scheme.pulls[e]])
    factors[0], factors[1], factors[2], factors[3], factors[4] = 1.0, 0.5 * h, quarter, -quarter, quarter * penalty
    multiply_sources(scheme.plan, scheme.slopes)
    turn_rows(scheme.plan, scheme.slopes, shift)
    return sparse.prepare_pattern(scheme.plan, scheme.slopes, factors, scheme.numbers) >= 0


@called
def pull_back(
    factor: float, nv: int, forces: Integers, slopes: Array, weights: Array, rest: Array, at: int, right: Array
) -> None:
    """Set right = factor D^T times the residuals from index `at` of `rest`, by the weights of rows."""
    for i in range(nv):
        right[i] = 0.0
    for e in range(0, forces.shape[0], 3):
        weighed = math.sqrt(weights[forces[e]]) * rest[at + forces[e]]  # `slopes` have the other root
        right[forces[e + 1]] += factor * slopes[forces[e + 2]] * weighed


@called
def prepare(system: ModelSystem, scheme: Projection, span: Span, run: Run) -> None:
    """Store rates and multipliers at the start."""
    sizes, t = system.sizes, run.clock[abi.TIME]
    width = sizes.width
    evaluate(system, run, t, run.y, part(run.memory, 0, width))
    run.control[abi.EVALUATIONS] += 1
    for c in range(sizes.m):
        run.memory[width + c] = run.w[sizes.multipliers + c]


@called
def complete_trial(system: ModelSystem, run: Run, h: float, shift: Array, k: Array) -> None:
    """Set velocities and accelerations, states and their rates, from the changes of positions and states."""
    nq, nv, states, first = system.sizes.nq, system.sizes.nv, system.sizes.states, system.sizes.unknowns
    for i in range(nv):
        run.trial[nq + i] = 2.0 / h * shift[i] - run.y[nq + i]
        k[i] = run.trial[nq + i]
        k[nq + i] = 4.0 / (h * h) * shift[i] - 4.0 / h * run.y[nq + i] - run.memory[nq + i]
    for i in range(nv, nv + states):
        run.trial[nq + 1 + i] = run.y[nq + 1 + i] + 2.0 / h * shift[i]
        k[first - states - nv + i] = 4.0 / (h * h) * shift[i] - run.memory[nq + 1 + i]


def project(
    system: ModelSystem,
    scheme: Projection,
    run: Run,
    following: float,
    h: float,
    penalty: float,
    k: Array,
    rest: Array,
    right: Array,
    change: Array,
) -> None:
    """Project velocities, then accelerations, on the constraints; `rest`, `right` and `change` are working memory."""
    sizes = system.sizes
    nq, nv, m, n, count = sizes.nq, sizes.nv, sizes.m, sizes.unknowns, sizes.nv + sizes.states
    quarter, weights = 0.25 * h * h, part(run.w, sizes.row_weight, m)
    for i in range(nv, count):
        right[i] = 0.0
    for level in range(2):
        last = math.inf
        for _ in range(_MOST_ITERATIONS):
            for i in range(nv):
                k[i] = run.trial[nq + i]
            system.residual(following, run.trial, k, run.p, run.w, rest)
            run.control[abi.EVALUATIONS] += 1
            violation = 0.0
            for c in range(m):
                violation += rest[n + level * m + c] ** 2
            violation = math.sqrt(violation)
            if violation > 0.95 * last or violation == 0.0:
                break
            last = violation
            pull_back(quarter * penalty, nv, scheme.pulls, scheme.slopes, weights, rest, n + level * m, right)
            solve(scheme.plan, scheme.numbers, right, change)
            for i in range(nv):
                if level == 0:
                    run.trial[nq + i] -= change[i]
                else:
                    k[nq + i] -= change[i]


@called
def attempt(
    system: ModelSystem, scheme: Projection, span: Span, run: Run, t: float, following: float, h: float, between: bool
) -> float:
    """Solve for positions and multipliers, then project velocities and accelerations."""
    sizes = system.sizes
    nq, nv, m, width, count = sizes.nq, sizes.nv, sizes.m, sizes.width, sizes.nv + sizes.states
    n, first, quarter = sizes.unknowns, nq + nv, 0.25 * h * h
    k, rest = part(run.room, 8, n), part(run.room, 8 + n, n + 2 * m)
    at = 8 + 2 * n + 2 * m
    right, change = part(run.room, at, count), part(run.room, at + count, count)
    shift, held = part(run.room, at + 2 * count, count), part(run.room, at + 3 * count, m)
    rate = part(run.room, at + 3 * count + m, width)
    # the mean mass times the number of velocities is at least the largest mass
    penalty = max(run.p[scheme.penalty], _LEAST_PENALTY * nv / quarter) * run.w[abi.MEAN_MASS]
    for i in range(nv):
        shift[i] = h * run.y[nq + i] + 0.5 * h * h * run.memory[nq + i]
    for i in range(nv, count):
        shift[i] = 0.5 * h * h * run.memory[nq + 1 + i]
    advance_coordinates(system, run, shift, run.trial)
    for c in range(m):
        held[c] = k[first + c] = run.memory[width + c]
    last, fresh, converged = math.inf, True, False
    for iteration in range(_MOST_ITERATIONS):
        complete_trial(system, run, h, shift, k)
        system.residual(following, run.trial, k, run.p, run.w, rest)
        for c in range(m):
            weight = penalty * run.w[sizes.row_weight + c] * (0.5 * h if scheme.nonholonomic[c] > 0.0 else 1.0)
            if iteration > 0:
                held[c] += weight * rest[first + c]
            k[first + c] = held[c] + weight * rest[first + c]
        system.residual(following, run.trial, k, run.p, run.w, rest)
        run.control[abi.EVALUATIONS] += 2
        if fresh:
            if not factorise_trial(system, scheme, run, following, h, penalty, k, shift):
                return TOO_LARGE
            run.control[abi.JACOBIANS] += 1
            fresh = False
        for i in range(nv):
            right[i] = quarter * rest[nq + i]
        for i in range(nv, count):
            right[i] = quarter * rest[n - count + i]
        solve(scheme.plan, scheme.numbers, right, change)
        run.control[abi.NEWTON_ITERATIONS] += 1
        moved, total, violation = 0.0, 0.0, 0.0
        for i in range(nv):
            shift[i] -= change[i]
            moved += (run.metric[nq + i] * change[i]) ** 2
        for i in range(nv, count):  # of any unit
            shift[i] -= change[i]
            moved += (run.w[abi.LENGTH] * 2.0 / h * change[i] / (1.0 + abs(run.trial[nq + 1 + i]))) ** 2
        advance_coordinates(system, run, shift, run.trial)
        for i in range(nq):
            total += (run.scales[i] * run.trial[i]) ** 2
        for c in range(m):
            violation += (rest[first + c] * (0.5 * h if scheme.nonholonomic[c] > 0.0 else 1.0)) ** 2
        moved = max(math.sqrt(moved), math.sqrt(violation)) / (run.w[abi.LENGTH] * (1.0 + math.sqrt(total)))
        if not math.isfinite(moved):
            break
        if moved < 1e-14 or (moved > 0.5 * last and moved < 1e-11):
            converged = True
            break
        fresh = moved > 0.5 * last
        last = moved
    if not converged:
        return DIVERGED
    complete_trial(system, run, h, shift, k)
    if not factorise_trial(system, scheme, run, following, h, penalty, k, shift):
        return TOO_LARGE
    project(system, scheme, run, following, h, penalty, k, rest, right, change)
    # multipliers of the iteration belong to accelerations before their projection, of order 1: rates of auxiliary
    # states use those of the law
    evaluate(system, run, following, run.trial, rate)
    run.control[abi.EVALUATIONS] += 1
    for i in range(first, sizes.ny):
        if i == first or i > first + sizes.states:
            run.trial[i] = run.y[i] + 0.5 * h * (run.memory[i] + rate[i])
    for i in range(nv):  # the projection gives the accelerations
        rate[nq + i] = k[nq + i]
    return 0.0


def renew(system: ModelSystem, scheme: Projection, span: Span, run: Run, t: float, changed: bool) -> None:
    """Store rates and multipliers at the end of the step."""
    sizes = system.sizes
    nq, m, width = sizes.nq, sizes.m, sizes.width
    at = 8 + 2 * sizes.unknowns + 2 * m + 3 * (sizes.nv + sizes.states)
    for c in range(m):
        run.memory[width + c] = run.room[at + c]
    for i in range(nq, sizes.ny):
        run.memory[i] = run.room[at + m + i]


def memory(width: int, count: int, m: int, unknowns: int) -> tuple[int, int]:
    """Return the lengths of the memory of a run, and of the working memory of a step after the trial state.

    `count` is the number of velocities and states of the file.
    """
    return width + m, 8 + 2 * unknowns + 3 * m + 3 * count + width


_FUNCTIONS = "turn", "residual", "tangent"
constant = loop(__name__, "constant", PROJECTION, *_FUNCTIONS, prepare=prepare, attempt=attempt, renew=renew)

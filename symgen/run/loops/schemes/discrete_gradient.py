"""Discrete gradient: forces and D averaged along the path of a step, so that nothing but rounding changes the energy.

With the mean velocity ``V = v0 + h/2 A`` the step is the path q(s) that leaves q0 with the constant V, q1 its end, in
space by exponentials, and

- ``M A = mean of f(q(s), V) - mean of D(q(s))^T lambda`` over s from 0 to 1, ``v1 = v0 + h A``;
- ``Phi(q1) = 0``.

The mean of ``D V`` is the change of Phi over h, the mean of ``f V`` the fall of the potential, exactly, so that the
kinetic energy ``V M A h`` balances if M is constant. Means are sums of Gauss with five nodes: exact where D and f are
polynomials in s of degree 9, to rounding where a step turns bodies by less than half a radian. Rows without Phi hold on
the mean of the path.

The memory of a run holds A and lambda, with which the next iteration begins.
"""

from __future__ import annotations

import math

from symgen.compile.loopcode.bare import part
from symgen.compile.loopcode.loop_instances import called
from symgen.compile.loopcode.vectors import copied
from symgen.compile.native.annotations import Array
from symgen.run.layout import abi
from symgen.run.layout.manifold import advance_coordinates
from symgen.run.layout.records import ModelSystem, Run, Span
from symgen.run.layout.scheme_records import CONSTRAINED, ConstrainedStages
from symgen.run.loops.frame import loop
from symgen.run.loops.frame_parts import DIVERGED, TOO_LARGE
from symgen.run.loops.schemes.constrained import auxiliary_rates, factorise_stage, slopes_at, solve_stage, step_parts
from symgen.run.loops.schemes.rattle import prepare, renew

_MOST_ITERATIONS = 50
#: Nodes of Gauss on both sides of the middle, and weights of the middle and of these.
_INNER, _OUTER = 0.26923465505284155, 0.45308992296933193
_MIDDLE_WEIGHT, _INNER_WEIGHT, _OUTER_WEIGHT = 0.28444444444444444, 0.23931433524968324, 0.11846344252809454
_NODES = 5


def gauss_node(g: int) -> float:
    """Return node `g` of the five on the path from 0 to 1."""
    distance = _INNER if g == 1 or g == 3 else _OUTER
    return 0.5 if g == 2 else (0.5 - distance if g < 2 else 0.5 + distance)


def gauss_weight(g: int) -> float:
    """Return the weight of node `g`."""
    return _MIDDLE_WEIGHT if g == 2 else (_INNER_WEIGHT if g == 1 or g == 3 else _OUTER_WEIGHT)


@called
def follow_path(system: ModelSystem, run: Run, share: float, h: float, moved: Array, rates: Array, y: Array) -> None:
    """Move positions and auxiliary states of `y` by a share of the step, whose mean velocity `y` has."""
    sizes = system.sizes
    first = sizes.nq + sizes.nv
    for i in range(sizes.nv):
        moved[i] = share * h * y[sizes.nq + i]
    for i in range(first, sizes.ny):
        y[i] = run.y[i] + share * h * rates[i - first]
    advance_coordinates(system, run, moved, y)


@called
def attempt(
    system: ModelSystem,
    scheme: ConstrainedStages,
    span: Span,
    run: Run,
    t: float,
    following: float,
    h: float,
    between: bool,
) -> float:
    """Solve for the accelerations and the multipliers of a step."""
    sizes = system.sizes
    nq, nv, m, n, first, width = sizes.nq, sizes.nv, sizes.m, sizes.unknowns, sizes.nq + sizes.nv, sizes.width
    right, x, factors, k, rest, held, moved, further = step_parts(sizes, run.room)
    change, rates, now = part(further, 0, nv + m), part(further, nv + m, width), part(further, nv + m + width, width)
    copied(width, run.y, held)
    copied(width, run.y, run.trial)
    for i in range(n):
        k[i] = 0.0
    for i in range(sizes.ny - first):
        rates[i] = 0.0
    for i in range(nv + m):
        x[i] = run.memory[i]
    last, fresh, converged = math.inf, True, False
    for _ in range(_MOST_ITERATIONS):
        for i in range(nv):
            held[nq + i] = run.trial[nq + i] = run.y[nq + i] + 0.5 * h * x[i]
            k[nq + i] = x[i]
        for c in range(m):
            k[first + c] = x[nv + c]
        follow_path(system, run, 1.0, h, moved, rates, run.trial)
        if fresh:
            follow_path(system, run, 0.5, h, moved, rates, held)
            slopes_at(system, scheme, run, t + 0.5 * h, held, k, 0)
            slopes_at(system, scheme, run, following, run.trial, k, 1)
            if not factorise_stage(scheme, factors):
                return TOO_LARGE
            run.control[abi.JACOBIANS] += 1
            fresh = False
        system.residual(following, run.trial, k, run.p, run.w, rest)
        for c in range(m):
            right[nv + c] = 0.0 if scheme.nonholonomic[c] > 0.0 else 2.0 / (h * h) * rest[first + c]
        for i in range(nv):
            right[i] = 0.0
        drift = 0.0
        for i in range(sizes.ny - first):
            now[i] = 0.0
        for g in range(_NODES):
            node, weight = gauss_node(g), gauss_weight(g)
            follow_path(system, run, node, h, moved, rates, held)
            system.residual(t + node * h, held, k, run.p, run.w, rest)
            for i in range(nv):
                right[i] += weight * rest[nq + i]
            for c in range(m):
                if scheme.nonholonomic[c] > 0.0:
                    right[nv + c] += 2.0 / h * weight * rest[first + c]
            auxiliary_rates(system, run, rest, part(held, first, sizes.ny - first))
            for i in range(sizes.ny - first):
                now[i] += weight * held[first + i]
        for i in range(sizes.ny - first):
            # of any unit, as in implicit stages; the work, which no force reads, follows
            drift += (h * (now[i] - rates[i]) / (1.0 + abs(run.y[first + i]))) ** 2 if 0 < i <= sizes.states else 0.0
            rates[i] = now[i]
        run.control[abi.EVALUATIONS] += _NODES + 1
        solve_stage(system, scheme, run, right, change)
        run.control[abi.NEWTON_ITERATIONS] += 1
        size, total = 0.0, 0.0
        for i in range(nv + m):
            x[i] -= change[i]
        for i in range(nv):
            size += (run.metric[nq + i] * change[i]) ** 2
        for i in range(nq):
            total += (run.scales[i] * run.trial[i]) ** 2
        size = 0.5 * h * h * math.sqrt(size) / (run.w[abi.LENGTH] * (1.0 + math.sqrt(total))) + math.sqrt(drift)
        if not math.isfinite(size):
            break
        if size < 1e-17 or (size > 0.5 * last and size < 1e-12):
            converged = True
            break
        fresh, last = size > 0.05 * last, size
    if not converged:
        return DIVERGED
    for i in range(nv):
        run.trial[nq + i] = run.y[nq + i] + 0.5 * h * x[i]
    follow_path(system, run, 1.0, h, moved, rates, run.trial)
    for i in range(nv):
        run.trial[nq + i] = run.y[nq + i] + h * x[i]
    return 0.0


_FUNCTIONS = "turn", "residual", "tangent"
constant = loop(__name__, "constant", CONSTRAINED, *_FUNCTIONS, prepare=prepare, attempt=attempt, renew=renew)

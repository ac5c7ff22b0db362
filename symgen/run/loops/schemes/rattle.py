"""RATTLE: half a step of velocities with forces along D^T that put its end on Phi = 0, then the other half.

- ``V = v0 + h/2 A`` with ``M_0 A + D_0^T lambda = f(q0, V)``; q1 is q0 moved by h V, in space by the exponential, and
  lambda makes ``Phi(q1) = 0``, by Newton's iteration with D_1 M_0^-1 D_0^T (SHAKE);
- ``v1 = V + h/2 B`` with ``M_1 B + D_1^T mu = f(q1, V)`` and ``D_1 v1 = nu_1``.

Forces of both halves are evaluated at the same V, so that the second half is the first one of the step back: the scheme
is its own adjoint. Rows without Phi hold on the mean of both ends: ``D_0 V - nu_0 + D_1 V - nu_1 = 0``. Auxiliary
states, those of a file among them, follow by the trapezoidal rule, from a step of Euler's: where forces read them, the
scheme is no longer its own adjoint.

The memory of a run holds B and mu, with which the next iteration begins.
"""

from __future__ import annotations

import math

from symgen.compile.loopcode.bare import part
from symgen.compile.loopcode.loop_instances import called
from symgen.compile.loopcode.vectors import copied
from symgen.compile.native.annotations import Array
from symgen.run.layout import abi
from symgen.run.layout.manifold import advance_coordinates
from symgen.run.layout.records import ModelSystem, Run, Sizes, Span
from symgen.run.layout.scheme_records import CONSTRAINED, ConstrainedStages
from symgen.run.loops.frame import loop
from symgen.run.loops.frame_parts import DIVERGED, TOO_LARGE
from symgen.run.loops.schemes.constrained import (
    auxiliary_rates,
    carry_slopes,
    factorise_stage,
    slopes_at,
    solve_stage,
    step_parts,
)

_MOST_ITERATIONS = 50


@called
def prepare(system: ModelSystem, scheme: ConstrainedStages, span: Span, run: Run) -> None:
    """Set the stored accelerations and multipliers to 0."""
    for i in range(system.sizes.nv + system.sizes.m):
        run.memory[i] = 0.0


def relative_change(sizes: Sizes, run: Run, change: Array, h: float) -> float:
    """Return the change of positions in a step of `h` seconds by one of accelerations, over the size of positions."""
    size, total = 0.0, 0.0
    for i in range(sizes.nv):
        size += (run.metric[sizes.nq + i] * change[i]) ** 2
    for i in range(sizes.nq):
        total += (run.scales[i] * run.trial[i]) ** 2
    return float(0.5 * h * h * math.sqrt(size) / (run.w[abi.LENGTH] * (1.0 + math.sqrt(total))))


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
    """Solve for the multipliers of both halves of a step."""
    sizes = system.sizes
    nq, nv, m, n, first, width = sizes.nq, sizes.nv, sizes.m, sizes.unknowns, sizes.nq + sizes.nv, sizes.width
    right, x, factors, k, rest, held, moved, further = step_parts(sizes, run.room)
    change, beginning = part(further, 0, nv + m), part(further, nv + m, width)
    copied(width, run.y, held)
    copied(width, run.y, run.trial)
    for i in range(n):
        k[i] = 0.0
    for i in range(nv + m):
        x[i] = run.memory[i]
    last, fresh, converged = math.inf, True, False
    for _ in range(_MOST_ITERATIONS):
        for i in range(nv):
            held[nq + i] = run.trial[nq + i] = run.y[nq + i] + 0.5 * h * x[i]
            moved[i] = h * held[nq + i]
            k[nq + i] = x[i]
        for c in range(m):
            k[first + c] = x[nv + c]
        advance_coordinates(system, run, moved, run.trial)
        if fresh:
            slopes_at(system, scheme, run, t, held, k, 0)
            slopes_at(system, scheme, run, following, run.trial, k, 1)
            if not factorise_stage(scheme, factors):
                return TOO_LARGE
            run.control[abi.JACOBIANS] += 1
            fresh = False
        system.residual(following, run.trial, k, run.p, run.w, rest)
        for c in range(m):
            right[nv + c] = rest[first + c] / h if scheme.nonholonomic[c] > 0.0 else 2.0 / (h * h) * rest[first + c]
        system.residual(t, held, k, run.p, run.w, rest)
        for i in range(nv):
            right[i] = rest[nq + i]
        for c in range(m):
            if scheme.nonholonomic[c] > 0.0:
                right[nv + c] += rest[first + c] / h
        run.control[abi.EVALUATIONS] += 2
        solve_stage(system, scheme, run, right, change)
        run.control[abi.NEWTON_ITERATIONS] += 1
        for i in range(nv + m):
            x[i] -= change[i]
        size = relative_change(sizes, run, change, h)
        if not math.isfinite(size):
            break
        if size < 1e-17 or (size > 0.5 * last and size < 1e-12):
            converged = True
            break
        fresh, last = size > 0.05 * last, size
    if not converged:
        return DIVERGED
    auxiliary_rates(system, run, rest, part(beginning, first, sizes.ny - first))
    for i in range(first, sizes.ny):
        run.trial[i] = run.y[i] + h * beginning[i]
    for i in range(nv):
        run.trial[nq + i] = run.y[nq + i] + 0.5 * h * x[i]
        moved[i] = h * run.trial[nq + i]
    advance_coordinates(system, run, moved, run.trial)
    for i in range(n):
        k[i] = 0.0
    slopes_at(system, scheme, run, following, run.trial, k, 1)
    carry_slopes(scheme)
    if not factorise_stage(scheme, factors):
        return TOO_LARGE
    run.control[abi.JACOBIANS] += 1
    system.residual(following, run.trial, k, run.p, run.w, rest)
    for i in range(nv):
        right[i] = -rest[nq + i]
    for c in range(m):
        right[nv + c] = -2.0 / h * rest[n + c]
    solve_stage(system, scheme, run, right, x)
    for i in range(nv):
        k[nq + i] = x[i]
    for c in range(m):
        k[first + c] = x[nv + c]
    system.residual(following, run.trial, k, run.p, run.w, rest)
    run.control[abi.EVALUATIONS] += 2
    ended = part(held, first, sizes.ny - first)
    auxiliary_rates(system, run, rest, ended)
    for i in range(first, sizes.ny):
        run.trial[i] = run.y[i] + 0.5 * h * (beginning[i] + ended[i - first])
    for i in range(nv):
        run.trial[nq + i] += 0.5 * h * x[i]
    return 0.0


@called
def renew(system: ModelSystem, scheme: ConstrainedStages, span: Span, run: Run, t: float, changed: bool) -> None:
    """Store accelerations and multipliers at the end of the step."""
    for i in range(system.sizes.nv + system.sizes.m):
        run.memory[i] = run.room[i]


_FUNCTIONS = "turn", "residual", "tangent"
constant = loop(__name__, "constant", CONSTRAINED, *_FUNCTIONS, prepare=prepare, attempt=attempt, renew=renew)

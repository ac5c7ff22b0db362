"""Half-explicit Runge-Kutta schemes: forces of stage i are those at its beginning, its multipliers close the next one.

``V_(i+1) = v + h sum_j a_ij V'_j`` with ``M V'_i = f_i - D_i^T lambda_i`` and ``D_(i+1) V_(i+1) = nu_(i+1)``, the state
after the last stage being the end of the step. Positions come first, as they need velocities of earlier stages only;
bodies in space turn by exponentials (`symgen.run.loops.schemes.lie`), so that Euler parameters keep their length and
stages meet the constraints of the state.
"""

from __future__ import annotations

from symgen.compile.loopcode.bare import part
from symgen.compile.loopcode.loop_instances import called
from symgen.compile.loopcode.vectors import copied
from symgen.run.layout import abi
from symgen.run.layout.manifold import advance_coordinates
from symgen.run.layout.records import ModelSystem, Run, Span
from symgen.run.layout.scheme_records import CONSTRAINED, ConstrainedStages
from symgen.run.loops.frame import loop
from symgen.run.loops.frame_parts import TOO_LARGE
from symgen.run.loops.schemes.constrained import (
    auxiliary_rates,
    carry_slopes,
    factorise_stage,
    slopes_at,
    solve_stage,
    step_parts,
)
from symgen.run.loops.schemes.lie import exponential_rate


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
    """Try a step, stage by stage."""
    sizes, s_count = system.sizes, scheme.stages
    nq, nv, m, n, first, width = sizes.nq, sizes.nv, sizes.m, sizes.unknowns, sizes.nq + sizes.nv, sizes.width
    right, x, factors, k, rest, held, moved, further = step_parts(sizes, run.room)
    turning = part(further, 0, s_count * nv)
    rates = part(further, s_count * nv, s_count * width)  # of velocities and auxiliary states
    copied(width, run.y, run.trial)
    for i in range(nv):
        moved[i] = 0.0
    for i in range(n):
        k[i] = 0.0
    slopes_at(system, scheme, run, t, run.trial, k, 1)
    for s in range(s_count):
        now = t + scheme.c[s] * h
        after = following if scheme.c[s + 1] == 1.0 else t + scheme.c[s + 1] * h
        reach = h * scheme.a[s * s_count + s]
        carry_slopes(scheme)
        for i in range(n):
            k[i] = 0.0
        system.residual(now, run.trial, k, run.p, run.w, rest)
        for i in range(nv):
            right[i] = -rest[nq + i]
        copied(width, run.trial, held)
        exponential_rate(held, nq, moved, scheme.spins, nv, 0.0, part(turning, s * nv, nv))
        for i in range(nv):
            moved[i] = 0.0
            run.trial[nq + i] = run.y[nq + i]
        for j in range(s + 1):
            factor = h * scheme.a[s * s_count + j]
            for i in range(nv):
                moved[i] += factor * turning[j * nv + i]
                if j < s:
                    run.trial[nq + i] += factor * rates[j * width + nq + i]
        advance_coordinates(system, run, moved, run.trial)
        slopes_at(system, scheme, run, after, run.trial, k, 1)
        system.residual(after, run.trial, k, run.p, run.w, rest)
        for c in range(m):
            right[nv + c] = -rest[n + c] / reach
        if not factorise_stage(scheme, factors):
            return TOO_LARGE
        solve_stage(system, scheme, run, right, x)
        for i in range(nv):
            k[nq + i] = rates[s * width + nq + i] = x[i]
            run.trial[nq + i] += reach * x[i]
        for c in range(m):
            k[first + c] = x[nv + c]
        system.residual(now, held, k, run.p, run.w, rest)
        auxiliary_rates(system, run, rest, part(rates, s * width + first, sizes.ny - first))
        for i in range(first, sizes.ny):
            run.trial[i] = run.y[i]
            for j in range(s + 1):
                run.trial[i] += h * scheme.a[s * s_count + j] * rates[j * width + i]
    run.control[abi.EVALUATIONS] += 3 * s_count
    run.control[abi.JACOBIANS] += s_count
    return 0.0


_FUNCTIONS = "turn", "residual", "tangent"
constant = loop(__name__, "constant", CONSTRAINED, *_FUNCTIONS, attempt=attempt)

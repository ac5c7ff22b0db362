"""Linear system with M and D of explicit schemes whose stages meet constraints by forces along D^T."""

from __future__ import annotations

from typing import Any

from symgen.compile.loopcode.bare import part
from symgen.compile.native.annotations import Array
from symgen.run.layout.records import ModelSystem, Run, Sizes
from symgen.run.layout.scheme_records import ConstrainedStages, PartitionedStages
from symgen.run.loops import sparse
from symgen.run.loops.sparse import solve


def slopes_at(
    system: ModelSystem,
    scheme: ConstrainedStages | PartitionedStages,
    run: Run,
    t: float,
    y: Array,
    k: Array,
    place: int,
) -> None:
    """Write M and D at a state to the first (0) or the second (1) half of the sources of the plan."""
    count = scheme.slopes.shape[0] // 2
    system.tangent(t, y, k, run.p, run.w, part(scheme.slopes, place * count, count))


def carry_slopes(scheme: ConstrainedStages | PartitionedStages) -> None:
    """Copy M and D of the second half to the first one."""
    count = scheme.slopes.shape[0] // 2
    for i in range(count):
        scheme.slopes[i] = scheme.slopes[count + i]


def factorise_stage(scheme: ConstrainedStages | PartitionedStages, factors: Array) -> bool:
    """Factorise ``[M D^T; E 0]``; return whether its factors had room."""
    factors[0] = 1.0
    return sparse.prepare_pattern(scheme.plan, scheme.slopes, factors, scheme.numbers) >= 0


def solve_stage(
    system: ModelSystem, scheme: ConstrainedStages | PartitionedStages, run: Run, right: Array, x: Array
) -> None:
    """Solve for accelerations and multipliers x; multipliers of redundant rows are 0."""
    sizes = system.sizes
    for c in range(sizes.m):
        if run.w[sizes.mask + c] > 0.0:
            right[sizes.nv + c] = 0.0
    solve(scheme.plan, scheme.numbers, right, x)


def auxiliary_rates(system: ModelSystem, run: Run, rest: Array, rates: Array) -> None:
    """Write the rates of auxiliary states to `rates`; `rest` are the residuals with rates of 0 of the file's states."""
    sizes = system.sizes
    for i in range(rates.shape[0]):
        if 0 < i <= sizes.states:
            rates[i] = -rest[sizes.unknowns - sizes.states + i - 1]
        else:
            rates[i] = run.w[sizes.auxiliary + (i - sizes.states if i > 0 else 0)]


def step_parts(sizes: Sizes, room: Array) -> Any:
    """Return the working memory of a step in parts.

    Parameters
    ----------
    sizes : Sizes
        Sizes of the model.
    room : Array
        Working memory after the trial state, see `memory`.

    Returns
    -------
    right, x, factors : Array
        Right side and solution of the linear system, what its factorisation counts.
    k, rest : Array
        Unknowns of the descriptor form and its residuals.
    held, moved : Array
        Another state, and a change of positions.
    further : Array
        Room of the scheme's own.
    """
    n, unknowns, width = sizes.nv + sizes.m, sizes.unknowns, sizes.width
    right, x, factors = part(room, 0, n), part(room, n, n), part(room, 2 * n, 2)
    at = 2 * n + 2
    k, rest = part(room, at, unknowns), part(room, at + unknowns, unknowns + sizes.m)
    at += 2 * unknowns + sizes.m
    held, moved, end = part(room, at, width), part(room, at + width, sizes.nv), at + width + sizes.nv
    return right, x, factors, k, rest, held, moved, part(room, end, room.shape[0] - end)


def memory(width: int, nv: int, m: int, unknowns: int, stages: int) -> tuple[int, int]:
    """Return the lengths of the memory of a run, and of the working memory of a step after the trial state."""
    n = nv + m
    return n, 2 + 3 * n + 2 * unknowns + m + (stages + 2) * (nv + width)

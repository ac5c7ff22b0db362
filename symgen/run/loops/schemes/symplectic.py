"""The symplectic Euler scheme: velocities first, then positions by the new velocities, in space by the exponential."""

from __future__ import annotations

from symgen.compile.loopcode.bare import part
from symgen.run.layout import abi
from symgen.run.layout.manifold import advance_coordinates
from symgen.run.layout.records import ModelSystem, Run, Span
from symgen.run.layout.scheme_records import ROTATIONS, Rotations
from symgen.run.loops.frame import loop
from symgen.run.loops.frame_parts import evaluate


def attempt(
    system: ModelSystem, scheme: Rotations, span: Span, run: Run, t: float, following: float, h: float, between: bool
) -> float:
    """Try a step."""
    sizes = system.sizes
    nq, nv, width = sizes.nq, sizes.nv, sizes.width
    rate, moved = part(run.room, 0, width), part(run.room, width, nv)
    evaluate(system, run, t, run.y, rate)
    run.control[abi.EVALUATIONS] += 1
    for i in range(nq, sizes.ny):
        run.trial[i] = run.y[i] + h * rate[i]
    for i in range(nv):
        moved[i] = h * run.trial[nq + i]
    advance_coordinates(system, run, moved, run.trial)
    return 0.0


constant = loop(__name__, "constant", ROTATIONS, "turn", attempt=attempt)

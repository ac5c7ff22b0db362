"""Gauss's collocation with two nodes between symmetric projections.

The step leaves the constraints by vectors r and s, one number a row, and returns to them by the same vectors:

- from ``q0`` moved by ``D_0^+ r`` and ``v0 + D_0^+ s``, one step of collocation to q and v;
- ``q1`` is q moved by ``D_1^+ r``, ``v1 = v + D_1^+ s``, with D at q1; ``Phi(q1) = 0`` and ``D_1 v1 = nu_1``.

The same equations with the ends exchanged and -h, -r, -s are the step back: the projected scheme is its own adjoint, as
the collocation is. In space bodies are moved by the exponential; the collocation keeps the length of Euler parameters.
With ``share`` below 1 the step begins with that part of the moves; with 0 it is the usual projection after the step.

One iteration finds rates of the nodes, r and s together, and ends where changes no longer fall: rounding, which has no
sign, is then what is left. The memory of a run holds the last step and its solution, with which the next one begins.
"""

from __future__ import annotations

import math

from symgen.compile.loopcode.bare import part
from symgen.compile.loopcode.loop_instances import called
from symgen.compile.loopcode.vectors import copied
from symgen.compile.native.annotations import Array
from symgen.run.layout import abi
from symgen.run.layout.records import ModelSystem, Run, Span
from symgen.run.layout.scheme_records import SYMMETRIC, Symmetric
from symgen.run.loops.frame import loop
from symgen.run.loops.frame_parts import DIVERGED, evaluate

_MOST_ITERATIONS = 100
#: Changes below this part of the state are rounding; below the second, they are where they did not fall twice: moves
#: follow rates one iteration later, and velocities positions.
_ROUNDING, _NEARLY, _STALLS = 1e-16, 1e-10, 2
#: The nodes are the middle and this part of the step on both sides: sqrt(3) / 6.
_AWAY = 0.28867513459481287


@called
def move_along_constraints(system: ModelSystem, run: Run, y: Array) -> None:
    """Apply the section ``change`` to the positions of a state."""
    sizes = system.sizes
    if sizes.nq == sizes.nv:
        for i in range(sizes.nq):
            y[i] += run.w[sizes.change + i]
    else:
        system.turn(y, run.w)


@called
def set_change(system: ModelSystem, scheme: Symmetric, run: Run, share: float, rows: Array) -> None:
    """Set the section ``change`` to ``-D^+`` times a share of `rows`, with D where ``geometry`` was evaluated last."""
    for c in range(system.sizes.m):
        run.w[scheme.residual + c] = share * rows[c]
    scheme.spread(run.p, run.w)


def prepare(system: ModelSystem, scheme: Symmetric, span: Span, run: Run) -> None:
    """Forget the last step."""
    for i in range(run.memory.shape[0]):
        run.memory[i] = 0.0


@called
def attempt(
    system: ModelSystem, scheme: Symmetric, span: Span, run: Run, t: float, following: float, h: float, between: bool
) -> float:
    """Solve for the rates at both nodes and the moves at both ends."""
    sizes, length, w = system.sizes, run.memory.shape[0], run.w
    nq, nv, m, width, first = sizes.nq, sizes.nv, sizes.m, sizes.width, sizes.nq + sizes.nv
    unknown, share = part(run.room, 0, length), run.p[scheme.share]
    rates, gaps, slips = (
        part(unknown, 1, 2 * width),
        part(unknown, 1 + 2 * width, m),
        part(unknown, 1 + 2 * width + m, m),
    )
    shift, thrust = part(unknown, length - 2 * nv, nv), part(unknown, length - nv, nv)
    begun, inside = part(run.room, length, width), part(run.room, length + width, width)
    rate, last_step = part(run.room, length + 2 * width, width), run.memory[0]
    unknown[0] = h
    for i in range(1, length):
        unknown[i] = run.memory[i]
    if last_step == 0.0:
        evaluate(system, run, t, run.y, part(rates, 0, width))
        run.control[abi.EVALUATIONS] += 1
        copied(width, part(rates, 0, width), part(rates, width, width))
    else:  # rates along the straight line through those of the last step
        for i in range(width):
            slope = (rates[width + i] - rates[i]) / (2.0 * _AWAY)
            middle = 0.5 * (rates[i] + rates[width + i]) + slope * (0.5 + 0.5 * h / last_step)
            rates[i] = middle - slope * _AWAY * h / last_step
            rates[width + i] = middle + slope * _AWAY * h / last_step
    least, stalls, converged = math.inf, 0, False
    for _ in range(_MOST_ITERATIONS):
        copied(width, run.y, begun)
        if share > 0.0:
            scheme.geometry(t, run.y, run.p, w)
            set_change(system, scheme, run, share, gaps)
            move_along_constraints(system, run, begun)
            set_change(system, scheme, run, share, slips)
            for j in range(nv):
                begun[nq + j] += w[sizes.change + j]
        size = 0.0
        for s in range(2):
            own, across = 0.25 * h, (0.25 - _AWAY if s == 0 else 0.25 + _AWAY) * h
            for i in range(width):
                inside[i] = begun[i] + own * rates[s * width + i] + across * rates[(1 - s) * width + i]
            evaluate(system, run, t + (0.5 - _AWAY if s == 0 else 0.5 + _AWAY) * h, inside, rate)
            for i in range(sizes.ny):
                if i != first:  # the work, which no rate reads, follows
                    change = h * run.scales[i] * (rate[i] - rates[s * width + i])
                    size += (change / (1.0 + run.scales[i] * abs(inside[i]))) ** 2
            copied(width, rate, part(rates, s * width, width))
        run.control[abi.EVALUATIONS] += 2
        run.control[abi.NEWTON_ITERATIONS] += 1
        for i in range(width):
            run.trial[i] = begun[i] + 0.5 * h * (rates[i] + rates[width + i])
        for j in range(nv):
            w[sizes.change + j] = shift[j]
            run.trial[nq + j] += thrust[j]
        move_along_constraints(system, run, run.trial)
        scheme.geometry(following, run.trial, run.p, w)
        for c in range(m):
            if scheme.nonholonomic[c] == 0.0:
                gaps[c] += w[scheme.residual + c] / (1.0 + share)
        scheme.measure(following, run.trial, run.p, w)
        for c in range(m):
            slips[c] += w[scheme.residual + c] / (1.0 + share)
        set_change(system, scheme, run, 1.0, gaps)
        for j in range(nv):
            size += (run.scales[nq + j] * (w[sizes.change + j] - shift[j]) * run.w[abi.SPEED] / run.w[abi.LENGTH]) ** 2
            shift[j] = w[sizes.change + j]
        set_change(system, scheme, run, 1.0, slips)
        for j in range(nv):
            size += (run.scales[nq + j] * (w[sizes.change + j] - thrust[j])) ** 2
            thrust[j] = w[sizes.change + j]
        size = math.sqrt(size)
        if not math.isfinite(size):
            break
        stalls += 1 if size >= least else 0
        if size < _ROUNDING or (stalls >= _STALLS and size < _NEARLY):
            converged = True
            break
        least = min(least, size)
    return 0.0 if converged else DIVERGED


@called
def renew(system: ModelSystem, scheme: Symmetric, span: Span, run: Run, t: float, changed: bool) -> None:
    """Store the solution of the step."""
    for i in range(run.memory.shape[0]):
        run.memory[i] = run.room[i]


def memory(width: int, nv: int, m: int) -> tuple[int, int]:
    """Return the lengths of the memory of a run, and of the working memory of a step after the trial state."""
    length = 1 + 2 * width + 2 * m + 2 * nv
    return length, length + 3 * width


constant = loop(__name__, "constant", SYMMETRIC, "turn", prepare=prepare, attempt=attempt, renew=renew)

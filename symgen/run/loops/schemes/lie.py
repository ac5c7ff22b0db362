"""Explicit Runge-Kutta-Munthe-Kaas schemes: bodies turn by exponentials, not by their Euler parameters.

Within a step the position is ``q0`` moved by u, bodies turned by the exponential of their part of it, and the scheme
integrates u, v and auxiliary states. In body axes ``u' = omega + u x omega / 2 + u x (u x omega) / 12``, the series of
the inverse differential of the exponential to the terms that order 4 needs (Munthe-Kaas 1999; Hairer, Lubich, Wanner,
Geometric Numerical Integration, IV.8). Other coordinates have u' = v.
"""

from __future__ import annotations

from symgen.compile.loopcode.bare import part
from symgen.compile.loopcode.padding import padded
from symgen.compile.loopcode.vectors import total
from symgen.compile.native.annotations import Array, Integers
from symgen.run.layout import abi
from symgen.run.layout.manifold import advance_coordinates
from symgen.run.layout.records import ModelSystem, Run, Span
from symgen.run.layout.scheme_records import ROTATIONS, Rotations
from symgen.run.loops.frame import loop
from symgen.run.loops.frame_parts import evaluate

#: Coefficient of the term of u' with four products, which order 5 needs.
FOURTH = 1.0 / 720.0


def exponential_rate(v: Array, at: int, u: Array, spins: Integers, nv: int, fourth: float, rate: Array) -> None:
    """Write u' for velocities that begin at index `at` of `v` to `rate`, with `fourth` of four products or 0."""
    for i in range(nv):
        rate[i] = v[at + i]
    for s in range(spins.shape[0]):
        j = spins[s]
        x, y, z = u[j], u[j + 1], u[j + 2]
        a, b, c = v[at + j], v[at + j + 1], v[at + j + 2]
        p, q, r = y * c - z * b, z * a - x * c, x * b - y * a
        share = 1.0 / 12.0 + fourth * (x * x + y * y + z * z)  # four products with u are two, times -|u|^2
        rate[j] += 0.5 * p + share * (y * r - z * q)
        rate[j + 1] += 0.5 * q + share * (z * p - x * r)
        rate[j + 2] += 0.5 * r + share * (x * q - y * p)


def attempt(
    system: ModelSystem, scheme: Rotations, span: Span, run: Run, t: float, following: float, h: float, between: bool
) -> float:
    """Try a step of u, v and the auxiliary states, from 0 on."""
    tableau, sizes, y, trial = scheme.tableau, system.sizes, run.y, run.trial
    nq, nv, ny, width = sizes.nq, sizes.nv, sizes.ny, scheme.width
    rate, moved = part(run.room, 0, sizes.width), part(run.room, sizes.width, width)
    stages = part(run.room, sizes.width + width, tableau.stages * width)
    for s in range(tableau.stages + 1):
        low, high = tableau.start[s], tableau.start[s + 1]
        total(width, h, low, high, tableau.column, tableau.value, stages, moved)
        advance_coordinates(system, run, moved, trial)
        for i in range(nq, ny):
            trial[i] = y[i] + moved[nv + i - nq]
        if s < tableau.stages:
            evaluate(system, run, t + tableau.nodes[s] * h, trial, rate)
            stage = part(stages, s * width, width)
            exponential_rate(trial, nq, moved, scheme.spins, nv, 0.0, stage)
            for i in range(nq, ny):
                stage[nv + i - nq] = rate[i]
    run.control[abi.EVALUATIONS] += tableau.stages
    return 0.0


def stage_width(nq: int, nv: int, ny: int) -> int:
    """Return the length of a stage: u, v and the auxiliary states."""
    return padded(ny - nq + nv)


def lie_room(width: int, stage: int, stages: int) -> int:
    """Return the working memory of a step after the trial state."""
    return width + (1 + stages) * stage


constant = loop(__name__, "constant", ROTATIONS, "turn", attempt=attempt)

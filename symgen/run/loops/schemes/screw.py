"""Explicit Runge-Kutta-Munthe-Kaas schemes on SE(3): bodies turn and move by exponentials of one screw.

Within a step a body has the pose ``x0 + R0 V(theta) rho``, ``R0 exp(theta)``, and the scheme integrates u = (rho,
theta), the twist (l, omega) of the body in its own axes, ``l = R^T v``, ``l' = R^T v' - omega x l``, and the rest. With
the commutator ``[u, (l, omega)] = (theta x l + rho x omega, theta x omega)``, ``u' = (l, omega) + [u, .] / 2 + [u, [u,
.]] / 12`` is the series of the inverse differential of the exponential to the terms that order 4 needs.

A lower pair to the ground allows a subspace of twists that is closed under commutators: stages and steps satisfy such
constraints to rounding. Coordinates that belong to no free body are integrated as by `rkmk4`.
"""

from __future__ import annotations

import math

from symgen.compile.loopcode.bare import part
from symgen.compile.loopcode.loop_instances import called
from symgen.compile.loopcode.vectors import total
from symgen.compile.native.annotations import Array
from symgen.run.layout import abi
from symgen.run.layout.manifold import advance_coordinates
from symgen.run.layout.records import ModelSystem, Run, Span
from symgen.run.layout.scheme_records import SCREWS, Screws
from symgen.run.loops.frame import loop
from symgen.run.loops.frame_parts import evaluate
from symgen.run.loops.schemes.lie import exponential_rate


@called
def rotate_vector(q: Array, e: int, x: Array, at: int, sign: float, result: Array, to: int) -> None:
    """Write R x to index `to` of `result`, or R^T x for a sign of -1; Euler parameters begin at `e` of `q`."""
    s, a, b, c = q[e], sign * q[e + 1], sign * q[e + 2], sign * q[e + 3]
    x0, x1, x2 = x[at], x[at + 1], x[at + 2]
    p, q1, r = 2.0 * (b * x2 - c * x1), 2.0 * (c * x0 - a * x2), 2.0 * (a * x1 - b * x0)
    result[to] = x0 + s * p + b * r - c * q1
    result[to + 1] = x1 + s * q1 + c * p - a * r
    result[to + 2] = x2 + s * r + a * q1 - b * p


@called
def displace_point(u: Array, j: int, result: Array) -> None:
    """Write V(theta) rho, the displacement along a screw, to `result`; theta is at index j of `u`, rho before it."""
    a, b, c = u[j], u[j + 1], u[j + 2]
    x, y, z = u[j - 3], u[j - 2], u[j - 1]
    square = a * a + b * b + c * c
    angle = math.sqrt(square)
    if angle < 0.3:
        first = 0.5 - square * (1 / 24 - square * (1 / 720 - square * (1 / 40320 - square / 3628800)))
        second = 1 / 6 - square * (1 / 120 - square * (1 / 5040 - square * (1 / 362880 - square / 39916800)))
    else:
        first, second = (1.0 - math.cos(angle)) / square, (angle - math.sin(angle)) / (square * angle)
    p, q, r = b * z - c * y, c * x - a * z, a * y - b * x
    result[0] = x + first * p + second * (b * r - c * q)
    result[1] = y + first * q + second * (c * p - a * r)
    result[2] = z + first * r + second * (a * q - b * p)


@called
def screw_rate(twist: Array, j: int, u: Array, rate: Array) -> None:
    """Write rho' of a body to the place of rho in `rate`; its theta begins at index j."""
    tx, ty, tz, rx, ry, rz = u[j], u[j + 1], u[j + 2], u[j - 3], u[j - 2], u[j - 1]
    wx, wy, wz, lx, ly, lz = twist[j], twist[j + 1], twist[j + 2], twist[j - 3], twist[j - 2], twist[j - 1]
    px, py, pz = ty * wz - tz * wy, tz * wx - tx * wz, tx * wy - ty * wx  # theta x omega
    cx = ty * lz - tz * ly + ry * wz - rz * wy
    cy = tz * lx - tx * lz + rz * wx - rx * wz
    cz = tx * ly - ty * lx + rx * wy - ry * wx
    rate[j - 3] = lx + 0.5 * cx + (ty * cz - tz * cy + ry * pz - rz * py) / 12.0
    rate[j - 2] = ly + 0.5 * cy + (tz * cx - tx * cz + rz * px - rx * pz) / 12.0
    rate[j - 1] = lz + 0.5 * cz + (tx * cy - ty * cx + rx * py - ry * px) / 12.0


@called
def attempt(
    system: ModelSystem, scheme: Screws, span: Span, run: Run, t: float, following: float, h: float, between: bool
) -> float:
    """Try a step of u, the twists, other velocities and the auxiliary states, from 0 on."""
    tableau, sizes, y, trial = scheme.tableau, system.sizes, run.y, run.trial
    nq, nv, ny, width, bodies = sizes.nq, sizes.nv, sizes.ny, scheme.width, scheme.bodies
    rate, moved = part(run.room, 0, sizes.width), part(run.room, sizes.width, width)
    at = sizes.width + width
    twist, change, way = part(run.room, at, nv), part(run.room, at + nv, nv), part(run.room, at + 2 * nv, 3)
    stages = part(run.room, at + 2 * nv + 3, tableau.stages * width)
    for s in range(tableau.stages + 1):
        low, high = tableau.start[s], tableau.start[s + 1]
        total(width, h, low, high, tableau.column, tableau.value, stages, moved)
        for i in range(nv):
            change[i], twist[i] = moved[i], y[nq + i] + moved[nv + i]
        for b in range(0, bodies.shape[0], 2):
            e, j = bodies[b], bodies[b + 1]
            displace_point(moved, j, way)
            rotate_vector(y, e, way, 0, 1.0, change, j - 3)
            rotate_vector(y, e, y, nq + j - 3, -1.0, twist, j - 3)
            for i in range(3):
                twist[j - 3 + i] += moved[nv + j - 3 + i]
        advance_coordinates(system, run, change, trial)
        for i in range(nv):
            trial[nq + i] = twist[i]
        for i in range(nq + nv, ny):
            trial[i] = y[i] + moved[nv + i - nq]
        for b in range(0, bodies.shape[0], 2):
            rotate_vector(trial, bodies[b], twist, bodies[b + 1] - 3, 1.0, trial, nq + bodies[b + 1] - 3)
        if s < tableau.stages:
            evaluate(system, run, t + tableau.nodes[s] * h, trial, rate)
            stage = part(stages, s * width, width)
            exponential_rate(trial, nq, moved, scheme.spins, nv, 0.0, stage)
            for i in range(nq, ny):
                stage[nv + i - nq] = rate[i]
            for b in range(0, bodies.shape[0], 2):
                e, j = bodies[b], bodies[b + 1]
                screw_rate(twist, j, moved, stage)
                rotate_vector(trial, e, rate, nq + j - 3, -1.0, stage, nv + j - 3)
                x, z, w = twist[j], twist[j + 1], twist[j + 2]
                stage[nv + j - 3] -= z * twist[j - 1] - w * twist[j - 2]
                stage[nv + j - 2] -= w * twist[j - 3] - x * twist[j - 1]
                stage[nv + j - 1] -= x * twist[j - 2] - z * twist[j - 3]
    run.control[abi.EVALUATIONS] += tableau.stages
    return 0.0


constant = loop(__name__, "constant", SCREWS, "turn", attempt=attempt)

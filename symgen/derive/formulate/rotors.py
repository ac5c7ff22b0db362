"""Rotors in the equations: their rates, the inertia that they add, and their gyroscopic forces."""

from __future__ import annotations

from symgen.base.errors import refuse_overflow
from symgen.base.vocabulary.measures import GROUND
from symgen.derive.formulate.derived_measure import DerivedMeasure
from symgen.derive.formulate.equations import (
    MassBlock,
    mass_blocks,
)
from symgen.derive.formulate.measure_nodes import ModelNodes
from symgen.describe.mechanism import Rotor


def with_rotors(model: ModelNodes, mass: tuple[MassBlock, ...], forces: list[int]) -> tuple[tuple[MassBlock, ...], int]:
    """Return M with the rotors of joints, and their energy; add their inertia forces to `forces`.

    A rotor of inertia J adds J r^T r to M and -J r^T b to f, where the angle has the rate r v and the second derivative
    r v' + b: constants where the state has velocities in body axes and the joint keeps its axes parallel.
    """
    g, energy = model.graph, model.graph.zero
    if not model.mechanism.rotors:
        return mass, energy
    entries = {
        (i, j): node
        for block in mass
        for i, line in zip(block.columns, block.entries, strict=True)
        for j, node in zip(block.columns, line, strict=True)
        if node != g.zero
    }
    for rotor in model.mechanism.rotors:
        with refuse_overflow(f"joints.{rotor.joint}"):
            inertia, rate, row, bias = rotor_rate(model, rotor)
            energy = g.add(energy, g.mul(g.mul(g.constant(0.5), inertia), g.mul(rate, rate)))
            for i, of_i in row.items():
                momentum = g.mul(inertia, of_i)
                forces[i] = g.sub(forces[i], g.mul(momentum, bias))
                for j, of_j in row.items():
                    entries[i, j] = g.add(entries.get((i, j), g.zero), g.mul(momentum, of_j))
    return mass_blocks(entries, len(forces), g.zero), energy


def rotor_rate(model: ModelNodes, rotor: Rotor) -> tuple[int, int, dict[int, int], int]:
    """Return a rotor's inertia, the rate r v of its angle, the entries of r, and b of the second derivative."""
    inertia, angle = model.expression(rotor.inertia), model.measure(rotor.angle)
    angle = _rate_about_parallel_axes(model, rotor) or angle
    rate = angle.rate(model.graph, model.velocities)
    row, bias, _ = model.row_over_state(angle.row, angle.bias)
    return inertia, rate, row, bias


def _rate_about_parallel_axes(model: ModelNodes, rotor: Rotor) -> DerivedMeasure | None:
    """Return the difference of two bodies' angular velocities about axes that a joint in space keeps parallel.

    It is the rate of the joint's angle where its rows hold, with constant factors in body axes.
    """
    if model.tree is not None or not rotor.axes:
        return None
    g, row = model.graph, dict[int, int]()
    for axis, sign in zip(rotor.axes, (-1.0, 1.0), strict=True):
        if axis.body != GROUND:
            factors = (g.mul(g.constant(sign), node) for node in model.direction(axis))
            row |= {model.first[axis.body] + 3 + k: node for k, node in enumerate(factors) if node != g.zero}
    return DerivedMeasure(g.zero, row, g.zero)

"""The descriptor form: residual and exact Jacobian of F(t, y, k) = 0 for the implicit integrators.

Unknowns of a stage are k = (q', v', lambda), and for stabilised index 2 also eta. The equations are

- ``q' - N v + D^T eta``,
- ``M v' + D^T lambda - f``,
- the constraints at the level of the method: ``D v' - g - e lambda`` (acceleration), ``Phi`` (position, with ``D v -
  nu`` in
  nonholonomic rows), or ``D v - nu`` and ``Phi`` together (stabilised); ``Phi`` with the two other levels behind the
  equations for projections (projected).

The Jacobian with respect to k and to y = (q, v) is differentiated on the graph (`symgen.ir.derivative`).
"""

from __future__ import annotations

from dataclasses import dataclass

from symgen.ir.derivative import jacobian
from symgen.ir.program import STATUS, Block, Target
from symgen.lower.algebra import System
from symgen.lower.hoist import Hoister
from symgen.lower.vectors import Vector
from symgen.methods._base import Descriptor


@dataclass(frozen=True)
class DescriptorForm:
    """A law's descriptor form.

    Parameters
    ----------
    blocks : tuple of Block
        ``residual`` and ``tangent``.
    unknowns : int
        Unknowns of a stage.
    pattern : tuple of (int, int)
        Equation and unknown of each number that ``tangent`` writes; from `unknowns` on, unknowns are q and v.
    """

    blocks: tuple[Block, ...]
    unknowns: int
    pattern: tuple[tuple[int, int], ...]


def descriptor_form(hoister: Hoister, system: System, descriptor: Descriptor) -> DescriptorForm:
    """Return the blocks ``residual`` and ``tangent``, and the pattern of the latter.

    Parameters
    ----------
    hoister : Hoister
        Of the law's module.
    system : System
        The equations as the method sees them.
    descriptor : Descriptor
        The method's constraints.

    Notes
    -----
    ``residual(t, y, k, p, w, r)`` writes F to r and the power of forces without potential and of drivers to the status.
    ``tangent(t, y, k, p, w, j)`` writes the structural nonzeros of dF/dk and dF/dy, equation by equation.
    """
    e, g = system.equations, system.graph
    rows, more, unknowns = _equations(system, descriptor)
    power = g.sub(e.power, Vector(g, tuple(g.input("k", e.nq + e.nv + i) for i in range(e.m))).dot(system.nu).node)
    arguments = ("t", "y", "k", "p", "w", "r")
    residual = [(Target("r", i), n) for i, n in enumerate([*rows, *more])]
    residual.append((Target("status", STATUS.index("power")), power))
    first = {"k": 0, "q": unknowns, "v": unknowns + e.nq}
    keys = [("k", i) for i in range(unknowns)] + [("q", i) for i in range(e.nq)] + [("v", i) for i in range(e.nv)]
    tangent: list[tuple[Target, int]] = []
    pattern: list[tuple[int, int]] = []
    for i, derivatives in enumerate(jacobian(g, rows, keys)):
        for space, index in sorted(derivatives):
            tangent.append((Target("j", len(tangent)), derivatives[space, index]))
            pattern.append((i, index + first[space]))
    blocks = (
        hoister.block("residual", "F(t, y, k) of the descriptor form, and the power", residual, arguments),
        hoister.block("tangent", "entries of dF/dk and dF/dy of the descriptor form", tangent, (*arguments[:-1], "j")),
    )
    return DescriptorForm(blocks, unknowns, tuple(pattern))


def constraint_groups(
    system: System, descriptor: Descriptor, accelerations: Vector, multipliers: Vector, eta: Vector
) -> tuple[list[list[int]], list[list[int]]]:
    """Return the equations of constraints, and rows behind the equations that projections need; in groups of m.

    Parameters
    ----------
    system : System
        The equations, or those of one joint.
    descriptor : Descriptor
        The method's constraints.
    accelerations, multipliers, eta : Vector
        Unknowns of a stage; `eta` is used where the form is stabilised.
    """
    rows = system.equations.rows
    velocity = system.D @ system.v - system.nu
    if descriptor.level == "stabilised":
        return [list(velocity), [_select(r.phi, eta.nodes[i]) for i, r in enumerate(rows)]], []
    if descriptor.level in ("position", "projected"):
        position = [_select(r.phi, velocity.nodes[i]) for i, r in enumerate(rows)]
        if descriptor.level == "position":
            return [position], []
        assert descriptor.target is not None, "a projected descriptor has gamma as its target"
        return [position], [list(velocity), list(system.D @ accelerations - descriptor.target)]
    assert descriptor.target is not None, "an acceleration-level descriptor has a target"
    rest = system.D @ accelerations - descriptor.target
    if descriptor.compliance is not None:
        rest = rest - descriptor.compliance * multipliers
    return [list(rest)], []


def _equations(system: System, descriptor: Descriptor) -> tuple[list[int], list[int], int]:
    """Return equations, rows behind them, and the number of unknowns."""
    e, g = system.equations, system.graph
    stabilised = descriptor.level == "stabilised"
    unknowns = e.nq + e.nv + e.m * (2 if stabilised else 1)
    q_rates = Vector(g, tuple(g.input("k", i) for i in range(e.nq)))
    accelerations = Vector(g, tuple(g.input("k", e.nq + i) for i in range(e.nv)))
    multipliers = Vector(g, tuple(g.input("k", e.nq + e.nv + i) for i in range(e.m)))
    eta = Vector(g, tuple(g.input("k", e.nq + e.nv + e.m + i) for i in range(e.m)))
    kinematic = q_rates - Vector(g, e.q_rates)
    dynamic = system.mass(accelerations) + system.D.transposed(multipliers) - system.f
    if stabilised:  # N times a change of v: the rates q' with that change in place of v
        kinematic = kinematic + system.at_velocity(system.q_rates, system.D.transposed(eta))
    constraints, more = constraint_groups(system, descriptor, accelerations, multipliers, eta)
    rows = [*kinematic, *dynamic, *(n for group in constraints for n in group)]
    return rows, [n for group in more for n in group], unknowns


def _select(phi: int | None, otherwise: int) -> int:
    """Return Phi, or what stands in its place in a nonholonomic row."""
    return otherwise if phi is None else phi

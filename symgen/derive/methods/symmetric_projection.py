"""Symmetric projection: a step leaves the constraints as it returns to them."""

from __future__ import annotations

from symgen.derive.methods._base import MethodParameter, MultiplierMethod


class SymmetricProjection(MultiplierMethod):
    """As `lagrange`; steps go from ``q0 + N D_0^+ r``, ``v0 + D_0^+ s`` to ``q1 - N D_1^+ r``, ``v1 - D_1^+ s``.

    The numbers r and s, one a row, are those with which ``Phi(q1) = 0`` and ``D_1 v1 = nu``. The projected scheme is
    symmetric, and so reversible: errors of energy do not drift, as they do with a projection after the step. ``D^+`` is
    that of the metric in which rank is decided, where 1 rad weighs as much as a body's length.
    """

    name = "symmetric-projection"
    summary = "positions and velocities leave their constraints before each step as they return to them after it"
    reference = (
        "Hairer, BIT 40 (2000) 726-734; "
        "Hairer, Lubich, Wanner, Geometric Numerical Integration, 2nd ed., Springer 2006, section V.4.1"
    )
    forms = ("symmetric",)
    parameters = (
        MethodParameter("share", 1.0, "1", "part of the projection before a step; 0: all of it after the step"),
    )
    default_integrator = "gauss"


KIND = SymmetricProjection()

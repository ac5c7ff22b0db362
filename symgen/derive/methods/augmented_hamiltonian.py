"""Augmented Hamiltonian method: momenta are integrated, velocities follow from them and the constraints."""

from __future__ import annotations

from collections.abc import Mapping
from typing import ClassVar

from symgen.base.ir.program import Correction
from symgen.derive.methods._augmented import ITERATION_TOLERANCE, PENALTY
from symgen.derive.methods._base import Iteration, IterationState, Method, MethodParameter, Rates, multiplier_law
from symgen.derive.methods._system import System
from symgen.derive.methods._tape import Vector


class AugmentedHamiltonian(Method):
    """Integrates ``p = M v + D^T sigma`` by ``p' = f + (dD/dt)^T sigma``; v and sigma follow from p by iteration.

    ``(M + a D^T D) dv = p - M v - D^T (sigma + a (D v - nu))``, ``sigma += a (D v - nu)`` until v converges, so
    that the velocity constraint holds in every evaluation and only one derivative of the constraints is needed. The
    state holds u = M^-1 p in place of v, whose rate has a part ``M^-1 (dM/dt) (v - u)`` where M changes. sigma is the
    impulse of the constraint forces; it starts from 0 at every step, where p becomes M v again (a change of gauge), so
    methods with memory over steps cannot use it. Readings differ: Bayo and Avello let sigma grow and add penalties in
    Phi, which this gauge makes superfluous.
    """

    name = "augmented-hamiltonian"
    dense = "which needs the rate of D and forces at other velocities than the state's"
    summary = "momenta are integrated; velocities satisfy their constraint in every evaluation"
    reference = "Bayo, Avello, Nonlinear Dyn. 5 (1994) 209-231, doi 10.1007/BF00045677"
    forms = ("one-step",)
    default_integrator = "dop853"
    parameters: ClassVar[tuple[MethodParameter, ...]] = (PENALTY, ITERATION_TOLERANCE)

    def needs_regular_mass(self, options: Mapping[str, str]) -> bool:
        """Return True: M is inverted."""
        return True

    def target(self, system: System) -> Vector:
        """Return the value of D v in every evaluation."""
        return system.nu

    def law(self, system: System, options: Mapping[str, str]) -> Iteration:
        """Return the iteration for v and sigma, and the rates of q and M^-1 p."""
        penalties = system.penalties(system.of_mean_mass(system.parameter("penalty")))
        factor = system.keep_factor(system.augmented_factor(penalties))
        penalties = system.keep("kept_penalties", penalties)
        constraints, target = system.keep_constraints(), system.keep("kept_target", self.target(system))
        momentum = system.keep("kept_momentum", system.mass(system.v))
        v = system.variable("kept_velocity", momentum.size)
        impulse = system.variable("kept_impulse", target.size)
        right = momentum - system.mass(v)
        right = right - constraints.transposed(impulse + penalties.times(constraints @ v - target))
        increment = system.solve(factor, right)
        following = v + increment
        raised = impulse + penalties.times(constraints @ following - target)
        force = system.at_velocity(system.f, v) + system.constraint_rate_transposed(impulse, v)
        force = force + system.mass_rate(v - system.v, v)
        position = system.at_velocity(system.q_rates, v)
        multipliers = system.at_velocity(multiplier_law(system, system.gamma).multipliers, v)
        return Iteration(
            (
                IterationState("kept_velocity", system.v, following),
                IterationState("kept_impulse", system.zeros(target.size), raised),
            ),
            increment,
            Rates(position, system.minv(force), v, multipliers),
        )

    def correction(self, options: Mapping[str, str]) -> Correction:
        """Return the change of gauge: velocities projected in the metric of M."""
        return Correction("none", True, "mass")


KIND = AugmentedHamiltonian()

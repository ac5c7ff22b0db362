"""Integrators, one file each; `INTEGRATORS` finds them.

In: coefficients and parameters of a scheme.
Out: a `Setup`: a loop with its arguments.
Imports: NumPy; `loops` and rooms below.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from symgen.base.registry import Listing, Registry

if TYPE_CHECKING:
    from symgen.run.loops.integrator import Integrator

#: Names in SciPy, MATLAB, SUNDIALS, MuJoCo, Chrono and textbooks -> the integrator that is nearest.
MEANT = {
    **dict.fromkeys(("ode45", "rk45", "rkf45", "dopri", "dormand-prince", "ode5", "tsit5"), "dopri5"),
    **dict.fromkeys(("ode78", "ode89", "ode8", "vern9"), "dop853"),
    **dict.fromkeys(("ode15s", "ode15i", "lsoda", "vode", "cvode", "ida", "dassl", "gear"), "bdf"),
    **dict.fromkeys(("implicit-euler", "backward-euler", "euler-implicit"), "bdf"),
    **dict.fromkeys(("radau", "radau-iia", "ode23t", "ode23tb"), "radau5"),
    **dict.fromkeys(("ode113", "adams", "adams-bashforth"), "abm"),
    **dict.fromkeys(("rk2", "ode2", "ode23", "rk23"), "heun"),
    **dict.fromkeys(("runge-kutta", "ode4", "rungekutta"), "rk4"),
    **dict.fromkeys(("forward-euler", "explicit-euler", "ode1"), "euler"),
    **dict.fromkeys(("semi-implicit-euler", "implicit", "implicitfast"), "symplectic-euler"),
    **dict.fromkeys(("verlet", "leapfrog", "shake"), "rattle"),
    **dict.fromkeys(("ode23s", "rosenbrock", "ros4", "rodas4", "linearly-implicit-euler"), "rodas"),
    **{"hht-alpha": "hht", "newmark-beta": "newmark", "crank-nicolson": "trapezoidal"},
}
INTEGRATORS: Registry[Integrator] = Registry(
    "symgen.run.integrators", "integrator", beside="symgen.derive.methods", meant=MEANT
)


def list_integrators() -> Listing:
    """Return the names of all integrators, each with a one-line summary."""
    return INTEGRATORS.listing()

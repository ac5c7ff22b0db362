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

INTEGRATORS: Registry[Integrator] = Registry("symgen.run.integrators", "integrator", beside="symgen.derive.methods")


def list_integrators() -> Listing:
    """Return the names of all integrators, each with a one-line summary."""
    return INTEGRATORS.listing()

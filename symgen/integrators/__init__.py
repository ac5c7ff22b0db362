"""Integrators, one file each; `INTEGRATORS` finds them."""

from __future__ import annotations

from typing import TYPE_CHECKING

from symgen.registry import Listing, Registry

if TYPE_CHECKING:
    from symgen.runtime.integrator import Integrator

INTEGRATORS: Registry[Integrator] = Registry("symgen.integrators", "integrator", beside="symgen.methods")


def list_integrators() -> Listing:
    """Return the names of all integrators, each with a one-line summary."""
    return INTEGRATORS.listing()

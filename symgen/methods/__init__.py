"""Constraint stabilisation methods, one file each; `METHODS` finds them."""

from __future__ import annotations

from symgen.methods._base import Method
from symgen.registry import Listing, Registry

METHODS: Registry[Method] = Registry("symgen.methods", "method", beside="symgen.integrators")


def list_methods() -> Listing:
    """Return the names of all methods, each with a one-line summary."""
    return METHODS.listing()

"""Methods of constraint stabilisation, one file each; `METHODS` finds them.

In: named blocks of a `System`.
Out: a law as a formula over these blocks.
Imports: no library; `base` and `ir`.
"""

from __future__ import annotations

from symgen.base.registry import Listing, Registry
from symgen.derive.methods._base import Method

METHODS: Registry[Method] = Registry("symgen.derive.methods", "method", beside="symgen.run.integrators")


def list_methods() -> Listing:
    """Return the names of all methods, each with a one-line summary."""
    return METHODS.listing()

"""Methods of constraint stabilisation, one file each; `METHODS` finds them.

In: named blocks of a `System`.
Out: a law as a formula over these blocks.
Imports: no library; `base` and `ir`.
"""

from __future__ import annotations

from symgen.base.registry import Listing, Registry
from symgen.derive.methods._base import Method

#: Words of textbooks and other programs -> the method that is nearest.
MEANT = {
    **dict.fromkeys(
        (
            "kkt",
            "dae",
            "direct",
            "multipliers",
            "lagrange-multipliers",
            "index-1",
            "index1",
            "newton-euler",
            "euler-lagrange",
        ),
        "lagrange",
    ),
    **dict.fromkeys(("gear-gupta-leimkuhler", "index-2", "index2", "stabilized-index-2"), "ggl"),
    **dict.fromkeys(("minimal", "minimal-coordinates", "independent-coordinates"), "coordinate-partitioning"),
    **dict.fromkeys(("index-3", "index3", "hht"), "generalized-alpha"),
    **{"gauss-principle": "udwadia-kalaba", "projection": "mass-orthogonal-projection"},
}
METHODS: Registry[Method] = Registry("symgen.derive.methods", "method", beside="symgen.run.integrators", meant=MEANT)


def list_methods() -> Listing:
    """Return the names of all methods, each with a one-line summary."""
    return METHODS.listing()

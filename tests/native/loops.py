"""Short runs to the last bit; run apart, on a processor named to Numba, by the compiler that the environment names.

python -m native.loops pendulum lagrange rk4 four-bar ggl radau5
"""

from __future__ import annotations

import hashlib
import sys

import numpy as np

from symgen.api import Model, load
from symgen.native.library import Library


def digest_of(model: Model, method: str, integrator: str, **changes: object) -> str:
    """Return what a run gives, and what made its loop."""
    result = model.simulate(method=method, integrator=integrator, until=0.5, output_step=0.07, **changes)
    arrays = (result.t, result.q.values, result.v.values, result.kinetic, result.smallest_pivot)
    counts = (result.steps, result.rejected, result.evaluations, result.iterations)
    found = hashlib.sha256(b"".join(np.asarray(a).tobytes() for a in (*arrays, counts)))
    assert result.status == "ok" and result.steps > 2
    return found.hexdigest()


def makers() -> set[bool]:
    """Return whether loops that were entered were made from their source."""
    from symgen.runtime.frame import RECIPES

    return {isinstance(made.library, Library) for loop in RECIPES for made in loop.overloads.values()}


if __name__ == "__main__":
    words = sys.argv[1:]
    for i in range(0, len(words), 3):
        print(*words[i : i + 3], digest_of(load(words[i]), *words[i + 1 : i + 3]))
    (from_source,) = makers()
    print("from the source" if from_source else "by Numba", file=sys.stderr)

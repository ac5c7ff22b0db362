"""Random scenes of bodies that touch, by kind and seed."""

from __future__ import annotations

import numpy as np

from benchmarks.bounded.touch.beside import BESIDE
from benchmarks.bounded.touch.outlines import OUTLINES
from benchmarks.bounded.touch.scenes import KINDS, Draft, Drawn


def drawn(kind: str, seed: int) -> Drawn:
    """Return the scene of a kind and a seed."""
    draft = Draft(np.random.default_rng([seed, *kind.encode()]))
    {**KINDS, **BESIDE, **OUTLINES}[kind](draft)
    return draft.drawn(kind)

"""Where searches begin: at the file, and at the best of many candidates that are spread evenly over the ranges."""

from __future__ import annotations

from collections import Counter
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from symgen.study.design.rows import Sampled
from symgen.study.design.search import ALLOWED, Search

Array = NDArray[np.float64]

#: Candidates for each start beside that of the file.
CANDIDATES = 128
#: Starts are at least so far apart, in parts of the ranges' diagonal.
APART = 0.05


class Screened(NamedTuple):
    """Candidates that were looked at before searches.

    Attributes
    ----------
    tried, moving, within : int
        All of them, those that move through all times, and those within all limits.
    starts : list of Array
        The best ones, in parts of the ranges.
    failed : Counter
        Reasons of the others.
    """

    tried: int
    moving: int
    within: int
    starts: list[Array]
    failed: Counter[str]


def screen(search: Search, starts: int, seed: int) -> Screened:
    """Return the best of evenly spread candidates.

    Parameters
    ----------
    search : Search
        The motions.
    starts : int
        Number of starts that are wanted.
    seed : int
        Of the candidates.
    """
    from scipy.stats import qmc

    n, count = len(search.varied.names), CANDIDATES * starts
    us = qmc.Sobol(n, seed=np.random.default_rng(seed)).random(1 << (count - 1).bit_length())[:count]
    found = search.motions.screen(search.varied.values(us), search.even)
    failed, ranked, within = Counter[str](), list[tuple[bool, float, int]](), 0
    for k, values in enumerate(found):
        if isinstance(values, str):
            failed[values] += 1
            continue
        sampled = Sampled(search.even, values, np.zeros((*values.shape, 0)), np.arange(len(search.even)))
        excess, score = search.excess(sampled), search.score(sampled)
        within += excess <= ALLOWED
        ranked.append((excess > ALLOWED, score if excess <= ALLOWED else excess, k))
    ranked.sort()
    chosen = list[Array]()
    for _, _, k in ranked:
        if len(chosen) == starts:
            break
        if all(np.linalg.norm(us[k] - other) > APART * np.sqrt(n) for other in chosen):
            chosen.append(us[k])
    return Screened(count, len(ranked), within, chosen, failed)

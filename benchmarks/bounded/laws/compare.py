"""Problems of all mixes beside all of their motions, or beside a second solver where those are too many to try."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Iterable
from dataclasses import dataclass, field

import numpy as np

from benchmarks.bounded.laws.problems import Problem, draw, filled, motions
from benchmarks.bounded.laws.second import find_another_way
from symgen.compile.loopcode.exact import compiled_form, exact
from symgen.run.laws.motions import NO_MOTION, SEVERAL_MOTIONS, count_motions, find_forces
from symgen.run.laws.problem import Laws
from symgen.run.laws.sharing import share_forces


@exact(entry=True)
def solve_laws(n: int, given: int, laws: Laws) -> int:
    """Find forces that obey all laws, and count motions.

    Parameters
    ----------
    n : int
        Number of rows.
    given : int
        1 where the present forces may be near, else 0.
    laws : Laws
        The problem; it keeps forces, states and accelerations.

    Returns
    -------
    int
        `NO_MOTION`, `ONE_MOTION`, `SEVERAL_MOTIONS`, or `NOT_SOUGHT` where others than the one found were not sought.
    """
    if not find_forces(n, laws, 0 if given != 0 else 1):
        return NO_MOTION
    share_forces(n, laws)
    return int(count_motions(n, laws))


SOLVE = compiled_form(solve_laws)
#: Most rows of a problem; most combinations that are all tried; what may be missing where a motion is found.
ROWS, TRIED, WRONG = 60, 250, 1e-8
#: Letters of rows, and how many rows each has.
KINDS = {"p": 1, "d": 1, "c": 2, "s": 3, "e": 1, "j": 1, "b": 1}


@dataclass
class Verdicts:
    """How many problems had what, and the seeds of those that were not as they should be."""

    counts: Counter[str] = field(default_factory=Counter)
    faults: list[tuple[int, str]] = field(default_factory=list)


def problem_of(seed: int) -> Problem:
    """Return the problem of a seed: a mix of up to 60 rows, few of them more often; every third one redundant."""
    numbers = np.random.default_rng(seed)
    most, kinds = round(math.exp(numbers.uniform(0.0, math.log(ROWS)))), ""
    while (rows := sum(KINDS[kind] for kind in kinds)) < most:
        kinds += str(numbers.choice([kind for kind, count in KINDS.items() if rows + count <= max(most, 1)]))
    return draw(numbers, kinds, redundant=seed % 3 == 0)


def combinations_of(problem: Problem) -> float:
    """Return the number of combinations of what rows may do; inf in space, where rows begin in any direction."""
    if any(row.flat for row in problem.rows):
        return math.inf
    return float(math.prod(2 if row.pushes else 1 if row.way else 3 for row in problem.rows))


def compare(seeds: Iterable[int]) -> Verdicts:
    """Compare the problems of some seeds with what is known of them by other means."""
    verdicts = Verdicts()
    for seed in seeds:
        problem = problem_of(seed)
        laws, k = filled(problem), len(problem.rows)
        code = SOLVE(k, 0, laws)
        verdicts.counts["found" if code != NO_MOTION else "none"] += 1
        if code != NO_MOTION and not problem.miss(np.array(laws.forces[:k])) < WRONG:
            verdicts.faults.append((seed, "wrong"))
        if combinations_of(problem) <= TRIED:
            there = motions(problem)
            verdicts.counts["all motions known"] += 1
            verdicts.counts["several"] += len(there) > 1
            if code == NO_MOTION and there:
                verdicts.faults.append((seed, "missed"))
            elif (code == SEVERAL_MOTIONS) != (len(there) > 1) and there:
                verdicts.faults.append((seed, "several" if len(there) > 1 else "one"))
        elif code == NO_MOTION and find_another_way(problem, np.random.default_rng(seed)) is not None:
            verdicts.faults.append((seed, "missed"))
    return verdicts

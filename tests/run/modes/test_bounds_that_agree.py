"""Bounds by reactions and forces at rest that agree, in drawn problems, beside all motions found by other means."""

from types import SimpleNamespace

import numpy as np

from benchmarks.bounded.laws.problems import Problem, draw, motions
from symgen.compile.loopcode.exact import plain_form
from symgen.run.laws.problem import new_laws
from symgen.run.modes.agreement import agree_within, moves_otherwise
from symgen.run.modes.bounded_rows import SAME
from symgen.run.modes.box import new_box

AGREE, MOVES_OTHERWISE = plain_form(agree_within), plain_form(moves_otherwise)


def rows_at_rest(problem: Problem) -> SimpleNamespace:
    """Return what the choice of modes reads of a problem whose rows are all at rest."""
    k, flags, numbers = len(problem.rows), lambda: np.zeros(k, dtype=int), lambda: np.zeros(k)
    rows = SimpleNamespace(count=k, dry=k, shifted=0, pushes=flags(), pressed=flags())
    read = SimpleNamespace(static=numbers(), middle=numbers())
    posed = SimpleNamespace(matrix=problem.matrix.ravel(), offset=problem.offset)
    posed.apart, posed.parts = np.zeros(2 * k), np.zeros(2 * k * k)
    c = SimpleNamespace(rows=rows, read=read, problem=posed, found=SimpleNamespace(broken=flags()))
    c.box, c.laws, c.rest, c.named = new_box(k), new_laws(k), np.arange(k), np.zeros(k + 1, dtype=int)
    c.loose, c.part, c.taken, c.unsought = flags(), flags(), np.ones(k, dtype=int), np.zeros(1, dtype=int)
    c.signs, c.forces, c.sizes = numbers(), numbers(), numbers()
    for i, row in enumerate(problem.rows):
        read.static[i] = row.kappa if row.apart.size else row.beta
        rows.pressed[i] = int(row.apart.size > 0)
        for part in range(row.apart.size):
            posed.apart[2 * i + part] = row.apart[part]
            posed.parts[(2 * i + part) * k : (2 * i + part + 1) * k] = row.parts[part]
    read.sliding = read.static.copy()
    c.box.matrix[:], c.box.offset[:] = posed.matrix, posed.offset
    return c


def test_forces_are_found_wherever_there_are_any() -> None:
    """Pins press each other strongly: bounds and forces in turns would never agree in some of these."""
    numbers, several = np.random.default_rng(8), 0
    for number in range(120):
        problem = draw(numbers, ("jj", "jjj", "jjd")[number % 3])
        for row in problem.rows:
            row.way, row.kappa, row.parts = 0.0, 2.0 * row.kappa, 2.0 * row.parts
        there, c = motions(problem), rows_at_rest(problem)
        k = len(problem.rows)
        found = AGREE(c, k, 1.0) == SAME
        assert found or not there
        if found:
            assert problem.miss(c.forces) < 1e-8
            assert (MOVES_OTHERWISE(c, k) != 0) >= (len(there) > 1)
            several += len(there) > 1
    assert several > 0


def test_two_pins_across_each_other_have_two_motions_and_are_named() -> None:
    """Each presses the other: both slide, or one of them does."""
    problem = crossed()
    c = rows_at_rest(problem)
    assert len(motions(problem)) > 1
    assert AGREE(c, 2, 1.0) == SAME
    assert MOVES_OTHERWISE(c, 2) == 1
    assert c.named[0] >= 0


def crossed() -> Problem:
    """Return the first drawn problem of two pins with several motions."""
    numbers = np.random.default_rng(3)
    while True:
        problem = draw(numbers, "jj")
        for row in problem.rows:
            row.way, row.kappa, row.parts = 0.0, 2.0 * row.kappa, 3.0 * row.parts
        if len(motions(problem)) > 1:
            return problem

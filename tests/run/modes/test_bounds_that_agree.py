"""Bounds by reactions and forces at rest that agree, in drawn problems, beside all motions found by other means."""

from types import SimpleNamespace

import numpy as np

from benchmarks.bounded.laws.problems import Problem, draw, motions
from symgen.base.ir.program import MODE_NUMBERS
from symgen.compile.loopcode.exact import plain_form
from symgen.compile.loopcode.loop_instances import exact_instance
from symgen.run.laws.problem import new_laws
from symgen.run.modes.bounded_rows import SAME, SEVERAL_BY_REACTION
from symgen.run.modes.box import new_box
from symgen.run.modes.contact_laws import solve_by_laws
from symgen.run.modes.pin_impulses import BY_REACTIONS

SOLVE = plain_form(exact_instance(solve_by_laws, BY_REACTIONS))


def rows_at_rest(problem: Problem) -> SimpleNamespace:
    """Return what the choice of modes reads of a problem whose rows are all at rest."""
    k, flags, numbers = len(problem.rows), lambda: np.zeros(k, dtype=int), lambda: np.zeros(k)
    rows = SimpleNamespace(count=k, dry=k, pushes=flags(), pressed=flags(), partner=flags() - 1)
    read = SimpleNamespace(static=numbers(), middle=numbers())
    posed = SimpleNamespace(matrix=problem.matrix.ravel(), offset=problem.offset, usual=numbers())
    posed.apart, posed.parts = np.zeros(2 * k), np.zeros(2 * k * k)
    c = SimpleNamespace(rows=rows, read=read, problem=posed, box=new_box(k), laws=new_laws(k))
    c.named, c.jam, c.before = np.zeros(k + 1, dtype=int), numbers(), np.zeros(MODE_NUMBERS * k)
    c.loose, c.part, c.best, c.other, c.unsought = flags(), flags(), flags(), flags(), np.zeros(1, dtype=int)
    c.signs, c.forces, c.sizes, c.trial, c.factors = numbers(), numbers(), numbers(), numbers(), numbers()
    c.box.order[:] = np.arange(k)
    for i, row in enumerate(problem.rows):
        read.static[i] = row.kappa if row.apart.size else row.beta
        rows.pressed[i] = int(row.apart.size > 0)
        for part in range(row.apart.size):
            posed.apart[2 * i + part] = row.apart[part]
            posed.parts[(2 * i + part) * k : (2 * i + part + 1) * k] = row.parts[part]
    read.sliding = read.static.copy()
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
        code = SOLVE(c, k, 1.0)
        assert code in (SAME, SEVERAL_BY_REACTION) or not there
        if code in (SAME, SEVERAL_BY_REACTION):
            assert problem.miss(c.forces) < 1e-8
            assert (code == SEVERAL_BY_REACTION) >= (len(there) > 1)
            several += len(there) > 1
    assert several > 0


def test_two_pins_across_each_other_have_two_motions_and_are_named() -> None:
    """Each presses the other: both slide, or one of them does."""
    problem = crossed()
    c = rows_at_rest(problem)
    assert len(motions(problem)) > 1
    assert SOLVE(c, 2, 1.0) == SEVERAL_BY_REACTION
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

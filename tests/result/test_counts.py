"""Counts of a run: iterations of laws, corrections and implicit stages are one number."""

import pytest

import symgen


@pytest.mark.parametrize(
    ("method", "integrator", "least", "most"),
    [
        ("augmented-lagrangian", "rk4", 4, 4 * 20),  # in each of the four evaluations of a step
        ("augmented-hamiltonian", "rk4", 4, 4 * 20),
        ("generalized-alpha", "generalized-alpha", 1, 20),  # of Newton, once a step at least
        ("rattle", "rattle", 1, 100),
        ("discrete-gradient", "discrete-gradient", 1, 100),
        ("symmetric-projection", "gauss", 2, 100),
        ("index3-augmented-lagrangian", "trapezoidal", 1, 100),
    ],
)
def test_iterations_are_counted_wherever_they_are_made(method, integrator, least, most):
    steps = 50
    result = symgen.load("four-bar").simulate(method=method, integrator=integrator, step=1e-3, until=1e-3 * steps)
    assert result.ok and result.steps == steps
    assert least * steps <= result.iterations <= most * steps
    assert result.to_json()["iterations"] == result.iterations


def test_stages_solved_together_iterate_once_for_all():
    """Each iteration evaluates three residuals; a step begins with one evaluation and ends with the rates of three."""
    settings = {"method": "ggl", "integrator": "radau5", "options": {"integrator.adaptive": "false"}}
    result = symgen.load("four-bar").simulate(step=1e-2, until=0.5, times=[0.0, 0.5], **settings)
    assert result.ok and result.steps == 50
    assert result.evaluations == result.steps * (1 + 3) + 3 * result.iterations


def test_the_parts_of_a_continued_run_add_up():
    settings = {"method": "generalized-alpha", "integrator": "generalized-alpha", "step": 1e-3}
    model = symgen.load("four-bar")
    whole, first = model.simulate(until=0.1, **settings), model.simulate(until=0.05, **settings)
    second = model.simulate(until=0.1, start=first, **settings)
    assert first.iterations + second.iterations == whole.iterations > 0

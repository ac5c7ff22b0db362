"""Passages inside a step that its ends do not show, against bisection and quadrature."""

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

import symgen
from symgen import MechanismBuilder

#: Constant step, end of the runs [s] and functions of each; the fastest sine has a period of two thirds of a step.
STEP, UNTIL, FUNCTIONS = 0.05, 2.0, 25
Function = Callable[[Any], Any]


def random_functions(rng: np.random.Generator) -> tuple[dict[str, dict[str, str]], list[Function]]:
    """Return events at sums of sines of a body's way, and these functions of the time, which is the same number."""
    events, functions = {}, list[Function]()
    for k in range(FUNCTIONS):
        fast, shifts = 2.0 * np.pi / (STEP * rng.uniform(0.7, 4.0, 3)), rng.uniform(0.0, 6.0, 3)
        level = float(rng.uniform(-1.8, 1.8))
        sines = [f"{size}*sin({a}*ball.x + {b})" for size, a, b in zip((1.0, 0.8, 0.5), fast, shifts, strict=True)]
        events[f"g{k}"] = {"when": f"{' + '.join(sines)} - {level}", "direction": "any"}

        def g(t: Any, fast: Any = fast, shifts: Any = shifts, level: float = level) -> Any:
            return (
                sum(size * np.sin(a * t + b) for size, a, b in zip((1.0, 0.8, 0.5), fast, shifts, strict=True)) - level
            )

        functions.append(g)
    return events, functions


def roots(g: Function) -> Any:
    """Return where a function of time changes its sign, by bisection between a thousand points a step."""
    t = np.linspace(0.0, UNTIL, int(UNTIL / STEP * 1000) + 1)
    values = g(t)
    k = np.flatnonzero(values[:-1] * values[1:] < 0.0)
    low, high, rising = t[k], t[k + 1], values[k] < 0.0
    for _ in range(60):
        middle = 0.5 * (low + high)
        above = (g(middle) > 0.0) == rising
        low, high = np.where(above, low, middle), np.where(above, middle, high)
    return high


@pytest.mark.by_turns(6)
@pytest.mark.slow
@pytest.mark.parametrize(
    ("integrator", "settings"),
    [("rk4", {"step": STEP}), ("radau5", {"step": STEP}), ("picard", {"rtol": 1e-8}), ("dop853", {"rtol": 1e-8})],
)
def test_no_root_of_a_random_function_is_missed(integrator: str, settings: dict[str, float]) -> None:
    """A thousand functions in all: two roots are told apart that are a hundredth of a step away from each other."""
    rng = np.random.default_rng(len(integrator))
    builder = MechanismBuilder("crossings").body("ball", type="point", mass=1.0, velocity=[1.0, 0.0])
    model, count = symgen.load(builder.build()), 0
    for _ in range(10):
        events, functions = random_functions(rng)
        result = model.simulate(
            method="lagrange", integrator=integrator, until=UNTIL, output_step=UNTIL, events=events, **settings
        )
        step = max(STEP, UNTIL / result.steps)
        for k, g in enumerate(functions):
            expected = roots(g)
            found = np.array([event.t for event in result.events if event.name == f"g{k}"])
            away = np.array([np.abs(found - t).min(initial=np.inf) for t in expected])
            apart = np.diff(np.concatenate([[-1.0], expected, [UNTIL + 1.0]]))
            alone = np.minimum(apart[:-1], apart[1:]) > 0.01 * step
            assert (away[alone] < 1e-9).all(), (events[f"g{k}"], expected[alone & (away >= 1e-9)])
            assert all(np.abs(expected - t).min() < 1e-9 for t in found)
            count += len(expected)
    assert count > 5000

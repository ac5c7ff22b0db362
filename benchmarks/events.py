"""Events: a hundred thousand crossings at random, none of them missed; and what looking for them costs a step.

python -m benchmarks.events [CROSSINGS]
"""

from __future__ import annotations

import sys
import time
from typing import Any

import numpy as np
from rich.table import Table

import symgen
from benchmarks.show import show
from symgen import MechanismBuilder

#: Step of the runs [s], and switching functions of a run.
STEP, FUNCTIONS = 0.01, 8
_UNTIL = 40.0


def random_functions(rng: np.random.Generator) -> tuple[list[str], list[Any]]:
    """Return random sums of sines of a body's way, as text and as functions of the time, which is the same."""
    texts, functions = [], []
    for _ in range(FUNCTIONS):
        a, b, c = rng.uniform(5.0, 60.0, 3)
        u, v, w = rng.uniform(0.0, 6.0, 3)
        level = rng.uniform(-1.5, 1.5)
        texts.append(f"sin({a}*ball.x + {u}) + 0.9*sin({b}*ball.x + {v}) + 0.5*cos({c}*ball.x + {w}) > {level}")

        def g(t: Any, a: float = a, b: float = b, c: float = c, phases: Any = (u, v, w), level: float = level) -> Any:
            u, v, w = phases
            return np.sin(a * t + u) + 0.9 * np.sin(b * t + v) + 0.5 * np.cos(c * t + w) - level

        functions.append(g)
    return texts, functions


def changes(g: Any, until: float) -> tuple[Any, Any]:
    """Return where a function of time changes its sign, by bisection between a thousand points a step; and upwards."""
    t = np.linspace(0.0, until, int(until / STEP * 1000) + 1)
    values = g(t)
    k = np.flatnonzero(values[:-1] * values[1:] < 0.0)
    low, high, rising = t[k], t[k + 1], values[k] < 0.0
    for _ in range(60):
        middle = 0.5 * (low + high)
        above = (g(middle) > 0.0) == rising
        low, high = np.where(above, low, middle), np.where(above, middle, high)
    return high, rising


def crossings(wanted: int) -> list[tuple[str, ...]]:
    """Return what was found of as many crossings as are wanted."""
    rng, wide, narrow = np.random.default_rng(1), [0, 0], [0, 0]
    farthest, false, began = 0.0, 0, time.perf_counter()
    builder = MechanismBuilder("crossings").body("ball", type="point", mass=1.0, velocity=[1.0, 0.0])
    model = symgen.load(builder.build())
    while wide[0] < wanted:
        texts, functions = random_functions(rng)
        result = model.simulate(
            method="lagrange", step=STEP, until=_UNTIL, output_step=_UNTIL, events=dict(_tables(texts))
        )
        for k, g in enumerate(functions):
            expected, _ = changes(g, _UNTIL)
            passages = np.array([event.t for event in result.events if event.name == f"g{k}"])
            apart = np.diff(np.concatenate([[-1.0], expected, [_UNTIL + 1.0]]))
            lonely = (apart[:-1] > STEP) & (apart[1:] > STEP)
            nearest = np.abs(passages[np.clip(np.searchsorted(passages, expected), 0, len(passages) - 1)] - expected)
            before = np.abs(passages[np.clip(np.searchsorted(passages, expected) - 1, 0, len(passages) - 1)] - expected)
            distance = np.minimum(nearest, before)
            for count, chosen in ((wide, lonely), (narrow, ~lonely)):
                count[0] += int(chosen.sum())
                count[1] += int((distance[chosen] > 1e-9).sum())
            farthest = max(farthest, float(distance[distance < 1e-9].max(initial=0.0)))
            false += len(passages) - int((distance < 1e-9).sum())
    seconds = time.perf_counter() - began
    return [
        ("farther apart than a step", f"{wide[0]}", f"{wide[1]}"),
        ("nearer to each other", f"{narrow[0]}", f"{narrow[1]}"),
        ("found where there is none", "", f"{false}"),
        ("largest distance", "", f"{farthest:.1e} s"),
        ("time in all", "", f"{seconds:.0f} s"),
    ]


def _tables(texts: list[str]) -> list[tuple[str, dict[str, str]]]:
    return [(f"g{k}", {"when": text, "direction": "any"}) for k, text in enumerate(texts)]


def cost() -> list[tuple[str, ...]]:
    """Return what a step takes without and with events that do not happen."""
    rows = []
    for name in ("pendulum", "four-bar", "n-four-bar:10"):
        model = symgen.load(name)
        times: dict[str, list[float]] = {"": [], "BODY.x > 1e9": [], "BODY.vx > 1e9": []}
        body = model.mechanism.bodies[0].name
        settings: dict[str, Any] = {"until": 5.0, "step": 1e-4, "output_step": 5.0, "repeat": 3}
        for _ in range(3):  # in turns
            for when, seconds in times.items():
                conditions = [when.replace("BODY", body)] if when else []
                result = model.simulate(**settings, record_when=conditions)
                seconds.append(result.seconds.run / result.steps * 1e9)
        rows.append((name, *(f"{min(seconds):.0f}" for seconds in times.values())))
    return rows


def _shown(columns: tuple[str, ...], rows: list[tuple[str, ...]]) -> None:
    table = Table(*columns)
    for row in rows:
        table.add_row(*row)
    show(table)


if __name__ == "__main__":
    count = int(sys.argv[1]) if len(sys.argv) > 1 else 100_000
    _shown(("crossings", "there are", "missed"), crossings(count))
    _shown(("mechanism", "a step [ns]", "with an event of positions", "of velocities"), cost())

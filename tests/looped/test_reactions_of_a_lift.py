"""Reactions of a lift of a hundred bodies: Newton's and Euler's equations of each body, and what rounding does to them.

Pages and compiled code agree in the state to 1e-14 and in these reactions to some 1e-7 N of 7 kN. Both are right: each
set fulfils the equations of its own state, and states that are one rounding apart have reactions that far apart.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from support.emitted import mechanism_of

from benchmarks.editor import scissor_lift
from symgen.api import Model
from symgen.describe.files.load import parse_toml
from symgen.result.reactions import constraint_jacobian
from symgen.result.result import Result

pytestmark = pytest.mark.slow


def lift(bodies: int) -> Result:
    model = Model(mechanism_of(parse_toml(scissor_lift(bodies), "lift")))
    return model.simulate(until=0.5, integrator="rk4", step=0.001, output_step=0.5, shape="looped")


def turned(angle: float, point: np.ndarray) -> np.ndarray:
    c, s = np.cos(angle), np.sin(angle)
    return np.array([c * point[0] - s * point[1], s * point[0] + c * point[1]])


def largest_unbalanced_load(bodies: int, run: Result) -> float:
    """Return the largest difference [N] of force and rate of momentum of a body; moments are over half of a bar."""
    file, worst, row = parse_toml(scissor_lift(bodies), "lift"), 0.0, run.whole().row()

    def from_centre(name: str, place: str) -> np.ndarray:
        own = np.zeros(2) if place == "centre" else np.array(file["bodies"][name]["points"][place])
        return turned(row[f"{name}.theta"], own)

    feet = {name: np.array([row[f"{name}.x"], row[f"{name}.y"]]) + from_centre(name, "A") for name in ("a0", "b0")}
    way = feet["b0"] - feet["a0"]
    push = row["hold.force"] * way / np.linalg.norm(way)
    for name, body in file["bodies"].items():
        inertia = file["parameters"]["J"] if body["inertia"] == "J" else body["inertia"]
        loads = [(np.zeros(2), np.array([0.0, -9.81 * body["mass"]]))]
        for joint, table in file["joints"].items():
            if name in table["between"]:
                side = table["between"].index(name)  # reactions act on the first body
                force = (1 - 2 * side) * np.array([row.get(f"{joint}.Fx", 0.0), row[f"{joint}.Fy"]])
                loads.append((from_centre(name, table["at"][side]), force))
        if name in feet:
            loads.append((from_centre(name, "A"), push if name == "b0" else -push))
        missing = sum(force for _, force in loads) - body["mass"] * np.array([row[f"{name}.ax"], row[f"{name}.ay"]])
        moment = sum(p[0] * f[1] - p[1] * f[0] for p, f in loads) - inertia * row[f"{name}.alpha"]
        worst = max(worst, float(np.abs(missing).max()), abs(moment) / 0.25)
    return worst


@pytest.mark.parametrize("bodies", [6, 100])
def test_reactions_balance_each_body(bodies: int) -> None:
    run = lift(bodies)
    assert largest_unbalanced_load(bodies, run) < 1e-14 * float(np.abs(run.reactions.values).max())


def test_reactions_of_a_hundred_bodies_follow_the_last_digit_of_the_state() -> None:
    outcome = lift(100).forces.outcome
    y, status, chance = outcome.states[-1], outcome.status_columns[-1:], np.random.default_rng(1)

    def multipliers(state: np.ndarray) -> np.ndarray:
        return replace(outcome, times=outcome.times[-1:], states=state[np.newaxis], status_columns=status).multipliers[
            0
        ]

    own = multipliers(y)
    others = [multipliers(y * (1.0 + 1e-14 * chance.standard_normal(len(y)))) for _ in range(5)]
    change = float(np.median([np.abs(other - own).max() for other in others]))
    assert 1e-8 < change < 1e-5  # of 7 kN: 10 to 10,000 times what rounding is of these
    masses = np.array([1.0, 1.0, 0.025, *[1.0, 1.0, 0.02] * 99])
    masses[5] = 0.025
    d = constraint_jacobian(outcome, float(outcome.times[-1]), y)
    assert 1e6 < np.linalg.cond(d / masses @ d.T) < 1e9

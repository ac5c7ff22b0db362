"""Two right-hand sides where rows have bounds: one with these rows, and one for motions with none of them in force."""

from collections.abc import Mapping
from typing import Any

import numpy as np
import pytest

from symgen import Settings
from symgen.derive.formulate.formulate import formulate
from symgen.derive.lower.model import lower_model
from symgen.describe.files.load import read_raw
from symgen.describe.files.validate import validate
from symgen.describe.mechanism import Mechanism
from symgen.run.compiling.free_by_loops import law_at_start
from symgen.run.compiling.method_choice import choose_method
from symgen.run.layout import abi
from symgen.run.layout.probe import Ready
from symgen.run.planning.prepare import Prepared, prepare

#: Bodies of the pins of the four-bar, in the order of their rate.
PINS = {"A": ("", "crank"), "B": ("crank", "coupler"), "C": ("coupler", "rocker"), "D": ("", "rocker")}
#: Friction by the reaction of a pin.
BY_REACTION = {"coefficient": 0.5, "radius": 0.1}


def four_bar(friction: Mapping[str, float], pins: str, torques: Mapping[str, float] | None = None) -> Mechanism:
    """Return the four-bar of the catalogue with dry pins, or with torques on its bodies."""
    raw, source = read_raw("four-bar")
    raw["bodies"]["crank"]["angular_velocity"] = 2.0
    for pin in pins:
        raw["joints"][pin]["friction"] = dict(friction)
    for body, torque in (torques or {}).items():
        raw.setdefault("forces", {})[f"on_{body}"] = {"type": "torque", "body": body, "torque": torque}
    return validate(raw, source)


def operations(mechanism: Mechanism) -> Mapping[str, int]:
    """Return the operations of the functions of a law."""
    equations, choice = formulate(mechanism), choose_method("direct-correction", {"weight": "mass"})
    return law_at_start(mechanism, equations, lower_model(equations, ""), choice).info.operations


def rates(
    run: Prepared, signs: Mapping[str, float], moved: float, doubtful: int = 0
) -> tuple[np.ndarray[Any, Any], ...]:
    """Return v' and the multipliers of joints where friction has some signs, at a start with other velocities.

    `doubtful`: what the right-hand side returns.
    """
    compiled, y, p, w = run.compiled, run.start.y.copy(), run.start.p.copy(), run.start.w.copy()
    info, iw, rate = compiled.info, np.zeros(abi.N_COUNTERS, dtype=np.int64), np.zeros_like(run.start.y)
    y[info.nq : info.nq + info.nv] *= moved
    for row, modes in zip(info.switchable, compiled.modes(w), strict=True):
        modes[:] = 0.0, 0.0, signs[info.rows[row].joint], 0.0, 0.0
    assert Ready(compiled.law_module.rhs, abi.RHS)(0.0, y, p, w, iw, rate) == doubtful
    if doubtful:
        assert Ready(compiled.law_module.confirm, abi.RHS)(0.0, y, p, w, iw, rate) == 0
        assert not iw.any(), "no row is left out"
    own = [i for i in range(info.m) if i not in info.bounded]
    by_pivots = np.zeros_like(rate)
    assert Ready(compiled.law_module.confirm, abi.RHS)(0.0, y, p, w.copy(), iw, by_pivots) == 0
    np.testing.assert_allclose(by_pivots, rate, rtol=1e-11, atol=1e-11 * np.abs(rate).max())
    multipliers = compiled.section(w, "multipliers")
    assert not multipliers[list(info.bounded)].any()
    return rate[info.nq : info.nq + info.nv].copy(), multipliers[own].copy()


@pytest.mark.slow_cases("one-by-reaction", "two-by-reaction")
@pytest.mark.parametrize(
    ("friction", "pins", "more"),
    [({"sliding": 4.0}, "A", 8), ({"sliding": 4.0}, "ABCD", 28), (BY_REACTION, "A", 96), (BY_REACTION, "AB", 332)],
    ids=["one", "four", "one-by-reaction", "two-by-reaction"],
)
def test_sliding_costs_few_operations(friction: dict[str, float], pins: str, more: int) -> None:
    """No row of friction takes part in the elimination while none is in force."""
    plain, dry = operations(four_bar({}, "")), operations(four_bar(friction, pins))
    assert dry["rhs"] == dry["rhs_free"] <= plain["rhs"] + more
    assert dry["rhs_held"] > dry["rhs_free"]


@pytest.mark.slow
@pytest.mark.parametrize("coordinates", ["absolute", "joint"])
def test_friction_in_motion_is_a_torque(coordinates: str) -> None:
    """Constant friction of given signs is a torque on both bodies: the same accelerations and forces of joints."""
    signs = {"A": 1.0, "B": -1.0, "C": 1.0, "D": -1.0}
    torques = dict.fromkeys(("crank", "coupler", "rocker"), 0.0)
    for pin, (first, second) in PINS.items():
        for body, sign in ((first, 1.0), (second, -1.0)):
            if body:
                torques[body] += sign * signs[pin] * 4.0
    settings = Settings(method="direct-correction", integrator="dop853", coordinates=coordinates)
    dry = prepare(four_bar({"sliding": 4.0}, "ABCD"), settings)
    driven = prepare(four_bar({}, "", torques), settings)
    for mine, other in zip(rates(dry, signs, 0.7), rates(driven, {}, 0.7), strict=True):
        np.testing.assert_allclose(mine, other, rtol=1e-12, atol=1e-12 * np.abs(other).max())


@pytest.mark.by_turns(6)
@pytest.mark.slow
@pytest.mark.parametrize(
    ("pins", "radius", "doubtful", "method"),
    [
        ("AB", 0.1, 0, "direct-correction"),
        ("ABCD", 0.1, 0, "direct-correction"),
        ("ABCD", 1.6, 1, "direct-correction"),
        ("ABC", 0.1, 0, "invariant-stabilization"),  # which does not eliminate
        ("BC", 0.1, 0, "udwadia-kalaba"),
    ],
)
def test_friction_by_reactions_is_a_torque_of_their_size(pins: str, radius: float, doubtful: int, method: str) -> None:
    """Where few iterations do not find the forces, the function for rows in force does."""
    signs = {"A": 1.0, "B": -1.0, "C": 1.0, "D": -1.0}
    settings = Settings(method=method, integrator="dop853", coordinates="absolute")
    dry = prepare(four_bar(BY_REACTION | {"radius": radius}, pins), settings)
    accelerations, multipliers = rates(dry, signs, 0.7, doubtful)
    rows = [row.name for i, row in enumerate(dry.compiled.info.rows) if i not in dry.compiled.info.bounded]
    reactions = dict(zip(rows, multipliers, strict=True))
    torques = dict.fromkeys(("crank", "coupler", "rocker"), 0.0)
    for pin in pins:
        torque = 0.5 * radius * float(np.hypot(reactions[f"{pin}.x"], reactions[f"{pin}.y"]))
        for body, sign in zip(PINS[pin], (1.0, -1.0), strict=True):
            if body:
                torques[body] += sign * signs[pin] * torque
    driven = rates(prepare(four_bar({}, "", torques), settings), {}, 0.7)
    for mine, other in zip((accelerations, multipliers), driven, strict=True):
        np.testing.assert_allclose(mine, other, rtol=1e-12, atol=1e-12 * np.abs(other).max())

"""Motions of drivers that jump are refused before anything runs; those that only change their formula are not."""

import math

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from support.emitted import mechanism_of

import symgen
from symgen.base.errors import InputError
from symgen.run.breaks.refused_motions import refuse_jumps
from symgen.study.stress.bench import Level
from symgen.study.stress.cells import CellReference, RunTask, compute_cell

MASS, ARM, INERTIA, G = 1.0, 0.5, 0.1, 9.81


def cart(value: str) -> dict:
    """A pendulum on a cart that is driven."""
    return {
        "mechanism": {"name": "pushed", "gravity": [0.0, -G]},
        "parameters": {"late": 0.5},
        "tables": {"cam": {"x": [0.0, 0.5, 1.0, 2.0], "y": [0.0, 0.4, 0.1, 0.3], "interpolation": "cubic"}},
        "bodies": {
            "cart": {"mass": 1.0, "inertia": 1.0},
            "rod": {
                "mass": MASS,
                "inertia": INERTIA,
                "points": {"top": [0.0, ARM]},
                "position": [ARM * math.sin(1.0), -ARM * math.cos(1.0)],
                "angle": 1.0,
            },
        },
        "joints": {
            "guide": {"type": "translational", "between": ["ground", "cart"], "at": [[0, 0], "centre"], "axis": [1, 0]},
            "pin": {"type": "revolute", "between": ["cart", "rod"], "at": ["centre", "top"]},
            "motor": {"type": "driver", "joint": "guide", "value": value},
        },
    }


@pytest.mark.parametrize(
    ("value", "said"),
    [
        ("0 if t < late else 0.1", "a value that jumps by 0.1 m at t = 0.5 s"),
        ("0.02*max(0, t - late)", "a rate that jumps by 0.02 m/s at t = 0.5 s"),
        ("abs(t - 0.25)", "a rate that jumps by 2 m/s at t = 0.25 s"),
        ("0.1*sin(2*t) + 1e-6*max(0, t - late)", "a rate that jumps by"),
        ("min(cam(t), 0.2)", "a rate that jumps by"),
        ("0.1*sign(sin(7*t))", "a value that jumps by -0.2 m at t = 0.448799 s"),
        ("t if t < 0.3 and t < late else 0.3", "a rate that jumps by -1 m/s at t = 0.3 s"),
    ],
)
def test_motions_that_jump_are_refused(value, said):
    mechanism = mechanism_of(cart(value))
    for coordinates in ("absolute", "joint"):
        with pytest.raises(InputError, match=r"joints\.motor\.value: expected a motion whose value and rate") as caught:
            symgen.simulate(mechanism, until=1.0, coordinates=coordinates)
        assert said in str(caught.value)
    with pytest.raises(InputError, match=r"joints\.motor\.value"):
        symgen.compare(mechanism, ["lagrange"], ["rk4"], [0.01], until=1.0)
    if "late" not in value:
        with pytest.raises(InputError, match=r"joints\.motor\.value"):
            symgen.sweep(mechanism, {"late": [0.4, 0.5]}, until=1.0)
    assert refuse_jumps(mechanism, {}, 0.1) is None


@pytest.mark.parametrize(
    "value",
    [
        "0 if t < late else (t - late)**2",
        "max(0, t - late)**1.5",
        "abs(t - late)**3 + cam(t)",
        "min(t/late, 1)**3*(10 - 15*min(t/late, 1) + 6*min(t/late, 1)**2)",
        "sin(t) if t < 3 else t",
        "max(sin(t), t/2 - 1)",
        "tanh(200*(t - late))*abs(t - late)*(t - late)",
        "1 if t < late else 1 + 0*t",
        "1e6 + max(0, t - late)**2",
        "0.1*sin(2*t) + 1e-8*max(0, t - late)",
    ],
)
def test_motions_that_change_smoothly_are_not(value):
    assert refuse_jumps(mechanism_of(cart(value)), {}, 1.0) is None


@pytest.mark.slow
@pytest.mark.parametrize("coordinates", ["absolute", "joint"])
def test_rows_whose_own_motion_jumps_fail(coordinates):
    raw = cart("speed*max(0, t - late)")
    raw["parameters"] |= {"quick": 0.0, "speed": "2*sqrt(quick)**2"}
    vary = {"quick": [0.0, 0.25, -1.0], "late": [0.4, 1.5]}
    found = symgen.sweep(mechanism_of(raw), vary, until=1.0, coordinates=coordinates)
    assert found.status.tolist() == ["ok", "ok", "failed", "ok", "failed", "failed"]
    assert "a rate that jumps by 0.5 m/s at t = 0.4 s" in found.reason[2]
    assert "values for which every formula is finite" in found.reason[4]


def test_rows_of_stress_whose_motion_jumps_are_refused():
    mechanism = mechanism_of(cart("0 if t < late else 0.1"))
    level = Level("at half the time", (0.5,), mechanism, until=1.0, step=1e-2)
    found = compute_cell(RunTask(level, "lagrange", "rk4", compute_cell(CellReference(level))))
    assert found["outcome"] == "refused" and "a value that jumps by 0.1 m at t = 0.5 s" in found["reason"]


def test_a_motion_that_is_not_refused_swings_as_the_cart_accelerates():
    result = symgen.simulate(mechanism_of(cart("0 if t < late else (t - late)**2")), until=1.0, integrator="dopri5")
    assert result.status == "ok"
    state = [1.0, 0.0]
    for begin, end, pushed in ((0.0, 0.5, 0.0), (0.5, 1.0, 2.0)):

        def rate(t, y, pushed=pushed):
            load = -MASS * ARM * (G * math.sin(y[0]) + pushed * math.cos(y[0]))
            return [y[1], load / (INERTIA + MASS * ARM**2)]

        state = solve_ivp(rate, (begin, end), state, rtol=1e-11, atol=1e-12).y[:, -1]
    np.testing.assert_allclose([result.q["rod.theta"][-1], result.v["rod.omega"][-1]], state, rtol=1e-6)

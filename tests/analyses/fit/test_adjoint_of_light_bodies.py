"""The adjoint of mechanisms with bodies without mass, whose accelerations are found by iteration."""

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from support.rotation import of_turn

import symgen
from symgen.base.errors import InputError
from symgen.describe.files.validate import validate

R, ROD, ANGLE, SPEED, G = 0.1, 0.35, 1.0, 6.0, 9.81
TIGHT = {"until": 0.6, "integrator": "dop853", "rtol": 1e-11, "atol": 1e-12}


def light_crank(damping=0.0):
    """A crank, a slider on a spring, and a rod between them without mass and moment of inertia."""
    pin = np.array([R * np.cos(ANGLE), R * np.sin(ANGLE)])
    lean = -np.arcsin(pin[1] / ROD)
    end = float(pin[0] + ROD * np.cos(lean))
    between = {"type": "revolute"}
    raw = {
        "mechanism": {"name": "light-crank", "gravity": [0.0, -G]},
        "parameters": {"m": 0.8, "k": 40.0},
        "bodies": {
            "crank": {
                **{"mass": "m", "inertia": f"m*{R}**2/12", "points": {"O": [-R / 2, 0.0], "P": [R / 2, 0.0]}},
                **{"position": (pin / 2).tolist(), "angle": ANGLE},
            },
            "rod": {
                **{"mass": 0.0, "inertia": 0.0, "points": {"P": [-ROD / 2, 0.0], "Q": [ROD / 2, 0.0]}},
                **{"position": [float(pin[0] + end) / 2, float(pin[1]) / 2], "angle": float(lean)},
            },
            "slider": {"mass": 0.5, "inertia": 0.01, "position": [end, 0.0]},
        },
        "joints": {
            "A": {**between, "between": ["ground", "crank"], "at": [[0.0, 0.0], "O"], "start": {"rate": SPEED}},
            "P": {**between, "between": ["crank", "rod"], "at": ["P", "P"]},
            "Q": {**between, "between": ["rod", "slider"], "at": ["Q", "centre"]},
            "guide": {
                **{"type": "translational", "between": ["ground", "slider"], "at": [[0.0, 0.0], "centre"]},
                **{"axis": [1.0, 0.0], "angle": 0.0},
            },
        },
        "forces": {"spring": {"type": "force", "body": "slider", "force": [f"-k*slider.x - {damping}*slider.vx", 0.0]}},
    }
    return symgen.load(validate(raw, "light-crank.toml"))


def swung(m, k, until):
    """The angle of the crank by Lagrange's equation; numbers may be complex."""

    def place(a):
        root = np.sqrt(ROD**2 - (R * np.sin(a)) ** 2)
        x = R * np.cos(a) + root
        by = -R * np.sin(a) - R**2 * np.sin(a) * np.cos(a) / root
        twice = -R * np.cos(a) - R**2 * (np.cos(2 * a) / root + (R * np.sin(a) * np.cos(a)) ** 2 / root**3)
        return x, by, twice

    def rates(t, y):
        a, w = y
        x, by, twice = place(a)
        torque = -k * x * by - m * G * R / 2 * np.cos(a) - 0.5 * by * twice * w**2
        return np.array([w, torque / (m * R**2 / 3 + 0.5 * by**2)])

    y = np.array([ANGLE, SPEED], dtype=complex)
    return solve_ivp(rates, (0.0, until), y, method="DOP853", rtol=1e-12, atol=1e-12).y[0, -1]


@pytest.mark.by_turns(2)
@pytest.mark.slow
@pytest.mark.parametrize("coordinates", ["absolute", pytest.param("joint", marks=pytest.mark.slow)])
def test_a_rod_without_mass_between_a_crank_and_a_slider(coordinates):
    """Derivatives of the last angle by complex steps of Lagrange's equation."""
    found = light_crank().gradient("crank.theta", by=("m", "k"), way="adjoint", coordinates=coordinates, **TIGHT)
    step = 1e-30j
    exact = swung(0.8 + step, 40.0, 0.6).imag / 1e-30, swung(0.8, 40.0 + step, 0.6).imag / 1e-30
    assert abs(found.value - swung(0.8, 40.0, 0.6).real) < 1e-9
    np.testing.assert_allclose([found.by["m"], found.by["k"]], exact, rtol=0.0, atol=1e-8)


@pytest.mark.by_turns(4)
@pytest.mark.slow
@pytest.mark.parametrize("coordinates", ["absolute", "joint"])
def test_both_ways_agree_over_300_masses(coordinates):
    model, settings = light_crank(0.3), {"coordinates": coordinates, **TIGHT}
    apart, masses = [], of_turn(np.linspace(0.1, 4.0, 300), 3)
    for m in masses:
        keys = {"by": ("m", "k"), "parameters": {"m": float(m)}, **settings}
        forward, adjoint = (model.gradient("crank.theta", way=way, **keys) for way in ("forward", "adjoint"))
        apart += [abs(forward.by[name] - adjoint.by[name]) for name in ("m", "k")]
    assert len(apart) == 2 * len(masses) and max(apart) < 1e-10


def test_methods_that_choose_their_coordinates_have_no_adjoint():
    with pytest.raises(InputError, match="adjoint: expected functions of the state in closed form"):
        symgen.load("four-bar").gradient(
            "crank.theta", by=("crank_mass",), way="adjoint", method="null-space", until=0.1
        )

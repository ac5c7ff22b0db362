"""An aim by `rms` is an integral over the motion: lengths of a straight-line linkage beside SciPy and Gauss's rule."""

import math
import re

import numpy as np
import pytest
from analyses.rods import of_raw
from scipy.optimize import least_squares, minimize_scalar

from study.design.machines import PRESS_BOX, pin, press

LENGTHS = {"g": 0.21, "c": 0.26, "b": 0.24, "e": 0.26, "h": 0.39}
BOX = {"g": (0.15, 0.4), "c": (0.2, 0.5), "b": (0.2, 0.5), "e": (0.2, 0.5), "h": (0.2, 0.9)}
CRANK = 0.1


def straight_line(sweep):
    """Return a four-bar whose crank turns about pi by a sweep, and how far its coupler is off a line [mm]."""
    begin = math.pi - 0.5 * sweep
    return {
        "mechanism": {"name": "line"},
        "run": {"until": 1.0},
        "parameters": {name: {"value": x, "unit": "m"} for name, x in LENGTHS.items()},
        "bodies": {
            "crank": {"mass": 1.0, "inertia": 0.001, "points": {"B": [CRANK, 0.0]}, "angle": begin},
            "coupler": {
                "mass": 1.0,
                "inertia": 0.02,
                "points": {"C": ["c", 0.0], "P": ["c + e", 0.0]},
                "position": [CRANK * math.cos(begin), CRANK * math.sin(begin)],
                "angle": 0.6,
            },
            "rocker": {
                "mass": 1.0,
                "inertia": 0.01,
                "points": {"C": ["b", 0.0]},
                "position": ["g", 0.0],
                "angle": 1.57,
            },
        },
        "joints": {
            "O": pin("ground", "crank", [[0.0, 0.0], "origin"]),
            "B": pin("crank", "coupler", ["B", "origin"]),
            "C": pin("coupler", "rocker", ["C", "C"]),
            "D": pin("ground", "rocker", [["g", 0.0], "origin"]),
            "motor": {"type": "driver", "joint": "O", "value": f"{begin!r} + {sweep!r}*t"},
        },
        "outputs": {"off": {"value": "1000*(coupler.P.y - h)", "unit": "mm"}},
    }


def best_lengths(sweep):
    """Return the lengths of the least integral, by 80 points of Gauss and two circles that meet."""
    points, weights = np.polynomial.legendre.leggauss(80)
    angle = np.pi + 0.5 * sweep * points

    def residuals(x):
        g, c, b, e, h = x
        pin_b = CRANK * np.stack([np.cos(angle), np.sin(angle)], axis=1)
        way = np.array([g, 0.0]) - pin_b
        distance = np.hypot(*way.T)
        along = (c**2 - b**2 + distance**2) / (2.0 * distance)
        unit = way / distance[:, None]
        across = np.stack([-unit[:, 1], unit[:, 0]], axis=1)
        arm = along[:, None] * unit + np.sqrt(c**2 - along**2)[:, None] * across
        return np.sqrt(0.5 * weights) * 1000.0 * (pin_b[:, 1] + arm[:, 1] * (1.0 + e / c) - h)

    found = least_squares(residuals, [0.228, 0.2922, 0.2922, 0.2922, 0.4837], xtol=1e-15, ftol=1e-15, gtol=1e-15)
    return found.x, np.linalg.norm(found.fun)


@pytest.mark.slow
@pytest.mark.parametrize("sweep", [2.7, 2.9, 3.0, math.pi, 3.3, 3.5])
def test_lengths_of_a_straight_line_are_right_to_the_micrometre(sweep):
    found = of_raw(straight_line(float(sweep))).design(BOX, "rms(off)")
    expected, least = best_lengths(sweep)
    assert found.ok
    assert found.after == pytest.approx(least, rel=1e-9)
    assert [*found.values.values()] == pytest.approx(expected, abs=1e-7)
    assert "known to" not in "; ".join(found.notes)


@pytest.mark.slow
def test_a_kink_limits_what_a_mean_tells_and_a_note_says_how_far():
    machine = of_raw(press())
    found = machine.design({name: PRESS_BOX[name] for name in ("a", "r")}, "rms(motor.effort)", "mu <= 0.7")
    (known,) = (
        float(said[1])
        for note in found.notes
        if (said := re.fullmatch(r"a is known to (\S+) m, as .* no better", note))
    )
    assert found.values["r"] == pytest.approx(PRESS_BOX["r"][0])
    times = np.linspace(0.0, 1.0, 28_801)

    def mean_square(a):
        motion = machine.kinematics(times, parameters={"a": float(a), "r": found.values["r"]})
        return np.trapezoid(motion.efforts["motor"] ** 2, times)

    a = found.values["a"]
    best = minimize_scalar(mean_square, bounds=(a - 2e-4, a + 2e-4), method="bounded", options={"xatol": 1e-8})
    assert 1e-7 < known < 1e-5
    assert abs(best.x - a) < known

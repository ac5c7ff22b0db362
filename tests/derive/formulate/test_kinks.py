"""Formulas that are differentiated although they have kinks: away from those, derivatives are the one-sided ones."""

import mpmath
import numpy as np
import pytest
from support.checks import close
from support.emitted import Emitted, mechanism_of
from support.plain import Plain

OF_TIME = (
    "abs(t - 1)",
    "min(t, 1)",
    "max(t**2, 0.5, k1*t)",
    "sign(t - 1)*t",
    "abs(sin(3*t))",
    "piecewise(t < 1, t**2, 2*t - 1)",
    "t**3 if t < 1 and not t < 0.5 else sqrt(t)",
    "max(t - 1, 0)**3",
    "abs(t)**2.5 + k1**t + atan2(t, k1)",
    "min(t**2, sin(t))*max(k1, 0.3)",
    # what SymPy does not know to be real, and conditions on choices
    "abs(log(t + 0.2))",
    "sign(sqrt(t) - 0.5)*t**2",
    "abs(sqrt(t) - 1.3)*abs((t - 0.1)**k1)",
    "abs(log(t + 1) if t < 1 else t)",
    "t**2 if min(t, 1) > (0.5 if t < k1 else 2) and sqrt(t) < k1 else t**3",
)
POTENTIALS = (
    "max(length - 1, 0)**2",
    "abs(length - 1)**3 + sign(length - 1)*length",
    "min(length, k1)**2",
    "piecewise(length < 1, 0, (length - 1)**2)",
    "max(0, k1*(length - 0.1))**1.5 + length**k1",
    "log(length)*abs(length**k1 - 1.1)",
)


@pytest.mark.parametrize("text", OF_TIME)
def test_driver(text):
    raw = {
        "mechanism": {"name": "driven"},
        "parameters": {"k1": 1.7},
        "bodies": {"b": {"mass": 1.0, "inertia": 1.0}},
        "joints": {"drive": {"type": "driver", "body": "b", "coordinate": "x", "value": text}},
    }
    plain, emitted = Plain(raw), Emitted(mechanism_of(raw))
    p = emitted.parameters(plain.values)
    for t in (0.3, 0.75, 1.4):
        found = emitted.at(t, [0.1, 0.2, 0.3], [0.0, 0.0, 0.0], p)
        with mpmath.workdps(60):
            m, h = plain.using(mpmath), mpmath.mpf(10) ** -15
            before, here, after = (mpmath.mpf(m.number(text, t=mpmath.mpf(t) + k * h)) for k in (-1, 0, 1))
            slope, bend = float((after - before) / (2 * h)), float((after - 2 * here + before) / h**2)
        close([0.1 - found.phi[0], found.nu[0], found.gamma[0]], [float(here), slope, bend], f"{text} at {t}", 1e-12)


@pytest.mark.parametrize("text", POTENTIALS)
def test_potential(text):
    raw = {
        "mechanism": {"name": "sprung"},
        "parameters": {"k1": 1.7},
        "bodies": {"b": {"mass": 1.0, "inertia": 1.0}},
        "forces": {
            "spring": {
                "type": "spring-damper",
                "between": ["ground", "b"],
                "at": [[0.0, 0.0], "centre"],
                "potential": text,
            }
        },
    }
    plain, emitted = Plain(raw), Emitted(mechanism_of(raw))
    p, h = emitted.parameters(plain.values), 1e-6
    for length in (0.6, 1.3, 2.1):
        found = emitted.at(0.0, [0.6 * length, 0.8 * length, 0.3], [0.0, 0.0, 0.0], p)
        slope = (plain.number(text, length=length + h) - plain.number(text, length=length - h)) / (2 * h)
        np.testing.assert_allclose(found.acceleration, [-0.6 * slope, -0.8 * slope, 0.0], atol=1e-8)
        close(found.status["potential"], plain.number(text, length=length), text)


def test_a_table_is_one_function_wherever_it_is_called():
    def rates(text):
        raw = {
            "mechanism": {"name": "driven"},
            "tables": {"cam": {"x": [0.0, 0.5, 1.0, 2.0], "y": [0.0, 0.4, 0.1, 0.3], "interpolation": "cubic"}},
            "bodies": {"b": {"mass": 1.0, "inertia": 1.0}},
            "joints": {"drive": {"type": "driver", "body": "b", "coordinate": "x", "value": text}},
        }
        emitted = Emitted(mechanism_of(raw))
        found = emitted.at(0.7, [0.0] * 3, [0.0] * 3, emitted.parameters({}))
        return found.nu[0], found.gamma[0]

    nu, gamma = rates("cam(t)")
    assert nu != 0.0 and gamma != 0.0
    assert rates("max(cam(t), cam(t))") == (nu, gamma)
    assert rates("abs(cam(t))") == (nu, gamma)

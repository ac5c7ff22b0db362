"""Damping of beams by strain: decays of modes in closed form, a cable that damps bending alone, and bad input."""

import numpy as np
import pytest
from support.emitted import mechanism_of

from symgen.api import load
from symgen.base.errors import InputError

AXIAL, BENDING = 1e-5, 4e-4


def blade(damping: object) -> dict:
    return {
        "mechanism": {"name": "blade", "gravity": [0.0, 0.0]},
        "beams": {
            "blade": {
                **{"start": [0.0, 0.0], "end": [0.4, 0.0], "elements": 4, "clamp": "ground", "damping": damping},
                **{"axial": 2.0e5, "bending": 3.0, "mass": 0.5, "rotary": 1e-5},
            }
        },
    }


def test_modes_of_stretch_and_of_bending_decay_by_their_own_times() -> None:
    """A mode whose stress follows strain plus tau times its rate has an eigenvalue s with -2 Re s = tau |s|^2."""
    found = load(mechanism_of(blade({"axial": AXIAL, "bending": BENDING}))).modes().eigenvalues
    found = found[np.abs(found.imag) > 0.0]
    times = np.sort(-2.0 * found.real / np.abs(found) ** 2)
    lower = times[times < 1e-4]
    assert len(lower) >= 6 and len(times) - len(lower) >= 6
    assert lower == pytest.approx(AXIAL, rel=1e-7)
    assert times[times > 1e-4] == pytest.approx(BENDING, rel=1e-7)


@pytest.mark.slow
def test_a_cable_that_damps_bending_alone_runs_by_default() -> None:
    cable = {
        "mechanism": {"name": "cable", "gravity": [0.0, -9.81]},
        "beams": {
            "rope": {
                **{"start": [0.0, 0.0], "end": [1.0, 0.0], "elements": 6, "damping": {"bending": 2e-3}},
                **{"axial": 4.0e4, "bending": 0.02, "mass": 0.1, "rotary": 1e-6},
            }
        },
        "joints": {"hook": {"type": "revolute", "between": ["ground", "rope.start"], "at": [[0.0, 0.0], "centre"]}},
    }
    result = load(mechanism_of(cable)).simulate(until=0.3)
    assert result.ok, result.reason
    assert result["rope.end.y"][-1] < -0.3


@pytest.mark.parametrize(
    ("damping", "sentence"),
    [
        ({"bending": -1e-3}, "damping.bending: expected a time of 0 or more, got -0.001"),
        ({"torsion": 1e-3}, "damping.torsion: expected no twist in the plane, got 0.001"),
        ({"bend": 1e-3}, "did you mean 'bending'?"),
        (-1e-3, "damping: expected a time of 0 or more, got -0.001"),
    ],
)
def test_what_is_no_damping(damping: object, sentence: str) -> None:
    with pytest.raises(InputError) as error:
        mechanism_of(blade(damping))
    assert sentence in str(error.value)

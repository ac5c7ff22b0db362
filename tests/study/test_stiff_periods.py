"""The family of stiff undamped periods: its closed form, and the phase errors that theory gives to constant steps."""

import math

import numpy as np
import pytest

from symgen.api import Model
from symgen.study.stress.bench import Base
from symgen.study.stress.cell_references import reference_of_cell
from symgen.study.stress.families import levels_of_family


@pytest.mark.parametrize(
    ("method", "integrator", "ratio"),
    [
        ("direct-correction", "rk4", lambda z: sum(z**k / math.factorial(k) for k in range(5))),
        ("index3-augmented-lagrangian", "trapezoidal", lambda z: (1 + z / 2) / (1 - z / 2)),
    ],
)
def test_constant_steps_lose_the_phase_of_their_polynomial(method, integrator, ratio):
    (level,) = levels_of_family("stiff-periods", Base.of_mechanism("four-bar"), quick=True)
    motion = reference_of_cell(level)
    assert motion["unusable"] is None and "cosine" in motion["how"]
    result = Model(level.mechanism).simulate(until=level.until, method=method, integrator=integrator, step=level.step)
    assert math.isclose(level.until, 100 * 2 * math.pi / 1e3)
    steps = result.t / level.step
    followed = 0.1 * np.real(np.exp(steps * np.log(ratio(1e3j * level.step))))
    whole = np.abs(steps - np.round(steps)) < 1e-6
    assert whole.sum() >= 2
    np.testing.assert_allclose(result["slider.x"][whole], followed[whole], atol=1e-8)
    times = np.linspace(0.0, level.until, level.outputs + 1)
    np.testing.assert_allclose(np.array(motion["q"])[:, 0], 0.1 * np.cos(1e3 * times), atol=1e-13)

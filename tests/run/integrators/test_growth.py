"""Steps after an estimate that passes through zero: an oscillator x'' = -2 x^3, whose motion is an elliptic cosine."""

import numpy as np
import pytest
from scipy.special import ellipj

from symgen import Settings, load
from symgen.describe.files.builder import MechanismBuilder
from symgen.run.layout import abi
from symgen.run.planning.prepare import prepare

UNTIL = 10.0


@pytest.fixture(scope="module")
def oscillator():
    """One coordinate moves, so all that an estimate sees passes through zero several times in a period."""
    builder = MechanismBuilder("oscillator", gravity=[0.0, 0.0])
    builder.body("block", mass=1.0, inertia=1.0, position=[1.0, 0.0])
    builder.joint("guide", "translational", between=["ground", "block"], at=[[0.0, 0.0], "centre"], axis=[1.0, 0.0])
    builder.force("spring", "force", body="block", force=["-2*block.x**3", 0.0])
    return load(builder.build())


@pytest.mark.parametrize("coordinates", ["absolute", "joint"])
def test_no_output_is_far_off(oscillator, coordinates):
    """Outputs at 1001 times, most inside steps.

    Steps aim at 0.75^8, a tenth of the tolerance, and a disturbance of this motion grows no faster than the time; so a
    quarter of a tolerance for each step leaves room for what a tenth and a growth of phases give.
    """
    times = np.linspace(0.0, UNTIL, 1001)
    sn, cn, dn, _ = ellipj(np.sqrt(2.0) * times, 0.5)
    for rtol in 10.0 ** -np.linspace(9.0, 11.0, 11):
        settings = {"rtol": rtol, "atol": rtol, "until": UNTIL, "times": times, "coordinates": coordinates}
        result = oscillator.simulate(method="lagrange", integrator="dop853", **settings)
        x, v = np.asarray(result.q)[:, 0], np.asarray(result.v)[:, 0]
        error = max(np.abs(x - cn).max(), np.abs(v + np.sqrt(2.0) * sn * dn).max())
        assert error < 0.25 * result.steps * rtol, f"rtol {rtol:.1e}: {error / rtol:.1f} tolerances"


def test_what_is_allowed_grows_slowly(oscillator):
    """The step that the tolerance allows grows by a quarter at most, once the run has found its step."""
    settings = Settings(method="lagrange", integrator="dop853", rtol=1e-10, atol=1e-10, until=UNTIL)
    simulation = prepare(oscillator.mechanism, settings).simulation()
    nothing, allowed = simulation.outputs(np.zeros(0)), []
    for k in range(1, 1000):
        code = simulation.enter(nothing, pause=k)
        clock = simulation.state.clock
        allowed.append((clock[abi.STEP], clock[abi.ALLOWED]))
        if code == abi.DONE:
            break
    step, factor = np.array(allowed).T
    settled = factor[:-1] < 4.0
    grown = (step * factor)[1:] / (step * factor)[:-1]
    assert settled.sum() > 50
    assert grown[settled].max() < 1.25 * (1.0 + 1e-12)
    assert (grown[settled] > 1.249).any(), "an estimate passed through zero"

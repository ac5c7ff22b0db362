"""Parts that bend in rows of sweeps and in analyses: judged as in single runs, with the same sentence."""

import numpy as np
import pytest
from numpy.testing import assert_allclose
from support.emitted import mechanism_of

import symgen

#: A cantilever of 0.4 m in two elements under a force across its end.
STRIP = {
    "mechanism": {"name": "strip"},
    "run": {"until": 0.6},
    "parameters": {"F": 1.0},
    "beams": {
        "b": {
            "start": [0.0, 0.0],
            "end": [0.4, 0.0],
            "elements": 2,
            "axial": 8e4,
            "bending": 0.3,
            "mass": 0.314,
            "rotary": 1e-4,
            "damping": 1e-2,
            "clamp": "ground",
        }
    },
    "forces": {"f": {"type": "force", "body": "b", "at": "end", "force": [0.0, "-F"]}},
    "outputs": {"y": "b.end.y"},
}


@pytest.fixture(scope="module")
def strip():
    return symgen.load(mechanism_of(STRIP))


@pytest.mark.slow
def test_rows_say_of_a_strip_what_its_runs_say(strip):
    """A beam bent by 1.9 rad was `unverified` alone and `ok` in a row; values at the end are the same as without."""
    forces = np.linspace(1.0, 12.0, 5)
    settings = {"integrator": "dop853"}
    rows = symgen.sweep(strip, vary={"F": forces}, quantities=["y"], jobs=1, **settings)
    kept = symgen.sweep(strip, vary={"F": forces}, quantities=["y"], times=(0.6,), jobs=1, **settings)
    statuses = set()
    for i, force in enumerate(forces):
        single = strip.simulate(parameters={"F": float(force)}, verify=False, **settings)
        assert (rows.status[i], rows.reason[i] or None) == (single.status, single.reason)
        assert_allclose(rows.values[i, 0], [single["y"][-1]], rtol=1e-7)
        assert_allclose(kept.values[i, 0], rows.values[i, 0], rtol=1e-7)
        statuses.add(single.status)
    assert statuses == {"ok", "unverified"}
    assert rows["y"].shape == (5, 1) and len(rows.ensemble.recipe.kept) == 1
    over = symgen.sweep(strip, vary={"F": forces[-1:]}, quantities=["min(y)"], jobs=1, **settings)
    assert over.status.tolist() == ["unverified"] and over.values[0, 0, 0] <= rows.values[-1, 0, 0]


def test_analyses_say_that_a_state_is_beyond_the_limits_of_its_parts(strip):
    """The equilibrium under 12 N was stable, without a word."""
    for force, said in ((0.1, 0), (12.0, 1)):
        for analysis in (strip.equilibrium, strip.modes, strip.linearise):
            notes = analysis(parameters={"F": force}).notes
            assert sum("beyond the limits of its parts: beam element b.e" in note for note in notes) == said, notes

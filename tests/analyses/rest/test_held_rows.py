"""States that friction holds at rest, in analyses at the start: as in a run, which stays there for ever."""

import math

import numpy as np
import pytest
from numpy.testing import assert_allclose

import symgen
from symgen.base.errors import InputError

STIFFNESS, INERTIA = 40.0, 0.2


def worm(efficiency, load=2.0):
    """A wheel under a load on a worm, with a disc on a spring on the wheel, which swings if the wheel stands."""
    builder = symgen.MechanismBuilder("worm").parameter("load", load, unit="N m")
    for i, (name, inertia) in enumerate((("m", 0.3), ("w", 0.5), ("disc", INERTIA))):
        builder.body(name, mass=1.0, inertia=inertia, position=(0.3 * min(i, 1), 0.0))
        builder.joint(f"axle_{name}", "revolute", between=("ground", name), at=((0.3 * min(i, 1), 0.0), "centre"))
    builder.joint("mesh", "gear", between=("m", "w"), radii=(0.1, 0.2), efficiency=efficiency)
    builder.force("weight", "torque", body="w", torque="load")
    builder.force("spring", "torsional-spring-damper", between=("w", "disc"), stiffness=STIFFNESS)
    return symgen.load(builder.build())


@pytest.mark.slow
@pytest.mark.parametrize("coordinates", ["absolute", "joint"])
def test_a_self_locking_worm_is_at_rest_in_analyses_as_in_a_run(coordinates):
    """'m.omega' changed at a rate of 9.6 there, as losses were left out; the run stays at rest."""
    model = worm([0.4, -0.5])
    run = model.simulate(until=0.5, coordinates=coordinates)
    assert run.status == "ok" and np.abs(run["w.theta"]).max() < 1e-12
    for analysis in (model.linearise, model.modes):
        found = analysis(at="start", coordinates=coordinates)
        values = found.eigenvalues() if callable(found.eigenvalues) else found.eigenvalues
        assert_allclose(sorted(values.imag), np.array([-1.0, 1.0]) * math.sqrt(STIFFNESS / INERTIA), rtol=1e-9)
        assert any("at rest, held as rows: mesh" in note for note in found.notes), found.notes


def test_a_worm_that_gives_way_is_not_at_rest():
    """With an efficiency of 0.6 backwards the load drives."""
    model = worm([0.8, 0.6])
    assert np.abs(model.simulate(until=0.1)["w.theta"]).max() > 1e-3
    with pytest.raises(InputError, match="expected a state of rest"):
        model.linearise(at="start")


def test_friction_of_a_joint_holds_a_pendulum_up_to_its_bound():
    """m g l cos(angle) = 1 * 9.81 * 0.5 * cos(0.3) = 4.686 N m: held by 4.7, and not by 4.6."""
    for bound, rests in ((4.7, True), (4.6, False)):
        builder = symgen.MechanismBuilder("rod", gravity=(0.0, -9.81))
        builder.body("rod", mass=1.0, inertia=0.1, position=(0.5 * math.cos(0.3), 0.5 * math.sin(0.3)), angle=0.3)
        friction = {"sliding": 0.9 * bound, "static": bound}
        builder.joint("pin", "revolute", between=("ground", "rod"), at=((0.0, 0.0), (-0.5, 0.0)), friction=friction)
        model = symgen.load(builder.build())
        assert bool(np.abs(model.simulate(until=0.2)["rod.omega"]).max() < 1e-9) == rests
        if rests:
            assert model.modes(at="start").degrees_of_freedom == 0
        else:
            with pytest.raises(InputError, match="expected a state of rest"):
                model.modes(at="start")

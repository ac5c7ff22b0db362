"""A bead on a whip and a hook on an elevator's rope: their energy, and the answer of meshes that get finer."""

import itertools

import numpy as np
import pytest
from support.emitted import mechanism_of

import symgen

TIGHT = {"integrator": "dop853", "rtol": 1e-10, "atol": 1e-11, "verify": False}


def whip(elements: int) -> symgen.Model:
    """Return a beam that swings from a pin and throws a bead outwards."""
    rod = {"start": [0.0, 0.0], "end": [1.0, 0.0], "elements": elements, "axial": 2e3, "bending": 0.5}
    return symgen.Model(
        mechanism_of(
            {
                "mechanism": {"name": "whip", "gravity": [0.0, -9.81]},
                "beams": {"rod": rod | {"mass": 0.4, "rotary": 2e-4}},
                "bodies": {"bead": {"type": "point", "mass": 0.1, "position": [0.3, 0.0]}},
                "joints": {
                    "pin": {"type": "revolute", "between": ["ground", "rod"], "at": [[0.0, 0.0], "start"]},
                    "on": {"type": "slides-on", "body": "bead", "beam": "rod"},
                },
            }
        )
    )


def elevator(elements: int) -> symgen.Model:
    """Return a hook that a rope pulls up along a taut cable which a mass at its end holds."""
    cable = {"start": [0.0, 0.0], "end": [0.0, -4.0], "elements": elements, "cable": True, "axial": 4e3, "mass": 0.3}
    return symgen.Model(
        mechanism_of(
            {
                "mechanism": {"name": "elevator", "gravity": [0.0, -9.81]},
                "beams": {"guide": cable | {"clamp": ["ground", "weight"]}},
                "bodies": {
                    "weight": {"mass": 20.0, "inertia": 0.2, "position": [0.0, -4.0]},
                    "hook": {"mass": 2.0, "inertia": 0.05, "position": [0.0, -3.2], "points": {"eye": [0.0, 0.1]}},
                },
                "joints": {"on": {"type": "slides-on", "body": "hook", "at": "eye", "beam": "guide"}},
                "forces": {"pull": {"type": "force", "body": "hook", "force": [0.0, "2*(9.81 + 1.5)"]}},
            }
        )
    )


@pytest.mark.slow
def test_a_bead_on_a_whip_keeps_its_energy_and_meshes_agree() -> None:
    ends = []
    for elements in (4, 8, 16):
        run = whip(elements).simulate(until=0.35, **TIGHT)
        assert run.ok, run.status
        assert np.ptp(run.kinetic + run.potential) < 1e-7
        assert [e.name for e in run.events if e.name.startswith("on.passes")]
        ends.append(np.array([run["bead.x"][-1], run["bead.y"][-1]]))
    first, second = (np.linalg.norm(a - b) for a, b in itertools.pairwise(ends))
    assert second < 0.6 * first and second < 5e-3


@pytest.mark.slow
def test_a_hook_is_pulled_up_a_taut_cable_as_on_a_rail() -> None:
    run = elevator(8).simulate(until=1.0, **TIGHT)
    assert run.ok, run.status
    np.testing.assert_allclose(run["hook.y"], -3.2 + 0.75 * run.t**2, atol=1e-8)
    np.testing.assert_allclose(run["on.F"], 0.0, atol=1e-6)

"""Integrals that run along take nothing from the room of a scheme: the motion is the same with and without them."""

import copy

import numpy as np
import pytest
from support.emitted import mechanism_of

import symgen
from symgen.describe.catalogue import raw
from symgen.run.integrators import INTEGRATORS

STEP, STEPS, COUNT = 1e-3, 20, 12


def pendulum(count):
    description = copy.deepcopy(raw("pendulum"))
    description["outputs"] = {f"i{k}": {"value": f"integral(cos({k + 1}*t))"} for k in range(count)}
    return symgen.load(mechanism_of(description))


def check(integrator, coordinates):
    method = {
        "generalized-alpha": "generalized-alpha",
        "hht": "generalized-alpha",
        "trapezoidal": "index3-augmented-lagrangian",
    }
    method |= {"half-explicit": "half-explicit", "phem56": "half-explicit", "rattle": "rattle"}
    method |= {"discrete-gradient": "discrete-gradient", "gauss": "symmetric-projection"}
    constant = {"options": {"integrator.adaptive": "false"}} if INTEGRATORS.get(integrator).adaptive else {}
    settings = {"method": method.get(integrator, "lagrange"), "integrator": integrator, "coordinates": coordinates}
    settings |= {"step": STEP, "until": STEP * STEPS, "max_energy_error": 1e9, "max_violation": 1.0, **constant}
    plain, more = (pendulum(count).simulate(**settings) for count in (0, COUNT))
    assert plain.ok and more.ok
    for table in ("q", "v"):
        # more auxiliary states change no operation on the others, but may change how sums over vectors are ordered
        a, b = (getattr(result, table).values for result in (plain, more))
        np.testing.assert_allclose(b, a, rtol=0.0, atol=1e-13 * np.abs(a).max())
    for k in range(COUNT):  # by a rule of the scheme's order on steps of 1e-3: the first order of Euler's at least
        found = more.outputs[f"i{k}"] if hasattr(more, "outputs") else more[f"i{k}"]
        np.testing.assert_allclose(found, np.sin((k + 1) * more.t) / (k + 1), rtol=0.0, atol=STEP * (k + 1) * more.end)


def test_the_rates_of_many_integrals_leave_newmarks_accelerations_alone():
    """Two unknowns in joint coordinates: the rates of twelve integrals are many times as many."""
    check("newmark", "joint")


@pytest.mark.by_turns(4)
@pytest.mark.slow
@pytest.mark.parametrize("integrator", [name for name in INTEGRATORS.names if name != "newmark"])
def test_no_scheme_needs_the_room_of_integrals_for_the_motion(integrator):
    check(integrator, "absolute" if integrator in ("generalized-alpha", "hht", "trapezoidal") else "joint")

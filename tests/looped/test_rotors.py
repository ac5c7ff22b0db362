"""Rotors on joints in loops: Lagrange's equations of a chain in NumPy, both shapes of all methods, impacts, a sweep."""

import copy
from dataclasses import replace

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from support.rotation import of_turn

import symgen
from symgen.base.settings import Settings
from symgen.derive.lower.looped.layout import HEAD, ROTORS
from symgen.describe import MechanismBuilder
from symgen.describe.files.load import read_raw
from symgen.describe.files.validate import validate
from symgen.run.planning.prepare import prepare
from tests.looped.test_modes import INERTIA, LINK, MASS, G

ROTOR, RATIO = 2e-6, 20.0
TIGHT = {"rtol": 1e-10, "atol": 1e-10}


def geared_chain(count, rate, last=()):
    """Links in a horizontal line, each driven by a rotor on its joint; the last one may be joined to the ground."""
    builder, before = MechanismBuilder(f"geared-chain-{count}", gravity=[0.0, -G]), "ground"
    for i in range(count):
        builder.body(f"link{i}", mass=MASS, inertia=INERTIA, position=[LINK * (0.5 + i), 0.0])
        pin = {"between": [before, f"link{i}"], "at": [[0.5 * LINK if i else 0.0, 0.0], [-0.5 * LINK, 0.0]]}
        pin |= {"start": {"rate": rate * (-1.0) ** i}} if rate else {}
        builder.joint(f"pin{i}", "revolute", **pin, rotor_inertia=ROTOR * (1 + i % 3), gear_ratio=RATIO)
        before = f"link{i}"
    if last:
        builder.joint("last", "revolute", between=[before, "ground"], at=[[0.5 * LINK, 0.0], list(last)])
    return symgen.load(builder.build())


def swung(count, rate, until):
    """Angles of the links by Lagrange's equations in these angles, to which rotors add constants."""
    places = LINK * np.tri(count, k=-1) + 0.5 * LINK * np.eye(count)  # how far each centre goes by each angle
    lever, pull = MASS * places.T @ places, MASS * G * places.sum(axis=0)
    apart = np.eye(count) - np.eye(count, k=-1)  # angles of the joints by those of the links
    heavy = INERTIA * np.eye(count) + apart.T @ np.diag(ROTOR * (1 + np.arange(count) % 3) * RATIO**2) @ apart

    def rates(t, y):
        angles, speeds = y[:count], y[count:]
        turned = angles[:, None] - angles
        torque = -pull * np.cos(angles) - (lever * np.sin(turned)) @ speeds**2
        return np.concatenate([speeds, np.linalg.solve(lever * np.cos(turned) + heavy, torque)])

    y = np.concatenate([np.zeros(count), np.cumsum(rate * (-1.0) ** np.arange(count))])
    return solve_ivp(rates, (0.0, until), y, method="DOP853", rtol=1e-12, atol=1e-12).y[:count, -1]


@pytest.mark.slow
@pytest.mark.parametrize(
    ("count", "until"), [(3, 0.4), pytest.param(100, 0.02, marks=pytest.mark.slow)], ids=["3", "100"]
)
def test_a_chain_whose_links_have_rotors_moves_as_lagrange_says(count, until):
    run = geared_chain(count, 2.0).simulate(
        until=until, method="lagrange", integrator="dop853", shape="looped", rtol=1e-11, atol=1e-11
    )
    assert (run.status, run.shape) == ("ok", "looped")
    np.testing.assert_allclose(run.q.values[-1][2::3], swung(count, 2.0, until), rtol=0.0, atol=1e-9)


def test_the_cost_of_rotors_is_that_of_rows():
    """Tables grow with the chain, and no matrix of all bodies is formed."""
    sizes = [geared_chain(n, 0.0).compile("lagrange", {}, "looped") for n in (10, 20, 40)]
    numbers = [compiled.law.nw for compiled in sizes]
    assert numbers[2] - numbers[1] <= 2.2 * (numbers[1] - numbers[0])
    assert not set(ROTORS) & set(HEAD)


METHODS = (
    *(("lagrange", "dop853", TIGHT), ("direct-correction", "picard", TIGHT), ("ggl", "radau5", {"rtol": 1e-8})),
    *(("mass-orthogonal-projection", "dop853", TIGHT), ("lagrange", "sdirk", {"rtol": 1e-7})),
    *(("generalized-alpha", "generalized-alpha", {"step": 1e-3}), ("rattle", "rattle", {"step": 1e-3})),
    *(("discrete-gradient", "discrete-gradient", {"step": 1e-3}), ("symmetric-projection", "gauss", {"step": 1e-3})),
    *(("index3-augmented-lagrangian", "trapezoidal", {"step": 1e-3}), ("half-explicit", "phem56", {"rtol": 1e-8})),
    *(
        (method, "rk4", {"step": 1e-3})
        for method in (
            *("adaptive-baumgarte", "baumgarte", "augmented-lagrangian", "compliant-constraints", "energy-projection"),
            *("index1-augmented-lagrangian", "post-stabilization", "udwadia-kalaba", "velocity-projection"),
            "controllable-velocity-projection",
        )
    ),
)


@pytest.mark.by_turns(8)
@pytest.mark.slow
@pytest.mark.parametrize("last", [(), (0.22, 0.05)], ids=["chain", "loop"])
@pytest.mark.parametrize(
    ("method", "integrator", "steps"), [pytest.param(*case, id=f"{case[0]}-{case[1]}") for case in METHODS]
)
def test_both_shapes_agree_with_rotors(method, integrator, steps, last):
    model, settings = geared_chain(3, 0.0, last), {"coordinates": "absolute", "until": 0.2, "verify": False, **steps}
    straight, looped = (
        model.simulate(method=method, integrator=integrator, shape=shape, **settings)
        for shape in ("straight", "looped")
    )
    assert (straight.steps, straight.status, straight.shape) == (looped.steps, looped.status, "straight")
    assert looped.shape == "looped"
    for table in ("q", "v", "a"):
        values = getattr(straight, table).values
        scale = max(1.0, float(np.abs(values).max()))
        np.testing.assert_allclose(getattr(looped, table).values, values, rtol=0.0, atol=1e-9 * scale)
    np.testing.assert_allclose(looped.kinetic, straight.kinetic, rtol=0.0, atol=1e-11)


@pytest.mark.slow
def test_impacts_of_links_with_rotors_are_those_of_straight_code():
    """A stop and friction: the impulses of both shapes are those of the same M."""
    raw, source = read_raw("four-bar")
    raw = copy.deepcopy(raw)
    raw["joints"]["A"] |= {"rotor_inertia": 1e-3, "gear_ratio": 12.0, "friction": {"sliding": 0.2}}
    raw["joints"]["B"] |= {"rotor_inertia": 2e-4, "gear_ratio": 8.0}
    raw["joints"]["D"] |= {"stop": {"lower": 1.88, "upper": 2.5, "restitution": 0.5}}
    model = symgen.load(validate(raw, source))
    settings = {"method": "lagrange", "integrator": "dop853", "coordinates": "absolute", "until": 2.0, **TIGHT}
    straight, looped = (model.simulate(shape=shape, **settings) for shape in ("straight", "looped"))
    assert len(straight.events) > 4 and [e.name for e in straight.events] == [e.name for e in looped.events]
    np.testing.assert_allclose(looped.q.values, straight.q.values, rtol=0.0, atol=1e-8)


@pytest.mark.slow
def test_a_four_bar_with_a_geared_motor_over_300_ratios():
    raw, source = read_raw("four-bar")
    raw = copy.deepcopy(raw)
    raw["parameters"] |= {"ratio": 1.0}
    raw["joints"]["A"] |= {"rotor_inertia": 0.02, "gear_ratio": "ratio"}
    raw["joints"]["C"] |= {"rotor_inertia": 0.01, "gear_ratio": "0.5*ratio"}
    mechanism = validate(raw, source)
    ends = {}
    for shape in ("straight", "looped"):
        settings = Settings("lagrange", "rk4", until=0.2, step=1e-3, shape=shape, coordinates="absolute", verify=False)
        ends[shape] = [
            prepare(mechanism, replace(settings, parameters={"ratio": ratio})).integrate().states[-1]
            for ratio in of_turn(np.linspace(0.5, 60.0, 300), 4)
        ]
    np.testing.assert_allclose(ends["looped"], ends["straight"], rtol=0.0, atol=1e-10)
    assert np.ptp(ends["straight"], axis=0).max() > 1e-2

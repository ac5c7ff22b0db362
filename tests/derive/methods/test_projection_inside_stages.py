"""`when = stage` of `direct-correction`: every evaluation is at the nearest state that satisfies the constraints."""

import tomllib
from pathlib import Path

import numpy as np
import pytest

import symgen
from benchmarks.plain.start import projected
from benchmarks.plain.system import read
from symgen import InputError, load

CATALOGUE = Path(symgen.__file__).parent / "describe" / "catalogue"
UNWATCHED = {"max_violation": 1e9, "max_energy_error": 1e9, "verify": False}
NODES, WEIGHTS = (0.0, 0.5, 0.5, 1.0), (1 / 6, 1 / 3, 1 / 3, 1 / 6)


def plain_run(name, step, steps):
    """Return the last positions of the classical scheme with projected stages, on the plain derivation."""
    system = read(tomllib.loads((CATALOGUE / f"{name}.toml").read_text(encoding="utf-8")))
    start = load(name).simulate(until=1e-3, times=[0.0])
    q, v = np.array(start.q.values[0]), np.array(start.v.values[0])
    rank = start.rank.rank

    def nearest(q, v):
        for _ in range(3):
            q, v = projected(system, 0.0, q, v, rank)
        return q, v

    def rate(q, v):
        q, v = nearest(q, v)
        state = system.at(0.0, q, v)
        force, _, _ = system.loads(state)
        return system.rates_of(q, v), system.accelerations(system.constraints(state), force, rank)[0]

    for _ in range(steps):
        stages = [rate(q, v)]
        for node in NODES[1:]:
            dq, dv = stages[-1]
            stages.append(rate(q + node * step * dq, v + node * step * dv))
        for weight, (dq, dv) in zip(WEIGHTS, stages, strict=True):
            q, v = q + weight * step * dq, v + weight * step * dv
        q, v = nearest(q, v)
    return q


def run(name, **keys):
    options = {"method.when": keys.pop("when", "stage")}
    return load(name).simulate(method="direct-correction", options=options, **UNWATCHED, **keys)


@pytest.mark.slow
@pytest.mark.parametrize("shape", ["straight", "looped"])
def test_it_is_the_scheme_with_projected_stages(shape):
    own = plain_run("four-bar", 0.02, 10)
    keys = {"integrator": "rk4", "step": 0.02, "until": 0.2, "shape": shape}
    inside, behind = (np.array(run("four-bar", when=when, **keys).q.values[-1]) for when in ("stage", "step"))
    assert np.abs(inside - own).max() < 1e-12
    assert np.abs(behind - own).max() > 1e-10


@pytest.mark.slow_cases("bricard-2.0-0.02")
@pytest.mark.parametrize(("name", "until", "step"), [("four-bar", 2.0, 4e-3), ("bricard", 2.0, 2e-2)])
def test_the_scheme_keeps_its_order(name, until, step):
    exact = run(name, integrator="dop853", rtol=1e-12, atol=1e-13, until=until, when="step").q.values[-1]
    errors = [
        np.abs(np.subtract(run(name, integrator="rk4", step=step / 2**k, until=until).q.values[-1], exact)).max()
        for k in range(3)
    ]
    orders = np.log2(np.divide(errors[:-1], errors[1:]))
    assert (orders > 3.8).all() and (orders < 4.7).all(), orders


@pytest.mark.slow
def test_states_of_trees_are_closed_too():
    keys = {"coordinates": "joint", "until": 1.0, "integrator": "dop853", "rtol": 1e-9, "atol": 1e-11}
    inside, behind = (np.array(run("four-bar", when=when, **keys).q.values[-1]) for when in ("stage", "step"))
    assert 0.0 < np.abs(inside - behind).max() < 1e-6


def test_implicit_integrators_are_refused():
    with pytest.raises(InputError, match="when: expected step with an implicit integrator"):
        run("four-bar", integrator="radau5", until=0.1)

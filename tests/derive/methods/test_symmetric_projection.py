"""Symmetric projection: steps by NumPy, order 4, both constraints to rounding, the way back, energy over long runs."""

import tomllib
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from support.convergence import MOTIONS, compared, orders, redundant

import symgen
from benchmarks.plain.start import levers
from benchmarks.plain.system import read
from symgen.api import load
from symgen.base.settings import Settings
from symgen.run.planning.prepare import prepare
from symgen.run.single.run import integrate

METHOD = "symmetric-projection"
CATALOGUE = Path(symgen.__file__).parent / "describe" / "catalogue"
AWAY = np.sqrt(3.0) / 6.0
NODES, A = (0.5 - AWAY, 0.5 + AWAY), np.array([[0.25, 0.25 - AWAY], [0.25 + AWAY, 0.25]])


def textbook_states(name, h, steps, share):
    """Return q and v after each step of the formulas on the plain derivation: D^+ and the law from dense algebra."""
    system = read(tomllib.loads((CATALOGUE / f"{name}.toml").read_text(encoding="utf-8")))
    start = load(name).simulate(until=h, times=[0.0])
    n, rank = system.nq, start.rank.rank
    y = np.concatenate([np.asarray(start.q)[0], np.asarray(start.v)[0]])
    metric = np.diag(levers(system, 0.0, y[:n])[0] ** 2)

    def rows(t, y):
        c = system.constraints(system.at(t, y[:n], y[n:]))
        inverse = metric @ c.d.T @ np.linalg.pinv(c.d @ metric @ c.d.T, rcond=1e-10)
        return np.array([c.phi, c.d @ y[n:] - c.nu]), inverse

    def rate(t, y):
        state = system.at(t, y[:n], y[n:])
        return np.concatenate([y[n:], system.accelerations(system.constraints(state), system.loads(state)[0], rank)[0]])

    states = [y]
    for i in range(steps):
        t, first = i * h, y
        k, left = [rate(t, y)] * 2, np.zeros((2, len(rows(t, y)[0][0])))
        inverse, last = rows(t, first)[1], y
        for _ in range(30):
            begun = first + share * (left @ inverse.T).ravel()
            k = [rate(t + c * h, begun + h * (a[0] * k[0] + a[1] * k[1])) for c, a in zip(NODES, A, strict=True)]
            y = begun + 0.5 * h * (k[0] + k[1])
            y = y + (left @ rows(t + h, last)[1].T).ravel()
            last = y
            left = left - rows(t + h, y)[0] / (1.0 + share)
        states.append(y)
    return np.array(states)


@pytest.mark.by_turns(3)
@pytest.mark.slow
@pytest.mark.parametrize("share", [1.0, 0.0])
@pytest.mark.parametrize("name", ["four-bar", "driven-four-bar", "slider-crank"])
def test_steps_are_those_of_the_formulas(name, share):
    h, steps = 1e-2, 4
    own = textbook_states(name, h, steps, share)
    keys = {"step": h, "until": steps * h, "output_step": h, "options": {"method.share": share}, "verify": False}
    result = load(name).simulate(method=METHOD, max_violation=1.0, max_energy_error=1e9, **keys)
    states = np.hstack([np.asarray(result.q), np.asarray(result.v)])
    assert result.steps == steps
    np.testing.assert_allclose(states, own, rtol=0.0, atol=1e-12 * np.abs(own).max())


@pytest.mark.slow_cases("spatial-slider-crank-0.5-keys2")
@pytest.mark.parametrize(("name", "until", "keys"), [*MOTIONS, ("four-bar", 2.0, {"options": {"method.share": 0.0}})])
def test_order_four_with_both_constraints_to_rounding(name, until, keys):
    steps = (1.6e-2, 8e-3, 4e-3) if name == "rolling-disc" else (4e-3, 2e-3, 1e-3)
    results, errors = compared(load(name), until, steps, method=METHOD, **keys)
    assert max(max(r.position_violation_max, r.velocity_violation_max) for r in results) < 1e-13
    np.testing.assert_allclose(orders(errors), 4.0, atol=0.2)
    ends = [np.asarray(r.v)[-1] for r in results]
    np.testing.assert_allclose(orders([np.abs(v - ends[-1]).max() for v in ends[:2]]), np.log2(17.0), atol=0.3)


@pytest.mark.parametrize(("name", "step"), [("four-bar", 2e-2), ("spatial-slider-crank", 2e-3), ("rolling-disc", 2e-2)])
def test_the_way_back_ends_at_the_start_where_the_projection_is_symmetric(name, step):
    """Velocities turned round after 100 steps, and 100 more; a projection after the step alone does not do it."""
    missed = {}
    for share in (1.0, 0.0):
        settings = Settings(method=METHOD, step=step, until=100 * step, options={"method.share": share})
        run = prepare(load(name).mechanism, settings)
        nq, first = run.compiled.info.nq, run.compiled.info.nq + run.compiled.info.nv

        def end(y, run=run, first=first):
            outcome = integrate(run.compiled, run.plan.integrator, replace(run.start, y=y), run.spec)
            return np.array(outcome.states[-1][:first])

        start = np.array(run.start.y)
        there = np.array(start)
        there[:first] = end(start)
        assert np.abs(there - start).max() > 1e-3
        there[nq:first] *= -1.0
        there[first:] = 0.0
        back = end(there)
        back[nq:] *= -1.0
        missed[share] = np.abs(back - start[:first]).max()
    assert missed[1.0] < 1e-11 and missed[0.0] > 1e3 * missed[1.0]


def energies(share, swings, step):
    """Largest energy errors of the pendulum in the first tenth of a run and in all of it."""
    keys = {"until": 2.0 * swings, "output_step": 0.1, "max_energy_error": 1e9, "options": {"method.share": share}}
    result = load("pendulum").simulate(method=METHOD, step=step, **keys)
    assert result.status == "ok", result.reason
    error = np.abs(np.asarray(result.energy)[:, result.energy.names.index("error")])
    return error[: len(error) // 10].max(), error.max()


def test_the_error_of_energy_is_bounded_over_500_swings():
    """A projection after the step loses it, with the same scheme."""
    (first, last), (once, often) = energies(1.0, 500, 2e-2), energies(0.0, 500, 2e-2)
    assert last < 1.05 * first and often > 8.0 * once


@pytest.mark.by_turns(3)
@pytest.mark.slow
def test_the_error_of_energy_is_bounded_over_ten_thousand_swings():
    (first, last), (once, often) = energies(1.0, 10_000, 2e-2), energies(0.0, 10_000, 2e-2)
    assert last < 1.05 * first and often > 9.0 * once > 9.0 * last


def test_redundant_rows_are_left_out():
    result, error = redundant(METHOD)
    assert error < 1e-9 and max(result.position_violation_max, result.velocity_violation_max) < 1e-13

"""Violations decay with the rate kappa, exactly on curved constraints as well."""

import numpy as np
import pytest
from support.checks import close
from support.laws_at import LawAt, described

from symgen.api import load
from symgen.base.ir.program import STATUS

KAPPA = 10.0


def seeded(one):
    """A start 8 mm off the four-bar's constraints, at rest."""
    off = np.random.default_rng(2).standard_normal(one.nq)
    return one.q + 8e-3 * off / np.linalg.norm(one.equations(one.q, one.v).d @ off), np.zeros(one.nv)


def test_a_seeded_violation_decays_exponentially_on_curved_constraints():
    one, remainders = LawAt(described("four-bar"), "invariant-stabilization"), []
    q, v = seeded(one)
    before = one.equations(q, v).phi
    assert np.linalg.norm(before) == pytest.approx(8e-3, rel=1e-2)
    for h in (4e-3, 2e-3):
        after = one.equations(*one.moved(q, v, h, round(0.4 / h))).phi
        remainders.append(np.linalg.norm(after - np.exp(-KAPPA * 0.4) * before))
    assert remainders[0] < 1e-6 * np.linalg.norm(before)
    assert remainders[0] / remainders[1] > 2.0**3.7  # nothing but the integrator's error of order 4


@pytest.mark.parametrize("name", ["four-bar", "driven-four-bar"])
def test_the_law_is_the_formula(name):
    one = LawAt(described(name), "invariant-stabilization")
    rng = np.random.default_rng(5)
    q, v = one.q + 0.1 * rng.standard_normal(one.nq), rng.standard_normal(one.nv)
    e, (rates, accelerations, _) = one.equations(q, v), one.rates(q, v)
    inverse = np.linalg.solve(e.mass, e.d.T) @ np.linalg.inv(e.schur())
    close(rates, v - inverse @ (e.drift + KAPPA * e.phi), "q'", 1e-11)
    free = np.linalg.solve(e.mass, e.f)
    close(accelerations, free + inverse @ (e.gamma - KAPPA * e.drift - e.d @ free), "v'", 1e-11)


def test_braun_goldfarb_is_the_same_at_one_over_the_step():
    h, rng = 2e-3, np.random.default_rng(6)
    one = LawAt(described("four-bar"), "invariant-stabilization", {}, {"kappa": 1.0 / h})
    other = LawAt(described("four-bar"), "braun-goldfarb")
    for law in (one, other):
        law.w[STATUS.index("step")] = h
    for _ in range(3):
        q, v = one.q + 0.1 * rng.standard_normal(one.nq), rng.standard_normal(one.nv)
        for value, expected, what in zip(one.rates(q, v), other.rates(q, v), ("q'", "v'", "lambda"), strict=True):
            close(value, expected, what, 1e-12)


def test_loops_refuse_it_in_a_sentence(cli):
    code, _, said = cli("run", "four-bar", "--method", "invariant-stabilization", "--shape", "looped")
    assert code == 2 and "which needs rates of positions at other velocities" in said


@pytest.mark.slow
def test_in_space_and_in_joint_coordinates():
    times = np.linspace(0.0, 0.5, 6)
    for name, coordinates in (("heavy-top", "absolute"), ("four-bar", "joint")):
        keys = {"integrator": "dop853", "until": 0.5, "times": times, "coordinates": coordinates}
        result, usual = (
            load(name).simulate(method=m, **keys) for m in ("invariant-stabilization", "direct-correction")
        )
        assert result.status == "ok", result.reason
        np.testing.assert_allclose(np.asarray(result.q), np.asarray(usual.q), rtol=0.0, atol=1e-6)

"""Positions are pulled back to their constraints in the form of momenta."""

import numpy as np
import pytest
from support.laws_at import LawAt, described, on_rails

from symgen.derive.lower.record import record_law
from symgen.derive.methods import METHODS
from symgen.derive.methods._tape import needed_operations

ALPHA = 5.0


def grown(z):
    """The stability function of the classical scheme."""
    return 1.0 + z + z**2 / 2 + z**3 / 6 + z**4 / 24


def test_a_seeded_violation_decays_exponentially_where_constraints_are_linear():
    one, h, steps = LawAt(on_rails(), "hamiltonian-baumgarte"), 0.02, 40
    assert one.nq == one.nv == 3
    q, v = one.moved([0.01, 0.3, -0.02], [0.0, 0.7, 0.0], h, steps, correct=True)
    left = grown(-ALPHA * h) ** steps
    assert abs(left - np.exp(-ALPHA * h * steps)) < 1e-5
    np.testing.assert_allclose(q, [0.01 * left, 0.3 + 0.7 * h * steps, -0.02 * left], rtol=0.0, atol=1e-14)
    np.testing.assert_allclose(v, [0.0, 0.7, 0.0], rtol=0.0, atol=1e-14)


@pytest.mark.slow
def test_on_curved_constraints_it_pulls_where_the_method_without_gain_does_not():
    off = np.random.default_rng(2).standard_normal(9)
    left = {}
    for method in ("hamiltonian-baumgarte", "augmented-hamiltonian"):
        one = LawAt(described("four-bar"), method)
        q = one.q + 8e-3 * off / np.linalg.norm(one.equations(one.q, one.v).d @ off)
        before = one.equations(q, one.v).phi
        after = one.equations(*one.moved(q, np.zeros(9), 2e-3, 200, correct=True)).phi
        left[method] = np.linalg.norm(after - np.exp(-ALPHA * 0.4) * before) / np.linalg.norm(before)
    assert left["hamiltonian-baumgarte"] < 1e-7 and left["augmented-hamiltonian"] > 0.5


def test_second_derivatives_of_constraints_enter_reported_multipliers_only():
    record = record_law(METHODS.get("hamiltonian-baumgarte"), {})
    parts = {part.name: part for part in record.parts}

    def reads_gamma(name, *places):
        ends = [index for place, index in parts[name].outputs if not places or place in places]
        reached = needed_operations(ends, lambda i: record.operations[i].operands)
        return any(record.operations[i].payload == ("gamma",) for i in reached)

    assert not any(reads_gamma(name) for name in ("begin", "iterate"))
    assert not reads_gamma("finish", "rates.q", "rates.v") and reads_gamma("finish", "rates.work")

"""Collocation with all nodes of a step at once, beside motions in extended precision and closed forms."""

import math

import numpy as np
import pytest

import symgen
from benchmarks.extended import motion
from symgen import MechanismBuilder, Settings
from symgen.run.integrators.picard import coefficients, legendre_integrals, lobatto, rates_of
from symgen.run.planning.prepare import prepare

CONSTANT = {"options": {"integrator.adaptive": "false"}}
ENDLESS = {"max_violation": 1.0, "max_energy_error": 1e9}


def ended(mechanism, until, **settings):
    """Return the outcome of a run whose only outputs are its start and its end, and q there."""
    run = prepare(mechanism, Settings(**{"until": until, "times": [0.0, until], "integrator": "picard", **settings}))
    outcome = run.integrate()
    return outcome, outcome.simulation.state.y[: outcome.compiled.info.nq].copy()


def on_a_spring(force: str):
    """Return a mass of 1 kg that a force along y acts on, from 0.5 m on."""
    builder = MechanismBuilder("mass", gravity=(0.0, -9.81))
    builder.body("ball", mass=1.0, inertia=0.1, position=(0.0, 0.5))
    return builder.force("spring", "force", body="ball", at=(0.0, 0.0), force=(0.0, force)).build()


@pytest.fixture(scope="module")
def four_bar():
    """Return the four-bar in joint coordinates, and its place after 1 s in extended precision."""
    mechanism = symgen.load("four-bar").mechanism
    run = prepare(mechanism, Settings(method="lagrange", integrator="dop853", coordinates="joint", until=1.0))
    return mechanism, motion(run, 80)


def test_points_and_weights_are_those_of_lobatto():
    points, weights = lobatto(8)
    assert points[[0, 4, 8]].tolist() == [-1.0, 0.0, 1.0]
    for power in range(16):  # exact up to degree 15
        assert weights @ points**power == pytest.approx((1 - (-1) ** (power + 1)) / (power + 1), abs=2e-15)


def test_coefficients_are_real_where_eigenvalues_are_always_complex(monkeypatch):
    """NumPy 2.5 and newer return complex eigenvalues of every matrix, older ones real ones where all are."""
    own, eigenvalues = lobatto(8), np.linalg.eigvals
    monkeypatch.setattr(np.linalg, "eigvals", lambda matrix: eigenvalues(matrix).astype(complex))
    for mine, theirs in zip(own, lobatto(8), strict=True):
        assert theirs.dtype == np.float64
        assert np.array_equal(mine, theirs)


def test_coefficients_integrate_polynomials():
    c, rng = coefficients(), np.random.default_rng(2)
    polynomial = np.polynomial.Polynomial(rng.standard_normal(9))
    points = 0.5 * (1.0 + lobatto(8)[0])
    values, once, twice = polynomial(points), polynomial.integ(), polynomial.integ(2)
    for table in (c.table, c.middle):
        first, second, places = table[:72].reshape(9, 8), table[72:144].reshape(9, 8), table[144:]
        np.testing.assert_allclose(values @ first, once(places) - once(0.0), atol=1e-14)
        np.testing.assert_allclose(values @ second, twice(places) - twice(0.0) - places * once(0.0), atol=1e-14)
    terms = np.polynomial.legendre.legval(2.0 * 0.3 - 1.0, values @ c.legendre.reshape(9, 16)[:, :9])
    assert terms == pytest.approx(polynomial(0.3), abs=1e-13)
    x = np.array([2.0 * 0.3 - 1.0])
    legendre = [np.polynomial.Legendre.basis(k, domain=[0, 1]) for k in range(9)]
    np.testing.assert_allclose(
        legendre_integrals(9, x)[0][:, 0], [p.integ(1, lbnd=0)(0.3) for p in legendre], atol=1e-15
    )
    np.testing.assert_allclose(
        legendre_integrals(9, x)[1][:, 0], [p.integ(2, lbnd=0)(0.3) for p in legendre], atol=1e-15
    )


def test_unknown_rates_leave_out_coordinates_whose_rate_is_a_velocity():
    for name, unknown in (("four-bar", 9 + 1), ("spatial-slider-crank", None)):
        info = prepare(symgen.load(name).mechanism, Settings(integrator="picard")).compiled.info
        rows = rates_of(info)
        expected = unknown or info.nv + 4 * len(info.spins) + 1 + info.integrals
        assert rows[0] == expected == (len(rows) - 1) // 2
        for element, coordinate in zip(rows[1 : 1 + expected], rows[1 + expected :], strict=True):
            if coordinate >= 0:
                q, v = info.coordinates[coordinate].name, info.velocities[element - info.nq].name
                assert q.rpartition(".")[0] == v.rpartition(".")[0]


@pytest.mark.by_turns(2)
@pytest.mark.slow
@pytest.mark.parametrize("coordinates", ["joint", "absolute"])
def test_order_is_at_least_14(coordinates):
    mechanism, until, steps = symgen.load("four-bar").mechanism, 10.0, [90, 100, 110, 120, 130, 140, 160]
    more = {"method": "lagrange", "coordinates": coordinates}
    exact = motion(prepare(mechanism, Settings(integrator="dop853", until=until, **more)), 400)
    errors = []
    for count in steps:
        outcome, q = ended(mechanism, until, step=until / count, **more, **CONSTANT, **ENDLESS)
        assert outcome.code == 0
        errors.append(float(np.abs(q - exact[: len(q)]).max()))
    inside = [(math.log(n), math.log(e)) for n, e in zip(steps, errors, strict=True) if 1e-12 < e < 1e-4]
    assert len(inside) >= 5, errors
    assert -np.polyfit(*zip(*inside, strict=True), 1)[0] >= 14.0, errors


@pytest.mark.parametrize("method", ["lagrange", "direct-correction"])
@pytest.mark.parametrize("rtol", [1e-6, 1e-8, 1e-10, 1e-12])
def test_errors_follow_tolerances(four_bar, method, rtol):
    mechanism, exact = four_bar
    outcome, q = ended(mechanism, 1.0, method=method, coordinates="joint", rtol=rtol, atol=rtol)
    assert outcome.code == 0
    assert np.abs(q - exact[: len(q)]).max() <= 50.0 * rtol + 1e-12


def test_a_stiff_spring_is_followed_and_a_kink_is_found():
    for rtol in (1e-6, 1e-9):
        omega, until = 300.0, 2.0
        outcome, q = ended(on_a_spring(f"-{omega**2}*ball.y + 9.81"), until, rtol=rtol, atol=rtol)
        assert outcome.code == 0
        assert q[1] == pytest.approx(0.5 * math.cos(omega * until), abs=300.0 * rtol)
        fall = math.sqrt(2.0 * 0.5 / 9.81)
        speed, stiffness = 9.81 * fall, 100.0
        # on the floor the ball swings about its rest, with 10 rad/s, until it leaves with the speed it came with
        contact = 2.0 * (math.pi - math.atan2(speed / 10.0, 9.81 / stiffness)) / 10.0
        at = fall + contact + 0.1
        outcome, q = ended(on_a_spring(f"max(-{stiffness}*ball.y, 0)"), at, rtol=rtol, atol=rtol)
        assert outcome.code == 0
        assert q[1] == pytest.approx(speed * 0.1 - 0.5 * 9.81 * 0.01, abs=100.0 * rtol)


def test_a_damper_takes_many_steps_and_stays_right():
    c = 400.0
    outcome, q = ended(on_a_spring(f"-{c}*ball.vy"), 1.0, rtol=1e-8)
    assert outcome.code == 0
    settled = -9.81 / c
    assert q[1] == pytest.approx(0.5 + settled * 1.0 - settled / c * (1.0 - math.exp(-c)), abs=1e-7)
    assert outcome.steps > 300  # the iteration, not the motion, bounds them
    assert outcome.counters["slow_steps"] > 0.9 * outcome.steps


def test_a_stiff_motion_is_noted_and_left_by_an_automatic_choice(monkeypatch):
    """Where eigenvalues at the start do not show that a motion is stiff, the convergence of the first steps does."""
    from symgen.run.planning import automatic

    monkeypatch.setattr(automatic, "STIFF_RATIO", 1e9)
    model = symgen.Model(on_a_spring("-4000.0*ball.vy"))
    found = model.simulate(integrator="picard", until=0.5, rtol=1e-8)
    assert any("converged slowly" in note and "radau5" in note for note in found.notes)
    assert found.proposals == ("--integrator radau5",) and "stiff: `integrator` radau5 takes" in repr(found)
    chosen = model.simulate(method="lagrange", integrator="auto", until=0.5)
    assert chosen.integrator == "radau5"
    assert any("converges slowly" in note for note in chosen.notes)
    assert symgen.load("four-bar").simulate(integrator="auto", until=1.0).integrator == "picard"


def test_outputs_inside_a_step_across_a_singular_position_belong_to_its_motion():
    """Velocities are differences of angles; such a step has no polynomial of its nodes."""
    keys = {"integrator": "picard", "rtol": 1e-9, "atol": 1e-9, "until": 4.0}
    result = symgen.load("n-four-bar:1").simulate(**keys, times=np.linspace(0.0, 4.0, 40001))
    assert result.status == "ok" and result.outcome.rank_event_count
    differences = np.gradient(result["vertical0.theta"], result.t) - result["vertical0.omega"]
    assert np.abs(differences[1:-1]).max() < 1e-4


@pytest.mark.slow
def test_velocities_at_outputs_have_the_digits_of_the_tolerance():
    mechanism, times = symgen.load("andrews").mechanism, [float(t) for t in np.linspace(0.0, 0.03, 41)]
    more = {"method": "lagrange", "coordinates": "joint", "until": 0.03, "times": times}
    right = prepare(mechanism, Settings(integrator="dop853", rtol=3e-14, atol=1e-15, **more)).integrate()
    found = prepare(mechanism, Settings(integrator="picard", rtol=1e-12, atol=1e-12, **more)).integrate()
    nq, nv = found.compiled.info.nq, found.compiled.info.nv
    off = np.abs(found.states - right.states)[:, nq : nq + nv]
    assert off[:-1].max() <= 10.0 * off[-1].max() + 1e-10


@pytest.mark.parametrize("method", ["augmented-lagrangian", "coordinate-partitioning", "null-space", "udwadia-kalaba"])
def test_laws_without_a_form_in_vectors_have_the_same_motion(four_bar, method):
    mechanism, _ = four_bar
    other = ended(mechanism, 1.0, method=method, integrator="dop853", rtol=1e-11, atol=1e-12)[1]
    outcome, q = ended(mechanism, 1.0, method=method, rtol=1e-9, atol=1e-10)
    assert outcome.code == 0
    np.testing.assert_allclose(q, other, atol=2e-7)


def test_nodes_one_by_one_are_nodes_at_once(four_bar, monkeypatch):
    """Evaluated by the right-hand side of one node the run is the same but for rounding."""
    from symgen.run.layout import right_hand_side

    mechanism, _ = four_bar
    settings = {"method": "lagrange", "coordinates": "joint", "rtol": 1e-9, "atol": 1e-9}
    outcome, q = ended(mechanism, 1.0, **settings)
    monkeypatch.setattr(right_hand_side, "STRAIGHT", "nothing begins so")
    alone, same = ended(mechanism, 1.0, **settings)
    assert (outcome.simulation.scheme.vector, alone.simulation.scheme.vector) == (1, 0)
    np.testing.assert_allclose(q, same, atol=1e-11)


def test_a_constant_step_that_is_too_long_fails_with_a_reason():
    outcome, _ = ended(on_a_spring("-1e4*ball.vy"), 1.0, step=0.1, **CONSTANT, **ENDLESS)
    assert "did not converge" in outcome.reason

"""Which methods of the literature are one: their formulas, written here with NumPy, beside the emitted laws."""

from functools import cache

import numpy as np
import pytest
import scipy.linalg
from support.checks import close
from support.emitted import Emitted, mechanism_of
from support.laws_at import LawAt, described
from support.models import parallelogram

FOUR_BAR = described("four-bar")
#: Of a direct solution; the augmented iteration leaves what its penalty, 1e5 times the masses, costs in digits.
TOLERANCE, ITERATED = 1e-11, 1e-9


def massless() -> dict:
    """The four-bar with a coupler without mass."""
    bodies = FOUR_BAR["bodies"]
    return FOUR_BAR | {"bodies": bodies | {"coupler": bodies["coupler"] | {"mass": 0.0, "inertia": 0.0}}}


RAW = {"regular": FOUR_BAR, "redundant": parallelogram(), "massless": massless()}


@cache
def law(name, method, *options):
    return LawAt(RAW[name], method, dict(options))


def states(name, count=4):
    """States near the start; where rows repeat each other only states on the constraints have consistent rows."""
    at, rng = law(name, "lagrange", *((("solver", "dense"),) if name == "massless" else ())), np.random.default_rng(7)
    for _ in range(count):
        if name == "redundant":
            q = at.q + 1e-2 * rng.standard_normal(at.nq)
            yield law(name, "direct-correction").accepted(q, rng.standard_normal(at.nv))
        else:
            yield at.q + 0.1 * rng.standard_normal(at.nq), rng.standard_normal(at.nv)


# -- one law under many names ------------------------------------------------------------------------------------------


def root(m, power):
    values, vectors = np.linalg.eigh(m)
    return vectors @ np.diag(values**power) @ vectors.T


def on_basis(m, d, f, gamma, basis):
    """v' = b + R z' with D R = 0 and D b = gamma."""
    b = np.linalg.lstsq(d, gamma, rcond=None)[0]
    return b + basis @ np.linalg.solve(basis.T @ m @ basis, basis.T @ (f - m @ b))


def svd(m, d, f, gamma):
    """Mani, Haug, Atkinson 1985; Singh, Likins 1985; Meijaard 1993."""
    return on_basis(m, d, f, gamma, scipy.linalg.null_space(d))


def qr(m, d, f, gamma):
    """Kim, Vanderploeg 1986."""
    rank = np.linalg.matrix_rank(d)
    return on_basis(m, d, f, gamma, scipy.linalg.qr(d.T, pivoting=True)[0][:, rank:])


def mass_orthonormal(m, d, f, gamma):
    """Blajer 1995: R^T M R = 1."""
    return on_basis(m, d, f, gamma, root(m, -0.5) @ scipy.linalg.null_space(d @ root(m, -0.5)))


def elimination(m, d, f, gamma):
    """Ider, Amirouche 1988; Agrawal, Saigal 1989; the natural orthogonal complement: columns solved for others."""
    rank = np.linalg.matrix_rank(d)
    order = scipy.linalg.qr(d, pivoting=True)[2]
    basis = np.zeros((d.shape[1], d.shape[1] - rank))
    basis[order[rank:]] = np.eye(d.shape[1] - rank)
    basis[order[:rank]] = -np.linalg.lstsq(d[:, order[:rank]], d[:, order[rank:]], rcond=None)[0]
    return on_basis(m, d, f, gamma, basis)


def maggi(m, d, f, gamma):
    """Maggi's equations (Garcia de Jalon, Callejo, Hidalgo 2012): [R^T M; D] v' = [R^T f; gamma]."""
    basis = scipy.linalg.null_space(d)
    right = np.concatenate([basis.T @ f, gamma])
    return np.linalg.lstsq(np.vstack([basis.T @ m, d]), right, rcond=None)[0]


def udwadia_kalaba(m, d, f, gamma):
    """Udwadia, Kalaba 1992."""
    free, half = np.linalg.solve(m, f), root(m, -0.5)
    return free + half @ np.linalg.pinv(d @ half) @ (gamma - d @ free)


def aghili(m, d, f, gamma):
    """Aghili, Piedboeuf 2003: (M + P M - (P M)^T) v' = P f + M D^+ gamma."""
    inverse = np.linalg.pinv(d)
    p = np.eye(len(m)) - inverse @ d
    return np.linalg.solve(m + p @ m - (p @ m).T, p @ f + m @ inverse @ gamma)


def udwadia_phohomsiri(m, d, f, gamma):
    """Udwadia, Phohomsiri 2006: [P M; D] v' = [P f; gamma]."""
    p = np.eye(len(m)) - np.linalg.pinv(d) @ d
    return np.linalg.lstsq(np.vstack([p @ m, d]), np.concatenate([p @ f, gamma]), rcond=None)[0]


def square_form(m, d, f, gamma):
    """The same as one square matrix: (P M + D^+ D) v' = P f + D^+ gamma."""
    inverse = np.linalg.pinv(d)
    p = np.eye(len(m)) - inverse @ d
    return np.linalg.solve(p @ m + inverse @ d, p @ f + inverse @ gamma)


FORMS = (svd, qr, mass_orthonormal, elimination, maggi, udwadia_kalaba, aghili, udwadia_phohomsiri, square_form)
#: Those that a singular M does not harm where [M; D] has full column rank.
REGULAR = (svd, qr, elimination, maggi, udwadia_phohomsiri, square_form)
SOLVERS = [(), (("solver", "augmented"),), (("solver", "dense"),)]


@pytest.mark.fast("()-regular", "(('solver', 'dense'),)-regular")
@pytest.mark.parametrize("name", ["regular", "redundant"])
@pytest.mark.parametrize("options", SOLVERS, ids=str)
def test_one_law_under_many_names(name, options):
    laws = [law(name, "lagrange", *options), *((law(name, "udwadia-kalaba"),) if not options else ())]
    tolerance = ITERATED if "augmented" in dict(options).values() else TOLERANCE
    for q, v in states(name):
        e = laws[0].equations(q, v)
        for one in laws:
            _, acceleration, multipliers = one.rates(q, v)
            close(e.mass @ acceleration + e.d.T @ multipliers, e.f, "M v' + D^T lambda", tolerance)
            for form in FORMS:
                close(acceleration, form(e.mass, e.d, e.f, e.gamma), form.__name__, tolerance)


@pytest.mark.slow
@pytest.mark.parametrize("options", SOLVERS[1:], ids=str)
def test_forms_for_singular_mass_matrices_are_oracles_for_the_solvers_that_need_no_inverse(options):
    one = law("massless", "lagrange", *options)
    for q, v in states("massless"):
        e, (_, acceleration, _) = one.equations(q, v), one.rates(q, v)
        assert np.linalg.matrix_rank(e.mass) == 6
        for form in REGULAR:
            close(acceleration, form(e.mass, e.d, e.f, e.gamma), form.__name__, ITERATED)
        p = scipy.linalg.null_space(e.d) @ scipy.linalg.null_space(e.d).T
        # Aghili's matrix is singular where a massless direction is one of constraint forces, M x = 0 and x = D^T y
        assert np.linalg.matrix_rank(e.mass + p @ e.mass - e.mass @ p) < 9


@pytest.mark.slow
def test_what_inconsistent_rows_get():
    """Aghili's form and the pseudoinverse spread what cannot be had over the rows; a row that is dropped has it all."""
    q, v = next(states("redundant", 1))
    one = law("redundant", "lagrange")
    e, (_, acceleration, _) = one.equations(q, v), one.rates(q, v)
    gamma = e.gamma + 0.1 * np.eye(len(e.gamma))[-1]
    rest = e.d @ aghili(e.mass, e.d, e.f, gamma) - gamma
    close(rest, e.d @ np.linalg.lstsq(e.d, gamma, rcond=None)[0] - gamma, "least squares", TOLERANCE)
    dropped = e.d @ acceleration - gamma
    assert np.abs(dropped[:-1]).max() < TOLERANCE
    assert abs(dropped[-1]) == pytest.approx(0.1, rel=1e-9) and np.linalg.norm(rest) < 0.5 * np.linalg.norm(dropped)


# -- penalties, compliance, proximal iterations ------------------------------------------------------------------------


def stabilised(e, omega=10.0, mu=1.0):
    return e.gamma - 2.0 * omega * mu * e.drift - omega**2 * e.phi


@pytest.mark.parametrize("penalty", [1e3, 1e6])
def test_a_penalty_is_a_compliance(penalty):
    """(S + 1/a) lambda = D M^-1 f - g: Bayo's penalty, constraint force mixing, Tikhonov's regularisation."""
    stiff = LawAt(FOUR_BAR, "penalty", {}, {"penalty": penalty})
    soft = LawAt(FOUR_BAR, "compliant-constraints", {}, {"compliance": 1.0 / penalty})
    for q, v in states("regular"):
        e = stiff.equations(q, v)
        right = e.d @ np.linalg.solve(e.mass, e.f) - stabilised(e)
        multipliers = np.linalg.solve(e.schur() + np.diag(1.0 / (penalty * stiff.row_masses())), right)
        for one, rounding in ((stiff, 1e-14 * penalty), (soft, 0.0)):
            _, acceleration, reported = one.rates(q, v)
            close(e.mass @ acceleration + e.d.T @ multipliers, e.f, "v'", TOLERANCE + rounding)
            close(reported, multipliers, "lambda", TOLERANCE + rounding)


def test_iterates_of_the_augmented_lagrangian_are_those_of_the_proximal_iteration():
    """(S + 1/a) lambda' = D M^-1 f - g + lambda / a (Carpentier and others 2021), iterate by iterate."""
    a, at = 1e3, law("regular", "lagrange")
    emitted = Emitted(mechanism_of(FOUR_BAR), "augmented-lagrangian")
    modules = {n: m for m in emitted.modules.values() for n in ("begin", "iterate") if n in vars(m)}
    p, w = emitted.parameters(at.plain.values, {"penalty": a}), emitted.scratch()
    emitted.call(emitted.model, "masses", p, w)
    for q, v in states("regular", 2):
        e = at.equations(q, v)
        emitted.call(modules["begin"], "begin", 0.0, at.state(q, v)[: 2 * at.nq + 1], p, w)
        multipliers, s = np.zeros(len(e.gamma)), e.schur() + np.eye(len(e.gamma)) / a
        for _ in range(4):
            emitted.call(modules["iterate"], "iterate", p, w)
            right = e.d @ np.linalg.solve(e.mass, e.f) - stabilised(e)
            multipliers = np.linalg.solve(s, right + multipliers / a)
            close(emitted.section(w, "multipliers"), multipliers, "lambda", TOLERANCE)


# -- corrections -------------------------------------------------------------------------------------------------------


def projected(one, weight, q, v):
    """v less D^+ w in the metric of a weight matrix, at q."""
    e = one.equations(q, v)
    half = np.linalg.solve(weight, e.d.T)
    return v - half @ np.linalg.solve(e.d @ half, e.drift)


@pytest.mark.parametrize("a", [0.0, 1.0, 1e4])
def test_the_metric_with_penalties_is_that_of_the_mass(a):
    """W = M + a D^T D has M's own D^+ for every a (Zhang, Liu, Liu 2016)."""
    one = law("regular", "velocity-projection", ("weight", "mass"))
    for q, v in states("regular"):
        e = one.equations(q, v)
        close(
            one.accepted(q, v)[1], projected(one, e.mass + a * e.d.T @ e.d, q, v), "v", 1e-9 if a > 1.0 else TOLERANCE
        )


def test_mass_orthogonal_projection_is_direct_correction_in_the_metric_of_mass():
    """Velocities to rounding; positions up to the square of what is corrected, as D is taken at different places."""
    one, other = law("regular", "mass-orthogonal-projection"), law("regular", "direct-correction", ("weight", "mass"))
    plain = law("regular", "direct-correction")
    rng, apart = np.random.default_rng(3), []
    off, v = rng.standard_normal(9), rng.standard_normal(9)
    closed = other.accepted(one.q, np.zeros(9))[0]
    close(one.accepted(closed, v)[1], other.accepted(closed, v)[1], "v", 1e-10)
    for size in (1e-3, 5e-4):
        ends = [x.accepted(closed + size * off, v)[0] for x in (one, other, plain)]
        apart.append([float(np.abs(ends[0] - x).max()) for x in ends[1:]])
    assert apart[0][0] / apart[1][0] == pytest.approx(4.0, rel=0.1)
    assert apart[0][1] / apart[1][1] == pytest.approx(2.0, rel=0.1)  # the other metric leads elsewhere


def test_post_stabilization_is_the_first_iterate_of_direct_correction():
    once, many = law("regular", "post-stabilization"), law("regular", "direct-correction")
    q = once.q + 1e-3 * np.random.default_rng(4).standard_normal(9)
    e = once.equations(q, np.zeros(9))
    first = q - np.linalg.pinv(e.d) @ e.phi
    close(once.accepted(q, np.zeros(9))[0], first, "q", TOLERANCE)
    assert np.abs(many.accepted(q, np.zeros(9))[0] - first).max() > 1e-8


def test_what_a_projection_takes_of_the_energy():
    """For nu = 0 exactly w^T S^-1 w / 2 in the metric of M (Garcia Orden 2010); another metric takes another amount."""
    taken = {}
    for weight in ("mass", "identity"):
        one = law("regular", "velocity-projection", ("weight", weight))
        for q, v in states("regular"):
            e, after = one.equations(q, v), one.accepted(q, v)[1]
            loss = 0.5 * (v @ e.mass @ v - after @ e.mass @ after)
            taken.setdefault(weight, []).append(loss / (0.5 * e.drift @ np.linalg.solve(e.schur(), e.drift)))
    np.testing.assert_allclose(taken["mass"], 1.0, rtol=1e-11)
    assert np.abs(np.array(taken["identity"]) - 1.0).min() > 1e-3, taken

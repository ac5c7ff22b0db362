"""The methods card: every function of the page beside the emitted code, and none longer than a reader takes in."""

import ast
import re
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
from support.laws_at import LawAt, described

import symgen
from symgen.derive.methods import METHODS
from symgen.run.layout.abi import STEP_STATUS

PAGE = (Path(__file__).parents[3] / "docs/methods-card.md").read_text(encoding="utf-8")
SOURCE = "\n\n".join(re.findall(r"```python\n(.*?)```", PAGE, re.DOTALL))
CARD = SimpleNamespace()
exec(compile(SOURCE, "methods-card.md", "exec"), CARD.__dict__)  # the page's own text
RAW, H = described("four-bar"), 0.02
GAINS = {"omega": 7.0, "mu": 0.8}


def card(method):
    return getattr(CARD, method.replace("-", "_"))


LENGTHS, MASSES = (2.0, 8.0, 5.0), np.array([2.0, 8.0, 5.0])
#: Joints: the first body and its point, the second body and its point; None is the ground.
PINS = ((None, 0.0, 0, -1.0), (0, 1.0, 1, -4.0), (1, 4.0, 2, 2.5), (None, 10.0, 2, -2.5))


def system():
    """M, D, f, gamma, Phi and w of the four-bar, whose points are on the axes of the bars."""
    inertia = MASSES * np.square(LENGTHS) / 12.0
    mass = np.diag(np.column_stack([MASSES, MASSES, inertia]).ravel())
    weight = np.column_stack([np.zeros(3), -9.81 * MASSES, np.zeros(3)]).ravel()

    def s(q, v):
        phi, d, gamma = np.zeros(8), np.zeros((8, 9)), np.zeros(8)
        for k, (first, near, second, far) in enumerate(PINS):
            for sign, body, x in ((-1.0, first, near), (1.0, second, far)):
                rows = slice(2 * k, 2 * k + 2)
                if body is None:
                    phi[rows] += sign * np.array([x, 0.0])
                    continue
                arm = x * np.array([np.cos(q[3 * body + 2]), np.sin(q[3 * body + 2])])
                phi[rows] += sign * (q[3 * body : 3 * body + 2] + arm)
                d[rows, 3 * body : 3 * body + 2] = sign * np.eye(2)
                d[rows, 3 * body + 2] = sign * np.array([-arm[1], arm[0]])
                gamma[rows] += sign * arm * v[3 * body + 2] ** 2
        return SimpleNamespace(M=mass, D=d, f=weight, gamma=gamma, phi=phi, w=d @ v)

    return s


def states(at, size=0.05):
    rng = np.random.default_rng(5)
    for _ in range(3):
        yield at.q + size * rng.standard_normal(9), rng.standard_normal(9)


def agree(found, expected, bound=1e-12):
    found, expected = np.concatenate(found), np.concatenate(expected)
    assert np.abs(found - expected).max() < bound * max(1.0, np.abs(expected).max())


def test_every_method_has_a_function_of_fifteen_lines_at_most():
    functions = [f for f in ast.parse(SOURCE).body if isinstance(f, ast.FunctionDef)]
    texts = {f.name: ast.get_source_segment(SOURCE, f) for f in functions}
    assert max(sum(map(bool, text.split("\n"))) for text in texts.values()) <= 15
    assert all(hasattr(CARD, name.replace("-", "_")) and f"`{name}`" in PAGE for name in METHODS.names)


@pytest.mark.parametrize("method", ["lagrange", "baumgarte", "adaptive-baumgarte", "udwadia-kalaba", "null-space"])
def test_laws(method):
    own = {"baumgarte": {"alpha": 7.0, "beta": 9.0}, "adaptive-baumgarte": {"gain": 70.0, "a": 1.0}}.get(method, {})
    at = LawAt(RAW, method, {}, own)
    at.w[STEP_STATUS] = H
    given = own | ({"h": H} if method == "adaptive-baumgarte" else {})
    for q, v in states(at, 0.0 if method == "null-space" else 0.05):
        if method == "null-space":  # its basis is chosen where a state is accepted
            q, v = at.accepted(q, v)
        agree([at.rates(q, v)[1]], [card(method)(system(), q, v, **given)])


@pytest.mark.parametrize("method", ["penalty", "compliant-constraints", "augmented-lagrangian"])
def test_laws_with_penalties(method):
    key, number = ("compliance", 1e-4) if method == "compliant-constraints" else ("penalty", 1e4)
    at = LawAt(RAW, method, {}, GAINS | {key: number})
    for q, v in states(at):
        expected = card(method)(system(), q, v, 1e4 * at.row_masses(), **GAINS)
        agree([at.rates(q, v)[1]], [expected], 1e-10 if method == "penalty" else 1e-11)


def test_index_1():
    at = LawAt(RAW, "index1-augmented-lagrangian", {}, {"penalty": 1e4})
    for q, v in states(at):
        agree([at.rates(q, v)[1]], [CARD.index1_augmented_lagrangian(system(), q, v, 1e4 * at.row_masses())], 1e-11)


def test_loads_like_the_stiffness():
    at = LawAt(RAW, "stiffness-scaled-penalty")
    for q, v in states(at):
        x, shared = CARD.stiffness_scaled_penalty(system(), q, v, np.full(8, 1e9), at.status("mean_mass"))
        _, acceleration, multipliers = at.rates(q, v)
        agree([acceleration], [x])
        agree([system()(q, v).D.T @ shared], [at.equations(q, v).d.T @ multipliers], 1e-9)


@pytest.mark.parametrize(
    ("method", "own"),
    [
        ("invariant-stabilization", {"kappa": 7.0}),
        ("braun-goldfarb", {}),
        ("hamiltonian-baumgarte", {"alpha": 3.0}),
        ("augmented-hamiltonian", {}),
    ],
)
def test_rates(method, own):
    at = LawAt(RAW, method, {}, own)
    at.w[STEP_STATUS] = H
    for q, v in states(at):
        found = at.rates(q, v)[:2]
        given = {"h": H} if method == "braun-goldfarb" else own
        # the rate of D is a difference on the page and in the code, whose rounding is divided by a step
        agree(found, card(method)(system(), q, v, **given), 1e-8 if "hamil" in method else 1e-12)


@pytest.mark.parametrize(
    ("method", "own"),
    [
        ("direct-correction", {}),
        ("post-stabilization", {}),
        ("velocity-projection", {}),
        ("controllable-velocity-projection", {"theta": 0.3}),
        ("mass-orthogonal-projection", {"penalty": 1e4}),
        ("dependent-correction", {}),
        ("coordinate-partitioning", {}),
    ],
)
def test_corrections(method, own):
    at = LawAt(RAW, method, {}, own)
    at.accepted(at.q, at.v)
    for q, v in states(at, 1e-3):
        found, given = at.accepted(q, v), {"theta": 0.3} if "theta" in own else {}
        if method in ("dependent-correction", "coordinate-partitioning"):
            given = {"dependent": np.flatnonzero(found[0] != q)}
            assert len(given["dependent"]) == 8
        agree(found, card(method)(system(), q, v, **given), 1e-11)


def test_energy():
    at = LawAt(RAW, "energy-projection")
    q, v = at.accepted(at.q + 1e-3, 0.3 * np.ones(9))
    s = system()
    weight = s(q, v).f

    def potential(q):
        return -weight @ q

    energy = 0.5 * v @ s(q, v).M @ v + potential(q)
    for q, v in states(at, 1e-3):
        closed = CARD.direct_correction(s, q, v, mass=True)[1]
        v = v * np.sqrt((energy - potential(q)) / (0.5 * closed @ s(q, v).M @ closed))
        agree(at.accepted(q, v), CARD.energy_projection(s, q, v, energy, potential), 1e-11)


STEPS = 3


def by_run(method, **options):
    names = [f"{b}.{c}" for b in ("crank", "coupler", "rocker") for c in ("x", "y", "theta")]
    names += [f"{b}.{c}" for b in ("crank", "coupler", "rocker") for c in ("vx", "vy", "omega")]
    keys = {"step": H, "until": STEPS * H, "output_step": H, "max_violation": 1.0, "max_energy_error": 10.0}
    result = symgen.load("four-bar").simulate(method=method, options=options, coordinates="absolute", **keys)
    return np.array([result[name][-1] for name in names])


@pytest.mark.slow
@pytest.mark.parametrize("method", ["rattle", "half-explicit", "implicit-constraint"])
def test_schemes(method):
    at = LawAt(RAW, "lagrange")
    q, v = at.q, at.v
    for _ in range(STEPS):
        q, v = card(method)(system(), q, v, H)
    agree([q, v], [by_run(method)])


@pytest.mark.by_turns(3)
@pytest.mark.slow
@pytest.mark.parametrize("method", ["discrete-gradient", "ggl", "symmetric-projection"])
def test_schemes_that_iterate(method):
    at = LawAt(RAW, "lagrange")
    q, v, own = at.q, at.v, (at.section("gauge"),) if method == "symmetric-projection" else ()
    for _ in range(STEPS):
        q, v = card(method)(system(), q, v, H, *own)
    agree([q, v], [by_run(method, **({"integrator.adaptive": "false"} if method == "ggl" else {}))], 1e-11)


@pytest.mark.slow
def test_schemes_with_accelerations():
    at = LawAt(RAW, "lagrange")
    s, x = system(), CARD.lagrange(system(), at.q, at.v)
    state = at.q, at.v, x, x
    for _ in range(STEPS):
        state = CARD.generalized_alpha(s, *state[:2], H, 0.8, *state[2:])
    agree(state[:2], [by_run("generalized-alpha", **{"integrator.rho": 0.8})], 1e-11)
    state = at.q, at.v, x
    for _ in range(STEPS):
        state = CARD.index3_augmented_lagrangian(s, *state[:2], H, state[2])
    agree(state[:2], [by_run("index3-augmented-lagrangian")], 1e-11)

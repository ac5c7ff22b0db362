"""Acceleration laws against the whole saddle-point matrix, solved densely from the reference's M, D, f and gamma."""

from functools import cache

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from support import reference
from support.checks import RANDOM, close
from support.emitted import Emitted, mechanism_of
from support.kinds import METHODS
from support.models import EVERYTHING, ROUGH
from support.plain import Plain
from support.random_mechanisms import descriptions, states

from symgen.derive.methods import METHODS as KNOWN
from symgen.describe.joints import JOINTS

#: Ropes follow from their starts, and have closed forms in tests/run/single/test_ropes.py; points on beams have theirs
#: in tests/verification/test_sliding.py.
PLANAR = tuple(name for name, kind in JOINTS.items() if "planar" in kind.SPACES and name not in ("rope", "slides-on"))

ALPHA, BETA = 3.5, 7.0


def stabilised(method, gamma, phi, drift):
    """What stands in the place of gamma."""
    return gamma - 2 * ALPHA * drift - BETA**2 * phi if method == "baumgarte" else gamma


class Expected:
    """The reference's equations at one state."""

    def __init__(self, plain, rows, t, q, v) -> None:
        phi = plain.phi(t, q)
        d, gamma = reference.jacobian(plain, t, q, v), reference.gamma(plain, t, q, v)
        drift, nu = reference.velocity_residual(plain, t, q, v), reference.nu(plain, t, q)
        self.phi = np.array([phi.get(n, 0.0) for n in rows])
        self.d = np.array([d[n] for n in rows]).reshape(len(rows), plain.size)
        self.gamma = np.array([gamma[n] for n in rows])
        self.drift = np.array([drift[n] for n in rows])
        self.nu = np.array([nu.get(n, 0.0) for n in rows])
        self.f, self.power = reference.applied(plain, t, q, v)
        self.mass = reference.masses(plain)

    def sine(self) -> float:
        """Smallest singular value of D with rows of length 1; 1 without rows."""
        if not len(self.d):
            return 1.0
        scaled = self.d / np.linalg.norm(self.d, axis=1, keepdims=True)
        return float(np.linalg.svd(scaled, compute_uv=False)[-1]) if len(scaled) <= self.d.shape[1] else 0.0

    def solve(self, method):
        return reference.saddle_point(self.mass, self.d, self.f, stabilised(method, self.gamma, self.phi, self.drift))


#: Method and options of laws that are one linear solution.
LAWS = [*((m, {}) for m in METHODS), ("lagrange", {"solver": "dense"}), ("baumgarte", {"solver": "dense"})]


def check(emitted, plain, t, q, v, method, tolerance):
    expected = Expected(plain, [r.name for r in emitted.info.rows], t, q, v)
    p = emitted.parameters(plain.values, {"alpha": ALPHA, "beta": BETA})
    found = emitted.at(t, q, v, p)
    acceleration, multipliers = expected.solve(method)
    close(found.acceleration, acceleration, f"v' of {method}", tolerance)
    close(found.multipliers, multipliers, f"lambda of {method}", tolerance)
    close(found.power, expected.power - multipliers @ expected.nu, f"power, {method}", tolerance)


@pytest.mark.by_turns(3)
@pytest.mark.slow
@pytest.mark.parametrize(("method", "options"), LAWS)
@RANDOM
@given(data=st.data())
def test_law_on_random_mechanisms(method, options, data):
    kinds = tuple(data.draw(st.lists(st.sampled_from(PLANAR), min_size=1, max_size=3)))
    raw = data.draw(descriptions(kinds, ("spring-damper", "torque")))
    t, q, v = data.draw(states())
    plain = Plain(raw)
    q, v = q[: plain.size], v[: plain.size]
    emitted = Emitted(mechanism_of(raw), method, options)
    expected = Expected(plain, [r.name for r in emitted.info.rows], t, q, v)
    assume(expected.sine() > 0.05)
    check(emitted, plain, t, q, v, method, 1e-9)


@cache
def compiled(name: str) -> tuple[Emitted, Plain]:
    raw = {"everything": EVERYTHING, "rough": ROUGH}[name]
    return Emitted(mechanism_of(raw), "baumgarte", compiled=True), Plain(raw)


@pytest.mark.slow_cases("everything")
@pytest.mark.parametrize("name", ["everything", "rough"])
def test_compiled_functions_on_every_joint_and_force(name):
    emitted, plain = compiled(name)
    rng = np.random.default_rng(5)
    for _ in range(6):
        t, q, v = float(rng.uniform(0, 1.5)), rng.uniform(-2, 2, plain.size), rng.uniform(-2, 2, plain.size)
        t, q, v = t, q.tolist(), v.tolist()
        found = emitted.at(t, q, v, emitted.parameters(plain.values, {"alpha": ALPHA, "beta": BETA}))
        expected = Expected(plain, [r.name for r in emitted.info.rows], t, q, v)
        close(found.phi, expected.phi, "Phi")
        close(found.d, expected.d, "D")
        close(found.gamma, expected.gamma, "gamma")
        close(found.nu, expected.nu, "nu")
        close(found.drift, expected.drift, "D v - nu")
        close(found.masses, expected.mass, "M")
        close(found.status["potential"], plain.potential(q), "V")
        close(found.status["kinetic"], expected.mass @ np.square(v) / 2, "T")
        acceleration, multipliers = expected.solve("baumgarte")
        close(found.acceleration, acceleration, "v'", 1e-9)
        close(found.multipliers, multipliers, "lambda", 1e-9)
        assert found.status["rank"] == len(expected.phi)
        assert 0.0 < found.status["smallest_pivot"] == found.pivots.min() <= 1.0


@pytest.mark.parametrize("method", METHODS)
def test_every_law_agrees_where_the_constraints_hold(method):
    """Where D v = nu and Phi = 0 nothing is left to stabilise: all laws give the accelerations of the motion."""
    raw = {key: value for key, value in ROUGH.items() if key != "forces"}
    raw |= {"joints": {n: j for n, j in ROUGH["joints"].items() if n in ("hinge", "turn")}}
    plain = Plain(raw)
    t, q = 0.4, [0.0, 0.0, 0.7, 1.0, 2.0, -0.3, -1.0, 0.5, 1.7 * 0.4]
    v = [0.0, 0.0, 1.1, 0.2, -0.4, 0.3, 0.1, 0.6, 1.7]
    emitted = Emitted(mechanism_of(raw), method)
    rows = [r.name for r in emitted.info.rows]
    expected = Expected(plain, rows, t, q, v)
    assert np.abs(expected.phi).max() < 1e-15 and np.abs(expected.drift).max() < 1e-15
    found = emitted.at(t, q, v, emitted.parameters(plain.values))
    acceleration, multipliers = expected.solve("lagrange")
    close(found.acceleration, acceleration, "v'", 1e-7)
    close(found.multipliers, multipliers, "lambda", 1e-5)


@pytest.mark.slow
def test_every_method_can_be_emitted_with_every_option():
    for name, method in KNOWN.items():
        for option in (option for option in method.options if option.emitted):
            for value in option.values:
                emitted = "identity" if value == "body" else value  # the same, in the coordinates of bodies
                assert Emitted(mechanism_of(ROUGH), name, {option.name: value}).law_info.options[option.name] == emitted


@given(st.floats(0.0, 100.0), st.floats(0.0, 100.0))
def test_the_largest_step_keeps_both_roots_of_the_feedback_within_the_boundary(alpha, beta):
    assume(max(alpha, beta) > 1e-3)
    farthest = np.abs(np.roots([1.0, 2.0 * alpha, beta**2])).max()
    step = KNOWN.get("baumgarte").largest_step({"alpha": alpha, "beta": beta}, 2.5)
    assert step == pytest.approx(2.5 / farthest, rel=1e-6)

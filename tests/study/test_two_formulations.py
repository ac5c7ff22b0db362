"""References of what no second derivation has: two formulations that agree, against closed forms."""

import numpy as np
import pytest

import symgen
from symgen.study.references.routes import derivable_part, motion_by_two_routes, parts_without_derivation
from symgen.study.stress.study import stress
from tests.support.struck import BALL

G, MU, SPEED, E = 9.81, 0.2, 1.0, 0.7

#: A block slides on a rail and stops; the friction is that of its weight.
BLOCK = f"""
[mechanism]
name = "sliding-block"
gravity = [0.0, -{G}]
[run]
until = 0.8
[parameters]
mu = {MU}
[bodies.block]
mass = 2.0
inertia = 0.1
velocity = [{SPEED}, 0.0]
[joints.rail]
type = "translational"
between = ["ground", "block"]
at = [[0.0, 0.0], "centre"]
axis = [1.0, 0.0]
angle = 0.0
friction = FRICTION
"""
BY_WEIGHT, CONSTANT = "{ coefficient = MU }", f"{{ sliding = {MU * 2.0 * G} }}"


def block(friction):
    return BLOCK.replace("FRICTION", friction.replace("MU", str(MU)))


def slid(t, mu=MU):
    """Where the block is: it decelerates by mu g until it rests."""
    t = np.minimum(t, SPEED / (mu * G))
    return SPEED * t - 0.5 * mu * G * t**2


def height(t):
    """Height of the ball of `BALL`, which falls from 1 m and keeps e of its speed."""
    first, speed, at = np.sqrt(2.0 / G), np.sqrt(2.0 * G), np.zeros_like(t)
    at = np.where(t < first, 1.0 - 0.5 * G * t**2, at)
    while first < t[-1]:
        speed *= E
        last = first + 2.0 * speed / G
        inside = (t >= first) & (t < last)
        at = np.where(inside, speed * (t - first) - 0.5 * G * (t - first) ** 2, at)
        first = last
    return at


@pytest.mark.slow_cases("{ coefficient = MU }-lagrange")
@pytest.mark.parametrize(("friction", "other"), [(BY_WEIGHT, "lagrange"), (CONSTANT, "index1-augmented-lagrangian")])
def test_a_block_that_stops_is_on_its_closed_form(tmp_path, friction, other):
    (path := tmp_path / "block.toml").write_text(block(friction))
    times = np.linspace(0.0, 0.8, 17)
    found = motion_by_two_routes(symgen.load(path).mechanism, {}, times)
    np.testing.assert_allclose(found.q[:, 0], slid(times), rtol=0.0, atol=1e-13)
    assert found.estimated_error < 1e-12 and f"estimated from {other} with abm" in found.how
    assert found.how.endswith("; there is no second derivation of dry friction")
    assert ("in joint coordinates" in found.how) is (other == "lagrange")


def test_comparisons_take_events_that_change_the_state(tmp_path):
    """Errors of the reference and of a row are those of the closed form of a bouncing ball."""
    (path := tmp_path / "ball.toml").write_text(BALL)
    times = np.linspace(0.0, 1.2, 13)
    found = motion_by_two_routes(symgen.load(path).mechanism, {}, times)
    np.testing.assert_allclose(found.q[:, 1], height(times), rtol=0.0, atol=1e-12)
    study = symgen.compare(path, ["lagrange"], ["dop853"], rtols=[1e-8], repeat=1, until=1.2, output_step=0.1)
    assert study.how.endswith("; there is no second derivation of events that change the state")
    run = symgen.load(path).simulate(
        until=1.2, method="lagrange", integrator="dop853", rtol=1e-8, atol=1e-10, times=times
    )
    (row,) = study.rows
    assert row.status == "ok" and row.error < 1e-7
    exact = np.abs(run["ball.y"] - height(run.t)).max()
    assert row.error == pytest.approx(exact, abs=1e-12)


def test_what_is_left_has_the_same_constraints(tmp_path):
    (path := tmp_path / "block.toml").write_text(block(CONSTANT) + '[events.turn]\nwhen = "block.x - 0.1"\n')
    mechanism = symgen.load(path).mechanism
    assert (
        parts_without_derivation(mechanism) == "dry friction" and derivable_part(mechanism).joints == mechanism.joints
    )
    assert not derivable_part(mechanism).bounded and not parts_without_derivation(derivable_part(mechanism))
    plain = symgen.load("four-bar").mechanism
    assert derivable_part(plain) is plain


@pytest.mark.slow
@pytest.mark.parametrize(
    ("file", "lacking"), [(BALL, "events that change the state"), (block(BY_WEIGHT), "dry friction")]
)
def test_stress_judges_by_two_formulations(tmp_path, file, lacking):
    (path := tmp_path / "file.toml").write_text(file)
    study = stress([path], ["gravity"], ["lagrange"], quick=True, jobs=1)
    assert not study.unusable and {row.outcome for row in study.rows} == {"ok"}
    assert any(f"no second derivation of {lacking}" in sentence for sentence in study.to_json()["findings"])

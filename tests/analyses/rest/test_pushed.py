"""A push from an unstable rest: it is kept where the start is near it, and left where a search came to it by chance."""

import math

import pytest
from support.emitted import mechanism_of

from symgen.analyses.linear.named_places import make_subject
from symgen.analyses.rest.equilibria import STABLE, UNSTABLE, judge_equilibrium
from symgen.analyses.rest.pushed import is_near_rest, sink_on
from symgen.analyses.rest.settle import settle_position
from symgen.base.settings import Settings

MASS, HALF, INERTIA, G = 2.0, 0.3, 0.05, 9.81


def started(angle):
    """Return the statics of a rod that hangs from its end, at an angle against the horizontal."""
    rod = {"mass": MASS, "inertia": INERTIA, "points": {"end": [-HALF, 0.0]}, "angle": angle, "hold": "angle"}
    rod["position"] = [HALF * math.cos(angle), HALF * math.sin(angle)]
    pin = {"type": "revolute", "between": ["ground", "rod"], "at": [[0.0, 0.0], "end"]}
    raw = {"mechanism": {"name": "rod", "gravity": [0.0, -G]}, "bodies": {"rod": rod}, "joints": {"pin": pin}}
    return make_subject(mechanism_of(raw), Settings(coordinates="absolute"))


def test_a_search_that_began_far_away_sinks_on():
    """At the top it is unstable; hanging it has omega^2 = m g l / (J + m l^2), by hand."""
    top = started(0.5 * math.pi)
    settled = settle_position(top, top.y)
    rest = judge_equilibrium(settled)
    assert rest.stability == UNSTABLE
    _, other = sink_on(started(-0.3), settled, rest)
    assert other.stability == STABLE
    assert other.q["rod.y"] == pytest.approx(-HALF, abs=1e-9)
    assert other.omega_squared[0] == pytest.approx(MASS * G * HALF / (INERTIA + MASS * HALF**2), rel=1e-9)


@pytest.mark.parametrize("beside", [0.0, 0.02, -0.1])
def test_an_unstable_rest_near_the_start_is_kept(beside):
    subject = started(0.5 * math.pi + beside)
    settled = settle_position(subject, subject.y)
    rest = judge_equilibrium(settled)
    assert is_near_rest(subject, subject.y.copy())
    assert sink_on(subject, settled, rest) == (settled, rest)
    assert rest.stability == UNSTABLE and rest.q["rod.y"] == pytest.approx(HALF, abs=1e-9)


def test_steps_that_grow_are_near_nothing():
    assert not is_near_rest(started(0.1), started(0.1).y.copy())

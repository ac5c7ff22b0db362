"""Residuals that follow each other: of noise they do not, of a model that lacks something they do, and it is said."""

import math

import numpy as np
import pytest
from support.emitted import mechanism_of

import symgen
from symgen.analyses.fit.neighbours import correlation_of_neighbours, notes_on_neighbours

LENGTH, DAMPING, G = 0.52, 0.08, 9.81


def swing(t):
    """Return the small angle of a point of 1 kg on a damped thread: the closed form."""
    rate, decay = math.sqrt(G / LENGTH - (0.5 * DAMPING / LENGTH**2) ** 2), 0.5 * DAMPING / LENGTH**2
    return 1e-3 * np.exp(-decay * t) * (np.cos(rate * t) + decay / rate * np.sin(rate * t))


def pendulum(length):
    """Return a pendulum of one kilogram that is thought to have a length."""
    body = {"mass": 1.0, "inertia": 1e-9, "position": [0.0, -length], "angle": 1e-3}
    body |= {"points": {"top": [0.0, length]}, "position": [length * math.sin(1e-3), -length * math.cos(1e-3)]}
    pin = {"type": "revolute", "between": ["ground", "bob"], "at": [[0.0, 0.0], "top"]}
    brake = {"type": "torsional-spring-damper", "between": ["ground", "bob"], "damping": "damping"}
    raw = {"mechanism": {"name": "pendulum", "gravity": [0.0, -G]}, "parameters": {"damping": 0.1}}
    return symgen.load(
        mechanism_of(raw | {"bodies": {"bob": body}, "joints": {"pin": pin}, "forces": {"brake": brake}})
    )


@pytest.mark.slow
@pytest.mark.parametrize(("length", "follow"), [(LENGTH, False), (0.50, True)])
def test_a_wrong_length_is_said_and_noise_is_not(length, follow):
    t = np.linspace(0.02, 4.0, 200)
    angle = swing(t) + 1e-5 * np.random.default_rng(4).standard_normal(len(t))
    fit = pendulum(length).identify({"t": t, "bob.theta": angle}, free=("damping",))
    said = [note for note in fit.notes if note.startswith("residuals of bob.theta follow each other (correlation 0.9")]
    assert len(said) == follow
    assert any("follow" in note for note in fit.notes if "residuals" in note) == follow
    if not follow:
        assert abs(fit.parameters["damping"] - DAMPING) < 4.0 * fit.errors["damping"]


def test_the_correlation_of_a_sine_is_its_cosine_and_that_of_noise_is_small():
    sine = np.sin(0.3 * np.arange(100_000))
    assert correlation_of_neighbours([sine])[0] == pytest.approx(math.cos(0.3), abs=1e-4)
    noise = np.random.default_rng(1).standard_normal((50, 400))
    correlation, deviation = correlation_of_neighbours(list(noise))
    assert deviation == pytest.approx((50 * 399) ** -0.5) and abs(correlation) < 4.0 * deviation
    alternating = np.resize([1.0, -1.0], 100)
    assert not notes_on_neighbours({"a": [alternating]}, {"a": 1.0})


def test_errors_of_integration_are_no_news():
    """The residuals of exact data follow each other, and nothing is wrong."""
    sine = 1e-8 * np.sin(0.1 * np.arange(500))
    assert not notes_on_neighbours({"a": [sine]}, {"a": 1.0})
    assert len(notes_on_neighbours({"a": [sine]}, {"a": 1e-6})) == 1

"""Equilibria, modes and linear systems in which closed contacts are rows, sticking ones in both directions."""

import math
from pathlib import Path

import numpy as np
import pytest

from symgen.base.errors import AnalysisError, InputError
from tests.run.contacts.scenes import G, body, head, loaded


def bowl(friction: str) -> str:
    """Return a disc in a hole, beside the bottom, with a spring at its centre."""
    hole, r, start = 0.8, 0.2, 0.25
    place = (hole - r) * math.sin(start), -(hole - r) * math.cos(start)
    text = head("bowl") + body("disc", 1.5, 0.6 * 1.5 * r * r, place)
    text += '[forces.spring]\ntype = "force"\nbody = "disc"\nforce = ["-6*disc.x", 0.0]\n'
    text += f'[contacts.rim]\nbetween = [{{ body = "disc", disc = {r} }}, {{ body = "ground", disc = {-hole} }}]\n'
    return text + friction


@pytest.mark.slow_cases("joint")
@pytest.mark.parametrize("coordinates", ["absolute", "joint"])
def test_a_disc_rolls_about_the_bottom_of_a_hole(coordinates: str, tmp_path: Path) -> None:
    """It is a pendulum with 1.6 of its mass; without friction the disc slides, and its angle is free."""
    square = (G / 0.6 + 6.0 / 1.5) / 1.6
    model = loaded(bowl("friction = 0.5\n"), tmp_path)
    rest = model.equilibrium(coordinates=coordinates)
    assert rest.stability == "stable" and abs(rest.q["disc.x"]) < 1e-9 and abs(rest.q["disc.y"] + 0.6) < 1e-9
    assert np.allclose(rest.omega_squared, [square], rtol=1e-9)
    modes = model.modes(coordinates=coordinates)
    assert np.allclose(sorted(np.imag(modes.eigenvalues)), [-math.sqrt(square), math.sqrt(square)], rtol=1e-9)
    system = model.linearise(coordinates=coordinates)
    assert np.allclose(np.linalg.eigvals(system.A).imag ** 2, square, rtol=1e-9)
    assert any("rim.slip at rest, held as rows" in note for note in rest.notes)
    smooth = loaded(bowl(""), tmp_path).modes(coordinates=coordinates)
    assert np.isclose(np.abs(np.imag(smooth.eigenvalues)).max() ** 2, G / 0.6 + 6.0 / 1.5, rtol=1e-9)


def plank(slope: float, mu: tuple[float, float]) -> str:
    """Return a plank on two feet on a slope."""
    text = head("plank", slope * 9.0, -9.0) + body("plank", 2.0, 0.05, (0.0, 0.1))
    for name, x, friction in (("left", -0.3, mu[0]), ("right", 0.2, mu[1])):
        shapes = f'[{{ body = "plank", at = [{x!r}, -0.1] }}, {{ line = "ground" }}]'
        text += f"[contacts.{name}]\nbetween = {shapes}\nfriction = {friction!r}\n"
    return text


def test_a_plank_rests_as_long_as_both_feet_hold(tmp_path: Path) -> None:
    """Moments about the feet give their forces, 18 N in all; what both hold is the sum of their bounds."""
    slope = 0.2
    left = 18.0 * (0.2 - 0.1 * slope) / 0.5
    mu = 0.05
    needed = (18.0 * slope - mu * left) / (18.0 - left)
    rest = loaded(plank(slope, (mu, needed + 1e-6)), tmp_path).equilibrium()
    assert abs(rest.q["plank.x"]) < 1e-12
    with pytest.raises(AnalysisError, match=r"the closed contact (left|right) slides there: it would take"):
        loaded(plank(slope, (mu, needed - 1e-6)), tmp_path).equilibrium()


def test_a_contact_that_slides_is_refused(tmp_path: Path) -> None:
    text = plank(0.0, (0.4, 0.4)).replace("velocity = [0.0, 0.0]", "velocity = [0.3, 0.0]")
    with pytest.raises(InputError, match=r"closed contacts at rest, got left, which slides at 0\.3 m/s"):
        loaded(text, tmp_path).modes()

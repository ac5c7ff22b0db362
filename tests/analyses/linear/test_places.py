"""Linear systems about equilibria that are named by coordinates."""

import math

import numpy as np
import pytest

import symgen
from symgen import MechanismBuilder
from symgen.base.errors import AnalysisError


@pytest.fixture(scope="module")
def model():
    builder = MechanismBuilder("cart-pole", gravity=(0.0, -9.81)).input("push", 0.0, unit="N")
    builder.body("cart", mass=1.0, inertia=0.1)
    builder.body(
        "pole", mass=0.2, inertia=0.006, points={"pin": (0.0, -0.3)}, position=(0.09, -0.28), angle=math.pi - 0.3
    )
    builder.joint("rail", "translational", between=("ground", "cart"), at=((0.0, 0.0), "centre"), axis=(1.0, 0.0))
    builder.joint("pin", "revolute", between=("cart", "pole"), at=("centre", "pin"))
    builder.force("motor", "force", body="cart", at="centre", force=("push", 0.0))
    return symgen.load(builder.build())


def poles() -> np.ndarray:
    """Return the squares of the poles of a cart with a pole, upright: by hand, (m + M)(I + m l^2) - (m l)^2."""
    cart, pole, inertia, half = 1.0, 0.2, 0.006, 0.3
    mass = np.array([[cart + pole, pole * half], [pole * half, inertia + pole * half**2]])
    stiffness = np.array([[0.0, 0.0], [0.0, pole * 9.81 * half]])
    return np.sort(np.linalg.eigvals(np.linalg.solve(mass, stiffness)).real)


@pytest.mark.parametrize(("at", "sign"), [({"pole.theta": 0}, 1.0), ({"pole.theta": 0.05, "cart.x": 1.0}, 1.0)])
def test_an_equilibrium_by_coordinates(model, at, sign):
    system = model.linearise(at=at)
    assert system.notes[0].startswith("about the unstable equilibrium at ")
    assert system.eigenvalues()[0].real == pytest.approx(math.sqrt(sign * poles()[-1]), rel=1e-9)
    assert system.about["pole.theta"] == pytest.approx(0.0, abs=1e-9)


def test_the_usual_one_says_which_it_is(model):
    system = model.linearise()
    assert "unstable" not in system.notes[0] and "pole.theta = 3.14159" in system.notes[0]
    assert abs(system.eigenvalues()[0].imag) == pytest.approx(math.sqrt(poles()[-1]), rel=1e-9)
    assert not model.linearise(at="start", instantaneous=True).notes


def test_none_is_near(model):
    with pytest.raises(AnalysisError, match=r"no equilibrium is near pole.theta = 0.5 rad: it comes to rest at"):
        model.linearise(at={"pole.theta": 0.5})
    assert model.modes(at={"pole.theta": 0.0}).omega_squared[0] < 0.0


def test_the_command_takes_coordinates(model, cli, tmp_path):
    builder = MechanismBuilder("rod", gravity=(0.0, -9.81))
    builder.body("rod", mass=1.0, inertia=0.1, points={"top": (0.0, 0.5)}, position=(0.0, -0.5))
    builder.joint("pin", "revolute", between=("ground", "rod"), at=((0.0, 0.0), "top"))
    file = tmp_path / "rod.toml"
    file.write_text(builder.to_toml(), encoding="utf-8")
    code, _, err = cli("linearise", file, "--at", "rod.theta=3.14159")
    assert code == 0 and "about the unstable equilibrium" in err
    code, _, err = cli("linearise", file, "--at", "rod.theta=a")
    assert code == 2 and "--at rod.theta: expected a finite number, got 'a'" in err

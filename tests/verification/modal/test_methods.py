"""Every method and every integrator moves a modal body alike."""

import numpy as np
import pytest
from support.modal_machines import machine, reduce_to, straight

from symgen.derive.methods import METHODS
from symgen.run.integrators import INTEGRATORS

ARM = """
[bodies.arm]
type = "modal"
file = "arm.npz"
damping = 1e-4

[joints.pin]
type = "revolute"
between = ["ground", "arm.root"]
at = [[0.0, 0.0], [0.0, 0.0]]
"""
#: Methods whose joints give, or that hold a part of what others hold.
LOOSE = {"penalty": 1e-6, "stiffness-scaled-penalty": 1e-6, "compliant-constraints": 1e-6}
#: Its integrator is of first order.
LOOSE["implicit-constraint"] = 1e-6
UNTIL = 0.02


@pytest.fixture(scope="module")
def model(tmp_path_factory):
    folder = tmp_path_factory.mktemp("modal")
    reduce_to(folder / "arm.npz", straight(young=2e8, count=8), 1)
    return machine(folder, ARM, gravity="[0.0, -9.81]", until=UNTIL, output_step=UNTIL / 4)


@pytest.fixture(scope="module")
def exact(model):
    return model.simulate(method="lagrange", integrator="dop853", rtol=1e-12, atol=1e-14)


def distance(result, exact):
    """The largest distance of the tip, and its stress at the same time, from where they belong."""
    assert result.status != "failed", result.reason
    return max(np.abs(result[f"arm.tip.{x}"] - exact[f"arm.tip.{x}"]).max() for x in "xy")


@pytest.mark.by_turns(4)
@pytest.mark.slow
@pytest.mark.parametrize("method", METHODS.names)
def test_every_method_moves_the_tip_alike(model, exact, method):
    default = INTEGRATORS.get(METHODS.get(method).default_integrator)
    settings = {"rtol": 1e-11, "atol": 1e-13} if default.adaptive else {"step": 5e-6}
    result = model.simulate(method=method, max_energy_error=10.0, verify=False, **settings)
    assert distance(result, exact) < LOOSE.get(method, 1e-8)


@pytest.mark.slow
@pytest.mark.parametrize("integrator", INTEGRATORS.names)
def test_every_integrator_moves_the_tip_alike(model, exact, integrator):
    kind = INTEGRATORS.get(integrator)
    method = next(m for m in ("lagrange", *METHODS.names) if set(METHODS.get(m).forms) & set(kind.forms))
    settings = {"rtol": 1e-11, "atol": 1e-13} if kind.adaptive else {"step": 0.02 / 4**6 if kind.order < 3 else 5e-6}
    result = model.simulate(method=method, integrator=integrator, max_energy_error=10.0, verify=False, **settings)
    assert distance(result, exact) < max(LOOSE.get(method, 1e-8), 1e-4 if kind.order < 3 else 0.0)

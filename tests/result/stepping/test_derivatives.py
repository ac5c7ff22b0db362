"""Derivatives of steps beside differences of the same steps."""

from dataclasses import replace

import numpy as np
import pytest

from symgen.api import Model, load
from symgen.base.errors import InputError
from symgen.describe.files.builder import MechanismBuilder
from symgen.run.layout import abi

WEIGHTS = {1: 3 / 4, 2: -3 / 20, 3: 1 / 60}


def difference(of, h=1e-4):
    return sum(w / h * (of(k * h) - of(-k * h)) for k, w in WEIGHTS.items())


def ways(f, y):
    """Changes of a state that leave rows and the lengths of Euler parameters as they are, one a column."""
    nq = len(f.coordinates)
    spun = [i for i, x in enumerate(f.coordinates) if x.name.endswith((".e0", ".e1", ".e2", ".e3"))]

    def held(x):
        q, v = x[:nq], x[nq:]
        lengths = (q[spun] ** 2).reshape(-1, 4).sum(axis=1)
        return np.r_[f.violation(q), f.constraint_jacobian(q) @ v - f.nu(q), lengths]

    slopes = np.column_stack([difference(lambda h, e=e: held(y + h * e)) for e in np.eye(len(y))])
    _, sizes, rows = np.linalg.svd(slopes)
    return rows[np.count_nonzero(sizes > 1e-8 * max(1.0, sizes.max(initial=0.0))) :].T


def cart() -> Model:
    """A pendulum on a driven cart, with a spring, a damper and outputs."""
    builder = (
        MechanismBuilder("cart", gravity=(0.0, -9.81))
        .input("push", 0.3, unit="N")
        .parameter("m", 0.4, unit="kg")
        .body("cart", mass=1.0, inertia=0.1, points={"pin": (0.0, 0.1)}, velocity=(0.2, 0.0))
        .body("pole", mass="m", inertia=0.02, points={"pin": (0.0, -0.5)}, position=(0.0, 0.6), angle=0.1)
        .joint("rail", "translational", between=("ground", "cart"), at=((0.0, 0.0), (0.0, 0.0)), axis=(1.0, 0.0))
        .joint("pin", "revolute", between=("cart", "pole"), at=("pin", "pin"))
        .force("motor", "force", body="cart", at=(0.0, 0.0), force=("push*(1 + 0.1*push)", "0"))
        .force(
            "spring",
            "spring-damper",
            between=("ground", "cart"),
            at=((-2.0, 0.0), (0.0, 0.0)),
            stiffness=3,
            damping=0.2,
        )
        .output("height", "pole.y + 0.1*pole.omega**2", unit="m")
        .output("felt", "cart.ax", unit="m/s^2")
    )
    return Model(builder.build())


CASES = {
    "rk4 in joint coordinates": (cart, {"coordinates": "joint", "integrator": "rk4", "step": 1e-2}, 2e-2),
    "rk4 in those of bodies": (cart, {"coordinates": "absolute", "integrator": "rk4", "step": 1e-2}, 1e-2),
    "baumgarte": (cart, {"method": "baumgarte", "integrator": "heun", "step": 1e-2}, 1e-2),
    "steps by calls": (cart, {"coordinates": "joint", "integrator": "euler"}, 1e-3),
}
LONGER = {
    "a loop": (lambda: load("four-bar"), {"coordinates": "joint", "integrator": "rk4", "step": 1e-3}, 1e-3),
    "bodies of a loop": (
        lambda: load("slider-crank"),
        {"coordinates": "absolute", "integrator": "rk4", "step": 1e-3},
        1e-3,
    ),
    "space": (lambda: load("bricard"), {"coordinates": "joint", "integrator": "rk4", "step": 1e-3}, 1e-3),
    "Euler parameters": (lambda: load("heavy-top"), {"coordinates": "joint", "integrator": "rk4", "step": 1e-3}, 1e-3),
    "dop853": (cart, {"coordinates": "joint", "integrator": "dop853", "step": 1e-2}, 1e-2),
}


@pytest.mark.slow
@pytest.mark.parametrize("name", [*CASES, *LONGER])
def test_derivatives_of_a_step_are_those_of_differences(name):
    make, settings, dt = {**CASES, **LONGER}[name]
    model = make()
    run = model.start(**settings, max_violation=1e6, max_energy_error=1e6)
    for _ in range(3):
        run.step(dt)
    saved = run.save()
    run.step(dt)
    found = run.derivatives()
    assert found.dt == pytest.approx(dt) and found.t == pytest.approx(3 * dt)
    n = len(found.states)
    assert found.states == (*run.state.names, *run.states.names) and found.A.shape == (n, n)

    def after(change=None, u=None):
        arrays = {key: x.copy() for key, x in saved.arrays.items()}
        if change is not None:
            arrays["y"][:n] += change
            arrays["control"][abi.BEGUN] = abi.AFRESH
        run.restore(replace(saved, arrays=arrays))
        run.step(dt, u)
        return np.array(run.state)

    for change in ways(model.functions(settings.get("coordinates", "absolute")), saved.arrays["y"][:n]).T:
        slope = difference(lambda x, change=change: after(x * change))
        assert np.abs(found.A @ change - slope).max() < 1e-8 * max(1.0, np.abs(slope).max())
    for k, of in enumerate(found.inputs):
        now = run.parameters[of]
        slope = difference(lambda x, of=of, now=now: after(None, {of: now + x}))
        assert np.abs(found.B[:, k] - slope).max() < 1e-9
    run.restore(saved)
    if found.outputs:
        assert found.outputs == ("height",) and found.left_out == ("felt",)
        run.step(dt)
        places = {name: i for i, name in enumerate(found.states)}
        assert found.C.shape == (1, n)
        if "pole.y" in places:
            assert found.C[0, places["pole.y"]] == 1.0
        assert found.C[0, places["pole.omega"]] == pytest.approx(0.2 * run.state["pole.omega"], rel=1e-12)


def test_a_linear_prediction_of_a_control_holds():
    run = cart().start(coordinates="joint", integrator="rk4", step=1e-2)
    run.step(1e-2)
    saved = run.save()
    run.step(1e-2)
    found, there = run.derivatives(), np.array(run.state)
    run.restore(saved)
    run.step(1e-2, {"push": 0.3 + 1e-5})
    assert np.abs(np.array(run.state) - there - found.B[:, 0] * 1e-5).max() < 1e-12


def test_a_horizon_is_the_product_of_its_steps():
    run = cart().start(coordinates="joint", integrator="rk4", step=1e-2)
    run.step(1e-2)
    saved, whole = run.save(), np.eye(len(run.state))
    for _ in range(5):
        run.step(1e-2)
        whole = run.derivatives().A @ whole
    run.restore(saved)
    run.step(5e-2)
    assert np.abs(run.derivatives().A - whole).max() < 1e-12


def test_what_has_no_derivatives_is_said():
    run = cart().start(coordinates="joint", integrator="rk4", step=1e-2)
    with pytest.raises(InputError, match="derivatives: expected a step before, got none"):
        run.derivatives()
    run = cart().start(coordinates="joint", integrator="abm4", step=1e-2)
    run.step(1e-2)
    with pytest.raises(InputError, match="derivatives: expected an explicit scheme of one step"):
        run.derivatives()
    run = cart().start(coordinates="joint", integrator="rk4", step=1e-2, stop_when="pole.y < 0.2")
    run.step(1e-2)
    with pytest.raises(InputError, match="derivatives: expected a run without events"):
        run.derivatives()

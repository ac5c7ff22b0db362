"""Derivatives of steps beside differences of the same steps."""

from dataclasses import replace

import numpy as np
import pytest

from symgen.api import Model, load
from symgen.base.errors import InputError
from symgen.base.ir.program import BY_RESIDUAL
from symgen.describe.files.builder import MechanismBuilder
from symgen.run.layout import abi

WEIGHTS = {1: 3 / 4, 2: -3 / 20, 3: 1 / 60}


def difference(of, h=3e-3):
    return sum(w / h * (of(k * h) - of(-k * h)) for k, w in WEIGHTS.items())


def ways(f, y):
    """Changes of a state that leave rows and the lengths of Euler parameters as they are, one a column."""
    nq = len(f.coordinates)
    spun = [i for i, x in enumerate(f.coordinates) if x.name.endswith((".e0", ".e1", ".e2", ".e3"))]

    def held(x):
        q, v = x[:nq], x[nq:]
        lengths = (q[spun] ** 2).reshape(-1, 4).sum(axis=1)
        return np.r_[f.violation(q), f.constraint_jacobian(q) @ v - f.nu(q), lengths]

    slopes = np.column_stack([difference(lambda h, e=e: held(y + h * e), 1e-4) for e in np.eye(len(y))])
    _, sizes, rows = np.linalg.svd(slopes)
    return rows[np.count_nonzero(sizes > 1e-8 * max(1.0, sizes.max(initial=0.0))) :].T


def load_four_bar() -> Model:
    """Return the catalogue's linkage."""
    return load("four-bar")


def cart(push="push*(1 + 0.1*push)") -> Model:
    """A pendulum on a driven cart, with a spring, a damper and outputs."""
    builder = (
        MechanismBuilder("cart", gravity=(0.0, -9.81))
        .input("push", 0.3, unit="N")
        .parameter("m", 0.4, unit="kg")
        .body("cart", mass=1.0, inertia=0.1, points={"pin": (0.0, 0.1)}, velocity=(0.2, 0.0))
        .body("pole", mass="m", inertia=0.02, points={"pin": (0.0, -0.5)}, position=(0.0, 0.6), angle=0.1)
        .joint("rail", "translational", between=("ground", "cart"), at=((0.0, 0.0), (0.0, 0.0)), axis=(1.0, 0.0))
        .joint("pin", "revolute", between=("cart", "pole"), at=("pin", "pin"))
        .force("motor", "force", body="cart", at=(0.0, 0.0), force=(push, "0"))
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


def rubbed(push, v, sliding=2.0, static=3.0, restitution=0.5) -> Model:
    """The same with dry friction and a stop."""
    center, pin = (-0.5 * np.sin(0.1), 0.1 + 0.5 * np.cos(0.1)), {"sliding": 0.02}
    builder = (
        MechanismBuilder("rubbed", gravity=(0.0, -9.81))
        .input("push", push, unit="N")
        .body("cart", mass=1.0, inertia=0.1, points={"pin": (0.0, 0.1)}, velocity=(v, 0.0))
        .body(
            "pole", mass=0.4, inertia=0.02, points={"pin": (0.0, -0.5)}, position=center, velocity=(v, 0.0), angle=0.1
        )
        .joint(
            *("rail", "translational"),
            between=("ground", "cart"),
            at=((0.0, 0.0), (0.0, 0.0)),
            axis=(1.0, 0.0),
            friction={"sliding": sliding, "static": static},
            stop={"upper": 0.02, "restitution": restitution},
        )
        .joint("pin", "revolute", between=("cart", "pole"), at=("pin", "pin"), friction=pin)
        .force("motor", "force", body="cart", at=(0.0, 0.0), force=("push*(1 + 0.1*push)", "0"))
    )
    return Model(builder.build())


def made(model, settings, dt, before=3):
    """Return a run, what it was before its last step, the derivatives of this, and the step from another state."""
    run = model.start(**settings, max_violation=1e6, max_energy_error=1e6)
    for _ in range(before):
        run.step(dt)
    saved = run.save()
    run.step(dt)
    found = run.derivatives()
    n = len(found.states)

    def after(change=None, u=None):
        arrays = {key: x.copy() for key, x in saved.arrays.items()}
        if change is not None:
            arrays["y"][:n] += change
            arrays["control"][abi.BEGUN] = abi.AFRESH
        run.restore(replace(saved, arrays=arrays))
        run.step(dt, u)
        return np.array(run.state)

    return run, saved, found, after


def compare(found, after, changes, inputs, h, tolerance):
    """Compare A along changes, and B, with differences."""
    for change in changes.T:
        slope = difference(lambda x, change=change: after(x * change), h)
        assert np.abs(found.A @ change - slope).max() < tolerance * max(1.0, np.abs(slope).max())
    for k, of in enumerate(found.inputs):
        slope = difference(lambda x, of=of: after(None, {of: inputs[of] + x}), h)
        assert np.abs(found.B[:, k] - slope).max() < tolerance


CASES = {
    "rk4 in joint coordinates": (cart, {"coordinates": "joint", "integrator": "rk4", "step": 1e-2}, 2e-2),
    "rk4 in those of bodies": (cart, {"coordinates": "absolute", "integrator": "rk4", "step": 1e-2}, 1e-2),
    "baumgarte": (cart, {"method": "baumgarte", "integrator": "heun", "step": 1e-2}, 1e-2),
    "steps by calls": (cart, {"coordinates": "joint", "integrator": "euler"}, 1e-3),
    "a loop": (load_four_bar, {"coordinates": "joint", "integrator": "rk4", "step": 1e-3}, 1e-3),
    "bodies of a loop": (
        lambda: load("slider-crank"),
        {"coordinates": "absolute", "integrator": "rk4", "step": 1e-3},
        1e-3,
    ),
    "space": (lambda: load("bricard"), {"coordinates": "joint", "integrator": "rk4", "step": 1e-3}, 1e-3),
    "Euler parameters": (lambda: load("heavy-top"), {"coordinates": "joint", "integrator": "rk4", "step": 1e-3}, 1e-3),
    "dop853": (cart, {"coordinates": "joint", "integrator": "dop853", "step": 1e-2}, 1e-2),
    "radau5": (cart, {"coordinates": "joint", "integrator": "radau5", "step": 1e-2}, 1e-2),
    "radau5 in those of bodies": (load_four_bar, {"coordinates": "absolute", "integrator": "radau5"}, 1e-3),
    "sdirk": (load_four_bar, {"coordinates": "joint", "integrator": "sdirk", "step": 1e-3}, 1e-3),
    "trapezoidal": (cart, {"coordinates": "absolute", "integrator": "trapezoidal", "step": 1e-2}, 1e-2),
    "stabilised index 2": (load_four_bar, {"method": "ggl", "integrator": "radau5", "step": 1e-3}, 1e-3),
    "implicit Euler parameters": (lambda: load("heavy-top"), {"integrator": "trapezoidal", "step": 1e-3}, 1e-3),
}


@pytest.mark.by_turns(4)
@pytest.mark.slow
@pytest.mark.parametrize("name", CASES)
def test_derivatives_of_a_step_are_those_of_differences(name):
    make, settings, dt = CASES[name]
    model = make()
    run, saved, found, after = made(model, settings, dt)
    assert found.dt == pytest.approx(dt) and found.t == pytest.approx(3 * dt) and not found.doubts
    n, inputs = len(found.states), {name: run.parameters[name] for name in found.inputs}
    assert found.states == (*run.state.names, *run.states.names) and found.A.shape == (n, n)
    changes = ways(model.functions(settings.get("coordinates", "absolute")), saved.arrays["y"][:n])
    compare(found, after, changes, inputs, 3e-3, 1e-10)
    run.restore(saved)
    if found.outputs:
        assert found.outputs == ("height",) and found.left_out == ("felt",)
        run.step(dt)
        places = {name: i for i, name in enumerate(found.states)}
        assert found.C.shape == (1, n)
        if "pole.y" in places:
            assert found.C[0, places["pole.y"]] == 1.0
        assert found.C[0, places["pole.omega"]] == pytest.approx(0.2 * run.state["pole.omega"], rel=1e-12)


RAIL = {"joint": ("rail.displacement", "rail.displacement.rate"), "absolute": ("cart.x", "cart.vx")}
#: What the cart does in a step, the steps before it, and its events.
EVENTS = {
    "comes to rest": (dict(push=1.0, v=0.05), 8, {"rail.stick"}, False),
    "is struck": (dict(push=5.0, v=0.3), 4, {"rail.upper.hit", "rail.reverse", "pin.reverse"}, False),
    "is struck and rests": (
        dict(push=5.0, v=0.3, restitution=0.0),
        4,
        {"rail.upper.hit", "rail.stick", "rail.upper.rest", "pin.reverse"},
        False,
    ),
    "turns back": (dict(push=5.0, v=0.3), 7, {"rail.reverse"}, False),
    "rests": (dict(push=0.5, v=0.0), 2, set(), True),
}


@pytest.mark.by_turns(4)
@pytest.mark.slow
@pytest.mark.parametrize("name", EVENTS)
@pytest.mark.parametrize("scheme", ["rk4", "radau5"])
@pytest.mark.parametrize("coordinates", ["joint", "absolute"])
def test_derivatives_go_through_modes_and_impacts(name, scheme, coordinates):
    numbers, before, events, rests = EVENTS[name]
    model, settings = rubbed(**numbers), {"coordinates": coordinates, "integrator": scheme, "step": 1e-2}
    run, saved, found, after = made(model, settings, 1e-2, before)
    assert {event.name for event in run.events if event.t > before * 1e-2} == events
    changes = ways(model.functions(coordinates), saved.arrays["y"][: len(found.states)])
    if rests:
        held = [found.states.index(x) for x in RAIL[coordinates]]
        assert found.A[held[0], held[0]] == pytest.approx(1.0) and abs(found.A[held[1], held[1]]) < 1e-12
        _, sizes, rows = np.linalg.svd(changes[held])
        changes = changes @ rows[np.count_nonzero(sizes > 1e-9) :].T
    compare(found, after, changes, {"push": numbers["push"]}, 1e-5, 3e-10)


@pytest.mark.slow
def test_a_step_in_which_friction_stops_the_cart_has_its_derivatives():
    run, _, found, after = made(rubbed(1.0, 0.05), {"coordinates": "joint", "integrator": "rk4", "step": 1e-2}, 1e-2, 8)
    assert [event.name for event in run.events] == ["rail.stick"] and not found.doubts
    slope = difference(lambda x: after(None, {"push": 1.0 + x}), 1e-5)
    assert np.abs(found.B[:, 0] - slope).max() < 1e-10
    slope = difference(lambda x: after(np.array([0.0, 0.0, x, 0.0])), 1e-5)
    assert np.abs(found.A[:, 2] - slope).max() < 1e-10 and abs(found.A[0, 2]) > 1e-3 > abs(found.A[2, 2])


def test_an_implicit_step_has_its_derivatives():
    _, _, found, after = made(cart(), {"coordinates": "joint", "integrator": "trapezoidal", "step": 1e-2}, 1e-2, 1)
    compare(found, after, np.eye(4), {"push": 0.3}, 3e-3, 1e-11)


@pytest.mark.slow_cases("stopped")
@pytest.mark.parametrize("name", ["smooth", "stopped"])
def test_a_step_that_is_made_in_pieces_has_the_derivatives_of_the_whole(name):
    model, h = (cart(), 3e-3) if name == "smooth" else (rubbed(1.0, 0.05), 1e-5)
    run, _, found, after = made(model, {"coordinates": "joint", "integrator": "rk4", "step": 1e-3}, 0.25, 0)
    assert found.t == 0.0 and found.dt == 0.25 and bool(run.events) == (name == "stopped")
    push = run.parameters["push"]
    slope = difference(lambda x: after(None, {"push": push + x}), h)
    assert np.abs(found.B[:, 0] - slope).max() < 1e-9 < 1e-4 < np.abs(slope).max()


@pytest.mark.slow
def test_an_adaptive_run_has_derivatives_of_its_steps():
    run = cart().start(coordinates="joint", integrator="dop853", rtol=1e-12, atol=1e-12)
    run.step(0.1)
    saved, now = run.save(), np.array(run.state)
    run.step(0.1)
    found, end = run.derivatives(), np.array(run.state)
    run.reset({"rail.displacement": now[0], "pole.theta": now[1], "cart.vx": now[2] + 1e-6, "pole.omega": now[3]})
    assert saved.t == found.t == pytest.approx(0.1)
    run.step(0.1)
    assert np.abs(np.array(run.state) - end - 1e-6 * found.A[:, 2]).max() < 1e-10


@pytest.mark.slow_cases("load_four_bar")
@pytest.mark.parametrize("make", [load_four_bar, cart])
def test_derivatives_of_explicit_steps_leave_the_factorisation_undifferentiated(make):
    # a cart computes other numbers of its parameters in that code: they stand behind those of the run
    run = make().start(coordinates="joint", integrator="rk4", step=1e-2)
    run.step(1e-2)
    run.derivatives()
    assert hasattr(run._directions._model.plain.law_module, BY_RESIDUAL)
    assert not hasattr(run._prepared.compiled.law_module, BY_RESIDUAL)


def test_a_linear_prediction_of_a_control_holds():
    run = cart().start(coordinates="joint", integrator="rk4", step=1e-2)
    run.step(1e-2)
    saved = run.save()
    run.step(1e-2)
    found, there = run.derivatives(), np.array(run.state)
    run.restore(saved)
    run.step(1e-2, {"push": 0.3 + 1e-5})
    assert np.abs(np.array(run.state) - there - found.B[:, 0] * 1e-5).max() < 1e-12


HORIZONS = {
    "one call": (cart, {"coordinates": "joint", "integrator": "rk4", "step": 5e-3}),
    "steps by calls": (cart, {"coordinates": "joint", "integrator": "rk4"}),
    "events": (lambda: rubbed(1.0, 0.05), {"coordinates": "joint", "integrator": "rk4", "step": 1e-2}),
}


@pytest.mark.slow_cases("events")
@pytest.mark.parametrize("name", HORIZONS)
def test_a_horizon_has_the_steps_and_the_derivatives_of_calls_one_by_one(name):
    make, settings = HORIZONS[name]
    run, pushes = make().start(**settings), [1.0, 1.1, 0.9, 0.8]
    run.step(6e-2)
    now = run.save()
    ahead = run.horizon({"push": pushes}, 1e-2)
    same = run.horizon([[push] for push in pushes], 1e-2)
    assert run.t == now.t and np.array_equal(ahead.x, same.x) and ahead.states == run.state.names
    for k, push in enumerate(pushes):
        assert np.array_equal(ahead.x[k], run.state) and ahead.t[k] == pytest.approx(run.t)
        run.step(1e-2, {"push": push})
        found = run.derivatives()
        for one, own in zip(found[:3], (ahead.A[k], ahead.B[k], ahead.C[k]), strict=True):
            assert np.abs(one - own).max(initial=0.0) < 1e-13
    assert np.array_equal(ahead.x[-1], run.state) and ahead.outputs == found.outputs
    assert bool(run.events) == (name == "events")


def test_a_horizon_wants_inputs_of_each_step():
    run = cart().start(coordinates="joint", integrator="rk4", step=1e-2)
    with pytest.raises(InputError, match=r"horizon: expected inputs of shape \(steps, 1\), of push, got shape \(3,\)"):
        run.horizon([1.0, 2.0, 3.0], 1e-2)
    with pytest.raises(
        InputError, match=r"horizon: expected an input that is a number in this run, got 'pusch'.*'push'"
    ):
        run.horizon({"pusch": [1.0]}, 1e-2)
    with pytest.raises(InputError, match="horizon: 'push': expected finite numbers"):
        run.horizon({"push": [np.nan]}, 1e-2)
    run = rubbed(1.0, 0.05).start(coordinates="joint", integrator="rk4", step=1e-2)
    run.every(0.1, lambda t, sim: None)
    with pytest.raises(InputError, match="horizon: expected a run without controllers, as its steps have events"):
        run.horizon({"push": [1.0]}, 1e-2)


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
    with pytest.raises(InputError, match=r"a scheme whose steps have derivatives .*, got 'abm4'"):
        run.derivatives()
    run = cart("push*sign(cart.x - 0.1)").start(coordinates="joint", integrator="rk4", step=1e-2)
    run.step(1e-2)
    with pytest.raises(InputError, match="derivatives: expected a run without jumps of formulas"):
        run.derivatives()

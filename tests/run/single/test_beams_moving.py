"""Beams in motion: a pendulum that waves, a spin-up, a free beam; references by elements of order 8."""

import numpy as np
import pytest
from support.beams import cantilever

import symgen
from symgen.describe.files.builder import MechanismBuilder

ALPHA = {"method": "generalized-alpha", "integrator": "generalized-alpha", "shape": "looped"}
ADAPTIVE = {**ALPHA, "options": {"integrator.adaptive": "true"}}
#: Tip of the pendulum at some times, to 1e-6.
PENDULUM = {0.25: (0.910216, -0.363034), 0.5: (-0.105566, -0.994868), 1.0: (-0.992238, 0.043055)}
#: Stretch and deflection of the tip of the beam that spins up (Simo, Vu-Quoc 1986), to 1e-6.
SPIN_UP = {
    2.0: (-0.0006059, -0.1023806),
    4.0: (-0.0067660, -0.3422787),
    6.5: (-0.0186034, -0.5699484),
    8.0: (-0.0166299, -0.5428415),
    10.0: (-0.0070723, -0.3628145),
    15.0: (0.0005140, 0.0013036),
}


def pendulum(elements):
    pin = {"type": "revolute", "between": ["ground", "rod"], "at": [[0.0, 0.0], "start"]}
    keys = {"axial": 1e4, "shear": 5e3, "bending": 0.5, "rotary": 5e-5, "clamp": "", "gravity": (0.0, -9.81)}
    return cantilever(elements, joints={"pin": pin}, **keys)


def spin_up(elements):
    builder = MechanismBuilder("spin-up").body("hub", mass=1.0, inertia=1.0)
    stiff = {"axial": 2.8e7, "shear": 1e7, "bending": 1.4e4, "mass": 1.2, "rotary": 6e-4}
    builder.beam("rod", start=(0, 0), end=(10, 0), elements=elements, clamp="hub", **stiff)
    builder.joint("pin", "revolute", between=("ground", "hub"), at=((0, 0), (0, 0)))
    turn = "0.4*(t**2/2 + (7.5/pi)**2*(cos(2*pi*t/15) - 1)) if t < 15 else 6*t - 45"
    builder.joint("motor", "driver", joint="pin", value=turn)
    builder.output("u", "cos(hub.theta)*rod.end.x + sin(hub.theta)*rod.end.y - 10")
    builder.output("w", "-sin(hub.theta)*rod.end.x + cos(hub.theta)*rod.end.y")
    return symgen.Model(builder.build())


def furthest(run, columns, expected):
    """Return the largest distance of a pair of columns from points at some times."""
    rows = [int(np.argmin(np.abs(run.t - t))) for t in expected]
    return max(
        np.hypot(*(np.array([c[i] for c in columns]) - at)) for i, at in zip(rows, expected.values(), strict=True)
    )


@pytest.mark.slow
def test_pendulum_of_a_beam_with_constant_and_adaptive_steps():
    model = pendulum(16)
    tip = "rod.end.x", "rod.end.y"
    runs = {
        "constant": (model.simulate(until=1.0, step=1e-3, output_step=0.25, **ALPHA), 1e-4),
        "adaptive": (model.simulate(until=1.0, rtol=1e-4, atol=1e-6, output_step=0.25, **ADAPTIVE), 1e-4),
    }
    for name, (run, bound) in runs.items():
        assert run.status == "ok", name
        # the discretisation is off by 6e-5: a pin that is let go sends waves of all lengths
        assert furthest(run, [run.q[c] for c in tip], PENDULUM) <= bound, name
    assert runs["adaptive"][0].rejected < runs["adaptive"][0].steps


@pytest.mark.slow
def test_adaptive_steps_follow_the_tolerance():
    """Errors against a run with a tolerance a hundred times smaller fall by about the tolerance."""
    model = pendulum(8)
    ends = [model.simulate(until=0.3, rtol=r, atol=0.01 * r, times=[0.3], **ADAPTIVE) for r in (1e-3, 1e-4, 1e-6)]
    tips = np.array([[run.q["rod.end.x"][-1], run.q["rod.end.y"][-1]] for run in ends])
    errors = np.linalg.norm(tips[:2] - tips[2], axis=1)
    assert errors[0] <= 1e-3 and errors[1] <= 0.2 * errors[0]
    assert ends[0].steps < ends[1].steps < ends[2].steps


@pytest.mark.slow
def test_beam_spins_up():
    run = spin_up(8).simulate(until=15.0, step=4e-3, output_step=0.5, **ALPHA)
    assert furthest(run, [run.outputs["u"], run.outputs["w"]], SPIN_UP) <= 1e-4


@pytest.mark.slow
def test_beam_spins_up_to_a_steady_stretch():
    model = spin_up(16)
    run = model.simulate(until=15.0, step=5e-4, output_step=0.5, **ALPHA)
    assert furthest(run, [run.outputs["u"], run.outputs["w"]], SPIN_UP) <= 1e-5
    steady = model.simulate(until=30.0, step=1e-2, output_step=0.01, options={"integrator.rho": 0.5}, **ALPHA)
    # tan(k L)/k - L with k^2 = rho A Omega^2 / E A
    assert abs(steady.outputs["u"][steady.t > 20.0].mean() - 5.143174550434e-4) <= 2e-7


def spaghetti(elements):
    """Return the free beam of Simo and Vu-Quoc (1986): from (6, 0) to (0, 8), pushed and turned at its lower end."""
    stiff = {"axial": 1e4, "shear": 1e4, "bending": 100.0, "mass": 1.0, "rotary": 10.0}
    builder = MechanismBuilder("spaghetti").beam("rod", start=(6, 0), end=(0, 8), elements=elements, **stiff)
    builder.force("push", "force", body="rod", at="start", force=("8 if t < 2.5 else 0", 0.0))
    builder.force("turn", "torque", body="rod.start", torque="-80 if t < 2.5 else 0")
    return symgen.Model(builder.build())


@pytest.mark.slow
def test_free_beam_flies_as_its_centre_of_mass_does():
    model = spaghetti(64)
    run = model.simulate(
        until=10.0, shape="looped", method="lagrange", integrator="dop853", rtol=1e-10, atol=1e-12, output_step=0.5
    )
    assert run.status == "ok"
    names = [body.name for body in model.mechanism.bodies]
    masses = np.array([body.mass.value for body in model.mechanism.bodies])
    inertias = np.array([body.inertia.value for body in model.mechanism.bodies])
    assert abs(masses.sum() - 10.0) <= 1e-13
    centre = np.array(
        [[masses @ [run.q[f"{n}.{c}"][k] for n in names] / 10.0 for c in "xy"] for k in range(len(run.t))]
    )
    for t, at in {2.5: (5.5, 4.0), 5.0: (10.5, 4.0), 10.0: (20.5, 4.0)}.items():
        np.testing.assert_allclose(centre[np.argmin(np.abs(run.t - t))], at, atol=1e-10)
    x, y = (np.array([run.q[f"{n}.{c}"] for n in names]) for c in "xy")
    vx, vy, spin = (np.array([run.v[f"{n}.{c}"] for n in names]) for c in ("vx", "vy", "omega"))
    free = run.t >= 2.5
    momentum = (masses @ (x * vy - y * vx) + inertias @ spin)[free]
    assert np.ptp(momentum) <= 1e-9 * np.abs(momentum).max()
    energy = run.kinetic + run.potential
    assert np.ptp(energy[free]) <= 1e-7 * energy.max()
    ends = {("start", 2.5): (4.963, 4.476), ("start", 5.0): (9.784, 8.204), ("end", 5.0): (8.074, 1.759)}
    for (node, t), at in ends.items():
        k = np.argmin(np.abs(run.t - t))
        found = run.q[f"rod.{node}.x"][k], run.q[f"rod.{node}.y"][k]
        np.testing.assert_allclose(found, at, atol=1e-2)


@pytest.mark.slow_cases("spatial")
@pytest.mark.parametrize("space", ["planar", "spatial"])
def test_a_load_by_length_acts_on_clamped_ends_too(space):
    """A free body with a beam clamped to it: momentum is load times length times time."""
    pad = (0.0,) if space == "spatial" else ()
    stiff = {"axial": 1e3, "bending": 1.0, "mass": 1.2, "rotary": (1e-2, 1e-2, 1e-2) if pad else 1e-2}
    stiff |= {"torsion": 1.0} if pad else {}
    builder = MechanismBuilder("free", space=space).body("hub", mass=2.0, inertia=(0.1, 0.2, 0.3) if pad else 0.3)
    load = ("0.5 + 0*x", "-1.5*cos(0*y)", *("0.7" for _ in pad))
    builder.beam("rod", start=(0.2, 0.1, *pad), end=(1.0, 0.7, *pad), elements=5, clamp="hub", load=load, **stiff)
    model = symgen.Model(builder.build())
    run = model.simulate(until=0.1, step=1e-3, method="lagrange", integrator="rk4", times=[0.1])
    masses = {body.name: body.mass.value for body in model.mechanism.bodies}
    assert abs(sum(masses.values()) - 3.2) <= 1e-14
    for c, expected in zip("xyz", (0.5, -1.5, 0.7)[: len(load)], strict=False):
        assert abs(sum(m * run.v[f"{name}.v{c}"][-1] for name, m in masses.items()) - 0.1 * expected) <= 1e-10

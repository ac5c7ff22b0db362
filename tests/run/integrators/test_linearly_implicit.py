"""Rodas and HHT beside versions in NumPy that share no code, closed forms and SciPy; and what is stiff."""

import numpy as np
import pytest
from support.emitted import mechanism_of

import symgen

CONSTANT = {"integrator.adaptive": "false"}
LENGTH, MASS, INERTIA, STIFFNESS = 0.7, 2.0, 0.3, 900.0
#: A rod on a pin, with a spring to a point that moves like t^2, of which a difference of second order is exact.
ROD = {
    "mechanism": {"name": "rod", "gravity": [0.0, -9.81]},
    "bodies": {
        "rod": {
            "mass": MASS,
            "inertia": INERTIA,
            "position": [LENGTH, 0.0],
            "points": {"P": [-LENGTH, 0.0]},
        }
    },
    "joints": {"pin": {"type": "revolute", "between": ["ground", "rod"], "at": [[0.0, 0.0], "P"]}},
    "forces": {"pull": {"type": "force", "body": "rod", "force": [f"{STIFFNESS}*(2*t**2 - rod.x)", 0.0]}},
}
NAMES = ["rod.x", "rod.y", "rod.theta", "rod.vx", "rod.vy", "rod.omega"]
M = np.diag([MASS, MASS, INERTIA])


def rows(q):
    return np.array([[1.0, 0.0, LENGTH * np.sin(q[2])], [0.0, 1.0, -LENGTH * np.cos(q[2])]])


def open_by(q):
    return np.array([q[0] - LENGTH * np.cos(q[2]), q[1] - LENGTH * np.sin(q[2])])


def forces(t, q):
    return np.array([STIFFNESS * (2.0 * t**2 - q[0]), -9.81 * MASS, 0.0 * q[2]])


def towards(q, v):
    return -LENGTH * v[2] ** 2 * np.array([np.cos(q[2]), np.sin(q[2])])


def law(t, q, v):
    matrix = np.block([[M, rows(q).T], [rows(q), np.zeros((2, 2))]])
    return np.linalg.solve(matrix, np.concatenate([forces(t, q), towards(q, v)]))


def descriptor(t, y, k):
    q, v = y[:3], y[3:]
    balance = M @ k[3:6] + rows(q).T @ k[6:] - forces(t, q)
    return np.concatenate([k[:3] - v, balance, rows(q) @ k[3:6] - towards(q, v)])


def derivative(f, x, e=1e-30):
    """By complex steps: exact to rounding."""
    return np.column_stack([f(x + 1j * e * column).imag / e for column in np.eye(len(x))])


def rodas(t, y, h):
    """Hairer and Wanner's program, for the matrix diag(1, 0) before the rates of y and of k."""
    a = np.zeros((6, 6))
    a[1, 0], a[2, :2] = 1.544, (0.9466785280815826, 0.2557011698983284)
    a[3, :3] = 3.314825187068521, 2.896124015972201, 0.9986419139977817
    a[4, :4] = 1.221224509226641, 6.019134481288629, 12.53708332932087, -0.6878860361058950
    a[5, :5] = *a[4, :4], 1.0
    c = np.zeros((6, 6))
    c[1, 0], c[2, :2] = -5.6688, (-2.430093356833875, -0.2063599157091915)
    c[3, :3] = -0.1073529058151375, -9.594562251023355, -20.47028614809616
    c[4, :4] = 7.496443313967647, -10.24680431464352, -33.99990352819905, 11.70890893206160
    c[5, :5] = 8.083246795921522, -7.981132988064893, -31.52159432874371, 16.31930543123136, -6.058818238834054
    nodes, drifts = (0.0, 0.386, 0.21, 0.63, 1.0, 1.0), (0.25, -0.1043, 0.1035, -0.0362, 0.0, 0.0)
    x = np.concatenate([y, y[3:], law(t, y[:3], y[3:])])
    mass = np.diag([1.0] * 6 + [0.0] * 8)

    def right(t, x):
        return np.concatenate([x[6:12], -descriptor(t, x[:6], x[6:])])

    matrix = mass / (0.25 * h) - derivative(lambda z: right(t, z), x)
    drift = derivative(lambda z: right(z[0], x.astype(complex)), np.array([t]))[:, 0]
    u = np.zeros((6, 14))
    for i in range(6):
        rest = right(t + nodes[i] * h, x + a[i] @ u) + mass @ (c[i] @ u) / h + drifts[i] * h * drift
        u[i] = np.linalg.solve(matrix, rest)
    return (x + a[5] @ u + u[5])[:6]


def hht(t, y, h, alpha, a, rate):
    """Negrut and others: M a1 = (1 + alpha) R1 - alpha R0 with R = f - D^T lambda, and Phi = 0 at the end."""
    q, v, gamma, beta = y[:3], y[3:], 0.5 - alpha, 0.25 * (1.0 - alpha) ** 2
    z = np.concatenate([a, law(t, q, v)[3:]])

    def end(x):
        return q + h * v + h**2 * ((0.5 - beta) * a + beta * x[:3])

    def residual(x):
        now = forces(t + h, end(x)) - rows(end(x)).T @ x[3:]
        return np.concatenate([M @ x[:3] - (1.0 + alpha) * now + alpha * M @ rate, open_by(end(x)) / h**2])

    for _ in range(8):
        z = z - np.linalg.solve(derivative(residual, z), residual(z))
    new = forces(t + h, end(z)) - rows(end(z)).T @ z[3:]
    return (
        np.concatenate([end(z), v + h * ((1.0 - gamma) * a + gamma * z[:3])]),
        z[:3],
        np.linalg.solve(M, new),
    )


START = np.array([LENGTH, 0.0, 0.0, 0.0, 0.0, 0.0])


def by_run(integrator, step, steps, **keys):
    limits = {"max_violation": 1.0, "max_energy_error": 1e3}
    result = symgen.load(mechanism_of(ROD)).simulate(
        integrator=integrator, step=step, until=steps * step, coordinates="absolute", **limits, **keys
    )
    return np.array([result[name][-1] for name in NAMES])


def test_rodas_beside_numpy():
    y, h = START, 0.01
    for i in range(20):
        y = rodas(i * h, y, h)
    np.testing.assert_allclose(by_run("rodas", h, 20, method="lagrange", options=CONSTANT), y, rtol=0.0, atol=1e-12)


@pytest.mark.parametrize("alpha", [-0.3, -0.05])
def test_hht_beside_numpy(alpha):
    h, y = 0.01, START
    rate, probe = law(0.0, y[:3], y[3:])[:3], 1e-4 * h
    ahead = law(probe, y[:3] + probe * y[3:], y[3:] + probe * rate)[:3]
    a = rate + alpha * h * (ahead - rate) / probe
    for i in range(20):
        y, a, rate = hht(i * h, y, h, alpha, a, rate)
    found = by_run("hht", h, 20, method="generalized-alpha", options={"integrator.alpha": alpha})
    np.testing.assert_allclose(found, y, rtol=0.0, atol=1e-12)


#: A mass between a spring and a damper, which pass from a vibration to a decay of 1e8/s.
DAMPED = {
    "mechanism": {"name": "damped"},
    "parameters": {"c": {"value": 1.0, "unit": "N*s/m"}},
    "bodies": {"p": {"type": "point", "mass": 1.0, "position": [1.0, 0.0]}},
    "joints": {"line": {"type": "rows", "rows": [{"position": "p.y", "label": "y"}]}},
    "forces": {"pull": {"type": "force", "body": "p", "force": ["-100*p.x - c*p.vx", 0.0]}},
}


def decayed(c, t):
    """x of x'' + c x' + 100 x = 0 from 1 m at rest; the small root without a difference of large numbers."""
    root = np.sqrt(complex(c * c - 400.0))
    one = -0.5 * (c + root)
    other = 100.0 / one
    return ((one * np.exp(other * t) - other * np.exp(one * t)) / (one - other)).real


@pytest.mark.slow
def test_dampers_of_three_hundred_sizes():
    """From a vibration to stiffness: errors are of the tolerance's size and change as dampers do; steps do not grow."""
    model, sizes = symgen.load(mechanism_of(DAMPED)), np.geomspace(1.01, 1e8, 300)
    errors, steps = [], []
    for c in sizes:
        run = model.simulate(integrator="rodas", rtol=1e-8, until=0.5, parameters={"c": c}, verify=False)
        assert run.status == "ok", (c, run.reason)
        errors.append(abs(run["p.x"][-1] - decayed(c, 0.5)))
        steps.append(run.steps)
    assert max(errors) < 1e-6 and max(steps) < 1500
    jumps = np.abs(np.diff(steps)) / np.maximum(steps[1:], steps[:-1])
    assert np.median(jumps) < 0.05 and steps[-1] < 200, (np.median(jumps), steps[-1])


@pytest.mark.slow
@pytest.mark.parametrize(("k", "rtol"), [(1e10, 1e-6), (1e12, 1e-6)])
def test_a_stiff_spring_does_no_work_between_steps(k, rtol):
    """A point is pulled behind sin(t): its work is that of its motion, whatever a polynomial leaves of the spring."""
    follower = {
        "mechanism": {"name": "follower"},
        "parameters": {"k": k},
        "bodies": {"p": {"type": "point", "mass": 1.0, "position": [1.0, 0.0], "velocity": ["k/(k - 1)", 0.0]}},
        "forces": {"spring": {"type": "force", "body": "p", "force": ["-k*(p.x - 1 - sin(t))", 0.0]}},
    }
    run = symgen.load(mechanism_of(follower)).simulate(integrator="rodas", rtol=rtol, until=1.0, verify=False)
    assert run.status == "ok", run.reason
    np.testing.assert_allclose(run["p.x"], 1.0 + k * np.sin(run.t) / (k - 1.0), rtol=0.0, atol=1e-10)
    assert abs(run.work[-1] + 0.5 * np.sin(1.0) ** 2) < 0.05 * 0.5  # kinetic energy falls from 1/2 to cos(1)^2 / 2


def test_the_steps_before_are_no_derivatives():
    """Directions inside a step are those of tableaus; others are refused with their names."""
    run = symgen.load("four-bar").start(integrator="rodas", step=1e-2, options=CONSTANT)
    run.step(1e-2)
    with pytest.raises(symgen.InputError, match="rodas"):
        run.derivatives()

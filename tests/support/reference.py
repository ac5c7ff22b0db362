"""Numbers that emitted code has to meet, from `Plain` alone, by complex steps and high-precision differences."""

import cmath

import mpmath
import numpy as np

from support.plain import STEP, Plain, cross, dot


def row_names(plain: Plain, t, q, v) -> list[str]:
    """Names of all rows in the order of the file."""
    names = []
    held, slips = plain.phi(t, q), plain.slips(t, q, v)
    for joint in plain.raw.get("joints", {}):
        names += [n for n in (*held, *slips) if n.partition(".")[0] == joint]
    return names


def velocity_residual(plain: Plain, t, q, v) -> dict:
    """D v - nu: the rate of Phi along the motion by a complex step, and the nonholonomic residuals."""
    c = plain.using(cmath)
    moved = c.phi(t + STEP * 1j, [a + STEP * 1j * b for a, b in zip(q, v, strict=True)])
    return {n: complex(x).imag / STEP for n, x in moved.items()} | plain.slips(t, q, v)


def jacobian(plain: Plain, t, q, v) -> dict[str, np.ndarray]:
    """Rows of D: the gradient of Phi by complex steps; of nonholonomic conditions, by velocities."""
    c, rows = plain.using(cmath), {n: np.zeros(plain.size) for n in row_names(plain, t, q, v)}
    for j in range(plain.size):
        step = [STEP * 1j if i == j else 0.0 for i in range(plain.size)]
        for n, x in c.phi(t, [a + b for a, b in zip(q, step, strict=True)]).items():
            rows[n][j] = complex(x).imag / STEP
        for n, x in c.slips(t, q, [a + b for a, b in zip(v, step, strict=True)]).items():
            rows[n][j] = complex(x).imag / STEP
    return rows


def nu(plain: Plain, t, q) -> dict[str, float]:
    """-Phi_t by a complex step; of nonholonomic conditions what is left of them at rest."""
    still = {n: -x for n, x in plain.slips(t, q, [0.0] * plain.size).items()}
    return still | {n: -complex(x).imag / STEP for n, x in plain.using(cmath).phi(t + STEP * 1j, q).items()}


def gamma(plain: Plain, t, q, v) -> dict[str, float]:
    """-Phi'' and -(slip)' along the motion of constant velocities, by differences with 80 digits."""
    with mpmath.workdps(80):
        m, h = plain.using(mpmath), mpmath.mpf(10) ** -20

        def at(k):
            tau = k * h
            moved = [mpmath.mpf(a) + tau * mpmath.mpf(b) for a, b in zip(q, v, strict=True)]
            return m.phi(t + tau, moved), m.slips(t + tau, moved, v)

        (phi_0, _), (phi_1, slip_1), (phi_2, slip_2) = at(0), at(1), at(-1)
        found = {n: -(phi_1[n] - 2 * phi_0[n] + phi_2[n]) / h**2 for n in phi_0}
        found |= {n: -(slip_1[n] - slip_2[n]) / (2 * h) for n in slip_1}
        return {n: float(x) for n, x in found.items()}


def applied(plain: Plain, t, q, v) -> tuple[np.ndarray, float]:
    """f by virtual power, force by force, with gravity; and the power of the loads that have no potential."""
    f, power = np.zeros(plain.size), 0.0
    gravity = plain.pair(plain.raw["mechanism"].get("gravity", (0.0, 0.0)))
    for body, keys in plain.bodies.items():
        i, mass = plain.first[body], plain.number(keys["mass"])
        f[i] += mass * gravity[0]
        f[i + 1] += mass * gravity[1]
    for body, force, torque, at, conservative in plain.loads(t, q, v):
        if body == "ground":
            continue
        i = plain.first[body]
        f[i : i + 2] += force
        if plain.turns(body):
            f[i + 2] += torque + cross(plain.arm(body, at, q), force)
        if not conservative:
            power += dot(force, plain.velocity(body, at, q, v)) + torque * plain.spin(body, v)
    return f, power


def conservative_part(plain: Plain, q) -> np.ndarray:
    """-grad of the potential energy by complex steps."""
    c, gradient = plain.using(cmath), np.zeros(plain.size)
    for j in range(plain.size):
        step = [STEP * 1j if i == j else 0.0 for i in range(plain.size)]
        gradient[j] = complex(c.potential([a + b for a, b in zip(q, step, strict=True)])).imag / STEP
    return -gradient


def masses(plain: Plain) -> np.ndarray:
    """Diagonal of M."""
    result = []
    for body, keys in plain.bodies.items():
        mass = plain.number(keys["mass"])
        result += [mass, mass] + ([plain.number(keys["inertia"])] if plain.turns(body) else [])
    return np.array(result)


def saddle_point(m: np.ndarray, d: np.ndarray, f: np.ndarray, g: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """v' and lambda of M v' + D^T lambda = f, D v' = g from the whole matrix."""
    n, k = len(m), len(g)
    matrix = np.block([[np.diag(m), d.T], [d, np.zeros((k, k))]])
    solution = np.linalg.solve(matrix, np.concatenate([f, g]))
    return solution[:n], solution[n:]

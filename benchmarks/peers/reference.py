"""Independent references from reduced formulations, integrated with DOP853.

Nothing here is built from the bodies and joints of a peer's model: the
four-bars use one equation in the crank angle, the N-four-bar its pendulum
equation, and Andrews' mechanism the seven coordinates of its test set.
"""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
from scipy.integrate import solve_ivp

from .models import Array, Model

INTERVALS = 100
RTOL = 1e-13
PUBLISHED_END = (
    15.81077119629904,
    -15.75637105984298,
    0.04082224013073101,
    -0.5347301163226948,
    0.5244099658805303,
    0.5347301163226948,
    1.048080741042263,
    1139.920302151208,
    -1424.379294994111,
    11.03291221937134,
    19.29337464421385,
    0.5735699284790808,
    -19.29337464421385,
    0.3231791658026955,
)
Rates = Callable[[float, Array], Array]


def sample_times(model: Model) -> Array:
    """Give the equidistant times at which errors are taken.

    Parameters
    ----------
    model : Model
        A mechanism.

    Returns
    -------
    ndarray, shape (INTERVALS + 1,)
        From zero to the end of the run.
    """
    return np.linspace(0.0, model.duration, INTERVALS + 1)


def angles(model: Model) -> Array:
    """Integrate the reduced form of a mechanism.

    Parameters
    ----------
    model : Model
        A mechanism of `models`.

    Returns
    -------
    ndarray, shape (INTERVALS + 1, bodies)
        Body angles in rad, not wrapped, at `sample_times`.
    """
    if model.name == "andrews":
        return _andrews_angles(andrews_states(sample_times(model)))
    if "windows" in model.parameters:
        return _n_four_bar_angles(model)
    crank = four_bar_states(model)[:, 0]
    return np.array([four_bar_shape(model, phi)[0] for phi in crank])


def largest_error(values: Array, reference: Array) -> float:
    """Find the largest difference over all times and body angles.

    Parameters
    ----------
    values, reference : ndarray, shape (times, bodies)
        Angles in rad.

    Returns
    -------
    float
        The largest absolute difference; NaN where a value is not finite.
    """
    if values.shape != reference.shape or not np.all(np.isfinite(values)):
        return math.nan
    return float(np.max(np.abs(values - reference)))


def _integrate(rates: Rates, start: Array, times: Array, atol: float) -> Array:
    """Run DOP853 and return the states at the given times, one row each."""
    out = solve_ivp(rates, (times[0], times[-1]), start, "DOP853", times, rtol=RTOL, atol=atol)
    if not out.success:
        raise RuntimeError(out.message)
    return np.asarray(out.y.T)


def four_bar_shape(model: Model, phi: float) -> tuple[Array, Array, Array]:
    """Close the four-bar loop for a crank angle.

    Both four-bars are crank-rockers: the distance from the crank pin to the
    rocker's pivot stays above the difference of coupler and rocker and below their sum for
    every crank angle, so the upper assembly exists and is regular throughout.

    Parameters
    ----------
    model : Model
        A four-bar.
    phi : float
        Crank angle in rad.

    Returns
    -------
    angle, first, second : ndarray, shape (3,)
        Angles of crank, coupler and rocker, and their first and second
        derivatives with respect to the crank angle.
    """
    p = model.parameters
    a, b, c = p["crank"], p["coupler"], p["rocker"]
    wx, wy = p["ground"] - a * math.cos(phi), -a * math.sin(phi)
    span = math.hypot(wx, wy)
    heading = math.atan2(wy, wx)
    psi = heading + math.acos((span**2 + b**2 - c**2) / (2 * span * b))
    chi = heading + math.pi - math.acos((span**2 + c**2 - b**2) / (2 * span * c))
    wide = b * math.sin(chi - psi)
    psi1 = a * math.sin(phi - chi) / wide
    chi1 = a * math.sin(phi - psi) / (c * math.sin(chi - psi))
    turn1 = chi1 - psi1
    drift = turn1 / math.tan(chi - psi)
    psi2 = a * math.cos(phi - chi) * (1 - chi1) / wide - psi1 * drift
    chi2 = a * b * math.cos(phi - psi) * (1 - psi1) / (wide * c) - chi1 * drift
    return np.array([phi, psi, chi]), np.array([1.0, psi1, chi1]), np.array([0.0, psi2, chi2])


def _four_bar_terms(model: Model, phi: float) -> tuple[float, float, float, float]:
    """Effective inertia, its derivative, potential energy and its derivative."""
    p, g = model.parameters, model.gravity
    a, b, c = p["crank"], p["coupler"], p["rocker"]
    (_, psi, chi), (_, psi1, chi1), (_, psi2, chi2) = four_bar_shape(model, phi)
    base = p["m1"] * a**2 / 3 + p["m2"] * a**2
    own, cross, rocker = p["m2"] * b**2 / 3, p["m2"] * a * b, p["m3"] * c**2 / 3
    cos, sin = math.cos(phi - psi), math.sin(phi - psi)
    inertia = base + own * psi1**2 + cross * psi1 * cos + rocker * chi1**2
    slope = 2 * own * psi1 * psi2 + 2 * rocker * chi1 * chi2
    slope += cross * (psi2 * cos - psi1 * (1 - psi1) * sin)
    lift = (p["m1"] / 2 + p["m2"]) * a * g
    half, arm = p["m2"] * g * b / 2, p["m3"] * g * c / 2
    potential = lift * math.sin(phi) + half * math.sin(psi) + arm * math.sin(chi)
    force = lift * math.cos(phi) + half * math.cos(psi) * psi1 + arm * math.cos(chi) * chi1
    return inertia, slope, potential, force


def four_bar_states(model: Model) -> Array:
    """Integrate the one-coordinate equation of a four-bar.

    Parameters
    ----------
    model : Model
        A four-bar.

    Returns
    -------
    ndarray, shape (INTERVALS + 1, 2)
        Crank angle and rate at `sample_times`.
    """

    def rates(_: float, state: Array) -> Array:
        inertia, slope, _, force = _four_bar_terms(model, state[0])
        return np.array([state[1], -(0.5 * slope * state[1] ** 2 + force) / inertia])

    start = np.array([model.bodies[0].angle, model.bodies[0].rate])
    return _integrate(rates, start, sample_times(model), 1e-13)


def four_bar_energy(model: Model, states: Array) -> Array:
    """Mechanical energy of a four-bar along a solution.

    Parameters
    ----------
    model : Model
        A four-bar.
    states : ndarray, shape (times, 2)
        Crank angle and rate.

    Returns
    -------
    ndarray, shape (times,)
        Kinetic plus potential energy in J.
    """
    terms = [_four_bar_terms(model, phi) for phi in states[:, 0]]
    return np.array([0.5 * t[0] * w**2 + t[2] for t, w in zip(terms, states[:, 1], strict=True)])


def _n_four_bar_angles(model: Model) -> Array:
    """Angles of all rods on the branch where every window stays a parallelogram."""
    n = model.parameters["windows"]
    factor = model.gravity * ((n + 1) / 2 + n) / ((n + 1) / 3 + n)

    def rates(_: float, state: Array) -> Array:
        return np.array([state[1], factor * math.sin(state[0])])

    theta = _integrate(rates, np.array([0.0, 1.0]), sample_times(model), 1e-13)[:, 0]
    links, couplers = int(n) + 1, int(n)
    upright = np.repeat(math.pi / 2 - theta[:, None], links, axis=1)
    return np.hstack([upright, np.zeros((theta.size, couplers))])


def _andrews_mass(q: Array) -> Array:
    """Mass matrix of the test set's seven coordinates."""
    th, ph, om = math.cos(q[1]), math.sin(q[3]), math.sin(q[5])
    rr, da, arm, far = 0.007, 0.0115, 0.02 - 0.01421, 0.02 - 0.01421
    zt, u = 0.04, 0.04
    mass = np.zeros((7, 7))
    mass[0, 0] = 0.04325 * 0.00092**2 + 0.00365 * (rr**2 - 2 * da * rr * th + da**2)
    mass[0, 0] += 2.194e-06 + 4.41e-07
    mass[0, 1] = mass[1, 0] = 0.00365 * (da**2 - da * rr * th) + 4.41e-07
    mass[1, 1] = 0.00365 * da**2 + 4.41e-07
    mass[2, 2] = 0.02373 * (0.01874**2 + 0.01043**2) + 5.255e-06
    mass[3, 3] = 0.00706 * arm**2 + 5.667e-07
    mass[3, 4] = mass[4, 3] = 0.00706 * (arm**2 + zt * arm * ph) + 5.667e-07
    mass[4, 4] = 0.00706 * (zt**2 + 2 * zt * arm * ph + arm**2)
    mass[4, 4] += 0.0705 * (0.02308**2 + 0.00916**2) + 5.667e-07 + 1.169e-05
    mass[5, 5] = 0.00706 * far**2 + 5.667e-07
    mass[5, 6] = mass[6, 5] = 0.00706 * (far**2 - u * far * om) + 5.667e-07
    mass[6, 6] = 0.00706 * (far**2 - 2 * u * far * om + u**2)
    mass[6, 6] += 0.05498 * (0.01228**2 + 0.00449**2) + 5.667e-07 + 1.912e-05
    return mass


def _andrews_force(q: Array, v: Array) -> Array:
    """Return applied and velocity-dependent forces of the seven coordinates."""
    sin, cos = np.sin(q), np.cos(q)
    x = 0.02 * cos[2] + 0.018 * sin[2] - 0.03635 - 0.014
    y = 0.02 * sin[2] - 0.018 * cos[2] + 0.03273 - 0.072
    length = math.hypot(x, y)
    pull = -4530.0 * (length - 0.07785) / length
    k2, k4, k6 = 0.00365 * 0.0115 * 0.007, 0.00706 * 0.04 * 0.00579, 0.00706 * 0.04 * 0.00579
    return np.array(
        [
            0.033 - k2 * v[1] * (v[1] + 2 * v[0]) * sin[1],
            k2 * v[0] ** 2 * sin[1],
            pull * x * (0.018 * cos[2] - 0.02 * sin[2]) + pull * y * (0.02 * cos[2] + 0.018 * sin[2]),
            k4 * v[4] ** 2 * cos[3],
            -k4 * v[3] * (v[3] + 2 * v[4]) * cos[3],
            -k6 * v[6] ** 2 * cos[5],
            k6 * v[5] * (v[5] + 2 * v[6]) * cos[5],
        ]
    )


# Each loop pair (x, y) is a sum of arms length * (cos, sin)(S q): the rows of S by
# arm, and the length of the arm in each of the three loops. Arms turned by a right
# angle (g1 and g2's ss, g3 and g4's e, g5 and g6's u) carry an offset of +-pi/2.
_ARMS = np.array(
    [
        [1, 0, 0, 0, 0, 0, 0],
        [1, 1, 0, 0, 0, 0, 0],
        [0, 0, 1, 0, 0, 0, 0],
        [0, 0, 0, 1, 1, 0, 0],
        [0, 0, 0, 0, 1, 0, 0],
        [0, 0, 0, 0, 0, 1, 1],
        [0, 0, 0, 0, 0, 0, 1],
    ],
    dtype=float,
)
_OFFSET = np.array([0.0, 0.0, math.pi / 2, -math.pi / 2, 0.0, 0.0, -math.pi / 2])
_LENGTHS = np.array(
    [
        [0.007, -0.028, 0.035, 0.0, 0.0, 0.0, 0.0],
        [0.007, -0.028, 0.0, -0.02, -0.04, 0.0, 0.0],
        [0.007, -0.028, 0.0, 0.0, 0.0, -0.02, -0.04],
    ]
)


def _andrews_rates(_: float, state: Array) -> Array:
    """Right-hand side with the multipliers eliminated."""
    q, v = state[:7], state[7:]
    turned = _ARMS @ q + _OFFSET
    spin = _ARMS @ v
    cos, sin = np.cos(turned), np.sin(turned)
    jacobian = np.vstack([(_LENGTHS * -sin) @ _ARMS, (_LENGTHS * cos) @ _ARMS])
    gamma = np.concatenate([_LENGTHS @ (cos * spin**2), _LENGTHS @ (sin * spin**2)])
    solved = np.linalg.solve(_andrews_mass(q), np.column_stack([_andrews_force(q, v), jacobian.T]))
    free, spread = solved[:, 0], solved[:, 1:]
    pull = np.linalg.solve(jacobian @ spread, jacobian @ free - gamma)
    return np.concatenate([v, free - spread @ pull])


def andrews_states(times: Array) -> Array:
    """Integrate the seven-coordinate form of the test set.

    Parameters
    ----------
    times : ndarray
        Times in s, from zero.

    Returns
    -------
    ndarray, shape (times, 14)
        Coordinates and rates; the end row compares with `PUBLISHED_END`.
    """
    start = np.zeros(14)
    start[0], start[2] = -0.0617138900142764496358948458001, 0.455279819163070380255912382449
    start[3], start[4] = 0.222668390165885884674473185609, 0.487364979543842550225598953530
    start[5], start[6] = -0.222668390165885884674473185609, 1.23054744454982119249735015568
    return _integrate(_andrews_rates, start, times, 1e-14)


def _andrews_angles(states: Array) -> Array:
    """Body angles K1 to K7 from the test set's coordinates."""
    return np.asarray(states[:, :7] @ _ARMS.T)

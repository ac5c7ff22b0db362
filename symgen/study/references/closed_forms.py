"""Formulas, and equations in one or two coordinates, for the motion of mechanisms of the catalogue."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence

import numpy as np
from msgspec import structs
from numpy.typing import NDArray

from symgen.base.errors import InputError, SimulationError
from symgen.describe.files.load import load_mechanism
from symgen.describe.mechanism import Mechanism

Array = NDArray[np.float64]
#: Source of a motion, its estimated error [m], and coordinates and velocities at the times.
Closed = tuple[str, float, Array, Array]
Formula = Callable[[Mechanism, Mapping[str, float], Array, Array], Closed]


def closed_form(mechanism: Mechanism) -> Formula | None:
    """Return the formula for the motion of a mechanism of the catalogue, None where there is none."""
    family, _, size = mechanism.name.partition("n-four-bar-")
    family = "n-four-bar" if size else family
    formula = CLOSED.get(family)
    if formula is None:
        return None
    try:
        entry = load_mechanism(f"n-four-bar:{size}" if size else family)
    except InputError:
        return None
    # another mechanism may have the same name
    return formula if structs.replace(entry, defaults=mechanism.defaults) == mechanism else None


def pendulum(mechanism: Mechanism, parameters: Mapping[str, float], q: Array, times: Array) -> Closed:
    """Released at rest at x = -1: sin(phi / 2) = k cd(w t, k^2), phi from the downward vertical, k = sin(phi_0 / 2)."""
    from scipy.special import ellipj, ellipk

    length, gravity = 1.0, 9.81
    phi0 = math.atan2(q[0], -q[1])
    k = math.sin(phi0 / 2.0)
    # whole periods are subtracted first: the functions lose digits as their argument grows
    u = np.remainder(math.sqrt(gravity / length) * times, 4.0 * ellipk(k * k))
    sn, cn, dn, _ = ellipj(u, k * k)
    half = np.arcsin(k * cn / dn)
    rate = -2.0 * math.sqrt(gravity / length) * k * (1.0 - k * k) * sn / dn**2 / np.cos(half)
    along, across = np.sin(2.0 * half), np.cos(2.0 * half)
    motion = length * np.column_stack([along, -across])
    velocities = length * rate[:, None] * np.column_stack([across, along])
    return "Jacobi's elliptic functions", 1e-14 * max(100.0, float(times[-1])), motion, velocities


def harmonic_motion(rate: float, q: Array, times: Array) -> Closed:
    """X = x_0 cos(rate t), of a body that begins at rest; its other coordinates stay."""
    motion, velocities = np.tile(q, (len(times), 1)), np.zeros((len(times), len(q)))
    turned = rate * times
    motion[:, 0], velocities[:, 0] = q[0] * np.cos(turned), -rate * q[0] * np.sin(turned)
    return "closed form: a cosine", 1e-16 * max(1.0, float(turned[-1])) * abs(float(q[0])), motion, velocities


def uniform_motion(accelerations: Sequence[float], q: Array, times: Array) -> Closed:
    """Coordinates with constant accelerations from rest."""
    a = np.asarray(accelerations, dtype=float)
    far = 0.5 * float(np.abs(a).max(initial=0.0)) * float(times[-1]) ** 2
    moved = q + 0.5 * np.outer(times**2, a)
    return "closed form: constant accelerations", 1e-15 * far, moved, np.outer(times, a)


def n_four_bar(mechanism: Mechanism, parameters: Mapping[str, float], q: Array, times: Array) -> Closed:
    """All verticals turn alike, and couplers translate: see `parallel_cranks`."""
    return parallel_cranks([body.name for body in mechanism.bodies], times)


def parallel_cranks(names: Sequence[str], times: Array) -> Closed:
    """((N + 1) / 3 + N) theta'' = g ((N + 1) / 2 + N) sin(theta), theta clockwise from the upward vertical.

    The bodies are ``vertical0`` to ``verticalN`` and ``coupler0`` to ``couplerN-1``, of 1 m and 1 kg; verticals begin
    upright with 1 rad/s to the right. This is the regular branch of their motion.
    """
    from scipy.integrate import solve_ivp

    n = sum(name.startswith("coupler") for name in names)
    factor = 9.81 * ((n + 1) / 2 + n) / ((n + 1) / 3 + n)

    def solve_at_tolerance(rtol: float) -> Array:
        def state_rate(_: float, y: Array) -> list[float]:
            return [y[1], factor * math.sin(y[0])]

        end = float(times[-1])
        # short steps: interpolation to the output times must not limit the accuracy
        solution = solve_ivp(state_rate, (0.0, end), [0.0, 1.0], "DOP853", times, rtol=rtol, atol=rtol, max_step=0.01)
        return np.asarray(solution.y, dtype=float)

    theta, speed = solve_at_tolerance(3e-14)
    s, c, zero = np.sin(theta), np.cos(theta), np.zeros(len(times))
    columns, rates = list[Array](), list[Array]()
    for name in names:
        if name.startswith("vertical"):
            columns += [int(name.removeprefix("vertical")) + 0.5 * s, 0.5 * c, math.pi / 2 - theta]
            rates += [0.5 * c * speed, -0.5 * s * speed, -speed]
        else:
            columns += [int(name.removeprefix("coupler")) + 0.5 + s, c, zero]
            rates += [c * speed, -s * speed, zero]
    estimated = 2.0 * float(np.abs(solve_at_tolerance(1e-12)[0] - theta).max(initial=0.0))
    how = "the equation of the regular branch in one coordinate, DOP853 at 3e-14"
    return how, estimated, np.column_stack(columns), np.column_stack(rates)


def driven_four_bar(mechanism: Mechanism, parameters: Mapping[str, float], q: Array, times: Array) -> Closed:
    """Crank angle as prescribed; the joint of coupler and rocker where two circles meet, on the side of the start."""
    crank, coupler, rocker, base = 2.0, 8.0, 5.0, 10.0
    speed = parameters["crank_speed"]
    theta = parameters["crank_start"] + speed * times
    bx, by = crank * np.cos(theta), crank * np.sin(theta)
    dx, dy = base - bx, -by
    d = np.hypot(dx, dy)
    along = (d**2 + coupler**2 - rocker**2) / (2.0 * d)
    across = np.sqrt(coupler**2 - along**2)
    # q holds crank x, y, theta, coupler x, y, theta, ...: on which side of the line from B to D the coupler lies
    b0 = crank * np.array([math.cos(parameters["crank_start"]), math.sin(parameters["crank_start"])])
    side = math.copysign(1.0, (base - b0[0]) * (q[4] - b0[1]) + b0[1] * (q[3] - b0[0]))
    cx = bx + (along * dx - side * across * dy) / d
    cy = by + (along * dy + side * across * dx) / d
    coupler_angle = np.unwrap(np.arctan2(cy - by, cx - bx))
    rocker_angle = np.unwrap(np.arctan2(cy, cx - base))
    motion = np.column_stack(
        [bx / 2, by / 2, theta, (bx + cx) / 2, (by + cy) / 2, coupler_angle, (base + cx) / 2, cy / 2, rocker_angle]
    )
    # C' is normal to C - D, and its part along C - B is that of B'
    bu, bv, ru, rv, ux, uy = -speed * by, speed * bx, cx - base, cy, cx - bx, cy - by
    along, area = ux * bu + uy * bv, ux * rv - uy * ru
    cu, cv = along * rv / area, -along * ru / area
    coupler_rate, rocker_rate = (ux * (cv - bv) - uy * (cu - bu)) / coupler**2, (ru * cv - rv * cu) / rocker**2
    turning = np.full(len(times), speed)
    velocities = np.column_stack(
        [bu / 2, bv / 2, turning, (bu + cu) / 2, (bv + cv) / 2, coupler_rate, cu / 2, cv / 2, rocker_rate]
    )
    how = "closed form: the prescribed crank and the intersection of two circles"
    return how, 1e-13, motion, velocities


def flyball_governor(mechanism: Mechanism, parameters: Mapping[str, float], q: Array, times: Array) -> Closed:
    """Two coordinates, the angle alpha of the arms below the horizontal and the slider's height s.

    H about the vertical is conserved, so that
    ``T = Ia alpha'^2 / 2 + ms s'^2 / 2 + H^2 / (2 I(alpha))``, solved by SciPy's Radau at two tolerances.
    """
    from scipy.integrate import solve_ivp
    from scipy.spatial.transform import Rotation

    gravity, offset, arm, ball, slider = 9.81, 0.05, 0.3, 5.0, 3.0
    stiffness, damping, free = (parameters[n] for n in ("spring_stiffness", "damping", "free_length"))
    mass = arm + ball
    centre = (0.5 * arm + ball) / mass  # of an arm with its ball, from the hinge
    along, across = arm * 2e-4 / 12.0, arm * 1.0001 / 12.0 + arm * 0.25 + ball
    own = across - mass * centre**2
    still = 0.3 * 2e-4 / 12.0 + slider * 0.02 / 12.0  # shaft and slider about the vertical

    def inertia_and_slope(alpha: float) -> tuple[float, float]:
        """Return I and dI/d alpha."""
        s, c = math.sin(alpha), math.cos(alpha)
        far = offset + centre * c
        value = still + 2.0 * (along * s * s + own * c * c + mass * far * far)
        return value, 4.0 * ((along - own) * s * c - mass * far * centre * s)

    begin, height = math.pi / 6.0, 0.5
    momentum = inertia_and_slope(begin)[0] * parameters["speed"]

    def state_rate(_: float, y: Array) -> list[float]:
        alpha, s, alpha_rate, s_rate, _ = y
        sine, cosine = math.sin(alpha), math.cos(alpha)
        level = 1.0 - 0.5 * sine - s
        length = math.hypot(0.5 * cosine, level)
        by_alpha = (-0.25 * sine * cosine - 0.5 * cosine * level) / length
        by_s = -level / length
        push = -stiffness * (length - free) - damping * (by_alpha * alpha_rate + by_s * s_rate)
        whole, slope = inertia_and_slope(alpha)
        turning = 0.5 * (momentum / whole) ** 2 * slope + 2.0 * mass * gravity * centre * cosine + 2.0 * push * by_alpha
        lifting = -slider * gravity + 2.0 * push * by_s
        return [alpha_rate, s_rate, turning / (2.0 * across), lifting / slider, momentum / whole]

    def rate_slopes(t: float, y: Array) -> Array:
        """Return d rate / d y by central differences; nothing depends on the angle about the vertical."""
        result = np.zeros((5, 5))
        for j in range(4):
            step = np.zeros(5)
            step[j] = 1e-6
            result[:, j] = (np.array(state_rate(t, y + step)) - np.array(state_rate(t, y - step))) / 2e-6
        return result

    def solve_at_tolerance(rtol: float) -> Array:
        start, end = [begin, height, 0.0, 0.0, 0.0], (0.0, float(times[-1]))
        solution = solve_ivp(state_rate, end, start, "Radau", times, rtol=rtol, atol=0.1 * rtol, jac=rate_slopes)
        if not solution.success:
            raise SimulationError(f"the reference motion cannot be integrated: {solution.message}")
        return np.asarray(solution.y, dtype=np.float64)

    y, rougher = solve_at_tolerance(1e-11), solve_at_tolerance(1e-10)
    alpha, s, alpha_rate, s_rate, turned = y
    spin = np.array([momentum / inertia_and_slope(a)[0] for a in alpha.tolist()])
    columns, rates = list[Array](), list[Array]()
    for body in mechanism.bodies:
        phi = turned + (math.pi if body.name == "arm2" else 0.0)
        about = Rotation.from_rotvec(phi[:, None] * np.array([0.0, 0.0, 1.0]))
        place, speed, own_turn = np.zeros((len(times), 3)), np.zeros((len(times), 3)), Rotation.identity()
        omega = np.zeros((len(times), 3))  # in axes that turn with the shaft, as place and speed are
        omega[:, 2] = spin
        if body.name.startswith("arm"):
            place[:, 0] = offset + centre * np.cos(alpha)
            place[:, 2] = 1.0 - centre * np.sin(alpha)
            speed[:, 0], speed[:, 2] = -centre * np.sin(alpha) * alpha_rate, -centre * np.cos(alpha) * alpha_rate
            own_turn = Rotation.from_rotvec(alpha[:, None] * np.array([0.0, 1.0, 0.0]))
            omega[:, 1] = alpha_rate
        else:
            place[:, 2] = s if body.name == "slider" else 0.5
            speed[:, 2] = s_rate if body.name == "slider" else 0.0
        speed[:, 1] += spin * place[:, 0]
        x, y_, z, w = (about * own_turn).as_quat().T
        columns += [*about.apply(place).T, w, x, y_, z]
        rates += [*about.apply(speed).T, *own_turn.inv().apply(omega).T]
    estimated = float(np.abs(y[[0, 1, 4]] - rougher[[0, 1, 4]]).max(initial=0.0))
    return (
        "the equations in the angle of the arms and the slider's height, SciPy Radau",
        estimated,
        np.column_stack(columns),
        np.column_stack(rates),
    )


#: Mechanism of the catalogue -> formula.
CLOSED: Mapping[str, Formula] = {
    "driven-four-bar": driven_four_bar,
    "n-four-bar": n_four_bar,
    "pendulum": pendulum,
    "flyball-governor": flyball_governor,
}

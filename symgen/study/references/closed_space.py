"""Formulas for the motion of spatial mechanisms of the catalogue; see `symgen.study.references.reference`."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from symgen.errors import SimulationError

if TYPE_CHECKING:
    from symgen.describe.mechanism import Mechanism

Array = NDArray[np.float64]


def flyball_governor(
    mechanism: Mechanism, parameters: Mapping[str, float], q: Array, times: Array
) -> tuple[str, float, Array]:
    """Two coordinates, the angle alpha of the arms below the horizontal and the slider's height s.

    H about the vertical stays, so that
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

    def inertia(alpha: float) -> tuple[float, float]:
        """Return I and dI/d alpha."""
        s, c = math.sin(alpha), math.cos(alpha)
        far = offset + centre * c
        value = still + 2.0 * (along * s * s + own * c * c + mass * far * far)
        return value, 4.0 * ((along - own) * s * c - mass * far * centre * s)

    begin, height = math.pi / 6.0, 0.5
    momentum = inertia(begin)[0] * parameters["speed"]

    def rate(_: float, y: Array) -> list[float]:
        alpha, s, alpha_rate, s_rate, _ = y
        sine, cosine = math.sin(alpha), math.cos(alpha)
        level = 1.0 - 0.5 * sine - s
        length = math.hypot(0.5 * cosine, level)
        by_alpha = (-0.25 * sine * cosine - 0.5 * cosine * level) / length
        by_s = -level / length
        push = -stiffness * (length - free) - damping * (by_alpha * alpha_rate + by_s * s_rate)
        whole, slope = inertia(alpha)
        turning = 0.5 * (momentum / whole) ** 2 * slope + 2.0 * mass * gravity * centre * cosine + 2.0 * push * by_alpha
        lifting = -slider * gravity + 2.0 * push * by_s
        return [alpha_rate, s_rate, turning / (2.0 * across), lifting / slider, momentum / whole]

    def slopes(t: float, y: Array) -> Array:
        """Return d rate / d y by central differences; of the angle about the vertical nothing depends."""
        result = np.zeros((5, 5))
        for j in range(4):
            step = np.zeros(5)
            step[j] = 1e-6
            result[:, j] = (np.array(rate(t, y + step)) - np.array(rate(t, y - step))) / 2e-6
        return result

    def solve(rtol: float) -> Array:
        start, end = [begin, height, 0.0, 0.0, 0.0], (0.0, float(times[-1]))
        found = solve_ivp(rate, end, start, "Radau", times, rtol=rtol, atol=0.1 * rtol, jac=slopes)
        if not found.success:
            raise SimulationError(f"the reference motion cannot be integrated: {found.message}")
        return np.asarray(found.y, dtype=np.float64)

    y, rougher = solve(1e-11), solve(1e-10)
    alpha, s, turned = y[0], y[1], y[4]
    columns: list[Array] = []
    for body in mechanism.bodies:
        phi = turned + (math.pi if body.name == "arm2" else 0.0)
        about = Rotation.from_rotvec(phi[:, None] * np.array([0.0, 0.0, 1.0]))
        place, own_turn = np.zeros((len(times), 3)), Rotation.identity()
        if body.name.startswith("arm"):
            place[:, 0] = offset + centre * np.cos(alpha)
            place[:, 2] = 1.0 - centre * np.sin(alpha)
            own_turn = Rotation.from_rotvec(alpha[:, None] * np.array([0.0, 1.0, 0.0]))
        else:
            place[:, 2] = s if body.name == "slider" else 0.5
        x, y_, z, w = (about * own_turn).as_quat().T
        columns += [*about.apply(place).T, w, x, y_, z]
    estimated = float(np.abs(y[[0, 1, 4]] - rougher[[0, 1, 4]]).max(initial=0.0))
    return (
        "the equations in the angle of the arms and the slider's height, SciPy Radau",
        estimated,
        np.column_stack(columns),
    )


#: Mechanism of the catalogue -> formula, as `symgen.study.references.reference.CLOSED` has it.
CLOSED_SPACE: Mapping[str, Callable[[Mechanism, Mapping[str, float], Array, Array], tuple[str, float, Array]]] = {
    "flyball-governor": flyball_governor,
}

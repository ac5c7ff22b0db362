"""Bricard's six-bar by the angles of its joints alone: closed by Newton's method, differentiated by a complex step."""

import numpy as np

POINTS = [(0, 0, 0), (1, 0, 0), (1, -1, 0), (1, -1, 1), (0, -1, 1), (0, 0, 1)]
AXES = [(0, 1, 0), (0, 0, 1), (1, 0, 0), (0, 1, 0), (0, 0, 1), (1, 0, 0)]
CENTRES = [(0.5, 0, 0), (1, -0.5, 0), (1, -1, 0.5), (0.5, -1, 1), (0, -0.5, 1)]
ALONG = (0, 1, 2, 0, 1)


def turned(axis, angle):
    k = np.array([[0, -axis[2], axis[1]], [axis[2], 0, -axis[0]], [-axis[1], axis[0], 0]], float)
    return np.eye(3) + np.sin(angle) * k + (1 - np.cos(angle)) * k @ k


def frames(angles):
    """Turn and shift of each body, the ground behind the last joint at the end."""
    turn, shift, found = np.eye(3), np.zeros(3), []
    for point, axis, angle in zip(POINTS, AXES, angles, strict=True):
        own, at = turned(axis, angle), np.array(point, float)
        shift = turn @ (at - own @ at) + shift
        turn = turn @ own
        found.append((turn, shift))
    return found


def screws(angles):
    before = [(np.eye(3), np.zeros(3)), *frames(angles)]
    return [
        (r @ np.array(k, float), r @ np.array(q, float) + p) for (r, p), k, q in zip(before, AXES, POINTS, strict=False)
    ]


def least(matrix, right):
    """Least squares by the plain transpose: a complex step goes through it."""
    return np.linalg.solve(matrix.T @ matrix, matrix.T @ right)


def columns(angles):
    return np.array([np.concatenate([np.cross(q, k), k]) for k, q in screws(angles)]).T


def closed(first, angles):
    """Angles that close the loop with the first one given, from some nearby."""
    found = np.array(angles, dtype=complex)
    found[0] = first
    for _ in range(30):
        r, p = frames(found)[-1]
        found[1:] -= least(columns(found)[:, 1:], np.concatenate([p, [r[2, 1], r[0, 2], r[1, 0]]]))
    return found


def reduced(first, angles):
    """Mass and slope of the potential along the first angle, and the angles."""
    found = closed(first, angles)
    all_columns = columns(found)
    rates = np.concatenate([[1.0], -least(all_columns[:, 1:], all_columns[:, 0])])
    mass = slope = 0.0
    spin = speed = np.zeros(3)
    for i, ((k, q), (r, p)) in enumerate(zip(screws(found)[:5], frames(found), strict=False)):
        spin, speed = spin + k * rates[i], speed + np.cross(q, k) * rates[i]
        velocity = speed + np.cross(spin, r @ np.array(CENTRES[i], float) + p)
        inertia, own = np.full(3, 1.01 / 12), r.T @ spin
        inertia[ALONG[i]] = 0.02 / 12
        mass, slope = mass + velocity @ velocity + own @ (inertia * own), slope + 9.81 * velocity[1]
    return mass, slope, found


def square_at(angle):
    """omega^2 at an angle, and the slope of the potential there, which is followed to from the cube."""
    found = np.zeros(6)
    for t in np.linspace(0.0, angle, 9):
        _, slope, found = reduced(t, found)
    mass, stepped, _ = reduced(angle + 1e-30j, found)
    return stepped.imag / 1e-30 / mass.real, slope.real

"""Bricard's six-bar by the angle of its first joint alone, in closed form.

Its joints turn by a, b, a, b, a, b, and the loop is closed where (1 + sin a) (1 + sin b) = 1: Y. Chen, Z. You and
T. Tarnai, Int. J. Solids Struct. 42 (2005) 2287-2301, for twists of right angles. Derivatives along a are
complex steps.
"""

import numpy as np

POINTS = [(0, 0, 0), (1, 0, 0), (1, -1, 0), (1, -1, 1), (0, -1, 1), (0, 0, 1)]
AXES = [(0, 1, 0), (0, 0, 1), (1, 0, 0), (0, 1, 0), (0, 0, 1), (1, 0, 0)]
CENTRES = [(0.5, 0, 0), (1, -0.5, 0), (1, -1, 0.5), (0.5, -1, 1), (0, -0.5, 1)]
ALONG = (0, 1, 2, 0, 1)
_STEP = 1e-30


def _crossed(axis):
    return np.array([[0, -axis[2], axis[1]], [axis[2], 0, -axis[0]], [-axis[1], axis[0], 0]], float)


_TURNS = [(_crossed(axis), _crossed(axis) @ _crossed(axis)) for axis in AXES]


def angles(first):
    """Angles of all joints by that of the first one, which is between -30 and 210 degrees."""
    return np.array([first, np.arcsin(-np.sin(first) / (1 + np.sin(first)))] * 3)


def rates(first):
    """Slopes of these angles along the first one."""
    s, c = np.sin(first), np.cos(first)
    return np.array([1.0, -c / ((1 + s) * np.sqrt(1 + 2 * s))] * 3)


def frames(first):
    """Turn and shift of each body, then those of the ground behind the last joint."""
    turn, shift = np.eye(3), np.zeros(3)
    for point, (k, kk), angle in zip(POINTS, _TURNS, angles(first), strict=True):
        own = np.eye(3) + np.sin(angle) * k + (1 - np.cos(angle)) * kk
        shift = turn @ (np.array(point) - own @ point) + shift
        turn = turn @ own
        yield turn, shift


def reduced(first):
    """Mass and slope of the potential along the first angle."""
    mass = slope = 0.0
    spin = speed = np.zeros(3)
    turn, shift = np.eye(3), np.zeros(3)
    bodies = zip(AXES, POINTS, CENTRES, ALONG, rates(first), frames(first), strict=False)
    for axis, point, centre, along, rate, (own_turn, own_shift) in bodies:
        k = turn @ axis * rate
        spin, speed = spin + k, speed + np.cross(turn @ point + shift, k)
        turn, shift = own_turn, own_shift
        velocity, own = speed + np.cross(spin, turn @ centre + shift), turn.T @ spin
        inertia = np.full(3, 1.01 / 12)
        inertia[along] = 0.02 / 12
        mass, slope = mass + velocity @ velocity + own @ (inertia * own), slope + 9.81 * velocity[1]
    return mass, slope


def acceleration(first, rate):
    """Second derivative of the first angle."""
    mass, slope = reduced(first + _STEP * 1j)
    return -(mass.imag / _STEP * rate**2 / 2 + slope.real) / mass.real


def square_at(first):
    """omega^2 at an angle, and the slope of the potential there."""
    mass, slope = reduced(first + _STEP * 1j)
    return slope.imag / _STEP / mass.real, slope.real

"""RATTLie and XPBD, which docs/methods.md names by what is nearest here, in NumPy beside that."""

import numpy as np
import pytest

import symgen

MASS, J, ARM = 15.0, np.diag([0.234375, 0.46875, 0.234375]), np.array([0.0, -1.0, 0.0])
WEIGHT, SPIN = np.array([0.0, 0.0, -9.81 * MASS]), np.array([0.0, 150.0, -4.61538])


def skew(a):
    return np.array([[0.0, -a[2], a[1]], [a[2], 0.0, -a[0]], [-a[1], a[0], 0.0]])


def turned_by(w):
    angle, k = np.linalg.norm(w), skew(w)
    return np.eye(3) + np.sinc(angle / np.pi) * k + 0.5 * np.sinc(0.5 * angle / np.pi) ** 2 * k @ k


def carried(h, omega, side, lie):
    """Angular momentum of the middle of a step at its beginning (side 1) or end (-1): the transpose of dexp^-1."""
    momentum, k, angle = J @ omega, skew(omega), h * np.linalg.norm(omega)
    third = (1.0 - 0.5 * angle / np.tan(0.5 * angle)) / angle**2 if lie else 0.0
    return momentum + 0.5 * side * h * k @ momentum + third * h * h * k @ k @ momentum


def rattlie(h, steps, lie):
    """Hante and Arnold's scheme on R^3 x SO(3) for the heavy top; without its term of second order unless `lie`."""
    turn, omega = np.eye(3), SPIN
    x, v = -ARM, np.cross(SPIN, -ARM)

    def columns(turn):
        return np.hstack([np.eye(3), -turn @ skew(ARM)])

    for _ in range(steps):
        rows, before = columns(turn), np.concatenate([MASS * v + 0.5 * h * WEIGHT, J @ omega])

        def ends(z, x=x, turn=turn):
            return x + h * z[:3], turn @ turned_by(h * z[3:6])

        def open_by(z, rows=rows, before=before, ends=ends):
            middle = np.concatenate([MASS * z[:3], carried(h, z[3:6], 1.0, lie)])
            place, at = ends(z)
            return np.concatenate([middle - before + 0.5 * h * rows.T @ z[6:], (place + at @ ARM) / h])

        z = np.concatenate([v, omega, np.zeros(3)])
        for _ in range(6):
            columns_of_slope = [(open_by(z + d) - open_by(z - d)) / (2.0 * d.sum()) for d in 1e-5 * np.eye(9)]
            z = z - np.linalg.solve(np.column_stack(columns_of_slope), open_by(z))
        x, turn = ends(z)
        rows = columns(turn)
        momentum = np.concatenate([MASS * z[:3] + 0.5 * h * WEIGHT, carried(h, z[3:6], -1.0, lie)])
        mass = np.block([[MASS * np.eye(3), np.zeros((3, 3))], [np.zeros((3, 3)), J]])
        saddle = np.block([[mass, rows.T], [rows, np.zeros((3, 3))]])
        v, omega = np.split(np.linalg.solve(saddle, np.concatenate([momentum, np.zeros(3)]))[:6], 2)
    return x


@pytest.mark.slow
@pytest.mark.parametrize(("until", "share"), [(0.04, 0.63), (0.1, 0.4)])
def test_rattle_is_rattlie_without_its_term_of_second_order(until, share):
    """Both have order 2; the term h^2 omega x (omega x J omega) / 12 takes a part of the error."""
    model = symgen.load("heavy-top")
    asked = {"until": until, "times": [until], "coordinates": "absolute", "verify": False}

    def place(**settings):
        run = model.simulate(**asked, **settings)
        return np.array([run[f"top.{c}"][-1] for c in "xyz"])

    right, errors = place(method="lagrange", integrator="dop853", rtol=1e-12, atol=1e-13), []
    for steps in (round(until / 2e-3), round(until / 1e-3)):
        ours = place(method="rattle", step=until / steps, max_violation=1.0, max_energy_error=1e3)
        np.testing.assert_allclose(rattlie(until / steps, steps, False), ours, rtol=0.0, atol=1e-11)
        theirs = rattlie(until / steps, steps, True)
        errors.append([np.linalg.norm(ours - right), np.linalg.norm(theirs - right)])
    np.testing.assert_allclose(np.log2(np.divide(*errors)), 2.0, atol=0.02)
    np.testing.assert_allclose([theirs / ours for ours, theirs in errors], share, atol=0.02)


# -- the four-bar by sweeps over its rows ------------------------------------------------------------------------------

LENGTHS = np.array([2.0, 8.0, 5.0])
MASSES = np.ravel([(m, m, m * m * m / 12.0) for m in LENGTHS])  # a kilogram a metre
#: Bodies and ends that each pin holds together, -1 for the ground and its points.
PINS = ((-1, (0.0, 0.0), 0, -1.0), (0, 1.0, 1, -1.0), (1, 1.0, 2, 1.0), (-1, (10.0, 0.0), 2, -1.0))
PARTS = ("crank", "coupler", "rocker")


def pin(q, which):
    """Return how far a pin is open, and its two rows."""
    a, end_a, b, end_b = PINS[which]
    phi, rows = np.zeros(2), np.zeros((2, 9))
    for body, end, sign in ((a, end_a, -1.0), (b, end_b, 1.0)):
        if body < 0:
            phi += sign * np.asarray(end)
            continue
        arm, at = 0.5 * LENGTHS[body] * end, 3 * body
        c, s = np.cos(q[at + 2]), np.sin(q[at + 2])
        phi += sign * (q[at : at + 2] + arm * np.array([c, s]))
        rows[:, at : at + 2] = sign * np.eye(2)
        rows[:, at + 2] = sign * arm * np.array([-s, c])
    return phi, rows


def xpbd(q, h, steps, sweeps):
    """Positions after steps of position-based dynamics without compliance, row by row."""
    v, fall = np.zeros(9), np.tile([0.0, -9.81, 0.0], 3)
    for _ in range(steps):
        moved = q + h * (v + h * fall)
        for row in list(range(8)) * sweeps:
            phi, rows = (x[row % 2] for x in pin(moved, row // 2))
            moved = moved - rows / MASSES * phi / (rows @ (rows / MASSES))
        v, q = (moved - q) / h, moved
    return q


@pytest.mark.slow
def test_position_based_dynamics_has_the_order_of_implicit_constraint():
    """Both have order 1: `implicit-constraint` has two thirds of the error, whatever the number of sweeps."""
    model, until = symgen.load("four-bar"), 1.0
    asked = {"until": until, "times": [0.0, until], "coordinates": "absolute", "verify": False}

    def places(**settings):
        run = model.simulate(**asked, **settings)
        return np.array([[run[f"{part}.{c}"][k] for part in PARTS for c in ("x", "y", "theta")] for k in (0, -1)])

    start, right = places(method="lagrange", integrator="dop853", rtol=1e-11, atol=1e-12)
    errors = []
    for steps in (250, 500):
        limits = {"max_violation": 1.0, "max_energy_error": 1e3}
        ends = places(method="implicit-constraint", step=until / steps, **limits)[1]
        swept = [xpbd(start, until / steps, steps, sweeps) for sweeps in (1, 4)]
        errors.append([np.abs(end - right).max() for end in (ends, *swept)])
    np.testing.assert_allclose(np.log2(np.divide(*errors)), 1.0, atol=0.05)
    np.testing.assert_allclose([[ours / one for one in theirs] for ours, *theirs in errors], 0.65, atol=0.03)

"""Dynamics of `brake` for casadi. Written by symgen.

mass_matrix(q, p): M, 6 x 6
bias(q, v, p): h of M v' + h = effort - D^T lambda, 6
forward_dynamics(q, v, effort, p): v' with all rows in force, 6
inverse_dynamics(q, v, a, p): M a + h; with rows the shortest efforts, 6
rates(q, v, p): q', 6
kinetic_energy(q, v, p): T [J], a number
potential_energy(q, p): V [J], a number
constraint_jacobian(q, p): D of D v = nu, 4 x 6
violation(q, p): Phi, 4
nu(q, p): nu, 4
gamma(q, v, p): gamma of D v' = gamma, 4
pose_wheel(q, p): pose of wheel, 3 x 3
velocity_wheel(q, v, p): velocity of wheel, 3
jacobian_wheel(q, p): jacobian of wheel, 3 x 6
pose_probe(q, p): pose of probe, 3 x 3
velocity_probe(q, v, p): velocity of probe, 3
jacobian_probe(q, p): jacobian of probe, 3 x 6

q[0] wheel.x [m]
q[1] wheel.y [m]
q[2] wheel.theta [rad]
q[3] probe.x [m]
q[4] probe.y [m]
q[5] probe.theta [rad]

v[0] wheel.vx [m/s]
v[1] wheel.vy [m/s]
v[2] wheel.omega [rad/s]
v[3] probe.vx [m/s]
v[4] probe.vy [m/s]
v[5] probe.omega [rad/s]

p[0] torque
p[1] pressure
p[2] warm
p[3] t

row 0 free.x
row 1 free.y
row 2 pin.x
row 3 pin.y
"""

import numpy as np

P = np.array([0.0, 1.0, 0.0, 0.0])
ROWS = 4


import inspect

import casadi as ca


def _function(name, elements, sizes, shape):
    """Return a function of symbols; matrices are row by row in `elements`."""
    names = list(inspect.signature(elements).parameters)
    symbols = [ca.SX.sym(name, size) for name, size in zip(names, sizes)]
    result = ca.vertcat(*elements(*symbols))
    if len(shape) == 2:
        result = ca.reshape(result, shape[1], shape[0]).T
    return ca.Function(name, symbols, [result], names, ["result"])


def _mass_matrix(q, p):
    """Return M."""
    return [1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 2.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0]


mass_matrix = _function('mass_matrix', _mass_matrix, (6, 4), (6, 6))


def _bias(q, v, p):
    """Return h of M v' + h = effort - D^T lambda."""
    p0 = p[0]
    v2 = v[2]
    s0 = ca.sign(v2)
    return [0.0, 9.81, -(p0 + 2.5*ca.fabs(s0) - 2.5*s0), 0.0, 9.81, 0.0]


bias = _function('bias', _bias, (6, 6, 4), (6,))


def _forward_dynamics(q, v, effort, p):
    """Return v' with all rows in force."""
    p0 = p[0]
    v2 = v[2]
    e2 = effort[2]
    e5 = effort[5]
    s0 = ca.sign(v2)
    s1 = ca.logic_not((1.0 > 1e-14))
    s2 = ca.logic_or(ca.logic_or(ca.logic_or(ca.logic_or(s1, s1), ca.logic_not((2.0 > 2e-14))), s1), s1)
    return [0.0, 0.0, 0.5*(e2 + p0 + 2.5*ca.fabs(s0) - 2.5*s0), 0.0, 0.0, e5]


forward_dynamics = _function('forward_dynamics', _forward_dynamics, (6, 6, 6, 4), (6,))


def _inverse_dynamics(q, v, a, p):
    """Return M a + h; with rows the shortest efforts."""
    p0 = p[0]
    v2 = v[2]
    a2 = a[2]
    a5 = a[5]
    s0 = ca.sign(v2)
    s1 = ca.logic_not((1.0 > 1e-14))
    return [0.0, 0.0, 2.0*a2 - (p0 + 2.5*ca.fabs(s0) - 2.5*s0), 0.0, 0.0, a5]


inverse_dynamics = _function('inverse_dynamics', _inverse_dynamics, (6, 6, 6, 4), (6,))


def _rates(q, v, p):
    """Return q'."""
    v0 = v[0]
    v1 = v[1]
    v2 = v[2]
    v3 = v[3]
    v4 = v[4]
    v5 = v[5]
    return [v0, v1, v2, v3, v4, v5]


rates = _function('rates', _rates, (6, 6, 4), (6,))


def _kinetic_energy(q, v, p):
    """Return T [J]."""
    v0 = v[0]
    v1 = v[1]
    v2 = v[2]
    v3 = v[3]
    v4 = v[4]
    v5 = v[5]
    return [v2*v2 + 0.5*(v0*v0) + 0.5*(v1*v1) + 0.5*(v3*v3) + 0.5*(v4*v4) + 0.5*(v5*v5)]


kinetic_energy = _function('kinetic_energy', _kinetic_energy, (6, 6, 4), ())


def _potential_energy(q, p):
    """Return V [J]."""
    q1 = q[1]
    q4 = q[4]
    return [9.81*q1 + 9.81*q4]


potential_energy = _function('potential_energy', _potential_energy, (6, 4), ())


def _constraint_jacobian(q, p):
    """Return D of D v = nu."""
    return [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0]


constraint_jacobian = _function('constraint_jacobian', _constraint_jacobian, (6, 4), (4, 6))


def _violation(q, p):
    """Return Phi."""
    q0 = q[0]
    q1 = q[1]
    q3 = q[3]
    q4 = q[4]
    return [q3 - 1.0, q4, q0, q1]


violation = _function('violation', _violation, (6, 4), (4,))


def _nu(q, p):
    """Return nu."""
    return [0.0, 0.0, 0.0, 0.0]


nu = _function('nu', _nu, (6, 4), (4,))


def _gamma(q, v, p):
    """Return gamma of D v' = gamma."""
    return [0.0, 0.0, 0.0, 0.0]


gamma = _function('gamma', _gamma, (6, 6, 4), (4,))


def _pose_wheel(q, p):
    """Return pose of wheel."""
    q0 = q[0]
    q1 = q[1]
    q2 = q[2]
    s0 = ca.cos(q2)
    s1 = ca.sin(q2)
    return [s0, -s1, q0, s1, s0, q1, 0.0, 0.0, 1.0]


pose_wheel = _function('pose_wheel', _pose_wheel, (6, 4), (3, 3))


def _velocity_wheel(q, v, p):
    """Return velocity of wheel."""
    v0 = v[0]
    v1 = v[1]
    v2 = v[2]
    return [v0, v1, v2]


velocity_wheel = _function('velocity_wheel', _velocity_wheel, (6, 6, 4), (3,))


def _jacobian_wheel(q, p):
    """Return jacobian of wheel."""
    return [1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0]


jacobian_wheel = _function('jacobian_wheel', _jacobian_wheel, (6, 4), (3, 6))


def _pose_probe(q, p):
    """Return pose of probe."""
    q3 = q[3]
    q4 = q[4]
    q5 = q[5]
    s0 = ca.cos(q5)
    s1 = ca.sin(q5)
    return [s0, -s1, q3, s1, s0, q4, 0.0, 0.0, 1.0]


pose_probe = _function('pose_probe', _pose_probe, (6, 4), (3, 3))


def _velocity_probe(q, v, p):
    """Return velocity of probe."""
    v3 = v[3]
    v4 = v[4]
    v5 = v[5]
    return [v3, v4, v5]


velocity_probe = _function('velocity_probe', _velocity_probe, (6, 6, 4), (3,))


def _jacobian_probe(q, p):
    """Return jacobian of probe."""
    return [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0]


jacobian_probe = _function('jacobian_probe', _jacobian_probe, (6, 4), (3, 6))

"""Dynamics of `brake` for jax. Written by symgen.

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


import jax
import jax.numpy as jnp

jax.config.update("jax_enable_x64", True)  # with 32 bits loops would not stay closed


def mass_matrix(q, p=P):
    """Return M."""
    return jnp.array([1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 2.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0]).reshape((6, 6))


def bias(q, v, p=P):
    """Return h of M v' + h = effort - D^T lambda."""
    p0 = p[0]
    v2 = v[2]
    s0 = jnp.sign(v2)
    return jnp.array([0.0, 9.81, -(p0 + 2.5*jnp.abs(s0) - 2.5*s0), 0.0, 9.81, 0.0]).reshape((6,))


def forward_dynamics(q, v, effort, p=P):
    """Return v' with all rows in force."""
    p0 = p[0]
    v2 = v[2]
    e2 = effort[2]
    e5 = effort[5]
    s0 = jnp.sign(v2)
    s1 = jnp.logical_not((1.0 > 1e-14))
    s2 = jnp.logical_or(jnp.logical_or(jnp.logical_or(jnp.logical_or(s1, s1), jnp.logical_not((2.0 > 2e-14))), s1), s1)
    s3 = jnp.logical_or(jnp.logical_or(jnp.logical_or(jnp.logical_or(jnp.logical_or(s2, s1), s1), s1), s1), s1)
    return jnp.array([0.0, 0.0, 0.5*(e2 + p0 + 2.5*jnp.abs(s0) - 2.5*s0), 0.0, 0.0, e5]).reshape((6,))


def inverse_dynamics(q, v, a, p=P):
    """Return M a + h; with rows the shortest efforts."""
    p0 = p[0]
    v2 = v[2]
    a2 = a[2]
    a5 = a[5]
    s0 = jnp.sign(v2)
    s1 = jnp.logical_not((1.0 > 1e-14))
    return jnp.array([0.0, 0.0, 2.0*a2 - (p0 + 2.5*jnp.abs(s0) - 2.5*s0), 0.0, 0.0, a5]).reshape((6,))


def rates(q, v, p=P):
    """Return q'."""
    v0 = v[0]
    v1 = v[1]
    v2 = v[2]
    v3 = v[3]
    v4 = v[4]
    v5 = v[5]
    return jnp.array([v0, v1, v2, v3, v4, v5]).reshape((6,))


def kinetic_energy(q, v, p=P):
    """Return T [J]."""
    v0 = v[0]
    v1 = v[1]
    v2 = v[2]
    v3 = v[3]
    v4 = v[4]
    v5 = v[5]
    return jnp.array([v2*v2 + 0.5*(v0*v0) + 0.5*(v1*v1) + 0.5*(v3*v3) + 0.5*(v4*v4) + 0.5*(v5*v5)]).reshape(())


def potential_energy(q, p=P):
    """Return V [J]."""
    q1 = q[1]
    q4 = q[4]
    return jnp.array([9.81*q1 + 9.81*q4]).reshape(())


def constraint_jacobian(q, p=P):
    """Return D of D v = nu."""
    return jnp.array([0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0]).reshape((4, 6))


def violation(q, p=P):
    """Return Phi."""
    q0 = q[0]
    q1 = q[1]
    q3 = q[3]
    q4 = q[4]
    return jnp.array([q3 - 1.0, q4, q0, q1]).reshape((4,))


def nu(q, p=P):
    """Return nu."""
    return jnp.array([0.0, 0.0, 0.0, 0.0]).reshape((4,))


def gamma(q, v, p=P):
    """Return gamma of D v' = gamma."""
    return jnp.array([0.0, 0.0, 0.0, 0.0]).reshape((4,))


def pose_wheel(q, p=P):
    """Return pose of wheel."""
    q0 = q[0]
    q1 = q[1]
    q2 = q[2]
    s0 = jnp.cos(q2)
    s1 = jnp.sin(q2)
    return jnp.array([s0, -s1, q0, s1, s0, q1, 0.0, 0.0, 1.0]).reshape((3, 3))


def velocity_wheel(q, v, p=P):
    """Return velocity of wheel."""
    v0 = v[0]
    v1 = v[1]
    v2 = v[2]
    return jnp.array([v0, v1, v2]).reshape((3,))


def jacobian_wheel(q, p=P):
    """Return jacobian of wheel."""
    return jnp.array([1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0]).reshape((3, 6))


def pose_probe(q, p=P):
    """Return pose of probe."""
    q3 = q[3]
    q4 = q[4]
    q5 = q[5]
    s0 = jnp.cos(q5)
    s1 = jnp.sin(q5)
    return jnp.array([s0, -s1, q3, s1, s0, q4, 0.0, 0.0, 1.0]).reshape((3, 3))


def velocity_probe(q, v, p=P):
    """Return velocity of probe."""
    v3 = v[3]
    v4 = v[4]
    v5 = v[5]
    return jnp.array([v3, v4, v5]).reshape((3,))


def jacobian_probe(q, p=P):
    """Return jacobian of probe."""
    return jnp.array([0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0]).reshape((3, 6))

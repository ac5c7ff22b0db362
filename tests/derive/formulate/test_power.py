"""Power balance on states that fulfil D v = nu: what constraints may and may not do."""

import cmath

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from support import reference
from support.checks import RANDOM, close
from support.emitted import Emitted, mechanism_of
from support.plain import STEP, Plain
from support.random_mechanisms import descriptions, states

KINDS = ("distance", "gear", "knife-edge", "pin-in-slot", "revolute", "rigid", "rolling", "translational")


def draw_case(data, kinds):
    raw = data.draw(descriptions(kinds, ("spring-damper", "torque", "force")))
    t, q, v = data.draw(states())
    plain = Plain(raw)
    q, v = q[: plain.size], np.array(v[: plain.size])
    d = np.array(list(reference.jacobian(plain, t, q, v.tolist()).values()))
    scaled = d / np.linalg.norm(d, axis=1, keepdims=True)
    assume(len(d) < plain.size and np.linalg.svd(scaled, compute_uv=False)[-1] > 0.05)
    names = reference.row_names(plain, t, q, v.tolist())
    held = reference.nu(plain, t, q)
    nu = np.array([held.get(n, 0.0) for n in names])
    v = v - np.linalg.pinv(d) @ (d @ v - nu)  # the nearest velocities that fulfil the constraints
    return plain, Emitted(mechanism_of(raw)), t, q, v.tolist(), d, nu


def energy_rate(plain, q, v, acceleration):
    """v M v' + dV/dt, the latter by a complex step along the motion."""
    moved = [a + STEP * 1j * b for a, b in zip(q, v, strict=True)]
    potential = complex(plain.using(cmath).potential(moved)).imag / STEP
    return float(np.dot(v, reference.masses(plain) * acceleration)) + potential


@pytest.mark.slow
@RANDOM
@given(data=st.data())
def test_scleronomic_joints_do_no_work(data):
    kinds = tuple(data.draw(st.lists(st.sampled_from(KINDS), min_size=1, max_size=3)))
    plain, emitted, t, q, v, d, _ = draw_case(data, kinds)
    found = emitted.at(t, q, v, emitted.parameters(plain.values))
    scale = max(1.0, float(np.abs(found.multipliers).max()) * float(np.abs(d).max()))
    assert abs(found.multipliers @ d @ v) <= 1e-10 * scale
    _, lost = reference.applied(plain, t, q, v)
    close(found.power, lost, "only forces without potential change the energy", 1e-9 * scale)
    close(energy_rate(plain, q, v, found.acceleration), lost, "rate of the energy", 1e-9 * scale)


@RANDOM
@given(data=st.data())
def test_drivers_do_the_work_that_is_accounted_for(data):
    kinds = ("driver", *data.draw(st.lists(st.sampled_from(KINDS), max_size=2)))
    plain, emitted, t, q, v, _, nu = draw_case(data, kinds)
    found = emitted.at(t, q, v, emitted.parameters(plain.values))
    scale = max(1.0, float(np.abs(found.multipliers).max()))
    close(energy_rate(plain, q, v, found.acceleration), found.power, "rate of the energy", 1e-9 * scale)
    _, lost = reference.applied(plain, t, q, v)
    close(found.power, lost - found.multipliers @ nu, "power of drivers is -lambda nu", 1e-9 * scale)

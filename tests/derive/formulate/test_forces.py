"""Forces, power and energies of every force kind on random mechanisms, against `Plain`: loads put on bodies one by one,
virtual power, and complex-step gradients of potentials.
"""

import cmath

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from support import reference
from support.checks import RANDOM, close
from support.emitted import Emitted, mechanism_of
from support.graph_values import node_values, state_inputs
from support.plain import Plain, dot
from support.random_mechanisms import descriptions, states

from symgen.derive.formulate.formulate import formulate
from symgen.describe.forces import FORCES

#: A bushing in the plane is compared with springs in closed form by `test_primitives`, and the energy of beam elements
#: by `test_beam_element`.
APART = ("bushing", "beam")
KINDS = tuple(name for name, kind in FORCES.items() if "planar" in kind.SPACES and name not in APART)


@pytest.mark.by_turns(3)
@pytest.mark.slow
@pytest.mark.parametrize("kind", KINDS)
@RANDOM
@given(data=st.data())
def test_force_on_random_mechanisms(kind, data):
    raw = data.draw(descriptions((), (kind, data.draw(st.sampled_from(KINDS)), kind)))
    t, q, v = data.draw(states())
    plain, equations = Plain(raw), formulate(mechanism_of(raw))
    q, v = q[: plain.size], v[: plain.size]
    inputs = state_inputs(t, q, v, plain.values.values())
    f, power = reference.applied(plain, t, q, v)
    g, tables = equations.graph, equations.tables
    close(node_values(g, equations.forces, inputs, tables), f, "f")
    close(node_values(g, [equations.power], inputs, tables), [power], "power without potential")
    close(node_values(g, [equations.potential], inputs, tables), [plain.potential(q)], "V")
    kinetic = float(np.dot(reference.masses(plain), np.square(v))) / 2
    close(node_values(g, [equations.kinetic], inputs, tables), [kinetic], "T")

    emitted = Emitted(mechanism_of(raw))
    found = emitted.at(t, q, v, emitted.parameters(plain.values))
    close(found.acceleration, f / reference.masses(plain), "v' of free bodies")
    close(found.power, power, "emitted power")
    close([found.status["kinetic"], found.status["potential"]], [kinetic, plain.potential(q)], "emitted energies")


@RANDOM
@given(data=st.data())
def test_conservative_forces_are_minus_the_gradient_and_virtual_power_agrees(data):
    """The reference itself, twice: loads against the potential's gradient, and against the power of moving points."""
    raw = data.draw(descriptions((), tuple(KINDS)))
    t, q, v = data.draw(states())
    plain = Plain(raw)
    q, v = q[: plain.size], v[: plain.size]
    f, lost = reference.applied(plain, t, q, v)
    power = sum(
        dot(force, plain.velocity(body, at, q, v)) + torque * plain.spin(body, v)
        for body, force, torque, at, _ in plain.loads(t, q, v)
    )
    gravity = plain.pair(raw["mechanism"]["gravity"])
    weights = sum(
        plain.number(keys["mass"]) * dot(gravity, v[plain.first[b] : plain.first[b] + 2])
        for b, keys in raw["bodies"].items()
    )
    close(float(np.dot(f, v)), power + weights, "f v")
    moved = [a + reference.STEP * 1j * b for a, b in zip(q, v, strict=True)]
    rate = complex(plain.using(cmath).potential(moved)).imag / reference.STEP
    close(float(np.dot(f, v)) - lost, -rate, "conservative power")
    close(float(np.dot(reference.conservative_part(plain, q), v)), -rate, "gradient of V")


def test_every_force_kind_was_tried():
    assert set(KINDS) == {"force", "spring-damper", "torque", "torsional-spring-damper"}

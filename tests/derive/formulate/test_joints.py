"""Phi, D, nu, gamma and joint coordinates of every joint kind on random mechanisms, against `Plain`.

symgen's side is taken twice: from the graph of the equations by an interpreter, and from the emitted functions.
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
from support.plain import Plain
from support.random_mechanisms import PARAMETERS, descriptions, states

from symgen.derive.formulate.formulate import formulate
from symgen.describe.joints import JOINTS

#: Ropes follow from their starts, and have closed forms in tests/run/single/test_ropes.py; points on beams have theirs
#: in tests/verification/test_sliding.py.
KINDS = tuple(name for name, kind in JOINTS.items() if "planar" in kind.SPACES and name not in ("rope", "slides-on"))


def expected_rows(plain, t, q, v):
    """name -> (Phi or None, row of D, nu, gamma)."""
    phi, rows = plain.phi(t, q), reference.jacobian(plain, t, q, v)
    nu, gamma = reference.nu(plain, t, q), reference.gamma(plain, t, q, v)
    return {n: (phi.get(n), rows[n], nu.get(n, 0.0), gamma[n]) for n in rows}


def check_graph(raw, t, q, v):
    plain, equations = Plain(raw), formulate(mechanism_of(raw))
    expected = expected_rows(plain, t, q, v)
    inputs, g = state_inputs(t, q, v, plain.values.values()), equations.graph
    for row in equations.rows:
        phi, d, nu, gamma = expected[row.name]
        found = np.zeros(equations.nv)
        found[[j for j, _ in row.entries]] = node_values(g, [n for _, n in row.entries], inputs)
        close(found, d, f"D, {row.name}")
        assert (row.phi is None) == (phi is None)
        ends = [(row.nu, nu), (row.gamma, gamma), *([(row.phi, phi)] if phi is not None else [])]
        close(node_values(g, [n for n, _ in ends], inputs), [x for _, x in ends], f"nu, gamma, Phi, {row.name}")
    for pair in equations.dropped_rows:
        dropped, kept = pair.split(" = ")
        for a, b in zip(expected[dropped], expected[kept], strict=True):
            close(0.0 if a is None else a, 0.0 if b is None else b, f"{pair} was dropped")
    assert {r.name for r in equations.rows} | {p.split(" = ")[0] for p in equations.dropped_rows} == set(expected)
    found = {c.name: node_values(g, [c.value, c.rate], inputs) for c in equations.joint_coordinates}
    for name, (value, rate) in expected_coordinates(plain, q, v).items():
        close(found.pop(name), [value, rate], name)
    assert not found


def expected_coordinates(plain, q, v):
    moved = [a + reference.STEP * 1j * b for a, b in zip(q, v, strict=True)]
    result = {}
    for joint, keys in plain.raw["joints"].items():
        values = plain.joint_coordinates(keys, q) if "between" in keys else {}
        rates = plain.using(cmath).joint_coordinates(keys, moved) if values else {}
        for label, value in values.items():
            result[f"{joint}.{label}"] = value, complex(rates[label]).imag / reference.STEP
    return result


def check_emitted(raw, t, q, v, compiled=False):
    plain, emitted = Plain(raw), Emitted(mechanism_of(raw), compiled=compiled)
    found = emitted.at(t, q, v, emitted.parameters(plain.values), law=False)
    expected, drift = expected_rows(plain, t, q, v), reference.velocity_residual(plain, t, q, v)
    for i, row in enumerate(emitted.info.rows):
        phi, d, nu, gamma = expected[row.name]
        close(found.d[i], d, f"D, {row.name}")
        close(found.phi[i], phi or 0.0, f"Phi, {row.name}")
        close(found.nu[i], nu, f"nu, {row.name}")
        close(found.gamma[i], gamma, f"gamma, {row.name}")
        close(found.drift[i], drift[row.name], f"D v - nu, {row.name}")
    names = [r.name for r in emitted.info.rows]
    close(found.status["position_violation"], np.linalg.norm([expected[n][0] or 0.0 for n in names]), "|Phi|")
    close(found.status["velocity_violation"], np.linalg.norm([drift[n] for n in names]), "|D v - nu|")
    for k, (name, pair) in enumerate(expected_coordinates(plain, q, v).items()):
        assert emitted.info.joint_coordinates[k].name == name
        close(found.coordinates[2 * k : 2 * k + 2], pair, name)


@pytest.mark.by_turns(4)
@pytest.mark.slow_cases(
    "coupling",
    "distance",
    "pin-in-slot",
    "driver",
    "knife-edge",
    "orientation",
    "place",
    "rolling",
    "rows",
    "translational",
)
@pytest.mark.parametrize("kind", KINDS)
@RANDOM
@given(data=st.data())
def test_joint_on_random_mechanisms(kind, data):
    raw = data.draw(descriptions((kind, data.draw(st.sampled_from(KINDS)), kind), ()))
    t, q, v = data.draw(states())
    size = Plain(raw).size
    check_graph(raw, t, q[:size], v[:size])
    check_emitted(raw, t, q[:size], v[:size])


def test_every_joint_kind_was_tried():
    """The strategy knows the kinds by name: a new kind must be added there and to `Plain`."""
    assert set(KINDS) == {
        *("coupling", "distance", "driver", "gear", "knife-edge", "orientation", "pin-in-slot"),
        *("place", "revolute", "rigid", "rolling", "rows", "translational"),
    }


@pytest.mark.slow
@RANDOM
@given(data=st.data())
def test_parameters_stay_adjustable(data):
    """Emitted with the defaults of parameters, evaluated with other values."""
    raw = data.draw(descriptions(("driver", "gear", "distance", "pin-in-slot"), ()))
    t, q, v = data.draw(states())
    emitted = Emitted(mechanism_of(raw))
    other = Plain(raw, values={n: x * 1.3 + 0.1 for n, x in PARAMETERS.items()})
    found = emitted.at(t, q[: other.size], v[: other.size], emitted.parameters(other.values), law=False)
    expected = expected_rows(other, t, q[: other.size], v[: other.size])
    for i, row in enumerate(emitted.info.rows):
        close(found.phi[i], expected[row.name][0], f"Phi, {row.name}")
        close(found.gamma[i], expected[row.name][3], f"gamma, {row.name}")
    close(found.masses, reference.masses(other), "M")

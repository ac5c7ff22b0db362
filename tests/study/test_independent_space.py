"""The second derivation of spatial equations against the emitted functions, on random mechanisms and states."""

import numpy as np
import pytest
from support.checks import close
from support.emitted import Emitted, mechanism_of
from support.random_space import make
from support.rotation import of_turn

from symgen.describe.formulas.evaluate import evaluate_formula
from symgen.study.references.independent import IndependentEquations

#: All kinds of joints and forces, a third of them in a turn.
GROUPS = [
    (("revolute", "spherical"), ("force",)),
    (("translational", "distance"), ("spring-damper",)),
    (("cylindrical", "point-on-plane"), ("torque",)),
    (("universal", "driver"), ("torsional-spring-damper",)),
    (("screw", "pin-in-slot"), ()),
    (("rolling-disc", "knife-edge"), ("bushing",)),
    (("rolling-sphere", "revolute-spherical"), ()),
    (("gear",), ("force",)),
    (("rack-and-pinion",), ()),
    (("constant-velocity",), ("torque",)),
    (("planar", "rigid"), ()),
]


def second_rates(equations, q, v, change):
    """q'' of velocities v with rates `change`: central differences along q' = N v would do, this is exact."""
    n = equations.n
    first = equations.state(q, v)[n:]
    # q' is linear in v and in q, so q'' = N(q) v' + N(q') v where N is read with q' in place of q
    bent = equations.state(first, v)[n:]
    for body in equations.mechanism.bodies:
        i = equations.first[body.name]
        bent[i : i + 3] = 0.0
    return equations.state(q, change)[n:] + bent


def regular(joints, forces):
    """The first random mechanism with these kinds whose rows are independent, and what its emitted functions give."""
    for seed in range(50):
        rng = np.random.default_rng(seed)
        raw, t, q, v = make(rng, joints, forces, smooth=True)
        mechanism = mechanism_of(raw)
        if sum(len(joint.rows) for joint in mechanism.joints) > sum(len(body.speeds) for body in mechanism.bodies):
            continue
        emitted = Emitted(mechanism)
        values = {p.name: p.value for p in mechanism.parameters}
        state = t, np.array(q), np.array(v), emitted.parameters(values)
        if np.linalg.svd(emitted.at(*state, law=False).d, compute_uv=False)[-1] > 1e-2:
            return mechanism, emitted, emitted.at(*state), rng, state[:3]
    raise AssertionError("no seed gives independent rows")


@pytest.mark.by_turns(2)
@pytest.mark.slow
@pytest.mark.parametrize(("joints", "forces"), of_turn(GROUPS, 9), ids=lambda kinds: "-".join(kinds) or "none")
def test_rows_and_accelerations_are_those_emitted(joints, forces):
    mechanism, emitted, found, rng, (t, q, v) = regular(joints, forces)
    values = {p.name: p.value for p in mechanism.parameters}
    equations = IndependentEquations(mechanism, values)
    y = equations.state(np.array(q), np.array(v))
    n, m = equations.n, emitted.info.m
    phi, d, nu, gamma, _ = equations.evaluate(t, y[:n], y[n:])
    assert len(phi) == m + sum(not body.is_point for body in mechanism.bodies), "a row more for each that turns"
    assert np.abs(phi[m:]).max() < 1e-15
    close(found.phi, phi[:m], "Phi")
    close(found.nu, nu[:m], "nu")
    columns = np.column_stack([equations.state(y[:n], unit)[n:] for unit in np.eye(emitted.info.nv)])
    close(found.d, d[:m] @ columns, "D")
    close(d[m:] @ columns, np.zeros((len(d) - m, emitted.info.nv)), "turning keeps the length")
    change = rng.normal(size=emitted.info.nv)
    close(found.d @ change - found.gamma, (d @ second_rates(equations, y[:n], v, change) - gamma)[:m], "Phi''", 1e-10)
    close(equations.velocities(y), v, "velocities there and back")
    expected = second_rates(equations, y[:n], v, found.acceleration)
    close(equations.rate(t, y)[n:], expected, "accelerations", 1e-9)


@pytest.mark.slow
def test_angles_begin_with_the_turns_that_drivers_ask_for():
    """A wheel driven from 20 rad on, three turns and more, and a follower geared to it."""
    wheel = {"mass": 1.0, "inertia": [0.1, 0.1, 0.2]}
    pin = {"type": "revolute", "at": [[0.0, 0.0, 0.0], "centre"], "axis": [[0.0, 0.0, 1.0]] * 2}
    pin["reference"] = [[1.0, 0.0, 0.0]] * 2
    raw = {
        "mechanism": {"name": "x", "space": "spatial"},
        "bodies": {"a": wheel, "b": wheel},
        "joints": {
            "A": pin | {"between": ["ground", "a"]},
            "B": pin | {"between": ["ground", "b"]},
            "motor": {"type": "driver", "joint": "A", "value": "20 + 3*t"},
            "mesh": {"type": "gear", "joints": ["A", "B"], "ratio": 2.0, "mesh": "internal"},
        },
    }
    mechanism = mechanism_of(raw)
    equations = IndependentEquations(mechanism, {})
    row = next(joint for joint in mechanism.joints if joint.name == "mesh").rows[0]
    y = np.zeros(2 * equations.n)
    y[3:7] = np.cos(10.0), 0.0, 0.0, np.sin(10.0)
    assert len(row.measure.terms) == 2
    factors = [evaluate_formula(k, {}) for k, _ in row.measure.terms]
    # the follower turns by the ratio of the two factors, whichever way round the gear takes it
    turned = -factors[0] / factors[1] * 20.0
    y[10:14] = [np.cos(turned / 2), 0.0, 0.0, np.sin(turned / 2)]
    phi = equations.evaluate(0.0, y[: equations.n], y[equations.n :])[0]
    close(phi, np.zeros(len(phi)), "Phi")


def test_states_of_planar_mechanisms_are_coordinates_and_velocities():
    raw = {"mechanism": {"name": "x"}, "bodies": {"b": {"mass": 1.0, "inertia": 1.0}}}
    equations = IndependentEquations(mechanism_of(raw), {})
    assert np.all(equations.state(np.arange(3.0), np.arange(3.0)) == [0, 1, 2, 0, 1, 2])

"""Phi, D, nu, gamma and joint coordinates of every spatial joint kind on random mechanisms, against `Space`."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from support.checks import RANDOM, close
from support.emitted import mechanism_of
from support.graph_values import node_values, state_inputs
from support.random_space import described
from support.space import STEP, Space

from symgen.derive.formulate.formulate import formulate
from symgen.describe.joints import JOINTS

#: Ropes follow from their starts, and have references in tests/run/single/test_ropes_in_space.py; points on beams have
#: theirs in tests/verification/test_sliding.py.
KINDS = tuple(name for name, kind in JOINTS.items() if "spatial" in kind.SPACES and name not in ("rope", "slides-on"))

#: Kinds whose other side is a plane of the ground, or whose formulas read coordinates in its frame.
ON_THE_GROUND = ("rolling-disc", "rolling-sphere", "knife-edge", "rows")


def with_windings(equations, inputs, angles=()):
    """Inputs with what the section ``winding`` remembers, 0 unless given."""
    return inputs | {("winding", i): angles[i] if len(angles) else 0.0 for i in range(len(equations.windings))}


def check(raw, t, q, v):
    mechanism = mechanism_of(raw)
    space, equations = Space(raw), formulate(mechanism)
    g = equations.graph
    inputs = with_windings(equations, state_inputs(t, q, v, raw["parameters"].values()))
    close(node_values(g, equations.q_rates, inputs), space.rates(q, v), "q'")
    inner = {j.name for j in mechanism.joints if "ground" not in j.bodies and j.kind not in ON_THE_GROUND}
    phi, d, nu, gamma = space.phi(t, q), space.jacobian(t, q, v), space.nu(t, q), space.gamma(t, q, v)
    for row in equations.rows:
        found = np.zeros(equations.nv)
        found[[j for j, _ in row.entries]] = node_values(g, [n for _, n in row.entries], inputs)
        close(found, d[row.name], f"D, {row.name}")
        if row.joint in inner and row.name[-2:] not in (".x", ".y", ".z"):  # in ground axes only where they are closed
            check_balance(space, q, found, row.name)
        assert (row.phi is None) == (row.name not in phi)
        if row.phi is not None:
            close(node_values(g, [row.phi], inputs), [phi[row.name]], f"Phi, {row.name}")
        close(node_values(g, [row.nu], inputs), [nu[row.name]], f"nu, {row.name}")
        expected, error = gamma[row.name]  # differences lose digits where an angle is nearly undefined
        close(node_values(g, [row.gamma], inputs), [expected], f"gamma, {row.name}", 1e-9 + error)
    kept = {row.name for row in equations.rows}
    assert kept | {pair.split(" = ")[0] for pair in equations.dropped_rows} == set(d)
    moved = space.coordinates(np.asarray(q) + 1j * STEP * space.rates(q, v))
    expected = {n: (x, np.imag(moved[n]) / STEP) for n, x in space.coordinates(q).items()}
    for c in equations.joint_coordinates:
        close(node_values(g, [c.value, c.rate], inputs), expected.pop(c.name), c.name)
        assert c.unit == ("rad" if "angle" in c.name else "m")
    assert not expected


def check_balance(space, q, row, name):
    """Between bodies a joint acts and reacts: its forces, and their moments about the origin, add up to nothing."""
    force, moment = np.zeros(3), np.zeros(3)
    for body, j in space.first_v.items():
        force += row[j : j + 3]
        moment += np.cross(space.centre(body, q), row[j : j + 3])
        if space.turns(body):
            moment += space.matrix(body, q) @ row[j + 3 : j + 6]
    close([*force, *moment], np.zeros(6), f"action and reaction, {name}", 2e-11 * max(1.0, np.abs(row).max()))


@pytest.mark.by_turns(4)
@pytest.mark.slow_cases(
    "coupling",
    "gear",
    "perpendicular",
    "rack-and-pinion",
    "spherical",
    "constant-velocity",
    "cylindrical",
    "distance",
    "driver",
    "rolling-disc",
    "rolling-sphere",
    "rows",
)
@pytest.mark.parametrize("kind", KINDS)
@RANDOM
@given(data=st.data())
def test_joint_on_random_mechanisms(kind, data):
    check(*data.draw(described((kind, data.draw(st.sampled_from(KINDS))))))

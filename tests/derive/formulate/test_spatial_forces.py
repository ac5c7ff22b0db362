"""Forces, power and energies of every spatial force kind on random mechanisms, against `Space`: loads put on bodies one
by one, virtual power, and complex-step rates of potentials.
"""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from support.checks import RANDOM, close
from support.emitted import mechanism_of
from support.graph_values import node_values, state_inputs
from support.random_space import described
from support.space import Space

from symgen.derive.formulate.formulate import formulate
from symgen.describe.forces import FORCES

KINDS = tuple(name for name, kind in FORCES.items() if "spatial" in kind.SPACES and name != "beam")


@pytest.mark.by_turns(3)
@pytest.mark.slow_cases("bushing", "spring-damper", "force", "torsional-spring-damper")
@pytest.mark.parametrize("kind", KINDS)
@RANDOM
@given(data=st.data())
def test_force_on_random_mechanisms(kind, data):
    raw, t, q, v = data.draw(described((), (kind, data.draw(st.sampled_from(KINDS)), kind)))
    space, equations = Space(raw), formulate(mechanism_of(raw))
    inputs = state_inputs(t, q, v, raw["parameters"].values())
    inputs |= {("winding", i): 0.0 for i in range(len(equations.windings))}
    g, tables = equations.graph, equations.tables
    f, power = space.applied(t, q, v)
    close(node_values(g, equations.forces, inputs, tables), f, "f")
    close(node_values(g, [equations.power], inputs, tables), [power], "power without potential")
    close(node_values(g, [equations.potential], inputs, tables), [space.potential(q)], "V")
    mass = np.zeros((space.nv, space.nv))
    for block in equations.mass:
        for i, entries in zip(block.columns, block.entries, strict=True):
            mass[i, block.columns] = node_values(g, entries, inputs, tables)
    close(mass, space.mass(), "M")
    close(node_values(g, [equations.kinetic], inputs, tables), [v @ space.mass() @ v / 2], "T")
    # whatever is in V acts as its derivative, and gyroscopic terms do no work
    close(
        np.dot(node_values(g, equations.forces, inputs, tables), v) - power, -space.potential_rate(q, v), "power of V"
    )

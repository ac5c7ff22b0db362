"""What accepted states are not measured for: a correction of velocities reads D v - nu alone."""

import numpy as np
import pytest
from support.emitted import Emitted, mechanism_of

from symgen.api import load
from symgen.run.compiling.choices import mechanism_on_tree

#: A disc on a wire y = x^3 that a table moves up and down: the row has a nu.
BEAD = {
    "mechanism": {"name": "bead"},
    "bodies": {"p": {"type": "point", "mass": 2.0, "position": [1.0, 1.0]}},
    "joints": {"wire": {"type": "rows", "rows": [{"position": "p.y - p.x**3 - 0.1*sin(2*t)", "label": "wire"}]}},
}


@pytest.mark.parametrize("method", ["direct-correction", "velocity-projection", "energy-projection"])
def test_a_correction_of_velocities_reads_their_residuals_alone(method):
    emitted = Emitted(mechanism_of(BEAD), method)
    (part,) = (module for module in emitted.modules.values() if hasattr(module, "drift"))
    w, p, t, q, v = emitted.scratch(), emitted.parameters({}), 0.3, np.array([0.7, -0.2]), np.array([1.5, 0.4])
    y = np.concatenate([q, v, [0.0]])
    emitted.call(emitted.model, "geometry", t, y, p, w)
    before = w.copy()
    emitted.call(part, "drift", t, y, p, w)
    left = v[1] - 3.0 * q[0] ** 2 * v[0] - 0.2 * np.cos(2.0 * t)
    np.testing.assert_allclose(emitted.section(w, "residual"), left, rtol=1e-15)
    changed = np.flatnonzero(w != before)
    first, size = emitted.info.sections["residual"]
    assert set(changed) == set(range(first, first + size))


def test_methods_that_measure_alone_have_no_such_function():
    emitted = Emitted(mechanism_of(BEAD), "lagrange")
    assert not any(hasattr(module, "drift") for module in emitted.modules.values())


def test_the_mass_matrix_of_a_free_body_is_constant_in_coordinates_of_joints():
    """Its velocity is that of the ground's axes, so that m A A^T is m; a rotation turns with the body."""
    emitted = Emitted(mechanism_on_tree(load("free-rigid-body").mechanism))
    assert "mass_entry" not in emitted.info.sections and emitted.info.operations["geometry"] == 0
    rng, p = np.random.default_rng(3), emitted.parameters({})
    e = rng.normal(size=4)
    found = emitted.at(0.0, np.concatenate([rng.normal(size=3), e / np.linalg.norm(e)]), rng.normal(size=6), p)
    np.testing.assert_allclose(found.masses, [2.0, 2.0, 2.0, 1.0, 2.0, 3.0], rtol=1e-15)

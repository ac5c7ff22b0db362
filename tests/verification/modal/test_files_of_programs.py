"""Matrices in Harwell-Boeing files, as Ansys writes them: one triangle in an order of its own, by the recipe."""

import numpy as np
from scipy import sparse
from scipy.io import hb_read, hb_write
from support.modal_machines import slender

import symgen


def test_a_triangle_in_another_order_gives_the_same_body(tmp_path):
    mesh = slender()
    order = np.random.default_rng(3).permutation(mesh.mass.shape[0])
    read = []
    for name, matrix in (("mass", mesh.mass), ("stiffness", mesh.stiffness)):
        hb_write(tmp_path / f"{name}.hb", sparse.tril(sparse.csc_matrix(matrix)[order][:, order], format="csc"))
        half = hb_read(tmp_path / f"{name}.hb", spmatrix=False).tocsr()
        back = np.argsort(order)
        read.append((half + half.T - sparse.diags_array(half.diagonal()))[back][:, back])
        np.testing.assert_allclose(read[-1].toarray(), matrix.toarray(), rtol=1e-12, atol=1e-12 * abs(matrix).max())
    own, known = (symgen.reduced(mesh.x, m, k, mesh.ends, 3) for m, k in (read, (mesh.mass, mesh.stiffness)))
    np.testing.assert_allclose(own.frequencies, known.frequencies, rtol=1e-9)

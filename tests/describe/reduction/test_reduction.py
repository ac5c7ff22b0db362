"""Reduction of finite elements: frequencies, masses and sentences about what is wrong."""

import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pytest
from scipy import linalg, sparse
from scipy.sparse.linalg import eigsh
from support.modal_machines import arc, bow, slender, straight

import symgen
from benchmarks.finite_elements import bar_frame, solid
from symgen.base.errors import InputError


def free_squares(mesh, count):
    """The lowest squares of frequencies of a free mesh, besides rigid motions."""
    rigid = 3 if mesh.x.shape[1] == 2 else 6
    found = linalg.eigh(mesh.stiffness.toarray(), mesh.mass.toarray(), eigvals_only=True)
    return found[rigid : rigid + count]


@pytest.mark.parametrize("make", [bow, arc], ids=["planar", "spatial"])
def test_modes_of_the_free_body_are_those_of_the_mesh(make):
    """Without interfaces modes are exact; eigenvalues of LAPACK have the digits of the largest one."""
    mesh = make()
    body = symgen.reduced(mesh.x, mesh.mass, mesh.stiffness, inner=4)
    squares = (2.0 * np.pi * body.frequencies) ** 2
    np.testing.assert_allclose(squares, free_squares(mesh, 4), rtol=1e-9)
    own = np.diag(body.shapes.T @ (mesh.stiffness @ body.shapes)) / body.mass
    # each is a sum of terms that are up to 2.5e5 times as large: kernels of LAPACK differ by a thirtieth of their digit
    terms = np.sum(np.abs(body.shapes) * (abs(mesh.stiffness) @ np.abs(body.shapes)), axis=0) / body.mass
    assert np.all(np.abs(own - squares) < np.finfo(float).eps * terms)


def test_modes_have_no_momenta_and_the_mass_of_the_body():
    mesh = arc()
    body = symgen.reduced(mesh.x, mesh.mass, mesh.stiffness, mesh.ends, 3)
    weighed = mesh.mass @ body.shapes
    np.testing.assert_allclose(body.shapes.T @ weighed, body.mass * np.eye(9), atol=1e-12 * body.mass)
    momenta = weighed.T.reshape(9, -1, 3)
    assert np.abs(momenta.sum(axis=1)).max() < 1e-13 * body.mass
    assert np.abs(np.cross(mesh.x, momenta).sum(axis=1)).max() < 1e-13 * body.mass
    assert body.mass == pytest.approx(float(mesh.density.sum()), rel=1e-14)
    x = mesh.x - body.centre
    second = x.T @ (mesh.density @ x)
    np.testing.assert_allclose(body.inertia, np.trace(second) * np.eye(3) - second, rtol=1e-12)


def test_a_slender_bar_rings_as_eulers():
    """22.3733, 61.6728 and 120.903 sqrt(E I / rho A L^4) to 2e-3, with interfaces and four modes inside."""
    mesh = straight()
    body = symgen.reduced(mesh.x, mesh.mass, mesh.stiffness, mesh.ends, 4)
    scale = np.sqrt(2e9 * 0.02**2 / 12.0 / 1000.0)
    np.testing.assert_allclose(
        2.0 * np.pi * body.frequencies[:3], np.array([22.3733, 61.6728, 120.903]) * scale, rtol=3e-3
    )
    assert body.frequencies[0] == pytest.approx(np.sqrt(free_squares(mesh, 1)[0]) / 2.0 / np.pi, rel=1e-3)


@pytest.mark.parametrize("spatial", [False, True])
def test_frames_are_lumped_and_ring_as_eulers(spatial):
    places = np.zeros((41, 3 if spatial else 2))
    places[:, 0] = np.linspace(0.0, 1.0, 41)
    mesh = bar_frame(places, 2e9, 4e-4, 0.02**4 / 12.0, 1000.0, 2e-8, 8e8)
    body = symgen.reduced(mesh.x, mesh.mass, mesh.stiffness, mesh.ends, 4)
    scale = np.sqrt(2e9 * 0.02**2 / 12.0 / 1000.0)
    frequencies = 2.0 * np.pi * body.frequencies
    assert body.mass == pytest.approx(0.4, rel=1e-12)
    assert frequencies[0] == pytest.approx(22.3733 * scale, rel=3e-3)
    assert frequencies[2 if spatial else 1] == pytest.approx(61.6728 * scale, rel=5e-3)
    assert body.inertia[-1, -1] == pytest.approx(0.4 / 12.0, rel=2e-3)


def triangles(count):
    """Nodes, M and K of a bar of triangles with six nodes, whose corners have no mass in the sum of a row."""
    mass = np.array(
        [
            [6.0, -1.0, -1.0, 0.0, -4.0, 0.0],
            [-1.0, 6.0, -1.0, 0.0, 0.0, -4.0],
            [-1.0, -1.0, 6.0, -4.0, 0.0, 0.0],
            [0.0, 0.0, -4.0, 32.0, 16.0, 16.0],
            [-4.0, 0.0, 0.0, 16.0, 32.0, 16.0],
            [0.0, -4.0, 0.0, 16.0, 16.0, 32.0],
        ]
    )
    numbers = {}
    cells = []
    for i in range(count):
        for corners in (((i, 0), (i + 1, 0), (i + 1, 1)), ((i, 0), (i + 1, 1), (i, 1))):
            a, b, c = (np.array(p, dtype=float) for p in corners)
            six = [a, b, c, (a + b) / 2, (b + c) / 2, (c + a) / 2]
            cells.append([numbers.setdefault(tuple(p), len(numbers)) for p in six])
    x = np.array(list(numbers)) * [0.1, 0.1]
    m, k = np.zeros((2 * len(x),) * 2), np.zeros((2 * len(x),) * 2)
    law = 2e9 * np.diag([1.0, 1.0, 0.5])
    for cell in cells:
        sides = np.array([x[cell[1]] - x[cell[0]], x[cell[2]] - x[cell[0]]])
        area = 0.5 * abs(float(np.linalg.det(sides)))
        place = (np.array(cell)[:, None] * 2 + np.arange(2)).ravel()
        m[np.ix_(place, place)] += 1000.0 * area / 180.0 * np.kron(mass, np.eye(2))
        for r, s in ((1 / 6, 1 / 6), (2 / 3, 1 / 6), (1 / 6, 2 / 3)):
            t = 1.0 - r - s
            by_r = [1.0 - 4.0 * t, 4.0 * r - 1.0, 0.0, 4.0 * (t - r), 4.0 * s, -4.0 * s]
            by_s = [1.0 - 4.0 * t, 0.0, 4.0 * s - 1.0, -4.0 * r, 4.0 * r, 4.0 * (t - s)]
            g = np.linalg.solve(sides, np.array([by_r, by_s]))
            b = np.zeros((3, 12))
            b[0, ::2], b[1, 1::2], b[2, ::2], b[2, 1::2] = g[0], g[1], g[1], g[0]
            k[np.ix_(place, place)] += area / 3.0 * b.T @ law @ b
    return x, m, k


def test_corners_of_quadratic_triangles_have_mass():
    """Sums of their rows vanish, of quadratic tetrahedra they are negative, and M is still that of a body."""
    x, m, k = triangles(6)
    assert abs(m[0, ::2].sum()) < 1e-12 and m[0, 0] > 0.0
    body = symgen.reduced(x, m, k, inner=2)
    assert body.mass == pytest.approx(1000.0 * 0.06, rel=1e-12)
    exact = linalg.eigh(k, m, eigvals_only=True)[3:5]
    np.testing.assert_allclose((2.0 * np.pi * body.frequencies) ** 2, exact, rtol=1e-9)


def test_sums_that_are_negative_are_shared_by_the_diagonal():
    """Nodes of the triangles turn, stiffly: corners have masses, and the body that of its elements."""
    x, m, k = triangles(6)
    n = len(x)
    place = (np.arange(n)[:, None] * 3 + np.arange(2)).ravel()
    turning = np.arange(n) * 3 + 2
    heavy, stiff = np.zeros((3 * n, 3 * n)), np.zeros((3 * n, 3 * n))
    heavy[np.ix_(place, place)], stiff[np.ix_(place, place)] = m - 1e-3 * np.diag(np.diag(m)), k
    heavy[turning, turning] = 1e-9
    hang = np.zeros((n - 1, 3 * n))  # turns are tied to each other and to the chord
    for i in range(n - 1):
        away = x[i + 1] - x[i]
        square = float(away @ away)
        hang[i, [3 * i, 3 * i + 1, 3 * i + 3, 3 * i + 4]] = np.array([away[1], -away[0], -away[1], away[0]]) / square
        hang[i, 3 * i + 2] = -1.0
    last = np.zeros((1, 3 * n))
    last[0, [3 * n - 4, 3 * n - 1]] = 1.0, -1.0
    ties = np.vstack([hang, last])
    stiff += 1e3 * ties.T @ ties
    body = symgen.reduced(x, heavy, stiff, inner=2)
    assert body.mass == pytest.approx(float(heavy[np.ix_(place, place)].sum()) / 2.0, rel=1e-9)
    assert np.all(body.frequencies > 0.0)


def test_a_reduction_is_the_same_again():
    mesh = bow()
    one, two = (symgen.reduced(mesh.x, mesh.mass, mesh.stiffness, mesh.ends, 3) for _ in range(2))
    np.testing.assert_array_equal(one.shapes, two.shapes)


@pytest.mark.by_turns(3)
@pytest.mark.slow
def test_ten_thousand_nodes_take_some_memory():
    """Below 2 GB, in a process of its own, whose Python and SciPy are in it."""
    script = (
        "import resource, symgen\nfrom benchmarks.finite_elements import solid\n"
        "mesh = solid((1.0, 0.1, 0.1), (62, 4, 4), young=2e11, density=7850.0)\n"
        "symgen.reduced(mesh.x, mesh.mass, mesh.stiffness, mesh.ends, 6)\n"
        "print(resource.getrusage(resource.RUSAGE_SELF).ru_maxrss)"
    )
    root = Path(__file__).resolve().parents[3]
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=True, cwd=root)
    assert int(done.stdout) < 2e6


@pytest.mark.by_turns(3)
@pytest.mark.slow
def test_ten_thousand_nodes_take_some_seconds():
    """Below 10 s of a processor; frequencies of the free body are those that eigsh finds of all unknowns."""
    mesh = solid((1.0, 0.1, 0.1), (62, 4, 4), young=2e11, density=7850.0)
    assert len(mesh.x) > 10_000
    begin = time.thread_time()
    body = symgen.reduced(mesh.x, mesh.mass, mesh.stiffness, mesh.ends, 6)
    assert time.thread_time() - begin < 10.0
    shifted = sparse.csc_array(mesh.stiffness + 1e4 * mesh.mass)
    whole = np.sort(eigsh(shifted, 8, mesh.mass, sigma=0.0, return_eigenvectors=False))
    exact = np.sqrt(whole[6:] - 1e4) / 2.0 / np.pi
    free = symgen.reduced(mesh.x, mesh.mass, mesh.stiffness, inner=2)
    np.testing.assert_allclose(free.frequencies, exact, rtol=1e-6)
    errors = np.abs(body.frequencies[:2] / exact - 1.0)
    assert errors[0] < 2e-3 and errors[1] < 1e-2  # the second one has less of its modes


# -- sentences ---------------------------------------------------------------------------------------------------------


def changed(matrix, i, j, value):
    full = matrix.toarray()
    full[i, j] += value
    return full


MESH = straight(count=4)
N = len(MESH.x)
MIDDLE = N // 2
LIGHT = MESH.mass.toarray()
LIGHT[2 * MIDDLE : 2 * MIDDLE + 2] = 0.0
LIGHT[:, 2 * MIDDLE : 2 * MIDDLE + 2] = 0.0
SPATIAL = arc()
WRONG = {
    "held": (
        {"K": changed(MESH.stiffness, 0, 0, 1e9)},
        "K: expected the stiffness of a body that nothing holds, got one that holds it against translation along x",
    ),
    "skew": ({"K": changed(MESH.stiffness, 0, 3, 1e9)}, "K: expected a symmetric matrix"),
    "skew M": ({"M": changed(MESH.mass, 0, 3, 1.0)}, "M: expected a symmetric matrix"),
    "negative": ({"K": -MESH.stiffness}, "K: expected a matrix without negative entries on its diagonal"),
    "nan": ({"K": changed(MESH.stiffness, 2, 2, np.nan)}, "K: expected finite entries, got nan"),
    "zero": ({"K": 0.0 * MESH.stiffness}, "K: expected a stiffness, got zeros"),
    "no density": (
        {"M": 0.0 * MESH.mass},
        "M: expected a mass above 0, got 0 kg; the density of the material is missing",
    ),
    "no mass": ({"M": LIGHT}, f"M: expected a mass for each node that is in no interface, got none at node {MIDDLE}"),
    "sizes": ({"M": np.eye(5), "K": np.eye(5)}, "M: expected 2 or 3 unknowns a node"),
    "oblong": ({"K": np.zeros((4, 6))}, "K: expected a square matrix"),
    "nodes": ({"nodes": np.zeros((3, 4))}, "nodes: expected places of two nodes or more"),
    "nodes nan": ({"nodes": np.where(MESH.x == 0.0, np.nan, MESH.x)}, "nodes: expected finite places"),
    "twice": (
        {"interfaces": {"a": [0, 1, 2], "b": [2, 3]}},
        "interfaces['b']: expected nodes of no other interface, got node 2, which is in 'a'",
    ),
    "unknown": ({"interfaces": {"a": [0, N]}}, f"interfaces['a']: expected nodes from 0 to {N - 1}, got node {N}"),
    "name": ({"interfaces": {"1a": [0, 1]}}, "interfaces: expected an interface name"),
    "taken name": (
        {"interfaces": {"ex": [0, 1]}},
        "interfaces: expected another name, got 'ex', which a modal body has",
    ),
    "one node": (
        {"interfaces": {"a": [0]}, "inner": 2},
        "expected two nodes or more, as nodes of solids do not turn, got 1 node; its turn is undetermined",
    ),
    "many": ({"inner": 41}, "inner: expected 1 to 40 modes in all, got 41"),
    "many with interfaces": (
        {"interfaces": MESH.ends, "inner": 38},
        "inner: expected 1 to 40 modes in all, got 41: 3 modes of 2 interfaces and inner = 38",
    ),
    "none": ({"inner": 0}, "inner: expected 1 to 40 modes in all, got 0"),
    "units": (
        {"nodes": 400.0 * MESH.x, "M": 1e-9 * MESH.mass},
        "nodes, M: expected SI units: metres, kilograms, seconds, got 4e-10 kg in a body of 400 m; tonnes and mm?",
    ),
    "row": ({"rows": {"sigma": np.ones(3)}}, "rows['sigma']: expected a number for each of the"),
    "row name": (
        {"rows": {"m1": np.ones(2 * N)}},
        "rows['m1']: expected another name, got 'm1', which the body has already",
    ),
    "row unit": ({"rows": {"s": (np.ones(2 * N), "furlong")}}, "rows['s']: expected a unit"),
    "row of another table": (
        {"rows": {"s": {"node": 3}}, "interfaces": MESH.ends},
        "rows['s']: expected a node and the interface that it is seen from, {'node': 40, 'from': 'base'}",
    ),
    "row from nowhere": (
        {"rows": {"s": {"node": 3, "from": "rot"}}, "interfaces": MESH.ends},
        "rows['s']['from']: expected an interface: root, tip, got 'rot'; did you mean 'root'?",
    ),
    "row from the ground": (
        {"rows": {"s": {"node": 3, "from": "ground"}}, "interfaces": MESH.ends},
        "got 'ground'; make the node an interface, whose place in the ground formulas read",
    ),
    "row of an unknown node": (
        {"rows": {"s": {"node": N, "from": "root"}}, "interfaces": MESH.ends},
        f"rows['s']['node']: expected a whole number from 0 to {N - 1}",
    ),
    "outline": ({"outline": [[0, N]]}, f"outline[0]: expected nodes from 0 to {N - 1}, got {N}"),
}


@pytest.mark.parametrize("name", WRONG)
def test_what_is_wrong_is_said_in_a_sentence(name):
    changes, sentence = WRONG[name]
    given = {"nodes": MESH.x, "M": MESH.mass, "K": MESH.stiffness, "inner": 2} | changes
    with pytest.raises(InputError) as error:
        symgen.reduced(**given)
    assert sentence in str(error.value) and "\n" not in str(error.value)


def test_nodes_in_a_line_leave_a_turn_open_in_space():
    line = SPATIAL.start[:3]
    with pytest.raises(InputError, match="three nodes or more that are not in a line, as nodes of solids do not turn"):
        symgen.reduced(SPATIAL.x, SPATIAL.mass, SPATIAL.stiffness, {"a": line}, 2)


def test_a_part_that_is_loose_is_refused():
    bar = slender(count=4)
    k = sparse.block_diag([bar.stiffness, bar.stiffness]).tocsc()
    m = sparse.block_diag([bar.mass, bar.mass]).tocsc()
    x = np.vstack([bar.x, bar.x + np.array([0.0, 0.5])])
    with pytest.raises(InputError, match="K: expected a stiffness"):
        symgen.reduced(x, m, k, {"a": [0], "b": [4]}, 2)


def test_a_name_of_another_kind_is_refused(tmp_path):
    body = symgen.reduced(MESH.x, MESH.mass, MESH.stiffness, inner=1)
    with pytest.raises(InputError, match=r"path: expected a name that ends in \.npz"):
        body.save(tmp_path / "body.mat")
    assert body.save(tmp_path / "body.npz").stat().st_size < 40_000

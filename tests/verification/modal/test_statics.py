"""Loads at rest: against all of K, and against the formulas of a cantilever; and the limit of a stiff body."""

import numpy as np
import pytest
from support.modal_machines import arc, machine, reduce_to, slender, straight

CANTILEVER = """
[bodies.arm]
type = "modal"
file = "arm.npz"
damping = 0.1

[joints.wall]
type = "rigid"
between = ["ground", "arm.root"]
at = [{root}, {zero}]

[forces.load]
type = "force"
body = "arm.tip"
at = {zero}
force = {force}
"""


def at_rest(folder, space, force, root, **run):
    """A cantilever after five seconds of strong damping."""
    text = CANTILEVER.format(zero=[0.0] * len(force), force=force, root=root)
    model = machine(folder, text, space, until=5.0, output_step=5.0)
    return model, model.simulate(integrator="radau5", rtol=1e-9, atol=1e-12, **run)


@pytest.mark.slow
def test_a_cantilever_sinks_and_is_stressed_as_in_books(tmp_path):
    """P L^3 / 3 E I to 2e-3 and M h / 2 I to 2e-4."""
    mesh, second = straight(), 0.02 * 0.02**3 / 12.0
    cell = mesh.cells[10]
    row = mesh.stress(10, (0.0, 1.0), np.array([1.0, 0.0]))
    reduce_to(tmp_path / "arm.npz", mesh, 2, rows={"sigma": (row, "Pa")})
    _, result = at_rest(tmp_path, "planar", [0.0, 1.0], [0.0, 0.0])
    assert result["arm.tip.y"][-1] == pytest.approx(1.0 / (3.0 * 2e9 * second), rel=2e-3)
    arm = 1.0 - float(mesh.x[cell].mean(axis=0)[0])
    assert result["arm.sigma"][-1] == pytest.approx(-arm * 0.01 / second, rel=2e-4)
    assert result.outputs.unit("arm.sigma") == "Pa"


def test_nodes_with_turns_make_a_cantilever(tmp_path):
    """Bars of Euler and Bernoulli are exact for a load at the tip."""
    reduce_to(tmp_path / "arm.npz", slender(), 0)
    _, result = at_rest(tmp_path, "planar", [0.0, 1.0], [0.0, 0.0])
    second = 0.02**4 / 12.0
    assert result["arm.tip.y"][-1] == pytest.approx(1.0 / (3.0 * 2e9 * second), rel=2e-4)
    assert result["arm.tip.theta"][-1] == pytest.approx(1.0 / (2.0 * 2e9 * second), rel=2e-4)


@pytest.mark.parametrize("make", [slender, straight])
def test_a_row_says_from_where_it_measures(make, tmp_path):
    """The middle of a cantilever seen from its root, 5 P L^3 / 48 E I; from mean axes it moves by a part of that."""
    mesh = make()
    middle = int(np.argmin(np.linalg.norm(mesh.x - [0.5, 0.0], axis=1)))
    plain = np.zeros(mesh.mass.shape[0])
    plain[mesh.mass.shape[0] // len(mesh.x) * middle + 1] = 1.0
    rows = {"seen": {"node": middle, "from": "root"}, "mean": (plain, "m")}
    reduce_to(tmp_path / "arm.npz", mesh, 2, rows=rows)
    _, result = at_rest(tmp_path, "planar", [0.0, 1.0], [0.0, 0.0])
    exact = 5.0 / (48.0 * 2e9 * 0.02**4 / 12.0)
    assert result["arm.seen2"][-1] == pytest.approx(exact, rel=2e-3) and abs(result["arm.seen1"][-1]) < 1e-3 * exact
    assert abs(result["arm.mean"][-1]) < 0.5 * exact and result.outputs.unit("arm.seen2") == "m"


@pytest.mark.slow
def test_a_curved_body_in_space_gives_as_all_of_k_does(tmp_path):
    """To 1e-6 of the displacement, under a load so small that nothing turns."""
    mesh = arc()
    reduce_to(tmp_path / "arm.npz", mesh, 0)
    force = [0.3e-3, -0.5e-3, 1.0e-3]
    root, tip = (mesh.x[each].mean(axis=0) for each in (mesh.start, mesh.end))
    _, result = at_rest(tmp_path, "spatial", force, root.tolist())
    moved = np.array([result[f"arm.tip.{x}"][-1] for x in "xyz"]) - tip
    n, k = len(mesh.x), mesh.stiffness
    free = np.setdiff1d(np.arange(n), np.concatenate([mesh.start, mesh.end]))
    places = np.concatenate(
        [(free[:, None] * 3 + np.arange(3)).ravel(), (mesh.end[:, None] * 3 + np.arange(3)).ravel()]
    )
    links = np.zeros((3 * len(mesh.end), 6))
    for i, node in enumerate(mesh.end):
        away = mesh.x[node] - tip
        turned = np.array([np.cross(axis, away) for axis in np.eye(3)]).T
        links[3 * i : 3 * i + 3] = np.hstack([np.eye(3), turned])
    basis = np.zeros((len(places), 3 * len(free) + 6))
    basis[: 3 * len(free), : 3 * len(free)] = np.eye(3 * len(free))
    basis[3 * len(free) :, 3 * len(free) :] = links
    reduced = basis.T @ (k[places][:, places] @ basis)
    load = np.zeros(len(reduced))
    load[-6:-3] = force
    expected = np.linalg.solve(reduced, load)[-6:-3]
    np.testing.assert_allclose(moved, expected, atol=1e-6 * np.linalg.norm(expected))


RIGID = """
[bodies.arm]
type = "rigid"
mass = {mass!r}
inertia = {inertia}
centre_of_mass = {centre}

[joints.pin]
type = "spherical"
between = ["ground", "arm"]
at = [{root}, {root}]
"""
BENT = """
[bodies.arm]
type = "modal"
file = "arm.npz"

[joints.pin]
type = "spherical"
between = ["ground", "arm.root"]
at = [{root}, [0.0, 0.0, 0.0]]
"""


@pytest.mark.slow
def test_a_stiff_body_moves_as_a_rigid_one(tmp_path):
    """1e-6 m at E = 2e11 Pa after 0.1 s of a pendulum in space; the difference falls as 1 / E."""
    youngs, apart = (2e9, 2e10, 2e11), []
    for young in youngs:
        mesh = arc(young)
        body = reduce_to(tmp_path / "arm.npz", mesh, 0)
        root = mesh.x[mesh.start].mean(axis=0).tolist()
        settings = {"integrator": "dop853", "rtol": 1e-11, "atol": 1e-13}
        start = {"arm.wz": 3.0}
        own = machine(tmp_path, BENT.format(root=root), "spatial", "[0.0, 0.0, -9.81]")
        bent = own.simulate(start=start, **settings)
        text = RIGID.format(mass=body.mass, inertia=body.inertia.tolist(), centre=body.centre.tolist(), root=root)
        rigid = machine(tmp_path, text, "spatial", "[0.0, 0.0, -9.81]", name="rigid").simulate(start=start, **settings)
        apart.append(max(np.abs(bent[f"arm.{x}"] - rigid[f"arm.{x}"]).max() for x in "xyz"))
    assert apart[-1] < 1e-6
    slope = np.polyfit(np.log(youngs), np.log(apart), 1)[0]
    assert slope == pytest.approx(-1.0, abs=0.05), apart

"""Bodies of bars that loads stiffen and soften: closed forms, published frequencies, invariants and sentences."""

import numpy as np
import pytest
from scipy import sparse
from support.modal_machines import arc, machine, slender

import symgen
from benchmarks.finite_elements import bar_frame
from symgen.base.errors import InputError
from tests.result.targets.compilers import compiled, written
from tests.result.targets.test_c import rows_of
from verification.modal.test_limits_inside import WIDE, YOUNG, mast, pushed_strip, strip_by_closed_form

STIFF = 2e9 * 0.02**4 / 12.0  # E I of the slender bar of one metre


@pytest.mark.parametrize("joint", ["rigid", "revolute"])
def test_a_strip_held_at_both_ends(joint, tmp_path):
    """A strip of 2 mm, to a deflection of 0.9 times its thickness, where linear modes are off by two thirds."""
    for share in (0.05, 0.4, 1.0, 1.5):
        force = (192.0 if joint == "rigid" else 48.0) * YOUNG * WIDE * 0.002**3 / 12.0 * share * 0.002
        (_, middle), said = pushed_strip(tmp_path, 0.002, force, joint, stiffening="interfaces")
        assert middle == pytest.approx(strip_by_closed_form(0.002, force, joint), rel=6e-3) and not said


STRUT = """
[bodies.arm]
type = "modal"
file = "arm.npz"

[bodies.shoe]
mass = 0.2
inertia = 1e-3
position = [1.0, 0.0]

[joints.pin]
type = "{joint}"
between = ["ground", "arm.root"]
at = [[0.0, 0.0], [0.0, 0.0]]

[joints.guide]
type = "translational"
between = ["ground", "shoe"]
at = [[0.0, 0.0], "centre"]
axis = [1.0, 0.0]

[joints.end]
type = "revolute"
between = ["shoe", "arm.tip"]
at = ["centre", [0.0, 0.0]]

[forces.push]
type = "force"
body = "shoe"
at = "centre"
force = [{push!r}, 0.0]

[forces.aside]
type = "force"
body = "arm.middle"
at = [0.0, 0.0]
force = [0.0, 1.0]
"""


@pytest.mark.slow
def test_a_strut_to_nine_tenths_of_eulers_load(tmp_path):
    """Thrusts and pulls between pins: the middle under a load across is in closed form."""
    mesh = slender()
    faces = mesh.ends | {"middle": np.array([10])}
    symgen.reduced(mesh.x, mesh.mass, mesh.stiffness, faces, 3, stiffening="interfaces").save(tmp_path / "arm.npz")
    for share in (-1.0, -0.3, 0.1, 0.3, 0.5, 0.7, 0.9):
        push = -share * np.pi**2 * STIFF
        model = machine(tmp_path, STRUT.format(push=float(push), joint="revolute"))
        rest = model.equilibrium()
        m = np.array([rest.q[f"arm.m{i}"] for i in range(1, 10)])
        carried = model.mechanism.body("arm.middle").carried
        place = np.array(carried.place) + m @ np.array(carried.shape) + m @ np.array(carried.curve).T @ m
        c, s, k = np.cos(rest.q["arm.theta"]), np.sin(rest.q["arm.theta"]), np.sqrt(complex(-push / STIFF))
        exact = ((np.tan(k / 2.0) - k / 2.0) / (2.0 * k**3 * STIFF)).real
        assert rest.q["arm.y"] + s * place[0] + c * place[1] == pytest.approx(exact, rel=4e-3), share
        assert not [note for note in rest.notes if "limits of its parts" in note]


def test_a_mast_under_weight(tmp_path):
    """To 0.56 of Euler's load: no interface has the top, whose weight softens the mast by its second order alone."""
    for mass in (0.05, 0.4, 1.0, 3.0):
        sway, said = mast(tmp_path, mass, 0.05, stiffening="interfaces")
        weight, k = 9.81 * mass, np.sqrt(9.81 * mass / (YOUNG * 4.5e-11))
        assert sway == pytest.approx(0.05 * mass / weight * (np.tan(0.5 * k) / k - 0.5), rel=3e-3) and not said


BLADE = """
[bodies.hub]
mass = 1.0
inertia = 1.0

[bodies.arm]
type = "modal"
file = "arm.npz"
damping = 2e-3
start = {{ vm1 = 1e-3 }}

[joints.pin]
type = "revolute"
between = ["ground", "hub"]
at = [[0.0, 0.0], "centre"]

[joints.motor]
type = "driver"
joint = "pin"
value = "{rate!r}*t"

[joints.wall]
type = "rigid"
between = ["hub", "arm.root"]
at = ["centre", [0.0, 0.0]]
"""


@pytest.mark.fast("2.0")
@pytest.mark.parametrize(
    ("speed", "flap"), [(1.0, 3.6817), (2.0, 4.1373), (3.0, 4.7973), (6.0, 7.3604)], ids=["1.0", "2.0", "3.0", "6.0"]
)
def test_a_blade_rings_as_published(speed, flap, tmp_path):
    """Flapping of A. D. Wright, C. E. Smith, R. W. Thresher, J. L. C. Wang, J. Appl. Mech. 49 (1982) 197-202.

    In the plane of the turn its square is less by that of the speed. One interface carries the blade, whose damping
    leaves the first mode, by 3 %.
    """
    mesh = slender()
    faces = {"root": np.array([0])}
    symgen.reduced(mesh.x, mesh.mass, mesh.stiffness, faces, 4, stiffening="interfaces").save(tmp_path / "arm.npz")
    unit = np.sqrt(STIFF / 0.4)
    lag = np.sqrt(flap**2 - speed**2) * unit
    settings = {"until": float(9.0 * np.pi / lag), "output_step": float(np.pi / lag / 40)}
    result = machine(tmp_path, BLADE.format(rate=float(speed * unit)), **settings).simulate(rtol=1e-9, atol=1e-14)
    bend, t = result["arm.m1"], result.t
    crossed = np.flatnonzero(bend[:-1] * bend[1:] < 0.0)
    times = t[crossed] - bend[crossed] * np.diff(t)[crossed] / np.diff(bend)[crossed]
    assert np.pi / np.mean(np.diff(times[-5:])) == pytest.approx(lag, rel=5e-3) and result.status == "ok"


@pytest.mark.by_turns(2)
@pytest.mark.slow
def test_a_free_frame_in_space_keeps_its_energy(tmp_path):
    """A bent bar on a ball joint, turned by large angles: interfaces of second order do the work that inertia has."""
    x = np.zeros((17, 3))
    x[:9, 0], x[9:, 0] = np.linspace(0.0, 0.5, 9), 0.5
    x[9:, 1] = np.linspace(0.05, 0.4, 8)
    mesh = bar_frame(x, 2e9, 4e-4, (1.3e-8, 2e-8), 1000.0, 2e-8, 8e8)
    body = symgen.reduced(x, mesh.mass, mesh.stiffness, mesh.ends, 3, stiffening="interfaces")
    body.save(tmp_path / "arm.npz")
    text = '[bodies.arm]\ntype = "modal"\nfile = "arm.npz"\n\n[joints.ball]\ntype = "spherical"\n'
    text += 'between = ["ground", "arm.root"]\nat = [[0.0, 0.0, 0.0], [0.0, 0.0, 0.0]]\n'
    text += '\n[bodies.bob]\nmass = 0.3\ninertia = [1e-3, 1e-3, 1e-3]\n\n[joints.tip]\ntype = "rigid"\n'
    text += 'between = ["bob", "arm.tip"]\nat = ["centre", [0.0, 0.0, 0.0]]\n'
    text += '\n[outputs]\nx = "arm.tip.x"\ny = "arm.tip.y"\nz = "arm.tip.z"\n'
    model = machine(tmp_path, text, space="spatial", gravity="[0.0, 0.0, -9.81]", until=0.3, output_step=0.01)
    result = model.simulate(rtol=1e-10, atol=1e-12)
    assert result.status != "failed", result.reason
    assert np.abs(result.energy["error"]).max() < 1e-9 * np.ptp(result.energy["kinetic"])
    for name in "xyz":  # the frame that equations have, and the one of places
        np.testing.assert_allclose(result[name], result[f"bob.{name}"], atol=1e-9)


@pytest.mark.parametrize(
    ("mesh", "keys", "said"),
    [
        (arc(), {"stiffening": "interfaces"}, "K: expected bars from node to node, whose nodes turn, for stiffening ="),
        (
            slender(),
            {"stiffening": "loads"},
            "stiffening: expected 'interfaces', or None for linear modes, got 'loads'",
        ),
        (slender(), {"stiffening": 1}, "stiffening: expected 'interfaces', or None for linear modes, got"),
    ],
    ids=["solid", "name", "number"],
)
def test_what_cannot_be_stiffened_is_said(mesh, keys, said):
    with pytest.raises(InputError) as error:
        symgen.reduced(mesh.x, mesh.mass, mesh.stiffness, mesh.ends, 2, **keys)
    assert said in str(error.value)


def test_elements_of_three_nodes_are_no_bars():
    """Three nodes of a bar whose middle one is eliminated, beside one of two nodes."""
    mesh = slender(count=4)
    k = mesh.stiffness.toarray()
    keep = np.r_[0:6, 9:15]
    k = k[np.ix_(keep, keep)] - k[np.ix_(keep, np.arange(6, 9))] @ np.linalg.solve(
        k[6:9, 6:9], k[np.ix_(np.arange(6, 9), keep)]
    )
    x = mesh.x[[0, 1, 3, 4]]
    assert symgen.reduced(x, np.eye(12), k, {"a": [0]}, 2, stiffening="interfaces").inner == 2
    shells = np.zeros((9, 9))
    ties = np.random.default_rng(3).standard_normal((6, 9))
    rigid = np.zeros((9, 3))
    rigid[0::3, 0] = rigid[1::3, 1] = rigid[2::3, 2] = 1.0
    places = np.array([[0.0, 0.0], [1.0, 0.0], [0.3, 0.8]])
    rigid[0::3, 2], rigid[1::3, 2] = -places[:, 1], places[:, 0]
    ties -= ties @ rigid @ np.linalg.solve(rigid.T @ rigid, rigid.T)
    shells += ties.T @ ties
    with pytest.raises(InputError, match="elements that join more than two nodes"):
        symgen.reduced(places, np.eye(9), sparse.csc_array(shells), {"a": [0]}, 2, stiffening="interfaces")


def swung(folder, **run):
    """A pendulum of bars with a payload of m kg, which weight bends by second order too."""
    mesh = slender()
    keys = {"stiffening": "interfaces"}
    symgen.reduced(mesh.x, mesh.mass, mesh.stiffness, mesh.ends, 2, **keys).save(folder / "arm.npz")
    text = '[parameters]\nm = 0.1\n\n[bodies.arm]\ntype = "modal"\nfile = "arm.npz"\n\n[bodies.bob]\nmass = "m"\n'
    text += (
        'inertia = 1e-4\nposition = [1.0, 0.0]\n\n[joints.pin]\ntype = "revolute"\nbetween = ["ground", "arm.root"]\n'
    )
    text += 'at = [[0.0, 0.0], [0.0, 0.0]]\n\n[joints.end]\ntype = "rigid"\nbetween = ["arm.tip", "bob"]\n'
    text += 'at = [[0.0, 0.0], "centre"]\n'
    return machine(folder, text, gravity="[0.0, -9.81]", until=0.02, output_step=0.01, **run)


@pytest.mark.by_turns(2)
@pytest.mark.slow
def test_derivatives_follow_the_second_order(tmp_path):
    """By the payload's mass, beside a central difference."""
    model = swung(tmp_path)
    settings = {"rtol": 1e-10, "atol": 1e-13, "integrator": "dop853"}
    own = model.simulate(sensitivities=["m"], **settings)
    more, less = (model.simulate(parameters={"m": m}, **settings)["bob.y"][-1] for m in (0.101, 0.099))
    assert own.gradient("bob.y").row()["m"] == pytest.approx((more - less) / 0.002, rel=1e-4)


@pytest.mark.by_turns(2)
@pytest.mark.slow
def test_a_program_in_c_follows_the_second_order(tmp_path):
    model = swung(tmp_path, step=1e-5)
    keys = {"method": "direct-correction", "integrator": "rk4", "step": 1e-5, "shape": "straight", "verify": False}
    names, rows = rows_of(compiled(written(model.mechanism, tmp_path, coordinates="absolute")), "0.02")
    result = model.simulate(until=0.02, **keys)
    end = np.concatenate([result.q.values[-1], result.v.values[-1]])
    assert "arm.m5" in names
    np.testing.assert_allclose(rows[-1, 1 : len(end) + 1], end, rtol=1e-10, atol=1e-12)

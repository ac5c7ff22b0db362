"""Where linear modes do not hold: beams give the error, and no run with an error above 3 % is ok."""

import numpy as np
import pytest
from support.modal_machines import machine, reduce_to, slender

import symgen
from benchmarks.finite_elements import solid

# -- Simo and Vu-Quoc's spin-up ----------------------------------------------------------------------------------------

AXIAL, BENDING, HEAVY = 2.8e7, 1.4e4, 1.2
MOTOR = "0.4*(t**2/2 + (7.5/pi)**2*(cos(2*pi*t/15) - 1)) if t < 15 else 6*t - 45"


def spin_up(folder, count):
    """The beam of the catalogue's machine as some modal bodies in a row, rigidly joined."""
    height, length = np.sqrt(12.0 * BENDING / AXIAL), 10.0 / count
    bar = solid((length, height), (max(4, 40 // count), 1), young=AXIAL / height, poisson=0.0, density=HEAVY / height)
    reduce_to(folder / "part.npz", bar, 2)
    parts = ["[bodies.hub]\nmass = 1.0\ninertia = 1.0\n"]
    parts += [
        '[joints.pin]\ntype = "revolute"\nbetween = ["ground", "hub"]\nat = [[0.0, 0.0], "centre"]\n',
        f'[joints.motor]\ntype = "driver"\njoint = "pin"\nvalue = "{MOTOR}"\n',
    ]
    before = "hub"
    for i in range(count):
        parts.append(f'[bodies.b{i}]\ntype = "modal"\nfile = "part.npz"\nposition = [{length * i!r}, 0.0]\n')
        parts.append(
            f'[joints.j{i}]\ntype = "rigid"\nbetween = ["{before}", "b{i}.root"]\nat = [[0.0, 0.0], [0.0, 0.0]]\n'
        )
        before = f"b{i}.tip"
    parts.append(f'[outputs]\nlag = "-sin(hub.theta)*{before}.x + cos(hub.theta)*{before}.y"\n')
    parts.append(f'stretch = "cos(hub.theta)*{before}.x + sin(hub.theta)*{before}.y - 10"\n')
    model = machine(folder, "\n".join(parts), until=15.0, output_step=0.1, name=f"spin{count}")
    settings = {"integrator": "radau5", "rtol": 1e-7, "atol": 1e-8, "max_energy_error": 1.0, "verify": False}
    return model.simulate(**settings)


@pytest.mark.by_turns(3)
@pytest.mark.slow
def test_the_spin_up_converges_and_one_body_is_not_ok(tmp_path):
    """Order 2 in the number of bodies against exact beams; with 8 the lag at 6.5 s is that of two discretisations."""
    beams = symgen.load("spin-up").simulate(until=15.0, output_step=0.1)
    results = {count: spin_up(tmp_path, count) for count in (1, 2, 4, 8)}
    apart = {count: np.abs(r["lag"] - beams["lag"]).max() for count, r in results.items()}
    assert apart[1] == pytest.approx(0.211, rel=0.05) and apart[8] < 5e-3
    for count in (1, 2, 4):
        assert 3.5 < apart[count] / apart[2 * count] < 4.2, apart
    assert float(np.interp(6.5, beams.t, beams["lag"])) == pytest.approx(-0.5699484, abs=2e-4)
    assert float(np.interp(6.5, results[8].t, results[8]["lag"])) == pytest.approx(-0.5699484, abs=2e-3)
    stretch = float(results[8]["stretch"][-1])
    assert stretch == pytest.approx(5.14e-4, rel=0.05)
    for count, share in ((1, "5.1"), (2, "1.3"), (4, "0.32")):
        assert results[count].status == "unverified"
        assert f"interface b0.root carries 2.16e+03 N, {share} times k_t L" in results[count].reason
    assert results[8].status == "ok", results[8].reason


# -- ten machines, each with one modal body and with 16 beam elements --------------------------------------------------

SIDE, YOUNG, DENSITY = 0.02, 2e9, 1000.0
BEAM = f"""
[beams.arm]
start = [0.0, 0.0]
end = [1.0, 0.0]
elements = 16
section = {{ width = {SIDE}, height = {SIDE} }}
material = {{ young = {YOUNG}, poisson = 0.0, density = {DENSITY} }}
damping = 2e-4
"""
MODAL = """
[bodies.arm]
type = "modal"
file = "arm.npz"
damping = 2e-4
"""
#: Joints and forces where ROOT and TIP are ends; and the share of k_t L or the turn that the machine has about.
CLAMPED = '[joints.wall]\ntype = "rigid"\nbetween = ["ground", ROOT]\nat = [[0.0, 0.0], ROOT_AT]\n'
PINNED = '[joints.pin]\ntype = "revolute"\nbetween = ["ground", ROOT]\nat = [[0.0, 0.0], ROOT_AT]\n'
SLIDING = (
    "[bodies.shoe]\nmass = 0.2\ninertia = 1e-3\nposition = [1.0, 0.0]\n"
    '[joints.guide]\ntype = "translational"\nbetween = ["ground", "shoe"]\nat = [[0.0, 0.0], "centre"]\n'
    "axis = [1.0, 0.0]\n"
    '[joints.end]\ntype = "revolute"\nbetween = ["shoe", TIP]\nat = ["centre", TIP_AT]\n'
)
ASIDE = '[forces.aside]\ntype = "force"\nbody = MID\nat = MID_AT\nforce = [0.0, "0.5*min(1, t/0.2)"]\n'
TURNING = '[joints.motor]\ntype = "driver"\njoint = "pin"\nvalue = "{rate}*(t - 0.1*(1 - exp(-t/0.1)))"\n'
HUB = (
    '[bodies.hub]\nmass = 1.0\ninertia = 1.0\n[joints.pin]\ntype = "revolute"\nbetween = ["ground", "hub"]\n'
    'at = [[0.0, 0.0], "centre"]\n[joints.wall]\ntype = "rigid"\nbetween = ["hub", ROOT]\nat = ["centre", ROOT_AT]\n'
)
K = 3.0 * YOUNG * SIDE**4 / 12.0  # of a cantilever one metre long, times its length


def push(x, y, where="TIP"):
    force = f'["{x}*min(1, t/0.2)", "{y}*min(1, t/0.2)"]'
    return f'[forces.push]\ntype = "force"\nbody = {where}\nat = {where}_AT\nforce = {force}\n'


TEN = {
    "a light load across": CLAMPED + push(0.0, 0.02 * K),
    "a heavy load across": CLAMPED + push(0.0, 0.2 * K),
    "a column under a twentieth": CLAMPED + push(-0.05 * K, 0.01 * K),
    "a column under a third": CLAMPED + push(-0.33 * K, 0.01 * K),
    "a stretched cantilever": CLAMPED + push(0.5 * K, 0.01 * K),
    "a strut under a little": PINNED + SLIDING + push(-0.035 * K, 0.0, '"shoe"') + ASIDE,
    "a strut under a third": PINNED + SLIDING + push(-0.33 * K, 0.0, '"shoe"') + ASIDE,
    "a slow blade": HUB + TURNING.format(rate=1.0),
    "a fast blade": HUB + TURNING.format(rate=12.0),
    "a blade at speed": HUB + TURNING.format(rate=30.0),
}


def variant(text, modal):
    """The joints and forces with ends of a beam, or with interfaces of a modal body."""
    parts = {"ROOT": ("start", "arm.root"), "TIP": ("end", "arm.tip"), "MID": ("8", "arm.middle")}
    for word, (node, interface) in parts.items():
        text = text.replace(f"{word}_AT", "[0.0, 0.0]" if modal else f'"{node}"')
        text = text.replace(word, f'"{interface}"' if modal else '"arm"')
    return text.replace('"shoe"_AT', '"centre"')


def bend(result, ends):
    """How far the tip is from the line of the root's direction, and along it."""
    (x, y, angle), (u, w) = ends
    x, y, angle, u, w = (result[name] for name in (x, y, angle, u, w))
    c, s = np.cos(angle), np.sin(angle)
    return -s * (u - x) + c * (w - y)


@pytest.mark.by_turns(16)
@pytest.mark.slow
@pytest.mark.parametrize("name", TEN)
def test_no_run_with_an_error_above_three_percent_is_ok(name, tmp_path):
    """Errors are those of the deflection, of the middle for a strut, over the largest one of 16 beam elements."""
    mesh = slender(count=20)
    faces = mesh.ends | ({"middle": np.array([10])} if "strut" in name else {})
    symgen.reduced(mesh.x, mesh.mass, mesh.stiffness, faces, inner=3).save(tmp_path / "arm.npz")
    settings = {"integrator": "radau5", "rtol": 1e-7, "atol": 1e-9, "max_energy_error": 10.0, "verify": False}
    modal, beam = variant(MODAL + TEN[name], True), variant(BEAM + TEN[name], False)
    bent, exact = (
        machine(tmp_path, text, until=0.6, output_step=0.01, name=kind).simulate(**settings)
        for kind, text in (("modal", modal), ("beams", beam))
    )
    if "strut" in name:
        own, other = bent["arm.middle.y"], exact["arm.8.y"]
    else:
        other = bend(exact, (("arm.start.x", "arm.start.y", "arm.start.theta"), ("arm.end.x", "arm.end.y")))
        own = bend(bent, (("arm.root.x", "arm.root.y", "arm.root.theta"), ("arm.tip.x", "arm.tip.y")))
    error = np.abs(own - other).max() / np.abs(other).max()
    print(name, bent.status, error)
    assert exact.status != "failed" and bent.status != "failed"
    assert bent.status == "unverified" or error < 0.03, (error, bent.reason)

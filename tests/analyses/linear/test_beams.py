"""Beams at rest and about it: shapes, buckling and frequencies against closed forms and shooting.

The reference numbers were computed in two independent ways each (elliptic integrals, roots of determinants in 30
digits, Ritz's method, shooting and collocation of Reissner's equations), which agree to the digits that are given.
"""

import numpy as np
import pytest
from scipy.optimize import brentq
from support.beams import at_end, cantilever

from symgen import Model
from symgen.describe.files.builder import MechanismBuilder

#: (k L)^2 of a cantilever, the same under half of its buckling load.
FREE = np.array([3.516015268500151, 22.03449156466677, 61.6972144135491])
LOADED = np.array([2.534560216071, 21.105172354559, 60.919443045118])
#: Omega L^2 sqrt(rho A / E I): first flap frequencies, and the first lag frequency.
ROTATING = {
    2.0: (4.1373195730254, 3.6217969641241),
    6.0: (7.36037301931, 4.2632254201938),
    12.0: (13.170150487506, 5.4270492777898),
}


def place(equilibrium, axes="xy"):
    return np.array([equilibrium.q[f"rod.end.{axis}"] for axis in axes])


@pytest.mark.slow
def test_elastica_converges_with_fourth_order():
    errors = []
    for n in (4, 8, 16):
        model = cantilever(n, parameters={"P": 10.0}, forces={"tip": at_end(0.0, "P")})
        found = place(model.equilibrium())
        errors.append(float(np.hypot(*(found - (0.44500440224625, 0.8106090248803)))))
        if n == 8:
            slight = model.equilibrium(parameters={"P": 1.0})
            np.testing.assert_allclose(place(slight), (0.94356676371662, 0.30172077379981), atol=1.2e-6)
            assert abs(slight.q["rod.end.theta"] - 0.46135194971188) <= 2e-6
    # a trial whose F had no coupling of shear and stretch had 1.8e-5 and 1.1e-6
    assert errors[1] <= 5.5e-5 and errors[2] <= 3.5e-6
    slopes = -np.diff(np.log2(errors))
    assert np.all((slopes > 3.8) & (slopes < 4.2))


@pytest.mark.slow
def test_soft_beam_converges_with_fourth_order():
    """E A = 200 and G A = 80 beside E I = 1: stretch and shear matter; by shooting (DOP853, 1e-12)."""
    expected, errors = np.array([0.275417259584, 0.876892375944]), []
    for n in (4, 8):
        model = cantilever(n, axial=200.0, shear=80.0, forces={"tip": at_end(-3.0, 6.0)})
        errors.append(float(np.hypot(*(place(model.equilibrium()) - expected))))
    assert errors[1] <= 4.5e-5 and 3.8 < np.log2(errors[0] / errors[1]) < 4.2


@pytest.mark.slow
def test_end_moment_rolls_a_beam_to_a_circle():
    moment = {"type": "torque", "body": "rod.end", "torque": 2.0 * np.pi}
    rest = cantilever(8, axial=1e4, shear=1e4, forces={"moment": moment}).equilibrium()
    assert np.abs(place(rest)).max() <= 1e-14
    assert abs(rest.q["rod.end.theta"] - 2.0 * np.pi) <= 1e-13


@pytest.mark.slow
def test_catenary():
    """A cable of 1.2 m between two points 1 m apart, E A = 1000 N, 9.81 N/m: tension and sag in closed form."""
    arc = brentq(lambda a: 0.5 * a / np.sin(0.5 * a) - 1.2, 0.5, 4.0)
    ends = {"a": ("start", [0.0, 0.0]), "b": ("end", [1.0, 0.0])}
    pins = {
        name: {"type": "revolute", "between": ["ground", "rod"], "at": [at, node]} for name, (node, at) in ends.items()
    }
    keys = {"bending": 1e-6, "clamp": "", "arc": arc, "gravity": (0.0, -9.81)}
    rest = cantilever(32, axial=1000.0, joints=pins, **keys).equilibrium()
    assert rest.stability == "stable"
    assert abs(rest.multipliers["a.x"] - 4.5121590299354) <= 5e-5
    assert abs(rest.q["rod.16.y"] + 0.29782572912288) <= 2e-6


@pytest.mark.fast("8-9e-05")
@pytest.mark.parametrize(("elements", "bound"), [(8, 9e-5), (16, 4e-6)])
def test_frequencies_of_a_cantilever(elements, bound):
    found = np.sqrt(cantilever(elements, rotary=1e-9).modes().omega_squared[:3])
    assert abs(found[0] / FREE[0] - 1.0) <= bound
    assert np.abs(found / FREE - 1.0).max() <= {8: 8e-3, 16: 2.5e-4}[elements]


@pytest.mark.slow
def test_frequencies_fall_under_a_dead_load_and_vanish_where_the_beam_buckles():
    model = cantilever(16, parameters={"P": np.pi**2 / 8}, forces={"tip": at_end("-P", 0.0)})
    found = np.sqrt(model.modes(at="equilibrium").omega_squared[:3])
    assert abs(found[0] / LOADED[0] - 1.0) <= 1e-5
    assert np.abs(found[:2] / LOADED[:2] - 1.0).max() <= 2e-4
    assert np.abs(found / LOADED - 1.0).max() <= 2.5e-4
    # buckling: the load at which the square of the first frequency is 0
    squares = [
        model.modes(at="equilibrium", parameters={"P": share * np.pi**2 / 4}).omega_squared[0]
        for share in (0.999, 1.001)
    ]
    assert squares[0] > 0.0 > squares[1]


@pytest.mark.slow
def test_rotation_stiffens_a_beam():
    """Centrifugal loads in the rotating frame: along the beam for flapping, in its plane for lagging."""
    for across in ("0*y", "Om**2*y"):
        model = cantilever(16, parameters={"Om": 2.0}, load=("Om**2*x", across))
        for speed, (flap, lag) in ROTATING.items():
            square = model.modes(at="equilibrium", parameters={"Om": speed}).omega_squared[0]
            assert abs(np.sqrt(square) / (flap if across.startswith("0") else lag) - 1.0) <= 2e-4, (speed, across)


@pytest.mark.slow
def test_flutter_under_a_follower_force():
    """Beck's column: two frequencies meet at P = 20.050953618974 E I / L^2, where both are 11.015557640923."""
    follower = at_end("-P", 0.0, frame="body")
    model = cantilever(16, axial=1e7, rotary=1e-6, parameters={"P": 20.0}, forces={"tip": follower})
    growth, frequencies = [], []
    for share in (0.999, 1.001):
        values = model.modes(at="equilibrium", parameters={"P": share * 20.050953618974}).eigenvalues
        lowest = values[np.argsort(np.abs(values))][:4]
        growth.append(np.abs(lowest.real).max())
        frequencies.append(np.abs(lowest.imag).mean())
    assert growth[0] <= 1e-6 and growth[1] > 0.1
    assert np.abs(np.array(frequencies) / 11.015557640923 - 1.0).max() <= 2e-3


@pytest.mark.slow
def test_resultants_are_those_of_statics():
    """Force and moment in the middles of the elements of a cantilever under a weight: what equilibrium says of them."""
    model = cantilever(4, forces={"tip": at_end(0.5, -2.0)})
    rest = model.equilibrium()
    run = model.simulate(until=1e-9, step=1e-9, start={n: x for n, x in rest.q.items() if n.startswith("rod.")})
    end = place(rest)
    for k in range(1, 5):
        nodes = [(0.0, 0.0, 0.0)] if k == 1 else [tuple(rest.q[f"rod.{k - 1}.{c}"] for c in ("x", "y", "theta"))]
        nodes.append(tuple(rest.q[f"rod.{'end' if k == 4 else k}.{c}"] for c in ("x", "y", "theta")))
        x, y, angle = np.mean(nodes, axis=0)
        along, across = np.array([np.cos(angle), np.sin(angle)]), np.array([-np.sin(angle), np.cos(angle)])
        moment = (end[0] - x) * -2.0 - (end[1] - y) * 0.5
        found = [run.elements[f"rod.e{k}.{label}"][0] for label in ("N", "Q", "M")]
        np.testing.assert_allclose(found, [along @ (0.5, -2.0), across @ (0.5, -2.0), moment], atol=0.03)


def bend(elements):
    """Return the beam of Bathe and Bolourchi (1979): an arc of 45 degrees, radius 100, loaded across its plane."""
    builder = MechanismBuilder("bend", space="spatial").parameter("P", 300.0)
    end = (100.0 * np.sin(np.pi / 4), 100.0 * (1.0 - np.cos(np.pi / 4)), 0.0)
    stiff = {"axial": 1e7, "shear": 5e6, "torsion": 5e6 / 6, "bending": 1e7 / 12}
    keys = {"arc": np.pi / 4, "mass": 1.0, "rotary": (0.2, 0.1, 0.1), "clamp": "ground"}
    builder.beam("rod", start=(0.0, 0.0, 0.0), end=end, elements=elements, **stiff, **keys)
    return Model(builder.force("tip", **at_end(0.0, 0.0, "P")).build())


def princeton(elements):
    """Return the beam of the Princeton experiments under 13.345 N at 45 degrees."""
    builder = MechanismBuilder("princeton", space="spatial")
    stiff = {
        "axial": 2932146.2616,
        "shear": 932616.4954198474,
        "torsion": 3.221074016651942,
        "bending": (2.505852697877054, 39.84613284193922),
    }
    keys = {"mass": 0.1, "rotary": (2e-6, 1e-6, 1e-6), "clamp": "ground"}
    builder.beam("rod", start=(0.0, 0.0, 0.0), end=(0.508, 0.0, 0.0), elements=elements, **stiff, **keys)
    part = -13.345 * np.sqrt(0.5)
    return Model(builder.force("tip", **at_end(0.0, part, part)).build())


BEND = {300.0: (58.7791224897, 22.2447809454, 40.1918916701), 600.0: (47.1504385736, 15.6848005340, 53.4748587918)}
PRINCETON = (0.4792889914, -0.0140627917, -0.1525127250)


@pytest.mark.slow
def test_beams_in_space_bend_and_twist():
    model = bend(4)
    for load, expected in BEND.items():
        rest = model.equilibrium(parameters={"P": load})
        assert np.linalg.norm(place(rest, "xyz") - expected) <= {300.0: 6.5e-3, 600.0: 1.9e-2}[load]
    assert np.linalg.norm(place(princeton(4).equilibrium(), "xyz") - PRINCETON) <= 9e-6


@pytest.mark.by_turns(2)
@pytest.mark.slow
def test_beams_in_space_converge_with_fourth_order():
    model = bend(8)
    for load, expected in BEND.items():
        rest = model.equilibrium(parameters={"P": load})
        assert np.linalg.norm(place(rest, "xyz") - expected) <= {300.0: 4.1e-4, 600.0: 1.2e-3}[load]
    rest = princeton(8).equilibrium()
    assert np.linalg.norm(place(rest, "xyz") - PRINCETON) <= 6e-7
    e = [rest.q[f"rod.end.e{i}"] for i in range(4)]
    twist = np.arctan2(2.0 * (e[2] * e[3] + e[0] * e[1]), e[0] ** 2 - e[1] ** 2 + e[2] ** 2 - e[3] ** 2)
    assert abs(np.rad2deg(twist) + 3.27158589) <= 2e-4

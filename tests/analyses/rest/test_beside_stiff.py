"""What is soft, light or balanced is judged by itself, however stiff, heavy or quick what stands beside it is."""

import math

import numpy as np
import pytest
from numpy.testing import assert_allclose

from analyses import rods
from analyses.test_what_is_said import column
from symgen.base.errors import InputError

#: Stiffness [N/m] of a spring that has nothing to do with the rest.
STIFF = [1e2, 1e12]
WAYS = [{}, {"coordinates": "joint"}, {"shape": "looped"}]


def beside(stiffness, mass=0.01):
    """A block that a stiff spring holds on a rail: body, joint and force."""
    block = {"mass": mass, "inertia": 1.0, "position": [2.0, 0.0]}
    rail = {**rods.pin("ground", "block", [2.0, 0.0], "centre", "translational"), "axis": [1.0, 0.0]}
    spring = {"type": "spring-damper", "between": ["ground", "block"], "at": [[1.0, 0.0], "centre"]}
    return block, rail, {**spring, "stiffness": stiffness, "free_length": 1.0}


@pytest.mark.fast("{}-1000000000000.0", "{'coordinates': 'joint'}-100.0")
@pytest.mark.parametrize("stiffness", STIFF)
@pytest.mark.parametrize("way", WAYS, ids=str)
def test_a_rod_beside_a_stiff_spring(stiffness, way):
    """It falls from its head and hangs below with 1.5 g / L, which is little beside the block's k / m."""
    block, rail, spring = beside(stiffness)
    for angle, word in ((0.5 * math.pi, "unstable"), (-0.5 * math.pi, "stable")):
        rod = {**rods.ROD, "angle": angle, "position": [0.0, math.copysign(0.5, angle)]}
        joints = {"pin": rods.pin("ground", "rod", rods.GROUND2, "A"), "rail": rail}
        found = rods.model({"rod": rod, "block": block}, joints, forces={"spring": spring}).equilibrium(**way)
        assert found.stability == word
        assert_allclose(found.omega_squared[0], math.copysign(14.715, -angle), rtol=1e-9)


@pytest.mark.slow
@pytest.mark.slow_cases("{}")
@pytest.mark.parametrize("way", WAYS[::2], ids=str)
def test_a_column_flutters_beside_a_stiff_spring(way):
    block, rail, spring = beside(1e12, 1.0)
    model = column(bodies={"block": block}, joints={"rail": rail}, forces={"spring": spring})
    for load, word in ((1.0, "stable"), (3.0, "unstable")):
        assert model.equilibrium(parameters={"load": load}, **way).stability == word
    with pytest.raises(InputError, match="forces that have a potential"):
        model.modes(parameters={"load": 3.0}, count=1)


@pytest.mark.slow
def test_a_damper_beside_a_stiff_spring():
    """s^2 + c s + 1 = 0 has -c / 2 as real part."""
    block, rail, spring = beside(1e12, 1e4)
    soft = {"mass": 1.0, "inertia": 1.0}
    slide = {**rods.pin("ground", "soft", rods.GROUND2, "centre", "translational"), "axis": [0.0, 1.0]}
    held = {"type": "force", "body": "soft", "force": [0.0, "-soft.y - 5e-4*soft.vy"]}
    bodies, joints = {"block": block, "soft": soft}, {"rail": rail, "slide": slide}
    model = rods.model(bodies, joints, forces={"spring": spring, "held": held}, gravity=[0.0, 0.0])
    values = model.modes().eigenvalues
    assert_allclose(values[np.abs(values) < 2.0].real, -2.5e-4, rtol=1e-3)
    with pytest.raises(InputError, match="without dampers"):
        model.modes(count=1)


@pytest.mark.slow_cases("0.3-{'shape': 'looped'}", "0.7-{'shape': 'looped'}")
@pytest.mark.parametrize("way", WAYS, ids=str)
@pytest.mark.parametrize("angle", [0.3, 0.7, 2.0, -0.4])
def test_a_balanced_lamp_stays_wherever_it_is_put(angle, way):
    """A spring without free length that balances a rod's weight: k h d = m g c at every angle."""
    rod = {**rods.ROD, "angle": angle, "position": [0.5 * math.cos(angle), 0.5 * math.sin(angle)]}
    rod["points"] = {"A": [-0.5, 0.0], "hook": [0.3, 0.0]}
    stiffness = 2.0 * rods.GRAVITY * 0.5 / (0.7 * 0.8)
    spring = {"type": "spring-damper", "between": ["ground", "rod"], "at": [[0.0, 0.7], "hook"], "stiffness": stiffness}
    model = rods.model({"rod": rod}, {"pin": rods.pin("ground", "rod", rods.GROUND2, "A")}, forces={"spring": spring})
    found = model.equilibrium(**way)
    assert found.stability == "indifferent" and found.omega_squared == (0.0,)
    if "coordinates" not in way:  # of joints there are only sums, which are rounding, and any place is as good
        assert_allclose(found.q["rod.theta"], angle, rtol=1e-12)


@pytest.mark.slow
def test_a_crane_and_its_motor():
    """1e6 kg m^2 and 1e-5 kg m^2: what a torque does to one is 1e-11 of what it does to the other."""
    inertias, torques = {"boom": 1e6, "rotor": 1e-5}, {"boom": 2e5, "rotor": 3e-3}
    bodies = {n: {"mass": 1.0, "inertia": inertia, "angular_velocity": 0.0} for n, inertia in inertias.items()}
    joints = {f"{n}_pin": rods.pin("ground", n, rods.GROUND2, "centre") for n in bodies}
    forces = {f"{n}_motor": {"type": "torque", "body": n, "torque": torque} for n, torque in torques.items()}
    # one that can do nothing; two actuators below that do the same
    forces["against"] = {"type": "spring-damper", "between": ["ground", "rotor"], "at": [[1.0, 0.0], "centre"]}
    model = rods.model(bodies, joints, forces=forces)
    run = model.simulate(until=0.02, step=0.01)
    found = model.inverse(run, actuators=["boom_motor", "rotor_motor"])
    for name, torque in torques.items():
        assert_allclose(found.efforts[f"{name}_motor"], torque, rtol=1e-9)
    assert not found.notes
    both = model.inverse(run, actuators=["boom_motor", "boom_pin", "rotor_motor", "against"])
    for name in ("boom_motor", "boom_pin"):
        assert_allclose(both.efforts[name], 0.5 * torques["boom"], rtol=1e-9)
    assert_allclose(both.efforts["rotor_motor"], torques["rotor"], rtol=1e-9)
    assert_allclose(both.efforts["against"], 0.0, atol=1e-12)


@pytest.mark.parametrize("stiffness", [1e2, 1e9])
def test_what_a_soft_spring_turns_back_does_not_turn_on_beside_a_stiff_one(stiffness):
    block, rail, spring = beside(stiffness)
    rotor = {"mass": 1.0, "inertia": 1.0, "position": [0.0, 0.0], "angle": 0.3, "angular_velocity": 2.0}
    joints = {"pin": rods.pin("ground", "rotor", [0.0, 0.0], "centre"), "rail": rail}
    soft = {"type": "torsional-spring-damper", "between": ["ground", "rotor"], "stiffness": 1e-3}
    model = rods.model({"rotor": rotor, "block": block}, joints, forces={"spring": spring, "soft": soft})
    found = model.steady()
    assert found.q["pin.angle"] == pytest.approx(0.0, abs=1e-9)


#: Elements, and stiffnesses of a beam of 1 m and 1 kg against pulling, shear and bending.
ELEMENTS, AXIAL, SHEAR, BENDING = 8, 1e6, 1e9, 1.0


def element():
    """Length of an element of the beam, its stiffnesses against shear and bending, and the mass of each node."""
    h = 1.0 / ELEMENTS
    masses = np.full(ELEMENTS, h)
    masses[-1] *= 0.5
    return h, 1.0 / (h / SHEAR + h**3 / (12.0 * BENDING)), BENDING / h, masses


def beam(bodies=None, forces=None):
    """A clamped beam of nodes and forces by formulas, and what else there is."""
    h, shear, bending, masses = element()
    bodies, forces = dict(bodies or {}), dict(forces or {})
    for i, mass in enumerate(masses.tolist()):
        bodies[f"n{i}"] = {"mass": mass, "inertia": f"rotary*{mass!r}", "position": [(i + 1) * h, 0.0]}
        name, (ax, ay, at) = f"n{i}", (f"n{i - 1}.{c}" if i else "0" for c in ("x", "y", "theta"))
        pull = f"({AXIAL / h!r}*({name}.x - {ax} - {h!r}))"
        push = f"({shear!r}*({name}.y - {ay} - {h / 2!r}*({name}.theta + {at})))"
        bend = f"({bending!r}*({name}.theta - {at}))"
        forces[f"f{i}"] = {"type": "force", "body": name, "force": [f"-{pull}", f"-{push}"]}
        forces[f"t{i}"] = {"type": "torque", "body": name, "torque": f"{h / 2!r}*{push} - {bend}"}
        if i:
            forces[f"g{i}"] = {"type": "force", "body": f"n{i - 1}", "force": [pull, push]}
            forces[f"u{i}"] = {"type": "torque", "body": f"n{i - 1}", "torque": f"{h / 2!r}*{push} + {bend}"}
    return rods.model(bodies, {}, gravity=[0.0, 0.0], parameters={"rotary": 1e-6}, forces=forces)


def displacements():
    """What strains of a unit of energy displace: the flexibility is G G^T, whose parts are all positive."""
    h, shear, bending, _ = element()
    turns = np.tril(np.ones((ELEMENTS, ELEMENTS)))
    sinks = h * turns @ (turns - 0.5 * np.eye(ELEMENTS))
    return np.block([[turns / np.sqrt(shear), sinks / np.sqrt(bending)], [0.0 * turns, turns / np.sqrt(bending)]])


def bending_masses(rotary):
    masses = element()[-1]
    return np.append(masses, rotary * masses)


def bending_squares(rotary):
    g = np.sqrt(bending_masses(rotary))[:, np.newaxis] * displacements()
    return 1.0 / np.linalg.svd(g, compute_uv=False) ** 2


def test_a_beam_bends_however_little_its_sections_resist_turning():
    """Its sections turn to and fro at up to 1e12 rad/s, beside which its own frequency counted as 0."""
    model = beam()
    for rotary in (1e-5, 1e-12, 1e-20):
        found = np.array(model.modes(at="start", parameters={"rotary": rotary}).omega_squared)
        assert_allclose(found[:3], bending_squares(rotary)[:3], rtol=1e-9)


@pytest.mark.slow
def test_a_beam_with_a_dashpot():
    """Of x = -s F (C + s M) x those with large 1 / s; beside it a mass that drag holds in one direction."""
    model = beam(
        {"free": {"type": "point", "mass": 2.0, "position": [0.0, 5.0]}},
        {
            "dashpot": {"type": "force", "body": f"n{ELEMENTS - 1}", "force": [0.0, f"-0.4*n{ELEMENTS - 1}.vy"]},
            "drag": {"type": "force", "body": "free", "force": ["-1e-3*free.vx", 0.0]},
        },
    )
    flexibility = displacements() @ displacements().T
    damping, size = np.zeros(2 * ELEMENTS), np.eye(2 * ELEMENTS)
    damping[ELEMENTS - 1] = 0.4
    for rotary in (1e-5, 1e-12):
        inverse = np.block([[-flexibility * damping, -flexibility * bending_masses(rotary)], [size, 0.0 * size]])
        reverse = np.linalg.eigvals(inverse)
        expected = 1.0 / reverse[np.argsort(-np.abs(reverse))[:6]]
        asked = {"at": "start", "parameters": {"rotary": rotary}}
        for values in (model.modes(**asked).eigenvalues, model.linearise(**asked).eigenvalues()):
            found = values[np.argsort(np.abs(values))[:10]]
            assert np.all(found[:3] == 0.0)
            assert_allclose(found[3], -5e-4, rtol=1e-6)
            assert_allclose(np.sort_complex(found[4:]), np.sort_complex(expected), rtol=1e-7)

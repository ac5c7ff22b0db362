"""Tables of who takes part in modes: sums, numbers by hand from matrices of minimal coordinates, both coordinates."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

import symgen
from analyses import rods
from symgen.analyses.kinds.modes import mode_lines

MASSES, STIFFNESS, DAMPING = (2.0, 1.0), (40.0, 25.0), (0.6, 0.2)


def beside_each_other(stiffness, damping):
    """Bodies of 1 kg on a rail, each on the ground's spring and damper: every one is a mode of its own."""
    names = [f"m{i}" for i in range(len(stiffness))]
    bodies = {
        name: {"mass": 1.0, "inertia": 1.0, "position": [1.0, 0.0], "points": {"P": [0.0, 0.0]}} for name in names
    }
    joints = {
        f"r{name}": rods.pin("ground", name, rods.GROUND2, "centre", "translational", axis=[1.0, 0.0]) for name in names
    }
    spring = {"type": "spring-damper", "at": [[0.0, 0.0], "P"], "free_length": 1.0}
    forces = {
        f"s{name}": {**spring, "between": ["ground", name], "stiffness": k, "damping": c}
        for name, k, c in zip(names, stiffness, damping, strict=True)
    }
    return rods.model(bodies, joints, gravity=[0.0, 0.0], forces=forces)


@pytest.mark.parametrize("damping", [0.0, 0.6])
@pytest.mark.parametrize(
    ("stiffness", "groups"),
    [((40.0, 90.0, 40.0), ((1, 2),)), ((40.0, 40.001, 90.0), ()), ((25.0, 25.0, 25.0), ((1, 2, 3),))],
)
def test_modes_of_one_eigenvalue_are_named(stiffness, damping, groups):
    """Squares of frequencies are the stiffnesses of masses of 1 kg; the sum of shares over a group is unique."""
    model = beside_each_other(stiffness, (damping,) * 3)
    found = model.modes()
    expected = np.sort(stiffness) - damping**2 / 4.0
    rates = 2.0 * np.pi * found.frequencies
    assert_allclose(np.sort(rates), np.sqrt(expected), rtol=1e-9)
    numbers = np.argsort(rates, kind="stable") + 1  # damped modes come by their real parts
    assert {frozenset(group) for group in found.multiple} == {
        frozenset(numbers[i - 1].item() for i in group) for group in groups
    }
    assert found.to_dict()["multiple"] == [list(group) for group in found.multiple]
    said = [line for line in mode_lines(found) if isinstance(line, str) and "not unique" in line]
    assert len(said) == bool(groups)
    for group in found.multiple:
        of_one = stiffness[0]
        sums = {name: sum(share[i - 1] for i in group) for name, share in found.participation.items()}
        assert sums == pytest.approx({f"m{i}": float(k == of_one) for i, k in enumerate(stiffness)}, abs=1e-9)


@pytest.mark.slow
def test_shares_of_the_governor_at_rest_are_said_to_be_not_unique(cli):
    """Both arms hang alike: one frequency, and two shapes of many."""
    code, out, _ = cli("modes", "flyball-governor")
    assert code == 0
    assert "not unique: modes 1, 2" in out
    assert "not unique" not in cli("modes", "four-bar", "--start", "crank.theta=4")[1]


def two_masses():
    """Two bodies on a rail, the first on the ground's spring and damper, the second on the first one's."""
    bodies = {
        f"m{i}": {"mass": m, "inertia": 1.0, "position": [1.0 + i, 0.0], "points": {"P": [0.0, 0.0]}}
        for i, m in enumerate(MASSES)
    }
    joints = {
        f"r{i}": rods.pin("ground", f"m{i}", rods.GROUND2, "centre", "translational", axis=[1.0, 0.0]) for i in range(2)
    }
    ends = (("ground", "m0", [0.0, 0.0]), ("m0", "m1", "P"))
    forces = {
        f"s{i}": {
            **{"type": "spring-damper", "between": [a, b], "at": [at, "P"], "free_length": 1.0},
            **{"stiffness": STIFFNESS[i], "damping": DAMPING[i]},
        }
        for i, (a, b, at) in enumerate(ends)
    }
    return rods.model(bodies, joints, gravity=[0.0, 0.0], forces=forces)


@pytest.mark.slow_cases("absolute", "joint")
@pytest.mark.parametrize("coordinates", ["absolute", "joint"])
def test_shares_of_damped_modes_are_those_of_two_by_two_matrices(coordinates):
    found = two_masses().modes(coordinates=coordinates)
    m, parts = np.diag(MASSES), [np.array([[1.0, 0.0], [0.0, 0.0]]), np.array([[1.0, -1.0], [-1.0, 1.0]])]
    k, c = (sum(x * part for x, part in zip(of, parts, strict=True)) for of in (STIFFNESS, DAMPING))
    first = np.block([[np.zeros((2, 2)), np.eye(2)], [-np.linalg.solve(m, k), -np.linalg.solve(m, c)]])
    values, vectors = np.linalg.eig(first)
    assert len(found.of_shapes) == 2
    for j, value in enumerate(found.of_shapes):
        z = vectors[:2, np.argmin(np.abs(values - value))]

        def share(matrices, z=z):
            works = np.array([np.real(z.conj() @ a @ z) for a in matrices])
            return works / works.sum()

        wanted = {
            "participation": share([np.diag([MASSES[0], 0.0]), np.diag([0.0, MASSES[1]])]),
            "stiffening": share([x * a for x, a in zip(STIFFNESS, parts, strict=True)]),
            "dissipation": share([x * a for x, a in zip(DAMPING, parts, strict=True)]),
        }
        for table, shares in wanted.items():
            names = ("m0", "m1") if table == "participation" else ("s0", "s1")
            own = getattr(found, table)
            assert_allclose([own[name][j] for name in names], shares, rtol=1e-9)
            assert_allclose(sum(own.values())[j], 1.0, rtol=1e-12)


@pytest.mark.slow_cases("flyball-governor", "cart-pole")
@pytest.mark.parametrize("name", ["four-bar", "cart-pole", "flyball-governor"])
def test_tables_are_those_of_bodies_in_both_coordinates(name):
    asked = {"at": "steady"} if name == "flyball-governor" else {}
    found = symgen.load(name).modes(coordinates="joint", **asked)
    for table in (found.participation, found.stiffening, found.dissipation):
        sums = sum(table.values(), np.zeros(len(found.of_shapes)))
        assert np.all((np.abs(sums - 1.0) < 1e-9) | (sums == 0.0))
    assert_allclose(sum(found.participation.values()), 1.0, rtol=1e-12)
    if not asked:
        other = symgen.load(name).modes()
        for table in ("participation", "stiffening", "dissipation"):
            mine, theirs = getattr(found, table), getattr(other, table)
            for key in theirs:
                assert_allclose(mine.get(key, 0.0), theirs[key], atol=1e-8)


@pytest.mark.slow
def test_a_riding_bicycle_weaves_with_its_frame():
    found = symgen.load("bicycle").modes(at="start", states=("lean", "steer"))
    assert_allclose(sum(found.participation.values()), 1.0, rtol=1e-12)
    restoring = sum(found.stiffening.values(), np.zeros(len(found.of_shapes)))
    assert_allclose(restoring[np.abs(restoring) > 0.0], 1.0, rtol=1e-9)


@pytest.mark.parametrize("coordinates", ["absolute", "joint"])
def test_shares_at_a_time_know_what_inputs_are_there(coordinates):
    """The stiffness is an input that jumps on the way; where the state is that of joints it was that of the start."""
    rod = {**rods.ROD, "position": [0.0, -0.5], "angle": -np.pi / 2}
    model = rods.model(
        {"rod": rod},
        {"pin": rods.pin("ground", "rod", rods.GROUND2, "A")},
        inputs={"stiff": 1.0},
        forces={"spring": {"type": "torque", "body": "rod", "torque": "-stiff*(rod.theta + pi/2)"}},
    )
    found = model.modes(at=0.02, inputs={"stiff": "1 if t < 0.01 else 20"}, coordinates=coordinates)
    weight = 2.0 * rods.GRAVITY * 0.5
    assert_allclose(found.stiffening["spring"], [20.0 / (20.0 + weight)], rtol=1e-12)
    assert_allclose(found.omega_squared, [(20.0 + weight) * 1.5], rtol=1e-12)

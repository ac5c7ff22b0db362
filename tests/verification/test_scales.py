"""The motion of a linkage at any size and any mass: gravity scales with the size, so angles are the same."""

from itertools import product

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from symgen.api import Model
from symgen.derive.methods import METHODS
from symgen.describe.files.validate import validate
from symgen.run.layout.abi import DONE
from symgen.run.single.observe import balanced_output, number_of_balances
from symgen.study.ensemble.verdicts import summary_column

#: Powers of ten of the size and of all masses: some, and all pairs of thousands from 1e-9 to 1e9 with micrograms.
SCALES = [(0, 0), (-9, 0), (-3, -6), (9, 0), (0, -9), (0, -5), (0, 9), (-9, -9), (9, 9), (-6, -15)]
ALL = [*product(range(-9, 10, 3), repeat=2), (0, -5), (-6, -15)]
#: Methods whose own scheme has order 1 or 2, and what it leaves of an angle at 1 ms [rad].
COARSE = {"implicit-constraint": 1e-2} | dict.fromkeys(
    ("rattle", "discrete-gradient", "generalized-alpha", "index3-augmented-lagrangian"), 1e-4
)
#: How often a method does not say ok at `ALL`: Newton's iteration of the one fails where moments of inertia are above
#: 1e15 kg m2, and the other asks for a second run.
SILENT = {"discrete-gradient": 9, "energy-projection": len(ALL)}
UNTIL, LENGTHS, MASSES = 2.0, (2.0, 8.0, 5.0), (2.0, 8.0, 5.0)
POSES = ((0.5, 0.8660254037844386, np.pi / 3), (4.706229663272004, 3.2366642739058917, 0.38564124740737094))
POSES += ((9.206229663272005, 2.3706388701214535, 1.8938968124057762),)


def linkage():
    """A four-bar linkage whose lengths are all multiples of one parameter, and masses of another."""
    bodies = {}
    for name, length, mass, (x, y, angle) in zip("abc", LENGTHS, MASSES, POSES, strict=True):
        points = {"A": [f"-{length / 2}*size", 0.0], "B": [f"{length / 2}*size", 0.0]}
        inertia = f"{mass * length**2 / 12}*mass*size**2"
        bodies[name] = {"mass": f"{mass}*mass", "inertia": inertia, "points": points}
        bodies[name] |= {"position": [f"{x}*size", f"{y}*size"], "angle": angle}
    pins = {"A": ("ground", "a", [0.0, 0.0], "A"), "B": ("a", "b", "B", "A"), "C": ("b", "c", "B", "B")}
    pins["D"] = ("ground", "c", ["10*size", 0.0], "A")
    return {
        "mechanism": {"name": "linkage", "gravity": [0.0, "-9.81*size"]},
        "parameters": {"size": {"value": 1.0, "unit": "m"}, "mass": {"value": 1.0, "unit": "kg"}},
        "bodies": bodies,
        "joints": {n: {"type": "revolute", "between": [a, b], "at": [p, q]} for n, (a, b, p, q) in pins.items()},
    }


def crank_angle(times):
    """The crank's angle by the one equation of motion of the linkage of size 1, with angles by the law of cosines."""

    def angles(theta):
        joint = 2.0 * np.array([np.cos(theta), np.sin(theta)])
        away = np.array([10.0, 0.0]) - joint
        r = np.hypot(*away)
        beta = np.arctan2(away[1], away[0]) + np.arccos((8.0**2 + r**2 - 5.0**2) / (2 * 8.0 * r))
        end = joint + 8.0 * np.array([np.cos(beta), np.sin(beta)])
        return beta, np.arctan2(end[1], end[0] - 10.0)

    def slopes(theta, h=1e-4):
        def rise(h):
            return (np.array(angles(theta + h)) - np.array(angles(theta - h))) / (2 * h)

        return (4.0 * rise(h / 2) - rise(h)) / 3.0

    def energies(theta):
        """The inertia seen by the crank, and the potential energy."""
        beta, gamma = angles(theta)
        b, c = slopes(theta)
        centre = 2.0 * np.array([-np.sin(theta), np.cos(theta)]) + 4.0 * b * np.array([-np.sin(beta), np.cos(beta)])
        inertia = 2.0 * 4.0 / 3.0 + 8.0 * centre @ centre + 8.0 * 64.0 / 12.0 * b**2 + 5.0 * 25.0 / 3.0 * c**2
        height = 2.0 * np.sin(theta) + 8.0 * (2.0 * np.sin(theta) + 4.0 * np.sin(beta)) + 12.5 * np.sin(gamma)
        return np.array([inertia, 9.81 * height])

    def rate(_, y, h=1e-3):
        rise = (energies(y[0] + h) - energies(y[0] - h)) / (2 * h)
        finer = (energies(y[0] + h / 2) - energies(y[0] - h / 2)) / h
        inertia, force = (4.0 * finer - rise) / 3.0
        return [y[1], -(0.5 * inertia * y[1] ** 2 + force) / energies(y[0])[0]]

    return solve_ivp(rate, (0.0, UNTIL), [np.pi / 3, 0.0], "DOP853", times, rtol=1e-10, atol=1e-10).y[0]


@pytest.fixture(scope="module")
def expected():
    return crank_angle(np.linspace(0.0, UNTIL, 21))


def check_scales(method, scales, expected):
    """Where a run is ok, the angle of its crank is right."""
    model = Model(validate(linkage(), "test"))
    own = METHODS.get(method).default_integrator in ("picard", "dop853")
    right = 0
    for size, mass in scales:
        result = model.simulate(
            method=method,
            integrator="rk4" if own else None,
            step=1e-3,
            until=UNTIL,
            output_step=0.1,
            max_violation=1e-2,
            parameters={"size": 10.0**size, "mass": 10.0**mass},
        )
        if result.status == "ok":
            found = np.asarray(result["a.theta"])
            np.testing.assert_allclose(found, expected, rtol=0.0, atol=COARSE.get(method, 1e-6))
            right += 1
    assert right == len(scales) - SILENT.get(method, 0)


@pytest.mark.parametrize("method", ["penalty", "augmented-hamiltonian", "compliant-constraints"])
def test_no_scale_is_ok_and_wrong(method, expected):
    """A penalty with a unit of mass stands still below 1e-13 of these masses, ok and without any violation."""
    check_scales(method, SCALES, expected)


@pytest.mark.slow
@pytest.mark.parametrize("method", METHODS.names)
def test_no_pair_of_scales_is_ok_and_wrong(method, expected):
    check_scales(method, ALL, expected)


@pytest.mark.parametrize(
    ("shape", "coordinates"), [("straight", "absolute"), ("straight", "joint"), ("looped", "absolute")]
)
def test_what_accelerations_leave_of_forces_ends_in_the_status(shape, coordinates):
    """Rounding of a D^T D, about 1e-16 a, is as large as the masses at a = 1e15: they leave forces over."""
    model, left, status = Model(validate(linkage(), "test")), [], []
    for a in (1e9, 1e11, 1e14):
        result = model.simulate(
            method="penalty",
            shape=shape,
            coordinates=coordinates,
            options={"method.penalty": a},
            integrator="rk4",
            step=1e-3,
            until=0.2,
            output_step=0.1,
            max_energy_error=1.0,
        )
        left.append(result.outcome.imbalance)
        status.append(result.status)
    assert status[0] == "ok" and status[2] != "ok" and left[0] < 1e-6 < 1e-4 < left[2]
    assert "of the forces unbalanced" in result.reason


@pytest.mark.parametrize(
    ("target", "coordinates", "until"),
    [("cpu", "absolute", 1.0), ("cpu", "joint", 0.2), ("lanes", "absolute", 0.2), ("cpu", "absolute", 0.2)],
)
def test_rows_of_sweeps_have_the_balance_of_single_runs(target, coordinates, until):
    """A row evaluates it at the same outputs, the start and one more for each thousand evaluations."""
    model, values = Model(validate(linkage(), "test")), np.geomspace(1e9, 1e15, 8)
    how = {"integrator": "rk4", "step": 1e-3, "until": until, "output_step": 0.05, "max_energy_error": 10.0}
    common = {"method": "penalty", "coordinates": coordinates, **how}
    rows = model.sweep({"method.penalty": values}, quantities=["a.theta"], target=target, **common)
    for i, a in enumerate(values):
        alone = model.simulate(options={"method.penalty": a}, **common)
        assert rows.status[i] == alone.status
        if alone.outcome.code == DONE:
            assert summary_column(rows.summary, "imbalance")[i] == pytest.approx(alone.outcome.imbalance, rel=0.5)
            assert rows.reason[i].split(" leave ")[0] == (alone.reason or "").split(" leave ")[0]
    assert len({*rows.status.tolist()}) > 1


@pytest.mark.parametrize(
    ("count", "evaluations", "expected"), [(1, 10**6, 1), (100, 0, 1), (100, 10**6, 8), (5, 4000, 5)]
)
def test_outputs_that_forces_are_balanced_at(count, evaluations, expected):
    """From the start to the end, each once, and for each but the first a run has a thousand evaluations."""
    some = number_of_balances(count, evaluations)
    places = [balanced_output(i, some, count) for i in range(some)]
    assert some == expected and places == sorted(set(places))
    assert places[0] == 0 and (some == 1 or places[-1] == count - 1)
    assert some <= 1 + evaluations / 1000

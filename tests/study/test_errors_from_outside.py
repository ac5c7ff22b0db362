"""The error column against published values, with points worked out here from the published coordinates alone.

Output times are chosen so that all of them are published; then the error of a row is the largest distance between this
run's points and the published ones, and nothing of `symgen.study` is needed to say what it is.
"""

import json
from pathlib import Path

import numpy as np
import pytest

import symgen

DATA = Path(__file__).parents[1] / "data"


def planar(x, y, theta, length):
    """Centre of mass and the tips of both axes of a body, shape (3, 2)."""
    centre = np.array([x, y])
    along, across = np.array([np.cos(theta), np.sin(theta)]), np.array([-np.sin(theta), np.cos(theta)])
    return np.array([centre, centre + length * along, centre + length * across])


def largest_distance(result, k, poses, lengths):
    """Largest distance between the points of a result at output `k` and those of the poses."""
    largest = 0.0
    for body, pose in poses.items():
        own = [result[f"{body}.{c}"][k] for c in ("x", "y", "theta")]
        apart = planar(*own, lengths[body]) - planar(*pose, lengths[body])
        largest = max(largest, float(np.linalg.norm(apart, axis=1).max()))
    return largest


# -- Andrews' squeezer, IVP test set -----------------------------------------------------------------------------------

ANDREWS = json.loads((DATA / "andrews_ivp.json").read_text())


def andrews_poses():
    """Centres and angles of the bodies at the published end, by the mechanism's plane geometry."""
    value = dict(zip(ANDREWS["coordinates"], ANDREWS["end"], strict=False))
    p = ANDREWS["parameters"]

    def turned(angle, x, y):
        c, s = np.cos(angle), np.sin(angle)
        return np.array([c * x - s * y, s * x + c * y])

    beta, theta, gamma = value["beta"], value["theta"], value["gamma"]
    phi, delta, omega, epsilon = (value[name] for name in ("phi", "delta", "omega", "epsilon"))
    a, b = np.array([p["xa"], p["ya"]]), np.array([p["xb"], p["yb"]])
    f = turned(beta, p["rr"], 0.0)
    e = b + turned(gamma, 0.0, -p["ss"])
    centres = {
        "K1": (turned(beta, p["ra"], 0.0), beta),
        "K2": (f + turned(beta + theta, -p["da"], 0.0), beta + theta),
        "K3": (b + turned(gamma, p["sb"], -p["sa"]), gamma),
        "K4": (e + turned(phi + delta, 0.0, p["ea"]), phi + delta),
        "K5": (a + turned(delta, p["tb"], p["ta"]), delta),
        "K6": (e + turned(omega + epsilon, -p["fa"], 0.0), omega + epsilon),
        "K7": (a + turned(epsilon, p["ub"], -p["ua"]), epsilon),
    }
    return {name: (*centre, angle) for name, (centre, angle) in centres.items()}


def lengths_of(mechanism):
    """Largest distance of a named point from the centre of mass, at least the radius of gyration; from the file."""
    import tomllib

    path = Path(symgen.__file__).parent / "describe" / "catalogue" / f"{mechanism}.toml"
    found = {}
    for name, body in tomllib.loads(path.read_text())["bodies"].items():
        centre = np.array(body.get("centre_of_mass", (0.0, 0.0)))
        away = [float(np.linalg.norm(np.array(p) - centre)) for p in body.get("points", {}).values()]
        found[name] = max([*away, float(np.sqrt(body["inertia"] / body["mass"]))])
    return found


@pytest.mark.by_turns(2)
@pytest.mark.slow
@pytest.mark.parametrize(("method", "step"), [("direct-correction", 1e-4), ("lagrange", 4e-5)])
def test_andrews(method, step):
    study = symgen.compare("andrews", [method], ["rk4"], [step], until=0.03, output_step=0.03, repeat=1)
    result = symgen.load("andrews").simulate(method=method, integrator="rk4", step=step, times=[0.0, 0.03])
    expected = largest_distance(result, -1, andrews_poses(), lengths_of("andrews"))
    # the published values have ten digits: references and runs with h -> 0 meet 9.4e-12 m beside them
    assert study.rows[0].error == pytest.approx(expected, abs=2e-11)
    assert expected > 2e-9
    assert study.estimated_error < 1e-3 * expected


# -- the linkage of IFToMM A02 with two windows ------------------------------------------------------------------------

PINS = {row[0]: row[1:3] for row in json.loads((DATA / "n_four_bar_reference.json").read_text())["values"]["2"]}


def linkage_poses(t):
    """Poses of the rods of 1 m from the published position of the first vertical's upper pin."""
    x, y = PINS[t]
    angle = np.arctan2(y, x)
    poses = {f"vertical{i}": (i + x / 2, y / 2, angle) for i in range(3)}
    return poses | {f"coupler{i}": (i + 0.5 + x, y, 0.0) for i in range(2)}


@pytest.mark.slow
@pytest.mark.slow_cases("index1-augmented-lagrangian-0.004-2.0-1.0")
@pytest.mark.parametrize(
    ("method", "step", "until", "every"),
    [
        ("direct-correction", 1e-2, 10.0, 5.0),
        ("index1-augmented-lagrangian", 4e-3, 2.0, 1.0),
    ],
)
def test_n_four_bar(method, step, until, every):
    """Up to ten singular positions on the way."""
    study = symgen.compare("n-four-bar:2", [method], ["rk4"], [step], until=until, output_step=every, repeat=1)
    times = np.arange(0.0, until + every / 2, every)
    result = symgen.load("n-four-bar:2").simulate(method=method, integrator="rk4", step=step, times=times, until=until)
    names = [n.removesuffix(".theta") for n in result.q.names if n.endswith(".theta")]
    poses = [{n: linkage_poses(float(t))[n] for n in names} for t in times]
    expected = max(largest_distance(result, k, pose, dict.fromkeys(names, 0.5)) for k, pose in enumerate(poses))
    assert study.rows[0].error == pytest.approx(expected, rel=1e-3)
    assert expected > 1e-9


# -- Bricard's six-bar, IFToMM A04 with square rods of 1 kg ------------------------------------------------------------

BRICARD = np.loadtxt(DATA / "bricard_square_rods.csv", delimiter=",")
#: Tips of the rods that are pins: rod i joins pins i - 1 and i, and P0, P5 are fixed.
FIXED = {0: np.zeros(3), 5: np.array([0.0, 0.0, 1.0])}


@pytest.mark.by_turns(3)
@pytest.mark.slow
def test_bricard():
    """Pins lie on the rods' axes at half a metre: their distances from the published ones bound the error from below.

    The error counts the tips of all three axes at a rod's own length, half a metre as well; a rod's turn about its own
    axis, which pins do not show, follows from the joints and adds a factor of at most a few.
    """
    times = BRICARD[:, 0]
    every = float(times[1] - times[0])
    until = float(times[-1])
    pins = dict(FIXED) | {i: BRICARD[:, 3 * i - 2 : 3 * i + 1] for i in (1, 2, 3, 4)}
    methods = ["direct-correction", "lagrange"]
    study = symgen.compare("bricard", methods, ["rk4"], [1e-2], until=until, output_step=every, repeat=1)
    assert [row.method for row in study.rows] == methods
    for row in study.rows:
        steps = {"integrator": "rk4", "step": 1e-2, "times": times, "until": until}
        result = symgen.load("bricard").simulate(method=row.method, **steps)
        largest = 0.0
        for i in range(1, 6):
            centre = np.column_stack([result[f"rod{i}.{c}"] for c in "xyz"])
            published = 0.5 * (pins[i - 1] + pins[i])
            largest = max(largest, float(np.linalg.norm(centre - published, axis=1).max()))
        assert 1e-8 < largest
        assert largest * (1.0 - 1e-3) <= row.error <= 4.0 * largest

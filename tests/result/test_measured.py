"""Points, forces, drivers and reactions in results, against NumPy on the bodies' motion; power against energy."""

import numpy as np
import pytest
from support.emitted import mechanism_of
from support.random_closed import make

from symgen.api import load
from symgen.base.errors import InputError

#: Of sums of a few products of numbers of order 1 to 1e2, with accelerations from a solve.
ROUNDING = 1e-11


def furnished(seed: int, space: str) -> dict:
    """A random mechanism with points, every kind of force that has a name for what it does, and a driver."""
    rng = np.random.default_rng(1000 + seed)
    raw = make(seed, space)
    size = 3 if space == "spatial" else 2
    for keys in raw["bodies"].values():
        keys["points"] = {"P": rng.uniform(-1.0, 1.0, size).tolist(), "Q": rng.uniform(-1.0, 1.0, size).tolist()}
        keys["centre_of_mass"] = rng.uniform(-0.2, 0.2, size).tolist()
    # bodies were placed by their frames' origins, and still are
    raw["mechanism"]["gravity"] = [0.3, -9.0, 1.0][:size]
    last = list(raw["bodies"])[-1]
    moment = [0.2, "sin(t)", f"0.1*{last}.P.vx"]
    raw["forces"] = raw.get("forces", {}) | {
        "strut": {
            "type": "spring-damper",
            "between": ["b0", last],
            "at": ["P", "Q"],
            "stiffness": 20.0,
            "damping": 0.7,
            "free_length": 0.9,
            "actuator": "0.4*t + 0.1*rate",
            "potential": "0.3*length**3",
        },
        "push": {"type": "force", "body": last, "at": "P", "force": ["1.5", "cos(t)", "0.4"][:size]},
        "turn": {"type": "torque", "body": last, "torque": moment if size == 3 else moment[2]},
    }
    if size == 2 and len(raw["bodies"]) == 2:  # more bodies have a loop
        angle = raw["bodies"]["b0"]["angle"].partition(" ")[0]
        raw["joints"]["motor"] = {"type": "driver", "joint": "j0", "value": f"{angle} + 0.3*t - t**2"}
    raw["outputs"] = {
        "reach": {"value": f"sqrt({last}.P.x**2 + {last}.P.y**2)", "unit": "m"},
        "mixed": f"strut.force*strut.rate - strut.power + 2*b0.P.ay + {last}.ax",
    }
    return raw


def rotations(table, body):
    """Rotation matrices, angular velocities and accelerations, in ground axes, of a planar or spatial body."""
    q, v, a = table
    if f"{body}.theta" in q:
        c, s = np.cos(q[f"{body}.theta"]), np.sin(q[f"{body}.theta"])
        zero, one = np.zeros_like(c), np.ones_like(c)
        turned = np.array([[c, -s, zero], [s, c, zero], [zero, zero, one]]).transpose(2, 0, 1)
        return turned, *(np.stack([zero, zero, x[f"{body}.{n}"]], 1) for x, n in ((v, "omega"), (a, "alpha")))
    e0, e1, e2, e3 = (q[f"{body}.e{i}"] for i in range(4))
    turned = np.array(
        [
            [1 - 2 * (e2**2 + e3**2), 2 * (e1 * e2 - e0 * e3), 2 * (e1 * e3 + e0 * e2)],
            [2 * (e1 * e2 + e0 * e3), 1 - 2 * (e1**2 + e3**2), 2 * (e2 * e3 - e0 * e1)],
            [2 * (e1 * e3 - e0 * e2), 2 * (e2 * e3 + e0 * e1), 1 - 2 * (e1**2 + e2**2)],
        ]
    ).transpose(2, 0, 1)
    own = (np.stack([x[f"{body}.{n}{c}"] for c in "xyz"], 1) for x, n in ((v, "w"), (a, "alpha")))
    return turned, *(np.einsum("kij,kj->ki", turned, x) for x in own)


def moved(result, body, names):
    return np.stack([result[f"{body}.{n}"] if n else np.zeros(len(result.t)) for n in names], 1)


def point(result, raw, body, name):
    """Place, velocity and acceleration of a named point."""
    size = len(raw["mechanism"]["gravity"])
    keys = raw["bodies"][body]
    local = np.zeros(3)
    local[:size] = np.subtract(keys["points"][name], keys["centre_of_mass"])
    turned, omega, alpha = rotations((result.q, result.v, result.a), body)
    arm = turned @ local
    letters = ("x", "y", "z" if size == 3 else "")
    centre, speed, rate = (
        moved(result, body, [f"{order}{c}" if c else "" for c in letters]) for order in ("", "v", "a")
    )
    velocity = np.cross(omega, arm)
    return centre + arm, speed + velocity, rate + np.cross(alpha, arm) + np.cross(omega, velocity)


def check(raw, **settings):
    """Compare everything; return the largest differences found."""
    result = load(mechanism_of(raw)).simulate(integrator="rk4", step=1e-3, until=0.02, **settings)
    assert result.status == "ok"
    size, worst = len(raw["mechanism"]["gravity"]), 0.0

    def close(found, expected):
        nonlocal worst
        scale = max(1.0, float(np.abs(expected).max()))
        worst = max(worst, float(np.abs(found - expected).max()) / scale)

    for body in raw["bodies"]:
        for name in "PQ":
            for order, values in zip(("", "v", "a"), point(result, raw, body, name), strict=True):
                for k, axis in enumerate("xyz"[:size]):
                    close(result[f"{body}.{name}.{order}{axis}"], values[:, k])
    last, (a, b) = list(raw["bodies"])[-1], raw["forces"]["strut"]["between"]
    ends = point(result, raw, a, "P"), point(result, raw, b, "Q")
    gap, speed = ends[1][0] - ends[0][0], ends[1][1] - ends[0][1]
    length = np.linalg.norm(gap, axis=1)
    rate = np.sum(gap * speed, axis=1) / length
    force = -20.0 * (length - 0.9) - 0.7 * rate + 0.4 * result.t + 0.1 * rate - 0.9 * length**2
    for name, expected in (("length", length), ("rate", rate), ("force", force), ("power", force * rate)):
        close(result[f"strut.{name}"], expected)
    at = point(result, raw, last, "P")
    applied = np.stack([np.full_like(length, 1.5), np.cos(result.t), np.full_like(length, 0.4)], 1)[:, :size]
    for k, axis in enumerate("xyz"[:size]):
        close(result[f"push.F{axis}"], applied[:, k])
    close(result["push.power"], np.sum(applied * at[1][:, :size], axis=1))
    close(result["reach"], np.hypot(at[0][:, 0], at[0][:, 1]))
    close(result["mixed"], 2.0 * point(result, raw, "b0", "P")[2][:, 1] + result[f"{last}.ax"])
    if "motor" in raw["joints"]:
        close(result["motor.rate"], 0.3 - 2.0 * result.t)
        close(result["motor.power"], result["motor.effort"] * (0.3 - 2.0 * result.t))
    close(sum(result[n] for n in result.elements.names if n.endswith(".power")), change_of_energy(result, raw))
    return worst


def change_of_energy(result, raw):
    """What the kinetic energy gains in a second, less what weights give."""
    gained, size = np.zeros(len(result.t)), len(raw["mechanism"]["gravity"])
    for body, keys in raw["bodies"].items():
        for k, axis in enumerate("xyz"[:size]):
            speed, rate = result[f"{body}.v{axis}"], result[f"{body}.a{axis}"]
            gained += keys["mass"] * speed * (rate - raw["mechanism"]["gravity"][k])
        if size == 2:
            gained += keys["inertia"] * result[f"{body}.omega"] * result[f"{body}.alpha"]
        else:
            for k, axis in enumerate("xyz"):  # the gyroscopic moment has no power
                gained += keys["inertia"][k] * result[f"{body}.w{axis}"] * result[f"{body}.alpha{axis}"]
    return gained


@pytest.mark.by_turns(3)
@pytest.mark.fast("1-planar")
@pytest.mark.parametrize(("seed", "space"), [(1, "planar"), (2, "planar"), (3, "spatial"), (6, "spatial")])
def test_everything_beside_the_state(seed, space):
    assert check(furnished(seed, space)) < ROUNDING


@pytest.mark.slow
def test_looped_code_has_the_same_tables():
    raw = furnished(6, "spatial")
    assert check(raw, shape="looped") < ROUNDING


def test_one_of_the_mechanisms_has_a_driver():
    assert any("motor" in furnished(seed, "planar")["joints"] for seed in (1, 2))


@pytest.fixture(scope="module")
def result():
    return load(mechanism_of(furnished(1, "planar"))).simulate(until=0.01)


def test_outputs_leave_as_json_frames_and_columns(result, tmp_path):
    found = result.to_json()["final"]["outputs"]
    assert set(found) == {"reach", "mixed"} and found["reach"] == result["reach"][-1]
    frame = result.to_dataframe()
    assert frame["strut.force"].iloc[-1] == result["strut.force"][-1]
    assert frame.attrs["units"]["strut.power"] == "W" and frame.attrs["units"]["reach"] == "m"
    chosen = result.select(["strut", "outputs", "energy.kinetic", "b0.P.vx"])
    assert chosen.names[:2] == ("strut.length", "strut.rate") and chosen.names[-2:] == ("energy.kinetic", "b0.P.vx")
    assert chosen.units[-1] == "m/s" and np.array_equal(chosen["energy.kinetic"], result.kinetic)
    header = result.save(tmp_path / "x.csv", ["strut.force", "reach"]).read_text().splitlines()[0]
    assert header == "t [s],strut.force [N],reach [m]"
    with pytest.raises(InputError, match=r"did you mean 'strut\.force'"):
        result.select(["strut.forse"])


def test_a_mechanism_without_outputs_says_nothing_of_them():
    assert "outputs" not in load("four-bar").simulate(until=0.01).to_json()["final"]


REFUSED = [
    ("b0.P.q", "got 'P.q', which body 'b0' does not have"),
    ("strut.forse", "got 'forse', which 'strut' does not have; it has length, rate, force, power"),
    ("nothing.x", "got the unknown body or joint 'nothing'"),
    ([1.0], "expected a number or an expression of t, parameters and what is known of the motion"),
    ({"value": "t", "units": "m"}, "got the unknown key 'units'; did you mean 'unit'?"),
    ({"unit": "m"}, "outputs.wrong: expected one of value and ray, got none of them"),
]


@pytest.mark.parametrize(("value", "sentence"), REFUSED)
def test_outputs_that_mean_nothing_are_refused_with_one_sentence(value, sentence):
    raw = furnished(1, "planar")
    raw["outputs"] = {"wrong": value}
    with pytest.raises(InputError) as error:
        mechanism_of(raw)
    assert sentence in str(error.value)

"""Dry friction by reactions of joints in space against references in independent coordinates, in NumPy."""

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import symgen
from symgen.base.errors import InputError
from symgen.describe.files.validate import validate
from symgen.describe.mechanism import Mechanism

GRAVITY = np.array([0.0, 0.0, -9.81])
EXACT = {"integrator": "dop853", "rtol": 1e-12, "atol": 1e-12}


class Sliding:
    """An event-driven run of coordinates x with friction whose bounds are linear in accelerations and forces.

    ``system(x, v)`` returns A, B, b and `reactions` with ``A u = b - B c``: unknowns u, of which the first are v', and
    friction forces c, each ``signs[i] coefficients[i] |R_i u + r_i|``; ``rates(x, v)`` are the rates of the joints.
    """

    def __init__(self, system: Callable[..., Any], rates: Callable[..., Any], coefficients: list[float]) -> None:
        self.system, self.rates, self.coefficients = system, rates, np.array(coefficients)

    def acceleration(self, x: np.ndarray, v: np.ndarray, signs: np.ndarray) -> np.ndarray:
        matrix, against, right, reactions = self.system(x, v)
        alone, moved = np.linalg.solve(matrix, right), -np.linalg.solve(matrix, against)
        k, c = signs * self.coefficients, np.zeros(len(signs))
        for _ in range(20):  # Newton's iteration
            forces = [r @ (alone + moved @ c) + rest for r, rest in reactions]
            sizes = np.linalg.norm(forces, axis=1)
            slopes = [n @ r @ moved / size for n, size, (r, _) in zip(forces, sizes, reactions, strict=True)]
            change = np.linalg.solve(np.eye(len(c)) - k[:, None] * np.array(slopes), k * sizes - c)
            c = c + change
            if np.abs(change).max() <= 1e-14 * np.abs(c).max():
                break
        return (alone + moved @ c)[: len(v)]

    def run(self, x: np.ndarray, v: np.ndarray, until: float) -> tuple[list[float], np.ndarray]:
        """Return the times at which rates pass zero, and the last x, which stays once a coordinate does."""
        t, n, times = 0.0, len(x), []
        y = np.concatenate([x, v])
        signs = np.sign(self.rates(x, v)) if v.all() else self.begun(x, v)
        while t < until and signs is not None:
            events = [lambda t, y, i=i, s=signs: s[i] * self.rates(y[:n], y[n:])[i] for i in range(len(signs))]
            for event in events:
                event.terminal, event.direction = True, -1
            part = solve_ivp(lambda t, y, s=signs: [*y[n:], *self.acceleration(y[:n], y[n:], s)], (t, until), y,
                             method="DOP853", rtol=1e-12, atol=1e-13, events=events, first_step=1e-6)  # fmt: skip
            t, y = part.t[-1], part.y[:, -1]
            if part.status == 1:
                times.append(t)
                y[n:] = np.where(np.abs(y[n:]) < 1e-11, 0.0, y[n:])
                hit = np.array([len(x) > 0 for x in part.t_events])
                signs = np.where(hit, -signs, signs) if y[n:].all() else self.begun(y[:n], y[n:])
        return times, y[:n]

    def begun(self, x: np.ndarray, v: np.ndarray) -> np.ndarray | None:
        """Return the signs of all rates as a coordinate at rest begins to move; None where it stays."""
        assert (v == 0.0).sum() == 1, "one coordinate is at rest"
        for way in (1.0, -1.0):
            signs = np.sign(self.rates(x, np.where(v == 0.0, way, v)))
            if way * self.acceleration(x, v, signs)[v == 0.0][0] > 0.0:
                return signs
        return None


# -- a hinge -----------------------------------------------------------------------------------------------------------

AXIS, PIN = np.array([0.0, 0.8, 0.6]), np.array([-0.5, 0.1, 0.2])
MASS, INERTIA = 2.0, np.diag([0.3, 0.2, 0.25])
#: Two directions across the axis.
ACROSS = np.array([[1.0, 0.0, 0.0], [0.0, 0.6, -0.8]])


def hinge(**friction: Any) -> Mechanism:
    raw = {
        "mechanism": {"name": "hinge", "space": "spatial", "gravity": GRAVITY.tolist()},
        "bodies": {"rod": {"mass": MASS, "inertia": np.diag(INERTIA).tolist(), "points": {"p": PIN.tolist()},
                           "position": (-PIN).tolist()}},
        "joints": {"A": {"type": "revolute", "between": ["ground", "rod"], "at": [[0.0, 0.0, 0.0], "p"],
                         "axis": AXIS.tolist(), "friction": friction}},
    }  # fmt: skip
    return validate(raw, "hinge.toml")


def turned(angle: float) -> np.ndarray:
    """Return the rotation about the axis (Rodrigues)."""
    k = np.cross(np.eye(3), AXIS)
    return np.eye(3) + np.sin(angle) * k + (1.0 - np.cos(angle)) * k @ k


def hinged(x: np.ndarray, v: np.ndarray) -> tuple[Any, ...]:
    arm = turned(x[0]) @ -PIN
    about = np.cross(AXIS, arm)
    inertia = AXIS @ INERTIA @ AXIS + MASS * about @ about
    # force on the rod: m (a - g), a = about alpha + axis x (axis x arm) omega^2
    rest = MASS * (np.cross(AXIS, about) * v[0] ** 2 - GRAVITY)
    return (
        np.array([[inertia]]),
        np.ones((1, 1)),
        np.array([MASS * about @ GRAVITY]),
        [(ACROSS @ (MASS * about)[:, None], ACROSS @ rest)],
    )


@pytest.mark.by_turns(2)
@pytest.mark.slow
@pytest.mark.parametrize("coordinates", ["absolute", "joint"])
def test_a_hinge_rubs_by_the_force_across_its_axis(coordinates: str) -> None:
    reference = Sliding(hinged, lambda x, v: v, [0.06])
    times, x = reference.run(np.zeros(1), np.zeros(1), 20.0)
    result = symgen.load(hinge(coefficient=0.6, radius=0.1)).simulate(
        until=20.0, output_step=1.0, coordinates=coordinates, **EXACT
    )
    assert result.events[-1].name == "A.stick" and len(times) > 4
    np.testing.assert_allclose([e.t for e in result.events], times, rtol=0, atol=1e-9)
    assert abs(result["A.angle"][-1] - x[0]) < 1e-9


@pytest.mark.slow
def test_the_couple_of_a_hinge_does_not_count() -> None:
    """Two hinges on one axis share a couple that one hinge has alone: their forces differ, and the friction."""
    result = symgen.load(hinge(coefficient=0.6, radius=0.1)).simulate(until=0.5, output_step=0.1, **EXACT)
    force = np.stack([result[f"multiplier.A.{axis}"] for axis in "xyz"], axis=1)
    expected = -0.06 * np.linalg.norm(force @ ACROSS.T, axis=1) * np.sign(result["A.angle.rate"])
    np.testing.assert_allclose(result.outputs["A.force"][1:], expected[1:], rtol=1e-9)


# -- a crank and a block on a rail, with a link between them -----------------------------------------------------------

RADIUS, LENGTH, RAIL, FOOT = 0.2, 0.6, np.array([0.0, 0.6, 0.8]), np.array([0.15, 0.1, 0.0])
CRANK, BLOCK = 1.5, 0.8


def on_crank(angle: float) -> np.ndarray:
    """Return the link's end on the crank, which turns about x; the crank's centre is half way."""
    return RADIUS * np.array([0.0, np.cos(angle), np.sin(angle)])


def on_rail(angle: float) -> float:
    """Return the displacement of the block: the larger root of |end - foot - s rail| = length."""
    to = on_crank(angle) - FOOT
    along = to @ RAIL
    return float(along + np.sqrt(along**2 - to @ to + LENGTH**2))


def linked(friction: dict[str, dict[str, float]]) -> Mechanism:
    angle = 0.4
    raw = {
        "mechanism": {"name": "linked", "space": "spatial", "gravity": GRAVITY.tolist()},
        "bodies": {
            "crank": {"mass": CRANK, "inertia": [0.02, 0.03, 0.04],
                      "points": {"a": [0.0, -RADIUS / 2, 0.0], "b": [0.0, RADIUS / 2, 0.0]},
                      "position": (on_crank(angle) / 2).tolist(),
                      "orientation": {"rotation_vector": [angle, 0.0, 0.0]}},
            "block": {"mass": BLOCK, "inertia": [0.01, 0.01, 0.01],
                      "position": (FOOT + on_rail(angle) * RAIL).tolist()},
        },
        "joints": {
            "pin": {"type": "revolute", "between": ["ground", "crank"], "at": [[0.0, 0.0, 0.0], "a"],
                    "axis": [1.0, 0.0, 0.0]},
            "rail": {"type": "translational", "between": ["ground", "block"], "at": [FOOT.tolist(), "centre"],
                     "axis": RAIL.tolist()},
            "link": {"type": "distance", "between": ["crank", "block"], "at": ["b", "centre"], "length": LENGTH},
        },
    }  # fmt: skip
    for joint, keys in friction.items():
        raw["joints"][joint]["friction"] = keys
    return validate(raw, "linked.toml")


def rates_of_linkage(x: np.ndarray, v: np.ndarray) -> np.ndarray:
    end, s = on_crank(x[0]), on_rail(x[0])
    link = (end - FOOT - s * RAIL) / LENGTH
    turning = np.cross([1.0, 0.0, 0.0], end)
    return np.array([v[0], (link @ turning) / (link @ RAIL) * v[0]])


def linkage(x: np.ndarray, v: np.ndarray) -> tuple[Any, ...]:
    """Unknowns: the crank's and the block's accelerations and the force T of the link, which pulls."""
    end, s = on_crank(x[0]), on_rail(x[0])
    link = (end - FOOT - s * RAIL) / LENGTH
    turning, slide = np.cross([1.0, 0.0, 0.0], end), rates_of_linkage(x, v)[1]
    relative = turning * v[0] - RAIL * slide
    inertia = 0.02 + CRANK * RADIUS**2 / 4
    matrix = np.array([
        [inertia, 0.0, turning @ link],
        [0.0, BLOCK, -RAIL @ link],
        [link @ turning, -link @ RAIL, 0.0],
    ])  # fmt: skip
    closing = -(relative @ relative) / LENGTH + link @ end * v[0] ** 2
    right = np.array([CRANK * turning @ GRAVITY / 2, BLOCK * RAIL @ GRAVITY, closing])
    of_pin = np.stack([CRANK * turning / 2, np.zeros(3), link], axis=1)
    of_rail = np.stack([np.zeros(3), BLOCK * RAIL, -link], axis=1)
    radial, across = np.diag([0.0, 1.0, 1.0]), np.eye(3) - np.outer(RAIL, RAIL)
    reactions = [
        (radial @ of_pin, radial @ (-CRANK * (end / 2 * v[0] ** 2 + GRAVITY))),
        (across @ of_rail, across @ (-BLOCK * GRAVITY)),
    ]
    return matrix, np.eye(3)[:, :2], right, reactions


@pytest.mark.by_turns(2)
@pytest.mark.slow
@pytest.mark.parametrize("coordinates", ["absolute", "joint"])
def test_a_hinge_and_a_slide_of_a_loop_rub_by_their_reactions(coordinates: str) -> None:
    reference = Sliding(linkage, rates_of_linkage, [0.02, 0.15])
    times, x = reference.run(np.array([0.4]), np.zeros(1), 5.0)
    model = symgen.load(linked({"pin": {"coefficient": 0.4, "radius": 0.05}, "rail": {"coefficient": 0.15}}))
    result = model.simulate(until=5.0, output_step=0.5, coordinates=coordinates, **EXACT)
    passed = sorted({e.t for e in result.events})
    assert len(times) > 4 and result.events[-1].name.endswith("stick")
    np.testing.assert_allclose(passed, times, rtol=0, atol=1e-9)
    assert abs(result["pin.angle"][-1] - result["pin.angle"][0] - x[0] + 0.4) < 1e-9


# -- a sleeve ----------------------------------------------------------------------------------------------------------


def sleeve(**friction: Any) -> Mechanism:
    raw = {
        "mechanism": {"name": "sleeve", "space": "spatial", "gravity": GRAVITY.tolist()},
        "bodies": {"rod": {"mass": MASS, "inertia": np.diag(INERTIA).tolist(), "points": {"p": PIN.tolist()},
                           "position": (-PIN).tolist(), "velocity": (np.cross(AXIS, -PIN) * 2.0 + AXIS * 2.0).tolist(),
                           "angular_velocity": (AXIS * 2.0).tolist()}},
        "joints": {"A": {"type": "cylindrical", "between": ["ground", "rod"], "at": [[0.0, 0.0, 0.0], "p"],
                         "axis": AXIS.tolist(), "friction": friction}},
    }  # fmt: skip
    return validate(raw, "sleeve.toml")


def sleeved(x: np.ndarray, v: np.ndarray) -> tuple[Any, ...]:
    matrix, _, right, ((of, rest),) = hinged(x, v)
    both = np.diag([matrix[0, 0], MASS])
    reaction = np.concatenate([of, np.zeros((2, 1))], axis=1), rest
    return both, np.eye(2), np.array([right[0], MASS * AXIS @ GRAVITY]), [reaction, reaction]


@pytest.mark.slow
def test_a_sleeve_rubs_along_and_about_its_axis() -> None:
    """Each of its coordinates has a force of its own by the force across the axis."""
    reference = Sliding(sleeved, lambda x, v: v, [0.05, 0.1])
    times, x = reference.run(np.zeros(2), np.array([2.0, 2.0]), 1.5)
    friction = {"angle": {"coefficient": 0.5, "radius": 0.1}, "displacement": {"coefficient": 0.1}}
    result = symgen.load(sleeve(**friction)).simulate(until=1.5, output_step=0.5, **EXACT)
    assert len(times) > 1
    np.testing.assert_allclose([e.t for e in result.events], times, rtol=0, atol=1e-9)
    np.testing.assert_allclose([result["A.angle"][-1], result["A.displacement"][-1]], x, rtol=0, atol=1e-9)


# -- what has no meaning -----------------------------------------------------------------------------------------------


def test_other_joints_are_named() -> None:
    raw_friction = {"coefficient": 0.5, "radius": 0.1}
    with pytest.raises(
        InputError, match=r"among revolute, translational, cylindrical, slides-on, got a universal joint"
    ):
        raw = {
            "mechanism": {"name": "cross", "space": "spatial"},
            "bodies": {"rod": {"mass": 1.0, "inertia": [1.0, 1.0, 1.0]}},
            "joints": {"A": {"type": "universal", "between": ["ground", "rod"], "at": [[0.0, 0.0, 0.0], "centre"],
                             "axes": [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]], "friction": {"angle1": raw_friction}}},
        }  # fmt: skip
        validate(raw, "cross.toml")

"""Dry friction by the reaction of a joint against references in minimal coordinates, and what has no meaning."""

import copy
from typing import Any

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import symgen
from symgen.base.errors import InputError
from symgen.describe.files.load import read_raw
from symgen.describe.files.validate import validate
from symgen.describe.mechanism import Mechanism

#: mu r of a pin [m].
ARM = {"coefficient": 0.5, "radius": 0.1}


def four_bar(**frictions: dict[str, Any]) -> Mechanism:
    raw, source = read_raw("four-bar")
    raw = copy.deepcopy(raw)
    for joint, friction in frictions.items():
        raw["joints"][joint]["friction"] = friction
    return validate(raw, source)


def slider_crank(friction: dict[str, Any]) -> Mechanism:
    crank, rod = np.array([np.cos(1.0), np.sin(1.0)]), -np.arcsin(0.2 * np.sin(1.0) / 0.5)
    b = 0.2 * crank
    c = b + 0.5 * np.array([np.cos(rod), np.sin(rod)])
    pin = {"type": "revolute"}
    raw = {
        "mechanism": {"name": "slider", "gravity": [0.0, -9.81]},
        "bodies": {
            "crank": {"mass": 1.0, "inertia": 0.04 / 12, "points": {"a": [-0.1, 0.0], "b": [0.1, 0.0]},
                      "position": (b / 2).tolist(), "angle": 1.0},
            "rod": {"mass": 1.0, "inertia": 0.25 / 12, "points": {"b": [-0.25, 0.0], "c": [0.25, 0.0]},
                    "position": ((b + c) / 2).tolist(), "angle": float(rod)},
            "block": {"mass": 0.5, "inertia": 1.0, "position": c.tolist()},
        },
        "joints": {
            "A": {**pin, "between": ["ground", "crank"], "at": [[0.0, 0.0], "a"]},
            "B": {**pin, "between": ["crank", "rod"], "at": ["b", "b"]},
            "C": {**pin, "between": ["rod", "block"], "at": ["c", "centre"]},
            "slide": {"type": "translational", "between": ["ground", "block"], "at": [[0.0, 0.0], "centre"],
                      "axis": [1.0, 0.0], "friction": friction},
        },
    }  # fmt: skip
    return validate(raw, "slider.toml")


@pytest.mark.by_turns(2)
@pytest.mark.slow
@pytest.mark.slow_cases("dop853-absolute", "picard-absolute")
@pytest.mark.parametrize(
    ("integrator", "coordinates"), [("dop853", "absolute"), ("picard", "absolute"), ("dop853", "joint")]
)
def test_a_pin_rubs_by_its_own_reaction(integrator: str, coordinates: str) -> None:
    """Half swings and rest of the four-bar, from minimal coordinates and full Newton-Euler in NumPy."""
    settings = {"rtol": 1e-12, "atol": 1e-12, "integrator": integrator, "coordinates": coordinates}
    result = symgen.load(four_bar(A=ARM)).simulate(until=25.0, output_step=1.0, **settings)
    assert [e.name for e in result.events] == ["A.reverse"] * 17 + ["A.stick"]
    assert abs(result.events[-1].t - 24.1083153831) < 1e-9
    assert abs(result["crank.theta"][-1] + 2.14493122869) < 1e-10


@pytest.mark.slow
@pytest.mark.parametrize("coordinates", ["absolute", "joint"])
def test_a_slide_rubs_by_its_normal_force(coordinates: str) -> None:
    result = symgen.load(slider_crank({"coefficient": 0.3})).simulate(
        until=2.5, integrator="dop853", rtol=1e-12, atol=1e-12, output_step=0.5, coordinates=coordinates
    )
    times = [e.t for e in result.events if e.name != "slide.reverse" or e.t > 0.5]
    np.testing.assert_allclose(times, [0.859203053389, 1.37849207954, 2.00166970939], rtol=0, atol=1e-10)
    assert abs(result["crank.theta"][-1] + 1.75991021743) < 1e-10


@pytest.mark.slow
def test_implicit_schemes_and_outputs() -> None:
    """Friction of unknown multipliers, and the force of an output, whose work is what the energy loses."""
    model = symgen.load(four_bar(A=ARM))
    result = model.simulate(until=3.0, method="ggl", integrator="radau5", rtol=1e-9, output_step=0.5)
    assert [e.name for e in result.events] == ["A.reverse"]
    assert abs(result.events[0].t - 2.555500444992) < 1e-6
    pins = np.hypot(result["multiplier.A.x"], result["multiplier.A.y"])
    sliding = -0.05 * pins * np.sign(result["crank.omega"])
    np.testing.assert_allclose(result.outputs["A.force"][1:], sliding[1:], rtol=1e-9)


@pytest.mark.slow
def test_reactions_that_are_not_determined_are_named() -> None:
    raw, source = read_raw("four-bar")
    raw = copy.deepcopy(raw)
    raw["joints"]["A"]["friction"] = ARM
    raw["joints"]["twin"] = {key: value for key, value in raw["joints"]["A"].items() if key != "friction"}
    with pytest.raises(InputError, match=r"joints\.A\.friction: .* reaction is determined, .* twin\.x and A\.x"):
        symgen.load(validate(raw, source)).simulate(until=0.1)
    raw["joints"]["twin"] = {"type": "distance", "between": ["ground", "crank"], "at": [[0.0, 0.0], "B"], "length": 2.0}
    with pytest.raises(InputError, match=r"friction of A: expected rows that determine all reactions"):
        symgen.load(validate(raw, source)).simulate(until=0.1)


# -- bounds of being determined ----------------------------------------------------------------------------------------


def ramp(angle: float, coefficient: float) -> Mechanism:
    raw = {
        "mechanism": {"name": "ramp", "gravity": [0.0, -9.81]},
        "bodies": {"block": {"mass": 2.0, "inertia": 1.0}},
        "joints": {
            "slope": {"type": "translational", "between": ["ground", "block"], "at": [[0.0, 0.0], "centre"],
                      "axis": [float(np.cos(angle)), float(np.sin(angle))],
                      "angle": 0.0, "friction": {"coefficient": coefficient}}
        },
    }  # fmt: skip
    return validate(raw, "ramp.toml")


@pytest.mark.slow
def test_a_block_slides_beyond_the_critical_angle() -> None:
    angle = float(np.arctan(0.4))
    result = symgen.load(ramp(angle - 1e-9, 0.4)).simulate(until=10.0, output_step=1.0)
    assert result.events == () and np.abs(result["block.x"]).max() < 1e-13
    result = symgen.load(ramp(angle + 1e-9, 0.4)).simulate(until=10.0, output_step=1.0)
    # g (sin - mu cos) of an excess e is g e / cos
    expected = -0.5 * 9.81 * 1e-9 / np.cos(angle) * 100.0
    along = result["block.x"][-1] * np.cos(angle) + result["block.y"][-1] * np.sin(angle)
    assert abs(along - expected) < 1e-3 * abs(expected)


def painleve(coefficient: float) -> Mechanism:
    """A uniform rod of 1 m whose tip slides along a slot; at tan = 2 the friction is worst."""
    angle = float(np.arctan(2.0))
    half = 0.5 * np.array([np.cos(angle), np.sin(angle)])
    raw = {
        "mechanism": {"name": "painleve-rod", "gravity": [0.0, -9.81]},
        "bodies": {"rod": {"mass": 1.0, "inertia": 1.0 / 12.0, "points": {"tip": [-0.5, 0.0]}, "angle": angle,
                           "position": half.tolist(), "velocity": [1.0, 0.0]}},
        "joints": {"slot": {"type": "pin-in-slot", "between": ["rod", "ground"], "at": ["tip", [0.0, 0.0]],
                            "axis": [1.0, 0.0],
                            "friction": {"displacement": {"coefficient": coefficient}}}},
    }  # fmt: skip
    return validate(raw, "rod.toml")


def test_inspect_shows_jamming_numbers() -> None:
    """Of the rod 3 mu sin cos / (1 + 3 cos^2), which is 3 mu / 4 at tan = 2."""
    inspected = symgen.load(painleve(0.5)).inspect()
    (friction,) = inspected.facts["friction"]
    assert friction["reaction"] == ["slot.normal"]
    assert abs(friction["jamming_number"] - 0.375) < 1e-12
    assert "up to 0.5 times the force of slot.normal; 0.5 in motion; jamming number 0.375 at the start" in str(
        inspected
    )


@pytest.mark.slow
def test_friction_that_brings_about_its_own_reaction_is_named() -> None:
    """1 + 3 cos^2 = 3 mu sin cos: the least mu is 4/3 at tan = 2 (Painleve 1895)."""
    symgen.load(painleve(4.0 / 3.0 - 1e-9)).simulate(until=1e-6)
    with pytest.raises(InputError, match=r"friction of slot.displacement: .* jamming number below 1\), got 1"):
        symgen.load(painleve(4.0 / 3.0 + 1e-9)).simulate(until=1e-6)


# -- four pins ---------------------------------------------------------------------------------------------------------


class FourPins:
    """The four-bar with friction by the reactions of all pins, in the crank's angle, from Newton and Euler."""

    lengths, masses, kappa = np.array([2.0, 8.0, 5.0]), np.array([2.0, 8.0, 5.0]), 0.05

    def angles(self, crank: float) -> np.ndarray:
        b, d = 2.0 * np.array([np.cos(crank), np.sin(crank)]), np.array([10.0, 0.0])
        to, span = d - b, np.linalg.norm(d - b)
        coupler = np.arctan2(to[1], to[0]) + np.arccos((64.0 + span**2 - 25.0) / (16.0 * span))
        c = b + 8.0 * np.array([np.cos(coupler), np.sin(coupler)])
        return np.array([crank, coupler, np.arctan2(*(c - d)[::-1])])

    def rates(self, angles: np.ndarray, speed: float) -> np.ndarray:
        e = np.stack([-np.sin(angles), np.cos(angles)]) * self.lengths
        return np.array([speed, *np.linalg.solve(np.stack([e[:, 1], -e[:, 2]], axis=1), -e[:, 0] * speed)])

    @staticmethod
    def relative(omega: np.ndarray) -> np.ndarray:
        """Rates of the pins A, B, C, D."""
        return np.array([omega[0], omega[1] - omega[0], omega[2] - omega[1], omega[2]])

    def acceleration(self, y: np.ndarray, signs: np.ndarray) -> float:
        """Return the crank's angular acceleration.

        Unknowns are accelerations of the three centres and angles, then the forces of A, B, C, D: of A and D on crank
        and rocker, of B on the coupler, of C on the rocker.
        """
        angles = self.angles(y[0])
        omega = self.rates(angles, y[1])
        half = np.stack([np.cos(angles), np.sin(angles)], axis=1) * self.lengths[:, None] / 2
        turned = np.stack([-half[:, 1], half[:, 0]], axis=1)
        matrix, right = np.zeros((17, 17)), np.zeros((17, 5))
        for i in range(3):
            matrix[3 * i, 3 * i] = matrix[3 * i + 1, 3 * i + 1] = self.masses[i]
            matrix[3 * i + 2, 3 * i + 2] = self.masses[i] * self.lengths[i] ** 2 / 12
            right[3 * i + 1, 0] = -9.81 * self.masses[i]
        # pins: (body of +force, end), (body of -force, end)
        ends = (((0, -1.0), None), ((1, -1.0), (0, 1.0)), ((2, 1.0), (1, 1.0)), ((2, -1.0), None))
        for k, (plus, minus) in enumerate(ends):
            for end, sign in ((plus, 1.0), (minus, -1.0)):
                if end is None:
                    continue
                body, side = end
                for axis in range(2):
                    matrix[3 * body + axis, 9 + 2 * k + axis] -= sign
                    matrix[9 + 2 * k + axis, 3 * body + axis] += sign
                    right[9 + 2 * k + axis, 0] += sign * side * half[body, axis] * omega[body] ** 2
                    matrix[3 * body + 2, 9 + 2 * k + axis] -= sign * side * turned[body, axis]
                    matrix[9 + 2 * k + axis, 3 * body + 2] += sign * side * turned[body, axis]
            first = {0: (0,), 1: (1, 0), 2: (2, 1), 3: (2,)}[k]
            for body, sign in zip(first, (-1.0, 1.0), strict=False):
                right[3 * body + 2, 1 + k] += sign * signs[k]
        x = np.linalg.solve(matrix, right)
        torques = np.zeros(4)
        for _ in range(200):
            before = torques
            torques = self.kappa * np.linalg.norm((x[9:, 0] + x[9:, 1:] @ torques).reshape(4, 2), axis=1)
            if np.abs(torques - before).max() < 1e-14 * torques.max():
                break
        return float(x[2, 0] + x[2, 1:] @ torques)

    def run(self, until: float) -> tuple[list[float], float]:
        """Return the times at which pins turn round, and the last angle."""
        t, y, times, rest = 0.0, np.array([np.pi / 3, 0.0]), [], True
        signs = np.zeros(4)
        while t < until:
            if rest:
                ways = self.relative(self.rates(self.angles(y[0]), 1.0))
                signs = next((np.sign(s * ways) for s in (1.0, -1.0)
                              if s * self.acceleration(y, np.sign(s * ways)) > 0.0), None)  # fmt: skip
                if signs is None:
                    break
            events = [
                lambda t, y, i=i, s=signs: s[i] * self.relative(self.rates(self.angles(y[0]), y[1]))[i]
                for i in range(4)
            ]
            for event in events:
                event.terminal, event.direction = True, -1
            part = solve_ivp(lambda t, y, s=signs: [y[1], self.acceleration(y, s)], (t, until), y, method="DOP853",
                             rtol=1e-12, atol=1e-13, events=events)  # fmt: skip
            t, y = part.t[-1], part.y[:, -1]
            if part.status == 1:
                times.append(t)
                hit = [len(x) > 0 for x in part.t_events]
                rest = abs(y[1]) < 1e-10
                y[1] = 0.0 if rest else y[1]
                signs = np.where(hit, -signs, signs)
        return times, float(y[0])


@pytest.mark.slow
def test_four_pins_rub_by_their_reactions() -> None:
    """The first transitions by the reference itself; it takes 12 s to the rest."""
    times, _ = FourPins().run(1.95)
    model = symgen.load(four_bar(A=ARM, B=ARM, C=ARM, D=ARM))
    result = model.simulate(until=14.0, integrator="dop853", rtol=1e-12, atol=1e-12, output_step=1.0)
    passed = sorted({e.t for e in result.events})
    np.testing.assert_allclose(passed[: len(times)], times, rtol=0, atol=1e-9)
    assert len(passed) == 21 and abs(passed[-1] - 12.50530143408804) < 1e-9
    assert abs(result["crank.theta"][-1] + 2.18145639479929) < 1e-9


# -- rows of sweeps ----------------------------------------------------------------------------------------------------


@pytest.mark.by_turns(2)
@pytest.mark.slow
@pytest.mark.parametrize(("integrator", "coordinates"), [("dop853", "absolute"), ("picard", "joint")])
def test_rows_choose_modes_by_reactions_in_compiled_loops(integrator: str, coordinates: str) -> None:
    """Pins that turn round and rest beside one of constant bound: each row has the bits of a single run."""
    raw, source = read_raw("four-bar")
    raw = copy.deepcopy(raw)
    raw["parameters"]["mu"] = 0.5
    raw["joints"]["A"]["friction"] = {"coefficient": "mu", "static_coefficient": "1.1*mu", "radius": 0.1}
    raw["joints"]["C"]["friction"] = {"coefficient": 0.1, "radius": 0.1}
    raw["joints"]["D"]["friction"] = {"sliding": 1.0}
    model, values = symgen.Model(validate(raw, source)), (0.4, 0.8, 90.0)
    settings = {"integrator": integrator, "until": 9.0, "times": [3.0, 9.0], "coordinates": coordinates}
    alone = [model.simulate(parameters={"mu": x}, verify=False, **settings) for x in values[:2]]
    assert all(len(run.events) > 8 for run in alone)
    with pytest.raises(InputError, match="jamming number") as refused:
        model.simulate(parameters={"mu": values[2]}, verify=False, **settings)
    rows = model.sweep({"mu": list(values)}, quantities=("crank.theta", "A.mode", "C.force"), **settings)
    for i, run in enumerate(alone):
        assert rows["crank.theta"][i].tolist() == run["crank.theta"].tolist()
        assert rows["A.mode"][i].tolist() == run["A.mode"].tolist()
        np.testing.assert_allclose(rows["C.force"][i], run["C.force"], rtol=1e-11)
    assert rows.status[2] == "failed" and rows.reason[2] == str(refused.value)


@pytest.mark.slow
def test_pins_that_share_their_rest_rest_as_long_as_any_forces_hold() -> None:
    """Four pins whose forces at rest nothing determines, beside a torque that follows the time, as single runs do."""
    raw, source = read_raw("four-bar")
    raw = copy.deepcopy(raw)
    raw["parameters"]["mu"] = 2.0
    for pin in "ABCD":
        raw["joints"][pin]["friction"] = {"coefficient": "mu", "radius": 0.3}
    model, settings = symgen.Model(validate(raw, source)), {"until": 0.5, "integrator": "dop853"}
    rows = model.sweep({"mu": [2.0]}, quantities=("crank.theta", "crank.omega"), times=[0.5], **settings)
    assert rows.status[0] == "ok" and abs(rows["crank.omega"][0, 0]) < 1e-14
    raw["forces"] = {**raw.get("forces", {}), "motor": {"type": "torque", "body": "crank", "torque": "0.01*sin(t)"}}
    model = symgen.Model(validate(raw, source))
    rows = model.sweep({"mu": [0.2, 2.0]}, quantities=("crank.theta", "crank.omega"), times=[0.5], **settings)
    assert list(rows.status) == ["ok", "ok"] and abs(rows["crank.omega"][1, 0]) < 1e-14
    result = model.simulate(**settings)
    for pin in "ABCD":
        reaction = np.hypot(result[f"{pin}.Fx"], result[f"{pin}.Fy"])
        assert np.all(np.abs(result[f"{pin}.force"]) <= 2.0 * 0.3 * reaction * (1.0 + 1e-9))

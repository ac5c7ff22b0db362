"""Analyses with stops: closed ones are rows whose forces push, open ones are left out, and the notes have both."""

import math

import numpy as np
import pytest

import symgen
from symgen.api import Model
from symgen.base.errors import AnalysisError, InputError
from symgen.describe.files.load import parse_toml
from symgen.describe.files.validate import validate

G = 9.81
OPEN, CLOSED = "stops as at the start: {} open, left out", "stops as at the start: {} closed, held as rows"


def rope(lengths: str = "2.0") -> Model:
    """A mass of 3 kg on a rope."""
    return symgen.load(
        validate(
            {
                "mechanism": {"name": "rope", "gravity": [0.0, -G]},
                "bodies": {"bob": {"type": "point", "mass": 3.0, "position": [0.0, -2.0]}},
                "stops": {"rope": {"gap": f"{lengths} - sqrt(bob.x**2 + bob.y**2)"}},
            },
            "rope",
        )
    )


def arm(stop: dict[str, float]) -> Model:
    """A level arm of 2 kg and 1 m with a stop, and a rod of 1 kg and 0.6 m that hangs from its end."""
    return symgen.load(
        validate(
            {
                "mechanism": {"name": "arm", "gravity": [0.0, -G]},
                "bodies": {
                    "arm": {"mass": 2.0, "inertia": 0.2, "position": [0.5, 0.0], "angle": 0.0},
                    "rod": {"mass": 1.0, "inertia": 0.03, "position": [1.0, -0.3]},
                },
                "joints": {
                    "A": {
                        "type": "revolute",
                        "between": ["ground", "arm"],
                        "at": [[0.0, 0.0], [-0.5, 0.0]],
                        "stop": stop,
                    },
                    "B": {"type": "revolute", "between": ["arm", "rod"], "at": [[0.5, 0.0], [0.0, 0.3]]},
                },
            },
            "arm",
        )
    )


def test_a_taut_rope_is_a_pendulum() -> None:
    rest = rope().equilibrium()
    assert rest.stability == "stable"
    assert rest.omega_squared == pytest.approx((G / 2.0,), rel=1e-12)
    assert rest.multipliers["rope.stop"] == pytest.approx(-3.0 * G, rel=1e-12)  # which pulls the mass back
    assert rest.notes == (CLOSED.format("rope"),)
    modes, system = rope().modes(), rope().linearise()
    root = math.sqrt(G / 2.0)
    assert np.allclose(modes.eigenvalues, [1j * root, -1j * root], rtol=0, atol=1e-12)
    assert np.allclose(sorted(system.eigenvalues().imag), [-root, root], rtol=0, atol=1e-12)
    assert CLOSED.format("rope") in modes.notes
    assert CLOSED.format("rope") in system.notes


def test_a_rope_does_not_hold_a_mass_from_below() -> None:
    with pytest.raises(AnalysisError, match=r"closed stop rope does not push there \(force -29\.43 N\): start with it"):
        rope().linearise(at="start", start={"bob.y": 2.0})


@pytest.mark.slow_cases("joint")
@pytest.mark.parametrize("coordinates", ["absolute", "joint"])
def test_an_arm_on_a_stop_carries_a_pendulum(coordinates: str) -> None:
    """Gravity turns the arm down: a lower stop holds it."""
    model = arm({"lower": 0.0})
    rest = model.equilibrium(coordinates=coordinates)
    squared = 1.0 * G * 0.3 / (0.03 + 1.0 * 0.3**2)
    assert rest.omega_squared == pytest.approx((squared,), rel=1e-11)
    assert rest.multipliers["A.lower.stop"] == pytest.approx(-(2.0 * 0.5 + 1.0 * 1.0) * G, rel=1e-12)
    system = model.linearise(coordinates=coordinates)
    assert len(system.states) == 2
    assert np.allclose(sorted(system.eigenvalues().imag), [-math.sqrt(squared), math.sqrt(squared)], atol=1e-11)
    assert CLOSED.format("A.lower") in system.notes
    modes = model.modes(coordinates=coordinates)
    assert modes.omega_squared == pytest.approx((squared,), rel=1e-11)
    assert CLOSED.format("A.lower") in modes.notes
    assert model.equilibria(("rod.theta", np.linspace(-1.0, 1.0, 6)), coordinates=coordinates)[0].stability == "stable"


@pytest.mark.parametrize("coordinates", ["absolute", "joint"])
def test_a_closed_stop_that_would_pull_opens(coordinates: str) -> None:
    """The arm hangs then; a steady motion keeps the rows of its start, and is refused."""
    rest = arm({"upper": 0.0}).equilibrium(coordinates=coordinates)
    assert rest.q["arm.theta"] == pytest.approx(-math.pi / 2, abs=1e-9) and len(rest.omega_squared) == 2
    assert "stops in the rest that was found: A.upper open, left out" in rest.notes
    told = "another rest than with rows as at the start, where the closed stop A.upper does not push there"
    assert any(told in note for note in rest.notes)
    for analysis in ("linearise", "modes"):
        notes = getattr(arm({"upper": 0.0}), analysis)(coordinates=coordinates).notes
        assert "stops in the rest that was found: A.upper open, left out" in notes
    with pytest.raises(AnalysisError, match=r"closed stop A\.upper does not push there \(force -19\.62 N m\)"):
        arm({"upper": 0.0}).steady(coordinates=coordinates)


def test_an_open_stop_is_left_out_unless_the_rest_is_at_it() -> None:
    start = {"arm.theta": -1.0, "rod.theta": 0.0}
    free = arm({"lower": -2.0}).equilibrium(start=start)
    assert free.q["arm.theta"] == pytest.approx(-math.pi / 2, abs=1e-9)
    assert free.notes == (OPEN.format("A.lower"),)
    assert len(free.omega_squared) == 2
    rest = arm({"lower": -1.2}).equilibrium(start=start)
    assert rest.q["arm.theta"] == pytest.approx(-1.2, abs=1e-12)
    assert rest.multipliers["A.lower.stop"] == pytest.approx(-2.0 * G * math.cos(1.2), rel=1e-10)
    assert any("A.lower, open at the start, is passed there (its gap is -0.37" in note for note in rest.notes)
    assert len(arm({"lower": -1.2}).linearise(start=start).eigenvalues()) == 2
    assert len(arm({"lower": -1.2}).modes(start=start).eigenvalues) == 2
    with pytest.raises(AnalysisError, match=r"no equilibrium was found with arm\.theta"):
        arm({"lower": -1.2}).equilibria(("arm.theta", np.linspace(-2.0, -1.0, 6)), start=start)


@pytest.mark.slow
def test_the_mode_is_that_of_the_time_of_a_run() -> None:
    """The mass falls until its rope is taut, which does not rebound."""
    model = rope("2.5")
    system = model.linearise(at=8.0, start={"bob.y": -1.0})
    assert CLOSED.format("rope") in system.notes
    assert system.about["bob.x"] == pytest.approx(0.0, abs=1e-9)
    assert np.allclose(sorted(system.eigenvalues().imag), [-math.sqrt(G / 2.5), math.sqrt(G / 2.5)], atol=1e-9)


@pytest.mark.slow
def test_a_time_of_a_run_with_friction_is_a_place() -> None:
    """Friction of 0.5 N is left out there, as at a start; the block of 2 kg is between a spring of 8 N/m and a wall."""
    raw = {
        "mechanism": {"name": "block"},
        "bodies": {"block": {"mass": 2.0, "inertia": 1.0, "position": [1.0, 0.0]}},
        "joints": {
            "rail": {
                "type": "translational",
                "between": ["ground", "block"],
                "at": [[0.0, 0.0], "centre"],
                "axis": [1.0, 0.0],
                "friction": {"sliding": 0.5},
                "stop": {"lower": -5.0},
            }
        },
        "forces": {"spring": {"type": "force", "body": "block", "force": ["-8*block.x", 0.0]}},
    }
    system = symgen.load(validate(raw, "block")).linearise(at=0.3, instantaneous=True, states=["block.x", "block.vx"])
    assert np.allclose(system.A, [[0.0, 1.0], [-4.0, 0.0]], rtol=0, atol=1e-12)
    assert OPEN.format("rail.lower") in system.notes


@pytest.mark.parametrize(
    ("start", "sentence"),
    [
        ({"bob.y": -2.1}, "stop rope: expected a gap of at least 0, got -0.1; a start within all stops"),
        ({"bob.vy": -1.0}, "stop rope: expected a state without an impact, got a rate of -1; a run has it"),
    ],
)
def test_starts_that_no_mode_has(start: dict[str, float], sentence: str) -> None:
    for analysis in (rope().equilibrium, rope().linearise, rope().modes):
        with pytest.raises(InputError, match=sentence):
            analysis(start=start)


def test_pieces_of_a_gap_are_rows_of_their_own() -> None:
    """A point on a floor that becomes a ramp: it lies on the first piece, and swings along it on a spring."""
    text = """
[mechanism]
name = "valley"
gravity = [0.0, -9.81]
[bodies.point]
type = "point"
mass = 2.0
[forces.spring]
type = "force"
body = "point"
force = ["-50*point.x", 0.0]
[stops.floor]
gap = "point.y - max(0, point.x - 1)"
"""
    model = symgen.Model(validate(parse_toml(text, "valley.toml"), "valley.toml"))
    modes = model.modes(at="start")
    assert [abs(x.imag) for x in modes.eigenvalues] == pytest.approx([5.0, 5.0], abs=1e-12)
    assert any("floor.1" in note and "floor.2" in note for note in modes.notes)


@pytest.mark.parametrize("at", [0.3, 0.7])
def test_a_contact_is_judged_where_its_file_has_it(at: float) -> None:
    """Files that differ in the place of a wall alone, which is left out where it is open, have gaps of their own."""
    between = [{"body": "bob", "disc": 0.1}, {"line": "ground", "on": [0.0, -at], "normal": [0.0, 1.0]}]
    model = symgen.load(
        validate(
            {
                "mechanism": {"name": "hung", "gravity": [0.0, -G]},
                "bodies": {"bob": {"mass": 1.0, "inertia": 0.01, "position": [0.0, 0.0]}},
                "forces": {"spring": {"type": "force", "body": "bob", "force": [0.0, f"-{G / 0.5}*bob.y"]}},
                "joints": {
                    "rail": {
                        "type": "translational",
                        "between": ["ground", "bob"],
                        "at": [[0.0, 0.0], "centre"],
                        "axis": [0.0, 1.0],
                    }
                },
                "contacts": {"floor": {"between": between}},
            },
            "hung",
        )
    )
    if at > 0.5 + 0.1:
        assert model.equilibrium().q["bob.y"] == pytest.approx(-0.5, abs=1e-12)
    else:
        rest = model.equilibrium()
        assert rest.q["bob.y"] == pytest.approx(0.1 - at, abs=1e-12)
        assert any("contact floor, open at the start, is passed there (its gap is -0.3 " in x for x in rest.notes)

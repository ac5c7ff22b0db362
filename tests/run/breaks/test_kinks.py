"""Kinks that are known beforehand: adaptive runs end a step at each of them."""

import math
from collections.abc import Callable
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest
from scipy.interpolate import CubicSpline
from support.checks import assert_same_motion
from support.pushed import pushed_mass

import symgen
from symgen.describe import catalogue
from symgen.describe.facts.kinks import compares_state, discontinuities_of, jumps_in_time
from symgen.describe.formulas.parser import FormulaNames, parse
from symgen.describe.parts.driven_mechanism import Jump
from symgen.run.breaks.foreseen_seams import Foreseen, merge_seams, times_between
from symgen.run.breaks.in_time import InTime, line_of_formula
from symgen.run.loops.run_spec import Seam
from symgen.study.ensemble.parameter_sweep import sweep

#: Force over time, linear between points that no step would meet, and beyond them constant.
X, Y = (0.13, 0.29, 0.41, 0.77), (0.0, 5.0, -3.0, 2.0)
SLIDER = pushed_mass("pushed", "push(pace*t)", X, Y, "pace")


@pytest.fixture(scope="module")
def pushed(tmp_path_factory: pytest.TempPathFactory) -> symgen.Model:
    file = tmp_path_factory.mktemp("kinks") / "pushed.toml"
    file.write_text(SLIDER, encoding="utf-8")
    return symgen.load(file)


def moved(times: np.ndarray, rate: float, speed: float = 0.3) -> tuple[np.ndarray, np.ndarray]:
    """Position and speed of 2 kg under the force, piece by piece in closed form."""
    return pushed_by(lambda t: np.interp(rate * t, X, Y), np.array(X) / rate, times, speed)


def pushed_by(
    force_at: Callable[[np.ndarray], np.ndarray], kinks: np.ndarray, times: np.ndarray, speed: float
) -> tuple[np.ndarray, np.ndarray]:
    """Position and speed of 2 kg under a force that is linear between kinks."""
    edges = np.unique(np.concatenate([[0.0], kinks, times]))
    force = force_at(edges) / 2.0
    h, a, b = np.diff(edges), force[:-1], force[1:]
    v = speed + np.concatenate([[0.0], np.cumsum(h * (a + b) / 2.0)])
    x = np.concatenate([[0.0], np.cumsum(h * v[:-1] + h * h * (2.0 * a + b) / 6.0)])
    at = np.searchsorted(edges, times)
    return x[at], v[at]


@pytest.mark.parametrize("integrator", ["dop853", "dopri5", "radau5"])
def test_steps_end_at_points_of_a_table_of_time(pushed: symgen.Model, integrator: str) -> None:
    """Between kinks the motion is a polynomial of degree three, which schemes of order five have without error."""
    times = np.linspace(0.0, 1.0, 101)
    for rate in (1.0, 1.7):
        result = pushed.simulate(
            method="lagrange", integrator=integrator, step=1e-4, rtol=1e-6, times=times, parameters={"pace": rate}
        )
        x, v = moved(times, rate)
        assert result.status == "ok" and result.rejected == 0
        np.testing.assert_allclose(result.q["mass.x"], x, rtol=0.0, atol=1e-13)
        np.testing.assert_allclose(result.v["mass.vx"], v, rtol=0.0, atol=1e-13)


def test_steps_end_at_kinks_of_formulas(tmp_path: Path) -> None:
    file = tmp_path / "kinked.toml"
    formula = "6*max(pace*t - 0.4137, 0) - abs(1.3 - 2*t) + min(t, 0.9137)"
    file.write_text(SLIDER.replace("push(pace*t)", formula), encoding="utf-8")
    times = np.linspace(0.0, 1.0, 51)
    result = symgen.load(file).simulate(method="lagrange", integrator="dop853", rtol=1e-6, times=times)

    def force(t: np.ndarray) -> np.ndarray:
        return 6.0 * np.maximum(t - 0.4137, 0.0) - np.abs(1.3 - 2.0 * t) + np.minimum(t, 0.9137)

    x, v = pushed_by(force, np.array([0.4137, 0.65, 0.9137]), times, 0.3)
    assert result.status == "ok" and result.rejected == 0
    np.testing.assert_allclose(result.q["mass.x"], x, rtol=0.0, atol=1e-13)
    np.testing.assert_allclose(result.v["mass.vx"], v, rtol=0.0, atol=1e-13)


def test_constant_steps_keep_their_grid(pushed: symgen.Model) -> None:
    assert pushed.simulate(method="lagrange", integrator="rk4").steps == 100


def test_a_run_that_goes_on_stops_at_the_kinks_ahead(pushed: symgen.Model) -> None:
    settings = {"method": "lagrange", "integrator": "dop853", "rtol": 1e-6}
    first = pushed.simulate(until=0.35, times=[0.0, 0.35], **settings)
    second = pushed.simulate(start=first, times=[0.35, 0.6, 1.0], **settings)
    x, _ = moved(np.array([0.35, 0.6, 1.0]), 1.0)
    assert second.rejected == 0
    np.testing.assert_allclose(second.q["mass.x"], x, rtol=0.0, atol=1e-13)


@pytest.mark.slow_cases("pace")
@pytest.mark.parametrize("vary", ["pace", "start"])
def test_rows_of_a_sweep_stop_there_too(pushed: symgen.Model, vary: str) -> None:
    """They are what single runs are, wherever each row's kinks are."""
    name = {"pace": "pace", "start": "mass.vx"}[vary]
    settings = {"method": "lagrange", "integrator": "dop853", "rtol": 1e-6, "times": [0.3, 1.0]}
    values = [0.5, 1.25]
    found = sweep(pushed, {name: values}, quantities=("mass.x",), **settings)
    for i, value in enumerate(values):
        given = {"parameters": {"pace": value}} if vary == "pace" else {"start": {name: value}}
        alone = pushed.simulate(**settings, **given)
        assert_same_motion(found.values[i, 0], alone.q["mass.x"])
        x, _ = moved(np.array(settings["times"]), *((value,) if vary == "pace" else (1.0, value)))
        np.testing.assert_allclose(found.values[i, 0], x, rtol=0.0, atol=1e-13)


@pytest.mark.parametrize("integrator", ["dop853", "dopri5"])
def test_the_follower_of_a_cam_keeps_to_the_spline(integrator: str) -> None:
    """A periodic cubic lift over the angle of a cam that turns evenly twice: 47 kinks of the acceleration."""
    model = symgen.load("cam-follower")
    table = next(t for t in model.mechanism.tables if t.name == "lift")
    spline, speed = CubicSpline(table.x, table.y, bc_type="periodic"), 10.0 * math.pi
    times = np.linspace(0.0, 0.4, 201)
    result = model.simulate(method="lagrange", integrator=integrator, rtol=1e-8, atol=1e-10, times=times)
    assert result.status == "ok" and 10 * result.rejected < result.steps
    np.testing.assert_allclose(result.q["follower.y"], spline(speed * times), rtol=0.0, atol=1e-10)
    np.testing.assert_allclose(result.v["follower.vy"], speed * spline(speed * times, 1), rtol=0.0, atol=1e-9)


@pytest.mark.slow
def test_what_formulas_of_the_catalogue_pass() -> None:
    """Runs of all others are entered once."""
    every = {
        entry.name: symgen.load(entry.name).mechanism
        for entry in (*catalogue.entries(), *catalogue.entries(catalogue.MACHINES))
    }
    assert {name for name, m in every.items() if compares_state(m)} == {"inverted-pendulum", "geneva"}
    assert {name for name, m in every.items() if any(x.table for x in discontinuities_of(m))} == {"engine", "wiper"}
    # a table over an angle in time, a ramp that ends; none over an angle, over a speed
    counts = [len(jumps_in_time(every[name])[0]) for name in ("cam-follower", "scissor-lift", "engine", "wiper")]
    assert counts == [1, 1, 0, 0]


def _jump(text: str, levels: tuple[float, ...], period: float = 0.0) -> Jump:
    return Jump(parse(text, FormulaNames("a formula", {"w": "w", "t": "t"}, {}, {}), "here"), levels, period=period)


@pytest.mark.slow
def test_times_of_kinks() -> None:
    plain = symgen.load("pendulum").mechanism
    values, levels = {"w": -2.0}, (0.0, 1.0, 3.0)

    def times(text: str, until: float, levels: tuple[float, ...] = levels, period: float = 0.0) -> tuple[float, ...]:
        found, whole = times_between([_jump(text, levels, period)], plain, values, until)
        assert whole
        return found

    assert times("3 + w*t", 5.0) == (1.0, 1.5)
    # period 3: 2, 1, 0, -2, -3, ... are met at (3 - level) / 2
    np.testing.assert_allclose(times("2.5 + w*t", 4.0, period=3.0), [0.75, 1.25, 2.25, 2.75, 3.75])
    assert times("w", 5.0) == ()
    half = math.asin(0.5)
    assert times("sin(t)", 5.0, (0.5, 2.0)) == pytest.approx((half, math.pi - half))
    # from 0 to 4.5 and back to 0: over 1, 3, 4 = 1 + 3 and back again
    up = [math.asin(level / 4.5) for level in (1.0, 3.0, 4.0)]
    there = times("4.5*sin(t)", math.pi - 1e-3, period=3.0)
    np.testing.assert_allclose(there, [*up, *(math.pi - t for t in reversed(up))], rtol=1e-12)
    assert len(times("100*t", 5.0, period=3.0)) == 333
    assert times_between([_jump("1e6*t", levels, 3.0)], plain, values, 5.0) == ((), False)  # each would cost a step
    assert times_between([_jump("sin(1e6*t)", levels)], plain, values, 5.0) == ((), False)  # none is told from the next
    assert times_between([_jump("5 + sin(1e6*t)", (0.0, 1.0))], plain, values, 5.0) == (
        (),
        True,
    )  # nowhere near a level


@pytest.mark.parametrize("text", ["sin(w*t) - 0.3", "exp(t)*t - 2", "abs(2*t - 1)**0.5 - 0.1", "1/(t - 3) + 1"])
def test_times_are_the_first_numbers_on_the_other_side(text: str) -> None:
    """Whatever the samples were: a search of a part of the run finds the same."""
    formulas, jump = InTime(symgen.load("pendulum").mechanism, {"w": 11.0}), _jump(text, (0.0,))
    found = formulas.crossings(jump, 3.5)
    for t in found:
        sides = [formulas.value_at(jump.argument, x) > 0.0 for x in (math.nextafter(t, 0.0), t)]
        assert sides[0] != sides[1]
    parts = (*formulas.crossings(jump, 1.7), *formulas.crossings(jump, 3.5, 1.7))
    assert parts == found and len(found) >= 1


def test_a_kink_at_a_jump_ends_constant_steps_once() -> None:
    """What is compared jumps itself: its time is found in two ways, a rounding apart."""
    argument = "3*(1 if t > 1/3 else -1)"
    jumps = _jump(argument, (0.0,)), _jump("t - 1/3", (0.0,))
    seams = Foreseen(symgen.load("pendulum").mechanism, jumps[:1], jumps[1:], grid=(0.0, 0.1)).seams({}, 1.0)
    assert [seam.skips for seam in seams] == [False, True, False, False]
    assert [seam.t for seam in seams] == pytest.approx([0.0, 1.0 / 3.0, 1.0 / 3.0, 0.4], abs=2e-15)
    assert all(a.t < b.t for a, b in pairwise(seams))


def test_kinks_and_jumps_end_pieces_together() -> None:
    jumps = (Seam(0.0, {"u": 1.0}), Seam(0.2, {"u": 3.0}), Seam(0.5, {"u": 2.0}))
    kinks = (Seam(0.0, {}), Seam(0.3, {}), Seam(0.5, {}), Seam(0.7, {}))
    assert merge_seams(jumps, kinks) == (*jumps[:2], kinks[1], jumps[2], kinks[3])
    assert merge_seams((), kinks) == kinks and merge_seams(jumps, ()) == jumps


@pytest.mark.parametrize(
    ("text", "line"),
    [
        ("2*t - 1", (-1.0, 2.0)),
        ("-(t - k)/c", (3.4, -2.0)),
        ("k*(c*t + 1) - 3*t", (1.7, -2.15)),
        ("sin(k)", (math.sin(1.7), 0.0)),
        ("(z*t)*t", None),  # whatever the parameter is
        ("t/(1 + z*t)", None),
        ("t/z", None),
    ],
)
def test_straight_lines_are_those_for_all_parameters(text: str, line: tuple[float, float] | None) -> None:
    """A run in other languages, whose parameters change, takes the same formulas for lines."""
    names = {name: name for name in ("t", "k", "c", "z")}
    argument = parse(text, FormulaNames("a formula", names, {}, {}), "here")
    found = line_of_formula(Jump(argument), {"k": 1.7, "c": 0.5, "z": 0.0})
    assert found == (None if line is None else pytest.approx(line, rel=1e-15))

"""Parameters from data: exact ones are found again, intervals cover them, and what data cannot tell apart is named."""

import json

import numpy as np
import pytest
from run.directions.lengths import FOUR_BAR, ROD, model

from symgen import InputError
from symgen.analyses.search.squares import null_directions
from symgen.cli import main

TRUE = {"k": 300.0, "rest": 0.5, "damping": 8.0, "m2": 8.0, "m3": 5.0}
#: 20 to 40 % off.
WRONG = {"k": 390.0, "rest": 0.35, "damping": 4.8, "m2": 11.2, "m3": 4.0}
FINE = {"method": "lagrange", "integrator": "dop853", "rtol": 1e-12, "atol": 1e-12}
SPRING = """
[forces.spring]
type = "torsional-spring-damper"
between = ["ground", "rocker"]
stiffness = "k"
free_angle = "rest"
damping = "damping"
"""
NUMBERS = """k = { value = 300.0, unit = "N m/rad" }
rest = { value = 0.5, unit = "rad" }
damping = { value = 8.0, unit = "N m s/rad" }

[bodies.crank]"""


@pytest.fixture(scope="module")
def four_bar(tmp_path_factory):
    text = FOUR_BAR.replace("[bodies.crank]", NUMBERS, 1) + SPRING
    return model(tmp_path_factory.mktemp("spring"), text)


@pytest.fixture(scope="module")
def measured(four_bar):
    t = np.linspace(0.02, 2.0, 100)
    return {"t": t, "crank.theta": four_bar.simulate(until=2.0, times=t, **FINE)["crank.theta"]}


@pytest.mark.slow
def test_five_parameters_from_an_angle(four_bar, measured):
    fit = four_bar.identify(measured, free=tuple(TRUE), parameters=WRONG, **FINE)
    assert fit.parameters == pytest.approx(TRUE, rel=1e-9)
    assert fit.runs < 60  # differences take six runs for each derivative of five
    assert not fit.null
    assert not fit.notes
    assert fit.units["k"] == "N m/rad"
    assert fit.deviations["crank.theta"] < 1e-10


@pytest.mark.slow
def test_what_can_be_multiplied_together_is_named_before_a_fit(four_bar, measured):
    said = "k, damping, m1, m2 and m3 can be multiplied by one number; leave one of them"
    with pytest.raises(InputError, match=said):
        four_bar.identify(measured, free=("k", "rest", "damping", "m1", "m2", "m3"), parameters=WRONG, **FINE)


@pytest.mark.by_turns(2)
@pytest.mark.slow
def test_intervals_cover_the_truth(four_bar, measured):
    rng, inside, count = np.random.default_rng(0), 0, 24
    for _ in range(count):
        noise = 1e-3 * np.std(measured["crank.theta"]) * rng.standard_normal(100)
        data = measured | {"crank.theta": measured["crank.theta"] + noise}
        fit = four_bar.identify(data, free=tuple(TRUE), method="lagrange", integrator="dop853")
        inside += sum(low <= TRUE[name] <= high for name, (low, high) in fit.intervals.items())
        errors = np.array([*fit.errors.values()])
        assert np.all(np.abs(np.diag(fit.correlations) - 1.0) < 1e-9)
        assert np.all((0.0 < errors) & (errors < 0.2 * np.array([*TRUE.values()])))
    # 114 of 120 are expected; of so many fixed draws, fewer than 104 would be one case in a hundred thousand
    assert 104 <= inside <= 120


@pytest.mark.slow
def test_data_that_determine_nothing_are_named(four_bar, measured):
    noise = 2e-2 * np.std(measured["crank.theta"]) * np.random.default_rng(3).standard_normal(100)
    data = measured | {"crank.theta": measured["crank.theta"] + noise}
    fit = four_bar.identify(data, free=tuple(TRUE), method="lagrange", integrator="dop853")
    assert any("the data do not determine" in note for note in fit.notes)


@pytest.fixture(scope="module")
def rod(tmp_path_factory):
    return model(tmp_path_factory.mktemp("rod"), ROD)


@pytest.mark.slow
def test_starts_and_the_bias_of_a_sensor_are_unknowns(rod):
    t = np.linspace(0.1, 3.0, 60)
    true = rod.simulate(times=t, until=3.0, parameters={"length": 1.2}, start={"rod.omega": 0.8}, **FINE)
    data = {"t": t, "rod.theta": true["rod.theta"] + 0.03, "rod.omega": true["rod.omega"]}
    fit = rod.identify(
        data,
        free=("length", "rod.omega"),
        bias=["rod.theta"],
        start={"rod.omega": 0.5},
        weights={"rod.omega": 2.0},
        **FINE,
    )
    assert fit.parameters == pytest.approx({"length": 1.2, "rod.omega": 0.8, "bias of rod.theta": 0.03}, rel=1e-8)
    assert fit.result.start["v"]["rod.omega"] == pytest.approx(0.8)


@pytest.mark.slow
def test_several_runs_have_one_set_of_parameters(rod):
    runs = [np.linspace(0.1, end, 20) for end in (1.0, 1.7)]
    data = [
        {"t": t, "rod.theta": rod.simulate(times=t, until=t[-1], parameters={"g": 9.0}, **FINE)["rod.theta"]}
        for t in runs
    ]
    assert rod.identify(data, free="g", **FINE).parameters["g"] == pytest.approx(9.0, rel=1e-9)


def test_a_bound_that_is_met_leaves_one_side(rod):
    t = np.linspace(0.1, 2.0, 30)
    data = {"t": t, "rod.theta": rod.simulate(times=t, until=2.0, parameters={"length": 1.2}, **FINE)["rod.theta"]}
    fit = rod.identify(data, free={"length": (0.5, 1.1)}, **FINE)
    assert fit.parameters["length"] == pytest.approx(1.1)
    low, high = fit.intervals["length"]
    assert np.isnan(low)
    assert high == fit.parameters["length"]
    assert any("meets its bound" in note for note in fit.notes)


def test_powers_of_what_cannot_be_told_apart():
    # a b^2 alone is measured
    a, b = 2.0, 3.0
    slopes = np.outer(np.arange(1.0, 6.0), [b**2, 2.0 * a * b])
    (said,) = null_directions(slopes, np.array([a, b]), ("a", "b"))
    assert said == "a by z and b by z^(-1/2) can be multiplied together, for any number z"
    assert null_directions(np.zeros((4, 1)), np.ones(1), ("c",)) == ("c changes nothing that was measured",)


@pytest.mark.slow
def test_the_command(rod, tmp_path, capsys, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "rod.toml").write_text(ROD, encoding="utf-8")
    rod.simulate(times=np.linspace(0.1, 2.0, 30), until=2.0, parameters={"length": 1.2}, **FINE).save(
        "run.csv", ["rod.theta"]
    )
    words = ["identify", "rod.toml", "--data", "run.csv", "--free", "length"]
    assert main([*words, "--json"]) == 0
    assert json.loads(capsys.readouterr().out)["parameters"]["length"] == pytest.approx(1.2, rel=1e-6)
    assert main([*words, "--least", "length=0.5"]) == 0
    assert "rod.theta" in capsys.readouterr().out
    assert main([*words, "--least", "g=0.5"]) == 2
    assert main(["identify", "rod.toml", "--free", "length"]) == 2


@pytest.mark.parametrize(
    ("data", "free", "said"),
    [
        ({"t": [0.1, 0.2], "rod.theta": [1.0, np.inf]}, "length", "finite numbers, got others in rod.theta"),
        ({"t": [0.1, 0.2], "rod.theta": [1.0]}, "length", "2 numbers of rod.theta"),
        ({"t": [0.2, 0.1], "rod.theta": [1.0, 1.0]}, "length", "increasing times"),
        ({"t": [-1.0, 0.1], "rod.theta": [1.0, 1.0]}, "length", "times from the start of the run"),
        ({"t": [0.1], "rod.theta": [1.0]}, ("length", "g"), "at least as many numbers as unknowns, got 1 for 2"),
        ({"t": [0.1, 0.2], "rod.thete": [1.0, 1.0]}, "length", "a column of rod-on-a-pin"),
        ({"rod.theta": [1.0, 1.0]}, "length", "a column 't' of times"),
        ({"t": [0.1, 0.2], "rod.theta": [1.0, 1.0]}, "lenght", "did you mean 'length'"),
        (
            {"t": [0.1, 0.2], "rod.theta": [1.0, 1.0]},
            {"length": (2.0, 3.0)},
            "bounds that hold the start, 1, got 2 and 3",
        ),
        ({"t": [0.1, 0.2], "rod.theta": [1.0, 1.0]}, (), "numbers to be found"),
        (3, "length", "files, or mappings"),
    ],
)
def test_wrong_arguments(rod, data, free, said):
    with pytest.raises(InputError, match=said):
        rod.identify(data, free=free, integrator="dop853")


BOUNCE = """
[mechanism]
name = "ball"
gravity = [0.0, -9.81]
[parameters]
height = 1.02
bounce = 0.75
[bodies.ball]
mass = 1.0
inertia = 0.1
position = [0.0, "height"]
[stops.floor]
gap = "ball.y"
restitution = "bounce"
"""


@pytest.mark.by_turns(2)
@pytest.mark.slow
def test_restitution_of_a_ball_from_noisy_heights(tmp_path):
    ball, t, true = model(tmp_path, BOUNCE), np.linspace(0.0, 2.0, 101), {"bounce": 0.7, "height": 1.0}
    clean = np.array(ball.simulate(until=2.0, times=t, parameters=true, rtol=1e-10, atol=1e-10)["ball.y"])
    rng, covered, runs = np.random.default_rng(5), 0, 0
    for _ in range(12):
        fit = ball.identify({"t": t, "ball.y": clean + 0.01 * rng.standard_normal(len(t))}, free=tuple(true))
        assert fit.result.ok
        covered += sum(low <= true[name] <= high for name, (low, high) in fit.intervals.items())
        runs = max(runs, fit.runs)
    assert covered >= 20  # of 24 at 95 %
    assert runs <= 20

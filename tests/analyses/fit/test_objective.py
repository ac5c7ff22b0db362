"""Quantities at the end of runs as functions of numbers, with exact gradients."""

import numpy as np
import pytest
from run.directions.differences import differences
from run.directions.lengths import BY_NAME, FOUR_BAR, G_BY, ROD, ROD_BY, ROD_STATE, SLIDER_CRANK, STATE, G, model
from scipy.optimize import minimize

from symgen import InputError
from symgen.base.errors import AnalysisError

TIGHT = {"rtol": 1e-13, "atol": 1e-13, "integrator": "dop853"}
CONSTANT = {"integrator": "rk4", "step": 1e-2, "until": 0.4}


@pytest.fixture(scope="module")
def rod(tmp_path_factory):
    return model(tmp_path_factory.mktemp("rod"), ROD)


@pytest.fixture(scope="module")
def four_bar(tmp_path_factory):
    return model(tmp_path_factory.mktemp("lengths"), FOUR_BAR)


def test_the_rod_on_a_pin(rod):
    angle = rod.gradient("rod.omega", by=tuple(ROD_BY), until=3.0, **TIGHT)
    assert angle.value == pytest.approx(ROD_STATE[1], rel=1e-11)
    assert angle.by == pytest.approx({name: by[1] for name, by in ROD_BY.items()}, rel=1e-11)
    assert (angle.unit, angle.units["length"], angle.units["angle"]) == ("rad/s", "(rad/s)/m", "(rad/s)/rad")
    assert angle.result.ok
    # twice the kinetic energy of the rod about its pin, whose length stands in the formula as well
    energy = rod.gradient("length**2/3*rod.omega**2", by=tuple(ROD_BY), until=3.0, **TIGHT)
    expected = {name: 2.0 / 3.0 * ROD_STATE[1] * by[1] for name, by in ROD_BY.items()}
    expected["length"] += 2.0 / 3.0 * ROD_STATE[1] ** 2
    assert energy.value == pytest.approx(ROD_STATE[1] ** 2 / 3.0, rel=1e-11)
    assert energy.by == pytest.approx(expected, rel=1e-11)


@pytest.mark.slow
def test_lengths_masses_and_gravity_of_the_four_bar(four_bar):
    angle = four_bar.objective("crank.theta", by=tuple(BY_NAME), until=2.0, **TIGHT)
    value, slopes = angle(angle.x0)
    assert value == pytest.approx(STATE[0], abs=1e-11)
    assert slopes == pytest.approx([by[0] for by in BY_NAME.values()], rel=1e-11)
    assert angle.x0.tolist() == [four_bar.parameters()[name] for name in angle.names]


@pytest.mark.slow
@pytest.mark.slow_cases("rocker.C.x*coupler.omega")
@pytest.mark.parametrize("quantity", ["rocker.C.x*coupler.omega", "integral(a*crank.omega**2 + rocker.C.vy**2)"])
def test_formulas_and_integrals_against_differences(four_bar, tmp_path, quantity):
    reported = model(tmp_path, FOUR_BAR + f'\n[outputs]\nJ = "{quantity}"\n')
    by, start = ("a", "c", "m2", "crank.omega"), {"crank.omega": 0.4}
    gradient = four_bar.gradient(quantity, by=by, start=start, method="lagrange", **CONSTANT)
    named = reported.gradient("J", by=by, start=start, method="lagrange", **CONSTANT)
    assert named.value == pytest.approx(gradient.value, rel=1e-12)
    for name in by:
        value = {"crank.omega": 0.4, **reported.parameters()}[name]
        settings = {**CONSTANT, "method": "lagrange"} | ({"start": start} if name != "crank.omega" else {})
        expected = differences(reported, name, value, 5e-4 * value, "J", **settings)
        assert gradient.by[name] == pytest.approx(expected, rel=1e-8)
        assert named.by[name] == pytest.approx(gradient.by[name], rel=1e-11)


@pytest.mark.slow
def test_the_integral_of_idas(tmp_path):
    energy = model(tmp_path, SLIDER_CRANK).gradient("G", by=("k", "c"), rtol=1e-12, atol=1e-12)
    assert energy.value == pytest.approx(G, rel=1e-11)
    assert energy.by == pytest.approx(G_BY, rel=1e-11)
    assert energy.unit == "J s"


def test_more_directions_than_loops_take_are_further_runs(tmp_path):
    # x = sum k f_k t^2 / (2 m)
    names = [f"f{k}" for k in range(1, 71)]
    text = '[mechanism]\nname = "pushed"\n[parameters]\n' + "".join(f"{name} = 0.1\n" for name in names)
    text += '[bodies.p]\ntype = "point"\nmass = 2.0\nvelocity = [0.0, 0.0]\n[forces.f]\ntype = "force"\nbody = "p"\n'
    text += f'force = ["{" + ".join(f"{k + 1}*{name}" for k, name in enumerate(names))}", 0.0]\n'
    for way in ("forward", "adjoint"):
        place = model(tmp_path, text).gradient("p.x", by=names, until=2.0, integrator="rk4", step=0.1, way=way)
        assert place.way == way
        assert place.value == pytest.approx(0.1 * 70 * 71 / 2, rel=1e-11)
        assert [place.by[name] for name in names] == pytest.approx(np.arange(1.0, 71.0), rel=1e-11)


def test_a_search_finds_a_length_again(rod):
    miss = rod.objective(
        f"(rod.theta + pi/2 - ({ROD_STATE[0]}))**2",
        by={"length": (0.9, None)},
        **TIGHT,
        until=3.0,
        parameters={"length": 1.1},
    )
    assert miss.x0 == pytest.approx([1.1])
    best = minimize(miss, miss.x0, jac=True, bounds=miss.bounds, options={"ftol": 1e-20, "gtol": 1e-12})
    assert best.x == pytest.approx([1.0], rel=1e-6)
    assert miss.runs <= 1 + best.nfev
    again = rod.simulate(miss.settings_at(best.x))
    assert again["rod.theta"][-1] + np.pi / 2 == pytest.approx(ROD_STATE[0], abs=1e-5)


@pytest.mark.slow
def test_a_value_at_which_nothing_closes_is_infinite(four_bar):
    height = four_bar.objective("rocker.C.y", by=("a",), **CONSTANT)
    value, slopes = height([100.0])
    assert value == np.inf
    assert slopes.tolist() == [0.0]
    value, slopes = height(height.x0)
    assert np.isfinite(value)
    assert slopes[0] != 0.0


@pytest.mark.slow_cases("crank.theta-changes10-a run that ends at a time, got an event")
@pytest.mark.parametrize(
    ("quantity", "changes", "said"),
    [
        ("crank.thet", {}, "a quantity with sensitivities, got 'crank.thet'"),
        ("crank.theta +", {}, "objective"),
        (3, {}, "a text"),
        ("crank.theta", {"by": ("lenght",)}, "got 'lenght'"),
        ("crank.theta", {"by": ()}, "numbers to be found, got none"),
        ("crank.theta", {"by": {"a": (3.0, 4.0)}}, "by 'a': expected bounds that hold the start, 2, got 3 and 4"),
        ("crank.theta", {"by": {"a": (4.0, 3.0)}}, "a lower bound below the upper one"),
        (
            "crank.theta",
            {"by": {"a": 3.0}},
            "by 'a': expected a lower and an upper bound, each a number or None, got 3",
        ),
        ("crank.theta", {"by": {"a": (1.0, 2.0, 3.0)}}, "a lower and an upper bound"),
        ("crank.theta", {"by": {"a": ("1", None)}}, "a lower and an upper bound"),
        ("crank.theta", {"stop_when": "crank.theta < 0.8", "until": 2.0}, "a run that ends at a time, got an event"),
        ("crank.theta", {"times": [0.1]}, "a setting of runs"),
        ("crank.theta", {"integrator": "radau5", "method": "ggl"}, "an explicit scheme"),
    ],
)
def test_what_has_no_objective_is_refused(four_bar, quantity, changes, said):
    with pytest.raises(InputError, match=said):
        four_bar.objective(quantity, **({"by": ("a",), "until": 0.1} | changes))


def test_a_run_that_fails_and_arrays_of_other_lengths_are_refused(four_bar):
    with pytest.raises(AnalysisError, match="the run does not reach its end"):
        four_bar.gradient("crank.theta", by=("a",), max_violation=1e-18, until=1.0)
    angle = four_bar.objective("crank.theta", by="a", **CONSTANT)
    for x, said in (
        ([1.0, 2.0], "x: expected one number each for a, got 2 numbers"),
        ("abc", "a list of finite numbers"),
    ):
        with pytest.raises(InputError, match=said):
            angle(x)

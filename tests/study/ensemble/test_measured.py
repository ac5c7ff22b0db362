"""Points, elements, formulas and reactions of the runs of sweeps: those of single runs, and closed forms."""

import copy

import numpy as np
import pytest
from support.emitted import mechanism_of

import symgen
from study.ensemble.single_runs import assert_rows
from symgen.base.errors import InputError
from symgen.describe.catalogue import raw

TIMES = {"until": 0.1, "step": 2e-3, "times": (0.0, 0.051, 0.1), "integrator": "rk4", "method": "lagrange"}


def sprung():
    """A pendulum with a spring from its bob, whose stiffness is a parameter, and formulas of both."""
    description = copy.deepcopy(raw("pendulum"))
    description["parameters"] |= {"stiffness": 3.0, "anchor": 0.2}
    description["bodies"]["bob"]["position"] = [-0.6, -0.8]
    description["forces"] = {
        "spring": {
            "type": "spring-damper",
            "between": ["ground", "bob"],
            "at": [["anchor", 0.3], "centre"],
            "stiffness": "stiffness",
            "free_length": 0.5,
        }
    }
    description["outputs"] = {
        "reach": {"value": "bob.x**2 + stiffness", "unit": "m"},
        "spent": {"value": "integral(bob.vx**2)", "unit": "J"},
    }
    return symgen.load(mechanism_of(description))


def test_reactions_of_every_run_are_those_of_its_single_run():
    model, names = (
        symgen.load("four-bar"),
        ("reactions", "body_reactions", "magnitudes", "joint_coordinates", "crank.theta"),
    )
    found = symgen.sweep(model, {"crank_mass": [1.0, 3.0]}, quantities=names, **TIMES)
    kept = [q.name for q in found.ensemble.recipe.quantities]
    assert kept[-1] == "crank.theta" and {"A.Fx", "B.body.Fy", "C.F"} < set(kept)
    assert_rows(found, model, **TIMES)


def test_elements_formulas_and_integrals_of_every_run_are_those_of_its_single_run():
    model = sprung()
    found = symgen.sweep(model, {"stiffness": [1.0, 5.0]}, quantities=("spring", "bob", "outputs"), **TIMES)
    assert {"spring.length", "spring.force", "spring.power", "reach", "spent"} < {*found.to_json()["quantities"]}
    assert_rows(found, model, **TIMES)
    one = model.simulate(**TIMES).select([q.name for q in found.ensemble.recipe.quantities])
    assert [q.unit for q in found.ensemble.recipe.quantities] == list(one.units)


def test_a_rod_and_a_spring_pull_as_newton_says():
    """Along the rod: its force is m v^2/L, and what gravity and the spring have along it."""
    names = ("bob", "spring.force", "spring.length", "link.F")
    stiffness, anchor = np.array([1.0, 5.0, 20.0]), np.array([0.1, 0.2, 0.5])
    found = symgen.sweep(sprung(), runs={"stiffness": stiffness, "anchor": anchor}, quantities=names, **TIMES)
    x, y, vx, vy = (found[f"bob.{name}"] for name in ("x", "y", "vx", "vy"))
    dx, dy = anchor[:, np.newaxis] - x, 0.3 - y
    length = np.hypot(dx, dy)
    force = stiffness[:, np.newaxis] * (length - 0.5)
    np.testing.assert_allclose(found["spring.length"], length, rtol=1e-13)
    np.testing.assert_allclose(np.abs(found["spring.force"]), np.abs(force), rtol=1e-12)
    radius = np.hypot(x, y)
    pull = ((force * dx / length) * x + (force * dy / length - 9.81) * y + vx**2 + vy**2) / radius
    # the law holds at |q| = 1, from which the run has drifted by some 1e-9 at most
    np.testing.assert_allclose(found["link.F"], np.abs(pull), rtol=1e-7)


def test_a_rail_whose_rows_are_constant_carries_weights():
    """Nothing of D varies: the rail is pressed down by m g, whatever else happens along it."""
    rail = {"type": "translational", "between": ["ground", "b"], "at": [[0.0, 0.0], "centre"], "axis": [1.0, 0.0]}
    description = {"mechanism": {"name": "rail", "gravity": [0.0, -9.81]}, "parameters": {"m": 1.0}}
    description |= {"bodies": {"b": {"mass": "m", "inertia": 0.1, "velocity": [1.0, 0.0]}}, "joints": {"rail": rail}}
    found = symgen.sweep(mechanism_of(description), {"m": [1.0, 2.5]}, quantities=("reactions", "b.x"), **TIMES)
    np.testing.assert_allclose(found["rail.Fy"], np.outer([-9.81, -24.525], np.ones(3)), rtol=1e-12)
    np.testing.assert_allclose(found["rail.Fx"], 0.0, atol=1e-12)
    np.testing.assert_allclose(found["b.x"], [TIMES["times"]] * 2, rtol=0, atol=1e-12)


def test_integrals_are_for_processors():
    with pytest.raises(InputError, match=r"target 'lanes'.*integral.*'spent'"):
        symgen.sweep(sprung(), {"stiffness": [1.0]}, quantities=("spent",), target="lanes", **TIMES)


@pytest.mark.parametrize(("name", "hint"), [("link.Fz", "link.F"), ("rech", "reach")])
def test_a_name_that_no_run_has_is_one_sentence(name, hint):
    with pytest.raises(InputError, match=rf"quantity '{name}'.*{hint}") as caught:
        symgen.sweep(sprung(), {"stiffness": [1.0]}, quantities=(name,), **TIMES)
    assert "\n" not in str(caught.value)


def test_what_is_not_asked_for_is_not_there():
    found = symgen.sweep("four-bar", {"crank_mass": [1.0]}, quantities=("q", "lam"), until=0.01)
    recipe = found.ensemble.recipe
    assert recipe.measures is None and recipe.columns == recipe.quantities and recipe.behind == ()

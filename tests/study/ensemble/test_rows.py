"""Runs of an ensemble against single runs, and starts against geometry."""

import copy
import os
import subprocess
import sys

import numpy as np
import pytest
from support.checks import assert_same_motion
from support.emitted import mechanism_of

import symgen
from study.ensemble.single_runs import assert_row, assert_rows
from symgen.base.errors import AssemblyError, InputError
from symgen.describe.catalogue import n_four_bar, raw
from symgen.describe.mechanism import Mechanism

EVERYTHING = (
    "q",
    "v",
    "crank.ax",
    "coupler.alpha",
    "joint_coordinates",
    "lam",
    "energy",
    "violations",
    "smallest_pivot",
)


def test_every_quantity_of_every_run_is_that_of_a_single_run():
    model, settings = symgen.load("four-bar"), {"until": 0.3, "step": 2e-3, "times": (0.0, 0.101, 0.2, 0.3)}
    found = symgen.sweep(
        model, {"crank_mass": "lin(1, 3, 2)", "rocker_mass": [4.0, 6.0]}, quantities=EVERYTHING, **settings
    )
    assert found.counts["ok"] == 4
    assert_rows(found, model, **settings)


def test_adaptive_runs_with_dense_output():
    model = symgen.load("four-bar")
    settings = {"integrator": "dop853", "rtol": 1e-9, "atol": 1e-11, "until": 1.0, "output_step": 0.13}
    found = symgen.sweep(model, {"coupler_mass": "log(1, 16, 3)"}, quantities=("q", "energy"), **settings)
    assert np.all(found["rejected"] >= 0) and len(set(found["steps"])) > 1
    assert_rows(found, model, **settings)


def test_a_run_whose_accelerations_are_no_numbers_leaves_the_next_ones_alone():
    """One after the other in the same memory: where the force is no number at the start, that run alone fails."""
    model = symgen.load(
        mechanism_of(
            {
                "mechanism": {"name": "rooted"},
                "parameters": {"k": 0.0},
                "bodies": {"b": {"mass": 1.0, "inertia": 1.0, "points": {"P": [-1.0, 0.0]}, "position": [1.0, 0.0]}},
                "joints": {"pin": {"type": "revolute", "between": ["ground", "b"], "at": [[0.0, 0.0], "P"]}},
                "forces": {"pull": {"type": "force", "body": "b", "at": "centre", "force": [0.0, "sqrt(b.x - k)"]}},
            }
        )
    )
    k = [2.0, 0.5, 3.0, 0.25] * 10
    settings = {"method": "lagrange", "integrator": "rk4", "step": 1e-2, "until": 0.05, "times": (0.0, 0.05)}
    found = symgen.sweep(model, {"k": k}, quantities=("q", "b.ay", "joint_coordinates"), jobs=1, **settings)
    assert found.ensemble.chunk > 1 and list(found.status) == ["failed", "ok"] * 20
    for i in (1, 3):
        assert_row(found, i, model.simulate(parameters={"k": k[i]}, **settings))
    assert np.isnan(found["b.ay"][0]).all()


def test_without_output_times_only_the_end_is_kept():
    found = symgen.sweep("pendulum", {"bob_mass": [1.0, 2.0]}, until=0.5, integrator="dopri5")
    assert found.values.shape == (2, 4, 1)
    np.testing.assert_allclose(found["bob.x"][0], found["bob.x"][1], atol=1e-8)  # a pendulum does not feel its mass


@pytest.mark.slow_cases("coordinate-partitioning")
@pytest.mark.parametrize(
    "method", ["coordinate-partitioning", "baumgarte", "augmented-hamiltonian", "augmented-lagrangian"]
)
def test_methods_that_remember_or_iterate(method):
    """Iterations end at a tolerance, which starts in other places would meet one sooner or later."""
    model, settings = symgen.load("slider-crank"), {"method": method, "until": 0.1, "output_step": 0.05}
    found = symgen.sweep(model, {"rod_mass": [0.5, 1.5]}, quantities=("q", "v", "lam"), **settings)
    assert_rows(found, model, **settings)


def open_four_bar():
    description = copy.deepcopy(raw("four-bar"))
    description["parameters"]["lift"] = 0.0
    description["bodies"]["coupler"]["position"] = [4.6, "3.2 + lift"]
    description["bodies"]["crank"]["angular_velocity"] = 1.0
    description["bodies"]["rocker"]["angular_velocity"] = "3*lift"
    for body in ("crank", "coupler", "rocker"):
        description["bodies"][body].pop("velocity", None)
    description["bodies"]["coupler"].pop("angular_velocity", None)
    return symgen.load(mechanism_of(description))


@pytest.mark.slow
def test_open_and_contradictory_starts_are_closed_and_projected_as_for_single_runs():
    model, settings = open_four_bar(), {"until": 0.02, "times": (0.0, 0.02)}
    found = symgen.sweep(model, {"lift": [-0.2, 0.0, 0.4, 1.0]}, quantities=("q", "v", "lam"), **settings)
    assert np.all(found["start_moved"] > 1e-3) and np.all(found["start_velocities"] == 1.0)
    assert_rows(found, model, **settings)
    strict = symgen.sweep(model, {"lift": [0.0]}, until=0.02, strict=True)
    assert strict.status[0] == "failed"
    assert "initial state: expected a consistent start (`strict`), got positions that closing moves" in strict.reason[0]


@pytest.mark.slow
def test_a_start_that_stays_open_is_a_failed_row_in_the_words_of_a_single_run():
    description = copy.deepcopy(raw("four-bar"))
    description["parameters"]["reach"] = 10.0
    description["joints"]["D"]["at"] = [["reach", 0.0], description["joints"]["D"]["at"][1]]
    if description["joints"]["D"]["between"][0] != "ground":
        description["joints"]["D"]["at"].reverse()
    model = symgen.load(mechanism_of(description))
    found = symgen.sweep(model, {"reach": [10.0, 16.0, 10.5]}, until=0.01)
    assert list(found.status) == ["ok", "failed", "ok"]
    with pytest.raises(AssemblyError) as caught:
        model.simulate(until=0.01, parameters={"reach": 16.0})
    assert found.reason[1] == str(caught.value)
    assert np.isnan(found["crank.x"][1]).all() and np.isfinite(found["crank.x"][[0, 2]]).all()


def test_parameters_that_make_no_mechanism_are_failed_rows():
    model = symgen.load("four-bar")
    found = symgen.sweep(model, {"crank_mass": [2.0, -1.0, 0.0]}, until=0.01)
    assert list(found.status) == ["ok", "failed", "failed"]
    for i, mass in ((1, -1.0), (2, 0.0)):
        with pytest.raises(InputError) as caught:
            model.simulate(until=0.01, parameters={"crank_mass": mass})
        assert found.reason[i] == str(caught.value)
    assert found.reasons() and sum(count for _, count in found.reasons()) == 2


@pytest.mark.slow
def test_light_bodies_get_the_other_solver_where_they_are_light():
    """Where loops are not closed by determinants: a partition of coordinates inverts M."""
    model, settings = symgen.load("four-bar"), {"until": 0.05, "times": (0.05,), "method": "coordinate-partitioning"}
    found = symgen.sweep(model, {"coupler_mass": [8.0, 1e-9, 4.0]}, quantities=("q", "v"), **settings)
    assert list(found["light"]) == [0.0, 1.0, 0.0]
    assert_rows(found, model, **settings)


@pytest.mark.slow
@pytest.mark.parametrize("method", ["direct-correction", "lagrange"])
def test_singular_passages_are_judged_as_single_runs_are(method):
    description = n_four_bar.KIND.build(1)
    description["parameters"] = {"end_mass": 1.0}
    description["bodies"]["vertical1"]["mass"] = "end_mass"
    model = symgen.load(mechanism_of(description))
    settings = {"until": 2.0, "integrator": "rk4", "step": 2e-3, "method": method, "times": (1.0, 2.0)}
    found = symgen.sweep(model, {"end_mass": [1.0, 1.5]}, quantities=("energy",), **settings)
    assert np.all(found["rank_event_count"] > 0)
    assert set(found.status) == {"ok"} if method == "direct-correction" else "ok" not in found.status
    assert_rows(found, model, **settings)


@pytest.mark.slow
def test_redundant_rows_in_space():
    """Bricard's six-bar with its first rod turning: rank 29 of 30 rows, and multipliers that are not unique."""
    names, turns = ("rod1.wx", "rod1.wy", "rod1.wz"), (0.0, 0.4, -1.0)
    runs = {name: [turn if name == "rod1.wy" else 0.0 for turn in turns] for name in names}
    settings = {"until": 0.05, "times": (0.02, 0.05)}
    found = symgen.sweep("bricard", runs=runs, quantities=("q", "v", "energy", "lam"), **settings)
    assert np.all(found["redundant_rows"] == 1.0)
    for i, turn in enumerate(turns):
        description = copy.deepcopy(raw("bricard"))
        description["bodies"]["rod1"]["angular_velocity"] = [0.0, turn, 0.0]
        one = symgen.load(mechanism_of(description)).simulate(**settings)
        assert found.status[i] == one.status == "ok"
        for name in (*one.q.names, *one.v.names):
            assert_same_motion(found[name][i], one[name], name)
        assert np.isnan(found["multiplier.P1." + one.lam.names[6].partition(".")[2]][i]).all()


# -- initial coordinates and velocities --------------------------------------------------------------------------------


@pytest.mark.slow
def test_a_coordinate_that_varies_is_held_and_the_branch_is_kept():
    """The four-bar all round, against its closure by circles: crank 2 m, coupler 8 m, rocker 5 m, ground 10 m."""
    angles = np.linspace(-3.0, 3.2, 9)
    found = symgen.sweep("four-bar", {"crank.theta": angles}, times=(0.0,), until=0.01)
    assert [axis.dimension for axis in found.ensemble.grid.axes] == ["crank.theta(0)"]
    np.testing.assert_array_equal(found["crank.theta"][:, 0], angles)
    for i, angle in enumerate(angles):
        b, d = 2.0 * np.array([np.cos(angle), np.sin(angle)]), np.array([10.0, 0.0])
        distance = np.linalg.norm(d - b)
        along = (8.0**2 - 5.0**2 + distance**2) / (2 * distance)
        across = np.sqrt(8.0**2 - along**2)
        e = (d - b) / distance
        c = b + along * e + across * np.array([-e[1], e[0]])  # above, as the mechanism is described
        assert np.hypot(found["rocker.x"][i, 0] - (c + d)[0] / 2, found["rocker.y"][i, 0] - (c + d)[1] / 2) < 1e-12
        assert np.hypot(found["coupler.x"][i, 0] - (b + c)[0] / 2, found["coupler.y"][i, 0] - (b + c)[1] / 2) < 1e-12


def test_an_impossible_coordinate_is_a_failed_row():
    found = symgen.sweep("slider-crank", {"slider.x": [0.5, 0.7]}, until=0.01)
    assert list(found.status) == ["ok", "failed"]  # crank and rod reach 0.6 m
    assert "stays open by" in found.reason[1]


def test_an_initial_velocity_leads_the_others():
    """The slider of an in-line slider-crank: x' of r cos(phi) + sqrt(l^2 - r^2 sin(phi)^2)."""
    found = symgen.sweep(
        "slider-crank", {"crank.omega": [-5.0, 20.0], "crank.theta": [0.3, 2.0]}, times=(0.0,), until=0.01
    )
    assert found["slider.vx"].shape == (2, 2, 1)
    for i, omega in enumerate((-5.0, 20.0)):
        for j, phi in enumerate((0.3, 2.0)):
            root = np.sqrt(0.45**2 - (0.15 * np.sin(phi)) ** 2)
            slope = -0.15 * np.sin(phi) - 0.15**2 * np.sin(phi) * np.cos(phi) / root
            assert found["slider.x"][i, j, 0] == pytest.approx(0.15 * np.cos(phi) + root, abs=1e-12)
            assert found["slider.vx"][i, j, 0] == pytest.approx(slope * omega, abs=1e-11)


@pytest.mark.slow
def test_a_coordinate_in_space():
    """The first point of a body in space that varies, the turn that goes with it, and what may not vary."""
    found = symgen.sweep("bricard", {"rod1.z": [0.0, 0.02]}, times=(0.0,), until=1e-3)
    assert list(found.status) == ["ok", "ok"]
    np.testing.assert_array_equal(found["rod1.z"][:, 0], [0.0, 0.02])
    # rod1 turns about the ground's y axis through its end: its middle stays 0.5 m away from it
    np.testing.assert_allclose(np.hypot(found["rod1.x"], found["rod1.z"])[:, 0], 0.5, atol=1e-12)
    with pytest.raises(InputError, match=r"vary 'rod1.e0': .* an Euler parameter; write the orientation with"):
        symgen.sweep("bricard", {"rod1.e0": [0.0]})


def geared():
    """A wheel driven from an angle on, geared to a second one: b = 31 - 2 a."""
    frame, axis = [[1.0, 0.0, 0.0], [1.0, 0.0, 0.0]], [[0.0, 0.0, 1.0], [0.0, 0.0, 1.0]]

    def wheel(x):
        return {"mass": 1.0, "inertia": [0.2, 0.2, 0.3], "position": [x, 0.0, 0.0]}

    def held(body, x):
        between = ["ground", body]
        at = [[x, 0.0, 0.0], "centre"]
        return {"type": "revolute", "between": between, "at": at, "axis": axis, "reference": frame}

    return symgen.load(
        mechanism_of(
            {
                "mechanism": {"name": "geared", "space": "spatial"},
                "parameters": {"first": 7.0},
                "bodies": {"a": wheel(0.0), "b": wheel(1.0)},
                "joints": {
                    "mesh": {"type": "gear", "joints": ["A", "B"], "radii": [2.0, 1.0], "offset": 31.0},
                    "A": held("a", 0.0),
                    "B": held("b", 1.0),
                    "motor": {"type": "driver", "joint": "A", "value": "first + 3*t"},
                },
            }
        )
    )


@pytest.mark.slow
def test_starts_whole_turns_away_and_turns_between_outputs():
    """Angles in space whose turns are counted: drivers whose values vary by whole turns."""
    first = np.array([7.0, -40.0, 0.2, 3.3])
    times = (0.0, 2.5, 5.0)
    settings = {"step": 0.02, "until": 5.0, "times": times}
    model = geared()
    found = symgen.sweep(model, {"first": first}, quantities=("joint_coordinates", "q", "a.alphaz", "lam"), **settings)
    assert found.counts["ok"] == 4
    expected = first[:, None] + 3.0 * np.array(times)
    np.testing.assert_allclose(found["A.angle"], expected, atol=1e-9)
    np.testing.assert_allclose(found["B.angle"], 31.0 - 2.0 * expected, atol=1e-9)
    np.testing.assert_allclose(found["B.angle.rate"], -6.0, atol=1e-9)
    assert_rows(found, model, **settings)


# -- what is refused ---------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("settings", "said"),
    [
        ({"vary": {"crank_mas": [1.0]}}, r"vary 'crank_mas': .* did you mean 'crank_mass'\?"),
        ({"integrator": "radau5"}, r"integrator 'radau5': expected one with a loop over many runs, .*rk4.* have one"),
        ({"integrator": "abm4"}, "one with a loop over many runs"),
        ({"quantities": ["crank.tetha"]}, r"quantity 'crank.tetha': .* did you mean 'crank.theta'\?"),
        ({"verify": True}, "verify: expected single runs, got an ensemble"),
        ({"repeat": 3}, "repeat: expected single runs"),
        ({"untill": 1.0}, r"did you mean 'until'\?"),
    ],
)
def test_what_does_not_fit_is_refused_in_one_sentence(settings, said):
    with pytest.raises(InputError, match=said):
        symgen.sweep("four-bar", **{"vary": {"crank_mass": [1.0]}, "until": 0.01, **settings})


def test_what_varies_is_not_given_otherwise_by_another_name():
    """The angle of the joint at the ground is that of the crank, whatever either is called."""
    settings = {"method": "lagrange", "until": 0.01}
    for one, other in (("crank.theta", "A.angle"), ("A.angle", "crank.theta"), ("crank.omega", "A.angle.rate")):
        with pytest.raises(InputError, match=rf"vary '{one}': expected one way of giving it a value, got two"):
            symgen.sweep("four-bar", {one: [0.9, 1.0]}, start={other: 0.3}, **settings)


def test_an_automatic_choice_is_made_once_and_noted():
    found = symgen.sweep("four-bar", {"crank_mass": [1.0, 2.0]}, method="auto", integrator="auto", until=0.1)
    assert found.ensemble.plan.integrator.name == "picard" and found.counts["ok"] == 2
    assert any("integrator picard" in note for note in found.ensemble.notes)


def test_code_for_large_mechanisms_is_refused():
    with pytest.raises(InputError, match="shape: expected straight code for an ensemble, got looped"):
        symgen.sweep("four-bar", {"crank_mass": [1.0]}, shape="looped")
    with pytest.raises(InputError, match="sweep: expected a mechanism of at most 600 coordinates, got 603"):
        symgen.sweep("n-four-bar:100", {"vertical0.omega": [1.0]})


@pytest.mark.slow
def test_without_compilation_the_numbers_are_the_same(tmp_path):
    """NUMBA_DISABLE_JIT=1 is how a run is debugged."""
    script = (
        "import sys, numpy, symgen\n"
        "vary = {'crank_mass': [1.0, 2.0], 'crank.theta': [1.0, 1.2]}\n"
        "found = symgen.sweep('four-bar', vary, until=0.005, quantities=('q', 'lam', 'joint_coordinates'), jobs=1)\n"
        "assert found.counts['ok'] == 4\n"
        "numpy.save(sys.argv[1], found.values)\n"
    )
    values = []
    for disabled in ("0", "1"):
        path = tmp_path / f"{disabled}.npy"
        environment = os.environ | {"NUMBA_DISABLE_JIT": disabled}
        subprocess.run([sys.executable, "-c", script, str(path)], check=True, timeout=600, env=environment)
        values.append(np.load(path))
    np.testing.assert_allclose(values[0], values[1], rtol=0, atol=1e-11)


def pushed(formula: str) -> Mechanism:
    text = raw("four-bar")
    text["inputs"] = {"push": 0.0}
    text["forces"] = {"pushing": {"type": "force", "body": "crank", "force": [formula, 0.0]}}
    text["outputs"] = {"pulse": {"value": "push*t + crank.ax", "unit": "1"}}
    return mechanism_of(text)


@pytest.mark.by_turns(6)
@pytest.mark.slow
@pytest.mark.parametrize(
    "steps", [{"step": 2e-3}, {"integrator": "dopri5", "rtol": 1e-9}], ids=["constant", "adaptive"]
)
@pytest.mark.parametrize(
    "push", ["5 if t < 0.0503 else -20", "9*crank_mass if t < 0.02*crank_mass else 7 if t < 0.1 else crank_mass"]
)
def test_rows_whose_inputs_jump_stay_in_the_loop_and_are_single_runs(push, steps):
    model, settings = symgen.load(pushed("push")), {"until": 0.2, "times": (0.0, 0.02, 0.05, 0.1, 0.101, 0.2)}
    settings |= {"inputs": {"push": push}, **steps}
    kept = (*EVERYTHING, "pulse", "reactions")
    found = symgen.sweep(model, {"crank_mass": [1.0, 2.0, 3.0]}, quantities=kept, **settings)
    assert found.ensemble.recipe.seams
    assert_rows(found, model, **settings)
    jumped = symgen.sweep(
        model, {"crank_mass": [1.0]}, quantities=("crank.ax",), **settings | {"inputs": {"push": 5.0}}
    )
    assert abs(jumped["crank.ax"][0, -1] - found["crank.ax"][0, -1]) > 1e-3


@pytest.mark.slow_cases("straight")
@pytest.mark.parametrize("shape", ["straight", "looped"])
def test_a_jump_to_where_a_formula_is_undefined_ends_a_run_with_its_reason(shape):
    model, push = symgen.load(pushed("sqrt(push)")), "1 if t < 0.05 else -1"
    settings = {"until": 0.1, "step": 1e-2, "inputs": {"push": push}}
    one = model.simulate(shape=shape, **settings)
    assert one.status == "failed" and one.end == pytest.approx(0.05)
    assert one.reason == "inputs: expected values for which every formula is finite, got others at t = 0.05 s"
    if shape == "straight":
        found = symgen.sweep(model, {"crank_mass": [1.0, 2.0]}, **settings)
        assert found.reason.tolist() == [one.reason] * 2


@pytest.mark.by_turns(3)
@pytest.mark.slow_cases("record_when-constant", "record_when-adaptive", "stop_when-constant")
@pytest.mark.parametrize(
    "steps", [{"step": 2e-3}, {"integrator": "dopri5", "rtol": 1e-9}], ids=["constant", "adaptive"]
)
@pytest.mark.parametrize("action", ["record_when", "stop_when"])
def test_rows_with_events_and_inputs_that_jump_stay_in_the_loop_and_are_single_runs(action, steps):
    """An event before the jump in one row and behind it in the others."""
    model, settings = symgen.load(pushed("push")), {"until": 0.3, action: "crank.theta < 1.03", **steps}
    settings["inputs"] = {"push": "40*crank_mass if t < 0.11 else -60"}
    masses = [1.0, 3.0, 6.0]
    found = symgen.sweep(model, {"crank_mass": masses}, quantities=("crank.theta", "pulse", "A.Fx"), **settings)
    watch = found.ensemble.recipe.watch
    assert watch is not None and found.ensemble.recipe.seams
    times = []
    for r, mass in enumerate(masses):
        one = model.simulate(**settings, parameters={"crank_mass": mass})
        assert found["crank.theta"].ravel()[r] == pytest.approx(one["crank.theta"][-1], abs=1e-12)
        for quantity in ("pulse", "A.Fx"):  # with the time and the inputs at the end of this run
            assert_same_motion(found[quantity].ravel()[r], one[quantity][-1], quantity)
        name = "event.crank.theta < 1.03"
        assert found[f"{name}.count"][r] == len(one.events)
        times += [event.t for event in one.events[:1]]
        assert found[f"{name}.first"][r] == pytest.approx(times[-1], abs=1e-12)
    assert min(times) < 0.11 < max(times)

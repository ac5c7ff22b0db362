"""References are checked against each other and against published values."""

import json
from pathlib import Path

import numpy as np
import pytest

import symgen
from symgen.base.errors import InputError
from symgen.describe import MechanismBuilder
from symgen.describe.facts.lengths import own_length
from symgen.describe.mechanism import with_largest_step
from symgen.result.points import Points
from symgen.study.references.closed_forms import CLOSED
from symgen.study.references.independent import IndependentEquations
from symgen.study.references.motion import CompiledEquations, motion_with_estimate
from symgen.study.references.reference import reference_motion
from symgen.study.references.solvers import SOLVERS
from tests.derive.methods.test_hard_cases import two_links

DATA = Path(__file__).parents[1] / "data"


def start_of(model, parameters=None):
    compiled = model.compile()
    start = model.assemble(compiled, parameters)
    nq = compiled.info.nq
    return start.y[:nq], start.y[nq:-1]


def both(name, times, parameters=None):
    """The registered reference, and the general route."""
    model = symgen.load(name)
    values = model.parameters(parameters)
    arguments = model.mechanism, values, *start_of(model, parameters), times
    return (
        reference_motion(*arguments),
        reference_motion(*arguments, solver="scipy-dop853"),
        Points.of_mechanism(model.mechanism, values),
    )


@pytest.mark.by_turns(3)
@pytest.mark.slow_cases(
    "n-four-bar:3-0.6-None", "pendulum-5.0-None", "driven-four-bar-1.5-None", "n-four-bar:1-0.6-None"
)
@pytest.mark.parametrize(
    ("name", "until", "parameters"),
    [
        ("pendulum", 5.0, None),
        ("driven-four-bar", 1.5, None),
        ("driven-four-bar", 1.0, {"crank_start": 2.0, "crank_speed": -3.0}),
        # up to its first singular position, behind which only the equation of the regular branch leads on
        ("n-four-bar:1", 0.6, None),
        ("n-four-bar:3", 0.6, None),
    ],
)
def test_formulas_agree_with_the_general_route(name, until, parameters):
    closed, general, points = both(name, np.linspace(0.0, until, 31), parameters)
    assert closed.how != general.how
    distance = points.largest_distance(closed.q, general.q)
    assert distance < 1e-11
    assert points.speed_distances((closed.q, closed.v), (general.q, general.v)).max() < 1e-10
    assert all(np.allclose(closed.lam[row], general.lam[row], rtol=1e-8, atol=1e-8) for row in general.lam)
    assert distance < 10.0 * (closed.estimated_error + general.estimated_error)


def test_the_pendulum_is_periodic_for_ever():
    from scipy.special import ellipk

    period = 4.0 * ellipk(0.5) / np.sqrt(9.81)
    _, _, q, v = CLOSED["pendulum"](None, {}, np.array([-1.0, 0.0]), np.array([0.0, period / 2, 1000 * period]))
    assert np.allclose(q, [[-1.0, 0.0], [1.0, 0.0], [-1.0, 0.0]], atol=1e-11)
    assert np.allclose(v, 0.0, atol=1e-10)


@pytest.mark.slow
def test_andrews_meets_the_published_values():
    """Angles of K1, K3, K5, K7 are beta, gamma, delta, epsilon; the test set's are good to about ten digits."""
    published = json.loads((DATA / "andrews_ivp.json").read_text())
    end = dict(zip(published["coordinates"], published["end"], strict=False))
    model = symgen.load("andrews")
    found = reference_motion(
        model.mechanism, model.parameters(), *start_of(model), np.array([0.0, 0.03]), solver="scipy-dop853"
    )
    theta = {b.name: found.q[-1, 3 * i + 2] for i, b in enumerate(model.mechanism.bodies)}
    assert theta["K1"] == pytest.approx(end["beta"], rel=1e-9)
    assert theta["K2"] - theta["K1"] == pytest.approx(end["theta"], rel=1e-9)
    assert theta["K3"] == pytest.approx(end["gamma"], rel=1e-9)
    assert theta["K5"] == pytest.approx(end["delta"], rel=1e-9)
    assert theta["K7"] == pytest.approx(end["epsilon"], rel=1e-9)


def test_another_mechanism_of_the_same_name_gets_the_general_route(tmp_path):
    path = tmp_path / "pendulum.toml"
    path.write_text(
        '[mechanism]\nname = "pendulum"\ngravity = [0.0, -1.0]\n'
        '[bodies.bob]\ntype = "point"\nmass = 1.0\nposition = [2.0, 0.0]\nvelocity = [0.0, 0.0]\n'
        '[joints.link]\ntype = "distance"\nbetween = ["ground", "bob"]\nat = [[0.0, 0.0], "centre"]\nlength = 2.0\n'
    )
    model = symgen.load(path)
    found = reference_motion(model.mechanism, {}, *start_of(model), np.linspace(0.0, 1.0, 5))
    assert "independently derived" in found.how
    energy = found.q[:, 1] * 1.0
    assert energy[-1] < -0.4


@pytest.mark.by_turns(2)
@pytest.mark.slow
@pytest.mark.parametrize("windows", [1, pytest.param(2, marks=pytest.mark.slow)])
def test_singular_positions_are_passed_by_runs_whose_steps_fall_differently(windows):
    """Ten passages in 10 s, against the equation of the regular branch, which knows no singular position."""
    closed, general, points = both(f"n-four-bar:{windows}", np.linspace(0.0, 10.0, 41))
    assert "through singular positions" in general.how and general.note == ""
    # estimates are no bounds: a second run differs from the motion by as much as the first
    assert points.largest_distance(closed.q, general.q) < 2.0 * (closed.estimated_error + general.estimated_error)
    assert general.estimated_error < 1e-6


@pytest.mark.slow
def test_runs_that_part_at_a_singular_position_are_not_passed_silently(monkeypatch):
    """Steps so long that a passage is a matter of chance: no two runs agree, and the reference says from when on."""
    from symgen.study.references import reference as module

    real = module.pass_through
    monkeypatch.setattr(module, "pass_through", lambda e, y, t, step: real(e, y, t, 0.7))
    monkeypatch.setattr(module, "PHASES", (1.0, 0.85))
    model = symgen.load("n-four-bar:3")
    times = np.linspace(0.0, 10.0, 11)
    found = reference_motion(model.mechanism, {}, *start_of(model), times, solver="scipy-dop853")
    exact = reference_motion(model.mechanism, {}, *start_of(model), times)
    points = Points.of_mechanism(model.mechanism, {})
    assert "part by more than 0.0001 of the mechanism's size" in found.note and "not known which branch" in found.note
    parted = float(found.note.split("t = ")[1].split(" s")[0])
    assert 0.0 < parted <= 10.0
    assert found.estimated_error > 1e-6
    assert points.largest_distance(found.q, exact.q) > 1e-6  # and it was right not to be believed


@pytest.mark.slow
def test_a_regular_mechanism_with_short_links_is_not_taken_for_a_singular_one():
    """Links of centimetres make the singular values of D small everywhere."""
    model = symgen.load("andrews")
    found = reference_motion(
        model.mechanism, model.parameters(), *start_of(model), np.linspace(0.0, 0.01, 6), solver="scipy-dop853"
    )
    assert "singular" not in found.how


def test_redundant_rows_do_no_harm():
    """Two rows more than needed change nothing: the same crank pinned twice."""
    joint = {"type": "revolute", "between": ["ground", "rod"], "at": [[0.0, 0.0], [-0.5, 0.0]]}
    from symgen.describe.files.validate import validate

    raw = {
        "mechanism": {"name": "rod", "gravity": [0.0, -9.81]},
        "bodies": {"rod": {"mass": 1.0, "inertia": 0.1, "position": [0.5, 0.0]}},
        "joints": {"a": joint},
    }
    one = IndependentEquations(validate(raw, "test"), {})
    two = IndependentEquations(validate({**raw, "joints": {"a": joint, "b": joint}}, "test"), {})
    y = np.array([0.5, 0.0, 0.0, 0.0, 0.5, 1.0])
    assert np.allclose(one.rate(0.0, y), two.rate(0.0, y), atol=1e-12)
    assert one.rate(0.0, y)[5] == pytest.approx(-0.5 * 9.81 / (0.1 + 0.25))


@pytest.mark.by_turns(4)
@pytest.mark.slow
@pytest.mark.parametrize("solver", SOLVERS)
@pytest.mark.parametrize(
    ("name", "until"),
    [
        ("four-bar", 1.0),
        *(pytest.param(*x, marks=pytest.mark.slow) for x in (("driven-four-bar", 0.5), ("pendulum", 1.0))),
    ],
)
def test_scipy_s_solvers_agree_within_what_they_say(name, until, solver):
    model = symgen.load(name)
    values, times = model.parameters(), np.linspace(0.0, until, 11)
    arguments = model.mechanism, values, *start_of(model), times
    usual, found = reference_motion(*arguments), reference_motion(*arguments, solver=solver)
    distance = Points.of_mechanism(model.mechanism, values).largest_distance(usual.q, found.q)
    assert f"SciPy {SOLVERS[solver][0]} at" in found.how
    assert distance <= 10.0 * (usual.estimated_error + found.estimated_error) <= 1e-4
    at_start = reference_motion(*arguments[:-1], np.zeros(1), solver=solver)
    assert np.allclose(at_start.q, arguments[2], atol=1e-12)


def test_an_unknown_solver_is_refused():
    model = symgen.load("pendulum")
    with pytest.raises(InputError, match=r"reference_by: got 'scipy-rado'; did you mean 'scipy-radau'.*scipy-dop853"):
        reference_motion(model.mechanism, {}, *start_of(model), np.linspace(0.0, 1.0, 3), solver="scipy-rado")


def test_own_lengths():
    bodies = {
        b.name: own_length(b, symgen.load("slider-crank").parameters())
        for b in symgen.load("slider-crank").mechanism.bodies
    }
    assert bodies["crank"] == pytest.approx(0.075)
    assert bodies["slider"] == pytest.approx(np.sqrt(5e-4 / 0.6))
    assert own_length(symgen.load("pendulum").mechanism.body("bob"), {"bob_mass": 1.0}) == 0.0


def test_distances_count_the_far_end():
    model = symgen.load("four-bar")
    points = Points.of_mechanism(model.mechanism, model.parameters())
    a = np.zeros((1, 9))
    b = a.copy()
    b[0, 5] = 1e-3
    assert points.largest_distance(a, b) == pytest.approx(4e-3, rel=1e-6)
    assert points.largest_distance(a, a) == 0.0
    b[0, 5] = 2.0 * np.pi
    assert points.largest_distance(a, b) < 1e-14


@pytest.mark.slow
def test_a_massless_coupler_has_references_and_they_are_those_of_a_distance_joint():
    """Both routes to a reference: SciPy's of comparisons, and the compiled one of stress studies."""
    times, found, rates = np.linspace(0.0, 1.0, 5), [], []
    for massless in (True, False):
        model = two_links(massless)
        start = start_of(model)
        found.append(reference_motion(model.mechanism, {}, *start, times).q[:, :6])
        y = np.concatenate(start)
        by_scipy, compiled = (kind(model.mechanism, {}) for kind in (IndependentEquations, CompiledEquations))
        rates.append(by_scipy.rate(0.0, y))
        np.testing.assert_allclose(compiled.rate(0.0, y), rates[-1], rtol=0.0, atol=1e-11)
    assert np.abs(found[0] - found[1]).max() < 1e-10


@pytest.mark.slow
def test_a_bob_on_a_massless_rod_in_space_has_the_reference_of_one_at_a_distance():
    found, times = [], np.linspace(0.0, 1.0, 5)
    for rod in (True, False):
        raw = MechanismBuilder("bob", space="spatial", gravity=(0.0, 0.0, -9.81))
        raw.body("bob", mass=2.0, inertia=(0.1, 0.1, 0.1), position=(1.0, 0.0, 0.0), velocity=(0.0, 0.5, 0.0))
        if rod:
            raw.body("rod", mass=0.0, inertia=(0.0, 0.0, 0.0), position=(0.5, 0.0, 0.0))
            raw.joint(
                "foot",
                "universal",
                between=("ground", "rod"),
                at=((0, 0, 0), (-0.5, 0, 0)),
                axes=((0, 0, 1), (0, 1, 0)),
            )
            raw.joint("head", "spherical", between=("rod", "bob"), at=((0.5, 0, 0), (0, 0, 0)))
        else:
            raw.joint("link", "distance", between=("ground", "bob"), at=((0, 0, 0), (0, 0, 0)), length=1.0)
        model = symgen.Model(raw.build())
        found.append(reference_motion(model.mechanism, {}, *start_of(model), times).q[:, :3])
    assert np.abs(found[0] - found[1]).max() < 1e-10 and np.abs(found[0][-1, 1]) > 0.1


def pushed(tmp_path, force):
    """A point on a spring of 4 N/m, 0.3 m off, under a force."""
    path = tmp_path / "pushed.toml"
    path.write_text(
        '[mechanism]\nname = "pushed"\n[bodies.a]\ntype = "point"\nmass = 1.0\nposition = [0.3, 0.0]\n'
        f'[forces.push]\ntype = "force"\nbody = "a"\nforce = ["-4*a.x + ({force})", 0.0]\n'
    )
    model = symgen.load(path)
    return model.mechanism, {}, *start_of(model)


def swung(times, passages):
    """Its places in closed form: `passages` are times at which the force becomes another, and those forces."""
    found, x, v, t = np.zeros(len(times)), 0.3, 0.0, 0.0
    for begin, force, end in zip((0.0, *passages), (0.0, *passages.values()), (*passages, np.inf), strict=True):
        s, c = np.sin(2.0 * (begin - t)), np.cos(2.0 * (begin - t))
        force_before = 0.0 if t == 0.0 else passages[t]
        rest = force_before / 4.0
        x, v = rest + (x - rest) * c + v / 2.0 * s, -2.0 * (x - rest) * s + v * c
        t, rest = begin, force / 4.0
        own = (times >= begin) & (times <= end)
        found[own] = rest + (x - rest) * np.cos(2.0 * (times[own] - t)) + v / 2.0 * np.sin(2.0 * (times[own] - t))
    return found


@pytest.mark.by_turns(3)
@pytest.mark.fast("scipy-lsoda")
@pytest.mark.parametrize("solver", SOLVERS)
def test_references_see_a_push_that_is_shorter_than_a_step(solver, tmp_path):
    """100 N for 3 ms: solvers do not see it, or take its ends for positions at which accelerations are unknown."""
    times, (begin, end) = np.linspace(0.0, 2.0, 201), (0.7011, 0.7041)
    found = reference_motion(*pushed(tmp_path, f"100 if {begin} < t < {end} else 0"), times, solver=solver)
    off = np.abs(found.q[:, 0] - swung(times, {begin: 100.0, end: 0.0})).max()
    assert "singular" not in found.how
    assert off < 10.0 * found.estimated_error + 1e-10 and found.estimated_error < 1e-7


@pytest.mark.slow
def test_references_of_stress_studies_see_a_short_push_as_well(tmp_path):
    mechanism, values, q, v = pushed(tmp_path, "100 if 0.7011 < t < 0.7041 else 0")
    times = np.linspace(0.0, 2.0, 11)
    found = motion_with_estimate(CompiledEquations(mechanism, values), q, v, times)
    off = np.abs(found.q[:, 0] - swung(times, {0.7011: 100.0, 0.7041: 0.0})).max()
    assert off < 10.0 * found.estimated_error + 1e-10 and found.estimated_error < 1e-6


@pytest.mark.by_turns(4)
@pytest.mark.slow
@pytest.mark.parametrize(
    ("solver", "w", "max_step"),
    [*((solver, 1e-3, None) for solver in (*SOLVERS, "of stress studies")), ("scipy-dop853", 3e-4, 6e-4)],
)
def test_references_see_a_smooth_pulse(solver, w, max_step, tmp_path):
    """A bell of 0.3 sqrt(pi) N s, behind which a spring swings on: no output is near."""
    times, at = np.linspace(0.0, 2.0, 11), 0.7321
    mechanism, values, q, v = pushed(tmp_path, f"{0.3 / w}*exp(-((t - {at})/{w})**2)")
    mechanism = with_largest_step(mechanism, max_step)
    if solver in SOLVERS:
        found = reference_motion(mechanism, values, q, v, times, solver=solver)
    else:
        found = motion_with_estimate(CompiledEquations(mechanism, values), q, v, times)
    blow = 0.3 * np.sqrt(np.pi) * np.exp(-(w**2)) / 2.0  # of a bell, its transform at 2 rad/s
    expected = 0.3 * np.cos(2.0 * times) + np.where(times > at, blow * np.sin(2.0 * (times - at)), 0.0)
    off = np.abs(found.q[:, 0] - expected).max()
    assert off < 10.0 * found.estimated_error + 1e-11 and found.estimated_error < 1e-7


@pytest.mark.by_turns(6)
@pytest.mark.slow
@pytest.mark.parametrize(
    "solver",
    ["scipy-dop853", "scipy-radau", pytest.param("scipy-bdf", marks=pytest.mark.slow)],
)
def test_references_see_a_force_between_two_places(solver, tmp_path):
    """A point that flies by at 1 m/s is pushed for 0.8 mm, with 0.4 s between two outputs."""
    mechanism, values, q, v = pushed(tmp_path, "4*a.x + 6.6 if abs(a.x - 1.0) < 4e-4 else 4*a.x")
    times, edge, faster = np.linspace(0.0, 2.0, 6), 0.7 - 4e-4, np.sqrt(1.0 + 2.0 * 6.6 * 8e-4)
    behind = edge + (faster - 1.0) / 6.6
    expected = np.where(times < edge, 0.3 + times, 1.0 + 4e-4 + faster * (times - behind))
    found = reference_motion(mechanism, values, q, v + np.array([1.0, 0.0]), times, solver=solver)
    off = np.abs(found.q[:, 0] - expected).max()
    assert off < 10.0 * found.estimated_error + 1e-10 and found.estimated_error < 1e-7


@pytest.mark.slow
def test_runs_through_singular_positions_differ_between_close_outputs(monkeypatch):
    """Steps longer than from one output to the next would end at the outputs alone, and all runs be the same."""
    from symgen.study.references import reference as module

    steps, by_steps = list[float](), module.integrate_by_steps

    def counted(equations, y, times, scheme, **more):
        steps.extend([scheme.step] if scheme.step else [])
        return by_steps(equations, y, times, scheme, **more)

    monkeypatch.setattr(module, "integrate_by_steps", counted)
    model = symgen.load("n-four-bar:1")
    times = np.linspace(0.0, 0.5, 51)
    found = reference_motion(model.mechanism, {}, *start_of(model), times, solver="scipy-dop853")
    if not steps:
        equations = IndependentEquations(model.mechanism, {})
        module.pass_through(equations, equations.state(*start_of(model)), times, 0.05)
    assert len(steps) >= 2 and max(steps) <= 0.01 * (1.0 + 1e-12) and len(set(steps)) == len(steps)
    assert found.estimated_error < 1e-6

"""Pulses and steps of the time that are smooth: steps that are bounded see them, and each acts as its integral says."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import msgspec
import numpy as np
import pytest
from support.checks import assert_same_motion
from support.pushed import pushed_point

import symgen
from symgen.describe.catalogue import MACHINES, entries
from symgen.describe.catalogue import names as names_of_catalogue
from symgen.describe.facts.short_changes import longest_step
from symgen.study.ensemble.parameter_sweep import sweep

SCHEMES = ["dop853", "dopri5", "picard", "abm", "sdirk", "radau5"]
END = 10.0
#: A force of impulse 1 N s or a step of 1 N about the time `at`, as wide as `w`; each acts on a point of its own.
FORCES = {
    "bell": "exp(-((t - at)/w)**2)/(w*sqrt(pi))",
    "quotient": "1/(1 + ((t - at)/w)**2)/(pi*w)",
    "hill": "(1 - tanh((t - at)/w)**2)/(2*w)",
    "step": "tanh((t - at)/w)",
    "ramp": "1/2 + atan((t - at)/w)/pi",
    "train": "5/w*cos(5*(t - at))*(1 - tanh(sin(5*(t - at))/w)**2)",
}


def speeds(at: float, w: float, end: float = END) -> dict[str, float]:
    """What a point of 1 kg has of each at the end, in closed form."""
    first, last = -at / w, (end - at) / w

    def integral(x: float) -> dict[str, float]:
        return {
            "bell": 0.5 * math.erf(x),
            "quotient": math.atan(x) / math.pi,
            "hill": 0.5 * math.tanh(x),
            "step": w * float(np.logaddexp(x, -x)),
            "ramp": 0.5 * w * x + w / math.pi * (x * math.atan(x) - 0.5 * math.log1p(x * x)),
            "train": math.tanh(math.sin(5.0 * w * x) / w),
        }

    before, behind = integral(first), integral(last)
    return {name: behind[name] - before[name] for name in FORCES}


@pytest.fixture(scope="module")
def pushed(tmp_path_factory: pytest.TempPathFactory) -> symgen.Model:
    text = f'[mechanism]\nname = "smooth"\ngravity = [0.0, 0.0]\n[run]\nuntil = {END}\n'
    text += "[parameters]\nat = 3.337\nw = 1e-4\n"
    for name, force in FORCES.items():
        text += f'[bodies.{name}]\ntype = "point"\nmass = 1.0\nposition = [0.0, 0.0]\nvelocity = [0.0, 0.0]\n'
        text += f'[forces.on_{name}]\ntype = "force"\nbody = "{name}"\nforce = ["{force}", 0.0]\n'
    file = tmp_path_factory.mktemp("smooth") / "smooth.toml"
    file.write_text(text, encoding="utf-8")
    return symgen.load(file)


def bounds(result: symgen.Result | symgen.SteppedRun) -> list[str]:
    """The notes of a run on a bound that nobody set."""
    return [note for note in result.notes if "may have short features" in note]


@pytest.mark.parametrize("integrator", SCHEMES)
def test_a_pulse_is_seen_by_default_and_with_a_largest_step(tmp_path: Path, integrator: str) -> None:
    """The run's length over a thousand is twice its width."""
    model, exact = pushed_point(tmp_path, "exp(-((t - 1.3)/1e-3)**2)", 2.0), 1e-3 * math.sqrt(math.pi)
    found = model.simulate(method="lagrange", integrator=integrator)
    (note,) = bounds(found)
    assert "formulas of t in forces" in note and "at most 0.002 s" in note and "needs a smaller `max_step`" in note
    asked = model.simulate(method="lagrange", integrator=integrator, max_step=2e-3)
    for result in (found, asked):
        assert result.status == "ok" and result["a.vx"][-1] - 0.1 == pytest.approx(exact, abs=1e-8)
    assert not bounds(asked) and found.steps < 1200


@pytest.mark.by_turns(4)
@pytest.mark.fast(
    "bell-radau5",
    "quotient-picard",
    "hill-abm",
    "hill-sdirk",
    "step-dop853",
    "step-dopri5",
    "ramp-dopri5",
    "train-dopri5",
)
@pytest.mark.parametrize("integrator", SCHEMES)
@pytest.mark.parametrize("name", FORCES)
def test_runs_miss_none(tmp_path: Path, name: str, integrator: str) -> None:
    """Each alone, as steps that are short for one of them would see the others; short ones need the setting."""
    random = np.random.default_rng(len(name))
    for w, max_step in ((1e-4, 2e-4), (3e-3, None)):
        at = float(random.uniform(0.5, 9.5))
        force = FORCES[name].replace("t - at", "t - f").replace("w", repr(w))
        result = pushed_point(tmp_path, force).simulate(
            method="lagrange", integrator=integrator, rtol=1e-8, parameters={"f": at}, times=[END], max_step=max_step
        )
        assert result.status == "ok"
        assert result["a.vx"][-1] - 0.1 == pytest.approx(speeds(at, w)[name], abs=1e-6), (w, at)


@pytest.mark.slow_cases("radau5")
@pytest.mark.parametrize("integrator", ["dop853", "picard", "abm", "radau5"])
def test_runs_step_by_step_miss_none(pushed: symgen.Model, integrator: str) -> None:
    run = pushed.start(method="lagrange", integrator=integrator, rtol=1e-8, until=0.7, max_step=2e-4)
    for end in (2.0, 3.337, END):
        run.run(end)
    for name, speed in speeds(3.337, 1e-4).items():
        assert run.bodies[f"{name}.vx"] == pytest.approx(speed, abs=2e-6), name


def test_steps_from_python_are_bounded_by_default(tmp_path: Path) -> None:
    run = pushed_point(tmp_path, "exp(-((t - 1.3)/1e-3)**2)", 2.0).start(method="lagrange", integrator="dop853")
    assert bounds(run)
    run.run(2.0)
    assert run.bodies["a.vx"] - 0.1 == pytest.approx(1e-3 * math.sqrt(math.pi), abs=1e-8)


def test_rows_of_sweeps_are_single_runs(pushed: symgen.Model) -> None:
    settings: dict[str, Any] = {"method": "lagrange", "integrator": "dop853", "rtol": 1e-8, "parameters": {"w": 3e-3}}
    bounded: list[dict[str, Any]] = [{}, {"max_step": 2e-3}]
    for bound in bounded:
        found = sweep(pushed, vary={"at": [2.0, 7.0]}, quantities=["bell.vx", "step.vx"], **settings, **bound)
        assert bool(found.ensemble.notes) is not bool(bound)
        for row, at in zip(found.values[:, :, -1], (2.0, 7.0), strict=True):
            single = pushed.simulate(**{**settings, "parameters": {"w": 3e-3, "at": at}}, **bound)
            assert_same_motion(row, [single["bell.vx"][-1], single["step.vx"][-1]])
            exact = speeds(at, 3e-3)
            assert row.tolist() == pytest.approx([exact["bell"], exact["step"]], abs=1e-6)


def test_thousands_of_pulses_are_seen(tmp_path: Path) -> None:
    """At 50 Hz for 12 s, each some 0.1 ms wide: integrals of a bell of a sine are Bessel functions."""
    from scipy.special import ive

    result = pushed_point(tmp_path, "10*exp(-(sin(2*pi*f*t)/0.03)**2)", 12.0).simulate(
        method="lagrange", integrator="dop853", rtol=1e-8, max_step=2e-4
    )
    assert (result.status, result.warnings) == ("ok", ())
    assert result["a.vx"][-1] - 0.1 == pytest.approx(120.0 * float(ive(0, 0.5 / 0.03**2)), rel=1e-6)


@pytest.mark.slow
def test_what_is_compared_may_be_a_pulse(tmp_path: Path) -> None:
    """A condition that holds for 20 us of 10 s, in a force, an input and as an event: looks are as close as steps."""
    half = 1e-4 * math.sqrt(-math.log(0.99))
    asked = "exp(-((t - 3.337)/1e-4)**2) > 0.99"
    settings: dict[str, Any] = {"method": "lagrange", "integrator": "dop853", "rtol": 1e-8, "max_step": 1e-4}
    model = pushed_point(tmp_path, f"1e4 if {asked} else 0")
    result = model.simulate(record_when=[asked], **settings)
    assert result["a.vx"][-1] - 0.1 == pytest.approx(2e4 * half, abs=1e-6)
    assert [event.t for event in result.events] == pytest.approx([3.337 - half], abs=1e-9)
    text = (tmp_path / "pushed.toml").read_text(encoding="utf-8").replace(f"1e4 if {asked} else 0", "u")
    (tmp_path / "given.toml").write_text(text + "[inputs]\nu = 0.0\n", encoding="utf-8")
    given = symgen.load(tmp_path / "given.toml").simulate(inputs={"u": f"1e4 if {asked} else 0"}, **settings)
    assert given["a.vx"][-1] - 0.1 == pytest.approx(2e4 * half, abs=1e-6)


@pytest.mark.parametrize(
    ("text", "bound"),
    [
        ("5*sin(30*t) + t**2", False),
        ("2*cos(30*t)*t + sin(30*t)", False),
        ("(1 - cos(2*t))**3", False),
        ("t**3*(10 - 15*t + 6*t**2)", False),
        ("exp(-f)*t/f", False),
        ("5 if sin(3*t) > 0.9 else abs(sin(t))", False),
        ("profile(2*t)*sin(t)", False),
        ("exp(-t*a.x)", False),
        ("sin(t) + sin(2*t)", True),
        ("sin(t)**17", True),
        ("sin(sin(t))", True),
        ("sin(t**2)", True),
        ("exp(-3*t)", True),
        ("1/(1 + t*t)", True),
        ("sqrt(2 + t)", True),
        ("t**f", True),
        ("a.x*tanh(t/3)", True),
        ("1 if exp(-t) > f else 0", True),
        ("max(0, profile(exp(-t)))", True),
    ],
)
def test_polynomials_and_one_sine_need_no_bound(tmp_path: Path, text: str, bound: bool) -> None:
    file = tmp_path / "pushed.toml"
    pushed_point(tmp_path, text.replace("profile", "abs"), 2.0)
    table = "[tables.profile]\nx = [0.0, 1.0, 4.0]\ny = [0.0, 1.0, 0.0]\n"
    file.write_text(file.read_text(encoding="utf-8").replace("abs(2*t)", "profile(2*t)") + table, encoding="utf-8")
    longest, note = longest_step(symgen.load(file).mechanism, 2.0)
    assert (longest, bool(note)) == ((2e-3, True) if bound else (math.inf, False))


def test_notes_name_the_formulas(tmp_path: Path) -> None:
    """Only where adaptive steps have a bound that nobody set."""
    model = pushed_point(tmp_path, "0.1", 2.0)
    asked: dict[str, Any] = {"method": "lagrange", "integrator": "dop853", "times": [2.0]}
    assert not bounds(model.simulate(**asked)) and not bounds(model.simulate(**asked, stop_when=["t > 1.5"]))
    assert "formulas of t in events may" in bounds(model.simulate(**asked, record_when=["exp(-t) > 0.5"]))[0]
    text = (tmp_path / "pushed.toml").read_text(encoding="utf-8").replace('"0.1"', '"u"')
    text += '[inputs]\nu = 0.0\n[outputs]\nwork = "integral(exp(-t)*a.vx)"\n'
    (tmp_path / "more.toml").write_text(text, encoding="utf-8")
    more = symgen.load(tmp_path / "more.toml")
    assert "formulas of t in integrals may" in bounds(more.simulate(**asked))[0]
    both = more.simulate(**asked, inputs={"u": "tanh(t)"})
    assert "formulas of t in forces and integrals may" in bounds(both)[0] and both.steps >= 1000
    compared = more.simulate(**asked, inputs={"u": "1 if exp(-t) > 0.5 else 0"})
    assert "in integrals and inputs may" in bounds(compared)[0]
    assert not bounds(more.simulate(method="lagrange", integrator="rk4", step=0.1))
    (tmp_path / "own.toml").write_text(text.replace("[run]", "[run]\nmax_step = 0.1"), encoding="utf-8")
    own = symgen.load(tmp_path / "own.toml").simulate(**asked)
    assert not bounds(own) and 20 <= own.steps < 60


@pytest.mark.slow
def test_one_mechanism_of_the_catalogue_needs_a_bound_and_has_its_own() -> None:
    """The legs of a platform are roots of sines of sines: its file has a largest step by the period of these."""
    every = [*names_of_catalogue(), *(entry.name for entry in entries(MACHINES))]
    models = {name: symgen.load(name).mechanism for name in every}
    found = [name for name, m in models.items() if longest_step(m, m.defaults.until, m.events)[1]]
    assert found == []
    platform = models["stewart-platform"]
    assert longest_step(platform, 2.0) == (0.05, "")
    free = msgspec.structs.replace(platform, defaults=msgspec.structs.replace(platform.defaults, max_step=None))
    assert "formulas of t in drivers may" in longest_step(free, 2.0)[1]

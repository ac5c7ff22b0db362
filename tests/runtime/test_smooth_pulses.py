"""Pulses and steps of the time that are smooth, and shorter than steps: each acts as its integral says."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import symgen
from symgen.catalogue import names as names_of_catalogue
from symgen.describe.parser import Names, parse
from symgen.describe.pulses import pulses_of, sharp_in
from symgen.ensemble.plan import make_ensemble
from symgen.ensemble.sweep import sweep
from symgen.runtime.pulses import Bounded, TooFast

SCHEMES = ["dop853", "dopri5", "abm", "sdirk", "radau5"]
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


def alone(folder: Path, force: str, until: float = END) -> symgen.Model:
    """A point of 1 kg under a force over the time."""
    text = f'[mechanism]\nname = "alone"\ngravity = [0.0, 0.0]\n[run]\nuntil = {until}\n[parameters]\nf = 50.0\n'
    text += '[bodies.a]\ntype = "point"\nmass = 1.0\nposition = [0.0, 0.0]\nvelocity = [0.1, 0.0]\n'
    text += f'[forces.push]\ntype = "force"\nbody = "a"\nforce = ["{force}", 0.0]\n'
    file = folder / "alone.toml"
    file.write_text(text, encoding="utf-8")
    return symgen.load(file)


@pytest.mark.parametrize("integrator", SCHEMES)
@pytest.mark.parametrize("name", FORCES)
def test_runs_miss_none(tmp_path: Path, name: str, integrator: str) -> None:
    """Each alone, as steps that are short for one of them would see the others."""
    random = np.random.default_rng(len(name))
    for w in (1e-5, 1e-4, 3e-3):
        at = float(random.uniform(0.5, 9.5))
        force = FORCES[name].replace("t - at", "t - f").replace("w", repr(w))
        result = alone(tmp_path, force).simulate(
            method="lagrange", integrator=integrator, rtol=1e-8, parameters={"f": at}
        )
        assert result.status == "ok"
        assert result["a.vx"][-1] - 0.1 == pytest.approx(speeds(at, w)[name], abs=1e-6), (w, at)


@pytest.mark.parametrize("integrator", ["dop853", "abm", "radau5"])
def test_runs_step_by_step_miss_none(pushed: symgen.Model, integrator: str) -> None:
    run = pushed.start(method="lagrange", integrator=integrator, rtol=1e-8, until=0.7)
    for end in (2.0, 3.337, END):
        run.run(end)
    for name, speed in speeds(3.337, 1e-4).items():
        assert run.bodies[f"{name}.vx"] == pytest.approx(speed, abs=2e-6), name


def test_a_parameter_that_is_set_moves_them(pushed: symgen.Model) -> None:
    run = pushed.start(method="lagrange", integrator="dopri5", rtol=1e-8)
    run.run(2.0)
    run.set(at=7.2)
    run.run(END)
    for name in ("bell", "hill"):
        assert run.bodies[f"{name}.vx"] == pytest.approx(1.0, abs=1e-6)


def test_rows_of_sweeps_are_single_runs(pushed: symgen.Model) -> None:
    settings: dict[str, Any] = {"method": "lagrange", "integrator": "dop853", "rtol": 1e-8}
    found = sweep(pushed, vary={"at": [2.0, 7.0]}, quantities=["bell.vx", "step.vx"], **settings)
    for row, at in zip(found.values[:, :, -1], (2.0, 7.0), strict=True):
        single, exact = pushed.simulate(parameters={"at": at}, **settings), speeds(at, 1e-4)
        assert row.tolist() == [single["bell.vx"][-1], single["step.vx"][-1]]
        assert row.tolist() == pytest.approx([exact["bell"], exact["step"]], abs=1e-6)


def test_thousands_of_pulses_are_seen(tmp_path: Path) -> None:
    """At 50 Hz for 12 s, each some 0.1 ms wide: integrals of a bell of a sine are Bessel functions."""
    from scipy.special import ive

    result = alone(tmp_path, "10*exp(-(sin(2*pi*f*t)/0.03)**2)", 12.0).simulate(
        method="lagrange", integrator="dop853", rtol=1e-8
    )
    assert (result.status, result.warnings) == ("ok", ())
    assert result["a.vx"][-1] - 0.1 == pytest.approx(120.0 * float(ive(0, 0.5 / 0.03**2)), rel=1e-6)


def test_what_is_compared_may_be_a_pulse(tmp_path: Path) -> None:
    """A condition that holds for 2e-6 s of 10, in a force and as an event."""
    half = 1e-5 * math.sqrt(-math.log(0.99))
    model = alone(tmp_path, "1e5 if exp(-((t - 3.337)/1e-5)**2) > 0.99 else 0")
    asked = "exp(-((t - 3.337)/1e-5)**2) > 0.99"
    result = model.simulate(method="lagrange", integrator="dop853", rtol=1e-8, record_when=[asked])
    assert result["a.vx"][-1] - 0.1 == pytest.approx(2e5 * half, abs=1e-6)
    assert [event.t for event in result.events] == pytest.approx([3.337 - half], abs=1e-9)


def test_constant_steps_say_what_they_may_miss(tmp_path: Path) -> None:
    model = alone(tmp_path, "100*exp(-((t - 0.7321)/1e-3)**2)", 1.0)
    exact = 0.1 * math.sqrt(math.pi)

    def told(step: float) -> tuple[list[str], float]:
        result = model.simulate(method="lagrange", integrator="rk4", step=step)
        return [x for x in result.warnings if "constant steps may miss" in x], abs(result["a.vx"][-1] - 0.1 - exact)

    (warning,), off = told(0.01)
    assert "from t = 0.73" in warning and off > 0.05
    nothing, off = told(4e-4)
    assert not nothing and off < 1e-6


def test_devices_take_no_adaptive_steps_there(pushed: symgen.Model) -> None:
    asked = symgen.Settings(method="lagrange", integrator="dopri5")
    with pytest.raises(symgen.InputError, match="no jumps, kinks and short pulses of formulas"):
        make_ensemble(pushed, asked, {"at": [2.0, 3.0]}, {}, None, "cuda")
    assert make_ensemble(pushed, asked, {"at": [2.0, 3.0]}, {}, None, "cpu").driving.jumps


def formula(text: str) -> Any:
    return parse(text, Names("a formula", {"t": "t"}, {}, {}), "here")


@pytest.mark.parametrize(
    "text",
    [
        "5*sin(30*t) + t**2",
        "exp(-3*t)*sin(100*t)",
        "(1 - cos(2*t))**3",
        "sqrt(2 + sin(t))",
        "t**3*(10 - 15*t + 6*t**2)",
    ],
)
def test_what_is_even_is_not_looked_at(text: str) -> None:
    assert not sharp_in(formula(text))


@pytest.mark.parametrize(
    "text", ["1/(2 + cos(20*t))", "exp(sin(3e4*t))", "tanh(t/3)*sin(20*t)", "exp(-((t - 5)/4)**2)", "tanh(1000 + t)"]
)
def test_what_changes_evenly_has_no_pulses(text: str) -> None:
    """Neither slow formulas have, nor one that is too fast to be followed, equally so everywhere."""
    assert [Bounded({}, {}).pulses(e, END) for e in sharp_in(formula(text))] == [[] for _ in sharp_in(formula(text))]


def test_mechanisms_of_the_catalogue_hide_nothing() -> None:
    assert all(not pulses_of(symgen.load(name).mechanism) for name in names_of_catalogue())


def test_pulses_that_cannot_be_told_apart_are_told(tmp_path: Path) -> None:
    text = "10*exp(-(sin(1e6*t)/0.01)**2)"
    with pytest.raises(TooFast):
        Bounded({}, {}).pulses(sharp_in(formula(text))[0], END)
    result = alone(tmp_path, text, 1.0).simulate(method="lagrange", integrator="rk4", step=0.01)
    assert any("more often than can be told apart" in warning for warning in result.warnings)


@pytest.mark.parametrize(
    ("text", "at", "width"),
    [
        ("exp(-((t - 0.7321)/1e-4)**2)", 0.7321, 1e-4),
        ("((t - 2)*(t - 2)*1e10 + 1)**-1", 2.0, 1e-5),
        ("cosh((t - 5)/0.02)**-2", 5.0, 0.02),
        ("exp(-(t - 4)*(t - 4)/1e-12)", 4.0, 1e-6),
        ("1/(1 + exp(-(t - 5)/0.02))", 5.0, 0.02),
    ],
)
def test_pulses_are_where_they_are(text: str, at: float, width: float) -> None:
    (*_, e) = sharp_in(formula(text))
    (pulse,) = Bounded({}, {}).pulses(e, END)
    assert at - 5.0 * width < pulse[0] < at < pulse[-1] < at + 5.0 * width
    assert max(np.diff(pulse)) < 2.0 * width and pulse == sorted(set(pulse))


def test_bounds_hold_what_lies_between() -> None:
    random = np.random.default_rng(3)
    formulas = (
        "sin(7*t)*cos(t - 2) - t**3",
        "exp(-(t/2)**2)/(1 + t*t)",
        "tanh(3*sin(5*t))**4 + abs(t - 1)",
        "1/(t - 3) + log(t)",
        "tan(t) if t > 2 else sqrt(4 - t)",
        "atan2(t - 1, 2 - t) + min(t, 1/2)*max(-t, cosh(t)**-2)",
        "(t - 1/3)**-3*(sign(t - 1) + t)",
    )
    for text in formulas:
        e, bounded = formula(text), Bounded({}, {})
        begin = random.uniform(-3.0, 5.0, 200)
        end = begin + 10.0 ** random.uniform(-4.0, 1.0, 200)
        low, high = bounded.over(e, begin, end)
        for a, b, least, largest in zip(begin, end, low, high, strict=True):
            values, _ = bounded.over(e, times := np.linspace(a, b, 101), times)
            known = values[np.isfinite(values)]
            if len(known):
                scale = 1e-12 * np.abs(known).max()
                assert least - scale <= known.min() and known.max() <= largest + scale, (text, a, b)
            assert not np.isnan(least) or not len(known)

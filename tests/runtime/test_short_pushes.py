"""Pushes shorter than a step, at times known beforehand: no error estimate sees them, and no run may miss them."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest

import symgen
from symgen.describe.parser import Names, parse
from symgen.ensemble.plan import make_ensemble
from symgen.ensemble.sweep import sweep
from symgen.runtime.foreseen import foreseen
from symgen.runtime.in_time import InTime

SCHEMES = ["dop853", "dopri5", "abm", "sdirk", "radau5"]
#: Two points without weight, each direction pushed once: force over t, impulse [N s], and the middle of the push [s].
AT, SHORT = 3.337, 1e-4
PUSHES: list[tuple[str, float]] = [
    (f"100 if t > {AT - SHORT / 2!r} and t < {AT + SHORT / 2!r} else 0", 0.01),
    (f"200*max(0, 1 - abs(t - at)/{SHORT!r})", 0.02),
    (f"300*max(0, 1 - ((t - at)/{SHORT!r})**2)", 0.04),
    (f"50*(sign(t - {AT - SHORT / 2!r}) - sign(t - {AT + SHORT / 2!r}))", 0.01),
]


@pytest.fixture(scope="module")
def pushed(tmp_path_factory: pytest.TempPathFactory) -> symgen.Model:
    text = f'[mechanism]\nname = "short"\ngravity = [0.0, 0.0]\n[run]\nuntil = 10.0\n[parameters]\nat = {AT}\n'
    for name, (x, y) in {"a": PUSHES[:2], "b": PUSHES[2:]}.items():
        text += f'[bodies.{name}]\ntype = "point"\nmass = 1.0\nposition = [0.0, 0.0]\nvelocity = [0.1, -0.2]\n'
        text += f'[forces.push_{name}]\ntype = "force"\nbody = "{name}"\nforce = ["{x[0]}", "{y[0]}"]\n'
    file = tmp_path_factory.mktemp("short") / "short.toml"
    file.write_text(text, encoding="utf-8")
    return symgen.load(file)


def expected(end: float, at: tuple[float, ...] = (AT,) * 4) -> dict[str, float]:
    """Positions and speeds behind the pushes: each acts like a blow in its middle."""
    found = dict[str, float]()
    for (axis, speed), (_, impulse), moment in zip(
        [("a.x", 0.1), ("a.y", -0.2), ("b.x", 0.1), ("b.y", -0.2)], PUSHES, at, strict=True
    ):
        found[axis] = speed * end + impulse * (end - moment)
        found[axis.replace(".", ".v")] = speed + impulse
    return found


def compared(values: Callable[[str], float], end: float, at: tuple[float, ...] = (AT,) * 4) -> None:
    # each push is 0.01 to 0.04 of speed; the tolerance of runs is 1e-8 of the largest numbers, about 1, a step
    for name, value in expected(end, at).items():
        assert values(name) == pytest.approx(value, abs=1e-6), name


@pytest.mark.parametrize("integrator", SCHEMES)
def test_runs_miss_none(pushed: symgen.Model, integrator: str) -> None:
    result = pushed.simulate(method="lagrange", integrator=integrator, rtol=1e-8)
    assert result.status == "ok"
    compared(lambda name: result[name][-1], 10.0)


@pytest.mark.parametrize("integrator", SCHEMES)
def test_runs_step_by_step_miss_none(pushed: symgen.Model, integrator: str) -> None:
    for until, ends in ((10.0, (10.0,)), (10.0, (1.0, 3.3, 5.0, 10.0)), (0.7, (2.0, 10.0))):
        run = pushed.start(method="lagrange", integrator=integrator, rtol=1e-8, until=until)
        for end in ends:
            run.run(end)
        compared(run.bodies.__getitem__, 10.0)


def test_a_run_that_is_taken_back_meets_them_again(pushed: symgen.Model) -> None:
    run = pushed.start(method="lagrange", integrator="dop853", rtol=1e-8, until=0.5)
    run.run(2.0)
    saved = run.save()
    run.run(9.0)
    run.restore(saved)
    run.step(8.0)
    compared(run.bodies.__getitem__, 10.0)


def test_a_parameter_that_is_set_moves_them(pushed: symgen.Model) -> None:
    run = pushed.start(method="lagrange", integrator="dopri5", rtol=1e-8)
    run.run(2.0)
    run.set(at=6.0)
    run.run(10.0)
    compared(run.bodies.__getitem__, 10.0, (AT, 6.0, 6.0, AT))


def test_rows_of_sweeps_are_single_runs(pushed: symgen.Model) -> None:
    settings = {"method": "lagrange", "integrator": "dop853", "rtol": 1e-8}
    found = sweep(pushed, vary={"at": [2.0, AT, 7.0]}, quantities=["a.vy", "b.x"], **settings)  # type: ignore[arg-type]
    for row, at in zip(found.values[:, :, -1], (2.0, AT, 7.0), strict=True):
        alone = pushed.simulate(parameters={"at": at}, **settings)  # type: ignore[arg-type]
        assert row.tolist() == [alone["a.vy"][-1], alone["b.x"][-1]]
        assert alone["a.vy"][-1] == pytest.approx(-0.18, abs=1e-8)


def test_constant_steps_say_what_they_may_miss(pushed: symgen.Model) -> None:
    def told(**chosen: object) -> list[str]:
        result = pushed.simulate(method="lagrange", integrator="rk4", until=4.0, **chosen)  # type: ignore[arg-type]
        return [warning for warning in result.warnings if "within one step" in warning]

    assert told(step=0.01) and not told(step=4e-5)
    assert f"t = {AT - SHORT / 2:.9g} and " in told(step=0.01, parameters={"at": 2.0})[0]  # type: ignore[arg-type]


def test_devices_say_that_they_go_across(pushed: symgen.Model) -> None:
    asked = symgen.Settings(method="lagrange", integrator="dopri5")
    for target, told in (("cuda", 1), ("cpu", 0)):
        notes = make_ensemble(pushed, asked, {"at": [2.0, 3.0]}, {}, None, target).notes
        assert len([note for note in notes if "goes across" in note]) == told


def test_values_over_times_are_those_at_each(pushed: symgen.Model) -> None:
    """Formulas as arrays, where some are undefined, and one by one: to the last bit."""
    formulas, times = InTime(pushed.mechanism, {"at": AT}), np.linspace(-1.0, 4.0, 301)
    for text in (
        "sqrt(t)",
        "1/(t*t - t)",
        "sin(30*t)*exp(-t)",
        "log(t) if t > 1/2 else at",
        "t if t > 1 or log(t) > 0 else 0",
    ):
        e = parse(text, Names("a formula", {"t": "t", "at": "at"}, {}, {}), "here")
        one_by_one = [formulas.at(e, t) for t in times.tolist()]
        np.testing.assert_array_equal(formulas.over(e, times), one_by_one)


def test_plateaus_are_not_searched(pushed: symgen.Model) -> None:
    """What stays where it is has a least value everywhere: looking for it between all looks would take seconds."""
    looks, formulas = [0], InTime(pushed.mechanism, {"at": AT})
    at = formulas.at

    def counted(e: object, t: float) -> float:
        looks[0] += 1
        return at(e, t)  # type: ignore[arg-type]

    formulas.at = counted  # type: ignore[method-assign]
    (jump,) = (jump for jump in foreseen(pushed.mechanism).kinks if abs(formulas.at(jump.argument, 0.0)) > 1e6)
    assert len(formulas.crossings(jump, 10.0)) == 2
    assert looks[0] < 1000

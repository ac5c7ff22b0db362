"""Poisson's law of impacts, by which restitutions are ratios of impulses, against combinations of modes in NumPy."""

import itertools
import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from symgen.base.errors import InputError
from tests.result.targets.test_c_modes import assert_same_run, program_of
from tests.run.contacts.scenes import body, floor, head, loaded

Array = NDArray[np.float64]
POISSON = 'restitution_law = "poisson"\n'


def part_of_impact(
    gaps: Array, slips: Array, mass: Array, v: Array, mu: Array, least: Array
) -> tuple[Array, Array, bool]:
    """Return velocities after a part of an impact, impulses on gaps, and whether there are no others.

    Impulses are at least some.

    Each gap keeps to its least impulse and opens, or closes; each friction sticks or slides one of two ways.
    """
    inverse, n, found = np.linalg.inv(mass), len(gaps), list[tuple[Array, Array]]()
    alone = True
    for opens in itertools.product((False, True), repeat=n):
        for slides in itertools.product((0, 1, -1), repeat=n):
            lines, right = list[Array](), list[float]()
            rows = np.concatenate([gaps, slips])
            for i in range(n):
                line = np.zeros(2 * n)
                if opens[i]:
                    line[i] = 1.0
                    right.append(float(least[i]))
                else:
                    line = gaps[i] @ inverse @ rows.T
                    right.append(float(-gaps[i] @ v))
                lines.append(line)
            for i in range(n):
                line = np.zeros(2 * n)
                if slides[i] == 0:
                    line = slips[i] @ inverse @ rows.T
                    right.append(float(-slips[i] @ v))
                else:
                    line[n + i], line[i] = 1.0, slides[i] * mu[i]
                    right.append(0.0)
                lines.append(line)
            impulses = np.linalg.lstsq(np.array(lines), np.array(right), rcond=None)[0]
            if np.abs(np.array(lines) @ impulses - right).max() > 1e-9:
                continue
            after = v + inverse @ rows.T @ impulses
            holds = all(
                (gaps[i] @ after >= -1e-10 if opens[i] else impulses[i] >= least[i] - 1e-10)
                and (
                    abs(impulses[n + i]) <= mu[i] * impulses[i] + 1e-10
                    if slides[i] == 0
                    else slides[i] * (slips[i] @ after) >= -1e-10
                )
                for i in range(n)
            )
            if holds:
                found.append((after, impulses[:n]))
                used = int(np.count_nonzero(np.abs(lines).max(axis=1) > 0.0))
                alone = alone and bool(np.linalg.matrix_rank(np.array(lines), tol=1e-9) == used)
    assert found
    return *found[0], alone and all(np.allclose(np.concatenate(found[0]), np.concatenate(x), atol=1e-8) for x in found)


def after_impact(gaps: Array, slips: Array, mass: Array, v: Array, mu: Array, e: Array) -> Array:
    """Return the velocities after an impact: compression, then expansion; nan where impulses of the former are many."""
    between, pressed, alone = part_of_impact(gaps, slips, mass, v, mu, np.zeros(len(gaps)))
    return part_of_impact(gaps, slips, mass, between, mu, e * pressed)[0] if alone else np.full(len(v), math.nan)


def wheel(kerb: float, rate: float, mu: float, e: float, law: str = POISSON) -> tuple[str, Array]:
    """Return a wheel of radius 0.3 m that rolls against a kerb, and its velocities after the impact."""
    radius, mass, inertia = 0.3, 4.0, 0.2
    back = math.sqrt(radius**2 - (radius - kerb) ** 2)
    text = head("kerb") + law + body("wheel", mass, inertia, (-back, radius), (rate, 0.0), -rate / radius)
    text += floor("wheel", radius, mu, e)
    corner = f'{{ body = "ground", at = [0.0, {kerb}] }}'
    text += f'[contacts.edge]\nbetween = [{{ body = "wheel", disc = {radius} }}, {corner}]\n'
    text += f"friction = {mu}\nrestitution = {e}\n"
    normal = np.array([-back, radius - kerb]) / radius
    along = np.array([normal[1], -normal[0]])
    gaps = np.array([[0.0, 1.0, 0.0], [*normal, 0.0]])
    slips = np.array([[1.0, 0.0, radius], [*along, radius]])
    given = np.array([rate, 0.0, -rate / radius])
    both = np.array([mu, mu]), np.array([e, e])
    return text, after_impact(gaps, slips, np.diag([mass, mass, inertia]), given, *both)


@pytest.mark.slow
def test_a_wheel_at_a_kerb(tmp_path: Path) -> None:
    """Sixty wheels have the velocities of NumPy, and no more energy than before."""
    for kerb, rate, mu, e in np.random.default_rng(9).uniform((0.01, 0.5, 0.05, 0.0), (0.2, 3.0, 1.2, 0.9), (60, 4)):
        text, after = wheel(*map(float, (kerb, rate, mu, e)))
        run = loaded(text, tmp_path).simulate(until=1e-9, step=1e-9, integrator="rk4", verify=False)
        assert run.ok, (kerb, rate, mu, e, run.reason)
        found = np.array([run[name][-1] for name in ("wheel.vx", "wheel.vy", "wheel.omega")])
        np.testing.assert_allclose(found, after, rtol=0.0, atol=1e-7)
        before = 4.0 * rate**2 + 0.2 * (rate / 0.3) ** 2
        assert 4.0 * (after[0] ** 2 + after[1] ** 2) + 0.2 * after[2] ** 2 <= before * (1.0 + 1e-12)


def rod(given: Array, law: str) -> tuple[str, Array, Array]:
    """Return a rod whose two ends meet a floor and a wall, its mass matrix, and what follows by Poisson's law."""
    angle, vx, vy, omega, mu, e = map(float, given)
    mass, inertia, half = 2.0, 0.15, 0.5
    c, s = math.cos(angle), math.sin(angle)
    place = half * c, half * s
    text = head("rod") + law + body("rod", mass, inertia, place, (vx, vy), omega, angle - math.pi)
    for name, at, line in (
        ("floor", half, "normal = [0.0, 1.0]"),
        ("wall", -half, f"on = [{2.0 * half * c!r}, 0.0], normal = [-1.0, 0.0]"),
    ):
        text += f'[contacts.{name}]\nbetween = [{{ body = "rod", at = [{at}, 0.0] }}, {{ line = "ground", {line} }}]\n'
        text += f"friction = {mu!r}\nrestitution = {e!r}\n"
    gaps = np.array([[0.0, 1.0, -half * c], [-1.0, 0.0, half * s]])
    slips = np.array([[1.0, 0.0, half * s], [0.0, 1.0, half * c]])
    both = np.array([mu, mu]), np.array([e, e])
    masses = np.diag([mass, mass, inertia])
    return text, masses, after_impact(gaps, slips, masses, np.array([vx, vy, omega]), *both)


@pytest.mark.slow
def test_a_rod_between_floor_and_wall(tmp_path: Path) -> None:
    """By Poisson's law no impact gains energy; by Newton's some do, and end their runs, and others differ."""
    drawn = np.random.default_rng(3).uniform(
        (0.3, -2.0, -2.0, -6.0, 0.0, 0.0), (1.3, 2.0, 0.5, 6.0, 0.9, 0.9), (300, 6)
    )
    seen, others, gained = 0, 0, 0
    for given in drawn:
        angle, vx, vy, omega = given[:4]
        closing = vy - 0.5 * math.cos(angle) * omega, -vx + 0.5 * math.sin(angle) * omega
        if min(closing) > -0.05 or max(map(abs, closing)) < 0.1 or min(map(abs, closing)) < 0.05:
            continue
        text, masses, after = rod(given, POISSON)
        if np.any(np.isnan(after)):
            continue
        run = loaded(text, tmp_path).simulate(until=1e-9, step=1e-9, integrator="rk4", verify=False)
        assert run.ok, (given, run.reason)
        found = np.array([run[name][-1] for name in ("rod.vx", "rod.vy", "rod.omega")])
        np.testing.assert_allclose(found, after, rtol=0.0, atol=1e-7)
        before = given[1:4] @ masses @ given[1:4]
        assert found @ masses @ found <= before * (1.0 + 1e-8)
        seen += 1
        try:
            newton = loaded(rod(given, "")[0], tmp_path).simulate(until=1e-9, step=1e-9, integrator="rk4", verify=False)
        except InputError as error:
            gained += int("adds no energy" in str(error))
        else:
            others += int(abs(newton["rod.omega"][-1] - found[2]) > 1e-6)
    assert seen > 15 and others > 5 and gained > 0


@pytest.mark.slow
@pytest.mark.parametrize("e", [0.4, 1.0])
def test_a_cradle_of_stops_and_a_run_in_c(e: float, tmp_path: Path) -> None:
    """Five balls in a row, of which the first strikes: as stops between them, without friction."""
    text, n = head("cradle", 0.0, 0.0) + POISSON, 5
    for i in range(n):
        text += body(
            f"b{i}", 1.0 + 0.5 * i, 0.1, (0.2 * i - (0.05 if i == 0 else 0.0), 0.0), (1.0 if i == 0 else 0.0, 0.0)
        )
        text += f'[joints.j{i}]\ntype = "translational"\nbetween = ["ground", "b{i}"]\nat = [[0.0, 0.0], "centre"]\n'
        text += "axis = [1.0, 0.0]\n"
    for i in range(n - 1):
        text += f'[stops.s{i}]\ngap = "b{i + 1}.x - b{i}.x - 0.2"\nrestitution = {e}\n'
    gaps = np.zeros((n - 1, n))
    for i in range(n - 1):
        gaps[i, i], gaps[i, i + 1] = -1.0, 1.0
    mass, v = np.diag(1.0 + 0.5 * np.arange(n)), np.eye(n)[0]
    none = np.zeros((n - 1, n)), np.zeros(n - 1)
    expected = after_impact(gaps, none[0], mass, v, none[1], np.full(n - 1, e))
    model = loaded(text, tmp_path)
    run = model.simulate(until=0.06, verify=False, step=1e-3, integrator="rk4")
    assert run.ok, run.reason
    np.testing.assert_allclose([run[f"b{i}.vx"][-1] for i in range(n)], expected, rtol=0.0, atol=1e-12)
    assert assert_same_run(model, program_of(model, tmp_path / "c"), 0.06, 1e-3)


def test_single_impacts_are_those_of_newton(tmp_path: Path) -> None:
    """A ball without friction jumps as high by both laws, and comes to rest."""
    for law in ("", POISSON):
        text = head("ball") + law + body("ball", 1.0, 0.1, (0.0, 0.2)) + '[stops.base]\ngap = "ball.y"\n'
        run = loaded(text + "restitution = 0.5\n", tmp_path).simulate(until=0.8, rtol=1e-11, verify=False)
        assert run.ok and run.events[-1].name == "base.rest"
        fall = math.sqrt(0.4 / 9.81)
        assert run.events[1].t == pytest.approx(2.0 * fall, abs=1e-10)
        assert abs(run["ball.y"][-1]) < 1e-10


def test_derivatives_are_refused(tmp_path: Path) -> None:
    """At once, whether or not there will be an impact; of a run without one-sided rows they are not."""
    model = loaded(wheel(0.1, 1.0, 0.3, 0.5)[0] + "[parameters]\nk = 1.0\n", tmp_path)
    settings: dict[str, Any] = {"until": 1e-9, "step": 1e-9, "integrator": "rk4"}
    for ask in (
        lambda: model.simulate(sensitivities=["k"], verify=False, **settings),
        lambda: model.gradient("wheel.x", by=("k",), way="adjoint", **settings),
    ):
        with pytest.raises(InputError, match=r'derivatives: expected restitution_law = "newton"'):
            ask()
    free = '[mechanism]\nname = "free"\nrestitution_law = "poisson"\n[parameters]\nk = 1.0\n'
    free += body("block", 1.0, 0.1, (0.0, 0.0)).replace("[0.0, 0.0]", '["k", 0.0]', 1)
    assert loaded(free, tmp_path).simulate(until=0.1, sensitivities=["k"], verify=False).ok

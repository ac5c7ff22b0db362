"""Loops in closed form: velocities that stay free at a start, code by that choice, and runs that leave it."""

import math

import numpy as np
import pytest
from support.checks import close

import symgen
from symgen import Settings
from symgen.base.ir.program import BY_PIVOTS
from symgen.run.compiling import free_by_loops
from symgen.run.compiling.choices import mechanism_on_tree
from symgen.run.compiling.folders import folder_of
from symgen.run.compiling.free_by_loops import choice_at_start, free_velocities
from symgen.run.compiling.method_choice import choose_method
from symgen.run.compiling.pipeline import compile_model
from symgen.run.layout import abi
from symgen.run.layout.abi import N_COUNTERS
from symgen.run.layout.probe import Ready
from symgen.run.planning.prepare import prepare


@pytest.fixture
def linkage(tmp_path):
    """A four-bar linkage with a crank of 6 m that starts at an angle; beyond 104 degrees it cannot close."""

    def at(degrees: float):
        x, y = 6.0 * math.cos(math.radians(degrees)), 6.0 * math.sin(math.radians(degrees))
        to_ground = math.hypot(10.0 - x, y)
        inner = math.acos((64.0 + to_ground**2 - 25.0) / (16.0 * to_ground))
        coupler = inner - math.asin(y / to_ground)
        end = x + 8.0 * math.cos(coupler), y + 8.0 * math.sin(coupler)
        middles = ((x / 2, y / 2), ((x + end[0]) / 2, (y + end[1]) / 2), ((10.0 + end[0]) / 2, end[1] / 2))
        angles = math.radians(degrees), coupler, math.atan2(end[1], end[0] - 10.0)
        bodies = "".join(
            f"[bodies.{name}]\nmass = {length}\ninertia = {length**3 / 12}\n"
            f"position = {list(middle)}\nangle = {angle}\n"
            f"points = {{ a = [{-length / 2}, 0.0], b = [{length / 2}, 0.0] }}\n"
            for name, length, middle, angle in zip(
                ("crank", "coupler", "rocker"), (6.0, 8.0, 5.0), middles, angles, strict=True
            )
        )
        joints = "".join(
            f'[joints.{name}]\ntype = "revolute"\nbetween = ["{a}", "{b}"]\n{where}\n'
            for name, a, b, where in (
                ("A", "ground", "crank", 'at = [[0.0, 0.0], "a"]'),
                ("B", "crank", "coupler", 'at = ["b", "a"]'),
                ("C", "coupler", "rocker", 'at = ["b", "b"]'),
                ("D", "ground", "rocker", 'at = [[10.0, 0.0], "a"]'),
            )
        )
        file = tmp_path / f"linkage-{degrees:g}.toml"
        file.write_text(f'[mechanism]\nname = "linkage"\ngravity = [0.0, -9.81]\n[run]\nuntil = 2.0\n{bodies}{joints}')
        return symgen.load(str(file)).mechanism

    return at


def names_of(mechanism):
    info = compile_model(mechanism, choose_method("lagrange")).info
    return [info.velocities[j].name for j in free_velocities(mechanism)]


@pytest.mark.by_turns(6)
@pytest.mark.fast("four-bar-free0-most0-absolute", "four-bar-free0-most0-joint")
@pytest.mark.parametrize("coordinates", ["absolute", "joint"])
@pytest.mark.parametrize(
    ("name", "free", "most"),
    [
        ("four-bar", ["crank.omega"], (165, 116)),
        ("andrews", ["K1.omega"], (580, 355)),
        ("n-four-bar:10", ["vertical0.omega"], (1300, 1000)),
    ],
)
def test_loops_of_the_catalogue_leave_the_crank_free(name, free, most, coordinates):
    mechanism, joint = symgen.load(name).mechanism, coordinates == "joint"
    assert names_of(mechanism_on_tree(mechanism) if joint else mechanism) == free
    operations = prepare(mechanism, Settings(coordinates=coordinates)).compiled.law.operations
    assert operations["rhs"] <= most[joint] < operations[BY_PIVOTS]


@pytest.mark.fast("jansen-leg", "bricard", "slider-crank", "chain:4")
@pytest.mark.parametrize("name", ["jansen-leg", "bricard", "slider-crank", "chain:4", "stewart-platform"])
def test_nothing_is_chosen_where_drivers_decide_or_no_loop_has_two_rows(name):
    mechanism, choice = symgen.load(name).mechanism, choose_method("lagrange")
    assert free_velocities(mechanism) == ()
    assert choice_at_start(mechanism, choice) == choice


def test_a_start_with_another_choice_has_another_module_of_the_same_model(linkage):
    bent, near, stretched = linkage(60.0), linkage(65.0), linkage(103.5)
    assert folder_of(bent) == folder_of(near) == folder_of(stretched)
    keys = [compile_model(mechanism, choose_method("lagrange")).law.key for mechanism in (bent, near, stretched)]
    assert names_of(bent) == ["crank.omega"] != names_of(stretched)
    assert keys[0] == keys[1] != keys[2]


@pytest.mark.slow_cases("60.0-joint", "103.5-joint")
@pytest.mark.parametrize("coordinates", ["absolute", "joint"])
@pytest.mark.parametrize("degrees", [60.0, 103.5])
def test_runs_are_those_by_pivots(linkage, degrees, coordinates, monkeypatch):
    settings = Settings("lagrange", "rk4", step=1e-3, until=0.5, coordinates=coordinates)
    closed = prepare(linkage(degrees), settings).integrate()
    monkeypatch.setattr(free_by_loops, "free_velocities", lambda mechanism: ())
    pivots = prepare(linkage(degrees), settings).integrate()
    assert (BY_PIVOTS in closed.compiled.law.operations, BY_PIVOTS in pivots.compiled.law.operations) == (True, False)
    assert closed.counters["suspects"] == 0
    close(closed.states, pivots.states, "states", 1e-9)
    close(closed.multipliers, pivots.multipliers, "multipliers", 1e-7)


def flag_at_start(run) -> int:
    start = run.start
    y, rates = start.y.copy(), np.zeros_like(start.y)
    arguments = start.t, y, start.p.copy(), start.w.copy(), np.zeros(N_COUNTERS, dtype=np.int64), rates
    return Ready(run.compiled.law_module.rhs, abi.RHS)(*arguments)


def test_a_start_that_the_choice_does_not_suit_is_evaluated_by_pivots(linkage, monkeypatch):
    settings = Settings("lagrange", "rk4", step=1e-3, until=0.1, coordinates="absolute")
    crank = free_velocities(linkage(60.0))
    suited = prepare(linkage(105.961), settings)
    monkeypatch.setattr(free_by_loops, "free_velocities", lambda mechanism: crank)
    other = prepare(linkage(105.961), settings)
    assert (flag_at_start(suited), flag_at_start(other)) == (0, 1)
    close(other.integrate().states, suited.integrate().states, "states", 1e-9)


def test_packages_have_the_code_of_runs(tmp_path):
    package = symgen.load("four-bar").generate(tmp_path / "package", methods=["lagrange"])
    assert any(BY_PIVOTS in file.read_text() for file in package.folder.glob("*.py"))

"""Equilibria and frequencies do not know units: grams and micrometres have those of kilograms and metres."""

import math
from pathlib import Path

import numpy as np
import pytest
from numpy.testing import assert_allclose

import symgen.describe.catalogue
from analyses import rods
from benchmarks.rescale import Units, rescaled
from symgen.base.errors import AssemblyError, InputError


def carousel(mass, length, time=1.0, damping=0.0):
    """A table that turns freely about the vertical with a slide in it that leans, on a spring; lengths grow alike."""
    bodies = {
        "table": {"mass": mass, "position": [0.1 * length, -0.2 * length, 0.0]},
        "slide": {"mass": 0.7 * mass, "position": [0.3 * length, 0.2 * length, -0.3 * length]},
    }
    for body, inertia in zip(bodies.values(), ((0.1, 0.12, 0.15), (0.02, 0.03, 0.04)), strict=True):
        body["inertia"] = [mass * length**2 * x for x in inertia]
    joints = {
        "axle": rods.pin("ground", "table", rods.GROUND3, [-0.1 * length, 0.2 * length, 0.0], axis=[0.0, 0.0, 1.0]),
        "way": rods.pin("table", "slide", rods.GROUND3, [-0.2 * length, -0.4 * length, 0.3 * length], "translational")
        | {"axis": [0.3, 0.5, 0.8]},
    }
    ends = [[0.5 * length, 0.1 * length, 0.9 * length], [0.0, 0.1 * length, 0.0]]
    spring = {"type": "spring-damper", "between": ["table", "slide"], "at": ends, "stiffness": 90.0 * mass / time**2}
    spring |= {"free_length": 0.4 * length, "damping": damping * mass / time}
    pull = [0.0, 0.0, -rods.GRAVITY * length / time**2]
    return rods.model(bodies, joints, "spatial", gravity=pull, forces={"spring": spring})


@pytest.mark.by_turns(3)
@pytest.mark.slow
@pytest.mark.parametrize(("mass", "length"), [(1e-3, 1e-6), (1e-9, 1e-3), (1e6, 1e3)])
def test_small_and_large_mechanisms_rest_alike(mass, length):
    """Moments were compared with forces as numbers, and what turns was taken to have no mass beside what moves."""
    usual, other = (carousel(*size).equilibrium() for size in ((1.0, 1.0), (mass, length)))
    assert usual.stability == other.stability == "indifferent"
    assert_allclose(other.omega_squared, usual.omega_squared, rtol=1e-9)
    assert_allclose(other.q["way.displacement"] / length, usual.q["way.displacement"], rtol=1e-9)
    found = carousel(mass, length).modes().omega_squared
    assert_allclose(found, usual.omega_squared, rtol=1e-9, atol=1e-9 * usual.omega_squared[1])


@pytest.mark.parametrize("mass", [1.0, 1e-3, 1e-9])
def test_what_falls_freely_at_the_start_is_found_whatever_it_weighs(mass):
    """A step downhill was its weight over 1 N/m where nothing restores anything."""
    body = {"mass": mass, "inertia": 0.1 * mass, "position": [0.0, 5.0]}
    rail = rods.pin("ground", "a", rods.GROUND2, rods.GROUND2, "translational", axis=[0.0, 1.0])
    push = {"type": "force", "body": "a", "at": [0.0, 0.0], "force": [0.0, f"max(0, -{1000.0 * mass}*a.y)"]}
    found = rods.model({"a": body}, {"rail": rail}, forces={"push": push}).equilibrium()
    assert_allclose(found.q["a.y"], -rods.GRAVITY / 1000.0, rtol=1e-10)
    assert_allclose(found.omega_squared, [1000.0], rtol=1e-10)
    assert np.isfinite(found.residual)


@pytest.mark.by_turns(6)
@pytest.mark.slow
@pytest.mark.parametrize(("length", "time"), [(2.0**-20, 1.0), (2.0**20, 1.0), (1.0, 2.0**-10), (1.0, 2.0**10)])
def test_what_is_free_has_frequency_zero_in_all_units(length, time):
    """Damped, the table's turning was compared with the slide's metres, and seconds with themselves, as numbers."""

    def found(length, time):
        model = carousel(1.0, length, time, 0.8)
        return [time * e for e in (model.modes().eigenvalues, model.linearise().eigenvalues())]

    for usual, other in zip(found(1.0, 1.0), found(length, time), strict=True):
        assert np.sum(usual == 0.0) == np.sum(other == 0.0) == 2
        assert_allclose(other, usual, rtol=1e-9)


@pytest.mark.by_turns(4)
@pytest.mark.fast("1e-06-1.0-0.5", "1000.0-10000.0-0.5")
@pytest.mark.parametrize("turned", [0.5, 0.0])
@pytest.mark.parametrize(("length", "time"), [(1.0, 1.0), (1.0, 1e4), (1e-6, 1.0), (1e-6, 1e3), (1e3, 1e4)])
def test_what_swings_is_at_rest_in_no_units(length, time, turned):
    """At the end of its swing, or at the bottom: in slow or small mechanisms either was a state of rest."""
    rod = {"mass": 1.0, "inertia": 0.1 * length**2, "angle": turned, "angular_velocity": (0.5 - turned) / time}
    rod["position"] = [0.5 * length * math.sin(turned), -0.5 * length * math.cos(turned)]
    pin = {"type": "revolute", "between": ["ground", "rod"], "at": [[0.0, 0.0], [0.0, 0.5 * length]]}
    model = rods.model({"rod": rod}, {"pin": pin}, gravity=[0.0, -rods.GRAVITY * length / time**2])
    for found in (model.linearise, model.modes):
        with pytest.raises(InputError, match=r"a state of rest.* got one where 'rod\.\w+' changes"):
            found(at="start")
    frequency = np.sqrt(0.5 * rods.GRAVITY / 0.35)
    assert_allclose(model.linearise().eigenvalues().imag * time, [frequency, -frequency], rtol=1e-9)


def links(count, length):
    """Links hung in a chain between two pins, all of one length."""
    bodies, joints = {}, {}
    for i in range(count):
        place = [(0.5 + 0.8 * i) * length, 0.1 * i * length]
        bodies[f"l{i}"] = {"mass": 1.0, "inertia": length**2 / 12.0, "position": place, "angle": 0.3 * i}
        before = "ground" if i == 0 else f"l{i - 1}"
        at = rods.GROUND2 if i == 0 else [0.5 * length, 0.0]
        joints[f"j{i}"] = rods.pin(before, f"l{i}", at, [-0.5 * length, 0.0])
    end = [0.6 * count * length, 0.2 * length]
    joints["end"] = rods.pin("ground", f"l{count - 1}", end, [0.5 * length, 0.0])
    return rods.model(bodies, joints, gravity=[0.0, -rods.GRAVITY * length])


@pytest.mark.by_turns(2)
@pytest.mark.slow  # looped code of an implicit law is compiled
def test_sparse_matrices_know_no_unit_of_length():
    """Gaps were divided by a metre at least, steps measured in metres; a turning table was left where it is open."""
    for make in (lambda length: carousel(1.0, length), lambda length: links(8, length)):
        dense = make(1.0).equilibrium(shape="straight")
        found = {power: make(2.0**power).equilibrium(shape="looped") for power in (-20, -10, 0, 12)}
        assert_allclose(found[0].omega_squared, dense.omega_squared, rtol=1e-9, atol=1e-9 * dense.omega_squared[-1])
        for power, other in found.items():
            assert other.omega_squared == found[0].omega_squared and other.iterations == found[0].iterations
            for name, value in found[0].q.items():
                turned = name.rpartition(".")[2] in ("theta", "angle", "e0", "e1", "e2", "e3")
                assert other.q[name] == value * (1.0 if turned else 2.0**power), name


STEADY = {
    "front-suspension": (-20, -30, -13),
    "flyball-governor": (20, 30, 10),
}


@pytest.mark.by_turns(4)
@pytest.mark.slow
@pytest.mark.parametrize("entry", STEADY)
def test_steady_motions_are_found_in_all_units(entry, tmp_path):
    """Shifts of 0.3 m and 0.3 s and speeds of 1 m/s were taken to ask what depends on what."""
    source = (Path(symgen.describe.catalogue.__file__).parent / f"{entry}.toml").read_text(encoding="utf-8")

    def found(name, units):
        path = tmp_path / f"{name}.toml"
        path.write_text(rescaled(source, units))
        model = symgen.load(path)
        told = model.linearise(at="steady").eigenvalues(), model.modes(at="steady").eigenvalues
        return [units.time * eigenvalues for eigenvalues in told]

    usual = found("usual", Units(3.0, 3.0, 3.0))
    units = Units(*(3.0 * 2.0**power for power in STEADY[entry]))
    for before, after in zip(usual, found("other", units), strict=True):
        assert_allclose(after, before, rtol=1e-8, atol=1e-8 * np.abs(before).max())


@pytest.mark.slow
def test_what_no_start_closes_settles_alike_in_all_units(monkeypatch):
    """Its length was the spread of all its coordinates, angles among them: 1.2 m of a link of a micrometre."""

    def no_start(*_):
        raise AssemblyError("not closed")

    def found(length):
        link = {"mass": 1.0, "inertia": 0.1 * length**2, "position": [0.3 * length, 0.2 * length], "angle": 1.2}
        pin = rods.pin("ground", "link", rods.GROUND2, [-0.5 * length, 0.0])
        ends = [[1.5 * length, 0.0], [0.5 * length, 0.0]]
        spring = {"type": "spring-damper", "between": ["ground", "link"], "at": ends, "stiffness": 30.0}
        forces = {"spring": spring | {"free_length": 0.3 * length}}
        pull = [0.0, -rods.GRAVITY * length]
        return rods.model({"link": link}, {"pin": pin}, gravity=pull, forces=forces).equilibrium()

    monkeypatch.setattr("symgen.run.planning.prepare.begin_start", no_start)
    usual = found(1.0)
    for power in (-20, -10, 12):
        other = found(2.0**power)
        assert other.iterations == usual.iterations and other.q["link.theta"] == usual.q["link.theta"]
        assert other.q["link.x"] == usual.q["link.x"] * 2.0**power

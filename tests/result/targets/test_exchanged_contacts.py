"""Contacts, and pins that rub beside stops, in model exchange: CVode and an own importer beside closed forms."""

import subprocess
import sys

import numpy as np
import pytest
from fmpy import simulate_fmu
from fmpy.validation import validate_fmu

from tests.result.targets.compilers import compiled, written
from tests.result.targets.test_c_runs import run_of
from tests.result.targets.test_exchanged_modes import Importer, exchanged
from tests.result.targets.test_fmu import fmu_of, importer_of
from tests.result.targets.test_fmu_derivatives import Unit, differences
from tests.run.contacts.scenes import CRANK, DROP, G, loaded, place_of_disc, rocking_block, woodpecker
from tests.run.contacts.scenes_in_space import DIE, SKITTLE
from tests.run.contacts.test_poisson import wheel
from tests.run.contacts.test_reactions_beside import cart, two_rods
from tests.run.contacts.test_stacks import stack

BLOCK = rocking_block(0.15, 0.5, 0.12)
#: Files, their ends [s], version of the interface, coordinates, and the largest error of places over their sizes.
SCENES = {
    "block": (BLOCK, 1.6, 2, "absolute", 1e-9),
    "woodpecker": (woodpecker(), 0.4, 3, "absolute", 1e-8),
    "woodpecker in joints": (woodpecker(), 0.4, 2, "joint", 1e-8),
    "pin beside a stop": (cart(0.05), 1.0, 3, "joint", 1e-9),
    "pins beside a stop": (two_rods(), 1.0, 2, "absolute", 1e-8),
    "pins beside a contact": (two_rods(touch="contact"), 1.0, 3, "absolute", 1e-8),
    "wheel at a kerb": (wheel(0.1, 8.0, 0.4, 0.3)[0], 0.5, 2, "absolute", 1e-9),
    "slider with play": (CRANK, 0.014, 2, "absolute", 1e-7),
    "die in space": (DIE, 0.6, 3, "absolute", 1e-8),
    "ball in space": (SKITTLE, 1.2, 3, "absolute", 1e-8),
    "stack": (stack(np.array([0.0, 0.02, -0.01]), 0.02), 0.5, 3, "absolute", 1e-9),
}


@pytest.mark.by_turns(10)
@pytest.mark.slow
@pytest.mark.parametrize("name", SCENES)
def test_scenes_are_those_of_runs(name, tmp_path):
    text, until, fmi, coordinates, error = SCENES[name]
    model = loaded(text, tmp_path)
    path = fmu_of(model, tmp_path / "scene.fmu", fmi=fmi, coordinates=coordinates)
    assert validate_fmu(str(path)) == []
    rows = exchanged(path, until)
    times = np.unique(rows["time"])
    last = np.searchsorted(rows["time"], times, side="right") - 1
    own = model.simulate(times=times, until=until, integrator="dop853", rtol=1e-12, coordinates=coordinates)
    assert own.ok
    for each in own.q.names:
        assert np.abs(rows[each][last] - own[each]).max() < error * max(1.0, np.abs(own[each]).max()), each
    for each in own.v.names:
        assert abs(rows[each][-1] - own[each][-1]) < 100.0 * error * max(1.0, np.abs(own[each]).max()), each
    for each in rows.dtype.names:
        if each.endswith(".mode"):
            assert rows[each][-1] == own[each][-1], each


@pytest.mark.by_turns(2)
@pytest.mark.slow
def test_a_spinning_disc_that_bounces_slides_and_rolls_as_its_closed_form(tmp_path):
    """One instance for all values, at tolerances that lose the last flights of the disc."""
    importer = importer_of(fmu_of(loaded(DROP, tmp_path), tmp_path / "disc.fmu", fmi=3), tmp_path / "disc")
    for tolerance, most in ((1e-6, 1e-4), (1e-10, 1e-8)):
        for e in (0.0, 0.3, 0.6, 0.8):
            for mu in np.linspace(0.01, 0.2, 10):
                until = np.sqrt(2.0 / G) * (1.0 + e) / (1.0 - e) + 0.5
                rows = simulate_fmu(
                    **importer, stop_time=until, relative_tolerance=tolerance, output_interval=until / 100,
                    output=["disc.x", "disc.vx", "disc.y", "floor.mode"], start_values={"mu": mu, "e": e},
                )  # fmt: skip
                x, v = place_of_disc(mu, e, until)
                assert abs(rows["disc.x"][-1] - x) < most and abs(rows["disc.vx"][-1] - v) < most, (tolerance, e, mu)
                assert abs(rows["disc.y"][-1] - 0.1) < 1e-12 and rows["floor.mode"][-1] != 0.0
                importer["fmu_instance"].reset()


@pytest.mark.slow
@pytest.mark.parametrize(("text", "until"), [(BLOCK, 1.3), (cart(0.05), 1.0)], ids=["block", "pin"])
def test_an_own_importer_halves_its_steps_down_to_events(text, until, tmp_path):
    model = loaded(text, tmp_path)
    command = [sys.executable, "-m", "symgen", "generate", "scene.toml", "--target", "fmu", "-o", "scene.fmu"]
    ran = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, check=False)
    assert ran.returncode == 0 and "co-simulation alone" not in ran.stdout + ran.stderr
    importer = Importer(tmp_path / "scene.fmu", tmp_path / "unpacked")
    importer.go(until, 2e-3)
    own = model.simulate(until=until, times=[0.0, until], integrator="dop853", rtol=1e-12)
    assert own.ok and importer.events >= 2
    for name in (*own.q.names, *own.v.names):
        assert importer[name] == pytest.approx(own[name][-1], abs=1e-8), name


@pytest.mark.slow
def test_directional_derivatives_where_a_block_stands_on_a_corner(tmp_path):
    unit = Unit(fmu_of(loaded(BLOCK, tmp_path), tmp_path / "block.fmu", derivatives=True))
    states = unit.values(unit.states)
    unknowns = [*unit.outputs, *unit.rates]
    found = unit.matrix(unknowns, unit.states)
    expected = differences(unit, 0.0, states, np.zeros(0))[:, : len(states)]
    np.testing.assert_allclose(found, expected, rtol=1e-6, atol=1e-6)
    assert np.abs(found[len(unit.outputs) :]).max() > 1.0


@pytest.mark.by_turns(2)
@pytest.mark.slow
@pytest.mark.parametrize("kind", ["CoSimulation", "ModelExchange"])
def test_an_fmu_and_c_say_that_other_motions_were_not_sought(kind, tmp_path):
    note, said = "other motions were not sought among 12 rows of contacts and friction", []
    model = loaded(stack(np.zeros(3)) + "[run]\nuntil = 0.02\n", tmp_path)
    path = fmu_of(model, tmp_path / "stack.fmu", fmi=3)
    simulate_fmu(
        str(path), fmi_type=kind, stop_time=0.02, logger=lambda *words: said.append(words[-1].decode()),
        output=["b0.y"],
    )  # fmt: skip
    assert said == [note]
    assert run_of(compiled(written(model.mechanism, tmp_path / "c"))).stderr == f"{note}\n"
    assert note in model.simulate().notes

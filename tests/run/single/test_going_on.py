"""Runs that go on from results and files: bit for bit the run in one piece, or from its last coordinates alone."""

import copy
import json
import pickle
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import xarray as xr
from support.emitted import mechanism_of
from support.models import parallelogram
from support.remembering import PAIRS

import symgen
from symgen.base.errors import InputError
from symgen.cli import main
from symgen.run.integrators import INTEGRATORS

STEP, FIRST, LAST = 2e-3, 12, 30
TABLES = ("t", "kinetic", "potential", "work", "energy_error", "smallest_pivot")


def settings(method: str, integrator: str, **more):
    constant = {"options": {"integrator.adaptive": "false"}} if INTEGRATORS.get(integrator).adaptive else {}
    limits = {"max_violation": 1.0, "max_energy_error": 1e9}
    return {"method": method, "integrator": integrator, "shape": "straight", **limits, **constant, **more}


def assert_the_rest(found, whole, rounding=0.0):
    """All tables of `found` are the last rows of those of `whole`.

    What is evaluated at outputs after a run may differ by rounding where a method remembers a basis: that of a run in
    one piece was chosen at an earlier output.
    """
    assert found.ok and whole.ok, found.reason
    count = len(found.t)
    for name in TABLES:
        np.testing.assert_array_equal(getattr(found, name), getattr(whole, name)[-count:], err_msg=name)
    for name, table in found.tables().items():
        exact = name in ("q", "v", "energy")
        expected = whole.tables()[name].values[-count:]
        np.testing.assert_allclose(table.values, expected, rtol=0.0, atol=0.0 if exact else rounding, err_msg=name)
    for name in ("position_violation_max", "velocity_violation_max", "energy_drift_max", "rank_events"):
        assert getattr(found, name) == getattr(whole, name), name
    for name, array in whole.last_state.arrays.items():
        if name == "control":
            continue  # counts outputs
        np.testing.assert_array_equal(found.last_state.arrays[name], array, err_msg=name)


@pytest.mark.parametrize(("method", "integrator"), PAIRS)
def test_two_runs_are_the_run_in_one_piece(method, integrator):
    """Every table and everything that is kept, with constant steps; the crank begins at rest."""
    model, asked = symgen.load("four-bar"), settings(method, integrator, step=STEP)
    asked |= {"start": {"crank.omega": 0.0}, "output_step": STEP}
    whole = model.simulate(until=STEP * LAST, **asked)
    first = model.simulate(until=STEP * FIRST, **asked)
    second = model.simulate(until=STEP * LAST, **{**asked, "start": first})
    assert second.notes[0] == f"goes on from t = {STEP * FIRST:g} s of another run"
    assert len(second.t) == LAST - FIRST + 1 and second.t[0] == STEP * FIRST
    assert (first.steps, second.steps, whole.steps) == (FIRST, LAST - FIRST, LAST)
    assert first.evaluations + second.evaluations == whole.evaluations
    assert first.iterations + second.iterations == whole.iterations
    assert_the_rest(second, whole, 1e-12 if method == "null-space" else 0.0)


@pytest.mark.by_turns(2)
@pytest.mark.fast("spherical-double-pendulum-lagrange-0.1-0.01-straight")
@pytest.mark.parametrize(
    ("name", "method", "until", "step", "shape"),
    [
        ("bricard", "direct-correction", 0.02, 1e-3, "looped"),
        ("spherical-double-pendulum", "lagrange", 0.1, 1e-2, "straight"),
        ("spherical-double-pendulum", "lagrange", 0.1, 1e-2, "looped"),
        ("parallelogram", "coordinate-partitioning", 1.0, 1e-3, "straight"),
    ],
)
def test_in_space_with_redundant_rows_and_through_a_passage(name, method, until, step, shape):
    model = symgen.load(mechanism_of(parallelogram()) if name == "parallelogram" else name)
    asked = {
        "method": method,
        "integrator": "rk4",
        "step": step,
        "shape": shape,
        "max_energy_error": 10.0,
        "output_step": step,
    }
    whole, found = model.simulate(until=until, **asked), None
    for share in (0.3, 0.5, 1.0):
        before = asked | ({"start": pickle.loads(pickle.dumps(found))} if found else {})
        found = model.simulate(until=step * round(share * until / step), **before)
    np.testing.assert_array_equal(found.q.values, whole.q.values[-len(found.t) :])
    assert found.rank_event_count == whole.rank_event_count and found.rank == whole.rank


@pytest.mark.by_turns(3)
@pytest.mark.slow
@pytest.mark.parametrize("ending", ["nc", "parquet", "csv"])
def test_files(tmp_path, ending):
    model, asked = symgen.load("four-bar"), {"integrator": "abm4", "step": STEP, "output_step": STEP}
    whole = model.simulate(until=STEP * LAST, **asked)
    file = model.simulate(until=STEP * FIRST, **asked).save(tmp_path / f"first.{ending}")
    out = tmp_path / "second.nc"
    words = ("--integrator", "abm4", "--step", str(STEP), "--until", str(STEP * LAST), "--output-step", str(STEP))
    assert main(["run", "four-bar", *words, "--from", str(file), "--save", str(out)]) == 0
    with xr.open_dataset(out, engine="h5netcdf") as found:
        assert found.time[0] == STEP * FIRST and found.time[-1] == STEP * LAST
        expected = whole.q.values[FIRST:]
        if ending == "nc":
            np.testing.assert_array_equal(found["q"], expected)
            np.testing.assert_array_equal(found["energy"][:, 2], whole.work[FIRST:])
        else:  # another start of the multistep scheme
            np.testing.assert_allclose(found["q"], expected, atol=1e-7)
            assert "nothing else was kept" in json.loads(found.attrs["run"])["notes"][0]
            np.testing.assert_allclose(found["energy"][:, 2], whole.work[FIRST:], atol=1e-7)


@pytest.mark.slow
def test_files_of_runs_that_were_not_changed_and_others(tmp_path, capsys):
    model = symgen.load("pendulum")
    first = model.simulate(until=0.01, step=1e-3)
    file = first.save(tmp_path / "first.nc")
    with xr.open_dataset(file, engine="h5netcdf") as found:
        whole = found.load()
    changed = whole.copy(deep=True)
    changed["last_y"][0] += 1e-9
    changed.to_netcdf(tmp_path / "changed.nc", engine="h5netcdf")
    (tmp_path / "text.nc").write_text("no file of a result")
    (tmp_path / "text.csv").write_text("a,b\n1,2\n")
    (tmp_path / "long.csv").write_text("a" * 200_000 + ",b\n1,2\n")  # beyond what Python's reader takes for a word
    older = whole.drop_vars([name for name in whole if str(name).startswith("last_")])
    del older.attrs["last_state"]
    older.to_netcdf(tmp_path / "older.nc", engine="h5netcdf")
    for name, told in {
        "changed.nc": "in which it was changed",
        "text.nc": "cannot be read as one",
        "text.csv": "expected a column 't' or 'time', got the columns 'a', 'b'",
        "long.csv": "expected cells of at most 131072 characters, got a longer one",
        "none.nc": "which is none",
        "first.txt": "a file ending in .nc, .parquet, .csv",
    }.items():
        assert main(["run", "pendulum", "--until", "0.02", "--from", str(tmp_path / name)]) == 2
        said = capsys.readouterr().err
        assert told in said and said.count("\n") == 1, said
    assert main(["run", "pendulum", "--until", "0.02", "--from", str(tmp_path / "older.nc"), "--json"]) == 0
    begun = json.loads(capsys.readouterr().out)["start"]
    assert begun["t"] == 0.01 and begun["q"]["bob.x"] == pytest.approx(first["bob.x"][-1], abs=1e-15)
    assert main(["run", "four-bar", "--until", "0.02", "--from", str(file)]) == 2
    assert (
        "expected the result of a run of four-bar with the same equations, got one of pendulum"
        in capsys.readouterr().err
    )
    assert main(["run", "pendulum", "--until", "0.02", "--from", str(file), "--start", "bob.vx=1"]) == 2
    assert "one way of saying where a run begins" in capsys.readouterr().err


@pytest.mark.slow
@pytest.mark.parametrize("mark", [b"OHDR", b"FRHP", b"BTLF"])
def test_damaged_files_are_refused_in_one_sentence(tmp_path, capsys, mark):
    """A bit of each sort of a NetCDF file's metadata is flipped; libraries raise errors of other types for each."""
    first = symgen.load("pendulum").simulate(until=0.01, step=1e-3)
    whole, damaged = first.save(tmp_path / "first.nc").read_bytes(), tmp_path / "damaged.nc"
    place = whole.index(mark) + 10
    damaged.write_bytes(whole[:place] + bytes([whole[place] ^ 1]) + whole[place + 1 :])
    for words in (["run", "pendulum", "--until", "0.02", "--from", str(damaged)], ["view", str(damaged)]):
        assert main(words) == 2
        lines = capsys.readouterr().err.splitlines()
        assert len(lines) == 1 and "which cannot be read as one" in lines[0], lines


@pytest.mark.parametrize(
    ("damage", "told"),
    [
        (lambda text: text[:-40], "expected as many cells as in the heading, 23, got"),
        (lambda text: text[:-1] + ",9\n", "expected as many cells as in the heading, 23, got 24 in row 12"),
        (lambda text: text.replace("bob.y,", "bob.x,", 1), "expected a name of its own for each column, got 2 columns"),
    ],
)
def test_damaged_tables_are_refused_in_one_sentence(tmp_path, capsys, damage, told):
    file = symgen.load("pendulum").simulate(until=0.01, step=1e-3, output_step=1e-3).save(tmp_path / "first.csv")
    file.write_text(damage(file.read_text()))
    assert main(["run", "pendulum", "--until", "0.02", "--from", str(file)]) == 2
    said = capsys.readouterr().err
    assert told in said and said.count("\n") == 1, said


@pytest.mark.parametrize(
    ("change", "told"),
    [
        ({"method": "lagrange"}, "method lagrange instead of direct-correction"),
        ({"integrator": "dopri5", "options": {"integrator.adaptive": "false"}}, "integrator dopri5 instead of rk4"),
        ({"step": 1e-3}, "step 0.001 instead of 0.002"),
        ({"parameters": {"crank_mass": 3.0}}, "crank_mass 3 instead of 2"),
        ({"options": {"method.weight": "mass"}}, "weight mass instead of identity"),
        (
            {"record_when": "crank.theta > 1.1"},
            "events crank.theta > 1.1 (record) where crank.theta - 1.1 passes 0, rising instead of none",
        ),
    ],
)
def test_a_run_of_another_making_takes_coordinates_and_velocities(change, told):
    model = symgen.load("four-bar")
    asked = {"method": "direct-correction", "integrator": "rk4", "step": STEP, "output_step": STEP}
    first = model.simulate(until=STEP * FIRST, **asked)
    second = model.simulate(until=STEP * LAST, start=first, **{**asked, **change})
    assert second.ok and told in second.notes[0], second.notes
    assert second.t[0] == STEP * FIRST and second.t[-1] == STEP * LAST
    np.testing.assert_allclose(second.q.values[0], first.q.values[-1], atol=1e-14)
    np.testing.assert_allclose(second.v.values[0], first.v.values[-1], atol=1e-13)
    balance = first.energy_error[-1] if "record_when" in change else 0.0  # other events leave all else as it is
    assert second.work[0] == first.work[-1] and abs(second.energy_error[0] - balance) < 1e-14
    # and what goes on from it has all of it
    third = model.simulate(until=STEP * (LAST + 5), start=second, **{**asked, **change})
    whole = model.simulate(until=STEP * (LAST + 5), start=first, **{**asked, **change})
    np.testing.assert_array_equal(third.q.values, whole.q.values[-len(third.t) :])
    np.testing.assert_array_equal(third.work, whole.work[-len(third.t) :])


def test_events_that_another_version_kept_otherwise_are_looked_for_anew():
    """What is kept of events has another length: everything else is taken up, and those behind are found."""
    model, asked = symgen.load("four-bar"), {"method": "direct-correction", "integrator": "rk4", "step": STEP}
    asked |= {"record_when": ("t > 0.0301", "t > 0.2003")}
    first, whole = (model.simulate(until=until, **asked) for until in (0.05, 0.3))
    last = first.last_state
    arrays = {**last.arrays, "hunt": last.arrays["hunt"][:-7]}
    second = model.simulate(until=0.3, start=replace(last, arrays=arrays), **asked)
    assert second.ok and len(whole.events) == 2
    assert [x.t for x in second.events] == [x.t for x in whole.events if x.t > 0.05]
    np.testing.assert_array_equal(second.q.values, whole.q.values[-len(second.t) :])


def test_integrals_that_are_not_gone_on_with_are_said_to_begin_anew():
    tables = copy.deepcopy(TURNING) | {"outputs": {"swept": "integral(hub.rate)"}}
    model = symgen.load(mechanism_of(tables))
    asked = {"method": "lagrange", "integrator": "rk4", "step": 1e-2}
    first = model.simulate(until=0.5, **asked)
    same, other = (model.simulate(until=1.0, start=first, **(asked | more)) for more in ({}, {"step": 2e-2}))
    assert same["swept"][-1] == pytest.approx(3.0, abs=1e-9) and "integrals" not in same.notes[0]
    assert other["swept"][-1] == pytest.approx(1.5, abs=1e-9)
    assert other.notes[0].endswith("; integrals of outputs begin at 0")


@pytest.mark.parametrize(
    ("coordinates", "name"),
    [*(("absolute", name) for name in ("w", "p", "gauges", "memory")), ("joint", "w"), ("joint", "body_w")],
)
def test_what_another_version_kept_otherwise_is_left_and_said_so(name, coordinates):
    """Arrays of other lengths: the run goes on with coordinates and velocities alone, as from a file of columns."""
    model, asked = symgen.load("four-bar"), {"method": "direct-correction", "integrator": "dopri5"}
    asked["coordinates"] = coordinates
    first, whole = (model.simulate(until=until, **asked) for until in (0.05, 0.1))
    last = first.last_state
    arrays = {**last.arrays, name: last.arrays[name][:-3]}
    second = model.simulate(until=0.1, start=replace(last, arrays=arrays), **asked)
    why = "another version of symgen" if coordinates == "absolute" else "the tree is another one"
    assert second.ok and f"with its coordinates and velocities alone: {why}" in second.notes[0]
    np.testing.assert_allclose(second.q.values[-1], whole.q.values[-1], rtol=0.0, atol=1e-7)


def test_drivers_and_turns_go_on_in_another_making():
    """Time is that of the driver, and an angle stays on its turn."""
    tables = copy.deepcopy(TURNING)
    model = symgen.load(mechanism_of(tables))
    asked = {"method": "lagrange", "integrator": "rk4", "step": 1e-2}
    first = model.simulate(until=3.0, **asked)
    assert first["hub.angle"][-1] == pytest.approx(9.0, abs=1e-7)
    for more in ({}, {"method": "direct-correction"}):
        second = model.simulate(until=4.0, start=first, **(asked | more))
        assert second.ok, second.reason
        np.testing.assert_allclose(second["hub.angle"], 3.0 * second.t, atol=1e-7)


TURNING = {
    "mechanism": {"name": "turning", "space": "spatial"},
    "bodies": {"arm": {"mass": 1.0, "inertia": [0.1, 0.2, 0.25]}},
    "joints": {
        "hub": {"type": "revolute", "between": ["ground", "arm"], "at": [[0, 0, 0], "centre"], "axis": [0, 0, 1]},
        "motor": {"type": "driver", "joint": "hub", "value": "3*t"},
    },
}


def test_ends_and_output_times():
    model = symgen.load("pendulum")
    first = model.simulate(until=0.1, step=1e-2)
    with pytest.raises(InputError, match=r"until: expected an end after t = 0.1 s, where the run goes on, got 0.1"):
        model.simulate(until=0.1, step=1e-2, start=first)
    with pytest.raises(InputError, match=r"output times from 0.1 to 0.2"):
        model.simulate(until=0.2, step=1e-2, start=first, times=[0.05, 0.15])
    found = model.simulate(until=0.2, step=1e-2, start=first, times=[0.15, 0.2])
    np.testing.assert_array_equal(found.t, [0.15, 0.2])
    found = model.simulate(until=0.2, step=1e-2, start=first, output_step=0.04)
    np.testing.assert_array_equal(found.t, [0.1, 0.12, 0.16, 0.2])
    adaptive = model.simulate(until=0.2, integrator="dop853", start=first)
    assert len(adaptive.t) == 11 and adaptive.t[0] == 0.1 and adaptive.t[-1] == 0.2
    with pytest.raises(InputError, match="values by the names of coordinates and velocities"):
        symgen.sweep(model, {"bob.vx": [0.0, 1.0]}, start=first, until=0.2)
    with pytest.raises(InputError, match="or a result"):
        model.simulate(start=3)


def test_an_adaptive_run_goes_on_with_what_it_knows_of_its_steps():
    model, asked = symgen.load("four-bar"), {"integrator": "dop853", "rtol": 1e-9, "atol": 1e-11}
    whole = model.simulate(until=1.0, times=[1.0], **asked)
    first = model.simulate(until=0.5, **asked)
    second = model.simulate(until=1.0, times=[1.0], start=first, **asked)
    assert second.notes[0].endswith("of another run")
    np.testing.assert_allclose(second.q.values, whole.q.values, atol=1e-7)
    checked = model.simulate(until=1.0, start=first, verify=True, **asked)
    assert checked.ok and checked.error_estimate < 1e-6
    chosen = model.simulate(until=1.0, start=first, method="auto", integrator="auto")
    assert chosen.ok and chosen.t[0] == 0.5


def test_a_stopped_run_and_a_failed_one_are_gone_on_from(tmp_path: Path):
    model = symgen.load("four-bar")
    asked = {"integrator": "rk4", "step": 1e-4}

    def stop(t: float) -> None:
        raise KeyboardInterrupt

    stopped = model.simulate(until=400.0, output_step=1.0, progress=stop, **asked)
    assert stopped.interrupted
    until = 1e-4 * (round(stopped.last_state.t / 1e-4) + 20)
    second = model.simulate(until=until, start=stopped, **asked)
    assert second.notes[0].endswith("of another run") and second.steps == 20
    failed = model.simulate(method="lagrange", integrator="euler", step=0.05, until=5.0, max_violation=1e-3)
    assert failed.status == "failed"
    third = model.simulate(until=failed.last_state.t + 0.1, start=failed, **asked)
    assert third.ok and "that run failed" in third.notes[0]


@pytest.mark.slow
@pytest.mark.slow_cases("shapes0")
@pytest.mark.parametrize("shapes", [("straight", "looped"), ("looped", "straight")])
def test_turns_are_known_to_the_other_shape(shapes):
    """Discs on hinges of their own, of which the second is held by a torsion spring: it goes on from where it wound."""
    disc = {"mass": 1.0, "inertia": [0.1, 0.1, 0.2]}
    hinge = {"type": "revolute", "at": [[0.0, 0.0, 0.0], "centre"], "axis": [0.0, 0.0, 1.0]}
    raw = {
        "mechanism": {"name": "wound", "space": "spatial"},
        "bodies": {"first": disc, "second": disc},
        "joints": {name: {**hinge, "between": ["ground", body]} for name, body in (("A", "first"), ("B", "second"))},
        "forces": {"spring": {"type": "torsional-spring-damper", "joint": "B", "stiffness": 3.0}},
    }
    model = symgen.load(mechanism_of(raw))
    before, after = ({"method": "lagrange", "rtol": 1e-9, "shape": shape} for shape in shapes)
    first = model.simulate(until=0.1, start={"B.angle": 9.0, "A.angle": 0.2}, **before)
    second = model.simulate(until=0.2, start=first, **after)
    swing = np.cos(np.sqrt(3.0 / 0.2) * np.array([0.1, 0.2]))
    found = [result.joint_coordinates["B.angle"][-1] for result in (first, second)]
    np.testing.assert_allclose(found, 9.0 * swing, rtol=1e-7)
    np.testing.assert_allclose(second.joint_coordinates["A.angle"], 0.2, rtol=1e-12)

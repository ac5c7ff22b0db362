"""Numbers by an aim, beside closed forms, differences, and runs of the files that were written."""

import json
import pickle
import subprocess
import sys
import time

import numpy as np
import pytest
from analyses.rods import of_raw
from support.rotation import of_turn

import symgen
from study.design.machines import (
    PRESS_BOX,
    PRESS_KEEP,
    best_counterweight,
    compressor,
    coupler_of_pivots,
    four_bar_of_pivots,
    press,
)
from symgen.base.errors import InputError
from symgen.base.settings import Settings
from symgen.study.design.designing import _Designing

AIM = "peak(motor.effort)"
#: A part of the press: the search takes a second.
SMALL = {name: PRESS_BOX[name] for name in ("a", "r")}


@pytest.fixture(scope="module")
def machine():
    return of_raw(press())


# -- closed forms ------------------------------------------------------------------------------------------------------


@pytest.mark.slow
@pytest.mark.parametrize("aim", ["rms(shaking)", "integral(fx**2 + fy**2)"])
def test_a_counterweight_is_that_of_the_closed_form(aim):
    found = of_raw(compressor()).design({"cw": (0.0, 6.0)}, aim)
    assert found.ok
    assert found.values["cw"] == pytest.approx(best_counterweight(), abs=1e-10)


@pytest.mark.slow
def test_the_least_peak_of_a_force_is_found_between_samples():
    # m w^2 times the distance of the masses from the pin: a grid over the counterweight
    machine = of_raw(compressor())
    found = machine.design({"cw": (0.0, 6.0)}, "peak(shaking)")
    grid = np.linspace(found.values["cw"] - 0.01, found.values["cw"] + 0.01, 21)
    times = np.linspace(0.0, found.until, 1441)
    peaks = [machine.kinematics(times, parameters={"cw": float(x)})["shaking"].max() for x in grid]
    assert found.after <= min(peaks) * (1.0 + 1e-7)
    assert peaks[10] == pytest.approx(found.after, rel=1e-9)


@pytest.mark.slow
def test_a_four_bar_is_found_from_positions_of_its_coupler():
    names = ("ax", "ay", "bx", "by", "cx", "cy", "dx", "dy")
    begin = dict(zip(names, (-45.0, 45.0, 65.0, 260.0, 300.0, 500.0, 515.0, -85.0), strict=True))
    answer = dict(zip(names, (0.0, 0.0, 40.0, 200.0, 360.0, 600.0, 400.0, 0.0), strict=True))
    vary = {name: (x - 400.0, x + 400.0) for name, x in begin.items()}
    data = coupler_of_pivots(np.linspace(0.0, 2.0, 41))
    found = of_raw(four_bar_of_pivots()).design(vary, data, parameters=begin)
    assert found.ok and found.runs <= 12
    assert max(abs(found.values[name] - x) for name, x in answer.items()) < 1e-9


@pytest.mark.slow
def test_columns_as_an_aim_have_units_and_gaps_as_data_of_a_fit_have():
    names = ("ax", "ay", "bx", "by", "cx", "cy", "dx", "dy")
    answer = dict(zip(names, (0.0, 0.0, 40.0, 200.0, 360.0, 600.0, 400.0, 0.0), strict=True))
    vary = {name: (x - 400.0, x + 400.0) for name, x in answer.items()}
    data = coupler_of_pivots(np.linspace(0.0, 2.0, 41))
    scaled = {"t": data["t"], "coupler.x [mm]": 1e3 * data["coupler.x"], "coupler.y": data["coupler.y"]}
    scaled["coupler.theta [deg]"] = np.degrees(data["coupler.theta"])
    scaled["coupler.x [mm]"][5:8] = np.nan
    found = of_raw(four_bar_of_pivots()).design(vary, scaled, parameters={name: x + 5.0 for name, x in answer.items()})
    assert found.ok and max(abs(found.values[name] - x) for name, x in answer.items()) < 1e-6
    assert "3 cells of 'coupler.x' without a number left out" in found.notes


@pytest.mark.by_turns(2)
@pytest.mark.slow
def test_a_machine_without_drivers_is_integrated():
    # a mass on a spring from rest at 0.2 m passes the middle with 0.2 sqrt(k/m), and the force is 0.2 k at most
    raw = {
        "mechanism": {"name": "shot", "gravity": [0.0, 0.0]},
        "run": {"until": 2.0},
        "parameters": {"k": 80.0},
        "bodies": {"mass": {"type": "point", "mass": 2.0, "position": [0.2, 0.0], "velocity": [0.0, 0.0]}},
        "forces": {
            "pull": {"type": "force", "body": "mass", "force": ["-k*mass.x", 0.0]},
        },
    }
    model = of_raw(raw)
    found = model.design({"k": (10.0, 200.0)}, "peak(pull.Fx)", "min(mass.vx) <= -1.0", starts=2)
    assert found.ok
    assert found.values["k"] == pytest.approx(2.0 * (1.0 / 0.2) ** 2, rel=1e-5)
    assert found.after == pytest.approx(0.2 * found.values["k"], rel=1e-7)
    assert found.limits[0].active
    # F = m v^2/x: a larger speed by dv costs 2 m v/x dv; checks are a little beside the peaks
    assert found.limits[0].price == pytest.approx(2.0 * 2.0 * 1.0 / 0.2, rel=0.02)


# -- limits ------------------------------------------------------------------------------------------------------------


def excess(result, steepest=0.75):
    """Return the largest part of a limit of the press by which it is exceeded."""
    y, mu = result["ram.y"], result["mu"]
    return max((y.min() + 0.598) / 0.598, (-0.53 - y.max()) / 0.53, np.abs(mu).max() / steepest - 1.0)


@pytest.mark.slow
def test_an_answer_keeps_all_limits_and_the_price_of_one_is_that_of_a_second_search(machine):
    keep = ["min(ram.y) <= -598 mm", "max(ram.y) >= -530 mm"]
    found = machine.design(SMALL | {"b": (0.2, 0.4)}, AIM, keep)
    assert found.ok and found.before > 99.0 and found.after < 60.0
    assert [limit.of_file for limit in found.limits] == [True, False, False]
    assert all(limit.is_met for limit in found.limits)
    fine = machine.kinematics(np.linspace(0.0, 1.0, 1441), parameters=dict(found.values))
    assert excess(fine, 1.0) < 1e-6
    assert np.abs(fine.efforts["motor"]).max() == pytest.approx(found.after, rel=1e-12)
    dear = found.limits[1]
    assert dear.active
    near = machine.design(SMALL | {"b": (0.2, 0.4)}, AIM, ["min(ram.y) <= -597.9 mm", keep[1]])
    assert (found.after - near.after) / 1e-4 == pytest.approx(dear.price, rel=0.05)


@pytest.mark.slow
def test_limits_that_contradict_each_other_are_named(machine):
    # the best is in the middle, 15 mm from either
    found = machine.design(SMALL, AIM, ["ram.y >= -0.58 m", "min(ram.y) <= -0.61 m"])
    assert found.status == "failed"
    assert found.reason.startswith("limits contradict each other: at the best ram.y >= -0.58 m is missed by 0.0")
    assert " and min(ram.y) <= -0.61 m is missed by 0.01" in found.reason
    missed = [abs(limit.after - limit.bound) for limit in found.limits if not limit.is_met]
    assert missed == pytest.approx([0.015, 0.015], rel=0.05)


@pytest.mark.by_turns(6)
@pytest.mark.slow
def test_a_press_needs_less_than_half_of_its_torque(machine, tmp_path):
    found = machine.design(PRESS_BOX, AIM, PRESS_KEEP, starts=8)
    assert found.before > 99.0 and found.after <= 46.5
    assert len(found.starts) == 8 and found.notes[0].endswith("within all limits")
    # every candidate that does not move is counted
    moving = int(found.notes[0].split()[0])
    assert sum(found.failed.values()) >= 896 - moving
    path = found.save(tmp_path / "better.toml")
    result = symgen.load(path).simulate(times=np.linspace(0.0, 1.0, 1441).tolist(), rtol=1e-10, atol=1e-10)
    assert np.abs(result["motor.effort"]).max() == pytest.approx(found.after, rel=1e-5)
    assert excess(result) < 1e-6


@pytest.mark.by_turns(2)
@pytest.mark.slow
def test_an_answer_is_never_worse_than_a_file_within_limits(tmp_path):
    (tmp_path / "shaker.toml").write_text(TEXT)
    model, worse = symgen.load(tmp_path / "shaker.toml"), []
    seeds = of_turn(range(100), 5)
    for seed in seeds:
        rng = np.random.default_rng(seed)
        begin = {"r": rng.uniform(0.02, 0.08), "m": rng.uniform(2.0, 6.0)}
        stroke, turn = 1000.0 * begin["r"] * rng.uniform(0.8, 1.0), rng.uniform(0.0, 5.0)
        keep = [f"max(stroke) >= {stroke!r}", f"m >= {begin['m'] - 0.5!r}"]
        aim = f"peak(motor.effort + {turn!r}*cos(3*crank.theta)*table.x)"
        vary = {"r": (0.02, 0.08), "m": (2.0, 6.0)}
        found = model.design(vary, aim, keep, starts=1 + seed % 2, seed=seed, parameters=begin)
        worse.append(not found.ok or found.after > found.before)
    assert len(worse) == len(seeds) and not any(worse)


@pytest.mark.slow
def test_the_same_seed_gives_the_same_answer(machine):
    first, second, other = (machine.design(SMALL, AIM, "mu <= 0.7", starts=2, seed=seed) for seed in (3, 3, 4))
    assert first.to_json() == second.to_json()
    assert first.starts[1].before != other.starts[1].before


# -- derivatives -------------------------------------------------------------------------------------------------------


def rooms_by_kinematics(machine, times, x, ends):
    """Return the rooms to the limits of the next test, and the effort with both signs, by kinematics alone.

    `ends` are the outputs at which the ram is lowest and highest: another output can be lowest for other numbers.
    """
    k = machine.kinematics(times, parameters=x)
    effort, mu, y = k.efforts["motor"], k["mu"], k["ram.y"]
    force = np.hypot(k["K2.Fx"], k["K2.Fy"])
    parts = [
        (0.8 - mu) / 0.8,
        [(-0.598 - y[ends[0]]) / 0.598, (y[ends[1]] + 0.53) / 0.53],
        (mu + 0.75) / 0.75,
        (0.75 - mu) / 0.75,
        [(40.0 - np.sqrt(np.trapezoid(effort**2, times))) / 40.0],
        1.0 - k["crank.vx"],
        1.0 + k["crank.vx"],
        (1e4 - force) / 1e4,
        (k["coupler.omega"] + 9.0) / 9.0,
        effort / 100.0,
        -effort / 100.0,
    ]
    return np.concatenate(parts)


@pytest.mark.slow
def test_rows_have_the_slopes_of_differences_of_kinematics():
    raw = press()
    raw["forces"]["load"]["force"][1] = "4e4*(-0.58 - ram.y)**2 + spring*(0.0 - ram.y - slack)"  # without a kink
    machine = of_raw(raw)
    keep = [*PRESS_KEEP, "rms(motor.effort) <= 40", "peak(crank.vx) <= 1", "max(K2.F) <= 1e4", "coupler.omega >= -9"]
    asked = _Designing(machine, Settings(), PRESS_BOX, AIM, keep)
    search, varied = asked.search, asked.varied
    u, times = varied.parts(varied.start), search.even
    sampled = search.sampled(u, times, times)
    values = [limit.rooms(sampled) for limit in search.limits]
    values.append(tuple(part / 100.0 for part in search.aim.signed(sampled)))
    own, slopes = (np.concatenate(parts) for parts in zip(*values, strict=True))
    y = machine.kinematics(times)["ram.y"]
    ends = int(y.argmin()), int(y.argmax())

    def beside(u):
        x = dict(zip(varied.names, varied.values(u).tolist(), strict=True))
        return rooms_by_kinematics(machine, times, x, ends)

    assert np.abs(own - beside(u)).max() < 1e-11
    for i in range(len(u)):
        step = 1e-4 * np.eye(len(u))[i]
        near = [beside(u + k * step) for k in (-3, -2, -1, 1, 2, 3)]
        expected = (-near[0] + 9 * near[1] - 45 * near[2] + 45 * near[3] - 9 * near[4] + near[5]) / 0.006
        assert np.abs(slopes[:, i] - expected).max() < 1e-8 * max(1.0, np.abs(expected).max())


@pytest.mark.slow
def test_a_step_costs_less_than_half_of_a_call_of_kinematics(machine):
    """What does not depend on the numbers is prepared once; a step with its slopes costs a fifth of a call."""
    asked = _Designing(machine, Settings(), PRESS_BOX, AIM, PRESS_KEEP)
    search, u, ratios = asked.search, asked.varied.parts(asked.varied.start), []
    for k in range(40):
        values = u + 1e-5 * k
        began = time.thread_time()
        assert search.sampled(values, search.even, search.even) is not None
        between = time.thread_time()
        machine.kinematics(
            search.even, parameters=dict(zip(PRESS_BOX, asked.varied.values(values).tolist(), strict=True))
        )
        ratios.append((between - began) / (time.thread_time() - between))
    assert np.median(ratios) < 0.5


# -- files and commands ------------------------------------------------------------------------------------------------

TEXT = """# a shaker
[mechanism]
name = "shaker"  # its name
gravity = [0.0, 0.0]
[run]
until = 1.0
[parameters]
r = "60 mm"  # throw
m = { value = 3.0, unit = "kg", note = "table" }
[bodies.crank]
mass = 1.0
inertia = 0.01 # the disc
points = { P = ["r", 0.0] }
position = [0.0, 0.0]
[bodies.rod]
mass = 0.5
inertia = 0.004
points = { P = [-0.15, 0.0], Q = [0.15, 0.0] }
position = ["r + 0.15", 0.0]
[bodies.table]
mass = "m"
inertia = 0.01
position = ["r + 0.3", 0.0]
[joints.O]
type = "revolute"
between = ["ground", "crank"]
at = [[0.0, 0.0], "centre"]
[joints.P]
type = "revolute"
between = ["crank", "rod"]
at = ["P", "P"]
[joints.Q]
type = "revolute"
between = ["rod", "table"]
at = ["Q", "centre"]
[joints.rail]
type = "translational"
between = ["ground", "table"]
at = [[0.0, 0.0], "centre"]
axis = [1.0, 0.0]
[joints.motor]
type = "driver"
joint = "O"
coordinate = "angle"
value = "2*pi*t"
[outputs]
stroke = { value = "1000*(table.x - 0.3)", unit = "mm" }
"""


def command(*words, folder):
    """Return a command in a process of its own."""
    return subprocess.run(
        [sys.executable, "-m", "symgen", *words], cwd=folder, capture_output=True, text=True, check=False
    )


@pytest.mark.by_turns(2)
@pytest.mark.slow
def test_the_file_that_is_written_keeps_its_comments_and_gives_the_answer(tmp_path):
    (tmp_path / "shaker.toml").write_text(TEXT)
    varied = ["--vary", "r=20:80", "--vary", "m=2:6"]
    limits = ["--keep", "max(stroke) >= 4.5 cm", "--keep", "m >= 2.5 kg"]
    files = ["-o", "new.toml", "--report", "new.html"]
    done = command("design", "shaker.toml", *varied, "--aim", AIM, *limits, *files, "--json", folder=tmp_path)
    assert done.returncode == 0, done.stderr
    found = json.loads(done.stdout)
    # r in the unit of the file; the stroke is 2 r cos and so on: its largest value is at the start
    assert found["values"]["r"] == pytest.approx(0.045, rel=1e-6)
    assert found["values"]["m"] == pytest.approx(2.5, rel=1e-6)
    text = (tmp_path / "new.toml").read_text()
    before, after = TEXT.splitlines(), text.splitlines()
    changed = [i for i, (a, b) in enumerate(zip(before, after, strict=True)) if a != b]
    assert [before[i].split()[0] for i in changed] == ["r", "m"]
    assert after[changed[0]].endswith('mm"  # throw') and after[changed[1]].endswith('unit = "kg", note = "table" }')
    again = command(
        *("run", "new.toml", "--output-step", "0.0005", "--save", "run.csv", "--rtol", "1e-10"), folder=tmp_path
    )
    assert again.returncode == 0, again.stderr
    lines = (tmp_path / "run.csv").read_text().splitlines()
    column = next(i for i, name in enumerate(lines[0].split(",")) if name.startswith("motor.effort"))
    peak = max(abs(float(line.split(",")[column])) for line in lines[1:])
    assert peak == pytest.approx(found["after"], rel=1e-5)
    page = (tmp_path / "new.html").read_text()
    assert "The motion before" in page and "The motion after" in page and "all 2 limits are kept" in page


@pytest.mark.slow
def test_a_failed_design_writes_no_file_and_says_why(tmp_path):
    (tmp_path / "shaker.toml").write_text(TEXT)
    words = ["--vary", "r=20:80", "--aim", AIM, "--keep", "max(stroke) >= 90 mm", "-o", "new.toml"]
    done = command("design", "shaker.toml", *words, folder=tmp_path)
    assert done.returncode == 1
    assert "no candidate keeps all limits: at the best max(stroke) >= 90 mm is missed by 10 mm" in done.stderr
    assert not (tmp_path / "new.toml").exists()


@pytest.mark.slow
def test_an_interrupted_search_returns_the_best_so_far(machine):
    def stop(done, of):
        if done == 1:
            raise KeyboardInterrupt

    found = machine.design(SMALL, AIM, "mu <= 0.7", starts=3, progress=stop)
    assert found.interrupted and found.status == "interrupted"
    assert found.after < found.before and len(found.starts) == 1


# -- what is said ------------------------------------------------------------------------------------------------------

REFUSED = {
    "a value outside": (
        {"vary": {"a": (0.31, 0.4)}},
        "design: vary 'a': expected bounds that hold the value of the file, 0.3, got 0.31 and 0.4",
    ),
    "bounds turned round": ({"vary": {"a": (0.4, 0.2)}}, "a lower bound below the upper one, got 0.4 and 0.2"),
    "one bound": ({"vary": {"a": (0.4,)}}, "expected a lower and an upper bound, such as (0.2, 0.4)"),
    "nan": ({"vary": {"a": (float("nan"), 1.0)}}, "design: vary 'a': expected a finite number, got nan"),
    "a number of no name": ({"vary": {"sprin": (0.0, 1.0)}}, "did you mean 'spring'?"),
    "nothing varies": ({"vary": {}}, "expected 1 to 200 numbers with bounds, got 0"),
    "a formula": (
        {"vary": {"d": (0.2, 1.0)}},
        "expected a number of its own, got one that follows ex, ey and r; vary ex, ey and r",
    ),
    "an unknown column": ({"aim": "peak(motor.efort)"}, "got 'efort', which 'motor' does not have"),
    "an unknown word": ({"aim": "peek(motor.effort)"}, "did you mean 'peak'?"),
    "a word of sweeps": ({"aim": "mean(mu)"}, "expected peak, rms, max or min of a quantity, got 'mean'"),
    "no text": ({"aim": 3}, "expected a text such as peak(motor.effort), or columns over t, got 3"),
    "an aim that nothing changes": (
        {"vary": {"slack": (0.0, 0.6)}, "aim": "peak(ram.y)"},
        "expected a quantity that a varied number changes, got ram.y, which none does",
    ),
    "columns that nothing changes": (
        {"vary": {"slack": (0.0, 0.6)}, "aim": {"t": [0.0, 0.5], "ram.y": [-0.6, -0.55]}},
        "expected a quantity that a varied number changes, got ram.y, which none does",
    ),
    "another unit": ({"keep": "min(ram.y) <= 3 kg"}, "expected m, the unit of ram.y, got 'kg'"),
    "an equation": ({"keep": "min(ram.y) = 3"}, "a number that is to be met has two limits"),
    "no comparison": ({"keep": "ram.y"}, "expected a quantity and a number, such as min(ram.y) <= -0.6 m"),
    "no start": ({"starts": 0}, "design: starts: expected a whole number from 1 to 10000, got 0"),
    "many starts": ({"starts": 10_001}, "expected a whole number from 1 to 10000, got 10001"),
    "columns without times": ({"aim": {"ram.y": [1.0]}}, "a column 't' of times"),
    "a setting of outputs": ({"output_step": 0.1}, "design: output_step: expected one of "),
}


@pytest.mark.slow_cases("an aim that nothing changes")
@pytest.mark.parametrize("what", REFUSED)
def test_bad_input_has_one_sentence(machine, what):
    arguments, sentence = REFUSED[what]
    with pytest.raises(InputError) as error:
        machine.design(**({"vary": {"a": (0.2, 0.4)}, "aim": AIM} | arguments))
    assert sentence in str(error.value)
    assert "\n" not in str(error.value)


def test_a_model_without_its_file_is_refused_before_the_search(machine):
    copied = symgen.Model(pickle.loads(pickle.dumps(machine.mechanism)))
    with pytest.raises(InputError, match="expected a model whose file is at hand, got one without; load the file"):
        copied.design(SMALL, AIM)


@pytest.mark.slow
def test_a_file_that_does_not_move_is_refused_with_the_number_of_those_that_do(machine):
    with pytest.raises(InputError) as error:
        machine.design({"r": (0.04, 0.4)}, AIM, parameters={"r": 0.39})
    text = str(error.value)
    assert text.startswith("design: vary: expected values in the file with which the machine moves, got dead centre at")
    assert "candidates within the bounds move" in text and not text.endswith(" 0 of 128 candidates")


@pytest.mark.slow
def test_remarks_say_how_an_aim_was_met(machine):
    found = machine.design({"ey": (-0.4, -0.2), "b": (0.25, 0.4)}, "max(motor.effort)", until=0.4)
    text = "; ".join(found.notes)
    assert "motor makes 0.4 turns until 0.4 s: loads of the rest of a turn do not count" in text
    low = machine.design({"b": (0.2, 0.4), "ey": (-0.4, -0.2)}, AIM, "ram.y >= -0.575")
    assert "the motion no longer passes a kink of the file, where -0.58 - ram.y = 0" in "; ".join(low.notes)


@pytest.mark.slow
def test_a_point_that_moves_alone_is_noted_and_signs_are_compared(tmp_path):
    (tmp_path / "shaker.toml").write_text(TEXT)
    model = symgen.load(tmp_path / "shaker.toml")
    found = model.design({"bodies.rod.points.Q[0]": (0.1, 0.2)}, "max(motor.effort)")
    text = "; ".join(found.notes)
    assert "bodies.rod.points.Q[0] moves a point alone: mass, inertia and position of the body stay" in text
    assert "[0.1" in found.text or "[0.2" in found.text

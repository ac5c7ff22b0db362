"""Places of pins that vary, beside machines whose pins are parameters by hand, closed forms, and differences."""

import json
import math
from contextlib import suppress

import numpy as np
import pytest
from analyses.rods import of_raw

import symgen
from study.design.machines import compressor, coupler_of_pivots, four_bar_of_pivots, pin
from study.design.test_design import command
from symgen.api import load
from symgen.base.errors import InputError
from symgen.base.settings import Settings
from symgen.describe.facts.pins import lift_pins, pins_that_vary
from symgen.study.design.designing import _Designing

AIM = "peak(motor.effort)"
PLACES = {"A": (0.0, 0.0), "B": (40.0, 200.0), "C": (360.0, 600.0), "D": (400.0, 0.0)}
BARS = {"crank": "AB", "coupler": "BC", "rocker": "DC"}
#: Frames of the bars: any will do.
FRAMES = {"crank": (0.0, 0.0, 0.0), "coupler": (150.0, -20.0, 0.7), "rocker": (400.0, 0.0, -2.5)}


def four_bar_of_numbers(places=PLACES):
    """Return the four-bar of pivots with numbers alone: each bar in a frame of its own, its mass in the middle."""
    raw = four_bar_of_pivots()
    raw["mechanism"] = {"name": "four-numbers", "gravity": [0.0, -9.81]}
    del raw["parameters"]
    for name, pins in BARS.items():
        x, y, angle = FRAMES[name]
        c, s = math.cos(angle), math.sin(angle)
        away = [(places[p][0] - x, places[p][1] - y) for p in pins]
        points = [[c * dx + s * dy, c * dy - s * dx] for dx, dy in away]
        raw["bodies"][name] = {
            "mass": 1.0,
            "inertia": 1e4,
            "centre_of_mass": [(a + b) / 2.0 for a, b in zip(*points, strict=True)],
            "points": dict(zip(("near", "far"), points, strict=True)),
            "position": [x, y],
            "angle": angle,
        }
    for joint in "AD":
        raw["joints"][joint]["at"][0] = list(places[joint])
    raw["joints"]["motor"]["value"] = "2*pi*t"
    return raw


def by_hand():
    raw = four_bar_of_pivots()
    raw["mechanism"]["gravity"] = [0.0, -9.81]
    return raw


def parameters_of(values):
    """Return places by the names of the machine whose pins are parameters."""
    return {name.replace(".", "").lower(): x for name, x in values.items()}


def box(names, half):
    at = {f"{joint}.{axis}": x for joint, place in PLACES.items() for axis, x in zip("xy", place, strict=True)}
    return {name: (at[name] - half, at[name] + half) for name in names}


@pytest.mark.slow
def test_a_ground_pin_and_a_coupler_pin_give_the_answer_of_parameters_by_hand():
    vary = box(("D.x", "D.y", "C.x", "C.y"), 30.0)
    keep = "max(coupler.y) <= 430"
    found = of_raw(four_bar_of_numbers()).design(vary, AIM, keep)
    beside = of_raw(by_hand()).design(parameters_of(vary), AIM, keep)
    assert found.ok and found.after < 0.99 * found.before
    assert found.before == pytest.approx(beside.before, rel=1e-10)
    assert found.after == pytest.approx(beside.after, rel=1e-8)
    for name, x in parameters_of(found.values).items():
        assert x == pytest.approx(beside.values[name], abs=1e-4)
    # the file that is written is the machine by hand with these values
    times = np.linspace(0.0, 2.0, 41)
    hand = of_raw(by_hand()).kinematics(times, parameters=parameters_of(found.values))
    own = found.model.kinematics(times)
    for name in ("coupler.x", "coupler.y", "motor.effort", "C.Fx"):
        assert np.abs(own[name] - hand[name]).max() < 1e-9 * np.abs(hand[name]).max()
    assert "centres of mass of rocker and coupler in the middle of them: mass and inertia stay" in found.notes[-1]


@pytest.mark.slow
def test_all_pins_are_found_from_positions_of_a_coupler():
    begin = {"A": (-45.0, 45.0), "B": (65.0, 260.0), "C": (300.0, 500.0), "D": (515.0, -85.0)}
    vary = {f"{p}.{a}": (x - 400.0, x + 400.0) for p, at in begin.items() for a, x in zip("xy", at, strict=True)}
    data = coupler_of_pivots(np.linspace(0.0, 2.0, 41))
    del data["coupler.theta"]  # of a bar, not of a frame
    found = of_raw(four_bar_of_numbers(begin)).design(vary, data)
    assert found.ok and found.after < 1e-9
    x, y = data["coupler.x"], data["coupler.y"]
    motion = found.model.kinematics(data["t"])
    assert max(np.abs(motion["coupler.x"] - x).max(), np.abs(motion["coupler.y"] - y).max()) < 1e-8


@pytest.mark.slow
def test_a_weighted_arm_is_balanced_where_its_pivot_is_at_the_centre_of_mass():
    weight, arm = (3.0, (-0.5, 0.05)), (12.0, (1.4, 0.2))
    total = weight[0] + arm[0]
    centre = [(weight[0] * a + arm[0] * b) / total for a, b in zip(weight[1], arm[1], strict=True)]
    raw = {
        "mechanism": {"name": "barrier", "gravity": [0.0, -9.81]},
        "run": {"until": 2.0},
        "bodies": {
            "arm": {"mass": 12.0, "inertia": 9.0, "centre_of_mass": [0.2, -1.4], "angle": math.pi / 2},
            "weight": {"mass": 3.0, "inertia": 0.1, "position": [-0.5, 0.05], "angle": math.pi / 2},
        },
        "joints": {
            "A": pin("ground", "arm", [["800 mm", 0.1], [0.1, "-80 cm"]]),
            "weld": {"type": "rigid", "between": ["arm", "weight"], "at": [[0.0, 0.0], [-0.05, -0.5]]},
            "motor": {"type": "driver", "joint": "A", "value": "pi/2 + pi*t"},
        },
    }
    found = of_raw(raw).design({"A.x": (0.5, 2.0), "A.y": (-0.3, 0.5)}, "rms(motor.effort)")
    assert found.before > 20.0
    assert [found.values["A.x"], found.values["A.y"]] == pytest.approx(centre, abs=1e-10)
    assert '"1020 mm"' in found.text or f'"{1000.0 * found.values["A.x"]!r} mm"' in found.text
    assert found.notes[-1] == "A.x and A.y move points of arm: mass and inertia stay"


# -- derivatives -------------------------------------------------------------------------------------------------------


def differences(f, x, step):
    """Return derivatives by differences of order 6."""
    columns = []
    for e in np.eye(len(x)) * step:
        near = [f(x + k * e) for k in (-3, -2, -1, 1, 2, 3)]
        columns.append((-near[0] + 9 * near[1] - 45 * near[2] + 45 * near[3] - 9 * near[4] + near[5]) / (60.0 * step))
    return np.stack(columns, axis=-1)


@pytest.mark.slow
def test_driven_motions_have_the_slopes_of_differences_of_parameters_by_hand():
    vary = box([f"{p}.{a}" for p in "ABCD" for a in "xy"], 30.0)
    keep = ["coupler.y <= 1e4", "rocker.omega <= 1e4", "C.Fx <= 1e4"]
    asked = _Designing(of_raw(four_bar_of_numbers()), Settings(), vary, AIM, keep)
    varied, times, machine = asked.varied, np.linspace(0.0, 2.0, 25), of_raw(by_hand())
    _, slopes = asked.search.motions.at(varied.start, times)
    columns = [q.text for q in asked.reader.quantities][:4]
    assert columns == ["motor.effort", "coupler.y", "rocker.omega", "C.Fx"]

    def beside(x):
        motion = machine.kinematics(times, parameters=parameters_of(dict(zip(varied.names, x.tolist(), strict=True))))
        return np.stack([motion[name] for name in columns], axis=1)

    expected = differences(beside, varied.start, 1.0)
    size = np.abs(expected).max(axis=(0, 2), keepdims=True)
    assert np.abs((slopes[:, :4] - expected) / size).max() < 1e-8


@pytest.mark.by_turns(2)
@pytest.mark.slow
def test_free_motions_have_the_slopes_of_differences_of_parameters_by_hand():
    raw, beside_raw = four_bar_of_numbers(), by_hand()
    for each in (raw, beside_raw):
        del each["joints"]["motor"]
        each["run"]["until"] = 3.0
    settings = Settings(rtol=1e-12, atol=1e-12)
    vary = box(("A.x", "B.y", "C.x", "D.y"), 30.0)
    asked = _Designing(of_raw(raw), settings, vary, "max(coupler.y)", ["rocker.vx <= 1e5"])
    varied, times, machine = asked.varied, np.linspace(0.0, 3.0, 13), of_raw(beside_raw)
    _, slopes = asked.search.motions.at(varied.start, times)

    def beside(x):
        values = parameters_of(dict(zip(varied.names, x.tolist(), strict=True)))
        run = machine.simulate(times=times.tolist(), parameters=values, rtol=1e-12, atol=1e-12)
        return np.stack([run["coupler.y"], run["rocker.vx"]], axis=1)

    expected = differences(beside, varied.start, 1.0)
    size = np.abs(expected).max(axis=(0, 2), keepdims=True)
    assert np.abs((slopes[:, :2] - expected) / size).max() < 1e-8


def arm_in_one_frame(x, y):
    """Return a driven arm with its frame at the origin: the place of its pin is the only number that follows it."""
    return {
        "mechanism": {"name": "arm", "gravity": [0.0, -9.81]},
        "run": {"until": 2.0},
        "bodies": {"arm": {"mass": 12.0, "inertia": 9.0, "centre_of_mass": [1.4, 0.2]}},
        "joints": {
            "A": pin("ground", "arm", [[x, y], [x, y]]),
            "motor": {"type": "driver", "joint": "A", "value": "pi*t"},
        },
    }


@pytest.mark.by_turns(3)
@pytest.mark.slow
def test_an_answer_is_never_worse_than_a_file_within_limits():
    worse, better = [], 0
    for seed in range(100):
        rng = np.random.default_rng(seed)
        x, y = rng.uniform(0.2, 1.0), rng.uniform(-0.5, 0.5)
        distance = math.hypot(1.4 - x, 0.2 - y)
        # the largest force on the pin: weight and the force towards it
        limit = f"peak(A.F) <= {12.0 * (9.81 + math.pi**2 * distance) + rng.uniform(0.001, 20.0)!r}"
        aim = f"peak(motor.effort + {rng.uniform(0.0, 40.0)!r}*cos(3*arm.theta)*arm.x)"
        vary = {"A.x": (x - 0.3, x + rng.uniform(0.1, 0.5)), "A.y": (y - rng.uniform(0.1, 0.5), y + 0.3)}
        found = of_raw(arm_in_one_frame(x, y)).design(vary, aim, limit, seed=seed)
        worse.append(not found.ok or found.after > found.before)
        better += found.after < 0.9 * found.before
    assert len(worse) == 100 and not any(worse) and better > 50


# -- files and commands ------------------------------------------------------------------------------------------------

TEXT = """# a four-bar
[mechanism]
name = "bars"
gravity = [0.0, -9.81]
[run]
until = 1.0
[bodies.crank]
mass = 1.0
inertia = 0.01
points = { A = [0.0, 0.0], B = [0.2, 0.0] } # two
[bodies.coupler]
mass = 2.0
inertia = 0.05
points = { B = [0.2, 0.0], C = ["60 cm", 0.35] } # as it stands
[bodies.rocker]
mass = 1.5
inertia = 0.03
centre_of_mass = [0.0, 0.175]
points = { C = [0.0, 0.35], D = [0.0, 0.0] }
position = [0.6, 0.0] # D
[joints.A]
type = "revolute"
between = ["ground", "crank"]
at = [[0.0, 0.0], "A"] # the motor's
[joints.B]
type = "revolute"
between = ["crank", "coupler"]
at = ["B", "B"]
[joints.C]
type = "revolute"
between = ["coupler", "rocker"]
at = ["C", "C"]
[joints.D]
type = "revolute"
between = ["ground", "rocker"]
at = [[0.6, 0.0], "D"] # foot
[joints.motor]
type = "driver"
joint = "A"
value = "2*pi*t"
"""


@pytest.mark.by_turns(2)
@pytest.mark.slow
def test_the_file_that_is_written_keeps_its_comments_and_gives_the_answer(tmp_path):
    (tmp_path / "bars.toml").write_text(TEXT)
    words = ["--vary", "D.x=550 mm:650 mm", "--vary", "C.y=0.3:0.4", "--aim", AIM, "-o", "new.toml", "--json"]
    done = command("design", "bars.toml", *words, folder=tmp_path)
    assert done.returncode == 0, done.stderr
    found = json.loads(done.stdout)
    assert found["bounds"]["D.x"] == [0.55, 0.65] and found["units"]["D.x"] == "m"
    before, after = TEXT.splitlines(), (tmp_path / "new.toml").read_text().splitlines()
    changed = [a for a, b in zip(before, after, strict=True) if a != b]
    new = [b for a, b in zip(before, after, strict=True) if a != b]
    assert [line.split()[0] for line in changed] == ["points", "centre_of_mass", "points", "at"]
    x, y = found["values"]["D.x"], found["values"]["C.y"]
    assert new[0] == f'points = {{ B = [0.2, 0.0], C = ["60 cm", {y!r}] }} # as it stands'
    assert new[3] == f'at = [[{x!r}, 0.0], "D"] # foot'
    again = command("check", "new.toml", folder=tmp_path)
    assert again.returncode == 0 and "moved" not in again.stdout + again.stderr
    run = symgen.load(tmp_path / "new.toml").simulate(times=np.linspace(0.0, 1.0, 1441).tolist(), rtol=1e-10)
    assert np.abs(run["motor.effort"]).max() == pytest.approx(found["after"], rel=1e-6)
    words = ["--until", "1", "--rtol", "1e-10", "--output-step", repr(1.0 / 1440), "--save", "run.csv"]
    done = command("run", "new.toml", *words, folder=tmp_path)
    assert done.returncode == 0, done.stderr
    effort = np.genfromtxt(tmp_path / "run.csv", delimiter=",", names=True, deletechars="")["motor.effort"]
    assert len(effort) == 1441 and np.abs(effort).max() == pytest.approx(found["after"], rel=1e-6)
    done = command("design", "bars.toml", "--vary", "D.x=1 kg:2 kg", "--aim", AIM, "-o", "x.toml", folder=tmp_path)
    assert done.returncode == 2 and "--vary D.x" in done.stderr and not (tmp_path / "x.toml").exists()


def with_changes(*pairs):
    text = TEXT
    for old, new in pairs:
        assert old in text
        text = text.replace(old, new)
    return text


R = ("[bodies.crank]", "[parameters]\nr = 0.2\n[bodies.crank]"), ("B = [0.2, 0.0] } # two", 'B = ["r", 0.0] } # two')
GUIDE = ("[joints.motor]", '[joints.rail]\ntype = "pin-in-slot"\nbetween = ["coupler", "ground"]\n')
WEIGHT = "[joints.motor]", '[bodies.bob]\ntype = "point"\nmass = 1.0\nposition = [0.6, 0.35]\n[joints.hub]\n'
REFUSED = {
    "a formula": (with_changes(*R), {"B.x": (0.1, 0.3)}, "got bodies.crank.points.B[0], which is 'r'; take the param"),
    "an origin": (
        with_changes(('at = [[0.0, 0.0], "A"]', 'at = [[0.0, 0.0], "origin"]')),
        {"A.x": (-0.1, 0.1)},
        "expected a pin whose points are numbers in the file, got 'origin' of 'crank' at joint 'A'; "
        "write its coordinates in the frame of crank",
    ),
    "a mass at it": (
        with_changes(
            (WEIGHT[0], f'{WEIGHT[1]}type = "revolute"\nbetween = ["rocker", "bob"]\nat = ["C", "centre"]\n{WEIGHT[0]}')
        ),
        {"C.x": (0.5, 0.7)},
        "got 'centre' of 'bob' at joint 'hub'",
    ),
    "no pin": (
        TEXT,
        {"motor.x": (0.0, 1.0)},
        "expected a pin, which is a revolute or rigid joint, got one of type driver",
    ),
    "no joint": (TEXT, {"E.x": (0.0, 1.0)}, "or the path of a number such as bodies.crank.mass"),
    "a value outside": (TEXT, {"D.x": (0.7, 0.8)}, "expected bounds that hold the value of the file, 0.6, got 0.7"),
    "a point of it": (
        TEXT,
        {"D.x": (0.5, 0.7), "bodies.rocker.points.D[0]": (-0.1, 0.1)},
        "design: vary 'bodies.rocker.points.D[0]': expected a number that no pin moves, got one that follows a pin",
    ),
    "a length that moves it": (
        with_changes(*R, ('C = ["60 cm", 0.35]', "C = [0.6, 0.35]")),
        {"C.x": (0.5, 0.7), "r": (0.1, 0.3)},
        "design: vary 'C.x': expected a pin that other numbers leave in its place, got 'r', which moves the bodies",
    ),
    "another joint that holds it": (
        with_changes(
            (GUIDE[0], f'{GUIDE[1]}at = ["C", [0.6, 0.0]]\naxis = [0.0, 1.0]\n{GUIDE[0]}'),
            ("[joints.motor]", "[forces.motor]"),
        ).replace(
            'type = "driver"\njoint = "A"\nvalue = "2*pi*t"\n', 'type = "force"\nbody = "crank"\nforce = [0.0, 1.0]\n'
        ),
        {"C.x": (0.5, 0.7)},
        "design: vary 'C.x': expected",
    ),
    "a machine that does not close": (
        with_changes(("D = [0.0, 0.0]", "D = [0.0, -5.0]")),
        {"D.x": (0.5, 0.7)},
        "expected a file whose machine closes at the start",
    ),
}


@pytest.mark.parametrize("what", REFUSED)
def test_a_pin_that_cannot_be_moved_is_refused_in_one_sentence(what, tmp_path):
    text, vary, sentence = REFUSED[what]
    (tmp_path / "bars.toml").write_text(text)
    with pytest.raises(InputError) as error:
        symgen.load(tmp_path / "bars.toml").design(vary, "peak(crank.omega)")
    assert sentence in str(error.value)
    assert "\n" not in str(error.value)


def test_one_pin_has_one_name(tmp_path):
    raw = compressor()
    raw["bodies"]["rod"]["points"]["P"] = [-0.2, 0.0]
    with pytest.raises(InputError, match=r"got bodies\.crank\.points\.P\[0\], which is '0\.12 - xg'"):
        of_raw(raw).design({"P.x": (0.1, 0.14)}, "rms(shaking)")
    raw = four_bar_of_numbers()
    raw["bodies"]["disc"] = {"mass": 1.0, "inertia": 1.0, "position": [360.0, 600.0]}
    raw["joints"]["hub"] = pin("coupler", "disc", ["far", [0.0, 0.0]])
    with pytest.raises(InputError, match=r"a second name of the place 'C\.x': both joints are one pin"):
        of_raw(raw).design({"C.x": (350.0, 370.0), "hub.x": (350.0, 370.0)}, AIM)


@pytest.mark.parametrize("name", ["four-bar", "slider-crank", "klann-leg", "engine", "bricard", "pendulum"])
def test_pins_that_are_listed_are_those_that_become_parameters(name: str) -> None:
    mechanism = load(name).mechanism
    q = [float(x) for x in load(name).initial_state(load(name).parameters())[0]]
    taken = set[str]()
    for joint in mechanism.joints:
        with suppress(InputError):
            lift_pins("design", mechanism, [f"{joint.name}.x"], q, {})
            taken.add(joint.name)
    listed = pins_that_vary(mechanism)
    assert set(listed) <= taken and bool(listed) == bool(taken)
    for joint in taken - set(listed):  # further joints of a pin that is listed
        with pytest.raises(InputError, match="each place once"):
            lift_pins("design", mechanism, [*(f"{pin}.x" for pin in listed), f"{joint}.x"], q, {})


def test_who_cannot_vary_a_pin_says_who_can() -> None:
    hint = "symgen design alone varies the places of pins"
    with pytest.raises(InputError, match=hint):
        load("four-bar").kinematics(parameters={"A.x": 0.1})
    with pytest.raises(InputError, match=hint):
        load("four-bar").simulate(until=0.1, sensitivities=["A.x"])
    with pytest.raises(InputError, match="known: coupler_mass"):
        load("four-bar").simulate(until=0.1, parameters={"A.z": 0.1})

"""Pages as files: what they hold, how large they are, that they ask nobody; what they do is seen in a browser."""

import base64
import json
import os
import re
import shutil
import subprocess
import sys
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from PIL import Image
from support import processes

from symgen.analyses.linear.animation import mode_recording
from symgen.api import load
from symgen.base.errors import InputError
from symgen.cli import main
from symgen.describe.files.validate import validate
from symgen.result.player import live
from symgen.result.player.moving import write_film
from symgen.result.player.recording import PlottedGroup, Recording, encode_shorts, is_coarse, pack_recording
from symgen.result.viewed import playable_motion, view_file


@pytest.fixture(scope="module")
def result() -> Any:
    return load("slider-crank").simulate(until=0.5)


def data_of(html: str) -> Any:
    return json.loads(re.search(r'<script type="application/json" id="data">(.*?)</script>', html, re.S)[1])  # type: ignore[index]


def test_a_page_holds_the_motion_and_asks_nobody(result: Any) -> None:
    page = result.view()
    assert page.live and len(page.html.encode()) <= 200_000
    assert "default-src 'none'" in page.html and page.html.count("<!DOCTYPE html>") == 1
    assert not re.search(r"https?://(?!www\.w3\.org)", page.html)
    assert not re.search(r"<(link|img|script|iframe)[^>]*(src|href)=(?!\"data:)", page.html)
    data = data_of(page.html)
    assert data["names"] == list(result.q.names)
    motion = data["motions"][0]
    columns = np.frombuffer(base64.b64decode(motion["q"]), "<f4").reshape(len(data["names"]), motion["count"])
    times = np.frombuffer(base64.b64decode(motion["t"]), "<f4")
    for k, time in enumerate(times):
        row = int(np.argmin(np.abs(result.t - time)))
        assert columns[:, k] == pytest.approx(result.q.values[row], rel=1e-7, abs=1e-7)


def test_the_same_run_gives_the_same_bytes(result: Any) -> None:
    again = load("slider-crank").simulate(until=0.5, shape="straight")
    assert again.view().html == result.view().html


def test_sixteen_bits_between_the_smallest_and_the_largest() -> None:
    values = np.array([[1.0, 5.0], [2.0, 5.0], [4.0, np.nan]])
    found = encode_shorts(values)
    numbers = np.frombuffer(base64.b64decode(found["data"]), "<u2").reshape(2, 3)
    assert found["low"] == [1.0, 5.0] and list(numbers[1]) == [0, 0, 65535]
    back = found["low"][0] + numbers[0] / 65534.0 * found["span"][0]
    assert back == pytest.approx([1.0, 2.0, 4.0], abs=3.0 / 65534.0)


@pytest.mark.slow
def test_large_equations_stay_outside_and_the_page_says_so(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(live, "MOST", {False: 100, True: 100})  # besides the springs of a hand
    page = load("slider-crank").simulate(until=0.01, step=1e-3).view()
    assert page.live and "const indexTables = " in page.html  # too much straight code is printed as loops
    monkeypatch.setattr(live, "MOST_LOOPED", 100)
    page = load("slider-crank").simulate(until=0.01, step=1e-3).view()
    assert not page.live and "characters are more than the 100" in data_of(page.html)["note"]
    assert "function rhs(" not in page.html


@pytest.mark.slow
def test_without_compiled_code_a_page_has_no_live_part_and_says_so() -> None:
    script = "import symgen; print(symgen.load('pendulum').simulate(until=0.01).view().html)"
    found = processes.python(script, env=os.environ | {"NUMBA_DISABLE_JIT": "1"})
    assert found.returncode == 0 and "NUMBA_DISABLE_JIT" in found.stdout, found.stderr


def test_two_motions_of_one_mechanism(result: Any) -> None:
    other = load("slider-crank").simulate(until=0.5, parameters={"crank_mass": 2.0})
    assert len(data_of(result.view(other).html)["motions"]) == 2
    for another in ("pendulum", "four-bar"):  # which has as many coordinates
        with pytest.raises(InputError, match="another motion of slider-crank"):
            result.view(load(another).simulate(until=0.1, step=1e-2))


def test_notebooks_show_a_page_in_a_frame(result: Any) -> None:
    page = result.view(live=False)
    assert not page.live and page._repr_html_().startswith("<iframe srcdoc=") and "<script" not in page._repr_html_()
    assert len(repr(page)) < 100


@pytest.mark.slow
def test_view_of_a_model_and_of_a_file(tmp_path: Path, capsys: pytest.CaptureFixture[str], result: Any) -> None:
    file = tmp_path / "a.nc"
    result.save(file)
    assert main(["view", str(file), "-o", str(tmp_path / "a.html"), "--beside", str(file), "--json"]) == 0
    told = json.loads(capsys.readouterr().out)
    assert told["live"] is True and told["bytes"] == (tmp_path / "a.html").stat().st_size
    data = data_of((tmp_path / "a.html").read_text())
    assert (
        len(data["motions"]) == 2
        and data["motions"][0]["reactions"]["names"] == data["motions"][1]["reactions"]["names"]
    )
    assert main(["view", "pendulum", "--until", "0.2", "-o", str(tmp_path / "b.html")]) == 0
    assert data_of((tmp_path / "b.html").read_text())["live"] is not None


@pytest.mark.slow_cases("ggl-direct-correction-gains1")
@pytest.mark.parametrize(
    ("method", "live", "gains"),
    [("baumgarte", "baumgarte", ["method.alpha", "method.beta"]), ("ggl", "direct-correction", [])],
)
def test_the_live_method_of_a_command_is_the_one_that_it_names(
    tmp_path: Path, method: str, live: str, gains: list[str]
) -> None:
    """Where pages can run it; a page of an implicit method keeps the usual one."""
    page = tmp_path / "a.html"
    assert main(["view", "pendulum", "--until", "0.1", "--method", method, "-o", str(page)]) == 0
    found = data_of(page.read_text())["live"]
    assert found["method"] == live
    assert [p["name"] for p in found["parameters"] if "." in p["name"]] == gains


def test_a_page_runs_no_method_that_its_scheme_does_not_solve(result: Any) -> None:
    with pytest.raises(InputError, match="live: expected a method that 'rk4' solves, as pages run no other scheme"):
        result.view(live="ggl")


@pytest.mark.slow
def test_the_live_part_of_a_file_is_that_of_its_run(tmp_path: Path, result: Any) -> None:
    mechanism = load("slider-crank").mechanism
    result.save(tmp_path / "a.nc")
    live = data_of(view_file("view", tmp_path / "a.nc", mechanism).html)["live"]
    assert live == data_of(result.view().html)["live"]
    other = load("slider-crank").simulate(until=0.1, parameters={"crank_mass": 2.0}, start={"crank.theta": 1.0})
    other.save(tmp_path / "b.nc")
    of_file, of_result = view_file("view", tmp_path / "b.nc", mechanism), other.view()
    assert data_of(of_file.html)["live"] == data_of(of_result.html)["live"] != live
    # begun elsewhere than described: there the page begins too
    begun = [*other.start["q"].values(), *other.start["v"].values()]
    assert other.start["q"]["crank.theta"] == 1.0
    for page in (of_file, of_result):
        assert data_of(page.html)["live"]["y0"][: len(begun)] == begun and "q[0] =" not in page.html
    assert "q[0] =" in result.view().html


@pytest.mark.by_turns(2)
@pytest.mark.slow
def test_the_live_part_has_the_inputs_of_its_run(tmp_path: Path) -> None:
    pushed = {
        "mechanism": {"name": "pushed"},
        "inputs": {"push": 0.0},
        "bodies": {"a": {"type": "point", "mass": 2.0}},
        "forces": {"f": {"type": "force", "body": "a", "at": "centre", "force": ["push", 0.0]}},
    }
    model = load(validate(pushed, "test"))

    def page(push: Any) -> Any:
        return model.simulate(until=0.1, step=0.05, integrator="rk4", shape="straight", inputs={"push": push})

    run = page(5.0)
    run.save(tmp_path / "a.nc")
    lives = [data_of(p.html)["live"] for p in (run.view(), view_file("view", tmp_path / "a.nc", model.mechanism))]
    assert [[p["value"] for p in live["parameters"]] for live in lives] == [[5.0], [5.0]]
    assert [live["p0"][0] for live in lives] == [5.0, 5.0]
    # a formula is part of the code, and its input has no slider; what jumps is not
    (smooth,) = data_of(page("3*sin(t)").view().html)["live"]["parameters"]
    assert smooth["still"] is True and "sine(t)" in page("3*sin(t)").view().html
    page("3*sin(t)").save(tmp_path / "b.nc")
    of_file = view_file("view", tmp_path / "b.nc", model.mechanism)
    assert data_of(of_file.html)["live"]["parameters"] == [smooth] and "sine(t)" in of_file.html
    for jumping, why in (
        ("3 if t < 0.05 else 5", "gave its inputs jumps"),
        ({"t": [0.0, 0.05], "u": [1.0, 2.0], "interpolation": "hold"}, "gave its inputs over time is not in the file"),
    ):
        run = page(jumping)
        found = run.view()
        assert not found.live and "gave its inputs jumps" in data_of(found.html)["note"]
        run.save(tmp_path / "c.nc")
        found = view_file("view", tmp_path / "c.nc", model.mechanism)
        assert not found.live and why in data_of(found.html)["note"]


@pytest.mark.by_turns(6)
@pytest.mark.slow
@pytest.mark.parametrize(
    ("event", "does"),
    [
        ({"when": "a.y < -0.01", "reset": {"a.vy": "-a.vy"}}, "changes the state"),
        ({"when": "a.y < -9.0", "action": "stop"}, "ends runs"),
        ({"when": "a.y < -0.01"}, None),
    ],
)
@pytest.mark.parametrize("asked", [False, pytest.param(True, marks=pytest.mark.slow)])
def test_the_live_part_looks_for_events_of_the_mechanism_alone(
    event: dict[str, Any], does: str | None, asked: bool, tmp_path: Path
) -> None:
    raw = {
        "mechanism": {"name": "ball", "gravity": [0.0, -9.81]},
        "bodies": {"a": {"type": "point", "mass": 2.0}},
    }
    where = {"events": {"floor": event}}
    model, settings = load(validate(raw if asked else raw | where, "test")), where if asked else {}
    run = model.simulate(until=0.1, step=0.01, integrator="rk4", shape="straight", **settings)
    run.save(tmp_path / "run.nc")
    for found in (run.view(), view_file("view", tmp_path / "run.nc", model.mechanism)):
        own = does is None or not asked  # pages find the events of the mechanism itself
        assert found.live == own
        assert own or f"the event 'floor' {does}" in data_of(found.html)["note"]
    action = {"changes the state": "reset", "ends runs": "stop", None: "record"}[does]
    assert run.to_json()["watched"] == [{"name": "floor", "action": action}]


def test_a_step_of_a_page_makes_no_objects_and_memory_is_one_literal() -> None:
    """Views are new objects, and V8 keeps an object in a dictionary once its members are added one by one."""
    html = load("slider-crank").simulate(until=0.05, method="direct-correction").view().html
    texts = {
        text.split("(")[0]: text for text in re.split(r"^function |^const (?=newMemory)", html, flags=re.MULTILINE)
    }
    reached, waiting = dict[str, str](), ["take_steps"]
    while waiting:
        name = waiting.pop()
        reached[name] = texts[name]
        waiting += {n for n in re.findall(r"\b(\w+)\(", texts[name]) if n in texts and n not in reached}
    assert {"take_step", "set_rates", "rhs", "accept"} <= set(reached)
    assert not [name for name, text in reached.items() if re.search(r"\bpart\(|\bnew\b|\.(slice|subarray)\(", text)]
    (members,) = re.findall(r"const newMemory = \(p, w, iw\) => \(\{ p, w, iw, (.*) \}\);", html)
    own = dict(re.findall(r"(\w+): new Float64Array\((\d+)\)", members))
    assert set(own) | {"p", "w", "iw"} == {*re.findall(r"\bmodel\.(\w+)", html), "p", "w", "iw"}
    assert "memory[" not in html


@pytest.mark.slow
def test_the_live_part_in_joint_coordinates_begins_where_the_run_began() -> None:
    run = load("slider-crank").simulate(until=0.01, coordinates="joint", start={"crank.theta": 1.0})
    live = data_of(run.view().html)["live"]
    state = dict(zip(live["state"], live["y0"], strict=False))
    assert state["crank.theta"] == 1.0
    for name in ("rod.theta", "crank.omega", "rod.omega"):
        assert state[name] == pytest.approx({**run.start["q"], **run.start["v"]}[name], abs=1e-12)


def test_formulas_that_the_run_had_numbers_for_keep_these() -> None:
    raw = {
        "mechanism": {"name": "ball"},
        "parameters": {"m": 2.0, "twice": {"value": "2*m"}, "further": {"value": "twice + 1"}},
        "bodies": {"a": {"type": "point", "mass": "further"}},
    }
    run = load(validate(raw, "test")).simulate(until=0.1, shape="straight", parameters={"twice": 7.0})
    live = data_of(run.view().html)["live"]
    assert live["p0"][:3] == [2.0, 7.0, 8.0] and live["independent"] == [1]
    assert (
        data_of(load(validate(raw, "test")).simulate(until=0.1, shape="straight").view().html)["live"]["independent"]
        == []
    )


@pytest.mark.slow
def test_pages_in_joint_coordinates_have_no_sliders_that_move_the_start() -> None:
    """The lean of a pole says where it is described; pages begin with the joints' coordinates as they were."""
    run = load("cart-pole").simulate(until=0.01, coordinates="joint")
    data = data_of(run.view().html)
    assert [p["name"] for p in data["live"]["parameters"] if p.get("still")] == ["lean"]
    assert data["note"].startswith("no sliders for lean:")
    absolute = data_of(load("cart-pole").simulate(until=0.01, shape="straight").view().html)
    assert not any(p.get("still") for p in absolute["live"]["parameters"]) and absolute["note"] == ""


def test_a_large_mechanism_has_coarse_coordinates_and_its_forces() -> None:
    values = np.zeros((70, 90))
    recording = Recording(
        load("pendulum").mechanism, {}, values[:, 0], values, reactions=values.reshape(70, 45, 2), pushed=("a",) * 45
    )
    assert [is_coarse(recording, room) for room in (60 * 730, 60 * 490, 60 * 400)] == [False, True, True]


@pytest.mark.slow
def test_forces_are_in_the_page_of_every_machine_that_has_some() -> None:
    """The scissor lift's page went without them, as it would have been too large."""
    motion = data_of(load("scissor-lift").simulate(until=0.05).view(live=False).html)["motions"][0]
    assert {"base", "clevis", "eye", "roller"} <= set(motion["reactions"]["names"])
    numbers = np.frombuffer(base64.b64decode(motion["reactions"]["data"]), "<u2")
    assert len(numbers) == 2 * len(motion["reactions"]["names"]) * motion["count"]


@pytest.mark.slow
def test_what_is_too_large_in_coordinates_of_bodies_is_live_in_those_of_joints(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    run = load("driven-four-bar").simulate(until=0.01, step=1e-3)
    own, on_tree = (
        data_of(load("driven-four-bar").simulate(until=0.01, step=1e-3, coordinates=c).view().html)["live"]
        for c in ("absolute", "joint")
    )
    assert on_tree["ny"] < own["ny"] and not own["joint"]
    monkeypatch.setattr(live, "MOST", {False: 11_000, True: 11_000})  # of 12,800 and 9,000 characters
    page = run.view()
    assert page.live and data_of(page.html)["live"] == on_tree


def test_rounding_is_no_curve_of_a_plot() -> None:
    """A rod that turns in the plane z = 0 leaves 1e-17 there: 0 in the page, and as it is in the result."""
    values = np.array([[1.0, 2e-17], [-3.0, -1e-13]])
    group = PlottedGroup("position", "m", ("a.x", "a.z"), values)
    recording = Recording(load("pendulum").mechanism, {}, np.arange(2.0), np.zeros((2, 2)), groups=(group,))
    (shown,) = pack_recording(recording, np.arange(2))["groups"]
    assert shown["low"] == [-3.0, 0.0] and shown["span"] == [4.0, 1.0]
    assert group.values[0, 1] == 2e-17
    angles = PlottedGroup("angle", "rad", ("a.theta",), np.array([[3e-18], [4e-18]]))
    (shown,) = pack_recording(replace(recording, groups=(angles,)), np.arange(2))["groups"]
    assert shown["low"] == [0.0] and shown["span"] == [1.0]


@pytest.mark.slow
def test_an_output_alone_is_titled_by_its_name() -> None:
    """Energy lost at a stop is a step, and no energy of the motion: the page of the press begins with its opening."""
    motion = data_of(load("toggle-press").simulate(until=0.1).view().html)["motions"][0]
    assert [group["title"] for group in motion["groups"][:2]] == ["outputs: opening", "outputs: lost"]


def test_sixteen_bits_show_0_where_it_is_0() -> None:
    """The script of a page reads numbers of 16 bits: what is 0 within half of their spacing is shown as 0."""
    values = np.array([[-0.13], [0.0], [0.1437]])
    script = (Path(live.__file__).parent / "web" / "plots.js").read_text(encoding="utf-8")
    functions = script[script.index("function decoded") : script.index("function ticks")]
    read = f"console.log(JSON.stringify(Array.from(shortColumns({json.dumps(encode_shorts(values))}, 3)[0])))"
    node = shutil.which("node")
    if node is None:  # another machine reads the same script
        return
    command = [node, "-e", f"{functions}\n{read}"]
    done = subprocess.run(command, capture_output=True, text=True, check=True)
    found = json.loads(done.stdout)
    assert found[1] == 0.0 and found == pytest.approx([-0.13, 0.0, 0.1437], abs=1e-7)


def test_frames_of_a_page_are_ends_of_steps() -> None:
    script = (Path(live.__file__).parent / "web" / "live_motion.js").read_text(encoding="utf-8")
    function = script[script.index("function frameSpacing") : script.index("// Begin again with the sliders")]
    assert "spacing = frameSpacing(end, data.live.step)" in script
    motions = [(1.0, 1e-3), (0.5, 0.01), (10.0, 2e-3), (2000.0, 0.05), (0.01, 0.1), (3.0, 1.0 / 60.0)]
    node = shutil.which("node")
    assert node, "this test needs Node: apt-get install nodejs"
    read = f"console.log(JSON.stringify({json.dumps(motions)}.map(([end, h]) => frameSpacing(end, h) / h)))"
    done = subprocess.run([node, "-e", f"{function}\n{read}"], capture_output=True, text=True, check=True)
    found = json.loads(done.stdout)
    assert found == pytest.approx([17.0, 1.0, 8.0, 67.0, 1.0, 1.0], abs=1e-12)


@pytest.mark.slow
def test_points_that_no_joint_ties_are_marked() -> None:
    for name, expected in (("jansen-leg", ["leg.foot"]), ("wiper", ["arm.tip"]), ("four-bar", [])):
        data = data_of(load(name).simulate(until=0.01).view(live=False).html)
        assert [p[0] for p in data["points"] if p[3:] == [1]] == expected


def pictures(path: Path) -> list[int]:
    """Return how long each picture of a GIF is shown [ms]."""
    with Image.open(path) as film:
        return [(film.seek(k), film.info["duration"])[1] for k in range(film.n_frames)]


@pytest.mark.parametrize(
    ("settings", "lasting"),
    [
        # durations are 16 bits of hundredths of a second, and pictures that are alike, as of a rest, are joined
        ({"until": 2000.0, "output_step": 1000.0, "step": 0.05, "max_energy_error": 1e9}, 655000),
        (
            {"until": 2000.0, "output_step": 1000.0, "step": 0.05, "start": {"bob.x": 0.0, "bob.y": -1.0}},
            655000,
        ),
        # pictures of 66 ms are shown for 60 or 70
        ({"until": 0.46, "times": np.linspace(0.0, 0.46, 7), "step": 1e-2}, 460),
    ],
)
def test_a_gif_lasts_as_long_as_the_motion_or_as_it_can(settings: Any, lasting: int, tmp_path: Path) -> None:
    result = load("pendulum").simulate(**settings)
    assert sum(pictures(write_film(tmp_path / "a.gif", playable_motion(result)))) == lasting


def test_a_gif_has_25_pictures_a_second(tmp_path: Path) -> None:
    assert main(["view", "pendulum", "--until", "0.2", "-o", str(tmp_path / "a.gif")]) == 0
    assert len(pictures(tmp_path / "a.gif")) == 5


@pytest.mark.slow
def test_a_film_goes_through_ffmpeg(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str], result: Any
) -> None:
    """What a program of that name is given: pictures of one size, as raw bytes, 25 a second."""
    programs = tmp_path / "bin"
    programs.mkdir()
    monkeypatch.setenv("PATH", str(programs))
    assert main(["view", "pendulum", "--until", "0.2", "-o", str(tmp_path / "a.mp4")]) == 2
    assert "the program ffmpeg" in capsys.readouterr().err and not (tmp_path / "a.mp4").exists()
    fake = programs / "ffmpeg"
    fake.write_text(
        f"#!{sys.executable}\nimport sys\nw, h = map(int, sys.argv[sys.argv.index('-s') + 1].split('x'))\n"
        "n, left = divmod(len(sys.stdin.buffer.read()), 3 * w * h)\n"
        "open(sys.argv[-1], 'w').write(f\"{n} {left} {sys.argv[sys.argv.index('-r') + 1]}\")\n"
    )
    fake.chmod(0o755)
    assert main(["view", "pendulum", "--until", "0.2", "-o", str(tmp_path / "a.mp4")]) == 0
    assert (tmp_path / "a.mp4").read_text() == "5 0 25"
    result.save(tmp_path / "a.nc")
    assert main(["view", str(tmp_path / "a.nc"), "-o", str(tmp_path / "b.mp4")]) == 0
    assert (tmp_path / "b.mp4").read_text() == "12 0 24"
    fake.write_text(f"#!{sys.executable}\nimport sys\nsys.exit('no such codec')\n")
    assert main(["view", "pendulum", "--until", "0.2", "-o", str(tmp_path / "c.mp4")]) == 2
    assert "no such codec" in capsys.readouterr().err and not (tmp_path / "c.mp4").exists()


@pytest.mark.slow
def test_a_mode_shape_is_played(tmp_path: Path) -> None:
    """A pendulum's mode is a turn about its pin: points of the page move along the circle's tangent."""
    model = load("pendulum")
    page = model.view_mode(1)
    data = data_of(page.html)
    moving, still = data["motions"]
    about = model.modes().about
    found, rest = (
        np.frombuffer(base64.b64decode(m["q"]), "<f4").reshape(len(data["names"]), -1) for m in (moving, still)
    )
    assert rest[:, 0] == pytest.approx([about[n] for n in data["names"]], abs=1e-6)
    away = found - rest[:, :1]
    assert np.abs(away[:, 0]).max() > 0.0 and away[:, 0] == pytest.approx(away[:, -1], abs=1e-6)
    assert np.ptp(found[0]) > 100.0 * np.ptp(found[1])  # it hangs: x moves, y does not
    assert ["", f"{model.modes().frequencies[0]:.6g} Hz"] in moving["facts"]
    assert main(["view", "pendulum", "--mode", "1", "-o", str(tmp_path / "a.gif")]) == 0
    with pytest.raises(InputError, match="from 1 to"):
        model.view_mode(7)
    of_joints = replace(model.modes(), names=("pin.angle",))
    with pytest.raises(InputError, match="in coordinates of bodies"):
        mode_recording(model.mechanism, of_joints, 1)


def test_gaps_of_single_joints_are_those_of_the_run() -> None:
    """A four-bar has pins alone, so their squares add up to that of the violation; the method drifts."""
    run = load("four-bar").simulate(until=0.5, step=0.02, method="lagrange", integrator="rk4")
    told = data_of(run.view(live=False).html)["motions"][0]["gaps"]
    assert len(told["names"]) == 4
    columns = np.frombuffer(base64.b64decode(told["data"]), "<u2").reshape(4, -1)
    powers = [
        low + span * column / 65534.0 for low, span, column in zip(told["low"], told["span"], columns, strict=True)
    ]
    assert columns.shape[1] == len(run.t)
    whole = np.sqrt(np.sum(10.0 ** (2.0 * np.array(powers)), axis=0))
    assert whole[-1] > 1e-9 and whole[-1] == pytest.approx(run.violations["position"][-1], rel=2e-3)


@pytest.mark.slow
def test_a_file_of_something_else_is_refused(tmp_path: Path, capsys: pytest.CaptureFixture[str], result: Any) -> None:
    (tmp_path / "x.nc").write_bytes(b"nothing")
    assert main(["view", str(tmp_path / "x.nc")]) == 2
    result.save(tmp_path / "a.nc")
    assert main(["view", str(tmp_path / "a.nc"), "--model", "pendulum", "-o", str(tmp_path / "y.html")]) == 2
    assert "one of slider-crank" in capsys.readouterr().err
    assert main(["view", str(tmp_path / "a.nc"), "--set", "crank_mass=9", "-o", str(tmp_path / "y.html")]) == 2
    assert "--set: expected settings of a saved result" in capsys.readouterr().err

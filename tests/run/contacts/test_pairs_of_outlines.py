"""Outlines that stand on lines and on each other, and points beside corners: closed forms, and contacts of corners."""

import math
import subprocess
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from benchmarks.mechanisms.toml import text as toml
from tests.run.contacts.scenes import G, loaded

TIGHT: dict[str, Any] = {"integrator": "dop853", "rtol": 1e-11, "verify": False}
LINE = {"line": "ground"}


def thing(place: list[Any], **more: Any) -> dict[str, Any]:
    """Return a body of 1 kg."""
    return {"mass": 1.0, "inertia": 0.01, "position": place, **more}


def scene(body: dict[str, Any], outlines: dict[str, Any], contacts: dict[str, Any], **parameters: float) -> str:
    """Return a body and its contacts on a slope whose angle is the parameter gamma."""
    gravity = [f"{G}*sin(gamma)", f"-{G}*cos(gamma)"]
    raw = {
        "mechanism": {"name": "stands", "gravity": gravity},
        "parameters": {"gamma": 0.0, "mu": 0.3, **parameters},
        "bodies": {"thing": body},
        "outlines": outlines,
        "contacts": contacts,
    }
    return toml(raw)


def hexagon(contacts: dict[str, Any]) -> str:
    """Return a hexagon of 0.1 m that begins to roll about the front corner of the side on which it stands."""
    shape = {"body": "thing", "polygon": {"sides": 6, "radius": 0.1}}
    place = [0.0, 0.1 * math.cos(math.pi / 6.0)]
    body = thing(place, angular_velocity="-w", velocity=[f"w*{place[1]!r}", "0.05*w"])
    ground = {"body": "ground", "points": [[-1.0, 0.0], [3.0, 0.0]]}
    outlines = {"hexagon": shape, "level": ground} if "feet" in contacts else {}
    return scene(body, outlines, contacts, w=3.0)


CORNERS = {
    f"corner{i}": {
        "between": [{"body": "thing", "at": [0.1 * math.cos(x), 0.1 * math.sin(x)]}, LINE],
        "friction": 2.0,
    }
    for i, x in enumerate(np.arange(6) * math.pi / 3.0)
}


@pytest.mark.slow
def test_a_polygon_walks_down_slopes(tmp_path: Path) -> None:
    """Energy goes over each corner, and angular momentum about the next one is kept."""
    model = loaded(hexagon({"feet": {"between": [{"outline": "hexagon"}, LINE], "friction": 2.0}}), tmp_path)
    draw, about = np.random.default_rng(3), 0.01 + 0.1**2
    kept = (0.01 + 0.1**2 * math.cos(math.pi / 3.0)) / about
    for _ in range(20):
        gamma, rate = float(draw.uniform(0.05, 0.2)), float(draw.uniform(6.0, 7.0))
        run = model.simulate(until=1.0, parameters={"gamma": gamma, "w": rate}, **TIGHT)
        assert run.ok, run.reason
        hits = sorted({event.t for event in run.events if event.name == "feet.hit"})
        assert len(hits) >= 3
        falls = 2.0 * G * 0.1 * (math.cos(gamma - math.pi / 6.0) - math.cos(gamma + math.pi / 6.0)) / about
        for time in hits[:-1]:
            before = math.sqrt(rate**2 + falls)
            event = next(event for event in run.events if event.t == time)
            assert abs(event.v["thing.omega"] + before) < 1e-9
            rate = kept * before


@pytest.mark.slow
@pytest.mark.parametrize("under", ["line", "outline"])
def test_feet_move_as_contacts_of_corners(under: str, tmp_path: Path) -> None:
    other = LINE if under == "line" else {"outline": "level"}
    texts = hexagon({"feet": {"between": [{"outline": "hexagon"}, other], "friction": 2.0}}), hexagon(CORNERS)
    models = [loaded(text, tmp_path) for text in texts]
    for gamma, rate in ((0.1, 5.0), (0.2, 3.0), (-0.15, 2.0)):
        runs = [model.simulate(until=0.6, parameters={"gamma": gamma, "w": rate}, **TIGHT) for model in models]
        assert all(run.ok for run in runs), [run.reason for run in runs]
        np.testing.assert_allclose(runs[0].q.values, runs[1].q.values, rtol=0.0, atol=1e-9)
        assert len(runs[0].events) == len(runs[1].events) > 0


TABLE = {"body": "ground", "points": [[-2.0, 0.0], [0.0, 0.0], [0.0, -1.0]]}


@pytest.mark.slow
def test_a_box_slides_off_a_table_and_tips(tmp_path: Path) -> None:
    """It tips where the edge is mu h ahead of its centre; front corner and edge change places without an impact."""
    shapes = {"box": {"body": "thing", "box": [0.2, 0.3]}, "table": TABLE}
    contacts = {"feet": {"between": [{"outline": "table"}, {"outline": "box"}], "friction": "mu"}}
    model = loaded(scene(thing([-0.4, 0.15], velocity=["v", 0.0]), shapes, contacts, v=2.0), tmp_path)
    draw = np.random.default_rng(4)
    for _ in range(10):
        v, mu, gamma = float(draw.uniform(2.0, 4.0)), float(draw.uniform(0.05, 0.3)), float(draw.uniform(-0.2, 0.2))
        slows, way = G * (mu * math.cos(gamma) - math.sin(gamma)), 0.4 - 0.15 * mu
        time = 2.0 * way / (v + math.sqrt(v * v - 2.0 * slows * way))
        run = model.simulate(until=time + 0.02, parameters={"v": v, "mu": mu, "gamma": gamma}, **TIGHT)
        assert run.ok, run.reason
        tips = max(event.t for event in run.events if event.name == "feet.lift")
        assert abs(tips - time) < 1e-9, (tips, time)
        (before,) = [i for i in range(len(run.t) - 1) if run.t[i] <= time < run.t[i + 1]]
        assert abs(run.q.values[before, 2]) < 1e-9 and abs(run.q.values[before, 1] - 0.15) < 1e-9
        assert run["thing.theta"][-1] < -1e-4


@pytest.mark.slow
def test_a_point_leaves_a_corner(tmp_path: Path) -> None:
    """It slides to the corner and flies from there, in parabolas of all speeds; slow ones land on the slope below."""
    roof = {"body": "ground", "points": [[-0.4, 0.0], [0.0, 0.0], [0.12, -0.36]]}
    contact = {"tip": {"between": [{"body": "thing"}, {"outline": "roof"}], "friction": "mu"}}
    model = loaded(scene(thing([-0.3, 0.0], velocity=["v", 0.0]), {"roof": roof}, contact, v=2.0), tmp_path)
    draw = np.random.default_rng(5)
    for _ in range(10):
        v, mu = float(draw.uniform(2.0, 4.0)), float(draw.uniform(0.0, 0.4))
        time = 0.6 / (v + (leaves := math.sqrt(v * v - 2.0 * mu * G * 0.3)))
        run = model.simulate(until=time + 0.25, parameters={"v": v, "mu": mu}, **TIGHT)
        assert run.ok, run.reason
        assert [event.name for event in run.events] == ["tip.lift"] and abs(run.events[0].t - time) < 1e-9
        x, y = run.q.values[-1, :2]
        assert abs(x - 0.25 * leaves) < 1e-9 and abs(y + 0.5 * G * 0.25**2) < 1e-9


@pytest.mark.slow
def test_a_point_in_a_valley(tmp_path: Path) -> None:
    """It comes down one side and meets the other one as two lines without ends."""
    valley = {"body": "ground", "points": [[-2.0, 1.2], [0.0, 0.0], [2.0, 1.0]]}
    law = {"friction": "mu", "restitution": 0.3}
    normals = [1.2, 2.0], [-1.0, 2.0]
    two = {
        f"side{i}": {"between": [{"body": "thing"}, {**LINE, "normal": [x / math.hypot(*n) for x in n]}], **law}
        for i, n in enumerate(normals)
    }
    one = {"tip": {"between": [{"body": "thing"}, {"outline": "valley"}], **law}}
    models = [
        loaded(scene(thing([-0.4, 0.4]), shapes, contacts), tmp_path)
        for shapes, contacts in (({"valley": valley}, one), ({}, two))
    ]
    for mu in (0.05, 0.3):
        runs = [model.simulate(until=0.8, parameters={"mu": mu}, **TIGHT) for model in models]
        assert all(run.ok for run in runs), [run.reason for run in runs]
        np.testing.assert_allclose(runs[0].q.values, runs[1].q.values, rtol=0.0, atol=1e-9)


@pytest.mark.slow
def test_a_disc_within_a_closed_outline_moves_as_in_a_hole(tmp_path: Path) -> None:
    ring = {"body": "ground", "inside": True, "closed": True}
    ring["points"] = [[-0.3, 0.0], {"to": [0.3, 0.0], "radius": -0.3}, {"to": [-0.3, 0.0], "radius": -0.3}]
    disc = {"body": "thing", "disc": 0.1}
    runs = []
    for other, shapes in (({"outline": "ring"}, {"ring": ring}), ({"body": "ground", "disc": -0.3}, {})):
        contacts = {"touch": {"between": [disc, other], "friction": "mu"}}
        text = scene(thing([0.2, 0.0], velocity=[0.0, -0.5]), shapes, contacts)
        runs.append(loaded(text, tmp_path).simulate(until=1.5, **TIGHT))
    assert all(run.ok for run in runs), [run.reason for run in runs]
    np.testing.assert_allclose(runs[0].q.values, runs[1].q.values, rtol=0.0, atol=1e-9)


def test_a_box_drops_on_a_line_as_users_start_it(tmp_path: Path) -> None:
    contacts = {"feet": {"between": [{"outline": "box"}, LINE], "friction": "mu"}}
    text = scene(thing([0.0, 0.2]), {"box": {"body": "thing", "box": [0.2, 0.3]}}, contacts)
    (tmp_path / "box.toml").write_text(text)
    command = [sys.executable, "-m", "symgen", "run", "box.toml", "--until", "0.3"]
    done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, check=False)
    assert done.returncode == 0 and "feet.rest" in done.stdout, done.stdout + done.stderr

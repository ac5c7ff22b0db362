"""Rolling that gives way in the live part of a page, which Node reads: the motion is that of the run."""

import json
import re
import shutil
import subprocess
from pathlib import Path

import numpy as np
import pytest

import symgen
from symgen.result.player import live
from tests.result.player.test_page import data_of
from tests.space.test_giving import FLAT, coin, mechanism

#: Steps of the live part of a page in its own order, with a value of a parameter.
STEPS = """
const live = makeLive(data.live, Object.assign({ confirm: null, bodies: null, find_lock: null }, emitted));
const places = new Map(data.live.parameters.map((x, i) => [x.name, x.place ?? i]));
live.setParameters(Object.entries(changed).map(([name, x]) => [places.get(name), x]));
const y = live.start(), h = data.live.step;
for (let k = 0; k < count; k++) if (!live.step(k*h, y, h)) throw new Error(`no step at ${k*h}`);
console.log(JSON.stringify(live.bodies(count*h, y)));
"""


def state_of_page(html: str, changed: dict[str, float], count: int) -> list[float]:
    """Coordinates of bodies after steps of the code that a page has."""
    script = re.findall(r"<script>(.*?)</script>", html, re.S)[-1]
    drawn = (Path(live.__file__).parent / "web" / "draw.js").read_text(encoding="utf-8").splitlines()
    first = next(line.strip() for line in drawn if line.startswith(("const", "let", "function")))
    own = script[script.index("const emitted") : script.index(first)]
    node = shutil.which("node")
    assert node, "this test needs Node: apt-get install nodejs"
    numbers = f"const data = {json.dumps(data_of(html))}, changed = {json.dumps(changed)}, count = {count};"
    source = f"{numbers}\n{own}\n{STEPS}"
    done = subprocess.run([node, "-"], input=source, capture_output=True, text=True, check=True)
    return list(json.loads(done.stdout))


def bouncing() -> symgen.MechanismBuilder:
    """A spinning ball that falls on a road that gives way, and hops."""
    body = {"mass": 0.5, "inertia": (2e-4,) * 3, "position": (0.0, 0.0, 0.25), "angular_velocity": (0.0, 30.0, 4.0)}
    builder = mechanism("hop").parameter("grip", 0.3).body("ball", **body)
    friction = {"coefficient": "grip", "speed": 0.02}
    contact = {"body": "ball", "radius": 0.05, "stiffness": 2e4, "damping": 5.0, "friction": friction}
    return builder.joint("road", "rolling-sphere", **FLAT, **contact)


@pytest.mark.by_turns(3)
@pytest.mark.slow
@pytest.mark.parametrize("coordinates", ["absolute", "joint"])
@pytest.mark.parametrize("name", ["coin", "ball"])
def test_the_live_part_has_the_motion_of_the_run(name: str, coordinates: str) -> None:
    builder = coin(speed=0.05, velocity=(1.0, 0.2, 0.0)) if name == "coin" else bouncing()
    settings = {"method": "direct-correction", "integrator": "rk4", "step": 1e-4, "output_step": 0.05}
    model = symgen.load(builder.build())
    page = model.simulate(until=0.05, coordinates=coordinates, **settings).view()
    assert page.live
    for changed in ({}, {"grip": 0.12}) if name == "ball" else ({},):
        run = model.simulate(until=0.4, coordinates=coordinates, parameters=changed, **settings)
        expected = np.array([run[each][-1] for each in run.q.names])
        found = state_of_page(page.html, changed, 4000)[: len(expected)]
        np.testing.assert_allclose(found, expected, rtol=0, atol=1e-11 * max(1.0, np.abs(expected).max()))
    if name == "ball":  # it has left the road, and come back
        gap = model.simulate(until=0.4, **settings | {"output_step": 1e-3})["road.gap"]
        assert gap.min() < 0.0 < gap.max() and (np.diff(np.sign(gap)) != 0).sum() >= 2

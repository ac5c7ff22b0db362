"""Every mechanism of the catalogue, pulled in its page by the spring of a hand, beside a run of a file with the spring.

Pages have straight code, or looped code as those of many bodies do; runs have compiled code of the file. Both make the
same steps.
"""

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from support.emitted import mechanism_of

from benchmarks.editor import scissor_lift
from symgen.api import Model, load
from symgen.describe import catalogue
from symgen.describe.catalogue import raw
from symgen.describe.files.load import parse_toml
from symgen.result import live_run
from tests.browser.chromium import Chromium

pytestmark = [pytest.mark.browser, pytest.mark.slow]

STIFFNESS, DAMPING, STEPS = 50.0, 2.0, 100


def pulled_and_run(
    chromium: Chromium, page: Path, file: dict[str, Any], body: str, coordinates: int
) -> tuple[np.ndarray, np.ndarray]:
    """Return the state after some steps in a page that is open, pulled at a body, and in a run with that spring."""
    axes, both = {2: (2, 3), 3: (2, 3), 7: (3, 6)}[coordinates]
    at, to = ([0.0] * axes if coordinates == 2 else [0.01, 0.02, 0.03][:axes]), [0.1, 0.2, 0.3][:axes]
    spring = {
        **{"type": "bushing", "between": ["ground", body], "at": [to, at], "frame": "ground"},
        **{"stiffness": [STIFFNESS] * axes + [0.0] * (both - axes)},
        **{"damping": [DAMPING] * axes + [0.0] * (both - axes)},
    }
    chromium.open(page)
    step = chromium.run("symgen.step")
    end = STEPS * step
    hand = json.dumps([{"t": 0, "hand": {"name": body, "at": at, "to": to, "k": STIFFNESS, "c": DAMPING}}])
    found = np.array(chromium.run(f"symgen.run({{}}, {end}, {step}, {hand})"))
    model = Model(mechanism_of({**file, "forces": {**file.get("forces", {}), "hand": spring}}))
    tables = model.simulate(until=end, integrator="rk4", step=step, output_step=end).whole()
    places = [(i, name) for i, name in enumerate(chromium.run("symgen.state")) if name in tables.names]
    assert len(places) >= 2
    return found[[i for i, _ in places]], np.array([tables[name][-1] for _, name in places])


@pytest.mark.by_turns(6)
@pytest.mark.parametrize("looped", [False, True])
@pytest.mark.parametrize("name", catalogue.all_names())
def test_every_catalogue_scene_is_pulled_as_with_the_spring_in_its_file(
    name: str, looped: bool, chromium: Chromium, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    if looped:
        monkeypatch.setattr(live_run, "MOST_STRAIGHT", 0)
    model = load(name)
    page = model.simulate(until=STEPS * model.mechanism.defaults.step).view()
    page.save(tmp_path / "page.html")
    body = model.mechanism.bodies[-1]
    found, expected = pulled_and_run(chromium, tmp_path / "page.html", raw(name), body.name, len(body.coordinates))
    assert np.abs(found - expected).max() < 1e-9 * max(1.0, np.abs(expected).max())
    assert chromium.said == []


@pytest.mark.parametrize(("bodies", "characters"), [(30, 300_000), (100, 500_000)])
def test_a_lift_of_many_bodies_is_pulled_and_its_sliders_move_it(
    bodies: int, characters: int, chromium: Chromium, tmp_path: Path
) -> None:
    file = parse_toml(scissor_lift(bodies), "scissors")
    own = Model(mechanism_of(file))
    result = own.simulate(until=0.1)
    page = result.view()
    page.save(tmp_path / "page.html")
    assert len(page.html) < len(result.view(live=False).html) + characters
    found, expected = pulled_and_run(chromium, tmp_path / "page.html", file, f"a{bodies // 4}", 3)
    assert np.abs(found - expected).max() < 1e-9 * np.abs(expected).max()
    names = chromium.run("symgen.state")
    for values in ({}, {"k": 15000.0, "J": 0.03}):
        run = own.simulate(parameters=values, until=0.1, integrator="rk4", step=0.001, output_step=0.1).whole()
        state = dict(zip(names, chromium.run(f"symgen.run({json.dumps(values)}, 0.1)"), strict=False))
        worst = max(abs(state[n] - run[n][-1]) for n in names if n in run.names)
        assert worst < 1e-9
    assert chromium.said == []

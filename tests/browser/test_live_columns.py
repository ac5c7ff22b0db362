"""The curves of a motion that a page works out: as many as of the recorded one, with the values of a run."""

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from support.emitted import mechanism_of
from support.twin import spatial_twin

from symgen.api import Model, load
from symgen.describe.catalogue import raw
from symgen.result.labelled import unit_scales
from tests.browser.chromium import Chromium
from tests.browser.test_controls import field, settled, typed

pytestmark = pytest.mark.browser

#: Mechanism -> a parameter with another value. In space the four-bar has rows that depend on others.
CHANGED = {
    "four-bar in space": ("crank_mass", 1.5),
    "slider-crank": ("crank_mass", 1.5),
    "wiper": ("arm_mass", 0.55),
    "flyball-governor": ("spring_stiffness", 7e5),
}
OPTIONS = "[...document.querySelectorAll('#group option')].map((o) => o.text)"


@pytest.fixture(scope="module")
def crank(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return load("slider-crank").simulate(until=0.5).view().save(tmp_path_factory.mktemp("pages") / "crank.html")


def modelled(name: str) -> Model:
    if not name.endswith(" in space"):
        return load(name)
    return Model(mechanism_of(spatial_twin(raw(name.removesuffix(" in space")), {})))


@pytest.mark.parametrize("name", CHANGED)
def test_a_motion_that_the_page_works_out_has_all_curves_with_the_values_of_a_run(
    name: str, chromium: Chromium, tmp_path: Path
) -> None:
    (parameter, value), until = CHANGED[name], 0.5
    model = modelled(name)
    chromium.open(model.simulate(until=until).view().save(tmp_path / "page.html"))
    groups, options = chromium.run("symgen.groups()"), chromium.run(OPTIONS)
    typed(chromium, parameter, str(value))
    settled(chromium)
    assert chromium.said == []
    assert chromium.run("symgen.groups()") == groups and chromium.run(OPTIONS) == options
    columns = {n: chromium.run(f"symgen.column({json.dumps(n)})") for g in groups if not g["log"] for n in g["names"]}
    t = np.array(next(iter(columns.values()))["t"])
    steps = {"integrator": "rk4", "step": chromium.run("symgen.step"), "output_step": float(t[1] - t[0])}
    run = model.simulate(until=until, parameters={parameter: value}, **steps)
    assert len(run.t) == len(t)
    scales = unit_scales(run.whole())
    units = dict(zip(run.whole().names, run.whole().units, strict=True))
    for column, seen in columns.items():
        error = np.abs(np.array(seen["values"]) - run[column]).max()
        assert error <= 1e-9 * scales[units[column]], (column, error)
    assert {n.rpartition(".")[0] for n in columns} >= {f"multiplier.{j.name}" for j in model.mechanism.joints[:1]}


def test_a_tree_in_joint_coordinates_shows_what_follows_from_bodies(chromium: Chromium, tmp_path: Path) -> None:
    run = load("cart-pole").simulate(until=0.2, coordinates="joint")
    chromium.open(run.view().save(tmp_path / "page.html"))
    before = chromium.run(OPTIONS)
    typed(chromium, "cart_mass", "1.2")
    settled(chromium)
    after = chromium.run(OPTIONS)
    assert chromium.said == [] and set(after) < set(before)
    assert {"position [m]", "velocity [m/s]", "acceleration [m/s^2]", "energy [J]", "pole: position [m]"} <= set(after)
    seen: Any = chromium.run("symgen.column('pole.alpha')")
    same = load("cart-pole").simulate(until=0.2, parameters={"cart_mass": 1.2}, output_step=seen["t"][1])
    assert np.array(seen["values"]) == pytest.approx(same["pole.alpha"], rel=1e-5, abs=1e-7)


def test_curves_over_an_angle_and_one_curve_alone(crank: Path, chromium: Chromium) -> None:
    chromium.open(crank)
    choose = """((s, text) => {
      [...s.options].find((o) => o.text === text).selected = true;
      s.dispatchEvent(new Event('change'));
    })"""
    chromium.run(f"{choose}(document.getElementById('group'), 'P: force [N]')")
    chromium.run(f"{choose}(document.getElementById('over'), 'crank.theta')")
    names = "[...document.querySelectorAll('#key button')].map((b) => [b.childNodes[1].textContent, b.ariaPressed])"
    assert chromium.run(names) == [["P.Fx", "false"], ["P.Fy", "false"]]
    chromium.run("document.querySelectorAll('#key button')[1].click()")
    assert chromium.run(names) == [["P.Fx", "false"], ["P.Fy", "true"]]
    chromium.run("document.querySelectorAll('#key button')[1].click()")
    assert chromium.run(names) == [["P.Fx", "false"], ["P.Fy", "false"]]
    # what is drawn over stays through a change of a parameter
    typed(chromium, "crank_mass", "1.5")
    settled(chromium)
    assert chromium.run("document.getElementById('over').value") == "crank.theta"
    assert chromium.run("document.getElementById('group').selectedOptions[0].text") == "P: force [N]"
    # a click in the middle of the axis goes to a time at which the crank is there
    chromium.run(
        "document.getElementById('play').classList.contains('playing') && document.getElementById('play').click()"
    )
    angles = chromium.run("symgen.column('crank.theta')")
    chromium.run("""(() => {
      const c = document.getElementById('plot'), r = c.getBoundingClientRect();
      const at = { clientX: r.left + 58 + 0.5 * (r.width - 66), clientY: r.top + 50, pointerId: 1, bubbles: true };
      c.setPointerCapture = () => {};
      c.dispatchEvent(new PointerEvent('pointerdown', at));
    })()""")
    chromium.frame()
    time = float(chromium.run("document.getElementById('clock').textContent").partition(" ")[0])
    low, high = min(angles["values"]), max(angles["values"])
    assert np.interp(time, angles["t"], angles["values"]) == pytest.approx(0.5 * (low + high), abs=0.03 * (high - low))
    assert chromium.said == []


def test_no_group_is_rounding(chromium: Chromium, tmp_path: Path) -> None:
    """A pin exerts no moment, and a governor that is symmetric none of the forces across its slide."""
    chromium.open(load("flyball-governor").simulate(until=0.3).view().save(tmp_path / "page.html"))
    titles = chromium.run(OPTIONS)
    assert "hinge1: force [N]" in titles and "sleeve: force [N]" not in titles
    chromium.open(load("four-bar").simulate(until=0.3).view().save(tmp_path / "page.html"))
    assert not [title for title in chromium.run(OPTIONS) if title.endswith(": moment [N m]")]


def test_a_run_of_a_script_says_why_there_is_none(chromium: Chromium, tmp_path: Path) -> None:
    chromium.open(load("wiper").simulate(until=0.1).view().save(tmp_path / "page.html"))
    tried = "((values) => { try { return symgen.run(values, 0.2); } catch (error) { return error.message; } })"
    assert chromium.run(f"{tried}({{ crank_length: 0.6 }})") == "the mechanism does not close with these parameters"
    assert len(chromium.run(f"{tried}({{}})")) >= 18
    assert chromium.said == [] and chromium.run(f"{field('arm_mass')}.value") == "0.4"


def test_gains_of_a_method_have_sliders(chromium: Chromium, tmp_path: Path) -> None:
    """Greater gains hold the joints of a motion closer together, as those of a run do."""
    model = load("four-bar")
    chromium.open(model.simulate(until=1.0).view(live="baumgarte").save(tmp_path / "page.html"))
    names = chromium.run("[...document.querySelectorAll('#live input[type=number]')].map((i) => i.dataset.name)")
    assert {"crank_mass", "method.alpha", "method.beta"} <= set(names)
    typed(chromium, "method.alpha", "20")
    typed(chromium, "method.beta", "20")
    settled(chromium)
    seen = chromium.run("symgen.column('violation.position')")
    options = {"method.alpha": 20.0, "method.beta": 20.0}
    run = model.simulate(method="baumgarte", integrator="rk4", step=1e-3, until=1.0, options=options)
    middle = np.interp(0.5, seen["t"], seen["values"])  # as powers of ten
    assert middle == pytest.approx(np.log10(np.interp(0.5, run.t, run["violation.position"])), abs=0.3)
    assert chromium.said == []

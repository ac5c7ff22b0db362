"""Laws of dry friction side by side: creep, transitions and energy against closed forms."""

import json
import math
from pathlib import Path

import numpy as np
import pytest

import symgen
from symgen.base.errors import InputError
from symgen.describe.files.load import parse_toml
from symgen.describe.files.validate import validate
from symgen.describe.mechanism import Mechanism

#: A load that is thrown upwards in a clamp, stops after 0.1 s and 0.1125 m, and is held by 25 N against 20 N.
LOAD = """
[mechanism]
name = "clamped-load"
gravity = [0.0, -10.0]

[run]
until = 0.5
output_step = 0.01

[bodies.load]
mass = 2.0
inertia = 1.0
velocity = [0.0, 2.25]

[joints.rail]
type = "translational"
between = ["ground", "load"]
at = [[0.0, 0.0], "centre"]
axis = [0.0, 1.0]
FRICTION
"""
LAWS = ("exact", "tanh:speed=0.01", "tanh:speed=0.001")


def load(keys: str = "friction = { sliding = 25.0 }") -> Mechanism:
    return validate(parse_toml(LOAD.replace("FRICTION", keys), "load.toml"), "load.toml")


@pytest.fixture(scope="module")
def study():
    return symgen.compare(load(), ["lagrange"], ["dop853", "rk4"], steps=[1e-4], rtols=[1e-10], laws=LAWS, repeat=1)


@pytest.mark.slow
def test_smooth_laws_creep_at_the_rate_of_their_force(study) -> None:
    assert study.how.startswith("direct-correction with dop853") and study.estimated_error < 1e-11
    rows = {(row.law, row.integrator): row for row in study.rows}
    assert set(rows) == {(law, name) for law in LAWS for name in ("dop853", "rk4")}
    for name in ("dop853", "rk4"):
        exact = rows["exact", name]
        assert exact.status == "ok" and exact.creep < 1e-12 and exact.error < 1e-9
        assert (exact.transitions, exact.impacts) == (1, 0)
        assert abs(exact.dissipated - 25.0 * 0.1125) < 1e-9
        for law, speed in zip(LAWS[1:], (1e-2, 1e-3), strict=True):
            smooth, creep = rows[law, name], speed * math.atanh(0.8)
            assert smooth.creep == pytest.approx(creep, rel=1e-3)
            assert (smooth.transitions, smooth.impacts) == (0, 0)
            assert smooth.error == pytest.approx(0.4 * creep, rel=0.3)
            assert smooth.label == f"lagrange, {law}"
            assert smooth.evaluations > exact.evaluations or name == "rk4"
    assert {row.reaction_error for row in study.rows} == {None}


@pytest.mark.slow
def test_the_energy_of_a_smooth_law_is_what_the_motion_lacks(study) -> None:
    row = next(row for row in study.rows if row.law == LAWS[1] and row.integrator == "dop853")
    trace = study.traces[study.rows.index(row)]
    assert row.dissipated == pytest.approx(0.5 * 2.0 * 2.25**2 - trace.kinetic[-1] - trace.potential[-1], rel=1e-4)


@pytest.mark.slow
def test_stops_are_compared_by_their_impacts() -> None:
    """A ball on a floor: one impact until 0.5 s takes (1 - e^2) m g h."""
    ball = """
[mechanism]
name = "ball"
gravity = [0.0, -10.0]
[bodies.ball]
type = "point"
mass = 0.5
position = [0.0, 1.0]
[stops.floor]
gap = "ball.y"
restitution = 0.6
"""
    model = validate(parse_toml(ball, "ball.toml"), "ball.toml")
    row = symgen.compare(model, ["lagrange"], ["dop853"], rtols=[1e-10], until=0.5, repeat=1).rows[0]
    assert (row.law, row.transitions, row.impacts, row.creep) == ("exact", 0, 1, None)
    assert abs(row.dissipated - 5.0 * (1.0 - 0.36)) < 1e-9 and row.error < 1e-9


@pytest.mark.slow
def test_the_command_and_its_report_have_laws(cli, tmp_path: Path) -> None:
    file = tmp_path / "load.toml"
    file.write_text(LOAD.replace("FRICTION", "friction = { sliding = 25.0 }"), encoding="utf-8")
    arguments = ["compare", file, "--methods", "lagrange", "--integrators", "dop853", "--rtols", "1e-8"]
    arguments += ["--laws", "exact,tanh:speed=0.01", "--repeat", "1", "--jobs", "2"]
    report, journal = tmp_path / "report.html", tmp_path / "rows.journal"
    code, out, _ = cli(*arguments, "-o", report, "--journal", journal)
    assert code == 0
    assert "creep [m/s]" in out and "lagrange, tanh:speed=0.01" in out
    assert "energy lost" in report.read_text(encoding="utf-8")
    _, out, _ = cli(*arguments, "--journal", journal, "--json")
    rows = json.loads(out)["rows"]
    assert [row["law"] for row in rows] == ["exact", "tanh:speed=0.01"]
    np.testing.assert_allclose([row["dissipated"] for row in rows], 2.8, atol=0.2)


@pytest.mark.parametrize(
    ("keys", "laws", "sentence"),
    [
        ("", ["exact"], "laws: expected a mechanism with dry friction, got 'clamped-load', which has none"),
        (None, ["coulomb"], r"laws: expected exact, or tanh:speed=V with a rate V above 0, got 'coulomb'"),
        (None, ["tanh:speed=0"], "a rate V above 0"),
        (None, ["tanh:speed=x"], "a rate V above 0"),
        ("friction = { sliding = 25.0, static = 26.0 }", ["tanh:speed=1"], "26 at rest and 25 in motion"),
        ("friction = { coefficient = 0.1 }", ["tanh:speed=1"], "that of rail by the reaction"),
    ],
)
def test_wrong_laws(keys: str | None, laws: list[str], sentence: str) -> None:
    model = load() if keys is None else load(keys)
    with pytest.raises(InputError, match=sentence):
        symgen.compare(model, ["lagrange"], ["rk4"], laws=laws)


def test_solvers_of_scipy_have_no_modes() -> None:
    with pytest.raises(InputError, match="reference: expected auto, as there is no second derivation of dry friction"):
        symgen.compare(load(), ["lagrange"], ["rk4"], reference_by="scipy-radau")

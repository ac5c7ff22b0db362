"""The first sentence of a report: a failure, limits that are exceeded, doubts, or what was reached."""

import subprocess
import sys

import pytest
from support.emitted import mechanism_of
from support.locks import LOCKED

from symgen.api import load
from symgen.study.report.machine_report import machine_report
from symgen.study.report.write import html_report, markdown_report

#: A weight on a spring that falls from rest to 2 m g / k, and is held then by 2 m g.
SCALE = """
[mechanism]
name = "scale"
gravity = [0.0, -9.81]

[bodies.pan]
mass = 2.0
inertia = 0.1

[joints.guide]
type = "translational"
between = ["ground", "pan"]
at = [[0.0, 0.0], "centre"]
axis = [0.0, 1.0]

[forces.spring]
type = "spring-damper"
between = ["ground", "pan"]
at = [[0.0, 1.0], "centre"]
stiffness = 500.0
free_length = 1.0

[outputs]
pull = {{ value = "spring.force", unit = "N", largest = 50.0, smallest = {smallest} }}
sag = {{ value = "-pan.y", unit = "m", largest = {sag} }}
"""


def scale(tmp_path, sag, smallest=-50.0):
    file = tmp_path / "scale.toml"
    file.write_text(SCALE.format(sag=sag, smallest=smallest))
    return load(file)


@pytest.mark.slow
def test_limits_that_are_kept_are_good(tmp_path):
    model = scale(tmp_path, 0.1)
    verdict = machine_report(model, model.simulate(until=1.0)).verdict
    assert verdict.mood == "good"
    assert verdict.text.startswith("The run reaches 1 s and keeps 3 limits of the file; its error is ")


@pytest.mark.slow
def test_limits_that_are_exceeded_are_named_with_value_and_time(tmp_path):
    """It sags by 2 m g / k = 78.5 mm after half a period, pi sqrt(m / k) = 0.1987 s."""
    model = scale(tmp_path, 0.05)
    document = machine_report(model, model.simulate(until=1.0, output_step=1e-3))
    assert document.verdict.mood == "bad"
    head, _, rest = document.verdict.text.partition(" (")
    assert head == "1 of 3 limits is exceeded: sag"
    assert rest.startswith("78.5 mm for at most 50 mm, at t = ")
    assert 'class="verdict bad">1 of 3 limits' in html_report(document)
    assert "**1 of 3 limits is exceeded" in markdown_report(document, "files")
    model = scale(tmp_path, 0.05, -30.0)
    assert machine_report(model, model.simulate(until=1.0)).verdict.text.startswith(
        "2 of 3 limits are exceeded: pull ("
    )


@pytest.mark.slow
@pytest.mark.parametrize("name", LOCKED)
def test_a_machine_that_locks_says_so_first_and_has_no_loads(name):
    described, expected, moved = LOCKED[name]
    model = load(mechanism_of(described))
    result = model.simulate(until=2.0 * expected, step=1e-3, integrator="rk4")
    document = machine_report(model, result)
    assert document.verdict.mood == "bad"
    assert document.verdict.text.startswith("Failed: dead centre at t = ")
    assert "'motor' can go no further" in document.verdict.text
    assert all(name in document.verdict.text for name in moved)
    assert "Largest loads" not in {section.title for section in document.sections}
    glance = next(section for section in document.sections if section.title == "At a glance")
    (came_to,) = glance.tables
    assert came_to.rows[0] == ("time", f"{result.t[-1]:.4g} s", f"0 s, until {2.0 * expected:g} s")
    assert not any(cell.endswith((" N", " N m", " W")) for row in came_to.rows for cell in row)
    assert "loads" not in {picture.name for picture in document.pictures()}


@pytest.mark.slow
def test_limits_of_a_failed_run_are_not_judged():
    """Its last loads are as large as one likes; the limits that they pass say nothing of the machine."""
    described, expected, _ = LOCKED["slider-lock"]
    raw = {**described, "outputs": {"power": {"value": "motor.power", "unit": "W", "largest": 1e-6}}}
    model = load(mechanism_of(raw))
    document = machine_report(model, model.simulate(until=2.0 * expected, step=1e-3, integrator="rk4"))
    (limits,) = (section for section in document.sections if section.title == "Limits")
    assert limits.tables == () and limits.text == ("The limits of power are not judged, as the run failed.",)


@pytest.mark.slow
def test_the_command_writes_the_verdict_above_all(tmp_path):
    scale(tmp_path, 0.05)
    done = subprocess.run(
        [sys.executable, "-m", "symgen", "report", "scale.toml", "-o", "scale.md"],
        **{"cwd": tmp_path, "capture_output": True, "text": True},
    )
    assert done.returncode == 0, done.stderr
    assert (tmp_path / "scale.md").read_text().splitlines()[2].startswith("**1 of 3 limits is exceeded: sag (")

"""The first screen of a report: numbers of the run itself, in the units of engineers, where and when."""

import numpy as np
import pytest

import symgen
from symgen.study.report.key_numbers import MOST_NUMBERS, key_numbers
from symgen.study.report.machine_report import machine_report
from symgen.study.report.words import engineering_number
from symgen.study.report.write import html_report, markdown_report


@pytest.mark.parametrize(
    ("value", "unit", "text"),
    [
        (39240.0, "N", "39.2 kN"),
        (-2492.0, "W", "-2.49 kW"),
        (999.7, "N", "1 kN"),
        (0.7071, "rad", "40.5 deg"),
        (62.8, "rad", "3600 deg"),
        (0.16, "m", "0.16 m"),
        (0.0123, "m", "12.3 mm"),
        (4500.0, "m", "4500 m"),
        (0.0, "N m", "0 N m"),
        (9.5e-9, "J", "9.50×10⁻⁹ J"),
        (0.0025, "N m", "2.5 mN m"),
        (float("nan"), "N", "not finite N"),
        (3.0, "kg", "3 kg"),
    ],
)
def test_engineering_units(value: float, unit: str, text: str) -> None:
    assert engineering_number(value, unit) == text


@pytest.fixture(scope="module")
def driven() -> tuple[symgen.Model, symgen.Result]:
    model = symgen.load("driven-four-bar")
    return model, model.simulate(until=1.0, output_step=0.01)


def test_numbers_of_a_driven_linkage_are_those_of_its_run(driven: tuple[symgen.Model, symgen.Result]) -> None:
    model, result = driven
    numbers = {number.what: number for number in key_numbers(model.mechanism, result)}
    assert len(numbers) <= MOST_NUMBERS
    k = int(np.argmax(np.abs(result["motor.effort"])))
    assert numbers["motor, torque"].value == engineering_number(result["motor.effort"][k], "N m")
    assert numbers["motor, torque"].where == f"at {result.t[k]:.3g} s"
    power = result["motor.power"]
    parts = 0.5 * (power[1:] + power[:-1]) * np.diff(result.t)
    # over a whole turn: rounding of what goes in and out, which is shown as zero
    assert abs(np.sum(parts)) < 1e-14 * np.sum(np.abs(parts))
    assert numbers["motor, power"].where.endswith("work of the run 0 J")
    pins = sorted("ABCD", key=lambda pin: -np.max(result[f"{pin}.F"]))
    assert next(what for what in numbers if what.endswith(", force")) == f"{pins[0]}, force"
    swing = result["D.angle"]
    assert numbers["travel of D.angle"].value == engineering_number(np.ptp(swing), "rad")
    angles = model.kinematics(times=result.t, transmission=("C",)).transmission.values
    least = np.minimum(angles, np.pi - angles)
    assert numbers["transmission angle"].value == engineering_number(float(least.min()), "rad")
    assert numbers["transmission angle"].where.startswith("least, at C, ")  # at B the motor's own crank is at a pin


@pytest.mark.slow
def test_the_first_screen_comes_first_and_versions_last(driven: tuple[symgen.Model, symgen.Result]) -> None:
    document = machine_report(*driven, "symgen report driven-four-bar")
    assert document.sections[0].title == "At a glance" and document.sections[0].beside
    for text in (html_report(document), markdown_report(document, "files")):
        order = [text.index(words) for words in ("motor, torque", "Torques and moments", "Reproduce with")]
        assert order == sorted(order)


def test_a_mechanism_without_drives_or_transmission() -> None:
    """A point on a massless link: its force is the only number of them that it has."""
    model = symgen.load("pendulum")
    result = model.simulate(until=0.5)
    (number,) = key_numbers(model.mechanism, result)
    assert number.what == "link, force" and number.value == engineering_number(float(np.max(result["link.F"])), "N")

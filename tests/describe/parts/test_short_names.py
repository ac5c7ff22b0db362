"""Names that mean something elsewhere: those of an effort's own words, and those of units."""

from __future__ import annotations

import re

import numpy as np
import pytest

import symgen
from symgen.base.errors import InputError
from symgen.describe.facts.typed_units import units_of_number
from symgen.describe.files.load import parse_toml
from symgen.describe.files.validate import validate
from symgen.describe.mechanism import Mechanism

#: Words in capitals are names that the tests choose; the actuator reads its own `length` and `rate` beside them.
FILE = """
[mechanism]
name = "cart"
gravity = [0.0, -9.81]
[parameters]
STIFF = 40.0
SLIDE = { value = 250, unit = "mm" }
[inputs]
PUSH = 0.5
[states]
HEAT = { rate = "CART.vx**2 - HEAT", start = 0.1, unit = "K" }
[bodies.CART]
mass = 1.5
inertia = 0.1
points = { POINT = ["SLIDE", 0.0] }
velocity = [0.6, 0.0]
[bodies.ROD]
mass = 0.4
inertia = 0.02
points = { top = [0.0, 0.3] }
position = ["SLIDE", -0.3]
velocity = [0.6, 0.0]
[joints.RAIL]
type = "translational"
between = ["ground", "CART"]
at = [[0.0, 0.0], "centre"]
axis = [1.0, 0.0]
stop = { lower = -0.2, upper = 0.05, restitution = 0.5 }
[joints.PIN]
type = "revolute"
between = ["CART", "ROD"]
at = ["POINT", "top"]
friction = { sliding = 0.02 }
[forces.SPRING]
type = "spring-damper"
between = ["ground", "CART"]
at = [[-1.0, 0.0], "centre"]
actuator = "-STIFF*(length - 1) - 0.3*rate + PUSH*cos(3*CART.x) + 0.1*PIN.angle.rate"
[forces.DRIVE]
type = "torque"
body = "ROD"
torque = "PUSH*sin(5*t) - 0.1*RAIL.rate"
[outputs]
OUT = "ROD.theta + 2*SPRING.rate + RAIL.displacement + HEAT"
[events.EVENT]
when = "CART.x > 0.02"
"""
NAMES = ("STIFF", "SLIDE", "PUSH", "HEAT", "CART", "ROD", "POINT", "RAIL", "PIN", "SPRING", "DRIVE", "OUT", "EVENT")
#: What is read by its name alone.
READ = {"STIFF": "parameters", "SLIDE": "parameters", "PUSH": "inputs", "HEAT": "states"}
WORDS = ("s", "rate")
UNITS = ("m", "kg", "N", "rad", "deg", "mm", "K", "A", "Hz", "rpm", "Pa", "bar", "h")


#: What looped code has not.
NOT_LOOPED = (
    '[states]\nHEAT = { rate = "CART.vx**2 - HEAT", start = 0.1, unit = "K" }\n',
    " + HEAT",
    "friction = { sliding = 0.02 }\n",
    "stop = { lower = -0.2, upper = 0.05, restitution = 0.5 }\n",
)


def named(text: str = FILE, **names: str) -> str:
    """The file with names in the place of words in capitals, others in lower case."""
    for word in NAMES:
        text = re.sub(rf"\b{word}\b", names.get(word, word.lower()), text)
    return text


def cart(text: str = FILE, **names: str) -> Mechanism:
    return validate(parse_toml(named(text, **names), "cart.toml"), "cart.toml")


def same_motion(names: dict[str, str], settings: dict[str, str]) -> None:
    """Compare with the motion of the file whose names mean nothing else, to the last bit."""
    text = FILE
    for part in NOT_LOOPED if settings.get("shape") == "looped" else ():
        assert part in text
        text = text.replace(part, "")
    common = {"until": 0.5, "step": 5e-3, "integrator": "rk4", "method": "direct-correction", **settings}
    found, expected = (symgen.load(x).simulate(**common) for x in (cart(text, **names), cart(text)))
    assert expected.status == found.status == "ok" and len(found.events) == len(expected.events) > 0
    for table in ("q", "v", "lam", "outputs", "joint_coordinates", "elements"):
        np.testing.assert_array_equal(getattr(found, table).values, getattr(expected, table).values)


@pytest.mark.by_turns(8)
@pytest.mark.fast("pin=s drive=rate point=s-{'shape': 'looped'}", "out=s event=rate spring=rate-{'shape': 'looped'}")
@pytest.mark.parametrize("settings", [{"shape": "straight"}, {"shape": "looped"}, {"coordinates": "joint"}], ids=str)
@pytest.mark.parametrize(
    "names",
    [
        {"CART": "s", "ROD": "rate"},
        {"CART": "rate", "RAIL": "s"},
        {"RAIL": "rate", "SPRING": "s", "POINT": "rate"},
        {"PIN": "s", "DRIVE": "rate", "POINT": "s"},
        {"OUT": "s", "EVENT": "rate", "SPRING": "rate"},
    ],
    ids=lambda names: " ".join(f"{word.lower()}={name}" for word, name in names.items()),
)
def test_bodies_joints_forces_and_points_may_have_names_of_an_efforts_words(names, settings):
    same_motion(names, settings)


@pytest.mark.parametrize("name", WORDS)
@pytest.mark.parametrize("word", READ)
def test_what_formulas_read_by_its_name_alone_may_not(word, name):
    expected = f"cart.toml: {READ[word]}: expected a"
    why = "formulas of forces mean by 's' what they act along, by 'rate' its rate; "
    with pytest.raises(InputError, match=re.escape(expected)) as error:
        cart(**{word: name})
    assert str(error.value).endswith(f"no meaning of its own, got '{name}'; {why}'{name}_' is free")


@pytest.mark.slow_cases("{'shape': 'straight'}")
@pytest.mark.parametrize("settings", [{"shape": "straight"}, {"shape": "looped"}], ids=str)
def test_names_of_units_are_free(settings):
    same_motion(dict(zip(NAMES, UNITS, strict=True)), settings)


def test_a_name_wins_over_a_unit_where_both_could_be_meant():
    """Behind a number, a name of the file is no unit: the text is a formula that lacks a sign."""
    assert cart().parameters[1].value == 0.25
    text = named(STIFF="cm").replace("slide = { value = 250", 'slide = { value = "25 cm"')
    with pytest.raises(InputError, match=r"parameters\.slide: .*'25 cm', which is incomplete or has a syntax error"):
        validate(parse_toml(text, "cart.toml"), "cart.toml")
    formula = named(STIFF="cm").replace("slide = { value = 250", 'slide = { value = "cm/160"')
    assert validate(parse_toml(formula, "cart.toml"), "cart.toml").parameters[1].value == 0.25


def test_typed_numbers_have_the_units_of_what_is_called_so():
    mechanism = cart(CART="rate", RAIL="s", PIN="m")
    assert units_of_number(mechanism, "rate.x") == ("m", "m")
    assert units_of_number(mechanism, "rate.vx") == ("m/s", "m/s")
    assert units_of_number(mechanism, "s.displacement") == ("m", "m")
    assert units_of_number(mechanism, "s.displacement.rate") == units_of_number(mechanism, "s.rate") == ("m/s", "m/s")
    assert units_of_number(mechanism, "m.angle.rate") == ("rad/s", "rad/s")

"""Units of files: what is one, what it means, what is none, and where it is refused."""

from __future__ import annotations

import math
import re
import tomllib
from fractions import Fraction
from pathlib import Path

import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from symgen.base import arguments
from symgen.base.errors import InputError
from symgen.base.unit_symbols import BASES, PLAIN, PREFIXABLE, PREFIXES, SYMBOLS
from symgen.base.units import Unit, known_unit, read_amount, read_unit, unit_of
from symgen.base.vocabulary.expressions import Call, Number
from symgen.describe.facts.typed_units import Typed, typed_numbers_in_si, units_of_number
from symgen.describe.files.load import parse_toml, set_parameters
from symgen.describe.files.validate import validate
from symgen.describe.mechanism import Mechanism

PAGE = Path(__file__).parents[3] / "docs" / "file-format" / "units.md"
INCH, POUND = 0.0254, 0.45359237

#: Unit -> its SI unit, and SI units in one of it.
UNITS: dict[str, tuple[str, float]] = {
    "m": ("m", 1.0),
    "mm": ("m", 1e-3),
    "cm": ("m", 1e-2),
    "km": ("m", 1e3),
    "um": ("m", 1e-6),
    "\u00b5m": ("m", 1e-6),
    "in": ("m", INCH),
    "ft": ("m", 12 * INCH),
    "deg": ("rad", math.pi / 180),
    "°": ("rad", math.pi / 180),
    "rev": ("rad", 2 * math.pi),
    "rpm": ("rad/s", math.pi / 30),
    "deg/s": ("rad/s", math.pi / 180),
    "rev/min": ("rad/s", math.pi / 30),
    "rad/s": ("rad/s", 1.0),
    "kN": ("N", 1e3),
    "MN": ("N", 1e6),
    "lbf": ("N", POUND * 9.80665),
    "N mm": ("N m", 1e-3),
    "kNm": ("N m", 1e3),
    "bar": ("Pa", 1e5),
    "MPa": ("Pa", 1e6),
    "GPa": ("Pa", 1e9),
    "psi": ("Pa", POUND * 9.80665 / INCH**2),
    "g": ("kg", 1e-3),
    "t": ("kg", 1e3),
    "lb": ("kg", POUND),
    "min": ("s", 60.0),
    "h": ("s", 3600.0),
    "ms": ("s", 1e-3),
    "us": ("s", 1e-6),
    "kHz": ("Hz", 1e3),
    "kW": ("W", 1e3),
    "PS": ("W", 735.49875),
    "kJ": ("J", 1e3),
    "kWh": ("J", 3.6e6),
    "kN/m": ("N/m", 1e3),
    "N/mm": ("N/m", 1e3),
    "N mm/deg": ("N m/rad", 0.18 / math.pi),
    "N s/mm": ("N s/m", 1e3),
    "g cm^2": ("kg m^2", 1e-7),
    "g/cm^3": ("kg/m^3", 1e3),
    "lb/in": ("kg/m", POUND / INCH),
    "km/h": ("m/s", 1 / 3.6),
    "mm/s^2": ("m/s^2", 1e-3),
    "mm²": ("m^2", 1e-6),
    "L/min": ("m^3/s", 1e-3 / 60),
    "N m/rpm": ("N m/(rad/s)", 30 / math.pi),
    "kW/(m K)": ("W/(m K)", 1e3),
    "1/min": ("1/s", 1 / 60),
    "%": ("1", 0.01),
}
#: Text that is no unit -> the end of the sentence about it.
WRONG = {
    **{"banana": "psi and the like", "m2": "did you mean 'm^2'?", "kg m2": "'m2' is no unit, did you mean 'm^2'?"},
    **{"meter": "did you mean 'm'?", "degree": "did you mean 'deg'?", "degrees": "did you mean 'deg'?"},
    **{"sec": "did you mean 's'?", "hour": "did you mean 'h'?", "Kg": "did you mean 'kg'?", "KN": "did you mean 'kN'?"},
    **{"kn/m": "'kn' is no unit, did you mean 'kN'?", "RPM": "did you mean 'rpm'?", "hz": "did you mean 'Hz'?"},
    **{"Mpa": "did you mean 'MPa'?", "inch": "did you mean 'in'?", "lbs": "did you mean 'lb'?"},
    **{"newtons": "did you mean 'N'?", "kph": "did you mean 'km/h'?", "rps": "did you mean 'rev/s'?"},
    **{"J/kg K": "as in 'W/(m K)'", "N/m s": "as in 'W/(m K)'", "a/b c": "'a' is no unit, did you mean 'A'?"},
    **{"m/": "", "/m": "", "m//s": "", "(m": "", "m)": "", "()": "", "m^": "", "m^0": "", "m^99": "", "m^1.5": ""},
    **{"m**-": "", "5": "", "mm mm 3": "", "E I / L^2": "'E' is no unit", "degC": "", "x": "", "kkg": "", "mum": ""},
    **{"<b>kg</b>": "", "m\n": "", "q" * 41: "at most 40 characters on one line", "furlong": "", "1e3 m": "", "-m": ""},
}


@pytest.mark.parametrize("text", UNITS)
def test_a_unit_has_its_factor(text):
    si, factor = UNITS[text]
    unit = unit_of(text, "here")
    assert unit.si == si and float(unit.factor) == pytest.approx(factor, rel=1e-15)
    assert unit.fits(known_unit(si)) and known_unit(si).is_si and known_unit(si).factor == 1
    assert unit.to_si(3.0) == pytest.approx(3.0 * factor, rel=1e-15)


@pytest.mark.parametrize("text", WRONG)
def test_what_is_no_unit_is_refused_in_a_sentence(text):
    with pytest.raises(InputError, match=re.escape("a.toml: parameters.l.unit: expected a unit such as 'kg m^2'")) as e:
        unit_of(text, "a.toml: parameters.l.unit")
    assert WRONG[text] in str(e.value) and "\n" not in str(e.value)


def test_there_are_enough_of_both():
    assert len(UNITS) >= 40 and len(WRONG) >= 40


@pytest.mark.parametrize(
    "text", ["", "m", "kg m^2", "N m s/rad", "N*m", "1", "J s", "N m/A", "ohm", "W/(m K)", "Nm", "1/s"]
)
def test_texts_of_si_units_stay_what_they_are(text):
    unit = known_unit(text)
    assert unit.is_si and unit.si == unit.text == text
    assert math.copysign(1.0, unit.to_si(-0.0)) == -1.0 and unit.to_si(0.1) == 0.1


symbols = st.sampled_from(sorted(SYMBOLS))
factors = st.tuples(symbols, st.integers(-3, 3).filter(bool)).map(lambda x: x[0] if x[1] == 1 else f"{x[0]}^{x[1]}")
products = st.lists(factors, min_size=1, max_size=3).map(" ".join)
units = st.one_of(products, st.tuples(products, products).map(lambda x: f"{x[0]}/({x[1]})")).filter(
    lambda x: len(x) <= 40
)


@example("rpm %", 0.0)
@example("GL^-1 GL^-1/(%^-1 GL^-1 GL^-1)", 0.0)  # whose text in the SI is longer than a file's may be
@given(units, st.floats(-1e6, 1e6, allow_subnormal=False).map(lambda x: float(f"{x:.14g}")))
def test_numbers_come_back(text, number):
    unit = known_unit(text)
    there = unit.to_si(number)
    if 1e-290 < abs(there) < 1e290:
        assert unit.from_si(there) == number
    assert known_unit(unit.si).factor == 1 and dict(known_unit(unit.si).exponents) == dict(unit.exponents)


@given(
    st.integers(-999999, 999999),
    st.integers(0, 6),
    st.sampled_from(["mm", "cm", "um", "kN", "g", "MPa", "ms", "kg mm^2"]),
)
def test_decimal_numbers_are_converted_without_rounding(digits, places, text):
    """600 mm is the double nearest to 0.6, not the product of two rounded numbers."""
    number = float(Fraction(digits, 10**places))
    assert known_unit(text).to_si(number) == float(Fraction(digits, 10**places) * known_unit(text).factor)


@pytest.mark.slow
@given(st.text(max_size=30))
def test_any_text_is_a_unit_or_none(text):
    unit = read_unit(text)
    assert isinstance(unit, Unit) or isinstance(unit, str)
    if isinstance(unit, Unit):
        assert unit.factor > 0 and {base for base, _ in unit.exponents} <= set(BASES)


def test_every_symbol_says_what_it_is_and_leads_to_si():
    for name, symbol in SYMBOLS.items():
        unit = known_unit(name)
        assert unit.factor == symbol.factor and known_unit(symbol.si).is_si and symbol.name


# -- in files ----------------------------------------------------------------------------------------------------------

ROD = """
[mechanism]
name = "rod"
gravity = [0.0, -9.81]
[parameters]
l = { value = 600, unit = "mm" }
half = { value = "l/2", unit = "cm" }
turn = "17 deg"
[inputs]
push = { default = 20, unit = "N mm" }
[states]
p = { rate = "0", start = "2 bar", unit = "Pa" }
[bodies.rod]
mass = "1500 g"
inertia = "450 kg cm^2"
points = { top = ["-half", 0.0], tip = ["30 cm", 0.0] }
position = ["half*cos(turn)", "half*sin(turn)"]
angle = "17 deg"
angular_velocity = "30 rpm"
[joints.pin]
type = "revolute"
between = ["ground", "rod"]
at = [["0 mm", 0.0], "top"]
friction = { sliding = "5 N mm", viscous = "2 N mm s" }
stop = { lower = "-170 deg", upper = "0.5 rev", restitution = "40 %" }
[forces.spring]
type = "spring-damper"
between = ["ground", "rod"]
at = [[0.0, "1 m"], "tip"]
stiffness = "2 N/mm"
free_length = "80 cm"
[forces.drive]
type = "torque"
body = "rod"
torque = "push"
[outputs]
lean = { value = "180/pi*rod.theta", unit = "deg" }
"""
IN_SI = {
    '{ value = 600, unit = "mm" }': '{ value = 0.6, unit = "m" }',
    'unit = "cm"': 'unit = "m"',
    '"17 deg"': repr(math.radians(17)),
    '{ default = 20, unit = "N mm" }': '{ default = 0.02, unit = "N m" }',
    '"2 bar"': "2e5",
    '"1500 g"': "1.5",
    '"450 kg cm^2"': "0.045",
    '"30 cm"': "0.3",
    '"30 rpm"': repr(math.pi),
    '"0 mm"': "0.0",
    '"5 N mm"': "0.005",
    '"2 N mm s"': "0.002",
    '"-170 deg"': repr(math.radians(-170)),
    '"0.5 rev"': repr(math.pi),
    '"40 %"': "0.4",
    '"1 m"': "1.0",
    '"2 N/mm"': "2000.0",
    '"80 cm"': "0.8",
}


def rod(text: str = ROD) -> Mechanism:
    return validate(parse_toml(text, "rod.toml"), "rod.toml")


def test_a_file_in_other_units_is_that_in_si_units():
    from msgspec import structs

    from symgen.describe.facts.digest import digest, mechanism_digest

    text = ROD
    for written, plain in IN_SI.items():
        assert written in text
        text = text.replace(written, plain)
    other, si = rod(), rod(text)
    unshown = tuple(structs.replace(p, shown="") for p in other.parameters)
    assert (*unshown[:2], unshown[3]) == (*si.parameters[:2], si.parameters[3])
    assert structs.replace(other, parameters=()) == structs.replace(si, parameters=())
    assert mechanism_digest(si) == mechanism_digest(structs.replace(other, parameters=si.parameters))
    # the one parameter whose file has no unit in the plain text
    assert digest(other) == digest(
        rod(text.replace(f"turn = {math.radians(17)!r}", 'turn = { value = 0.1, unit = "rad" }'))
    )
    assert [p.as_written(p.value) for p in other.parameters] == [(600, "mm"), (30, "cm"), (17, "deg"), (20, "N mm")]


@pytest.mark.parametrize(
    ("written", "other", "message"),
    [
        ('mass = "1500 g"', 'mass = "1500 mm"', "bodies.rod.mass: expected a unit such as kg, g, t, lb, got 'mm'"),
        (
            'mass = "1500 g"',
            'mass = "1500 gramm"',
            "bodies.rod.mass: expected a unit such as kg, g, t, lb, got 'gramm'; did",
        ),
        ('angle = "17 deg"', 'angle = "17 kg"', "bodies.rod.angle: expected a unit such as rad, deg, rev, got 'kg'"),
        ('velocity = "30 rpm"', 'velocity = "30 Hz"', "angular_velocity: expected a unit such as rad/s, deg/s, rpm"),
        (
            '["30 cm", 0.0]',
            '["30 s", 0.0]',
            "bodies.rod.points.tip: expected a unit such as m, mm, cm, km, in, got 's'",
        ),
        ('"450 kg cm^2"', '"450 kg cm"', "bodies.rod.inertia: expected a unit such as kg m^2, g cm^2, kg mm^2, got"),
        ('sliding = "5 N mm"', 'sliding = "5 N"', "joints.pin.friction.sliding: expected a unit such as N m, N mm"),
        ('"-170 deg"', '"-170 mm"', "joints.pin.stop.lower: expected a unit such as rad, deg, rev, got 'mm'"),
        ('"40 %"', '"40 deg"', "joints.pin.stop.restitution: expected a unit such as 1 or none, %, got 'deg'"),
        ('"2 N/mm"', '"2 N mm"', "forces.spring.stiffness: expected a unit such as N/m, N/mm, kN/m, got 'N mm'"),
        ('"2 bar"', '"2 mm"', "states.p.start: expected a unit such as Pa, MPa, GPa, bar, got 'mm'"),
        ('unit = "Pa"', 'unit = "bar"', "states.p.unit: expected an SI unit such as Pa, as formulas are, got 'bar'"),
        ('unit = "mm"', 'unit = "banana"', "parameters.l.unit: expected a unit such as 'kg m^2', got 'banana'"),
        (
            'turn = "17 deg"',
            'turn = { value = "17 deg", unit = "mm" }',
            "parameters.turn: expected a unit such as m, mm",
        ),
        ('"l/2", unit = "cm"', '"l - 5", unit = "cm"', "parameters.half: expected a formula of values in SI units"),
        (
            '"180/pi*rod.theta", unit = "deg"',
            '"rod.theta", unit = "mm"',
            "outputs.lean.unit: expected rad, the unit of",
        ),
        (
            '"180/pi*rod.theta", unit = "deg"',
            '"pin.angle.rate", unit = "m"',
            "expected rad/s, the unit of pin.angle.rate",
        ),
        (
            'mass = "1500 g"',
            'mass = "2*0.75 kg"',
            "make the number in kg a parameter",
        ),
    ],
)
def test_a_unit_of_another_quantity_is_refused(written, other, message):
    assert written in ROD
    with pytest.raises(InputError, match=re.escape(message)) as error:
        rod(ROD.replace(written, other, 1))
    assert "\n" not in str(error.value)


def test_where_no_unit_is_read_the_number_in_si_units_is_said():
    with pytest.raises(InputError, match=re.escape("got '600 mm'; numbers are in SI units here: 0.6")):
        arguments.number("parameters 'l'", "600 mm")


@pytest.mark.parametrize(
    ("quantity", "unit", "factor"),
    [
        ("rod.theta", "deg", 180.0 / math.pi),
        ("rod.tip.x", "mm", 1000.0),
        ("pin.angle.rate", "rpm", 30.0 / math.pi),
        ("spring.force", "kN", 0.001),
    ],
)
def test_an_output_of_one_quantity_is_converted_to_its_unit(quantity: str, unit: str, factor: float) -> None:
    """It was refused, with the formula that does it."""
    plain, converted = (
        rod(ROD.replace('"180/pi*rod.theta", unit = "deg"', f'"{quantity}"{own}', 1)).outputs[0]
        for own in ("", f', unit = "{unit}"')
    )
    value = converted.value
    assert isinstance(value, Call) and value.function == "mul" and value.arguments[1] == plain.value
    assert isinstance(value.arguments[0], Number) and value.arguments[0].value == pytest.approx(factor, rel=1e-15)
    assert converted.unit == unit


def test_times_of_runs_may_have_units() -> None:
    times = rod(f'{ROD}[run]\nuntil = "2 min"\nstep = "5 ms"\noutput_step = 0.1\nmax_step = "0.5 s"\n').defaults
    assert (times.until, times.step, times.output_step, times.max_step) == (120.0, 0.005, 0.1, 0.5)
    for text, told in (("2 kg", "expected a unit such as s"), ("soon", "one with its unit"), ("-1 s", "above 0")):
        with pytest.raises(InputError, match=f"run.until: .*{told}"):
            rod(f'{ROD}[run]\nuntil = "{text}"\n')


def test_values_from_python_are_in_si_units():
    raw = tomllib.loads(ROD)
    changed = validate(set_parameters(raw, {"l": 0.5, "turn": 0.25}, "rod.toml"), "rod.toml")
    assert {p.name: p.value for p in changed.parameters} == {"l": 0.5, "half": 0.25, "turn": 0.25, "push": 0.02}
    assert [p.shown for p in changed.parameters] == ["mm", "cm", "deg", "N mm"]


def test_typed_numbers_are_in_the_unit_of_the_file():
    def typed(text: str) -> Typed:
        amount = read_amount(text)
        assert amount is not None
        return Typed.from_amount(amount)

    names = ("l", "half", "turn", "rod.theta", "rod.vx", "pin.angle", "pin.angle.rate", "p", "unknown")
    values = {name: typed("500") for name in names}
    values |= {"rod.omega": typed("30 rpm"), "rod.x": typed("2 cm"), "push": typed("1 N m"), "rod.y": 0.25}
    expected = {"l": 0.5, "half": 5.0, "turn": math.radians(500), **dict.fromkeys(names[3:], 500.0)}
    expected |= {"rod.omega": math.pi, "rod.x": 0.02, "push": 1.0, "rod.y": 0.25}
    assert typed_numbers_in_si(rod(), values, "--set") == expected
    with pytest.raises(InputError, match=r"^--start rod\.x: expected a unit such as m, mm, cm, km, in, got 'deg'$"):
        typed_numbers_in_si(rod(), {"rod.x": typed("5 deg")}, "--start")
    assert units_of_number(rod(), "l") == ("m", "mm")


# -- the page ----------------------------------------------------------------------------------------------------------


def table_of_symbols() -> str:
    """The table of the page: symbols with what they are in SI units."""
    lines = ["| unit | is | in SI units |", "| --- | --- | --- |"]
    for symbols, prefixed in ((PREFIXABLE, True), (PLAIN, False)):
        for name, symbol in symbols.items():
            value = f"{float(symbol.factor):.9g} {symbol.si}".removesuffix(" 1") if symbol.factor != 1 else symbol.si
            mark = f"`{name}`, with prefixes" if prefixed else f"`{name}`"
            lines.append(f"| {mark} | {symbol.name} | {value} |")
    return "\n".join(lines)


def test_the_page_has_the_table_of_all_units():
    text = PAGE.read_text(encoding="utf-8")
    assert table_of_symbols() in text
    assert ", ".join(f"`{prefix}` 10^{power}" for prefix, power in PREFIXES.items()) in " ".join(text.split())

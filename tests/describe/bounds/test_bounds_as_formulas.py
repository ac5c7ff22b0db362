"""Bounds of friction and ends of stops as formulas: what they mean, and one sentence for what has no meaning."""

import pytest

import symgen
from symgen.base.errors import InputError
from symgen.describe.bounds.bounded_modes import mode_events
from symgen.describe.facts.kinks import changes_in_time, discontinuities_of, jumps_in_time
from symgen.describe.files.load import parse_toml
from symgen.describe.files.validate import validate
from symgen.describe.mechanism import Mechanism

PIN = """
[mechanism]
name = "pin"

[parameters]
most = 3.0

[inputs]
pressure = 1.0

[states]
heat = {{ rate = "0.0", start = 0.0 }}

[tables]
curve = {{ x = [0.0, 1.0, 2.0], y = [3.0, 2.0, 1.0] }}

[bodies.arm]
mass = 1.0
inertia = 1.0

[joints.pin]
type = "{kind}"
between = ["ground", "arm"]
at = [[0.0, 0.0], "centre"]
{keys}
"""


def described(keys: str, kind: str = "revolute") -> Mechanism:
    if kind == "translational":
        keys = f"axis = [1.0, 0.0]\n{keys}"
    return validate(parse_toml(PIN.format(keys=keys, kind=kind), "pin.toml"), "pin.toml")


def test_bounds_of_parameters_are_as_before() -> None:
    """A bound of parameters is a number of its row; one of more is read by margins, and is none below 0."""
    (plain,) = described('friction = { sliding = "2*most" }').bounded
    assert not plain.changing
    for text in ("most*t", "pressure", "heat", "arm.theta", "pin.angle", "curve(t)", "max(most, arm.omega)"):
        (row,) = described(f'friction = {{ sliding = "{text}" }}').bounded
        assert row.changing
        assert row.numbers[0][1] == row.numbers[1][1]
    (by_rate,) = described('friction = { sliding = "1 + exp(-rate)" }').bounded
    assert not by_rate.changing  # at rest it is a number


def test_what_runs_are_told_of_bounds() -> None:
    """Jumps and kinks of bounds are those of the run; own rates are not, where modes change."""
    mechanism = described('friction = { sliding = "2 if t < 1 else 1", static = "3 if arm.theta < 1 else 2" }')
    assert changes_in_time(mechanism)
    assert len(jumps_in_time(mechanism)[1]) == 1
    assert any(x.jumps for x in discontinuities_of(mechanism))
    assert discontinuities_of(described('friction = { sliding = 1.0, static = "1 + most" }')) == ()
    keys = "{ sliding = 1.0, static = 2.0, stribeck_speed = 1.0, stribeck_exponent = 1.5 }"
    assert discontinuities_of(described(f"friction = {keys}")) == ()


def test_margins_of_carriers_read_bounds_that_vary() -> None:
    """A row in force may carry one whose bound varies: its margin reads that bound; constant ones are its numbers."""
    text = PIN.format(keys='friction = { sliding = "pressure" }', kind="revolute")
    text += '[joints.stop]\ntype = "revolute"\nbetween = ["ground", "arm"]\nat = [[0.0, 0.0], "centre"]\n'
    text += "friction = { sliding = 1.0 }\nstop = { lower = -1.0 }\n"
    mechanism = validate(parse_toml(text, "pin.toml"), "pin.toml")
    events = {event.name: repr(event.when) for event in mode_events(mechanism)}
    assert "pin.friction.limit" in events["stop.slip"]
    assert "pin.friction.limit" in events["stop.lower.leave"]
    assert "stop.friction.limit" not in events["pin.slip"]


@pytest.mark.parametrize(
    ("keys", "sentence"),
    [
        (
            'friction = { sliding = "presure" }',
            "friction.sliding: got the unknown name 'presure'; did you mean 'pressure",
        ),
        ('friction = { sliding = 1.0, static = "2 + rate" }', "friction.static: expected a number or an expression"),
        ('friction = { sliding = "-most" }', "friction.sliding: expected a value of at least 0, got -3.0"),
        ('friction = { sliding = "most", static = "most/2" }', "friction.static: expected a bound of at least that"),
        ("friction = { sliding = { forwards = 1.0 } }", "friction.sliding"),
        (
            "friction = { sliding = { forwards = 1.0, backwards = 0.0 }, static = 0.5 }",
            "friction.static: expected a bound of at least that in motion (1.0), got 0.5",
        ),
        (
            "friction = { sliding = { forwards = 0.0, backwards = 0.0 }, static = 0.5 }",
            "friction.sliding: expected a value above 0, as that at rest is above 0, got 0.0",
        ),
        (
            "friction = { sliding = { forwards = 1.0, backwards = 0.0 }, stribeck_speed = 2.0 }",
            "friction.stribeck_speed: expected no such key beside bounds of two directions",
        ),
        (
            "friction = { sliding = { forwards = -1.0, backwards = 0.0 } }",
            "friction.sliding.forwards: expected a value",
        ),
        ("friction = { sliding = { forwards = 1.0, back = 0.0 } }", "friction.sliding"),
        (
            "friction = { coefficient = { forwards = 0.1, backwards = 0.0 }, radius = 0.1 }",
            "friction.coefficient: expected a number or an expression of t, parameters and body coordinates",
        ),
        ("friction = { sliding = 1.0, stribeck_exponent = 1.0 }", "friction.stribeck_exponent: expected the key"),
        (
            "friction = { sliding = 1.0, static = 2.0, stribeck_speed = 1.0, stribeck_exponent = 0.5 }",
            "friction.stribeck_exponent: expected a value of at least 1, got 0.5",
        ),
        ('friction = { sliding = "5 kg" }', "friction.sliding"),
        ("stop = { lower = 0.0, damping = 1.0 }", "stop.damping: expected the key stiffness beside it, got 1.0"),
        (
            "stop = { lower = 0.0, stiffness = 1.0, restitution = 0.5 }",
            "stop.restitution: expected no such key beside stiffness, as damping takes the energy, got 0.5",
        ),
        ("stop = { lower = 0.0, stiffness = 0.0 }", "stop.stiffness: expected a value above 0, got 0.0"),
        ("stop = { lower = 0.0, stiffness = 1.0, damping = -1.0 }", "stop.damping: expected a value of at least 0"),
        ('stop = { lower = "arm.omega" }', "stop.lower: expected"),
        ('stop = { lower = "heat" }', "stop.lower: expected"),
        ('stop = { lower = "curve(t)" }', "stop.lower: expected"),
        ("stop = { lower = 1.0, upper = 0.5 }", "stop.upper: expected a value above that of lower (1.0), got 0.5"),
    ],
)
def test_what_has_no_meaning(keys: str, sentence: str) -> None:
    with pytest.raises(InputError) as error:
        described(keys)
    assert sentence in str(error.value)


def test_units_of_the_new_keys() -> None:
    """Numbers with units, of angles and of displacements."""
    turned = described('friction = { sliding = { forwards = "0 N m", backwards = "2 kN m" } }').bounded[0]
    slid = described('friction = { sliding = { forwards = "0 N", backwards = "2 kN" } }', "translational").bounded[0]
    assert turned.numbers[0][1] == slid.numbers[0][1] == described(
        "friction = { sliding = { forwards = 0.0, backwards = 2000.0 } }"
    ).bounded[0].numbers[0][1]  # fmt: skip
    with pytest.raises(InputError, match=r"friction\.sliding\.backwards"):
        described('friction = { sliding = { forwards = 0.0, backwards = "2 N" } }')
    elastic = described('stop = { lower = "1 mm", stiffness = "2 N/mm", damping = "3 N s/m" }', "translational")
    assert elastic.forces == described(
        "stop = { lower = 0.001, stiffness = 2000.0, damping = 3.0 }", "translational"
    ).forces  # fmt: skip


def test_bands_say_why_there_is_none() -> None:
    """A band of positions that friction holds has bounds that are numbers, the same in both directions."""
    for sliding, why in (
        ("pressure", "are formulas of more"),
        ("forwards = 0.0, backwards = 2.0", "differ in the two"),
    ):
        bound = f'"{sliding}"' if sliding == "pressure" else f"{{ {sliding} }}"
        text = PIN.format(keys=f"friction = {{ sliding = {bound} }}", kind="revolute").replace("[states]", "[outputs]")
        text = text.replace('heat = { rate = "0.0", start = 0.0 }', 'heat = "t"').replace('"centre"', "[0.0, 0.1]")
        text = text.replace('name = "pin"', 'name = "pin"\ngravity = [0.0, -9.81]')
        model = symgen.load(validate(parse_toml(text, "pin.toml"), "pin.toml"))
        (note,) = [note for note in model.equilibrium().notes if "no band" in note]
        assert why in note

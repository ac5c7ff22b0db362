"""`"centre"` is a centre of mass and `"origin"` the origin of a frame; check warns where the two differ at a joint."""

import json

import pytest
from support.emitted import mechanism_of

import symgen
from symgen.describe.formulas.evaluate import evaluate_formula

BAR = {"mass": 2.0, "inertia": 0.5, "centre_of_mass": [0.45, -0.15], "position": [0.0, 0.0], "angle": 0.0}


def pinned(point, **body):
    """Return a body that is pinned to the ground at one of its points."""
    pin = {"type": "revolute", "between": ["ground", "bar"], "at": [[0.0, 0.0], point]}
    raw = {"mechanism": {"name": "bar", "gravity": [0.0, -10.0]}, "bodies": {"bar": BAR | body}, "joints": {"pin": pin}}
    return symgen.load(mechanism_of(raw))


def test_a_pin_at_the_origin_gives_the_weight_its_lever():
    """alpha = -m g x / (J + m r^2) by hand; at the centre of mass the weight turns nothing."""
    inertia = 0.5 + 2.0 * (0.45**2 + 0.15**2)
    swings = pinned("origin").simulate(until=1e-4)
    assert swings.a["bar.alpha"][0] == pytest.approx(-2.0 * 10.0 * 0.45 / inertia, rel=1e-12)
    rests = pinned("centre").simulate(until=1e-4)
    assert abs(rests.a["bar.alpha"][0]) < 1e-12


def test_a_point_that_a_body_calls_origin_is_its_own():
    own = pinned("origin", points={"origin": [0.45, -0.15]}).simulate(until=1e-4)
    assert abs(own.a["bar.alpha"][0]) < 1e-12


def test_an_inertia_may_refer_to_the_origin():
    space = {"name": "bar", "space": "spatial", "gravity": [0.0, 0.0, -10.0]}
    body = {"mass": 2.0, "inertia": [0.1, 0.7, 0.7], "inertia_at": "origin", "centre_of_mass": [0.3, 0.0, 0.0]}
    mechanism = mechanism_of({"mechanism": space, "bodies": {"bar": body}})
    entries = [evaluate_formula(x, {}) for x in mechanism.bodies[0].inertia[:3]]
    assert entries == pytest.approx([0.1, 0.7 - 2.0 * 0.09, 0.7 - 2.0 * 0.09])


@pytest.mark.parametrize(
    ("point", "body", "said"),
    [
        ("centre", {}, 1),
        ("origin", {}, 0),
        ([0.45, -0.15], {}, 0),
        ("middle", {"points": {"middle": [0.45, -0.15]}}, 0),
        ("centre", {"centre_of_mass": [0.0, 0.0]}, 0),
    ],
)
def test_only_a_centre_beside_the_origin_is_warned_of(point, body, said):
    assert len(pinned(point, **body).mechanism.remarks) == said


def test_check_says_what_where_and_what_to_write(cli, tmp_path):
    file = tmp_path / "bar.toml"
    file.write_text(
        '[mechanism]\nname = "bar"\n[parameters]\narm = 0.45\n[bodies.bar]\nmass = 1.0\ninertia = 1.0\n'
        'centre_of_mass = ["arm", 0.0]\n[joints.pin]\ntype = "revolute"\nbetween = ["ground", "bar"]\n'
        'at = [[0.45, 0.0], "centre"]\n'
    )
    code, out, _ = cli("check", str(file))
    sentence = (
        'joints.pin.at: "centre" is the centre of mass of bar, [0.45, 0] m in its frame; '
        'write "origin" for the origin of the frame, or name the point if the centre of mass is meant'
    )
    assert code == 0 and f"  warning: {sentence}\n" in out
    code, out, _ = cli("check", str(file), "--json")
    assert json.loads(out)["warnings"] == [sentence]

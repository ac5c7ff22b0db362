"""Starts: closed, completed, projected and noted, or refused; and what cannot be assembled is named."""

import copy
import re
import warnings

import numpy as np
import pytest
from support import reference
from support.emitted import mechanism_of
from support.models import parallelogram
from support.plain import Plain

from symgen.api import load
from symgen.base.errors import AssemblyError, InputError
from symgen.describe.catalogue import raw


def start_of(description, **settings):
    model = load(mechanism_of(description))
    return model.assemble(model.compile("lagrange"), **settings)


def changed(name, *path_and_value):
    """A catalogue description with one value changed."""
    description = copy.deepcopy(raw(name))
    *path, last, value = path_and_value
    part = description
    for key in path:
        part = part[key]
    part[last] = value
    return description


def residuals(description, start):
    """(|Phi|, |D v - nu|) of a start by the reference."""
    plain = Plain(description)
    n = plain.size
    q, v = start.y[:n].tolist(), start.y[n : 2 * n].tolist()
    drift = list(reference.velocity_residual(plain, 0.0, q, v).values())
    return np.linalg.norm(list(plain.phi(0.0, q).values())), np.linalg.norm(drift)


def test_a_consistent_start_is_left_alone():
    description = raw("four-bar")
    start = start_of(description, strict=True)
    assert start.notes == () and start.rank == 8 and start.redundant_rows == ()
    np.testing.assert_allclose(start.y[:9], load("four-bar").initial_state(Plain(description).values)[0], atol=1e-12)
    assert max(residuals(description, start)) <= 1e-13


def test_positions_are_closed_with_the_smallest_change_and_noted():
    description = changed("four-bar", "bodies", "crank", "angle", 1.2)
    start = start_of(description)
    assert max(residuals(description, start)) <= 1e-13
    assert len(start.notes) == 1 and "the shortest changes close" in start.notes[0]
    with pytest.raises(InputError, match=r"initial state: expected a consistent start \(`strict`\)"):
        start_of(description, strict=True)


def test_one_newton_step_is_the_pseudoinverse():
    """Near the constraints a coordinate changes by -C (D C)^+ Phi to second order, angles over bodies' lengths."""
    description = changed("four-bar", "bodies", "crank", "angle", np.pi / 3 + 1e-5)
    plain = Plain(description)
    model = load(mechanism_of(description))
    q, _ = model.initial_state(plain.values)
    d = np.array(list(reference.jacobian(plain, 0.0, q.tolist(), [0.0] * 9).values()))
    # lengths of the bars, between whose ends the pins are
    scale = np.array([1.0, 1.0, 1.0 / 2.0, 1.0, 1.0, 1.0 / 8.0, 1.0, 1.0, 1.0 / 5.0])
    expected = -scale * (np.linalg.pinv(d * scale) @ np.array(list(plain.phi(0.0, q.tolist()).values())))
    np.testing.assert_allclose(start_of(description).y[:9] - q, expected, atol=1e-9)


def test_velocities_follow_from_one_that_is_given():
    description = raw("slider-crank")
    start = start_of(description, strict=True)
    v = dict(
        zip((q.name for q in load("slider-crank").compile("lagrange").info.velocities), start.y[9:18], strict=True)
    )
    assert v["crank.omega"] == pytest.approx(10.0, abs=1e-12)
    assert residuals(description, start)[1] <= 1e-13
    # velocity of the slider of an in-line slider-crank, by differentiating r cos(phi) + sqrt(l^2 - r^2 sin(phi)^2)
    r, length, phi, w = 0.15, 0.45, np.pi / 4, 10.0
    expected = -r * w * np.sin(phi) * (1 + r * np.cos(phi) / np.sqrt(length**2 - (r * np.sin(phi)) ** 2))
    assert v["slider.vx"] == pytest.approx(expected, rel=1e-12)


def test_velocities_follow_from_a_driver():
    description = raw("driven-four-bar")
    for body in description["bodies"].values():
        body.pop("angular_velocity", None)
    start = start_of(description, strict=True)
    assert start.y[11] == pytest.approx(2 * np.pi, rel=1e-13)
    assert residuals(description, start)[1] <= 1e-12


def test_missing_velocities_are_the_smallest_ones():
    """Of all velocities that fulfil the constraints and the given ones, those of least norm."""
    description = parallelogram()
    del description["bodies"]["link0"]["angular_velocity"]
    assert np.abs(start_of(description).y[12:24]).max() <= 1e-14


def test_velocities_that_contradict_are_projected_with_the_mass_matrix():
    description = changed("four-bar", "bodies", "crank", "velocity", [3.0, 1.0])
    start = start_of(description)
    assert len(start.notes) == 1 and "projected in the metric of the mass matrix" in start.notes[0]
    assert "crank." in start.notes[0] or "coupler." in start.notes[0]
    assert residuals(description, start)[1] <= 1e-12
    with pytest.raises(InputError, match="velocities contradicted"):
        start_of(description, strict=True)
    # M (v - v0) has no part along the directions in which the mechanism can move
    plain = Plain(description)
    q, v = start.y[:9], start.y[9:18]
    d = np.array(list(reference.jacobian(plain, 0.0, q.tolist(), v.tolist()).values()))
    free = np.linalg.svd(d)[2][-1]
    given = np.array([3.0, 1.0, 0.0, *start.y[12:18]])
    assert abs(free @ d.T @ np.linalg.lstsq(d.T, reference.masses(plain) * (v - given), rcond=None)[0]) <= 1e-9


@pytest.mark.parametrize(
    ("name", "path", "value", "joint"),
    [
        ("four-bar", ("bodies", "coupler", "points"), {"B": [-1.0, 0.0], "C": [1.0, 0.0]}, "[ABCD]"),
        ("slider-crank", ("joints", "guide", "at"), [[0.0, 2.0], "centre"], "[OPQ]|guide"),
    ],
)
def test_what_cannot_be_assembled_names_the_joint_and_the_gap(name, path, value, joint):
    with pytest.raises(AssemblyError) as caught:
        start_of(changed(name, *path, value))
    found = re.search(rf"{name}: .* joint '({joint})' stays open by ([\d.]+) m( or rad)?; check", str(caught.value))
    assert found, str(caught.value)
    assert float(found.group(2)) > 0.1
    assert caught.value.exit_code == 2


def test_a_gap_whose_square_overflows_is_named_without_a_warning():
    """Warnings are errors in the tests; the gap of joint O is |x + 0.5| m, whose square no number holds."""
    with pytest.raises(AssemblyError, match=r"joint 'O' stays open by 3e\+302 m; check its points"):
        start_of(changed("spherical-double-pendulum", "bodies", "upper", "position", [-3e302, 0.0, 0.0]))


def test_links_that_never_close_are_named_with_the_gap_of_a_pin_in_metres():
    """Links of 0.1, 0.3 and 0.2 m do not reach over 1 m from any start."""
    raw = {"mechanism": {"name": "short"}, "bodies": {}, "joints": {}}
    for name, length, x in (("a", 0.1, 0.05), ("b", 0.3, 0.25), ("c", 0.2, 0.9)):
        points = {"l": [-0.5 * length, 0.0], "r": [0.5 * length, 0.0]}
        raw["bodies"][name] = {"mass": 1.0, "inertia": 0.1, "position": [x, 0.1], "points": points}
    ends = {"A": ("ground", [0.0, 0.0], "a", "l"), "B": ("a", "r", "b", "l"), "C": ("b", "r", "c", "l")}
    for name, (one, at, other, point) in (ends | {"D": ("ground", [1.0, 0.0], "c", "r")}).items():
        raw["joints"][name] = {"type": "revolute", "between": [one, other], "at": [at, point]}
    with pytest.raises(AssemblyError, match=r"stays open by 0\.\d+ m; .* whether the links are long enough to meet at"):
        start_of(raw)


def test_velocities_that_no_motion_has_are_an_error():
    description = changed("four-bar", "joints", "motor", {"type": "driver", "joint": "A", "value": "pi/3 + 2*t"})
    description["joints"]["second"] = {"type": "driver", "joint": "D", "value": "1.8938968124057762 - 5*t"}
    with pytest.raises(AssemblyError, match="no velocities satisfy the constraints"):
        start_of(description)


@pytest.mark.parametrize("value", [0.0, -2.0])
def test_a_mass_that_is_not_positive_is_refused(value):
    model = load("four-bar")
    with warnings.catch_warnings():  # what is refused anyway shall not add noise of its own
        warnings.simplefilter("error")
        with pytest.raises(InputError, match="mass or inertia of crank: expected a value above 0"):
            model.assemble(model.compile("lagrange"), {"crank_mass": value})


def test_redundant_rows_are_found():
    start = start_of(parallelogram())
    assert start.rank == 11 and len(start.redundant_rows) == 1

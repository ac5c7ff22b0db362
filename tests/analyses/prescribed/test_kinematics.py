"""Prescribed motions against elementary geometry, closed forms, and integration."""

import json
import math
from itertools import pairwise

import numpy as np
import pytest
from support.models import parallelogram
from support.twin import spatial_twin

import symgen
from analyses import rods
from analyses.linkages import four_bar, meeting
from analyses.rods import of_raw as model
from symgen.base.errors import InputError
from symgen.cli import main

CRANK = "start + 2*pi*t"


def slider_crank(slide):
    """A crank of 1 m and a rod of 3 m; the slider is driven where `slide` says how it moves, else the crank is."""
    raw = four_bar((3.0, 1.0, 3.0, 2.5), 0.7, CRANK if slide is None else None)
    raw["bodies"].pop("rocker"), raw["joints"].pop("D")
    far = math.cos(0.7) + math.sqrt(9.0 - math.sin(0.7) ** 2)
    raw["bodies"]["slider"] = {"mass": 1.0, "inertia": 1.0, "position": [far, 0.0]}
    middle = [(math.cos(0.7) + far) / 2.0, math.sin(0.7) / 2.0]
    raw["bodies"]["coupler"] |= {"position": middle, "angle": -math.asin(math.sin(0.7) / 3.0)}
    raw["joints"]["C"] = rods.pin("coupler", "slider", "far", "centre")
    raw["joints"]["rail"] = rods.pin("ground", "slider", rods.GROUND2, "centre", "prismatic", axis=[1.0, 0.0])
    if slide is not None:
        raw["joints"]["motor"] = {"type": "driver", "joint": "rail", "value": slide}
    return raw


@pytest.fixture(scope="module")
def rhombus():
    return model(four_bar((1.0, 1.0, 1.0, 1.0), 0.7, CRANK))


@pytest.fixture(scope="module")
def driven():
    return symgen.load("driven-four-bar")


# -- positions ---------------------------------------------------------------------------------------------------------


def test_positions_of_a_four_bar_are_where_circles_meet(driven):
    found = driven.kinematics(np.linspace(0.0, 2.0, 401))
    angle = math.pi / 3.0 + 2.0 * math.pi * found.t
    b = 2.0 * np.column_stack([np.cos(angle), np.sin(angle)])
    c = meeting(b, 8.0, [10.0, 0.0], 5.0)
    assert np.abs(found.curve("coupler.B") - b).max() < 1e-13
    assert np.abs(found.curve("coupler.C") - c).max() < 1e-13
    assert np.abs(found["crank.theta"] - angle).max() < 1e-14


@pytest.mark.slow
def test_the_foot_of_a_jansen_leg_is_where_circles_meet():
    found = symgen.load("jansen-leg").kinematics(np.linspace(0.0, 1.5, 301))
    p = found.parameters
    speed, tip = p["speed"], p["m"]
    at = speed * found.t
    pin = tip * np.column_stack([np.cos(at), np.sin(at)])
    pivot = np.broadcast_to([-p["a"], -p["l"]], pin.shape)
    # the letters of the publication: each joint by two circles, on the side on which it is drawn
    shoulder = meeting(pivot, p["b"], pin, p["j"])
    knee = meeting(pivot, p["c"], pin, p["k"], left=False)
    hip = meeting(pivot, p["d"], shoulder, p["e"])
    top = meeting(knee, p["g"], hip, p["f"])
    foot = meeting(knee, p["i"], top, p["h"])
    assert np.abs(found.curve("upper.shoulder") - shoulder).max() < 1e-13
    assert np.abs(found.curve("leg.knee") - knee).max() < 1e-13
    assert np.abs(found.curve("upper.hip") - hip).max() < 1e-13
    assert np.abs(found.curve("leg.foot") - foot).max() < 1e-13
    assert found.ok


def test_velocities_and_accelerations_are_those_of_the_positions(driven):
    """Slopes of the rocker's angle in closed form, by a complex step and a difference of such."""

    def rocker(t):
        angle = math.pi / 3.0 + 2.0 * math.pi * t
        bx, by = 2.0 * np.cos(angle) - 10.0, 2.0 * np.sin(angle)
        d2 = bx * bx + by * by  # from D to B, whose angle is atan(by / bx) + pi
        return np.arctan(by / bx) + math.pi - np.arccos((d2 + 25.0 - 64.0) / (10.0 * np.sqrt(d2)))

    t = np.linspace(0.0, 1.0, 37)
    found = driven.kinematics(t)
    h = 1e-30
    assert np.abs(found["rocker.theta"] - rocker(t)).max() < 1e-14
    assert np.abs(found["rocker.omega"] - rocker(t + 1j * h).imag / h).max() < 1e-13

    def rate(t):
        return rocker(t + 1j * h).imag / h

    e = 1e-3  # differences of fourth order, three times extrapolated
    central = [(rate(t + e / k) - rate(t - e / k)) * k / (2.0 * e) for k in (1, 2, 4)]
    once = [(4.0 * b - a) / 3.0 for a, b in pairwise(central)]
    assert np.abs(found["rocker.alpha"] - (16.0 * once[1] - once[0]) / 15.0).max() < 1e-9


@pytest.mark.slow
def test_a_platform_moves_as_its_legs_were_made_for():
    found = symgen.load("stewart-platform").kinematics(np.array([-0.3, 0.0, 0.21, 1.37]))
    p, t = found.parameters, found.t
    w = p["w"]
    assert np.abs(found["platform.x"] - p["surge"] * np.sin(w * t)).max() < 1e-14
    assert np.abs(found["platform.z"] - 1.0 - p["heave"] * np.sin(2.0 * w * t)).max() < 1e-14
    assert np.abs(found["platform.vy"] - p["sway"] * w * np.sin(w * t)).max() < 1e-13
    assert np.abs(found["platform.ax"] + p["surge"] * w**2 * np.sin(w * t)).max() < 1e-12
    assert np.abs(found["platform.alphaz"] + p["yaw"] * w**2 * np.sin(w * t)).max() < 1e-12
    assert np.abs(np.sin(0.5 * p["yaw"] * np.sin(w * t)) - found["platform.e3"]).max() < 1e-14


def test_integration_agrees(driven):
    run = driven.simulate(method="direct-correction", integrator="dop853", rtol=1e-13, until=1.0, times=(0.4, 1.0))
    found = driven.kinematics(run.t)
    for name in ("coupler.x", "rocker.theta", "coupler.omega", "rocker.vx"):
        assert np.abs(found[name] - run[name]).max() < 1e-11 * max(1.0, np.abs(run[name]).max())
    for name in run.reactions.names:
        scale = np.abs(run.reactions.values).max()
        assert np.abs(found.reactions[name] - run.reactions[name]).max() < 1e-11 * scale


def test_far_times_keep_the_branch(driven):
    """One turn a second: a quarter of a turn at once, and times in any density, give the same."""
    coarse = driven.kinematics([0.0, 0.25, 0.5, 3.75])
    fine = driven.kinematics(np.linspace(0.0, 3.75, 1501))
    at = [0, 100, 200, 1500]
    assert np.abs(coarse.q.values - fine.q.values[at]).max() < 1e-13
    assert np.abs(coarse.a.values - fine.a.values[at]).max() < 1e-10


def test_the_branch_is_the_one_that_is_described():
    """The same linkage with the pin C on the other side of the line from B to D."""
    found = model(four_bar((3.0, 1.0, 3.0, 2.5), 0.7, CRANK, above=False)).kinematics(np.linspace(0.0, 1.0, 11))
    at = 0.7 + 2.0 * math.pi * found.t
    c = meeting(np.column_stack([np.cos(at), np.sin(at)]), 3.0, [3.0, 0.0], 2.5, left=False)
    assert np.abs(found.curve("coupler.far") - c).max() < 1e-13


@pytest.mark.slow
def test_another_branch_is_chosen_by_a_start(driven):
    """The coupler's pin below the line from B to D, though the file has it above."""
    found = driven.kinematics(np.linspace(0.0, 2.0, 41), start={"rocker.theta": -2.3})
    angle = math.pi / 3.0 + 2.0 * math.pi * found.t
    b = 2.0 * np.column_stack([np.cos(angle), np.sin(angle)])
    c = meeting(b, 8.0, [10.0, 0.0], 5.0, left=False)
    assert np.abs(found.curve("coupler.C") - c).max() < 1e-13
    assert any(note.startswith("2 ways to close it are known") for note in found.notes)
    described = driven.kinematics([0.0, 1.0], start={"rocker.theta": 2.0})
    assert np.abs(described.q.values - driven.kinematics([0.0, 1.0]).q.values).max() < 1e-12
    meant = r"start 'rocker\.omega': .*did you mean 'rocker\.theta'\? \(expected a coordinate of a body or joint"
    with pytest.raises(InputError, match=meant):
        driven.kinematics([0.0, 1.0], start={"rocker.omega": 1.0})


@pytest.mark.slow
def test_massless_links_have_kinematics_and_forces_along_them():
    raw = four_bar((3.0, 1.0, 3.0, 2.5), 0.7, CRANK)
    raw["bodies"]["coupler"] |= {"mass": 0.0, "inertia": 0.0}
    found = model(raw).kinematics(np.linspace(0.0, 1.0, 9))
    force = np.column_stack([found.reactions["B.Fx"], found.reactions["B.Fy"]])
    way = found.curve("coupler.far") - found.curve("coupler.near")
    cross = force[:, 0] * way[:, 1] - force[:, 1] * way[:, 0]
    assert np.abs(cross).max() < 1e-10 * np.abs(force).max()
    lever = found.curve("crank.far")
    moment = force[:, 0] * lever[:, 1] - force[:, 1] * lever[:, 0] + 0.5 * 9.81 * lever[:, 0]
    assert np.abs(found.efforts["motor"] - moment).max() < 1e-9  # the crank turns steadily


@pytest.mark.slow
def test_looped_code_gives_the_same(driven):
    times = np.linspace(0.0, 0.5, 11)
    looped, straight = driven.kinematics(times, shape="looped"), driven.kinematics(times)
    for table in ("q", "v", "a", "reactions", "points"):
        own, other = getattr(looped, table).values, getattr(straight, table).values
        assert np.abs(own - other).max() < 1e-11 * np.abs(other).max()


@pytest.mark.slow
def test_forces_of_inputs_that_jump_reach_the_motor():
    raw = four_bar((3.0, 1.0, 3.0, 2.5), 0.7, CRANK)
    raw["inputs"] = {"load": {"default": 0.0, "unit": "N m"}}
    raw["forces"] = {"brake": {"type": "torque", "body": "crank", "torque": "load"}}
    times = [0.0, 0.2, 0.3, 0.4]
    free = model(raw).kinematics(times)
    found = model(raw).kinematics(times, inputs={"load": "2 if t > 0.25 else -1"})
    assert np.abs(found.efforts["motor"] - free.efforts["motor"] - [1.0, 1.0, -2.0, -2.0]).max() < 1e-11
    assert np.array_equal(found.q.values, free.q.values)


def test_angles_in_space_count_turns():
    rotor = {"mass": 1.0, "inertia": [0.1, 0.2, 0.3], "points": {"rim": [0.5, 0.0, 0.0]}}
    joints = {
        "pin": rods.pin("ground", "rotor", rods.GROUND3, "centre", axis=[0.0, 0.0, 1.0]),
        "motor": {"type": "driver", "joint": "pin", "value": "5*t"},
    }
    found = rods.model({"rotor": rotor}, joints, "spatial").kinematics([-2.0, 0.0, 1.0, 4.0])
    assert np.abs(found["pin.angle"] - 5.0 * found.t).max() < 1e-13
    assert np.abs(found.curve("rotor.rim")[:, 0] - 0.5 * np.cos(5.0 * found.t)).max() < 1e-14


# -- singular positions ------------------------------------------------------------------------------------------------


@pytest.mark.slow_cases("fine", "coarse", "at the change point")
@pytest.mark.parametrize(
    "times",
    [np.linspace(0.0, 2.0, 401), np.linspace(0.0, 2.0, 9), [0.0, (math.pi - 0.7) / (2.0 * math.pi)], [-1.0, 1.0]],
    ids=["fine", "coarse", "at the change point", "backwards too"],
)
def test_a_rhombus_goes_through_its_change_points(rhombus, times):
    found = rhombus.kinematics(times)
    angle = 0.7 + 2.0 * math.pi * found.t
    assert found.ok and len(found.t) == len(times)
    for name, exact in (("rocker.theta", angle), ("coupler.theta", 0.0), ("coupler.x", 0.5 + np.cos(angle))):
        assert np.abs(found[name] - exact).max() < 1e-12
    assert np.abs(found["rocker.omega"] - 2.0 * math.pi).max() < 1e-11
    assert np.abs(found["rocker.alpha"]).max() < 1e-9
    # flat wherever the crank lies on the ground's line
    turns = np.arange(math.ceil(angle.min() / math.pi), math.floor(angle.max() / math.pi + 1e-9) + 1)
    met = np.array([p.t for p in found.passages])
    assert np.abs(met - (turns * math.pi - 0.7) / (2.0 * math.pi)).max() < 1e-12
    assert all(p.kind == "passed" and "singular position at t =" in p.words for p in found.passages)


@pytest.mark.slow_cases("fine", "coarse")
@pytest.mark.parametrize("times", [np.linspace(0.0, 1.0, 101), [0.0, 0.25, 0.5, 1.0]], ids=["fine", "coarse"])
def test_redundant_links_go_through_flat_positions(times):
    """Three parallel links: a row depends on the others for ever, and two more positions are singular."""
    raw = parallelogram()
    raw["joints"]["motor"] = {"type": "driver", "joint": "A0", "value": "pi/2 - 2*pi*t"}
    found = model(raw).kinematics(times)
    assert np.abs(found["link2.theta"] - math.pi / 2.0 + 2.0 * math.pi * found.t).max() < 1e-13
    assert np.abs(found["bar.theta"]).max() < 1e-13 and np.abs(found["link1.alpha"]).max() < 1e-9
    assert np.abs(np.array([p.t for p in found.passages]) - [0.25, 0.75]).max() < 1e-12
    assert found.non_unique_reactions == ("A0", "B0", "A1", "B1", "A2", "B2")


@pytest.mark.slow
def test_a_rhombus_in_space_does_the_same(rhombus):
    """With a revolute joint at every pin three rows depend on others; angles of pins begin at 0 there."""
    raw = spatial_twin(four_bar((1.0, 1.0, 1.0, 1.0), 0.7, None), {})
    raw["joints"]["motor"] = {"type": "driver", "joint": "A", "value": "2*pi*t"}
    times = np.linspace(0.0, 1.2, 7)
    found, flat = model(raw).kinematics(times), rhombus.kinematics(times)
    for own, other in (("coupler.x", "coupler.x"), ("rocker.y", "rocker.y"), ("rocker.wz", "rocker.omega")):
        assert np.abs(found[own] - flat[other]).max() < 1e-11
    assert np.abs(found["rocker.alphaz"]).max() < 1e-9
    assert np.abs(np.array([p.t for p in found.passages]) - [p.t for p in flat.passages]).max() < 1e-12
    assert np.abs(found.efforts["motor"] - flat.efforts["motor"]).max() < 1e-8
    assert found.non_unique_reactions == ("A", "B", "C", "D")


@pytest.mark.slow
def test_a_crank_that_cannot_go_round_stops_at_its_dead_centre():
    stuck = model(four_bar((1.3, 1.0, 1.0, 1.0), 0.7, CRANK))
    # there coupler and rocker lie in one line: the pins B and D are 2 m apart
    t = (math.acos((1.0 + 1.3**2 - 4.0) / 2.6) - 0.7) / (2.0 * math.pi)
    for times in (np.linspace(0.0, 1.0, 201), [0.0, 0.1, 0.9]):
        found = stuck.kinematics(times)
        assert not found.ok and np.all(found.t < t) and np.all(np.isfinite(found.q.values))
        assert len(found.t) == np.count_nonzero(np.asarray(times) < t)
        assert found.passages[-1].kind == "dead centre" and found.passages[-1].drivers == ("motor",)
        assert abs(found.passages[-1].t - t) < 1e-12
        assert found.ended.startswith("dead centre at t = 0.222632616 s: 'motor' can go no further")
    nothing = stuck.kinematics([0.9])
    assert not nothing.ok and len(nothing.t) == 0 and nothing.to_json()["q"]["crank.theta"] == []


@pytest.mark.slow
def test_a_slider_drives_a_crank_over_both_dead_centres():
    """The slider moves as a steady crank would have moved it: at its ends it stands still, and the crank goes on."""
    raw = slider_crank("cos(0.7 + 2*pi*t) + sqrt(9 - sin(0.7 + 2*pi*t)**2)")
    for times in (np.linspace(0.0, 1.6, 161), [0.0, 0.8, 1.6]):
        found = model(raw).kinematics(times)
        assert np.abs(found["crank.theta"] - 0.7 - 2.0 * math.pi * found.t).max() < 1e-11
        assert np.abs(found["crank.omega"] - 2.0 * math.pi).max() < 1e-9
        ends = (np.arange(1, 4) * math.pi - 0.7) / (2.0 * math.pi)
        assert np.abs(np.array([p.t for p in found.passages]) - ends).max() < 1e-9


@pytest.mark.by_turns(3)
@pytest.mark.slow
def test_random_linkages_go_as_far_as_circles_meet():
    random, tried = np.random.default_rng(5), 0
    while tried < 10:
        ground, crank, coupler, rocker = (float(x) for x in random.uniform(0.3, 3.0, 4))
        start, above = float(random.uniform(-math.pi, math.pi)), bool(random.integers(2))
        shortest, longest = abs(coupler - rocker), coupler + rocker
        d = math.dist((crank * math.cos(start), crank * math.sin(start)), (ground, 0.0))
        if not 1.05 * shortest < d < 0.95 * longest:
            continue
        tried += 1
        # angles at which B is at the shortest or longest distance from D, where coupler and rocker are in line
        cosines = [(ground**2 + crank**2 - x * x) / (2.0 * ground * crank) for x in (shortest, longest)]
        limits = [a for c in cosines if abs(c) < 1.0 for a in (math.acos(c), -math.acos(c))]
        end = min(((a - start) % math.tau for a in limits), default=math.inf) / math.tau
        linkage = model(four_bar((ground, crank, coupler, rocker), start, CRANK, above=above))
        for times in (np.linspace(0.0, 1.5, 6), np.linspace(0.0, 1.5, 151)):
            found = linkage.kinematics(times)
            assert len(found.t) == np.count_nonzero(times < end) and found.ok == (end > 1.5)
            angle = start + 2.0 * math.pi * found.t
            b = crank * np.column_stack([np.cos(angle), np.sin(angle)])
            c = meeting(b, coupler, [ground, 0.0], rocker, left=above)
            assert np.abs(found.curve("coupler.far") - c).max() < 1e-10
            if end < 1.5:
                assert abs(found.passages[-1].t - end) < 1e-9


@pytest.mark.by_turns(3)
@pytest.mark.slow
@pytest.mark.parametrize(
    ("start", "far", "turns", "power"),
    [(0.7, 2.4, 1.0, 4), (0.7, 2.4, 6.0, 2), (0.7, 2.4, 1.0, 60), (2.8, 0.1, 1.0, 2)],
    ids=["far", "more often than asked for", "resting long", "near the dead centre"],
)
def test_a_dead_centre_between_times_at_which_the_driver_rests_is_met(start, far, turns, power):
    drive = f"start + {far}*sin({turns}*pi*t)**{power}"
    linkage = model(four_bar((4.0, 2.0, 3.0, 2.95), start, drive))
    limit = math.acos((4.0**2 + 2.0**2 - 5.95**2) / 16.0)  # coupler and rocker in one line
    met = math.asin(((limit - start) / far) ** (1.0 / power)) / (turns * math.pi)
    found = linkage.kinematics([0.0, 1.0, 2.0])
    assert not found.ok and len(found.t) == 1 and abs(found.passages[-1].t - met) < 1e-9
    needed = linkage.inverse(times=[-1.0, 0.0])
    assert needed.ended.startswith("dead centre at t = -") and list(needed.t) == [0.0]


#: The part of a bell's height at which a linkage is at its dead centre.
PART = (math.acos((4.0**2 + 2.0**2 - 5.95**2) / 16.0) - 0.7) / 2.4


@pytest.mark.parametrize(
    ("bell", "times", "before", "met"),
    [
        # 10 us in 4 s are seen where times are requested there
        (
            *("exp(-((t - 1.0037)/1e-5)**2)", [0.0, *np.linspace(1.00365, 1.00375, 41), 2.0], None),
            1.0037 - 1e-5 * math.sqrt(-math.log(PART)),
        ),
        ("exp(-((t - 1.0037)/0.05)**2)", [-2.0, 0.0, 2.0], 2, 1.0037 - 0.05 * math.sqrt(-math.log(PART))),
        ("1/(1 + ((t + 0.7)/0.03)**2)", [-2.0, 0.0, 2.0], 2, -0.7 + 0.03 * math.sqrt(1.0 / PART - 1.0)),
    ],
)
def test_a_dead_centre_in_a_short_pulse_is_met(bell, times, before, met):
    found = model(four_bar((4.0, 2.0, 3.0, 2.95), 0.7, f"start + 2.4*{bell}")).kinematics(times)
    assert not found.ok and abs(found.passages[0].t - met) < 1e-9 and len(found.t) == (before or len(found.t))


def test_a_driver_that_comes_back_from_where_it_can_go_is_followed():
    """Out and back between the asked times, and short of the dead centre: nothing else than at rest."""
    linkage = model(four_bar((4.0, 2.0, 3.0, 2.95), 0.7, "start + 2*sin(pi*t)**4"))
    found = linkage.kinematics([0.0, 1.0, 1.5, 3.0])
    assert found.ok and list(found.t) == [0.0, 1.0, 1.5, 3.0]
    assert np.abs(found.q.values[[1, 3]] - found.q.values[0]).max() < 1e-13
    c = meeting([2.0 * math.cos(2.7), 2.0 * math.sin(2.7)], 3.0, [4.0, 0.0], 2.95)
    assert np.abs(found.curve("coupler.far")[2] - c).max() < 1e-13


def test_a_branch_near_another_one_is_not_left():
    """A hair's breadth from the rhombus there are two branches, which nearly meet where it is flat."""
    found = model(four_bar((1.0001, 1.0, 1.0, 1.0), 0.7, CRANK)).kinematics(np.linspace(0.0, 0.385, 78))
    b = np.column_stack([np.cos(0.7 + 2.0 * math.pi * found.t), np.sin(0.7 + 2.0 * math.pi * found.t)])
    c = meeting(b, 1.0, [1.0001, 0.0], 1.0)
    assert np.abs(found.curve("rocker.far") - c).max() < 1e-11


def test_a_driver_that_jumps_is_named():
    jumping = four_bar((3.0, 1.0, 3.0, 2.5), 0.7, "start + t + (0.5 if t > 0.3 else 0)")
    found = model(jumping).kinematics([0.0, 0.2, 0.4])
    assert found.ended.startswith("the value of 'motor' jumps at t = 0.3") and len(found.t) == 2


# -- what is refused ---------------------------------------------------------------------------------------------------


def test_freedom_that_is_not_driven_is_named():
    with pytest.raises(InputError, match=r"a driver for every freedom, got none for \w\.angle; symgen run needs no"):
        model(four_bar((1.0, 1.0, 1.0, 1.0), 0.7, None)).kinematics([0.0])
    raw = four_bar((3.0, 1.0, 3.0, 2.5), 0.7, CRANK)
    raw["joints"].pop("D")
    with pytest.raises(InputError, match=r"a driver for every freedom, got none for bob\.v[xy]; "):
        symgen.load("pendulum").kinematics([0.0, 1.0])  # a rod between points, so no joint reports a coordinate
    with pytest.raises(InputError, match=r"a driver for every freedom, got none for [\w.]+, [\w.]+; "):
        model(raw).kinematics([0.0])


@pytest.mark.parametrize("value", ["start", "start + 0.1"])
def test_too_many_drivers_are_named(value):
    raw = four_bar((3.0, 1.0, 3.0, 2.5), 0.7, CRANK)
    raw["joints"]["second"] = {"type": "driver", "body": "crank", "coordinate": "theta", "value": value}
    with pytest.raises(InputError, match=r"1 driver for 1 degree of freedom, got 2: motor, second"):
        model(raw).kinematics([0.0])


@pytest.mark.slow
def test_conditions_on_velocities_and_singular_starts_are_refused():
    with pytest.raises(InputError, match="a condition on velocities"):
        symgen.load("rolling-disc").kinematics([0.0])
    raw = four_bar((1.0, 1.0, 1.0, 1.0), math.pi, "start + 2*pi*t")
    with pytest.raises(InputError, match="a singular position, from which several motions go on"):
        model(raw).kinematics([0.0])


def test_bad_arguments_are_refused(driven):
    for times, match in (([0.0, 0.0], "increase"), ([], "list of finite"), ([math.nan], "finite"), ("x", "finite")):
        with pytest.raises(InputError, match=match):
            driven.kinematics(times)
    for pin in ("E", "A", "C(B)", "C(A, D)", "C(", "C()", "C(B,)", "C(B, D"):
        with pytest.raises(InputError, match="transmission"):
            driven.kinematics([0.0], transmission=[pin])


# -- tables ------------------------------------------------------------------------------------------------------------


def test_transmission_angles_follow_the_law_of_cosines(driven):
    found = driven.kinematics(np.linspace(0.0, 1.0, 50), transmission=("C", "C(B, D)"))
    d2 = 104.0 - 40.0 * np.cos(math.pi / 3.0 + 2.0 * math.pi * found.t)  # of B and D
    exact = np.arccos((64.0 + 25.0 - d2) / 80.0)
    assert np.abs(found.transmission["C"] - exact).max() < 1e-13
    assert np.abs(found.transmission["C(B, D)"] - exact).max() < 1e-13


def test_transmission_at_a_slider():
    """A slider-crank's angle between rod and normal of the slide: cos = (crank/rod) sin(angle), slide along x."""
    found = model(slider_crank(None)).kinematics(np.linspace(0.0, 1.0, 25), transmission="C")
    sine = np.sin(0.7 + 2.0 * math.pi * found.t) / 3.0
    assert np.abs(np.abs(np.cos(found.transmission["C"])) - np.abs(sine)).max() < 1e-13


@pytest.mark.slow
def test_doubled_pins_leave_reactions_that_are_not_unique():
    raw = four_bar((3.0, 1.0, 3.0, 2.5), 0.7, CRANK)
    alone = model(raw).kinematics([0.0, 0.3])
    raw["joints"]["twin"] = rods.pin("ground", "rocker", [3.0, 0.0], "far", "distance", length=2.5)
    found = model(raw).kinematics([0.0, 0.3])
    assert found.non_unique_reactions and set(found.non_unique_reactions) <= {"C", "D", "twin", "A", "B"}
    assert "twin" in found.non_unique_reactions
    assert np.abs(found.q.values - alone.q.values).max() < 1e-13
    assert np.abs(found.efforts["motor"] - alone.efforts["motor"]).max() < 1e-11
    assert any("not unique" in note for note in found.notes)


@pytest.mark.slow
def test_files_and_json(driven, tmp_path, capsys):
    code = main(
        [
            *("kinematics", "driven-four-bar", "--times", "0, 0.25", "--json", "--transmission", "C"),
            *("--save", str(tmp_path / "k.csv"), "--quantity", "coupler.C", "--quantity", "transmission"),
            *("--plot", str(tmp_path / "k.svg"), "--curves", str(tmp_path / "c.svg")),
        ]
    )
    found = json.loads(capsys.readouterr().out)
    assert code == 0 and found["t"] == [0.0, 0.25] and found["ended"] is None and found["passages"] == []
    assert set(found["q"]) == set(driven.simulate(until=1e-3, step=1e-3).q.names)
    for table in ("q", "v", "a", "points", "reactions", "efforts", "transmission"):
        assert all(len(column) == 2 for column in found[table].values()) and found[table]
    header = (tmp_path / "k.csv").read_text().splitlines()[0]
    assert header.startswith("t [s],coupler.C.x [m],coupler.C.y [m],coupler.C.vx [m/s]")
    assert header.endswith("transmission.C [rad]")
    assert (tmp_path / "k.svg").stat().st_size and (tmp_path / "c.svg").stat().st_size
    assert main(["kinematics", "driven-four-bar", "--times", "0,x"]) == 2 and "--times" in capsys.readouterr().err
    frame = driven.kinematics([0.0, 0.1]).to_dataframe()
    assert list(frame.index) == [0.0, 0.1] and frame.attrs["units"]["A.M"] == "N m"


def test_the_command_ends_at_a_dead_centre(tmp_path, capsys):
    """A rod on a pin whose tip is lifted: it stands upright after half a second."""
    path = tmp_path / "lift.toml"
    path.write_text(
        """
[mechanism]
name = "lift"
gravity = [0.0, -9.81]
[bodies.rod]
mass = 1.0
inertia = 0.1
points = { foot = [-0.5, 0.0], tip = [0.5, 0.0] }
position = [0.43, 0.25]
angle = 0.5235987755982988
[joints.pin]
type = "revolute"
between = ["ground", "rod"]
at = [[0.0, 0.0], "foot"]
[joints.lift]
type = "driver"
body = "rod"
point = "tip"
coordinate = "y"
value = "0.5 + t"
"""
    )
    assert main(["kinematics", str(path), "--times", "lin(0,1,11)", "--json"]) == 1
    out, err = capsys.readouterr()
    found = json.loads(out)
    assert found["t"] == [0.0, 0.1, 0.2, 0.30000000000000004, 0.4] and "dead centre at t = 0.5 s: 'lift'" in err
    assert found["ended"].startswith("dead centre") and found["passages"][0]["kind"] == "dead centre"
    assert np.allclose(np.sin(found["q"]["rod.theta"]), 0.5 + np.array(found["t"]), rtol=0.0, atol=1e-14)


def test_times_that_no_step_leads_to_are_told_as_such():
    """A crank of 2 pi rad/s turns many times in the shortest step to 1e300 s: its motion was said to jump."""
    found = symgen.load("driven-four-bar").kinematics([0.0, 1e300])
    assert found.ended.startswith("the value of 'motor' jumps at t = 0 s, or goes too far in")


@pytest.mark.parametrize("held", ["body", "joint"])
def test_velocities_that_a_start_holds_are_those_of_the_drivers(held):
    """They belong to the start of a run; a prescribed motion has positions, and velocities follow."""
    raw = {
        "mechanism": {"name": "crank", "gravity": [0.0, -9.81]},
        "bodies": {"crank": {"mass": 2.0, "inertia": 0.1, "position": [0.5, 0.0]}},
        "joints": {
            "pin": {"type": "revolute", "between": ["ground", "crank"], "at": [[0.0, 0.0], [-0.5, 0.0]]},
            "motor": {"type": "driver", "joint": "pin", "value": "6*t"},
        },
    }
    if held == "body":
        raw["bodies"]["crank"] |= {"angular_velocity": 6.0, "hold": True}
    else:
        raw["joints"]["pin"]["start"] = {"angle": 0.0, "rate": 6.0}
    crank, times = model(raw), np.linspace(0.0, 1.0, 11)
    motion = crank.kinematics(times)
    np.testing.assert_allclose(motion["crank.omega"], 6.0, rtol=1e-12)
    np.testing.assert_allclose(motion["crank.x"], 0.5 * np.cos(6.0 * times), atol=1e-12)
    effort = crank.inverse(times=times)["motor.effort"]
    np.testing.assert_allclose(effort, 2.0 * 9.81 * 0.5 * np.cos(6.0 * times), rtol=1e-10)


def test_status_and_reason_as_results_have_them():
    whole = symgen.load("driven-four-bar").kinematics([0.0, 0.5, 1.0])
    assert (whole.status, whole.reason, whole.ok) == ("ok", None, True)
    assert whole.run_facts()["status"] == "ok"

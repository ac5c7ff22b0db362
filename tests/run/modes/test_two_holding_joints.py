"""Several joints that hold for a while, and a four-bar that opens and catches again, beside equations written here."""

from itertools import pairwise

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import symgen

G = 9.81
TIGHT = {"integrator": "dop853", "rtol": 1e-12, "atol": 1e-13}
#: Inertias [kg m^2] and speeds [rad/s] of rotors in a row.
INERTIAS, SPEEDS = (2.0, 1.0, 0.5), (3.0, -1.0, 2.0)


def rotors(first: object, second: object, **numbers: float) -> symgen.Model:
    """Return three rotors with a clutch of teeth between neighbours."""
    builder = symgen.MechanismBuilder("rotors")
    for name, number in numbers.items():
        builder.parameter(name, number)
    for name, inertia, speed in zip("abc", INERTIAS, SPEEDS, strict=True):
        builder.body(name, mass=1.0, inertia=inertia, angular_velocity=speed)
        builder.joint(f"at_{name}", "revolute", between=("ground", name), at=((0.0, 0.0), "centre"))
    for name, pair, holds in (("left", ("a", "b"), first), ("right", ("b", "c"), second)):
        builder.joint(name, "rigid", between=pair, at=("centre", "centre"), holds=holds, holds_at="present")
    return symgen.load(builder.build())


def caught(speeds: tuple[float, ...], together: str) -> tuple[float, ...]:
    """Return the speeds after rotors have been joined: their momentum is shared."""
    chosen = ["abc".index(name) for name in together]
    common = sum(INERTIAS[i] * speeds[i] for i in chosen) / sum(INERTIAS[i] for i in chosen)
    return tuple(common if i in chosen else speed for i, speed in enumerate(speeds))


def energy(speeds: tuple[float, ...]) -> float:
    return 0.5 * sum(j * w**2 for j, w in zip(INERTIAS, speeds, strict=True))


@pytest.mark.by_turns(3)
@pytest.mark.slow
@pytest.mark.parametrize("coordinates", ["absolute", "joint"])
@pytest.mark.parametrize(
    ("first", "second", "catches"),
    [
        ("t > 0.1", "t > 0.3", ((0.2, "ab"), (0.4, "abc"))),
        ("t > 0.1", "t > 0.1", ((0.2, "abc"),)),
        ("t > 0.1 and t < 0.3", "t > 0.3", ((0.2, "ab"), (0.4, "bc"))),
        ("t > 0.3", "t > 0.1 and t < 0.3", ((0.2, "bc"), (0.4, "ab"))),
        ("t > 0.1 and t < 0.25", "t > 0.1 and t < 0.3", ((0.15, "abc"),)),
    ],
    ids=["one-after-another", "at-once", "handed-over", "handed-back", "released-one-by-one"],
)
def test_rotors_share_their_momentum(first, second, catches, coordinates) -> None:
    """Both catch at one instant; one catches at the instant at which the other lets go, whichever comes first."""
    speeds, lost, expected = SPEEDS, 0.0, list[tuple[float, ...]]()
    for _, together in catches:
        after = caught(speeds, together)
        lost, speeds = lost + energy(speeds) - energy(after), after
        expected.append(after)
    run = rotors(first, second).simulate(times=[*(t for t, _ in catches), 0.6], coordinates=coordinates)
    assert run.ok, run.reason
    found = np.array([run[f"{name}.omega"] for name in "abc"]).T
    np.testing.assert_allclose(found, [*expected, speeds], rtol=0, atol=1e-12)
    assert run["left.dissipated"][-1] + run["right.dissipated"][-1] == pytest.approx(lost, abs=1e-12)
    assert np.abs(run.energy_error).max() < 1e-12


@pytest.mark.by_turns(2)
@pytest.mark.slow
@pytest.mark.parametrize("coordinates", ["absolute", "joint"])
def test_derivatives_of_a_hand_over(coordinates) -> None:
    """By its time: the second rotor brings (1, w) to the third, where w and the angle are those of a rotor as it is."""
    model = rotors("t < te", "t > te", te=0.1)
    keys = {"until": 0.5, "coordinates": coordinates, **TIGHT}
    common = caught(SPEEDS, "ab")[1]
    after = (INERTIAS[1] * common + INERTIAS[2] * SPEEDS[2]) / (INERTIAS[1] + INERTIAS[2])
    run = model.simulate(sensitivities=("te",), **keys)
    assert run.ok, run.reason
    for column, slope in (("b.theta", common - after), ("c.theta", SPEEDS[2] - after), ("a.theta", 0.0)):
        assert run.gradient(column).values[-1, 0] == pytest.approx(slope, abs=1e-12), column
        back = model.gradient(column, by=("te",), way="adjoint", **keys)
        assert back.by["te"] == pytest.approx(slope, abs=1e-12), column


@pytest.mark.by_turns(2)
@pytest.mark.slow
def test_a_sweep_over_the_time_of_a_hand_over() -> None:
    """301 times: none fails, and angles are those of rotors that turn evenly before and after."""
    te = np.linspace(0.01, 0.49, 301)
    swept = symgen.sweep(rotors("t < te", "t > te", te=0.1), {"te": te}, quantities=["c.theta", "a.theta"], until=0.5)
    assert set(swept.status.tolist()) == {"ok"}
    common = caught(SPEEDS, "ab")[1]
    after = (INERTIAS[1] * common + INERTIAS[2] * SPEEDS[2]) / (INERTIAS[1] + INERTIAS[2])
    for column, angle in (("c.theta", SPEEDS[2] * te + after * (0.5 - te)), ("a.theta", 0.5 * common + 0.0 * te)):
        np.testing.assert_allclose(np.asarray(swept[column]).reshape(301), angle, rtol=0, atol=1e-12)


def beam(left: str, right: str) -> symgen.Model:
    """Return a beam on two pins, which hold four rows of its three coordinates."""
    builder = symgen.MechanismBuilder("beam", gravity=(0.0, -G))
    builder.body("beam", mass=2.0, inertia=0.3, points={"a": (-0.5, 0.0), "b": (0.5, 0.0)})
    builder.joint("left", "revolute", between=("ground", "beam"), at=((-0.5, 0.0), "a"), holds=left)
    builder.joint("right", "revolute", between=("ground", "beam"), at=((0.5, 0.0), "b"), holds=right)
    return symgen.load(builder.build())


def fallen(first: float, second: float, t: float) -> np.ndarray:
    """Return x, y and angle of the beam, which swings about its right pin from `first` to `second`, and then flies."""
    start = (0.5, 0.0, 0.0)

    def rates(_, y):
        return [y[1], 2.0 * G * 0.5 * np.cos(y[0]) / (0.3 + 2.0 * 0.25)]

    angle, rate = 0.0, 0.0
    if (swung := min(t, second) - first) > 0.0:
        own = solve_ivp(rates, (0.0, swung), [angle, rate], "DOP853", rtol=1e-13, atol=1e-14)
        angle, rate = own.y[:, -1]
    flown = max(0.0, t - max(first, second))
    c, s = 0.5 * np.cos(angle), 0.5 * np.sin(angle)
    return np.array([start[0] - c + s * rate * flown, -s - c * rate * flown - 0.5 * G * flown**2, angle + rate * flown])


@pytest.mark.slow
@pytest.mark.parametrize("coordinates", ["absolute", "joint"])
@pytest.mark.parametrize(("first", "second"), [(0.2, 0.5), (0.3, 0.3)])
def test_a_beam_loses_one_pin_and_then_the_other(first, second, coordinates) -> None:
    """Rows that depend on each other while both pins hold; at one instant it is dropped."""
    times = [0.1, 0.35, 0.45, 0.7]
    run = beam(f"t < {first}", f"t < {second}").simulate(times=times, until=0.7, coordinates=coordinates, **TIGHT)
    assert run.ok, run.reason
    found = np.array([run[f"beam.{name}"] for name in ("x", "y", "theta")]).T
    np.testing.assert_allclose(found, [fallen(first, second, t) for t in times], rtol=0, atol=1e-10)
    assert [event.name for event in run.events] == ["left.releases", "right.releases"]


@pytest.mark.slow
def test_a_pin_breaks_as_the_beam_swings_on_it() -> None:
    """Both pins share m g until 0.2 s; then the force of the right one goes down to m g J/(J + m/4), and up to 15 N."""
    limit = 15.0

    def rates(_, y):
        return [y[1], 2.0 * G * 0.5 * np.cos(y[0]) / 0.8]

    def over(t, y):
        along, across = 2.0 * 0.5 * y[1] ** 2 + 2.0 * G * np.sin(y[0]), 2.0 * G * np.cos(y[0]) * 0.3 / 0.8
        return np.hypot(along, across) - limit

    over.terminal = True
    own = solve_ivp(rates, (0.0, 1.0), [0.0, 0.0], "DOP853", rtol=1e-13, atol=1e-14, events=over)
    run = beam("t < 0.2", f"right.F < {limit}").simulate(until=0.8, **TIGHT)
    assert run.ok, run.reason
    assert [(event.name, event.t) for event in run.events] == [
        ("left.releases", pytest.approx(0.2, abs=1e-12)),
        ("right.releases", pytest.approx(0.2 + own.t_events[0][0], abs=1e-10)),
    ]


# -- a four-bar --------------------------------------------------------------------------------------------------------

#: Lengths, masses, and inertias of crank, coupler and rocker; the rocker's pivot.
LENGTHS, MASSES = np.array([0.3, 0.9, 0.6]), np.array([1.0, 2.0, 1.5])
TURNS, PIVOT = MASSES * LENGTHS**2 / 12.0, 0.8
OPENS, CLOSES, UNTIL = 0.4, 0.7, 1.2


def closed_angles(crank: float) -> np.ndarray:
    """Return the angles of the three bars."""
    end, pivot = LENGTHS[0] * np.array([np.cos(crank), np.sin(crank)]), np.array([PIVOT, 0.0])
    apart, direction = np.hypot(*(pivot - end)), np.arctan2(*(pivot - end)[::-1])
    inner = np.arccos((apart**2 + LENGTHS[1] ** 2 - LENGTHS[2] ** 2) / (2.0 * apart * LENGTHS[1]))
    coupler = direction + inner
    top = end + LENGTHS[1] * np.array([np.cos(coupler), np.sin(coupler)]) - pivot
    return np.array([crank, coupler, np.arctan2(top[1], top[0])])


def four_bar(**pin: object) -> symgen.Model:
    crank, coupler, rocker = closed_angles(1.0)
    at = LENGTHS[0] * np.array([np.cos(crank), np.sin(crank)])
    builder = symgen.MechanismBuilder("four-bar-that-opens", gravity=(0.0, -G))
    places = (0.5 * at, at + 0.5 * LENGTHS[1] * np.array([np.cos(coupler), np.sin(coupler)]))
    places += (np.array([PIVOT, 0.0]) + 0.5 * LENGTHS[2] * np.array([np.cos(rocker), np.sin(rocker)]),)
    names = ("crank", "coupler", "rocker")
    for i, (name, angle) in enumerate(zip(names, (crank, coupler, rocker), strict=True)):
        half = float(LENGTHS[i]) / 2.0
        builder.body(
            name,
            mass=float(MASSES[i]),
            inertia=float(TURNS[i]),
            points={"a": (-half, 0.0), "b": (half, 0.0)},
            position=tuple(map(float, places[i])),
            angle=float(angle),
        )
    builder.joint("A", "revolute", between=("ground", "crank"), at=((0.0, 0.0), "a"))
    builder.joint("B", "revolute", between=("crank", "coupler"), at=("b", "a"))
    builder.joint("C", "revolute", between=("coupler", "rocker"), at=("b", "b"), **pin)
    builder.joint("D", "revolute", between=("ground", "rocker"), at=((PIVOT, 0.0), "a"))
    return symgen.load(builder.build())


def arms_of_loop(angles: np.ndarray, offset: complex = 0.0) -> np.ndarray:
    """Return the vectors around the loop as complex numbers; `offset` is the caught point in the coupler's frame."""
    return (np.array([1.0, 1.0, -1.0]) * LENGTHS + np.array([0.0, offset, 0.0])) * np.exp(1j * angles)


def terms(angles: np.ndarray, rates: np.ndarray, offset: complex = 0.0) -> tuple[np.ndarray, ...]:
    """Return mass matrix, force, Jacobian and right side of the loop of three bars, in the angles of the bars."""
    (l1, l2, l3), (m1, m2, m3) = LENGTHS, MASSES
    mixed = 0.5 * m2 * l1 * l2
    c12, s12 = np.cos(angles[0] - angles[1]), np.sin(angles[0] - angles[1])
    mass = np.diag(MASSES * LENGTHS**2 / 3.0) + np.diag([m2 * l1**2, 0.0, 0.0])
    mass[0, 1] = mass[1, 0] = mixed * c12
    weight = -G * np.cos(angles) * np.array([0.5 * m1 * l1 + m2 * l1, 0.5 * m2 * l2, 0.5 * m3 * l3])
    force = weight + np.array([-mixed * s12 * rates[1] ** 2, mixed * s12 * rates[0] ** 2, 0.0])
    arms = arms_of_loop(angles, offset)
    turned = arms @ rates**2
    return mass, force, np.array([-arms.imag, arms.real]), np.array([turned.real, turned.imag])


def own_four_bar(until: float) -> tuple[np.ndarray, float]:
    """Return the state at a time, and the energy that the catch takes: three phases of a loop that opens and closes.

    It closes where it is: the end of the rocker is held where it is in the frame of the coupler.
    """
    state, lost, offset = np.concatenate([closed_angles(1.0), np.zeros(3)]), 0.0, 0.0
    for (begin, end), held in zip(pairwise((0.0, OPENS, CLOSES, UNTIL)), (True, False, True), strict=True):
        if begin == CLOSES and until > CLOSES:
            offset = (PIVOT - arms_of_loop(state[:3]).sum()) * np.exp(-1j * state[1])
            mass, _, jacobian, _ = terms(state[:3], state[3:], offset)
            back = np.linalg.solve(mass, jacobian.T)
            change = back @ np.linalg.solve(jacobian @ back, jacobian @ state[3:])
            lost = 0.5 * change @ mass @ change
            state[3:] -= change

        def rates(_, y, held=held, offset=offset):
            mass, force, jacobian, right = terms(y[:3], y[3:], offset)
            if not held:
                return np.concatenate([y[3:], np.linalg.solve(mass, force)])
            matrix = np.block([[mass, jacobian.T], [jacobian, np.zeros((2, 2))]])
            return np.concatenate([y[3:], np.linalg.solve(matrix, np.concatenate([force, right]))[:3]])

        if until > begin:
            span = (begin, min(end, until))
            state = solve_ivp(rates, span, state, "DOP853", rtol=1e-13, atol=1e-14).y[:, -1]
    return state, lost


@pytest.mark.slow
@pytest.mark.parametrize("coordinates", ["absolute", "joint"])
def test_a_four_bar_opens_and_catches_where_it_is(coordinates) -> None:
    """Angles and rates of three bars in three phases, and the energy of the impact."""
    holds = f"t < {OPENS} or t > {CLOSES}"
    times = [0.3, 0.5, 0.65, 0.9, UNTIL]
    run = four_bar(holds=holds, holds_at="present").simulate(times=times, until=UNTIL, coordinates=coordinates, **TIGHT)
    assert run.ok, run.reason
    names = [f"{body}.{word}" for word in ("theta", "omega") for body in ("crank", "coupler", "rocker")]
    found = np.array([run[name] for name in names]).T
    own = [own_four_bar(t) for t in times]
    np.testing.assert_allclose(found, [state for state, _ in own], rtol=0, atol=1e-9)
    np.testing.assert_allclose(run["C.dissipated"], [lost for _, lost in own], rtol=0, atol=1e-10)
    assert np.abs(run.energy_error).max() < 1e-9

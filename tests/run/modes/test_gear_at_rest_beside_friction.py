"""A gear with losses that rests together with dry friction of a shaft: locked, forwards, backwards and free.

The example `LossyGearDemo2` of Modelica's library has such a gear. The equations are written here once more.
"""

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

import symgen

J1, J2, RATIO, DRY, LOAD = 1.0, 1.5, 2.0, 0.5, 3.0
TIGHT = {"integrator": "dop853", "rtol": 1e-11, "atol": 1e-12}


def machine(
    efficiency: tuple[float, float],
    static: float = DRY,
    second: float = 0.0,
    drive: str = "A*sin(w*t)",
    dry: dict[str, object] | None = None,
) -> symgen.Model:
    """Return a motor and a drum with a gear of 2 : 1; the second shaft may have friction too."""
    builder = symgen.MechanismBuilder("lossy").parameter("A", 6.0).parameter("w", 3.0)
    builder.body("motor", mass=1.0, inertia=J1).body("drum", mass=1.0, inertia=J2, position=(0.3, 0.0))
    dry = dry or {"sliding": DRY, "static": static}
    builder.joint("shaft", "revolute", between=("ground", "motor"), at=((0.0, 0.0), "centre"), friction=dry)
    more = {"friction": {"sliding": second}} if second else {}
    builder.joint("axle", "revolute", between=("ground", "drum"), at=((0.3, 0.0), "centre"), **more)
    builder.joint("gear", "gear", between=("motor", "drum"), ratio=RATIO, efficiency=list(efficiency))
    builder.force("drive", "torque", body="motor", torque=drive)
    builder.force("load", "torque", body="drum", torque=LOAD)
    return symgen.load(builder.build())


class Lossy:
    """The motor's motion by two cases of power, and by three of motion.

    With the torque T of the teeth on the motor, that on the drum is i k T: k is the efficiency where power goes to the
    drum, and 1 over that backwards where it comes from there. The drum turns by -1/i of the motor.
    """

    def __init__(self, efficiency, amplitude, pace=3.0, static=DRY, second=0.0):
        self.efficiency, self.amplitude, self.pace, self.static, self.second = (
            efficiency,
            amplitude,
            pace,
            static,
            second,
        )

    def rate(self, t, sign, bound=DRY):
        """Return the acceleration of the motor where friction acts against a direction, and the torque of teeth."""
        share = J2 / (RATIO * J1)
        own, load = self.amplitude * np.sin(self.pace * t) - bound * sign, LOAD + self.second * sign
        for forwards in (True, False):
            k = self.efficiency[0] if forwards else 1.0 / self.efficiency[1]
            teeth = -(load + share * own) / (RATIO * k + share)
            if (-teeth * sign > 0.0) == forwards or teeth == 0.0:
                return (own + teeth) / J1, teeth
        raise AssertionError("one of both is right")

    def leaves(self, t):
        """Return the direction in which the motor begins to move from rest, 0 where it stays."""
        for sign in (1.0, -1.0):
            if sign * self.rate(t, sign, self.static)[0] > 0.0:
                return sign
        return 0.0

    def run(self, until, times):
        """Return the angle and the rate of the motor at some times, and the times at which it begins and stops."""
        t, y, sign = 0.0, np.zeros(2), self.leaves(0.0)
        found, changes = np.zeros((len(times), 2)), []
        while t < until:
            if sign == 0.0:
                end, sign, grid = until, 0.0, np.linspace(t, until, 4001)
                for direction in (1.0, -1.0):

                    def left(at, direction=direction):
                        return direction * self.rate(at, direction, self.static)[0]

                    values = np.array([left(at) for at in grid])
                    starts = np.flatnonzero((values[1:] > 0.0) & (values[:-1] <= 0.0))
                    if len(starts):
                        at = brentq(left, grid[starts[0]], grid[starts[0] + 1], xtol=1e-14)
                        if at < end:
                            end, sign = at, direction
                found[(times >= t) & (times <= end)] = y
            else:

                def stops(at, state, sign=sign):
                    return state[1] * sign

                def turns(at, state, sign=sign):
                    return self.rate(at, sign)[1]

                stops.terminal, stops.direction, turns.terminal = True, -1.0, True
                keys = {"rtol": 1e-12, "atol": 1e-13, "events": (stops, turns), "dense_output": True}
                own = solve_ivp(
                    lambda at, state, s=sign: [state[1], self.rate(at, s)[0]], (t, until), y, "DOP853", **keys
                )
                end, last = own.t[-1], own.y[:, -1]
                inside = (times >= t) & (times <= end)
                found[inside] = own.sol(times[inside]).T if inside.any() else 0.0
                y = last
                if own.status == 1 and len(own.t_events[0]):
                    y = np.array([last[0], 0.0])
                    sign = sign if sign * self.rate(end, sign)[0] > 0.0 else self.leaves(end)
                elif own.status == 1:  # past the zero of the teeth
                    step = 1e-9
                    y = last + step * np.array([last[1], self.rate(end, sign)[0]])
                    end += step
            if end < until:
                changes.append((end, sign))
            t = end
        return found, changes


@pytest.mark.by_turns(3)
@pytest.mark.slow
@pytest.mark.parametrize("coordinates", ["absolute", "joint"])
@pytest.mark.parametrize(
    ("efficiency", "amplitude", "static", "second"),
    [
        ((0.5, 0.5), 6.0, DRY, 0.0),
        ((0.5, 0.5), 3.0, DRY, 0.0),
        ((0.9, 0.8), 6.0, 1.5, 0.0),
        ((0.9, 0.8), 1.0, 0.8, 0.0),
        ((0.5, 0.5), 8.0, DRY, 0.7),
    ],
    ids=["reverses", "locks", "static", "load-drives", "both-shafts"],
)
def test_a_gear_rests_with_a_dry_shaft(efficiency, amplitude, static, second, coordinates) -> None:
    times = np.linspace(0.0, 4.0, 81)
    own, changes = Lossy(efficiency, amplitude, static=static, second=second).run(4.0, times)
    model = machine(efficiency, static, second)
    run = model.simulate(times=times, until=4.0, parameters={"A": amplitude}, coordinates=coordinates, **TIGHT)
    assert run.ok, run.reason
    assert len(changes) >= 2
    np.testing.assert_allclose(run["motor.omega"], own[:, 1], rtol=0, atol=1e-7)
    np.testing.assert_allclose(run["motor.theta"], own[:, 0], rtol=0, atol=1e-7)
    assert np.abs(run.energy_error).max() < 1e-8


@pytest.mark.by_turns(2)
@pytest.mark.slow
@pytest.mark.parametrize("coordinates", ["absolute", "joint"])
@pytest.mark.parametrize("efficiency", [(0.5, 0.5), (0.9, 0.8), (0.4, -0.2)])
def test_a_locked_gear_begins_to_lift_and_to_lower(efficiency, coordinates) -> None:
    """It lifts from b + L/(i eta) on, and lowers below eta_back L/i - b; the shaft's force stays within its bound."""
    lift, lower = DRY + LOAD / (RATIO * efficiency[0]), efficiency[1] * LOAD / RATIO - DRY
    for pace, limit in ((1.0, lift), (-1.0, lower)):
        model = machine(efficiency, drive="1.0 + A*t")
        run = model.simulate(until=4.0, parameters={"A": pace}, coordinates=coordinates, **TIGHT)
        assert run.ok, run.reason
        begin = abs(limit - 1.0)
        np.testing.assert_allclose(run["motor.theta"][run.t < begin], 0.0, rtol=0, atol=1e-14)
        slips = {event.name: event.t for event in run.events}
        assert slips["gear.slip"] == slips["shaft.slip"] == pytest.approx(begin, abs=1e-9)
        assert np.abs(run["shaft.force"][run.t < begin]).max() <= DRY * (1.0 + 1e-9)
        assert np.all(pace * run["motor.omega"][run.t > begin + 0.1] > 0.0)
        assert len(run.events) < 20, "efforts are shared out anew a few times only"


@pytest.mark.slow
def test_a_shaft_with_bounds_of_two_directions_beside_a_gear() -> None:
    """The bounds forwards and backwards, 0.8 and 0.3 N m, are those of lifting and of lowering."""
    for pace, limit in ((1.0, 0.8 + LOAD / (RATIO * 0.5)), (-1.0, 0.5 * LOAD / RATIO - 0.3)):
        model = machine((0.5, 0.5), drive="1.0 + A*t", dry={"sliding": {"forwards": 0.8, "backwards": 0.3}})
        run = model.simulate(until=4.0, parameters={"A": pace}, **TIGHT)
        assert run.ok, run.reason
        slips = {event.name: event.t for event in run.events}
        assert slips["gear.slip"] == pytest.approx(abs(limit - 1.0), abs=1e-9)


@pytest.mark.by_turns(3)
@pytest.mark.slow
def test_sweeps_over_the_drive_fail_nowhere() -> None:
    """301 amplitudes from one that moves nothing to one that never rests, with ends as those of own equations."""
    amplitudes = np.linspace(0.5, 12.0, 301)
    swept = symgen.sweep(
        machine((0.5, 0.5)), {"A": amplitudes}, quantities=["motor.theta"], until=3.0, integrator="dop853", rtol=1e-9
    )
    assert set(swept.status.tolist()) == {"ok"}
    ends = np.asarray(swept["motor.theta"]).reshape(301)
    for k in range(0, 301, 30):
        own, _ = Lossy((0.5, 0.5), amplitudes[k]).run(3.0, np.array([0.0, 3.0]))
        assert ends[k] == pytest.approx(own[-1, 0], abs=1e-6), amplitudes[k]

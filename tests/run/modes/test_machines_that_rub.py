"""Machines that rub by their reactions beside stops and contacts, beside an event-driven simulation of their own."""

from pathlib import Path

import numpy as np
import pytest
from support.rotation import of_turn

import symgen
from benchmarks.bounded.rubbing.beside import reference, simulated, swept, values_of
from benchmarks.bounded.rubbing.bodies import Gap, Machine, pin_that_rubs
from benchmarks.bounded.rubbing.machines import MACHINES
from benchmarks.bounded.rubbing.modes import State, strike
from benchmarks.bounded.touch.bodies import GROUND, Pin

#: Values of each machine; all are run in 101 turns, of which none is left out beside tests of every second turn.
VALUES = 300
#: Largest difference [m, rad]; most of it is what the simulation leaves of a series of impacts, at 0.1 mm/s.
OFF = 2e-9


@pytest.mark.parametrize("friction", [0.0, 0.02, 0.05])
def test_the_simulation_knows_what_a_pin_takes_from_an_impact(friction: float) -> None:
    """A slide drops a rod, held by its pin, onto its tip: by hand, with the impulse of the pin along x as well."""
    mass, length, e, angle = 2.0, 0.6, 0.5, 0.7
    x, y = 0.5 * length * np.cos(angle), 0.5 * length * np.sin(angle)
    inertia = mass * length**2 / 12.0

    def tip(q: np.ndarray) -> tuple[float, np.ndarray]:
        return q[1] - y * np.cos(q[2]) - x * np.sin(q[2]), np.array(
            [0.0 * q[0], 1.0, y * np.sin(q[2]) - x * np.cos(q[2])]
        )

    rod = Machine(np.array([mass, mass, inertia]), [], [Gap(tip, e)], [], lambda t, q, v: 0.0 * q)
    rod.joints.append(Pin(GROUND, 0, (0.0, 0.0), (x, y)))
    rod.rubs.append(pin_that_rubs(GROUND, 0, 0, friction))
    state = State(rod, 0.0, np.array([-x, -y, 0.0]), np.array([y, -x, 1.0]) * 3.0)
    after = strike(state, [0], 1e-9)
    assert after.value[2] == pytest.approx(-e * 3.0, rel=1e-12)
    # the pin takes friction times its impulse, which the rod's momentum asks for
    tip_impulse = after.pushes[0]
    pin = np.hypot(mass * (after.value[0] - 3.0 * y), mass * (after.value[1] + 3.0 * x) - tip_impulse)
    turn = (inertia + mass * 0.25 * length**2) * (after.value[2] - 3.0)
    assert turn == pytest.approx(-tip_impulse * 2.0 * x + friction * pin, rel=1e-9)


@pytest.mark.slow
@pytest.mark.parametrize("name", MACHINES)
def test_machines_move_as_their_simulation_says(name: str) -> None:
    """Some of 300 values of a parameter as runs over time; `python -m benchmarks.bounded.rubbing` has all."""
    for value in of_turn(values_of(name, VALUES), 101, name):
        case = MACHINES[name][0](float(value))
        assert np.abs(simulated(case) - reference(case)).max() < OFF


@pytest.mark.parametrize("rtol", [1e-9, 1e-11])
def test_pins_that_stick_at_once_rest_each_within_its_own_bound(rtol: float, tmp_path: Path) -> None:
    """Four pins hold one freedom of the gripper, near their bounds: reactions follow how they share what they hold."""
    value, radius = 0.34046822742474914, 0.01
    (path := tmp_path / "gripper.toml").write_text(MACHINES["gripper"][0](value).text, encoding="utf-8")
    times, tight = [0.0, 0.16], {"integrator": "dop853", "rtol": rtol, "atol": 1e-12, "max_attempts": 20000}
    result = symgen.simulate(path, until=0.16, times=times, verify=False, **tight)
    assert result.ok, result.reason
    assert abs(result["d.omega"][-1]) < 1e-12
    for pin in ("pin2", "pin3", "pin4", "pin5"):
        reaction = np.hypot(result[f"{pin}.Fx"][-1], result[f"{pin}.Fy"][-1])
        assert abs(result[f"{pin}.force"][-1]) <= value * radius * reaction * (1.0 + 1e-8)


@pytest.mark.by_turns(7)
@pytest.mark.slow
@pytest.mark.parametrize("name", MACHINES)
def test_rows_of_300_values_end_as_their_simulation_says_and_none_fails(name: str) -> None:
    values = values_of(name, VALUES)
    statuses, last = swept(name, values)
    assert statuses == ["ok"] * VALUES
    for i in of_turn(range(VALUES), 101, name):
        assert np.abs(last[i] - reference(MACHINES[name][0](float(values[i])))[-1]).max() < OFF

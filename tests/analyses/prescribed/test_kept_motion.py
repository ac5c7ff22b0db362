"""Motions kept for many parameters, with derivatives by these, beside complex steps through closed forms."""

import numpy as np
import pytest
from support.twin import spatial_twin

import symgen
from analyses.rods import of_raw
from symgen.analyses.prescribed.kept_motion import KeptMotion
from symgen.analyses.prescribed.prescribed import NotPrescribed
from symgen.base.errors import InputError
from symgen.base.settings import Settings
from symgen.describe.parts.context import Context
from symgen.describe.parts.scope import Scope

#: Angles of the crank [rad] and its speed [rad/s].
ANGLES, SPEED = np.linspace(0.0, 2.0 * np.pi, 128, endpoint=False), 7.0

PUMP = {
    "mechanism": {"name": "pump", "gravity": [0.0, -9.81]},
    "parameters": {"r": 0.07, "l": 0.31, "m": 2.5, "x0": "sqrt(l**2 - (r*sin(0.4))**2) + r*cos(0.4)"},
    "bodies": {
        "crank": {
            "mass": "10*r",
            "inertia": "10*r**3/12",
            "points": {"O": ["-r/2", 0.0], "P": ["r/2", 0.0]},
            "position": ["0.5*r*cos(0.4)", "0.5*r*sin(0.4)"],
            "angle": 0.4,
        },
        "rod": {
            "mass": "4*l",
            "inertia": "4*l**3/12",
            "points": {"P": ["-l/2", 0.0], "Q": ["l/2", 0.0]},
            "position": ["0.5*(r*cos(0.4) + x0)", "0.5*r*sin(0.4)"],
            "angle": "-asin(r*sin(0.4)/l)",
        },
        "piston": {"mass": "m", "inertia": 0.01, "position": ["x0", 0.0]},
    },
    "joints": {
        "O": {"type": "revolute", "between": ["ground", "crank"], "at": [[0.0, 0.0], "O"]},
        "P": {"type": "revolute", "between": ["crank", "rod"], "at": ["P", "P"]},
        "Q": {"type": "revolute", "between": ["rod", "piston"], "at": ["Q", "centre"]},
        "rail": {
            "type": "translational",
            "between": ["ground", "piston"],
            "at": [[0.0, 0.0], "centre"],
            "axis": [1.0, 0.0],
        },
        "motor": {"type": "driver", "joint": "O", "coordinate": "angle", "value": f"0.4 + {SPEED}*t"},
    },
}


def kept(raw, keys, formulas):
    """Return a function from values of keys and times to the values of formulas and their slopes."""
    model = of_raw(raw) if isinstance(raw, dict) else symgen.load(raw)
    motion = KeptMotion("test", model.mechanism, Settings(), keys, 1.0)
    scope = Scope(Context.of_mechanism(motion.mechanism), "test")
    side = motion.side("quantities", [(text, scope.of_motion("", text)) for text in formulas])
    return lambda x, t: motion.at(np.asarray(x), t).directions.observe(side.function, len(formulas))


def pump(r, length, m):
    """Return place and speed of the piston, angle of the rod and torque of the motor over `ANGLES`."""
    k = np.fft.fftfreq(len(ANGLES), 1.0 / len(ANGLES))
    k[len(k) // 2] = 0.0

    def slope(x):
        return np.fft.ifft(1j * k * np.fft.fft(x))

    def by_angle(x):  # real and imaginary parts apart: the imaginary one is the step
        return slope(x.real).real + 1j * slope(x.imag).real

    rod = -np.arcsin(r * np.sin(ANGLES) / length)
    x = r * np.cos(ANGLES) + length * np.cos(rod)
    px, py = 0.5 * (r * np.cos(ANGLES) + x), 0.5 * r * np.sin(ANGLES)
    inertia = (10 * r) * r**2 / 3 + 4 * length * (by_angle(px) ** 2 + by_angle(py) ** 2)
    inertia = inertia + 4 * length**3 / 12 * by_angle(rod) ** 2 + m * by_angle(x) ** 2
    height = 10 * r * 0.5 * r * np.sin(ANGLES) + 4 * length * py
    torque = 0.5 * SPEED**2 * by_angle(inertia) + 9.81 * by_angle(height)
    return np.array([x, SPEED * by_angle(x), rod, torque])


@pytest.mark.slow
def test_slopes_of_places_speeds_and_torque_are_those_of_a_closed_form():
    at = kept(PUMP, ["r", "l", "m"], ["piston.x", "piston.vx", "rod.theta", "motor.effort"])
    numbers, times = np.array([0.06, 0.35, 3.1]), (ANGLES - 0.4) / SPEED
    later = times >= 0.0
    values, slopes = at(numbers, times[later])
    expected = pump(*numbers.astype(complex)).real[:, later]
    size = np.abs(expected).max(axis=1)
    assert (np.abs(values.T - expected).max(axis=1) / size).max() < 1e-11
    for i in range(3):
        step = numbers.astype(complex)
        step[i] += 1e-30j
        beside = (pump(*step).imag / 1e-30)[:, later]
        assert np.abs(slopes[:, :, i].T - beside).max() < 1e-10 * np.abs(beside).max()


def test_the_motion_at_values_does_not_depend_on_the_values_before():
    at = kept(PUMP, ["r", "l"], ["piston.x", "motor.effort"])
    times = np.linspace(0.0, 1.0, 40)
    first = at([0.05, 0.4], times)
    for x in ([0.1, 0.2], [0.02, 0.5]):
        at(x, times)
    again = at([0.05, 0.4], times)
    assert np.array_equal(first[0], again[0]) and np.array_equal(first[1], again[1])


@pytest.mark.by_turns(2)
@pytest.mark.slow
def test_slopes_in_space_are_those_of_differences_of_kinematics():
    twin = spatial_twin(PUMP | {"joints": {name: PUMP["joints"][name] for name in ("O", "P", "Q", "rail")}}, {})
    twin["joints"]["motor"] = PUMP["joints"]["motor"]
    columns, keys = ["piston.x", "rod.e3", "piston.vx", "motor.effort"], ["r", "l", "m"]
    numbers, times = np.array([0.06, 0.35, 3.1]), np.linspace(0.0, 1.0, 21)
    values, slopes = kept(twin, keys, columns)(numbers, times)

    def kinematics(x):
        found = of_raw(twin).kinematics(times, parameters=dict(zip(keys, x.tolist(), strict=True)))
        return np.column_stack([*(found[name] for name in columns[:3]), found.efforts["motor"]])

    assert np.abs(values - kinematics(numbers)).max() < 1e-12
    for i, step in enumerate(1e-3 * numbers * np.eye(3)):
        near = [kinematics(numbers + k * step) for k in (-2, -1, 1, 2)]
        beside = (near[0] - 8 * near[1] + 8 * near[2] - near[3]) / (12 * step[i])
        assert np.abs(slopes[:, :, i] - beside).max() < 1e-8 * np.abs(beside).max()


def test_a_state_of_the_file_is_no_motion_of_positions_alone():
    raw = PUMP | {"states": {"heat": {"start": 0.0, "rate": "motor.power"}}}
    with pytest.raises(NotPrescribed, match="states of the file's own"):
        kept(raw, ["r"], ["piston.x"])


# -- kinematics --------------------------------------------------------------------------------------------------------


def test_kinematics_has_derivatives_of_motion_loads_and_energies_by_dimensions():
    raw = PUMP | {"outputs": {"stroke": {"value": "1000*(piston.x - x0)", "unit": "mm"}}}
    numbers, times = {"r": 0.06, "l": 0.35, "m": 3.1}, (ANGLES - 0.4) / SPEED
    later = times >= 0.0
    motion = of_raw(raw).kinematics(times[later], parameters=numbers, sensitivities=("r", "l", "m", "x0"))
    assert motion.sensitivities.names == ("r", "l", "m", "x0")
    columns = ("piston.x", "piston.vx", "rod.theta", "motor.effort")
    for i, name in enumerate("rlm"):
        step = np.array([*numbers.values()]).astype(complex)
        step[i] += 1e-30j
        beside = (pump(*step).imag / 1e-30)[:, later]
        for column, expected in zip(columns, beside, strict=True):
            assert np.abs(motion.gradient(column)[name] - expected).max() < 1e-10 * np.abs(beside).max()
        assert np.abs(motion.gradient("2*piston.x")[name] - 2.0 * beside[0]).max() < 1e-11
    assert motion.gradient("motor.effort").units == ("N m",) * 4  # plain numbers have no unit
    # the power of the motor is the rate of all energy
    rate = np.gradient(motion.gradient("energy.total")["l"], motion.t, edge_order=2)
    assert np.abs(rate - SPEED * motion.gradient("motor.effort")["l"])[2:-2].max() < 0.02 * np.abs(rate).max()
    # a pin carries m a of the piston along the rail
    force, mass = motion.gradient("Q.Fx"), motion["piston.ax"]
    assert np.abs(np.abs(force["m"]) - np.abs(mass)).max() < 1e-9 * np.abs(mass).max()


def test_derivatives_of_kinematics_are_refused_in_one_sentence():
    model, times = of_raw(PUMP), [0.0, 0.1]
    with pytest.raises(InputError, match="kinematics: sensitivities: expected parameters of the mechanism, got 'rr'"):
        model.kinematics(times, sensitivities=("rr",))
    with pytest.raises(InputError, match="gradient: expected kinematics with sensitivities"):
        model.kinematics(times).gradient("piston.x")
    with pytest.raises(InputError, match="gradient: got the unknown body or joint 'pistn'; did you mean 'piston'"):
        model.kinematics(times, sensitivities=("r",)).gradient("pistn.x")
    with pytest.raises(InputError, match="expected a motion without singular positions"):
        model.kinematics(np.linspace(0.0, 1.0, 50), sensitivities=("r",), parameters={"r": 0.32, "l": 0.32})

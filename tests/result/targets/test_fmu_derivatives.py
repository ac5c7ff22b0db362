"""Directional derivatives of FMUs, by FMPy's own calls: beside differences of the FMU's values at 1e-6."""

import ctypes
import tomllib
import zipfile

import numpy as np
import pytest
from fmpy import extract, read_model_description
from fmpy.fmi1 import FMICallException
from fmpy.fmi2 import FMU2Model, FMU2Slave
from fmpy.fmi3 import FMU3Model, FMU3Slave
from fmpy.validation import validate_fmu
from support.emitted import mechanism_of
from support.holding import MACHINES as MACHINES_THAT_HOLD

from symgen import load
from symgen.base.errors import InputError
from symgen.describe import catalogue
from tests.result.targets.test_fmu import fmu_of


def press():
    """A slider-crank in a loop: a reaction, an acceleration, a filter of the state and a load by a table of rate."""
    raw = catalogue.raw("slider-crank")
    raw["inputs"] = {"torque": {"default": 0.4, "unit": "N m"}, "pull": {"default": 2.0, "unit": "N"}}
    raw["states"] = {"filtered": {"start": 0.3, "rate": "8.0*(slider.vx - filtered)"}}
    raw["forces"] = {
        "drive": {"type": "torque", "body": "crank", "torque": "torque*cos(3*t) - 0.01*crank.omega*abs(crank.omega)"},
        "load": {"type": "force", "body": "slider", "force": ["pull*tanh(4*slider.vx) - min(slider.x, 0.2)", 0.0]},
    }
    raw["outputs"] = {
        "bearing": {"value": "O.Fx", "unit": "N"},
        "ax": {"value": "slider.ax", "unit": "m/s^2"},
        "work": {"value": "integral(drive.power)", "unit": "J"},
        "mixed": {"value": "filtered**2*sqrt(1 + crank.omega**2)"},
    }
    return load(mechanism_of(raw))


def spatial():
    """A loop with a ball and a universal joint, pushed along its guide."""
    raw = catalogue.raw("spatial-slider-crank")
    raw["inputs"] = {"push": {"default": 3.0, "unit": "N"}}
    raw["forces"] = {"push": {"type": "force", "body": "slider", "force": ["push - 0.2*slider.vx*t", 0.0, 0.0]}}
    raw["outputs"] = {"rod": {"value": "rod.ay", "unit": "m/s^2"}, "guide": {"value": "guide.Fz", "unit": "N"}}
    return load(mechanism_of(raw))


def driven():
    """A lever whose angle a driver takes from an input and its rate, on a sliding mass."""
    raw = catalogue.raw("cart-pole")
    raw["joints"]["wheel"] = {"type": "rows", "rows": [{"velocity": "cart.vx + 0.3*sin(t)*pole.omega - 0.1*t"}]}
    raw["bodies"]["cart"].pop("velocity")
    return load(mechanism_of(raw))


MACHINES = {
    "press": (press, "absolute"),
    "press-in-joints": (press, "joint"),
    "spatial": (spatial, "absolute"),
    "spatial-in-joints": (spatial, "joint"),
    "cart-pole": (lambda: load("cart-pole"), "joint"),
    "velocities": (driven, "absolute"),
    "bicycle": (lambda: load("bicycle"), "absolute"),
}


class Unit:
    """An FMU past its initialisation.

    Parameters
    ----------
    path : Path
        The FMU.
    kind : {"ModelExchange", "CoSimulation"}
        How it is used.
    parameters : dict
        Values set before the initialisation.
    """

    def __init__(self, path, kind="ModelExchange", parameters=()):
        self.description = description = read_model_description(str(path))
        self.variables = {v.name: v for v in description.modelVariables}
        self.two, exchange, self.words = description.fmiVersion == "2.0", kind == "ModelExchange", []
        own = description.modelExchange if exchange else description.coSimulation
        classes = (FMU2Slave, FMU2Model) if self.two else (FMU3Slave, FMU3Model)
        self.fmu = classes[exchange](
            guid=description.guid, unzipDirectory=extract(str(path)), modelIdentifier=own.modelIdentifier,
            instanceName="unit",
        )  # fmt: skip
        self.fmu.instantiate()
        if self.two:
            self.fmu.setupExperiment(startTime=0.0)
        for name, value in dict(parameters).items():
            self[name] = value
        self.fmu.enterInitializationMode()
        self.fmu.exitInitializationMode()
        self.states = [name for name in self.variables if name.startswith("state.")]
        self.rates = [f"der({name})" for name in self.states]
        self.inputs = [name for name, v in self.variables.items() if v.causality == "input"]
        self.outputs = [name for name, v in self.variables.items() if v.causality == "output"]

    def refs(self, names):
        return [self.variables[name].valueReference for name in names]

    def values(self, names):
        get = self.fmu.getReal if self.two else self.fmu.getFloat64
        return np.array(get(self.refs(names)))

    def __setitem__(self, name, value):
        (self.fmu.setReal if self.two else self.fmu.setFloat64)(self.refs([name]), [value])

    def set_states(self, t, values):
        self.fmu.setTime(t)
        self.fmu.setContinuousStates((ctypes.c_double * len(values))(*values), len(values))

    def directions(self, unknowns, knowns, seeds):
        return np.array(self.fmu.getDirectionalDerivative(self.refs(unknowns), self.refs(knowns), list(seeds)))

    def matrix(self, unknowns, knowns):
        columns = [self.directions(unknowns, [name], [1.0]) for name in knowns]
        return np.array(columns).T.reshape(len(unknowns), len(knowns))


def differences(unit, t, states, inputs, h=1e-6):
    """The same matrix by central differences, and the column of time."""
    unknowns = [*unit.outputs, *unit.rates]

    def at(t, states, inputs):
        for name, value in zip(unit.inputs, inputs, strict=True):
            unit[name] = value
        unit.set_states(t, states)
        return unit.values(unknowns)

    columns = []
    for k in range(len(states) + len(inputs) + 1):
        step = np.zeros(len(states) + len(inputs) + 1)
        step[k] = h
        high, low = (
            at(t + s * step[-1], states + s * step[: len(states)], inputs + s * step[len(states) : -1]) for s in (1, -1)
        )
        columns.append((high - low) / (2 * h))
    at(t, states, inputs)
    return np.array(columns).T


@pytest.mark.by_turns(6)
@pytest.mark.slow
@pytest.mark.slow_cases("press-2")
@pytest.mark.parametrize(("name", "fmi"), [(name, 2 + i % 2) for i, name in enumerate(MACHINES)])
def test_they_are_those_of_differences(name, fmi, tmp_path):
    make, coordinates = MACHINES[name]
    path = fmu_of(make(), tmp_path / "unit.fmu", fmi=fmi, coordinates=coordinates, derivatives=True)
    assert validate_fmu(str(path)) == []
    unit = Unit(path)
    random = np.random.default_rng(3)
    states = unit.values(unit.states)
    states += 0.02 * random.uniform(-1, 1, len(states))
    inputs = unit.values(unit.inputs) + 0.3
    # what the description says does not depend on inputs does not
    free = [x.variable.name for x in unit.description.outputs if x.dependencies is not None]
    assert {"press": {"mixed", "work"}, "spatial": {"rod.x"}, "velocities": {"cart.x"}}.get(name, set()) <= {*free}
    assert {"bearing", "ax", "rod", "guide", "push"}.isdisjoint(free) and not unit.matrix(free, unit.inputs).any()
    t, unknowns, knowns = 0.31, [*unit.outputs, *unit.rates], [*unit.states, *unit.inputs]
    expected = differences(unit, t, states, inputs)
    found = unit.matrix(unknowns, knowns)
    size = np.abs(expected).max(axis=1, keepdims=True) + 1.0
    assert np.abs((found - expected[:, :-1]) / size).max() < 1e-6
    seeds = random.uniform(-1, 1, len(knowns))
    # a direction is linear in its seeds, to rounding
    assert np.abs((unit.directions(unknowns, knowns, seeds) - found @ seeds) / size[:, 0]).max() < 1e-11
    if fmi == 3:
        by_time = unit.directions(unknowns, ["time"], [1.0])
        assert np.abs((by_time - expected[:, -1]) / size[:, 0]).max() < 1e-6
        weights = random.uniform(-1, 1, len(unknowns))
        adjoint = unit.fmu.getAdjointDerivative(unit.refs(unknowns), unit.refs(knowns), list(weights), len(knowns))
        np.testing.assert_allclose(adjoint, weights @ found, rtol=0, atol=1e-11 * np.abs(found).max())


@pytest.mark.by_turns(2)
@pytest.mark.slow
@pytest.mark.parametrize("fmi", [2, 3])
def test_a_co_simulation_has_them_at_its_points_of_communication(fmi, tmp_path):
    path = fmu_of(press(), tmp_path / "press.fmu", fmi=fmi, derivatives=True)
    unit, exchange = Unit(path, "CoSimulation"), Unit(path)
    unit["torque"] = exchange["torque"] = 0.7
    unit.fmu.doStep(0.0, 0.25)
    exchange.set_states(0.25, unit.values(unit.states))
    unknowns, knowns = [*unit.outputs, *unit.rates], [*unit.states, *unit.inputs]
    found = unit.matrix(unknowns, knowns)
    expected = exchange.matrix(unknowns, knowns)
    np.testing.assert_allclose(found, expected, rtol=0, atol=1e-9 * np.abs(expected).max())
    high, low = [], []
    for values, shift in ((high, 1e-5), (low, -1e-5)):
        unit["torque"] = 0.7 + shift
        values += [*unit.values(unknowns)]
    by_torque = (np.array(high) - low) / 2e-5
    np.testing.assert_allclose(found[:, knowns.index("torque")], by_torque, rtol=1e-6, atol=1e-6)


@pytest.mark.by_turns(2)
@pytest.mark.slow
def test_between_events_they_are_those_of_the_modes_in_force(tmp_path):
    raw = catalogue.raw("belt-oscillator")
    raw["inputs"] = {"pull": {"default": 0.0, "unit": "N"}}
    raw["forces"]["spring"]["force"] = ["pull - stiffness*block.x*(1 + block.x)", 0.0]
    raw["outputs"] = {"slip": {"value": "contact.displacement.rate", "unit": "m/s"}}
    path = fmu_of(load(mechanism_of(raw)), tmp_path / "belt.fmu", derivatives=True)
    for speed, slides in ((0.1, False), (0.3, True)):
        unit = Unit(path, parameters={"speed": speed})
        states = unit.values(unit.states)
        unknowns, knowns = [*unit.outputs, *unit.rates], [*unit.states, *unit.inputs]
        if slides:  # the force of the spring breaks the block loose
            states[unit.values(unit.states) == 0.0] = 0.0
            unit["pull"] = 20.0
            unit.fmu.enterEventMode()
            unit.fmu.newDiscreteStates()
        states = unit.values(unit.states)
        found = unit.matrix(unknowns, knowns)
        expected = differences(unit, 0.0, states, unit.values(unit.inputs))[:, :-1]
        np.testing.assert_allclose(found, expected, rtol=1e-6, atol=1e-6)
        by_pull = found[unknowns.index("block.vx") + 0, knowns.index("pull")]
        accelerations = np.abs(found[len(unit.outputs) :, knowns.index("pull")])
        # what rests on the belt takes no force; what slides is accelerated by 1/m
        assert by_pull == 0.0 and accelerations.max() == pytest.approx(1.0 if slides else 0.0, abs=1e-9)


@pytest.mark.slow
def test_what_has_none_says_so(tmp_path):
    path = fmu_of(load("cart-pole"), tmp_path / "plain.fmu")
    with zipfile.ZipFile(path) as archive:
        assert b"irectional" not in archive.read("modelDescription.xml")
        assert b"directed" not in archive.read("sources/cart_pole.c")
    with pytest.raises(
        InputError, match=r"derivatives: expected an FMU for model exchange, .*, got the steps of 'dop853'"
    ):
        fmu_of(load("cart-pole"), tmp_path / "run.fmu", integrator="dop853", derivatives=True)
    holding = mechanism_of(tomllib.loads(MACHINES_THAT_HOLD["rope"]))
    with pytest.raises(InputError, match=r"derivatives: expected an FMU for model exchange, .*, got joints that hold"):
        fmu_of(load(holding), tmp_path / "rope.fmu", derivatives=True)
    assert sorted(x.name for x in tmp_path.iterdir()) == ["plain.fmu"]


@pytest.mark.slow
def test_what_is_no_derivative_is_refused_in_a_sentence(tmp_path):
    unit = Unit(fmu_of(load("cart-pole"), tmp_path / "unit.fmu", fmi=3, derivatives=True))
    for unknowns, knowns in ((["der(state.1)"], ["pole_mass"]), (["gain_x"], ["state.1"])):
        with pytest.raises(FMICallException):
            unit.directions(unknowns, knowns, [1.0])
    with pytest.raises(FMICallException):
        unit.fmu.getDirectionalDerivative(unit.refs(unit.rates), unit.refs(["state.1"]), [1.0], 1)
    assert unit.directions(["der(state.1)"], ["state.3"], [1.0]) == [1.0]

"""Energy lost in dry friction and at stops against paths, rates at impacts and the change of the energy."""

import copy
from typing import Any

import numpy as np
import pytest

import symgen
from symgen.base.errors import InputError
from symgen.describe.files.load import parse_toml, read_raw
from symgen.describe.files.validate import validate
from symgen.describe.mechanism import Mechanism

TIGHT: dict[str, Any] = {"integrator": "dop853", "rtol": 1e-12, "atol": 1e-12}

#: A block that is thrown against a spring; its rail rubs, in motion by the bound and by the rate.
BLOCK = """
[mechanism]
name = "block"

[bodies.block]
mass = 2.0
inertia = 1.0
velocity = [3.0, 0.0]

[joints.rail]
type = "translational"
between = ["ground", "block"]
at = [[0.0, 0.0], [0.0, 0.0]]
axis = [1.0, 0.0]
FRICTION

[forces.spring]
type = "force"
body = "block"
force = ["-30*block.x", 0.0]

[outputs]
lost = { value = "rail.dissipated", unit = "J" }
"""


def described(text: str) -> Mechanism:
    return validate(parse_toml(text, "file.toml"), "file.toml")


def with_friction(keys: str) -> symgen.Model:
    return symgen.load(described(BLOCK.replace("FRICTION", f"friction = {{ {keys} }}")))


@pytest.mark.slow_cases("joint")
@pytest.mark.parametrize("coordinates", ["absolute", "joint"])
def test_a_constant_bound_takes_its_force_times_the_path(coordinates: str) -> None:
    """Rest after half swings: the path is that between turns, which the sum of energies gives, too."""
    result = with_friction("sliding = 4.0, static = 5.0").simulate(until=4.0, coordinates=coordinates, **TIGHT)
    places = [0.0, *(event.q["block.x"] for event in result.events if not event.name.endswith(".slip"))]
    assert [event.name for event in result.events][-1] == "rail.stick" and len(places) > 3
    path = np.abs(np.diff(places)).sum()
    assert abs(result.outputs["lost"][-1] - 4.0 * path) < 1e-9
    stored = result.kinetic + 15.0 * result["block.x"] ** 2
    np.testing.assert_allclose(result.outputs["lost"], 9.0 - stored, rtol=0, atol=1e-9)


@pytest.mark.parametrize(
    "keys",
    [
        "sliding = 1.0, static = 2.0, viscous = 0.3, stribeck_speed = 0.5",
        'sliding = 2.0, law = "tanh", speed = 0.05',
    ],
)
def test_losses_are_what_energies_lack(keys: str) -> None:
    result = with_friction(keys).simulate(until=3.0, **TIGHT)
    stored = result.kinetic + 15.0 * result["block.x"] ** 2
    np.testing.assert_allclose(result.outputs["lost"], 9.0 - stored, rtol=0, atol=1e-8)


def pins(**keys: Any) -> symgen.Model:
    """Return the four-bar with friction in some pins, each with its loss as an output."""
    raw, source = read_raw("four-bar")
    raw = copy.deepcopy(raw)
    for name, friction in keys.items():
        raw["joints"][name]["friction"] = friction
    raw["outputs"] = {f"lost_{name}": f"{name}.dissipated" for name in keys}
    return symgen.load(validate(raw, source))


@pytest.mark.slow_cases("dop853", "radau5", "picard")
@pytest.mark.parametrize("integrator", ["dop853", "picard", "radau5"])
def test_pins_of_a_loop_share_what_the_energy_lacks(integrator: str) -> None:
    """Each pin of a constant bound by its path, one by its reaction; together all of it."""
    model = pins(A={"sliding": 3.0}, C={"sliding": 2.0}, D={"coefficient": 0.3, "radius": 0.05})
    until = 4.0
    result = model.simulate(until=until, output_step=2e-3, **(TIGHT | {"integrator": integrator}))
    lost = {name: result.outputs[f"lost_{name}"] for name in "ACD"}
    total = result.kinetic + result.potential
    np.testing.assert_allclose(sum(lost.values()), total[0] - total, rtol=0, atol=1e-6)
    assert all(np.diff(values).min() > -1e-9 and values[-1] > 0.5 for values in lost.values())
    angle = result["A.angle"] if "A.angle" in result.joint_coordinates.names else None
    assert angle is not None
    turns = [angle[0], *(event.q["crank.theta"] for event in result.events if event.name.startswith("A.")), angle[-1]]
    turns = np.array(turns)
    turns[1:-1] += angle[0] - result["crank.theta"][0]
    assert abs(lost["A"][-1] - 3.0 * np.abs(np.diff(turns)).sum()) < 1e-6


#: Two balls, one above the other, that fall on a floor; the gaps of both have restitutions.
BALLS = """
[mechanism]
name = "balls"
gravity = [0.0, -10.0]

[bodies.low]
type = "point"
mass = 1.0
position = [0.0, 1.0]

[bodies.high]
type = "point"
mass = 0.5
position = [0.0, 1.5]

[stops.floor]
gap = "low.y"
restitution = 0.6

[stops.between]
gap = "high.y - low.y"
restitution = 0.3

[outputs]
floor = "floor.dissipated"
both = "floor.dissipated + between.dissipated"
"""


def test_impacts_take_what_the_energy_lacks() -> None:
    """To rest through two series of impacts: all of the energy at the start, m g h of both."""
    result = symgen.load(described(BALLS)).simulate(until=6.0, output_step=0.01, **TIGHT)
    total = result.kinetic + result.potential
    np.testing.assert_allclose(result.outputs["both"], total[0] - total, rtol=0, atol=1e-9)
    assert abs(result.outputs["both"][-1] - 17.5) < 1e-6
    first = next(event for event in result.events if event.name == "floor.hit")
    assert abs(result.outputs["floor"][round(first.t / 0.01) + 1] - 0.5 * 20.0 * (1.0 - 0.36)) < 1e-9


@pytest.mark.slow
def test_rows_of_a_sweep_have_the_losses_of_single_runs() -> None:
    model = symgen.load(
        described(
            BALLS.replace("[bodies.low]", "[parameters]\ne = 0.6\n\n[bodies.low]").replace(
                "restitution = 0.6", 'restitution = "e"'
            )
        )
    )
    settings, values = {"until": 1.0, "times": [1.0], **TIGHT}, (0.2, 0.6)
    rows = model.sweep({"e": list(values)}, quantities=["both"], **settings)["both"][:, -1]
    alone = [model.simulate(parameters={"e": e}, verify=False, **settings).outputs["both"][-1] for e in values]
    assert rows.tolist() == alone


@pytest.mark.parametrize("method", ["hamiltonian-baumgarte", "augmented-hamiltonian"])
def test_methods_with_momenta_integrate_no_losses(method: str) -> None:
    with pytest.raises(InputError, match=r"a method that integrates velocities, as an output is an integral"):
        with_friction("sliding = 4.0").simulate(method=method, integrator="rk4", step=1e-3, until=0.1)


def test_analyses_that_leave_friction_out_leave_its_losses_out() -> None:
    """Resting at the middle of the spring, with the frequency of a block without friction."""
    model = with_friction("sliding = 4.0")
    rest = model.equilibrium()
    assert abs(rest.q["block.x"]) < 1e-9
    assert abs(rest.omega_squared[0] - 15.0) < 1e-9


def test_names_of_losses_are_checked() -> None:
    text = BLOCK.replace("FRICTION", "friction = { sliding = 4.0 }")
    with pytest.raises(InputError, match=r"outputs\.lost.*'dissipated', which .*'rail' does not have"):
        described(BLOCK.replace("FRICTION", ""))
    with pytest.raises(InputError, match=r"which .*'rail' does not have"):
        described(text.replace('force = ["-30*block.x", 0.0]', 'force = ["-rail.dissipated", 0.0]'))

"""Ropes in space, gears at rest beside dry friction, and joints that hand over, in C: the states of runs."""

import numpy as np
import pytest

import symgen
from tests.result.targets.compilers import compiled, written
from tests.result.targets.test_c_runs import rows_in, run_of
from tests.result.targets.test_holding import away_from_events


def rope() -> symgen.MechanismBuilder:
    builder = symgen.MechanismBuilder("rope", space="spatial", gravity=(0.0, 0.0, -9.81))
    builder.body("ball", type="point", mass=1.0, position=(0.4, 0.0, -0.3), velocity=(0.3, 0.9, 0.2))
    builder.body("weight", type="point", mass=1.5, position=(-0.4, 0.0, -0.5))
    over = [{"at": (0.0, 0.0, 0.0)}, {"at": (-0.2, 0.0, 0.1), "radius": 0.1, "turn": "right", "axis": (0.0, 1.0, 0.0)}]
    builder.joint("rope", "rope", between=("ball", "weight"), at=("centre", "centre"), over=over)
    return builder.output("pull", "rope.tension")


def gear() -> symgen.MechanismBuilder:
    builder = symgen.MechanismBuilder("gear")
    builder.body("motor", mass=1.0, inertia=1.0).body("drum", mass=1.0, inertia=1.5, position=(0.3, 0.0))
    dry = {"friction": {"sliding": 0.5}}
    builder.joint("shaft", "revolute", between=("ground", "motor"), at=((0.0, 0.0), "centre"), **dry)
    builder.joint("axle", "revolute", between=("ground", "drum"), at=((0.3, 0.0), "centre"))
    builder.joint("mesh", "gear", between=("motor", "drum"), ratio=2.0, efficiency=[0.5, 0.5])
    builder.force("drive", "torque", body="motor", torque="6*sin(3*t)")
    return builder.force("load", "torque", body="drum", torque=3.0)


def clutches() -> symgen.MechanismBuilder:
    builder = symgen.MechanismBuilder("clutches")
    for name, inertia, speed in zip("abc", (2.0, 1.0, 0.5), (3.0, -1.0, 2.0), strict=True):
        builder.body(name, mass=1.0, inertia=inertia, angular_velocity=speed)
        builder.joint(f"at_{name}", "revolute", between=("ground", name), at=((0.0, 0.0), "centre"))
    for name, pair, holds in (("left", "ab", "t > 0.1 and t < 0.3"), ("right", "bc", "t > 0.3")):
        builder.joint(name, "rigid", between=tuple(pair), at=("centre", "centre"), holds=holds, holds_at="present")
    return builder


@pytest.mark.by_turns(3)
@pytest.mark.slow
@pytest.mark.parametrize("machine", [rope, gear, clutches], ids=lambda f: f.__name__)
def test_c_has_the_states_of_runs(machine, tmp_path) -> None:
    mechanism = machine().run(until=0.6).build()
    rows = rows_in(run_of(compiled(written(mechanism, tmp_path / "c"))).stdout)
    result = symgen.load(mechanism).simulate(integrator="rk4", times=rows[:, 0])
    own = np.array([result[name] for name in (*result.q.names, *result.v.names)]).T
    away = away_from_events(result, rows[:, 0]) if result.events else np.ones(len(rows), dtype=bool)
    assert result.ok and np.sum(away) > 400
    np.testing.assert_allclose(rows[away, 1 : own.shape[1] + 1], own[away], rtol=0, atol=1e-12)

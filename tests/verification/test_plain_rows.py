"""The reference's own derivatives against differences along a motion, for every kind of joint and force."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from benchmarks.mechanisms.draw import draw
from benchmarks.plain import forces, joints_plane, joints_space
from benchmarks.plain.motion import integrate
from benchmarks.plain.start import start
from benchmarks.plain.system import System, read

STEP = 1e-4
#: Mechanisms of this seed; together they have every kind.
SEED, COUNT = 11, 140


def kinds(raw) -> set[str]:
    return {t["type"] for section in ("joints", "forces") for t in raw.get(section, {}).values()}


def roped(raw):
    """Return a file of the plane whose rods of constant length are ropes."""
    joints = {
        name: {**t, "type": "rope"} if t["type"] == "distance" else t for name, t in raw.get("joints", {}).items()
    }
    return {**raw, "joints": joints}


def along(system: System, q, v, a, time: float):
    """State of a motion with velocities v and accelerations a at time 0, right to second order."""
    found, rate = q.copy(), v + time * a
    for body in system.bodies.values():
        i, k, d = body.first_q, body.first_v, system.document.dimension
        n = d if d == 3 else len(body.velocities)
        found[i : i + n] = q[i : i + n] + time * v[k : k + n] + 0.5 * time**2 * a[k : k + n]
        if d == 3 and body.rigid:
            turned = Rotation.from_rotvec(time * v[k + 3 : k + 6] + 0.5 * time**2 * a[k + 3 : k + 6])
            now = Rotation.from_quat(q[i + 3 : i + 7], scalar_first=True) * turned
            found[i + 3 : i + 7] = now.as_quat(scalar_first=True)
    return found, rate


def close(mine, theirs, size: float) -> None:
    np.testing.assert_allclose(mine, theirs, rtol=0.0, atol=2e-6 * size)


@pytest.mark.by_turns(2)
@pytest.mark.slow
@pytest.mark.parametrize("spatial", [False, pytest.param(True, marks=pytest.mark.slow)])
def test_every_row_has_the_derivatives_of_its_value(spatial: bool) -> None:
    seen = set()
    for index in range(COUNT):
        drawn = draw(SEED, index, spatial)
        if kinds(drawn.raw) <= seen:
            continue
        raw = drawn.raw if spatial or "rope" in seen else roped(drawn.raw)
        seen |= kinds(drawn.raw) | kinds(raw)
        system, rng = read(raw), np.random.default_rng(index)
        begin = start(system)
        q, t = system.moved(begin.q, 0.1 * rng.standard_normal(system.nv)), 0.4
        v, a = rng.standard_normal(system.nv), rng.standard_normal(system.nv)
        system.follow(system.at(t, q, v))
        here = system.constraints(system.at(t, q, v))
        (before, then), (behind, later) = (along(system, q, v, a, s * STEP) for s in (-1.0, 1.0))
        down, up = (
            system.constraints(system.at(t + s * STEP, x, u))
            for s, x, u in ((-1.0, before, then), (1.0, behind, later))
        )
        held = system.holonomic
        size = 1.0 + np.abs(here.d @ a - here.gamma).max(initial=0.0)
        close((up.phi - down.phi)[held] / (2 * STEP), (here.d @ v - here.nu)[held], size)
        second = (up.phi - 2 * here.phi + down.phi)[held] / STEP**2
        close(second, (here.d @ a - here.gamma)[held], size)
        rates = (up.d @ later - up.nu) - (down.d @ then - down.nu)
        close(rates[~held] / (2 * STEP), (here.d @ a - here.gamma)[~held], size)
    table = joints_space.KINDS if spatial else joints_plane.KINDS
    assert seen >= set(table) - {"prismatic", "point-on-line", "inline", "in-plane", "place"}, set(table) - seen


@pytest.mark.by_turns(2)
@pytest.mark.slow
@pytest.mark.parametrize("spatial", [False, pytest.param(True, marks=pytest.mark.slow)])
def test_forces_with_a_potential_are_its_gradient(spatial: bool) -> None:
    seen = set()
    for index in range(COUNT):
        drawn = draw(SEED, index, spatial)
        own = {t["type"] for t in drawn.raw.get("forces", {}).values()}
        if not own or (own <= seen and index > 40):
            continue
        seen |= own
        system, rng = read(drawn.raw), np.random.default_rng(index)
        q, zero = start(system).q, np.zeros(system.nv)
        system.follow(system.at(0.3, q, zero))
        total, other, _ = system.loads(system.at(0.3, q, zero))
        for _ in range(3):
            way = rng.standard_normal(system.nv)
            (before, _), (behind, _) = (along(system, q, way, zero, s * STEP) for s in (-1.0, 1.0))
            slope = (system.loads(system.at(0.3, behind, zero))[2] - system.loads(system.at(0.3, before, zero))[2]) / (
                2 * STEP
            )
            close((total - other) @ way, -slope, 1.0 + np.abs(total).max() + abs(slope))
    assert seen >= set(forces.KINDS) - ({"bushing"} if not spatial else set())


@pytest.mark.slow_cases("3", "1")
@pytest.mark.parametrize("index", range(8))
def test_energy_less_work_stays(index: int) -> None:
    drawn = draw(SEED, index)
    system = read(drawn.raw)
    begin = start(system)
    motion = integrate(system, begin.q, begin.v, np.linspace(0.0, 0.3, 4), rtol=1e-10, least=0.04, most=6000)
    assert motion.drift < 1e-7 * max(1.0, motion.energy_scale)

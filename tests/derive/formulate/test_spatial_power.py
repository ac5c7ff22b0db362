"""Power balance in space on states that fulfil D v = nu, by the emitted law: what constraints may and may not do."""

import numpy as np
import pytest
from support.checks import close
from support.emitted import Emitted, mechanism_of
from support.random_space import make
from support.space import Space

#: Few enough rows each that bodies can move; together all kinds.
SCLERONOMIC = (
    ("revolute", "spherical"),
    ("universal", "point-on-plane"),
    ("cylindrical", "pin-in-slot"),
    ("planar", "revolute-spherical"),
    ("screw", "distance"),
    ("constant-velocity", "rolling-disc"),
    ("translational", "knife-edge"),
    ("rigid",),
    ("rolling-sphere", "distance"),
    ("gear",),
    ("rack-and-pinion",),
)
FORCES = ("spring-damper", "force", "bushing")


def balance(case, seed):
    """(numbers of the law, Space, q, v, D, nu) at random positions, velocities projected on D v = nu."""
    for attempt in range(40):
        rng = np.random.default_rng((seed, attempt))
        raw, t, q, v = make(rng, case, FORCES)
        space = Space(raw)
        emitted_rows = space.jacobian(t, q, v)
        d = np.array(list(emitted_rows.values()))
        scaled = d / np.maximum(1e-9, np.linalg.norm(d, axis=1, keepdims=True))
        if len(d) < space.nv and np.linalg.svd(scaled, compute_uv=False)[-1] > 0.05:
            break
    nu = np.array([space.nu(t, q)[name] for name in emitted_rows])
    v = np.asarray(v) - np.linalg.pinv(d) @ (d @ v - nu)
    emitted = Emitted(mechanism_of(raw))
    found = emitted.at(t, q, v.tolist(), emitted.parameters(space.values))
    order = [list(emitted_rows).index(row.name) for row in emitted.info.rows]
    return found, space, t, q, v, d[order], nu[order]


@pytest.mark.slow_cases("constant-velocity-rolling-disc", "gear", "planar-revolute-spherical")
@pytest.mark.parametrize("case", range(len(SCLERONOMIC)), ids=["-".join(c) for c in SCLERONOMIC])
def test_scleronomic_joints_do_no_work(case):
    found, space, t, q, v, d, nu = balance(SCLERONOMIC[case], case)
    assert not nu.any()
    scale = max(1.0, float(np.abs(found.multipliers).max()) * float(np.abs(d).max()))
    assert abs(found.multipliers @ d @ v) <= 1e-10 * scale
    f, lost = space.applied(t, q, v)
    close(space.mass() @ found.acceleration + d.T @ found.multipliers, f, "M v' + D^T lambda = f", 1e-10 * scale)
    close(found.power, lost, "only forces without potential change the energy", 1e-9 * scale)
    rate = v @ space.mass() @ found.acceleration + space.potential_rate(q, v)
    close(rate, lost, "rate of the energy", 1e-9 * scale)


def test_drivers_do_the_work_that_is_accounted_for():
    found, space, t, q, v, d, nu = balance(("driver",), 5)
    assert nu.any()
    scale = max(1.0, float(np.abs(found.multipliers).max()) * float(np.abs(d).max()))
    rate = v @ space.mass() @ found.acceleration + space.potential_rate(q, v)
    close(rate, found.power, "rate of the energy", 1e-9 * scale)
    _, lost = space.applied(t, q, v)
    close(found.power, lost - found.multipliers @ nu, "power of drivers is -lambda nu", 1e-9 * scale)

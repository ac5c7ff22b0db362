"""Beams in both shapes: one kernel for all elements, the same motion; rigid motions; overbent elements."""

import numpy as np
import pytest
from support.beams import at_end, cantilever

import symgen
from symgen.derive.lower.looped.instances import instances_of_mechanism
from symgen.derive.lower.looped.kernels import kernel_stem
from symgen.describe.files.builder import MechanismBuilder


def spatial(elements, **keys):
    builder = MechanismBuilder("rod", space="spatial", gravity=keys.pop("gravity", (0.0, 0.0, 0.0)))
    stiff = {
        "axial": 1e3,
        "shear": 5e2,
        "torsion": 0.4,
        "bending": (0.5, 0.7),
        "mass": 1.0,
        "rotary": (2e-3, 1e-3, 1e-3),
    }
    builder.beam("rod", start=(0, 0, 0), end=(1, 0, 0), elements=elements, **{**stiff, **keys})
    return symgen.Model(builder.build())


def kernels(model):
    return {kernel_stem(i) for i in instances_of_mechanism(model.mechanism) if i.kind == "force"}


@pytest.mark.parametrize("make", [cantilever, spatial])
def test_all_elements_share_a_kernel_however_many(make):
    """Those at the ground have frames of another kind; 40 elements are compiled as 4 are."""
    assert kernels(make(4, clamp="ground")) == kernels(make(40, clamp="ground"))
    assert len(kernels(make(40, clamp="ground"))) == 2
    assert len(kernels(make(40, clamp=""))) == 1


@pytest.mark.by_turns(2)
@pytest.mark.slow
@pytest.mark.parametrize("space", ["planar", "spatial"])
def test_both_shapes_move_alike(space):
    if space == "planar":
        model = cantilever(3, axial=1e3, rotary=1e-2, damping=1e-3, forces={"tip": at_end(0.3, -0.5)})
    else:
        model = spatial(2, clamp="ground", gravity=(0.0, 1.0, -3.0), damping=1e-3)
    tip = [f"rod.end.{c}" for c in "xyz"[: 2 if space == "planar" else 3]]
    implicit = () if space == "spatial" else (("generalized-alpha", "generalized-alpha"),)
    runs = [
        model.simulate(until=0.2, step=5e-4, method=method, integrator=integrator, shape=shape, times=[0.2])
        for shape in ("straight", "looped")
        for method, integrator in (("lagrange", "rk4"), *implicit)
    ]
    places = np.array([[run.q[c][-1] for c in tip] for run in runs])
    half = len(runs) // 2
    np.testing.assert_allclose(places[:half], places[half:], atol=1e-11)
    np.testing.assert_allclose(places[0], places[half - 1], atol=2e-5)
    assert all(run.energy_drift_max <= 1e-4 for run in runs)


@pytest.mark.slow_cases("spatial")
@pytest.mark.parametrize("space", ["planar", "spatial"])
def test_rigid_motions_strain_nothing(space):
    """A beam that is thrown without spin keeps its shape; one that spins is stretched by rotation alone."""
    if space == "planar":
        model = cantilever(6, clamp="", velocity=(3.0, 4.0), rotary=1e-2, axial=1e3)
    else:
        model = spatial(4, velocity=(3.0, 4.0, -2.0))
    run = model.simulate(until=1.0, step=1e-3, method="lagrange", integrator="rk4")
    assert run.potential.max() <= 1e-20
    assert abs(run.q["rod.2.x"][-1] - run.q["rod.2.x"][0] - 3.0) <= 1e-12


@pytest.mark.slow
def test_momentum_and_energy_are_kept_in_space():
    """A free beam that is thrown with a spin about an oblique axis, so that it bends and twists."""
    model = spatial(4, velocity=(0.0, 0.0, 0.0), angular_velocity=(0.5, 2.0, 3.0))
    run = model.simulate(until=1.0, method="lagrange", integrator="dop853", rtol=1e-11, atol=1e-13, output_step=0.1)
    masses, inertias = (
        np.array([[e.value for e in (b.inertia[:3] if i else (b.mass,))] for b in model.mechanism.bodies])
        for i in (0, 1)
    )
    total = np.zeros((len(run.t), 3))
    for k, body in enumerate(model.mechanism.bodies):
        x, v, w = (
            np.column_stack([table[f"{body.name}.{c}"] for c in names])
            for table, names in ((run.q, "xyz"), (run.v, ("vx", "vy", "vz")), (run.v, ("wx", "wy", "wz")))
        )
        e = np.column_stack([run.q[f"{body.name}.e{i}"] for i in range(4)])
        own = inertias[k] * w
        spun = own + 2.0 * np.cross(e[:, 1:], np.cross(e[:, 1:], own) + e[:, :1] * own)
        total += masses[k] * np.cross(x, v) + spun
    np.testing.assert_allclose(total, np.broadcast_to(total[0], total.shape), atol=1e-10)
    energy = run.kinetic + run.potential
    assert np.ptp(energy) <= 1e-10 * energy[0] and run.potential.max() > 1e-3 * energy[0]


@pytest.mark.slow
def test_overbent_elements_make_a_run_unverified():
    keys = {"axial": 1e3, "rotary": 1e-2}
    bent = cantilever(2, forces={"tip": at_end(0.0, -8.0)}, **keys).simulate(until=0.6, step=5e-4)
    assert bent.status == "unverified" and bent.reason.startswith("beam element rod.e1 is bent by ")
    long = cantilever(4, forces={"tip": at_end(300.0, 0.0)}, **keys).simulate(until=0.1, step=5e-4)
    assert long.status == "unverified" and "is stretched by 0." in long.reason
    assert cantilever(4, forces={"tip": at_end(0.0, -1.0)}, **keys).simulate(until=0.1, step=5e-4).status == "ok"


@pytest.mark.slow
def test_verify_doubles_the_elements():
    """The estimate is that of a run with many elements, within a factor of two."""
    choice = {"method": "lagrange", "integrator": "dop853", "rtol": 1e-9, "atol": 1e-11, "until": 0.5, "times": [0.5]}
    models = [
        cantilever(n, axial=1e3, rotary=1e-2, parameters={"P": 3.0}, forces={"tip": at_end(0.0, "-P")}) for n in (4, 16)
    ]
    checked = models[0].simulate(verify=True, **choice)
    (note,) = [n for n in checked.notes if "twice the beam elements" in n]
    estimated = float(note.split("is about ")[1].split(" m")[0])
    fine = models[1].simulate(**choice)
    errors = []
    for coarse, same in (("1", "4"), ("2", "8"), ("3", "12"), ("end", "end")):
        errors.append(np.hypot(*(checked.q[f"rod.{coarse}.{c}"][-1] - fine.q[f"rod.{same}.{c}"][-1] for c in "xy")))
    assert 0.5 < estimated / max(errors) < 2.0


@pytest.mark.slow
def test_automatic_choice_for_beams():
    """Explicit schemes where vibrations are near the motion, generalised alpha where they are far faster, undamped."""
    calm = cantilever(4, axial=1e3, rotary=1e-2, forces={"tip": at_end(0.0, -1.0)})
    run = calm.simulate(method="auto", integrator="auto", until=0.2)
    assert run.integrator == "picard" and run.status == "ok"
    keys = {"axial": 1e9, "rotary": 1e-7, "parameters": {"P": 1e-3}, "forces": {"tip": at_end(0.0, "-P*t")}}
    for damping, integrator in ((0.0, "generalized-alpha"), (1e-2, "radau5")):
        model = cantilever(4, damping=damping, **keys)
        found = symgen.run.planning.prepare.make_plan(
            model.mechanism, symgen.Settings(method="auto", integrator="auto", until=1.0)
        )
        assert found.integrator.name == integrator
        assert found.spec.adaptive

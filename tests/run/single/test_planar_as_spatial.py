"""A planar mechanism described in space moves as it does in the plane, whether or not its rows are redundant there."""

import numpy as np
import pytest
from support.emitted import mechanism_of
from support.twin import spatial_twin

from symgen.api import load
from symgen.describe.catalogue import raw

SPRING = {
    "spring": {
        "type": "spring-damper",
        "between": ["ground", "slider"],
        "at": [[0.7, 0.1], "centre"],
        "stiffness": 300.0,
        "damping": 2.0,
        "free_length": 0.15,
    }
}
ACCURATE = {"integrator": "dop853", "rtol": 1e-13, "atol": 1e-13, "output_step": 0.05}


def run(description, until, method="lagrange"):
    return load(mechanism_of(description)).simulate(method=method, until=until, **ACCURATE)


CASES = {
    "four-bar": ("four-bar", {"B": "spherical", "C": "cylindrical"}, {}, 17, 1.5),
    "four-bar-redundant": ("four-bar", {}, {}, 17, 1.5),
    "slider-crank": ("slider-crank", {"P": "spherical", "Q": "cylindrical"}, SPRING, 17, 0.5),
}


@pytest.mark.by_turns(3)
@pytest.mark.slow
@pytest.mark.parametrize("case", CASES)
def test_the_same_motion(case):
    name, kinds, forces, rank, until = CASES[case]
    planar = {**raw(name), "forces": forces}
    flat, deep = run(planar, until), run(spatial_twin(planar, kinds), until)
    assert flat.status == deep.status == "ok"
    assert deep.rank.rank == rank and deep.rank.rows == rank + 3 * ("redundant" in case)
    np.testing.assert_array_equal(flat.t, deep.t)
    for body in planar["bodies"]:
        for coordinate in ("x", "y"):
            np.testing.assert_allclose(deep[f"{body}.{coordinate}"], flat[f"{body}.{coordinate}"], atol=1e-10)
        angle = 2.0 * np.unwrap(np.arctan2(deep[f"{body}.e3"], deep[f"{body}.e0"]))
        turned = np.unwrap(angle) - flat[f"{body}.theta"]
        np.testing.assert_allclose(turned - np.round(turned[0] / (2 * np.pi)) * 2 * np.pi, 0.0, atol=1e-10)
        np.testing.assert_allclose(deep[f"{body}.wz"], flat[f"{body}.omega"], atol=1e-9)
        for out in (".z", ".e1", ".e2", ".wx", ".wy"):
            np.testing.assert_allclose(deep[f"{body}{out}"], 0.0, atol=1e-12)
    for joint in planar["joints"]:
        # forces in the plane are unique, redundant rows or not
        for component in ("Fx", "Fy"):
            np.testing.assert_allclose(
                deep.reactions[f"{joint}.{component}"], flat.reactions[f"{joint}.{component}"], atol=2e-7, rtol=1e-8
            )
    assert set(deep.non_unique_reactions) == (set(planar["joints"]) if "redundant" in case else set())
    np.testing.assert_allclose(deep.kinetic + deep.potential, flat.kinetic + flat.potential, atol=1e-9)

"""Reactions in space: Newton's and Euler's equations of every body, forces and moments taken in ground axes."""

import numpy as np
import pytest
from support.emitted import mechanism_of
from support.space import Space

from symgen.api import load

ARM = {
    "mass": 2.0,
    "inertia": [0.2, 0.3, 0.25, 0.02, -0.01, 0.03],
    "centre_of_mass": [0.1, 0.05, -0.02],
    "points": {"A": [-0.4, 0.0, 0.1], "B": [0.5, 0.1, 0.0]},
    "position": [0.4, 0.0, -0.1],
    "angular_velocity": [0.0, 2.0, 0.0],
}
ROD = {
    "mass": 1.1,
    "inertia": [0.01, 0.1, 0.1],
    "points": {"B": [0.0, 0.0, 0.3]},
    "position": [0.9, 0.1, -0.4],
    "angular_velocity": [1.0, -0.5, 3.0],
}
RAW = {
    "mechanism": {"name": "arms", "space": "spatial", "gravity": [0.0, 0.0, -9.81]},
    "parameters": {},
    "bodies": {"arm": ARM, "rod": ROD, "bob": {"type": "point", "mass": 0.4, "position": [0.9, 0.1, -1.2]}},
    "joints": {
        "pin": {
            "type": "revolute",
            "between": ["ground", "arm"],
            "at": [[0.0, 0.0, 0.0], "A"],
            "axis": [0.0, 1.0, 0.3],
        },
        "cross": {"type": "universal", "between": ["arm", "rod"], "at": ["B", "B"], "axes": [[1, 0, 0], [0, 1, 0]]},
        "string": {"type": "distance", "between": ["rod", "bob"], "at": [[0, 0, -0.2], "centre"], "length": 0.6},
    },
    "forces": {},
}


@pytest.mark.slow
def test_reactions_balance_every_body():
    result = load(mechanism_of(RAW)).simulate(method="direct-correction", integrator="rk4", step=2e-3, until=0.4)
    assert result.status == "ok"
    space = Space(RAW)
    r = {joint: (result.reaction(joint)[:, :3], result.reaction(joint)[:, 3:]) for joint in ("pin", "cross", "string")}
    assert result.reaction("pin").shape == (len(result.t), 6) and result.reactions.unit("cross.My") == "N m"
    for k in (0, 60, 200):
        q, v, a = (np.asarray(x)[k] for x in (result.q, result.v, result.a))
        at = {body: space.centre(body, q) for body in space.bodies}
        ends = {"cross": space.arm("arm", [0.5, 0.1, 0.0], q), "string": space.arm("rod", [0.0, 0.0, -0.2], q)}
        first = {"pin": np.zeros(3), "cross": at["arm"] + ends["cross"], "string": at["rod"] + ends["string"]}

        def on(joint, body, sign, k=k, at=at, first=first):
            """Force and moment of a joint about a body's centre of mass."""
            force, moment = r[joint][0][k], r[joint][1][k]
            return sign * force, sign * (moment + np.cross(first[joint] - at[body], force))

        acting = {
            "arm": [("pin", -1.0), ("cross", 1.0)],
            "rod": [("cross", -1.0), ("string", 1.0)],
            "bob": [("string", -1.0)],
        }
        for body, joints in acting.items():
            j, mass = space.first_v[body], space.bodies[body]["mass"]
            loads = [on(joint, body, sign) for joint, sign in joints]
            force = sum((f for f, _ in loads), np.array([0.0, 0.0, -9.81 * mass]))
            np.testing.assert_allclose(force, mass * a[j : j + 3], atol=1e-9)
            moment = sum((m for _, m in loads), np.zeros(3))
            expected = np.zeros(3)
            if space.turns(body):
                omega, inertia = v[j + 3 : j + 6], space.inertia(body)
                expected = space.matrix(body, q) @ (inertia @ a[j + 3 : j + 6] + np.cross(omega, inertia @ omega))
            np.testing.assert_allclose(moment, expected, atol=1e-9)
        # the pin lets the arm turn about its axis, the string has no moment where it is tied
        axis = space.direction("ground", [0.0, 1.0, 0.3], q)
        assert abs(axis @ r["pin"][1][k]) < 1e-9 < np.linalg.norm(r["pin"][1][k])
        np.testing.assert_allclose(r["string"][1][k], 0.0, atol=1e-9)
        # the same in the axes of the arm, and their lengths
        turned = space.matrix("arm", q).T @ np.column_stack([r["cross"][0][k], r["cross"][1][k]])
        np.testing.assert_allclose(result.body_reactions["cross"][k], turned.T.ravel(), atol=1e-11)
        lengths = [np.linalg.norm(r["cross"][0][k]), np.linalg.norm(r["cross"][1][k])]
        np.testing.assert_allclose(result.magnitudes["cross"][k], lengths, rtol=1e-13)

"""Angles in space whose turns are counted: drivers whose values vary by whole turns."""

import numpy as np
from support.emitted import mechanism_of

import symgen


def geared():
    """A wheel driven from an angle on, geared to a second one: b = 31 - 2 a."""
    frame, axis = [[1.0, 0.0, 0.0], [1.0, 0.0, 0.0]], [[0.0, 0.0, 1.0], [0.0, 0.0, 1.0]]

    def wheel(x):
        return {"mass": 1.0, "inertia": [0.2, 0.2, 0.3], "position": [x, 0.0, 0.0]}

    def held(body, x):
        between = ["ground", body]
        at = [[x, 0.0, 0.0], "centre"]
        return {"type": "revolute", "between": between, "at": at, "axis": axis, "reference": frame}

    return symgen.load(
        mechanism_of(
            {
                "mechanism": {"name": "geared", "space": "spatial"},
                "parameters": {"first": 7.0},
                "bodies": {"a": wheel(0.0), "b": wheel(1.0)},
                "joints": {
                    "mesh": {"type": "gear", "joints": ["A", "B"], "radii": [2.0, 1.0], "offset": 31.0},
                    "A": held("a", 0.0),
                    "B": held("b", 1.0),
                    "motor": {"type": "driver", "joint": "A", "value": "first + 3*t"},
                },
            }
        )
    )


def test_starts_whole_turns_away_and_turns_between_outputs():
    first = np.array([7.0, -40.0, 0.2, 3.3])
    times = (0.0, 2.5, 5.0)
    settings = {"step": 0.02, "until": 5.0, "times": times}
    model = geared()
    found = symgen.sweep(model, {"first": first}, quantities=("joint", "q", "a.alphaz", "lam"), **settings)
    assert found.counts["ok"] == 4
    expected = first[:, None] + 3.0 * np.array(times)
    np.testing.assert_allclose(found["joint.A.angle"], expected, atol=1e-9)
    np.testing.assert_allclose(found["joint.B.angle"], 31.0 - 2.0 * expected, atol=1e-9)
    np.testing.assert_allclose(found["joint.B.angle.rate"], -6.0, atol=1e-9)
    for i, value in enumerate(first):
        one = model.simulate(parameters={"first": float(value)}, **settings)
        for name in one.q.names:
            np.testing.assert_allclose(found[name][i], one[name], atol=1e-10, err_msg=name)
        for name in one.lam.names:
            np.testing.assert_allclose(found[f"lam.{name}"][i], one.lam[name], atol=1e-8, err_msg=name)

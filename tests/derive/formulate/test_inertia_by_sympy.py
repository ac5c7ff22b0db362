"""M, weights, gyroscopic terms and energies of each kind of body, derived anew by SymPy from T and V: exactly equal.

What is written on the graph by hand is the same for every body of a kind, with numbers in place of symbols; so what
holds here for symbols holds for every mechanism.
"""

from typing import Any

import pytest
import sympy as sp

from symgen.api import Model
from symgen.describe.files.validate import validate

TENSOR = ["xx", "yy", "zz", "xy", "xz", "yz"]
KINDS: dict[str, dict[str, Any]] = {
    "planar": {"mass": "m", "inertia": "xx"},
    "planar point": {"type": "point", "mass": "m"},
    "spatial": {"mass": "m", "inertia": TENSOR},
    "principal axes": {"mass": "m", "inertia": TENSOR[:3]},
    "spatial point": {"type": "point", "mass": "m"},
}


def alone(kind: str) -> Any:
    """The equations of one body that nothing holds, all of its numbers parameters."""
    planar, gravity = kind.startswith("planar"), ["gx", "gy", "gz"]
    numbers = {
        "m": 2.0,
        "xx": 3.0,
        "yy": 4.0,
        "zz": 5.0,
        "xy": 0.1,
        "xz": 0.2,
        "yz": 0.3,
        "gx": 1.0,
        "gy": 2.0,
        "gz": 3.0,
    }
    raw = {
        "mechanism": {
            "name": "alone",
            "space": "planar" if planar else "spatial",
            "gravity": gravity[: 2 if planar else 3],
        },
        "parameters": numbers,
        "bodies": {"b": KINDS[kind]},
    }
    return Model(validate(raw, "alone")).equations


@pytest.mark.parametrize("kind", KINDS)
def test_lagrange_gives_what_is_written_on_the_graph(kind: str) -> None:
    e = alone(kind)
    v, names = list(e.v.values()), [name.partition(".")[2] for name in e.v]
    of = dict(zip(names, v, strict=True))
    p = dict(e.parameters)
    axes = "xy" if kind.startswith("planar") else "xyz"
    turning = [of[n] for n in ("omega", "wx", "wy", "wz") if n in of]
    # the definitions: T from mass and inertia, V from weight
    kinetic = p["m"] * sum(of[f"v{a}"] ** 2 for a in axes) / 2
    if len(turning) == 1:
        kinetic += p["xx"] * turning[0] ** 2 / 2
    elif turning:
        off = [p[n] if len(KINDS[kind]["inertia"]) == 6 else 0 for n in TENSOR[3:]]
        j = sp.Matrix([[p["xx"], off[0], off[1]], [off[0], p["yy"], off[2]], [off[1], off[2], p["zz"]]])
        kinetic += (sp.Matrix(turning).T * j * sp.Matrix(turning))[0] / 2
    potential = -p["m"] * sum(p[f"g{a}"] * e.q[f"b.{a}"] for a in axes)
    assert sp.expand(e.T - kinetic) == 0 and sp.expand(e.V - potential) == 0
    # M = d2T/dv2; weights are -dV/dq; with angular velocities in body axes d/dt dT/dw + w x dT/dw = 0
    assert (e.M - sp.hessian(kinetic, v)).expand() == sp.zeros(len(v), len(v))
    forces = {of[f"v{a}"]: -sp.diff(potential, e.q[f"b.{a}"]) for a in axes}
    if len(turning) == 3:
        w = sp.Matrix(turning)
        gyroscopic = -w.cross(sp.Matrix([sp.diff(kinetic, x) for x in turning]))
        forces |= dict(zip(turning, gyroscopic, strict=True))
    assert (e.f - sp.Matrix([forces.get(x, 0) for x in v])).expand() == sp.zeros(len(v), 1)

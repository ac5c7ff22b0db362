"""Rows of one's own: those that copy joints, those that no joint has, and what is refused of them."""

import re

import msgspec
import numpy as np
import pytest
import sympy as sp
from scipy.integrate import solve_ivp

from symgen import MechanismBuilder
from symgen.api import Model
from symgen.base.errors import InputError
from symgen.derive.methods import METHODS
from symgen.describe.files.validate import validate
from symgen.run.compiling.choices import count_rhs_operations

POINT = {"type": "point", "mass": 1.5}


def pair(kind, **keys):
    """A double pendulum whose second joint is of some kind."""
    return (
        MechanismBuilder("pair")
        .body("crank", mass=2.0, inertia=0.3, points={"B": [1.0, 0.0]}, position=[0.5, 0.0], angular_velocity=1.0)
        .body("rod", mass=1.0, inertia=0.2, points={"A": [-0.7, 0.1]}, position=[2.2, -0.1], angular_velocity=-2.0)
        .joint("O", "revolute", between=["ground", "crank"], at=[[0.0, 0.0], [-0.5, 0.0]])
        .joint("A", kind, **keys)
        .build()
    )


def wheels(kind, **keys):
    return (
        MechanismBuilder("wheels")
        .body("small", mass=2.0, inertia=0.3, angular_velocity=1.0)
        .body("large", mass=1.0, inertia=0.9, position=[3.0, 0.0], centre_of_mass=[0.2, 0.1])
        .joint("O", "revolute", between=["ground", "small"], at=[[0.0, 0.0], [0.0, 0.0]])
        .joint("P", "revolute", between=["ground", "large"], at=[[3.0, 0.0], [0.0, 0.0]])
        .joint("mesh", kind, **keys)
        .build()
    )


def nut(kind, rows=()):
    """A nut on a thread, or on a shaft with the thread as a row."""
    keys = {"between": ["ground", "nut"], "at": [[0.0, 0.0, 0.0], "centre"], "axis": [[0.0, 0.6, 0.8]] * 2}
    builder = (
        MechanismBuilder("nut", space="spatial")
        .body("nut", mass=2.0, inertia=[0.3, 0.4, 0.5, 0.02, 0.01, -0.03], angular_velocity=[0.0, 0.0, 0.0])
        .joint("thread", kind, **keys, **({"pitch": 0.4} if kind == "screw" else {}))
    )
    return (builder.joint("turn", "rows", rows=list(rows)) if rows else builder).build()


DISC = {
    "mass": 2.0,
    "inertia": [0.1, 0.1, 0.2],
    "position": [0.0, 0.0, 0.48],
    "orientation": {"x_axis": [0.28, 0.0, -0.96], "y_axis": [0.0, 1.0, 0.0]},
    "angular_velocity": [0.3, 0.2, 4.0],
}


def disc(kind):
    """A disc of radius 0.5 that leans; its point of contact is -R n without its part along the disc's axis."""
    builder = MechanismBuilder("coin", space="spatial").body("disc", **DISC)
    if kind == "rolling-disc":
        return builder.joint(
            "roll", kind, body="disc", radius=0.5, normal=[0, 0, 1], axis=[0, 0, 1], reference=[1, 0, 0]
        ).build()
    arm = "0.5/sqrt(disc.ex.z**2 + disc.ey.z**2)"
    turned = ("disc.wz*disc.ey.z", "-disc.wz*disc.ex.z", "disc.wy*disc.ex.z - disc.wx*disc.ey.z")
    slip = [
        {
            "velocity": f"-disc.v{x} - {arm}*("
            + " + ".join(f"disc.e{k}.{x}*({w})" for k, w in zip("xyz", turned, strict=True))
            + ")"
        }
        for x in "xy"
    ]
    height = {"position": "0.5*sqrt(1 - disc.ez.z**2) - disc.z"}
    return builder.joint("roll", "rows", rows=[height, *slip]).build()


COPIES = {
    "revolute": (
        pair("revolute", between=["crank", "rod"], at=["B", "A"]),
        pair("rows", rows=[{"position": f"rod.A.{x} - crank.B.{x}"} for x in "xy"]),
    ),
    "gear": (
        wheels("gear", between=["small", "large"], radii=[1.0, 2.0]),
        wheels("rows", rows=[{"position": "-small.theta - 2*large.theta", "unit": "m"}]),
    ),
    "screw": (
        nut("screw"),
        nut("cylindrical", [{"position": "thread.displacement - 0.4/(2*pi)*thread.angle"}]),
    ),
    "rolling-disc": (disc("rolling-disc"), disc("rows")),
}


@pytest.mark.slow_cases("rolling-disc", "screw")
@pytest.mark.parametrize("name", COPIES)
def test_rows_copy_a_joint(name):
    ends, counts = [], []
    for mechanism in COPIES[name]:
        result = Model(mechanism).simulate(until=1.0, rtol=1e-13, atol=1e-13, method="lagrange", integrator="dop853")
        ends.append(np.concatenate([result.q.values[-1], result.v.values[-1]]))
        counts.append(count_rhs_operations(mechanism))
    np.testing.assert_allclose(ends[1], ends[0], rtol=0.0, atol=1e-11)
    assert counts[1] <= 1.2 * counts[0]


def by_lagrange(lagrangian, q, start, rates, holonomic=(), nonholonomic=(), until=1.0):
    """Integrate SymPy's Lagrange equations with multipliers."""
    from sympy.physics.mechanics import LagrangesMethod, ReferenceFrame

    method = LagrangesMethod(
        lagrangian,
        q,
        hol_coneqs=list(holonomic),
        nonhol_coneqs=list(nonholonomic),
        frame=ReferenceFrame("N"),
        forcelist=[],
    )
    method.form_lagranges_equations()
    n, t = len(q), sp.Symbol("t")
    states = sp.symbols(f"y:{2 * n}")
    names = dict(zip([*(x.diff() for x in q), *q], [*states[n:], *states[:n]], strict=True))
    numbers = [
        m.subs(names).subs(sp.physics.vector.dynamicsymbols._t, t)
        for m in (method.mass_matrix_full, method.forcing_full)
    ]
    mass, forcing = (sp.lambdify((t, states), m) for m in numbers)
    solution = solve_ivp(
        lambda t, y: np.linalg.solve(mass(t, y), forcing(t, y))[: 2 * n, 0],
        *((0.0, until), [*start, *rates]),
        method="DOP853",
        rtol=1e-12,
        atol=1e-12,
    )
    return solution.y[:n, -1]


def dynamic(names):
    from sympy.physics.mechanics import dynamicsymbols

    return dynamicsymbols(names)


def on_parabola():
    return (
        MechanismBuilder("rod-on-parabola", gravity=[0.0, -9.81])
        .parameter("c", 0.8)
        .body(
            "rod",
            mass=2.0,
            inertia=0.3,
            points={"tip": [-0.5, 0.0]},
            position=[1.0, 0.4],
            velocity=[0.3, 0.24],
            angular_velocity=0.0,
        )
        .joint("guide", "rows", rows=[{"position": "rod.tip.y - c*rod.tip.x**2 - 0.1*sin(3*t)", "unit": "m"}])
        .build()
    )


PARABOLA_RUNS = (
    {"integrator": "dop853", "rtol": 1e-12},
    {"integrator": "dop853", "rtol": 1e-12, "coordinates": "joint"},
    {"integrator": "dop853", "rtol": 1e-12, "shape": "looped"},
    {"integrator": "radau5", "rtol": 1e-12, "method": "lagrange"},
)


@pytest.fixture(scope="module")
def rod_by_lagrange():
    x, y, a = dynamic("x y a")
    t = sp.physics.vector.dynamicsymbols._t
    xd, yd, ad = (e.diff() for e in (x, y, a))
    lagrangian = xd**2 + yd**2 + sp.Rational(3, 20) * ad**2 - 2 * 9.81 * y
    guide = y - sp.sin(a) / 2 - sp.Rational(4, 5) * (x - sp.cos(a) / 2) ** 2 - sp.sin(3 * t) / 10
    return lagrangian, (x, y, a), guide


@pytest.mark.by_turns(3)
@pytest.mark.slow_cases(
    "{'integrator': 'dop853', 'rtol': 1e-12, 'coordinates': 'joint'}",
    "{'integrator': 'dop853', 'rtol': 1e-12}",
    "{'integrator': 'radau5', 'rtol': 1e-12, 'method': 'lagrange'}",
)
@pytest.mark.parametrize("settings", PARABOLA_RUNS, ids=str)
def test_a_tip_on_a_moving_parabola(settings, rod_by_lagrange):
    lagrangian, q, guide = rod_by_lagrange
    result = Model(on_parabola()).simulate(until=1.0, **settings)
    start = result.q.values[0], result.v.values[0]
    wanted = by_lagrange(lagrangian, q, *start, holonomic=[guide])
    np.testing.assert_allclose(result.q.values[-1], wanted, rtol=0.0, atol=1e-10)


@pytest.mark.slow
def test_a_knife_edge_on_an_arm():
    mechanism = (
        MechanismBuilder("sledge-with-arm")
        .body("sledge", mass=2.0, inertia=0.3, velocity=[1.0, 0.2], angular_velocity=0.5)
        .body("arm", mass=1.0, inertia=0.1, points={"tip": [0.6, 0.0]}, position=[0.9, 0.0])
        .joint("pin", "revolute", between=["sledge", "arm"], at=[[0.5, 0.0], [-0.4, 0.0]])
        .joint("edge", "rows", rows=[{"velocity": "cos(arm.theta)*arm.tip.vy - sin(arm.theta)*arm.tip.vx"}])
        .build()
    )
    x, y, a, b = dynamic("x y a b")
    xd, yd, ad, bd = (e.diff() for e in (x, y, a, b))
    centre = x + sp.cos(a) / 2 + sp.Rational(2, 5) * sp.cos(b), y + sp.sin(a) / 2 + sp.Rational(2, 5) * sp.sin(b)
    tip = x + sp.cos(a) / 2 + sp.cos(b), y + sp.sin(a) / 2 + sp.sin(b)
    lagrangian = xd**2 + yd**2 + sp.Rational(3, 20) * ad**2 + bd**2 / 20 + sum(e.diff() ** 2 for e in centre) / 2
    edge = sp.cos(b) * tip[1].diff() - sp.sin(b) * tip[0].diff()
    for settings in ({}, {"coordinates": "joint"}):
        result = Model(mechanism).simulate(until=1.0, rtol=1e-12, integrator="dop853", **settings)
        picked = [[row[i] for i in (0, 1, 2, 5)] for row in (result.q.values[0], result.v.values[0])]
        wanted = by_lagrange(lagrangian, (x, y, a, b), *picked, nonholonomic=[edge])
        np.testing.assert_allclose(result.q.values[-1, [0, 1, 2, 5]], wanted, rtol=0.0, atol=1e-10)


# -- what rows share with joints ---------------------------------------------------------------------------------------


def test_rows_that_depend_on_each_other_are_found():
    """The second row of a parabola is twice the first one, written otherwise."""
    rows = [{"position": "rod.tip.y - 0.8*rod.tip.x**2"}, {"position": "1.6*rod.tip.x*rod.tip.x - 2*rod.tip.y"}]
    mechanism = (
        MechanismBuilder("twice")
        .body("rod", mass=2.0, inertia=0.3, points={"tip": [-0.5, 0.0]}, position=[1.0, 0.2], angular_velocity=1.0)
        .joint("guide", "rows", rows=rows)
        .build()
    )
    alone = msgspec.structs.replace(
        mechanism, joints=(msgspec.structs.replace(mechanism.joints[0], rows=mechanism.joints[0].rows[:1]),)
    )
    settings = {"until": 1.0, "rtol": 1e-12, "integrator": "dop853"}
    result, one = (Model(m).simulate(**settings) for m in (mechanism, alone))
    assert result.status == "ok"
    assert any("1 constraint row depends on the others" in note and "guide.row" in note for note in result.notes)
    np.testing.assert_allclose(result.q.values[-1], one.q.values[-1], rtol=0.0, atol=1e-10)


@pytest.mark.slow_cases("coordinate-partitioning", "null-space")
@pytest.mark.parametrize(
    "name",
    ["baumgarte", "coordinate-partitioning", "ggl", "index1-augmented-lagrangian", "null-space", "udwadia-kalaba"],
)
def test_methods_take_rows(name):
    """One method of each form; the energy balance knows what a moving row does."""
    wanted = Model(on_parabola()).simulate(until=0.1, rtol=1e-11, integrator="dop853").q.values[-1]
    integrator = METHODS.get(name).default_integrator
    result = Model(on_parabola()).simulate(method=name, until=0.1, step=1e-3, integrator=integrator)
    np.testing.assert_allclose(result.q.values[-1], wanted, rtol=0.0, atol=1e-8)
    assert result.energy_drift_max < 1e-6


def test_linear_systems_drawings_and_pages_have_rows():
    still = (
        MechanismBuilder("resting", gravity=[0.0, -9.81])
        .body("rod", mass=2.0, inertia=0.3, points={"tip": [-0.5, 0.0]}, position=[0.0, -0.5], angle=-np.pi / 2)
        .joint("guide", "rows", rows=[{"position": "rod.tip.y - 0.8*rod.tip.x**2"}])
        .build()
    )
    model = Model(still)
    # the tip in its valley: m (x'' + a''/2) = -1.6 m g x, J a'' = -m g a/2 + 1.6 m g x/2
    mass = np.array([[2.0, 1.0], [1.0, 0.3 + 0.5]])
    stiffness = 2.0 * 9.81 * np.array([[1.6, 0.0], [0.0, 0.5]])
    squares = np.sort(np.linalg.eigvals(np.linalg.solve(mass, stiffness)).real)
    np.testing.assert_allclose(model.modes(at="start").omega_squared, squares, rtol=1e-10)
    assert "guide" in model.draw().svg
    assert "0.8" in str(model.equations.Phi)


BAD = [
    ([], "joints.guide.rows: expected a list of rows"),
    ([{}], "joints.guide.rows[0]: expected either the key position or the key velocity, got neither"),
    (
        [{"position": "rod.x", "velocity": "rod.vx"}],
        "rows[0]: expected either the key position or the key velocity, got both",
    ),
    (
        [{"place": "rod.x"}],
        "joints.guide.rows[0]: expected the keys position, velocity, label, unit, got the unknown key 'place'",
    ),
    ([{"position": "rod.x + rod.vx"}], "rows[0].position: expected an expression of t, parameters and positions"),
    ([{"position": "rod.x + rod.tip.vy"}], "got 'rod.tip.vy', a velocity; a row of velocities is { velocity = ... }"),
    (
        [{"position": "3*c"}],
        "rows[0].position: expected an expression of t, parameters and positions, got one in which nothing moves",
    ),
    ([{"position": "rod.x + flat(rod.y)"}], "a motion needs two continuous derivatives"),
    ([{"position": "rod.x + push"}], "only forces, torques and actuators may use an input"),
    (
        [{"velocity": "rod.vx*rod.omega"}],
        "rows[0].velocity: expected a formula that is linear in velocities, got the term 'rod.vx*rod.omega'",
    ),
    ([{"velocity": "rod.y + sin(rod.vx)"}], "linear in velocities, got the term 'sin(rod.vx)'"),
    ([{"velocity": "rod.x"}], "expected a formula that is linear in velocities, got a formula without velocities"),
    ([{"position": "rod.x", "unit": "mm"}], "rows[0].unit: expected 'm' or 'rad', got 'mm'"),
    ([{"velocity": "rod.vx", "unit": "m"}], "rows[0].unit: expected 'm/s' or 'rad/s', got 'm'"),
    ([{"position": "rod.x", "label": "a b"}], "rows[0].label: expected a row name of letters, digits and _"),
    (
        [{"position": "rod.x", "label": "u"}, {"position": "rod.y", "label": "u"}],
        "joints.guide.rows: expected labels used once",
    ),
    ([{"position": "rod.tp.x"}], "joints.guide.rows[0].position: expected"),
]


@pytest.mark.parametrize(("rows", "words"), BAD, ids=range(len(BAD)))
def test_bad_rows_are_one_sentence(rows, words):
    raw = {
        "mechanism": {"name": "bad"},
        "parameters": {"c": 0.8},
        "inputs": {"push": 0.0},
        "tables": {"flat": {"x": [0.0, 1.0], "y": [0.0, 1.0]}},
        "bodies": {
            "rod": {"mass": 1.0, "inertia": 1.0, "points": {"tip": [0.5, 0.0]}},
            "other": {"mass": 1.0, "inertia": 1.0},
        },
        "joints": {"guide": {"type": "rows", "rows": rows}},
    }
    with pytest.raises(InputError, match=re.escape(words)) as error:
        validate(raw, "file")
    assert "\n" not in str(error.value)


def test_bodies_of_rows():
    rows = [{"position": "rod.tip.x - other.x"}, {"position": "rod.theta - 2*other.theta"}]

    def joint(**keys):
        builder = MechanismBuilder("two").body("rod", mass=1.0, inertia=1.0, points={"tip": [0.5, 0.0]})
        return builder.body("other", mass=1.0, inertia=1.0).joint("tie", "rows", rows=rows, **keys).build().joints[0]

    assert joint().bodies == ("rod", "other")
    assert [row.unit for row in joint().rows] == ["m", "rad"]
    assert joint(between=["other", "rod"]).bodies == ("other", "rod")
    words = "joints.tie.between: expected all bodies of the rows, rod, other, got none of 'other'"
    with pytest.raises(InputError, match=words):
        joint(between=["rod"])


def swinging(row, space):
    """A body on a pin, or on a ball, that a row ties to something."""
    if space == "planar":
        builder = MechanismBuilder("swinging", gravity=[0.0, -9.81])
        builder.body("b", mass=1.0, inertia=0.1, position=[0.5, 0.2], centre_of_mass=[0.1, 0.05])
        builder.body("c", mass=1.0, inertia=0.1, position=[1.5, 0.3], velocity=[1.0, 0.0])
        builder.joint("pin", "revolute", between=["ground", "b"], at=[[0.0, 0.0], [-0.5, -0.2]])
        builder.joint("hinge", "revolute", between=["b", "c"], at=[[0.5, 0.0], [-0.5, -0.1]])
    else:
        builder = MechanismBuilder("swinging", space="spatial", gravity=[0.0, 0.0, -9.81])
        builder.body("b", mass=1.0, inertia=[0.1, 0.2, 0.3], position=[0.5, 0.2, 0.1], angular_velocity=[0.3, 0.5, 1.0])
        builder.joint("ball", "spherical", between=["ground", "b"], at=[[0.0, 0.0, 0.0], [-0.5, -0.2, -0.1]])
    return builder.joint("tie", "rows", rows=[row]).build()


@pytest.mark.slow_cases("row2-spatial", "row3-spatial", "row0-planar")
@pytest.mark.parametrize(
    ("row", "space"),
    [
        ({"position": "c.x + 0.3*c.y*b.x - 0.2*c.theta - 1.545"}, "planar"),
        ({"velocity": "c.vx - 0.3*b.x*c.vy + 0.4*b.omega"}, "planar"),
        ({"position": "1.4*b.x + b.y - 0.7*b.x*b.z - 0.865"}, "spatial"),
        ({"velocity": "b.wz - 0.3*b.vx + 0.5*b.z*b.wx"}, "spatial"),
    ],
)
def test_coordinates_of_bodies_in_both_coordinates(row, space):
    """On a tree bodies' velocities are those of a point of the joint that carries them; rows mean their centres."""
    settings = {"until": 0.3, "method": "lagrange", "integrator": "dop853", "rtol": 1e-11, "atol": 1e-12}
    runs = [Model(swinging(row, space)).simulate(**settings, coordinates=c) for c in ("absolute", "joint")]
    assert all(run.status == "ok" and np.ptp(run.q.values[:, 0]) > 1e-3 for run in runs)
    for table in ("q", "v"):
        one, other = (getattr(run, table).values[-1] for run in runs)
        np.testing.assert_allclose(other, one, rtol=0.0, atol=1e-8)

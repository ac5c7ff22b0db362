"""Beams along lines with vertices: bent frames in closed form, by shooting and by quadrature, and as joined beams."""

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.optimize import brentq
from support.beams import at_end

from symgen import Model
from symgen.describe.files.builder import MechanismBuilder

STIFF = {"axial": 200.0, "shear": 80.0, "bending": 2.0, "mass": 1.5, "rotary": 1e-3}
CORNER = [(0.0, 0.0), (1.0, 0.0), (1.0, 0.7)]
#: A frame in space along x, y and z, and the axes of its sections.
BENT = np.array([(0.0, 0.0, 0.0), (1.0, 0.0, 0.0), (1.0, 0.6, 0.0), (1.0, 0.6, 0.8)])
AXES = np.array(
    [
        [(1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)],
        [(0.0, 1.0, 0.0), (-1.0, 0.0, 0.0), (0.0, 0.0, 1.0)],
        [(0.0, 0.0, 1.0), (-1.0, 0.0, 0.0), (0.0, -1.0, 0.0)],
    ]
)
SIDES = AXES[:, 1].tolist()
SPATIAL = {**STIFF, "torsion": 1.3, "bending": (2.0, 5.0), "shear": (80.0, 60.0), "rotary": (3e-3, 1e-3, 2e-3)}


def frame(line, elements, force, space="planar", **keys):
    """Return a model of a frame that is clamped at its start and loaded at its end."""
    stiff = STIFF if space == "planar" else SPATIAL
    builder = MechanismBuilder("frame", space=space).parameter("P", 1.0)
    builder.beam("rod", line=line, elements=elements, **{**stiff, "clamp": "ground", **keys})
    return Model(builder.force("tip", **at_end(*(f"P*({f})" for f in force))).build())


def place(rest, axes="xy"):
    return np.array([rest.q[f"rod.end.{axis}"] for axis in axes])


@pytest.mark.slow
def test_right_angled_frame_bends_as_the_handbooks_say():
    """A small load along the first leg bends both: the corner turns by F b a / E I."""
    load, a, b = 1e-5, 1.0, 0.7
    rest = frame(CORNER, 6, (-load, 0.0), axial=1e8, shear=1e8).equilibrium()
    moment = load * b / 2.0
    np.testing.assert_allclose(rest.q["rod.end.x"] - 1.0, -(load * b**3 / 6.0 + moment * a * b), rtol=2e-5)
    np.testing.assert_allclose(rest.q["rod.end.y"] - b, moment * a**2 / 2.0, rtol=2e-5)
    np.testing.assert_allclose(rest.q["rod.end.theta"] - np.pi / 2, moment * a + moment * b / 2.0, rtol=2e-5)


def shot(force):
    """Return the tip of the frame of `CORNER` and `STIFF` by shooting of Reissner's equations."""

    def run(moment):
        y = np.array([0.0, 0.0, 0.0, moment])
        for length, corner in ((1.0, np.pi / 2), (0.7, 0.0)):

            def slopes(_, y):
                cosine, sine = np.cos(y[2]), np.sin(y[2])
                stretch = 1.0 + (cosine * force[0] + sine * force[1]) / STIFF["axial"]
                shear = (cosine * force[1] - sine * force[0]) / STIFF["shear"]
                x, z = cosine * stretch - sine * shear, sine * stretch + cosine * shear
                return [x, z, y[3] / STIFF["bending"], z * force[0] - x * force[1]]

            y = solve_ivp(slopes, (0.0, length), y, method="DOP853", rtol=1e-12, atol=1e-14).y[:, -1]
            y[2] += corner
        return y

    return run(brentq(lambda moment: run(moment)[3], -10.0, 10.0, xtol=1e-14))[:2]


@pytest.mark.slow
def test_frame_under_a_large_load_converges_with_fourth_order():
    force, errors = (-3.0, 1.0), []
    expected = shot(force)
    assert np.linalg.norm(expected - CORNER[2]) > 0.5
    for n in (2, 4, 8):
        errors.append(np.linalg.norm(place(frame(CORNER, [n, n], force).equilibrium()) - expected))
    assert errors[-1] <= 5e-6
    slopes = -np.diff(np.log2(errors))
    assert np.all((slopes > 3.8) & (slopes < 4.3))


@pytest.mark.slow
def test_frame_in_space_gives_way_as_the_integral_of_its_strains():
    """Unequal bending stiffnesses, a side of the section for each segment; linear theory, by Gauss' rule."""
    force, x, w = np.array([3.0, -2.0, 4.0]), *np.polynomial.legendre.leggauss(4)
    moved = np.zeros(3)
    for a, b, axes in zip(BENT[:-1], BENT[1:], AXES, strict=True):
        for s, share in zip(0.5 * (x + 1.0), 0.5 * w, strict=True):
            arm, size = BENT[-1] - (a + s * (b - a)), share * np.linalg.norm(b - a)
            turn = axes.T @ ((axes @ np.cross(arm, force)) / [1.3, 2.0, 5.0])
            moved += size * (np.cross(turn, arm) + axes.T @ ((axes @ force) / [200.0, 80.0, 60.0]))
    model = frame(BENT.tolist(), 6, force, "spatial", y_axis=SIDES)
    rest = model.equilibrium(parameters={"P": 1e-6})
    np.testing.assert_allclose(1e6 * (place(rest, "xyz") - BENT[-1]), moved, rtol=2e-5)


@pytest.mark.parametrize("space", ["planar", "spatial"])
def test_masses_of_a_frame_are_those_of_its_rods(space):
    """Mass, centre and tensor of inertia about the origin, those of the rods by their formulas."""
    line = BENT if space == "spatial" else np.column_stack([CORNER, np.zeros(3)])
    dimension, rotary = (3, (3e-3, 1e-3, 2e-3)) if space == "spatial" else (2, (0.0, 0.0, 1e-3))
    axes, side = (AXES, {"y_axis": SIDES}) if space == "spatial" else ([np.eye(3)] * 2, {})
    expected = np.zeros((4, 4))
    for a, b, own in zip(line[:-1], line[1:], axes, strict=True):
        mass = 1.5 * np.linalg.norm(b - a)
        first, second = mass * (a + b) / 2.0, mass * (np.outer(a, a) + np.outer(b, b) + np.outer(a + b, a + b)) / 6.0
        tensor = np.trace(second) * np.eye(3) - second + np.linalg.norm(b - a) * own.T @ np.diag(rotary) @ own
        expected += np.block([[np.array([[mass]]), first[None]], [first[:, None], tensor]])
    model = frame(line[:, :dimension].tolist(), [4, 3, 3][: len(line) - 1], [0.0] * dimension, space, clamp="", **side)
    found = np.zeros((4, 4))
    for body in model.mechanism.bodies:
        r = np.array([*(e.value for e in body.position), 0.0][:3])
        inertia = np.zeros((3, 3))
        if space == "spatial":
            xx, yy, zz, xy, xz, yz = (e.value for e in body.inertia)
            inertia = np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])
            x, y = (np.array([e.value for e in body.orientation.values[3 * i : 3 * i + 3]]) for i in range(2))
            turn = np.column_stack([x, y, np.cross(x, y)])
            inertia = turn @ inertia @ turn.T
        else:
            inertia[2, 2] = body.inertia.value
        mass = body.mass.value
        tensor = inertia + mass * (r @ r * np.eye(3) - np.outer(r, r))
        found += np.block([[np.array([[mass]]), mass * r[None]], [mass * r[:, None], tensor]])
    compared = np.ones((4, 4), bool)
    if space == "planar":  # of the tensor, the moment about z alone has a meaning
        compared = np.zeros((4, 4), bool)
        compared[0], compared[3, 3] = True, True
    np.testing.assert_allclose(found[compared], expected[compared], atol=1e-14)


@pytest.mark.by_turns(2)
@pytest.mark.slow
@pytest.mark.parametrize("space", ["planar", "spatial"])
def test_frame_vibrates_as_beams_with_a_rigid_joint(space):
    line = CORNER if space == "planar" else BENT[:3].tolist()
    stiff = STIFF if space == "planar" else SPATIAL
    builder = MechanismBuilder("joined", space=space)
    builder.beam("first", start=line[0], end=line[1], elements=4, clamp="ground", **stiff)
    side = {} if space == "planar" else {"y_axis": (-1.0, 0.0, 0.0)}
    builder.beam("second", start=line[1], end=line[2], elements=3, **stiff, **side)
    turned = {"angle": np.pi / 2} if space == "planar" else {}
    builder.joint("corner", "rigid", between=("first", "second"), at=("end", "start"), **turned)
    joined = Model(builder.build()).modes().omega_squared
    sides = {"y_axis": SIDES[:2]} if side else {}
    found = frame(line, [4, 3], [0.0] * len(line[0]), space, **sides).modes().omega_squared
    assert len(found) == len(joined)
    np.testing.assert_allclose(found, joined, rtol=1e-8)


@pytest.mark.by_turns(2)
@pytest.mark.slow
@pytest.mark.parametrize("space", ["planar", "spatial"])
def test_points_on_a_straight_line_change_nothing(space):
    """Elements of the same lengths as those of a beam with a start and an end."""
    pad = (0.3,) if space == "spatial" else ()
    force = (0.4, -1.0, *(0.5 for _ in pad))
    ends = [(0.2, 0.1, *pad), (1.4, 0.9, *pad)]
    inner = [tuple(np.array(ends[0]) + s * (np.array(ends[1]) - ends[0])) for s in (0.25, 0.625)]
    split = frame([ends[0], *inner, ends[1]], 8, force, space)
    whole = frame(None, 8, force, space, start=ends[0], end=ends[1])
    assert [len(model.mechanism.bodies) for model in (split, whole)] == [8, 8]
    shapes = [model.equilibrium().q for model in (split, whole)]
    for name, x in shapes[0].items():  # at vertices, angles are those of the ground frame's axes
        if name[-1] in "xyz":
            assert abs(x - shapes[1][name]) <= 1e-12, name


@pytest.mark.by_turns(3)
@pytest.mark.slow
def test_vertices_may_depend_on_parameters_in_space():
    """A frame on a body that is turned; the same with numbers in place of the parameter."""

    def model(size, **parameters):
        builder = MechanismBuilder("hub", space="spatial").body(
            "hub", mass=2.0, inertia=(1.0, 1.0, 1.0), orientation={"rotation_vector": (0.1, 0.2, 0.3)}
        )
        for name, value in parameters.items():
            builder.parameter(name, value)
        line = [(0.1, 0.0, 0.0), (size, 0.3, 0.2), (size, 0.8, -0.4)]
        builder.beam("rod", line=line, elements=4, clamp="hub", **SPATIAL)
        builder.joint("weld", "rigid", between=("ground", "hub"), at=((0.0, 0.0, 0.0), "centre"))
        return Model(builder.force("tip", **at_end(0.3, 0.2, -0.1)).build())

    formula, number = model("L", L=0.9), model(1.1)
    found, expected = formula.equilibrium(parameters={"L": 1.1}), number.equilibrium()
    np.testing.assert_allclose(place(found, "xyz"), place(expected, "xyz"), atol=1e-10)
    bent = [
        m.simulate(until=1e-6, step=1e-6, **p).potential[0]
        for m, p in ((formula, {"parameters": {"L": 1.1}}), (number, {}))
    ]
    assert max(bent) <= 1e-18

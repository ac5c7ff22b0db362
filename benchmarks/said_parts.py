"""Flexible parts of other systems' examples, which their files in `benchmarks/examples` name.

Sizes, materials and numbers of modes are those of the sources. Their meshes are Netgen's and Abaqus'; here they are
blocks of quadratic elements, so that eyes, bolts and drums are square, and bars of crankshafts have one section.
"""

from __future__ import annotations

import tempfile
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

import numpy as np
from scipy import sparse
from scipy.io import mmread, mmwrite

import symgen
from benchmarks.finite_elements import Array, Mesh, bar_frame, blocks, solid
from symgen.describe.reduction.reduction import Reduced


def _nodes(mesh: Mesh, where: Callable[..., Any], *more: float) -> list[int]:
    """Return the nodes whose places x, y, z (columns) are as said."""
    return [int(i) for i in np.flatnonzero(where(mesh.x.T, *more))]


def _reduced(mesh: Mesh, interfaces: Mapping[str, Any], inner: int, **keys: Any) -> Reduced:
    return symgen.reduced(mesh.x, mesh.mass, mesh.stiffness, interfaces, inner, **keys)


def _end(mesh: Mesh, name: str, x: float, inner: int, **keys: Any) -> Reduced:
    """Return a part with the section at one place as its interface."""
    return _reduced(mesh, {name: _nodes(mesh, lambda p: abs(p[0] - x) < 1e-9)}, inner, **keys)


def _lines(*parts: float | tuple[float, float, int]) -> Array:
    """Return edges of elements: places, and stretches with a number of elements."""
    return np.unique(np.concatenate([np.linspace(*p[:2], p[2] + 1) if isinstance(p, tuple) else [p] for p in parts]))


def _cuboid() -> Reduced:
    mesh = solid((1.0, 0.1, 0.1), (10, 1, 1), young=2e11, poisson=0.3, density=7850.0)
    return _reduced(mesh, mesh.ends, 6)


def _brick_on_corners(inner: int, young: float = 1e7) -> Reduced:
    """Return a brick whose left corners below stand on springs, with the stress above in the middle of its length."""
    mesh = solid((1.0, 0.05, 0.05), (20, 2, 2), young=young, poisson=0.3, density=1000.0)
    ends = {n: _nodes(mesh, lambda p, z: (p[0] == 0.0) & (p[1] < -0.01) & (z * p[2] > 0.01), z) for n, z in _SIDES}
    middle = next(i for i, cell in enumerate(mesh.cells) if (mesh.x[cell].mean(axis=0) > [0.5, 0.0, 0.0]).all())
    sigma = mesh.stress(middle, (0.0, 1.0, 0.0), np.array([1.0, 0.0, 0.0]))
    return _reduced(mesh, ends, inner, rows={"sigma": (sigma, "Pa")})


_SIDES = (("left", -1.0), ("right", 1.0))


def _bar_with_bolt_and_hole() -> Reduced:
    """Return the bar of the course on component modes: a bolt at its start, a hole at its end."""
    length, hole, eye = 0.25, 0.010, 0.016
    ends = (-eye, -hole, hole, eye)
    x = _lines(*ends, (eye, length - eye, 8), *(length + e for e in ends))

    def keep(p: Array) -> Any:
        bolt = abs(p[0]) < hole and abs(p[1]) < hole
        gone = abs(p[0] - length) < hole and abs(p[1]) < hole
        eyes = abs(p[0]) < eye or abs(p[0] - length) < eye
        return bolt if p[2] > -0.01 else (eyes or abs(p[1]) < hole) and not gone

    mesh = blocks([x, _lines(*ends), _lines(-0.03, -0.01, 0.01)], keep, 1e8, 0.3, 1000.0)

    def hole_at(p: Array) -> Any:
        return (abs(p[0] - length) < hole + 1e-9) & (abs(p[1]) < hole + 1e-9)

    faces = {"bolt": _nodes(mesh, lambda p: p[2] > -0.01 + 1e-9), "hole": _nodes(mesh, hole_at)}
    cell = next(i for i, c in enumerate(mesh.cells) if abs(mesh.x[c].mean(axis=0)[0] - 0.5 * length) < 0.02)
    sigma = mesh.stress(cell, (0.0, 1.0, 0.0), np.array([1.0, 0.0, 0.0]))
    return _reduced(mesh, faces, 8, rows={"sigma": (sigma, "Pa")})


def _hinge(inner: int, bushing: bool) -> Reduced:
    """Return the plate of a hinge with a bolt at its start and a bushing at its end."""
    length, bolt, outer, half = 0.4, 0.015, 0.03, 0.01
    x = _lines(-outer, -bolt, bolt, (outer, length - outer, 6), length - bolt, length + bolt, length + outer)

    def keep(p: Array) -> Any:
        if abs(p[0]) < outer:
            return p[1] > 0.0 or (abs(p[0]) < bolt and abs(p[2]) < bolt)
        if abs(p[0] - length) < outer:
            return p[1] > 0.0 or not (abs(p[0] - length) < bolt and abs(p[2]) < bolt)
        return p[1] > 0.0 and abs(p[2]) < half

    z = _lines(-outer, -bolt, -half, half, bolt, outer)
    mesh = blocks([x, _lines(-0.05, 0.0, 0.04), z], keep, 2e8, 0.3, 7850.0)
    faces = {"bolt": _nodes(mesh, lambda p: (p[0] < 0.1) & (p[1] < -1e-9))}

    def inside(p: Array) -> Any:
        return (abs(p[0] - length) < bolt + 1e-9) & (abs(p[2]) < bolt + 1e-9) & (p[1] < -1e-9)

    faces |= {"bushing": _nodes(mesh, inside)} if bushing else {}
    return _reduced(mesh, faces, inner)


def _container() -> Reduced:
    """Return a frame on four bearings that carries a container with a soft filling."""
    a, b, t = 0.12, 0.09, 0.04
    side = 0.4 - t
    back = 1.0 - 0.5 * b
    x = _lines(back - 1.2, back - 0.5, 0.0, 0.067, 0.173, 0.5, back, back + 0.5 * t, 1.0 + 0.5 * b)
    y = _lines(-0.4, -side, -0.5 * a, 0.5 * a, side, 0.4)
    z = _lines(
        -b,
        -0.5 * b,
        0.5 * b,
        b,
        0.5 - 0.4,
        0.5 - side,
        0.5 + side,
        0.5 + 0.4,
        *(1.0 + b * np.array([-1, -0.5, 0.5, 1])),
    )

    def inside(p: Array, most: float) -> Any:
        return abs(p[1]) < most and abs(p[2] - 0.5) < most and p[0] < back + 0.5 * t

    def keep(p: Array) -> Any:
        arm = abs(p[1]) < 0.5 * a and p[0] > 0.0 and min(abs(p[2]), abs(p[2] - 1.0)) < 0.5 * b
        post = abs(p[1]) < 0.5 * a and p[0] > back and -0.5 * b < p[2] < 1.0 + 0.5 * b
        pin = 0.067 < p[0] < 0.173 and abs(p[1]) < 0.5 * a and min(abs(p[2]), abs(p[2] - 1.0)) < b
        wall = inside(p, 0.4) and not (inside(p, side) and p[0] < back)
        filled = inside(p, side) and p[0] > back - 0.5
        return arm or post or pin or wall or filled

    def grade(p: Array) -> tuple[float, float]:
        soft = inside(p, side) and p[0] < back
        return (5e8 / 2.1e9, 2800.0 / 7800.0) if soft else (1.0, 1.0)

    mesh = blocks([x, y, z], keep, 2.1e9, 0.3, 7800.0, grade=grade)
    places = {"below0": -b, "above0": b, "below1": 1.0 - b, "above1": 1.0 + b}
    return _reduced(
        mesh, {n: _nodes(mesh, lambda p, z: (abs(p[2] - z) < 1e-9) & (p[0] < 0.2), z) for n, z in places.items()}, 16
    )


def _crane() -> Reduced:
    """Return a platform on four feet with a slanted arm, whose tip is an interface."""
    foot, wide, long, tall = 0.4, 2.5, 6.0, 1.0
    x = _lines(-0.5 * wide - foot, (-0.5 * wide, -0.25, 1), 0.25, (0.25, 0.5 * wide, 1), 0.5 * wide + foot)
    y = _lines(-0.5 * long, -0.5 * long + foot, -0.25, 0.25, 0.5 * long - foot, 0.5 * long)
    z = _lines(0.0, tall - 0.3, tall, (tall, tall + 16.0, 6))

    def keep(p: Array) -> Any:
        feet = abs(p[0]) > 0.5 * wide and abs(p[1]) > 0.5 * long - foot and p[2] < tall
        return (
            feet
            or (abs(p[0]) < 0.5 * wide and tall - 0.3 < p[2] < tall)
            or (abs(p[0]) < 0.25 and abs(p[1]) < 0.25 and p[2] > tall)
        )

    def lean(x: Array) -> Array:
        bent, up = x.copy(), np.maximum(x[:, 2] - tall, 0.0)
        bent[:, 1] += up * np.cos(np.pi / 3.0)
        bent[:, 2] -= up * (1.0 - np.sin(np.pi / 3.0))
        return bent

    def hollow(p: Array) -> tuple[float, float]:
        share = 1.0 - (0.4 / 0.5) ** 2 if p[2] > tall else 1.0
        return share, share

    mesh = blocks([x, y, z], keep, 2.1e11, 0.3, 7800.0, shape=lean, grade=hollow)
    feet = {
        f"foot{i}": _nodes(mesh, lambda p, u, v: (p[2] == 0.0) & (u * p[0] > 0.0) & (v * p[1] > 0.0), u, v)
        for i, (u, v) in enumerate(((-1, -1), (1, -1), (-1, 1), (1, 1)))
    }
    top = mesh.x[:, 2].max()
    return _reduced(mesh, feet | {"tip": _nodes(mesh, lambda p: abs(p[2] - top) < 1e-9)}, 8)


def _portal(high: float, thick: float, drum: bool) -> Reduced:
    """Return a portal with boxes at its walls, which are interfaces, or with a drum on them and its feet as one."""
    wide, box = 1.5 - thick, 0.1
    tall = 0.8 * high if drum else 0.5 * high
    x = _lines(0.0, 0.2, (0.2, 1.9, 2), 2.1, (2.1, 3.8, 2), 4.0)
    half = 0.5 * box
    y = _lines(-1.5, -wide, -wide + box, (-wide + box, wide - box, 2), wide - box, wide, 1.5)
    z = _lines(0.0, tall - half, tall + half, high - thick, high)
    r = wide - box
    if drum:
        y = _lines(*y, -r + thick, r - thick)
        z = _lines(*z, tall - r, tall - r + thick, tall + r - thick, tall + r)

    def keep(p: Array) -> Any:
        frame = p[2] > 0.0 and p[2] < high and (abs(p[1]) > wide or (p[2] > high - thick and not drum))
        boxes = (
            wide - box < abs(p[1]) < wide and abs(p[2] - tall) < half and (p[0] < 0.2 or 1.9 < p[0] < 2.1 or p[0] > 3.8)
        )
        far = max(abs(p[1]), abs(p[2] - tall))
        return frame or boxes or (drum and r - thick < far < r)

    mesh = blocks([x, y, z], keep, 8e11, 0.3, 2800.0)
    if drum:
        return _reduced(mesh, {"feet": _nodes(mesh, lambda p: abs(p[2]) < 1e-9)}, 24)

    def near(p: Array, u: float, v: float) -> Any:
        return (
            (v * p[1] < wide + 1e-9)
            & (v * p[1] > wide - box - 1e-9)
            & (abs(p[2] - tall) < half + 1e-9)
            & (abs(p[0] - u) < 0.1 + 1e-9)
        )

    boxes = {
        f"box{i}": _nodes(mesh, near, u, v) for i, (u, v) in enumerate((u, v) for v in (-1, 1) for u in (0.1, 2.0, 3.9))
    }
    return _reduced(mesh, boxes, 8)


def _rotor(stiffer: float, inner: int, unbalance: float = 0.1, hub: bool = False) -> Reduced:
    """Return Abaqus' rotor: a square shaft along z with an octagonal disc, and a mass on its rim out of balance."""
    shaft, rim = 0.05, 0.195984438
    side = _lines(-rim, -shaft, 0.0, shaft, rim)

    def octagon(x: Array) -> Array:
        bent = x.copy()
        far = np.abs(x[:, :2]).max(axis=1)
        out = far > shaft + 1e-9
        angle = np.arctan2(x[out, 1], x[out, 0])
        edge = rim * np.cos(np.pi / 8.0) / np.cos(np.mod(angle, np.pi / 4.0) - np.pi / 8.0)
        share = (far[out] - shaft) / (rim - shaft)
        away = np.linalg.norm(x[out, :2], axis=1)
        bent[out, :2] *= (1.0 - share + share * edge * far[out] / (rim * away))[:, None]
        return bent

    def keep(p: Array) -> Any:
        return (abs(p[0]) < shaft and abs(p[1]) < shaft) or 0.1 < p[2] < 0.15

    mesh = blocks([side, side, _lines((0.0, 0.5, 10))], keep, 2.1e11 * stiffer, 0.3, 7850.0, shape=octagon)
    heavy = _nodes(mesh, lambda p: (abs(p[0]) < 1e-9) & (p[1] > rim - 1e-6) & (abs(p[2] - 0.15) < 1e-9))
    mass = mesh.mass.tolil()
    for k in range(3):
        mass[3 * heavy[0] + k, 3 * heavy[0] + k] += unbalance
    ends = {"left": _nodes(mesh, lambda p: p[2] < 1e-9), "right": _nodes(mesh, lambda p: p[2] > 0.5 - 1e-9)}
    if hub:

        def middle(p: Array) -> Any:
            return (abs(p[2] - 0.15) < 1e-9) & (abs(p[0]) < shaft) & (abs(p[1]) < shaft)

        ends["hub"] = _nodes(mesh, middle)
    return symgen.reduced(mesh.x, mass.tocsc(), mesh.stiffness, ends, inner, rows=_stress_of(mesh))


def _gyro() -> Reduced:
    """Return a wheel with a bore of 11 mm by which it is held, as the source's file of triangles is not public."""
    bore, rim = 0.0055, 0.03
    side = _lines(-rim, -bore, bore, rim)
    mesh = blocks(
        [side, _lines(-0.006, 0.0, 0.006), side],
        lambda p: max(abs(p[0]), abs(p[2])) > bore,
        *(1e8, 0.3, 7850.0),
    )
    inside = _nodes(mesh, lambda p: (abs(p[0]) < bore + 1e-9) & (abs(p[2]) < bore + 1e-9))
    return _reduced(mesh, {"bore": inside}, 16)


def _shaft() -> Mesh:
    side = _lines(-0.05, 0.05)
    return blocks([side, side, _lines((0.0, 1.0, 8))], lambda _: True, 2.1e9, 0.3, 7850.0)


def _read_again(mesh: Mesh, by_nodes: bool) -> Reduced:
    """Return the rotor of two programs, whose matrices are read from files: Abaqus' rows by nodes, or Matrix Market."""
    read = dict[str, Any]()
    with tempfile.TemporaryDirectory() as folder:
        for name, matrix in (("M", mesh.mass), ("K", mesh.stiffness)):
            file = Path(folder) / f"{name}.mtx"
            if by_nodes:
                part = sparse.coo_array(sparse.tril(matrix))
                rows = [part.row // 3 + 1, part.row % 3 + 1, part.col // 3 + 1, part.col % 3 + 1, part.data]
                np.savetxt(file, np.column_stack(rows), fmt=["%d"] * 4 + ["%.17g"], delimiter=",")
                a, i, b, j, value = np.loadtxt(file, delimiter=",").T
                places = (3 * (a - 1) + i - 1).astype(int), (3 * (b - 1) + j - 1).astype(int)
                half = sparse.coo_array((value, places), shape=matrix.shape).tocsr()
                read[name] = half + half.T - sparse.diags_array(half.diagonal())
            else:
                mmwrite(file, sparse.coo_array(matrix), precision=17)
                read[name] = sparse.csr_array(mmread(file))
    return symgen.reduced(mesh.x, read["M"], read["K"], None, 6)


def _stress_of(mesh: Mesh) -> dict[str, Any]:
    middle = next(i for i, c in enumerate(mesh.cells) if abs(mesh.x[c].mean(axis=0)[2] - 0.275) < 0.01)
    return {"sigma": (mesh.stress(middle, (1.0, 0.0, 0.0), np.array([0.0, 0.0, 1.0])), "Pa")}


def _crankshaft(angles: tuple[float, ...], young: float, inner: int) -> Reduced:
    """Return the bars of a crankshaft along z, with its ends and pins as interfaces."""
    web, journal, pin, reach, radius = 0.019, 0.012, 0.012, 0.030, 0.012
    places, pins = [np.array([0.0, 0.0, -0.020])], list[int]()
    z = 0.0
    for angle in angles:
        arm = reach * np.array([np.cos(angle), np.sin(angle), 0.0])
        middle, last = web + 0.5 * pin, 2.0 * web + pin
        places += [
            np.array([0.0, 0.0, z + 0.5 * web]),
            arm + np.array([0.0, 0.0, z + 0.5 * web]),
            arm + np.array([0.0, 0.0, z + middle]),
        ]
        pins.append(len(places) - 1)
        places += [arm + np.array([0.0, 0.0, z + last - 0.5 * web]), np.array([0.0, 0.0, z + last - 0.5 * web])]
        z += last + journal
        places.append(np.array([0.0, 0.0, z]))
    area, second = np.pi * radius**2, 0.25 * np.pi * radius**4
    mesh = bar_frame(np.array(places), young, area, second, 7850.0, 2.0 * second, young / 2.6)
    faces = {"front": [0], "back": [len(places) - 1]} | {f"pin{i}": [n] for i, n in enumerate(pins)}
    return _reduced(mesh, faces if len(angles) < 5 else {}, inner)


def _rod() -> Reduced:
    mesh = solid((0.080, 0.024, 0.012), (6, 1, 1), young=2.1e10, poisson=0.3, density=7850.0)
    return _reduced(mesh, mesh.ends, 8)


def _piston() -> Reduced:
    """Return a crown with two cheeks, between which the pin of the rod lies."""
    x, y = _lines(-0.014, -0.008, 0.008, 0.020), _lines(-0.025, -0.018, 0.018, 0.025)

    def keep(p: Array) -> Any:
        return p[0] > 0.008 or abs(p[1]) > 0.018 or (abs(p[0]) < 0.008)

    mesh = blocks([x, y, _lines(-0.016, -0.006, 0.006, 0.016)], keep, 2.1e10, 0.3, 7850.0)

    def inside(p: Array) -> Any:
        return (abs(p[0]) < 0.008 + 1e-9) & (abs(p[1]) < 0.018 + 1e-9) & (abs(p[2]) < 0.006 + 1e-9)

    return _reduced(mesh, {"pin": _nodes(mesh, inside)}, 8)


def _base() -> Reduced:
    """Return the hollow base of a robot below its first joint."""
    edges = _lines(-0.08, -0.07, -0.05, 0.05, 0.07, 0.08)

    def keep(p: Array) -> Any:
        return (
            (max(abs(p[0]), abs(p[1])) > 0.07 or not -0.29 < p[2] < -0.06)
            if p[2] < -0.05
            else max(abs(p[0]), abs(p[1])) < 0.05
        )

    mesh = blocks([edges, edges, _lines(-0.3, -0.29, (-0.29, -0.06, 3), -0.05, 0.0)], keep, 1e9, 0.3, 1000.0)
    faces = {"floor": _nodes(mesh, lambda p: p[2] < -0.3 + 1e-9), "flange": _nodes(mesh, lambda p: p[2] > -1e-9)}
    return _reduced(mesh, faces, 8)


def _cantilever(sizes: tuple[float, float, float], young: float, poisson: float, density: float, inner: int) -> Reduced:
    mesh = solid(sizes, (max(8, round(0.5 * sizes[0] / sizes[1])), 1, 1), young=young, poisson=poisson, density=density)
    tip = _nodes(
        mesh, lambda p: (abs(p[0] - sizes[0]) < 1e-9) & (p[1] < 1e-9 - 0.5 * sizes[1]) & (p[2] < 1e-9 - 0.5 * sizes[2])
    )
    return _end(mesh, "root", 0.0, inner, rows={"tip": {"node": tip[0], "from": "root"}})


_THIRD = 2.0 * np.pi / 3.0
_SIX = (0.0, _THIRD, 2.0 * _THIRD, 2.0 * _THIRD, _THIRD, 0.0)

#: Set and name of an example -> names of the files of its parts, with what makes them.
PARTS: Mapping[str, Mapping[str, Callable[[], Reduced]]] = {
    "exudyn/CMSexampleCourse": {"bar.npz": _bar_with_bolt_and_hole},
    "exudyn/NGsolveCMStutorial": {"hinge.npz": lambda: _hinge(8, False)},
    "exudyn/NGsolveCraigBampton": {"beam.npz": lambda: _cantilever((1.0, 0.05, 0.05), 1e8, 0.3, 1000.0, 8)},
    "exudyn/NGsolveCreateFFRFreducedOrder": {"cuboid.npz": _cuboid},
    "exudyn/NGsolveFFRF": {"frame.npz": _container},
    "exudyn/NGsolveModalAnalysis": {"crane.npz": _crane},
    "exudyn/NGsolveOCCboundaries": {"portal.npz": lambda: _portal(1.5, 0.1, False)},
    "exudyn/NGsolveOCCboundaries2": {"portal.npz": lambda: _portal(2.0, 0.08, True)},
    "exudyn/NGsolvePistonEngine": {
        "crank.npz": lambda: _crankshaft((0.0,), 2.1e10, 4),
        "rod.npz": _rod,
        "piston.npz": _piston,
    },
    "exudyn/NGsolvePostProcessingStresses": {"brick.npz": lambda: _brick_on_corners(10)},
    "exudyn/ObjectFFRFconvergenceTestBeam": {"beam.npz": lambda: _cantilever((1.0, 0.1, 0.1), 1e8, 0.3, 1000.0, 10)},
    "exudyn/ObjectFFRFconvergenceTestHinge": {"hinge.npz": lambda: _hinge(8, True)},
    "exudyn/netgenSTLtest": {"gyro.npz": _gyro},
    "exudyn/objectFFRFreducedOrderNetgen": {"brick.npz": lambda: _brick_on_corners(12, 1e8)},
    "exudyn/pendulumVerify": {"strip.npz": lambda: _cantilever((0.4, 0.008, 0.004), 7e10, 0.35, 2700.0, 10)},
    "exudyn/serialRobotFlexible": {"base.npz": _base},
    "exudyn-tests/NGsolveCMStest": {"beam.npz": lambda: _cantilever((1.0, 0.2, 0.2), 1e6, 0.3, 1000.0, 4)},
    "exudyn-tests/NGsolveCrankShaftTest": {"crank.npz": lambda: _crankshaft(_SIX, 2.1e11, 8)},
    "exudyn-tests/abaqusImportTest": {"block.npz": lambda: _cantilever((4.0, 1.0, 1.0), 2e11, 0.3, 2900.0, 5)},
    "exudyn-tests/compareAbaqusAnsysRotorEigenfrequencies": {
        "abaqus.npz": lambda: _read_again(_shaft(), True),
        "ansys.npz": lambda: _read_again(_shaft(), False),
    },
    "exudyn-tests/objectFFRFreducedOrderAccelerations": {"rotor.npz": lambda: _rotor(6e-4, 8)},
    "exudyn-tests/objectFFRFreducedOrderShowModes": {"rotor.npz": lambda: _rotor(1e-2, 8)},
    "exudyn-tests/objectFFRFreducedOrderStressModesTest": {"rotor.npz": lambda: _rotor(1.0, 8, 10.0)},
    "exudyn-tests/objectFFRFreducedOrderTest": {"rotor.npz": lambda: _rotor(1e-2, 8)},
    "exudyn-tests/objectGenericODE2Test": {"rotor.npz": lambda: _rotor(1e-2, 8, 0.0, hub=True)},
    "exudyn-tests/perfObjectFFRFreducedOrder": {"rotor.npz": lambda: _rotor(1e-2, 8)},
    "exudyn-tests/superElementRigidJointTest": {"rotor.npz": lambda: _rotor(1e-3, 20)},
}


def write_parts(name: str, folder: Path) -> None:
    """Write the files of the parts of an example into a folder."""
    for file, make in PARTS.get(name, {}).items():
        make().save(folder / file)

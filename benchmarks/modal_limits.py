"""Twelve machines with a modal body, from small loads to twice where its mark begins: errors, and what is said.

python -m benchmarks.modal_limits [MACHINE ...]

computes the rows of some machines or of all, writes them to ``benchmarks/records/modal_limits.json`` and prints
``docs/tables/modal-limits.md`` from there. Errors are over closed forms, or over frames of `benchmarks.exact_frames`.
"""

from __future__ import annotations

import json
import sys
import tempfile
from collections.abc import Callable
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import brentq

import symgen
from benchmarks.exact_frames import bent_strut, frame_at_rest, lag_of_blade
from benchmarks.finite_elements import Mesh, bar_frame, solid
from symgen.result.interface_poses import interface_poses
from symgen.result.points import rotation_matrices

Array = NDArray[np.float64]
ROOT = Path(__file__).resolve().parents[1]
RECORD, PAGE = ROOT / "benchmarks" / "records" / "modal_limits.json", ROOT / "docs" / "tables" / "modal-limits.md"
#: Above the one, a run without a word is silent; below the other, a word is a false alarm.
SILENT, FALSE = 0.03, 0.007
YOUNG, SHEAR, DENSITY = 2.1e11, 8e10, 7850.0


class Row(NamedTuple):
    """What a machine does at a load: error over the answer, and whether the mark of its body doubts it."""

    load: float
    error: float
    marked: bool


class Machine(NamedTuple):
    """A machine that is swept.

    Attributes
    ----------
    load : str
        What is swept.
    loads : tuple of float
        To twice where linear modes are marked.
    against : str
        What errors are over.
    measure : callable
        Takes a folder, a load and keys of the reduction; returns the answer, the right one and whether it is marked.
    bars : bool
        Whether the body can be stiffened.
    """

    load: str
    loads: tuple[float, ...]
    against: str
    measure: Callable[..., tuple[float, float, bool]]
    bars: bool = True


# -- what machines share -----------------------------------------------------------------------------------------------

_HEAD = '[mechanism]\nname = "{name}"\nspace = "{space}"\ngravity = {gravity}\n\n[run]\nuntil = {until!r}\n'
_ARM = '\n[bodies.arm]\ntype = "modal"\nfile = "arm.npz"\n'


def _model(folder: Path, text: str, spatial: bool = False, gravity: str = "", **run: Any) -> symgen.Model:
    nothing = "[0.0, 0.0, 0.0]" if spatial else "[0.0, 0.0]"
    space = "spatial" if spatial else "planar"
    head = _HEAD.format(name="arm", space=space, gravity=gravity or nothing, until=run.pop("until", 0.1))
    head += "".join(f"{key} = {value!r}\n" for key, value in run.items())
    (folder / "arm.toml").write_text(head + text, encoding="utf-8")
    return symgen.load(folder / "arm.toml")


def _reduce(folder: Path, mesh: Mesh, faces: dict[str, Any], inner: int, **keys: Any) -> symgen.Reduced:
    body = symgen.reduced(mesh.x, mesh.mass, mesh.stiffness, faces, inner, **keys)
    body.save(folder / "arm.npz")
    return body


def _joint(name: str, kind: str, body: str, at: Array | list[float], base: str = "ground") -> str:
    places = f"[{[float(x) for x in at]}, {[0.0] * len(at)}]"
    return f'\n[joints.{name}]\ntype = "{kind}"\nbetween = ["{base}", "{body}"]\nat = {places}\n'


def _force(name: str, body: str, *force: float) -> str:
    values = f"force = {[float(x) for x in force]}\nat = {[0.0] * len(force)}"
    return f'\n[forces.{name}]\ntype = "force"\nbody = "{body}"\n{values}\n'


def _rest(model: symgen.Model, *points: str) -> tuple[list[Array], bool]:
    """Return places of interfaces at rest, and whether parts are beyond their limits."""
    rest, body = model.equilibrium(), model.mechanism.body("arm")
    q = np.array([[rest.q[f"arm.{name}"] for name in body.coordinates]])
    d, turn = (2, 1) if model.mechanism.space == "planar" else (3, 4)
    m, axes = q[:, d + turn :], rotation_matrices(q[:, d : d + turn])[0]
    places = [q[0, :d] + axes @ interface_poses(_carried(model, point), m).origins[0] for point in points]
    return places, any("limits of its parts" in note for note in rest.notes)


def _carried(model: symgen.Model, name: str) -> Any:
    return model.mechanism.body(name).carried


def _bar(count: int = 40, length: float = 1.0, thick: float = 0.005, wide: float = 0.02) -> tuple[Mesh, float, float]:
    """Return a straight steel bar, its axial stiffness and its bending one."""
    x = np.column_stack([np.linspace(0.0, length, count + 1), np.zeros(count + 1)])
    area, second = wide * thick, wide * thick**3 / 12.0
    return bar_frame(x, YOUNG, area, second, DENSITY), YOUNG * area, YOUNG * second


# -- machines ----------------------------------------------------------------------------------------------------------


def _held_by_closed_form(axial: float, bending: float, force: float) -> float:
    """Return the middle of a bar of one metre between walls, with the thrust that its own stretch makes."""
    x = np.linspace(0.0, 0.5, 4001)

    def slope(n: float) -> Array:
        k = np.sqrt(n / bending)
        return np.asarray(force / (2.0 * n) * (1.0 - np.cosh(k * (x - 0.25)) / np.cosh(0.25 * k)))

    thrust = brentq(
        lambda n: np.trapezoid(slope(n) ** 2, x) - n / axial, 1e-6 * bending, 1e4 * bending, xtol=1e-12 * bending
    )
    return float(np.trapezoid(slope(thrust), x))


def _strip(folder: Path, share: float, **keys: Any) -> tuple[float, float, bool]:
    mesh, axial, bending = _bar(thick=0.002)
    _reduce(folder, mesh, {"root": [0], "middle": [20], "tip": [40]}, 2, **keys)
    force = 192.0 * bending * share * 0.002
    text = _ARM + _joint("a", "rigid", "arm.root", [0, 0]) + _joint("b", "rigid", "arm.tip", [1, 0])
    (middle,), said = _rest(_model(folder, text + _force("push", "arm.middle", 0.0, force)), "arm.middle")
    return float(middle[1]), _held_by_closed_form(axial, bending, force), said


def _plate(folder: Path, share: float) -> tuple[float, float, bool]:
    thick, wide = 0.005, 0.2
    mesh = solid((1.0, wide, thick), (40, 1, 1), young=YOUNG, poisson=0.0, density=DENSITY)
    line = np.flatnonzero(np.abs(mesh.x[:, 0] - 0.5) < 1e-9)
    _reduce(folder, mesh, {"root": mesh.start, "middle": line, "tip": mesh.end}, 1)
    axial, bending = YOUNG * wide * thick, YOUNG * wide * thick**3 / 12.0
    force = 192.0 * bending * share * thick
    text = _ARM + _joint("a", "rigid", "arm.root", [0, 0, 0]) + _joint("b", "rigid", "arm.tip", [1, 0, 0])
    model = _model(folder, text + _force("push", "arm.middle", 0.0, 0.0, force), spatial=True)
    (middle,), said = _rest(model, "arm.middle")
    return float(middle[2]), _held_by_closed_form(axial, bending, force), said


def _mast(folder: Path, mass: float, **keys: Any) -> tuple[float, float, bool]:
    """Return the sway of a mast with a mass on a stiff beam between walls; weight is 0.3 degrees off the vertical."""
    beam = bar_frame(np.column_stack([np.linspace(-0.8, 0.8, 13), np.zeros(13)]), YOUNG, 1.2e-3, 3.6e-7, DENSITY)
    pole = bar_frame(np.column_stack([np.zeros(21), np.linspace(0.0, 0.5, 21)]), YOUNG, 6e-5, 4.5e-11, 0.1)
    own, whole = np.r_[18:21, 39:99], np.zeros((2, 99, 99))
    for matrix, parts in zip(whole, ((beam.mass, pole.mass), (beam.stiffness, pole.stiffness)), strict=True):
        matrix[:39, :39] += parts[0].toarray()
        matrix[np.ix_(own, own)] += parts[1].toarray()
    whole[0][[96, 97, 98], [96, 97, 98]] += mass, mass, 1e-6
    x, rows = np.vstack([beam.x, pole.x[1:]]), {"aside": np.eye(99)[96], "up": np.eye(99)[97]}
    body = symgen.reduced(x, whole[0], whole[1], {"root": [0], "tip": [12]}, 4, rows=rows, **keys)
    body.save(folder / "arm.npz")
    text = _ARM + _joint("a", "rigid", "arm.root", [-0.8, 0]) + _joint("b", "rigid", "arm.tip", [0.8, 0])
    model = _model(folder, text, gravity="[0.05, -9.81]")
    rest = model.equilibrium()
    m = np.array([rest.q[f"arm.m{i}"] for i in range(1, len(body.frequencies) + 1)])
    modal = model.mechanism.body("arm").modal
    assert modal is not None
    away = np.array([0.0, 0.5]) - body.centre + [m @ np.array(row.factors) for row in modal.rows]
    sway = rest.q["arm.x"] + away @ [np.cos(rest.q["arm.theta"]), -np.sin(rest.q["arm.theta"])]
    k = np.sqrt(9.81 * mass / (YOUNG * 4.5e-11))
    exact = 0.05 / 9.81 * (np.tan(0.5 * k) / k - 0.5)
    return float(sway), float(exact), any("limits of its parts" in note for note in rest.notes)


def _couple(folder: Path, share: float, **keys: Any) -> tuple[float, float, bool]:
    """Return the sway of a clamped deep strip under a couple about its stiff axis and a small load across."""
    thick, deep = 0.002, 0.04
    weak, stiff, twist = YOUNG * deep * thick**3 / 12, YOUNG * thick * deep**3 / 12, SHEAR * deep * thick**3 / 3
    x = np.zeros((21, 3))
    x[:, 0] = np.linspace(0.0, 1.0, 21)
    second = weak / YOUNG, stiff / YOUNG
    mesh = bar_frame(x, YOUNG, thick * deep, second, DENSITY, twist / SHEAR, SHEAR)
    _reduce(folder, mesh, mesh.ends, 4, **keys)
    couple, aside = share * np.sqrt(weak * twist), 0.03 * weak
    text = _ARM + _joint("a", "rigid", "arm.root", [0, 0, 0]) + _force("aside", "arm.tip", 0.0, aside, 0.0)
    text += f'\n[forces.couple]\ntype = "torque"\nbody = "arm.tip"\ntorque = [0.0, {float(couple)!r}, 0.0]\n'
    (tip,), said = _rest(_model(folder, text, spatial=True), "arm.tip")
    k = share * np.sqrt((1.0 - weak / stiff) * (1.0 - twist / stiff))
    return float(tip[1]), float(aside / weak / k**2 * (np.sin(k) / k - np.cos(k))), said


def _frame(folder: Path, share: float, **keys: Any) -> tuple[float, float, bool]:
    """Return the sway of a frame on pins under weights on its corners, and a fiftieth of these aside."""
    n, high, thick = 20, 0.6, 0.006
    area, second = 0.02 * thick, 0.02 * thick**3 / 12.0
    x = _legs(n, high)
    mesh = bar_frame(x, YOUNG, area, second, DENSITY)
    _reduce(folder, mesh, {"left": [0], "right": [3 * n], "first": [n], "second": [2 * n]}, 4, **keys)
    weight = share * YOUNG * second / high**2
    text = _ARM + _joint("a", "revolute", "arm.left", x[0]) + _joint("b", "revolute", "arm.right", x[-1])
    text += _force("f", "arm.first", 0.02 * weight, -weight) + _force("s", "arm.second", 0.0, -weight)
    (corner,), said = _rest(_model(folder, text), "arm.first")
    n *= 3  # the exact frame is finer
    bars, feet = [(i, i + 1) for i in range(3 * n)], [0, 1, 9 * n, 9 * n + 1]
    loads = {3 * n: 0.02 * weight, 3 * n + 1: -weight, 6 * n + 1: -weight}
    exact = frame_at_rest(_legs(n, high), bars, YOUNG * area, YOUNG * second, feet, loads)[n, 0]
    return float(corner[0]), float(exact), said


def _legs(n: int, high: float) -> Array:
    """Return the nodes of a frame of two legs and a beam a third longer, with n bars each."""
    corners = high * np.array([[0.0, 0.0], [0.0, 1.0], [4.0 / 3.0, 1.0], [4.0 / 3.0, 0.0]])
    share = np.linspace(0.0, 3.0, 3 * n + 1)
    return np.column_stack([np.interp(share, np.arange(4), corner) for corner in corners.T])


def _arc(folder: Path, share: float, **keys: Any) -> tuple[float, float, bool]:
    """Return the tip of a clamped quarter of a circle that is pulled along the tangent of its root."""
    radius, n, thick = 0.5, 60, 0.005
    angle = np.linspace(0.0, np.pi / 2.0, n + 1)
    x = radius * np.column_stack([np.sin(angle), 1.0 - np.cos(angle)])
    area, second = 0.02 * thick, 0.02 * thick**3 / 12.0
    _reduce(folder, bar_frame(x, YOUNG, area, second, DENSITY), {"root": [0], "tip": [n]}, 4, **keys)
    pull = share * 3.0 * YOUNG * second / (2.0 * radius**2)
    text = _ARM + _joint("a", "rigid", "arm.root", [0, 0]) + _force("pull", "arm.tip", pull, 0.0)
    (tip,), said = _rest(_model(folder, text), "arm.tip")
    bars = [(i, i + 1) for i in range(n)]
    exact = frame_at_rest(x, bars, YOUNG * area, YOUNG * second, [0, 1, 2], {3 * n: pull})[n, 0]
    return float(tip[0] - x[n, 0]), float(exact), said


def _arm(folder: Path, share: float, **keys: Any) -> tuple[float, float, bool]:
    """Return the tip of a clamped bar, 45 degrees up, across the bar under a weight."""
    n = 60
    mesh, axial, bending = _bar(n)
    _reduce(folder, mesh, {"root": [0], "tip": [n]}, 4, **keys)
    weight = share * 3.0 * bending / np.sqrt(2.0)
    text = _ARM + _joint("a", "rigid", "arm.root", [0, 0]) + _force("load", "arm.tip", -weight, -weight)
    (tip,), said = _rest(_model(folder, text), "arm.tip")
    loads = {3 * n: -weight, 3 * n + 1: -weight}
    bars = [(i, i + 1) for i in range(n)]
    return float(tip[1]), float(frame_at_rest(mesh.x, bars, axial, bending, [0, 1, 2], loads)[n, 1]), said


def _between_pins(folder: Path, share: float, **keys: Any) -> tuple[float, float, bool]:
    """Return the middle of a bar between pins, one of which slides, under a small load across; a push is positive."""
    mesh, _, bending = _bar()
    _reduce(folder, mesh, {"root": [0], "middle": [20], "tip": [40]}, 3, **keys)
    push = 3.0 * bending * share
    text = _ARM + "\n[bodies.shoe]\nmass = 0.2\ninertia = 1e-3\nposition = [1.0, 0.0]\n"
    text += _joint("a", "revolute", "arm.root", [0, 0]) + _joint("b", "revolute", "arm.tip", [0, 0], "shoe")
    text += _joint("guide", "translational", "shoe", [0, 0]) + "axis = [1.0, 0.0]\n"
    text += _force("push", "shoe", -push, 0.0) + _force("aside", "arm.middle", 0.0, 0.05 * bending)
    (middle,), said = _rest(_model(folder, text), "arm.middle")
    k = np.sqrt(complex(push / bending))
    return float(middle[1]), float((0.05 * (np.tan(k / 2.0) - k / 2.0) / (2.0 * k**3)).real), said


def _strand(folder: Path, share: float, **keys: Any) -> tuple[float, float, bool]:
    return _between_pins(folder, -share, **keys)


def _buckling(folder: Path, share: float, **keys: Any) -> tuple[float, float, bool]:
    """Return the middle of the bar between pins under a share of Euler's load, below and above."""
    own, _, said = _between_pins(folder, share * np.pi**2 / 3.0, **keys)
    return own, bent_strut(share, 0.05), said


def _turning(folder: Path, share: float, clamp: int, **keys: Any) -> tuple[float, float, bool]:
    """Return the first frequency in the plane of the turn, of a bar that a hub turns about one of its nodes."""
    mesh, _, bending = _bar(20)
    body = _reduce(folder, mesh, {"root": [clamp]}, 4, **keys)
    reach, line = 1.0 - clamp / 20.0, DENSITY * 1e-4
    speed = float(share * 2.0 * np.pi * body.frequencies[0])
    exact = lag_of_blade(reach, bending, line, speed)
    text = _ARM + f"damping = {0.06 / exact!r}\nstart = {{ vm1 = 1e-3 }}\nposition = {[-clamp / 20.0, 0.0]}\n"
    text += "\n[bodies.hub]\nmass = 1.0\ninertia = 1.0\n" + _joint("pin", "revolute", "hub", [0, 0])
    text += f'\n[joints.motor]\ntype = "driver"\njoint = "pin"\nvalue = "{speed!r}*t"\n'
    text += _joint("wall", "rigid", "arm.root", [0, 0], "hub")
    settings: dict[str, Any] = {"until": float(9.0 * np.pi / exact), "output_step": float(np.pi / exact / 40)}
    run = _model(folder, text, **settings).simulate(integrator="radau5", rtol=1e-9, atol=1e-14)
    bend = run["arm.m1"]
    crossed = np.flatnonzero(bend[:-1] * bend[1:] < 0.0)
    times = run.t[crossed] - bend[crossed] * np.diff(run.t)[crossed] / np.diff(bend)[crossed]
    own = np.pi / np.mean(np.diff(times[-5:])) if len(times) > 5 else 0.0
    return float(own), exact, run.status == "unverified"


def _blade(folder: Path, share: float, **keys: Any) -> tuple[float, float, bool]:
    return _turning(folder, share, 0, **keys)


def _propeller(folder: Path, share: float, **keys: Any) -> tuple[float, float, bool]:
    return _turning(folder, share, 10, **keys)


def _free(folder: Path, slope: float) -> tuple[float, float, bool]:
    """Return by how much beam elements differ from their motion at small slopes, within two periods of a free bar."""
    n = 16
    x = np.column_stack([np.linspace(0.0, 1.0, 33), np.zeros(33)])
    mesh = bar_frame(x, 2e9, 4e-4, 0.02**4 / 12.0, 1000.0)
    body = symgen.reduced(mesh.x, mesh.mass, mesh.stiffness, None, 2)
    body.save(folder / "arm.npz")
    shape, omega = body.shapes[:, 0].reshape(-1, 3), float(2.0 * np.pi * body.frequencies[0])
    largest = np.abs(np.diff(shape[:, 1]) / np.diff(x[:, 0])).max()
    period = 2.0 * np.pi / omega
    stiff = {"axial": 8e5, "bending": 2e9 * 0.02**4 / 12.0, "mass": 0.4, "rotary": 1000.0 * 0.02**4 / 12.0}
    beam = f"\n[beams.arm]\nstart = [0.0, 0.0]\nend = [1.0, 0.0]\nelements = {n}\n"
    beam += "".join(f"{key} = {value!r}\n" for key, value in stiff.items())
    settings: dict[str, Any] = {
        "integrator": "radau5",
        "rtol": 1e-7,
        "atol": 1e-9,
        "max_energy_error": 10.0,
        "verify": False,
    }
    run: dict[str, Any] = {"until": float(2.0 * period), "output_step": float(period / 20.0)}

    def bend(most: float) -> Array:
        start = dict[str, float]()
        for i, name in enumerate(["start", *map(str, range(1, n)), "end"]):
            _, across, turn = most * omega / largest * shape[2 * i]
            start |= {f"arm.{name}.vx": 0.0, f"arm.{name}.vy": float(across), f"arm.{name}.omega": float(turn)}
        result = _model(folder, beam, **run).simulate(start=start, **settings)
        return np.asarray((result["arm.start.y"] - result[f"arm.{n // 2}.y"]) / most)

    own = _model(folder, _ARM, **run).simulate(start={"arm.vm1": float(slope * omega / largest)}, **settings)
    linear, exact = bend(0.005), bend(slope)
    worst = np.abs(exact - linear).max() / np.abs(linear).max()
    return 1.0 + float(worst), 1.0, own.status == "unverified"


_FORM, _FRAME = "closed form", "exact frame"
MACHINES = {
    "strip of 2 mm between walls": Machine(
        "sag by linear modes over thickness", (0.04, 0.1, 0.15, 0.2, 0.3, 0.4), _FORM, _strip
    ),
    "plate of 5 mm between walls, of solids": Machine(
        "sag by linear modes over thickness", (0.04, 0.1, 0.15, 0.2, 0.3, 0.4), _FORM, _plate, False
    ),
    "mast on a beam between walls": Machine("mass [kg]", (0.05, 0.1, 0.2, 0.35, 0.5, 0.8), _FORM, _mast),
    "couple on a deep strip": Machine("over sqrt(E I G J)/L", (0.1, 0.25, 0.4, 0.55, 0.75, 1.0), _FORM, _couple),
    "frame on pins": Machine("weight over E I/H^2", (0.005, 0.01, 0.02, 0.03, 0.05, 0.1), _FRAME, _frame),
    "quarter of a circle, pushed": Machine("over k_t L", (-0.02, -0.04, -0.06, -0.09, -0.13, -0.17), _FRAME, _arc),
    "quarter of a circle, pulled": Machine("over k_t L", (0.02, 0.04, 0.06, 0.09, 0.13, 0.17), _FRAME, _arc),
    "arm with a weight, 45 degrees up": Machine("over k_t L", (0.02, 0.04, 0.06, 0.09, 0.13, 0.17), _FRAME, _arm),
    "strut between pins": Machine("over k_t L", (0.01, 0.02, 0.03, 0.05, 0.065, 0.08), _FORM, _between_pins),
    "strut between pins, to Euler's load and above": Machine(
        "over Euler's load", (0.005, 0.3, 0.6, 0.9, 0.95, 0.97, 1.02, 1.05, 1.3), "elastica", _buckling
    ),
    "strand between pins": Machine("over k_t L", (0.01, 0.02, 0.03, 0.05, 0.065, 0.08), _FORM, _strand),
    "blade": Machine("turn over the frequency of the free bar", (0.01, 0.02, 0.03, 0.04, 0.05, 0.06), _FORM, _blade),
    "propeller": Machine(
        "turn over the frequency of the free bar", (0.03, 0.06, 0.09, 0.12, 0.16, 0.2), _FORM, _propeller
    ),
    "free bar": Machine("slope [rad]", (0.03, 0.05, 0.08, 0.12, 0.16, 0.2), "beam elements", _free, False),
}


def rows_of(name: str, stiffened: bool) -> list[Row]:
    """Return the rows of a machine, with linear modes or with modes that loads stiffen."""
    machine, keys = MACHINES[name], {"stiffening": "interfaces"} if stiffened else {}
    rows = list[Row]()
    with tempfile.TemporaryDirectory() as folder:
        for load in machine.loads:
            own, exact, marked = machine.measure(Path(folder), load, **keys)
            rows.append(Row(load, abs(own / exact - 1.0), bool(marked)))
    return rows


def verdict(row: Row) -> str:
    """Return what a row is: ``silent``, ``false alarm``, or nothing."""
    if not row.marked and row.error > SILENT:
        return "silent"
    return "false alarm" if row.marked and row.error < FALSE else ""


def stored() -> dict[str, dict[str, list[Row]]]:
    """Return the rows of the record, by machine and by kind of modes."""
    if not RECORD.exists():
        return {}
    found = json.loads(RECORD.read_text(encoding="utf-8"))
    return {name: {kind: [Row(*row) for row in rows] for kind, rows in kinds.items()} for name, kinds in found.items()}


def page(table: dict[str, dict[str, list[Row]]]) -> str:
    """Return the page of a table."""
    every = [row for kinds in table.values() for rows in kinds.values() for row in rows]
    counts = {word: sum(verdict(row) == word for row in every) for word in ("silent", "false alarm")}
    lines = [
        "# Where modal bodies are marked",
        "",
        "Written by `python -m benchmarks.modal_limits`. Each machine is swept from small loads to twice where its",
        "mark begins. Cells are errors of the answer; **bold** ones are marked. *Stiffened* bodies are reduced with",
        '`stiffening = "interfaces"`, which solids do not have.',
        "",
        f"Of {len(every)} runs {counts['silent']} are silent (an error above 3 % without a mark), and"
        f" {counts['false alarm']} are false alarms (a mark with an error below 0.7 %).",
        "",
        "| machine | load | errors over | modes | loads and errors |",
        "| --- | --- | --- | --- | --- |",
    ]
    for name, kinds in table.items():
        for kind, rows in kinds.items():
            cells = "; ".join(f"{row.load:g}: {_percent(row)}" for row in rows)
            lines.append(f"| {name} | {MACHINES[name].load} | {MACHINES[name].against} | {kind} | {cells} |")
    return "\n".join(lines) + "\n"


def _percent(row: Row) -> str:
    text = f"{100.0 * row.error:.2g} %"
    return f"**{text}**" if row.marked else text


def write(names: list[str]) -> None:
    """Compute the rows of machines, and write record and page."""
    table = stored()
    for name in names:
        kinds = {"linear": False} | ({"stiffened": True} if MACHINES[name].bars else {})
        table[name] = {kind: rows_of(name, stiffened) for kind, stiffened in kinds.items()}
        for kind, rows in table[name].items():
            print(name, kind, [(row.load, round(row.error, 5), row.marked, verdict(row)) for row in rows], flush=True)
    table = {name: table[name] for name in MACHINES if name in table}
    RECORD.write_text(json.dumps(table, indent=1) + "\n", encoding="utf-8")
    PAGE.write_text(page(table), encoding="utf-8")


if __name__ == "__main__":
    write(sys.argv[1:] or list(MACHINES))
